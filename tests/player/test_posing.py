"""Poses set down in the window: frames and pins, linkages that follow, what is dragged, kept and taped."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pygame
import pytest
from playing import CTRL, NoSearch, Player, the
from shown_lists import drawn_in

from linkanim.picture.build_sheet import Head
from linkanim.picture.poses import AXIS
from linkanim.player import background
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.background import actions_of, request_of
from linkanim.player.posing import Posing, free_joints
from linkanim.player.state import LARGEST_DIAL, PoseSketch, SetPose, State, begin
from linkanim.player.tape import Taping, resumed
from linkanim.scenes import load
from linkanim.scenes.scene import PosesPurpose
from linkanim.synthesis.burmester import CentreCurve, Poses
from linkanim.synthesis.follower import Follower, FollowPoses
from linkanim.ui import screen
from linkanim.ui.shelf import answers_of

REACH, STEP = 2.0, 0.5
ROWS = ((0.0, 0.0, 0.0), (40.0, 10.0, 0.6), (70.0, -5.0, 1.4), (85.0, -30.0, 1.9), (60.0, -60.0, 2.4))


def after(state: State, *actions: Action | str) -> State:
    for one in actions:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return state


def hand(name: str, x: float, y: float, step: float = STEP) -> Action:
    return Action(name, (x, y, REACH, step))


def drawn(state: State, *places: tuple[float, float], step: float = STEP) -> State:
    """Press at the first place, go to the others, and let go."""
    state = after(state, hand("hand_down", *places[0], step))
    return after(state, *(hand("hand_to", *place, step) for place in places[1:]), "hand_up")


def sketch_of(state: State) -> PoseSketch:
    assert state.posing
    return state.posing


def answered(state: State, follower: Follower | None = None) -> State:
    """Return the state with all that is asked for answered, as the process beside would."""
    follower = follower or Follower()
    asked = [effect.name for effect in state.effects if effect.name in ("search", "anew", "follow")]
    for name in asked[-1:]:
        request = request_of(sketch_of(state), search=name == "search", anew=name == "anew")
        assert isinstance(request, FollowPoses)
        for reply in follower.replies(request):
            state = after(state, *actions_of(reply, state.sketch))
    return state


def put(count: int, *, sliding: bool = False) -> Action:
    return Action("set_poses", (float(sliding), *(value for row in ROWS[:count] for value in row)))


@pytest.fixture(scope="module")
def empty() -> State:
    return after(begin(load("crank-rocker")), "poses")


@pytest.fixture(scope="module")
def three(empty: State) -> State:
    return answered(after(empty, put(3)))


def test_a_press_and_a_drag_set_down_a_frame_and_turn_it(empty: State) -> None:
    state = drawn(empty, (10.1, 20.2), (10.1, 60.0))
    (pose,) = sketch_of(state).poses
    assert pose == pytest.approx((10.0, 20.0, math.pi / 2))
    assert state.effects == ()
    again = drawn(state, (50, 20))
    # a click alone sets it down as the last one stood
    assert sketch_of(again).poses[1] == SetPose(50.0, 20.0, sketch_of(state).poses[0].angle)
    assert [effect.name for effect in again.effects] == ["anew"]


def test_a_frame_is_dragged_by_its_origin_and_turned_by_its_axis(empty: State) -> None:
    state = after(empty, put(2))
    moved = drawn(state, (40.3, 10.2), (52.3, 11.2))
    assert sketch_of(moved).poses[1] == SetPose(52.0, 11.0, 0.6)
    tip = (AXIS * REACH, 0.0)
    turned = drawn(state, tip, (0.0, 30.0))
    assert sketch_of(turned).poses[0].angle == pytest.approx(math.pi / 2)
    assert sketch_of(turned).poses[0][:2] == (0.0, 0.0)
    free = drawn(state, tip, (30.0, 7.0), step=0.0)
    assert sketch_of(free).poses[0].angle == pytest.approx(math.atan2(7, 30))


@pytest.mark.parametrize("count", [2, 3, 4, 5])
def test_linkages_through_the_poses_are_shown_and_chosen(empty: State, count: int) -> None:
    state = answered(after(empty, put(count)))
    sketch = sketch_of(state)
    assert len(sketch.answers) > 1
    assert isinstance(state.scene.purpose, PosesPurpose)
    assert len(state.scene.purpose.poses) == count
    other = after(state, Action("answer", 1))
    assert other.scene.document["joints"] != state.scene.document["joints"]
    for answer in sketch.answers:
        # the coupler's point is the first pose's origin, to the last digits
        assert answer.joints["P"] == pytest.approx(complex(*ROWS[0][:2]), abs=1e-9)
    row = answers_of(state)
    assert row is not None
    assert all("mm" in words for words in row.words)


def test_a_sixth_frame_is_not_set_down(empty: State) -> None:
    state = drawn(after(empty, put(5)), (200, 200))
    assert len(sketch_of(state).poses) == 5


def test_too_few_poses_ask_for_nothing(empty: State) -> None:
    assert after(empty, put(1)).effects == ()
    state = after(answered(after(empty, put(2))), Action("further", 1), "remove")
    assert (len(sketch_of(state).poses), sketch_of(state).answers) == (1, ())
    assert after(state, "keep").scene is empty.scene


def test_a_linkage_follows_a_frame_while_that_is_dragged(three: State) -> None:
    follower = Follower()
    three = answered(replace(three, effects=(Action("anew"),)), follower)
    begun = after(three, hand("hand_down", 70.0, -5.0), hand("hand_to", 72.0, -6.0))
    assert [effect.name for effect in begun.effects] == ["follow"]
    led = advance(answered(begun, follower), [])
    assert sketch_of(led).coming is None
    assert led.scene is not three.scene
    assert led.scene.document["guide"]["poses"][2][0] == "72.0 mm"
    before, now = (sketch_of(one).answer for one in (three, led))
    # what was free keeps its pivots
    assert now.joints["O2"] == pytest.approx(before.joints["O2"], abs=1e-6)
    assert now.joints["O4"] == pytest.approx(before.joints["O4"], abs=1e-6)
    done = answered(after(led, "hand_up"), follower)
    assert sketch_of(done).answer.joints["O2"] == pytest.approx(before.joints["O2"], abs=1e-6)


def test_a_pivot_that_is_dragged_is_held_and_the_other_one_stays(three: State) -> None:
    follower = Follower()
    three = answered(replace(three, effects=(Action("anew"),)), follower)
    joints = sketch_of(three).answer.joints
    at = joints["O2"]
    state = after(three, hand("hand_down", at.real, at.imag), hand("hand_to", at.real + 5, at.imag + 3))
    state = answered(state, follower)
    held = sketch_of(state).pins[0]
    assert sketch_of(state).answer.joints["O2"] == pytest.approx(complex(*held), abs=1e-9)
    assert sketch_of(state).answer.joints["O4"] == pytest.approx(joints["O4"], abs=1e-6)
    done = answered(after(state, "hand_up"), follower)
    for answer in sketch_of(done).answers:
        pivots = [answer.joints[name] for name in ("O2", "O4")]
        assert min(abs(pivot - complex(*held)) for pivot in pivots) < 1e-6


def test_a_joint_of_three_poses_is_dragged_and_its_pivot_follows(three: State) -> None:
    follower = Follower()
    three = answered(replace(three, effects=(Action("anew"),)), follower)
    at = sketch_of(three).answer.joints["A"]
    state = after(three, hand("hand_down", at.real, at.imag), hand("hand_to", at.real + 2, at.imag - 1, 0.0))
    held = sketch_of(state).held
    assert held is not None
    assert held.what == "joint"
    state = answered(state, follower)
    to = sketch_of(state).answer.joints["A"]
    assert to == pytest.approx(at + (2 - 1j), abs=1e-6)
    rows = np.array(ROWS[:3])
    poses = Poses(rows[:, 0] + 1j * rows[:, 1], rows[:, 2].copy())
    reaches = np.abs(poses.places(to) - sketch_of(state).answer.joints["O2"])
    assert np.ptp(reaches) < 1e-9 * poses.size


def test_a_pivot_of_four_poses_slides_along_the_curve_of_centre_points(empty: State) -> None:
    state = answered(after(empty, put(4)))
    at = sketch_of(state).answer.joints["O2"]
    led = after(state, hand("hand_down", at.real, at.imag), hand("hand_to", at.real + 9, at.imag + 6))
    rows = np.array(ROWS[:4])
    curve = CentreCurve(Poses(rows[:, 0] + 1j * rows[:, 1], rows[:, 2].copy()))
    foot = complex(*sketch_of(led).pins[0])
    assert abs(curve.nearest(foot) - foot) < 1e-9
    assert abs(foot - at) > 1


@pytest.mark.parametrize("name", ["A", "B"])
def test_a_joint_of_four_poses_slides_along_the_curve_of_circle_points(empty: State, name: str) -> None:
    follower = Follower()
    state = answered(after(empty, put(4)), follower)
    before = sketch_of(state).answer.joints
    at = before[name]
    assert sketch_of(state).poses[3] == ROWS[3]
    begun = after(state, hand("hand_down", at.real, at.imag), hand("hand_to", at.real + 6, at.imag - 4, 0.0))
    led = answered(begun, follower)
    now = sketch_of(led).answer.joints
    rows = np.array(ROWS[:4])
    poses = Poses(rows[:, 0] + 1j * rows[:, 1], rows[:, 2].copy())
    assert abs(CentreCurve(poses.inverse).nearest(now[name]) - now[name]) < 1e-6
    assert abs(now[name] - at) > 1
    pivot, other, its = ("O2", "B", "O4") if name == "A" else ("O4", "A", "O2")
    assert np.ptp(np.abs(poses.places(now[name]) - now[pivot])) < 1e-9 * poses.size
    assert (now[other], now[its]) == pytest.approx((before[other], before[its]), abs=1e-6)
    # a tape has it, and it is undone
    done = answered(after(led, "hand_up"), follower)
    again = after(begin(load("crank-rocker")), *resumed(done))
    assert sketch_of(again).answer.joints[name] == pytest.approx(now[name], abs=1e-6)
    assert sketch_of(after(done, "undo_sketch")).answer.joints[name] == pytest.approx(at, abs=1e-6)


def test_of_four_poses_one_point_alone_slides(empty: State) -> None:
    sliding = answered(after(empty, put(4, sliding=True)))
    if sketch_of(sliding).answers:
        assert set(free_joints(sketch_of(sliding))) == {"O2", "A"}


def test_five_poses_leave_no_pivot_to_be_dragged_or_set(empty: State) -> None:
    state = answered(after(empty, put(5)))
    at = sketch_of(state).answer.joints["O2"]
    assert sketch_of(after(state, hand("hand_down", at.real, at.imag))).held is None
    told = after(state, Action("set_pin", (3.0, 4.0)))
    assert told.toast is not None
    assert "no choice of pivots" in told.toast.text


def test_pins_are_set_where_linkages_are_to_be_fixed(empty: State) -> None:
    state = drawn(after(empty, put(2), "pinning"), (20.2, 60.1))
    assert sketch_of(state).pins == ((20.0, 60.0),)
    found = answered(state)
    for answer in sketch_of(found).answers:
        assert min(abs(answer.joints[name] - (20 + 60j)) for name in ("O2", "O4")) < 1e-9
    assert sketch_of(after(found, "sliding")).pins == ((20.0, 60.0),)


def test_sliders_are_asked_for(empty: State) -> None:
    state = answered(after(empty, put(3), "sliding"))
    assert all(answer.sliding for answer in sketch_of(state).answers)
    assert "slider" in state.scene.info.class_name


def test_the_dial_gives_smaller_links_at_one_end_and_better_angles_at_the_other(three: State) -> None:
    small = answered(after(three, Action("dial", 0.0)))
    steep = answered(after(three, Action("dial", 1.0)))
    first, second = sketch_of(small).answer, sketch_of(steep).answer
    assert first.size < second.size
    assert first.transmission < second.transmission
    assert sketch_of(after(three, Action("dial_on", -99))).dial == -LARGEST_DIAL


def test_poses_that_no_linkage_meets_are_told_in_a_sentence(empty: State) -> None:
    twice = (1.0, *ROWS[0], *ROWS[1], *ROWS[0])
    state = answered(after(empty, Action("set_poses", twice)))
    head = drawn_in(state, Head)
    assert head
    assert head.is_warning
    assert "poses 1 and 3 are one" in head.sentence
    assert the(state, Posing).alone == "sheet"
    # a change asks again
    assert sketch_of(drawn(state, (0.0, 0.0), (5.0, 5.0))).refusal == ""


def test_a_change_is_undone_with_its_answers(three: State) -> None:
    moved = answered(drawn(three, (70.0, -5.0), (75.0, -9.0)))
    back = after(moved, "undo_sketch")
    assert sketch_of(back).poses == sketch_of(three).poses
    assert sketch_of(back).answers == sketch_of(three).answers


def test_a_linkage_is_kept_as_the_scene_and_undo_brings_the_other_back(three: State) -> None:
    kept = after(three, "keep")
    assert kept.sketch is None
    assert kept.scene.name == "poses"
    assert after(kept, "undo").scene == begin(load("crank-rocker")).scene


def test_the_poses_of_a_scene_are_taken_up_again(three: State) -> None:
    again = after(after(three, "keep"), "poses")
    for one, other in zip(sketch_of(again).poses, sketch_of(three).poses, strict=True):
        assert one == pytest.approx(other, abs=1e-12)
    assert [effect.name for effect in again.effects] == ["poses", "search"]


def test_esc_lets_go_of_what_is_held_first_and_then_leaves(three: State) -> None:
    led = after(three, hand("hand_down", 70.0, -5.0), hand("hand_to", 80.0, -5.0))
    back = after(led, "back")
    assert sketch_of(back).poses == sketch_of(three).poses
    lit = after(three, Action("further", 1))
    assert sketch_of(lit).cursor == ROWS[0][:2]
    gone = after(lit, "back", "back")
    assert sketch_of(gone).selected is None
    left = after(gone, "back")
    assert left.sketch is None
    assert left.scene == begin(load("crank-rocker")).scene


def test_a_tape_that_begins_amid_poses_has_them_and_their_linkage(three: State) -> None:
    state = after(three, "theory", Action("answer", 1))
    begun = Taping(state, (640, 360)).tape(state.frame).begun
    one, other = sketch_of(begun), sketch_of(state)
    assert (one.poses, one.chosen, one.curves) == (other.poses, 1, True)
    assert begun.scene.document["joints"] == state.scene.document["joints"]


def test_a_reply_to_poses_of_before_is_left_out(empty: State) -> None:
    state = after(empty, put(3))
    request = request_of(sketch_of(state), search=True)
    assert request is not None
    (reply,) = Follower().replies(request)
    later = drawn(state, (70.0, -5.0), (75.0, -9.0))
    assert [*actions_of(reply, later.sketch)] == []


@pytest.fixture
def player(monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    monkeypatch.setattr(background, "Following", lambda *_: NoSearch())
    with screen.opened((640, 360)):
        player = Player(begin(load("crank-rocker")))
        player.press(pygame.K_F4)
        yield player
        player.window.close()


def test_frames_are_set_down_with_the_mouse(player: Player) -> None:
    player.drag((200, 200), (240, 200))
    player.drag((400, 150), (400, 100))
    first, second = sketch_of(player.state).poses
    assert first.angle == pytest.approx(0.0)
    assert second.angle == pytest.approx(math.pi / 2)
    assert player.window.screen.pixel(*second[:2]) == pytest.approx((400, 150), abs=2)
    player.drag((400, 150), (430, 170))
    assert player.window.screen.pixel(*sketch_of(player.state).poses[1][:2]) == pytest.approx(
        (430, 170), abs=2
    )


def test_a_frame_below_the_words_is_drawn_over_them(player: Player) -> None:
    player.drag((30, 30), (70, 30))
    place = sketch_of(player.state).poses[0]
    at = player.window.screen.pixel(place.x, place.y)
    player.settle()
    x, y = round(at[0]) + 12, round(at[1])  # its axis, which lies between two rows of pixels
    found = [screen.display_surface().get_at((x, y + row))[:3] for row in (-1, 0, 1)]
    assert min(max(colour) for colour in found) < 100


def test_poses_are_set_down_by_keys_alone(player: Player) -> None:
    arrows = {"left": pygame.K_LEFT, "right": pygame.K_RIGHT, "up": pygame.K_UP, "down": pygame.K_DOWN}

    def go(*ways: str) -> None:
        for way in ways:
            player.press(arrows[way])

    go("right", "left")
    player.press(pygame.K_RETURN)
    go("up", "up", "up")
    player.press(pygame.K_RETURN)
    go("right", "right", "right", "down")
    player.press(pygame.K_RETURN)
    go("right", "right", "right", "right")
    player.press(pygame.K_RETURN)
    first, second = sketch_of(player.state).poses
    assert first.angle == pytest.approx(math.pi / 2)
    assert second.angle == pytest.approx(0.0)
    player.press(pygame.K_TAB)
    player.press(pygame.K_RETURN)
    held = sketch_of(player.state).held
    assert held is not None
    assert (held.what, held.number) == ("pose", 0)
    go("left")
    player.press(pygame.K_RETURN)
    assert sketch_of(player.state).poses[0].x < first.x
    player.press(pygame.K_DELETE)
    assert len(sketch_of(player.state).poses) == 1
    player.press(pygame.K_z, CTRL)
    assert len(sketch_of(player.state).poses) == 2
