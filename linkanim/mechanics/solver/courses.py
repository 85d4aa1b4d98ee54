"""Keep the motion of links that are solved together as polynomials of the phase, to all digits.

Its parts, in reading order:

- The limits of the closure that was followed, found in 38 digits.
- The input's path: a turn, a swing between two limits and back on the other closure, or on the same.
- The course: each point's coordinates, piece by piece polynomials of the phase.

A piece is a polynomial of degree 15 through the solutions at Chebyshev's places, which are worked out in 38
digits; it is halved where its last coefficients are not below the last digit. So places and rates keep their
digits at limits as anywhere, no equation is solved again, and a pose needs none before it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from decimal import Decimal, localcontext
from fractions import Fraction
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import AssemblyError, EndsError
from linkanim.frozen import frozen
from linkanim.mechanics.angles import FULL_TURN, Sum, exact_angle, reduced, two_sum
from linkanim.mechanics.arithmetic import LookUp, Moving, Slope, Value, arctan2, maximum, minimum, rint
from linkanim.mechanics.groups import LinkGroup, group_of
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.precise import context, nodes
from linkanim.mechanics.program import Array
from linkanim.mechanics.solver.following import (
    BITS,
    ONE,
    FixedPoint,
    Followed,
    LinkEquations,
    Whole,
    fixed,
    followed,
    followed_to,
    in_floats,
    system_of,
    units_of,
)
from linkanim.mechanics.solver.input import InputPath, InputState, Swing, TravelState, Turn
from linkanim.mechanics.solver.strokes import SliderStroke, slider_stroke
from linkanim.mechanics.tolerances import AT_LIMIT, GUESSED, LIMIT_SOLVED, SOLVED_TO_ALL_DIGITS

# The limits of the closure that was followed, found in 38 digits.

_ROUNDS = 12


class TurningPlace(NamedTuple):
    """A place at which the input turns back: the unknowns, and the direction of the path there."""

    y: Whole
    tangent: Array


def next_limit(system: LinkEquations, y: Array, tangent: Array) -> TurningPlace:
    """Return the limit next to a place: F = 0 and J v = 0 with v of length 1, whose input stands still."""
    exact, size = FixedPoint(system), system.size
    v = tangent.copy()
    v[-1] = 0.0
    v /= np.linalg.norm(v)
    row = v.copy()
    at, along = fixed(y.reshape(-1, 1)), fixed(v.reshape(-1, 1))
    for _ in range(_ROUNDS):
        here, way = in_floats(at)[:, 0], in_floats(along)[:, 0]
        whole = np.zeros((2 * size, 2 * size))
        jacobian = system.jacobian(here[None])[0]
        whole[: size - 1, :size] = jacobian
        whole[size - 1 : 2 * size - 2, :size] = system.bend(here, way)
        whole[size - 1 : 2 * size - 2, size:] = jacobian
        whole[-2, size:], whole[-1, -1] = row, 1.0
        off = np.concatenate(
            [
                in_floats(exact.residual(at))[:, 0],
                in_floats(exact.along(at, along))[:, 0],
                [float(in_floats(fixed(row.reshape(-1, 1)) * along >> BITS).sum()) - 1.0, way[-1]],
            ]
        )
        try:
            step = np.linalg.solve(whole, -off)
        except np.linalg.LinAlgError:
            break
        at = at + fixed(step[:size].reshape(-1, 1))
        along = along + fixed(step[size:].reshape(-1, 1))
        if np.abs(step[:size]).max() < LIMIT_SOLVED:
            break
    here, way = in_floats(at)[:, 0], in_floats(along)[:, 0]
    if not np.isfinite(here).all() or np.abs(here - y).max() > 1.0:
        raise _unclear(y)
    return TurningPlace(at[:, 0], way / np.linalg.norm(way))


def _unclear(y: Array) -> AssemblyError:
    return AssemblyError(
        f"its input stops near {math.degrees(float(y[-1])):.6g} deg where more than two closures meet;"
        " make one length longer or shorter"
    )


# The input's path: a turn, a swing between two limits and back on the other closure, or on the same.


class PathBranch(NamedTuple):
    """Places in order along which the input goes one way: unknowns (n, m) and directions (n, m)."""

    y: Array
    tangent: Array


BY_PHASE, BY_ANGLE, BY_LENGTH = range(3)


class InputRoute(NamedTuple):
    """The path of the input, and the branches of the closure on it: one, or one each way.

    Of an input that turns back `ends` are where it is at the phases 0 and π. Its polynomials are `by` the
    phase, by the input's angle from its start, or by a length: that from -π at one end to π at the other.
    """

    path: InputPath
    branches: tuple[PathBranch, ...]
    ends: tuple[int, int] | None = None
    by: int = BY_PHASE

    @property
    def returns(self) -> bool:
        """Whether the phases below zero have the poses of those above."""
        return len(self.branches) == 1 and self.by == BY_PHASE


class LimitedPath(NamedTuple):
    """A closed path of closures around a pose: from its lower limit up to the upper one, and on down.

    All the way round there are so many `limits`, and the input has gone on by whole `turns`.
    """

    low: TurningPlace
    high: TurningPlace
    up: PathBranch
    down: PathBranch
    limits: int
    turns: float


def route_of(linkage: Linkage, system: LinkEquations, unscale: float) -> InputRoute:
    """Return the path of a linkage's input and its branches; AssemblyError where it cannot be followed."""
    if system.slides:
        return _stroke_route(linkage, system, unscale)
    circuit, drive, group = followed(system), linkage.drive, group_of(linkage)
    assert group is not None
    if not circuit.limits:
        whole = PathBranch(*_closed(system, circuit))
        return InputRoute(Turn(drive.start, round(circuit.change / math.tau)), (whole,), by=BY_ANGLE)
    around = limited(system, circuit)
    both = around.limits == 2 and not around.turns and not drive.retraced
    lower, upper = (_sum(limit.y[-1]) for limit in (around.low, around.high))
    lower = lower - FULL_TURN.times(around.turns)
    repeats = math.ceil(abs(float(upper - lower)) / math.tau)
    swing = Swing(lower, upper, (group.points[0],) * 2, repeats, keeps=(not both,) * 2)
    ends = int(lower.fraction * ONE), int(upper.fraction * ONE)
    return InputRoute(swing, (around.up, around.down) if both else (around.up,), ends)


