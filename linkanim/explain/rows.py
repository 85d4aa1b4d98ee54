"""The rows of one item of a worked solution in a notation: sides of equations, one below the other."""

from __future__ import annotations

from collections.abc import Iterator
from functools import reduce
from itertools import pairwise
from typing import NamedTuple

from linkanim.explain.lines import Equation, Item, System, ValueLine
from linkanim.explain.notation import Notation, typeset

_SHORT, _MIDDLING = 2, 6
"""So many symbols a formula has that stands in one row with its numbers and value, or with its value."""


class EquationRow(NamedTuple):
    """One row of an aligned equation: what stands left of the sign of equality, and right of it."""

    left: str
    right: str


def rows(item: Item, how: Notation, *, blank: bool = False) -> Iterator[EquationRow]:
    """Yield the rows of an item that has any; where `blank` the numbers that are asked for are left open."""
    match item:
        case ValueLine():
            yield from _line(item, how, blank)
        case Equation():
            yield EquationRow(typeset(item.left, how), typeset(item.right, how))
        case System():
            yield from _system(item, how, blank)


def _line(line: ValueLine, how: Notation, blank: bool) -> Iterator[EquationRow]:
    """Yield a line's sides, as many of them in a row as a reader takes in."""
    sides = [typeset(line.formula, how)] if line.formula.symbolic else []
    if not blank and line.formula.operation != "leaf":
        sides.append(typeset(line.formula, how, numbers=True))
    sides.append((how.blank if blank else how.number(line.value.shown, False)) + how.unit(line.unit))
    leaves = len(list(line.formula.leaves))
    together = 3 if leaves <= _SHORT else 2 if leaves <= _MIDDLING else 1
    left = typeset(line.value, how)
    # the last row is the fullest one: it is the numbers and what they come to that belong together
    for begin, end in pairwise(
        [0, *range(len(sides) % together or together, len(sides), together), len(sides)]
    ):
        yield EquationRow(left, reduce(lambda a, b: how.infix("=", a, b), sides[begin:end]))
        left = ""


def _system(system: System, how: Notation, blank: bool) -> Iterator[EquationRow]:
    unknowns = how.matrix([[how.symbol(unknown)] for unknown in system.unknowns])
    ways = [(system.formulas, False), (system.formulas, True), (system.values, True)]
    if not system.worked_out:
        del ways[1]
    for entries, numbers in ways[:1] if blank else ways:
        set_ = [[typeset(entry, how, numbers=numbers) for entry in row] for row in entries]
        yield EquationRow(
            how.matrix([row[:2] for row in set_]) + unknowns, how.matrix([row[2:] for row in set_])
        )
