"""Predict: the mechanism stands still, a question is asked, then it runs and shows the answer."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from math import pi, radians, sin
from random import Random
from typing import NamedTuple

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.picture.game_panel import Choice, GamePanel, Mood
from linkanim.picture.look import Look
from linkanim.picture.marks import Spot
from linkanim.play.games import ALL, LEVELS, GameWords, begun, members, titled
from linkanim.play.kinds import of_level
from linkanim.play.question import QuestionId, QuizAnswer, QuizQuestion
from linkanim.play.quiz import next_question, pose_words, question_of
from linkanim.player.action import Action
from linkanim.player.actions import with_scene
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.state import Game, State, proved, with_effect
from linkanim.scenes import load
from linkanim.scenes.scene import Scene
from linkanim.units import shown
from linkanim.words import said, said_as

COUNT = 10
"""The questions of a round, before missed ones come again."""
POINTS, BONUS, STREAK, SECOND = 100, 50, 10, 40
"""The points of a right answer, the most for its speed, for each right one before, for a repeated one."""
QUICK = 20 * FRAMES_PER_SECOND
"""The frames within which an answer earns a part of the bonus."""
TRIES = 3
"""The most questions of a missed kind that come again, until one of them is answered right."""
_SCENES = 4
"""The scenes that are tried for another question of a kind."""
_LONGEST_STREAK = 5
_HOLD = 2 * FRAMES_PER_SECOND
"""The frames for which the answer stands at the question's pose before the input moves."""
_SWEEP, _WIDE = 4 * FRAMES_PER_SECOND, radians(15.0)
"""The frames for which the input then swings about that pose, and how far to each side."""
_SLOW = -4
"""The input's speed where the answer is at another pose, in rungs of the clock's ladder."""
_BARE = Look(hud=False, trace=False, names=1)


class GivenAnswer(NamedTuple):
    """An answered question: whether the answer was right, and after how many frames."""

    question_id: QuestionId
    right: bool
    frames: int

    def __str__(self) -> str:
        return f"{self.question_id}:{int(self.right)}:{self.frames}"


