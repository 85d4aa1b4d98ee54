"""What a pose costs as work grows: over the poses asked at once, over the dyads of a chain, and by kind."""

from __future__ import annotations

import time
import tracemalloc
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.atomic_files import checked_target, replacing
from linkanim.bench.methods import ONE_BY_ONE, Timed
from linkanim.bench.questions import FOUR_BAR, TURN
from linkanim.bench.result import Machine, nanoseconds, this_machine
from linkanim.export import columns
from linkanim.mechanics.linkage import RPP, RRP, RRR, Crank, Drive, Line, Linkage, Pin
from linkanim.mechanics.motion import Mechanism, mechanism

COUNTS = (100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000)
DYADS = (1, 2, 5, 10, 20, 50)
AT_ONCE = 10_000
"""Poses asked at once of chains and of the kinds."""
BUDGET = 60.0
"""Seconds for each of the three timings."""
READ = {0: "position", 2: "acceleration"}
NOTE = """\
ns a pose: processor time, medians of runs in turn; of the first run of its size (with derivatives) by the
clock, with the memory that it takes from the system. Extra memory: what a run takes at its peak beside the
motion that it gives."""
TABLES = {
    "poses": ("poses at once", "positions", "with derivatives", "first run", "extra memory"),
    "dyads": ("dyads in a chain", "positions", "with derivatives"),
    "kinds": ("mechanism", "positions", "with derivatives", "one pose", "one with derivatives", "× four-bar"),
}


class Sized(NamedTuple):
    """So many poses at once: ns a pose, those of the first run with derivatives, extra memory in bytes."""

    poses: int
    position_ns: float
    derivatives_ns: float
    first_ns: float
    extra_bytes: int


class Chained(NamedTuple):
    """A crank and so many dyads, one hung on the other: ns a pose."""

    dyads: int
    position_ns: float
    derivatives_ns: float


class KindTimes(NamedTuple):
    """A mechanism: ns a pose at once, and one a call; `times` is the largest ratio to the four-bar's."""

    name: str
    position_ns: float
    derivatives_ns: float
    pose_ns: float
    pose_derivatives_ns: float
    times: float


class Growth(NamedTuple):
    """What a run found."""

    machine: Machine
    poses: tuple[Sized, ...]
    dyads: tuple[Chained, ...]
    kinds: tuple[KindTimes, ...]


def run(progress: Callable[[int, int], None] | None = None, *, budget: float = BUDGET) -> Growth:
    """Measure all three; about three minutes, and 2 GB for the most poses."""
    return Growth(
        this_machine(),
        tuple(sizes(COUNTS, budget=budget, progress=progress)),
        tuple(chains(DYADS, budget=budget, progress=progress)),
        kinds(budget=budget, progress=progress),
    )


def sizes(counts: Sequence[int], **timing: Any) -> Iterator[Sized]:
    """Yield what a four-bar's pose costs at each number of poses at once."""
    solved = FOUR_BAR.easy.scene.mechanism
    for derivatives in READ:
        _at_once(solved, np.zeros(1), derivatives).work()
    work = {(n, d): _at_once(solved, _turn(n), d) for n in counts for d in READ}
    first = {n: _seconds(work[n, 2].work) / n * 1e9 for n in counts}
    extra = {n: extra_bytes(work[n, 2].work) for n in counts}
    times = nanoseconds(work, **timing)
    return (Sized(n, times[n, 0], times[n, 2], first[n], extra[n]) for n in counts)


def chains(lengths: Sequence[int], **timing: Any) -> Iterator[Chained]:
    """Yield what a pose of a chain costs at each number of dyads, 10,000 poses at once."""
    made = {n: mechanism(chain(n)) for n in lengths}
    times = nanoseconds(
        {(n, d): _at_once(made[n], _turn(AT_ONCE), d) for n in lengths for d in READ}, **timing
    )
    return (Chained(n, times[n, 0], times[n, 2]) for n in lengths)


def kinds(**timing: Any) -> tuple[KindTimes, ...]:
    """Return what a Scotch yoke and a slider on a moving line cost beside a four-bar with a coupler point."""
    made = {
        "four-bar": FOUR_BAR.easy.scene.mechanism,
        "Scotch yoke": mechanism(yoke()),
        "slider on a moving line": mechanism(moving_line()),
    }
    work = {
        (name, "at once", d): _at_once(one, _turn(AT_ONCE), d) for name, one in made.items() for d in READ
    }
    work |= {(name, "alone", d): _one_by_one(one, d) for name, one in made.items() for d in READ}
    times = nanoseconds(work, **timing)
    ways = [(how, d) for how in ("at once", "alone") for d in READ]
    most = {name: max(times[name, *way] / times["four-bar", *way] for way in ways) for name in made}
    return tuple(KindTimes._make([name, *(times[name, *way] for way in ways), most[name]]) for name in made)


