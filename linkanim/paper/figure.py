"""One pose of a scene as a figure: the window's drawing without its words, for a PNG or an SVG."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import pygame

from linkanim.mechanics.motion import Pose
from linkanim.paper.svg import svg
from linkanim.picture.drawing import Drawing
from linkanim.picture.items import Group, draw, flat, worded
from linkanim.picture.look import Look
from linkanim.picture.names import Names
from linkanim.picture.offscreen import offscreen, png_bytes
from linkanim.picture.raster import paint
from linkanim.picture.staging import staged, wanted_of
from linkanim.picture.text import Type
from linkanim.picture.theme import theme_of
from linkanim.scenes.closure import ghost_of
from linkanim.scenes.scene import Scene
from linkanim.whole import replacing

SUFFIXES = (".svg", ".png")


@dataclass(frozen=True)
class Figured:
    """What a figure shows of a scene: a phase, and over it `poses` faint ones spread over the period.

    Of the look, the chart and the HUD are left out.
    """

    scene: Scene
    size: tuple[int, int]
    look: Look
    phase: float = 0.0
    poses: int = 0

    @cached_property
    def drawing(self) -> Drawing:
        """The drawing that it is a pose of."""
        look = replace(self.look, hud=False, chart=None)
        staging = staged(self.scene, self._ghost, wanted_of(self.size, look, listed=False), self.type)
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
        return self.scene.pose(self.phase)

    def groups(self) -> Iterator[Group]:
        """Yield all that is drawn, back to front: shapes in groups of bodies and joints, then the names."""
        drawing, pose = self.drawing, self.pose
        places = drawing.places(pose)
        yield drawing.discs()
        yield from drawing.wheels(places)
        for n, faint in enumerate(self._faint(), start=1):
            yield Group(f"pose-{n}", drawing.faint(faint))
        yield from drawing.standing()
        yield from drawing.moving(pose)
        if self.names:
            yield Group("names", (), self.names.captions(pose, places))
        for polygon in drawing.polygons(self.type):
            yield polygon.group(pose)

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

    @cached_property
    def _ghost(self) -> Scene | None:
        return ghost_of(self.scene) if self.look.ghost else None

    def _faint(self) -> Iterator[Pose]:
        """Yield the poses that are drawn faintly: the other closure's, then those over the period."""
        if self._ghost:
            yield self._ghost.pose(self.phase, 0)
        for n in range(self.poses):
            yield self.scene.pose(self.phase + self.scene.period * n / self.poses, 0)


def write(shown: Figured, target: Path) -> None:
    """Write a figure as SVG or PNG, as the name ends; the file appears whole or not at all.

    `WorkFailed` where disk or folder refuse.
    """
    with replacing(target) as part:
        if target.suffix.lower() == ".png":
            part.write_bytes(png_bytes(shown.surface()))
        else:
            part.write_text(shown.document(), encoding="utf-8")
