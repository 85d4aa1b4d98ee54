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
from linkanim.mechanics.measures import transmission_angle
from linkanim.mechanics.motion import Mechanism, Motion
from linkanim.mechanics.solver.input import Swing
from linkanim.scenes.reading import scene_from

Random = random.Random
DIGITS = 110
"""At a limit the circles touch: poses 1e-25 from there lose most of them."""
EPS = 2.0**-52
NUDGE = mpf(10) ** -25
"""The phase that stands for 0, a limit, at which the circles touch.

No other one is moved: where two pins nearly meet, a bar turns 1e13 times as fast as the input.
"""
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
    """A bar to a slider, or a slotted bar, on the crank's pin: J at an angle, NaN where it cannot close.

    If `other` is given it is J on its other closure. What J's rates are made of is half the sum and half the
    difference of both, and as large as the larger one, also where J's own cancel.
    """

    document: dict[str, Any]
    longest: float
    place: Callable[[Any], Any]
    other: Callable[[Any], Any] | None = None


class Error(NamedTuple):
    """How far positions are off, in longest bars, and rates, in their greatest or in longest bars."""

    position: float
    rate: float


SIDES = {1: "left", -1: "right"}


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
    return placed(rng, (g, "0"), r, a, rocker)


def nearly_a_kite(rng: Random) -> Bars:
    """Return bars whose pins come within 1e-12 to 1e-6 of each other in the middle of the swing."""
    g, a = rng.uniform(1, 10), rng.uniform(1, 10)
    r, b = (size + rng.choice((-1, 1)) * 10 ** rng.uniform(-12, -6) for size in (g, a))
    return placed(rng, (g, "0"), r, a, b)


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
    return placed(rng, None, r, a, b, at=at) if math.dist(*at) > 0.5 else on_pins_given_by_coordinates(rng)


