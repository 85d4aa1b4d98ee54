"""The polygons beside the linkage: to scale, in their place at every pose, named, and what rests."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from pictures import painted, pixels, window

from linkanim.mechanics.polygons import Order, chains, image
from linkanim.picture.chart import pen_for
from linkanim.picture.figure import figure
from linkanim.picture.items import Group
from linkanim.picture.layout import Docked, Layout
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.polygons import Polygon, polygons_of
from linkanim.picture.text import Type, subscripted
from linkanim.picture.theme import LIGHT
from linkanim.scenes import load, names

WINDOW: Layout = window((1280, 720), polygons=1)
BAR = Docked(bar=True)
FEW = ("crank-rocker", "press", "inverted-slider-crank", "scotch-yoke", "jansen")


def panels(name: str, parts: Layout = WINDOW) -> tuple[Polygon, ...]:
    assert parts.polygons is not None
    return polygons_of(figure(load(name)), parts.polygons, pen_for(parts, Type(), LIGHT))


def drawn(panel: Polygon, phase: float, speed: float | None = None) -> Group:
    return panel.group(panel.figure.scene.pose(phase, speed=speed))


def words(group: Group) -> list[str]:
    return [caption.text for caption in group.captions]


@pytest.mark.thinned(3)
@pytest.mark.parametrize("size", [(720, 1280), (480, 270)])
@pytest.mark.parametrize("name", FEW)
def test_all_of_it_stays_in_its_place_whichever_way_it_runs(name: str, size: tuple[int, int]) -> None:
    for panel in panels(name, window(size, polygons=1)):
        for phase in np.linspace(0.05, 6.2, 9):
            for speed in (None, -0.3):
                loops = [loop for layer in drawn(panel, phase, speed).layers for loop in layer.loops]
                points = np.concatenate(loops)
                assert panel.rect.x - 8 <= points.real.min() <= points.real.max() <= panel.rect.right + 8
                assert panel.rect.y <= points.imag.min() <= points.imag.max() <= panel.rect.bottom + 8


# what goes along a slot is told from what turns about a pin
@pytest.mark.parametrize(("name", "guided"), [("inverted-slider-crank", True), ("crank-rocker", False)])
def test_velocities_and_accelerations_have_the_colours_of_those_in_the_picture(
    name: str, guided: bool
) -> None:
    absolute = (LIGHT.velocity, LIGHT.acceleration)
    for panel, own in zip(panels(name), absolute, strict=True):
        colours = {layer.colour for layer in drawn(panel, 1.0).layers}
        assert colours & {*absolute} == {own}
        assert LIGHT.dim in colours
        assert (LIGHT.traces[0] in colours) is guided


@pytest.mark.parametrize("name", ["galloway", "crank-rocker", "scotch-yoke"])
@pytest.mark.parametrize("width", [0.0, -3.0, 1e-13, 2.0])
def test_in_a_place_that_is_no_wider_than_nothing_it_has_no_bar(name: str, width: float) -> None:
    for panel in panels(name):
        narrow = replace(panel, rect=panel.rect._replace(width=width))
        for one in (narrow, narrow.standing(1.17)):
            group = drawn(one, 1.17)
            assert any("/s" in text for text in words(group)) == (width >= 1)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("speed", [2.0, -5.0])
def test_it_is_to_the_scale_that_is_written_beside_it(order: Order, speed: float) -> None:
    panel = panels("crank-rocker")[order - 1]
    pose = panel.figure.scene.pose(1.0, speed=speed)
    group = panel.group(pose)
    bar = group.layers[-1].loops[0]
    (said,) = (re.fullmatch(r"([\d.]+) mm/s²?", text) for text in words(group) if "mm/s" in text)
    assert said is not None
    assert re.fullmatch(r"0*[125]0*", said[1].replace(".", ""))
    scale = (bar.real.max() - bar.real.min()) / float(said[1])
    assert panel.scale(speed) == pytest.approx(scale, rel=1e-9)
    tips = np.concatenate([loop for layer in group.layers[:-2] for loop in layer.loops])
    tip = panel.pole(speed) + scale * image(pose, "B", order).conjugate()
    assert np.abs(tips - tip).min() < 0.1


def test_vectors_are_named_and_one_that_is_all_of_another_is_drawn_once() -> None:
    velocity, acceleration = (
        {text.partition(" = ")[0] for text in words(drawn(panel.standing(0.5), 0.5))}
        for panel in panels("crank-rocker")
    )
    assert {"v_{A}", "v_{B}", "v_{BA}"} <= velocity
    found = acceleration
    # at constant speed the crank has no tangential part: its normal one is all of it
    assert "a_{A}" in found
    assert "aⁿ_{A}" not in found
    assert {"a_{B}", "aᵗ_{BA}"} <= found


@pytest.mark.parametrize("phase", [0.4, 1.5, 3.1, 5.0])
@pytest.mark.parametrize("name", ["crank-rocker", "press"])
def test_a_symbol_stands_beside_the_vector_that_it_names(name: str, phase: float) -> None:
    for panel in panels(name):
        pose = panel.figure.scene.pose(phase)
        pole, scale = panel.pole(pose.input_speed), panel.scale(pose.input_speed)
        sides = {
            side.symbol: (pole + scale * side.begin.conjugate(), pole + scale * side.end.conjugate())
            for chain in chains(pose, panel.figure.linkage, panel.order)
            for side in chain.sides
        }
        group = panel.group(pose)
        for caption in group.captions:
            if caption.text in sides:
                begin, end = sides[caption.text]
                middle = complex(caption.at[0], caption.at[1] + 0.5 * caption.size)
                along = ((middle - begin) / (end - begin)).real
                away = abs(((middle - begin) / (end - begin)).imag) * abs(end - begin)
                assert 0.3 < along < 0.7
                across = 1j * (end - begin) / abs(end - begin)
                wide = Type().width(caption.text, caption.size)
                assert away > 0.5 * (abs(across.real) * wide + abs(across.imag) * caption.size)
                if away >= 0.5 * wide + 1.2 * caption.size:  # a thin line leads from there to the vector
                    assert away < 0.5 * wide + 5.2 * caption.size
                    foots = [loop.mean() for layer in group.layers for loop in layer.loops if len(loop) == 4]
                    assert min(abs(foot - middle) for foot in foots) < 0.5 * away + wide


@pytest.mark.thinned(5)
@pytest.mark.parametrize("name", ["whitworth", "crank-shaper", "six-bar", "press", "crank-rocker"])
@pytest.mark.parametrize("phase", [0.4, 1.5, 3.1, 5.0])
def test_in_a_figure_every_vector_is_named_once_and_the_pole_too(name: str, phase: float) -> None:
    assert WINDOW.polygons is not None
    shown, pen = figure(load(name)), pen_for(WINDOW, Type(), LIGHT)
    for panel in polygons_of(shown, WINDOW.polygons, pen, phase):
        pose = shown.scene.pose(phase)
        said = [text.partition(" = ")[0] for text in words(panel.group(pose))]
        pole, scale = panel.pole(pose.input_speed), panel.scale(pose.input_speed)
        drawn_ = [arrow.side.symbol for arrow in panel._arrows(pose, pole, scale)]
        assert {symbol: said.count(symbol) for symbol in drawn_} == dict.fromkeys(drawn_, 1)
        assert said.count("o_{v}" if panel.order == 1 else "o_{a}") == 1


@pytest.mark.parametrize("name", FEW)
def test_in_a_figure_of_one_pose_they_fill_their_place(name: str) -> None:
    assert WINDOW.polygons is not None
    shown, pen = figure(load(name)), pen_for(WINDOW, Type(), LIGHT)
    for panel in polygons_of(shown, WINDOW.polygons, pen, 1.0):
        pose = shown.scene.pose(1.0)
        reach = [loop for layer in panel.group(pose).layers[:-2] for loop in layer.loops]
        points, room = np.concatenate(reach), panel._room
        filled = max(np.ptp(points.real) / room.width, np.ptp(points.imag) / room.height)
        assert 0.95 < filled < 1.1


@pytest.mark.parametrize(("name", "phase"), [("wiper", 3.0), ("evans", 0.0), ("pumpjack", 3.0)])
def test_what_is_listed_in_a_figure_lies_on_no_vector(name: str, phase: float) -> None:
    assert WINDOW.polygons is not None
    shown, pen = figure(load(name)), pen_for(WINDOW, Type(), LIGHT)
    listed = 0
    for panel in polygons_of(shown, WINDOW.polygons, pen, phase):
        group = panel.group(shown.scene.pose(phase))
        rows = [caption for caption in group.captions if " = " in caption.text]
        boxes = [row.around(Type()) for row in rows]
        places = np.concatenate([loop for layer in group.layers for loop in layer.loops])
        for box in boxes:
            within = (abs(places.real - box.x - box.width / 2) < box.width / 2) & (
                abs(places.imag - box.y - box.height / 2) < box.height / 2
            )
            assert not within.any()
        others = [one for one in group.captions if one not in rows]
        assert not any(box.meets(other.around(Type())) for box in boxes for other in others)
        listed += len(rows)
    assert listed


@pytest.mark.parametrize("size", [(480, 270), (640, 360), (800, 450)], ids=str)
@pytest.mark.parametrize("name", ["press", "jansen", "six-bar"])
def test_in_a_small_place_only_what_has_room_is_listed(name: str, size: tuple[int, int]) -> None:
    parts, scene = window(size, 1, 1, docked=BAR), load(name)
    for phase in (0.4, 2.1, 4.0):
        pose = scene.pose(phase)
        for panel in panels(name, parts):
            captions = panel.standing(phase).group(pose).captions
            rows = [one for one in captions if " = " in one.text or one.text.endswith("smaller")]
            boxes = [one.around(Type()) for one in rows]
            others = [one.around(Type()) for one in captions if one not in rows]
            assert not any(box.meets(other) for box in boxes for other in others)
            assert [one.text for one in rows[:1] if one.text.startswith("and")] == []


def test_a_pose_with_an_acceleration_fills_its_place_too() -> None:
    assert WINDOW.polygons is not None
    shown, pen = figure(load("crank-rocker")), pen_for(WINDOW, Type(), LIGHT)
    _, panel = polygons_of(shown, WINDOW.polygons, pen, 1.0)
    pose = shown.scene.pose(1.0, acceleration=300.0)
    points = np.concatenate([loop for layer in panel.group(pose).layers for loop in layer.loops])
    assert panel.rect.y < points.imag.min() < points.imag.max() < panel.rect.bottom
    assert panel.rect.x < points.real.min() < points.real.max() < panel.rect.right + 1


@pytest.mark.parametrize("size", [(1280, 720), (320, 180), (180, 320)])
def test_titles_have_room(size: tuple[int, int]) -> None:
    for panel in panels("press", window(size, polygons=1)):
        title = drawn(panel, 1.0).captions[0]
        assert title.text.startswith(("velocit", "acceleration"))
        assert Type().width(title.text, title.size) <= panel.rect.width


def test_a_title_without_room_is_the_smallest() -> None:
    for panel in panels("press"):
        narrower = [
            replace(panel, rect=panel.rect._replace(width=width)) for width in (600.0, 130.0, 90.0, 9.0)
        ]
        titles = [drawn(one, 1.0).captions[0] for one in narrower]
        wide = [Type().width(title.text, title.size) for title in titles]
        assert wide == sorted(wide, reverse=True)
        assert wide[-1] < 0.6 * wide[0]
        assert titles[-1].size < titles[0].size


def test_what_rests_says_so() -> None:
    for panel in panels("press"):
        group = drawn(panel, 1.0, 0.0)
        assert "all at rest" in words(group)
        assert not any("mm/s" in text for text in words(group))


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_scene_has_both_at_any_pose(name: str) -> None:
    for panel in panels(name):
        for phase in (0.0, 0.7, 3.0, np.pi):
            group = drawn(panel, phase)
            assert np.isfinite(np.concatenate([loop for layer in group.layers for loop in layer.loops])).all()


def test_the_window_shows_them_beside_the_scene() -> None:
    scene = load("crank-rocker")
    with_them = pixels(painted(scene, 1.0, Look(hud=False, polygons=True), (640, 360)))
    assert (with_them[:, 420:] != LIGHT.background).any()
    assert not (pixels(painted(scene, 1.0, Look(hud=False), (640, 360))) == with_them).all()


def test_one_polygon_alone_is_larger_and_one_that_stands_fills_its_place_and_says_so() -> None:
    scene = load("press")
    shown, pose = figure(scene), scene.pose(math.radians(178.0))

    def reach(polygon: Polygon) -> float:
        ends = np.concatenate([loop for layer in polygon.group(pose).layers for loop in layer.loops])
        return float(np.ptp(ends.real) + np.ptp(ends.imag))

    for n, order in enumerate((1, 2)):
        both, wide = (window((1280, 720), 0, count, docked=BAR) for count in (1, 2))
        assert both.polygons
        assert wide.polygons
        pens = [pen_for(one, Type(), LIGHT) for one in (both, wide)]
        usual = polygons_of(shown, both.polygons, pens[0])[n]
        (large,) = polygons_of(shown, wide.polygons, pens[1], only=order)
        assert large.order == usual.order == order
        assert large.scale(pose.input_speed) > 1.2 * usual.scale(pose.input_speed)
        stands = large.standing(pose.phase)
        assert reach(stands) > reach(large)
        words = [caption.text for caption in stands.group(pose).captions]
        assert sum(text.endswith("at this pose") for text in words) == 1
        assert not any("at this pose" in caption.text for caption in large.group(pose).captions)


@pytest.mark.parametrize("size", [(640, 360), (800, 450), (1280, 720), (360, 640)], ids=str)
@pytest.mark.parametrize("chart", [0, 1])
def test_the_title_of_a_polygon_and_what_its_bar_means_are_apart(size: tuple[int, int], chart: int) -> None:
    parts = window(size, chart, 1, docked=BAR)
    pose = load("crank-rocker").pose(2.7)
    for panel in panels("crank-rocker", parts):
        captions = (one for one in panel.group(pose).captions if not one.halo)
        title, *rest = (one.around(Type()) for one in captions)
        assert not any(title.meets(one) for one in rest)


@pytest.mark.parametrize("name", ["crank-rocker", "scissor-lift", "whitworth"])
def test_the_joints_that_vectors_are_called_by_have_their_names_and_all_words_are_in_the_picture(
    name: str,
) -> None:
    scene = load(name)
    picture = Picture(scene, (1280, 720), Look(hud=False, polygons=True), moment=1.0)
    said = [line for group in picture.groups(scene.pose(1.0)) for line in group.captions]
    assert {subscripted(joint) for joint in picture.figure.moving} <= {line.text for line in said}
    for line in said:
        box = line.around(picture.type)
        assert box.y >= 0, line.text
        assert box.bottom <= 720, line.text
