"""Work beyond the poses of one linkage: a cycle, many linkages, links solved together, forces in joints.

Each piece is timed, and told how far it is off against many digits: by circles, by Newton's method on the
bars' equations, by Newton's and Euler's equations solved at once. No code is shared with the solver.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
from mpmath import mp, mpc, mpf, workdps

from linkanim.bench.methods import FEW, Timed, batch
from linkanim.bench.questions import EASY, FOUR_BAR, TURN, Floats
from linkanim.bench.reference import DIGITS, STEP, CasePath, answer, crossing
from linkanim.frozen import frozen
from linkanim.scenes.many import solve_many
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

CYCLE = 360
TRIED = 90
"""The instants, or linkages, at which errors are looked for."""


@frozen
class FurtherMeasured:
    """A piece of further work: its time in ns for each pose or linkage, its worst error, and where that is.

    `at` are hexadecimal floats.
    """

    name: str
    words: str
    ns: float
    error: float
    at: tuple[str, ...]


@frozen
class FurtherWork:
    """A row: what is worked out, how it is timed, and the errors at instants.

    `errors` is given rows of numbers, each what `inputs` name; errors are in longest links, or of forces in
    the largest of the instant.
    """

    name: str
    words: str
    inputs: tuple[str, ...]
    timed: Timed
    tried: Floats
    errors: Callable[[Floats], Floats]

    def measured(self, ns: float) -> FurtherMeasured:
        """Return it with its time and its worst error."""
        errors = self.errors(self.tried)
        worst = int(np.nan_to_num(errors, nan=np.inf).argmax())
        at = tuple(number.hex() for number in self.tried[worst].tolist())
        return FurtherMeasured(self.name, self.words, ns, float(errors[worst]), at)


def further() -> tuple[FurtherWork, ...]:
    """Return the rows in the order of the table."""
    turn, cycle, many = (np.arange(count, dtype=np.float64) * (TURN / count) for count in (TRIED, CYCLE, FEW))
    four_bar, triad, laden = FOUR_BAR.easy.scene, triad_scene(), laden_scene()
    lengths = different(FEW)
    named = dict(zip(("crank", "coupler", "rocker"), lengths.T[:3], strict=True))
    phases, bars = turn[:, None], ("crank", "coupler", "rocker", "phase")
    return (
        FurtherWork(
            "cycle",
            "a four-bar's cycle of 360 poses, with derivatives",
            ("phase",),
            Timed(lambda: four_bar.solve(phase=cycle).acceleration["P"], CYCLE),
            phases,
            cycle_errors,
        ),
        FurtherWork(
            "many linkages",
            f"{FEW:,} four-bars of different lengths, a pose of each",
            bars,
            Timed(lambda: solve_many(four_bar, named, lengths[:, 3]).position["P"], FEW),
            different(TRIED),
            many_errors,
        ),
        FurtherWork(
            "triad",
            f"{FEW:,} poses of a triad, with derivatives",
            ("phase",),
            Timed(lambda: triad.solve(phase=many).acceleration["E"], FEW),
            phases,
            triad_errors,
        ),
        FurtherWork(
            "forces",
            f"forces in all joints of a four-bar, {FEW:,} poses",
            ("phase",),
            Timed(lambda: laden.solve(phase=many).reaction["B"], FEW),
            phases,
            force_errors,
        ),
    )


def cycle_errors(inputs: Floats) -> Floats:
    """Return how far positions, in longest links, are off."""
    exact = answer(replace(FOUR_BAR.easy, inputs=inputs[:, 0]))
    return exact.errors(batch(exact.question))[0]


def different(count: int) -> Floats:
    """Return crank, coupler, rocker and phase of four-bars on the easy one's ground, whose cranks turn."""
    random = np.random.default_rng(1)
    near = np.array(EASY[1:]) * random.uniform(0.95, 1.05, (count, 3))
    return np.column_stack([near, random.uniform(0.0, TURN, count)])


def many_errors(inputs: Floats) -> Floats:
    """Return how far the rockers' pins are off, in longest links."""
    named = dict(zip(("crank", "coupler", "rocker"), inputs.T[:3], strict=True))
    position = solve_many(FOUR_BAR.easy.scene, named, inputs[:, 3]).position["B"]
    errors = []
    with workdps(DIGITS):
        for (crank, coupler, rocker, phase), at in zip(inputs.tolist(), position, strict=True):
            pin = mpf(crank) * mp.expj(mpf(phase))
            exact = crossing(pin, mpc(EASY[0]), mpf(coupler), mpf(rocker), 1)
            errors.append(float(abs(mpc(*at) - exact)) / max(*EASY[:1], crank, coupler, rocker))
    return np.array(errors)


TRIAD: Mapping[str, Any] = {
    "length_unit": "mm",
    "points": {
        "A": [86.71, 50.6],
        "B": [53.24, 4.65],
        "C": [2.75, 62.88],
        "D": [32.95, 14.2],
        "E": [20.14, 34.34],
        "F": [91.83, 20.34],
        "O": [97.65, 55.88],
    },
    "links": {
        "ground": ["O", "D", "F"],
        "crank": ["O", "A"],
        "AB": ["A", "B"],
        "plate": ["B", "C", "E"],
        "CD": ["C", "D"],
        "EF": ["E", "F"],
    },
    "drive": {"joint": "O", "speed": "1 rad/s"},
}
"""A plate on three bars, one of which a crank drives: no two of its links can be solved without the third."""
BARS = (("A", "B"), ("B", "C"), ("B", "E"), ("C", "E"), ("C", "D"), ("E", "F"))
FREE = ("B", "C", "E")


