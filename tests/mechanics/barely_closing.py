"""Dyads that close all along, and barely: their separation comes near a limit of theirs, and turns back.

The reference is plain geometry to many digits, as for `hard_cases`. Rates are measured beside those of both
closures of a dyad: on one side of the extreme its own all but cancel, and the last digit of a stated length
moves them by thousands of theirs.

`python tests/mechanics/barely_closing.py [COUNT]` prints the worst places and rates, by phase, by angle.
"""

from __future__ import annotations

import math
import random
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from hard_cases import (
    DIGITS,
    SIDES,
    Error,
    Guided,
    Loop,
    in_slot,
    meet,
    off,
    on_line,
    point_of_a_loop,
    radians,
)
from mpmath import mp, mpf
from reference import unit

from linkanim.errors import BadInput
from linkanim.mechanics.motion import Mechanism
from linkanim.mechanics.solver.input import Swing
from linkanim.scenes.reading import scene_from

Random = random.Random
GAPS = (-3.0, -12.0)
"""Powers of ten between which a gap lies, as a share of the dyad's length."""
WIDTHS = (0.0, 0.1, -0.5, 1.0, -2.0, 10.0)
"""Ways from the extreme in roots of the gap: about there what is left is some times the least."""
WAYS = (-0.02, 0.02, 0.1)
"""Others, in radians."""
SHARP = 0.1
CLEAR = 0.4
"""The least way from an extreme to the end of a swing."""


@dataclass(frozen=True)
class Barely:
    """A linkage whose dyad J barely closes at a phase of the drive, by a gap."""

    guided: Guided
    solved: Mechanism
    angle: Callable[[Any], Any]
    phase: float
    gap: float

    @property
    def phases(self) -> list[float]:
        """Phases beside the extreme."""
        return [self.phase + way for way in (*(width * math.sqrt(self.gap) for width in WIDTHS), *WAYS)]


@dataclass(frozen=True)
class Dyad:
    """A dyad on points C and S: what limits it, and itself, made for the least and the most of that."""

    seen: Callable[[Any, Any], Any]
    made: Callable[[float, float, float], tuple[dict[str, Any], float, Callable[[Any, Any, int], Any]]]
    far: bool


def stretched_bars(rng: Random, _: str) -> Dyad:
    """Return bars that C's greatest distance from S nearly stretches into one line."""
    side, share = rng.choice((1, -1)), rng.uniform(-0.4, 0.4)

    def made(least: float, most: float, gap: float) -> Any:
        length = most * (1 + gap)
        first = length / 2 + share * least
        return _bars((first, length - first), side)

    return Dyad(_distance, made, far=True)


def folded_bars(rng: Random, _: str) -> Dyad:
    """Return bars that C's least distance from S nearly folds into one line."""
    side, share = rng.choice((1, -1)), rng.uniform(0.6, 1.0)

    def made(least: float, most: float, gap: float) -> Any:
        return _bars((most * share, most * share + least * (1 - gap)), side)

    return Dyad(_distance, made, far=False)


def slider(rng: Random, tilt: str) -> Dyad:
    """Return a bar to a line, which C's greatest distance from the line nearly puts square to it."""
    offset, along = round(rng.uniform(-4, 4), 2), unit(radians(tilt))

    def made(_: float, most: float, gap: float) -> Any:
        bar = most * (1 + gap)
        line = {"through": "S", "angle": f"{tilt} deg", "offset": offset}
        joint = {"from": "C", "length": bar, "line": line, "side": "forward"}
        return joint, bar, lambda point, pin, root: on_line(point, pin, (bar, offset, tilt), root)

    return Dyad(lambda point, pin: abs(((point - pin) / along).imag - offset), made, far=True)


def slot(rng: Random, _: str) -> Dyad:
    """Return a slotted bar whose slot C nearly leaves, at its least distance from S."""
    bar = round(rng.uniform(2, 9), 2)

    def made(least: float, _: float, gap: float) -> Any:
        offset = least * (1 - gap)
        joint = {"slot": {"pivot": "S", "through": "C", "offset": offset}, "length": bar}
        return joint, bar, lambda point, pin, root: in_slot(point, pin, bar, offset, root)

    return Dyad(_distance, made, far=False)


def _bars(bars: tuple[float, float], side: int) -> Any:
    joint = {"from": ["C", "S"], "length": list(bars), "side": SIDES[side]}
    return joint, max(bars), lambda point, pin, root: meet(point, pin, bars, root * side)


def _distance(point: Any, pin: Any) -> Any:
    return abs(point - pin)


KINDS = (stretched_bars, folded_bars, slider, slot)


