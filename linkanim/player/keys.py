"""List the keys that always hold in one table: window, help, `--help` and the manual read it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field
from functools import cached_property
from typing import NamedTuple

from linkanim.build.tools import TOOLS
from linkanim.frozen import frozen
from linkanim.picture.look import TOGGLES
from linkanim.player.action import Action, Value
from linkanim.words import to_say

# The one key table: the window, the help, `--help` and the manual all read it.
#
# Keys are named as pygame names its constants (`K_F12` is "f12"), a printable key by its character,
# with "ctrl+" and "shift+" in front, so that nothing here needs pygame.


class Bind(NamedTuple):
    """One key and its action; `repeats` says that holding the key repeats the action."""

    key: str
    action: Action
    repeats: bool = False


class KeyRow(NamedTuple):
    """One line of the help: the keys as they are written, what they do, and what they ask for."""

    keys: str
    words: str
    binds: tuple[Bind, ...] = ()


Table = Mapping[str, tuple[KeyRow, ...]]
"""Lines of the help by their subject."""


def on(keys: str, name: str, value: Value = None, *, held: bool = False) -> tuple[Bind, ...]:
    """Return the binds of keys to one action; with `held`, holding a key repeats it."""
    return tuple(Bind(key, Action(name, value), held) for key in keys.split())


def _of_look(name: str) -> tuple[Bind, ...]:
    """Return the keys of a field of the look."""
    toggle = TOGGLES[name]
    members = zip(toggle.keys, toggle.members, strict=True)
    return tuple(Bind(key, Action(name, member)) for key, member in members)


def _looks(subject: str) -> tuple[KeyRow, ...]:
    """Return the lines of the look's fields under a subject."""
    toggles = ((name, toggle) for name, toggle in TOGGLES.items() if toggle.subject == subject)
    return tuple(KeyRow(", ".join(one.keys).upper(), one.title, _of_look(name)) for name, one in toggles)


def both(less: str, more: str, name: str, by: int = 1, *, held: bool = True) -> tuple[Bind, ...]:
    """Return the binds of two keys: one does less by a number, the other more."""
    return on(less, name, -by, held=held) + on(more, name, by, held=held)


def steps(name: str) -> tuple[Bind, ...]:
    """Return the binds of the left and right arrows; with Shift, ten times as far."""
    return both("left", "right", name) + both("shift+left", "shift+right", name, 10)


def tabs(name: str) -> tuple[Bind, ...]:
    """Return the binds of Tab and Shift+Tab."""
    return both("shift+tab", "tab", name, held=False)


def digits(name: str) -> tuple[Bind, ...]:
    """Return the binds of the keys 1 to 9, which stand for places from 0."""
    return tuple(bind for n in range(9) for bind in on(f"{n + 1} kp{n + 1}", name, n))


def enter(name: str, erase: str = "") -> tuple[Bind, ...]:
    """Return the bind of Enter, and that of the key that erases the last typed letter."""
    return on("return kp_enter", name) + (on("backspace", erase, held=True) if erase else ())


def undo_keys(undo: str, redo: str) -> tuple[Bind, ...]:
    """Return the binds of undo and redo."""
    return on("ctrl+z", undo, held=True) + on("ctrl+y ctrl+shift+z", redo, held=True)


def _zoom(keys: str, notches: float) -> tuple[Bind, ...]:
    return on(keys, "zoom", (notches, 0.0, 0.0), held=True)


def aims() -> tuple[Bind, ...]:
    """Return the binds of the arrows: they move the cursor by a grid line, with Shift by a fine step."""
    arrows = {"up": (0.0, 1.0), "down": (0.0, -1.0), "left": (-1.0, 0.0), "right": (1.0, 0.0)}
    lines = (bind for key, step in arrows.items() for bind in on(key, "aim", step, held=True))
    fine = (
        bind for key, step in arrows.items() for bind in on(f"shift+{key}", "aim", (*step, 0.0), held=True)
    )
    return (*lines, *fine)


