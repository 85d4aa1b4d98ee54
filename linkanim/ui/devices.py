"""Turn events of the devices into actions: keyboard, fingers, gamepads, mouse.

A held key repeats. Fingers act as the mouse. A gamepad's buttons are keys. The wheel zooms, and a drag
pans or moves the crank, the chart's cursor, a joint or a value.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from contextlib import suppress
from itertools import zip_longest
from math import dist, isnan, log
from typing import Literal

import pygame
from pygame.event import Event

from linkanim.player.action import Action
from linkanim.player.commands import line_asks, pressed, slid, slides
from linkanim.player.hand import Drag, Gesture
from linkanim.player.keys import Bind, ModeKeys, Press
from linkanim.player.state import NEAR_HAND, REACH, STILL, State
from linkanim.scenes.editing import phase_towards
from linkanim.ui.pointing import NOWHERE, AtMouse, Pointed, led, row_asks, speed_rows
from linkanim.ui.screen import Screen

# The keyboard: key events become presses, and a held key an action that repeats.

_WAIT = 24
_EVERY = 3


def code(name: str) -> int:
    """Return pygame's number for a key of the table; for a printable key, that of its character."""
    return ord(name) if len(name) == 1 else int(getattr(pygame, f"K_{name.upper()}"))


class Repeats:
    """An action that repeats while a key, or a gamepad's button, is held: the one that went down last."""

    def __init__(self) -> None:
        self._action: Action | None = None
        self._next = 0
        self._key: int | None = None

    def begin(self, bind: Bind | None, frame: int, key: int | None = None) -> None:
        """Begin to repeat the action of a bind, if it is one that repeats; else repeat nothing."""
        self._action = bind.action if bind and bind.repeats else None
        self._next, self._key = frame + _WAIT, key

    def due(self, frame: int) -> tuple[Action, ...]:
        """Return the action when it is due again; none once its key is no longer held."""
        if self._action is None or frame < self._next:
            return ()
        if self._key is not None and not pygame.key.get_pressed()[self._key]:
            self._action = None
            return ()
        self._next = frame + _EVERY
        return (self._action,)


class Keyboard:
    """Knows the bound keys by their names."""

    def __init__(self, names: Iterable[str]) -> None:
        self._names = {code(name): name for name in names}

    def press(self, event: Event) -> Press | None:
        """Return what a KEYDOWN means; None with Alt or the system's key, which the window does not use."""
        mod = getattr(event, "mod", 0)
        if mod & (pygame.KMOD_ALT | pygame.KMOD_META) and not mod & pygame.KMOD_MODE:
            return None
        text = getattr(event, "unicode", "")
        shift, ctrl = bool(mod & pygame.KMOD_SHIFT), bool(mod & pygame.KMOD_CTRL)
        return Press(self._names.get(event.key, ""), text if text.isprintable() else "", shift, ctrl)


# Fingers as the mouse: the first one is its left button, two of them turn its wheel.

FINGERS = (pygame.FINGERDOWN, pygame.FINGERMOTION, pygame.FINGERUP)
_MOUSE = (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP, pygame.MOUSEMOTION)
_NOTCH = 1.1
"""The factor in the distance of two fingers that counts as a notch of the wheel."""

Place = tuple[int, int]


