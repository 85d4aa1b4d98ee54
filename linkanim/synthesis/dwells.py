"""`linkanim.dwell`: six-bars whose output stands still while the crank turns on.

The coupler point P of a four-bar runs along an arc of a circle for part of the turn. A rod as long as that
circle's radius leads from P to the output's pin D, which lies at the circle's centre meanwhile, and so rests
(Hain, Applied Kinematics; Norton, Design of Machinery, 3.9: a Stephenson six-bar). The arcs are those of the
atlas of coupler curves. The output's pivot, or the direction of its line, is chosen for good transmission
angles; the swing is met by the length of the rocker, and the stroke by the size of the whole.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import field
from typing import Any, NamedTuple

import numpy as np

from linkanim import units
from linkanim.bounds import can_be_computed
from linkanim.errors import AssemblyError, BadInput, SceneError
from linkanim.frozen import frozen
from linkanim.mechanics.search import highest
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.synthesis.answers import Figures, parameters_of
from linkanim.synthesis.atlas import atlas
from linkanim.synthesis.front import cost, differ, led
from linkanim.synthesis.linkages import FOUR_BAR, SLIDER_CRANK, Complex, LinkageKind, Real, refuse_count

COUNT = 5
LONGEST = 100.0
"""The longest link where only angles are given."""
LEAST_ANGLE = math.radians(30)
_REST = math.radians(20), math.radians(240)
_SWING = math.radians(2), math.radians(120)
_POSES, _AT_ONCE = 120, 2_000
"""The poses of each coupler curve in which arcs are searched for, and the curves searched at once."""
_ARCS = 160
"""The arcs to which outputs are added."""
_RADIUS, _REACHED = (0.25, 3.0), 0.25
"""An arc's radii, and how far P goes from its circle: in the distance of P from the middle of its curve."""
_RESTING, _MOVING = 31, 61
"""The poses of a whole turn at which outputs are compared: at rest, and else."""
_AROUND = np.linspace(-math.pi, math.pi, 36, endpoint=False)
_ARMS = np.geomspace(0.5, 4.0, 14)
"""Directions of the output's pivot or line, and rockers, in those that a straight way of D would take."""
_KEPT, _MORE = 3, 12
"""The outputs of an arc, and of each answer, that are looked at closely."""
_LOOKED_AT = 361
_WEIGHED = 16
"""How often the points of an arc are weighed anew."""
_ROUNDS, _EXACT, _SEEN = 40, 1e-14, 1e-4
"""Steps towards a swing, how near they get (rad), and how near the solver's poses show it, as a share."""
_DIGITS = 12


@frozen(eq=False)
class Dwell:
    """A six-bar with a dwell; lengths in the scene's unit, angles in radians."""

    scene: Scene = field(repr=False)
    kind: str
    """What its output is: "rocker" or "slider"."""
    parameters: Mapping[str, float]
    rest: float
    """How far the crank turns meanwhile, from the start."""
    deviation: float
    """How far the output strays to either side of its middle place at rest: an angle, or a length."""
    output: float
    """The whole swing (rad) or stroke of the output."""
    transmission_angle: float
    """The least one of both dyads over the turn."""
    size: float
    """The longest link."""
    figures: Figures
    """The figures by which it is compared with others; the size in ways of P, or in strokes."""

    @property
    def class_name(self) -> str:
        """The linkage's class, in words."""
        return self.scene.info.class_name


