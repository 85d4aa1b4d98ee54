"""Stand-ins for the packages of the comparison: they keep what they are asked, and solve plainly."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Equations = Callable[[Any], Any]


class UnbuildableError(Exception):
    """As in pylinkage: there is no such pose."""


class Ground(NamedTuple):
    x: float
    y: float

    @property
    def place(self) -> complex:
        return complex(self.x, self.y)


class Crank(NamedTuple):
    pivot: Ground
    length: float
    rate: float
    angle: float

    @property
    def output(self) -> str:
        return "A"


class RRRDyad(NamedTuple):
    first: object
    second: object
    one: float
    other: float
    x: float
    y: float


class FixedDyad(NamedTuple):
    first: object
    second: object
    distance: float
    angle: float


class Linkage:
    """A four-bar with a coupler point; every pose lies nearest to the one before it."""

    def __init__(self, components: list[Any]) -> None:
        o2, self.o4, self.crank, self.dyad, self.point = components
        self.tied = (self.dyad.first, self.dyad.second, self.point.first, self.point.second)
        assert (o2, self.tied) == (self.crank.pivot, ("A", self.o4, "A", self.dyad))
        self.angle, self.b = self.crank.angle, complex(self.dyad.x, self.dyad.y)
        self.speeds: dict[Crank, float] = {}
        self.asked: list[tuple[str, int, float]] = []

    def set_input_velocity(self, crank: Crank, speed: float) -> None:
        self.speeds[crank] = speed

    def step(self, count: int, dt: float = 1.0) -> Iterator[NDArray[np.float64]]:
        return self._poses("step", count, dt)

    def step_with_derivatives(self, count: int, dt: float = 1.0) -> Iterator[NDArray[np.float64]]:
        return self._poses("step_with_derivatives", count, dt)

    def step_fast(self, count: int, dt: float = 1.0) -> NDArray[np.float64]:
        return np.array(list(self._poses("step_fast", count, dt)))

    def step_fast_with_kinematics(self, count: int, dt: float = 1.0) -> NDArray[np.float64]:
        return np.array(list(self._poses("step_fast_with_kinematics", count, dt)))

    def _poses(self, name: str, count: int, dt: float) -> Iterator[NDArray[np.float64]]:
        self.asked.append((name, count, dt))
        for _ in range(count):
            self.angle += self.crank.rate * dt
            yield self._pose()

    def _pose(self) -> NDArray[np.float64]:
        o2, o4 = self.crank.pivot.place, self.o4.place
        a = o2 + cmath.rect(self.crank.length, self.angle)
        way = o4 - a
        along = (self.dyad.one**2 - self.dyad.other**2 + abs(way) ** 2) / (2 * abs(way))
        if along**2 > self.dyad.one**2:
            raise UnbuildableError
        height = math.sqrt(self.dyad.one**2 - along**2)
        both = [a + way / abs(way) * complex(along, side * height) for side in (1, -1)]
        self.b = min(both, key=lambda b: abs(b - self.b))
        p = a + cmath.rect(self.point.distance, self.point.angle + cmath.phase(self.b - a))
        return np.array([(place.real, place.imag) for place in (o2, o4, a, self.b, p)])


def pylinkage(made: list[Linkage]) -> Iterator[ModuleType]:
    """Yield pylinkage's modules; each linkage that is built with them goes to `made`."""

    def linkage(components: list[Any]) -> Linkage:
        made.append(Linkage(components))
        return made[-1]

    yield _module("pylinkage.actuators", Crank=Crank)
    yield _module("pylinkage.components", Ground=Ground)
    yield _module("pylinkage.dyads", FixedDyad=FixedDyad, RRRDyad=RRRDyad)
    yield _module("pylinkage.simulation", Linkage=linkage)
    yield _module("pylinkage.exceptions", UnbuildableError=UnbuildableError)


