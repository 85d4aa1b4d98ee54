"""Say what a linkage is, as data: joints, rigid bodies, what drives it; nothing here moves.

Its parts, in reading order:

- What a joint is, whatever its kind: what all kinds have, and the lines along which sliders travel.
- Dyads as data: two bars, a bar and a slider, a slotted bar, a bar that slides. None is closed here.
- Rigid bodies: which joints keep their distances, where they lie in the body's own frame, and its points.
- Joints that are given, not closed: fixed pins, crank pins, the slider that drives.
- What moves a linkage, as data: a motor on its crank, a cylinder, a slider; and what tells where it is.
- What a linkage is: frozen values, lengths in the scene's unit, angles in radians, y up.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import field, replace
from fractions import Fraction
from functools import cached_property, reduce
from itertools import repeat
from typing import Any, ClassVar, NamedTuple, Self

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.tolerances import FAR, ONE_POINT
from linkanim.units import short, stepped, unit_of
from linkanim.words import name_said, said, to_say

# What a joint is, whatever its kind: what all kinds have, and the lines along which sliders travel.
#
# Joints stand in the order in which they can be solved: each one names only joints before it.

Point = tuple[float, float]

RigidBody = dict[str, complex]
"""Where the joints of one rigid body lie in its own frame, as x + yi."""


class Stated:
    """A value that lengths define: its fields named in `sized` hold lengths, or values of this kind."""

    __slots__ = ()
    sized: ClassVar[tuple[str, ...]] = ()

    @property
    def stated_lengths(self) -> tuple[float, ...]:
        """All its lengths, of either sign."""
        return tuple(_lengths_in(self, "stated_lengths"))

    @property
    def all_lengths(self) -> tuple[float, ...]:
        """All its lengths, those twice that are known in two ways, in the order of `with_lengths`."""
        return tuple(_lengths_in(self, "all_lengths"))

    def with_lengths(self, lengths: Iterator[Any]) -> Self:
        """Return the same value with other lengths, or with values that stand for them."""
        return replace(self, **{name: _anew(getattr(self, name), lengths) for name in self.sized})  # type: ignore[type-var]

    def scaled(self, factor: float) -> Self:
        """Return the same value with every length multiplied by a factor."""
        return self.with_lengths(length * factor for length in self.all_lengths)


def _lengths_in(of: Stated, which: str) -> Iterator[float]:
    """Yield the lengths in a value's fields, and of the values there the lengths that `which` names."""
    waiting = [getattr(of, name) for name in reversed(of.sized)]
    while waiting:
        value = waiting.pop()
        if isinstance(value, tuple):
            waiting += reversed(value)
        elif value is not None:
            yield from getattr(value, which) if isinstance(value, Stated) else (value,)


def _anew(value: Any, lengths: Iterator[Any]) -> Any:
    if isinstance(value, tuple):
        return tuple(_anew(part, lengths) for part in value)
    if value is None:
        return None
    return value.with_lengths(lengths) if isinstance(value, Stated) else next(lengths)


@frozen
class Line(Stated):
    """A line of travel: through the joint `through`, at `angle`, shifted by `offset` to its left.

    A fixed line runs through a fixed pin, and its angle is absolute. A line that a body carries names two
    joints of that body in `on`; `through` is a joint of the body, and the angle is from on[0] -> on[1].
    """

    through: str
    angle: float = 0.0
    offset: float = 0.0
    on: tuple[str, str] | None = None

    sized: ClassVar[tuple[str, ...]] = ("offset",)

    @property
    def needs(self) -> tuple[str, ...]:
        """The joints that the line is known by."""
        return self.through, *(self.on or ())

    @property
    def body(self) -> tuple[str, ...]:
        """The joints that must be on one body: those of the axis, and the one it runs through."""
        return tuple(dict.fromkeys((*self.on, self.through))) if self.on else ()

    def guiding(self, joint: str) -> Slide:
        """Return how a joint slides along the line."""
        return Slide(joint, self.on[0] if self.on else None, self)


class Slide(NamedTuple):
    """A joint, `point`, that slides along a line; `start` is a joint of its guide, None for the ground."""

    point: str
    start: str | None
    line: Line

    @property
    def axis(self) -> tuple[str, str] | None:
        """Two joints of the guide; None for a guide that does not turn: the line's angle is then absolute."""
        return self.line.on

    @property
    def angle(self) -> float:
        """The line's direction from the guide's axis (rad)."""
        return self.line.angle


