"""Random dyads that stop their crank, as scene files state them, and how far their motion is off.

The reference is plain geometry to many digits: circles cross, and rates solve the bars' two equations. A
tilt is that of its decimal degrees, and pins lie where their coordinates say.

`python tests/mechanics/hard_cases.py [COUNT]` prints the worst of each kind, in last digits.
"""

from __future__ import annotations

import math
import random
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar

import numpy as np
from mpmath import mp, mpf
from reference import HIGHEST_FIRST, derivatives, sign_of, unit

from linkanim.bench.reference import crossing
from linkanim.errors import BadInput
from linkanim.mechanics.drive.swing import Swing
from linkanim.mechanics.motion.mechanism import Mechanism
from linkanim.scenes.reading.read import scene_from

Random = random.Random
DIGITS = 110
"""At a limit the circles touch: poses 1e-25 from there lose most of them."""
EPS = 2.0**-52
NUDGE = mpf(10) ** -25
PHASES = (0.0, 1e-9, 1e-5, math.pi, math.pi - 1e-7, math.pi / 2, 1.2, 4.0, 5.5)
SHARES = (0.3, 0.01, 1e-4, 1e-6, 1e-8)
"""Distances from a limit, as shares of the swing."""


@dataclass(frozen=True)
class Bars:
    """A crank on `pivot`, and bars (coupler, rocker) from its pin and from `other`, which meet in J."""

    document: dict[str, Any]
    pivot: Any
    other: Any
    crank: float
    bars: tuple[float, float]
    side: int


@dataclass(frozen=True)
class Guided:
    """A bar to a slider, or a slotted bar, on the crank's pin: J at an angle, NaN where it cannot close."""

    document: dict[str, Any]
    longest: float
    place: Callable[[Any], Any]


class Error(NamedTuple):
    """How far positions are off, in longest bars, and rates, in their greatest or in longest bars."""

    position: float
    rate: float


def near_a_toggle(rng: Random) -> Bars:
    """Return bars that a swing, or what it lacks of a turn, of 1e-6 or more is left to.

    Of every fourth the ground is nearly as long as the crank, so that the pins of both bars nearly meet.
    Left out are bars of a thousandth of the others.
    """
    g, r, a = (rng.uniform(1, 10) for _ in range(3))
    if rng.random() < 0.25:
        r = g * (1 + rng.choice((-1, 1)) * 10 ** rng.uniform(-3, -1))
    gap = rng.choice((-1, 1)) * 10 ** rng.uniform(-11, 0)
    rocker = abs(rng.choice((g + r - a, abs(g - r) + a, g + r + a)) + gap)
    if rocker < 1:
        return near_a_toggle(rng)
    return _bars(rng, (g, "0"), r, a, rocker)


def driven_at_its_crank_on_tilted_ground(rng: Random) -> Bars:
    """Return bars on ground at an angle of up to twelve decimals of a degree."""
    return _on_tilted_ground(rng, rocker=False)


def driven_at_its_rocker_on_tilted_ground(rng: Random) -> Bars:
    """Return the same with the drive at the other end of the ground."""
    return _on_tilted_ground(rng, rocker=True)


def on_pins_given_by_coordinates(rng: Random) -> Bars:
    """Return bars whose ground is no length, but two points."""
    _, r, a, b = _lengths(rng)
    at = [[round(rng.uniform(-9, 9), 2) for _ in "xy"] for _ in range(2)]
    return _bars(rng, None, r, a, b, at=at) if math.dist(*at) > 0.5 else on_pins_given_by_coordinates(rng)


Make = Callable[[Random], Bars]
Some = TypeVar("Some", Bars, Guided)
KINDS: tuple[Make, ...] = (
    near_a_toggle,
    driven_at_its_crank_on_tilted_ground,
    driven_at_its_rocker_on_tilted_ground,
    on_pins_given_by_coordinates,
)


