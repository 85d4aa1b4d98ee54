"""Mark motion: curves of traced joints, the input's arrow, velocity and acceleration arrows.

A whole trace stands still, and its recent part follows the phase. The input's arrow bends as the driven bar
turns, and is straight where a slider is driven.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property, lru_cache
from itertools import accumulate, pairwise
from math import ceil, floor, pi, tau
from typing import Any, Literal, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.measures import components, line_direction, loaded
from linkanim.mechanics.motion import Motion, Pose
from linkanim.mechanics.quantities import force_order, indexed, link_labels
from linkanim.mechanics.reactions import GROUND, guided
from linkanim.picture.figure import DrawContext, Figure
from linkanim.picture.layout import Gauge, Layout
from linkanim.picture.look import ACCELERATION, FORCE, VELOCITY, Look
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import (
    Places,
    arrows,
    dashes,
    directions,
    joined,
    lengths,
    offsets,
    stroke,
    strokes,
    unit,
)
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import View

# Curves of the traced joints: the whole curve stands still, its recent part follows the phase.

RECENT = 0.3 * 2 * pi
"""How much phase the recent part covers."""
_SHADES = 10
_ORDER = (0, *(shade + step for shade in range(1, _SHADES - 1, 2) for step in (1, 0)), _SHADES - 1)
"""The order in which shades are painted: the oldest first, but odd ones after both neighbours."""
SWELL = 1.7
"""The width of the recent part at its end, in widths of the whole curve."""
_FAINT, _FAINTER = 0.5, 0.62
"""The share of the background in the whole curve's colour."""
_NEAR, _LONGEST_RUN = 0.01, 16
"""A straight piece may replace points that lie this near to it, in pixels, and this many at the most."""


@frozen
class Trace:
    """The curve of one joint in pixels, at equal steps of phase over one true period."""

    joint: str
    path: Loop
    period: float
    colour: Colour
    back: Colour
    width: float

    @cached_property
    def shades(self) -> tuple[Colour, ...]:
        """The colours of the recent part, from the oldest on."""
        return tuple(mixed(self.back, self.colour, shade / _SHADES) for shade in range(1, _SHADES + 1))

    def whole(self) -> Layer:
        """Return the whole curve."""
        return Layer(self.back, stroke(self.path, self.width, closed=True))

    def recent(self, phase: float, place: complex, *, forward: bool) -> list[Layer]:
        """Return the part of the curve that the joint, now at `place`, has just passed, brightest there."""
        count = len(self.path)
        here = phase / self.period * count
        tail = max(round(RECENT / self.period * count), _SHADES)
        # a motion that runs backwards passes through the curve from its end
        last, share = (floor(here), here % 1) if forward else (-ceil(here) - 1, -here % 1)
        first = (last - tail) % count
        (path, side, corner), (cuts, needed) = self._courses[not forward], _cuts(tail + 2)
        taken = np.flatnonzero(corner[first : first + tail + 2] | needed)
        path, side = path.take(first + taken), side.take(first + taken)
        path[-1], side[-1] = place, (1 - share) * side[-2] + share * side[-1]
        side *= _swelling(tail + 2, self.width).take(taken)
        ends = np.searchsorted(taken, cuts).tolist()
        return list(self._shaded(path - side, path + side, ends))

    def _shaded(self, right: Loop, left: Loop, ends: list[int]) -> Iterator[Layer]:
        """Yield the area between two edges in its shades; every other shade extends below its neighbours.

        So only a few shades overlap. Where the curve crosses itself, the younger part is still on top.
        """
        for shade in _ORDER:
            under = 1 - shade % 2
            part = slice(max(ends[shade] - under, 0), ends[shade + 1] + 1 + under)
            yield Layer(self.shades[shade], [np.concatenate((right[part], left[part][::-1]))])

    @cached_property
    def _courses(self) -> tuple[_Course, _Course]:
        """Two rounds of the path, and two the other way."""
        side = sides_of(self.path)
        corner = _corners(np.stack([self.path + half * side for half in (self.width, -self.width)]))
        path, side, corner = np.tile(self.path, 2), np.tile(side, 2), np.tile(corner, 2)
        return (path, side, corner), (path[::-1], -side[::-1], corner[::-1])


_Course = tuple[Loop, Loop, NDArray[np.bool_]]
"""A curve's points, the vector from each to the left edge of a line 2 wide, and which are corners."""


