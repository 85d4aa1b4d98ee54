"""What there is to play: rounds by chapter and level, with the best scores."""

from __future__ import annotations

from dataclasses import dataclass, replace

from linkanim.errors import BadInput
from linkanim.picture.panels.overlay import Choice, GamePanel, Overlay
from linkanim.play.chapters import ALL, members, titled
from linkanim.play.choosing import OverWhatRuns, begun, chosen_by
from linkanim.play.kinds.table import LEVELS
from linkanim.play.words import GameWords
from linkanim.player.state.action import Action
from linkanim.player.state.state import State
from linkanim.scenes import chapters, names
from linkanim.units import shown

_ABOUT = {
    1: "which way, how fast, how far",
    2: "dead centres, closures, curves",
    3: "instant centres and forces",
}


@dataclass(frozen=True)
class Menu(OverWhatRuns):
    """The choice of a round: the chapter that Enter takes, the level, and the best score of each."""

    chapter: str
    level: int
    best: tuple[tuple[str, int], ...] = ()

    @property
    def words(self) -> str:
        """What begins it again."""
        best = ",".join(f"{name}:{score}" for name, score in self.best)
        return str(GameWords("menu", {}).having(chapter=self.chapter, level=self.level, best=best))

    def carried(self, state: State, action: Action) -> State:
        """Choose a chapter or a level, begin a round, or go back."""
        rows = self._rows(state)
        if action.name == "back":
            return begun(state, "lobby")
        if action.name == "turn" and isinstance(action.value, int):
            level = min(max(self.level + (1 if action.value > 0 else -1), LEVELS[0]), LEVELS[-1])
            return replace(state, game=replace(self, level=level))
        if (action.name, action.value) == ("option", len(rows)):
            return replace(state, game=replace(self, level=self.level % LEVELS[-1] + 1))
        chosen = chosen_by(action, rows.index(self.chapter), len(rows))
        if chosen is None:
            return state
        state = replace(state, game=replace(self, chapter=rows[chosen.row]))
        return begun(state, "predict", chapter=rows[chosen.row], level=self.level) if chosen.taken else state

    def _rows(self, state: State) -> tuple[str, ...]:
        """Return what a round can be about: all, a chapter, and the mechanism that was on before."""
        before = state.beneath.scene.name if state.beneath else ""
        own = (name for name in (self.chapter, before) if name in names())
        return tuple(dict.fromkeys((ALL, *chapters(), *own)))

    def shown(self, state: State, over: Overlay) -> Overlay:
        """Return the overlay with the chapters."""
        best = {name: f"best {score}" for name, score in self.best}
        choices = tuple(
            Choice(f"{n}", titled(chapter), below=best.get(f"{chapter.replace(' ', '_')}.{self.level}", ""))
            for n, chapter in enumerate(self._rows(state), 1)
        )
        level = Choice(f"{len(choices) + 1}", f"Level {self.level}", below=_ABOUT[self.level])
        panel = GamePanel(
            "Predict",
            lines=("Ten questions, before it moves.",),
            choices=(*choices, level),
            hint="Enter begins   ↑ ↓ chapter   ← → level   Esc goes back",
            chosen=self._rows(state).index(self.chapter),
        )
        return replace(over, game=panel)


def is_round(name: str) -> bool:
    """Tell whether a best score is that of a round which the menu shows."""
    chapter, _, level = name.rpartition(".")
    known = (ALL, *chapters(), *names())
    return chapter.replace("_", " ") in known and level in map(str, LEVELS)


def read(words: GameWords) -> Menu:
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
