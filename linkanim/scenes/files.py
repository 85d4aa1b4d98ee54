"""Where scenes come from: the catalogue inside the package, and files of the user's own."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

from linkanim import intake
from linkanim.errors import BadInput, LinkanimError, SceneError
from linkanim.intake import meant
from linkanim.scenes.file_form import POINTS_FORM
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import SCENE_FILE, parse
from linkanim.units import angle, angular_speed, shown


@cache
def chapters() -> Mapping[str, tuple[str, ...]]:
    """Return the names of the catalogue's scenes by chapter, both in the order in which they are shown.

    A chapter's name is what is shown of it, too ("exact and scaling"). Every scene is in one chapter;
    `names()` is all of them one after the other. The keys 1-9 choose within the chapter of the scene that
    is on: `chapters()[chapter_of(name)][digit - 1]`.
    """
    listed = parse(_text("chapters.toml"), "chapters.toml")
    return MappingProxyType({chapter: tuple(names) for chapter, names in listed.items()})


def chapter_of(name: str) -> str | None:
    """Return the chapter of a catalogue scene; None for any other name."""
    return next((chapter for chapter, names in chapters().items() if name in names), None)


def names() -> tuple[str, ...]:
    """Return the names of the catalogue's scenes in the order in which they are shown, chapter by chapter."""
    return tuple(name for names in chapters().values() for name in names)


@cache
def titles() -> Mapping[str, str]:
    """Return each catalogue scene's title by its name, without checking the linkage in it."""
    return MappingProxyType({name: title_of(name) for name in names()})


@cache
def title_of(name: str) -> str:
    """Return the title of a catalogue scene."""
    path = catalogued(name)
    assert path is not None
    return str(parse(path.read_text(encoding="utf-8"), name)["title"])


class PublishedTable(NamedTuple):
    """Values that a source prints for a scene at an angle and a speed (rad, rad/s), in SI units.

    `values` are those of each method, by the quantity's token.
    """

    source: str
    angle: float
    speed: float
    methods: tuple[str, ...]
    values: Mapping[str, tuple[float, ...]]


@cache
def published(name: str) -> tuple[PublishedTable, ...]:
    """Return the values that a source prints for a catalogue scene; none for any other name."""
    return tuple(
        PublishedTable(
            one["source"],
            angle(one["angle"]),
            angular_speed(one["speed"]),
            tuple(one["methods"]),
            {token: tuple(map(float, values)) for token, values in one["values"].items()},
        )
        for one in parse(_text("published.toml"), "published.toml").get(name, ())
    )


def load(name_or_path: str | os.PathLike[str]) -> Scene:
    """Return the scene of that name in the catalogue, or read it from a file.

    A path is anything with a folder in it or the suffix .toml. BadInput for an unknown name, SceneError
    for a file that is not a scene, AssemblyError for lengths that cannot be assembled.
    """
    from linkanim.scenes.reading import scene_from

    text, path = os.fspath(name_or_path), path_of(name_or_path)
    if path is None:
        path = catalogued(text)
        if path is None:
            near = meant(text, names())
            raise BadInput(f"no scene is called {shown(text)}{near}; `linkanim scenes` lists them")
        return scene_from(parse(path.read_text(encoding="utf-8"), text), name=text, where=text)
    where = intake.named(text)
    missing = f"{meant(path.stem, names())}; `linkanim scenes` lists the built-in ones"
    document = parse(SCENE_FILE.read(path, where, missing=missing), where)
    if "step" in document:
        raise SceneError(f"{where}: is a lesson, not a scene; `linkanim play` and `linkanim record` take it")
    return _photographed(scene_from(document, name=intake.named(path.stem), where=where), path.parent)


def foreign_document(
    name_or_path: str | os.PathLike[str],
) -> tuple[dict[str, Any], str, tuple[str, ...]] | None:
    """Return the document of another program's file, or link; None for a scene file, or a name.

    Behind it come the words for the file, and what of it was left out. BadInput, with what it seems to be,
    for a file that cannot be read so.
    """
    from linkanim.scenes.foreign import is_link, read_foreign, read_text

    text, path = os.fspath(name_or_path), Path(name_or_path)
    if is_link(text):
        foreign = read_text(text, "the link")
        return foreign.document("link", "converted from a link"), "the link", foreign.left_out
    if path.suffix.lower() == ".toml" or not (path.suffix or path.is_file()):
        return None
    where = intake.named(path)
    foreign = read_foreign(path, where)
    title, source = intake.named(path.stem), f"converted from {intake.named(path.name)}"
    return foreign.document(title, source), where, foreign.left_out


def opened(name_or_path: str | os.PathLike[str]) -> tuple[Scene, tuple[str, ...]]:
    """Return the scene of a name, a scene file, or another program's file, and what was left out of that."""
    from linkanim.scenes.reading import scene_from

    foreign = foreign_document(name_or_path)
    if foreign is None:
        return load(name_or_path), ()
    document, where, left_out = foreign
    return scene_from(document, name=document["title"], where=where), left_out


def _photographed(scene: Scene, folder: Path) -> Scene:
    """Return the scene of a file in a folder with its photograph's path from the current folder."""
    photo = scene.document.get("photo")
    if photo is None:
        return scene
    return replace(scene, document={**scene.document, "photo": photo | {"file": str(folder / photo["file"])}})


def with_points(scene: Scene) -> Scene:
    """Return the scene with the document that says it by its points and links.

    SceneError where these alone do not say how it moves.
    """
    from linkanim.scenes.posing import as_points, moves_alike
    from linkanim.scenes.reading import scene_from

    document = as_points(scene)
    made = scene_from(document, name=scene.name, where=f"{scene.name} as points")
    if not moves_alike(scene, made):
        raise SceneError(
            f"{scene.name}: its points and links alone do not say how it moves; it stays in its form"
        )
    # the document that was read, not the joints that follow from it
    return replace(made, document=document)


def in_its_form(scene: Scene) -> Scene:
    """Return the scene with a document in the form that its file had, as it is to be saved."""
    if scene.document.get("form") != POINTS_FORM:
        return scene
    try:
        return with_points(scene)
    except LinkanimError:
        return replace(scene, document={key: of for key, of in scene.document.items() if key != "form"})


def path_of(name_or_path: str | os.PathLike[str]) -> Path | None:
    """Return the path of a scene file; None for what would be a name in the catalogue."""
    text = os.fspath(name_or_path)
    marks = (os.sep, os.altsep or os.sep)
    named = isinstance(name_or_path, str) and not any(mark in text for mark in marks)
    return None if named and not text.lower().endswith(".toml") else Path(text)


def catalogued(name: str) -> Path | None:
    """Return the file of a catalogue scene, which lies in its chapter's folder; None for any other name."""
    folders, file = (Path(__file__).parent / "catalogue").iterdir(), f"{name}.toml"
    # looked up, not asked for: no file can have some names
    return next((path for folder in folders if (path := folder / file) in folder.iterdir()), None)


def _text(path: str) -> str:
    """Return the text of a file of the package."""
    return (Path(__file__).parent / path).read_text(encoding="utf-8")


def is_lesson(path: str | os.PathLike[str]) -> bool:
    """Return whether a file is a lesson, and no scene: it has steps."""
    if not os.fspath(path).lower().endswith(".toml"):
        return False
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, ValueError):
        return False
    return re.search(r"(?m)^\s*\[\[\s*step\s*\]\]|^\s*step\s*=", text) is not None