@lru_cache(maxsize=16)
def _swelling(count: int, width: float) -> NDArray[np.float64]:
    """Return half the width of a recent part at each of its points."""
    return np.asarray(width / 2 * (1 + (SWELL - 1) / (count - 1) * np.arange(count)), np.float64)


@lru_cache(maxsize=16)
def _cuts(count: int) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Return where a part of so many points is cut into shades, its end included, and the points needed.

    These are the points at the cuts, those before and after, which two shades share, and the last two.
    """
    cuts = np.array([round(count * shade / _SHADES) for shade in range(_SHADES + 1)])
    needed = np.zeros(count, np.bool_)
    needed[np.clip((cuts - 1, cuts, cuts + 1), 0, count - 1)] = True
    needed[-2:] = True
    return cuts, needed


def sides_of(path: Loop) -> Loop:
    """Return the vectors from a closed path to the left edge of a line 2 wide; all 0 for a single place."""
    moved = path != np.roll(path, 1)
    points = path[moved]
    if not points.size:
        return np.zeros_like(path)
    sides = offsets(np.concatenate((points[-1:], points, points[:1])))[1:-1]
    chosen: Loop = sides[np.cumsum(moved) - 1]
    return chosen


def _corners(edges: Loop) -> NDArray[np.bool_]:
    """Return which points of closed lines (n, points) are needed so that straight pieces still fit them.

    In runs of 2, 4, 8 and 16 points the inner ones are left out where all are near their places on one piece.
    """
    corner, step = np.ones(edges.shape[1], np.bool_), 2
    while step <= _LONGEST_RUN and not len(corner) % step:
        begin = edges[:, ::step, None]
        share = np.arange(1, step) / step
        there = begin + share * (np.roll(begin, -1, axis=1) - begin)
        off = lengths(edges.reshape(len(edges), -1, step)[:, :, 1:] - there)
        corner.reshape(-1, step)[(off <= _NEAR).all(axis=(0, 2)), 1:] = False
        step *= 2
    return corner


def traces(context: DrawContext) -> tuple[Trace, ...]:
    """Return the curves of the scene's traced joints."""
    figure, view, gauge, theme = context.known
    traces = []
    for n, joint in enumerate(figure.scene.trace):
        colour = theme.traces[n % len(theme.traces)]
        back = mixed(colour, theme.background, _FAINTER if theme.lit else _FAINT)
        path = figure.path(joint, view)
        traces.append(Trace(joint, path, figure.scene.period, colour, back, 1.3 * gauge.line))
    return tuple(traces)


# The input's motion: an arrow that bends as the driven bar turns, its angle's arc; or a straight arrow.

Angles = TypeVar("Angles", float, NDArray[np.float64])

SWEEP = 1.25
"""The angle that the arrow covers where the input is fastest, in radians."""
AHEAD = 0.3
"""How far ahead of the bar it begins, in radians."""
_CLEAR, _LONGEST = 3.0, 6.0
"""How far from a slider's middle a straight arrow begins, and its longest length, in half widths of a bar."""


