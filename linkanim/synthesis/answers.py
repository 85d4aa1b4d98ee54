"""Check an answer on the solver, give its cognates, and hand it on as numbers or as a file.

Its parts, in reading order:

- An answer: a linkage as a scene, and how well it follows the curve according to the solver.
- Every answer checked by the solver: its whole turn, one closure, the points in order, true distances.
- Roberts's theorem: the cognates of an answer that are answers, too.
- An answer as plain numbers for another process or a tape, and back to a scene.
- Answers as scene files: the first under the name that was asked for, the others numbered.
"""

from __future__ import annotations

import math
import re
from abc import ABC, abstractmethod
from bisect import insort
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np

from linkanim.errors import AssemblyError, SceneError
from linkanim.frozen import frozen
from linkanim.manifest import FileSet, replacing
from linkanim.mechanics.measures import as_complex, transmission_angle
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import text
from linkanim.synthesis.curves import DrawnCurve
from linkanim.synthesis.drivers import Driver
from linkanim.synthesis.fitting import FEW, PathTask
from linkanim.synthesis.linkages import (
    FOUR_BAR,
    Complex,
    Indices,
    Linkage4,
    LinkageKind,
    Real,
    least_of_turn,
)
from linkanim.synthesis.roberts import CognateJoints, cognate_joints

# An answer: a linkage as a scene, and how well it follows the curve according to the solver.

_ROOM_POSES = 144
"""The number of poses over a period from which an answer's room is measured."""


@frozen(eq=False, kw_only=True)
class CouplerLinkage(ABC):
    """A four-bar or slider-crank that was made for its coupler; lengths in its unit, angles in radians."""

    scene: Scene
    parameters: Mapping[str, float]
    """The pivots (x, y, x4, y4), the lengths, and the coupler point along A -> B and to the left of it."""
    closure: str
    angles: Real
    """The crank's angle at each point or pose that the linkage was made for, in their order."""
    transmission_angle: float
    """The least one; where the input does not turn fully, over the range that it was made for."""
    size: float
    """The longest link, or side of the coupler."""
    driver: Driver | None = field(default=None, repr=False)
    """What swings its input, if the scene has a motor that turns fully for that."""

    @property
    @abstractmethod
    def kind(self) -> LinkageKind:
        """What its parameters are."""

    @property
    def class_name(self) -> str:
        """The linkage's class, in words."""
        return self.scene.info.class_name

    @property
    def row(self) -> Real:
        """The parameters as a row, in the order of the kind."""
        return np.array([self.parameters[name] for name in self.kind.parameters])

    @property
    def closure_sign(self) -> float:
        """The closure as +1 or -1."""
        return 1.0 if self.closure == self.kind.sides[0] else -1.0

    @property
    def sense(self) -> float:
        """+1 where the drive runs forwards along the path, else -1; a crank's angle then grows."""
        return math.copysign(1.0, self.scene.linkage.drive.speed)


class Figures(NamedTuple):
    """The figures by which answers are compared: the first three are to be small, the angle large.

    `deviation` is the error that ranks answers, `size` the longest link, and `room` the diagonal of the
    rectangle that all joints sweep, each as a share of the curve's size; `angle` is the least transmission
    angle (rad). `crank` is the crank's length as a share of the longest link's.
    """

    deviation: float
    size: float
    room: float
    angle: float
    crank: float = 1.0


