"""Loops: dyads that close from a crank pin against fixed elements, each with its root in closed form."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from decimal import Decimal, localcontext
from fractions import Fraction
from functools import partial

from linkanim.errors import AssemblyError
from linkanim.mechanics.formulas.circular import Half, half_angle, sharp_half_angle, signed_half_angle
from linkanim.mechanics.formulas.constant import Constant
from linkanim.mechanics.formulas.exact import HALF_TURN, Sum, exact_angle, gap
from linkanim.mechanics.formulas.expression import Value
from linkanim.mechanics.formulas.planar import Slope, Vec
from linkanim.mechanics.formulas.precise import context, exactly, nearest_sum, sides, sine_and_cosine
from linkanim.mechanics.formulas.precise import direction as direction_of
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.pins import Crank, Pin
from linkanim.mechanics.loops.input_state import InputState
from linkanim.mechanics.loops.roots import Kind, LoopRoot
from linkanim.mechanics.loops.signed import SignedRoot, sharpened, sign_of_root, signed_root

STRAIGHT = Sum(0.0)


ONE_POINT = 2.0**-100
"""Share of a crank's length within which two pins are one point."""


@dataclass(frozen=True, slots=True)
class Gearing:
    """How a crank turns with the input: angle = ratio × θ + offset."""

    ratio: Fraction = Fraction(1)
    offset: Sum = STRAIGHT


@dataclass(frozen=True, slots=True)
class Ground:
    """The ground link between two fixed pins: length, direction, and the angle of that direction.

    `rest` is what rounding took from a length that is read from coordinates.
    """

    length: float
    direction: Vec
    angle: Sum
    rest: float = 0.0

    @property
    def exact(self) -> Sum:
        """The length to twice a float's digits."""
        return Sum(self.length, self.rest)


@dataclass(frozen=True, slots=True)
class Loop:
    """A dyad closed from the crank pin `pin` (of the crank `crank`) and fixed elements.

    `ground` runs from the crank's pivot to the fixed pin; None for a line of travel.
    `swapped` says that the dyad names the fixed pin first.
    """

    pin: str
    crank: Crank
    gearing: Gearing
    ground: Ground | None
    root: LoopRoot
    swapped: bool = False

    @property
    def limits(self) -> bool:
        """Whether the loop keeps its crank from turning fully."""
        return Kind.LIMIT in (self.root.u.kind, self.root.w.kind)

    @property
    def change_points(self) -> Iterator[tuple[float, int]]:
        """The input's angles at which the root changes its sign, and after how many turns each is back."""
        p, q = self.gearing.ratio.as_integer_ratio()
        for angle in self.root.change_points:
            first, step = float((angle - self.gearing.offset) * Fraction(q, p)), 2 * math.pi * q / abs(p)
            yield from ((first + turn * step, q) for turn in range(abs(p)))

    def closed(self, state: InputState, pace: Slope) -> tuple[SignedRoot, Half]:
        """Return the loop's root and ψ/2 at the state's instant, ψ running at `pace`."""
        half = sharpened(self.root, self._half(state), state.ends)
        return signed_root(self.root, half, pace, state.ends), half

    def sign(self, state: InputState) -> int:
        """Return the sign of the loop's root at an instant between its limits, in plain floats."""
        return sign_of_root(self.root, self._half(state))

    def _half(self, state: InputState) -> Half:
        reference = self.root.reference - self.gearing.offset
        return state.half(reference, self.gearing.ratio, form=self.form)

    @property
    def form(self) -> Callable[[Value, Value], Half]:
        """How ψ/2 is worked out: with the sign and the digits that the root needs, squares times 2r."""
        if self.root.u.kind is Kind.PLAIN and not self.root.wide:
            return sharp_half_angle
        plain = self.root.u.kind is self.root.w.kind is Kind.PLAIN
        return partial(half_angle if plain else signed_half_angle, size=2.0 * self.crank.length)


def own_loop(crank: str, loops: Mapping[str, Loop]) -> Loop | None:
    """Return the loop on a crank's pin whose ψ is the crank's own angle; None where there is none."""
    own = (loop for loop in loops.values() if loop.pin == crank and loop.root.reference == STRAIGHT)
    return next(own, None)


def gearings(linkage: Linkage) -> dict[str, Gearing]:
    """Map each crank's pin to how it turns with the input; AssemblyError where it does not."""
    own = linkage.drive.joint
    found = {own: Gearing()} if isinstance(linkage.joint(own), Crank) else {}
    for crank in linkage.cranks:
        if crank.name in found:
            continue
        if crank.gear is None or crank.gear.mate not in found:
            raise AssemblyError(
                f"joint {crank.name}: this crank turns with nothing; gear it to {linkage.drive.joint}"
            )
        mate = found[crank.gear.mate]
        offset = mate.offset * crank.gear.ratio + exact_angle(crank.gear.offset)
        found[crank.name] = Gearing(mate.ratio * crank.gear.ratio, offset)
    return found


