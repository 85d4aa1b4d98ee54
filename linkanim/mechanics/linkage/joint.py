"""What a joint is, whatever its kind: what all kinds have, and the lines along which sliders travel.

Joints stand in the order in which they can be solved: each one names only joints before it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, ClassVar, NamedTuple, Self

Point = tuple[float, float]

RigidBody = dict[str, complex]
"""Where the joints of one rigid body lie in its own frame, as x + yi."""


class Stated:
    """What is stated by lengths: the fields named `sized` hold them, or what is itself made of them."""

    __slots__ = ()
    sized: ClassVar[tuple[str, ...]] = ()

    @property
    def lengths(self) -> tuple[float, ...]:
        """All of them, of either sign."""
        return tuple(length for name in self.sized for length in _lengths_in(getattr(self, name)))

    def scaled(self, factor: float) -> Self:
        """Return the same with every length times a factor."""
        return replace(self, **{name: _times(getattr(self, name), factor) for name in self.sized})  # type: ignore[type-var]


def _lengths_in(value: Any) -> Iterator[float]:
    if isinstance(value, tuple):
        yield from (length for part in value for length in _lengths_in(part))
    elif value is not None:
        yield from value.lengths if isinstance(value, Stated) else (value,)


def _times(value: Any, factor: float) -> Any:
    if isinstance(value, tuple):
        return tuple(_times(part, factor) for part in value)
    if value is None:
        return None
    return value.scaled(factor) if isinstance(value, Stated) else value * factor


@dataclass(frozen=True, slots=True)
class Line(Stated):
    """A line of travel: through the joint `through`, at `angle`, shifted by `offset` to its left.

    A fixed line runs through a fixed pin, its angle is absolute. One that is carried names two joints of
    the body that carries it, `on`; `through` is a joint of that body, and the angle is from on[0] -> on[1].
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
    """What slides: the joint `point`, along a line; `start` is a joint of the guide, None of the ground."""

    point: str
    start: str | None
    line: Line

    @property
    def axis(self) -> tuple[str, str] | None:
        """Two joints of the guide; None where it does not turn, and its angle is absolute."""
        return self.line.on

    @property
    def angle(self) -> float:
        """The line's direction from the guide's axis (rad)."""
        return self.line.angle


@dataclass(frozen=True, slots=True)
class Joint(Stated):
    """A joint: how it is found from joints before it.

    A `dyad` is closed from two constraints, which meet in two points as a rule: `sides` names the two
    closures, +1 first. One that `travels` moves along a line. `fixed` ones belong to the ground.
    """

    name: str

    sides: ClassVar[tuple[str, str] | None] = None
    dyad: ClassVar[bool] = False
    travels: ClassVar[bool] = False
    fixed: ClassVar[bool] = False

    @property
    def needs(self) -> tuple[str, ...]:
        """The joints that this one is found from."""
        return ()

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
        """The joints of every rigid length that the joint's definition states."""
        return tuple((start, self.name) for start, _ in self.bars)

    @property
    def pins(self) -> tuple[str, ...]:
        """The joints in which the definition makes bars turn on each other: its bars' ends."""
        return (*(start for start, _ in self.bars), self.name) if self.bars else ()

    @property
    def slides(self) -> tuple[Slide, ...]:
        """What the definition makes slide, and along what."""
        return ()

    @property
    def named_sign(self) -> int | None:
        """The sign of the closure's root where the closure named holds; None where there is no root."""
        return None

    @property
    def named_from(self) -> tuple[int, str, str, str] | None:
        """What names the closure, if not its own side: (+1 left or -1, b, p, q) of b beside p -> q."""
        return None

    def placed(self, bodies: tuple[RigidBody, ...]) -> tuple[RigidBody, ...]:
        """Return the rigid bodies with the joint in them: a body of its own for each of its bars."""
        return (*bodies, *({start: 0j, self.name: complex(length)} for start, length in self.bars))

    def why_apart(self, u: float, w: float, unit: str) -> str:
        """Say in words and numbers why it cannot be assembled at any angle of the input.

        `u` and `w` are the greatest that its root's factors come to.
        """
        return "it cannot be assembled"

    @property
    def at_limit(self) -> str:
        """How a dyad stands where it closes no farther, as a clause; empty for what always closes."""
        return ""

    def transmission(self, u: float, w: float) -> float | None:
        """Return a dyad's transmission angle where its root's factors are U and W; None of other joints."""
        return None

    def transmission_at(self, way: Callable[[str, str], tuple[Any, Any]]) -> Any:
        """Return a dyad's transmission angle where `way` leads from joint to joint: x, y, floats or arrays.

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
