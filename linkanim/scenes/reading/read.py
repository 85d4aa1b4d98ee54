"""The document in a scene file to a checked `Scene`, or to all that is wrong with it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from linkanim import units
from linkanim.errors import AssemblyError, BadInput
from linkanim.mechanics.linkage.joint import Joint
from linkanim.mechanics.linkage.linkage import Body, Linkage
from linkanim.mechanics.linkage.pins import Pin
from linkanim.scenes.fields.drive import read_drive
from linkanim.scenes.fields.purposes import PURPOSES
from linkanim.scenes.fields.scene_file import SCENE_FILE, SECTIONS
from linkanim.scenes.fields.shorthands import SHORTHANDS, Expansion, names_of
from linkanim.scenes.fields.table import Context, Table
from linkanim.scenes.reading.joints import solved, unassembled
from linkanim.scenes.reading.sizes import refuse_apart
from linkanim.scenes.scene import FREE_STYLE, Scene

Check = Callable[[Scene], None]
"""Raises what refuses a scene that is whole but not yet put together."""


def scene_from(
    document: Mapping[str, Any],
    *,
    name: str,
    where: str,
    towards: Scene | None = None,
    check: Check | None = None,
) -> Scene:
    """Return the scene that a document describes, put together.

    `where` names the file in errors. Lengths come out in the document's `length_unit` (mm if it has none),
    angles in radians; joints in the order in which they can be solved. SceneError for whatever is unknown,
    missing or contradictory; AssemblyError for lengths that cannot be assembled. `towards` is the scene that
    this one is on the way to, where it is shown for an instant; `check` may refuse it before it is whole.
    """
    scene, problems = read(document, name=name, where=where, towards=towards, check=check)
    if scene is None or problems:
        raise problems[0]
    return scene


def read(
    document: Mapping[str, Any],
    *,
    name: str,
    where: str,
    towards: Scene | None = None,
    check: Check | None = None,
) -> tuple[Scene | None, list[BadInput]]:
    """Return the scene that a document describes, None where it describes none, and all its problems.

    What can only follow from another problem is not among them: of what hangs on a joint with a fault only
    its own table is looked at, and what is put together only where every joint is sound.
    """
    top = _opened(document, where)
    top, short = _with_joints(top)
    bodies = _part(top, "bodies") or {}
    parts = {
        "linkage": _linkage(top, short, {name: one and one.body for name, one in bodies.items()}),
        "title": _part(top, "title") if "title" in top else name,
        **{key: _part(top, key) for key in ("source", "chapter", "look_at", "notes")},
        "trace": _trace(top, short),
    }
    if "photo" in top:
        _part(top, "photo")
    purposes = [key for key in PURPOSES if key in top]
    if len(purposes) > 1:
        reason = (
            f"was made for one thing, not for [{purposes[0]}] and [{purposes[1]}]; keep one of the tables"
        )
        top.context.problems.append(top.wrong(reason))
    purpose = _part(top, purposes[0]) if purposes else None
    if any(part is None for part in parts.values()):
        return None, top.context.problems
    styles = tuple((name, one.style) for name, one in bodies.items() if one and one.style != FREE_STYLE)
    parts |= {"purpose": purpose, "styles": styles, "document": document, "towards": towards}
    scene = Scene(name=name, length_unit=top.context.unit, **parts)
    top.attempt(_check_assembly, top, scene, check)
    return scene, top.context.problems


def _part(top: Table, key: str) -> Any:
    """Return what one of the file's tables or values comes to; None where it has a fault."""
    return top.attempt(SECTIONS[key].read, top)


def _opened(document: Mapping[str, Any], where: str) -> Table:
    """Return the file's table, its unit and the names of its joints known; unknown keys are problems."""
    top = Table(where, document)
    unit = _part(top, "length_unit") or "mm"
    top.refuse_unknown(SCENE_FILE.keys)
    names = [*_shorthand_names(top), *_names(document.get("ground")), *_names(document.get("joints"))]
    context = Context(unit, tuple(dict.fromkeys(names)), problems=top.context.problems)
    return replace(top, context=context)


