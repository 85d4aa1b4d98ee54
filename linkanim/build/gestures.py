"""The gestures of a hand on the sheet; each returns another building, or the same one and why.

First what a hand draws, by name; then what is done to the chosen thing; last what a click or a drag does at a
place, by what is under the pointer and the tool in hand.
"""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from math import floor, inf, log10
from typing import Any, Final

from linkanim.build.building import Building, changed, choosing, refused
from linkanim.build.draft import (
    DRIVE,
    JOINT,
    OWN,
    Draft,
    Photo,
    Thing,
    body_name,
    joint_name,
    named_in,
    numbered,
    pin_name,
)
from linkanim.build.freedom import mobility
from linkanim.build.places import (
    at_on,
    crank_of,
    fitted,
    foot,
    from_span,
    gear_offset,
    line_of,
    moved,
    place_of,
    plates_of,
    round_angle,
    round_length,
    round_number,
    snapped,
    with_number,
)
from linkanim.build.pose_form import bodies_of
from linkanim.build.scene_form import made
from linkanim.words import said, said_as

# What a hand draws, by name: each gesture returns another building, or the same one and why.

SPEED = "20 rpm"
SHARES = (0.25, 0.12, 0.06, 0.03, 0.015)
"""How far a new slider or cylinder goes to both sides, in lengths of its bar, or of the cylinder."""


def pin(building: Building, at: complex, *, snap: float) -> Building:
    """Return the building with a ground pin at a point, which is snapped to multiples of `snap`."""
    draft, name = _with_pin(building.draft, at, snap)
    return changed(building, draft, (JOINT, name))


def bar(building: Building, start: str, end: Thing | None, at: complex, *, snap: float) -> Building:
    """Return the building with a bar from a joint to a point, where `end` is what is there.

    On another joint the bar ends in it; on a guide it ends in a new slider, on a bar in a new joint in its
    slot, on paper (None) in a new joint. The first bar from a ground pin is the crank.
    """
    draft = building.draft
    if end and end[0] == JOINT:
        name = end[1]
        if {start, name} <= draft.of("pins").keys() and start != name:
            return refused(
                building,
                said(
                    "{start} and {name} stand on the ground, and that is one body already",
                    start=start,
                    name=name,
                ),
            )
        if known := draft.bar(start, name):
            return refused(building, said("Bar {known} is there already", known=known))
        if any({start, name} <= plate.keys() for plate in plates_of(draft)) and start != name:
            return refused(
                building,
                said(
                    "{start} and {name} are points of one body: move one to set their distance",
                    start=start,
                    name=name,
                ),
            )
    else:
        if end and end[0] == "bars" and start in draft.ends(end[1]):
            return refused(
                building,
                said("{start} is an end of that bar: let go beside it, or on another bar", start=start),
            )
        draft, name = _with_joint(draft, end, at, snap)
    if place_of(draft, name) == place_of(draft, start):
        return refused(building, said("A bar needs a length: let go further from {start}", start=start))
    draft = _with_bar(draft, start, name, snap)
    return changed(building, draft, ("bars", draft.bar(start, name) or ""))


def point(building: Building, name: str, place: complex, *, snap: float) -> Building:
    """Return the building with a point on the body of a bar."""
    draft, on = building.draft, building.draft.ends(name)
    new, at = joint_name(draft, point=True), at_on(draft, on, place, snap)
    if at == [0, 0]:
        return refused(
            building, said("That is {part} itself: a point of a body lies beside its joints", part=on[0])
        )
    draft = draft.placing(new, place).having("points", new, {"on": on, "at": at})
    for body, table in draft.of("bodies").items():
        if set(on) <= set(table.get("joints", ())):
            draft = draft.having("bodies", body, {**table, "joints": [*table["joints"], new]})
    return changed(building, draft, (JOINT, new))


def guide(building: Building, start: Thing | None, begin: complex, end: complex, *, snap: float) -> Building:
    """Return the building with a line through a point: on the ground, or on the body of a joint or a bar."""
    draft, span = building.draft, end - begin
    if not span:
        return refused(building, said("A guide needs a direction: drag along it"))
    through, on = _carrier(draft, start)
    if on:
        axis = place_of(draft, on[1]) - place_of(draft, on[0])
        span *= axis.conjugate() / (abs(axis) or 1.0)
    elif not draft.of("pins"):
        draft, through = _with_pin(draft, begin, snap)
    through = through or min(draft.of("pins"), key=lambda pin: abs(place_of(draft, pin) - begin))
    table: dict[str, Any] = {"on": on} if on else {}
    table |= {"through": through, "angle": round_angle(span, snap)}
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
        words = {
            "pins": lambda: said("{joint} stands on the ground already", joint=joint),
            "points": lambda: said("{joint} is a point of a body already", joint=joint),
            "sliders": lambda: said("{joint} slides on a guide already", joint=joint),
        }
        return refused(building, words[held]())
    elif joint in draft.of("guides")[name].get("on", ()):
        return refused(building, said("{joint} is an end of that bar, and cannot slide in it", joint=joint))
    else:
        draft = moved(_with_slider(draft, joint, name), joint, place_of(draft, joint), snap)
    return changed(building, draft, (JOINT, joint))


