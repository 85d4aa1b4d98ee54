"""Vectors from joint to joint, of which loops are made."""

from __future__ import annotations

from typing import NamedTuple

from linkanim.explain.expression import Components, Symbol
from linkanim.explain.work import GuideLine, Work
from linkanim.mechanics.linkage.joint import Joint


class LoopSide(NamedTuple):
    """One vector of a loop: its symbol, and its components as formulas."""

    symbol: Symbol
    vector: Components


class Route(NamedTuple):
    """A way from a joint, by these vectors."""

    start: str
    sides: tuple[LoopSide, ...]


def route_of_bar(joint: Joint, work: Work, which: int = 0) -> Route:
    """Return the way to a joint by one of its bars."""
    start, length = joint.bars[which]
    symbol = Symbol("R", work.names.length(start, joint.name), bold=True)
    return Route(start, (LoopSide(symbol, work.bar(start, joint.name, length)),))


def slide_sides(work: Work, guide: GuideLine, joint: str) -> tuple[LoopSide, ...]:
    """Return the ways along a guide, and from it where it is offset."""
    slide = work.slides[joint]
    index = work.names.slide(joint).sub
    found = [LoopSide(Symbol("S", index, bold=True), guide.direction.times(slide))]
    if guide.offset.constant != 0:
        found.append(LoopSide(Symbol("E", joint, bold=True), guide.direction.left().times(guide.offset)))
    return tuple(found)
