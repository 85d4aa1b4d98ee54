"""The JSON Schema of scene files, for editors: what may stand where, and of which kind it is.

What depends on several places at once (a joint that is not there, lengths that do not meet) no schema
says; `problems` does.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from linkanim import units
from linkanim.bounds import LONGEST_TEXT, MOST_NAMES
from linkanim.scenes.reading.joints import LOOKS, OPEN
from linkanim.scenes.reading.shorthand import SHORTHANDS

_NUMBER = r"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*"
_NAME: dict[str, Any] = {"type": "string", "minLength": 1, "maxLength": 32}
_TEXT = {"type": "string", "maxLength": LONGEST_TEXT}


def _quantity(names: tuple[str, ...], *, bare: bool, above: bool = False) -> dict[str, Any]:
    """Return the schema of a number with one of the units, or without where it may be bare."""
    spelt = (name.replace("/", r"\s*/\s*").replace(" ", r"\s*") for name in names)
    unit = "|".join(name.replace("^2", r"(\^?2|²)") for name in spelt)
    text = {"type": "string", "pattern": rf"{_NUMBER}({unit}{'|' if bare else ''})\s*$"}
    number = {"type": "number", **({"exclusiveMinimum": 0} if above else {})}
    return {"anyOf": [number, text]} if bare else text


def _table(required: tuple[str, ...] = (), **known: Any) -> dict[str, Any]:
    table: dict[str, Any] = {"type": "object", "additionalProperties": False, "properties": known}
    return {**table, "required": list(required)} if required else table


def _named(entry: Mapping[str, Any]) -> dict[str, Any]:
    names = {"maxLength": 32, "pattern": r"^[^.\s]([^.]*[^.\s])?$"}
    return {
        "type": "object",
        "maxProperties": MOST_NAMES,
        "propertyNames": names,
        "additionalProperties": entry,
    }


def _list(entry: Mapping[str, Any], count: int) -> dict[str, Any]:
    return {"type": "array", "items": entry, "minItems": count, "maxItems": count}


_ANGLE_TEXT = _quantity((*units.ANGLE_UNITS, "°"), bare=False)
_SPEED = _quantity((*units.SPEED_UNITS, "°/s"), bare=False)
_LENGTH = _quantity(units.LENGTH_UNITS, bare=True, above=True)
_OFFSET = _quantity(units.LENGTH_UNITS, bare=True)
_POINT = _list(_OFFSET, 2)
_PAIR = {**_list(_NAME, 2), "uniqueItems": True}
_MEMBERS = {"type": "array", "items": _NAME, "uniqueItems": True}
_RATIO = {"anyOf": [{"type": "number", "not": {"const": 0}}, {"type": "string", "pattern": r"^\s*[+-]?\d"}]}


def _choice(*options: str) -> dict[str, Any]:
    return {"enum": list(options)}


_SIDE = _choice("left", "right")
_WAY = _choice("forward", "backward")
_LINE = _table(through=_NAME, angle=_ANGLE_TEXT, offset=_OFFSET, on=_PAIR)
_GEAR = _table(("with", "ratio"), **{"with": _NAME, "ratio": _RATIO, "offset": _ANGLE_TEXT})
_SLOT = _table(("pivot", "through"), pivot=_NAME, through=_NAME, offset=_OFFSET)
_CYLINDER = _table(
    ("between", "from", "to"), **{"between": _PAIR, "from": _LENGTH, "to": _LENGTH, "joint": _NAME}
)
_TRAVEL = _table(("joint", "from", "to"), **{"joint": _NAME, "from": _OFFSET, "to": _OFFSET})
_SLIDE = _table(("pin", "line"), pin=_NAME, line=_LINE, slot=_ANGLE_TEXT)

JOINTS: Mapping[str, dict[str, Any]] = {
    "crank": _table(("crank", "length"), crank=_NAME, length=_LENGTH, gear=_GEAR),
    "line": {
        "anyOf": [
            _table(
                ("from", "length", "line"), **{"from": _NAME, "length": _LENGTH, "line": _LINE, "side": _WAY}
            ),
            _table(("line",), line=_table(("through",), through=_NAME, angle=_ANGLE_TEXT, offset=_OFFSET)),
        ]
    },
    "from": _table(("from", "length"), **{"from": _PAIR, "length": _list(_LENGTH, 2), "side": _SIDE}),
    "slot": _table(("slot", "length"), slot=_SLOT, length=_LENGTH),
    "slide": _table(("slide",), slide=_SLIDE),
    "on": _table(("on", "at"), on=_PAIR, at=_POINT),
}
"""Each kind of joint, by the key that marks it."""

_OF_SHORTHAND = {"length": _LENGTH, "angle": _ANGLE_TEXT, "offset": _OFFSET}


def _shorthand(name: str) -> dict[str, Any]:
    shorthand = SHORTHANDS[name]
    known: dict[str, Any] = {key: _OF_SHORTHAND[kind] for key, kind in shorthand.numbers.items()}
    known |= {key: _POINT for key in known if key.startswith("coupler_point")}
    known["assembly"] = _choice(*shorthand.assemblies)
    if name == "four-bar":
        known["driver"] = _choice("crank", "rocker")
    if name == "six-bar":
        known |= {"lengths": _list(_LENGTH, 8), "assembly2": _choice(*OPEN)}
    required = tuple(key for key, kind in shorthand.numbers.items() if kind == "length")
    return _table(required, **known)


_MASS = _quantity(units.MASS_UNITS, bare=False)
_INERTIA = _quantity(units.INERTIA_UNITS, bare=False)
_COLOUR = {"type": "string", "pattern": r"^#[0-9a-fA-F]{6}$"}
_BAR = _table(
    ("joints",),
    joints={**_MEMBERS, "minItems": 2},
    com=_POINT,
    mass=_MASS,
    inertia=_INERTIA,
    look=_choice(*LOOKS),
    colour=_COLOUR,
)
_BODY = {
    "anyOf": [
        {**_BAR, "dependentRequired": {"mass": ["com"]}},
        _table(("slider",), slider=_NAME, mass=_MASS, colour=_COLOUR),
    ]
}
_STIFFNESS = _quantity(units.STIFFNESS_UNITS, bare=False)
_DAMPING = _quantity(units.DAMPING_UNITS, bare=False)
_BOTH = {"stiffness": ["free_length"], "free_length": ["stiffness"]}
_SPRING = {
    **_table(("between",), between=_PAIR, stiffness=_STIFFNESS, free_length=_LENGTH),
    "dependentRequired": _BOTH,
}

_SECTIONS: dict[str, Any] = {
    **dict.fromkeys(("title", "source", "chapter", "look_at"), _TEXT),
    "notes": {"type": "array", "items": {"type": "string"}},
    "length_unit": _choice(*units.LENGTH_UNITS),
    "gravity": _quantity(units.FALL_UNITS, bare=False),
    "drive": _table(joint=_NAME, speed=_SPEED, start=_ANGLE_TEXT, cylinder=_CYLINDER, slider=_TRAVEL),
    "ground": _named({"anyOf": [_POINT, _table(("length", "angle"), length=_LENGTH, angle=_ANGLE_TEXT)]}),
    "joints": _named({"anyOf": list(JOINTS.values())}),
    "bodies": _named(_BODY),
    "springs": _named(_SPRING),
    "dampers": _named(_table(("between",), between=_PAIR, coefficient=_DAMPING)),
    "trace": _table(joints=_MEMBERS),
    **{name: _shorthand(name) for name in SHORTHANDS},
}

SCHEMA: Mapping[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "A scene of linkanim",
    **_table((), **_SECTIONS),
    "anyOf": [{"required": [key]} for key in ("joints", *SHORTHANDS)],
}
"""The schema; TOML and JSON have the same tables, lists and values."""
