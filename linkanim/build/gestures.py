"""What a hand draws, by name: each gesture gives another building, or the same and why it cannot be."""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from linkanim.build.building import Building, changed, refused
from linkanim.build.draft import DRIVE, JOINT, Draft, Photo, Thing
from linkanim.build.making import made
from linkanim.build.naming import body_name, joint_name, numbered, pin_name
from linkanim.build.order import line_of, place_of, plates_of
from linkanim.build.places import at_on, crank_of, foot, gear_offset, moved
from linkanim.build.rounding import round_angle, round_length, round_number, snapped

SPEED = "20 rpm"
SHARES = (0.25, 0.12, 0.06, 0.03, 0.015)
"""How far a new slider or cylinder goes to both sides, in the length of its bar or of itself."""


def pin(building: Building, at: complex, *, snap: float) -> Building:
    """Return the building with a ground pin at a point, which is snapped to multiples of `snap`."""
    draft, name = _with_pin(building.draft, at, snap)
    return changed(building, draft, (JOINT, name))


def bar(building: Building, start: str, end: Thing | None, at: complex, *, snap: float) -> Building:
    """Return the building with a bar from a joint, let go at a point.

    On another joint it is joined there; on a guide it makes a slider, on a bar a joint in its slot; on paper
    (None) a joint. The first bar from a ground pin is the crank.
    """
    draft = building.draft
    if end and end[0] == JOINT:
        name = end[1]
        if {start, name} <= draft.of("pins").keys() and start != name:
            return refused(building, f"{start} and {name} stand on the ground, and that is one body already")
        if known := draft.bar(start, name):
            return refused(building, f"Bar {known} is there already")
        if any({start, name} <= plate.keys() for plate in plates_of(draft)) and start != name:
            return refused(
                building, f"{start} and {name} are points of one body: move one to set their distance"
            )
    else:
        if end and end[0] == "bars" and start in draft.ends(end[1]):
            return refused(building, f"{start} is an end of that bar: let go beside it, or on another bar")
        draft, name = _with_joint(draft, end, at, snap)
    if place_of(draft, name) == place_of(draft, start):
        return refused(building, f"A bar needs a length: let go further from {start}")
    draft = _with_bar(draft, start, name, snap)
    return changed(building, draft, ("bars", draft.bar(start, name) or ""))


def point(building: Building, name: str, place: complex, *, snap: float) -> Building:
    """Return the building with a point on the body of a bar."""
    draft, on = building.draft, building.draft.ends(name)
    new, at = joint_name(draft, point=True), at_on(draft, on, place, snap)
    if at == [0, 0]:
        return refused(building, f"That is {on[0]} itself: a point of a body lies beside its joints")
    draft = draft.placing(new, place).having("points", new, {"on": on, "at": at})
    for body, table in draft.of("bodies").items():
        if set(on) <= set(table.get("joints", ())):
            draft = draft.having("bodies", body, {**table, "joints": [*table["joints"], new]})
    return changed(building, draft, (JOINT, new))


def guide(building: Building, start: Thing | None, begin: complex, end: complex, *, snap: float) -> Building:
    """Return the building with a line through a point: on the ground, or on the body of a joint or a bar."""
    draft, way = building.draft, end - begin
    if not way:
        return refused(building, "A guide needs a direction: drag along it")
    through, on = _carrier(draft, start)
    if on:
        axis = place_of(draft, on[1]) - place_of(draft, on[0])
        way *= axis.conjugate() / (abs(axis) or 1.0)
    elif not draft.of("pins"):
        draft, through = _with_pin(draft, begin, snap)
    through = through or min(draft.of("pins"), key=lambda pin: abs(place_of(draft, pin) - begin))
    table: dict[str, Any] = {"on": on} if on else {}
    table |= {"through": through, "angle": round_angle(way, snap)}
    direction = line_of(draft, table)[1]
    offset = ((begin - place_of(draft, through)) * direction.conjugate()).imag
    if start is None or start[0] != JOINT:
        table["offset"] = round_number(offset, snap)
    name = numbered(draft, "guides", "guide")
    return changed(building, draft.having("guides", name, table), ("guides", name))


