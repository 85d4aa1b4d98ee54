"""The one key table: the window, the help overlay, `--help` and the README all read it.

Keys are named as pygame names its constants (`K_F12` is "f12"), a printable key by its character,
with "ctrl+" and "shift+" in front, so that nothing here needs pygame.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from linkanim.picture.look import TOGGLES
from linkanim.player.input.pad_buttons import PAD
from linkanim.player.state.action import Action, Mode, Value
from linkanim.player.state.tools import TOOLS


class Bind(NamedTuple):
    """One key and what it asks for; `repeats` where holding the key goes on asking."""

    key: str
    action: Action
    repeats: bool = False


class KeyRow(NamedTuple):
    """One line of the help: its subject, the keys as they are written, what they do, what they ask for."""

    subject: str
    keys: str
    words: str
    binds: tuple[Bind, ...] = ()


def _on(keys: str, name: str, value: Value = None, *, held: bool = False) -> tuple[Bind, ...]:
    """Return what each of the keys asks for; `held` where holding it goes on asking."""
    return tuple(Bind(key, Action(name, value), held) for key in keys.split())


def _of_look(name: str) -> tuple[Bind, ...]:
    """Return the keys of a field of the look."""
    toggle = TOGGLES[name]
    members = zip(toggle.keys, toggle.members, strict=True)
    return tuple(Bind(key, Action(name, member)) for key, member in members)


def _looks(subject: str) -> tuple[KeyRow, ...]:
    """Return the lines of the look's fields under a subject."""
    return tuple(
        KeyRow(subject, ", ".join(toggle.keys).upper(), toggle.title, _of_look(name))
        for name, toggle in TOGGLES.items()
        if toggle.subject == subject
    )


def _both(less: str, more: str, name: str, by: int = 1) -> tuple[Bind, ...]:
    return _on(less, name, -by, held=True) + _on(more, name, by, held=True)


def _steps(name: str) -> tuple[Bind, ...]:
    """Return the arrows to the left and right, ten times as far with Shift."""
    return _both("left", "right", name) + _both("shift+left", "shift+right", name, 10)


_IN, _OUT = (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)
_DIGITS = tuple(bind for n in range(9) for bind in _on(f"{n + 1} kp{n + 1}", "select", n))

KEYS: tuple[KeyRow, ...] = (
    KeyRow("play", "Space", "play / pause", _on("space", "pause")),
    KeyRow("play", "← → (Shift: ×10)", "pause, and step the crank", _steps("step")),
    KeyRow("play", "↑ ↓", "speed", _both("down", "up", "speed")),
    KeyRow("play", "D", "direction", _on("d", "direction")),
    KeyRow("play", "R (twice: reset)", "back to the start", _on("r", "start")),
    KeyRow(
        "play",
        "Tab, Shift+Tab, 1–9",
        "next mechanism; 1–9 within the chapter",
        _on("tab", "mechanism", 1) + _on("shift+tab", "mechanism", -1) + _DIGITS,
    ),
    KeyRow("play", "O", "the shelf: all mechanisms", _on("o", "shelf")),
    KeyRow("play", "F3", "the title, and what there is to play", _on("f3", "play", "title door=play")),
    KeyRow("play", "drag the crank pin", "move the crank; so does the chart's cursor"),
    *_looks("look"),
    KeyRow(
        "look",
        "+, −, wheel, drag",
        "zoom, pan",
        _on("+ = kp_plus", "zoom", _IN, held=True) + _on("- kp_minus", "zoom", _OUT, held=True),
    ),
    KeyRow("look", "0, Home", "fit", _on("0 kp0 home", "fit")),
    KeyRow("look", "L", "light / dark", _of_look("theme")),
    KeyRow("look", "U", "sounds: dead centres and limits", _on("u", "sounds")),
    KeyRow("look", "F11", "full screen", _on("f11", "fullscreen")),
    KeyRow("look", "H, F1, ?", "help", _on("h f1 ? shift+/", "help")),
    KeyRow(
        "look",
        "Esc, Q",
        "close, leave full screen, stop recording (Esc); quit",
        _on("escape", "back") + _on("q", "quit"),
    ),
    *_looks("measure"),
    KeyRow(
        "measure",
        "C (Shift: back)",
        "chart: next quantity, off",
        _on("c", "chart", 1) + _on("shift+c", "chart", -1),
    ),
    KeyRow("measure", "X", "the chart's axis: angle, time, phase", _of_look("over")),
    KeyRow("measure", "K", "the list of quantities", _on("k", "list")),
    KeyRow("measure", "Shift+U", "unit of lengths: mm, cm, m, in", _of_look("unit")),
    KeyRow("edit", "E", "edit dimensions (H there: how)", _on("e", "edit")),
    KeyRow(
        "edit",
        "F2, W (Shift: this one)",
        "build it, or draw its path",
        _on("f2", "build") + _on("shift+f2", "build_on") + _on("w", "pencil") + _on("shift+w", "own_trace"),
    ),
    KeyRow(
        "edit", "B (Shift: ghost)", "assembly: the other closure", _on("b", "closure") + _of_look("ghost")
    ),
    KeyRow(
        "edit",
        "Ctrl+Z, Ctrl+Y",
        "undo, redo",
        _on("ctrl+z", "undo", held=True) + _on("ctrl+y ctrl+shift+z", "redo", held=True),
    ),
    KeyRow("keep", "S, F12 (Shift+S: SVG)", "screenshot", _on("s f12", "screenshot") + _on("shift+s", "svg")),
    KeyRow(
        "keep",
        "G, M",
        "record GIF, MP4: start, stop",
        _on("g", "record", "gif") + _on("m", "record", "mp4"),
    ),
    KeyRow("keep", "Shift+G", "hand on: one page that moves", _on("shift+g", "share")),
    KeyRow(
        "keep",
        "Ctrl+S, O",
        "write the scene as a new file; open one",
        _on("ctrl+s", "save") + _on("ctrl+o", "files_here"),
    ),
    KeyRow("keep", "F5", "reloads a scene opened from a file", _on("f5", "reload")),
)
"""Every key of the window, by subject, in the order in which the help shows them."""

