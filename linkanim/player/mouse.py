"""The mouse: the wheel zooms, a drag pans, or moves the crank or the chart's cursor."""

from __future__ import annotations

from typing import Literal, Protocol

import pygame
from pygame.event import Event

from linkanim.player.action import Action
from linkanim.player.scrub import phase_towards
from linkanim.scenes.scene import Scene

_REACH = 0.035  # of the window's height


class Stage(Protocol):
    """What the mouse has to know of the picture under it, in pixels."""

    @property
    def scene(self) -> Scene:
        """The scene that is shown."""

    @property
    def phase(self) -> float:
        """The phase that is shown."""

    @property
    def size(self) -> tuple[int, int]:
        """The window's width and height."""

    def crank_pin(self) -> tuple[float, float]:
        """Return where the input crank's pin is."""

    def world(self, x: float, y: float) -> tuple[float, float]:
        """Return the point of the scene under a pixel."""

    def charted(self, x: float, y: float) -> float | None:
        """Return the phase under a pixel of the chart; None beside it."""

    @property
    def is_shelf_open(self) -> bool:
        """Whether the shelf lies over the picture."""

    def shelf_at(self, x: float, y: float) -> int | None:
        """Return the place on the open shelf under a pixel; None between its pictures."""


class Mouse:
    """Knows what is being dragged, and where the mouse was last."""

    def __init__(self) -> None:
        self._drag: Literal["pan", "crank", "chart"] | None = None
        self._at = (0.0, 0.0)

    def actions(self, event: Event, stage: Stage) -> tuple[Action, ...]:
        """Return what a mouse event asks for."""
        if stage.is_shelf_open:
            return self._on_the_shelf(event, stage)
        match event.type:
            case pygame.MOUSEWHEEL:
                return self._zoomed(event.y, stage) if event.y else ()
            case pygame.MOUSEBUTTONDOWN if event.button == 1:
                self._at = event.pos
                self._drag = self._grabbed(stage)
                return self._moved(stage) if self._drag == "chart" else ()
            case pygame.MOUSEBUTTONUP if event.button == 1:
                self._drag = None
            case pygame.MOUSEMOTION:
                before, self._at = self._at, event.pos
                return self._panned(before, stage) if self._drag == "pan" else self._moved(stage)
        return ()

    def _on_the_shelf(self, event: Event, stage: Stage) -> tuple[Action, ...]:
        """Choose the mechanism under the mouse; a click puts it on, and one beside closes the shelf."""
        self._drag = None
        if event.type not in (pygame.MOUSEMOTION, pygame.MOUSEBUTTONDOWN):
            return ()
        self._at = event.pos
        place = stage.shelf_at(*self._at)
        if event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
            return (Action("shelf") if place is None else Action("put", place),)
        return () if place is None else (Action("point", place),)

    def _grabbed(self, stage: Stage) -> Literal["pan", "crank", "chart"]:
        pin = stage.crank_pin()
        if max(abs(self._at[0] - pin[0]), abs(self._at[1] - pin[1])) <= _REACH * stage.size[1]:
            return "crank"
        return "pan" if stage.charted(*self._at) is None else "chart"

    def _zoomed(self, notches: float, stage: Stage) -> tuple[Action, ...]:
        x, y = (at - side / 2 for at, side in zip(self._at, stage.size, strict=True))
        return (Action("zoom", (float(notches), x / stage.size[1], y / stage.size[1])),)

    def _panned(self, before: tuple[float, float], stage: Stage) -> tuple[Action, ...]:
        x, y = (now - then for now, then in zip(self._at, before, strict=True))
        return (Action("pan", (x / stage.size[1], y / stage.size[1])),)

    def _moved(self, stage: Stage) -> tuple[Action, ...]:
        if self._drag == "crank":
            return (Action("scrub", phase_towards(stage.scene, stage.phase, stage.world(*self._at))),)
        phase = stage.charted(*self._at) if self._drag == "chart" else None
        return () if phase is None else (Action("scrub", phase),)
