"""Burmester's theory: which points of a body stay on a circle, or on a line, through its poses.

A circle point z of the body has the same distance from a fixed point m, its centre point, in all poses, so
that a bar may join them; z is given by its place in the first pose. Pose j is turned by e^(iα) and shifted by
δ from the first. With coordinates from the first pose's origin the condition is

    |δ|²/2 + Re(δ̄ e^(iα) z) - Re(m̄ (δ + (e^(iα) - 1) z)) = 0,

linear in z and linear in m. Two poses leave three choices, three poses two: each centre point has its
circle point. Four poses leave one: the centre points lie on a cubic (Burmester, Lehrbuch der Kinematik,
1888), which runs through the poles, so that lines through a pole meet it in two points more and it is walked
by a square root. Five poses leave none: four cubics, each of which leaves one pose out, have a pencil of
conics among their combinations, and two conics meet in four points. A point whose centre lies at infinity
runs along a line: for three poses such points lie on a circle, for four poses it is one, Ball's point
(Bottema and Roth, Theoretical Kinematics, 1979; McCarthy, Geometric Design of Linkages, 2000).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from decimal import Decimal, localcontext
from fractions import Fraction
from functools import cached_property
from itertools import combinations, pairwise, zip_longest
from typing import Any, NamedTuple

import numpy as np

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.precise import context, sine_and_cosine
from linkanim.synthesis.linkages import Complex, Indices, Real

FEWEST, MOST = 2, 5
"""The least and the largest number of poses."""
SAME = 1e-9
"""The distance, in the poses' size, or angle (rad), below which two are the same."""
_ROUNDING = 2.0**-40
"""The distance, as a share of the farthest coordinate, by which equal poles may differ."""
_LARGEST = 1e30
"""The largest x or y: a larger number cannot be computed with, and no scene file takes it."""
STRAIGHT = 1e-12
"""The distance from a line, in the poses' size, up to which a point counts as running along it."""
_FAR = 1e6
"""The farthest end of a bar, in the poses' size."""
_LOOSE = 1e-6
"""How much a length may differ from pose to pose, as a share of it, before it is polished."""
_FLAT = 1e-13
"""A discriminant that falls below zero by this share of its greatest value only touches zero."""
_ROOT_STEPS = 200
_FINE, _FOOT_STEPS = 720, 60
"""The samples of a circuit in a search for the point nearest to another, and the steps towards it."""


class Bars(NamedTuple):
    """Circle points (k,), where they lie in the first pose, and their centre points, as x + yi."""

    circle: Complex
    centre: Complex

    def take(self, chosen: Indices) -> Bars:
        """Return the chosen bars."""
        return Bars(self.circle[chosen], self.centre[chosen])


class Slides(NamedTuple):
    """Points (k,), where they lie in the first pose, and the directions (unit) that they run along."""

    point: Complex
    direction: Complex


