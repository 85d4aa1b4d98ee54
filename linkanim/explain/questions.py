"""Ask what an exam asks about a linkage: questions in the order of the solution, each with its way and marks.

A linkage of many dyads is asked about as far as the second of them: no exam goes further.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from math import degrees
from typing import Literal

from linkanim.explain.formula import Formula, Symbol
from linkanim.explain.solution import INPUT_TITLE, Solution
from linkanim.explain.steps import (
    MARKED,
    ORDERS,
    Chapter,
    Equation,
    Given,
    Item,
    Order,
    Step,
    System,
    Unknown,
    ValueLine,
    joint_title,
    marked,
    names_of,
)
from linkanim.explain.whole_motion import is_searched
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import RPP, RPR, Crank, Joint
from linkanim.mechanics.quantities import link_labels, phrase
from linkanim.picture.figure import figure
from linkanim.words import row_said, said, sentences, to_say

_FEWEST, _MOST_DYADS = 5, 2
_DIRECTIONS = {
    0: to_say("to the right"),
    90: to_say("upwards"),
    180: to_say("to the left"),
    270: to_say("downwards"),
}


ExamAnswer = tuple[Formula, str]
"""A number that is asked for: a leaf with its symbol, and its unit."""


@frozen
class ExamQuestion:
    """A question: its words, the numbers asked for, what it is worth, a hint, and the steps that answer it.

    Names of joints in its words are marked.
    """

    text: str
    answers: tuple[ExamAnswer, ...]
    marks: int
    hint: str
    way: tuple[Step, ...]


def questions(solution: Solution) -> tuple[ExamQuestion, ...]:
    """Return five to eight questions on a pose; fewer where it has no rates or a loop has nothing more."""
    return tuple(_Exam(solution).questions())


def given(solution: Solution, asked: Sequence[ExamQuestion]) -> tuple[Item, ...]:
    """Return what a solver of the questions needs besides the figure: numbers, gears, where travels begin."""
    ways = [item for one in asked for step in one.way for item in step.items]
    used = {leaf.symbol for item in ways for leaf in _leaves(item)}
    # what the input does is given, and not how the program lets it swing
    driven = [item for step in solution.positions.steps if step.title == INPUT_TITLE for item in step.items]
    input_ = [
        Given(replace(one.value, shown=f"{one.value.value:g}"), one.unit, "")
        for one in driven
        if isinstance(one, ValueLine)
    ]
    hidden = {leaf.symbol for one in driven for leaf in _leaves(one)} if input_ else set()
    stated = [
        item
        for item in solution.chapters[0].items
        if isinstance(item, Given) and item.value.symbol in used - hidden
    ]
    inside = [item for item in ways if isinstance(item, Given)]
    return (*input_, *stated, *inside, *_gears(solution, ways))


def _leaves(item: Item) -> Iterator[Formula]:
    match item:
        case ValueLine(formula):
            yield from formula.leaves
        case Equation(left, right):
            yield from (*left.leaves, *right.leaves)
        case System(formulas=rows):
            yield from (leaf for row in rows for entry in row for leaf in entry.leaves)


def _gears(solution: Solution, ways: Iterable[Item]) -> Iterator[Item]:
    """Yield the equations of the geared cranks whose angles are worked out."""
    linkage, names = solution.request.scene.linkage, names_of(figure(solution.request.scene))
    geared = [joint for joint in linkage.joints if isinstance(joint, Crank) and joint.gear is not None]
    angles = {Symbol("θ", names.angle(joint.pivot, joint.name)) for joint in geared}
    for item in ways:
        if isinstance(item, ValueLine) and item.value.symbol in angles:
            yield Equation(item.value, item.formula)


class _Exam:
    """The questions on a pose while they are made."""

    def __init__(self, solution: Solution) -> None:
        self.solution, self.scene = solution, solution.request.scene
        self.linkage = self.scene.linkage
        self.names = names_of(figure(self.scene))
        looped = [one for one in solution.loop_chapter.steps if MARKED.search(one.title)]
        self.loops = looped[:_MOST_DYADS]
        self.dyads: list[str] = [MARKED.findall(step.title)[0] for step in self.loops]
        self.shown: set[int] = set()
        """The steps, by identity, that the way of an earlier question has."""

    def questions(self) -> Iterator[ExamQuestion]:
        points = [self._point] if self._point else []
        geared = [] if self.loops else [*self._cranks()]
        if not self.loops and not geared:
            points = list(dict.fromkeys((self.linkage.drive.joint, *points)))
        asked = [*self._closed(), *geared, *map(self._place, points)]
        others = [*self._further(points)]
        if len(asked) + len(others) < _FEWEST and (slopes := self._coefficients()):
            asked.append(slopes)
        yield from (*asked, *others)

    def _closed(self) -> Iterator[ExamQuestion]:
        """Yield the questions on the loops, and on where they close."""
        if self.loops:
            yield self._loop_question()
        for loop, name in zip(self.loops, self.dyads, strict=True):
            yield self._position(loop, name)

    def _further(self, points: Sequence[str]) -> Iterator[ExamQuestion]:
        """Yield the questions on rates, on the whole motion, on forces and on how the linkage was made."""
        if not self.solution.singular:
            for order in ORDERS:
                yield from self._rates(order)
                yield from (self._moving(one, order) for one in points)
        if len(self.loops) < _MOST_DYADS:
            yield from self._whole()
        yield from self._forces()
        yield from self._made()

    # The parts of the solution that lead to an answer.

    def _chapter(self, title: str) -> Chapter:
        """Return the chapter with an English title; one without steps where there is none."""
        return next((one for one in self.solution.chapters if one.title == said(title)), Chapter(title, ()))

    def _index(self, joint: str) -> int:
        return [one.name for one in self.linkage.joints].index(joint)

    def _steps(self, chapter: str, upto: str, coefficients: Literal[0, 1, 2] = 0) -> tuple[Step, ...]:
        """Return the steps of a chapter that no way has yet, up to a joint, and what opens the chapter."""
        before = [joint.name for joint in self.linkage.joints[: self._index(upto) + 1]]
        titles, steps = [joint_title(name, coefficients) for name in before], []
        for n, step in enumerate(self._chapter(chapter).steps):
            wanted = step.title in titles or (n == 0 and not step.title)
            if wanted and id(step) not in self.shown:
                self.shown.add(id(step))
                steps.append(step)
        return tuple(steps)

    def _of_joint(self, chapter: str, joint: str) -> list[ValueLine]:
        title = joint_title(joint)
        steps = [step for step in self._chapter(chapter).steps if step.title == title]
        return [item for step in steps for item in step.items if isinstance(item, ValueLine)]

    @cached_property
    def _last(self) -> str:
        """The last joint that is asked about."""
        names = [joint.name for joint in self.linkage.joints]
        reached = self.dyads or [names[-1]]
        return max(reached, key=names.index)

    @cached_property
    def _point(self) -> str | None:
        """The joint whose motion is asked for: a traced one that the dyads carry, else the first dyad's."""
        if not self.dyads:
            traced = [*self.scene.trace, *(joint.name for joint in reversed(self.linkage.joints))]
            return next((name for name in traced if self._of_joint("Velocities", name)), None)
        slid = {slide.point for joint in self.linkage.joints for slide in joint.slides if slide.start is None}
        for name in (*self.scene.trace, *self.dyads):
            if isinstance(self.linkage.joint(name), Crank):
                continue
            known = name in self.dyads or self._carried(name)
            if known and name not in slid and self._of_joint("Positions", name):
                return name
        return None

    def _carried(self, name: str) -> bool:
        """Return whether a joint is a point of a body whose angle the asked dyads give."""
        joint, known = self.linkage.joint(name), set(self.dyads) | self._before
        return bool(joint.needs) and set(joint.needs) <= known and not joint.dyad and not joint.fixed

    @cached_property
    def _before(self) -> set[str]:
        """The joints that stand before the last dyad asked about."""
        return {joint.name for joint in self.linkage.joints[: self._index(self._last)]}

    # Words.

    def _thing(self, symbol: Symbol) -> str | None:
        """Return what a symbol is of, in words: the rocker; None for a line without a name."""
        labels = {label: name for name, label in link_labels(self.linkage).items()}
        bodies = {body.name: body for body in self.linkage.bodies}
        if symbol.letter in "st":
            joint = self._sliding(symbol)
            if symbol.letter == "t" or isinstance(joint, RPR):
                pin = joint.through if isinstance(joint, RPR) else getattr(joint, "pin", "")
                return said("the pin {pin} in its slot", pin=marked(pin))
            body = next((one for one in self.linkage.bodies if joint and one.slider == joint.name), None)
            return phrase(body, self.scene.info.link_names) if body else said("the slider")
        body = bodies.get(labels.get(symbol.sub, ""))
        return phrase(body, self.scene.info.link_names) if body else None

    def _line(self, index: str) -> str:
        """Return in words the line whose angle has an index."""
        bars = ((start, joint.name) for joint in self.linkage.joints for start, _ in joint.bars)
        ends = next((ends for ends in bars if self.names.angle(*ends) == index), None)
        if ends is None:
            return said("link {name}", name=index)
        return said("the line {start}–{end}", start=marked(ends[0]), end=marked(ends[1]))

    def _sliding(self, symbol: Symbol) -> Joint | None:
        """Return the joint whose travel has a symbol."""
        joints = (joint for joint in self.linkage.joints if joint.travels or isinstance(joint, RPR))
        return next((joint for joint in joints if self.names.slide(joint.name).sub == symbol.sub), None)

    def _things(self, answers: Sequence[ExamAnswer], turning: str, sliding: str) -> str:
        """Return what is asked for in words: the angle of the rod and the travel of the slider."""
        named: dict[str, list[str]] = {}
        for value, _ in answers:
            symbol = value.symbol
            assert symbol is not None
            what = sliding if symbol.letter in "st" else turning
            named.setdefault(what, []).append(self._thing(symbol) or self._line(symbol.sub))
        parts = [
            said(_MEASURES[what][len(things) > 1], things=row_said(things)) for what, things in named.items()
        ]
        return row_said(parts)

    # Questions.

    def _loop_question(self) -> ExamQuestion:
        several = len(self.loops) > 1
        return ExamQuestion(
            said("Write down two vector loops, resolve each into x and y, and name the unknowns.")
            if several
            else said(
                "Write down the vector loop of the linkage, resolve it into x and y, and name the unknowns."
            ),
            (),
            2 * len(self.loops),
            said(
                "Two routes lead from the ground to {joints}.",
                joints=row_said([marked(name) for name in self.dyads]),
            ),
            tuple(self.loops),
        )

    def _unknowns(self, loop: Step) -> tuple[ExamAnswer, ...]:
        symbols = [one for item in loop.items if isinstance(item, Unknown) for one in item.symbols]
        return tuple((one, "°" if one.in_degrees else self.scene.length_unit) for one in symbols)

    def _position(self, loop: Step, name: str) -> ExamQuestion:
        answers = self._unknowns(loop)
        way = self._steps("Positions", name)
        hint = next((item for item in way[-1].items if isinstance(item, str)), "") if way else ""
        found = said("Find {things}.", things=self._things(answers, "angle", "travel"))
        text = sentences(found, *self._counted(answers))
        return ExamQuestion(text, answers, 2 * len(answers), _sentence(hint), way)

    def _counted(self, answers: Sequence[ExamAnswer]) -> Iterator[str]:
        """Yield from where the travels among the answers are counted."""
        for value, _ in answers:
            symbol = value.symbol
            if symbol is None or symbol.letter not in "st":
                continue
            joint = self._sliding(symbol)
            if isinstance(joint, RPR):
                yield said("The travel in the slot is counted from {pivot}.", pivot=marked(joint.pivot))
            line = getattr(joint, "line", None)
            if line is None:
                continue
            if isinstance(joint, RPP) and symbol.letter == "t":
                towards = _direction(line.angle + joint.slot)
                yield said(
                    "The travel of the pin is counted along the slot from the guide, positive {towards}.",
                    towards=towards,
                )
                continue
            foot = (
                said("the foot of {through} on it", through=marked(line.through))
                if line.offset
                else marked(line.through)
            )
            if line.on is not None:
                yield said("The travel is counted along the guide from {foot}.", foot=foot)
                continue
            yield said(
                "The travel is counted along the guide from {foot}, positive {direction}.",
                foot=foot,
                direction=_direction(line.angle),
            )

    def _cranks(self) -> Iterator[ExamQuestion]:
        """Yield the question on the angles of geared cranks, of a linkage without a loop."""
        lines = [
            item
            for joint in self.linkage.joints
            if isinstance(joint, Crank) and joint.gear is not None
            for item in self._of_joint("Positions", joint.name)
            if item.value.symbol and item.value.symbol.letter == "θ"
        ]
        if lines:
            answers = _answers(lines[:_MOST_DYADS])
            way = self._steps("Positions", self._last)
            yield ExamQuestion(
                said("Find {things}.", things=self._things(answers, "angle", "travel")),
                answers,
                2 * len(answers),
                "",
                way,
            )

    def _place(self, joint: str) -> ExamQuestion:
        lines = [one for one in self._of_joint("Positions", joint) if _is_place(one, joint)]
        way = self._steps("Positions", joint)
        return ExamQuestion(
            said("Find the coordinates of {joint}.", joint=marked(joint)),
            _answers(lines),
            2,
            said(_ROTATE),
            way,
        )

    def _rates(self, order: Order) -> Iterator[ExamQuestion]:
        chapter = _CHAPTERS[order]
        letters = "ω" if order == 1 else "α"
        joints = self.dyads or [joint.name for joint in self.linkage.joints]
        lines = [
            line
            for name in joints
            for line in self._of_joint(chapter, name)
            if line.value.symbol and (line.value.symbol.letter in letters or line.value.symbol.letter in "st")
        ]
        if not lines:
            return
        answers = _answers(lines[: 2 * _MOST_DYADS])
        way = (
            *self._steps("Kinematic coefficients", self._last, order),
            *self._steps(chapter, self._last),
        )
        text = said("Find {things}.", things=self._things(answers, *_RATES[order]))
        marks = (1 + order) * len(answers)
        hint = said(_DIFFERENTIATE[order - 1]) if self.dyads else ""
        yield ExamQuestion(text, answers, marks, hint, way)

    def _moving(self, joint: str, order: Order) -> ExamQuestion:
        chapter, letter = _CHAPTERS[order], "va"[order - 1]
        lines = self._of_joint(chapter, joint)
        way = (
            *self._steps("Kinematic coefficients", joint, order),
            *self._steps(chapter, joint),
        )
        sizes = [step for step in self._chapter(chapter).steps if step.title == said("Sizes")]
        size = [
            item
            for step in sizes
            for item in step.items
            if isinstance(item, ValueLine) and item.value.symbol == Symbol(letter, joint)
        ]
        if size:
            way = (*way, Step("", tuple(size)))
        places = [one for one in lines if one.value.symbol and one.value.symbol.letter in "xy"]
        text = said(_MOVING[order], joint=marked(joint))
        return ExamQuestion(text, _answers([*places, *size]), 1 + order, said(_ROTATE_RATE[order - 1]), way)

    def _coefficients(self) -> ExamQuestion | None:
        """Return the question on kinematic coefficients, for a linkage with little else to ask."""
        firsts = [joint_title(joint.name, 1) for joint in self.linkage.joints]
        lines = [
            item
            for step in self._chapter("Kinematic coefficients").steps
            if step.title in firsts
            for item in step.items
            if isinstance(item, ValueLine) and item.value.symbol and item.value.symbol.letter in "hfg"
        ]
        answers = _answers([one for one in lines if one.value.symbol and not one.value.symbol.mark][:2])
        if not answers or self.solution.singular:
            return None
        things = self._things(_as_places(answers), "derivative of the angle", "derivative of the travel")
        text = said(
            "Find {things} with respect to the input (the first kinematic coefficients h and f).",
            things=things,
        )
        return ExamQuestion(text, answers, 2 * len(answers), said(_DIFFERENTIATE[0]), ())

    def _whole(self) -> Iterator[ExamQuestion]:
        """Yield the question on stroke or swing and time ratio, or on how far the input goes."""
        centres = self._chapter("Dead centres and time ratio")
        words = [item for item in centres.items if isinstance(item, str)]
        lines = [item for item in centres.items if isinstance(item, ValueLine)]
        ends = [
            one for one in lines if one.value.symbol in (Symbol("H"), Symbol("ψ", "swing"), Symbol("T", "R"))
        ]
        if len(ends) > 1 and not any(map(is_searched, centres.items)):
            text = (
                said("Find the stroke of the slider and the time ratio, of the slow stroke to the quick one.")
                if ends[0].value.symbol == Symbol("H")
                else said(
                    "Find the swing of the rocker and the time ratio, of the slow stroke to the quick one."
                )
            )
            yield ExamQuestion(
                text,
                _answers(ends),
                4,
                _sentence(re.split(r"(?<=[.:]) |(?<=[。：])", words[0])[0]),
                (*self._needed(lines), *centres.steps),
            )
        elif self.scene.info.grashof:
            step = self._chapter("Range of the input").steps[-1]
            yield ExamQuestion(
                said("Which class of four-bar is it by Grashof's criterion, and can its input turn fully?"),
                (),
                2,
                said("Compare the sum of the shortest and the longest link with that of the other two."),
                (step,),
            )

    def _needed(self, lines: Sequence[ValueLine]) -> Iterator[Step]:
        """Yield the lines on the range of the input that lines on the whole motion go on from."""
        used = {leaf.symbol for line in lines for leaf in line.formula.leaves}
        used -= {line.value.symbol for line in lines}
        before = self._chapter("Range of the input").items
        values = [one for one in before if isinstance(one, ValueLine) and one.value.symbol in used]
        if values:
            yield Step("", tuple(values))

    def _forces(self) -> Iterator[ExamQuestion]:
        """Yield the question on what joints carry, where forces are worked out: on one link at each joint."""
        if not self.solution.bodies:
            return
        first: dict[str, list[ExamAnswer]] = {}
        for result in self.solution.results:
            _, joint, kind, axis = [*result.token.split("."), "", "", ""][:4]
            if (
                kind == "force"
                and result.value.symbol
                and len(first.setdefault(joint, [])) < 1 + (axis == "y")
            ):
                first[joint].append((result.value, result.unit))
        parts = ("Centres of mass", "Springs and dampers", "Forces")
        way = tuple(step for title in parts for step in self._chapter(title).steps)
        lines = [item for step in way for item in step.items if isinstance(item, ValueLine)]
        effort = [one for one in lines if one.value.symbol in _EFFORT]
        answers = (*(one for pair in first.values() for one in pair), *_answers(effort))
        text = said(
            "Draw each link free, with all that acts on it. Find the forces in joints and at the input."
        )
        yield ExamQuestion(text, answers, 2 + len(answers), said(_FREE), way)

    def _made(self) -> Iterator[ExamQuestion]:
        """Yield the question on how the linkage was synthesised, if it was."""
        if made := self.solution.synthesis_chapter:
            lines = [item for item in made.items if isinstance(item, ValueLine)]
            lengths = [one for one in lines if one.value.symbol and one.value.symbol.letter in "re"]
            last = {one.value.symbol: one for one in lengths}
            text = said("Synthesis: show how the lengths of the linkage follow from what it was made for.")
            yield ExamQuestion(text, _answers([*last.values()][:4]), 6, "", made.steps)


