"""A scene on its canvas: the painter made for it, and the other closure behind it where the look asks."""

from __future__ import annotations

from functools import cached_property

import pygame

from linkanim.mechanics.motion import Pose
from linkanim.picture.look import Look
from linkanim.picture.overlay import Overlay
from linkanim.picture.painter import Painter
from linkanim.scenes.closure import ghost_of
from linkanim.scenes.scene import Scene


class Canvas:
    """A painter with the scene of its ghost, made for one scene, size and look; it follows `before`."""

    def __init__(self, scene: Scene, size: tuple[int, int], look: Look, before: Canvas | None = None) -> None:
        self.made_for = (id(scene), size, look)
        self._scene, self._look = scene, look
        last: Painter | None = before.painter if before else None
        self.painter: Painter = Painter(scene, size, look, beside=self._ghost, before=last)

    def paint(self, surface: pygame.Surface, phase: float, speed: float, over: Overlay) -> Pose:
        """Paint a phase, the other closure behind it where the look asks; return its pose."""
        pose = self._scene.pose(phase, speed=speed)
        ghost = self._ghost.pose(phase, 0) if self._ghost else None
        self.painter.paint(surface, pose, over, ghost=ghost)
        return pose

    @cached_property
    def _ghost(self) -> Scene | None:
        return ghost_of(self._scene) if self._look.ghost else None
