"""The report of a scene: a hand-out of a few pages, and on demand every quantity and chart behind it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from functools import cached_property
from html import unescape
from itertools import chain, count, groupby, product
from math import isclose

import numpy as np

from linkanim import __version__
from linkanim.explain.documents import HTML
from linkanim.explain.solution import PoseRequest, Solution, solution
from linkanim.export import csv_head, csv_rows
from linkanim.frozen import frozen
from linkanim.intake import NumberTable
from linkanim.mechanics.quantities import input_symbol
from linkanim.paper import html
from linkanim.paper.chart import Page
from linkanim.paper.curves import MeasuredCurve, Pace, compared, curves_of, within_a_turn
from linkanim.paper.figure import DIMENSIONED, Figured
from linkanim.paper.findings import (
    Chart,
    Instant,
    Values,
    charted,
    paces_of,
    sheet,
    table,
    topics,
    value_tables,
)
from linkanim.paper.html import Beside, FigurePart, Part, TablePart
from linkanim.paper.sentences import about, closing
from linkanim.paper.svg import svg
from linkanim.paper.vectors import polygons_svg, vectors_svg
from linkanim.picture.dimensions import symbols
from linkanim.picture.figure import figure
from linkanim.picture.look import Look
from linkanim.picture.quantities import speed_words
from linkanim.picture.stills import input_rests, still_phase
from linkanim.picture.text import subscripted
from linkanim.scenes.editing import Dimension, dimensions
from linkanim.scenes.files import PublishedTable
from linkanim.scenes.scene import Scene
from linkanim.units import rounded, significant
from linkanim.words import said, said_as, sentences

_CHART = (400, 205)
_BROAD_CHART = (820, 205)
"""The size in pixels of a chart that has a row of its own."""
_WIDE, _TALL = (820, 440), (360, 640)
"""The figure's size in pixels: as wide as the page, or beside facts and dimensions."""
_HIGHEST, _HIGHEST_BESIDE = 160, 80
"""The greatest height in mm of the figure beside its dimensions, and of loops and poses."""
_MOST_LINES = 34
"""The most dimensions in one column beside the figure."""
_POSES = {2: (400, 270), 3: (272, 184)}
_TALL_POSE = (264, 372)
"""The size of a pose in pixels, by how many stand in a row: letters are as large as the figure's."""
_NAMES = 60
"""Room for names about an upright figure, in pixels."""
_HIGH = 1.1
"""The ratio of height to width above which a scene's figure is upright."""
_POLYGONS = 820, 300
"""The size in pixels of both polygons of a pose, side by side."""
_SAME = 1e-9
"""The share of itself by which two numbers of one dimension differ at most."""
_LEFT, _RIGHT = "to the left", "to the right"
_COMPARED = 19
"""The most rows of a measured table that are printed."""
_PRINTED = 6
"""Significant digits of values beside printed ones."""
_UNSAFE = re.compile(r"[^\w.-]+")
_WORD = re.compile(r"\w+")
_DECIMALS = re.compile(r"\d+\.\d+")
_TAG, _UNSEEN = re.compile(r"<[^>]*>"), re.compile(r"[\s\u2061-\u2064]")
_WIDTH = 115
"""The letters in a row of a table as wide as the page."""
_HALF_A_PAGE = 50
"""Letters and signs of the longest equation that stands beside the figure."""
_BRACES = {ord("{"): None, ord("}"): None}
_LONGEST = 60
"""Letters of a chart's file name that come from its quantities."""

DrawnChart = tuple[tuple[str, ...], FigurePart]
"""A chart's quantities, and how it is shown."""