_RECORD = (
    *(on("g", "record", "gif") + on("m", "record", "mp4")),
    *(on("ctrl+g", "period", "gif") + on("ctrl+m", "period", "mp4")),
    *on("ctrl+shift+g ctrl+shift+m", "record_dialog"),
)
_BUILD = on("f2", "build") + on("shift+f2", "build_on")
_DIAL = both(",", ".", "dial_on")
_STEPS = both("shift+f7", "f7", "construct", held=False)
_MAKE = on("f6", "layers") + on("shift+f6", "make")
_LESSON = (
    *(on("f8", "keep_step") + on("shift+f8", "caption_step")),
    *both("pageup", "pagedown", "lesson_on", held=False),
)
_PATH = on("w", "pencil") + on("shift+w", "own_trace")

KEYS: Table = {
    "play": (
        KeyRow("Space", "play / pause", on("space", "pause")),
        KeyRow("← → (Shift: ×10)", "pause, and step the crank", steps("step")),
        KeyRow("↑ ↓", "speed", both("down", "up", "speed")),
        KeyRow("digits, Enter", "pause, and go to that input angle", enter("go", "erase_place")),
        KeyRow("D", "direction", on("d", "direction")),
        KeyRow("R (twice: reset)", "back to the start", on("r", "start")),
        KeyRow(
            "Tab, Shift+Tab",
            "next mechanism",
            tabs("mechanism"),
        ),
        KeyRow("O", "the shelf: all mechanisms", on("o", "shelf")),
        KeyRow("F3", "the title, and what can be played", on("f3", "play", "title door=play")),
        KeyRow("drag any joint", "lead the motion by hand; the chart's cursor does the same"),
    ),
    "look": (
        *_looks("look"),
        KeyRow(
            "+, −, drag; 0: fit",
            "zoom (wheel), pan",
            _zoom("+ = kp_plus", 1.0) + _zoom("- kp_minus", -1.0) + on("0 kp0 home", "fit"),
        ),
        KeyRow("L (Shift: lit / flat)", "light / dark", _of_look("theme") + _of_look("material")),
        KeyRow("F11", "full screen", on("f11", "fullscreen")),
        KeyRow(
            "F10, right click",
            "all commands (Shift: a joint's)",
            on("f10", "menu") + on("shift+f10", "menu", "things"),
        ),
        KeyRow(
            "H, F1, ?; Ctrl+K, /",
            "help; find anything, and do it",
            on("h f1 ? shift+/", "help") + on("ctrl+k /", "find"),
        ),
        KeyRow(
            "Esc, Q",
            "close, leave full screen, stop recording (Esc); quit",
            on("escape", "back") + on("q", "quit"),
        ),
    ),
    "measure": (
        *_looks("measure"),
        KeyRow(
            "P (Shift: one, large)",
            "velocity and acceleration polygons",
            _of_look("polygons") + _of_look("large_polygon"),
        ),
        KeyRow(
            "C (Shift: off)", "chart: next quantity, off", on("c", "chart", 1) + on("shift+c", "plot", "")
        ),
        KeyRow(
            "X; Shift+N",
            "chart's axis; dead centres",
            _of_look("over") + _of_look("dead_centres"),
        ),
        KeyRow("K (Shift: more)", "the list of quantities", on("k", "list") + on("shift+k", "list", "below")),
        KeyRow("Shift+U; Shift+R", "unit of lengths; a ruler", _of_look("unit") + on("shift+r", "ruler")),
    ),
    "edit": (
        KeyRow(
            "E (Shift: tolerances)",
            "edit dimensions (H there: how)",
            on("e", "edit") + on("shift+e", "tolerance"),
        ),
        KeyRow("F2, W (Shift: this one)", "build it, or draw its path", _BUILD + _PATH),
        KeyRow("F4", "set down poses of a body", on("f4", "poses")),
        KeyRow("F7 (Shift: back)", "constructions, step by step", _STEPS),
        KeyRow(", .", "along the family that it is of", _DIAL),
        KeyRow(
            "B (Shift: ghost; Ctrl)",
            "assembly: other closure; all",
            on("b", "closure") + _of_look("ghost") + on("ctrl+b", "closures"),
        ),
        KeyRow("Ctrl+Z, Ctrl+Y", "undo, redo", undo_keys("undo", "redo")),
    ),
    "keep": (
        KeyRow("S, F12 (Shift+S: SVG)", "screenshot", on("s f12", "screenshot") + on("shift+s", "svg")),
        KeyRow("G, M (Ctrl: a period)", "record GIF, MP4; Ctrl+Shift: how, where", _RECORD),
        KeyRow("Shift+G", "hand on: one page that moves", on("shift+g", "share")),
        KeyRow("F6 (Shift: write them)", "its parts in layers, to be made", _MAKE),
        KeyRow(
            "Ctrl+S, O; F5",
            "save, open, load again",
            on("ctrl+s", "save")
            + on("ctrl+shift+s", "save_as")
            + on("ctrl+o", "files_here")
            + on("f5", "reload"),
        ),
        KeyRow("F8, PgUp, PgDn", "a lesson: keep a step, show it", _LESSON),
    ),
}
"""Every key of the window, by subject, in the order in which the help shows them."""


