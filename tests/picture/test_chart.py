"""The chart: one true period, a cursor that moves, gaps where a value is not bounded."""

from __future__ import annotations

import math

import numpy as np
import pygame
import pytest

from linkanim.picture.axis import decades, linear
from linkanim.picture.chart import Pen, Plot, Strip, curve_layer, pen_for, strip
from linkanim.picture.figure import figure
from linkanim.picture.layout import Layout, layout
from linkanim.picture.look import Look
from linkanim.picture.offscreen import offscreen
from linkanim.picture.scatter import Names, Point, scatter
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.scenes import load

WINDOW: Layout = layout((640, 360), Look(chart="x"))


def _pen() -> Pen:
    return pen_for(WINDOW, Type(), LIGHT)


def _strip(scene: str, name: str) -> Strip:
    return strip(figure(load(scene)), name, WINDOW, _pen())


def test_the_cursor_goes_from_end_to_end_in_one_true_period() -> None:
    chart = _strip("kite", "rocker.angular_velocity")
    area = chart.plot.area
    shares = []
    for phase in (0.0, math.tau, 2 * math.tau - 1e-9, 2 * math.tau + 0.5 * math.tau):
        line = chart.cursor(phase)[0].loops[0]
        shares.append((line.real.mean() - area.x) / area.width)
    assert shares == pytest.approx([0, 0.5, 1, 0.25], abs=1e-6)


def test_the_dot_lies_on_the_curve_at_the_pose_s_value() -> None:
    chart = _strip("press", "B.velocity")
    scene = load("press")
    for phase in (0.3, 2.0, 6.2):
        value = math.hypot(*scene.pose(phase).velocity["B"])
        assert chart.values_at(phase) == pytest.approx([value], rel=1e-4)
        dot = chart.cursor(phase)[-1].loops[0].mean()
        assert dot == pytest.approx(complex(chart.plot.place(math.degrees(phase), value)), abs=0.3)


def test_an_angle_that_grows_by_a_turn_runs_on_over_the_end_of_the_period() -> None:
    chart = _strip("drag-link", "rocker.angle")
    end, start = chart.values_at(math.tau - 1e-6)[0], chart.values_at(0.0)[0]
    assert abs(end - start) == pytest.approx(360, abs=0.01)


def test_the_reading_tells_value_and_unit() -> None:
    assert _strip("crank-rocker", "crank.angular_velocity").reading(1.0) == "2.094 rad/s"
    assert _strip("crank-rocker", "P.position").reading(1.0).startswith("x ")
    assert _strip("crank-rocker", "crank.angle").reading(0.5 * math.pi).endswith("0.0°")


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


@pytest.mark.parametrize(("px", "share"), [(None, 0.5), (-8.0, 0.0), (8.0, 1.0)])
def test_a_pixel_of_the_chart_is_a_phase_also_just_beside_its_ends(px: float | None, share: float) -> None:
    chart = _strip("crank-rocker", "rocker.angle")
    area = chart.plot.area
    x = area.x + area.width / 2 if px is None else (area.x + px if px < 0 else area.right + px)
    assert chart.phase_at(x, area.y + 5) == pytest.approx(share * math.tau)


def test_a_log_log_picture_has_its_points_at_their_decades() -> None:
    points = [Point("one", 10.0, 1e-8), Point("two", 1000.0, 1e-16, ours=True)]
    names = Names("title", "across", "up")
    picture = scatter(points, names, size=(640, 360))
    assert picture.get_size() == (640, 360)
    ours = np.all(pygame.surfarray.array3d(picture) == LIGHT.acceleration, axis=-1)
    theirs = np.all(pygame.surfarray.array3d(picture) == LIGHT.velocity, axis=-1)
    x, y = (axis.mean() for axis in np.nonzero(ours))
    u, v = (axis.mean() for axis in np.nonzero(theirs))
    assert u < x
    assert v < y
    assert decades(10.0, 1000.0).share(100.0) == pytest.approx(0.5)


@pytest.mark.parametrize("points", [[], [Point("zero", 0.0, 1.0)], [Point("inf", 1.0, math.inf)]])
def test_a_log_log_picture_of_what_has_no_logarithm_is_refused(points: list[Point]) -> None:
    with pytest.raises(ValueError, match="positive and finite"):
        scatter(points, Names("t", "x", "y"))


def test_a_constant_quantity_is_a_level_line_not_noise() -> None:
    chart = _strip("parallelogram", "coupler.angular_velocity")
    surface = offscreen((640, 360))
    chart.draw(surface)
    values = chart.plot.place(np.zeros(720), chart.series.values[:, 0]).imag
    assert np.ptp(values) < 0.01
