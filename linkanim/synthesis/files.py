"""Answers as scene files: the first under the name that was asked for, the others numbered."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from linkanim.manifest import FileSet, replacing
from linkanim.scenes.editing.write import text
from linkanim.scenes.scene import Scene


def file_set(target: Path) -> FileSet:
    """Return the set that answers are written as: NAME.toml, NAME-2.toml, ..."""
    return FileSet(target.parent, target.name, rf"{re.escape(target.stem)}(-\d+)?\.toml")


def write(scenes: Sequence[Scene], target: Path) -> list[Path]:
    """Write the answers, all or none, and return their paths; what an older run wrote more of goes.

    BadInput where a name is taken by a file that is not ours, or was changed since.
    """
    names = [target.name, *(f"{target.stem}-{number}.toml" for number in range(2, len(scenes) + 1))]
    with replacing(file_set(target), names) as folder:
        for scene, name in zip(scenes, names, strict=True):
            (folder / name).write_text(text(scene), encoding="utf-8")
    return [target.parent / name for name in names]
