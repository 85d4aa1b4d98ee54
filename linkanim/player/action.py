"""Say what can be asked of the player, as plain data.

Keys, mouse, tapes and `advance` share it. It loads nothing, so that the help of a command can read it.
"""

from __future__ import annotations

from typing import NamedTuple

# What can be asked of the player, as plain data: keys, mouse, tapes and `advance` share it.

Value = None | int | float | str | tuple[float, ...]


class Action(NamedTuple):
    """One thing that was asked for, as plain data (a tape writes it as it stands)."""

    name: str
    value: Value = None