@cache
def triad_scene() -> Scene:
    """Return the triad."""
    return scene_from(TRIAD, name="triad", where="bench")


def triad_errors(inputs: Floats) -> Floats:
    """Return how far the triad's joints are off, in longest links."""
    position = triad_scene().solve(phase=inputs[:, 0], derivatives=0).position
    errors = []
    with workdps(50):
        points = {name: mpc(*place) for name, place in TRIAD["points"].items()}
        lengths = [abs(points[p] - points[q]) for p, q in BARS]
        for n, phase in enumerate(inputs[:, 0].tolist()):
            near = {name: mpc(*position[name][n]) for name in FREE}
            turned = points["O"] + (points["A"] - points["O"]) * mp.expj(mpf(phase))
            exact = _closed({**points, "A": turned, **near}, lengths)
            errors.append(max(float(abs(exact[name] - near[name])) for name in FREE) / float(max(lengths)))
    return np.array(errors)


def _closed(places: Mapping[str, Any], lengths: Sequence[Any]) -> Mapping[str, Any]:
    """Return the free points, by Newton's method from places near them, such that bars have their lengths."""
    at = dict(places)
    for _ in range(5):
        matrix, off = mp.zeros(len(BARS)), mp.zeros(len(BARS), 1)
        for row, (p, q) in enumerate(BARS):
            way = at[p] - at[q]
            off[row] = abs(way) ** 2 - lengths[row] ** 2
            for name, sign in ((p, 2), (q, -2)):
                if name in FREE:
                    column = 2 * FREE.index(name)
                    matrix[row, column], matrix[row, column + 1] = sign * way.real, sign * way.imag
        step = mp.lu_solve(matrix, -off)
        for n, name in enumerate(FREE):
            at[name] += mpc(step[2 * n], step[2 * n + 1])
    return at


MASSES = {"coupler": (0.9, 0.8), "rocker": (0.7, 0.5)}
"""Masses (kg) and moments of inertia about the centres of mass (kg m²), which lie midway."""


@cache
def laden_scene() -> Scene:
    """Return the easy four-bar, in metres, with the masses of its coupler and its rocker."""
    _, crank, coupler, rocker = EASY
    bodies = {
        name: {"joints": joints, "com": [length / 2, 0], "mass": f"{mass} kg", "inertia": f"{inertia} kg m^2"}
        for (name, (mass, inertia)), joints, length in zip(
            MASSES.items(), (["A", "B"], ["O4", "B"]), (coupler, rocker), strict=True
        )
    }
    joints = {
        "A": {"crank": "O2", "length": crank},
        "B": {"from": ["A", "O4"], "length": [coupler, rocker], "side": "left"},
    }
    ground = {"O2": [0, 0], "O4": [EASY[0], 0]}
    drive = {"speed": "1 rad/s", "start": "0 deg"}
    document = {"length_unit": "m", "ground": ground, "joints": joints, "bodies": bodies, "drive": drive}
    return scene_from(document, name="laden four-bar", where="bench")


def force_errors(inputs: Floats) -> Floats:
    """Return how far forces in joints are off, in the largest force of the instant."""
    reaction = laden_scene().solve(phase=inputs[:, 0], speed=1.0).reaction
    forces = [reaction[joint][body] for joint, body in (("A", "coupler"), ("B", "rocker"), ("O4", "rocker"))]
    errors = []
    with workdps(DIGITS):
        path = CasePath(replace(FOUR_BAR.easy, scene=laden_scene()))
        for n, phase in enumerate(inputs[:, 0].tolist()):
            exact = _forces([path.pose(mpf(phase) + k * STEP) for k in (-1, 0, 1)])
            largest = max(abs(force) for force in exact)
            apart = [abs(mpc(*force[n]) - true) for force, true in zip(forces, exact, strict=True)]
            errors.append(float(max(apart) / largest))
    return np.array(errors)


def _forces(poses: Sequence[Mapping[str, Any]]) -> list[Any]:
    """Return the forces on the coupler in A, on the rocker in B and in O4, by six equations at once.

    `poses` are those a small step of the crank before, at and after an instant, at 1 rad/s.
    """
    matrix, right = mp.zeros(6), mp.zeros(6, 1)
    # for each body: its ends, and the columns of the forces in them, the second with its sign
    bodies = (("coupler", "A", "B", 0, 2, -1), ("rocker", "O4", "B", 4, 2, 1))
    for n, (body, first, second, own, shared, sign) in enumerate(bodies):
        (mass, inertia), now = MASSES[body], poses[1]
        before, here, after = ((pose[first] + pose[second]) / 2 for pose in poses)
        inertial = mpf(mass) * (after - 2 * here + before) / STEP**2
        bars = [pose[second] - pose[first] for pose in poses]
        rate, bend = (bars[2] - bars[0]) / (2 * STEP), (bars[2] - 2 * bars[1] + bars[0]) / STEP**2
        turning = (bend / bars[1] - (rate / bars[1]) ** 2).imag
        row = 3 * n
        for column, factor, arm in ((own, 1, now[first] - here), (shared, sign, now[second] - here)):
            matrix[row, column] = matrix[row + 1, column + 1] = factor
            matrix[row + 2, column], matrix[row + 2, column + 1] = -factor * arm.imag, factor * arm.real
        right[row], right[row + 1], right[row + 2] = inertial.real, inertial.imag, mpf(inertia) * turning
    force = mp.lu_solve(matrix, right)
    return [mpc(force[n], force[n + 1]) for n in (0, 2, 4)]
