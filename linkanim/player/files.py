"""Files that the window writes: under the current folder, under names that were free."""

from __future__ import annotations

from itertools import count
from pathlib import Path

import pygame

from linkanim.errors import WorkFailed

FOLDER = "recordings"


def free_stem(folder: Path, name: str, suffixes: tuple[str, ...]) -> str:
    """Return `name-1`, `name-2`, …: the first under which no file with any of the suffixes is there."""
    stems = (f"{name}-{number}" for number in count(1))
    return next(stem for stem in stems if not any((folder / (stem + suffix)).exists() for suffix in suffixes))


def folder() -> Path:
    """Return recordings/ under the current folder, made if it is not there; WorkFailed if it cannot be."""
    path = Path(FOLDER)
    try:
        path.mkdir(exist_ok=True)
    except OSError as error:
        raise WorkFailed(f"{path}: cannot be made: {error.strerror or error}") from None
    return path


def screenshot(surface: pygame.Surface, name: str) -> Path:
    """Write the picture as a PNG under a free name, and return its path; WorkFailed if it cannot be."""
    into = folder()
    path = into / f"{free_stem(into, name, ('.png',))}.png"
    try:
        pygame.image.save(surface, path)
    except (pygame.error, OSError) as error:
        raise WorkFailed(f"{path}: cannot be written: {error}") from None
    return path
