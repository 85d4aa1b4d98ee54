"""The report of a scene: a hand-out of a few pages, and on demand every quantity and chart behind it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

from linkanim.explain.documents import HTML, chapters
from linkanim.explain.inputs import PoseRequest
from linkanim.explain.solution import Solution, solution
from linkanim.export import csv_head, csv_rows
from linkanim.paper import html
from linkanim.paper.chart import Page
from linkanim.paper.curves import ChartRequest, Pace, curves_of
from linkanim.paper.figure import Figured
from linkanim.paper.findings import Instant, Values, charted, paces_of, place_of, sheet, table
from linkanim.paper.html import Beside, FigurePart, Markup, Part, ReportChapter
from linkanim.paper.svg import svg
from linkanim.paper.tables import speed_words, value_tables
from linkanim.paper.topics import topics
from linkanim.paper.vectors import vectors_svg
from linkanim.picture.figure import figure
from linkanim.picture.look import Look
from linkanim.scenes.editing.edit import dimensions
from linkanim.scenes.scene import Scene

_CHART = (400, 170)
_WIDE, _TALL = (820, 440), (440, 700)
"""The figure's size in pixels: as wide as the page, or beside the facts."""
_HIGH = 1.1
"""How high for its width a scene is whose figure stands so."""
_POLYGONS = {2: (440, 380), 3: (310, 400)}
"""By how many stand in a row."""
_UNSAFE = re.compile(r"[^\w.-]+")
_LONGEST = 60
"""Letters of a chart's file name that come from its quantities."""


class DrawnChart(NamedTuple):
    """A chart as SVG: its quantities, and what it shows."""

    tokens: tuple[str, ...]
    caption: str
    picture: str


