"""Ask what an exam asks about a linkage: questions in the order of the solution, each with its way and marks.

A linkage of many dyads is asked about as far as the second of them: no exam goes further.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from math import degrees

from linkanim.explain.formula import Formula, Symbol
from linkanim.explain.solution import INPUT_TITLE, Solution
from linkanim.explain.steps import (
    MARKED,
    Chapter,
    Equation,
    Given,
    Item,
    Step,
    System,
    Unknown,
    ValueLine,
    Words,
    marked,
    names_of,
)
from linkanim.frozen import NamedTuple, frozen
from linkanim.mechanics.linkage import RPP, RPR, Crank, Joint
from linkanim.mechanics.quantities import link_labels, phrase
from linkanim.picture.figure import figure

_FEWEST, _MOST_DYADS = 5, 2
_DIRECTIONS = {0: "to the right", 90: "upwards", 180: "to the left", 270: "downwards"}


class ExamAnswer(NamedTuple):
    """A number that is asked for: a leaf with its symbol, and its unit."""

    value: Formula
    unit: str


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


def questions(found: Solution) -> tuple[ExamQuestion, ...]:
    """Return five to eight questions on a pose; fewer where it has no rates or a loop has nothing more."""
    return tuple(_Exam(found).questions())


def given(found: Solution, asked: Sequence[ExamQuestion]) -> tuple[Item, ...]:
    """Return what a solver of the questions needs besides the figure: numbers, gears, where travels begin."""
    ways = [item for one in asked for step in one.way for item in step.items]
    used = {leaf.symbol for item in ways for leaf in _leaves(item)}
    # what the input does is given, and not how the program lets it swing
    driven = [item for step in found.positions.steps if step.title == INPUT_TITLE for item in step.items]
    input_ = [
        Given(replace(one.value, shown=f"{one.value.value:g}"), one.unit, "")
        for one in driven
        if isinstance(one, ValueLine)
    ]
    hidden = {leaf.symbol for one in driven for leaf in _leaves(one)} if input_ else set()
    stated = [
        item
        for item in found.chapters[0].items
        if isinstance(item, Given) and item.value.symbol in used - hidden
    ]
    inside = [item for item in ways if isinstance(item, Given)]
    return (*input_, *stated, *inside, *_gears(found, ways))


def _leaves(item: Item) -> Iterator[Formula]:
    match item:
        case ValueLine(formula):
            yield from formula.leaves
        case Equation(left, right):
            yield from (*left.leaves, *right.leaves)
        case System(formulas=rows):
            yield from (leaf for row in rows for entry in row for leaf in entry.leaves)


def _gears(found: Solution, ways: Iterable[Item]) -> Iterator[Item]:
    """Yield the equations of the geared cranks whose angles are worked out."""
    linkage, names = found.request.scene.linkage, names_of(figure(found.request.scene))
    geared = [joint for joint in linkage.joints if isinstance(joint, Crank) and joint.gear is not None]
    angles = {Symbol("θ", names.angle(joint.pivot, joint.name)) for joint in geared}
    for item in ways:
        if isinstance(item, ValueLine) and item.value.symbol in angles:
            yield Equation(item.value, item.formula)


class _Exam:
    """The questions on a pose while they are made."""

    def __init__(self, found: Solution) -> None:
        self.found, self.scene = found, found.request.scene
        self.linkage = self.scene.linkage
        self.names = names_of(figure(self.scene))
        looped = [one for one in found.loop_chapter.steps if MARKED.search(one.title)]
        self.loops = looped[:_MOST_DYADS]
        self.dyads: list[str] = [MARKED.findall(step.title)[0] for step in self.loops]
        self.shown: set[int] = set()
        """The steps, by identity, that the way of an earlier question has."""

    def questions(self) -> Iterator[ExamQuestion]:
        asked = [*self._all()]
        if len(asked) < _FEWEST and (slopes := self._coefficients()):
            before = (n for n, one in enumerate(asked) if "velocit" in one.text)
            asked.insert(next(before, len(asked)), slopes)
        yield from asked

    def _all(self) -> Iterator[ExamQuestion]:
        if self.loops:
            yield self._loop_question()
        for loop, name in zip(self.loops, self.dyads, strict=True):
            yield self._position(loop, name)
        point = self._point
        points = [point] if point else []
        if not self.loops:
            geared = [*self._cranks()]
            yield from geared
            points = points if geared else list(dict.fromkeys((self.linkage.drive.joint, *points)))
        yield from map(self._place, points)
        if not self.found.singular:
            for order, word in ((1, "velocity"), (2, "acceleration")):
                yield from self._rates(order, word)
                yield from (self._moving(one, order, word) for one in points)
        if len(self.loops) < _MOST_DYADS:
            yield from self._whole()
        yield from self._forces()
        yield from self._made()

    # The parts of the solution that lead to an answer.

    def _chapter(self, title: str) -> Chapter:
        return next((one for one in self.found.chapters if one.title == title), Chapter(title, ()))

    def _index(self, joint: str) -> int:
        return [one.name for one in self.linkage.joints].index(joint)

    def _steps(self, chapter: str, upto: str, ending: str = "") -> tuple[Step, ...]:
        """Return the steps of a chapter that no way has yet, up to a joint, whose titles end so."""
        last, found = self._index(upto), []
        for step in self._chapter(chapter).steps:
            name = MARKED.findall(step.title)
            wanted = self._index(name[0]) <= last if name else step.title == ""
            if name and not step.title.endswith(f"\x03{ending}"):
                wanted = False
            if any("residual" in item.text for item in step.items if isinstance(item, Words)):
                wanted = False
            if wanted and id(step) not in self.shown:
                self.shown.add(id(step))
                found.append(step)
        return tuple(found)

    def _of_joint(self, chapter: str, joint: str) -> list[ValueLine]:
        title = f"Joint {marked(joint)}"
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
                return f"the pin {marked(pin)} in its slot"
            body = next((one for one in self.linkage.bodies if joint and one.slider == joint.name), None)
            return phrase(body, self.scene.info.link_names) if body else "the slider"
        body = bodies.get(labels.get(symbol.sub, ""))
        return phrase(body, self.scene.info.link_names) if body else None

    def _line(self, index: str) -> str:
        """Return in words the line whose angle has an index."""
        bars = ((start, joint.name) for joint in self.linkage.joints for start, _ in joint.bars)
        ends = next((ends for ends in bars if self.names.angle(*ends) == index), None)
        return f"the line {marked(ends[0])}–{marked(ends[1])}" if ends else f"link {index}"

    def _sliding(self, symbol: Symbol) -> Joint | None:
        """Return the joint whose travel has a symbol."""
        joints = (joint for joint in self.linkage.joints if joint.travels or isinstance(joint, RPR))
        return next((joint for joint in joints if self.names.slide(joint.name).sub == symbol.sub), None)

    def _things(self, answers: Sequence[ExamAnswer], turning: str, sliding: str) -> str:
        """Return what is asked for in words: the angle of the rod and the travel of the slider."""
        found: dict[str, list[str]] = {}
        for one in answers:
            symbol = one.value.symbol
            assert symbol is not None
            what = sliding if symbol.letter in "st" else turning
            found.setdefault(what, []).append(self._thing(symbol) or self._line(symbol.sub))
        parts = []
        for what, things in found.items():
            several = " of ".join(map(_plural, what.split(" of "))) if len(things) > 1 else what
            parts.append(f"the {several} of {_and(things)}")
        return _and(parts)

    # Questions.

    def _loop_question(self) -> ExamQuestion:
        several = len(self.loops) > 1
        text = "Write down the vector loop of the linkage" if not several else "Write down two vector loops"
        return ExamQuestion(
            f"{text}, resolve {'each' if several else 'it'} into x and y, and name the unknowns.",
            (),
            2 * len(self.loops),
            f"Two routes lead from the ground to {_and([marked(name) for name in self.dyads])}.",
            tuple(self.loops),
        )

    def _unknowns(self, loop: Step) -> tuple[ExamAnswer, ...]:
        symbols = [one for item in loop.items if isinstance(item, Unknown) for one in item.symbols]
        return tuple(ExamAnswer(one, "°" if one.in_degrees else self.scene.length_unit) for one in symbols)

    def _position(self, loop: Step, name: str) -> ExamQuestion:
        answers = self._unknowns(loop)
        way = self._steps("Positions", name)
        hint = next((item.text for item in way[-1].items if isinstance(item, Words)), "") if way else ""
        text = f"Find {self._things(answers, 'angle', 'travel')}.{self._counted(answers)}"
        return ExamQuestion(text, answers, 2 * len(answers), _sentence(hint), way)

    def _counted(self, answers: Sequence[ExamAnswer]) -> str:
        """Return from where the travels among the answers are counted."""
        said = ""
        for one in answers:
            symbol = one.value.symbol
            if symbol is None or symbol.letter not in "st":
                continue
            joint = self._sliding(symbol)
            if isinstance(joint, RPR):
                said += f" The travel in the slot is counted from {marked(joint.pivot)}."
            line = getattr(joint, "line", None)
            if line is None:
                continue
            if isinstance(joint, RPP) and symbol.letter == "t":
                towards = _direction(line.angle + joint.slot)
                said += (
                    f" The travel of the pin is counted along the slot from the guide, positive {towards}."
                )
                continue
            foot = f"the foot of {marked(line.through)} on it" if line.offset else marked(line.through)
            if line.on is not None:
                said += f" The travel is counted along the guide from {foot}."
                continue
            said += f" The travel is counted along the guide from {foot}, positive {_direction(line.angle)}."
        return said

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
            answers = tuple(ExamAnswer(line.value, line.unit) for line in lines[:_MOST_DYADS])
            way = self._steps("Positions", self._last)
            yield ExamQuestion(
                f"Find {self._things(answers, 'angle', 'travel')}.", answers, 2 * len(answers), "", way
            )

    def _place(self, joint: str) -> ExamQuestion:
        lines = [one for one in self._of_joint("Positions", joint) if _is_place(one, joint)]
        way = self._steps("Positions", joint)
        return ExamQuestion(f"Find the coordinates of {marked(joint)}.", _answers(lines), 2, _ROTATE, way)

    def _rates(self, order: int, word: str) -> Iterator[ExamQuestion]:
        chapter = "Velocities" if order == 1 else "Accelerations"
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
        kind = "first" if order == 1 else "second"
        way = (
            *self._steps("Kinematic coefficients", self._last, f", {kind} coefficients"),
            *self._steps(chapter, self._last),
        )
        text = f"Find {self._things(answers, f'angular {word}', word)}."
        marks = (1 + order) * len(answers)
        yield ExamQuestion(text, answers, marks, _DIFFERENTIATE[order - 1] * bool(self.dyads), way)

    def _moving(self, joint: str, order: int, word: str) -> ExamQuestion:
        chapter, letter = ("Velocities", "v") if order == 1 else ("Accelerations", "a")
        lines = self._of_joint(chapter, joint)
        kind = "first" if order == 1 else "second"
        way = (
            *self._steps("Kinematic coefficients", joint, f", {kind} coefficients"),
            *self._steps(chapter, joint),
        )
        sizes = [step for step in self._chapter(chapter).steps if step.title == "Sizes"]
        size = [
            item
            for step in sizes
            for item in step.items
            if isinstance(item, ValueLine) and item.value.symbol == Symbol(letter, joint)
        ]
        if size:
            way = (*way, Step("", tuple(size)))
        places = [one for one in lines if one.value.symbol and one.value.symbol.letter in "xy"]
        text = f"Find the {word} of {marked(joint)}: its components and its magnitude."
        return ExamQuestion(text, _answers([*places, *size]), 1 + order, _ROTATE_RATE[order - 1], way)

    def _coefficients(self) -> ExamQuestion | None:
        """Return the question on kinematic coefficients, for a linkage with little else to ask."""
        lines = [
            item
            for step in self._chapter("Kinematic coefficients").steps
            if step.title.endswith(", first coefficients")
            for item in step.items
            if isinstance(item, ValueLine) and item.value.symbol and item.value.symbol.letter in "hfg"
        ]
        answers = _answers([one for one in lines if one.value.symbol and not one.value.symbol.mark][:2])
        if not answers or self.found.singular:
            return None
        kinds = "derivative of the angle", "derivative of the travel"
        things = self._things(_as_places(answers), *kinds)
        text = f"Find {things} with respect to the input (the first kinematic coefficients h and f)."
        return ExamQuestion(text, answers, 2 * len(answers), _DIFFERENTIATE[0], ())

    def _whole(self) -> Iterator[ExamQuestion]:
        """Yield the question on stroke or swing and time ratio, or on how far the input goes."""
        centres = self._chapter("Dead centres and time ratio")
        words = " ".join(item.text for item in centres.items if isinstance(item, Words))
        lines = [item for item in centres.items if isinstance(item, ValueLine)]
        ends = [
            one for one in lines if one.value.symbol in (Symbol("H"), Symbol("ψ", "swing"), Symbol("T", "R"))
        ]
        if len(ends) > 1 and "numerical search" not in words:
            what = "stroke of the slider" if ends[0].value.symbol == Symbol("H") else "swing of the rocker"
            yield ExamQuestion(
                f"Find the {what} and the time ratio, of the slow stroke to the quick one.",
                _answers(ends),
                4,
                _sentence(re.split(r"(?<=[.:]) ", words)[0]),
                (*self._needed(lines), *centres.steps),
            )
        elif self.scene.info.grashof:
            step = self._chapter("Range of the input").steps[-1]
            yield ExamQuestion(
                "Which class of four-bar is it by Grashof's criterion, and can its input turn fully?",
                (),
                2,
                "Compare the sum of the shortest and the longest link with that of the other two.",
                (step,),
            )

    def _needed(self, lines: Sequence[ValueLine]) -> Iterator[Step]:
        """Yield the lines on the range of the input that lines on the whole motion go on from."""
        used = {leaf.symbol for line in lines for leaf in line.formula.leaves}
        used -= {line.value.symbol for line in lines}
        before = self._chapter("Range of the input").items
        found = [one for one in before if isinstance(one, ValueLine) and one.value.symbol in used]
        if found:
            yield Step("", tuple(found))

    def _forces(self) -> Iterator[ExamQuestion]:
        """Yield the question on what joints carry, where forces are worked out: on one link at each joint."""
        if not self.found.bodies:
            return
        first: dict[str, list[ExamAnswer]] = {}
        for result in self.found.results:
            _, joint, kind, axis = [*result.token.split("."), "", "", ""][:4]
            if (
                kind == "force"
                and result.value.symbol
                and len(first.setdefault(joint, [])) < 1 + (axis == "y")
            ):
                first[joint].append(ExamAnswer(result.value, result.unit))
        parts = ("Centres of mass", "Springs and dampers", "Forces")
        way = tuple(step for title in parts for step in self._chapter(title).steps)
        lines = [item for step in way for item in step.items if isinstance(item, ValueLine)]
        effort = [one for one in lines if one.value.symbol in _EFFORT]
        answers = (*(one for pair in first.values() for one in pair), *_answers(effort))
        text = "Draw each link free, with all that acts on it. Find the forces in joints and at the input."
        yield ExamQuestion(text, answers, 2 + len(answers), _FREE, way)

    def _made(self) -> Iterator[ExamQuestion]:
        """Yield the question on how the linkage was synthesised, if it was."""
        if made := self.found.synthesis_chapter:
            lines = [item for item in made.items if isinstance(item, ValueLine)]
            lengths = [one for one in lines if one.value.symbol and one.value.symbol.letter in "re"]
            last = {one.value.symbol: one for one in lengths}
            text = "Synthesis: show how the lengths of the linkage follow from what it was made for."
            yield ExamQuestion(text, _answers([*last.values()][:4]), 6, "", made.steps)


_EFFORT = (Symbol("M", "in"), Symbol("F", "in,s"))
_FREE = "Begin at the end of the chain: moments on the two links that meet in a joint give its force."
_ROTATE = "Go along the link by its angle, and at right angles to it."
_DIFFERENTIATE = (
    "Differentiate the loop with respect to time: two linear equations.",
    "Differentiate the velocity equations once more; the matrix is the same.",
)
_ROTATE_RATE = (
    "The velocity relative to another point of the link is ω times their distance, at right angles to it.",
    "Besides the part with α there is one with ω², towards the other point.",
)


def _answers(lines: Iterable[ValueLine]) -> tuple[ExamAnswer, ...]:
    return tuple(ExamAnswer(line.value, line.unit) for line in lines)


def _as_places(answers: Sequence[ExamAnswer]) -> list[ExamAnswer]:
    """Return coefficients by the symbols of what they are derivatives of, to be named."""
    letters = {"h": "θ", "f": "s", "g": "t"}
    found = []
    for one in answers:
        assert one.value.symbol is not None
        symbol = Symbol(letters[one.value.symbol.letter], one.value.symbol.sub)
        found.append(ExamAnswer(replace(one.value, symbol=symbol), one.unit))
    return found


def _is_place(line: ValueLine, joint: str) -> bool:
    return line.value.symbol in (Symbol("x", joint), Symbol("y", joint))


def _direction(angle: float) -> str:
    """Return a direction in words: upwards, or towards its angle."""
    turned = round(degrees(angle), 6) % 360
    return _DIRECTIONS[int(turned)] if turned % 90 == 0 else f"towards {turned:g}°"


def _plural(words: str) -> str:
    return f"{words[:-1]}ies" if words.endswith("y") else f"{words}s"


def _and(parts: Sequence[str]) -> str:
    """Return parts in a row, with an "and" before the last."""
    return f"{', '.join(parts[:-1])} and {parts[-1]}" if len(parts) > 1 else parts[0] if parts else ""


def _sentence(text: str) -> str:
    return f"{text.rstrip(':.')}." if text else ""
