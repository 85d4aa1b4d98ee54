"""What a joint is, whatever its kind: the questions that all kinds answer, one file a kind in `kinds`.

Joints stand in the order in which they can be solved: each one names only joints before it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple, Self

if TYPE_CHECKING:
    from linkanim.mechanics.closing.assembly import Assembly
    from linkanim.mechanics.closing.walk import Walk
    from linkanim.mechanics.linkage.linkage import Linkage
    from linkanim.mechanics.loops.loop import Gearing, Loop

Point = tuple[float, float]

Frame = dict[str, complex]
"""Where the joints of one rigid body lie in the body's own frame, as x + yi."""


class Need(NamedTuple):
    """A joint that another one is found from: the key that names it in a scene file, and what it must be."""

    key: str
    joint: str
    must: Literal["", "fixed", "crank"] = ""


class Slide(NamedTuple):
    """What slides: the joint `point`, along a guide at `angle` (rad) from the guide's axis.

    `start` is a joint of the guide's body, None of the ground; `axis` are two of its joints, None where the
    guide does not turn, whose angle is then absolute.
    """

    point: str
    start: str | None
    axis: tuple[str, str] | None
    angle: float


@dataclass(frozen=True, slots=True)
class Joint(ABC):
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
    def needs(self) -> tuple[Need, ...]:
        """The joints that this one is found from."""
        return ()

    @property
    def moved_by(self) -> tuple[Need, ...]:
        """Those of its needs of which at least one must move, or nothing would."""
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
        """The joints in which the definition makes bars turn on each other."""
        return ()

    @property
    def slides(self) -> tuple[Slide, ...]:
        """What the definition makes slide, and along what."""
        return ()

    @property
    def lengths(self) -> tuple[float, ...]:
        """All lengths of the definition, of either sign."""
        return tuple(length for _, length in self.bars)

    @property
    def named_sign(self) -> int | None:
        """The sign of the closure's root where the closure named holds; None where there is no root."""
        return None

    @property
    def named_from(self) -> tuple[int, str, str, str] | None:
        """What names the closure, if not its own side: (+1 left or -1, b, p, q) of b beside p -> q."""
        return None

    @abstractmethod
    def scaled(self, factor: float) -> Self:
        """Return the joint with every length times a factor."""

    @abstractmethod
    def close(self, walk: Walk) -> None:
        """Add the joint's motion, and its bars', to the walk."""

    def loop(self, linkage: Linkage, gears: Mapping[str, Gearing]) -> Loop | None:
        """Return the loop that the joint closes from a crank pin and fixed elements, if it does."""
        return None

    def placed(self, frames: tuple[Frame, ...]) -> tuple[Frame, ...]:
        """Return the bodies' frames with the joint in them: a frame of its own for each of its bars."""
        return (*frames, *({start: 0j, self.name: complex(length)} for start, length in self.bars))

    def linkage_name(self, assembly: Assembly) -> str | None:
        """Return the class of a linkage whose only dyad this is; None where the kind has no name for it."""
        return None

    def why_apart(self, u: float, w: float) -> str:
        """Say in words and numbers why it cannot be assembled at any angle of the input.

        `u` and `w` are the greatest that its root's factors come to.
        """
        return "it cannot be assembled"

    def transmission(self, u: float, w: float) -> float | None:
        """Return a dyad's transmission angle where its root's factors are U and W; None of other joints."""
        return None

    def transmission_at(self, place: Callable[[str], Any]) -> Any:
        """Return a dyad's transmission angle where `place` gives joints as x + yi, floats or arrays.

        None of other joints.
        """
        return None
