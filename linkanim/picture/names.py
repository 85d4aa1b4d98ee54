"""Put names and dimensions on a picture: each has one anchor, for the whole period or for a still's pose.

An anchor is a place in the frame of a joint or a bar and a direction away from it, so a label's place is a
function of the pose. `placing` chooses the anchors of all labels together. What finds no faultless place
has a leader in a still; in a moving picture a dimension is listed, and a link's name is left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from functools import cached_property
from itertools import combinations, pairwise
from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Body
from linkanim.mechanics.motion import Motion, Pose
from linkanim.picture.anchors import WAYS, Anchor, Anchors, Paths, Way, pushed, some_of
from linkanim.picture.centres import CROSS, CentrePairs, Centres
from linkanim.picture.dead_centres import DeadCentres
from linkanim.picture.dimensions import AngleArc, MeasureLine, Measurement, Symbols
from linkanim.picture.figure import DOWN, DrawSetting, Figure
from linkanim.picture.fittings import fittings, pedestal_corners, rail_reach, rails_of, rails_under
from linkanim.picture.items import Caption, Halo
from linkanim.picture.motion_marks import Arrows, Sliding, Turning, plain, vector_of
from linkanim.picture.placing import (
    Alternatives,
    Obstacles,
    Size,
    chosen,
    off_lines,
    off_rects,
    weighed,
)
from linkanim.picture.quantities import driven_name
from linkanim.picture.raster import Layer, Loop
from linkanim.picture.shapes import Part, Places, directions, framed, hull, segments, unit, units
from linkanim.picture.text import subscripted
from linkanim.picture.view import Rect
from linkanim.words import name_said

MOMENTS = 48
"""The moments of one turn of the input at which labels are looked at."""
_MOST_MOMENTS = 144
_ROUND = np.exp(-2j * pi * np.arange(16) / 16)
"""The directions from a joint to its letter, in pixels: to the right first, then counter-clockwise."""
_BEST = np.exp(-0.25j * pi)
"""The direction that is taken where all are alike: up and to the right."""
_OFF_RIM, _FARTHEST = 0.1, 1.2
"""The gap from a joint's rim to its letter, and the farthest that the letter's middle is, in heights."""
_TOGETHER = 2.0
"""Joints nearer to each other than this, in heights of their letters, excuse a letter's faults."""
_SURELY = 0.15
"""By how much a letter is nearer to its own joint than to others, in heights."""
_ON_FRAME = 0.35
"""What it costs a letter to turn with a bar, where it could stand upright beside its joint."""
_TOUCHES = 0.5
"""How far a link's name may be from its link, in heights."""
_CROWDED = 0.075
"""The share of the moments at which a link's name may have a fault."""
_ALONG, _ALONG_PLATE = (0.5, 0.4, 0.6, 0.3, 0.7), (0.0, 0.3, 0.5, 0.65)
"""Where along a bar its name may stand; how far from a plate's middle towards its corners and sides."""
_BLOCK = 2.7
"""How far a slider's block extends, in half widths of a bar."""
_TIER, _LEVELS = 1.6, 4
"""The step from one dimension line to the next in heights of their text, and the most on either side."""
_ON_LINE = (0.5, 0.35, 0.65, 0.2, 0.8)
"""Where along a dimension line its value may stand."""
_AT_BAR = 2.5
"""What it costs the length of a bar to stand beside the bar, without a line of its own."""
_ACROSS = 1.2
"""What it costs a dimension line of a still to lie within the outline of the linkage."""
_OFF_LINE = 0.28
"""The gap from a dimension line to its value, in heights."""
_ROOMY, _ON_ARC = (1.0, 1.7, 2.6, 3.6), (0.5, 0.25, 0.75)
"""The radii of an angle's arc in radii of the smallest one, and where along the arc its value may stand."""
_RINGS = (1.3, 2.0, 2.8, 3.8, 5.0)
"""How far off a label with a leader may stand in a still, in heights."""
_SHORTEST = 1.2
"""An arrow that is shorter than this, in heights of its name, has none."""
_HALO = 0.1
"""The width of a halo on each side of a letter's strokes, in heights of the letters."""
_HIGH = 0.94
"""The height of letters, in heights of their line."""
_ROW = 1.3
"""The step from row to row of listed dimensions, in heights of their text."""
_AWAY = 1e7
"""Where things are that are not seen, in pixels."""


@frozen
class Label:
    """A line of text and its anchor; a dimension has the line that is drawn with it.

    `of` is what it names: "joint:A". `tone` is the name of its colour in the theme. In a list it stands with
    the words for what it is `about`. With a `leader` a thin line leads from it to its base.
    """

    text: str
    line: int
    """The height of its line."""
    size: Size
    of: str
    tone: str
    about: str = ""
    anchor: Anchor | None = None
    drawn: MeasureLine | AngleArc | None = None
    leader: bool = False

    @property
    def row(self) -> str:
        """Its row in a list."""
        return f"{self.text}, {self.about}"


