"""A draft being edited: what is drawn, what is chosen, what was typed, undo and redo.

A `Building` is a frozen value with its draft, the scene that it makes, and undo and redo. `building_of`
begins with a scene, each of whose joints is taken apart into what a hand would have drawn.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace
from functools import cached_property
from math import remainder, tau
from typing import Any, Generic, TypeVar

from linkanim import units
from linkanim.build.draft import DRIVE, Draft, Thing, numbered
from linkanim.build.places import sides
from linkanim.build.pose_form import draft_of_group
from linkanim.build.scene_form import Made, made, phase_of, photo_of, table_of
from linkanim.frozen import frozen
from linkanim.mechanics.groups import group_of
from linkanim.mechanics.linkage import RRP, RRR
from linkanim.scenes.file_form import POINTS_FORM, SHORTHANDS
from linkanim.scenes.links import in_degrees
from linkanim.scenes.scene import Scene

# A draft being edited: what is drawn, what is chosen, what was typed, undo and redo.

_KEPT = 200
_SAME = 1e-9
"""Radians; the pose of a drawing has fewer digits than a start that was typed."""
Kept = TypeVar("Kept")
Step = tuple[Kept, tuple[Kept, ...], tuple[Kept, ...]]
"""The value after a step of undo or redo, and then the past and the future."""


@frozen(kw_only=True)
class Undoable(Generic[Kept]):
    """A value with undo and redo: the values that each goes to, the nearest one last."""

    past: tuple[Kept, ...] = ()
    future: tuple[Kept, ...] = ()

    def remembering(self, now: Kept, most: int) -> tuple[Kept, ...]:
        """Return the past with `now` added, at most `most` values: the past after a change."""
        return (*self.past, now)[-most:]

    def back(self, now: Kept) -> Step[Kept] | None:
        """Return the step before `now`; None where there is none."""
        return (self.past[-1], self.past[:-1], (*self.future, now)) if self.past else None

    def onward(self, now: Kept) -> Step[Kept] | None:
        """Return the step that the last undo left; None where there is none."""
        return (self.future[-1], (*self.past, now), self.future[:-1]) if self.future else None


@frozen
class Building(Undoable[Draft]):
    """A draft with its `chosen` thing, the text `typed` for that one's `row`, and undo and redo.

    The text is `lettered` where its row is no number and was chosen by the user. `sentence` says what else
    the last gesture did, or why it did nothing; "" where that is obvious.
    """

    draft: Draft = field(default_factory=Draft)
    chosen: Thing | None = None
    row: int = 0
    typed: str = ""
    lettered: bool = False
    sentence: str = ""
    is_refusal: bool = False

    @cached_property
    def made(self) -> Made:
        """The scene of the draft, or None and what it lacks; cached."""
        return made(self.draft)


def knowing(building: Building, made: Made) -> Building:
    """Return the building with the known result of its draft."""
    vars(building).setdefault("made", made)
    return building


def changed(building: Building, draft: Draft, chosen: Thing | None, sentence: str = "") -> Building:
    """Return the building with another draft, which undo takes back."""
    settled = draft.having_all("sides", sides(draft))
    after = Building(settled, chosen, past=grown(building), sentence=sentence)
    scene, before = after.made.scene, building.made.scene
    if scene and after.made.by_points:
        after = as_drawn(after)
        return knowing(posed(after, after.draft.phase), after.made)
    swung = bool(before and not before.info.full_turn)
    goes_on = before and not swung and _input(draft) == _input(building.draft)
    if scene is None or (goes_on and scene.info.full_turn):
        return after
    return replace(after, draft=replace(settled, phase=phase_of(scene, settled.places, swung=swung)))


def as_drawn(building: Building) -> Building:
    """Return the building at the phase of its drawn pose, from which links that are solved together start."""
    made = building.made
    if made.scene is None or not made.by_points:
        return building
    draft, at = building.draft, phase_of(made.scene, building.draft.places, by_points=True)
    start = made.scene.linkage.drive.start
    if "start" in draft.drive and abs(remainder(start - units.angle(draft.drive["start"]), tau)) > _SAME:
        draft = draft.having(*DRIVE, {**draft.drive, "start": in_degrees(start)})
    draft = replace(draft, phase=at, typed=draft.typed - {(*DRIVE, "start")})
    return knowing(replace(building, draft=draft), made)


def grown(building: Building) -> tuple[Draft, ...]:
    """Return a building's past after a further change."""
    return building.remembering(building.draft, _KEPT)


def _input(draft: Draft) -> tuple[str | None, object, object]:
    """Return what drives: the joint, the cylinder, the slider."""
    return draft.driven, draft.drive.get("cylinder"), draft.drive.get("slider")


def refused(building: Building, sentence: str) -> Building:
    """Return the building unchanged, with the sentence why nothing was done."""
    return replace(building, typed="", sentence=sentence, is_refusal=True)


def posed(building: Building, phase: float) -> Building:
    """Return the building with its joints in their pose at a phase; unchanged where it does not move.

    What is drawn next is drawn onto that pose. No numbers change, and there is nothing to undo.
    """
    scene = building.made.scene
    if scene is None:
        return building
    position = scene.pose(phase, 0).position
    places = {name: position.get(name, place) for name, place in building.draft.places.items()}
    after = replace(building, draft=replace(building.draft, places=places, phase=phase))
    return knowing(after, building.made) if building.made.by_points else after


