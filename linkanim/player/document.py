"""A document read key by key, each refusal naming the place, the value and what is wanted."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from linkanim.errors import BadInput


@dataclass(frozen=True)
class Part:
    """One table of a document: `where` is the file, `path` the keys that lead here, each with its dot.

    Every reader raises BadInput where the key is missing or its value is of another kind.
    """

    values: object
    where: str
    path: str = ""

    def wrong(self, key: str, value: object, wanted: str) -> BadInput:
        """Return the refusal of a value."""
        return BadInput(f"{self.where}: {self.path}{key}: {json.dumps(value)[:60]} is not {wanted}")

    def value(self, key: str) -> Any:
        """Return what stands at a key, whatever it is."""
        if not isinstance(self.values, Mapping) or key not in self.values:
            raise BadInput(f"{self.where}: has no {self.path}{key}; record the tape again")
        return self.values[key]

    def table(self, key: str) -> Mapping[str, Any]:
        """Read a table as it stands."""
        value = self.value(key)
        if not isinstance(value, Mapping):
            raise self.wrong(key, value, "a table")
        return value

    def part(self, key: str) -> Part:
        """Read a table, key by key."""
        return Part(self.table(key), self.where, f"{self.path}{key}.")

    def items(self, key: str) -> list[Any]:
        """Read a list."""
        value = self.value(key)
        if not isinstance(value, list):
            raise self.wrong(key, value, "a list")
        return value

    def text(self, key: str) -> str:
        """Read a text."""
        value = self.value(key)
        if not isinstance(value, str):
            raise self.wrong(key, value, "a text")
        return value

    def flag(self, key: str) -> bool:
        """Read true or false."""
        value = self.value(key)
        if not isinstance(value, bool):
            raise self.wrong(key, value, "true or false")
        return value

    def number(self, key: str) -> float:
        """Read a finite number."""
        return self._number(key, self.value(key))

    def whole(self, key: str, low: int, high: int) -> int:
        """Read a whole number from `low` to `high`."""
        value = self.value(key)
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise self.wrong(key, value, f"a whole number from {low} to {high}")
        return value

    def numbers(self, key: str, count: int) -> tuple[float, ...]:
        """Read a list of so many finite numbers."""
        found = tuple(self._number(key, value) for value in self.items(key))
        if len(found) != count:
            raise self.wrong(key, self.value(key), f"a list of {count} numbers")
        return found

    def _number(self, key: str, value: object) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise self.wrong(key, value, "a finite number")
        return float(value)
