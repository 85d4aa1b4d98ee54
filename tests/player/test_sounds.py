"""Sounds: when they come, what they are, and that nothing is asked of a device before one is to be heard."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import get_args

import numpy as np
import pygame
import pytest
from numpy.typing import NDArray
from playing import Player

from linkanim.player.actions import advance
from linkanim.player.sound import RATE, Cue, Speaker, cues, wave
from linkanim.player.state import State, begin
from linkanim.scenes import load


def heard(name: str, *, direction: int = 1) -> list[Cue]:
    """Return what is heard over one true period, from a little after phase 0."""
    scene = load(name)
    state = replace(begin(scene), sounds=True)
    state = replace(state, clock=replace(state.clock, phase=0.05, direction=direction))
    found = list[Cue]()
    for _ in range(round(60 * scene.info.period_seconds)):
        after = advance(state)
        found += cues(state, after)
        state = after
    return found


# What a period has to be heard of, by the kind of input and output.
PERIODS: dict[str, list[Cue]] = {
    "crank-shaper": ["tick", "tock"],
    "crank-rocker": ["tick", "tock"],
    "double-rocker": ["limit", "limit"],
}


@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize("name", PERIODS)
def test_a_period_is_heard(name: str, direction: int) -> None:
    found = heard(name, direction=direction)
    assert sorted(set(found) & set(PERIODS[name])) == sorted(set(PERIODS[name]))
    for cue in set(PERIODS[name]):
        assert found.count(cue) == PERIODS[name].count(cue)


def moving(state: State, frames: int) -> tuple[State, State]:
    after = state
    for _ in range(frames):
        after = advance(after)
    return state, after


def test_nothing_is_heard_of_what_stands_still_or_jumps_or_is_switched_off() -> None:
    state = replace(begin(load("crank-shaper")), sounds=True)
    forward = state.scene.info.dead_centres
    assert forward
    at = replace(state, clock=replace(state.clock, phase=forward[1] - 1e-3))
    assert cues(*moving(at, 1)) == ("tick",)
    assert cues(at, at) == ()
    assert cues(at, replace(at, clock=replace(at.clock, phase=forward[1] + 2.0))) == ()
    assert cues(*moving(replace(at, sounds=None), 1)) == ()
    assert cues(at, replace(at, scene=load("press"))) == ()


@pytest.mark.parametrize("cue", get_args(Cue))
def test_waves_are_short_quiet_and_earlyand_end_in_silence(cue: Cue) -> None:
    samples = wave(cue).astype(float) / np.iinfo(np.int16).max
    assert 0.01 < len(samples) / RATE < 1.0
    assert 0.02 < np.abs(samples).max() < 0.2
    assert abs(samples[0]) < 1e-3
    assert np.abs(samples[-20:]).max() < 2e-3


def _pitch(samples: NDArray[np.int16]) -> float:
    """Return the loudest pitch (Hz)."""
    return float(np.abs(np.fft.rfft(samples, RATE)).argmax())


def test_a_limit_is_lower_than_a_dead_centre() -> None:
    assert _pitch(wave("limit")) < 200 < _pitch(wave("tock")) < _pitch(wave("tick"))
    assert _pitch(wave("tick")) == pytest.approx(2093, abs=30)


@pytest.mark.parametrize(("cue", "early", "late"), [("right", 659, 988), ("wrong", 233, 175)])
def test_what_is_right_rises_and_what_is_wrong_falls(cue: Cue, early: float, late: float) -> None:
    samples = wave(cue)
    first, last = samples[: round(0.085 * RATE)], samples[round(0.25 * RATE) :]
    assert _pitch(first) == pytest.approx(early, abs=15)
    assert _pitch(last) == pytest.approx(late, abs=15)


def test_the_device_is_opened_by_the_first_sound_and_not_before(player: Player) -> None:
    assert not pygame.mixer.get_init()
    player.press(pygame.K_u)
    assert player.state.is_audible
    assert player.state.chip
    assert player.state.chip.text == "sounds"
    player.press(pygame.K_SPACE)
    player.tick(round(60 * player.state.scene.info.period_seconds / 8))
    for _ in range(8):
        player.tick(round(60 * player.state.scene.info.period_seconds / 8))
    player.window.close()
    assert not pygame.mixer.get_init()
    player.press(pygame.K_u)
    assert not player.state.is_audible


def test_a_speaker_plays_once_it_is_open() -> None:
    speaker = Speaker()
    speaker.play("tick")
    assert speaker._opening
    speaker._opening.join()
    assert pygame.mixer.get_init() == (RATE, -16, 1)
    speaker.play("tick")
    assert pygame.mixer.get_busy()
    speaker.close()
    assert not pygame.mixer.get_init()


def test_without_a_device_it_is_silent(monkeypatch: pytest.MonkeyPatch) -> None:
    def none(*_: object, **__: object) -> None:
        raise pygame.error("no available audio device")

    monkeypatch.setattr(pygame.mixer, "init", none)
    speaker = Speaker()
    for _ in range(3):
        speaker.play("limit")
    speaker.close()
    assert speaker._sounds == {}


def test_math_of_a_turn_back_and_forth_over_one_place() -> None:
    state = replace(begin(load("double-rocker")), sounds=True)

    def at(phase: float) -> State:
        return replace(state, clock=replace(state.clock, phase=phase, paused=True))

    assert cues(at(math.pi - 0.01), at(math.pi + 0.01)) == ("limit",)
    assert cues(at(math.pi + 0.01), at(math.pi - 0.01)) == ("limit",)
    assert cues(at(math.pi + 0.01), at(math.pi + 0.02)) == ()