@frozen
class Joint(Stated):
    """A joint: how it is found from joints before it.

    A `dyad` is closed from two constraints, which meet in two points as a rule: `sides` names the two
    closures, +1 first. A joint that `travels` moves along a line. A `fixed` one belongs to the ground. One
    that is `grouped` is solved together with others.
    """

    name: str

    sides: ClassVar[tuple[str, str] | None] = None
    dyad: ClassVar[bool] = False
    travels: ClassVar[bool] = False
    fixed: ClassVar[bool] = False
    grouped: ClassVar[bool] = False

    @property
    def reacts(self) -> bool:
        """Whether the forces of it are worked out."""
        return True

    @property
    def needs(self) -> tuple[str, ...]:
        """The joints that this one is found from."""
        return ()

    @property
    def driven_slide(self) -> Slide | None:
        """How it slides where the drive gives how far; None of other joints."""
        return None

    @property
    def driven_between(self) -> tuple[str, str] | None:
        """The ends of the cylinder whose length the drive gives, itself the last; None of other joints."""
        return None

    @property
    def motor(self) -> tuple[str, str] | None:
        """Of a motor at the joint, which moves itself: the link that it turns, and a joint of the other one.

        Towards that the motor's angle is 0. None where there is no motor.
        """
        return None

    @property
    def body(self) -> tuple[str, ...]:
        """The joints that must be on one rigid body, the first two of them apart: they show its axis."""
        return ()

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """The bars that end in this joint: from which joint, and how long."""
        return ()

    @property
    def spans(self) -> tuple[tuple[str, ...], ...]:
        """The sets of joints that the joint's definition keeps at fixed distances."""
        return tuple((start, self.name) for start, _ in self.bars)

    @property
    def pins(self) -> tuple[str, ...]:
        """The joints about which the definition lets bars turn on each other: its bars' ends."""
        return (*(start for start, _ in self.bars), self.name) if self.bars else ()

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The joints that the definition lets slide, and along what."""
        return ()

    @property
    def guided(self) -> tuple[Slide, ...]:
        """The slides on whose guides it does not turn, of a block on several."""
        return ()

    @property
    def slotted(self) -> tuple[tuple[str, tuple[str, ...]], ...]:
        """The joints that the definition has in a slot, each with joints of the body whose slot it is."""
        return ()

    @property
    def block(self) -> tuple[str, ...]:
        """Joints of the body that slides with it, where it travels; none of the ground."""
        return (self.name,)

    @property
    def made(self) -> tuple[tuple[str, ...], Mapping[str, str]]:
        """What the bodies are called that the definition adds: of its bars, and by its joint each block."""
        bars = tuple(f"{start}–{self.name}" for start, _ in self.bars)
        return bars, {self.name: f"slider {self.name}"} if self.travels else {}

    @property
    def named_sign(self) -> int | None:
        """The sign of the root in the closure that is named; None where there is no root."""
        return None

    @property
    def named_from(self) -> tuple[int, str, str, str] | None:
        """(+1 or -1, b, p, q) where the closure is named by b lying left or right of p -> q; else None."""
        return None

    def seen_from(self, x: float, y: float) -> Self:
        """Return the joint as it is known from another origin."""
        return self

    def placed(self, bodies: tuple[RigidBody, ...]) -> tuple[RigidBody, ...]:
        """Return the rigid bodies with this joint added: each of its bars is a further body."""
        return (*bodies, *({start: 0j, self.name: complex(length)} for start, length in self.bars))

    def why_apart(self, u: float, w: float, unit: str) -> str:
        """Say in words and numbers why it cannot be assembled at any angle of the input.

        `u` and `w` are the greatest values that the factors of its root reach.
        """
        return "it cannot be assembled"

    @property
    def at_limit(self) -> str:
        """How the dyad stands at the limit of closing, as a clause; empty for a joint that always closes."""
        return ""

    def transmission(self, u: float, w: float) -> float | None:
        """Return a dyad's transmission angle where its root's factors are U and W; None of other joints."""
        return None

    def transmission_at(self, vector: Callable[[str, str], tuple[Any, Any]]) -> Any:
        """Return a dyad's transmission angle where `vector` gives x, y from joint to joint, floats or arrays.

        None of other joints.
        """
        return None


class Guided(Joint):
    """A joint that travels along `line`, fixed or carried by a body."""

    __slots__ = ()

    line: Line

    travels: ClassVar[bool] = True

    @property
    def needs(self) -> tuple[str, ...]:
        """The far ends of its bars, and the joints of its line."""
        return *(start for start, _ in self.bars), *self.line.needs

    @property
    def body(self) -> tuple[str, ...]:
        """The joints of the body that carries its line."""
        return self.line.body

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The joint, along its line."""
        return (self.line.guiding(self.name),)


# Dyads as data: two bars, a bar and a slider, a slotted bar, a bar that slides. None is closed here.


