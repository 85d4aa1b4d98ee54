"""The one description of a picture: a scene at a size and look; its poses as groups for every printer."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import chain, combinations, islice
from typing import TYPE_CHECKING, Literal

import numpy as np

from linkanim.frozen import NamedTuple
from linkanim.mechanics.motion import Pose
from linkanim.picture.arrangement import FitRequest, SceneFit, Subject, arranging, fitted, request_of
from linkanim.picture.chart import ChartStrips, chart_strips, pen_for
from linkanim.picture.drawing import Drawing
from linkanim.picture.figure import DrawSetting, Figure, figure
from linkanim.picture.hud import Hud, Legend, caption_lines, legend_for, measured
from linkanim.picture.items import Caption, Group, Item, grouped
from linkanim.picture.layout import CAPTION_STEP, NOTHING_DOCKED, Docked, Gauge, Layout, gauge
from linkanim.picture.look import Look
from linkanim.picture.motion_marks import motion_of
from linkanim.picture.overlay import NOTHING_OVER, Lane, LayersShown, Overlay, PathShown, SliderShown
from linkanim.picture.quantities import chart_tokens, quantity
from linkanim.picture.shapes import Part
from linkanim.picture.text import Type
from linkanim.picture.theme import Theme, on_paper, theme_of
from linkanim.picture.view import Box, Rect, View, moved
from linkanim.scenes.editing import ghost_of, in_unit
from linkanim.scenes.scene import Scene

if TYPE_CHECKING:
    from linkanim.build.draft import Photo
    from linkanim.picture.labels import Names
    from linkanim.picture.layered import Layered
    from linkanim.picture.polygons import Polygon
    from linkanim.synthesis.curves import DrawnCurve

_NOTHING_STILL = Group("nothing", (), still=True)
_LINES_OF_LAYERS = 2.0
"""The room for words above parts in layers, in heights of their text."""
_THIN = 0.6
"""The least thickness of lines of parts, in pixels of a page."""
_ROOM_BESIDE_SLIDER = 0.52
"""The share of the stage's width that words beside a slider take."""
_ROOMS_OF_WORDS = (0.93, _ROOM_BESIDE_SLIDER, 0.4, 0.3)
"""The shares of the stage's width for words on a construction: the widest that is off the linkage."""


class Earlier(NamedTuple):
    """The still part of an earlier picture: size, view, layout, theme and chart, and groups by name."""

    place: tuple[tuple[int, int], View, Layout, Theme, str | None]
    groups: dict[str, tuple[Group, ...]]


class Arrival(NamedTuple):
    """How charts come in while the view moves: from the right and lower `edge` of the scene that was before.

    A share of their way is `left`. Polygons that were there come in, too; new ones are not seen yet: `waits`.
    """

    edge: tuple[float, float]
    left: float
    waits: bool


class Deferral(NamedTuple):
    """What a picture leaves to a later frame: nothing, unless a hand is dragging.

    While the hand `holds` something, names keep their places. Otherwise `names` says when new places are
    found: at once; "as before" for none, so that names stay as in the picture before; or "in steps", when
    `place_names` has found them all. The still part of the picture `earlier` is drawn again where it has the
    same place. `arrival` says how charts and polygons come in while the view makes room for them.
    """

    holds: bool = False
    names: Literal["at once", "as before", "in steps"] = "at once"
    earlier: Earlier | None = None
    arrival: Arrival | None = None


AT_ONCE = Deferral()


