"""The whole scene file: its tables, and the fields of those that are not joints."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple, get_args

from linkanim import units
from linkanim.bounds import LONGEST_TEXT
from linkanim.intake import unnameable
from linkanim.mechanics.linkage.linkage import Body, Damper, Spring
from linkanim.mechanics.linkage.rigid_bodies import coincide, holding
from linkanim.scenes.fields.drive import INPUT
from linkanim.scenes.fields.form import Field, Named, form
from linkanim.scenes.fields.joints import JOINTS, PINS, aside
from linkanim.scenes.fields.purposes import PURPOSES
from linkanim.scenes.fields.shorthands import SHORTHANDS
from linkanim.scenes.fields.table import Table
from linkanim.scenes.fields.types import (
    ANGLE,
    COLOUR,
    DAMPING,
    GRAVITY,
    INERTIA,
    JOINT,
    LENGTH,
    MASS,
    PAIR,
    POINT,
    STIFFNESS,
    TEXT,
    TEXTS,
    choice,
)
from linkanim.scenes.fields.types import JOINTS as MEMBERS
from linkanim.scenes.scene import Block, BodyStyle, Outline


def _refuse_block(table: Table, values: Mapping[str, Any]) -> None:
    slider = table.context.joints.get(values["slider"])
    if slider and not slider.travels:
        raise table.error("slider", "does not travel on a line; name a joint that has one")


def _refuse_bar(table: Table, values: Mapping[str, Any]) -> None:
    """Refuse a body that is none: too few joints, not on one rigid body, or two in one point."""
    _refuse_radius(table, values)
    members, frames = values["joints"], table.context.rigid
    if len(members) < 2:
        raise table.error("joints", "must name two joints or more; a body's angle is that of first -> second")
    if not all(name in table.context.joints for name in members):
        return
    n = holding(frames, members)
    if n is None:
        raise table.error("joints", f"{', '.join(members)} are not joints of one rigid body")
    first, second, *_ = members
    if coincide(frames[n], first, second):
        raise table.error("joints", f"{first} and {second} are one point; name another first or second")
    if "mass" in values and "com" not in values:
        half = abs(frames[n][second] - frames[n][first]) / 2
        halfway = f"com = [{half:g}, 0] is halfway from {first} to {second}"
        raise table.error("mass", f"needs to be known where it is; {halfway}")


def _refuse_radius(table: Table, values: Mapping[str, Any]) -> None:
    if "radius" in values and values.get("look") not in ("wheel", "railwheel"):
        raise table.error("radius", 'is that of a wheel; write look = "wheel" beside it, or leave it out')


def _refuse_half(table: Table, values: Mapping[str, Any]) -> None:
    if ("stiffness" in values) != ("free_length" in values):
        raise table.wrong("a force needs both stiffness and free_length; give both, or neither")


class DrawnBody(NamedTuple):
    """A body as a file states it: what moves, and how it is drawn."""

    body: Body
    style: BodyStyle


def _drawn(
    name: str,
    look: Outline | Block | None = None,
    colour: Any = None,
    radius: float | None = None,
    **known: Any,
) -> DrawnBody:
    return DrawnBody(Body(name, **known), BodyStyle(look, colour, radius))


_MASS = Field("mass", MASS, "its mass", None, label="mass")
_COLOUR = Field("colour", COLOUR, "its colour", None)
_BETWEEN = Field("between", PAIR, "its two ends")
_COM = aside("{name} centre of mass")

BLOCK = form(
    "the block of a slider",
    Field("slider", JOINT, "the joint that it travels with"),
    _MASS,
    Field("look", choice(*get_args(Block)), "how it is drawn", None),
    _COLOUR,
    mark="slider",
    refuse=_refuse_block,
    make=_drawn,
)
BAR = form(
    "a body",
    Field("joints", MEMBERS, "the joints on it; its angle is that of the first to the second"),
    Field("com", POINT, "its centre of mass along first–second, and to the left", None, label=_COM),
    _MASS,
    Field("inertia", INERTIA, "about the centre of mass", None, label="moment of inertia"),
    Field("look", choice(*get_args(Outline)), "how it is drawn", None),
    Field("radius", LENGTH, "of a wheel, else out to its furthest joint", None, label="wheel's radius"),
    _COLOUR,
    refuse=_refuse_bar,
    together={"mass": "com"},
    make=_drawn,
)
SPRING = form(
    "a spring",
    _BETWEEN,
    Field("stiffness", STIFFNESS, "its stiffness; with it the force is known", None, label="stiffness"),
    Field("free_length", LENGTH, "its length without force", None, label="free length"),
    refuse=_refuse_half,
    together={"stiffness": "free_length", "free_length": "stiffness"},
    make=Spring,
)
_COEFFICIENT = Field("coefficient", DAMPING, "its force by its rate", None, label="damping coefficient")
DAMPER = form("a damper", _BETWEEN, _COEFFICIENT, make=Damper)


def _picture(table: Table, key: str) -> str:
    """Read the path of a picture, which need not be there; one that no disk can hold is refused."""
    file = table.text(key)
    if reason := unnameable(file):
        raise table.error(key, f"{reason}; rename the picture")
    return file


_PICTURE = replace(
    TEXT,
    read=_picture,
    schema={
        "type": "string",
        "maxLength": LONGEST_TEXT,
        "pattern": r"^(?=.*\S)([^/\\]{0,255}[/\\])*[^/\\]{0,255}$",
    },
)
PHOTO = form(
    "a photograph to build over, behind the sheet",
    Field("file", _PICTURE, "its path from the scene file's folder"),
    Field("place", replace(POINT, measure=None), "x and y of its lower left corner"),
    Field("width", replace(LENGTH, measure=None), "how wide it is"),
    Field("turn", replace(ANGLE, measure=None), "by what angle it is turned about that corner", "0 deg"),
)
TRACE = form("the curves", Field("joints", MEMBERS, "the joints whose curves are drawn", None))

SCENE_FILE = form(
    "the file",
    Field("title", TEXT, "what it is called: the file's name", None),
    Field("source", TEXT, "where its dimensions come from", ""),
    Field("chapter", TEXT, "the part of a collection that it belongs to", ""),
    Field("look_at", TEXT, "what to watch for, in a sentence", ""),
    Field("notes", TEXTS, "what a reader of its figures should know", []),
    Field("length_unit", choice(*units.LENGTH_UNITS), "the unit of bare lengths", units.LENGTH_UNITS[0]),
    *(Field(key, one, one.words, None) for key, one in SHORTHANDS.items()),
    Field("joints", JOINTS, "the joints", {}),
    Field("ground", PINS, "the fixed pins", {}),
    Field("bodies", Named((BLOCK, BAR)), "what is drawn and named", {}),
    Field("springs", Named((SPRING,)), "the springs", {}),
    Field("dampers", Named((DAMPER,)), "the dampers", {}),
    Field("gravity", GRAVITY, "how fast masses fall, down", None, label="Gravity"),
    INPUT,
    Field("trace", TRACE, "the curves", {}),
    *(Field(key, one, one.words, None) for key, one in PURPOSES.items()),
    Field("photo", PHOTO, "a photograph to build over", None),
)
"""The form of a scene file."""
SECTIONS: Mapping[str, Field] = {one.key: one for one in SCENE_FILE.fields}