TAKEN = tuple(tool for tool in TOOLS if tool.action in ("tool", "trace_on", "drive_by"))
_WITH_CTRL = KeyRow(
    "Ctrl+1–9, F, Shift+T, D",
    "a tool, to add parts; a trace, the drive",
    tuple(bind for one in TAKEN for bind in on(f"ctrl+{one.key.lower()}", one.action, one.value)),
)
"""The tools where letters and digits are typed."""
LIST_KEYS = (
    KeyRow("↑ ↓", "choose a dimension", both("up", "down", "choose")),
    KeyRow("← → (Shift: ×10)", "nudge it", steps("nudge")),
    KeyRow("Tab, Shift+Tab", "the next row; the typed value waits", tabs("pass_on")),
    KeyRow(
        "digits, Enter",
        "type a value, with or without a unit; take all typed values",
        enter("accept", "erase"),
    ),
    _WITH_CTRL,
    KeyRow("Ctrl+B", "let an input that swings return on the same closure", on("ctrl+b", "returns")),
    KeyRow("Ctrl+R", "reset: the file's dimensions again", on("ctrl+r", "reset")),
    KeyRow("click, wheel, drag (Shift: ×10)", "choose a row, nudge its value; take a tool, to add parts"),
    KeyRow("drag joints (Shift: tenths)", "set lengths on the picture, in whole units"),
)
"""The meaning of keys in the list of dimensions, of a scene or on a sheet."""
_LESSON_TABLE: Table = {
    "in a lesson": (
        KeyRow(
            "← →, PgUp, PgDn",
            "the step before, the next; so does a presenter's remote",
            both("left", "right", "lesson_on", held=False)
            + both("pageup", "pagedown", "lesson_on", held=False),
        ),
        KeyRow(
            "Shift+← →",
            "ten steps of the crank; all else is as without a lesson",
            both("shift+left", "shift+right", "step", 10),
        ),
        KeyRow("Esc", "leave the lesson; PgDn goes on with it", on("escape", "back")),
    ),
}
"""The meaning of keys in a lesson."""
GAME_TABLE: Table = {
    "in a game": (
        KeyRow("1–9, click", "choose an answer or a door", digits("option")),
        KeyRow("Enter, Space", "go on", on("return kp_enter space", "next")),
        KeyRow("← → (Shift: ×10)", "turn the crank", steps("turn")),
        KeyRow("↑ ↓", "choose", both("down", "up", "raise")),
        KeyRow("Esc", "out of it", ()),
    ),
}
"""The meaning of keys in a game."""


class BarEntry(NamedTuple):
    """A command on the bar: its icon, the action of the table, its rank, whether it leads, where it is."""

    icon: str
    action: Action
    rank: int
    leads: bool = False
    on_chart: bool = False


SPEED = Action("speed", 1)
BACK_BAR = BarEntry("back", Action("back"), 0)
HOME_BAR = BarEntry("home", Action("play", "title door=play"), 2)
MOVING_BAR = (
    BarEntry("step back", Action("step", -1), 8, leads=True),
    BarEntry("pause", Action("pause"), 0),
    BarEntry("step on", Action("step", 1), 7),
    BarEntry("speed", SPEED, 6),
)
LAST_BAR = (
    BarEntry("full screen", Action("fullscreen"), 17, leads=True),
    BarEntry("theme", Action("theme"), 18),
    BarEntry("more", Action("menu"), -1),
    BarEntry("help", Action("help"), 5),
)
"""Commands that stand on several bars."""


