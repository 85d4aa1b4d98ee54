"""Write arithmetic once and run it on floats, on arrays and in blocks.

Its parts, in reading order:

- Constants of the formulas: floats that know which number they stand for.
- Arithmetic that is written once and run on floats, on arrays and in blocks.
- Plane vectors and moving quantities made of `Value`s: floats, or symbolic expressions.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Mapping
from decimal import Context, Decimal
from fractions import Fraction
from typing import Any, NamedTuple

# Constants of the formulas: floats that know which number they stand for.
#
# In floats a constant is right to its last digit, and so is what is computed from it. That is not enough next
# to a limit that is found in many digits: the distance left to it may be as small as that last digit. So a
# result of + - × ÷ and square roots of constants keeps its exact number as well, for formulas that are run in
# many digits.

DIGITS = 50


Number = Fraction | Decimal | float
_REAL = (int, float)
"""The types of real numbers, written once: a union would be made anew at every test."""


def _arithmetic(
    operate: Callable[[Any, Any], Any],
) -> tuple[Callable[[Any, Any], Any], Callable[[Any, Any], Any]]:
    """Return an operation on floats and the numbers they stand for, and the same with operands swapped."""

    def apply(a: Any, b: Any) -> Any:
        if not (isinstance(a, _REAL) and isinstance(b, _REAL)):
            return NotImplemented
        return Constant(operate(float(a), float(b)), lambda: operate(Fraction(a), Fraction(b)))

    return apply, lambda b, a: apply(a, b)


class Constant(float):
    """A float, and the `number` that it stands for: itself, where none is given.

    Equal to a constant of the same float and number; `Fraction` takes the number. The number is worked out
    when it is first asked for, which is seldom.
    """

    __slots__ = ("_known",)
    _known: Callable[[], Number] | Number

    def __new__(cls, nearest: float, number: Callable[[], Number] | Number | None = None) -> Constant:
        """Return the constant of a float and its number, or of a function that works the number out."""
        constant = super().__new__(cls, nearest)
        constant._known = nearest if number is None else number
        return constant

    @property
    def number(self) -> Fraction:
        """The number."""
        known = self._known
        if not isinstance(known, Fraction):
            known = self._known = Fraction(known() if callable(known) else known)
        return known

    def __reduce__(self) -> tuple[type[Constant], tuple[float, Fraction]]:
        return Constant, (float(self), self.number)

    def as_integer_ratio(self) -> tuple[int, int]:
        """Return the number as a quotient."""
        return self.number.as_integer_ratio()

    def __eq__(self, other: object) -> bool:
        equal = float.__eq__(self, other)
        if equal is not True or not isinstance(other, _REAL):
            return equal
        known, others = self._known, other._known if isinstance(other, Constant) else other
        if known is others or (type(known) is float and type(others) is float):
            return True  # as equal floats that stand for themselves are
        return self.number == Fraction(other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(float(self))

    def __neg__(self) -> Constant:
        return Constant(-float(self), lambda: -self.number)

    def __abs__(self) -> Constant:
        return Constant(abs(float(self)), lambda: abs(self.number))

    __add__, __radd__ = _arithmetic(operator.add)
    __sub__, __rsub__ = _arithmetic(operator.sub)
    __mul__, __rmul__ = _arithmetic(operator.mul)
    __truediv__, __rtruediv__ = _arithmetic(operator.truediv)


def nearest(number: Fraction) -> Constant:
    """Return the constant that stands for a number."""
    return Constant(float(number), number)


def root(square: Value) -> Any:
    """Return the square root of a float; of a constant, that of its number to fifty digits."""
    if isinstance(square, Expr):
        return square.graph.node("sqrt", square)
    if not isinstance(square, Constant):
        return math.sqrt(square)
    return Constant(math.sqrt(square), lambda: digits_of(square).sqrt(Context(prec=DIGITS)))


def digits_of(number: float) -> Decimal:
    """Return a float with all its digits; of a constant, fifty digits of its number."""
    if not isinstance(number, Constant):
        return Decimal(number)
    numerator, denominator = number.as_integer_ratio()
    return Context(prec=DIGITS, traps=[]).divide(Decimal(numerator), Decimal(denominator))


# Arithmetic that is written once and run on floats, on arrays and in blocks.
#
# The formulas of a linkage are ordinary Python on `Value`s. Fed with floats they compute; fed with
# `Expr`s they record what they would compute, each distinct operation once and constants folded, for
# `program` to compile. So a single pose and a million of them come from the same formula.

WHOLE = 1.5 * 2.0**52
"""Added to a number below 2⁵¹ in size, it leaves no room for a fraction."""
COMMUTES = frozenset({"add", "mul", "minimum", "maximum"})


class Graph:
    """The operations recorded so far; equal ones are one node."""

    def __init__(self, *, exact: bool = False) -> None:
        self.exact = exact
        """Whether it will be run in many digits, with functions that are right to all of them."""
        self._nodes: dict[tuple[object, ...], Expr] = {}
        self._count = 0

    def input(self, name: str, *, uniform: bool = False) -> Expr:
        """Return the named input of the program; `uniform` where it is one number for a whole array."""
        node = self.node("input", name)
        node.uniform = uniform
        return node

    def constant(self, number: float) -> float:
        """Return a number as it is recorded: a `Constant` where the graph is `exact`, else a plain float."""
        return Constant(number) if self.exact else float(number)

    def node(self, op: str, *args: Expr | float | str | LookUp) -> Expr:
        """Return the node for this operation, the one recorded before where there is one."""
        if op in COMMUTES:
            one, other = args
            # constants go first, and nodes as they were recorded
            if isinstance(one, Expr) and not (isinstance(other, Expr) and other.index >= one.index):
                args = other, one
        key = (op, *args)
        node = self._nodes.get(key)
        if node is None:
            node = Expr(self, op, args, self._count)
            self._nodes[key] = node
            self._count += 1
        return node

    def forget(self) -> None:
        """Forget the nodes, which do not need the graph, so that each is freed with its last user.

        An operation that is recorded again later is a new node.
        """
        self._nodes.clear()


class FormGraph(Graph):
    """A graph some of whose inputs stand for many numbers, of which one, a sample, is known.

    Where formulas branch on such values, the sample decides, and what has to hold for the others to go the
    same way is kept in `conditions`: values that are not negative then. Where each way is right, the `usual`
    numbers decide, so that it is the same way for every sample.
    """

    def __init__(self) -> None:
        super().__init__()
        self._known: dict[int, tuple[float, ...]] = {}
        self.conditions: list[Value] = []

    def sampled(self, name: str, sample: float, usual: float) -> Expr:
        """Return the named input, of which one value is known, and the usual one."""
        node = self.input(name)
        self._known[node.index] = sample, usual
        return node

    def known(self, value: Value) -> tuple[float, ...]:
        """Return what a value is for the sample, and for usual numbers; TypeError where that is not known."""
        if not isinstance(value, Expr):
            return float(value), float(value)
        if value.index not in self._known:
            if value.op == "input":
                raise TypeError(f"{value.args[0]} has no sample")
            pairs = zip(
                *[self.known(arg) for arg in value.args if isinstance(arg, Expr | float)], strict=True
            )
            self._known[value.index] = tuple(SAMPLED[value.op](*pair) for pair in pairs)
        return self._known[value.index]

    def less(self, one: Value, other: Value) -> bool:
        """Tell whether one value is less than another, for the sample and all that are solved as it is."""
        is_less = self.known(one)[0] < self.known(other)[0]
        self.conditions.append(other - one if is_less else one - other)
        return is_less


class Expr:
    """One recorded operation; its arguments are nodes of the same graph or constants.

    A `uniform` one has the same value along an array, so it is worked out once; in products, uniform
    factors are collected into one.
    """

    __slots__ = ("args", "graph", "index", "op", "positive", "uniform")

    def __init__(
        self, graph: Graph, op: str, args: tuple[Expr | float | str | LookUp, ...], index: int
    ) -> None:
        self.graph = graph
        self.op = op
        self.args = args
        self.index = index
        self.uniform = True
        for arg in args:
            if isinstance(arg, Expr) and not arg.uniform:
                self.uniform = False
        negated = args[0] if op == "neg" else None
        self.positive = negated if isinstance(negated, Expr) else None
        """x, where this operation is -x."""

    def __add__(self, other: Value) -> Value:
        if not isinstance(other, Expr):
            other = self.graph.constant(other)
            if other == 0:
                return self
        elif other.positive is not None:
            return _subtract(self, other.positive)
        if self.positive is not None:
            return _subtract(other, self.positive)
        return self.graph.node("add", self, other)

    __radd__ = __add__

    def __sub__(self, other: Value) -> Value:
        return _subtract(self, other)

    def __rsub__(self, other: Value) -> Value:
        return _subtract(other, self)

    def __mul__(self, other: Value) -> Value:
        if not isinstance(other, Expr):
            return _scale(self, self.graph.constant(other))
        if self.uniform != other.uniform:
            x, y = (self, other) if self.uniform else (other, self)
            factor, rest = _factored(y)
            return self.graph.node("mul", x, y) if factor is None else (x * factor) * rest
        if self.positive is not None:
            return -(self.positive * other)
        if other.positive is not None:
            return -(other.positive * self)
        return self.graph.node("mul", self, other)

    __rmul__ = __mul__

    def __truediv__(self, other: Value) -> Value:
        return _divide(self, other)

    def __rtruediv__(self, other: Value) -> Value:
        return _divide(other, self)

    def __lt__(self, other: Value) -> bool:
        return _less(self.graph, self, other)

    def __gt__(self, other: Value) -> bool:
        return _less(self.graph, other, self)

    def __le__(self, other: Value) -> bool:
        return not _less(self.graph, other, self)

    def __ge__(self, other: Value) -> bool:
        return not _less(self.graph, self, other)

    def __abs__(self) -> Value:
        return self.graph.node("maximum", self, -self)

    def __neg__(self) -> Value:
        if self.positive is not None:
            return self.positive
        factor, rest = _factored(self)
        # A sum absorbs a sign at no cost; so a sign goes into a factor only where that varies along the
        # array.
        late = isinstance(factor, Expr) and not self.uniform
        return -factor * rest if late and factor is not None else self.graph.node("neg", self)


Value = Expr | float


def _less(graph: Graph, one: Value, other: Value) -> bool:
    if not isinstance(graph, FormGraph):
        raise TypeError("formulas do not compare values; use select, minimum or maximum")
    return graph.less(one, other)


def are_inputs(*lengths: Value) -> bool:
    """Tell whether one of these lengths is an input of the program, or made of such."""
    return any(isinstance(length, Expr) for length in lengths)


def over(value: Any, unit: Any) -> Any:
    """Return a quotient; by a value, which others are divided by, too, as a product with its inverse."""
    return value * (1.0 / unit) if isinstance(unit, Expr) else value / unit


def known(value: Value) -> float:
    """Return a number; of a value with a sample that of the sample, where no other need go the same way."""
    if not isinstance(value, Expr):
        return float(value)
    assert isinstance(value.graph, FormGraph)
    return value.graph.known(value)[0]


def usual(value: Value) -> float:
    """Return a number; of a value with a sample its usual number."""
    if not isinstance(value, Expr):
        return float(value)
    assert isinstance(value.graph, FormGraph)
    return value.graph.known(value)[1]


def _factored(value: Expr) -> tuple[Value | None, Expr]:
    """Return the constant or uniform factor of a product and the rest; None where there is no such factor."""
    if value.op == "mul":
        for factor, rest in (value.args, value.args[::-1]):
            if isinstance(rest, Expr) and not rest.uniform and _is_uniform(factor):
                assert isinstance(factor, Expr | int | float)
                return factor, rest
    return None, value


def _is_uniform(value: Expr | float | str | LookUp) -> bool:
    return value.uniform if isinstance(value, Expr) else True


def _subtract(a: Value, b: Value) -> Value:
    graph = _graph_of(a, b)
    a, b = _recorded(graph, a), _recorded(graph, b)
    if a is b:
        return 0.0
    if not isinstance(b, Expr) and b == 0:
        return a
    if not isinstance(a, Expr) and a == 0:
        return -b
    if isinstance(b, Expr) and b.positive is not None:
        return a + b.positive
    if isinstance(a, Expr) and a.positive is not None:
        return -(a.positive + b)
    return graph.node("sub", a, b)


def _graph_of(a: Value, b: Value) -> Graph:
    return b.graph if isinstance(b, Expr) else a.graph if isinstance(a, Expr) else Graph()


def _recorded(graph: Graph, value: Value) -> Value:
    return value if isinstance(value, Expr) else graph.constant(value)


def _scale(a: Expr, factor: float) -> Value:
    """Return a × factor, merged with a constant factor that `a` has already."""
    if factor == 0:
        return 0.0
    if factor == 1:
        return a
    if factor == -1:
        return -a
    if a.positive is not None:
        return _scale(a.positive, -factor)
    inner, rest = _factored(a)
    if inner is not None and not a.uniform:
        return (inner * factor) * rest
    if a.op == "mul" and isinstance(a.args[0], float) and isinstance(a.args[1], Expr):
        return _scale(a.args[1], factor * a.args[0])
    return a.graph.node("mul", factor, a)


def _divide(a: Value, b: Value) -> Value:
    graph = _graph_of(a, b)
    a, b = _recorded(graph, a), _recorded(graph, b)
    if not isinstance(b, Expr):
        return a * (1.0 / b) if math.frexp(b)[0] in (0.5, -0.5) else graph.node("div", a, b)
    if not isinstance(a, Expr) and a == 0:
        return 0.0
    return 1.0 if a is b else graph.node("div", a, b)


def recorded_with(number: Value, value: Value) -> Value:
    """Return a number as the value's graph records it; unchanged where the value is a float."""
    if isinstance(number, Expr):
        return number
    return value.graph.constant(number) if isinstance(value, Expr) else float(number)


