"""Find linkages that generate a function: `linkanim.function`.

Its parts, in reading order:

- The function that a linkage is to generate: an expression in x as one types it, or a table.
- `linkanim.function`: from a function to the linkages whose output follows it as their input turns.
"""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from linkanim import units
from linkanim.bounds import NUMBERS, can_be_computed
from linkanim.errors import AssemblyError, BadInput, SceneError
from linkanim.frozen import frozen
from linkanim.intake import meant
from linkanim.mechanics.search import sign_changes
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.synthesis.answers import Figures, least_along
from linkanim.synthesis.burmester import Bars, CentreCurve, Poses, burmester_points, circle_points, polished
from linkanim.synthesis.drivers import Driver, all_driven, place_of
from linkanim.synthesis.front import differ, led
from linkanim.synthesis.linkages import KINDS, LinkageKind, Real, refuse_count
from linkanim.units import shown

# The function that a linkage is to generate: an expression in x as one types it, or a table.
#
# An expression is read by a small grammar of its own over Python's syntax: numbers, x, pi and e, the four
# operations, powers as ^ or **, and the functions in `FUNCTIONS`. No other name is looked up, and no code is
# run.

LONGEST = 200
"""The most characters of an expression."""
FEWEST_ROWS, MOST_ROWS = 4, 2000
_LOOKED_AT = 721
"""The number of places at which a function is evaluated to check it."""
_FLAT = 1e-12
"""The change, as a share of its values' size, up to which a function is constant."""

FUNCTIONS: Mapping[str, Callable[[Real], Real]] = {
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
    "exp": np.exp,
    "log": np.log,
    "ln": np.log,
    "log10": np.log10,
    "log2": np.log2,
    "sqrt": np.sqrt,
    "abs": np.abs,
}
_NUMBERS = {"pi": math.pi, "e": math.e}
_BINARY: Mapping[type[ast.operator], Callable[[Real, Real], Real]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
_UNARY: Mapping[type[ast.unaryop], Callable[[Real], Real]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
}


@frozen(eq=False)
class GivenFunction:
    """A function in words, over x from `first` to `last`, with the callable for its values (k,) at x (k,).

    BadInput for an empty range, for values that are no numbers, and for a constant.
    """

    words: str
    first: float
    last: float
    values: Callable[[Real], Real]
    pairs: Real | None = None
    """The x at which alone it is known, where it is pairs of angles; a smooth curve connects them."""

    def __post_init__(self) -> None:
        """Refuse what no linkage can follow."""
        if not (math.isfinite(self.first) and math.isfinite(self.last) and self.first < self.last):
            raise BadInput(
                f"x from {self.first:g} to {self.last:g}: give two numbers, the first below the second"
            )
        if not can_be_computed(self.first, self.last, self.last - self.first):
            raise BadInput(f"x from {self.first:g} to {self.last:g}: give each {NUMBERS}")
        x = np.linspace(self.first, self.last, _LOOKED_AT)
        with np.errstate(all="ignore"):
            y = np.asarray(self.values(x), dtype=np.float64)
        wrong = np.flatnonzero(~(np.abs(y) < 1e12))
        if len(wrong):
            raise BadInput(
                f"{self.words} has no value, or none that can be computed with, at x = {x[wrong[0]]:.6g}; "
                "choose a range without that"
            )
        if np.ptp(y) <= _FLAT * np.abs(y).max():
            raise BadInput(f"{self.words} is constant from {self.first:g} to {self.last:g}: nothing moves")

    def __call__(self, x: Real) -> Real:
        """Return its values."""
        return np.asarray(self.values(np.asarray(x, dtype=np.float64)), dtype=np.float64)

    @cached_property
    def start(self) -> float:
        """Its value at the first x."""
        return float(self(np.array([self.first]))[0])

    @cached_property
    def span(self) -> float:
        """The growth of y from the first x to the last; for a function that turns back, least to greatest."""
        y = self(np.linspace(self.first, self.last, _LOOKED_AT))
        steps = np.diff(y)
        if (steps >= 0).all() or (steps <= 0).all():
            return float(y[-1] - y[0])
        return float(np.ptp(y))

    def x_share(self, x: Real) -> Real:
        """Return how far x is along its range, from 0 to 1."""
        return np.asarray((x - self.first) / (self.last - self.first))

    def y_share(self, x: Real) -> Real:
        """Return how far y is at x from its value at the start, in spans."""
        return np.asarray((self(x) - self.start) / self.span)

    def chebyshev(self, count: int) -> Real:
        """Return `count` values of x with Chebyshev's spacing: the zeros of his polynomial of that degree."""
        middle, half = (self.first + self.last) / 2, (self.last - self.first) / 2
        return np.asarray(middle - half * np.cos((2 * np.arange(count) + 1) * math.pi / (2 * count)))

    def precision(self, count: int) -> Real:
        """Return the x at which a linkage is to be exact: Chebyshev's, or those of the pairs."""
        return self.chebyshev(count) if self.pairs is None else self.pairs


def expression(text: str, first: float, last: float) -> GivenFunction:
    """Return the function of a text such as "y = log10(x)"; BadInput, with what to write, for other texts."""
    stated = text.strip()
    left, sign, right = stated.partition("=")
    body = right if sign else stated
    if sign and left.strip() not in ("y", "f(x)"):
        raise BadInput(f'{shown(text)}: write what y is, as in "y = log10(x)"')
    if len(stated) > LONGEST:
        raise BadInput(f"the expression has {len(stated)} characters; write {LONGEST} at the most")
    try:
        tree = ast.parse(body.strip().replace("^", "**"), mode="eval").body
        values = _read(tree, text)
    except (SyntaxError, ValueError, OverflowError, RecursionError, MemoryError):
        raise BadInput(
            f'{shown(text)} is no expression in x; write it as in "y = 2*x^2 + sin(x)", with * in products'
        ) from None
    return GivenFunction(f"y = {body.strip()}", first, last, values)


def _read(node: ast.expr, text: str) -> Callable[[Real], Real]:
    """Return the callable for the values of a part of an expression."""
    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            constant = float(number)
            return lambda x: np.full_like(x, constant)
        case ast.Name(id="x"):
            return lambda x: x
        case ast.Name(id=name) if name in _NUMBERS:
            return lambda x: np.full_like(x, _NUMBERS[name])
        case ast.Name(id=name):
            raise BadInput(f"{shown(text)}: {shown(name)} is not known; the variable is x{_known(name)}")
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _BINARY:
            combine, one, other = _BINARY[type(op)], _read(left, text), _read(right, text)
            return lambda x: combine(one(x), other(x))
        case ast.UnaryOp(op=sign, operand=inner) if type(sign) in _UNARY:
            change, value = _UNARY[type(sign)], _read(inner, text)
            return lambda x: change(value(x))
        case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]) if name in FUNCTIONS:
            function, value = FUNCTIONS[name], _read(argument, text)
            return lambda x: function(value(x))
        case ast.Call(func=ast.Name(id=name)) if name in FUNCTIONS:
            raise BadInput(f"{shown(text)}: {name} takes one value, as in {name}(x)")
        case ast.Call(func=ast.Name(id=name)):
            raise BadInput(f"{shown(text)}: {shown(name)} is no function that is known{_known(name)}")
    raise BadInput(
        f"{shown(text)}: only numbers, x, + - * / ^ and {', '.join(FUNCTIONS)} can stand in an expression"
    )


