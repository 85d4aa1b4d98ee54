"""Whatever is thrown at it, it answers in one line, or it has a scene that plays; in a second and 200 MB.

320 cases as a rule, 20,000 with `pytest -m long`. Each is read in this process: what a command adds,
its exit code and its one line, is tested in cli/test_exits.py, and has some 40 MB by then.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from limits import Limits

from linkanim.cli import main
from linkanim.cli.command_table import parse as parse_arguments
from linkanim.cli.exits import one_line
from linkanim.errors import BadInput
from linkanim.player.state import begin
from linkanim.player.tape import Tape
from linkanim.player.tape_file import from_document, read, to_document
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse

FEW, MANY = 80, 5_000
"""Cases of each of the four tests: together 320, or 20,000 on request."""
SECONDS, MEGABYTES = 1.0, 150
"""What each may take: processor time, and memory beside what was there before."""

anything = [HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much]
usual = settings(max_examples=FEW, deadline=None, derandomize=True, suppress_health_check=anything)
long = settings(max_examples=MANY, deadline=None, suppress_health_check=anything)

HOSTILE = (
    "",
    " ",
    "A",
    "O2",
    "é",
    "机构",
    "שלום",
    "a" * 33,
    "x.y",
    "\0",
    "a\nb",
    "1/3",
    "1/0",
    "nan deg",
    "\u202e",
)
NUMBERS = st.sampled_from(
    [
        0,
        -0.0,
        1,
        -1,
        12,
        30,
        100,
        5e-324,
        1e-300,
        1e308,
        -1e308,
        math.inf,
        -math.inf,
        math.nan,
        2**63,
        10**400,
    ]
)
TEXTS = st.sampled_from([*HOSTILE, "20 rpm", "90 deg", "3 mm", "1e999 deg", "nan rpm"]) | st.text(max_size=8)
VALUES = st.recursive(
    NUMBERS | TEXTS | st.booleans() | st.floats(-1e3, 1e3),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(TEXTS, inner, max_size=3),
    max_leaves=6,
)
# The double butterfly takes a third of the second that is allowed when nothing is wrong with it.
DOCUMENTS = {name: dict(load(name).document) for name in names() if name != "double-butterfly"}


def a_document(data: st.DataObject) -> dict[str, Any]:
    return DOCUMENTS[data.draw(st.sampled_from(sorted(DOCUMENTS)))]


def places(document: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Return the way to everything in a document: keys and places in lists."""
    inside = document.items() if isinstance(document, dict) else enumerate(document)
    found = []
    for key, value in inside:
        found.append((*path, key))
        if isinstance(value, dict | list | tuple):
            found += places(value, (*path, key))
    return found


def spoilt(document: dict[str, Any], data: st.DataObject) -> dict[str, Any]:
    """Return a copy in which one to three things are other than they were, missing, new or doubled."""
    changed: dict[str, Any] = json.loads(json.dumps(document))
    for _ in range(data.draw(st.integers(1, 3))):
        *way, last = data.draw(st.sampled_from(places(changed) or [("title",)]))
        inside: Any = changed
        for key in way:
            inside = inside[key]
        match data.draw(st.sampled_from(["other", "gone", "new", "again"])):
            case "gone":
                del inside[last]
            case "new" if isinstance(inside, dict):
                inside[data.draw(TEXTS)] = data.draw(VALUES)
            case "again" if isinstance(inside, dict):
                inside[f"{last}2"] = inside[last]
            case _:
                inside[last] = data.draw(VALUES)
    return changed


def refused_in_a_line(error: BadInput, start: str) -> None:
    message = one_line(str(error)) if start == "" else str(error)
    assert message.startswith(start), message
    assert message.isprintable(), message
    assert 10 < len(message) < 1000, message


def plays(scene: Scene) -> None:
    """Hold a scene to what is promised of any: over its period it is closed, without a gap or a NaN."""
    motion = scene.solve(phase=np.linspace(0, scene.period, 25), derivatives=0)
    for name, points in motion.position.items():
        assert np.isfinite(points).all(), name
    first, last = (np.array([points[k] for points in motion.position.values()]) for k in (0, -1))
    assert np.abs(first - last).max() <= 1e-6 * max(np.abs(first).max(), 1e-300)