@frozen
class Names:
    """The labels of a picture in their places, and those that are `listed` beside it.

    `ways` has the places of the names of arrows, and `rounds` those of instant centres, by what is named.
    """

    labels: tuple[Label, ...] = ()
    listed: tuple[Label, ...] = ()
    ways: Mapping[str, Way] = field(default_factory=dict)
    rounds: Mapping[str, complex] = field(default_factory=dict)

    def captions(self, places: Places, setting: DrawSetting, heads: Sequence[complex] = ()) -> list[Caption]:
        """Return all labels in a pose; of those that arrowheads lie on, none."""
        scale, reach = setting.view.scale, 2.4 * setting.gauge.line
        placed = [
            (label, label.anchor.middle(places, scale, label.size)) for label in self.labels if label.anchor
        ]
        covered = _are_on(
            [_about(middle, label.size) for label, middle in placed], np.array(heads, np.complex128), reach
        )
        return [
            _caption(label, middle, setting)
            for (label, middle), covers in zip(placed, covered, strict=True)
            if not covers
        ]

    def leaders(self, places: Places, setting: DrawSetting) -> list[Layer]:
        """Return the lines from labels to what they name, in a still."""
        lines, scale = [], setting.view.scale
        for label in self.labels:
            if label.leader and label.anchor:
                middle, foot = (
                    label.anchor.middle(places, scale, label.size),
                    label.anchor.foot(places, scale),
                )
                lines.append(_leader(middle, label.size, foot, setting.gauge.bar))
        if not lines:
            return []
        begins, ends = zip(*lines, strict=True)
        return [Layer(setting.theme.dim, segments(begins, ends, 0.6 * setting.gauge.line))]

    def parts(self, setting: DrawSetting) -> dict[str, Part]:
        """Return the dimension lines in a view, by what they measure."""
        parts = {}
        for label in self.labels:
            if label.drawn:
                at, head = map(setting.figure.start, label.drawn.frame)
                one = label.drawn.frame[0] == label.drawn.frame[1]
                span = setting.view.scale * (1.0 if one else abs(head - at))
                parts[label.of] = label.drawn.part(span, setting.gauge, setting.theme.dim)
        return parts

    def measuring(self, known: Symbols | None, unit_: str) -> Names:
        """Return the labels in their places with the present lengths."""
        values = {_of_dimension(one): one.written(unit_) for one in known.dimensions} if known else {}

        def read(labels: Iterable[Label]) -> tuple[Label, ...]:
            return tuple(replace(label, text=values.get(label.of, label.text)) for label in labels)

        return replace(self, labels=read(self.labels), listed=read(self.listed))

    def arrow_names(
        self, kinds: Sequence[Arrows], pose: Pose, taken: Iterable[Rect], setting: DrawSetting
    ) -> list[list[Caption]]:
        """Return the names of a pose's arrows, kind by kind; one that would lie on something is left out.

        That is on pins, on heads, and on what is `taken`.
        """
        figure, line = setting.figure, setting.layout.small_size
        seen = [
            (n, one) for n, kind in enumerate(kinds) for one in kind.seen(pose, setting.view, figure.moving)
        ]
        long = [
            (n, one, of)
            for n, one in seen
            if abs(one.reach) >= _SHORTEST * line and (of := one.of) in self.ways
        ]
        captions: list[list[Caption]] = [[] for _ in kinds]
        if not long:
            return captions
        labels = [_label(setting, one.symbol, line, "", of) for _, one, of in long]
        middles = [
            self.ways[of].middle(one, label.size) for (_, one, of), label in zip(long, labels, strict=True)
        ]
        rects = [_about(middle, label.size) for middle, label in zip(middles, labels, strict=True)]
        busy, heads = [*taken], np.array([one.foot + one.reach for _, one in seen])
        pins = np.array([setting.view.pixel(pose.position[name]) for name in figure.pins])
        covered = zip(
            _are_on(rects, heads, 2.4 * setting.gauge.line),
            _are_on(rects, pins, setting.gauge.pin),
            strict=True,
        )
        room = setting.layout.stage
        for (n, _, _), label, middle, rect, on in zip(long, labels, middles, rects, covered, strict=True):
            covers = any(on) or any(rect.meets(other) for other in busy)
            inside = room.holds(rect.x, rect.y) and room.holds(rect.right, rect.bottom)
            if not covers and (inside or setting.look.framed):
                busy.append(rect)
                colour = kinds[n].colour
                captions[n].append(_caption(label, middle, setting)._replace(colour=colour))
        return captions

    def centre_names(self, centres: Centres, pose: Pose, taken: Iterable[Rect]) -> list[Caption]:
        """Return the names of instant centres: beside their crosses, or behind arrows that lead out.

        One that would lie on a pin, or on what is `taken`, is left out.
        """
        setting, line, busy, captions = centres.setting, centres.setting.layout.small_size, [*taken], []
        kept = {label.of for label in self.labels}
        pins = np.array([setting.view.pixel(pose.position[name]) for name in setting.figure.pins])
        for seen in centres.seen(pose):
            label = _label(setting, seen.label, line, "warning", f"centre:{plain(seen.label)}")
            if seen.jointed or (label.of in kept and not seen.direction):
                continue
            way = self.rounds.get(label.of, complex(_BEST))
            if seen.direction:
                foot = seen.at - centres.arrow * seen.direction
                middle = foot + pushed(-seen.direction, 0.2 * line, label.size, True)
            else:
                middle = seen.at + pushed(way, centre_gap(setting), label.size, False)
            rect = _about(middle, label.size)
            room = setting.layout.stage
            inside = room.holds(rect.x, rect.y) and room.holds(rect.right, rect.bottom)
            if (
                inside
                and not any(rect.meets(one) for one in busy)
                and not _are_on([rect], pins, setting.gauge.pin)[0]
            ):
                busy.append(rect)
                captions.append(_caption(label, middle, setting))
        return captions


def _caption(label: Label, middle: complex, setting: DrawSetting) -> Caption:
    """Return a label about a place."""
    at = middle.real, middle.imag - 0.5 * label.line
    colour = getattr(setting.theme, label.tone) if label.tone else setting.theme.ink
    return Caption(label.text, at, label.line, colour, "centre", True, halo_of(setting, label.line), label.of)


def halo_of(setting: DrawSetting, line: int) -> Halo:
    """Return the halo that sets letters of a height off from what is below."""
    return Halo(setting.theme.background, max(round(_HALO * line * 4) / 4, 1.5))


def _about(middle: complex, size: Size) -> Rect:
    """Return the rectangle of a size about a place."""
    return Rect(middle.real - size[0] / 2, middle.imag - size[1] / 2, *size)


def _bounds(points: Loop) -> Rect:
    """Return the rectangle that holds points x + yi."""
    x, y = points.real, points.imag
    left, top = float(x.min()), float(y.min())
    return Rect(left, top, float(x.max()) - left, float(y.max()) - top)


