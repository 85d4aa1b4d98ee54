"""Describe the form of a table of a scene file, and read it; the tables themselves are in `file_form`.

Its parts, in reading order:

- A table of a scene file, and what is known while the file is read: its joints, and the problems so far.
- The type of a value of a scene file: how it is read, its schema, and what its numbers measure.
- Fields, and the tables that they make up: what a table may state, and which value is made from it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import field, replace
from fractions import Fraction
from functools import cached_property, partial
from typing import Any, ClassVar, Literal, NamedTuple, Self, TypeVar

from linkanim import units
from linkanim.bounds import LONGEST_TEXT, MOST_NAMES, MOST_PROBLEMS
from linkanim.errors import BadInput, SceneError, UnitError
from linkanim.frozen import frozen
from linkanim.intake import Section, few, meant
from linkanim.mechanics.angles import unit
from linkanim.mechanics.linkage import Joint, RigidBody
from linkanim.units import shown

# A table of a scene file, and what is known while the file is read: its joints, and the problems so far.

Read = TypeVar("Read")


@frozen
class Context:
    """What is known of a file while it is read: its unit of length, its joints, and its problems so far.

    `names` are the names of all joints that it states. `joints` are those without a fault, in solved order,
    and `rigid` the rigid bodies that they form; both are empty before joints are read.
    """

    unit: str = "mm"
    names: tuple[str, ...] = ()
    joints: Mapping[str, Joint] = field(default_factory=dict)
    rigid: tuple[RigidBody, ...] = ()
    problems: list[BadInput] = field(default_factory=list)

    @property
    def sound(self) -> bool:
        """Whether no joint has a fault."""
        return len(self.joints) == len(self.names)


@frozen
class Table(Section):
    """One table of a scene file."""

    refusal: ClassVar[type[BadInput]] = SceneError

    context: Context = field(default_factory=Context)

    def under(self, key: str, values: Mapping[str, Any]) -> Self:
        """Return a table that stands under a key."""
        return type(self)(self.where, values, (*self.keys, key), self.context)

    def attempt(self, work: Callable[..., Read], *given: object) -> Read | None:
        """Return what the work returns; on BadInput, add that to the problems and return None."""
        try:
            return work(*given)
        except BadInput as error:
            self.context.problems.append(error)
            return None

    def refuse_unknown(self, known: Iterable[str]) -> None:
        """Add every key that is not `known` to the problems, each with the nearest known key."""
        known = tuple(dict.fromkeys(known))
        for key in self.values:
            if key not in known and len(self.context.problems) < MOST_PROBLEMS:
                reason = f"unknown key{meant(key, known)}; known here: {', '.join(known)}"
                self.context.problems.append(self.error(key, reason))

    def saying(self, values: Mapping[str, Any]) -> Self:
        """Return the table with other values."""
        return type(self)(self.where, values, self.keys, self.context)

    def entries(self) -> tuple[str, ...]:
        """Return this table's keys as names, each fit to be shown and to be part of a key."""
        if len(self.values) > MOST_NAMES:
            raise self.wrong(f"has {len(self.values):,} entries; {MOST_NAMES} are the most that are read")
        return tuple(name for name in self.values if self.attempt(self._entry, name))

    def _entry(self, name: str) -> str:
        if not 1 <= len(name) <= 32 or not name.isprintable() or "." in name or name != name.strip():
            raise self.error(name, "a name has 1 to 32 printable characters, no dot, no outer spaces")
        if name == OF_DRIVE:
            raise self.error(name, "is what the drive's own quantities are called; take another name")
        return name

    def joint(self, key: str, name: str) -> str:
        """Return a name that stands at a key if it is a joint's."""
        names = self.context.names
        if name not in names:
            raise self.error(
                key, f"no joint is called {shown(name)}{meant(name, names)}; there are {few(names)}"
            )
        return name


OF_DRIVE = "input"
"""What quantities of the drive begin with, as `input.angular_velocity`: no name in a scene."""


# The type of a value of a scene file: how it is read, its schema, and what its numbers measure.
#
# Everything else about the file's form is described in terms of these types.

