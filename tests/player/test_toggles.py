"""The one table of what is shown: keys, answers, tapes and options of the commands follow from it."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest

from linkanim.cli.command_table import parse
from linkanim.cli.picture_options import look_of
from linkanim.picture.look import TOGGLES, Look
from linkanim.player.actions import advance
from linkanim.player.keys import RUNNING, Press, as_text
from linkanim.player.state import State, begin
from linkanim.player.tape import Tape
from linkanim.player.tape_file import from_document, to_document
from linkanim.scenes import load

KEYS = [(name, key) for name, toggle in TOGGLES.items() for key in toggle.keys]


@pytest.fixture
def rocker() -> State:
    return begin(load("crank-rocker"))


@pytest.fixture
def laden() -> State:
    """Return a state in which all there is can be shown: there are forces, and another closure."""
    return begin(load("engine"))


def pressed(state: State, key: str) -> State:
    letter = key.removeprefix("shift+")
    bind = RUNNING.bind_of(Press(letter, letter, shift=letter != key))
    assert bind is not None
    return advance(state, [bind.action])


def test_where_nothing_has_a_force_its_key_says_so(rocker: State) -> None:
    state = pressed(rocker, "f")
    assert state.look == rocker.look
    assert state.toast is not None
    assert "crank-rocker: states no mass, spring, damper or load" in state.toast.text


@pytest.mark.parametrize(("name", "key"), KEYS)
def test_a_key_goes_through_all_steps_and_back(rocker: State, laden: State, name: str, key: str) -> None:
    state = laden if key == "f" else rocker
    looks: list[Look] = [state.look]
    texts: list[str | None] = []
    for _ in range(max(len(TOGGLES[name].steps) // len(TOGGLES[name].keys), 2)):
        state = pressed(state, key)
        looks.append(state.look)
        texts.append(state.chip.text if state.chip else None)
    assert looks[-1] == looks[0]
    assert len(set(looks)) == len(looks) - 1
    assert None not in texts
    assert len(set(texts)) == len(texts)
    assert all(replace(look, **{name: getattr(looks[0], name)}) == looks[0] for look in looks)


@pytest.mark.parametrize("name", TOGGLES)
def test_every_step_reads_back_from_a_tape(rocker: State, name: str) -> None:
    toggle = TOGGLES[name]
    step: Any
    for step in toggle.steps or ("rocker.angle", None):
        step = frozenset(step) if name == "vectors" else step
        start = replace(rocker, look=replace(rocker.look, **{name: step}))
        document = json.loads(json.dumps(to_document(Tape(start, 1))))
        assert from_document(document, "mine.tape.json").start.look == start.look


def test_the_help_has_every_key_with_a_title() -> None:
    lines = as_text().splitlines()
    titled = [toggle for toggle in TOGGLES.values() if toggle.title]
    assert len(titled) >= 5
    for toggle in titled:
        assert any(line.split("  ")[1:] and line.endswith(f"  {toggle.title}") for line in lines)


# What the options of a command show; the last two in any order come to the same.
OPTIONS: list[tuple[str, Look]] = [
    ("record press", Look()),
    ("record press --no-trace --no-hud", Look(trace=False, hud=False)),
    ("record press --vectors v,a --polygons", Look(vectors=frozenset("va"), polygons=True)),
    ("record press --names --names --names", Look(names=2)),
    ("record press --chart rocker.angle --theme dark", Look(chart="rocker.angle", theme="dark")),
    ("record press --transparent", Look(background=False)),
    ("draw press --ghost --transparent", Look(ghost=True, background=False, hud=False, material="flat")),
    ("draw press --instant-centres --centrodes", Look(centres=2, hud=False, material="flat")),
    ("draw press --centrodes --instant-centres", Look(centres=2, hud=False, material="flat")),
]


@pytest.mark.parametrize(("line", "look"), OPTIONS, ids=[line for line, _ in OPTIONS])
def test_options_show_what_they_say(line: str, look: Look) -> None:
    assert look_of(load("crank-rocker"), parse(line.split())) == look


# A tape's look as version 0.1.0 wrote it, before there were names, polygons and instant centres.
OLD = {
    "theme": "dark",
    "trace": False,
    "vectors": ["v"],
    "chart": "rocker.angle",
    "hud": True,
    "background": True,
    "zoom": 1.25,
    "pan": [0.1, 0.0],
    "ghost": True,
}


def test_an_old_tape_s_look_is_as_it_was(rocker: State) -> None:
    document = json.loads(json.dumps(to_document(Tape(rocker, 5))))
    document["start"]["look"] = OLD
    document["actions"] = [[1, "vectors", "a"], [2, "ghost"], [3, "theme"], [4, "names"], [5, "centres"]]
    tape = from_document(document, "old.tape.json")
    look = Look(
        theme="dark",
        trace=False,
        vectors=frozenset("v"),
        chart="rocker.angle",
        zoom=1.25,
        pan=(0.1, 0.0),
        ghost=True,
    )
    *_, last = tape.states()
    assert tape.start.look == look
    assert last.look == replace(look, vectors=frozenset("va"), ghost=False, theme="light", names=1, centres=1)
