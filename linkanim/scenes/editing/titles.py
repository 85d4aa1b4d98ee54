"""Titles beside classes: what of a class a title says, and the title of a scene whose class changes."""

from __future__ import annotations

import re
from dataclasses import replace
from difflib import Match, SequenceMatcher

from linkanim.scenes.scene import Scene

_BOUND = frozenset({"a", "an", "and", "at", "by", "its", "of", "the", "with"})
"""Words that need what comes before them."""


def beyond_title(title: str, class_name: str) -> str:
    """Return what of a class the title does not say: "Grashof" of a crank-rocker that is called one."""
    if set(_words(class_name)) <= set(_words(title)):
        return ""
    same, words = _shared(title, class_name), list(re.finditer(r"\w+", class_name))
    if same is None:
        return class_name
    begin, end = words[same.b].start(), words[same.b + same.size - 1].end()
    rest = f"{class_name[:begin].rstrip()} {class_name[end:].lstrip(' ,:')}".strip()
    if rest.partition(" ")[0] in _BOUND:
        return class_name
    return rest[1:-1] if rest.startswith("(") and rest.endswith(")") else rest


def retitled(before: Scene, after: Scene) -> Scene:
    """Return a scene changed from another under the title that fits it.

    A title that says the class is its own as long as it does: else the class stands in its place. Any other
    title stays.
    """
    title, phrase = before.original_title or (before.title, _phrase(before.title, before.info.class_name))
    if not phrase:
        return after
    class_name = after.info.class_name
    if f" {phrase} " not in f" {' '.join(_words(class_name))} ":
        own, title = title, _capital(class_name)
        after = replace(after, original_title=(own, phrase))
    document = {**after.document, "title": title} if "title" in after.document else after.document
    return replace(after, title=title, document=document)


def under_class(scene: Scene) -> Scene:
    """Return a scene with its class as its title, in its document too."""
    title = _capital(scene.info.class_name)
    return replace(scene, title=title, document={**scene.document, "title": title})


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


def _phrase(title: str, class_name: str) -> str:
    """Return the words of a class in a row that a title says."""
    same = _shared(title, class_name)
    return " ".join(_words(class_name)[same.b : same.b + same.size]) if same else ""


def _shared(title: str, class_name: str) -> Match | None:
    """Return the most words in a row that title and class have in common; None where they are no phrase."""
    known, words = _words(title), list(re.finditer(r"\w+", class_name.lower()))
    named = [word[0] for word in words]
    same = SequenceMatcher(None, known, named, autojunk=False).find_longest_match()
    # A word, or words from a preposition on, out of a phrase leave no phrase.
    if not same.size or (same.b and (same.size == 1 or named[same.b] in _BOUND)):
        return None
    begin, end = words[same.b].start(), words[same.b + same.size - 1].end()
    return None if "-" in (class_name[begin - 1 : begin], class_name[end : end + 1]) else same


def _words(text: str) -> list[str]:
    return re.findall(r"\w+", text.lower())
