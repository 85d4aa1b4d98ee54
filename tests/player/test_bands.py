"""The band within which traced points stay: by key, by mouse and by Find; as wide as `tolerance` says."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pygame
import pytest
from playing import CTRL, SHIFT, NoSearch, Player, menu_in
from shown_lists import drawn_in

import linkanim
from linkanim.mechanics.measures import as_complex
from linkanim.picture.build_sheet import Head
from linkanim.picture.marks import TraceBands
from linkanim.player import background
from linkanim.player.action import Action
from linkanim.player.bands import ToleranceBand
from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.ui import screen


@pytest.fixture
def player(here: object, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    del here
    monkeypatch.setattr(background, "Following", NoSearch)
    with screen.opened((640, 360)):
        player = Player(begin(load("crank-rocker")))
        player.press(pygame.K_SPACE)
        yield player
        player.window.close()


def opened(player: Player, way: str) -> None:
    if way == "key":
        player.press(pygame.K_e, SHIFT, "E")
    elif way == "find":
        player.press(pygame.K_k, CTRL)
        player.type("how far off")
        player.press(pygame.K_RETURN)
    else:
        player.press(pygame.K_F10)
        rows = menu_in(player.state).entries
        row = next(n for n, one in enumerate(rows) if one.action == Action("tolerance"))
        for _ in range(row):
            player.press(pygame.K_DOWN)
        player.press(pygame.K_RETURN)


@pytest.mark.parametrize("way", ["key", "find", "all commands"])
def test_the_band_is_opened_by_hand_and_closed_by_esc(player: Player, way: str) -> None:
    before = player.settle()
    opened(player, way)
    head = drawn_in(player.state, Head)
    assert head
    assert "each length ± 0.2 mm: P up to" in head.sentence
    assert "chiefly by rocker" in head.facts[0]
    assert player.settle() != before
    player.press(pygame.K_ESCAPE)
    assert player.state.of(ToleranceBand) is None
    assert player.settle() == before


def test_a_band_is_as_wide_as_the_tolerance_says(player: Player) -> None:
    opened(player, "key")
    for key, by in (
        (None, 0.2),
        (pygame.K_UP, 0.5),
        (pygame.K_UP, 0.5),
        (pygame.K_DOWN, 0.2),
        (pygame.K_DOWN, 0.1),
    ):
        if key:
            player.press(key)
        band = drawn_in(player.state, TraceBands)
        assert band
        found = linkanim.tolerance("crank-rocker", by, samples=0).quantities[0]
        edges = np.array(band.edges[0])
        motion = load("crank-rocker").cycle(len(edges), derivatives=1)
        place, rate = (as_complex(part["P"]) for part in (motion.position, motion.velocity))
        assert edges.mean(axis=1) == pytest.approx(place, abs=1e-9)
        for side in (0, 1):
            away = edges[:, side] - place
            assert np.abs(away)[::4] == pytest.approx(found.bound, rel=1e-6)
            assert (np.conj(rate) * away).real == pytest.approx(0, abs=1e-6 * np.abs(rate).max())
        head = drawn_in(player.state, Head)
        assert head
        assert f"± {by:g} mm" in head.sentence
        assert f"{found.worst:.3g} mm" in head.sentence


def test_the_band_goes_with_the_lengths_it_was_asked_for(player: Player) -> None:
    opened(player, "key")
    player.press(pygame.K_TAB)
    assert player.state.scene.name != "crank-rocker"
    assert player.state.of(ToleranceBand) is None


# At a change point, and where a cylinder drives, there is no first order: a sentence says so.
@pytest.mark.parametrize("name", ["kite", "driven-piston"])
def test_where_there_is_no_band_a_sentence_says_why(name: str, player: Player) -> None:
    player.window.state = replace(begin(load(name)), games=player.state.games)
    player.press(pygame.K_e, SHIFT, "E")
    assert player.state.of(ToleranceBand) is None
    assert player.state.toast
    assert "tolerances are worked out for" in player.state.toast.text


def test_the_commands_of_the_bar_change_it(player: Player) -> None:
    opened(player, "key")
    names = [one.action for one in ToleranceBand.bar]
    assert Action("tolerate", 1) in names
    assert Action("tolerate", -1) in names
