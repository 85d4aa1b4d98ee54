"""Put names and dimensions on a picture, each in one place for the whole cycle.

Candidates for a label's place lie round joints, on links and beside what is measured. `placing` chooses among
them, and keeps labels off what is drawn.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import replace
from functools import cached_property
from itertools import pairwise, product
from math import ceil, pi, prod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkanim.frozen import NamedTuple, frozen
from linkanim.mechanics.linkage import Body
from linkanim.mechanics.motion import Pose
from linkanim.picture.bodies import BEYOND, RIM, WHEELS, body_parts, wheel_radius
from linkanim.picture.dead_centres import DeadCentres
from linkanim.picture.dimensions import AngleArc, MeasureLine, Measurement, Symbols
from linkanim.picture.figure import SAMPLES, DrawSetting, Figure
from linkanim.picture.fittings import fittings, pedestal_corners, rail_reach, rails_of, rails_under
from linkanim.picture.items import Caption, Halo
from linkanim.picture.layout import Gauge, Layout
from linkanim.picture.motion_marks import Sliding, Turning
from linkanim.picture.placing import MOMENTS, Clutter, LabelPlaces, Placer, Solid
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import Part, Places, directions, framed, hull, units
from linkanim.picture.text import subscripted
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect, View
from linkanim.steps import at_once

# Where labels may stand: round joints, on links, beside what is measured; what is in their way.

Size = tuple[float, float]
"""How wide and high a label is, in pixels."""
Own = frozenset[int]
"""The numbers of those things on which a label may lie."""

_ALONG = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)
"""Where along a bar its name may stand."""
_SIDES = (0, 1, -1, 1.8, -1.8)
"""How far to a bar's sides its name may stand, in heights of the name; 0 is on the bar."""
_INSIDE = (0.3, 0.5, 0.65)
"""Where a plate's name may stand, in shares of the way from its middle to its corners and sides."""
_BESIDE = 0.4
"""What a place beside a bar costs; a place on the bar costs nothing."""
_FARTHER = 1.0
"""What a place farther from its joint costs."""
_ROUND = 16
"""The number of places in a ring round a joint."""
_CLEAR = 1.3
"""How far from a bar's axis a label beside it begins, in half widths of a bar."""
_BLOCK = 2.7
"""How far a slider's block extends, in half widths of a bar."""
_MIDDLE, _ON_GROUND = (0.5, 0.42, 0.58), (0.33, 0.67)
"""Where along its own bar a length may stand, and further places for a length of the ground."""
_LEVELS = 8
"""The most dimension lines beside each other, on either side."""
_TIER = 1.4
"""The step from one dimension line to the next, in heights of their text."""
_ON_LINE = (0.5, 0.3, 0.7, 0.15, 0.85)
"""Where along a dimension line its text may stand."""
_TEXT_OFF, _GAP = 0.2, 0.55
"""How far a dimension's text is from its line, and other lines from that line, in heights of its text."""
_RINGS = (3, 6)
"""The number of rings of places round a joint, and round a slider's block."""
_AROUND_PLATE = (0.5, 0.3, 0.7)
"""Where along a plate's side its name may stand outside the plate."""
_ONE_CORNER = 0.8
"""Corners of a body that are nearer to each other than this, in half widths of a bar, count as one."""
_PIECES = 32
"""The number of straight pieces that stand for a wheel's rim, off which labels keep."""
_ARC_RINGS = 2
"""The number of rings outside its arc in which the input's angle may stand."""
_ROOMY = (1.0, 1.7, 2.6, 3.6)
"""The radii of an angle's arc, in radii of the smallest one."""
_ON_ARC = (0.5, 0.25, 0.75)
"""Where along the arc its angle may stand."""


class Spots(NamedTuple):
    """Places (k,) in the frame of the joint `at`, in which 1 is the vector to the joint `head`.

    A place is a `share` along the line from `begin` to `end` in that frame, then `aside` of it (+1 or -1:
    beside the line and `further` pixels more; 0: on it), and then `off` in pixels. In a frame that names one
    joint twice, 1 is the scene's unit to the right.
    """

    at: str
    head: str
    begin: Loop
    end: Loop
    share: NDArray[np.float64]
    aside: NDArray[np.float64]
    further: NDArray[np.float64]
    off: Loop

    def picked(self, which: int) -> Spots:
        """Return one of the places."""
        return Spots(self.at, self.head, *(part[which] for part in self[2:]))

    def middles(self, at: ArrayLike, span: ArrayLike, sides: ArrayLike, bar: float) -> Loop:
        """Return the middles in pixels, for frames at `at` and labels with these sides (w + hi)."""
        at, span, sides = (np.asarray(one, np.complex128) for one in (at, span, sides))
        along = (self.end - self.begin) * span
        normal = 1j * units(along)
        clear = 0.5 * (np.abs(normal.real) * sides.real + np.abs(normal.imag) * sides.imag) + _CLEAR * bar
        aside = self.aside * (clear + self.further) * normal
        middles: Loop = at + self.begin * span + self.share * along + aside + self.off
        return middles


def stacked(spots: Sequence[Spots]) -> Spots:
    """Return the spots of several labels in one value, each with its joints."""
    return Spots("", "", *(np.array(part) for part in list(zip(*spots, strict=True))[2:]))


@frozen
class LabelSpots:
    """Where a label may stand: its spots, their places over the moments, and the lines that go with it."""

    spots: Spots
    candidates: LabelPlaces
    lines: tuple[MeasureLine | AngleArc, ...] = ()


