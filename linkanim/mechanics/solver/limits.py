"""Find the limits and change points of dyads further down the chain on the cycle.

Its parts, in reading order:

- Where the root of a dyad on moving points vanishes, or nearly, and what is smooth there, in fifty digits.
- How far every dyad on moving points is from its limits along the input's path, and where that is extreme.
- Limits and change points of dyads further down the chain, found on the cycle.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from decimal import Decimal, localcontext
from functools import cache, cached_property, partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.bounds import MOST_CHANGE_POINTS
from linkanim.errors import AssemblyError, DyadAtLimit
from linkanim.frozen import frozen
from linkanim.mechanics.angles import FULL_TURN, Sum
from linkanim.mechanics.arithmetic import Graph, Slope, Value
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.precise import context, exactly, interpolated, nearest_sum, nodes, sine_and_cosine
from linkanim.mechanics.program import Array, Bools, batch, decimals
from linkanim.mechanics.search import ends_of
from linkanim.mechanics.solver.assembly import most_turns, precise, resigned
from linkanim.mechanics.solver.closing import (
    AT_ITS_LIMIT,
    Assembly,
    ChainRoot,
    Closing,
    End,
    Fitted,
    Near,
    NearTouch,
    PolynomialFit,
    Stationary,
    Touch,
    Walk,
    Zero,
    walk_at,
    walking,
)
from linkanim.mechanics.solver.input import InputPath, Limit, Swing, swing_by_angle
from linkanim.mechanics.solver.loop import ONE_PLACE
from linkanim.mechanics.tolerances import (
    AT_END,
    BARELY,
    BESIDE_AN_EXTREME,
    CONVERGED,
    FLAT,
    JUST_AFTER,
    LAST,
    LAST_BEYOND,
    LOW,
    NARROWEST,
    NARROWEST_AT_A_LIMIT,
    NEARBY,
    NO_DIGITS,
    NO_WAY,
    NUDGE,
    OFF,
    ROUNDED_LENGTHS,
    SAME_PLACE,
    STANDSTILL,
    TOLERABLE,
    TOUCHING,
    UNEVEN,
    USED_UP,
)

# Where the root of a dyad on moving points vanishes, or nearly, and what is smooth there, in fifty digits.
#
# The formulas of the linkage are compiled for decimals, so a margin has digits left wherever it matters:
# its zeros come from Newton's method, and R with margin = z²·R² (see `closing`) from interpolation.

Decimals = tuple[Decimal, ...]

PARTING = (
    "the two ends of its equal bars meet and part the way they came, so that it could "
    "go on in any direction; make one of the bars longer or shorter"
)
TOO_NEAR = (
    "its limit lies too near to another one to be told from it; make one length a little longer or shorter"
)
TURNING_BACK = (
    "it falls into one line just where it turns back, so that it could go on either "
    "way; make one of its lengths a little longer or shorter"
)


class Sample(NamedTuple):
    """A place next to a zero: the argument of the fit, z, and the margin and D there."""

    argument: Decimal
    z: Decimal
    margin: Decimal
    across: Decimals = ()


STEPS, SLOW = 40, 12
"""The most steps of Newton's method, and the count after which they are summed as a geometric series."""
BESIDE = Decimal(repr(NUDGE))
POINTS = 20
POINTS_OF_A_DIP = 32
"""Samples of a near touch's fit, which has to hold as far as the margin lacks digits: that may be far."""
WIDEST = 0.5
TRIES = 16
INNER = 15 / 16
"""The share of a fit beside a limit that is used: the rates of its last terms are greatest at its ends."""
MOST_FITS = 12
"""The most fits that follow a limit's first one."""


class ExactWalk:
    """A linkage's dyads in many digits, from one walk that goes only as far as the dyads asked for."""

    def __init__(self, assembly: Assembly) -> None:
        self.assembly = assembly

    @cached_property
    def _walk(self) -> Walk:
        assembly = precise(self.assembly)
        return Walk(assembly, assembly.path.state(Graph(exact=True).input("x"), Slope(0.0)))

    @cached_property
    def _steps(self) -> Iterator[object]:
        return walking(self._walk)

    def closing(self, name: str) -> Closing:
        """Return what closes a dyad."""
        closings = self._walk.closings
        while name not in closings:
            next(self._steps)
        return closings[name]


def closing_of(name: str, walk: Walk) -> Closing:
    """Return what closes a dyad, from a walk as far as to it."""
    steps = walking(walk)
    while name not in walk.closings:
        next(steps)
    return walk.closings[name]


def refining(exact: ExactWalk, name: str) -> Callable[[Sum], Sum]:
    """Return the function from a phase to the nearby one at which a dyad's margin vanishes (Newton's method).

    Slopes are taken from differences: the constants in the formulas of the rates are rounded differently from
    the margin's.
    """
    run = decimals(("x",), _outputs(exact.closing(name))[:1])

    def refined(phase: Sum) -> Sum:
        with localcontext(context()):
            place = _newton(phase, lambda place: _steps(run, place)[0])
            return phase if place is None else nearest_sum(place)

    return refined


def extremes(exact: ExactWalk, name: str) -> Callable[[float], tuple[Sum, float, float]]:
    """Return the function from a phase in floats to the extreme of a dyad's separation (Newton's method).

    It returns the extreme's phase, the length by which the dyad closes there, and, where that is negative,
    how far to both sides of the phase it does not close.
    """
    closing = exact.closing(name)
    run = decimals(("x",), (closing.u * closing.w, closing.gap))

    def extreme(phase: float) -> tuple[Sum, float, float]:
        with localcontext(context()):
            root = _newton(Sum(phase), lambda place: _steps(run, place)[1])
            place = Decimal(phase) if root is None else root
            margin, gap = run(place)
            bend = sum(run(place + nudge)[0] for nudge in (-BESIDE, BESIDE)) - 2 * margin
            reach = (-2 * margin / bend).sqrt() * BESIDE if margin < 0 < bend else Decimal(0)
            return nearest_sum(place), float(gap), float(reach)

    return extreme


