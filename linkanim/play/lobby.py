"""What there is to play: the games, of which one is chosen."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

from linkanim.picture.panels.overlay import Choice, GamePanel, Overlay
from linkanim.play.choosing import OverWhatRuns, chosen_by
from linkanim.play.words import GameWords
from linkanim.player.state.action import Action
from linkanim.player.state.state import State, with_effect


class Offer(NamedTuple):
    """A game as it is offered: its words, its name, what is done in it."""

    words: str
    text: str
    about: str


OFFERS = (
    Offer("menu", "Predict", "say what a linkage does before it moves"),
    Offer("match", "Match", "drag a four-bar until it draws the dotted curve"),
    Offer("follow", "Follow", "turn the crank, keep the ram between two lines"),
)


@dataclass(frozen=True)
class Lobby(OverWhatRuns):
    """The choice of a game, and which one Enter takes."""

    row: int = 0

    @property
    def words(self) -> str:
        """What begins it again."""
        return f"lobby row={self.row}"

    def carried(self, state: State, action: Action) -> State:
        """Begin a game, choose one, or go back to the title."""
        if action.name == "back":
            return with_effect(state, "begin", "title")
        chosen = chosen_by(action, self.row, len(OFFERS))
        if chosen is None:
            return state
        state = replace(state, game=replace(self, row=chosen.row))
        return with_effect(state, "begin", OFFERS[chosen.row].words) if chosen.taken else state

    def shown(self, state: State, over: Overlay) -> Overlay:
        """Return the overlay with the games."""
        choices = tuple(Choice(f"{n}", one.text, below=one.about) for n, one in enumerate(OFFERS, 1))
        hint = "Enter begins   ↑ ↓ choose   Esc goes back"
        return replace(over, game=GamePanel("Play", choices=choices, hint=hint, chosen=self.row))


def read(words: GameWords) -> Lobby:
    """Return the choice that words begin; BadInput where they do not."""
    return Lobby(words.whole("row", 0, 0, len(OFFERS) - 1))
