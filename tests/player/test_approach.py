"""What makes room moves the scene smoothly, never at one go."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pygame
import pytest
from playing import Player

from linkanim.picture.items import Group
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.view import Box, Rect, View, moved
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.commands import bar
from linkanim.player.framing import APPROACH_FRAMES, Approach, Framing, between
from linkanim.player.state import begin
from linkanim.player.stroke_view import view_for
from linkanim.scenes import load

A, B = View(2.0, 100.0, 300.0), View(1.0, 260.0, 200.0)


def _pin(player: Player) -> complex:
    """Return where the rocker's pivot is in the window."""
    return complex(*player.window.screen.pixel(100.0, 0.0))


def _settled(player: Player) -> complex:
    """Return the same once the view has come to rest."""
    player.tick(APPROACH_FRAMES + 1)
    return _pin(player)


@pytest.mark.parametrize("key", [pygame.K_e, pygame.K_k, pygame.K_c])
def test_the_view_glides_to_where_a_list_or_a_chart_leaves_room(player: Player, key: int) -> None:
    before, way = player.settle(), [_pin(player)]
    player.press(key, text=chr(key))
    way.append(_pin(player))
    for _ in range(APPROACH_FRAMES + 2):
        player.tick()
        way.append(_pin(player))
    whole, steps = abs(way[-1] - way[0]), np.abs(np.diff(way))
    assert whole > 3
    assert steps.max() < 0.2 * whole
    assert steps[-1] == 0
    if key != pygame.K_c:
        player.press(pygame.K_ESCAPE)
        assert _pin(player) != way[0]
        assert player.settle() == before


def test_the_view_glides_with_the_other_closure_and_fills_the_window_with_what_is_shown(
    player: Player,
) -> None:
    before, way = player.settle(), [_pin(player)]
    player.press(pygame.K_b, text="b")
    for _ in range(APPROACH_FRAMES + 2):
        way.append(_pin(player))
        player.tick()
    whole, steps = abs(way[-1] - way[0]), np.abs(np.diff(way))
    assert whole > 50
    assert steps.max() < 0.2 * whole
    assert steps[-1] == 0
    player.press(pygame.K_b, text="b")
    assert player.settle() == before


def test_a_second_change_on_the_way_begins_where_the_first_had_come_to(player: Player) -> None:
    player.press(pygame.K_e, text="e")
    player.tick(4)
    there = _pin(player)
    player.press(pygame.K_ESCAPE)
    assert abs(_pin(player) - there) < 3


def test_zoom_and_mouse_act_at_once(player: Player) -> None:
    before = _pin(player)
    player.press(pygame.K_PLUS, text="+")
    once = _pin(player)
    player.tick(3)
    assert before != once == _pin(player)


@pytest.mark.parametrize("key", [pygame.K_PLUS, pygame.K_TAB], ids=["zoom", "another mechanism"])
def test_what_changes_the_view_on_the_way_is_there_at_once(player: Player, key: int) -> None:
    player.press(pygame.K_c, text="c")
    player.tick(3)
    player.press(key, text="+" if key == pygame.K_PLUS else "")
    once = _pin(player)
    player.tick(APPROACH_FRAMES)
    assert _pin(player) == once


def test_what_changes_nothing_of_the_view_lets_it_go_on_its_way(player: Player) -> None:
    player.press(pygame.K_c, text="c")
    player.tick(3)
    there = _pin(player)
    player.press(pygame.K_v, text="v")
    assert 0 < abs(_pin(player) - there) < 0.2 * abs(_settled(player) - there)


def gliding(name: str, size: tuple[int, int], *actions: Action, captioned: bool = True) -> Iterator[Picture]:
    """Yield the pictures of a glide, frame by frame, that the last action begins; then the one that fits."""
    framing, state = Framing(captioned=captioned), begin(load(name))
    for action in actions:
        framing.fitting(state, size)
        state = carried(state, action)
    for frame in range(APPROACH_FRAMES + 1):
        yield framing.at(replace(state, frame=state.frame + frame), size)


