"""Actions on the clock: pause, steps, speed, direction, and where the phase stands."""

from __future__ import annotations

from dataclasses import replace

from linkanim.player.state.state import State


def pause(state: State, _: None) -> State:
    """Pause, or play on."""
    return replace(state, clock=state.clock.pause(state.frame, not state.clock.paused))


def step(state: State, degrees: int) -> State:
    """Pause, and step the input so many degrees along its way."""
    return replace(state, clock=state.clock.step(state.frame, degrees))


def speed(state: State, levels: int) -> State:
    """Go so many rungs up the speed ladder."""
    return replace(state, clock=state.clock.faster(state.frame, levels))


def direction(state: State, _: None) -> State:
    """Run the other way."""
    return replace(state, clock=state.clock.turn(state.frame))


def start(state: State, _: None) -> State:
    """Go back to the start."""
    return replace(state, clock=state.clock.go(state.frame, 0.0))


def scrub(state: State, phase: float) -> State:
    """Pause at a phase."""
    return replace(state, clock=state.clock.go(state.frame, phase, paused=True))
