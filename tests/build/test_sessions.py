"""Linkages of the catalogue drawn on an empty sheet, by pointer and digits: they move as the scenes do."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
from hand import drawn, gestures

import linkanim


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
)


@pytest.mark.parametrize("session", SESSIONS, ids=lambda session: session.scene)
def test_a_linkage_drawn_by_hand_moves_as_the_catalogue_s(session: Session) -> None:
    assert len(gestures(session.lines)) <= session.most
    building, scene = drawn(session.lines), linkanim.load(session.scene)
    assert building.made.missing == ""
    found = building.made.scene
    assert found
    own, given = found.cycle(48), scene.cycle(48)
    names = {name: session.names.get(name, name) for name in own.position}
    assert sorted(names.values()) == sorted(given.position)
    for name, other in names.items():
        for ours, theirs in ((own.position, given.position), (own.velocity, given.velocity)):
            assert np.array_equal(ours[name], theirs[other], equal_nan=True), name
    assert [names[name] for name in found.trace] == list(scene.trace)
