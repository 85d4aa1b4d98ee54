"""Whatever is thrown at it, it answers in one line, or it has a scene that plays.

2,000 cases as a rule, 20,000 with `pytest -m long`. Each is read in this process: what a command adds,
its exit code and its one line, is tested in cli/test_exits.py.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from linkanim.cli.commands import parse as parse_arguments
from linkanim.cli.exits import one_line
from linkanim.errors import BadInput
from linkanim.player.state import begin
from linkanim.player.tape import Tape
from linkanim.player.tape_file import from_document, read, to_document
from linkanim.scenes import load, names
from linkanim.scenes.read import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse

FEW, MANY = 500, 5_000
"""Cases of each of the four tests: together 2,000, or 20,000 on request."""

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
DOCUMENTS = {name: dict(load(name).document) for name in names()}


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
    said = one_line(str(error)) if start == "" else str(error)
    assert said.startswith(start), said
    assert said.isprintable(), said
    assert 10 < len(said) < 1000, said


def plays(scene: Scene) -> None:
    """Hold a scene to what is promised of any: over its period it is closed, without a gap or a NaN."""
    motion = scene.solve(phase=np.linspace(0, scene.period, 25), derivatives=0)
    for name, points in motion.position.items():
        assert np.isfinite(points).all(), name
    first, last = (np.array([points[k] for points in motion.position.values()]) for k in (0, -1))
    assert np.abs(first - last).max() <= 1e-6 * max(np.abs(first).max(), 1e-300)


def hold_scene(data: st.DataObject) -> None:
    document = spoilt(a_document(data), data)
    try:
        text = tomli_w.dumps(document)
    except (TypeError, ValueError):  # a null, or a text that is none
        text = "x = "
    try:
        scene = scene_from(parse(text, "my.toml"), name="my", where="my.toml")
    except BadInput as error:
        refused_in_a_line(error, "my.toml: ")
    else:
        plays(scene)


def hold_text(data: st.DataObject) -> None:
    whole = tomli_w.dumps(a_document(data))
    at = data.draw(st.integers(0, len(whole)))
    junk = data.draw(
        st.text(max_size=12) | st.sampled_from(["[[", "{" * 40, '"""', "= =", "\r", "a." * 30, "#"])
    )
    text = whole[:at] + junk + whole[at + data.draw(st.sampled_from([0, 0, 5, len(whole)])) :]
    try:
        plays(scene_from(parse(text, "my.toml"), name="my", where="my.toml"))
    except BadInput as error:
        refused_in_a_line(error, "my.toml: ")


TAPE = to_document(Tape(begin(load("crank-rocker")), 90, ()))
TAPE["actions"] = [
    [1, "trace"],
    [5, "speed", 2],
    [9, "scrub", 0.5],
    [20, "zoom", [1, 0.5, 0.5]],
    [30, "edit"],
]


def hold_tape(data: st.DataObject) -> None:
    try:
        tape = from_document(spoilt(TAPE, data), "my.tape.json")
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


def hold_arguments(data: st.DataObject) -> None:
    words = data.draw(st.lists(st.sampled_from(WORDS) | TEXTS, max_size=8))
    try:
        assert parse_arguments(words).command
    except BadInput as error:
        refused_in_a_line(error, "")


@pytest.mark.withstands("bad inputs tried", FEW)
@usual
@given(st.data())
def test_a_scene_in_which_anything_is_wrong(data: st.DataObject) -> None:
    hold_scene(data)


@pytest.mark.withstands("bad inputs tried", FEW)
@usual
@given(st.data())
def test_a_text_that_is_broken_anywhere(data: st.DataObject) -> None:
    hold_text(data)


@pytest.mark.withstands("bad inputs tried", FEW)
@usual
@given(st.data())
def test_a_tape_in_which_anything_is_wrong(data: st.DataObject) -> None:
    hold_tape(data)


@pytest.mark.withstands("bad inputs tried", FEW)
@usual
@given(st.data())
def test_any_command_line(data: st.DataObject) -> None:
    hold_arguments(data)


@pytest.mark.long
@pytest.mark.withstands("bad inputs tried", MANY)
@pytest.mark.parametrize("hold", [hold_scene, hold_text, hold_tape, hold_arguments])
def test_ten_times_as_many(hold: Any) -> None:
    long(given(st.data())(hold))()


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
