"""What a game shows in the room of a list: its heading, a question, answers, bars, the verdict."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import floor
from typing import Literal, NamedTuple

import numpy as np
import pygame

from linkanim.frozen import frozen
from linkanim.picture.board import Board
from linkanim.picture.items import DrawnSheet, Target
from linkanim.picture.raster import Colour, Layer, paint
from linkanim.picture.shapes import box, stroke
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect

_LEAST = 9
"""The smallest text that can be read, in pixels."""
_LEFT = 1.0
"""From the sheet's edge to its words, in heights of the text, as all sizes below."""
_STEP = 1.3
_GAP = 0.65
"""The gap between one part and the next."""
_LARGE = 2.3
"""The size of a title's heading."""
_INSET = 0.45
"""The margin above and below an answer's words in its frame."""
_CURVE = 2.6
"""The height of a curve."""
_BAR = 0.5
"""The height of a bar."""


Mood = Literal["", "right", "wrong", "faint"]
"""How an answer is shown: plain, as right, as wrong, or as one that no longer counts."""


class Choice(NamedTuple):
    """An answer, or an entry of a menu: its key, its words, the small words below them, and its mood.

    A `curve` of values from −1 to 1 is drawn instead of words.
    """

    key: str
    text: str
    mood: Mood = ""
    below: str = ""
    curve: tuple[float, ...] = ()


class ScoreBar(NamedTuple):
    """A score as a bar: its words, how full it is (0 to 1), and where its thresholds stand."""

    label: str
    words: str
    full: float
    marks: tuple[float, ...] = ()


@frozen
class GamePanel:
    """What a game shows in the room of a list, from its heading down to the keys to press.

    The title's heading is `large`; the words `aside` below the lines are dim. `chosen` is the answer that
    Enter takes; `verdict` says whether an answer was right, `lines_after` why. A
    `subject` stands above all of these.
    """

    heading: str
    scores: tuple[str, ...] = ()
    lines: tuple[str, ...] = ()
    aside: str = ""
    choices: tuple[Choice, ...] = ()
    bars: tuple[ScoreBar, ...] = ()
    verdict: str = ""
    well: bool = True
    subject: str = ""
    lines_after: tuple[str, ...] = ()
    hint: str = ""
    large: bool = False
    chosen: int | None = None

    def drawn(self, board: Board, pointed: int | None = None) -> DrawnSheet:
        """Return the panel, its text as large as its room allows, and the places of its answers.

        The mouse is over the answer `pointed`.
        """
        size, parts = _fitting(board, self, pointed)
        sheet, answers = board.sheet(board.layout.lists.width, _height(parts, size)), list[Target]()
        top = 0.8 * size
        for part in parts:
            part.draw(sheet, top)
            if part.is_answer:
                place = Rect(0, top, sheet.get_width(), part.high)
                answers.append(Target("row", place, len(answers)))
            top += part.high + _GAP * size
        return DrawnSheet(sheet, tuple(answers))


class _PanelPart(NamedTuple):
    """A part: its height, the function that draws it with its top at a height, whether it is an answer."""

    high: float
    draw: Callable[[pygame.Surface, float], None]
    is_answer: bool = False


def mood_colour(theme: Theme, mood: Mood) -> Colour:
    """Return the colour in which an answer stands."""
    return {"right": theme.traces[1], "wrong": theme.warning, "faint": theme.dim, "": theme.ink}[mood]


def _fitting(board: Board, panel: GamePanel, pointed: int | None) -> tuple[int, list[_PanelPart]]:
    """Return the largest text at which all parts fit; at the smallest, answers and as much else as fits."""
    least, less = min(_LEAST, board.layout.text_size), replace(panel, hint="", aside="")
    ways = [(size, panel) for size in range(board.layout.text_size, least - 1, -1)]
    ways += [(least, less), (least, replace(less, scores=(), lines_after=()))]
    for size, shown in ways:
        parts = [*_parts(board, shown, pointed, size)]
        if _height(parts, size) <= board.layout.lists.height:
            break
    return size, parts


def _height(parts: list[_PanelPart], size: int) -> float:
    return sum(part.high + _GAP * size for part in parts) + 0.9 * size


def _parts(board: Board, panel: GamePanel, pointed: int | None, size: int) -> Iterator[_PanelPart]:
    ink, dim = board.theme.ink, board.theme.dim
    head = floor(_LARGE * size) if panel.large else size
    yield _words(board, panel.heading, head, ink, strong=True)
    if panel.scores:
        yield _scores(board, panel.scores, size)
    for line in panel.lines:
        yield _words(board, line, size, ink)
    if panel.aside:
        yield _words(board, panel.aside, max(round(0.85 * size), _LEAST), dim, left=size)
    for n, choice in enumerate(panel.choices):
        yield _answer(board, (panel.chosen, pointed), n, choice, size)
    for bar in panel.bars:
        yield _bar(board, bar, size)
    if panel.verdict:
        mood: Mood = "right" if panel.well else "wrong"
        yield _words(board, panel.verdict, size, mood_colour(board.theme, mood), strong=True)
    if panel.subject:
        yield _words(board, panel.subject, size, ink, strong=True)
    for line in panel.lines_after:
        yield _words(board, line, size, ink)
    if panel.hint:
        yield _words(board, panel.hint, max(round(0.85 * size), _LEAST), dim, left=size, gap="   ")