def _closed(system: LinkEquations, circuit: Followed) -> tuple[Array, Array]:
    """Return the unknowns and the directions of a closed path, which ends where it begins."""
    first, last = circuit.places[0], circuit.places[-1]
    end = last.y + wrapped(system, first.y - last.y)
    y = np.array([*(place.y for place in circuit.places), end])
    return y, np.array([*(place.tangent for place in circuit.places), first.tangent])


def limited(system: LinkEquations, circuit: Followed) -> LimitedPath:
    """Return the closed path around the pose that was followed, with the limits next to the pose."""
    y, tangents = _closed(system, circuit)
    offset = y[-1] - y[0]
    ends = [next_limit(system, *_between(y, tangents, n)) for n in circuit.limits]
    (high, stop), (low, back) = (ends[0], circuit.limits[0]), (ends[-1], circuit.limits[-1])
    bottom, top = in_floats(low.y), in_floats(high.y)
    up = PathBranch(
        np.vstack([bottom - offset, y[back:-1] - offset, y[:stop], top]),
        np.vstack([low.tangent, tangents[back:-1], tangents[:stop], high.tangent]),
    )
    down = PathBranch(
        np.vstack([top, y[stop:back], bottom]),
        np.vstack([high.tangent, tangents[stop:back], low.tangent]),
    )
    turns = 0.0 if system.slides else float(round(offset[-1] / math.tau))
    return LimitedPath(low, high, up, down, len(ends), turns)


