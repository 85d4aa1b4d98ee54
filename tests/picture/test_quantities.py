"""What a chart can show, by name."""

from __future__ import annotations

import math

import numpy as np
import pytest

from linkanim.errors import BadInput
from linkanim.picture import quantities
from linkanim.scenes import Scene, load, names


def series(scene: Scene, token: str, n: int) -> quantities.Series:
    return quantities.series_of(scene, quantities.quantity(scene, token), scene.cycle(n))


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_quantity_has_a_value_at_every_phase(name: str) -> None:
    scene = load(name)
    assert scene.quantities
    for quantity in scene.quantities:
        phases, values, unit, labels = series(scene, quantity, 8)
        assert values.shape == (8, len(labels)), quantity
        assert phases[-1] == pytest.approx(scene.period * 7 / 8)
        at_rest = quantity.endswith(("coefficient", "tangential_acceleration", "curvature_radius"))
        assert not np.isnan(values).any() or at_rest, quantity
        assert unit or quantity == "mechanical_advantage"


@pytest.mark.parametrize(
    ("quantity", "unit"),
    [
        ("3.angle", "°"),
        ("3.angular_velocity", "rad/s"),
        ("3.angular_acceleration", "rad/s²"),
        ("3.coefficient", "rad/rad"),
        ("3.second_coefficient", "rad/rad²"),
        ("3.com_position", "mm"),
        ("3.com_velocity", "mm/s"),
        ("3.com_acceleration", "mm/s²"),
        ("5.travel", "mm"),
        ("5.travel_velocity", "mm/s"),
        ("5.travel_acceleration", "mm/s²"),
        ("5.coefficient", "mm/rad"),
        ("B.position", "mm"),
        ("B.velocity", "mm/s"),
        ("B.acceleration", "mm/s²"),
        ("return.length", "mm"),
        ("return.rate", "mm/s"),
        ("return.force", "N"),
        ("cushion.rate", "mm/s"),
        ("cushion.force", "N"),
    ],
)
def test_the_press_has_each_kind_in_its_unit(quantity: str, unit: str) -> None:
    assert series(load("press"), quantity, 4).unit == unit


def test_values_are_those_of_the_motion() -> None:
    scene = load("press")
    cycle = scene.cycle(5)
    assert series(scene, "3.angle", 5).values[:, 0] == pytest.approx(np.degrees(cycle.angle["3"]))
    speed = np.hypot(*cycle.velocity["B"].T)
    assert series(scene, "B.velocity", 5).values[:, 0] == pytest.approx(speed)
    assert series(scene, "B.position", 5).values == pytest.approx(cycle.position["B"])
    assert series(scene, "2.coefficient", 5).values == pytest.approx(np.ones((5, 1)))


def test_what_is_nothing_but_rounding_errors_is_zero() -> None:
    scene = load("parallelogram")
    assert np.any(scene.cycle(24).angular_velocity["coupler"])
    assert not np.any(series(scene, "coupler.angular_velocity", 24).values)


def test_fixed_pins_and_unknown_forces_are_left_out() -> None:
    assert not any(name.startswith("O2.") for name in load("press").quantities)


def test_a_wrong_name_is_answered_with_the_nearest() -> None:
    with pytest.raises(BadInput, match=r"rocker\.colour.*crank-rocker.*rocker\.angle, .*rocker\.angular_v"):
        series(load("crank-rocker"), "rocker.colour", 4)


def test_an_angle_has_no_jumps() -> None:
    values = series(load("drag-link"), "rocker.angle", 90).values[:, 0]
    assert np.abs(np.diff(values)).max() < 30
    assert abs(values[-1] - values[0]) == pytest.approx(360, abs=math.degrees(0.4))
