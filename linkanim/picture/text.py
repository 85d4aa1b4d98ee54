"""Set lines of text: one face in two weights and a few sizes, subscripts set as such.

Each character comes from the bundled face or from the system's; what no font has is spelt, or a sign stands
for it. Letters that join, or run from right to left, are drawn a stretch at a time.
Words that move are set once in a halo and placed to a quarter of a pixel, so that they glide.
"""

from __future__ import annotations

import re
import unicodedata
import warnings
from bisect import bisect_left
from collections.abc import Hashable, Iterable, Iterator
from functools import cache, cached_property, lru_cache
from io import BytesIO
from itertools import groupby, pairwise, product
from math import ceil, prod
from operator import itemgetter
from pathlib import Path
from typing import Literal, NamedTuple
from unicodedata import normalize

import numpy as np
import pygame
from numpy.typing import NDArray

from linkanim.letters import spelt_out
from linkanim.picture.raster import Colour, offscreen, pixel_view
from linkanim.picture.shapes import directions

# Which font has a character: the bundled face, or the system's; for one in no font see `linkanim.letters`.
#
# The face is Source Sans Pro (Paul D. Hunt, SIL Open Font License 1.1), which lies in `faces`: Latin,
# Greek and Cyrillic, subscripts, digits of one width, and the same glyphs on every machine.

REGULAR = "SourceSansPro-Regular.ttf"
SEMIBOLD = "SourceSansPro-Semibold.ttf"

_NOWHERE = "\ufdd0"
"""Not a character: for it a font draws its sign for a missing glyph."""
_WIDE = (
    *("notosanscjksc", "notosanscjkjp", "notosanscjk", "sourcehansanssc", "wenquanyimicrohei"),
    *("wenquanyizenhei", "droidsansfallback", "microsoftyahei", "simhei", "pingfangsc", "hiraginosansgb"),
    *("applesdgothicneo", "malgungothic", "yugothic", "msgothic", "arialunicodems", "notosans"),
    *("notosansarabic", "notosanshebrew", "notosansdevanagari", "notosansthai", "nirmalaui", "segoeui"),
    *("dejavusans", "freesans"),
)
"""Families with many characters, as pygame names them; looked through in this order."""
_JOINED = {
    **{"ARABIC": "Arab", "SYRIAC": "Syrc", "NKO": "Nkoo", "HEBREW": "Hebr", "MONGOLIAN": "Mong"},
    **{"DEVANAGARI": "Deva", "BENGALI": "Beng", "GURMUKHI": "Guru", "GUJARATI": "Gujr", "TAMIL": "Taml"},
    **{"TELUGU": "Telu", "KANNADA": "Knda", "MALAYALAM": "Mlym", "THAI": "Thai", "KHMER": "Khmr"},
}
"""Scripts whose letters depend on their neighbours, by their names in Unicode and in OpenType."""
JOINS = hasattr(pygame.font.Font, "set_script")
"""Whether letters are joined here: pygame-ce does it, by SDL_ttf."""


