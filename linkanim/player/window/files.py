"""Files that the window writes, under names that were free, and the scene file that it was opened on."""

from __future__ import annotations

import os
from contextlib import suppress
from itertools import count
from pathlib import Path

import pygame

from linkanim import atomic_files, intake
from linkanim.picture.raster.offscreen import png_bytes
from linkanim.player.state.state import State
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

FOLDER = Path("recordings")


def free_stem(folder: Path, name: str, suffixes: tuple[str, ...]) -> str:
    """Return `name-1`, `name-2`, …: the first under which no file with any of the suffixes is there."""
    stems = (f"{name}-{number}" for number in count(1))
    return next(stem for stem in stems if not any((folder / (stem + suffix)).exists() for suffix in suffixes))


def screenshot(surface: pygame.Surface, name: str) -> Path:
    """Write the picture as a PNG under a free name; errors as `_added`."""
    return _added(png_bytes(surface), name, ".png")


def vector(state: State, size: tuple[int, int]) -> Path:
    """Write the picture as an SVG under a free name, without what lies over it; errors as `_added`."""
    from linkanim.paper.figure import Figured

    scene = state.displayed
    shown = Figured(scene, size, state.look, state.phase, speed=state.clock.speed, as_seen=True)
    return _added(shown.document().encode(), scene.name, ".svg")


def page(state: State) -> Path:
    """Write the scene as a page that moves, with its chart; errors as `document`, `_added`."""
    from linkanim.share.page import Shared, document

    look = state.look
    shown = Shared(state.displayed, state.clock.speed, chart=look.chart, names=look.names)
    return _added(document(shown).encode(), state.scene.name, ".html")


def report(text: str, name: str) -> Path:
    """Write a fault's report under a free name; errors as `_added`."""
    return _added(f"{text}\n".encode(), f"{name}-fault", ".json")


def _added(data: bytes, name: str, suffix: str) -> Path:
    """Write a file under a free name in `FOLDER`, made if it is not there; return its path.

    `BadInput` where the folder's name is a file's, `WorkFailed` where the disk refuses.
    """
    atomic_files.made_folder(FOLDER)
    first, *others = (FOLDER / f"{name}-{number}{suffix}" for number in range(1, 10_000))
    return atomic_files.add(data, first, others)


def beside(file: str) -> str:
    """Return a file's path from the current folder, where scene files are written, if it lies in there."""
    path = Path(from_anywhere(file))
    with suppress(OSError, ValueError):  # it is gone, or the file lies elsewhere
        return str(path.relative_to(Path.cwd()))
    return str(path)


def from_anywhere(file: str) -> str:
    """Return a path of a file that holds from any folder; the same one where the current folder is gone."""
    with suppress(OSError):
        return str(Path(file).absolute())
    return file


class SceneFile:
    """A scene file, and how it was when it was last looked at."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._seen = self._state()

    def news(self) -> list[str]:
        """Return what has become of the file since it was last looked at, in words."""
        before, self._seen = self._seen, self._state()
        if before == self._seen:
            return []
        name = intake.named(self._path.name)
        if self._seen is None:
            return [f"{name} is gone; the linkage runs on, and Ctrl+S writes it as a new file"]
        return [f"{name} has changed; F5 loads it"]

    def load(self) -> Scene:
        """Read the file as it is now; errors as `scenes.load`."""
        self._seen = self._state()
        return load(self._path)

    def _state(self) -> tuple[int, int, int] | None:
        """Return what is another number once the file is written anew; None where there is none."""
        with suppress(OSError):
            found = self._path.stat()
            return found.st_mtime_ns, found.st_size, found.st_ino
        return None


def scene_files() -> list[str]:
    """Return the names of the scene files in the current folder, none where it is there no more."""
    with suppress(OSError), os.scandir() as entries:
        return sorted(one.name for one in entries if one.name.endswith(".toml") and one.name.isprintable())
    return []
