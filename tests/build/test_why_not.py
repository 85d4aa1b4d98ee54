"""What a drawing says when a gesture cannot be, and as long as it does not move."""

from __future__ import annotations

import pytest
from hand import drawn, gesture

from linkanim.build.building import Building

CRANK = "click 0 0; click 100 0; drag 0 0 50 0"
FOUR_BAR = f"{CRANK}; drag 50 0 83 78; drag 83 78 100 0"
GUIDED = "click 0 0; drag guide 0 40 100 40; drag 0 0 30 0"
TERNARY = (
    f"{CRANK}; click 200 0; click 260 0; drag 50 0 60 100; drag 60 100 180 90; drag 180 90 200 0; "
    "drag 120 95 150 150; drag 150 150 260 0"
)

MISSING = (
    ("", "An empty sheet: click where the first ground pin stands"),
    ("click 0 0", "No bar yet: drag one from a ground pin"),
    ("click 0 0; drag guide 0 0 99 0; click slider 50 0", "Nothing is driven: choose a crank or a slider"),
    (f"{CRANK}; choose drive input; delete", "Nothing is driven: choose a crank or a slider"),
    (f"{CRANK}; drag 50 0 83 78", "Mobility 2: one more bar, a second motor or a gear pair; B is loose"),
    # Bars that are drawn in one line hold no less.
    (
        f"{CRANK}; drag 50 0 75 0; drag 75 0 100 0; drag 75 0 75 60",
        "Mobility 2: one more bar, a second motor or a gear pair; C is loose",
    ),
    (f"{CRANK}; drag 50 0 83 78; drag 83 78 120 90", "Mobility 3: 2 more bars, a second motor"),
    # One body too many times over.
    (f"{CRANK}; drag 50 0 100 0", "Bar 3 (O4–A) is one too many: A, O2, O4 are all three pins in one body"),
    (f"{FOUR_BAR}; drag 83 78 0 0", "Bar 5 (O2–B) is one too many: A, B, O2 are all three pins in one body"),
    (
        f"{CRANK}; click 50 90; drag 50 90 70 60; drag 70 60 0 0",
        "B, O2, O6: all three pins in one body, which",
    ),
    (
        f"{GUIDED}; drag 0 0 20 40",
        "B cannot move: its guide and its bar both stand on the ground; remove one",
    ),
    (
        f"{FOUR_BAR}; drag guide 0 78 100 78; drag slider 83 78 40 78",
        "Bar 4 (O4–B) is one too many: O4 and B",
    ),
    (
        f"{GUIDED}; drag slider 30 0 60 40",
        "The guide of A is one too many: it is held without it; remove one",
    ),
    (
        f"{FOUR_BAR}; drag slot 100 0 25 0",
        "The slot of O4 in O2–A is one too many: O4 is held without it; remove one",
    ),
    (
        f"{TERNARY}; click 300 0; drag 120 95 120 150; drag 120 150 300 0",
        "Mobility 0: B, C, P, Q cannot move; remove a bar",
    ),
    # Lengths that do not go together.
    (f"{FOUR_BAR}; type 400", "Bars 3 and 4 (85 and 400 mm) cannot meet at any angle of the input: A–O4 is"),
    (f"{GUIDED}; drag 30 0 60 40; type 9", "Joint B: the bar of 9 mm cannot reach its line of travel from A"),
)

