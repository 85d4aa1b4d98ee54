"""The table of gestures: each as hands make it, either way round, with undo, and as a tape."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import pytest
from hand import Hand, drawn, gesture

from linkanim.build.building import Building, redo, undo
from linkanim.build.meanings import meanings
from linkanim.player.tape import Tape

CRANKS = "click 0 0; click 100 0; drag 0 0 30 0; drag 100 0 130 20"
"""O2–A is driven, O4–B is free."""
TWO_FREE = f"{CRANKS}; click 200 0; drag 200 0 220 25"
LEVER = "click 0 0; click 0 -120; drag 0 0 50 0; drag 0 -120 60 60"
"""The crank O2–A, and the lever O4–B beside it."""
CRANK = "click 0 0; click 0 -120; drag 0 0 50 0"
BOOM = "click 0 0; click 60 -40; drag 0 0 200 0"
"""A boom, and the pin on which its cylinder stands."""
ROCKER = "click 0 0; click 100 0; drag 0 0 30 0; drag 30 0 90 80; drag 90 80 100 0"

PLATE = f"{ROCKER}; drag 60 40 40 90; click 200 100"
"""The coupler is a plate of A, B and P."""


class Gesture(NamedTuple):
    """A gesture on a drawing, and what it adds there, by kind and name; `others` is what else it can mean."""

    begin: str
    line: str
    adds: Mapping[str, Mapping[str, object]]
    others: int = 0

    @property
    def name(self) -> str:
        """What the test is called."""
        return f"{self.line} on {self.begin[-30:]}"


def gear(joint: str, mate: str) -> Mapping[str, Mapping[str, object]]:
    return {"gears": {joint: mate}}


FOLLOWS = gear("B", "A")
SLOT: Mapping[str, Mapping[str, object]] = {"slots": {"A in O4–B": "A"}}
GESTURES = [
    # a gear pair: from pin to pin, bar to bar, ground pin to ground pin; the driven crank leads
    *(
        Gesture(CRANKS, f"drag gear {start} {end}", FOLLOWS)
        for one, other in (("30 0", "130 20"), ("15 0", "115 10"), ("0 0", "100 0"), ("30 0", "100 0"))
        for start, end in ((one, other), (other, one))
    ),
    Gesture(TWO_FREE, "drag gear 220 25 130 20", gear("C", "B")),
    Gesture(TWO_FREE, "drag gear 130 20 220 25", gear("B", "C")),
    # a slot: joint and bar, either first; from the lever's pivot over the crank's pin; a lever that is there
    Gesture(LEVER, "drag slot 50 0 30 -30", SLOT),
    Gesture(LEVER, "drag slot 30 -30 50 0", SLOT),
    Gesture(LEVER, "drag slot 0 -120 50 0", SLOT),
    Gesture(LEVER, "drag slot 50 0 0 -120", SLOT),
    Gesture(CRANK, "drag slot 0 -120 50 0", {"bars": {"O4–B": None}, **SLOT}),
    Gesture(CRANK, "drag slot 50 0 0 -120", {"bars": {"O4–B": None}, **SLOT}),
    Gesture(CRANK, "drag slot 0 -120 75 60", {"bars": {"O4–B": None}, **SLOT}),
    # the bar from the crank's pin onto a lever: near by it is a slot; further away it may be a bar
    Gesture(LEVER, "drag bar 50 0 40 0", SLOT, others=2),
    Gesture(LEVER, "drag bar 50 0 20 -60", {"bars": {"A–C": None}, "slots": {"C in O4–B": "C"}}, others=2),
    # on the side of a plate, between its point and its bar, there is no slot: the bar is pinned there
    Gesture(PLATE, "drag bar 200 100 65 85", {"points": {"Q": None}, "bars": {"O6–Q": None}}),
    Gesture(PLATE, "drag spring 200 100 65 85", {"points": {"Q": None}, "springs": {"spring": None}}),
    # a cylinder, a spring, a damper from and to a bar: the point is made there; on paper a ground pin is
    Gesture(BOOM, "drag cylinder 60 -40 120 0", {"points": {"P": None}, "drive": {"input": None}}),
    Gesture(BOOM, "drag cylinder 120 0 60 -40", {"points": {"P": None}, "drive": {"input": None}}),
    *(
        Gesture(
            BOOM,
            f"drag cylinder {ends}",
            {"pins": {"O6": None}, "points": {"P": None}, "drive": {"input": None}},
        )
        for ends in ("120 0 90 -60", "90 -60 120 0")
    ),
    *(
        Gesture(ROCKER, f"drag {kind} {start} {end}", {"points": {"P": None}, f"{kind}s": {kind: None}})
        for kind in ("spring", "damper")
        for start, end in (("0 0", "95 40"), ("95 40", "0 0"))
    ),
    Gesture(
        ROCKER, "drag spring 60 40 95 40", {"points": {"P": None, "Q": None}, "springs": {"spring": None}}
    ),
    Gesture(ROCKER, "drag damper 150 60 90 80", {"pins": {"O6": None}, "dampers": {"damper": None}}),
]


def lines(text: str) -> list[str]:
    return [line.strip() for line in text.split(";")]


def added(before: Building, after: Building) -> dict[str, set[str]]:
    kinds = ("pins", "bars", "points", "guides", "sliders", "slots", "yokes", "gears", "springs", "dampers")
    found = {kind: {*after.draft.of(kind)} - {*before.draft.of(kind)} for kind in kinds}
    if after.draft.drive != before.draft.drive:
        found["drive"] = {"input"}
    return {kind: names for kind, names in found.items() if names}


@pytest.mark.parametrize("one", GESTURES, ids=[one.name for one in GESTURES])
def test_a_gesture_does_what_it_can_only_mean(one: Gesture) -> None:
    before = drawn(lines(one.begin))
    after = gesture(before, one.line)
    assert added(before, after) == {kind: {*names} for kind, names in one.adds.items()}, after.sentence
    for joint, mate in one.adds.get("gears", {}).items():
        assert after.draft.of("gears")[joint]["with"] == mate
    for name, through in one.adds.get("slots", {}).items():
        assert after.draft.of("slots")[name]["through"] == through


@pytest.mark.parametrize("one", GESTURES, ids=[one.name for one in GESTURES])
def test_one_undo_takes_a_gesture_back_and_redo_does_it_again(one: Gesture) -> None:
    before = drawn(lines(one.begin))
    after = gesture(before, one.line)
    assert undo(after).draft.tables == before.draft.tables
    assert redo(undo(after)).draft == after.draft


@pytest.mark.parametrize("one", GESTURES, ids=[one.name for one in GESTURES])
def test_what_a_gesture_can_mean_is_offered_each_once(one: Gesture) -> None:
    _, tool, *places = one.line.split()
    found = meanings(drawn(lines(one.begin)), tool, *map(float, places), reach=3.0, snap=1.0)
    assert len(found) == 1 + one.others
    assert len({meaning.words for meaning in found}) == len(found)
    assert all(meaning.words and meaning.building.past for meaning in found)


@pytest.mark.parametrize("one", GESTURES, ids=[one.name for one in GESTURES])
def test_a_gesture_is_on_a_tape(one: Gesture) -> None:
    hand = Hand()
    for line in [*lines(one.begin), one.line]:
        hand.gesture(line)
    tape: Tape = hand.tape
    *_, last = tape.states()
    assert last.building
    assert last.building.building.draft == hand.building.draft
    assert last.building.building.draft.tables == drawn([*lines(one.begin), one.line]).draft.tables


@pytest.mark.parametrize("tool", ["bar", "spring", "damper"])
def test_what_is_let_go_on_the_side_of_a_plate_is_pinned_there(tool: str) -> None:
    after = gesture(drawn(lines(PLATE)), f"drag {tool} 200 100 65 85")
    assert after.draft.places["Q"] == pytest.approx((65, 85), abs=0.5)
    back = gesture(drawn(lines(PLATE)), "drag bar 40 90 65 85")
    assert (back.sentence, back.is_refusal) == (
        "P and Q are points of one body: move one to set their distance",
        True,
    )
    assert back.draft.tables == drawn(lines(PLATE)).draft.tables


QUICK_RETURNS = (
    f"{CRANK}; drag slot 0 -120 50 0",
    f"{CRANK}; drag 0 -120 60 60; drag slot 50 0 30 -30",
    "click 0 -120; click 0 0; drag 0 0 50 0; drag slot 0 -120 75 60",
    f"{LEVER}; drag bar 50 0 40 0",
)
GEARED = (
    f"{CRANKS}; drag gear 0 0 100 0; drag 30 0 60 90; drag 130 20 60 90",
    f"{CRANKS}; drag 30 0 60 90; drag 130 20 60 90; drag gear 130 20 30 0",
    "click 100 0; click 0 0; drag 0 0 30 0; drag 100 0 130 20; drag 30 0 60 90; drag 60 90 130 20; "
    "drag gear 15 0 115 10",
)
EXCAVATORS = (
    f"{BOOM}; drag cylinder 60 -40 120 0",
    f"{BOOM}; drag cylinder 120 0 60 -40",
    "click 0 0; drag 0 0 200 0; drag 120 0 120 30; drag cylinder 60 -40 120 30",
)


@pytest.mark.parametrize("session", [*QUICK_RETURNS, *GEARED, *EXCAVATORS], ids=lambda text: text[-40:])
def test_a_linkage_moves_in_whatever_order_it_is_drawn(session: str) -> None:
    building = drawn(lines(session))
    assert building.made.missing == ""
    assert building.made.scene
