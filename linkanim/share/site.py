"""Every scene as a page, and an index of them by chapter: a site that needs no server."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from html import escape
from itertools import groupby
from pathlib import Path

from linkanim.manifest import FileSet, replacing
from linkanim.picture.items import clipped
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.scenes import load
from linkanim.scenes.editing import in_unit
from linkanim.scenes.scene import Scene
from linkanim.share.movers import Pairs
from linkanim.share.page import Shared, document, in_language, packaged
from linkanim.words import html_language, said

INDEX = "index.html"
_SIZE = (240, 150)
_EARLY = 0.09
"""The share of its period at which the index shows a scene: off its limits, where links lie in line."""


def write_site(
    folder: Path,
    names: Iterable[str],
    shared: Shared,
    unit: str | None = None,
    progress: Callable[[int, int], None] | None = None,
    tell: Callable[[str], None] | None = None,
) -> None:
    """Write a page for each scene as NAME.html into a folder, and the index; `shared` says how.

    Lengths are shown in `unit`, each scene's own where it is None. `progress` is told (pages done,
    in all), and `tell` what a page leaves out.

    All appear together or none does; they replace only files that we wrote. `BadInput` before any work where
    `folder` cannot be a folder or a name is taken by another file.
    """
    chosen = tuple(names)
    pages = [f"{name}.html" for name in chosen]
    with replacing(FileSet(folder, "share", r"[\w.-]+\.html"), [*pages, INDEX]) as new:
        scenes = []
        for name, page in zip(chosen, pages, strict=True):
            scenes.append(in_unit(load(name), unit))
            (new / page).write_text(document(replace(shared, scene=scenes[-1]), tell), encoding="utf-8")
            if progress:
                progress(len(scenes), len(chosen))
        (new / INDEX).write_text(_index(scenes, shared), encoding="utf-8")


def _index(scenes: Iterable[Scene], shared: Shared) -> str:
    pairs = Pairs()
    chapters = [
        f"<h2>{escape(said(chapter)[:1].upper() + said(chapter)[1:])}</h2>\n"
        f"<ul>{''.join(_entry(scene, shared, pairs) for scene in some)}</ul>"
        for chapter, some in groupby(scenes, lambda scene: scene.chapter)
    ]
    styles = pairs.styles(shared.themes, shared.theme)
    page = in_language(packaged(INDEX))
    return page.substitute(lang=html_language(), styles=styles, chapters="\n".join(chapters))


def _entry(scene: Scene, shared: Shared, pairs: Pairs) -> str:
    light, dark = (
        Picture(scene, _SIZE, Look(hud=False, trace=False, theme=theme)) for theme in shared.themes
    )
    pose, _ = light.poses(_EARLY * scene.period)
    groups = zip(light.groups(pose), dark.groups(pose), strict=True)
    picture = "".join(pairs.elements(clipped(one), clipped(other)) for one, other in groups)
    words = f"<b>{escape(said(scene.title))}</b><span>{escape(scene.info.class_said)}</span>"
    size = f"0 0 {_SIZE[0]} {_SIZE[1]}"
    drawn = f'<svg viewBox="{size}" aria-hidden="true">{picture}</svg>'
    return f'<li><a href="{escape(scene.name)}.html">{drawn}{words}</a></li>'
