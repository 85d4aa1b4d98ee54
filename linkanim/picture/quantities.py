"""A scene's quantities over one true period, the axis they are shown over, and axes with few round ticks.

Quantities are shown over the driven bar's angle, time, or phase. The words for the input and for its speed
are here, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from math import ceil, degrees, floor, log10, pi, radians, tau
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.errors import UnitError
from linkanim.frozen import frozen
from linkanim.mechanics.motion import Motion
from linkanim.mechanics.quantities import Quantity, input_symbol, look_up
from linkanim.picture.look import Over
from linkanim.scenes.scene import Scene
from linkanim.units import SPEED, short, split, stepped, typeset
from linkanim.words import name_said, said, to_say

# What a chart shows of a scene: quantities by name, and their values over one true period.

MOST_CHARTS = 3
"""The most charts that have room below each other."""


class Series(NamedTuple):
    """A quantity over one true period: phases (n,), values (n, k), and what the k columns are called.

    Angles are in degrees, as people read them; `unit` says so. An unbounded value is infinite, and a value of
    rounding errors alone is 0.
    """

    phases: NDArray[np.float64]
    values: NDArray[np.float64]
    unit: str
    labels: tuple[str, ...]

    @property
    def gain(self) -> NDArray[np.float64]:
        """By how much each column grows in a period: whole turns for an angle, else 0."""
        values = self.values
        if self.unit != "°" or len(values) < 2:
            return np.zeros(values.shape[1])
        with np.errstate(invalid="ignore"):
            turns = np.rint((2 * values[-1] - values[-2] - values[0]) / 360.0)
        return np.asarray(360.0 * np.nan_to_num(turns))

    def broken(self, places: NDArray[np.float64]) -> Series:
        """Return it with an infinite value added at the phases between which it is unbounded."""
        if not len(places):
            return self
        index = np.searchsorted(self.phases, places)
        phases, values = np.insert(self.phases, index, places), np.insert(self.values, index, np.inf, axis=0)
        return self._replace(phases=phases, values=values)


def quantity(scene: Scene, token: str) -> Quantity:
    """Return the quantity of a token, which may name a body as the scene does, or as it is shown.

    BadInput, with the nearest tokens and the list of all, where the scene has no such quantity.
    """
    return look_up(scene.quantities, _own_token(scene, token) or token, scene.name)


def _own_token(scene: Scene, token: str) -> str | None:
    """Return a token with its body's name in the scene; None where the scene has no such quantity."""
    owner, dot, measure = token.partition(".")
    own = {words: name for name, words in scene.info.link_names.items()}
    named = token if token in scene.quantities else f"{own.get(owner, owner)}{dot}{measure}"
    return named if named in scene.quantities else None


def chart_tokens(scene: Scene, charted: str | None) -> tuple[str, ...]:
    """Return the tokens in a look's `chart`, separated by commas; a name may itself hold a comma.

    Text at the end that is no quantity comes last, for the caller to refuse.
    """
    if charted is None or "," not in charted or charted in scene.quantities:
        return () if charted is None else (charted,)
    tokens: list[str] = []
    begun = ""
    for part in charted.split(","):
        begun = f"{begun},{part}" if begun else part.strip()
        if _own_token(scene, begun):
            tokens.append(begun)
            begun = ""
    return (*tokens, begun) if begun else tuple(tokens)


def series_of(scene: Scene, quantity: Quantity, cycle: Motion) -> Series:
    """Return a quantity of a cycle that is already solved."""
    values = np.asarray(quantity.displayed(cycle), float)
    columns = values if values.ndim == 2 else values[:, None]
    return Series(cycle.phase, columns, quantity.display_unit(scene.length_unit), quantity.columns)


# The words for the input, and the unit in which its speed is shown.

_PER_RADIAN = {"rad/s": 1.0, "rpm": 30 / pi, "deg/s": 180 / pi}
_SIGNS = {"deg/s": "°/s"}
_SPELT = {"°/s": "deg/s"}


def driven_words(scene: Scene, value: float) -> str:
    """Return where the input is, in words: its angle, 87.0°, or a driving slider's travel, 12.5 mm."""
    coordinate = scene.linkage.drive.coordinate
    return coordinate.text(value, scene.length_unit, 0.1 if coordinate.is_angle else scene.length_step)


