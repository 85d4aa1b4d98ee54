"""A pin in the slot of a sliding bar, against its closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest
from build import with_joints
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from linkanim.mechanics.analysis import Info
from linkanim.mechanics.linkage import RPP, RRP, Body, Crank, Drive, Line, Linkage, Pin
from linkanim.mechanics.motion import mechanism

EPS = 2.0**-52
ANGLES = np.concatenate([np.linspace(-7.0, 7.0, 141), np.arange(5) * (math.pi / 2), [1e6, -1e9]])


def yoke(crank: float, line: Line, slot: float = math.pi / 2) -> Linkage:
    return Linkage(
        (Pin("O2", (0.0, 0.0)), Crank("A", "O2", crank), RPP("Y", "A", line, slot)),
        Drive("A", 1.0),
        (Body("crank", ("O2", "A")), Body("yoke", slider="Y")),
    )


def test_the_yoke_goes_as_the_cosine() -> None:
    motion = mechanism(yoke(60.0, Line("O2", 0.0))).solve(angle=ANGLES, speed=3.0, acceleration=0.5)
    with mp.workdps(50):
        sine, cosine = ([f(mpf(float(angle))) for angle in ANGLES] for f in (mp.sin, mp.cos))
        exact = {
            "travel": [60 * c for c in cosine],
            "travel_velocity": [-180 * s for s in sine],
            "travel_acceleration": [-540 * c - 30 * s for s, c in zip(sine, cosine, strict=True)],
        }
        for (name, values), size in zip(exact.items(), (60, 180, 541), strict=True):
            found = getattr(motion, name)["yoke"]
            errors = [abs(mpf(float(x)) - y) for x, y in zip(found, values, strict=True)]
            assert max(errors) <= 2 * EPS * size, name


# An oblique slot, a tilted line beside its pin, and both turned past a right angle.
@pytest.mark.parametrize(
    ("angle", "offset", "slot"),
    [(0.0, 0.0, math.radians(60)), (0.7, 12.0, math.pi / 2), (2.5, -7.0, math.radians(120))],
)
def test_the_slot_crosses_the_line_in_the_joint(angle: float, offset: float, slot: float) -> None:
    motion = mechanism(yoke(60.0, Line("O2", angle, offset), slot)).solve(angle=ANGLES[:141], speed=2.0)
    along, across = (np.array([math.cos(a), math.sin(a)]) for a in (angle, angle + slot))
    place, way = motion.position["Y"], motion.position["A"] - motion.position["Y"]
    assert np.abs(along[0] * place[:, 1] - along[1] * place[:, 0] - offset).max() <= 1e-13 * 60
    assert np.abs(across[0] * way[:, 1] - across[1] * way[:, 0]).max() <= 1e-13 * 60
    assert place @ along == pytest.approx(motion.travel["yoke"], abs=1e-13 * 60)


@given(st.floats(0.1, 3.0), st.floats(-3.0, 3.0), st.floats(-20.0, 20.0), st.floats(0.0, 6.0))
@pytest.mark.slow
def test_its_rates_are_those_of_its_travel(slot: float, angle: float, offset: float, phase: float) -> None:
    solved, step = mechanism(yoke(5.0, Line("O2", angle, offset), slot)), 1e-5
    before, here, after = (solved.pose(phase + k * step, 1.0, 0.0, 2) for k in (-1, 0, 1))
    lean = 5.0 / abs(math.sin(slot))
    rate = (after.travel["yoke"] - before.travel["yoke"]) / (2 * step)
    second = (after.travel_velocity["yoke"] - before.travel_velocity["yoke"]) / (2 * step)
    assert here.travel_velocity["yoke"] == pytest.approx(rate, abs=1e-8 * (lean + abs(offset)))
    assert here.travel_acceleration["yoke"] == pytest.approx(second, abs=1e-8 * lean)


def test_lengths_out_of_a_floats_middle_range_scale_with_the_yoke() -> None:
    small, large = (
        mechanism(yoke(2.0 * size, Line("O2", 0.3, size), 1.0)).solve(angle=ANGLES[:20], speed=1.0)
        for size in (1.0, 2.0**300)
    )
    assert (large.travel["yoke"] == small.travel["yoke"] * 2.0**300).all()


def test_a_rod_may_hang_on_the_yoke() -> None:
    linkage = with_joints(yoke(60.0, Line("O2", 0.0)), RRP("C", "Y", 100.0, Line("O2", math.pi / 2)))
    place = mechanism(linkage).solve(phase=np.linspace(0, 6, 50), speed=1.0).position
    assert np.hypot(*(place["C"] - place["Y"]).T) == pytest.approx(100.0)


def test_what_is_told_of_it() -> None:
    info = Info(mechanism(yoke(60.0, Line("O2", 0.0))), "mm")
    assert (info.class_name, info.full_turn) == ("Scotch yoke", True)
    assert info.stroke == pytest.approx(120.0)
    assert info.time_ratio == pytest.approx(1.0)
    oblique = Info(mechanism(yoke(60.0, Line("O2", 0.0), 1.0)), "mm")
    assert oblique.class_name == "Scotch yoke, oblique slot"
    assert oblique.stroke == pytest.approx(120.0 / math.sin(1.0))
