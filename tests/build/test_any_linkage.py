"""Linkages that no chain of dyads is, drawn by hand: they move, are written, read again and edited."""

from __future__ import annotations

import json
import math
from functools import cache
from math import dist
from pathlib import Path
from typing import NamedTuple

import pytest
from hand import drawn, gesture, taped

from linkanim.build.building import Building, building_of, posed, undo
from linkanim.build.freedom import mobility
from linkanim.build.gestures import drives
from linkanim.build.scene_form import made
from linkanim.build.storing import restored, stored
from linkanim.errors import BadInput
from linkanim.player.tape_file import read, write
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse, text


class Case(NamedTuple):
    """A linkage drawn: the gestures, what it is called, and the links that are solved together."""

    name: str
    lines: str
    class_name: str
    links: str


BUTTERFLY = (
    "click 0 0; click 617 0; drag 0 0 -21 194; drag -21 194 269 337; drag 269 337 584 317; "
    "drag 584 317 617 0; "
    "drag -10 97 140 48; drag 140 48 363 103; drag 426 327 537 182; drag 363 103 537 182; "
    "drag 600 158 413 205; drag 251 75 467 -109; drag 467 -109 413 205"
)
"""Published points of a double butterfly, a hundred times as large; points are drawn from bars' middles."""
FOUR_BAR = "click 0 0; click 80 0; drag 0 0 8 29; drag 8 29 60 50; drag 60 50 80 0"
TWO_MOTORS = (
    "click 0 0; click 60 0; drag 0 0 10 17; drag 60 0 51 24; drag 10 17 19 61; drag 19 61 51 24; "
    "choose bars O4–B; drive"
)
CASES = (
    # two bars from the crank's coupler: the ternary link's three bars end on what is known
    Case(
        "Stephenson II",
        "click 0 0; click 100 0; drag 0 0 50 0; click 200 0; click 260 0; drag 50 0 60 100; "
        "drag 60 100 180 90; drag 180 90 200 0; drag 120 95 150 150; drag 150 150 260 0",
        "six-bar linkage",
        "3, 4, 5, 6",
    ),
    # published points of a Stephenson III, driven at the link behind its coupler point
    Case(
        "Stephenson III through its coupler",
        "click 70 40; click 230 100; click 450 170; drag 450 170 430 320; drag 70 40 50 160; "
        "drag 50 160 250 250; drag 250 250 230 100; drag 150 205 180 350; drag 180 350 430 320",
        "six-bar linkage",
        "3, 4, 5, 6",
    ),
    Case("double butterfly", BUTTERFLY, "eight-bar linkage", "3, 4, 5, 6, 7, 8"),
    Case("two motors", TWO_MOTORS, "five-bar with two motors", ""),
    # a pin in the slot of a lever, that a guide holds as well
    Case(
        "a pin on a guide and in a slot",
        "click 0 0; click 100 0; drag 0 0 50 0; drag 50 0 83 78; drag 83 78 100 0; "
        "drag guide 0 60 100 60; click slider 60 60; drag slot 60 60 91 39",
        "six-bar linkage with slider and slot",
        "3, 4, 5",
    ),
    # two pins of one bar in the slot of a lever: the bar is the block, and does not turn there
    Case(
        "a block with two pins on a lever",
        "click 0 0; click 150 0; click 250 120; drag 0 0 40 0; drag 150 0 150 200; drag 40 0 150 90; "
        "drag 250 120 150 140; drag 150 90 150 140",
        "six-bar linkage with slider",
        "3, 4, 5, 6",
    ),
    # a guide across a lever of its own, over a joint that two bars hold
    Case(
        "a guide on a moving link",
        "click 0 0; click 150 0; click 250 120; drag 0 0 40 0; drag 150 0 150 200; drag 40 0 180 140; "
        "drag guide 150 100 190 150; drag slider 180 140 166 120; drag 250 120 180 140",
        "six-bar: triple-rocker (outward/outward) and a second dyad",
        "",
    ),
)


def lines(text_: str) -> list[str]:
    return [line.strip() for line in text_.split(";") if line.strip()]


@cache
def built(case: Case) -> tuple[Building, Scene]:
    building = drawn(lines(case.lines))
    assert building.made.missing == ""
    assert building.made.scene
    return building, building.made.scene


def reread(scene: Scene) -> Scene:
    return scene_from(parse(text(scene), "again"), name=scene.name, where="again")


EVERY = [
    pytest.param(
        case,
        id=case.name,
        marks=[pytest.mark.slow] * (case.name.startswith(("double butterfly", "a block with two pins"))),
    )
    for case in CASES
]


@pytest.mark.parametrize("case", EVERY)
def test_what_no_chain_of_dyads_is_moves_and_is_written(case: Case) -> None:
    building, scene = built(case)
    told = dict(scene.lines)
    assert told["class"] == case.class_name
    assert told.get("solved together", "") == case.links
    assert mobility(building.draft) == 1 + len(building.draft.of("drives"))
    assert reread(scene) == scene
    again = Building()
    for _ in building.past:
        building = undo(building)
    assert building.draft == again.draft


@pytest.mark.parametrize("case", EVERY)
def test_every_stated_length_holds_where_it_is_drawn_and_where_it_runs(case: Case) -> None:
    building, scene = built(case)
    for n in range(7):
        draft = posed(building, n * scene.period / 7).draft
        for table in draft.of("bars").values():
            one, other = (draft.places[end] for end in table["joints"])
            assert dist(one, other) == pytest.approx(table["length"], abs=1e-11)