@frozen
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

    sides: ClassVar[tuple[str, str]] = to_say("left"), to_say("right")
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
        """The sign of the root: `side`, or against it where another joint's side names the closure."""
        return -self.side if self.side_of else self.side

    @property
    def named_from(self) -> tuple[int, str, str, str] | None:
        """The side of a line on which another joint lies, where that names the closure."""
        return (self.side, *self.side_of) if self.side_of else None

    @property
    def at_limit(self) -> str:
        """Its bars lie in one line, stretched or folded."""
        one, other = (f"{end}–{self.name}" for end in self.ends)
        return said("the bars {one} and {other} lie in one line", one=one, other=other)

    def transmission(self, u: float, w: float) -> float:
        """Return the angle μ between its bars' lines: tan²(μ/2) = W/U or, past 90°, U/W.

        It is the cosine rule in its half-angle form.
        """
        return 2 * math.atan2(math.sqrt(min(u, w)), math.sqrt(max(u, w)))

    def transmission_at(self, vector: Callable[[str, str], tuple[Any, Any]]) -> Any:
        """Return the angle between its bars' lines."""
        # Here, so that reading a scene file loads no arrays.
        import numpy as np

        (x, y), (u, v) = (vector(self.name, end) for end in self.ends)
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


@frozen
class RRP(Guided):
    """A bar from `end` to a slider on `line`; `side` +1 is the closure further forward, -1 back."""

    end: str
    length: float
    line: Line
    side: int = 1

    sides: ClassVar[tuple[str, str]] = to_say("forward"), to_say("backward")
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
        bar = f"{self.end}–{self.name}"
        return said(
            "the bar {bar} stands straight across the line of travel of {joint}", bar=bar, joint=self.name
        )

    def transmission(self, u: float, w: float) -> float:
        """Return the angle from its bar to the normal of its line: 90° less the bar's angle to the line.

        The bar's angle to the line is asin(|e|/b), where U = b - e and W = b + e.
        """
        return math.pi / 2 - abs(2 * math.atan2(math.sqrt(w), math.sqrt(u)) - math.pi / 2)

    def transmission_at(self, vector: Callable[[str, str], tuple[Any, Any]]) -> Any:
        """Return the angle from its bar to the normal of its line, as in `transmission`."""
        # Here, so that reading a scene file loads no arrays.
        import numpy as np

        (x, y), (u, v) = vector(self.end, self.name), (math.cos(self.line.angle), math.sin(self.line.angle))
        if self.line.on:
            a, b = vector(*self.line.on)
            u, v = a * u - b * v, a * v + b * u
        return np.arctan2(abs(x * u + y * v), abs(x * v - y * u))

    def why_apart(self, u: float, w: float, unit: str) -> str:
        """Say that the bar is too short for its line."""
        return (
            f"the bar of {self.length:g} {unit} cannot reach its line of travel from {self.end} "
            "at any angle of the input; make it longer or the offset smaller"
        )


@frozen
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
    def slotted(self) -> tuple[tuple[str, tuple[str, ...]], ...]:
        """The joint in the slot of the bar."""
        return ((self.through, (self.pivot, self.name)),)

    @property
    def named_sign(self) -> int:
        """The sign of the root: the joint in the slot is always ahead of the pivot."""
        return 1

    @property
    def at_limit(self) -> str:
        """The pin is at the point of the slot that is nearest to its pivot."""
        pins = {"pin": self.through, "pivot": self.pivot}
        return said("{pin} is as near to {pivot} as the offset of the slot lets it come", **pins)

    def transmission(self, u: float, w: float) -> float:
        """Return the angle from the slot's normal, along which the pin pushes, to the bar's motion there.

        It is 90° for a slot that runs through its pivot: the pin's push then does nothing but turn the bar.
        """
        return math.atan2(math.sqrt(w), abs(self.offset))

    def transmission_at(self, vector: Callable[[str, str], tuple[Any, Any]]) -> Any:
        """Return the angle from the slot's normal to the bar's motion at the pin, as in `transmission`."""
        # Here, so that reading a scene file loads no arrays.
        import numpy as np

        x, y = vector(self.pivot, self.through)
        arm = np.sqrt(x * x + y * y)
        if not self.offset:
            return np.arccos(0.0 * arm)
        with np.errstate(divide="ignore"):  # rounding may put the pin on the pivot
            return np.arccos(np.minimum(abs(self.offset) / arm, 1.0))

    def why_apart(self, u: float, w: float, unit: str) -> str:
        """Say that the slot's offset is too large."""
        return (
            f"the slot's offset {self.offset:g} {unit} is more than the pin {self.through} is ever away "
            f"from {self.pivot}; make it smaller"
        )


@frozen
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
    def slotted(self) -> tuple[tuple[str, tuple[str, ...]], ...]:
        """The pin in the slot of the bar."""
        return ((self.pin, (self.name,)),)

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The bar along its line, and the pin along the bar's slot."""
        slot = Line(self.name, self.line.angle + self.slot, on=self.line.on)
        return self.line.guiding(self.name), Slide(self.pin, self.name, slot)


# Rigid bodies: which joints keep their distances, where they lie in the body's own frame, and its points.
#
# Points of a body other than its pins: coupler points, third pins of a plate, corners of a rigid triangle.