def _stroke_route(linkage: Linkage, system: LinkEquations, unscale: float) -> InputRoute:
    """Return the path of a length that drives, as far as its ends are, and its branches.

    Between ends that both are limits it comes back on the other closure, else the way that it went.
    """
    stroke, back = slider_stroke(linkage, unscale, None), linkage.drive.retraced
    ends = [Fraction(end) * Fraction(system.shrunk) for end in sorted((stroke.first, stroke.last))]
    ways = [_way_to(linkage, system, float(end), unscale) for end in ends]
    (down, low), (up, high) = ways
    exact = [
        int(limit.y[-1]) if limit else int(end * ONE) for end, (_, limit) in zip(ends, ways, strict=True)
    ]
    turned = (exact[0], exact[1]) if stroke.first < stroke.last else (exact[1], exact[0])
    branch = PathBranch(np.vstack([down.y[:0:-1], up.y]), np.vstack([-down.tangent[:0:-1], up.tangent]))
    if low and high and not back:
        around = limited(system, followed(system))
        if around.limits == 2:
            return InputRoute(stroke, (around.up, around.down), turned)
    at_limit = low is not None or high is not None
    kept = replace(stroke, keeps=(back or at_limit,) * 2)
    return InputRoute(kept, (branch,), turned, by=BY_PHASE if at_limit else BY_LENGTH)


def _way_to(
    linkage: Linkage, system: LinkEquations, end: float, unscale: float
) -> tuple[PathBranch, TurningPlace | None]:
    """Return the path from the pose to an end of the input, or beyond, and the limit where the end is one."""
    places, turned = followed_to(system, end)
    y, tangents = (np.array(part) for part in zip(*(place[:2] for place in places), strict=True))
    if not turned:
        return PathBranch(y, tangents), None
    limit = next_limit(system, *_between(y, tangents, len(y) - 1))
    there = in_floats(limit.y)
    y, tangents = np.vstack([y[:-1], there]), np.vstack([tangents[:-1], limit.tangent])
    beyond = (end - there[-1]) * (1.0 if end > system.start[-1] else -1.0)
    if beyond > AT_LIMIT:
        actuator, unit = linkage.drive.actuator, linkage.unit
        length = f"{actuator.noun}'s {'length' if actuator.along else 'travel'}"
        most, stated = (place / system.shrunk * unscale for place in (float(there[-1]), end))
        raise EndsError(
            f"its links let the {length} come to {most:.6g} {unit}, not to {stated:g} {unit};"
            " choose another end"
        )
    return PathBranch(y, tangents), limit if beyond > -AT_LIMIT else None


def travel_range(linkage: Linkage) -> tuple[float, float]:
    """Return the limits of a length that drives a group; AssemblyError where it has none."""
    system = system_of(linkage)
    circuit = followed(system)
    if not circuit.limits:
        raise AssemblyError("nothing stops its input; give it two ends, such as from = 80, to = 160")
    around = limited(system, circuit)
    low, high = (Fraction(limit.y[-1], ONE) / Fraction(system.shrunk) for limit in (around.low, around.high))
    return float(low), float(high)


def wrapped(system: LinkEquations, away: Array) -> Array:
    """Return a difference of unknowns with whole turns taken off its angles."""
    away, turns = away.copy(), system.turning
    away[turns] -= math.tau * np.rint(away[turns] / math.tau)
    return away


def _between(y: Array, tangents: Array, n: int) -> tuple[Array, Array]:
    """Return about where, before the place n, the input's rate along the path is zero, and the direction."""
    before, after = tangents[n - 1][-1], tangents[n][-1]
    step = tangents[n - 1] @ (y[n] - y[n - 1])
    share = before / (before - after)
    at = y[n - 1] + step * share * tangents[n - 1]
    return at, tangents[n - 1] * (1 - share) + tangents[n] * share


def _sum(whole: int) -> Sum:
    number = Fraction(whole, ONE)
    high = float(number)
    return Sum(high, float(number - Fraction(high)))


# The course: each point's coordinates, piece by piece polynomials of the phase.

COUNT = 16
"""The coefficients of a piece."""
_LAST_BIT = 66
"""The last two coefficients of a piece are below this power of a half, in lengths of the system."""
_BEYOND = 3.0
"""A point that is so many times as far from one point as another is has coordinates of its own."""
_LONG = 5
"""Pieces halved no more often are not short."""
_FINEST = 16
"""Pieces are halved so many times at the most, from one for the whole period."""


