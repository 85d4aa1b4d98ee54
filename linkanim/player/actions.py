"""What can happen to the player: the one vocabulary of keys, mouse, tapes and `advance`."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

Value = None | int | float | str | tuple[float, ...]


class Action(NamedTuple):
    """One thing that was asked for, as plain data (a tape writes it as it stands)."""

    name: str
    value: Value = None


def _nothing(value: object) -> bool:
    return value is None


def _whole(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _text(value: object) -> bool:
    return isinstance(value, str)


def _one_of(*words: str) -> Callable[[object], bool]:
    return lambda value: value in words


def _numbers(count: int) -> Callable[[object], bool]:
    return lambda value: isinstance(value, tuple) and len(value) == count and all(map(_number, value))


MOTION: Mapping[str, Callable[[object], bool]] = {
    "pause": _nothing,
    "step": _whole,  # degrees of phase, along the way the crank runs
    "speed": _whole,  # steps of the speed ladder
    "direction": _nothing,
    "start": _nothing,
    "scrub": _number,  # the phase to go to, rad
}
SCENES: Mapping[str, Callable[[object], bool]] = {
    "mechanism": _whole,  # places further on the shelf
    "select": _whole,  # the place on the shelf, from 0
    "closure": _nothing,
}
LOOKS: Mapping[str, Callable[[object], bool]] = {
    "trace": _nothing,
    "vectors": _one_of("v", "a"),
    "ghost": _nothing,
    "chart": _whole,  # quantities further
    "theme": _nothing,
    "help": _nothing,
    "zoom": _numbers(3),  # notches, about the point (x, y): window heights from the picture's middle, y down
    "pan": _numbers(2),  # window heights, right and down
    "fit": _nothing,
}
EDITING: Mapping[str, Callable[[object], bool]] = {
    "edit": _nothing,
    "choose": _whole,
    "nudge": _whole,
    "type": _text,
    "erase": _nothing,
    "take": _nothing,
    "undo": _nothing,
    "redo": _nothing,
}
OUTSIDE: Mapping[str, Callable[[object], bool]] = {
    "record": _one_of("gif", "mp4"),
    "screenshot": _nothing,
    "fullscreen": _nothing,
    "save": _nothing,
    "back": _nothing,
    "quit": _nothing,
    "note": _text,  # something the window has to say, as a toast
}
KNOWN: Mapping[str, Callable[[object], bool]] = {**MOTION, **SCENES, **LOOKS, **EDITING, **OUTSIDE}
"""Every action's name, with the test that its value must pass."""


def is_known(action: Action) -> bool:
    """Tell whether the action is one of ours and its value is of the right kind."""
    check = KNOWN.get(action.name)
    return check is not None and check(action.value)
