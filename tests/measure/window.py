"""What a frame of the window costs under SDL's dummy driver, the first after start, and how true it is."""

from __future__ import annotations

import gc
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from statistics import median
from tempfile import TemporaryDirectory

from fidelity import frame_decibels, jitter

from linkanim.bench.result import Machine, this_machine
from linkanim.cli import SPARED
from linkanim.errors import WorkFailed
from linkanim.export import columns
from linkanim.picture.look import Look
from linkanim.player.actions import advance
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.ui import screen as display
from linkanim.ui.screen import Screen

SCENE = "press"
LOOK = Look(vectors=frozenset("va"), chart="C.acceleration", names=2)
SIZES = ((1280, 720), (1920, 1080))
BOUNDS_MS = {(1280, 720): 6.0, (1920, 1080): 10.0}
FIRST_BOUND = 0.4
DECIBELS_BOUND = 44.0
JITTER_BOUND = 0.1
TITLES = (
    "press with names, vectors and chart",
    "draw + flip",
    "bound",
    "95 % below",
    "processor",
    "of a core at 60 fps",
)
FRAMES = 300
STARTS = 5

TELL_FIRST = """
import os, time
import pygame.display as display
flip = display.flip
def first():
    flip()
    print(time.time(), flush=True)
    os._exit(0)
display.flip = first
from linkanim.cli import main
main(["play", "press"])
"""


@dataclass(frozen=True)
class FrameTimes:
    """Draw and flip at one size, ms: median, the 95th of a hundred, and the processor's time for it.

    On a machine that does nothing else the first and the last are the same.
    """

    size: tuple[int, int]
    milliseconds: float
    slowest: float
    processor: float

    @property
    def core(self) -> float:
        """The share of a core that 60 frames a second take."""
        return self.processor / 1e3 * FRAMES_PER_SECOND


@dataclass(frozen=True)
class WindowRun:
    """What a run found.

    `first` is the time from the start of the process to its first frame, s; `decibels` the worst frame's
    PSNR against 64 samples a pixel; `jitter` how far a slow bar's centre strays, px rms.
    """

    machine: Machine
    frames: tuple[FrameTimes, ...]
    first: float
    decibels: float
    jitter: float


def run() -> WindowRun:
    """Measure the press with trace, names and dimensions, vectors, chart and HUD at both sizes."""
    with dummy():
        frames = tuple(measured(size) for size in SIZES)
        true = frame_decibels(load(SCENE)), jitter()
        return WindowRun(this_machine(), frames, first_frame(), *true)


def measured(size: tuple[int, int], *, frames: int = FRAMES) -> FrameTimes:
    """Play the press in a window of that size and time each frame's draw and flip."""
    state = begin(load(SCENE), look=LOOK)
    walls, used = [], []
    with display.opened(size):
        screen = Screen(state)
        screen.show(state)
        for _ in range(frames):
            state = advance(state)
            start, before = time.perf_counter(), time.process_time()
            screen.show(state)
            walls.append(1e3 * (time.perf_counter() - start))
            used.append(1e3 * (time.process_time() - before))
    walls.sort()
    return FrameTimes(size, median(walls), walls[int(0.95 * (frames - 1))], median(used))


def first_frame(*, starts: int = STARTS) -> float:
    """Return the median time from starting `linkanim play press` to its first flip, in s.

    Modules are compiled beforehand, as they are in every installed package; the start that does it does
    not count.
    """
    with TemporaryDirectory() as compiled:
        _started(compiled)
        return median(_started(compiled) for _ in range(starts))


def _started(compiled: str) -> float:
    env = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    start = time.time()
    done = subprocess.run(
        [sys.executable, "-c", TELL_FIRST],
        env={**env, "PYTHONPYCACHEPREFIX": compiled},
        check=False,
        capture_output=True,
        text=True,
    )
    if not done.stdout:
        raise WorkFailed(f"the window did not start: {done.stderr.strip() or 'it drew nothing'}")
    return float(done.stdout.split()[-1]) - start


def spare() -> None:
    """Look for rubbish as seldom as the program does, and not among what is there by now."""
    gc.set_threshold(SPARED)
    gc.collect()
    gc.freeze()


@contextmanager
def dummy() -> Iterator[None]:
    """Draw into no window meanwhile."""
    before = os.environ.get("SDL_VIDEODRIVER")
    os.environ["SDL_VIDEODRIVER"] = "dummy"
    try:
        yield
    finally:
        if before is None:
            del os.environ["SDL_VIDEODRIVER"]
        else:
            os.environ["SDL_VIDEODRIVER"] = before


def as_text(drawing: WindowRun) -> str:
    """Return the figures in aligned columns, each beside its bound."""
    rows = [TITLES]
    for found in drawing.frames:
        width, height = found.size
        bound = f"≤ {BOUNDS_MS[found.size]:g} ms"
        more = (f"{found.slowest:.1f} ms", f"{found.processor:.1f} ms", f"{100 * found.core:.0f} %")
        rows.append((f"{width}x{height}", f"{found.milliseconds:.1f} ms", bound, *more))
    for name, figure, bound in (
        ("first frame after start", f"{drawing.first:.2f} s", f"≤ {FIRST_BOUND:g} s"),
        ("worst frame against 64 samples", f"{drawing.decibels:.1f} dB", f"≥ {DECIBELS_BOUND:g} dB"),
        ("a slow bar's centre, rms", f"{drawing.jitter:.4f} px", f"≤ {JITTER_BOUND:g} px"),
    ):
        rows.append((name, figure, bound, "", "", ""))
    return f"{drawing.machine.line}\n\n{columns(rows)}"


if __name__ == "__main__":
    print(as_text(run()))
