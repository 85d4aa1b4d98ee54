"""A table of a scene file, read key by key; what is wrong is said with its file, key, value and way out."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, ClassVar, Self

from linkanim import units
from linkanim.bounds import MOST_NAMES
from linkanim.document import Section, few, meant
from linkanim.errors import BadInput, SceneError, UnitError
from linkanim.mechanics.linkage.joint import Point

_SMALL = 12
_STEEP = 100
_LARGEST, _LONGEST = 1e30, 1e12
_MOST_TURNS = 100
_FRACTION = re.compile(r"\s*([+-]?\d{1,9}(?:\.\d{1,18})?)\s*(?:/\s*(\d{1,9})\s*)?", re.A)


@dataclass(frozen=True)
class Table(Section):
    """One table of a scene file; bare lengths are in `unit`."""

    refusal: ClassVar[type[BadInput]] = SceneError

    unit: str = "mm"

    def under(self, key: str, values: Mapping[str, Any]) -> Self:
        """Return a table that stands under a key."""
        return replace(super().under(key, values), unit=self.unit)

    def tables(self, key: str) -> Iterable[tuple[str, Table]]:
        """Iterate the named tables under a key ([joints.A], [joints.B], ...)."""
        group = self.table(key)
        return ((name, group.table(name)) for name in group.names_given())

    def subtables(self) -> tuple[str, ...]:
        """Return the keys whose values are tables themselves."""
        return tuple(key for key, value in self.values.items() if isinstance(value, Mapping))

    def names_given(self) -> tuple[str, ...]:
        """Return the names that are this table's keys, each fit to be shown and to be part of a key."""
        if len(self.values) > MOST_NAMES:
            raise self.wrong(f"has {len(self.values):,} entries; {MOST_NAMES} are the most that are read")
        for name in self.values:
            if not 1 <= len(name) <= 32 or not name.isprintable() or "." in name or name != name.strip():
                raise self.error(name, "a name has 1 to 32 printable characters, no dot, no outer spaces")
        return tuple(self.values)

    def names(self, key: str, count: int | None = None) -> tuple[str, ...]:
        """Return a list of names, all different, `count` of them if given."""
        value = self.need(key)
        if not isinstance(value, list) or not all(isinstance(name, str) for name in value):
            raise self.error(key, f'must be a list of {count or "joint"} names, such as ["A", "B"]')
        if count is not None and len(value) != count:
            raise self.error(key, f"must name {count} joints; it names {len(value)}")
        if len(set(value)) != len(value):
            raise self.error(key, "names the same joint twice")
        return tuple(value)

    def members(self, key: str, joints: Iterable[str], count: int | None = None) -> tuple[str, ...]:
        """Return a list of names that are all joints, all different, `count` of them if given."""
        members = self.names(key, count)
        for member in members:
            if member not in joints:
                raise self.error(key, no_joint(member, joints))
        return members

    def length(self, key: str) -> float:
        """Return a length in the scene's unit, above zero."""
        return self._positive(key, self.need(key), self._length, _LONGEST)

    def lengths(self, key: str, count: int) -> tuple[float, ...]:
        """Return a list of `count` lengths, each above zero."""
        items, names = self._lengths(key, count)
        return tuple(items.length(name) for name in names)

    def offset(self, key: str) -> float:
        """Return a length of either sign, 0 where the key is missing."""
        return self._quantity(key, self.values.get(key, 0), self._length, _LONGEST)

    def point(self, key: str) -> Point:
        """Return two lengths of either sign."""
        items, (x, y) = self._lengths(key, 2)
        return items.offset(x), items.offset(y)

    def angle(self, key: str, default: str | None = None) -> float:
        """Return an angle in radians; `default` where it is missing, an error where that is None."""
        value = self.need(key) if default is None else self.values.get(key, default)
        angle = self._quantity(key, value, units.angle)
        if abs(angle) > _MOST_TURNS * math.tau:
            raise self.error(key, f"is more than {_MOST_TURNS} turns; leave whole turns out")
        return angle

    def speed(self, key: str, default: str) -> float:
        """Return an angular speed in rad/s, not zero."""
        value = self._quantity(key, self.values.get(key, default), units.angular_speed)
        if value == 0.0:
            raise self.error(key, 'a speed of zero moves nothing; write "20 rpm" (or "-20 rpm", clockwise)')
        return value

    def positive(self, key: str, parse: Callable[[object], float]) -> float:
        """Return a quantity above zero, read by one of the functions of `units`."""
        return self._positive(key, self.need(key), parse)

    def ratio(self, key: str) -> Fraction:
        """Return a gear ratio, a fraction of denominator 12 at the most, from a number or from "1/3"."""
        value = self.need(key)
        exact = _fraction(value)
        if exact is None or exact == 0:
            raise self.error(key, 'must be a number other than zero, or a fraction such as "1/3"')
        near = exact.limit_denominator(_SMALL)
        if near == 0 or abs(near) > _STEEP:
            raise self.error(key, f"a gear pair turns between 1/{_SMALL} and {_STEEP} times as fast")
        if near != exact and (isinstance(value, str) or float(near) != float(value)):
            raise self.error(key, f'is not a small fraction, so the loop is long; the nearest is "{near}"')
        return near

    def _lengths(self, key: str, count: int) -> tuple[Self, tuple[str, ...]]:
        """Return a list's items as a table, and its keys: errors then say `length[1]`."""
        value = self.need(key)
        if not isinstance(value, list) or len(value) != count:
            example = list(range(10, 10 * count + 1, 10))
            raise self.error(key, f"must be a list of {count} lengths, such as {example}")
        items = self.listed(key)
        return items, tuple(items.values)

    def _length(self, value: object) -> float:
        return units.length(value, unit=self.unit)

    def _quantity(
        self, key: str, value: object, parse: Callable[[object], float], most: float = _LARGEST
    ) -> float:
        try:
            number = parse(value)
        except UnitError as error:
            raise self.at(f"{self.key(key)}: {error}", key) from None
        if abs(number) > most:
            raise self.error(key, f"is beyond what can be computed; write less than {most:g}")
        return number

    def _positive(
        self, key: str, value: object, parse: Callable[[object], float], most: float = _LARGEST
    ) -> float:
        number = self._quantity(key, value, parse, most)
        if not number > 0.0:
            raise self.error(key, "must be above zero")
        if number < 1.0 / most:
            raise self.error(key, f"is beyond what can be computed; write more than {1.0 / most:g}")
        return number


def no_joint(name: str, joints: Iterable[str]) -> str:
    """Say that no joint has this name, and which there are."""
    return f"no joint is called {units.shown(name)}{meant(name, joints)}; there are {few(joints)}"


def _fraction(value: object) -> Fraction | None:
    if isinstance(value, str):
        match = _FRACTION.fullmatch(value)
        bottom = int(match[2] or 1) if match else 0
        return Fraction(match[1]) / bottom if match and bottom else None
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return Fraction(value) if isinstance(value, int) or math.isfinite(value) else None
