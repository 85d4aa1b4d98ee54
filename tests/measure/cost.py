"""What a recording costs and what it loses: time, also of encoding alone, size, decibels, memory."""

from __future__ import annotations

import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import WorkFailed
from linkanim.picture.look import Look
from linkanim.recorder.encode import Stream, ffmpeg
from linkanim.recorder.plan import Clip, Format, Plan, make_plan
from linkanim.recorder.recording import SceneFrames, palette_of, write
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

LOOK = Look(vectors=frozenset("v"))
SIZE = (1280, 720)
FRAMES = 300
FPS = 25.0


class Memory(NamedTuple):
    """The largest memory of the recording process and of its encoder, MB; NaN where it is not told."""

    drawing: float
    encoding: float


class Work(NamedTuple):
    """Processor time of the recording process and of its encoder, s; NaN where it is not told."""

    drawing: float
    encoding: float


@dataclass(frozen=True)
class Cost:
    """One recording measured: seconds in all, and for encoding the same frames alone."""

    form: Format
    frames: int
    seconds: float
    encode_seconds: float
    megabytes: float
    decibels: float
    memory: Memory
    work: Work

    @property
    def ratio(self) -> float:
        """Time in all by time for encoding alone."""
        return self.seconds / self.encode_seconds


def cost(name: str, form: Format, *, frames: int = FRAMES) -> Cost:
    """Record a scene as GIF or MP4 at 1280x720, with its trace and velocities, and measure it.

    The frames are drawn into a temporary file first (3.7 MB each), so that encoding alone can be
    timed and what the file shows be compared with what was drawn. Decibels are 10 log10 of 255² by
    the mean squared error over all frames. Memory is that of a process of its own.
    """
    scene = load(name)
    plan = _plan(scene, form, frames)
    memory = peak_memory(name, form, frames=frames)
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, f"out.{form}")
        stored = _stored(Path(folder, "frames"), scene, plan)
        encode_seconds, _ = _timed(lambda: _encode(stored, scene, plan, target))
        seconds, work = _timed(lambda: write(SceneFrames(scene, plan, SIZE, LOOK), plan, target))
        megabytes = target.stat().st_size / 1e6
        decibels = _decibels(_decoded(target), stored)
    return Cost(form, plan.frames, seconds, encode_seconds, megabytes, decibels, memory, work)


def peak_memory(name: str, form: Format, *, frames: int = FRAMES) -> Memory:
    """Record a scene in a process of its own; return the largest memory, as Linux tells it.

    WorkFailed, with the process's last words, where it fails.
    """
    order = f"from {__name__} import print_memory; print_memory({name!r}, {form!r}, {frames!r})"
    here = {**os.environ, "PYTHONPATH": str(Path(__file__).parent)}
    done = subprocess.run(
        [sys.executable, "-P", "-c", order], check=False, env=here, capture_output=True, text=True
    )
    if done.returncode:
        *_, last = (f"it ended with {done.returncode}", *done.stderr.strip().splitlines())
        raise WorkFailed(f"the {form.upper()} whose memory is measured: {last}")
    return Memory(*json.loads(done.stdout.splitlines()[-1]))


def print_memory(name: str, form: Format, frames: int) -> None:
    """Record a scene and print the largest memory of this process and of the encoder, MB, as JSON."""
    scene = load(name)
    plan = _plan(scene, form, frames)
    seen: list[float] = []

    def watch(done: int, total: int) -> None:
        if done == total:
            seen.extend([_peak("self"), max((_peak(child) for child in _children()), default=math.nan)])

    with tempfile.TemporaryDirectory() as folder:
        write(SceneFrames(scene, plan, SIZE, LOOK), plan, Path(folder, f"out.{form}"), watch)
    print(json.dumps(seen))


def _plan(scene: Scene, form: Format, frames: int) -> Plan:
    """Return the plan of one true period in so many frames."""
    return make_plan(Clip(scene.period * FPS / frames, scene.period, FPS), form)


def _stored(file: Path, scene: Scene, plan: Plan) -> NDArray[np.uint8]:
    """Draw all frames into a file; return them (n, bytes) as they lie there."""
    source = SceneFrames(scene, plan, SIZE, LOOK)
    with file.open("wb") as raw:
        for frame in range(plan.frames):
            raw.write(source.draw(frame))
    return np.memmap(file, np.uint8, "r").reshape(plan.frames, -1)


def _encode(stored: NDArray[np.uint8], scene: Scene, plan: Plan, target: Path) -> None:
    form: Format = "gif" if target.suffix == ".gif" else "mp4"
    palette = palette_of(SceneFrames(scene, plan, SIZE, LOOK), plan.frames) if form == "gif" else []
    stream = Stream(form, SIZE, plan.rate)
    code = stream.coding(palette)
    with stream.encoding(target) as send:
        for frame in stored:
            send(code(frame.data))


def _timed(work: Callable[[], object]) -> tuple[float, Work]:
    """Return how long some work takes, s, and the processor time that it takes here and in what it starts."""
    start, before = time.perf_counter(), os.times()
    work()
    seconds, after = time.perf_counter() - start, os.times()
    own, own_system, started, started_system = (
        now - then for now, then in zip(after[:4], before[:4], strict=True)
    )
    return seconds, Work(own + own_system, started + started_system or math.nan)


def _decoded(path: Path) -> Iterator[NDArray[np.uint8]]:
    """Yield a GIF's or MP4's pictures (height, width, 3) of red, green, blue, as ffmpeg shows them."""
    width, height = SIZE
    raw = ["-fps_mode", "passthrough", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    command = [ffmpeg(), "-v", "error", "-nostdin", "-i", f"file:{path}", *raw]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        while process.stdout and len(data := process.stdout.read(3 * width * height)) == 3 * width * height:
            yield np.frombuffer(data, np.uint8).reshape(height, width, 3)


def _decibels(shown: Iterator[NDArray[np.uint8]], stored: NDArray[np.uint8]) -> float:
    """Return the peak signal-to-noise ratio of (height, width, 3) pictures to stored frames."""
    pairs = zip(shown, (frame.reshape(-1, 4)[:, 2::-1] for frame in stored), strict=True)
    errors = [
        float(np.mean(np.square(picture.reshape(-1, 3).astype(int) - drawn))) for picture, drawn in pairs
    ]
    mean = float(np.mean(errors))
    return 10.0 * math.log10(255.0**2 / mean) if mean else math.inf


def _peak(pid: str) -> float:
    """Return the largest memory of a process so far, MB; NaN where the system does not tell."""
    try:
        found = re.search(r"VmHWM:\s*(\d+) kB", Path(f"/proc/{pid}/status").read_text())
    except OSError:
        return math.nan
    return int(found[1]) / 1e3 if found else math.nan


def _children() -> list[str]:
    lists = Path("/proc/self/task").glob("*/children")
    return [child for listed in lists for child in listed.read_text().split()]