def dyads_that_barely_close(seed: int = 7) -> Iterator[Barely]:
    """Yield dyads behind a loop that come near their limit on the crank's turn, or on its way up.

    Left out are points C that come within half a bar of S, whose direction from there is as rounded as their
    place, extremes beside a limit of the crank, and what `_smooth` says.
    """
    rng = Random(seed)
    while True:
        loop, gap = point_of_a_loop(rng), 10 ** rng.uniform(*GAPS)
        pin, dyad = loop.pin(rng), rng.choice(KINDS)(rng, loop.tilt)
        base = _read(loop.document)
        found = base and _extreme(loop, base, pin, dyad)
        if not (base and found):
            continue
        phase, least, most = found
        joint, longest, close = dyad.made(least, most, gap)
        loop.document["joints"]["J"] = joint
        solved = _read(loop.document)
        if solved is not None and least > max(2.0, 0.5 * longest) and _smooth(base, solved):
            places = (_closed(loop, pin, close, root) for root in (1, -1))
            guided = Guided(loop.document, max(loop.longest, longest), *places)
            yield Barely(guided, solved, _angle(loop, solved), phase, gap)


def _smooth(base: Mechanism, solved: Mechanism) -> bool:
    """Tell whether J's extremes are no sharper than a tenth of a radian, and J stops the crank nowhere.

    Of a sharper one a polynomial holds for less: beyond, the margin's own digits are all there are. A swing
    that is back after two periods only has its extremes by half the phase, whose digits an angle lacks.
    """
    if solved.periods > 1 or solved.assembly.path != base.assembly.path:
        return False
    dips = solved.assembly.chain["J"].near_touches
    return all(dip.near is None or 2 * dip.near.root.width > SHARP for dip in dips)


def _closed(loop: Loop, pin: Any, close: Callable[[Any, Any, int], Any], root: int) -> Callable[[Any], Any]:
    return lambda angle: close(loop.place(angle), pin, root)


def _read(document: dict[str, Any]) -> Mechanism | None:
    try:
        return scene_from(document, name="bars", where="bars").mechanism
    except BadInput:
        return None


def _extreme(loop: Loop, base: Mechanism, pin: Any, dyad: Dyad) -> tuple[float, float, float] | None:
    """Return the phase at which a separation is extreme, and its least and greatest; None beside an end."""
    swings = isinstance(base.assembly.path, Swing)
    turn = np.linspace(0.0, math.pi if swings else 2 * math.pi, 121)
    points = base.solve(phase=turn, speed=1.0, derivatives=0).position["C"] @ (1, 1j)
    way = np.array([float(dyad.seen(mp.mpc(point), pin)) for point in points.tolist()])
    sign = 1 if dyad.far else -1
    near = float(turn[(sign * way).argmax()])
    if swings and not CLEAR < near < math.pi - CLEAR:
        return None
    angle = _angle(loop, base)

    def seen(phase: Any) -> Any:
        return dyad.seen(loop.place(angle(phase)), pin)

    try:
        with mp.workdps(40):
            phase = mp.findroot(lambda phase: mp.diff(seen, phase), mpf(near), tol=mpf(10) ** -30)
            best = float(seen(phase))
    except ValueError:
        return None
    ends = float(way.min()), float(way.max())
    return (float(phase), ends[0], best) if dyad.far else (float(phase), best, ends[1])


def _angle(loop: Loop, solved: Mechanism) -> Callable[[Any], Any]:
    """Return the crank's angle as a function of the phase."""
    path = solved.assembly.path
    if isinstance(path, Swing):
        low, high = (mpf(end.high) + mpf(end.low) for end in (path.low, path.high))
        return lambda phase: (low + high) / 2 - (high - low) / 2 * mp.cos(phase)
    start = radians(loop.document["drive"]["start"].split()[0])
    return lambda phase: start + phase


def by_phase(case: Barely) -> Error:
    """Return how far the motion by phase is off beside the extreme."""
    place, other, angle = case.guided.place, case.guided.other, case.angle
    assert other
    guided = replace(
        case.guided, place=lambda phase: place(angle(phase)), other=lambda phase: other(angle(phase))
    )
    return off(guided, case.solved.solve(phase=np.array(case.phases), speed=1.0), case.phases)


def by_angle(case: Barely) -> Error:
    """Return how far the motion by angle is off there."""
    angles = [float(case.angle(mpf(phase))) for phase in case.phases]
    return off(case.guided, case.solved.solve(angle=np.array(angles), speed=1.0), angles)


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    worst: dict[int, list[float]] = {}
    with mp.workdps(DIGITS):
        for case, _ in zip(dyads_that_barely_close(), range(count), strict=False):
            errors, power = (*by_phase(case), *by_angle(case)), math.floor(math.log10(case.gap))
            worst[power] = list(map(max, errors, worst.get(power, errors)))
    for power, found in sorted(worst.items(), reverse=True):
        print(f"1e{power:+03d}", *(f"{error:8.1f}" for error in found))