def _known(name: str) -> str:
    names = ("x", *_NUMBERS, *FUNCTIONS)
    return f", functions are {', '.join(FUNCTIONS)}{meant(name, names)}"


def table(rows: Sequence[tuple[float, float]], words: str = "y of a table") -> GivenFunction:
    """Return the function through the rows (x, y) of a table, x growing: a natural cubic spline.

    BadInput for too few rows, or where x does not grow.
    """
    if not FEWEST_ROWS <= len(rows) <= MOST_ROWS:
        raise BadInput(f"{words}: {len(rows)} rows; give {FEWEST_ROWS} to {MOST_ROWS:,}, x and y in each")
    x, y = np.array(rows, dtype=np.float64).T
    back = np.flatnonzero(np.diff(x) <= 0)
    if len(back):
        raise BadInput(
            f"{words}: x goes from {x[back[0]]:g} to {x[back[0] + 1]:g}; it must grow from row to row"
        )
    with np.errstate(all="ignore"):  # what overflows is refused as a value
        bends = _bends(x, y)
    return GivenFunction(words, float(x[0]), float(x[-1]), lambda at: _spline(x, y, bends, at))


def pairs_of(rows: Sequence[Sequence[float]] | Real, *, sliding: bool) -> GivenFunction:
    """Return pairs of angles (rad), or of an angle and a place, as a function of the first in degrees.

    BadInput for another number of them than 3 to 5, and for two with one first angle.
    """
    pairs = sorted((float(one), float(other)) for one, other in rows)
    if not FEWEST_POINTS <= len(pairs) <= MOST_POINTS or not can_be_computed(*np.ravel(pairs)):
        raise BadInput(
            f"{len(pairs)} pairs are given: a linkage takes {FEWEST_POINTS} to {MOST_POINTS}, each {NUMBERS}"
        )
    x, y = np.array(pairs).T
    x, y = np.degrees(x), y if sliding else np.degrees(y)
    same = np.flatnonzero(np.diff(x) <= 0)
    if len(same):
        raise BadInput(f"two pairs begin with {x[same[0]]:g} deg; give the crank another angle in each")
    bends, words = _bends(x, y), f"{len(x)} pairs of {'places' if sliding else 'angles'}"
    return GivenFunction(words, float(x[0]), float(x[-1]), lambda at: _spline(x, y, bends, at), x)


def _bends(x: Real, y: Real) -> Real:
    """Return the second derivatives of the natural cubic spline, by elimination in a tridiagonal system."""
    step, slope = np.diff(x), np.diff(y) / np.diff(x)
    diagonal, right = 2 * (step[1:] + step[:-1]), 6 * np.diff(slope)
    for n in range(1, len(diagonal)):
        factor = step[n] / diagonal[n - 1]
        diagonal[n] -= factor * step[n]
        right[n] -= factor * right[n - 1]
    bends = np.zeros(len(x))
    for n in range(len(diagonal) - 1, -1, -1):
        bends[n + 1] = (right[n] - step[n + 1] * bends[n + 2]) / diagonal[n]
    return bends


def _spline(x: Real, y: Real, bends: Real, at: Real) -> Real:
    n = np.clip(np.searchsorted(x, at) - 1, 0, len(x) - 2)
    step = x[n + 1] - x[n]
    low, high = (x[n + 1] - at) / step, (at - x[n]) / step
    bent = (low**3 - low) * bends[n] + (high**3 - high) * bends[n + 1]
    return np.asarray(low * y[n] + high * y[n + 1] + bent * step**2 / 6)


