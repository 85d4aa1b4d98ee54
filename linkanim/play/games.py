"""The table of games, read from their words."""

from __future__ import annotations

from importlib import import_module
from types import MappingProxyType
from typing import cast

from linkanim.errors import BadInput
from linkanim.play.words import GameWords
from linkanim.player.state.state import Game
from linkanim.units import shown

GAMES: MappingProxyType[str, str] = MappingProxyType(
    {
        "title": "linkanim.play.title",
        "lobby": "linkanim.play.lobby",
        "menu": "linkanim.play.menu",
        "predict": "linkanim.play.predict",
        "follow": "linkanim.play.follow",
        "match": "linkanim.play.match.game",
    }
)
"""Where each kind lives, imported when it is first played: a module with `read(words)`."""


def game_of(text: str) -> Game:
    """Return the game that words begin; BadInput where they name none."""
    words = GameWords.of(text)
    if words.kind not in GAMES:
        raise BadInput(f"there is no game {shown(words.kind)}; there are {', '.join(GAMES)}")
    return cast(Game, import_module(GAMES[words.kind]).read(words))