def rigid_bodies(joints: Iterable[Joint]) -> tuple[RigidBody, ...]:
    """Return the sets of joints that keep their distances, the ground first; joints in solved order.

    Each maps its joints to their places: x along its first bar, y to the left. Every bar starts a frame
    of its own, in the order of the joints and of each joint's `bars`.
    """
    ground: tuple[RigidBody, ...] = ({},)
    return reduce(lambda bodies, joint: joint.placed(bodies), joints, ground)


def holding(bodies: Iterable[RigidBody], names: Iterable[str]) -> int | None:
    """Return the index of the first frame that has all these joints; None where no frame has."""
    joints = set(names)
    return next((n for n, frame in enumerate(bodies) if joints <= frame.keys()), None)


def coincide(frame: RigidBody, first: str, second: str) -> bool:
    """Tell whether two joints of a body are one point, so that no direction runs from one to the other."""
    size = max(abs(frame[first]), abs(frame[second]))
    return abs(frame[first] - frame[second]) <= ONE_POINT * size


def share_of(frame: RigidBody, on: tuple[str, str], at: tuple[float, float]) -> complex:
    """Return the point `at`, along on[0] -> on[1] and to its left, as x + yi in lengths of that line."""
    return complex(*at) / abs(frame[on[1]] - frame[on[0]])


@frozen
class Rigid(Joint):
    """A point of a body: `at` = (along `on[0]` -> `on[1]`, to the left of it) from `on[0]`."""

    on: tuple[str, str]
    at: Point

    sized: ClassVar[tuple[str, ...]] = ("at",)

    @property
    def needs(self) -> tuple[str, ...]:
        """The two joints that its body is known by."""
        return self.on

    @property
    def body(self) -> tuple[str, ...]:
        """The two joints that its body is known by."""
        return self.on

    @property
    def spans(self) -> tuple[tuple[str, ...], ...]:
        """The plate of the three joints."""
        return ((*self.on, self.name),)

    def placed(self, bodies: tuple[RigidBody, ...]) -> tuple[RigidBody, ...]:
        """Return the bodies with the point on its body; unchanged where the two joints are on no one body.

        Unchanged, too, where the two joints are one point.
        """
        n = holding(bodies, self.on)
        if n is None or coincide(bodies[n], *self.on):
            return bodies
        start, end = (bodies[n][name] for name in self.on)
        place = start + (end - start) * share_of(bodies[n], self.on, self.at)
        return (*bodies[:n], {**bodies[n], self.name: place}, *bodies[n + 1 :])


@frozen
class Brace(Rigid):
    """A point of a body stated by its distances from two joints of it: a corner of a rigid triangle."""

    reach: tuple[float, float]

    sized: ClassVar[tuple[str, ...]] = ("at", "reach")

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """Its two bars."""
        return (self.on[0], self.reach[0]), (self.on[1], self.reach[1])

    @property
    def spans(self) -> tuple[tuple[str, ...], ...]:
        """Its two bars, which may be drawn as part of its body instead."""
        return tuple((start, self.name) for start in self.on)


def brace(dyad: RRR, frame: RigidBody) -> Brace:
    """Return two bars that stand on one body as the corner of a rigid triangle.

    With c from the first end to the second, the corner lies (c² + a² - b²)/(2c) along it and
    √(((a + b)² - c²)(c² - (a - b)²))/(2c) beside it, each rounded once; bars in one line have no height.
    """
    a, b, c = map(Fraction, (*dyad.lengths, abs(frame[dyad.ends[1]] - frame[dyad.ends[0]])))
    along = (c * c + a * a - b * b) / (2 * c)
    height = ((a + b) ** 2 - c * c) * (c * c - (a - b) ** 2) / (4 * c**4)
    beside = math.copysign(math.sqrt(max(height, Fraction(0))) * float(c), dyad.side)
    return Brace(dyad.name, dyad.ends, (float(along), beside), dyad.lengths)


# Joints that are given, not closed: fixed pins, crank pins, the slider that drives.


@frozen
class Polar(Stated):
    """Where a fixed pin lies as it was written: `length` at `angle` from `base`.

    `base` names a fixed pin; None is the origin of coordinates. Kept because a length that is
    read back from coordinates is rounded, and a change point depends on its last bit.
    """

    length: float
    angle: float
    base: str | None = None

    sized: ClassVar[tuple[str, ...]] = ("length",)


@frozen
class Pin(Joint):
    """A fixed pin on the ground."""

    position: Point
    polar: Polar | None = None

    fixed: ClassVar[bool] = True
    sized: ClassVar[tuple[str, ...]] = ("position", "polar")

    @property
    def stated_lengths(self) -> tuple[float, ...]:
        """Its coordinates."""
        return self.position

    def seen_from(self, x: float, y: float) -> Pin:
        """Return the pin as it lies from a place; as a length from (0, 0) it is not written any more."""
        polar = self.polar if self.polar and self.polar.base else None
        return replace(self, position=(self.position[0] - x, self.position[1] - y), polar=polar)

    def placed(self, bodies: tuple[RigidBody, ...]) -> tuple[RigidBody, ...]:
        """Return the bodies with the pin on the ground."""
        return ({**bodies[0], self.name: complex(*self.position)}, *bodies[1:])