def _are_on(rects: Sequence[Rect], points: Loop, reach: float) -> list[bool]:
    """Return for each rectangle whether any of some points is within a reach of it."""
    if not (len(rects) and len(points)):
        return [False] * len(rects)
    middle = np.array([rect.middle for rect in rects], np.complex128)[:, None]
    wide, high = (np.array(sides)[:, None] / 2 for sides in zip(*(rect[2:] for rect in rects), strict=True))
    x, y = np.abs(points.real - middle.real), np.abs(points.imag - middle.imag)
    off = np.hypot(np.maximum(x - wide, 0.0), np.maximum(y - high, 0.0))
    return [bool(on.any()) for on in off < reach]


def _leader(middle: complex, size: Size, foot: complex, bar: float) -> tuple[complex, complex]:
    """Return the ends of the line that leads from a label to what it names: at its edge, and at the rim."""
    begin = _about(middle, size).nearest(foot)
    way = foot - begin
    return begin, foot - bar * unit(way) if abs(way) > bar else foot


def _label(setting: DrawSetting, text: str, line: int, tone: str, of: str, about: str = "") -> Label:
    """Return a line of text that has no place yet."""
    wide = setting.type.width(text, line, strong=True)
    return Label(text, line, (float(wide), _HIGH * line), of, tone, about)


def _of_dimension(one: Measurement) -> str:
    return f"dimension:{plain(one.symbol)}"


class _Wanted(NamedTuple):
    """A label with all anchors that it may have, its rules, and the lines drawn with each anchor."""

    label: Label
    families: tuple[Anchors, ...]
    choice: Alternatives
    drawn: tuple[MeasureLine | AngleArc, ...] = ()

    def at(self, which: int) -> Label:
        """Return the label at one of its anchors."""
        drawn = self.drawn[which] if self.drawn else None
        drawn = drawn if isinstance(drawn, AngleArc) or (drawn and drawn.reach) else None
        for family in self.families:
            if which < len(family.way):
                return replace(self.label, anchor=family.picked(which), drawn=drawn)
            which -= len(family.way)
        raise IndexError(which)


def names_of(
    setting: DrawSetting,
    symbols: Symbols | None,
    turning: Turning | Sliding | None,
    dead_centres: DeadCentres | None,
    arrows: Sequence[Arrows],
    moment: float | None,
) -> Names:
    """Choose the anchors of all names for the period, or for the pose at one `moment`.

    Where symbols are known, there are dimensions and the input's angle, too.
    """
    return _Labelling(setting, symbols, turning, dead_centres, tuple(arrows), moment).names()