def pin_against_pin(
    linkage: Linkage, gears: Mapping[str, Gearing], ends: tuple[str, str]
) -> tuple[Crank, Ground, bool] | None:
    """Return a crank whose pin is one of two joints, and the ground link from its pivot to the other one.

    Last, whether the pin is the second of the two. None where the other one, or the pivot, is not fixed, or
    both are one point.
    """
    for swapped, (moving, fixed) in enumerate((ends, ends[::-1])):
        crank = linkage.crank(moving) if moving in gears else None
        if crank and linkage.joint(crank.pivot).fixed and linkage.joint(fixed).fixed:
            ground = ground_between(linkage, crank, fixed)
            return (crank, ground, bool(swapped)) if ground else None
    return None


def ground_between(linkage: Linkage, crank: Crank, end: str) -> Ground | None:
    """Return the ground link from a crank's pivot to another fixed pin, as exactly as it was written.

    None where they are one point, and no direction leads from one to the other. The length is the
    crank's own where rounding is all that tells them apart.
    """
    ground = _between(linkage, crank.pivot, end)
    if ground and ground.length < ONE_POINT * crank.length:
        return None
    if ground and gap(ground.length, ground.rest, -crank.length) == 0:
        return replace(ground, length=crank.length, rest=0.0)
    return ground


def _between(linkage: Linkage, begin: str, end: str) -> Ground | None:
    first, second = linkage.pin(begin), linkage.pin(end)
    if _written_from(second, first):
        return _written(second, turned=False)
    if _written_from(first, second):
        return _written(first, turned=True)
    dx, dy = second.position[0] - first.position[0], second.position[1] - first.position[1]
    length = math.hypot(dx, dy)
    if not length:
        return None
    places = place(linkage, first), place(linkage, second)
    exact, angle = _way(*places)
    with localcontext(context()):
        along, left = ((b - a) / exactly(exact) for a, b in zip(*places, strict=True))
    direction = Vec(Constant(dx / length, along), Constant(dy / length, left))
    if not (dx and dy):
        angle = exact_angle(math.atan2(dy, dx))
    return Ground(exact.high, direction, angle, exact.low)


def aside_of(linkage: Linkage, pin: Pin, base: Pin, angle: float) -> Sum:
    """Return how far a fixed pin lies left of the line through another at an angle."""
    (x0, y0), (x1, y1) = place(linkage, base), place(linkage, pin)
    sine, cosine = sides(angle)
    with localcontext(context()):
        return nearest_sum((y1 - y0) * cosine - (x1 - x0) * sine)


def place(linkage: Linkage, pin: Pin) -> tuple[Decimal, Decimal]:
    """Return where a fixed pin lies, as it was written."""
    if pin.polar is None:
        return Decimal(pin.position[0]), Decimal(pin.position[1])
    base, length = pin.polar.base, Decimal(pin.polar.length)
    x, y = place(linkage, linkage.pin(base)) if base else (Decimal(0), Decimal(0))
    sine, cosine = sides(pin.polar.angle)
    with localcontext(context()):
        return x + length * cosine, y + length * sine


def _way(start: tuple[Decimal, Decimal], end: tuple[Decimal, Decimal]) -> tuple[Sum, Sum]:
    """Return length and angle of the way between two points to twice a float's digits."""
    with localcontext(context()):
        dx, dy = end[0] - start[0], end[1] - start[1]
        near = Decimal(math.atan2(dy, dx))
        sine, cosine = sine_and_cosine(near)
        # What a float lacks of the angle is so small that it is its own tangent.
        rest = (dy * cosine - dx * sine) / (dx * cosine + dy * sine)
        return nearest_sum((dx * dx + dy * dy).sqrt()), nearest_sum(near + rest)


def _written_from(pin: Pin, base: Pin) -> bool:
    """Tell whether the pin was written as a length at an angle from the other."""
    if pin.polar is None:
        return False
    return pin.polar.base == base.name or (pin.polar.base is None and base.position == (0.0, 0.0))


def _written(pin: Pin, *, turned: bool) -> Ground:
    assert pin.polar is not None
    direction = Vec(*direction_of(pin.polar.angle))
    angle = exact_angle(pin.polar.angle)
    if turned:
        # At most half a turn, as that of coordinates: the input's range counts from it.
        back = angle - HALF_TURN if float(angle) > 0 else angle + HALF_TURN
        return Ground(pin.polar.length, -direction, back)
    return Ground(pin.polar.length, direction, angle)
