"""The head-up display: what scene it is, and the numbers of this instant, in words."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import degrees, pi, tau
from typing import NamedTuple

import pygame

from linkanim.mechanics.motion import Pose
from linkanim.picture.axis import number
from linkanim.picture.layout import Layout
from linkanim.picture.overlay import Overlay
from linkanim.picture.text import Type
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene

_NEAR_LIMIT = 0.06 * pi
"""How near to a limit, in phase, the HUD says so: there the input has 1 % of its swing left."""
_NEAR_CHANGE = pi / 45


class Row(NamedTuple):
    """A name and its value; the name stays while the value moves."""

    label: str
    value: str


def rows(scene: Scene, pose: Pose, speed: str | None = None) -> tuple[Row, ...]:
    """Return the numbers of a pose: the same names in the same order at every pose of a scene.

    `speed` replaces the input speed in words. Forces appear where they are known; lengths are in the
    scene's unit, forces in newtons, tension positive.
    """
    return tuple(_rows(scene, pose, speed))


def _rows(scene: Scene, pose: Pose, speed: str | None) -> Iterator[Row]:
    info = scene.info
    angle = pose.crank_angle % tau if info.full_turn else pose.crank_angle
    yield Row("crank angle", f"{number(degrees(angle) % 360 if info.full_turn else degrees(angle), 0.1)}°")
    yield Row("input speed", speed or rpm(pose.input_speed))
    if not info.full_turn:
        low, high = (number(degrees(limit), 0.1) for limit in info.input_range)
        yield Row("input range", f"{low}°…{high}°")
    if info.true_period != 1:
        yield Row("true period", f"{info.true_period} turns")
    unit = scene.length_unit
    for name, spring in pose.spring.items():
        yield Row(f"spring {name}", f"{number(spring.length, 0.1)} {unit}")
        if spring.force is not None:
            yield Row("force", f"{number(spring.force, 0.1)} N")
    for name, damper in pose.damper.items():
        yield Row(f"damper {name}", f"{number(damper.rate or 0.0, 0.1)} {unit}/s")
        if damper.force is not None:
            yield Row("force", f"{number(damper.force, 0.1)} N")


def rpm(speed: float) -> str:
    """Return an angular speed in rad/s as turns a minute, clockwise negative."""
    return f"{speed * 60 / tau:.4g} rpm".replace("-", "−")


def note(scene: Scene, pose: Pose) -> str | None:
    """Return what is special here: a limit of the input or a change point that is near; else None."""
    info = scene.info
    if not info.full_turn:
        for limit, at in zip(info.input_range, (0.0, pi), strict=True):
            if _apart(pose.phase, at) < _NEAR_LIMIT:
                return f"near the limit {number(degrees(limit), 0.1)}°"
    for point in info.change_points:
        if _apart(pose.crank_angle, point) < _NEAR_CHANGE:
            return f"near the change point {number(degrees(point) % 360, 0.1)}°"
    return None


def _apart(one: float, other: float) -> float:
    return abs((one - other + pi) % tau - pi)


@dataclass(frozen=True)
class Hud:
    """Where the HUD's lines stand; names are drawn once, values at every frame."""

    scene: Scene
    title: tuple[str, ...]
    class_name: tuple[str, ...]
    column: Rect
    layout: Layout
    type: Type
    theme: Theme

    @property
    def _step(self) -> float:
        return 1.42 * self.layout.text_size

    @property
    def _first(self) -> float:
        """Where the rows begin, below title and class."""
        title = 1.15 * self.layout.title_size * len(self.title)
        return self.column.y + title + 1.15 * self.layout.text_size * (len(self.class_name) + 1)

    def draw(self, surface: pygame.Surface, pose: Pose) -> None:
        """Draw what stands still: title, class and the names of the rows."""
        x, y, size = self.column.x, self.column.y, self.layout.title_size
        for line in self.title:
            self.type.draw(surface, line, (x, y), size=size, colour=self.theme.ink)
            y += 1.15 * size
        size = self.layout.text_size
        for line in self.class_name:
            self.type.draw(surface, line, (x, y), size=size, colour=self.theme.dim)
            y += 1.15 * size
        for n, row in enumerate(rows(self.scene, pose)):
            at = (x, self._first + n * self._step)
            self.type.draw(surface, row.label, at, size=size, colour=self.theme.dim)

    def draw_values(self, surface: pygame.Surface, pose: Pose, overlay: Overlay) -> None:
        """Draw the values of a pose, and what is special there."""
        size, theme = self.layout.text_size, self.theme
        values = rows(self.scene, pose, overlay.speed)
        for n, row in enumerate(values):
            at = (self.column.right, self._first + n * self._step)
            self.type.draw(surface, row.value, at, size=size, colour=theme.ink, anchor="right")
        special = note(self.scene, pose)
        lines = [(special, theme.warning)] if special else []
        lines += [(line, theme.ink) for line in overlay.notes]
        for n, (line, colour) in enumerate(lines, start=len(values)):
            at = (self.column.x, self._first + (n + 0.4) * self._step)
            self.type.draw(surface, line, at, size=size, colour=colour)


def hud_for(scene: Scene, layout: Layout, type_: Type, theme: Theme) -> Hud | None:
    """Return the HUD of a scene in a window, None where the window has no column for it."""
    column = layout.hud
    if column is None:
        return None
    title = type_.wrapped(scene.title, layout.title_size, column.width)
    class_name = type_.wrapped(scene.info.class_name, layout.text_size, column.width)
    return Hud(scene, tuple(title), tuple(class_name), column, layout, type_, theme)