def _function(op: str, plain: Callable[..., float]) -> Callable[..., Value]:
    def apply(*values: Value) -> Value:
        for value in values:
            if isinstance(value, Expr):
                return value.graph.node(op, *values)
        return plain(*values)

    return apply


def nearest_whole(x: float) -> float:
    """Return the whole number nearest a float below 2⁵¹ in size, of two the even one, as numpy's rint."""
    return (x + WHOLE) - WHOLE or x * 0.0


sqrt = _function("sqrt", root)
rint = _function("rint", nearest_whole)
minimum = _function("minimum", min)
maximum = _function("maximum", max)
arctan2 = _function("arctan2", math.atan2)
"""The angle of (x, y), from y and x, by the C library: for angles that are shown, not computed with."""


class LookUp:
    """Numbers that a formula looks up by their place; a table is equal to itself alone."""

    __slots__ = ("values",)

    def __init__(self, values: Iterable[float]) -> None:
        self.values = tuple(values)

    def at(self, place: Value) -> Value:
        """Return the entry at a place, which is a whole number."""
        if isinstance(place, Expr):
            return place.graph.node("entry", self, place)
        return self.values[int(place)]


select = _function("select", lambda a, b, below, otherwise: below if a < b else otherwise)
"""Of a, b, c and d: c where a < b, else d."""
SAMPLED: Mapping[str, Callable[..., float]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "div": lambda a, b: a / b if b else math.nan,
    "neg": operator.neg,
    "sqrt": lambda a: math.sqrt(a) if a >= 0 else math.nan,
    "rint": nearest_whole,
    "arctan2": math.atan2,
    "minimum": min,
    "maximum": max,
    "select": lambda a, b, below, otherwise: below if a < b else otherwise,
}
"""What each operation does to a sample."""


