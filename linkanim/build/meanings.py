"""What a drag can mean: by the tool, and by what is at its start and at its end, in either order.

A drag with one meaning is carried out. Of several meanings the first is carried out, and the others are
offered.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from linkanim.build.building import Building, grown, refused
from linkanim.build.draft import JOINT, Draft, Thing
from linkanim.build.gestures import (
    bar,
    choose_thing,
    cylinder,
    gear,
    guide,
    move,
    on_body,
    pin,
    point,
    slider,
    slot,
    strut,
    under,
)
from linkanim.build.places import crank_of, from_span, place_of, snapped
from linkanim.words import said

_STUB = 0.5
"""A bar from a crank's pin onto a lever is a slot where it is shorter than this share of the crank."""
_BEYOND = 1.1
"""The length of a lever that was drawn to a crank's pin, in greatest distances of that pin."""


class Meaning(NamedTuple):
    """One meaning of a drag, in words, and the building after it."""

    words: str
    building: Building


class Drag(NamedTuple):
    """A drag with a tool from one place to another, and what is at both."""

    tool: str
    start: Thing | None
    end: Thing | None
    begin: complex
    to: complex
    reach: float
    snap: float


def drag(
    building: Building, tool: str, x: float, y: float, to_x: float, to_y: float, *, reach: float, snap: float
) -> Building:
    """Return the building after a drag with a tool, by what is at its start and at its end."""
    return meanings(building, tool, x, y, to_x, to_y, reach=reach, snap=snap)[0].building


def meanings(
    building: Building, tool: str, x: float, y: float, to_x: float, to_y: float, *, reach: float, snap: float
) -> tuple[Meaning, ...]:
    """Return the meanings of a drag with a tool, the likeliest first; without any, one that says why."""
    start = under(building.draft, x, y, reach)
    end = _let_go_on(building.draft, start, to_x, to_y, reach)
    made = Drag(tool, start, end, complex(x, y), complex(to_x, to_y), reach, snap)
    readings = list(_READ.get(tool, _one)(building, made))
    several: list[Meaning] = []
    for one in readings:
        known = [building.draft, *(other.building.draft for other in several)]
        several += [one] if one.building.draft not in known else []
    return tuple(several or readings[:1])


def _let_go_on(draft: Draft, start: Thing | None, x: float, y: float, reach: float) -> Thing | None:
    """Return what is where a drag ends; a bar that ends in its own joint only where there is nothing else."""
    end = under(draft, x, y, reach)
    if start and start[0] == JOINT and end and end[0] == "bars" and start[1] in draft.ends(end[1]):
        beside = under(draft.having("bars", end[1], None), x, y, reach)
        return beside if beside and beside[0] == "bars" else end
    return end


def _one(building: Building, drag: Drag) -> Iterator[Meaning]:
    """Yield the one meaning of a drag, which it has with most tools."""
    start, end, snap = drag.start, drag.end, drag.snap
    to = snapped(drag.to, snap)
    if drag.tool == "move":
        chosen = choose_thing(building, *start) if start else building
        yield Meaning(said("move"), move(chosen, drag.to.real, drag.to.imag, snap=snap))
    elif drag.tool == "guide":
        begin = place_of(building.draft, start[1]) if start and start[0] == JOINT else drag.begin
        yield Meaning(said("line"), guide(building, start, begin, to, snap=snap))
    elif start is None or start[0] != JOINT:
        yield Meaning(
            "",
            refused(
                building,
                said("Begin a {tool} at a pin or a joint; a click sets a ground pin", tool=said(drag.tool)),
            ),
        )
    elif drag.tool == "slider" and end and end[0] == "guides":
        yield Meaning(said("slider"), slider(building, start[1], end[1], drag.to, snap=snap))
    else:
        yield Meaning("", refused(building, _target(drag.tool)))


def _target(tool: str) -> str:
    """Say where the hand has to let go."""
    if tool == "slider":
        return said("Let the slider go on a guide")
    if tool == "slot":
        return said("Let the slot go on a bar, or on a slider")
    return said("Let the {tool} go on a joint", tool=said(tool))


