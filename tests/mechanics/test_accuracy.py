"""No pose is off by more than a few last digits, and no rate either, wherever the input stands."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from build import four_bar, six_bar, slider_crank, slotted
from mpmath import mp, mpf
from numpy.typing import NDArray
from reference import (
    DIGITS,
    HIGHEST_FIRST,
    NUDGE,
    ExactFourBar,
    FourBar,
    Points,
    Pose,
    derivatives,
    on_line,
    sign_of,
    unit,
)

from linkanim.bench.reference import crossing
from linkanim.mechanics.linkage import Crank, Drive, Gear, Linkage, Pin
from linkanim.mechanics.motion import Mechanism, Motion, mechanism
from linkanim.mechanics.solver.closing import Touch
from linkanim.mechanics.solver.input import Swing
from linkanim.scenes import load

EPS = 2.0**-52
POSITION = 16 * EPS
RATE = 128 * EPS

AROUND = np.linspace(0.013, 12.5, 16)
AT_LIMITS = [
    0.0,
    *(10.0**-k for k in (3, 6, 9, 12)),
    *(math.pi + s * 10.0**-k for k in (3, 6, 9, 12) for s in (1, -1)),
    math.pi,
]
CLOSE = np.geomspace(1e-9, 3.0, 1500)
DENSE = np.concatenate([np.linspace(0, 4 * np.pi, 3001), CLOSE, np.pi - CLOSE])


@pytest.fixture(autouse=True)
def many_digits() -> Any:
    with mp.workdps(DIGITS):
        yield


@dataclass(frozen=True)
class Case:
    name: str
    bar: FourBar
    phases: Sequence[float] = (*AROUND, *AT_LIMITS)


CASES = [
    # Every class of Grashof's, on both closures and on tilted ground.
    Case("crank-rocker", FourBar((100, 30, 90, 80))),
    Case("crank-rocker, crossed", FourBar((100, 30, 90, 80), side=-1)),
    Case("crank-rocker on tilted ground", FourBar((100, 30, 90, 80), ground_angle=0.5, start=0.3)),
    Case("drag-link", FourBar((30, 60, 70, 80))),
    Case("double-rocker", FourBar((100, 80, 30, 90))),
    Case("double-rocker, crossed", FourBar((100, 80, 30, 90), side=-1)),
    Case("double-rocker, range below the ground line", FourBar((100, 80, 30, 90), start=-1.0)),
    Case("the same, tilted", FourBar((100, 80, 30, 90), start=-1.0, ground_angle=0.4)),
    # The four triple-rockers: the longest link is the ground, the input, the output, the coupler.
    Case("triple-rocker, outward/outward", FourBar((100, 80, 60, 50))),
    Case("triple-rocker, outward/inward", FourBar((70, 100, 60, 50))),
    Case("triple-rocker, inward/outward", FourBar((70, 60, 50, 100))),
    Case("triple-rocker, inward/inward", FourBar((60, 70, 100, 50))),
    Case("swing through a change point", FourBar((100, 90, 60, 50))),
    # Ground as long as the crank: the pins nearly meet at the limits, or at the middle of the swing.
    Case("pins a fourteenth apart at the limits", FourBar((14, 14, 14, 15))),
    Case("pins a thousandth apart at the limits", FourBar((10, 10, 14, 14.01))),
    Case("pins 1e-12 apart in the middle of the swing", FourBar((5, 5 + 1e-12, 3, 3))),
    # Through change points: none is stalled at, jumped at, or NaN.
    Case("parallelogram", FourBar((4, 2, 4, 2), start=1.0)),
    Case("antiparallelogram", FourBar((4, 2, 4, 2), side=-1, start=1.0)),
    Case("parallelogram from its change point", FourBar((4, 2, 4, 2))),
    Case("one change point at 0", FourBar((4, 2, 5, 3), start=1.0)),
    Case("one change point at 180", FourBar((5, 2, 4, 3), start=1.0)),
    Case("kite", FourBar((3, 3, 5, 5), start=1.0)),
    Case("kite with short bars, swinging through it", FourBar((5, 5, 3, 3))),
    Case("rhombus", FourBar((3, 3, 3, 3), start=1.0)),
    # Decimal lengths with s + l = p + q whose sums are off in binary by a last digit.
    Case("change point from decimals, 0.5 0.1 0.4 0.2", FourBar(("0.5", "0.1", "0.4", "0.2"), start=0.2)),
    Case("change point from decimals, 0.7 0.3 0.6 0.4", FourBar(("0.7", "0.3", "0.6", "0.4"), start=0.3)),
    # A hair from a change point, on either side of it: real gaps, not rounding.
    Case("1e-12 above a change point at 0", FourBar((4, 2, 5, 3 + 1e-12))),
    Case("1e-12 below a change point at 0", FourBar((4, 2, 5, 3 - 1e-12))),
    Case("1e-12 above a change point at 180", FourBar((5, 2, 4, 3 + 1e-12))),
    Case("1e-12 below a change point at 180", FourBar((5, 2, 4, 3 - 1e-12))),
    Case("1e-12 from a parallelogram", FourBar((4, 2, 4, 2 + 1e-12))),
    Case("1e-12 from a parallelogram, the other way", FourBar((4, 2, 4 + 1e-12, 2))),
    Case("1e-12 from a kite", FourBar((3, 3 + 1e-12, 5, 5))),
    # Size does not matter, nor do unequal sizes.
    Case("a short crank and rocker on bars a million times longer", FourBar((1e6, 1, 1e6, 1.5))),
    Case("the same with a slim margin", FourBar((1e6, 1, 999999, 2.5))),
    *(
        Case(f"lengths times {scale:g}", FourBar((100 * scale, 30 * scale, 90 * scale, 80 * scale)))
        for scale in (1e12, 1e-12, 1e80, 1e-80)
    ),
    Case("lengths times 1e80 on tilted ground", FourBar((1e82, 3e81, 9e81, 8e81), ground_angle=0.5)),
    # Far along: sines of large angles, and the ground's angle taken off them.
    Case("after a million turns", FourBar((100, 30, 90, 80)), tuple(2e6 * math.pi + AROUND)),
    Case(
        "after a thousand million turns on tilted ground",
        FourBar((100, 30, 90, 80), ground_angle=0.7, start=0.3),
        tuple(2e9 * math.pi + AROUND),
    ),
]


def worst(values: NDArray[np.float64], reference: Sequence[Any], scale: float) -> float:
    """The greatest distance from the reference in units of `scale`; infinite where a value is NaN."""
    errors = [
        float(abs(mp.mpc(float(x), float(y)) - z) / mpf(scale)) if math.isfinite(x + y) else math.inf
        for (x, y), z in zip(values, reference, strict=True)
    ]
    return max(errors)


def check(
    solved: Mechanism,
    pose: Pose,
    phases: Sequence[float],
    longest: float,
    *,
    rate: float = RATE,
    position: float = POSITION,
) -> None:
    motion = solved.solve(phase=np.array(phases), speed=1.0)
    cycle = solved.solve(phase=DENSE, speed=1.0)
    found = [derivatives(pose, mpf(float(phase)) + NUDGE) for phase in phases]
    for order, kind in HIGHEST_FIRST:
        for name in found[0][0]:
            reference = [derivative[order][name] for derivative in found]
            scale = longest if order == 0 else greatest(getattr(cycle, kind)[name])
            error = worst(getattr(motion, kind)[name], reference, scale)
            assert error <= (rate if order else position), f"{kind} of {name}: {error / EPS:.1f} eps"


def greatest(vectors: NDArray[np.float64]) -> float:
    return float(np.nanmax(np.hypot(vectors[..., 0], vectors[..., 1])))


@pytest.mark.thinned(3)
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_four_bar_poses_and_rates_are_right_to_the_last_digits(case: Case) -> None:
    bar = case.bar
    linkage = four_bar(bar.floats, side=bar.side, ground_angle=bar.ground_angle, start=bar.start)
    check(mechanism(linkage), bar.pose(), case.phases, max(bar.floats))


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_single_pose_is_the_same_as_one_of_many(case: Case) -> None:
    bar = case.bar
    solved = mechanism(four_bar(bar.floats, side=bar.side, ground_angle=bar.ground_angle, start=bar.start))
    motion = solved.solve(phase=np.array(case.phases), speed=1.0)
    cycle = solved.solve(phase=DENSE, speed=1.0)
    for kind in ("position", "velocity", "acceleration"):
        scale = max(greatest(getattr(cycle, kind)[name]) for name in "ABP")
        for index, phase in enumerate(case.phases):
            pose = getattr(solved.pose(phase, 1.0, 0.0, 2), kind)
            for name in "ABP":
                assert np.allclose(pose[name], getattr(motion, kind)[name][index], rtol=0, atol=RATE * scale)


SLIDERS = [
    # Crank, rod, offset: in line, offset to either side, and the two that only swing.
    ("in line", (40.0, 120.0, 0.0), 1, None),
    ("offset above", (40.0, 120.0, 20.0), 1, None),
    ("offset below, backward", (40.0, 120.0, -20.0), -1, None),
    ("rod as long as the crank: passes its change points", (40.0, 40.0, 0.0), 1, "both"),
    ("offset that the rod just reaches: a change point", (40.0, 60.0, 20.0), 1, "down"),
    ("crank longer than the rod: swings", (60.0, 40.0, 0.0), 1, "swing"),
    ("offset too large to turn: swings", (40.0, 60.0, 50.0), 1, "swing"),
]


@pytest.mark.parametrize(("name", "sizes", "side", "kind"), SLIDERS, ids=[row[0] for row in SLIDERS])
def test_slider_poses_and_rates_are_right_to_the_last_digits(
    name: str, sizes: tuple[float, float, float], side: int, kind: str | None
) -> None:
    crank, rod, offset = map(mpf, sizes)
    solved = mechanism(slider_crank(*sizes, side=side, start=1.0))
    limits = _slider_limits(crank, rod, offset) if kind == "swing" else None

    def pose(phase: Any) -> Points:
        angle, sign = 1 + phase, side
        if limits is not None:
            angle = sum(limits) / 2 - (limits[1] - limits[0]) / 2 * mp.cos(phase)
            sign *= sign_of(mp.sin(phase))
        if kind == "both":
            sign *= sign_of(mp.cos(angle))
        if kind == "down":
            sign *= sign_of(mp.sin(angle / 2 + mp.pi / 4))
        pin = crank * unit(angle)
        return {"A": pin, "B": on_line(pin, rod, offset, sign)}

    check(solved, pose, (*AROUND, *AT_LIMITS), float(max(crank, rod)))


def _slider_limits(crank: Any, rod: Any, offset: Any) -> tuple[Any, Any]:
    """The swing that contains 1 rad or lies above: where the rod stands straight across the line."""
    top, bottom = (offset + rod) / crank, (offset - rod) / crank
    if bottom <= -1:
        return mp.pi - mp.asin(top), 2 * mp.pi + mp.asin(top)
    if top >= 1:
        return mp.asin(bottom), mp.pi - mp.asin(bottom)
    return mp.asin(bottom), mp.asin(top)


SLOTS = [
    ("swinging lever", (100.0, 40.0, 120.0, 0.0), None),
    ("turning lever", (40.0, 100.0, 120.0, 0.0), None),
    ("slot beside its pivot", (100.0, 40.0, 120.0, 15.0), None),
    ("slot through its own pivot: half the crank's turn", (50.0, 50.0, 120.0, 0.0), "half"),
    ("offset that the pin cannot always clear: swings", (100.0, 70.0, 120.0, 50.0), "swing"),
    ("crank as long as the ground, a slot beside its pivot", (50.0, 50.0, 120.0, 1.0), "swing"),
]


@pytest.mark.parametrize(("name", "sizes", "kind"), SLOTS, ids=[row[0] for row in SLOTS])
def test_slot_poses_and_rates_are_right_to_the_last_digits(
    name: str, sizes: tuple[float, float, float, float], kind: str | None
) -> None:
    ground, crank, length, offset = map(mpf, sizes)
    start = 1.0
    solved = mechanism(slotted(*sizes, start=start))
    cosine = (ground**2 + crank**2 - offset**2) / (2 * ground * crank)

    def pose(phase: Any) -> Points:
        angle, sign = start + phase, 1
        if kind == "swing":
            low, high = mp.acos(cosine), 2 * mp.pi - mp.acos(cosine)
            angle = (low + high) / 2 - (high - low) / 2 * mp.cos(phase)
            sign = sign_of(mp.sin(phase))
        if kind == "half":
            sign = sign_of(mp.sin(angle / 2))
        pin = crank * unit(angle)
        way = pin - ground
        square = abs(way) ** 2 - offset**2
        slide = sign * mp.sqrt(square) if square > 0 else mpf(0)
        return {"A": pin, "P": ground + length * way / mp.mpc(slide, offset)}

    check(solved, pose, (*AROUND, *AT_LIMITS), float(max(ground, crank, length)))


CHAINS = [
    # Second loop too short on one side of the first: it limits the input at both ends.
    ("both limits from the second loop", (100.0, 30.0, 90.0, 80.0), (120.0, 60.0, 90.0, 80.0), 0.0),
    # The input of a double-rocker, stopped within its range at both ends, then at one only.
    (
        "both limits within a double-rocker's range",
        (100.0, 80.0, 30.0, 90.0),
        (120.0, 60.0, 110.0, 50.0),
        1.0,
    ),
    ("one limit from the second loop", (100.0, 80.0, 30.0, 90.0), (120.0, 60.0, 116.0, 50.0), 1.0),
]


@pytest.mark.parametrize(("name", "first", "second", "start"), CHAINS, ids=[row[0] for row in CHAINS])
def test_a_dyad_down_the_chain_limits_the_input_and_is_driven_through(
    name: str,
    first: tuple[float, float, float, float],
    second: tuple[float, float, float, float],
    start: float,
) -> None:
    solved = mechanism(six_bar(first, second, start=start))
    path = solved.assembly.path
    assert isinstance(path, Swing)
    g, r, a, b = map(mpf, first)
    r5, r6, r7, r8 = map(mpf, second)

    def chain(angle: Any, side: int = 1) -> tuple[Any, Any, Any]:
        pin_a = r * unit(angle)
        pin_b = crossing(pin_a, mp.mpc(g), a, b, side)
        return pin_a, pin_b, g + (pin_b - g) / b * r6

    def margin(angle: Any) -> Any:
        return abs(chain(angle)[2] - g - r5) - (r7 + r8)

    own = ExactFourBar(first, start=start).limits
    limits = [
        mp.findroot(margin, (mpf(end.high), mpf(end.high) + mpf(10) ** -10)) if dyad == "D" else exact
        for end, exact, dyad in zip((path.low, path.high), own or (0, 0), path.ends, strict=True)
    ]

    def pose(phase: Any) -> Points:
        kept = path.ends[0] == "B"  # which the second loop does not pass: it comes back by the way it went
        phase = 4 * mp.pi - phase if kept and phase > 2 * mp.pi else phase
        side = sign_of(mp.sin(phase / 2)) if kept else 1
        pins = chain(sum(limits) / 2 - (limits[1] - limits[0]) / 2 * mp.cos(phase), side)
        sign = 1
        if path.ends[0] == "D":
            sign *= sign_of(mp.sin(phase / 2))
        if path.ends[1] == "D":
            sign *= sign_of(mp.cos(phase / 2))
        joint = crossing(pins[2], mp.mpc(g + r5), r7, r8, sign)
        return {"A": pins[0], "B": pins[1], "C": pins[2], "D": joint}

    check(solved, pose, (*AROUND, *AT_LIMITS), 120.0, position=1e-13, rate=1e-10)


NEAR = [10.0**-k for k in range(3, 13)]
LIMITED = [
    ("triple-rocker", FourBar((100, 80, 60, 50))),
    ("inward triple-rocker, limits near 0", FourBar((60, 70, 100, 50))),
    ("double-rocker", FourBar((100, 80, 30, 90))),
    ("double-rocker below", FourBar((100, 80, 30, 90), start=-1.0)),
    ("tilted double-rocker", FourBar((100, 80, 30, 90), ground_angle=1.1, start=2.0)),
]


@pytest.mark.parametrize(("name", "bar"), LIMITED, ids=[row[0] for row in LIMITED])
@pytest.mark.parametrize("turns", [0, 3, -1_000_000], ids=lambda turns: f"{turns} turns on")
def test_angles_next_to_a_limit_give_exact_poses_and_rates(name: str, bar: FourBar, turns: int) -> None:
    solved = mechanism(four_bar(bar.floats, side=bar.side, ground_angle=bar.ground_angle, start=bar.start))
    limits = bar.level.limits
    assert limits is not None
    low, high = (float(limit + mpf(bar.ground_angle)) for limit in limits)
    way = 2 * math.pi * turns
    # The float nearest a limit stands for the limit itself: far along, that is a wide float.
    ways = [d for d in NEAR if d > 8 * np.spacing(abs(way))]
    angles = np.array([*(low + d for d in ways), *(high - d for d in ways)]) + way
    inside = [
        limits[0] < mpf(float(x)) - 2 * mp.pi * turns - mpf(bar.ground_angle) < limits[1] for x in angles
    ]
    motion = solved.solve(angle=angles, speed=1.0)
    fixed = replace(bar, start=0.0)

    def pose(angle: Any) -> Points:
        g, r, a, b = map(mpf, bar.floats)
        pin = r * unit(angle - mpf(bar.ground_angle))
        tilt = unit(mpf(fixed.ground_angle))
        return {"B": crossing(pin, mp.mpc(g), a, b, bar.side) * tilt}

    for index, angle in enumerate(angles):
        if not inside[index]:
            assert np.isnan(motion.position["B"][index]).all()
            continue
        found = derivatives(pose, mpf(float(angle)))
        assert worst(motion.position["B"][[index]], [found[0]["B"]], max(bar.floats)) <= POSITION
        for order, kind in ((1, "velocity"), (2, "acceleration")):
            reference = found[order]["B"]
            value = getattr(motion, kind)["B"][[index]]
            assert worst(value, [reference], float(abs(reference))) <= RATE, kind


@pytest.mark.parametrize(("name", "bar"), LIMITED, ids=[row[0] for row in LIMITED])
def test_at_a_limit_the_pose_is_there_and_unbounded_rates_are_infinite(name: str, bar: FourBar) -> None:
    solved = mechanism(four_bar(bar.floats, side=bar.side, ground_angle=bar.ground_angle, start=bar.start))
    path = solved.assembly.path
    assert isinstance(path, Swing)
    motion: Motion = solved.solve(angle=[float(path.low), float(path.high)], speed=1.0)
    assert np.isfinite(motion.position["B"]).all()
    assert np.isinf(motion.angular_velocity["rocker"]).all()
    assert np.isinf(motion.angular_acceleration["rocker"]).all()
    assert np.isfinite(motion.velocity["A"]).all()
    assert not np.isnan(motion.velocity["B"]).any()


@pytest.mark.parametrize(("name", "bar"), LIMITED, ids=[row[0] for row in LIMITED])
def test_outside_the_range_every_quantity_is_nan(name: str, bar: FourBar) -> None:
    solved = mechanism(four_bar(bar.floats, side=bar.side, ground_angle=bar.ground_angle, start=bar.start))
    path = solved.assembly.path
    assert isinstance(path, Swing)
    angles = [float(path.low) - 1e-12, float(path.high) + 1e-12, float(path.high) + 0.05]
    motion = solved.solve(angle=angles, speed=1.0)
    for mapping in (motion.position, motion.velocity, motion.angular_velocity):
        for joint, values in mapping.items():
            if joint not in ("O2", "O4"):
                assert np.isnan(values).all(), joint


TOUCHING = [
    # A drag-link's output drives a second loop whose two bars fall into line twice, or once, a turn.
    ("a parallelogram down the chain", (40.0, 20.0, 40.0, 20.0), 1),
    ("one change point down the chain", (40.0, 20.0, 45.0, 25.0), 2),
]


@pytest.mark.parametrize(("name", "second", "periods"), TOUCHING, ids=[row[0] for row in TOUCHING])
def test_change_points_down_the_chain_are_passed_smoothly(
    name: str, second: tuple[float, float, float, float], periods: int
) -> None:
    solved = mechanism(six_bar((30, 60, 70, 80), second))
    assert solved.periods == periods
    (root,) = solved.assembly.chain.values()
    places = [float(zero.place) for zero in root.zeros if isinstance(zero, Touch)]
    around = np.concatenate([angle + np.linspace(-1e-3, 1e-3, 2001) for angle in places])
    phases = np.concatenate([np.linspace(0, 2 * np.pi * periods, 20001), around])
    motion = solved.solve(phase=phases, speed=1.0)
    for kind in ("position", "velocity"):
        assert np.isfinite(getattr(motion, kind)["D"]).all()
    # Position and velocity go on with no step through each change point.
    for index in range(len(places)):
        part = slice(20001 + 2001 * index, 20001 + 2001 * (index + 1))
        fastest = np.abs(motion.velocity["D"]).max()
        assert np.abs(np.diff(motion.velocity["D"][part], axis=0)).max() <= 1e-4 * fastest
        assert np.abs(np.diff(motion.position["D"][part], 2, axis=0)).max() <= 2e-8 * 80
    # The crank's angle and the pose alike: one at a time gives the same.
    for angle in places:
        pose = solved.pose(angle, 1.0, 0.0, 2)
        beside = solved.pose(angle + 1e-7, 1.0, 0.0, 2)
        assert pose.velocity["D"] == pytest.approx(beside.velocity["D"], abs=1e-4 * fastest)


def test_the_press_s_rates_are_slopes_to_more_digits_than_asked() -> None:
    solved = mechanism(load("press").linkage)
    degree = mp.pi / 180

    def pose(angle: Any) -> Points:
        a = 55 * unit(angle)
        d = 330 * unit(mpf("-107.47") * degree) + 61 * unit(-angle - mpf("72.55") * degree)
        b = crossing(a, d, mpf(283), mpf(165), 1)
        # The slider's line stands upright: a quarter turn makes it the horizontal one.
        c = on_line(b * -1j, mpf(322), mpf(0), -1) * 1j
        return {"A": a, "D": d, "B": b, "C": c, "H": a + (b - a) / 283 * mp.mpc(140, 45)}

    check(solved, pose, tuple(AROUND), 330.0, position=1e-14, rate=1e-13)


def test_the_six_bar_s_rates_are_slopes_to_more_digits_than_asked() -> None:
    first, second = (100.0, 30.0, 90.0, 80.0), (130.0, 60.0, 110.0, 90.0)
    solved = mechanism(six_bar(first, second))

    def pose(angle: Any) -> Points:
        a = 30 * unit(angle)
        b = crossing(a, mp.mpc(100), mpf(90), mpf(80), 1)
        c = 100 + (b - 100) * mpf(60) / 80
        return {"A": a, "B": b, "C": c, "D": crossing(c, mp.mpc(230), mpf(110), mpf(90), 1)}

    check(solved, pose, tuple(AROUND), 130.0, position=1e-14, rate=1e-13)


# Ratio × angle has more digits than a float, and far along they count.
@pytest.mark.parametrize("ratio", [Fraction(1, 3), Fraction(-7, 3), Fraction(7, 4), Fraction(3)], ids=str)
@pytest.mark.parametrize("turns", [0, 1_000, 1_000_000], ids=lambda turns: f"{turns} turns on")
@pytest.mark.parametrize(
    ("start", "offset"), [(0.7, 0.3), (0.0, 0.0)], ids=["set off", "from the ground line"]
)
def test_a_geared_crank_stands_where_its_gears_put_it_however_far_along(
    ratio: Fraction, turns: int, start: float, offset: float
) -> None:
    linkage = Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("O5", (6.0, 0.0)),
            Crank("A", "O2", 1.0),
            Crank("C", "O5", 1.0, Gear("A", ratio, offset)),
        ),
        Drive("A", 1.0, start),
    )
    phases = 2 * math.pi * turns + np.linspace(0.1, 30.0, 40)
    places = mechanism(linkage).solve(phase=phases, speed=1.0).position["C"]
    reference = [
        6 + unit((start + mpf(float(x))) * ratio.numerator / ratio.denominator + offset) for x in phases
    ]
    assert worst(places, reference, 6.0) <= 2 * EPS


def test_a_slot_whose_pin_lies_on_its_pivot_turns_on_at_half_the_crank_s_speed() -> None:
    here = mechanism(slotted(50, 50, 80)).pose(0.0, 1.0, 0.0, 2)
    assert here.position["P"] == (50.0, 80.0)
    assert here.velocity["P"] == pytest.approx((-40.0, 0.0), abs=1e-14)
