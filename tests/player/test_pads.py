"""Gamepads: the left stick, buttons, and plugging in and out, as events that the window really gets."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pygame
import pytest
from playing import SIZE, Player

from linkanim.player import screen
from linkanim.player.keys import PAD, RUNNING, help_groups
from linkanim.player.shelving import OpenShelf
from linkanim.player.state import State, begin
from linkanim.scenes import load

SOUTH, EAST, START, RB = 0, 1, 7, 5


class Pad:
    """Stands where a plugged-in gamepad would."""

    def __init__(self, index: int) -> None:
        self.index = index

    def get_name(self) -> str:
        return f"Pad {self.index}"

    def get_instance_id(self) -> int:
        return 10 + self.index

    def get_numhats(self) -> int:
        return 1 - self.index


@pytest.fixture(params=["crank-rocker"])
def pads(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(pygame.joystick, "Joystick", Pad)
    with screen.opened(SIZE):
        player = Player(begin(load(request.param)))
        yield player
        player.window.close()


def post(kind: int, **values: Any) -> None:
    pygame.event.post(pygame.event.Event(kind, instance_id=10, **values))


def push(player: Player, way: complex) -> State:
    """Push the left stick, whose axes count right and down, and let a frame go by."""
    post(pygame.JOYAXISMOTION, axis=0, value=way.real)
    post(pygame.JOYAXISMOTION, axis=1, value=-way.imag)
    player.tick()
    return player.state


def button(player: Player, number: int) -> State:
    post(pygame.JOYBUTTONDOWN, button=number)
    post(pygame.JOYBUTTONUP, button=number)
    player.tick()
    return player.state


@pytest.mark.parametrize("reach", [0.5, 1.0, 1.3])
def test_the_crank_points_where_the_stick_does(pads: Player, reach: float) -> None:
    for degrees in range(-180, 181, 15):
        state = push(pads, cmath.rect(reach, math.radians(degrees)))
        off = state.scene.pose(state.phase, 0).coordinate - math.radians(degrees)
        assert abs(math.remainder(off, math.tau)) < math.radians(1)
        assert state.clock.paused


def test_a_stick_that_is_let_go_leaves_the_crank_alone(pads: Player) -> None:
    before = push(pads, 1j).phase
    assert push(pads, 0.3 + 0.2j).phase == before
    assert push(pads, 0j).phase == before


@pytest.mark.parametrize("pads", ["double-rocker"], indirect=True)
def test_a_swing_follows_the_stick_to_its_limits(pads: Player) -> None:
    low, high = pads.state.scene.info.input_range
    middle = (low + high) / 2
    for angle, wanted in ((middle, middle), (high + 0.3, high), (low - 0.3, low)):
        state = push(pads, cmath.rect(1.0, angle))
        found = state.scene.pose(state.phase, 0).coordinate
        assert math.remainder(found - wanted, math.tau) == pytest.approx(0, abs=math.radians(1))


@pytest.mark.parametrize("pads", ["driven-piston"], indirect=True)
def test_a_slider_that_drives_is_as_far_out_as_the_stick(pads: Player) -> None:
    low, high = pads.state.scene.info.input_range
    angle = pads.state.scene.linkage.joint(pads.state.scene.linkage.drive.joint).slides[0].angle
    for share in (-1.0, -0.5, 0.5, 1.0):
        state = push(pads, share * cmath.rect(1.0, angle))
        travel = state.scene.pose(state.phase, 0).coordinate
        assert travel == pytest.approx((low + high) / 2 + share * (high - low) / 2, abs=1e-3 * (high - low))


def test_buttons_do_what_their_keys_do(pads: Player) -> None:
    assert button(pads, SOUTH).clock.paused
    assert not button(pads, SOUTH).clock.paused
    assert button(pads, RB).scene.name != "crank-rocker"
    shelf = button(pads, START).of(OpenShelf)
    assert shelf
    post(pygame.JOYHATMOTION, value=(1, 0))
    pads.tick()
    moved = pads.state.of(OpenShelf)
    assert moved
    assert moved == replace(shelf, chosen=shelf.chosen + 1, top=moved.top)
    assert button(pads, SOUTH).of(OpenShelf) is None  # takes what is chosen
    assert [button(pads, number).of(OpenShelf) is None for number in (START, EAST)] == [False, True]


def test_a_d_pad_that_is_held_repeats_until_it_is_let_go(pads: Player) -> None:
    button(pads, SOUTH)
    post(pygame.JOYHATMOTION, value=(1, 0))
    pads.tick()
    steps = pads.state.clock.steps
    pads.tick(40)
    held = pads.state.clock.steps
    assert held > steps + 3
    post(pygame.JOYHATMOTION, value=(0, 0))
    pads.tick(40)
    assert pads.state.clock.steps == held


@pytest.mark.parametrize(("index", "number"), [(0, 7), (1, 6)], ids=["hat", "d-pad of buttons"])
def test_help_names_the_buttons_once_one_is_plugged_in(pads: Player, index: int, number: int) -> None:
    assert "gamepad" not in dict(help_groups(RUNNING))
    pygame.event.post(pygame.event.Event(pygame.JOYDEVICEADDED, device_index=index))
    pads.tick()
    plugged = pads.state
    assert plugged.pad
    assert plugged.toast
    assert f"Pad {index}" in plugged.toast.text
    pygame.event.post(pygame.event.Event(pygame.JOYBUTTONDOWN, instance_id=10 + index, button=number))
    pads.tick()
    assert pads.state.of(OpenShelf) is not None  # Start, by the number that this one gives it
    pygame.event.post(pygame.event.Event(pygame.JOYDEVICEREMOVED, instance_id=10 + index))
    pads.tick()
    assert not pads.state.pad
    written = [words for words, _ in dict(help_groups(RUNNING, pad=True))["gamepad"]]
    assert written == [row.written for row in PAD]


def test_one_that_is_gone_before_its_event_comes_is_left_out(
    pads: Player, monkeypatch: pytest.MonkeyPatch
) -> None:
    def gone(index: int) -> Pad:
        raise pygame.error("Invalid joystick device number")

    with monkeypatch.context() as patch:
        patch.setattr(pygame.joystick, "Joystick", gone)
        pygame.event.post(pygame.event.Event(pygame.JOYDEVICEADDED, device_index=0))
        assert pads.tick()
    assert (pads.state.pad, pads.state.toast) == (False, None)


def test_one_that_is_pulled_out_is_asked_nothing_any_more(
    pads: Player, monkeypatch: pytest.MonkeyPatch
) -> None:
    def pulled(_: Pad) -> str:
        raise pygame.error("joystick not initialized")

    for index in (0, 1):
        pygame.event.post(pygame.event.Event(pygame.JOYDEVICEADDED, device_index=index))
        pads.tick()
    monkeypatch.setattr(Pad, "get_name", pulled)
    monkeypatch.setattr(Pad, "get_numhats", pulled)
    assert button(pads, SOUTH).clock.paused
    post(pygame.JOYDEVICEREMOVED)
    pads.tick()
    assert pads.state.toast
    assert pads.state.toast.text.startswith("Pad 1: its left stick")


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_stick_that_is_nowhere_leaves_the_crank_alone(pads: Player, value: float) -> None:
    before = push(pads, 1j).phase
    post(pygame.JOYAXISMOTION, axis=0, value=value)
    pads.tick()
    assert (pads.state.phase, pads.state.toast) == (before, None)
