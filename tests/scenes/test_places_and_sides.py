"""A place by length and angle, a closure by a place that is near, a slider's speed in length per time."""

from __future__ import annotations

import math
import tomllib

import pytest

from linkanim.errors import BadInput
from linkanim.mechanics.linkage import RRP, RRR, Rigid
from linkanim.scenes.editing import closure_name, in_unit, other_closure
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import text

FOUR_BAR = """
[drive]
start = "60 deg"
[ground]
O2 = [0, 0]
O4 = [100, 0]
[joints.A]
crank = "O2"
length = 30
[joints.B]
from = ["A", "O4"]
length = [90, 80]
near = [%s]
"""
SLIDER = """
[drive]
start = "60 deg"
[ground]
O = [0, 0]
[joints.A]
crank = "O"
length = 30
[joints.B]
from = "A"
length = 90
line = { through = "O", angle = "%s" }
near = [%s]
"""
POINT = FOUR_BAR % "90, 80" + '[joints.P]\non = ["A", "B"]\nat = %s\n'
DRIVEN = """
length_unit = "%s"
[drive]
speed = "%s"
slider = { joint = "C", from = "80 mm", to = "160 mm" }
[ground]
O = [0, 0]
[joints.C]
line = { through = "O", angle = "0 deg" }
[joints.B]
from = ["C", "O"]
length = ["120 mm", "40 mm"]
near = [%s]
"""


def read(written: str) -> Scene:
    return scene_from(tomllib.loads(written), name="my", where="my.toml")


# the closure nearer to the place, by a hair or by far; and what is written of it
@pytest.mark.parametrize(
    ("written", "joint", "side"),
    [
        (FOUR_BAR % "90, 80", "B", 1),
        (FOUR_BAR % "40, -60", "B", -1),
        (FOUR_BAR % "'9 cm', 80", "B", 1),
        (FOUR_BAR.replace('["A", "O4"]', '["O4", "A"]').replace("[90, 80]", "[80, 90]") % "90, 80", "B", -1),
        (SLIDER % ("0 deg", "100, 0"), "B", 1),
        (SLIDER % ("0 deg", "-80, 10"), "B", -1),
        (SLIDER % ("180 deg", "100, 0"), "B", -1),
        (DRIVEN % ("mm", "20 rpm", "0, 40"), "B", -1),
        (DRIVEN % ("mm", "20 rpm", "0, -40"), "B", 1),
    ],
)
def test_the_closure_is_the_one_nearer_to_the_place(written: str, joint: str, side: int) -> None:
    scene = read(written)
    found = scene.linkage.joint(joint)
    assert isinstance(found, RRR | RRP)
    assert found.side == side
    assert "near" not in text(scene)
    assert read(text(scene)).linkage == scene.linkage


def test_the_other_closure_of_it_is_the_other_one() -> None:
    scene = read(FOUR_BAR % "90, 80")
    assert closure_name(scene) == "left"
    assert closure_name(other_closure(scene)) == "right"


def test_a_chain_is_settled_joint_by_joint() -> None:
    further = '[joints.C]\nfrom = ["B", "O2"]\nlength = [70, 60]\nnear = [%s]\n'
    for place, side in (("-50, 50", -1), ("40, -20", 1)):
        joint = read(FOUR_BAR % "90, 80" + further % place).linkage.joint("C")
        assert isinstance(joint, RRR)
        assert joint.side == side


# as a place along and to the left: exact at right angles, else rounded once
@pytest.mark.parametrize(
    ("at", "place"),
    [
        ('{ length = 50, angle = "90 deg" }', (0.0, 50.0)),
        ('{ length = "5 cm", angle = "180 deg" }', (-50.0, 0.0)),
        ('{ length = 50, angle = "30 deg" }', (50 * math.cos(math.pi / 6), 25.0)),
    ],
)
def test_a_place_on_a_body_may_be_a_length_and_an_angle(at: str, place: tuple[float, float]) -> None:
    scene = read(POINT % at)
    point = scene.linkage.joint("P")
    assert isinstance(point, Rigid)
    assert point.at == pytest.approx(place, rel=1e-15, abs=1e-15)
    assert read(text(scene)).linkage == scene.linkage
    assert in_unit(scene, "cm").linkage.joint("P").stated_lengths == pytest.approx(
        [part / 10 for part in place], rel=1e-15, abs=1e-15
    )


@pytest.mark.parametrize(("speed", "metres"), [("10 cm/s", 0.1), ("-200 mm/s", -0.2), ("1 in/s", 0.0254)])
def test_a_sliders_speed_may_be_a_length_in_a_time(speed: str, metres: float) -> None:
    """Its mean speed from one end to the other, whatever the file's unit."""
    for unit in ("mm", "cm"):
        scene = read(DRIVEN % (unit, speed, "0, '40 mm'"))
        half = math.pi / abs(scene.linkage.drive.speed)
        assert 0.08 / half == pytest.approx(abs(metres), rel=1e-14)
        assert math.copysign(1.0, scene.linkage.drive.speed) == math.copysign(1.0, metres)


@pytest.mark.parametrize(
    ("written", "where", "reason"),
    [
        (FOUR_BAR % "90, 80" + 'side = "left"\n', "joints.B.near", "keep one"),
        (FOUR_BAR % "90", "joints.B.near", "list of 2"),
        (FOUR_BAR.replace('start = "60 deg"', 'start = "0 deg"') % "50, 0", "joints.B.near", "beside it"),
        (FOUR_BAR.replace("[90, 80]", "[60, 20]") % "50, 0", "joints.B.near", "another start"),
        (POINT % "{ length = 50 }", "joints.P.at", '"angle" is missing'),
        (POINT % '{ length = 50, angel = "3 deg" }', "joints.P.at.angel", "unknown key"),
        (POINT % '{ length = 0, angle = "3 deg" }', "joints.P.at.length", "above zero"),
        (FOUR_BAR.replace("start", 'speed = "3 cm/s"\nstart') % "9, 8", "drive.speed", "a crank turns"),
        (DRIVEN % ("mm", "0 cm/s", "0, 40"), "drive.speed", "moves nothing"),
    ],
)
def test_what_names_no_closure_or_place_is_one_sentence(written: str, where: str, reason: str) -> None:
    with pytest.raises(BadInput) as refusal:
        read(written)
    assert str(refusal.value).startswith(f"my.toml: {where}")
    assert reason in str(refusal.value)