@frozen(eq=False)
class Poses:
    """Two to five poses of a body: its origin's places as x + yi, and the angles by which it is turned (rad).

    BadInput for too few or too many poses, for two equal ones, for numbers that are not finite, and for
    angles of more than one turn.
    """

    origins: Complex
    angles: Real

    def __post_init__(self) -> None:
        """Refuse what no linkage could be asked for."""
        count = len(self.origins)
        if not FEWEST <= count <= MOST:
            raise BadInput(f"{count} poses: a coupler is guided through {FEWEST} to {MOST} of them")
        for number, (origin, angle) in enumerate(zip(self.origins, self.angles, strict=True), start=1):
            if not (cmath.isfinite(origin) and math.isfinite(angle)):
                raise BadInput(f"pose {number} is not finite; give it x, y and an angle as numbers")
            if abs(origin) > _LARGEST:
                raise BadInput(f"pose {number} lies beyond {_LARGEST:g}; take a larger unit of length")
        for (one, first), (other, second) in combinations(enumerate(self.angles, start=1), 2):
            if abs(second - first) >= math.tau - SAME:
                turned = math.degrees(second - first)
                raise BadInput(
                    f"poses {one} and {other} are turned by {turned:g} deg against each other, which is more "
                    "than once round; a pose is a place, so give it an angle within one turn of the others"
                )
        for one, other in combinations(range(count), 2):
            apart = abs(self.origins[one] - self.origins[other])
            turned = abs(math.remainder(self.angles[one] - self.angles[other], math.tau))
            if apart <= SAME * self.size and turned <= SAME:
                raise BadInput(f"poses {one + 1} and {other + 1} are one; leave one of them out")

    @property
    def count(self) -> int:
        """The number of poses."""
        return len(self.origins)

    @cached_property
    def size(self) -> float:
        """The diagonal of the rectangle about the origins; 1 where they are one point."""
        size = math.hypot(float(np.ptp(self.origins.real)), float(np.ptp(self.origins.imag)))
        return size if size > SAME * float(np.abs(self.origins).max()) else 1.0

    @cached_property
    def centre(self) -> complex:
        """The middle of that rectangle."""
        low = complex(self.origins.real.min(), self.origins.imag.min())
        return (low + complex(self.origins.real.max(), self.origins.imag.max())) / 2

    @cached_property
    def turns(self) -> Complex:
        """The turn of each pose from the first, as complex numbers of modulus 1."""
        return np.asarray(np.exp(1j * (self.angles - self.angles[0])))

    @cached_property
    def shifts(self) -> Complex:
        """The shift of each pose's origin from the first's."""
        return np.asarray(self.origins - self.origins[0])

    def places(self, points: Complex | complex) -> Complex:
        """Return where points of the body, given in the first pose, lie in all poses (..., n)."""
        within = np.asarray(points)[..., None] - self.origins[0]
        return np.asarray(self.origins + self.turns * within)

    def images(self, points: Complex | complex) -> Complex:
        """Return fixed points as seen from the body in each pose, in coordinates of the first (..., n)."""
        return np.asarray(self.origins[0] + (np.asarray(points)[..., None] - self.origins) / self.turns)

    @cached_property
    def inverse(self) -> Poses:
        """The poses of the fixed plane as seen from the body, in the first pose's coordinates.

        Circle points and centre points are exchanged in it.
        """
        origins = self.images(complex(self.origins[0]))
        return Poses(origins, 2 * self.angles[0] - self.angles)

    def pole(self, one: int, other: int) -> complex | None:
        """Return the point about which a turn takes one pose to the other; None where they are parallel."""
        turn = complex(self.turns[other] / self.turns[one])
        if abs(1 - turn) <= SAME:
            return None
        return complex((self.origins[other] - turn * self.origins[one]) / (1 - turn))

    @cached_property
    def poles(self) -> dict[tuple[int, int], complex]:
        """The poles of all pairs of poses that have one."""
        pairs = ((pair, self.pole(*pair)) for pair in combinations(range(self.count), 2))
        return {pair: pole for pair, pole in pairs if pole is not None}

    @cached_property
    def one_pole(self) -> complex | None:
        """The one point about which three poses or more are all turned; None where there is none."""
        poles = list(self.poles.values())
        pairs = self.count * (self.count - 1) // 2
        if self.count == FEWEST or len(poles) < pairs:
            return None
        same = SAME * max(self.size, abs(poles[0] - self.centre))
        rounding = _ROUNDING * float(np.abs(self.origins).max())
        near = max(abs(pole - poles[0]) for pole in poles) <= max(same, rounding)
        return poles[0] if near else None


def _rows(poses: Poses, centres: Complex) -> Real:
    """Return the equations of centres' circle points (k, n - 1, 3): coefficients of 1, and z's x and y."""
    shift, turn = poses.shifts[1:], poses.turns[1:]
    centre = (np.asarray(centres) - poses.origins[0])[:, None]
    factor = np.conj(shift) * turn - np.conj(centre) * (turn - 1)
    constant = np.abs(shift) ** 2 / 2 - (np.conj(centre) * shift).real
    return np.stack([constant, factor.real, -factor.imag], axis=-1)


def circle_points(poses: Poses, centres: Complex) -> Complex:
    """Return the circle points of centre points (k,) of three poses, or of a cubic's of four; NaN for none.

    There is none where the centre's images in the body lie on a line or coincide, or where it is off the
    cubic.
    """
    rows = np.moveaxis(_rows(poses, centres), 0, -1)
    pairs = [_cross(one, other) for one, other in combinations(rows, 2)]
    products = np.array(pairs)
    best = np.abs(products).max(axis=1).argmax(axis=0)
    one, x, y = products[best, :, np.arange(products.shape[2])].T
    with np.errstate(all="ignore"):
        place = poses.origins[0] + (x + 1j * y) / one
        lengths = np.abs(poses.places(place) - np.asarray(centres)[:, None])
        sound = np.abs(place - poses.centre) <= _FAR * poses.size
        sound &= np.ptp(lengths, axis=1) <= _LOOSE * np.maximum(lengths.max(axis=1), poses.size)
    return np.asarray(np.where(sound, place, np.nan))