class Picture:
    """A scene at one pixel size and look: places are worked out once, and `groups` describes a pose.

    The view fits what is shown: the scene, its other closure where the look shows that, and the places `also`
    (in the scene's unit). With `kept` it is that view; with `sheet`, the rectangle of the scene on which a
    linkage is built. The look zooms and pans it. What is `docked` in the window has room of its own.

    With a `moment` names stand as is best at that phase alone, else as is best over the cycle. With `apart`
    each joint has a group of its own. What the picture `before` measured of the same scene is reused; its
    names keep their places where only the zoom differs, or while the scene turns into another. `later` says
    what waits for a later frame. The attribute `scene` is in the look's unit. Raises BadInput where the
    look's chart is no quantity of the scene.
    """

    def __init__(
        self,
        scene: Scene,
        size: tuple[int, int],
        look: Look,
        before: Picture | None = None,
        *,
        later: Deferral = AT_ONCE,
        docked: Docked = NOTHING_DOCKED,
        apart: bool = False,
        kept: View | None = None,
        sheet: Box | None = None,
        moment: float | None = None,
        also: tuple[complex, ...] = (),
    ) -> None:
        held, earlier, self._arrival = later.holds, later.earlier, later.arrival
        self._made_for, self._kept = (scene, size, look, docked, held, sheet), kept
        self.sheet, self.held = sheet, held
        self.scene, self.size, self.look = in_unit(scene, look.unit), size, look
        self._goal = self.scene.towards or self.scene
        self.type: Type = before.type if before else Type()
        theme = theme_of(look.theme)
        self.theme: Theme = theme if look.background else on_paper(theme)
        self._beside = self._other_closure(before) if look.ghost else None
        self._apart, self._moment = apart, moment
        follows = held or self.scene.towards is not None
        charts = len(chart_tokens(self.scene, look.chart))
        request = request_of(size, look, charts, docked, still=moment is not None)
        if look.centres and moment is not None:
            from linkanim.picture.centres import CentrePairs

            also = (*also, *CentrePairs(figure(self.scene)).near(self.scene.pose(moment, 2)))
        if also:
            request = request._replace(also=also, lined=True)
        if before and moment is None and (size, look.names) == (before.size, before.look.names):
            same = follows or before._goal is self._goal
            request = request._replace(table=before.fit.request.table) if same else request
        self.late = earlier is not None
        """Whether its still part is that of an earlier picture."""
        self.waits: bool = self._arrival is not None and self._arrival.waits and look.polygons_shown > 0
        """Whether polygons that are new wait for the view and the names, until there is room for them."""
        self._arrange(request, before, held=held)
        anew = before is not None and not self._named_as(before, held=held)
        self.hurried: bool = later.names == "as before" and look.named and anew
        """Whether its names have the places of another picture."""
        new = look.polygons_shown > 0 and before is not None and not before.has_polygons
        self.waits = self.waits or (self.hurried and new)
        tabled = look.names > 1 and before and before.fit.request.table[0]
        if self.hurried and tabled and before and before._goal is self._goal:
            self._arrange(request._replace(table=self._table_size()), before, held=held)
        self.names: Names | None = None
        self._steps = self._named(before, earlier, held=held)
        if later.names != "in steps":
            self.place_names()

    def place_names(self, most: int | None = None) -> bool:
        """Place names in up to `most` more steps, or in all that are left; return whether all are placed."""
        return not any(step == most for step, _ in enumerate(islice(self._steps, most), start=1))

    def _named(self, before: Picture | None, earlier: Earlier | None, *, held: bool) -> Iterator[None]:
        """Give the picture names, and room for their table, in steps; then update its still part."""
        if self.look.named:
            yield from self._placed(before, held=held)
        if self.names and self.names.unlisted:
            yield
            self._arrange(self.fit.request._replace(table=self._table_size()), before, held=False)
            yield
            yield from self._placed(None, held=False)
        self._papered: tuple[Photo | None, Group] | None = None
        self._fastest: tuple[str, tuple[float, float]] | None = None
        if (
            before
            and self.sheet
            and (before.view, before.size, before.theme) == (self.view, self.size, self.theme)
        ):
            self._papered = before._papered
        self._behind: tuple[float, DrawnCurve | None, tuple[Group, ...]] | None = None
        place = self.size, self.view, self.layout, self.theme, self.look.chart
        self.late = earlier is not None and earlier.place == place
        self.earlier: Earlier = earlier if earlier and self.late else Earlier(place, {})
        self._settled = earlier is None or self.fit.has_room

    def preparing(self, look: Look, docked: Docked) -> Generator[None, None, Layout]:
        """Work out in steps what a picture of the scene in another look needs; return its layout."""
        tokens = chart_tokens(self.scene, look.chart)
        for token in tokens:
            quantity(self.scene, token).read(self.figure.cycle)
            yield
        request = request_of(self.size, look, len(tokens), docked)
        if look.names == self.look.names:
            request = request._replace(table=self.fit.request.table)
        return (yield from arranging(self.fit.subject, request)).layout

    def expecting(self, other: Scene) -> Iterator[None]:
        """Work out in steps, and keep, what a picture of another scene in the same look needs."""
        subject = Subject(figure(in_unit(other, self.look.unit)), None, self.type)
        yield
        yield from arranging(subject, self.fit.request)
        self.fit.subject.expected[:] = [subject]

    @property
    def arrived(self) -> bool:
        """Whether charts stand in their places."""
        return self._aside == (0.0, 0.0)

    @cached_property
    def _aside(self) -> tuple[float, float]:
        """How far charts are from their places: to the right where they stand beside the scene, else down.

        They keep step with the view, so that they cut nothing off that is seen before and after.
        """
        if self._arrival is None:
            return 0.0, 0.0
        (right, bottom), left, _ = self._arrival
        return max(right - self._reach.right, 0.0) * left, max(bottom - self._reach.bottom, 0.0) * left

    @property
    def _reach(self) -> Rect:
        """The rectangle to which the scene is cut once charts stand in their places.

        While polygons wait, nothing stands in their place, and the scene is not cut there.
        """
        return self.layout.before_charts if self.waits else self.layout.reach

    @property
    def has_polygons(self) -> bool:
        """Whether polygons are drawn beside the scene."""
        return self.layout.polygons is not None and not self.waits

    def catch_up(self) -> None:
        """Bring the still part up to date where it is that of an earlier picture."""
        if self.late:
            self.late, self._behind = False, None
            self.__dict__.pop("_standing", None)

    def _arrange(self, request: FitRequest, before: Picture | None, *, held: bool) -> None:
        """Fit the scene as requested."""
        scene, look, last = self.scene, self.look, before.fit if before else None
        self.fit: SceneFit = fitted(
            self._goal, self._beside, request, self.type, before=last, held=held, late=self.late
        )
        self.figure: Figure = figure(scene) if scene.towards else self.fit.subject.figure
        self.layout: Layout = self.fit.arrangement.layout
        self.fitted: View = self._kept or self._of_sheet or self.fit.view_of(self.figure)
        """The view before zoom and pan."""
        (right, down), height = look.pan, self.size[1]
        self.view: View = moved(self.fitted, self.about, zoom=look.zoom, pan=(right * height, down * height))
        self.gauge: Gauge = self.fit.arrangement.gauge
        if self.sheet:
            self.gauge = gauge(self.layout.unit, self.figure.shortest * self.fitted.scale)
        setting = DrawSetting(self.figure, self.view, self.gauge, self.theme, self.layout, look, self.type)
        self.drawing = Drawing(setting, apart=self._apart, moment=self._moment)
        self._chart = self._charted()

    @property
    def about(self) -> tuple[float, float]:
        """The pixel about which the look zooms: the stage's middle; of paper, which stays, the window's."""
        whole = Rect(0, 0, *self.size) if self._kept or self.sheet else self.layout.stage
        return whole.middle.real, whole.middle.imag

    @property
    def _of_sheet(self) -> View | None:
        """The view of the sheet on which the linkage is built; None without a sheet."""
        if self.sheet is None:
            return None
        from linkanim.picture.build_sheet import home_view

        return home_view(self.sheet, self.layout)

    def fits(
        self,
        scene: Scene,
        size: tuple[int, int],
        look: Look,
        docked: Docked,
        *,
        held: bool = False,
        sheet: Box | None = None,
    ) -> bool:
        """Return whether it is the picture of these; never for a late picture whose scene lacks room."""
        same = self._made_for[0] is scene and self._made_for[1:] == (size, look, docked, held, sheet)
        return same and self._settled

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
        still = self.scene.towards is None or not info.full_turn or any(measured(self._goal))
        return 2 if shown or still else 0

    def groups(
        self,
        pose: Pose,
        overlay: Overlay = NOTHING_OVER,
        *,
        faint: Sequence[Pose] = (),
    ) -> Iterator[Group]:
        """Yield all that is drawn of a pose, back to front, with `faint` poses behind it."""
        path = overlay.path
        if path and path.blank:
            yield from self._blank(path)
            return
        if overlay.poses and overlay.poses.blank:
            yield self._sheet
            yield from self._posed(overlay)
            return
        if overlay.layers and overlay.layers.parts:
            yield from self._layers(pose, overlay.layers, overlay.layers.parts)
            yield from self._slider(overlay.slider)
            return
        build = overlay.build
        if build and build.draft:
            from linkanim.picture.build_sheet import drafted

            yield self._paper(build.photo)
            yield from drafted(build, build.draft, self.drawing.setting)
            return
        if self.sheet and path is None:
            yield self._paper(build.photo if build else None)
        yield from self._behind_at(pose.input_speed, path)
        if overlay.lane:
            yield self._lane(overlay.lane)
        yield from self._within(self.drawing.wheels(self.drawing.places(pose)))
        for n, other in enumerate(faint, start=1):
            yield from self._within([Group(f"pose-{n}", self.drawing.faint(other))])
        if path and path.cognates:
            from linkanim.picture.cognates import cognate_group

            yield from self._within([cognate_group(self.drawing.setting, pose, path.cognates)])
        if self._moves_behind:
            yield from self._standing
        named = self.names.captions(pose, self.drawing.places(pose)) if self.names else []
        taken = (line.around(self.type) for line in named)
        yield from self._within(self.drawing.moving(pose, chain(self.layout.words, taken)))
        for polygon in () if self.waits else self._polygons:
            stands = overlay.paused and self._moment is None
            yield (polygon.standing(pose.phase) if stands else polygon).group(pose)
        yield from self._on_chart(pose, grasped=overlay.grip)
        yield from self._within(self._named_groups(pose, named))
        if not overlay.construction:  # the words of a construction stand in this place
            yield from self._words(pose, noted=overlay.noted)
        yield from self._handled(pose, overlay)

    def _blank(self, path: PathShown) -> Iterator[Group]:
        """Yield the empty sheet and the pencil's line."""
        from linkanim.picture.build_sheet import drawn_line

        yield from (self._sheet, drawn_line(self.drawing.setting, path))

    def _slider(self, shown: SliderShown | None) -> Iterator[Group]:
        if shown:
            from linkanim.picture.slider import slider

            yield from slider(self.drawing.setting, shown)

    def _posed(self, overlay: Overlay) -> Iterator[Group]:
        """Yield poses that were set down."""
        from linkanim.picture.poses import posed

        assert overlay.poses
        yield from posed(self.drawing.setting, overlay.poses)

    def _constructed(self, steps: int, pose: Pose, leading: SliderShown | None) -> Iterator[Group]:
        """Yield the first steps of a construction, the words on the last of them, and a slider."""
        from linkanim.picture.build_sheet import worded
        from linkanim.picture.constructed import shown_at
        from linkanim.picture.construction import construction_items

        shown = shown_at(self._goal, steps, pose.phase)
        pen = pen_for(self.layout, self.type, self.theme)
        marks = [mark for step in shown.steps for mark in step.marks]
        yield grouped("construction", construction_items(marks, self.view, self.layout.stage, pen))
        facts = f"step {len(shown.steps)} of {shown.total}"
        facts = facts if self._moment is not None else f"{facts} · F7 goes on"
        rooms = _ROOMS_OF_WORDS[1:] if leading else _ROOMS_OF_WORDS
        choices = [worded(self.drawing.setting, shown.steps[-1].words, [facts], room=room) for room in rooms]
        yield next((one for one in choices if not self._covers(one, pose)), choices[0])
        yield from self._slider(leading)

    def _covers(self, words: Group, pose: Pose) -> bool:
        """Return whether words on their backing lie on a link at a pose."""
        places, corners = self.drawing.places(pose), words.layers[0].loops[0]
        left, top = float(corners.real.min()), float(corners.imag.min())
        plate = Rect(left, top, float(np.ptp(corners.real)), float(np.ptp(corners.imag)))
        ends = (pair for body in self.scene.linkage.bodies for pair in combinations(body.joints, 2))
        return any(plate.crossed(places[one], places[other]) is not None for one, other in ends)

    def _layers(self, pose: Pose, shown: LayersShown, parts: Layered) -> Iterator[Group]:
        """Yield the parts in their layers, in the room that is left below the words on them."""
        from linkanim.picture.build_sheet import worded
        from linkanim.picture.layered import LayerView, lifted

        layout, stage = self.layout, self.layout.stage
        words = layout.margin + _LINES_OF_LAYERS * layout.text_size
        stage = stage._replace(y=stage.y + words, height=stage.height - words).inset(2 * layout.margin)
        view = LayerView.fitting(parts.reach, parts.layers, shown.apart, stage)
        view = view.moved(complex(*self.about), self.look.zoom, complex(*self.look.pan) * self.size[1])
        text, unit, pixel = layout.small_size, self.scene.length_unit, max(layout.unit, _THIN)
        yield _NOTHING_STILL
        yield grouped("layers", lifted(parts, pose, unit, view, self.theme, text, pixel=pixel))
        yield worded(self.drawing.setting, shown.sentence, shown.facts, room=_ROOM_BESIDE_SLIDER)

    def _lane(self, shown: Lane) -> Group:
        from linkanim.picture.marks import lane

        return lane(self.drawing.setting, shown)

    @property
    def _overrun(self) -> bool:
        """Whether something may lie where the words stand: names, too, that have another picture's places."""
        return self.look.overrun or self.hurried or self.fitted != self.fit.view_of(self.figure)

    @property
    def edge(self) -> tuple[float, float]:
        """The right and the lower edge to which the scene is cut: charts and polygons are beyond."""
        (wide, high), (right, down) = self.size, self._aside
        return min(self._reach.right + right, wide), min(self._reach.bottom + down, high)

    def _within(self, groups: Iterable[Group]) -> Iterator[Group]:
        """Yield the scene's groups cut off at `edge`; a line of words that would cross it is left out."""
        edge = Rect(0, 0, *self.edge)
        if edge.right == self.size[0] and edge.bottom == self.size[1]:
            yield from groups
            return
        for group in groups:
            words = [line for line in group.captions if self._ends_before(edge, line)]
            yield group._replace(captions=words, within=edge)

    @cached_property
    def _sheet(self) -> Group:
        from linkanim.picture.build_sheet import sheet

        return sheet(self.drawing.setting)

    def _paper(self, photo: Photo | None) -> Group:
        """Return the sheet on which the linkage is built; the same object while nothing of it changes."""
        if self._papered is None or self._papered[0] != photo:
            from linkanim.picture.build_sheet import paper

            self._papered = photo, paper(self.drawing.setting, photo)
        return self._papered[1]

    def _behind_at(self, speed: float, path: PathShown | None) -> tuple[Group, ...]:
        """Return what stands still behind all that moves; the chart and the key depend on the speed."""
        known, curve = self._behind, path.curve if path else None
        if not known or known[1] is not curve or (known[0] != speed and (self._chart or self._legend)):
            self._behind = speed, curve, self._as_earlier("behind", self._still_behind(speed, path))
        assert self._behind
        return self._behind[2]

    def _as_earlier(self, name: str, groups: Iterable[Group]) -> tuple[Group, ...]:
        """Keep groups under a name and return them; for a late picture, the earlier one's of that name."""
        if not self.late or name not in self.earlier.groups:
            self.earlier.groups[name] = tuple(groups)
        return self.earlier.groups[name]

    def _still_behind(self, speed: float, path: PathShown | None) -> Iterator[Group]:
        yield from self._within([self._discs])
        if path and path.curve:
            from linkanim.picture.build_sheet import dashed

            yield from self._within([dashed(self.drawing.setting, path)])
        if not self._moves_behind:
            yield from self._standing
        if self._chart:
            self._chart = self._chart.at(speed)
            yield grouped("chart", self._chart.still(), still=True)
        if self._legend and not self._overrun:
            yield self._legend.group(speed)
        if self.layout.caption and not self._crosses(self.layout.caption):
            yield Group("caption", (), tuple(self._caption(self.layout.caption)), still=True)

    def _crosses(self, caption: Rect) -> bool:
        """Return whether charts or polygons cross the caption on their way."""
        parts = self._arriving
        return not self.arrived and any(one.meets(caption) for one in (parts.chart, parts.polygons) if one)

    def _caption(self, place: Rect) -> Iterator[Caption]:
        """Yield the sentence on what to watch for, below the scene."""
        size, middle = self.layout.small_size, place.x + place.width / 2
        for n, line in enumerate(caption_lines(self.layout, self.scene.look_at, self.type)):
            yield Caption(line, (middle, place.y + CAPTION_STEP * size * n), size, self.theme.dim, "centre")

    @cached_property
    def _discs(self) -> Group:
        return self.drawing.discs()

    @cached_property
    def _standing(self) -> tuple[Group, ...]:
        """What stands still in front of the parts that move behind it."""
        return self._as_earlier("standing", self._within(self.drawing.standing()))

    @cached_property
    def _moves_behind(self) -> bool:
        """Whether something moves behind what else stands still."""
        return self._apart or bool(self.drawing.parts.wheels) or self.look.ghost

    def _on_chart(self, pose: Pose, *, grasped: bool) -> Iterator[Group]:
        """Yield the chart's cursor with the values there, and its grip where it can be grasped."""
        if self._chart:
            yield from self._as_earlier("reading", self._read(self._chart, pose, grasped=grasped))

    def _read(self, chart: ChartStrips, pose: Pose, *, grasped: bool) -> Iterator[Group]:
        items: list[Item] = [*chart.cursor(pose)]
        if grasped:
            from linkanim.picture.marks import grip

            items += grip(chart.foot(pose), self.layout.unit, self.theme)
        yield grouped("reading", [*items, *chart.readings(pose)])

    def _named_groups(self, pose: Pose, named: Sequence[Caption]) -> Iterator[Group]:
        """Yield the words on the scene."""
        if self.names:
            places = self.drawing.places(pose)
            lines = [*self.names.lines(pose, places, self._dimension_lines)]
            yield Group("dimension-lines", lines, made_of=self._dimension_lines)
            yield Group("names", (), named, made_of=self.names)

    @cached_property
    def _dimension_lines(self) -> dict[str, Part]:
        assert self.names
        return self.names.parts(self.figure, self.view, self.gauge, self.theme.dim)

    def _ends_before(self, edge: Rect, line: Caption) -> bool:
        """Return whether a line of text ends before that edge."""
        around = line.around(self.type)
        return around.right <= edge.right and around.bottom <= edge.bottom

    def _words(self, pose: Pose, *, noted: bool) -> Iterator[Group]:
        """Yield the words about the scene, on a backing where something may lie under them."""
        if self._hud is None:
            return
        if self._overrun:
            yield self._backing
            yield from (legend.group(pose.input_speed) for legend in [self._legend] if legend)
        values = self._hud.values(pose)
        notes = self._hud.notes(pose) if noted and values else ()
        yield Group("words", (), [*self._hud_still, *values, *notes])

    @cached_property
    def _hud_still(self) -> tuple[Caption, ...]:
        assert self._hud
        return tuple(self._hud.still())

    @cached_property
    def _backing(self) -> Group:
        assert self._hud
        return Group("backing", [self._hud.backing(self.layout.legend)], still=True, over=True)

    def _handled(self, pose: Pose, overlay: Overlay) -> Iterator[Group]:
        """Yield the marks for the hand: on the chosen bar, and on the joint to be dragged."""
        if overlay == NOTHING_OVER:
            return
        from linkanim.picture.build_sheet import hand, handles, loose, worded
        from linkanim.picture.marks import glow, measure, spots

        if overlay.build:
            if overlay.build.loose:
                yield from loose(overlay.build.loose, self.drawing.setting)
            yield from hand(overlay.build, self.drawing.setting)
        if overlay.construction:
            yield from self._constructed(overlay.construction, pose, overlay.slider)
        if overlay.layers:
            sentence, warns = overlay.layers.sentence, overlay.layers.is_warning
            yield worded(self.drawing.setting, sentence, is_warning=warns)
        for shown in overlay.measured:
            at, head = map(self.view.place, (pose.position[name] for name in shown.frame))
            span = head - at if shown.frame[0] != shown.frame[1] else complex(self.view.scale)
            begin, end = (at + place.conjugate() * span for place in (shown.begin, shown.end))
            yield from measure(self.drawing.setting, begin, end, shown)
        if overlay.path and overlay.path.curve and overlay.path.marked:
            marks = list(handles(self.drawing.setting, overlay.path))
            yield from self._within([Group("handles", marks, over=True)])
        if overlay.poses:
            yield from self._posed(overlay)
        for layers, words in spots(self.drawing.setting, overlay.spots):
            yield Group("spot", layers, [words], over=True)
        if overlay.glow:  # the joint and the length that it changes do not overlap: they are filled together
            light = list(glow(self.drawing.setting, pose, overlay.glow))
            yield Group("glow", light, over=not overlay.measured)
        yield from self._pointed(pose, overlay)

    def _pointed(self, pose: Pose, overlay: Overlay) -> Iterator[Group]:
        """Yield what the mouse points at: an instant on curves and chart, and a thing's card of words."""
        if overlay.instant is None and overlay.told is None:
            return
        from linkanim.picture import told

        if overlay.instant is not None:
            there = self.scene.pose(overlay.instant, self._order, speed=pose.input_speed)
            curves = self.scene.trace if self.look.trace or self.look.ink else ()
            places = [self.view.place(there.position[joint]) for joint in curves]
            lights = told.instant(self.drawing.setting, places)
            yield from self._within([Group("instant", list(lights), over=True)])
            if self._chart:
                yield grouped("instant-read", self._chart.cursor(there))
        if overlay.told:
            yield from told.card(self.drawing.setting, pose, overlay.told, self._greatest(overlay.told.joint))

    def _greatest(self, joint: str) -> tuple[float, float] | None:
        """Return the greatest speed and acceleration of a joint; cached for the last joint."""
        from linkanim.picture.told import greatest

        if joint and (self._fastest is None or self._fastest[0] != joint):
            self._fastest = joint, greatest(self.figure.cycle, joint)
        return self._fastest[1] if joint and self._fastest else None

    def crank_pin_px(self, pose: Pose) -> tuple[float, float]:
        """Return where the pin that the phase drives lies, in pixels."""
        return self.view.to_pixel(*pose.position[self.scene.linkage.drive.joint])

    def chart_phase_at(self, px: float, py: float) -> float | None:
        """Return the phase under a pixel of the chart, 0 to one true period; None beside the chart."""
        return self._chart.phase_at(px, py) if self._chart else None

    def chart_titled_at(self, px: float, py: float) -> str | None:
        """Return the token of the chart whose title is under a pixel; None elsewhere."""
        return self._chart.titled_at(px, py) if self._chart else None

    def _other_closure(self, before: Picture | None) -> Scene | None:
        if before and before._goal is self._goal and before._beside:
            return before._beside
        return ghost_of(self._goal)

    @cached_property
    def _ghost(self) -> Scene | None:
        if not self.look.ghost:
            return None
        return ghost_of(self.scene) if self.scene.towards else self._beside

    def label_at(self, x: float, y: float) -> str | None:
        """Return the label of the row of numbers under a pixel, "" for the class; None elsewhere."""
        return self._hud.label_at(x, y) if self._hud else None

    @cached_property
    def _hud(self) -> Hud | None:
        block, place = self.fit.arrangement.block, self.layout.hud
        if block is None or place is None or not block.lines:
            return None
        return Hud(self.fit.subject.figure.scene, block, place, self.type, self.theme)

    @cached_property
    def _legend(self) -> Legend | None:
        parts = self.drawing.parts
        chain = parts.chain.colours if parts.chain else ()
        ink = parts.inks[0].scale if parts.inks else None
        return legend_for(parts.arrows, self.layout, self.type, self.theme, chain, ink)

    def _charted(self) -> ChartStrips | None:
        tokens = chart_tokens(self.scene, self.look.chart)
        if not tokens:
            return None
        pen = pen_for(self.layout, self.type, self.theme)
        return chart_strips(self.figure, tokens, self._arriving, pen, self.look.over)

    @cached_property
    def _polygons(self) -> tuple[Polygon, ...]:
        place = self._arriving.polygons
        if not place:
            return ()
        from linkanim.picture.polygons import polygons_of

        pen = pen_for(self.layout, self.type, self.theme)
        only = self.look.large_polygon
        return polygons_of(self.figure, place, pen, self._moment, only=only)

    @property
    def _arriving(self) -> Layout:
        """The layout with charts and polygons where they are now, on their way to their places."""
        if self.arrived:
            return self.layout
        (right, down), places = self._aside, (self.layout.chart, self.layout.polygons)
        chart, polygons = (
            place._replace(x=place.x + right)
            if place and place.x >= self.layout.stage.right
            else place and place._replace(y=place.y + down)
            for place in places
        )
        return replace(self.layout, chart=chart, polygons=polygons)

    def polygon_at(self, px: float, py: float) -> int | None:
        """Return the polygon under a pixel: 1 of velocities, 2 of accelerations; None elsewhere."""
        return next((one.order for one in self._polygons if one.rect.holds(px, py)), None)

    def _placed(self, before: Picture | None, *, held: bool) -> Iterator[None]:
        """Place the names of joints and links, and their dimensions, for the fitted view, in steps.

        The names of a picture `before` keep their places where that differs only by zoom, pan and theme,
        while the scene is on its way to another one, and where new places wait for a later frame.
        """
        if before and (self.hurried or self._named_as(before, held=held)):
            names = before.names if self.figure.shown == before.figure.shown else None
            names = replace(names, table=None, unlisted=()) if names and self.hurried else names
            unit, scale = self.scene.length_unit, self.view.scale
            names = names and names.measuring(self.drawing.symbols, unit, scale)
            self.names = names and names.in_theme(before.theme, self.theme)
            return
        from linkanim.picture.labels import Surroundings, names_of

        # names are placed in the fitted view; a zoom only moves them along
        known, setting = self.drawing.symbols, replace(self.drawing.setting, view=self.fitted)
        centres = self.drawing.dead_centres_in(self.fitted) if self.look.names else None
        marks = centres.ticks if centres else ()
        if self._moment is not None and self.look.centres:
            from linkanim.picture.centres import Centres

            marks = (*marks, *Centres(setting).crosses(self.scene.pose(self._moment, 2)))
        turning = motion_of(setting) if self.look.names else None
        around = Surroundings(setting, turning, self._moment, marks, known is not None)
        names = yield from names_of(around, known, centres)
        self.names = replace(names, scale=self.view.scale)

    def _table_size(self) -> tuple[int, float]:
        """Return how many rows a table of all dimensions has, and how wide they are."""
        from linkanim.picture.labels import table_width

        assert self.drawing.symbols
        unit = self.scene.length_unit
        rows = [f"{one.written(unit)}, {one.about}" for one in self.drawing.symbols.dimensions]
        return len(rows), table_width(rows, self.drawing.setting)

    def _named_as(self, other: Picture, *, held: bool) -> bool:
        """Return whether names may keep the places that they have on another picture."""
        both = (self, other)
        looks = ((one.look.names, one.look.joints_named, one.look.centres > 0, one.size) for one in both)
        same = (self.scene, self.fitted, self.layout) == (other.scene, other.fitted, other.layout)
        follows = (held or self.scene.towards is not None) and self.figure.shown == other.figure.shown
        whole = other.names is not None and not other.hurried and self._moment is None
        return len(set(looks)) == 1 and (same or follows) and whole
