"""The table of games, read from their words."""

from __future__ import annotations

from importlib import import_module
from typing import cast

from linkanim.errors import BadInput
from linkanim.play.words import GameWords
from linkanim.player.state.state import Game
from linkanim.units import shown

_MODULES = ("title", "lobby", "menu", "predict", "follow", "match.game")
GAMES = {module.partition(".")[0]: f"linkanim.play.{module}" for module in _MODULES}
"""Where each kind lives, imported when it is first played: a module with `read(words)`."""


def game_of(text: str) -> Game:
    """Return the game that words begin; BadInput where they name none."""
    words = GameWords.of(text)
    if words.kind not in GAMES:
        raise BadInput(f"there is no game {shown(words.kind)}; there are {', '.join(GAMES)}")
    return cast(Game, import_module(GAMES[words.kind]).read(words))
