"""Arithmetic that is written once and run on floats, on arrays and in blocks.

The formulas of a linkage are ordinary Python on `Value`s. Fed with floats they compute; fed with
`Expr`s they record what they would compute, each distinct operation once and constants folded, for
`program` to compile. So a single pose and a million of them come from the same formula.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from linkanim.mechanics.formulas.constant import Constant, root

WHOLE = 1.5 * 2.0**52
"""Added to a number below 2⁵¹ in size, it leaves no room for a fraction."""
COMMUTES = frozenset({"add", "mul", "minimum", "maximum"})


class Graph:
    """The operations recorded so far; equal ones are one node."""

    def __init__(self, *, exact: bool = False) -> None:
        self.exact = exact
        """Whether it will be run in many digits, on functions that are right in all of them."""
        self._nodes: dict[tuple[object, ...], Expr] = {}
        self._count = 0

    def input(self, name: str, *, uniform: bool = False) -> Expr:
        """Return the named input of the program; `uniform` where it is one number for a whole array."""
        found = self.node("input", name)
        found.uniform = uniform
        return found

    def constant(self, number: float) -> float:
        """Return a number as it is recorded: with the one that it stands for where digits are to be many."""
        return Constant(number) if self.exact else float(number)

    def node(self, op: str, *args: Expr | float | str) -> Expr:
        """Return the node for this operation, the one recorded before where there is one."""
        if op in COMMUTES:
            one, other = args
            # constants go first, and nodes as they were recorded
            if isinstance(one, Expr) and not (isinstance(other, Expr) and other.index >= one.index):
                args = other, one
        key = (op, *args)
        found = self._nodes.get(key)
        if found is None:
            found = Expr(self, op, args, self._count)
            self._nodes[key] = found
            self._count += 1
        return found

    def forget(self) -> None:
        """Let go of the nodes, which are whole without it, so that they are freed as their last user is.

        An operation that is recorded again later is a new node.
        """
        self._nodes.clear()


class Expr:
    """One recorded operation; its arguments are nodes of the same graph or constants.

    A `uniform` one has the same value along an array, so it is worked out once; products draw
    uniform factors together.
    """

    __slots__ = ("args", "graph", "index", "op", "positive", "uniform")

    def __init__(self, graph: Graph, op: str, args: tuple[Expr | float | str, ...], index: int) -> None:
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
        """What is recorded as -x knows x."""

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

    def __neg__(self) -> Value:
        if self.positive is not None:
            return self.positive
        factor, rest = _factored(self)
        # A sign is free where it meets a sum; only into a number known late is it drawn.
        late = isinstance(factor, Expr) and not self.uniform
        return -factor * rest if late and factor is not None else self.graph.node("neg", self)


Value = Expr | float


def _factored(value: Expr) -> tuple[Value | None, Expr]:
    """Return the constant or uniform factor of a product and the rest; None where there is no such factor."""
    if value.op == "mul":
        for factor, rest in (value.args, value.args[::-1]):
            if isinstance(rest, Expr) and not rest.uniform and _is_uniform(factor):
                assert not isinstance(factor, str)
                return factor, rest
    return None, value


def _is_uniform(value: Expr | float | str) -> bool:
    return value.uniform if isinstance(value, Expr) else True


def _subtract(a: Value, b: Value) -> Value:
    graph = _graph_of(a, b)
    a, b = _recorded(graph, a), _recorded(graph, b)
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
    """Return a × constant, drawing a constant already inside into one."""
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
    return graph.node("div", a, b)


def beside(number: float, value: Value) -> float:
    """Return a number as it is recorded with a value; with a float that computes, as a float."""
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
"""The angle of (x, y), from y and x, by the C library: for one that is shown, not used."""
select = _function("select", lambda a, b, below, otherwise: below if a < b else otherwise)
"""Of a, b, c and d: c where a < b, else d."""
