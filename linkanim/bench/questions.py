"""Make the questions that every method has to answer: linkages, their easy cycle and their hard cases.

Its parts, in reading order:

- A question to every method: the poses of a linkage along a sequence of inputs, as plain steps.
- The linkages that are compared, and the easy cycle and the hard cases of each, as yet unsolved.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping
from dataclasses import field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import RRP, RRR, Crank, Linkage, Pin, Rigid
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

# A question to every method: the poses of a linkage along a sequence of inputs, as plain steps.

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Places = Mapping[str, Any]
"""The place of each joint: a complex number or an array of them; NaN where a method has no answer."""
Orders = tuple[Places, ...]
"""Positions, then velocities and accelerations where a method gives them."""
TURN = 2 * math.pi


class TurnStep(NamedTuple):
    """A crank pin: its angle is `ratio` times the input's, plus `offset`."""

    name: str
    pivot: str
    length: float
    ratio: float = 1.0
    offset: float = 0.0

    def place(self, at: Places, angle: Any, exp: Callable[[Any], Any]) -> Any:
        """Return where it lies at an input's angle."""
        return at[self.pivot] + self.length * exp(1j * (self.ratio * angle + self.offset))


class SlideStep(NamedTuple):
    """A bar to a slider on a line through `base`; side +1 is the place further along the line."""

    name: str
    end: str
    length: float
    base: complex
    along: complex
    side: int


class FixedStep(NamedTuple):
    """A point of a body: `at` is along the line from first to second joint, and to its left."""

    name: str
    on: tuple[str, str]
    at: complex
    length: float

    def place(self, at: Places) -> Any:
        """Return where it lies by the places of the two joints, or a derivative by theirs."""
        first, second = (at[name] for name in self.on)
        return first + (second - first) * (self.at / self.length)


Step = TurnStep | RRR | SlideStep | FixedStep
Dyad = RRR | SlideStep
Closing = Callable[[Dyad, Places], Any]
"""A function for the place of a dyad's joint, by the places of earlier ones."""


class DyadChain(NamedTuple):
    """Pins on the ground, and the steps in the order in which they can be taken."""

    pins: Mapping[str, complex]
    steps: tuple[Step, ...]

    @property
    def dyads(self) -> tuple[Dyad, ...]:
        """The steps that have two closures."""
        return tuple(step for step in self.steps if isinstance(step, RRR | SlideStep))

    def joints_at(self, angle: Any, close: Closing, exp: Callable[[Any], Any] = np.exp) -> dict[str, Any]:
        """Return where the joints lie at an input's angle, dyads' as `close` gives them.

        `exp` is the exponential function for these numbers: complex arrays, single ones, or with many digits.
        """
        at: dict[str, Any] = dict(self.pins)
        for step in self.steps:
            match step:
                case TurnStep():
                    at[step.name] = step.place(at, angle, exp)
                case FixedStep():
                    at[step.name] = step.place(at)
                case _:
                    at[step.name] = close(step, at)
        return at


def chain_of(linkage: Linkage) -> DyadChain:
    """Return a linkage of pins, cranks, two kinds of dyads on fixed lines, and points of bodies as steps."""
    lengths = {frozenset((end, joint.name)): length for joint in linkage.joints for end, length in joint.bars}
    pins: dict[str, complex] = {}
    steps: list[Step] = []
    for joint in linkage.joints:
        match joint:
            case Pin():
                pins[joint.name] = complex(*joint.position)
            case Crank():
                gear = (float(joint.gear.ratio), joint.gear.offset) if joint.gear else (1.0, 0.0)
                steps.append(TurnStep(joint.name, joint.pivot, joint.length, *gear))
            case RRR():
                steps.append(joint)
            case RRP():
                along = cmath.rect(1.0, joint.line.angle)
                base = pins[joint.line.through] + 1j * along * joint.line.offset
                steps.append(SlideStep(joint.name, joint.end, joint.length, base, along, joint.side))
            case Rigid():
                length = lengths[frozenset(joint.on)]
                steps.append(FixedStep(joint.name, joint.on, complex(*joint.at), length))
    return DyadChain(pins, tuple(steps))


