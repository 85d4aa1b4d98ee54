"""What changes goes there: closures swing over, lists come in from the edge; reduced motion cuts."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import dist

import numpy as np
import pygame
import pytest
from playing import Player

from linkanim.player.state import SWING_FRAMES, Changeover
from linkanim.ui import desktop, screen
from linkanim.ui.pictures import beside

Pixels = np.ndarray


def _seen() -> Pixels:
    return pygame.surfarray.array3d(screen.display_surface()).astype(np.int16)


def _off(one: Pixels, other: Pixels) -> float:
    """Return by how much two pictures differ at the left, where a list stands."""
    return float(np.abs(one[:60] - other[:60]).mean())


def test_the_other_closure_swings_over_and_no_joint_leaps(player: Player) -> None:
    player.settle()
    phase, before = player.state.phase, player.state.scene
    player.press(pygame.K_b, text="b")
    after, places = player.state.scene, []
    assert after is not before
    for _ in range(SWING_FRAMES):
        swing = beside(player.state).swing
        assert player.state.phase == phase
        if swing is None:
            break
        left, share = swing
        ends = left.pose(phase, 0).position["B"], after.pose(phase, 0).position["B"]
        places.append(complex(*ends[0]) + share * (complex(*ends[1]) - complex(*ends[0])))
        player.tick()
    steps = [abs(b - a) for a, b in pairwise(places)]
    assert SWING_FRAMES - 2 <= len(places) <= SWING_FRAMES
    assert max(steps) < 0.05 * abs(places[-1] - places[0])
    assert beside(player.state).swing is None
    assert player.settle() == player.pixels


def test_a_pause_completes_the_swing_and_undo_swings_back(player: Player) -> None:
    player.press(pygame.K_SPACE, text=" ")
    player.press(pygame.K_b, text="b")
    player.tick(5)
    assert isinstance(player.state.glide, Changeover)
    player.press(pygame.K_SPACE, text=" ")
    assert player.state.clock.paused
    assert beside(player.state).swing is None
    player.press(pygame.K_z, pygame.KMOD_LCTRL)
    assert isinstance(player.state.glide, Changeover)


def test_what_stays_in_its_place_does_not_swing(player: Player) -> None:
    player.press(pygame.K_r, pygame.KMOD_LCTRL)
    assert player.state.glide is None


def test_a_list_comes_in_from_the_edge_and_goes_out_there(player: Player) -> None:
    player.settle()
    closed = _seen()
    for key, text in ((pygame.K_e, "e"), (pygame.K_ESCAPE, "")):
        seen = []
        player.press(key, text=text)
        for _ in range(20):
            seen.append(_seen())
            player.tick()
        off = [_off(seen[-1], one) for one in seen]
        assert off[0] > 5
        assert off[0] != off[3] != off[6]
        assert off[16] == 0
    player.settle()
    assert np.array_equal(_seen(), closed)


def test_reduced_motion_cuts(player: Player) -> None:
    player.settle()
    player.window.state = replace(player.state, reduced_motion=True)
    at = player.window.screen.pixel
    for key, mod, text in ((pygame.K_b, 0, "b"), (pygame.K_e, 0, "e"), (pygame.K_TAB, 0, "")):
        player.press(key, mod, text)
        assert player.state.glide is None
        there, seen = at(100.0, 0.0), _seen()
        player.tick()
        assert dist(at(100.0, 0.0), there) == 0
        assert np.array_equal(_seen(), seen)


@pytest.mark.parametrize(
    ("answer", "environ", "reduced"),
    [
        ("false", {"XDG_CURRENT_DESKTOP": "ubuntu:GNOME"}, True),
        ("true", {"XDG_CURRENT_DESKTOP": "GNOME"}, False),
        ("", {"XDG_CURRENT_DESKTOP": "GNOME"}, False),  # it cannot say
        ("false", {"XDG_CURRENT_DESKTOP": "KDE"}, False),  # is not asked
        ("false", {}, False),
    ],
)
@pytest.mark.skipif("sys.platform != 'linux'")
def test_gnome_is_asked(
    monkeypatch: pytest.MonkeyPatch, answer: str, environ: dict[str, str], reduced: bool
) -> None:
    monkeypatch.setattr(desktop, "_answer", lambda *_: answer)
    assert desktop.reduces_motion(environ) is reduced
