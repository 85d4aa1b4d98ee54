"""Bring the catalogues of all languages in step with the sentences of the code.

`python tests/languages/catalogue.py` reads the sentences with Babel, and writes each `.po` anew, with what it
had for them, and the `.mo` beside it. Named after it are JSON files of translations that are filled in:
`{"a sentence": ["in Traditional Chinese", "in Simplified Chinese"]}`; a context stands before the sentence,
with "\\u0004" between.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterable, Iterator
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import NamedTuple

from babel.messages import Catalog
from babel.messages.extract import extract_from_dir
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

import linkanim
from linkanim.scenes.form import Field, Form, Named
from linkanim.words import ENGLISH, FOLDER, LANGUAGES

TRANSLATED = tuple(language for language in LANGUAGES if language != ENGLISH)
_KEYWORDS = {"said": None, "to_say": None, "said_as": ((1, "c"), 2), "said_many": (1, 2)}
_WRITTEN = datetime(2026, 1, 1, tzinfo=UTC)


class Sentence(NamedTuple):
    """A sentence of the code: its context, in one and in many where it is counted, and where it stands."""

    context: str | None
    one: str
    many: str | None
    where: str

    @property
    def key(self) -> tuple[str | None, str]:
        """What a catalogue has it under."""
        return self.context, self.one


@cache
def sentences() -> dict[tuple[str | None, str], Sentence]:
    """Return every sentence that is said, by what a catalogue has it under."""
    found = {one.key: one for one in _of_tables() if one.one}
    return found | {one.key: one for one in _of_code()}


def _of_code() -> Iterator[Sentence]:
    root = Path(linkanim.__file__).parent
    files = extract_from_dir(root, method_map=[("**.py", "python")], keywords=_KEYWORDS)
    for file, line, message, _, context in files:
        one, many = message if isinstance(message, tuple) else (message, None)
        yield Sentence(context, one, many, f"{file}:{line}")


def _of_tables() -> Iterator[Sentence]:
    """Yield the sentences of tables, which are said where they are shown."""
    from linkanim.picture.look import TOGGLES
    from linkanim.play.kinds import KINDS
    from linkanim.play.match import level_names, level_of
    from linkanim.play.menus import DOORS, OFFERS
    from linkanim.scenes import file_form
    from linkanim.scenes.form import Field
    from linkanim.share.page import packaged, page_words, script_words

    for name, toggle in TOGGLES.items():
        for words in (toggle.title, *toggle.answers):
            yield Sentence(None, words, None, f"TOGGLES[{name!r}]")
    yield from (Sentence("game", text, None, "DOORS") for text, _ in (*DOORS.values(), *OFFERS.values()))
    yield from (Sentence(None, kind, None, "KINDS") for kind in KINDS)
    for name in level_names():
        level = level_of(name)
        yield from (Sentence(None, words, None, f"level {name}") for words in (level.title, level.about))
    for one in _inside(vars(file_form).copy(), set()):
        if isinstance(one, Field) and one.label is not None:
            labels = (one.label,) if isinstance(one.label, str) else one.label
            # a field that holds no number is called by its key, and shown nowhere
            shown = (words for words in labels if words != one.key.replace("_", " ") or one.key in _NUMBERS)
            yield from (Sentence(None, words, None, f"field {one.key}") for words in shown)
    yield from (Sentence("name", name, None, "SHORTHANDS") for name in file_form.SHORTHANDS)
    for file in ("page.html", "index.html"):
        yield from (Sentence(None, words, None, f"share/{file}") for words in page_words(packaged(file)))
    for file in ("lengths.js", "page.js"):
        yield from (Sentence(None, words, None, f"share/{file}") for words in script_words(packaged(file)))
    yield from _of_the_window()
    for name in linkanim.names():
        scene = linkanim.load(name)
        for words in (scene.title, scene.look_at, scene.chapter):
            yield Sentence(None, words, None, f"scene {name}")
        struts = [one.name for one in scene.linkage.springs] + [one.name for one in scene.linkage.dampers]
        for words in (*scene.info.link_names.values(), *struts, *_USUAL):
            if _NAME.fullmatch(words):
                yield Sentence("name", words, None, f"scene {name}")


def _of_the_window() -> Iterator[Sentence]:
    """Yield the words of keys, commands and tools."""
    from linkanim.build.tools import TOOLS
    from linkanim.player.keys import GROUPS, KEYS
    from linkanim.player.modes import KEYS_OF
    from linkanim.scenes.file_form import SCENE_FILE

    for table in (KEYS, *(mode.table for mode in KEYS_OF.values())):
        for subject, rows in table.items():
            yield Sentence("subject", subject, None, f"keys: {subject}")
            for row in rows:
                yield Sentence(None, row.words, None, f"keys: {row.keys}")
                if has_words(row.keys):
                    yield Sentence(None, row.keys, None, f"keys: {row.keys}")
    for mode in KEYS_OF.values():
        for words, _, action in mode.commands:
            yield Sentence(None, words, None, f"command: {action.name}")
    for title, _ in GROUPS.values():
        yield Sentence(None, title.lower(), None, f"GROUPS: {title}")
    for tool in TOOLS:
        yield Sentence(None, tool.name, None, f"TOOLS: {tool.icon}")
        if tool.action == "tool":
            yield Sentence(None, str(tool.value), None, f"TOOLS: {tool.icon}")
    for words in _OF_A_SHEET:
        yield Sentence(None, words, None, "what a sheet shows")
    for field in _fields(SCENE_FILE):
        for label in (field.label,) if isinstance(field.label, str) else field.label:
            if re.search("[A-Za-z]{2}", re.sub(r"\{\w+\}", "", label)):
                yield Sentence(None, label, None, f"the dimension {field.key}")
        if field.key:
            yield Sentence(None, field.key.replace("_", " "), None, f"a property of a part: {field.key}")


def _fields(form: Form) -> Iterator[Field]:
    """Yield the fields of a form and of those within it."""
    for field in (*form.fields, *filter(None, [form.plain])):
        yield field
        within = field.type
        if isinstance(within, Form):
            yield from _fields(within)
        elif isinstance(within, Named):
            yield from filter(None, [within.plain])
            for one in within.forms:
                yield from _fields(one)


_OF_A_SHEET = (
    *("pin", "bar", "joint", "point", "guide", "slider", "slot", "yoke", "spring", "damper", "body", "drive"),
    *("along", "to the left", "mass along", "mass to the left", "link's name", "direction", "speed"),
    *("circuit", "branch", "order"),
)
"""Words of parts, of rows, and of defects."""


_KEY = re.compile("Space|Enter|Tab|Shift|Ctrl|Alt|Esc|PgUp|PgDn|Del")


def has_words(text: str) -> bool:
    """Tell whether a text has words beside the names of keys, which are those on the keyboard."""
    return re.search("[a-z]{2}", _KEY.sub("", text)) is not None


def _inside(value: object, seen: set[int]) -> Iterator[object]:
    """Yield a value of the scene file's form, and all that are in it."""
    if id(value) in seen:
        return
    seen.add(id(value))
    yield value
    parts: Iterable[object] = ()
    if isinstance(value, dict):
        parts = value.values()
    elif isinstance(value, (tuple, list)):
        parts = value
    elif type(value).__module__.startswith("linkanim.scenes"):
        parts = vars(value).values() if hasattr(value, "__dict__") else ()
    for part in parts:
        yield from _inside(part, seen)


