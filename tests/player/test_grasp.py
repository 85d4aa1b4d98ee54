"""A moving point is led by a hand: the input follows, and is let go with the hand's speed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pygame
import pytest
from playing import Player
from shown_lists import lit_in

from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.clock import COAST_FRAMES, FRAMES_PER_SECOND
from linkanim.player.state import Grasp, State, begin
from linkanim.scenes import load
from linkanim.ui import screen
from linkanim.ui.pictures import stands


def after(state: State, *actions: Action | str) -> State:
    return advance(state, [Action(one) if isinstance(one, str) else one for one in actions])


def place(state: State, joint: str, phase: float | None = None) -> tuple[float, float]:
    found = state.displayed.pose(state.phase if phase is None else phase, 0).position[joint]
    return found[0], found[1]


def carry(to: tuple[float, float]) -> Action:
    return Action("carry", (*to, 1.0))


def led(state: State, joint: str, frames: int, step: float) -> State:
    """Lead a joint along its own course, by so much phase in each frame."""
    state = after(state, Action("grab", joint))
    start = state.phase
    for n in range(1, frames + 1):
        state = after(state, carry(place(state, joint, start + n * step)))
    return state


# Each kind of moving point, and each kind of input.
LED = {
    "a crank pin": ("crank-rocker", "A"),
    "a rocker's pin": ("crank-rocker", "B"),
    "a coupler point": ("crank-rocker", "P"),
    "a slider": ("slider-crank", "B"),
    "a point of a chain": ("jansen", "G"),
    "a swing's coupler point": ("watt-line", "P"),
    "a point beyond a change point": ("kite", "B"),
    "a driven slider": ("driven-piston", "C"),
}


@pytest.mark.parametrize(("name", "joint"), LED.values(), ids=LED)
def test_the_point_follows_the_hand(name: str, joint: str) -> None:
    scene = load(name)
    joint = joint if joint in scene.linkage.by_name else scene.trace[0]
    state = led(after(begin(scene), Action("scrub", 0.7)), joint, 40, 0.02)
    assert (
        math.dist(place(state, joint), place(state, joint, 0.7 + 40 * 0.02))
        < 1e-9 * scene.point_path(joint).size
    )


def test_a_running_scene_stands_in_the_hand_and_runs_on() -> None:
    state = after(begin(load("crank-rocker")), Action("grab", "P"))
    assert state.clock.paused
    assert not state.is_bare
    held = after(state)
    assert held.phase == state.phase
    assert not after(held, "drop").clock.paused


def test_it_swings_on_with_the_hands_speed_and_eases_to_its_own() -> None:
    state = led(begin(load("crank-rocker")), "P", 20, 0.05)
    phases, own = [state.phase], state.clock.speed
    state = after(state, "drop")
    for _ in range(COAST_FRAMES + 10):
        phases.append(state.phase)
        state = after(state)
    steps = [(last - first) * FRAMES_PER_SECOND for first, last in pairwise(phases)][1:]
    assert steps[0] == pytest.approx(0.05 * FRAMES_PER_SECOND, rel=0.05)
    assert steps[-1] == pytest.approx(own, rel=1e-9)
    assert all(abs(late - own) <= abs(early - own) + 1e-9 for early, late in pairwise(steps))


def test_a_paused_scene_swings_on_to_a_stand() -> None:
    state = led(after(begin(load("crank-rocker")), "pause"), "B", 20, 0.05)
    state = after(state, "drop")
    moving = after(state)
    assert moving.clock.paused
    assert moving.phase > state.phase
    for _ in range(COAST_FRAMES):
        moving = after(moving)
    assert after(moving).phase == moving.phase


def test_a_hand_that_stands_still_leaves_no_speed() -> None:
    state = led(after(begin(load("crank-rocker")), "pause"), "B", 20, 0.05)
    for _ in range(10):
        state = after(state)
    there = state.phase
    state = after(state, "drop")
    assert after(after(state)).phase == there


def test_a_step_ends_what_coasts() -> None:
    state = after(led(after(begin(load("crank-rocker")), "pause"), "B", 20, 0.05), "drop")
    stepped = after(after(state), Action("step", 1))
    assert after(stepped).phase == stepped.phase


def test_another_mechanism_is_let_go_of_and_runs() -> None:
    state = after(begin(load("crank-rocker")), Action("grab", "P"), Action("mechanism", 1))
    assert state.grasp is None
    assert not state.clock.paused


def test_a_fixed_pin_is_not_taken() -> None:
    assert after(begin(load("crank-rocker")), Action("grab", "O4")).grasp is None


@pytest.fixture
def player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    monkeypatch.chdir(tmp_path)
    with screen.opened((640, 360)):
        player = Player(begin(load("crank-rocker")))
        player.tick(5)
        yield player
        player.window.close()


def test_a_joint_that_is_led_while_another_scene_comes_glows_no_more(player: Player) -> None:
    led = replace(player.state, grasp=Grasp("P", ran=True, trail=(), forward=True))
    assert lit_in(led) == "P"
    assert lit_in(replace(led, scene=load("pumpjack"))) is None


def test_in_the_window_a_coupler_point_is_dragged_by_the_mouse(player: Player) -> None:
    scene = player.state.displayed
    first, *others = [
        player.window.screen.pixel(*scene.pose(player.state.phase + n * 0.1, 0).position["P"])
        for n in range(12)
    ]
    player.mouse(pygame.MOUSEBUTTONDOWN, first, button=1)
    for at in others:
        player.mouse(pygame.MOUSEMOTION, at, rel=(0, 0), buttons=(1, 0, 0))
    assert player.state.grasp
    assert lit_in(player.state) == "P"
    assert not stands(player.state)
    now = player.window.screen.pixel(*place(player.state, "P"))
    assert math.dist(now, others[-1]) < 2.0
    player.mouse(pygame.MOUSEBUTTONUP, others[-1], button=1)
    left = player.state
    assert (left.grasp, left.clock.paused) == (None, False)
