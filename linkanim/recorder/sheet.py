"""Several scenes on one picture, numbered: each in one pose, or in its own period while a clip lasts."""

from __future__ import annotations

import math
from collections.abc import Sequence

from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen, pixel_view, png_bytes
from linkanim.picture.stills import still_phase
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import letters
from linkanim.picture.theme import theme_of
from linkanim.recorder.encode import Frame
from linkanim.recorder.plan import Clip, make_plan
from linkanim.recorder.recording import Progress, Recording, Target, checked_path, theme_colours, write
from linkanim.scenes.scene import Scene

PICTURE, _HEAD = (320, 216), 24
"""The size of each picture, and how high the line with its number above it is."""
TILE = (PICTURE[0], PICTURE[1] + _HEAD)
MOST_TILES = 64
_GAP = 4
_NUMBER = 20


class SheetFrames:
    """Pictures of scenes side by side, with their numbers; about as wide as high."""

    independent = True
    alpha = False

    def __init__(self, scenes: Sequence[Scene], frames: int, look: Look) -> None:
        self._columns = max(math.ceil(math.sqrt(len(scenes) * TILE[1] / TILE[0])), 1)
        rows = math.ceil(len(scenes) / self._columns)
        across, down = (side + _GAP for side in TILE)
        self.size = (self._columns * across + _GAP, rows * down + _GAP)
        self.colours = theme_colours(look)
        self._theme, self._frames = theme_of(look.theme), frames
        self._tiles = [(scene, Picture(scene, PICTURE, look)) for scene in scenes]
        self._printer, self._type = SurfacePrinter(), letters()
        self._surface, self._tile = offscreen(self.size), offscreen(PICTURE)

    def draw(self, frame: int) -> Frame:
        """Return the bytes of a frame, which the next call overwrites."""
        self._paint([scene.period * frame / self._frames for scene, _ in self._tiles])
        return pixel_view(self._surface)

    def png(self, phases: Sequence[float]) -> bytes:
        """Return a PNG in which each scene is at its phase."""
        self._paint(phases)
        return png_bytes(self._surface)

    def _paint(self, phases: Sequence[float]) -> None:
        self._surface.fill(self._theme.rule)
        for number, ((scene, picture), phase) in enumerate(zip(self._tiles, phases, strict=True)):
            row, column = divmod(number, self._columns)
            self._printer.print(self._tile, picture, phase, scene.linkage.drive.speed)
            left, top = _GAP + column * (TILE[0] + _GAP), _GAP + row * (TILE[1] + _GAP)
            self._surface.fill(self._theme.background, (left, top, *TILE))
            self._surface.blit(self._tile, (left, top + _HEAD))
            at, ink = (left + 8, top + 4), self._theme.ink
            self._type.draw(self._surface, f"{number + 1}", at, size=_NUMBER, colour=ink, strong=True)


def record_sheet(scenes: Sequence[Scene], path: Target, progress: Progress | None = None) -> Recording:
    """Record scenes side by side over a period of the first; errors as `record`."""
    _, form = checked_path(path)
    first = scenes[0]
    plan = make_plan(Clip(first.linkage.drive.speed, first.period, 20.0), form)
    return write(SheetFrames(scenes, plan.frames, Look(hud=False)), plan, path, progress)


def still_sheet(scenes: Sequence[Scene]) -> bytes:
    """Return a PNG of scenes side by side, each in the pose that reads best."""
    return SheetFrames(scenes, 1, Look(hud=False)).png([still_phase(scene) for scene in scenes])
