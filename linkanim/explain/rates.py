"""Velocities and accelerations, or kinematic coefficients: what is known of them so far, and the lines.

Both are one course of work: in time with rates ω, α, or by the input with h, h′, which are the same rates for
an input that runs at 1. Each dyad's two unknowns follow from its loop, differentiated: two linear equations.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, NamedTuple

from linkanim.explain.expression import NOWHERE, TWO, ZERO, Components, Formula, Symbol, square
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


Way = int | str
"""What has a rate: a rigid body by its number, or what slides by its joint."""


class UnknownRate(NamedTuple):
    """An unknown of two equations: the rate of what this is, its column, and the letter of what slides."""

    way: Way
    column: Components
    letter: str = "s"


_SHORT = 3
"""So many symbols a right side has that stands in the equations themselves."""


@dataclass
class Rates:
    """The rates known so far, of the first order and then of the second; each strut's force and rate."""

    work: Work
    letters: Letters
    scale: Scale
    known: dict[tuple[Way, str], list[Formula]] = field(default_factory=lambda: {(0, "s"): [ZERO, ZERO]})
    moving: dict[str, list[Components]] = field(default_factory=dict)
    struts: dict[Spring | Damper, tuple[Formula, Formula]] = field(default_factory=dict)

    def let(self, symbol: Symbol, formula: Formula, measure: Powers) -> Formula:
        """Add the line that gives a symbol its value, and return it."""
        return self.work.let(symbol, formula, measure, self.scale)

    def start(self, rate: Formula, second: Formula = ZERO) -> None:
        """Put the input's rates where those of its body, or of its slider, stand."""
        self.known[self.work.driver, "s"] = [rate, second]

    def let_rate(self, way: Way, formula: Formula, order: Order, letter: str = "s") -> Formula:
        """Add the line that says how a rigid body turns, or how fast something slides."""
        measure = Powers(int(isinstance(way, str)), order)
        found = self.let(self.symbol(way, order, letter), formula, measure)
        self.known.setdefault((way, letter), []).append(found)
        return found

    def let_moving(self, joint: str, formula: Components, order: Order) -> None:
        """Add the lines that say how a joint moves."""
        mark, measure = self.letters.moving[order - 1], Powers(1, order)
        x = self.let(Symbol("x", joint, mark), formula.x, measure)
        y = self.let(Symbol("y", joint, mark), formula.y, measure)
        self.moving.setdefault(joint, []).append(Components(x, y))

    def let_carried(self, joint: str, on: tuple[str, str], arm: Components, order: Order) -> None:
        """Add the lines that say how what a rigid body carries moves, `arm` from the first of two joints."""
        self.let_moving(joint, self.of(on[0], order) + self.carried(self.work.frame(on), arm, order), order)

    def symbol(self, way: Way, order: Order, letter: str = "s") -> Symbol:
        """Return the symbol of how a rigid body turns, or of how fast something slides."""
        if isinstance(way, int):
            return self.letters.turning[order - 1]._replace(sub=self.work.names.turning(way))
        symbol = self.letters.sliding[order - 1]._replace(sub=self.work.names.slide(way).sub)
        return symbol._replace(letter=letter) if symbol.letter == "s" else symbol

    def of(self, joint: str, order: Order) -> Components:
        """Return how a joint moves."""
        return self.moving[joint][order - 1]

    def rate(self, way: Way, order: Order, letter: str = "s") -> Formula:
        """Return how a rigid body turns, or how fast something slides."""
        return self.known[way, letter][order - 1]

    def carried(self, frame: int, arm: Components, order: Order) -> Components:
        """Return how much more a point of a rigid body moves than another, `arm` before it."""
        turn = arm.left().times(self.rate(frame, order))
        return turn if order == 1 else turn - self.centripetal(frame, arm)

    def centripetal(self, frame: int, arm: Components) -> Components:
        """Return ω² times an arm."""
        return arm.times(square(self.rate(frame, 1)))

    def guided(self, guide: GuideLine, joint: str, order: Order, *sliding: UnknownRate) -> Components:
        """Return how the point moves of what carries a guide where a joint is.

        Of the second order with what Coriolis adds for what is `sliding` there.
        """
        arm = self.work.points[joint] - self.work.points[guide.through]
        base = self.of(guide.through, order) + self.carried(guide.frame, arm, order)
        if order == 1:
            return base
        slid = sum((one.column.times(self.rate(one.way, 1, one.letter)) for one in sliding), NOWHERE)
        return base + slid.left().times(TWO * self.rate(guide.frame, 1))

    def solve(
        self, index: str, unknowns: tuple[UnknownRate, UnknownRate], right: Components, order: Order
    ) -> None:
        """Add the two equations and what they give; ZeroDivisionError where that is nothing."""
        one, other = (unknown.column for unknown in unknowns)
        left, beside = (LENGTH if isinstance(unknown.way, int) else RATIO for unknown in unknowns)
        first, second = (self.symbol(unknown.way, order, unknown.letter) for unknown in unknowns)
        measures = left, beside, Powers(1, order)
        right = self._right(right, measures[2])
        formulas = (one.x, other.x, right.x), (one.y, other.y, right.y)
        values = self._row(formulas[0], measures, 1), self._row(formulas[1], measures, 2)
        (a, b, c), (d, e, f) = values
        self.work.items.append(System((first, second), formulas, values))
        det = self.let(Symbol("D", index), a * e - b * d, Powers(left.length + beside.length))
        for unknown, formula in zip(unknowns, (c * e - b * f, a * f - d * c), strict=True):
            self.let_rate(unknown.way, formula / det, order, unknown.letter)

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

    def _entry(self, formula: Formula, measure: Powers, symbol: Symbol) -> Formula:
        if formula.constant is not None or (formula.symbol and formula.symbol.letter == "b"):
            return formula
        return Formula("leaf", symbol=symbol, shown=rounded(formula.value, self.scale.decimals(measure)))
