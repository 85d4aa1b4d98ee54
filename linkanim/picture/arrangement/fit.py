"""A scene fitted into a window: what of it is measured once, and outlasts pans, zooms and themes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from linkanim.picture.arrangement.arrange import Arrangement, arranged
from linkanim.picture.arrangement.sweep import Sweep, sweep_of
from linkanim.picture.arrangement.words import WidestRow, blocks, caption_lines, shapes_of, widest_rows
from linkanim.picture.figure import Figure, figure
from linkanim.picture.layout import layout, with_caption, with_table
from linkanim.picture.look import Look
from linkanim.picture.text.text import Type
from linkanim.picture.view import View
from linkanim.scenes.scene import Scene

_BETTER = 1.25
"""So much larger a scene must be with its chart beside it, for the chart to stand there."""
_WIDE_ENOUGH = 420
"""The least width of a window that has its chart beside the scene, in pixels."""


class FitRequest(NamedTuple):
    """What of a window and a look an arrangement depends on."""

    size: tuple[int, int]
    chart: bool
    keys: int
    """How many lines the key to the colours has."""
    hud: bool
    listed: bool
    """Whether it leaves room for the edit list."""
    polygons: bool = False
    row: bool = False
    table: tuple[int, float] = (0, 0.0)
    """How many rows a table beside the figure has, and how wide they are."""
    caption: bool = False


def request_of(size: tuple[int, int], look: Look, *, listed: bool, row: bool) -> FitRequest:
    """Return what an arrangement for a look depends on."""
    chart, keys = look.chart is not None, len(look.vectors) + look.chain
    captioned = look.caption and not listed
    return FitRequest(size, chart, keys, look.hud, listed, look.polygons, row, caption=captioned)


@dataclass(frozen=True)
class Subject:
    """A scene's figure, what it sweeps together with the scene beside it, and the words about them."""

    figure: Figure
    beside: Scene | None
    type: Type

    @cached_property
    def sweep(self) -> Sweep:
        """What both sweep."""
        swept = sweep_of(self.figure)
        return swept | sweep_of(figure(self.beside)) if self.beside else swept

    @cached_property
    def rows(self) -> tuple[WidestRow, ...]:
        """The rows of words about them, at their widest; beside an open list there are none."""
        return widest_rows(self.scenes, self.type)

    @property
    def scenes(self) -> tuple[Scene, ...]:
        """The scene, and the one beside it."""
        return (self.figure.scene, self.beside) if self.beside else (self.figure.scene,)


@dataclass(frozen=True)
class SceneFit:
    """A subject, and how it is arranged for a request."""

    subject: Subject
    request: FitRequest
    arrangement: Arrangement

    @cached_property
    def has_room(self) -> bool:
        """Whether all that is swept is within the scene's room."""
        room, view = self.arrangement.layout.stage, self.arrangement.view
        boxes = [one.box for one in (self.subject.figure, *map(figure, self.subject.scenes[1:]))]
        return all(
            room.x <= x <= room.right and room.y <= y <= room.bottom
            for box in boxes
            for x, y in (view.to_pixel(box.left, box.high), view.to_pixel(box.right, box.low))
        )

    def view_of(self, shown: Figure) -> View:
        """Return the view of the subject's figure; one on the way to it is as large, in the same place."""
        view, whole = self.arrangement.view, self.subject.figure
        if shown is whole:
            return view
        wide, high = (shown.box.right - shown.box.left, shown.box.high - shown.box.low)
        spans = ((whole.box.right - whole.box.left, wide), (whole.box.high - whole.box.low, high))
        share = min((span / own for span, own in spans if own > 0), default=1.0)
        x, y = view.to_pixel(*whole.box.middle)
        across, up = shown.box.middle
        scale = view.scale * share
        return View(scale, x - scale * across, y + scale * up)


def fitted(
    scene: Scene,
    beside: Scene | None,
    request: FitRequest,
    type_: Type,
    *,
    before: SceneFit | None = None,
    held: bool = False,
    late: bool = False,
) -> SceneFit:
    """Return how a scene fits, and one that must fit into its view too.

    What `before` has of the same scenes is taken over, all of it where the same is requested. What the hand
    changes while it is `held` stays in its place, as long as it has room there, and for a `late` frame.
    """
    known = before.subject if before else None
    if known is None or known.figure.scene is not scene or known.beside is not beside:
        subject = Subject(figure(scene), beside, type_)
    elif before and before.request == request and (late or not held or before.has_room):
        return before
    else:
        subject = known
    if held and before and before.request == request:
        stays = SceneFit(subject, request, before.arrangement)
        if late or stays.has_room:
            return stays
    return SceneFit(subject, request, _arranged(subject, request, type_))


def _arranged(subject: Subject, request: FitRequest, type_: Type) -> Arrangement:
    """Return the arrangement with the chart where it leaves the scene larger, and room for most words."""
    below = _with_chart(subject, request, type_, beside=False)
    if not request.chart or request.size[0] < _WIDE_ENOUGH:
        return below
    aside = _with_chart(subject, request, type_, beside=True)
    as_many = 2 * _row_count(aside) >= _row_count(below)
    return aside if as_many and aside.view.scale > _BETTER * below.view.scale else below


def _row_count(arrangement: Arrangement) -> int:
    """Return how many rows of words there are, and one for the title."""
    return 1 + len(arrangement.block.rows) if arrangement.block else 0


def _with_chart(subject: Subject, request: FitRequest, type_: Type, *, beside: bool) -> Arrangement:
    parts = layout(
        request.size,
        chart=request.chart,
        beside=beside,
        listed=request.listed,
        polygons=request.polygons,
        row=request.row,
    )
    parts = with_table(parts, *request.table) if request.table[0] else parts
    sentence = subject.figure.scene.look_at
    if request.caption:
        parts = with_caption(parts, len(caption_lines(parts, sentence, type_)))
    worded = request.hud and not request.listed
    words = blocks(subject.scenes, subject.rows, parts, request.keys, type_) if worded else ()
    shapes = shapes_of(sentence, parts, type_) if worded and not parts.caption else ()
    return arranged(parts, subject.sweep, subject.figure.shortest, words, shapes)