def centre_points(poses: Poses, circles: Complex) -> Complex:
    """Return the centre points of circle points (k,) of three poses; NaN where its places lie on a line."""
    places = poses.places(circles)
    one, other = places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]
    across = 2 * (np.conj(one) * other).imag
    with np.errstate(all="ignore"):
        centres = places[:, 0] + 1j * (one * np.abs(other) ** 2 - other * np.abs(one) ** 2) / across
    far = ~(np.abs(centres - poses.centre) <= _FAR * poses.size)
    return np.asarray(np.where(far, np.nan, centres))


def polished(poses: Poses, bars: Bars, *, held: bool = False) -> Bars:
    """Return bars without rounding errors: moved by the least that makes their lengths equal in all poses.

    With `held` the centre points stay where they are, which three poses at the most leave free.
    """
    circle, centre = bars
    for _ in range(2):
        places = poses.places(circle)
        arm = places - centre[:, None]
        off = ((places - places[:, :1]) * np.conj(places + places[:, :1] - 2 * centre[:, None])).real[:, 1:]
        by_circle = 2 * (np.conj(arm) * poses.turns - np.conj(arm[:, :1]))[:, 1:]
        by_centre = -2 * np.conj(arm - arm[:, :1])[:, 1:]
        by_centre *= not held
        slopes = np.stack([by_circle.real, -by_circle.imag, by_centre.real, -by_centre.imag], axis=-1)
        scale = np.abs(slopes).max(axis=(1, 2), initial=0.0)[:, None, None]
        step = np.einsum("kpj,kj->kp", np.linalg.pinv(slopes / np.where(scale, scale, 1.0)), -off)
        step /= np.where(scale, scale, 1.0)[:, 0]
        circle = circle + step[:, 0] + 1j * step[:, 1]
        centre = centre + step[:, 2] + 1j * step[:, 3]
    return Bars(circle, centre)


# The equations as polynomials in the centre point: in floats for a curve, in Decimals for points.

_Linear = tuple[Any, Any, Any]
"""Coefficients of x, y and 1."""
_Row = tuple[_Linear, _Linear, _Linear]


def _equation(shift: tuple[Any, Any], turn: tuple[Any, Any]) -> _Row:
    """Return a pose's equation: the coefficients of 1, and z's x and y, as linear functions of the centre."""
    (x, y), (c, s) = shift, turn
    return (
        (-x, -y, (x * x + y * y) / 2),
        (1 - c, -s, x * c + y * s),
        (s, 1 - c, y * c - x * s),
    )


def _cubic(rows: Sequence[_Row]) -> list[Any]:
    """Return the determinant of three equations: the coefficients of x³, x²y, xy², y³, x², xy, y², x, y, 1.

    The first four are α, β, α, β: it is a circular cubic.
    """
    total: list[Any] = [0] * 10
    for n in range(3):
        one, other = rows[(n + 1) % 3], rows[(n + 2) % 3]
        minor = _minus(_times(one[1], other[2]), _times(other[1], one[2]))
        total = [a + b for a, b in zip(total, _raised(rows[n][0], minor), strict=True)]
    return total


def _times(one: _Linear, other: _Linear) -> list[Any]:
    """Return the product of linear functions: the coefficients of x², xy, y², x, y, 1."""
    (a, b, c), (d, e, f) = one, other
    return [a * d, a * e + b * d, b * e, a * f + c * d, b * f + c * e, c * f]


def _minus(one: list[Any], other: list[Any]) -> list[Any]:
    return [a - b for a, b in zip(one, other, strict=True)]


def _raised(linear: _Linear, conic: list[Any]) -> list[Any]:
    """Return the product of a linear function and a conic: coefficients in the order of `_cubic`."""
    a, b, c = linear
    xx, xy, yy, x, y, one = conic
    return [
        *(a * xx, a * xy + b * xx, a * yy + b * xy, b * yy),
        *(a * x + c * xx, a * y + b * x + c * xy, b * y + c * yy),
        *(a * one + c * x, b * one + c * y, c * one),
    ]


# Four poses: the cubic of the centre points.