def _steps(run: Callable[..., Decimals], place: Decimal) -> tuple[Decimal, Decimal]:
    """Return the steps to the margin's zero and to its extreme."""
    before, here, after = (run(place + nudge)[0] for nudge in (-BESIDE, 0, BESIDE))
    slope, bend = (after - before) / (2 * BESIDE), (after - 2 * here + before) / BESIDE**2
    return here / slope, slope / bend


def _newton(phase: Sum, step: Callable[[Decimal], Decimal]) -> Decimal | None:
    """Return where steps from a phase end; None where that is not nearby."""
    start = place = exactly(phase)
    last = Decimal(0)
    for count in range(STEPS):
        change = step(place)
        # Beside a kink differences mix both of its sides, and each step is a fixed share of the one before.
        share = change / last if count > SLOW and count % 2 else Decimal(0)
        last = change
        change /= 1 - share if abs(share) < 1 else 1
        if not abs(place - change - start) < Decimal(NEARBY):
            return None
        place -= change
        if abs(change) < CONVERGED:
            break
    return place


def _outputs(closing: Closing) -> tuple[Value, ...]:
    """Return the margin, and D where the dyad's ends may meet."""
    place = closing.across and closing.across.position
    return (closing.u * closing.w, *((place.x, place.y) if place else ()))


def fitted(assembly: Assembly) -> Assembly:
    """Return the assembly with a fit next to every zero of the dyads on moving points."""
    exact = ExactWalk(assembly)
    chain = {name: _fitted_root(exact, name, root) for name, root in assembly.chain.items()}
    return replace(assembly, chain=chain)


def _fitted_root(exact: ExactWalk, name: str, root: ChainRoot) -> ChainRoot:
    low = LOW * root.least / NO_DIGITS
    with localcontext(context()):
        near_touches = _exact_near_touches(exact, name, root.near_touches)
        samplers = _samplers(exact, name)
        return replace(
            root,
            zeros=tuple(
                replace(zero, near=_near_a_zero(name, zero, low, *samplers(zero))) for zero in root.zeros
            ),
            near_touches=tuple(
                replace(near_touch, near=_near_a_touch(name, near_touch, near_touches, *samplers(near_touch)))
                for near_touch in near_touches
            ),
        )


def _near_a_touch(
    name: str,
    near_touch: NearTouch,
    near_touches: Sequence[NearTouch],
    sampled: Callable[[Decimal], Sample],
    width: float,
) -> Near | None:
    """Fit next to a near touch, at most half-way to the next one: where both are as low, R is 0 at the other.

    One so near that no fit would be left counts as the same.
    """
    period = 2 * math.pi * near_touch.turns
    apart = (
        abs(math.remainder(float(one.place - near_touch.place), period))
        for one in near_touches
        if one is not near_touch
    )
    half_ways = (math.tan(distance / (4 * near_touch.turns)) for distance in apart)
    return _near(name, near_touch, sampled, min([width, *(one for one in half_ways if one >= NARROWEST)]))


def _exact_near_touches(exact: ExactWalk, name: str, near_touches: Sequence[NearTouch]) -> list[NearTouch]:
    """Return the near touches moved to the exact extremes, which floats found to half their digits."""
    if not near_touches:
        return []
    extreme = extremes(exact, name)
    starts = [_start(exact.assembly.path, near_touch) for near_touch in near_touches]
    places = [
        extreme(float(near_touch.place - start))[0] + start
        for near_touch, start in zip(near_touches, starts, strict=True)
    ]
    return [replace(near_touch, place=place) for near_touch, place in zip(near_touches, places, strict=True)]


def _near(name: str, zero: Fitted, sampled: Callable[[Decimal], Sample], width: float) -> Near | None:
    """Fit on the widest stretch where a polynomial holds to the last digit, or nearly; None where none does.

    No stretch is wider than `width`, which is as far as the zero's samples go.
    AssemblyError where the dyad's ends meet without passing each other: D has no direction to go on in.
    """
    zeroth, best, least = sampled(Decimal(0)), None, TOLERABLE
    narrowest = NARROWEST_AT_A_LIMIT if isinstance(zero, End) else NARROWEST
    points = POINTS_OF_A_DIP if isinstance(zero, NearTouch) else POINTS
    for _ in range(TRIES):
        half = width / 2 if isinstance(zero, End) else width
        stretch = width, half if isinstance(zero, End) else 0.0, half
        samples = [sampled(Decimal(stretch[1]) + Decimal(half) * node) for node in nodes(points)]
        squares = _squares(samples, zeroth.margin)
        root = _fit(
            stretch, samples, squares if isinstance(zero, NearTouch) else [one.sqrt() for one in squares]
        )
        meeting = not isinstance(zero, NearTouch) and _meet(zeroth.across, samples)
        shares = [_shares(samples, zeroth, k) for k in (0, 1)] if meeting else []
        fits = [root, *(_fit(stretch, samples, values) for values in shares)]
        last = max(_last(fits[:1]), _last(fits[1:]))
        if last <= least and width >= narrowest:
            rest = float(zeroth.margin) if isinstance(zero, NearTouch) else 0.0
            best, least = Near(root, (fits[1], fits[2]) if meeting else None, rest), last
        if last <= LAST or width < narrowest:
            break
        width *= max(min(0.8 * (LAST / last) ** (1 / points), 0.8), 0.1)
    if best is None and not isinstance(zero, NearTouch):
        why = PARTING if meeting else TOO_NEAR if isinstance(zero, End) else TURNING_BACK
        raise AssemblyError(f"joint {name}: {why}")
    return best