class _Arc(NamedTuple):
    """A four-bar, the crank's angle where its arc begins, and the arc's centre and radius."""

    row: Real
    start: float
    centre: complex
    radius: float

    def path(self, turned: Real) -> Complex:
        """Return the coupler point (n,) when the crank has turned by angles from the start."""
        return np.asarray(FOUR_BAR.points(self.row[None], np.ones(1), self.start + turned[None])[0])

    def levelled(self, points: Complex) -> _Arc:
        """Return the arc with its largest distance from points small, by Lawson's weights (1961)."""
        weights, best = np.ones(len(points)), (math.inf, self)
        for _ in range(_WEIGHED):
            root = np.sqrt(weights)[:, None]
            sides = np.stack([2 * points.real, 2 * points.imag, np.ones(len(points))], axis=1)
            a, b, _ = np.linalg.lstsq(root * sides, root[:, 0] * np.abs(points) ** 2)[0].tolist()
            away = np.abs(points - complex(a, b))
            radius = float(away.min() + away.max()) / 2
            off = np.abs(away - radius)
            best = min(
                best,
                (float(off.max()), self._replace(centre=complex(a, b), radius=radius)),
                key=lambda one: one[0],
            )
            weights = weights * off / off.mean()
        return best[1]

    def rows(self, kind: LinkageKind, ways: Complex, arms: Real) -> Real:
        """Return dyads (k, p) by the parameters of their kind, of which those of a crank are 0."""
        rows = np.zeros((len(ways), len(kind.parameters)))
        rows[:, 3] = self.radius
        if kind is FOUR_BAR:
            pivots = self.centre + arms * ways
            rows[:, 6:] = np.stack([pivots.real, pivots.imag, arms], axis=1)
        else:
            rows[:, 6:] = np.stack([np.angle(ways), (self.centre / ways).imag], axis=1)
        return rows

    def closures(self, kind: LinkageKind, rows: Real) -> Real:
        """Return the closures of dyads (k, p) at rest."""
        rod = self.centre - complex(self.path(np.zeros(1))[0])
        if kind is FOUR_BAR:
            towards = rows[:, 6] + 1j * rows[:, 7] - self.centre + rod
            return np.where((np.conj(towards) * rod).imag > 0, 1.0, -1.0)
        return np.where((rod * np.exp(-1j * rows[:, 6])).real > 0, 1.0, -1.0)

    def moved(self, kind: LinkageKind, rows: Real, path: Complex) -> tuple[Real, Real]:
        """Return the outputs' ways (k, n) from their places at rest, and cos μ; NaN where none closes."""
        closed = kind.close(
            rows, self.closures(kind, rows)[:, None], np.broadcast_to(path, (len(rows), path.shape[1]))
        )
        direction, normal, _ = closed
        cosine = (np.conj(direction) * normal).real / np.abs(normal)
        if kind is FOUR_BAR:
            rest = self.centre - (rows[:, 6:7] + 1j * rows[:, 7:8])
            return np.angle(normal / rest), cosine
        ends = path + self.radius * direction - self.centre
        return (ends * np.exp(-1j * rows[:, 6:7])).real, cosine

    def sliders(self) -> Iterator[_Dyad]:
        """Yield sliders along lines in all directions."""
        return (_Dyad(self, SLIDER_CRANK, complex(way), 0.0) for way in np.exp(1j * _AROUND))

    def rockers(self, path: Complex, swing: float) -> Iterator[_Dyad]:
        """Yield rockers with pivots in all directions, of two lengths: one swings further, one less."""
        straight = float(np.abs(np.abs(path - self.centre) - self.radius).max()) / (2 * math.sin(swing / 2))
        ways, arms = np.exp(1j * _AROUND), straight * _ARMS
        rows = self.rows(FOUR_BAR, np.repeat(ways, len(arms)), np.tile(arms, len(ways)))
        whole = np.ptp(self.moved(FOUR_BAR, rows, path[None])[0], axis=1).reshape(len(ways), len(arms))
        for way, n in np.argwhere((whole[:, :-1] >= swing) & (whole[:, 1:] < swing)):
            yield _Dyad(self, FOUR_BAR, complex(ways[way]), float(arms[n]), float(arms[n + 1]))