def turned_words(scene: Scene, value: float) -> str:
    """Return where the input is, in words; an angle within one turn."""
    return driven_words(scene, value % tau if scene.info.full_turn else value)


def input_at(scene: Scene, value: float) -> str:
    """Return where the input is with its symbol, an angle within one turn: θ₂ = 87.0°."""
    return f"{input_symbol(scene.linkage)} = {turned_words(scene, value)}"


def driven_name(scene: Scene) -> str:
    """Return what the input's coordinate is called: crank angle."""
    link, measure = name_said(scene.info.input_name), said(scene.linkage.drive.coordinate.name)
    return said("{link} {measure}", link=link, measure=measure)


def speed_unit(scene: Scene) -> str:
    """Return the unit in which the scene states its input's speed, rpm where it states none."""
    return _unit_of(str(scene.document.get("drive", {}).get("speed", "")))


@lru_cache(maxsize=64)
def _unit_of(stated: str) -> str:
    """Return the unit of a stated speed; cached, since every frame asks for it."""
    try:
        unit = split(stated)[1]
    except UnitError:
        return "rpm"
    unit = _SPELT.get(unit, unit)
    return unit if unit in SPEED.factors else "rpm"


def speed_in(unit: str, speed: float) -> float:
    """Return an angular speed (rad/s) as a number in a unit: "rpm", "rad/s" or "deg/s"."""
    return speed * _PER_RADIAN[unit]


def sign_of(unit: str) -> str:
    """Return a unit of speed as it is shown: °/s for deg/s."""
    return _SIGNS.get(unit, unit)


def speed_words(scene: Scene, speed: float) -> str:
    """Return the input's speed (rad/s) in words: "20 rpm", negative clockwise, or "15 swings/min".

    One there-and-back of a driving slider is called a cycle.
    """
    return speed_teller(scene)(speed)


def speed_teller(scene: Scene) -> Callable[[float], str]:
    """Return the function that puts input speeds (rad/s) of a scene into words."""
    if not scene.info.full_turn:
        minutely = to_say("{count} cycles/min")
        if scene.linkage.drive.actuator.cycles == "swings":
            minutely = to_say("{count} swings/min")
        return lambda speed: said(minutely, count=short(abs(speed) * _PER_RADIAN["rpm"]))
    unit = speed_unit(scene)
    sign = sign_of(unit)
    return lambda speed: f"{typeset(short(speed_in(unit, speed)))} {sign}"


# Axes of a chart: where values lie along them, and few ticks at round numbers.

_WILD = 8.0
"""A peak this many times the span of the middle nine tenths is cut off; else the rest would look flat."""
_LITTLE = 0.06
"""The share of the values' span that an axis leaves free at either end."""
_COMMON = (0.08, 0.92)
"""Where values go to infinity, an axis holds those between these quantiles, and half that span beyond."""


@frozen
class Axis:
    """The range of an axis, and its ticks as (value, label)."""

    low: float
    high: float
    ticks: tuple[tuple[float, str], ...]

    def share(self, values: ArrayLike) -> NDArray[np.float64]:
        """Return where values lie on the axis, 0 at its low end and 1 at its high one."""
        share: NDArray[np.float64] = (np.asarray(values, float) - self.low) / (self.high - self.low)
        return share

    @property
    def unlabelled(self) -> Axis:
        """The same axis with ticks but no labels."""
        return replace(self, ticks=tuple((value, "") for value, _ in self.ticks))


def linear(low: float, high: float, *, most: int = 5, unit: str = "", least: int = 0) -> Axis:
    """Return an axis from `low` to `high` with at most `most` ticks, at 1, 2 or 5 times a power of ten.

    In degrees (`unit` "°") ticks lie at fractions of a turn; no other unit is written at ticks. Where there
    would be fewer than `least`, they are closer, even if they are then more than `most`.
    """
    axis = _ticks(low, high, most, unit)
    for closer in range(most + 1, 3 * max(most, least)):
        if len(axis) >= least:
            break
        axis = _ticks(low, high, closer, unit)
    return Axis(low, high, axis)


