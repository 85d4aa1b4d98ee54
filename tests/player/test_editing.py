"""Editing: what is taken, what is refused where it is typed, undo and redo, the smooth way between."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest
from shown_lists import values_in

from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.edits import renewed
from linkanim.player.state import EVERY, FLASH_FRAMES, MOVE_FRAMES, Changeover, State, begin, chosen, closes
from linkanim.scenes import load
from linkanim.scenes.editing import dimensions, on_the_way
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene


def value(state: State, label: str) -> float:
    return next(item.value for item in dimensions(state.scene) if item.label == label)


def after(state: State, *actions: Action | str) -> State:
    for one in actions:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return state


def typed(state: State, text: str) -> State:
    return after(state, *(Action("type", letter) for letter in text), "accept")


@pytest.fixture
def crank() -> State:
    """The crank-rocker's list, standing at its crank (50 mm)."""
    return after(begin(load("crank-rocker")), "edit", Action("choose", 1))


# A bare number is taken in the dimension's unit; any other unit of its kind is converted.
TAKEN = {
    "bare": ("40", 40.0),
    "cm": ("4 cm", 40.0),
    "no space": ("4cm", 40.0),
    "in": ("1.5 in", 38.1),
    "m": ("0.045m", 45.0),
}


@pytest.mark.parametrize(("text", "expected"), TAKEN.values(), ids=TAKEN)
def test_a_typed_value_is_taken(crank: State, text: str, expected: float) -> None:
    state = typed(crank, text)
    assert value(state, "Crank 2") == expected
    assert (state.editing.typed, state.editing.refusal) == ("", None)


REFUSED = {
    "not a number": ("x1", "not a length"),
    "negative": ("-3", "-3: must be above zero"),
    "zero": ("0", "0: must be above zero"),
    "another kind of unit": ("30 deg", '"deg" is not one of its units'),
    "too large for a number": ("1e400", "not a finite number"),
}


@pytest.mark.parametrize(("text", "reason"), REFUSED.values(), ids=REFUSED)
def test_a_refusal_says_why_and_the_last_good_linkage_runs_on(crank: State, text: str, reason: str) -> None:
    state = typed(crank, text)
    assert state.scene is crank.scene
    assert reason in str(state.editing.refusal)
    assert "four-bar" not in str(state.editing.refusal)
    assert state.editing.typed == text


def test_bars_that_cannot_meet_are_refused(crank: State) -> None:
    state = typed(crank, "1000")
    assert state.scene is crank.scene
    assert "cannot meet" in str(state.editing.refusal)


# Where the crank turned fully and no longer could, it says so first, with the sum and the range.
@pytest.mark.parametrize("ask", [("type", "70"), ("nudge", 20)], ids=["typed", "nudged"])
def test_the_end_of_full_turns_is_refused_once(crank: State, ask: tuple[str, str | int]) -> None:
    warned = after(crank, Action(*ask), "accept") if ask[0] == "type" else after(crank, Action(*ask))
    assert warned.scene is crank.scene
    assert str(warned.editing.refusal).startswith(
        "s + l = 170 > p + q = 165: the crank cannot turn fully; it swings −151.7°…151.7°"
    )
    assert warned.editing.typed == "70"
    taken = after(warned, "accept")
    assert value(taken, "Input rocker 2") == 70.0
    assert taken.editing.refusal is None


def test_another_value_is_warned_of_again(crank: State) -> None:
    warned = typed(crank, "70")
    again = after(warned, "erase", Action("type", "2"), "accept")
    assert again.scene is crank.scene
    assert "cannot turn fully" in str(again.editing.refusal)


def test_a_swing_may_change_without_a_warning() -> None:
    state = after(begin(load("triple-rocker")), "edit", Action("choose", 1))
    assert after(state, Action("nudge", 1)).editing.refusal is None


def test_a_refused_value_can_be_mended(crank: State) -> None:
    mended = typed(after(typed(crank, "-4"), "erase", "erase"), "41")
    assert (value(mended, "Crank 2"), mended.editing.refusal) == (41.0, None)