# `linkanim.function`: from a function to the linkages whose output follows it as their input turns.
#
# x is read on the input crank, y on the output, each on an even scale. What the output does is y at as many
# x as there are precision points, to the last digits, and differs from it between them by the structural
# error. Three points leave the directions at which both scales begin, and Freudenstein's equation
#
#     K₁ cos ψ - K₂ cos θ + K₃ = cos(θ - ψ)
#
# is linear in the rest (Freudenstein, Approximate Synthesis of Four-Bar Linkages, Transactions of the ASME
# 77, 1955). Four points leave one choice, five none: seen from the output link the input link takes as many
# poses, and the coupler is a bar of Burmester's between them. As many numbers as there are points then make
# as many extremes of the error, and one more, equal: that is the least error of all (Chebyshev's theorem on
# best approximation), found by Remez's exchange, Newton's steps for numbers that do not go in evenly.

COUNT = 3
FEWEST_POINTS, MOST_POINTS = 3, 5
GROUND, STROKE = 100.0, 100.0
"""The default lengths of the four-bar's ground and of the slider's stroke."""

_FREE = tuple(math.radians(angle) for angle in (60, 90, 120))
"""The ranges (rad) that are tried where one is free."""
_LEAST = math.radians(35)
"""Transmission angles below this one count against a linkage."""
_SLIMMEST = 40.0
"""The largest ratio of the longest link to the shortest one."""
_TRIED, _SEEN, _CURVE = 18, 41, 60
"""The numbers of each scale's directions, of places along the range, and of a curve's bars that are tried."""
_PLACES = 401
"""The number of places along the range among which extremes are searched."""
_EXCHANGES = 25
_SHARES = (1.0, 0.5, 0.25, 0.1, 0.03)
"""The shares of a Newton step that are tried until one reduces the largest error."""
_LEVEL = 1e-9
"""The largest difference, as a share of the error, of extremes that count as equal."""
_SAME, _ALIKE = 1e-6, 1e-3
"""The differences, in angle (rad) and as a share of the longest link, below which two are the same."""
_FARTHEST = 3.0
"""How far to either side of the crank's pivot, in strokes, beginnings of the slider's scale are tried."""
_KEPT, _MORE = 4, 7
"""The linkages that are kept for each pair of ranges, and those that are improved beyond the count."""
_CLOSELY = 2.0**-50
"""Share of a place to which a change of sign is found."""
_FINEST = 1e-15
_POOR = 5.0
"""The power of the ratio of sines by which a transmission angle below the least raises the error."""
_DIGITS = 11
_FINE = 2001
"""The number of places at which the solver's errors are computed."""
_NARROWEST, _WIDEST = math.radians(1), math.radians(340)


@frozen(eq=False)
class FunctionTask:
    """A function, the ranges and starts of both scales (None if free), and the number of precision points.

    Ranges and starts are angles (rad), for a slider lengths; a negative range runs backwards.
    """

    function: GivenFunction
    kind: LinkageKind
    points: int
    input_range: float | None = None
    input_start: float | None = None
    output_range: float | None = None
    output_start: float | None = None
    level: bool = True
    fewer: bool = False
    """Whether fewer precision points may be taken."""
    unit: str = "mm"
    name: str = "function"
    source: str = "made by linkanim for a function"

    @property
    def length(self) -> float:
        """The unit of length of its linkages, in the scene's unit."""
        if self.kind.turning:
            return GROUND
        return STROKE if self.output_range is None else abs(self.output_range)

    @property
    def scales(self) -> tuple[float, float]:
        """The units of input and output."""
        return 1.0, 1.0 if self.kind.turning else self.length


@frozen(eq=False)
class Generated:
    """A linkage that generates a function; errors in y's unit, angles in radians, for a slider lengths."""

    scene: Scene = field(repr=False)
    parameters: Mapping[str, float]
    error: float
    """The largest structural error."""
    extremes: tuple[tuple[float, float], ...]
    """The extremes of the structural error as (x, error), with both ends."""
    points: Real
    """The precision points: x at which there is no error."""
    input_start: float
    input_range: float
    output_start: float
    output_range: float
    transmission_angle: float
    """The least one over the range (rad)."""
    chebyshev: float
    """The largest structural error before levelling, with Chebyshev's points."""
    task: FunctionTask = field(repr=False)
    driver: Driver | None = field(default=None, repr=False)
    """What swings its input, if the scene has a motor that turns fully for that."""

    def errors(self, x: Real) -> Real:
        """Return the structural errors at x as the solver has them, in y's unit."""
        scales = self.input_start, self.input_range, self.output_start, self.output_range
        return _solved_errors(self.driver.before if self.driver else self.scene, self.task, scales, x)

    @property
    def class_name(self) -> str:
        """The linkage's class, in words."""
        return self.scene.info.class_name

    @property
    def output_body(self) -> str:
        """The body on which y is read."""
        return self.task.kind.output

    @property
    def size(self) -> float:
        """The longest link."""
        return max(self.parameters[name] for name in self.task.kind.links)

    @property
    def figures(self) -> Figures:
        """The figures by which it is compared with others, the size in lengths of ground or stroke."""
        size = self.size / self.task.length
        return Figures(self.error / abs(self.task.function.span), size, size, self.transmission_angle)


def _lengths(kind: LinkageKind, rows: Real) -> Real:
    """Return the lengths of the links (k, m), a four-bar's ground first."""
    links = rows[:, : len(kind.links)]
    return np.column_stack([np.ones(len(rows)), links]) if kind.turning else links


