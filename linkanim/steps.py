"""Work that is done in steps: a generator that yields after each of them, and returns what it found."""

from __future__ import annotations

from collections.abc import Generator
from typing import TypeVar

_Found = TypeVar("_Found")


def at_once(steps: Generator[None, None, _Found]) -> _Found:
    """Take all steps; return what was found."""
    while True:
        try:
            next(steps)
        except StopIteration as done:
            found: _Found = done.value
            return found
