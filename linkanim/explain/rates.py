"""Velocities and accelerations, or kinematic coefficients: what is known of them so far, and the lines.

Both are one course of work: in time with rates ω, α, or by the input with h, h′, which are the same rates for
an input that runs at 1. Each dyad's two unknowns follow from its loop, differentiated: two linear equations.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, NamedTuple

from linkanim.explain.expression import TWO, ZERO, Components, Formula, Symbol, square
from linkanim.explain.lines import System
from linkanim.explain.work import LENGTH, RATIO, GuideLine, Powers, Scale, Work, rounded
from linkanim.mechanics.linkage.linkage import Damper, Spring

Order = Literal[1, 2]
ORDERS: tuple[Order, Order] = (1, 2)
Row = tuple[Formula, Formula, Formula]
Mark = Literal["˙", "¨", "′", "″"]


class Letters(NamedTuple):
    """How rates are written, of the first and of the second order: of angles, of ways, of coordinates."""

    turning: tuple[Symbol, Symbol]
    sliding: tuple[Symbol, Symbol]
    moving: tuple[Mark, Mark]


IN_TIME = Letters((Symbol("ω"), Symbol("α")), (Symbol("s", mark="˙"), Symbol("s", mark="¨")), ("˙", "¨"))
BY_INPUT = Letters((Symbol("h"), Symbol("h", mark="′")), (Symbol("f"), Symbol("f", mark="′")), ("′", "″"))


class TurnUnknown(NamedTuple):
    """An unknown of two equations: how a rigid body turns, whose column is this."""

    frame: int
    column: Components


class SlideUnknown(NamedTuple):
    """An unknown of two equations: how fast something slides, whose column is this; `letter` is its way's."""

    way: str
    column: Components
    letter: str = ""


_SHORT = 3
"""So many symbols a right side has that stands in the equations themselves."""


@dataclass
class Rates:
    """The rates known so far, of the first order and then of the second; each strut's force and rate."""

    work: Work
    letters: Letters
    scale: Scale
    turning: dict[int, list[Formula]] = field(default_factory=lambda: {0: [ZERO, ZERO]})
    sliding: dict[str, list[Formula]] = field(default_factory=dict)
    moving: dict[str, list[Components]] = field(default_factory=dict)
    struts: dict[Spring | Damper, tuple[Formula, Formula]] = field(default_factory=dict)

    def let(self, symbol: Symbol, formula: Formula, measure: Powers) -> Formula:
        """Add the line that gives a symbol its value, and return it."""
        return self.work.let(symbol, formula, measure, self.scale)

    def let_turning(self, frame: int, formula: Formula, order: Order) -> None:
        """Add the line that says how a rigid body turns."""
        found = self.let(self.turn_symbol(frame, order), formula, Powers(rate=order))
        self.turning.setdefault(frame, []).append(found)

    def let_moving(self, joint: str, formula: Components, order: Order) -> None:
        """Add the lines that say how a joint moves."""
        mark, measure = self.letters.moving[order - 1], Powers(1, order)
        x = self.let(Symbol("x", joint, mark), formula.x, measure)
        y = self.let(Symbol("y", joint, mark), formula.y, measure)
        self.moving.setdefault(joint, []).append(Components(x, y))

    def turn_symbol(self, frame: int, order: Order) -> Symbol:
        """Return the symbol of how a rigid body turns."""
        return self.letters.turning[order - 1]._replace(sub=self.work.names.turning(frame))

    def of(self, joint: str, order: Order) -> Components:
        """Return how a joint moves."""
        return self.moving[joint][order - 1]

    def turn(self, frame: int, order: Order) -> Formula:
        """Return how a rigid body turns."""
        return self.turning[frame][order - 1]

    def carried(self, frame: int, arm: Components, order: Order) -> Components:
        """Return how much more a point of a rigid body moves than another, `arm` before it."""
        turn = arm.left().times(self.turn(frame, order))
        return turn if order == 1 else turn - self.centripetal(frame, arm)

    def centripetal(self, frame: int, arm: Components) -> Components:
        """Return ω² times an arm."""
        return arm.times(square(self.turn(frame, 1)))

    def guided(self, guide: GuideLine, arm: Components, slid: Components, order: Order) -> Components:
        """Return how the point of a guide moves, `arm` from the joint that it runs through.

        Of the second order with what Coriolis adds, where `slid` is the first one along the guide.
        """
        base = self.of(guide.through, order) + self.carried(guide.frame, arm, order)
        return base if order == 1 else base + slid.left().times(TWO * self.turn(guide.frame, 1))

    def solve(
        self,
        index: str,
        unknowns: tuple[TurnUnknown | SlideUnknown, TurnUnknown | SlideUnknown],
        right: Components,
        order: Order,
    ) -> None:
        """Add the two equations and what they give; ZeroDivisionError where that is nothing."""
        one, other = (unknown.column for unknown in unknowns)
        left, beside = (LENGTH if isinstance(unknown, TurnUnknown) else RATIO for unknown in unknowns)
        names = self._symbol(unknowns[0], order), self._symbol(unknowns[1], order)
        measures = left, beside, Powers(1, order)
        right = self._right(right, measures[2])
        formulas = (one.x, other.x, right.x), (one.y, other.y, right.y)
        values = self._row(formulas[0], measures, 1), self._row(formulas[1], measures, 2)
        (a, b, c), (d, e, f) = values
        self.work.items.append(System(names, formulas, values))
        det = self.let(Symbol("D", index), a * e - b * d, Powers(left.length + beside.length))
        for unknown, name, formula in zip(unknowns, names, (c * e - b * f, a * f - d * c), strict=True):
            if isinstance(unknown, TurnUnknown):
                self.let_turning(unknown.frame, formula / det, order)
            else:
                found = self.let(name, formula / det, Powers(1, order))
                self.sliding.setdefault(unknown.letter + unknown.way, []).append(found)

    def _right(self, right: Components, measure: Powers) -> Components:
        """Return the right sides; long ones have lines of their own before the equations."""
        if max(len(list(side.leaves)) for side in right) <= _SHORT:
            return right
        return Components(*(self.let(Symbol("b", str(n)), side, measure) for n, side in enumerate(right, 1)))

    def _row(self, formulas: Row, measures: tuple[Powers, Powers, Powers], row: int) -> Row:
        """Return the entries of a row, a₁₁ a₁₂ b₁, in the digits that they show."""
        names = Symbol("a", f"{row}1"), Symbol("a", f"{row}2"), Symbol("b", str(row))
        first, second, right = map(self._entry, formulas, measures, names)
        return first, second, right

    def _symbol(self, unknown: TurnUnknown | SlideUnknown, order: Order) -> Symbol:
        if isinstance(unknown, TurnUnknown):
            return self.turn_symbol(unknown.frame, order)
        symbol = self.letters.sliding[order - 1]._replace(sub=self.work.names.slide(unknown.way).sub)
        return symbol._replace(letter=unknown.letter) if unknown.letter and symbol.letter == "s" else symbol

    def _entry(self, formula: Formula, measure: Powers, symbol: Symbol) -> Formula:
        if formula.constant is not None or (formula.symbol and formula.symbol.letter == "b"):
            return formula
        return Formula("leaf", symbol=symbol, shown=rounded(formula.value, self.scale.decimals(measure)))
