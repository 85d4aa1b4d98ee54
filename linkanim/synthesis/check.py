"""Every answer as the solver runs it: its whole turn, one closure, the points in order, true distances."""

from __future__ import annotations

import math

import numpy as np

from linkanim.errors import AssemblyError, SceneError
from linkanim.mechanics.motion.measures import as_complex, transmission_angle
from linkanim.scenes.reading.read import scene_from
from linkanim.scenes.scene import Scene
from linkanim.synthesis.curves.drawn import DrawnCurve
from linkanim.synthesis.fit import Fit, document_of, parameters_of, rounded
from linkanim.synthesis.kinds import Complex, Real
from linkanim.synthesis.task import PathTask

_POSES = 1440
"""Over the turn, or between the first and the last point, at which the way is compared with the polyline."""
_FOOT_STEPS = 12
_FARTHEST_STEP, _LAST_STEP = 0.1, 1e-9
_SLACK = 1e-9
_RUN, _MOST_RUNS = 16, 128
"""Segments of a polyline that are looked at together at the least, and how many such runs at the most."""


def checked(task: PathTask, row: Real, closure: float, angles: Real) -> Fit | None:
    """Return the answer as written and as the solver runs it; None where it is none after all.

    That is where it does not assemble, does not turn fully or not all the way along an open curve, passes
    the points out of order, or breaks a limit.
    """
    row = rounded(task, row)
    if not keeps(task, row):
        return None
    try:
        scene = _scene(task, row, closure, angles)
        full = scene.info.full_turn
    except (AssemblyError, SceneError):
        return None
    if task.requirements.full_turn and not full:
        return None
    angles, off = _feet(scene, task, angles)
    least = _least_transmission(scene, angles, full=full)
    passes = np.isfinite(off).all() and _in_order(task, angles)
    if not passes or least < task.requirements.least_angle - _SLACK:
        return None
    stray = _stray(_traced(scene, _between(task.curve, angles)), task.curve)
    return _fit(task, scene, row, closure, angles, (off, stray, least))


def _fit(
    task: PathTask, scene: Scene, row: Real, closure: float, angles: Real, found: tuple[Real, float, float]
) -> Fit:
    """Return the answer with its points' distances, how far it strays, and its least transmission angle."""
    off, stray, least = found
    return Fit(
        scene=scene,
        parameters=parameters_of(task.kind, row),
        closure=task.kind.sides[closure < 0],
        angles=angles,
        rms=float(np.sqrt((off**2).mean())),
        largest=float(off.max()),
        stray=stray,
        transmission_angle=least,
        size=float(task.kind.link_lengths(row[None])[0].max()),
        task=task,
    )


def _scene(task: PathTask, row: Real, closure: float, angles: Real) -> Scene:
    """Return the scene of a linkage, its crank starting at the first point and turning the points' way."""
    start, stated = (angles[0], angles[-1] - angles[0]), {"source": task.source, "length_unit": task.unit}
    document = document_of(task.kind, row, closure, start, **stated)
    return scene_from(document, name=task.name, where=task.name)


def checked_by_phase(task: PathTask, row: Real, closure: float, angles: Real) -> Fit | None:
    """Return an answer that may swing through its limits, the points at their nearest over the true period.

    None where it does not assemble. The row is written as it is; `angles` are those of its crank.
    """
    try:
        scene = _scene(task, row, closure, angles)
        phases = np.linspace(0.0, scene.period, _POSES)
    except (AssemblyError, SceneError):
        return None
    way = _traced(scene, phases, "phase")
    start = phases[[int(np.abs(way - point).argmin()) for point in task.curve.points]]
    nearest = _nearest(scene, task.curve.points, start, "phase")
    off = np.abs(_traced(scene, nearest, "phase") - task.curve.points)
    least = scene.info.transmission.least if scene.info.transmission else math.pi / 2
    return _fit(task, scene, row, closure, angles, (off, _stray(way, task.curve), least))


def keeps(task: PathTask, row: Real) -> bool:
    """Return whether a linkage keeps to all limits, to rounding."""
    slack = task.requirements.slack(task.kind, row[None])
    mask, values = task.requirements.held(task.kind)
    given = np.abs(row - values) * mask
    return bool((slack >= -_SLACK * task.curve.size).all() and (given <= _SLACK * task.curve.size).all())


def _traced(scene: Scene, places: Real, by: str = "angle") -> Complex:
    """Return the coupler point at crank angles, or at phases."""
    motion = scene.solve(**{by: places}, derivatives=0)
    return np.asarray(as_complex(motion.position["P"]))