Measure = Literal[
    "length",
    "angle",
    "speed",
    "offset",
    "ratio",
    "stiffness",
    "damping",
    "mass",
    "inertia",
    "gravity",
    "force",
    "torque",
]
"""What a number of a scene file measures; an "offset" is a length of either sign."""
LENGTHS: tuple[Measure, ...] = ("length", "offset")
Schema = Mapping[str, Any]

_LARGEST, _LONGEST = 1e30, 1e12
SHORTEST = 1 / _LONGEST
"""The least length of a scene file, and the least travel of an input."""
_MOST_TURNS = 100
_SMALL, _STEEP = 12, 100
_FRACTION = r"(?a)\s*([+-]?\d{1,9}(?:\.\d{1,18})?)\s*(?:/\s*(\d{1,9})\s*)?"
_HEX = r"(?ia)#[0-9a-f]{6}"
_NUMBER = r"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*"


@frozen
class ValueType:
    """The type of the value at a key, also in `words`.

    `read` reads the value from a table that has the key. `schema` is its JSON Schema, None where no value is
    allowed. `measure` is what its numbers measure, where they can be edited; where they are `bare` they need
    no unit. `options` are the texts to choose from. A type that `refers` holds names of joints. One that is
    `nested` holds such numbers in tables within its table.
    """

    read: Callable[[Table, str], Any]
    words: str
    schema: Schema | None = None
    measure: Measure | None = None
    bare: bool = False
    options: tuple[str, ...] = ()
    refers: bool = False
    nested: bool = False


def never(sentence: str) -> ValueType:
    """Return the type of a key that is known but always refused, with this sentence."""

    def read(table: Table, key: str) -> None:
        raise table.error(key, sentence)

    return ValueType(read, sentence)


def _far(number: float, unit: str, most: float = _LONGEST) -> str:
    """Say that a number of a unit is too large to be computed with, if it is."""
    return f"is beyond what can be computed; {most:g} {unit} is the most" if abs(number) > most else ""


def _not_above(number: float, unit: str, most: float = _LONGEST) -> str:
    """Say that a number of a unit is not above zero, or too large or small to be computed with, if it is."""
    if 0.0 < number < 1.0 / most:
        return f"is beyond what can be computed; {1.0 / most:g} {unit} is the least"
    return _far(number, unit, most) or ("" if number > 0.0 else "must be above zero")


def _many_turns(angle: float, _: str) -> str:
    too_many = abs(angle) > _MOST_TURNS * math.tau
    return f"is more than {_MOST_TURNS} turns; leave whole turns out" if too_many else ""


def _standstill(speed: float, _: str) -> str:
    return "" if speed else 'a speed of zero moves nothing; write "20 rpm" (or "-20 rpm", clockwise)'


def _quantity(
    measure: Measure,
    words: str,
    parse: Callable[[object, str], float],
    names: tuple[str, ...],
    refusal: Callable[[float, str], str],
    *,
    bare: bool = False,
    base: str = "",
) -> ValueType:
    """Return the type of a number with one of the units `names`, or without a unit where it may be `bare`.

    A number without a unit is read in the unit `base`; without that, in the file's unit of length.
    """

    def read(table: Table, key: str) -> float:
        try:
            number = parse(table.values[key], table.context.unit)
        except UnitError as error:
            raise table.at(f"{table.key(key)}: {error}", key) from None
        if reason := refusal(number, base or table.context.unit):
            raise table.error(key, reason)
        return number

    spelt = (name.replace("/", r"\s*/\s*").replace(" ", r"\s*") for name in names)
    unit = "|".join(name.replace("^2", r"(\^?2|²)") for name in spelt)
    text: Schema = {"type": "string", "pattern": rf"{_NUMBER}({unit}{'|' if bare else ''})\s*$"}
    number = {"type": "number", **({"exclusiveMinimum": 0} if measure == "length" else {})}
    return ValueType(read, words, {"anyOf": [number, text]} if bare else text, measure, bare)


def _with_unit(parse: Callable[[object], float]) -> Callable[[object, str], float]:
    return lambda value, _: parse(value)


def _length(value: object, unit: str) -> float:
    return units.length(value, unit=unit)


