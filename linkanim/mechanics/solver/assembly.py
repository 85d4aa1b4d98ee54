"""Putting a linkage together: its loops, the input's path, and the sign of each closure on it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from linkanim.bounds import MOST_DYAD_TURNS, MOST_GEARED_TURNS, MOST_TURNS
from linkanim.errors import AssemblyError, DyadAtLimit
from linkanim.mechanics.arithmetic import Constant, Graph, MovingPoint, Slope, Value
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.program import batch
from linkanim.mechanics.solver.closing import Assembly, closer_of, refuse_loose, walk_at
from linkanim.mechanics.solver.input import InputPath, Swing, Turn
from linkanim.mechanics.solver.loop import Gearing, Loop, arcs_of, gearings, open_arcs
from linkanim.mechanics.solver.signed_root import Kind
from linkanim.mechanics.solver.strokes import STROKES
from linkanim.mechanics.tolerances import APART, JUST_AFTER, OWN_LIMIT


def assemble(linkage: Linkage) -> Assembly:
    """Return the linkage put together as it asks, seen from its origin; AssemblyError where it cannot be."""
    refuse_loose(linkage)
    linkage = linkage.near
    scale = _scale(linkage)
    scaled = linkage if scale == 1.0 else linkage.scaled(scale)
    loops = find_loops(scaled, gearings(scaled))
    arcs = open_arcs(linkage, loops)
    paths: tuple[InputPath, ...] = ()
    course = None
    if together := _together(scaled):
        path, course = together.group.followed(scaled, 1.0 / scale)
        paths = () if course.by_angle else (_within(arcs, path),)
    turns = course.turns if course and not paths else 1
    return _named(
        Assembly(scaled, loops, path, {}, 1.0 / scale, course=course)
        for path in paths or _paths(scaled, loops, arcs, 1.0 / scale, turns)
    )


def _together(linkage: Linkage) -> Any:
    """Return a joint that is solved together with others; None where all are closed one by one."""
    return next((joint for joint in linkage.joints if joint.grouped), None)


def _within(arcs: list[Swing] | None, path: InputPath) -> InputPath:
    """Return the path of a group; DyadAtLimit where a loop on its crank's pin does not leave it all of it."""
    if arcs is None:
        return path
    low, high = path.input_range
    around = (arc.shifted(arc.turns_to((low + high) / 2)) for arc in arcs)
    if any(float(arc.low) < low - APART and high + APART < float(arc.high) for arc in around):
        return path
    raise DyadAtLimit("a dyad leaves the input less room than the links that are solved together")


def find_loops(linkage: Linkage, gears: Mapping[str, Gearing]) -> dict[str, Loop]:
    """Return the dyads that close from a crank pin against something fixed, by the joint's name.

    A loop that limits a geared crank is left to the general closure.
    """
    loops = ((joint.name, closer_of(joint).loop(joint, linkage, gears)) for joint in linkage.joints)
    own = linkage.drive.joint
    return {name: loop for name, loop in loops if loop and (loop.pin == own or not loop.limits)}


def precise(assembly: Assembly) -> Assembly:
    """Return the assembly for many digits: its lengths stay exact in all constants computed from them."""
    linkage = assembly.linkage.scaled(Constant(1.0))
    return replace(assembly, linkage=linkage, loops=find_loops(linkage, gearings(linkage)))


def resigned(assembly: Assembly) -> Assembly:
    """Return the assembly with its closures named anew on its path."""
    return _named([assembly])


def _named(assemblies: Iterable[Assembly]) -> Assembly:
    """Return the first assembly on which the dyads can lie as they are named, with the signs for it.

    Where another joint's side names a dyad but is the same for all signs, the first signs of the first
    assembly are taken: the name is then read as the dyad's own side.
    """
    choices = [
        replace(assembly, signs=signs)
        for assembly in assemblies
        for signs in _sign_choices(assembly.linkage, assembly.loops, assembly.path)
    ]
    return next((assembly for assembly in choices if _is_as_named(assembly)), choices[0])


def _scale(linkage: Linkage) -> float:
    """Return 1, or the power of two that brings extreme lengths near 1."""
    exponent = math.frexp(linkage.longest)[1]
    return 1.0 if abs(exponent) < 128 else math.ldexp(1.0, -exponent)


def _paths(
    linkage: Linkage, loops: Mapping[str, Loop], arcs: list[Swing] | None, unscale: float, turns: int
) -> Iterator[InputPath]:
    """Yield the paths the input may take, the best one first; a group is back after so many `turns`."""
    stroke = STROKES.get(type(linkage.drive.actuator))
    if stroke is not None:
        yield replace(stroke(linkage, unscale, arcs), keeps=(linkage.drive.retraced,) * 2)
        return
    if arcs is None:
        yield Turn(linkage.drive.start, turns_to_return(linkage, loops, turns))
        return
    start = linkage.drive.stated_start
    for arc in sorted(arcs, key=lambda arc: _rank(arc, linkage, loops)):
        around = arc if start is None else arc.shifted(arc.turns_to(start))
        rounds = _rounds(linkage, loops, arc)
        yield replace(around, rounds=rounds, keeps=(linkage.drive.retraced,) * 2)


