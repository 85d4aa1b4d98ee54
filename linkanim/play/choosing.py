"""What games share: how they begin one another, and how one of several rows is chosen."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

from linkanim.picture.look import Look
from linkanim.picture.panels.overlay import Choice
from linkanim.play.words import GameWords
from linkanim.player.state.action import Action
from linkanim.player.state.state import State, with_effect


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


class Door(NamedTuple):
    """A way on: what it is called by, and in words."""

    name: str
    text: str
    about: str


def choices_of(doors: Iterable[Door]) -> tuple[Choice, ...]:
    """Return doors as a panel shows them, numbered."""
    return tuple(Choice(f"{n}", door.text, below=door.about) for n, door in enumerate(doors, 1))


def begun(state: State, kind: str, **fields: object) -> State:
    """Return the state that asks for a game, which begins once its words are completed."""
    return with_effect(state, "begin", str(GameWords(kind, {}).having(**fields)))


class OverWhatRuns:
    """What the choices of a game and of a round share: what is on runs on bare behind them."""

    covers = True

    def entered(self, state: State) -> State:
        """Let what is on run behind it."""
        clock = state.clock.pause(state.frame, False)
        return replace(state, look=Look(hud=False, theme=state.look.theme), clock=clock)

    def aged(self, state: State) -> State:
        """Return the state as it is: time does nothing here."""
        return state
