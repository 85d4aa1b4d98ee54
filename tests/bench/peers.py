"""The usual ways to solve a chain of dyads, and other people's packages, beside this project's own.

`python tests/bench/peers.py [--into FOLDER]` measures all of them, prints the manual's table and draws its
chart, which takes some minutes. The parts, in reading order:

- The usual ways to solve a chain of dyads, as they are usually written.
- The same linkages in other people's packages: pylinkage (Assur groups, numba) and scipy (root finding).
- The methods compared: who answers, from which source, and what of each is timed.
"""

from __future__ import annotations

import cmath
import math
import sys
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from linkanim.bench import drawing, result
from linkanim.bench.command import CHART
from linkanim.bench.methods import FEW, MANY, ONE_BY_ONE, Entry, Timed, batch, first_of, one_turn, timed
from linkanim.bench.methods import entries as own_entries
from linkanim.bench.questions import (
    FOUR_BAR,
    TURN,
    CaseSet,
    Complexes,
    Dyad,
    DyadChain,
    FixedStep,
    Floats,
    Orders,
    Places,
    Question,
    SlideStep,
    TurnStep,
    circle_dyad,
    joined,
)
from linkanim.bench.reference import Solve
from linkanim.mechanics.linkage import RRR

# The usual ways to solve a chain of dyads, as they are usually written.
#
# Closed forms and tables take whole arrays; methods that start from the previous pose go pose by pose in
# plain floats, as an animation's loop does. None of the usual methods is improved here, since their errors
# near limits and change points are what is measured. Rates follow from the differentiated equations of each
# dyad, solved at the pose found (Norton, Design of Machinery, chapters on velocity and acceleration
# analysis).

INTERVALS = 360
"""The number of a table's intervals in one turn."""
NOWHERE = complex(math.nan, math.nan)
Close = Callable[[Dyad, Places, Any], Any]
"""A function that closes a dyad: its joint's place, by earlier joints' places and the side at each pose."""


def half_angle_dyad(dyad: Dyad, at: Places, side: Any) -> Any:
    """Solve A cos ψ + B sin ψ = C for a bar's angle as a quadratic in tan(ψ/2).

    Norton, Design of Machinery, "algebraic position analysis", for the second bar of a pair and the rod of a
    slider.
    """
    if isinstance(dyad, RRR):
        p, q = (at[end] for end in dyad.ends)
        (a, b), way = dyad.lengths, q - p
        cosine, sine = 2 * b * way.real, 2 * b * way.imag
        right, origin, arm, sign = a * a - b * b - way.real**2 - way.imag**2, q, b, side
    else:
        seen = (at[dyad.end] - dyad.base) * np.conj(dyad.along)
        turned = np.conj(dyad.along)
        cosine, sine = dyad.length * turned.imag, dyad.length * turned.real
        right, origin, arm, sign = -seen.imag, at[dyad.end], dyad.length, -side
    root = np.sqrt(cosine * cosine + sine * sine - right * right)
    angle = 2 * np.arctan((sine + sign * root) / (cosine + right))
    return origin + arm * np.exp(1j * angle)


def closed(close: Close) -> Callable[[Question], Places]:
    """Return the method that closes one dyad after the other by `close`, for all poses at once."""

    def places(question: Question) -> Places:
        sides = question.sides
        return question.chain.joints_at(question.angles, lambda dyad, at: close(dyad, at, sides[dyad.name]))

    return places


def rated(places: Callable[[Question], Places]) -> Callable[[Question], Orders]:
    """Return the method with rates: positions, then their first and second derivatives."""

    def solve(question: Question) -> Orders:
        at, (speed, gain) = places(question), question.rates
        chain = question.chain
        first = _rates(chain, at, lambda r: 1j * r * speed, lambda dyad: (0.0, 0.0))
        loads = partial(_centripetal, first=first)
        return at, first, _rates(chain, at, lambda r: 1j * r * gain - (r * speed) ** 2, loads)

    return solve


