"""The rows of one item of a worked solution in a notation: sides of equations, one below the other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from linkanim.explain.expression import Formula
from linkanim.explain.lines import Equation, Given, System, ValueLine
from linkanim.explain.notation import Notation, typeset


class EquationRow(NamedTuple):
    """One row of an aligned equation: what stands left of the sign of equality, and right of it."""

    left: str
    right: str


def rows(
    item: ValueLine | Given | Equation | System, how: Notation, *, blank: bool = False
) -> Iterator[EquationRow]:
    """Yield the rows of an item; where `blank` the numbers that are asked for are left open."""
    match item:
        case ValueLine():
            yield from _line(item, how, blank)
        case Given():
            yield EquationRow(typeset(item.value, how), _value(item.value, item.unit, how))
        case Equation():
            yield EquationRow(typeset(item.left, how), typeset(item.right, how))
        case System():
            yield from _system(item, how, blank)


def _line(line: ValueLine, how: Notation, blank: bool) -> Iterator[EquationRow]:
    left, value = typeset(line.value, how), _value(line.value, line.unit, how)
    if line.formula.symbolic:
        yield EquationRow(left, typeset(line.formula, how))
        left = ""
    if blank:
        yield EquationRow(left, how.blank + how.unit(line.unit))
        return
    if line.formula.operation != "leaf":
        yield EquationRow(left, typeset(line.formula, how, numbers=True))
        left = ""
    yield EquationRow(left, value)


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


def _value(e: Formula, unit: str, how: Notation) -> str:
    return how.number(e.shown, False) + how.unit(unit)