def scipy(starts: list[complex]) -> ModuleType:
    """Return scipy.optimize with an fsolve by Newton's method; where each search starts goes to `starts`."""

    def fsolve(equations: Equations, start: tuple[float, float], *, full_output: bool) -> tuple[Any, ...]:
        assert full_output
        starts.append(complex(*start))
        at = np.array(start)
        for _ in range(30):
            value = np.array(equations(at))
            slopes = [(np.array(equations(at + step)) - value) / 1e-6 for step in 1e-6 * np.eye(2)]
            at = at - np.linalg.solve(np.transpose(slopes), value)
        close = np.abs(equations(at)).max() < 1e-12
        return at, {}, 1 if close else 5, "told in words"

    return _module("scipy.optimize", fsolve=fsolve)


class Line:
    """What is drawn between some points, or at them."""

    def __init__(self, x: Any, y: Any) -> None:
        self.set_data(x, y)

    def set_data(self, x: Any, y: Any) -> None:
        self.points = [(float(one), float(other)) for one, other in zip(x, y, strict=True)]


@dataclass
class Arrow:
    """An arrow from a point, its velocity, and the velocity of an arrow of one unit of length."""

    offset: Any
    velocity: Any
    scale: float

    def set_offsets(self, offset: Any) -> None:
        self.offset = offset

    def set_UVC(self, u: float, v: float) -> None:  # noqa: N802
        self.velocity = (u, v)


@dataclass
class Axes:
    """Axes that keep what is drawn on them."""

    lines: list[Line] = field(default_factory=list)
    arrows: list[Arrow] = field(default_factory=list)
    x: tuple[float, float] = (0.0, 1.0)
    y: tuple[float, float] = (0.0, 1.0)

    def set(self, *, xlim: tuple[float, float], ylim: tuple[float, float]) -> None:
        self.x, self.y = xlim, ylim

    def get_ylim(self) -> tuple[float, float]:
        return self.y

    def plot(self, x: Any, y: Any, *_: str, **__: object) -> list[Line]:
        self.lines.append(Line(x, y))
        return self.lines[-1:]

    def quiver(self, *from_and_by: float, scale: float, width: float, **_: object) -> Arrow:
        x, y, u, v = from_and_by
        assert width < 0.01, "in widths of the picture"
        self.arrows.append(Arrow((x, y), (u, v), scale))
        return self.arrows[-1]


@dataclass
class Saved:
    """What was asked of an animation that was saved."""

    sheet: Any
    interval: float
    target: Any
    fps: int
    shown: list[list[Line]]


def matplotlib(saved: list[Saved]) -> Iterator[ModuleType]:
    """Yield matplotlib's modules; each animation that they save goes to `saved`."""

    class Figure:
        def __init__(self, *, figsize: tuple[float, float], dpi: float) -> None:
            self.size = tuple(side * dpi for side in figsize)
            self.titles: list[str] = []
            self.axes = Axes()

        def add_axes(self, rectangle: tuple[float, float, float, float], **looks: object) -> Axes:
            left, bottom, width, height = rectangle
            assert 0 <= left < left + width <= 1
            assert 0 <= bottom < bottom + height < 1, "a title needs room"
            assert looks == {"aspect": "equal", "frameon": False, "xticks": (), "yticks": ()}
            return self.axes

        def suptitle(self, title: str) -> None:
            self.titles.append(title)

    class FuncAnimation:
        def __init__(
            self, sheet: Figure, update: Callable[[int], object], *, frames: int, interval: float
        ) -> None:
            self.sheet, self.update, self.frames, self.interval = sheet, update, frames, interval

        def save(self, target: Any, *, writer: int) -> None:
            shown = []
            for frame in range(self.frames):
                self.update(frame)
                shown.append([Line(*zip(*line.points, strict=True)) for line in self.sheet.axes.lines])
            saved.append(Saved(self.sheet, self.interval, target, writer, shown))

    yield _module("matplotlib.animation", FuncAnimation=FuncAnimation, PillowWriter=lambda fps: fps)
    yield _module("matplotlib.figure", Figure=Figure)


def _module(name: str, **members: object) -> ModuleType:
    module = ModuleType(name)
    vars(module).update(members)
    return module
