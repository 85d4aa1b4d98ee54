"""Follow the closure of links that are solved together, in steps that cannot jump to another closure.

Its parts, in reading order:

- The equations of a group: pins, slots, angles that go together, in the places and turns of its links.
- The same equations in fixed point with 38 digits.
- Following the closure from the given pose, all the way round until it is back.

Each link has a place o and a turn ψ from the pose, each slide a travel s, and u is the input. All that holds
the links is then a sum of complex terms o, r e^{iψ} and s g e^{iψ}, and linear relations between turns. Their
second derivatives are bounded by the lengths, so what a Newton step leaves can be bounded over a whole box:
Krawczyk's test. A step along the tangent t is taken where the test proves that next to each of its points
there is one solution and no more; else it is halved. (R. Krawczyk, Newton-Algorithmen zur Bestimmung von
Nullstellen mit Fehlerschranken, Computing 4, 1969.)
"""

from __future__ import annotations

import math
from cmath import phase
from collections.abc import Iterable, Iterator, Mapping
from decimal import localcontext
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import AssemblyError
from linkanim.frozen import frozen
from linkanim.mechanics.groups import GROUND, GroupSlide, LinkGroup, direction_of, group_of
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.precise import context, sides
from linkanim.mechanics.program import Array
from linkanim.mechanics.tolerances import NO_STEP, SAME_POSE, SOLVED

# The equations of a group: pins, slots, angles that go together, in the places and turns of its links.

Loops = NDArray[np.complex128]
MOST_LINKS = 12
"""The most links that are solved together, the crank left out."""


class LinkFrame(NamedTuple):
    """A link of the system: where its points lie in its own frame, and where that is in the pose."""

    name: str
    points: Mapping[str, tuple[Fraction, Fraction]]
    origin: complex
    angle: float

    def at(self, point: str) -> complex:
        """Return where a point lies in the link's frame."""
        x, y = self.points[point]
        return complex(float(x), float(y))


class GuidedTravel(NamedTuple):
    """A travel: its row of the equations, its link (None for the ground), its direction there."""

    name: str
    row: int
    on: int | None
    direction: complex
    angle: float
    travel: float