class _Dyad(NamedTuple):
    """A rod from an arc's coupler point to an output whose pin stands at the arc's centre at rest.

    `way` points from there to the rocker's pivot, or along the slider's line; a rocker's length is `arm`.
    """

    arc: _Arc
    kind: LinkageKind
    way: complex
    arm: float
    longer: float = 0.0
    """A rocker that is too long."""

    @property
    def row(self) -> Real:
        """The rod and the output by the parameters of their kind, of which those of a crank are 0."""
        return np.asarray(self.arc.rows(self.kind, np.array([self.way]), np.array([self.arm]))[0])

    @property
    def closure(self) -> float:
        """The closure at rest, at which it stays."""
        return float(self.arc.closures(self.kind, self.row[None])[0])

    def output(self, turned: Real) -> Real:
        """Return how far the output is from its place at rest (n,): an angle (rad), or a length."""
        path = self.arc.path(turned)[None]
        return np.asarray(self.arc.moved(self.kind, self.row[None], path)[0][0])

    def range(self) -> tuple[float, float]:
        """Return the least and the greatest of that over the turn."""
        turned = np.linspace(0.0, math.tau, _LOOKED_AT)
        output = self.output(turned)
        low = highest(lambda at: -self.output(at), float(turned[output.argmin()]), 2 * turned[1])
        high = highest(self.output, float(turned[output.argmax()]), 2 * turned[1])
        least, most = self.output(np.array([low, high])).tolist()
        return least, most

    def met(self, swing: float) -> _Dyad:
        """Return a rocker between its two lengths that swings as asked for."""

        def off(arm: float) -> float:
            low, high = self._replace(arm=arm).range()
            return high - low - swing

        low, high = self.arm, self.longer
        over, under = off(low), off(high)
        for _ in range(_ROUNDS):
            # false position, with the weight of an end that stays halved (Illinois)
            arm = (low * under - high * over) / (under - over)
            value = off(arm)
            if abs(value) <= _EXACT or high - low <= _EXACT * high:
                break
            if value > 0:
                low, over, under = arm, value, under / 2
            else:
                high, under, over = arm, value, over / 2
        return self._replace(arm=arm)

    def made(
        self, rest: float, swing: float | None, stroke: float | None, stated: Mapping[str, str], name: str
    ) -> Dwell | None:
        """Return the six-bar as the solver runs it; None where that refuses it."""
        low, high = self.range()
        if not math.isfinite(high - low):
            return None
        own = FOUR_BAR.link_lengths(self.arc.row[None])[0]
        longest = max(float(own.max()), self.arc.radius, self.arm)
        scale = LONGEST / longest if stroke is None else stroke / (high - low)
        document, parameters = self._document(scale, stated, rest)
        try:
            scene = scene_from(document, name=name, where=name)
        except (AssemblyError, SceneError):
            return None
        if not scene.info.full_turn:
            return None
        start = scene.linkage.drive.start
        sliding = swing is None

        def output(turned: Real) -> Real:
            motion = scene.solve(angle=start + turned, derivatives=0)
            return np.asarray(motion.travel["slider"] if sliding else np.unwrap(motion.angle["output"]))

        rested = output(np.linspace(0.0, rest, _LOOKED_AT))
        turned = output(np.linspace(0.0, math.tau, 2 * _LOOKED_AT))
        known = scene.info.transmission
        assert known is not None
        angle = known.least
        whole = (high - low) * (scale if sliding else 1.0)
        if not abs(np.ptp(turned) - whole) <= _SEEN * whole:
            return None
        deviation = float(np.ptp(rested) / 2)
        curve = self.arc.path(np.linspace(0.0, math.tau, _LOOKED_AT))
        size = (
            longest / float(np.abs(curve - curve.mean()).max())
            if stroke is None
            else longest * scale / stroke
        )
        return Dwell(
            scene=scene,
            kind="slider" if sliding else "rocker",
            parameters=parameters,
            rest=rest,
            deviation=deviation,
            output=whole,
            transmission_angle=angle,
            size=longest * scale,
            figures=Figures(deviation / whole, size, size, angle),
        )

    def _document(
        self, scale: float, stated: Mapping[str, str], rest: float
    ) -> tuple[dict[str, Any], dict[str, float]]:
        """Return a six-bar's document, and its parameters by name."""
        arc, places = self.arc, _DIGITS - math.floor(math.log10(scale * self.arc.radius))
        row = [round(float(value), places) + 0.0 for value in arc.row * scale]
        whole = parameters_of(FOUR_BAR, row)
        document = FOUR_BAR.document(whole, 1.0)
        side = self.kind.sides[self.closure < 0]
        rod = round(arc.radius * scale, places)
        if self.kind is FOUR_BAR:
            x, y, arm = (round(float(value), places) + 0.0 for value in self.row[6:] * scale)
            document["ground"]["O6"] = [x, y]
            document["joints"]["D"] = {"from": ["P", "O6"], "length": [rod, arm], "side": side}
            output: dict[str, Any] = {"output": {"joints": ["O6", "D"]}}
            more = {"x6": x, "y6": y, "rod": rod, "output": arm}
        else:
            angle, offset = float(self.row[6]), round(float(self.row[7]) * scale, places) + 0.0
            line = {"through": "O2", "angle": f"{angle!r} rad", "offset": offset}
            document["joints"]["D"] = {"from": "P", "length": rod, "line": line, "side": side}
            output = {"slider": {"slider": "D"}}
            more = {"rod": rod, "line_angle": angle, "offset": offset}
        return {
            "title": f"Six-bar that rests for {math.degrees(rest):.4g}°",
            **stated,
            "drive": {"joint": "A", "speed": "20 rpm", "start": f"{math.degrees(arc.start) % 360!r} deg"},
            **document,
            "bodies": {**document["bodies"], "rod": {"joints": ["P", "D"]}, **output},
            "trace": {"joints": ["P", "D"]},
        }, whole | more


