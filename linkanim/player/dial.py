"""The dial of the pencil: from the most exact answer along the front to the most compact one.

The search gives answers along the front, each somewhat like its neighbours. Between two answers of one family
the linkage changes gradually; from family to family it changes at once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from linkanim.player.edits import exchanged
from linkanim.player.sketching import ready
from linkanim.player.state import DIAL, PathSketch, State
from linkanim.scenes.scene import Scene

if TYPE_CHECKING:
    from linkanim.synthesis.answers import PathAnswer

_FAMILY = 0.15
"""Answers whose lengths and pivots differ by no more than this, in longest links, are of one family."""


def answer_at(way: Sequence[PathAnswer], share: float) -> PathAnswer:
    """Return the answer at a share of the front, 0 to 1; between two of one family it is interpolated."""
    place = min(max(share, 0.0), 1.0) * (len(way) - 1)
    first = min(int(place), max(len(way) - 2, 0))
    one, other, part = way[first], way[min(first + 1, len(way) - 1)], place - first
    if not 0 < part < 1 or not _of_one_family(one, other):
        return one if part < 0.5 else other
    row = tuple(mine + part * (its - mine) for mine, its in zip(one.row, other.row, strict=True))
    off, size, angle = (
        mine + part * (its - mine)
        for mine, its in ((one.off, other.off), (one.size, other.size), (one.angle, other.angle))
    )
    start = one.start + part * math.remainder(other.start - one.start, 2 * math.pi)
    return one._replace(off=off, start=start, row=row, size=size, angle=angle)


def _of_one_family(one: PathAnswer, other: PathAnswer) -> bool:
    """Return whether two answers are alike enough for linkages between them to be shown."""
    longest = max(map(abs, (*one.row[2:6], one.row[8])))
    near = all(abs(mine - its) <= _FAMILY * longest for mine, its in zip(one.row, other.row, strict=True))
    turned = abs(math.remainder(other.start - one.start, 2 * math.pi))
    return near and turned < math.pi / 2 and (one.closure, one.sense) == (other.closure, other.sense)


def place_of(sketch: PathSketch) -> float:
    """Return where the knob stands: where it was put, else at the answer most like the one shown."""
    if sketch.dial is not None:
        return sketch.dial
    answer, way = sketch.answer, sketch.way
    if len(way) < 2 or answer is None or isinstance(answer, Scene):
        return 0.0
    off, row = answer.off, answer.row
    # a cognate of an answer has other lengths, but the same deviation
    near = min(range(len(way)), key=lambda n: (way[n].off != off, math.dist(way[n].row, row)))
    return near / (len(way) - 1)


def dial(state: State, share: float) -> State:
    """Put the knob at a share of its range, 0 to 1, and show the answer there."""
    sketch = state.drawing
    if sketch is None or not sketch.way or sketch.held not in (None, DIAL):
        return state
    base, earlier = (sketch.base, sketch.earlier) if sketch.held else (state.scene, sketch)
    answer = answer_at(sketch.way, share)
    last = sketch.answer
    if last is None or isinstance(last, Scene) or not _of_one_family(last, answer):
        base = answer.scene(sketch.unit)
        state = replace(exchanged(state, base), faded=state.frame)
    coming = ready(answer.scene(sketch.unit, base), state.phase)
    sketch = replace(sketch, dial=share, dialled=answer, held=DIAL, base=base, earlier=earlier, coming=coming)
    return replace(state.with_mode(sketch), glide=None)


def dial_on(state: State, steps: int) -> State:
    """Move the knob by `steps` answers towards the compact end."""
    sketch = state.drawing
    if sketch is None or len(sketch.way) < 2 or sketch.held is not None:
        return state
    last = len(sketch.way) - 1
    return dialled(dial(state, min(max(round(place_of(sketch) * last) + steps, 0), last) / last))


def dialled(state: State) -> State:
    """Release the knob: it goes to the nearest answer, whose figures are the solver's."""
    sketch = state.drawing
    if sketch is None or sketch.held != DIAL or sketch.dial is None:
        return state
    last = max(len(sketch.way) - 1, 1)
    share = round(sketch.dial * last) / last
    answer = answer_at(sketch.way, share)
    bare = replace(sketch, held=None, base=None, coming=None, dial=share, dialled=answer)
    return exchanged(state.with_mode(bare), answer.scene(sketch.unit))
