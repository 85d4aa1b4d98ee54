"""The chart of a scene: the same motion as the picture, over the angle or the time that it says."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pygame
import pytest
from fidelity import Pixels
from pictures import pixels, window

from linkanim.errors import BadInput
from linkanim.mechanics.motion import Pose
from linkanim.mechanics.quantities import input_symbol
from linkanim.picture.chart import ChartPanel, chart_panel, chart_strips, pen_for, room_for_ticks
from linkanim.picture.figure import figure
from linkanim.picture.items import Caption
from linkanim.picture.layout import Layout
from linkanim.picture.look import Look, Over
from linkanim.picture.picture import Picture
from linkanim.picture.quantities import chart_tokens
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene

WINDOW: Layout = window((640, 360), 1)
WINDOWS = [
    *((size, False) for size in [(320, 180), (640, 360), (360, 640)]),
    *((size, True) for size in [(640, 360), (1280, 720)]),
]


def _strip(scene: str, token: str, speed: float | None = None) -> ChartPanel:
    drawn = chart_panel(figure(load(scene)), token, WINDOW, pen_for(WINDOW, Type(), LIGHT))
    return drawn if speed is None else drawn.at(speed)


def _pose(chart: ChartPanel, phase: float) -> Pose:
    return chart.figure.scene.pose(phase, speed=chart.speed)


def _share(chart: ChartPanel, phase: float) -> float:
    """Return how far along the chart the cursor stands."""
    line = chart.cursor(_pose(chart, phase))[0].loops[0]
    return float((line.real.mean() - chart.plot.area.x) / chart.plot.area.width)


# scene, phase, the crank angle there, how many degrees the axis has: the kite needs two turns
TURNING = [
    ("slider-crank", 0.0, 60.0, 360.0),
    ("slider-crank", 1.0, 60.0 + math.degrees(1.0), 360.0),
    ("antiparallelogram", math.pi, 240.0, 360.0),
    ("crank-rocker", -math.pi / 2, 270.0, 360.0),
    ("kite", 0.0, 60.0, 720.0),
    ("kite", math.tau, 420.0, 720.0),
    ("kite", 1.9 * math.tau, 60.0 + 1.9 * 360.0 - 720.0, 720.0),
]


@pytest.mark.parametrize(("name", "phase", "angle", "span"), TURNING)
def test_an_input_that_turns_is_charted_over_its_own_angle(
    name: str, phase: float, angle: float, span: float
) -> None:
    chart = _strip(name, "P.velocity")
    assert chart.course.title == "crank angle θ₂ (°)"
    assert chart.course.span == pytest.approx(span)
    assert _share(chart, phase) == pytest.approx(angle / span, abs=1e-6)
    shown = math.degrees(_pose(chart, phase).coordinate) % 360
    assert _share(chart, phase) * span % 360 == pytest.approx(shown, abs=1e-3)


# speed, share of the period after a tenth of a turn of phase
SWINGING = [(1.0, 0.1), (2.5, 0.1), (-1.0, 0.9), (-0.3, 0.9)]


@pytest.mark.parametrize(("speed", "share"), SWINGING)
def test_an_input_that_swings_is_charted_over_time(speed: float, share: float) -> None:
    chart = _strip("double-rocker", "rocker.angular_velocity", speed)
    assert chart.course.title == "time (s)"
    assert chart.course.span == pytest.approx(math.tau / abs(speed))
    assert _share(chart, 0.1 * math.tau) == pytest.approx(share, abs=1e-6)


@pytest.mark.parametrize(
    ("name", "symbol"), [("crank-rocker", "θ₂"), ("press", "θ₂"), ("rocker-driven", "θ₄"), ("six-bar", "θ₂")]
)
def test_the_driven_bar_has_its_symbol(name: str, symbol: str) -> None:
    assert input_symbol(load(name).linkage) == symbol


# scene, the axis that was chosen, speed: how far along the cursor stands at phase 1, and the axis' title
AXES: list[tuple[str, Over | None, float, float, str]] = [
    ("crank-rocker", "time", 2.0, 1.0 / math.tau, "time (s)"),
    ("crank-rocker", "time", -2.0, 1.0 - 1.0 / math.tau, "time (s)"),
    ("slider-crank", "phase", 2.0, 1.0 / math.tau, "phase φ (°)"),
    ("slider-crank", "angle", 2.0, (math.pi / 3 + 1.0) / math.tau, "crank angle θ₂ (°)"),
    ("double-rocker", "phase", 2.0, 1.0 / math.tau, "phase φ (°)"),
    ("double-rocker", "angle", 2.0, 1.0 / math.tau, "time (s)"),
]


@pytest.mark.parametrize(("name", "over", "speed", "share", "title"), AXES)
def test_the_axis_is_the_one_that_was_chosen(
    name: str, over: Over | None, speed: float, share: float, title: str
) -> None:
    pen = pen_for(WINDOW, Type(), LIGHT)
    token = "rocker.angle" if name != "slider-crank" else "slider.travel"
    chart = chart_panel(figure(load(name)), token, WINDOW, pen, over).at(speed)
    assert chart.course.title == title
    assert _share(chart, 1.0) == pytest.approx(share, abs=2e-3)
    foot = chart.foot(_pose(chart, 1.0))
    assert chart.phase_at(foot.real) == pytest.approx(1.0, abs=1e-9)


def test_the_limits_of_a_swing_are_marked_with_their_angles() -> None:
    chart = _strip("double-rocker", "rocker.angle", -2.0)
    marks = [(0.0, "13.8°"), (math.pi / 2, "108.4°"), (math.pi, "13.8°")]
    assert [label for _, label in chart.course.marks] == [label for _, label in marks]
    assert [place for place, _ in chart.course.marks] == pytest.approx([place for place, _ in marks])
    for place, label in marks:
        pose = _pose(chart, float(chart.course.phase_of(place)))
        assert f"{math.degrees(pose.coordinate):.1f}°" == label
    assert _strip("crank-rocker", "rocker.angle").course.marks == ()


def _worded(chart: ChartPanel) -> Iterator[Rect]:
    """Yield where the words of a chart stand."""
    for item in chart.still():
        if isinstance(item, Caption) and item.text:
            wide = chart.pen.type.width(item.text, item.size)
            left = item.at[0] - wide * {"left": 0.0, "centre": 0.5, "right": 1.0}[item.anchor]
            yield Rect(left, item.at[1], wide, item.size)


# one that turns once and one that turns twice, one that swings, with the names of its limits
@pytest.mark.parametrize("name", ["crank-rocker", "kite", "double-rocker"])
@pytest.mark.parametrize(("size", "beside"), WINDOWS)
def test_no_words_of_a_chart_lie_on_others(size: tuple[int, int], beside: bool, name: str) -> None:
    parts = window(size, 1, beside=beside)
    for token in ("rocker.angle", "rocker.angular_velocity"):
        chart = chart_panel(figure(load(name)), token, parts, pen_for(parts, Type(), LIGHT))
        rects = list(_worded(chart))
        assert len(rects) >= 5
        assert not [pair for pair in combinations(rects, 2) if pair[0].meets(pair[1])]
        assert not [rect for rect in rects if rect.x < 0 or rect.right > size[0]]


def _input_told(scene: Scene, value: float) -> str:
    """A driven slider's travel, or else an angle."""
    if not scene.linkage.drive.coordinate.is_angle:
        return f"{value + 0.0:.1f} {scene.length_unit}"
    return f"{math.degrees(value) + 0.0:.1f}°"


