"""Calculate many linkages at once whose coupler point runs along a path, and hold them to limits.

Its parts, in reading order:

- The linkages whose coupler point is to run along a path: a four-bar and a slider-crank, many at once.
- The limits on an answer: where pivots lie, how long links are, which values are given.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import field, replace
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from linkanim.bounds import NUMBERS, can_be_computed
from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.units import shown

# The linkages whose coupler point is to run along a path: a four-bar and a slider-crank, many at once.
#
# A row of parameters is a linkage; a closure is +1 (B left of A -> O4, or forward along the line) or -1. The
# pin is A = O2 + crank·e^(iθ), and B closes on the ground: N·B = c, where N is the normal of the path that B
# is held to (a circle about O4, or a line). For both kinds the derivatives of the coupler's angle, and so of
# the coupler point, by A, the rod and the ground follow from this one equation.

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]
Indices = NDArray[np.intp]


class TracedPoints(NamedTuple):
    """Coupler points (B, n) as x + yi, their rate with the crank's angle, and with each parameter (B, n, p).

    NaN where the linkage cannot be closed.
    """

    point: Complex
    rate: Complex
    slopes: Complex


_Closed = tuple[Complex, Complex, tuple[Complex | Real, ...]]
"""The coupler's direction, the normal N of B's path, and N·dB by each ground parameter: (B, n)."""


class LinkageKind(ABC):
    """A kind of linkage by its parameters, the first six of which all kinds have."""

    name: str
    parameters: tuple[str, ...]
    links: tuple[str, ...]
    """The parameters that are lengths of links, above zero."""
    pins: tuple[int, ...]
    """The column of each fixed pin's x; its y is in the next one."""
    carried = False
    """Whether the ground of B moves with the pin O2."""
    sides: tuple[str, str]
    """What the closures +1 and -1 are called in a scene."""
    mirror: tuple[float, ...]
    """The factors of the parameters, and last of the closure, that mirror the linkage in the x axis."""
    output: str
    """The body on which a function's y is read."""
    reading: str
    """The quantity of a motion that is read there."""
    turning: bool
    """Whether that is an angle."""
    in_line: float
    """The crank's angle (rad) in a `standard` linkage, up to half turns, at which cos μ has an extreme."""

    @abstractmethod
    def close(self, rows: Real, closure: Real, pin: Complex) -> _Closed:
        """Close the coupler on the ground, with the pins A (B, n)."""

    @abstractmethod
    def margins(self, rows: Real, least_angle: float | Real) -> Real:
        """Return (B, 2), both positive where the crank turns fully above a least transmission angle."""

    @abstractmethod
    def closing(self, row: Mapping[str, float]) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
        """Return the tables of the fixed pins except O2, of the joint B, and of B's other body."""

    @abstractmethod
    def extreme(self, row: Real) -> float:
        """Return a crank angle at which the transmission angle is extreme, as it is half a turn further."""

    @abstractmethod
    def random_rows(self, random: np.random.Generator, count: int) -> Real:
        """Return linkages of all proportions with O2 at the origin, some of which turn fully."""

    @abstractmethod
    def link_lengths(self, rows: Real) -> Real:
        """Return the lengths of all links (B, m), with the coupler point's arms to A and, last, to B."""

    # A linkage that generates a function has a row (crank, coupler, rocker, input start, output start) or
    # (crank, rod, offset, input start, output start): its ground, or the slider's range, is of length 1.

    @abstractmethod
    def standard(self, rows: Real) -> Real:
        """Return a function's linkages by all parameters: O2 at the origin, ground or line along x."""

    @abstractmethod
    def through(self, inputs: Real, outputs: Real) -> Real:
        """Return the lengths (k, 3) by three places of input and output (k, 3), from a linear equation."""

    @abstractmethod
    def closures(self, rows: Real, inputs: Real, outputs: Real) -> Real:
        """Return the closures +1 or -1 (k, n) at movements of input and output that the linkage passes."""

    @abstractmethod
    def slopes(self, row: Real, inputs: Real, outputs: Real) -> Real:
        """Return the slopes (n, p) of a function's outputs by its parameters, from the start of its scale."""

    def outputs(self, rows: Real, closure: Real, inputs: Real, near: Real) -> tuple[Real, Real]:
        """Return the movement of the output (k, n) by that of the input, and cos μ; NaN if it cannot close.

        An angle is given in the turn in which it is nearest to `near`.
        """
        whole, first, last = self.standard(rows), rows[:, 3:4], rows[:, 4:5]
        pin, _ = _pins(whole, first + inputs)
        direction, normal, _ = self.close(whole, closure[:, None], pin)
        with np.errstate(invalid="ignore"):  # 0/0 where the pins of the last bar meet: there it has no angle
            cosine = _dot(direction, normal) / np.abs(normal)
        if not self.turning:
            return (pin + whole[:, 3:4] * direction).real - last, cosine
        turned = np.angle(normal * np.exp(-1j * last))
        return turned + math.tau * np.round((near - turned) / math.tau), cosine

    def document(
        self, row: Mapping[str, float], closure: float, *, traced: bool = True
    ) -> dict[str, dict[str, Any]]:
        """Return the tables [ground], [joints] and [bodies] of a scene with that linkage, P if `traced`."""
        pins, held, body = self.closing(row)
        point = {"P": {"on": ["A", "B"], "at": [row["along"], row["across"]]}} if traced else {}
        return {
            "ground": {"O2": [row["x"], row["y"]], **pins},
            "joints": {
                "A": {"crank": "O2", "length": row["crank"]},
                "B": {**held, "side": self.sides[closure < 0]},
                **point,
            },
            "bodies": {
                "crank": {"joints": ["O2", "A"]},
                self.links[1]: {"joints": ["A", "B", *point]},
                **body,
            },
        }

    def placed(self, rows: Real, turn: Complex, shift: Complex) -> Real:
        """Return the linkages turned and scaled by complex factors about the origin, then shifted."""
        out = rows * np.abs(turn)[:, None]
        for x, point in zip(self.pins, self.pivots(rows).T, strict=True):
            point = point * turn + shift
            out[:, x], out[:, x + 1] = point.real, point.imag
        return out

    def mirrored(self, rows: Real, closure: Real) -> tuple[Real, Real]:
        """Return the linkages and closures mirrored in the x axis; crank angles change their sign."""
        return rows * self.mirror[:-1], closure * self.mirror[-1]

    def pivots(self, rows: Real) -> Complex:
        """Return the fixed pins (B, m)."""
        return np.stack([rows[:, x] + 1j * rows[:, x + 1] for x in self.pins], axis=1)

    def points(self, rows: Real, closure: Real, angles: Real) -> Complex:
        """Return the coupler points (B, n) at crank angles (B, n), NaN where there are none."""
        pin, _ = _pins(rows, angles)
        return pin + _arm(rows) * self.close(rows, closure[:, None], pin)[0]

    def joints(self, rows: Real, closure: Real, angles: Real) -> Complex:
        """Return the fixed pins, then A, B and P at crank angles (B, n), side by side (B, m)."""
        pin, _ = _pins(rows, angles)
        direction = self.close(rows, closure[:, None], pin)[0]
        return np.concatenate(
            [self.pivots(rows), pin, pin + rows[:, 3:4] * direction, pin + _arm(rows) * direction], axis=1
        )

    def trace(self, rows: Real, closure: Real, angles: Real) -> TracedPoints:
        """Return the coupler points at crank angles, and all their first derivatives."""
        pin, spoke = _pins(rows, angles)
        direction, normal, grounds = self.close(rows, closure[:, None], pin)
        arm = _arm(rows)
        turn = 1j * arm * direction / (rows[:, 3:4] * _dot(normal, 1j * direction))

        def moved(step: Complex | complex) -> Complex:
            """Return how far the coupler point moves when the pin A moves by a step and B's path stays."""
            return step - turn * _dot(normal, step)

        one = np.ones_like(pin)
        base = (one, 1j * one) if self.carried else (moved(1.0), moved(1j))
        own = (moved(spoke), -turn * _dot(normal, direction), direction, 1j * direction)
        slopes = np.stack([*base, *own, *(turn * ground for ground in grounds)], axis=-1)
        return TracedPoints(pin + arm * direction, moved(1j * rows[:, 2:3] * spoke), slopes)