def _rates(
    chain: DyadChain,
    at: Places,
    turning: Callable[[float], Any],
    loads: Callable[[Dyad], tuple[Any, Any]],
) -> dict[str, Any]:
    """Return a derivative of all joints, by each crank's factor `turning(ratio)` and each dyad's `loads`."""
    found: dict[str, Any] = dict.fromkeys(chain.pins, 0j)
    for step in chain.steps:
        if isinstance(step, TurnStep):
            found[step.name] = turning(step.ratio) * (at[step.name] - at[step.pivot])
        elif isinstance(step, FixedStep):
            found[step.name] = step.place(found)
        else:
            found[step.name] = _rate(step, at, found, loads(step))
    return found


def _rate(dyad: Dyad, at: Places, ends: Places, loads: tuple[Any, Any]) -> Any:
    """Return the rate x of a dyad's joint: (B - P)·(x - p) = load for each bar, or x along its line.

    A single pose whose bars are in line gives NaN.
    """
    here = at[dyad.name]
    try:
        if isinstance(dyad, RRR):
            (p, q), (one, other) = dyad.ends, (here - at[end] for end in dyad.ends)
            right, also = _dot(one, ends[p]) + loads[0], _dot(other, ends[q]) + loads[1]
            return 1j * (one * also - other * right) / (one.conjugate() * other).imag
        bar = here - at[dyad.end]
        return dyad.along * ((_dot(bar, ends[dyad.end]) + loads[0]) / _dot(bar, dyad.along))
    except ZeroDivisionError:
        return NOWHERE


def _centripetal(dyad: Dyad, first: Places) -> tuple[Any, Any]:
    ends = dyad.ends if isinstance(dyad, RRR) else (dyad.end,)
    loads = [-(np.abs(first[dyad.name] - first[end]) ** 2) for end in ends]
    return loads[0], loads[-1]


def _dot(one: Any, other: Any) -> Any:
    return (one.conjugate() * other).real


def newton(iterations: int) -> Callable[[Question], Places]:
    """Return Newton's method on each dyad's equations: `iterations` steps from the previous pose."""

    def poses(question: Question) -> Iterator[dict[str, complex]]:
        at = dict(question.start)
        for angle in question.angles.tolist():
            last = at
            at = question.chain.joints_at(
                angle,
                lambda dyad, at: _improved(dyad, at, last[dyad.name], iterations),  # noqa: B023
                cmath.exp,
            )
            yield at

    return lambda question: _gathered(poses(question))


def _gathered(poses: Iterator[dict[str, complex]]) -> Places:
    kept = list(poses)
    return {name: np.array([pose[name] for pose in kept]) for name in kept[0]}


def _improved(dyad: Dyad, at: Places, here: complex, iterations: int) -> complex:
    """Return a dyad's joint after `iterations` steps; a singular Jacobian gives NaN."""
    try:
        if isinstance(dyad, RRR):
            p, q = (at[end] for end in dyad.ends)
            a, b = (length * length for length in dyad.lengths)
            for _ in range(iterations):
                x, y, z, w = here.real - p.real, here.imag - p.imag, here.real - q.real, here.imag - q.imag
                f, g = 0.5 * (x * x + y * y - a), 0.5 * (z * z + w * w - b)
                det = x * w - y * z
                here -= complex((w * f - y * g) / det, (x * g - z * f) / det)
            return here
        way = ((here - dyad.base) * dyad.along.conjugate()).real
        seen, square = (at[dyad.end] - dyad.base) * dyad.along.conjugate(), dyad.length * dyad.length
        for _ in range(iterations):
            x = way - seen.real
            way -= 0.5 * (x * x + seen.imag * seen.imag - square) / x
        return dyad.base + dyad.along * way
    except ZeroDivisionError:
        return NOWHERE


def runge_kutta(question: Question) -> Orders:
    """Integrate the dyads' velocities from pose to pose with the classical method of fourth order."""
    return (_gathered(_integrated(question)),)


