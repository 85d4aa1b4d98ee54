"""What may stand at a key of a scene file: how it is read, its schema, and what its numbers measure.

A type is one value here; everything else about the file's form is in terms of these.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import Any, Literal

from linkanim import units
from linkanim.bounds import LONGEST_TEXT
from linkanim.errors import UnitError
from linkanim.scenes.fields.table import Table

Measure = Literal[
    "length", "angle", "speed", "offset", "ratio", "stiffness", "damping", "mass", "inertia", "gravity"
]
"""What a number of a scene file measures; an "offset" is a length of either sign."""
LENGTHS: tuple[Measure, ...] = ("length", "offset")
Schema = Mapping[str, Any]

_LARGEST, _LONGEST = 1e30, 1e12
SHORTEST = 1 / _LONGEST
"""The least length of a scene file, and the least way of an input."""
_MOST_TURNS = 100
_SMALL, _STEEP = 12, 100
_FRACTION = re.compile(r"\s*([+-]?\d{1,9}(?:\.\d{1,18})?)\s*(?:/\s*(\d{1,9})\s*)?", re.A)
_HEX = re.compile(r"#[0-9a-f]{6}", re.I | re.A)
_NUMBER = r"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*"


@dataclass(frozen=True)
class ValueType:
    """What may stand at a key, in `words` too.

    `read` takes it from a table that has the key. `schema` is what a JSON Schema says of it, None where
    nothing may stand there. `measure` is what its numbers measure, where they can be edited; those that are
    `bare` need no unit. `options` are the texts to choose from. What `refers` names joints.
    """

    read: Callable[[Table, str], Any]
    words: str
    schema: Schema | None = None
    measure: Measure | None = None
    bare: bool = False
    options: tuple[str, ...] = ()
    refers: bool = False


def never(sentence: str) -> ValueType:
    """Return the type of a key that is known and always refused, with a sentence."""

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
    """Return the type of a number with one of the units `names`, or without where it may be bare.

    It is read in the unit `base`; without one in the file's unit of length.
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
    """Return the type of a list of so many values of a type; errors then say `length[1]`."""
    example = list(range(10, 10 * count + 1, 10))

    def read(table: Table, key: str) -> tuple[Any, ...] | None:
        value = table.values[key]
        if not isinstance(value, list) or len(value) != count:
            raise table.error(key, f"must be a list of {count} lengths, such as {example}")
        items = table.listed(key)
        found = tuple(items.attempt(of.read, items, item) for item in items.values)
        return None if None in found else found

    schema = {"type": "array", "items": of.schema, "minItems": count, "maxItems": count}
    words = of.words.replace("a length", f"{count} lengths")
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
        match = _FRACTION.fullmatch(value)
        bottom = int(match[2] or 1) if match else 0
        return Fraction(match[1]) / bottom if match and bottom else None
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return Fraction(value) if isinstance(value, int) or math.isfinite(value) else None


def _text(table: Table, key: str) -> str:
    """Read a text; one of blanks alone says nothing, as an empty one."""
    text = table.text(key)
    return text if text.strip() else ""


def _colour(table: Table, key: str) -> tuple[int, int, int]:
    value = table.text(key)
    if not _HEX.fullmatch(value):
        raise table.error(key, 'is no colour; write red, green and blue as in "#d55e00"')
    red, green, blue = bytes.fromhex(value[1:])
    return red, green, blue


LENGTH = _quantity("length", "a length", _length, units.LENGTH_UNITS, _not_above, bare=True)
OFFSET = _quantity("offset", "a length of either sign", _length, units.LENGTH_UNITS, _far, bare=True)
_ANGLES, _SPEEDS = (*units.ANGLE.factors, "°"), (*units.SPEED.factors, "°/s")
ANGLE = _quantity("angle", 'an angle, `"30 deg"`', _with_unit(units.angle), _ANGLES, _many_turns)
SPEED = _quantity("speed", 'a speed, `"20 rpm"`', _with_unit(units.angular_speed), _SPEEDS, _standstill)


def _above(measure: Measure, words: str, of: units.Units) -> ValueType:
    refusal = partial(_not_above, most=_LARGEST)
    base = next(name for name, factor in of.factors.items() if factor == 1)
    return _quantity(measure, words, _with_unit(of.read), tuple(of.factors), refusal, base=base)


STIFFNESS = _above("stiffness", 'a stiffness, `"4000 N/m"`', units.STIFFNESS)
DAMPING = _above("damping", 'a damping coefficient, `"200 N s/m"`', units.DAMPING)
MASS = _above("mass", 'a mass, `"3 kg"`', units.MASS)
INERTIA = _above("inertia", 'a moment of inertia, `"0.02 kg m^2"`', units.INERTIA)
GRAVITY = _above("gravity", 'an acceleration, `"9.81 m/s^2"`', units.FALL)
RATIO = ValueType(
    _ratio,
    'a number, or a fraction as `"1/3"`',
    {"anyOf": [{"type": "number", "not": {"const": 0}}, {"type": "string", "pattern": r"^\s*[+-]?\d"}]},
    "ratio",
    bare=True,
)
POINT = listed(OFFSET, 2)

TEXT = ValueType(_text, "a text", {"type": "string", "maxLength": LONGEST_TEXT})
TEXTS = ValueType(Table.texts, "a list of texts", {"type": "array", "items": {"type": "string"}})
COLOUR = ValueType(_colour, 'a colour, `"#d55e00"`', {"type": "string", "pattern": r"^#[0-9a-fA-F]{6}$"})
NAME = ValueType(Table.text, "a joint", {"type": "string", "minLength": 1, "maxLength": 32})
JOINT = replace(NAME, read=lambda table, key: table.joint(key, table.text(key)), refers=True)
PAIR = _joints(2)
JOINTS = _joints()