def _pins(rows: Real, angles: Real) -> tuple[Complex, Complex]:
    """Return the pins A, and the unit vectors along the crank."""
    spoke = np.cos(angles) + 1j * np.sin(angles)
    return rows[:, 0:1] + 1j * rows[:, 1:2] + rows[:, 2:3] * spoke, spoke


def _arm(rows: Real) -> Complex:
    return rows[:, 4:5] + 1j * rows[:, 5:6]


def _dot(a: Complex, b: Complex | complex) -> Real:
    return np.real(np.conj(a) * b)


def _assembled(random: np.random.Generator, crank: Real, coupler: Real, grounds: tuple[Real, ...]) -> Real:
    """Return rows about the origin with a coupler point somewhere about the coupler's middle."""
    reach = 2.0 * np.sqrt(random.random(len(crank))) * np.maximum(coupler, crank)
    turn = random.uniform(-np.pi, np.pi, len(crank))
    along, across = coupler / 2 + reach * np.cos(turn), reach * np.sin(turn)
    nothing = np.zeros(len(crank))
    return np.stack([nothing, nothing, crank, coupler, along, across, *grounds], axis=1)


def angle_of(cosine: Real) -> Real:
    """Return a transmission angle (rad) by its cosine, not negative; 0 of 1 and more."""
    return np.arctan2(np.sqrt(np.maximum((1 - cosine) * (1 + cosine), 0.0)), cosine)