@frozen(eq=False)
class CentreCurve:
    """The centre points of four poses: circuits, each walked by a phase from 0 to 2π.

    A circuit may run through infinity. BadInput for a body that does not turn, which has no such curve.
    """

    poses: Poses

    @cached_property
    def _form(self) -> list[float]:
        shifts = zip(self.poses.shifts[1:] / self.poses.size, self.poses.turns[1:], strict=True)
        pairs = (((shift.real, shift.imag), (turn.real, turn.imag)) for shift, turn in shifts)
        return _cubic([_equation(*pair) for pair in pairs])

    @cached_property
    def _about(self) -> tuple[complex, Real]:
        """The pole that the lines run through, and the curve's coefficients about it, at size 1.

        The coefficients are of x³ and y³, of x², xy and y², of x and y. Of all poles it is the one at which
        they are farthest from all vanishing along a line.
        """
        poles = [
            (pole - self.poses.origins[0]) / self.poses.size
            for pole in self.poses.poles.values()
            if abs(pole - self.poses.centre) <= _FAR * self.poses.size
        ]
        if not poles:
            raise BadInput(
                "no two of the poses are turned against each other; their centre points are no curve"
            )
        angles = np.linspace(0.0, math.pi, 48, endpoint=False)
        forms = [self._shifted(pole) for pole in poles]
        if not all(np.abs(form).max() for form in forms):
            raise BadInput("every point is a centre point of these four poses; leave one of them out")
        least = [float(_strength(form, angles).min() / np.abs(form).max()) for form in forms]
        best = int(np.argmax(least))
        return poles[best], forms[best]

    def _shifted(self, pole: complex) -> Real:
        """Return the coefficients about a point of the curve."""
        alpha, beta, _, _, xx, xy, yy, x, y, _ = self._form
        p, q = pole.real, pole.imag
        square = p * p + q * q
        return np.array(
            [
                *(alpha, beta),
                xx + 3 * alpha * p + beta * q,
                xy + 2 * alpha * q + 2 * beta * p,
                yy + alpha * p + 3 * beta * q,
                x + 2 * xx * p + xy * q + alpha * (square + 2 * p * p) + 2 * beta * p * q,
                y + 2 * yy * q + xy * p + beta * (square + 2 * q * q) + 2 * alpha * p * q,
            ]
        )

    @cached_property
    def circuits(self) -> tuple[tuple[float, float, float], ...]:
        """Its circuits: closed curves between two directions, or all the way round once for each root.

        Each is told by the directions of the lines through a pole that meet it, the first and the last, and
        the sign of the root: 0 where that changes at both ends.
        """
        _, form = self._about
        zeros = _discriminant_zeros(form)
        if not zeros:
            return (0.0, math.pi, 1.0), (0.0, math.pi, -1.0)
        ends = [*zeros, zeros[0] + math.pi]
        spans = [
            (low, high)
            for low, high in pairwise(ends)
            if _discriminant(form, np.array([(low + high) / 2]))[0] > 0
        ]
        return tuple((low, high, 0.0) for low, high in spans)

    def at(self, circuit: int, phases: Real) -> Complex:
        """Return the points of a circuit at phases (k,), infinite or NaN at infinity."""
        pole, form = self._about
        low, high, sign = self.circuits[circuit]
        if sign:
            angles, signs = low + (high - low) * phases / math.tau, np.full(len(phases), sign)
        else:
            angles = (low + high) / 2 - (high - low) / 2 * np.cos(phases)
            signs = np.where(np.sin(phases) >= 0, 1.0, -1.0)
        cubic, square, linear = _along(form, angles)
        root = signs * np.sqrt(np.maximum(square * square - 4 * cubic * linear, 0.0))
        one, other = root - square, -root - square
        with np.errstate(all="ignore"):
            far = np.where(np.abs(one) >= np.abs(other), one / (2 * cubic), 2 * linear / other)
            place = pole + far * np.exp(1j * angles)
            return np.asarray(self.poses.origins[0] + self.poses.size * place)

    def nearest(self, point: complex) -> complex:
        """Return the curve's point nearest to a point, by steps from the nearest sample."""
        start, size = complex(self.poses.origins[0]), self.poses.size
        aim = (point - start) / size
        samples = (self.sampled(_FINE) - start) / size
        samples = np.append(samples[np.isfinite(samples)], aim)
        feet = [self._footed(complex(one), aim) for one in samples[np.abs(samples - aim).argsort()[:4]]]
        return start + size * min(feet, key=lambda one: abs(one - aim))

    def _footed(self, place: complex, aim: complex) -> complex:
        """Return the curve's point nearest to `aim`, by steps along the tangent and back on the curve."""
        for _ in range(_FOOT_STEPS):
            value, slope = _value_and_slope(self._form, place)
            if not slope:
                break
            tangent = 1j * slope / abs(slope)
            place += tangent * ((aim - place) * tangent.conjugate()).real - value * slope / abs(slope) ** 2
        return place

    def sampled(self, count: int) -> Complex:
        """Return points of all circuits, `count` of each; none if the curve has no circuit."""
        phases = _around(count)
        circuits = [self.at(circuit, phases) for circuit in range(len(self.circuits))]
        return np.concatenate([np.zeros(0, np.complex128), *circuits])

    def bars(self, count: int) -> Bars:
        """Return circle points with their centre points, at most `count` of each circuit, all finite."""
        centres = self.sampled(count)
        near = np.abs(centres - self.poses.centre) <= _FAR * self.poses.size
        centres = centres[near]
        circles = circle_points(self.poses, centres)
        finite = np.isfinite(circles)
        return polished(self.poses, Bars(circles[finite], centres[finite]))


