"""`linkanim convert`: scenes in points and links, and files of other programs, move as what they are of."""

from __future__ import annotations

import csv
import math
import random
import tomllib
from collections.abc import Callable, Mapping
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import linkanim
from linkanim.cli import main
from linkanim.scenes.reading import scene_from

CHAIN = {
    "crank": ["O", "A"],
    "coupler": ["A", "B", "P"],
    "rocker": ["Q", "B"],
    "rod": ["P", "E"],
    "last": ["R", "E"],
}
TRIAD = {"crank": ["O", "A"], "a": ["A", "B"], "plate": ["B", "C", "E"], "c": ["Q", "C"], "e": ["R", "E"]}


def document(seed: int) -> dict[str, Any]:
    """Return a linkage of points put down at random: a chain of dyads, or a triad."""
    chance = random.Random(seed)
    links = {"ground": ["O", "Q", "R"], **(TRIAD if seed % 2 else CHAIN)}
    names = dict.fromkeys(point for on in links.values() for point in on)
    points = {name: [round(chance.uniform(0, 99), 3), round(chance.uniform(0, 99), 3)] for name in names}
    return {"points": points, "links": links, "drive": {"joint": "O"}}


def as_pyslvs(document: Mapping[str, Any]) -> bytes:
    joints = []
    for name, (x, y) in document["points"].items():
        on = ", ".join(link for link, points in document["links"].items() if name in points)
        joints.append(f"J[R, color[Green], P[{x}, {y}], L[{on}]]")
    return f"M[{', '.join(joints)}]".encode()


def as_linkage2(document: Mapping[str, Any]) -> bytes:
    number = {name: n for n, name in enumerate(document["points"])}
    ground, lines = document["links"]["ground"], ['<linkage2><program version="3"/>']
    for name, (x, y) in document["points"].items():
        marks = ' anchor="true"' * (name in ground) + ' input="true" rpm="-20"' * (name == "O")
        lines.append(f'<connector id="{number[name]}" x="{x}" y="{y}"{marks}/>')
    for n, (link, points) in enumerate(document["links"].items()):
        ends = "".join(f'<connector id="{number[point]}"/>' for point in points)
        lines += [f'<Link id="{n}">{ends}</Link>'] * (link != "ground")
    return "".join((*lines, "</linkage2>")).encode()


def as_link_arrays(document: Mapping[str, Any]) -> bytes:
    from io import BytesIO

    names = list(document["points"])
    joined = np.zeros((len(names), len(names)))
    for link, points in document["links"].items():
        for p in points if link != "ground" else ():
            for q in points:
                joined[names.index(p), names.index(q)] = p != q
    fixed = np.array([[name in document["links"]["ground"]] for name in names], float)
    motor = np.array([names.index("O"), names.index("A")])
    file = BytesIO()
    np.savez(file, A=joined, x0=np.array(list(document["points"].values())), node_types=fixed, motor=motor)
    return file.getvalue()


def as_tables(document: Mapping[str, Any]) -> bytes:
    file = StringIO()
    rows = csv.writer(file)
    rows.writerow(["name", "x", "y"])
    rows.writerows([name, *place] for name, place in document["points"].items())
    rows.writerow(["link", "joints"])
    rows.writerows([name, *points] for name, points in document["links"].items())
    rows.writerow(["drive", "O"])
    return file.getvalue().encode()


WRITERS: Mapping[str, Callable[[Mapping[str, Any]], bytes]] = {
    "my.pyslvs": as_pyslvs,
    "my.linkage2": as_linkage2,
    "my.npz": as_link_arrays,
    "my.csv": as_tables,
}