def least_of_turn(crank: Real, coupler: Real, rocker: Real, ground: Real) -> Real:
    """Return the least transmission angle (rad) of four-bars whose cranks turn fully; 0 of others.

    It is extreme where the crank lies along the ground.
    """
    with np.errstate(all="ignore"):
        inner, outer = (coupler**2 + rocker**2 - (ground + sign * crank) ** 2 for sign in (-1, 1))
        return angle_of(np.maximum(np.abs(inner), np.abs(outer)) / (2 * coupler * rocker))


class FourBarKind(LinkageKind):
    """Crank, coupler and rocker, with a coupler point along A -> B and to its left."""

    name = "four-bar"
    parameters = ("x", "y", "crank", "coupler", "along", "across", "x4", "y4", "rocker")
    links = ("crank", "coupler", "rocker")
    pins = (0, 6)
    sides = ("left", "right")
    mirror = (1.0, -1.0, 1.0, 1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0)
    output, reading, turning, in_line = "rocker", "angle", True, 0.0

    def close(self, rows: Real, closure: Real, pin: Complex) -> _Closed:
        """Close two bars on the pin and the pivot O4, by the signed root of both factors."""
        pivot = rows[:, 6:7] + 1j * rows[:, 7:8]
        a, b = rows[:, 3:4], rows[:, 8:9]
        diagonal = pivot - pin
        square = diagonal.real**2 + diagonal.imag**2
        with np.errstate(all="ignore"):
            root = closure * np.sqrt(((a + b) ** 2 - square) * (square - (a - b) ** 2))
            direction = diagonal * (square + (a - b) * (a + b) + 1j * root) / (2 * square * a)
        normal = a * direction - diagonal
        return direction, normal, (normal.real, normal.imag, b)

    def link_lengths(self, rows: Real) -> Real:
        """Return crank, coupler, arm from A, rocker, ground, and arm from B."""
        ground = np.hypot(rows[:, 6] - rows[:, 0], rows[:, 7] - rows[:, 1])
        arm, other = np.hypot(rows[:, 4], rows[:, 5]), np.hypot(rows[:, 4] - rows[:, 3], rows[:, 5])
        return np.stack([rows[:, 2], rows[:, 3], arm, rows[:, 8], ground, other], axis=1)

    def margins(self, rows: Real, least_angle: float | Real) -> Real:
        """Return a margin for each extreme of the transmission angle, positive above the least angle."""
        crank, a, b = rows[:, 2], rows[:, 3], rows[:, 8]
        ground = np.hypot(rows[:, 6] - rows[:, 0], rows[:, 7] - rows[:, 1])
        share = 4 * a * b * np.sin(least_angle / 2) ** 2
        inner = (ground - crank) ** 2 - (a - b) ** 2 - share
        outer = (a + b) ** 2 - (ground + crank) ** 2 - share
        return np.stack([inner, outer], axis=-1)

    def extreme(self, row: Real) -> float:
        """Return the direction of the ground line."""
        return float(np.arctan2(row[7] - row[1], row[6] - row[0]))

    def random_rows(self, random: np.random.Generator, count: int) -> Real:
        """Return crank-rockers and drag-links: the crank or the ground the shortest of four lengths."""
        lengths = random.uniform(0.05, 1.0, (count, 4))
        lengths.sort(axis=1)
        order = 1 + random.permuted(np.tile(np.arange(3), (count, 1)), axis=1)
        longer = np.take_along_axis(lengths, order, axis=1)
        drags = random.random(count) < 0.35
        ground, crank = np.where(drags, (lengths[:, 0], longer[:, 0]), (longer[:, 0], lengths[:, 0]))
        return _assembled(random, crank, longer[:, 1], (ground, np.zeros(count), longer[:, 2]))

    def closing(self, row: Mapping[str, float]) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
        """Return the pivot O4, the two bars that meet in B, and the rocker."""
        return (
            {"O4": [row["x4"], row["y4"]]},
            {"from": ["A", "O4"], "length": [row["coupler"], row["rocker"]]},
            {"rocker": {"joints": ["O4", "B"]}},
        )

    def standard(self, rows: Real) -> Real:
        """Return four-bars whose ground is of length 1."""
        crank, coupler, rocker = rows[:, :3].T
        nothing = np.zeros(len(rows))
        parts = nothing, nothing, crank, coupler, nothing, nothing, nothing + 1.0, nothing, rocker
        return np.stack(parts, axis=1)

    def through(self, inputs: Real, outputs: Real) -> Real:
        """Solve Freudenstein's equation; a negative length is a link that points the other way."""
        cosines = np.stack([np.cos(outputs), -np.cos(inputs), np.ones_like(inputs)], axis=-1)
        solution = _solved(cosines, np.cos(inputs - outputs))
        with np.errstate(all="ignore"):
            crank, rocker = 1 / solution[:, 0], 1 / solution[:, 1]
            coupler = np.sqrt(1 + crank**2 + rocker**2 - 2 * crank * rocker * solution[:, 2])
        return np.asarray(np.stack([crank, coupler, rocker], axis=1))

    def closures(self, rows: Real, inputs: Real, outputs: Real) -> Real:
        """Return on which side of A -> O4 the pin B lies."""
        crank, _, rocker, first, last = (part[:, None] for part in rows.T)
        pin = crank * np.exp(1j * (first + inputs))
        end = 1 + rocker * np.exp(1j * (last + outputs))
        return np.where((np.conj(1 - pin) * (end - pin)).imag > 0, 1.0, -1.0)

    def slopes(self, row: Real, inputs: Real, outputs: Real) -> Real:
        """Differentiate |1 + r₄e^(iψ) - r₂e^(iθ)|² = r₃²."""
        crank, coupler, rocker, first, last = row
        theta, psi = first + inputs, last + outputs
        across, along = np.sin(psi - theta), np.cos(psi - theta)
        by_psi = -rocker * np.sin(psi) + crank * rocker * across
        by = (
            crank - np.cos(theta) - rocker * along,
            np.full_like(psi, -coupler),
            rocker + np.cos(psi) - crank * along,
            crank * np.sin(theta) - crank * rocker * across,
        )
        return np.stack([*(-part / by_psi for part in by), -np.ones_like(psi)], axis=-1)


