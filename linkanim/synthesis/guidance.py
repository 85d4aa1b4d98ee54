"""`linkanim.guide`: poses to the linkages whose coupler passes them, each checked on the solver.

A four-bar is made of two bars of Burmester's theory, a slider-crank of one bar and a point that runs along a
line. Free choices are sampled, all combinations are judged at once, and the best are improved step by step.
The defects are named as by Norton (Design of Machinery) and McCarthy (Geometric Design of Linkages): a
linkage has a defect of *circuit* where it would have to be taken apart to get from one pose to another, of
*branch* where it would have to pass a limit of its input, and of *order* where it passes the poses in another
order.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim import units
from linkanim.bounds import NUMBERS, can_be_computed
from linkanim.errors import AssemblyError, BadInput, SceneError
from linkanim.frozen import frozen
from linkanim.mechanics.measures import as_complex
from linkanim.scenes.editing import phase_along
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.synthesis.answers import CouplerLinkage, Figures, document_of, parameters_of
from linkanim.synthesis.burmester import (
    SAME,
    Bars,
    CentreCurve,
    Poses,
    Slides,
    ball_point,
    burmester_points,
    centre_points,
    circle_points,
    polished,
    slide_points,
    slides_through,
    straightened,
)
from linkanim.synthesis.drivers import all_driven, place_of
from linkanim.synthesis.front import differ, is_driven
from linkanim.synthesis.linkages import (
    KINDS,
    SLIDER_CRANK,
    Box,
    Complex,
    Indices,
    LinkageKind,
    Real,
    Requirements,
    angle_of,
    boxes_of,
    holds,
    refuse_count,
)
from linkanim.synthesis.pairs import mirror_of, paired
from linkanim.units import shown

LARGEST = 8.0
"""The longest link by default, in the poses' sizes."""
COUNT = 6
DEFECTS = ("circuit", "branch", "order")
PREFERENCES: Mapping[str, float] = {"compact": 0.5, "angle": 6.0}
"""The values of `prefer`, each with the weight of the transmission angle against the size."""
USUAL_WEIGHT = 2.0

_SAMPLES = {2: 160, 3: 160, 4: 72}
"""The number of bars that are tried for so many poses; for four, on each circuit of the curve."""
_ON_A_CURVE = 4
"""The number of poses whose pivots lie on a curve, and how much more closely it is sampled in a box."""
_CLOSER = 20
_REACH = 1.6
"""The distance from the poses' middle, in their sizes, up to which free pivots are tried."""
_ON_CURVE = 1e-4
"""The distance, in the poses' size, within which a given pivot is moved to a possible one."""
_GIVEN = 1e-13
"""The distance, in the poses' size, by which rounding may move a given pivot."""
_MET = 1e-6
"""The distance, in the poses' size, up to which a pose counts as passed."""
_EXACT = 1e-14
"""The distance, in the poses' size, at which Newton's steps end."""
_APART = 0.25
"""The least distance, in the poses' size, of linkages from which better ones are searched."""
_PREFERRED = 2
"""The number of linkages that are improved towards the smallest size, and towards the best angle."""
_MORE = 4
"""The number of linkages beyond the requested count that are improved, as some become equal."""
_ROUNDS, _NARROWER = 8, 0.4
_USUAL_LEAST = math.radians(40)
"""A transmission angle below this one, the usual least, counts twice."""
_TURNING, _DEFECT = 0.5, 1e3
"""The gain for a crank that turns fully, as a logarithm of the size, and the cost of a defect."""
_CLOSED = 1e-12
"""The most by which a cosine may exceed 1 at a change point."""
_FINEST = 720
_STEP = 0.1
"""The longest step of Newton's method (rad)."""
_ALIKE = 0.15
"""The distance of joints, in the poses' size, up to which two answers look the same."""
_DIGITS = 15


@frozen(eq=False)
class GuideTask:
    """Poses, a kind of linkage, the fixed pivots that are given, and limits."""

    poses: Poses
    kind: LinkageKind
    pivots: tuple[complex, ...]
    requirements: Requirements
    boxes: tuple[Box, ...] = ()
    """The boxes for the pins that are not given: one for all, or two with one pin in each."""
    unit: str = "mm"
    name: str = "guide"
    source: str = "made by linkanim for poses"


@frozen(eq=False, kw_only=True)
class GuidedLinkage(CouplerLinkage):
    """A linkage and the poses that it was made for.

    Its least transmission angle is taken from the first pose to the last; with defects, at the poses only.
    """

    phases: Real
    """The phases at which the linkage is nearest to each pose."""
    lean: float
    """The coupler's angle minus that of the pose it is in (rad)."""
    bars: tuple[Complex, Complex]
    """Each bar's joint on the coupler, in the first pose, and its pivot; for a slider, its joint twice."""
    error: float
    """The largest deviation from a pose: of the origin, or of the angle times the poses' size."""
    defects: tuple[str, ...]
    """The `DEFECTS` that prevent it from running through the poses in their order."""
    task: GuideTask = field(repr=False)

    @property
    def kind(self) -> LinkageKind:
        """What its parameters are."""
        return self.task.kind


def guide(poses: ArrayLike, *, count: int = COUNT, **options: Any) -> tuple[GuidedLinkage, ...]:
    """Return linkages whose coupler passes poses (n, 3), 2 to 5 rows of x, y and angle (rad), the best first.

    Linkages without a defect come first, of them the one to build: small, with a transmission angle of 30
    degrees at least where there is one; the others follow by size. `prefer` is "compact" or "angle" to weigh
    one of these more, and lists the best of that first. For five poses all linkages are returned, for fewer a
    choice of different ones. `driver` gives each answer whose crank swings a motor that turns fully, or says
    where that stands (x, y); `mirror`, "x=40" or "y=0", adds its mirror image, geared to its crank. The other
    options are described below. BadInput, with the reason, for poses and
    limits that make no sense, and if no linkage of the kind passes the poses.
    """
    refuse_count(count)
    prefer = options.pop("prefer", None)
    if prefer is not None and prefer not in PREFERENCES:
        raise BadInput(f"prefer={shown(prefer)}: take {' or '.join(PREFERENCES)}, or leave it out")
    motor = options.pop("driver", False)
    place, line = place_of(motor), mirror_of(options.pop("mirror", None))
    guided = answers(task_of(poses, **options), count, PREFERENCES[prefer] if prefer else None)
    if motor is not False:
        guided = tuple(
            replace(one, phases=one.driver.phases(one.angles)) if one.driver else one
            for one in all_driven(guided, place, _on_the_way)
        )
    return paired(guided, line)


