"""Dyads whose two ends move are as exact as loops: at limits, at change points, where their ends meet."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from build import six_bar
from mpmath import mp, mpf
from reference import DIGITS, NUDGE, Points, Pose, derivatives, sign_of, unit

from linkanim.bench.reference import crossing
from linkanim.mechanics.linkage import RRR, Body, Crank, Drive, Gear, Linkage, Pin
from linkanim.mechanics.motion import Mechanism, mechanism
from linkanim.mechanics.solver.closing import Touch
from linkanim.mechanics.solver.input import Swing

EPS = 2.0**-52
Lengths = tuple[float, float, float, float]
Ends = Callable[[Any], tuple[Any, Any]]
BESIDE = [0.0, *(s * 10.0**-k for k in (2, 4, 6, 8, 10, 12, 14) for s in (1, -1))]
AROUND = np.linspace(0.02, 12.5, 40)


@pytest.fixture(autouse=True)
def many_digits() -> Any:
    with mp.workdps(DIGITS):
        yield


def six_bar_ends(first: Lengths, second: Lengths) -> Ends:
    """C and O6 of a six-bar, C on the line of the first loop's rocker."""
    (g, r, a, b), (r5, r6, *_) = map(mpf, first), map(mpf, second)

    def ends(angle: Any) -> tuple[Any, Any]:
        pin = crossing(r * unit(angle), mp.mpc(g), a, b, 1)
        return g + (pin - g) / b * r6, mp.mpc(g + r5)

    return ends


def geared(
    cranks: tuple[float, float], ground: float, gear: Gear, bars: tuple[float, float], side: int
) -> Linkage:
    """A geared five-bar on two pins on the ground line."""
    return Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("O5", (ground, 0.0)),
            Crank("A", "O2", cranks[0]),
            Crank("C", "O5", cranks[1], gear),
            RRR("D", ("A", "C"), bars, side),
        ),
        Drive("A", 1.0),
        (Body("3", ("A", "D")), Body("4", ("C", "D"))),
    )


def geared_ends(linkage: Linkage) -> Ends:
    _, pivot, first, second, _ = linkage.joints
    assert isinstance(pivot, Pin)
    assert isinstance(first, Crank)
    assert isinstance(second, Crank)
    assert second.gear is not None
    ratio = mpf(second.gear.ratio.numerator) / second.gear.ratio.denominator
    # The float nearest a right angle stands for the right angle.
    offset = mp.pi / 2 if second.gear.offset == math.pi / 2 else mpf(second.gear.offset)

    def ends(angle: Any) -> tuple[Any, Any]:
        return first.length * unit(angle), mpf(pivot.position[0]) + second.length * unit(
            ratio * angle + offset
        )

    return ends


@dataclass(frozen=True)
class Dyad:
    """The dyad D of a mechanism, between two ends that move with the input's angle."""

    solved: Mechanism
    ends: Ends
    lengths: tuple[float, float]
    side: int = 1

    @property
    def touches(self) -> list[float]:
        root = self.solved.assembly.chain["D"]
        return [float(zero.place) for zero in root.zeros if isinstance(zero, Touch)]

    def angle(self) -> Callable[[Any], Any]:
        """The input's angle at a phase, its limits found here from where the solver has them."""
        path = self.solved.assembly.path
        if not isinstance(path, Swing):
            return lambda phase: phase
        assert path.ends == ("D", "D")
        reach = sum(map(mpf, self.lengths)), abs(mpf(self.lengths[0]) - mpf(self.lengths[1]))

        def margin(angle: Any) -> Any:
            p, q = self.ends(angle)
            return (abs(p - q) - reach[0]) * (abs(p - q) - reach[1])

        low, high = (
            mp.findroot(margin, (mpf(end.high), mpf(end.high) + mpf(10) ** -10))
            for end in (path.low, path.high)
        )
        return lambda phase: (low + high) / 2 - (high - low) / 2 * mp.cos(phase)

    def pose(self) -> Pose:
        """A, B and D at a phase, the side of D changing at every limit and change point."""
        angle, swings = self.angle(), isinstance(self.solved.assembly.path, Swing)

        def square(phase: Any) -> Any:
            p, q = self.ends(angle(phase))
            return abs(p - q) ** 2

        places = [mp.findroot(lambda x: mp.diff(square, x), mpf(place), tol=1e-60) for place in self.touches]

        def side(phase: Any) -> int:
            signs = [mp.sin((phase - place) / 2) for place in places] + ([mp.sin(phase)] if swings else [])
            return math.prod(map(sign_of, signs))

        named = self.side * side(mpf(10) ** -8)

        def pose(phase: Any) -> Points:
            p, q = self.ends(angle(phase))
            return {"D": crossing(p, q, mpf(self.lengths[0]), mpf(self.lengths[1]), named * side(phase))}

        return pose


def of_six_bar(first: Lengths, second: Lengths, side: int = 1) -> Dyad:
    solved = mechanism(six_bar(first, second, side=side))
    return Dyad(solved, six_bar_ends(first, second), second[2:], side)