def _near_a_zero(
    name: str, zero: Zero, low: float, sampled: Callable[[Decimal], Sample], width: float
) -> Near | None:
    """Fit next to a zero; next to a limit with fits that follow for as long as the margin is below `low`.

    Where a loop before moves quickly beside the limit, each holds only about as far as it is away from there.
    """
    near = _near(name, zero, sampled, width)
    if near is None or not isinstance(zero, End):
        return near
    if near.across or _margin_at_end(near.root) >= low:
        return near._replace(root=near.root._replace(width=near.root.width * INNER))
    fits = [near.root._replace(width=near.root.width / 2)]
    margin = 0.0
    while (edge := fits[-1].width) < width and margin < low and len(fits) <= MOST_FITS:
        way, last = min(3 * edge, width - edge), math.inf
        while last > LAST_BEYOND and way > edge / 8:
            stretch = edge + way * INNER, edge + way * (INNER - 0.5), way / 2
            places = [Decimal(stretch[1]) + Decimal(stretch[2]) * node for node in nodes(POINTS)]
            samples = [sampled(place) for place in places]
            fit = _fit(stretch, samples, [square.sqrt() for square in _squares(samples, Decimal(0))])
            last = _last([fit])
            way *= max(min(0.8 * (LAST_BEYOND / last) ** (1 / POINTS), 0.8), 0.1)
        if last > LAST_BEYOND:
            break
        fits.append(fit)
        margin = _margin_at_end(fit)
    return near._replace(root=fits[0], beyond=tuple(fits[1:])) if fits[1:] else near


def _margin_at_end(fit: PolynomialFit) -> float:
    """Return the margin, or nearly, where a fit beside a limit ends."""
    return fit.width * sum(fit.coefficients) ** 2


_Stretch = tuple[float, float, float]
"""Where a fit is made: its width, and the middle and the half of its arguments."""


def _fit(stretch: _Stretch, samples: list[Sample], values: list[Decimal]) -> PolynomialFit:
    """Return the polynomial through the values at the samples' arguments."""
    _, centre, half = stretch
    places = [(sample.argument - Decimal(centre)) / Decimal(half) for sample in samples]
    return PolynomialFit(*stretch, tuple(interpolated(places, values)))


def _squares(samples: list[Sample], rest: Decimal) -> list[Decimal]:
    """Return R², NaN beyond another zero; `rest` is what rounding leaves of the margin at the zero itself."""
    squares = [(sample.margin - rest) / sample.z**2 for sample in samples]
    return [square if square > 0 else Decimal("NaN") for square in squares]


def _shares(samples: list[Sample], zeroth: Sample, component: int) -> list[Decimal]:
    """Return a component of D over the argument; at the zero itself rounding has left a rest of D, too."""
    rest = zeroth.across[component]
    return [(sample.across[component] - rest) / sample.argument for sample in samples]


def _meet(across: Decimals, samples: list[Sample]) -> bool:
    """Tell whether D at the zero itself is negligible beside D around it."""
    around = max((abs(value) for sample in samples for value in sample.across), default=Decimal(0))
    return bool(across) and all(abs(value) <= around * Decimal(NEARBY) for value in across)


def _last(fits: list[PolynomialFit]) -> float:
    """Return the last coefficients over the greatest first one, in terms of Chebyshev polynomials."""
    size = max((abs(c) for fit in fits for c in fit.coefficients[:2]), default=1.0)
    last = max(
        (abs(c) / 2.0 ** (len(fit.coefficients) - 2) for fit in fits for c in fit.coefficients[-2:]),
        default=0.0,
    )
    return last / size if last < math.inf else math.inf


def _start(path: InputPath, place: Stationary) -> Sum:
    """Return the coordinate of phase 0 in the terms of a place: 0, or the angle of an input that turns."""
    return Sum(0.0) if place.amplitude else path.place(Sum(0.0))


def _samplers(exact: ExactWalk, name: str) -> Callable[[Fitted], tuple[Callable[[Decimal], Sample], float]]:
    """Return the function from a zero to its samples by the distance from it, and the greatest distance."""
    path = exact.assembly.path

    @cache
    def compiled() -> Callable[..., Decimals]:
        return decimals(("x",), _outputs(exact.closing(name)))

    def sampler(zero: Fitted) -> tuple[Callable[[Decimal], Sample], float]:
        if isinstance(zero, End):
            assert isinstance(path, Swing)
            return _by_way(exact.assembly, path, name, zero), path.amplitude / 2
        run, turns = compiled(), zero.turns
        place = exactly(zero.place) - exactly(_start(path, zero))

        def sampled(argument: Decimal) -> Sample:
            half = Decimal(math.atan(float(argument)))
            margin, *across = run(place + 2 * turns * half)
            z, other = sine_and_cosine(half)
            return Sample(z / other, z, margin, tuple(across))

        return sampled, WIDEST / turns

    return sampler


def _by_way(assembly: Assembly, path: Swing, name: str, end: End) -> Callable[[Decimal], Sample]:
    """Return the margin as a function of half the distance to a limit."""
    graph = Graph(exact=True)
    u, v = graph.input("u"), graph.input("v")
    state = swing_by_angle((v - u, u, v), Slope(0.0), path.low, path.high)
    run = decimals(("u", "v"), _outputs(closing_of(name, Walk(precise(assembly), state)))[:1])
    amplitude = (exactly(path.high) - exactly(path.low)) / 2

    def sampled(way: Decimal) -> Sample:
        margin = run(*((way, amplitude - way) if end.upper else (amplitude - way, way)))[0]
        return Sample(way, way.sqrt(), margin)

    return sampled


# How far every dyad on moving points is from its limits along the input's path, and where that is extreme.
#
# A dyad closes while its separation s (L² between its ends, or how far one lies beside its line) keeps its
# factors U and W from going below zero. Both change with s alone. So between two neighbouring extremes of s,
# which are zeros of its rate, each factor has one zero at most, and what the dyad does at the extremes
# decides whether it closes: no sample does. The extremes are bracketed by samples, which are halved wherever
# the margin U·W could come to zero between them, until rate and slope leave no room for another extreme.