def _poses(kind: LinkageKind, inputs: Real, outputs: Real) -> Poses:
    """Return the crank's poses as seen from the output, by both movements since the first x."""
    if not kind.turning:
        return Poses(-outputs.astype(np.complex128), inputs)
    turned = inputs - outputs
    return Poses(-np.exp(-1j * outputs), turned - math.tau * np.round((turned - turned[0]) / math.tau))


def _rows(kind: LinkageKind, poses: Poses, bars: Bars, first: tuple[float, float]) -> Real:
    """Return the rows of couplers (k,) for such poses; `first` is the movement at the first pose.

    The bar of length 1 between a four-bar's pivots is left out.
    """
    turn = first[1] - first[0] if kind.turning else -first[0]
    pin = (bars.circle - poses.origins[0]) * np.exp(1j * turn)
    crank, coupler = np.abs(pin), np.abs(bars.circle - bars.centre)
    if kind.turning:
        rocker = np.abs(bars.centre)
        rows = np.stack([crank, coupler, rocker, np.angle(pin), np.angle(bars.centre)], axis=1)
        return np.asarray(rows[(crank > _SAME) & (rocker > _SAME)])
    rows = np.stack([crank, coupler, bars.centre.imag, np.angle(pin), bars.centre.real], axis=1)
    return np.asarray(rows[crank > _SAME])


def function(
    given: str | Sequence[Sequence[float]] | Real,
    first: float | None = None,
    last: float | None = None,
    *,
    count: int = COUNT,
    **options: Any,
) -> tuple[Generated, ...]:
    """Return linkages whose output follows a function as their input turns, the best first.

    That is the one to build: it can be driven, at a transmission angle of 30 degrees at least, where that
    takes no more than twice the smallest error; the others follow by their errors, as with `prefer` "exact"
    all do.

    `given` is an expression in x as "y = log10(x)", over x from `first` to `last`, or the rows (x, y) of a
    table. `driver` gives each answer whose input swings a motor that turns fully, or says where that stands
    (x, y). The other options are described below. BadInput for what is not a function, for ranges that make
    no sense, and if no linkage was found.
    """
    refuse_count(count)
    prefer = options.pop("prefer", "balanced")
    if prefer not in ("balanced", "exact"):
        raise BadInput(f"prefer={shown(prefer)}: take balanced or exact")
    motor = options.pop("driver", False)
    place = place_of(motor)
    generated = answers(task_of(given, first, last, **options), count, exact=prefer == "exact")
    if motor is False:
        return generated
    return all_driven(generated, place, lambda one: one.input_start + np.array([0.0, one.input_range]))


def task_of(
    given: str | Sequence[Sequence[float]] | Real,
    first: float | None = None,
    last: float | None = None,
    *,
    kind: str = "four-bar",
    points: int | None = None,
    input_range: float | None = None,
    input_start: float | None = None,
    output_range: float | None = None,
    output_start: float | None = None,
    level: bool = True,
    pairs: bool = False,
    unit: str = "mm",
    name: str = "function",
    source: str = "made by linkanim for a function",
) -> FunctionTask:
    """Return what is asked for, checked.

    `kind` is "four-bar" or "slider-crank". `points` is the number of precision points, 3 to 5; by default as
    many as the other options leave room for. The ranges and starts of the scales on input and output are in
    radians, those of a slider in `unit`; negative ranges run backwards. With `level` False the precision
    points keep Chebyshev's spacing.

    With `pairs`, `given` is three to five pairs of the crank's angle and the output's (rad; a slider's place
    in `unit`), and nothing is said of points, ranges and starts. Three are taken as they are, from the line
    through the pivots, or along the slider's line from the crank's pivot; of four and five the differences
    are, and where both scales begin is found.
    """
    if kind not in KINDS:
        raise BadInput(f"kind={shown(kind)}: take {' or '.join(KINDS)}")
    units.metre(unit)
    if pairs:
        own = points, first, last, input_range, input_start, output_range, output_start
        if any(one is not None for one in own) or not level:
            raise BadInput("pairs are taken as they are: leave out ranges, starts and the number of points")
        return _task_of_pairs(given, KINDS[kind], unit, name, source)
    if isinstance(given, str):
        if first is None or last is None:
            raise BadInput(f"{shown(given)}: say over which x, from and to")
        target = expression(given, float(first), float(last))
    else:
        target = table([(float(x), float(y)) for x, y in given])
    starts = (input_start is not None) + (output_start is not None)
    most = MOST_POINTS - starts
    if points is not None and not FEWEST_POINTS <= points <= MOST_POINTS:
        raise BadInput(
            f"points={points!r}: a linkage meets a function in {FEWEST_POINTS} to {MOST_POINTS} points"
        )
    if points is not None and points > most:
        raise BadInput(f"{points} precision points leave no choice of where {starts} scales begin; {most} do")
    sliding = kind == "slider-crank"
    for what, value, most_of_it in (
        ("input", input_range, _WIDEST),
        ("output", output_range, math.inf if sliding else _WIDEST),
    ):
        if value is not None and not (can_be_computed(value) and _NARROWEST <= abs(value) <= most_of_it):
            words = f"{math.degrees(value):g} deg" if math.isfinite(most_of_it) else f"{value:g}"
            raise BadInput(f"the {what} goes over {words}; give an angle of 1 to 340 deg, or a length")
    for start in (input_start, output_start):
        if start is not None and not can_be_computed(start):
            raise BadInput(f"a scale begins at {start!r}; give {NUMBERS}")
    return FunctionTask(
        target, KINDS[kind], points or most, input_range, input_start, output_range, output_start,
        level, points is None, unit, name, source,
    )  # fmt: skip


