"""The key table: one source for window, help and manual."""

from __future__ import annotations

import pytest

from linkanim.picture.board import Board
from linkanim.picture.layout import layout
from linkanim.picture.text import Type
from linkanim.picture.theme import theme_of
from linkanim.player.action import Action
from linkanim.player.actions import is_known
from linkanim.player.keys import (
    KEYS,
    Bind,
    Press,
    Table,
    as_text,
)
from linkanim.player.modes import KEYS_OF, as_markdown, key_names
from linkanim.ui.panels import help_sheet
from linkanim.ui.window import MEANINGS

TABLES: dict[str, Table] = {**{name: one.table for name, one in KEYS_OF.items()}, "play": KEYS}
ROWS = {name: [row for rows in table.values() for row in rows] for name, table in TABLES.items()}
BINDS = [bind for rows in ROWS.values() for row in rows for bind in row.binds]


def action_of(press: Press, mode: str = "play", *, typing: bool = False) -> Action | None:
    bind = KEYS_OF[mode].bind_of(press, typing=typing)
    return bind.action if bind else None


# Every key of the design, pressed as SDL reports it.
PLAYING = {
    "space": (Press("space", " "), Action("pause")),
    "right": (Press("right"), Action("step", 1)),
    "shift+right": (Press("right", shift=True), Action("step", 10)),
    "left": (Press("left"), Action("step", -1)),
    "shift+left": (Press("left", shift=True), Action("step", -10)),
    "up": (Press("up"), Action("speed", 1)),
    "down": (Press("down"), Action("speed", -1)),
    "d": (Press("d", "d"), Action("direction")),
    "tab": (Press("tab", "\t"), Action("mechanism", 1)),
    "shift+tab": (Press("tab", "\t", shift=True), Action("mechanism", -1)),
    "1": (Press("1", "1"), Action("type_place", "1")),
    "9": (Press("9", "9"), Action("type_place", "9")),
    # where digits are typed with Shift, as on French keyboards
    "shift+&, a 1": (Press("", "1", shift=True), Action("type_place", "1")),
    "b": (Press("b", "b"), Action("closure")),
    "shift+b": (Press("b", "B", shift=True), Action("ghost")),
    "t": (Press("t", "t"), Action("trace")),
    "v": (Press("v", "v"), Action("vectors", "v")),
    "a": (Press("a", "a"), Action("vectors", "a")),
    "c": (Press("c", "c"), Action("chart", 1)),
    "e": (Press("e", "e"), Action("edit")),
    "g": (Press("g", "g"), Action("record", "gif")),
    "m": (Press("m", "m"), Action("record", "mp4")),
    "s": (Press("s", "s"), Action("screenshot")),
    "f12": (Press("f12"), Action("screenshot")),
    "shift s": (Press("s", "S", shift=True), Action("svg")),
    "shift g": (Press("g", "G", shift=True), Action("share")),
    "r": (Press("r", "r"), Action("start")),
    "+ as shift and =": (Press("=", "+", shift=True), Action("zoom", (1.0, 0.0, 0.0))),
    "+ on its own key": (Press("+", "+"), Action("zoom", (1.0, 0.0, 0.0))),
    "keypad +": (Press("kp_plus", "+"), Action("zoom", (1.0, 0.0, 0.0))),
    "-": (Press("-", "-"), Action("zoom", (-1.0, 0.0, 0.0))),
    "0": (Press("0", "0"), Action("type_place", "0")),
    "home": (Press("home"), Action("fit")),
    "l": (Press("l", "l"), Action("theme")),
    "f11": (Press("f11"), Action("fullscreen")),
    "h": (Press("h", "h"), Action("help")),
    "f1": (Press("f1"), Action("help")),
    "? as shift and /": (Press("/", "?", shift=True), Action("help")),
    "? on another layout": (Press("ß", "?", shift=True), Action("help")),
    "escape": (Press("escape", "\x1b"), Action("back")),
    "q": (Press("q", "q"), Action("quit")),
    "a letter with shift is the letter": (Press("t", "T", shift=True), Action("trace")),
    "n": (Press("n", "n"), Action("names")),
    "k": (Press("k", "k"), Action("list")),
    "o": (Press("o", "o"), Action("shelf")),
    "ctrl+s": (Press("s", "\x13", ctrl=True), Action("save")),
    "ctrl+z": (Press("z", "\x1a", ctrl=True), Action("undo")),
    "ctrl+y": (Press("y", "\x19", ctrl=True), Action("redo")),
    "ctrl with another letter": (Press("d", "\x04", ctrl=True), None),
    "an unbound key": (Press("z", "z"), None),
}


