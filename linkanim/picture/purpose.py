"""Sizes of figures and charts for where they are printed or shown: a book's column, a page, a slide.

Each states how wide a figure is there, how large its letters are, and whether its ground is painted.
"""

from __future__ import annotations

from typing import NamedTuple

USUAL_SIZE = (1280, 720)
"""The size in pixels of a figure for no stated purpose."""
_INCH, _POINTS = 25.4, 72.0
_EM = 1.08
"""The face's size in heights of a line of its text, about."""


class Purpose(NamedTuple):
    """A figure's width in mm where it is shown, its small letters in points, and how it is drawn for that.

    `shape` is its width over its height, `pixels` its width as a PNG and the unit in which it is drawn.
    """

    wide: float
    points: float
    shape: float
    pixels: int
    ground: bool
    words: str

    def size(self, asked: tuple[int, int] | None) -> tuple[int, int]:
        """Return the size in pixels; where one was `asked` for, its shape is kept."""
        shape = asked[0] / asked[1] if asked else self.shape
        return self.pixels, max(round(self.pixels / shape), 1)

    def type_scale(self, usual: float) -> float:
        """Return how many times larger small words of a `usual` height in pixels have to be drawn for it."""
        em = self.points / _POINTS * _INCH / self.wide * self.pixels
        return em / (_EM * usual)


PURPOSES = {
    "book": Purpose(84.0, 8.0, 4 / 3, 992, ground=False, words="84 mm wide, letters of 8 pt"),
    "page": Purpose(160.0, 10.0, 16 / 9, 1890, ground=False, words="160 mm wide, letters of 10 pt"),
    "slide": Purpose(338.67, 20.0, 16 / 9, 1920, ground=True, words="16:9, letters for the last row"),
}
"""The values of `--for`."""
