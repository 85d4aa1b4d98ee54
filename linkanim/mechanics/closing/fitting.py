"""Where the root of a dyad on moving points vanishes, or nearly, and what is smooth there, in fifty digits.

The formulas of the linkage are compiled for decimals, so a margin has digits left wherever it matters:
its zeros come from Newton's method, and R with margin = z²·R² (`chain`) from interpolation.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from decimal import Decimal, localcontext
from typing import NamedTuple

from linkanim.errors import AssemblyError
from linkanim.mechanics.closing.assemble import precise
from linkanim.mechanics.closing.chain import (
    ChainRoot,
    Closing,
    Dip,
    End,
    Fitted,
    Near,
    PolynomialFit,
    Stationary,
    Zero,
)
from linkanim.mechanics.closing.kinds import walk_at, walked
from linkanim.mechanics.closing.walk import Assembly
from linkanim.mechanics.drive.input_path import InputPath
from linkanim.mechanics.drive.swing import Swing
from linkanim.mechanics.formulas.exact import Sum
from linkanim.mechanics.formulas.expression import Graph, Value
from linkanim.mechanics.formulas.planar import Slope
from linkanim.mechanics.formulas.precise import (
    context,
    exactly,
    interpolated,
    nearest_sum,
    nodes,
    sine_and_cosine,
)
from linkanim.mechanics.formulas.program import decimals
from linkanim.mechanics.loops.input_state import swing_by_angle

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
    """A place next to a zero: the argument of what is fitted, z, and there the margin and D."""

    argument: Decimal
    z: Decimal
    margin: Decimal
    across: Decimals = ()


STEPS = 40
NUDGE = Decimal(10) ** -15
CONVERGED = Decimal(10) ** -25
NEARBY = 1e-6
"""How far a zero may lie from where floats have found it."""
POINTS = 20
POINTS_OF_A_DIP = 32
"""Its fit is to hold as far as the margin lacks digits, which may be far."""
WIDEST = 0.5
NARROWEST = 1e-4
"""Beyond a narrower stretch than this the margin itself would have lost its digits."""
NARROWEST_AT_A_LIMIT = 1e-12
"""A margin grows the faster beside a limit, the nearer another one lies behind it."""
TRIES = 16
SHORT = 0.05
"""Half the longest stretch on which a dyad fails to close that is taken as one place."""
LAST = 1e-17
TOLERABLE = 1e-13
"""What the last coefficients of a fit should be beside the first one, and what they may be.

Rounded constants leave kinks of 1e-16 in the margin, where the formula of a loop changes its side.
"""


def refined(assembly: Assembly, name: str, phase: Sum) -> Sum:
    """Return the phase at which a dyad's margin vanishes, from that phase (Newton's method).

    Slopes are differences: the formulas' own rates have constants that are rounded otherwise than the
    margin's.
    """
    run = decimals(("x",), _outputs(_closing(assembly, name))[:1])
    with localcontext(context()):
        place = _newton(phase, lambda place: _steps(run, place)[0])
        return phase if place is None else nearest_sum(place)


def extreme(assembly: Assembly, name: str, phase: float) -> tuple[Sum, float, float]:
    """Return the extreme of a dyad's separation, from that phase in floats (Newton's method).

    With its phase comes by how much of a length the dyad closes there; where that is negative it does not
    within so far, the last, of the phase.
    """
    closing = _closing(assembly, name)
    run = decimals(("x",), (closing.u * closing.w, closing.gap))
    with localcontext(context()):
        found = _newton(Sum(phase), lambda place: _steps(run, place)[1])
        place = Decimal(phase) if found is None else found
        margin, gap = run(place)
        bend = sum(run(place + way)[0] for way in (-NUDGE, NUDGE)) - 2 * margin
        reach = (-2 * margin / bend).sqrt() * NUDGE if margin < 0 < bend else Decimal(0)
        return nearest_sum(place), float(gap), float(reach)


def _steps(run: Callable[..., Decimals], place: Decimal) -> tuple[Decimal, Decimal]:
    """Return the steps to the margin's zero and to its extreme."""
    before, here, after = (run(place + way)[0] for way in (-NUDGE, 0, NUDGE))
    slope, bend = (after - before) / (2 * NUDGE), (after - 2 * here + before) / NUDGE**2
    return here / slope, slope / bend


