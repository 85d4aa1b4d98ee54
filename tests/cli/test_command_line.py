"""What a command line is read as: the command, and what holds where nothing is said."""

from __future__ import annotations

import re
import sys
from argparse import _SubParsersAction
from pathlib import Path
from typing import Any

import pytest

import linkanim
from linkanim.cli import main
from linkanim.cli.command_table import build, parse
from linkanim.errors import BadInput

# What is on, or has a value, in a command line that says only what it must.
DEFAULTS: list[tuple[list[str], dict[str, Any]]] = [
    ([], {"command": "play", "theme": "light", "material": "lit"}),
    (
        ["record", "press"],
        {"trace": True, "hud": True, "theme": "light", "background": True, "material": "lit"},
    ),
    (["draw", "press"], {"trace": True, "theme": "light", "background": True, "material": "flat"}),
    (["solve", "press"], {}),
    (["info", "press"], {"fluctuation": 0.02}),
    (["scenes"], {}),
    (["check"], {}),
    (["gallery"], {"into": Path("recordings")}),
    (["bench"], {"into": Path("recordings")}),
]


@pytest.mark.parametrize(("words", "on"), DEFAULTS, ids=[" ".join(words) for words, _ in DEFAULTS])
def test_what_is_not_said_is_plain(words: list[str], on: dict[str, Any]) -> None:
    message = {"command": words[0]} if words else {}
    message |= {"scene": words[1]} if words[1:] else {}
    found = {name: value for name, value in vars(parse(words)).items() if value}
    assert found == {**message, **on}


# a scene, a path of any sort, an option of the window's
@pytest.mark.parametrize("word", ["press", "mine.toml", "a/b", "a\\b"])
def test_a_first_word_that_is_a_scene_or_a_path_opens_the_window(word: str) -> None:
    chosen = parse([word, "--theme", "dark"])
    assert (chosen.command, chosen.scene, chosen.theme) == ("play", word, "dark")


def test_the_process_s_own_words_are_read_where_none_are_given(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["linkanim", "info", "press"])
    assert (parse().command, parse().scene) == ("info", "press")


def test_the_version_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[0] == f"linkanim {linkanim.__version__}"
    assert [line.split()[0] for line in said[1:]] == ["Python", "numpy", "pygame-ce", "ffmpeg"]
    assert all(re.match(r"[\w-]+ \S*\d", line) for line in said)


# Words before a value, the most that it may be, and the next.
MOST = [
    (["report", "press", "-o", "r", "--digits"], "15", "16"),
    (["draw", "press", "--poses"], "360", "361"),
    (["draw", "press", "--size"], "16384x1", "1x16385"),
    (["path", "c.csv", "--count"], "999999", "1000000"),
    (["quiz", "press", "--seed"], "9" * 18, "1" + "0" * 18),
    (["solve", "press", "--sweep"], "0:999999:1", "0:1000000:1"),
    (["solve", "press", "--sweep"], "1e12:1e12:1", "1000000000001:1000000000001:1"),
    (["report", "press", "-o", "r", "--speeds"], ",".join(36 * ["1 rpm"]), ",".join(37 * ["1 rpm"])),
]


@pytest.mark.parametrize(("words", "most", "beyond"), MOST, ids=[" ".join(words) for words, *_ in MOST])
def test_a_value_is_read_up_to_its_bound(words: list[str], most: str, beyond: str) -> None:
    parse([*words, most])
    with pytest.raises(BadInput, match=words[-1]):
        parse([*words, beyond])


LONG = "9" * 5_000
"""More digits than Python turns into a number, and than anyone reads."""


def _options() -> list[tuple[str, str]]:
    """Return each command's options that take a value, but for those that any text can be."""
    commands = next(action for action in build()._actions if isinstance(action, _SubParsersAction)).choices
    return [
        (name, action.option_strings[-1])
        for name, parser in commands.items()
        for action in parser._actions
        if action.option_strings and action.nargs != 0 and (action.type not in (None, str, Path))
    ]


@pytest.mark.parametrize(("command", "option"), _options(), ids=str)
def test_a_number_of_thousands_of_digits_is_refused_in_a_short_sentence(command: str, option: str) -> None:
    with pytest.raises(BadInput, match=option) as refused:
        parse([command, f"{option}={LONG}"])
    assert len(str(refused.value)) < 500


# What is told apart later than the command line's words are read.
LATER = (
    ("draw", "kite", "--theme", LONG),
    ("chart", "kite", "--quantity", LONG),
    ("share", "kite", "--chart", LONG),
    ("info", LONG),
    ("quiz", LONG),
    (LONG,),
    ("play", "--game", f"match level=seed-{LONG}"),
    ("play", "--game", f"predict level={LONG}"),
    ("play", "--game", LONG),
    ("record", "kite", "-o", f"{LONG}.gif"),
)


@pytest.mark.parametrize("words", LATER, ids=lambda words: " ".join(words)[:30])
def test_a_word_of_thousands_of_letters_is_refused_in_a_line(
    words: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) in (1, 2)
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "unexpected" not in said
    assert said.count("9") < 200 or words[-1].endswith(".gif")