@frozen
class Turning:
    """What shows how the bar from `pivot` to `pin` turns; radii in pixels, `fastest` in rad/s.

    Its angle is given within half a turn of `middle` (rad), as in the HUD.
    """

    pivot: str
    pin: str
    arc: float
    arrow: float
    fastest: float
    colours: tuple[Colour, Colour]
    gauge: Gauge
    middle: float = pi

    def turned(self, angle: Angles) -> Angles:
        """Return the bar's angle (rad) within half a turn of `middle`."""
        return self.middle + (angle - self.middle + pi) % tau - pi

    def tracks(
        self, paths: Mapping[str, Loop], rates: NDArray[np.float64], *, angled: bool
    ) -> Iterator[tuple[Loop, float, bool]]:
        """Yield points (n, k) along the arrow and the angle, for joints on paths (n).

        Each comes with half its width, and whether it is the arrow's head.
        """
        centre, pin = paths[self.pivot], paths[self.pin]
        direction, share = (pin - centre) / np.abs(pin - centre), np.linspace(0, 1, 16)
        sweep = SWEEP * np.clip(-rates / self.fastest, -1, 1)[:, None]
        shaft = np.sign(sweep) * AHEAD + sweep * np.linspace(0, 1, 6)
        head = shaft[:, -1:] + np.sign(sweep) * 6.0 * self.gauge.line / self.arrow * np.array([-0.5, 1])
        for bend, half, is_head in ((shaft, 1.8, False), (head, 4.2, True)):
            points = centre[:, None] + self.arrow * direction[:, None] * directions(bend)
            yield points, half * self.gauge.line, is_head
        if angled:
            turned = self.turned(np.angle(np.conj(direction)))[:, None]
            yield centre[:, None] + self.arc * directions(-turned * share), 1.5 * self.gauge.line, False
            yield centre[:, None] + np.array([0, 1.5 * self.arc]), self.gauge.line, False

    def direction(self, pose: Pose, places: Places, rate: float) -> list[Layer]:
        """Return the arrow, shorter as the bar slows down; `rate` is the scene's speed over the pose's."""
        turning = -pose.coordinate_rate * rate / self.fastest
        sweep = SWEEP * min(max(turning, -1.0), 1.0)
        if not abs(sweep) > 0.02:
            return []
        bent = _bent(sweep, self.arrow, self.gauge.line, self.colours)
        return [layer.placed(*self._bar(places)) for layer in bent]

    def angle(self, places: Places) -> list[Layer]:
        """Return the arc from the horizontal to the bar, and the line it begins at."""
        centre, direction = self._bar(places)
        turned = self.turned(float(np.angle(direction.conjugate())))
        path = centre + self.arc * directions(np.linspace(0, -turned, max(round(abs(turned) * 12), 2)))
        ink, back = self.colours
        halo, line = strokes(path, (2.6 * self.gauge.line, 0.9 * self.gauge.line))
        return [Layer(back, halo), Layer(ink, [*line, *_dashes(centre, 1.45 * self.arc, self.gauge.line)])]

    def _bar(self, places: Places) -> tuple[complex, complex]:
        return places[self.pivot], unit(places[self.pin] - places[self.pivot])


@lru_cache(maxsize=16)
def _dashes(begin: complex, room: float, thick: float) -> list[Loop]:
    """Return a dashed line to the right; the latest results are cached, since most pivots stand still."""
    return dashes(begin, begin + room, 3.5 * thick, 0.8 * thick, ((0.0, 2.2 / 3.5),))


@lru_cache(maxsize=16)
def _bent(sweep: float, radius: float, thick: float, colours: tuple[Colour, Colour]) -> tuple[Layer, ...]:
    """Return an arrow about the pivot, the bar along the real axis: its rim, and the arrow on it.

    It bends by `sweep` (rad, negative to the left); the head of a short arrow is smaller. The latest results
    are cached: an input of steady speed has the same arrow at every frame.
    """
    side, line, rim = 1 if sweep > 0 else -1, 1.7 * thick, 0.9 * thick
    bend: Loop = radius * directions(side * AHEAD + sweep * np.linspace(0, 1, 16))
    head, turn = min(6.5 * thick, 0.8 * abs(sweep) * radius), bend[-1] / radius * 1j * side
    (rimmed,), (bare,) = strokes(bend, (line + 2 * rim, line))
    # a triangle whose point is a little ahead of the end
    barb = turn * np.array([0.75, -0.35 + 0.5j, -0.35 - 0.5j])
    loops = (rimmed, bend[-1] + (head + 2 * rim) * barb), (bare, bend[-1] + head * barb)
    return joined(map(Layer, reversed(colours), loops))


@frozen
class Sliding:
    """What shows how a driving slider moves along its guide, y down; `fastest` in the scene's unit/s."""

    joint: str
    along: complex
    room: float
    longest: float
    fastest: float
    colours: tuple[Colour, Colour]
    gauge: Gauge

    def direction(self, pose: Pose, places: Places, rate: float) -> list[Layer]:
        """Return the arrow ahead of the slider, shorter as it slows down; `rate` as in `Turning`."""
        share = pose.coordinate_rate * rate / self.fastest
        reach = self.along * self.longest * min(max(share, -1.0), 1.0)
        if not abs(reach) > 0.02 * self.longest:
            return []
        foot, width = places[self.joint] + self.room * unit(reach), 1.7 * self.gauge.line
        ink, back = self.colours
        rims = ((back, 0.9 * self.gauge.line), (ink, 0.0))
        return [Layer(colour, arrows([foot], [reach], width, rim)) for colour, rim in rims]

    def tracks(
        self, paths: Mapping[str, Loop], rates: NDArray[np.float64], *, angled: bool
    ) -> Iterator[tuple[Loop, float, bool]]:
        """Yield the ends (n, 2) of the arrow of a joint on its path, as `Turning.tracks` does."""
        reach = self.along * self.longest * np.clip(rates / self.fastest, -1, 1)
        foot = paths[self.joint] + self.room * self.along * np.sign(rates)
        yield np.stack((foot, foot + reach), axis=1), 4.2 * self.gauge.line, True