def _newton(phase: Sum, step: Callable[[Decimal], Decimal]) -> Decimal | None:
    """Return where steps from a phase end; None where that is not nearby."""
    start = place = exactly(phase)
    for _ in range(STEPS):
        way = step(place)
        if not abs(place - way - start) < Decimal(NEARBY):
            return None
        place -= way
        if abs(way) < CONVERGED:
            break
    return place


def _closing(assembly: Assembly, name: str) -> Closing:
    return walk_at(precise(assembly), Graph(exact=True).input("x"), Slope(0.0)).closings[name]


def _outputs(closing: Closing) -> tuple[Value, ...]:
    """Return the margin, and D where the dyad's ends may meet."""
    place = closing.across and closing.across.position
    return (closing.u * closing.w, *((place.x, place.y) if place else ()))


def fitted(assembly: Assembly) -> Assembly:
    """Return the assembly with what is smooth next to the zeros of every dyad on moving points."""
    chain = {name: _fitted_root(assembly, name, root) for name, root in assembly.chain.items()}
    return replace(assembly, chain=chain)


def _fitted_root(assembly: Assembly, name: str, root: ChainRoot) -> ChainRoot:
    with localcontext(context()):
        zeros = [_with_stretch(assembly, name, zero) for zero in root.zeros]
        dips = [_settled(assembly, name, dip) for dip in root.dips]
        return replace(
            root,
            zeros=tuple(replace(zero, near=_near(assembly, name, zero)) for zero in zeros),
            dips=tuple(replace(dip, near=_near(assembly, name, dip)) for dip in dips),
        )


def _settled(assembly: Assembly, name: str, dip: Dip) -> Dip:
    """Return a dip at the extreme itself, which floats have found to half their digits."""
    start = _start(assembly.path, dip)
    place = extreme(assembly, name, float(dip.place - start))[0] + start
    return replace(dip, place=place)


def _with_stretch(assembly: Assembly, name: str, zero: Zero) -> Zero:
    """Return a limit with the stretch behind it on which the dyad does not close, where that is short."""
    path = assembly.path
    if not isinstance(zero, End) or not isinstance(path, Swing):
        return zero
    sampled = _by_way(assembly, path, name, zero)
    before, here, after = (sampled(way).margin for way in (-NUDGE, Decimal(0), NUDGE))
    slope, bend = (after - before) / (2 * NUDGE), (after - 2 * here + before) / NUDGE**2
    place = -2 * slope / bend
    if not -Decimal(SHORT) < place < 0:
        return zero
    for _ in range(STEPS):
        low, high = (sampled(place * (1 + way)).margin for way in (-NUDGE, NUDGE))
        step = (low + high) / (high - low) * place * NUDGE
        place -= step
        if not -2 * Decimal(SHORT) < place < 0:
            return zero
        if abs(step) < CONVERGED:
            return replace(zero, stretch=float(-place))
    return zero


def _near(assembly: Assembly, name: str, zero: Fitted) -> Near | None:
    """Fit on the widest stretch where a polynomial holds to the last digit, or nearly; None where none does.

    AssemblyError where the dyad's ends meet without passing each other: D has no direction to go on in.
    """
    sampled, width = _sampler(assembly, name, zero)
    zeroth, best, least = sampled(Decimal(0)), None, TOLERABLE
    narrowest = NARROWEST_AT_A_LIMIT if isinstance(zero, End) else NARROWEST
    points = POINTS_OF_A_DIP if isinstance(zero, Dip) else POINTS
    for _ in range(TRIES):
        half = width / 2 if isinstance(zero, End) else width
        stretch = width, half if isinstance(zero, End) else 0.0, half
        samples = [sampled(Decimal(stretch[1]) + Decimal(half) * node) for node in nodes(points)]
        squares = _squares(samples, zeroth.margin)
        root = _fit(stretch, samples, squares if isinstance(zero, Dip) else [one.sqrt() for one in squares])
        meeting = not isinstance(zero, Dip) and _meet(zeroth.across, samples)
        shares = [_shares(samples, zeroth, k) for k in (0, 1)] if meeting else []
        fits = [root, *(_fit(stretch, samples, values) for values in shares)]
        last = max(_last(fits[:1]), _last(fits[1:]))
        if last <= least and width >= narrowest:
            rest = float(zeroth.margin) if isinstance(zero, Dip) else 0.0
            best, least = Near(root, (fits[1], fits[2]) if meeting else None, rest), last
        if last <= LAST or width < narrowest:
            break
        width *= max(min(0.8 * (LAST / last) ** (1 / points), 0.8), 0.1)
    if best is None and not isinstance(zero, Dip):
        why = PARTING if meeting else TOO_NEAR if isinstance(zero, End) else TURNING_BACK
        raise AssemblyError(f"joint {name}: {why}")
    return best