# Plane vectors and moving quantities made of `Value`s: floats, or symbolic expressions.
#
# A moving quantity is its value with the first and second derivative in time.


class Vec(NamedTuple):
    """A plane vector, read as a complex number where one multiplies another."""

    x: Value
    y: Value

    def __add__(self, other: Vec) -> Vec:  # type: ignore[override]
        return Vec(self.x + other.x, self.y + other.y)

    def __sub__(self, other: Vec) -> Vec:
        return Vec(self.x - other.x, self.y - other.y)

    def __neg__(self) -> Vec:
        return Vec(-self.x, -self.y)

    def scaled(self, factor: Value) -> Vec:
        """Return the vector times a number."""
        return Vec(self.x * factor, self.y * factor)

    def times(self, other: Vec) -> Vec:
        """Return the complex product: a turn and a stretch."""
        return Vec(self.x * other.x - self.y * other.y, self.x * other.y + self.y * other.x)

    def left(self) -> Vec:
        """Return the vector turned a quarter turn to the left."""
        return Vec(-self.y, self.x)

    def dot(self, other: Vec) -> Value:
        """Return the scalar product."""
        return self.x * other.x + self.y * other.y

    def cross(self, other: Vec) -> Value:
        """Return the signed area spanned, positive where `other` lies to the left."""
        return self.x * other.y - self.y * other.x


