"""What lies under the pointer, and what a click or a drag there does with the tool in hand."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import Final

from linkanim.build import gestures
from linkanim.build.building import Building, refused
from linkanim.build.draft import JOINT, Draft, Thing
from linkanim.build.order import line_of, place_of

TOOLS: Final = ("bar", "guide", "slider", "slot", "gear", "spring", "damper", "cylinder", "move")
"""The tools, in the order of their icons."""


def under(draft: Draft, x: float, y: float, reach: float) -> Thing | None:
    """Return what lies within `reach` of a point: the nearest joint, else the nearest bar, else guide."""
    point = complex(x, y)
    joints = [((JOINT, name), abs(place_of(draft, name) - point)) for name in draft.places]
    bars = [(("bars", name), _from_bar(draft, name, point)) for name in draft.of("bars")]
    guides = [(("guides", name), _from_guide(draft, name, point)) for name in draft.of("guides")]
    for kind in (joints, bars, guides):
        thing, off = min(kind, key=lambda pair: pair[1], default=(None, inf))
        if off <= reach:
            return thing
    return None


def click(building: Building, tool: str, x: float, y: float, *, reach: float, snap: float) -> Building:
    """Return the building after a click with a tool: a ground pin on paper, else what is there is chosen."""
    thing = under(building.draft, x, y, reach)
    if thing is None:
        return gestures.pin(building, x, y, snap=snap)
    return replace(building, chosen=thing, row=0, typed="", sentence="")


def drag(
    building: Building, tool: str, x: float, y: float, to_x: float, to_y: float, *, reach: float, snap: float
) -> Building:
    """Return the building after a drag with a tool: a bar from a pin or a joint."""
    start, end = under(building.draft, x, y, reach), under(building.draft, to_x, to_y, reach)
    if start is None or start[0] != JOINT:
        return refused(building, "Begin a bar at a pin or a joint; a click sets a ground pin")
    return gestures.bar(building, start[1], end, to_x, to_y, snap=snap)


def _from_bar(draft: Draft, name: str, point: complex) -> float:
    """Return how far a point is from a bar."""
    start, end = (place_of(draft, joint) for joint in draft.of("bars")[name]["joints"])
    way = end - start
    share = ((point - start) * way.conjugate()).real / (abs(way) ** 2 or 1.0)
    return abs(point - start - way * min(max(share, 0.0), 1.0))


def _from_guide(draft: Draft, name: str, point: complex) -> float:
    start, way = line_of(draft, draft.of("guides")[name])
    return abs(((point - start) * way.conjugate()).imag)