@frozen
class Predict(Game):
    """A round about a chapter's scenes, at a level; questions missed in earlier rounds, `again`, come first.

    `question` is asked since frame `since`, and is None at the end; `chosen` is the answer taken, `coming`
    the next question with its scene, once it is made. `best` is the best score before this round.
    """

    chapter: str
    level: int
    seed: int
    again: tuple[QuestionId, ...] = ()
    done: tuple[GivenAnswer, ...] = ()
    question: QuizQuestion | None = None
    since: int = 0
    chosen: int | None = None
    coming: tuple[QuizQuestion, Scene] | None = None
    best: int = 0

    @property
    def words(self) -> str:
        """The words that begin an equal round; the present question is asked anew."""
        done = self.done if self.chosen is None else self.done[:-1]
        words = GameWords("predict", {}).having(chapter=self.chapter, level=self.level, seed=self.seed)
        words = words.having(again=",".join(map(str, self.again)), done=",".join(map(str, done)))
        return str(words.having(best=self.best or ""))

    @property
    def kept_as(self) -> str:
        """The name under which the best score of such a round is stored."""
        return f"{self.chapter.replace(' ', '_')}.{self.level}"

    @property
    def missed(self) -> tuple[QuestionId, ...]:
        """The questions of the first pass that were not answered right, which come again."""
        return tuple(one.question_id for one in self.done[:COUNT] if not one.right)

    @property
    def score(self) -> int:
        """The points of all answers."""
        return sum(points(self.level, self.done, n) for n in range(len(self.done)))

    @property
    def is_over(self) -> bool:
        """Whether all questions were asked."""
        return len(self.done) >= COUNT and self._comes_again is None

    @property
    def _comes_again(self) -> tuple[int, int] | None:
        """Which missed question is asked again, and how often it was before; None where none is left.

        The first time it is the same question, then others of its kind, until one is answered right.
        """
        answers = iter(self.done[COUNT:])
        for number in range(len(self.missed)):
            for time in range(TRIES):
                answer = next(answers, None)
                if answer is None:
                    return number, time
                if answer.right:
                    break
        return None

    @property
    def _asked(self) -> Predict:
        """The round as it was when the shown question was asked."""
        return self if self.chosen is None else replace(self, done=self.done[:-1])

    def entered(self, state: State) -> State:
        """Ask the next question, or say at the end how it went."""
        if self.is_over:
            return state.with_mode(replace(self, question=None, chosen=None, since=state.frame))
        question, scene = self.coming or self._next()
        state = replace(state, look=replace(_BARE, theme=state.look.theme))
        state = with_scene(state, scene, question.phase, paused=True)
        game = replace(self, question=question, chosen=None, coming=None, since=state.frame)
        places = tuple(complex(*one.place) for one in question.answers if one.place)
        return replace(state.with_mode(game), also=places)

    def _next(self) -> tuple[QuizQuestion, Scene]:
        """Return the next question, and its scene, which has arrows where they explain the answer."""
        question = self._due()
        return question, proved(
            replace(question.scene, trace=question.arrows or question.scene.trace), question.phase
        )

    def _due(self) -> QuizQuestion:
        """Return the next question: one of an earlier round, a new one, or a missed one.

        New questions are about all scenes of the chapter before a scene is repeated.
        """
        number = len(self.done)
        if number < len(self.again[:COUNT]):
            return question_of(self.again[number])
        if number >= COUNT and self._comes_again is not None:
            place, time = self._comes_again
            return self._alike(self.missed[place]) if time else question_of(self.missed[place])
        scenes = members(self.chapter)
        order = Random(self.seed).sample(scenes, len(scenes))
        scene = load(order[number % len(order)])
        before = [*self.again, *(one.question_id for one in self.done)]
        return next_question(scene, f"{self.seed} {number}", before, of_level(self.level))

    def _alike(self, missed: QuestionId) -> QuizQuestion:
        """Return another question of the missed one's kind; the same question where there is no other."""
        scenes, seed = members(self.chapter), f"{self.seed} {len(self.done)}"
        before = [*self.again, *(one.question_id for one in self.done)]
        for name in Random(seed).sample(scenes, min(len(scenes), _SCENES)):
            another = next_question(load(name), seed, before, (missed.kind,))
            if another.kind == missed.kind:
                return another
        return question_of(missed)

    def carried(self, state: State, action: Action) -> State:
        """Take an answer, go on to the next question, or leave."""
        if action.name == "back":
            return self._begun(state, "menu")
        if self.question is None:
            again = action.name == "next" or (action.name, action.value) == ("option", 0)
            others = (action.name, action.value) == ("option", 1)
            return self._begun(state, "predict" if again else "menu") if again or others else state
        if action.name == "option" and isinstance(action.value, int):
            return self._with_answer(state, self.question, action.value) if self.chosen is None else state
        if action.name == "next" and self.chosen is not None:
            return self.entered(state)
        return state

    def _begun(self, state: State, kind: str) -> State:
        return begun(state, kind, chapter=self.chapter, level=self.level)

    def _with_answer(self, state: State, question: QuizQuestion, chosen: int) -> State:
        """Take an answer: the arrows appear, and after a while the input runs."""
        if not 0 <= chosen < len(question.answers):
            return state
        right = chosen == question.right
        done = (*self.done, GivenAnswer(question.question_id, right, state.frame - self.since))
        look = replace(question.shows, hud=False, trace=False, theme=state.look.theme)
        look = replace(look, zoom=state.look.zoom, pan=state.look.pan)
        game = replace(self, done=done, chosen=chosen, since=state.frame)
        state = replace(state.with_mode(game), look=look)
        again = self._comes_again if len(self.done) >= COUNT else None
        about = question.question_id if again is None else self.missed[again[0]]
        state = with_effect(state, "score", f"{'met' if right else 'missed'}={about}")
        if slip := question.answers[chosen].slip:
            state = with_effect(state, "score", f"slip={slip}")
        over = replace(self, done=done)
        if over.is_over:
            state = with_effect(state, "score", f"best={self.kept_as}:{over.score}")
        return state

    def aged(self, state: State) -> State:
        """Move the input after the answer has been shown for a while, up to where it has to stop."""
        if self.question is None or self.chosen is None:
            return state
        gone = state.frame - self.since
        if gone == _HOLD // 2 and not self.is_over:
            # made while the picture is still
            return state.with_mode(replace(self, coming=self._next()))
        if gone < _HOLD:
            return state
        if self._runs:
            return self._run_on(state, self.question, begins=gone == _HOLD)
        part = min((gone - _HOLD) / _SWEEP, 1.0)
        phase = self.question.phase + (_WIDE * sin(2 * pi * part) if part < 1.0 else 0.0)
        return replace(state, clock=state.clock.go(state.frame, phase, paused=True))

    @property
    def _runs(self) -> bool:
        """Whether the answer shows at another pose, or over a whole period; else near the question's pose."""
        question = self.question
        if question is None or question.stops == question.phase:
            return False
        return question.stops is not None or bool(question.shows.chart or question.shows.ghost)

    def _run_on(self, state: State, question: QuizQuestion, *, begins: bool) -> State:
        """Let the input run up to where the answer shows; else once round, back to the question's pose."""
        clock, period = state.clock, state.scene.period
        if begins:
            slow = clock if question.shows.chart or question.shows.ghost else clock.faster(state.frame, _SLOW)
            return replace(state, clock=slow.pause(state.frame, False))
        if clock.paused:
            return state
        goal, sense = (
            question.phase if question.stops is None else question.stops,
            1 if clock.speed > 0 else -1,
        )
        ahead = (goal - state.phase) * sense % period
        if ahead <= abs(clock.speed) / FRAMES_PER_SECOND:
            return replace(state, clock=clock.go(state.frame, goal, paused=True))
        return state

    def _answers(self, question: QuizQuestion) -> list[tuple[int, tuple[QuizAnswer, Mood]]]:
        """Return the answers with their numbers, and how each is shown."""
        moods = (self._mood(n) for n in range(len(question.answers)))
        return [*enumerate(zip(question.answers, moods, strict=True), 1)]

    def spots(self, state: State) -> tuple[Spot, ...]:
        """Return the answers that are places, as long as the linkage stands there."""
        question = self.question
        if question is None or not (self.chosen is None or state.phase == question.phase):
            return ()
        answers = self._answers(question)
        return tuple(Spot(f"{n}", one.place, mood) for n, (one, mood) in answers if one.place)

    def panel(self, state: State) -> GamePanel:
        """Return the question, or the verdict on its answer."""
        del state
        if self.question is None:
            return self._end_panel()
        question = self.question
        answers = self._answers(question)
        choices = tuple(
            Choice(
                f"{n}",
                one.text if question.kind != "instant centre" else said("at {letter}", letter=n),
                mood,
                curve=one.curve,
            )
            for n, (one, mood) in answers
        )
        waits = self.chosen is None
        panel = GamePanel(
            titled(self.chapter),
            scores=self._scores(),
            lines=(question.text,),
            aside=pose_words(question),
            choices=choices,
            hint=said("1–4 or a click answers   Esc leaves") if waits else said("Enter goes on   Esc leaves"),
        )
        return panel if waits else self._verdict(panel, question)

    def _mood(self, n: int) -> Mood:
        assert self.question
        if self.chosen is None:
            return ""
        return "right" if n == self.question.right else "wrong" if n == self.chosen else "faint"

    def _scores(self) -> tuple[str, ...]:
        number = len(self.done) + (self.chosen is None)
        again = self._asked._comes_again if number > COUNT else None
        place = f"{number} / {COUNT}"
        if again is not None:
            place = said("again {number} / {count}", number=again[0] + 1, count=len(self.missed))
        row = said("{count} in a row", count=_streak(self.done))
        return place, row, said("{count} points", count=self.score)

    def _verdict(self, panel: GamePanel, question: QuizQuestion) -> GamePanel:
        assert self.chosen is not None
        well = self.chosen == question.right
        gained = points(self.level, self.done, len(self.done) - 1)
        slip = question.answers[self.chosen].slip
        if well:
            verdict = said("Right: {count} points", count=gained)
        else:
            verdict = said("No: that is {slip}.", slip=slip) if slip else said("No.")
        return replace(panel, verdict=verdict, well=well, lines_after=(question.why,))

    def _end_panel(self) -> GamePanel:
        first = self.done[:COUNT]
        right = sum(one.right for one in first)
        frames = sum(one.frames for one in self.done)
        longest = max((_streak(self.done[:n]) for n in range(len(self.done) + 1)), default=0)
        return GamePanel(
            said("{count} points", count=self.score),
            scores=(titled(self.chapter), said("level {number}", number=self.level)),
            lines=(
                said(
                    "{right} of {count} right at first, {longest} in a row at best.",
                    right=right,
                    count=len(first),
                    longest=longest,
                ),
                said("{time} s for all answers.", time=f"{frames / FRAMES_PER_SECOND:.0f}"),
                self._best_words(),
                *self._missed_words(),
            ),
            choices=(
                Choice("1", said("Another round"), below=said("what was missed comes first")),
                Choice("2", said("Another chapter or level")),
            ),
            hint=said("Enter: another round   Esc: other rounds"),
            large=True,
            chosen=0,
        )

    def _best_words(self) -> str:
        """Say the best score of such a round."""
        if self.score <= self.best:
            return said("The best is {best} points.", best=self.best)
        return (
            said("The best so far; before, it was {best}.", best=self.best)
            if self.best
            else said("The first score of its kind.")
        )

    def _missed_words(self) -> Iterator[str]:
        """Yield the missed questions, by kinds, and their scenes; nothing where all answers were right."""
        wrong = [one.question_id for one in self.done[:COUNT] if not one.right]
        if wrong:
            kinds = Counter(one.kind for one in wrong)
            comma = said_as("list", ", ")
            missed = comma.join(
                said("{kind} ({count} times)", kind=said(kind), count=count) if count > 1 else said(kind)
                for kind, count in kinds.items()
            )
            titles = comma.join(dict.fromkeys(said(load(one.scene).title) for one in wrong))
            yield said("Missed at first: {kinds}.", kinds=missed)
            yield said("In: {titles}.", titles=titles)


