"""Dyads as data: two bars, a bar and a slider, a slotted bar, a bar that slides. None is closed here."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from linkanim.mechanics.linkage.joint import Guided, Joint, Line, Slide


@dataclass(frozen=True, slots=True)
class RRR(Joint):
    """Two bars that meet in a pin: `lengths[i]` from `ends[i]`.

    `side` is +1 where the pin lies left of the line from `ends[0]` to `ends[1]`, -1 right.
    With `side_of = (b, p, q)` it says instead on which side of p -> q the joint b lies just
    after the start of the drive (a four-bar driven at its rocker is named that way).
    """

    ends: tuple[str, str]
    lengths: tuple[float, float]
    side: int = 1
    side_of: tuple[str, str, str] | None = None

    sides: ClassVar[tuple[str, str]] = ("left", "right")
    dyad: ClassVar[bool] = True
    sized: ClassVar[tuple[str, ...]] = ("lengths",)

    @property
    def needs(self) -> tuple[str, ...]:
        """The far ends of its two bars."""
        return self.ends

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """Its two bars."""
        return (self.ends[0], self.lengths[0]), (self.ends[1], self.lengths[1])

    @property
    def named_sign(self) -> int:
        """The sign of the root: left of the line, or of the closure that another joint's side names."""
        return -self.side if self.side_of else self.side

    @property
    def named_from(self) -> tuple[int, str, str, str] | None:
        """The side of a line on which another joint lies, where that names the closure."""
        return (self.side, *self.side_of) if self.side_of else None

    @property
    def at_limit(self) -> str:
        """Its bars lie in one line, stretched or folded."""
        one, other = (f"{end}–{self.name}" for end in self.ends)
        return f"the bars {one} and {other} lie in one line"

    def transmission(self, u: float, w: float) -> float:
        """Return the angle μ between its bars' lines: tan²(μ/2) = W/U or, past 90°, U/W.

        It is the cosine rule in its half-angle form.
        """
        return 2 * math.atan2(math.sqrt(min(u, w)), math.sqrt(max(u, w)))

    def transmission_at(self, way: Callable[[str, str], tuple[Any, Any]]) -> Any:
        """Return the angle between its bars' lines."""
        # Here, so that reading a scene file loads no arrays.
        import numpy as np

        (x, y), (u, v) = (way(self.name, end) for end in self.ends)
        return np.arctan2(abs(x * v - y * u), abs(x * u + y * v))

    def why_apart(self, u: float, w: float, unit: str) -> str:
        """Say how near its ends come, or how far apart: U = (a + b)² - L², W = L² - (a - b)²."""
        a, b = self.lengths
        least, most = math.sqrt(max((a + b) ** 2 - u, 0.0)), math.sqrt(max((a - b) ** 2 + w, 0.0))
        if w < 0:
            apart = f"at most {most:.6g} {unit}; these bars need {abs(a - b):g} {unit}"
        else:
            apart = f"at least {least:.6g} {unit}; these bars reach {a + b:g} {unit}"
        ends = "–".join(self.ends)
        return f"the bars of {a:g} and {b:g} {unit} cannot meet at any angle of the input: {ends} is {apart}"


@dataclass(frozen=True, slots=True)
class RRP(Guided):
    """A bar from `end` to a slider on `line`; `side` +1 is the closure further forward, -1 back."""

    end: str
    length: float
    line: Line
    side: int = 1

    sides: ClassVar[tuple[str, str]] = ("forward", "backward")
    dyad: ClassVar[bool] = True
    sized: ClassVar[tuple[str, ...]] = ("length", "line")

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """Its bar."""
        return ((self.end, self.length),)

    @property
    def named_sign(self) -> int:
        """The sign of the root: how far the slider is ahead of the bar's end."""
        return self.side

    @property
    def at_limit(self) -> str:
        """Its bar reaches no farther than the line."""
        return f"the bar {self.end}–{self.name} stands straight across the line of travel of {self.name}"

    def transmission(self, u: float, w: float) -> float:
        """Return the angle from its bar to the normal of its line: as much less than 90° as the bar leans.

        The bar leans asin(|e|/b), where U = b - e and W = b + e.
        """
        return math.pi / 2 - abs(2 * math.atan2(math.sqrt(w), math.sqrt(u)) - math.pi / 2)

    def transmission_at(self, way: Callable[[str, str], tuple[Any, Any]]) -> Any:
        """Return the angle from its bar to the normal of its line, as in `transmission`."""
        # Here, so that reading a scene file loads no arrays.
        import numpy as np

        (x, y), (u, v) = way(self.end, self.name), (math.cos(self.line.angle), math.sin(self.line.angle))
        if self.line.on:
            a, b = way(*self.line.on)
            u, v = a * u - b * v, a * v + b * u
        return np.arctan2(abs(x * u + y * v), abs(x * v - y * u))

    def why_apart(self, u: float, w: float, unit: str) -> str:
        """Say that the bar is too short for its line."""
        return (
            f"the bar of {self.length:g} {unit} cannot reach its line of travel from {self.end} "
            "at any angle of the input; make it longer or the offset smaller"
        )


