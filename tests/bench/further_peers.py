"""Further work beside other people's packages and the usual ways, where these are installed.

`python tests/bench/further_peers.py` prints a table; a minute.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.bench import further
from linkanim.bench.methods import FEW as MANY
from linkanim.bench.methods import Timed
from linkanim.bench.questions import EASY, TURN
from linkanim.bench.result import nanoseconds, this_machine
from linkanim.export import markdown

FEW = 180
"""The poses, or linkages, that are timed one by one."""
Floats = NDArray[np.float64]


def peers() -> Iterator[tuple[str, str, Timed]]:
    """Yield the name of further work, the peer's name, and the peer's work."""
    if find_spec("pylinkage") and find_spec("numba"):
        linkage = four_bar(*EASY[1:], 0.0)
        work = linkage.step_fast_with_kinematics
        yield "cycle", "pylinkage step_fast", Timed(lambda: work(further.CYCLE), further.CYCLE)
    if find_spec("pylinkage"):
        rows = further.different(FEW).tolist()
        yield (
            "many linkages",
            "pylinkage, each made and stepped",
            Timed(lambda: [pose(*row) for row in rows], FEW),
        )
    if find_spec("scipy"):
        yield "triad", "scipy fsolve, positions alone", Timed(triad, FEW)
    yield "forces", "numpy, six equations at once", Timed(forces_of(MANY), MANY)


def four_bar(crank: float, coupler: float, rocker: float, angle: float) -> Any:
    """Return a four-bar of pylinkage near an angle of its crank, which turns by a whole turn in a cycle."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import RRRDyad
    from pylinkage.simulation import Linkage

    pin, other = Ground(0.0, 0.0), Ground(EASY[0], 0.0)
    turning = Crank(pin, crank, TURN / further.CYCLE, angle)
    bars = RRRDyad(turning.output, other, coupler, rocker, EASY[0], rocker)
    return Linkage([pin, other, turning, bars])


def pose(crank: float, coupler: float, rocker: float, angle: float) -> Any:
    """Return the first pose of a four-bar that is made for it."""
    return next(four_bar(crank, coupler, rocker, angle).step(1))


def triad() -> list[Floats]:
    """Return the triad's free points at equal steps, each found from those before."""
    from scipy.optimize import fsolve

    points = {name: np.array(place) for name, place in further.TRIAD["points"].items()}
    lengths = [math.dist(points[p], points[q]) for p, q in further.BARS]
    arm, found = points["A"] - points["O"], []
    guess = np.concatenate([points[name] for name in further.FREE])

    def off(free: Floats, pin: Floats) -> list[float]:
        at = {**points, "A": pin, **dict(zip(further.FREE, free.reshape(-1, 2), strict=True))}
        return [
            math.dist(at[p], at[q]) - length for (p, q), length in zip(further.BARS, lengths, strict=True)
        ]

    for angle in np.arange(FEW) * (TURN / FEW):
        cosine, sine = math.cos(angle), math.sin(angle)
        pin = points["O"] + np.array([cosine * arm[0] - sine * arm[1], sine * arm[0] + cosine * arm[1]])
        guess = fsolve(off, guess, args=(pin,))
        found.append(guess)
    return found


def forces_of(count: int) -> Callable[[], Floats]:
    """Return the usual way to forces: six equations for each pose, all poses in one call of numpy.

    It is given accelerations; those of linkanim, which are not timed.
    """
    motion = further.laden_scene().solve(phase=np.arange(count) * (TURN / count), speed=1.0)
    places, coms, rates = motion.position, motion.com_acceleration, motion.angular_acceleration
    bodies = (("coupler", "A", "B", 0, 2, -1), ("rocker", "O4", "B", 4, 2, 1))

    def solve() -> Floats:
        matrix, right = np.zeros((count, 6, 6)), np.zeros((count, 6, 1))
        for n, (body, first, second, own, shared, sign) in enumerate(bodies):
            mass, inertia = further.MASSES[body]
            here, row = (places[first] + places[second]) / 2, 3 * n
            for column, factor, end in ((own, 1, first), (shared, sign, second)):
                arm = places[end] - here
                matrix[:, row, column] = matrix[:, row + 1, column + 1] = factor
                matrix[:, row + 2, column] = -factor * arm[:, 1]
                matrix[:, row + 2, column + 1] = factor * arm[:, 0]
            right[:, row : row + 2, 0] = mass * coms[body]
            right[:, row + 2, 0] = inertia * rates[body]
        found: Floats = np.asarray(np.linalg.solve(matrix, right), np.float64)
        return found

    return solve


def main() -> None:
    """Measure, and print the table."""
    rows = {work.name: work for work in further.further()}
    beside = {name: (words, timed) for name, words, timed in peers()}
    work = {(name, "ours"): row.timed for name, row in rows.items()}
    work |= {(name, "peer"): timed for name, (_, timed) in beside.items()}
    times = nanoseconds(work, rounds=7)
    titles = ("beyond one linkage's poses", "ns each", "worst error", "beside it", "ns each", "times")
    lines = []
    for name, row in rows.items():
        ours, peer = times[name, "ours"], times.get((name, "peer"), math.nan)
        words = beside[name][0] if name in beside else "not installed"
        worst = f"{row.errors(row.tried).max():.1e}"
        lines.append((row.words, f"{ours:,.0f}", worst, words, f"{peer:,.0f}", f"{peer / ours:.1f}"))
    print(markdown([titles, *lines]))
    print(this_machine().line)


if __name__ == "__main__":
    main()