def test_a_speed_is_typed_in_any_of_its_units(crank: State) -> None:
    at_speed = after(crank, Action("choose", -3))
    state = typed(at_speed, "180 deg/s")
    assert state.clock.rate == pytest.approx(3.141592653589793)
    assert state.phase == pytest.approx(at_speed.clock.at(state.frame))


def test_as_many_nudges_back_end_on_the_same_value(crank: State) -> None:
    there = after(crank, *[Action("nudge", 1)] * 3, Action("nudge", -10))
    assert value(there, "Crank 2") == 43.0
    assert after(there, Action("nudge", 10), *[Action("nudge", -1)] * 3).scene == crank.scene


def test_a_nudge_is_so_many_steps_of_its_unit() -> None:
    state = after(begin(load("jansen")), "edit", Action("choose", 1))
    before = chosen(state.editing, state.scene)
    assert before
    assert before.unit == "cm"
    nudged = after(state, Action("nudge", 3))
    item = chosen(nudged.editing, nudged.scene)
    assert item
    assert item.value == pytest.approx(before.value + 0.3, rel=1e-12)


def test_undo_and_redo_walk_the_changes(crank: State) -> None:
    changed = after(crank, Action("nudge", 1), Action("nudge", 1))
    assert value(after(changed, "undo"), "Crank 2") == 51.0
    assert after(changed, "undo", "undo").scene == crank.scene
    assert after(changed, "undo", "undo", "undo").scene == crank.scene
    assert after(changed, "undo", "undo", "redo", "redo", "redo").scene == changed.scene


def test_undo_lets_go_of_a_refused_value_first(crank: State) -> None:
    refused = typed(after(crank, Action("nudge", 1)), "-3")
    once = after(refused, "undo")
    assert (value(once, "Crank 2"), once.editing.typed, once.editing.refusal) == (51.0, "", None)
    assert value(after(once, "undo"), "Crank 2") == 50.0


def test_a_change_after_undo_ends_the_redo(crank: State) -> None:
    state = after(crank, Action("nudge", 1), "undo", Action("nudge", -1), "redo")
    assert value(state, "Crank 2") == 49.0


def test_the_other_closure_is_undone_too(crank: State) -> None:
    assert after(crank, "closure", "undo").scene == crank.scene


def test_the_list_goes_round(crank: State) -> None:
    rows = len(dimensions(crank.scene))
    assert after(crank, Action("choose", rows)).editing.chosen == crank.editing.chosen


def test_choosing_lets_go_of_what_was_begun(crank: State) -> None:
    assert after(crank, Action("type", "7"), Action("choose", 1)).editing.typed == ""


# A whole new set, twice the size: none of its lengths could be taken alone.
DOUBLED = {"Ground 1": "200", "Crank 2": "100", "Coupler 3": "17 cm", "Rocker 4": "160"}


@pytest.mark.parametrize("order", [1, -1], ids=["downwards", "upwards"])
def test_values_passed_on_from_are_judged_together(crank: State, order: int) -> None:
    state = after(crank, Action("choose", -1 if order == 1 else 2))
    values = list(DOUBLED.items())[::order]
    for n, (_, text) in enumerate(values):
        state = after(state, *(Action("type", letter) for letter in text))
        state = after(state, Action("pass_on", order) if n < 3 else Action("accept"))
        assert state.editing.refusal is None
        assert (state.scene is crank.scene) == (n < 3)
    assert [value(state, label) for label in DOUBLED] == [200.0, 100.0, 170.0, 160.0]
    assert not state.editing.begun
    assert after(state, "undo").scene == crank.scene


def test_none_of_several_values_is_taken_where_one_is_wrong(crank: State) -> None:
    state = after(crank, Action("type", "4"), Action("type", "9"), Action("pass_on", 1))
    refused = typed(state, "x")
    assert refused.scene is crank.scene
    assert str(refused.editing.refusal).startswith('Coupler 3: "x" is not a length')
    assert refused.editing.begun
    mended = typed(after(refused, "erase"), "86")
    assert (value(mended, "Crank 2"), value(mended, "Coupler 3")) == (49.0, 86.0)


