"""Text: one bundled font in a few sizes, every glyph rendered once."""

from __future__ import annotations

from typing import Literal

import pygame

from linkanim.picture.raster import Colour

Anchor = Literal["left", "centre", "right"]


class Type:
    """The font's sizes and glyphs that one painter has used; its memory is bounded by its alphabet."""

    def __init__(self) -> None:
        pygame.font.init()
        self._fonts: dict[int, pygame.Font] = {}
        self._glyphs: dict[tuple[str, int, Colour], pygame.Surface] = {}

    def font(self, size: int) -> pygame.Font:
        """Return the font at a height in pixels."""
        if size not in self._fonts:
            self._fonts[size] = pygame.Font(None, round(size * 1.37))
        return self._fonts[size]

    def width(self, text: str, size: int) -> int:
        """Return how wide a text is, glyph by glyph, in pixels."""
        return sum(self.glyph(char, size, (0, 0, 0)).get_width() for char in text)

    def glyph(self, char: str, size: int, colour: Colour) -> pygame.Surface:
        """Return one character, anti-aliased on nothing."""
        key = (char, size, colour)
        if key not in self._glyphs:
            self._glyphs[key] = self.font(size).render(char, True, colour)
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

        Whole pixels only: text that glides reads worse than text that steps.
        """
        glyphs = [self.glyph(char, size, colour) for char in text]
        width = sum(glyph.get_width() for glyph in glyphs)
        x, y = round(at[0]) - {"left": 0, "centre": width // 2, "right": width}[anchor], round(at[1])
        for glyph in glyphs:
            surface.blit(glyph, (x, y))
            x += glyph.get_width()
        return width

    def wrapped(self, text: str, size: int, width: float) -> list[str]:
        """Return the text in lines no wider than `width` where its words allow."""
        lines: list[str] = []
        for word in text.split():
            longer = f"{lines[-1]} {word}" if lines else word
            if lines and self.width(longer, size) <= width:
                lines[-1] = longer
            else:
                lines.append(word)
        return lines
