"""One pose of a scene as a figure: the window's drawing without its words, for a PNG or an SVG."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import pygame

from linkanim.atomic_files import replacing
from linkanim.mechanics.motion.motion import Pose
from linkanim.paper.pdf import pdf, require_pdf
from linkanim.paper.svg import svg
from linkanim.picture.arrangement.staging import Staging, staged, wanted_of
from linkanim.picture.diagrams.chart import pen_for
from linkanim.picture.diagrams.strip import strip
from linkanim.picture.drawing import Drawing
from linkanim.picture.items import Group, draw, flat, grouped, worded
from linkanim.picture.labels.names import Names
from linkanim.picture.look import Look
from linkanim.picture.panels.hud import Hud
from linkanim.picture.panels.legend import legend_for
from linkanim.picture.raster.offscreen import offscreen, png_bytes
from linkanim.picture.raster.raster import Layer, paint
from linkanim.picture.text.text import Type
from linkanim.picture.theme import theme_of
from linkanim.scenes.editing.closures import ghost_of
from linkanim.scenes.scene import Scene

SUFFIXES = (".svg", ".png", ".pdf")


@dataclass(frozen=True)
class Figured:
    """What a figure shows of a scene: a phase, and over it `poses` faint ones spread over the period.

    It is told at `speed`, the scene's own where none is given. With `both` the view fits both closures, as a
    window's does.
    """

    scene: Scene
    size: tuple[int, int]
    look: Look
    phase: float = 0.0
    poses: int = 0
    speed: float | None = None
    both: bool = False

    @cached_property
    def _staging(self) -> Staging:
        wanted = wanted_of(self.size, self.look, listed=False)
        return staged(self.scene, self._other, wanted, self.type)

    @cached_property
    def drawing(self) -> Drawing:
        """The drawing that it is a pose of."""
        look, staging = self.look, self._staging
        return Drawing(staging.scenery(staging.subject.figure, theme_of(look.theme), look), apart=True)

    @cached_property
    def type(self) -> Type:
        """The face that it is lettered in."""
        return Type()

    @cached_property
    def names(self) -> Names | None:
        """The names on it, where the look asks for them."""
        return self.drawing.names(self.type)

    @cached_property
    def pose(self) -> Pose:
        """The pose drawn in full."""
        return self.scene.pose(self.phase, speed=self.speed)

    def groups(self) -> Iterator[Group]:
        """Yield all that is drawn, back to front: shapes in groups of bodies and joints, then words."""
        drawing, pose = self.drawing, self.pose
        places = drawing.places(pose)
        yield drawing.discs()
        yield from drawing.wheels(places)
        for n, faint in enumerate(self._faint(), start=1):
            yield Group(f"pose-{n}", drawing.faint(faint))
        yield from drawing.standing
        yield from drawing.moving(pose)
        if self.names:
            yield Group("names", (), self.names.captions(pose, places))
        if self.look.framed:
            yield Group("margins", [self._margins()])
        for polygon in drawing.polygons(self.type):
            yield polygon.group(pose)
        yield from self._told()

    def _margins(self) -> Layer:
        """Return what covers a zoomed scene where it would lie under what stands beside it."""
        reach, (width, height) = self.drawing.scenery.layout.reach, self.size
        corners = [[reach.right, 0, width, height], [0, reach.bottom, width, height]]
        loops = [np.array([x + 1j * y, x1 + 1j * y, x1 + 1j * y1, x + 1j * y1]) for x, y, x1, y1 in corners]
        return Layer(theme_of(self.look.theme).background, loops)

    def _told(self) -> Iterator[Group]:
        """Yield the chart with its cursor, the words about the scene, and the key to the arrows."""
        set_, block = self.drawing.scenery, self._staging.arrangement.block
        if self.look.chart:
            pen = pen_for(set_.layout, self.type, set_.theme)
            chart = strip(set_.figure, self.look.chart, set_.layout, pen).at(self.pose.input_speed)
            yield grouped("chart", [*chart.items(), *chart.cursor(self.pose), *chart.readings(self.pose)])
        if block and set_.layout.hud:
            hud = Hud(self.scene, block, set_.layout.hud, self.type, set_.theme)
            yield grouped("words", [*hud.still(), *hud.values(self.pose)])
        legend = legend_for(self.drawing.cast.arrows, set_.layout, self.type, set_.theme)
        if legend:
            yield grouped("key", [*legend.still(), *legend.values(self.pose.input_speed)])

    def surface(self) -> pygame.Surface:
        """Return the figure drawn; clear where nothing is, without a background."""
        surface = offscreen(self.size, alpha=not self.look.background)
        surface.fill((*theme_of(self.look.theme).background, 255 if self.look.background else 0))
        groups = list(self.groups())
        paint(surface, list(flat(groups)))
        draw(surface, worded(groups), self.type)
        return surface

    def document(self) -> str:
        """Return the figure as SVG."""
        background = theme_of(self.look.theme).background if self.look.background else None
        return svg(self.size, background, self.groups(), title=self.scene.title)

    def printed(self) -> bytes:
        """Return the figure as PDF."""
        background = theme_of(self.look.theme).background if self.look.background else None
        return pdf(self.size, background, self.groups(), title=self.scene.title)

    @cached_property
    def _other(self) -> Scene | None:
        return ghost_of(self.scene) if self.look.ghost or self.both else None

    def _faint(self) -> Iterator[Pose]:
        """Yield the poses that are drawn faintly: the other closure's, then those over the period."""
        if self._other and self.look.ghost:
            yield self._other.pose(self.phase, 0)
        for n in range(self.poses):
            yield self.scene.pose(self.phase + self.scene.period * n / self.poses, 0)


def write(shown: Figured, target: Path) -> None:
    """Write a figure as SVG, PNG or PDF, as the name ends; the file appears whole or not at all.

    `WorkFailed` where disk or folder refuse; `BadInput` for a PDF without what writes it.
    """
    if target.suffix.lower() == ".pdf":
        require_pdf()
    with replacing(target) as part:
        match target.suffix.lower():
            case ".png":
                part.write_bytes(png_bytes(shown.surface()))
            case ".pdf":
                part.write_bytes(shown.printed())
            case _:
                part.write_text(shown.document(), encoding="utf-8")
