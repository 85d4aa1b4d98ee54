"""The numbers of a page over one true period, both ways round: rows of words, and the chart."""

from __future__ import annotations

from collections.abc import Iterator
from math import floor, log10, radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.motion.motion import Motion
from linkanim.picture.diagrams.chart import Pen
from linkanim.picture.diagrams.chart_panel import ChartPanel
from linkanim.picture.diagrams.quantities import quantity
from linkanim.picture.figure import Figure
from linkanim.picture.panels.readings import measured
from linkanim.picture.parts.driven import speed_words
from linkanim.picture.text.text import Type
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene
from linkanim.share.pairs import Pairs
from linkanim.share.tracks import LARGEST, packed

CHART = (960, 300)
_TEXT = (26, 22)
"""The heights of a chart's text and of its small text."""
_LINE = 2.0
_MOMENTS, _MOST = 240, 2880
"""How many values a table holds of a drive's turn, and in all at most; cubics run between them."""


def input_words(scene: Scene) -> str:
    """Return what the input's coordinate is called: "crank angle"."""
    return f"{scene.info.input_name} {scene.linkage.drive.coordinate.name}"


def rows(scene: Scene, speed: float) -> Iterator[dict[str, Any]]:
    """Yield what is told of every pose: where the input is, its speed, struts, what drives it.

    `values` are of equal steps over the period with its end, forth and back; where they are the same but
    for their sign, `back` is that. `text` does not change.
    """
    motion, drive = _motion(scene, speed), scene.linkage.drive.coordinate
    both = (motion, motion.paced(-1.0))
    where = np.asarray(drive.shown(motion.coordinate), float)
    turn = 360 if scene.info.full_turn else 0
    unit = drive.shown_unit(scene.length_unit)
    yield _row(input_words(scene), unit, 0.1, [where]) | {"turn": turn}
    title = "input speed" if scene.info.full_turn else "input rate"
    yield {"label": title, "text": [speed_words(scene, way * speed) for way in (1, -1)]}
    for _, label, of, step in measured(scene):
        found = [np.asarray(of.shown(one), float) for one in both]
        yield _row(label, of.shown_unit(scene.length_unit), step, found)


def _motion(scene: Scene, speed: float) -> Motion:
    """Return the motion at equal steps over the true period, with its end."""
    count = min(_MOMENTS * round(scene.period / radians(360)), _MOST)
    return scene.solve(phase=np.linspace(0.0, scene.period, count + 1), speed=speed)


def _row(label: str, unit: str, step: float, values: list[NDArray[np.float64]]) -> dict[str, Any]:
    forth, back = values[0], values[-1]
    sign = next((sign for sign in (1, -1) if np.array_equal(back, sign * forth)), 0)
    some = values if sign == 0 else values[:1]
    kind = _kind(some)
    packs = {"values": [packed(one, kind) for one in some], **_said(kind)}
    return {"label": label, "unit": unit, "digits": _digits(step), **packs, "back": sign}


def _kind(values: list[NDArray[np.float64]]) -> str:
    """Return the kind of numbers that holds values: 32 bits, or 64 where one is too large for them."""
    largest = max(float(np.abs(one[np.isfinite(one)]).max(initial=0.0)) for one in values)
    return "<f4" if largest < LARGEST else "<f8"


def _said(kind: str) -> dict[str, str]:
    """Return what a page is told of a kind of numbers: nothing of the usual one."""
    return {} if kind == "<f4" else {"kind": kind[1:]}


def _digits(step: float) -> int:
    """Return the decimals that a step between neighbours needs."""
    return min(max(-floor(log10(step) + 1e-9), 0), 6)


def charts(figure: Figure, themes: tuple[Theme, Theme], shown: tuple[str, float], pairs: Pairs) -> list[Any]:
    """Return the chart of a quantity at a speed for both ways round, each with its frame in SVG.

    BadInput with the nearest ones and the list where the scene has no such quantity.
    """
    token, speed = shown
    of = quantity(figure.scene, token)
    text, small = _TEXT
    pens = (Pen(Type(), theme, small, text, _LINE) for theme in themes)
    one, other = (ChartPanel(figure, of, Rect(0, 0, *CHART), pen, speed) for pen in pens)
    return [_chart(one.at(way * speed), other.at(way * speed), pairs) for way in (1, -1)]


def _chart(light: ChartPanel, dark: ChartPanel, pairs: Pairs) -> dict[str, Any]:
    course, (x, values) = light.course, light.curves
    even = np.linspace(0.0, course.span, min(len(light.figure.cycle.phase), _MOST) + 1)
    columns = [np.interp(even, x, np.where(np.isfinite(column), column, np.nan)) for column in values.T]
    kind = _kind(columns)
    curves = [
        {
            "label": light.series.labels[n],
            "colour": pairs.variable(light.colour(n), dark.colour(n)),
            "values": packed(column, kind),
            **_said(kind),
        }
        for n, column in enumerate(columns)
    ]
    span = light.plot.y.high - light.plot.y.low
    return {
        "frame": pairs.elements(light.frame(), dark.frame()),
        "title": light.quantity.title(light.figure.scene.length_unit),
        "area": list(light.plot.area),
        "y": [light.plot.y.low, light.plot.y.high],
        "course": [course.origin, course.scale, course.span],
        "unit": light.series.unit,
        "digits": _digits(span / 500),
        "width": light.width,
        "ink": pairs.variable(light.pen.theme.ink, dark.pen.theme.ink),
        "text": light.pen.text,
        "curves": curves,
    }
