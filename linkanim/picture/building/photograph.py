"""A photograph behind a sheet: read once, and laid as it is moved, scaled and turned."""

from __future__ import annotations

from cmath import rect
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
import pygame
from numpy.typing import NDArray

from linkanim import intake
from linkanim.build.draft import Photo
from linkanim.picture.raster.raster import Colour
from linkanim.picture.view import View

_SHOWN = 0.45
"""How much of a photograph shows through the paper."""
_MOST_BYTES = 60_000_000
_LONGEST = 1600
"""The longer side of what is kept of a photograph, in pixels."""
SUFFIXES = (".png", ".jpg", ".jpeg", ".webp", ".bmp")


def lack(file: str) -> str | None:
    """Return in a sentence why a photograph is left out; None of one that shows."""
    if _read(file) is not None:
        return None
    reason = "is no picture" if Path(file).exists() else "is not there"
    return f"{intake.named(file)}: {reason}; the sheet goes on without the photograph"


@dataclass(frozen=True)
class Photograph:
    """A photograph as it lies in a view, on paper of a colour."""

    photo: Photo
    view: View
    paper: Colour

    def draw(self, surface: pygame.Surface) -> None:
        """Lay it on a surface, faded; one that is not there any more, or is none, is left out."""
        picture = _faded(self.photo.file, self.paper, surface.get_shifts())
        if picture is None:
            return
        (width, height), (high, wide) = surface.get_size(), picture.shape
        scale = wide / self.photo.width
        corner = self.view.place(self.photo.place)
        across = np.arange(width) - corner.real
        up = corner.imag - np.arange(height)[:, None]
        turn = rect(1.0, -self.photo.turn) * scale / self.view.scale
        column = np.floor(turn.real * across - turn.imag * up).astype(np.int32)
        row = high - 1 - np.floor(turn.imag * across + turn.real * up).astype(np.int32)
        inside = (column >= 0) & (column < wide) & (row >= 0) & (row < high)
        pixels = pygame.surfarray.pixels2d(surface).swapaxes(0, 1)
        pixels[inside] = picture[row[inside], column[inside]]


@lru_cache(maxsize=4)
def _faded(file: str, paper: Colour, shifts: tuple[int, int, int, int]) -> NDArray[np.uint32] | None:
    """Return a photograph as it shows through paper of a colour, in pixels as a surface has them."""
    picture = _read(file)
    if picture is None:
        return None
    faded = (_SHOWN * picture + (1 - _SHOWN) * np.array(paper)).astype(np.uint32)
    red, green, blue, _ = shifts
    packed = faded[..., 0] << red | faded[..., 1] << green | faded[..., 2] << blue
    opaque = 0xFFFFFFFF ^ (0xFF << red | 0xFF << green | 0xFF << blue)
    return np.asarray(packed | opaque, np.uint32)


@lru_cache(maxsize=2)
def _read(file: str) -> NDArray[np.uint8] | None:
    """Return the pixels of a picture file, row by row; None where it is none, or very large."""
    path = Path(file)
    try:
        if path.suffix.lower() not in SUFFIXES or not path.is_file() or path.stat().st_size > _MOST_BYTES:
            return None
        picture = pygame.image.load(path)
    except (OSError, ValueError, pygame.error):
        return None
    share = min(_LONGEST / max(picture.get_size()), 1.0)
    size = tuple(max(round(share * side), 1) for side in picture.get_size())
    plain = pygame.Surface(picture.get_size(), 0, 24)
    plain.fill((255, 255, 255))
    plain.blit(picture, (0, 0))
    found: NDArray[np.uint8] = pygame.surfarray.array3d(pygame.transform.smoothscale(plain, size))
    return np.ascontiguousarray(found.swapaxes(0, 1))