_CHAPTERS = {1: "Velocities", 2: "Accelerations"}
_RATES = {1: ("angular velocity", "velocity"), 2: ("angular acceleration", "acceleration")}
_MEASURES = {
    "angle": (to_say("the angle of {things}"), to_say("the angles of {things}")),
    "travel": (to_say("the travel of {things}"), to_say("the travels of {things}")),
    "angular velocity": (
        to_say("the angular velocity of {things}"),
        to_say("the angular velocities of {things}"),
    ),
    "velocity": (to_say("the velocity of {things}"), to_say("the velocities of {things}")),
    "angular acceleration": (
        to_say("the angular acceleration of {things}"),
        to_say("the angular accelerations of {things}"),
    ),
    "acceleration": (to_say("the acceleration of {things}"), to_say("the accelerations of {things}")),
    "derivative of the angle": (
        to_say("the derivative of the angle of {things}"),
        to_say("the derivatives of the angles of {things}"),
    ),
    "derivative of the travel": (
        to_say("the derivative of the travel of {things}"),
        to_say("the derivatives of the travels of {things}"),
    ),
}
"""What is asked for, of one thing and of several."""
_MOVING = {
    1: to_say("Find the velocity of {joint}: its components and its magnitude."),
    2: to_say("Find the acceleration of {joint}: its components and its magnitude."),
}
_EFFORT = (Symbol("M", "in"), Symbol("F", "in,s"))
_FREE = to_say("Begin at the end of the chain: moments on the two links that meet in a joint give its force.")
_ROTATE = to_say("Go along the link by its angle, and at right angles to it.")
_DIFFERENTIATE = (
    to_say("Differentiate the loop with respect to time: two linear equations."),
    to_say("Differentiate the velocity equations once more; the matrix is the same."),
)
_ROTATE_RATE = (
    to_say(
        "The velocity relative to another point of the link is ω times their distance, at right angles to it."
    ),
    to_say("Besides the part with α there is one with ω², towards the other point."),
)


def _answers(lines: Iterable[ValueLine]) -> tuple[ExamAnswer, ...]:
    return tuple((line.value, line.unit) for line in lines)


def _as_places(answers: Sequence[ExamAnswer]) -> list[ExamAnswer]:
    """Return coefficients by the symbols of what they are derivatives of, to be named."""
    letters = {"h": "θ", "f": "s", "g": "t"}
    places: list[ExamAnswer] = []
    for value, unit in answers:
        assert value.symbol is not None
        symbol = Symbol(letters[value.symbol.letter], value.symbol.sub)
        places.append((replace(value, symbol=symbol), unit))
    return places


def _is_place(line: ValueLine, joint: str) -> bool:
    return line.value.symbol in (Symbol("x", joint), Symbol("y", joint))


def _direction(angle: float) -> str:
    """Return a direction in words: upwards, or towards its angle."""
    turned = round(degrees(angle), 6) % 360
    if turned % 90 == 0:
        return said(_DIRECTIONS[int(turned)])
    return said("towards {angle}°", angle=f"{turned:g}")


def _sentence(text: str) -> str:
    return said("{found}.", found=text.rstrip(":.：。")) if text else ""
