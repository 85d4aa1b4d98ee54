"""Text: one face in two weights and a few sizes, every glyph rendered once, subscripts set as such.

A subscript is written with Unicode's own signs (`O₂`, `ω₃`, `aₓ`) or, where there are none for it, in
braces (`I_{13}`, `v_{BA}`); either is typeset smaller and lower. `subscripted` writes a joint's name so.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterable, Iterator
from itertools import pairwise
from math import prod
from typing import Literal, NamedTuple
from unicodedata import normalize

import pygame

from linkanim.picture.raster.raster import Colour
from linkanim.picture.text.fonts import REGULAR, SEMIBOLD, Fonts

Anchor = Literal["left", "centre", "right"]

_FINE = 4
"""Glyphs are drawn so many times larger and averaged, and placed to such a part of a pixel."""
_X_HEIGHT = 0.486
"""Of the face, in ems."""
_REACH = 0.51
"""The height of an x in heights of a line."""
_BASE = 0.78
"""Where the baseline lies, in heights of a line below its top."""
_SUB, _LOWER, _LEAST = 0.72, 0.2, 8
"""A subscript's size and how far it is lowered, in sizes of its text; its least size in pixels."""
_LOOSE = 7
"""Where an x is no higher than this, in pixels, neighbours stand a part of a pixel further apart."""
_SUBSCRIPT = re.compile(r"_\{([^{}]*)\}|([\u2080-\u209c\u1d62-\u1d6a\u2c7c]+)")
_HYPHENED = re.compile(r"[^-]*-|[^-]+")
_LOWERED = {ord("0") + n: 0x2080 + n for n in range(10)}
_INDEX = re.compile(r"(?<=[^\W\d_])_?(\d+)$")


_KEPT = 2048
"""How many lines are remembered, set: as many as a turn of a scene with a dozen values has."""
_INKED_BYTES = 1_000_000
"""How much memory new lines as they are drawn may take until those that were not drawn meanwhile go."""


class Run(NamedTuple):
    """Part of a line that is set in one way."""

    text: str
    lowered: bool


def runs(text: str) -> tuple[Run, ...]:
    """Return a line in its runs: what stands on the line, and its subscripts in plain letters."""
    return tuple(run for run in _runs(normalize("NFC", text)) if run.text)


class Typesetting(NamedTuple):
    """How a line of a height is set elsewhere: the face's size and a subscript's in pixels, and shifts."""

    em: float
    small: float
    baseline: float
    """How far below the line's top."""
    lower: float
    """How far a subscript stands below the baseline."""


def typesetting(size: int) -> Typesetting:
    """Return how lines of a height are set, for what draws with fonts of its own."""
    small = max(round(_SUB * size), min(size, _LEAST))
    return Typesetting(_em(size) / _FINE, _em(small) / _FINE, round(_BASE * size), round(_LOWER * size))


def subscripted(name: str) -> str:
    """Return a name with the number it ends in as a subscript: O2 as O₂; another name as it is."""
    return _INDEX.sub(lambda found: found[1].translate(_LOWERED), name)


_Place = tuple[str, int, int, int]
"""A glyph of a line: which, at what size, how far right (in parts of a pixel) and how far down."""


class Inked(NamedTuple):
    """Letters on nothing, cut to their ink, so many pixels right and down of where they are set."""

    sprite: pygame.Surface
    right: int
    down: int


