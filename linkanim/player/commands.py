"""Bring the commands of the key table to the hand: which are on the bar in each mode, and how they stand.

What a command is called, its key and what it does are the table's.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import NamedTuple

from linkanim.picture.overlay import Button, CommandBar
from linkanim.player.action import Action, Mode
from linkanim.player.clock import FASTEST, SLOWEST
from linkanim.player.keys import GROUPS, commands, group_key
from linkanim.player.state import STIR_FRAMES, State

_FADING = 24
"""Over so many frames the bar fades, in eighths."""


class BarEntry(NamedTuple):
    """A command on the bar: its icon, the action of the table, its rank, whether it begins a group."""

    icon: str
    action: Action
    rank: int
    leads: bool = False


_SPEED = Action("speed", 1)
_BACK = BarEntry("back", Action("back"), 0)
_HOME = BarEntry("home", Action("play", "title door=play"), 2)
_RUNNING = (
    BarEntry("step back", Action("step", -1), 8, leads=True),
    BarEntry("pause", Action("pause"), 0),
    BarEntry("step on", Action("step", 1), 7),
    BarEntry("speed", _SPEED, 6),
)
_LAST = (BarEntry("more", Action("menu"), -1, leads=True), BarEntry("help", Action("help"), 5))
_SCENE = (
    BarEntry("shelf", Action("shelf"), 1),
    *_RUNNING,
    BarEntry("trace", Action("trace"), 11, leads=True),
    BarEntry("names", Action("names"), 10),
    BarEntry("arrows", Action("menu", "arrows"), 9),
    BarEntry("chart", Action("list"), 4),
    BarEntry("construction", Action("menu", "construction"), 14),
    BarEntry("edit", Action("edit"), 3, leads=True),
    BarEntry("build", Action("build"), 12),
    BarEntry("pencil", Action("pencil"), 13),
    BarEntry("record", Action("menu", "record"), 6, leads=True),
    *_LAST,
)
_SHEET = (
    _BACK,
    _HOME,
    *_RUNNING,
    BarEntry("undo", Action("unbuild"), 5, leads=True),
    BarEntry("redo", Action("rebuild"), 9),
    BarEntry("new", Action("sheet"), 6, leads=True),
    BarEntry("save", Action("save"), 4),
    BarEntry("done", Action("build"), 3),
    *_LAST,
)
_PENCIL = (
    _BACK,
    _HOME,
    *_RUNNING,
    BarEntry("again", Action("take_back"), 3, leads=True),
    BarEntry("done", Action("keep"), 1),
    *_LAST,
)
_HANDLES: Mapping[Mode, tuple[BarEntry, ...]] = {
    "play": _SCENE,
    "paused": _SCENE,
    "edit": (_BACK, _HOME, *_SCENE),
    "list": (_BACK, _HOME, *_SCENE),
    "shelf": (_BACK, _HOME, *_LAST),
    "pencil": _PENCIL,
    "build": _SHEET,
    "layers": (
        *(_BACK, _HOME, BarEntry("nearer", Action("lift", -1), 4, leads=True)),
        *(BarEntry("farther", Action("lift", 1), 4), BarEntry("save", Action("make"), 3, leads=True), *_LAST),
    ),
    "game": (_BACK, _HOME, *_LAST),
    "name": (_BACK, BarEntry("done", Action("take_name"), 1)),
}


def bar(state: State, pointed: int | None = None) -> CommandBar | None:
    """Return the bar while it shows: for three seconds after the mouse or a finger has moved."""
    if state.stirred is None:
        return None
    left = state.stirred + STIR_FRAMES - state.frame
    eighths = min(8 * left // _FADING, 8)
    if eighths <= 0:
        return None
    buttons = _buttons(state)
    known = pointed is not None and pointed < len(buttons)  # the mouse was over the bar of another mode
    return CommandBar(buttons, pointed if known else None, eighths)


def pressed(state: State, number: int) -> tuple[Action, ...]:
    """Return what a button asks for; one that cannot be done says why."""
    handle = _HANDLES[state.mode][number]
    reason = lack(state, handle.action)
    return (Action("note", reason),) if reason else (_meant(state, handle.action),)


def slid(state: State, number: int, share: float) -> tuple[Action, ...]:
    """Return what brings a slider's knob so far along, 0 to 1; one that cannot be moved says why."""
    reason = lack(state, _HANDLES[state.mode][number].action)
    if reason:
        return (Action("note", reason),)
    return (Action("level", round(SLOWEST + share * (FASTEST - SLOWEST))),)


