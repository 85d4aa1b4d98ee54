"""Random linkages by the thousand: each is refused in a sentence, or runs closed, finite and smooth."""

from __future__ import annotations

import json
from collections.abc import Iterable
from itertools import islice

import pytest
from sweeping import outcome
from typed_linkages import Document, linkages

SEED = 20
LONG_SEED = 8
COUNT, PARTS = 120, 2
"""Linkages in the default run, and the tests they are shared among, so that they run side by side."""
COSTLY = {"geared five-bar": 0.3, "six-bar": 0.3}
"""Kinds that take the longest to put together, and how often the default run has them."""


def failures(drawn: Iterable[tuple[str, Document]], *, thorough: int = 1) -> list[str]:
    """Return a line for each linkage that neither is refused nor runs as it must, with its document.

    Every so many-th is looked at thoroughly.
    """
    found = []
    for index, (kind, document) in enumerate(drawn):
        faults = outcome(document, thorough=index % thorough == 0).faults
        if faults:
            found.append(f"{kind}: {'; '.join(faults)}: {json.dumps(document)}")
    return found


@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.slow
def test_hundreds_of_linkages_are_refused_or_run(part: int) -> None:
    drawn = linkages(SEED, COUNT, extras=(0, 0, 0, 1), weights=COSTLY)
    assert failures(islice(drawn, part, None, PARTS), thorough=10) == []


@pytest.mark.long
def test_twenty_thousand_linkages_are_refused_or_run() -> None:
    assert failures(linkages(LONG_SEED, 20_000)) == []


# What sweeps have found, one of a kind: each once jumped, was nowhere, or ended in an exception.
FOUND = {
    "a swing that one dyad leaves nothing of what another leaves": {
        "drive": {"start": "90 deg"},
        "six-bar": {
            "lengths": [6.3, 9.6, 5.9, 1.7, 7.5, 11.2, 5.8, 2.1],
            "ground_angle": "180 deg",
            "assembly": "crossed",
            "assembly2": "crossed",
        },
    },
    "a chain that is shut at the start": {
        "four-bar": {"ground": 2, "crank": 4, "coupler": 2, "rocker": 2, "ground_angle": "90 deg"},
        "joints": {"D1": {"from": ["A", "O4"], "length": [5, 9]}},
    },
    "a dyad between both pins of a rhombus": {
        "four-bar": {"ground": 1, "crank": 1, "coupler": 1, "rocker": 1, "driver": "rocker"},
        "joints": {"D1": {"from": ["A", "B"], "length": [2, 3]}},
    },
    "equal bars whose ends pass through each other": {
        "drive": {"start": "90 deg"},
        "six-bar": {"lengths": [0.6, 0.5, 0.6, 0.5, 0.8, 0.8, 0.8, 0.8], "ground_angle": "45 deg"},
    },
    "equal bars whose ends meet and part the same way": {
        "drive": {"start": "87 deg"},
        "ground": {"O2": [0, 0], "G1": [0, -3], "G2": {"length": 3, "angle": "90 deg"}},
        "joints": {
            "A": {"crank": "O2", "length": 2},
            "S1": {"from": "A", "length": 1, "line": {"through": "G1", "angle": "90 deg"}},
            "D1": {"from": ["G2", "S1"], "length": [4, 4], "side": "right"},
        },
    },
    "a slot whose pin rests in its pivot": {
        "slider-crank": {"crank": 140, "rod": 140, "line_angle": "90 deg", "assembly": "backward"},
        "joints": {"E1": {"slot": {"pivot": "O2", "through": "B"}, "length": 45}},
    },
    "a dyad that is flat for good": {
        "ground": {"O2": [0, 0]},
        "joints": {
            "A": {"crank": "O2", "length": 4},
            "D1": {"from": ["O2", "A"], "length": [2, 2]},
        },
    },
    "a dyad that limits the input and passes a change point on the way": {
        "drive": {"start": "180 deg", "speed": "-20 rpm"},
        "six-bar": {
            "lengths": [3.4, 2.3, 5.5, 0.2, 8.8, 7.2, 1.3, 2.9],
            "ground_angle": "180 deg",
            "link_angle": "90 deg",
            "assembly": "crossed",
        },
    },
    "a tie through a tilted line": {
        "drive": {"start": "90 deg"},
        "ground": {"O2": [0, 0], "G1": [1, 1]},
        "joints": {
            "A": {"crank": "O2", "length": 0.2},
            "S1": {"from": "A", "length": 0.2, "line": {"through": "G1", "angle": "45 deg"}},
        },
    },
    "a crank as long as a ground that is read from coordinates": {
        "drive": {"start": "90 deg"},
        "four-bar": {
            "ground": 15,
            "crank": 50,
            "coupler": 50,
            "rocker": 15,
            "ground_angle": "45 deg",
            "assembly": "crossed",
            "driver": "rocker",
        },
        "ground": {"G1": [0, 0]},
        "joints": {"E1": {"slot": {"pivot": "G1", "through": "B"}, "length": 24}},
    },
    "a slider that never reaches its line": {
        "drive": {"start": "90 deg"},
        "ground": {"O2": [0, 0]},
        "joints": {
            "A": {"crank": "O2", "length": 145},
            "S1": {"from": "A", "length": 45, "line": {"through": "O2", "angle": "180 deg"}},
            "S2": {"from": "S1", "length": 10, "line": {"through": "O2", "offset": -130}},
        },
    },
    # What limits a swing keeps away from its limits where the loop before it folds over at a change point.
    "a slider behind a rhombus that folds over": {
        "drive": {"start": "180 deg"},
        "four-bar": {
            "ground": 30,
            "crank": 30,
            "coupler": 30,
            "rocker": 30,
            "assembly": "open",
            "coupler_point": [-130, 105],
            "driver": "rocker",
        },
        "joints": {
            "S1": {
                "from": "P",
                "length": 85,
                "line": {"through": "O4", "angle": "-30 deg"},
                "side": "backward",
            }
        },
    },
    "a second loop behind one that folds over": {
        "drive": {"start": "0 deg"},
        "six-bar": {
            "lengths": [1.9, 3.1, 5.9, 4.7, 5.1, 3.3, 5.2, 1.0],
            "link_angle": "180 deg",
            "assembly": "open",
            "assembly2": "crossed",
        },
    },
    "a slot behind a loop that folds over": {
        "drive": {"start": "0 deg"},
        "four-bar": {"ground": 1, "crank": 2, "coupler": 6, "rocker": 7, "ground_angle": "90 deg"},
        "ground": {"G1": {"length": 4, "angle": "180 deg"}},
        "joints": {"E1": {"slot": {"pivot": "G1", "through": "B", "offset": 9}, "length": 7}},
    },
    "a dyad behind a rod as long as its crank": {
        "drive": {"start": "200 deg"},
        "slider-crank": {"crank": 130, "rod": 130, "line_angle": "45 deg", "assembly": "backward"},
        "ground": {"G1": [-95, 15]},
        "joints": {"D1": {"from": ["B", "G1"], "length": [105, 105], "side": "right"}},
    },
}


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", FOUND)
def test_what_sweeps_have_found_is_refused_or_runs(name: str) -> None:
    assert outcome(FOUND[name]).faults == ()
