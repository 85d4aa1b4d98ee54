"""The staging of a scene in a window: what of it is measured once and outlasts pans, zooms and themes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from linkanim.picture.arrangement.arrange import Arrangement, arranged
from linkanim.picture.arrangement.sweep import Sweep, sweep_of
from linkanim.picture.arrangement.words import Said, blocks, said_of
from linkanim.picture.drawing import Scenery
from linkanim.picture.figure import Figure, figure
from linkanim.picture.layout import layout
from linkanim.picture.look import Look
from linkanim.picture.text.text import Type
from linkanim.picture.theme import Theme
from linkanim.picture.view import View, moved
from linkanim.scenes.scene import Scene

_BETTER = 1.25
"""So much larger a scene must be with its chart beside it, for the chart to stand there."""
_WIDE_ENOUGH = 420
"""The least width of a window that has its chart beside the scene, in pixels."""


class Staged(NamedTuple):
    """What of a window and a look an arrangement depends on."""

    size: tuple[int, int]
    chart: bool
    arrows: int
    hud: bool
    listed: bool
    """Whether it leaves room for the edit list."""
    polygons: bool = False


def wanted_of(size: tuple[int, int], look: Look, *, listed: bool) -> Staged:
    """Return what an arrangement for a look depends on."""
    return Staged(size, look.chart is not None, len(look.vectors), look.hud, listed, look.polygons)


@dataclass(frozen=True)
class Subject:
    """A scene's figure, what it sweeps together with the scene beside it, and what is said of it."""

    figure: Figure
    beside: Scene | None
    sweep: Sweep
    type: Type

    @cached_property
    def said(self) -> tuple[Said, ...]:
        """The rows that are ever said of them, at their widest; beside an open list none is."""
        return said_of(self.scenes, self.type)

    @property
    def scenes(self) -> tuple[Scene, ...]:
        """The scene, and the one beside it."""
        return (self.figure.scene, self.beside) if self.beside else (self.figure.scene,)


@dataclass(frozen=True)
class Staging:
    """A subject, and how it is arranged as it is wanted."""

    subject: Subject
    wanted: Staged
    arrangement: Arrangement

    def scenery(self, shown: Figure, theme: Theme, look: Look) -> Scenery:
        """Return the subject's figure, or one on the way to it, as it is drawn: zoomed and panned."""
        (width, height), pan, arrangement = self.wanted.size, look.pan, self.arrangement
        about, shift = (width / 2, height / 2), (pan[0] * height, pan[1] * height)
        fitted = self._view_of(shown)
        view = moved(fitted, about, zoom=look.zoom, pan=shift)
        return Scenery(shown, view, arrangement.gauge, theme, arrangement.layout, look, fitted)

    def _view_of(self, shown: Figure) -> View:
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


def staged(
    scene: Scene, beside: Scene | None, wanted: Staged, type_: Type, *, before: Staging | None = None
) -> Staging:
    """Return the staging of a scene, and of one that must fit into its view too.

    What `before` has of the same scenes is taken over, all of it where the same is wanted.
    """
    known = before.subject if before else None
    if known is None or known.figure.scene is not scene or known.beside is not beside:
        subject = _subject(scene, beside, type_)
    elif before and before.wanted == wanted:
        return before
    else:
        subject = known
    return Staging(subject, wanted, _arranged(subject, wanted, type_))


def _subject(scene: Scene, beside: Scene | None, type_: Type) -> Subject:
    shown = figure(scene)
    sweep = sweep_of(shown) | sweep_of(figure(beside)) if beside else sweep_of(shown)
    return Subject(shown, beside, sweep, type_)


def _arranged(subject: Subject, wanted: Staged, type_: Type) -> Arrangement:
    """Return the arrangement with the chart where it leaves the scene larger, and room for most words."""
    below = _with_chart(subject, wanted, type_, beside=False)
    if not wanted.chart or wanted.size[0] < _WIDE_ENOUGH:
        return below
    aside = _with_chart(subject, wanted, type_, beside=True)
    told = 2 * _told(aside) >= _told(below)
    return aside if told and aside.view.scale > _BETTER * below.view.scale else below


def _told(arrangement: Arrangement) -> int:
    """Return how many rows of words there are, and one for the title."""
    return 1 + len(arrangement.block.rows) if arrangement.block else 0


def _with_chart(subject: Subject, wanted: Staged, type_: Type, *, beside: bool) -> Arrangement:
    parts = layout(
        wanted.size, chart=wanted.chart, beside=beside, listed=wanted.listed, polygons=wanted.polygons
    )
    worded = wanted.hud and not wanted.listed
    words = blocks(subject.scenes, subject.said, parts, wanted.arrows, type_) if worded else ()
    return arranged(parts, subject.sweep, subject.figure.shortest, words)
