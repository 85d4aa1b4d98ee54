"""Charts: curves in their frame, gaps where a value is not bounded, points on logarithmic axes."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest

from linkanim.paper.chart import Page
from linkanim.paper.curves import Pace, curves_of, extremes
from linkanim.picture.chart import Pen, Plot, asymptotes, axes, curve_layer, dot, paths, right_axis
from linkanim.picture.items import Caption
from linkanim.picture.quantities import linear, range_around, unbounded_places
from linkanim.picture.raster import Layer
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.scenes import load, names


def _pen(line: float = 1.8) -> Pen:
    return Pen(Type(), LIGHT, 12, 16, line)


def test_a_curve_is_broken_where_its_value_is_not_bounded() -> None:
    plot = Plot(Rect(0, 0, 100, 50), linear(0, 10), linear(-1, 1))
    y = np.array([0.0, 0.5, math.inf, 0.5, 0.0, math.nan, 0.2])
    layer = curve_layer(plot, np.arange(7.0), y, (0, 0, 0), 1.0)
    assert len(layer.loops) == 3
    assert all(np.isfinite(loop).all() for loop in layer.loops)


def test_what_lies_beyond_the_axis_stays_at_its_edge() -> None:
    plot = Plot(Rect(0, 0, 100, 50), linear(0, 10), linear(-1, 1))
    assert complex(plot.pixels(5, 100)) == 50 + 0j
    assert complex(plot.pixels(5, -100)) == 50 + 50j


def test_every_tick_has_its_line_and_its_label() -> None:
    plot = Plot(Rect(40, 20, 200, 100), linear(0, 10), linear(-1, 1))
    grid, *labels = axes(plot, _pen())
    ticks = (*plot.x.ticks, *plot.y.ticks)
    assert isinstance(grid, Layer)
    assert len(grid.loops) == len(ticks)
    assert [item.text for item in labels if isinstance(item, Caption)] == [label for _, label in ticks]
    assert not any(item.strong for item in labels if isinstance(item, Caption))
    marks, *values = right_axis(plot, _pen())
    assert isinstance(marks, Layer)
    assert len(marks.loops) == len(values) == len(plot.y.ticks)


@pytest.mark.parametrize("line", [0.6, 1.8, 5.4])
def test_a_dot_fills_most_of_its_ring(line: float) -> None:
    ring, inner = dot((1, 2, 3), _pen(line)).at([140 + 70j])
    assert 0.7 < np.ptp(inner.loops[0].real) / np.ptp(ring.loops[0].real) < 0.8


def test_a_curve_ends_at_the_edges_of_its_plot() -> None:
    plot = Plot(Rect(0, 0, 100, 50), linear(0, 10), linear(-1, 1))
    up, down = paths(plot, [0.0, 5.0, 10.0], [0.0, 2.0, -2.0])
    assert up == pytest.approx(np.array([25j, 25.0]))
    assert down == pytest.approx(np.array([62.5, 87.5 + 50j]))


# An infinite value beside a finite one is where a curve goes to infinity; a run of them has no asymptote.
def test_an_asymptote_stands_where_a_curve_goes_to_infinity() -> None:
    plot = Plot(Rect(0, 0, 100, 50), linear(0, 10), linear(-1, 1))
    once = [0.0, 0.5, math.inf, -0.5, math.nan, math.inf, math.inf, math.inf, math.nan, 0.0, 0.0]
    (line,) = asymptotes(plot, np.arange(11.0), once, (0, 0, 0), _pen())
    places = np.concatenate(line.loops)
    assert places.real == pytest.approx(20, abs=1)
    assert places.imag.min() == pytest.approx(0, abs=1)
    assert places.imag.max() == pytest.approx(50, abs=12)


# scene and what of it goes to infinity: both ways, one way, at the ends of the axis, along a whole curve
UNBOUNDED = [
    ("crank-rocker", "coupler.pole.x", 2),
    ("crank-rocker", "P.curvature_radius", 2),
    ("double-rocker", "coupler.second_coefficient", 3),
    ("wiper", "link.pole.x", 0),
]


@pytest.mark.parametrize(("scene", "token", "count"), UNBOUNDED)
def test_a_chart_is_broken_at_infinities_and_its_range_leaves_them_out(
    scene: str, token: str, count: int
) -> None:
    curves = curves_of(load(scene), (token,), (Pace(1.0, ""),))
    (curve,) = curves.curves
    assert len(unbounded_places(curve.x, curve.values)) == count
    page = Page(curves, size=(960, 540))
    captions = [item.text for item in page.items() if isinstance(item, Caption)]
    assert not any("inf" in text.split() or "nan" in text for text in captions)
    assert ("at infinity throughout" in captions) == (not count)
    low, high = range_around(curve.values)
    finite = curve.values[np.isfinite(curve.values)]
    if count:
        assert high - low < 6 * np.ptp(np.quantile(finite, (0.1, 0.9)))
        assert low < np.median(finite) < high


# Few ticks at round numbers are not fewer than four: spans in which the steps of 1, 2 and 5 fall badly.
@pytest.mark.parametrize("unit", ["", "°"])
@pytest.mark.parametrize("most", [2, 3, 4, 6])
@pytest.mark.parametrize("span", [(-1490, 1510), (0, 360), (0.9, 3.05), (1, 1.0001), (-35, 33), (0, 720)])
def test_an_axis_has_four_ticks_at_least(span: tuple[float, float], most: int, unit: str) -> None:
    ticks = linear(*span, most=most, unit=unit, least=4).ticks
    assert 4 <= len(ticks) <= 9
    assert len({label for _, label in ticks}) == len(ticks)


def chart_faults(name: str) -> Iterator[str]:
    """Yield what is wrong with charts of a scene's quantities: strokes through infinities, words there."""
    scene = load(name)
    pace = (Pace(scene.linkage.drive.speed, ""),)
    for curve in curves_of(scene, tuple(scene.quantities), pace).curves:
        token = f"{curve.quantity.token} {curve.label}"
        peaks, finite = extremes(scene, curve), np.isfinite(curve.values)
        if not all(math.isfinite(part) for peak in peaks for part in peak):
            yield f"{token}: {peaks}"
        if peaks and not finite.all() and np.isinf(curve.values).any():
            yield f"{token} has words, and goes to infinity"
        if not finite.any():
            continue
        low, high = range_around(curve.values)
        plot = Plot(Rect(0, 0, 1000, 500), linear(curve.x.min(), curve.x.max()), linear(low, high))
        drawn = list(paths(plot, curve.x, curve.values))
        if not drawn:
            yield f"{token} lies outside of its chart"
        for place in plot.x.share(unbounded_places(curve.x, curve.values)) * 1000:
            through = [path for path in drawn if path.real.min() < place - 1e-6 < path.real.max() - 2e-6]
            if through:
                yield f"{token} is drawn through its infinity at {place:.1f} px"
        for path in drawn:
            steps = np.abs(np.diff(path.imag))
            if steps.size and steps.max() > 450 and np.ptp(curve.values[finite]) > high - low:
                yield f"{token} has a stroke from edge to edge"


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_no_chart_has_a_stroke_or_words_at_an_infinity(name: str) -> None:
    assert list(chart_faults(name)) == []
