"""What an answer has to keep to: where pivots lie, how long links are, which values are given."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from linkanim.errors import BadInput
from linkanim.synthesis.kinds import LinkageKind, Real
from linkanim.units import shown

LEAST_ANGLE = math.radians(0.1)
"""Below this transmission angle a linkage is all but at a change point: no answer goes there."""
MOST_ANSWERS = 50
SHORTEST = 1e-3
"""Of a link, in curve sizes."""


@dataclass(frozen=True, eq=False)
class Requirements:
    """Limits in the units of the points they go with.

    `least_angle` is the transmission angle asked for, 0 where none is, and above `LEAST_ANGLE` all the same;
    `box` is x, y, width and height, in which all pivots lie; `given` are values of parameters that stay;
    `full_turn` says whether the crank has to turn fully.
    """

    largest: float
    shortest: float
    least_angle: float = 0.0
    box: tuple[float, ...] | None = None
    given: Mapping[str, float] = field(default_factory=dict)
    full_turn: bool = True

    @classmethod
    def of(
        cls,
        size: float,
        sizes: str,
        *,
        largest: float,
        least_angle: float,
        box: Sequence[float] | None,
        given: Mapping[str, float] | None = None,
    ) -> Self:
        """Return limits as they are asked for, the longest link in `sizes`; BadInput where they are none."""
        if not (math.isfinite(largest) and largest > 0):
            raise BadInput(f"largest={largest!r}: give the longest link in {sizes}, a number such as 3")
        if not 0 <= least_angle < math.pi / 2:
            angle = math.degrees(least_angle)
            raise BadInput(f"a least transmission angle of {angle:g} deg: give 0 to 90 deg")
        return cls(
            largest=largest * size,
            shortest=SHORTEST * size,
            least_angle=least_angle,
            box=None if box is None else _box(box),
            given=given or {},
        )

    def slack(self, kind: LinkageKind, rows: Real) -> Real:
        """Return (B, m), negative for each limit that is broken; the two of a full turn come first."""
        turning = [kind.slack(rows, self.angle_to_keep("angle"))] if self.full_turn else []
        lengths = kind.link_lengths(rows)
        limits = [self.largest - lengths, lengths - self.shortest]
        if self.box is not None:
            x, y, width, height = self.box
            pivots = kind.pivots(rows)
            limits += [pivots.real - x, x + width - pivots.real, pivots.imag - y, y + height - pivots.imag]
        return np.concatenate([*turning, *limits], axis=1)

    def angle_to_keep(self, by: str) -> float:
        """Return the least transmission angle of an answer that goes along the curve by its crank's "angle".

        One that goes by "phase", through its limits, keeps what is asked for only: there it is 0.
        """
        return max(self.least_angle, LEAST_ANGLE) if by == "angle" else self.least_angle

    def held(self, kind: LinkageKind) -> tuple[Real, Real]:
        """Return which parameters are given, as a mask, and their values (0 for the others)."""
        mask = np.array([float(name in self.given) for name in kind.parameters])
        return mask, np.array([float(self.given.get(name, 0.0)) for name in kind.parameters])

    def placed(self, shift: complex, scale: float) -> Requirements:
        """Return the same in coordinates whose origin is `shift` and whose unit is `scale`."""

        def placed(name: str, value: float) -> float:
            """Return a parameter's value in those coordinates."""
            if name == "line_angle":
                return value
            return (value - {"x": shift.real, "y": shift.imag}.get(name[0], 0.0)) / scale

        box = self.box and tuple(map(placed, ("x", "y", "width", "height"), self.box))
        given = {name: placed(name, value) for name, value in self.given.items()}
        largest, shortest = self.largest / scale, self.shortest / scale
        return replace(self, largest=largest, shortest=shortest, box=box, given=given)


def refuse_count(count: int) -> None:
    """Refuse to make so many answers: BadInput for none, for too many, and for what is no whole number."""
    if not isinstance(count, int | np.integer) or not 1 <= count <= MOST_ANSWERS:
        raise BadInput(f"count={shown(count)}: give a whole number from 1 to {MOST_ANSWERS}")


def _box(box: Sequence[float]) -> tuple[float, float, float, float]:
    values = tuple(float(value) for value in box)
    if len(values) != 4 or not all(map(math.isfinite, values)):
        raise BadInput(f"box={shown(str(list(box)))}: give x, y, width and height, four numbers")
    x, y, width, height = values
    if width <= 0 or height <= 0:
        raise BadInput(f"the box is {width:g} wide and {height:g} high: nothing fits in it")
    return x, y, width, height
