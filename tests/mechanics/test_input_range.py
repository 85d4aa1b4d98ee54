"""Which range the input takes, and what holds at its ends and beyond them."""

from __future__ import annotations

import json
import math
import random
from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from build import four_bar
from random_joints import (
    Make,
    bar_that_limits_the_input,
    driven_by_a_cylinder,
    slot_that_limits_the_input,
    solved_linkages,
)
from whole_rows import whole_rows

from linkanim.cli import main
from linkanim.mechanics.linkage import RRR, Pin
from linkanim.mechanics.motion import Mechanism, mechanism, stopped
from linkanim.mechanics.solver.strokes import CylinderStroke, SliderStroke
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.units import typeset

DOUBLE_ROCKER = {"ground": 100, "crank": 80, "coupler": 40, "rocker": 90}


def double_rocker(driver: str, tilt: float, **drive: str) -> Scene:
    bars = {**DOUBLE_ROCKER, "driver": driver, "ground_angle": f"{tilt} deg"}
    return scene_from({"four-bar": bars, "drive": drive}, name="my", where="my.toml")


def in_degrees(scene: Scene) -> tuple[float, float]:
    low, high = map(math.degrees, scene.info.input_range)
    return low, high


@pytest.mark.parametrize("tilt", [0, 30, 50, 89, 120, 180, -45, -100])
@pytest.mark.parametrize("driver", ["crank", "rocker"])
def test_the_range_above_the_ground_line_is_taken_whichever_end_drives(driver: str, tilt: float) -> None:
    # Seen along the ground from O2 to O4, both moving pins are on the left of it in mid-range.
    scene = double_rocker(driver, tilt)
    posed = scene.pose(math.pi / 2).position
    along = math.radians(tilt)
    up = -math.sin(along), math.cos(along)
    assert np.dot(posed[scene.linkage.drive.joint], up) > 0
    assert np.ptp(in_degrees(scene)) == pytest.approx({"crank": 62.10, "rocker": 54.58}[driver], abs=0.01)


def test_a_start_decides_where_it_is_stated_only() -> None:
    # Tilted by 50 degrees, the range below the ground line holds 0.
    below, above = double_rocker("crank", 50, start="0 deg"), double_rocker("crank", 50)
    assert in_degrees(below) == pytest.approx((50 - 91.79, 50 - 29.69), abs=0.01)
    assert in_degrees(above) == pytest.approx((50 + 29.69, 50 + 91.79), abs=0.01)


