"""The mouse: the wheel zooms, a drag pans, or moves the crank, the chart's cursor, a joint or a value."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import zip_longest
from typing import Literal, NamedTuple

import pygame
from pygame.event import Event

from linkanim.player.state.action import Action
from linkanim.player.state.tools import TOOLS
from linkanim.player.window.screen import Screen
from linkanim.scenes.steering import phase_towards

_REACH = 0.035  # of the window's height
_TENTHS = 0.1
_PULL = 0.011
"""How far a value is dragged for a step, in the window's height."""
_COARSE = 10
Drag = Literal["pan", "crank", "chart", "joint", "row", "pen", "lead", "hand", "paper"]
_KINDS: Mapping[int, Literal["wheel", "down", "up", "move"]] = {
    pygame.MOUSEWHEEL: "wheel",
    pygame.MOUSEBUTTONDOWN: "down",
    pygame.MOUSEBUTTONUP: "up",
    pygame.MOUSEMOTION: "move",
}
MOUSE_EVENTS = tuple(_KINDS)
_STILL = 0.006
"""How far the hand may move in a click on paper, in the window's height."""
_PENCIL: Mapping[str, Drag] = {"pen_down": "pen", "take_point": "lead", "take_pivot": "lead"}
"""What the mouse does on while its button is down, by what the pencil has begun."""


def latest(events: list[Event]) -> list[Event]:
    """Return the events without those of a mouse that moved on in the same frame."""
    pairs = zip_longest(events, events[1:])
    return [one for one, then in pairs if then is None or not one.type == then.type == pygame.MOUSEMOTION]


class Gesture(NamedTuple):
    """What the left button or the wheel did: notches away, and how far the mouse moved, in window heights."""

    kind: Literal["wheel", "down", "up", "move"]
    notches: int
    by: tuple[float, float]