def _on_the_way(one: GuidedLinkage) -> Real | None:
    """Return the crank's angles from pose to pose; None where it cannot pass them in their order."""
    return None if one.defects else np.unwrap(one.angles)


def task_of(
    poses: ArrayLike,
    *,
    kind: str = "four-bar",
    pivots: Sequence[Sequence[float] | None] = (),
    box: Sequence[float] | Sequence[Sequence[float]] | None = None,
    largest: float = LARGEST,
    least_angle: float = 0.0,
    unit: str = "mm",
    name: str = "guide",
    source: str = "made by linkanim for poses",
) -> GuideTask:
    """Return what is asked for, checked.

    `kind` is "four-bar" or "slider-crank". `pivots` are fixed pins in any order, None for one that is free.
    `box` is the x, y, width and height of the rectangle in which the other fixed pins lie, or two of them
    with a pin in each, `largest` the longest link in sizes of the set of poses, `least_angle` the least
    transmission angle (rad) on the way from the first pose to the last.
    """
    if kind not in KINDS:
        raise BadInput(f"kind={shown(kind)}: take {' or '.join(KINDS)}")
    units.metre(unit)
    try:
        rows = np.asarray(poses, dtype=np.float64)
    except (TypeError, ValueError):
        raise BadInput("poses are numbers: give a row of x, y and angle for each") from None
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise BadInput(f"poses of shape {rows.shape}: give a row of x, y and angle for each, (n, 3)")
    pose_set, chosen = Poses(rows[:, 0] + 1j * rows[:, 1], rows[:, 2].copy()), KINDS[kind]
    if (point := pose_set.one_pole) is not None:
        raise BadInput(
            f"all poses turn about one point, {point.real:g}, {point.imag:g}: a single pin there carries the "
            "body, so no linkage is needed; move one of the poses if one is"
        )
    if len(pivots) > len(chosen.pins):
        raise BadInput(f"a {kind} has {len(chosen.pins)} fixed pins; {len(pivots)} are given")
    given = tuple(_pivot(pivot) for pivot in pivots if pivot is not None)
    if len(given) == 2 and abs(given[1] - given[0]) <= SAME * pose_set.size:
        raise BadInput(
            f"both pivots are given at {given[0].real:g}, {given[0].imag:g}, so there is no ground link "
            "between them; give one of them another place, or leave it out"
        )
    boxes = _boxes(box, pose_set, given, len(chosen.pins) - len(given))
    limits = Requirements.of(pose_set.size, "sizes of the poses", largest=largest, least_angle=least_angle)
    return GuideTask(pose_set, chosen, given, replace(limits, full_turn=False), boxes, unit, name, source)


def _boxes(
    box: Sequence[float] | Sequence[Sequence[float]] | None,
    poses: Poses,
    given: tuple[complex, ...],
    free: int,
) -> tuple[Box, ...]:
    """Return the boxes for the `free` pins; BadInput for more boxes, and if nothing can lie in them."""
    boxes = boxes_of(box)
    if not boxes:
        return ()
    if not free:
        for pivot in given:
            if not any(holds(one, pivot) for one in boxes):
                raise BadInput(
                    f"the pivot at {pivot.real:g}, {pivot.imag:g} lies outside the box; enlarge the box"
                )
        return ()
    if len(boxes) > free:
        pins = "one fixed pin is" if free == 1 else f"{free} fixed pins are"
        raise BadInput(f"{len(boxes)} boxes are given, and {pins} free; give a box for each free pin, or one")
    if poses.count == _ON_A_CURVE and poses.poles:
        curve = CentreCurve(poses)
        for one in boxes:
            if not len(_phases_in((one,), curve)):
                nearest = curve.nearest(complex(one[0] + one[2] / 2, one[1] + one[3] / 2))
                raise BadInput(
                    f"no centre point of these four poses lies in the box of {one[2]:g} x {one[3]:g} at "
                    f"{one[0]:g}, {one[1]:g}; one that is near is {nearest.real:.6g}, {nearest.imag:.6g}"
                )
    return boxes


def _pivot(pivot: Sequence[float]) -> complex:
    """Return a requested fixed pin as x + yi; BadInput where it is no point."""
    try:
        values = tuple(float(value) for value in pivot)
    except (TypeError, ValueError):
        values = ()
    if len(values) != 2 or not can_be_computed(*values):
        raise BadInput(f"pivot {shown(str(list(pivot)))}: give x and y, each {NUMBERS}")
    return complex(*values)


class _EndChoice(NamedTuple):
    """The free choices at one end of the coupler: rows of parameters to try, and what makes its bar or slide.

    `steps` are the first steps of the parameters in the search for a better row; empty where none is free.
    Where it is `held` the bars end at a pivot that stays to the last digit.
    """

    rows: Real
    make: Callable[[Real], Any]
    steps: tuple[float, ...]
    held: bool = False

    @property
    def free(self) -> bool:
        """Whether there are parameters that can be moved."""
        return any(self.steps)

    def around(self, row: Real, scale: float) -> Real:
        """Return a row (1, d), and the rows with one parameter moved to either side by a step."""
        moves = np.diag(self.steps)[np.flatnonzero(self.steps)] * scale
        return np.concatenate(
            [row, *(row + factor * moves for factor in (-1.0, -0.3, 0.3, 1.0) if len(moves))]
        )


def _all_of(ends: Bars | Slides) -> _EndChoice:
    """Return a choice among these bars or slides, without free parameters."""
    rows = np.arange(len(ends[0]), dtype=np.float64)[:, None]
    return _EndChoice(rows, lambda rows: type(ends)(*(part[rows[:, 0].astype(int)] for part in ends)), (0.0,))


def _bars(task: GuideTask) -> _EndChoice:
    """Return the bars that may hold one end of the coupler, their pivots free."""
    poses = task.poses
    if poses.count == 2:
        rows = _scattered(poses, _SAMPLES[2], task.boxes)
        rows[:, 2] = np.tan((rows[:, 2] - 0.5) * 0.85 * math.pi) * poses.size
        return _EndChoice(rows, lambda rows: _of_two(poses, rows), (0.2 * poses.size,) * 3)
    if poses.count == 3 or not poses.poles:
        rows = _scattered(poses, _SAMPLES[3], task.boxes)[:, :2]
        if not np.isfinite(_about(poses, rows).circle).any():
            raise BadInput(
                f"these {poses.count} poses are parallel and their places lie on no circle, so no point of "
                "the body stays at one distance from a pivot; turn them against each other"
            )
        return _EndChoice(rows, lambda rows: _about(poses, rows), (0.2 * poses.size,) * 2)
    return _on_curve(task) if poses.count == _ON_A_CURVE else _all_of(_of_five(poses))