def _value_and_slope(form: list[float], place: complex) -> tuple[float, complex]:
    """Return the cubic's value at a point, and its gradient as x + yi."""
    alpha, beta, _, _, xx, xy, yy, x, y, one = form
    p, q = place.real, place.imag
    square, line = p * p + q * q, alpha * p + beta * q
    value = square * line + xx * p * p + xy * p * q + yy * q * q + x * p + y * q + one
    by_x = 2 * p * line + alpha * square + 2 * xx * p + xy * q + x
    by_y = 2 * q * line + beta * square + 2 * yy * q + xy * p + y
    return value, complex(by_x, by_y)


def _around(count: int) -> Real:
    """Return `count` even angles all round, the first half a step from 0."""
    return np.asarray((np.arange(count) + 0.5) * (math.tau / count), dtype=np.float64)


def _along(form: Real, angles: Real) -> tuple[Real, Real, Real]:
    """Return the coefficients of r², r and 1 of the curve along directions, its pole at r = 0."""
    c, s = np.cos(angles), np.sin(angles)
    alpha, beta, xx, xy, yy, x, y = form
    return alpha * c + beta * s, xx * c * c + xy * c * s + yy * s * s, x * c + y * s


def _strength(form: Real, angles: Real) -> Real:
    return np.asarray(sum(np.abs(part) for part in _along(form, angles)))


def _discriminant(form: Real, angles: Real) -> Real:
    cubic, square, linear = _along(form, angles)
    return np.asarray(square * square - 4 * cubic * linear)


def _discriminant_zeros(form: Real) -> list[float]:
    """Return the directions from 0 to π at which the two roots become one and then vanish.

    In e^(2it) the discriminant is a polynomial of the fourth degree; five values give it.
    """
    places = np.linspace(0.0, math.pi, 8, endpoint=False)
    values = np.fft.fft(_discriminant(form, places)) / 8
    coefficients = np.array([values[2], values[1], values[0], values[-1], values[-2]])
    if not np.abs(coefficients).max():
        return []
    with np.errstate(all="ignore"):
        roots = np.roots(coefficients)
    on = roots[np.abs(np.log(np.maximum(np.abs(roots), 1e-300))) < 1e-3]
    zeros = sorted(float(angle) % math.pi for angle in np.angle(on) / 2)
    return _crossings(form, zeros)


def _crossings(form: Real, near: list[float]) -> list[float]:
    """Return the directions at which the discriminant changes its sign by more than rounding."""
    if not near:
        return []
    most = float(np.abs(_discriminant(form, np.linspace(0, math.pi, 64))).max())
    ends = [*near, near[0] + math.pi]
    signs = []
    for low, high in pairwise(ends):
        inner = _discriminant(form, low + (high - low) * np.arange(1.0, 8.0) / 8)
        extreme = float(inner[np.abs(inner).argmax()])
        signs.append(extreme > 0 or abs(extreme) <= _FLAT * most)
    return [zero for n, zero in enumerate(near) if signs[n] != signs[n - 1]]


# Five poses: two conics meet in four points.

_COSINE, _SINE = Fraction(20, 29), Fraction(21, 29)
"""The turn of the axes in which five poses are solved, so that no two symmetric answers have the same x."""
_NOTHING, _MET = Decimal("1e-38"), Decimal("1e-15")
"""With fifty digits: the share of a sum's terms below which it is zero, and the error of a met equation."""


def burmester_points(poses: Poses) -> Bars:
    """Return the bars of five poses, at most four, each to the last digit of a float.

    All is computed with fifty digits, so that the digits lost where points nearly coincide or terms nearly
    cancel are beyond a float's. Points farther than a million sizes away are left out. BadInput for poses
    that have infinitely many bars.
    """
    with localcontext(context()):
        size = Decimal(poses.size)
        rows = [_exact_equation(poses, pose, size) for pose in range(1, MOST)]
        pairs = [bar for centre in _centres(rows) for bar in _with_circle(rows, centre)]
        places = [[_placed(poses, place, size) for place in bar] for bar in pairs]
    circles, centres = np.array(places, dtype=np.complex128).reshape(-1, 2).T
    near = (np.abs(circles - poses.centre) <= _FAR * poses.size) & (
        np.abs(centres - poses.centre) <= _FAR * poses.size
    )
    return Bars(circles[near], centres[near])