@frozen
class LinkEquations:
    """The equations F(y) = 0 of a linkage with one input, lengths in the linkage's unit times `shrunk`.

    y holds for each link x, y and ψ, then the travels, then the input u: an angle, or a travel where it
    `slides`. Rows are the complex ones' real parts, their imaginary parts, and the linear relations.
    """

    frames: tuple[LinkFrame, ...]
    fixed: Mapping[str, tuple[Fraction, Fraction]]
    terms: tuple[tuple[tuple[int | None, str, int], ...], ...]
    """For each complex row the points that it sums: link (None for the ground), point, sign."""
    asides: Mapping[int, tuple[int | None, complex, float, float]]
    """For rows of slides: the link, the line's direction there, its angle, and how far it is offset."""
    slots: tuple[GuidedTravel, ...]
    linear: tuple[Mapping[int, Fraction], ...]
    shrunk: float
    at: float
    slides: bool = False

    @property
    def turning(self) -> list[int]:
        """The numbers of the unknowns that are angles."""
        return [*range(2, 3 * self.links, 3), *([] if self.slides else [self.size - 1])]

    @property
    def links(self) -> int:
        """The number of links."""
        return len(self.frames)

    @property
    def size(self) -> int:
        """The number of unknowns, the input among them."""
        return 3 * self.links + len(self.slots) + 1

    @cached_property
    def start(self) -> Array:
        """The unknowns in the pose."""
        y = np.zeros(self.size)
        for n, frame in enumerate(self.frames):
            y[3 * n : 3 * n + 3] = frame.origin.real, frame.origin.imag, frame.angle
        for n, slot in enumerate(self.slots):
            y[3 * self.links + n] = slot.travel
        y[-1] = self.at
        return y

    @cached_property
    def _matrices(self) -> tuple[Loops, Loops, Loops, Array]:
        """The factors of places and of e^{iψ} (the ground's, 1, last), and of the linear relations."""
        rows, links = len(self.terms), self.links
        places, turns = np.zeros((rows, links), complex), np.zeros((rows, links + 1), complex)
        for row, terms in enumerate(self.terms):
            for link, point, sign in terms:
                if link is None:
                    x, y = self.fixed[point]
                    turns[row, links] += sign * complex(float(x), float(y))
                else:
                    places[row, link] += sign
                    turns[row, link] += sign * self.frames[link].at(point)
        for row, (link, direction, _, offset) in self.asides.items():
            turns[row, links if link is None else link] -= 1j * offset * direction
        linear = np.zeros((len(self.linear), self.size))
        for n, relation in enumerate(self.linear):
            for unknown, factor in relation.items():
                linear[n, unknown] = float(factor)
        return places, turns, np.abs(turns), linear

    @cached_property
    def _slides(self) -> tuple[NDArray[np.intp], NDArray[np.intp], Loops]:
        """Rows, links (the ground's number being that after the last) and directions of the slides."""
        links = [self.links if slot.on is None else slot.on for slot in self.slots]
        rows = [slot.row for slot in self.slots]
        directions = np.array([slot.direction for slot in self.slots], complex)
        return np.array(rows, np.intp), np.array(links, np.intp), directions

    def _units(self, y: Array) -> Loops:
        """Return e^{iψ} of all links (N, L + 1), that of the ground last."""
        ones = np.ones((len(y), 1), complex)
        return np.concatenate([np.exp(1j * y[:, 2 : 3 * self.links : 3]), ones], axis=1)

    def _travels(self, y: Array) -> Array:
        return y[:, 3 * self.links : self.size - 1]

    def residual(self, y: Array) -> Array:
        """Return F at unknowns (N, m): (N, m - 1)."""
        places, turns, _, linear = self._matrices
        rows, on, direction = self._slides
        units = self._units(y)
        o = y[:, 0 : 3 * self.links : 3] + 1j * y[:, 1 : 3 * self.links : 3]
        errors = o @ places.T + units @ turns.T
        errors[:, rows] -= self._travels(y) * direction * units[:, on]
        return np.concatenate([errors.real, errors.imag, (y - self.start) @ linear.T], axis=1)

    def jacobian(self, y: Array) -> Array:
        """Return the derivatives of F at unknowns (N, m): (N, m - 1, m)."""
        places, turns, _, linear = self._matrices
        rows, on, direction = self._slides
        units, links, count = self._units(y), self.links, len(self.terms)
        slopes = np.zeros((len(y), count, self.size), complex)
        slopes[:, :, 0 : 3 * links : 3] = places
        slopes[:, :, 1 : 3 * links : 3] = 1j * places
        by_turn = 1j * turns * units[:, None, :]
        along = direction * units[:, on]
        by_turn[:, rows, on] -= 1j * self._travels(y) * along
        slopes[:, :, 2 : 3 * links : 3] = by_turn[:, :, :links]
        slopes[:, rows, 3 * links + np.arange(len(rows))] = -along
        whole = np.empty((len(y), self.size - 1, self.size))
        whole[:, :count], whole[:, count : 2 * count], whole[:, 2 * count :] = (
            slopes.real,
            slopes.imag,
            linear,
        )
        return whole

    def bend(self, y: Array, v: Array) -> Array:
        """Return the derivatives of J v by y, (m - 1, m), at one y for one v."""
        _, turns, _, _ = self._matrices
        rows, on, direction = self._slides
        units, links = self._units(y[None])[0], self.links
        turn = np.append(v[2 : 3 * links : 3], 0.0)
        slopes = np.zeros((len(self.terms), self.size), complex)
        by_turn = -turns * (units * turn)
        along = direction * units[on]
        by_turn[rows, on] += along * self._travels(y[None])[0] * turn[on]
        by_turn[rows, on] -= 1j * along * v[3 * links : self.size - 1]
        slopes[:, 2 : 3 * links : 3] = by_turn[:, :links]
        slopes[rows, 3 * links + np.arange(len(rows))] = -1j * along * turn[on]
        return np.concatenate([slopes.real, slopes.imag, np.zeros((len(self.linear), self.size))])

    def change(self, y: Array, away: Array) -> Array:
        """Return bounds on how J changes, (rows, m) by complex row, where y moves by at most `away`."""
        _, _, turns, _ = self._matrices
        rows, on, _ = self._slides
        links = self.links
        turn = np.append(away[2 : 3 * links : 3], 0.0)
        travel, more = np.abs(y[3 * links : self.size - 1]), away[3 * links : self.size - 1]
        slopes = np.zeros((len(self.terms), self.size))
        by_turn = turns * turn
        by_turn[rows, on] += (travel + more) * turn[on] + np.where(on < links, more, 0.0)
        slopes[:, 2 : 3 * links : 3] = by_turn[:, :links]
        slopes[rows, 3 * links + np.arange(len(rows))] = turn[on]
        return slopes

    def third(self, y: Array, rate: Array, step: float) -> Array:
        """Return bounds on the third derivatives of F along a step, by complex row; `rate` is the size."""
        _, _, turns, _ = self._matrices
        rows, on, _ = self._slides
        links = self.links
        turn = np.append(rate[2 : 3 * links : 3], 0.0)
        bend: Array = turns @ turn**3
        travel, more = np.abs(y[3 * links : self.size - 1]), rate[3 * links : self.size - 1]
        np.add.at(bend, rows, (travel + step * more) * turn[on] ** 3 + 3 * more * turn[on] ** 2)
        return bend