@frozen
class Question:
    """A scene, its chain, and a sequence of inputs.

    `angles` are the input's. `phases` are the drive's, for methods that take them; for a turning input they
    equal the angles. Rates are by the phase, or if `by_angle` by the angle; `rates` are the angle's first and
    second derivative by it. `sides` is the prescribed closure of each dyad at each pose: constant, but the
    other one on the way back of a swinging input. `start` is the first pose, for methods that start from the
    previous one. `shown` are the joints that count, `longest` is the longest link, and `periods` the number
    of turns after which the motion repeats.
    """

    scene: Scene
    chain: DyadChain
    angles: Floats
    phases: Floats
    rates: tuple[Floats, Floats]
    sides: Mapping[str, Floats]
    start: Mapping[str, complex]
    shown: tuple[str, ...]
    longest: float
    periods: int = 1
    by_angle: bool = False


def longest_of(linkage: Linkage) -> float:
    """Return the longest link, the ground between two pins included."""
    pins = [complex(*pin.position) for pin in linkage.pins]
    grounds = (abs(one - other) for one in pins for other in pins)
    return max(*(length for joint in linkage.joints for _, length in joint.bars), *grounds)


def circle_dyad(dyad: Dyad, at: Places, side: Any, root: Callable[[Any], Any] = np.sqrt) -> Any:
    """Go along the line of centres, then √(r² - x²) to the side; for a circle and a line likewise.

    Paul Bourke, Circles and spheres (1997). `root` is the square root for these numbers.
    """
    if isinstance(dyad, RRR):
        p, q = (at[end] for end in dyad.ends)
        (a, b), way = dyad.lengths, q - p
        distance = abs(way)
        along = (a**2 - b**2 + distance * distance) / (2 * distance)
        return p + way / distance * (along + 1j * (side * root(a**2 - along * along)))
    seen = (at[dyad.end] - dyad.base) * dyad.along.conjugate()
    return dyad.base + dyad.along * (seen.real + side * root(dyad.length**2 - seen.imag**2))


def joined(vectors: Floats) -> Complexes:
    """Return vectors (..., 2) as complex numbers."""
    numbers: Complexes = vectors[..., 0] + 1j * vectors[..., 1]
    return numbers


# The linkages that are compared, and the easy cycle and the hard cases of each, as yet unsolved.

Lengths = tuple[float, float, float, float]
Swing = Callable[[Any], tuple[Any, Any]]
"""A function that computes, with mpmath, the ends of an input that swings."""


@frozen
class Case:
    """A scene and its inputs: crank angles, or phases where `by_phase`.

    `flips` are the phases at which a dyad on the smooth path changes its closure: in half turns of the phase,
    within the first `periods` turns; just after 0 it has the closure that the scene names. `swing` computes
    the ends of an input that swings. If `decimal`, the exact lengths are the written decimals, not the floats
    nearest to them.
    """

    name: str
    scene: Scene
    inputs: Floats
    flips: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    swing: Swing | None = None
    by_phase: bool = False
    periods: int = 1
    decimal: bool = False

    @property
    def by_angle(self) -> bool:
        """Whether an input that swings is given by its angle."""
        return self.swing is not None and not self.by_phase


@frozen
class CaseSet:
    """A kind of linkage: its easy cycle, and its hard cases."""

    name: str
    easy: Case
    hard: tuple[Case, ...]

    @property
    def cases(self) -> tuple[Case, ...]:
        """All of them, the easy one first."""
        return self.easy, *self.hard


def degrees(first: int, last: int) -> Floats:
    """Return every whole degree from first to last, without the last, in radians."""
    return np.radians(np.arange(first, last, dtype=np.float64))


