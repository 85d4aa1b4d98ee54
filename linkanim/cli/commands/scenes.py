"""`linkanim scenes`: the catalogue by chapters, a line for each scene."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Mapping

from linkanim.errors import BadInput
from linkanim.intake import meant
from linkanim.scenes import chapters, load, names, titles
from linkanim.units import shown


def run(options: Namespace) -> None:
    """Print each built-in scene's name and title under its chapter, or only those that have a word.

    Only titles are read; for a word the scenes are solved, as their classes are then needed.
    """
    titles, width = _matching(options.word), max(map(len, names()))
    for chapter, members in chapters().items():
        lines = [f"{name:<{width}}  {titles[name]}" for name in members if name in titles]
        print("".join(f"{line}\n" for line in (f"# {chapter}", *lines) if lines), end="")


def _matching(word: str | None) -> Mapping[str, str]:
    """Return titles by name of scenes whose name, title, chapter or class has the word; all without one."""
    every = titles()
    if word is None:
        return every
    chapter = {name: chapter for chapter, members in chapters().items() for name in members}
    sought = word.casefold()

    def has_it(name: str) -> bool:
        texts = (name, every[name], chapter[name], load(name).info.class_name)
        return any(sought in text.casefold() for text in texts)

    matching = {name: title for name, title in every.items() if has_it(name)}
    if not matching:
        near = meant(word, (*every, *chapters()))
        raise BadInput(f"no scene's title, class or chapter has {shown(word)} in it{near}")
    return matching