MOST_TOUCHING = 24
"""Extremes in a turn of the fastest crank at which floats cannot tell a margin's sign."""
HALVINGS = 32
FEW = 16
"""The most cells that are halved twice at a time: a call costs more than their samples."""
MOST_UNCLEAR = 500_000
"""The most cells, of all dyads, in which extremes could be missed. Where halving makes more, and more than
there were samples at first, the margin is rounding alone on a whole stretch, and halving would not end."""


class Sampled(NamedTuple):
    """Phases (N,), and there for every dyad (4, D, N): s', s'', and over their scale U·W and U - W.

    Below the `blur` a margin over its scale has no sign.
    """

    phases: Array
    rows: Array
    blur: float

    def at(self, index: NDArray[np.intp] | slice) -> Sampled:
        """Return the samples at these indices."""
        return self._replace(phases=self.phases[index], rows=self.rows[..., index])

    def followed(self, *others: Sampled) -> Sampled:
        """Return these samples followed by the others."""
        every = (self, *others)
        return self._replace(
            phases=np.concatenate([one.phases for one in every]),
            rows=np.concatenate([one.rows for one in every], axis=-1),
        )

    @property
    def ordered(self) -> Sampled:
        """The samples in the order of their phases, each phase once."""
        order = np.argsort(self.phases, kind="stable")
        return self.at(order[np.diff(self.phases[order], prepend=-math.inf) > 0])


class Extreme(NamedTuple):
    """A place where a dyad's separation is extreme and its margin next to nothing, settled in many digits.

    `closes` is +1 where the dyad closes there, -1 where it does not, 0 where its bars just fall into line.
    """

    phase: float
    place: Sum
    closes: int
    reach: float
    """How far to both sides the dyad does not close, in phase."""


@frozen
class Separations:
    """The margins of the dyads on moving points along a path, sampled wherever they decide what closes."""

    scales: Mapping[str, float]
    """The scale of each dyad's margin."""
    samples: Sampled
    path: InputPath
    exact_extremes: Callable[[str], tuple[Extreme, ...]]
    """Returns the extremes of a dyad at which floats cannot tell its margin from nothing.

    They are worked out when asked for: that is slow, the slower the more dyads stand before this one.
    """
    barely: Mapping[str, tuple[float, ...]]
    """For every dyad, the phases of further extremes, at which it barely closes."""
    margins: Callable[[Array], Array]
    """Returns the margins over their scale at phases (D, N)."""

    @property
    def names(self) -> tuple[str, ...]:
        """The dyads, in the order of rows."""
        return tuple(self.scales)

    @property
    def phases(self) -> Array:
        """The phases of the samples (N,)."""
        return self.samples.phases

    @cached_property
    def fails(self) -> Bools:
        """Whether each dyad fails to close at each phase (D, N); at none that the path does not pass."""
        failing = _failing(self.samples, [self.exact_extremes(name) for name in self.names])
        return np.asarray(failing & self.path.passes(self.phases))

    @property
    def closes(self) -> bool:
        """Whether every dyad closes all along."""
        return not self.fails.any()

    def end_of_gap(self, phase: float, name: str, side: int) -> Sum | None:
        """Return the end, on that side, of a stretch without closure that floats miss; None without one."""
        for extreme in self.exact_extremes(name):
            turns = round((phase - extreme.phase) / (2 * math.pi))
            if extreme.closes < 0 and abs(phase - extreme.phase - turns * 2 * math.pi) <= extreme.reach:
                return extreme.place + FULL_TURN.times(float(turns)) + Sum(side * extreme.reach)
        return None

    def touches(self, name: str) -> tuple[Sum, ...]:
        """Return the phases at which a dyad's bars just fall into line."""
        return tuple(extreme.place for extreme in self.exact_extremes(name) if extreme.closes == 0)

    def near_touches(self, name: str) -> tuple[Sum, ...]:
        """Return the phases at which a dyad barely closes, its separation being extreme."""
        settled = (extreme.place for extreme in self.exact_extremes(name) if extreme.closes > 0)
        return (*settled, *map(Sum, self.barely[name]))


def separations(assembly: Assembly) -> Separations:
    """Return the margins along the path, over its true period, of the dyads that come near their limits.

    AssemblyError where a dyad is at its limit on a whole stretch: its margin has so many extremes next to
    zero that they are rounding.
    """
    phases = _phases(assembly)
    # Rates are worked out only where some dyad comes near its limits: one that ends the path's way does.
    limiting = any(name and name not in assembly.loops for name in assembly.path.ends)
    walked = walk_at(assembly, Graph().input("x"), Slope(float(limiting))).closings
    scales = _scales(assembly.linkage, phases, walked)
    if not scales:
        nothing = np.zeros((4, 0, len(phases)))
        return Separations(
            {},
            Sampled(phases, nothing, 0.0),
            assembly.path,
            lambda _: (),
            {},
            lambda places: nothing[0, :, : len(places)],
        )
    scale, barely = np.array([*scales.values()]).T
    if not limiting:
        walked = walk_at(assembly, Graph().input("x"), Slope(1.0)).closings
    closings = {name: walked[name] for name in scales}
    blur = _blur(assembly.linkage)
    sampled = _sampler_separation(closings.values(), scale, blur)
    samples = _halved(tuple(scales), sampled, sampled(phases))
    extremes = _places(sampled, samples, _turning(samples, barely), 0)
    peaks = _places(sampled, samples, _spans_limits(samples), 3)
    samples = samples.followed(sampled(np.concatenate([*extremes, *peaks]))).ordered
    low = {
        name: _low(assembly, name, (places, sampled(places).rows[2, row]), (-blur, barely[row]))
        for row, (name, places) in enumerate(zip(closings, extremes, strict=True))
    }
    unclear = {name: places[margins <= blur] for name, (places, margins) in low.items()}
    for name, places in unclear.items():
        if len(places) > MOST_TOUCHING * assembly.path.periods * assembly.quickest:
            raise AssemblyError(f"joint {name}: {AT_ITS_LIMIT}")
    exact = ExactWalk(assembly)
    return Separations(
        dict(zip(scales, scale.tolist(), strict=True)),
        samples,
        assembly.path,
        cache(lambda name: tuple(_exact_extremes(exact, name, unclear[name]))),
        {name: tuple(places[margins > blur].tolist()) for name, (places, margins) in low.items()},
        lambda phases: np.asarray(sampled(phases).rows[2]),
    )


