"""What the window is given to play with: the games, and what of them is kept."""

from __future__ import annotations

from pathlib import Path
from random import Random
from typing import TYPE_CHECKING

from linkanim.errors import LinkanimError
from linkanim.play.games import game_of
from linkanim.play.words import GameWords
from linkanim.player.state.state import Game
from linkanim.user_data import kept_as

if TYPE_CHECKING:
    from linkanim.play.question import QuestionId
    from linkanim.play.scores import Scores

# Questions and the file are imported when they are needed: the first frame of a scene does not wait for them.

_AGAIN = 3
"""So many questions of earlier rounds come again in one."""
_SEEDS = 10**6


class Arcade:
    """The games of a window, and the file in which best scores and what was missed are kept.

    Without a path it is the user's own; it is read when first needed, and written after each answer. Another
    window may write it, too: each change is made to what is there at the moment.
    """

    def __init__(self, path: Path | None = None, random: Random | None = None) -> None:
        self._path, self._random = path, random or Random()
        self._news: list[str] = []

    def game_of(self, words: str) -> Game:
        """Return the game that words begin; BadInput where they name none."""
        return game_of(words)

    def completed(self, words: str) -> str:
        """Return a game's words with a seed, best scores, and what was missed."""
        found, scores = GameWords.of(words), self._scores()
        match found.kind:
            case "title":
                return str(found.having(door=scores.door or "play"))
            case "menu":
                best = ",".join(f"{name}:{score}" for name, score in scores.best.items())
                return str(found.having(best=best))
            case "follow":
                from linkanim.play.follow import read as run_of

                return str(found.having(best=scores.best.get(run_of(found).kept_as, 0)))
            case "match":
                from linkanim.play.match.game import first_unsolved
                from linkanim.play.match.game import read as level_of

                found = found if "level" in found.fields else found.having(level=first_unsolved(scores.best))
                return str(found.having(best=scores.best.get(level_of(found).kept_as, 0)))
            case "predict":
                again = ",".join(map(str, self._again(found, scores)))
                return str(found.having(seed=self._random.randrange(_SEEDS), again=again))
        return words

    def _again(self, words: GameWords, scores: Scores) -> list[QuestionId]:
        """Return what was missed of a chapter and level, the longest ago first."""
        from linkanim.play.chapters import ALL, members
        from linkanim.play.kinds.table import of_level

        scenes = members(words.text("chapter", ALL))
        kinds = of_level(words.whole("level", 1, 1, 3))
        return [
            question_id
            for question_id in scores.missed
            if question_id.scene in scenes and question_id.kind in kinds
        ][:_AGAIN]

    def keep(self, words: str) -> None:
        """Keep what a game leaves; what cannot be kept is news."""
        from linkanim.play.scores import save

        name, _, value = words.partition("=")
        try:
            before = self._scores()
            after = before.having(name, value)
            if after != before:
                save(after, self._file)
        except LinkanimError as error:
            self._news.append(f"{error}; scores are not kept")

    def news(self) -> list[str]:
        """Return what there is to say about the file, once."""
        news, self._news = self._news, []
        return news

    @property
    def _file(self) -> Path:
        return self._path or kept_as("scores.json")

    def _scores(self) -> Scores:
        from linkanim.play.scores import loaded

        scores, sentence = loaded(self._file)
        if sentence:
            self._news.append(sentence)
        return scores
