"""Dyads before and behind links that are solved together are closed as dyads where they reach no limit."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from test_groups import BUTTERFLY, STEPHENSON_III

from linkanim.scenes import reading
from linkanim.scenes.scene import Scene

POINTS, LINKS = BUTTERFLY["points"], BUTTERFLY["links"]
BEFORE = {"O": [-3, 0.2], "M": [-3.2, 0.9], "N": [-0.8, 1.9]}
BEHIND = {"Q": [9, -3], "K": [8, 2]}
DRIVING = {"crank": ["O", "M"], "coupler": ["M", "N"], "ACD": ["A", "C", "D", "N"]}
DRIVEN = {"JK": ["J", "K"], "KQ": ["K", "Q"]}
TOGETHER = "CE, EFG, BFJ, DHI, GH, IJ"
BESIDE: dict[str, Any] = {
    "points": {
        "O2": [0, 0],
        "O4": [100, 0],
        "O6": [240, 0],
        "A": [22.5, 38.97],
        "B": [102.6, 79.96],
        "P": [161.7, 33],
        "C": [269.9, 84.9],
        "D": [11.1, 19.23],
        "E": [-145.7, -155.9],
        "F": [-22.46, -77.7],
    },
    "links": {
        "ground": ["O2", "O4", "O6"],
        "2": ["O2", "A"],
        "3": ["A", "B"],
        "4": ["O4", "B", "P"],
        "5": ["P", "C"],
        "6": ["O6", "C"],
        "7": ["C", "D"],
        "8": ["O4", "E"],
        "9": ["A", "F"],
        "10": ["E", "F"],
    },
    "slides": {
        "D": {"point": "D", "on": "2", "angle": "60 deg"},
        "F": {"point": "F", "on": "8", "angle": "32.4 deg"},
    },
    "drive": {"joint": "O2", "speed": "1 rad/s"},
}
CASES: dict[str, tuple[Mapping[str, Any], str, int]] = {
    "behind": (
        {
            "points": {**POINTS, **BEHIND},
            "links": {**LINKS, "ground": ["A", "B", "Q"], **DRIVEN},
            "drive": {"joint": "A"},
        },
        TOGETHER,
        1,
    ),
    "before": (
        {
            "points": {**POINTS, **BEFORE},
            "links": {**LINKS, "ground": ["A", "B", "O"], **DRIVING},
            "drive": {"joint": "O"},
        },
        TOGETHER,
        1,
    ),
    "both": (
        {
            "points": {**POINTS, **BEFORE, **BEHIND},
            "links": {**LINKS, "ground": ["A", "B", "O", "Q"], **DRIVING, **DRIVEN},
            "drive": {"joint": "O"},
        },
        TOGETHER,
        2,
    ),
    # the dyads stop the input, the group does not hang on them
    "beside": (BESIDE, "8, 9, 10", 3),
}
"""Linkages with a group among dyads: the links that are solved together, and the number of dyads."""


def read(document: Mapping[str, Any], *, together: bool = False) -> Scene:
    scene, problems = reading.read(
        {"length_unit": "mm", **document}, name="my", where="my.toml", together=together
    )
    assert scene
    assert not problems
    return scene


def dyads(scene: Scene) -> int:
    return sum(joint.dyad for joint in scene.linkage.joints)


@pytest.mark.parametrize(
    ("document", "links", "count"),
    [
        pytest.param(*row, id=name, marks=[pytest.mark.slow] * (name in ("beside", "behind")))
        for name, row in CASES.items()
    ],
)
def test_only_what_has_to_be_is_solved_together(document: Mapping[str, Any], links: str, count: int) -> None:
    scene, whole = read(document), read(document, together=True)
    assert dict(scene.info.lines)["solved together"] == links
    assert (dyads(scene), dyads(whole)) == (count, 0)
    assert scene.info.counts.links == len(document["links"]) + len(document.get("slides", {}))
    assert scene.info.counts.mobility == 1


@pytest.mark.parametrize("case", ["behind", "both"])
def test_it_moves_as_all_of_it_solved_together(case: str) -> None:
    document, *_ = CASES[case]
    scene, whole = read(document), read(document, together=True)
    assert scene.info.counts == whole.info.counts
    phases = np.linspace(-3, 20, 300)
    one, other = (each.solve(phase=phases, speed=1.0) for each in (scene, whole))
    for kind in ("position", "velocity", "acceleration"):
        for name, values in getattr(other, kind).items():
            assert np.abs(getattr(one, kind)[name] - values).max() < 1e-14 * 10


def test_the_swing_that_dyads_leave_is_their_own_to_all_digits() -> None:
    scene = read(BESIDE)
    links = {name: on for name, on in BESIDE["links"].items() if int(name, 36) not in (8, 9, 36)}
    slides = {"D": BESIDE["slides"]["D"]}
    points = {name: at for name, at in BESIDE["points"].items() if name not in "EF"}
    alone = read({**BESIDE, "links": links, "slides": slides, "points": points})
    assert scene.info.input_range == alone.info.input_range
    phases = np.linspace(0, 6, 40)
    found = scene.solve(phase=phases, speed=1.0)
    for name, pair in (("8", "O4 E"), ("9", "A F"), ("10", "E F")):
        p, q = pair.split()
        length = math.dist(BESIDE["points"][p], BESIDE["points"][q])
        far = np.hypot(*(found.position[p] - found.position[q]).T)
        assert np.abs(far - length).max() < 1e-13 * 300, name


def test_where_a_dyad_behind_a_group_stops_the_input_all_is_solved_together() -> None:
    document = {
        **STEPHENSON_III,
        "points": {**STEPHENSON_III["points"], "Q": [60, 40], "K": [58, 20]},
        "links": {
            **STEPHENSON_III["links"],
            "ground": [*STEPHENSON_III["links"]["ground"], "Q"],
            "last": ["E", "K"],
            "rocker": ["K", "Q"],
        },
    }
    scene = read(document)
    assert dyads(scene) in (0, 1)
    found = scene.cycle(200).position
    for p, q in (("E", "K"), ("K", "Q")):
        length = math.dist(document["points"][p], document["points"][q])
        assert np.abs(np.hypot(*(found[p] - found[q]).T) - length).max() < 1e-13 * 60


@pytest.mark.slow
def test_forces_of_dyads_and_group_are_one_balance() -> None:
    document, *_ = CASES["both"]
    loaded = {
        **document,
        "gravity": "9.81 m/s^2",
        "bodies": {name: {"mass": "2 kg", "inertia": "0.01 kg m^2"} for name in ("KQ", "EFG", "coupler")},
    }
    loaded["bodies"] = {name: {**body, "com": [1, 0.2]} for name, body in loaded["bodies"].items()}
    phases = np.linspace(0.1, 6, 30)
    one, other = (read(loaded, together=whole).solve(phase=phases, speed=2.0) for whole in (False, True))
    largest = max(np.abs(x).max() for of in other.reactions.joints.values() for xy in of.values() for x in xy)
    assert (
        np.abs(one.reactions.effort - other.reactions.effort).max()
        < 1e-11 * np.abs(other.reactions.effort).max()
    )
    for joint, of in other.reactions.joints.items():
        for body, force in of.items():
            for a, b in zip(one.reactions.joints[joint][body], force, strict=True):
                assert np.abs(a - b).max() < 1e-10 * largest, (joint, body)
