"""Read a scene file's text into a document with line numbers, and write a scene as such text.

Its parts, in reading order:

- A scene file's text to the document in it; imports nothing that knows a linkage.
- The line of a TOML text at which each key stands.
- A scene back to TOML: text that reads to the same linkage, saved beside what is there, never over it.
"""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from itertools import count
from pathlib import Path
from typing import Any

from linkanim import atomic_files
from linkanim.errors import SceneError
from linkanim.intake import Intake, Section, refuse_controls
from linkanim.scenes.scene import Scene

# A scene file's text to the document in it; imports nothing that knows a linkage.

SCENE_FILE = Intake("a scene file", most_bytes=1_000_000, most_values=50_000, refusal=SceneError)


class _Document(Section):
    """A scene file's whole text, before it is known what it describes."""

    refusal = SceneError


def parse(text: str, where: str) -> dict[str, Any]:
    """Return the document in a scene file's text; SceneError with the line where it is not TOML."""
    SCENE_FILE.refuse_heavy(text, where)
    try:
        document = tomllib.loads(text)
    except ValueError as error:
        raise SceneError(f"{where}: is not TOML: {error}") from None
    refuse_controls(_Document(where, document))
    return document


# The line of a TOML text at which each key stands.

Keys = tuple[str, ...]

_PATIENCE = 500_000
"""The most characters that are parsed: a list of lists over very many lines is parsed anew for each line."""
_IDLE = r"\s*(#.*)?\s*"
_ENDS = r"[\]}]|\"{3}|'{3}"
"""What the last line of a statement over several lines contains."""


def line_numbers(text: str) -> dict[Keys, int]:
    """Return the line (from 1) of every table and key of a TOML text; of the first ones in a long text."""
    numbers: dict[Keys, int] = {}
    table: Keys = ()
    for at, statement, document in _statements(text):
        if statement.lstrip().startswith("["):
            table = _keys_of(document)
            numbers.setdefault(table, at)
        else:
            for keys in _keys(document):
                numbers.setdefault((*table, *keys), at)
    return numbers


def _statements(text: str) -> Iterator[tuple[int, str, Any]]:
    """Yield each statement's first line, its text and the document in it, up to `_PATIENCE` characters."""
    begun, lines, seen = 1, list[str](), 0
    for number, line in enumerate(text.splitlines(keepends=True), 1):
        begun = begun if lines else number
        if not lines and re.fullmatch(_IDLE, line):
            continue
        lines.append(line)
        if begun < number and not re.search(_ENDS, line):
            continue
        statement = "".join(lines)
        seen += len(statement)
        if seen > _PATIENCE:
            return
        try:
            document = tomllib.loads(statement)
        except ValueError:  # the statement continues in the next line
            continue
        yield begun, statement, document
        lines = []


def _keys_of(document: Any) -> Keys:
    """Return the keys of a header, [a.b] or [[a.b]]."""
    keys: list[str] = []
    while document:
        document = document[0] if isinstance(document, list) else document
        if not document:
            break
        ((key, document),) = document.items()
        keys.append(key)
    return tuple(keys)


def _keys(document: dict[str, Any]) -> list[Keys]:
    """Return the keys in a statement, those of the tables in it too."""
    read: list[Keys] = []
    for key, value in document.items():
        read.append((key,))
        if isinstance(value, dict):
            read += [(key, *keys) for keys in _keys(value)]
    return read


# A scene back to TOML: text that reads to the same linkage, saved beside what is there, never over it.

_SECTIONED = ("joints", "springs", "dampers", "loads")
"""The tables in which every table gets a header of its own, as [joints.A]."""
_MARK = "\x01"
_INLINE = r'"\\u0001(\d+)"'
_LIST = r"(?m) = \[\n((?:    [^\[\]].*,\n)+)\]$"
_INNER_LIST = r"(?m)^    \[\n((?:        .*,\n)+)    \],$"


def text(scene: Scene) -> str:
    """Return the scene as the text of a scene file, which reads back to the same linkage.

    Numbers keep every digit and quantities the unit they were written with; comments are not kept.
    SceneError for a scene that was made without a document.
    """
    if not scene.document:
        raise SceneError(f"{scene.name}: has no scene file behind it that could be written; load it from one")
    inline: list[str] = []
    document = {key: _section(key, value, inline) for key, value in scene.document.items()}
    return re.sub(_INLINE, lambda match: inline[int(match[1])], _lines(document))


def save(scene: Scene, folder: Path) -> Path:
    """Write the scene into `folder` under a name that is free, and return the file's path.

    The name is the scene's, or that with -2, -3, ...: an older file stays as it is. A photograph is named by
    its path from there. WorkFailed, with nothing left behind, where the folder cannot be written.
    """
    numbered = (folder / f"{scene.name}-{number}.toml" for number in count(2))
    return atomic_files.add(content(scene, folder), folder / f"{scene.name}.toml", numbered)


def content(scene: Scene, folder: Path) -> bytes:
    """Return the bytes of a scene file in `folder`; a photograph is named by its path from there."""
    return text(_photographed(scene, folder)).encode("utf-8")


def _photographed(scene: Scene, folder: Path) -> Scene:
    """Return the scene with its photograph's path from a folder, where there is one."""
    photo = scene.document.get("photo")
    if photo is None:
        return scene
    path = Path(photo["file"])
    with suppress(ValueError, OSError):  # it is on another drive, or the current folder is gone
        path = Path(os.path.relpath(path, folder))
    return replace(scene, document={**scene.document, "photo": photo | {"file": path.as_posix()}})


def _section(key: str, value: Any, inline: list[str]) -> Any:
    """Return a table in which each inner table is a mark: its text on one line is appended to `inline`."""
    if not isinstance(value, Mapping):
        return value
    return {
        name: _section("", entry, inline) if key in _SECTIONED else _marked(entry, inline)
        for name, entry in value.items()
    }


def _marked(value: Any, inline: list[str]) -> Any:
    if not isinstance(value, Mapping):
        return value
    inline.append(_on_a_line(value))
    return f"{_MARK}{len(inline) - 1}"


def _on_a_line(table: Mapping[str, Any]) -> str:
    """Return a table as people write a short one: { through = "O2", angle = "90 deg" }."""
    parts = (
        f"{_lines({key: 0}).partition(' = ')[0]} = {_on_a_line(value)}"
        if isinstance(value, Mapping)
        else _lines({key: value}).strip()
        for key, value in table.items()
    )
    return f"{{ {', '.join(parts)} }}"


def _lines(document: Mapping[str, Any]) -> str:
    import tomli_w

    outer = re.sub(_LIST, lambda match: f" = {_on_one_line(match)}", tomli_w.dumps(document))
    return re.sub(_INNER_LIST, lambda match: f"    {_on_one_line(match)},", outer)


def _on_one_line(match: re.Match[str]) -> str:
    """Return a list as people write it, [283, 165], rather than an item a line."""
    items = (line.strip().removesuffix(",") for line in match[1].splitlines())
    return f"[{', '.join(items)}]"
