"""Items as PDF, pages as large as the picture: filled paths, and text in the bundled face.

What that face lacks is set in a font of the system. A document carries of each font the letters that it has.
A pixel is 3/4 pt, as in a browser. Needs fpdf2, which the extra `pdf` installs.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Sequence
from datetime import UTC, datetime
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, NamedTuple

from linkanim.errors import BadInput
from linkanim.letters import spelt_out
from linkanim.paper.svg import flat, hexadecimal
from linkanim.picture.items import Caption, Group, Halo, Item
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.text import REGULAR, SEMIBOLD, Fonts, file_of, runs, typesetting

if TYPE_CHECKING:
    from fpdf import FPDF
    from fpdf.drawing import PaintedPath

_POINTS = 0.75
_POINTS_A_MM = 72 / 25.4
_FACE = "face"
_STYLES = {"": REGULAR, "B": SEMIBOLD}
_THEN = datetime(2000, 1, 1, tzinfo=UTC)
"""The date of every document: the same picture has the same bytes, whenever it is written."""


def require_pdf(find: Callable[[str], object] = find_spec) -> None:
    """Raise `BadInput` where fpdf2 is not installed, naming what installs it."""
    if find("fpdf") is None:
        raise BadInput(
            'PDF needs fpdf2, which is not installed; install with: pip install "linkanim[pdf]", '
            "or write an SVG instead"
        )


def pdf(
    size: tuple[int, int],
    background: Colour | None,
    items: Iterable[Item | Group],
    *,
    title: str,
    words: str = "",
    wide: float | None = None,
) -> bytes:
    """Return a picture, `size` in pixels, as a PDF document; None leaves the background open.

    Its page is `wide` mm wide; without that, a pixel is 3/4 pt.
    It has a language, a title and, as its subject, the words that say what is seen in it.
    """
    return pages(size, background, [items], title=title, words=words, wide=wide)


def pages(
    size: tuple[float, float],
    background: Colour | None,
    pictures: Iterable[Iterable[Item | Group]],
    *,
    title: str,
    words: str = "",
    wide: float | None = None,
) -> bytes:
    """Return pictures of one size, each a page of a PDF document, as `pdf` does one."""
    point = wide * _POINTS_A_MM / size[0] if wide else _POINTS
    document, fonts = _document(size, title, words, point), Fonts()
    for items in pictures:
        document.add_page()
        if background is not None:
            document.set_fill_color(*background)
            document.rect(0, 0, *size, style="F")
        for item in flat(items):
            if isinstance(item, Layer):
                _fill(document, item)
            else:
                _write(document, item, point, fonts)
    return bytes(document.output())


def _document(size: tuple[float, float], title: str, words: str, point: float) -> FPDF:
    """Return an empty document, in which a pixel is `point` points."""
    from fpdf import FPDF
    from fpdf.prefs import ViewerPreferences

    # tables of a font that a document needs not are left out without a word
    logging.getLogger("fontTools.subset").setLevel(logging.ERROR)
    page = FPDF(unit=point, format=size)
    page.set_auto_page_break(False)
    page.set_creation_date(_THEN)
    page.set_title(title)
    page.set_lang("en")
    # a reader names the window by the title, not by the file
    page.viewer_preferences = ViewerPreferences(display_doc_title=True)
    if words:
        page.set_subject(words)
    for style, face in _STYLES.items():
        page.add_font(_FACE, style, file_of(face))
    return page


def _fill(page: FPDF, layer: Layer) -> None:
    """Fill a layer's loops; those that turn the other way cut holes."""
    if not layer.loops:
        return
    with page.drawing_context() as drawn:
        from fpdf.drawing import PaintedPath

        path = PaintedPath()
        path.style.fill_color = hexadecimal(layer.colour)
        path.style.stroke_color = None
        path.style.fill_opacity = layer.alpha
        path.style.intersection_rule = "nonzero"
        for loop in layer.loops:
            first, *rest = loop.round(2).tolist()
            path.move_to(first.real, first.imag)
            for point in rest:
                path.line_to(point.real, point.imag)
            path.close()
        drawn.add_item(path, False)  # no copy, which would take most of the time


