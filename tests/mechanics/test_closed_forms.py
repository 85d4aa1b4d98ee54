"""Where the motion has a closed form, it comes out."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from build import four_bar, slider_crank, slotted

from linkanim.mechanics.analysis import Info
from linkanim.mechanics.linkage import RRR
from linkanim.mechanics.motion import mechanism

TURN = np.linspace(-7.0, 7.0, 201)


def test_a_slotted_lever_turns_as_its_closed_form_says() -> None:
    a, d, omega = 40.0, 100.0, 3.0
    motion = mechanism(slotted(d, a, 120.0)).solve(angle=TURN, speed=omega)
    square = a**2 + d**2 - 2 * a * d * np.cos(TURN)
    assert motion.angular_velocity["slotted"] == pytest.approx(
        omega * (a**2 - a * d * np.cos(TURN)) / square, rel=1e-13, abs=1e-14
    )
    assert motion.angular_acceleration["slotted"] == pytest.approx(
        omega**2 * a * d * np.sin(TURN) * (d**2 - a**2) / square**2, rel=1e-13, abs=1e-14
    )


def test_the_ends_of_two_bars_may_be_stated_in_either_order() -> None:
    linkage = four_bar((100, 30, 90, 80))
    other = RRR("B", ("O4", "A"), (80, 90), -1)
    turned = replace(linkage, joints=(*linkage.joints[:3], other, *linkage.joints[4:]))
    found, expected = (mechanism(one).solve(angle=TURN, speed=2.0) for one in (turned, linkage))
    for kind in ("position", "velocity", "acceleration"):
        assert getattr(found, kind)["B"] == pytest.approx(getattr(expected, kind)["B"], abs=1e-10)


def test_a_scotch_yoke_is_the_limit_of_a_long_rod() -> None:
    # x - rod -> r cos t as the rod grows; the difference falls as r²/(2 rod).
    r, rod, omega = 1.0, 1e8, 2.0
    motion = mechanism(slider_crank(r, rod, 0.0)).solve(angle=TURN, speed=omega)
    assert motion.travel_velocity["slider"] == pytest.approx(-r * omega * np.sin(TURN), abs=1e-7)
    assert motion.travel_acceleration["slider"] == pytest.approx(-r * omega**2 * np.cos(TURN), abs=1e-7)


def test_a_parallelogram_s_coupler_never_turns() -> None:
    motion = mechanism(four_bar((4, 2, 4, 2), start=1.0)).solve(angle=TURN, speed=5.0)
    assert np.abs(motion.angular_velocity["coupler"]).max() <= 1e-14
    assert motion.angular_velocity["rocker"] == pytest.approx(5.0, rel=1e-14)


def test_a_rod_as_long_as_the_crank_runs_twice_its_way_or_not_at_all() -> None:
    forward = mechanism(slider_crank(40, 40, 0.0)).solve(angle=TURN, speed=1.0)
    assert forward.travel["slider"] == pytest.approx(80 * np.cos(TURN), abs=1e-12)
    still = mechanism(slider_crank(40, 40, 0.0, side=-1)).solve(angle=TURN, speed=1.0)
    assert np.abs(still.travel["slider"]).max() <= 1e-13


SLIDERS = [(40.0, 120.0, 0.0), (40.0, 120.0, 20.0), (40.0, 120.0, -20.0), (30.0, 100.0, 65.0)]


@pytest.mark.parametrize(("crank", "rod", "offset"), SLIDERS)
def test_stroke_and_time_ratio_are_those_of_the_dead_centres(crank: float, rod: float, offset: float) -> None:
    # Term report on a mechanism simulator: stroke and time ratio of an offset slider-crank.
    info = Info(mechanism(slider_crank(crank, rod, offset)), "mm")
    far, near = math.sqrt((crank + rod) ** 2 - offset**2), math.sqrt((rod - crank) ** 2 - offset**2)
    lean = abs(math.asin(offset / (rod - crank)) - math.asin(offset / (rod + crank)))
    assert info.stroke == pytest.approx(far - near, rel=1e-13)
    assert info.time_ratio == pytest.approx((math.pi + lean) / (math.pi - lean), rel=1e-8)


def test_the_transmission_angle_is_least_or_greatest_where_the_crank_lies_on_the_ground_line() -> None:
    g, r, a, b = 100.0, 30.0, 90.0, 80.0
    info = Info(mechanism(four_bar((g, r, a, b))), "mm")
    ends = [math.acos((a * a + b * b - (g + s * r) ** 2) / (2 * a * b)) for s in (-1, 1)]
    worst = min(*ends, *(math.pi - end for end in ends))
    assert info.transmission_angle == pytest.approx((worst, math.pi / 2), rel=1e-13)
