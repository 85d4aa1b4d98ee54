"""Where scenes come from: the catalogue inside the package, and files of the user's own."""

from __future__ import annotations

import os
import stat
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path

from linkanim.document import meant
from linkanim.errors import BadInput, SceneError
from linkanim.scenes.read import parse, scene_from
from linkanim.scenes.scene import Scene
from linkanim.units import shown

_CHAPTERS: Mapping[str, tuple[str, ...]] = {
    "four-bars": ("crank-rocker", "drag-link", "rocker-driven"),
    "sliders": ("slider-crank",),
    "six-bars and more": ("six-bar", "press"),
    "hard on purpose": (
        "parallelogram",
        "antiparallelogram",
        "kite",
        "double-rocker",
        "triple-rocker",
        "triple-rocker-in-in",
        "triple-rocker-out-in",
        "triple-rocker-in-out",
    ),
}
_LARGEST = 1_000_000


def chapters() -> dict[str, tuple[str, ...]]:
    """Return the names of the catalogue's scenes by chapter, both in the order in which they are shown.

    A chapter's name is what is shown of it, too ("exact and scaling"). Every scene is in one chapter;
    `names()` is all of them one after the other. The keys 1-9 choose within the chapter of the scene that
    is on: `chapters()[chapter_of(name)][digit - 1]`. Reads no file.
    """
    return dict(_CHAPTERS)


def chapter_of(name: str) -> str | None:
    """Return the chapter of a catalogue scene; None for any other name."""
    return next((chapter for chapter, names in _CHAPTERS.items() if name in names), None)


def names() -> tuple[str, ...]:
    """Return the names of the catalogue's scenes in the order in which they are shown, chapter by chapter."""
    return tuple(name for names in _CHAPTERS.values() for name in names)


def titles() -> dict[str, str]:
    """Return each catalogue scene's title by its name, without checking the linkage in it."""
    return {name: str(parse(_catalogue_text(name), name)["title"]) for name in names()}


def load(name_or_path: str | os.PathLike[str]) -> Scene:
    """Return the scene of that name in the catalogue, or read it from a file.

    A path is anything with a folder in it or the suffix .toml. BadInput for an unknown name, SceneError
    for a file that is not a scene, AssemblyError for lengths that cannot be assembled.
    """
    asked = os.fspath(name_or_path)
    if isinstance(name_or_path, str) and not _is_path(asked):
        if chapter_of(asked) is None:
            near = meant(asked, names())
            raise BadInput(f"no scene is called {shown(asked)}{near}; `linkanim scenes` lists them")
        return scene_from(parse(_catalogue_text(asked), asked), name=asked, where=asked)
    where = "".join(c if c.isprintable() else "?" for c in asked)
    return scene_from(parse(_file_text(asked, where), where), name=Path(asked).stem, where=where)


def _is_path(asked: str) -> bool:
    return asked.lower().endswith(".toml") or any(mark in asked for mark in (os.sep, os.altsep or os.sep))


def _catalogue_text(name: str) -> str:
    folder = (chapter_of(name) or "").replace(" ", "-")
    return (files("linkanim.scenes") / "catalogue" / folder / f"{name}.toml").read_text(encoding="utf-8")


def _file_text(path: str, where: str) -> str:
    """Return a scene file's text; SceneError for what cannot be one."""
    try:
        mode = Path(path).stat().st_mode
        if stat.S_ISDIR(mode):
            raise SceneError(f"{where}: is a folder; name a .toml file in it")
        if not stat.S_ISREG(mode):
            raise SceneError(f"{where}: is not a file with text in it; name a .toml file")
        with Path(path).open("rb") as file:
            data = file.read(_LARGEST + 1)
    except FileNotFoundError:
        near = meant(Path(path).stem, names())
        raise SceneError(f"{where}: no such file{near}; `linkanim scenes` lists the built-in ones") from None
    except (OSError, ValueError) as error:
        reason = (error.strerror or "") if isinstance(error, OSError) else str(error)
        raise SceneError(f"{where}: cannot be read: {reason.lower() or 'the system refuses'}") from None
    if len(data) > _LARGEST:
        raise SceneError(f"{where}: is larger than 1 MB; a scene file is a few lines of text")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise SceneError(f"{where}: is not UTF-8 text (line {line}); save it as UTF-8") from None