def refused_or_plays(text: str) -> None:
    try:
        scene = scene_from(parse(text, "my.toml"), name="my", where="my.toml")
    except BadInput as error:
        refused_in_a_line(error, "my.toml: ")
    else:
        plays(scene)


def a_scene_in_which_anything_is_wrong(data: st.DataObject, limits: Limits) -> None:
    document = spoilt(a_document(data), data)
    try:
        text = tomli_w.dumps(document)
    except (TypeError, ValueError):  # a null, or a text that is none
        text = "x = "
    with limits.held():
        refused_or_plays(text)


def a_text_that_is_broken_anywhere(data: st.DataObject, limits: Limits) -> None:
    whole = tomli_w.dumps(a_document(data))
    at = data.draw(st.integers(0, len(whole)))
    junk = data.draw(
        st.text(max_size=12) | st.sampled_from(["[[", "{" * 40, '"""', "= =", "\r", "a." * 30, "#"])
    )
    text = whole[:at] + junk + whole[at + data.draw(st.sampled_from([0, 0, 5, len(whole)])) :]
    with limits.held():
        refused_or_plays(text)


TAPE = to_document(Tape(begin(load("crank-rocker")), 90, ()))
TAPE["actions"] = [
    [1, "trace"],
    [5, "speed", 2],
    [9, "scrub", 0.5],
    [20, "zoom", [1, 0.5, 0.5]],
    [30, "edit"],
]


def a_tape_in_which_anything_is_wrong(data: st.DataObject, limits: Limits) -> None:
    document = spoilt(TAPE, data)
    with limits.held():
        try:
            tape = from_document(document, "my.tape.json")
        except BadInput as error:
            refused_in_a_line(error, "my.tape.json: ")
            return
        for state, phase in tape.pictures(2):
            assert math.isfinite(phase)
            assert state.scene.linkage.joints


# a line of them is read more easily than a list
WORDS = """
play record solve info scenes press kite my.toml -o out.gif out.xyz --size 1280x720 0x0 --fps 25 1e999 --speed
30rpm -30rpm --periods 2 -1 --seconds nan --sweep 0:360:1 0:inf:1 --phase --angle 87deg --json
--csv --vectors v,a --theme dark --chart rocker.angle --reverse --no-trace -- - --for web
""".split()  # noqa: SIM905


def any_command_line(data: st.DataObject, limits: Limits) -> None:
    words = data.draw(st.lists(st.sampled_from(WORDS) | TEXTS, max_size=8))
    with limits.held():
        try:
            assert parse_arguments(words).command
        except BadInput as error:
            refused_in_a_line(error, "")


Case = Callable[[st.DataObject, Limits], None]
Record = Callable[[str, object], None]
cases = pytest.mark.parametrize(
    "case",
    [
        a_scene_in_which_anything_is_wrong,
        a_text_that_is_broken_anywhere,
        a_tape_in_which_anything_is_wrong,
        any_command_line,
    ],
)


def tried(case: Case, how: settings, record: Record) -> None:
    """Try as many cases as `how` says, each held to its limits; record the most that any took."""
    limits = Limits(SECONDS, MEGABYTES)

    @how
    @given(st.data())
    def one(data: st.DataObject) -> None:
        case(data, limits)

    one()
    counted(limits, record)


def counted(limits: Limits, record: Record) -> None:
    record("bad inputs, s of processor time at most", limits.most_seconds)
    record("bad inputs, MB at most", limits.most_mb)


@pytest.mark.withstands("bad inputs tried", FEW)
@cases
@pytest.mark.slow
def test_bad_input(case: Case, record_property: Record) -> None:
    tried(case, usual, record_property)


@pytest.mark.long
@pytest.mark.withstands("bad inputs tried", MANY)
@cases
def test_twenty_thousand_bad_inputs(case: Case, record_property: Record) -> None:
    tried(case, long, record_property)