ZERO = Vec(0.0, 0.0)


class Moving(NamedTuple):
    """A number and its first two derivatives in time."""

    value: Value
    rate: Value = 0.0
    second: Value = 0.0

    def __mul__(self, other: Moving) -> Moving:  # type: ignore[override]
        return Moving(
            self.value * other.value,
            self.rate * other.value + self.value * other.rate,
            self.second * other.value + self.rate * other.rate * 2.0 + self.value * other.second,
        )

    def __add__(self, other: Moving) -> Moving:  # type: ignore[override]
        return Moving(self.value + other.value, self.rate + other.rate, self.second + other.second)

    def scaled(self, factor: Value) -> Moving:
        """Return the quantity times a constant."""
        return Moving(self.value * factor, self.rate * factor, self.second * factor)

    @property
    def slope(self) -> Slope:
        """The number with its first derivative alone."""
        return Slope(self.value, self.rate)


class MovingPoint(NamedTuple):
    """A point with its velocity and acceleration."""

    position: Vec
    velocity: Vec = ZERO
    acceleration: Vec = ZERO

    def __add__(self, other: MovingPoint) -> MovingPoint:  # type: ignore[override]
        return MovingPoint(*[a + b for a, b in zip(self, other, strict=True)])

    def __sub__(self, other: MovingPoint) -> MovingPoint:
        return MovingPoint(*[a - b for a, b in zip(self, other, strict=True)])


class Slope(NamedTuple):
    """A number and its first derivative in time: a regular factor, or how fast a body turns."""

    value: Value
    rate: Value = 0.0

    def __mul__(self, other: Slope) -> Slope:  # type: ignore[override]
        return Slope(self.value * other.value, self.rate * other.value + self.value * other.rate)

    def __truediv__(self, other: Slope) -> Slope:
        quotient = self.value / other.value
        return Slope(quotient, (self.rate - quotient * other.rate) / other.value)

    def scaled(self, factor: float) -> Slope:
        """Return the quantity times a constant."""
        return Slope(self.value * factor, self.rate * factor)

    def plus(self, value: Value, rate: Value) -> Slope:
        """Return the sum with another number and its derivative."""
        return Slope(self.value + value, self.rate + rate)


def carried(arm: Vec, turning: Slope) -> MovingPoint:
    """Return the end of an arm that turns (ω, α) about its fixed root: r, iω r, (iα - ω²) r."""
    square = turning.value * turning.value
    return MovingPoint(
        arm,
        arm.left().scaled(turning.value),
        arm.left().scaled(turning.rate) - arm.scaled(square),
    )