def slot(building: Building, joint: str, end: Thing) -> Building:
    """Return the building with a joint in the slot of a bar, or of what slides on a guide: a yoke."""
    draft, (kind, name) = building.draft, end
    if kind == "bars":
        if joint in draft.ends(name):
            return refused(
                building, said("{joint} is an end of that bar, and cannot slide in it", joint=joint)
            )
        return changed(building, _with_slot(draft, name, joint), (JOINT, joint))
    if kind != JOINT or name not in draft.of("sliders") or name == joint:
        return refused(building, said("A slot is in a bar, or in a slider that has none: let go on one"))
    return changed(building, draft.having("yokes", name, {"pin": joint, "slot": "90 deg"}), (JOINT, name))


def gear(building: Building, joint: str, mate: str, *, snap: float) -> Building:
    """Return the building with a crank geared to another one: as fast, in the opposite direction."""
    draft = building.draft
    others = [end for _, end, _ in draft.bars_at(joint)]
    if joint == mate or not others or joint in draft.of("pins") or not crank_of(draft, mate):
        return refused(building, said("A gear pair joins two cranks: drag from one to the other"))
    if joint == draft.driven:
        return refused(building, said("{joint} is driven: let the other crank follow it", joint=joint))
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
        return refused(
            building, said("A {kind} has two ends: let go further from {start}", kind=said(kind), start=start)
        )
    kinds = f"{kind}s"
    name = numbered(draft, kinds, kind)
    return changed(building, draft.having(kinds, name, {"between": [start, end]}), (kinds, name))


def cylinder(building: Building, start: str, end: str, *, snap: float) -> Building:
    """Return the building with a cylinder as the drive, from a ground pin to a body on another ground pin."""
    draft = building.draft
    fixed, moving = (start, end) if start in draft.of("pins") else (end, start)
    crank = _turning_with(draft, moving)
    if fixed not in draft.of("pins") or crank is None or crank[0] == fixed:
        return refused(
            building, said("A cylinder drives a body that turns about a ground pin, from another pin")
        )
    length = abs(place_of(draft, moving) - place_of(draft, fixed))
    own = crank_drive(draft, *crank, snap)
    drives = []
    for part in SHARES:
        limits = [round_length(length * (1 + sign * part), snap) for sign in (-1, 1)]
        table = {"between": [fixed, moving], "from": limits[0], "to": limits[1], "joint": own["joint"]}
        drives.append({"speed": own["speed"], "start": own["start"], "cylinder": table})
    return driven(building, draft, drives, DRIVE, said("The cylinder drives {part}", part=crank[1]))


def driven(
    building: Building, draft: Draft, drives: Sequence[Mapping[str, Any]], chosen: Thing | None, sentence: str
) -> Building:
    """Return the building with the first of some drives by which the draft moves; else with the first."""
    drafts = [draft.having(*DRIVE, table) for table in drives]
    driven_draft = next((one for one in drafts if not drafts[1:] or made(one).scene), drafts[0])
    return changed(building, driven_draft, chosen, sentence)


def lay_photo(building: Building, file: str, x: float, y: float, width: float) -> Building:
    """Return the building with a photograph behind it, its lower left corner at a point; "" takes it away."""
    return _photographed(building, Photo(file, (x, y), width) if file else None)


def move_photo(building: Building, x: float, y: float, to_x: float, to_y: float) -> Building:
    """Return the building with its photograph moved as from one point to another."""
    return _fitted(building, 1 + 0j, complex(to_x - x, to_y - y))


def fit_photo(building: Building, *points: float) -> Building:
    """Return the building with its photograph scaled and turned, taking two of its points to two places.

    `points` are x and y of the first point and of its place, then those of the second point and its place.
    """
    one, there, other, beyond = (complex(*points[n : n + 2]) for n in (0, 2, 4, 6))
    if one == other or there == beyond:
        return refused(building, said("Two points fit a photograph: take them apart from each other"))
    scale = (beyond - there) / (other - one)
    return _fitted(building, scale, there - scale * one)