def with_neighbours(inputs: Floats, *places: float) -> Floats:
    """Return inputs with further ones on both sides of some places, at distances from 1e-2 to 1e-12."""
    steps = np.logspace(-2, -12, 11)
    added = [place + steps * side for place in places for side in (-1, 1)]
    return np.unique(np.concatenate([inputs, *added]))


def turned(turns: float) -> Floats:
    """Return every whole degree, in radians, of the turn that begins after `turns` turns."""
    return turns * TURN + degrees(0, 360)


def approaching(limit: float) -> Floats:
    """Return angles that approach a limit to 1e-12 rad, three to a decade."""
    return limit - np.logspace(-1, -12, 34)


def four_bar(lengths: Lengths, assembly: str = "open") -> Scene:
    """Return a four-bar (ground, crank, coupler, rocker) with a coupler point; it starts at angle 0."""
    names = ("ground", "crank", "coupler", "rocker")
    point = [0.5 * lengths[2], 0.25 * lengths[2]]
    table = dict(zip(names, lengths, strict=True))
    return _scene({"four-bar": {**table, "coupler_point": point, "assembly": assembly}})


def slider_crank(crank: float, rod: float, offset: float) -> Scene:
    """Return a slider-crank with a point of its rod; it starts at angle 0, the slider in front."""
    point = [0.5 * rod, 0.25 * rod]
    table = {"crank": crank, "rod": rod, "offset": offset, "coupler_point": point}
    return _scene({"slider-crank": table})


def six_bar(first: Lengths, second: Lengths) -> Scene:
    """Return two four-bars in series: the rocker of the first is the crank of the second."""
    ground, crank, coupler, rocker = second
    return _scene({"six-bar": {"lengths": [*first, ground, crank, coupler, rocker]}})


def _scene(document: Mapping[str, Any]) -> Scene:
    drive = {"speed": "1 rad/s", "start": "0 deg"}
    return scene_from({"length_unit": "m", "drive": drive, **document}, name="bench", where="bench")


def built_in(name: str) -> Scene:
    """Return a scene of the catalogue with its input starting at angle 0, at 1 rad/s."""
    scene = load(name)
    drive = replace(scene.linkage.drive, start=0.0, speed=1.0)
    return replace(scene, linkage=replace(scene.linkage, drive=drive))


def stretched(lengths: Lengths) -> Swing:
    """Return the swing of a crank between the two poses in which coupler and rocker are in line."""
    return lambda mp: (-_in_line(mp, lengths, 1), _in_line(mp, lengths, 1))


def between(lengths: Lengths) -> Swing:
    """Return the swing of a double-rocker above its ground line: folded at first, stretched at last."""
    return lambda mp: (_in_line(mp, lengths, -1), _in_line(mp, lengths, 1))


def _in_line(mp: Any, lengths: Lengths, sign: int) -> Any:
    """Return the crank's angle with coupler and rocker in line, stretched (`sign` +1) or folded (-1)."""
    g, r, a, b = map(mp.mpf, lengths)
    return mp.acos((g * g + r * r - (a + sign * b) ** 2) / (2 * g * r))


def upright(crank: float, rod: float) -> Swing:
    """Return the swing of a slider-crank whose rod is shorter than its crank: at both ends it is upright."""
    return lambda mp: (-mp.asin(mp.mpf(rod) / crank), mp.asin(mp.mpf(rod) / crank))


ONE_TURN = with_neighbours(degrees(90, 450), TURN / 2, TURN)
TWO_TURNS = with_neighbours(degrees(90, 810), TURN / 2, TURN, 3 * TURN / 2, 2 * TURN)
AT_BOTH = AT_LIMITS = {"B": (0.0, 1.0)}

EASY: Lengths = (100.0, 30.0, 90.0, 80.0)
SQUARE: Lengths = (4.0, 2.0, 4.0, 2.0)
SWINGS: Lengths = (5.0, 4.0, 3.0, 3.5)
"""r3 + r4 < r1 + r2: the input swings between ± TOGGLE."""
TOGGLE = 2 * math.acos(math.sqrt((9.0**2 - 6.5**2) / (4 * 5.0 * 4.0)))
ROCKERS: Lengths = (5.0, 3.5, 2.0, 4.0)
CHANGES: Lengths = (5.0, 2.0, 4.0, 3.0)
"""r1 + r2 = r3 + r4: a change point at half a turn."""