def _integrated(question: Question) -> Iterator[dict[str, complex]]:
    chain = question.chain
    state = [question.start[dyad.name] for dyad in chain.dyads]
    before = float(question.angles[0])
    for angle in question.angles.tolist():
        h, weighted = angle - before, [0j] * len(state)
        slopes = weighted
        for part, weight in ((0.0, 1), (0.5, 2), (0.5, 2), (1.0, 1)):
            reached = [y + part * h * k for y, k in zip(state, slopes, strict=True)]
            slopes = _slopes(chain, before + part * h, reached)
            weighted = [sum_ + weight * k for sum_, k in zip(weighted, slopes, strict=True)]
        state = [y + h / 6 * sum_ for y, sum_ in zip(state, weighted, strict=True)]
        before = angle
        yield _with_dyads(chain, angle, state)


def _with_dyads(chain: DyadChain, angle: float, state: list[complex]) -> dict[str, complex]:
    dyads = iter(state)
    return chain.joints_at(angle, lambda dyad, at: next(dyads), cmath.exp)


def _slopes(chain: DyadChain, angle: float, state: list[complex]) -> list[complex]:
    """Return the velocities of the dyads' joints per unit input; NaN where bars are in line."""
    at = _with_dyads(chain, angle, state)
    rates = _rates(chain, at, lambda ratio: 1j * ratio, lambda dyad: (0.0, 0.0))
    return [rates[dyad.name] for dyad in chain.dyads]


class Samples(NamedTuple):
    """Poses of one period at equal steps of the phase, with their slopes."""

    first: float
    step: float
    period: float
    values: Places
    slopes: Places

    def place(self, phases: Floats) -> tuple[Any, Floats]:
        """Return the interval in which each phase lies, and the share of it before the phase."""
        steps = np.mod(phases - self.first, self.period) / self.step
        last = len(next(iter(self.values.values()))) - 2
        interval = np.minimum(steps.astype(np.intp), last)
        return interval, steps - interval


def table_of(question: Question) -> Samples:
    """Return the table of a question: this project's own poses, half an interval off whole degrees."""
    step, count = TURN / INTERVALS, INTERVALS * question.periods
    phases = (np.arange(count + 1, dtype=np.float64) - 0.5) * step
    values, slopes, _ = batch(replace(question, phases=phases, by_angle=False))
    return Samples(float(phases[0]), step, count * step, values, slopes)


def linear(table: Samples, question: Question) -> Orders:
    """Read the table with straight lines between its entries."""
    at, s = table.place(question.phases)
    return ({name: (1 - s) * value[at] + s * value[at + 1] for name, value in table.values.items()},)


def cubic(table: Samples, question: Question) -> Orders:
    """Read the table with Hermite's cubics through its entries and slopes."""
    at, s = table.place(question.phases)
    u, h = 1 - s, table.step
    before, after, rise, fall = u * u * (1 + 2 * s), s * s * (3 - 2 * s), u * u * s * h, s * s * u * h

    def read(value: Complexes, slope: Complexes) -> Any:
        return before * value[at] + after * value[at + 1] + rise * slope[at] - fall * slope[at + 1]

    return ({name: read(value, table.slopes[name]) for name, value in table.values.items()},)


# The same linkages in other people's packages: pylinkage (Assur groups, numba) and scipy (root finding).


class Model(NamedTuple):
    """A pylinkage linkage, its cranks with their ratios, and the row of each joint in its answers."""

    linkage: Any
    cranks: tuple[tuple[Any, float], ...]
    rows: dict[str, int]

    def run_at(self, speed: float, gain: float) -> None:
        """Set the input's speed and acceleration, for the rates."""
        for crank, ratio in self.cranks:
            self.linkage.set_input_velocity(crank, ratio * speed, ratio * gain)


def pylinkage_model(question: Question, rate: float) -> Model:
    """Return the linkage at the question's first pose; its input turns by `rate` radians at every step."""
    from pylinkage.components import Ground
    from pylinkage.simulation import Linkage

    made: dict[str, Any] = {name: Ground(at.real, at.imag) for name, at in question.chain.pins.items()}
    parts, cranks = [*made.values()], []
    rows = {name: row for row, name in enumerate(made)}
    for step in question.chain.steps:
        ends = (step.base, step.base + step.along) if isinstance(step, SlideStep) else ()
        guide = [Ground(at.real, at.imag) for at in ends]
        parts += guide
        part = _part(step, made, question, rate, guide)
        if isinstance(step, TurnStep):
            cranks.append((part, step.ratio))
        rows[step.name] = len(parts)
        parts.append(part)
        made[step.name] = part.output if isinstance(step, TurnStep) else part
    model = Model(Linkage(parts), tuple(cranks), rows)
    model.run_at(1.0, 0.0)
    return model


