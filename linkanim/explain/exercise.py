"""Print an exercise: the figure with what is given, questions with room to work, and the key with the way."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import accumulate
from typing import Literal

from linkanim.explain.documents import DocumentForm, short
from linkanim.explain.formula import Formula, typeset
from linkanim.explain.questions import ExamQuestion, given, questions
from linkanim.explain.solution import RESULT_DIGITS, Solution
from linkanim.explain.steps import Equation, Given, marked
from linkanim.words import said, sentences, to_say

Level = Literal["drawing", "hints", "formulas"]
"""The help that an exercise gives: nothing but the drawing, a hint to each question, or its formulas."""
LEVELS: tuple[Level, ...] = ("drawing", "hints", "formulas")

_FIRST_PAGE = 0.34
"""The share of the marks on the first of two pages, which has the figure as well."""
_ONE_PAGE = 8
"""The most marks of an exercise on one page."""
_DIGITS = {4: to_say("four"), 5: to_say("five")}


def exercise(versions: Sequence[Solution], form: DocumentForm, level: Level = "drawing") -> str:
    """Return sheets with their numbers left open, each on pages of its own, and then the key of each.

    Where there are several versions, each has a letter, A first.
    """
    titles = [f"{one.title}, {chr(65 + n)}" for n, one in enumerate(versions)]
    titles = titles if len(versions) > 1 else [versions[0].title]
    asked = [questions(version) for version in versions]
    parts: list[str] = []
    for title, version, some in zip(titles, versions, asked, strict=True):
        parts += [form.new_page] if parts else []
        parts.append(form.sheet([*_pages(title, version, some, form, level)]))
    for title, version, some in zip(titles, versions, asked, strict=True):
        parts += [
            form.new_page,
            form.heading(1, said("Key: {title}", title=title)),
            form.where(version),
            *_key(version, some, form),
        ]
    return form.page(titles[0], "\n\n".join(part for part in parts if part))


def _pages(
    title: str, solution: Solution, asked: Sequence[ExamQuestion], form: DocumentForm, level: Level
) -> Iterator[str]:
    """Yield the pages of a sheet: one, or two that share the questions by their marks."""
    marks = [one.marks for one in asked]
    shares = [total / sum(marks) for total in accumulate(marks)]
    first = sum(share <= _FIRST_PAGE for share in shares) or 1
    first = len(marks) if sum(marks) <= _ONE_PAGE else first
    written = [_question(n, one, form, level) for n, one in enumerate(asked, 1)]
    head = [form.heading(1, title), form.named(sum(marks)), _where(solution, form)]
    task = form.beside(form.figure(solution), "\n\n".join(_given(solution, asked, form)))
    pages = ([*head, task, *written[:first]], written[first:])
    yield from ("\n\n".join(part for part in page if part) for page in pages if page)


def _where(solution: Solution, form: DocumentForm) -> str:
    """Return where the linkage is, and the rules for all numbers of the sheet."""
    pins = [joint.name for joint in solution.request.scene.linkage.joints if solution.places[joint.name] == 0]
    steady = not (solution.request.acceleration or solution.request.swings)
    return form.paragraph(
        form.text(
            sentences(
                said("x points to the right and y upwards from {pin}.", pin=marked(pins[0]))
                if pins
                else said("x points to the right and y upwards."),
                said(
                    "Angles are counted counterclockwise from the x axis, and so are angular velocities. "
                    "The numbers given are exact; give results in {digits} significant digits.",
                    digits=said(_DIGITS[RESULT_DIGITS]),
                ),
                said("The velocity of the input is constant.") if steady else "",
            )
        )
    )


def _given(solution: Solution, asked: Sequence[ExamQuestion], form: DocumentForm) -> Iterator[str]:
    """Yield what is given besides the figure."""
    items = given(solution, asked)
    stated = {item.value.symbol: item for item in items if isinstance(item, Given)}
    yield from form.set_items([*stated.values()])
    if related := [item for item in items if isinstance(item, Equation)]:
        yield from (form.paragraph(_equation(one, form)) for one in related)


def _equation(one: Equation, form: DocumentForm) -> str:
    sides = (typeset(side, form.how) for side in (one.left, one.right))
    return form.inline(form.how.infix("=", *sides))


def _question(number: int, one: ExamQuestion, form: DocumentForm, level: Level) -> str:
    formulas = ""
    if level == "formulas":
        formulas = form.steps(one.way, blank=True)
    hint = form.text(said("Hint: {hint}", hint=one.hint)) if level == "hints" and one.hint else ""
    # where the formulas stand they end in the answers
    blanks = [] if formulas else [_open(*answer, form) for answer in one.answers]
    answers = form.answers(blanks) if blanks else ""
    return form.question(number, form.text(one.text), one.marks, hint, answers, formulas)


def _open(value: Formula, unit: str, form: DocumentForm) -> str:
    """Return an answer with its number left open."""
    blank = form.how.blank + form.how.unit(unit)
    return form.inline(form.how.infix("=", typeset(value, form.how), blank))


def _key(solution: Solution, asked: Sequence[ExamQuestion], form: DocumentForm) -> Iterator[str]:
    """Yield each question's answers, and below them the way that leads there."""
    solved = solution.solved
    for n, one in enumerate(asked, 1):
        yield form.heading(2, f"{n} {one.text}")
        if one.answers:
            yield form.listed([form.entry(short(value, solved), unit) for value, unit in one.answers])
        if solution.made and one.way == getattr(solution.synthesis_chapter, "steps", None):
            yield form.construction(solution)
        if one.way:
            yield form.steps(one.way)
