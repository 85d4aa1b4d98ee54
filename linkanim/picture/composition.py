"""Compose a picture: slots for words, charts and polygons, and the linkage as large as fits into the rest."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cached_property, lru_cache
from itertools import product
from math import tau

import numpy as np

from linkanim.frozen import frozen
from linkanim.picture.anchors import Anchor, pushed
from linkanim.picture.centres import CentrePairs
from linkanim.picture.dead_centres import DeadCentres, dead_centres_of
from linkanim.picture.dimensions import Symbols, symbols
from linkanim.picture.figure import DrawSetting, Figure, figure
from linkanim.picture.fit import NOTHING, Extent, around, each, fitted, nearest, of_linkage, together
from linkanim.picture.hud import (
    Ranked,
    WordBlock,
    caption_lines,
    columns,
    key_lines,
    widest_rows,
)
from linkanim.picture.layout import (
    Docked,
    Gauge,
    Layout,
    gauge,
    layout,
    room_of,
    with_caption,
    with_side,
    with_words,
)
from linkanim.picture.look import Look
from linkanim.picture.motion_marks import Arrows, Sliding, Turning, arrows_for, motion_of
from linkanim.picture.names import Names, names_of
from linkanim.picture.quantities import chart_tokens
from linkanim.picture.text import Type, letters, subscripted
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect, View
from linkanim.scenes.editing import ghost_of
from linkanim.scenes.scene import Scene
from linkanim.words import cached_as_said, kept_as_said, said

_KEEPS, _KEEPS_LISTED = 0.75, 0.4
"""The share of its size without words that the linkage keeps: beside more words; beside a list alone."""
_BETTER = 1.1
"""The factor by which the linkage must be larger with its charts beside it for them to stand there."""
_WIDE_ENOUGH = 420
"""The least width of a picture that has its charts beside the linkage, in pixels."""
_THINNEST = 0.68
"""The least thickness of a drawing on a small stage, as a share of that for the whole picture."""
_ROOM_FOR_LINES = (5.5, 3.8, 2.2, 0.8)
"""The room for dimension lines on each side of a still at first, in heights of their text: less and less."""
_LEAST = 0.57
"""The least share of a still's width or height that the linkage takes."""
_ROUNDS, _SAME, _ALIKE = 5, 0.005, 0.05
"""How often names of a still are chosen and the linkage is fitted at the most: until its size hardly changes.

In a moving picture, in which names are not as close to other things, once is enough where it has grown.
"""
_SAMPLES = 60
"""The most moments at which arrows are looked at."""
_LOOKED_AT = 24
"""The poses of one turn of the input whose instant centres a moving picture includes."""


@frozen(eq=False)
class Subject:
    """A scene's figure, and perhaps a second scene beside it, such as its other closure."""

    figure: Figure
    beside: Scene | None = None

    @property
    def scenes(self) -> tuple[Scene, ...]:
        """The scene, and the one beside it."""
        return (self.figure.scene, self.beside) if self.beside else (self.figure.scene,)

    @cached_as_said
    def rows(self) -> tuple[Ranked, ...]:
        """The rows of their readout, at their widest."""
        return widest_rows(self.scenes, letters())

    @cached_property
    def figures(self) -> tuple[Figure, ...]:
        """Their figures."""
        return (self.figure, figure(self.beside)) if self.beside else (self.figure,)


@frozen
class Composition:
    """Where everything stands: the slots, the view, the thicknesses, the words, the names."""

    subject: Subject
    layout: Layout
    view: View
    gauge: Gauge
    block: WordBlock
    names: Names = Names()
    listed: tuple[str, ...] = ()
    """The rows that the legend has room for."""
    extent: Extent = NOTHING
    """How far all that is drawn extends."""

    def while_dragged(self, subject: Subject) -> Composition:
        """Return the composition while a hand changes the linkage: words and names stay where they are.

        The view stays, too, as long as all that the linkage passes lies on its stage.
        """
        labels = (*self.names.labels, *self.names.listed)
        figured = symbols(subject.figure) if any(one.about for one in labels) else None
        names = self.names.measuring(figured, subject.figure.scene.length_unit)
        extent = together(of_linkage(one, self.gauge) for one in subject.figures)
        view = nearest(extent, self.view, self.layout.stage)
        return replace(self, subject=subject, names=names, view=view)


@lru_cache(maxsize=8)
def subject_of(scene: Scene, *, ghost: bool) -> Subject:
    """Return a scene as a subject, with its other closure beside it where that is shown."""
    return Subject(figure(scene), ghost_of(scene) if ghost else None)


