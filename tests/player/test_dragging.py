"""Joints dragged while the list is open: what follows, in which steps, what is refused, one undo a drag."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pygame
import pytest
from playing import Player
from shown_lists import values_in

from linkanim.mechanics.groups import group_of
from linkanim.mechanics.motion import mechanism
from linkanim.picture.look import Look
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.state import State, begin, loss_of_turning
from linkanim.player.tape import Tape, starting
from linkanim.scenes import load, names
from linkanim.scenes.editing import Stretch, dimensions, handles, stretches, with_document
from linkanim.scenes.form import Key
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse
from linkanim.ui.pictures import Framing


def after(state: State, *actions_: Action | str) -> State:
    for one in actions_:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return state


def values(state: State) -> dict[str, float]:
    return {item.label: item.value for item in dimensions(state.scene)}


def place(state: State, joint: str) -> tuple[float, float]:
    return state.scene.pose(state.phase, 0).position[joint]


def opened(name: str, phase: float) -> State:
    return after(begin(load(name)), Action("scrub", phase), "edit")


def drag(state: State, joint: str, by: tuple[float, float], share: float = 1.0) -> State:
    x, y = place(state, joint)
    return after(state, Action("grab", joint), Action("carry", (x + by[0], y + by[1], share)))


# Each kind of joint, and the dimensions that follow it.
FOLLOWS = {
    "a crank pin": ("crank-rocker", "A", {"Crank 2"}),
    "a dyad's joint": ("crank-rocker", "B", {"Coupler 3", "Rocker 4"}),
    "a coupler point": ("crank-rocker", "P", {"Coupler point, along", "Coupler point, to the left"}),
    "a shorthand's pin": ("crank-rocker", "O4", {"Ground 1"}),
    "a slider": ("slider-crank", "B", {"Rod 3"}),
    "an arm's joint": ("six-bar", "C", {"Arm 6"}),
    "a second dyad's joint": ("six-bar", "D", {"Coupler 7", "Rocker 8"}),
    "a geared crank's pin": ("press", "D", {"Crank 7"}),
    "a dyad's joint of the long form": ("press", "B", {"Bar 3, A–B", "Bar 6, D–B"}),
    "a point of a body": ("press", "H", {"H on A–B, along", "H on A–B, to the left"}),
    "a pin by coordinates": ("press", "G", {"Pin G, x", "Pin G, y"}),
    "a pin by distance": ("press", "O7", {"Pin O7, distance", "Pin O7, direction"}),
}


@pytest.mark.parametrize(("name", "joint", "labels"), FOLLOWS.values(), ids=FOLLOWS)
def test_what_is_dragged_sets_its_own_dimensions(name: str, joint: str, labels: set[str]) -> None:
    state = opened(name, 1.0)
    found = {handle.key for handle in handles(state.scene, joint)}
    assert {item.label for item in dimensions(state.scene) if item.key in found} == labels
    moved = drag(state, joint, (6.2, 5.1))
    assert moved.editing.refusal is None
    changed = {label for label, value in values(moved).items() if value != values(state)[label]}
    assert changed
    assert changed <= labels
    assert all(value % 1.0 == 0.0 for label, value in values(moved).items() if label in changed)


@pytest.mark.parametrize(
    ("name", "joint"), [("crank-rocker", "B"), ("crank-rocker", "P"), ("press", "B"), ("press", "H")]
)
def test_a_joint_lies_where_it_was_dragged_at_the_present_pose(name: str, joint: str) -> None:
    state = opened(name, 1.0)
    goal = tuple(part + shift for part, shift in zip(place(state, joint), (3.0, 2.0), strict=True))
    moved = drag(state, joint, (3.0, 2.0), 0.001)
    assert place(moved, joint) == pytest.approx(goal, abs=0.01)
    assert moved.phase == state.phase


def test_shift_goes_in_tenths() -> None:
    state = drag(opened("crank-rocker", 1.0), "A", (0.37, 0.0), 0.1)
    assert values(state)["Crank 2"] == 50.2


def test_a_swings_crank_angle_stays_though_its_range_changes() -> None:
    state = opened("triple-rocker", 1.0)
    moved = drag(state, "B", (14.0, 9.0))
    assert moved.editing.refusal is None
    assert moved.scene.info.input_range != state.scene.info.input_range
    angles = (one.scene.pose(one.phase, 0).coordinate for one in (state, moved))
    assert next(angles) == pytest.approx(next(angles))


def test_a_drag_is_one_undo() -> None:
    state = opened("crank-rocker", 1.0)
    x, y = place(state, "B")
    ways = [Action("carry", (x + far, y, 1.0)) for far in (2.0, 5.0, 9.0)]
    moved = after(state, Action("grab", "B"), *ways, "drop")
    assert moved.scene != state.scene
    assert after(moved, "undo").scene == state.scene
    assert after(moved, "undo", "redo").scene == moved.scene


def test_a_drag_that_comes_back_to_its_start_ends_on_the_same_lengths() -> None:
    state = opened("crank-rocker", 1.0)
    x, y = place(state, "B")
    moved = after(
        state, Action("grab", "B"), Action("carry", (x + 9.0, y, 1.0)), Action("carry", (x, y, 1.0))
    )
    assert values(moved) == values(state)


def test_what_cannot_be_assembled_is_refused_and_the_last_good_linkage_stays() -> None:
    state = opened("crank-rocker", 1.0)
    good = drag(state, "A", (1.0, 2.0))
    refused = after(good, Action("carry", (400.0, 400.0, 1.0)))
    assert refused.scene == good.scene
    assert "cannot" in str(refused.editing.refusal)
    assert after(refused, "drop").editing.refusal is None


def test_the_end_of_full_turns_is_refused() -> None:
    state = opened("crank-rocker", 1.0)
    x, y = place(state, "A")
    refused = after(state, Action("grab", "A"), Action("carry", (1.4 * x, 1.4 * y, 1.0)))
    assert refused.scene == state.scene
    assert str(refused.editing.refusal).endswith("it swings −151.7°…151.7°")


# The input is stopped by a dyad that others stand on, by the last one, and on its own pin as well.
STOPPED = {
    "in the midst": ("press", "B", (-40.0, 0.0)),
    "at the end": ("jansen", "B", (-2.0, -14.0)),
    "own pin": ("jansen", "B", (0.0, -20.0)),
}


@pytest.mark.parametrize(("name", "joint", "by"), STOPPED.values(), ids=STOPPED)
def test_a_refusal_says_how_far_the_input_goes_before_the_linkage_is_worked_out(
    name: str, joint: str, by: tuple[float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    state = opened(name, 1.0)
    refused = drag(state, joint, by)
    assert refused.scene == state.scene
    document = refused.editing.refused
    assert document
    whole = with_document(state.scene, document)
    assert refused.editing.refusal == loss_of_turning(state.scene.info, whole.info) is not None
    mechanism.cache_clear()
    monkeypatch.setattr("linkanim.mechanics.solver.limits.fitted", None)
    assert drag(state, joint, by).editing.refusal == refused.editing.refusal


def test_a_value_refused_before_a_drag_is_warned_of_after_it_too() -> None:
    crank = after(opened("crank-rocker", 1.0), Action("choose", 1))
    state = after(crank, Action("type", "70"), Action("pass_on", 1))
    moved = after(drag(state, "P", (3.0, 0.0)), "drop", "accept")
    assert values(moved)["Crank 2"] == 50.0
    assert str(moved.editing.refusal).endswith("(Enter again takes it)")


def test_the_picture_stands_still_while_a_joint_is_held_and_runs_on_after() -> None:
    running = after(begin(load("crank-rocker")), "edit")
    held = after(running, Action("grab", "B"))
    assert held.clock.paused
    x, y = place(held, "B")
    assert after(held, Action("carry", (x + 3.0, y, 1.0))).clock.paused
    assert not after(held, "drop").clock.paused
    paused = after(running, "pause", Action("grab", "B"), "drop")
    assert paused.clock.paused


def test_the_list_goes_to_what_is_dragged() -> None:
    state = after(opened("crank-rocker", 1.0), Action("grab", "B"))
    assert dimensions(state.scene)[state.editing.chosen].label == "Coupler 3"


# What is not there to be dragged is left alone.
NOT_HELD = {
    "a closed list": ("crank-rocker", "B", False),
    "an unknown joint": ("crank-rocker", "Z", True),
    "the origin of a shorthand": ("slider-crank", "O2", True),
}


@pytest.mark.parametrize(("name", "joint", "is_open"), NOT_HELD.values(), ids=NOT_HELD)
def test_what_cannot_be_dragged_is_not_held(name: str, joint: str, is_open: bool) -> None:
    state = begin(load(name))
    state = after(state, *(["edit"] if is_open else []), Action("grab", joint))
    assert state.held is None
    assert after(state, Action("carry", (1.0, 1.0, 1.0)), "drop").scene is state.scene


def test_a_closed_list_lets_go() -> None:
    state = after(begin(load("crank-rocker")), "edit", Action("grab", "B"), "edit")
    assert (state.held, state.clock.paused) == (None, False)
    further = after(state, Action("carry", (1.0, 1.0, 1.0)))
    assert (further.scene, further.toast, further.effects) == (state.scene, None, ())


def test_a_tape_keeps_a_drag() -> None:
    state = opened("crank-rocker", 1.0)
    x, y = place(state, "B")
    actions = ((1, Action("grab", "B")), (3, Action("carry", (x + 5.0, y, 1.0))), (5, Action("drop")))
    *_, last = Tape(starting(state), 6, actions).states()
    assert last.scene == after(state, *(action for _, action in actions)).scene


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_span_is_the_bar_that_its_dimension_measures(name: str) -> None:
    scene = load(name)
    values_ = {item.key: item.value for item in dimensions(scene)}
    found = [one for key in values_ for one in stretches(scene, key)]
    for one in found:
        begin, end = _drawn(scene, one, 0.7)
        assert abs(end - begin) == pytest.approx(abs(values_[one.key]))
    assert found or group_of(scene.linkage)


def _drawn(scene: Scene, one: Stretch, phase: float) -> tuple[complex, complex]:
    """Return where a stretch begins and ends at a phase."""
    places = scene.pose(phase, 0).position
    at, head = (complex(*places[name]) for name in one.frame)
    way = head - at if one.frame[0] != one.frame[1] else 1
    return at + one.begin * way, at + one.end * way


# A dimension of a place, and the joint at which its construction ends, or that lies on the offset's line.
CONSTRUCTED = {
    "along": ("crank-rocker", ("four-bar", "coupler_point", 0), "P", 2),
    "to the left": ("crank-rocker", ("four-bar", "coupler_point", 1), "P", 2),
    "of the long form": ("press", ("joints", "H", "at", 0), "H", 2),
    "a fixed pin": ("press", ("ground", "G", 1), "G", 2),
    "a guide": ("slider-crank", ("slider-crank", "offset"), "B", 1),
}


@pytest.mark.parametrize(("name", "key", "joint", "count"), CONSTRUCTED.values(), ids=CONSTRUCTED)
def test_a_construction_ends_at_its_place(name: str, key: Key, joint: str, count: int) -> None:
    scene = load(name)
    found = stretches(scene, key)
    assert found[0].key == key
    assert len(found) == count
    last = max(found, key=lambda one: one.key)
    for phase in (0.3, 2.0, 4.4):
        end, there = _drawn(scene, last, phase)[1], complex(*scene.pose(phase, 0).position[joint])
        across = there - end
        if count == 1:  # the guide is level: along it the slider runs
            assert across.imag == pytest.approx(0.0, abs=1e-9)
        else:
            assert abs(across) == pytest.approx(0.0, abs=1e-9)


def test_an_angle_and_a_speed_have_no_construction() -> None:
    scene = load("press")
    angles = [item for item in dimensions(scene) if item.kind not in ("length", "offset")]
    assert angles
    assert not [one for item in angles for one in stretches(scene, item.key)]


def test_a_joint_is_dragged_with_the_mouse(player: Player) -> None:
    player.type("e")
    before, screen = player.state, player.window.screen
    x, y = place(before, "B")
    player.drag(screen.pixel(x, y), screen.pixel(x + 6.0, y + 6.0), screen.pixel(x + 10.0, y + 10.0))
    assert values(player.state)["Rocker 4"] > values(before)["Rocker 4"]
    assert (player.state.held, player.state.editing.past) == (None, (before.scene,))


@pytest.mark.parametrize(
    ("shift", "whole"), [(0, True), (pygame.KMOD_LSHIFT, False)], ids=["whole", "tenths"]
)
def test_shift_makes_the_mouse_go_in_tenths(
    player: Player, monkeypatch: pytest.MonkeyPatch, shift: int, whole: bool
) -> None:
    player.type("e")
    x, y = place(player.state, "B")
    monkeypatch.setattr(pygame.key, "get_mods", lambda: shift)
    player.drag(player.window.screen.pixel(x, y), player.window.screen.pixel(x + 9.0, y + 5.0))
    rocker = values(player.state)["Rocker 4"]
    assert (round(rocker, 1), rocker == round(rocker)) == (rocker, whole)


def test_moves_of_one_frame_are_taken_as_one(player: Player, monkeypatch: pytest.MonkeyPatch) -> None:
    player.type("e")
    start = player.window.screen.pixel(*place(player.state, "B"))
    player.mouse(pygame.MOUSEBUTTONDOWN, start, button=1)
    seen: list[Action] = []
    actions = player.window._mouse.actions

    def recorded(*args: object) -> tuple[Action, ...]:
        found = actions(*args)  # type: ignore[arg-type]
        seen.extend(found)
        return found

    monkeypatch.setattr(player.window._mouse, "actions", recorded)
    for far in range(1, 9):
        at = (round(start[0]) + far, round(start[1]))
        pygame.event.post(pygame.event.Event(pygame.MOUSEMOTION, pos=at, rel=(1, 0), buttons=(1, 0, 0)))
    player.tick()
    assert [action.name for action in seen] == ["carry"]


@pytest.mark.parametrize("angle", ["30 deg", "30°", "30 Deg", "30 °"])
def test_a_pin_s_angle_has_a_handle_however_its_degrees_are_written(angle: str) -> None:
    text = f'[four-bar]\nground = 100\ncrank = 30\ncoupler = 90\nrocker = 80\nground_angle = "{angle}"\n'
    scene = scene_from(parse(text, "my.toml"), name="my", where="my.toml")
    assert ("four-bar", "ground_angle") in {handle.key for handle in handles(scene, "O4")}


def test_the_view_stands_still_under_the_hand_as_long_as_there_is_room() -> None:
    framing, size = Framing(), (1280, 720)
    state = opened("crank-rocker", 1.0)
    before = framing.fitting(state, size).view
    near = drag(state, "B", (9.0, 7.0))
    assert near.scene is not state.scene
    assert framing.fitting(near, size).view == before
    far = after(near, Action("carry", (170.0, 400.0, 1.0)))
    assert far.scene is not near.scene
    assert framing.fitting(far, size).view.scale < before.scale
    left = after(near, "drop")
    assert framing.fitting(left, size).view != before


def test_what_is_dragged_aside_goes_with_the_mouse(player: Player) -> None:
    screen = player.window.screen
    x, y = screen.pixel(0.0, 0.0)
    player.drag((5, 5), (25, 17))
    assert player.window.screen.pixel(0.0, 0.0) == pytest.approx((x + 20, y + 12), abs=1.0)


@pytest.mark.slow
def test_linkage_chart_list_and_dimensions_follow_the_hand_in_every_frame(player: Player) -> None:
    pygame.display.set_mode((1280, 720), pygame.RESIZABLE)
    player.window.state = replace(player.state, look=Look(chart="P.velocity", names=2))
    player.type("e")
    player.settle()
    shown, seen = player.window.screen, list[tuple[object, ...]]()
    x, y = shown.pixel(*place(player.state, "B"))
    player.mouse(pygame.MOUSEBUTTONDOWN, (x, y), button=1)
    anchors = [label.anchor for label in shown.last.names.labels]
    for step in range(1, 8):
        player.mouse(pygame.MOUSEMOTION, (x + 9 * step, y), rel=(9, 0), buttons=(1, 0, 0))
        picture, panel = shown.last, values_in(shown.state)
        assert picture.scene is picture.figure.scene is player.state.scene
        assert picture._chart
        assert picture._chart.panels[0].figure is picture.figure
        assert [label.anchor for label in picture.names.labels] == anchors
        told = [label.text for label in (*picture.names.labels, *picture.names.listed)]
        assert panel
        assert any(row.value in " ".join(told) for row in panel.rows)
        seen.append((player.state.scene, panel, told))
    changed = [[one != other for one, other in zip(*pair, strict=True)] for pair in pairwise(seen)]
    assert all(all(one) for one in changed), changed
