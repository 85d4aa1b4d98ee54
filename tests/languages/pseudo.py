"""A language made up for tests: each letter of a sentence is another, so what is not said stays plain."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from gettext import NullTranslations
from html import unescape

import pytest
from catalogue import TRANSLATED, first, has_words, read

from linkanim import words
from linkanim.words import speaking

NAME = "qps"
_LETTERS = str.maketrans(
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ",
    "áƀćđéƒǵĥíĵķĺḿńóṕqŕśťúṽẃẋýźÁɃĆĐÉƑǴĤÍĴĶĹḾŃÓṔQŔŚŤÚṼẂẊÝŹ",
)
_PART = re.compile(r"(\{[^}]*\})")
_PLAIN = re.compile(r"[A-Za-z]{3,}")
_UNSEEN = re.compile(r"<(style|script|math|svg)\b.*?</\1>|<[^>]*>", re.DOTALL)


def longer(message: str) -> str:
    """Return a message in other letters, two fifths longer, with its places where they were."""
    parts = _PART.split(message)
    written = "".join(one if n % 2 else one.translate(_LETTERS) for n, one in enumerate(parts))
    return written + "ẃ" * (2 * len(message) // 5) if len(message) > 3 else written


class _Pseudo(NullTranslations):
    def __init__(self) -> None:
        super().__init__()
        self.asked: set[tuple[str | None, str]] = set()

    def gettext(self, message: str) -> str:
        return self.pgettext(None, message)

    def pgettext(self, context: str | None, message: str) -> str:
        self.asked.add((context, message))
        return longer(message)

    def ngettext(self, one: str, many: str, n: int) -> str:
        self.asked.add((None, one))
        return longer(one if n == 1 else many)


@cache
def _known() -> set[tuple[str | None, str]]:
    """Return what a catalogue has, which is what the code says: see `test_words`."""
    return {(message.context, first(message.id)) for message in read(TRANSLATED[0])}


@contextmanager
def spoken_pseudo(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Speak the language while the block runs; what is said then is in the catalogue, names aside."""
    spoken = _Pseudo()
    with monkeypatch.context() as patch:
        others = words._catalogue
        patch.setattr(words, "_catalogue", lambda language: spoken if language == NAME else others(language))
        with speaking(NAME):
            yield
    unknown = {message for context, message in spoken.asked - _known() if context != "name"}
    lacking = sorted(one for one in unknown if has_words(one))
    assert lacking == [], lacking


def plain_words(text: str, known: frozenset[str] = frozenset()) -> set[str]:
    """Return the words of a text that no catalogue gave; `known` are such as need none: units, names."""
    return set(_PLAIN.findall(text)) - known


def visible(page: str) -> str:
    """Return the words of a page of HTML: without its styles, scripts, formulas and figures."""
    return unescape(_UNSEEN.sub(" ", page))