@frozen
class Report:
    """What a report is asked to show: the instants of its tables, the speeds of tables and charts, digits.

    Polygons are drawn, and tables compared, at the `polygon_pace`, else at every speed and at the first. With
    the `derivation` the loops are worked out in symbols. `measured` tables, by quantity, are compared with
    the solution, under their `label`; `published` values of the scene have tables of their own. With
    `every`, the hand-out is followed by a table of every quantity at each instant, and by every chart.
    """

    scene: Scene
    instants: tuple[Instant, ...]
    paces: tuple[Pace, ...]
    digits: int = 4
    every: bool = False
    measured: Mapping[str, NumberTable] = field(default_factory=dict)
    label: str = "measured"
    published: tuple[PublishedTable, ...] = ()
    polygon_pace: Pace | None = None
    derivation: bool = True
    progress: Callable[[int, int], None] | None = None
    """Is told of each part that is begun: how many there are by then, and 0 for how many in all."""

    def files(self) -> Iterator[tuple[str, str]]:
        """Yield the report's files, the page first: (name, text)."""
        chapters = ((title, self._watched(parts)) for title, parts in self._chapters())
        yield "report.html", html.page(said(self.scene.title), self._head(), chapters)
        yield "figure.svg", self._figure.document()
        if self._worked.arrows:
            yield "loops.svg", vectors_svg(self._worked)
        charts = chain(*self._topics.values(), self._every)
        for number, (tokens, chart) in enumerate(charts, start=1):
            name = _UNSAFE.sub("-", "-".join(tokens))[:_LONGEST].rstrip("-.")
            yield f"chart-{number:03}-{name}.svg", chart.picture
        for number, pace in enumerate(self.paces, start=1):
            names, columns = table(self.scene, pace)
            yield f"quantities-{number}.csv", csv_head(names) + csv_rows([*columns])

    @cached_property
    def _parts(self) -> Iterator[int]:
        return count(1)

    def _begin(self) -> None:
        if self.progress:
            self.progress(next(self._parts), 0)

    def _watched(self, parts: Iterable[Part]) -> Iterator[Part]:
        for part in parts:
            self._begin()
            yield part

    @cached_property
    def _values(self) -> Values:
        return Values(self.scene)

    @cached_property
    def _figure(self) -> Figured:
        return Figured(self.scene, self._size, DIMENSIONED, still_phase(self.scene))

    @cached_property
    def _size(self) -> tuple[int, int]:
        """The figure's size in pixels; an upright one has its scene's shape, with room for names."""
        if not self._tall:
            return _WIDE
        box, (wide, high) = figure(self.scene).box, _TALL
        within = (wide - _NAMES) * (box.high - box.low) / (box.right - box.left)
        return wide, min(round(within) + _NAMES, high)

    @cached_property
    def _tall(self) -> bool:
        box = figure(self.scene).box
        return box.high - box.low > _HIGH * (box.right - box.left)

    @cached_property
    def _worked(self) -> Solution:
        return solution(PoseRequest(self.scene, "phase", self._figure.shown_phase, self.paces[0].speed))

    @cached_property
    def _topics(self) -> dict[str, list[DrawnChart]]:
        """The charts of each topic."""
        by_topic = topics(self._values, self.paces).items()
        return {title: [*self._in_topic(charts)] for title, charts in by_topic}

    def _in_topic(self, charts: list[Chart]) -> Iterator[DrawnChart]:
        """Yield the charts of a topic; of an odd number, one with the most curves is as broad as the page.

        It is sought among those with an even number before them, so that the others stand in pairs.
        """
        pairs = charts[:: 2 if len(charts) % 2 else len(charts)]
        broad = max(reversed(pairs), key=lambda chart: len(chart[0])) if len(charts) % 2 else None
        for chart in charts:
            yield self._drawn(*chart, broad=chart is broad)

    @cached_property
    def _every(self) -> list[DrawnChart]:
        tokens = charted(self._values) if self.every else ()
        return [self._drawn((token,), self.scene.quantities[token].words) for token in tokens]

    def _drawn(self, tokens: tuple[str, ...], caption: str, *, broad: bool = False) -> DrawnChart:
        self._begin()
        order, paces = self.scene.quantities[tokens[0]].order, paces_of(self.scene, tokens[0], self.paces)
        curves, size = within_a_turn(curves_of(self.scene, tokens, paces)), _BROAD_CHART if broad else _CHART
        drawn = Page(curves, size=size, brief=True)
        picture = svg(size, drawn.background, drawn.groups(), title=caption)
        if order and len(paces) == 1:
            caption = said("{caption}, at {speed}", caption=caption, speed=paces[0].words)
        return tokens, FigurePart(picture, caption, words=about(curves), broad=broad)

    def _head(self) -> Iterator[str]:
        yield html.paragraph(self.scene.source, "source")
        if self.scene.look_at:
            yield html.paragraph(said(self.scene.look_at))
        speeds = said_as("list", ", ").join(pace.words for pace in self.paces)
        yield html.paragraph(
            sentences(
                said(
                    "All positions, velocities and accelerations are closed-form solutions by linkanim "
                    "{version}.",
                    version=__version__,
                ),
                self._steadily(speeds),
                said("Numbers have {digits} significant digits.", digits=self.digits),
            )
        )

    def _steadily(self, speeds: str) -> str:
        """Return the sentence on the input's speed."""
        known, second = {"link": self.scene.info.input_said, "speeds": speeds}, self.paces[0].acceleration
        if second:
            return said(
                "The speed of the {link} is {speeds}, and its acceleration {second} rad/s² in every position "
                "shown.",
                **known,
                second=f"{second:g}",
            )
        return said("The speed of the {link} is {speeds}, constant in time.", **known)

    def _chapters(self) -> Iterator[tuple[str, Iterable[Part]]]:
        yield said("The mechanism"), self._mechanism()
        if self._worked.arrows:
            yield said("Vector loops"), self._vector_loops()
            if self.derivation:
                yield said("Derivation"), self._derivation()
        if len(self.instants) > 1:
            yield said("Poses"), self._poses()
        yield said("Values"), self._tables()
        for title, charts in self._topics.items():
            yield title, _in_rows([chart for _, chart in charts])
        if self.published:
            yield said("Comparison with printed values"), [self._printed(one) for one in self.published]
        if self.measured:
            yield said("Comparison: {label}", label=self.label), self._comparison()
        yield said("Velocity and acceleration polygons"), self._polygons()
        yield (
            said("Summary"),
            [html.paragraph(self._typeset(one)) for one in closing(self.scene, self.paces[0])],
        )
        if self.every:
            speeds = [pace.words for pace in self.paces]
            for instant in self.instants:
                place, unit = instant.place(self.scene), self.scene.length_unit
                values = sheet(self._values, instant, self.paces, self.digits)
                title = said("Every quantity at {place}", place=place)
                yield title, html.sheet_parts(values, unit, place, speeds)
            title = said(
                "Every quantity over one period, at {speeds}", speeds=said_as("list", ", ").join(speeds)
            )
            yield title, _in_rows([chart for _, chart in self._every])

    def _mechanism(self) -> Iterator[Part]:
        scene, shown = self.scene, self._figure
        drawn = FigurePart(
            shown.document(),
            said("{title} with its dimensions at {place}", title=said(scene.title), place=shown.caption),
        )
        stated = self._dimensions()
        known = tuple((said(label), self._typeset(value)) for label, value in scene.info.lines)
        own = scene.linkage.drive.speed
        heading = said("Facts")
        if [pace.speed for pace in self.paces] != [own]:
            heading = said("Facts at {speed}", speed=speed_words(scene, own))
        facts, lengths = (heading, known), (said("Dimensions"), tuple(stated))
        if self._tall:
            yield html.facts(*facts, 3 if _widest(known, 3) <= _WIDTH else 2)
            told = html.facts(*lengths, 1 if len(lengths[1]) <= _MOST_LINES else 2)
            yield Beside((replace(drawn, highest=_HIGHEST), told))
        else:
            yield from (html.facts(*facts, 2), drawn, html.facts(*lengths, 3))

    def _dimensions(self) -> Iterator[tuple[str, str]]:
        """Yield what the scene states, each dimension of the figure with its symbol, and the figure's others.

        A dimension has the symbol of the figure's that is as long; of several, of that with the most joints
        of its label.
        """
        drawn = [*symbols(figure(self.scene)).dimensions]
        items = [*map(_to_its_side, dimensions(self.scene))]
        pairs = sorted(
            (-len({*_WORD.findall(item.label)} & {*_WORD.findall(one.about)}), n, m)
            for n, item in enumerate(items)
            for m, one in enumerate(drawn)
            if one.angle == (item.unit == "deg") and isclose(item.value, one.value, rel_tol=_SAME)
        )
        named: dict[int, int] = {}
        for _, n, m in pairs:
            if n not in named and m not in named.values():
                named[n] = m
        for n, item in enumerate(items):
            symbol = f"{drawn[named[n]].symbol}  " if n in named else ""
            yield f"{symbol}{self._indexed(item.label)}", self._stated(item.value, item.unit)
        for m, one in enumerate(drawn):
            if m not in named.values():
                unit = "deg" if one.angle else self.scene.length_unit
                yield f"{one.symbol}  {one.about}", self._stated(float(f"{one.value:.6g}"), unit)

    def _indexed(self, label: str) -> str:
        """Return words with the names of joints in them typeset: Pin O₂."""
        names = {joint.name for joint in self.scene.linkage.joints}
        return _WORD.sub(lambda index: subscripted(index[0]) if index[0] in names else index[0], label)

    def _typeset(self, text: str) -> str:
        """Return words of the scene's facts with the tables' digits, and the input's symbol as it is set."""
        symbol = input_symbol(self.scene.linkage)
        return _shorter(text, self.digits).replace(symbol.translate(_BRACES), symbol)

    @staticmethod
    def _stated(value: float, unit: str) -> str:
        number = f"{value:.10g}"
        return f"{number}°" if unit == "deg" else f"{number} {unit}".strip()

    def _vector_loops(self) -> Iterator[Part]:
        caption = said("Vector loops at {place}", place=self._figure.caption)
        equations = "\n".join(HTML.step(step) for step in self._worked.loop_chapter.steps)
        drawn = FigurePart(vectors_svg(self._worked), caption, _HIGHEST_BESIDE)
        longest = max(len(_UNSEEN.sub("", unescape(_TAG.sub("", row)))) for row in equations.split("</mtr>"))
        if longest <= _HALF_A_PAGE:
            yield Beside((drawn, (equations,)))
        else:
            yield drawn
            yield equations

    def _derivation(self) -> Iterator[Part]:
        """Yield the formulas of the positions, and of the differentiated loops, in symbols."""
        yield html.paragraph(
            said(
                "Each step goes on from those before it. The last steps differentiate the loops with respect "
                "to the input. Their coefficients, times the input's velocity and its square, are the "
                "velocities and accelerations."
            )
        )
        yield f"<div class='derivation'>{''.join(HTML.derivation(self._worked))}</div>"

    def _comparison(self) -> Iterator[Part]:
        """Yield a chart and a table of each quantity that was measured: both values and their difference."""
        for token, given in self.measured.items():
            pace = self.polygon_pace or self.paces[0]
            curves, measured = compared(self.scene, token, pace, given, self.label)
            words = self.scene.quantities[token].words
            drawn = Page(curves, size=_CHART, brief=True, measured=measured)
            worst = measured.worst
            unit = self.scene.quantities[token].display_unit(self.scene.length_unit)
            off = f"{rounded(abs(float(measured.differences[worst])), 3)} {unit}".strip()
            at = f"{measured.inputs[worst]:.6g} {'s' if measured.over == 'time' else '°'}".replace(" °", "°")
            chart = FigurePart(
                svg(_CHART, drawn.background, drawn.groups(), title=words),
                said(
                    "{quantity}, at {speed}, and {label}", quantity=words, speed=pace.words, label=self.label
                ),
                words=said("The largest difference is {off}, at {place}.", off=off, place=at),
            )
            yield Beside((chart, self._differences(measured, words, unit)))

    def _differences(self, measured: MeasuredCurve, words: str, unit: str) -> TablePart:
        """Return some rows of a measured table, evenly chosen: both values and their difference."""
        count = len(measured.inputs)
        chosen = np.unique(np.linspace(0, count - 1, min(count, _COMPARED)).round().astype(int))
        columns = (measured.ours, measured.values, measured.differences, measured.percent())
        rows = [
            [f"{measured.inputs[n]:.6g}", *(rounded(float(column[n]), self.digits) for column in columns)]
            for n in chosen
        ]
        at = said("time (s)") if measured.over == "time" else said("input (°)")
        of = f" ({unit})" if unit else ""
        ours, off = said("this solution"), said("difference")
        heads = [at, f"{ours}{of}", f"{self.label}{of}", f"{off}{of}", said("percent")]
        title = said("{quantity}: this solution and {label}", quantity=words, label=self.label)
        if len(chosen) < count:
            title = said("{title}, {some} of {count} rows", title=title, some=len(chosen), count=count)
        return html.table(title, heads, rows)

    def _printed(self, printed: PublishedTable) -> TablePart:
        """Return a table of printed values of each method, and by how much they differ from ours."""
        scene = self.scene
        motion = scene.solve(angle=printed.angle, speed=printed.speed)
        heads = [said("quantity"), said("this solution")]
        heads += [head for method in printed.methods for head in (method, said("percent"))]
        rows = []
        for token, values in printed.values.items():
            quantity = scene.quantities[token]
            ours = float(quantity.displayed(motion))
            unit = quantity.display_unit(scene.length_unit)
            # a length in the table is in metres
            per = scene.linkage.metre if "{}" in quantity.unit else 1.0
            row = [f"{quantity.words} {quantity.symbol} ({unit})", significant(ours, _PRINTED)]
            for value in values:
                off = 100 * (value / per - ours) / abs(ours)
                row += [significant(value / per, _PRINTED), rounded(off, 2)]
            rows.append(row)
        place = Instant(float(motion.phase)).place(scene)
        return html.table(f"{printed.source}: {place}, {printed.speed:g} rad/s", heads, rows)

    def _poses(self) -> Iterator[Part]:
        """Yield a figure of the scene at each instant."""
        look = Look(names=1, hud=False, trace=False)
        across = 3 if self._tall or len(self.instants) % 3 == 0 else 2
        size = _TALL_POSE if self._tall else _POSES[across]
        figures = (
            FigurePart(
                Figured(self.scene, size, look, instant.phase).document(),
                said("The mechanism at {place}", place=instant.place(self.scene)),
                _HIGHEST_BESIDE,
            )
            for instant in self.instants
        )
        return iter(_in_rows([*figures], across))

    def _tables(self) -> Iterator[Part]:
        for one in value_tables(self._values, self.instants, self.paces, self.digits):
            yield html.values_part(one)
        for note in self.scene.notes:
            yield html.paragraph(note)

    def _polygons(self) -> Iterator[Part]:
        look, paces = Look(trace=False, hud=False), (self.polygon_pace,) if self.polygon_pace else self.paces
        moving = (one for one in self.instants if not input_rests(self.scene, one.phase))
        for instant, pace in product(moving, paces):
            speed, second = pace.speed, pace.acceleration
            shown = Figured(self.scene, _POLYGONS, look, instant.phase, speed=speed, acceleration=second)
            title = said(
                "Velocity and acceleration polygon at {place}, {speed}",
                place=instant.place(self.scene),
                speed=pace.words,
            )
            yield FigurePart(polygons_svg(shown), title)


