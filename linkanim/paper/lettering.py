"""The face of a document's letters: the part of it that the document carries, and how wide it sets words."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable
from functools import lru_cache
from io import BytesIO
from typing import TYPE_CHECKING, Any

from linkanim.picture.items import Caption
from linkanim.picture.text import REGULAR, SEMIBOLD, file_of, runs, typesetting

if TYPE_CHECKING:
    from fontTools.ttLib import TTFont

FAMILY = "Source Sans Pro"
WEIGHTS = {REGULAR: 400, SEMIBOLD: 600}
_LEFT_OUT = ["DSIG", "GDEF"]


def rules(lines: Iterable[Caption]) -> str:
    """Return the CSS rules by which a document carries the letters of its lines, and no others."""
    used: dict[str, set[str]] = {face: set() for face in WEIGHTS}
    for line in lines:
        used[_face(line)].update(char for run in runs(line.text) for char in run.text)
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
    """Return the rule for the part of a face that has these letters, kept as they are in the face's file."""
    from fontTools.subset import Options, Subsetter

    options = Options(hinting=False, layout_features=["kern"], name_IDs=[], notdef_outline=True)
    options.recalc_timestamp = False
    options.drop_tables += _LEFT_OUT
    subsetter, part = Subsetter(options), BytesIO()
    subsetter.populate(text=chars)
    with _opened(face) as font:
        subsetter.subset(font)
        font.save(part)
    data = b64encode(part.getvalue()).decode()
    where = f"src:url(data:font/ttf;base64,{data})"
    return f"@font-face{{font-family:'{FAMILY}';font-weight:{WEIGHTS[face]};{where}}}"


@lru_cache
def _advances(face: str) -> tuple[int, dict[str, int]]:
    """Return the units of an em, and how many of them each letter of a face advances."""
    with _opened(face) as opened:
        font: Any = opened
        widths, letters = font["hmtx"].metrics, font.getBestCmap()
        return font["head"].unitsPerEm, {chr(code): widths[name][0] for code, name in letters.items()}


def _opened(face: str) -> TTFont:
    from fontTools.ttLib import TTFont

    return TTFont(file_of(face), lazy=True, recalcTimestamp=False)
