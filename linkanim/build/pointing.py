"""What lies under the pointer, and what a click or a drag there does with the tool in hand."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf
from typing import Final

from linkanim.build import gestures
from linkanim.build.building import Building, refused
from linkanim.build.chosen import choose_thing, move
from linkanim.build.draft import JOINT, Draft, Thing
from linkanim.build.order import place_of
from linkanim.build.places import foot, from_span
from linkanim.build.rounding import snapped

TOOLS: Final = ("bar", "guide", "slider", "slot", "gear", "spring", "damper", "cylinder", "move")
"""The tools, in the order of their icons."""
_TARGETS = {"slider": "on a guide", "slot": "on a bar, or on a slider"}


def under(draft: Draft, x: float, y: float, reach: float) -> Thing | None:
    """Return what lies within `reach` of a point: the nearest joint, else bar or strut, else guide."""
    point = complex(x, y)
    joints = [((JOINT, name), abs(place_of(draft, name) - point)) for name in draft.places]
    spans = [
        (thing, abs(from_span(place_of(draft, one), place_of(draft, other), point)))
        for thing, (one, other) in _spans(draft)
    ]
    guides = [(("guides", name), abs(foot(draft, name, point) - point)) for name in draft.of("guides")]
    for kind in (joints, spans, guides):
        thing, off = min(kind, key=lambda pair: pair[1], default=((JOINT, ""), inf))
        if off <= reach:
            return thing
    return None


def click(building: Building, tool: str, x: float, y: float, *, reach: float, snap: float) -> Building:
    """Return the building after a click: what is there is chosen; on paper there is a ground pin.

    With the slider as the tool, a click on a guide gives a joint that slides there.
    """
    thing = under(building.draft, x, y, reach)
    if thing is None:
        return gestures.pin(building, complex(x, y), snap=snap)
    if tool == "slider" and thing[0] == "guides":
        return gestures.slider(building, None, thing[1], complex(x, y), snap=snap)
    return choose_thing(building, *thing)


def double_click(building: Building, x: float, y: float, *, reach: float, snap: float) -> Building:
    """Return the building with a point on the body that lies there."""
    thing = under(building.draft, x, y, reach)
    if thing is None or thing[0] != "bars":
        return refused(building, "A point lies on a body: double-click on a bar")
    return gestures.point(building, thing[1], snapped(complex(x, y), snap), snap=snap)


def drag(
    building: Building, tool: str, x: float, y: float, to_x: float, to_y: float, *, reach: float, snap: float
) -> Building:
    """Return the building after a drag with a tool, from what lies at its start to what lies at its end."""
    draft, to = building.draft, complex(to_x, to_y)
    start, end = under(draft, x, y, reach), under(draft, to_x, to_y, reach)
    if tool == "move":
        chosen = choose_thing(building, *start) if start else building
        return move(chosen, to_x, to_y, snap=snap)
    if tool == "guide":
        begin = place_of(draft, start[1]) if start and start[0] == JOINT else complex(x, y)
        return gestures.guide(building, start, begin, snapped(to, snap), snap=snap)
    if tool == "bar" and start and start[0] == "bars":
        return gestures.point(building, start[1], snapped(to, snap), snap=snap)
    if start is None or start[0] != JOINT:
        return refused(building, f"Begin a {tool} at a pin or a joint; a click sets a ground pin")
    return _from_joint(building, tool, start[1], end, to, snap)


def _from_joint(
    building: Building, tool: str, start: str, end: Thing | None, at: complex, snap: float
) -> Building:
    """Return the building after a drag from a joint."""
    kind, name = end or ("", "")
    other = name if kind == JOINT else None
    if tool == "bar":
        return gestures.bar(building, start, end, at, snap=snap)
    if tool in ("spring", "damper"):
        return gestures.strut(building, tool, start, other, at, snap=snap)
    if tool == "slider" and kind == "guides":
        return gestures.slider(building, start, name, at, snap=snap)
    if tool == "slot" and end:
        return gestures.slot(building, start, end)
    if tool == "gear" and other:
        return gestures.gear(building, start, other, snap=snap)
    if tool == "cylinder" and other:
        return gestures.cylinder(building, start, other, snap=snap)
    return refused(building, f"Let the {tool} go {_TARGETS.get(tool, 'on a joint')}")


def _spans(draft: Draft) -> Iterator[tuple[Thing, tuple[str, str]]]:
    """Yield the straight edges of what lies between joints: bars, their plates, springs and dampers."""
    for name, table in draft.of("bars").items():
        yield ("bars", name), tuple(table["joints"])
    for point, table in draft.of("points").items():
        if bar := draft.bar(*table["on"]):
            yield from ((("bars", bar), (end, point)) for end in table["on"])
    for kind in ("springs", "dampers"):
        yield from (((kind, name), tuple(table["between"])) for name, table in draft.of(kind).items())
