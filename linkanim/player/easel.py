"""The easel: the painter that fits the scene, size and look of the moment, and what it painted last."""

from __future__ import annotations

from functools import cached_property

import pygame

from linkanim.mechanics.motion import Pose
from linkanim.picture.look import Look
from linkanim.picture.overlay import Overlay
from linkanim.picture.painter import Painter
from linkanim.player import display
from linkanim.player.assembly import ghost_of
from linkanim.player.state import State
from linkanim.scenes.scene import Scene

_SMALLEST = 32


class Setting:
    """A painter with the scene of its ghost, made for one scene, size and look; it follows `before`."""

    def __init__(
        self, scene: Scene, size: tuple[int, int], look: Look, before: Setting | None = None
    ) -> None:
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


class Easel:
    """Paints states into the window; a picture that is there already is not painted again.

    For the mouse it knows where things are in the picture it painted last.
    """

    def __init__(self, state: State) -> None:
        self._setting: Setting | None = None
        self._shown: object = None
        self._state = state
        self._titled: str | None = None

    def show(self, state: State, over: Overlay) -> None:
        """Paint the state into the window and flip, where it differs from what is there."""
        surface = display.surface()
        if min(surface.get_size()) < _SMALLEST:
            return
        self._state = state
        self._name(state.scene.title)
        setting = self._fitting(state, surface.get_size())
        picture = (setting, state.phase, state.clock.speed, over)
        if picture != self._shown:
            setting.paint(surface, state.phase, state.clock.speed, over)
            pygame.display.flip()
            self._shown = picture

    def _name(self, title: str) -> None:
        """Let the window bear the scene's title; the system is told only what is new to it."""
        if title != self._titled:
            display.name(title)
            self._titled = title

    def uncovered(self) -> None:
        """Take note that the window has to be painted anew."""
        self._shown = None

    def picture(self, state: State, over: Overlay) -> pygame.Surface:
        """Return the state painted on a surface of its own, as large as the window."""
        surface = display.surface().copy()
        setting = self._fitting(state, surface.get_size())
        setting.paint(surface, state.phase, state.clock.speed, over)
        return surface

    def _fitting(self, state: State, size: tuple[int, int]) -> Setting:
        if self._setting is None or self._setting.made_for != (id(state.shown), size, state.look):
            self._setting = Setting(state.shown, size, state.look, self._setting)
        return self._setting

    @property
    def scene(self) -> Scene:
        """The scene that is shown."""
        return self._state.shown

    @property
    def phase(self) -> float:
        """The phase that is shown."""
        return self._state.phase

    @property
    def size(self) -> tuple[int, int]:
        """The window's size."""
        return pygame.display.get_window_size()

    def crank_pin(self) -> tuple[float, float]:
        """Return where the input crank's pin is, in pixels."""
        return self._painter.crank_pin_px(self.scene.pose(self.phase, 0))

    def world(self, x: float, y: float) -> tuple[float, float]:
        """Return the point of the scene under a pixel."""
        return self._painter.view.to_world(x, y)

    def pixel(self, x: float, y: float) -> tuple[float, float]:
        """Return where a point of the scene is in the window."""
        return self._painter.view.to_pixel(x, y)

    def charted(self, x: float, y: float) -> float | None:
        """Return the phase under a pixel of the chart; None beside it."""
        return self._painter.chart_phase_at(x, y)

    @property
    def _painter(self) -> Painter:
        assert self._setting is not None
        return self._setting.painter