_NUMBERS = ("mass", "stiffness")
_NAME = re.compile(r"[a-z]{3,}( [a-z]+)*\d?")
"""A name that is a word: no letter of a joint, no number."""
_USUAL = (
    *(f"{nth} {noun}" for nth in ("second", "third", "4th") for noun in ("coupler", "rocker", "crank")),
    *("second driven crank", "third driven crank", "second input rocker"),
    *("crank", "coupler", "rocker", "rod", "slider", "spring", "damper", "cylinder", "ground"),
    *(
        "upper",
        "lower",
        "left",
        "right",
        "large",
        "small",
        "short",
        "upright",
        "driven link",
        "input",
        "output",
    ),
)


def path_of(language: str, suffix: str) -> Path:
    """Return where the catalogue of a language lies, `.po` or `.mo`."""
    return FOLDER / language / "LC_MESSAGES" / f"linkanim{suffix}"


def read(language: str) -> Catalog:
    """Return the catalogue of a language as translators have it."""
    with path_of(language, ".po").open("rb") as file:
        return read_po(file, locale=language)


def in_step(language: str, old: Catalog, fill: dict[str, str]) -> Catalog:
    """Return a catalogue of exactly the sentences of the code, filled from what is known."""
    new = Catalog(
        language,
        project="linkanim",
        version=linkanim.__version__,
        creation_date=_WRITTEN,
        revision_date=_WRITTEN,
        fuzzy=False,
    )
    for context, one in sorted(sentences(), key=lambda key: (key[1], key[0] or "")):
        many = sentences()[context, one].many
        had = old.get(one, context)
        words = fill.get(f"{context}\4{one}" if context else one) or (first(had.string) if had else "")
        new.add((one, many) if many else one, (words,) if many else words, context=context)
    return new


def first(words: object) -> str:
    """Return the first form of a sentence that may have several; "" where there is none."""
    return words if isinstance(words, str) else str(words[0]) if isinstance(words, (tuple, list)) else ""


def write(catalogue: Catalog, language: str) -> None:
    """Write a catalogue: for translators, and for the program."""
    for suffix in (".po", ".mo"):
        path_of(language, suffix).parent.mkdir(parents=True, exist_ok=True)
        with path_of(language, suffix).open("wb") as file:
            if suffix == ".mo":
                write_mo(file, catalogue)
            else:
                write_po(file, catalogue, width=110, no_location=True)


def main(files: list[str]) -> None:
    """Write all catalogues anew, and say how much each of them lacks."""
    fill: dict[str, list[str]] = {}
    for file in files:
        fill |= json.loads(Path(file).read_text("utf-8"))
    for n, language in enumerate(TRANSLATED):
        old = read(language) if path_of(language, ".po").exists() else Catalog(language)
        new = in_step(language, old, {one: words[n] for one, words in fill.items() if words[n]})
        write(new, language)
        lacking = [message.id for message in new if not first(message.string)]
        print(f"{language}: {len(new)} sentences, {len(lacking)} without words")


if __name__ == "__main__":
    main(sys.argv[1:])
