"""From a scene back to a draft: each of its joints taken apart into what a hand would have drawn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from linkanim.build.building import Building
from linkanim.build.draft import DRIVE, Draft
from linkanim.build.naming import numbered
from linkanim.build.photo import photo_of
from linkanim.build.shorthand import table_of
from linkanim.mechanics.linkage.dyads import RRP, RRR
from linkanim.scenes.fields.shorthands import SHORTHANDS
from linkanim.scenes.scene import Scene

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