def test_a_draft_is_mended_where_it_stands(crank: State) -> None:
    state = after(
        crank, Action("type", "4"), Action("type", "9"), Action("pass_on", 1), Action("pass_on", -1)
    )
    again = after(state, "erase", Action("type", "8"), "accept")
    assert value(again, "Crank 2") == 48.0
    assert not after(state, "erase", "erase").editing.begun


def test_a_new_value_takes_the_place_of_a_draft(crank: State) -> None:
    state = after(crank, Action("type", "9"), Action("pass_on", 1), Action("pass_on", -1))
    assert value(typed(state, "47"), "Crank 2") == 47.0


@pytest.mark.parametrize("key", ["back", "undo"])
def test_values_begun_are_let_go_of_one_after_the_other(crank: State, key: str) -> None:
    state = after(crank, Action("type", "9"), Action("pass_on", 1), Action("type", "8"), key)
    assert (state.editing.typed, len(state.editing.drafts), state.edits_dimensions) == ("", 1, True)
    state = after(state, key)
    assert (state.editing.begun, state.edits_dimensions) == (False, True)


def test_passing_on_without_a_value_only_chooses(crank: State) -> None:
    state = after(crank, Action("pass_on", 1))
    assert (state.editing.chosen, state.editing.begun) == (2, False)


def test_a_closed_list_keeps_no_drafts(crank: State) -> None:
    assert not after(crank, Action("type", "9"), Action("pass_on", 1), "edit", "edit").editing.begun


LENGTHS = {"ground": 100, "crank": 40, "coupler": 110, "rocker": 80, "coupler_point": [50, 30]}
AS_JOINTS = {
    "ground": {"O2": [0, 0], "O4": [100, 0]},
    "joints": {
        "A": {"crank": "O2", "length": 40},
        "B": {"from": ["A", "O4"], "length": [110, 80], "side": "left"},
    },
}
# A value begun and left is kept where the file still has its row.
RENEWED = {
    "the same rows": ({"four-bar": {**LENGTHS, "crank": 45}}, 1),
    "other rows": (AS_JOINTS, 0),
}


@pytest.mark.parametrize(("document", "drafts"), RENEWED.values(), ids=RENEWED)
def test_values_begun_of_a_row_that_a_changed_file_has_no_longer_are_let_go_of(
    document: dict[str, Any], drafts: int
) -> None:
    state = begin(scene_from({"four-bar": LENGTHS}, name="mine", where="mine.toml"))
    point = [item.label for item in dimensions(state.scene)].index("Coupler point, along")
    state = after(state, "edit", Action("choose", point), Action("type", "8"), Action("pass_on", -point))
    state = renewed(state, scene_from(document, name="mine", where="mine.toml"))
    assert len(state.editing.drafts) == drafts
    assert not any(effect.name == "report" for effect in after(state, "accept").effects)


def test_the_list_says_what_the_lengths_make_of_the_linkage(crank: State) -> None:
    shown = values_in(crank)
    assert shown is not None
    assert shown.facts == ("Grashof crank-rocker", "s + l = 150 < p + q = 165")
    assert shown.flash == 0.0


def test_the_facts_light_up_when_the_class_changes_and_fade(crank: State) -> None:
    state = after(typed(crank, "66"), "accept")
    flashes = []
    for _ in range(FLASH_FRAMES + 1):
        shown = values_in(state)
        assert shown is not None
        flashes.append(shown.flash)
        state = advance(state)
    assert flashes[0] == 1.0
    assert flashes == sorted(flashes, reverse=True)
    assert flashes[-1] == 0.0
    assert state.turned is None


def test_the_same_class_does_not_light_up(crank: State) -> None:
    assert after(crank, Action("nudge", 1)).turned is None


def test_a_list_shows_what_is_typed_and_what_waits(crank: State) -> None:
    state = after(crank, Action("type", "9"), Action("pass_on", 1), Action("type", "8"))
    shown = values_in(state)
    assert shown is not None
    assert [(row.value, row.draft) for row in shown.rows[:4]] == [
        ("100 mm", False),
        ("9", True),
        ("8_", True),
        ("80 mm", False),
    ]
    assert [row.chosen for row in shown.rows[:3]] == [False, False, True]