def listed(of: ValueType, count: int) -> ValueType:
    """Return the type of a list of `count` values; errors then say `length[1]`."""
    unit = ' N"' if of.measure == "force" else ""
    numbers = (f"{unit[-1:]}{number}{unit}" for number in range(10, 10 * count + 1, 10))
    example = f"[{', '.join(numbers)}]"
    several = "forces" if of.measure == "force" else "lengths"

    def read(table: Table, key: str) -> tuple[Any, ...] | None:
        value = table.values[key]
        if not isinstance(value, list) or len(value) != count:
            raise table.error(key, f"must be a list of {count} {several}, such as {example}")
        items = table.listed(key)
        values = tuple(items.attempt(of.read, items, item) for item in items.values)
        return None if None in values else values

    schema = {"type": "array", "items": of.schema, "minItems": count, "maxItems": count}
    words = of.words.replace("a length", f"{count} lengths").replace("a force", f"{count} forces")
    return ValueType(read, words, schema, of.measure, of.bare)


def _joints(count: int | None = None) -> ValueType:
    """Return the type of a list of joints, all different, `count` of them if given."""

    def read(table: Table, key: str) -> tuple[str, ...] | None:
        value = table.values[key]
        if not isinstance(value, list) or not all(isinstance(name, str) for name in value):
            raise table.error(key, f'must be a list of {count or "joint"} names, such as ["A", "B"]')
        if count is not None and len(value) != count:
            raise table.error(key, f"must name {count} joints; it names {len(value)}")
        if len(set(value)) != len(value):
            raise table.error(key, "names the same joint twice")
        return tuple(table.joint(key, name) for name in value)

    size = {"minItems": count, "maxItems": count} if count else {}
    schema = {"type": "array", "items": NAME.schema, "uniqueItems": True, **size}
    return ValueType(read, f"{count or 'a list of'} joints", schema, refers=True)


def choice(*options: str) -> ValueType:
    """Return the type of one of some texts, the first being the usual one."""
    words = " or ".join(f'`"{option}"`' for option in options)
    schema = {"enum": list(options)}
    return ValueType(lambda table, key: table.choice(key, options), words, schema, options=options)


def side(*options: str) -> ValueType:
    """Return the type of one of two texts: +1 for the first, -1 for the second."""
    of = choice(*options)
    return replace(of, read=lambda table, key: 1 - 2 * options.index(of.read(table, key)))


def _ratio(table: Table, key: str) -> Fraction:
    """Read a gear ratio, a fraction of denominator 12 at the most, from a number or from "1/3"."""
    value = table.values[key]
    exact = _fraction(value)
    if exact is None or exact == 0:
        raise table.error(key, 'must be a number other than zero, or a fraction such as "1/3"')
    near = exact.limit_denominator(_SMALL)
    if near == 0 or abs(near) > _STEEP:
        raise table.error(key, f"a gear pair turns between 1/{_SMALL} and {_STEEP} times as fast")
    if near != exact and (isinstance(value, str) or float(near) != float(value)):
        raise table.error(key, f'is not a small fraction, so the loop is long; the nearest is "{near}"')
    return near


def _fraction(value: object) -> Fraction | None:
    if isinstance(value, str):
        match = re.fullmatch(_FRACTION, value)
        bottom = int(match[2] or 1) if match else 0
        return Fraction(match[1]) / bottom if match and bottom else None
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return Fraction(value) if isinstance(value, int) or math.isfinite(value) else None


def _text(table: Table, key: str) -> str:
    """Read a text; a text of blanks alone counts as empty."""
    text = table.text(key)
    return text if text.strip() else ""


def _colour(table: Table, key: str) -> tuple[int, int, int]:
    value = table.text(key)
    if not re.fullmatch(_HEX, value):
        raise table.error(key, 'is no colour; write red, green and blue as in "#d55e00"')
    red, green, blue = bytes.fromhex(value[1:])
    return red, green, blue


