"""What can be asked of the player, as plain data: keys, mouse, tapes and `advance` share it."""

from __future__ import annotations

from typing import Literal, NamedTuple

Mode = Literal["play", "paused", "edit", "list", "shelf", "pencil", "game", "build"]
"""What the keys are for: the picture, or the overlay that is open."""
Value = None | int | float | str | tuple[float, ...]


class Action(NamedTuple):
    """One thing that was asked for, as plain data (a tape writes it as it stands)."""

    name: str
    value: Value = None
