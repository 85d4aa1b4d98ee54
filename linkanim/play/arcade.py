"""What a window is given of games: the table of games, and the stored results."""

from __future__ import annotations

from itertools import islice
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING

from linkanim.atomic_files import kept_as
from linkanim.errors import LinkanimError
from linkanim.play.games import GameWords, game_of
from linkanim.player.state import Game
from linkanim.words import said, to_say

if TYPE_CHECKING:
    from linkanim.play.question import QuestionId
    from linkanim.play.scores import Scores

# Questions and the file are imported when they are needed: the first frame of a scene does not wait for them.

_AGAIN = 3
"""The most questions of earlier rounds that come again in a round."""
_SEEDS = 10**6
GREETING = to_say("move the mouse for tools, H for keys")
_SILENT = 45
"""How often it is asked for news before it greets, so that the first pictures do not wait for the file."""
_MOST_WAITING = 1_000
"""The most changes that wait to be stored."""


class Arcade:
    """The games of a window, and the file in which best scores and missed questions are stored.

    Without a path it is the user's own file; it is read when first needed, and written after each answer.
    Another window may write it, too: each change is made to the file's present content. A change that cannot
    be stored is tried again with the next one. With `greets` the user's first window says how to begin.
    """

    def __init__(
        self, path: Path | None = None, random: Random | None = None, *, greets: bool = False
    ) -> None:
        self._path, self._random = path, random or Random()
        self._silent: int | None = _SILENT if greets else None
        self._news: list[str] = []
        self._said = ""
        self._waiting: tuple[str, ...] = ()

    def game_of(self, words: str) -> Game:
        """Return the game that words begin; BadInput where they name none."""
        return game_of(words)

    def completed(self, words: str) -> str:
        """Return a game's words with a seed, best scores, and missed questions."""
        game, scores = GameWords.of(words), self._scores()
        match game.kind:
            case "title":
                return str(game.having(door=scores.door or "run"))
            case "menu":
                from linkanim.play.menus import is_round

                rounds = (f"{name}:{score}" for name, score in scores.best.items() if is_round(name))
                return str(game.having(best=",".join(rounds)))
            case "follow":
                from linkanim.play.follow import read as run_of

                return str(game.having(best=scores.best.get(run_of(game).kept_as, 0)))
            case "match":
                from linkanim.play.match import first_unsolved
                from linkanim.play.match import read as level_of

                game = game if "level" in game.fields else game.having(level=first_unsolved(scores.best))
                return str(game.having(best=scores.best.get(level_of(game).kept_as, 0)))
            case "predict":
                from linkanim.play.predict import read as round_of

                again = ",".join(map(str, self._again(game, scores)))
                best = scores.best.get(round_of(game).kept_as, 0)
                return str(game.having(seed=self._random.randrange(_SEEDS), again=again, best=best or ""))
        return words

    def _again(self, words: GameWords, scores: Scores) -> list[QuestionId]:
        """Return the missed questions of a chapter and level that can still be asked, the oldest first."""
        from linkanim.play.games import ALL, members
        from linkanim.play.kinds import of_level
        from linkanim.play.quiz import is_question

        scenes = members(words.text("chapter", ALL))
        kinds = of_level(words.whole("level", 1, 1, 3))
        fitting = (one for one in scores.missed if one.scene in scenes and one.kind in kinds)
        return list(islice(filter(is_question, fitting), _AGAIN))

    def keep(self, words: str) -> None:
        """Store a game's result; where that fails, `news` says so."""
        from linkanim.play.scores import keep

        self._waiting = (*self._waiting, words)[-_MOST_WAITING:]
        try:
            self._say(keep(self._waiting, self._file, own=self._path is None))
            self._waiting = ()
        except LinkanimError as error:
            self._say(said("{error}; scores are not kept", error=error))

    def _say(self, sentence: str | None) -> None:
        """Add a sentence to the news, unless it was the last one."""
        if sentence and sentence != self._said:
            self._news.append(sentence)
        self._said = sentence or ""

    def news(self) -> list[str]:
        """Return messages about the file, each once; after a while, how to begin, only once ever."""
        if self._silent is not None:
            self._silent = self._silent - 1 or None
            if self._silent is None and not self._scores().greeted:
                self._news.append(said(GREETING))
                self.keep("greeted=yes")
        news, self._news = self._news, []
        return news

    @property
    def _file(self) -> Path:
        return self._path or kept_as("scores.json")

    def _scores(self) -> Scores:
        """Return the stored scores; empty ones where the file cannot be read, which `news` then says."""
        from linkanim.play.scores import Scores, load

        try:
            return load(self._file)
        except LinkanimError:
            return Scores()