@pytest.mark.parametrize("name", [name for name in names() if not load(name).info.full_turn])
def test_every_limit_is_marked_where_the_input_turns_back(name: str) -> None:
    chart, scene = _strip(name, f"{load(name).linkage.drive.joint}.velocity", -1.0), load(name)
    ends = [_input_told(scene, end) for end in scene.info.input_range]
    for place, label in chart.course.marks:
        pose = _pose(chart, float(chart.course.phase_of(place)))
        assert label.replace("−", "-") == _input_told(scene, pose.coordinate)
        assert label.replace("−", "-") in ends
        assert abs(pose.coordinate_rate) < 1e-9


@pytest.mark.parametrize("speed", [0.5, -0.5, 4.0, -9.0])
@pytest.mark.parametrize(
    ("name", "token"),
    [
        ("press", "cushion.force"),
        ("press", "5.travel_velocity"),
        ("double-rocker", "P.acceleration.x"),
        ("kite", "rocker.angle"),
        ("slider-crank", "rod.angular_acceleration"),
    ],
)
def test_the_curve_is_that_of_the_running_motion(name: str, token: str, speed: float) -> None:
    chart = _strip(name, token, speed)
    x, values = chart.curves
    for phase in np.linspace(-4.0, 9.0, 23):
        pose = _pose(chart, float(phase))
        on_curve = np.interp(chart.course.x_of(phase), x, values[:, 0])
        assert chart.values_at(pose)[0] == pytest.approx(on_curve, abs=2e-3 * np.ptp(values))
        exact = chart.quantity.displayed(pose)
        away = chart.values_at(pose)[0] - exact
        assert away == 0.0 or (token.endswith("angle") and away % 360 == pytest.approx(0.0))


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_at_twice_the_speed_accelerations_are_four_times_as_great(name: str) -> None:
    chart = _strip(name, f"{load(name).linkage.drive.joint}.acceleration")
    before, after = chart.curves[1], chart.at(-2 * chart.speed).curves[1]
    assert np.nanmax(after) == pytest.approx(4 * np.nanmax(before), rel=1e-9)


