"""Linkages of the catalogue drawn on an empty sheet, by pointer and digits: they move as the scenes do."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from hand import drawn, gestures, taped

import linkanim
from linkanim.player.tape_file import read, write
from linkanim.scenes.scene import Scene


class Session(NamedTuple):
    """A linkage drawn: in how many gestures at the most, and which of its joints is which of the scene's."""

    scene: str
    most: int
    lines: str
    names: dict[str, str] = {}  # noqa: RUF012


SESSIONS = (
    Session(
        "crank-rocker",
        8,
        """
        click 0 0
        click 100 0
        drag 0 0 50 0
        drag 50 0 83 78
        drag 83 78 100 0
        drag 67 39 146 46  # from the coupler's middle: a point of it
        trace
        """,
    ),
    Session(
        "slider-crank",
        14,
        """
        click 0 0
        drag guide 0 0 100 0
        type 0
        type 20
        drag 0 0 20 35
        type 40
        drag 20 35 138 20
        type 120
        double 79 27
        type 60
        type 40
        trace
        """,
    ),
    Session(
        "inverted-slider-crank",
        8,
        """
        click 0 0
        click -110 0
        drag 0 0 50 0
        drag -110 0 90 0
        drag slot 50 0 -50 0
        choose joints B
        trace
        """,
        {"B": "P"},
    ),
    Session(
        "whitworth",
        16,
        """
        click 0 0
        click 0 -40
        drag 0 0 80 0
        drag 0 -40 125 23
        drag slot 80 0 30 -25
        drag 30 -25 -54 -67
        drag guide 0 -40 100 -40
        drag -54 -67 175 -40
        choose joints A
        trace
        choose joints P
        trace
        """,
        {"B": "P", "P": "B", "C": "R"},
    ),
    Session(
        "scotch-yoke",
        8,
        """
        click 0 0
        drag 0 0 40 69
        drag guide 0 0 -100 0
        type 0
        click slider 40 0
        drag slot 40 69 40 0
        choose joints A
        trace
        """,
        {"B": "Y"},
    ),
    Session(
        "six-bar",
        40,
        """
        click 0 0
        click 100 0
        click 240 0
        drag 0 0 22 39
        type 45
        type 60
        drag 22 39 103 80
        type 90
        drag 103 80 100 0
        type 80
        drag 101 40 162 33  # a point of link 4
        type 35.000000000000014
        type -60.62177826491071
        drag 162 33 270 85
        type 120
        drag 270 85 240 0
        type 90
        drag 62 59 35 113
        type 45
        type 60
        trace
        drag 216 59 185 88
        type 45
        type 40
        trace
        """,
        {"P": "C", "C": "D", "Q": "P", "R": "P2"},
    ),
    Session(
        "press",
        60,
        """
        click 0 0
        click -99 -315
        number 2
        type 330
        type -107.47
        drag 0 0 55 0
        drag -99 -315 -81 -373
        type 61
        drag gear -81 -373 55 0
        type -1
        type -72.55
        drag 55 0 58 -283
        type 283
        drag -81 -373 58 -283
        type 165
        drag guide 0 0 0 100
        drag 58 -283 0 -600
        type 322
        drag 56 -180 101 -140  # from the coupler's middle: a point of it
        type 140
        type 45
        drag spring 0 -600 0 -800
        type 4000
        type 280
        drag damper 101 -140 300 -110
        type 200
        choose joints C
        trace
        choose joints P
        trace
        """,
        {"O4": "O7", "O6": "G", "O8": "S", "B": "D", "C": "B", "D": "C", "P": "H"},
    ),
    Session(
        "jansen",
        40,
        """
        click 0 0
        click -38 -8
        type -38
        type -7.8
        drag 0 0 15 0
        drag 15 0 -24 31
        type 50
        drag -24 31 -38 -8
        type 41.5
        drag 15 0 -27 -45
        type 61.9
        drag -27 -45 -38 -8
        type 39.3
        drag -24 31 -75 8
        type 55.8
        drag -75 8 -38 -8
        type 40.1
        drag -75 8 -59 -28
        type 39.4
        drag -59 -28 -27 -45
        type 36.7
        drag -59 -28 -43 -92
        type 65.7
        drag -43 -92 -27 -45
        type 49
        choose joints F
        trace
        """,
    ),
    Session(
        "oscillating-cylinder",
        8,
        """
        click 0 0
        click -90 0
        drag 0 0 60 0
        drag 60 0 -95 0
        drag slot -90 0 -40 0
        choose joints B
        trace
        """,
        {"B": "P"},
    ),
    Session(
        "driven-piston",
        16,
        """
        click 0 0
        drag guide 0 0 100 0
        click slider 90 0
        drag 90 0 -17 -43
        drag -17 -43 0 0
        type 50
        double 34 -22
        type 60
        type 0
        trace
        choose joints A
        drive
        number 2
        type 65
        type 165
        """,
        {"O2": "O", "A": "C", "B": "A"},
    ),
    Session(
        "excavator",
        40,
        """
        click 0 0
        click 60 -40
        drag 0 0 398 230
        type 460
        type 30
        drag 100 58 179 90  # on the boom: where its cylinder ends
        type 200
        type -12
        drag 100 58 164 187
        type 235
        type 80
        drag 398 230 372 295
        type 70
        drag 372 295 164 187
        type 235
        drag 385 262 524 38  # on the stick
        type -225
        type -45
        drag 385 262 436 256
        type 10
        type -45
        drag 524 38 472 54
        type 55
        drag 472 54 436 256
        type 205
        drag 498 46 554 -70  # on the bucket
        type -60
        type 95
        trace
        drag cylinder 60 -40 179 90
        type 150
        type 215
        type 15
        type 30
        """,
        {"O4": "G", "P": "H", "Q": "K", "B": "S", "R": "B", "S": "L", "C": "M", "T": "N"},
    ),
)

QUICK = ("crank-rocker", "slider-crank", "six-bar", "driven-piston")
"""Sessions played on a tape in every run: a pin, a plate by double click, typed numbers, a driven slider."""


def moves_as(session: Session, found: Scene) -> None:
    """Check that a linkage moves as the catalogue's, bit for bit, and has the same curves drawn."""
    scene = linkanim.load(session.scene)
    own, given = found.cycle(48), scene.cycle(48)
    names = {name: session.names.get(name, name) for name in own.position}
    assert sorted(names.values()) == sorted(given.position)
    for name, other in names.items():
        for ours, theirs in ((own.position, given.position), (own.velocity, given.velocity)):
            assert np.array_equal(ours[name], theirs[other], equal_nan=True), name
    assert [names[name] for name in found.trace] == list(scene.trace)


@pytest.mark.parametrize("session", SESSIONS, ids=lambda session: session.scene)
def test_a_linkage_drawn_by_hand_moves_as_the_catalogue_s(session: Session) -> None:
    assert len(gestures(session.lines)) <= session.most
    building = drawn(session.lines)
    assert building.made.missing == ""
    assert building.made.scene
    moves_as(session, building.made.scene)


@pytest.mark.parametrize(
    "session",
    [
        pytest.param(one, id=one.scene, marks=[] if one.scene in QUICK else pytest.mark.long)
        for one in SESSIONS
    ],
)
def test_a_linkage_drawn_in_the_player_moves_as_the_catalogue_s_off_its_tape(
    session: Session, tmp_path: Path
) -> None:
    write(taped(session.lines), tmp_path / "session.tape.json")
    *_, last = read(tmp_path / "session.tape.json").states()
    assert last.building
    assert last.building.building.made.scene is last.scene
    moves_as(session, last.scene)
