"""`linkanim convert`: scenes in points and links, and files of other programs, move as what they are of."""

from __future__ import annotations

import csv
import json
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


def as_pmks(document: Mapping[str, Any]) -> bytes:
    rows = []
    slots = {slide.get("point", slide.get("through")): slide for slide in document.get("slides", {}).values()}
    for name, (x, y) in document["points"].items():
        on = [link for link, points in document["links"].items() if name in points]
        kind, angle = "R", "0"
        if name in slots:
            slide = slots[name]
            kind, angle = ("P" if "link" in slide else "RP"), slide["angle"].removesuffix(" deg")
            on = [slide["on"], *([slide["link"]] if kind == "P" else on)]
        drives = "t" if name == document["drive"]["joint"] else "f"
        rows.append(f"{' '.join(on)} {kind} {x} {y} {angle} fff{drives}")
    quoted = "%7C".join(rows).replace(" ", "%20")
    return f"http://pmks.example/pmks.html?set=s-10|f5&mech={quoted}%7C".encode()


DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"


def in_base_64(value: float) -> str:
    """Return whole thousandths as PMKS+ writes them."""
    whole, text = round(abs(value) * 1000), ""
    while True:
        whole, last = divmod(whole, 64)
        text = DIGITS[last] + text
        if not whole:
            return "0" * (value < 0) + text


def stamped(body: str) -> str:
    """Return what PMKS+ has in a link: its length's character, a star and the digest follow."""
    body += DIGITS[len(body) % 62]
    value = 0x811C9DC5
    for letter in body:
        value = (value ^ ord(letter)) * 0x01000193 & 0xFFFFFFFF
    digest = ""
    for _ in range(6):
        value, last = divmod(value, 62)
        digest = DIGITS[last] + digest
    return f"{body}*{digest}"


def as_pmks_plus(document: Mapping[str, Any]) -> bytes:
    slots = {slide.get("point", slide.get("through")): slide for slide in document.get("slides", {}).values()}
    joints, links = [], []
    for name, (x, y) in document["points"].items():
        marks = 4 * (name in document["links"]["ground"]) + 2 * (name == document["drive"]["joint"])
        line = ["0"]
        if name in slots:
            slide = slots[name]
            on, turned = slide["on"], math.radians(float(slide["angle"].removesuffix(" deg")))
            grounded = on == "ground"
            marks = 1 + 4 * grounded + 8 * ("link" in slide)
            line = [in_base_64(turned)] if grounded else ["0", on, *document["links"][on][:2]]
        joints.append(",".join((DIGITS[marks] + name, name, in_base_64(x), in_base_64(y), *line)))
    for link, points in document["links"].items():
        if link != "ground":
            links.append(",".join((f"YR{link}", link, "Fe", "Fe", "0", "0", "c5cae9", *points, "")) + ",")
    body = ".".join(("2v.Ay,1E8.K,0.1011", *joints, "", *links, "", "", "N_"))
    return f"https://app.pmksplus.com/?{stamped(body)}\n".encode()


def as_motiongen(document: Mapping[str, Any]) -> bytes:
    ids = {name: f"{n:08x}-id" for n, name in enumerate(document["points"])}
    joints = [
        {"id": ids[name], "x": x, "y": y, "isWelded": False} for name, (x, y) in document["points"].items()
    ]
    links = [
        {"id": f"link {name}", "jointIds": [ids[on] for on in points], "isGround": name == "ground"}
        for name, points in document["links"].items()
    ]
    motor = {"type": "rotary", "at": ids["O"], "from": ids["Q"], "to": ids["A"], "velocity": 10}
    mechanism = {"joints": joints, "slots": [], "links": links, "cylinders": [], "actuators": [motor]}
    whole = {"name": "motiongen", "version": "1.1.5", "mechanism": mechanism}
    return json.dumps(whole | {"settings": {"linearUnit": "mm", "angularUnit": "rad"}}).encode()


WRITERS: Mapping[str, Callable[[Mapping[str, Any]], bytes]] = {
    "my.pyslvs": as_pyslvs,
    "my.linkage2": as_linkage2,
    "my.npz": as_link_arrays,
    "my.csv": as_tables,
    "my.txt": as_pmks,
    "my.url": as_pmks_plus,
    "my.motiongen": as_motiongen,
}


@pytest.mark.parametrize("name", WRITERS)
@pytest.mark.parametrize("seed", range(10))
@pytest.mark.thinned(3)
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


