"""A scene back to TOML: text that reads to the same linkage, saved beside what is there, never over it."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from itertools import count
from pathlib import Path
from typing import Any

from linkanim import atomic_files
from linkanim.errors import SceneError
from linkanim.scenes.scene import Scene

_SECTIONED = ("joints", "springs", "dampers")
"""The tables of whose tables each has a head of its own."""
_MARK = "\x01"
_INLINE = re.compile(r'"\\u0001(\d+)"')
_LIST = re.compile(r" = \[\n((?:    [^\[\]].*,\n)+)\]$", re.MULTILINE)
_INNER_LIST = re.compile(r"^    \[\n((?:        .*,\n)+)    \],$", re.MULTILINE)


def text(scene: Scene) -> str:
    """Return the scene as the text of a scene file, which reads back to the same linkage.

    Numbers keep every digit and quantities the unit they were written with; comments are not kept.
    SceneError for a scene that was made without a document.
    """
    if not scene.document:
        raise SceneError(f"{scene.name}: has no scene file behind it that could be written; load it from one")
    inline: list[str] = []
    document = {key: _section(key, value, inline) for key, value in scene.document.items()}
    return _INLINE.sub(lambda found: inline[int(found[1])], _lines(document))


def save(scene: Scene, folder: Path) -> Path:
    """Write the scene into `folder` under a name that is free, and return the file's path.

    The name is the scene's, or that with -2, -3, ...: an older file stays as it is. A photograph is named by
    its path from there. WorkFailed, with nothing left behind, where the folder cannot be written.
    """
    scene = _photographed(scene, folder)
    numbered = (folder / f"{scene.name}-{number}.toml" for number in count(2))
    return atomic_files.add(text(scene).encode("utf-8"), folder / f"{scene.name}.toml", numbered)


def _photographed(scene: Scene, folder: Path) -> Scene:
    """Return the scene with its photograph's path from a folder, where there is one."""
    photo = scene.document.get("photo")
    if photo is None:
        return scene
    path = Path(photo["file"])
    with suppress(ValueError, OSError):  # of another drive, or the current folder is gone
        path = Path(os.path.relpath(path, folder))
    return replace(scene, document={**scene.document, "photo": photo | {"file": path.as_posix()}})


def _section(key: str, value: Any, inline: list[str]) -> Any:
    """Return a table with the tables in it on a line each, as marks that tell which one of `inline` it is."""
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

    outer = _LIST.sub(lambda found: f" = {_on_one_line(found)}", tomli_w.dumps(document))
    return _INNER_LIST.sub(lambda found: f"    {_on_one_line(found)},", outer)


def _on_one_line(found: re.Match[str]) -> str:
    """Return a list as people write it, [283, 165], rather than an item a line."""
    items = (line.strip().removesuffix(",") for line in found[1].splitlines())
    return f"[{', '.join(items)}]"