@pytest.mark.withstands("bad inputs tried")
@pytest.mark.parametrize(
    "junk", [b"", b"\xff\xfe\0", b"\0" * 1000, b"{" * 100, b"\x89PNG\r\n\x1a\n", b"[1, 2"]
)
@pytest.mark.parametrize("suffix", [".toml", ".tape.json"])
def test_bytes_that_are_no_document(tmp_path: Path, junk: bytes, suffix: str) -> None:
    path = tmp_path / f"my{suffix}"
    path.write_bytes(junk)
    with pytest.raises(BadInput) as refusal:
        load(path) if suffix == ".toml" else read(path)
    refused_in_a_line(refusal.value, f"{path}: ")


HEAD = '[ground]\nO = [0, 0]\nQ = [100, 0]\n[joints.A]\ncrank = "O"\nlength = 30\n'
SHORT = "[four-bar]\nground = 100\ncrank = 30\ncoupler = 90\nrocker = 80\n"
MEGABYTE = 999_000

# As heavy as a file may be, each in what something here might take its time over.
HEAVY = {
    "one key of a megabyte": "a" * MEGABYTE + " = 1",
    "keys in keys": "a" + ".a" * 499_000 + " = 1",
    "one number": "a = " + "1" * MEGABYTE,
    "a title of a megabyte": f'title = "{"x" * MEGABYTE}"\n{SHORT}',
    "escaped letters": 'notes = ["' + "\\u0041" * 166_000 + '"]\n' + SHORT,
    "empty lines": SHORT + "\n" * MEGABYTE,
    "comments": SHORT + "#\n" * (MEGABYTE // 2),
    "lines of one text": SHORT + 'x = """' + "\n" * MEGABYTE + '"""',
    "numbers in a list": SHORT + "x = [" + "1.5," * 49_000 + "]",
    "a number a line": SHORT + "x = [" + "1.5,\n" * 49_000 + "]",
    "unknown keys": SHORT + "".join(f"k{i} = 1\n" for i in range(24_000)),
    "unknown tables": SHORT + "".join(f"[a.b{i}]\n" for i in range(24_000)),
    "tables in tables": SHORT + "".join(f"k.j{i}.l.m.n.o = 1\n" for i in range(24_000)),
    "too many joints": HEAD + "".join(f"[joints.J{i}]\n" for i in range(5_000)),
    "names that are too long": HEAD + "".join(f"[joints.{'J' * 1_900}{i}]\n" for i in range(490)),
    "a circle of joints": HEAD
    + "".join(f'[joints.J{i}]\non = ["J{(i + 1) % 490}", "A"]\nat = [{i}, 1]\n' for i in range(490)),
    "bars in a row": HEAD
    + "".join(
        f'[joints.J{i}]\nfrom = ["{f"J{i - 1}" if i else "A"}", "Q"]\nlength = [90, 80]\n' for i in range(490)
    ),
}

MUCH_ALIKE = {
    "comments",
    "lines of one text",
    "a number a line",
    "unknown tables",
    "empty lines",
    "escaped letters",
    "unknown keys",
}
"""Those that another is much like."""


@pytest.mark.thinned(2)
@pytest.mark.withstands("bad inputs tried")
@pytest.mark.parametrize(
    "text",
    [pytest.param(HEAVY[name], id=name, marks=[pytest.mark.long] * (name in MUCH_ALIKE)) for name in HEAVY],
)
@pytest.mark.slow
def test_a_file_as_heavy_as_can_be(
    tmp_path: Path, text: str, record_property: Record, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "my.toml"
    path.write_text(text)
    # half a second on an idle machine, so that a slow or busy one has room
    limits, checked = (Limits(3 * SECONDS, MEGABYTES) for _ in range(2))
    with limits.held(), suppress(BadInput):
        load(path)
    with checked.held():  # reads a file again after each problem
        main(["check", str(path)])
    counted(limits, record_property)
    printed = capsys.readouterr().out.splitlines()
    assert 0 < max(map(len, printed)) < 1000
    assert len(printed) <= 100