def _names(section: object) -> list[str]:
    return list(section) if isinstance(section, Mapping) else []


def _shorthand_names(top: Table) -> list[str]:
    """Return the names of the joints that a shorthand states; all that it may state where it is no table."""
    stated = {key: top.values[key] for key in SHORTHANDS if key in top}
    tables = (
        (key, table if isinstance(table, Mapping) else SHORTHANDS[key].keys) for key, table in stated.items()
    )
    return [name for key, table in tables for name in names_of(key, table)]


def _with_joints(top: Table) -> tuple[Table, Expansion]:
    """Return the file's table with its sound joints known, and what its shorthand stands for."""
    pins = _part(top, "ground") or {}
    short = top.attempt(_expansion, top, pins.get("O2", Pin("O2", (0.0, 0.0))))
    moving = _part(top, "joints") or {}
    if not (any(key in top for key in SHORTHANDS) or "joints" in top):
        reason = f"describes no linkage; give it [joints], or one of {', '.join(SHORTHANDS)}"
        top.context.problems.append(top.wrong(reason))
    expanded: dict[str, Joint | None] = dict.fromkeys(_shorthand_names(top))
    if short:
        expanded = {joint.name: joint for joint in short.joints}
    return solved(top, expanded, pins, moving), short or Expansion()


def _expansion(top: Table, o2: Pin | None) -> Expansion | None:
    """Return what the file's shorthand stands for about its first pin; nothing of a file that has none."""
    found = [key for key in SHORTHANDS if key in top]
    if len(found) > 1:
        raise top.wrong(f"has both [{found[0]}] and [{found[1]}]; keep one, write the other as [joints]")
    if not found:
        return Expansion()
    expansion: Expansion | None = SHORTHANDS[found[0]].made(top.table(found[0]), o2 or Pin("O2", (0.0, 0.0)))
    return expansion if o2 else None


def _linkage(top: Table, short: Expansion, stated: Mapping[str, Any]) -> Linkage | None:
    """Return the linkage; None where any part of it has a fault."""
    context = top.context
    bodies: dict[str, Any] = {body.name: body for body in short.bodies} | dict(stated)
    drive = top.attempt(read_drive, top, short.drive)
    springs, dampers = _part(top, "springs") or {}, _part(top, "dampers") or {}
    gravity = top.attempt(_gravity, top, bodies)
    parts = (*bodies.values(), *springs.values(), *dampers.values())
    if not context.sound or drive is None or gravity is None or None in parts:
        return None
    linkage = Linkage(
        joints=tuple(context.joints.values()),
        drive=drive,
        bodies=tuple(bodies.values()),
        springs=tuple(springs.values()),
        dampers=tuple(dampers.values()),
        metre=units.metre(context.unit),
        gravity=gravity,
    )
    return top.attempt(refuse_apart, top, linkage)


def _gravity(top: Table, bodies: Mapping[str, Body | None]) -> float | None:
    """Return the scene's gravity in m/s², 0 where it states none; refused where it could pull at nothing."""
    if "gravity" not in top:
        return 0.0
    gravity: float | None = SECTIONS["gravity"].read(top)
    if all(body and body.mass is None for body in bodies.values()):
        raise top.error("gravity", 'pulls at nothing; give a body its mass, such as mass = "3 kg"')
    return gravity


def _trace(top: Table, short: Expansion) -> tuple[str, ...] | None:
    trace: Mapping[str, tuple[str, ...]] | None = _part(top, "trace")
    return None if trace is None else trace.get("joints", short.trace)


def _check_assembly(top: Table, scene: Scene, check: Check | None) -> None:
    """Refuse lengths that cannot be put together, saying in which file and table they stand."""
    try:
        if check:
            check(scene)
        _ = scene.mechanism
    except AssemblyError as error:
        section = next((key for key in SHORTHANDS if key in top), "joints")
        raise unassembled(top.table(section), str(error)) from None