def _bars(building: Building, drag: Drag) -> Iterator[Meaning]:
    """Yield the meanings of a drag with the bar; from a crank's pin onto a lever it may be a slot.

    On the side of a plate, which has no slot, the bar is pinned.
    """
    draft, start, end, snap = building.draft, drag.start, drag.end, drag.snap
    if start and start[0] == "bars":
        yield Meaning(said("point"), point(building, start[1], snapped(drag.to, snap), snap=snap))
        return
    if start is None or start[0] != JOINT:
        yield from _one(building, drag)
        return
    rod = Meaning(said("bar with a pin in the slot"), bar(building, start[1], end, drag.to, snap=snap))
    if end is None or end[0] != "bars":
        yield rod
        return
    joint, lever = start[1], end[1]
    crank = crank_of(draft, joint)
    slides = crank is not None and joint not in draft.ends(lever) and _is_lever(draft, lever)
    slotted = (
        Meaning(said("{joint} slides in the bar", joint=joint), slot(building, joint, end))
        if slides
        else None
    )
    away = abs(place_of(draft, joint) - drag.to)
    is_stub = crank is not None and away < _STUB * abs(place_of(draft, joint) - place_of(draft, crank))
    if slotted and is_stub:
        yield slotted
    one, other = (place_of(draft, name) for name in draft.ends(lever))
    on_side = abs(from_span(one, other, drag.to)) > drag.reach
    if not on_side:
        yield rod
    if on_side or joint not in draft.ends(lever):
        pinned, name = _with_point(building, lever, drag.to, snap)
        made = bar(pinned, joint, (JOINT, name), drag.to, snap=snap) if name else pinned
        if made.draft is not pinned.draft:
            words = said("bar pinned to the plate") if on_side else said("bar pinned to the bar")
            yield Meaning(words, _as_one(building, made))
        elif on_side:
            yield Meaning("", refused(building, made.sentence))
    if slotted and not is_stub:
        yield slotted


def _slots(building: Building, drag: Drag) -> Iterator[Meaning]:
    """Yield the meanings of a drag with the slot: a joint and a bar, either first; a lever over a joint."""
    draft, start, end = building.draft, drag.start, drag.end
    if start and end and start[0] == "bars" and end[0] == JOINT:
        start, end = end, start
    if start is None or start[0] != JOINT:
        yield from _one(building, drag)
        return
    pivot, over = start[1], _passed(draft, drag) if end is None else end[1] if end[0] == JOINT else None
    if end and end[0] == JOINT and start[1] not in draft.of("pins") and end[1] in draft.of("pins"):
        pivot, over = end[1], start[1]
    if over and pivot in draft.of("pins") and over not in (*draft.of("pins"), *draft.of("sliders")):
        yield from _levers(building, drag, pivot, over)
        return
    if end is None:
        yield from _one(building, drag)
        return
    yield Meaning(said("slot"), slot(building, start[1], end))


def _levers(building: Building, drag: Drag, pivot: str, over: str) -> Iterator[Meaning]:
    """Yield a joint in the slot of a lever about a pivot: of each lever that is there, else of a new one."""
    draft = building.draft
    known = [name for name, end, _ in draft.bars_at(pivot) if end != over and _is_lever(draft, name)]
    for name in known:
        yield Meaning(
            said("{over} slides in {name}", over=over, name=name), slot(building, over, (said("bars"), name))
        )
    if known:
        return
    if draft.bar(pivot, over):
        yield Meaning(
            "", refused(building, said("{over} is an end of that bar, and cannot slide in it", over=over))
        )
        return
    at, on = place_of(draft, pivot), place_of(draft, over)
    span = on - at
    if abs(drag.to - on) <= drag.reach or abs(drag.to - at) <= drag.reach:
        crank = crank_of(draft, over)
        centre = place_of(draft, crank) if crank else at
        farthest = abs(centre - at) + abs(on - centre)
        end = at + span / (abs(span) or 1.0) * _BEYOND * farthest
    else:
        end = drag.to
    lever = bar(building, pivot, None, snapped(end, drag.snap), snap=drag.snap)
    if lever.draft is draft or lever.chosen is None:
        yield Meaning("", lever)
        return
    yield Meaning(
        said("{over} slides in a new lever", over=over), _as_one(building, slot(lever, over, lever.chosen))
    )


