"""Make a question about a linkage at a pose: its text, its answers, what it is made from.

How numbers and directions are written in questions, and how many answers there are, is here, too.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Collection, Iterable, Iterator
from functools import cached_property
from math import degrees, isfinite, pi
from random import Random
from typing import NamedTuple, Self

import numpy as np

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Body, Point, holding
from linkanim.mechanics.motion import Motion, Pose
from linkanim.mechanics.program import Array
from linkanim.mechanics.quantities import phrase
from linkanim.picture.figure import Figure, figure
from linkanim.picture.look import Look
from linkanim.scenes.scene import Scene
from linkanim.units import short, shown, significant, typeset
from linkanim.words import said, to_say

# A question about a linkage at a pose, and what it is made from.

CLEAR = 0.02
"""Values that differ by less than this share of their range look alike; a value below it counts as zero."""
PLAIN = 0.1
"""The least share of a greatest value that is obvious at once."""


class QuizAnswer(NamedTuple):
    """An answer; for a wrong one, the misconception that it comes from, to be read after "that is".

    An answer that no misconception leads to names none. Where answers are places (in the scene's unit, at the
    phase) or curves (values from −1 to 1 over one period), it has its place or its curve.
    """

    text: str
    slip: str = ""
    place: Point | None = None
    curve: tuple[float, ...] = ()
    alphabet: str = ""
    """Its words in English, by which answers are ordered in every language; "" where they are its text."""


def either(answers: tuple[str, str], first: bool, slip: str) -> tuple[QuizAnswer, list[QuizAnswer]]:
    """Return the right one of two answers, the `first` or the other one, and the wrong one with its slip.

    The answers are English, and said here.
    """
    right, wrong = answers if first else answers[::-1]
    return QuizAnswer(said(right), alphabet=right), [QuizAnswer(said(wrong), slip, alphabet=wrong)]


class QuestionId(NamedTuple):
    """The identity of a question: enough to make exactly the same question again."""

    kind: str
    scene: str
    phase: float
    subject: str

    @classmethod
    def of(cls, text: str) -> Self:
        """Read an identity as `str` writes it; BadInput for other text."""
        try:
            kind, scene, phase, subject = text.split("@")
            return cls(kind.replace("_", " "), scene, float(phase), subject)
        except ValueError:
            raise BadInput(f"{shown(text)} is no question; one is KIND@SCENE@PHASE@SUBJECT") from None

    def __str__(self) -> str:
        return f"{self.kind.replace(' ', '_')}@{self.scene}@{self.phase!r}@{self.subject}"


@frozen
class QuizQuestion:
    """A question with its answers, of which one is right, and why.

    `subject` is the token of the body, the joint or the input that it is about. The look that `shows` the
    answer has arrows at the joints `arrows`; the input then runs on to the phase at which it `stops`. While
    the question is asked, the look has these `names`, which do not give the answer away.
    """

    kind: str
    scene: Scene
    phase: float
    subject: str
    text: str
    answers: tuple[QuizAnswer, ...]
    right: int
    why: str
    shows: Look
    arrows: tuple[str, ...]
    stops: float | None

    @property
    def question_id(self) -> QuestionId:
        """The identity from which the question can be made again."""
        return QuestionId(self.kind, self.scene.name, self.phase, self.subject)


@frozen
class Puzzle:
    """A scene at a phase, with a source of random choices, from which a question is made."""

    kind: str
    scene: Scene
    phase: float
    random: Random

    @cached_property
    def pose(self) -> Pose:
        """The pose at the phase."""
        return self.scene.pose(self.phase)

    @cached_property
    def cycle(self) -> Motion:
        """One true period, whose greatest values decide what is clear to see."""
        return self.figure.cycle

    @cached_property
    def figure(self) -> Figure:
        """The scene's figure."""
        return figure(self.scene)

    @property
    def turning(self) -> tuple[Body, ...]:
        """The bodies that turn in another way than the input; geared cranks where there are no others."""
        linkage = self.scene.linkage
        cranks = {body: linkage.crank_of(body) for body in linkage.bodies if body.slider is None}
        driven = [body for body, crank in cranks.items() if crank is None]
        geared = [body for body, crank in cranks.items() if crank and crank.gear]
        return tuple(driven or geared)

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints that are drawn and move."""
        fixed = {pin.name for pin in self.scene.linkage.pins}
        return tuple(name for name in self.figure.in_view if name not in fixed)

    def vector(self, kind: str, name: str) -> complex:
        """Return a joint's position, velocity or acceleration at the pose, x + yi."""
        return complex(*getattr(self.pose, kind)[name])

    def apart(self, one: str, other: str) -> complex:
        """Return the vector from one joint to another."""
        return self.vector("position", other) - self.vector("position", one)

    def bodies_of(self, *joints: str) -> Iterator[Body]:
        """Yield the named bodies that turn and carry all these joints."""
        rigid = self.scene.linkage.rigid_bodies
        turning = (body for body in self.scene.linkage.bodies if body.slider is None)
        return (body for body in turning if holding(rigid, (*body.joints, *joints)))

    def pivot_of(self, joint: str) -> str | None:
        """Return the fixed pin about which a joint turns; None where there is none."""
        linkage = self.scene.linkage
        pins = (linkage.pivot(frame) for frame in linkage.rigid_bodies[1:] if joint in frame)
        return next((pin for pin in pins if pin not in (None, joint)), None)

    def centre_of(self, body: Body) -> tuple[complex, str]:
        """Return the place about which a body turns at the pose, infinite without one, and its name."""
        place = complex(self.value(f"{body.name}.pole.x"), self.value(f"{body.name}.pole.y"))
        return place, self.scene.linkage.pivot(body.joints) or said(
            "the instant centre of {name}", name=self.name(body)
        )

    def name(self, body: Body) -> str:
        """Return a body's name, with its number where the scene gives one."""
        names = self.scene.info.link_names
        numbered = names[body.name] != body.name and body.name.isdecimal()
        return f"{phrase(body, names)} ({body.name})" if numbered else phrase(body, names)

    def value(self, token: str) -> float:
        """Return a quantity's value at the pose; infinite where it is unbounded."""
        return float(self.scene.quantities[token].read(self.pose))

    def values(self, token: str) -> Array:
        """Return a quantity's values over the period."""
        return np.asarray(self.scene.quantities[token].read(self.cycle), np.float64)

    def share(self, token: str) -> float:
        """Return a quantity at the pose over its greatest size in the period, -1 … 1; 0 where that is 0."""
        sizes = np.abs(self.values(token))
        greatest = float(np.max(sizes[np.isfinite(sizes)], initial=0.0))
        value = self.value(token)
        return value / greatest if greatest > 0.0 and isfinite(value) else 0.0

    def clear(self, kind: str) -> list[str]:
        """Return the joints whose velocity, or acceleration, is obvious at once."""
        return [name for name in self.joints if self.share(f"{name}.{kind}") > PLAIN]

    def question(
        self,
        subject: str,
        text: str,
        right: QuizAnswer,
        wrong: Iterable[QuizAnswer],
        why: str,
        *,
        shuffled: bool = False,
        shows: Look = Look(names=1),  # noqa: B008 -- frozen
        arrows: Collection[str] = (),
        stops: float | None = None,
    ) -> QuizQuestion:
        """Return the question; its answers are in alphabetical order, or `shuffled`."""
        answers = sorted(
            {one.text: one for one in (*wrong, right)}.values(), key=lambda one: one.alphabet or one.text
        )
        if shuffled:
            self.random.shuffle(answers)
        about = (self.kind, self.scene, self.phase, subject)
        given = (text, tuple(answers), answers.index(right), why)
        return QuizQuestion(*about, *given, shows, tuple(arrows), stops)


