"""The order in which the joints of a scene are solved, and the circles that keep some from being solved."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Mapping

from linkanim.mechanics.linkage.joint import Joint


def solved_order(joints: Mapping[str, Joint]) -> tuple[Joint, ...]:
    """Return the joints so that each names only joints before it, otherwise as they stood.

    Those that depend on themselves are left out; all names must be known.
    """
    names = list(joints)
    rank = {name: i for i, name in enumerate(names)}
    waiting = {name: {need.joint for need in joint.needs} for name, joint in joints.items()}
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
        name = next(need.joint for need in joints[name].needs if need.joint in left)
        if name in path:
            return (*path[path.index(name) :], name)
        path.append(name)
