"""Letters that a font lacks: what is set for each of them, and the sentence that names them.

A font is given by what it has, as a function of a character: those of pictures are in `picture.text`, LaTeX's
in `explain.formula`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple
from unicodedata import combining, normalize

Has = Callable[[str], bool]
"""Whether a font has a character."""
STAND_IN = "?"
"""What is set for a letter that a font lacks, so that its place is seen."""
_MOST_NAMED = 12


def spelt(char: str, has: Has) -> str:
    """Return what is set for a character: itself, or the parts of it that the font has: Ǆ as DŽ, ﬁ as fi.

    A mark without its letter, and what is not seen, are left out; for any other there is the stand-in.
    """
    if has(char):
        return char
    if char.isspace():
        return " "
    if not char.isprintable() or combining(char):
        return ""
    return "".join(part for part in normalize("NFKC", char) if part.isprintable() and has(part)) or STAND_IN


def spelt_out(text: str, has: Has) -> str:
    """Return what is set for a text."""
    return "".join(spelt(char, has) for char in text)


def lacking(text: str, has: Has) -> str:
    """Return the characters for which the stand-in is set, each once."""
    known = dict.fromkeys(normalize("NFC", text))
    return "".join(char for char in known if char != STAND_IN and spelt(char, has) == STAND_IN)


class Setting(NamedTuple):
    """What sets words: how a sentence on letters that it lacks begins, what comes of them, the way out."""

    lacks: str
    way_out: str
    instead: str = f"{STAND_IN} stands for them: "

    def sentence(self, letters: str) -> str:
        """Return the sentence that names lacking letters, and the way out; "" where there are none."""
        if not letters:
            return ""
        named, more = ", ".join(letters[:_MOST_NAMED]), len(letters) - _MOST_NAMED
        those = f"{named} and {more} more" if more > 0 else named
        return f"{self.lacks} the letters {those}; {self.instead}{self.way_out}"


PIXELS = Setting("no font of this system has", "install one that has them, such as Noto Sans")
UNJOINED = Setting("plain pygame does not join", "install pygame-ce in its place")
PDF = Setting("a PDF does not join", "write an SVG or a PNG")
CUT_OUT = Setting(PDF.lacks, "take --way laser")
LATEX = Setting(
    "LaTeX's standard fonts lack",
    "run xelatex or lualatex, with the package ctex for Chinese, Japanese or Korean, and fontspec for others",
    "they are kept: ",
)
