"""Read a game from its words; and what games share: words, chapters, levels, choosing a row.

A game's words are its kind and its parameters, as `predict chapter=four-bars level=2 seed=7`. A game's
module is imported when it is first played.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from importlib import import_module
from shlex import quote, shlex
from typing import NamedTuple, Self, cast

from linkanim.errors import BadInput
from linkanim.picture.game_panel import Choice
from linkanim.picture.look import Look
from linkanim.player.action import Action
from linkanim.player.state import Game, State, with_effect
from linkanim.scenes import chapters, names, titles
from linkanim.units import shown
from linkanim.words import said, said_as

# A game's words: its kind, then its parameters, as `predict chapter=four-bars level=2 seed=7`.


class GameWords(NamedTuple):
    """The words with which a game begins: its kind and its parameters."""

    kind: str
    fields: dict[str, str]

    @classmethod
    def of(cls, text: str) -> Self:
        """Read a game's words; BadInput where a parameter is not written as name=value.

        A value may have quotes, as in a shell; without quotes, words without a name belong to the value
        before.
        """
        kind, parts = "", list[str]()
        for part in _split(text):
            if not kind:
                kind = part
            elif "=" not in part and parts:
                parts[-1] += f" {part}"
            else:
                parts.append(part)
        if not all("=" in part for part in parts):
            raise BadInput(f"{shown(text)} is no game; one is written as predict level=1 seed=7")
        return cls(kind, dict(part.split("=", 1) for part in parts))

    def __str__(self) -> str:
        return " ".join([self.kind, *(quote(f"{name}={value}") for name, value in self.fields.items())])

    def text(self, name: str, usual: str = "") -> str:
        """Return a parameter, spaces for its underscores."""
        return self.fields.get(name, usual).replace("_", " ")

    def whole(self, name: str, usual: int = 0, low: int = 0, high: int = 10**9) -> int:
        """Return a parameter that is a whole number within bounds; BadInput for any other."""
        value = self.fields.get(name, str(usual))
        try:
            number = int(value)
        except ValueError:
            number = low - 1
        if not low <= number <= high:
            raise BadInput(f"{self.kind}: {name}={shown(value)} is no whole number from {low} to {high}")
        return number

    def having(self, **fields: object) -> Self:
        """Return the words with other parameters; a parameter "" is removed."""
        given = {name: str(value) for name, value in fields.items() if value != ""}
        return self._replace(fields={**self.fields, **given})


def _split(text: str) -> list[str]:
    """Return the parts between spaces, except spaces in quotes; a backslash is an ordinary character."""
    lexer = shlex(text, posix=True)
    lexer.whitespace_split, lexer.escape, lexer.commenters = True, "", ""
    try:
        return [*lexer]
    except ValueError:
        raise BadInput(f"{shown(text)} has a quote that does not end") from None


# The table of games, read from their words.

_MODULES = {"title": "menus", "lobby": "menus", "menu": "menus"}
GAMES = {
    kind: f"linkanim.play.{_MODULES.get(kind, kind)}"
    for kind in ("title", "lobby", "menu", "predict", "follow", "match")
}
"""The module of each kind, imported when it is first played; it has `read(words)`."""

LEVELS = (1, 2, 3)
"""The levels of rounds of questions."""


def game_of(text: str) -> Game:
    """Return the game that words begin; BadInput where they name none."""
    words = GameWords.of(text)
    if words.kind not in GAMES:
        raise BadInput(f"there is no game {shown(words.kind)}; there are {', '.join(GAMES)}")
    return cast(Game, import_module(GAMES[words.kind]).read(words))


# What rounds are about: a chapter, all of them together, or one scene.

ALL = "all"


def members(chapter: str) -> tuple[str, ...]:
    """Return the scenes of a chapter or of all, or the one scene of that name; BadInput for another name."""
    if chapter == ALL:
        return names()
    scenes = chapters().get(chapter, [chapter] if chapter in names() else [])
    if not scenes:
        raise BadInput(f"there is no chapter {shown(chapter)}; there are {ALL}, {', '.join(chapters())}")
    return tuple(scenes)


def titled(chapter: str) -> str:
    """Return a chapter's or a scene's name as a heading."""
    words = said("All mechanisms") if chapter == ALL else said(titles().get(chapter, chapter))
    return words[:1].upper() + words[1:]


# What games share: how they begin one another, and how one of several rows is chosen.


def chosen_by(action: Action, row: int, count: int) -> tuple[int, bool] | None:
    """Return the row of `count` that an action chooses, and whether it is taken; None where none is."""
    match action:
        case Action("option", int() as place) if 0 <= place < count:
            return place, True
        case Action("raise", int() as steps):
            return (row + (-1 if steps > 0 else 1)) % count, False
        case Action("next"):
            return row, True
    return None


def choices_of(doors: Iterable[tuple[str, str]]) -> tuple[Choice, ...]:
    """Return the entries of a menu, its words and what it is about, as a panel shows them, numbered."""
    return tuple(
        Choice(f"{n}", said_as("game", text), below=said(about)) for n, (text, about) in enumerate(doors, 1)
    )


def begun(state: State, kind: str, **fields: object) -> State:
    """Return the state that asks for a game, which begins once its words are completed."""
    return with_effect(state, "begin", str(GameWords(kind, {}).having(**fields)))


class OverWhatRuns(Game):
    """What the menus of games and of rounds share: the bare mechanism runs on behind them."""

    def entered(self, state: State) -> State:
        """Let the present mechanism run behind the menu."""
        clock = state.clock.pause(state.frame, False)
        return replace(state, look=Look(hud=False, theme=state.look.theme), clock=clock)

    def aged(self, state: State) -> State:
        """Return the state unchanged: time has no effect here."""
        return state