@pytest.mark.parametrize(("start", "around"), [(350.0, 360.0), (-10.0, 0.0), (710.0, 720.0), (10.0, 0.0)])
def test_a_range_lies_around_the_stated_start(
    start: float, around: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "my.toml"
    path.write_text(
        f'[four-bar]\nground = 100\ncrank = 80\ncoupler = 40\nrocker = 50\n[drive]\nstart = "{start} deg"\n'
    )
    assert main(["info", str(path), "--json"]) == 0
    low, high = map(math.degrees, json.loads(capsys.readouterr().out)["input_range"])
    assert (low + high) / 2 == pytest.approx(around)
    assert low < start < high
    assert main(["info", str(path)]) == 0
    assert f"swings {typeset(f'{low:.4g}')}°…{typeset(f'{high:.4g}')}°" in capsys.readouterr().out
    assert main(["solve", str(path), "--angle", f"{start + 180} deg"]) != 0
    refused = capsys.readouterr().err
    assert f"goes from {low:.6g} deg to {high:.6g} deg" in refused


BESIDE = 10.0 ** -np.arange(0.0, 17.0)


def check_ends(solved: Mechanism) -> None:
    """Check the rows by angle at both ends of the range, beside them, and at no angle at all."""
    path = solved.assembly.path
    ends = low, high = path.input_range
    assert whole_rows(solved, np.array(ends)).all()
    assert not whole_rows(solved, np.array([math.inf, -math.inf, math.nan])).any()
    whole_rows(solved, np.concatenate([end + way * BESIDE for end in ends for way in (1, -1)]))
    if not path.full_turn:
        outside = np.nextafter(low, -math.inf), np.nextafter(high, math.inf)
        assert not whole_rows(solved, np.array(outside)).any()
        inside = np.nextafter(low, math.inf), np.nextafter(high, -math.inf)
        assert whole_rows(solved, np.array(inside)).all()


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_ends_of_a_scenes_range_are_in_it_and_beyond_is_not_a_number(name: str) -> None:
    solved = load(name).mechanism
    if isinstance(solved.assembly.path, SliderStroke):
        pytest.skip("it has no angle")
    check_ends(solved)


MAKES = driven_by_a_cylinder, bar_that_limits_the_input, slot_that_limits_the_input


@pytest.mark.parametrize("make", MAKES, ids=lambda make: make.__name__)
def test_the_ends_of_a_random_range_are_in_it_and_beyond_is_not_a_number(make: Make) -> None:
    for _, solved in islice(solved_linkages(make), 2):
        check_ends(solved)


def test_the_ends_of_a_random_swing_are_in_it_and_beyond_is_not_a_number() -> None:
    rng = random.Random(4)
    for _ in range(12):
        g, r, a = (rng.uniform(1, 9) for _ in range(3))
        rocker = rng.uniform(max(abs(g - r) - a, a - g - r, 0.1), g + r + a)
        tilt = rng.choice([0.0, rng.uniform(-3, 3)])
        check_ends(mechanism(four_bar((g, r, a, rocker), ground_angle=tilt)))


def test_a_cylinder_turns_its_crank_around_the_stated_start() -> None:
    document = {**load("excavator").document}
    path = load("excavator").mechanism.assembly.path
    assert isinstance(path, CylinderStroke)
    low, high = path.input_range
    middle = math.degrees((low + high) / 2) + 720
    drive = {**document["drive"], "start": f"{middle} deg"}
    scene = scene_from({**document, "drive": drive}, name="my", where="my.toml")
    assert scene.info.input_range == pytest.approx((low + 4 * math.pi, high + 4 * math.pi))
    check_ends(scene.mechanism)


@pytest.mark.parametrize(("name", "part", "length"), [("A", 1, 14.4), ("B", 1, 14.4), ("E", 0, 14.4)])
def test_a_drag_and_loading_tell_one_range(name: str, part: int, length: float) -> None:
    # Hart's rigid bars are at their limit at every angle at which the loop before them is at its own.
    hart = load("hart").linkage
    joints = []
    for joint in hart.joints:
        if isinstance(joint, Pin) and joint.name == "Q":
            joint = replace(joint, position=(48.48, 0.0))
        elif isinstance(joint, RRR) and joint.name == name:
            lengths = list(joint.lengths)
            lengths[part] = length
            joint = replace(joint, lengths=(lengths[0], lengths[1]))
        joints.append(joint)
    linkage = replace(hart, joints=tuple(joints))
    dragged = stopped(linkage)
    assert dragged
    assert dragged.assembly.path.input_range == mechanism(linkage).assembly.path.input_range


def test_a_range_that_begins_just_before_a_start_that_is_shut_is_the_one_nearest_to_it() -> None:
    joints = {
        "A": {"crank": "O2", "length": 13},
        "C": {"crank": "G", "length": 10, "gear": {"with": "A", "ratio": "-2/3", "offset": "-30 deg"}},
        "D": {"from": ["A", "C"], "length": [25, 10], "side": "left"},
        "E": {"from": ["H", "C"], "length": [5, 14], "side": "right"},
    }
    ground = {"O2": [0, 0], "G": [-22, 0], "H": [5, 0]}
    drive = {"speed": "20 rpm", "start": "0 deg"}
    scene = scene_from({"drive": drive, "ground": ground, "joints": joints}, name="my", where="my.toml")
    low, high = scene.info.input_range
    # the gears come back after three turns, so the same range comes again every three turns
    assert -math.pi / 2 < low < high < 0.0
    check_ends(scene.mechanism)