def slider_on_a_tilted_line(rng: Random) -> Guided:
    """Return a bar from the crank's pin to a line at an angle of degrees, all pins given by coordinates."""
    r, b, offset = round(rng.uniform(2, 9), 3), round(rng.uniform(1, 9), 3), round(rng.uniform(-4, 4), 2)
    tilt, pins = f"{rng.uniform(-180, 180):.3f}", _pins(rng)
    line = {"through": "O4", "angle": f"{tilt} deg", "offset": offset}
    joint = {"from": "A", "length": b, "line": line, "side": "forward"}
    with mp.workdps(DIGITS):
        start, base = (mp.mpc(*map(mpf, at)) for at in pins)
        along = unit(mpf(tilt) * mp.pi / 180)

    def place(angle: Any) -> Any:
        end = (start + mpf(r) * unit(angle) - base) / along
        square = mpf(b) ** 2 - (end.imag - mpf(offset)) ** 2
        return base + along * mp.mpc(end.real + mp.sqrt(square), mpf(offset)) if square > 0 else mp.nan

    return Guided(_document(rng, pins, r, joint), max(r, b), place)


def slot_beside_its_pivot(rng: Random) -> Guided:
    """Return a bar whose slot the crank's pin runs in, all pins given by coordinates."""
    r, b, offset = round(rng.uniform(2, 9), 3), round(rng.uniform(2, 9), 2), round(rng.uniform(1, 6), 2)
    pins = _pins(rng)
    joint = {"slot": {"pivot": "O4", "through": "A", "offset": offset}, "length": b}
    with mp.workdps(DIGITS):
        start, base = (mp.mpc(*map(mpf, at)) for at in pins)

    def place(angle: Any) -> Any:
        way = start + mpf(r) * unit(angle) - base
        square = abs(way) ** 2 - mpf(offset) ** 2
        return base + mpf(b) * way / mp.mpc(mp.sqrt(square), mpf(offset)) if square > 0 else mp.nan

    return Guided(_document(rng, pins, r, joint), max(r, b), place)


GUIDED: tuple[Callable[[Random], Guided], ...] = (slider_on_a_tilted_line, slot_beside_its_pivot)


def _pins(rng: Random) -> list[list[float]]:
    return [[round(rng.uniform(-5, 5), 2) for _ in "xy"] for _ in range(2)]


def _document(rng: Random, pins: list[list[float]], crank: float, joint: dict[str, Any]) -> dict[str, Any]:
    return {
        "drive": {"joint": "A", "start": f"{rng.uniform(0, 360):.1f} deg"},
        "ground": dict(zip(("O2", "O4"), pins, strict=True)),
        "joints": {"A": {"crank": "O2", "length": crank}, "J": joint},
    }


def _on_tilted_ground(rng: Random, *, rocker: bool) -> Bars:
    g, r, a, b = _lengths(rng)
    tilt = f"{rng.uniform(-180, 180):.{rng.choice((0, 1, 2, 5, 12))}f}"
    return _bars(rng, (g, tilt), r, a, b, rocker=rocker)


def _lengths(rng: Random) -> tuple[float, ...]:
    return tuple(round(rng.uniform(1, 10), 3) for _ in range(4))


def _bars(
    rng: Random,
    ground: tuple[float, str] | None,
    *lengths: float,
    at: list[list[float]] | None = None,
    rocker: bool = False,
) -> Bars:
    """Return the bars on the ground (length, degrees), or on two points."""
    side, (r, a, b) = rng.choice((1, -1)), lengths
    if ground is not None:
        pins: dict[str, Any] = {"O2": [0, 0], "O4": {"length": ground[0], "angle": f"{ground[1]} deg"}}
        with mp.workdps(DIGITS):
            ends = mp.mpc(0), mpf(ground[0]) * unit(mpf(ground[1]) * mp.pi / 180)
    else:
        assert at is not None
        pins = dict(zip(("O2", "O4"), at, strict=True))
        ends = mp.mpc(*map(mpf, at[0])), mp.mpc(*map(mpf, at[1]))
    pivot, other = ("O4", "O2") if rocker else ("O2", "O4")
    joint = {"from": ["A", other], "length": [a, b], "side": "left" if side == 1 else "right"}
    document = {
        "drive": {"joint": "A", "start": f"{rng.uniform(0, 360):.1f} deg"},
        "ground": pins,
        "joints": {"A": {"crank": pivot, "length": r}, "J": joint},
    }
    ends = ends[::-1] if rocker else ends
    return Bars(document, *ends, r, (a, b), side)