# The same equations in fixed point with 38 digits.

BITS = 128
ONE = 1 << BITS
_MOST_TERMS = 60
Pair = tuple[Any, Any]
"""Real and imaginary part in fixed point."""
Whole = NDArray[np.object_]
"""Python's whole numbers, which stand for numbers times 2¹²⁸."""


def _fixed(number: float | Fraction) -> int:
    return int(math.ldexp(number, BITS) if isinstance(number, float) else number * ONE)


_EACH_FIXED = np.frompyfunc(_fixed, 1, 1)
_EACH_FLOAT = np.frompyfunc(lambda whole: whole / ONE, 1, 1)


def fixed(numbers: Array) -> Whole:
    """Return an array of numbers in fixed point."""
    return np.asarray(_EACH_FIXED(numbers), np.object_)


def in_floats(whole: Any) -> Array:
    """Return numbers in fixed point as floats."""
    return np.asarray(_EACH_FLOAT(whole), np.float64)


_PI = int(Fraction("3.14159265358979323846264338327950288419716939937510582097494459") * ONE)


_PARTS = 64
"""The equal parts of a turn about whose ends sine and cosine are summed."""


def units_of(angle: Whole) -> Pair:
    """Return cosine and sine of angles in fixed point, by series about the nearest of a turn's parts."""
    count = (angle * _PARTS + _PI) // (2 * _PI)
    near = _series(angle - count * (2 * _PI) // _PARTS)
    cosines, sines = _parts()
    at = (count % _PARTS).astype(np.intp)
    return _times(near, (cosines[at], sines[at]))


@lru_cache(maxsize=1)
def _parts() -> Pair:
    """Return cosine and sine of all parts of a turn."""
    places = [n - _PARTS * (2 * n >= _PARTS) for n in range(_PARTS)]
    return _series(np.array([2 * _PI * place // _PARTS for place in places], np.object_))


def _series(angle: Whole) -> Pair:
    """Return cosine and sine of angles in fixed point by their series."""
    square = angle * angle >> BITS
    cosine = sine = term = np.full_like(angle, ONE)
    n = 1
    while n < _MOST_TERMS and np.any(term):
        term = -(term * square >> BITS) // (n * (n + 1))
        cosine = cosine + term
        sine = sine + term // (n + 2)
        n += 2
    return cosine, angle * sine >> BITS


def _times(a: Pair, b: Pair) -> Pair:
    """Return the complex product in fixed point."""
    return (a[0] * b[0] - a[1] * b[1]) >> BITS, (a[0] * b[1] + a[1] * b[0]) >> BITS


@frozen
class FixedPoint:
    """A system in fixed point; unknowns are rows (m, N)."""

    system: LinkEquations

    @cached_property
    def _points(self) -> dict[tuple[int | None, str], Pair]:
        own = self.system
        points: dict[tuple[int | None, str], Pair] = {
            (None, name): (_fixed(x), _fixed(y)) for name, (x, y) in own.fixed.items()
        }
        for n, frame in enumerate(own.frames):
            points |= {(n, name): (_fixed(x), _fixed(y)) for name, (x, y) in frame.points.items()}
        return points

    @cached_property
    def _directions(self) -> dict[int, Pair]:
        with localcontext(context()):
            directions = {row: sides(angle) for row, (_, _, angle, _) in self.system.asides.items()}
            return {row: (int(cosine * ONE), int(sine * ONE)) for row, (sine, cosine) in directions.items()}

    def units(self, y: Whole) -> list[Pair]:
        """Return e^{iψ} of all links."""
        return [units_of(y[3 * n + 2]) for n in range(self.system.links)]

    def point(self, y: Whole, units: list[Pair], link: int | None, name: str) -> Pair:
        """Return where a point of a link is."""
        local = self._points[link, name]
        if link is None:
            return local
        x, left = _times(local, units[link])
        return y[3 * link] + x, y[3 * link + 1] + left

    def residual(self, y: Whole) -> Whole:
        """Return F at unknowns (m, N): (m - 1, N)."""
        own, units = self.system, self.units(y)
        along, across = [], []
        for row, terms in enumerate(own.terms):
            x, left = np.zeros_like(y[0]), np.zeros_like(y[0])
            for link, name, sign in terms:
                place = self.point(y, units, link, name)
                x, left = x + sign * place[0], left + sign * place[1]
            if row in own.asides:
                on, _, _, offset = own.asides[row]
                slot = next(n for n, slot in enumerate(own.slots) if slot.row == row)
                line = self._directions[row]
                guided = _times((y[3 * own.links + slot], _fixed(offset)), line)
                guided = guided if on is None else _times(guided, units[on])
                x, left = x - guided[0], left - guided[1]
            along.append(x)
            across.append(left)
        return np.array([*along, *across, *self.relations(y)], np.object_)

    def relations(self, y: Whole) -> list[Any]:
        """Return the rows of the linear relations."""
        start = [_fixed(value) for value in self.system.start]
        return [
            sum(factor.numerator * (y[n] - start[n]) // factor.denominator for n, factor in relation.items())
            for relation in self.system.linear
        ]

    def along(self, y: Whole, v: Whole) -> Whole:
        """Return J v at unknowns (m, N)."""
        own, units = self.system, self.units(y)

        def moving(link: int, name: str) -> Pair:
            x, left = _times(self._points[link, name], units[link])
            turn = v[3 * link + 2]
            return v[3 * link] - (left * turn >> BITS), v[3 * link + 1] + (x * turn >> BITS)

        along, across = [], []
        for row, terms in enumerate(own.terms):
            x, left = np.zeros_like(y[0]), np.zeros_like(y[0])
            for link, name, sign in terms:
                if link is not None:
                    rate = moving(link, name)
                    x, left = x + sign * rate[0], left + sign * rate[1]
            if row in own.asides:
                on, _, _, offset = own.asides[row]
                slot = next(n for n, slot in enumerate(own.slots) if slot.row == row)
                travel, rate = y[3 * own.links + slot], (v[3 * own.links + slot], np.zeros_like(y[0]))
                line = self._directions[row]
                if on is not None:
                    line = _times(line, units[on])
                    turn = v[3 * on + 2]
                    rate = rate[0] - (_fixed(offset) * turn >> BITS), travel * turn >> BITS
                guided = _times(rate, line)
                x, left = x - guided[0], left - guided[1]
            along.append(x)
            across.append(left)
        relations = [
            sum(factor.numerator * v[n] // factor.denominator for n, factor in relation.items())
            for relation in own.linear
        ]
        return np.array([*along, *across, *relations], np.object_)


# A linkage as a system.


def system_of(linkage: Linkage) -> LinkEquations:
    """Return the equations of a linkage with a group; AssemblyError where they are too many or too few."""
    group = group_of(linkage)
    assert group is not None
    longest = max(abs(complex(*place)) for one in group.members for place in one.places)
    shrunk = math.ldexp(1.0, -math.frexp(longest)[1])
    frames = tuple(_frames(linkage, group, Fraction(shrunk)))
    count = len(group.moving)
    if count > MOST_LINKS:
        raise AssemblyError(
            f"{count} links have to be solved together, and {MOST_LINKS} are the most here;"
            " leave links out, or drive it where dyads follow"
        )
    ground = {
        pin.name: tuple(Fraction(part) * Fraction(shrunk) for part in pin.position) for pin in linkage.pins
    }
    build = _Build(group, frames, ground)
    system = build.system(shrunk)
    equations = 2 * len(system.terms) + len(system.linear)
    if equations != system.size - 1:
        free = system.size - 1 - equations
        raise AssemblyError(
            f"its links have {free} degrees of freedom too many for one motor; add a link"
            if free > 0
            else f"its links are held {-free} times too often; leave out a link, or a point of one"
        )
    return system


def _frames(linkage: Linkage, group: LinkGroup, shrunk: Fraction) -> Iterable[LinkFrame]:
    if group.crank:
        yield _crank_frame(linkage, group, shrunk)
    for member in group.moving:
        first = member.places[0]
        origin, angle = complex(*first) * float(shrunk), 0.0
        if member.length:
            # so that a length that was stated stays the number that it is
            angle = phase(complex(*member.places[1]) - complex(*first))
            local = {member.points[0]: (Fraction(0),) * 2}
            local[member.points[1]] = Fraction(member.length) * shrunk, Fraction(0)
        else:
            ways = (
                [Fraction(a) - Fraction(b) for a, b in zip(place, first, strict=True)]
                for place in member.places
            )
            local = {name: (x * shrunk, y * shrunk) for name, (x, y) in zip(member.points, ways, strict=True)}
        yield LinkFrame(member.name, local, origin, angle)


def _crank_frame(linkage: Linkage, group: LinkGroup, shrunk: Fraction) -> LinkFrame:
    crank = linkage.crank(linkage.drive.joint)
    own = next(frame for frame in linkage.rigid_bodies[1:] if {crank.pivot, crank.name} <= frame.keys())
    pivot = own[crank.pivot]
    places = {
        name: (Fraction((at - pivot).real) * shrunk, Fraction((at - pivot).imag) * shrunk)
        for name, at in own.items()
    }
    at = complex(*linkage.pin(crank.pivot).position) * float(shrunk)
    return LinkFrame(group.crank, places, at, group.at)


class _Build:
    """Collects the equations of a group."""

    def __init__(self, group: LinkGroup, frames: tuple[LinkFrame, ...], ground: Mapping[str, Any]) -> None:
        self.group, self.frames, self.ground = group, frames, ground
        self.number: dict[str, int | None] = {GROUND: None}
        self.number |= {frame.name: n for n, frame in enumerate(frames)}
        self.terms: list[tuple[tuple[int | None, str, int], ...]] = []
        self.asides: dict[int, tuple[int | None, complex, float, float]] = {}
        self.slots: list[GuidedTravel] = []
        self.linear: list[Mapping[int, Fraction]] = []

    def system(self, shrunk: float) -> LinkEquations:
        """Return the system."""
        for name in dict.fromkeys(point for one in self.group.members for point in one.points):
            self._pin(name)
        for slide in self.group.slides:
            self._slide(slide)
            if not slide.turns:
                self._relation({slide.link: Fraction(1), slide.on: Fraction(-1)})
        for gear in self.group.gears:
            (first, second), ratio = gear.links, gear.ratio
            self._relation({second: Fraction(1), first: -ratio, gear.carrier: ratio - 1})
        last, at = 3 * len(self.frames) + len(self.slots), self.group.at
        if self.group.driven:
            slot = next(n for n, slot in enumerate(self.slots) if slot.name == self.group.driven)
            at = self.slots[slot].travel
            self.linear.append({3 * len(self.frames) + slot: Fraction(1), last: Fraction(-1)})
        else:
            motor = self.group.motor
            carrier, driven = motor.links if motor else (GROUND, self.group.crank)
            self._relation({driven: Fraction(1), carrier: Fraction(-1)})
            self.linear[-1] = {**self.linear[-1], last: Fraction(-1)}
        return LinkEquations(
            self.frames,
            self.ground,
            tuple(self.terms),
            self.asides,
            tuple(self.slots),
            tuple(self.linear),
            shrunk,
            at,
            bool(self.group.driven),
        )

    def _pin(self, name: str) -> None:
        """Have all links with a point meet in it."""
        own = [self.number[one.name] for one in self.group.at_point(name)]
        first, *others = sorted(own, key=lambda link: -1 if link is None else link)
        self.terms += [((first, name, 1), (link, name, -1)) for link in others]

    def _slide(self, slide: GroupSlide) -> None:
        """Have a point of one link on a line of another."""
        name, link, point, on, origin, angle, _ = slide
        slid, line = self.number[link], self.number[on]
        here = self._place(slid, point) - self._place(line, origin)
        direction = direction_of(angle)
        along = here * direction.conjugate()
        turned = angle if line is None else angle - self.frames[line].angle
        row = len(self.terms)
        self.terms.append(((slid, point, 1), (line, origin, -1)))
        self.asides[row] = (line, direction_of(turned), turned, along.imag)
        self.slots.append(GuidedTravel(name, row, line, direction_of(turned), turned, along.real))

    def _place(self, link: int | None, point: str) -> complex:
        if link is None:
            x, y = self.ground[point]
            return complex(float(x), float(y))
        frame = self.frames[link]
        return frame.origin + frame.at(point) * direction_of(frame.angle)

    def _relation(self, turns: Mapping[str, Fraction]) -> None:
        """Have the turns of links go together."""
        relation: dict[int, Fraction] = {}
        for name, factor in turns.items():
            link = self.number[name]
            if link is not None and factor:
                relation[3 * link + 2] = relation.get(3 * link + 2, Fraction(0)) + factor
        self.linear.append(relation)


# Following the closure from the given pose, all the way round until it is back.

_FIRST, _MOST_STEPS = 0.05, 20_000
"""The first step, and the most of them, in lengths of the system and in radians."""
_SINGULAR = 1e9
"""The condition of the links' own equations from which on a pose is at a limit."""
_ACROSS, _BENT = (0.02, 0.01, 0.005), 20.0
"""Steps across a change point, and the most by which the path's direction may change on one, in steps."""
_GROWN, _TRIES, _BOUNDED = 1.4, 4, 8


class PathPlace(NamedTuple):
    """A point of the closure's path, the direction in which it goes on, and how far it is certified.

    The `box` is how far from the tangent, by unknowns, the path lies at the most; None across a change point.
    """

    y: Array
    tangent: Array
    step: float
    box: Array | None = None


class Followed(NamedTuple):
    """A closed path of closures: its places in order, and the input's change all the way round.

    The input turns back at the places with these numbers, which are limits.
    """

    places: tuple[PathPlace, ...]
    change: float
    limits: tuple[int, ...]


def corrected_at_input(system: LinkEquations, y: Array) -> Array:
    """Return the unknowns corrected at their input; AssemblyError where the pose is at a limit."""
    at = y[None].copy()
    for _ in range(8):
        alone = system.jacobian(at)[:, :, :-1]
        if np.linalg.cond(alone[0]) > _SINGULAR:
            break
        step = np.linalg.solve(alone, -system.residual(at)[..., None])[..., 0]
        at[:, :-1] += step
        if np.abs(step).max() < SOLVED:
            return np.asarray(at[0])
    raise AssemblyError(
        "its links stand at a limit in this pose, which does not show how they are put together;"
        " give the points in another pose"
    )


def followed(system: LinkEquations) -> Followed:
    """Follow the closure from the pose until it is back; AssemblyError where it cannot be followed."""
    start = corrected_at_input(system, system.start)
    places, limits = list[PathPlace](), list[int]()
    for place in _path(system, start, 1.0):
        if places and place.tangent[-1] * places[-1].tangent[-1] < 0:
            limits.append(len(places))
        places.append(place)
        if len(places) > 2 and (change := _back(system, place, start)) is not None:
            if place.tangent[-1] < 0:
                limits.append(len(places))
            return Followed(tuple(places), change, tuple(limits))
    raise AssemblyError("its links do not come back to their pose; hold those that slide without end")


def followed_to(system: LinkEquations, end: float) -> tuple[list[PathPlace], bool]:
    """Follow the closure from the pose until its input is at or beyond an end; tell whether it turned back.

    Where it did it is followed to the first place behind that limit, which comes before the end.
    """
    start, places = corrected_at_input(system, system.start), list[PathPlace]()
    sense = 1.0 if end > start[-1] else -1.0
    for place in _path(system, start, sense):
        turned = bool(places) and place.tangent[-1] * sense < 0
        places.append(place)
        if turned or (place.y[-1] - end) * sense >= 0:
            return places, turned
    raise AssemblyError("its links cannot be followed so far; choose nearer ends of the input")


def _path(system: LinkEquations, y: Array, sense: float) -> Iterator[PathPlace]:
    """Yield the places of the closure's path from a pose, from which the input first changes by `sense`."""
    direction, step = np.zeros(system.size), _FIRST
    direction[-1] = sense
    for _ in range(_MOST_STEPS):
        inverse = _inverse(system, y, direction)
        tangent = inverse[:, -1] / np.linalg.norm(inverse[:, -1])
        step, box = _certified(system, y, inverse, tangent, step * _GROWN)
        if step < NO_STEP:
            across, step = _crossed(system, y, tangent)
            yield PathPlace(y, tangent, step)
            y, direction = across, tangent
            continue
        yield PathPlace(y, tangent, step, box)
        y, direction = _corrected(system, y + step * tangent, inverse), tangent


def _inverse(system: LinkEquations, y: Array, direction: Array) -> Array:
    """Return the inverse of F's derivatives bordered by a direction; its last column is the tangent."""
    bordered = np.concatenate([system.jacobian(y[None])[0], direction[None]])
    try:
        inverse: Array = np.linalg.inv(bordered)
    except np.linalg.LinAlgError:  # a pose at a change point, which is taken for one beside it
        inverse = np.linalg.pinv(bordered)
    return inverse


def _crossed(system: LinkEquations, y: Array, tangent: Array) -> tuple[Array, float]:
    """Return a place of the path behind a change point, and how far it is: the smooth path goes straight on.

    Two closures cross there, so no step up to it is certified. AssemblyError where nothing goes straight on.
    """
    for step in _ACROSS:
        there = y + step * tangent
        for _ in range(12):
            inverse = _inverse(system, there, tangent)
            move = inverse[:, :-1] @ system.residual(there[None])[0]
            there = there - move
            if np.abs(move).max() < SOLVED:
                break
        onward = inverse[:, -1] / np.linalg.norm(inverse[:, -1])
        bent = np.abs(onward - tangent).max()
        if np.abs(system.residual(there[None])).max() < SOLVED and bent < _BENT * step:
            return there, step
    raise AssemblyError(
        f"its links come to a change point where the input is at {math.degrees(float(y[-1])):.6g} deg, from"
        " which none of its closures goes straight on; make one length longer or shorter"
    )


def _certified(
    system: LinkEquations, y: Array, inverse: Array, tangent: Array, step: float
) -> tuple[float, Array]:
    """Return the longest step, of those halved from `step`, along which one solution is near, and its box.

    The box is how far from the tangent, by unknowns, the solution lies at the most, and the only one.
    """
    rows = len(system.terms)
    sized = np.hypot(inverse[:, :rows], inverse[:, rows : 2 * rows])
    error = np.abs(inverse[:, :-1] @ system.residual(y[None])[0])
    second = -inverse[:, :-1] @ (system.bend(y, tangent) @ tangent)
    bent, size = np.abs(second) / 2, np.abs(tangent)
    while step > NO_STEP:
        first = error + bent * step * step + sized @ system.third(y, size, step) * (step**3 / 6)
        box = 1.5 * first + SOLVED
        for _ in range(_TRIES):
            needed = first + sized @ (system.change(y, size * step + box) @ box)
            if (needed <= box).all():
                if _turns_once(system, y, (tangent, second), sized, step, box):
                    return step, box
                break
            box = 1.2 * np.maximum(needed, box)
            if box.max() > 10.0:
                break
        step /= 2
    return 0.0, size


def _turns_once(
    system: LinkEquations, y: Array, rates: tuple[Array, Array], sized: Array, step: float, box: Array
) -> bool:
    """Tell whether the input is proved to turn back once at the most on a step.

    That is so where its first, or its second, derivative along the path keeps its sign. `rates` are both at
    the step's begin, from which they differ by no more than `first` and `more`.
    """
    size, bent = np.abs(rates[0]), np.abs(rates[1])
    changed = system.change(y, size * step + box)

    def carried(of: Array, begin: Array) -> Array:
        """Return a bound on x where x ≤ begin + M (of + x), M the change of the inverse times F's."""
        vector = begin
        for _ in range(_BOUNDED):
            vector = begin + sized @ (changed @ (of + vector))
        return vector + (vector - begin) * 0.5

    first = carried(size, np.zeros_like(size))
    if size[-1] > first[-1]:
        return True
    along = system.third(y, size, step) * step + 2 * system.change(y, size) @ first
    more = carried(bent, sized @ (along + system.change(y, first) @ first))
    return bool(bent[-1] > more[-1])


def _corrected(system: LinkEquations, y: Array, inverse: Array) -> Array:
    """Return the solution near y, by Newton steps across the tangent with one inverse."""
    for _ in range(30):
        step = inverse[:, :-1] @ system.residual(y[None])[0]
        y = y - step
        if np.abs(step).max() < SOLVED:
            break
    return y


def _back(system: LinkEquations, place: PathPlace, start: Array) -> float | None:
    """Return how far the input has gone if the start lies on the step from a place, by its certified box."""
    y, tangent, step, box = place
    if box is None:
        return None
    away, turns = start - y, system.turning
    away[turns] = np.remainder(away[turns] + math.pi, 2 * math.pi) - math.pi
    along = float(away @ tangent)
    off = np.abs(away - along * tangent) - box
    if not -SAME_POSE <= along <= step * (1 + SAME_POSE) or off.max() > SAME_POSE:
        return None
    return float(y[-1] + away[-1] - start[-1])