class Type:
    """The face's sizes and the glyphs that one painter has used; bounded by the face's alphabet."""

    def __init__(self) -> None:
        self._fonts = Fonts()
        self._glyphs: dict[tuple[str, int, Colour, str, int], Inked] = {}
        self._steps: dict[tuple[str, str, int, str], int] = {}
        self._lines: dict[tuple[str, int, str], tuple[_Place, ...]] = {}
        self._inked: dict[tuple[str, int, str, Colour], tuple[int, list[Inked]]] = {}
        self._inked_bytes = 0
        self._drawn: set[Hashable] = set()
        self._once: set[Hashable] = set()

    def width(self, text: str, size: int, *, strong: bool = False) -> int:
        """Return how wide a line is in pixels; `strong` is the semibold weight."""
        _, _, end, _ = self._set(text, size, _face(strong))[-1]
        return -(-end // _FINE)

    def draw(
        self,
        surface: pygame.Surface,
        text: str,
        at: tuple[float, float],
        *,
        size: int,
        colour: Colour,
        anchor: Anchor = "left",
        strong: bool = False,
    ) -> int:
        """Draw one line whose top is at `at`, and return its width in pixels.

        `text` may hold subscripts, as the module says; `strong` is the semibold weight. A line begins
        at a whole pixel, for text that glides reads worse than text that steps; its glyphs stand
        to a quarter of one, which spaces small text evenly.
        """
        width, inked = self._inked_of(text, size, colour, _face(strong))
        x, y = _left(at[0], width, anchor), round(at[1]) + round(_BASE * size)
        surface.blits([(sprite, (x + right, y + down)) for sprite, right, down in inked], doreturn=False)
        return width

    def _inked_of(self, text: str, size: int, colour: Colour, face: str) -> tuple[int, list[Inked]]:
        """Return a line's width and its letters: of one that comes again on as few surfaces as can be.

        So it blits fast; values that change with every frame are not worth that.
        """
        key = (text, size, face, colour)
        if key not in self._inked:
            *places, (_, _, end, _) = self._set(text, size, face)
            inks = (
                (self._glyph(char, small, colour, face, x % _FINE), x // _FINE, y)
                for char, small, x, y in places
            )
            inked = [Inked(ink, x + right, y + down) for (ink, right, down), x, y in inks if ink.get_width()]
            width = -(-end // _FINE)
            if key not in self._once:
                if len(self._once) >= _KEPT:
                    self._once.clear()
                self._once.add(key)
                return width, inked
            inked = [_joined(run) for run in _apart(inked)]
            self._make_room(sum(4 * prod(letters.sprite.get_size()) for letters in inked))
            self._inked[key] = width, inked
        self._drawn.add(key)
        return self._inked[key]

    def _make_room(self, further: int) -> None:
        """Forget the lines not drawn since this was last done where so many bytes more are too many."""
        self._inked_bytes += further
        if self._inked_bytes > _INKED_BYTES or len(self._inked) >= _KEPT:
            self._inked = {key: line for key, line in self._inked.items() if key in self._drawn}
            self._drawn.clear()
            self._inked_bytes = further

    def _glyph(self, char: str, size: int, colour: Colour, face: str, part: int) -> Inked:
        """Return one character, anti-aliased, `part` quarters of a pixel further right of its own corner."""
        key = (char, size, colour, face, part)
        if key not in self._glyphs:
            drawn = self._fonts.render(char, _em(size), colour, face=face)
            glyph = _averaged(drawn, part, self._fonts.ascent(_em(size)), colour)
            ink = glyph.get_bounding_rect()
            self._glyphs[key] = Inked(glyph.subsurface(ink), ink.x, ink.y)
        return self._glyphs[key]

    def _set(self, text: str, size: int, face: str) -> tuple[_Place, ...]:
        """Return where the glyphs of a line stand and its end; the last lines are kept, being drawn again."""
        key = (text, size, face)
        if key not in self._lines:
            if len(self._lines) >= _KEPT:
                self._lines.clear()
            self._lines[key] = tuple(self._setting(text, size, face))
        return self._lines[key]

    def _setting(self, text: str, size: int, face: str) -> Iterator[_Place]:
        """Yield where the glyphs of a line stand from the left of its baseline, then its end."""
        x = 0
        for run in runs(text):
            small = max(round(_SUB * size), min(size, _LEAST)) if run.lowered else size
            top = (round(_LOWER * size) if run.lowered else 0) - self._ascent(small)
            for char, after in pairwise((*run.text, "")):
                yield char, small, x, top
                key = char, after, small, face
                if key not in self._steps:
                    self._steps[key] = self._step(*key)
                x += self._steps[key]
        yield "", size, x, 0

    def _ascent(self, size: int) -> int:
        """Return how high glyphs reach above the baseline, in pixels."""
        return -(-self._fonts.ascent(_em(size)) // _FINE)

    def _step(self, char: str, after: str, size: int, face: str) -> int:
        """Return how far the pen moves from a character to the next of its run, in parts of a pixel."""
        if _x_height(size) <= _LOOSE:
            return self._fonts.advance(char, _em(size), face=face) + 1
        return self._fonts.advance(char, _em(size), face=face, after=after)

    def wrapped(
        self, text: str, size: int, width: float, *, gap: str = " ", strong: bool = False
    ) -> list[str]:
        """Return the text in lines no wider than `width`, broken between its words, parted by `gap`.

        A word that is wider is broken after a hyphen, else anywhere inside, as are scripts without spaces.
        """
        lines: list[str] = []
        for word in filter(str.strip, text.split(gap)):
            longer = f"{lines[-1]}{gap}{word}" if lines else word
            if lines and self.width(longer, size, strong=strong) <= width:
                lines[-1] = longer
            else:
                lines += self._broken(word, size, width, strong=strong)
        return lines

    def _broken(self, word: str, size: int, width: float, *, strong: bool) -> list[str]:
        """Return a word in pieces no wider than `width`, but of at least one character each."""
        pieces = [""]
        for part in hyphened(word):
            wide = self.width(part, size, strong=strong) > width
            for more in part if wide else (part,):
                if pieces[-1] and self.width(pieces[-1] + more, size, strong=strong) > width:
                    pieces.append("")
                pieces[-1] += more
        return pieces


def hyphened(word: str) -> list[str]:
    """Return the parts of a word between which a line may end, each with the hyphen at its end."""
    return _HYPHENED.findall(word)


def _runs(text: str) -> Iterator[Run]:
    end = 0
    for found in _SUBSCRIPT.finditer(text):
        yield Run(text[end : found.start()], lowered=False)
        yield Run(found[1] or normalize("NFKC", found[2] or ""), lowered=True)
        end = found.end()
    yield Run(text[end:], lowered=False)


def _face(strong: bool) -> str:
    return SEMIBOLD if strong else REGULAR


def _x_height(size: int) -> int:
    """Return how high an x is for a line's height, in whole pixels: its edges lie between pixels."""
    return max(round(_REACH * size), 1)


def _em(size: int) -> int:
    """Return the face's size in parts of a pixel for a line's height in pixels."""
    return round(_FINE * _x_height(size) / _X_HEIGHT)


def _averaged(drawn: pygame.Surface, part: int, ascent: int, colour: Colour) -> pygame.Surface:
    """Return a large glyph at its size, its baseline between two pixels, so many parts further right."""
    width, height = drawn.get_size()
    down = -ascent % _FINE
    room = (-(-(part + width) // _FINE) * _FINE, -(-(down + height) // _FINE) * _FINE)
    large = pygame.Surface(room, pygame.SRCALPHA, 32)
    large.fill((*colour, 0))
    drawn.set_alpha(None)  # it is copied, not blended
    large.blit(drawn, (part, down))
    return pygame.transform.smoothscale(large, (room[0] // _FINE, room[1] // _FINE))


def _apart(glyphs: Iterable[Inked]) -> Iterator[list[Inked]]:
    """Yield a line's glyphs in runs within which each begins right of the last; where two touch is a break.

    What lies over one another is blended with what is below it one by one, as rounding asks.
    """
    run: list[Inked] = []
    end = 0
    for glyph in glyphs:
        if run and glyph.right < end:
            yield run
            run = []
        run.append(glyph)
        end = glyph.right + glyph.sprite.get_width()
    if run:
        yield run


def _joined(run: list[Inked]) -> Inked:
    """Return glyphs that do not touch on one surface."""
    if len(run) == 1:
        return run[0]
    left, top = run[0].right, min(glyph.down for glyph in run)
    right, low = run[-1].right + run[-1].sprite.get_width(), max(g.down + g.sprite.get_height() for g in run)
    sheet = pygame.Surface((right - left, low - top), pygame.SRCALPHA, 32)
    sheet.blits([(glyph.sprite, (glyph.right - left, glyph.down - top)) for glyph in run], doreturn=False)
    return Inked(sheet, left, top)


def _left(x: float, width: int, anchor: Anchor) -> int:
    return round(x) - {"left": 0, "centre": width // 2, "right": width}[anchor]