@frozen
class GroupMotion:
    """The motion of a group over its period: for each coordinate a table of each coefficient.

    `bins` equal parts of the period, from minus half of it, each have a piece's number. It is a period of the
    phase, or of the angle from the start, or the way of a length between its ends. `derived` points lie on
    links with two points known: at their first plus ζ times the way to the second.
    """

    turns: int
    by: int
    bins: int
    piece: LookUp
    centres: LookUp
    shares: LookUp
    coefficients: Mapping[str, tuple[LookUp, ...]]
    derived: Mapping[str, tuple[tuple[str, str], complex]]

    @property
    def by_angle(self) -> bool:
        """Whether it goes by the angle of an input that turns fully."""
        return self.by == BY_ANGLE

    @property
    def pieces(self) -> int:
        """The number of pieces."""
        return len(self.centres.values)


def followed_course(linkage: Linkage, unscale: float) -> tuple[InputPath, GroupMotion]:
    """Return the path of a linkage's input, and the course of its group; AssemblyError without one.

    Times `unscale` lengths are in the scene's unit.
    """
    system = system_of(linkage)
    route = route_of(linkage, system, unscale)
    group = group_of(linkage)
    assert group is not None
    placed, derived = carriers(linkage, group)
    period = route.path.turns if isinstance(route.path, Turn) else 1
    fitted = _Fit(system, route, period, placed).pieces()
    return route.path, _course(fitted, route, period, derived, system.shrunk)


def carriers(
    linkage: Linkage, group: LinkGroup
) -> tuple[dict[str, tuple[int, str]], dict[str, tuple[tuple[str, str], complex]]]:
    """Return the points whose coordinates are kept, each with a link and its number, and the derived ones."""
    moving = [group.crank] * bool(group.crank) + [member.name for member in group.moving]
    numbers = {name: n for n, name in enumerate(moving)}
    names = [joint.name for joint in linkage.joints]
    known = names[: names.index(group.points[0])]
    placed: dict[str, tuple[int, str]] = {}
    derived: dict[str, tuple[tuple[str, str], complex]] = {}
    waiting = list(group.points)
    while waiting:
        for member in group.free:
            first, *others = [name for name in member.points if name in known] or [""]
            start = member.place(first) if first else 0j
            second = next((name for name in others if member.place(name) != start), "")
            for name in [name for name in member.points if second and name in waiting]:
                share = (member.place(name) - start) / (member.place(second) - start)
                if abs(share) > _BEYOND:
                    continue
                derived[name] = (first, second), share
                known.append(name)
                waiting.remove(name)
        if waiting:
            # the point on most links goes first: it shows most of them
            name = max(waiting, key=lambda point: (len(group.at_point(point)), -waiting.index(point)))
            member = next(one for one in group.at_point(name) if one.name in numbers)
            placed[name] = numbers[member.name], name
            known.append(name)
            waiting.remove(name)
    return placed, derived


class MotionPiece(NamedTuple):
    """A polynomial of each quantity on one of 2^depth parts of the period."""

    depth: int
    part: int
    coefficients: Whole
    """(quantities, COUNT), in the part's own variable from -1 to 1."""