def _task_of_pairs(
    given: str | Sequence[Sequence[float]] | Real, kind: LinkageKind, unit: str, name: str, source: str
) -> FunctionTask:
    """Return the task of pairs of angles: both ranges follow from them, and of three both starts."""
    if isinstance(given, str) or np.ndim(given) != 2 or np.shape(given)[1] != 2:
        raise BadInput("pairs: give rows of two numbers, the crank's angle and the output's")
    target = pairs_of(given, sliding=not kind.turning)
    wide, high = math.radians(target.last - target.first), target.span
    if not _NARROWEST <= wide <= _WIDEST:
        raise BadInput(
            f"the pairs turn the crank by {math.degrees(wide):g} deg; let them turn it by 1 to 340 deg in all"
        )
    assert target.pairs is not None
    start = target.start
    starts = (math.radians(target.first), math.radians(start) if kind.turning else start)
    first, last = starts if len(target.pairs) == FEWEST_POINTS else (None, None)
    high = math.radians(high) if kind.turning else high
    return FunctionTask(
        target, kind, len(target.pairs), wide, first, high, last, False, False, unit, name, source
    )  # fmt: skip


def answers(task: FunctionTask, count: int = COUNT, *, exact: bool = False) -> tuple[Generated, ...]:
    """Return the best different linkages, each as the solver runs it; BadInput where there is none.

    The first is the one to build, the others follow by their errors; `exact` orders all by their errors.
    """
    linkages: list[Generated] = []
    for design in _candidates(task, count):
        one = design.checked()
        if one is not None and (exact or all(differ(one.figures, other.figures) for other in linkages)):
            linkages.append(one)
        if len(linkages) == count:
            break
    if not linkages:
        given = task.input_start is not None or task.output_start is not None
        if task.function.pairs is not None:
            raise BadInput(_no_linkage_of_pairs(task))
        raise BadInput(
            f"no {task.kind.name} was found that follows {task.function.words} over the whole range on "
            f"one branch; {'leave out where a scale begins, ' if given else ''}take other ranges, another "
            "number of precision points, or a shorter piece of it"
        )
    if task.function.pairs is None:
        linkages.sort(key=lambda one: one.error)
    return tuple(linkages if exact else led([one.figures for one in linkages], linkages))


def _no_linkage_of_pairs(task: FunctionTask) -> str:
    """Return why no linkage takes the pairs: which link would point the other way, or that none does."""
    function, kind = task.function, task.kind
    assert function.pairs is not None
    if len(function.pairs) == FEWEST_POINTS:
        inputs = np.radians(function.pairs)
        outputs = np.radians(function(function.pairs)) if kind.turning else function(function.pairs)
        lengths = kind.through(inputs[None], outputs[None] / task.scales[1])[0]
        turned = [("crank's", lengths[0])] + [("rocker's", lengths[2])] * kind.turning
        wrong = [which for which, length in turned if length < 0]
        if wrong:
            which = " and the ".join(wrong)
            return (
                "these 3 pairs need a link that points the other way: add 180 deg to all of the "
                f"{which} angles"
            )
    return (
        f"no {kind.name} takes these {len(function.pairs)} pairs on one branch, with links of less than "
        f"{_SLIMMEST:g} to 1; change one of them a little, or leave one out"
    )