@frozen
class _Labelling:
    """All that is named on a picture, and what is in the way of names."""

    setting: DrawSetting
    symbols: Symbols | None
    turning: Turning | Sliding | None
    dead_centres: DeadCentres | None
    arrows: tuple[Arrows, ...]
    moment: float | None

    def names(self) -> Names:
        """Choose all anchors; links have their names where each has a place for it, else their numbers."""
        arrows = self._wanted_arrows()
        others = [*self._wanted_joints(), *self._wanted_dimensions(), *self._wanted_words()]
        moving = [*self._wanted_centres()]
        others += moving
        known = [weighed(one.choice, self.ground) for one in others]
        arrowed = [weighed(choice, self.ground) for _, choice in arrows]
        for called in self._called:
            links = list(self._links_called(called))
            weights = [weighed(one.choice, self.ground) for one in links]
            if called is not self._called[-1] and not all(one.has_place for one in weights):
                continue
            wanted = [*others, *links]
            which = chosen([*known, *weights, *arrowed])
            if None not in which[len(others) : len(wanted)]:
                break
        placed = [one.at(n) for one, n in zip(wanted, which, strict=False) if n is not None]
        unplaced = [one for one, n in zip(wanted, which, strict=False) if n is None]
        ways = {of: WAYS[n] for (of, _), n in zip(arrows, which[len(wanted) :], strict=True) if n is not None}
        if self.moment is not None and unplaced:
            led, unplaced = self._led(unplaced, placed)
            placed += led
        free = {one.label.of for one in moving} if self.moment is None else set()
        rounds = {label.of: label.anchor.way for label in placed if label.of in free and label.anchor}
        kept = tuple(label for label in placed if label.of not in free)
        listed = sorted((one.label for one in unplaced if one.label.about), key=_index)
        return Names(kept, tuple(listed), ways, rounds)

    # What moves, and what is in the way.

    @cached_property
    def motion(self) -> Motion:
        """The motion at the moments that are looked at."""
        figure = self.setting.figure
        if self.moment is not None:
            return figure.scene.solve(phase=np.array([self.moment]))
        return figure.cycle

    @cached_property
    def step(self) -> int:
        """Every which of the cycle's phases is looked at."""
        figure = self.setting.figure
        if self.moment is not None:
            return 1
        turns = max(round(figure.scene.period / (2 * pi)), 1)
        return max(len(figure.cycle.phase) // min(MOMENTS * turns, _MOST_MOMENTS), 1)

    def _pixels(self, points: NDArray[np.float64]) -> Loop:
        """Return pixels at the moments, for points of the scene at all of the motion's phases."""
        view = self.setting.view
        pixels = view.x + 1j * view.y + view.scale * (np.atleast_2d(points)[:: self.step] @ DOWN)
        return np.where(np.isfinite(pixels), pixels, -_AWAY)

    @cached_property
    def paths(self) -> Paths:
        """Where the joints are."""
        joints = (joint.name for joint in self.setting.figure.linkage.joints)
        places = {name: self._pixels(self.motion.position[name]) for name in joints}
        count = len(next(iter(places.values())))
        return Paths(
            {name: np.broadcast_to(path, (count,)) for name, path in places.items()},
            self.setting.view.scale,
            count,
        )

    def _stack(self, pairs: Sequence[tuple[Loop, Loop]]) -> Loop:
        """Return lines with ends on paths, as (n, lines, begin and end)."""
        if not pairs:
            return np.zeros((1, 0, 2), np.complex128)
        count = self.paths.moments
        return np.stack(
            [np.stack([np.broadcast_to(end, (count,)) for end in pair], axis=1) for pair in pairs], axis=1
        )

    @cached_property
    def links(self) -> tuple[tuple[frozenset[str], Loop], ...]:
        """The links, springs and dampers: the joints of each, and its axis or its sides (n, sides, 2)."""
        figure, places = self.setting.figure, self.paths.places
        links = []
        for body in figure.bodies:
            corners = self._corners(body)
            ring = [*corners, corners[0]] if len(corners) > 2 else corners
            sides = [(places[one], places[other]) for one, other in pairwise(ring)]
            links.append((frozenset(body.joints), self._stack(sides)))
        for strut in figure.struts:
            ends = [(places[strut.between[0]], places[strut.between[1]])]
            links.append((frozenset(strut.between), self._stack(ends)))
        return tuple(links)

    def _corners(self, body: Body) -> list[str]:
        """Return the joints at the corners of a body's outline, in their order round it."""
        starts = {complex(self.paths.places[name][0]): name for name in reversed(body.joints)}
        corners = [starts[corner] for corner in hull(list(starts))]
        return corners if len(corners) > 1 else [*body.joints[:2]]

    @cached_property
    def ground(self) -> Obstacles:
        """What labels keep off."""
        setting, figure, places = self.setting, self.setting.figure, self.paths.places
        gauge = setting.gauge
        pins = list(dict.fromkeys((*figure.pins, *figure.scene.trace)))
        discs = np.stack([places[name] for name in pins], axis=1) if pins else np.zeros((1, 0), np.complex128)
        lines, halves = self._heads()
        bars, thick = self._soft()
        inside = setting.layout.stage
        radii = np.full(len(pins), gauge.pin + gauge.outline + 1.0)
        none = np.zeros((1, 0), np.complex128), np.zeros((0, 2))
        return Obstacles(inside, *none, discs, radii, lines, halves, bars, thick)

    def _heads(self) -> tuple[Loop, NDArray[np.float64]]:
        """Return what is kept clear: arrowheads, and lines that stand still."""
        gauge = self.setting.gauge
        pairs, halves = list[tuple[Loop, Loop]](), list[float]()
        for kind in self.arrows:
            for _, foot, reach in self._seen(kind):
                head = foot + reach
                long = np.minimum(np.abs(reach), 9.0 * gauge.line)
                pairs.append((head - long * units(reach), head))
                halves.append(3.2 * gauge.line + 1.0)
        for points, half, is_head in self._input_marks:
            for n in range(points.shape[1] - 1 if is_head else 0):
                pairs.append((points[:, n], points[:, n + 1]))
                halves.append(half)
        for begin, end in self.dead_centres.ticks if self.dead_centres else ():
            pairs.append((np.array([begin]), np.array([end])))
            halves.append(gauge.line)
        for cross in self._crosses():
            for arm in (CROSS * gauge.bar, 1j * CROSS * gauge.bar):
                pairs.append((cross - arm, cross + arm))
                halves.append(gauge.line)
        return self._stack(pairs), np.array(halves)

    @cached_property
    def _input_marks(self) -> tuple[tuple[Loop, float, bool], ...]:
        """The marks of the input's motion and of its angle."""
        if not self.turning:
            return ()
        rates = np.broadcast_to(self.motion.coordinate_rate, np.shape(self.motion.phase))[:: self.step]
        return tuple(self.turning.tracks(self.paths.places, rates, angled=self.symbols is not None))

    def _soft(self) -> tuple[Loop, NDArray[np.float64]]:
        """Return what may be covered, but rather not: links, blocks, the ground, guides and curves."""
        setting, gauge = self.setting, self.setting.gauge
        pairs, halves = list[tuple[Loop, Loop]](), list[float]()
        for _, sides in self.links:
            for n in range(sides.shape[1]):
                pairs.append((sides[:, n, 0], sides[:, n, 1]))
                halves.append(gauge.bar)
        for points, half, is_head in self._input_marks:
            for n in range(0 if is_head else points.shape[1] - 1):
                pairs.append((points[:, n], points[:, n + 1]))
                halves.append(half)
        for name in setting.figure.fixed:
            corners = pedestal_corners(setting, name)
            for one, other in pairwise((*corners, corners[0])):
                pairs.append((np.array([one]), np.array([other])))
                halves.append(gauge.line)
        for loops in (*rails_of(setting), *rails_under(setting)):
            ring = framed(np.concatenate(loops)).tolist()
            for one, other in pairwise((*ring, ring[0])):
                pairs.append((np.array([one]), np.array([other])))
                halves.append(gauge.line)
        for fitting in fittings(setting):
            for part in (*fitting.behind, *fitting.before):
                block = framed(np.concatenate(part.layers[0].loops))
                span = self.paths.places[part.head] - self.paths.places[part.tail]
                turned = (
                    self.paths.places[part.at][:, None]
                    + (units(span) if part.head != part.tail else np.ones(1))[:, None] * block
                )
                pairs.append(((turned[:, 0] + turned[:, 3]) / 2, (turned[:, 1] + turned[:, 2]) / 2))
                halves.append(float(abs(block[3] - block[0])) / 2)
        for joint in setting.figure.scene.trace if setting.look.trace or setting.look.ink else ():
            path = setting.figure.path(joint, setting.view)
            ring = path[:: max(len(path) // 36, 1)]
            pairs += [(ring[n : n + 1], np.roll(ring, -1)[n : n + 1]) for n in range(len(ring))]
            halves += [gauge.line] * len(ring)
        return self._stack(pairs), np.array(halves)

    def _seen(self, kind: Arrows) -> Iterator[tuple[str, Loop, Loop]]:
        """Yield each arrow of a kind over the moments: its symbol, foot and reach in pixels."""
        return (
            (symbol, self._pixels(place), np.nan_to_num(np.atleast_2d(reach)[:: self.step] @ DOWN))
            for symbol, place, reach in kind.paths(self.motion, self.setting.figure.moving)
        )

    def _crosses(self) -> Iterator[Loop]:
        """Yield the places of instant centres outside joints at the moments; far away where there is none."""
        return (path for _, path in self._centre_paths)

    @cached_property
    def _centre_paths(self) -> tuple[tuple[str, Loop], ...]:
        """The instant centres outside joints by their names, at the moments; far away where not seen."""
        if not self.setting.look.centres:
            return ()
        crosses = Centres(self.setting).crosses(self.motion, self.step)
        return tuple((name, np.where(np.isfinite(path), path, -_AWAY)) for name, path in crosses.items())

    # Labels, and where each may stand.

    def _wanted(
        self,
        label: Label,
        families: Sequence[Anchors],
        *,
        middles: Loop | None = None,
        faults: NDArray[np.bool_] | None = None,
        excused: NDArray[np.bool_] | None = None,
        most: float = 0.0,
        drawn: Sequence[MeasureLine | AngleArc] = (),
    ) -> _Wanted:
        if middles is None:
            middles = self._middles(label.size, families)
        price = np.concatenate([family.price for family in families])
        lines = None
        if drawn:
            tracks = {
                id(line): line.tracks(*self.paths.frame(*line.frame), self.setting.gauge) for line in drawn
            }
            lines = np.stack([tracks[id(line)] for line in drawn], axis=1)
        gap = 0.7 * label.line if drawn else 0.0
        # a dimensioned still is there for its dimensions; in motion, letters stand nearest to what they name
        rank = (
            0 if bool(drawn) == (self.moment is not None) and (drawn or label.of.startswith("joint")) else 1
        )
        choice = Alternatives(
            label.size, middles, price, faults, lines, excused, most, gap, rank, bool(drawn)
        )
        return _Wanted(label, tuple(families), choice, tuple(drawn))

    def _middles(self, size: Size, families: Sequence[Anchors]) -> Loop:
        """Return the middles of a label of a size at all anchors of some families (n moments, k)."""
        return np.concatenate([family.middles(self.paths, size) for family in families], axis=1)

    def _wanted_joints(self) -> Iterator[_Wanted]:
        """Yield the joints' letters, each nearer to its own joint than to any other."""
        setting, figure, places = self.setting, self.setting.figure, self.paths.places
        if not setting.look.joints_named and not setting.look.centres:
            return
        centred = CentrePairs(figure).at_joints if setting.look.centres else {}
        apart = _apart_from([*places], places)
        small = setting.layout.small_size
        for name in figure.lettered:
            if name in centred:
                label = _label(setting, ", ".join(centred[name]), small, "warning", f"centre:{name}")
                families, middles = self._round(name, label.size, small)
                yield self._wanted(label, families, middles=middles, most=_CROWDED)
            if not setting.look.joints_named:
                continue
            line = setting.layout.label_size
            label = _label(setting, subscripted(name), line, "ink", f"joint:{name}")
            families, middles = self._round(name, label.size, line)
            faults, own = np.zeros(middles.shape, np.bool_), np.abs(middles - places[name][:, None])
            for other in apart[name]:
                faults |= np.abs(middles - places[other][:, None]) <= own + _SURELY * line
            near = [np.abs(places[other] - places[name]) < _TOGETHER * line for other in apart[name]]
            excused = np.any(near, axis=0) if near and self.moment is None else None
            most = 1.0 if self.moment is None else 0.0
            yield self._wanted(label, families, middles=middles, faults=faults, excused=excused, most=most)

    def _round(self, name: str, size: Size, line: int) -> tuple[list[Anchors], Loop]:
        """Return the anchors of a joint's letter, and its middles at them (n moments, k).

        They are round it in the ground's frame, and in that of each bar.
        """
        setting = self.setting
        gap, bar = _OFF_RIM * line, setting.gauge.bar + setting.gauge.outline
        radii = [bar + gap, bar + 0.35 * line, bar + 0.65 * line]
        if setting.figure.linkage.joint(name).travels:
            block = max(_BLOCK * setting.gauge.bar, rail_reach(setting, name) + setting.gauge.bar)
            radii += [block + gap] if block < bar + line else []
        turned = 0.02 * np.abs(np.angle(_ROUND / _BEST))
        anchors, places = list[Anchors](), list[Loop]()
        frames = [(name, name)]
        if self.moment is None:
            frames += [
                (name, other)
                for joints, _ in self.links
                if name in joints
                for other in sorted(joints)
                if other != name
            ]
        for n, (at, head) in enumerate(frames):
            way, count = np.tile(_ROUND, len(radii)), len(_ROUND)
            price = (
                np.tile(turned, len(radii))
                + np.repeat(0.15 * np.arange(len(radii)), count)
                + (_ON_FRAME if n else 0.0)
            )
            reach = np.repeat(radii, count)
            family = Anchors(at, head, np.zeros(len(way), np.complex128), way, reach, price, turns=bool(n))
            middles = family.middles(self.paths, size)
            far = np.abs(middles - self.paths.places[name][:, None]).max(axis=0)
            rim = np.where(reach > bar + line, radii[-1] - gap, bar)
            near = far <= rim + max(_FARTHEST * line, 0.5 * size[0] + 0.2 * line)
            if near.any():
                anchors.append(some_of(family, near))
                places.append(middles[:, near])
        return anchors, np.concatenate(places, axis=1)

    @cached_property
    def _called(self) -> list[Mapping[Body, str]]:
        """What links may be called: all by name, or all by number; bodies that share a number by name."""
        look, figure = self.setting.look, self.setting.figure
        if look.centres:
            return [{body: number for number, body in figure.by_number.items() if body}]
        if not look.names:
            return [{}]
        named = {body: name_said(figure.links[body]) for body in figure.numbers}
        shared = len({*figure.numbers.values()}) < len(figure.numbers)
        return [named] if shared or named == figure.numbers else [named, figure.numbers]

    def _links_called(self, called: Mapping[Body, str]) -> Iterator[_Wanted]:
        setting, line = self.setting, self.setting.layout.small_size
        for body, words in called.items():
            label = _label(setting, words, line, "ink", f"body:{body.name or words}")
            if body.slider:
                families = self._by_block(body.slider, label.size, line)
                own = self.paths.places[body.slider]
                near = setting.gauge.bar * _BLOCK
                yield self._link(label, families, own[:, None, None].repeat(2, axis=2), None, near)
            elif len(body.joints) > 1:
                joints = frozenset(body.joints)
                sides = next(sides for names, sides in self.links if names == joints)
                yield self._link(label, self._on_link(body, label, line), sides, joints, setting.gauge.bar)

    def _link(
        self, label: Label, families: list[Anchors], own: Loop, joints: frozenset[str] | None, half: float
    ) -> _Wanted:
        """Return a link's name, which no other link is nearer to and which touches its own."""
        middles = self._middles(label.size, families)
        off = off_lines(middles, own).min(axis=2)
        touch = off_rects(middles, label.size, own).min(axis=2) - half
        inside = _inside(middles, own) if own.shape[1] > 2 else np.zeros(middles.shape, np.bool_)
        off = np.where(inside, 0.0, off)
        faults = ~inside & (touch > _TOUCHES * label.line)
        near = _bounds(middles).inset(-max(float(off.max()), self.setting.gauge.bar))
        for (names, sides), bounds in zip(self.links, self._reaches, strict=True):
            if names != joints and near.meets(bounds):
                other = off_lines(middles, sides).min(axis=2)
                if sides.shape[1] > 2:
                    other = np.where(_inside(middles, sides), 0.0, other)
                else:  # in a plate, but on a bar before it: it would name that
                    faults |= inside & (other < self.setting.gauge.bar)
                faults |= other < off - 0.5
        most = _CROWDED if self.moment is None else 0.0
        return self._wanted(label, families, middles=middles, faults=faults, most=most)

    @cached_property
    def _reaches(self) -> list[Rect]:
        """The rectangles that links pass."""
        return [_bounds(sides).inset(-1.0) for _, sides in self.links]

    def _on_link(self, body: Body, label: Label, line: int) -> list[Anchors]:
        """Return the anchors of a link's name: beside its bar and on it, or in its plate and beside that."""
        corners, setting = self._corners(body), self.setting
        first, second = body.joints[:2]
        starts = {name: complex(self.paths.places[name][0]) for name in body.joints}
        span = starts[second] - starts[first]
        local = {name: (place - starts[first]) / span if span else 0j for name, place in starts.items()}
        reach, word = setting.gauge.bar + setting.gauge.outline + 0.1 * line, len(label.text) > 2
        if len(corners) > 2:
            ring = [local[name] for name in corners]
            middle = sum(ring) / len(ring)
            ends = [*ring, *((one + other) / 2 for one, other in pairwise((*ring, ring[0])))]
            base = np.array(
                [middle, *(middle + share * (end - middle) for share in _ALONG_PLATE[1:] for end in ends)]
            )
            price = np.concatenate([[0.0], np.repeat(0.2 * np.array(_ALONG_PLATE[1:]), len(ends))])
            within = Anchors(first, second, base, np.zeros_like(base), np.zeros(len(base)), price)
            return [
                within,
                *(
                    self._beside(first, second, pair, reach, 0.4, out=middle)
                    for pair in pairwise((*ring, ring[0]))
                ),
            ]
        axis = (local[corners[0]], local[corners[1]])
        base = np.array([axis[0] + share * (axis[1] - axis[0]) for share in _ALONG])
        on = Anchors(
            first,
            second,
            base,
            np.zeros_like(base),
            np.zeros(len(base)),
            (0.25 if word else 0.0) + 0.2 * np.abs(np.array(_ALONG) - 0.5),
        )
        return [on, self._beside(first, second, axis, reach, 0.0 if word else 0.25)]

    def _beside(
        self,
        at: str,
        head: str,
        axis: tuple[complex, complex],
        reach: float,
        price: float,
        *,
        out: complex | None = None,
    ) -> Anchors:
        """Return anchors beside a line in a frame, on both sides or on the side off a point `out` of it."""
        along = axis[1] - axis[0]
        normal = 1j * unit(along)
        sides = [normal, -normal]
        if out is not None:
            sides = [max(sides, key=lambda side: (((axis[0] + axis[1]) / 2 - out) * side.conjugate()).real)]
        base, way, cost = (
            np.array(part)
            for part in zip(
                *(
                    (axis[0] + share * along, side, price + 0.2 * abs(share - 0.5))
                    for side in sides
                    for share in _ALONG
                ),
                strict=True,
            )
        )
        return Anchors(at, head, base, way, np.full(len(base), reach), cost, flat=True, turns=True)

    def _by_block(self, name: str, size: Size, line: int) -> list[Anchors]:
        """Return the anchors of the name of a slider's block: on the block, and round it."""
        setting = self.setting
        radius = max(_BLOCK * setting.gauge.bar, rail_reach(setting, name) + setting.gauge.bar) + 0.1 * line
        reach = np.full(len(_ROUND), radius)
        price = 0.02 * np.abs(np.angle(_ROUND / _BEST))
        return [Anchors(name, name, np.zeros(len(_ROUND), np.complex128), _ROUND, reach, price)]

    def _wanted_dimensions(self) -> Iterator[_Wanted]:
        """Yield the dimensions, shorter ones first, and the input's angle."""
        if not self.symbols:
            return
        setting, figure = self.setting, self.setting.figure
        unit_, line = figure.scene.length_unit, setting.layout.small_size
        if isinstance(self.turning, Turning):
            symbol, size, scene = self.symbols.input, setting.layout.label_size, figure.scene
            about = driven_name(scene)
            label = _label(setting, symbol, size, "dim", f"angle:{plain(symbol)}", about)
            yield self._by_arc(label, self.turning)
        for one in sorted(self.symbols.dimensions, key=lambda one: _order(figure, one)):
            label = _label(setting, one.written(unit_), line, "dim", _of_dimension(one), one.about)
            yield self._by_angle(label, one) if one.angle else self._by_line(label, one)

    def _by_line(self, label: Label, one: Measurement) -> _Wanted:
        """Return a length with its lines in rows on both sides, its value on each line's outer side."""
        setting, line = self.setting, label.line
        at, head = one.frame
        along = one.end - one.begin
        normal = 1j * unit(along)
        low = 2.0 * setting.gauge.bar + 0.45 * line
        low += 2.6 * setting.gauge.bar if not one.own else 0.0
        families, drawn = [], list[MeasureLine | AngleArc]()
        levels, shares = (_LEVELS, _ON_LINE) if self.moment is not None else (2, _ON_LINE[:3])
        for level in range(levels):
            for side in (1.0, -1.0):
                reach = low + level * _TIER * line
                measure = MeasureLine(one.frame, one.begin, one.end, side * reach)
                base = np.array([one.begin + share * along for share in shares])
                way = np.full(len(shares), side * normal)
                price = 0.3 * level + 0.6 * np.abs(np.array(shares) - 0.5)
                families.append(
                    Anchors(
                        at,
                        head,
                        base,
                        way,
                        np.full(len(base), reach + _OFF_LINE * line),
                        price,
                        flat=True,
                        turns=at != head,
                    )
                )
                drawn += [measure] * len(shares)
        if one.bare:
            at_bar = self._beside(at, head, (one.begin, one.end), setting.gauge.bar + 0.2 * line, _AT_BAR)
            families.append(at_bar)
            drawn += [MeasureLine(one.frame, one.begin, one.begin, 0.0)] * len(at_bar.way)
        wanted = self._wanted(label, families, drawn=drawn)
        return wanted._replace(
            choice=wanted.choice._replace(price=wanted.choice.price + self._across(wanted.choice.lines))
        )

    def _across(self, lines: Loop | None) -> NDArray[np.float64]:
        """Return what it costs dimension lines (n, k, m, 2) to run across links."""
        assert lines is not None
        begin, end = lines[:, :, 0, 0], lines[:, :, 0, 1]
        points = [begin + share * (end - begin) for share in (0.1, 0.3, 0.5, 0.7, 0.9)]
        cost = np.zeros(begin.shape[1])
        if self.moment is not None:
            joints = [complex(self.paths.places[name][0]) for name in self.setting.figure.in_view]
            corners = np.array(hull(joints))
            ring = np.stack([corners, np.roll(corners, -1)], axis=1)[None]
            for point in points if len(corners) > 2 else ():
                cost += _ACROSS / len(points) * _inside(point, ring).mean(axis=0)
        if self.links:
            sides = np.concatenate([sides for _, sides in self.links], axis=1)
            first = np.cumsum([0, *(sides.shape[1] for _, sides in self.links)])[:-1]
            for point in points:
                off = np.minimum.reduceat(off_lines(point, sides), first, axis=2)
                cost += 0.2 * (off < 1.5 * self.setting.gauge.bar).mean(axis=0).sum(axis=-1)
        return cost

    def _by_angle(self, label: Label, one: Measurement) -> _Wanted:
        """Return an angle with arcs of several radii, its value outside each."""
        line = label.line
        smallest = 2.4 * self.setting.gauge.bar + 0.6 * line
        families, drawn = [], list[MeasureLine | AngleArc]()
        ways = directions(np.angle(one.begin) + np.angle(one.end / one.begin) * np.array(_ON_ARC))
        for n, share in enumerate(_ROOMY):
            radius = share * smallest
            price = 0.3 * n + 0.6 * np.abs(np.array(_ON_ARC) - 0.5)
            reach = np.full(len(ways), radius + 0.2 * line)
            at, head = one.frame
            families.append(
                Anchors(at, head, np.zeros(len(ways), np.complex128), ways, reach, price, turns=at != head)
            )
            drawn += [AngleArc(one.frame, one.begin, one.end, radius)] * len(ways)
        return self._wanted(label, families, drawn=drawn)

    def _by_arc(self, label: Label, turning: Turning) -> _Wanted:
        """Return the input's angle outside its arc, best at the arc's middle."""
        bars = np.angle(np.conj(self.paths.places[turning.pin] - self.paths.places[turning.pivot]))
        turns = self.setting.figure.scene.info.full_turn and self.moment is None
        middle = pi / 6 if turns else float(turning.turned(bars).mean()) / 2
        ways = np.exp(-1j * (middle + np.linspace(-0.8, 0.8, 9)))
        gap = turning.arc + 0.12 * label.line
        reach = np.concatenate([np.full(9, gap), np.full(9, gap + 0.6 * label.line)])
        price = np.concatenate([np.abs(np.linspace(-0.3, 0.3, 9)) + 0.4 * n for n in range(2)])
        family = Anchors(
            turning.pivot, turning.pivot, np.zeros(18, np.complex128), np.tile(ways, 2), reach, price
        )
        return self._wanted(label, [family], most=_CROWDED)

    def _wanted_words(self) -> Iterator[_Wanted]:
        """Yield the words at a slider's dead centres, each at its tick."""
        if not self.dead_centres:
            return
        setting, view = self.setting, self.setting.view
        name = next(iter(setting.figure.linkage.pins)).name
        origin = self.paths.places[name][0]
        for n, (text, foot, places) in enumerate(self.dead_centres.words()):
            label = _label(setting, text, setting.layout.small_size, "dim", f"dead-centre:{n + 1}")
            off = places(label.size) - foot
            way = units(off)
            reach = np.abs(off) - (np.abs(way.real) * label.size[0] + np.abs(way.imag) * label.size[1]) / 2
            base = np.full(len(off), (foot - origin) / view.scale)
            family = Anchors(name, name, base, way, reach, _rising(len(off), 0.3), flat=True)
            yield self._wanted(label, [family])

    def _wanted_centres(self) -> Iterator[_Wanted]:
        """Yield the names of instant centres outside joints, round their crosses."""
        setting, line = self.setting, self.setting.layout.small_size
        pin = next(iter(setting.figure.linkage.pins)).name
        for name, path in self._centre_paths:
            label = _label(setting, name, line, "warning", f"centre:{plain(name)}")
            reach = np.full(len(_ROUND), centre_gap(setting))
            price = 0.02 * np.abs(np.angle(_ROUND / _BEST))
            excused = path.real < -_AWAY / 2
            if self.moment is not None:
                if not excused.any():
                    base = np.full(
                        len(_ROUND), (path[0] - self.paths.places[pin][0]) / self.setting.view.scale
                    )
                    yield self._wanted(label, [Anchors(pin, pin, base, _ROUND, reach, price)])
                continue
            family = Anchors(pin, pin, np.zeros(len(_ROUND), np.complex128), _ROUND, reach, price)
            middles = family.middles(self.paths, label.size) - self.paths.places[pin][:, None] + path[:, None]
            choice = Alternatives(label.size, middles, price, None, None, excused, 1.0)
            yield _Wanted(label, (family,), choice)

    def _wanted_arrows(self) -> list[tuple[str, Alternatives]]:
        """Return the places of the names of arrows, by what they name."""
        wanted, line = [], self.setting.layout.small_size
        for kind in self.arrows:
            for number, (symbol, foot, reach) in enumerate(self._seen(kind)):
                size = _label(self.setting, symbol, line, "", "").size
                hidden = np.abs(reach) < _SHORTEST * line
                columns = [
                    np.where(hidden, -_AWAY * (2 + number), way.middles(foot, reach, size)) for way in WAYS
                ]
                price = _rising(len(WAYS), 0.1)
                most = 0.5 if self.moment is None else 0.0
                choice = Alternatives(size, np.stack(columns, axis=1), price, None, None, hidden, most)
                if not hidden.all():
                    wanted.append((vector_of(symbol), choice))
        return wanted

    def _led(self, unplaced: Sequence[_Wanted], placed: Sequence[Label]) -> tuple[list[Label], list[_Wanted]]:
        """Give labels of a still without a place one farther off, with a leader; return those still without.

        A dimension without a place is listed instead.
        """
        led, rest = list[Label](), list[_Wanted]()
        places = {name: complex(path[0]) for name, path in self.paths.places.items()}
        scale = self.setting.view.scale
        rects = [
            (label.anchor.middle(places, scale, label.size), label.size) for label in placed if label.anchor
        ]
        ground, bar = self.ground, self.setting.gauge.bar
        for label in placed:
            if label.drawn:
                track = label.drawn.tracks(*self.paths.frame(*label.drawn.frame), self.setting.gauge)
                ground = ground._replace(
                    lines=np.concatenate([ground.lines, track], axis=1),
                    halves=np.append(ground.halves, np.ones(track.shape[1])),
                )
        for one in unplaced:
            if one.label.about or one.label.of.startswith("dead-centre"):
                rest.append(one)
                continue
            base = one.families[0]
            line = one.label.line
            way = np.tile(_ROUND, len(_RINGS))
            reach = np.repeat(np.array(_RINGS) * line + bar, len(_ROUND))
            family = Anchors(
                base.at,
                base.head,
                np.full(len(way), base.base[0]),
                way,
                reach,
                np.repeat(0.3 * np.arange(len(_RINGS)), len(_ROUND))
                + 0.01 * np.tile(np.abs(np.angle(_ROUND / _BEST)), len(_RINGS)),
            )
            middles = family.middles(self.paths, one.label.size)
            foot = complex(family.feet(self.paths)[0, 0])
            lines = np.array(
                [[[_leader(complex(middle), one.label.size, foot, bar)] for middle in middles[0]]]
            )
            choice = Alternatives(one.label.size, middles, family.price, None, lines)
            taken = ground._replace(
                rects=np.array([[at for at, _ in rects]]),
                sizes=np.array([size for _, size in rects]).reshape(-1, 2),
            )
            which = chosen([choice], taken)[0]
            if which is None:
                rest.append(one)
                continue
            led.append(replace(one.label, anchor=family.picked(which), leader=True))
            rects.append((complex(middles[0, which]), one.label.size))
            ground = ground._replace(
                lines=np.concatenate([ground.lines, lines[:, which]], axis=1),
                halves=np.append(ground.halves, 1.0),
            )
        return led, rest


def _index(label: Label) -> tuple[int, str]:
    """Return the key by which dimensions are listed: the number of their symbol, then its letter."""
    digits = "".join(char for char in label.of if char.isdecimal())
    return int(digits or 0), label.of


def _rising(count: int, step: float) -> NDArray[np.float64]:
    """Return prices of places, the best first."""
    return np.asarray(step * np.arange(count), np.float64)


def centre_gap(setting: DrawSetting) -> float:
    """Return how far from a centre its name begins, in pixels."""
    return CROSS * setting.gauge.bar + 2.0


def _apart_from(names: Sequence[str], places: Mapping[str, Loop]) -> dict[str, list[str]]:
    """Return for each joint the others that do not always lie where it does."""
    others: dict[str, list[str]] = {name: [] for name in names}
    for one, other in combinations(names, 2):
        if np.abs(places[one] - places[other]).max() > 0.5:
            others[one].append(other)
            others[other].append(one)
    return others


def _inside(points: Loop, sides: Loop) -> NDArray[np.bool_]:
    """Return whether points (n, k) lie in a polygon given by its sides (n, m, 2), by the even-odd rule."""
    x, y = points.real[:, :, None], points.imag[:, :, None]
    begin, end = sides[:, None, :, 0], sides[:, None, :, 1]
    spans = (begin.imag > y) != (end.imag > y)
    rise = np.where(end.imag == begin.imag, 1.0, end.imag - begin.imag)
    crosses = spans & (x < begin.real + (y - begin.imag) / rise * (end.real - begin.real))
    return np.asarray(crosses.sum(axis=2) % 2 == 1)


def _order(figure: Figure, one: Measurement) -> tuple[bool, float]:
    """Return the key by which dimensions are ordered: the ground's before bodies', shorter ones first."""
    at, head = map(figure.start, one.frame)
    way = abs(head - at) if one.frame[0] != one.frame[1] else 1.0
    return bool(one.own), 0.0 if one.angle else round(way * abs(one.end - one.begin) / figure.extent, 9)
