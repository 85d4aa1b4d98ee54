"""Draw instant centres, and the curves on which they run: the fixed and the moving centrode."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import combinations
from typing import NamedTuple

import numpy as np

from linkanim.frozen import frozen
from linkanim.mechanics.centres import (
    Centre,
    KennedyStep,
    centre,
    centre_path,
    centrodes,
    joint_between,
    kennedy,
    touch,
)
from linkanim.mechanics.measures import coupler_body
from linkanim.mechanics.motion import Motion, Pose
from linkanim.picture.chart import runs_of
from linkanim.picture.figure import DrawSetting, Figure
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import Places, arrows, dashes, segments, stroke, unit
from linkanim.picture.text import subscripted
from linkanim.picture.theme import mixed
from linkanim.picture.view import Box, Rect
from linkanim.units import three_digits
from linkanim.words import said

# Instant centres with Kennedy's lines, and the curves of the coupler's instant centre: both centrodes.

_CLOSE = 3.0
"""Points of a curve that are nearer to each other than this, in pixels, are thinned out."""
_MOST = 5
"""With up to this many links, ground included, all centres are marked; with more, those with the ground to
which two of Kennedy's lines lead, and those on these lines."""
_FAR = 0.7
"""The view holds centres up to this far from its middle across and down, in sizes of the linkage."""
_BEYOND = 4.0
"""How far a line is drawn towards a centre that is infinitely far, in sizes of the picture."""
_FAINT = 0.45
"""The share of the background in the colour of Kennedy's lines."""
_ARROW = 2.2
"""The length of an arrow at the edge, in heights of the text."""
CROSS = 0.8
"""The arm of a centre's cross, in half widths of a bar."""


@frozen
class CentrePairs:
    """The pairs of a figure's links whose instant centres are shown, and where they are in a pose."""

    figure: Figure

    @cached_property
    def pairs(self) -> dict[tuple[str, str], str]:
        """The names of centres, such as P_{24}, by the numbers of their two links.

        All where links are few; else those with the ground that are known, or found by two lines.
        """
        links, order = self.figure.by_number, [*self.figure.by_number]
        if self.all_shown:
            return {pair: label_of(*pair) for pair in combinations(links, 2)}
        ground = (("1", other) for other in order[1:])
        known = {pair for pair in ground if touch(self.figure.linkage, links[pair[0]], links[pair[1]])}
        for step in self.steps:
            one, other = step.pair
            on_lines = ((one, third) for third in step.by), ((third, other) for third in step.by)
            known |= {step.pair, *(_in_order(pair, order) for pairs in on_lines for pair in pairs)}
        shown = sorted(known, key=lambda pair: (order.index(pair[0]), order.index(pair[1])))
        return {pair: label_of(*pair) for pair in shown}

    @property
    def all_shown(self) -> bool:
        """Whether links are few enough for all their centres to be shown."""
        return len(self.figure.by_number) <= _MOST

    @cached_property
    def steps(self) -> tuple[KennedyStep, ...]:
        """The steps of Kennedy's theorem to the centres; of many links to those with the ground."""
        return kennedy(self.figure.linkage, self.figure.by_number, to_ground=not self.all_shown)

    @cached_property
    def at_joints(self) -> dict[str, tuple[str, ...]]:
        """The names of the centres that always lie in a joint, by the joint's name."""
        labels: dict[str, tuple[str, ...]] = {}
        for (one, other), label in self.pairs.items():
            links = self.figure.by_number
            if joint := joint_between(self.figure.linkage, links[one], links[other]):
                labels[joint] = (*labels.get(joint, ()), label)
        return labels

    def of(self, pose: Pose) -> dict[tuple[str, str], Centre]:
        """Return the centres of a pose by their pairs of links, for pairs that move against each other."""
        links = self.figure.by_number
        known = {pair: centre(pose, *(links[number] for number in pair)) for pair in self.pairs}
        return {pair: known_centre for pair, known_centre in known.items() if known_centre}

    def paths(self, motion: Motion, step: int) -> dict[str, Loop]:
        """Return where the centres are at every `step`-th phase of a motion, by name; NaN for nowhere."""
        links, some = self.figure.by_number, np.atleast_1d(motion.phase)[::step]
        seen = self.figure.scene.solve(phase=some, derivatives=1)
        return {
            label: centre_path(seen, *(links[number] for number in pair))
            for pair, label in self.pairs.items()
        }

    def near(self, pose: Pose, box: Box, far: float = _FAR) -> tuple[complex, ...]:
        """Return the centres of a pose, in the scene's unit, that lie near a rectangle of the scene.

        That is up to `far` of its longer side from its middle, across and along: those that a picture of the
        rectangle includes.
        """
        places = [centre.place for centre in self.of(pose).values() if centre.place is not None]
        return _near(np.array(places, np.complex128), box, far)

    def passed(self, box: Box, step: int) -> tuple[complex, ...]:
        """Return the places near a rectangle where centres are at every `step`-th phase of the cycle."""
        paths = self.paths(self.figure.cycle, step).values()
        return _near(np.concatenate([np.zeros(0, np.complex128), *paths]), box, _FAR)

    @property
    def size(self) -> float:
        """The longer side of the rectangle that the linkage sweeps, in the scene's unit."""
        box = self.figure.box
        return max(box.right - box.left, box.high - box.low)

    @property
    def far(self) -> tuple[str, ...]:
        """Rows as wide as those that say where centres are that the picture does not show."""
        jointed = {label for labels in self.at_joints.values() for label in labels}
        unit_ = self.figure.scene.length_unit
        named = subscripted(self.figure.fixed[0]) if self.figure.fixed else said("the origin")
        return tuple(
            _far_off(label, f"0000 {unit_}", named) for label in self.pairs.values() if label not in jointed
        )


