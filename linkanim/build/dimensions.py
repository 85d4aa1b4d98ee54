"""The properties of the chosen thing: its numbers, its name, how it is drawn; and text typed for them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from math import atan2, degrees, hypot, nan
from typing import Any, NamedTuple

from linkanim.build.building import Building, changed, refused
from linkanim.build.draft import DRIVE, JOINT, Draft, Thing, body_name, renamed
from linkanim.build.places import crank_of, fitted, lengths_within, place_of, round_number, with_number
from linkanim.errors import BadInput
from linkanim.scenes import file_form
from linkanim.scenes.editing import Dimension, dimension_of, written
from linkanim.scenes.form import LENGTH, LENGTHS, NAME, OFFSET, Context, Field, Form, Key, Table
from linkanim.units import is_quantity, shown
from linkanim.words import said

_FORMS: Mapping[str, Form] = {
    "bars": Form((file_form.CRANK.field("length"),)),
    "points": file_form.BODY_POINT,
    "guides": file_form.LINE,
    "slots": Form((file_form.SLOT.field("offset"),)),
    "yokes": Form((file_form.SLIDE.field("slot"),)),
    "gears": file_form.GEAR,
    "springs": file_form.SPRING,
    "dampers": file_form.DAMPER,
    "drive": Form(tuple(one for one in file_form.DRIVE.fields if one not in file_form.MOTOR_OF_POINTS)),
    "drives": Form(tuple(one for one in file_form.FURTHER.fields if one.key in ("speed", "start"))),
}
"""The properties that each kind may have, in the form of a scene file."""
_UNITS = {"angle": "deg", "speed": "rpm", "stiffness": "N/m", "damping": "N s/m", "ratio": ""}
_UNITS |= {"mass": "kg", "inertia": "kg m^2"}
_NAME = Field("name", NAME)
_COLOURS = {
    **{"red": "#d55e00", "blue": "#0072b2", "green": "#009e73", "orange": "#e69f00", "sky": "#56b4e9"},
    **{"purple": "#cc79a7", "grey": "#8c939f", "black": "#20242c"},
}
"""Colours by their names."""
_NOTHING = ("-", "–")
"""Texts that, when typed, remove a property."""
_LONGEST = 40


class PropertyRow(NamedTuple):
    """A property of the chosen thing: its label, and its value as text, "" where it is not stated.

    `number` is the value as a number, if it is one: its `value` is NaN where nothing is stated. Other
    properties have `options` to choose from. `key` is its path into the draft.
    """

    key: Key
    label: str
    words: str = ""
    number: Dimension | None = None
    options: tuple[str, ...] = ()


def rows_of(draft: Draft, thing: Thing | None) -> tuple[PropertyRow, ...]:
    """Return the properties of a thing; digits that are typed are for the first.

    A joint has those of a pin, a point, a yoke or a geared crank, then its guide's, the drive's where it is
    driven, its block's, and its name. A bar has its length, and those of its body: mass and centre of mass,
    look, colour, name.
    """
    return tuple(_row(draft, key, one) for key, one in _fields(draft, thing))


def _row(draft: Draft, key: Key, one: Field) -> PropertyRow:
    assert one.plain
    if one.plain.measure:
        number = _dimension(draft, key, one)
        return PropertyRow(key, number.label, number=number)
    stated = str(key[1]) if one is _NAME else str(_stated(draft, key) or "")
    words = next((name for name, colour in _COLOURS.items() if colour == stated.lower()), stated)
    options = tuple(_COLOURS) if one.key == "colour" else one.plain.options
    return PropertyRow(key, _label(one, key), words, options=options)


def write(building: Building, text: str) -> Building:
    """Return the building with text added to the typed text, which begins anew after a refusal.

    Letters are taken only where the user chose a row that is no number: until then letters are tools.
    """
    row = _chosen_row(building)
    if row and row.number is None and not building.lettered:
        return refused(
            building, said("Choose its {label} among the rows, then type it", label=said(row.label))
        )
    typed = "" if building.is_refusal else building.typed
    return replace(building, typed=(typed + text)[:_LONGEST], sentence="", is_refusal=False)


def erase(building: Building) -> Building:
    """Return the building with the last typed character gone."""
    return replace(building, typed=building.typed[:-1], sentence="", is_refusal=False)


def choose_number(building: Building, further: int) -> Building:
    """Return the building with another number of the chosen thing as the one that is typed."""
    rows = rows_of(building.draft, building.chosen)
    if not rows:
        return replace(building, row=0, typed="", sentence="")
    place = (building.row + further) % len(rows)
    row, how = rows[place], ""
    if row.options:
        how = said(
            "{property}: {options}; type one, or click again for the next",
            property=said(row.label).capitalize(),
            options=", ".join(row.options),
        )
    elif row.number is None:
        how = said("Type another {label}, then Enter", label=said(row.label))
    bare = replace(building, row=place, typed="", sentence=how, is_refusal=False)
    return replace(bare, lettered=row.number is None)


def next_option(building: Building) -> Building:
    """Return the building with the next option of its chosen row; after the last one, without a value."""
    row = _chosen_row(building)
    if row is None or not row.options:
        return building
    follows = dict(zip(("", *row.options), (*row.options, _NOTHING[0]), strict=True))
    place, after = building.row, accept(replace(building, typed=follows.get(row.words, row.options[0])))
    return replace(choose_number(replace(after, row=place), 0), is_refusal=after.is_refusal)


def typed_length(building: Building, now: float) -> float:
    """Return the typed length that replaces `now`, in the draft's unit; BadInput where it is no length."""
    unit = building.draft.unit
    value = written(building.typed, Dimension((), "distance", now, unit, "length", bare=True))
    return float(LENGTH.read(Table("photograph", {"distance": value}, (), Context(unit)), "distance"))