# How numbers and directions are written in questions, and how many answers there are.

MOST = 4
"""The most answers of a question."""

WAYS = (to_say("to the right"), to_say("up"), to_say("to the left"), to_say("down"))
"""The compass points of `quarter`, as directions to move, and as places beside something."""
SIDES = (
    to_say("{name} lies to the right of {other}"),
    to_say("{name} lies above {other}"),
    to_say("{name} lies to the left of {other}"),
    to_say("{name} lies below {other}"),
)
BESIDE = (
    to_say("Seen from {other}, {name} lies on the right"),
    to_say("Seen from {other}, {name} lies above"),
    to_say("Seen from {other}, {name} lies on the left"),
    to_say("Seen from {other}, {name} lies below"),
)
TURNS = (to_say("counterclockwise"), to_say("clockwise"))


def quarter(vector: complex) -> int:
    """Return the compass point that is nearest to a vector: 0 right, 1 up, 2 left, 3 down."""
    return round(phase(vector) / (pi / 2)) % 4


def obliquity(vector: complex) -> float:
    """Return the angle between a vector and the nearest compass point, 0 to π/4."""
    return abs(phase(vector * (1, -1j, -1, 1j)[quarter(vector)]))


def number(value: float) -> str:
    """Return a number as it is written in a question."""
    return typeset(short(value) if abs(value) >= 0.1 or not value else significant(value, 3))


def angle(value: float) -> str:
    """Return an angle in words, in degrees within a full turn."""
    return f"{round(value, 1) % 360:.1f}°"


def swing(low: float, high: float, slip: str = "") -> QuizAnswer:
    """Return the range of a swing as an answer, from two angles in degrees."""
    words, ends = to_say("it swings between {low} and {high}"), {"low": tenths(low), "high": tenths(high)}
    return QuizAnswer(said(words, **ends), slip, alphabet=words.format(**ends))


def tenths(value: float) -> str:
    """Return an angle in degrees, of either sign, in words with one decimal."""
    return typeset(f"{round(value, 1) + 0.0:.1f}°")  # -0.0 + 0.0 is 0.0


def between(one: float, other: float) -> float:
    """Return how far two angles in degrees are from each other, 0 to 180."""
    return abs((one - other + 180) % 360 - 180)


def crank_degrees(puzzle: Puzzle, at: float) -> float:
    """Return the input's angle at a phase, 0 to 360."""
    return round(degrees(puzzle.scene.pose(at, 0).coordinate), 9) % 360