@pytest.mark.parametrize(("press", "action"), PLAYING.values(), ids=PLAYING)
def test_a_key_asks_for_what_the_table_says(press: Press, action: Action | None) -> None:
    assert action_of(press) == action


# With the dimensions open all print belongs to the value, but Space, H and E until one is begun.
EDITING = {
    "up chooses": (Press("up"), False, Action("choose", -1)),
    "right nudges": (Press("right"), False, Action("nudge", 1)),
    "shift+left nudges by ten": (Press("left", shift=True), False, Action("nudge", -10)),
    "a digit begins a value": (Press("7", "7"), False, Action("type", "7")),
    "zero begins a value": (Press("0", "0"), False, Action("type", "0")),
    "minus begins a value": (Press("-", "-"), False, Action("type", "-")),
    "a letter begins a value": (Press("d", "d"), False, Action("type", "d")),
    "a letter that quits elsewhere": (Press("q", "q"), False, Action("type", "q")),
    "a plus begins a value": (Press("=", "+", shift=True), False, Action("type", "+")),
    "a keypad's digit": (Press("kp7", "7"), False, Action("type", "7")),
    "a letter no key is named after": (Press("", "ö"), False, Action("type", "ö")),
    "h still helps": (Press("h", "h"), False, Action("help")),
    "h belongs to the value": (Press("h", "h"), True, Action("type", "h")),
    "e still closes": (Press("e", "e"), False, Action("edit")),
    "e belongs to the value": (Press("e", "e"), True, Action("type", "e")),
    "f1 helps while typing": (Press("f1"), True, Action("help")),
    "a letter belongs to the unit": (Press("d", "d"), True, Action("type", "d")),
    "space belongs to the value": (Press("space", " "), True, Action("type", " ")),
    "space still pauses": (Press("space", " "), False, Action("pause")),
    "enter takes": (Press("return", "\r"), True, Action("accept")),
    "backspace erases": (Press("backspace", "\x08"), True, Action("erase")),
    "escape goes back": (Press("escape", "\x1b"), True, Action("back")),
    "tab passes on": (Press("tab", "\t"), True, Action("pass_on", 1)),
    "shift+tab passes back": (Press("tab", "\t", shift=True), False, Action("pass_on", -1)),
    "ctrl+s saves": (Press("s", "s", ctrl=True), True, Action("save")),
    "ctrl+shift+z is redo": (Press("z", "", shift=True, ctrl=True), False, Action("redo")),
}


@pytest.mark.parametrize(("press", "typing", "action"), EDITING.values(), ids=EDITING)
def test_a_key_while_the_dimensions_are_open(press: Press, typing: bool, action: Action | None) -> None:
    assert action_of(press, "edit", typing=typing) == action


# With the list of quantities open what can be drawn filters it; but Space, H and K, until it does.
LISTING = {
    "up": (Press("up"), False, Action("move", -1)),
    "page down": (Press("pagedown"), False, Action("move", 10)),
    "a letter filters": (Press("v", "v"), False, Action("filter", "v")),
    "a digit filters": (Press("5", "5"), False, Action("filter", "5")),
    "k closes": (Press("k", "k"), False, Action("list")),
    "k filters on": (Press("k", "k"), True, Action("filter", "k")),
    "space pauses": (Press("space", " "), False, Action("pause")),
    "space parts words": (Press("space", " "), True, Action("filter", " ")),
    "backspace": (Press("backspace", "\x08"), True, Action("erase_filter")),
    "enter": (Press("return", "\r"), True, Action("pick")),
    "escape": (Press("escape", "\x1b"), True, Action("back")),
    "ctrl+s is not text": (Press("s", "s", ctrl=True), True, Action("save")),
}


@pytest.mark.parametrize(("press", "typing", "action"), LISTING.values(), ids=LISTING)
def test_a_key_while_the_quantities_are_open(press: Press, typing: bool, action: Action | None) -> None:
    assert action_of(press, "list", typing=typing) == action


