"""Charts: curves in their frame, gaps where a value is not bounded, points on logarithmic axes."""

from __future__ import annotations

import math

import numpy as np
import pygame
import pytest

from linkanim.picture.axis import decades, linear
from linkanim.picture.chart import Pen, Plot, axes, curve_layer, point_layers, right_axis
from linkanim.picture.items import Caption
from linkanim.picture.raster import Layer
from linkanim.picture.scatter import Dot, ScatterTitles, scatter
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
    plot = Plot(Rect(40, 20, 200, 100), linear(0, 10), linear(-1, 1))
    ring, dot = point_layers(plot, [(5.0, 0.0)], (1, 2, 3), _pen(line))
    assert 0.7 < np.ptp(dot.loops[0].real) / np.ptp(ring.loops[0].real) < 0.8


def test_a_log_log_picture_has_its_points_at_their_decades() -> None:
    points = [Dot("one", 10.0, 1e-8), Dot("two", 1000.0, 1e-16, ours=True)]
    names = ScatterTitles("title", "across", "up")
    picture = scatter(points, names, size=(640, 360))
    assert picture.get_size() == (640, 360)
    ours = np.all(pygame.surfarray.array3d(picture) == LIGHT.acceleration, axis=-1)
    theirs = np.all(pygame.surfarray.array3d(picture) == LIGHT.velocity, axis=-1)
    x, y = (axis.mean() for axis in np.nonzero(ours))
    u, v = (axis.mean() for axis in np.nonzero(theirs))
    assert u < x
    assert v < y
    assert decades(10.0, 1000.0).share(100.0) == pytest.approx(0.5)


def _changed(one: pygame.Surface, other: pygame.Surface) -> pygame.Rect:
    apart = pygame.surfarray.array3d(one) != pygame.surfarray.array3d(other)
    columns, rows = np.nonzero(apart.any(axis=-1))
    assert rows.size
    (left, right), (top, foot) = ((int(way.min()), int(way.max()) + 1) for way in (columns, rows))
    return pygame.Rect(left, top, right - left, foot - top)


def test_every_point_has_its_label_and_none_lies_on_another() -> None:
    names = ScatterTitles("title", "across", "up")
    points = [Dot("first one", 10.0, 1e-8), Dot("second", 12.0, 1.2e-8), Dot("third", 1e3, 1e-16, ours=True)]
    whole = scatter(points, names, size=(640, 360))
    found = []
    for n, point in enumerate(points):
        blank = [*points[:n], point._replace(label=" " * len(point.label)), *points[n + 1 :]]
        found.append(_changed(whole, scatter(blank, names, size=(640, 360))))
    assert whole.get_rect().contains(found[0].unionall(found[1:]))
    assert not found[0].colliderect(found[1])


@pytest.mark.parametrize("points", [[], [Dot("zero", 0.0, 1.0)], [Dot("inf", 1.0, math.inf)]])
def test_a_log_log_picture_of_what_has_no_logarithm_is_refused(points: list[Dot]) -> None:
    with pytest.raises(ValueError, match="positive and finite"):
        scatter(points, ScatterTitles("t", "x", "y"))