def _part(step: Any, made: dict[str, Any], question: Question, rate: float, guide: list[Any]) -> Any:
    from pylinkage.actuators import Crank
    from pylinkage.dyads import FixedDyad, RRPDyad, RRRDyad

    start = question.start[step.name]
    match step:
        case TurnStep():
            angle = step.ratio * float(question.angles[0]) + step.offset
            return Crank(made[step.pivot], step.length, step.ratio * rate, angle)
        case RRR():
            ends = [made[end] for end in step.ends]
            return RRRDyad(*ends, *step.lengths, start.real, start.imag)
        case SlideStep():
            return RRPDyad(made[step.end], *guide, step.length, start.real, start.imag)
    return FixedDyad(*(made[name] for name in step.on), abs(step.at), cmath.phase(step.at))


def pylinkage_fast(substeps: int) -> Callable[[Question], Orders]:
    """Return step_fast from pose to pose, in `substeps` equal steps from one input to the next.

    Inputs at unequal distances are one step apart. The first pose is given; of each further pose the closure
    nearest to the previous one is taken, as the package's solver does.
    """

    def solve(question: Question) -> Orders:
        ways = np.diff(question.angles)
        count = substeps if np.allclose(ways, ways[0], rtol=1e-3, atol=0.0) else 1

        def take(linkage: Any, way: float) -> Any:
            orders = linkage.step_fast_with_kinematics(count, dt=way / count)
            return [order[-1] for order in orders]

        return _walked(question, take)

    return solve


def pylinkage_step(question: Question) -> Orders:
    """Solve pose by pose with pylinkage's step(); a pose that it refuses as unbuildable is NaN."""
    from pylinkage.exceptions import UnbuildableError

    def take(linkage: Any, way: float) -> Any:
        try:
            orders = next(linkage.step_with_derivatives(1, dt=way))
        except UnbuildableError:
            return np.full((3, len(linkage.components), 2), np.nan)
        return [[(np.nan, np.nan) if value is None else value for value in values] for values in orders]

    return _walked(question, take)


def _walked(question: Question, take: Callable[[Any, float], Any]) -> Orders:
    """Return the poses from input to input, which `take` gives: all places, by order."""
    model, found = pylinkage_model(question, 1.0), []
    ways = np.diff(question.angles, prepend=question.angles[0]).tolist()
    for way, speed, gain in zip(ways, *(rate.tolist() for rate in question.rates), strict=True):
        model.run_at(speed, gain)
        found.append(take(model.linkage, way))
    orders = np.moveaxis(joined(np.array(found)), 1, 0)
    return tuple({name: order[:, row] for name, row in model.rows.items()} for order in orders)


def fsolve(question: Question) -> Orders:
    """Solve each dyad's equations from its previous place; NaN where fsolve reports no convergence."""
    before, rows = dict(question.start), range(question.angles.size)

    def close(dyad: Dyad, at: Places) -> Any:
        return np.array([_found(dyad, at, row, before) for row in rows])

    return (question.chain.joints_at(question.angles, close),)


def _found(dyad: Dyad, at: Places, row: int, before: dict[str, complex]) -> complex:
    from scipy.optimize import fsolve as find

    ends = dyad.ends if isinstance(dyad, RRR) else (dyad.end,)
    lengths = dyad.lengths if isinstance(dyad, RRR) else (dyad.length,)
    places = [complex(at[end][row]) if np.ndim(at[end]) else complex(at[end]) for end in ends]
    largest = max(lengths) ** 2

    def equations(guess: Any) -> list[float]:
        here = complex(guess[0], guess[1])
        ways = [abs(here - place) ** 2 - length**2 for place, length in zip(places, lengths, strict=True)]
        off = [] if isinstance(dyad, RRR) else [((here - dyad.base) * dyad.along.conjugate()).imag]
        return [way / largest for way in ways] + [way / max(lengths) for way in off]

    start = before[dyad.name]
    root, _, flag, _ = find(equations, (start.real, start.imag), full_output=True)
    if flag != 1:
        return NOWHERE
    before[dyad.name] = complex(root[0], root[1])
    return before[dyad.name]