def starts(linkage: Linkage) -> list[float]:
    """Return starts: one in each range that the loops on the input's own pin leave it, or for each triangle.

    Of an input that these loops let turn fully it is its own start. A slider that drives has no start.
    """
    if linkage.drive.actuator.noun or _together(linkage):
        return []
    assembly = assemble(linkage)
    arcs = open_arcs(assembly.linkage, assembly.loops)
    between = [linkage.drive.start] if arcs is None else [float(arc.middle) for arc in arcs]
    return assembly.path.starts or between


def _rounds(linkage: Linkage, loops: Mapping[str, Loop], arc: Swing) -> int:
    """Return 2 where one loop sets both ends of a range and another is at its limit at one, too; else 1."""
    first, last = arc.ends
    others = {name: loop for name, loop in loops.items() if name != first and loop.pin == linkage.drive.joint}
    if first != last:
        return 1
    for name, loop in others.items():
        arcs = arcs_of(linkage.joint(name), loop.root, linkage.unit) or ()
        own = [other.shifted(turns) for other in arcs for turns in (-1, 0, 1)]
        low = any(abs(float(other.low - arc.low)) <= OWN_LIMIT for other in own)
        high = any(abs(float(other.high - arc.high)) <= OWN_LIMIT for other in own)
        if low != high:
            return 2
    return 1


def _rank(arc: Swing, linkage: Linkage, loops: Mapping[str, Loop]) -> tuple[bool, bool]:
    """Order ranges: the one that contains a stated start, then the one above the ground line."""
    start, loop = linkage.drive.stated_start, loops[arc.ends[0]]
    contained = start is not None and arc.holds(start)
    left = math.sin(float(arc.middle) - float(loop.root.reference)) > 0
    return not contained, left == runs_back(linkage, arc.ends[0], loop)


def runs_back(linkage: Linkage, name: str, loop: Loop) -> bool:
    """Tell whether a loop's ground starts at the pin stated later, so that its right side is above."""
    ends = {loop.crank.pivot, *linkage.joint(name).pins}
    first = next(pin.name for pin in linkage.pins if pin.name in ends)
    return loop.ground is not None and first != loop.crank.pivot


def turns_to_return(linkage: Linkage, loops: Mapping[str, Loop], own: int = 1) -> int:
    """Return after how many turns of the input every joint is back; a group is after its `own` turns.

    A crank geared p/q needs q turns; a loop with one change point needs its half angle to return.
    AssemblyError where that is longer than can be looked at.
    """
    gears = gearings(linkage)
    counts = [gearing.ratio.denominator for gearing in gears.values()]
    for loop in loops.values():
        kinds = (loop.root.u.kind, loop.root.w.kind)
        if kinds.count(Kind.CHANGE_POINT) == 1:
            counts.append((loop.gearing.ratio / 2).denominator)
    turns = math.lcm(own, *counts)
    if turns > (most := most_turns(linkage)):
        geared = [f"{name} ({gears[name].ratio})" for name in gears if gears[name].ratio.denominator > 1]
        raise AssemblyError(
            f"joint {geared[-1].partition(' ')[0]}: with the gears {', '.join(geared)} every joint is back "
            f"after {turns:,} turns only, and {most:,} are the most here;"
            " give their ratios denominators in common"
        )
    quickest = max(gears, key=lambda name: abs(gears[name].ratio), default="")
    if quickest and turns * abs(gears[quickest].ratio) > MOST_GEARED_TURNS:
        raise AssemblyError(
            f"joint {quickest}: it turns {gears[quickest].ratio} times as fast as the input, and at most"
            f" {MOST_GEARED_TURNS:,} turns are looked at until every joint is back; give it a smaller ratio"
        )
    return turns


def most_turns(linkage: Linkage) -> int:
    """Return the most turns of the input within which every joint has to be back: fewer with many dyads."""
    dyads = sum(joint.dyad for joint in linkage.joints)
    return min(MOST_TURNS, MOST_DYAD_TURNS // max(dyads, 1))


def _sign_choices(linkage: Linkage, loops: Mapping[str, Loop], path: InputPath) -> Iterator[dict[str, int]]:
    """Yield the closures' signs on a path: one choice, two where a dyad is named by another joint's side."""
    named = {joint.name: joint.named_sign for joint in linkage.joints}
    signs = {name: sign for name, sign in named.items() if sign is not None}
    # A loop's own root has a sign just after the start, where the named closure holds.
    start = path.state(JUST_AFTER, Slope(1.0))
    signs = {name: sign * (loops[name].sign(start) if name in loops else 1) for name, sign in signs.items()}
    yield signs
    for joint in linkage.joints:
        if joint.named_from:
            yield {**signs, joint.name: -signs[joint.name]}


def _is_as_named(assembly: Assembly) -> bool:
    """Tell whether dyads that are named by another joint's side lie as named just after the start."""
    named = [joint.named_from for joint in assembly.linkage.joints if joint.named_from]
    if not named:
        return True
    points = walk_at(assembly, Graph().input("x"), Slope(0.0)).points
    # Compiled, so that only what the named joints need is worked out: what follows may not close yet.
    program = batch({"x": True}, [side_of(points, *naming) for naming in named])
    with np.errstate(all="ignore"):
        return bool((program(np.array([JUST_AFTER])) > 0).all())


def side_of(points: Mapping[str, MovingPoint], side: int, *line: str) -> Value:
    """Return a number that is positive where a joint lies on the side of a line by which it is named."""
    b, p, q = (points[name].position for name in line)
    return (q - p).cross(b - p) * float(side)
