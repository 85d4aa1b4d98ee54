"""Putting a linkage together: the input's path, and the sign of each closure on it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from . import clock as clocks
from .assembly import Arc, Loop, Path, Swing, Turn, find_loops, gearings, open_arcs
from .chain import LimitFit, Touches
from .exact import exact_angle
from .expression import Graph, Value
from .linkage import RPR, RRP, RRR, Crank, Joint, Linkage, Pin, Polar, Rigid
from .planar import MovingPoint, Slope
from .program import batch
from .roots import Kind
from .traversal import Kinematics, Plan, walk

JUST_AFTER = 1e-6
"""Phase at which a closure is judged where it is ambiguous at the start itself."""


@dataclass(frozen=True)
class Assembly:
    """A linkage's loops, the path of its input and the sign of every closure.

    `linkage` has its lengths scaled by a power of two where products of four of them could leave
    the range of a float; `unscale` brings results back.
    """

    linkage: Linkage
    loops: Mapping[str, Loop]
    path: Path
    signs: Mapping[str, int]
    unscale: float = 1.0
    fits: Mapping[str, LimitFit] = field(default_factory=dict)
    touches: Mapping[str, Touches] = field(default_factory=dict)

    def walk(self, clock: clocks.Clock) -> Kinematics:
        """Return the motion of everything at the clock's instant."""
        plan = Plan(self.linkage, self.loops, self.signs, self.path, self.fits, self.touches)
        return walk(plan, clock)

    def clock(self, phase: Value, pace: Slope) -> clocks.Clock:
        """Return the input's state at a phase, in plain floats or noted expressions."""
        if isinstance(self.path, Turn):
            return clocks.turn(phase, pace, exact_angle(self.path.start))
        return clocks.swing_by_phase(phase, pace, self.path.middle, self.path.amplitude)


def assemble(linkage: Linkage) -> Assembly:
    """Return the linkage put together as it asks; AssemblyError where it cannot be."""
    scale = _scale(linkage)
    scaled = _scaled(linkage, scale)
    loops = find_loops(scaled)
    return _named(
        Assembly(scaled, loops, path, {}, 1.0 / scale)
        for path in _paths(scaled, loops, open_arcs(linkage, loops))
    )


def resigned(assembly: Assembly) -> Assembly:
    """Return the assembly with its closures named anew on its path."""
    return _named([assembly])


def _named(assemblies: Iterable[Assembly]) -> Assembly:
    """Return the first assembly on which the dyads can lie as they are named, with the signs for it.

    Where the joint that a name goes by lies on one side whatever the signs, they are the first
    assembly's first: then the name is that of the dyad's own side.
    """
    found = [
        replace(assembly, signs=signs)
        for assembly in assemblies
        for signs in _sign_choices(assembly.linkage, assembly.loops, assembly.path)
    ]
    return next((assembly for assembly in found if _is_as_named(assembly)), found[0])


def _scale(linkage: Linkage) -> float:
    """Return 1, or the power of two that brings extreme lengths near 1."""
    longest = max((abs(length) for length in _lengths(linkage)), default=1.0)
    exponent = math.frexp(longest)[1]
    return 1.0 if abs(exponent) < 128 else math.ldexp(1.0, -exponent)


def _lengths(linkage: Linkage) -> Iterator[float]:
    for joint in linkage.joints:
        match joint:
            case Pin():
                yield from joint.position
            case RRR():
                yield from joint.lengths
            case Crank() | RRP() | RPR():
                yield joint.length
            case Rigid():
                yield from joint.at


def _scaled(linkage: Linkage, scale: float) -> Linkage:
    if scale == 1.0:
        return linkage
    bodies = tuple(
        body if body.com is None else replace(body, com=(body.com[0] * scale, body.com[1] * scale))
        for body in linkage.bodies
    )
    joints = tuple(_scaled_joint(joint, scale) for joint in linkage.joints)
    return replace(linkage, joints=joints, bodies=bodies)