# The methods compared: who answers, from which source, and what of each is timed.

_DYADS = "each dyad's equations"


def entries(mechanism: CaseSet) -> tuple[Entry, ...]:
    """Return all rows of a mechanism in the order of the table."""
    first = first_of(mechanism)
    counts = (FEW, MANY) if mechanism is FOUR_BAR else (FEW,)
    turns = {count: one_turn(first, count) for count in (*counts, ONE_BY_ONE, 180)}
    usual = _usual(turns[FEW], turns[ONE_BY_ONE])
    packages = _packages([turns[count] for count in counts], turns[ONE_BY_ONE], turns[180])
    others = (replace(row, mechanism=mechanism.name) for row in (*usual, *packages))
    return (*own_entries(mechanism), *others)


def _usual(few: Question, one: Question) -> Iterator[Entry]:
    """Yield closed forms, methods that go from pose to pose, and tables."""
    norton = "Norton, Design of Machinery"
    yield _rated("half-angle", "half-angle formula", norton, closed(half_angle_dyad), few)
    yield _rated("circles", "circle intersection", "Bourke 1997", closed(circle_dyad), few)
    for count in (1, 2, 3):
        name = f"Newton, {count} iteration{'s' if count > 1 else ''}"
        yield _rated(f"newton {count}", name, _DYADS, newton(count), one)
    rk4 = runge_kutta
    yield Entry("", "rk4", "RK4 on the velocity", _DYADS, rk4, timed(rk4, one))
    table = table_of(few)
    for key, words, read in (
        ("linear", "straight lines", linear),
        ("cubic", "Hermite's cubics", cubic),
    ):
        name, looked_up = f"table of 1° steps, {words}", timed(_reading(read, table), few)
        yield Entry("", key, name, "poses of this solver", _reading(read), looked_up)


def _rated(key: str, name: str, source: str, places: Callable[[Question], Places], turn: Question) -> Entry:
    """Return the row of a method that gives positions, with rates by `rated`."""
    solve = rated(places)
    return Entry("", key, name, source, solve, timed(places, turn), timed(solve, turn))


def _reading(read: Callable[[Samples, Question], Orders], table: Samples | None = None) -> Solve:
    """Return the method that reads a table: a given one, or else the question's own."""
    return lambda question: read(table or table_of(question), question)


def _packages(turns: list[Question], one: Question, fewest: Question) -> Iterator[Entry]:
    for key, turn in zip(("pylinkage", "pylinkage, many"), turns, strict=False):
        count = turn.angles.size
        model = pylinkage_model(turn, TURN / count).linkage
        runs = (
            Timed(partial(work, count), count) for work in (model.step_fast, model.step_fast_with_kinematics)
        )
        solve, name = pylinkage_fast(round(count / 360)), f"pylinkage step_fast, {count:,} at once"
        yield Entry("", key, name, "pylinkage, numba", solve, *runs)
    count = one.angles.size
    model = pylinkage_model(one, TURN / count).linkage
    runs = (Timed(_walked_entries(work, count), count) for work in (model.step, model.step_with_derivatives))
    yield Entry("", "pylinkage step", "pylinkage step()", "pylinkage", pylinkage_step, *runs)
    yield Entry("", "fsolve", "scipy fsolve", "scipy.optimize", fsolve, timed(fsolve, fewest))


def _walked_entries(work: Callable[[int], Iterator[object]], count: int) -> Callable[[], object]:
    return lambda: deque(work(count), maxlen=0)


def main(into: str) -> None:
    """Measure all rows of all linkages, print the manual's table and draw it."""
    found = result.run(rows=entries)
    print(found.as_markdown())
    print(drawing.draw(found, Path(into) / CHART), file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[2] if sys.argv[1:2] == ["--into"] else "recordings")