def _limited(scene: Scene, limit: float, swing: Swing) -> tuple[Case, Case]:
    """Return two cases of a swinging input: towards a limit, and through both limits."""
    return (
        Case("1e-12 rad before a toggle", scene, approaching(limit), AT_LIMITS, swing),
        Case("through two limits", scene, ONE_TURN, AT_LIMITS, swing, by_phase=True),
    )


def _after(scene: Scene, *powers: int) -> tuple[Case, ...]:
    """Return cases of one turn each, after ten to these powers of turns."""
    return tuple(Case(f"after 1e{power} turns", scene, turned(10.0**power)) for power in powers)


FOUR_BAR = CaseSet(
    "four-bar",
    Case("easy cycle", four_bar(EASY), degrees(0, 360)),
    (
        Case("parallelogram", four_bar(SQUARE), ONE_TURN, AT_BOTH),
        Case("antiparallelogram", four_bar(SQUARE, "crossed"), ONE_TURN, AT_BOTH),
        Case("change point at 0", four_bar((4.0, 2.0, 5.0, 3.0)), TWO_TURNS, {"B": (0, 2)}, periods=2),
        Case("change point at 180 deg", four_bar(CHANGES), TWO_TURNS, {"B": (1, 3)}, periods=2),
        Case(
            "s + l = p + q in decimals",
            four_bar((1.2, 0.3, 0.7, 0.8)),
            TWO_TURNS,
            {"B": (1, 3)},
            periods=2,
            decimal=True,
        ),
        Case("1e-12 from a change point", four_bar((5.0, 2.0, 4.0, 3.0 + 1e-12)), ONE_TURN),
        *_limited(four_bar(SWINGS), TOGGLE, stretched(SWINGS)),
        Case("double-rocker", four_bar(ROCKERS), ONE_TURN, AT_LIMITS, between(ROCKERS), True),
        *_after(four_bar(EASY), 6, 9),
    ),
)

QUARTERS = with_neighbours(degrees(0, 360), TURN / 4, 3 * TURN / 4)

SLIDER_CRANK = CaseSet(
    "slider-crank",
    Case("easy cycle", slider_crank(40.0, 120.0, 20.0), degrees(0, 360)),
    (
        Case("rod as long as the crank", slider_crank(50.0, 50.0, 0.0), QUARTERS, {"B": (0.5, 1.5)}),
        Case("1e-12 from a change point", slider_crank(5.0, 5.0 + 1e-12, 0.0), QUARTERS),
        *_limited(slider_crank(50.0, 40.0, 0.0), math.asin(0.8), upright(50.0, 40.0)),
        *_after(slider_crank(40.0, 120.0, 20.0), 9),
    ),
)

AFTER: Lengths = (6.0, 1.0, 5.0, 4.0)
"""The lengths of a second loop that closes at every pose of the first one."""

SIX_BAR = CaseSet(
    "six-bar",
    Case("easy cycle", built_in("six-bar"), degrees(0, 360)),
    (
        Case(
            "two change points in series",
            six_bar(SQUARE, CHANGES),
            TWO_TURNS,
            {"B": (0, 1, 2, 3), "D": (1, 3)},
            periods=2,
        ),
        *_limited(six_bar(SWINGS, AFTER), TOGGLE, stretched(SWINGS)),
        *_after(built_in("six-bar"), 9),
    ),
)

PRESS = CaseSet(
    "press",
    Case("easy cycle", built_in("press"), degrees(0, 360)),
    _after(built_in("press"), 6, 9),
)

MECHANISMS = (FOUR_BAR, SLIDER_CRANK, SIX_BAR, PRESS)