LENGTH = _quantity("length", "a length", _length, units.LENGTH_UNITS, _not_above, bare=True)
OFFSET = _quantity("offset", "a length of either sign", _length, units.LENGTH_UNITS, _far, bare=True)
_ANGLES, _SPEEDS = (
    (*units.ANGLE.factors, "°"),
    (*units.SPEED.factors, "°/s", *units.TRAVEL_SPEED.factors),
)


class TravelSpeed(NamedTuple):
    """The speed of an input that is a length (m/s)."""

    metres: float


def _speed(value: object) -> Any:
    """Return an angular speed (rad/s), or what is a length in a time as such a `TravelSpeed`."""
    if isinstance(value, str) and units.names_unit(value, units.TRAVEL_SPEED):
        return TravelSpeed(units.TRAVEL_SPEED.read(value))
    return units.angular_speed(value)


def _speed_along(value: object) -> Any:
    """Return what `_speed` does, for an input that is a length: what has neither unit is told of both."""
    units.EITHER_SPEED.read(value)
    return _speed(value)


def _no_speed(speed: Any, _: str) -> str:
    """Say that a speed moves nothing, or is beyond what can be computed, if it is."""
    if isinstance(speed, TravelSpeed):
        return _far(speed.metres, "m/s") or ("" if speed.metres else "a speed of zero moves nothing")
    return _standstill(speed, "")


ANGLE = _quantity("angle", 'an angle, `"30 deg"`', _with_unit(units.angle), _ANGLES, _many_turns)
SPEED, _SPEED_ALONG = (
    _quantity("speed", 'a speed, `"20 rpm"`', _with_unit(parse), _SPEEDS, _no_speed)
    for parse in (_speed, _speed_along)
)


def _speed_of_input(table: Table, key: str) -> Any:
    along = any(of_length in table for of_length in ("slide", "slider", "cylinder"))
    return (_SPEED_ALONG if along else SPEED).read(table, key)


INPUT_SPEED = replace(SPEED, read=_speed_of_input)


def _in_units(
    measure: Measure, words: str, of: units.Units, refusal: Callable[..., str] = _not_above
) -> ValueType:
    base = next(name for name, factor in of.factors.items() if factor == 1)
    refused = partial(refusal, most=_LARGEST)
    return _quantity(measure, words, _with_unit(of.read), tuple(of.factors), refused, base=base)


STIFFNESS = _in_units("stiffness", 'a stiffness, `"4000 N/m"`', units.STIFFNESS)
DAMPING = _in_units("damping", 'a damping coefficient, `"200 N s/m"`', units.DAMPING)
MASS = _in_units("mass", 'a mass, `"3 kg"`', units.MASS)
INERTIA = _in_units("inertia", 'a moment of inertia, `"0.02 kg m^2"`', units.INERTIA)
FORCE = _in_units("force", 'a force, `"50 N"`', units.FORCE, _far)
TORQUE = _in_units("torque", 'a torque, `"5 N m"`', units.TORQUE, _far)
GRAVITY = _in_units("gravity", 'an acceleration, `"9.81 m/s^2"`', units.FALL)
RATIO = ValueType(
    _ratio,
    'a number, or a fraction as `"1/3"`',
    {"anyOf": [{"type": "number", "not": {"const": 0}}, {"type": "string", "pattern": r"^\s*[+-]?\d"}]},
    "ratio",
    bare=True,
)
POINT = listed(OFFSET, 2)


def _point_on_body(table: Table, key: str) -> Any:
    """Read a place along an axis and to its left; or one of the distance and the angle from the axis."""
    if not isinstance(table.values[key], Mapping):
        return POINT.read(table, key)
    polar = table.table(key)
    polar.refuse_unknown(("length", "angle"))
    for part in ("length", "angle"):
        polar.need(part)
    length, angle = polar.attempt(LENGTH.read, polar, "length"), polar.attempt(ANGLE.read, polar, "angle")
    return None if length is None or angle is None else on_circle(length, angle)


def on_circle(length: float, angle: float) -> tuple[float, float]:
    """Return the point at `length` and `angle` (rad) from the origin, exact at multiples of pi/2."""
    along, left = unit(angle)
    return along * length, left * length


