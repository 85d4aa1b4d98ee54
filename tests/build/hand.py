"""A hand on a sheet: gestures as lines of text, as a tape has them, and the building after them."""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce

from linkanim.build.building import Building, posed, redo, undo
from linkanim.build.dimensions import accept, choose_number, write
from linkanim.build.draft import Thing
from linkanim.build.gestures import (
    choose,
    choose_thing,
    click,
    delete,
    double_click,
    drive,
    move,
    trace,
)
from linkanim.build.meanings import drag
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.state import begin
from linkanim.player.tape import Tape, Taping

REACH, SNAP = 3.0, 1.0


def gestures(text: str) -> list[str]:
    """Return the gestures of a session, a line each; what follows # is left out."""
    lines = (line.partition("#")[0].strip() for line in text.splitlines())
    return [line for line in lines if line]


def drawn(text: str | Iterable[str], begin: Building | None = None) -> Building:
    """Return the building after all gestures of a session."""
    lines = gestures(text) if isinstance(text, str) else text
    return reduce(gesture, lines, begin or Building())


def gesture(building: Building, line: str, *, reach: float = REACH, snap: float = SNAP) -> Building:
    """Return the building after one gesture; by the pointer it is made onto the pose that is drawn."""
    name, *words = line.split()
    if name == "type":
        return accept(write(building, " ".join(words)))
    if name == "choose":
        return choose_thing(building, words[0], " ".join(words[1:]))
    if name == "number":
        return choose_number(building, int(words[0]))
    if name in _PLAIN:
        return _PLAIN[name](building)
    building = posed(building, building.draft.phase)
    if name == "move":
        return move(building, *map(float, words), snap=snap)
    if name == "double":
        return double_click(building, *map(float, words), reach=reach, snap=snap)
    tool = words.pop(0) if words[0].isalpha() else "bar"
    x, y, *to = map(float, words)
    if name == "click":
        return click(building, tool, x, y, reach=reach, snap=snap)
    return drag(building, tool, x, y, to[0], to[1], reach=reach, snap=snap)


def _next(building: Building) -> Building:
    return choose(building, 1)


_PLAIN = {"trace": trace, "drive": drive, "delete": delete, "undo": undo, "redo": redo, "next": _next}
_ACTIONS = {"trace": "trace_on", "drive": "drive_by"}


class Hand:
    """A hand on an open sheet of the player: the same gestures as actions, frame by frame, on a tape."""

    def __init__(self) -> None:
        self.state = begin("crank-rocker")
        self._taping = Taping(self.state, (320, 180))
        self.do(Action("sheet"))

    @property
    def tape(self) -> Tape:
        return self._taping.tape(self.state.frame)

    @property
    def building(self) -> Building:
        assert self.state.building
        return self.state.building.building

    def do(self, *actions: Action) -> None:
        """Go a frame on, with these actions."""
        self.state = advance(self.state, actions)
        self._taping.note(self.state.frame, actions)

    def gesture(self, line: str) -> None:
        """Make a gesture; before one by the pointer what runs is turned back to where it was drawn."""
        name, *words = line.split()
        if name == "type":
            return self.do(Action("digits", " ".join(words)), Action("accept_number"))
        if name == "choose":
            return self._choose((words[0], " ".join(words[1:])))
        if name == "number":
            return self.do(Action("number", int(words[0])))
        if name in _ACTIONS:
            return self.do(Action(_ACTIONS[name]))
        if self.building.made.scene:
            self.do(Action("scrub", self.building.draft.phase))
        tool = words.pop(0) if words[0].isalpha() else "bar"
        self.do(Action("tool", tool))
        x, y, *to = map(float, words)
        down, up = Action("hand_down", (x, y, REACH, SNAP)), Action("hand_up")
        if name == "drag":
            self.do(down)
            self.do(Action("hand_to", (to[0], to[1], REACH, SNAP)))
            return self.do(up)
        for _ in range(2 if name == "double" else 1):
            self.do(down, up)
        return None

    def _choose(self, thing: Thing) -> None:
        for _ in self.building.draft.things():
            if self.building.chosen != thing:
                self.do(Action("further", 1))


def taped(text: str, pace: int = 0) -> Tape:
    """Return the tape of a session played on a sheet, with so many frames before each gesture."""
    hand = Hand()
    for line in gestures(text):
        for _ in range(pace):
            hand.do()
        hand.gesture(line)
    return hand.tape