@pytest.mark.parametrize("speed", [1.5, -1.5])
@pytest.mark.parametrize("token", ["rocker.angle", "P.velocity.x"])
def test_the_ends_of_a_curve_are_the_values_there_wherever_the_drive_starts(token: str, speed: float) -> None:
    scene = load("crank-rocker")
    drive = replace(scene.linkage.drive, start=0.1234, speed=speed)
    scene = replace(scene, linkage=replace(scene.linkage, drive=drive))
    chart = chart_panel(figure(scene), token, WINDOW, pen_for(WINDOW, Type(), LIGHT))
    x, values = chart.curves
    for end in (0, -1):
        exact = chart.quantity.displayed(scene.pose(float(chart.course.phase_of(x[end]))))
        assert values[end, 0] == pytest.approx(exact, abs=1e-4 * np.ptp(values))


def test_an_angle_that_grows_by_a_turn_runs_from_end_to_end() -> None:
    x, values = _strip("drag-link", "rocker.angle").curves
    assert x[0] == 0.0
    assert x[-1] == pytest.approx(360.0)
    assert values[-1, 0] - values[0, 0] == pytest.approx(360.0)
    assert np.abs(np.diff(values[:, 0])).max() < 5.0


def test_the_driven_bar_s_own_angle_is_the_axis() -> None:
    for name in ("slider-crank", "kite"):
        x, values = _strip(name, "crank.angle").curves
        assert values[:, 0] == pytest.approx(x, abs=1e-9)


def test_the_reading_tells_value_and_unit() -> None:
    chart = _strip("crank-rocker", "crank.angular_velocity")
    assert chart.reading(chart.values_at(_pose(chart, 1.0))) == ("2.094 rad/s",)
    chart = _strip("crank-rocker", "P.position")
    first, second = chart.reading(chart.values_at(_pose(chart, 1.0)))
    assert first.startswith("x ")
    assert second.startswith("y ")
    chart = _strip("crank-rocker", "crank.angle")
    assert chart.reading(chart.values_at(_pose(chart, 0.5 * math.pi))) == ("90.0°",)


@pytest.mark.parametrize(("px", "share"), [(None, 0.5), (-8.0, 0.0), (8.0, 1.0)])
@pytest.mark.parametrize(
    ("name", "speed"), [("crank-rocker", 1.0), ("slider-crank", -1.0), ("double-rocker", -2.0), ("kite", 1.0)]
)
def test_a_pixel_of_the_chart_is_a_phase_also_just_beside_its_ends(
    name: str, speed: float, px: float | None, share: float
) -> None:
    chart = _strip(name, "P.velocity", speed)
    area = chart.plot.area
    x = area.x + area.width / 2 if px is None else (area.x + px if px < 0 else area.right + px)
    (around,) = (one.place for one in chart.targets if one.kind == "chart")
    assert around.holds(x, area.y + 5)
    phase = chart.phase_at(x)
    assert 0 <= phase <= chart.course.period
    assert math.remainder(_share(chart, phase) - share, 1.0) == pytest.approx(0.0, abs=1e-6)
    assert not around.holds(x, area.y - 20)


def test_a_constant_quantity_is_a_level_line_not_noise() -> None:
    chart = _strip("parallelogram", "coupler.angular_velocity")
    values = chart.plot.pixels(np.zeros(722), chart.curves[1][:, 0]).imag
    assert np.ptp(values) < 0.01


@pytest.mark.slow
def test_the_picture_s_chart_follows_the_running_speed_and_direction() -> None:
    scene, size = load("press"), (640, 360)
    painter, surface = Picture(scene, size, Look(chart="cushion.force")), offscreen(size)
    pictures: dict[float, Pixels] = {}
    for speed in (2.0, -2.0, 4.0, 2.0):
        SurfacePrinter().paint(surface, painter, scene.pose(1.0, speed=speed))
        again = pictures.setdefault(speed, pixels(surface))
        assert (again == pixels(surface)).all()
        fresh = offscreen(size)
        SurfacePrinter().paint(
            fresh, Picture(scene, size, Look(chart="cushion.force")), scene.pose(1.0, speed=speed)
        )
        assert (pixels(fresh) == pixels(surface)).all()
    assert (pictures[2.0] != pictures[-2.0]).any()
    assert (pictures[2.0] != pictures[4.0]).any()
    SurfacePrinter().paint(surface, painter, scene.pose(1.0, speed=0.0))