class SliderCrankKind(LinkageKind):
    """Crank and rod, the rod's end on a line at an offset from O2, with a point of the rod."""

    name = "slider-crank"
    parameters = ("x", "y", "crank", "rod", "along", "across", "line_angle", "offset")
    links = ("crank", "rod")
    pins = (0,)
    carried = True
    sides = ("forward", "backward")
    mirror = (1.0, -1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, 1.0)
    output, reading, turning, in_line = "slider", "travel", False, math.pi / 2

    def close(self, rows: Real, closure: Real, pin: Complex) -> _Closed:
        """Close a rod on the pin and the line."""
        line = np.exp(1j * rows[:, 6:7])
        origin, rod = rows[:, 0:1] + 1j * rows[:, 1:2], rows[:, 3:4]
        place = (pin - origin) / line
        rise = rows[:, 7:8] - place.imag
        with np.errstate(all="ignore"):
            root = closure * np.sqrt((rod - rise) * (rod + rise))
        direction = line * (root + 1j * rise) / rod
        normal = np.broadcast_to(1j * line, pin.shape)
        return direction, normal, (place.real + root, np.ones_like(root))

    def link_lengths(self, rows: Real) -> Real:
        """Return crank, rod, and arms from A and B."""
        arm, other = np.hypot(rows[:, 4], rows[:, 5]), np.hypot(rows[:, 4] - rows[:, 3], rows[:, 5])
        return np.stack([rows[:, 2], rows[:, 3], arm, other], axis=1)

    def margins(self, rows: Real, least_angle: float | Real) -> Real:
        """Return a margin for the rod's steepest angle to either side, positive where it is allowed."""
        reach, offset = rows[:, 3] * np.cos(least_angle) - rows[:, 2], rows[:, 7]
        return np.stack([reach - offset, reach + offset], axis=-1)

    def extreme(self, row: Real) -> float:
        """Return the direction across the line."""
        return float(row[6]) + math.pi / 2

    def random_rows(self, random: np.random.Generator, count: int) -> Real:
        """Return slider-cranks with rods of up to five cranks, along the x axis."""
        rod = random.uniform(1.0, 5.0, count)
        offset = random.uniform(-1.0, 1.0, count) * (rod - 1.0)
        return _assembled(random, np.ones(count), rod, (np.zeros(count), offset))

    def placed(self, rows: Real, turn: Complex, shift: Complex) -> Real:
        """Turn, scale and shift the pivot, turn the line, scale the lengths."""
        out = super().placed(rows, turn, shift)
        out[:, 6] = rows[:, 6] + np.angle(turn)
        return out

    def closing(self, row: Mapping[str, float]) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
        """Return no further pin, the rod that ends on a line, and the slider."""
        angle = f"{row['line_angle']!r} rad" if row["line_angle"] else "0 deg"
        line = {"through": "O2", "angle": angle, "offset": row["offset"]}
        return {}, {"from": "A", "length": row["rod"], "line": line}, {"slider": {"slider": "B"}}

    def standard(self, rows: Real) -> Real:
        """Return slider-cranks."""
        crank, rod, offset = rows[:, :3].T
        nothing = np.zeros(len(rows))
        return np.stack([nothing, nothing, crank, rod, nothing, nothing, nothing, offset], axis=1)

    def through(self, inputs: Real, outputs: Real) -> Real:
        """Solve s² = 2r s cos θ + 2re sin θ + (l² - r² - e²), linear in three numbers of the lengths."""
        parts = np.stack([outputs * np.cos(inputs), np.sin(inputs), np.ones_like(inputs)], axis=-1)
        solution = _solved(parts, outputs**2)
        with np.errstate(all="ignore"):
            crank, offset = solution[:, 0] / 2, solution[:, 1] / solution[:, 0]
            rod = np.sqrt(solution[:, 2] + crank**2 + offset**2)
        return np.stack([crank, rod, offset], axis=1)

    def closures(self, rows: Real, inputs: Real, outputs: Real) -> Real:
        """Return whether the slider is ahead of the crank's pin, or behind."""
        crank, _, _, first, last = (part[:, None] for part in rows.T)
        return np.where(last + outputs > crank * np.cos(first + inputs), 1.0, -1.0)

    def slopes(self, row: Real, inputs: Real, outputs: Real) -> Real:
        """Differentiate (s - r cos θ)² + (e - r sin θ)² = l²."""
        crank, rod, offset, first, last = row
        cosine, sine = np.cos(first + inputs), np.sin(first + inputs)
        along, across = last + outputs - crank * cosine, offset - crank * sine
        by = (
            -cosine * along - sine * across,
            np.full_like(along, -rod),
            across,
            crank * (sine * along - cosine * across),
        )
        return np.stack([*(-part / along for part in by), -np.ones_like(along)], axis=-1)