class TypedKeys(NamedTuple):
    """How printable keys are typed in a mode: the action, and the keys that keep their meaning until then.

    Where only some letters begin, the others are typed once something is; `further` are all that can follow.
    """

    action: str
    keep: frozenset[str] = frozenset()
    begins: str = ""
    further: str = ""

    def takes(self, press: Press, *, typing: bool, valued: bool) -> bool:
        """Return whether a key is typed, once something is (`typing`) and where that has a value."""
        if press.ctrl or not press.text or not press.text.isprintable():
            return False
        if self.begins:
            begins = valued and press.text in self.begins
            return begins or (typing and (not self.further or press.text in self.further))
        return typing or press.key not in self.keep


class Press(NamedTuple):
    """A key that went down: its name, the modifiers, and the text it types (empty where none)."""

    key: str
    text: str = ""
    shift: bool = False
    ctrl: bool = False

    @property
    def names(self) -> tuple[str, ...]:
        """The names it may be bound under, the most particular first."""
        if self.ctrl:
            return ("ctrl+shift+" + self.key,) if self.shift else ("ctrl+" + self.key,)
        symbol = () if self.text.isalpha() else (self.text,)
        return ("shift+" + self.key, *symbol, self.key) if self.shift else (self.key, *symbol)


@frozen(eq=False)
class ModeKeys:
    """The keys of a mode by subject, which take precedence over their usual meaning; how print is typed.

    While a mode is on that is `alone`, of one line or dialog, no other keys mean anything. Some commands have
    other `names` in it, and any other letter may mean one of them.
    """

    name: str
    table: Table = field(default_factory=dict)
    typed: TypedKeys | None = None
    alone: bool = False
    names: Mapping[Action, str] = field(default_factory=dict)
    others: Action | None = None

    @property
    def binds(self) -> Iterator[Bind]:
        """The binds of this mode only, without those of all modes."""
        return _binds(self.table)

    def bind_of(self, press: Press, *, typing: bool = False, valued: bool = True) -> Bind | None:
        """Return what a key asks for; None where it is not bound.

        In an open list printable keys are typed, except for a few that keep their meaning until something is
        typed (`typing`). While a mechanism is shown digits are a place to go to. On a sheet they are typed
        where the chosen thing has a value (`valued`); else they are the numbers of tools.
        """
        if self.typed and self.typed.takes(press, typing=typing, valued=valued):
            return Bind(press.key, Action(self.typed.action, press.text), repeats=True)
        tables = (self.table, {} if self.alone else KEYS)
        binds = (
            bind for table in tables for name in press.names for bind in _binds(table) if bind.key == name
        )
        others = Bind(press.key, self.others) if self.others and press.text and not press.ctrl else None
        return next(binds, others)

    def row_actions(self, keys: str) -> tuple[Action, ...]:
        """Return the actions of a line of the help, each once; the line is found by its keys as written."""
        rows = (row for table in (self.table, KEYS) for row in _rows(table) if row.keys == keys)
        return tuple(dict.fromkeys(bind.action for bind in next(rows, KeyRow("", "")).binds))

    @cached_property
    def commands(self) -> tuple[tuple[str, str, Action], ...]:
        """All commands of the mode, each once: its words, its first key, its action.

        The key is empty where all keys of a command mean something else in the mode.
        """
        above: set[str] = set()
        named: dict[Action, tuple[str, str, Action]] = {}
        usual = () if self.alone else tuple(_rows(KEYS))
        for n, rows in enumerate((*self.table.values(), usual)):
            for one, bind in ((row, bind) for row in rows for bind in row.binds):
                if bind.action.name not in _NEEDS_KEYS:
                    below = bind.key in above or (n > 0 and self._types(bind.key))
                    key = "" if below else _as_written(bind.key)
                    apart = self.names.get(bind.action, _APART.get(bind.action, one.words))
                    words, known, _ = named.get(bind.action, (apart, "", bind.action))
                    named[bind.action] = (words, known or key, bind.action)
            above |= {bind.key for row in rows for bind in row.binds}
        # a mode's own command replaces the general one of the same name
        by_name = {words: action for words, _, action in reversed(named.values())}
        return tuple(one for one in named.values() if by_name[one[0]] == one[-1])

    def _types(self, key: str) -> bool:
        """Tell whether a key is typed in an open list, and so has no other meaning."""
        typed = self.typed
        return typed is not None and not typed.begins and len(key) == 1 and key not in typed.keep

    @property
    def help_groups(self) -> tuple[tuple[str, tuple[tuple[str, str], ...]], ...]:
        """(subject, its lines of keys and what they do) as the help overlay shows them."""
        table = (self.table or KEYS).items()
        return tuple((subject, tuple((row.keys, row.words) for row in rows)) for subject, rows in table)