EDIT_KEYS: tuple[KeyRow, ...] = (
    KeyRow("in E", "↑ ↓", "choose a dimension", _both("up", "down", "choose")),
    KeyRow("in E", "← → (Shift: ×10)", "nudge it", _steps("nudge")),
    KeyRow(
        "in E",
        "Tab, Shift+Tab",
        "the next row; what is typed here waits",
        _on("tab", "pass_on", 1) + _on("shift+tab", "pass_on", -1),
    ),
    KeyRow(
        "in E",
        "digits, Enter",
        "type a value, with or without a unit; take all values typed",
        _on("return kp_enter", "take") + _on("backspace", "erase", held=True),
    ),
    KeyRow("in E", "Ctrl+B", "swing back on the same closure", _on("ctrl+b", "returns")),
    KeyRow("in E", "Ctrl+R", "reset: the file's dimensions again", _on("ctrl+r", "reset")),
    KeyRow("in E", "click, wheel, drag (Shift: ×10)", "choose a row, nudge its value"),
    KeyRow("in E", "drag joints (Shift: tenths)", "set lengths on the picture, in whole units"),
)
"""What the keys do while the dimensions are being edited."""

LIST_KEYS: tuple[KeyRow, ...] = (
    KeyRow(
        "in K",
        "↑ ↓",
        "choose a quantity",
        _both("up", "down", "move") + _both("pageup", "pagedown", "move", 10),
    ),
    KeyRow("in K", "type", "filter by what is in the name", _on("backspace", "unsift", held=True)),
    KeyRow("in K", "Enter, click", "chart it", _on("return kp_enter", "pick")),
)
"""What the keys do while the list of quantities is open."""

SHELF_KEYS: tuple[KeyRow, ...] = (
    KeyRow(
        "in O",
        "arrows, mouse",
        "choose a mechanism",
        _both("left", "right", "move") + _both("up", "down", "row"),
    ),
    KeyRow("in O", "type", "filter by title or chapter", _on("backspace", "unsift", held=True)),
    KeyRow("in O", "PgUp, PgDn, wheel", "scroll", _both("pageup", "pagedown", "scroll", 2)),
    KeyRow("in O", "Enter, click", "put it on", _on("return kp_enter", "pick")),
)
"""What the keys do while the shelf is open."""

PAUSED_KEYS: tuple[KeyRow, ...] = (
    KeyRow(
        "paused",
        "digits, Enter",
        "go to that input angle",
        _on("return kp_enter", "go") + _on("backspace", "erase_place", held=True),
    ),
)
"""What the keys do beside all others while the picture stands still."""

