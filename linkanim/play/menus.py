"""Show what can be played: the title with its entries, the games, the rounds with their best scores."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.picture.game_panel import Choice, GamePanel
from linkanim.picture.look import Look
from linkanim.play.games import (
    ALL,
    LEVELS,
    GameWords,
    OverWhatRuns,
    begun,
    choices_of,
    chosen_by,
    members,
    titled,
)
from linkanim.player import shelving
from linkanim.player.action import Action
from linkanim.player.actions import leave, with_scene
from linkanim.player.building import build, leave_sheet
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.edits import carry, drop, grab
from linkanim.player.pencil import pencil
from linkanim.player.state import Game, State, with_effect, with_toast
from linkanim.scenes import chapters, load, names
from linkanim.units import shown
from linkanim.words import said, said_as, to_say

# The choice of a round by chapter and level, with the best scores.

_ABOUT = {
    1: to_say("which way, how fast, how far"),
    2: to_say("dead centres, closures, curves"),
    3: to_say("instant centres and forces"),
}


@frozen
class Menu(OverWhatRuns):
    """The choice of a round: the chapter that Enter takes, the level, and the best score of each."""

    chapter: str
    level: int
    best: tuple[tuple[str, int], ...] = ()

    @property
    def words(self) -> str:
        """The words that begin it again."""
        best = ",".join(f"{name}:{score}" for name, score in self.best)
        return str(GameWords("menu", {}).having(chapter=self.chapter, level=self.level, best=best))

    def carried(self, state: State, action: Action) -> State:
        """Choose a chapter or a level, begin a round, or go back."""
        rows = self._rows(state)
        if action.name == "back":
            return begun(state, "lobby")
        if action.name == "turn" and isinstance(action.value, int):
            level = min(max(self.level + (1 if action.value > 0 else -1), LEVELS[0]), LEVELS[-1])
            return state.with_mode(replace(self, level=level))
        if (action.name, action.value) == ("option", len(rows)):
            return state.with_mode(replace(self, level=self.level % LEVELS[-1] + 1))
        row, taken = chosen_by(action, rows.index(self.chapter), len(rows)) or (None, False)
        if row is None:
            return state
        state = state.with_mode(replace(self, chapter=rows[row]))
        return begun(state, "predict", chapter=rows[row], level=self.level) if taken else state

    def _rows(self, state: State) -> tuple[str, ...]:
        """Return what a round can be about: all chapters, one chapter, or the mechanism from before."""
        before = state.beneath.scene.name if state.beneath else ""
        own = (name for name in (self.chapter, before) if name in names())
        return tuple(dict.fromkeys((ALL, *chapters(), *own)))

    def panel(self, state: State) -> GamePanel:
        """Return the chapters."""
        best = {name: said("best {score}", score=score) for name, score in self.best}
        choices = tuple(
            Choice(f"{n}", titled(chapter), below=best.get(f"{chapter.replace(' ', '_')}.{self.level}", ""))
            for n, chapter in enumerate(self._rows(state), 1)
        )
        level = Choice(
            f"{len(choices) + 1}", said("Level {number}", number=self.level), below=said(_ABOUT[self.level])
        )
        return GamePanel(
            said_as("game", "Predict"),
            lines=(said("Ten questions, before it moves."),),
            choices=(*choices, level),
            hint=said("Enter begins   ↑ ↓ chapter   ← → level   Esc goes back"),
            chosen=self._rows(state).index(self.chapter),
        )


def is_round(name: str) -> bool:
    """Tell whether a best score belongs to a round that the menu shows."""
    chapter, _, level = name.rpartition(".")
    known = (ALL, *chapters(), *names())
    return chapter.replace("_", " ") in known and level in map(str, LEVELS)


def read_menu(words: GameWords) -> Menu:
    """Return the menu that words begin; BadInput where they do not."""
    chapter = words.text("chapter", ALL)
    members(chapter)
    best = tuple(_scored(text) for text in words.fields.get("best", "").split(",") if text)
    return Menu(chapter, words.whole("level", 1, LEVELS[0], LEVELS[-1]), best)


def _scored(text: str) -> tuple[str, int]:
    name, _, score = text.rpartition(":")
    if not score.isdecimal():
        raise BadInput(f"{shown(text)} is no score; one is four-bars.1:1200")
    return name, int(score)


# The choice of a game.

OFFERS = {
    "menu": ("Predict", to_say("say what a linkage does before it moves")),
    "match": ("Match", to_say("drag a four-bar until it draws the dotted curve")),
    "follow": ("Follow", to_say("turn the crank to keep the ram between two lines")),
}


@frozen
class Lobby(OverWhatRuns):
    """The choice of a game, and which one Enter takes."""

    row: int = 0

    @property
    def words(self) -> str:
        """The words that begin it again."""
        return f"lobby row={self.row}"

    def carried(self, state: State, action: Action) -> State:
        """Begin a game, choose one, or go back to the title."""
        if action.name == "back":
            return begun(state, "title")
        row, taken = chosen_by(action, self.row, len(OFFERS)) or (None, False)
        if row is None:
            return state
        state = state.with_mode(replace(self, row=row))
        return begun(state, [*OFFERS][row]) if taken else state

    def panel(self, state: State) -> GamePanel:
        """Return the games."""
        del state
        hint = said("Enter begins   ↑ ↓ choose   Esc goes back")
        choices = choices_of(OFFERS.values())
        return GamePanel(said_as("game", "Play"), choices=choices, hint=hint, chosen=self.row)


def read_lobby(words: GameWords) -> Lobby:
    """Return the choice that words begin; BadInput where they do not."""
    return Lobby(words.whole("row", 0, 0, len(OFFERS) - 1))


# The title: mechanisms run one after the other, each with its sentence, beside four entries ("doors").

EACH = 9 * FRAMES_PER_SECOND
_NAME = "linkanim"
_TITLE_ABOUT = to_say("An arcade of planar linkages")
_HINT = to_say("press any key   ↑ ↓ choose   O all mechanisms   Q quits")


DOORS = {
    "run": ("Run", to_say("a mechanism")),
    "build": ("Build", to_say("draw a linkage on a sheet")),
    "path": ("Draw a path", to_say("and get linkages that follow it")),
    "play": ("Play", to_say("predict, match, follow")),
}
_IGNORED = frozenset({"scrub", "point", "move", "pull"})
"""Actions of a moving mouse, which do not leave the title: a click does."""
_HELD: Mapping[str, Callable[[State, Any], State]] = {"grab": grab, "carry": carry, "drop": drop}
"""Actions of a hand on the running mechanism."""


@frozen
class Title(Game):
    """The title: the door that any key takes, and the place on the shelf of the mechanism that runs.

    Without a place it is that of the mechanism to which the first door leads.
    """

    door: int
    place: int | None
    covers, leads = False, True

    @property
    def words(self) -> str:
        """The words that begin it again."""
        return f"title door={[*DOORS][self.door]}" + ("" if self.place is None else f" place={self.place}")

    def entered(self, state: State) -> State:
        """Return the state with a mechanism running, and nothing on it but its sentence."""
        shown = Look(hud=False, theme=state.look.theme)
        place = state.place if self.place is None else self.place
        entry = state.shelf[place % len(state.shelf)]
        scene = load(entry) if isinstance(entry, str) else entry
        return with_scene(replace(state.with_mode(replace(self, place=place)), look=shown), scene)

    def carried(self, state: State, action: Action) -> State:
        """Go through a door, or choose one."""
        if action.name == "back":
            return with_toast(state, said("Q quits"))
        if action.name in _HELD:
            return _HELD[action.name](state, action.value)
        if action.name == "shelf":
            return shelving.toggle(leave(state), None)
        if action.name == "pencil":
            return _through(state, [*DOORS].index("path"))
        if action.name in _IGNORED or (action.name == "option" and action.value not in range(len(DOORS))):
            return state
        door, taken = chosen_by(action, self.door, len(DOORS)) or (self.door, True)
        return _through(state, door) if taken else state.with_mode(replace(self, door=door))

    def aged(self, state: State) -> State:
        """Go on to the next mechanism when one has run for a while."""
        if state.arrived is None or state.frame - state.arrived < EACH or state.grasp:
            return state
        further = replace(self, place=((self.place or 0) + 1) % len(state.shelf))
        return further.entered(state.with_mode(further))

    def panel(self, state: State) -> GamePanel:
        """Return the name and the doors."""
        (run, mechanism), *others = DOORS.values()
        mechanism = state.beneath.scene.title if state.beneath else mechanism
        return GamePanel(
            _NAME,
            lines=(said(_TITLE_ABOUT),),
            choices=choices_of([(run, mechanism), *others]),
            subject=said(state.scene.title),
            lines_after=(said(state.scene.look_at),),
            hint=said(_HINT),
            large=True,
            chosen=self.door,
        )


def _through(state: State, door: int) -> State:
    """Go through a door, which will be the first one the next time."""
    name = [*DOORS][door]
    state = with_effect(state, "score", f"door={name}")
    if name == "play":
        return begun(state, "lobby")
    state = leave(state)
    if name == "path":
        return pencil(leave_sheet(state), None)
    if name == "run":
        state = leave_sheet(state)
        return replace(state, clock=state.clock.pause(state.frame, False))
    return state if state.building else build(state, None)


def read_title(words: GameWords) -> Title:
    """Return the title that words begin; BadInput where they do not."""
    names = [*DOORS]
    door = words.text("door")
    place = words.whole("place", 0, 0, 10_000) if "place" in words.fields else None
    return Title(names.index(door) if door in names else 0, place)


def read(words: GameWords) -> Title | Lobby | Menu:
    """Return the page that words begin; BadInput where they do not."""
    if words.kind == "title":
        return read_title(words)
    return read_lobby(words) if words.kind == "lobby" else read_menu(words)