def composed(
    subject: Subject,
    size: tuple[int, int],
    look: Look,
    docked: Docked,
    moment: float | None = None,
    also: tuple[complex, ...] = (),
) -> Composition:
    """Return the composition of a subject in a look, at any zoom, in any theme, with any quantities charted.

    In motion curves lie where joints pass anyway, so it is the same with them and without. `moment` is the
    phase of a still, `also` are further places in the scene's unit that the view includes.
    """
    charts = len(chart_tokens(subject.figure.scene, look.chart))
    look = replace(look, theme="light", zoom=1.0, pan=(0.0, 0.0), chart=None, over=None)
    if moment is None:
        look = replace(look, trace=True)
    return _composed(_Composer(subject, size, look, charts, docked, moment, also))


@kept_as_said(8)
def _composed(composer: _Composer) -> Composition:
    return composer.composition()


@frozen
class _Composer:
    """Composes one picture."""

    subject: Subject
    size: tuple[int, int]
    look: Look
    charts: int
    docked: Docked
    moment: float | None
    also: tuple[complex, ...]

    def composition(self) -> Composition:
        """Fit the linkage with room for names, choose their anchors, then fit all once more with these.

        A still in which dimensions leave the linkage too little has less room for them.
        """
        if not self._named:
            return self._arranged(self._first(0.0), self._far_centres)
        still = self.moment is not None
        for lines in _ROOM_FOR_LINES if still and self.look.names > 1 else (0.8,):
            composition = self._composed(lines)
            if self._share(composition) >= _LEAST:
                break
        return composition

    def _composed(self, lines: float) -> Composition:
        """Return the composition with so much room for dimension lines at first, in heights of their text."""
        still = self.moment is not None
        composition = self._arranged(self._first(lines), (*self._rows, *self._far_centres))
        for _ in range(_ROUNDS if still else 1):
            names, last = self._names(composition), composition
            composition = self._arranged_for(names, composition)
            grown = composition.view.scale / last.view.scale - 1.0
            if abs(grown) < (_SAME if still else _ALIKE):
                return replace(composition, names=names)
        names = self._names(composition)
        while not {label.row for label in names.listed} <= {*composition.listed}:
            composition = self._arranged_for(names, composition, composition.listed)
            names = self._names(composition)  # names hold in the view in which they were chosen
        return replace(composition, names=names)

    @property
    def _rows(self) -> tuple[str, ...]:
        """The rows of all dimensions, in motion: most of them are listed there."""
        unit = self.subject.figure.scene.length_unit
        known = self._symbols.dimensions if self._symbols and self.moment is None else ()
        return tuple(f"{one.written(unit)}, {one.about}" for one in known)

    def _arranged_for(self, names: Names, composition: Composition, rows: Iterable[str] = ()) -> Composition:
        """Return the composition with room for exactly these names, which were chosen in another one.

        What they list has room, and so have further `rows`.
        """
        exact = together([self._linkage, self._arrow_extent, *self._label_extents(names, composition)])
        listed = (*rows, *(label.row for label in names.listed), *self._far_centres)
        return self._arranged(exact, tuple(dict.fromkeys(listed)))

    def _share(self, composition: Composition) -> float:
        """Return the share of the picture's width or height that the linkage takes, whichever is greater."""
        box, (wide, high) = self._linkage.box, self.size
        scale = composition.view.scale
        return max(scale * (box.right - box.left) / wide, scale * (box.high - box.low) / high)

    @property
    def _named(self) -> bool:
        return self.look.named or bool(self.look.vectors)

    @cached_property
    def type(self) -> Type:
        """The letters."""
        return letters()

    @property
    def _polygons(self) -> int:
        """1 for both polygons, 2 for a large one, 0 for none."""
        return self.look.polygons_shown

    @cached_property
    def _bare(self) -> Layout:
        """The slots that depend on nothing but the window, and the caption's."""
        parts = layout(self.size, docked=self.docked, type_scale=self.look.type_scale)
        if not self.look.caption or self.docked.listed or parts.caption:
            return parts
        lines = caption_lines(parts, said(self.subject.figure.scene.look_at), self.type)
        return with_caption(parts, len(lines))

    @cached_property
    def _gauge(self) -> Gauge:
        """The thicknesses, for the linkage as large as it is without words."""
        parts, box = (
            self._bare,
            together(of_linkage(one, Gauge(0, 0, 0, 0)) for one in self.subject.figures).box,
        )
        parts = max(
            (with_side(parts, self.charts, self._polygons, beside=beside) for beside in (False, True)),
            key=lambda one: _bare_scale(box, one.stage),
        )
        stage = parts.stage
        share = min(stage.width / parts.size[0], stage.height / parts.size[1])
        return gauge(
            parts.unit * max(share, _THINNEST), self.subject.figure.shortest * _bare_scale(box, stage)
        )

    @cached_property
    def _linkage(self) -> Extent:
        """How far the linkage extends, with the one beside it and places that have to be seen."""
        traced = self.look.trace or self.look.ink
        extents = [of_linkage(one, self._gauge, self.moment, traced=traced) for one in self.subject.figures]
        if also := (*self.also, *self._near_centres):
            extents.append(around(np.array(also), 2.0 * self._gauge.bar))
        return together(extents)

    @property
    def _near_centres(self) -> tuple[complex, ...]:
        """The instant centres near the linkage, in its pose or over its cycle, where they are shown."""
        if not self.look.centres:
            return ()
        shown, moment = self.subject.figure, self.moment
        scene, pairs = shown.scene, CentrePairs(shown)
        if moment is not None:
            pose = scene.pose(moment, 2)
            return pairs.near(pose, shown.box_of(pose))
        count = round(_LOOKED_AT * max(scene.period / tau, 1))
        return pairs.passed(shown.box, max(len(shown.cycle.phase) // count, 1))

    @cached_property
    def arrows(self) -> tuple[Arrows, ...]:
        """The arrows of velocity and acceleration."""
        return arrows_for(
            self.subject.figure, self.look, self._bare, self._gauge, theme_of(self.look.theme), self.moment
        )

    @cached_property
    def _arrow_extent(self) -> Extent:
        """How far arrows and their names extend."""
        shown, extents = self.subject.figure, []
        moment = self.moment
        motion = shown.cycle if moment is None else shown.scene.solve(phase=np.array([moment]))
        step = 1 if moment is not None else max(len(shown.cycle.phase) // _SAMPLES, 1)
        size = self._bare.small_size
        for kind in self.arrows:
            for symbol, place, reach in kind.paths(motion, shown.moving):
                foot, head = (np.atleast_2d(one)[::step] @ np.array([1, 1j]) for one in (place, reach))
                tip = np.conj(head)
                with np.errstate(invalid="ignore", divide="ignore"):
                    way = np.where(np.abs(tip) > 0, tip / np.abs(tip), 0)
                wide = self.type.width(symbol, size, strong=True)
                half = complex(wide / 2 + 2, size / 2 + 2)
                off = 0.25 * size + np.abs(way.real) * wide / 2 + np.abs(way.imag) * size / 2
                extents.append(each(foot, tip + off * way, np.array([half])))
        return together(extents)

    def _first(self, lines: float) -> Extent:
        """Return the linkage and its arrows, with room for names whose places are not known yet.

        Dimension lines have so much room on each side, in heights of their text.
        """
        extents, parts = [self._linkage, self._arrow_extent], self._bare
        size, shown = parts.label_size, self.subject.figure
        if self.look.joints_named:
            for name in shown.in_view:
                wide = self.type.width(subscripted(name), size, strong=True)
                path = (
                    shown.cycle.position[name]
                    if self.moment is None
                    else np.array(shown.scene.pose(self.moment, 0).position[name])
                )
                gap = self._gauge.bar + 0.2 * size
                extents.append(
                    around(
                        np.atleast_2d(path) @ np.array([1, 1j]),
                        (wide + gap, size + gap, wide + gap, size + gap),
                    )
                )
        if self.look.names > 1:
            extents.append(Extent(self._linkage.boxes, self._linkage.margins + lines * parts.small_size))
        return together(extents)

    def _arranged(self, extent: Extent, listed: tuple[str, ...]) -> Composition:
        """Return the words and slots that leave the linkage room, and the linkage fitted into it.

        Of the column of words as much is kept as leaves the linkage its share of the size that it has without
        any. The column stands beside the linkage or above it, charts beside or below it, whichever leaves the
        linkage larger.
        """
        still = self.moment is not None
        sides = [
            (beside, with_side(self._bare, self.charts, self._polygons, beside=beside))
            for beside in ((False, True) if self._may_stand_beside else (False,))
        ]
        most = max(_scale(extent, parts, still) for _, parts in sides)
        scenes: Sequence[Scene] = self.subject.scenes if self.look.hud and not self.docked.listed else ()
        rows = self.subject.rows if scenes else ()
        best: tuple[float, Layout, WordBlock] | None = None
        for block in columns(scenes, rows, self._bare, self.type, keys=key_lines(self.look), listed=listed):
            best = None
            for (beside, parts), above in product(sides, (False, True)):
                slots = (
                    with_words(parts, (block.width, block.height), block.key, above=above)
                    if block.height
                    else parts
                )
                if slots is None:
                    continue
                scale = _scale(extent, slots, still)
                weight = scale * (1.0 if not beside or len(sides) < 2 else 1.0 / _BETTER)
                if best is None or weight > best[0] * (1 + 1e-9):
                    best = weight, slots, block
                    fitting = scale
            # what is listed is nowhere else
            alone = listed and not block.title and not block.rows
            if best is not None and fitting >= (_KEEPS_LISTED if alone else _KEEPS) * most:
                break
        assert best is not None
        _, slots, block = best
        view = fitted(extent, room_of(slots, still=still))
        return Composition(self.subject, slots, view, self._gauge, block, listed=listed, extent=extent)

    @property
    def _may_stand_beside(self) -> bool:
        return bool(self.charts or self._polygons) and self.size[0] >= _WIDE_ENOUGH

    # The names.

    @cached_property
    def _symbols(self) -> Symbols | None:
        return symbols(self.subject.figure) if self.look.names > 1 else None

    def _setting(self, composition: Composition) -> DrawSetting:
        parts = self.subject.figure, composition.view, self._gauge, theme_of(self.look.theme)
        return DrawSetting(*parts, composition.layout, self.look, self.type)

    def _marks(self, setting: DrawSetting) -> tuple[Turning | Sliding | None, DeadCentres | None]:
        turning = motion_of(setting) if self.look.names else None
        centred = dead_centres_of(setting) if self.look.names and self.look.dead_centres else None
        return turning, centred

    def _names(self, composition: Composition) -> Names:
        setting = self._setting(composition)
        return names_of(setting, self._symbols, *self._marks(setting), self.arrows, self.moment)

    def _label_extents(self, names: Names, composition: Composition) -> list[Extent]:
        """Return how far labels, the lines drawn with them and the marks of the input extend."""
        shown, moment = self.subject.figure, self.moment
        motion = shown.cycle if moment is None else shown.scene.solve(phase=np.array([moment]))
        step = 1 if moment is not None else max(len(shown.cycle.phase) // _SAMPLES, 1)
        joints = [joint.name for joint in shown.linkage.joints]
        places = {
            name: (np.atleast_2d(motion.position[name])[::step] @ np.array([1, -1j])) for name in joints
        }
        scale, result = composition.view.scale, []
        for label in names.labels:
            if label.anchor is None:
                continue
            base, offset = _parts_of(label.anchor, places, label.size)
            result.append(
                each(np.conj(base), offset, np.array([complex(label.size[0] / 2 + 3, label.size[1] / 2 + 2)]))
            )
            if label.drawn:
                at, head = (places[name] for name in label.drawn.frame)
                turned = label.drawn.frame[0] != label.drawn.frame[1]
                span = head - at if turned else np.ones(len(at), np.complex128)
                tracks = label.drawn.tracks(scale * at, scale * span, self._gauge)
                for base, ends in label.drawn.bases(at, span, tracks):
                    result.append(each(np.conj(base), ends - scale * base, np.array([2 + 2j])))
        turning, _ = self._marks(self._setting(composition))
        if isinstance(turning, Turning) and moment is None:
            result.append(around(np.conj(places[turning.pivot]), turning.arrow + 4 * self._gauge.line))
        elif isinstance(turning, Turning):
            pivot, rates = places[turning.pivot], np.atleast_1d(motion.coordinate_rate)
            for points, half, _ in turning.tracks(places, rates, angled=self.look.names > 1):
                base = np.repeat(np.conj(pivot), points.shape[1])
                edge = np.array([(half + self._gauge.line) * (1 + 1j)])
                result.append(each(base, (points - pivot[:, None]).ravel(), edge))
        return result

    @cached_property
    def _far_centres(self) -> tuple[str, ...]:
        """Rows for the centres that the picture does not show."""
        return CentrePairs(self.subject.figure).far if self.look.centres else ()


def _parts_of(
    anchor: Anchor, places: dict[str, np.ndarray], size: tuple[float, float]
) -> tuple[np.ndarray, np.ndarray]:
    """Return an anchor's base in the scene's unit, y down, and how far the label is off it in pixels."""
    at, head = places[anchor.at], places[anchor.head]
    span = head - at if anchor.head != anchor.at else np.ones(len(at), np.complex128)
    way = (
        anchor.way * np.where(span == 0, 1, span / np.where(span == 0, 1, np.abs(span)))
        if anchor.turns
        else np.full(len(at), anchor.way)
    )
    offset = np.array([pushed(complex(one), anchor.reach, size, anchor.flat) for one in way])
    return at + anchor.base * span, offset


def _scale(extent: Extent, parts: Layout, still: bool) -> float:
    return fitted(extent, room_of(parts, still=still)).scale


def _bare_scale(box: object, stage: Rect) -> float:
    wide, high = box.right - box.left, box.high - box.low  # type: ignore[attr-defined]
    scales = [room / span for room, span in ((stage.width, wide), (stage.height, high)) if span > 0]
    return min(scales, default=1.0)