def _words(
    board: Board,
    text: str,
    size: int,
    colour: Colour,
    *,
    left: float | None = None,
    strong: bool = False,
    gap: str = " ",
) -> _PanelPart:
    """Return words in lines, as wide as the panel; `left` is their left edge, without it the usual one."""
    left = _LEFT * (min(size, board.layout.text_size) if left is None else left)
    room = board.layout.lists.width - 2 * left
    lines = board.type.wrapped(text, size, 0.97 * room, gap=gap)

    def draw(sheet: pygame.Surface, top: float) -> None:
        for n, line in enumerate(lines):
            at = (left, top + _STEP * n * size)
            board.write(sheet, line, at, size=size, colour=colour, strong=strong)

    return _PanelPart((_STEP * len(lines) - _STEP + 1.05) * size, draw)


def _scores(board: Board, scores: tuple[str, ...], size: int) -> _PanelPart:
    """Return scores side by side over the panel's width."""
    left, small = _LEFT * size, max(round(0.9 * size), _LEAST)
    room = board.layout.lists.width - 2 * left

    def draw(sheet: pygame.Surface, top: float) -> None:
        for n, text in enumerate(scores):
            share = n / max(len(scores) - 1, 1)
            anchor = "left" if share == 0 else "right" if share == 1 else "centre"
            at = (left + share * room, top)
            board.write(sheet, text, at, size=small, colour=board.theme.dim, anchor=anchor)  # type: ignore[arg-type]

    return _PanelPart(1.05 * small, draw)


def _answer(
    board: Board, lit: tuple[int | None, int | None], n: int, choice: Choice, size: int
) -> _PanelPart:
    """Return an answer in its frame: the key that takes it, then its words or its curve."""
    theme, small = board.theme, max(round(0.82 * size), _LEAST)
    wide, inset, left = board.layout.lists.width - 1.2 * size, _INSET * size, 2.7 * size
    room = wide - left - 0.2 * size
    lines = [] if choice.curve else board.type.wrapped(choice.text, size, room)
    below = board.type.wrapped(choice.below, small, room) if choice.below else []
    body = _CURVE * size if choice.curve else (_STEP * len(lines) - 0.25) * size
    high = body + (_STEP * len(below)) * small + 2 * inset
    colour = mood_colour(theme, choice.mood)

    def draw(sheet: pygame.Surface, top: float) -> None:
        back = board.behind(n, *lit) or theme.panel
        middle = complex(sheet.get_width() / 2, top + high / 2)
        loud = choice.mood in ("right", "wrong")
        line, rim = (2.2 if loud else 1.4) * board.layout.unit, colour if loud else theme.rule
        rim = theme.velocity if n == lit[0] and not loud else rim
        outer, inner = (middle + box(wide - by, high - by, 0.35 * size) for by in (0.0, 2 * max(line, 1.0)))
        paint(sheet, [Layer(rim, [outer]), Layer(back, [inner])])
        at = (1.5 * size, top + inset)
        board.write(sheet, choice.key, at, size=size, colour=theme.dim, anchor="centre", strong=True)
        for k, text in enumerate(lines):
            at = (left, top + inset + _STEP * k * size)
            board.write(sheet, text, at, size=size, colour=colour, strong=loud)
        for k, text in enumerate(below):
            at = (left, top + inset + body + (0.12 + _STEP * k) * small)
            board.write(sheet, text, at, size=small, colour=theme.dim)
        if choice.curve:
            _curve(sheet, board, choice.curve, (left, top + inset, room, body), colour)

    return _PanelPart(high, draw, is_answer=True)


def _curve(
    sheet: pygame.Surface,
    board: Board,
    values: tuple[float, ...],
    room: tuple[float, float, float, float],
    colour: Colour,
) -> None:
    """Draw a curve of values from −1 to 1 over a line for zero."""
    x, y, wide, high = room
    line, middle = max(2.0 * board.layout.unit, 1.2), y + high / 2
    way = x + np.linspace(0.0, wide, len(values)) + 1j * (middle - 0.46 * high * np.array(values))
    zero = np.array([complex(x, middle), complex(x + wide, middle)])
    paint(sheet, [Layer(board.theme.rule, stroke(zero, 0.6 * line)), Layer(colour, stroke(way, line))])


def _bar(board: Board, bar: ScoreBar, size: int) -> _PanelPart:
    """Return a score: its words, and below them how full it is, with its thresholds."""
    small, left = max(round(0.9 * size), _LEAST), _LEFT * size
    wide, high = board.layout.lists.width - 2 * left, _BAR * size

    def draw(sheet: pygame.Surface, top: float) -> None:
        theme, right = board.theme, left + wide
        board.write(sheet, bar.label, (left, top), size=small, colour=theme.dim)
        board.write(sheet, bar.words, (right, top), size=small, anchor="right", strong=True)
        y, full = top + 1.35 * small + high / 2, min(max(bar.full, 0.0), 1.0) * wide
        reached = not bar.marks or bar.full >= bar.marks[-1]
        layers = [Layer(theme.rule, [complex(left + wide / 2, y) + box(wide, high, high / 2)])]
        if full > high:
            ink = theme.traces[1] if reached else theme.velocity
            layers.append(Layer(ink, [complex(left + full / 2, y) + box(full, high, high / 2)]))
        ticks = [complex(left + mark * wide, y) + box(0.16 * size, 1.7 * high) for mark in bar.marks]
        paint(sheet, [*layers, Layer(theme.ink, ticks)] if ticks else layers)

    return _PanelPart(1.35 * small + 1.3 * high, draw)
