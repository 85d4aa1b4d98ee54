"""A document's tables read key by key; what is wrong is said with its file, key, value and way out.

Scene files and tapes are such documents: TOML and JSON come as the same tables, lists and values.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self, TypeVar

from linkanim.bounds import LONGEST_TEXT
from linkanim.errors import BadInput
from linkanim.intake import control_in
from linkanim.units import shown

Option = TypeVar("Option", bound=str)

_FEW = 12
_LONG = 60
_BREAK = re.compile(r"\s*[\t\n\r]\s*")
_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+(\[\d+\])?")


@dataclass(frozen=True)
class Section:
    """One table of a document: its values, and the keys that lead to it.

    Every reader raises `refusal` where the key is missing or its value is of another kind.
    """

    refusal: ClassVar[type[BadInput]] = BadInput

    where: str
    values: Mapping[str, Any]
    keys: tuple[str, ...] = ()

    @property
    def path(self) -> str:
        """The keys as TOML writes them."""
        return ".".join(map(_written, self.keys))

    def __contains__(self, key: str) -> bool:
        return key in self.values

    def key(self, key: str) -> str:
        """Return the key's full path, as TOML writes it."""
        return ".".join(map(_written, (*self.keys, key)))

    def error(self, key: str, reason: str) -> BadInput:
        """Return (not raise) the error about one key: file, key, value if it has one, and the reason."""
        value = self.values.get(key)
        shown_value = "" if value is None or isinstance(value, Mapping | list) else f" = {shown(value)}"
        return self.at(f"{self.key(key)}{shown_value}: {reason}", key)

    def wrong(self, reason: str) -> BadInput:
        """Return (not raise) the error about this table as a whole."""
        return self.at(f"{self.path}: {reason}" if self.path else reason)

    def at(self, message: str, *keys: str) -> BadInput:
        """Return (not raise) an error about what stands at keys under this table."""
        error = self.refusal(f"{self.where}: {message}")
        error.keys = (*self.keys, *keys)
        return error

    def need(self, key: str) -> Any:
        """Return the key's value, whatever it is."""
        if key not in self.values:
            place = f"{self.path}: " if self.path else ""
            raise self.at(f'{place}"{key}" is missing', key)
        return self.values[key]

    def table(self, key: str) -> Self:
        """Return the table under a key, empty where there is none."""
        value = self.values.get(key, {})
        if not isinstance(value, Mapping):
            raise self.error(key, f"must be a table, [{self.key(key)}] or {{ ... }}")
        return self.under(key, value)

    def under(self, key: str, values: Mapping[str, Any]) -> Self:
        """Return a table that stands under a key."""
        return type(self)(self.where, values, (*self.keys, key))

    def items(self, key: str, count: int | None = None) -> list[Any]:
        """Return a list, of `count` items if given."""
        value = self.need(key)
        if not isinstance(value, list) or count not in (None, len(value)):
            raise self.error(key, f"must be a list of {count} items" if count else "must be a list")
        return value

    def listed(self, key: str, count: int | None = None) -> Self:
        """Return a list's items as a table in the place of this one, under `key[0]`, `key[1]`, ..."""
        values = {f"{key}[{i}]": value for i, value in enumerate(self.items(key, count))}
        return replace(self, values=values)

    def text(self, key: str, default: str | None = None) -> str:
        """Return a text, on one line; `default` where it is missing, an error where that is None."""
        value = self.need(key) if default is None else self.values.get(key, default)
        if not isinstance(value, str):
            raise self.error(key, "must be a text in quotes")
        if len(value) > LONGEST_TEXT:
            raise self.error(key, f"is longer than {LONGEST_TEXT:,} characters; cut it")
        return _BREAK.sub(" ", value)

    def texts(self, key: str) -> tuple[str, ...]:
        """Return a list of texts, empty where it is missing."""
        value = self.values.get(key, [])
        if not isinstance(value, list) or not all(isinstance(text, str) for text in value):
            raise self.error(key, 'must be a list of texts, such as ["one", "another"]')
        items = self.listed(key) if value else self
        return tuple(items.text(item) for item in items.values) if value else ()

    def choice(self, key: str, options: tuple[Option, ...]) -> Option:
        """Return one of the options, the first where the key is missing."""
        value = self.values.get(key, options[0])
        if value not in options:
            raise self.error(key, f"must be {' or '.join(shown(option) for option in options)}")
        return options[options.index(value)]

    def flag(self, key: str) -> bool:
        """Return true or false."""
        value = self.need(key)
        if not isinstance(value, bool):
            raise self.error(key, "must be true or false")
        return value

    def number(self, key: str) -> float:
        """Return a finite number."""
        value = self.need(key)
        if isinstance(value, bool) or not isinstance(value, int | float) or not _is_finite(value):
            raise self.error(key, "must be a finite number")
        return float(value)

    def whole(self, key: str, low: int, high: int) -> int:
        """Return a whole number from `low` to `high`."""
        value = self.need(key)
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise self.error(key, f"must be a whole number from {low} to {high}")
        return value


def refuse_controls(document: Section) -> None:
    """Refuse a control character in any key or text of a document, wherever it stands in it."""
    pending: list[tuple[tuple[str, ...], Any]] = [((), document.values)]
    while pending:
        keys, value = pending.pop()
        if isinstance(value, str) and (found := control_in(value)):
            place = ".".join(map(_written, keys))
            raise document.at(f"{place} = {shown(value)}: has {found} in it; leave it out", *keys)
        if isinstance(value, Mapping):
            for key in value:
                if found := control_in(key):
                    place = ".".join(map(_written, (*keys, key)))
                    raise document.at(f"{place}: has {found} in it; leave it out", *keys, key)
            pending += [((*keys, key), inner) for key, inner in value.items()]
        elif isinstance(value, list):
            start, last = keys[:-1], keys[-1] if keys else ""
            pending += [((*start, f"{last}[{n}]"), inner) for n, inner in enumerate(value)]


def _written(key: str) -> str:
    return key if len(key) <= _LONG and _BARE_KEY.fullmatch(key) else shown(key)


def meant(name: str, known: Iterable[str]) -> str:
    """Return ' (did you mean "crank"?)' for a name close to a known one, else an empty text."""
    from difflib import get_close_matches  # for what is wrong only: a window opens sooner without

    # what is far longer than any name is near to none, and takes long to compare
    near = get_close_matches(name[:_LONG], list(known), n=1, cutoff=0.6)
    return f" (did you mean {shown(near[0])}?)" if near else ""


def few(names: Iterable[str]) -> str:
    """Return names as a message lists them: a dozen, and how many more there are."""
    listed = list(names)
    more = len(listed) - _FEW
    return ", ".join(listed[:_FEW]) + (f" and {more} more" if more > 0 else "")


def _is_finite(value: float) -> bool:
    try:
        return math.isfinite(value)
    except OverflowError:  # a whole number beyond floats
        return False