class Fonts:
    """The bundled face in its two weights, and the system's fonts that were needed so far, by size."""

    def __init__(self) -> None:
        pygame.font.init()
        self._opened: dict[tuple[str, int, str], pygame.font.Font] = {}
        self._faces: dict[str, bytes] = {}
        self._spelt: dict[str, tuple[str, str]] = {}

    def face_has(self, char: str) -> bool:
        """Return whether the bundled face has a character that is seen."""
        return _is_seen(char) and _has(self._font(REGULAR, 24), char)

    def has(self, char: str) -> bool:
        """Return whether the bundled face or a font of the system has a character."""
        return self.face_has(char) or self._spelling(char)[0] != REGULAR

    def ascent(self, em: int) -> int:
        """Return how far the bundled face's line reaches above its baseline, in pixels."""
        return self._font(REGULAR, em).get_ascent()

    def render(self, char: str, em: int, colour: tuple[int, int, int], *, face: str) -> pygame.Surface:
        """Return a glyph on a clear surface, as high as a line of the bundled face; 0 wide if left out.

        `em` is the face's size in pixels, `face` REGULAR or SEMIBOLD.
        """
        home, text = self._spelling(char)
        bundled = self._font(face, em)
        if home == REGULAR and text:
            return bundled.render(text, True, colour)
        if home == REGULAR:
            return pygame.Surface((0, bundled.get_height()))
        font = self._font(home, em, script_of(text))
        drawn = font.render(text, True, colour)
        line = pygame.Surface((drawn.get_width(), bundled.get_height()), pygame.SRCALPHA, 32)
        line.blit(drawn, (0, bundled.get_ascent() - font.get_ascent()))
        return line

    def advance(self, char: str, em: int, *, face: str, after: str = "") -> int:
        """Return a glyph's advance in pixels, kerned to the one `after` it."""
        home, text = self._spelling(char)
        font = self._font(face if home == REGULAR else home, em, script_of(text))
        beside, neighbour = self._spelling(after) if after else (REGULAR, "")
        if home != REGULAR or beside != REGULAR:
            return font.size(text)[0]
        return font.size(text + neighbour)[0] - font.size(neighbour)[0]

    def pieces(self, text: str) -> list[tuple[str, str]]:
        """Return a text in pieces of one font each: its file (REGULAR: the bundled face), and what is set."""
        spellings = ((char, *self._spelling(char)) for char in text)
        runs = groupby(spellings, key=itemgetter(1))
        return [(home, "".join(spelling for _, _, spelling in piece)) for home, piece in runs]

    def has_alone(self, char: str) -> bool:
        """Return whether a font has a character, and its form does not depend on its neighbours."""
        return self.has(char) and not script_of(char)

    def _font(self, path: str, em: int, script: str = "") -> pygame.font.Font:
        key = path, em, script
        if key not in self._opened:
            self._opened[key] = font = pygame.font.Font(self._source(path), em)
            if script and JOINS:
                font.set_script(script)
                rightward = script not in ("Arab", "Syrc", "Nkoo", "Hebr")
                font.set_direction(pygame.DIRECTION_LTR if rightward else pygame.DIRECTION_RTL)
        return self._opened[key]

    def _source(self, path: str) -> str | BytesIO:
        """Return what a font is read from: the bundled face from memory, so that no file stays open."""
        if path not in (REGULAR, SEMIBOLD):
            return path
        if path not in self._faces:
            self._faces[path] = Path(file_of(path)).read_bytes()
        return BytesIO(self._faces[path])

    def _spelling(self, char: str) -> tuple[str, str]:
        """Return the font file (REGULAR: the bundled face) and the text that a character is drawn with."""
        if char not in self._spelt:
            self._spelt[char] = self._home_of(char)
        return self._spelt[char]

    def _home_of(self, char: str) -> tuple[str, str]:
        if _is_seen(char) and not self.face_has(char) and (JOINS or not script_of(char)):
            homes = (path for path in self._system() if _has(self._font(path, 24), char))
            if home := next(homes, None):
                return home, char
        return REGULAR, spelt_out(char, self.face_has)

    def _system(self) -> Iterator[str]:
        """Yield the files of the system's fonts, first those that were needed before."""
        used = tuple(dict.fromkeys(home for home, _ in self._spelt.values() if home != REGULAR))
        yield from used
        for path in _files():
            if path not in used:
                yield path


def file_of(path: str) -> str:
    """Return where a font's file lies; the bundled face's by its name alone."""
    bundled = path in (REGULAR, SEMIBOLD)
    return str(Path(__file__).parent / "faces" / path) if bundled else path


def _files() -> Iterator[str]:
    """Yield the installed font files of the families with many characters."""
    with warnings.catch_warnings():
        # a system that cannot list its fonts counts as having none
        warnings.simplefilter("ignore")
        known = frozenset(pygame.font.get_fonts())
        files = [pygame.font.match_font(name) for name in _WIDE if name in known]
    yield from (path for path in files if path)


