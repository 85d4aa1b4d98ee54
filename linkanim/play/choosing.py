"""What games share: their place, and how one of several rows is chosen by keys, a number or a click."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from linkanim.picture.look import Look
from linkanim.player.state.action import Action
from linkanim.player.state.state import State


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


class BesideScene:
    """What games share: their panel stands beside the scene, and Esc goes out of them."""

    @property
    def listed(self) -> bool:
        """Whether the panel takes the room of a list."""
        return True

    @property
    def covers(self) -> bool:
        """Whether Esc goes out of it."""
        return True


class OverWhatRuns(BesideScene):
    """What the choices of a game and of a round share: what is on runs on bare behind them."""

    def entered(self, state: State) -> State:
        """Let what is on run behind it."""
        clock = state.clock.pause(state.frame, False)
        return replace(state, look=Look(hud=False, theme=state.look.theme), clock=clock)

    def aged(self, state: State) -> State:
        """Return the state as it is: time does nothing here."""
        return state