def _to_its_side(item: Dimension) -> Dimension:
    """Return a dimension to the left that is negative as one to the right, as the figure has it."""
    if item.value < 0 and item.label.endswith(_LEFT):
        label = f"{item.label.removesuffix(_LEFT)}{_RIGHT}"
        return replace(item, label=label, value=-item.value)
    return item


def _widest(lines: Sequence[tuple[str, str]], columns: int) -> int:
    """Return how many letters wide labels and values are in that number of columns."""
    high = -(-len(lines) // columns)
    some = (lines[n : n + high] for n in range(0, len(lines), high))
    return sum(max(map(len, part)) for one in some for part in zip(*one, strict=True))


def _shorter(text: str, digits: int) -> str:
    """Return words with every decimal number in at most `digits` significant digits, as in the tables."""

    def shorter(match: re.Match[str]) -> str:
        return min(match[0], rounded(float(match[0]), digits), key=len)

    return _DECIMALS.sub(shorter, text)


def _in_rows(parts: list[FigurePart], across: int = 2) -> Iterator[Part]:
    """Yield figures side by side, `across` in a row; a broad figure has a row of its own."""
    for broad, some in groupby(parts, key=lambda part: part.broad):
        row = [*some]
        for n in range(0, len(row), across):
            yield from row[n : n + 1] if broad else [Beside(tuple(row[n : n + across]), across)]