def dwell(
    *,
    rest: float,
    swing: float | None = None,
    stroke: float | None = None,
    count: int = COUNT,
    least_angle: float = LEAST_ANGLE,
    unit: str = "mm",
    name: str = "dwell",
    source: str = "made by linkanim for a dwell",
) -> tuple[Dwell, ...]:
    """Return six-bars whose output rests while the crank turns by `rest` (rad), the one to build first.

    For a rocker give its whole `swing` (rad), for a slider its `stroke`. The transmission angles of both
    dyads are `least_angle` (rad) at least. The others differ to a reader, those that rest best first.
    BadInput for numbers that make no sense, and if no linkage of the atlas does it.
    """
    units.metre(unit)
    refuse_count(count)
    if not _REST[0] <= rest <= _REST[1]:
        low, high = (math.degrees(end) for end in _REST)
        raise BadInput(f"a rest of {math.degrees(rest):g} deg: give {low:g} to {high:g} deg of the crank")
    if (swing is None) == (stroke is None):
        raise BadInput("give the swing of a rocker, such as 40 deg, or the stroke of a slider, such as 50")
    if swing is not None and not _SWING[0] <= swing <= _SWING[1]:
        low, high = (math.degrees(end) for end in _SWING)
        raise BadInput(
            f"a swing of {math.degrees(swing):g} deg: a rocker with a dwell swings by {low:g} to {high:g} deg"
        )
    if stroke is not None and not (can_be_computed(stroke) and stroke > 0):
        raise BadInput(f"a stroke of {stroke:g}: give a length above zero")
    if not 0 <= least_angle < math.pi / 2:
        raise BadInput(f"a least transmission angle of {math.degrees(least_angle):g} deg: give 0 to 90 deg")
    stated = {"length_unit": unit, "source": source}
    dyads = sorted(_dyads(rest, swing, least_angle), key=lambda pair: pair[0])
    answers = list[Dwell]()
    for _, dyad in dyads[: _MORE * count]:
        met = dyad if swing is None else dyad.met(swing)
        one = met.made(rest, swing, stroke, stated, name)
        if (
            one
            and one.transmission_angle >= least_angle
            and all(differ(one.figures, other.figures) for other in answers)
        ):
            answers.append(one)
        if len(answers) == count:
            break
    if not answers:
        wanted = f"swings by {math.degrees(swing):g} deg" if swing else "slides"
        raise BadInput(
            f"no six-bar {wanted} and rests for {math.degrees(rest):g} deg of the crank at transmission "
            f"angles of {math.degrees(least_angle):g} deg; ask for a shorter rest, or a smaller least angle"
        )
    answers.sort(key=lambda one: one.figures.deviation)
    return tuple(led([one.figures for one in answers], answers))