def _solved(matrices: Real, right: Real) -> Real:
    """Return the solutions of linear equations (k, 3, 3), NaN where there is none."""
    sound = np.abs(np.linalg.det(matrices)) > 1e-12
    solutions = np.full(right.shape, np.nan)
    solutions[sound] = np.linalg.solve(matrices[sound], right[sound][..., None])[..., 0]
    return solutions


FOUR_BAR, SLIDER_CRANK = FourBarKind(), SliderCrankKind()
KINDS: Mapping[str, LinkageKind] = {kind.name: kind for kind in (FOUR_BAR, SLIDER_CRANK)}
"""The kinds by what `--kind` calls them."""


class Linkage4(NamedTuple):
    """A four-bar by its joints at one moment (x + yi), whose distances are the lengths of its bars."""

    O2: complex
    A: complex
    B: complex
    O4: complex
    P: complex

    @property
    def row(self) -> tuple[float, ...]:
        """Its parameters, in the order of `FOUR_BAR`."""
        arm = (self.P - self.A) * (self.B - self.A).conjugate() / abs(self.B - self.A)
        crank, coupler, rocker = abs(self.A - self.O2), abs(self.B - self.A), abs(self.B - self.O4)
        pins = self.O2.real, self.O2.imag, self.O4.real, self.O4.imag
        return (*pins[:2], crank, coupler, arm.real, arm.imag, *pins[2:], rocker)

    @property
    def closure(self) -> float:
        """+1 where B lies left of A -> O4, else -1."""
        across = ((self.O4 - self.A).conjugate() * (self.B - self.A)).imag
        return 1.0 if across >= 0 else -1.0

    @property
    def angle(self) -> float:
        """The crank's angle (rad)."""
        crank = self.A - self.O2
        return math.atan2(crank.imag, crank.real)

    @classmethod
    def of(cls, row: Real, angle: float) -> Self:
        """Return the joints of a row of closure +1 at a crank angle."""
        pin, pivot = FOUR_BAR.pivots(row[None])[0]
        crank = pin + row[2] * np.exp(1j * angle)
        direction = FOUR_BAR.close(row[None], np.ones((1, 1)), np.array([[crank]]))[0][0, 0]
        joints = pin, crank, crank + row[3] * direction, pivot, crank + complex(*row[4:6]) * direction
        return cls(*map(complex, joints))


