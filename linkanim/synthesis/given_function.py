"""The function that a linkage is to generate: an expression in x as one types it, or a table.

An expression is read by a small grammar of its own over Python's syntax: numbers, x, pi and e, the four
operations, powers as ^ or **, and the functions in `FUNCTIONS`. Nothing else is looked up, and nothing run.
"""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from linkanim.document import meant
from linkanim.errors import BadInput
from linkanim.synthesis.kinds import Real
from linkanim.units import shown

LONGEST = 200
"""Characters of an expression."""
FEWEST_ROWS, MOST_ROWS = 4, 2000
_LOOKED_AT = 721
"""Places at which a function is looked at."""
_FLAT = 1e-12
"""Of its values' size: a function that changes by no more is constant."""

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


@dataclass(frozen=True, eq=False)
class GivenFunction:
    """A function in words, over x from `first` to `last`, and what gives its values (k,) at x (k,).

    BadInput for a range that is none, for values that are no numbers, and for a constant.
    """

    words: str
    first: float
    last: float
    values: Callable[[Real], Real]

    def __post_init__(self) -> None:
        """Refuse what no linkage can follow."""
        if not (math.isfinite(self.first) and math.isfinite(self.last) and self.first < self.last):
            raise BadInput(
                f"x from {self.first:g} to {self.last:g}: give two numbers, the first below the second"
            )
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
        """By how much y grows from the first x to the last; of one that turns back, from least to most."""
        y = self(np.linspace(self.first, self.last, _LOOKED_AT))
        steps = np.diff(y)
        if (steps >= 0).all() or (steps <= 0).all():
            return float(y[-1] - y[0])
        return float(np.ptp(y))

    def share(self, x: Real) -> Real:
        """Return which share of its range x is."""
        return np.asarray((x - self.first) / (self.last - self.first))

    def way(self, x: Real) -> Real:
        """Return how far y has gone at x since the start, in spans."""
        return np.asarray((self(x) - self.start) / self.span)

    def chebyshev(self, count: int) -> Real:
        """Return so many x as Chebyshev spaces them: where a polynomial of that degree swings least."""
        middle, half = (self.first + self.last) / 2, (self.last - self.first) / 2
        return np.asarray(middle - half * np.cos((2 * np.arange(count) + 1) * math.pi / (2 * count)))


def expression(text: str, first: float, last: float) -> GivenFunction:
    """Return the function that a text such as "y = log10(x)" says; BadInput with the way out for others."""
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
    """Return what gives the values of a part of an expression."""
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
    bends = _bends(x, y)
    return GivenFunction(words, float(x[0]), float(x[-1]), lambda at: _spline(x, y, bends, at))


def _bends(x: Real, y: Real) -> Real:
    """Return the second derivatives of the natural cubic spline, by elimination in three diagonals."""
    step, slope = np.diff(x), np.diff(y) / np.diff(x)
    diagonal, right = 2 * (step[1:] + step[:-1]), 6 * np.diff(slope)
    for n in range(1, len(diagonal)):
        factor = step[n] / diagonal[n - 1]
        diagonal[n] -= factor * step[n]
        right[n] -= factor * right[n - 1]
    found = np.zeros(len(x))
    for n in range(len(diagonal) - 1, -1, -1):
        found[n + 1] = (right[n] - step[n + 1] * found[n + 2]) / diagonal[n]
    return found


def _spline(x: Real, y: Real, bends: Real, at: Real) -> Real:
    n = np.clip(np.searchsorted(x, at) - 1, 0, len(x) - 2)
    step = x[n + 1] - x[n]
    low, high = (x[n + 1] - at) / step, (at - x[n]) / step
    bent = (low**3 - low) * bends[n] + (high**3 - high) * bends[n + 1]
    return np.asarray(low * y[n] + high * y[n + 1] + bent * step**2 / 6)