def _near(places: Loop, box: Box, far: float) -> tuple[complex, ...]:
    """Return the places up to `far` of a rectangle's longer side from its middle, across and along."""
    reach, off = far * max(box.right - box.left, box.high - box.low), places - complex(*box.middle)
    return tuple(places[np.maximum(np.abs(off.real), np.abs(off.imag)) <= reach].tolist())


def _in_order(pair: tuple[str, str], order: Sequence[str]) -> tuple[str, str]:
    one, other = sorted(pair, key=order.index)
    return one, other


class Seen(NamedTuple):
    """A centre in pixels: its name, its place, whether it is in a joint.

    One that is not in the picture has its place at the edge, a direction, and words on how far it is.
    """

    label: str
    at: complex
    direction: complex = 0j
    jointed: bool = False
    words: str = ""


@frozen
class Centres:
    """The instant centres of a figure in a view, and the coupler's centrodes where the look has them."""

    setting: DrawSetting

    @cached_property
    def known(self) -> CentrePairs:
        """Which centres there are."""
        return CentrePairs(self.setting.figure)

    def layers(self, pose: Pose) -> Iterator[Layer]:
        """Yield Kennedy's lines, crosses at visible centres outside joints, arrows to invisible ones."""
        centres = self.known.of(pose)
        gauge, theme = self.setting.gauge, self.setting.theme
        lines = [line for step in self.known.steps for line in self._lines(step, centres)]
        if lines:
            faint = mixed(theme.warning, theme.background, _FAINT)
            width = 0.8 * gauge.line
            yield Layer(faint, [loop for ends in lines for loop in dashes(*ends, 9 * width, width)])
        reach, marks, width = CROSS * gauge.bar, list[Loop](), 1.4 * gauge.line
        for seen in self._seen(centres):
            if seen.direction:
                marks += arrows([seen.at - self.arrow * seen.direction], [self.arrow * seen.direction], width)
            elif not seen.jointed:
                ends = np.array([reach, 1j * reach])
                marks += segments(seen.at - ends, seen.at + ends, width)
        yield Layer(theme.warning, marks)

    @property
    def arrow(self) -> float:
        """The length of an arrow to a centre outside the picture, in pixels."""
        return _ARROW * self.setting.layout.small_size

    def seen(self, pose: Pose) -> Iterator[Seen]:
        """Yield the visible centres, then the directions of the others."""
        return self._seen(self.known.of(pose))

    def _seen(self, centres: dict[tuple[str, str], Centre]) -> Iterator[Seen]:
        view, room, (named, pin) = self.setting.view, self.setting.layout.stage, self._pin
        inner, far = room.inset(6 * self.setting.layout.unit), list[Seen]()
        foot, unit_ = room.inset(1).nearest(pin), self.setting.figure.scene.length_unit
        jointed = {label for labels in self.known.at_joints.values() for label in labels}
        for pair, label in self.known.pairs.items():
            if pair not in centres:
                continue
            place, direction = centres[pair]
            if place is None:
                direction = direction.conjugate()
                if (-direction.imag, direction.real) <= (1e-9, 0.0):  # a direction points up, or to the right
                    direction = -direction
                at = foot + inner.ahead(foot, direction) * direction
                far.append(Seen(label, at, direction, words=said("{centre}: at ∞", centre=label)))
                continue
            at = view.pixel((place.real, place.imag))
            if room.holds(at.real, at.imag):
                yield Seen(label, at, jointed=label in jointed)
            elif label not in jointed:
                direction = unit(at - pin)
                words = _far_off(label, f"{three_digits(abs(at - pin) / view.scale)} {unit_}", named)
                edge = foot + inner.ahead(foot, direction) * direction
                far.append(Seen(label, edge, direction, words=words))
        yield from far

    def crosses(self, motion: Motion, step: int) -> dict[str, Loop]:
        """Return the pixels of centres outside joints at every `step`-th phase; NaN where one is not seen."""
        view, room = self.setting.view, self.setting.layout.stage
        jointed = {label for labels in self.known.at_joints.values() for label in labels}
        crosses = {}
        for label, path in self.known.paths(motion, step).items():
            at = view.pixel((0.0, 0.0)) + view.scale * path.conj()
            seen = (
                (at.real >= room.x) & (at.real <= room.right) & (at.imag >= room.y) & (at.imag <= room.bottom)
            )
            if label not in jointed and seen.any():
                crosses[label] = np.where(seen, at, complex(np.nan))
        return crosses

    @property
    def _pin(self) -> tuple[str, complex]:
        """The name of the place from which distances to invisible centres are given, and its pixel."""
        figure, view = self.setting.figure, self.setting.view
        if not figure.fixed:
            return said("the origin"), view.pixel((0.0, 0.0))
        return subscripted(figure.fixed[0]), figure.pixel(figure.fixed[0], view)

    def _lines(
        self, step: KennedyStep, centres: dict[tuple[str, str], Centre]
    ) -> Iterator[tuple[complex, complex]]:
        """Yield the visible parts of the lines on which a centre lies, one for each third link."""
        for third in step.by:
            far = _BEYOND * max(self.setting.layout.size) / self.setting.view.scale
            if ends := kennedy_line(step.pair, third, centres, far):
                one, other = (self.setting.view.pixel((end.real, end.imag)) for end in ends)
                if seen := self.setting.layout.stage.crossed(one, other):
                    yield seen

    def fixed(self) -> Layer:
        """Return the curve on the ground."""
        _, view, _, theme = self.setting.known
        return self._stroked(view.pixel((0.0, 0.0)) + view.scale * self._curves[0].conj(), theme.warning)

    def moving(self, places: Places) -> Layer:
        """Return the curve that moves with the coupler and rolls on the fixed one."""
        figure, view, _, theme = self.setting.known
        body = coupler_body(figure.linkage)
        if body is None:
            return Layer(theme.velocity, [])
        first, second = (places[name] for name in body.joints[:2])
        curve = first + unit(second - first) * view.scale * self._curves[1].conj()
        return self._stroked(curve, theme.velocity)

    @cached_property
    def _curves(self) -> tuple[Loop, Loop]:
        """Both centrodes, closed, in the scene's unit; empty where no body is a coupler."""
        body, scene = coupler_body(self.setting.figure.linkage), self.setting.figure.scene
        if body is None:
            return np.zeros(0, complex), np.zeros(0, complex)
        count = len(self.setting.figure.cycle.phase)
        phases = np.arange(count + 1) * (scene.period / count)
        return centrodes(scene.solve(phase=phases, derivatives=1), body)

    def _stroked(self, path: Loop, colour: Colour) -> Layer:
        width = 1.3 * self.setting.gauge.line
        runs = clipped(path, self.setting.layout.stage)
        return Layer(colour, [loop for run in runs for loop in stroke(_thinned(run), width)])


