"""The report of a scene: one page with its figure, facts, tables and charts, and all of them as files."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from linkanim.digits import rpm, typeset
from linkanim.export import csv_head, csv_rows
from linkanim.paper import html
from linkanim.paper.chart import Page
from linkanim.paper.curves import ChartRequest, Pace, curves_of
from linkanim.paper.figure import Figured
from linkanim.paper.findings import Instant, charted, paces_of, sheet, table
from linkanim.paper.svg import svg
from linkanim.picture.look import Look
from linkanim.scenes.editing.edit import dimensions
from linkanim.scenes.scene import Scene

_CHART = (900, 360)
_FIGURE = (900, 560)
_UNSAFE = re.compile(r"[^\w.-]+")


@dataclass(frozen=True)
class Report:
    """What a report is asked to show: the instants of its tables, and the speeds of tables and charts."""

    scene: Scene
    instants: tuple[Instant, ...]
    paces: tuple[Pace, ...]

    def files(self) -> Iterator[tuple[str, str]]:
        """Yield the report's files, the page first: (name, text)."""
        charts = tuple(self._charts())
        shown = Figured(self.scene, _FIGURE, Look(names=2, hud=False))
        picture = shown.document()
        yield "report.html", html.page(self.scene.title, self._body(picture, shown.caption, charts))
        yield "figure.svg", picture
        for number, (_, token, text) in enumerate(charts, start=1):
            yield f"chart-{number:03}-{_UNSAFE.sub('-', token)}.svg", text
        for number, pace in enumerate(self.paces, start=1):
            yield f"quantities-{number}.csv", _csv(self.scene, pace)

    def _charts(self) -> Iterator[tuple[str, str, str]]:
        """Yield (heading, token, SVG) of each chart."""
        for title, token in charted(self.scene):
            found = curves_of(self.scene, ChartRequest((token,), paces_of(self.scene, token, self.paces)))
            drawn = Page(found, _CHART)
            yield title, token, svg(_CHART, drawn.background, drawn.groups(), title=drawn.about)

    def _body(self, picture: str, caption: str, charts: tuple[tuple[str, str, str], ...]) -> Iterator[str]:
        scene = self.scene
        yield html.heading(1, scene.title)
        yield html.paragraph(scene.source, "source")
        if scene.look_at:
            yield html.paragraph(scene.look_at)
        yield html.figure(picture)
        yield html.paragraph(caption)
        yield html.heading(2, "Facts")
        yield html.facts(scene.info.lines)
        yield html.heading(2, "Dimensions")
        stated = ((item.label, f"{item.value:.10g} {item.unit}".strip()) for item in dimensions(scene))
        values = [(label, typeset(value)) for label, value in stated]
        yield f"<div class='two'>{html.facts(values)}</div>"
        for note in scene.notes:
            yield html.paragraph(note)
        yield from self._tables()
        yield html.heading(2, "Velocities and accelerations as polygons")
        yield html.figure(Figured(scene, _FIGURE, Look(trace=False, polygons=True, hud=False)).document())
        yield html.heading(2, f"Over one period, at {', '.join(map(_speed, self.paces))}")
        for title in dict.fromkeys(title for title, _, _ in charts):
            yield html.heading(3, title)
            yield from (html.figure(text) for heading, _, text in charts if heading == title)

    def _tables(self) -> Iterator[str]:
        for instant in self.instants:
            found = sheet(self.scene, instant, self.paces)
            yield html.heading(2, f"At {found.title}")
            yield from html.sheet_tables(found, [_speed(pace) for pace in self.paces])


def _speed(pace: Pace) -> str:
    return pace.words or rpm(pace.speed)


def _csv(scene: Scene, pace: Pace) -> str:
    """Return every quantity at steps of a degree of phase, as CSV; what is not known is an empty cell."""
    names, columns = table(scene, pace)
    return csv_head(names) + csv_rows([*columns])