class Mouse:
    """Knows what is being dragged from where and how far, and where the mouse was last, in pixels."""

    def __init__(self) -> None:
        self._drag: Drag | None = None
        self._at = self._begun = (0.0, 0.0)
        self._far, self._steps = 0.0, 0
        self._turned: int | None = None
        self._seen = False

    def actions(self, event: Event, screen: Screen) -> tuple[Action, ...]:
        """Return what a mouse event asks for."""
        kind, notches, (x, y) = _KINDS[event.type], getattr(event, "y", 0), self._at
        self._seen = self._seen or kind in ("move", "down")
        if getattr(event, "button", 1) != 1 or (kind == "wheel" and not notches):
            return ()
        self._at = getattr(event, "pos", self._at)
        if kind == "down":
            self._begun, self._far = self._at, 0.0
        self._far = max(self._far, math.dist(self._begun, self._at))
        height = screen.size[1]
        gesture = Gesture(kind, notches, ((self._at[0] - x) / height, (self._at[1] - y) / height))
        if screen.state.browsing:
            return self._on_the_shelf(gesture, screen)
        modes = {"build": self._of_the_sheet, "pencil": self._of_the_pencil, "game": self._in_a_game}
        mode = modes.get(screen.state.mode)
        found = mode(gesture, screen) if mode else None
        found = self._on_a_list(gesture, screen) if found is None else found
        return self._on_the_picture(gesture, screen) if found is None else found

    def _on_the_picture(self, gesture: Gesture, screen: Screen) -> tuple[Action, ...]:
        """Zoom, pan, or drag what is under the mouse."""
        match gesture.kind:
            case "wheel":
                return self._zoomed(gesture.notches, screen)
            case "down":
                handle = screen.handle_at(*self._at, _REACH * screen.size[1])
                self._drag = "joint" if handle else self._grabbed(screen)
                if handle:
                    return (Action("grab", handle),)
                return self._moved(screen) if self._drag == "chart" else ()
            case "up":
                held, self._drag = self._drag, None
                return (Action("drop"),) if held == "joint" else ()
        return (Action("pan", gesture.by),) if self._drag == "pan" else self._moved(screen)

    def _on_a_list(self, gesture: Gesture, screen: Screen) -> tuple[Action, ...] | None:
        """Return what is asked of the open list: a click, the wheel, a value dragged; None beside it."""
        if self._drag == "row" and gesture.kind in ("move", "up"):
            return self._pulled(gesture, screen)
        row = screen.row_at(*self._at) if self._drag in (None, "row") else None
        if row is None:
            return None
        editing = screen.state.mode == "edit"
        if gesture.kind == "wheel":
            # A list that is longer than its room moves on below a mouse that stands still.
            self._turned = row if self._turned is None else self._turned
            return self._wheeled(gesture.notches, self._turned, editing=editing)
        self._turned = None
        if gesture.kind != "down" or row < 0:
            return ()
        if not editing:
            return (Action("pick", row),)
        self._drag, self._steps = "row", 0
        return (Action("grab_row", row),)

    def _in_a_game(self, gesture: Gesture, screen: Screen) -> tuple[Action, ...] | None:
        """Return what a click asks of a game: the answer that is there, else to go on.

        The crank pin is dragged as without a game.
        """
        if gesture.kind != "down" or self._drag is not None:
            return None
        option = screen.option_at(*self._at)
        if option is None and (screen.over.handles or self._is_at_pin(screen)):
            return None
        return (Action("next") if option is None else Action("option", option),)

    def _wheeled(self, notches: int, row: int, *, editing: bool) -> tuple[Action, ...]:
        """Nudge the value under the mouse; beside the values, and in the list of quantities, choose."""
        if editing and row >= 0:
            return (Action("grab_row", row), Action("drop"), Action("nudge", notches * _coarser()))
        return (Action("choose" if editing else "move", -notches),)

    def _pulled(self, gesture: Gesture, screen: Screen) -> tuple[Action, ...]:
        """Change the value of the row that is held by how far the mouse has gone to the right."""
        if gesture.kind == "up":
            self._drag = None
            return (Action("drop"),)
        before, self._steps = self._steps, round((self._at[0] - self._begun[0]) / (_PULL * screen.size[1]))
        return (Action("pull", self._steps * _coarser()),) if self._steps != before else ()

    def pointed(self, screen: Screen) -> int | None:
        """Return the row of the open list that the mouse is over; None before the mouse was seen."""
        if not self._seen or self._drag not in (None, "row") or screen.state.browsing:
            return None
        found = screen.option_at if screen.state.mode == "game" else screen.row_at
        row = found(*self._at)
        return row if row is not None and row >= 0 else None

    def hovered(self, screen: Screen) -> str | None:
        """Return the joint under the mouse that can be dragged; None before the mouse was seen."""
        if not self._seen or screen.state.browsing or self._drag in ("pan", "chart", "row"):
            return None
        on_a_list = self._drag is None and screen.row_at(*self._at) is not None
        if on_a_list or screen.state.mode in ("pencil", "build"):
            return None
        at_pin = screen.state.scene.linkage.drive.joint if self._is_at_pin(screen) else None
        return screen.handle_at(*self._at, _REACH * screen.size[1]) or at_pin

    def _is_at_pin(self, screen: Screen) -> bool:
        pin = screen.crank_pin()
        return max(abs(self._at[0] - pin[0]), abs(self._at[1] - pin[1])) <= _REACH * screen.size[1]

    def _on_the_shelf(self, gesture: Gesture, screen: Screen) -> tuple[Action, ...]:
        """Choose the mechanism under the mouse; a click puts it on, and one beside closes the shelf."""
        self._drag = None
        if gesture.kind == "wheel":
            return (Action("scroll", -gesture.notches),)
        place = screen.shelf_at(*self._at)
        if gesture.kind == "down":
            return (Action("shelf") if place is None else Action("put", place),)
        return () if place is None or gesture.kind == "up" else (Action("point", place),)

    def _of_the_pencil(self, gesture: Gesture, screen: Screen) -> tuple[Action, ...] | None:
        """Draw, or drag what is under the pencil; None for what the mouse does without one."""
        reach = _REACH * screen.size[1]
        if gesture.kind == "down" and screen.charted(*self._at) is None:
            begun = screen.pencil_at(*self._at, reach)
            self._drag = _PENCIL.get(begun.name)
            return (begun,)
        if self._drag not in ("pen", "lead") or gesture.kind not in ("move", "up"):
            return None
        if gesture.kind == "move":
            return (Action("pen_to" if self._drag == "pen" else "lead", screen.world(*self._at)),)
        drag, self._drag = self._drag, None
        drawn = "pen_up" if self._far > reach else "pen_off"
        return (Action(drawn if drag == "pen" else "let_go"),)

    def _of_the_sheet(self, gesture: Gesture, screen: Screen) -> tuple[Action, ...] | None:
        """Draw on the sheet, take a tool, turn the crank, or shift the paper; None for what else there is."""
        if gesture.kind == "down" and screen.charted(*self._at) is None:
            tool = screen.tool_at(*self._at)
            self._drag = screen.sheet_at(*self._at) if tool is None else None
            if tool is not None:
                return (Action(TOOLS[tool].action, TOOLS[tool].value),)
            return (self._handed("hand_down", screen),) if self._drag == "hand" else ()
        if self._drag not in ("hand", "paper") or gesture.kind not in ("move", "up"):
            return None
        drag, stays = self._drag, self._far <= _STILL * screen.size[1]
        if gesture.kind == "move":
            if drag == "hand":
                return (self._handed("hand_to", screen),)
            return () if stays else (Action("pan", gesture.by),)
        self._drag = None
        if drag == "hand":
            return (Action("hand_up"),)
        return (self._handed("hand_down", screen), Action("hand_up")) if stays else ()

    def _handed(self, name: str, screen: Screen) -> Action:
        """Return what the hand does on the sheet: in tenths of the usual step with Shift, in any with Alt."""
        mods = pygame.key.get_mods()
        part = 0.0 if mods & pygame.KMOD_ALT else _TENTHS if mods & pygame.KMOD_SHIFT else 1.0
        return Action(name, screen.handed(*self._at, part))

    def over_sheet(self, screen: Screen) -> tuple[float, float] | None:
        """Return where the mouse is over an open sheet, in pixels; None elsewhere, and before it was seen."""
        shown = self._seen and screen.state.mode == "build" and self._drag in (None, "hand")
        return self._at if shown else None

    def _grabbed(self, screen: Screen) -> Literal["pan", "crank", "chart"]:
        if self._is_at_pin(screen):
            return "crank"
        return "pan" if screen.charted(*self._at) is None else "chart"

    def _zoomed(self, notches: float, screen: Screen) -> tuple[Action, ...]:
        """Zoom about the mouse; about the middle before it is known where that is."""
        middle = screen.size[0] / 2, screen.size[1] / 2
        x, y = (at - half for at, half in zip(self._at if self._seen else middle, middle, strict=True))
        return (Action("zoom", (float(notches), x / screen.size[1], y / screen.size[1])),)

    def _moved(self, screen: Screen) -> tuple[Action, ...]:
        if self._drag == "joint":
            fine = _TENTHS if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1.0
            return (Action("carry", (*screen.world(*self._at), fine)),)
        phase = screen.charted(*self._at) if self._drag == "chart" else None
        if self._drag == "crank":
            phase = phase_towards(screen.state.displayed, screen.state.phase, screen.world(*self._at))
        return () if phase is None else (Action("scrub", phase),)


def _coarser() -> int:
    """Return how many steps one stands for: more with Shift."""
    return _COARSE if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1