PENCIL_KEYS: tuple[KeyRow, ...] = (
    KeyRow("in W", "mouse", "draw a path in one stroke; drag its points and the fixed pins"),
    KeyRow(
        "in W",
        "1–9, click",
        "take another answer",
        tuple(bind for n in range(9) for bind in _on(f"{n + 1} kp{n + 1}", "answer", n)),
    ),
    KeyRow("in W", "Ctrl+Z", "take the last stroke or drag back", _on("ctrl+z", "take_back", held=True)),
    KeyRow("in W", "Enter", "keep the linkage as the scene; Esc goes back", _on("return kp_enter", "keep")),
)
"""What the keys do while a path is drawn."""

_UP, _DOWN, _LEFT, _RIGHT = (0.0, 1.0), (0.0, -1.0), (-1.0, 0.0), (1.0, 0.0)


def _aims() -> tuple[Bind, ...]:
    """Return the arrows, which move the cursor by a line of the grid, and with Shift by a fine step."""
    ways = (("up", _UP), ("down", _DOWN), ("left", _LEFT), ("right", _RIGHT))
    lines = (bind for key, way in ways for bind in _on(key, "aim", way, held=True))
    steps = (bind for key, (x, y) in ways for bind in _on(f"shift+{key}", "aim", (x, y, 0.0), held=True))
    return (*lines, *steps)


BUILD_KEYS: tuple[KeyRow, ...] = (
    KeyRow("in F2", "click, drag", "a ground pin; from a pin or joint a bar; twice on a bar: a point of it"),
    KeyRow("in F2", "let go on a joint, line, bar", "joined there, a slider, a slot"),
    KeyRow("in F2", "drag the crank", "turn it; Shift: tenths, Alt: free of the grid, while drawing"),
    *(
        KeyRow("in F2", tool.key, tool.name, _on(tool.key.lower(), tool.action, tool.value))
        for tool in TOOLS
        if len(tool.key) == 1
    ),
    KeyRow(
        "in F2",
        "digits, Enter",
        "type what is chosen; Ctrl+↑ ↓ its other numbers",
        _both("ctrl+up", "ctrl+down", "number") + _on("backspace", "undigit", held=True),
    ),
    KeyRow(
        "in F2",
        "arrows (Shift: fine), Enter",
        "a cursor; press and lift there",
        _aims() + _on("return kp_enter", "enter"),
    ),
    KeyRow("in F2", "I", "a point of the body at the cursor", _on("i insert", "enter", 2)),
    KeyRow("in F2", "Tab, Shift+Tab", "choose", _on("tab", "further", 1) + _on("shift+tab", "further", -1)),
    KeyRow("in F2", "Del", "remove it, and what hangs on it", _on("delete", "remove")),
    KeyRow(
        "in F2",
        "Ctrl+Z, Ctrl+Y",
        "undo, redo",
        _on("ctrl+z", "unbuild", held=True) + _on("ctrl+y ctrl+shift+z", "rebuild", held=True),
    ),
    KeyRow("in F2", "Ctrl+N", "an empty sheet", _on("ctrl+n", "sheet")),
    KeyRow("in F2", "Esc, F2", "let go; leave, the linkage being the scene; F2 goes on"),
)
"""What the keys do on a sheet."""

GAME_KEYS: tuple[KeyRow, ...] = (
    KeyRow(
        "in a game",
        "1–9, click",
        "choose an answer or a door",
        tuple(bind for n in range(9) for bind in _on(f"{n + 1} kp{n + 1}", "option", n)),
    ),
    KeyRow("in a game", "Enter, Space", "go on", _on("return kp_enter space", "next")),
    KeyRow("in a game", "← → (Shift: ×10)", "turn the crank", _steps("turn")),
    KeyRow("in a game", "↑ ↓", "choose", _both("down", "up", "raise")),
    KeyRow("in a game", "Esc", "out of it", ()),
)
"""What the keys do in a game and on the title."""