def of_geared(linkage: Linkage) -> Dyad:
    joint = linkage.joint("D")
    assert isinstance(joint, RRR)
    return Dyad(mechanism(linkage), geared_ends(linkage), joint.lengths, joint.side)


DRAG_LINK = (30.0, 60.0, 70.0, 80.0)
LIMITED = geared((1.0, 4.0), 6.0, Gear("A", Fraction(2), math.radians(30)), (7.0, 9.0), 1)
CASES: list[tuple[str, Callable[[], Dyad], int]] = [
    # A drag-link's output drives a second loop whose two bars fall into line twice, or once, a turn.
    ("a parallelogram", lambda: of_six_bar(DRAG_LINK, (40.0, 20.0, 40.0, 20.0)), 2),
    ("one change point, back after two turns", lambda: of_six_bar(DRAG_LINK, (40.0, 20.0, 45.0, 25.0)), 1),
    # The two ends of equal bars meet: any direction would close there, one goes on smoothly.
    ("a kite", lambda: of_six_bar(DRAG_LINK, (40.0, 40.0, 45.0, 45.0)), 1),
    ("a rhombus, folded and stretched", lambda: of_six_bar(DRAG_LINK, (40.0, 40.0, 40.0, 40.0), -1), 2),
    ("limits of a geared five-bar", lambda: of_geared(LIMITED), 0),
    (
        "limits, and change points between them",
        lambda: of_geared(
            geared((55.0, 135.0), 25.0, Gear("A", Fraction(3, 2), math.pi / 2), (155.0, 60.0), -1)
        ),
        2,
    ),
]


@pytest.mark.parametrize(("name", "build", "touches"), CASES, ids=[row[0] for row in CASES])
def test_a_dyad_on_moving_points_is_exact_wherever_it_stands(
    name: str, build: Callable[[], Dyad], touches: int
) -> None:
    dyad = build()
    assert len(dyad.touches) == touches
    centres = dyad.touches if dyad.solved.assembly.path.full_turn else [*dyad.touches, 0.0, math.pi]
    phases = np.array([*AROUND, *(centre + way for centre in centres for way in BESIDE)])
    motion = dyad.solved.solve(phase=phases, speed=1.0)
    pose = dyad.pose()
    found = [derivatives(pose, mpf(float(phase)) + NUDGE) for phase in phases]
    for order, kind, most in ((0, "position", 16), (1, "velocity", 32), (2, "acceleration", 64)):
        values = getattr(motion, kind)["D"]
        scale = max(dyad.lengths) if order == 0 else float(np.abs(values).max())
        reference = np.array([complex(one[order]["D"]) for one in found])
        errors = np.abs(values @ [1, 1j] - reference) / scale / EPS
        assert errors.max() <= most, f"{kind}: {errors.max():.0f} eps at {phases[errors.argmax()]}"


# At 60 degrees and 10 rad/s, 0.06 rad from the limit; half an ulp of the angle moves it by 4e-15.
ALPHA_4 = 2492.42116977644


@pytest.mark.parametrize("by", ["angle", "phase"])
def test_an_acceleration_near_a_limit_has_all_its_digits(by: str) -> None:
    solved, angle = mechanism(LIMITED), math.radians(60)
    at_angle = solved.solve(angle=angle, speed=10.0)
    if by == "angle":
        found = float(at_angle.angular_acceleration["4"])
    else:
        # The phase whose crank stands at the angle, at the rates that give the crank 10 rad/s and no more.
        path = solved.assembly.path
        assert isinstance(path, Swing)
        phase = float(at_angle.phase)
        rate = 10.0 / (path.amplitude * math.sin(phase))
        second = -rate * rate / math.tan(phase)
        found = float(solved.solve(phase=phase, speed=rate, acceleration=second).angular_acceleration["4"])
    assert found == pytest.approx(ALPHA_4, rel=1e-14 if by == "angle" else 3e-14)


def test_bars_at_right_angles_turn_as_exactly_as_elsewhere() -> None:
    # There q is at its greatest, though the dyad's next limit may be what its rates are worked out from.
    dyad = of_geared(geared((2.0, 3.0), 6.0, Gear("A", Fraction(-2), math.radians(50)), (2.0, 6.0), 1))
    square, angle = sum(mpf(length) ** 2 for length in dyad.lengths), dyad.angle()

    def off(phase: Any) -> Any:
        p, q = dyad.ends(angle(phase))
        return abs(p - q) ** 2 - square

    pose, place = dyad.pose(), mp.findroot(off, mpf("2.6276"), tol=1e-30)
    for way in (0.0, 1e-12, 1e-9, 1e-6):
        phase = float(place) + way
        motion = dyad.solved.solve(phase=phase, speed=1.0)
        _, velocity, acceleration = derivatives(pose, mpf(phase))
        for values, true in ((motion.velocity, velocity["D"]), (motion.acceleration, acceleration["D"])):
            assert abs(mp.mpc(*values["D"].tolist()) - true) <= 64 * EPS * max(dyad.lengths)