SLIDING: dict[str, dict[str, Any]] = {
    "a slider-crank": {
        "points": {"O": [0, 0], "A": [1, 2], "C": [7, -0.5]},
        "links": {"ground": ["O"], "crank": ["O", "A"], "rod": ["A", "C"]},
        "slides": {"guide": {"point": "C", "on": "ground", "angle": "-30 deg"}},
    },
    "a pin in the slot of a lever": {
        "points": {"O": [0, 0], "A": [1, 2], "Q": [5, 0], "P": [-3, 4]},
        "links": {"ground": ["O", "Q"], "crank": ["O", "A"], "lever": ["Q", "P"]},
        "slides": {"slot": {"point": "A", "on": "lever", "angle": f"{math.degrees(math.atan2(4, -8))} deg"}},
    },
    "a link that does not turn": {
        "points": {"O": [0, 0], "A": [1, 2], "C": [7, -0.5], "D": [9, 7], "G": [8, 8]},
        "links": {"ground": ["O"], "crank": ["O", "A"], "rod": ["A", "D"], "ram": ["C", "D", "G"]},
        "slides": {"guide": {"link": "ram", "through": "C", "on": "ground", "angle": "90 deg"}},
    },
}


@pytest.mark.parametrize("writer", [as_pmks, as_pmks_plus])
@pytest.mark.parametrize("given", SLIDING.values(), ids=SLIDING)
def test_what_slides_in_pmks_slides_here(
    tmp_path: Path, given: dict[str, Any], writer: Callable[[Mapping[str, Any]], bytes]
) -> None:
    given = {**given, "drive": {"joint": "O"}}
    path = tmp_path / "my.txt"
    path.write_bytes(writer(given))
    assert main(["convert", str(path), "-o", str(tmp_path / "out.toml")]) == 0
    found, true = linkanim.load(tmp_path / "out.toml"), scene_from(given, name="my", where="my.toml")
    start = true.linkage.drive.start
    one, other = (each.solve(angle=[start, start + 0.05], speed=1.0) for each in (found, true))
    written = tomllib.loads((tmp_path / "out.toml").read_text())["points"]
    names = dict(zip(given["points"], written, strict=True))
    for theirs, ours in names.items():
        assert one.position[ours] == pytest.approx(other.position[theirs], abs=1e-9)
        assert one.velocity[ours] == pytest.approx(other.velocity[theirs], abs=1e-9)


def test_speeds_and_units_are_those_of_the_file(tmp_path: Path) -> None:
    path = tmp_path / "out.toml"
    for writer, speed, unit in ((as_pmks, "-10 rpm", "mm"), (as_pmks_plus, "-20 rpm", "cm")):
        (tmp_path / "my.txt").write_bytes(writer(document(0)))
        assert main(["convert", str(tmp_path / "my.txt"), "-o", str(path)]) == 0
        written = tomllib.loads(path.read_text())
        assert (written["drive"]["speed"], written["length_unit"]) == (speed, unit)


def test_a_link_called_as_the_drive_has_another_name(tmp_path: Path) -> None:
    points = {"O": [0, 0], "A": [1, 2], "B": [9, 7], "C": [8, 0]}
    links = {"ground": ["O", "C"], "input": ["O", "A"], "rod": ["A", "B"], "rocker": ["B", "C"]}
    given = {"points": points, "links": links, "drive": {"joint": "O"}}
    (tmp_path / "my.txt").write_bytes(as_pmks_plus(given))
    assert main(["convert", str(tmp_path / "my.txt"), "-o", str(tmp_path / "out.toml")]) == 0
    assert "input" not in linkanim.load(tmp_path / "out.toml").document["bodies"]


def test_an_actuator_of_linkage_is_a_cylinder_that_grows_by_its_throw(tmp_path: Path) -> None:
    points = {"O": [0, 0], "Q": [110, 0], "G": [60, -40], "A": [20, 60], "B": [100, 70], "P": [60, 110]}
    links = {
        "ground": ["O", "Q", "G"],
        "a": ["O", "A"],
        "b": ["A", "B", "P"],
        "c": ["Q", "B"],
        "d": ["G", "P"],
    }
    written = as_linkage2({"points": points, "links": links}).decode()
    written = written.replace(' input="true" rpm="-20"', "")
    written = written.replace('<Link id="4">', '<Link id="4" actuator="true" throw="0.25" cpm="12">')
    (tmp_path / "lift.linkage2").write_text(written, encoding="utf-8")
    assert main(["convert", str(tmp_path / "lift.linkage2"), "-o", str(tmp_path / "lift.toml")]) == 0
    scene = linkanim.load(tmp_path / "lift.toml")
    assert scene.info.input_range == (150.0, 150.25)
    assert scene.info.period_seconds == pytest.approx(5.0)
    found = scene.solve(phase=math.pi, speed=1.0).position
    assert math.dist(found["P2"], found["P5"]) == pytest.approx(150.25, abs=1e-12)


