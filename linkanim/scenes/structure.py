"""How the joints of a scene hang together: the order they are solved in, and which move as one rigid body."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Mapping
from functools import reduce

from linkanim.mechanics.linkage import RPR, RRP, RRR, Crank, Joint, Pin, Rigid

Frame = Mapping[str, complex]
Frames = tuple[Frame, ...]

_ONE_POINT = 1e-12


def needs(joint: Joint) -> tuple[tuple[str, str], ...]:
    """Return the joints that a joint is found from, each with the key that names it."""
    match joint:
        case Crank(pivot=pivot, gear=gear):
            return (("crank", pivot), *((("gear.with", gear.driver),) if gear else ()))
        case RRR(ends=ends):
            return (("from", ends[0]), ("from", ends[1]))
        case RRP(end=end, line=line):
            return (("from", end), ("line.through", line.through))
        case RPR(pivot=pivot, through=through):
            return (("slot.pivot", pivot), ("slot.through", through))
        case Rigid(on=on):
            return (("on", on[0]), ("on", on[1]))
        case Pin():
            return ()


def fixed(joint: Joint) -> tuple[tuple[str, str], ...]:
    """Return those of a joint's `needs` that must be fixed pins."""
    held = {"crank", "line.through", "slot.pivot"}
    return tuple((key, name) for key, name in needs(joint) if key in held)


def solved_order(joints: Mapping[str, Joint]) -> tuple[Joint, ...]:
    """Return the joints so that each names only joints before it, otherwise as they stood.

    Those that depend on themselves are left out; all names must be known.
    """
    names = list(joints)
    rank = {name: i for i, name in enumerate(names)}
    waiting = {name: {other for _, other in needs(joint)} for name, joint in joints.items()}
    leads_to: dict[str, list[str]] = {name: [] for name in names}
    for name, others in waiting.items():
        for other in others:
            leads_to[other].append(name)
    ready = [rank[name] for name in names if not waiting[name]]
    order = []
    while ready:
        name = names[heapq.heappop(ready)]
        order.append(joints[name])
        for later in leads_to[name]:
            waiting[later].discard(name)
            if not waiting[later]:
                heapq.heappush(ready, rank[later])
    return tuple(order)


def circle(joints: Mapping[str, Joint], stuck: Iterable[str]) -> tuple[str, ...]:
    """Return a chain of joints that ends where it began, among the `stuck` ones (each needs a stuck one)."""
    left = set(stuck)
    name = min(left)
    path = [name]
    while True:
        name = next(other for _, other in needs(joints[name]) if other in left)
        if name in path:
            return (*path[path.index(name) :], name)
        path.append(name)


def bodies(joints: Iterable[Joint]) -> Frames:
    """Return the sets of joints that keep their distances, the ground first; joints in solved order.

    Each maps its joints to their places in the body's own frame: x along its first bar, y to the left.
    """
    return reduce(_joined, joints, ({},))


def holding(rigid: Frames, names: Iterable[str]) -> Frame | None:
    """Return the rigid body that has all these joints; None where they are on different ones."""
    wanted = set(names)
    return next((frame for frame in rigid if wanted <= frame.keys()), None)


def coincide(frame: Frame, first: str, second: str) -> bool:
    """Say whether two joints of a body are one point, so that no direction runs from one to the other."""
    size = max(abs(frame[first]), abs(frame[second]))
    return abs(frame[first] - frame[second]) <= _ONE_POINT * size


def _joined(rigid: Frames, joint: Joint) -> Frames:
    """Add one joint: to the ground, to the body that it is a point of, or as the end of new bars."""
    if isinstance(joint, Pin):
        return ({**rigid[0], joint.name: complex(*joint.position)}, *rigid[1:])
    if not isinstance(joint, Rigid):
        return (*rigid, *({end: 0j, joint.name: complex(length)} for end, length in _bars(joint)))
    frame = holding(rigid, joint.on)
    if frame is None or coincide(frame, *joint.on):
        return rigid
    start, end = (frame[name] for name in joint.on)
    place = start + complex(*joint.at) * (end - start) / abs(end - start)
    return tuple({**frame, joint.name: place} if other is frame else other for other in rigid)


def _bars(joint: Joint) -> tuple[tuple[str, float], ...]:
    """Return the bars that end in a joint: from which joint, how long."""
    match joint:
        case (
            Crank(pivot=start, length=length)
            | RPR(pivot=start, length=length)
            | RRP(end=start, length=length)
        ):
            return ((start, length),)
        case RRR(ends=ends, lengths=lengths):
            return ((ends[0], lengths[0]), (ends[1], lengths[1]))
        case _:
            return ()
