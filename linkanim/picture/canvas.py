"""A scene on its canvas: the painter made for it, and the other closure behind it where the look asks."""

from __future__ import annotations

from functools import cached_property

import pygame

from linkanim.mechanics.motion.motion import Pose
from linkanim.picture.look import Look
from linkanim.picture.painter import Painter
from linkanim.picture.panels.overlay import Overlay
from linkanim.scenes.editing.closures import ghost_of
from linkanim.scenes.scene import Scene


class Canvas:
    """A painter with the scene of its ghost, made for one scene, size and look; it follows `before`.

    With `both` the view fits both closures, so that it stays when one changes into the other; it does so,
    too, where the look zooms or pans, which is meant as the window shows it. `listed` leaves room for the
    edit list. `brief` is for a frame or two.
    """

    def __init__(
        self,
        scene: Scene,
        size: tuple[int, int],
        look: Look,
        before: Canvas | None = None,
        *,
        both: bool = False,
        listed: bool = False,
        brief: bool = False,
    ) -> None:
        self._scene, self._look = scene, look
        self._made_for = (size, look, listed)
        whole = both or look.ghost or look.framed
        self._goal, self._other = _closures(scene, before) if whole else (scene, None)
        last: Painter | None = before.painter if before else None
        self.painter: Painter = Painter(
            scene, size, look, beside=self._other, before=last, listed=listed, brief=brief
        )

    def fits(self, scene: Scene, size: tuple[int, int], look: Look, *, listed: bool = False) -> bool:
        """Return whether it is made for these."""
        return self._scene is scene and self._made_for == (size, look, listed)

    def paint(self, surface: pygame.Surface, phase: float, speed: float, over: Overlay) -> Pose:
        """Paint a phase, the other closure behind it where the look asks; return its pose."""
        pose = self._scene.pose(phase, speed=speed)
        ghost = self._ghost.pose(phase, 0) if self._ghost else None
        self.painter.paint(surface, pose, over, ghost=ghost)
        return pose

    @cached_property
    def _ghost(self) -> Scene | None:
        if not self._look.ghost:
            return None
        return ghost_of(self._scene) if self._scene.towards else self._other


def _closures(scene: Scene, before: Canvas | None) -> tuple[Scene, Scene | None]:
    """Return the scene, or the one that it is on the way to, and its other closure."""
    goal = scene.towards or scene
    if before and before._goal is goal and before._other:
        return goal, before._other
    return goal, ghost_of(goal)
