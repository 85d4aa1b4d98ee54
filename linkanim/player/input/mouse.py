"""The mouse: the wheel zooms, a drag pans, or moves the crank, the chart's cursor, a joint or a value."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import zip_longest
from typing import Literal, Protocol

import pygame
from pygame.event import Event

from linkanim.player.input.steering import phase_towards
from linkanim.player.state.action import Action, Mode
from linkanim.player.state.tools import TOOLS
from linkanim.scenes.scene import Scene

_REACH = 0.035  # of the window's height
_TENTHS = 0.1
_PULL = 0.011
"""How far a value is dragged for a step, in the window's height."""
_COARSE = 10
Drag = Literal["pan", "crank", "chart", "joint", "row", "pen", "lead", "hand", "paper"]
_STILL = 0.006
"""How far the hand may move in a click on paper, in the window's height."""
_PENCIL: Mapping[str, Drag] = {"pen_down": "pen", "take_point": "lead", "take_pivot": "lead"}
"""What the mouse does on while its button is down, by what the pencil has begun."""


def latest(events: list[Event]) -> list[Event]:
    """Return the events without those of a mouse that moved on in the same frame."""
    pairs = zip_longest(events, events[1:])
    return [one for one, then in pairs if then is None or not one.type == then.type == pygame.MOUSEMOTION]


class MouseTarget(Protocol):
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

    @property
    def has_handles(self) -> bool:
        """Whether a game has joints to drag: a click beside them is none to go on."""

    def world(self, x: float, y: float) -> tuple[float, float]:
        """Return the point of the scene under a pixel."""

    def charted(self, x: float, y: float) -> float | None:
        """Return the phase under a pixel of the chart; None beside it."""

    def pencil_at(self, x: float, y: float, reach: float) -> Action:
        """Return what the pencil begins at a pixel."""

    def sheet_at(self, x: float, y: float) -> Literal["hand", "crank", "paper"]:
        """Return what the hand does at a pixel of a sheet: it draws, turns the crank, shifts the paper."""

    def tool_at(self, x: float, y: float) -> int | None:
        """Return the number of the tool of the sheet under a pixel; None beside them."""

    def handed(self, x: float, y: float, part: float) -> tuple[float, float, float, float]:
        """Return a place of the sheet, how near counts as on it, and the usual step times a part."""

    @property
    def is_shelf_open(self) -> bool:
        """Whether the shelf lies over the picture."""

    @property
    def mode(self) -> Mode:
        """What the keys are for, and whether a list is open."""

    def option_at(self, x: float, y: float) -> int | None:
        """Return the answer of a game under a pixel, in its panel or on the picture; None off them."""

    def row_at(self, x: float, y: float) -> int | None:
        """Return the row of the open list under a pixel, -1 on the list beside them; None off it."""

    def shelf_at(self, x: float, y: float) -> int | None:
        """Return the place on the open shelf under a pixel; None between its pictures."""


