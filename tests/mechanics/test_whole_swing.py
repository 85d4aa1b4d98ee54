"""A swing is as long as its lengths allow, and every range that the sides leave to the input is told."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

from linkanim.bench.reference import crossing
from linkanim.cli import main
from linkanim.errors import AssemblyError
from linkanim.scenes import load
from linkanim.scenes.editing import other_return
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse

EPS = 2.0**-52
# The crank swings to its toggles; on the other closure of B, D cannot close around the middle of the swing.
HELD = """
title = "A dyad behind a swinging crank"
length_unit = "mm"
[drive]
joint = "A"
speed = "20 rpm"
start = "60 deg"
[ground]
O = [0, 0]
P = [100, 0]
Q = [101, 84]
[joints.A]
crank = "O"
length = 20
[joints.B]
from = ["A", "P"]
length = [67, 40]
side = "left"
[joints.C]
on = ["P", "B"]
at = [21, 0]
[joints.D]
from = ["C", "Q"]
length = [71, 26]
side = "left"
"""
# Stephenson III, driven at its first bar: E's bars leave the crank two ranges.
TWO_RANGES = """
length_unit = "cm"
[drive]
joint = "B"
speed = "20 rpm"
[ground]
A = [7, 4]
D = [23, 10]
G = [45, 17]
[joints.B]
crank = "A"
length = 12.165525060596439
[joints.C]
from = ["B", "D"]
length = [21.93171219946131, 15.132745950421556]
side = "left"
[joints.E]
on = ["B", "C"]
at = [19.651907, 11.991767]
[joints.F]
from = ["E", "G"]
length = [25.179356624028344, 15.132745950421556]
side = "left"
"""


def scene_of(text: str) -> Scene:
    return scene_from(parse(text, "my.toml"), name="my", where="my.toml")


def written(folder: Path, text: str) -> str:
    path = folder / "my.toml"
    path.write_text(text)
    return str(path)


def held_at(angle: Any, side: int = 1) -> dict[str, Any]:
    """Return the joints of `HELD` at an angle of the crank, in as many digits as mpmath has."""
    p, q = mp.mpc(100), mp.mpc(101, 84)
    a = 20 * mp.expj(angle)
    b = crossing(a, p, mpf(67), mpf(40), side)
    c = p + (b - p) / 40 * 21
    return {"A": a, "B": b, "C": c, "D": crossing(c, q, mpf(71), mpf(26), 1)}


def toggle() -> Any:
    return mp.acos(mpf(100**2 + 20**2 - (67 + 40) ** 2) / (2 * 100 * 20))


def test_a_swing_goes_to_the_toggle_where_its_dyads_close_though_they_do_not_beyond() -> None:
    scene = scene_of(HELD)
    with mp.workdps(50):
        limit = toggle()
        assert scene.info.input_range == (-float(limit), float(limit))
        assert scene.info.toggles == scene.info.input_range
        gaps = [10.0**-k for k in range(1, 16)]
        angles = [0.0, *(side * (float(limit) - gap) for gap in gaps for side in (1, -1))]
        motion = scene.solve(angle=np.array(angles), derivatives=0)
        for row, angle in enumerate(angles):
            for joint, true in held_at(mpf(angle)).items():
                assert abs(mp.mpc(*motion.position[joint][row]) - true) <= 16 * EPS * 100, (joint, angle)
        for gap in (0.0, *gaps):
            for end in (0.0, math.pi):
                for phase in (end + gap, end - gap):
                    true = held_at(-limit * mp.cos(mpf(phase)))
                    for joint, place in scene.pose(phase).position.items():
                        if joint in true:
                            assert abs(mp.mpc(*place) - true[joint]) <= 16 * EPS * 100, (joint, phase)


def test_where_the_way_on_does_not_exist_the_input_turns_back_and_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = scene_of(HELD)
    assert scene.period == 2 * math.pi
    there, back = scene.solve(phase=np.array([2.0, 2 * math.pi - 2.0])).position["D"]
    assert back == pytest.approx(there, rel=1e-14)
    returns = dict(scene.info.lines)["returns"]
    assert returns.startswith("on the same closure, as beyond the limits its links do not close")
    with pytest.raises(AssemblyError, match="it comes back on the same closure"):
        other_return(scene)
    path = written(tmp_path, HELD)
    assert main(["info", path, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["returns"] == "same"
    assert told["same_closure_at"] == list(scene.info.input_range)
    assert main(["solve", path, "--angle", "104 deg", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["joints"]["D"]["position"]
    assert found == pytest.approx([75.97601202417, 76.94308666727], abs=1e-10)
    assert main(["solve", path, "--angle", "105.3 deg"]) == 2
    refused = capsys.readouterr().err
    assert "from -105.204 deg to 105.204 deg" in refused
    assert "runs through" not in refused


@pytest.mark.parametrize(
    ("drive", "own", "other"),
    [
        ("", (349.8, 361.8), (40.6, 140.8)),
        ('start = "90 deg"', (40.6, 140.8), (349.8, 361.8)),
        ('start = "-5 deg"', (-10.2, 1.8), (40.6, 140.8)),
    ],
    ids=["no start", "in the other range", "a turn back"],
)
def test_all_ranges_of_the_assembly_are_told(
    drive: str, own: tuple[float, float], other: tuple[float, float]
) -> None:
    info = scene_of(TWO_RANGES.replace('joint = "B"', f'joint = "B"\n{drive}', 1)).info
    assert np.degrees(info.input_range) == pytest.approx(own, abs=0.1)
    (found,) = info.mechanism.other_ranges
    assert np.degrees(found) % 360 == pytest.approx(np.array(other) % 360, abs=0.1)


def test_each_place_that_tells_a_range_tells_all(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path, TWO_RANGES)
    says = "and from 40.56.* deg to 140.7.* deg where its start lies there"
    for command in (
        ["solve", path, "--angle", "90 deg"],
        ["report", path, "--angles", "90 deg", "-o", str(tmp_path / "my.html")],
    ):
        assert main(command) == 2
        assert re.search(says, capsys.readouterr().err), command
    assert main(["info", path]) == 0
    assert "361.8°, and 40.56°…140.8° where its start lies there" in capsys.readouterr().out
    assert main(["info", path, "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["other_ranges"]) == 1


RANGES = [
    ("double-rocker", 1),  # a Grashof one, on both sides of its ground
    ("excavator", 1),  # the other triangle of its cylinder
    ("triple-rocker", 0),
    ("rocker-driven", 0),
    ("driven-piston", 0),
    ("press", 0),
]


@pytest.mark.parametrize(("name", "count"), RANGES)
def test_a_scene_has_as_many_further_ranges_as_starts_lead_to(name: str, count: int) -> None:
    scene = load(name)
    assert len(scene.mechanism.other_ranges) == count
    for low, high in scene.mechanism.other_ranges:
        drive = {**scene.document["drive"], "start": f"{math.degrees((low + high) / 2)} deg"}
        there = scene_from({**scene.document, "drive": drive}, name="my", where="my.toml")
        assert there.info.input_range == pytest.approx((low, high), rel=1e-12)