def slider(building: Building, joint: str | None, name: str, at: complex, *, snap: float) -> Building:
    """Return the building with a joint on a guide: a new one at a point, or one that is there."""
    draft = building.draft
    if joint is None:
        draft, joint = _with_joint(draft, ("guides", name), at, snap)
    elif held := next((kind for kind in ("pins", "points", "sliders") if joint in draft.of(kind)), None):
        words = {"pins": "stands on the ground", "points": "is a point of a body"}
        return refused(building, f"{joint} {words.get(held, 'slides on a guide')} already")
    else:
        draft = moved(_with_slider(draft, joint, name), joint, place_of(draft, joint), snap)
    return changed(building, draft, (JOINT, joint))


def slot(building: Building, joint: str, end: Thing) -> Building:
    """Return the building with a joint in the slot of a bar, or of what slides on a guide: a yoke."""
    draft, (kind, name) = building.draft, end
    if kind == "bars":
        if joint in draft.ends(name):
            return refused(building, f"{joint} is an end of that bar, and cannot slide in it")
        return changed(building, _with_slot(draft, name, joint), (JOINT, joint))
    if kind != JOINT or name not in draft.of("sliders") or name == joint:
        return refused(building, "A slot is in a bar, or in a slider that has none: let go on one")
    return changed(building, draft.having("yokes", name, {"pin": joint, "slot": "90 deg"}), (JOINT, name))


def gear(building: Building, joint: str, mate: str, *, snap: float) -> Building:
    """Return the building with a crank geared to another one, as fast and the other way round."""
    draft = building.draft
    others = [end for _, end, _ in draft.bars_at(joint)]
    if joint == mate or not others or joint in draft.of("pins") or not crank_of(draft, mate):
        return refused(building, "A gear pair joins two cranks: drag from one's pin to the other's")
    if joint == draft.driven:
        return refused(building, f"{joint} is driven: let the other crank follow it")
    table = {"with": mate, "ratio": -1, "offset": "0 deg"}
    draft = draft.having("gears", joint, table)
    table["offset"] = gear_offset(draft, joint, table, snap)
    return changed(building, draft.having("gears", joint, table), (JOINT, joint))


def strut(
    building: Building, kind: str, start: str, end: str | None, at: complex, *, snap: float
) -> Building:
    """Return the building with a spring or a damper between joints; on paper it ends on a new ground pin."""
    draft = building.draft
    if end is None:
        draft, end = _with_pin(draft, at, snap)
    if start == end:
        return refused(building, f"A {kind} has two ends: let go further from {start}")
    kinds = f"{kind}s"
    name = numbered(draft, kinds, kind)
    return changed(building, draft.having(kinds, name, {"between": [start, end]}), (kinds, name))


def cylinder(building: Building, start: str, end: str, *, snap: float) -> Building:
    """Return the building with a cylinder as the drive, from a ground pin to a body on another."""
    draft = building.draft
    fixed, moving = (start, end) if start in draft.of("pins") else (end, start)
    crank = _turning_with(draft, moving)
    if fixed not in draft.of("pins") or crank is None or crank[0] == fixed:
        return refused(building, "A cylinder drives a body that turns about a ground pin, from another pin")
    length = abs(place_of(draft, moving) - place_of(draft, fixed))
    own = crank_drive(draft, *crank, snap)
    drives = []
    for part in SHARES:
        limits = [round_length(length * (1 + sign * part), snap) for sign in (-1, 1)]
        table = {"between": [fixed, moving], "from": limits[0], "to": limits[1], "joint": own["joint"]}
        drives.append({"speed": own["speed"], "start": own["start"], "cylinder": table})
    return driven(building, draft, drives, DRIVE, f"The cylinder drives {crank[1]}")


def driven(
    building: Building, draft: Draft, drives: Sequence[Mapping[str, Any]], chosen: Thing | None, sentence: str
) -> Building:
    """Return the building with the first of some drives with which the draft moves, or with the first."""
    drafts = [draft.having(*DRIVE, table) for table in drives]
    found = next((one for one in drafts if not drafts[1:] or made(one).scene), drafts[0])
    return changed(building, found, chosen, sentence)


def lay_photo(building: Building, file: str, x: float, y: float, width: float) -> Building:
    """Return the building with a photograph behind it, its lower left corner at a point; "" takes it away."""
    return _photographed(building, Photo(file, (x, y), width) if file else None)


def move_photo(building: Building, x: float, y: float, to_x: float, to_y: float) -> Building:
    """Return the building with its photograph moved as from one point to another."""
    return _fitted(building, 1 + 0j, complex(to_x - x, to_y - y))


