"""What a hand does to a drawing, by name: each gesture gives another building, or says why it cannot be."""

from __future__ import annotations

from typing import Any

from linkanim.build.building import Building, changed, refused
from linkanim.build.draft import DRIVE, JOINT, Draft, Thing
from linkanim.build.naming import body_name, joint_name, pin_name
from linkanim.build.order import line_of, place_of
from linkanim.build.rounding import round_angle, round_length, round_number, snapped

_SPEED = "20 rpm"


def pin(building: Building, x: float, y: float, *, snap: float) -> Building:
    """Return the building with a ground pin at a point, which is snapped to multiples of `snap`."""
    draft, name = _with_pin(building.draft, x, y, snap)
    return changed(building, draft, (JOINT, name))


def bar(building: Building, start: str, end: Thing | None, x: float, y: float, *, snap: float) -> Building:
    """Return the building with a bar from a joint, let go at a point.

    On another joint it is joined there; on a guide it makes a slider, on a bar a joint in its slot; on paper
    (None) a joint. The first bar from a ground pin is the crank.
    """
    if end and end[0] == JOINT:
        return _joined(building, start, end[1], snap)
    draft, name = _with_joint(building.draft, end, x, y, snap)
    if place_of(draft, name) == place_of(draft, start):
        return refused(building, f"The bar has no length: let go further from {start}")
    draft = _with_bar(draft, start, name, snap)
    return changed(building, draft, ("bars", draft.bar(start, name) or ""))


def drive(building: Building) -> Building:
    """Return the building with the chosen crank as the drive: its bar, or its pin."""
    draft = building.draft
    crank = _crank(draft, building.chosen)
    if crank is None:
        return refused(building, "Choose a crank first: a bar on a ground pin")
    draft = draft.having(*DRIVE, _crank_drive(draft, *crank, 0.0))
    return changed(building, draft, building.chosen, f"{crank[1]} is driven")


def _crank(draft: Draft, thing: Thing | None) -> tuple[str, str] | None:
    """Return the ground pin and the joint of the crank that a thing is; None where it is none."""
    pins = draft.of("pins")
    if thing and thing[0] == "bars":
        one, other = draft.of("bars")[thing[1]]["joints"]
        return (one, other) if one in pins else (other, one) if other in pins else None
    if thing and thing[0] == JOINT:
        return next(((end, thing[1]) for _, end, _ in draft.bars_at(thing[1]) if end in pins), None)
    return None


def _joined(building: Building, start: str, end: str, snap: float) -> Building:
    """Return the building with a bar between two joints."""
    draft = building.draft
    if start == end:
        return refused(building, f"The bar has no length: let go further from {start}")
    if {start, end} <= draft.of("pins").keys():
        return refused(building, f"{start} and {end} both stand on the ground, which is one body already")
    if name := draft.bar(start, end):
        return refused(building, f"{name} is a bar already")
    draft = _with_bar(draft, start, end, snap)
    return changed(building, draft, ("bars", draft.bar(start, end) or ""))


def _with_pin(draft: Draft, x: float, y: float, snap: float) -> tuple[Draft, str]:
    name, place = pin_name(draft), snapped(x, y, snap)
    written = [round_number(part, 0.0) for part in place]
    return draft.placing(name, place).having("pins", name, written), name


def _with_joint(draft: Draft, end: Thing | None, x: float, y: float, snap: float) -> tuple[Draft, str]:
    """Return the draft with a new joint at a point: on paper, on a guide, or in the slot of a bar."""
    name, place = joint_name(draft), complex(*snapped(x, y, snap))
    if end and end[0] == "guides":
        start, way = line_of(draft, draft.of("guides")[end[1]])
        place = start + way * ((place - start) * way.conjugate()).real
    draft = draft.placing(name, (place.real, place.imag))
    if end and end[0] == "guides":
        draft = draft.having("sliders", name, {"guide": end[1]})
        draft = draft.having("bodies", body_name(draft), {"slider": name})
    if end and end[0] == "bars":
        draft = draft.having("slots", f"{name} in {end[1]}", {"bar": end[1], "through": name})
    return draft, name


def _with_bar(draft: Draft, start: str, end: str, snap: float) -> Draft:
    """Return the draft with a bar between two joints, its body, and the drive where it is the first crank."""
    way = place_of(draft, end) - place_of(draft, start)
    name = f"{start}–{end}"
    draft = draft.having("bars", name, {"joints": [start, end], "length": round_length(abs(way), snap)})
    draft = draft.having("bodies", body_name(draft), {"joints": [start, end]})
    crank = _crank(draft, ("bars", name))
    return draft.having(*DRIVE, _crank_drive(draft, *crank, snap)) if crank and not draft.drive else draft


def _crank_drive(draft: Draft, pivot: str, joint: str, snap: float) -> dict[str, Any]:
    way = place_of(draft, joint) - place_of(draft, pivot)
    return {"joint": joint, "speed": draft.drive.get("speed", _SPEED), "start": round_angle(way, snap)}
