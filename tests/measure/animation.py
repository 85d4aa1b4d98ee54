"""The usual way to a GIF of a linkage: matplotlib's FuncAnimation, saved by its PillowWriter.

It draws what a recording's scene holds and no more: bodies as thick lines and their plates, pins, springs
and dampers as lines, the traced curves with their recent part, velocities, and the title.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from linkanim.mechanics.motion import Motion
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

_DOTS = 100
"""Pixels to an inch of paper."""
_RECENT = 0.3


def animation_seconds(name: str, *, size: tuple[int, int], frames: int, fps: float) -> float | None:
    """Return how long matplotlib takes for one true period of a scene as a GIF, in s; None without it."""
    if find_spec("matplotlib") is None:
        return None
    with TemporaryDirectory() as folder:
        start = time.perf_counter()
        animate(load(name), Path(folder, "out.gif"), size=size, frames=frames, fps=fps)
        return time.perf_counter() - start


def animate(scene: Scene, target: Path, *, size: tuple[int, int], frames: int, fps: float) -> None:
    """Record one true period of a scene in so many frames by matplotlib."""
    from matplotlib.animation import FuncAnimation, PillowWriter
    from matplotlib.figure import Figure

    sheet = Figure(figsize=(size[0] / _DOTS, size[1] / _DOTS), dpi=_DOTS)
    axes = sheet.add_axes((0.0, 0.0, 1.0, 0.94), aspect="equal", frameon=False, xticks=(), yticks=())
    sheet.suptitle(scene.title)
    updates = list(_drawn(axes, scene, scene.cycle(frames)))

    def update(frame: int) -> None:
        for change in updates:
            change(frame)

    FuncAnimation(sheet, update, frames=frames, interval=1e3 / fps).save(
        target, writer=PillowWriter(fps=round(fps))
    )


def _drawn(axes: Any, scene: Scene, cycle: Motion) -> Iterator[Callable[[int], object]]:
    """Draw on the axes all that a scene holds; yield what moves each thing to a frame."""
    places = {name: np.broadcast_to(place, (len(cycle.phase), 2)) for name, place in cycle.position.items()}
    low, high = (reach(list(places.values()), axis=(0, 1)) for reach in (np.min, np.max))
    margin = 0.08 * float(np.max(high - low))
    axes.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin))
    for joint in scene.trace:
        axes.plot(*places[joint].T, lw=1.5, alpha=0.5)
        yield _following(axes.plot([], [], lw=3)[0], places[joint])
        yield _pointing(axes, places[joint], cycle.velocity[joint])
    linkage = scene.linkage
    for between in [item.between for item in linkage.springs] + [item.between for item in linkage.dampers]:
        ends = np.stack([places[name] for name in between], axis=1)
        yield _placing(axes.plot(*ends[0].T, lw=3, ls="--")[0], ends)
    for body in linkage.bodies:
        if len(body.joints) > 1:
            corners = np.stack([places[name] for name in (*body.joints, body.joints[0])], axis=1)
            yield _placing(axes.plot(*corners[0].T, lw=10, solid_capstyle="round")[0], corners)
    pins = np.stack(list(places.values()), axis=1)
    yield _placing(axes.plot(*pins[0].T, "o", ms=8, mfc="white", mec="black")[0], pins)


def _placing(line: Any, points: Any) -> Callable[[int], object]:
    return lambda frame: line.set_data(*points[frame].T)


def _following(line: Any, path: Any) -> Callable[[int], object]:
    tail = np.arange(-round(_RECENT * len(path)), 1)
    return lambda frame: line.set_data(*path[(frame + tail) % len(path)].T)


def _pointing(axes: Any, path: Any, velocity: Any) -> Callable[[int], object]:
    longest = 0.2 * np.ptp(axes.get_ylim())
    scale = np.max(np.hypot(*velocity.T)) / longest
    arrow = axes.quiver(*path[0], *velocity[0], angles="xy", scale_units="xy", scale=scale, width=0.004)

    def point(frame: int) -> None:
        arrow.set_offsets(path[frame])
        arrow.set_UVC(*velocity[frame])

    return point