_STEPS = np.array([0.8191725133961645, 0.6710436067037893, 0.5497004779019703])
"""Negative powers of the root of x⁴ = x + 1, whose multiples are evenly scattered (Roberts's sequence)."""


def _scattered(poses: Poses, count: int, boxes: Sequence[Box] = ()) -> Real:
    """Return (count, 3): x and y of points in boxes, or about the poses, and a number from 0 to 1."""
    rows = (0.5 + np.outer(np.arange(1, count + 1), _STEPS)) % 1.0
    reach = _REACH * poses.size
    low = poses.centre - complex(reach, reach)
    rooms = np.array(boxes or [(low.real, low.imag, 2 * reach, 2 * reach)])
    corner, sides = np.split(rooms[np.arange(count) % len(rooms)], 2, axis=1)
    rows[:, :2] = corner + sides * rows[:, :2]
    return np.asarray(rows)


def _of_two(poses: Poses, rows: Real) -> Bars:
    """Return the bars of two poses by their pivots, and by places on the midperpendicular of the images."""
    centre = rows[:, 0] + 1j * rows[:, 1]
    first, second = poses.images(centre).T
    chord = second - first
    with np.errstate(all="ignore"):
        return Bars((first + second) / 2 + 1j * chord / np.abs(chord) * rows[:, 2], centre)


def _about(poses: Poses, rows: Real) -> Bars:
    """Return the bars of three poses by their pivots."""
    centre = rows[:, 0] + 1j * rows[:, 1]
    return Bars(circle_points(poses, centre), centre)


def _on_curve(task: GuideTask) -> _EndChoice:
    """Return the bars of four poses: circuits of the centre points' curve and phases along them."""
    poses = task.poses
    curve = CentreCurve(poses)
    count = len(curve.circuits)
    if task.boxes:
        rows = _phases_in(task.boxes, curve)
    else:
        phases = (np.arange(_SAMPLES[4]) + 0.5) * (math.tau / _SAMPLES[4])
        rows = np.column_stack([np.repeat(np.arange(count), len(phases)), np.tile(phases, count)])

    def make(rows: Real) -> Bars:
        centre = np.full(len(rows), np.nan, np.complex128)
        for circuit in range(count):
            on = rows[:, 0] == circuit
            centre[on] = curve.at(circuit, rows[on, 1])
        return Bars(circle_points(poses, centre), centre)

    return _EndChoice(rows, make, (0.0, math.tau / _SAMPLES[4]))


