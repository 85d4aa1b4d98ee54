"""Several scenes on one picture, all running: each goes through its own period while the clip lasts."""

from __future__ import annotations

import math
from collections.abc import Sequence

from linkanim.picture.look import Look
from linkanim.picture.overlay import NOTHING_OVER
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen, pixel_view
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import Type
from linkanim.picture.theme import theme_of
from linkanim.recorder.encode import Frame
from linkanim.recorder.plan import Clip, make_plan
from linkanim.recorder.recording import Progress, Recording, Target, checked_path, theme_colours, write
from linkanim.scenes.scene import Scene

TILE = (320, 240)
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
        self._tiles = [(scene, Picture(scene, TILE, look)) for scene in scenes]
        self._printer, self._type = SurfacePrinter(), Type()
        self._surface, self._tile = offscreen(self.size), offscreen(TILE)

    def draw(self, frame: int) -> Frame:
        """Return the bytes of a frame, which the next call overwrites."""
        self._surface.fill(self._theme.rule)
        for number, (scene, picture) in enumerate(self._tiles):
            row, column = divmod(number, self._columns)
            phase = scene.period * frame / self._frames
            self._printer.print(self._tile, picture, phase, scene.linkage.drive.speed, NOTHING_OVER)
            ink = self._theme.ink
            self._type.draw(self._tile, f"{number + 1}", (8, 6), size=_NUMBER, colour=ink, strong=True)
            place = (_GAP + column * (TILE[0] + _GAP), _GAP + row * (TILE[1] + _GAP))
            self._surface.blit(self._tile, place)
        return pixel_view(self._surface)


def record_sheet(scenes: Sequence[Scene], path: Target, progress: Progress | None = None) -> Recording:
    """Record scenes side by side over a period of the first; errors as `record`."""
    _, form = checked_path(path)
    first = scenes[0]
    plan = make_plan(Clip(first.linkage.drive.speed, first.period, 20.0), form)
    return write(SheetFrames(scenes, plan.frames, Look(hud=False)), plan, path, progress)
