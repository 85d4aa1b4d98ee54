"""Joints may stand in any order in the file; what depends on what decides."""

from __future__ import annotations

import math
import tomllib
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from linkanim.errors import AssemblyError, SceneError
from linkanim.mechanics.linkage import (
    RPP,
    RPR,
    RRP,
    RRR,
    Body,
    Crank,
    Damper,
    Drive,
    Gear,
    Line,
    Pin,
    Polar,
    Rigid,
    Spring,
)
from linkanim.scenes import load
from linkanim.scenes.editing import Stretch, closure_name, dimensions, handles, stretches, with_dimensions
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

PINS = "[ground]\nO2 = [0, 0]\nO4 = [100, 0]\n"
JOINTS = {
    "A": "[joints.A]\ncrank = 'O2'\nlength = 30\n",
    "B": "[joints.B]\nfrom = ['A', 'O4']\nlength = [90, 80]\n",
    "H": "[joints.H]\non = ['A', 'B']\nat = [20, 30]\n",
    "K": "[joints.K]\non = ['A', 'H']\nat = [20, 30]\n",
    "C": "[joints.C]\nfrom = 'B'\nlength = 200\nline = { through = 'O4', angle = '0 deg' }\n",
}


def read(text: str) -> Scene:
    return scene_from(tomllib.loads(text), name="my", where="my.toml")


def order(text: str) -> list[str]:
    return [joint.name for joint in read(text).linkage.joints]


def test_the_press_is_read_as_it_is_described() -> None:
    scene = load("press")
    joints = scene.linkage.by_name
    down = joints["O7"]
    assert isinstance(down, Pin)
    assert down.polar == Polar(330.0, -1.8757053471183058)
    assert down.position == pytest.approx((-99.0681, -314.7785), abs=1e-4)
    assert joints["A"] == Crank("A", "O2", 55.0)
    assert joints["D"] == Crank("D", "O7", 61.0, Gear("A", Fraction(-1), -1.2662363723218861))
    assert joints["B"] == RRR("B", ("A", "D"), (283.0, 165.0), 1)
    assert joints["C"] == RRP("C", "B", 322.0, Line("O2", math.pi / 2), -1)
    assert joints["H"] == Rigid("H", ("A", "B"), (140.0, 45.0))
    assert [body.name for body in scene.linkage.bodies] == ["2", "3", "4", "5", "6", "7"]
    assert scene.linkage.bodies[3] == Body("5", slider="C")
    assert scene.linkage.springs == (Spring("return", ("C", "G"), 4000.0, 280.0),)
    assert scene.linkage.dampers == (Damper("cushion", ("H", "S"), 200.0),)
    assert scene.linkage.drive == Drive("A", 2 * math.pi / 3, 0.0, at_zero=True)


def test_a_slotted_bar_turns_about_a_fixed_pin() -> None:
    slot = "[joints.P]\nslot = { pivot = 'O4', through = 'A', offset = -5 }\nlength = 300\n"
    assert read(PINS + JOINTS["A"] + slot).linkage.by_name["P"] == RPR("P", "O4", "A", 300.0, -5.0)


def test_a_yoke_slides_along_its_line_and_can_be_edited() -> None:
    line = "line = { through = 'O2', angle = '30 deg', offset = 4 }"
    text = PINS + JOINTS["A"] + f"[joints.Y]\nslide = {{ pin = 'A', {line}, slot = '80 deg' }}\n"
    scene = read(text + "[bodies]\nyoke = { slider = 'Y' }\n")
    angle, slot = math.radians(30), math.radians(80)
    assert scene.linkage.by_name["Y"] == RPP("Y", "A", Line("O2", angle, 4.0), slot)
    assert read(text.replace(", slot = '80 deg'", "")).linkage.by_name["Y"] == RPP(
        "Y", "A", Line("O2", angle, 4.0), math.pi / 2
    )
    keys = [item.key for item in dimensions(scene) if item.key[:2] == ("joints", "Y")]
    lasts = (("slot",), ("line", "angle"), ("line", "offset"))
    assert keys == [("joints", "Y", "slide", *last) for last in lasts]
    moved = with_dimensions(scene, {("joints", "Y", "slide", "line", "offset"): 6.0})
    assert moved.linkage.by_name["Y"].stated_lengths == (6.0,)


@given(st.permutations(sorted(JOINTS)))
@pytest.mark.slow
def test_each_joint_comes_after_those_it_is_found_from(names: list[str]) -> None:
    found = order(PINS + "".join(JOINTS[name] for name in names))
    assert set(found) == {"O2", "O4", *JOINTS}
    for before, after in (("A", "B"), ("B", "H"), ("H", "K"), ("B", "C"), ("O4", "A")):
        assert found.index(before) < found.index(after)


def test_joints_that_can_stand_as_written_do() -> None:
    assert order(PINS + "".join(JOINTS[name] for name in "ABCHK")) == ["O2", "O4", *"ABCHK"]
    assert order(PINS + "".join(JOINTS[name] for name in "ABHKC")) == ["O2", "O4", *"ABHKC"]


