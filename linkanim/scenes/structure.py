"""How the joints of a scene hang together: the order they are solved in, and which move as one rigid body."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Iterator, Mapping
from functools import reduce

from linkanim.mechanics.linkage import RPR, RRP, RRR, Crank, Joint, Pin, Rigid

Clusters = tuple[frozenset[str], ...]


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


def clusters(joints: Iterable[Joint]) -> Clusters:
    """Return the sets of joints that keep their distances, the ground first; joints in solved order."""
    return reduce(_joined, joints, (frozenset(),))


def together(rigid: Clusters, names: Iterable[str]) -> bool:
    """Say whether all the joints belong to one rigid body."""
    wanted = frozenset(names)
    return any(wanted <= cluster for cluster in rigid)


def _joined(rigid: Clusters, joint: Joint) -> Clusters:
    """Add one joint: to the ground, to the body that holds both its ends, or as bars of its own."""
    if isinstance(joint, Pin):
        return (rigid[0] | {joint.name}, *rigid[1:])
    bars = tuple(_bars(joint))
    ends = {end for bar in bars for end in bar if end != joint.name}
    for i, cluster in enumerate(rigid):
        if len(ends) == 2 and ends <= cluster:
            return (*rigid[:i], cluster | {joint.name}, *rigid[i + 1 :])
    return (*rigid, *(frozenset(bar) for bar in bars))


def _bars(joint: Joint) -> Iterator[tuple[str, str]]:
    match joint:
        case Crank(pivot=pivot) | RPR(pivot=pivot):
            yield pivot, joint.name
        case RRP(end=end):
            yield end, joint.name
        case RRR(ends=(first, second)) | Rigid(on=(first, second)):
            yield first, joint.name
            yield second, joint.name