def _phases_in(boxes: Sequence[Box], curve: CentreCurve) -> Real:
    """Return circuits of a curve and phases along them (n, 2) at which it runs within each of some boxes."""
    count = _CLOSER * _SAMPLES[4]
    phases = np.asarray((np.arange(count) + 0.5) * (math.tau / count), dtype=np.float64)
    parts = [np.empty((0, 2))]
    for circuit in range(len(curve.circuits)):
        places = curve.at(circuit, phases)
        for box in boxes:
            there = phases[[holds(box, coordinate) for coordinate in places.tolist()]]
            there = there[:: -(-len(there) // _SAMPLES[4]) or 1]
            parts.append(np.column_stack([np.full(len(there), float(circuit)), there]))
    return np.concatenate(parts)


def _bars_at(task: GuideTask, pivot: complex) -> _EndChoice:
    """Return the bars that end at a given pivot; BadInput where there is none, with the nearest possible."""
    poses = task.poses
    where = f"the pivot at {pivot.real:g}, {pivot.imag:g}"
    if poses.count == 2:
        return _on_midline(poses, pivot)._replace(held=True)
    if poses.count == 3 or not poses.poles:
        bar = Bars(circle_points(poses, np.array([pivot])), np.array([pivot]))
        if not np.isfinite(bar.circle[0]):
            raise BadInput(
                f"{where}: as the body sees it, it lies in one line in all poses, or in one point, so no "
                "joint of the body stays at one distance from it; move the pivot"
            )
        return _all_of(bar)._replace(held=poses.count == 3)
    if poses.count == 4:
        nearest = CentreCurve(poses).nearest(pivot)
        if abs(nearest - pivot) > _ON_CURVE * poses.size:
            raise BadInput(
                f"{where}: is no centre point of these four poses; the nearest one is "
                f"{nearest.real:.6g}, {nearest.imag:.6g}"
            )
        # where the curve nearly crosses itself, its nearest point is less exact than the given pivot
        tried = np.array([pivot, nearest])
        circles = circle_points(poses, tried)
        chosen = np.array([0 if np.isfinite(circles[0]) else 1])
        return _all_of(Bars(circles, tried).take(chosen))
    bars = _of_five(poses)
    nearby = np.abs(bars.centre - pivot) <= _ON_CURVE * poses.size
    if not nearby.any():
        places = "; ".join(f"{place.real:.6g}, {place.imag:.6g}" for place in bars.centre)
        raise BadInput(f"{where}: five poses leave no choice of pivots, theirs are {places}; take of these")
    return _all_of(bars.take(np.flatnonzero(nearby)))


def _of_five(poses: Poses) -> Bars:
    """Return the bars of five poses; BadInput where there is none."""
    bars = burmester_points(poses)
    if not len(bars.centre):
        raise BadInput(
            "no point of the body stays on a circle through these five poses: none of Burmester's four "
            "points is real; move a pose a little, or leave one out"
        )
    return bars


def _on_midline(poses: Poses, pivot: complex) -> _EndChoice:
    """Return the bars of two poses at a pivot: their circle points lie on a line, or anywhere at the pole."""
    first, second = poses.images(pivot)
    if abs(second - first) <= SAME * poses.size:
        rows = _scattered(poses, _SAMPLES[2])[:, :2]
        return _EndChoice(
            rows,
            lambda rows: Bars(rows[:, 0] + 1j * rows[:, 1], np.full(len(rows), pivot)),
            (0.2 * poses.size,) * 2,
        )
    along = np.tan(np.linspace(-1.3, 1.3, _SAMPLES[2])) * poses.size
    rows = np.column_stack([np.full(len(along), pivot.real), np.full(len(along), pivot.imag), along])
    return _EndChoice(rows, lambda rows: _of_two(poses, rows), (0.0, 0.0, 0.2 * poses.size))


def _slides(task: GuideTask) -> _EndChoice:
    """Return the points that may slide along a line; BadInput where no point has its places in one line."""
    poses = task.poses
    if poses.count == 2 or (poses.count == 3 and not poses.poles and len(ball_point(poses).point)):
        rows = _scattered(poses, _SAMPLES[2])[:, :2]
        return _EndChoice(
            rows,
            lambda rows: slides_through(poses, rows[:, 0] + 1j * rows[:, 1]),
            (0.2 * poses.size,) * 2,
        )
    if poses.count == 3 and poses.poles:
        rows = np.linspace(0.0, math.tau, _SAMPLES[3], endpoint=False, dtype=np.float64)[:, None]
        return _EndChoice(rows, lambda rows: slides_through(poses, slide_points(poses, rows[:, 0])), (0.1,))
    slide = ball_point(poses)
    if not len(slide.point):
        fewer = "leave one out" if poses.count > 4 else "turn them against each other"
        raise BadInput(
            f"no point of the body has its places in these {poses.count} poses in one line, so none can "
            f"slide; {fewer}, or take a four-bar"
        )
    return _all_of(slide)


class _Linkages:
    """Linkages (k,) for a task: their joints in the first pose, and their properties in closed form.

    `pin` is the crank's circle point, `pivot` its pivot, `end` the coupler's other end, and `held` what holds
    that: the other pivot, or the direction of a line. `angles` are the crank's at each pose (k, n), growing
    or falling in the order of passing; `closures` are +1 or -1 at each pose; `turning` says whether the crank
    turns fully, `defects` (k, 3) which of `DEFECTS` there are, `transmission` the least angle, `size` the
    longest link.

    With τ the crank's angle from the ground line, or from the line's normal, the cosine of the angle at the
    coupler's end is c = p + q·cos τ for both kinds (for the slider-crank its rod against its line's normal).
    The linkage closes while |c| ≤ 1: a crank has a limit near τ = 0, where |p + q| > 1, and near τ = π,
    where |p - q| > 1; with both limits, the ranges on the two sides of the ground line are separate circuits.
    """

    def __init__(self, task: GuideTask, first: Bars, second: Bars | Slides) -> None:
        """Take all pairs of a crank and another end."""
        one, other = (part.ravel() for part in np.indices((len(first[0]), len(second[0]))))
        self.task = task
        self.pin, self.pivot = first.circle[one], first.centre[one]
        self.end, self.held = second[0][other], second[1][other]
        poses, sliding = task.poses, task.kind is SLIDER_CRANK
        pins, ends = poses.places(self.pin), poses.places(self.end)
        crank, coupler = pins - self.pivot[:, None], ends - pins
        r2, r3 = np.abs(crank).mean(axis=1), np.abs(coupler).mean(axis=1)
        held = self.held
        with np.errstate(all="ignore"):
            if sliding:
                # the first pose is to be closed forward
                held = np.where((np.conj(held) * coupler[:, 0]).real < 0, -held, held)
                offset = (np.conj(held)[:, None] * (ends - self.pivot[:, None])).imag.mean(axis=1)
                reference, p, q = -1j * held, -offset / r3, -r2 / r3
                side = (np.conj(held)[:, None] * coupler).real
            else:
                ground = held - self.pivot
                r1, r4 = np.abs(ground), np.abs(ends - held[:, None]).mean(axis=1)
                reference, q = ground / r1, r1 * r2 / (r3 * r4)
                p = (r3 * r3 + r4 * r4 - r1 * r1 - r2 * r2) / (2 * r3 * r4)
                side = (np.conj(held[:, None] - pins) * coupler).imag
            angle = np.angle(crank / reference[:, None])
            # a link of no length closes nowhere
            p, q = (np.where(np.isfinite(part), part, np.nan) for part in (p, q))
        # where the greatest c is 1 the two closures meet: a change point
        near, far = (np.abs(place) - 1 for place in (p + q, p - q))
        changes = (np.abs(near) <= _CLOSED).astype(int) + (np.abs(far) <= _CLOSED)
        near, far = near <= _CLOSED, far <= _CLOSED
        turning, parted = near & far, ~near & ~far
        # an input that cannot pass τ = 0 runs through π
        angle = np.where((far & ~near)[:, None], angle % math.tau, angle)
        closures = np.where(side > 0, 1.0, -1.0)
        upper = np.where(angle > 0, 1.0, -1.0)
        turned = _passed(angle, turning)
        other_range = parted[:, None] & (upper != upper[:, :1])
        other_closure = closures != closures[:, :1]
        crossed = other_closure.any(axis=1) & (closures * upper != (closures * upper)[:, :1]).any(axis=1)
        circuit = np.where(
            turning, np.choose(changes, [other_closure.any(axis=1), False, crossed]), other_range.any(axis=1)
        )
        branch = ~turning & (other_closure & ~other_range).any(axis=1)
        steps = np.diff(turned, axis=1)
        order = ~circuit & ~branch & ~((steps > 0).all(axis=1) | (steps < 0).all(axis=1))
        self.defects = np.column_stack([circuit, branch, order])
        cosine = np.abs(p[:, None] + q[:, None] * np.cos(angle)).max(axis=1)
        for place, half in ((p + q, 0.0), (p - q, math.pi)):
            passed = np.floor((turned[:, 0] - half) / math.tau) != np.floor((turned[:, -1] - half) / math.tau)
            cosine = np.where(passed & ~self.defects.any(axis=1), np.maximum(cosine, np.abs(place)), cosine)
        self.transmission = angle_of(cosine)
        with np.errstate(all="ignore"):
            arm = (poses.origins[0] - self.pin) * np.conj(coupler[:, 0]) / np.abs(coupler[:, 0])
        base = self.pivot.real, self.pivot.imag, r2, r3, arm.real, arm.imag
        rest = (np.angle(held), offset) if sliding else (held.real, held.imag, r4)
        self.rows, self.closures, self.turning = np.stack([*base, *rest], axis=1), closures, turning
        self.size = task.kind.link_lengths(self.rows).max(axis=1)
        self.angles = turned + np.angle(reference)[:, None]

    def merit(self, weight: float) -> Real:
        """Return the costs: of defects first, then of size against the transmission angle by its weight."""
        task, size = self.task, self.task.poses.size
        with np.errstate(all="ignore"):
            sine = np.log(np.sin(self.transmission))
            merit = np.log(self.size / size) - weight * sine
            merit += weight * np.maximum(math.log(math.sin(_USUAL_LEAST)) - sine, 0.0)
            merit -= _TURNING * self.turning
            limits = task.requirements
            margins = limits.margins(task.kind, self.rows).min(axis=1)
            if task.boxes:
                margins = np.minimum(margins, -self._outside(task.kind.pivots(self.rows)))
            allowed = (margins >= -1e-9 * size) & (self.transmission >= limits.angle_to_keep("angle"))
        merit += _DEFECT * self.defects.sum(axis=1)
        return np.asarray(np.where(allowed & np.isfinite(merit), merit, np.inf))

    def _outside(self, pivots: Complex) -> Real:
        """Return how far pivots (k, m) that are not given lie outside the box; of two boxes, one in each."""
        beyond = []
        for x, y, width, height in self.task.boxes:
            sides = x - pivots.real, pivots.real - x - width, y - pivots.imag, pivots.imag - y - height
            beyond.append(np.max(sides, axis=0))
        off = np.stack(beyond)
        if len(off) > 1:
            orders = [np.stack([off[0, :, n], off[1, :, 1 - n]]).max(axis=0) for n in (0, 1)]
            return np.asarray(np.minimum(*orders))
        for pivot in self.task.pivots:
            off = np.where(np.abs(pivots - pivot) <= _ON_CURVE * self.task.poses.size, -np.inf, off)
        return np.asarray(off[0].max(axis=1))

    @property
    def bars(self) -> tuple[Complex, Complex]:
        """Of a single linkage, what a `GuidedLinkage` has as bars."""
        last = self.end if self.task.kind is SLIDER_CRANK else self.held
        return np.array([self.pin[0], self.pivot[0]]), np.array([self.end[0], last[0]])


def _passed(angle: Real, turning: NDArray[np.bool_]) -> Real:
    """Return the crank's angles at the poses in the order of passing, within one turn if it turns fully.

    Of the two senses, the one in which the poses are in order is taken, or else the positive one.
    """
    forth = angle[:, :1] + (angle - angle[:, :1]) % math.tau
    back = angle[:, :1] - (angle[:, :1] - angle) % math.tau
    falling = (np.diff(back, axis=1) < 0).all(axis=1) & ~(np.diff(forth, axis=1) > 0).all(axis=1)
    shorter = (np.diff(back, axis=1) < 0).all(axis=1) & (
        np.abs(back[:, -1] - angle[:, 0]) < np.abs(forth[:, -1] - angle[:, 0])
    )
    turned = np.where((falling | shorter)[:, None], back, forth)
    return np.asarray(np.where(turning[:, None], turned, angle))


def answers(task: GuideTask, count: int = COUNT, weight: float | None = None) -> tuple[GuidedLinkage, ...]:
    """Return the best different linkages, each as the solver runs it; BadInput where there is none.

    `weight` is that of the transmission angle against the size; without it the usual one counts, the
    smallest linkage and the one with the best angle are among the answers, and the one to build comes first:
    the best that can be driven, at 30 degrees at least; the others are in the order of their size.
    """
    ends = _ends(task)
    free = any(choice.free for pair in ends for choice in pair)
    alike = _ALIKE if free else SAME
    linkages: list[GuidedLinkage] = []
    alike_ones: list[GuidedLinkage] = []
    for made in _candidates(task, ends, count, weight):
        earlier, size = [*linkages, *alike_ones], task.poses.size
        if any(_bars_apart(made.bars, other.bars, size) <= alike for other in earlier):
            continue
        one = checked(made)
        if one is not None:
            reads_as_another = free and any(_reads_as(one, other) for other in linkages)
            (alike_ones if reads_as_another else linkages).append(one)
        # without free parameters the linkages come in the order of their defects
        if sum(not one.defects for one in linkages) >= count or (not free and len(linkages) >= count):
            break
    if not linkages:
        raise BadInput(_none_keeps(task, ends))
    # where there are too few, those of other pivots that read as an earlier one fill the list
    ordered = sorted([*linkages, *alike_ones], key=lambda one: len(one.defects))[:count]
    if weight is None:
        sound = [one for one in ordered if len(one.defects) == len(ordered[0].defects)]
        first = next((one for one in sound if is_driven(one.transmission_angle)), ordered[0])
        ordered.sort(key=lambda one: (len(one.defects), one is not first, one.size))
    return tuple(ordered)


def _reads_as(one: GuidedLinkage, other: GuidedLinkage) -> bool:
    """Tell whether two linkages through poses do not differ to a reader in size, angle, defects or crank."""
    figures, its = (Figures(0.0, each.size, each.size, each.transmission_angle) for each in (one, other))
    same = one.defects == other.defects and one.scene.info.full_turn == other.scene.info.full_turn
    return same and not differ(figures, its)


def _none_keeps(task: GuideTask, ends: list[tuple[_EndChoice, _EndChoice]]) -> str:
    """Return why there is no answer, with the limits that the smallest linkage would need."""
    limits = [("the box", "a pin in each box")[len(task.boxes) - 1]] if task.boxes else []
    named = ", ".join([*limits, "the longest link"]) + " and the least transmission angle"
    sizes = [_all_pairs(task, pair).size for pair in ends]
    least = float(np.nanmin([*np.concatenate(sizes), np.inf])) / task.poses.size
    smallest = (
        f"; the longest link is {least:.3g} sizes of the poses at the least" if math.isfinite(least) else ""
    )
    most = task.requirements.largest / task.poses.size
    more = f"{smallest}, {most:g} are allowed" if least > most else "; give it more room"
    return f"no {task.kind.name} through these {task.poses.count} poses keeps to {named}{more}"


def _all_pairs(task: GuideTask, ends: tuple[_EndChoice, _EndChoice]) -> _Linkages:
    return _Linkages(task, *(choice.make(choice.rows) for choice in ends))


def _ends(task: GuideTask) -> list[tuple[_EndChoice, _EndChoice]]:
    """Return for each way to hold the coupler the choices of its crank and of its other end."""
    held = [_bars_at(task, pivot) for pivot in task.pivots]
    if task.kind is SLIDER_CRANK:
        return [(held[0] if held else _bars(task), _slides(task))]
    if len(held) == 2:
        return [(held[0], held[1]), (held[1], held[0])]
    free = _bars(task)
    return [(held[0], free), (free, held[0])] if held else [(free, free)]


_Seed = tuple[tuple[_EndChoice, _EndChoice], tuple[Real, Real], float]
"""A linkage that was tried: the choices at both ends, the parameters of each, and its merit."""


def _candidates(
    task: GuideTask, ends: list[tuple[_EndChoice, _EndChoice]], count: int, weight: float | None
) -> Iterator[_Linkages]:
    """Yield linkages one by one, the best first, with their free parameters improved.

    If no weight is given, the first are the best, the smallest and the one with the best angle.
    """
    many, usual = max(count, COUNT) + _MORE, USUAL_WEIGHT if weight is None else weight
    seeds = [seed for pair in ends for seed in _seeds(task, pair, many, usual)]
    seeds = sorted(seeds, key=lambda seed: seed[2])[:many]
    if any(choice.free for pair in ends for choice in pair):
        kinds = [usual] if weight is not None else [usual, *PREFERENCES.values()]
        seeds = [_followed(task, seed, usual) for seed in seeds] + [
            _followed(task, seed, kind) for kind in kinds[1:] for seed in seeds[:_PREFERRED]
        ]
        made = [_made(task, seed) for seed in seeds]
        merits = {kind: [float(one.merit(kind)[0]) for one in made] for kind in kinds}
        first = [min(range(len(made)), key=merits[kind].__getitem__) for kind in kinds if made]
        rest = sorted(range(len(made)), key=merits[usual].__getitem__)
        yield from (made[n] for n in dict.fromkeys([*first, *rest]))
    else:
        yield from (_made(task, seed) for seed in seeds)


def _seeds(task: GuideTask, ends: tuple[_EndChoice, _EndChoice], count: int, weight: float) -> list[_Seed]:
    """Return the best combinations of sampled ends, with joints well apart from each other's."""
    first, second = ends
    pairs = _all_pairs(task, ends)
    merit = pairs.merit(weight)
    order = np.argsort(merit, kind="stable")[: int(np.isfinite(merit).sum())]
    places = np.stack([pairs.pin, pairs.pivot, pairs.end, pairs.held], axis=1)
    least = _APART * task.poses.size if first.free or second.free else 0.0
    seeds = []
    for number in _apart_ones(places, order, least, count):
        one, other = divmod(number, len(second.rows))
        rows = first.rows[one : one + 1], second.rows[other : other + 1]
        seeds.append((ends, rows, float(merit[number])))
    return seeds


def _apart_ones(places: Complex, order: Indices, least: float, count: int) -> list[int]:
    """Return `count` linkages in the given order, with joints farther than `least` from all earlier ones."""
    picked: list[int] = []
    remaining = order
    while len(remaining) and len(picked) < count:
        picked.append(int(remaining[0]))
        off = np.abs(places[remaining] - places[remaining[0]]).max(axis=1)
        remaining = remaining[off > least] if least else remaining[1:]
    return picked


def _followed(task: GuideTask, seed: _Seed, weight: float) -> _Seed:
    """Return a linkage improved by moving its free parameters in ever shorter steps."""
    ends, rows, _ = seed
    merit, scale = float(_made(task, seed).merit(weight)[0]), 1.0
    for _ in range(_ROUNDS):
        tried = tuple(choice.around(row, scale) for choice, row in zip(ends, rows, strict=True))
        made = (choice.make(some) for choice, some in zip(ends, tried, strict=True))
        merits = _Linkages(task, *made).merit(weight)
        best = int(merits.argmin())
        if merits[best] < merit:
            one, other = divmod(best, len(tried[1]))
            rows, merit = (tried[0][one : one + 1], tried[1][other : other + 1]), float(merits[best])
        else:
            scale *= _NARROWER
    return ends, rows, merit


def _made(task: GuideTask, seed: _Seed) -> _Linkages:
    """Return a linkage whose bars have one length in all poses, and its slider one line, to all digits."""
    (first, second), rows, _ = seed
    crank, end = first.make(rows[0]), second.make(rows[1])
    if isinstance(end, Bars):
        end = polished(task.poses, end, held=second.held)
    else:
        end = straightened(task.poses, complex(end.point[0]))
    return _Linkages(task, polished(task.poses, crank, held=first.held), end)


def followed(
    task: GuideTask, before: GuidedLinkage, moved: tuple[int, complex] | None = None
) -> GuidedLinkage | None:
    """Return the linkage for slightly moved poses that is nearest to the one `before`, or None.

    A free bar keeps its pivot, or its place on the curve of pivots; for five poses it becomes the nearest of
    Burmester's bars. Given pivots replace the nearest ones. `moved` is the number of a joint, 0 or 1, and its
    given place in the first pose, which its pivot follows.
    """
    poses, sliding = task.poses, task.kind is SLIDER_CRANK
    known = [(complex(joint), complex(pivot)) for joint, pivot in before.bars]
    known = _held_by(task.pivots, known[:1] if sliding else known)
    choices = _choices(poses)
    bars = [_nearest_bar(choices, poses, joint, pivot) for joint, pivot in known]
    slides = complex(before.bars[1][0])
    if moved is not None and moved[0] < len(bars):
        bars[moved[0]] = _bar_of(poses, moved[1], known[moved[0]][1])
    elif moved is not None:
        slides = moved[1]
    ends = [_nearest_slide(poses, slides)] if sliding else bars[1:]
    if bars[0] is None or ends[0] is None:
        return None
    return checked(_Linkages(task, bars[0], ends[0]))


def _held_by(pivots: Sequence[complex], bars: list[tuple[complex, complex]]) -> list[tuple[complex, complex]]:
    """Return the bars, with the pivots that are nearest to given ones replaced by these."""
    held, free = list(bars), list(range(len(bars)))
    for pivot in pivots[: len(bars)]:
        nearest = min(free, key=lambda n: abs(bars[n][1] - pivot))
        held[nearest] = bars[nearest][0], pivot
        free.remove(nearest)
    return held


def _bar_of(poses: Poses, joint: complex, pivot: complex) -> Bars | None:
    """Return the bar of a joint in the first pose, its pivot near the former one; None if there is none.

    For two poses the pivot is on the midperpendicular, for three where two of these meet. For four the joint
    is moved to the nearest point of the curve of circle points; for five no joint is free.
    """
    if poses.count == 2:
        first, second = poses.places(joint)
        chord = second - first
        along = 1j * chord / abs(chord) if abs(chord) > SAME * poses.size else 1.0
        middle = (first + second) / 2
        foot = middle + along * ((pivot - middle) * np.conj(along)).real
        return Bars(np.array([joint]), np.array([foot]))
    if poses.count > 4 or (poses.count == 4 and not poses.poles):
        return None
    if poses.count == 4:
        joint = CentreCurve(poses.inverse).nearest(joint)
    bar = Bars(np.array([joint]), centre_points(poses, np.array([joint])))
    return polished(poses, bar) if np.isfinite(bar.centre[0]) else None


def _choices(poses: Poses) -> Bars | CentreCurve | None:
    """Return the possible pivots where they are restricted: Burmester's bars, or the curve; None if free."""
    if poses.count < 4 or not poses.poles:
        return None
    return CentreCurve(poses) if poses.count == 4 else burmester_points(poses)


def _nearest_bar(
    choices: Bars | CentreCurve | None, poses: Poses, joint: complex, pivot: complex
) -> Bars | None:
    """Return the possible bar nearest to a joint in the first pose and a pivot."""
    if isinstance(choices, Bars):
        off = np.abs(choices.circle - joint) + np.abs(choices.centre - pivot)
        return choices.take(np.array([off.argmin()])) if len(off) else None
    if poses.count == 2:
        one, other = poses.images(pivot)
        chord = other - one
        along = 1j * chord / abs(chord) if abs(chord) > SAME * poses.size else 0.0
        middle = (one + other) / 2 if along else joint
        foot = middle + along * ((joint - middle) * np.conj(along)).real
        return Bars(np.array([foot]), np.array([pivot]))
    if choices is not None:
        pivot = choices.nearest(pivot)
    bar = Bars(circle_points(poses, np.array([pivot])), np.array([pivot]))
    held = choices is None and poses.count == 3
    return polished(poses, bar, held=held) if np.isfinite(bar.circle[0]) else None


def _nearest_slide(poses: Poses, joint: complex) -> Slides | None:
    """Return the sliding point that is nearest to a joint in the first pose."""
    if poses.count > 3 or not poses.poles:
        slide = ball_point(poses)
        return slide if len(slide.point) else None
    if poses.count == 2:
        return slides_through(poses, np.array([joint]))
    ring = slide_points(poses, np.linspace(0.0, math.tau, _FINEST, endpoint=False))
    if not np.isfinite(ring).any():
        return None
    middle = ring.mean()
    nearest = complex(ring[np.nanargmin(np.abs(ring - joint))])
    # on the circle to the last digit; a straight line's samples lie close enough
    radius = abs(nearest - middle)
    on_circle = np.ptp(np.abs(ring - middle)) <= SAME * radius
    place = middle + radius * (joint - middle) / abs(joint - middle) if on_circle else nearest
    return slides_through(poses, np.array([place]))


def checked(made: _Linkages) -> GuidedLinkage | None:
    """Return a linkage with rounded parameters as the solver runs it; None where it does not assemble."""
    task, kind = made.task, made.task.kind
    row = _written(task, made.rows[0])
    closures, angles = made.closures[0], made.angles[0]
    lean = cmath.phase(made.end[0] - made.pin[0]) - float(task.poses.angles[0])
    try:
        scene = _scene(task, row, closures[0], angles)
        phases, off = _met(task, scene, angles, lean)
        defects = _defects(scene, phases, off <= _MET * task.poses.size)
        for pose in np.flatnonzero(off > _MET * task.poses.size):
            # the pose is passed only after the linkage was taken apart and assembled the other way
            other = _scene(task, row, closures[pose], angles[[pose, pose]])
            off[pose] = _met(task, other, angles, lean)[1][pose]
    except (AssemblyError, SceneError):
        return None
    return GuidedLinkage(
        scene=scene,
        parameters=parameters_of(kind, row),
        closure=kind.sides[int(closures[0] < 0)],
        angles=angles,
        phases=phases,
        lean=lean,
        bars=made.bars,
        error=float(off.max()),
        defects=defects,
        transmission_angle=float(made.transmission[0]),
        size=float(made.size[0]),
        task=task,
    )


def _written(task: GuideTask, row: Real) -> Real:
    """Return parameters rounded to 1e-15 of the poses' size: equal inputs give equal files.

    Given pivots are exactly where they were given, without rounding.
    """
    size, row = task.poses.size, row.copy()
    for x in task.kind.pins:
        for pivot in task.pivots:
            if abs(complex(row[x], row[x + 1]) - pivot) < _GIVEN * size:
                row[x : x + 2] = pivot.real, pivot.imag
    places = _DIGITS - math.floor(math.log10(size))
    return np.array(
        [
            round(float(value), 16 if name == "line_angle" else places) + 0.0
            for name, value in zip(task.kind.parameters, row, strict=True)
        ]
    )


def _scene(task: GuideTask, row: Real, closure: float, angles: Real) -> Scene:
    title = f"{task.kind.name.capitalize()} through {task.poses.count} poses"
    stated = {"title": title, "source": task.source, "length_unit": task.unit}
    start = float(angles[0]), float(angles[-1] - angles[0])
    document = document_of(task.kind, row, float(closure), start, **stated)
    rows = zip(task.poses.origins.tolist(), task.poses.angles.tolist(), strict=True)
    document["guide"] = _stated(((place.real, place.imag, angle) for place, angle in rows), task.unit)
    return scene_from(document, name=task.name, where=task.name)


def _stated(poses: Iterable[Sequence[float]], unit: str) -> dict[str, object]:
    """Return poses, rows of x, y and angle (rad), as the scene's file keeps them."""
    return {
        "poses": [
            [f"{x!r} {unit}", f"{y!r} {unit}", f"{round(math.degrees(angle), 12)!r} deg"]
            for x, y, angle in poses
        ]
    }


def _met(task: GuideTask, scene: Scene, angles: Real, lean: float) -> tuple[Real, Real]:
    """Return the phases at which a linkage is nearest to each pose, and its distances from the poses.

    They are chosen among the phases at which the crank has a pose's angle, on the way there or back, in any
    turn of a true period. Near a limit, where the angle does not determine the phase well, Newton's steps
    improve them.
    """
    turns = math.tau * np.arange(round(scene.period / math.tau))
    home = np.array([phase_along(scene, 0.0, cmath.exp(1j * angle)) for angle in angles])[:, None]
    tried = home + turns if scene.info.full_turn else np.hstack([home + turns, turns - home])
    off = _off(task, scene, tried, lean)
    if off.min(axis=1).max() > _EXACT * task.poses.size:
        origins = np.broadcast_to(task.poses.origins[:, None], tried.shape)
        nearer = _nearer(scene, origins.ravel(), tried.ravel()).reshape(tried.shape)
        tried, off = np.hstack([tried, nearer]), np.hstack([off, _off(task, scene, nearer, lean)])
    best = off.argmin(axis=1)[:, None]
    phases, off = (np.take_along_axis(part, best, axis=1)[:, 0] for part in (tried, off))
    return phases % scene.period, off


def _nearer(scene: Scene, points: Complex, phases: Real) -> Real:
    """Return phases at which the coupler point is nearer to points, by a step of Newton's."""
    motion = scene.solve(phase=phases, speed=1.0, derivatives=1)
    rate = as_complex(motion.velocity["P"])
    with np.errstate(all="ignore"):
        step = (np.conj(rate) * (points - as_complex(motion.position["P"]))).real / np.abs(rate) ** 2
    return np.asarray(phases + np.clip(np.nan_to_num(step), -_STEP, _STEP))


def _off(task: GuideTask, scene: Scene, phases: Real, lean: float) -> Real:
    """Return the coupler's distance from each pose at phases (n, k): the larger of those of `error`."""
    motion, poses = scene.solve(phase=phases.ravel(), derivatives=0), task.poses
    away = as_complex(motion.position["P"]).reshape(phases.shape) - poses.origins[:, None]
    angles = np.asarray(motion.angle[task.kind.links[1]]).reshape(phases.shape)
    turned = (angles - lean - poses.angles[:, None] + math.pi) % math.tau - math.pi
    return np.asarray(np.maximum(np.abs(away), poses.size * np.abs(turned)))


def _defects(scene: Scene, phases: Real, met: NDArray[np.bool_]) -> tuple[str, ...]:
    """Return the defects of a linkage by its poses' phases, and which poses it passes on its circuit."""
    defects = [] if met.all() else ["circuit"]
    if scene.info.full_turn:
        forth = (phases - phases[0]) % scene.period
        back = -((-forth) % scene.period)
    else:
        if len(set((phases[met] // math.pi).tolist())) > 1:
            defects.append("branch")
        forth = back = phases
    if not defects and not ((np.diff(forth) > 0).all() or (np.diff(back) < 0).all()):
        defects.append("order")
    return tuple(defects)


def apart(one: GuidedLinkage, other: GuidedLinkage) -> float:
    """Return how far the joints of two linkages lie apart in the first pose, in the poses' sizes.

    Which of two bars drives does not count.
    """
    return _bars_apart(one.bars, other.bars, one.task.poses.size)


def _bars_apart(one: tuple[Complex, Complex], other: tuple[Complex, Complex], size: float) -> float:
    (first, second), (third, fourth) = one, other
    straight = max(abs(first - third).max(), abs(second - fourth).max())
    crossed = max(abs(first - fourth).max(), abs(second - third).max())
    return float(min(straight, crossed) / size)


# An answer as plain numbers for another process or a tape, and back to a scene.

POSE_NUMBERS = 16
"""How many numbers an answer has."""
_MOST_PARAMETERS = 9


class PoseAnswer(NamedTuple):
    """A linkage through poses: whether it slides, its closure (±1), its crank's first angle and sense (±1).

    `defects` has a bit for each of `DEFECTS`; `transmission` is the least transmission angle (rad), `size`
    the longest link; `row` are the parameters, filled up with zeros.
    """

    sliding: float
    closure: float
    start: float
    sense: float
    defects: float
    transmission: float
    size: float
    row: tuple[float, ...]

    @property
    def numbers(self) -> tuple[float, ...]:
        """The whole answer as one row of numbers."""
        return (*self[:7], *self.row)

    @property
    def kind(self) -> LinkageKind:
        """What its parameters are."""
        return KINDS["slider-crank" if self.sliding else "four-bar"]

    @property
    def named_defects(self) -> tuple[str, ...]:
        """The names of its defects."""
        return tuple(name for n, name in enumerate(DEFECTS) if int(self.defects) >> n & 1)

    @property
    def joints(self) -> dict[str, complex]:
        """Its joints in the first pose."""
        names = ("O2", "A", "B", "P") if self.sliding else ("O2", "O4", "A", "B", "P")
        row = np.array([self.row[: len(self.kind.parameters)]])
        places = self.kind.joints(row, np.array([self.closure]), np.array([[self.start]]))[0]
        return dict(zip(names, places.tolist(), strict=True))

    def scene(self, unit: str, poses: Iterable[Sequence[float]], goal: Scene | None = None) -> Scene:
        """Return the linkage as a scene, or as a step towards `goal`; errors as of a scene file."""
        stated = {"source": "made by linkanim for poses set in the window", "length_unit": unit}
        rows = list(poses)
        stated["title"] = f"{self.kind.name.capitalize()} through {len(rows)} poses"
        row, start = self.row[: len(self.kind.parameters)], (self.start, self.sense)
        document = document_of(self.kind, row, self.closure, start, **stated)
        document["guide"] = _stated(rows, unit)
        return scene_from(document, name=POSES_NAME, where=POSES_NAME, goal=goal)


POSES_NAME = "poses"
"""The name of a scene that was made in the window for poses."""


def pose_answer_of(one: GuidedLinkage) -> PoseAnswer:
    """Return an answer as plain numbers."""
    row = [float(value) for value in one.row]
    bits = sum(1 << n for n, name in enumerate(DEFECTS) if name in one.defects)
    return PoseAnswer(
        float(one.kind is SLIDER_CRANK),
        one.closure_sign,
        float(one.angles[0]),
        one.sense,
        float(bits),
        one.transmission_angle,
        one.size,
        tuple(row + [0.0] * (_MOST_PARAMETERS - len(row))),
    )


def pose_answer_from(numbers: tuple[float, ...]) -> PoseAnswer:
    """Return the answer whose `numbers` these are."""
    sliding, closure, start, sense, defects, transmission, size, *row = numbers
    return PoseAnswer(sliding, closure, start, sense, defects, transmission, size, tuple(row))