class Gear(NamedTuple):
    """A gear pair: angle = ratio × (angle of the crank `mate`) + offset.

    Its teeth press on each other at `pressure_angle` from the common tangent of its pitch circles. A `motor`
    of its own, as many times as fast, may turn the crank instead.
    """

    mate: str
    ratio: Fraction
    offset: float = 0.0
    pressure_angle: float = math.radians(20)
    motor: bool = False


@frozen
class Crank(Joint):
    """A pin that turns about the fixed pin `pivot`: the input; or about any joint, geared to another crank.

    The angle of a geared crank is absolute, also of one whose pivot moves: a planet.
    """

    pivot: str
    length: float
    gear: Gear | None = None

    sized: ClassVar[tuple[str, ...]] = ("length",)

    @property
    def needs(self) -> tuple[str, ...]:
        """Its pivot, and the crank that it is geared to."""
        return (self.pivot, self.gear.mate) if self.gear else (self.pivot,)

    @property
    def bars(self) -> tuple[tuple[str, float], ...]:
        """The crank."""
        return ((self.pivot, self.length),)


@frozen
class DrivenSlider(Guided):
    """A slider on the fixed `line`; the drive gives its travel, from the joint that the line runs through."""

    line: Line

    sized: ClassVar[tuple[str, ...]] = ("line",)

    @property
    def driven_slide(self) -> Slide:
        """How it slides."""
        return self.slides[0]


# What moves a linkage, as data: a motor on its crank, a cylinder, a slider; and what tells where it is.


_STRUT_TITLES = {
    "spring": to_say("Spring {name}"),
    "damper": to_say("Damper {name}"),
    "cylinder": to_say("Cylinder {name}"),
}


class Coordinate(NamedTuple):
    """The coordinate of the input: an angle in radians, or a travel in the scene's unit of length.

    `name` is its word and its key in JSON, `letter` its symbol, `velocity` the words for its rate. In `unit`,
    `{}` stands for the unit of length.
    """

    name: str
    letter: str
    unit: str
    velocity: str

    @property
    def is_angle(self) -> bool:
        """Whether it comes round again after a whole turn."""
        return self.unit == "rad"

    @property
    def rate_token(self) -> str:
        """The token of its rate among the quantities."""
        return f"input.{self.velocity.replace(' ', '_')}"

    def displayed(self, value: Any) -> Any:
        """Return a value, or an array of them, as people read it: angles in degrees."""
        return value * (180.0 / math.pi) if self.is_angle else value

    def display_unit(self, length_unit: str) -> str:
        """Return the unit that goes with `displayed`."""
        return "°" if self.is_angle else length_unit

    def text(self, value: float, length_unit: str, step: float) -> str:
        """Return a value in words, to that step: 87.0°, 12.5 mm."""
        return stepped(self.displayed(value), step) + ("°" if self.is_angle else f" {length_unit}")


ANGLE = Coordinate(to_say("angle"), "θ", "rad", to_say("angular velocity"))
TRAVEL = Coordinate(to_say("travel"), "s", "{}", to_say("velocity"))


@frozen
class Actuator(Stated):
    """What drives the input; this class itself is a motor on the crank.

    `effort` is what it delivers, and its unit. `noun` is the input's name where no bar turns; `moves` says
    that it turns back, and where, `cycles` is the plural by which its ways there and back are counted;
    `linkage_name` is the class of a linkage without dyads.
    """

    coordinate: ClassVar[Coordinate] = ANGLE
    effort: ClassVar[tuple[str, str]] = (to_say("torque"), "N m")
    noun: ClassVar[str | None] = None
    moves: ClassVar[str] = to_say("swings {ends}")
    cycles: ClassVar[str] = "swings"
    linkage_name: ClassVar[str | None] = None

    @property
    def along(self) -> tuple[str, str] | None:
        """The two joints whose distance it changes; None where it drives a joint itself."""
        return None

    def at_ends(self, unit: str) -> str:
        """Return how its stroke stops the input at both ends, as a clause; empty where it has no stroke."""
        return ""