def _gears(building: Building, drag: Drag) -> Iterator[Meaning]:
    """Yield the gear pairs between the things at both ends: bars, ground pins or crank pins.

    The driven crank leads; of two cranks that are not driven, the one at the start follows the other.
    """
    draft = building.draft
    ones, others = ([*_cranks(draft, thing)] for thing in (drag.start, drag.end))
    if drag.start is None or not (ones and others):
        yield Meaning("", refused(building, said("A gear pair joins two cranks: drag from one to the other")))
    for one in ones:
        for mate in others:
            leads = one == draft.driven or (mate in draft.of("gears") and one not in draft.of("gears"))
            first, second = (mate, one) if leads and mate != draft.driven else (one, mate)
            yield Meaning(
                said("{first} follows {second}", first=first, second=second),
                gear(building, first, second, snap=drag.snap),
            )


def _cranks(draft: Draft, thing: Thing | None) -> Iterator[str]:
    """Yield the pins of the cranks that a thing is or carries."""
    kind, name = thing or ("", "")
    ends = draft.ends(name) if kind == "bars" else [name] if kind == JOINT else []
    for end in ends:
        if end not in draft.of("pins") and (kind == JOINT or crank_of(draft, end) in ends):
            yield end
    if kind == JOINT and name in draft.of("pins"):
        yield from (end for _, end, _ in draft.bars_at(name) if end not in draft.of("pins"))


def _struts(building: Building, drag: Drag) -> Iterator[Meaning]:
    """Yield a spring, a damper or a cylinder between both ends; on a bar a point is made, on paper a pin."""
    now, joints = building, list[str]()
    for thing, at in ((drag.start, drag.begin), (drag.end, drag.to)):
        after, name = now, thing[1] if thing and thing[0] == JOINT else ""
        if thing and thing[0] == "bars":
            after, name = _with_point(now, thing[1], at, drag.snap)
        elif thing is None or thing[0] != JOINT:
            after = pin(now, at, snap=drag.snap)
            name = after.chosen[1] if after.chosen else ""
        if not name:
            wrong = said("Let the {tool} go on a pin, a joint or a bar", tool=said(drag.tool))
            yield Meaning(
                "",
                refused(building, after.sentence if after.draft is now.draft and after.sentence else wrong),
            )
            return
        now, joints = after, [*joints, name]
    one, other = joints
    if drag.tool == "cylinder":
        made = cylinder(now, one, other, snap=drag.snap)
    else:
        made = strut(now, drag.tool, one, other, drag.to, snap=drag.snap)
    yield Meaning(
        drag.tool,
        _as_one(building, made) if made.draft is not now.draft else refused(building, made.sentence),
    )


_READ = {
    "bar": _bars,
    "slot": _slots,
    "gear": _gears,
    "spring": _struts,
    "damper": _struts,
    "cylinder": _struts,
}


def _with_point(building: Building, lever: str, at: complex, snap: float) -> tuple[Building, str]:
    """Return the building with a point on a bar, or on a plate's side, and its name; "" without one."""
    after = point(building, lever, on_body(building.draft, lever, at), snap=snap)
    return after, after.chosen[1] if after.draft is not building.draft and after.chosen else ""


def _as_one(building: Building, after: Building) -> Building:
    """Return a building after several changes as after a single one, so that undo takes back all of them."""
    if after.draft is building.draft:
        return after
    return replace(after, past=grown(building), future=())


def _is_lever(draft: Draft, name: str) -> bool:
    """Return whether a bar turns about a ground pin, or could."""
    return any(end in draft.of("pins") for end in draft.ends(name))


def _passed(draft: Draft, drag: Drag) -> str | None:
    """Return the joint that a drag passes over, the nearest to its line; None where there is none."""
    away = {
        name: abs(from_span(drag.begin, drag.to, place_of(draft, name)))
        for name in draft.places
        if name not in draft.of("pins") and drag.start != (JOINT, name)
    }
    near = min(away, key=lambda name: away[name], default=None)
    return near if near is not None and away[near] <= drag.reach else None
