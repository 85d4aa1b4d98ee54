"""The one table of gamepad buttons: which key each stands for; window, help and README read it.

Buttons are named by where they are: the lower, right, left and upper of four are A, B, X, Y of one make
and ×, ○, □, △ of another. Nothing here needs pygame.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple


class PadRow(NamedTuple):
    """One line of the help: the buttons as they are written, what they do, the keys that they stand for.

    The second of two keys is that of an open list.
    """

    written: str
    words: str
    keys: Mapping[str, tuple[str, ...]]


_WAYS = ("up", "down", "left", "right")
PAD: tuple[PadRow, ...] = (
    PadRow("left stick", "turn the crank to the stick's angle", {}),
    PadRow("A, ×", "play / pause; Enter in a list", {"lower": ("space", "return")}),
    PadRow("B, ○", "Esc", {"right": ("escape",)}),
    PadRow("X, □", "direction", {"left": ("d",)}),
    PadRow("Y, △", "names", {"upper": ("n",)}),
    PadRow("D-pad", "the arrow keys", {f"pad {way}": (way,) for way in _WAYS}),
    PadRow("LB, RB; L1, R1", "the mechanism before, the next", {"before": ("shift+tab",), "next": ("tab",)}),
    PadRow("Start, Options", "the shelf", {"start": ("o",)}),
    PadRow("Back, Share", "help", {"back": ("h",)}),
)
"""Every button that does something, in the order in which the help shows them."""

_KEYS: Mapping[str, tuple[str, ...]] = {name: keys for row in PAD for name, keys in row.keys.items()}
_ALIKE = ("lower", "right", "left", "upper")
_WITH_HAT = (*_ALIKE, "before", "next", "back", "start")
_OF_WAYS = tuple(f"pad {way}" for way in _WAYS)
_WITHOUT_HAT = (*_ALIKE, "back", "", "start", "", "", "before", "next", *_OF_WAYS)
"""The buttons in the order in which the two usual layouts number them, by whether the D-pad is a hat."""


def button_name(number: int, *, hat: bool) -> str:
    """Return what a button is called; empty where it is none of ours."""
    names = _WITH_HAT if hat else _WITHOUT_HAT
    return names[number] if 0 <= number < len(names) else ""


def hat_name(right: int, up: int) -> str:
    """Return which way a D-pad is pressed; empty where it is let go."""
    if up:
        return "pad up" if up > 0 else "pad down"
    return "" if not right else "pad right" if right > 0 else "pad left"


def key_of(name: str, *, listed: bool) -> str:
    """Return the key that a button stands for, in an open list or not; empty where there is none."""
    return next(iter(_KEYS.get(name, ())[-1 if listed else 0 :]), "")