def _thinned(run: Loop) -> Loop:
    """Return a path thinned out where its points lie close together."""
    steps = np.floor(np.cumsum(np.abs(np.diff(run))) / _CLOSE)
    kept: Loop = run[np.r_[True, np.diff(steps) > 0, True][: len(run)]]
    return kept


def label_of(one: str, other: str) -> str:
    """Return the name of the centre of two links, the lower number first."""
    first, second = sorted((one, other), key=lambda number: (len(number), number))
    apart = "," if len(first) + len(second) > 2 else ""
    return f"P_{{{first}{apart}{second}}}"


def kennedy_line(
    pair: tuple[str, str], third: str, known: dict[tuple[str, str], Centre], reach: float
) -> tuple[complex, complex] | None:
    """Return the ends of the line through the centres that two links have with a third, and their own.

    Towards a centre that is infinitely far it runs `reach`; None where it has no direction.
    """
    one, other = pair
    centres = [known.get(key) or known.get(key[::-1]) for key in ((one, third), (third, other), (one, other))]
    places = [each.place for each in centres if each and each.place is not None]
    directions = [each.direction for each in centres if each and each.place is None]
    if not places or len(places) + len(directions) < len(centres):
        return None
    far = max(places, key=lambda place: abs(place - places[0]))
    direction = directions[0] if directions else far - places[0]
    if not abs(direction) > 1e-9 * reach:
        return None
    direction /= abs(direction)
    along = [((place - places[0]) * direction.conjugate()).real for place in places]
    low, high = min(along), max(along)
    if centres[2] and centres[2].place is None:
        low, high = low - reach, high + reach
    return places[0] + low * direction, places[0] + high * direction


def clipped(path: Loop, room: Rect) -> Iterator[Loop]:
    """Yield the parts of a path that lie in a rectangle, cut where it leaves and where it breaks (NaN)."""
    across = (path.real >= room.x) & (path.real <= room.right)
    for run in runs_of(across & (path.imag >= room.y) & (path.imag <= room.bottom)):
        first, last = int(run[0]), int(run[-1])
        before = _edge(path[first], path[first - 1], room) if first else []
        after = _edge(path[last], path[last + 1], room) if last + 1 < len(path) else []
        yield np.concatenate((before, path[run], after))


def _edge(inside: complex, outside: complex, room: Rect) -> list[complex]:
    """Return where a line leaves a rectangle; nothing where the other end is NaN."""
    step = outside - inside
    return [inside + step * room.ahead(inside, step)] if np.isfinite(step) else []


def _far_off(centre: str, length: str, place: str) -> str:
    return said("{centre}: {length} from {place}", centre=centre, length=length, place=place)
