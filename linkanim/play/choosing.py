"""One of several rows is chosen by keys, a number or a click: the title's doors, games, chapters."""

from __future__ import annotations

from typing import NamedTuple

from linkanim.player.state.action import Action


class Chosen(NamedTuple):
    """The row that is chosen now, and whether it is taken."""

    row: int
    taken: bool


def chosen_by(action: Action, row: int, count: int) -> Chosen | None:
    """Return what an action chooses of so many rows where one is chosen; None where it chooses nothing."""
    match action:
        case Action("option", int() as place) if 0 <= place < count:
            return Chosen(place, taken=True)
        case Action("raise", int() as steps):
            return Chosen((row + (-1 if steps > 0 else 1)) % count, taken=False)
        case Action("next"):
            return Chosen(row, taken=True)
    return None