def scale_photo(building: Building, one: complex, other: complex, length: float) -> Building:
    """Return the building with its photograph scaled about `one`, which puts `other` `length` away."""
    if one == other:
        return refused(building, said("Two points of a photograph have a distance: take them apart"))
    scale = length / abs(other - one)
    return _fitted(building, complex(scale), one - scale * one)


def _fitted(building: Building, scale: complex, shift: complex) -> Building:
    """Return the building with its photograph's places z, as x + yi, brought to scale·z + shift."""
    photo = building.draft.photo
    if photo is None:
        return refused(building, said("There is no photograph: drop one on the window"))
    place = scale * complex(*photo.place) + shift
    turn = phase(scale * rect(1.0, photo.turn))
    return _photographed(
        building, Photo(photo.file, (place.real, place.imag), photo.width * abs(scale), turn)
    )


def _photographed(building: Building, photo: Photo | None) -> Building:
    return changed(building, replace(building.draft, photo=photo), building.chosen)


def crank_drive(draft: Draft, pivot: str, joint: str, snap: float) -> dict[str, Any]:
    """Return the drive of a crank that starts where it is drawn."""
    span = place_of(draft, joint) - place_of(draft, pivot)
    return {"joint": joint, "speed": draft.drive.get("speed", SPEED), "start": round_angle(span, snap)}


def _turning_with(draft: Draft, joint: str) -> tuple[str, str] | None:
    """Return the ground pin and the joint of the bar that carries a joint about that pin."""
    on = draft.of("points").get(joint, {}).get("on")
    for end in [joint] if on is None else on:
        pivot = crank_of(draft, end)
        if pivot and (on is None or pivot in on):
            return pivot, end
    return None


def _carrier(draft: Draft, start: Thing | None) -> tuple[str | None, list[str]]:
    """Return the joint through which a guide from a thing runs, and the axis of the body that carries it."""
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
    span = place_of(draft, end) - place_of(draft, start)
    draft = draft.with_bar(start, end, round_length(abs(span), snap))
    draft = draft.having("bodies", body_name(draft), {"joints": [start, end]})
    if draft.drive or start not in draft.of("pins"):
        return draft
    return draft.having(*DRIVE, crank_drive(draft, start, end, snap))


def _with_slider(draft: Draft, joint: str, name: str) -> Draft:
    draft = draft.having("sliders", joint, {"guide": name})
    return draft.having("bodies", body_name(draft), {"slider": joint})


def _with_slot(draft: Draft, name: str, joint: str) -> Draft:
    return draft.having("slots", f"{joint} in {name}", {"bar": name, "through": joint})


# What is done to the chosen thing: it is moved, driven, traced, removed; and the next one is chosen.

_HELD = ("pins", "points", "sliders")
_WORDS = {JOINT: "joint", "drive": "drive"}


def choose(building: Building, further: int) -> Building:
    """Return the building with the thing chosen that is `further` places on: joints, bars, guides, ..."""
    things = list(building.draft.things())
    if not things:
        return refused(building, said("Nothing is drawn yet: a click sets a ground pin"))
    now = things.index(building.chosen) if building.chosen in things else -1 if further > 0 else 0
    return choosing(building, things[(now + further) % len(things)])


def choose_thing(building: Building, kind: str, name: str) -> Building:
    """Return the building with a thing chosen; with nothing where there is none of that name."""
    thing = (kind, name)
    return choosing(building, thing if thing in set(building.draft.things()) else None)


def move(building: Building, x: float, y: float, *, snap: float) -> Building:
    """Return the building with the chosen thing at a point: a joint, or a guide that then runs through it.

    Numbers follow, except typed ones.
    """
    draft, thing = building.draft, building.chosen
    place = snapped(complex(x, y), snap)
    if thing and thing[0] == JOINT:
        scene = building.made.scene
        phase = draft.phase if scene is None or scene.info.full_turn else None
        return changed(building, moved(draft, thing[1], place, snap, phase), thing)
    if thing and thing[0] == "guides" and (*thing, "offset") not in draft.typed:
        table = {**draft.of("guides")[thing[1]], "offset": 0}
        start, direction = line_of(draft, table)
        offset = round_number(((place - start) * direction.conjugate()).imag, snap)
        return changed(building, fitted(with_number(draft, (*thing, "offset"), offset)), thing)
    return refused(building, said("Choose a joint or a guide to move it"))


