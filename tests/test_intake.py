"""Files from outside: what is no file is not waited for, what is too heavy is not parsed."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from limits import Limits

from linkanim.errors import BadInput
from linkanim.intake import DEEPEST, Intake, control_in, named

NOTES = Intake("a note", most_bytes=1_000_000, most_values=1000)

# Deeper than anything that is read: parsers take seconds for the first ones.
DEEP = {
    "dotted": "a" + ".a" * 20_000 + " = 1",
    "dotted with spaces": "a" + " \t. a" * 20_000 + " = 1",
    "dotted in quotes": '"a"' + ".'a'" * 20_000 + " = 1",
    "header": "[" + "a" + ".a" * 20_000 + "]",
    "in an inline table": 'x = { t = """a"""", ' + "a." * 50 + "a = 1 }",
    "after a text of several lines": "x = '''it's'''\n" + "a." * 50 + "a = 1",
    "after an escaped backslash": 'x = "\\\\"\n' + "a." * 50 + "a = 1",
    "after escapes in several lines": 'x = """\\\\\\""" "\\\\"""\n' + "a." * 50 + "a = 1",
    "brackets": "x = " + "[" * 100 + "]" * 100,
    "inline tables": "x = " + "{ a = " * 20 + "1" + " }" * 20,
    "just too deep": "a" + ".a" * DEEPEST + " = 1",
}

# Dots and brackets in texts and comments, and many of them side by side, are no depth.
FLAT = {
    "in a text": 'title = "' + "a." * 100 + "[" * 100 + '"',
    "in a raw text": "title = '" + "{a." * 100 + "'",
    "in a text of several lines": 'title = """' + "a.\n[" * 100 + '"""',
    "after an escaped quote": r'title = "\"' + "a." * 100 + '"',
    "after an escaped quote in several lines": 'title = """\\"""' + "a." * 100 + '"""',
    "in a comment": "# it's " + "a." * 100 + "[" * 100,
    "beside each other": "x = [" + "[1.5, 2.5], " * 100 + "]",
    "line by line": "a.b.c = 1.5\n" * 100,
    "as deep as can be": "a" + ".a" * (DEEPEST - 1) + " = 1",
}


@pytest.mark.parametrize("text", DEEP.values(), ids=DEEP)
def test_what_is_nested_too_deeply_is_refused(text: str) -> None:
    with pytest.raises(BadInput, match=r"^my\.toml: is nested deeper than 16 levels"):
        NOTES.refuse_heavy(text, "my.toml")


@pytest.mark.parametrize("text", FLAT.values(), ids=FLAT)
def test_what_only_looks_deep_is_not(text: str) -> None:
    NOTES.refuse_heavy(text, "my.toml")


# The look itself must not take a time that grows with the square of the length: it has ten times what it
# needs.
@pytest.mark.parametrize(
    "part", ['"""', "'''", '"', '\\"', '"""a', "'\n", "a-", "a.\n", "a ", "[", "#\n", "\\", ". ", "\0"]
)
def test_the_look_takes_no_longer_than_the_text(part: str) -> None:
    patient = Intake("a note", most_bytes=1_000_000, most_values=10_000_000)
    for begun in ("", '"""', '"'):
        with Limits(0.5, 100).held(), suppress(BadInput):
            patient.refuse_heavy(begun + part * (200_000 // len(part)) + "x", "x")


def test_more_values_than_there_can_be_are_refused() -> None:
    NOTES.refuse_heavy("x = [" + "1," * 990 + "]", "my.toml")
    for text in ("x = [" + "1," * 1000 + "]", "[a]\n" * 1001, "k = 1\n" * 1001):
        with pytest.raises(BadInput, match="has more than 1,000 values; it is not a note"):
            NOTES.refuse_heavy(text, "my.toml")


def test_a_device_is_not_read() -> None:
    for device in ("/dev/zero", "/dev/full"):
        if Path(device).exists():
            with pytest.raises(BadInput, match="is not a file with text in it; name a note"):
                NOTES.read(Path(device), device)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes with names are a POSIX thing")
def test_a_pipe_is_refused_rather_than_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(BadInput, match="is not a file"):
        NOTES.read(tmp_path / "pipe", "pipe")


def test_a_file_that_changes_while_it_is_read_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "note"
    path.write_text("before")
    fstat, written = os.fstat, iter(["before", "after, and longer"])

    def watched(descriptor: int) -> Any:
        path.write_text(next(written))
        return fstat(descriptor)

    monkeypatch.setattr("linkanim.intake.os.fstat", watched)
    with pytest.raises(BadInput, match="note: changed while it was read"):
        NOTES.read(path, "note")
    monkeypatch.undo()
    assert NOTES.read(path, "note") == "after, and longer"


def test_a_path_is_shown_on_one_line() -> None:
    assert named(Path("a\nb\0.toml")) == "a?b?.toml"


CONTROLS = (
    "\0",
    "\x07",
    "\x1b",
    "\x7f",
    "\x85",
    "\x9b",
    "\u2028",
    "\u2029",
    "\u061c",
    "\u200e",
    "\u200f",
    "\u202e",
    "\u2063",
    "\u2066",
    "\ufffa",
    "\U000e0041",
    "\ud800",
    "\uffff",
)
PLAIN = (
    "",
    "two\nlines\tand\r",
    "é",
    "e\u0301",
    "机构",
    "שלום",
    "می\u200cخواهم",
    "👩\u200d🔧",
    "a\u00a0b",
    "\u00ad",
)


@pytest.mark.parametrize("char", CONTROLS, ids=lambda char: f"U+{ord(char):04X}")
def test_what_a_terminal_obeys_or_no_page_may_hold_is_found(char: str) -> None:
    assert control_in(f"plain {char} text") == f"the control character U+{ord(char):04X}"


@pytest.mark.parametrize("text", PLAIN)
def test_what_is_written_in_any_script_is_plain(text: str) -> None:
    assert control_in(text) is None