def _streak(done: tuple[GivenAnswer, ...]) -> int:
    """Return how many of the latest answers in a row were right."""
    wrong = [n for n, one in enumerate(done) if not one.right]
    return len(done) - 1 - wrong[-1] if wrong else len(done)


def points(level: int, done: tuple[GivenAnswer, ...], n: int) -> int:
    """Return the points of the answer numbered `n`."""
    one = done[n]
    if not one.right:
        return 0
    if n >= COUNT:
        return SECOND * level
    quick = BONUS * max(QUICK - one.frames, 0) // QUICK
    return (POINTS + quick) * level + STREAK * min(_streak(done[:n]), _LONGEST_STREAK)


def read(words: GameWords) -> Predict:
    """Return the round that words begin; BadInput where they do not."""
    chapter = words.text("chapter", ALL)
    members(chapter)
    again = tuple(QuestionId.of(text) for text in words.fields.get("again", "").split(",") if text)
    done = tuple(_answer_from(text) for text in words.fields.get("done", "").split(",") if text)
    return Predict(
        chapter,
        words.whole("level", 1, LEVELS[0], LEVELS[-1]),
        words.whole("seed"),
        again,
        done,
        best=words.whole("best", 0),
    )


def _answer_from(text: str) -> GivenAnswer:
    question_id, *marks = text.rsplit(":", 2)
    if len(marks) != 2 or marks[0] not in ("0", "1") or not marks[1].isdecimal():
        raise BadInput(f"{shown(text)} is no answer; one is QUESTION:0 or 1:FRAMES")
    return GivenAnswer(QuestionId.of(question_id), marks[0] == "1", int(marks[1]))
