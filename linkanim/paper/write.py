"""Write a figure or a chart as a file, in the format that its name's ending states."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from linkanim.manifest import Output
from linkanim.paper.pdf import pdf, require_pdf
from linkanim.paper.svg import svg
from linkanim.picture.items import Group
from linkanim.picture.raster import Colour, png_bytes

if TYPE_CHECKING:
    import pygame

OF_A_FIGURE = (".svg", ".png", ".pdf")
OF_A_CHART = (*OF_A_FIGURE, ".csv")


class Written(Protocol):
    """What can be written: a picture of a size in pixels, and what it shows in words."""

    @property
    def size(self) -> tuple[int, int]:
        """Its width and height in pixels."""

    @property
    def background(self) -> Colour | None:
        """The colour under everything; None where it is clear."""

    @property
    def title(self) -> str:
        """What it shows, in words."""

    @property
    def words(self) -> str:
        """What is seen in it, in a paragraph; empty where that is not told."""

    def groups(self) -> Iterable[Group]:
        """Return everything on it, back to front."""

    def surface(self) -> pygame.Surface:
        """Return the picture drawn."""


@runtime_checkable
class Tabled(Written, Protocol):
    """A chart, whose curves can be written as a table too."""

    def csv(self) -> str:
        """Return the table as CSV."""


def write(shown: Written, target: Output, *, latex: bool = False, wide: float | None = None) -> None:
    """Write a figure or a chart as SVG, PNG or PDF, a chart also as CSV; a file appears whole or not at all.

    It is `wide` mm wide on paper; without that, a pixel is 3/4 pt. With `latex` the words of a PDF are left
    to LaTeX, in a file beside it. `WorkFailed` where disk or folder refuse; `BadInput` for a PDF where fpdf2
    is not installed.
    """
    suffix = target.path.suffix.lower()
    if suffix == ".pdf":
        require_pdf()
    if latex:
        from linkanim.paper.latex import write_for_latex

        write_for_latex(target, shown.size, shown.background, shown.groups(), title=shown.title, wide=wide)
        return
    with target.replacing() as part:
        part.write_bytes(data(shown, suffix, wide))


def data(shown: Written, suffix: str, wide: float | None = None) -> bytes:
    """Return the bytes of a figure or a chart in the format of `suffix`, `wide` mm on paper."""
    picture = shown.size, shown.background, shown.groups()
    match suffix:
        case ".csv" if isinstance(shown, Tabled):
            return shown.csv().encode()
        case ".png":
            drawn = png_bytes(shown.surface())
            return _as_wide(drawn, shown.size[0], wide) if wide else drawn
        case ".pdf":
            return pdf(*picture, title=shown.title, words=shown.words, wide=wide)
    return svg(*picture, title=shown.title, words=shown.words, wide=wide).encode()


_HEAD_OF_PNG = 33
"""A PNG's signature and its first chunk, in bytes."""


def _as_wide(png: bytes, pixels: int, wide: float) -> bytes:
    """Return a PNG that says how many of its pixels lie in a metre of paper."""
    each = round(1000 * pixels / wide)
    chunk = b"pHYs" + struct.pack(">IIB", each, each, 1)
    framed = struct.pack(">I", len(chunk) - 4) + chunk + struct.pack(">I", zlib.crc32(chunk))
    return png[:_HEAD_OF_PNG] + framed + png[_HEAD_OF_PNG:]