def fit_photo(building: Building, *points: float) -> Building:
    """Return the building with its photograph scaled and turned, so that two points of it come to two others.

    `points` are x and y of the first where it lies now and of where it belongs, then of the second likewise.
    """
    one, there, other, beyond = (complex(*points[n : n + 2]) for n in (0, 2, 4, 6))
    if one == other or there == beyond:
        return refused(building, "Two points fit a photograph: take them apart from each other")
    scale = (beyond - there) / (other - one)
    return _fitted(building, scale, there - scale * one)


def _fitted(building: Building, scale: complex, shift: complex) -> Building:
    """Return the building with its photograph's places z, as x + yi, brought to scale·z + shift."""
    photo = building.draft.photo
    if photo is None:
        return refused(building, "There is no photograph: drop one on the window")
    place = scale * complex(*photo.place) + shift
    turn = phase(scale * rect(1.0, photo.turn))
    return _photographed(
        building, Photo(photo.file, (place.real, place.imag), photo.width * abs(scale), turn)
    )


def _photographed(building: Building, photo: Photo | None) -> Building:
    return changed(building, replace(building.draft, photo=photo), building.chosen)


def crank_drive(draft: Draft, pivot: str, joint: str, snap: float) -> dict[str, Any]:
    """Return the drive of a crank that starts where it is drawn."""
    way = place_of(draft, joint) - place_of(draft, pivot)
    return {"joint": joint, "speed": draft.drive.get("speed", SPEED), "start": round_angle(way, snap)}


def _turning_with(draft: Draft, joint: str) -> tuple[str, str] | None:
    """Return the ground pin and the joint of the bar that carries a joint about that pin."""
    on = draft.of("points").get(joint, {}).get("on")
    for end in [joint] if on is None else on:
        pivot = crank_of(draft, end)
        if pivot and (on is None or pivot in on):
            return pivot, end
    return None


def _carrier(draft: Draft, start: Thing | None) -> tuple[str | None, list[str]]:
    """Return what a guide that begins on a thing runs through, and the axis of the body that carries it."""
    if start and start[0] == JOINT:
        if start[1] in draft.of("pins"):
            return start[1], []
        name = next((name for name, _, _ in draft.bars_at(start[1])), None)
        point = draft.of("points").get(start[1])
        on = point["on"] if point else draft.ends(name) if name else []
        return start[1], list(on)
    if start and start[0] == "bars":
        on = draft.ends(start[1])
        return on[0], on
    return None, []


def _with_pin(draft: Draft, at: complex, snap: float) -> tuple[Draft, str]:
    name, place = pin_name(draft), snapped(at, snap)
    written = [round_number(part, 0.0) for part in (place.real, place.imag)]
    return draft.placing(name, place).having("pins", name, written), name


def _with_joint(draft: Draft, end: Thing | None, at: complex, snap: float) -> tuple[Draft, str]:
    """Return the draft with a new joint at a point: on paper, on a guide, or in the slot of a bar."""
    name, place = joint_name(draft), snapped(at, snap)
    if end and end[0] == "guides":
        place = foot(draft, end[1], place)
    draft = draft.placing(name, place)
    if end and end[0] == "guides":
        draft = _with_slider(draft, name, end[1])
    return (_with_slot(draft, end[1], name) if end and end[0] == "bars" else draft), name


def _with_bar(draft: Draft, start: str, end: str, snap: float) -> Draft:
    """Return the draft with a bar, from its ground pin if any, its body, and the first one's drive."""
    if end in draft.of("pins"):
        start, end = end, start
    way = place_of(draft, end) - place_of(draft, start)
    draft = draft.with_bar(start, end, round_length(abs(way), snap))
    draft = draft.having("bodies", body_name(draft), {"joints": [start, end]})
    if draft.drive or start not in draft.of("pins"):
        return draft
    return draft.having(*DRIVE, crank_drive(draft, start, end, snap))


def _with_slider(draft: Draft, joint: str, name: str) -> Draft:
    draft = draft.having("sliders", joint, {"guide": name})
    return draft.having("bodies", body_name(draft), {"slider": joint})


def _with_slot(draft: Draft, name: str, joint: str) -> Draft:
    return draft.having("slots", f"{joint} in {name}", {"bar": name, "through": joint})
