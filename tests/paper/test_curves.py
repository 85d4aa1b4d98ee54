"""Curves of a chart and the table that goes with them, held to what the library solves."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from linkanim.errors import BadInput
from linkanim.mechanics.quantities import register
from linkanim.paper.curves import Curves, Pace, curves_of, extremes, table
from linkanim.picture.look import Over
from linkanim.scenes import load

FIVE, TEN = Pace(5.0, "5 rad/s"), Pace(-10.0, "-10 rad/s")


def _curves(name: str, *tokens: str, paces: tuple[Pace, ...] = (FIVE,), over: Over | None = None) -> Curves:
    return curves_of(load(name), tokens, paces, over)


# scene, over, title, from, to
AXES: list[tuple[str, Over | None, str, float, float]] = [
    ("slider-crank", None, "crank angle θ₂ (°)", 0, 360),
    ("kite", "angle", "crank angle θ₂ (°)", 0, 720),
    ("slider-crank", "time", "time (s)", 0, math.tau / 5),
    ("slider-crank", "phase", "phase φ (°)", 0, 360),
    ("double-rocker", None, "time (s)", 0, math.tau / 5),
    ("double-rocker", "angle", "input rocker angle θ₂ (°)", 13.80, 108.39),
    ("double-rocker", "phase", "phase φ (°)", 0, 360),
]


@pytest.mark.parametrize(("name", "over", "title", "low", "high"), AXES)
@pytest.mark.parametrize("pace", [FIVE, TEN])
def test_each_curve_is_the_motion_over_what_was_asked(
    name: str, over: Over | None, title: str, low: float, high: float, pace: Pace
) -> None:
    found = _curves(
        name,
        "coupler.angle" if name != "slider-crank" else "rod.angle",
        "P.velocity.x",
        paces=(pace,),
        over=over,
    )
    scale = abs(FIVE.speed / pace.speed) if title.startswith("time") else 1.0
    assert found.title == title
    assert found.low == pytest.approx(low, abs=0.01)
    assert found.high == pytest.approx(high * scale, abs=0.01)
    for curve in found.curves:
        at = np.linspace(0, len(curve.x) - 1, 23).astype(int)
        motion = found.scene.solve(phase=curve.phases[at], speed=pace.speed)
        turned = np.remainder(curve.values[at] - curve.quantity.displayed(motion) + 180, 360) - 180
        small = (
            turned if curve.quantity.unit == "rad" else curve.values[at] - curve.quantity.displayed(motion)
        )
        assert small == pytest.approx(np.zeros(23), abs=1e-3 * np.ptp(curve.values))
        assert np.abs(np.diff(curve.values)).max() < 0.1 * np.ptp(curve.values)
        places = found.places(curve, motion)
        apart = np.remainder(places - curve.x[at] + found.high / 2, found.high) - found.high / 2
        assert apart == pytest.approx(np.zeros(23), abs=1e-9 * found.high)


def test_a_swing_s_limits_are_marked_on_a_curve_over_time_and_on_no_two_that_differ() -> None:
    one = _curves("double-rocker", "rocker.angle", over="time")
    assert len(one.marks) > 0
    assert _curves("double-rocker", "rocker.angle", paces=(FIVE, TEN), over="time").marks == ()


def test_a_curve_is_named_by_what_sets_it_off() -> None:
    one = _curves("press", "3.angular_velocity")
    assert [one.words(curve) for curve in one.curves] == ["Link 3: angular velocity ω₃"]
    paced = _curves("press", "3.angular_velocity", paces=(FIVE, TEN))
    assert [paced.words(curve) for curve in paced.curves] == ["5 rad/s", "−10 rad/s"]
    both = _curves("press", "3.angular_velocity", "B.position", paces=(FIVE, TEN))
    assert both.words(both.curves[0]) == "Link 3: angular velocity ω₃, 5 rad/s"
    assert both.words(both.curves[-1]) == "B: position r_{B}, y, −10 rad/s"


def test_extremes_are_where_the_motion_has_them() -> None:
    found = _curves("press", "5.travel")
    high, low = extremes(found.scene, found.curves[0])
    for peak, turn in ((high, max), (low, min)):
        near = found.scene.solve(angle=np.radians(peak.angle + np.linspace(-1, 1, 2001)), speed=5.0)
        assert peak.value == pytest.approx(turn(near.travel["5"]), abs=1e-6)
        speed = found.scene.solve(angle=math.radians(peak.angle), speed=5.0).travel_velocity["5"]
        assert abs(speed) < 1e-3
        assert peak.x == pytest.approx(peak.angle)
    assert high.value - low.value == pytest.approx(found.scene.info.stroke, rel=1e-9)


def test_an_extreme_of_a_crank_that_runs_back_stands_at_its_time() -> None:
    found = _curves("press", "5.travel", paces=(TEN,), over="time")
    drawn = found.curves[0]
    for peak in extremes(found.scene, drawn):
        assert np.interp(peak.x, drawn.x, drawn.values) == pytest.approx(peak.value, abs=1e-2)


@pytest.mark.parametrize(
    ("name", "token"), [("crank-rocker", "crank.angular_velocity"), ("crank-rocker", "mechanical_advantage")]
)
def test_what_is_level_or_unbounded_has_no_extremes(name: str, token: str) -> None:
    found = _curves(name, token)
    curve = found.curves[0]
    if token == "mechanical_advantage":
        curve.values[3] = math.inf
    assert extremes(found.scene, curve) == ()


@pytest.mark.parametrize("size", [1e-150, 1e-12, 1e12])
def test_small_and_large_values_have_extremes_as_others_do(size: float) -> None:
    found = _curves("press", "5.travel")
    curve = found.curves[0]
    peaks = extremes(found.scene, curve)
    assert extremes(found.scene, replace(curve, values=curve.values * size)) == peaks
    level = size * (1 + 1e-10 * np.sign(curve.values - curve.values.mean()))
    assert extremes(found.scene, replace(curve, values=level)) == ()


@pytest.mark.parametrize("pace", [FIVE, TEN])
def test_an_angle_s_extremes_stay_in_the_turn_of_the_curve_and_at_its_ends(pace: Pace) -> None:
    found = _curves("drag-link", "rocker.angle", paces=(pace,))
    high, low = extremes(found.scene, found.curves[0])
    assert high.x == pytest.approx(360.0)
    assert low.x == pytest.approx(0.0)
    assert high.value - low.value == pytest.approx(360.0)
    assert high.value == pytest.approx(found.curves[0].values.max())
    rocking = _curves("crank-rocker", "rocker.angle", paces=(pace,))
    high, low = extremes(rocking.scene, rocking.curves[0])
    assert high.value == pytest.approx(rocking.curves[0].values.max(), abs=0.01)
    assert low.value == pytest.approx(rocking.curves[0].values.min(), abs=0.01)
    swinging = _curves("double-rocker", "P.position", over="angle")
    for curve in swinging.curves:
        high, low = extremes(swinging.scene, curve)
        assert 13.79 < low.x < 108.4
        assert curve.values.min() - 0.01 < low.value <= curve.values.min()
        assert low.angle == pytest.approx(low.x, abs=0.01)


def test_a_quantity_named_twice_is_drawn_once_and_none_is_refused() -> None:
    assert len(_curves("press", "5.travel", "5.travel").curves) == 1
    with pytest.raises(BadInput, match="--quantity names none"):
        _curves("press")
    with pytest.raises(BadInput, match=r"5\.travl.*nearest are 5\.travel, "):
        _curves("press", "5.travl")
    with pytest.raises(BadInput, match=r"nearest are B\.velocity, "):
        _curves("press", "B.speed")


def test_the_table_holds_what_is_solved_in_radians() -> None:
    found = _curves("press", "3.angle", "B.position", "cushion.force", paces=(FIVE, TEN))
    names, columns = table(found)
    by_name: dict[str, Any] = dict(zip(names, columns, strict=True))
    assert names[:4] == ["angle_deg", "angle", "phase", "time@5 rad/s"]
    known = register(found.scene.linkage)
    for pace in (FIVE, TEN):
        motion = found.scene.solve(phase=by_name["phase"], speed=pace.speed)
        for token in ("3.angle", "cushion.force"):
            assert by_name[f"{token}@{pace.words}"] == pytest.approx(
                known[token].read(motion), rel=1e-12, abs=1e-12
            )
        assert by_name[f"B.position.y@{pace.words}"] == pytest.approx(motion.position["B"][:, 1])
        assert by_name[f"time@{pace.words}"] * pace.speed == pytest.approx(by_name["phase"])
    assert np.degrees(by_name["angle"]) == pytest.approx(by_name["angle_deg"])
    single, _ = table(_curves("press", "3.angle"))
    assert single == ["angle_deg", "angle", "phase", "time", "3.angle"]


def test_an_extreme_beside_a_cusp_has_a_value() -> None:
    # The astroid's point rests in its cusps, and its path has no direction there.
    scene = load("epicyclic-hypocycloid")
    curve = curves_of(scene, ("E.tangential_acceleration",), (Pace(1.0, "1 rad/s"),)).curves[0]
    peaks = extremes(scene, curve)
    assert len(peaks) == 2
    assert all(np.isfinite([peak.value, peak.x, peak.angle]).all() for peak in peaks)


# What is somewhere unbounded, at an instant or between two, has no greatest value; what is one value none.
@pytest.mark.parametrize(
    ("name", "token"),
    [
        ("crank-rocker", "mechanical_advantage"),
        ("engine", "mechanical_advantage"),
        ("hoecken", "P.curvature_radius"),
        ("watt-line", "P.curvature_radius"),
        ("crank-rocker", "coupler.pole.x"),
        ("double-rocker", "coupler.coefficient"),
        ("double-rocker", "B.curvature_radius"),
        ("triple-rocker-in-out", "B.curvature_radius"),
        ("watt-line", "A.curvature_radius"),
        ("excavator", "stick.length"),
    ],
)
def test_no_extreme_is_marked_of_what_is_unbounded_or_of_one_value(name: str, token: str) -> None:
    scene = load(name)
    (curve,) = curves_of(scene, (token,), (Pace(scene.linkage.drive.speed, ""),)).curves
    assert extremes(scene, curve) == ()


def test_a_curve_is_broken_where_it_goes_through_infinity_between_two_samples() -> None:
    scene = load("crank-rocker")
    (curve,) = curves_of(scene, ("mechanical_advantage",), (Pace(2.0, ""),)).curves
    assert np.isinf(curve.values).sum() == 2
    breaks = curve.phases[np.isinf(curve.values)]
    rates = scene.solve(phase=breaks).angular_velocity["rocker"]
    assert rates == pytest.approx(0.0, abs=1e-12)
    assert (np.diff(curve.x) >= 0).all()
