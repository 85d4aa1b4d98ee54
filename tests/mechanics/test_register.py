"""The register of quantities: every number under its token, symbol, words, unit and order."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest

from linkanim.errors import BadInput
from linkanim.mechanics.linkage import Body, Drive, Linkage
from linkanim.mechanics.quantities import link_labels, look_up, register
from linkanim.scenes import load, names

# token, symbol, words, unit
TOLD = [
    # a four-bar's links have the textbooks' numbers
    ("crank-rocker", "crank.angle", "θ₂", "Crank: angle", "rad"),
    ("crank-rocker", "coupler.angular_velocity", "ω₃", "Coupler: angular velocity", "rad/s"),
    ("crank-rocker", "rocker.angular_velocity", "ω₄", "Rocker: angular velocity", "rad/s"),
    ("crank-rocker", "rocker.angular_acceleration", "α₄", "Rocker: angular acceleration", "rad/s²"),
    ("crank-rocker", "rocker.coefficient", "h₄", "Rocker: kinematic coefficient", "rad/rad"),
    ("crank-rocker", "rocker.second_coefficient", "h′₄", "Rocker: second kinematic coefficient", "rad/rad²"),
    ("six-bar", "rocker2.angular_velocity", "ω₆", "Rocker2: angular velocity", "rad/s"),
    ("slider-crank", "rod.angle", "θ₃", "Rod: angle", "rad"),
    ("slider-crank", "slider.travel", "s₄", "Slider: travel", "{}"),
    ("slider-crank", "slider.coefficient", "f₄", "Slider: kinematic coefficient", "{}/rad"),
    # bodies that are named by a number keep it
    ("press", "3.angular_velocity", "ω₃", "Link 3: angular velocity", "rad/s"),
    ("press", "5.travel_velocity", "v₅", "Slider C: velocity", "{}/s"),
    ("press", "5.travel_acceleration", "a₅", "Slider C: acceleration", "{}/s²"),
    # a vector has a magnitude and two components; what is no number stands in braces
    ("press", "B.position", "r_{B}", "B: position", "{}"),
    ("press", "B.position.x", "x_{B}", "B: x-position", "{}"),
    ("press", "B.velocity", "v_{B}", "B: velocity", "{}/s"),
    ("press", "B.velocity.y", "v_{By}", "B: y-velocity", "{}/s"),
    ("press", "3.com_acceleration.x", "a_{G3x}", "Link 3, centre of mass: x-acceleration", "{}/s²"),
    ("press", "return.length", "L_{return}", "Return spring: length", "{}"),
    ("press", "return.force", "F_{return}", "Return spring: force", "N"),
    ("press", "cushion.rate", "v_{cushion}", "Cushion damper: rate of length", "{}/s"),
]


@pytest.mark.parametrize(("scene", "token", "symbol", "words", "unit"), TOLD)
def test_a_quantity_has_symbol_words_and_unit(
    scene: str, token: str, symbol: str, words: str, unit: str
) -> None:
    found = register(load(scene).linkage)[token]
    assert (found.token, found.symbol, found.words, found.unit) == (token, symbol, words, unit)


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_no_two_quantities_are_called_the_same(name: str) -> None:
    known = register(load(name).linkage).values()
    assert len({quantity.words for quantity in known}) == len(known)
    assert len({quantity.symbol for quantity in known}) == len(known)


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_order_says_how_a_quantity_grows_with_the_speed(name: str) -> None:
    scene = load(name)
    slow, quick = (scene.solve(phase=[0.7, 2.5, 4.0], speed=speed) for speed in (0.5, -1.5))
    for quantity in register(scene.linkage).values():
        before, after = quantity.read(slow), quantity.read(quick)
        factor = (-3.0) ** quantity.order
        # a spring's part of forces does not grow, a damper's does
        if quantity.token == "input.torque" or quantity.path[:1] == ("reactions",) or "N" in quantity.unit:
            continue
        if quantity.token.endswith(("velocity", "acceleration")) and quantity.symbol[0] in "va":
            before, after, factor = np.abs(before), np.abs(after), abs(factor)  # magnitudes have no sign
        assert after == pytest.approx(before * factor, rel=1e-9, abs=1e-9), quantity.token


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_a_pose_and_a_motion_are_read_alike(name: str) -> None:
    scene = load(name)
    pose, motion = scene.pose(1.3), scene.solve(phase=[1.3])
    for quantity in register(scene.linkage).values():
        assert quantity.read(pose) == pytest.approx(quantity.read(motion)[0], rel=1e-9, abs=1e-9)


def _press(token: str) -> Any:
    scene = load("press")
    return register(scene.linkage)[token].read(scene.solve(angle=[1.1], speed=10.0))[0]


def test_values_are_those_of_the_motion() -> None:
    motion = load("press").solve(angle=[1.1], speed=10.0)
    x, y = motion.velocity["B"][0]
    assert (_press("B.velocity.x"), _press("B.velocity.y")) == (x, y)
    assert _press("B.velocity") == math.sqrt(x * x + y * y)
    assert tuple(_press("B.position")) == tuple(motion.position["B"][0])
    assert _press("3.com_velocity.y") == motion.com_velocity["3"][0, 1]
    assert _press("5.travel_velocity") == motion.travel_velocity["5"][0]
    assert (_press("3.coefficient"), _press("3.second_coefficient")) == tuple(
        part[0] for part in motion.coefficient["3"]
    )
    assert _press("cushion.force") == motion.damper["cushion"].force[0]


def test_people_read_degrees_and_the_scenes_unit() -> None:
    scene = load("press")
    known, pose = register(scene.linkage), scene.pose(1.1)
    assert known["3.angle"].displayed(pose) == pytest.approx(math.degrees(pose.angle["3"]))
    assert known["3.angle"].display_unit("mm") == "°"
    assert known["B.velocity"].display_unit("mm") == "mm/s"
    assert known["B.velocity"].displayed(pose) == known["B.velocity"].read(pose)


# what is asked for, and what is meant by it
MEANT = [
    ("crank-rocker", "rocker.angel", "rocker.angle"),
    ("crank-rocker", "Rocker.Angle", "rocker.angle"),
    ("crank-rocker", "velocity", "P.velocity"),
    ("press", "5.velocity", "5.travel_velocity"),
    ("press", "torque", "input.torque"),
    ("press", "x" * 100_000, "2.A.force.x"),  # whatever is like it, at once
]


@pytest.mark.parametrize(("scene", "token", "meant"), MEANT)
def test_a_wrong_token_is_answered_with_the_ten_nearest(scene: str, token: str, meant: str) -> None:
    known = register(load(scene).linkage)
    with pytest.raises(BadInput) as refused:
        look_up(known, token, scene)
    near = re.findall(r"[\w.]+", str(refused.value).partition("nearest are ")[2].partition("; `")[0])
    assert len(near) == 10
    assert set(near) <= set(known)
    assert meant in near
    assert f"has all {len(known)}" in str(refused.value)


def test_a_number_is_given_once() -> None:
    bodies = tuple(Body(name) for name in ("crank", "4", "rocker", "rod", "coupler", "arm"))
    labels = link_labels(Linkage((), Drive("A", 1.0), bodies))
    assert labels == {
        "crank": "2",
        "4": "4",
        "rocker": "rocker",
        "rod": "3",
        "coupler": "coupler",
        "arm": "arm",
    }


def test_a_crank_turns_with_the_input_at_a_limit_too() -> None:
    assert load("double-rocker").pose(0.0).coefficient["crank"] == (1.0, 0.0)
    assert np.all(load("double-rocker").solve(phase=[0.0, 1.0]).coefficient["crank"][0] == 1.0)


# What counts as level at one speed does so at any: rates' rounding errors grow as they do.
@pytest.mark.parametrize(
    ("token", "order", "unit"),
    [("B.position.x", 0, True), ("B.velocity", 1, True), ("3.angular_acceleration", 2, False)],
)
def test_rounding_grows_with_size_and_speed_as_the_quantity_does(token: str, order: int, unit: bool) -> None:
    scene = load("press")
    known, cycle = register(scene.linkage)[token], scene.cycle(12)
    slow, fast = (known.rounding(scene.solve(phase=cycle.phase, speed=speed)) for speed in (1.0, 300.0))
    extent = scene.linkage.extent
    assert max(np.abs(places).max() for places in cycle.position.values()) <= extent
    assert slow == pytest.approx(1e-13 * (extent if unit else 1.0))
    assert fast == pytest.approx(300.0**order * slow)