class Fingers:
    """Knows the fingers that are down, and which of them is the pointer."""

    def __init__(self) -> None:
        self._down: dict[int, Place] = {}
        self._pointer: int | None = None
        self._apart = 0.0

    def pointed(self, events: list[Event], size: tuple[int, int]) -> list[Event]:
        """Return the events with finger events turned into mouse events, in a window of that size.

        Mouse events that the system itself made of fingers are left out; they have a mark.
        """
        pointed: list[Event] = []
        for event in events:
            if event.type in FINGERS:
                pointed += self._of_finger(event, size)
            elif event.type not in _MOUSE or not getattr(event, "touch", False):
                pointed.append(event)
        return pointed

    def _of_finger(self, event: Event, size: tuple[int, int]) -> list[Event]:
        at = _pixel(event, size) or self._down.get(event.finger_id)
        if at is None:
            return []
        if event.type == pygame.FINGERDOWN:
            return self._put(event.finger_id, at)
        if event.type == pygame.FINGERUP:
            return self._lifted(event.finger_id, at)
        if event.finger_id not in self._down:
            return []
        self._down[event.finger_id] = at
        if len(self._down) > 1:
            return self._pinched()
        return [_mouse(pygame.MOUSEMOTION, at)] if event.finger_id == self._pointer else []

    def _put(self, finger: int, at: Place) -> list[Event]:
        """Return the button pressed by the first finger, or released by the second."""
        self._down[finger] = at
        if len(self._down) == 1:
            self._pointer = finger
            return [_mouse(pygame.MOUSEMOTION, at), _mouse(pygame.MOUSEBUTTONDOWN, at)]
        held, self._pointer, self._apart = self._pointer, None, self._spread
        if held in self._down and held != finger:
            return [_mouse(pygame.MOUSEBUTTONUP, self._down[held])]
        return []

    def _lifted(self, finger: int, at: Place) -> list[Event]:
        self._down.pop(finger, None)
        self._apart = self._spread
        if finger != self._pointer:
            return []
        self._pointer = None
        return [_mouse(pygame.MOUSEBUTTONUP, at)]

    def _pinched(self) -> list[Event]:
        """Return the wheel turned by the fingers' distance, about their middle."""
        notches = round(log(self._spread / self._apart, _NOTCH)) if self._apart and self._spread else 0
        if not notches:
            return []
        self._apart = self._spread
        (x0, y0), (x1, y1), *_ = self._down.values()
        middle = _mouse(pygame.MOUSEMOTION, ((x0 + x1) // 2, (y0 + y1) // 2))
        return [middle, Event(pygame.MOUSEWHEEL, x=0, y=notches)]

    @property
    def _spread(self) -> float:
        places = [*self._down.values()]
        return dist(*places[:2]) if len(places) > 1 else 0.0


def _pixel(event: Event, size: tuple[int, int]) -> Place | None:
    """Return the pixel under a finger, moved into the window; None where it is not a number."""
    if isnan(event.x) or isnan(event.y):
        return None
    x, y = (min(max(share, 0.0), 1.0) for share in (event.x, event.y))
    return round(x * size[0]), round(y * size[1])


def _mouse(kind: int, at: Place) -> Event:
    """Return an event of the mouse and its left button."""
    if kind == pygame.MOUSEMOTION:
        return Event(kind, pos=at, rel=(0, 0), buttons=(1, 0, 0))
    return Event(kind, pos=at, button=1)


# A gamepad's buttons are keys, by the numbers that most gamepads give them.

PAD_EVENTS = (pygame.JOYDEVICEADDED, pygame.JOYHATMOTION, pygame.JOYBUTTONDOWN, pygame.JOYBUTTONUP)
_LOOKED_FOR_AFTER = 30
"""Frames after which gamepads are looked for: the first picture does not wait for it."""
_BUTTONS = ("space", "escape", "d", "n", "shift+tab", "tab", "h", "o")
_HAT = {(0, 1): "up", (0, -1): "down", (-1, 0): "left", (1, 0): "right"}


class Pads:
    """Holds gamepads open, so that their events come."""

    def __init__(self) -> None:
        self._opened: list[pygame.joystick.JoystickType] = []
        self._frames = _LOOKED_FOR_AFTER

    def look(self, frames: int) -> None:
        """Look once for gamepads, some frames after the window has opened; later ones come as events."""
        if 0 < self._frames <= frames:
            pygame.joystick.init()
        self._frames = max(self._frames - frames, 0)

    def bind(self, event: Event, mode: ModeKeys) -> Bind | None:
        """Return the bind of the key for which a button stands; None for what is no button's going down."""
        key = ""
        if event.type == pygame.JOYDEVICEADDED:
            with suppress(pygame.error):  # pulled out before its event came
                self._opened.append(pygame.joystick.Joystick(event.device_index))
        elif event.type == pygame.JOYHATMOTION:
            key = _HAT.get(event.value, "")
        elif event.type == pygame.JOYBUTTONDOWN:
            key = next(iter(_BUTTONS[event.button : event.button + 1]), "")
        if key == "space" and mode.name not in ("play", "paused"):
            key = "return"
        press = Press(key.removeprefix("shift+"), shift=key.startswith("shift+"))
        return mode.bind_of(press) if key else None


# The mouse: the wheel zooms, a drag pans, or moves the crank, the chart's cursor, a joint or a value.

_TOLD = 180
"""Frames after the mouse's last move for which things that pass below it show their words."""
_RIGHT = 3
"""The number of the right button, which opens the list of commands."""
_LONG, _TOO_LONG, _LONG_STILL = 36, 150, 0.012
"""A press of so many frames, between two numbers, is long if it moves less than this (window heights)."""
_LET_GO_FOR = "let go: commands"
_THINGS_IN = frozenset({"play", "paused", "edit"})
"""The modes in which joints and links have commands of their own."""
_TENTHS = 0.1
_PULL = 0.011
"""How far a drag of a value is for one step, in heights of the window."""
_COARSE = 10
_KINDS: Mapping[int, Literal["wheel", "down", "up", "move"]] = {
    pygame.MOUSEWHEEL: "wheel",
    pygame.MOUSEBUTTONDOWN: "down",
    pygame.MOUSEBUTTONUP: "up",
    pygame.MOUSEMOTION: "move",
}
MOUSE_EVENTS = tuple(_KINDS)
_DOUBLE = 24
"""The most frames between the clicks of a double click on a button."""
_LET_GO: Mapping[Drag | None, str] = {
    **{"pan": "", "crank": "", "chart": "", "paper": "", "joint": "drop"},
    **{"pen": "pen_off", "lead": "let_go", "hand": "back"},
}
"""The actions that end a drag without an effect, where it becomes a long press."""


def latest(events: list[Event]) -> list[Event]:
    """Return the events without moves of the mouse that a later move in the same frame replaces."""
    pairs = zip_longest(events, events[1:])
    return [one for one, then in pairs if then is None or not one.type == then.type == pygame.MOUSEMOTION]


class Mouse:
    """Knows what is being dragged from where and how far, and where the mouse was last, in pixels."""

    def __init__(self) -> None:
        self.drag: Drag | None = None
        self.at = self.begun = (0.0, 0.0)
        self.far, self.steps = 0.0, 0
        self.turned: int | None = None
        self._slider = 0
        self.under: int | None = None
        self._seen, self._moved_in = False, 0
        self._down_in = 0
        self._is_long = self.draws = self.turns = False
        self._pressed: tuple[Action, ...] = ()
        self._pressed_at, self._pressed_in = (0.0, 0.0), -_DOUBLE - 1

    def actions(self, event: Event, screen: Screen) -> tuple[Action, ...]:
        """Return the actions of a mouse event."""
        kind, notches, (x, y) = _KINDS[event.type], getattr(event, "y", 0), self.at
        if kind in ("move", "down"):
            self._seen, self._moved_in = True, screen.state.frame
        if kind == "down" and event.button == _RIGHT:
            self.at = event.pos
            return self._menu(screen)
        if getattr(event, "button", 1) != 1 or (kind == "wheel" and not notches):
            return ()
        self.at = getattr(event, "pos", self.at)
        if kind == "down":
            self.begun, self.far, self._down_in = self.at, 0.0, screen.state.frame
            self.draws = self._is_long = False
        self.far = max(self.far, math.dist(self.begun, self.at))
        if kind == "up" and self._presses_long(screen):
            return self._pressed_long(screen)
        height = screen.size[1]
        gesture = Gesture(kind, notches, ((self.at[0] - x) / height, (self.at[1] - y) / height), _coarser())
        actions = self._on_the_bar(gesture, screen)
        moved = (Action("mouse_moved"),) * (kind in ("move", "down") and self.drag in (None, "bar", "speed"))
        return (*moved, *(self._off_the_bar(gesture, screen) if actions is None else actions))

    def _off_the_bar(self, gesture: Gesture, screen: Screen) -> tuple[Action, ...]:
        """Return the actions of a gesture on anything that lies below the bar."""
        if gesture.kind == "down" and screen.target_at("toast", *self.at):
            self.drag = "bar"
            return (Action("open_toast"),)
        if screen.state.help and self.drag is None and not screen.shelf:
            return self._on_the_help(screen) if gesture.kind == "down" else ()
        if self.drag == "slider" or (gesture.kind == "down" and screen.target_at("slider", *self.at)):
            return self._on_the_slider(gesture, screen)
        top = screen.state.top
        if top and (actions := top.mouse(gesture, self, screen)) is not None:
            return actions
        return self._on_the_picture(gesture, screen)

    def _menu(self, screen: Screen) -> tuple[Action, ...]:
        """Return the action that opens the list for what is under the mouse, or for all, or closes it."""
        if screen.state.keys.alone:
            return ()
        if screen.state.mode in ("list", "find"):
            return (Action("back"),)
        if screen.button_at(*self.at) is not None:
            return (Action("menu"),)
        if screen.state.top and (asked := screen.state.top.menu(self, screen)) is not None:
            return asked
        if screen.state.mode in _THINGS_IN and (
            thing := screen.pointed(*self.at, NEAR_HAND * screen.size[1])
        ):
            of_scene = thing.thing and thing.thing.kind != "row"
            words = f"{thing.thing.kind} {thing.thing.name}" if thing.thing and of_scene else ""
            return (Action("menu", words or ("chart" if screen.charted(*self.at) is not None else None)),)
        return (Action("menu", "chart" if screen.charted(*self.at) is not None else None),)

    def long_press(self, screen: Screen) -> tuple[Action, ...]:
        """Return the action of a button or finger that is held still for long: it opens a list."""
        is_new, self._is_long = not self._is_long, self._presses_long(screen)
        return (Action("hint", _LET_GO_FOR),) if self._is_long and is_new else ()

    def _presses_long(self, screen: Screen) -> bool:
        """Return whether a release now ends a long press: nothing was dragged."""
        long = _LONG <= screen.state.frame - self._down_in < _TOO_LONG
        still = self.far <= _LONG_STILL * screen.size[1]
        return long and still and self.drag in _LET_GO and not self.draws

    def _pressed_long(self, screen: Screen) -> tuple[Action, ...]:
        """Return the actions of a long press: those of a right click, after ending what the press began."""
        ended, self.drag = _LET_GO[self.drag], None
        return (*((Action(ended),) if ended else ()), *self._menu(screen))

    def _on_the_help(self, screen: Screen) -> tuple[Action, ...]:
        """Return the actions of a click on the help: those of its line; a click beside the help closes it."""
        self.drag, keys = "bar", screen.help_at(*self.at)
        if keys is None:
            return (Action("help"),)
        asked = line_asks(screen.state.keys, keys) if keys else None
        return (Action("help"), asked) if asked else ()

    def _on_the_bar(self, gesture: Gesture, screen: Screen) -> tuple[Action, ...] | None:
        """Return the actions of a gesture on the bar: of a button, or of a dragged slider; None off it."""
        if self.drag in ("bar", "speed"):
            drag, self.drag = self.drag, None if gesture.kind == "up" else self.drag
            moved = drag == "speed" and gesture.kind == "move"
            return self._slid(screen) if moved and slides(screen.state, self._slider) else ()
        if gesture.kind == "down" and self._is_second(screen):
            self.drag = "bar"
            return self._pressed
        number = screen.button_at(*self.at) if self.drag is None else None
        if number is None or gesture.kind == "up":
            return None
        is_slider = number >= 0 and slides(screen.state, number)
        if gesture.kind == "wheel":
            return (Action("speed", gesture.notches),) if is_slider else ()
        if gesture.kind == "move":
            return ()
        self.drag, self._slider = "speed" if is_slider else "bar", number
        if is_slider or number < 0:
            return self._slid(screen) if is_slider else ()
        self._pressed, self._pressed_at = pressed(screen.state, number), self.at
        self._pressed_in = screen.state.frame
        return self._pressed

    def _is_second(self, screen: Screen) -> bool:
        """Return whether a button goes down for the second time at once, whatever lies there by now.

        It then does once more what it did, as a second press of a key does: it undoes it.
        """
        at_once = screen.state.frame - self._pressed_in <= _DOUBLE
        return at_once and math.dist(self._pressed_at, self.at) <= STILL * screen.size[1]

    def _slid(self, screen: Screen) -> tuple[Action, ...]:
        return slid(screen.state, self._slider, screen.share_at(self._slider, self.at[0]))

    def on_bar(self, screen: Screen) -> int | None:
        """Return the number of the bar's command under the mouse; None before the mouse was seen."""
        if not self._seen or self.drag not in (None, "bar", "speed"):
            return None
        return self._slider if self.drag == "speed" else screen.button_at(*self.at)

    def _on_the_picture(self, gesture: Gesture, screen: Screen) -> tuple[Action, ...]:
        """Zoom, pan, or drag what is under the mouse."""
        row = self._on_a_row(screen) if gesture.kind in ("wheel", "down") else None
        match gesture.kind:
            case "wheel" if row in speed_rows():
                return (Action("speed", gesture.notches),)
            case "wheel":
                return self._zoomed(gesture.notches, screen)
            case "down" if row is not None and (asked := row_asks(screen.state, row)):
                self.drag = "bar"
                return asked
            case "down" if row in speed_rows():
                self.drag, self.steps = "pace", 0
                return ()
            case "down":
                if title := screen.target_at("chart-title", *self.at):
                    self.drag = "bar"
                    return (Action("strip", title.value),)
                if polygon := screen.target_at("polygon", *self.at):
                    self.drag, alone = "bar", screen.state.look.large_polygon
                    return (Action("large_polygon"),) * ((3 - alone) if alone else polygon.value)
                handle = screen.handle_at(*self.at, REACH * screen.size[1])
                curve = None if handle else screen.on_trace(*self.at, NEAR_HAND * screen.size[1])
                self.drag = "joint" if handle or curve else self._grabbed(screen)
                if handle:
                    return (Action("grab", handle),)
                if curve:  # the curve's joint moves to the hand
                    return (Action("grab", curve[0]), *self.moved(screen))
                return self.moved(screen) if self.drag == "chart" else ()
            case "up":
                held, self.drag = self.drag, None
                return (Action("drop"),) if held == "joint" else ()
        return (Action("pan", gesture.by),) if self.drag == "pan" else self.moved(screen)

    def _on_a_row(self, screen: Screen) -> str | None:
        """Return the label of the row of numbers under the mouse; None elsewhere."""
        thing = screen.pointed(*self.at, NEAR_HAND * screen.size[1]) if self.drag is None else None
        return thing.thing.name if thing and thing.thing and thing.thing.kind == "row" else None

    def over(self, screen: Screen, state: State) -> AtMouse:
        """Return what the mouse is at, in the picture of the frame before, for the state to be shown."""
        if not self._seen:
            return AtMouse(pointed=led(state)) if state.grasp else NOWHERE
        free = not (state.held or state.grasp)  # a held joint glows anyway
        joint = self.hovered(screen) if free else None
        has_tools = all(one.top and one.top.has_tools for one in (screen.state, state))
        on_sheet = has_tools and self.drag in (None, "hand")
        return AtMouse(
            joint if joint in state.shown.linkage.by_name else None,  # else of the scene from before
            self.pointed(screen),
            screen.number_at("tool", *self.at) if on_sheet else None,
            self.on_bar(screen),
            screen.on_sheet(*self.at) if on_sheet else None,
            self.over_scene(screen, state.frame) if free else led(state),
        )

    def pointed(self, screen: Screen) -> int | None:
        """Return the row of the open list under the mouse; None before the mouse was seen."""
        if not self._seen or self.drag not in (None, "row") or screen.shelf:
            return None
        number_at = screen.option_at if screen.state.mode == "game" else screen.row_at
        row = number_at(*self.at)
        return row if row is not None and row >= 0 else None

    def hovered(self, screen: Screen) -> str | None:
        """Return the joint under the mouse that can be dragged; None before the mouse was seen."""
        if not self._seen or screen.shelf or self.drag in ("pan", "chart", "row"):
            return None
        on_a_list = self.drag is None and screen.row_at(*self.at) is not None
        if on_a_list or not (screen.state.leads or screen.state.mode in ("edit", "game")):
            return None
        at_pin = screen.state.scene.linkage.drive.joint if self.is_at_pin(screen) else None
        return screen.handle_at(*self.at, REACH * screen.size[1]) or at_pin

    def over_scene(self, screen: Screen, frame: int) -> Pointed | None:
        """Return the part of the scene under the mouse; None where it rests while the scene runs."""
        shown = self._seen and self.drag is None and screen.state.mode in ("play", "paused")
        rests = frame - self._moved_in > _TOLD and not screen.state.clock.paused
        if not shown or rests or screen.button_at(*self.at) is not None:
            return None
        return screen.pointed(*self.at, NEAR_HAND * screen.size[1])

    def is_at_pin(self, screen: Screen) -> bool:
        """Return whether the mouse is at the crank's pin."""
        pin = screen.crank_pin()
        return max(abs(self.at[0] - pin[0]), abs(self.at[1] - pin[1])) <= REACH * screen.size[1]

    def handed(self, name: str, screen: Screen, *, on_grid: bool = False) -> Action:
        """Return the hand's action on the sheet; its step is a tenth with Shift, and none with Alt."""
        mods = pygame.key.get_mods()
        part = 0.0 if mods & pygame.KMOD_ALT else _TENTHS if mods & pygame.KMOD_SHIFT else 1.0
        return Action(name, screen.handed(*self.at, part, on_grid=on_grid))

    def _on_the_slider(self, gesture: Gesture, screen: Screen) -> tuple[Action, ...]:
        """Drag the slider's knob, if the button went down on the slider."""
        self.drag = None if gesture.kind == "up" else "slider"
        if gesture.kind == "up":
            return (Action("drop"),)
        slid = Action("slide", screen.slid(self.at[0]))
        return (slid,) if gesture.kind in ("down", "move") else ()

    def _grabbed(self, screen: Screen) -> Literal["pan", "crank", "chart"]:
        if self.is_at_pin(screen):
            return "crank"
        return "pan" if screen.charted(*self.at) is None else "chart"

    def _zoomed(self, notches: float, screen: Screen) -> tuple[Action, ...]:
        """Zoom about the mouse, or the linkage's nearest place; before it was seen, about the middle."""
        x, y = screen.from_middle(*self.at) if self._seen else (0.0, 0.0)
        return (Action("zoom", (float(notches), x, y)),)

    def moved(self, screen: Screen) -> tuple[Action, ...]:
        """Return the actions of what is dragged, where the mouse is now."""
        if self.drag == "pace":
            before = self.steps
            self.steps = round((self.at[0] - self.begun[0]) / (_PULL * screen.size[1]))
            return (Action("speed", self.steps - before),) if self.steps != before else ()
        if self.drag == "joint":
            fine = _TENTHS if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1.0
            return (Action("carry", (*screen.world(*self.at), fine)),)
        phase = screen.charted(*self.at) if self.drag == "chart" else None
        if self.drag == "crank":
            phase = phase_towards(screen.state.displayed, screen.state.phase, screen.world(*self.at))
        return () if phase is None else (Action("scrub", phase),)


def _coarser() -> int:
    """Return the factor on a step: more than 1 with Shift."""
    return _COARSE if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1