def test_a_list_shows_ten_digits() -> None:
    gears = typed(after(begin(load("epicyclic-hypocycloid")), "edit", Action("choose", 2)), "-1/3")
    shown = values_in(gears)
    assert shown is not None
    assert shown.rows[2].value == "−0.3333333333"


def test_escape_closes_what_lies_on_top_first(crank: State) -> None:
    state = after(crank, Action("type", "7"), "help", "back")
    assert (state.help, state.editing.typed) == (False, "7")
    state = after(state, "back")
    assert (state.edits_dimensions, state.editing.typed) == (True, "")
    state = after(state, "back")
    assert (state.edits_dimensions, state.effects) == (False, ())


def test_ctrl_b_in_the_list_lets_a_swing_come_back_on_the_same_closure() -> None:
    state = after(begin(load("double-rocker")), "edit", "returns")
    assert state.scene.linkage.drive.retraced
    assert state.chip is not None
    assert state.chip.text == "back on the same closure"
    assert not after(state, "undo").scene.linkage.drive.retraced
    turning = after(begin(load("crank-rocker")), "edit", "returns")
    assert turning.toast is not None


def test_reset_goes_back_to_the_file_and_is_undone(crank: State) -> None:
    changed = after(crank, Action("nudge", 1), Action("choose", 1), Action("nudge", 1))
    again = after(changed, "reset")
    assert again.scene == crank.scene
    assert again.edited == frozenset()
    assert after(again, "undo").scene == changed.scene
    assert after(crank, "reset").editing.past == ()


def test_another_mechanism_begins_unedited_and_the_first_is_as_it_was_left(crank: State) -> None:
    edited = after(crank, Action("nudge", 1))
    there = after(edited, Action("mechanism", 1))
    assert after(there, Action("mechanism", -1)).editing == edited.editing
    assert after(there, Action("mechanism", -1), "undo").scene == crank.scene
    state = after(crank, Action("nudge", 1), Action("mechanism", 1))
    assert state.edits_dimensions
    assert not state.editing.changed


def shown_crank(state: State) -> float:
    return next(item.value for item in dimensions(state.shown) if item.label == "Crank 2")


def test_a_length_is_followed_smoothly(crank: State) -> None:
    lengths = []
    state = typed(crank, "40")
    for _ in range(MOVE_FRAMES + 1):
        lengths.append(shown_crank(state))
        state = advance(state)
    assert lengths[0] == 50.0
    assert lengths[-1] == 40.0
    assert lengths == sorted(lengths, reverse=True)
    assert max(a - b for a, b in pairwise(lengths)) < 2.0
    assert state.shown is state.scene


def test_an_angle_in_another_unit_goes_there_as_a_shape() -> None:
    """No value is between 90° and 1.5 rad."""
    line = after(begin(load("engine")), "edit", Action("choose", 2))
    assert value(line, "Direction of the guide") == 90.0
    assert typed(line, "80").glide is not None
    state = typed(line, "1.5 rad")
    assert value(state, "Direction of the guide") == 1.5
    assert isinstance(state.glide, Changeover)