def _is_seen(char: str) -> bool:
    """Tell whether a character can have a glyph of its own: spaces, controls and lone marks have none."""
    return char.isprintable() and not char.isspace() and not unicodedata.combining(char[0])


def _has(font: pygame.font.Font, char: str) -> bool:
    """Tell whether a font has a visible glyph of a character, not only its sign for a missing one.

    Of letters that join it has to have each that is seen by itself.
    """
    if len(char) > 1:
        return all(_has(font, one) for one in char if _is_seen(one))
    if font.size(char)[0] == 0:
        return False
    measured = font.metrics(char)
    if None not in measured and measured != font.metrics(_NOWHERE):  # older ones measure none past U+FFFF
        return True
    drawn = [font.render(text, True, (0, 0, 0)) for text in (char, _NOWHERE)]
    ours, none = (pygame.image.tobytes(one, "RGBA") for one in drawn)
    return ours != none


def script_of(text: str) -> str:
    """Return the script of a text whose first letter depends on its neighbours; "" for any other."""
    return "" if text.isascii() else _JOINED.get(unicodedata.name(text[0], "").partition(" ")[0], "")


def glyphs_of(text: str) -> list[str]:
    """Return a text in what is drawn at once: a character, or a stretch of letters that join."""
    glyphs: list[str] = []
    script = ""
    for char in text:
        own = script_of(char) or (script if char == " " or unicodedata.combining(char) else "")
        if own and own == script:
            glyphs[-1] += char
        else:
            glyphs.append(char)
        script = own
    return [part for whole in glyphs for part in _ending(whole)]


def _ending(whole: str) -> list[str]:
    """Return a stretch, and the spaces that it ends in by themselves."""
    bare = whole.rstrip(" ") or whole
    return [bare, *whole[len(bare) :]]


# Text: one face in two weights and a few sizes, every glyph rendered once, subscripts set as such.
#
# A subscript is written with Unicode's own signs (`O₂`, `ω₃`, `aₓ`) or, where there are none for it, in
# braces (`I_{13}`, `v_{BA}`); either is typeset smaller and lower. `subscripted` writes a joint's name so.

Anchor = Literal["left", "centre", "right"]

_FINE = 4
"""Glyphs are drawn this many times larger and averaged; they are placed to this fraction of a pixel."""
_X_HEIGHT = 0.486
"""The face's height of an x, in ems."""
_REACH = 0.51
"""The height of an x in heights of a line."""
_BASE = 0.78
"""Where the baseline lies, in heights of a line below its top."""
_SUB, _LOWER, _LEAST = 0.72, 0.2, 8
"""A subscript's size and how far it is lowered, in sizes of its text; its least size in pixels."""
_LOOSE = 7
"""Where an x is no higher than this, in pixels, letters stand a fraction of a pixel further apart."""
_SUBSCRIPT = re.compile(r"_\{([^{}]*)\}|([\u2080-\u209c\u1d62-\u1d6a\u2c7c]+)")
_HYPHENED = re.compile(r"[^-]*-|[^-]+")
_CLOSES, _OPENS = "。，、；：！？）」』》〉】％", "（「『《〈【"
_WIDE_SIGN = r"\u2e80-\u2fff\u3040-\u9fff\uac00-\ud7af\uf900-\ufaff"
"""Characters before and after which a line may end: Chinese, Japanese, Korean."""
_UNSPACED = (
    rf"[{_OPENS}]*(?:[{_WIDE_SIGN}]|[^{_WIDE_SIGN}{_OPENS}{_CLOSES}]+)[{_CLOSES}]*|[{_OPENS}{_CLOSES}]+"
)
"""Compiled when it is first used: of all patterns it takes longest."""
_LOWERED = {ord("0") + n: 0x2080 + n for n in range(10)}
_INDEX = re.compile(r"(?<=[^\W\d_])_?(\d+)('*)$")