def _ticks(low: float, high: float, most: int, unit: str) -> tuple[tuple[float, str], ...]:
    sign = "°" if unit == "°" else ""
    step = _degrees(high - low, most) if unit == "°" else round_step(high - low, most)
    first, last = ceil(low / step - 1e-9), floor(high / step + 1e-9)
    return tuple((k * step, f"{stepped(k * step, step)}{sign}") for k in range(first, last + 1))


def around(
    values: NDArray[np.float64], *, most: int = 5, unit: str = "", room: float = _LITTLE, least: int = 0
) -> Axis:
    """Return a linear axis that holds the finite values, with a little room; wild peaks exceed it.

    Without a finite value it has no ticks.
    """
    low, high = range_around(values, room)
    if not np.isfinite(values).any():
        return Axis(low, high, ())
    return linear(low, high, most=most, unit=unit, least=least)


def range_around(values: NDArray[np.float64], room: float = _LITTLE) -> tuple[float, float]:
    """Return the range of an axis that holds the finite values, with a little room.

    Of a column that goes to infinity it holds the common values, and those near them.
    """
    columns = [column[np.isfinite(column)] for column in (values.T if values.ndim > 1 else [values])]
    finite = np.concatenate(columns)
    if np.isinf(values).any():
        spans = [_common_span(column) for column in columns if column.size]
        low, high = (min(span[0] for span in spans), max(span[1] for span in spans)) if spans else (0.0, 1.0)
    else:
        low, high = _span(finite) if finite.size else (0.0, 1.0)
    size = max(abs(low), abs(high))
    if high - low <= 1e-9 * size or high == low:
        low, high = (low - 0.5 * size, high + 0.5 * size) if size else (-1.0, 1.0)
    beyond = room * (high - low)
    return low - beyond, high + beyond


