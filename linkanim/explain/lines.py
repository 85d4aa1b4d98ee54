"""What a worked solution consists of, whatever it is printed as: chapters, steps, lines."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from linkanim.explain.expression import Formula, Symbol


@dataclass(frozen=True, slots=True)
class Words:
    """A sentence; names of joints in it are `marked`."""

    text: str


def marked(joint: str) -> str:
    """Return a joint's name marked as one in a text, by characters that no text of a scene has in it."""
    return f"\x02{joint}\x03"


MARKED = re.compile("\x02([^\x02\x03]*)\x03")
"""A name that is marked."""


@dataclass(frozen=True, slots=True)
class ValueLine:
    """A symbol = a formula = the formula with its numbers = a value, in shown digits, with its unit."""

    formula: Formula
    value: Formula
    unit: str


@dataclass(frozen=True, slots=True)
class Given:
    """A number that the scene states: a symbol = a value with its unit."""

    value: Formula
    unit: str
    words: str


@dataclass(frozen=True, slots=True)
class Equation:
    """Two sides in symbols alone."""

    left: Formula
    right: Formula


@dataclass(frozen=True, slots=True)
class System:
    """Two linear equations for two unknowns: formulas, the same with numbers, then the values.

    `formulas` are the rows of the matrix, each with its right side behind it; `values` are leaves.
    """

    unknowns: tuple[Symbol, Symbol]
    formulas: tuple[tuple[Formula, Formula, Formula], tuple[Formula, Formula, Formula]]
    values: tuple[tuple[Formula, Formula, Formula], tuple[Formula, Formula, Formula]]

    @property
    def worked_out(self) -> bool:
        """Whether any entry is more than a number that is known already."""
        return any(entry.operation != "leaf" for row in self.formulas for entry in row)


@dataclass(frozen=True, slots=True)
class Unknown:
    """The symbols that two equations are solved for."""

    symbols: tuple[Formula, ...]


Item = Words | ValueLine | Given | Equation | System | Unknown


@dataclass(frozen=True)
class Step:
    """One stage of a chapter under a heading, such as a joint; names of joints are marked."""

    title: str
    items: tuple[Item, ...]


@dataclass(frozen=True)
class Chapter:
    """A part of the solution."""

    title: str
    steps: tuple[Step, ...]

    @property
    def items(self) -> Iterator[Item]:
        """All that stands in it."""
        return (item for step in self.steps for item in step.items)


NOTHING = 5e-7
"""Of what a number is at a typical length and rate: less is nothing but rounding."""


@dataclass(frozen=True)
class Outcome:
    """A number that the solution leads to: of which quantity, and below what it is nothing but rounding.

    It is `last` where no place and no rate follows from it.
    """

    token: str
    value: Formula
    unit: str = ""
    least: float = NOTHING
    last: bool = False