_KEPT = 2048
"""How many typeset lines are remembered: as many as one turn of a scene with a dozen values shows."""
_INKED_BYTES = 1_000_000
"""How many bytes new drawn lines may take until lines that were not drawn meanwhile are forgotten."""


class Run(NamedTuple):
    """Part of a line that is set in one way."""

    text: str
    lowered: bool


def runs(text: str) -> tuple[Run, ...]:
    """Return a line in its runs: what stands on the line, and its subscripts in plain letters."""
    return tuple(run for run in _runs(normalize("NFC", text)) if run.text)


class Typesetting(NamedTuple):
    """How a line is set by another printer: the sizes of face and subscript in pixels, and their shifts."""

    em: float
    small: float
    baseline: float
    """How far the baseline is below the line's top."""
    lower: float
    """How far a subscript stands below the baseline."""


def typesetting(size: int) -> Typesetting:
    """Return how lines of a height are set, for a printer that has other fonts."""
    small = max(round(_SUB * size), min(size, _LEAST))
    return Typesetting(_em(size) / _FINE, _em(small) / _FINE, round(_BASE * size), round(_LOWER * size))


def subscripted(name: str) -> str:
    """Return a name with the number it ends in as a subscript: O2 as O₂, O2' as O₂'; another as it is."""
    return _INDEX.sub(lambda match: match[1].translate(_LOWERED) + match[2], name)


_NAME = r"\b[^\W\d_]\w*"


@lru_cache(maxsize=512)
def subscripted_words(words: str) -> str:
    """Return words with the digits at the ends of names as subscripts."""
    return re.sub(_NAME, lambda name: subscripted(name[0]), words)


_Place = tuple[str, int, int, int]
"""A glyph: what is drawn at once, its size, how far right (in fractions of a pixel) and how far down."""


class Inked(NamedTuple):
    """Letters on a clear surface cut to their ink, and its offset right and down in pixels."""

    sprite: pygame.Surface
    right: int
    down: int


