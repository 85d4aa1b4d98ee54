"""What is done to the chosen thing: it is moved, driven, traced, removed; and the next one is chosen."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import floor, log10
from typing import Any

from linkanim.build.building import Building, changed, choosing, refused
from linkanim.build.draft import DRIVE, JOINT, Draft, Thing, named_in
from linkanim.build.gestures import SHARES, SPEED, crank_drive, driven
from linkanim.build.order import line_of, place_of
from linkanim.build.places import crank_of, fitted, moved, with_number
from linkanim.build.rounding import round_number, snapped

OWN = ("pins", "points", "sliders", "yokes", "gears", "sides")
"""The kinds of tables whose names are those of joints."""
_HELD = ("pins", "points", "sliders")
_WORDS = {JOINT: "joint", "drive": "drive"}


def choose(building: Building, further: int) -> Building:
    """Return the building with the next thing chosen, or one so many further: joints, bars, guides, ..."""
    things = list(building.draft.things())
    if not things:
        return refused(building, "Nothing is drawn yet: a click sets a ground pin")
    now = things.index(building.chosen) if building.chosen in things else -1 if further > 0 else 0
    return choosing(building, things[(now + further) % len(things)])


def choose_thing(building: Building, kind: str, name: str) -> Building:
    """Return the building with a thing chosen; with nothing where there is none of that name."""
    thing = (kind, name)
    return choosing(building, thing if thing in set(building.draft.things()) else None)


def move(building: Building, x: float, y: float, *, snap: float) -> Building:
    """Return the building with what is chosen at a point: a joint, or a guide that then runs through it.

    Numbers follow, but for typed ones.
    """
    draft, thing = building.draft, building.chosen
    place = snapped(complex(x, y), snap)
    if thing and thing[0] == JOINT:
        scene = building.made.scene
        phase = draft.phase if scene is None or scene.info.full_turn else None
        return changed(building, moved(draft, thing[1], place, snap, phase), thing)
    if thing and thing[0] == "guides" and (*thing, "offset") not in draft.typed:
        table = {**draft.of("guides")[thing[1]], "offset": 0}
        start, way = line_of(draft, table)
        offset = round_number(((place - start) * way.conjugate()).imag, snap)
        return changed(building, fitted(with_number(draft, (*thing, "offset"), offset)), thing)
    return refused(building, "Choose a joint or a guide to move it")


def trace(building: Building) -> Building:
    """Return the building with the curve of the chosen joint drawn, or no longer."""
    draft, thing = building.draft, building.chosen
    if not thing or thing[0] != JOINT:
        return refused(building, "Choose a joint to draw its curve")
    left = [name for name in draft.trace if name != thing[1]]
    joints = left if thing[1] in draft.trace else [*left, thing[1]]
    return changed(building, replace(draft, rest={**draft.rest, "trace": {"joints": joints}}), thing)


def drive(building: Building) -> Building:
    """Return the building with the chosen thing as the drive: a crank, its bar, or a slider."""
    draft = building.draft
    joint = _drivable(draft, building.chosen)
    if joint is None:
        return refused(building, "Choose a crank (a bar on a ground pin) or a slider to drive it")
    draft = draft.having("gears", joint, None)
    if joint in draft.of("sliders"):
        tables = _slider_drives(draft, joint)
    else:
        pivot = str(crank_of(draft, joint))
        tables = [
            crank_drive(draft, pivot, joint, abs(place_of(draft, joint) - place_of(draft, pivot)) / 100)
        ]
    return driven(building, draft, tables, building.chosen, f"{joint} is driven")


def delete(building: Building) -> Building:
    """Return the building without the chosen thing, and without what hangs on it alone."""
    draft, thing = building.draft, building.chosen
    if thing is None:
        return refused(building, "Choose what is to be removed")
    left = _without(draft, thing)
    kept = {*left.things(), thing, DRIVE}
    gone = (one for one in draft.things() if one not in kept)
    first, *others = (f"{_WORDS.get(kind, kind[:-1])} {name}" for kind, name in (thing, *gone))
    with_it = f", with {', '.join(others)}" if others else ""
    return changed(building, left, None, f"Removed {first}{with_it}")


def _drivable(draft: Draft, thing: Thing | None) -> str | None:
    """Return the joint that is driven where a thing is: the moving end of a crank, or a slider."""
    pins = draft.of("pins")
    if thing and thing[0] == "bars":
        first, second = draft.ends(thing[1])
        return second if first in pins else first if second in pins else None
    if thing and thing[0] == JOINT and thing[1] not in pins:
        is_crank = any(end in pins for _, end, _ in draft.bars_at(thing[1]))
        return thing[1] if is_crank or thing[1] in draft.of("sliders") else None
    return None


def _slider_drives(draft: Draft, joint: str) -> list[dict[str, Any]]:
    """Return drives of a slider that goes to both sides by a share of its longest bar."""
    guide = draft.of("guides")[draft.of("sliders")[joint]["guide"]]
    start, way = line_of(draft, {**guide, "offset": 0})
    travel = ((place_of(draft, joint) - start) * way.conjugate()).real
    bars = [abs(place_of(draft, end) - place_of(draft, joint)) for _, end, _ in draft.bars_at(joint)]
    longest = max(bars, default=0.0) or abs(travel) or 100.0
    drives = []
    for part in SHARES:
        reach, step = longest * part, 10.0 ** floor(log10(longest * part) - 1)
        limits = {"from": round_number(travel - reach, step), "to": round_number(travel + reach, step)}
        drives.append({"speed": draft.drive.get("speed", SPEED), "slider": {"joint": joint, **limits}})
    return drives


def _without(draft: Draft, thing: Thing) -> Draft:
    """Return the draft without a thing, what names it, and joints that nothing holds any longer."""
    gone = {thing}
    while more := {*_hanging(draft, gone), *_loose(draft, gone)} - gone:
        gone |= more
    joints = {name for kind, name in gone if kind == JOINT}
    tables = {
        kind: {name: table for name, table in every.items() if (kind, name) not in gone}
        for kind, every in draft.tables.items()
    }
    bodies = {name: _shorter(table, joints) for name, table in tables.get("bodies", {}).items()}
    tables["bodies"] = {name: table for name, table in bodies.items() if len(table.get("joints", "  ")) > 1}
    places = {name: place for name, place in draft.places.items() if name not in joints}
    trace = {"joints": [name for name in draft.trace if name not in joints]}
    typed = frozenset(key for key in draft.typed if str(key[1]) in tables.get(str(key[0]), {}))
    rest = {**draft.rest, "trace": trace} if draft.trace else draft.rest
    return replace(draft, places=places, tables=tables, typed=typed, rest=rest)


def _shorter(body: Mapping[str, Any], gone: set[str]) -> Mapping[str, Any]:
    kept = [joint for joint in body.get("joints", ()) if joint not in gone]
    return {**body, "joints": kept} if "joints" in body else body


def _hanging(draft: Draft, gone: set[Thing]) -> Iterator[Thing]:
    """Yield the tables that say nothing without things that are gone; the drive where its crank is."""
    bars = draft.of("bars")
    axes = [set(bars[name]["joints"]) for kind, name in gone if kind == "bars"]
    for kind, every in draft.tables.items():
        for name, table in every.items():
            own = {(JOINT, name)} if kind in OWN else set()
            if kind == "bodies":
                lost = ("sliders", table.get("slider")) in gone or any(
                    axis <= set(table.get("joints", ())) for axis in axes
                )
            else:
                axis = set(table.get("on", ())) if isinstance(table, Mapping) else set()
                lost = bool(gone & {*named_in(table), *own}) or axis in axes
            if lost:
                yield kind, name
    bars_left = [end for name, end, _ in draft.bars_at(draft.driven or "") if ("bars", name) not in gone]
    if draft.driven and "slider" not in draft.drive and not draft.of("pins").keys() & set(bars_left):
        yield DRIVE


def _loose(draft: Draft, gone: set[Thing]) -> Iterator[Thing]:
    """Yield the joints that nothing holds: no pin, no point of a body, no slider, without a bar."""
    for joint in draft.places:
        held = any(joint in draft.of(kind) and (kind, joint) not in gone for kind in _HELD)
        if not held and all(("bars", name) in gone for name, _, _ in draft.bars_at(joint)):
            yield JOINT, joint
