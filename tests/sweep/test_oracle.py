"""What `check` calls good can be drawn, charted, recorded, reported and opened, within limits.

A few scenes as a rule; five hundred and twenty thousand with `pytest -m long`. A failure names the seed and
the number of its scene: `made(seed, number)` makes it again.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count, cycle, islice
from pathlib import Path
from random import Random

import pytest
from limits import Limits
from outputs import MEGABYTES, OUTPUTS, SECONDS, is_good, written
from random_scenes import scene
from typed_linkages import Document

from linkanim.player import rendering

SEED = 20
PARTS = 4
"""Tests that many scenes are shared among, so that they run side by side."""
ROTATION = tuple(name for name in OUTPUTS if name != "checked")
FEW = (
    "solved",
    "drawn",
    "charted",
    "swept",
    "painted",
    "charted",
    "recorded",
    "solved",
    "played",
    "swept",
    "taped",
)


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


def good_scenes(seed: int, part: int, parts: int) -> Iterator[tuple[int, str, Document]]:
    """Yield the scenes that the reader takes, with their numbers, and how they were made."""
    for number in count(part, parts):
        words, document = scene(seed, number)
        if is_good(document):
            yield number, words, document


def failures(
    drawn: Iterator[tuple[int, str, Document]], rotation: tuple[str, ...], each: int, folder: Path
) -> list[str]:
    """Return a line for every output that could not be made, with the seed and number of its scene.

    Each scene is checked and made into the next few outputs of the rotation.
    """
    found, limits, turn = [], Limits(SECONDS, MEGABYTES), cycle(rotation)
    for number, words, document in drawn:
        case = written(document, folder / str(number), Random(f"{SEED}:{number}"))
        for name in ("checked", *islice(turn, each)):
            try:
                with limits.held():
                    OUTPUTS[name](case)
            except Exception as error:
                found.append(f"made({SEED}, {number}), {words}: {name}: {type(error).__name__}: {error}")
        case.clear()
    return found


def test_a_few_good_scenes_are_made_into_everything(tmp_path: Path) -> None:
    assert failures(islice(good_scenes(SEED, 0, 1), 22), FEW, 1, tmp_path) == []


@pytest.mark.long
@pytest.mark.parametrize("part", range(PARTS))
def test_five_hundred_good_scenes_are_made_into_everything(part: int, tmp_path: Path) -> None:
    drawn = islice(good_scenes(SEED, part, PARTS), 500 // PARTS)
    assert failures(drawn, ROTATION, 2, tmp_path) == []


@pytest.mark.long
@pytest.mark.parametrize("part", range(PARTS))
def test_twenty_thousand_good_scenes_are_made_into_everything(part: int, tmp_path: Path) -> None:
    drawn = islice(good_scenes(SEED + 1, part, PARTS), 20_000 // PARTS)
    assert failures(drawn, ROTATION, 2, tmp_path) == []


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
def test_what_could_once_not_be_made(name: str, tmp_path: Path) -> None:
    document, outputs = FOUND[name]
    case = written(document, tmp_path / "case", Random(1))
    for output in outputs.split():
        OUTPUTS[output](case)
