"""The one key table: the window, the help overlay, `--help` and the README all read it.

Keys are named as pygame names its constants (`K_F12` is "f12"), a printable key by its character,
with "ctrl+" and "shift+" in front, so that nothing here needs pygame.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from linkanim.player.action import Action


class Bind(NamedTuple):
    """One key and what it asks for; `repeats` where holding the key goes on asking."""

    key: str
    action: Action
    repeats: bool = False


class Row(NamedTuple):
    """One line of the help: the keys as they are written, what they do, and what they are bound to."""

    keys: str
    words: str
    binds: tuple[Bind, ...] = ()


def _on(key: str, name: str, value: int | str | tuple[float, ...] | None = None) -> Bind:
    return Bind(key, Action(name, value))


def _held(key: str, name: str, value: int | tuple[float, ...]) -> Bind:
    return Bind(key, Action(name, value), repeats=True)


def _every(keys: str, name: str, value: str | None = None) -> tuple[Bind, ...]:
    return tuple(_on(key, name, value) for key in keys.split())


_IN, _OUT = (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)

KEYS: tuple[Row, ...] = (
    Row("Space", "play / pause", _every("space", "pause")),
    Row(
        "← → (Shift: ×10)",
        "pause, and step the crank",
        (
            _held("left", "step", -1),
            _held("right", "step", 1),
            _held("shift+left", "step", -10),
            _held("shift+right", "step", 10),
        ),
    ),
    Row("↑ ↓", "speed", (_held("up", "speed", 1), _held("down", "speed", -1))),
    Row("D", "direction", _every("d", "direction")),
    Row(
        "Tab, Shift+Tab, 1–9",
        "mechanism",
        (
            _on("tab", "mechanism", 1),
            _on("shift+tab", "mechanism", -1),
            *(_on(str(place + 1), "select", place) for place in range(9)),
            *(_on(f"kp{place + 1}", "select", place) for place in range(9)),
        ),
    ),
    Row("B (Shift: ghost)", "assembly: the other closure", (_on("b", "closure"), _on("shift+b", "ghost"))),
    Row("T", "coupler trace", _every("t", "trace")),
    Row("V, A", "velocity, acceleration vectors", (_on("v", "vectors", "v"), _on("a", "vectors", "a"))),
    Row("C (Shift: back)", "chart: next quantity, off", (_on("c", "chart", 1), _on("shift+c", "chart", -1))),
    Row("E", "edit dimensions (H there: how)", _every("e", "edit")),
    Row("G", "record GIF: start, stop", _every("g", "record", "gif")),
    Row("M", "record MP4: start, stop", _every("m", "record", "mp4")),
    Row("S, F12", "screenshot", _every("s f12", "screenshot")),
    Row("R", "back to the start", _every("r", "start")),
    Row(
        "+, −, wheel, drag",
        "zoom, pan",
        (
            *(_held(key, "zoom", _IN) for key in ("+", "=", "kp_plus")),
            *(_held(key, "zoom", _OUT) for key in ("-", "kp_minus")),
        ),
    ),
    Row("0, Home", "fit", _every("0 kp0 home", "fit")),
    Row("L", "light / dark", _every("l", "theme")),
    Row("F11", "full screen", _every("f11", "fullscreen")),
    Row("H, F1, ?", "help", _every("h f1 ? shift+/", "help")),
    Row("Esc, Q", "close an open overlay (Esc); quit", (_on("escape", "back"), _on("q", "quit"))),
    Row("drag pin, drag cursor", "move the crank; the chart's cursor, too"),
)
"""Every key of the window, in the order in which the help shows them."""

EDIT_KEYS: tuple[Row, ...] = (
    Row("↑ ↓", "choose a dimension", (_held("up", "choose", -1), _held("down", "choose", 1))),
    Row(
        "← → (Shift: ×10)",
        "nudge it",
        (
            _held("left", "nudge", -1),
            _held("right", "nudge", 1),
            _held("shift+left", "nudge", -10),
            _held("shift+right", "nudge", 10),
        ),
    ),
    Row(
        "Tab, Shift+Tab",
        "on with the value typed, to be judged with the others",
        (_on("tab", "pass_on", 1), _on("shift+tab", "pass_on", -1)),
    ),
    Row(
        "digits, Enter",
        "type a value, with or without a unit; take all that is typed",
        (*_every("return kp_enter", "take"), Bind("backspace", Action("erase"), repeats=True)),
    ),
    Row(
        "Ctrl+Z, Ctrl+Y",
        "undo, redo",
        (
            Bind("ctrl+z", Action("undo"), repeats=True),
            Bind("ctrl+y", Action("redo"), repeats=True),
            Bind("ctrl+shift+z", Action("redo"), repeats=True),
        ),
    ),
    Row("Ctrl+S", "write the scene as a new file", _every("ctrl+s", "save")),
)
"""What the keys do while the dimensions are being edited; the others keep their meaning."""

_MEANT = frozenset({"space", "h", "e"})
"""Keys that print and still keep their meaning in the open list, while no value is begun."""


class Press(NamedTuple):
    """A key that went down: its name, the modifiers, and the text it types (empty where none)."""

    key: str
    text: str = ""
    shift: bool = False
    ctrl: bool = False


def bind_of(press: Press, *, editing: bool = False, typing: bool = False) -> Bind | None:
    """Return what a key asks for; None where it is not bound.

    `editing`: the dimensions are open, and what can be printed belongs to the value; `typing`: one has
    been begun, and even the keys that keep their meaning in the list are print.
    """
    if editing and not press.ctrl and _is_typed(press, typing):
        return Bind(press.key, Action("type", press.text), repeats=True)
    tables = (EDIT_KEYS, KEYS) if editing else (KEYS, _ALWAYS)
    found = (bind for table in tables for name in _names(press) for bind in _binds(table) if bind.key == name)
    return next(found, None)


_ALWAYS = EDIT_KEYS[-2:]  # undo, redo and save need no open list


def _is_typed(press: Press, typing: bool) -> bool:
    return press.text.isprintable() and press.text != "" and (typing or press.key not in _MEANT)


def _binds(table: tuple[Row, ...]) -> Iterator[Bind]:
    return (bind for row in table for bind in row.binds)


def _names(press: Press) -> tuple[str, ...]:
    """Return the names a press may be bound under, the most particular first."""
    if press.ctrl:
        return ("ctrl+shift+" + press.key,) if press.shift else ("ctrl+" + press.key,)
    symbol = () if press.text.isalpha() else (press.text,)
    return ("shift+" + press.key, *symbol, press.key) if press.shift else (press.key, *symbol)


def key_names() -> tuple[str, ...]:
    """Return every bound key's name once, without modifiers (a key alone may be '+')."""
    names = (bind.key for table in (KEYS, EDIT_KEYS) for bind in _binds(table))
    return tuple(dict.fromkeys(name.removeprefix("ctrl+").removeprefix("shift+") for name in names))


def help_rows(*, editing: bool = False) -> tuple[tuple[str, str], ...]:
    """Return (keys, what they do) as the help overlay shows them."""
    return tuple((row.keys, row.words) for row in (EDIT_KEYS if editing else KEYS))


def as_text(*, indent: str = "  ") -> str:
    """Return the table as plain text, for `--help`."""
    rows = help_rows() + tuple((f"in E: {keys}", words) for keys, words in help_rows(editing=True))
    width = max(len(keys) for keys, _ in rows)
    return "\n".join(f"{indent}{keys:<{width}}  {words}" for keys, words in rows)


def as_markdown() -> str:
    """Return the table in Markdown, for the README."""
    rows = help_rows() + tuple((f"in E: {keys}", words) for keys, words in help_rows(editing=True))
    return "\n".join(["| key | does |", "|---|---|", *(f"| {keys} | {words} |" for keys, words in rows)])
