"""Sizes of figures and charts for where they are printed or shown: a book's column, a page, a slide.

Each is so wide on paper, has letters of so many points there, and a ground or none.
"""

from __future__ import annotations

from linkanim.frozen import NamedTuple

USUAL_SIZE = (1280, 720)
"""The size in pixels of what is for no purpose of these."""
_INCH, _POINTS = 25.4, 72.0
_EM = 1.08
"""The face's size in heights of a line of its text, about."""


class Purpose(NamedTuple):
    """How wide in mm a figure is, the size of its small letters in points there, and how it is drawn for it.

    `shape` is its width over its height, `pixels` its width as a PNG and the unit in which it is drawn.
    """

    wide: float
    points: float
    shape: float
    pixels: int
    ground: bool
    words: str

    def size(self, asked: tuple[int, int] | None) -> tuple[int, int]:
        """Return the size in pixels, in the shape of one that was asked for."""
        shape = asked[0] / asked[1] if asked else self.shape
        return self.pixels, max(round(self.pixels / shape), 1)

    def type_scale(self, usual: float) -> float:
        """Return how many times larger its words are than small words of a `usual` height in its pixels."""
        em = self.points / _POINTS * _INCH / self.wide * self.pixels
        return em / (_EM * usual)


PURPOSES = {
    "book": Purpose(84.0, 8.0, 4 / 3, 992, ground=False, words="84 mm wide, letters of 8 pt"),
    "page": Purpose(160.0, 10.0, 16 / 9, 1890, ground=False, words="160 mm wide, letters of 10 pt"),
    "slide": Purpose(338.67, 20.0, 16 / 9, 1920, ground=True, words="16:9, letters for the last row"),
}
"""What `--for` takes."""