def _chosen_row(building: Building) -> PropertyRow | None:
    rows = rows_of(building.draft, building.chosen)
    return rows[building.row % len(rows)] if rows else None


def accept(building: Building) -> Building:
    """Return the building with the typed text in the chosen row; or the same one, and why it is refused.

    A number without a unit is in the draft's unit, in degrees, or in the unit of the old value. With a unit
    that the chosen row does not take it is for the next row that takes it: of a crank, "10 rad/s" is its
    speed. The next number is then the one to be typed.
    """
    draft, fields = building.draft, list(_fields(building.draft, building.chosen))
    if not fields or not building.typed.strip():
        return refused(building, said("Choose what has a length or an angle, then type it"))
    building = replace(building, row=_row_for(building, fields))
    key, one = fields[building.row]
    assert one.plain
    try:
        if one is _NAME:
            after = _named(building, key, building.typed.strip())
        elif key[0] == "bodies" and building.typed.strip() in _NOTHING:
            after = changed(building, _without(draft, key), building.chosen)
        else:
            after = _accepted(building, key, one)
    except BadInput as error:
        return replace(building, sentence=str(error), is_refusal=True)
    if building.made.scene and after.made.scene is None:
        return (
            replace(building, sentence=after.made.missing, is_refusal=True)
            if one.plain.measure is None
            else after
        )
    return replace(after, row=(building.row + 1) % len(fields))


def _row_for(building: Building, fields: list[tuple[Key, Field]]) -> int:
    """Return the place of the row that the typed text is for: the chosen one, but for a unit of others."""
    if is_quantity(building.typed):
        for row in (at % len(fields) for at in range(building.row, building.row + len(fields))):
            key, one = fields[row]
            if one.plain and one.plain.measure:
                value = written(building.typed, _dimension(building.draft, key, one))
                with suppress(BadInput):
                    _refuse(building.draft, key, one, value)
                    return row
    return building.row % len(fields)