Make = Callable[[Random], Bars]
Some = TypeVar("Some", Bars, Guided)
KINDS: tuple[Make, ...] = (
    near_a_toggle,
    nearly_a_kite,
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

    def place(angle: Any) -> Any:
        return on_line(start + mpf(r) * unit(angle), base, (b, offset, tilt))

    return Guided(_document(rng, pins, r, joint), max(r, b), place)


def slot_beside_its_pivot(rng: Random) -> Guided:
    """Return a bar whose slot the crank's pin runs in, all pins given by coordinates."""
    r, b, offset = round(rng.uniform(2, 9), 3), round(rng.uniform(2, 9), 2), round(rng.uniform(1, 6), 2)
    pins = _pins(rng)
    joint = {"slot": {"pivot": "O4", "through": "A", "offset": offset}, "length": b}
    with mp.workdps(DIGITS):
        start, base = (mp.mpc(*map(mpf, at)) for at in pins)

    def place(angle: Any) -> Any:
        return in_slot(start + mpf(r) * unit(angle), base, b, offset)

    return Guided(_document(rng, pins, r, joint), max(r, b), place)


def dyad_behind_a_loop(rng: Random) -> Guided:
    """Return bars, a bar to a slider or a slotted bar on a point of a four-bar's coupler, or rocker.

    The four-bar's ground is a length at an angle of degrees, or two points. Left out are those near a change
    point, which are another kind.
    """
    loop = point_of_a_loop(rng)
    joint, longest, close = rng.choice((_bars_on, _slider_on, _slot_on))(rng, loop.tilt)
    loop.document["joints"]["J"] = joint
    pin = loop.pin(rng)
    return Guided(loop.document, max(loop.longest, longest), lambda angle: close(loop.place(angle), pin))


@dataclass(frozen=True)
class Loop:
    """A four-bar with a point C of its coupler, or rocker, and an angle in degrees."""

    document: dict[str, Any]
    longest: float
    place: Callable[[Any], Any]
    tilt: str

    def pin(self, rng: Random) -> Any:
        """Add a pin S, and return where it lies."""
        self.document["ground"]["S"] = [round(rng.uniform(-9, 9), 2) for _ in "xy"]
        return mp.mpc(*map(mpf, self.document["ground"]["S"]))


def point_of_a_loop(rng: Random) -> Loop:
    pins, ends, tilt = _tilted_ground(rng)
    r, a, b = (round(rng.uniform(2, 9), 3) for _ in range(3))
    g = float(abs(ends[1] - ends[0]))
    if min(abs(g - r - a + b), abs(g - r + a - b), abs(a + b - g - r)) < 0.01:
        return point_of_a_loop(rng)
    at = [round(rng.uniform(-6, 6), 2) for _ in "xy"]
    on, second = rng.choice(("AB", "BA", ("B", "O4"), ("O4", "B"))), rng.choice((1, -1))
    document = _document(rng, pins, r, {"from": ["A", "O4"], "length": [a, b], "side": SIDES[second]})
    document["joints"]["B"] = document["joints"].pop("J")
    document["joints"]["C"] = {"on": list(on), "at": at}

    def place(angle: Any) -> Any:
        start = ends[0] + mpf(r) * unit(angle)
        found = {"A": start, "O4": ends[1], "B": meet(start, ends[1], (a, b), second)}
        along = found[on[1]] - found[on[0]]
        return found[on[0]] + mp.mpc(*map(mpf, at)) * along / abs(along)

    return Loop(document, max(r, a, b), place, tilt)


def _tilted_ground(rng: Random) -> tuple[list[Any], tuple[Any, Any], str]:
    """Return pins O2 and O4 as they are written, where they lie, and an angle in degrees."""
    tilt = f"{rng.uniform(-180, 180):.3f}"
    first, second = _pins(rng)
    if rng.random() < 0.5:
        ends = mp.mpc(*map(mpf, first)), mp.mpc(*map(mpf, second))
        return [first, second], ends, tilt
    ground = round(rng.uniform(2, 9), 3)
    polar = {"length": ground, "angle": f"{tilt} deg"}
    return [[0, 0], polar], (mp.mpc(0), mpf(ground) * unit(radians(tilt))), tilt


Closing = tuple[dict[str, Any], float, Callable[[Any, Any], Any]]


def _bars_on(rng: Random, tilt: str) -> Closing:
    """Return bars from C and S to J as they are written, the longer one, and where J lies.

    Left out are bars so alike that C may come within an eighth of them to S: folded over each other they
    magnify by so much what C is rounded by, two last digits.
    """
    bars, side = [round(rng.uniform(2, 12), 3) for _ in range(2)], rng.choice((1, -1))
    if abs(bars[0] - bars[1]) < max(bars) / 8:
        return _bars_on(rng, tilt)
    joint = {"from": ["C", "S"], "length": bars, "side": SIDES[side]}
    return joint, max(bars), lambda point, pin: meet(point, pin, (bars[0], bars[1]), side)


def _slider_on(rng: Random, tilt: str) -> Closing:
    """Return the same of a bar from C to a line through S."""
    bar, offset = round(rng.uniform(2, 12), 3), round(rng.uniform(-4, 4), 2)
    line = {"through": "S", "angle": f"{tilt} deg", "offset": offset}
    joint = {"from": "C", "length": bar, "line": line, "side": "forward"}
    return joint, bar, lambda point, pin: on_line(point, pin, (bar, offset, tilt))


def _slot_on(rng: Random, _: str) -> Closing:
    """Return the same of a bar about S whose slot runs over C."""
    bar, offset = round(rng.uniform(2, 9), 2), round(rng.uniform(2, 6), 2)
    joint = {"slot": {"pivot": "S", "through": "C", "offset": offset}, "length": bar}
    return joint, bar, lambda point, pin: in_slot(point, pin, bar, offset)


def meet(p: Any, q: Any, bars: tuple[float, float], side: int) -> Any:
    """Return where two bars meet, NaN where they do not."""
    way, (a, b) = abs(q - p), map(mpf, bars)
    return crossing(p, q, a, b, side) if abs(a - b) < way < a + b else mp.mpc(mp.nan)


def on_line(point: Any, base: Any, slider: tuple[float, float, str], root: int = 1) -> Any:
    """Return where a bar, its offset and its line's tilt put a slider, NaN where it does not reach."""
    bar, offset, tilt = slider
    along = unit(radians(tilt))
    end = (point - base) / along
    square = mpf(bar) ** 2 - (end.imag - mpf(offset)) ** 2
    return (
        base + along * mp.mpc(end.real + root * mp.sqrt(square), mpf(offset))
        if square > 0
        else mp.mpc(mp.nan)
    )


def in_slot(point: Any, base: Any, bar: float, offset: float, root: int = 1) -> Any:
    """Return the end of a slotted bar, NaN where the slot does not reach."""
    way = point - base
    square = abs(way) ** 2 - mpf(offset) ** 2
    return (
        base + mpf(bar) * way / mp.mpc(root * mp.sqrt(square), mpf(offset)) if square > 0 else mp.mpc(mp.nan)
    )


def radians(degrees: str) -> Any:
    return mpf(degrees) * mp.pi / 180


GUIDED: tuple[Callable[[Random], Guided], ...] = (
    slider_on_a_tilted_line,
    slot_beside_its_pivot,
    dyad_behind_a_loop,
)


def _pins(rng: Random) -> list[list[float]]:
    return [[round(rng.uniform(-5, 5), 2) for _ in "xy"] for _ in range(2)]


def _document(rng: Random, pins: list[Any], crank: float, joint: dict[str, Any]) -> dict[str, Any]:
    return {
        "drive": {"joint": "A", "start": f"{rng.uniform(0, 360):.1f} deg"},
        "ground": dict(zip(("O2", "O4"), pins, strict=True)),
        "joints": {"A": {"crank": "O2", "length": crank}, "J": joint},
    }


def _on_tilted_ground(rng: Random, *, rocker: bool) -> Bars:
    g, r, a, b = _lengths(rng)
    tilt = f"{rng.uniform(-180, 180):.{rng.choice((0, 1, 2, 5, 12))}f}"
    return placed(rng, (g, tilt), r, a, b, rocker=rocker)


def _lengths(rng: Random) -> tuple[float, ...]:
    return tuple(round(rng.uniform(1, 10), 3) for _ in range(4))


def placed(
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
    joint = {"from": ["A", other], "length": [a, b], "side": SIDES[side]}
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


def clear(solved: Mechanism) -> bool:
    """Tell whether a swing ends at limits only, and each dyad keeps three degrees from those that are none.

    Floats keep less there: of a distance that is rounded, and of two limits within a degree.
    """
    path = solved.assembly.path
    turn = np.linspace(0.0, math.pi, 721)
    motion = solved.solve(phase=turn, speed=1.0, derivatives=0)
    lean = {dyad: np.degrees(transmission_angle(motion, dyad)) for dyad in "BJ"}
    away = [
        float(lean[dyad][(turn if end == 0 else math.pi - turn) < math.pi / 2].min())
        for end, name in enumerate(path.ends)
        for dyad in "BJ"
        if dyad != name
    ]
    return path.way is None and min(away, default=90.0) > 3.0


def swinging(make: Callable[[Random], Some], seed: int = 7) -> Iterator[tuple[Some, Mechanism]]:
    """Yield linkages that go together and stop the crank."""
    rng = Random(seed)
    while True:
        bars = make(rng)
        try:
            solved = scene_from(bars.document, name="bars", where="bars").mechanism
        except BadInput:
            continue
        if isinstance(solved.assembly.path, Swing) and (make is not dyad_behind_a_loop or clear(solved)):
            yield bars, solved


def by_phase(bars: Bars, solved: Mechanism) -> Error:
    """Return how far the motion by phase is off; rates in their greatest over the cycle."""
    assert isinstance(solved.assembly.path, Swing)
    exact = _Exact(bars, solved.assembly.path)
    motion = solved.solve(phase=np.array(PHASES), speed=1.0)
    cycle = solved.solve(phase=np.linspace(0, 2 * math.pi, 801), speed=1.0)
    found = [exact.by_phase(mpf(phase) or NUDGE) for phase in PHASES]
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
    """Return the same of other dyads, rates beside those of all joints: J's are made of the others'."""
    path = solved.assembly.path
    assert isinstance(path, Swing)
    angles = [angle for angle in _angles(path) if not mp.isnan(guided.place(mpf(angle)))]
    return off(guided, solved.solve(angle=np.array(angles), speed=1.0), angles)


def off(guided: Guided, motion: Motion, places: list[float]) -> Error:
    """Return how far a motion is off at places of the input."""
    found = [_rates_of(guided.place, place) for place in places]
    others = [_rates_of(guided.other, place) for place in places] if guided.other else []
    errors = []
    for order, kind in HIGHEST_FIRST:
        true = [one[order]["J"] for one in found]
        rates = np.max([np.hypot(*values.T) for values in getattr(motion, kind).values()], axis=0)
        if others:
            rates = np.maximum(rates, [float(abs(one[order]["J"])) for one in others])
        sizes = np.maximum(guided.longest, rates * (order > 0)).tolist()
        errors.append(_worst(getattr(motion, kind)["J"], list(zip(true, sizes, strict=True))))
    return Error(errors[-1], max(errors[:-1]))


def _rates_of(closed: Callable[[Any], Any], place: float) -> Any:
    return derivatives(lambda at: {"J": closed(at)}, mpf(place))


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