REFUSED = (
    (CRANK, "drag 0 0 100 0", "O2 and O4 stand on the ground, and that is one body already"),
    (CRANK, "drag 50 0 0 0", "Bar O2–A is there already"),
    (CRANK, "drag 50 0 50 0", "A bar needs a length: let go further from A"),
    (CRANK, "drag 50 0 25 0", "A is an end of that bar: let go beside it, or on another bar"),
    (CRANK, "drag 70 90 10 10", "Begin a bar at a pin or a joint; a click sets a ground pin"),
    (CRANK, "double 70 90", "A point lies on a body: double-click on a bar"),
    (CRANK, "double 1 0", "A point lies on a body: double-click on a bar"),
    (
        f"{CRANK}; drag 25 0 25 20",
        "drag 50 0 25 20",
        "A and P are points of one body: move one to set their distance",
    ),
    (CRANK, "drag 25 0 0.3 0", "That is O2 itself: a point of a body lies beside its joints"),
    (CRANK, "drag guide 50 0 50 0", "A guide needs a direction: drag along it"),
    (CRANK, "drag slider 50 0 70 70", "Let the slider go on a guide"),
    (CRANK, "drag slot 50 0 70 70", "Let the slot go on a bar, or on a slider"),
    (CRANK, "drag slot 50 0 25 0", "A is an end of that bar, and cannot slide in it"),
    (
        f"{CRANK}; drag guide 25 0 45 20",
        "drag slider 50 0 40 15",
        "A is an end of that bar, and cannot slide in it",
    ),
    (CRANK, "drag slot 0 0 100 0", "A slot is in a bar, or in a slider that has none: let go on one"),
    (CRANK, "drag gear 50 0 70 70", "A gear pair joins two cranks: drag from one to the other"),
    (CRANK, "drag gear 50 0 100 0", "A gear pair joins two cranks: drag from one to the other"),
    (CRANK, "drag spring 50 0 50 0", "A spring has two ends: let go further from A"),
    (
        CRANK,
        "drag cylinder 0 0 50 0",
        "A cylinder drives a body that turns about a ground pin, from another pin",
    ),
    (f"{GUIDED}; drag 30 0 110 40", "drag slider 110 40 90 40", "B slides on a guide already"),
    (GUIDED, "drag slider 0 0 90 40", "O2 stands on the ground already"),
    (
        f"{CRANK}; drag 25 0 25 20; drag guide 0 60 90 60",
        "drag slider 25 20 90 60",
        "P is a point of a body already",
    ),
    (CRANK, "trace", "Choose a joint to draw its curve"),
    (
        f"{CRANK}; choose joints O4",
        "drive",
        "Choose a crank (a bar on a ground pin), a slider, or a joint of two bars to drive it",
    ),
    (
        f"{CRANK}; drag 50 0 80 0; drag gear 80 0 50 0",  # a planet turns about no ground pin
        "drive",
        "Choose a crank (a bar on a ground pin), a slider, or a joint of two bars to drive it",
    ),
    (f"{CRANK}; choose none none", "delete", "Choose what is to be removed"),
    (f"{CRANK}; choose none none", "move 3 3", "Choose a joint or a guide to move it"),
    (f"{CRANK}; choose none none", "type 3", "Choose what has a length or an angle, then type it"),
    (CRANK, "type 0", "O2–A: length = 0: must be above zero"),
    (CRANK, "type long", 'O2–A: length: "long" is not a length; write "1 mm" or "1 cm" or "1 m" or "1 in"'),
    (f"{CRANK}; double 25 0", "type 0", "P: lies on the axis' first joint itself; give a place beside it"),
    ("", "next", "Nothing is drawn yet: a click sets a ground pin"),
)


def lines(text: str) -> list[str]:
    return [line.strip() for line in text.split(";") if line.strip()]


@pytest.mark.parametrize(("session", "sentence"), MISSING, ids=[sentence[:40] for _, sentence in MISSING])
def test_a_draft_that_does_not_move_says_why(session: str, sentence: str) -> None:
    building = drawn(lines(session))
    assert building.made.scene is None
    assert building.made.missing.startswith(sentence)


@pytest.mark.parametrize(("session", "line", "sentence"), REFUSED, ids=[one[2][:40] for one in REFUSED])
def test_a_gesture_that_cannot_be_says_why_and_draws_nothing(session: str, line: str, sentence: str) -> None:
    before = drawn(lines(session)) if session else Building()
    after = gesture(before, line)
    assert after.sentence == sentence
    assert (after.draft.tables, after.past) == (before.draft.tables, before.past)