def zeros_level(ranges: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return two ranges that include zero, both stretched by one factor until their zeros are at one height.

    The shares a < b of the two ranges lie below zero. With the common zero at s, the first is stretched
    (1 - a) / (1 - s) times and the second b / s times; both factors are equal for s = b / (1 - a + b).
    """
    shares = sorted(-low / (high - low) for low, high in ranges)
    zero = shares[1] / (1 - shares[0] + shares[1])
    spans = (max(-low / zero, high / (1 - zero)) for low, high in ranges)
    return [(-zero * span, (1 - zero) * span) for span in spans]


def _span(finite: NDArray[np.float64]) -> tuple[float, float]:
    low, high = float(finite.min()), float(finite.max())
    inner = np.quantile(finite, (0.05, 0.95))
    middle = float(inner[1] - inner[0])
    if high - low > _WILD * middle > 0:
        return max(low, float(inner[0]) - middle), min(high, float(inner[1]) + middle)
    return low, high


def _common_span(finite: NDArray[np.float64]) -> tuple[float, float]:
    low, high = np.quantile(finite, _COMMON)
    beyond = 0.5 * (high - low)
    return max(float(finite.min()), float(low - beyond)), min(float(finite.max()), float(high + beyond))


def unbounded_places(x: ArrayLike, values: ArrayLike) -> Floats:
    """Return where a curve goes to infinity: at each infinite value beside a finite one."""
    x, values = np.asarray(x, float), np.asarray(values, float)
    beside = np.pad(np.isfinite(values), 1)
    places: Floats = x[np.isinf(values) & (beside[:-2] | beside[2:])]
    return places


def round_step(span: float, most: int) -> float:
    """Return the least of 1, 2 and 5 times a power of ten that goes at most `most` times into a span."""
    rough = span / most
    power = 10.0 ** floor(log10(rough))
    return next(power * factor for factor in (1, 2, 5, 10) if power * factor >= rough * (1 - 1e-9))


def round_below(most: float) -> float:
    """Return the greatest of 1, 2 and 5 times a power of ten that is no more than a positive number."""
    power = 10.0 ** floor(log10(most))
    return next(power * factor for factor in (5, 2, 1, 0.5) if power * factor <= most * (1 + 1e-9))


def _degrees(span: float, most: int) -> float:
    parts = (15.0, 30.0, 45.0, 90.0, 180.0, 360.0)
    if span / most <= parts[0] / 2:
        return round_step(span, most)
    return next((part for part in parts if span / part <= most), 360.0 * ceil(span / most / 360.0))


# The horizontal axis of a chart: the driven bar's angle, time, or phase, over one true period.

Floats = NDArray[np.float64]


@frozen
class Course:
    """Where phases lie along a chart: at `x = (phase - origin) / scale`, modulo `span`.

    `period` is the true period in phase; `scale` is negative where the phase decreases with time. `marks` are
    named places along the axis.
    """

    title: str
    unit: str
    span: float
    period: float
    origin: float
    scale: float
    marks: tuple[tuple[float, str], ...] = ()

    def x_of(self, phase: ArrayLike) -> Floats:
        """Return where phases lie, 0 to `span`."""
        x: Floats = np.mod((np.asarray(phase, float) - self.origin) / self.scale, self.span)
        return x

    def phase_of(self, x: ArrayLike) -> Floats:
        """Return the phases at places x, which may lie outside 0 … `span`: without jumps there."""
        phase: Floats = self.origin + self.scale * np.asarray(x, float)
        return phase

    def axis(self, most: int) -> Axis:
        """Return the axis with at most `most` ticks."""
        return linear(0.0, self.span, most=most, unit=self.unit)

    def laid(self, series: Series) -> tuple[Floats, Floats]:
        """Return a series along the course, with both ends added: x (n + 2,) rising, values (n + 2, k)."""
        gain = series.gain
        x = self.x_of(series.phases)
        turns = np.rint((self.phase_of(x) - series.phases) / self.period)
        order = np.argsort(x)
        x, values = x[order], (series.values + turns[:, None] * gain)[order]
        step = gain if self.scale > 0 else -gain
        before, after = values[-1] - step, values[0]
        part = (self.span - x[-1]) / (self.span - x[-1] + x[0])
        with np.errstate(invalid="ignore"):
            start = after if part == 1.0 else before + (after - before) * part
        return np.r_[0.0, x, self.span], np.vstack([start, values, start + step])


def axes_of(scene: Scene) -> tuple[Over, ...]:
    """Return the axes that a chart beside the scene may have, the usual one first; no angle that swings."""
    return ("angle", "time", "phase") if scene.info.full_turn else ("time", "phase")


def axis_of(scene: Scene, over: Over | None) -> Over:
    """Return the axis of the chart beside the scene: `over` where that is possible, else the usual one."""
    axes = axes_of(scene)
    return over if over in axes else axes[0]


def course(scene: Scene, speed: float, over: Over | None = None) -> Course:
    """Return the course of a scene that runs at `speed` (rad/s, negative: the phase decreases).

    Without `over`, an input that turns is shown over its absolute angle, one that swings over time. BadInput
    for the angle of an input that is a slider.
    """
    if over == "angle":
        scene.linkage.drive.check_angle(scene.name, "show it over time or phase")
    turns = scene.info.full_turn
    chosen = over or axes_of(scene)[0]
    period = scene.period
    if chosen == "time":
        pace = speed or scene.linkage.drive.speed
        limits = () if turns else tuple(_limits(scene, pace))
        title = said("time (s), back on the same closure") if scene.mechanism.retraced else said("time (s)")
        return Course(title, "", period / abs(pace), period, 0.0, pace, limits)
    title, origin = input_title(scene), -scene.linkage.drive.start
    if chosen == "phase":
        title, origin = said("phase φ (°)"), 0.0
    return Course(title, "°", degrees(period), period, origin, radians(1.0))


def input_title(scene: Scene) -> str:
    """Return the title of an axis of the driven bar's angle: "crank angle θ₂ (°)"."""
    link, symbol = name_said(scene.info.input_name), input_symbol(scene.linkage)
    return said("{link} angle {symbol} (°)", link=link, symbol=symbol)


def _limits(scene: Scene, pace: float) -> Iterator[tuple[float, str]]:
    """Yield the times in a period at which a swing is at its limits, each with the angle there."""
    for half in range(round(scene.period / pi) + 1):
        angle = scene.pose(half * pi, 0).coordinate
        yield half * pi / abs(pace), driven_words(scene, angle)