def _rows(table: Table) -> Iterator[KeyRow]:
    return (row for rows in table.values() for row in rows)


def _binds(table: Table) -> Iterator[Bind]:
    return (bind for row in _rows(table) for bind in row.binds)


_ANGLE = TypedKeys("type_place", begins="0123456789", further="0123456789.")
RUNNING = ModeKeys("play", typed=_ANGLE)
"""The keys while a mechanism runs: digits are an input angle."""
OF_MODES: tuple[ModeKeys, ...] = (
    RUNNING,
    ModeKeys("paused", typed=_ANGLE),
    ModeKeys("lesson", _LESSON_TABLE, _ANGLE),
)


BESIDE_GAMES = frozenset(
    {
        *("play", "help", "find", "theme", "material", "zoom", "fit", "fullscreen"),
        *("language", "pan", "record", "record_dialog", "screenshot", "svg", "quit"),
    }
)
"""The commands that are the window's own while a game is on; all others are handed to the game."""
_NEEDS_KEYS = frozenset(
    {
        *("aim", "enter", "type_place", "erase_place", "go"),
        *("erase", "erase_number", "erase_filter", "erase_name", "erase_target"),
    }
)
"""Actions that make no sense in a list: they move what only keys move, or erase what is typed."""
_APART: Mapping[Action, str] = {
    Action("step", -1): "a step back",
    Action("step", 1): "a step on",
    Action("step", -10): "ten steps back",
    Action("step", 10): "ten steps on",
    Action("speed", -1): "slower",
    Action("speed", 1): "faster",
    Action("mechanism", -1): "the mechanism before",
    Action("mechanism", 1): "the next mechanism",
    **{Action("select", n): f"mechanism {n + 1} of the chapter" for n in range(9)},
    Action("names"): "names, then dimensions",
    Action("over"): "the chart's axis: angle, time, phase",
    Action("dead_centres"): "a slider's dead centres, with names",
    Action("material"): "lit or flat",
    Action("polygons"): "velocity and acceleration polygons",
    Action("large_polygon"): "one polygon alone, large",
    Action("chain"): "the input's colour along the chain",
    Action("centres"): "instant centres, then centrodes",
    Action("vectors", "v"): "velocities",
    Action("vectors", "a"): "accelerations",
    Action("vectors", "f"): "forces",
    Action("zoom", (1.0, 0.0, 0.0)): "nearer",
    Action("zoom", (-1.0, 0.0, 0.0)): "farther",
    Action("fit"): "fit",
    Action("edit"): "edit dimensions",
    Action("numbers"): "edit dimensions",
    Action("tolerance"): "tolerances: how far off it may be",
    Action("tolerate", 1): "a coarser tolerance",
    Action("tolerate", -1): "a finer tolerance",
    Action("shelf"): "the shelf",
    Action("help"): "help",
    Action("menu"): "all commands",
    Action("find"): "find",
    Action("menu", "things"): "commands of a joint or link",
    Action("play", "title door=play"): "the title",
    Action("back"): "close what is open, leave full screen",
    Action("quit"): "quit",
    Action("list"): "the list of quantities",
    Action("list", "below"): "another chart below",
    Action("plot", ""): "chart: off",
    Action("chart", 1): "chart: the next quantity",
    Action("build"): "build a linkage",
    Action("build_on"): "build on with this linkage",
    Action("pencil"): "draw a path to follow",
    Action("own_trace"): "draw on from this linkage's curve",
    Action("closure"): "the other closure",
    Action("closures"): "all closures, to choose one",
    Action("ghost"): "the other closure, faintly",
    Action("undo"): "undo",
    Action("redo"): "redo",
    Action("screenshot"): "screenshot (PNG)",
    Action("svg"): "figure (SVG)",
    Action("record", "gif"): "record a GIF: start, stop",
    Action("record", "mp4"): "record an MP4: start, stop",
    Action("period", "gif"): "one period as a GIF",
    Action("period", "mp4"): "one period as an MP4",
    Action("record_dialog"): "record and save",
    Action("record_row", -1): "the row above",
    Action("record_row", 1): "the row below",
    Action("record_turn", -1): "the value before",
    Action("record_turn", 1): "the next value",
    Action("record_start"): "record",
    Action("keep_step"): "keep it as a step of the lesson",
    Action("caption_step"): "keep it as a step of the lesson, with a caption",
    Action("lesson_on", -1): "the step of the lesson before",
    Action("lesson_on", 1): "the next step of the lesson",
    Action("lift", 1): "lift the layers farther off each other",
    Action("lift", -1): "lay the layers nearer together",
    Action("further", 1): "the next one",
    Action("further", -1): "the one before",
    **{Action(one.action, one.value): one.name for one in TAKEN},
    Action("tool_on", 1): "the next tool, or what else the drag can mean",
    Action("tool_on", -1): "the tool before",
    Action("remove"): "remove what is chosen",
    Action("keep"): "keep the linkage as the scene",
    **{Action("answer", n): f"answer {n + 1}" for n in range(9)},
    Action("construct", 1): "the next step of the construction",
    Action("dial_on", 1): "the dial on, or on along the family",
    Action("dial_on", -1): "the dial back, or back along the family",
    Action("construct", -1): "the step of the construction before",
    Action("layers"): "the layers in which it can be made",
    Action("make"): "write its parts, to be cut and pinned together",
    Action("save"): "save the scene",
    Action("save_as"): "save under another name",
    Action("files_here"): "open a scene file of this folder",
    Action("reload"): "load the scene's file again",
    Action("undo_sheet"): "undo",
    Action("redo_sheet"): "redo",
    Action("number", -1): "the value above it",
    Action("number", 1): "the value below it",
    Action("choose", -1): "the dimension above",
    Action("choose", 1): "the dimension below",
    Action("nudge", -1): "a step less",
    Action("nudge", 1): "a step more",
    Action("nudge", -10): "ten steps less",
    Action("nudge", 10): "ten steps more",
    Action("pass_on", -1): "the row above; the typed value waits",
    Action("pass_on", 1): "the row below; the typed value waits",
    Action("accept"): "take all typed values",
    Action("move", -1): "the one before",
    Action("move", 1): "the next one",
    Action("move", -10): "ten rows up",
    Action("move", 10): "ten rows down",
    Action("row", -1): "the row above",
    Action("row", 1): "the row below",
    Action("scroll", -2): "scroll up",
    Action("scroll", 2): "scroll down",
    Action("turn", -1): "turn the crank a step back",
    Action("turn", 1): "turn the crank a step on",
    Action("turn", -10): "turn the crank ten steps back",
    Action("turn", 10): "turn the crank ten steps on",
    Action("raise", -1): "the one below",
    Action("raise", 1): "the one above",
    **{Action("option", n): f"answer or door {n + 1}" for n in range(9)},
}
"""The names of commands that share a row of the table."""