POINT_ON_BODY = replace(
    POINT,
    read=_point_on_body,
    words=f'{POINT.words}, or `{{ length = 50, angle = "30 deg" }}`',
    schema={
        "anyOf": [
            POINT.schema,
            {
                "type": "object",
                "additionalProperties": False,
                "properties": {"length": LENGTH.schema, "angle": ANGLE.schema},
                "required": ["length", "angle"],
            },
        ]
    },
)

TEXT = ValueType(_text, "a text", {"type": "string", "maxLength": LONGEST_TEXT})
TEXTS = ValueType(Table.texts, "a list of texts", {"type": "array", "items": {"type": "string"}})
FLAG = ValueType(Table.flag, "`true` or `false`", {"type": "boolean"})
COLOUR = ValueType(_colour, 'a colour, `"#d55e00"`', {"type": "string", "pattern": r"^#[0-9a-fA-F]{6}$"})
NAME = ValueType(Table.text, "a joint", {"type": "string", "minLength": 1, "maxLength": 32})
JOINT = replace(NAME, read=lambda table, key: table.joint(key, table.text(key)), refers=True)
PAIR = _joints(2)
JOINTS = _joints()


# Fields, and the tables that they make up: what a table may state, and which value is made from it.

Key = tuple[str | int, ...]
"""The keys and numbers that lead to a value in a scene's document."""

NEEDED = object()
"""The `usual` of a key that must not be missing."""
SPREAD = ""
"""The `into` of a table whose values become those of the table around it."""


@frozen
class Field:
    """One key of a table.

    `words` say what it is. `usual` is the value where the key is missing, as a file would state it; None for
    no value. `into` is the argument that the value becomes, the key itself unless stated.

    `must` says what a joint that it names has to be: fixed or a crank; with "moving", at least one of all
    joints that the table names has to move. With the key `unless` in the table, the field may be missing, and
    its joint may move.

    `label` is a number's name in the list of dimensions, one for each item of a list; a label in small
    letters follows the table's name. `drag` says how a number follows a joint: as its distance from another
    joint, the direction from there, or its place on its body; in a shorthand `spans` are those two joints.
    """

    key: str
    type: ValueType | Form | Named
    words: str = ""
    usual: object = NEEDED
    into: str | None = None
    must: Literal["", "fixed", "crank", "moving"] = ""
    unless: str | None = None
    label: str | tuple[str, ...] = ""
    drag: Literal["", "distance", "direction", "place"] = ""
    spans: tuple[tuple[str, str], ...] = ()

    @property
    def plain(self) -> ValueType | None:
        """The type of the value, if it is no table; else None."""
        return self.type if isinstance(self.type, ValueType) else None

    def stated(self, table: Table) -> bool:
        """Tell whether there is anything to read: the key, a usual value, or the fault that it is missing."""
        return self.key in table or (self.usual is not None and self.unless not in table.values)

    def read(self, table: Table) -> Any:
        """Return the value at the key, or the usual one; None where that has a fault."""
        if self.key not in table:
            if self.usual is NEEDED:
                table.need(self.key)
            table = table.saying({self.key: self.usual})
        return self.type.read(table, self.key)