@dataclass(frozen=True)
class Report:
    """What a report is asked to show: the instants of its tables, the speeds of tables and charts, digits.

    With `every` it has, behind the hand-out, a table of every quantity at each instant, and every chart.
    """

    scene: Scene
    instants: tuple[Instant, ...]
    paces: tuple[Pace, ...]
    digits: int = 4
    every: bool = False

    def files(self) -> Iterator[tuple[str, str]]:
        """Yield the report's files, the page first: (name, text)."""
        parts = tuple(self._chapters())
        yield "report.html", html.page(self.scene.title, self._head(), parts)
        yield "figure.svg", self._figure.document()
        if self._worked.loops:
            yield "loops.svg", vectors_svg(self._worked)
        for number, chart in enumerate(self._charts, start=1):
            name = _UNSAFE.sub("-", "-".join(chart.tokens))[:_LONGEST].rstrip("-.")
            yield f"chart-{number:03}-{name}.svg", chart.picture
        for number, pace in enumerate(self.paces, start=1):
            yield f"quantities-{number}.csv", _csv(self.scene, pace)

    @cached_property
    def _values(self) -> Values:
        return Values(self.scene)

    @cached_property
    def _figure(self) -> Figured:
        return Figured(self.scene, _TALL if self._tall else _WIDE, Look(names=2, hud=False))

    @cached_property
    def _tall(self) -> bool:
        box = figure(self.scene).box
        return box.high - box.low > _HIGH * (box.right - box.left)

    @cached_property
    def _worked(self) -> Solution:
        return solution(PoseRequest(self.scene, "phase", self._figure.shown_phase, self.paces[0].speed))

    @cached_property
    def _charts(self) -> tuple[DrawnChart, ...]:
        """All charts in the order of the page."""
        return tuple(chart for some in self._by_topic.values() for chart in some)

    @cached_property
    def _by_topic(self) -> dict[str, tuple[DrawnChart, ...]]:
        found = {
            topic.title: tuple(self._drawn(*planned) for planned in topic.charts)
            for topic in topics(self._values, self.paces)
        }
        if self.every:
            known = ((token, f"{title}: {token}") for title, token in charted(self._values))
            found["Every quantity over one period"] = tuple(
                self._drawn((token,), self.scene.quantities[token].words) for token, _ in known
            )
        return found

    def _drawn(self, tokens: tuple[str, ...], caption: str) -> DrawnChart:
        order, paces = self.scene.quantities[tokens[0]].order, paces_of(self.scene, tokens[0], self.paces)
        drawn = Page(curves_of(self.scene, ChartRequest(tokens, paces)), _CHART, brief=True)
        picture = svg(_CHART, drawn.background, drawn.groups(), title=caption)
        at = f", at {speed_words(paces[0])}" if order and len(paces) == 1 else ""
        return DrawnChart(tokens, f"{caption}{at}", picture)

    def _head(self) -> Iterator[str]:
        yield html.paragraph(self.scene.source, "source")
        if self.scene.look_at:
            yield html.paragraph(self.scene.look_at)

    def _chapters(self) -> Iterator[ReportChapter]:
        yield ReportChapter("The mechanism", tuple(self._mechanism()))
        if self._worked.loops:
            yield ReportChapter("Vector loops", tuple(self._vector_loops()))
        yield ReportChapter("Values", tuple(self._tables()))
        period = f"over one period, at {', '.join(map(speed_words, self.paces))}"
        charts = self._by_topic
        every = charts.get("Every quantity over one period")
        for title, some in charts.items():
            if some is not every:
                yield ReportChapter(title, tuple(_in_rows(map(_figure_of, some))))
        yield ReportChapter("Velocity and acceleration polygons", tuple(self._polygons()))
        if every is not None:
            for instant in self.instants:
                found = sheet(self._values, instant, self.paces, self.digits)
                tables = html.sheet_parts(found, [speed_words(pace) for pace in self.paces])
                yield ReportChapter(f"Every quantity at {found.title}", tuple(tables))
            yield ReportChapter(f"Every quantity {period}", tuple(_in_rows(map(_figure_of, every))))

    def _mechanism(self) -> Iterator[Part]:
        scene, shown = self.scene, self._figure
        drawn = FigurePart(shown.document(), f"{scene.title} with its dimensions at {shown.caption}")
        stated = ((item.label, f"{item.value:.10g} {item.unit}".strip()) for item in dimensions(scene))
        facts, lengths = ("Facts", scene.info.lines), ("Dimensions", tuple(stated))
        if self._tall:
            yield Beside((drawn, (html.facts(*facts, 1), html.facts(*lengths, 1))))
        else:
            yield from (html.facts(*facts, 2), drawn, html.facts(*lengths, 3))

    def _vector_loops(self) -> Iterator[Part]:
        caption = f"Vector loops at {self._figure.caption}"
        given, loops, *_ = self._worked.chapters
        alone = replace(self._worked, chapters=(replace(given, steps=()), loops))
        # behind the headings of both and the figure
        _, _, _, *equations = chapters(alone, HTML)
        yield Beside((FigurePart(vectors_svg(alone), caption, 90), tuple(map(Markup, equations))))

    def _tables(self) -> Iterator[Part]:
        for one in value_tables(self._values, self.instants, self.paces, self.digits):
            yield html.values_part(one)
        for note in self.scene.notes:
            yield Markup(html.paragraph(note))

    def _polygons(self) -> Iterator[Part]:
        look = Look(trace=False, polygons=True, hud=False)
        pace, found = self.paces[0], []
        across = 3 if len(self.instants) % 3 == 0 else 2
        for instant in self.instants:
            shown = Figured(self.scene, _POLYGONS[across], look, instant.phase, speed=pace.speed)
            caption = f"Polygons at {place_of(self.scene, instant)}, {speed_words(pace)}"
            found.append(FigurePart(shown.document(), caption))
        yield from _in_rows(found, across)


def _in_rows(parts: Iterable[FigurePart], across: int = 2) -> Iterator[Beside]:
    """Yield figures side by side, so many in a row."""
    known = tuple(parts)
    yield from (Beside(known[n : n + across], across) for n in range(0, len(known), across))


def _figure_of(chart: DrawnChart) -> FigurePart:
    return FigurePart(chart.picture, chart.caption)


def _csv(scene: Scene, pace: Pace) -> str:
    """Return every quantity at steps of a degree of phase, as CSV; what is not known is an empty cell."""
    names, columns = table(scene, pace)
    return csv_head(names) + csv_rows([*columns])