GROUPS: Mapping[str, tuple[str, tuple[Action, ...]]] = {
    "arrows": (to_say("Arrows"), tuple(Action("vectors", kind) for kind in "vaf")),
    "construction": (
        to_say("Construction"),
        tuple(map(Action, ("closure", "polygons", "large_polygon", "centres", "chain", "ghost"))),
    ),
}
"""The commands behind single buttons of the bar, by name: the title of their list, and their actions."""


def group_key(name: str) -> str:
    """Return the keys of a group's commands, as they are written."""
    keys = {action: key for _, key, action in RUNNING.commands}
    return ", ".join(keys[action] for action in GROUPS[name][1] if len(keys[action]) == 1)


_WRITTEN = {
    **{"left": "←", "right": "→", "up": "↑", "down": "↓", "return": "Enter", "escape": "Esc"},
    **{"pageup": "PgUp", "pagedown": "PgDn", "delete": "Del"},
}


def _as_written(key: str) -> str:
    """Return a key as it is written for readers, as Ctrl+Shift+S."""
    *held, last = key.split("+") if len(key) > 1 else [key]
    return "+".join([*map(str.capitalize, held), _WRITTEN.get(last, last.capitalize())])


def as_text(*, indent: str = "  ") -> str:
    """Return the keys that always hold as plain text, for `--help`; each mode's own are in its help."""
    lines = [*_rows(KEYS), KeyRow("H in a mode", "its own keys")]
    width = max(len(row.keys) for row in lines)
    return "\n".join(f"{indent}{row.keys:<{width}}  {row.words}" for row in lines)
