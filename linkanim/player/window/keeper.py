"""What the window needs of games from outside: which there are, and what is kept of them."""

from __future__ import annotations

from typing import Protocol

from linkanim.player.state.state import Game


class GameKeeper(Protocol):
    """Knows the games, and the file in which best scores and what was missed are kept."""

    def game_of(self, words: str) -> Game:
        """Return the game that words begin; BadInput where they name none. Pure, for tapes."""

    def completed(self, words: str) -> str:
        """Return a game's words with what only the outside knows: a seed, best scores, what was missed."""

    def keep(self, words: str) -> None:
        """Keep what a game leaves; what cannot be kept is news."""

    def news(self) -> list[str]:
        """Return what there is to say of what is kept, once."""