# The limits on an answer: where pivots lie, how long links are, which values are given.

LEAST_ANGLE = math.radians(0.1)
"""The least transmission angle (rad) of any answer: below it a linkage is nearly at a change point."""
MOST_ANSWERS = 50
SHORTEST = 1e-3
"""The shortest length of a link, in curve sizes."""


Box = tuple[float, float, float, float]
"""The x, y, width and height of a rectangle."""


@frozen(eq=False)
class Requirements:
    """Limits on linkages, in the unit of their points.

    `least_angle` is the requested transmission angle, 0 for none; it is kept above `LEAST_ANGLE` in any case.
    `boxes` are one in which all pivots lie, or one for each of them; `given` are the values of parameters
    that stay; `full_turn` says whether the crank has to turn fully. Where many candidates are fitted at once,
    each may have a longest link (B, 1) and a least angle (B,) of its own.
    """

    largest: float | Real
    shortest: float
    least_angle: float | Real = 0.0
    boxes: tuple[Box, ...] = ()
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
        boxes: tuple[Box, ...] = (),
        given: Mapping[str, float] | None = None,
    ) -> Self:
        """Return the requested limits, the longest link in `sizes`; BadInput where one makes no sense."""
        if not (can_be_computed(largest) and largest > 0):
            raise BadInput(f"largest={largest!r}: give the longest link in {sizes}, a number such as 3")
        if not 0 <= least_angle < math.pi / 2:
            angle = math.degrees(least_angle)
            raise BadInput(f"a least transmission angle of {angle:g} deg: give 0 to 90 deg")
        return cls(
            largest=largest * size,
            shortest=SHORTEST * size,
            least_angle=least_angle,
            boxes=boxes,
            given=given or {},
        )

    def margins(self, kind: LinkageKind, rows: Real) -> Real:
        """Return by how much each limit is kept (B, m), negative if broken; a full turn's two come first."""
        turning = [kind.margins(rows, self.angle_to_keep("angle"))] if self.full_turn else []
        lengths = kind.link_lengths(rows)
        limits = [self.largest - lengths, lengths - self.shortest]
        if self.boxes:
            x, y, width, height = np.array(self.boxes).T
            pivots = kind.pivots(rows)
            limits += [pivots.real - x, x + width - pivots.real, pivots.imag - y, y + height - pivots.imag]
        return np.concatenate([*turning, *limits], axis=1)

    def angle_to_keep(self, by: str) -> float | Real:
        """Return the least transmission angle to keep, if the curve is followed by the crank's "angle".

        An answer that is moved by "phase", through the limits of its crank, has angle 0 there: it keeps only
        what is requested.
        """
        return np.maximum(self.least_angle, LEAST_ANGLE) if by == "angle" else self.least_angle

    def held(self, kind: LinkageKind) -> tuple[Real, Real]:
        """Return which parameters are given, as a mask, and their values (0 for the others)."""
        mask = np.array([float(name in self.given) for name in kind.parameters])
        return mask, np.array([float(self.given.get(name, 0.0)) for name in kind.parameters])

    def placed(self, shift: complex, scale: float) -> Requirements:
        """Return the limits in coordinates whose origin is `shift` and whose unit is `scale`."""

        def placed(name: str, value: float) -> float:
            """Return a parameter's value in those coordinates."""
            if name == "line_angle":
                return value
            return (value - {"x": shift.real, "y": shift.imag}.get(name[0], 0.0)) / scale

        boxes = tuple(
            (placed("x", x), placed("y", y), wide / scale, high / scale) for x, y, wide, high in self.boxes
        )
        given = {name: placed(name, value) for name, value in self.given.items()}
        largest, shortest = self.largest / scale, self.shortest / scale
        return replace(self, largest=largest, shortest=shortest, boxes=boxes, given=given)


