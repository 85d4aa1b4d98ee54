"""A gamepad's buttons are keys, as events that the window really gets; it may come and go."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pygame
import pytest
from playing import SIZE, Player

from linkanim.player.shelving import OpenShelf
from linkanim.player.state import State, begin
from linkanim.scenes import load
from linkanim.ui import screen


class Pad:
    """Stands where a plugged-in gamepad would."""

    def __init__(self, index: int) -> None:
        if index > 1:
            raise pygame.error("Invalid joystick device number")


@pytest.fixture
def pads(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(pygame.joystick, "Joystick", Pad)
    with screen.opened(SIZE):
        player = Player(begin(load("crank-rocker")))
        yield player
        player.window.close()


def post(kind: int, **values: Any) -> None:
    pygame.event.post(pygame.event.Event(kind, instance_id=10, **values))


# What each button does, by its number, or by where the D-pad is pushed.
BUTTONS: dict[str, tuple[int | tuple[int, int], Callable[[State], object]]] = {
    "A pauses": (0, lambda state: state.clock.paused),
    "X turns round": (2, lambda state: state.clock.direction < 0),
    "Y shows names": (3, lambda state: state.look.names),
    "RB: the next": (5, lambda state: state.place == 1),
    "Back: help": (6, lambda state: state.help),
    "Start: the shelf": (7, lambda state: state.of(OpenShelf)),
    "up: faster": ((0, 1), lambda state: state.clock.level == 1),
    "right: a step on": ((1, 0), lambda state: state.clock.paused and state.clock.steps == 1),
}


@pytest.mark.parametrize("case", BUTTONS)
def test_a_button_does_what_its_key_does(pads: Player, case: str) -> None:
    pressed, is_done = BUTTONS[case]
    before = pads.state.place
    if isinstance(pressed, int):
        post(pygame.JOYBUTTONDOWN, button=pressed)
    else:
        post(pygame.JOYHATMOTION, value=pressed)
    pads.tick()
    if "next" in case:
        assert pads.state.place == before + 1
    else:
        assert is_done(pads.state)


def test_with_something_open_the_lower_button_is_enter_and_the_right_one_escape(pads: Player) -> None:
    for button in (7, 1, 7, 0):
        post(pygame.JOYBUTTONDOWN, button=button)
        pads.tick()
        assert bool(pads.state.of(OpenShelf)) == (button == 7)
    assert not pads.state.clock.paused


def test_a_held_direction_repeats_until_it_is_let_go(pads: Player) -> None:
    post(pygame.JOYHATMOTION, value=(1, 0))
    pads.tick()
    steps = pads.state.clock.steps
    pads.tick(60)
    pads.tick()
    assert pads.state.clock.steps > steps
    post(pygame.JOYHATMOTION, value=(0, 0))
    pads.tick()
    steps = pads.state.clock.steps
    pads.tick(60)
    assert pads.state.clock.steps == steps


@pytest.mark.parametrize("index", [0, 7], ids=["there", "pulled out before its event came"])
def test_a_pad_that_comes_or_is_gone_does_no_harm(pads: Player, index: int) -> None:
    post(pygame.JOYDEVICEADDED, device_index=index)
    post(pygame.JOYDEVICEREMOVED)
    post(pygame.JOYBUTTONDOWN, button=40)
    assert pads.tick()
