"""What makes room moves the scene smoothly, never at one go."""

from __future__ import annotations

import numpy as np
import pygame
import pytest
from playing import Player

from linkanim.picture.look import Look
from linkanim.picture.view import Box, Rect, View, moved
from linkanim.player.framing import APPROACH_FRAMES, Approach, between
from linkanim.player.stroke_view import view_for

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