@pytest.mark.parametrize("case", EVERY)
def test_a_file_opened_on_the_sheet_is_that_scene_and_is_drawn_on(case: Case) -> None:
    scene = reread(built(case)[1])
    building = building_of(scene)
    assert building.made.scene
    assert building.made.scene.linkage == scene.linkage
    fresh = made(building.draft)
    assert fresh.scene, fresh.missing
    for phase in (0.0, 1.0, 2.5):
        at = phase + building.draft.phase if fresh.by_points else phase
        old, new = scene.pose(at, 0).position, fresh.scene.pose(at, 0).position
        assert all(dist(old[name], new[name]) < 1e-8 for name in old)
    bar, table = list(building.draft.of("bars").items())[-1]
    length = round(1.04 * table["length"], 2)
    after = gesture(gesture(building, f"choose bars {bar}"), f"type {length}")
    assert after.made.scene, after.made.missing
    one, other = (after.draft.places[end] for end in table["joints"])
    assert dist(one, other) == pytest.approx(length, abs=1e-11)


@pytest.mark.parametrize("case", CASES[1:3], ids=lambda case: case.name)
def test_it_is_built_on_a_tape_and_kept_as_a_draft(case: Case, tmp_path: Path) -> None:
    building, scene = built(case)
    write(taped("\n".join(lines(case.lines))), tmp_path / "session.tape.json")
    *_, last = read(tmp_path / "session.tape.json").states()
    assert last.scene.linkage == scene.linkage
    kept = restored(json.loads(json.dumps(stored(building.draft))))
    assert kept.made.scene
    assert kept.made.scene.linkage.joints[:3] == scene.linkage.joints[:3]


# Its links are then solved together from the pose in which it was left.
@pytest.mark.parametrize(
    "name", ["crank-rocker", "double-rocker", "stephenson-2", "double-butterfly", "plotter"]
)
def test_a_draft_that_was_left_with_its_crank_turned_is_there_again(name: str) -> None:
    left = posed(building_of(load(name)), 1.3).draft
    again = restored(json.loads(json.dumps(stored(left))))
    assert again.made.scene
    places = again.made.scene.pose(again.draft.phase, 0).position
    for joint, place in left.places.items():
        assert dist(places[joint], place) < 1e-9, joint


def test_a_motor_goes_between_any_two_links_that_meet() -> None:
    building = drawn(
        [*lines(FOUR_BAR), "choose bars A–B", "type 60", "choose bars O4–B", "type 50", "choose joints B"]
    )
    words, found = zip(*drives(building), strict=True)
    assert words == ("B turns about O4", "link 4 turns on link 3 at B")
    scene = found[1].made.scene
    assert scene
    # the pose of the published linkage: 90° between coupler and rocker
    scene_at = scene.solve(angle=math.pi / 2, derivatives=0)
    crank = math.degrees(math.atan2(*scene_at.position["A"][::-1]))
    assert crank == pytest.approx(75.52249, abs=5e-6)
    again = building_of(reread(scene))
    assert again.draft.drive == found[1].draft.drive
    assert found[1].sentence == "The motor is at B"


SLIDER = (
    "click 200 0; click 260 0; drag guide 0 -20 100 -20; click slider 50 -20; drag 50 -20 60 100; "
    "drag 60 100 180 90; drag 180 90 200 0; drag 120 95 150 150; drag 150 150 260 0; choose joints A; drive"
)


def test_a_slider_drives_links_that_are_solved_together() -> None:
    building = drawn(lines(SLIDER))
    scene = building.made.scene
    assert scene
    # the travel is counted from the pin that is nearest to the guide, at x = 200
    low, high = scene.info.input_range
    assert scene.pose(0.0).position["A"] == pytest.approx((200 + low, -20), abs=1e-9)
    assert (low + high) / 2 + 200 == pytest.approx(50, abs=1e-9)
    again = building_of(reread(scene))
    assert again.made.scene
    assert again.made.scene.info.lines == scene.info.lines


@pytest.mark.slow
def test_the_crank_stays_where_it_is_drawn_or_where_its_start_is_typed() -> None:
    building, _ = built(CASES[2])
    assert building.draft.places["A"] == pytest.approx((-21, 194), abs=0.5)
    choice = gesture(building, "choose drive input")
    after = gesture(gesture(choice, "number 1"), "type 100 deg")
    arm = after.draft.places["A"]
    assert math.degrees(math.atan2(arm[1], arm[0])) == pytest.approx(100, abs=1e-9)
    assert after.made.scene


def test_gears_between_moving_links_are_not_drawn_on_the_sheet() -> None:
    links = 'ground = ["O", "Q"]\ncrank = ["O", "A"]\na = ["A", "B"]\nb = ["B", "C"]\nc = ["Q", "C"]'
    places = "O = [0, 0]\nQ = [100, 0]\nA = [20, 20]\nB = [60, 60]\nC = [110, 40]"
    gear = '[gears.g]\nlinks = ["a", "b"]\ncarrier = "crank"\nratio = -2\n[drive]\njoint = "O"'
    written = f"[points]\n{places}\n[links]\n{links}\n{gear}"
    scene = scene_from(parse(written, "geared"), name="geared", where="geared")
    with pytest.raises(BadInput, match="geared: gears between moving links are not drawn on a sheet"):
        building_of(scene)


REFUSED = (
    # a motor more than the links are free
    (f"{TWO_MOTORS}; drag 10 17 51 24", "Mobility 1, but 2 motors: remove one"),
)


@pytest.mark.parametrize(("session", "sentence"), REFUSED, ids=[one[1] for one in REFUSED])
def test_what_cannot_move_says_why(session: str, sentence: str) -> None:
    building = drawn(lines(session))
    assert building.made.scene is None
    assert building.made.missing.startswith(sentence)