@frozen
class Cylinder(Actuator):
    """A cylinder that turns the crank: its length runs from `first` to `last` and back.

    `between` is a fixed pin and a joint of the crank's body.
    """

    between: tuple[str, str]
    first: float
    last: float

    sized: ClassVar[tuple[str, ...]] = ("first", "last")
    effort: ClassVar[tuple[str, str]] = ("force", "N")
    linkage_name: ClassVar[str | None] = to_say("crank driven by a cylinder")

    @property
    def along(self) -> tuple[str, str]:
        """The two joints whose distance it changes."""
        return self.between

    def at_ends(self, unit: str) -> str:
        """Return the lengths between which it runs."""
        return said(
            "the cylinder {ends} is {first} {unit} long at one end and {last} {unit} at the other",
            ends="–".join(self.between),
            first=short(self.first),
            last=short(self.last),
            unit=unit,
        )


class CrankTriangle(NamedTuple):
    """The triangle that a cylinder makes with its crank: two sides from the crank's pivot.

    These lead to the cylinder's two joints. The crank's angle is `base` (rad) plus `side`, +1 or -1, times
    the angle between them.
    """

    sides: tuple[float, float]
    base: float
    side: int


@frozen
class Travel(Actuator):
    """How far the slider that drives the linkage travels along its line: from `first` to `last` and back."""

    first: float
    last: float

    sized: ClassVar[tuple[str, ...]] = ("first", "last")
    coordinate: ClassVar[Coordinate] = TRAVEL
    effort: ClassVar[tuple[str, str]] = ("force", "N")
    noun: ClassVar[str | None] = "slider"
    moves: ClassVar[str] = to_say("slides {ends}")
    cycles: ClassVar[str] = "cycles"
    linkage_name: ClassVar[str | None] = to_say("slider")


@frozen
class Extension(Travel):
    """A cylinder between two links: its length, which is the input, goes from `first` to `last` and back."""

    between: tuple[str, str]

    noun: ClassVar[str | None] = "cylinder"
    moves: ClassVar[str] = to_say("runs")

    @property
    def along(self) -> tuple[str, str]:
        """The two joints whose distance it changes."""
        return self.between


MOTOR = Actuator()
"""What turns the crank itself."""


@frozen
class Drive(Stated):
    """What moves the linkage: the input's joint, its speed (rad/s, negative clockwise) and start (rad).

    Where a length runs there and back, `speed` is that of the phase, one there-and-back being 2π. `at_zero`
    says that a start of 0 was stated, and is not the default. With `retraced` an input that swings comes back
    by the way it came, on the same closure; else it runs through its limit onto the other one.
    """

    joint: str
    speed: float
    start: float = 0.0
    actuator: Actuator = MOTOR
    at_zero: bool = False
    retraced: bool = False

    sized: ClassVar[tuple[str, ...]] = ("actuator",)

    @property
    def coordinate(self) -> Coordinate:
        """What tells where the input is."""
        return self.actuator.coordinate

    @property
    def stated_start(self) -> float | None:
        """The start; None where none was stated."""
        return self.start if self.start or self.at_zero else None

    def check_angle(self, scene: str, way_out: str) -> None:
        """Raise BadInput where the input has no angle to be set; `way_out` says what to ask for instead."""
        if not self.coordinate.is_angle:
            noun = self.actuator.noun
            raise BadInput(f"{scene}: its input is a {noun}, which has no angle; {way_out}")


# What a linkage is: frozen values, lengths in the scene's unit, angles in radians, y up.
#
# Joints stand in the order in which they can be solved: each one names only joints before it.


@frozen
class Body(Stated):
    """A named body: its angle is that of first -> second joint; `com` is its centre of mass.

    `com` is (along first -> second joint, to the left of it) from the first joint. A body with
    `slider` instead of joints is the block that travels with that joint along its line. `mass` is in kg,
    `inertia` in kg·m² about the centre of mass; where one of them is None, forces leave it out.
    """

    name: str
    joints: tuple[str, ...] = ()
    com: Point | None = None
    slider: str | None = None
    mass: float | None = None
    inertia: float | None = None

    sized: ClassVar[tuple[str, ...]] = ("com",)

    @property
    def forceful(self) -> bool:
        """Whether it takes a force to move it."""
        return self.mass is not None or self.inertia is not None


@frozen
class Spring:
    """A spring between two joints; `stiffness` in N/m, `free_length` in the scene's unit.

    Both are None where the force is not known.
    """

    name: str
    between: tuple[str, str]
    stiffness: float | None = None
    free_length: float | None = None

    @property
    def forceful(self) -> bool:
        """Whether its force is known."""
        return self.stiffness is not None and self.free_length is not None


@frozen
class Damper:
    """A damper between two joints; `coefficient` in N·s/m, None where the force is not known."""

    name: str
    between: tuple[str, str]
    coefficient: float | None = None

    @property
    def forceful(self) -> bool:
        """Whether its force is known."""
        return self.coefficient is not None


