"""Poses of known linkages, and what a linkage does at poses, each told without our synthesis."""

from __future__ import annotations

import math
from collections.abc import Iterator
from inspect import signature
from typing import NamedTuple

import mpmath
import numpy as np

from linkanim.mechanics.measures import as_complex
from linkanim.scenes.scene import Scene
from linkanim.synthesis.linkages import Complex, Real


class KnownPoses(NamedTuple):
    """Poses (n, 3) of x, y and angle, the fixed pivots, and the joints on the coupler in the first pose."""

    rows: Real
    pivots: Complex
    joints: Complex


def of_four_bars(seed: int, count: int, number: int) -> Iterator[KnownPoses]:
    """Yield poses of so many random four-bars, at random angles of the crank, on one closure."""
    random = np.random.default_rng(seed)
    while number:
        r1, r2, r3, r4 = random.uniform(0.3, 2.0, 4)
        crank = r2 * np.exp(1j * np.sort(random.uniform(0, math.tau, count)))
        way = r1 - crank
        square = np.abs(way) ** 2
        factors = ((r3 + r4) ** 2 - square) * (square - (r3 - r4) ** 2)
        # neither near a limit nor with two poses that are all but one
        if factors.min() < 0.1 or np.diff(np.angle(crank) % math.tau).min() < 0.15:
            continue
        root = random.choice([-1, 1]) * np.sqrt(factors)
        coupler = way * (square + (r3 - r4) * (r3 + r4) + 1j * root) / (2 * square * r3)
        shift, turn = complex(*random.normal(size=2)), np.exp(1j * random.uniform(0, math.tau))
        origins = shift + turn * (crank + complex(*random.normal(size=2)) * coupler)
        angles = np.unwrap(np.angle(coupler)) + random.uniform(-1, 1)
        if np.ptp(angles) > 6:
            continue
        number -= 1
        joints = shift + turn * np.array([crank[0], crank[0] + r3 * coupler[0]])
        rows = np.column_stack([origins.real, origins.imag, angles])
        yield KnownPoses(rows, shift + turn * np.array([0, r1]), joints)


def of_slider_cranks(seed: int, count: int, number: int) -> Iterator[KnownPoses]:
    """Yield poses of so many random slider-cranks; the second pivot is the direction of the line."""
    random = np.random.default_rng(seed)
    while number:
        crank, rod, offset = random.uniform((0.3, 0.5, -0.5), (1.0, 2.5, 0.5))
        pin = crank * np.exp(1j * np.sort(random.uniform(0, math.tau, count)))
        rise = offset - pin.imag
        if np.abs(rise).max() > 0.95 * rod or np.diff(np.angle(pin) % math.tau).min() < 0.15:
            continue
        coupler = (np.sqrt(rod**2 - rise**2) + 1j * rise) / rod
        shift, turn = complex(*random.normal(size=2)), np.exp(1j * random.uniform(0, math.tau))
        origins = shift + turn * (pin + complex(*random.normal(size=2)) * coupler)
        rows = np.column_stack([origins.real, origins.imag, np.angle(coupler) + random.uniform(-1, 1)])
        number -= 1
        joints = shift + turn * np.array([pin[0], pin[0] + rod * coupler[0]])
        yield KnownPoses(rows, np.array([shift, turn]), joints)


def real_burmester_points(rows: Real) -> int:
    """Return how many real bars five poses have, from polynomials in the turn of a bar in fifty digits.

    A bar W and the arm Z from it to the origin ask W(e^(iβ) - 1) + Z(e^(iα) - 1) = δ for each pose; that two
    of them suffice for the third is a four-bar's closure Δ + Δ₂e^(iβ₂) + Δ₃e^(iβ₃) + Δ₄e^(iβ₄) = 0 (Sandor
    and Erdman, Advanced Mechanism Design). Two closures with their conjugates leave, freed of β₄ and β₅ and
    then of β₃, a polynomial in e^(iβ₂), of whose roots those on the unit circle are bars, but for those that
    every set of poses has.
    """
    with mpmath.workdps(50):
        turns = [
            mpmath.expjpi((mpmath.mpf(angle) - mpmath.mpf(rows[0, 2])) / mpmath.pi) for angle in rows[1:, 2]
        ]
        shifts = [mpmath.mpc(*row[:2]) - mpmath.mpc(*rows[0, :2]) for row in rows[1:]]
        first, second = (_closure(turns, shifts, third) for third in (2, 3))
        p, q = _quadratic(first), _quadratic(second)
        square = _minus(_times(p[2], q[0]), _times(p[0], q[2]))
        one = _minus(_times(p[2], q[1]), _times(p[1], q[2]))
        other = _minus(_times(p[1], q[0]), _times(p[0], q[1]))
        resultant = _minus(_times(square, square), _times(one, other))
        while abs(resultant[-1]) < mpmath.mpf("1e-35"):
            resultant.pop()
        # the order of the coefficients is stated from some version on
        order = {"asc": False} if "asc" in signature(mpmath.polyroots).parameters else {}
        roots = mpmath.polyroots(resultant, maxsteps=500, extraprec=400, **order)
        trivial = [mpmath.mpc(1), turns[0]]
        roots = [root for root in roots if min(abs(root - one) for one in trivial) > mpmath.mpf("1e-15")]
        return sum(abs(abs(root) - 1) < mpmath.mpf("1e-20") for root in roots)