def trace(building: Building) -> Building:
    """Return the building with the curve of the chosen joint drawn, or no longer."""
    draft, thing = building.draft, building.chosen
    if not thing or thing[0] != JOINT:
        return refused(building, said("Choose a joint to draw its curve"))
    remaining = [name for name in draft.trace if name != thing[1]]
    joints = remaining if thing[1] in draft.trace else [*remaining, thing[1]]
    return changed(building, replace(draft, rest={**draft.rest, "trace": {"joints": joints}}), thing)


def drive(building: Building) -> Building:
    """Return the building with the chosen thing as the drive: a crank, a slider, a joint of two bars."""
    return next(drives(building))[1]


def drives(building: Building, *, here: bool = False) -> Iterator[tuple[str, Building]]:
    """Yield the ways in which the chosen thing can be driven, in words, and the buildings with them.

    Those at the chosen joint come first where a motor was let go `here`.

    Of a ground pin that is a bar on it; of a joint that moves the bar from a ground pin, a slider, or a motor
    between two bars. Where a further motor makes it move, that comes first.
    """
    draft, thing, drafts = building.draft, building.chosen, list[tuple[str, Building]]()
    for joint in _drivable(draft, thing):
        bare = draft.having("gears", joint, None).having("drives", joint, None)
        if joint in draft.of("sliders"):
            slides = _slider_drives(draft, joint)
            drafts.append(
                (
                    said("{joint} slides", joint=joint),
                    driven(building, bare, slides, thing, said("{joint} is driven", joint=joint)),
                )
            )
            continue
        pivot = str(crank_of(draft, joint))
        table = crank_drive(draft, pivot, joint, abs(place_of(draft, joint) - place_of(draft, pivot)) / 100)
        one = driven(building, bare, [table], thing, said("{joint} is driven", joint=joint))
        drafts.append((said("{joint} turns about {pivot}", joint=joint, pivot=pivot), one))
        cranked = draft.driven and not draft.drive.keys() & {"cylinder", "slider"}
        if cranked and joint != draft.driven and mobility(bare) > 1 + len(bare.of("drives")):
            words = said("{joint} has a motor, too", joint=joint)
            further = {"speed": table["speed"], "start": table["start"]}
            more = changed(building, bare.having("drives", joint, further), thing, words)
            place = 0 if more.made.scene else len(drafts)
            drafts.insert(place, (said("{joint} turns about {pivot}, too", joint=joint, pivot=pivot), more))
    kind, name = thing or ("", "")
    first = len(drafts) if kind == JOINT and name not in (*draft.of("pins"), *draft.of("sliders")) else 0
    for pivot, arms in _moving_motors(draft, thing):
        speed = draft.drive.get("speed", SPEED)
        table = {"motor": {"pivot": pivot, "between": [*arms]}, "speed": speed}
        own, turned = (draft.body_of([pivot, arm]) or f"{pivot}–{arm}" for arm in arms)
        words = said("link {turned} turns on link {own} at {pivot}", turned=turned, own=own, pivot=pivot)
        drafts.append(
            (words, driven(building, draft, [table], thing, said("The motor is at {pivot}", pivot=pivot)))
        )
    if not drafts:
        why = said("Choose a crank (a bar on a ground pin), a slider, or a joint of two bars to drive it")
        drafts.append(("", refused(building, why)))
    yield from drafts[first:] + drafts[:first] if here else drafts


def motor(building: Building, x: float, y: float, *, reach: float) -> Building:
    """Return the building with the thing at a point chosen, for a motor to be let go there."""
    thing = under(building.draft, x, y, reach)
    return (
        choosing(building, thing)
        if thing
        else refused(building, said("Let the motor go on a joint, or a bar"))
    )


def delete(building: Building) -> Building:
    """Return the building without the chosen thing, and without what depends on it alone."""
    draft, thing = building.draft, building.chosen
    if thing is None:
        return refused(building, said("Choose what is to be removed"))
    remaining = _without(draft, thing)
    kept = {*remaining.things(), thing, DRIVE}
    gone = (one for one in draft.things() if one not in kept)
    first, *others = (
        said("{kind} {name}", kind=said(_WORDS.get(kind, kind[:-1])), name=name)
        for kind, name in (thing, *gone)
    )
    words = said("Removed {thing}", thing=first)
    if others:
        words = said("Removed {thing}, with {others}", thing=first, others=said_as("list", ", ").join(others))
    return changed(building, remaining, None, words)