def motion_of(context: DrawContext) -> Turning | Sliding | None:
    """Return the mark of the input's motion: its bar's turning, or its slider's travel along the guide.

    None where the input is neither a slider on the ground nor a crank on a pivot.
    """
    figure, view, gauge, theme = context.known
    joint, info = figure.linkage.driven.joint, figure.scene.info
    fastest = float(np.nanmax(np.abs(figure.cycle.coordinate_rate)))
    ink = theme.ink, theme.background
    slide = joint.driven_slide
    if slide and slide.axis is None:
        along = complex(directions(-slide.angle))
        return Sliding(joint.name, along, _CLEAR * gauge.bar, _LONGEST * gauge.bar, fastest, ink, gauge)
    pivot = getattr(joint, "pivot", None)
    if pivot is None:
        return None
    arc, arrow = _radii(view.scale * abs(figure.start(joint.name) - figure.start(pivot)), gauge)
    middle = pi if info.full_turn else sum(info.input_range) / 2
    return Turning(pivot, joint.name, arc, arrow, fastest, ink, gauge, middle)


def _radii(length: float, gauge: Gauge) -> tuple[float, float]:
    """Return the radii of the angle's arc and of the arrow, in pixels, for a bar of that length."""
    arc = max(min(0.36 * length, 6 * gauge.bar), 2.2 * gauge.bar)
    return arc, max(min(0.7 * length, 8 * gauge.bar), arc + 1.6 * gauge.bar)


def turning_arrow(pivot: complex, pin: complex, gauge: Gauge, theme: Theme) -> list[Layer]:
    """Return the arrow of a driven bar that stands still, in pixels, counter-clockwise."""
    _, arrow = _radii(abs(pin - pivot), gauge)
    bent = _bent(-SWEEP, arrow, gauge.line, (theme.ink, theme.background))
    return [layer.placed(pivot, unit(pin - pivot)) for layer in bent]


# Arrows with their names: of velocities and accelerations at all moving joints and centres of mass, of forces
# where they act.

Kind = Literal["v", "a", "f"]
LONGEST, _LONGEST_OF_STILL, _LEAST = 0.22, 0.18, 0.02
"""The longest arrow of a cycle, as a share of the window's height; and the least share of its largest value
to which a still's arrows are scaled: below it the linkage is nearly at rest."""
_MOST_LONGEST = {"v": 100.0, "a": 100.0, "f": 2.5}
"""How many times as long as the longest an arrow may be: forces that grow without bound are not drawn."""
_USUAL = 0.85
"""Where forces grow without bound, the longest arrow stands for this quantile of them."""
_STILL = 1e-9
"""The share of its speed at which an input moves nothing by inertia or damping."""


class SeenArrow(NamedTuple):
    """An arrow in pixels, and what it is called: v_{A}."""

    symbol: str
    foot: complex
    reach: complex

    @property
    def of(self) -> str:
        """What its name is of: "vector:v_A"."""
        return vector_of(self.symbol)


