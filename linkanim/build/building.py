"""A drawing at work: what is drawn, what is chosen, what was typed, and the way back.

A `Building` is a frozen value with its draft, the scene that it makes, and undo and redo. `building_of`
begins with a scene, each of whose joints is taken apart into what a hand would have drawn.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace
from functools import cached_property
from typing import Any, Generic, TypeVar

from linkanim.build.draft import DRIVE, Draft, Thing, numbered
from linkanim.build.places import sides
from linkanim.build.scene_form import Made, made, phase_of, photo_of, table_of
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import RRP, RRR
from linkanim.scenes.file_form import SHORTHANDS
from linkanim.scenes.scene import Scene

# A drawing at work: what is drawn, what is chosen, what was typed, and the way back.

_KEPT = 200
Kept = TypeVar("Kept")
Step = tuple[Kept, tuple[Kept, ...], tuple[Kept, ...]]
"""What is stood at next, and then the past and the future."""


@frozen(kw_only=True)
class Undoable(Generic[Kept]):
    """What undo goes back to and redo goes on to, the nearest one last."""

    past: tuple[Kept, ...] = ()
    future: tuple[Kept, ...] = ()

    def remembering(self, now: Kept, most: int) -> tuple[Kept, ...]:
        """Return the past with `now`, and at most `most` values of it; a change has no future."""
        return (*self.past, now)[-most:]

    def back(self, now: Kept) -> Step[Kept] | None:
        """Return the step before `now`; None where there is none."""
        return (self.past[-1], self.past[:-1], (*self.future, now)) if self.past else None

    def onward(self, now: Kept) -> Step[Kept] | None:
        """Return the step that was last gone back from; None where there is none."""
        return (self.future[-1], (*self.past, now), self.future[:-1]) if self.future else None


@frozen
class Building(Undoable[Draft]):
    """A draft with what was `chosen` of it, the digits begun for its number `row`, and what undo goes to.

    What is typed is `lettered` where its row is no number and was asked for.

    `sentence` says what the last gesture did besides, or as a refusal why it did nothing; "" where that is
    plain.
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
        """The scene that the draft comes to, or None and what it lacks; worked out once."""
        return made(self.draft)


def knowing(building: Building, made: Made) -> Building:
    """Return the building, of whose draft it is known already what it makes."""
    vars(building).setdefault("made", made)
    return building


def changed(building: Building, draft: Draft, chosen: Thing | None, sentence: str = "") -> Building:
    """Return the building with another draft, which undo takes back."""
    settled = draft.having_all("sides", sides(draft))
    after = Building(settled, chosen, past=grown(building), sentence=sentence)
    scene, before = after.made.scene, building.made.scene
    swung = bool(before and not before.info.full_turn)
    goes_on = before and not swung and _input(draft) == _input(building.draft)
    if scene is None or (goes_on and scene.info.full_turn):
        return after
    return replace(after, draft=replace(settled, phase=phase_of(scene, settled.places, swung=swung)))


def grown(building: Building) -> tuple[Draft, ...]:
    """Return what undo goes back to after a change of a building."""
    return building.remembering(building.draft, _KEPT)


def _input(draft: Draft) -> tuple[str | None, object, object]:
    """Return what drives: the joint, the cylinder, the slider."""
    return draft.driven, draft.drive.get("cylinder"), draft.drive.get("slider")


def refused(building: Building, sentence: str) -> Building:
    """Return the building as it is, and why nothing was done."""
    return replace(building, typed="", sentence=sentence, is_refusal=True)


def posed(building: Building, phase: float) -> Building:
    """Return the building with its joints where they stand at a phase; as it is where it does not move.

    What is drawn next is drawn onto that pose. No numbers change, and there is nothing to undo.
    """
    scene = building.made.scene
    if scene is None:
        return building
    places = {**building.draft.places, **scene.pose(phase, 0).position}
    return replace(building, draft=replace(building.draft, places=places, phase=phase))


def choosing(building: Building, thing: Thing | None) -> Building:
    """Return the building with a thing chosen, or nothing, and nothing typed."""
    return replace(building, chosen=thing, row=0, typed="", lettered=False, sentence="")


def undo(building: Building) -> Building:
    """Return the building before its last change; digits begun are let go of first."""
    return _standing(building, None if building.typed else building.back(building.draft))


def redo(building: Building) -> Building:
    """Return the building with the change that undo took back last."""
    return _standing(building, building.onward(building.draft))


def _standing(building: Building, step: Step[Draft] | None) -> Building:
    """Return the building at a step, what is chosen still so if it is there; else with nothing typed."""
    if step is None:
        return replace(building, typed="", sentence="")
    draft, past, future = step
    chosen = building.chosen if building.chosen in set(draft.things()) else None
    return choosing(replace(building, draft=draft, past=past, future=future), chosen)


# From a scene back to a draft: each of its joints taken apart into what a hand would have drawn.

_DRAWN = ("ground", "joints", "bodies", "springs", "dampers", "drive", "photo", *SHORTHANDS)

_JUST_AFTER = 0.01


def building_of(scene: Scene) -> Building:
    """Return a building that begins with a scene: its draft comes to an equal scene."""
    return Building(draft_of(scene))


def draft_of(scene: Scene) -> Draft:
    """Return the draft of a scene, its joints where they stand at phase 0.

    Where another joint's side names a closure they stand just after: that does not show at a limit.
    Numbers stay as its file writes them; those that a shorthand gives are in the scene's unit.
    """
    document = scene.document
    short = {key: document[key] for key in SHORTHANDS if key in document}
    rest = {key: value for key, value in document.items() if key not in _DRAWN}
    rest |= {"title": scene.title, "length_unit": scene.length_unit}
    if scene.trace:
        rest["trace"] = {"joints": list(scene.trace)}
    phase = _JUST_AFTER if any(getattr(joint, "side_of", None) for joint in scene.linkage.joints) else 0.0
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
    drive = dict(document.get("drive", {}))
    if "slider" not in drive:
        drive = {"joint": scene.linkage.drive.joint} | drive
    return draft.having(*DRIVE, drive)


def _apart(draft: Draft, name: str, table: Any) -> Draft:
    """Return the draft with what a joint's table says of it, as bars, guides, slots and points."""
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