@pytest.mark.parametrize("size", [(1920, 1080), (1280, 720), (480, 270), (320, 180)])
def test_axes_keep_their_first_and_last_tick_and_their_title_gives_way(
    size: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[str] = []
    draw = Type.draw

    def noting(self: Type, surface: pygame.Surface, text: str, *rest: Any, **more: Any) -> int:
        drawn.append(text)
        return draw(self, surface, text, *rest, **more)

    monkeypatch.setattr(Type, "draw", noting)
    scene = load("crank-rocker")
    painter = Picture(scene, size, Look(chart="rocker.angular_velocity"))
    SurfacePrinter().paint(offscreen(size), painter, scene.pose(1.0))
    assert {"0°", "360°"} <= set(drawn)
    assert size[1] < 720 or "crank angle θ₂ (°)" in drawn
    assert any(text.endswith("ω₄ (rad/s)") for text in drawn)


STRIPS = [((1280, 720), False, 2), ((1280, 720), False, 3), ((640, 360), True, 2), ((1920, 1080), True, 3)]


@pytest.mark.parametrize(("size", "beside", "count"), STRIPS)
def test_strips_share_their_axis_and_have_equal_plots(
    size: tuple[int, int], beside: bool, count: int
) -> None:
    parts, scene = window(size, count, beside=beside), load("press")
    pen = pen_for(parts, Type(), LIGHT)
    strips = chart_strips(figure(scene), scene.telling[:count], parts, pen)
    areas = [panel.plot.area for panel in strips.panels]
    assert len(areas) == count
    assert all(area.x == areas[0].x and area.width == areas[0].width for area in areas)
    assert all(area.height == pytest.approx(areas[0].height) for area in areas)
    assert all(upper.bottom < lower.y for upper, lower in pairwise(areas))
    assert parts.chart
    assert areas[-1].bottom < parts.chart.bottom
    titles = [panel.title.around(Type()) for panel in strips.panels]
    assert all(area.bottom < title.y for area, title in zip(areas, titles[1:], strict=False))
    pose = scene.pose(1.0, 2)
    assert len({round(panel.foot(pose).real, 9) for panel in strips.panels}) == 1
    tokens = [one.value for one in strips.targets() if one.kind == "chart-title"]
    assert tokens == [panel.quantity.token for panel in strips.panels]


def test_strips_share_their_axis_at_every_speed() -> None:
    parts, scene = window((1280, 720), 2), load("crank-rocker")
    tokens = ("coupler.angular_velocity", "P.velocity")
    strips = chart_strips(figure(scene), tokens, parts, pen_for(parts, Type(), LIGHT))
    for rpm in (1.0, 20.0, 3000.0):
        panels = strips.at(rpm * math.pi / 30).panels
        assert len({(panel.plot.area.x, panel.plot.area.width) for panel in panels}) == 1, rpm
        assert all(room_for_ticks(panel.y_axis, panel.pen) <= panel.left for panel in panels)


@pytest.mark.parametrize(("size", "shown"), [((320, 180), 1), ((480, 270), 2), ((640, 360), 3)])
def test_as_many_strips_as_can_be_read_are_shown_and_the_others_are_counted(
    size: tuple[int, int], shown: int
) -> None:
    parts, scene = window(size, 3), load("press")
    pen = pen_for(parts, Type(), LIGHT)
    panels = chart_strips(figure(scene), scene.telling[:3], parts, pen).panels
    assert [panel.quantity.token for panel in panels] == [*scene.telling[3 - shown : 3]]
    assert [panel.plot.area.height > 1.9 * pen.small for panel in panels] == [True] * shown
    counted = [f"{n} of 3" if shown < 3 else "" for n in range(4 - shown, 4)]
    assert [panel.title.text.rpartition(", ")[2] if shown < 3 else "" for panel in panels] == counted


def test_more_strips_than_have_room_are_refused() -> None:
    scene = load("press")
    with pytest.raises(BadInput, match="4 quantities in charts: there is room for 3"):
        chart_strips(figure(scene), scene.telling[:4], WINDOW, pen_for(WINDOW, Type(), LIGHT))


NAMED = {
    "none": (None, ()),
    "one": ("P.velocity", ("P.velocity",)),
    "two": ("P.velocity,rocker.angle", ("P.velocity", "rocker.angle")),
    "two with a blank": ("P.velocity, transmission_angle", ("P.velocity", "transmission_angle")),
    "unknown": ("P.velocity,nothing", ("P.velocity", "nothing")),
}


@pytest.mark.parametrize("case", NAMED)
def test_quantities_of_several_charts_have_commas_between(case: str) -> None:
    charted, tokens = NAMED[case]
    assert chart_tokens(load("crank-rocker"), charted) == tokens
