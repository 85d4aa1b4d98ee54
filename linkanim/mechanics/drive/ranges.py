"""The ranges of the input that the loops on its own pin leave open."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from linkanim.errors import AssemblyError
from linkanim.mechanics.drive.swing import Swing
from linkanim.mechanics.formulas.exact import HALF_TURN, Sum
from linkanim.mechanics.linkage.joint import Joint
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.loops.loop import Loop
from linkanim.mechanics.loops.roots import Kind, LoopRoot

NO_RANGE = 1e-12
"""Ranges that overlap by no more than this, in radians, touch."""
ONE_PLACE = (
    "it can be put together at one angle of the input only, so that nothing could move; "
    "make one length a little longer or shorter"
)


def open_arcs(linkage: Linkage, loops: Mapping[str, Loop]) -> list[Swing] | None:
    """Return the ranges of the input that the loops on its own pin leave open; None for a full turn.

    AssemblyError where a loop cannot be closed at any angle, or the loops leave no common range.
    """
    arcs: list[Swing] | None = None
    for name, loop in loops.items():
        if loop.pin == linkage.drive.joint:
            unscale = linkage.crank(loop.pin).length / loop.crank.length
            own = arcs_of(linkage.joint(name), loop.root, linkage.unit, unscale)
            arcs = own if arcs is None else arcs if own is None else list(_common(arcs, own))
            if arcs == []:
                raise AssemblyError(f"joint {name}: the bars of the linkage leave its input no common range")
    return arcs


def arcs_of(joint: Joint, root: LoopRoot, unit: str, unscale: float = 1.0) -> list[Swing] | None:
    """Return a loop's open ranges in the crank's own angle; times `unscale` its lengths are the joint's."""
    if min(root.u.most, root.w.most) == 0:
        raise AssemblyError(f"joint {joint.name}: {ONE_PLACE}")
    if min(root.u.most, root.w.most) < 0:
        u, w = (factor.most * root.unit * unscale**2 for factor in (root.u, root.w))
        raise AssemblyError(f"joint {joint.name}: {joint.why_apart(u, w, unit)}")
    ends, reference = (joint.name, joint.name), root.reference
    u_limits, w_limits = root.u.kind is Kind.LIMIT, root.w.kind is Kind.LIMIT
    if u_limits and w_limits:
        inner, outer = root.w.short, root.u.reach
        above = Swing(reference + inner, reference + outer, ends)
        return [above, Swing(reference - outer, reference - inner, ends)]
    if u_limits:
        return [Swing(reference - root.u.reach, reference + root.u.reach, ends)]
    if w_limits:
        middle = reference + HALF_TURN
        return [Swing(middle - root.w.reach, middle + root.w.reach, ends)]
    return None


def _common(first: list[Swing], second: list[Swing]) -> Iterator[Swing]:
    """Yield the ranges that both lists leave open, the input's angle being the same every turn."""
    for a in first:
        for b in second:
            for turns in (-1, 0, 1):
                moved = b.shifted(turns)
                low, low_end = max((a.low, a.ends[0]), (moved.low, moved.ends[0]), key=_size)
                high, high_end = min((a.high, a.ends[1]), (moved.high, moved.ends[1]), key=_size)
                if float(high - low) > NO_RANGE:
                    yield Swing(low, high, (low_end, high_end))


def _size(end: tuple[Sum, str]) -> tuple[float, float]:
    return end[0].high, end[0].low