# With the shelf open the arrows and Enter are its own, and letters filter it.
BROWSING = {
    "left": (Press("left"), Action("move", -1)),
    "down": (Press("down"), Action("row", 1)),
    "enter": (Press("return", "\r"), Action("put_chosen")),
    "o closes": (Press("o", "o"), Action("shelf")),
    "escape": (Press("escape", "\x1b"), Action("back")),
    "l": (Press("l", "l"), Action("filter", "l")),
    "page down": (Press("pagedown"), Action("scroll", 2)),
    "f11": (Press("f11"), Action("fullscreen")),
}


@pytest.mark.parametrize(("press", "action"), BROWSING.values(), ids=BROWSING)
def test_a_key_while_the_shelf_is_open(press: Press, action: Action | None) -> None:
    assert action_of(press, "shelf") == action


def test_the_help_goes_by_subjects() -> None:
    assert tuple(subject for subject, _ in KEYS_OF["play"].help_groups) == (
        "play",
        "look",
        "measure",
        "edit",
        "keep",
    )
    assert [subject for subject, _ in KEYS_OF["list"].help_groups] == ["in K"]


def test_keys_that_hold_are_those_that_move() -> None:
    held = {bind.action.name for bind in BINDS if bind.repeats}
    assert held == {
        *("step", "speed", "zoom", "choose", "nudge", "erase", "undo", "redo"),
        *(
            "move",
            "row",
            "erase_filter",
            "scroll",
            "undo_sketch",
            "erase_place",
            "erase_name",
            "turn",
            "raise",
        ),
        *("aim", "lift", "number", "further", "erase_number", "undo_sheet", "redo_sheet", "dial_on"),
        *("record_row", "record_turn", "erase_target", "erase_caption", "tolerate"),
    }


@pytest.mark.parametrize("mode", ["edit", "list"])
def test_a_letter_that_is_typed_repeats_while_it_is_held(mode: str) -> None:
    bind = KEYS_OF[mode].bind_of(Press("7", "7"), typing=True)
    assert bind
    assert bind.repeats


@pytest.mark.parametrize("bind", BINDS, ids=lambda bind: bind.key)
def test_every_key_asks_for_a_known_action(bind: Bind) -> None:
    assert is_known(bind.action) or bind.action.name in MEANINGS


@pytest.mark.parametrize("table", ROWS)
def test_no_key_is_bound_twice_in_a_table(table: str) -> None:
    keys = [bind.key for row in ROWS[table] for bind in row.binds]
    assert len(keys) == len(set(keys))


def test_help_text_and_manual_show_every_row() -> None:
    for mode, rows in ROWS.items():
        for keys, words, _ in rows:
            assert any(keys in line and words in line for line in as_markdown().splitlines())
            assert mode != "play" or any(keys in line and words in line for line in as_text().splitlines())


def test_key_names_are_pygame_constants() -> None:
    import pygame

    missing = [n for n in key_names() if len(n) > 1 and not hasattr(pygame, f"K_{n.upper()}")]
    assert missing == []


@pytest.mark.parametrize(("mode", "room"), [("play", 640), ("play", 560), ("edit", 640), ("edit", 390)])
def test_all_of_the_help_is_there_in_a_small_window_too(
    mode: str, room: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[str] = []
    monkeypatch.setattr(Type, "draw", lambda *words, **_: drawn.append(words[2]))
    board, groups = Board(layout((640, 360)), Type(), theme_of("light")), KEYS_OF[mode].help_groups
    sheet = help_sheet(board, (groups, room)).sheet
    assert sheet.get_width() <= room
    assert sheet.get_height() <= 360
    for keys, does in (line for _, lines in groups for line in lines):
        assert keys in drawn
        assert does in " ".join(drawn) or set(does.split()) <= set(" ".join(drawn).split())


def test_commands_in_the_list_are_told_apart_by_their_words() -> None:
    words = [said for said, _, _ in KEYS_OF["play"].commands]
    assert sorted(words) == sorted(set(words))


@pytest.mark.parametrize("mode", sorted(name for name, one in KEYS_OF.items() if not one.alone))
def test_of_keys_that_step_each_is_called_by_its_own_way_in_the_list(mode: str) -> None:
    of_several = {
        row.words
        for row in (*ROWS["play"], *ROWS.get(mode, ()))
        if len({bind.action.value for bind in row.binds if isinstance(bind.action.value, int)}) > 1
    }
    steps = [said for said, _, action in KEYS_OF[mode].commands if isinstance(action.value, int)]
    assert [said for said in steps if said in of_several] == []