class _Exact:
    """The bars' swing and poses, angles from the ground line."""

    def __init__(self, bars: Bars, path: Swing) -> None:
        self.way = bars.other - bars.pivot
        self.tilt = mp.arg(self.way)
        self.sizes = (abs(self.way), *map(mpf, (bars.crank, *bars.bars)))
        self.side = bars.side
        g, r, a, b = self.sizes
        least = mpf(2) ** -53 * sum(self.sizes)
        gaps = (a + b - g - r, g - r - a + b, g - r + a - b)
        self.outer, first, second = (gap if abs(gap) > least else mpf(0) for gap in gaps)
        self.inner = first * second
        middle = (path.low + path.high).times(0.5)
        turns = mp.nint((mpf(float(middle)) - self.tilt) / mp.pi) / 2
        self.low, self.high = self._range(float(middle) - float(self.tilt))
        assert abs(float(self.low + self.tilt) - float(path.low)) < 1e-9, turns
        self.start = self.sign(self.low + mpf(10) ** -9)

    def _range(self, near: float) -> tuple[Any, Any]:
        """The range of the crank that lies around an angle."""
        g, r, a, b = self.sizes
        far = mp.acos((g * g + r * r - (a + b) ** 2) / (2 * g * r)) if self.outer < 0 else None
        short = mp.acos((g * g + r * r - (a - b) ** 2) / (2 * g * r)) if self.inner < 0 else None
        if far is not None and short is not None:
            ranges = [(short, far), (-far, -short)]
        else:
            ranges = [(-far, far)] if far is not None else [(short, 2 * mp.pi - short)]
        moved = [(a + 2 * mp.pi * n, b + 2 * mp.pi * n) for a, b in ranges for n in range(-2, 3)]
        return min(moved, key=lambda ends: abs(float(sum(ends)) / 2 - near))

    def sign(self, psi: Any) -> int:
        """The sign that change points within the swing give the closure."""
        sign = sign_of(mp.cos(psi / 2)) if self.outer == 0 else 1
        return sign * (sign_of(mp.sin(psi / 2)) if self.inner == 0 else 1)

    def by_phase(self, phase: Any) -> list[tuple[Any, Any]]:
        """Place and rates of the crank's pin and of J at a phase."""
        reach = (self.high - self.low) / 2
        psi = (self.low + self.high) / 2 - reach * mp.cos(phase)
        side = sign_of(mp.sin(phase)) * self.sign(psi) * self.start
        return self._rates(psi, (reach * mp.sin(phase), reach * mp.cos(phase)), side)

    def by_angle(self, angle: Any) -> list[tuple[Any, Any]]:
        """The same at an angle of the crank."""
        psi = angle - self.tilt
        return self._rates(psi, (mpf(1), mpf(0)), self.sign(psi) * self.start)

    def _rates(self, psi: Any, pace: tuple[Any, Any], sign: int) -> list[tuple[Any, Any]]:
        g, r, a, b = self.sizes
        pin, (w, alpha) = r * unit(psi), pace
        joint = crossing(pin, mp.mpc(g), a, b, sign * self.side)
        pin_rate, pin_second = pin * mp.mpc(0, w), pin * mp.mpc(-w * w, alpha)
        one, other = joint - pin, joint - g
        rate = _meeting((one, other), (_dot(one, pin_rate), 0))
        second = _meeting(
            (one, other), (_dot(one, pin_second) - abs(rate - pin_rate) ** 2, -(abs(rate) ** 2))
        )
        along = self.way / g
        return [
            (pin * along, joint * along),
            (pin_rate * along, rate * along),
            (pin_second * along, second * along),
        ]


def _dot(a: Any, b: Any) -> Any:
    return a.real * b.real + a.imag * b.imag


def _meeting(ways: tuple[Any, Any], parts: tuple[Any, Any]) -> Any:
    """The vector whose scalar products with two ways are known."""
    (a, b), (p, q) = ways, parts
    size = a.real * b.imag - a.imag * b.real
    return mp.mpc((p * b.imag - q * a.imag) / size, (q * a.real - p * b.real) / size)


def swinging(make: Callable[[Random], Some], seed: int = 7) -> Iterator[tuple[Some, Mechanism]]:
    """Yield linkages that go together and stop the crank."""
    rng = Random(seed)
    while True:
        bars = make(rng)
        try:
            solved = scene_from(bars.document, name="bars", where="bars").mechanism
        except BadInput:
            continue
        if isinstance(solved.assembly.path, Swing):
            yield bars, solved


