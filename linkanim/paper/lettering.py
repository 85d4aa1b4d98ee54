"""The fonts of a document's letters: the part of each that the document carries, and how wide words are."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable
from functools import lru_cache
from io import BytesIO
from typing import TYPE_CHECKING, Any

from linkanim.picture.items import Caption
from linkanim.picture.text import REGULAR, SEMIBOLD, Fonts, file_of, runs, typesetting

if TYPE_CHECKING:
    from fontTools.ttLib import TTFont

FAMILY = "Source Sans Pro"
FURTHER = "Further Letters"
"""What a document calls the fonts of this system from which it carries letters."""
WEIGHTS = {REGULAR: 400, SEMIBOLD: 600}
_LEFT_OUT = ["DSIG", "GDEF", "FFTM"]


def rules(lines: Iterable[Caption]) -> str:
    """Return the CSS rules by which a document carries the letters of its lines, and no others.

    What the bundled face lacks comes from a font of this system; what that has not either, from the reader's.
    """
    used: dict[str, set[str]] = {face: set() for face in WEIGHTS}
    fonts = Fonts()
    for line in lines:
        for run in runs(line.text):
            for home, text in fonts.pieces(run.text):
                used.setdefault(_face(line) if home == REGULAR else home, set()).update(text)
    return "".join(_rule(face, "".join(sorted(chars))) for face, chars in used.items() if chars)


def width(line: Caption) -> float | None:
    """Return how wide a line is in its face; None where that lacks a letter."""
    how, (units, advances) = typesetting(line.size), _advances(_face(line))
    sizes = [(char, how.small if run.lowered else how.em) for run in runs(line.text) for char in run.text]
    if not all(char in advances for char, _ in sizes):
        return None
    return sum(advances[char] * em for char, em in sizes) / units


def _face(line: Caption) -> str:
    return SEMIBOLD if line.strong else REGULAR


@lru_cache(maxsize=64)
def _rule(face: str, chars: str) -> str:
    """Return the rule for the part of a font that has these letters, kept as they are in the font's file."""
    from fontTools.subset import Options, Subsetter

    bundled = face in WEIGHTS
    features = ["kern"] if bundled else ["*"]
    options = Options(hinting=False, layout_features=features, name_IDs=[], notdef_outline=True)
    options.recalc_timestamp = False
    options.drop_tables += _LEFT_OUT
    subsetter, part = Subsetter(options), BytesIO()
    subsetter.populate(text=chars)
    with _opened(face) as font:
        subsetter.subset(font)
        font.save(part)
    data = b64encode(part.getvalue()).decode()
    where = f"src:url(data:font/ttf;base64,{data})"
    if bundled:
        return f"@font-face{{font-family:'{FAMILY}';font-weight:{WEIGHTS[face]};{where}}}"
    ranges = ",".join(f"U+{ord(char):X}" for char in chars)
    return f"@font-face{{font-family:'{FURTHER}';unicode-range:{ranges};{where}}}"


@lru_cache
def _advances(face: str) -> tuple[int, dict[str, int]]:
    """Return the units of an em, and how many of them each letter of a face advances."""
    with _opened(face) as opened:
        font: Any = opened
        widths, letters = font["hmtx"].metrics, font.getBestCmap()
        return font["head"].unitsPerEm, {chr(code): widths[name][0] for code, name in letters.items()}


def _opened(face: str) -> TTFont:
    from fontTools.ttLib import TTFont

    return TTFont(file_of(face), lazy=True, recalcTimestamp=False, fontNumber=0)