_Point = tuple[Decimal, Decimal]


def _exact_equation(poses: Poses, pose: int, size: Decimal) -> _Row:
    """Return a pose's equation with all digits, at size 1 and in turned axes."""
    first, origin = complex(poses.origins[0]), complex(poses.origins[pose])
    x, y = (
        (Decimal(b) - Decimal(a)) / size for a, b in ((first.real, origin.real), (first.imag, origin.imag))
    )
    sine, cosine = sine_and_cosine(Decimal(float(poses.angles[pose])) - Decimal(float(poses.angles[0])))
    return _equation(_turned((x, y), 1), (cosine, sine))


def _turned(point: _Point, sense: int) -> _Point:
    """Return a point in the turned axes, or with -1 back in the poses' own."""
    (x, y), c, s = point, _decimal(_COSINE), sense * _decimal(_SINE)
    return x * c - y * s, x * s + y * c


def _decimal(share: Fraction) -> Decimal:
    return Decimal(share.numerator) / share.denominator


def _placed(poses: Poses, place: _Point, size: Decimal) -> complex:
    """Return a point in the poses' own axes, rounded once."""
    x, y = _turned(place, -1)
    first = complex(poses.origins[0])
    return complex(float(Decimal(first.real) + size * x), float(Decimal(first.imag) + size * y))


def _centres(rows: Sequence[_Row]) -> Iterator[_Point]:
    """Yield the centre points: the real points in which two conics of the four cubics' pencil meet."""
    one, other = _conics(rows)
    (a, b, c), (d, e, f) = _by_y(one), _by_y(other)
    square = _polynomial_minus(_product(a, f), _product(d, c))
    linear = _polynomial_minus(_product(a, e), _product(d, b))
    constant = _polynomial_minus(_product(b, f), _product(e, c))
    resultant = _polynomial_minus(_product(square, square), _product(linear, constant))
    if max(map(abs, resultant)) <= _NOTHING:
        raise BadInput(
            "these five poses have a whole curve of centre points; leave one of them out, "
            "and the four others are met by every bar of that curve"
        )
    for x in _real_roots(resultant):
        below = _value(linear, x)
        if below:
            yield x, -_value(square, x) / below


def _conics(rows: Sequence[_Row]) -> tuple[list[Decimal], list[Decimal]]:
    """Return two conics through the centre points: cubics of three equations each, freed of x³ and y³.

    If all four cubics have the same real direction to infinity, one centre point lies there, for example if
    the five origins lie in line. Then one cubic frees the three others; their conics meet in the three other
    centre points, and two of them in one more point, which has no circle point.
    """
    cubics = [_cubic([row for row in rows if row is not left_out]) for left_out in rows]
    pairs = list(combinations(range(len(cubics)), 2))
    areas = [cubics[i][0] * cubics[k][3] - cubics[i][3] * cubics[k][0] for i, k in pairs]
    most = max(abs(part) for cubic in cubics for part in cubic)
    best = max(range(len(pairs)), key=lambda n: abs(areas[n]))
    if abs(areas[best]) > _NOTHING * most * most:
        (i, k), area = pairs[best], areas[best]
        p, q = cubics[i], cubics[k]
        free = [
            _freed(
                cubic,
                (p, (cubic[0] * q[3] - cubic[3] * q[0]) / area),
                (q, (cubic[3] * p[0] - cubic[0] * p[3]) / area),
            )
            for n, cubic in enumerate(cubics)
            if n not in (i, k)
        ]
        return free[0], free[1]
    p = max(cubics, key=lambda cubic: abs(cubic[0]) + abs(cubic[3]))
    square = p[0] ** 2 + p[3] ** 2
    if square <= (_NOTHING * most) ** 2:
        raise BadInput("four or more of these five poses are parallel; turn one of them, or leave one out")
    one, two, three = (
        _freed(cubic, (p, (cubic[0] * p[0] + cubic[3] * p[3]) / square)) for cubic in cubics if cubic is not p
    )
    mixed = [a + b * _COSINE.numerator / 7 for a, b in zip(one, three, strict=True)]
    return mixed, [a - b * _SINE.numerator / 9 for a, b in zip(two, three, strict=True)]