@dataclass(frozen=True, slots=True)
class RPR(Joint):
    """A bar that turns about the joint `pivot`, its slot passing through the joint `through`.

    One of the two may be fixed: a lever whose slot a crank pin drives, or a rod sliding through a swivel.

    through = pivot + s·u + offset·n with s > 0, u the bar's direction and n to its left;
    the joint itself is pivot + length·u.
    """

    pivot: str
    through: str
    length: float
    offset: float = 0.0

    dyad: ClassVar[bool] = True
    sized: ClassVar[tuple[str, ...]] = ("length", "offset")

    @property
    def needs(self) -> tuple[str, ...]:
        """The pivot, and the joint in the slot."""
        return self.pivot, self.through

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """The slotted bar."""
        return ((self.pivot, self.length),)

    @property
    def pins(self) -> tuple[str, ...]:
        """The pivot, and the joint in the slot."""
        return self.pivot, self.through

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The joint in the slot, along the bar."""
        return (Slide(self.through, self.pivot, Line(self.pivot, 0.0, self.offset, (self.pivot, self.name))),)

    @property
    def named_sign(self) -> int:
        """The sign of the root: the joint in the slot is always ahead of the pivot."""
        return 1

    @property
    def at_limit(self) -> str:
        """The pin is where the slot is nearest to its pivot."""
        return f"{self.through} is as near to {self.pivot} as the offset of the slot lets it come"

    def transmission(self, u: float, w: float) -> float:
        """Return the angle from the slot's normal, along which the pin pushes, to the bar's motion there.

        90° of a slot that runs through its pivot: the pin's push then does nothing but turn the bar.
        """
        return math.atan2(math.sqrt(w), abs(self.offset))

    def transmission_at(self, way: Callable[[str, str], tuple[Any, Any]]) -> Any:
        """Return the angle from the slot's normal to the bar's motion at the pin, as in `transmission`."""
        # Here, so that reading a scene file loads no arrays.
        import numpy as np

        x, y = way(self.pivot, self.through)
        arm = np.sqrt(x * x + y * y)
        if not self.offset:
            return np.arccos(0.0 * arm)
        with np.errstate(divide="ignore"):  # the pin on the pivot, where rounding brings it
            return np.arccos(np.minimum(abs(self.offset) / arm, 1.0))

    def why_apart(self, u: float, w: float, unit: str) -> str:
        """Say that the slot's offset is too large."""
        return (
            f"the slot's offset {self.offset:g} {unit} is more than the pin {self.through} is ever away "
            f"from {self.pivot}; make it smaller"
        )


@dataclass(frozen=True, slots=True)
class RPP(Guided):
    """A bar sliding along `line`, the joint `pin` in its slot; the joint is where the slot crosses the line.

    `slot` is the slot's direction from the line's, in radians; it must not lie along the line.
    """

    pin: str
    line: Line
    slot: float = math.pi / 2

    dyad: ClassVar[bool] = True
    sized: ClassVar[tuple[str, ...]] = ("line",)

    @property
    def needs(self) -> tuple[str, ...]:
        """The pin in the slot, and the joints of the line."""
        return self.pin, *self.line.needs

    @property
    def pins(self) -> tuple[str, ...]:
        """The pin in the slot."""
        return (self.pin,)

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The bar along its line, and the pin along the bar's slot."""
        slot = Line(self.name, self.line.angle + self.slot, on=self.line.on)
        return self.line.guiding(self.name), Slide(self.pin, self.name, slot)