def test_a_change_begins_and_ends_gently(crank: State) -> None:
    lengths = []
    state = typed(crank, "40")
    for _ in range(MOVE_FRAMES + 1):
        lengths.append(shown_crank(state))
        state = advance(state)
    steps = [a - b for a, b in pairwise(lengths[::EVERY])]
    assert max(steps[0], steps[-1]) < max(steps) / 4
    assert lengths[MOVE_FRAMES // 2] == pytest.approx(45.0)
    assert steps == pytest.approx(steps[::-1])


def nudged_on(name: str, choose: int, steps: int) -> State:
    """Return a scene some frames after its chosen dimension was nudged."""
    state = after(begin(load(name)), "edit", Action("choose", choose), Action("nudge", steps))
    for _ in range(MOVE_FRAMES // 2):
        state = advance(state)
    assert state.shown is not state.scene
    return state


# Chains with and without dyads beyond the first loop, and one whose second loop limits its input.
@pytest.mark.parametrize(("name", "choose"), [("crank-rocker", 1), ("press", 0), ("six-bar", 2)])
def test_a_scene_on_the_way_is_solved_as_exactly_as_any(name: str, choose: int) -> None:
    shown = nudged_on(name, choose, 2).shown
    again = scene_from(shown.document, name=name, where=name)
    for phase in (0.0, 1.0, 4.0):
        pose, same = shown.pose(phase), again.pose(phase)
        for joint, place in same.position.items():
            assert pose.position[joint] == pytest.approx(place, rel=1e-12, abs=1e-9)
            assert pose.velocity[joint] == pytest.approx(same.velocity[joint], rel=1e-9, abs=1e-6)


def test_nothing_is_classified_on_the_way(monkeypatch: pytest.MonkeyPatch) -> None:
    state = nudged_on("press", 0, 1)
    assert state.shown.info is state.scene.info

    def never(*_: object) -> None:
        raise AssertionError("classified on the way")

    monkeypatch.setattr("linkanim.mechanics.motion.separations", never)
    monkeypatch.setattr("linkanim.mechanics.analysis.Info", never)
    seen = set()
    while state.glide:
        seen.add(state.shown.linkage)
        state = advance(state)
    assert len(seen) > 2
    assert state.effects == ()


def test_a_scene_on_the_way_is_worked_out_in_the_frame_before_it_is_drawn(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Both in one frame would take longer than a frame has."""
    state = nudged_on("press", 0, 1)
    worked: list[int] = []
    drawn: list[int] = []

    def recorded(*given: Any) -> Scene:
        worked.append(state.frame)
        return on_the_way(*given)

    monkeypatch.setattr("linkanim.player.state.on_the_way", recorded)
    while state.glide:
        before, state = state.shown, advance(state)
        drawn += [state.frame] if state.shown is not before else []
    assert len(worked) > 2
    assert [frame + 2 for frame in worked] == drawn[:-1]
    assert drawn[-1] - drawn[-2] == EVERY


def test_a_way_past_lengths_that_do_not_close_leaves_them_out() -> None:
    press = load("press")
    assert closes(on_the_way(press, {("joints", "C", "length"): 300}))
    assert not closes(on_the_way(press, {("joints", "C", "length"): 5}))


@pytest.mark.slow
# Of links that are solved together, the points of their pose are the dimensions.
def test_the_points_of_a_pose_are_listed_and_edited() -> None:
    state = after(begin(load("stephenson-2")), "edit")
    labels = [item.label for item in dimensions(state.scene)]
    assert {"Point O6, y", "Point A, distance", "Point B, x"} <= {*labels}
    edited = typed(after(state, Action("choose", labels.index("Point B, x"))), "6 cm")
    assert value(edited, "Point B, x") == 60.0
    assert edited.glide is None
    pose = edited.scene.pose(0.0).position
    assert pose["B"] == pytest.approx((60, 37), rel=1e-14)
    assert pose["E"] == pytest.approx((150, 96), rel=1e-14)
    assert after(edited, "undo").scene.linkage == state.scene.linkage


@pytest.mark.slow
def test_undo_goes_back_a_hundred_changes(crank: State) -> None:
    state = crank
    for _ in range(52):
        state = after(state, Action("nudge", 1), Action("nudge", -1))
    state = after(state, *[Action("nudge", -1)] * 3)
    assert value(after(state, *["undo"] * 3), "Crank 2") == 50.0
    assert len(state.editing.past) == 100
    assert after(state, *["undo"] * 100).editing.past == ()


def test_a_second_change_starts_from_what_is_shown(crank: State) -> None:
    halfway = after(typed(crank, "40"), *[Action("note", "")] * (MOVE_FRAMES // 2), Action("type", "60"))
    again = after(halfway, "accept")
    assert value(again, "Crank 2") == 60.0
    assert shown_crank(again) == pytest.approx(shown_crank(halfway), abs=2.0)
