"""Words in the reader's language: what the code says is English, another language is looked up.

`said` is the one door: it takes a sentence of the code, with a place in braces for each part, and returns it
in the language that is spoken. A sentence that stands in a table is marked by `to_say`, and said where it is
shown. The catalogues lie in `languages`: a `.po` file for translators, and the `.mo` that is made of it.

The language is set by `speaking`, once by a command, and in the window by what its state shows. So what
keeps words has to keep the language with them: `kept_as_said` does.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache, lru_cache, reduce, wraps
from gettext import GNUTranslations, NullTranslations
from pathlib import Path
from typing import Any, Generic, ParamSpec, TypeVar

ENGLISH = "en"
LANGUAGES: dict[str, str] = {ENGLISH: "English", "zh_TW": "繁體中文", "zh_CN": "简体中文"}
"""The languages, each by its own name."""
FOLDER = Path(__file__).parent / "languages"
"""Where catalogues lie: `zh_TW/LC_MESSAGES/linkanim.po` and `.mo`."""
_IN_HTML = {"zh_TW": "zh-Hant", "zh_CN": "zh-Hans"}
_TRADITIONAL = ("tw", "hk", "mo", "hant")
_SPOKEN: ContextVar[str] = ContextVar("language", default=ENGLISH)

Given = ParamSpec("Given")
Found = TypeVar("Found")


def said(message: str, /, **parts: object) -> str:
    """Return a sentence in the language that is spoken, with its parts in their places."""
    found = _catalogue(_SPOKEN.get()).gettext(message) if message else ""
    return found.format(**parts) if parts else found


def said_as(context: str, message: str, /, **parts: object) -> str:
    """Return what `said` does, for a word that means several things in English: the context says which."""
    found = _catalogue(_SPOKEN.get()).pgettext(context, message)
    return found.format(**parts) if parts else found


def said_many(one: str, many: str, count: int, /, **parts: object) -> str:
    """Return a sentence for a count, which may stand in it as `{count}`."""
    return _catalogue(_SPOKEN.get()).ngettext(one, many, count).format(count=count, **parts)


def to_say(message: str) -> str:
    """Return a sentence as it is: so those in tables are marked, which are said where they are shown."""
    return message


def name_said(name: str) -> str:
    """Return the name of a link or joint: in the language where it is a term, such as crank; else itself."""
    return said_as("name", name)


def row_said(words: Sequence[str]) -> str:
    """Return words in a row, as in "a, b and c"; "" for none."""
    if len(words) < 2:
        return "".join(words)
    most, last = said_as("list", ", ").join(words[:-1]), words[-1]
    return said("{most} and {last}", most=most, last=last)


def sentences(*whole: str) -> str:
    """Return whole sentences after one another, without the empty ones."""
    first, *others = [*filter(None, whole)] or [""]
    return reduce(
        lambda one, other: said_as("sentences", "{one} {other}", one=one, other=other), others, first
    )


def html_language() -> str:
    """Return the language as a page of HTML has it: "en", "zh-Hant"."""
    return _IN_HTML.get(spoken(), spoken())


def spoken() -> str:
    """Return the language that is spoken."""
    return _SPOKEN.get()


@contextmanager
def speaking(language: str | None) -> Iterator[None]:
    """Speak a language, such as "zh_TW", while the block runs; None for the one that is spoken."""
    before = _SPOKEN.set(language or _SPOKEN.get())
    try:
        yield
    finally:
        _SPOKEN.reset(before)


def kept_as_said(most: int) -> Callable[[Callable[Given, Found]], Callable[Given, Found]]:
    """Return a decorator: the last `most` results of a function are kept, each with its language."""

    def keeping(work: Callable[Given, Found]) -> Callable[Given, Found]:
        @lru_cache(maxsize=most)
        def found(_: str, *given: Given.args, **further: Given.kwargs) -> Found:
            return work(*given, **further)

        @wraps(work)
        def keeper(*given: Given.args, **further: Given.kwargs) -> Found:
            return found(_SPOKEN.get(), *given, **further)  # type: ignore[arg-type]

        return keeper

    return keeping


class cached_as_said(Generic[Found]):  # noqa: N801 -- as cached_property
    """A property that is worked out once for each language in which it is read."""

    def __init__(self, work: Callable[[Any], Found]) -> None:
        self.work, self.__doc__ = work, work.__doc__

    def __get__(self, owner: object, _: object = None) -> Found:
        known: dict[str, Found] = owner.__dict__.setdefault(f"{self.work.__name__} as said", {})
        if spoken() not in known:
            known[spoken()] = self.work(owner)
        return known[spoken()]


def language_of(environment: Mapping[str, str] = os.environ) -> str:
    """Return the first language that an environment asks for and that is here; English where none is.

    It is asked for as gettext has it: LANGUAGE, LC_ALL, LC_MESSAGES, LANG, several with colons between.
    """
    asked = (environment.get(name, "") for name in ("LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"))
    first = next(filter(None, asked), "")
    return next(filter(None, map(language_named, first.split(":"))), ENGLISH)


def language_named(name: str) -> str | None:
    """Return the language that is named as zh_TW, zh-Hant-HK or zh_CN.UTF-8; None where it is not here."""
    first, *others = name.partition(".")[0].partition("@")[0].replace("-", "_").lower().split("_")
    if first == "zh":
        return "zh_TW" if any(part in _TRADITIONAL for part in others) else "zh_CN"
    return ENGLISH if first in ("en", "c", "posix") else None


@cache
def _catalogue(language: str) -> NullTranslations:
    if language == ENGLISH:
        return NullTranslations()
    with (FOLDER / language / "LC_MESSAGES" / "linkanim.mo").open("rb") as file:
        return GNUTranslations(file)
