"""Drawings by hand: what the gestures make of an empty sheet, and that it moves."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from hand import drawn, gesture

from linkanim.build import places as shapes
from linkanim.build.building import Building, draft_of, posed, redo, undo
from linkanim.build.dimensions import rows_of
from linkanim.build.draft import Photo
from linkanim.build.gestures import choose_thing, fit_photo, lay_photo, move_photo
from linkanim.build.storing import restored, stored
from linkanim.errors import BadInput
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.toml import parse, text

FOUR_BAR = ("click 0 0", "click 100 0", "drag 0 0 50 0", "drag 50 0 68 83", "drag 68 83 100 0")
SLIDES = ("choose joints A", "drive", "number 2", "type 70", "type 82")


def test_a_four_bar_moves_after_its_last_bar() -> None:
    steps = [Building()]
    for line in FOUR_BAR:
        steps.append(gesture(steps[-1], line))
    assert [step.made.scene is not None for step in steps] == [
        False,
        False,
        False,
        True,
        False,
        True,
    ]  # a crank alone moves
    scene = steps[-1].made.scene
    assert scene
    lengths = {joint.name: joint.stated_lengths for joint in scene.linkage.joints}
    assert lengths == {"O2": (0, 0), "O4": (100, 0), "A": (50,), "B": (85, 89)}


def test_undo_goes_back_to_the_empty_sheet_and_redo_on_again() -> None:
    done = back = drawn(FOUR_BAR)
    for _ in FOUR_BAR:
        back = undo(back)
    assert back.draft == Building().draft
    for _ in FOUR_BAR:
        back = redo(back)
    assert back.draft == done.draft


def test_a_draft_that_is_stored_comes_back() -> None:
    draft = replace(drawn(FOUR_BAR).draft, photo=Photo("digger.jpg", (-20.0, 5.0), 300.0, 0.1))
    assert restored(json.loads(json.dumps(stored(draft)))).draft == draft


def test_a_bar_within_a_body_that_was_stored_is_as_long_as_its_ends_are_apart() -> None:
    draft = drawn((*FOUR_BAR, "drag 57 40 40 70")).draft.with_bar("B", "P", 70)
    building = restored(stored(replace(draft, typed=draft.typed | {("bars", "B–P", "length")})))
    moved = gesture(choose_thing(building, "joints", "P"), "move 30 75")
    for step in (building, moved):
        scene = step.made.scene
        assert scene
        apart = math.dist(*(scene.pose(0.3).position[name] for name in "BP"))
        length = rows_of(step.draft, ("bars", "B–P"))[0].number
        assert length
        assert length.value == pytest.approx(apart, abs=1e-8)
    typed = gesture(choose_thing(building, "bars", "B–P"), "type 90")
    assert typed.sentence == "B–P: B and P are points of one body: move one to set their distance"
    assert typed.draft == building.draft


def test_a_body_whose_first_joint_hangs_free_keeps_its_shape() -> None:
    lines: tuple[str, ...] = (
        "click 0 0",
        "click 100 0",
        "drag 100 0 110 80",
        "drag 110 80 40 110",
        "drag 75 95 75 60",
    )
    lines += ("drag 0 0 75 60", "drag 100 0 37 102", "choose bars O4–A", "delete", "choose joints P", "drive")
    building = drawn(lines)
    scene = building.made.scene
    assert scene, building.made.missing
    drawn_at, pose = building.draft.places, scene.pose(0.7).position
    for one, other in (("A", "B"), ("A", "P"), ("B", "P")):
        assert math.dist(pose[one], pose[other]) == pytest.approx(
            math.dist(drawn_at[one], drawn_at[other]), abs=0.5
        )


def test_what_is_no_draft_is_refused() -> None:
    with pytest.raises(BadInput, match="no draft"):
        restored({"places": {"A": 1}})


def test_a_body_is_found_from_whichever_of_its_joints_are_known() -> None:
    # The coupler's point P is held by a bar before its end B is; B follows as a point of A–P.
    drawing = drawn(("click 0 0", "click 100 0", "drag 0 0 30 0", "drag 30 0 130 80", "drag 80 40 90 80"))
    scene = gesture(drawing, "drag 90 80 100 0").made.scene
    assert scene
    place = scene.cycle(24).position
    assert np.ptp(np.hypot(*(place["A"] - place["B"]).T)) < 1e-9
    assert np.ptp(np.hypot(*(place["P"] - place["B"]).T)) < 1e-9


@pytest.mark.parametrize("phase", [0.0, 1.0, 4.0])
@pytest.mark.parametrize("joint", ["O2", "O4", "A", "B"])
def test_a_dragged_joint_stays_under_the_hand(joint: str, phase: float) -> None:
    building = posed(drawn(FOUR_BAR), phase)
    x, y = building.draft.places[joint]
    building = gesture(choose_thing(building, "joints", joint), f"move {x + 3} {y - 2}", snap=0.001)
    scene = building.made.scene
    assert scene
    found = scene.pose(building.draft.phase, 0).position[joint]
    assert np.hypot(found[0] - x - 3, found[1] - y + 2) < 0.01


@pytest.mark.parametrize(
    "lines",
    [
        pytest.param(("drag 0 0 35 35", "drag 35 35 80 60", "drag 80 60 100 0"), id="a rocker"),
        pytest.param(("drag 0 0 60 20", "drag 30 10 40 30", "drag cylinder 100 0 40 30"), id="a cylinder"),
        pytest.param(
            ("drag guide 0 0 0 9", "click slider 0 80", "drag 0 80 60 20", "drag 60 20 100 0", *SLIDES),
            id="a slider",
        ),
    ],
)
def test_an_input_that_swings_begins_where_it_is_drawn(lines: tuple[str, ...]) -> None:
    building = drawn(("click 0 0", "click 100 0", *lines))
    scene, draft = building.made.scene, building.draft
    assert scene
    assert not scene.info.full_turn
    assert 0.0 < draft.phase < np.pi
    pose = scene.pose(draft.phase, 0).position
    assert max(np.hypot(*np.subtract(pose[name], draft.places[name])) for name in pose) < 1.5


def test_a_slider_is_driven_to_both_sides_of_where_it_stands() -> None:
    lines = ("click 0 0", "click 100 0", "drag guide 0 0 0 9", "click slider 0 80", "drag 0 80 60 20")
    building = drawn((*lines, "drag 60 20 100 0", "choose joints A", "drive"))
    assert building.made.scene
    assert building.draft.drive["slider"] == {"joint": "A", "from": 77.5, "to": 82.5}


@pytest.mark.parametrize("x", [59.0, 20.0], ids=["on a bar", "on the ground"])
def test_a_short_guide_has_whole_degrees_wherever_it_lies(x: float) -> None:
    # over 15 mm half a degree moves the guide's end by less than half of the grid's step
    (table,) = gesture(drawn(FOUR_BAR), f"drag guide {x} 41.5 {x + 13} 48").draft.of("guides").values()
    assert ("on" in table) == (x == 59.0)
    assert float(table["angle"].removesuffix(" deg")).is_integer()


def test_wheels_touch_where_their_radii_are_as_their_ratio() -> None:
    pivots = ("click 0 0", "click 90 0", "drag 0 0 30 0", "drag 90 0 120 0")
    building = drawn((*pivots, "drag gear 120 0 30 0", "type -2"))
    (wheels,) = (shape for shape in shapes.drawn(building.draft) if shape.kind == "gears")
    assert wheels.places == ((90, 0), (0, 0), (60, 0))


@pytest.mark.parametrize(("bar", "lengths"), [("A–B", (95, 89)), ("O4–B", (85, 95))])
def test_a_length_that_is_typed_moves_the_joint_to_where_both_bars_meet(
    bar: str, lengths: tuple[int, int]
) -> None:
    places = drawn((*FOUR_BAR, f"choose bars {bar}", "type 95")).draft.places
    found = [np.hypot(*np.subtract(places["B"], places[end])) for end in ("A", "O4")]
    assert found == pytest.approx(lengths)


def test_a_bar_is_drawn_with_the_points_of_its_own_body() -> None:
    draft = draft_of(load("crank-rocker"))
    bars = {shape.thing[1]: shape.places for shape in shapes.drawn(draft) if shape.kind == "bars"}
    assert bars["A–B"] == tuple(draft.places[name] for name in "ABP")
    assert [len(places) for places in bars.values()] == [2, 3, 2]


def test_a_photograph_comes_to_two_known_points_and_into_the_file() -> None:
    building = lay_photo(drawn(FOUR_BAR), "digger.jpg", -10, -10, 200)
    assert fit_photo(building, 0, 0, 1, 1, 0, 0, 2, 2).sentence.startswith("Two points fit")
    building = fit_photo(building, -10, -10, 0, 0, 90, -10, 0, 50)
    photo = building.draft.photo
    assert photo
    assert photo.place == (0.0, 0.0)
    assert (photo.width, photo.turn) == pytest.approx((100, np.pi / 2))
    moved = move_photo(building, 0, 0, 5, 6).draft.photo
    assert moved
    assert moved.place == (5.0, 6.0)
    scene = building.made.scene
    assert scene
    again = draft_of(scene_from(parse(text(scene), "a"), name="a", where="a")).photo
    assert again
    assert (again.file, again.place, again.width) == (photo.file, photo.place, photo.width)
    assert again.turn == pytest.approx(photo.turn)
    assert undo(undo(building)).draft.photo is None
    assert move_photo(Building(), 0, 0, 5, 6).sentence == "There is no photograph: drop one on the window"


@pytest.mark.parametrize(
    "session",
    [
        # Each gesture ends the full turn of a crank: the linkage stands on one of its two ways.
        ("click 0 0", "click 100 0", "drag 0 0 50 0", "drag 50 0 66 39", "drag 66 39 100 0"),
        ("click 0 0", "click 100 0", "drag 0 0 50 0", "drag 50 0 66 -39", "drag 66 -39 100 0"),
        ("click 0 0", "click 100 0", "drag 0 0 40 30", "drag 40 30 60 60", "drag 60 60 100 0"),
        ("click 0 0", "drag guide 0 40 100 40", "drag 0 0 50 0", "drag 50 0 70 40"),
        ("click 0 0", "drag guide 0 40 100 40", "drag 0 0 50 0", "drag 50 0 30 40"),
    ],
)
def test_a_linkage_whose_input_no_longer_turns_fully_stands_as_it_was_drawn(session: tuple[str, ...]) -> None:
    draft = (building := drawn(session)).draft
    scene = building.made.scene
    assert scene
    assert not scene.info.full_turn
    standing = scene.pose(draft.phase, 0).position
    for name, place in draft.places.items():
        assert np.hypot(*np.subtract(standing[name], place)) < 1.5, name  # lengths are whole millimetres