def _write(page: FPDF, line: Caption, point: float, fonts: Fonts) -> None:
    """Write a line of text, its subscripts smaller and lower, in its halo; a pixel is `point` points.

    The halo is a line along the letters and no text, so that copied words come once.
    """
    how = typesetting(line.size)
    set_ = [
        (_Font.of(page, home, strong=line.strong), text, em, run.lowered * how.lower)
        for run in runs(line.text)
        for em in [how.small if run.lowered else how.em]
        for home, text in fonts.pieces(spelt_out(run.text, fonts.has_alone))
    ]
    widths = [font.width(page, text, em * point) for font, text, em, _ in set_]
    x = line.at[0] - {"left": 0.0, "centre": 0.5, "right": 1.0}[line.anchor] * sum(widths)
    page.set_text_color(*line.colour)
    starts = (x + sum(widths[:n]) for n in range(len(widths)))
    placed = [
        (font, text, em, (at, line.at[1] + how.baseline + lower))
        for at, (font, text, em, lower) in zip(starts, set_, strict=True)
    ]
    if line.halo:
        for font, text, em, place in placed:
            _outline(page, text, font, em, place, line.halo)
    for font, text, em, place in placed:
        page.set_font(font.family, font.style, em * point)
        page.text(*place, text)


class _Font(NamedTuple):
    """A font of a document, by its family and style there."""

    family: str
    style: str

    @classmethod
    def of(cls, page: FPDF, home: str, *, strong: bool) -> _Font:
        """Return the bundled face in its weight, or a font of the system, which the document then carries."""
        if home == REGULAR:
            return cls(_FACE, "B" if strong else "")
        family = f"system{home}".lower()
        if family not in page.fonts:
            page.add_font(family, "", home)
        return cls(family, "")

    def width(self, page: FPDF, text: str, size: float) -> float:
        """Return how wide a text is at a size in points."""
        page.set_font(self.family, self.style, size)
        return float(page.get_string_width(text))


def _outline(page: FPDF, text: str, face: _Font, em: float, place: tuple[float, float], halo: Halo) -> None:
    """Draw a line centred on the edges of letters."""
    from fontTools.pens.recordingPen import DecomposingRecordingPen
    from fontTools.pens.transformPen import TransformPen
    from fpdf.drawing import PaintedPath

    font: Any = page.fonts[face.family + face.style]
    glyphs, names = font.ttfont.getGlyphSet(), font.ttfont.getBestCmap()
    scale, x = em / font.ttfont["head"].unitsPerEm, place[0]
    path, pen = PaintedPath(), DecomposingRecordingPen(glyphs)
    for char in text:
        glyph = glyphs[names[ord(char)]]
        glyph.draw(TransformPen(pen, (scale, 0, 0, -scale, x, place[1])))
        x += scale * glyph.width
    for step, points in pen.value:
        _step(path, step, points)
    path.style.fill_color = None
    path.style.stroke_color = hexadecimal(halo.colour)
    path.style.stroke_width = 2 * halo.width
    path.style.stroke_join_style = "round"
    with page.drawing_context() as drawn:
        drawn.add_item(path, False)


def _step(path: PaintedPath, step: str, points: Sequence[tuple[float, float]]) -> None:
    """Add a step of a glyph's outline to a path; its curves may be quadratic or cubic."""
    from fontTools.pens.basePen import decomposeQuadraticSegment

    match step:
        case "moveTo":
            path.move_to(*points[0])
        case "lineTo":
            path.line_to(*points[0])
        case "qCurveTo":
            for bend, to in decomposeQuadraticSegment(points):
                path.quadratic_curve_to(*bend, *to)
        case "curveTo":
            path.curve_to(*(part for at in points for part in at))
        case _:
            path.close()