class Type:
    """The face's sizes and the glyphs that were used so far; bounded by the face's alphabet."""

    def __init__(self) -> None:
        self._fonts = Fonts()
        self._glyphs: dict[tuple[str, int, Colour, str, int], Inked] = {}
        self._steps: dict[tuple[str, str, int, str], int] = {}
        self._lines: dict[tuple[str, int, str], tuple[_Place, ...]] = {}
        self._wrapped: dict[tuple[str, int, float, str, bool], tuple[str, ...]] = {}
        self._narrowest: dict[tuple[str, int, int], int] = {}
        self._inked: dict[tuple[str, int, str, Colour], tuple[int, list[Inked]]] = {}
        self._inked_bytes = 0
        self._drawn: set[Hashable] = set()
        self._once: set[Hashable] = set()

    def shows(self, text: str) -> bool:
        """Return whether any letter of a text is set, and not only a sign for it."""
        return any(map(self._fonts.has, normalize("NFC", text)))

    def width(self, text: str, size: int, *, strong: bool = False) -> int:
        """Return how wide a line is in pixels; `strong` is the semibold weight."""
        _, _, end, _ = self._set(text, size, _face(strong))[-1]
        return -(-end // _FINE)

    def draw(
        self,
        surface: pygame.Surface,
        text: str,
        at: tuple[float, float],
        *,
        size: int,
        colour: Colour,
        anchor: Anchor = "left",
        strong: bool = False,
    ) -> int:
        """Draw one line whose top is at `at`, and return its width in pixels.

        `text` may hold subscripts, as written above; `strong` is the semibold weight. A line begins at a
        whole pixel, since text that glides reads worse than text that steps; its glyphs are placed to a
        quarter of a pixel, which spaces small text evenly.
        """
        width, inked = self._inked_of(text, size, colour, _face(strong))
        x, y = _left_edge(at[0], width, anchor), round(at[1]) + round(_BASE * size)
        surface.blits([(sprite, (x + right, y + down)) for sprite, right, down in inked], doreturn=False)
        return width

    def _inked_of(self, text: str, size: int, colour: Colour, face: str) -> tuple[int, list[Inked]]:
        """Return a line's width and its letters; a line that recurs is joined on as few surfaces as possible.

        It is then drawn fast; values that change with every frame are not worth that work.
        """
        key = (text, size, face, colour)
        if key not in self._inked:
            *places, (_, _, end, _) = self._set(text, size, face)
            inks = (
                (self._glyph(char, small, colour, face, x % _FINE), x // _FINE, y)
                for char, small, x, y in places
            )
            inked = [Inked(ink, x + right, y + down) for (ink, right, down), x, y in inks if ink.get_width()]
            width = -(-end // _FINE)
            if key not in self._once:
                if len(self._once) >= _KEPT:
                    self._once.clear()
                self._once.add(key)
                return width, inked
            inked = [_joined(run) for run in _apart(inked)]
            self._make_room(sum(4 * prod(letters.sprite.get_size()) for letters in inked))
            self._inked[key] = width, inked
        self._drawn.add(key)
        return self._inked[key]

    def _make_room(self, further: int) -> None:
        """Forget lines that were not drawn since the last time, where `further` bytes more are too many."""
        self._inked_bytes += further
        if self._inked_bytes > _INKED_BYTES or len(self._inked) >= _KEPT:
            self._inked = {key: line for key, line in self._inked.items() if key in self._drawn}
            self._drawn.clear()
            self._inked_bytes = further

    def _glyph(self, char: str, size: int, colour: Colour, face: str, part: int) -> Inked:
        """Return one anti-aliased character, shifted right by `part` quarters of a pixel."""
        key = (char, size, colour, face, part)
        if key not in self._glyphs:
            drawn = self._fonts.render(char, _em(size), colour, face=face)
            glyph = _averaged(drawn, part, self._fonts.ascent(_em(size)), colour)
            ink = glyph.get_bounding_rect()
            self._glyphs[key] = Inked(glyph.subsurface(ink), ink.x, ink.y)
        return self._glyphs[key]

    def _set(self, text: str, size: int, face: str) -> tuple[_Place, ...]:
        """Return where the glyphs of a line stand, and its end; cached, since most lines are drawn again."""
        key = (text, size, face)
        if key not in self._lines:
            if len(self._lines) >= _KEPT:
                self._lines.clear()
            self._lines[key] = tuple(self._setting(text, size, face))
        return self._lines[key]

    def _setting(self, text: str, size: int, face: str) -> Iterator[_Place]:
        """Yield where the glyphs of a line stand from the left of its baseline, then its end."""
        x = 0
        for run in runs(text):
            small = max(round(_SUB * size), min(size, _LEAST)) if run.lowered else size
            top = (round(_LOWER * size) if run.lowered else 0) - self._ascent(small)
            for char, after in pairwise((*glyphs_of(run.text), "")):
                yield char, small, x, top
                key = char, after, small, face
                if key not in self._steps:
                    self._steps[key] = self._step(*key)
                x += self._steps[key]
        yield "", size, x, 0

    def _ascent(self, size: int) -> int:
        """Return how high glyphs reach above the baseline, in pixels."""
        return -(-self._fonts.ascent(_em(size)) // _FINE)

    def _step(self, char: str, after: str, size: int, face: str) -> int:
        """Return the advance from a character to the next one of its run, in fractions of a pixel."""
        if _x_height(size) <= _LOOSE:
            return self._fonts.advance(char, _em(size), face=face) + 1
        return self._fonts.advance(char, _em(size), face=face, after=after)

    def wrapped(
        self, text: str, size: int, width: float, *, gap: str = " ", strong: bool = False
    ) -> list[str]:
        """Return the text in lines no wider than `width`, broken between its words, which `gap` separates.

        A word that is wider is broken after a hyphen, else anywhere inside, as are scripts without spaces.
        The latest results are cached: every change of the look sets the words about a scene again.
        """
        key = (text, size, width, gap, strong)
        if key not in self._wrapped:
            if len(self._wrapped) >= _KEPT:
                self._wrapped.clear()
            self._wrapped[key] = tuple(self._in_lines(*key[:4], strong=strong))
        return [*self._wrapped[key]]

    def _in_lines(self, text: str, size: int, width: float, gap: str, *, strong: bool) -> list[str]:
        lines: list[str] = []
        words = filter(str.strip, text.split(gap))
        for gap_before, piece in (
            (gap if n == 0 else "", part) for word in words for n, part in enumerate(unspaced(word))
        ):
            longer = f"{lines[-1]}{gap_before}{piece}" if lines else piece
            if lines and self.width(longer, size, strong=strong) <= width:
                lines[-1] = longer
            else:
                lines += self._broken(piece, size, width, strong=strong)
        return lines

    def narrowest(self, text: str, size: int, count: int) -> int:
        """Return the least width in which a semibold text has at most `count` lines, broken between words."""
        key = (text, size, count)
        if key not in self._narrowest:
            pieces = [piece for word in text.split() for piece in unspaced(word)]
            widest = max((self.width(piece, size, strong=True) for piece in pieces), default=0)

            def fits(width: int) -> bool:
                found = self._in_lines(text, size, width, " ", strong=True)
                return len(found) <= count and width >= widest

            if len(self._narrowest) >= _KEPT:
                self._narrowest.clear()
            widths = range(self.width(text, size, strong=True) + 1)
            self._narrowest[key] = bisect_left(widths, True, key=fits)
        return self._narrowest[key]

    def _broken(self, word: str, size: int, width: float, *, strong: bool) -> list[str]:
        """Return a word in pieces no wider than `width`, but of at least one character each."""
        pieces = [""]
        for part in hyphened(word):
            wide = self.width(part, size, strong=strong) > width
            for more in part if wide else (part,):
                if pieces[-1] and self.width(pieces[-1] + more, size, strong=strong) > width:
                    pieces.append("")
                pieces[-1] += more
        return pieces


def hyphened(word: str) -> list[str]:
    """Return the parts of a word between which a line may end, each with the hyphen at its end."""
    return [part for piece in unspaced(word) for part in _HYPHENED.findall(piece)]


def unspaced(word: str) -> list[str]:
    """Return the pieces of what has no space in it between which a line may end: of Chinese, its characters.

    A mark that closes stays with what is before it, one that opens with what follows.
    """
    return [word] if word.isascii() else re.findall(_UNSPACED, word)


def _runs(text: str) -> Iterator[Run]:
    end = 0
    for match in _SUBSCRIPT.finditer(text):
        yield Run(text[end : match.start()], lowered=False)
        yield Run(match[1] or normalize("NFKC", match[2] or ""), lowered=True)
        end = match.end()
    yield Run(text[end:], lowered=False)


def _face(strong: bool) -> str:
    return SEMIBOLD if strong else REGULAR


def _x_height(size: int) -> int:
    """Return how high an x is for a line's height, in whole pixels, so that its edges are sharp."""
    return max(round(_REACH * size), 1)


def _em(size: int) -> int:
    """Return the face's size in fractions of a pixel for a line's height in pixels."""
    return round(_FINE * _x_height(size) / _X_HEIGHT)


def _averaged(drawn: pygame.Surface, part: int, ascent: int, colour: Colour) -> pygame.Surface:
    """Return an enlarged glyph at its true size, shifted right by `part`; its baseline is a pixel's edge."""
    width, height = drawn.get_size()
    down = -ascent % _FINE
    room = (-(-(part + width) // _FINE) * _FINE, -(-(down + height) // _FINE) * _FINE)
    large = pygame.Surface(room, pygame.SRCALPHA, 32)
    large.fill((*colour, 0))
    drawn.set_alpha(None)  # it is copied, not blended
    large.blit(drawn, (part, down))
    return pygame.transform.smoothscale(large, (room[0] // _FINE, room[1] // _FINE))


def _apart(glyphs: Iterable[Inked]) -> Iterator[list[Inked]]:
    """Yield a line's glyphs in runs; in a run each begins right of the last one's end.

    Glyphs that overlap are in different runs, so that they are blended, and rounded, one after the other.
    """
    run: list[Inked] = []
    end = 0
    for glyph in glyphs:
        if run and glyph.right < end:
            yield run
            run = []
        run.append(glyph)
        end = glyph.right + glyph.sprite.get_width()
    if run:
        yield run


def _joined(run: list[Inked]) -> Inked:
    """Return glyphs that do not touch on one surface."""
    if len(run) == 1:
        return run[0]
    left, top = run[0].right, min(glyph.down for glyph in run)
    right, low = run[-1].right + run[-1].sprite.get_width(), max(g.down + g.sprite.get_height() for g in run)
    sheet = pygame.Surface((right - left, low - top), pygame.SRCALPHA, 32)
    sheet.blits([(glyph.sprite, (glyph.right - left, glyph.down - top)) for glyph in run], doreturn=False)
    return Inked(sheet, left, top)


def _left_edge(x: float, width: int, anchor: Anchor) -> int:
    return round(x) - {"left": 0, "centre": width // 2, "right": width}[anchor]


@cache
def letters() -> Type:
    """Return the letters that all pictures of this process share: they only save time."""
    return Type()


# Words that move: set once in a halo, and put down to a quarter of a pixel, so that they glide.

"""Words are set this many times larger and averaged; they are placed to this fraction of a pixel."""
_RING = directions(np.linspace(0, 2 * np.pi, 24, endpoint=False))
"""Where a halo reaches from every point of a letter."""


class Lettering:
    """One line of text in a halo of another colour, drawn about its middle."""

    def __init__(self, text: str, kind: Type, size: int, colours: tuple[Colour, Colour], halo: float) -> None:
        ink, back = colours
        self.ink, self.halo = ink, (back, halo)
        self._cover, above = _letters(text, kind, size)
        high, wide = self._cover.shape
        self.drop = (above + high / 2) / _FINE
        """How far the middle lies below the line's top."""
        self._drawn: dict[tuple[int, int], pygame.Surface] = {}
        around = 2 * (round(_FINE * halo) + 1)
        self.size: tuple[float, float] = ((wide + around) / _FINE, (high + around) / _FINE)

    @cached_property
    def _parts(self) -> NDArray[np.float32]:
        """The words in their halo, worked out when first drawn: many are measured but find no room."""
        return _haloed(self._cover, round(_FINE * self.halo[1]), (self.ink, self.halo[0]))

    def draw(self, surface: pygame.Surface, middle: complex, *, whole: bool = False) -> None:
        """Draw the words about a place in pixels.

        With `whole` they begin at a whole pixel, which is faster where many places are new.
        """
        if not self._meets(surface.get_size(), middle):
            return
        wide, high = (_FINE * side for side in self.size)
        step = _FINE if whole else 1
        x = step * round((_FINE * middle.real - wide / 2) / step)
        y = step * round((_FINE * middle.imag - high / 2) / step)
        sprite = self._sprite(x % _FINE, y % _FINE)
        surface.blit(sprite, (x // _FINE, y // _FINE))

    def _meets(self, size: tuple[int, int], middle: complex) -> bool:
        """Return whether words about a place lie at least partly on a surface of that size, to a pixel."""
        (wide, high), (x, y) = self.size, (middle.real, middle.imag)
        return -1 - wide / 2 < x < size[0] + 1 + wide / 2 and -1 - high / 2 < y < size[1] + 1 + high / 2

    def _sprite(self, right: int, down: int) -> pygame.Surface:
        """Return the words shifted right and down by so many fractions of a pixel."""
        if (right, down) not in self._drawn:
            wide, high = self.size
            size = ceil(wide + right / _FINE), ceil(high + down / _FINE)
            self._drawn[right, down] = _averaged_down(self._parts, (right, down), size)
        return self._drawn[right, down]


def _letters(text: str, kind: Type, size: int) -> tuple[NDArray[np.uint8], int]:
    """Return the coverage of an enlarged line of text (height, width), 0 to 255, without empty rows.

    The second value is the number of rows left out above it.
    """
    large = _FINE * size
    sheet = offscreen((kind.width(text, large, strong=True) + _FINE, 2 * large), alpha=True)
    kind.draw(sheet, text, (_FINE // 2, large // 2), size=large, colour=(255, 255, 255), strong=True)
    cover = np.frombuffer(pixel_view(sheet), np.uint8)[3::4].reshape(2 * large, -1)
    rows = np.flatnonzero(cover.any(axis=1))
    first, last = (int(rows[0]), int(rows[-1])) if rows.size else (0, 0)
    return cover[first : last + 1].copy(), first - large // 2


def _haloed(cover: NDArray[np.uint8], halo: int, colours: tuple[Colour, Colour]) -> NDArray[np.float32]:
    """Return letters in ink on a halo: colours times opacity, and opacity, 0 to 1, with a clear margin.

    The axes are row and column within a pixel, channel, and pixel: (`_FINE`, `_FINE`, 4, height, width). So
    an average is taken over whole arrays, however far the line is shifted.
    """
    begin, (high, wide) = _FINE + halo + 1, cover.shape
    room = tuple(-(-(side + 2 * begin + _FINE) // _FINE) * _FINE for side in cover.shape)
    letters = np.zeros(room, np.uint8)
    letters[begin : begin + high, begin : begin + wide] = cover
    around = letters.copy()
    # the clear margin lets all rows be shifted at once, as they lie in memory
    first, end = begin * room[1], (begin + high) * room[1]
    inked, flat = letters.ravel()[first:end], around.ravel()
    ring = np.rint(halo * _RING)
    for aside in (ring.imag * room[1] + ring.real).astype(int).tolist():
        under = flat[first + aside : end + aside]
        np.maximum(under, inked, out=under)
    share, opacity = (
        levels.reshape(-1, _FINE, room[1] // _FINE, _FINE).transpose(1, 3, 0, 2).astype(np.float32, order="C")
        / 255
        for levels in (letters, around)
    )
    rest = opacity - share
    parts = np.empty((_FINE, _FINE, 4, *share.shape[2:]), np.float32)
    for n, (ink, back) in enumerate(zip(*colours, strict=True)):
        mixed = np.multiply(share, np.float32(ink / 255), out=parts[:, :, n])
        mixed += rest * np.float32(back / 255)
    parts[:, :, 3] = opacity
    return parts


def _averaged_down(
    parts: NDArray[np.float32], shift: tuple[int, int], size: tuple[int, int]
) -> pygame.Surface:
    """Return a line in pixels, shifted right and down by fractions of a pixel."""
    (right, down), (width, height) = shift, size
    small = np.zeros((4, height, width), np.float32)
    for row, column in product(range(_FINE), repeat=2):
        top, left = (_FINE + row - down) // _FINE, (_FINE + column - right) // _FINE
        part = parts[(row - down) % _FINE, (column - right) % _FINE]
        small += part[:, top : top + height, left : left + width]
    small /= _FINE**2
    small[:3] /= np.maximum(small[3], 1e-6)
    levels = (255 * small + 0.5).astype(np.uint8)
    # in the order of a surface's bytes, which blits many times faster
    return pygame.image.frombuffer(levels[[2, 1, 0, 3]].transpose(1, 2, 0).tobytes(), size, "BGRA")
