"""What the window is given to play with: the games, and what of them is kept."""

from __future__ import annotations

from linkanim.play.games import game_of
from linkanim.player.state.state import Game


class Arcade:
    """The games of a window."""

    def game_of(self, words: str) -> Game:
        """Return the game that words begin; BadInput where they name none."""
        return game_of(words)

    def completed(self, words: str) -> str:
        """Return a game's words with what only the outside knows."""
        return words

    def keep(self, words: str) -> str | None:
        """Keep what a game leaves."""
        return None
