"""Which font has a character: the bundled one, or the system's; what none has is spelt or left out."""

from __future__ import annotations

import unicodedata
import warnings
from collections.abc import Iterator

import pygame

_NOWHERE = "\U0010fffe"
"""Not a character: a font draws its sign for what it lacks."""
_WIDE = (
    *("notosanscjksc", "notosanscjkjp", "notosanscjk", "sourcehansanssc", "wenquanyimicrohei"),
    *("wenquanyizenhei", "droidsansfallback", "microsoftyahei", "simhei", "pingfangsc", "hiraginosansgb"),
    *("applesdgothicneo", "malgungothic", "yugothic", "msgothic", "arialunicodems", "notosans"),
    *("notosansarabic", "notosanshebrew", "notosansdevanagari", "notosansthai", "nirmalaui", "segoeui"),
    *("dejavusans", "freesans"),
)
"""Families with many characters, as pygame names them; looked through in this order."""
_EM = 0.95
"""A system font's size in heights of the bundled font's line."""


class Fonts:
    """The bundled font and those of the system's that were needed, by size."""

    def __init__(self) -> None:
        pygame.font.init()
        self._opened: dict[tuple[str | None, int], pygame.Font] = {}
        self._spelt: dict[str, tuple[str | None, str]] = {}

    def render(self, char: str, points: int, colour: tuple[int, int, int]) -> pygame.Surface:
        """Return a character on nothing, as high as the bundled font's line; of no width if left out."""
        home, text = self._spelling(char)
        bundled = self._font(None, points)
        if home is None and text:
            return bundled.render(text, True, colour)
        high = bundled.render("0", True, colour).get_height()
        if home is None:
            return pygame.Surface((0, high))
        font = self._font(home, round(_EM * high))
        drawn = font.render(text, True, colour)
        line = pygame.Surface((drawn.get_width(), high), pygame.SRCALPHA, 32)
        line.blit(drawn, (0, bundled.get_ascent() - font.get_ascent()))
        return line

    def _font(self, path: str | None, points: int) -> pygame.Font:
        if (path, points) not in self._opened:
            self._opened[path, points] = pygame.Font(path, points)
        return self._opened[path, points]

    def _spelling(self, char: str) -> tuple[str | None, str]:
        """Return the font file (None: the bundled font) and the text that a character is drawn with."""
        if char not in self._spelt:
            self._spelt[char] = self._found(char)
        return self._spelt[char]

    def _found(self, char: str) -> tuple[str | None, str]:
        if char.isspace():
            return None, " "
        if not char.isprintable() or unicodedata.combining(char):
            return None, ""
        if _has(self._font(None, 24), char):
            return None, char
        homes = (path for path in self._system() if _has(self._font(path, 24), char))
        home = next(homes, None)
        return (home, char) if home else (None, self._likeness(char))

    def _likeness(self, char: str) -> str:
        """Return what of a character's parts the bundled font has: Ǆ as DŽ, ﬁ as fi."""
        parts = unicodedata.normalize("NFKC", char)
        return "".join(part for part in parts if part.isprintable() and _has(self._font(None, 24), part))

    def _system(self) -> Iterator[str]:
        """Yield the files of the system's fonts, those that were needed before first."""
        used = tuple(dict.fromkeys(home for home, _ in self._spelt.values() if home))
        yield from used
        for path in _files():
            if path not in used:
                yield path


def _files() -> Iterator[str]:
    """Yield the font files of the families with many characters that are there."""
    with warnings.catch_warnings():
        # where the system cannot list its fonts, there are none for us
        warnings.simplefilter("ignore")
        known = frozenset(pygame.font.get_fonts())
        found = [pygame.font.match_font(name) for name in _WIDE if name in known]
    yield from (path for path in found if path)


def _has(font: pygame.Font, char: str) -> bool:
    """Tell whether a font has a character with something to be seen; else it draws its sign for none."""
    if font.metrics(char) != font.metrics(_NOWHERE):
        return font.size(char)[0] > 0
    drawn = [font.render(text, True, (0, 0, 0)) for text in (char, _NOWHERE)]
    ours, none = (pygame.image.tobytes(one, "RGBA") for one in drawn)
    return ours != none
