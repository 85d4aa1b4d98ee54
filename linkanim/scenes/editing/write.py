"""A scene back to TOML: text that reads to the same linkage, saved beside what is there, never over it."""

from __future__ import annotations

import re
from itertools import count
from pathlib import Path

from linkanim import atomic_files
from linkanim.errors import SceneError
from linkanim.scenes.scene import Scene

_LIST = re.compile(r" = \[\n((?:    .*,\n)+)\]$", re.MULTILINE)


def text(scene: Scene) -> str:
    """Return the scene as the text of a scene file, which reads back to the same linkage.

    Numbers keep every digit and quantities the unit they were written with; comments are not kept.
    SceneError for a scene that was made without a document.
    """
    if not scene.document:
        raise SceneError(f"{scene.name}: has no scene file behind it that could be written; load it from one")
    import tomli_w

    return _LIST.sub(_on_one_line, tomli_w.dumps(dict(scene.document)))


def save(scene: Scene, folder: Path) -> Path:
    """Write the scene into `folder` under a name that is free, and return the file's path.

    The name is the scene's, or that with -2, -3, ...: an older file stays as it is. WorkFailed, with
    nothing left behind, where the folder cannot be written.
    """
    numbered = (folder / f"{scene.name}-{number}.toml" for number in count(2))
    return atomic_files.add(text(scene).encode("utf-8"), folder / f"{scene.name}.toml", numbered)


def _on_one_line(found: re.Match[str]) -> str:
    """Return a list as people write it, [283, 165], rather than an item a line."""
    items = (line.strip().removesuffix(",") for line in found[1].splitlines())
    return f" = [{', '.join(items)}]"