def parts(picture: Picture, *, scene: bool) -> list[Group]:
    """Return what is drawn of the scene, or of charts and polygons."""
    beside = ("chart", "reading", "velocity-polygon", "acceleration-polygon")
    found = [*picture.groups(picture.scene.pose(1.0))]
    return [group for group in found if (group.within is not None if scene else group.name in beside)]


def extent(groups: list[Group]) -> tuple[complex, complex]:
    """Return the upper left and the lower right corner of shapes."""
    places = np.concatenate([loop for group in groups for layer in group.layers for loop in layer.loops])
    return complex(places.real.min(), places.imag.min()), complex(places.real.max(), places.imag.max())


CHART = Action("chart", 1)


@pytest.mark.parametrize("size", [(1280, 720), (640, 360), (360, 640)], ids=str)
@pytest.mark.parametrize("name", ["crank-rocker", "press", "jansen", "excavator", "hart"])
def test_a_chart_comes_in_with_the_view_and_cuts_nothing_off(name: str, size: tuple[int, int]) -> None:
    *way, last = gliding(name, size, CHART)
    assert len(way) == APPROACH_FRAMES
    assert not any(picture.arrived for picture in way)
    assert last.arrived
    for picture in (*way, last):
        right, bottom = picture.edge
        if scene := parts(picture, scene=True):
            _, end = extent(scene)
            assert end.real <= right + 1e-6
            assert end.imag <= bottom + 1e-6
        begin_, _ = extent(parts(picture, scene=False))
        assert begin_.real >= right or begin_.imag >= bottom
    assert last.layout.chart
    assert last.edge[0] <= last.layout.chart.x or last.edge[1] <= last.layout.chart.y


def test_a_chart_more_comes_in_from_where_the_charts_began() -> None:
    framing, size, state = Framing(captioned=True), (1280, 720), carried(begin(load("slider-crank")), CHART)
    before = framing.fitting(state, size).layout.chart
    two = replace(state, look=replace(state.look, chart=",".join(state.scene.telling[:2])))
    tops = [framing.at(replace(two, frame=state.frame + n), size).edge[1] for n in range(APPROACH_FRAMES + 1)]
    assert before
    assert before.y - 10 < tops[0] <= before.y
    assert tops == sorted(tops, reverse=True)
    assert framing.last.layout.chart
    assert tops[-1] == int(framing.last.layout.chart.y) < 0.8 * before.y


@pytest.mark.parametrize("size", [(640, 360), (360, 640)], ids=str)
@pytest.mark.parametrize("captioned", [True, False])
@pytest.mark.parametrize("before", [(), (CHART,)], ids=["alone", "with a chart"])
def test_polygons_wait_until_the_view_has_room_for_them(
    before: tuple[Action, ...], captioned: bool, size: tuple[int, int]
) -> None:
    *way, last = gliding("crank-rocker", size, *before, Action("polygons"), captioned=captioned)
    assert len(way) == APPROACH_FRAMES
    for picture in way:
        assert not picture.has_polygons
        if scene := parts(picture, scene=True):
            _, end = extent(scene)
            assert end.real <= picture.edge[0] + 1e-6
            assert end.imag <= picture.edge[1] + 1e-6
    assert captioned or last.has_polygons


def test_a_chart_that_comes_stands_neither_under_its_buttons_nor_on_the_caption(player: Player) -> None:
    pygame.display.set_mode((1280, 720))
    player.press(pygame.K_n, text="n")
    player.settle()
    player.mouse(pygame.MOUSEMOTION, (500, 300), rel=(1, 0), buttons=(0, 0, 0))
    player.press(pygame.K_c, text="c")
    shown = player.window.screen
    crossed, room = False, Rect(0, 0, 0, 0)
    for _ in range(APPROACH_FRAMES):
        picture, buttons = shown._framing.last, bar(player.state)
        assert buttons
        chart, caption = picture.layout.chart, picture.layout.caption
        assert chart
        assert caption
        room = chart
        assert shown.button_at(room.middle.real, room.y) is None
        told = any(group.name == "caption" for group in picture.groups(picture.scene.pose(1.0)))
        come = parts(picture, scene=False)
        words = [line.around(picture.type) for group in come for line in group.captions]
        crosses = any(caption.meets(one) for one in words)
        assert not (told and crosses)
        crossed = crossed or crosses
        player.tick()
    assert crossed
    assert shown._framing.last.arrived
    assert shown.button_at(room.middle.real, room.y) is not None