def refuse_count(count: int) -> None:
    """Raise BadInput for a number of answers that is not whole, not positive, or too large."""
    if not isinstance(count, int | np.integer) or not 1 <= count <= MOST_ANSWERS:
        raise BadInput(f"count={shown(count)}: give a whole number from 1 to {MOST_ANSWERS}")


def holds(box: Sequence[float], pivot: complex) -> bool:
    """Tell whether a point lies in a box."""
    x, y, width, height = box
    return x <= pivot.real <= x + width and y <= pivot.imag <= y + height


def boxes_of(box: Sequence[float] | Sequence[Sequence[float]] | None) -> tuple[Box, ...]:
    """Return requested boxes, one or a list of them, as numbers.

    BadInput where one is not four numbers, or has no area.
    """
    if box is None or not len(box):
        return ()
    return tuple(map(_box_of, [box] if np.ndim(box[0]) == 0 else box))  # type: ignore[arg-type]


def _box_of(box: Sequence[float]) -> Box:
    values = tuple(float(value) for value in box)
    if len(values) != 4 or not can_be_computed(*values):
        raise BadInput(f"box={shown(str(list(box)))}: give x, y, width and height, each {NUMBERS}")
    x, y, width, height = values
    if width <= 0 or height <= 0:
        raise BadInput(f"the box is {width:g} wide and {height:g} high: nothing fits in it")
    return x, y, width, height