def choosing(building: Building, thing: Thing | None) -> Building:
    """Return the building with a thing chosen, or nothing, and nothing typed."""
    return replace(building, chosen=thing, row=0, typed="", lettered=False, sentence="")


def undo(building: Building) -> Building:
    """Return the building before its last change; typed text is discarded first."""
    return _standing(building, None if building.typed else building.back(building.draft))


def redo(building: Building) -> Building:
    """Return the building with the change that was undone last."""
    return _standing(building, building.onward(building.draft))


def _standing(building: Building, step: Step[Draft] | None) -> Building:
    """Return the building at a step, with nothing typed; the chosen thing stays chosen if it exists there."""
    if step is None:
        return replace(building, typed="", sentence="")
    draft, past, future = step
    chosen = building.chosen if building.chosen in set(draft.things()) else None
    return choosing(as_drawn(replace(building, draft=draft, past=past, future=future)), chosen)


# From a scene back to a draft: each of its joints taken apart into what a hand would have drawn.

_DRAWN = ("ground", "joints", "bodies", "springs", "dampers", "drive", "drives", "photo", *SHORTHANDS)

_JUST_AFTER = 0.01


def building_of(scene: Scene) -> Building:
    """Return a building that begins with a scene: its draft makes an equal scene."""
    if group_of(scene.linkage) is None and scene.document.get("form") != POINTS_FORM:
        return Building(draft_of(scene))
    # the building makes this scene, whatever rounding its draft has
    return as_drawn(knowing(Building(draft_of(scene)), Made(scene, "", by_points=True)))


def draft_of(scene: Scene) -> Draft:
    """Return the draft of a scene, with its joints in their pose at phase 0.

    Where another joint's side names a closure, the pose is just after phase 0, since a limit shows no side.
    Numbers stay as in its file; those that a shorthand gives are in the scene's unit.
    """
    document = scene.document
    if group_of(scene.linkage):
        photo = photo_of(document["photo"], scene.length_unit) if "photo" in document else None
        return replace(draft_of_group(scene), photo=photo)
    short = {key: document[key] for key in SHORTHANDS if key in document}
    rest = {key: value for key, value in document.items() if key not in _DRAWN}
    rest |= {"title": scene.title, "length_unit": scene.length_unit}
    if scene.trace:
        rest["trace"] = {"joints": list(scene.trace)}
    phase = _JUST_AFTER if any(getattr(joint, "side_of", None) for joint in scene.linkage.joints) else 0.0
    if document.get("form") == POINTS_FORM:  # put together as it is drawn, which no limit shows
        phase = scene.mechanism.phase_of(scene.linkage.drive.start, 0.0)
    draft = Draft(dict(scene.pose(phase, 0).position), rest=rest, short=short or None, phase=phase)
    if "photo" in document:
        draft = replace(draft, photo=photo_of(document["photo"], scene.length_unit))
    for joint in scene.linkage.joints:
        section = document.get("ground" if joint.fixed else "joints", {})
        draft = _apart(draft, joint.name, section.get(joint.name) or table_of(joint))
    for kind in ("bodies", "springs", "dampers"):
        draft = draft.having_all(kind, document.get(kind, {}))
    for body in scene.linkage.bodies if short else ():
        own = draft.of("bodies").get(body.name)
        stated = {"slider": body.slider} if body.slider else {"joints": list(body.joints)}
        draft = draft.having("bodies", body.name, own or stated)
    for motor in document.get("drives", {}).values():
        own = {key: value for key, value in motor.items() if key != "joint"}
        draft = draft.having("drives", motor["joint"], own)
    drive = dict(document.get("drive", {}))
    if "slider" not in drive:
        drive = {"joint": scene.linkage.drive.joint} | drive
    return draft.having(*DRIVE, drive)


def _apart(draft: Draft, name: str, table: Any) -> Draft:
    """Return the draft with a joint's table taken apart into bars, guides, slots and points."""
    if not isinstance(table, Mapping) or table.keys() == {"length", "angle"}:
        return draft.having("pins", name, table)
    if "on" in table:
        return draft.having("points", name, table)
    if "crank" in table:
        draft = draft.with_bar(table["crank"], name, table["length"])
        return draft.having("gears", name, table["gear"]) if "gear" in table else draft
    if "slot" in table:
        slot = table["slot"]
        draft = draft.with_bar(slot["pivot"], name, table["length"])
        bar = f"{slot['pivot']}–{name}"
        aside = {"offset": slot["offset"]} if "offset" in slot else {}
        return draft.having(
            "slots", f"{slot['through']} in {bar}", {"bar": bar, "through": slot["through"], **aside}
        )
    slide = table.get("slide", table)
    if "line" in slide:
        guide = numbered(draft, "guides", "guide")
        draft = draft.having("guides", guide, slide["line"]).having("sliders", name, {"guide": guide})
    if "pin" in slide:
        yoke = {key: slide[key] for key in ("pin", "slot") if key in slide}
        return draft.having("yokes", name, yoke)
    ends, lengths = table.get("from", []), table.get("length", [])
    both = [(ends, lengths)] if isinstance(ends, str) else list(zip(ends, lengths, strict=True))
    for end, length in both:
        draft = draft.with_bar(end, name, length)
    side = table.get("side", (RRP if "line" in table else RRR).sides[0])
    known = {"joints": [end for end, _ in both], "side": side}
    return draft.having("sides", name, known) if both and side else draft