def _blur(linkage: Linkage) -> float:
    """Return the share of a margin's scale within which floats cannot tell its sign."""
    farthest = max((abs(place) for pin in linkage.pins for place in pin.position), default=0.0)
    bars = (abs(length) for joint in linkage.joints if not joint.fixed for length in joint.stated_lengths)
    return max(TOUCHING, OFF * farthest / (max(bars, default=0.0) or 1.0))


def _sampler_separation(
    closings: Collection[Closing], scale: Array, blur: float
) -> Callable[[Array], Sampled]:
    """Return the function of phases (N,) that gives s', s'', and over their scale U·W and U - W (4, D, N)."""
    run = _compiled(
        [
            [closing.separation.rate for closing in closings],
            [closing.separation.second for closing in closings],
            [closing.u * closing.w for closing in closings],
            [closing.half_difference * 2.0 for closing in closings],
        ]
    )

    def sampled(phases: Array) -> Sampled:
        rows = run(phases)
        with np.errstate(all="ignore"):
            rows[2:] /= scale[:, None]
        return Sampled(phases, rows, blur)

    return sampled


def _compiled(rows: Sequence[Sequence[Value]]) -> Callable[[Array], Array]:
    """Return the function of phases (N,) that gives the values of rows of dyads (rows, D, N)."""
    program = batch({"x": True}, [value for row in rows for value in row])

    def run(phases: Array) -> Array:
        with np.errstate(all="ignore"):
            return program(phases).reshape(len(rows), len(rows[0]), len(phases))

    return run


def _phases(assembly: Assembly) -> Array:
    """Return phases over the true period, dense enough for the quickest crank.

    The start is among them, and so are both ends of a path there and back.
    """
    path = assembly.path
    marks = 0.0, math.pi, path.home(assembly.linkage.drive.start), *(path.way or ())
    return np.sort(np.concatenate([assembly.sampled, marks]))


def _scales(
    linkage: Linkage, phases: Array, closings: Mapping[str, Closing]
) -> Mapping[str, tuple[float, float]]:
    """Return the scale of the margin for each dyad near its limits, and the share at which it barely closes.

    The scale is the greatest margin, or that of its bars. A dyad keeps away from its limits, and is left out,
    where its margin always exceeds that share, and the most that it changes between three samples.
    """
    all_closings = closings.values()
    rows = _compiled([[one.u * one.w for one in all_closings], [one.size for one in all_closings]])(phases)
    (margins, sizes), blur = rows, _blur(linkage)
    rows[:, _behind(margins < -blur * sizes)] = math.nan
    most, size = np.fmax.reduce(np.abs(rows), axis=2)
    nothing = (most <= blur * size) | (most <= (TOUCHING * linkage.longest) ** 2)
    for name in (name for name, flat in zip(closings, nothing, strict=True) if flat):
        raise AssemblyError(f"joint {name}: {AT_ITS_LIMIT}")
    scale = np.minimum(most, size)
    changes = np.fmax.reduce(np.abs(np.diff(margins, axis=1)), axis=1)
    # The margin of two bars is at most a quarter of their size; where it never comes near that, all is low.
    low = BARELY * np.maximum(scale, size / 4)
    near = np.fmin.reduce(margins, axis=1) <= np.maximum(3 * changes, low)
    with np.errstate(all="ignore"):
        scales = np.column_stack([scale, low / scale]).tolist()
    return {name: tuple(pair) for name, pair, comes in zip(closings, scales, near, strict=True) if comes}


def _behind(failing: Bools) -> Bools:
    """Tell for each dyad where an earlier one does not close (D, N): its values there are rounding."""
    before = np.logical_or.accumulate(failing, axis=0)
    return np.concatenate([np.zeros_like(failing[:1]), before[:-1]])