def slides(state: State, number: int) -> bool:
    """Tell whether a button is a slider."""
    return _HANDLES[state.mode][number].action == _SPEED


def _buttons(state: State) -> tuple[Button, ...]:
    return tuple(_button(state, handle) for handle in _HANDLES[state.mode])


def _button(state: State, handle: BarEntry) -> Button:
    action = handle.action
    name, key = _called(state.mode, action)
    share = (state.clock.level - SLOWEST) / (FASTEST - SLOWEST) if action == _SPEED else None
    icon = _ICONS[handle.icon](state) if handle.icon in _ICONS else handle.icon
    on = action in _ON and _ON[action](state)
    return Button(icon, name, key, handle.rank, handle.leads, on, lack(state, action), share)


@lru_cache(maxsize=256)
def _called(mode: Mode, action: Action) -> tuple[str, str]:
    """Return what a command is called, and its key; of a group of them the group's name, and their keys."""
    if action == _SPEED:
        return "speed", "↑ ↓"
    if action.name == "menu" and action.value is not None:
        return GROUPS[str(action.value)].title.lower(), group_key(str(action.value))
    return next((words, key) for words, key, one in commands(mode) if one == action)


def _meant(state: State, action: Action) -> Action:
    """Return what a button asks for just now: what is recorded is stopped by the button that began it."""
    if action == Action("menu", "record") and state.recording:
        return Action("record", state.recording.format)
    return action


def lack(state: State, action: Action) -> str:
    """Say why a command cannot be done in the state as it is; empty where it can."""
    return _LACKS[action](state) if action in _LACKS else ""


def _shows(title: str) -> Callable[[State], bool]:
    """Return what tells whether the list of a group of commands is open."""
    return lambda state: bool(state.listing and state.listing.others and state.listing.others.title == title)


_ICONS: Mapping[str, Callable[[State], str]] = {
    "pause": lambda state: "play" if state.clock.paused else "pause",
    "record": lambda state: "stop" if state.recording else "record",
}
_ON: Mapping[Action, Callable[[State], bool]] = {
    Action("trace"): lambda state: state.look.trace and bool(state.scene.trace),
    Action("names"): lambda state: state.look.names > 0,
    Action("menu", "arrows"): lambda state: bool(state.look.vectors) or _shows(GROUPS["arrows"].title)(state),
    Action("list"): lambda state: state.look.chart is not None,
    Action("menu", "construction"): lambda state: state.look.polygons or state.look.centres > 0,
    Action("menu", "record"): lambda state: state.recording is not None,
    Action("menu"): _shows("Commands"),
    Action("edit"): lambda state: state.editing.open,
    Action("help"): lambda state: state.help,
}
"""Whether a command is on, where that is to be seen."""


def _nothing_moves(state: State) -> str:
    sheet = state.building
    return sheet.building.made.missing if sheet else ""


_LACKS: Mapping[Action, Callable[[State], str]] = {
    Action("play", "title door=play"): lambda state: (
        "" if state.games else "there are no games here; `linkanim` alone has them"
    ),
    Action("trace"): lambda state: "" if state.scene.trace else "no joint of this mechanism is traced",
    Action("keep"): lambda state: "" if state.sketch and not state.sketch.is_blank else "draw a path first",
    Action("take_back"): lambda state: "" if state.sketch and state.sketch.earlier else "nothing is drawn",
    Action("unbuild"): lambda state: (
        "" if state.building and state.building.building.past else "there is nothing to undo"
    ),
    Action("rebuild"): lambda state: (
        "" if state.building and state.building.building.future else "there is nothing to redo"
    ),
    Action("pause"): _nothing_moves,
    Action("step", -1): _nothing_moves,
    Action("step", 1): _nothing_moves,
    _SPEED: _nothing_moves,
}
"""Why a command cannot be done, where it may be so."""