def chain(dyads: int) -> Linkage:
    """Return a four-bar and further dyads that carry its rocker's swing on, as parallelograms do."""
    pins = [Pin("O2", (0.0, 0.0)), *(Pin(f"O{n}b", (100.0 * n, 0.0)) for n in range(1, dyads + 1))]
    first = RRR("B1", ("A", "O1b"), (90.0, 80.0))
    more = [RRR(f"B{n}", (f"B{n - 1}", f"O{n}b"), (100.0, 80.0)) for n in range(2, dyads + 1)]
    return Linkage((*pins, Crank("A", "O2", 30.0), first, *more), Drive("A", 1.0))


def yoke() -> Linkage:
    """Return a Scotch yoke: the crank's pin in the slot of a sliding bar."""
    return Linkage(
        (Pin("O2", (0.0, 0.0)), Crank("A", "O2", 30.0), RPP("Y", "A", Line("O2"), TURN / 4)), Drive("A", 1.0)
    )


def moving_line() -> Linkage:
    """Return a bar from a fixed pin to a slider whose line the crank carries."""
    pins = Pin("O2", (0.0, 0.0)), Pin("O4", (30.0, 0.0))
    slider = RRP("C", "O4", 100.0, Line("O2", on=("O2", "A")))
    return Linkage((*pins, Crank("A", "O2", 80.0), slider), Drive("A", 1.0))


def _turn(count: int) -> NDArray[np.float64]:
    return np.arange(count, dtype=np.float64) * (TURN / count)


def _at_once(solved: Mechanism, angles: NDArray[np.float64], derivatives: int) -> Timed:
    def work() -> object:
        motion = solved.solve(angle=angles, speed=1.0, derivatives=derivatives)
        getattr(motion, READ[derivatives])
        return motion

    return Timed(work, angles.size)


def _one_by_one(solved: Mechanism, derivatives: int) -> Timed:
    phases = _turn(ONE_BY_ONE).tolist()

    def work() -> None:
        for phase in phases:
            solved.pose(phase, 1.0, 0.0, derivatives)

    return Timed(work, ONE_BY_ONE)


def _seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def extra_bytes(work: Callable[[], object]) -> int:
    """Return the memory that work takes at its peak beside what it returns."""
    tracemalloc.start()
    try:
        found = work()
        held, peak = tracemalloc.get_traced_memory()
        del found
        return peak - held + tracemalloc.get_traced_memory()[0]
    finally:
        tracemalloc.stop()


def as_text(found: Growth) -> str:
    """Return the machine and the three tables in aligned columns."""
    rows = {
        "poses": [
            (f"{n:,}", *(f"{ns:.1f}" for ns in times), f"{extra / 1e6:.2f} MB")
            for n, *times, extra in found.poses
        ],
        "dyads": [(f"{n}", *(f"{ns:,.1f}" for ns in times)) for n, *times in found.dyads],
        "kinds": [
            (name, *(f"{ns:,.1f}" for ns in times), f"{most:.2f}") for name, *times, most in found.kinds
        ],
    }
    tables = [columns([TABLES[name], *lines]) for name, lines in rows.items()]
    return "\n\n".join([found.machine.line, *tables, NOTE])


def draw(found: Growth, path: Path) -> Path:
    """Write both courses as a PNG, one beside the other; return where it is."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    target = checked_target(path, (".png",))
    figure = Figure(figsize=(12.8, 5.4), dpi=100, layout="constrained")
    for panel, (title, across, rows) in zip(figure.subplots(1, 2), _courses(found), strict=True):
        for name, place, mark in (("positions", 1, "o-"), ("with derivatives", 2, "s-")):
            panel.loglog([row[0] for row in rows], [row[place] for row in rows], mark, label=name)
        panel.set(title=title, xlabel=across, ylabel="ns a pose")
        panel.grid(visible=True, color="#dddddd")
        panel.legend(frameon=False)
    with replacing(target) as part, part.open("wb") as file:
        canvas: Any = FigureCanvasAgg(figure)
        canvas.print_png(file)
    return target


def _courses(found: Growth) -> Iterator[tuple[str, str, Sequence[Any]]]:
    """Yield title, horizontal axis and rows of each picture."""
    yield "What a pose costs as more are asked at once", "poses at once", found.poses
    yield f"What a pose costs as a chain grows, {AT_ONCE:,} at once", "dyads in a chain", found.dyads


if __name__ == "__main__":
    growth = run()
    print(as_text(growth))
    print(draw(growth, Path("recordings/cost-as-work-grows.png")))
