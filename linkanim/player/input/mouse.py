"""The mouse: the wheel zooms, a drag pans, or moves the crank, the chart's cursor or a joint."""

from __future__ import annotations

from itertools import zip_longest
from typing import Literal, Protocol

import pygame
from pygame.event import Event

from linkanim.player.input.scrub import phase_towards
from linkanim.player.state.action import Action
from linkanim.scenes.scene import Scene

_REACH = 0.035  # of the window's height
_TENTHS = 0.1


def latest(events: list[Event]) -> list[Event]:
    """Return the events without those of a mouse that moved on in the same frame."""
    pairs = zip_longest(events, events[1:])
    return [one for one, then in pairs if then is None or not one.type == then.type == pygame.MOUSEMOTION]


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

    def handle_at(self, x: float, y: float, reach: float) -> str | None:
        """Return the joint under a pixel that can be dragged while the list is open; None elsewhere."""

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
        self._drag: Literal["pan", "crank", "chart", "joint"] | None = None
        self._at = (0.0, 0.0)
        self._seen = False

    def actions(self, event: Event, stage: Stage) -> tuple[Action, ...]:
        """Return what a mouse event asks for."""
        self._seen = self._seen or event.type in (pygame.MOUSEMOTION, pygame.MOUSEBUTTONDOWN)
        if stage.is_shelf_open:
            return self._on_the_shelf(event, stage)
        match event.type:
            case pygame.MOUSEWHEEL:
                return self._zoomed(event.y, stage) if event.y else ()
            case pygame.MOUSEBUTTONDOWN if event.button == 1:
                self._at = event.pos
                handle = stage.handle_at(*self._at, _REACH * stage.size[1])
                self._drag = "joint" if handle else self._grabbed(stage)
                if handle:
                    return (Action("grab", handle),)
                return self._moved(stage) if self._drag == "chart" else ()
            case pygame.MOUSEBUTTONUP if event.button == 1:
                held, self._drag = self._drag, None
                return (Action("drop"),) if held == "joint" else ()
            case pygame.MOUSEMOTION:
                before, self._at = self._at, event.pos
                return self._panned(before, stage) if self._drag == "pan" else self._moved(stage)
        return ()

    def hovered(self, stage: Stage) -> str | None:
        """Return the joint under the mouse that can be dragged; None before the mouse was seen."""
        if not self._seen or stage.is_shelf_open or self._drag in ("pan", "chart"):
            return None
        return stage.handle_at(*self._at, _REACH * stage.size[1]) or (
            stage.scene.linkage.drive.joint if self._is_at_pin(stage) else None
        )

    def _is_at_pin(self, stage: Stage) -> bool:
        pin = stage.crank_pin()
        return max(abs(self._at[0] - pin[0]), abs(self._at[1] - pin[1])) <= _REACH * stage.size[1]

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
        if self._is_at_pin(stage):
            return "crank"
        return "pan" if stage.charted(*self._at) is None else "chart"

    def _zoomed(self, notches: float, stage: Stage) -> tuple[Action, ...]:
        """Zoom about the mouse; about the middle before it is known where that is."""
        middle = stage.size[0] / 2, stage.size[1] / 2
        x, y = (at - half for at, half in zip(self._at if self._seen else middle, middle, strict=True))
        return (Action("zoom", (float(notches), x / stage.size[1], y / stage.size[1])),)

    def _panned(self, before: tuple[float, float], stage: Stage) -> tuple[Action, ...]:
        x, y = (now - then for now, then in zip(self._at, before, strict=True))
        return (Action("pan", (x / stage.size[1], y / stage.size[1])),)

    def _moved(self, stage: Stage) -> tuple[Action, ...]:
        if self._drag == "crank":
            return (Action("scrub", phase_towards(stage.scene, stage.phase, stage.world(*self._at))),)
        if self._drag == "joint":
            fine = _TENTHS if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1.0
            return (Action("carry", (*stage.world(*self._at), fine)),)
        phase = stage.charted(*self._at) if self._drag == "chart" else None
        return () if phase is None else (Action("scrub", phase),)
