"""A drawing at work: what is drawn, what is chosen, what was typed, and the way back."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

from linkanim.build.draft import Draft, Thing
from linkanim.build.making import Made, made, phase_of
from linkanim.build.order import sides

_KEPT = 200


@dataclass(frozen=True)
class Building:
    """A draft with what was `chosen` of it, the digits begun for its number `row`, and what undo goes to.

    `sentence` says what the last gesture did besides, or why it did nothing; "" where that is plain.
    """

    draft: Draft = field(default_factory=Draft)
    chosen: Thing | None = None
    row: int = 0
    typed: str = ""
    past: tuple[Draft, ...] = ()
    future: tuple[Draft, ...] = ()
    sentence: str = ""

    @cached_property
    def made(self) -> Made:
        """The scene that the draft comes to, or None and what it lacks; worked out once."""
        return made(self.draft)


def changed(building: Building, draft: Draft, chosen: Thing | None, sentence: str = "") -> Building:
    """Return the building with another draft, which undo takes back."""
    settled = draft.having_all("sides", sides(draft))
    past = (*building.past, building.draft)[-_KEPT:]
    after = Building(settled, chosen, past=past, sentence=sentence)
    scene, before = after.made.scene, building.made.scene
    swung = bool(before and not before.info.full_turn)
    goes_on = before and not swung and _input(draft) == _input(building.draft)
    if scene is None or (goes_on and scene.info.full_turn):
        return after
    return replace(after, draft=replace(settled, phase=phase_of(scene, settled.places, swung=swung)))


def _input(draft: Draft) -> tuple[str | None, object, object]:
    """Return what drives: the joint, the cylinder, the slider."""
    return draft.driven, draft.drive.get("cylinder"), draft.drive.get("slider")


def refused(building: Building, sentence: str) -> Building:
    """Return the building as it is, and why nothing was done."""
    return replace(building, typed="", sentence=sentence)


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
    return replace(building, chosen=thing, row=0, typed="", sentence="")


def undo(building: Building) -> Building:
    """Return the building before its last change; digits begun are let go of first."""
    past, future = building.past, building.future
    if building.typed or not past:
        return replace(building, typed="", sentence="")
    return _standing(building, past[-1], past[:-1], (*future, building.draft))


def redo(building: Building) -> Building:
    """Return the building with the change that undo took back last."""
    past, future = building.past, building.future
    if not future:
        return replace(building, typed="", sentence="")
    return _standing(building, future[-1], (*past, building.draft), future[:-1])


def _standing(
    building: Building, draft: Draft, past: tuple[Draft, ...], future: tuple[Draft, ...]
) -> Building:
    """Return the building with another draft, what is chosen still so if it is in it."""
    chosen = building.chosen if building.chosen in set(draft.things()) else None
    return choosing(replace(building, draft=draft, past=past, future=future), chosen)
