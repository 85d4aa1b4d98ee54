"""Text: one font in a few sizes, every glyph rendered once."""

from __future__ import annotations

from typing import Literal
from unicodedata import normalize

import pygame

from linkanim.picture.fonts import Fonts
from linkanim.picture.raster import Colour, Layer, paint
from linkanim.picture.shapes import arrows

Anchor = Literal["left", "centre", "right"]

_ANY: Colour = (0, 0, 0)
_POINTS = 1.37
"""From a line's height in pixels to the size the font goes by."""
_MISSHAPEN = (15, 18)
"""At these sizes the font's hinting cuts the dot of the i or the bar of the t."""
_ARROWS = {"→": 1, "↓": 1j, "←": -1, "↑": -1j}
"""Signs the font lacks, and the way they point in the window."""


class Type:
    """The font's sizes and the glyphs that one painter has used; bounded by the font's alphabet."""

    def __init__(self) -> None:
        self._fonts = Fonts()
        self._glyphs: dict[tuple[str, int, Colour], pygame.Surface] = {}

    def width(self, text: str, size: int) -> int:
        """Return how wide a line is in pixels."""
        return sum(self.glyph(char, size, _ANY).get_width() for char in normalize("NFC", text))

    def glyph(self, char: str, size: int, colour: Colour) -> pygame.Surface:
        """Return one character, anti-aliased on nothing."""
        key = (char, size, colour)
        if key not in self._glyphs:
            turn = _ARROWS.get(char)
            points = round(size * _POINTS)
            drawn = self._fonts.render("0" if turn else char, points + (points in _MISSHAPEN), colour)
            self._glyphs[key] = _arrow(drawn, turn, colour) if turn else drawn
        return self._glyphs[key]

    def draw(
        self,
        surface: pygame.Surface,
        text: str,
        at: tuple[float, float],
        *,
        size: int,
        colour: Colour,
        anchor: Anchor = "left",
    ) -> int:
        """Draw one line whose top is at `at`, and return its width in pixels.

        Glyph by glyph, which spaces small text more evenly than the font does, and at whole pixels:
        text that glides reads worse than text that steps.
        """
        glyphs = [self.glyph(char, size, colour) for char in normalize("NFC", text)]
        width = sum(glyph.get_width() for glyph in glyphs)
        x, y = _left(at[0], width, anchor), round(at[1])
        for glyph in glyphs:
            surface.blit(glyph, (x, y))
            x += glyph.get_width()
        return width

    def wrapped(self, text: str, size: int, width: float, *, gap: str = " ") -> list[str]:
        """Return the text in lines no wider than `width`, broken between its words, parted by `gap`.

        A word that is wider is broken inside, as are scripts without spaces.
        """
        lines: list[str] = []
        for word in filter(str.strip, text.split(gap)):
            longer = f"{lines[-1]}{gap}{word}" if lines else word
            if lines and self.width(longer, size) <= width:
                lines[-1] = longer
            else:
                lines += self._broken(word, size, width)
        return lines

    def _broken(self, word: str, size: int, width: float) -> list[str]:
        """Return a word in pieces no wider than `width`, but of at least one character each."""
        pieces = [""]
        for char in word:
            if pieces[-1] and self.width(pieces[-1] + char, size) > width:
                pieces.append("")
            pieces[-1] += char
        return pieces


def _arrow(like: pygame.Surface, turn: complex, colour: Colour) -> pygame.Surface:
    """Return an arrow as high as a digit, on nothing."""
    high = like.get_height()
    sign = pygame.Surface((round(0.95 * high), high), pygame.SRCALPHA, 32)
    middle, reach = complex(0.48 * high, 0.42 * high), 0.72 * high * turn
    paint(sign, [Layer(colour, arrows([middle - reach / 2], [reach], 0.13 * high))])
    return sign


def _left(x: float, width: int, anchor: Anchor) -> int:
    return round(x) - {"left": 0, "centre": width // 2, "right": width}[anchor]