class _Design(NamedTuple):
    """One linkage for a task: its row, its closure, and the ranges of both scales."""

    task: FunctionTask
    row: Real
    closure: float
    input_range: float
    output_range: float
    points: int
    chebyshev: float = math.nan
    """The largest error before it was levelled."""
    left: tuple[int, ...] = ()
    """The columns of the parameters by which it could not be levelled yet."""

    def merit(self) -> float:
        """Return what `_merits` does for it."""
        ranges = self.input_range, self.output_range
        return float(_merits(self.task, self.row[None], np.array([self.closure]), ranges)[0])

    def errors(self, x: Real) -> Real:
        """Return the structural errors at x."""
        ranges = self.input_range, self.output_range
        return np.asarray(_generated(self.task, self.row[None], np.array([self.closure]), ranges, x)[0][0])

    def levelled(self) -> _Design:
        """Return the linkage near by with the smallest largest error, or the same one where none is found.

        As many of its numbers are changed as it has precision points, or, if that is not prescribed, all that
        are not given.
        """
        task = self.task
        starts = [
            column for column, start in ((4, task.output_start), (3, task.input_start)) if start is None
        ]
        few = starts[: self.points - FEWEST_POINTS]
        choices = [
            [0, 1, 2, *sorted(free)] for free in ([few, starts] if task.fewer and few != starts else [few])
        ]
        return min((self._exchanged(columns) for columns in choices), key=_Design.merit)

    def again(self) -> _Design:
        """Return a linkage whose exchange ended early, restarted from the least sum of squared errors."""
        if not self.left:
            return self
        columns = list(self.left)
        other = self._smoothed(columns)._exchanged(columns)
        return min((self, other), key=_Design.merit)

    def _exchanged(self, columns: list[int]) -> _Design:
        """Return a linkage with its largest error made least by some of its numbers.

        Remez's exchange: with n numbers to change, Newton's steps make the errors at n + 1 places equal and
        alternating; then the places are moved to the new extremes of the error.
        """
        design, x = self, np.linspace(self.task.function.first, self.task.function.last, _PLACES)
        places = design._alternating(x, len(columns) + 1)
        if places is None:
            design = design._smoothed(columns)
            places = design._alternating(x, len(columns) + 1)
        design = design._replace(left=tuple(columns))
        worst = np.abs(design.errors(x)).max()
        for _ in range(_EXCHANGES):
            if places is None:
                break
            error = design.errors(places)
            if np.ptp(np.abs(error)) <= _LEVEL * np.abs(error).max():
                return design._replace(left=())
            signs = np.where(np.arange(len(places)) % 2 == 0, 1.0, -1.0)
            step = design._solved_for(places, error, columns, -signs[:, None])
            if step is None:
                break
            for share in _SHARES:
                tried = design._replace(row=design.row + share * step)
                if not np.abs(tried.errors(x)).max() < worst:
                    continue
                after = tried._alternating(x, len(columns) + 1)
                if after is not None and (less := np.abs(tried.errors(after)).max()) < worst:
                    design, places, worst = tried, after, less
                    break
            else:
                break
        return design

    def _alternating(self, x: Real, count: int) -> Real | None:
        """Return `count` extremes of the error with alternating signs; None if there are fewer."""
        places = _extremes(self.errors, x)
        error = self.errors(places)
        peaks: list[int] = []
        for n in np.flatnonzero(np.isfinite(error)):
            if peaks and error[peaks[-1]] * error[n] > 0:
                peaks[-1] = max(peaks[-1], int(n), key=lambda one: abs(error[one]))
            else:
                peaks.append(int(n))
        while len(peaks) > count:
            # neighbours are removed in pairs, so that signs still alternate, except a last single one
            heights = np.abs(error[peaks])
            pairs = np.maximum(heights[1:], heights[:-1])
            if len(peaks) == count + 1 or min(heights[0], heights[-1]) < pairs.min():
                peaks.pop(0 if heights[0] < heights[-1] else -1)
            else:
                least = int(pairs.argmin())
                del peaks[least : least + 2]
        return places[peaks] if len(peaks) == count else None

    def _solved_for(self, places: Real, error: Real, columns: list[int], more: Real) -> Real | None:
        """Return the least-squares step of the row that removes errors; `more` unknowns have columns."""
        function = self.task.function
        unit = function.span / self.output_range
        reached = error / unit + function.y_share(places) * self.output_range
        slopes = self.task.kind.slopes(self.row, function.x_share(places) * self.input_range, reached)
        matrix = np.column_stack([slopes[:, columns] * unit, more])
        if not np.isfinite(matrix).all() or not np.isfinite(error).all():
            return None
        step = np.zeros(len(self.row))
        step[columns] = np.linalg.lstsq(matrix, -error, rcond=1e-13)[0][: len(columns)]
        return step

    def _smoothed(self, columns: list[int]) -> _Design:
        """Return a linkage with a smaller sum of squared errors, by Gauss-Newton steps."""
        design, x = self, self.task.function.chebyshev(_SEEN)
        error = design.errors(x)
        for _ in range(_EXCHANGES):
            step = design._solved_for(x, error, columns, np.empty((len(x), 0)))
            if step is None:
                break
            for share in _SHARES:
                tried = design._replace(row=design.row + share * step)
                after = tried.errors(x)
                if (after**2).sum() < 0.999 * (error**2).sum():
                    design, error = tried, after
                    break
            else:
                break
        return design

    def checked(self) -> Generated | None:
        """Return the linkage, its lengths rounded, as the solver runs it; None where it misses the range."""
        task = self.task
        kind, function, length = task.kind, task.function, task.length
        row = self.row.copy()
        row[:3] = np.round(row[:3] * length, _DIGITS) / length
        whole = (kind.standard(row[None])[0] * length).tolist()
        start, wide = _in_turn(float(row[3]) % math.tau, task.input_start), self.input_range
        document = {
            "title": f"{kind.name.capitalize()} for {function.words}",
            "source": task.source,
            "length_unit": task.unit,
            "drive": {
                "joint": "A",
                "speed": "20 rpm" if wide > 0 else "-20 rpm",
                "start": f"{math.degrees(start)!r} deg",
            },
            **kind.document(dict(zip(kind.parameters, whole, strict=True)), self.closure, traced=False),
            "trace": {"joints": []},
        }
        scale = task.scales[1]
        first, high = float(row[4]) * scale, self.output_range * scale

        def errors(x: Real) -> Real:
            """Return the structural errors as the solver has them."""
            return _solved_errors(scene, task, (start, wide, first, high), x)

        try:
            scene = scene_from(document, name=task.name, where=task.name)
            x = np.linspace(function.first, function.last, _FINE)
            sampled = errors(x)
            if not np.isfinite(sampled).all():
                return None
            extremes = _extremes(errors, x) if function.pairs is None else function.pairs
            worst = errors(extremes)
            if kind.turning:
                seen = float(scene.solve(angle=start, derivatives=0).angle[kind.output])
                first = _in_turn(first, seen if task.output_start is None else task.output_start)
            points = sign_changes(errors, x, _CLOSELY) if task.level else function.precision(self.points)
            stated = {"function": _stated(task, points, (start, wide, first, high))}
            scene = scene_from({**document, **stated}, name=task.name, where=task.name)
        except (AssemblyError, SceneError):
            return None
        ends = min(start, start + wide), max(start, start + wide)
        return Generated(
            scene=scene,
            parameters=({"ground": length} if kind.turning else {})
            | dict(zip(kind.links, map(float, row * length), strict=False)),
            error=float(np.abs(worst).max()),
            extremes=tuple(zip(extremes.tolist(), worst.tolist(), strict=True)),
            points=points,
            input_start=start,
            input_range=wide,
            output_start=first,
            output_range=high,
            transmission_angle=least_along(scene, "angle", ends, (kind.in_line, math.pi)),
            chebyshev=self.chebyshev if task.level else float(np.abs(worst).max()),
            task=task,
        )


