"""What moves a linkage, as data: a motor on its crank, a cylinder, a slider; and what tells where it is."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from linkanim.digits import short, stepped
from linkanim.errors import BadInput
from linkanim.mechanics.linkage.joint import Stated


@dataclass(frozen=True, slots=True)
class Coordinate:
    """What tells where the input is: an angle in radians, or a travel in the scene's unit of length.

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

    def shown(self, value: Any) -> Any:
        """Return a value, or an array of them, as people read it: angles in degrees."""
        return value * (180.0 / math.pi) if self.is_angle else value

    def shown_unit(self, length_unit: str) -> str:
        """Return the unit that goes with `shown`."""
        return "°" if self.is_angle else length_unit

    def text(self, value: float, length_unit: str, step: float) -> str:
        """Return a value in words, to that step: 87.0°, 12.5 mm."""
        return stepped(self.shown(value), step) + ("°" if self.is_angle else f" {length_unit}")


ANGLE = Coordinate("angle", "θ", "rad", "angular velocity")
TRAVEL = Coordinate("travel", "s", "{}", "velocity")


@dataclass(frozen=True, slots=True)
class Actuator(Stated):
    """What drives the input: as it is, a motor on the crank.

    `effort` is what it delivers, and its unit. `noun` is the input's name where it is no bar that turns;
    `moves` says what an input does that turns back, `cycles` what each way there and back is counted as;
    `linkage_name` is the class of a linkage that has nothing else.
    """

    coordinate: ClassVar[Coordinate] = ANGLE
    effort: ClassVar[tuple[str, str]] = ("torque", "N m")
    noun: ClassVar[str | None] = None
    moves: ClassVar[str] = "swings"
    cycles: ClassVar[str] = "swings"
    linkage_name: ClassVar[str | None] = None

    @property
    def along(self) -> tuple[str, str] | None:
        """The two joints whose distance it changes; None where it drives a joint itself."""
        return None

    def at_ends(self, unit: str) -> str:
        """Return how it ends the way of an input that turns, as a clause; empty for what has no stroke."""
        return ""


@dataclass(frozen=True, slots=True)
class Cylinder(Actuator):
    """A cylinder that turns the crank: its length runs from `first` to `last` and back.

    `between` is a fixed pin and a joint of the crank's body.
    """

    between: tuple[str, str]
    first: float
    last: float

    sized: ClassVar[tuple[str, ...]] = ("first", "last")
    effort: ClassVar[tuple[str, str]] = ("force", "N")
    linkage_name: ClassVar[str | None] = "crank driven by a cylinder"

    @property
    def along(self) -> tuple[str, str]:
        """The two joints whose distance it changes."""
        return self.between

    def at_ends(self, unit: str) -> str:
        """Return the lengths between which it runs."""
        lengths = f"{short(self.first)} {unit} long at one end and {short(self.last)} {unit} at the other"
        return f"the cylinder {'–'.join(self.between)} is {lengths}"


@dataclass(frozen=True, slots=True)
class Travel(Actuator):
    """How far the slider that drives the linkage travels along its line: from `first` to `last` and back."""

    first: float
    last: float

    sized: ClassVar[tuple[str, ...]] = ("first", "last")
    coordinate: ClassVar[Coordinate] = TRAVEL
    effort: ClassVar[tuple[str, str]] = ("force", "N")
    noun: ClassVar[str | None] = "slider"
    moves: ClassVar[str] = "slides"
    cycles: ClassVar[str] = "cycles"
    linkage_name: ClassVar[str | None] = "slider"


MOTOR = Actuator()
"""What turns the crank itself."""


@dataclass(frozen=True, slots=True)
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
        """Raise BadInput for the angle of an input that has none."""
        if not self.coordinate.is_angle:
            noun = self.actuator.noun
            raise BadInput(f"{scene}: its input is a {noun}, which has no angle; {way_out}")