@pytest.mark.parametrize("name", WRITERS)
@pytest.mark.parametrize("seed", range(10))
def test_a_file_of_another_program_moves_as_what_it_was_written_from(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, seed: int
) -> None:
    monkeypatch.chdir(tmp_path)
    given = document(seed)
    Path(name).write_bytes(WRITERS[name](given))
    assert main(["convert", name, "-o", "out.toml"]) == 0
    found, true = linkanim.load("out.toml"), scene_from(given, name="my", where="my.toml")
    points = tomllib.loads(Path("out.toml").read_text())["points"]
    assert found.info.input_range == pytest.approx(true.info.input_range, abs=1e-12)
    start = true.linkage.drive.start
    one, other = (each.solve(angle=start + 0.01, speed=1.0) for each in (found, true))
    where = {x: name for name, (x, _) in given["points"].items()}
    for point, (x, _) in points.items():
        assert one.velocity[point] == pytest.approx(other.velocity[where[x]], abs=1e-9)


@pytest.mark.sampled
@pytest.mark.parametrize("name", linkanim.names())
def test_every_scene_is_said_by_its_points_and_links(tmp_path: Path, name: str) -> None:
    path = tmp_path / "out.toml"
    assert main(["convert", name, "-o", str(path)]) == 0
    one, other = linkanim.load(name), linkanim.load(path)
    phases = np.linspace(0, one.period, 20)
    a, b = (each.solve(phase=phases, speed=1.0) for each in (one, other))
    size = max(float(np.ptp(place)) for place in a.position.values())
    for joint, place in a.position.items():
        assert np.abs(b.position[joint] - place).max() < 1e-9 * size
    assert other.info.input_range == pytest.approx(one.info.input_range, abs=1e-9 * max(size, 1))
    assert math.isclose(one.period, other.period)


HOSTILE: dict[str, tuple[str, bytes, str]] = {
    "nothing": ("my.csv", b"", "no joints"),
    "no ground": ("my.csv", b"A,0,0\nB,1,0\nlink\na,A,B\nb,A,B\n", "fixed to the ground"),
    "a word for a number": ("my.csv", b"A,0,x\n", "no number"),
    "an infinity": ("my.csv", b"A,0,inf\n", "no number"),
    "a lost joint": ("my.csv", b"A,0,0\nB,1,1\nlink\nground,A\nb,A,Q\n", "no joint of the file"),
    "a row of four": ("my.csv", b"A,0,0,0\n", "4 cells"),
    "a bracket": ("my.txt", b"M[J[R, P[0, 0]", "not closed"),
    "brackets without end": ("my.txt", b"M[" * 5000, "brackets do not match"),
    "no kind": ("my.txt", b"M[J[Q, P[0, 0], L[ground]]]", "its kind R, P or RP"),
    "what runs": ("my.txt", b"M[J[R, P[0, __import__('os')], L[ground]]]", "no expression"),
    "entities": ("my.linkage2", b'<!DOCTYPE x [<!ENTITY a "b">]><linkage2/>', "things of its own"),
    "torn XML": ("my.linkage2", b"<linkage2><connector", "no file of Linkage"),
    "an actuator": (
        "my.linkage2",
        b'<linkage2><connector id="0" x="0" y="0"/><Link id="1" actuator="true"/></linkage2>',
        "is an actuator",
    ),
    "no arrays": ("my.npz", b"PK\x03\x04", "no arrays"),
    "MotionGen": ("my.motiongen", b"{}", "seems to be a file of MotionGen"),
    "PMKS+": ("my.txt", b"https://app.pmksplus.com/?2v.1.1", "a link to PMKS+"),
    "a picture": ("my.svg", b"<svg/>", "seems to be a drawing"),
    "not text": ("my.csv", b"\xff\xfe\x00", "not UTF-8"),
}


@pytest.mark.parametrize(("name", "data", "reason"), HOSTILE.values(), ids=HOSTILE)
def test_what_is_no_linkage_is_one_sentence(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    name: str,
    data: bytes,
    reason: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path(name).write_bytes(data)
    assert main(["convert", name, "-o", "out.toml"]) == 2
    said = capsys.readouterr().err
    assert reason in said
    assert name in said
    assert said.count("\n") == 1
    assert not Path("out.toml").exists()