def _candidates(task: FunctionTask, count: int) -> Iterator[_Design]:
    """Yield linkages through precision points, the best first, and the better of them levelled."""
    few = range(FEWEST_POINTS if task.fewer else task.points, task.points + 1)
    designs = [
        design for points in few for ranges in _ranges(task) for design in _through(task, ranges, points)
    ]
    best = sorted(((design.merit(), n) for n, design in enumerate(designs)))[: count + _MORE]
    chosen = [designs[n] for merit, n in best if math.isfinite(merit)]
    x = np.linspace(task.function.first, task.function.last, _PLACES)
    chosen = [one._replace(chebyshev=float(np.abs(one.errors(x)).max())) for one in chosen]
    if task.level:
        chosen = _different(task, [design.levelled() for design in chosen])
        chosen = _different(task, [*(one.again() for one in chosen[:count]), *chosen[count:]])
    yield from _different(task, chosen)


def _different(task: FunctionTask, designs: list[_Design]) -> list[_Design]:
    """Return linkages, the best first, each different from all earlier ones."""
    different: list[tuple[_Design, Real]] = []
    for one in sorted(designs, key=_Design.merit):
        lengths = _lengths(task.kind, one.row[None])[0]
        if not any(
            np.abs(lengths - others).max() <= _ALIKE * max(lengths.max(), others.max())
            and abs(one.input_range - other.input_range) < _SAME
            for other, others in different
        ):
            different.append((one, lengths))
    return [one for one, _ in different]


def _ranges(task: FunctionTask) -> Iterator[tuple[float, float]]:
    """Yield the ranges of both scales that are to be tried."""
    sliding = not task.kind.turning
    for wide in [task.input_range] if task.input_range else _FREE:
        if task.output_range is not None:
            yield wide, math.copysign(1.0, task.output_range) if sliding else task.output_range
            continue
        highs = (1.0,) if sliding else _FREE
        # turned half round, a slider that runs backwards runs forwards, unless the crank's start is given
        both = not sliding or task.input_start is not None
        yield from ((wide, high) for high in (*highs, *(-high for high in highs if both)))


def _through(task: FunctionTask, ranges: tuple[float, float], points: int) -> list[_Design]:
    """Return the best linkages that are exact at Chebyshev's points, for given ranges of both scales."""
    x = task.function.precision(points)
    inputs, outputs = task.function.x_share(x) * ranges[0], task.function.y_share(x) * ranges[1]
    try:
        rows = _rows_of_three(task, inputs, outputs) if points == 3 else _rows_of_more(task, inputs, outputs)
    except BadInput:  # for equal poses: the function returns to an earlier value
        return []
    rows = rows[np.isfinite(rows).all(axis=1) & (rows[:, :2] > 0).all(axis=1)]
    closures = task.kind.closures(rows, inputs, outputs)
    rows, closures = (part[(closures == closures[:, :1]).all(axis=1)] for part in (rows, closures))
    designs = [
        _Design(task, row, float(closure), *ranges, points)
        for row, (closure, *_) in zip(rows, closures, strict=True)
    ]
    merits = _merits(task, rows, closures[:, 0], ranges)
    order = np.argsort(merits, kind="stable")[:_KEPT]
    return [designs[n] for n in order if np.isfinite(merits[n])]


def _rows_of_three(task: FunctionTask, inputs: Real, outputs: Real) -> Real:
    """Return the rows through three points, for the starts that are given or all round."""
    sliding = not task.kind.turning
    given = task.input_start, task.output_start
    around = np.linspace(0.0, math.pi, _TRIED, endpoint=False)
    free = around, np.linspace(-_FARTHEST, _FARTHEST, 2 * _TRIED) if sliding else around
    starts = [
        choice if start is None else np.array([start / scale])
        for choice, start, scale in zip(free, given, task.scales, strict=True)
    ]
    first, last = (part.ravel() for part in np.meshgrid(*starts, indexing="ij"))
    rows = np.column_stack([task.kind.through(first[:, None] + inputs, last[:, None] + outputs), first, last])
    # a negative link points the other way, which one whose start is given cannot
    for length, start, wanted in ((0, 3, task.input_start), (2, 4, task.output_start))[: 2 - sliding]:
        negative = rows[:, length] < 0
        rows[negative, start] = np.nan if wanted is not None else rows[negative, start] + math.pi
        rows[negative, length] *= -1
    return rows


def _rows_of_more(task: FunctionTask, inputs: Real, outputs: Real) -> Real:
    """Return the rows through four points or five, which are couplers between poses of the input link."""
    poses, first = _poses(task.kind, inputs, outputs), (float(inputs[0]), float(outputs[0]))
    if poses.count == MOST_POINTS:
        return _rows(task.kind, poses, burmester_points(poses), first)
    curve = CentreCurve(poses)
    if task.input_start is None and task.output_start is None:
        return _rows(task.kind, poses, curve.bars(_CURVE), first)
    return np.concatenate(
        [_at_start(task, poses, curve, circuit, first) for circuit in range(len(curve.circuits))]
    )