@frozen
class Arrows:
    """Arrows of one kind at one scale over the whole cycle.

    `most` is the cycle's largest value at the scene's own speed; it is drawn `longest` pixels long. The part
    `resting` of it is the same at every speed, the rest grows with its power `order`.
    """

    kind: Kind
    words: str
    unit: str
    most: float
    longest: float
    drive: float
    colour: Colour
    halo: Colour
    gauge: Gauge
    order: int
    resting: float = 0.0

    @property
    def longest_drawn(self) -> float:
        """The length in pixels beyond which an arrow is not drawn: its value grows without bound."""
        return _MOST_LONGEST[self.kind] * self.longest

    def scale(self, speed: float) -> float:
        """Return pixels for one unit of length and second, or newton, at this input speed (rad/s of phase).

        It depends on the input's speed alone, so that an arrow's length shows where in the cycle the motion
        is fast, at any speed.
        """
        most = self.resting + (self.most - self.resting) * abs(speed / self.drive) ** self.order
        return self.longest / most if most > 0 else 0.0

    def paths(self, motion: Motion, joints: tuple[str, ...]) -> Iterator[tuple[str, Any, Any]]:
        """Yield the symbol of each arrow at the scene's own speed, its places (n, 2), y up, and reaches.

        Reaches (n, 2), y up, are in pixels; those of a motion that does not turn at the scene's speed, too.
        """
        speed = np.atleast_1d(np.asarray(motion.input_speed, np.float64))
        scale = np.array([self.scale(float(one)) for one in speed[:1]])
        for symbol, place, value in _values(motion, self.kind, joints):
            reach = scale * np.atleast_2d(value)
            with np.errstate(invalid="ignore"):
                drawn = np.hypot(reach[:, :1], reach[:, 1:]) <= self.longest_drawn
            yield symbol, place, np.where(drawn, reach, 0.0) if self.kind == FORCE else reach

    def seen(self, pose: Pose, view: View, joints: tuple[str, ...]) -> list[SeenArrow]:
        """Return the arrows of a pose that are long enough to be seen, in pixels."""
        scale = self.scale(pose.input_speed)
        arrows = [
            SeenArrow(symbol, view.pixel(place), complex(scale * x, -scale * y))
            for symbol, place, (x, y) in _values(pose, self.kind, joints)
        ]
        return [arrow for arrow in arrows if 0.01 * self.longest < abs(arrow.reach) < self.longest_drawn]


def arrow_layers(
    kinds: Sequence[Arrows], pose: Pose, view: View, joints: tuple[str, ...]
) -> list[list[Layer]]:
    """Return the arrows of a pose, kind by kind, each in a halo that sets it off from what is below.

    All kinds go through the arithmetic together.
    """
    seen = [kind.seen(pose, view, joints) for kind in kinds]
    every = [arrow for arrows_ in seen for arrow in arrows_]
    if not every:
        return [[] for _ in kinds]
    line, count = kinds[0].gauge.line, len(every)
    feet, reaches = np.array([(arrow.foot, arrow.reach) for arrow in every + every]).T
    drawn = arrows(feet, reaches, 1.6 * line, np.repeat([0.75 * line, 0.0], count))
    rims, bare = drawn[:count], drawn[count:]
    ends = pairwise((0, *accumulate(map(len, seen))))
    return [
        [Layer(kind.halo, rims[begin:end]), Layer(kind.colour, bare[begin:end])] if begin < end else []
        for kind, (begin, end) in zip(kinds, ends, strict=True)
    ]


def _values(motion: Motion | Pose, kind: Kind, joints: tuple[str, ...]) -> list[tuple[str, Any, Any]]:
    """Return the symbol of each arrow, where it begins, and its value."""
    if kind == FORCE:
        return [(one.symbol, one.place, one.value) for one in pulls(motion)]
    values, of_mass = _rates(motion, kind)
    at_joints = [(indexed(kind, joint), motion.position[joint], values[joint]) for joint in joints]
    masses = ((indexed(kind, f"G {body}"), motion.com_position[body], one) for body, one in of_mass.items())
    return [*at_joints, *masses]


class Pull(NamedTuple):
    """A force on a body: its symbol, where it begins, its value (N), the joint that is there, if one is."""

    symbol: str
    place: Any
    value: Any
    body: str
    joint: str


def pulls(motion: Motion | Pose) -> Iterator[Pull]:
    """Yield the forces of joints and guides and the loads, each on one of its two bodies.

    It is the one that moves, or of two the one that was solved for later; where more meet, each has its own.
    """
    linkage, labels = motion.mechanism.linkage, link_labels(motion.mechanism.linkage)

    def vector(pair: Any) -> Any:
        return pair if isinstance(motion.phase, float) else np.stack(np.broadcast_arrays(*pair), axis=-1)

    for joint, bodies in motion.reaction.items():
        moving = [body for body in bodies if body != GROUND]
        for body in moving[:1] if len(moving) == 2 else moving:
            symbol = indexed("F", f"{joint},{labels.get(body, body)}")
            yield Pull(symbol, motion.position[joint], bodies[body], body, joint)
    for joint, name in zip(linkage.slides, guided(linkage), strict=True):
        u, v = line_direction(motion, linkage.slides[joint].line)
        with np.errstate(invalid="ignore"):  # a force without bound
            size = motion.reactions.guides[name].force
            force = vector((-v * size, u * size))
        yield Pull(indexed("N", labels.get(name, name)), motion.position[joint], force, name, joint)
    for load in linkage.loads:
        carrier = linkage.body(load.on)
        (dx, dy), force = loaded(motion, load)
        x, y = components(motion.position[carrier.slider or carrier.joints[0]])
        place, value = vector((x + dx, y + dy)), vector(tuple(0.0 * x + part for part in force))
        yield Pull(indexed("P", load.name), place, value, load.on, carrier.slider or load.joint)


