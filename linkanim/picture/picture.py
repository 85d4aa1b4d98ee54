"""The one description of a picture: a scene at a size and look; its poses as groups for every printer."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from math import ceil
from typing import TYPE_CHECKING
from unicodedata import normalize

from linkanim.mechanics.motion import Pose
from linkanim.picture.centres import Centres
from linkanim.picture.chart import ChartStrips, chart_strips, pen_for
from linkanim.picture.composition import Composition, composed, subject_of
from linkanim.picture.drawing import Drawing
from linkanim.picture.drawn import NOTHING_ADDED, Addition, Additions
from linkanim.picture.figure import DrawSetting, Figure, figure
from linkanim.picture.hud import LISTED_STEP, Hud, Legend, caption_lines, legend_for, measured
from linkanim.picture.items import Caption, Group, Item, grouped
from linkanim.picture.layout import CAPTION_STEP, NOTHING_DOCKED, Docked, Gauge, Layout, gauge
from linkanim.picture.look import Look
from linkanim.picture.names import Names
from linkanim.picture.quantities import chart_tokens
from linkanim.picture.raster import Layer
from linkanim.picture.shapes import Part, Places, box
from linkanim.picture.text import Type, letters
from linkanim.picture.theme import Theme, on_paper, theme_of
from linkanim.picture.view import Box, Rect, View, moved
from linkanim.scenes.editing import ghost_of, in_unit
from linkanim.scenes.scene import Scene
from linkanim.words import said

if TYPE_CHECKING:
    from linkanim.build.draft import Photo
    from linkanim.picture.polygons import Polygon
    from linkanim.synthesis.constructions import Mark
    from linkanim.synthesis.curves import DrawnCurve

_NOTHING_STILL = Group("nothing", (), still=True)
_SAME = 1e-9
"""How far apart one and the same point may be found in two ways, in sizes of the linkage."""


class Picture:
    """A scene at one pixel size and look: places are worked out once, and `groups` describes a pose.

    The view fits what is shown: the scene, its other closure where the look shows that, and the places `also`
    (in the scene's unit), or the rectangle of the scene that is the `sheet` on which a linkage is built. The
    look zooms and pans it. On its way to that it is the `view` that is given, with charts and polygons
    `aside` of their slots by so many pixels. What is `docked` in the window has room of its own.

    With a `moment` it is a still: fitted to the pose at that phase, its names where they are best in it. With
    `apart` each joint has a group of its own. While a hand changes the scene, words and names stay where they
    are for the scene `placed`. With `noted` the words say that a limit or a change point is near. The
    attribute `scene` is in the look's unit. Raises BadInput where the look's
    chart is no quantity of the scene.
    """

    def __init__(
        self,
        scene: Scene,
        size: tuple[int, int],
        look: Look,
        *,
        view: View | None = None,
        aside: tuple[float, float] = (0.0, 0.0),
        moment: float | None = None,
        placed: Scene | None = None,
        docked: Docked = NOTHING_DOCKED,
        apart: bool = False,
        sheet: Box | None = None,
        also: tuple[complex, ...] = (),
        noted: bool = False,
    ) -> None:
        self._aside, self._noted = aside, noted
        self.sheet, self.held = sheet, placed is not None
        self.scene, self.size, self.look = in_unit(scene, look.unit), size, look
        self._goal = self.scene.goal or self.scene
        self.type: Type = letters()
        theme = theme_of(look.theme, lit=look.material == "lit")
        self.theme: Theme = theme if look.background else on_paper(theme)
        self._apart, self._moment = apart, moment
        placed = placed and in_unit(placed, look.unit)
        self.composition: Composition = self._composed(placed, docked, also)
        subject = self.composition.subject
        self.figure: Figure = figure(self.scene) if scene.goal else subject.figure
        self.layout: Layout = self.composition.layout
        self.names: Names = self.composition.names
        self.fitted: View = self._of_sheet or self.composition.view
        """The view before zoom and pan."""
        (right, down), height = look.pan, self.size[1]
        self.view: View = view or moved(
            self.fitted, self.about, zoom=look.zoom, pan=(right * height, down * height)
        )
        self.gauge: Gauge = self.composition.gauge
        if self.sheet:
            shortest = (
                subject_of(placed, ghost=look.ghost).figure.shortest if placed else self.figure.shortest
            )
            self.gauge = gauge(self.layout.unit, shortest * self.fitted.scale)
        self._overruns = look.framed or self.held or self.view != self.composition.view
        """Whether the linkage may run beyond its stage."""
        setting = DrawSetting(self.figure, self.view, self.gauge, self.theme, self.layout, look, self.type)
        self.drawing = Drawing(setting, apart=apart, moment=moment)
        self._chart: ChartStrips | None = self._charted()
        self._behind: tuple[float, DrawnCurve | None, tuple[Group, ...]] | None = None

    def _composed(self, placed: Scene | None, docked: Docked, also: tuple[complex, ...]) -> Composition:
        """Return the composition of the scene, or that of the one `placed` with this scene in a hand."""
        goal, look = self._goal, self.look
        subject = subject_of(placed or goal, ghost=look.ghost)
        composition = composed(subject, self.size, look, docked, self._moment, also)
        if placed in (None, goal):
            return composition
        return composition.while_dragged(subject_of(goal, ghost=look.ghost))

    @property
    def about(self) -> tuple[float, float]:
        """The pixel about which the look zooms: the stage's middle; of paper, which stays, the window's."""
        whole = Rect(0, 0, *self.size) if self.sheet else self.layout.stage
        return whole.middle.real, whole.middle.imag

    @property
    def _of_sheet(self) -> View | None:
        """The view of the sheet on which the linkage is built; None without a sheet."""
        if self.sheet is None:
            return None
        from linkanim.picture.build_sheet import home_view

        return home_view(self.sheet, self.layout)

    def poses(
        self, phase: float, speed: float | None = None, acceleration: float = 0.0
    ) -> tuple[Pose, tuple[Pose, ...]]:
        """Return the pose at a phase, and the faint one of the other closure where the look asks for it."""
        faint = (self._ghost.pose(phase, 0),) if self._ghost else ()
        return self.scene.pose(phase, self._order, speed=speed, acceleration=acceleration), faint

    @cached_property
    def _order(self) -> int:
        """The derivatives that poses need: none while the scene turns into another and no rate is shown."""
        look, info = self.look, self._goal.info
        shown = look.vectors or look.chart or look.polygons_shown or look.centres or look.names
        still = self.scene.goal is None or not info.full_turn or any(measured(self._goal))
        return 2 if shown or still else 0

    def groups(
        self,
        pose: Pose,
        beside: Additions = NOTHING_ADDED,
        *,
        faint: Sequence[Pose] = (),
    ) -> Iterator[Group]:
        """Yield all that is drawn of a pose, back to front, with `faint` poses behind it."""
        drawn = beside.drawn
        alone = next((one.alone for one in drawn if one.alone), "")
        if alone:
            yield self._paper(beside.photo) if alone == "sheet" else _NOTHING_STILL
            yield from self._drawn(drawn, pose)
            return
        stroke = next((one.stroke for one in drawn if one.stroke), None)
        if self.sheet and stroke is None:
            yield self._paper(beside.photo)
        yield from self._behind_at(pose.input_speed, stroke)
        for one in drawn:
            yield from self._within(one.behind(self.drawing.setting, pose))
        yield from self._within(self.drawing.wheels(self.drawing.places(pose)))
        for n, other in enumerate(faint, start=1):
            yield from self._within([Group(f"pose-{n}", self.drawing.faint(other))])
        if self._moves_behind:
            yield from self._standing
        if beside.swing:
            yield from self._within(self.drawing.swinging(self._between(pose, *beside.swing)))
            yield from self._framed()
            yield from self._on_chart(pose, grasped=beside.grip)
            yield from self._words(pose, noted=False)
            return
        heads = self.drawing.heads(pose) if self.names.labels else ()
        named = self.names.captions(self.drawing.places(pose), self.drawing.setting, heads)
        taken = [line.around(self.type) for line in named]
        yield from self._within(self.drawing.moving(pose, self.names, taken))
        yield from self._within(self._named_groups(pose, named))
        yield from self._framed()
        for polygon in self._polygons:
            stands = beside.stands and self._moment is None
            shown = (polygon.standing(pose.phase) if stands else polygon).group(pose)
            yield shown.shifted(*self._aside) if any(self._aside) else shown
        yield from self._on_chart(pose, grasped=beside.grip)
        # the words of a construction, or at the head, stand in the place of those about the scene
        if not (beside.steps or any(one.is_head for one in drawn)):
            yield from self._words(pose, noted=self._noted)
        if beside.steps:
            yield from self._constructed(beside.steps, pose, drawn)
        yield from self._drawn(drawn, pose)
        if beside.instant is not None:
            yield from self._pointed(beside.instant, pose)

    def _between(self, pose: Pose, left: Scene, share: float) -> Places:
        """Return where joints are between those of another closure and their own: dyads turn over."""
        departed = in_unit(left, self.look.unit).pose(pose.phase, 0)
        there, here = (self.drawing.places(one) for one in (departed, pose))
        return {name: there[name] + share * (place - there[name]) for name, place in here.items()}

    def _drawn(self, drawn: Sequence[Addition], pose: Pose) -> Iterator[Group]:
        """Yield what is drawn beside the scene, what lies over all else last."""
        groups = list[Group]()
        for one in drawn:
            made = one.groups(self.drawing.setting, pose)
            groups += made if one.of_window else self._within(made)
        yield from sorted(groups, key=lambda one: one.over)

    def _constructed(self, steps: int, pose: Pose, drawn: Sequence[Addition]) -> Iterator[Group]:
        """Yield the first steps of a construction, and the words on the last of them, off a slider."""
        from linkanim.picture.build_sheet import worded
        from linkanim.picture.constructed import shown_at
        from linkanim.picture.construction import construction_items
        from linkanim.picture.slider import Slider, slider_rect

        _, shown, total = shown_at(self._goal, steps, pose.phase)
        pen = pen_for(self.layout, self.type, self.theme)
        marks = [self._labelled_once(mark, pose) for step in shown for mark in step.marks]
        yield grouped("construction", construction_items(marks, self.view, self.layout.stage, pen))
        facts = said("step {number} of {count}", number=len(shown), count=total)
        facts = facts if self._moment is not None else said("{step} · F7 goes on", step=facts)
        beside = slider_rect(self.layout) if any(isinstance(one, Slider) for one in drawn) else None
        yield worded(self.drawing.setting, shown[-1].words, [facts], beside=beside)

    def _labelled_once(self, mark: Mark, pose: Pose) -> Mark:
        """Return a mark of a point without its label where the joint there has the same letter already."""
        name = normalize("NFKC", mark.label)  # subscripts as plain digits
        place = (
            pose.position.get(name) if any(one.of == f"joint:{name}" for one in self.names.labels) else None
        )
        if (
            place is None
            or len(mark.points) > 1
            or abs(mark.points[0] - complex(*place)) > _SAME * self.figure.extent
        ):
            return mark
        return mark._replace(label="")

    @property
    def edge(self) -> tuple[float, float]:
        """The right and the lower edge to which the linkage is cut: charts and polygons are beyond."""
        (wide, high), (right, down) = self.size, self._aside
        for side in (self.layout.chart, self.layout.polygons):
            if side and side.x >= self.layout.stage.right:
                wide = min(wide, round(side.x - self.layout.margin / 2 + right))
            elif side:
                high = min(high, round(side.y - self.layout.margin / 2 + down))
        return wide, high

    def _within(self, groups: Iterable[Group]) -> Iterator[Group]:
        """Yield the linkage's groups cut off at `edge`; a line of words that would cross it is left out."""
        edge = Rect(0, 0, *self.edge)
        if edge.right == self.size[0] and edge.bottom == self.size[1]:
            yield from groups
            return
        for group in groups:
            words = [line for line in group.captions if self._ends_before(edge, line)]
            yield group._replace(captions=words, within=edge)

    def _framed(self) -> Iterator[Group]:
        """Yield the ground of the slots beside the stage, where a zoomed linkage may run into them."""
        if not (self.look.framed or self.held):
            return
        stage, (wide, high) = self.layout.stage, self.size
        left = self.layout.room.x if self.layout.room else 0.0
        slots = [Rect(0, 0, min(wide, self.edge[0]), ceil(stage.y))] if stage.y > 1 else []
        slots += [Rect(left, 0, ceil(stage.x) - left, high)] if stage.x > left + 1 else []
        slots += [self.layout.caption] if self.layout.caption else []
        loops = [slot.middle + box(slot.width, slot.height) for slot in slots]
        yield Group("slots", [Layer(self.theme.background, loops)] if loops else (), over=True)

    def _paper(self, photo: Photo | None) -> Group:
        """Return the sheet: with its ground line where a linkage is built on it."""
        from linkanim.picture.build_sheet import paper, sheet

        if self.sheet:
            return paper(self.drawing.setting, photo)
        return sheet(self.view, self.layout, self.theme)

    def _behind_at(self, speed: float, curve: DrawnCurve | None) -> tuple[Group, ...]:
        """Return what stands still behind all that moves; the chart and the key depend on the speed."""
        known = self._behind
        if not known or known[1] is not curve or (known[0] != speed and (self._chart or self._legend)):
            self._behind = speed, curve, tuple(self._still_behind(speed, curve))
        assert self._behind
        return self._behind[2]

    def _still_behind(self, speed: float, curve: DrawnCurve | None) -> Iterator[Group]:
        yield from self._within([self._discs])
        if curve:
            from linkanim.picture.build_sheet import dashed

            yield from self._within([dashed(self.drawing.setting, curve)])
        if not self._moves_behind:
            yield from self._standing
        if self._chart:
            self._chart = self._chart.at(speed)
            yield grouped("chart", self._chart.still(), still=True)._replace(targets=self._chart.targets())
        if self._legend and not self._overruns:
            yield self._legend.group(speed)
        if self.layout.caption and self.look.caption:
            yield Group("caption", (), tuple(self._caption(self.layout.caption)), still=True)

    def _caption(self, place: Rect) -> Iterator[Caption]:
        """Yield the sentence on what to watch for, in its slot."""
        size, middle = self.layout.small_size, place.x + place.width / 2
        lines = caption_lines(self.layout, said(self.scene.look_at), self.type)
        top = place.y + (place.height - CAPTION_STEP * size * len(lines)) / 2
        for n, line in enumerate(lines):
            yield Caption(line, (middle, top + CAPTION_STEP * size * n), size, self.theme.dim, "centre")

    @cached_property
    def _discs(self) -> Group:
        return self.drawing.discs()

    @cached_property
    def _standing(self) -> tuple[Group, ...]:
        """What stands still in front of the parts that move behind it."""
        return tuple(self._within(self.drawing.standing()))

    @cached_property
    def _moves_behind(self) -> bool:
        """Whether something moves behind what else stands still."""
        return self._apart or bool(self.drawing.turning_wheels) or self.look.ghost

    def _on_chart(self, pose: Pose, *, grasped: bool) -> Iterator[Group]:
        """Yield the chart's cursor with the values there, and its grip where it can be grasped."""
        if self._chart:
            yield from self._read(self._chart, pose, grasped=grasped)

    def _read(self, chart: ChartStrips, pose: Pose, *, grasped: bool) -> Iterator[Group]:
        items: list[Item] = [*chart.past(pose)] if self.theme.lit and self._moment is None else []
        items += chart.cursor(pose)
        if grasped:
            from linkanim.picture.marks import grip

            items += grip(chart.foot(pose), self.layout.unit, self.theme)
        yield grouped("reading", [*items, *chart.readings(pose)])

    def _named_groups(self, pose: Pose, named: Sequence[Caption]) -> Iterator[Group]:
        """Yield the words on the linkage, and the lines drawn with them."""
        if not self.names.labels:
            return
        places = self.drawing.places(pose)
        lines = [layer for part in self._dimension_lines.values() for layer in part.placed(places)]
        lines += self.names.leaders(places, self.drawing.setting)
        yield Group("dimension-lines", lines, made_of=self._dimension_lines)
        yield Group("names", (), named, made_of=self.names)

    @cached_property
    def _dimension_lines(self) -> dict[str, Part]:
        return self.names.parts(self.drawing.setting)

    def _ends_before(self, edge: Rect, line: Caption) -> bool:
        """Return whether a line of text ends before that edge."""
        around = line.around(self.type)
        return around.right <= edge.right and around.bottom <= edge.bottom

    def _words(self, pose: Pose, *, noted: bool) -> Iterator[Group]:
        """Yield the words about the scene."""
        if self._overruns and self._legend:
            yield self._legend.group(pose.input_speed)
        if self.drawing.centres and self.layout.legend:
            yield Group("far-centres", (), [*self._far_centres(self.drawing.centres, pose)])
        if self._hud is None:
            return
        values = self._hud.values(pose)
        notes = self._hud.notes(pose) if noted and values else ()
        still = self._hud.still
        yield still._replace(captions=[*still.captions, *values, *notes])

    def _far_centres(self, centres: Centres, pose: Pose) -> Iterator[Caption]:
        """Yield where the centres are that the picture does not show, in rows at the foot of the legend."""
        legend, size = self.layout.legend, self.layout.small_size
        assert legend
        rows = [seen.words for seen in centres.seen(pose) if seen.words]
        top = legend.bottom - LISTED_STEP * size * len(centres.known.far)
        for n, row in enumerate(rows):
            yield Caption(row, (legend.x, top + LISTED_STEP * size * n), size, self.theme.warning)

    def _pointed(self, instant: float, pose: Pose) -> Iterator[Group]:
        """Yield where traced joints are at the instant that the mouse points at, and the chart's values."""
        from linkanim.picture import hover

        there = self.scene.pose(instant, self._order, speed=pose.input_speed)
        curves = self.scene.trace if self.look.trace or self.look.ink else ()
        places = [self.view.pixel(there.position[joint]) for joint in curves]
        lights = hover.instant(self.drawing.setting, places)
        yield from self._within([Group("instant", list(lights), over=True)])
        if self._chart:
            yield grouped("instant-read", self._chart.cursor(there))

    def crank_pin_px(self, pose: Pose) -> tuple[float, float]:
        """Return where the pin that the phase drives lies, in pixels."""
        return self.view.to_pixel(*pose.position[self.scene.linkage.drive.joint])

    @cached_property
    def _ghost(self) -> Scene | None:
        if not self.look.ghost:
            return None
        return ghost_of(self.scene) if self.scene.goal else self.composition.subject.beside

    @cached_property
    def _hud(self) -> Hud | None:
        block, place = self.composition.block, self.layout.hud
        if place is None or not block.title:
            return None
        return Hud(self.composition.subject.figure.scene, block, place, self.type, self.theme)

    @cached_property
    def _legend(self) -> Legend | None:
        parts = self.drawing
        chain = parts.chain.colours if parts.chain else ()
        ink = parts.inks[0].scale if parts.inks else None
        listed = tuple(label.row for label in self.names.listed)
        return legend_for(parts.arrows, self.layout, self.type, self.theme, chain, ink, listed)

    def _charted(self) -> ChartStrips | None:
        tokens = chart_tokens(self.scene, self.look.chart)
        if not tokens:
            return None
        pen = pen_for(self.layout, self.type, self.theme)
        return chart_strips(self.figure, tokens, self._slots, pen, self.look.over)

    @cached_property
    def _polygons(self) -> tuple[Polygon, ...]:
        """The polygons in their slots."""
        place = self.layout.polygons
        if not place:
            return ()
        from linkanim.picture.polygons import polygons_of

        pen = pen_for(self.layout, self.type, self.theme)
        only = self.look.large_polygon
        return polygons_of(self.figure, place, pen, self._moment, only=only)

    @property
    def _slots(self) -> Layout:
        """The layout with charts and polygons where they are now, on their way to their slots."""
        if self._aside == (0.0, 0.0):
            return self.layout
        (right, down), places = self._aside, (self.layout.chart, self.layout.polygons)
        chart, polygons = (place and place._replace(x=place.x + right, y=place.y + down) for place in places)
        return replace(self.layout, chart=chart, polygons=polygons)