def _at_start(
    task: FunctionTask, poses: Poses, curve: CentreCurve, circuit: int, first: tuple[float, float]
) -> Real:
    """Return the rows of a circuit at which a scale with a given start begins there."""
    column, start = (3, task.input_start) if task.output_start is None else (4, task.output_start)
    assert start is not None
    start = start / task.scales[column - 3]

    def rows(phases: Real) -> Real:
        centre = curve.at(circuit, phases)
        solved = np.full((len(phases), 5), np.nan)
        bars = Bars(circle_points(poses, centre), centre)
        sound = np.isfinite(bars.circle)
        with np.errstate(all="ignore"):
            made = [
                _rows(task.kind, poses, polished(poses, bars.take(np.array([n]))), first)
                for n in np.flatnonzero(sound)
            ]
        for n, row in zip(np.flatnonzero(sound), made, strict=True):
            solved[n] = row[0] if len(row) else np.nan
        return solved

    sliding = column == 4 and not task.kind.turning

    def off(solved: Real) -> Real:
        return solved[:, column] - start if sliding else np.sin(solved[:, column] - start)

    phases = np.linspace(0.0, math.tau, 4 * _CURVE + 1)
    starts = rows(sign_changes(lambda at: off(rows(at)), phases, _CLOSELY))
    # the sine is 0 half a turn off, too, where the link points the other way
    return starts if sliding else starts[np.cos(starts[:, column] - start) > 0]


def _generated(
    task: FunctionTask, rows: Real, closure: Real, ranges: tuple[float, float], x: Real
) -> tuple[Real, Real]:
    """Return the structural errors (k, n) at x in y's unit, and cos μ."""
    function = task.function
    wanted = function.y_share(x) * ranges[1]
    outputs, cosine = task.kind.outputs(rows, closure, function.x_share(x) * ranges[0], wanted)
    return (outputs - wanted) * (function.span / ranges[1]), cosine


def _merits(task: FunctionTask, rows: Real, closure: Real, ranges: tuple[float, float]) -> Real:
    """Return the costs: the largest error's logarithm, more for poor transmission, inf for slim links."""
    x = np.linspace(task.function.first, task.function.last, _SEEN)
    error, cosine = _generated(task, rows, closure, ranges, x)
    with np.errstate(all="ignore"):
        worst = np.abs(error).max(axis=1) / abs(task.function.span)
        sine = np.sqrt(1 - np.abs(cosine).max(axis=1) ** 2)
        # between pairs nothing is wanted
        off = (
            np.log(worst + _FINEST)
            if task.function.pairs is None
            else np.where(np.isfinite(worst), 0.0, np.inf)
        )
        merits = off + _POOR * np.maximum(np.log(math.sin(_LEAST) / sine), 0.0)
        # a slider's stroke, of length 1, counts as a link; of a four-bar that is the ground
        lengths = np.column_stack([np.ones(len(rows)), _lengths(task.kind, rows)])
        merits[lengths.max(axis=1) > _SLIMMEST * lengths.min(axis=1)] = np.inf
    return np.where(np.isfinite(merits), merits, np.inf)


def _extremes(errors: Callable[[Real], Real], x: Real) -> Real:
    """Return the ends and the extremes of the errors, refined between samples by parabolas, twice."""
    values = errors(x)
    steps = np.diff(values)
    inner = np.flatnonzero(steps[:-1] * steps[1:] <= 0) + 1
    places, wide = x[inner], float(x[1] - x[0])
    for _ in range(2):
        low, middle, high = (errors(places + share * wide) for share in (-1.0, 0.0, 1.0))
        bend = low - 2 * middle + high
        with np.errstate(all="ignore"):
            shift = np.nan_to_num((low - high) / (2 * bend))
        places = np.clip(places + wide * np.clip(shift, -1, 1), x[0] + wide / 100, x[-1] - wide / 100)
        wide /= 30
    return np.concatenate([x[:1], places, x[-1:]])


def _in_turn(angle: float, other: float | None) -> float:
    """Return an angle in the turn in which it is nearest to another one, if there is one."""
    return angle if other is None else angle + math.tau * round((other - angle) / math.tau)


def _stated(task: FunctionTask, points: Real, scales: tuple[float, float, float, float]) -> dict[str, object]:
    """Return the function and its precision points as the scene's file keeps them."""
    start, wide, first, high = scales
    inputs = np.degrees(start + wide * task.function.x_share(points)).tolist()
    outputs = first + high * task.function.y_share(points)
    turning = task.kind.turning
    places = (np.degrees(outputs) if turning else outputs).tolist()
    return {
        "words": task.function.words,
        "x": points.tolist(),
        "y": task.function(points).tolist(),
        "input": [f"{angle!r} deg" for angle in inputs],
        "output": [f"{place!r} {'deg' if turning else task.unit}" for place in places],
    }


def _solved_errors(
    scene: Scene, task: FunctionTask, scales: tuple[float, float, float, float], x: Real
) -> Real:
    """Return the structural errors at x as the solver has them, by start and range of input and output."""
    function, kind, (start, wide, first, high) = task.function, task.kind, scales
    motion = scene.solve(angle=start + wide * function.x_share(x), derivatives=0)
    off = np.asarray(getattr(motion, kind.reading)[kind.output]) - first - high * function.y_share(x)
    if kind.turning:
        off = np.remainder(off + math.pi, math.tau) - math.pi
    return np.asarray(off * (function.span / high))
