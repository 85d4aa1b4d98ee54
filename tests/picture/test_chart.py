"""Charts: curves in their frame, gaps where a value is not bounded, points on logarithmic axes."""

from __future__ import annotations

import math

import numpy as np
import pytest

from linkanim.picture.chart import Pen, Plot, axes, curve_layer, dot, right_axis
from linkanim.picture.items import Caption
from linkanim.picture.quantities import linear
from linkanim.picture.raster import Layer
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect


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
    assert complex(plot.place(5, 100)) == 50 + 0j
    assert complex(plot.place(5, -100)) == 50 + 50j


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
