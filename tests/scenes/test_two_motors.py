"""Two motors, each with its own speed: a five-bar closes as forty digits say, in either form of the file."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from linkanim.errors import BadInput
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

C = (1.8885827404763202, 6.143447492670727)
VELOCITY = (1.1623367111312846, 0.41698673301068906)
ACCELERATION = (-2.558503690400744, -3.198893780436609)
"""Of C, at 1 rad/s and 0.3 rad/s² of the first motor, -0.5 rad/s and -0.2 rad/s² of the second."""


def points(speed: str = "-0.5 rad/s", **further: Any) -> dict[str, Any]:
    return {
        "length_unit": "mm",
        "points": {
            "A": [0, 0],
            "G": [6, 0],
            "B": {"from": "A", "length": 2, "angle": "60 deg"},
            "D": {"from": "G", "length": 2.5, "angle": "110 deg"},
            "C": [1.89, 6.14],
        },
        "links": {"ground": ["A", "G"], "a": ["A", "B"], "g": ["G", "D"], "b": ["B", "C"], "d": ["D", "C"]},
        "lengths": {"b": {"B-C": 4.5}, "d": {"D-C": 5}},
        "drive": {"joint": "A", "speed": "1 rad/s"},
        "drives": {"second": {"joint": "G", "speed": speed, **further}},
    }


def joints(speed: str = "-0.5 rad/s", **further: Any) -> dict[str, Any]:
    return {
        "length_unit": "mm",
        "ground": {"A": [0, 0], "G": [6, 0]},
        "joints": {
            "D": {"crank": "G", "length": 2.5},
            "B": {"crank": "A", "length": 2},
            "C": {"from": ["B", "D"], "length": [4.5, 5], "side": "left"},
        },
        "drive": {"joint": "B", "speed": "1 rad/s", "start": "60 deg"},
        "drives": {"second": {"joint": "D", "speed": speed, "start": "110 deg", **further}},
    }


def read(document: dict[str, Any]) -> Scene:
    return scene_from(document, name="my", where="my.toml")


@pytest.mark.parametrize("form", [points, joints])
def test_a_five_bar_with_two_motors_is_closed_as_forty_digits_say(form: Any) -> None:
    scene = read(form())
    found = scene.solve(angle=math.radians(60), speed=1.0, acceleration=0.3)
    assert found.position["C"] == pytest.approx(C, abs=2e-15 * 6)
    assert found.velocity["C"] == pytest.approx(VELOCITY, abs=1e-14)
    # the second motor's own acceleration is -0.2, not -0.5 times 0.3: by how C moves with it alone
    other = read(form("0.5 rad/s")).solve(angle=math.radians(60), speed=1.0)
    alone = other.velocity["C"] - found.velocity["C"]
    assert found.acceleration["C"] + (-0.2 + 0.5 * 0.3) * alone == pytest.approx(ACCELERATION, abs=1e-13)


def test_it_is_told_as_what_it_is() -> None:
    info = read(points()).info
    assert (info.class_name, *info.counts) == ("five-bar with two motors", 5, 5, 2)
    assert read(joints()).linkage.motors == ("D",)
    assert not read(joints()).linkage.forceful


def test_both_are_back_when_the_slower_one_is() -> None:
    long = {"lengths": {"b": {"B-C": 12}, "d": {"D-C": 12}}, "points": points()["points"] | {"C": [5, 13]}}
    scene = read(points() | long)
    assert scene.info.full_turn
    assert scene.info.true_period == 2
    cycle = scene.cycle(4)
    assert np.allclose(np.diff(cycle.angle["g"]), -0.5 * np.diff(cycle.phase))


REFUSED = [
    ("speeds without a ratio", points("0.7071 rad/s"), "drives.second.speed", "would never be back"),
    ("the same joint", joints(joint="B"), "drives.second.joint", "is no crank that is left"),
    ("no crank", joints(joint="C"), "drives.second.joint", "is no crank that is left"),
    ("a pin of moving links", points(joint="B"), "drives.second.joint", "is no fixed point"),
    ("a start beside a pose", points(start="9 deg"), "drives.second.start", "is that of the pose"),
    ("a speed along a line", points("9 mm/s"), "drives.second.speed", "two cranks turn"),
    ("no speed", {**points(), "drives": {"second": {"joint": "G"}}}, "drives.second", "speed"),
]


@pytest.mark.parametrize(
    ("document", "where", "reason"), [row[1:] for row in REFUSED], ids=[row[0] for row in REFUSED]
)
def test_a_second_motor_that_cannot_be_is_one_sentence(
    document: dict[str, Any], where: str, reason: str
) -> None:
    with pytest.raises(BadInput) as refusal:
        read(document)
    assert str(refusal.value).startswith(f"my.toml: {where}")
    assert reason in str(refusal.value)
