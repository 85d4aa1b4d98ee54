"""Which sounds the motion makes from one frame to a later one: at dead centres, and at the input's limits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Literal

from linkanim.player.state.state import State
from linkanim.scenes.scene import Scene

Cue = Literal["tick", "tock", "limit", "right", "wrong"]
"""A tick is the forward dead centre, a tock the one back; so a quick return is a rhythm."""
_FARTHEST = 1.0
"""Radians of phase: what goes further at once has jumped, and passes nothing."""


def cues(before: State, after: State) -> tuple[Cue, ...]:
    """Return what is to be heard where the window goes from one state on to another; nothing while silent."""
    if not after.is_audible or before.scene is not after.scene:
        return ()
    return tuple(_passed(after.scene, before.phase, after.phase))


def _passed(scene: Scene, before: float, after: float) -> Iterator[Cue]:
    """Yield what lies between two phases; a phase belongs to the way that begins there."""
    if before == after or abs(after - before) > _FARTHEST:
        return
    if not scene.info.full_turn and _lies_between(before, after, 0.0, math.pi):
        yield "limit"
    moved = scene.info.swing
    back, forward = scene.info.dead_centres or (moved.dead_centres if moved else None) or (None, None)
    if forward is not None and _lies_between(before, after, forward, scene.period):
        yield "tick"
    if back is not None and _lies_between(before, after, back, scene.period):
        yield "tock"


def _lies_between(before: float, after: float, place: float, period: float) -> bool:
    """Whether a place, or that some periods on, lies between two phases."""
    return math.floor((before - place) / period) != math.floor((after - place) / period)