def _drivable(draft: Draft, thing: Thing | None) -> Iterator[str]:
    """Yield the joints to drive for a thing: moving ends of cranks, or a slider."""
    pins, (kind, name) = draft.of("pins"), thing or ("", "")
    if kind == "bars":
        first, second = draft.ends(name)
        yield from [second] if first in pins else [first] if second in pins else []
    elif kind == JOINT and name in pins:
        yield from (end for _, end, _ in draft.bars_at(name))
    elif kind == JOINT:
        is_crank = any(end in pins for _, end, _ in draft.bars_at(name))
        yield from [name] if is_crank or name in draft.of("sliders") else []


def _moving_motors(draft: Draft, thing: Thing | None) -> Iterator[tuple[str, tuple[str, str]]]:
    """Yield the motors at a joint, or at the joints of a bar, between two bodies that both move."""
    kind, name = thing or ("", "")
    pivots = [name] if kind == JOINT else draft.ends(name) if kind == "bars" else []
    for pivot in pivots:
        arms = [next(end for end in body if end != pivot) for body in bodies_of(draft) if pivot in body]
        # a chosen bar turns on the other one
        arms.sort(key=lambda arm: kind == "bars" and draft.bar(pivot, arm) == name)
        yield from ((pivot, arms_of_two) for arms_of_two in combinations(arms, 2))


def _slider_drives(draft: Draft, joint: str) -> list[dict[str, Any]]:
    """Return drives of a slider that goes to both sides by a share of its longest bar."""
    guide = draft.of("guides")[draft.of("sliders")[joint]["guide"]]
    start, direction = line_of(draft, {**guide, "offset": 0})
    travel = ((place_of(draft, joint) - start) * direction.conjugate()).real
    bars = [abs(place_of(draft, end) - place_of(draft, joint)) for _, end, _ in draft.bars_at(joint)]
    longest = max(bars, default=0.0) or abs(travel) or 100.0
    drives = []
    for part in SHARES:
        reach, step = longest * part, 10.0 ** floor(log10(longest * part) - 1)
        limits = {"from": round_number(travel - reach, step), "to": round_number(travel + reach, step)}
        drives.append({"speed": draft.drive.get("speed", SPEED), "slider": {"joint": joint, **limits}})
    return drives


def _without(draft: Draft, thing: Thing) -> Draft:
    """Return the draft without a thing, without what names it, and without joints that nothing holds then."""
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
    """Yield the things that make no sense without removed ones, including the drive of a removed crank."""
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


# What is under the pointer, and what a click or a drag there does with the tool in hand.

TOOLS: Final = ("bar", "guide", "slider", "slot", "gear", "spring", "damper", "cylinder", "move")
"""The tools, in the order of their icons."""


def under(draft: Draft, x: float, y: float, reach: float) -> Thing | None:
    """Return the thing within `reach` of a point: the nearest joint, else bar or strut, else guide."""
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
    """Return the building after a click: the thing there is chosen; on paper a ground pin is made.

    With the slider as the tool, a click on a guide makes a joint that slides there.
    """
    thing = under(building.draft, x, y, reach)
    if thing is None:
        return pin(building, complex(x, y), snap=snap)
    if tool == "slider" and thing[0] == "guides":
        return slider(building, None, thing[1], complex(x, y), snap=snap)
    return choose_thing(building, *thing)


def double_click(building: Building, x: float, y: float, *, reach: float, snap: float) -> Building:
    """Return the building with a point on the body that lies there."""
    thing = under(building.draft, x, y, reach)
    if thing is None or thing[0] != "bars":
        return refused(building, said("A point lies on a body: double-click on a bar"))
    return point(building, thing[1], snapped(complex(x, y), snap), snap=snap)


def on_body(draft: Draft, name: str, at: complex) -> complex:
    """Return the point nearest to a place on a bar or, of a plate, on one of its sides."""
    feet = (
        at - from_span(place_of(draft, one), place_of(draft, other), at)
        for thing, (one, other) in _spans(draft)
        if thing == ("bars", name)
    )
    return min(feet, key=lambda foot: abs(foot - at))


def _spans(draft: Draft) -> Iterator[tuple[Thing, tuple[str, str]]]:
    """Yield the straight edges of things between joints: bars, their plates, springs and dampers."""
    for name, table in draft.of("bars").items():
        yield ("bars", name), tuple(table["joints"])
    for point, table in draft.of("points").items():
        if bar := draft.bar(*table["on"]):
            yield from ((("bars", bar), (end, point)) for end in table["on"])
    for kind in ("springs", "dampers"):
        yield from (((kind, name), tuple(table["between"])) for name, table in draft.of(kind).items())