def _freed(cubic: list[Decimal], *shares: tuple[list[Decimal], Decimal]) -> list[Decimal]:
    """Return the conic that remains of a cubic when multiples of others are subtracted, at size 1."""
    conic = cubic[4:]
    for other, share in shares:
        conic = [part - share * less for part, less in zip(conic, other[4:], strict=True)]
    most = max(map(abs, conic))
    return [part / most for part in conic] if most else conic


_Polynomial = list[Decimal]
"""Coefficients, the constant one first."""


def _by_y(conic: list[Decimal]) -> tuple[_Polynomial, _Polynomial, _Polynomial]:
    """Return a conic as polynomials in x: the coefficients of y², y and 1."""
    xx, xy, yy, x, y, one = conic
    return [yy], [y, xy], [one, x, xx]


def _product(one: _Polynomial, other: _Polynomial) -> _Polynomial:
    product = [Decimal(0)] * (len(one) + len(other) - 1)
    for i, a in enumerate(one):
        for k, b in enumerate(other):
            product[i + k] += a * b
    return product


def _polynomial_minus(one: _Polynomial, other: _Polynomial) -> _Polynomial:
    return [a - b for a, b in zip_longest(one, other, fillvalue=Decimal(0))]


def _value(polynomial: _Polynomial, x: Decimal) -> Decimal:
    value = Decimal(0)
    for coefficient in reversed(polynomial):
        value = value * x + coefficient
    return value


def _real_roots(polynomial: _Polynomial) -> list[Decimal]:
    """Return the real roots, the least first, a double one once: between the roots of the derivative."""
    most = max(map(abs, polynomial))
    parts = [coefficient / most for coefficient in polynomial]
    while abs(parts[-1]) <= _NOTHING:
        parts.pop()
    if len(parts) < 2:
        return []
    slope = [n * coefficient for n, coefficient in enumerate(parts)][1:]
    far = 1 + max(map(abs, parts)) / abs(parts[-1])
    ends = [-far, *_real_roots(slope), far]
    values = [_value(parts, end) for end in ends]
    zero = [abs(value) <= _NOTHING * _size_at(parts, end) for value, end in zip(values, ends, strict=True)]
    roots = []
    for n in range(len(ends) - 1):
        if zero[n]:
            roots.append(ends[n])
        elif not zero[n + 1] and values[n] * values[n + 1] < 0:
            roots.append(_between(parts, slope, (ends[n], ends[n + 1]), values[n] > 0))
    return roots


def _size_at(polynomial: _Polynomial, x: Decimal) -> Decimal:
    return _value([abs(coefficient) for coefficient in polynomial], abs(x))


def _between(parts: _Polynomial, slope: _Polynomial, ends: tuple[Decimal, Decimal], falling: bool) -> Decimal:
    """Return the root between two ends by Newton's steps, halving where those would leave them."""
    low, high = ends
    x = (low + high) / 2
    for _ in range(_ROOT_STEPS):
        value = _value(parts, x)
        low, high = (x, high) if (value > 0) == falling else (low, x)
        rate = _value(slope, x)
        step = x - value / rate if rate else low
        after = step if low < step < high else (low + high) / 2
        if abs(after - x) <= _NOTHING * (1 + abs(x)):
            return after
        x = after
    return x


def _with_circle(rows: Sequence[_Row], centre: _Point) -> Iterator[tuple[_Point, _Point]]:
    """Yield the circle point of a centre point, and the latter; nothing if there is none, or at infinity."""
    x, y = centre
    lines = [tuple(a * x + b * y + c for a, b, c in row) for row in rows]
    crossings = [_cross(one, other) for one, other in combinations(lines, 2)]
    crossing = max(crossings, key=lambda place: max(map(abs, place)))
    one, p, q = crossing
    size = max(map(abs, crossing))
    off = (sum(a * b for a, b in zip(line, crossing, strict=True)) for line in lines)
    met = all(abs(part) <= _MET * size * max(map(abs, line)) for part, line in zip(off, lines, strict=True))
    if met and abs(one) > _NOTHING * size:
        yield (p / one, q / one), centre


def _cross(one: Any, other: Any) -> tuple[Any, Any, Any]:
    """Return the vector product of triples of numbers of any kind."""
    (a, b, c), (d, e, f) = one, other
    return b * f - c * e, c * d - a * f, a * e - b * d


# Points that run along a line: their centre lies at infinity.