def _halved(names: Sequence[str], sampled: Callable[[Array], Sampled], samples: Sampled) -> Sampled:
    """Return the samples with others between them wherever a second extreme could lie there.

    AssemblyError where halving would not end: the dyad rests at its limit, rounding aside.
    """
    left, right, finer = samples.at(slice(None, -1)), samples.at(slice(1, None)), samples
    fastest = _fastest_change(samples)[:, None] / 4
    most = max(len(samples.phases), MOST_UNCLEAR // len(names))
    halvings = 0
    while halvings < HALVINGS:
        # At first a margin may change faster between neighbours than at both; the nearer these are, the less
        # so.
        with np.errstate(all="ignore"):
            unclear = _unclear(left, right, fastest)
        index = np.flatnonzero(unclear.any(axis=0))
        if not len(index):
            break
        if len(index) > most:
            raise AssemblyError(f"joint {names[unclear.sum(axis=1).argmax()]}: {AT_ITS_LIMIT}")
        left, right = left.at(index), right.at(index)
        times = 2 if len(index) <= FEW else 1
        between = _between(left, right, 1 << times, sampled)
        finer = finer.followed(*between)
        left, right = left.followed(*between), between[0].followed(*between[1:], right)
        fastest, halvings = fastest / (1 << times), halvings + times
    return finer.ordered


def _between(left: Sampled, right: Sampled, parts: int, sampled: Callable[[Array], Sampled]) -> list[Sampled]:
    """Return the samples that divide all cells into that many parts, those of each division together."""
    places = [(left.phases * (parts - k) + right.phases * k) / parts for k in range(1, parts)]
    halves, count = sampled(np.concatenate(places)), len(left.phases)
    return [halves.at(slice(k * count, (k + 1) * count)) for k in range(parts - 1)]


def _speed(samples: Sampled) -> Array:
    """Return how fast the margins change: s' (U - W), since U' = -s' and W' = s'.

    NaN where an unbounded rate meets a difference of 0, which never counts as slow.
    """
    rates, _, _, differences = samples.rows
    with np.errstate(invalid="ignore"):
        return np.asarray(np.abs(rates * differences))


def _fastest_change(samples: Sampled) -> Array:
    """Return how fast each margin changes at most (D,).

    A speed that is unbounded at one place, at a limit, says nothing of all the others.
    """
    speeds = _speed(samples)
    return np.asarray(np.max(speeds, axis=1, initial=0.0, where=np.isfinite(speeds)))


def _near_separation(left: Sampled, right: Sampled, fastest: Array | float = 0.0) -> Bools:
    """Tell where a margin could vanish between neighbours (D, N) if it changes as fast as `fastest`."""
    before, after = left.rows[2], right.rows[2]
    speed = np.maximum(np.maximum(_speed(left), _speed(right)), fastest)
    least = np.maximum(2 * (right.phases - left.phases) * speed, left.blur)
    clear = (np.minimum(np.abs(before), np.abs(after)) > least) & (before * after > 0)
    return np.asarray(np.isfinite(before + after) & ~clear & ~_behind(clear & (before < 0)))


def _unclear(left: Sampled, right: Sampled, fastest: Array) -> Bools:
    """Tell between which neighbours a margin near nothing could have two extremes (D, N).

    Where neither has a rate, at a limit of the dyad before, floats cannot tell, and closer samples would not.
    A rate that vanishes, as at the dyad's own limit, may be of either sign by rounding.
    """
    step = right.phases - left.phases
    (r, b, _, d), (s, c, _, e) = left.rows, right.rows
    size = np.max(np.abs([r, s, step * b, step * c]), axis=0)
    even = np.abs((s - r) - step / 2 * (b + c)) <= UNEVEN * size
    none = (r * s > 0) & (r * (r + step * b) > 0) & (s * (s - step * c) > 0)
    still = np.minimum(np.abs(r), np.abs(s)) <= STANDSTILL * size
    one = ((r * s <= 0) | still) & (b * c > 0)
    flat = size * step * np.maximum(np.abs(d), np.abs(e)) <= FLAT
    blind = ~np.isfinite(r) & ~np.isfinite(s)
    return np.asarray(_near_separation(left, right, fastest) & ~(even & (none | one)) & ~flat & ~blind)


def _turning(samples: Sampled, barely: Array) -> Bools:
    """Tell between which neighbours a separation near a limit has its extreme (D, N - 1)."""
    positive, margins = samples.rows[0] > 0, samples.rows[2]
    low = (np.minimum(margins[:, 1:], margins[:, :-1]) > 0) & (margins[:, 1:] <= barely[:, None])
    near = _near_separation(*_neighbours(samples)) | low
    # Between two cranks that turn alike the separation is constant, and its changes are rounding.
    moves = _fastest_change(samples)[:, None] > samples.blur
    return np.asarray(near & moves & (positive[:, 1:] != positive[:, :-1]))


def _spans_limits(samples: Sampled) -> Bools:
    """Tell between which neighbours a separation passes from one limit to the other (D, N - 1)."""
    before, after = (one.rows for one in _neighbours(samples))
    return np.asarray((before[2] < 0) & (after[2] < 0) & ((before[3] > 0) != (after[3] > 0)))


def _neighbours(samples: Sampled) -> tuple[Sampled, Sampled]:
    return samples.at(slice(None, -1)), samples.at(slice(1, None))


def _places(sampled: Callable[[Array], Sampled], samples: Sampled, cells: Bools, row: int) -> list[Array]:
    """Return for every dyad where that row of its samples changes its sign in the cells."""
    dyads, index = np.nonzero(cells)
    if not len(index):
        return [np.empty(0) for _ in cells]
    start = samples.rows[row, dyads, index] > 0

    def alike(phases: Array) -> Bools:
        return np.asarray((sampled(phases).rows[row][dyads, each] > 0) == start)

    each = np.arange(len(dyads))
    ends = ends_of(alike, samples.phases[index], samples.phases[index + 1], BESIDE_AN_EXTREME)
    return [ends[dyads == dyad] for dyad in range(len(cells))]


def _low(
    assembly: Assembly, name: str, extremes: tuple[Array, Array], between: tuple[float, float]
) -> tuple[Array, Array]:
    """Return the extremes (phases, margins) with a margin `between` two, but not at the dyad's own limit."""
    phases, margins = extremes
    away = [not _at_own_end(assembly.path, name, phase) for phase in phases.tolist()]
    inside = np.array(away, bool) & assembly.path.passes(phases)
    low = (margins >= between[0]) & (margins <= between[1]) & inside
    return phases[low], margins[low]


def _exact_extremes(exact: ExactWalk, name: str, phases: Array) -> Iterator[Extreme]:
    """Yield the extremes at which floats cannot tell a dyad's margin from nothing."""
    if not len(phases):
        return
    extreme = extremes(exact, name)
    for phase in phases.tolist():
        place, gap, reach = extreme(phase)
        closes = 0 if abs(gap) <= ROUNDED_LENGTHS * exact.assembly.linkage.longest else 1 if gap > 0 else -1
        yield Extreme(phase, place, closes, reach)


def _at_own_end(path: InputPath, name: str, phase: float) -> bool:
    ends = zip(path.ends, (0.0, math.pi), strict=False)
    return any(end == name and abs(math.remainder(phase - at, 2 * math.pi)) <= AT_END for end, at in ends)


def _failing(samples: Sampled, settled: Sequence[Sequence[Extreme]]) -> Bools:
    """Tell whether each dyad fails to close at each sample (D, N)."""
    failing = ~(samples.rows[2] >= -samples.blur)
    for row, extremes in enumerate(settled):
        for extreme in extremes:
            failing[row, np.searchsorted(samples.phases, extreme.phase)] = extreme.closes < 0
    return np.asarray(failing)


# Limits and change points of dyads further down the chain, found on the cycle.
#
# Both ends of such a dyad move, so there is no closed form: where it closes follows from its separation's
# extremes (the part before this one). The zero of its margin U·W next to the start is bracketed and bisected,
# and the input then swings between the limits like any other. Next to a limit U·W itself has only half a
# float's digits left; there its quotient by the distance to the limit, which is smooth, is taken from a
# polynomial (the first part).
#
# At a change point the margin touches zero without crossing it, as the dyad's bars fall into one line for an
# instant; what drives the dyad is at an extreme there.

NO_RANGE = "the input has no range on which every dyad can be closed"
KEPT = ((False, False), (True, False), (False, True), (True, True))
"""At which ends a swing may keep its closures, and come back the way it went, the best first."""
CUTS = 8
"""The most times a path is cut back: a dyad may show its limit only once the one before keeps its range."""


class TooManyChangePoints(AssemblyError):
    """A dyad passes more change points than are worked out."""


def stopped(assembly: Assembly, linkage: Linkage, apart: Separations) -> Assembly:
    """Return the assembly on the path that its dyads leave to its input.

    It tells how far the input goes, but nothing can be solved on it. Arguments and errors as in `restricted`.
    """
    return assembly if apart.closes else _cut_back(assembly, linkage, apart)


def restricted(assembly: Assembly, linkage: Linkage, apart: Separations) -> Assembly:
    """Return the assembly with its input's path cut back to what every dyad allows.

    `linkage` has the lengths as given, for the text of an AssemblyError; `apart` are the margins of the dyads
    on moving points.
    """
    if not apart.names:
        return assembly
    closes = apart.closes
    if assembly.course and not assembly.course.by_angle:
        if not closes or any(map(apart.touches, apart.names)):
            raise DyadAtLimit("a dyad comes to a limit on the path of the links that are solved together")
        return fitted(assembly)
    whole, on_whole = through_change_points(assembly, apart)
    if closes and (whole is assembly or _runs_through(whole, on_whole)):
        return fitted(whole)
    if closes:
        # A dyad cannot be closed only on the closures beyond a change point.
        assembly, apart = whole, on_whole
    return fitted(_cut_back(assembly, linkage, apart))


def _cut_back(assembly: Assembly, linkage: Linkage, apart: Separations) -> Assembly:
    """Return the assembly on the swing around the start that every dyad allows.

    At a limit it runs through onto the other closure where all dyads close on the whole swing beyond it, too,
    and have their limits at the same places. Else the input turns back there, and keeps its closures.
    """
    swing, limited, on_limited = _cut(assembly, linkage, apart)
    refusal = AssemblyError(NO_RANGE)
    for keeps in KEPT[-1:] if all(swing.keeps) else KEPT:
        try:
            if keeps != swing.keeps:
                limited, on_limited = _limited(assembly, replace(swing, keeps=keeps))
            limited, on_limited = through_change_points(limited, on_limited)
        except TooManyChangePoints:  # with less of the way there might be fewer, and not say so
            raise
        except AssemblyError as error:  # beyond one limit another dyad may rest at its own
            refusal = error
            continue
        if _runs_through(limited, on_limited):
            return limited
    raise refusal


def _cut(assembly: Assembly, linkage: Linkage, apart: Separations) -> tuple[Swing, Assembly, Separations]:
    """Return the swing around the start on which every dyad closes on the way up, and the margins on it."""
    first = apart.fails.argmax(axis=0)
    if apart.fails.any(axis=0).all():
        name = apart.names[int(first.max())]
        most = _most(assembly, name, apart.phases)
        raise AssemblyError(f"joint {name}: {linkage.joint(name).why_apart(*most, linkage.unit)}")
    on_swing, limited = apart, assembly
    for _ in range(CUTS):
        cut = limited.path.cut(*_open_interval(limited, on_swing))
        swing = Swing(*cut, keeps=(linkage.drive.retraced,) * 2)
        if swing.amplitude < NO_WAY:
            raise AssemblyError(f"joint {swing.ends[0]}: {ONE_PLACE}")
        limited, on_swing = _limited(assembly, swing)
        up = (on_swing.phases > 0) & (on_swing.phases < math.pi)  # at its ends rounding alone decides
        if not on_swing.fails[:, up].any():
            break
    return swing, limited, on_swing


def _limited(assembly: Assembly, path: Swing) -> tuple[Assembly, Separations]:
    """Return the assembly on another path, its closures named anew, and its dyads' margins there."""
    dyads = [name for name in dict.fromkeys(path.ends) if name and name not in assembly.loops]
    ends = {name: tuple(End(upper) for upper in (False, True) if path.ends[upper] == name) for name in dyads}
    chain = {name: ChainRoot(ends[name], 0.0) for name in dyads}
    limited = replace(resigned(replace(assembly, path=path, chain={})), chain=chain)
    return limited, separations(limited)


def _most(assembly: Assembly, name: str, phases: Array) -> tuple[float, float]:
    """Return the greatest values of the factors U and W of a dyad, in squares of the scene's unit."""
    closing = walk_at(assembly, Graph().input("x"), Slope(0.0)).closings[name]
    with np.errstate(all="ignore"):
        u, w = (float(np.nanmax(values)) for values in batch({"x": True}, [closing.u, closing.w])(phases))
    return u * assembly.unscale**2, w * assembly.unscale**2


def _runs_through(assembly: Assembly, apart: Separations) -> bool:
    """Tell whether every dyad closes all the way, and those that limit the input do so at each visit.

    One that keeps away from its limits, as `apart` has it, limits nothing on this path.
    """
    path = assembly.path
    visits = np.arange(-1, 2 * path.periods + 1, dtype=np.float64)
    visits = visits[path.passes(visits * math.pi)]
    places = (visits[visits % 2 == upper] * math.pi for upper in (0, 1))
    return apart.closes and all(
        name in apart.names and bool((np.abs(apart.margins(there)[apart.names.index(name)]) <= USED_UP).all())
        for name, there in zip(path.ends, places, strict=False)
        if name and name not in assembly.loops
    )


def _open_interval(assembly: Assembly, apart: Separations) -> tuple[Limit, Limit]:
    """Return the ends of the interval around the start, or the widest one where the start is not in one."""
    phases, failing, home = assembly.path.around_start(
        assembly.linkage.drive.start, apart.phases, apart.fails
    )
    is_open = np.asarray(~failing.any(axis=0))
    if not is_open.any():  # cut back for one dyad, nothing is left to another
        raise AssemblyError(NO_RANGE)
    first, last = _run_around(is_open, home, phases)
    places = ((first, first - 1), (last, last + 1))
    brackets = {outside: inside for inside, outside in places if 0 <= outside < len(phases)}
    limits = _limits(
        apart, phases[list(brackets.values())], phases[list(brackets)], failing[:, list(brackets)]
    )
    refiner = cache(partial(refining, ExactWalk(assembly)))  # one dyad mostly limits both ends
    known: dict[int, Limit] = {
        outside: (refiner(name)(place), name) for outside, (place, name) in zip(brackets, limits, strict=True)
    }
    below, above = (known.get(outside, (Sum(float(phases[inside])), None)) for inside, outside in places)
    return below, above


def open_places(assembly: Assembly, apart: Separations) -> list[float]:
    """Return for each range of the input on which every dyad closes a place of it within."""
    phases, failing, _ = assembly.path.around_start(assembly.linkage.drive.start, apart.phases, apart.fails)
    first, last = _runs(np.asarray(~failing.any(axis=0)))
    middles = (phases[first] + phases[last]) / 2
    once = (middles >= 0) & (middles < 2 * math.pi * assembly.path.periods)
    places: list[float] = assembly.path.coordinates(middles[once]).tolist()
    return places


def _runs(is_open: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the first and the last place of each open run."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], is_open.astype(np.int8), [0]])))
    return edges[::2], edges[1::2] - 1


def _run_around(is_open: NDArray[np.bool_], home: int, phases: Array) -> tuple[int, int]:
    """Return the first and last place of the open run at `home`, else of the widest (the nearest of equals).

    Where the input turns, each run comes again, and at the edge of the phases a part of it only.
    """
    first, last = _runs(is_open)
    around = (first <= home) & (home <= last)
    width = phases[last] - phases[first]
    widest = around if around.any() else width >= width.max() - SAME_PLACE
    distance = np.where(widest, np.abs((phases[first] + phases[last]) / 2 - phases[home]), math.inf)
    chosen = int(distance.argmin())
    return int(first[chosen]), int(last[chosen])


def _limits(
    apart: Separations, inside: Array, outside: Array, failing: NDArray[np.bool_]
) -> list[tuple[Sum, str]]:
    """Return the limit between each open phase and the shut one beside it, by bisection, and whose it is."""
    if not len(inside):  # the way up is open, and only that back is not
        return []
    margins = apart.margins(outside)
    rows = np.array([_first_failing(*both) for both in zip(failing.T, margins.T, strict=True)], np.intp)
    names, sides = [apart.names[row] for row in rows], np.where(inside > outside, 1, -1)
    own = np.arange(len(rows))

    def closes(phases: Array) -> Bools:
        return np.asarray(apart.margins(phases)[rows, own] >= 0)

    ends = ends_of(closes, inside, outside)
    missed = (apart.end_of_gap(*end) for end in zip(outside.tolist(), names, sides.tolist(), strict=True))
    starts = (Sum(float(end)) if start is None else start for start, end in zip(missed, ends, strict=True))
    return list(zip(starts, names, strict=True))


def _first_failing(failing: NDArray[np.bool_], margins: Array) -> int:
    """Return the first dyad of the chain that does not close at a phase.

    A dyad whose margin is NaN stands on another that does not close, if only by rounding.
    """
    row = int(failing.argmax())
    before = np.flatnonzero(margins[:row] < 0)
    return int(before[0]) if math.isnan(margins[row]) and len(before) else row


def through_change_points(assembly: Assembly, apart: Separations) -> tuple[Assembly, Separations]:
    """Return the assembly with the zeros of the dyads on moving points, and the margins on it.

    The dyads are taken in the chain's order: where one passes onto its other closure, those that stand on it
    move differently, and may no longer come near their limits.
    """
    names = apart.names
    for name in names:
        if name not in apart.names:
            continue
        through = _through(assembly, name, apart)
        if apart.touches(name) and name != apart.names[-1]:
            apart = separations(through)
        assembly = through
    return assembly, apart


def _through(assembly: Assembly, name: str, apart: Separations) -> Assembly:
    """Return the assembly with one dyad's zeros: the known limits, its change points and near touches."""
    path, known = assembly.path, assembly.chain.get(name, ChainRoot((), 0.0))
    touches = tuple(Touch(path.place(phase), path.periods, path.amplitude) for phase in apart.touches(name))
    near_touches = tuple(
        NearTouch(path.place(phase), path.periods, path.amplitude) for phase in apart.near_touches(name)
    )
    root = ChainRoot((*known.zeros, *touches), apart.scales[name] * NO_DIGITS, near_touches=near_touches)
    if not (root.zeros or near_touches):
        return assembly
    if (passed := len(root.zeros) + len(near_touches)) > MOST_CHANGE_POINTS:
        raise TooManyChangePoints(
            f"joint {name}: it passes {passed:,} change points, or comes near them, until every joint is "
            f"back, and {MOST_CHANGE_POINTS} are the most here; give its gears smaller ratios"
        )
    side = root.side(path.state(JUST_AFTER, Slope(1.0)))
    assert isinstance(side, float)
    if len(touches) % 2:
        path = path.doubled()
        if path.periods > (most := most_turns(assembly.linkage)):
            raise AssemblyError(
                f"joint {name}: with the change points up to this one every joint is back after "
                f"{path.periods:,} turns only, and {most:,} are the most here;"
                " make one of its lengths a little longer or shorter"
            )
    return replace(assembly, path=path, chain={**assembly.chain, name: replace(root, sign=side)})