def _scaled_joint(joint: Joint, scale: float) -> Joint:
    match joint:
        case Pin():
            polar = joint.polar and Polar(joint.polar.length * scale, joint.polar.angle, joint.polar.base)
            return Pin(joint.name, (joint.position[0] * scale, joint.position[1] * scale), polar)
        case Crank():
            return replace(joint, length=joint.length * scale)
        case RRR():
            return replace(joint, lengths=(joint.lengths[0] * scale, joint.lengths[1] * scale))
        case RRP():
            line = replace(joint.line, offset=joint.line.offset * scale)
            return replace(joint, length=joint.length * scale, line=line)
        case RPR():
            return replace(joint, length=joint.length * scale, offset=joint.offset * scale)
        case Rigid():
            return replace(joint, at=(joint.at[0] * scale, joint.at[1] * scale))


def _paths(linkage: Linkage, loops: Mapping[str, Loop], arcs: list[Arc] | None) -> Iterator[Path]:
    """Yield the paths the input may take, the one asked for first."""
    if arcs is None:
        yield Turn(linkage.drive.start, turns_to_return(linkage, loops))
        return
    for arc in sorted(arcs, key=lambda arc: _rank(arc, linkage.drive.start, loops)):
        yield Swing(arc.low, arc.high, arc.ends)


def _rank(arc: Arc, start: float, loops: Mapping[str, Loop]) -> tuple[bool, bool]:
    """Order ranges: the one that contains the start, then the one above the ground line."""
    middle, half = float(arc.low + arc.high) / 2, float(arc.high - arc.low) / 2
    apart = abs(math.remainder(start - middle, 2 * math.pi))
    above = math.sin(middle - float(loops[arc.ends[0]].root.reference)) > 0
    return not apart <= half, not above


def turns_to_return(linkage: Linkage, loops: Mapping[str, Loop]) -> int:
    """Return after how many turns of the input every joint is back.

    A crank geared p/q needs q turns; a loop with one change point needs its half angle to return.
    """
    counts = [gearing.ratio.denominator for gearing in gearings(linkage).values()]
    for loop in loops.values():
        kinds = (loop.root.u.kind, loop.root.w.kind)
        if kinds.count(Kind.CHANGE_POINT) == 1:
            counts.append((loop.gearing.ratio / 2).denominator)
    return math.lcm(*counts)


def _sign_choices(linkage: Linkage, loops: Mapping[str, Loop], path: Path) -> Iterator[dict[str, int]]:
    """Yield the closures' signs on a path: one choice, two where a dyad is named by another joint's side."""
    signs = {}
    named_otherwise = []
    for joint in linkage.joints:
        match joint:
            case RRR():
                signs[joint.name] = -joint.side if joint.side_of else joint.side
                if joint.side_of:
                    named_otherwise.append(joint.name)
            case RRP():
                signs[joint.name] = joint.side
            case RPR():
                signs[joint.name] = 1
    signs = {name: sign * _just_after_start(loops.get(name), path) for name, sign in signs.items()}
    yield signs
    for name in named_otherwise:
        yield {**signs, name: -signs[name]}


def _just_after_start(loop: Loop | None, path: Path) -> int:
    """Return the sign that the loop's own root has just after the start: the named closure holds there."""
    if loop is None:
        return 1
    pace = Slope(1.0)
    if isinstance(path, Turn):
        clock = clocks.turn(JUST_AFTER, pace, exact_angle(path.start))
    else:
        clock = clocks.swing_by_phase(JUST_AFTER, pace, path.middle, path.amplitude)
    return loop.sign(clock)


def _is_as_named(assembly: Assembly) -> bool:
    """Tell whether dyads that are named by another joint's side lie as asked just after the start."""
    named = [joint for joint in assembly.linkage.joints if isinstance(joint, RRR) and joint.side_of]
    if not named:
        return True
    graph = Graph()
    points = assembly.walk(assembly.clock(graph.input("x"), Slope(0.0))).points
    # Compiled, so that only what the named joints need is worked out: what follows may not close yet.
    program = batch({"x": True}, [_side(points, joint) for joint in named])
    with np.errstate(all="ignore"):
        return bool((program(np.array([JUST_AFTER])) > 0).all())


def _side(points: Mapping[str, MovingPoint], joint: RRR) -> Value:
    """Return a number that is positive where the joint lies as it is named."""
    assert joint.side_of is not None
    b, p, q = (points[name].position for name in joint.side_of)
    return (q - p).cross(b - p) * float(joint.side)
