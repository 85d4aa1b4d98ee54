"""The numbers of a page over one true period, both ways round: rows of words, and the chart."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from math import floor, log10, radians
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.facts.register import Quantity
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
"""How many steps a table has for a drive's turn, and in all at most; cubics run between its entries."""
_INSIDE = 1e-9
"""How far inside of a way there, or back, its table's ends are, in phase."""
_NEAR, _NEARER = 1e-3, 1e-4
"""So far from an end, in phase, is looked how steeply something grows towards it."""


def input_words(scene: Scene) -> str:
    """Return what the input's coordinate is called: "crank angle"."""
    return f"{scene.info.input_name} {scene.linkage.drive.coordinate.name}"


def parts_of(scene: Scene) -> int:
    """Return in how many equal parts a true period's tables are: each way there and back of a swing is one.

    At its ends rates may change their sign at once, or grow without bound.
    """
    return 1 if scene.info.full_turn else 2 * round(scene.period / radians(360))


def rows(scene: Scene, speed: float) -> Iterator[dict[str, Any]]:
    """Yield what is told of every pose: where the input is, its speed, struts, what drives it.

    `values` are of equal steps over each part of the period with its end, forth and back; where they are the
    same but for their sign, `back` is that. `text` does not change.
    """
    drive, phases = scene.linkage.drive.coordinate, _phases(scene, 0.0, scene.period)
    motion = scene.solve(phase=phases, speed=speed)
    both = (motion, motion.paced(-1.0))
    where = np.asarray(drive.shown(motion.coordinate), float)
    turn = 360 if scene.info.full_turn else 0
    unit = drive.shown_unit(scene.length_unit)
    yield _row(input_words(scene), unit, 0.1, [where]) | {"turn": turn}
    title = "input speed" if scene.info.full_turn else "input rate"
    yield {"label": title, "text": [speed_words(scene, way * speed) for way in (1, -1)]}
    for _, label, of, step in measured(scene):
        poles = _poles(scene, of)
        found = [np.asarray(of.shown(one), float) * _weight(phases, poles) for one in both]
        yield _row(label, of.shown_unit(scene.length_unit), step, found) | _growing(poles)


def _phases(scene: Scene, begin: float, end: float) -> NDArray[np.float64]:
    """Return phases at equal steps from one to another, part by part with its ends."""
    parts = parts_of(scene)
    count = max(min(_MOMENTS * round(scene.period / radians(360)), _MOST) // parts, 3)
    ends = np.linspace(begin, end, parts + 1)
    if parts == 1:
        return np.linspace(begin, end, count + 1)
    inside = math.copysign(_INSIDE, end - begin)
    return np.concatenate(
        [np.linspace(a + inside, b - inside, count + 1) for a, b in pairwise(ends.tolist())]
    )


_Poles = tuple[int, int]
"""As which powers of its sine and cosine, of half the phase, something grows towards the ends of a swing."""


def _poles(scene: Scene, of: Quantity) -> _Poles:
    """Return how a quantity grows towards the input's ends, 0 where it does not."""
    if scene.info.full_turn:
        return 0, 0
    return _order(scene, of, 0.0), _order(scene, of, math.pi)


def _order(scene: Scene, of: Quantity, end: float) -> int:
    places = end + np.array([0.0, _NEAR, _NEARER])
    here, near, nearer = (
        np.max(np.abs(row)) for row in np.atleast_2d(of.shown(scene.solve(phase=places)).T).T
    )
    if not np.isinf(here):
        return 0
    growth = math.log(nearer / near, _NEAR / _NEARER) if 0 < near < nearer < math.inf else 1.0
    return max(round(growth), 1)


def _weight(phases: NDArray[np.float64], poles: _Poles) -> NDArray[np.float64]:
    """Return what a table's values are times, so that they do not grow."""
    low, high = poles
    weight: NDArray[np.float64] = np.abs(np.sin(phases / 2)) ** low * np.abs(np.cos(phases / 2)) ** high
    return weight


def _growing(poles: _Poles) -> dict[str, Any]:
    return {"poles": poles} if any(poles) else {}


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


def _columns(panel: ChartPanel) -> list[NDArray[np.float64]]:
    """Return the tables of a chart's curves: as they are drawn, or of an input that swings solved anew."""
    course, (x, values), scene = panel.course, panel.curves, panel.figure.scene
    if scene.info.full_turn:
        even = np.linspace(0.0, course.span, min(len(panel.figure.cycle.phase), _MOST) + 1)
        return [np.interp(even, x, np.where(np.isfinite(column), column, np.nan)) for column in values.T]
    begin, end = course.phase_of([0.0, course.span]).tolist()
    phases = _phases(scene, begin, end)
    found = np.asarray(panel.quantity.shown(scene.solve(phase=phases, speed=panel.speed)), float)
    columns = found.T if found.ndim == 2 else found[None]
    if panel.series.unit == "°":  # in the turn in which they are drawn
        columns = columns + 360.0 * np.rint((values[0] - columns[:, 0]) / 360.0)[:, None]
    return [*(columns * _weight(phases, _poles(scene, panel.quantity)))]


def _chart(light: ChartPanel, dark: ChartPanel, pairs: Pairs) -> dict[str, Any]:
    course, of, scene = light.course, light.quantity, light.figure.scene
    poles, columns = _poles(scene, of), _columns(light)
    kind = _kind(columns)
    curves = [
        {
            "label": light.series.labels[n],
            "colour": pairs.variable(light.colour(n), dark.colour(n)),
            "values": packed(column, kind),
            **_said(kind),
            **_growing(poles),
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
