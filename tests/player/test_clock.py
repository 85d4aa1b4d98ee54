"""The clock: phase from the integer frame, continuous through every change."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from linkanim.player.clock import STEP, Clock, factor

RATE = 2.0
CHANGES: dict[str, Callable[[Clock, int], Clock]] = {
    "pause": lambda clock, frame: clock.pause(frame, True),
    "play": lambda clock, frame: clock.pause(frame, False),
    "turn": lambda clock, frame: clock.turn(frame),
    "faster": lambda clock, frame: clock.faster(frame, 3),
    "slower": lambda clock, frame: clock.faster(frame, -2),
    "another scene": lambda clock, frame: clock.at_rate(frame, 3.0),
}
CLOCKS = {
    "running": Clock(RATE),
    "paused": Clock(RATE).pause(30, True),
    "stepped": Clock(RATE).step(30, 7),
    "stepped and running": Clock(RATE).step(30, 7).pause(60, False),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
@pytest.mark.parametrize("clock", CLOCKS.values(), ids=CLOCKS)
def test_a_change_keeps_the_phase(clock: Clock, change: Callable[[Clock, int], Clock]) -> None:
    assert change(clock, 100).at(100) == clock.at(100)


def test_a_second_of_frames_is_a_second_of_phase() -> None:
    assert Clock(RATE).at(60) == RATE


def test_what_is_let_go_runs_on_as_fast_as_the_hand_and_comes_to_rest() -> None:
    clock = Clock(RATE).pause(30, True)
    coasting = clock.let_go(30, 5.0, paused=True)
    assert (coasting.at(30.001) - coasting.at(30)) * 60 / 0.001 == pytest.approx(5.0, rel=1e-3)
    assert coasting.at(1000) == coasting.at(900) > coasting.at(31) > clock.at(30)


def test_the_phase_is_not_summed() -> None:
    # A day at 60 frames a second: the sum of so many steps would be off by far more.
    frames = 60 * 86400
    assert Clock(RATE).at(frames) == RATE * frames / 60


def test_a_paused_clock_stands_still() -> None:
    clock = Clock(RATE).pause(17, True)
    assert clock.at(17) == clock.at(10_000)


def test_pausing_twice_leaves_no_trace() -> None:
    clock = Clock(RATE).pause(50, True)
    assert clock.pause(60, True) == clock


def test_turning_runs_back_over_the_same_phases() -> None:
    clock = Clock(RATE).turn(60)
    assert clock.at(120) == pytest.approx(0.0, abs=4e-16)


# Steps follow the way the crank runs: a scene may run clockwise, and D turns it round.
ALONG = {
    "forward": (Clock(RATE), 1),
    "clockwise scene": (Clock(-RATE), -1),
    "turned": (Clock(RATE).turn(0), -1),
    "slow": (Clock(RATE).faster(0, -20), 1),
    "clockwise scene, turned": (Clock(-RATE).turn(0), 1),
}


@pytest.mark.parametrize(("clock", "sign"), ALONG.values(), ids=ALONG)
def test_a_step_is_a_degree_along_the_motion(clock: Clock, sign: int) -> None:
    assert clock.step(0, 1).at(0) == sign * math.radians(1.0)


def test_a_step_pauses() -> None:
    assert Clock(RATE).step(5, 1).paused


def test_steps_there_and_back_end_on_the_same_bit() -> None:
    clock = Clock(RATE).pause(37, True)
    there = clock
    for _ in range(360):
        there = there.step(40, 1)
    assert there.at(40) == clock.at(40) + 360 * STEP
    for _ in range(36):
        there = there.step(90, -10)
    assert there.at(90) == clock.at(90)


def test_going_somewhere_forgets_the_steps() -> None:
    assert Clock(RATE).step(3, 5).go(3, 1.25).at(3) == 1.25


def test_ten_rungs_are_a_decade_and_each_has_an_inverse() -> None:
    assert [factor(level) for level in (-20, -10, -1, 0, 1, 10)] == [0.01, 0.1, 0.8, 1.0, 1.25, 10.0]
    assert all(factor(level + 1) > factor(level) for level in range(-20, 10))


def test_faster_and_slower_give_the_speed_back() -> None:
    assert Clock(RATE).faster(9, 4).faster(12, -4).speed == RATE


def test_the_ladder_ends() -> None:
    assert Clock(RATE).faster(0, 99).speed == pytest.approx(10 * RATE)
    assert Clock(RATE).faster(0, -99).speed == pytest.approx(RATE / 100)


def test_a_frame_between_two_frames_has_its_phase() -> None:
    assert Clock(math.pi).at(30.5) == math.pi * 30.5 / 60
