"""Values printed by others come out, to the last digit they print."""

from __future__ import annotations

import math

import numpy as np
import pytest
from build import BARS, four_bar, slider_crank

from linkanim.mechanics.linkage import RRR, Crank, Drive, Linkage, Pin
from linkanim.mechanics.motion import mechanism
from linkanim.scenes import load

# Term report on a punch press (Matlab, checked with RecurDyn), tables 3.1 and 3.2: crank at 87 degrees
# and 10 rad/s. Lengths in mm; the report's slider values are in metres.
PRESS = [
    ("angular_velocity", "3", 3.3271, 4),
    ("angular_velocity", "4", -1.2005, 4),
    ("angular_velocity", "6", -5.4143, 4),
    ("travel_velocity", "5", -132.8, 1),
    ("angular_acceleration", "3", 12.7419, 4),
    ("angular_acceleration", "4", -11.3763, 4),
    ("angular_acceleration", "6", -14.2372, 4),
    ("travel_acceleration", "5", -2770.8, 1),
]


@pytest.mark.parametrize(("kind", "body", "printed", "digits"), PRESS)
def test_the_press_has_its_report_s_values(kind: str, body: str, printed: float, digits: int) -> None:
    motion = load("press").solve(angle=math.radians(87), speed=10.0)
    assert getattr(motion, kind)[body] == pytest.approx(printed, abs=0.5 * 10.0**-digits)


def test_the_press_moves_as_its_report_s_charts_say() -> None:
    motion = load("press").solve(angle=np.radians(np.arange(0, 360, 0.25)), speed=10.0)
    degrees = np.arange(0, 360, 0.25)
    travel = motion.travel["5"]
    assert degrees[travel.argmax()] == pytest.approx(71, abs=0.5)
    assert degrees[travel.argmin()] == pytest.approx(316.5, abs=0.5)
    for body, changes in (("3", (53.5, 239.5)), ("6", (52.5, 227.5))):
        omega = motion.angular_velocity[body]
        assert degrees[np.flatnonzero(np.diff(np.sign(omega)))] == pytest.approx(changes, abs=0.5)


# PMKS_Verification reference data v1, teaching_four_bar (MATLAB).
PMKS_BAR = Linkage(
    (
        Pin("O2", (0.0, 0.0)),
        Pin("O4", (4.572, 0.0)),
        Crank("A", "O2", 1.52),
        RRR("B", ("A", "O4"), (math.hypot(4.23 - 1.52, 3.029), math.hypot(4.23 - 4.572, 3.029))),
    ),
    Drive("A", 1.0),
    BARS,
)
OMEGA = 1.0796606752836921


def test_the_pmks_four_bar_comes_out() -> None:
    motion = mechanism(PMKS_BAR).solve(angle=np.radians([0.0, 45.0]), speed=OMEGA)
    assert motion.position["B"] == pytest.approx(
        np.array([[4.23, 3.029], [4.6281814704479354, 3.0477284397364395]]), abs=1e-12
    )
    assert motion.velocity["B"] == pytest.approx(
        np.array([[1.6287169468742273, 0.18389606993429686], [-0.5214633681471802, 0.0096125948838719742]]),
        abs=1e-12,
    )
    assert motion.acceleration["B"] == pytest.approx(
        np.array([[-2.2579278443726185, -1.1418778409864705], [-2.4112064366197679, -0.04480429468604058]]),
        abs=1e-12,
    )
    assert motion.angular_velocity["coupler"][1] == pytest.approx(-0.32386332482963981, abs=1e-12)
    assert motion.angular_velocity["rocker"][1] == pytest.approx(0.17109902619548187, abs=1e-12)
    assert motion.angular_acceleration["coupler"] == pytest.approx(
        [-0.09819336662115119, 0.39821043736560696], abs=1e-12
    )
    assert motion.angular_acceleration["rocker"] == pytest.approx(
        [0.77808194018514543, 0.79060906463316627], abs=1e-12
    )


# PMKS_Verification reference data v1, teaching_slider_crank (MATLAB); the crank's pivot at (13.79, 10.01).
PMKS_SLIDER = [
    (90, -0.97, -6.0246322317891465, -2.4590917024602086),
    (120, -2.9974267174409395, -5.885339896730434, 3.5738190007256496),
    (180, -5.263808579223241, 0.0, 11.907604937218782),
]


@pytest.mark.parametrize(("degrees", "x", "v", "a"), PMKS_SLIDER)
def test_the_pmks_slider_crank_comes_out(degrees: float, x: float, v: float, a: float) -> None:
    linkage = slider_crank(3.81, 15.243808579223238, 0.0, side=-1)
    motion = mechanism(linkage).solve(angle=math.radians(degrees), speed=1.5812683023068625)
    assert motion.position["B"][0] + 13.79 == pytest.approx(x, abs=1e-12)
    assert motion.velocity["B"][0] == pytest.approx(v, abs=1e-12)
    assert motion.acceleration["B"][0] == pytest.approx(a, abs=1e-12)
    if degrees == 120:
        assert motion.angular_velocity["rod"] == pytest.approx(-0.20240758937279996, abs=1e-12)
        assert motion.angular_acceleration["rod"] == pytest.approx(-0.54527827483637747, abs=1e-12)


def test_a_textbook_s_crank_rocker_comes_out() -> None:
    # A standard problem (40, 120, 80, 100 at 40 degrees, 25 rad/s, 15 rad/s2), recomputed in high precision.
    motion = mechanism(four_bar((100, 40, 120, 80))).solve(
        angle=math.radians(40), speed=25.0, acceleration=15.0
    )
    assert math.degrees(motion.angle["coupler"]) == pytest.approx(20.297882788, abs=1e-9)
    assert math.degrees(motion.angle["rocker"]) == pytest.approx(57.324880070, abs=1e-9)
    assert motion.angular_velocity["coupler"] == pytest.approx(-4.120914415, abs=1e-9)
    assert motion.angular_velocity["rocker"] == pytest.approx(6.997985242, abs=1e-9)
    assert motion.angular_acceleration["coupler"] == pytest.approx(296.089193174, abs=1e-9)
    assert motion.angular_acceleration["rocker"] == pytest.approx(470.133530261, abs=1e-9)


def test_a_textbook_s_offset_slider_comes_out() -> None:
    # A standard problem (40, 120, offset -20 at 60 degrees, -30 rad/s), recomputed in high precision;
    # its rod angle is that of the vector from the slider to the crank pin.
    motion = mechanism(slider_crank(40, 120, -20)).solve(angle=math.radians(60), speed=-30.0)
    assert math.degrees(motion.angle["rod"]) % 180 == pytest.approx(152.913071522, abs=1e-9)
    assert motion.travel["slider"] == pytest.approx(126.838005195, abs=1e-9)
    assert motion.angular_velocity["rod"] == pytest.approx(5.615979060, abs=1e-9)
    assert motion.travel_velocity["slider"] == pytest.approx(1346.093287, abs=1e-6)
    assert motion.travel_acceleration["slider"] == pytest.approx(-6305.907538, abs=1e-6)
