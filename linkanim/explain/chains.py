"""Vectors from joint to joint, of which loops are made."""

from __future__ import annotations

from typing import NamedTuple

from linkanim.explain.expression import Components, Symbol
from linkanim.explain.work import GuideLine, Work


class LoopSide(NamedTuple):
    """One vector of a loop: its symbol, and its components as formulas."""

    symbol: Symbol
    vector: Components


class Route(NamedTuple):
    """A way from a joint, by these vectors."""

    start: str
    sides: tuple[LoopSide, ...]


def bar_side(work: Work, start: str, end: str, length: float) -> LoopSide:
    """Return a bar as a vector of a loop."""
    return LoopSide(Symbol("R", work.names.length(start, end), bold=True), work.bar(start, end, length))


def slide_sides(work: Work, guide: GuideLine, joint: str) -> tuple[LoopSide, ...]:
    """Return the ways along a guide, and from it where it is offset."""
    slide = work.slides[joint]
    index = work.names.slide(joint).sub
    found = [LoopSide(Symbol("S", index, bold=True), guide.direction.times(slide))]
    if guide.offset.constant != 0:
        found.append(LoopSide(Symbol("E", joint, bold=True), guide.direction.left().times(guide.offset)))
    return tuple(found)