class Mouse:
    """Knows what is being dragged, and where the mouse was last."""

    def __init__(self) -> None:
        self._drag: Drag | None = None
        self._taken, self._steps = 0.0, 0
        self._turned: int | None = None
        self._at = (0.0, 0.0)
        self._begun, self._far = self._at, 0.0
        self._seen = False

    def actions(self, event: Event, target: MouseTarget) -> tuple[Action, ...]:
        """Return what a mouse event asks for."""
        self._seen = self._seen or event.type in (pygame.MOUSEMOTION, pygame.MOUSEBUTTONDOWN)
        if target.is_shelf_open:
            return self._on_the_shelf(event, target)
        if target.mode == "build" and (found := self._of_the_sheet(event, target)) is not None:
            return found
        if target.mode == "pencil" and (found := self._of_the_pencil(event, target)) is not None:
            return found
        if target.mode == "game" and self._drag is None and (found := self._in_a_game(event, target)):
            return found
        if self._drag in (None, "row") and (found := self._on_a_list(event, target)) is not None:
            return found
        match event.type:
            case pygame.MOUSEWHEEL:
                return self._zoomed(event.y, target) if event.y else ()
            case pygame.MOUSEBUTTONDOWN if event.button == 1:
                self._at = event.pos
                handle = target.handle_at(*self._at, _REACH * target.size[1])
                self._drag = "joint" if handle else self._grabbed(target)
                if handle:
                    return (Action("grab", handle),)
                return self._moved(target) if self._drag == "chart" else ()
            case pygame.MOUSEBUTTONUP if event.button == 1:
                held, self._drag = self._drag, None
                return (Action("drop"),) if held == "joint" else ()
            case pygame.MOUSEMOTION:
                before, self._at = self._at, event.pos
                return self._panned(before, target) if self._drag == "pan" else self._moved(target)
        return ()

    def _on_a_list(self, event: Event, target: MouseTarget) -> tuple[Action, ...] | None:
        """Return what is asked of the open list: a click, the wheel, a value dragged; None beside it."""
        at = getattr(event, "pos", self._at)
        if self._drag == "row" and event.type in (pygame.MOUSEMOTION, pygame.MOUSEBUTTONUP):
            self._at = at
            return self._pulled(event, target)
        row = target.row_at(*at)
        if row is None:
            return None
        self._at, editing = at, target.mode == "edit"
        if event.type == pygame.MOUSEWHEEL:
            # A list that is longer than its room moves on below a mouse that stands still.
            self._turned = row if self._turned is None else self._turned
            return self._wheeled(event.y, self._turned, editing=editing) if event.y else ()
        self._turned = None
        if event.type != pygame.MOUSEBUTTONDOWN or event.button != 1 or row < 0:
            return ()
        if not editing:
            return (Action("pick", row),)
        self._drag, self._taken, self._steps = "row", self._at[0], 0
        return (Action("grab_row", row),)

    def _in_a_game(self, event: Event, target: MouseTarget) -> tuple[Action, ...]:
        """Return what a click asks of a game: the answer that is there, else to go on.

        The crank pin is dragged as without a game.
        """
        if event.type != pygame.MOUSEBUTTONDOWN or event.button != 1:
            return ()
        self._at = event.pos
        option = target.option_at(*self._at)
        if option is None and (target.has_handles or self._is_at_pin(target)):
            return ()
        return (Action("next") if option is None else Action("option", option),)

    def _wheeled(self, notches: int, row: int, *, editing: bool) -> tuple[Action, ...]:
        """Nudge the value under the mouse; beside the values, and in the list of quantities, choose."""
        if editing and row >= 0:
            return (Action("grab_row", row), Action("drop"), Action("nudge", notches * _coarser()))
        return (Action("choose" if editing else "move", -notches),)

    def _pulled(self, event: Event, target: MouseTarget) -> tuple[Action, ...]:
        """Change the value of the row that is held by how far the mouse has gone to the right."""
        if event.type == pygame.MOUSEBUTTONUP:
            self._drag = None
            return (Action("drop"),)
        before, self._steps = self._steps, round((self._at[0] - self._taken) / (_PULL * target.size[1]))
        return (Action("pull", self._steps * _coarser()),) if self._steps != before else ()

    def pointed(self, target: MouseTarget) -> int | None:
        """Return the row of the open list that the mouse is over; None before the mouse was seen."""
        if not self._seen or self._drag not in (None, "row") or target.is_shelf_open:
            return None
        found = target.option_at if target.mode == "game" else target.row_at
        row = found(*self._at)
        return row if row is not None and row >= 0 else None

    def hovered(self, target: MouseTarget) -> str | None:
        """Return the joint under the mouse that can be dragged; None before the mouse was seen."""
        if not self._seen or target.is_shelf_open or self._drag in ("pan", "chart", "row"):
            return None
        if target.mode in ("pencil", "build") or (
            self._drag is None and target.row_at(*self._at) is not None
        ):
            return None
        return target.handle_at(*self._at, _REACH * target.size[1]) or (
            target.scene.linkage.drive.joint if self._is_at_pin(target) else None
        )

    def _is_at_pin(self, target: MouseTarget) -> bool:
        pin = target.crank_pin()
        return max(abs(self._at[0] - pin[0]), abs(self._at[1] - pin[1])) <= _REACH * target.size[1]

    def _on_the_shelf(self, event: Event, target: MouseTarget) -> tuple[Action, ...]:
        """Choose the mechanism under the mouse; a click puts it on, and one beside closes the shelf."""
        self._drag = None
        if event.type == pygame.MOUSEWHEEL:
            return (Action("scroll", -event.y),) if event.y else ()
        if event.type not in (pygame.MOUSEMOTION, pygame.MOUSEBUTTONDOWN):
            return ()
        self._at = event.pos
        place = target.shelf_at(*self._at)
        if event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
            return (Action("shelf") if place is None else Action("put", place),)
        return () if place is None else (Action("point", place),)

    def _of_the_pencil(self, event: Event, target: MouseTarget) -> tuple[Action, ...] | None:
        """Draw, or drag what is under the pencil; None for what the mouse does without one."""
        at: tuple[float, float] = getattr(event, "pos", self._at)
        if event.type == pygame.MOUSEBUTTONDOWN and event.button == 1 and target.charted(*at) is None:
            begun = target.pencil_at(*at, _REACH * target.size[1])
            self._drag, self._at, self._begun, self._far = _PENCIL.get(begun.name), at, at, 0.0
            return (begun,)
        if self._drag not in ("pen", "lead"):
            return None
        if event.type == pygame.MOUSEMOTION:
            self._far, self._at = max(self._far, math.dist(self._begun, at)), at
            return (Action("pen_to" if self._drag == "pen" else "lead", target.world(*at)),)
        if event.type == pygame.MOUSEBUTTONUP and event.button == 1:
            drag, self._drag = self._drag, None
            drawn = "pen_up" if self._far > _REACH * target.size[1] else "pen_off"
            return (Action(drawn if drag == "pen" else "let_go"),)
        return None

    def _of_the_sheet(self, event: Event, target: MouseTarget) -> tuple[Action, ...] | None:
        """Draw on the sheet, take a tool, turn the crank, or shift the paper; None for what else there is."""
        at: tuple[float, float] = getattr(event, "pos", self._at)
        if event.type == pygame.MOUSEBUTTONDOWN and event.button == 1 and target.charted(*at) is None:
            self._at, self._begun, self._far, self._drag = at, at, 0.0, None
            if (tool := target.tool_at(*at)) is not None:
                return (Action(TOOLS[tool].action, TOOLS[tool].value),)
            self._drag = target.sheet_at(*at)
            return (Action("hand_down", target.handed(*at, _step())),) if self._drag == "hand" else ()
        if self._drag not in ("hand", "paper"):
            return None
        if event.type == pygame.MOUSEMOTION:
            before, self._at = self._at, at
            self._far = max(self._far, math.dist(self._begun, at))
            if self._drag == "hand":
                return (Action("hand_to", target.handed(*at, _step())),)
            return self._panned(before, target) if self._far > _STILL * target.size[1] else ()
        if event.type == pygame.MOUSEBUTTONUP and event.button == 1:
            drag, self._drag = self._drag, None
            if drag == "hand":
                return (Action("hand_up"),)
            stayed = self._far <= _STILL * target.size[1]
            return (Action("hand_down", target.handed(*at, _step())), Action("hand_up")) if stayed else ()
        return None

    def over_sheet(self, target: MouseTarget) -> tuple[float, float] | None:
        """Return where the mouse is over an open sheet, in pixels; None elsewhere, and before it was seen."""
        shown = self._seen and target.mode == "build" and self._drag in (None, "hand")
        return self._at if shown else None

    def _grabbed(self, target: MouseTarget) -> Literal["pan", "crank", "chart"]:
        if self._is_at_pin(target):
            return "crank"
        return "pan" if target.charted(*self._at) is None else "chart"

    def _zoomed(self, notches: float, target: MouseTarget) -> tuple[Action, ...]:
        """Zoom about the mouse; about the middle before it is known where that is."""
        middle = target.size[0] / 2, target.size[1] / 2
        x, y = (at - half for at, half in zip(self._at if self._seen else middle, middle, strict=True))
        return (Action("zoom", (float(notches), x / target.size[1], y / target.size[1])),)

    def _panned(self, before: tuple[float, float], target: MouseTarget) -> tuple[Action, ...]:
        x, y = (now - then for now, then in zip(self._at, before, strict=True))
        return (Action("pan", (x / target.size[1], y / target.size[1])),)

    def _moved(self, target: MouseTarget) -> tuple[Action, ...]:
        if self._drag == "crank":
            return (Action("scrub", phase_towards(target.scene, target.phase, target.world(*self._at))),)
        if self._drag == "joint":
            fine = _TENTHS if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1.0
            return (Action("carry", (*target.world(*self._at), fine)),)
        phase = target.charted(*self._at) if self._drag == "chart" else None
        return () if phase is None else (Action("scrub", phase),)


def _step() -> float:
    """Return which part of the usual step the hand draws in: tenths with Shift, 0 for any with Alt."""
    mods = pygame.key.get_mods()
    return 0.0 if mods & pygame.KMOD_ALT else _TENTHS if mods & pygame.KMOD_SHIFT else 1.0


def _coarser() -> int:
    """Return how many steps one stands for: more with Shift."""
    return _COARSE if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1
