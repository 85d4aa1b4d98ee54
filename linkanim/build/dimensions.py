"""The numbers of the chosen thing: what they are called, and digits typed for one of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import atan2, degrees, hypot, nan
from typing import Any

from linkanim.build.building import Building, changed, refused
from linkanim.build.draft import DRIVE, JOINT, Draft, Thing
from linkanim.build.places import crank_of, fitted, lengths_within, round_number, with_number
from linkanim.errors import BadInput
from linkanim.scenes import file_form
from linkanim.scenes.editing import Dimension, dimension_of, written
from linkanim.scenes.form import LENGTHS, OFFSET, Context, Field, Form, Key, Table

_FORMS: Mapping[str, Form] = {
    "bars": Form((file_form.CRANK.field("length"),)),
    "points": file_form.BODY_POINT,
    "guides": file_form.LINE,
    "slots": Form((file_form.SLOT.field("offset"),)),
    "yokes": Form((file_form.SLIDE.field("slot"),)),
    "gears": file_form.GEAR,
    "springs": file_form.SPRING,
    "dampers": file_form.DAMPER,
    "drive": file_form.DRIVE,
}
"""What may be said of each kind, as a scene file has it."""
_UNITS = {"angle": "deg", "speed": "rpm", "stiffness": "N/m", "damping": "N s/m", "ratio": ""}
_LONGEST = 40


def numbers_of(draft: Draft, thing: Thing | None) -> tuple[Dimension, ...]:
    """Return the numbers of a thing, the first of them the one that is meant by digits typed.

    Those of a joint are what is said of it as a pin, a point, a yoke or a geared crank, then its guide's
    and the drive's where it is driven. A `value` is NaN where nothing is stated yet. `key` leads to it.
    """
    return tuple(_dimension(draft, key, one) for key, one in _fields(draft, thing))


def write(building: Building, text: str) -> Building:
    """Return the building with text added to what is being typed; after a refusal it is typed anew."""
    typed = "" if building.is_refusal else building.typed
    return replace(building, typed=(typed + text)[:_LONGEST], sentence="", is_refusal=False)


def erase(building: Building) -> Building:
    """Return the building with the last typed character gone."""
    return replace(building, typed=building.typed[:-1], sentence="", is_refusal=False)


def choose_number(building: Building, further: int) -> Building:
    """Return the building with another number of the chosen thing as the one that is typed."""
    count = len(numbers_of(building.draft, building.chosen))
    return replace(building, row=(building.row + further) % count if count else 0, typed="", sentence="")


def take(building: Building) -> Building:
    """Return the building with what was typed as the chosen number; or the same, and why it is refused.

    What has no unit is in the draft's, in degrees or in the unit of the number before. The next number is
    then the one that is typed.
    """
    draft, fields = building.draft, list(_fields(building.draft, building.chosen))
    if not fields or not building.typed.strip():
        return refused(building, "Choose what has a length or an angle, then type it")
    key, one = fields[building.row % len(fields)]
    try:
        value = written(building.typed, _dimension(draft, key, one))
        _refuse(draft, key, one, value)
    except BadInput as error:
        return replace(building, sentence=str(error), is_refusal=True)
    draft = _with_polar(draft, key)
    draft = replace(with_number(draft, key, value), typed=draft.typed | {key})
    return replace(changed(building, fitted(draft), building.chosen), row=(building.row + 1) % len(fields))


def _fields(draft: Draft, thing: Thing | None) -> Iterator[tuple[Key, Field]]:
    """Yield the fields of a thing that are numbers, with their keys.

    Those of a fixed pin are x and y, then its distance and direction from the origin.
    """
    if thing is None:
        return
    kind, name = thing
    if kind == JOINT:
        if name in draft.of("pins"):
            yield from ((("pins", name, part), file_form.PLACE) for part in (0, 1))
            yield from ((("pins", name, one.key), one) for one in file_form.POLAR_PIN.fields)
        for own in ("points", "yokes", "gears"):
            if name in draft.of(own):
                yield from _of_form(_FORMS[own], draft.of(own)[name], (own, name))
        if name in draft.of("sliders"):
            yield from _fields(draft, ("guides", draft.of("sliders")[name]["guide"]))
        if name == draft.driven:
            yield from _fields(draft, DRIVE)
    elif kind in _FORMS and name in draft.of(kind):
        yield from _of_form(_FORMS[kind], draft.of(kind)[name], thing)
        if kind == "bars" and _is_crank(draft, name):
            yield from reversed(list(_fields(draft, DRIVE)))


def _is_crank(draft: Draft, name: str) -> bool:
    """Tell whether a bar is the crank that is driven."""
    driven = draft.driven
    return driven is not None and {driven, crank_of(draft, driven)} == set(draft.ends(name))


def _of_form(form: Form, table: Mapping[str, Any], key: Key) -> Iterator[tuple[Key, Field]]:
    for one in form.fields:
        if isinstance(one.type, Form) and one.key in table:
            yield from _of_form(one.type, table[one.key], (*key, one.key))
        elif one.plain and one.plain.measure and one.key == "at":
            yield from (((*key, one.key, part), one) for part in (0, 1))
        elif one.plain and one.plain.measure and not ("slider" in table and one.key == "start"):
            yield (*key, one.key), one


def _dimension(draft: Draft, key: Key, one: Field) -> Dimension:
    """Return a number as it stands, with what it is called; NaN where nothing is stated, nor usual."""
    assert one.plain
    assert one.plain.measure
    stated = _stated(draft, key)
    if stated is None and isinstance(one.usual, str | int):
        stated = one.usual
    if stated is not None:
        return dimension_of(key, _label(one, key), one.plain, stated, draft.unit)
    unit = draft.unit if one.plain.measure in LENGTHS else _UNITS[one.plain.measure]
    return Dimension(key, _label(one, key), nan, unit, one.plain.measure, one.plain.bare)


def _stated(draft: Draft, key: Key) -> Any:
    """Return what stands at a key; of a fixed pin also what is not written, but follows; else None."""
    table: Any = draft.of(str(key[0])).get(str(key[1]))
    if key[0] == "pins":
        x, y = draft.places[str(key[1])]
        angle = f"{round_number(degrees(atan2(y, x)), 0.0)} deg"
        derived = {0: x, 1: y, "length": hypot(x, y), "angle": angle}
        own = table if isinstance(table, Mapping) else dict(enumerate(table))
        return {**derived, **own}[key[2]]
    for part in key[2:]:
        table = table[part] if isinstance(part, int) else table.get(part)
    return table


def _label(one: Field, key: Key) -> str:
    """Return what a number is called, in short: "length", "along", "x"."""
    part = key[-1]
    if isinstance(part, int):
        return ("x", "y")[part] if key[0] == "pins" else ("along", "to the left")[part]
    return {"length": "length", "angle": "direction"}.get(part) or part.replace("_", " ")


def _with_polar(draft: Draft, key: Key) -> Draft:
    """Return the draft with a fixed pin written the way in which one of its numbers is typed."""
    if key[0] != "pins":
        return draft
    name, pin = str(key[1]), draft.of("pins")[str(key[1])]
    names = (0, 1) if isinstance(key[2], int) else ("length", "angle")
    if isinstance(pin, Mapping) == (names != (0, 1)):
        return draft
    values = [_stated(draft, (*key[:2], part)) for part in names]
    return draft.having("pins", name, values if names == (0, 1) else dict(zip(names, values, strict=True)))


def _refuse(draft: Draft, key: Key, one: Field, value: object) -> None:
    """Raise where a value cannot stand at a key, with what a scene file's reader says of it."""
    assert one.plain
    part, plain = _label(one, key), OFFSET if isinstance(key[-1], int) else one.plain
    holder = Table(str(key[1]), {part: value}, (), Context(draft.unit))
    plain.read(holder, part)
    if key[0] == "bars" and key[1] in lengths_within(draft):
        first, second = draft.ends(str(key[1]))
        raise holder.wrong(f"{first} and {second} are points of one body: move one to set their distance")
    if key[-2:-1] == ("at",) and value == 0 and _stated(draft, (*key[:-1], 1 - int(key[-1]))) == 0:
        raise holder.wrong("lies on the axis' first joint itself; give a place beside it")
