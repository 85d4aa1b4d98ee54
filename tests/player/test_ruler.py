"""The ruler: laid by two clicks, it says its length and direction, and follows the joints that it is on."""

from __future__ import annotations

from collections.abc import Iterator
from math import atan2, degrees, dist

import pygame
import pytest
from playing import SHIFT, Player, the

from linkanim.picture.build_sheet import Head
from linkanim.picture.text import subscripted
from linkanim.player.ruler import Ruler
from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.ui import screen
from linkanim.units import four_digits


@pytest.fixture
def player(here: object) -> Iterator[Player]:
    del here
    with screen.opened((1280, 720)):
        player = Player(begin(load("crank-rocker")))
        player.press(pygame.K_SPACE)
        player.press(pygame.K_r, SHIFT, "R")
        yield player
        player.window.close()


def click(player: Player, *, at: str) -> None:
    places = player.state.displayed.pose(player.state.phase, 0).position
    player.drag(player.window.screen.pixel(*places[at]))


def words(player: Player) -> str:
    (head,) = (one for one in the(player.state, Ruler).drawn(player.state) if isinstance(one, Head))
    return head.sentence


def measured(player: Player, one: str, other: str) -> str:
    places = player.state.displayed.pose(player.state.phase, 0).position
    (x, y), (u, v) = places[one], places[other]
    angle = degrees(atan2(v - y, u - x)) % 360
    long = f"{four_digits(dist((x, y), (u, v)))} mm"
    return f"{subscripted(one)} to {subscripted(other)}: {long} at {four_digits(angle)}°"


def test_two_clicks_measure_a_distance_and_an_angle_that_follow_the_joints(player: Player) -> None:
    assert words(player).startswith("click two places")
    click(player, at="A")
    click(player, at="O4")
    first = words(player)
    assert first == measured(player, "A", "O4")
    player.press(pygame.K_RIGHT)
    assert words(player) == measured(player, "A", "O4") != first


def test_an_end_off_all_joints_stays_where_it_was_put(player: Player) -> None:
    view = player.window.screen.last.view
    player.drag(view.to_pixel(-20.0, -30.0))
    player.drag(view.to_pixel(10.0, -30.0))
    assert words(player).startswith("a place to a place: ")
    ends = the(player.state, Ruler).ends
    assert ends[0] == pytest.approx((-0.020, -0.030), abs=1e-3 / view.scale)
    length = float(words(player).split()[5])
    player.press(pygame.K_u, SHIFT, "U")  # from mm to cm
    player.tick(2)
    assert words(player).split()[5:7] == [f"{length / 10:.3f}", "cm"]
    click(player, at="A")  # a third click begins anew
    assert the(player.state, Ruler).ends == ("A",)


@pytest.mark.parametrize("key", [pygame.K_ESCAPE, pygame.K_TAB])
def test_esc_and_another_linkage_take_it_away(player: Player, key: int) -> None:
    click(player, at="A")
    player.press(key)
    player.tick(2)
    assert not player.state.of(Ruler)
