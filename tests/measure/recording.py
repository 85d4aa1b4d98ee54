"""What a recording costs: the press measured beside matplotlib's animation of it, as a table."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from animation import animation_seconds
from cost import FPS, FRAMES, SIZE, Cost, cost

from linkanim.bench.result import Machine, this_machine
from linkanim.export import columns
from linkanim.recorder.plan import Format

SCENE = "press"
TITLES = (
    "press, 1280x720",
    "frames",
    "time",
    "to encoding",
    "processor + encoder's",
    "size",
    "quality",
    "memory + encoder's",
)
FORMATS: tuple[Format, ...] = ("gif", "mp4")


@dataclass(frozen=True)
class Recordings:
    """What a run found: a cost for each format, and the seconds of matplotlib's GIF where it is installed."""

    machine: Machine
    costs: tuple[Cost, ...]
    animated: float | None = None

    @property
    def times_faster(self) -> float | None:
        """How many times as long matplotlib takes for its GIF."""
        return None if self.animated is None else self.animated / self.costs[0].seconds


def run(
    measure: Callable[..., Cost] = cost,
    *,
    frames: int = FRAMES,
    animate: Callable[..., float | None] = animation_seconds,
) -> Recordings:
    """Record the press as GIF and as MP4 and measure both, then have matplotlib record it, too."""
    costs = tuple(measure(SCENE, form, frames=frames) for form in FORMATS)
    return Recordings(this_machine(), costs, animate(SCENE, size=SIZE, frames=frames, fps=FPS))


def as_text(found: Recordings) -> str:
    """Return the figures in aligned columns."""
    return f"{found.machine.line}\n\n{columns([TITLES, *map(_line, found.costs)])}\n\n{_beside(found)}"


def _beside(found: Recordings) -> str:
    if found.animated is None:
        return "matplotlib is not installed; with it its animation is timed, too"
    return (
        f"matplotlib's FuncAnimation with PillowWriter: {found.animated:.1f} s, "
        f"{found.times_faster:.1f} times as long as our GIF"
    )


def _line(cost: Cost) -> tuple[str, ...]:
    memory = f"{cost.memory.drawing:.0f} + {cost.memory.encoding:.0f} MB"
    quality = "exact" if math.isinf(cost.decibels) else f"{cost.decibels:.1f} dB"
    work = f"{cost.work.drawing:.1f} + {cost.work.encoding:.1f} s"
    times = (f"{cost.seconds:.1f} s", f"{cost.ratio:.2f} ×", work)
    return (cost.form.upper(), str(cost.frames), *times, f"{cost.megabytes:.2f} MB", quality, memory)


if __name__ == "__main__":
    print(as_text(run()))