Polynomial = list[mpmath.mpc]
"""Coefficients of e^(iβ₂), the highest power first."""


def _closure(turns: Polynomial, shifts: Polynomial, third: int) -> Polynomial:
    """Return Δ, Δ₂, Δ₃ and Δ of the third pose: cofactors of the column of the bars' turns."""
    chosen = (0, 1, third)
    found = []
    for pose in chosen:
        one, other = (n for n in chosen if n != pose)
        area = (turns[one] - 1) * shifts[other] - (turns[other] - 1) * shifts[one]
        found.append(-area if pose == 1 else area)
    return [-sum(found), *found]


def _quadratic(closure: Polynomial) -> list[Polynomial]:
    """Return |Δ + Δ₂b₂ + Δ₃b₃|² - |Δ₄|², times b₂b₃: of b₃⁰, b₃ and b₃², polynomials in b₂."""
    none, two, three, four = closure
    c0, c2, c3 = map(mpmath.conj, (none, two, three))
    rest = abs(three) ** 2 - abs(four) ** 2
    middle = [two * c0, none * c0 + two * c2 + rest, none * c2]
    return [[c3 * two, c3 * none, mpmath.mpc(0)], middle, [three * c0, three * c2]]


def _times(one: Polynomial, other: Polynomial) -> Polynomial:
    found = [mpmath.mpc(0)] * (len(one) + len(other) - 1)
    for i, a in enumerate(one):
        for k, b in enumerate(other):
            found[i + k] += a * b
    return found


def _minus(one: Polynomial, other: Polynomial) -> Polynomial:
    size = max(len(one), len(other))
    one, other = ([mpmath.mpc(0)] * (size - len(part)) + part for part in (one, other))
    return [a - b for a, b in zip(one, other, strict=True)]


def runs_through(scene: Scene, rows: Real, turned: float, reach: float) -> bool:
    """Return whether a scene's coupler runs through poses in their order on one branch.

    Looked at along the whole period in small steps: where its traced point and its coupler, whose angle is
    by `turned` less than the pose's, are within `reach` of a pose; a limit ends a branch.
    """
    phases = np.linspace(0, scene.period, _STEPS, endpoint=False)
    motion = scene.solve(phase=phases, derivatives=0)
    point = as_complex(motion.position[scene.trace[0]])
    angle = np.asarray(motion.angle[scene.linkage.bodies[1].name]) + turned
    size = math.hypot(*np.ptp(rows[:, :2], axis=0))
    places = []
    for x, y, pose in rows:
        off = np.hypot(
            np.abs(point - complex(x, y)), size * np.abs((angle - pose + math.pi) % math.tau - math.pi)
        )
        low = (off <= np.roll(off, 1)) & (off <= np.roll(off, -1)) & (off < reach * size)
        places.append(phases[low])
    if scene.info.full_turn:
        ways = [
            [(place - start) % scene.period for place in places[n]]
            for start in places[0][:1]
            for n in range(len(rows))
        ]
        return _ordered(ways) or _ordered([[-way % scene.period for way in one] for one in ways])
    halves = [
        [places[n][(places[n] < math.pi) == first] for n in range(len(rows))] for first in (True, False)
    ]
    return any(_ordered(half) or _ordered([-one for one in half]) for half in halves)


_STEPS = 20_000


def _ordered(places: list[list[float]] | list[Real]) -> bool:
    """Return whether places can be taken one of each, each greater than the one before."""
    at = -math.inf
    for some in places:
        later = [place for place in some if place > at]
        if not later:
            return False
        at = min(later)
    return True