_Stretch = tuple[float, float, float]
"""Where a fit is made: its width, and the middle and the half of its arguments."""


def _fit(stretch: _Stretch, samples: list[Sample], values: list[Decimal]) -> PolynomialFit:
    """Return the polynomial through the values at the samples' ways."""
    _, centre, half = stretch
    places = [(sample.argument - Decimal(centre)) / Decimal(half) for sample in samples]
    return PolynomialFit(*stretch, tuple(interpolated(places, values)))


def _squares(samples: list[Sample], rest: Decimal) -> list[Decimal]:
    """Return R², NaN beyond another zero; at the zero itself rounding has left a `rest` of the margin."""
    squares = [(sample.margin - rest) / sample.z**2 for sample in samples]
    return [square if square > 0 else Decimal("NaN") for square in squares]


def _shares(samples: list[Sample], zeroth: Sample, component: int) -> list[Decimal]:
    """Return a component of D over the argument; at the zero itself rounding has left a rest of D, too."""
    rest = zeroth.across[component]
    return [(sample.across[component] - rest) / sample.argument for sample in samples]


def _meet(across: Decimals, samples: list[Sample]) -> bool:
    """Tell whether D is nothing at the zero itself, beside what it is around."""
    around = max((abs(value) for sample in samples for value in sample.across), default=Decimal(0))
    return bool(across) and all(abs(value) <= around * Decimal(NEARBY) for value in across)


def _last(fits: list[PolynomialFit]) -> float:
    """Return the last coefficients beside the greatest first one, as they stand to Chebyshev polynomials."""
    size = max((abs(c) for fit in fits for c in fit.coefficients[:2]), default=1.0)
    last = max(
        (abs(c) / 2.0 ** (len(fit.coefficients) - 2) for fit in fits for c in fit.coefficients[-2:]),
        default=0.0,
    )
    return last / size if last < math.inf else math.inf


def _start(path: InputPath, place: Stationary) -> Sum:
    """Return what names a place at phase 0."""
    return Sum(0.0) if place.amplitude else path.place(Sum(0.0))


def _sampler(assembly: Assembly, name: str, zero: Fitted) -> tuple[Callable[[Decimal], Sample], float]:
    """Return the margin, and D, as a function of the way to a zero, and how far that way may go."""
    path = assembly.path
    if isinstance(zero, End):
        assert isinstance(path, Swing)
        return _by_way(assembly, path, name, zero), path.amplitude / 2
    run = decimals(("x",), _outputs(_closing(assembly, name)))
    place, turns = exactly(zero.place) - exactly(_start(path, zero)), zero.turns

    def sampled(argument: Decimal) -> Sample:
        half = Decimal(math.atan(float(argument)))
        margin, *across = run(place + 2 * turns * half)
        z, other = sine_and_cosine(half)
        return Sample(z / other, z, margin, tuple(across))

    return sampled, WIDEST / turns


def _by_way(assembly: Assembly, path: Swing, name: str, end: End) -> Callable[[Decimal], Sample]:
    """Return the margin as a function of half the way to a limit."""
    graph = Graph(exact=True)
    u, v = graph.input("u"), graph.input("v")
    state = swing_by_angle((v - u, u, v), Slope(0.0), path.low, path.high)
    run = decimals(("u", "v"), _outputs(walked(precise(assembly), state).closings[name])[:1])
    amplitude = (exactly(path.high) - exactly(path.low)) / 2

    def sampled(way: Decimal) -> Sample:
        margin = run(*((way, amplitude - way) if end.upper else (amplitude - way, way)))[0]
        return Sample(way, (way * (way + Decimal(end.stretch)) if end.stretch else way).sqrt(), margin)

    return sampled
