"""What `check` calls good can be drawn, charted, recorded, reported and opened, within limits.

A few scenes as a rule; five hundred and twenty thousand with `pytest -m long`. A failure names the seed and
the number of its scene: `made(seed, number)` makes it again.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from random import Random

import oracle
import pytest
from limits import Limits
from oracle import (
    ROTATION,
    SHARES,
    fault,
    faults,
    faults_apart,
    good_scenes,
    output_of,
    start_nothing,
)
from outputs import EVERYTHING, MEGABYTES, OUTPUTS, Case, Failure, Output, written
from typed_linkages import Document

from linkanim.cli.exits import guarded
from linkanim.player import background

SEED = 20
PARTS = 10
"""Tests that many scenes are shared among, so that they run side by side."""


@pytest.fixture(autouse=True)
def no_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """A recording begun in a window renders nothing."""
    monkeypatch.setattr(background, "_start", start_nothing)


@pytest.mark.long
@pytest.mark.slow
def test_a_few_good_scenes_are_made_into_everything(tmp_path: Path) -> None:
    numbers = [next(good_scenes(SEED, turn, len(ROTATION))) for turn in map(ROTATION.index, SHARES)]
    assert {output_of(number) for number in numbers} == SHARES.keys()
    assert [line for number in numbers for line in faults(SEED, number, tmp_path)] == []


@pytest.mark.long
@pytest.mark.parametrize("part", range(PARTS))
def test_five_hundred_good_scenes_are_made_into_everything(part: int, tmp_path: Path) -> None:
    assert faults_apart(SEED, part, PARTS, 500 // PARTS, tmp_path) == []


@pytest.mark.long
@pytest.mark.parametrize("part", range(PARTS))
def test_twenty_thousand_good_scenes_are_made_into_everything(part: int, tmp_path: Path) -> None:
    assert faults_apart(SEED + 1, part, PARTS, 20_000 // PARTS, tmp_path) == []


@pytest.mark.parametrize(
    ("seed", "number", "output"),
    [
        pytest.param(20, 770, "crowded", id="labels that are alike, of a still"),
        pytest.param(300, 149, "constructed", id="instant centres of which none is at a joint"),
        pytest.param(300, 371, "constructed", id="dead centres of a rod as long as its crank"),
        pytest.param(21, 10953, "recorded", id="the curvature of a path where its rates are unbounded"),
    ],
)
def test_what_once_failed_is_made(seed: int, number: int, output: str, tmp_path: Path) -> None:
    assert faults(seed, number, tmp_path, output) == []


@pytest.mark.slow
def test_a_process_that_does_not_end_well_is_a_fault_with_its_last_scene(tmp_path: Path) -> None:
    [line] = faults_apart(SEED, 3, 1, 1, tmp_path / "missing")
    assert re.match(r"made\(20, \d+\): the process ended with 1: .*FileNotFoundError", line, re.DOTALL)


@pytest.mark.slow
def test_by_hand_it_finds_its_helpers_wherever_it_is_started(tmp_path: Path) -> None:
    words = [oracle.__file__, str(SEED), "3", "1", "0", str(tmp_path)]
    env = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([sys.executable, *words], env=env, cwd=tmp_path, capture_output=True, check=False)
    assert (done.returncode, done.stdout) == (0, b""), done.stderr.decode()


def _endless(case: Case) -> None:
    while True:
        OUTPUTS["solved"](case)


def _endless_command(case: Case) -> None:
    """Take for ever inside of a command, which makes a line and an exit code of whatever ends it."""
    if guarded(lambda: _endless(case)):
        raise Failure("the command failed")


def _greedy(case: Case) -> None:
    kept = bytearray(5 * MEGABYTES * 1_000_000)
    OUTPUTS["solved"](case)
    assert kept


LIMITED: dict[str, tuple[Output, str]] = {
    "an output that never ends": (_endless, r"TooLongError: more than 0\.2 s|Failure: .*TooLongError"),
    "a command that never ends": (_endless_command, "Failure|TooLongError"),
    "an output that takes all the memory": (_greedy, "MemoryError|Failure: .*memory"),
}


# The alarm may ring in a callback of the garbage collector, where Python can but report it; it rings again.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("name", LIMITED)
def test_what_takes_more_than_it_may_is_a_fault(name: str, tmp_path: Path) -> None:
    output, said = LIMITED[name]
    case = written(FOUR_BAR, tmp_path / "case", Random(1))
    found = fault(output, case, Limits(0.2, MEGABYTES))
    assert found is not None
    assert re.match(said, found), found


FOUR_BAR: Document = {"four-bar": {"ground": 100, "crank": 30, "coupler": 90, "rocker": 80}}
PINS: Document = FOUR_BAR | {"ground": {"G": [0, 0], "H": [30, 0]}}

# What was called good and could not be made: the scene, and the outputs that failed.
FOUND: dict[str, tuple[Document, str]] = {
    "a traced ground pin": (FOUR_BAR | {"trace": {"joints": ["O4"]}}, "drawn painted recorded played"),
    "a blank title": (FOUR_BAR | {"title": " "}, "recorded played"),
    "a sentence of a blank": (FOUR_BAR | {"look_at": " "}, "drawn painted latexed recorded played"),
    "a title of two hundred words": (FOUR_BAR | {"title": "long " * 199}, "recorded"),
    "a spring whose ends are one pin": (
        PINS | {"springs": {"s": {"between": ["O2", "G"]}}},
        "drawn painted recorded",
    ),
    "a damper whose ends meet": (
        PINS | {"dampers": {"d": {"between": ["A", "H"], "coefficient": "2 N s/m"}}},
        "drawn painted recorded",
    ),
    "a linkage as large as an orbit": (
        {"slider-crank": {"crank": 2e11, "rod": 6e11, "coupler_point": [3e11, 2e11]}},
        "drawn painted recorded",
    ),
    "a linkage as small as a molecule": (
        {"slider-crank": {"crank": 2e-12, "rod": 6e-12, "coupler_point": [3e-12, 2e-12]}},
        "drawn painted",
    ),
    "gears on pins that are all but one": (
        {
            "ground": {"O2": [0, 0], "O4": [1e-28, 0]},
            "joints": {
                "A": {"crank": "O2", "length": 1},
                "B": {"crank": "O4", "length": 1, "gear": {"with": "A", "ratio": 2}},
            },
        },
        "drawn painted recorded",
    ),
    "a slider that stays all but where it is": (
        {"slider-crank": {"crank": 1e-7, "rod": 90}},
        "drawn painted",
    ),
    "a dyad whose rate is unbounded by another's limit": (
        {
            "drive": {"start": "-60 deg"},
            "ground": {"O2": [0, 0], "G": [-1.5, 0]},
            "joints": {
                "A": {"crank": "O2", "length": 10.5},
                "E": {"slot": {"pivot": "G", "through": "A", "offset": 1.5}, "length": 14.5},
                "S": {
                    "from": "E",
                    "length": 4,
                    "line": {"through": "G", "angle": "0 deg"},
                    "side": "backward",
                },
                "T": {
                    "from": "S",
                    "length": 4.5,
                    "line": {"through": "G", "angle": "45 deg", "offset": 13},
                    "side": "forward",
                },
            },
        },
        "solved",
    ),
    "a dyad between two cranks that turn alike": (
        {
            "drive": {"speed": "3 rad/s", "start": "90 deg"},
            "ground": {"O2": [0, 0], "G": [40, 43]},
            "joints": {
                "A": {"crank": "O2", "length": 25},
                "C": {"crank": "O2", "length": 47, "gear": {"with": "A", "ratio": 1, "offset": "0 deg"}},
                "D": {"from": ["A", "C"], "length": [78, 98], "side": "left"},
                "S": {
                    "from": "D",
                    "length": 23,
                    "line": {"through": "G", "angle": "45 deg", "offset": -80},
                    "side": "forward",
                },
            },
        },
        "solved",
    ),
    "dead centres of a slider without a bar": (
        {
            "drive": {"slider": {"joint": "C", "from": 43, "to": 55}},
            "ground": {"O2": [0, 0]},
            "joints": {
                "C": {"line": {"through": "O2", "angle": "-107.47 deg"}},
                "A": {"from": ["C", "O2"], "length": [12, 43], "side": "left"},
            },
            "springs": {"s": {"between": ["A", "C"]}},
            "dampers": {"d": {"between": ["A", "O2"]}},
            "bodies": {"Q": {"slider": "C"}},
        },
        "drawn",
    ),
    "a start whole turns away": (
        {
            "drive": {"cylinder": {"between": ["G", "A"], "from": 60, "to": 90}, "start": "36000 deg"},
            "ground": {"O2": [0, 0], "G": [80, 0]},
            "joints": {"A": {"crank": "O2", "length": 30}},
        },
        "drawn",
    ),
}


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", FOUND)
@pytest.mark.slow
def test_what_could_once_not_be_made(name: str, tmp_path: Path) -> None:
    document, outputs = FOUND[name]
    case = replace(written(document, tmp_path / "case", Random(1)), ways=(EVERYTHING,))
    for output in outputs.split():
        OUTPUTS[output](case)