def test_numbers_keep_their_backing_until_the_names_that_may_lie_under_them_are_placed() -> None:
    *_, last = gliding("excavator", (640, 360), Action("names"), CHART)
    assert last.arrived
    assert last.hurried
    groups = {group.name: group for group in last.groups(last.scene.pose(0.0))}
    names = [line.around(last.type) for line in groups["names"].captions]
    assert any(name.meets(words) for name in names for words in last.layout.words)
    assert [name for name in groups if name in ("names", "backing", "words")] == ["names", "backing", "words"]


def test_every_point_moves_straight_and_arrives() -> None:
    assert (between(A, B, 0.0), between(A, B, 1.0)) == (A, B)
    half = between(A, B, 0.5)
    assert half.to_pixel(3.0, 4.0) == pytest.approx(
        np.mean([A.to_pixel(3.0, 4.0), B.to_pixel(3.0, 4.0)], axis=0)
    )


def test_the_look_on_the_way_shows_the_view_between() -> None:
    size, look = (640, 360), Look(zoom=1.5, pan=(0.1, 0.0))
    goal = moved(B, (320.0, 180.0), zoom=1.5, pan=(36.0, 0.0))
    way = Approach(A, 10)
    look = way.look(look, B, goal, size, 13)
    shown = moved(B, (320.0, 180.0), zoom=look.zoom, pan=(look.pan[0] * 360, look.pan[1] * 360))
    expected = between(A, goal, 4 / (APPROACH_FRAMES + 1))
    assert (shown.scale, shown.x, shown.y) == pytest.approx((expected.scale, expected.x, expected.y))
    assert way.over(10 + APPROACH_FRAMES)


STAGE = Rect(0, 0, 1000, 600)
DRAWN = View(2.0, 500.0, 300.0)
STROKE = Box(-60, -40, 60, 40)


def seen(view: View, box: Box) -> tuple[float, float, float, float]:
    """Return how far a box reaches into a stage from its four edges, in pixels."""
    (left, top), (right, low) = view.to_pixel(box.left, box.high), view.to_pixel(box.right, box.low)
    return left - STAGE.x, top - STAGE.y, STAGE.right - right, STAGE.bottom - low


@pytest.mark.parametrize(
    ("swept", "scale", "why"),
    [
        (Box(-100, -80, 100, 60), 2.0, "what is in sight moves nothing"),
        (Box(-100, -200, 100, 40), 2.0, "what can be shifted into sight is not made smaller"),
        (Box(-280, -100, 280, 100), 1000 / 560, "as much smaller as it needs"),
        (Box(-900, -700, 900, 700), 1.5, "a third more is the most"),
    ],
)
def test_the_view_of_a_stroke_grows_by_a_third_at_the_most(swept: Box, scale: float, why: str) -> None:
    view = view_for(DRAWN, STROKE, swept, STAGE)
    assert view.scale == pytest.approx(scale), why
    assert min(seen(view, STROKE)) >= -1e-9, why
    assert scale == 1.5 or min(seen(view, swept)) >= -1e-9, why


def test_the_view_of_a_stroke_stays_where_all_is_in_sight() -> None:
    assert view_for(DRAWN, STROKE, Box(-100, -80, 100, 60), STAGE) == DRAWN


def test_a_stroke_and_its_linkage_stand_beside_words_where_there_is_room() -> None:
    words, box = Rect(0, 0, 250, 320), Box(-180, -80, 100, 60)
    assert view_for(DRAWN, STROKE, box, STAGE, words).to_pixel(box.left, 0)[0] == pytest.approx(250)
    assert view_for(DRAWN, STROKE, box, STAGE, words._replace(width=600)) == DRAWN


def test_a_tiny_stroke_is_enlarged_and_stays_in_sight() -> None:
    tiny = Box(200, 100, 212, 109)
    view = view_for(DRAWN, tiny, Box(195, 95, 215, 112), STAGE)
    assert view.scale > 5 * DRAWN.scale
    assert min(seen(view, tiny)) >= 0