def _arcs(rest: float, least_angle: float) -> Iterator[tuple[float, _Arc]]:
    """Yield the arcs of all curves of the atlas, one of each, with their deviation in ways of D."""
    rows = atlas(FOUR_BAR).rows
    rows = rows[(FOUR_BAR.margins(rows, least_angle) > 0).all(axis=1)]
    angles = np.arange(_POSES) * (math.tau / _POSES)
    wide = math.ceil(rest / angles[1]) + 1
    for some in np.array_split(rows, -(-len(rows) // _AT_ONCE)):
        points = FOUR_BAR.points(some, np.ones(len(some)), np.broadcast_to(angles, (len(some), _POSES)))
        middle = points.mean(axis=1, keepdims=True)
        size = np.abs(points - middle).max(axis=1, keepdims=True)
        centre, radius, off = _circles((points - middle) / size, wide)
        off = np.where((radius > _RADIUS[0]) & (radius < _RADIUS[1]), off, np.inf)
        best = off.argmin(axis=1)[:, None]
        centre = np.take_along_axis(centre, best, axis=1)
        radius, off = (np.take_along_axis(part, best, axis=1) for part in (radius, off))
        reached = np.abs(np.abs((points - middle) / size - centre) - radius).max(axis=1)
        for n in np.flatnonzero((reached > _REACHED) & np.isfinite(off[:, 0])):
            at, length = complex((middle + size * centre)[n, 0]), float((size * radius)[n, 0])
            yield float(off[n, 0] / reached[n]), _Arc(some[n], float(angles[best[n, 0]]), at, length)


def _circles(points: Complex, wide: int) -> tuple[Complex, Real, Real]:
    """Return the circle through each run of so many points (J, n) of closed curves, and how far it is off.

    It has the least sum of squares of x² + y² - 2ax - 2by - c (Kåsa, 1976).
    """
    x, y = points.real, points.imag

    def summed(values: Real) -> Real:
        sums = np.cumsum(
            np.concatenate([np.zeros_like(values[:, :1]), values, values[:, : wide - 1]], axis=1), axis=1
        )
        return np.asarray(sums[:, wide:] - sums[:, :-wide])

    z = x * x + y * y
    sums = [summed(part) for part in (x, y, z)]
    means = [part / wide for part in sums]
    pairs = {
        (i, j): summed(a * b) - sums[i] * means[j]
        for i, a in enumerate((x, y, z))
        for j, b in enumerate((x, y, z))
        if i <= j
    }
    det = pairs[0, 0] * pairs[1, 1] - pairs[0, 1] ** 2
    with np.errstate(all="ignore"):
        a = (pairs[0, 2] * pairs[1, 1] - pairs[1, 2] * pairs[0, 1]) / det
        b = (pairs[1, 2] * pairs[0, 0] - pairs[0, 2] * pairs[0, 1]) / det
        variance = np.maximum(pairs[2, 2] - a * pairs[0, 2] - b * pairs[1, 2], 0.0) / wide
        radius = np.sqrt(means[2] - a * means[0] - b * means[1] + (a * a + b * b) / 4)
        return np.asarray((a + 1j * b) / 2), radius, np.sqrt(variance) / (2 * radius)


def _dyads(rest: float, swing: float | None, least_angle: float) -> Iterator[tuple[float, _Dyad]]:
    """Yield dyads on the best arcs, a few of each, with the cost of their figures, as some poses tell it."""
    turned = np.concatenate(
        [np.linspace(0, rest, _RESTING), np.linspace(rest, math.tau, _MOVING, endpoint=False)[1:]]
    )
    for _, rough in sorted(_arcs(rest, least_angle), key=lambda pair: pair[0])[:_ARCS]:
        path = rough.path(turned)
        arc = rough.levelled(path[:_RESTING])
        dyads = [*(arc.sliders() if swing is None else arc.rockers(path, swing))]
        if not dyads:
            continue
        kind = dyads[0].kind
        rows = np.array([dyad.row for dyad in dyads])
        output, cosine = arc.moved(kind, rows, path[None])
        whole, rested = np.ptp(output, axis=1), np.ptp(output[:, :_RESTING], axis=1) / 2
        with np.errstate(invalid="ignore"):
            angle = np.arccos(np.abs(cosine).max(axis=1))
        own = float(FOUR_BAR.link_lengths(arc.row[None]).max())
        unit = whole if swing is None else np.full(len(rows), np.abs(path - path.mean()).max())
        size = np.maximum(kind.link_lengths(rows)[:, 1:].max(axis=1), own) / unit
        sound = np.flatnonzero(angle >= least_angle)
        figures = [Figures(rested[n] / whole[n], size[n], size[n], angle[n]) for n in sound]
        costs = [(cost(one), n) for one, n in zip(figures, sound, strict=True)]
        yield from ((value, dyads[n]) for value, n in sorted(costs)[:_KEPT])