@frozen(eq=False, kw_only=True)
class Fit(CouplerLinkage):
    """A linkage that follows a drawn curve, with its deviations, in the curve's unit."""

    rms: float
    """Root mean square of the points' distances to the coupler curve where it passes them; with prescribed
    timing, to the coupler point at that time."""
    largest: float
    """The largest of those distances."""
    stray: float
    """The largest distance of the coupler point from the points' polyline."""
    phases: Real | None = None
    """The phases at the points, of an answer whose crank swings to its limits along the curve."""
    task: PathTask = field(repr=False)
    exact: Fit | None = field(default=None, repr=False)
    """The answer before its lengths were rounded."""
    most_exact: Fit | None = field(default=None, repr=False)
    """The most exact answer of the search, whether it can be driven or not."""
    cognate: bool = False
    """Whether the answer is a Roberts cognate of an earlier one of its list."""

    @property
    def kind(self) -> LinkageKind:
        """What its parameters are."""
        return self.task.kind

    @cached_property
    def joints(self) -> Complex:
        """The fixed pins, and all joints at the first and at the middle point of the curve."""
        angles = self.angles[None, [0, len(self.angles) // 2]]
        joints: Complex = self.task.kind.joints(self.row[None], np.array([self.closure_sign]), angles)[0]
        return joints

    def apart(self, other: Fit) -> float:
        """Return how far two answers' joints are apart, in curve sizes, whatever their parameters are."""
        return float(np.abs(self.joints - other.joints).max() / self.task.curve.size)

    def apart_from_cognates(self, other: Fit) -> float:
        """Return how far the joints at the first point are from the nearer Roberts cognate of another answer.

        It is in curve sizes; infinite where there are no cognates, which only a four-bar has.
        """
        if self.kind is not FOUR_BAR:
            return math.inf
        own, theirs = (Linkage4(*fit.joints[[0, 2, 4, 1, 6]].tolist()) for fit in (self, other))
        share = (theirs.P - theirs.A) / (theirs.B - theirs.A)
        cognates = cognate_joints((theirs.O2, theirs.O4), share, (theirs.A, theirs.B, theirs.P))
        off = [np.abs(np.array(own) - Linkage4(*joints, theirs.P)).max() for joints in cognates]
        return float(min(off) / self.task.curve.size)

    @property
    def error(self) -> float:
        """The error that ranks answers: the root mean square, and how far the path strays between points."""
        if len(self.angles) <= FEW:
            return self.rms
        return math.hypot(self.rms, max(0.0, self.stray - self.largest - self.task.curve.longest_step / 2))

    @cached_property
    def figures(self) -> Figures:
        """The figures by which the answer is compared with others."""
        places = [as_complex(at) for at in self.scene.cycle(_ROOM_POSES, derivatives=0).position.values()]
        swept = np.concatenate([np.ravel(place) for place in places])
        size = self.task.curve.size
        room = float(np.hypot(np.ptp(swept.real), np.ptp(swept.imag)))
        crank = self.parameters["crank"] / self.size
        return Figures(self.error / size, self.size / size, room / size, self.transmission_angle, crank)


def document_of(
    kind: LinkageKind, row: Iterable[float], closure: float, start: tuple[float, float], **stated: str
) -> dict[str, Any]:
    """Return a linkage as a scene's document, its crank starting at an angle, in a sense (±1).

    `stated` gives its source, and its title and unit of length if these are not the usual ones.
    """
    angle, sense = start
    return {
        "title": f"{kind.name.capitalize()} along a drawn path",
        "source": "",
        "length_unit": "mm",
        **stated,
        "drive": {
            "joint": "A",
            "speed": "-20 rpm" if sense < 0 else "20 rpm",
            "start": f"{round(math.degrees(angle) % 360, 9)!r} deg",
        },
        **kind.document(parameters_of(kind, row), closure),
        "trace": {"joints": ["P"]},
    }


def parameters_of(kind: LinkageKind, row: Iterable[float]) -> dict[str, float]:
    """Return a row's parameters by name, as plain numbers."""
    return dict(zip(kind.parameters, (float(value) for value in row), strict=True))


def rounded(task: PathTask, row: Real) -> Real:
    """Return a row rounded as it is written, to 1e-12 of the curve's size: equal inputs give equal files."""
    values = [
        round(float(value), 13 if name == "line_angle" else task.quantum) + 0.0
        for name, value in zip(task.kind.parameters, row, strict=True)
    ]
    return np.array(values)


# Every answer checked by the solver: its whole turn, one closure, the points in order, true distances.

_POSES = 1440
"""The number of poses, over the turn or the curve, at which the path is compared with the polyline."""
_STEPPED, _BEYOND = 200, 0.02
"""The most points that are found by steps along the curve, and how far these go beyond its ends."""
_FOOT_STEPS = 12
_FARTHEST_STEP, _LAST_STEP = 0.1, 1e-9
_SLACK = 1e-9
_RUN, _MOST_RUNS = 16, 128
"""The least number of a polyline's segments in one run, and the largest number of runs."""


def checked(task: PathTask, row: Real, closure: float, angles: Real) -> Fit | None:
    """Return the answer as the solver runs it; None where the solver rejects it.

    It is rejected where it does not assemble, does not turn fully (or over the whole of an open curve),
    passes the points out of order, or breaks a limit. `angles` (n,) are the crank's at the points.
    """
    if not keeps(task, row):
        return None
    sense = 1.0 if angles[-1] > angles[0] else -1.0
    try:
        scene = _scene(task, row, closure, (angles[0], sense))
        full = scene.info.full_turn
    except (AssemblyError, SceneError):
        return None
    if task.requirements.full_turn and not full:
        return None
    return _Answer(task, scene, row, closure, "angle").fit(angles)


def checked_by_phase(task: PathTask, row: Real, closures: Real, angles: Real) -> Fit | None:
    """Return an answer whose crank swings to its limits along the curve; None where the solver rejects it.

    It is rejected where it does not swing, passes the points out of order, or breaks a limit. `closures` and
    `angles` (n,) are those at the points. At a limit no requested transmission angle is kept; a task with
    timing has no such answer.
    """
    task, closure = task.swinging(), float(closures[0])
    if task.timing is not None or not keeps(task, row):
        return None
    try:
        scene = _scene(task, row, closure, (angles[0], 1.0))
        if scene.info.full_turn:
            return None
        low, high = scene.info.input_range
        # the scene names the closure of phases whose sine is positive
        share = np.remainder(angles - (low + high) / 2 + math.pi, 2 * math.pi) - math.pi
        forth = np.arccos(np.clip(-share / ((high - low) / 2), -1.0, 1.0))
        phases = np.where(closures == closure, forth, 2 * math.pi - forth)
        steps = np.remainder(np.diff(phases) + math.pi, 2 * math.pi) - math.pi
        if steps.sum() < 0:
            scene = _scene(task, row, closure, (angles[0], -1.0))
    except (AssemblyError, SceneError):
        return None
    phases = phases[0] + np.append(0.0, np.cumsum(steps))
    return _Answer(task, scene, row, closure, "phase").fit(phases)


def checked_again(task: PathTask, fit: Fit, chosen: Indices) -> Fit | None:
    """Return an answer to the task among `chosen` points as one at all points; None where it is none."""
    by: Literal["angle", "phase"] = "angle" if fit.phases is None else "phase"
    whole = replace(task, requirements=fit.task.requirements)
    answer = _Answer(whole, fit.scene, fit.row, fit.closure_sign, by)
    places = fit.angles if fit.phases is None else fit.phases
    turn = np.array([[math.copysign(answer.round, places[-1] - places[0])]])
    along = task.spread(places[None], turn, chosen, np.arange(len(task.curve.points)))[0]
    exact = fit.exact and checked_again(task, fit.exact, chosen)
    again = answer.fit(along)
    return again and replace(again, exact=exact)


class _Answer(NamedTuple):
    """A linkage for a task as a scene, its row and closure, and what its places are: angles or phases."""

    task: PathTask
    scene: Scene
    row: Real
    closure: float
    by: Literal["angle", "phase"]

    @property
    def round(self) -> float:
        """The range of the places for the whole curve."""
        return 2 * math.pi if self.by == "angle" else self.scene.period

    def traced(self, places: Real) -> Complex:
        """Return the coupler point at places."""
        motion = self.scene.solve(**{self.by: places}, derivatives=0)  # type: ignore[arg-type]
        return np.asarray(as_complex(motion.position["P"]))

    def angles(self, places: Real) -> Real:
        """Return the crank's angles at places."""
        if self.by == "angle":
            return places
        at = self.scene.solve(phase=places, derivatives=0).position
        return np.unwrap(np.angle(as_complex(at["A"]) - as_complex(at["O2"])))

    def fit(self, places: Real) -> Fit | None:
        """Return an answer with its deviations and its least transmission angle.

        None where it does not pass the points in order near given places, or falls below the least angle.
        """
        if not _in_order(self.task, places, self.round):
            return None
        places, off = self._feet(places)
        if not np.isfinite(off).all():
            return None
        least, stray = self._least_transmission(places), self._stray(places)
        if not least >= self.task.requirements.angle_to_keep(self.by) - _SLACK or not math.isfinite(stray):
            return None
        return Fit(
            scene=self.scene,
            parameters=parameters_of(self.task.kind, self.row),
            closure=self.task.kind.sides[self.closure < 0],
            angles=self.angles(places),
            phases=None if self.by == "angle" else places,
            rms=float(np.sqrt((off**2).mean())),
            largest=float(off.max()),
            stray=stray,
            transmission_angle=least,
            size=float(self.task.kind.link_lengths(self.row[None])[0].max()),
            task=self.task,
        )

    def _feet(self, places: Real) -> tuple[Real, Real]:
        """Return the places at which the points are passed, in order, and how far each point is off.

        A point's distance is to the nearest place of the curve near by, or, with prescribed timing, to the
        coupler point at that time. Neighbours whose nearest places are in the wrong order still count as
        ordered if they are exchanged by no more than the points are off.
        """
        points = self.task.curve.points
        if self.task.timing is not None:
            return places, np.abs(self.traced(places) - points)
        sense = 1.0 if places[-1] > places[0] else -1.0
        places = self._passed(places)
        nearest = self._nearest(points, places)
        ordered = sense * _ascending(sense * nearest, self.round if self.task.curve.closed else math.inf)
        passed = self.traced(nearest)
        off = np.abs(passed - points)
        if np.abs(self.traced(ordered) - passed).max() <= 2 * off.max() + _SLACK * self.task.curve.size:
            return ordered, off
        return places, np.abs(self.traced(places) - points)

    def _passed(self, places: Real) -> Real:
        """Return the places, among equal steps along the curve, nearest to the points in their order.

        Of all ways to pass the points in order it is the one with the least sum of squares; the given places
        are returned where it would take more than one round.
        """
        chosen = self.task.thinned(_STEPPED)
        span = places[-1] - places[0]
        span = math.copysign(self.round, span) if self.task.curve.closed else span
        steps = np.linspace(places[0] - _BEYOND * span, places[0] + (1 + _BEYOND) * span, _POSES)
        squares = np.abs(self.traced(steps) - self.task.curve.points[chosen, None]) ** 2
        squares, numbers = np.where(np.isfinite(squares), squares, np.inf), np.arange(_POSES)
        total, before = squares[0], []
        for square in squares[1:]:
            least = np.minimum.accumulate(total)
            before.append(np.maximum.accumulate(np.where(total <= least, numbers, 0)))
            total = least + square
        backwards = [int(total.argmin())]
        for last in reversed(before):
            backwards.append(int(last[backwards[-1]]))
        along = self.task.normal.places
        passed = np.interp(along, along[chosen], steps[backwards[::-1]])
        return passed if _in_order(self.task, passed, self.round) else places

    def _nearest(self, points: Complex, places: Real) -> Real:
        """Return where, near to given places, the coupler point is nearest to each point: Newton's steps."""
        best = places.copy()
        least, reach = np.abs(self.traced(best) - points), np.full(len(best), _FARTHEST_STEP)
        active = np.arange(len(best))
        for _ in range(_FOOT_STEPS):
            motion = self.scene.solve(**{self.by: best[active]}, speed=1.0)  # type: ignore[arg-type]
            missing = points[active] - as_complex(motion.position["P"])
            rate, turn = as_complex(motion.velocity["P"]), as_complex(motion.acceleration["P"])
            with np.errstate(all="ignore"):
                square = np.abs(rate) ** 2
                bend = square - (np.conj(turn) * missing).real
                step = np.nan_to_num((np.conj(rate) * missing).real / np.where(bend > 0, bend, square))
            step = np.clip(step, -reach[active], reach[active])
            off = np.abs(self.traced(best[active] + step) - points[active])
            nearer = off < least[active]
            best[active] += np.where(nearer, step, 0.0)
            least[active] = np.where(nearer, off, least[active])
            reach[active] = np.where(nearer, _FARTHEST_STEP, np.abs(step) / 4)
            active = active[np.abs(step) > _LAST_STEP]
            if not len(active):
                break
        return best

    def _least_transmission(self, places: Real) -> float:
        """Return the least transmission angle: over the whole motion, or along an open curve."""
        if self.task.curve.closed:
            known = self.scene.info.transmission
            return known.least if known else math.pi / 2
        # in a swing it is extreme at its limits and half-way
        extremes = (self.task.kind.extreme(self.row), math.pi) if self.by == "angle" else (0.0, math.pi / 2)
        return least_along(self.scene, self.by, (float(places.min()), float(places.max())), extremes)

    def _stray(self, places: Real) -> float:
        """Return the coupler point's largest distance from the polyline; of an open one, between its ends."""
        first, last = places[0], places[-1]
        last = first + math.copysign(self.round, last - first) if self.task.curve.closed else last
        return _farthest(self.traced(np.linspace(first, last, _POSES)), self.task.curve)


def _scene(task: PathTask, row: Real, closure: float, start: tuple[float, float]) -> Scene:
    """Return the scene of a linkage, its crank starting at an angle, in a sense (±1)."""
    stated = {"source": task.source, "length_unit": task.unit}
    document = document_of(task.kind, row, closure, start, **stated)
    return scene_from(document, name=task.name, where=task.name)


def keeps(task: PathTask, row: Real) -> bool:
    """Return whether a linkage keeps all limits, but for rounding."""
    margins = task.requirements.margins(task.kind, row[None])
    mask, values = task.requirements.held(task.kind)
    given = np.abs(row - values) * mask
    return bool((margins >= -_SLACK * task.curve.size).all() and (given <= _SLACK * task.curve.size).all())


def _ascending(places: Real, most: float) -> Real:
    """Return places sorted; those beyond the end of a closed curve continue at its beginning."""
    ascending = sorted(places.tolist())
    while ascending[-1] - ascending[0] > most:
        first, last = ascending.pop(0), ascending.pop()
        insort(ascending, last - most)
        insort(ascending, first + most)
    return np.array(ascending)


def _in_order(task: PathTask, places: Real, most: float) -> bool:
    """Return whether the points are passed one after the other, a closed curve in one round."""
    steps = np.diff(places) * (1 if places[-1] > places[0] else -1)
    whole = abs(places[-1] - places[0]) < most + _SLACK
    return task.timing is not None or bool((steps > -_SLACK).all() and whole)


def least_along(scene: Scene, by: str, ends: tuple[float, float], extremes: tuple[float, float]) -> float:
    """Return the least transmission angle at B between two places of the input, the lower one first.

    It is least at an end, or where it is extreme: at one place and every so many radians from there.
    """
    (low, high), (first, step) = ends, extremes
    between = np.arange(math.ceil((low - first) / step), math.floor((high - first) / step) + 1)
    along = np.array([low, *(first + between * step), high])
    motion = scene.solve(**{by: along}, derivatives=0)  # type: ignore[arg-type]
    return float(np.min(transmission_angle(motion, "B")))


def _farthest(path: Complex, curve: DrawnCurve) -> float:
    """Return the largest distance of a path from the points' polyline, which is to the nearest segment.

    It is infinite where the path breaks off. The segments are grouped in runs, and only the runs that may
    contain the nearest segment are searched.
    """
    start, side = curve.polyline[:-1], np.diff(curve.polyline)
    runs = np.array_split(np.arange(len(side)), 1 + min(len(side) // _RUN, _MOST_RUNS))
    corners = [curve.polyline[run[0] : run[-1] + 2] for run in runs]
    middle = np.array([part.mean() for part in corners])
    radius = np.array([np.abs(part - centre).max() for part, centre in zip(corners, middle, strict=True)])
    least = np.full(len(path), np.inf)
    away = np.abs(path[:, None] - middle)
    near = away - radius <= (away + radius).min(axis=1, keepdims=True) * (1 + _SLACK)
    for run, here in zip(runs, near.T, strict=True):
        if here.any():
            least[here] = np.minimum(least[here], _off(path[here], start[run], side[run]))
    return float(least.max())


def _off(places: Complex, start: Complex, side: Complex) -> Real:
    """Return the distances (n,) of places from the nearest of some segments (m,)."""
    from_start, side = places - start[:, None], side[:, None]
    with np.errstate(invalid="ignore"):  # segments without a length
        share = np.nan_to_num((from_start.real * side.real + from_start.imag * side.imag) / np.abs(side) ** 2)
    np.clip(share, 0, 1, out=share)
    x, y = from_start.real - share * side.real, from_start.imag - share * side.imag
    return np.asarray(np.sqrt((x * x + y * y).min(axis=0)))


# Roberts's theorem: the cognates of an answer that are answers, too.

_TIMED = 1e-9
"""The largest difference of crank angles (rad) from those that are given."""


def cognates_of(fit: Fit) -> Iterator[Fit]:
    """Yield a four-bar's two cognates, driven at O6 or O2, as far as they are answers to the same task.

    One may be a double-rocker, whose curve is then traced by both its closures. A cognate is left out if
    one of its links would vanish (as where the coupler point is a pin), or if it breaks a limit or the
    timing.
    """
    point = fit.task.kind.points(fit.row[None], np.array([fit.closure_sign]), fit.angles[None])[0]
    for pivot, crank, rocker, other in _cognates(fit, point):
        first = Linkage4(pivot, crank[0], rocker[0], other, point[0])
        with np.errstate(all="ignore"):
            row = np.array(first.row)
        angles = _timed(fit, np.unwrap(np.angle(crank - pivot)))
        if angles is None or not np.isfinite(row).all():
            continue
        closures = np.where((np.conj(other - crank) * (rocker - crank)).imag >= 0, 1.0, -1.0)
        task = fit.task if fit.task.curve.closed else fit.task.swinging()
        cognate = checked(task, row, first.closure, angles) or checked_by_phase(task, row, closures, angles)
        yield from [cognate] if cognate else []


def _timed(fit: Fit, angles: Real) -> Real | None:
    """Return crank angles shifted by whole turns to those given; None where they are not the same."""
    task = fit.task
    if task.timing is None:
        return angles
    late = angles - task.timing
    if task.free_start:
        late = late - late[0]
    turns = np.round(late / (2 * np.pi)) * 2 * np.pi
    return angles - turns if np.abs(late - turns).max() <= _TIMED else None


def _cognates(fit: Fit, point: Complex) -> tuple[CognateJoints[Complex], CognateJoints[Complex]]:
    """Return both cognates' joints at the points, as `cognate_joints` orders them."""
    x, y, crank, coupler, along, across, x4, y4, _ = fit.row
    o2, share = complex(x, y), complex(along, across) / coupler
    pin_a = o2 + crank * np.exp(1j * fit.angles)
    pin_b = pin_a + (point - pin_a) / share if share else pin_a
    return cognate_joints((o2, complex(x4, y4)), share, (pin_a, pin_b, point))


# An answer as plain numbers for another process or a tape, and back to a scene.

NAME = "path"
"""What the scene of an answer is called, and its file."""
EARLIER = 4 + len(FOUR_BAR.parameters)
NUMBERS = EARLIER + 2
"""How many numbers an answer has; on older tapes the last two are missing."""


class PathAnswer(NamedTuple):
    """A four-bar that follows a stroke, with its deviation in percent of the stroke's size.

    `closure` is +1 or -1, `start` the crank's angle at the stroke's first point (rad), `sense` +1 or -1 as it
    turns from there, `row` the parameters of a four-bar. `size` is its longest link as a share of the
    stroke's size, `angle` the least transmission angle (rad), each 0 where it is not known.
    """

    off: float
    closure: float
    start: float
    sense: float
    row: tuple[float, ...]
    size: float = 0.0
    angle: float = 0.0

    @property
    def figures(self) -> Figures:
        """The figures by which it is compared with others, without the room that it sweeps."""
        lengths = FOUR_BAR.link_lengths(np.array([self.row]))[0]
        return Figures(self.off / 100, self.size, self.size, self.angle, float(lengths[0] / lengths.max()))

    @property
    def passed(self) -> Complex:
        """Points that its joints pass in a turn of the crank."""
        angles = self.start + self.sense * _TURN
        points: Complex = FOUR_BAR.joints(np.array([self.row]), np.array([self.closure]), angles[None])[0]
        return points.ravel()

    @property
    def numbers(self) -> tuple[float, ...]:
        """The whole answer as one row of numbers."""
        return (*self[:4], *self.row, self.size, self.angle)

    def scene(self, unit: str, goal: Scene | None = None) -> Scene:
        """Return the linkage as a scene, or as a step towards `goal`; errors as of a scene file."""
        source = "made by linkanim for a path drawn in the window"
        start = self.start, self.sense
        document = document_of(FOUR_BAR, self.row, self.closure, start, source=source, length_unit=unit)
        return scene_from(document, name=NAME, where=NAME, goal=goal)


def answer_of(fit: Fit) -> PathAnswer:
    """Return a fit's answer."""
    figures, row = fit.figures, tuple(float(value) for value in fit.row)
    start, off = float(fit.angles[0]), 100 * figures.deviation
    return PathAnswer(off, fit.closure_sign, start, fit.sense, row, figures.size, figures.angle)


def answer_from(numbers: tuple[float, ...]) -> PathAnswer:
    """Return the answer whose `numbers` these are; the last two may be missing."""
    off, closure, start, sense = numbers[:4]
    return PathAnswer(off, closure, start, sense, tuple(numbers[4:EARLIER]), *numbers[EARLIER:])


_TURN = np.linspace(0.0, 2 * math.pi, 73)
"""The crank's angles at which cognates are looked at."""


def turning_cognates(answer: PathAnswer) -> tuple[PathAnswer | None, PathAnswer | None]:
    """Return both cognates of an answer, None for one whose crank does not turn fully on one closure.

    They trace the same curve with the same deviation. An answer whose own crank swings has none.
    """
    row, sign = np.array([answer.row]), np.array([answer.closure])
    angles = answer.start + answer.sense * _TURN
    with np.errstate(all="ignore"):
        point = FOUR_BAR.points(row, sign, angles[None])[0]
    x, y, crank, coupler, along, across, x4, y4, _ = answer.row
    o2, share = complex(x, y), complex(along, across) / coupler
    if not share or not np.isfinite(point).all():
        return None, None
    pin_a = o2 + crank * np.exp(1j * angles)
    pins = pin_a, pin_a + (point - pin_a) / share, point
    first, second = cognate_joints((o2, complex(x4, y4)), share, pins)
    return _turning(answer, first, point[0]), _turning(answer, second, point[0])


def _turning(answer: PathAnswer, joints: CognateJoints[Complex], point: complex) -> PathAnswer | None:
    pivot, crank, rocker, other = joints
    angles, sides = np.unwrap(np.angle(crank - pivot)), (np.conj(other - crank) * (rocker - crank)).imag
    turned = float(angles[-1] - angles[0])
    if abs(abs(turned) - 2 * math.pi) > _SLACK or not ((sides > 0).all() or (sides < 0).all()):
        return None
    start = Linkage4(pivot, crank[0], rocker[0], other, point)
    with np.errstate(all="ignore"):
        row = np.array(start.row)
    if not np.isfinite(row).all():
        return None
    longest, own = (FOUR_BAR.link_lengths(np.array([one]))[0].max() for one in (row, answer.row))
    return answer._replace(
        closure=start.closure,
        start=float(angles[0]),
        sense=math.copysign(1.0, turned),
        row=tuple(map(float, row)),
        size=float(answer.size * longest / own),
        angle=float(least_of_turn(row[2], row[3], row[8], np.abs(other - pivot))),
    )


# Answers as scene files: the first under the name that was asked for, the others numbered.


def file_set(target: Path) -> FileSet:
    """Return the set of files to which answers are written: NAME.toml, NAME-2.toml, ..."""
    return FileSet(target.parent, target.name, rf"{re.escape(target.stem)}(-\d+)?\.toml")


def names_of(target: Path, count: int) -> list[str]:
    """Return the names of so many answers' files."""
    return [target.name, *(f"{target.stem}-{number}.toml" for number in range(2, count + 1))]


def write(scenes: Sequence[Scene], target: Path) -> list[Path]:
    """Write the answers, all or none, and return their paths; an older run's further files are removed.

    BadInput where a name is taken by a file that is not ours, or by one that was changed since.
    """
    names = names_of(target, len(scenes))
    with replacing(file_set(target), names) as folder:
        for scene, name in zip(scenes, names, strict=True):
            (folder / name).write_text(text(scene), encoding="utf-8")
    return [target.parent / name for name in names]