def _accepted(building: Building, key: Key, one: Field) -> Building:
    """Return the building with the typed text at a key; BadInput where it is not allowed there."""
    assert one.plain
    draft, text = _with_body(building, key), building.typed.strip()
    value: object = text if one.plain.options else _COLOURS.get(text.lower(), f"#{text.removeprefix('#')}")
    if one.plain.measure:
        value = written(building.typed, _dimension(draft, key, one))
    _refuse(draft, key, one, value)
    draft = with_number(_with_polar(draft, key), key, value)
    if one.plain.measure and key[0] != "bodies":
        draft = replace(draft, typed=draft.typed | {key})
    return changed(building, fitted(_with_centre(draft, key)), building.chosen)


def _named(building: Building, key: Key, name: str) -> Building:
    """Return the building with a joint, a body, a spring or a damper renamed; BadInput as above."""
    draft, (kind, old) = _with_body(building, key), (str(key[0]), str(key[1]))
    taken = draft.places if kind == JOINT else draft.of(kind)
    holder = Table(old, {"name": name}, (), Context(draft.unit))
    NAME.read(holder, "name")
    if is_quantity(name):
        raise holder.error("name", f"is a value, which {shown(old)} does not have; choose what has one")
    if name in taken and name != old:
        raise holder.error("name", f"is that of another one; {shown(old)} needs one of its own")
    chosen = (kind, name) if building.chosen == (kind, old) else building.chosen
    after = renamed(draft, kind, old, name)
    if kind == JOINT and chosen and chosen[0] in ("bars", "slots"):
        chosen = None
    return changed(building, after, chosen, said("{old} is {name} now", old=old, name=name))


def _with_body(building: Building, key: Key) -> Draft:
    """Return the draft with a body for the chosen bar where that has none of its own yet."""
    draft, chosen = building.draft, building.chosen
    if key[0] != "bodies" or key[1] in draft.of("bodies") or chosen is None:
        return draft
    own = {"joints": draft.ends(chosen[1])} if chosen[0] == "bars" else {"slider": chosen[1]}
    return draft.having("bodies", str(key[1]), own)


def _with_centre(draft: Draft, key: Key) -> Draft:
    """Return the draft with a centre of mass for a body without one, midway between its first two joints."""
    body = draft.of("bodies").get(str(key[1]), {}) if key[0] == "bodies" else {}
    if "mass" not in body or "joints" not in body or "com" in body:
        return draft
    start, end = (place_of(draft, joint) for joint in body["joints"][:2])
    return draft.having("bodies", str(key[1]), {**body, "com": [round_number(abs(end - start) / 2, 0.0), 0]})


def _without(draft: Draft, key: Key) -> Draft:
    """Return the draft without the value at a key of a body, and without values that need it."""
    gone = {str(key[2])} | ({"mass", "com", "inertia"} if key[2] in ("mass", "com") else set())
    body = draft.of("bodies").get(str(key[1]), {})
    remaining = {part: value for part, value in body.items() if part not in gone}
    return draft.having("bodies", str(key[1]), remaining or None)


def _fields(draft: Draft, thing: Thing | None) -> Iterator[tuple[Key, Field]]:
    """Yield the fields of a thing that are numbers, with their keys.

    A fixed pin has x and y, then its distance and direction from the origin.
    """
    if thing is None:
        return
    kind, name = thing
    if kind == JOINT:
        if name in draft.of("pins"):
            yield from ((("pins", name, part), file_form.PLACE) for part in (0, 1))
            yield from ((("pins", name, one.key), one) for one in file_form.POLAR_PIN.fields)
        for own in ("points", "yokes", "gears", "drives"):
            if name in draft.of(own):
                yield from _of_form(_FORMS[own], draft.of(own)[name], (own, name))
        if name in draft.of("sliders"):
            yield from _fields(draft, ("guides", draft.of("sliders")[name]["guide"]))
        if name == draft.driven:
            yield from _fields(draft, DRIVE)
        if name in draft.of("sliders"):
            yield from _of_body(draft, {"slider": name})
        yield (JOINT, name, "name"), _NAME
    elif kind in _FORMS and name in draft.of(kind):
        yield from _of_form(_FORMS[kind], draft.of(kind)[name], thing)
        if kind == "bars" and _is_crank(draft, name):
            yield from reversed(list(_fields(draft, DRIVE)))
        if kind == "bars":
            yield from _of_body(draft, {"joints": draft.ends(name)})
        if kind in ("springs", "dampers"):
            yield (*thing, "name"), _NAME


