"""The numbers of a scene on the sheet that makes it: the thing each belongs to, and scenes with others.

The list of all numbers changes the scene, and the draft follows: parts of it that the scene does not have,
such as a guide that nothing slides on, stay.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import isnan
from typing import Any

from linkanim.build.building import Building, draft_of, grown, knowing
from linkanim.build.dimensions import PropertyRow, rows_of
from linkanim.build.draft import DRIVE, JOINT, Draft, Thing, numbered
from linkanim.build.scene_form import Made, made
from linkanim.errors import BadInput
from linkanim.scenes.editing import numbers
from linkanim.scenes.form import Key
from linkanim.scenes.scene import Scene
from linkanim.words import said

_PHASES = (0.5, 1.5, 3.0, 4.5)
"""Phases at which a drawing may show its closure where its drawn pose does not."""


def renumbered(building: Building, scene: Scene, *, grows: bool = True) -> Building:
    """Return the building whose linkage has become `scene`: the same one with other numbers, or closures.

    This is a step of undo only where it `grows`, which it does not while a drag continues. BadInput for a
    scene whose closure cannot be seen in any drawing of it.
    """
    draft = building.draft
    made_before = building.made.scene
    assert made_before
    new = draft_of(scene)
    drafts = _patched(draft, draft_of(made_before), new), _with_guides(new, draft)
    phases = draft.phase, new.phase, *_PHASES
    posed = (_posed(one, scene, phase) for one in drafts if one for phase in phases)
    after = next((one for one in posed if _makes(one, scene)), None)
    if after is None:
        raise BadInput(said("the sheet cannot tell this closure from the other: leave it first"))
    chosen = building.chosen if building.chosen in {*after.things()} else None
    past = grown(building) if grows else building.past
    # the building makes this scene, parts of which are worked out already
    return knowing(Building(after, chosen, building.row if chosen else 0, past=past), Made(scene, ""))


def _posed(draft: Draft, scene: Scene, phase: float) -> Draft:
    """Return the draft with its joints where they stand in its scene at a phase."""
    return replace(draft, places={**draft.places, **scene.pose(phase, 0).position}, phase=phase)


def _makes(draft: Draft, scene: Scene) -> bool:
    made_scene = made(draft).scene
    return made_scene is not None and made_scene.linkage == scene.linkage and made_scene.trace == scene.trace


def _patched(draft: Draft, before: Draft, after: Draft) -> Draft | None:
    """Return the draft with the differences of two drafts of its scene; None where one has no place in it."""
    for kind, every in after.tables.items():
        for name, table in every.items():
            old = before.of(kind).get(name)
            if table == old:
                continue
            own = _own_name(draft, after, kind, name)
            if own is None:
                return None
            draft = draft.having(kind, own, _merged(draft.of(kind).get(own), old, table))
    rest = {key: value for key, value in after.rest.items() if value != before.rest.get(key)}
    return replace(draft, rest={**draft.rest, **rest}, short=after.short if draft.short else draft.short)


def _merged(own: Any, old: Any, new: Any) -> Any:
    """Return the draft's own table with the differences of two others."""
    if not (isinstance(own, Mapping) and isinstance(new, Mapping)):
        return new
    known = old if isinstance(old, Mapping) else {}
    return {**own, **{key: value for key, value in new.items() if value != known.get(key)}}


def _own_name(draft: Draft, other: Draft, kind: str, name: str) -> str | None:
    """Return the name in this draft of a thing of another draft of the same linkage; None without one."""
    if kind == "bars":
        return draft.bar(*other.ends(name))
    if kind == "guides":
        on = (joint for joint, table in other.of("sliders").items() if table["guide"] == name)
        return next((draft.of("sliders")[one]["guide"] for one in on if one in draft.of("sliders")), None)
    if kind == "slots":
        slot = _slot(other, other.of("slots")[name])
        return next((key for key, one in draft.of("slots").items() if _slot(draft, one) == slot), None)
    if kind in ("sides", "bodies", "drive"):
        return name
    return name if name in draft.of(kind) else None


def _slot(draft: Draft, table: Mapping[str, Any]) -> tuple[str, frozenset[str]]:
    """Return the joint in a slot, and the joints of its bar."""
    return str(table["through"]), frozenset(draft.ends(table["bar"]))


def _with_guides(after: Draft, draft: Draft) -> Draft:
    """Return a draft with the photograph of another, and the guides of that on which nothing slides."""
    after = replace(after, photo=draft.photo)
    held = {table["guide"] for table in draft.of("sliders").values()}
    for name, table in draft.of("guides").items():
        joints = {table["through"], *table.get("on", ())}
        if name not in held and joints <= after.places.keys():
            after = after.having("guides", numbered(after, "guides", "guide"), table)
    return after


def thing_at(draft: Draft, scene: Scene, key: Key) -> Thing | None:
    """Return the thing of a draft to which a number of its scene belongs; None for no visible thing."""
    number = next((one for one in numbers(scene.document) if one.key == key), None)
    section, name = key[0], str(key[1]) if len(key) > 1 else ""
    if number is None or section in ("springs", "dampers", "loads"):
        return (str(section), name) if number and name in draft.of(str(section)) else None
    if section == "drive":
        return DRIVE
    if section == "bodies":
        return _of_body(draft, name)
    if "line" in key or "line_angle" in key or key[-1] == "offset":
        guide = _guide_of(draft, name)
        if guide:
            return "guides", guide
    start, end = number.ends(scene) if number.field.drag or number.field.spans else (None, name)
    bar = draft.bar(start, end) if start else None
    if bar:
        return "bars", bar
    return (JOINT, end) if end in draft.places else None


def _of_body(draft: Draft, name: str) -> Thing | None:
    body = draft.of("bodies").get(name, {})
    if "slider" in body:
        return JOINT, str(body["slider"])
    bar = draft.bar(*body["joints"][:2]) if len(body.get("joints", ())) > 1 else None
    return ("bars", bar) if bar else None


def _guide_of(draft: Draft, joint: str) -> str | None:
    """Return the guide of a joint; where a shorthand's number names no joint, the only guide."""
    sliders = draft.of("sliders")
    if joint in sliders:
        return str(sliders[joint]["guide"])
    guides = {str(table["guide"]) for table in sliders.values()}
    return next(iter(guides)) if len(guides) == 1 and joint not in draft.places else None


PlacedRow = tuple[Thing, int, PropertyRow]
"""A number of a draft: the thing that has it, its place among the thing's rows, and the row."""


def rows_of_all(draft: Draft) -> tuple[PlacedRow, ...]:
    """Return all stated numbers of a draft, each only once, with the thing that is drawn for it."""
    rows: dict[Key, PlacedRow] = {}
    for thing in draft.things():
        for place, row in enumerate(rows_of(draft, thing)):
            if row.number and not isnan(row.number.value):
                rows.setdefault(row.key, (thing, place, row))
    return tuple(rows.values())


def chosen_row(building: Building) -> int | None:
    """Return the place, among all numbers, of the chosen thing's number to be typed; None without one."""
    own = rows_of(building.draft, building.chosen)
    key = own[building.row % len(own)].key if own else None
    return next((n for n, (_, _, one) in enumerate(rows_of_all(building.draft)) if one.key == key), None)
