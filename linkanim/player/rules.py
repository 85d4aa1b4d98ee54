"""Test the values of actions, since a tape might say anything; and answers that several of them have."""

from __future__ import annotations

from collections.abc import Callable
from typing import cast

from linkanim.intake import control_in
from linkanim.player.state import State
from linkanim.scenes.editing import closure_name
from linkanim.words import said

_MOST_NUMBERS = 1_000
MOST_STEPS, LARGEST_NUMBER = 10**9, 1e100
"""The greatest values of an action: no key or mouse gives more, and a tape might say anything."""
_FARTHEST = 1e18
"""The greatest coordinate on a sheet, where places are squared and counted in steps."""


def nothing(value: object) -> bool:
    """Tell whether there is no value."""
    return value is None


def whole(value: object) -> bool:
    """Tell whether a value is a whole number."""
    return isinstance(value, int) and not isinstance(value, bool) and abs(value) <= MOST_STEPS


def number(value: object) -> bool:
    """Tell whether a value is a number."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= LARGEST_NUMBER


def share(value: object) -> bool:
    """Tell whether a value is a number from 0 to 1."""
    return number(value) and 0.0 <= cast(float, value) <= 1.0


def text(value: object) -> bool:
    """Tell whether a value is text without control characters."""
    return isinstance(value, str) and not control_in(value)


def words_or_none(value: object) -> bool:
    """Tell whether a value is text, or none."""
    return value is None or text(value)


def one_of(*words: str | None) -> Callable[[object], bool]:
    """Return the test for one of these words."""
    return lambda value: value in words


def numbers(count: int) -> Callable[[object], bool]:
    """Return the test for so many numbers."""
    return lambda value: isinstance(value, tuple) and len(value) == count and all(map(number, value))


def _grouped(value: object, each: int) -> bool:
    """Tell whether a value is a number, followed by groups of so many others."""
    if not isinstance(value, tuple) or not 1 < len(value) <= _MOST_NUMBERS:
        return False
    return len(value) % each == 1 and all(map(number, value))


def pairs(value: object) -> bool:
    """Tell whether a value is a number and pairs of others."""
    return _grouped(value, 2)


def place_of_sheet(value: object) -> bool:
    """Tell whether a value is a place on a sheet."""
    return numbers(2)(value) and all(abs(at) <= _FARTHEST for at in cast(tuple[float, ...], value))


def hand(value: object) -> bool:
    """Tell whether a value is a hand's: x and y, how near is on a thing, the step, 0 for none."""
    if not numbers(4)(value):
        return False
    *place, reach, snap = cast(tuple[float, ...], value)
    near = place_of_sheet(tuple(place)) and 0.0 <= reach <= _FARTHEST
    return near and (snap == 0.0 or 1.0 / _FARTHEST <= snap <= _FARTHEST)


def triples(value: object) -> bool:
    """Tell whether a value is a number and triples of others."""
    return _grouped(value, 3)


def _sizes_of_answers() -> tuple[int, int, int]:
    # nothing of the search is imported before the pencil is taken
    from linkanim.synthesis.answers import EARLIER, NUMBERS
    from linkanim.synthesis.guidance import POSE_NUMBERS

    return EARLIER, NUMBERS, POSE_NUMBERS


def answer(value: object) -> bool:
    """Tell whether a value has the numbers of an answer."""
    return any(numbers(size)(value) for size in _sizes_of_answers())


def answers(value: object) -> bool:
    """Tell whether a value is a number and those of answers on older tapes."""
    return _grouped(value, _sizes_of_answers()[0])


def cards(value: object) -> bool:
    """Tell whether a value is a number and those of answers."""
    _, *sizes = _sizes_of_answers()
    return any(_grouped(value, size) for size in sizes)


# Answers of actions that several modes have.


def stuck(words: str) -> Callable[[State, State], str | None]:
    """Return the answer of an action that says these words where nothing changed."""
    return lambda was, now: said(words) if (was.editing, was.sheet) == (now.editing, now.sheet) else None


def closure(before: State, after: State) -> str | None:
    """Say which of the two closures is shown."""
    return None if after.scene is before.scene else closure_name(after.scene)
