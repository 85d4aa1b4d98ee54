"""The manual's screenshots are what the window shows when the keys named here are pressed.

After a deliberate change, `LINKANIM_GOLDENS=write pytest tests/player/test_shots.py` takes them anew;
look at every one before it is kept.
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pygame
import pytest
from PIL import Image
from playing import Player

import linkanim
from linkanim.play.games import game_of
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.state import MOVE_FRAMES, begin
from linkanim.scenes import load
from linkanim.ui import screen

FOLDER = Path(linkanim.__file__).parent / "manual" / "pictures"
SIZE = (800, 450)
COLOURS = 64
LARGEST = 50_000
MEAN_LEVELS = 1.0
"""Another version of the font's renderer may shade some letters otherwise."""


def _press(player: Player) -> None:
    player.type("va")
    player.window.state = carried(player.state, Action("plot", "C.acceleration"))
    player.tick()
    player.tick(74)


def _double_rocker(player: Player) -> None:
    player.type("lv")
    player.press(pygame.K_b, pygame.KMOD_LSHIFT, "B")
    player.window.state = carried(player.state, Action("plot", "coupler.angle"))
    player.tick()
    player.tick(107)


def _help(player: Player) -> None:
    player.tick(60)
    player.type("h")


def _edit(player: Player) -> None:
    player.tick(60)
    player.type("e")
    player.press(pygame.K_DOWN)
    player.type("7 cm")
    player.press(pygame.K_RETURN)
    player.tick(MOVE_FRAMES)


def _names(player: Player) -> None:
    player.type("nn")
    player.settle()
    player.tick(4)


def _shelf(player: Player) -> None:
    player.type("o")
    for _ in range(90):
        player.tick()


def _predict(player: Player) -> None:
    words = "predict chapter=four-bars level=3 seed=3 again=instant_centre@crank-rocker@4.6593@coupler"
    player.window.state = carried(replace(player.state, games=game_of), Action("play", words))
    player.tick(40)
    player.type("1")
    player.tick(40)


def _title(player: Player) -> None:
    title = Action("play", "title")
    player.window.state = carried(replace(player.state, games=game_of), title)
    player.tick()  # from here on the view that fits is approached
    player.tick(119)


def _build(player: Player) -> None:
    """Draw a four-bar in five gestures, and give its coupler a point that is traced."""

    def at(x: float, y: float) -> tuple[float, float]:
        return player.window.screen.pixel(x, y)

    player.press(pygame.K_F2)
    player.drag(at(0, 0))
    player.drag(at(100, 0))
    for start, end in (((0, 0), (30, 0)), ((30, 0), (60, 80)), ((60, 80), (100, 0))):
        player.drag(at(*start), at(*end))
    player.tick(200)
    player.drag(at(45, 40))
    player.drag(at(45, 40))
    player.tick(120)
    player.type("t")
    player.tick(120)


SHOTS = {
    "title": ("press", _title),
    "build": ("crank-rocker", _build),
    "press": ("press", _press),
    "double-rocker": ("double-rocker", _double_rocker),
    "help": ("crank-rocker", _help),
    "edit": ("crank-rocker", _edit),
    "names": ("six-bar", _names),
    "shelf": ("whitworth", _shelf),
    "predict": ("crank-rocker", _predict),
}


@pytest.mark.thinned(2)
@pytest.mark.parametrize("name", SHOTS)
def test_a_screenshot_of_the_manual_is_what_the_window_shows(name: str, here: Path) -> None:
    scene, play = SHOTS[name]
    with screen.opened(SIZE):
        player = Player(begin(load(scene)))
        play(player)
        shown = screen.display_surface().convert(24)
        player.window.close()
        path = FOLDER / f"{name}.png"
        if os.environ.get("LINKANIM_GOLDENS") == "write":
            taken = Image.frombytes("RGB", SIZE, pygame.image.tobytes(shown, "RGB"))
            taken.quantize(COLOURS, dither=Image.Dither.NONE).save(path, optimize=True)
        assert path.stat().st_size <= LARGEST
        kept, now = (pygame.surfarray.array3d(one).astype(int) for one in (pygame.image.load(path), shown))
    assert kept.shape == now.shape
    assert np.abs(kept - now).mean() < MEAN_LEVELS
