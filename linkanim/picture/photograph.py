"""A photograph behind a sheet: read once, and placed as it is moved, scaled and turned.

Its size is read from its header before any pixel, and bounded: a file of some kilobytes may claim to hold
gigabytes. A camera's note on how it was held (EXIF) is followed.
"""

from __future__ import annotations

import stat
import warnings
from cmath import rect
from contextlib import suppress
from functools import lru_cache
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pygame
from numpy.typing import NDArray

from linkanim import intake
from linkanim.bounds import LARGEST_SIDE
from linkanim.build.draft import Photo
from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.picture.raster import Colour
from linkanim.picture.view import View

if TYPE_CHECKING:
    from PIL import Image

Pixels = NDArray[np.uint8]
_SHOWN = 0.45
"""The share of a photograph that shows through the paper."""
_MOST_BYTES = 60_000_000
_LONGEST = 1600
"""The longer side of a photograph as it is kept, in pixels."""
_MILLIONS = {"JPEG": 65, "PNG": 40, "BMP": 40, "WEBP": 16}
"""The most millions of pixels, by format: each takes some 400 MB to read; JPEG is read at a reduced size."""
_BAND = 2_000_000
"""The pixels that are converted to red, green and blue at a time."""
SUFFIXES = (".png", ".jpg", ".jpeg", ".webp", ".bmp")


def lack(file: str) -> str | None:
    """Return in a sentence why a photograph is left out; None where it can be shown."""
    photograph = _read(file, _stamp(file))
    return f"{photograph}; the sheet goes on without the photograph" if isinstance(photograph, str) else None


def refuse_lacking(file: str) -> None:
    """Raise BadInput with the reason for a photograph that cannot be shown."""
    photograph = _read(file, _stamp(file))
    if isinstance(photograph, str):
        raise BadInput(photograph)


@frozen
class Photograph:
    """A photograph in its place in a view, on paper of a colour."""

    photo: Photo
    view: View
    paper: Colour

    def draw(self, surface: pygame.Surface) -> None:
        """Draw the photograph on a surface, faded; a file that is gone, or is no picture, is left out."""
        file = self.photo.file
        picture = _faded(file, _stamp(file), self.paper, surface.get_shifts())
        if picture is None:
            return
        (width, height), (high, wide) = surface.get_size(), picture.shape
        scale = wide / self.photo.width
        corner = self.view.pixel(self.photo.place)
        across = np.arange(width) - corner.real
        up = corner.imag - np.arange(height)[:, None]
        turn = rect(1.0, -self.photo.turn) * scale / self.view.scale
        column = np.floor(turn.real * across - turn.imag * up).astype(np.int32)
        row = high - 1 - np.floor(turn.imag * across + turn.real * up).astype(np.int32)
        inside = (column >= 0) & (column < wide) & (row >= 0) & (row < high)
        pixels = pygame.surfarray.pixels2d(surface).swapaxes(0, 1)
        pixels[inside] = picture[row[inside], column[inside]]


Stamp = tuple[int, int] | str
"""When a file was last written and its size, or why it cannot be read."""


def _stamp(file: str) -> Stamp:
    try:
        status = Path(file).stat()
    except (FileNotFoundError, NotADirectoryError):
        return "is not there"
    except (OSError, ValueError) as error:
        return f"cannot be read: {(getattr(error, 'strerror', None) or str(error)).lower()}"
    if not stat.S_ISREG(status.st_mode):
        return f"is no picture; a photograph is one of {', '.join(SUFFIXES)}"
    if status.st_size > _MOST_BYTES:
        return f"is larger than {_MOST_BYTES // 1_000_000} MB; save it smaller"
    return status.st_mtime_ns, status.st_size


@lru_cache(maxsize=4)
def _faded(
    file: str, stamp: Stamp, paper: Colour, shifts: tuple[int, int, int, int]
) -> NDArray[np.uint32] | None:
    """Return a photograph as it shows through paper of a colour, as a surface's pixels."""
    picture = _read(file, stamp)
    if isinstance(picture, str):
        return None
    faded = (_SHOWN * picture + (1 - _SHOWN) * np.array(paper)).astype(np.uint32)
    red, green, blue, _ = shifts
    packed = faded[..., 0] << red | faded[..., 1] << green | faded[..., 2] << blue
    opaque = 0xFFFFFFFF ^ (0xFF << red | 0xFF << green | 0xFF << blue)
    return np.asarray(packed | opaque, np.uint32)


@lru_cache(maxsize=2)
def _read(file: str, stamp: Stamp) -> Pixels | str:
    """Return the pixels of a picture file, row by row, or in a sentence why there are none."""
    where = intake.named(file)
    if isinstance(stamp, str):
        return f"{where}: {stamp}"
    from PIL import Image, UnidentifiedImageError

    try:
        with warnings.catch_warnings(action="ignore"), Image.open(file, formats=list(_MILLIONS)) as picture:
            most = _MILLIONS.get(picture.format or "", min(_MILLIONS.values()))
            if picture.width * picture.height > most * 1_000_000 or max(picture.size) > LARGEST_SIDE:
                width, height = picture.size
                return f"{where}: is {width} × {height} pixels; {_too_large(most)}"
            return np.asarray(_upright(_shrunk(picture), picture))
    except UnidentifiedImageError:
        return f"{where}: is no picture; a photograph is one of {', '.join(SUFFIXES)}"
    except Image.DecompressionBombError:
        form = Path(file).suffix[1:].upper()  # only .jpg differs from its format's name
        return f"{where}: is far too large; {_too_large(_MILLIONS.get(form, _MILLIONS['JPEG']))}"
    except Exception:  # a decoder may raise anything on a damaged file
        return f"{where}: cannot be read to its end; save it again"


def _too_large(most: int) -> str:
    return f"make it smaller: {most} million pixels at the most, and {LARGEST_SIDE:,} along a side"


def _shrunk(picture: Image.Image) -> Image.Image:
    """Return a picture in red, green and blue, clear parts white, its longer side at most `_LONGEST`.

    It is converted in bands: a second, converted copy of the whole would double the memory.
    """
    from PIL import Image

    picture.draft("RGB", (_LONGEST, _LONGEST))
    part = max(max(picture.size) // _LONGEST, 1)
    width, height = (ceil(side / part) for side in picture.size)
    small = Image.new("RGB", (width, height))
    band = max(_BAND // picture.width // part, 1) * part
    for top in range(0, picture.height, band):
        strip = picture.crop((0, top, picture.width, min(top + band, picture.height)))
        small.paste(_flat(strip).reduce(part), (0, top // part))
    small.thumbnail((_LONGEST, _LONGEST))
    return small


def _flat(picture: Image.Image) -> Image.Image:
    """Return a picture in red, green and blue on white."""
    from PIL import Image

    if picture.mode.startswith("I"):  # 16 bits a pixel
        picture = Image.fromarray((np.asarray(picture) >> 8).astype(np.uint8))
    if not picture.has_transparency_data:
        return picture.convert("RGB")
    clear = picture.convert("RGBA")
    white = Image.new("RGB", picture.size, "white")
    white.paste(clear, mask=clear)
    return white


def _upright(small: Image.Image, picture: Image.Image) -> Image.Image:
    """Return a picture turned as the camera noted in its file; unchanged where that note is damaged."""
    from PIL import ImageOps

    small.info = picture.info
    with suppress(Exception):  # as for a decoder, any error is possible
        return ImageOps.exif_transpose(small)
    return small