def test_a_link_into_the_web_is_read_as_it_stands(tmp_path: Path) -> None:
    link = as_pmks_plus(document(0)).decode().strip()
    assert main(["convert", link, "-o", str(tmp_path / "out.toml")]) == 0
    assert linkanim.load(tmp_path / "out.toml").info.counts == (6, 7, 1)


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
        "is an actuator beside another input, or not between two connectors",
    ),
    "an actuator without a throw": (
        "my.linkage2",
        b'<linkage2><connector id="0" x="0" y="0"/><connector id="1" x="9" y="0"/>'
        b'<Link id="1" actuator="true"><connector id="0"/><connector id="1"/></Link></linkage2>',
        "the throw of link 1",
    ),
    "no arrays": ("my.npz", b"PK\x03\x04", "no arrays"),
    "an empty MotionGen": ("my.motiongen", b"{}", "no mechanism"),
    "MotionGen that is no JSON": ("my.motiongen", b"{" * 5000, "nested deeper"),
    "MotionGen with a NaN": (
        "my.motiongen",
        as_motiongen(document(0)).replace(b": 10}", b": NaN}"),
        "no mechanism",
    ),
    "MotionGen in feet": (
        "my.motiongen",
        as_motiongen(document(0)).replace(b'"mm"', b'"ft"'),
        'measures in "ft"',
    ),
    "MotionGen with slots": (
        "my.motiongen",
        as_motiongen(document(0)).replace(b'"slots": []', b'"slots": [1]'),
        "has slots",
    ),
    "MotionGen with a cylinder": (
        "my.motiongen",
        as_motiongen(document(0)).replace(b'"rotary"', b'"linear"'),
        'has a "linear" actuator',
    ),
    "MotionGen that welds": (
        "my.motiongen",
        as_motiongen(document(0)).replace(b'"isWelded": false', b'"isWelded": true'),
        "welds links",
    ),
    "MotionGen with a lost motor": (
        "my.motiongen",
        as_motiongen(document(0)).replace(b'"at": "00000000-id"', b'"at": "it"'),
        "names no joint",
    ),
    "MotionGen with a word for a number": (
        "my.motiongen",
        as_motiongen(document(0)).replace(b'"x": ', b'"x": "one", "z": '),
        "no number",
    ),
    "PMKS+ without a linkage": ("my.txt", b"https://app.pmksplus.com/?2v.1.1", "without a linkage"),
    "PMKS+ cut off": ("my.txt", as_pmks_plus(document(0)).strip()[:-9], "missing or changed"),
    "PMKS+ with a letter changed": (
        "my.txt",
        as_pmks_plus(document(0)).replace(b"YRcrank", b"YRcrane"),
        "missing or changed",
    ),
    "PMKS+ with a joint from nowhere": (
        "my.txt",
        stamped("2v.Ay.K,0.1011.6O,O,0,0,0..YRa,a,0,0,0,0,,O,Z,,...N_").encode(),
        "no joint",
    ),
    "PMKS+ with a sign for a number": (
        "my.txt",
        stamped("2v.Ay.K,0.1011.6O,O,!,0,0..YRa,a,0,0,0,0,,O,,...N_").encode(),
        "no number of PMKS+",
    ),
    "PMKS+ with a cylinder": (
        "my.txt",
        stamped("2v.Ay.K,0.1011.7O,O,0,0,0.4A,A,1,1,0..YRa,a,0,0,0,0,,O,A,,...N_").encode(),
        "drives by sliding",
    ),
    "PMKS+ with a block of three": (
        "my.txt",
        stamped("2v.Ay.K,0.1011.5O,O,0,0,0.4A,A,1,1,0.0B,B,2,1,0..YPa,a,0,0,0,0,,O,A,B,,...N_").encode(),
        "no slider of PMKS+",
    ),
    "PMKS with a gear": ("my.txt", b"ground,a,R,0,0\na,b,G,1,1\n", "is a gear"),
    "PMKS with a torn row": ("my.txt", b"ground,a,R,0,0\na,b\n", "no row of PMKS"),
    "PMKS with a slide that has no angle": ("my.txt", b"ground,a,R,0,0\na,b,RP,1,1\n", "needs an angle"),
    "PMKS with a lonely slide": ("my.txt", b"ground,a,R,0,0\na,RP,1,1,20\n", "no link slides there"),
    "PMKS with a sliding motor": ("my.txt", b"ground,a,P,0,0,10,ffft\n", "drives by sliding"),
    "a link to anywhere": ("my.txt", b"https://example.com/", "a link into the web"),
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