class _Fit:
    """Fits pieces to the solutions over the period, which is `period` turns."""

    def __init__(
        self,
        system: LinkEquations,
        route: InputRoute,
        period: int,
        placed: Mapping[str, tuple[int, str]],
    ) -> None:
        self.system, self.route, self.period = system, route, period
        self.exact, self.placed = FixedPoint(system), placed

    @property
    def names(self) -> list[str]:
        """The quantities in their order."""
        points = [f"{name}.{part}" for name in self.placed for part in "xy"]
        return [*points, *(slot.name for slot in self.system.slots)]

    def pieces(self) -> tuple[list[str], list[MotionPiece]]:
        """Return the quantities' names and the pieces in order."""
        places = sum(len(branch.y) for branch in self.route.branches)
        depth = max(math.ceil(math.log2(places)) - 1, 3)
        waiting, pieces = [(depth, part) for part in range(1 << depth)], list[MotionPiece]()
        if self.route.returns:
            waiting = [one for one in waiting if one[1] >= 1 << depth - 1]
        while waiting:
            fitted = self._fitted(waiting)
            waiting = []
            for piece in fitted:
                if _is_close(piece):
                    pieces.append(piece)
                elif piece.depth == _FINEST:
                    raise AssemblyError(_TOO_NEAR[self.route.by == BY_LENGTH])
                else:
                    waiting += [(piece.depth + 1, 2 * piece.part + n) for n in (0, 1)]
        if self.route.returns:
            pieces += [_mirrored(piece) for piece in pieces]
        return self.names, sorted(pieces, key=lambda piece: piece.part / (1 << piece.depth))

    def _fitted(self, parts: Sequence[tuple[int, int]]) -> list[MotionPiece]:
        places, inverse = _inverse_powers()
        half = self.period * PI_WHOLE
        phases = [
            int(Fraction(_middle(self.period, depth, part)) * ONE) + (half * place // (1 << depth) >> BITS)
            for depth, part in parts
            for place in places
        ]
        values = self._solved(np.array(phases, np.object_)).reshape(-1, len(parts), COUNT)
        fitted = np.einsum("qpk,ck->pqc", values, inverse) >> BITS
        return [MotionPiece(*part, coefficients) for part, coefficients in zip(parts, fitted, strict=True)]

    def _solved(self, phases: Whole) -> Whole:
        """Return the quantities (q, N) at phases within half a period of zero."""
        inputs = self._inputs(phases)
        y = self._guessed(in_floats(phases), in_floats(inputs))
        for _ in range(4):
            step = np.linalg.solve(self.system.jacobian(y)[:, :, :-1], self.system.residual(y)[..., None])[
                ..., 0
            ]
            y[:, :-1] -= step
            if np.abs(step).max() < GUESSED:
                break
        at = fixed(y.T)
        at[-1] = inputs
        self._to_all_digits(at)
        units = self.exact.units(at)
        rows: list[Any] = []
        for link, name in self.placed.values():
            rows += self.exact.point(at, units, link, name)
        slides = 3 * self.system.links
        return np.array([*rows, *at[slides : slides + len(self.system.slots)]], np.object_)

    def _to_all_digits(self, at: Whole) -> None:
        """Solve unknowns (m, N) in place, by corrections in floats, until the next one would be too small.

        Beside a limit a correction is a worse one than elsewhere: by how much shows in the one before.
        """
        waiting, before = np.arange(at.shape[1]), np.full(at.shape[1], math.inf)
        for _ in range(_ROUNDS):
            now = at[:, waiting]
            inverse = np.linalg.inv(self.system.jacobian(in_floats(now).T)[:, :, :-1])
            off: Array = in_floats(self.exact.residual(now)).T
            step = np.asarray(inverse @ off[..., None])[..., 0].T
            at[:-1, waiting] = now[:-1] - fixed(step)
            size = np.abs(step).max(axis=0)
            error = size * np.minimum(size / before, 1.0) if np.isfinite(before).all() else size
            more = error > SOLVED_TO_ALL_DIGITS
            waiting, before = waiting[more], size[more]
            if not waiting.size:
                break

    def _inputs(self, phases: Whole) -> Whole:
        """Return the input at phases."""
        path = self.route.path
        if isinstance(path, Turn):
            start = exact_angle(path.start).fraction
            whole = round((self.system.at - path.start) / math.tau)
            first = int(start * ONE) + 2 * whole * PI_WHOLE
            begin = int(Fraction(float(self.route.branches[0].y[0, -1])) * ONE)
            span = 2 * self.period * PI_WHOLE
            # the branch begins at the pose
            return np.asarray((phases + first - begin) % span + begin, np.object_)
        assert self.route.ends is not None
        low, high = self.route.ends
        if self.route.by == BY_LENGTH:
            return np.asarray((low + high) // 2 + (high - low) * phases // (2 * PI_WHOLE), np.object_)
        cosine, _ = units_of(phases)
        return np.asarray((low + high) // 2 - ((high - low) // 2 * cosine >> BITS), np.object_)

    def _guessed(self, phases: Array, inputs: Array) -> Array:
        """Return the unknowns (N, m) near the solutions, by cubics between the places that were followed."""
        guess = np.empty((len(phases), self.system.size))
        for n, branch in enumerate(self.route.branches):
            own = np.ones(len(phases), bool) if len(self.route.branches) == 1 else (phases < 0) == (n == 1)
            guess[own] = _on_branch(branch, inputs[own])
        guess[:, -1] = inputs
        return guess


PI_WHOLE = int(Fraction("3.14159265358979323846264338327950288419716939937510582097494459") * ONE)


def _on_branch(branch: PathBranch, inputs: Array) -> Array:
    """Return the unknowns on a branch at inputs, by Hermite's cubic in the path's length."""
    y, tangents = branch
    ways = np.diff(y, axis=0)
    lengths = np.einsum("ij,ij->i", tangents[:-1], ways)
    leaning = np.einsum("ij,ij->i", tangents[:-1], tangents[1:])
    first, last = tangents[:-1] * lengths[:, None], tangents[1:] * (lengths / leaning)[:, None]
    sense = 1.0 if y[-1, -1] > y[0, -1] else -1.0
    at = np.clip(np.searchsorted(sense * y[:, -1], sense * inputs, side="right") - 1, 0, len(ways) - 1)

    def cubic(share: Array, n: NDArray[np.intp], column: Any) -> Array:
        s = share if share.ndim == np.ndim(y[n, column]) else share[:, None]
        rest = 1 - s
        values: Array = (
            y[n, column]
            + ways[n, column] * s * s * (3 - 2 * s)
            + first[n, column] * s * rest * rest
            - last[n, column] * s * s * rest
        )
        return values

    low, high = np.zeros(len(inputs)), np.ones(len(inputs))
    for _ in range(40):
        middle = (low + high) / 2
        below = sense * cubic(middle, at, -1) < sense * inputs
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return cubic((low + high) / 2, at, slice(None))


@lru_cache(maxsize=1)
def _inverse_powers() -> tuple[list[int], Whole]:
    """Return Chebyshev's places in fixed point, and the matrix that makes coefficients of values there."""
    places = nodes(COUNT)
    with localcontext(context()) as here:
        here.prec = 80
        rows = np.array([[node**k for k in range(COUNT)] for node in places], np.object_)
        unit = np.array([[Decimal(int(i == k)) for k in range(COUNT)] for i in range(COUNT)], np.object_)
        whole = np.concatenate([rows, unit], axis=1)
        for n in range(COUNT):
            pivot = n + max(range(COUNT - n), key=lambda k: abs(whole[n + k, n]))
            whole[[n, pivot]] = whole[[pivot, n]]
            whole[n] = whole[n] / whole[n, n]
            for k in range(COUNT):
                if k != n:
                    whole[k] = whole[k] - whole[n] * whole[k, n]
        inverse = [[_whole(entry) for entry in row] for row in whole[:, COUNT:]]
        return [_whole(node) for node in places], np.array(inverse, np.object_)


def _whole(number: Decimal) -> int:
    return int(number * ONE)


def _is_close(piece: MotionPiece) -> bool:
    """Tell whether the last coefficients, as those of Chebyshev's polynomials, are below the last digit.

    Those of a short piece are below that of its second derivative, by the phase.
    """
    last = np.abs(piece.coefficients[:, -2:]) >> np.array([COUNT - 3, COUNT - 2], np.object_)
    return bool(last.max() < 1 << BITS - _LAST_BIT - 2 * max(piece.depth - _LONG, 0))


def _middle(period: int, depth: int, part: int) -> float:
    """Return the phase about which a piece is fitted: a float, so that none is lost where it is read."""
    return float(Fraction(period * PI_WHOLE * (2 * part + 1 - (1 << depth)), ONE << depth))


def _mirrored(piece: MotionPiece) -> MotionPiece:
    """Return the piece of the same places at the opposite phases."""
    signs = np.array([1 - 2 * (k % 2) for k in range(COUNT)], np.object_)
    return MotionPiece(piece.depth, (1 << piece.depth) - 1 - piece.part, piece.coefficients * signs)


_TOO_NEAR = (
    "its links come so near to a change point that no float tells their two closures apart; make one length"
    " longer or shorter",
    "its input ends so near to a limit that no float tells their distance; leave that end out, or choose one"
    " farther from it",
)


def _course(
    fitted: tuple[list[str], list[MotionPiece]],
    route: InputRoute,
    period: int,
    derived: Mapping[str, Any],
    shrunk: float,
) -> GroupMotion:
    names, pieces = fitted
    depth = max(piece.depth for piece in pieces)
    bins = [n for n, piece in enumerate(pieces) for _ in range(1 << depth - piece.depth)]
    half = period * math.pi
    halves = [half / (1 << piece.depth) for piece in pieces]
    centres = [_middle(period, piece.depth, piece.part) for piece in pieces]
    values = np.array([in_floats(piece.coefficients) for piece in pieces]) / shrunk
    # a point that does not move across its guide has what its solution's last digits leave there
    values[np.abs(values) * shrunk < SOLVED_TO_ALL_DIGITS] = 0.0
    tables = {
        name: tuple(LookUp(values[:, n, k].tolist()) for k in range(COUNT)) for n, name in enumerate(names)
    }
    shares = LookUp([1.0 / one for one in halves])
    return GroupMotion(
        period,
        route.by,
        1 << depth,
        LookUp([*map(float, bins)]),
        LookUp(centres),
        shares,
        tables,
        derived,
    )


def reader(course: GroupMotion, state: InputState, path: InputPath, start: float) -> Callable[[str], Moving]:
    """Return what reads a quantity of a course, with its rates, where the input is in a state.

    `start` is the angle of the input's start.
    """
    if course.by == BY_LENGTH:
        near, pace = _gone(state, path)
    else:
        phase, rest, pace = _from_start(state, start) if course.by_angle else _phase(state)
        _, near = reduced(phase, rest, 2.0 * course.turns)
    half = course.turns * math.pi
    place = rint(near * (course.bins / (2 * half)) + (course.bins / 2 - 0.5))
    piece = course.piece.at(minimum(maximum(place, 0.0), course.bins - 1.0))
    share = course.shares.at(piece)
    t = (near - course.centres.at(piece)) * share
    rate = share * pace.value
    square, bend = rate * rate, share * pace.rate

    def read(name: str) -> Moving:
        *others, last = course.coefficients[name]
        value, first, second = last.at(piece), 0.0, 0.0  # type: tuple[Value, Value, Value]
        for table in reversed(others):
            second = second * t + first
            first = first * t + value
            value = value * t + table.at(piece)
        return Moving(value, first * rate, second * (square * 2.0) + first * bend)

    return read


def _gone(state: InputState, path: InputPath) -> tuple[Value, Slope]:
    """Return how far a length has gone, from -π at one end to π at the other, and its pace."""
    assert isinstance(state, TravelState)
    assert isinstance(path, SliderStroke)
    travel, share = state.travel, 2 * math.pi / (path.last - path.first)
    return (travel.value - (path.first + path.last) / 2) * share, Slope(travel.rate, travel.second).scaled(
        share
    )


def _from_start(state: InputState, start: float) -> tuple[Value, Value, Slope]:
    """Return the input's angle from its start, what the float lacks of it, and its pace."""
    angle, rest = two_sum(state.angle, float(state.origin - exact_angle(start)))
    return angle, rest, Slope(state.rate, state.second)


def _phase(state: InputState) -> tuple[Value, Value, Slope]:
    """Return the phase of an input's state, what the float lacks of it, and its pace."""
    if isinstance(state, TravelState):
        return state.angle, 0.0, state.pace
    assert state.ends is not None
    if state.phase is not None:
        return state.phase, 0.0, state.phase_pace
    angle = arctan2(state.ends.root_v.value, state.ends.root_u.value) * 2.0
    return angle, 0.0, state.phase_pace