def by_phase(bars: Bars, solved: Mechanism) -> Error:
    """Return how far the motion by phase is off; rates in their greatest over the cycle."""
    assert isinstance(solved.assembly.path, Swing)
    exact = _Exact(bars, solved.assembly.path)
    motion = solved.solve(phase=np.array(PHASES), speed=1.0)
    cycle = solved.solve(phase=np.linspace(0, 2 * math.pi, 801), speed=1.0)
    found = [exact.by_phase(mpf(phase) + NUDGE) for phase in PHASES]
    errors = [float(max(exact.sizes)), 0.0, 0.0]
    for order, kind in HIGHEST_FIRST:
        worst = 0.0
        for joint, name in enumerate("AJ"):
            size = float(max(exact.sizes)) if not order else _greatest(getattr(cycle, kind)[name])
            reference = [(one[order][joint] + (order == 0) * bars.pivot, size) for one in found]
            worst = max(worst, _worst(getattr(motion, kind)[name], reference))
        errors[order] = worst
    return Error(errors[0], max(errors[1:]))


def by_angle(bars: Bars, solved: Mechanism) -> Error:
    """Return how far the motion by angle is off near the limits; rates in themselves, or in longest bars."""
    path = solved.assembly.path
    assert isinstance(path, Swing)
    exact, angles = _Exact(bars, path), _angles(path)
    motion = solved.solve(angle=np.array(angles), speed=1.0)
    found, longest, errors = [exact.by_angle(mpf(angle)) for angle in angles], float(max(exact.sizes)), []
    for order, kind in HIGHEST_FIRST:
        reference = [
            (
                one[order][1] + (order == 0) * bars.pivot,
                max(longest, float(abs(one[order][1])) if order else 0.0),
            )
            for one in found
        ]
        errors.append(_worst(getattr(motion, kind)["J"], reference))
    return Error(errors[-1], max(errors[:-1]))


def guided_by_angle(guided: Guided, solved: Mechanism) -> Error:
    """Return the same of a bar to a slider, or of a slotted bar."""
    path = solved.assembly.path
    assert isinstance(path, Swing)
    angles = [angle for angle in _angles(path) if not mp.isnan(guided.place(mpf(angle)))]
    motion = solved.solve(angle=np.array(angles), speed=1.0)
    found = [derivatives(lambda angle: {"J": guided.place(angle)}, mpf(angle)) for angle in angles]
    errors = []
    for order, kind in HIGHEST_FIRST:
        true = [one[order]["J"] for one in found]
        sizes = [max(guided.longest, float(abs(one)) if order else 0.0) for one in true]
        errors.append(_worst(getattr(motion, kind)["J"], list(zip(true, sizes, strict=True))))
    return Error(errors[-1], max(errors[:-1]))


def _angles(path: Swing) -> list[float]:
    """Return angles of a swing up to its limits; the float nearest a limit stands for it."""
    low, high = path.input_range
    near = 16 * np.spacing(max(abs(low), abs(high)))
    angles = [end + way * share * (high - low) for end, way in ((low, 1), (high, -1)) for share in SHARES]
    return [angle for angle in angles if min(angle - low, high - angle) > near]


def _worst(values: Any, reference: list[tuple[Any, float]]) -> float:
    """The greatest error of vectors in last digits of their sizes; infinite where one is not finite."""
    return max(
        float(abs(mp.mpc(x, y) - true)) / size / EPS if math.isfinite(x + y) else math.inf
        for (x, y), (true, size) in zip(values.tolist(), reference, strict=True)
    )


def _greatest(vectors: Any) -> float:
    return float(np.hypot(*vectors.T).max())


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    with mp.workdps(DIGITS):
        for kind in KINDS:
            if sys.argv[2:] and kind.__name__ not in sys.argv[2:]:
                continue
            stream = swinging(kind)
            for name, errors in (("phase", by_phase), ("angle", by_angle)):
                rows = [(errors(*one), one[0]) for one, _ in zip(stream, range(count), strict=False)]
                position, rate = (max(row[0][part] for row in rows) for part in (0, 1))
                print(f"{kind.__name__:40} by {name} {position:9.1f} {rate:9.1f}", flush=True)
                for row in sorted(rows, key=lambda row: -row[0].rate)[:3]:
                    if row[0].rate > 64:
                        print("    ", row[0], row[1].document["ground"], row[1].document["joints"])