@frozen
class Load(Stated):
    """A force (N) and a torque (N m, counter-clockwise) on the body `on`.

    The force acts in its joint `joint`; else `at`, along first -> second joint and to the left of that; of a
    block in the joint with which it slides. It is (x, y), or one that `turns` with its body: along first ->
    second joint, or along a block's line, and to the left.

    With `places`, which rise, it is so many times as large as the `values` there say, linearly between them:
    places of the input's angle (rad), period a turn, or, `over_travel`, of a block's travel, the first and
    the last value going on beyond them. Of a block a force may act `against` its motion, or in a `way` alone:
    +1 while it moves along its line, -1 while it moves back; then there is none where the block rests.
    """

    name: str
    on: str
    joint: str = ""
    at: Point | None = None
    force: Point = (0.0, 0.0)
    torque: float = 0.0
    turns: bool = False
    places: tuple[float, ...] = ()
    values: tuple[float, ...] = ()
    over_travel: bool = False
    against: bool = False
    way: int = 0

    sized: ClassVar[tuple[str, ...]] = ("at",)


class Driven(NamedTuple):
    """What the drive moves: a crank about its pivot, a slider, or a link about one that moves itself.

    `body` is the crank's body, None where no named body has the crank. Of a slider or a cylinder it is None,
    and `pivot` "". Towards `base` from the pivot the input's angle is 0; None where that is to the right.
    """

    joint: Joint
    pivot: str
    body: Body | None
    base: str | None = None