class Thing(NamedTuple):
    """A thing that labels keep off, and the joints that are its own."""

    joints: frozenset[str]
    solid: Solid
    linked: bool = False
    """Whether it is a body, a spring or a damper."""


@frozen
class Surroundings:
    """Where everything is that labels name or keep off, at the moments for which they are placed.

    These are all of a cycle, or one `phase`.
    """

    setting: DrawSetting
    turning: Turning | Sliding | None = None
    phase: float | None = None
    marks: tuple[tuple[complex, complex], ...] = ()
    """Lines on the picture that stand still, from end to end."""
    angled: bool = False
    """Whether the input's angle is drawn."""

    @cached_property
    def _paths(self) -> dict[str, Loop]:
        figure, step = self.setting.figure, SAMPLES // MOMENTS
        if self.phase is not None:
            pose = figure.scene.pose(self.phase, 0)
            view = self.setting.view
            found = {name: np.array([view.place(point)]) for name, point in pose.position.items()}
        else:
            names = (joint.name for joint in figure.linkage.joints)
            found = {name: figure.path(name, self.setting.view)[::step] for name in names}
        return {name: np.nan_to_num(path, nan=-1e6) for name, path in found.items()}

    @cached_property
    def _rates(self) -> NDArray[np.float64]:
        """The rate of the input at each moment."""
        if self.phase is not None:
            return np.array([self.setting.figure.scene.pose(self.phase).coordinate_rate])
        cycle = self.setting.figure.cycle
        return np.broadcast_to(cycle.coordinate_rate, cycle.phase.shape)[:: SAMPLES // MOMENTS]

    def _frame(self, frame: tuple[str, str]) -> tuple[Loop, Loop]:
        """Return where a frame's origin is, and its unit vector, in pixels."""
        at, head = (self._paths[name] for name in frame)
        return at, head - at if frame[0] != frame[1] else np.full_like(at, self.setting.view.scale)

    def around(self, name: str, size: Size, *, slider: bool = False) -> LabelSpots:
        """Return places all round a joint, in rings of growing radius; up and to the right is best.

        They should not lie on the bars that meet there; round a slider's block they must not.
        """
        rings = _RINGS[slider]
        turns = np.exp(-2j * pi * np.arange(_ROUND) / _ROUND)
        turned = 0.04 * np.abs(np.angle(turns / np.exp(-0.25j * pi)))
        rounds = [_off(turns, size, self._radius(name) + 0.7 * n * size[1]) for n in range(rings)]
        price = np.concatenate([_FARTHER * n + turned for n in range(rings)])
        beside = self._numbers(set() if slider else {name})
        return self._spots((name, name), size, price, beside=beside, off=np.concatenate(rounds))

    def is_plate(self, body: Body) -> bool:
        """Tell whether a body's joints are not all in one line."""
        return len(self._corners(body)) > 2

    def on(self, body: Body, size: Size) -> LabelSpots:
        """Return places on a link: along a bar and beside it, or inside a plate."""
        own = self._numbers(set(body.joints))
        if self.is_plate(body):
            inside, price = self._inside(body)
            return self._spots(body.joints, size, price, own=own, begin=inside, end=inside)
        return self._line(body.joints, (0, 1), size, product(_SIDES, _ALONG), own)

    def _inside(self, body: Body) -> tuple[Loop, NDArray[np.float64]]:
        """Return places inside a plate in its frame, and their prices."""
        places = [complex(self._paths[name][0]) for name in body.joints]
        corners = [(place - places[0]) / (places[1] - places[0]) for place in places]
        middle = sum(corners) / len(corners)
        sides = [(one + other) / 2 for one, other in pairwise((*corners, corners[0]))]
        towards = [(share, end) for share in _INSIDE for end in (*corners, *sides)]
        inside = np.array([middle, *((1 - share) * middle + share * end for share, end in towards)])
        return inside, np.array([0.0, *(share for share, _ in towards)])

    def outside(self, body: Body, size: Size) -> LabelSpots:
        """Return places along the sides of a plate, outside it."""
        places = np.array([complex(self._paths[name][0]) for name in self._corners(body)])
        first, second = (complex(self._paths[name][0]) for name in body.joints[:2])
        corners = (places - first) / (second - first)
        ends, middle = np.roll(corners, -1), corners.mean()
        inwards = np.sign(((middle - corners) * (ends - corners).conj()).imag)
        side, share = np.array([*product(range(len(corners)), _AROUND_PLATE)]).T
        which = side.astype(int)
        where: dict[str, Any] = {"begin": corners[which], "end": ends[which], "aside": -inwards[which]}
        own, price = self._numbers(set(body.joints)), np.abs(share - 0.5)
        return self._spots(body.joints, size, price, own=own, share=share, **where)

    def dimension(self, about: Measurement, size: Size) -> Iterator[LabelSpots]:
        """Yield places for a length on its own bar if that has room, and at dimension lines beside it."""
        if about.angle:
            yield self._by_angle(about, size)
            return
        ends, (_, way), mine = (about.begin, about.end), self._frame(about.frame), self._numbers(about.own)
        if about.bare and size[0] < abs(way[0] * (ends[1] - ends[0])):
            shares = _MIDDLE if about.own else _MIDDLE + _ON_GROUND
            by_bar = self._line(about.frame, ends, size, product((1, -1), shares), mine)
            yield replace(by_bar, candidates=by_bar.candidates._replace(gap=_GAP * size[1]))
        low, step = 2.0 * self.setting.gauge.bar + 9 * self.setting.layout.unit, _TIER * size[1]
        levels = [(side, low + n * step) for n in range(_LEVELS) for side in (1.0, -1.0)]
        lines = [MeasureLine(about.frame, *ends, side * level) for side, level in levels]
        drawn, share = np.array([*product(range(len(lines)), _ON_LINE)]).T
        aside, level = np.array(levels)[drawn.astype(int)].T
        price = 0.3 * (drawn // 2) + 0.6 * abs(share - 0.5)
        where: dict[str, Any] = {"begin": ends[0], "end": ends[1], "share": share, "aside": aside}
        where["further"] = level + _TEXT_OFF * size[1] - _CLEAR * self.setting.gauge.bar
        lined = self._lined(self._spots(about.frame, size, price, beside=mine, **where), lines, drawn)
        yield replace(lined, candidates=lined.candidates._replace(gap=_GAP * size[1]))

    def _by_angle(self, about: Measurement, size: Size) -> LabelSpots:
        """Return places outside arcs about where two lines of a body meet."""
        radii = [share * (2.4 * self.setting.gauge.bar + 0.6 * size[1]) for share in _ROOMY]
        arcs = tuple(AngleArc(about.frame, about.begin, about.end, radius) for radius in radii)
        drawn, share = np.array([*product(range(len(arcs)), _ON_ARC)]).T
        ways = directions(np.angle(about.begin) + np.angle(about.end / about.begin) * share)
        further = np.array(radii)[drawn.astype(int)] + 0.2 * size[1] - _CLEAR * self.setting.gauge.bar
        # lines across these directions, so that the places lie to their sides
        where: dict[str, Any] = {"end": -1j * ways, "aside": 1, "further": further}
        price, own = 0.3 * drawn + 0.6 * abs(share - 0.5), self._numbers(about.own)
        return self._lined(self._spots(about.frame, size, price, own=own, **where), arcs, drawn)

    def _lined(
        self, found: LabelSpots, lines: Sequence[MeasureLine | AngleArc], drawn: NDArray[Any]
    ) -> LabelSpots:
        """Return the spots with the lines that go with them."""
        tracks = (line.tracks(*self._frame(line.frame), self.setting.gauge) for line in lines)
        mine = found.candidates._replace(lines=tuple(tracks), drawn=drawn.astype(np.int64))
        return LabelSpots(found.spots, mine, tuple(lines))

    def by_arc(self, turning: Turning, size: Size) -> LabelSpots:
        """Return places outside the arc of the input's angle, best at its middle."""
        bars = np.angle(np.conj(self._paths[turning.pin] - self._paths[turning.pivot]))
        angles = turning.turned(bars)
        turns = self.setting.figure.scene.info.full_turn and self.phase is None
        middle = pi / 6 if turns else angles.mean() / 2
        ring, way = np.array([*product(range(_ARC_RINGS), np.linspace(-1, 1, 9))]).T
        radius = turning.arc + (0.1 + 0.7 * ring) * size[1]
        off = _off(np.exp(-1j * (middle + 0.8 * way)), size, radius)
        price = 0.3 * np.abs(way) + 0.5 * ring
        return self._spots((turning.pivot, turning.pivot), size, price, off=off)

    def still(self, places: Loop, size: Size) -> LabelSpots:
        """Return fixed places, given in pixels, the best first."""
        name = next(iter(self.setting.figure.linkage.pins)).name
        begin = (places - self._paths[name][0]) / self.setting.view.scale
        return self._spots((name, name), size, 0.5 * np.arange(len(places)), begin=begin, end=begin)

    def _line(
        self, frame: Sequence[str], line: tuple[complex, complex], size: Size, tried: Iterable[Any], own: Own
    ) -> LabelSpots:
        """Return places on a line and beside it; `tried` has pairs of how far aside, and at which share."""
        aside, share = np.array([*tried]).T
        price = _BESIDE * np.abs(aside) + np.abs(share - 0.5)
        where: dict[str, Any] = {"begin": line[0], "end": line[1], "share": share, "aside": np.sign(aside)}
        where["further"] = (np.maximum(np.abs(aside), 1) - 1) * size[1]
        return self._spots(frame, size, price, own=own, **where)

    def _spots(
        self,
        frame: Sequence[str],
        size: Size,
        price: NDArray[Any],
        *,
        own: Own = frozenset(),
        beside: Own = frozenset(),
        **parts: ArrayLike,
    ) -> LabelSpots:
        """Return places with their prices at each moment; fields of `Spots` that are not given are 0."""
        first, second = frame[:2]
        whole = np.broadcast_arrays(price, *(parts.get(part, 0.0) for part in Spots._fields[2:]))
        spots = Spots(first, second, *whole[1:])
        at, way = (place[:, None] for place in self._frame((first, second)))
        middles = spots.middles(at, way, complex(*size), self.setting.gauge.bar)
        return LabelSpots(spots, LabelPlaces(size, middles, price, own, beside))

    def _radius(self, name: str) -> float:
        """Return the radius of what is drawn at a joint, in pixels."""
        if not self.setting.figure.linkage.joint(name).travels:
            return self.setting.gauge.bar
        return max(_BLOCK * self.setting.gauge.bar, rail_reach(self.setting, name) + self.setting.gauge.bar)

    def clutter(self) -> Clutter:
        """Return what labels must keep off."""
        solids = tuple(thing.solid for thing in self.things)
        links = frozenset(n for n, thing in enumerate(self.things) if thing.linked)
        discs = {(name,) for name in self.setting.figure.pins}
        pins = frozenset(
            n for n, one in enumerate(self.things) if not one.linked and tuple(one.joints) in discs
        )
        return Clutter(self.setting.layout.stage.inset(2), self.setting.layout.words, solids, links, pins)

    @cached_property
    def things(self) -> tuple[Thing, ...]:
        """All that labels keep off, at each of the moments."""
        return (
            *(*self._links(), *self._pins(), *self._fittings()),
            *(*self._rims(), *self._standing(), *self._arrow()),
        )

    def _links(self) -> Iterator[Thing]:
        """Yield what each body, spring and damper covers."""
        figure, bar = self.setting.figure, self.setting.gauge.bar
        shaped = {body for body in figure.bodies if figure.scene.style(body.name).outline in BEYOND}
        parts = {part.name: part for part in body_parts(self.setting)} if shaped else {}
        for body in shaped:
            outline = np.concatenate([loop for layer in parts[body.name].layers for loop in layer.loops])
            far = _thinned(hull(outline.tolist()), _ONE_CORNER * self.setting.gauge.bar)
            solid = self._moving(parts[body.name], far)
            yield Thing(frozenset(body.joints), solid, True)
        links = [
            (body.joints, self._corners(body), bar + 0.5) for body in figure.bodies if body not in shaped
        ]
        struts = [(strut.between, strut.between, 1.1 * bar) for strut in figure.struts]
        for joints, corners, half in (*links, *struts):
            solid = Solid(np.stack([self._paths[name] for name in corners], axis=1), half)
            yield Thing(frozenset(joints), solid, True)

    def _rims(self) -> Iterator[Thing]:
        """Yield the rims of wheels, in short pieces."""
        figure, gauge = self.setting.figure, self.setting.gauge
        for body in figure.bodies:
            style = figure.scene.style(body.name)
            if style.outline in WHEELS:
                first, *others = (complex(self._paths[name][0]) for name in body.joints)
                stated = self.setting.view.scale * (style.radius or 0.0)
                radius = max(stated, wheel_radius([other - first for other in others], gauge))
                middle = radius - 0.5 * RIM * gauge.bar
                round_ = middle * np.exp(2j * pi * np.arange(_PIECES + 1) / _PIECES)
                for ends in pairwise(round_):
                    corners = self._paths[body.joints[0]][:, None] + np.array(ends)
                    yield Thing(frozenset(), Solid(corners, 0.5 * RIM * gauge.bar, little=True))

    def _moving(self, part: Part, corners: Loop) -> Solid:
        """Return what corners in the frame of a part cover."""
        span = self._paths[part.head] - self._paths[part.tail]
        turn = span / np.where(span == 0, 1, np.abs(span)) + (span == 0)
        return Solid(self._paths[part.at][:, None] + turn[:, None] * corners, 0.0)

    def _pins(self) -> Iterator[Thing]:
        for name in self.setting.figure.pins:
            disc = Solid(self._paths[name][:, None], self.setting.gauge.pin + self.setting.gauge.outline)
            yield Thing(frozenset([name]), disc)

    def _fittings(self) -> Iterator[Thing]:
        """Yield blocks, slotted bars, cylinders, and the guides on the ground."""
        for fitting in fittings(self.setting):
            for part in (*fitting.behind, *fitting.before):
                joints, linked = frozenset((part.at, part.tail, part.head)), part.tail != part.head
                block = framed(np.concatenate(part.layers[0].loops))
                yield Thing(joints, self._moving(part, block), linked)
                # a yoke's bar extends beyond its block
                whole = framed(np.concatenate([loop for layer in part.layers for loop in layer.loops]))
                if np.ptp(whole.real) + np.ptp(whole.imag) > 1.5 * (np.ptp(block.real) + np.ptp(block.imag)):
                    yield Thing(joints, self._moving(part, whole), linked)
        for loops in (*rails_of(self.setting), *rails_under(self.setting)):
            yield Thing(frozenset(), Solid(framed(np.concatenate(loops))[None], 0.0))

    def _standing(self) -> Iterator[Thing]:
        """Yield the supports, and the lines that stand still."""
        for name in self.setting.figure.fixed:
            corners = pedestal_corners(self.setting, name)
            yield Thing(frozenset(), Solid(np.array([corners]), self.setting.gauge.outline))
        for ends in self.marks:
            yield Thing(frozenset(), Solid(np.array([ends]), self.setting.gauge.line))

    def _arrow(self) -> Iterator[Thing]:
        """Yield the mark of the input's motion."""
        if self.turning:
            for points, half in self.turning.tracks(self._paths, self._rates, angled=self.angled):
                for n in range(points.shape[1] - 1):
                    yield Thing(frozenset(), Solid(points[:, n : n + 2], half))

    def _numbers(self, joints: Set[str]) -> frozenset[int]:
        """Return the numbers of the links that have all these joints; none where no joints are given."""
        things = enumerate(self.things)
        return frozenset(n for n, thing in things if joints and thing.linked and joints <= thing.joints)

    def _corners(self, body: Body) -> list[str]:
        """Return the joints at the corners of a body's outline, in their order round it."""
        starts = {complex(self._paths[name][0]): name for name in reversed(body.joints)}
        return [starts[corner] for corner in hull(list(starts))]


def _thinned(corners: Sequence[complex], apart: float) -> Loop:
    """Return the corners of a hull; of corners nearer to each other than `apart`, one."""
    kept = list[complex]()
    for corner in corners:
        if all(abs(corner - other) >= apart for other in kept[-1:]):
            kept.append(corner)
    return np.array(kept)


def _off(turns: Loop, size: tuple[float, float], radius: float | NDArray[np.float64]) -> Loop:
    """Return where the middle of a label that touches a disc about 0 lies, in each of these directions."""
    off: Loop = turns.real * (radius + size[0] / 2) + 1j * turns.imag * (radius + size[1] / 2)
    return off


# Names on the picture: of joints and links, then their dimensions, each in one place for the whole cycle.

_ROOM = 0.6
"""The share of a bar that its link's name may take."""
_HIGH = 0.94
"""The height of a placed label's letters, in heights of their line."""
_UNSEEN = 0.05
_ENOUGH = 0.5
"""A name that shows for this share of the cycle is preferred to a number."""
_LEAST_SHOWN = 0.2
"""A name that would show for a smaller share of the cycle is left out."""
_LEAST_AGAIN = 0.08
"""The same for a name in a second place."""
_SEEN = 0.5
"""The least opacity of a label that shows all the time."""
_PLACES_ON_LINKS, _PLACES_ON_ALL = 3, 3
"""The further places that a label which shows all the time may have: on links, then on all but pins."""
_LASTING = 0.2
"""The share of the picture's room that labels showing all the time may take; more would hide the linkage."""
_LEAST_MEASURED = 0.4
"""A dimension that would show for a smaller share of the cycle stands in the table instead."""
_ROW = 1.3
"""The step from row to row of the table, in heights of its text."""
TRIES = 3
"""The number of further orders in which labels are placed, after the best one, where some have no place."""
_GRID = (9, 9)
"""The number of places that are tried for the table, across and down."""


@frozen
class Label:
    """A line of text with its place; a dimension has its `symbol`, and perhaps a line drawn with it.

    In the table it stands with the words for what it is `about`.
    """

    text: str
    line: int
    """The height of its line."""
    colour: Colour
    size: tuple[float, float]
    """The width and height of its letters in their halo."""
    symbol: str = ""
    about: str = ""
    spot: Spots | None = None
    shown: NDArray[np.float64] | None = None
    """Its opacity (0 to 1) over the cycle, at equal steps of phase."""
    drawn: MeasureLine | AngleArc | None = None
    always: bool = False
    """Whether it shows at every moment: where no other place is free it lies on a link."""

    @property
    def row(self) -> str:
        """Its row in the table."""
        return f"{self.text}, {self.about}"


@frozen
class DimensionTable:
    """Rows of words beside the figure, in columns."""

    rows: tuple[Label, ...]
    columns: int
    rect: Rect
    size: int
    colour: Colour
    halo: Halo

    def captions(self) -> Iterator[Caption]:
        """Yield the rows, column by column."""
        deep, wide = ceil(len(self.rows) / self.columns), self.rect.width / self.columns
        for n, label in enumerate(self.rows):
            at = self.rect.x + n // deep * wide, self.rect.y + n % deep * _ROW * self.size
            yield Caption(label.row, at, self.size, self.colour, strong=True, halo=self.halo)


@frozen
class Names:
    """All labels of a picture, in their halo, and a table of those that it does not show all the time."""

    labels: tuple[Label, ...]
    period: float
    bar: float
    halo: Halo
    table: DimensionTable | None = None
    unlisted: tuple[Label, ...] = ()
    """Rows for which there is no room."""
    scale: float = 1.0

    def captions(self, pose: Pose, places: Places) -> list[Caption]:
        """Return every label that shows, as a line of text, and the table."""
        found = [*self.table.captions()] if self.table else []
        for label, middle, shown in self.standing(pose, places):
            if shown > _UNSEEN:
                at = (middle.real, middle.imag - 0.5 * label.line)
                found.append(
                    Caption(label.text, at, label.line, label.colour, "centre", True, self.halo, shown)
                )
        return found

    def standing(self, pose: Pose, places: Places) -> Iterator[tuple[Label, complex, float]]:
        """Yield every label with its middle in pixels, and its opacity (0 to 1)."""
        if not self.labels:
            return
        spots, sides = self._stacked
        frames = [(label.spot.at, label.spot.head) for label in self.labels if label.spot]
        at = np.array([places[name] for name, _ in frames])
        span = [places[head] - places[name] if head != name else self.scale for name, head in frames]
        middles: Loop = spots.middles(at, span, sides, self.bar)
        yield from zip(self.labels, middles.tolist(), self._shown(pose.phase), strict=True)

    def lines(self, pose: Pose, places: Places, parts: Mapping[str, Part]) -> Iterator[Layer]:
        """Yield the dimension lines that show; `parts` has them by their symbols."""
        for label, shown in zip(self.labels, self._shown(pose.phase), strict=True) if parts else ():
            if label.drawn and shown > _UNSEEN:
                layers = parts[label.symbol].placed(places)
                yield from (layer._replace(alpha=shown * layer.alpha) for layer in layers)

    def parts(self, figure: Figure, view: View, gauge: Gauge, colour: Colour) -> dict[str, Part]:
        """Return the dimension lines in a view, by their symbols."""
        found = {}
        for label in self.labels:
            if label.drawn:
                at, head = map(figure.start, label.drawn.frame)
                span = view.scale * (abs(head - at) if label.drawn.frame[0] != label.drawn.frame[1] else 1.0)
                found[label.symbol] = label.drawn.part(span, gauge, colour)
        return found

    def measuring(self, known: Symbols | None, unit: str, scale: float) -> Names:
        """Return the labels in their places in a view of this scale, with the present lengths."""
        values = {one.symbol: one.written(unit) for one in known.dimensions} if known else {}
        table = self.table and replace(self.table, rows=_reread(self.table.rows, values))
        return replace(self, labels=_reread(self.labels, values), table=table, scale=scale)

    def in_theme(self, one: Theme, other: Theme) -> Names:
        """Return the names in their places, with the colours of `one` theme replaced by the other's."""
        colours = {one.ink: other.ink, one.dim: other.dim, one.warning: other.warning}
        halo = self.halo._replace(colour=other.background)

        def coloured(labels: Iterable[Label]) -> tuple[Label, ...]:
            return tuple(replace(label, colour=colours[label.colour]) for label in labels)

        table = self.table and replace(
            self.table, rows=coloured(self.table.rows), colour=colours[self.table.colour], halo=halo
        )
        labels, unlisted = coloured(self.labels), coloured(self.unlisted)
        return replace(self, labels=labels, halo=halo, table=table, unlisted=unlisted)

    def _shown(self, phase: float) -> list[float]:
        """Return the opacity of each label at a phase."""
        steps = [label.shown for label in self.labels if label.shown is not None]
        count = max(map(len, steps), default=1)
        share = phase / self.period % 1.0 * count
        first, part = int(share), share % 1.0
        return [
            float(shown[first % len(shown)] * (1 - part) + shown[(first + 1) % len(shown)] * part)
            for shown in steps
        ]

    @cached_property
    def _stacked(self) -> tuple[Spots, NDArray[np.complex128]]:
        """The labels' spots, and their sides (w + hi)."""
        spots = stacked([label.spot for label in self.labels if label.spot])
        return spots, np.array([complex(*label.size) for label in self.labels])


def _reread(labels: Iterable[Label], values: Mapping[str, str]) -> tuple[Label, ...]:
    """Return labels with the present lengths, which `values` has by their symbols."""
    return tuple(replace(label, text=values.get(label.symbol, label.text)) for label in labels)


def _joint_size(layout: Layout) -> int:
    """Return the height of a joint's name."""
    return max(round(20 * layout.unit * layout.type_scale), 12)


def _halo(setting: DrawSetting) -> Halo:
    """Return the halo that sets letters off from what is below."""
    return Halo(setting.theme.background, max(1.4 * setting.gauge.line, 1.5))


def _label(
    setting: DrawSetting, text: str, line: int, colour: Colour, symbol: str = "", about: str = ""
) -> Label:
    """Return a line of text that has no place yet."""
    around = 2 * _halo(setting).width
    wide = setting.type.width(text, line, strong=True)
    return Label(text, line, colour, (wide + around, _HIGH * line + around), symbol, about)


Form = tuple[Label, LabelSpots]
Forms = Iterator[tuple[Form, ...]]
"""Labels, each in the forms that it may have, the best first."""


def names_of(
    ground: Surroundings, known: Symbols | None, dead_centres: DeadCentres | None, tries: int = TRIES
) -> Generator[None, None, Names]:
    """Place the names of joints and links; where symbols are known, dimensions and the input's angle, too.

    Lengths that do not stand on the picture all the time go into a table. The generator yields after finding
    what is in the way of names, and after each search for a place. For a single moment, `tries` further
    orders are tried where some labels have no place.
    """
    setting = ground.setting
    every, clutter = _every(ground, known, dead_centres), ground.clutter()
    yield
    placer, placed, left = yield from _attempts(every, clutter, tries if ground.phase is not None else 0)
    rows = tuple(label for label in left if label.about)
    found = (setting.figure.scene.period, setting.gauge.bar, _halo(setting))
    table = (yield from _tabled(ground, placer, rows)) if rows else None
    return Names(placed, *found, table, () if table else rows, setting.view.scale)


def _every(ground: Surroundings, known: Symbols | None, dead_centres: DeadCentres | None) -> Forms:
    """Yield all labels of a picture in the order in which they choose their places."""
    look, fixed = ground.setting.look, ground.setting.figure.fixed
    moving = [name for name in ground.setting.figure.shown if name not in fixed]
    yield from _joints(ground, fixed, always=True)
    yield from _links(ground) if look.names or look.centres else ()
    if known:
        yield from _dimensions(ground, known)
        yield from _angle(ground, known)
    yield from _dead_centres(ground, dead_centres) if dead_centres else ()
    yield from _joints(ground, moving)


Lacking = tuple[int, int]
"""How many dimensions, and how many labels in all, have no place at what they name."""


class StillLabels:
    """The labels of a picture of one moment, to be asked only how many of them have no place."""

    def __init__(self, ground: Surroundings, known: Symbols | None, dead_centres: DeadCentres | None) -> None:
        self._every, self._clutter = [*_every(ground, known, dead_centres)], ground.clutter()
        self._clutter.learn([spots.candidates for forms in self._every for _, spots in forms])

    @cached_property
    def least(self) -> Lacking:
        """How many have no place at the least: no place is free even without other labels."""
        return _lacking([forms[0][0] for forms in _hopeless(self._every, self._clutter)])

    def lacking(self, tries: int) -> Lacking:
        """Return how many have no place, the best of `tries` further orders after the best one before."""
        *_, left = at_once(_attempts(self._every, self._clutter, tries))
        return _lacking(left)


Attempt = tuple[Placer, tuple[Label, ...], tuple[Label, ...]]
"""The placer with its placed labels, those labels, and those left over for part of the time or all of it."""


def _attempts(
    every: Iterable[tuple[Form, ...]], clutter: Clutter, tries: int
) -> Generator[None, None, Attempt]:
    """Return the best of some attempts to place labels, in `tries` orders after the best one before.

    Labels that were left over choose first in the next order.
    """
    best, seen, order = None, list[tuple[Form, ...]](), every
    lasting: list[tuple[Form, list[Label]]] = []
    more, hopeless, before = tries, frozenset[int](), set[tuple[int, ...]]()
    while True:
        placer, kept, left = Placer(clutter), list[Label](), list[tuple[Form, ...]]()
        seen, pinned = [], list[tuple[Form, list[Label]]]()
        for forms in order:
            seen.append(forms)
            placed = (yield from _placed(placer, forms)) if id(forms) not in hopeless else []
            kept += placed
            pinned += [(forms[0], placed)] if forms[0][0].always else []
            left += [] if any(one.shown is not None and one.shown.all() for one in placed) else [forms]
        names = tuple(forms[0][0] for forms in left)
        if best is None or _lacking(names) < _lacking(best[2]):
            best, lasting, more = (placer, tuple(kept), names), pinned, tries
        if not left or not more:
            break
        if not before:
            hopeless = frozenset(map(id, _hopeless(left, clutter)))
            before.add(tuple(id(forms) for forms in seen if id(forms) not in hopeless))
        without = {id(forms) for forms in left}
        order, more = [*left, *(forms for forms in seen if id(forms) not in without)], more - 1
        hopeful = tuple(id(forms) for forms in order if id(forms) not in hopeless)
        if hopeful in before:  # this order was tried already
            break
        before.add(hopeful)
    further: list[Label] = []
    wanted, room = sum(prod(label.size) for (label, _), _ in lasting), clutter.inside
    for form, found in lasting if wanted < _LASTING * room.width * room.height else ():
        further += yield from _all_along(best[0], form, found)
    return best[0], (*best[1], *further), best[2]


def _hopeless(every: Iterable[tuple[Form, ...]], clutter: Clutter) -> list[tuple[Form, ...]]:
    """Return the labels that have no place at one moment, wherever the others stand."""
    return [forms for forms in every if not any(clutter.has_place(spots.candidates) for _, spots in forms)]


def _lacking(left: Sequence[Label]) -> Lacking:
    """Return how many dimensions, and how many labels in all, are left over."""
    return sum(bool(label.about) for label in left), len(left)


def _placed(placer: Placer, forms: tuple[Form, ...]) -> Generator[None, None, list[Label]]:
    """Return a label in its place; for the time when that is not free, a name in a second place, too."""
    found: list[Label] = []
    but = None
    measures = bool(forms[0][0].about)
    for least in (_LEAST_MEASURED,) if measures else (_LEAST_SHOWN, _LEAST_AGAIN, _LEAST_AGAIN):
        yield
        enough = 1.0 if measures else _ENOUGH
        which, placed = placer.first([spots.candidates for _, spots in forms], enough, least=least, but=but)
        label, spots = forms[which]
        forms = forms[which : which + 1] if placed.shown.any() else forms
        if placed.shown.any():
            number = -1 if spots.candidates.drawn is None else int(spots.candidates.drawn[placed.which])
            drawn = spots.lines[number] if number >= 0 else None
            spot = spots.spots.picked(placed.which)
            found.append(replace(label, spot=spot, shown=placed.shown, drawn=drawn))
        but = placed.shown > 0 if but is None else but | (placed.shown > 0)
        nowhere = least == _LEAST_AGAIN and not placed.shown.any()  # a further try would fail, too
        if nowhere or but.all() or len(but) == 1:  # a single moment needs no second place
            break
    return found


def _all_along(placer: Placer, form: Form, found: Sequence[Label]) -> Generator[None, None, list[Label]]:
    """Return a label in further places, so that it shows all the time."""
    (label, spots), clutter, further = form, placer.clutter, list[Label]()
    all_but_pins = frozenset(range(len(clutter.solids))) - clutter.pins
    covered = sum(
        (one.shown for one in found if one.shown is not None), np.zeros(len(spots.candidates.places))
    )
    for on in (*[clutter.links] * _PLACES_ON_LINKS, *[all_but_pins] * _PLACES_ON_ALL):
        if covered.min() >= 1.0:
            break
        yield
        placed = placer.rest(spots.candidates, covered, on=on)
        if placed.shown.any():
            covered = covered + placed.shown
            further.append(replace(label, spot=spots.spots.picked(placed.which), shown=placed.shown))
    if further and covered.min() < _SEEN:  # no place is free all the time: it then lies on something else
        last = further[-1]
        further[-1] = replace(
            last, shown=np.asarray(last.shown) + np.where(covered < _SEEN, 1.0 - covered, 0.0)
        )
    return further


def table_width(rows: Iterable[str], setting: DrawSetting) -> float:
    """Return how wide a column of the table is."""
    size = setting.layout.small_size
    return max(setting.type.width(row, size, strong=True) for row in rows) + 1.2 * size


def _tabled(
    ground: Surroundings, placer: Placer, rows: tuple[Label, ...]
) -> Generator[None, None, DimensionTable | None]:
    """Return the table in the room given to it, or in a free place; None where there is no room."""
    setting = ground.setting
    size, strip = setting.layout.small_size, setting.layout.table
    wide = table_width((label.row for label in rows), setting)
    if strip:
        fits = (
            (columns, small)
            for small in range(size, 0, -1)
            for columns in [max(int(strip.width / (wide * small / size)), 1)]
            if ceil(len(rows) / columns) * _ROW * small <= strip.height or small == 1
        )
        columns, small = next(fits)
        rect = strip._replace(width=columns * wide * small / size)
        return DimensionTable(rows, columns, rect, small, setting.theme.dim, _halo(setting))
    stage = setting.layout.stage.inset(setting.layout.margin)
    for columns in range(1, len(rows) + 1):
        around = complex(columns * wide, ceil(len(rows) / columns) * _ROW * size)
        first, room = complex(stage.x, stage.y) + around / 2, complex(stage.width, stage.height) - around
        if room.real > 0 and room.imag > 0:
            yield
            across, down = (np.linspace(0, 1, count) for count in _GRID)
            grid = first + np.add.outer(across * room.real, 1j * down * room.imag)
            outer = np.add.outer(np.minimum(across, 1 - across), np.minimum(down, 1 - down)).ravel()
            order = outer.argsort(kind="stable")
            spots = ground.still(grid.ravel()[order], (around.real, around.imag)).candidates
            _, placed = placer.first([spots], least=1.0)
            if placed.shown.all():
                corner = complex(spots.places[0, placed.which]) - around / 2
                rect = Rect(corner.real, corner.imag, around.real, around.imag)
                return DimensionTable(rows, columns, rect, size, setting.theme.dim, _halo(setting))
    return None


def _joints(ground: Surroundings, names: Iterable[str], *, always: bool = False) -> Forms:
    """Yield joints' names, which show `always` or as long as they find room.

    A joint's instant centres stand with its name, or alone where joints are not named.
    """
    setting = ground.setting
    look, theme, centred = setting.look, setting.theme, _centred(setting)
    for name in names:
        words = ([subscripted(name)] if look.joints_named else []) + [*centred.get(name, ())]
        if words:
            size = _joint_size(setting.layout) if look.joints_named else setting.layout.small_size
            label = _label(setting, ", ".join(words), size, theme.ink if look.joints_named else theme.warning)
            label = replace(label, always=always)
            yield ((label, ground.around(name, label.size)),)


def _centred(setting: DrawSetting) -> Mapping[str, tuple[str, ...]]:
    """Return the names of the instant centres in each joint, where they are shown."""
    if not setting.look.centres:
        return {}
    from linkanim.picture.centres import CentrePairs

    return CentrePairs(setting.figure).at_joints


def _links(ground: Surroundings) -> Forms:
    """Yield the links' names, or their numbers where there is no room for names.

    Bodies that cannot move against each other share a number, so they have their names. Where instant centres
    are shown, which are named by numbers, each link has its number, and so has each block without a name.
    """
    setting = ground.setting
    figure, size = setting.figure, setting.layout.small_size
    called: Mapping[Body, tuple[str, ...]]
    if setting.look.centres:
        called = {body: (number,) for number, body in figure.by_number.items() if body}
    else:
        called = {body: _called(ground, body) for body in figure.numbers}
    for body, words in called.items():
        labels = [_label(setting, text, size, setting.theme.ink) for text in dict.fromkeys(words)]
        if body.slider:
            yield tuple((label, ground.around(body.slider, label.size, slider=True)) for label in labels)
        elif len(body.joints) > 1:
            inside = tuple((label, ground.on(body, label.size)) for label in labels)
            last = labels[-1]
            beside = ((last, ground.outside(body, last.size)),) if ground.is_plate(body) else ()
            yield (*inside, *beside)


def _called(ground: Surroundings, body: Body) -> tuple[str, ...]:
    """Return a link's possible labels: its name where that has room, its number where it is the only one."""
    figure = ground.setting.figure
    number = figure.numbers[body]
    if [*figure.numbers.values()].count(number) > 1:
        return (figure.links[body],)
    return (figure.links[body], number) if _long_enough(ground, body) else (number,)


def _long_enough(ground: Surroundings, body: Body) -> bool:
    """Return whether a link has room for its name."""
    setting = ground.setting
    if len(body.joints) < 2:
        return True
    one, other = map(setting.figure.start, body.joints[:2])
    name = setting.figure.links[body]
    wide = setting.type.width(name, setting.layout.small_size, strong=True)
    return wide < _ROOM * setting.view.scale * abs(other - one)


def _angle(ground: Surroundings, known: Symbols) -> Forms:
    """Yield the input's angle at its pivot."""
    setting = ground.setting
    if isinstance(ground.turning, Turning):
        label = _label(setting, known.input, _joint_size(setting.layout), setting.theme.dim)
        yield ((label, ground.by_arc(ground.turning, label.size)),)


def _dead_centres(ground: Surroundings, found: DeadCentres) -> Forms:
    """Yield the words at a slider's dead centres."""
    setting = ground.setting
    for text, places in found.words():
        label = _label(setting, text, setting.layout.small_size, setting.theme.dim)
        yield ((label, ground.still(places(label.size), label.size)),)


def _dimensions(ground: Surroundings, known: Symbols) -> Forms:
    """Yield the lengths and angles beside what they measure, those of the ground first.

    Among the others shorter ones come first, so that of two parallel lines the longer is the outer one.
    """
    setting = ground.setting
    unit, size = setting.figure.scene.length_unit, setting.layout.small_size
    for one in sorted(known.dimensions, key=lambda one: _order(setting.figure, one)):
        label = _label(setting, one.written(unit), size, setting.theme.dim, one.symbol, one.about)
        yield tuple((label, spots) for spots in ground.dimension(one, label.size))


def _order(figure: Figure, one: Measurement) -> tuple[bool, float]:
    """Return the key by which dimensions are ordered: the ground's before bodies', shorter ones first."""
    at, head = map(figure.start, one.frame)
    way = abs(head - at) if one.frame[0] != one.frame[1] else 1.0
    return bool(one.own), 0.0 if one.angle else round(way * abs(one.end - one.begin) / figure.extent, 9)
