"""What there is to play: the games, of which one is chosen."""

from __future__ import annotations

from dataclasses import dataclass, replace

from linkanim.picture.panels.overlay import GamePanel, Overlay
from linkanim.play.choosing import Door, OverWhatRuns, begun, choices_of, chosen_by
from linkanim.play.words import GameWords
from linkanim.player.state.action import Action
from linkanim.player.state.state import State

OFFERS = (
    Door("menu", "Predict", "say what a linkage does before it moves"),
    Door("match", "Match", "drag a four-bar until it draws the dotted curve"),
    Door("follow", "Follow", "turn the crank, keep the ram between two lines"),
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
            return begun(state, "title")
        chosen = chosen_by(action, self.row, len(OFFERS))
        if chosen is None:
            return state
        state = replace(state, game=replace(self, row=chosen.row))
        return begun(state, OFFERS[chosen.row].name) if chosen.taken else state

    def shown(self, state: State, over: Overlay) -> Overlay:
        """Return the overlay with the games."""
        hint = "Enter begins   ↑ ↓ choose   Esc goes back"
        return replace(over, game=GamePanel("Play", choices=choices_of(OFFERS), hint=hint, chosen=self.row))


def read(words: GameWords) -> Lobby:
    """Return the choice that words begin; BadInput where they do not."""
    return Lobby(words.whole("row", 0, 0, len(OFFERS) - 1))