@frozen
class Linkage(Stated):
    """A planar linkage with one input."""

    joints: tuple[Joint, ...]
    drive: Drive
    bodies: tuple[Body, ...] = ()
    springs: tuple[Spring, ...] = ()
    dampers: tuple[Damper, ...] = ()
    metre: float = field(default=1.0)
    """One unit of length in metres (0.001 for mm); forces need it."""
    gravity: float = 0.0
    """The acceleration of gravity (m/s², downwards); 0 where the scene states none."""
    static: bool = False
    """Whether forces are those at rest: masses have weight, but no inertia."""
    loads: tuple[Load, ...] = ()

    sized: ClassVar[tuple[str, ...]] = ("joints", "bodies", "drive", "loads")

    @property
    def unit(self) -> str:
        """The unit of its lengths, as in sentences."""
        return unit_of(self.metre)

    @property
    def forceful(self) -> bool:
        """Whether the input has to drive anything: a spring or damper of known force, a mass, or a load.

        With several motors no force tells what each of them delivers.
        """
        struts = self.springs + self.dampers
        return not self.motors and (
            bool(self.loads)
            or any(strut.forceful for strut in struts)
            or any(body.forceful for body in self.bodies)
        )

    @cached_property
    def reacting(self) -> bool:
        """Whether forces in its joints are worked out: it has any, and all its joints tell theirs."""
        return self.forceful and all(joint.reacts for joint in self.joints)

    @cached_property
    def slides(self) -> dict[str, Slide]:
        """Map each joint that travels along a line to how it slides."""
        return {joint.name: joint.slides[0] for joint in self.joints if joint.travels}

    @staticmethod
    def strut_word(strut: Spring | Damper) -> str:
        """Return what a strut is called: a damper of which no force is known is a cylinder."""
        if isinstance(strut, Spring):
            return "spring"
        return "damper" if strut.forceful else "cylinder"

    def strut_words(self, strut: Spring | Damper) -> str:
        """Return a strut's name and sort, "return spring"; the name alone where it has that word in it."""
        word = self.strut_word(strut)
        if word in strut.name.lower().split():
            return name_said(strut.name)
        return said("{name} {sort}", name=name_said(strut.name), sort=name_said(word))

    def strut_title(self, strut: Spring | Damper) -> str:
        """Return what a strut is called in a heading: "Spring return"."""
        return said(_STRUT_TITLES[self.strut_word(strut)], name=name_said(strut.name))

    def joint(self, name: str) -> Joint:
        """Return the joint of that name; KeyError where there is none."""
        return self.by_name[name]

    def pin(self, name: str) -> Pin:
        """Return the fixed pin of that name, which must be one."""
        joint = self.by_name[name]
        assert isinstance(joint, Pin)
        return joint

    def crank(self, name: str) -> Crank:
        """Return the crank whose pin has that name, which must be one."""
        joint = self.by_name[name]
        assert isinstance(joint, Crank)
        return joint

    @property
    def longest(self) -> float:
        """The longest length that a joint's definition states; where none does, the drive's longest, or 1."""
        stated = max((abs(length) for joint in self.joints for length in joint.stated_lengths), default=0.0)
        return stated or max(map(abs, self.drive.actuator.stated_lengths), default=0.0) or 1.0

    @cached_property
    def origin(self) -> Point:
        """A place among the pins from which all is solved, where they lie far from (0, 0); else that itself.

        A coordinate is far where it exceeds `FAR` times the linkage's size: then its distance from that of
        another pin is exact.
        """
        moving = (joint for joint in self.joints if not joint.fixed)
        size = math.fsum(abs(length) for joint in moving for length in joint.stated_lengths)
        axes = [[pin.position[axis] for pin in self.pins] or [0.0] for axis in (0, 1)]
        size += sum(max(along) - min(along) for along in axes)
        x, y = (along[0] if min(map(abs, along)) > FAR * size else 0.0 for along in axes)
        return x, y

    @cached_property
    def near(self) -> Linkage:
        """The linkage with its pins as seen from `origin`."""
        if self.origin == (0.0, 0.0):
            return self
        x, y = self.origin
        return replace(self, joints=tuple(joint.seen_from(x, y) for joint in self.joints))

    @cached_property
    def extent(self) -> float:
        """The sum of all lengths, which bounds every joint's distance from `origin`; 1 without any."""
        return math.fsum(map(abs, self.near.stated_lengths)) or 1.0

    @cached_property
    def by_name(self) -> dict[str, Joint]:
        """Map each joint's name to the joint."""
        return {joint.name: joint for joint in self.joints}

    @cached_property
    def driven(self) -> Driven:
        """What the drive moves."""
        joint = self.by_name[self.drive.joint]
        if not self.drive.coordinate.is_angle:
            return Driven(joint, "", None)
        if joint.motor is not None:
            link, base = joint.motor
            body = next((one for one in self.bodies if one.name == link), None)
            return Driven(joint, joint.name, body, base)
        assert isinstance(joint, Crank)
        ends = {joint.pivot, joint.name}
        return Driven(joint, joint.pivot, next((one for one in self.bodies if ends <= set(one.joints)), None))

    def body(self, name: str) -> Body:
        """Return the body of that name; KeyError where there is none."""
        return next(body for body in self.bodies if body.name == name)

    @cached_property
    def unsized(self) -> Linkage:
        """The linkage with every length 0, which is equal for linkages that differ in lengths alone."""
        return self.with_lengths(repeat(0.0))

    @cached_property
    def rigid_bodies(self) -> tuple[RigidBody, ...]:
        """The rigid bodies, the ground first: where each one's joints lie in its own frame."""
        return rigid_bodies(self.joints)

    @cached_property
    def radii(self) -> dict[str, float]:
        """How far each joint is from the fixed pin that it turns about; infinite where its line is fixed."""
        radii = {slide.point: math.inf for joint in self.joints for slide in joint.slides if not slide.start}
        for frame in self.rigid_bodies[1:]:
            if (pivot := self.pivot(frame)) is not None:
                radii |= {name: abs(place - frame[pivot]) for name, place in frame.items() if name != pivot}
        return {name: radius for name, radius in radii.items() if radius}

    def pivot(self, names: Iterable[str]) -> str | None:
        """Return the fixed pin of the rigid body with these joints; None where it has none, or several."""
        n = holding(self.rigid_bodies, names)
        pins = [pin.name for pin in self.pins if n and pin.name in self.rigid_bodies[n]]
        return pins[0] if len(pins) == 1 else None

    @cached_property
    def _through(self) -> dict[str, frozenset[str]]:
        """Map each joint that moves to the joints through which all of its motion runs, itself among them."""
        supports: dict[str, frozenset[str]] = {}
        for joint in self.joints:
            if not joint.fixed:
                before = [supports[name] for name in joint.needs if name in supports]
                # a gear turns with the input, whatever its pivot does
                geared = isinstance(joint, Crank) and joint.gear is not None
                shared = frozenset.intersection(*before) if before and not geared else frozenset()
                supports[joint.name] = frozenset() if joint.grouped else shared | {joint.name}
        return supports

    def movers(self, names: Iterable[str]) -> tuple[str, ...]:
        """Return the joints by which alone these joints are moved, the nearest first.

        Each is on a fixed circle or line, so that everything behind it follows from how far it has gone along
        that. A driven crank, which is the input itself, is none of them.
        """
        through = [self._through[name] for name in names if name in self._through]
        shared = frozenset.intersection(*through) if through else frozenset()
        own = self.driven.joint
        led = shared & self.radii.keys() - ({own.name} if isinstance(own, Crank) else set())
        return tuple(joint.name for joint in reversed(self.joints) if joint.name in led)

    @property
    def motors(self) -> tuple[str, ...]:
        """The cranks that further motors turn."""
        return tuple(crank.name for crank in self.cranks if crank.gear and crank.gear.motor)

    @property
    def cranks(self) -> Iterator[Crank]:
        """The cranks in the order of the joints, the input among them."""
        return (joint for joint in self.joints if isinstance(joint, Crank))

    def crank_of(self, body: Body) -> Crank | None:
        """Return the crank whose bar a body is: of the input, or of one geared to it; None of others."""
        ends = set(body.joints[:2])
        return next((crank for crank in self.cranks if ends == {crank.pivot, crank.name}), None)

    @property
    def pins(self) -> Iterator[Pin]:
        """The fixed pins in the order of the joints."""
        return (joint for joint in self.joints if isinstance(joint, Pin))