def _feet(scene: Scene, task: PathTask, angles: Real) -> tuple[Real, Real]:
    """Return the crank angles at which the points are passed, in order, and how far each one is off.

    Points are as far off as the nearest place of the curve near by, or, with prescribed timing, as where the
    coupler point is then. Neighbours whose nearest places have changed places are in order as long as that
    is by no more than points are off.
    """
    if task.timing is None:
        sense = 1.0 if angles[-1] > angles[0] else -1.0
        nearest = _nearest(scene, task.curve.points, angles, "angle")
        ordered = sense * _ascending(sense * nearest, closed=task.curve.closed)
        passed = _traced(scene, nearest)
        off = np.abs(passed - task.curve.points)
        if np.abs(_traced(scene, ordered) - passed).max() <= 2 * off.max() + _SLACK * task.curve.size:
            return ordered, off
    return angles, np.abs(_traced(scene, angles) - task.curve.points)


def _ascending(angles: Real, *, closed: bool) -> Real:
    """Return angles sorted, those of a closed curve within one turn."""
    found = np.sort(angles)
    while closed and found[-1] - found[0] > 2 * math.pi:
        found[0], found[-1] = found[-1] - 2 * math.pi, found[0] + 2 * math.pi
        found.sort()
    return found


def _nearest(scene: Scene, points: Complex, places: Real, by: str) -> Real:
    """Return where, near to given places, the coupler point is nearest to each point: Newton's steps."""
    best = places.copy()
    least, reach = np.abs(_traced(scene, best, by) - points), np.full(len(best), _FARTHEST_STEP)
    left = np.arange(len(best))
    for _ in range(_FOOT_STEPS):
        motion = scene.solve(**{by: best[left]}, speed=1.0, derivatives=2)
        way = points[left] - as_complex(motion.position["P"])
        rate, turn = as_complex(motion.velocity["P"]), as_complex(motion.acceleration["P"])
        with np.errstate(all="ignore"):
            square = np.abs(rate) ** 2
            bend = square - (np.conj(turn) * way).real
            step = np.nan_to_num((np.conj(rate) * way).real / np.where(bend > 0, bend, square))
        step = np.clip(step, -reach[left], reach[left])
        off = np.abs(_traced(scene, best[left] + step, by) - points[left])
        nearer = off < least[left]
        best[left] += np.where(nearer, step, 0.0)
        least[left] = np.where(nearer, off, least[left])
        reach[left] = np.where(nearer, _FARTHEST_STEP, np.abs(step) / 4)
        left = left[np.abs(step) > _LAST_STEP]
        if not len(left):
            break
    return best


def _in_order(task: PathTask, angles: Real) -> bool:
    """Return whether the points are passed one after the other, a closed curve in one turn."""
    steps = np.diff(angles) * (1 if angles[-1] > angles[0] else -1)
    whole = abs(angles[-1] - angles[0]) < 2 * math.pi + _SLACK
    return task.timing is not None or bool((steps > -_SLACK).all() and whole)


def _least_transmission(scene: Scene, angles: Real, *, full: bool) -> float:
    """Return the least transmission angle: over the turn, of an input that swings over the points' range."""
    if full:
        return scene.info.transmission.least if scene.info.transmission else math.pi / 2
    motion = scene.solve(angle=np.linspace(angles.min(), angles.max(), _POSES), derivatives=0)
    return float(np.min(transmission_angle(motion, "B")))


def _between(curve: DrawnCurve, angles: Real) -> Real:
    """Return crank angles all along the curve, of an open one between its ends."""
    last = angles[0] + math.copysign(2 * math.pi, angles[-1] - angles[0]) if curve.closed else angles[-1]
    return np.linspace(angles[0], last, _POSES)


def _stray(way: Complex, curve: DrawnCurve) -> float:
    """Return how far the coupler point goes from the points' polyline: from the nearest of its segments.

    Infinite where the way is not closed. Of the segments, taken in runs, only runs are looked at that may
    hold the nearest one.
    """
    start, side = curve.polyline[:-1], np.diff(curve.polyline)
    runs = np.array_split(np.arange(len(side)), 1 + min(len(side) // _RUN, _MOST_RUNS))
    corners = [curve.polyline[run[0] : run[-1] + 2] for run in runs]
    middle = np.array([part.mean() for part in corners])
    radius = np.array([np.abs(part - centre).max() for part, centre in zip(corners, middle, strict=True)])
    least = np.full(len(way), np.inf)
    away = np.abs(way[:, None] - middle)
    near = away - radius <= (away + radius).min(axis=1, keepdims=True) * (1 + _SLACK)
    for run, here in zip(runs, near.T, strict=True):
        if here.any():
            least[here] = np.minimum(least[here], _off(way[here], start[run], side[run]))
    return float(least.max())


def _off(places: Complex, start: Complex, side: Complex) -> Real:
    """Return how far places (n,) are from the nearest of some segments (m,)."""
    way, side = places - start[:, None], side[:, None]
    with np.errstate(invalid="ignore"):  # segments without a length
        share = np.nan_to_num((way.real * side.real + way.imag * side.imag) / np.abs(side) ** 2)
    np.clip(share, 0, 1, out=share)
    x, y = way.real - share * side.real, way.imag - share * side.imag
    return np.asarray(np.sqrt((x * x + y * y).min(axis=0)))