def ball_point(poses: Poses) -> Slides:
    """Return the one point, if any, of four or five poses that runs along a line, and the line's direction.

    If all poses are parallel, either every point runs along a line, and the origin is returned, or none does.
    """
    if not poses.poles:
        along = poses.shifts[int(np.abs(poses.shifts).argmax())]
        direction = along / abs(along)
        slide = Slides(poses.origins[:1], np.array([direction]))
        return slide if _strays(poses, slide) <= STRAIGHT else Slides(slide.point[:0], slide.direction[:0])
    candidates = [point for point in _ball_points(poses) if np.isfinite(point)]
    tries = [straightened(poses, point) for point in candidates]
    best = min(tries, key=lambda slide: _strays(poses, slide), default=None)
    if best is None or not _strays(poses, best) <= STRAIGHT:
        return Slides(np.empty(0, np.complex128), np.empty(0, np.complex128))
    return best


def slides_through(poses: Poses, points: Complex) -> Slides:
    """Return points (k,), each with the direction from its first place to its farthest one."""
    steps = poses.places(points) - np.asarray(points)[:, None]
    longest = steps[np.arange(len(steps)), np.abs(steps).argmax(axis=1)]
    with np.errstate(all="ignore"):
        return Slides(np.asarray(points), longest / np.abs(longest))


def slide_points(poses: Poses, angles: Real) -> Complex:
    """Return points of three poses that run along a line, at angles round the circle on which they all lie.

    If that circle is a straight line, the angles from 0 to 2π cover it; NaN where there is no point.
    """
    square, linear, constant = _in_line(poses, 1, 2)
    with np.errstate(all="ignore"):
        if abs(square) > SAME:
            middle = -0.5j * linear.conjugate() / square
            radius = math.sqrt(max(abs(middle) ** 2 - constant / square, 0.0))
            return np.asarray(poses.origins[0] + middle + radius * np.exp(1j * angles))
        foot = -1j * constant * np.conj(linear) / np.abs(linear) ** 2
        along = np.conj(linear) / np.abs(linear)
        return np.asarray(poses.origins[0] + foot + along * poses.size * np.tan((angles - math.pi) / 2))


def _in_line(poses: Poses, one: int, other: int) -> tuple[float, complex, float]:
    """Return q, B and C: q|w|² + Im(B w) + C is zero where w, from the first origin, stays on a line."""
    shift, turn = poses.shifts, poses.turns - 1
    square = (turn[one].conjugate() * turn[other]).imag
    linear = shift[one].conjugate() * turn[other] - shift[other].conjugate() * turn[one]
    return float(square), complex(linear), float((shift[one].conjugate() * shift[other]).imag)


def _ball_points(poses: Poses) -> Iterator[complex]:
    """Yield Ball's point of the first four poses as each pole gives it.

    The points that run along a line for three poses lie on a circle; two such circles meet in a pole and in
    Ball's point.
    """
    for one, other in combinations(range(4), 2):
        order = [one, other, *(pose for pose in range(4) if pose not in (one, other))]
        four = Poses(poses.origins[order], poses.angles[order])
        pole = four.pole(0, 1)
        if pole is None:
            continue
        circles = sorted((_in_line(four, 1, pose) for pose in (2, 3)), key=lambda circle: -abs(circle[0]))
        (square, linear, _), (square2, linear2, _) = circles
        line = square2 * linear - square * linear2
        if abs(square) <= SAME or not line:
            continue
        direction = line.conjugate() / abs(line)
        start = pole - complex(four.origins[0])
        far = -2 * (start.conjugate() * direction).real - (linear * direction).imag / square
        within = (start + far * direction) / complex(poses.turns[one])
        yield complex(poses.origins[0]) + within


def straightened(poses: Poses, point: complex) -> Slides:
    """Return a point moved to where its places lie best in line, with the direction of this line."""
    direction = complex(slides_through(poses, np.array([point])).direction[0])
    for _ in range(3):
        steps = (poses.places(point) - point)[1:] / direction
        by_point = (poses.turns[1:] - 1) / direction
        slopes = np.stack([by_point.imag, by_point.real, -steps.real / poses.size], axis=1)
        step = np.linalg.lstsq(slopes, -steps.imag, rcond=1e-14)[0]
        point += complex(step[0], step[1])
        direction *= cmath.exp(1j * step[2] / poses.size)
    return Slides(np.array([point]), np.array([direction]))


def _strays(poses: Poses, slide: Slides) -> float:
    """Return how far a point strays from its line, in the poses' size."""
    steps = (poses.places(slide.point) - slide.point[:, None]) / slide.direction[:, None]
    return float(np.abs(steps.imag).max() / poses.size)
