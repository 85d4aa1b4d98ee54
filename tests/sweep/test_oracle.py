"""What `check` calls good can be drawn, charted, recorded, reported and opened, within limits.

A few scenes as a rule; five hundred and twenty thousand with `pytest -m long`. A failure names the seed and
the number of its scene: `made(seed, number)` makes it again.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import count, islice
from pathlib import Path
from random import Random

import pytest
from limits import Limits
from outputs import EVERYTHING, MEGABYTES, OUTPUTS, SECONDS, Case, Failure, Output, is_good, written
from random_scenes import scene
from typed_linkages import Document

from linkanim.cli.exits import guarded
from linkanim.player.window import rendering

SEED = 20
PARTS = 10
"""Tests that many scenes are shared among, so that they run side by side."""
ALWAYS = ("checked", "solved", "swept")
SHARES = {
    "charted": 8,
    "classified": 6,
    "drawn": 4,
    "painted": 3,
    "printed": 1,
    "framed": 1,
    "recorded": 1,
    "reported": 1,
    "taped": 1,
    "played": 1,
}
"""How many of 27 scenes are made into each of the outputs: more into what takes little time."""
ROTATION = tuple(name for name, share in SHARES.items() for _ in range(share))


class _Done:
    def poll(self) -> int:
        return 0


@pytest.fixture(autouse=True)
def no_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """A recording begun in a window starts no process of its own."""
    monkeypatch.setattr(rendering, "_start", lambda command, said: _Done())


def made(seed: int, number: int) -> Document:
    """Return the document of a scene that a failure names."""
    return scene(seed, number)[1]


def good_scenes(seed: int, part: int = 0, parts: int = 1) -> Iterator[int]:
    """Yield the numbers of the scenes that the reader takes."""
    return (number for number in count(part, parts) if is_good(made(seed, number)))


def output_of(number: int) -> str:
    return ROTATION[number % len(ROTATION)]


def failures(seed: int, numbers: Iterable[int], folder: Path) -> list[str]:
    """Return a line for every output that could not be made, with the seed and number of its scene.

    Each scene is checked, solved and swept, and made into the one output that its number chooses.
    """
    limits = Limits(SECONDS, MEGABYTES)
    found = []
    for number in numbers:
        words, document = scene(seed, number)
        case = written(document, folder / str(number), Random(f"{seed}:{number}"))
        for name in (*ALWAYS, output_of(number)):
            if said := fault(OUTPUTS[name], case, limits):
                found.append(f"made({seed}, {number}), {words}: {name}: {said}")
        case.clear()
    return found


def fault(output: Output, case: Case, limits: Limits) -> str | None:
    """Return why an output cannot be made of a scene within the limits; None where it can."""
    try:
        with limits.held():
            output(case)
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return None


@pytest.mark.slow
def test_a_few_good_scenes_are_made_into_everything(tmp_path: Path) -> None:
    numbers = [next(good_scenes(SEED, turn, len(ROTATION))) for turn in map(ROTATION.index, SHARES)]
    assert {output_of(number) for number in numbers} == SHARES.keys()
    assert failures(SEED, numbers, tmp_path) == []


@pytest.mark.long
@pytest.mark.parametrize("part", range(PARTS))
def test_five_hundred_good_scenes_are_made_into_everything(part: int, tmp_path: Path) -> None:
    numbers = islice(good_scenes(SEED, part, PARTS), 500 // PARTS)
    assert failures(SEED, numbers, tmp_path) == []


@pytest.mark.long
@pytest.mark.parametrize("part", range(PARTS))
def test_twenty_thousand_good_scenes_are_made_into_everything(part: int, tmp_path: Path) -> None:
    numbers = islice(good_scenes(SEED + 1, part, PARTS), 20_000 // PARTS)
    assert failures(SEED + 1, numbers, tmp_path) == []


def _endless(case: Case) -> None:
    while True:
        OUTPUTS["solved"](case)


def _endless_command(case: Case) -> None:
    """Take for ever inside of a command, which makes a line and an exit code of whatever ends it."""
    if guarded(lambda: _endless(case)):
        raise Failure("the command failed")


def _greedy(case: Case) -> None:
    kept = bytearray(2 * MEGABYTES * 1_000_000)
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
    "a start whole turns away": (
        {
            "drive": {"cylinder": {"between": ["G", "A"], "from": 60, "to": 90}, "start": "36000 deg"},
            "ground": {"O2": [0, 0], "G": [80, 0]},
            "joints": {"A": {"crank": "O2", "length": 30}},
        },
        "drawn",
    ),
}


@pytest.mark.parametrize("name", FOUND)
@pytest.mark.slow
def test_what_could_once_not_be_made(name: str, tmp_path: Path) -> None:
    document, outputs = FOUND[name]
    case = replace(written(document, tmp_path / "case", Random(1)), ways=(EVERYTHING,))
    for output in outputs.split():
        OUTPUTS[output](case)
