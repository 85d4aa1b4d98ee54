"""What makes room moves the scene smoothly, never at one go."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pygame
import pytest
from playing import Player

from linkanim.picture.items import Group
from linkanim.picture.picture import Picture
from linkanim.picture.view import View
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.framing import APPROACH_FRAMES, Approach, Framing, between
from linkanim.player.state import SWING_FRAMES, begin
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
    for _ in range(SWING_FRAMES + 2):
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


def gliding(name: str, size: tuple[int, int], *actions: Action) -> Iterator[Picture]:
    """Yield the pictures of a glide, frame by frame, that the last action begins; then the one that fits."""
    framing, state = Framing(window=True), begin(load(name))
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
@pytest.mark.parametrize(
    ("name", "actions"),
    [
        *((name, (CHART,)) for name in ("crank-rocker", "press", "jansen", "excavator", "hart")),
        *((name, (Action("polygons"),)) for name in ("crank-rocker", "press")),
        ("crank-rocker", (CHART, Action("polygons"))),
        ("crank-rocker", (Action("names"), CHART)),
    ],
)
def test_charts_and_polygons_come_in_with_the_view_and_cut_nothing_off(
    name: str, actions: tuple[Action, ...], size: tuple[int, int]
) -> None:
    *way, last = gliding(name, size, *actions)
    assert len(way) == APPROACH_FRAMES
    for picture in (*way, last):
        right, bottom = picture.edge
        if scene := parts(picture, scene=True):
            _, end = extent(scene)
            assert end.real <= right + 1e-6
            assert end.imag <= bottom + 1e-6
        for group in parts(picture, scene=False):
            begin_, _ = extent([group])
            assert begin_.real >= right or begin_.imag >= bottom
    edges = [complex(*picture.edge) for picture in way]
    assert all(after.real <= before.real and after.imag <= before.imag for before, after in pairwise(edges))
    sides = [side for side in (last.layout.chart, last.layout.polygons) if side]
    assert sides
    assert all(last.edge[0] <= side.x or last.edge[1] <= side.y for side in sides)


def test_a_chart_more_comes_in_from_where_the_charts_began() -> None:
    framing, size, state = Framing(window=True), (1280, 720), carried(begin(load("slider-crank")), CHART)
    before = framing.fitting(state, size).layout.chart
    two = replace(state, look=replace(state.look, chart=",".join(state.scene.telling[:2])))
    tops = [framing.at(replace(two, frame=state.frame + n), size).edge[1] for n in range(APPROACH_FRAMES + 1)]
    assert before
    assert before.y - 15 < tops[0] <= before.y
    assert tops == sorted(tops, reverse=True)
    assert framing.last.layout.chart
    assert framing.last.layout.chart.y - 15 < tops[-1] <= framing.last.layout.chart.y < 0.9 * before.y


def test_every_point_moves_straight_and_arrives() -> None:
    assert (between(A, B, 0.0), between(A, B, 1.0)) == (A, B)
    half = between(A, B, 0.5)
    assert half.to_pixel(3.0, 4.0) == pytest.approx(
        np.mean([A.to_pixel(3.0, 4.0), B.to_pixel(3.0, 4.0)], axis=0)
    )


def test_the_view_on_the_way_is_between_and_arrives() -> None:
    way = Approach(A, 10, (1280.0, 500.0))
    assert way.view(B, 13) == between(A, B, 4 / (APPROACH_FRAMES + 1))
    assert not way.over(10 + APPROACH_FRAMES - 1)
    assert way.over(10 + APPROACH_FRAMES)
    # what comes in from the right is on its way, what leaves to below is gone at once
    right, down = way.aside((900.0, 700.0), 10)
    assert 0 < right < 380.0
    assert down == 0.0
    assert way.aside((900.0, 700.0), 10 + APPROACH_FRAMES) == (0.0, 0.0)


def test_a_blank_sheet_keeps_its_picture_also_with_instant_centres() -> None:
    """The view of the last linkage stays, with the centres that it included: it was made anew every frame."""
    state = carried(begin(load("crank-rocker")), Action("centres"))
    framing = Framing(window=True)
    framing.fitting(state, (640, 360))
    blank = carried(state, Action("poses"))
    assert blank.sketch is not None
    assert blank.sketch.is_blank
    once = framing.fitting(blank, (640, 360))
    assert framing.fitting(blank, (640, 360)) is once