@frozen
class Form:
    """The form of a table: its fields, and the function that makes a value of theirs.

    Where several forms are possible, `mark` is the key that shows this one, if none of the keys `without` is
    in the table. `refuse` raises where values do not go together. `together` has pairs of a key and another
    key that it needs in the table. Where there may be a list or a single value instead of the table, `plain`
    is its field, and makes the value by itself.
    """

    fields: tuple[Field, ...]
    make: Callable[..., Any] = dict
    words: str = ""
    mark: str = ""
    without: tuple[str, ...] = ()
    refuse: Callable[[Table, Mapping[str, Any]], None] = lambda table, values: None
    together: Mapping[str, str] = field(default_factory=dict)
    plain: Field | None = None

    @cached_property
    def keys(self) -> Mapping[str, Field]:
        """The fields by their keys; all other keys are unknown."""
        return {one.key: one for one in self.fields}

    def field(self, key: str) -> Field:
        """Return the field of a key, which must be known."""
        return self.keys[key]

    def fits(self, values: Mapping[str, Any]) -> bool:
        """Tell whether a table is of this form, by the keys in it."""
        return (not self.mark or self.mark in values) and not any(key in values for key in self.without)

    def read(self, table: Table, key: str) -> Any:
        """Return the value made of the table at a key; None where anything in it has a fault."""
        if self.plain and not isinstance(table.values[key], Mapping):
            return self.plain.type.read(table, key)
        return self.made(table.table(key))

    def made(self, table: Table, *given: object, known: Iterable[str] = ()) -> Any:
        """Return the value made of a table, with the further arguments `given`; None where it has a fault.

        `known` are the keys that are allowed, the form's own unless stated.
        """
        if not table.values.keys() <= self.keys.keys():
            table.refuse_unknown(known or self.keys)
        values: dict[str, Any] = {}
        sound = True
        for one in self.fields:
            if one.stated(table):
                value = table.attempt(one.read, table)
                sound = sound and value is not None
                values |= value if one.into == SPREAD and value else {one.into or one.key: value}
        return table.attempt(self._make, table, values, given) if sound else None

    def _make(self, table: Table, values: Mapping[str, Any], given: tuple[object, ...]) -> Any:
        self.refuse(table, values)
        return self.make(*given, **values)


def form(words: str, *fields: Field, **how: Any) -> Form:
    """Return the form of a table: what it is and its fields; `how` as in `Form`."""
    return Form(fields, words=words, **how)


@frozen
class Named:
    """A table of tables by their names, as [joints.A], [joints.B], each of which has one of the `forms`.

    Where an entry may be a list instead of a table, `plain` is its field, and `make` makes the value of it;
    without any `forms` it has to be one.
    """

    forms: tuple[Form, ...]
    plain: Field | None = None
    make: Callable[..., Any] = dict

    @property
    def marks(self) -> tuple[str, ...]:
        """The keys that show which form an entry has."""
        return tuple(dict.fromkeys(form.mark for form in self.forms))

    def read(self, table: Table, key: str) -> dict[str, Any]:
        """Return the value made of each entry, by its name; None for entries that have a fault."""
        group = table.table(key)
        return {name: group.attempt(self._entry, group, name) for name in group.entries()}

    def _entry(self, group: Table, name: str) -> Any:
        if self.plain and not (self.forms and isinstance(group.values[name], Mapping)):
            place = self.plain.type.read(group, name)
            return place and self.make(name, place)
        table = group.table(name)
        form = self.form(table.values)
        akin = (one for one in self.forms if form is None or one.mark == form.mark)
        known = (key for one in akin for key in one.keys)
        if form:
            return form.made(table, name, known=known)
        table.refuse_unknown(known)
        raise table.wrong(f"says no way to find the joint; give it one of {', '.join(self.marks)}")

    def form(self, value: object) -> Form | None:
        """Return the form that an entry has; None where it has none of these forms."""
        if not isinstance(value, Mapping):
            return None
        return next((form for form in self.forms if form.fits(value)), None)


def fields_in(
    form: Form | None, values: Mapping[str, Any], path: Key = ()
) -> Iterator[tuple[Key, Field, Any]]:
    """Iterate the fields that a table states, and those of the tables in it, each with its table's values."""
    for one in form.fields if form else ():
        if one.key in values:
            yield from _fields_at(one, values, (*path, one.key))


def _fields_at(one: Field, values: Mapping[str, Any], path: Key) -> Iterator[tuple[Key, Field, Any]]:
    value = values[path[-1]]  # type: ignore[index]
    if isinstance(one.type, ValueType) and one.type.nested and isinstance(value, Mapping):
        for name in value:
            yield from _fields_at(one, value, (*path, name))
    elif isinstance(one.type, ValueType):
        yield path, one, values
    elif isinstance(one.type, Form) and one.type.plain and not isinstance(value, Mapping):
        yield path, one.type.plain, values
    elif isinstance(one.type, Form):
        yield from fields_in(one.type, value, path)
    else:
        for name, entry in value.items():
            if form := one.type.form(entry):
                yield from fields_in(form, entry, (*path, name))
            elif one.type.plain:
                yield from _fields_at(one.type.plain, value, (*path, name))