_OPEN: Mapping[Mode, tuple[KeyRow, ...]] = {
    "edit": EDIT_KEYS,
    "list": LIST_KEYS,
    "shelf": SHELF_KEYS,
    "paused": PAUSED_KEYS,
    "pencil": PENCIL_KEYS,
    "game": GAME_KEYS,
    "build": BUILD_KEYS,
}
_TYPED: Mapping[Mode, tuple[str, frozenset[str]]] = {
    "edit": ("type", frozenset({"space", "h", "e"})),
    "list": ("sift", frozenset({"space", "h", "k"})),
    "shelf": ("sift", frozenset({"space", "h", "o"})),
    "paused": ("type_place", frozenset()),
    "build": ("digits", frozenset()),
}
"""Where what can be printed is typed: the action, and the keys that keep their meaning until it is begun."""


class Press(NamedTuple):
    """A key that went down: its name, the modifiers, and the text it types (empty where none)."""

    key: str
    text: str = ""
    shift: bool = False
    ctrl: bool = False


def bind_of(press: Press, mode: Mode = "play", *, typing: bool = False) -> Bind | None:
    """Return what a key asks for; None where it is not bound.

    In an open list what can be printed is typed there; but for the few keys that keep their meaning while
    nothing has been begun (`typing`).
    """
    if _is_typed(press, mode, typing):
        return Bind(press.key, Action(_TYPED[mode][0], press.text), repeats=True)
    tables = (_OPEN.get(mode, ()), KEYS)
    found = (bind for table in tables for name in _names(press) for bind in _binds(table) if bind.key == name)
    # any other letter goes on in a game, as a title's "any key" has it
    others = Bind(press.key, Action("next")) if mode == "game" and press.text and not press.ctrl else None
    return next(found, others)


def _is_typed(press: Press, mode: Mode, typing: bool) -> bool:
    if mode not in _TYPED or press.ctrl or not press.text or not press.text.isprintable():
        return False
    if mode == "build":
        return typing or press.text in "123456789.-"
    if mode == "paused":
        return press.text in "123456789" or (typing and press.text in "0.")
    return typing or press.key not in _TYPED[mode][1]


def _binds(table: tuple[KeyRow, ...]) -> Iterator[Bind]:
    return (bind for row in table for bind in row.binds)


def _names(press: Press) -> tuple[str, ...]:
    """Return the names a press may be bound under, the most particular first."""
    if press.ctrl:
        return ("ctrl+shift+" + press.key,) if press.shift else ("ctrl+" + press.key,)
    symbol = () if press.text.isalpha() else (press.text,)
    return ("shift+" + press.key, *symbol, press.key) if press.shift else (press.key, *symbol)


def key_names() -> tuple[str, ...]:
    """Return every bound key's name once, without modifiers (a key alone may be '+')."""
    names = (bind.key for table in (KEYS, *_OPEN.values()) for bind in _binds(table))
    return tuple(dict.fromkeys(name.removeprefix("ctrl+").removeprefix("shift+") for name in names))


PAD_KEYS = tuple(KeyRow("gamepad", row.written, row.words) for row in PAD)
"""What the buttons of a gamepad do."""


def help_groups(
    mode: Mode = "play", *, pad: bool = False
) -> tuple[tuple[str, tuple[tuple[str, str], ...]], ...]:
    """Return (subject, its lines of keys and what they do) as the help overlay shows them.

    With a `pad` plugged in its buttons, too.
    """
    rows = KEYS if mode == "paused" else _OPEN.get(mode, KEYS)
    rows += PAD_KEYS if pad else ()
    groups: dict[str, list[tuple[str, str]]] = {}
    for row in rows:
        groups.setdefault(row.subject, []).append((row.keys, row.words))
    return tuple((subject, tuple(lines)) for subject, lines in groups.items())


def _lines() -> tuple[tuple[str, str], ...]:
    """Return all lines of the table, those of an open list told as such."""
    within = (row for table in (*_OPEN.values(), PAD_KEYS) for row in table)
    rows = (*KEYS, *(row._replace(keys=f"{row.subject}: {row.keys}") for row in within))
    return tuple((row.keys, row.words) for row in rows)


def as_text(*, indent: str = "  ") -> str:
    """Return the table as plain text, for `--help`."""
    width = max(len(keys) for keys, _ in _lines())
    return "\n".join(f"{indent}{keys:<{width}}  {words}" for keys, words in _lines())


def as_markdown() -> str:
    """Return the table in Markdown, for the README."""
    return "\n".join(["| key | does |", "|---|---|", *(f"| {keys} | {words} |" for keys, words in _lines())])
