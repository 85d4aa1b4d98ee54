"""Which font has a character: the bundled face, or the system's; what none has is spelt or left out.

The face is Source Sans Pro (Paul D. Hunt, SIL Open Font License 1.1), which lies in `faces`: Latin,
Greek and Cyrillic, subscripts, digits of one width, and the same glyphs on every machine.
"""

from __future__ import annotations

import unicodedata
import warnings
from collections.abc import Iterator
from importlib.resources import files
from io import BytesIO
from pathlib import Path

import pygame

REGULAR = "SourceSansPro-Regular.ttf"
SEMIBOLD = "SourceSansPro-Semibold.ttf"

_NOWHERE = "\ufdd0"
"""Not a character: a font draws its sign for what it lacks."""
_WIDE = (
    *("notosanscjksc", "notosanscjkjp", "notosanscjk", "sourcehansanssc", "wenquanyimicrohei"),
    *("wenquanyizenhei", "droidsansfallback", "microsoftyahei", "simhei", "pingfangsc", "hiraginosansgb"),
    *("applesdgothicneo", "malgungothic", "yugothic", "msgothic", "arialunicodems", "notosans"),
    *("notosansarabic", "notosanshebrew", "notosansdevanagari", "notosansthai", "nirmalaui", "segoeui"),
    *("dejavusans", "freesans"),
)
"""Families with many characters, as pygame names them; looked through in this order."""


class Fonts:
    """The bundled face in its two weights, and those of the system's fonts that were needed, by size."""

    def __init__(self) -> None:
        pygame.font.init()
        self._opened: dict[tuple[str, int], pygame.font.Font] = {}
        self._faces: dict[str, bytes] = {}
        self._spelt: dict[str, tuple[str, str]] = {}

    def ascent(self, em: int) -> int:
        """Return how far the bundled face's line reaches above its baseline, in pixels."""
        return self._font(REGULAR, em).get_ascent()

    def render(self, char: str, em: int, colour: tuple[int, int, int], *, face: str) -> pygame.Surface:
        """Return a character on nothing, as high as the bundled face's line; of no width if left out.

        `em` is the face's size in pixels, `face` REGULAR or SEMIBOLD.
        """
        home, text = self._spelling(char)
        bundled = self._font(face, em)
        if home == REGULAR and text:
            return bundled.render(text, True, colour)
        if home == REGULAR:
            return pygame.Surface((0, bundled.get_height()))
        font = self._font(home, em)
        drawn = font.render(text, True, colour)
        line = pygame.Surface((drawn.get_width(), bundled.get_height()), pygame.SRCALPHA, 32)
        line.blit(drawn, (0, bundled.get_ascent() - font.get_ascent()))
        return line

    def advance(self, char: str, em: int, *, face: str, after: str = "") -> int:
        """Return how far the pen moves on over a character, in pixels; to a neighbour `after` it, kerned."""
        home, text = self._spelling(char)
        font = self._font(face if home == REGULAR else home, em)
        beside, neighbour = self._spelling(after) if after else (REGULAR, "")
        if home != REGULAR or beside != REGULAR:
            return font.size(text)[0]
        return font.size(text + neighbour)[0] - font.size(neighbour)[0]

    def _font(self, path: str, em: int) -> pygame.font.Font:
        if (path, em) not in self._opened:
            self._opened[path, em] = pygame.font.Font(self._source(path), em)
        return self._opened[path, em]

    def _source(self, path: str) -> str | BytesIO:
        """Return what a font is read from: the bundled face, in many sizes, keeps no file open for each."""
        if path not in (REGULAR, SEMIBOLD):
            return path
        if path not in self._faces:
            self._faces[path] = Path(file_of(path)).read_bytes()
        return BytesIO(self._faces[path])

    def _spelling(self, char: str) -> tuple[str, str]:
        """Return the font file (REGULAR: the bundled face) and the text that a character is drawn with."""
        if char not in self._spelt:
            self._spelt[char] = self._found(char)
        return self._spelt[char]

    def _found(self, char: str) -> tuple[str, str]:
        if char.isspace():
            return REGULAR, " "
        if not char.isprintable() or unicodedata.combining(char):
            return REGULAR, ""
        if _has(self._font(REGULAR, 24), char):
            return REGULAR, char
        homes = (path for path in self._system() if _has(self._font(path, 24), char))
        home = next(homes, None)
        return (home, char) if home else (REGULAR, self._likeness(char))

    def _likeness(self, char: str) -> str:
        """Return what of a character's parts the bundled font has: Ǆ as DŽ, ﬁ as fi."""
        parts = unicodedata.normalize("NFKC", char)
        return "".join(part for part in parts if part.isprintable() and _has(self._font(REGULAR, 24), part))

    def _system(self) -> Iterator[str]:
        """Yield the files of the system's fonts, those that were needed before first."""
        used = tuple(dict.fromkeys(home for home, _ in self._spelt.values() if home != REGULAR))
        yield from used
        for path in _files():
            if path not in used:
                yield path


def file_of(path: str) -> str:
    """Return where a font's file lies; the bundled face's by its name alone."""
    bundled = path in (REGULAR, SEMIBOLD)
    return str(files("linkanim.picture") / "faces" / path) if bundled else path


def _files() -> Iterator[str]:
    """Yield the font files of the families with many characters that are there."""
    with warnings.catch_warnings():
        # where the system cannot list its fonts, there are none for us
        warnings.simplefilter("ignore")
        known = frozenset(pygame.font.get_fonts())
        found = [pygame.font.match_font(name) for name in _WIDE if name in known]
    yield from (path for path in found if path)


def _has(font: pygame.font.Font, char: str) -> bool:
    """Tell whether a font has a character with something to be seen; else it draws its sign for none."""
    if font.size(char)[0] == 0:
        return False
    measured = font.metrics(char)
    if None not in measured and measured != font.metrics(_NOWHERE):  # older ones measure none past U+FFFF
        return True
    drawn = [font.render(text, True, (0, 0, 0)) for text in (char, _NOWHERE)]
    ours, none = (pygame.image.tobytes(one, "RGBA") for one in drawn)
    return ours != none
