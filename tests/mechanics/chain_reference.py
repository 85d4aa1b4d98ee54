"""A chain of dyads to many digits, each joint by the plainest construction on complex numbers.

Nothing is shared with the solver: circles are met with circles and lines, and directions are quotients.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mpmath import mp, mpf
from reference import on_line, unit

from linkanim.bench.reference import crossing
from linkanim.mechanics.linkage import (
    RPP,
    RPR,
    RRP,
    RRR,
    Crank,
    DrivenSlider,
    Joint,
    Line,
    Linkage,
    Pin,
    Rigid,
)

Places = dict[str, Any]


def places(linkage: Linkage, angle: Any, signs: Mapping[str, int] | None = None) -> Places:
    """Where every joint lies at an angle of the input, or a slider's travel; `signs` replaces named sides."""
    found: Places = {}
    turned: dict[str, Any] = {linkage.drive.joint: angle}
    for joint in linkage.joints:
        found[joint.name] = _place(joint, found, turned, (signs or {}).get(joint.name))
    return found


def _place(joint: Joint, at: Places, turned: dict[str, Any], sign: int | None) -> Any:
    match joint:
        case Pin():
            return mp.mpc(*map(mpf, joint.position))
        case Crank():
            return at[joint.pivot] + mpf(joint.length) * unit(_turned(joint, turned))
        case DrivenSlider():
            base, along = _line(joint.line, at)
            return base + along * mp.mpc(turned[joint.name], mpf(joint.line.offset))
        case RRR():
            p, q = (at[end] for end in joint.ends)
            a, b = map(mpf, joint.lengths)
            return crossing(p, q, a, b, joint.side if sign is None else sign)
        case RRP():
            base, along = _line(joint.line, at)
            seen = (at[joint.end] - base) / along
            side = joint.side if sign is None else sign
            return base + along * on_line(seen, mpf(joint.length), mpf(joint.line.offset), side)
        case RPP():
            base, along = _line(joint.line, at)
            seen = (at[joint.pin] - base) / along
            rise = mp.im(seen) - mpf(joint.line.offset)
            way = mp.re(seen) - rise * mp.cos(mpf(joint.slot)) / mp.sin(mpf(joint.slot))
            return base + along * mp.mpc(way, mpf(joint.line.offset))
        case RPR():
            way, offset = at[joint.through] - at[joint.pivot], mpf(joint.offset)
            slide = mp.sqrt(abs(way) ** 2 - offset**2) * (1 if sign is None else sign)
            return at[joint.pivot] + mpf(joint.length) * way / mp.mpc(slide, offset)
        case Rigid():
            start, end = (at[name] for name in joint.on)
            return start + mp.mpc(*map(mpf, joint.at)) * (end - start) / abs(end - start)
    raise AssertionError(joint)


def _turned(crank: Crank, turned: dict[str, Any]) -> Any:
    if crank.gear is not None:
        ratio = mpf(crank.gear.ratio.numerator) / crank.gear.ratio.denominator
        turned[crank.name] = turned[crank.gear.mate] * ratio + mpf(crank.gear.offset)
    return turned[crank.name]


def _line(line: Line, at: Places) -> tuple[Any, Any]:
    """The base point of a line, and its direction."""
    along = unit(mpf(line.angle))
    if line.on is not None:
        axis = at[line.on[1]] - at[line.on[0]]
        along = along * axis / abs(axis)
    return at[line.through], along