def test_a_chain_of_as_many_joints_as_there_can_be_is_read_when_written_backwards() -> None:
    points = [f"[joints.p{i}]\non = ['A', '{f'p{i - 1}' if i else 'B'}']\nat = [1, 2]\n" for i in range(62)]
    assert order(PINS + "".join(reversed(points)) + JOINTS["B"] + JOINTS["A"])[-1] == "p61"


@pytest.mark.parametrize(
    "members",
    [
        ["A", "B", "H"],
        # K is on the coupler too, though by way of H.
        ["H", "K"],
        # The fixed pins are one body, the frame.
        ["O2", "O4"],
        ["B", "C"],
    ],
)
def test_joints_of_one_rigid_body_may_be_drawn_as_one(members: list[str]) -> None:
    text = PINS + "".join(JOINTS.values()) + f"[bodies]\nx = {{ joints = {members} }}\n"
    assert read(text).linkage.bodies == (Body("x", tuple(members)),)


def test_a_dyad_may_brace_two_points_of_one_body() -> None:
    braced = "[joints.T]\nfrom = ['A', 'H']\nlength = [40, 40]\n"
    assert order(PINS + JOINTS["A"] + JOINTS["B"] + JOINTS["H"] + braced)[-1] == "T"


def test_a_file_says_little_and_the_rest_is_usual() -> None:
    scene = read(PINS + JOINTS["A"] + JOINTS["B"])
    assert (scene.title, scene.source, scene.length_unit, scene.trace) == ("my", "", "mm", ())
    assert scene.linkage.drive == Drive("A", 2 * math.pi / 3, 0.0)


def test_the_first_free_crank_is_driven_wherever_the_geared_one_stands() -> None:
    geared = (
        "[joints.D]\ncrank = 'O4'\nlength = 9\ngear = { with = 'A', ratio = '-1/3', offset = '10 deg' }\n"
    )
    scene = read(PINS + geared + JOINTS["A"])
    assert scene.linkage.drive.joint == "A"
    assert [joint.name for joint in scene.linkage.joints] == ["O2", "O4", "A", "D"]


# a dyad may name the fixed pin first: its side then turns over, its class does not
@pytest.mark.parametrize(
    ("ends", "lengths", "side", "called"),
    [
        (["A", "O4"], [4, 2], "left", "parallelogram"),
        (["O4", "A"], [2, 4], "right", "parallelogram"),
        (["A", "O4"], [4, 2], "right", "antiparallelogram"),
        (["O4", "A"], [2, 4], "left", "antiparallelogram"),
    ],
)
def test_a_class_does_not_hang_on_which_end_is_named_first(
    ends: list[str], lengths: list[float], side: str, called: str
) -> None:
    document = {
        "drive": {"start": "30 deg"},
        "ground": {"O2": [0, 0], "O4": [4, 0]},
        "joints": {
            "A": {"crank": "O2", "length": 2},
            "B": {"from": ends, "length": lengths, "side": side},
        },
    }
    assert scene_from(document, name="my", where="my").info.class_name == called


def _slider(**more: object) -> Scene:
    document = {
        "ground": {"O": [0, 0]},
        "joints": {
            "A": {"crank": "O", "length": 2},
            "B": {"from": "A", "length": 6, "line": {"through": "O"}, **more},
        },
    }
    return scene_from(document, name="my", where="my")


def test_a_slider_has_no_other_keys_than_its_own() -> None:
    with pytest.raises(SceneError, match="unknown key"):
        _slider(size="backward")


def test_a_closure_that_is_not_named_is_the_first_of_the_two() -> None:
    assert closure_name(_slider()) == "forward"
    assert closure_name(_slider(side="backward")) == "backward"


def test_bars_that_cannot_meet_on_one_body_are_told_what_would_do() -> None:
    document = {
        "ground": {"O2": [0, 0], "O4": [100, 0]},
        "joints": {
            "A": {"crank": "O2", "length": 30},
            "C": {"from": ["O2", "O4"], "length": [20, 50]},
        },
    }
    with pytest.raises(AssemblyError, match="100 mm apart on one rigid body, and 30 to 70 mm would do"):
        scene_from(document, name="my", where="my")


def test_a_ground_angle_follows_its_pin_as_an_angle() -> None:
    links = {"ground": 100, "crank": 30, "coupler": 90, "rocker": 80, "ground_angle": "10 deg"}
    scene = scene_from({"four-bar": links}, name="my", where="my")
    found = {handle.key: handle for handle in handles(scene, "O4")}
    assert found["four-bar", "ground_angle"].angle
    assert not found["four-bar", "ground"].angle


@pytest.mark.parametrize(("n", "ends"), [(1, ("O2", "A")), (2, ("A", "B")), (3, ("O4", "B"))])
def test_a_six_bar_s_length_measures_its_bar(n: int, ends: tuple[str, str]) -> None:
    key = ("six-bar", "lengths", n)
    assert stretches(load("six-bar"), key) == (Stretch(ends, 0, 1, key),)