_PLAIN = {0x2080 + n: str(n) for n in range(10)} | {ord(brace): None for brace in "{}"}


def plain(symbol: str) -> str:
    """Return a symbol in letters and digits alone: r₂ as r2, v_{A} as v_A."""
    return symbol.translate(_PLAIN)


def vector_of(symbol: str) -> str:
    """Return what an arrow's name is of: "vector:v_A"."""
    return f"vector:{plain(symbol)}"


def arrows_for(
    figure: Figure, look: Look, layout: Layout, gauge: Gauge, theme: Theme, moment: float | None = None
) -> tuple[Arrows, ...]:
    """Return the arrows that a look has, scaled to the cycle or to one moment."""
    known: tuple[Kind, ...] = (VELOCITY, ACCELERATION, FORCE)
    kinds = (kind for kind in known if kind in look.vectors and (kind != FORCE or figure.linkage.reacting))
    return tuple(arrows_of(figure, kind, layout.size[1], gauge, theme, moment=moment) for kind in kinds)


def arrows_of(
    figure: Figure, kind: Kind, height: int, gauge: Gauge, theme: Theme, *, moment: float | None = None
) -> Arrows:
    """Return the arrows of one kind, scaled to the largest finite value of the cycle.

    Arrows of one `moment` are scaled to its own largest value, unless that is a small share of the cycle's.
    """
    colour = {"v": theme.velocity, "a": theme.acceleration, "f": theme.force}[kind]
    most = _most(figure.cycle, kind, figure.moving)
    if moment is not None:
        most = max(_most(figure.scene.pose(moment, 2), kind, figure.moving), _LEAST * most)
    drive, order, resting = figure.linkage.drive.speed, {"v": 1, "a": 2, "f": 0}[kind], 0.0
    if kind == FORCE and (order := force_order(figure.linkage)):
        resting, growing = _parts(figure, drive, moment)
        most = max(resting + growing, _LEAST * most)
    longest = (LONGEST if moment is None else _LONGEST_OF_STILL) * height
    unit = _UNITS[kind].format(figure.scene.length_unit)
    known = kind, _WORDS[kind], unit, most, longest, drive
    return Arrows(*known, colour, theme.background, gauge, order, resting)


def _parts(figure: Figure, speed: float, moment: float | None) -> tuple[float, float]:
    """Return the greatest force without inertia and damping, and the greatest that these add at a speed."""
    phase = figure.cycle.phase if moment is None else np.array([moment])
    both = (figure.scene.solve(phase=phase, speed=share * speed) for share in (_STILL, 1.0))
    still, moving = ([value for _, _, value in _values(one, FORCE, figure.moving)] for one in both)
    with np.errstate(invalid="ignore"):
        added = [one - other for one, other in zip(moving, still, strict=True)]
    return _largest(FORCE, still), _largest(FORCE, added)


_WORDS = {"v": "velocity", "a": "acceleration", "f": "force"}
_UNITS = {"v": "{}/s", "a": "{}/s²", "f": "N"}


def _most(cycle: Motion | Pose, kind: Kind, joints: tuple[str, ...]) -> float:
    """Return the greatest size of an arrow; of forces that are not bounded a usual one."""
    return _largest(kind, [value for _, _, value in _values(cycle, kind, joints)])


def _largest(kind: Kind, values: Sequence[Any]) -> float:
    rows = [np.atleast_2d(value) for value in values]
    sizes = np.concatenate([np.zeros(1), *(np.sqrt(row[:, 0] ** 2 + row[:, 1] ** 2) for row in rows)])
    finite = sizes[np.isfinite(sizes)]
    if kind == FORCE and finite.size < sizes.size:
        return float(np.sort(finite)[int(_USUAL * (finite.size - 1))])
    return float(finite.max())


def _rates(motion: Motion | Pose, kind: Kind) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    """Return the velocities or the accelerations of the joints, and of the centres of mass."""
    if kind == "v":
        return motion.velocity, motion.com_velocity
    return motion.acceleration, motion.com_acceleration