def _of_body(draft: Draft, own: Mapping[str, Any]) -> Iterator[tuple[Key, Field]]:
    """Yield the fields of the body of a bar's joints, or of a block, as far as they apply."""
    bodies = draft.of("bodies")
    if "slider" in own:
        name = next((name for name, one in bodies.items() if one.get("slider") == own["slider"]), None)
    else:
        name = draft.body_of(own["joints"])
    name = name or body_name(draft)
    table, form = bodies.get(name, own), file_form.BLOCK if "slider" in own else file_form.BAR
    fields = {one.key: one for one in form.fields}
    parts = ["mass", *(["com", "inertia"] if "mass" in table else []), "look", "colour"]
    if table.get("look") in ("wheel", "railwheel"):
        parts.insert(-1, "radius")
    for part in (part for part in parts if part in fields):
        key, one = ("bodies", name, part), fields[part]
        yield from (((*key, n), one) for n in (0, 1)) if part == "com" else [(key, one)]
    yield ("bodies", name, "name"), _NAME


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
        elif one.plain and one.plain.measure and (one.key != "start" or not {"slider", "motor"} & {*table}):
            yield (*key, one.key), one


def _dimension(draft: Draft, key: Key, one: Field) -> Dimension:
    """Return a number's dimension with its label; its value is NaN where there is none, nor a usual one."""
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
    """Return the value at a key; for a fixed pin also one that follows from the written ones; else None."""
    table: Any = draft.of(str(key[0])).get(str(key[1]), {} if key[0] == "bodies" else None)
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
    """Return a number's short label: "length", "along", "x"."""
    part = key[-1]
    if isinstance(part, int):
        where = ("along", "to the left")[part]
        return ("x", "y")[part] if key[0] == "pins" else f"mass {where}" if key[-2] == "com" else where
    if part == "name" and key[0] == "bodies":
        return "link's name"
    return {"length": "length", "angle": "direction"}.get(part) or part.replace("_", " ")


def _with_polar(draft: Draft, key: Key) -> Draft:
    """Return the draft with a fixed pin written by x and y, or polar, as one of its numbers needs it."""
    if key[0] != "pins":
        return draft
    name, pin = str(key[1]), draft.of("pins")[str(key[1])]
    names = (0, 1) if isinstance(key[2], int) else ("length", "angle")
    if isinstance(pin, Mapping) == (names != (0, 1)):
        return draft
    values = [_stated(draft, (*key[:2], part)) for part in names]
    return draft.having("pins", name, values if names == (0, 1) else dict(zip(names, values, strict=True)))


def _refuse(draft: Draft, key: Key, one: Field, value: object) -> None:
    """Raise the error of the scene files' reader where a value is not allowed at a key."""
    assert one.plain
    part, plain = _label(one, key), OFFSET if isinstance(key[-1], int) else one.plain
    holder = Table(str(key[1]), {part: value}, (), Context(draft.unit))
    plain.read(holder, part)
    if key[0] == "bars" and key[1] in lengths_within(draft):
        first, second = draft.ends(str(key[1]))
        raise holder.wrong(
            said(
                "{first} and {second} are points of one body: move one to set their distance",
                first=first,
                second=second,
            )
        )
    if key[-2:-1] == ("at",) and value == 0 and _stated(draft, (*key[:-1], 1 - int(key[-1]))) == 0:
        raise holder.wrong(said("lies on the axis' first joint itself; give a place beside it"))
