"""Small pictures without text, compared with the ones kept beside this file.

After a deliberate change, `LINKANIM_GOLDENS=write pytest tests/picture/test_goldens.py` draws them
anew; look at every one before it is kept.
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pygame
import pytest
from pictures import BARE, painted
from test_figure import inverted
from test_moving_parts import geared

from linkanim.picture.look import Look, ThemeName
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

FOLDER = Path(__file__).parent / "goldens"
LEVELS = 2
VECTORS = replace(BARE, vectors=frozenset("va"))
DARK = replace(BARE, theme="dark")


def _scene(name: str) -> Scene:
    if name == "inverted":
        return inverted(12.0)
    return geared() if name == "belt" else load(name)


@pytest.mark.parametrize(
    ("name", "phase", "look"),
    [
        ("crank-rocker", 1.0, BARE),
        ("double-rocker", 2.5, DARK),
        ("slider-crank", 0.9, VECTORS),
        ("six-bar", 2.0, DARK),
        ("antiparallelogram", 4.0, replace(BARE, trace=False)),
        ("press", 1.0, BARE),
        ("press", 4.0, replace(VECTORS, theme="dark")),
        ("press", 1.0, replace(BARE, zoom=3.0, pan=(0.1, 0.6))),
        ("drag-link", 1.0, replace(BARE, background=False)),
        ("inverted", 0.7, BARE),
        ("oldham", 0.8, BARE),
        ("double-butterfly", 0.8, DARK),
        ("belt", 0.7, BARE),
    ],
)
def test_a_picture_is_the_golden_one(name: str, phase: float, look: Look, tmp_path: Path) -> None:
    drawn = painted(_scene(name), phase, look)
    golden = FOLDER / f"{_file_name(name, look)}.png"
    if os.environ.get("LINKANIM_GOLDENS") == "write":
        golden.parent.mkdir(exist_ok=True)
        pygame.image.save(drawn, golden)
    assert golden.exists(), f"{golden} is missing: draw it with LINKANIM_GOLDENS=write, and look at it"
    wanted = pygame.image.load(golden)
    assert wanted.get_size() == drawn.get_size()
    worst = int(np.abs(_levels(drawn) - _levels(wanted)).max())
    assert worst <= LEVELS, f"{worst} levels apart; side by side in {_beside(drawn, wanted, tmp_path)}"


@pytest.mark.thinned(4)
@pytest.mark.parametrize("size", [(320, 180), (1280, 720), (720, 1280)])
@pytest.mark.parametrize(("name", "level", "theme"), [("crank-rocker", 2, "light"), ("press", 1, "dark")])
def test_names_stand_as_in_the_golden_picture(
    name: str, level: int, theme: ThemeName, size: tuple[int, int], tmp_path: Path
) -> None:
    """Letters may differ by a shade between machines, so a two hundredth of the picture may."""
    look = Look(theme=theme, names=level, hud=False)
    drawn = painted(load(name), 1.0, look, size)
    golden = FOLDER / f"names-{name}-{size[0]}x{size[1]}.png"
    if os.environ.get("LINKANIM_GOLDENS") == "write":
        pygame.image.save(drawn, golden)
    wanted = pygame.image.load(golden)
    differ = np.abs(_levels(drawn) - _levels(wanted)).max(axis=-1) > LEVELS
    assert differ.mean() < 0.005, f"side by side in {_beside(drawn, wanted, tmp_path)}"


def test_no_golden_is_left_without_its_test() -> None:
    assert len(list(FOLDER.glob("*.png"))) == 19


def _file_name(name: str, look: Look) -> str:
    words = [name, look.theme if look.theme == "dark" else "", "".join(sorted(look.vectors))]
    words += ["zoomed" if look.zoom != 1 else "", "" if look.background else "clear"]
    return "-".join(word for word in words if word)


def _levels(surface: pygame.Surface) -> np.ndarray:
    """Return colours times opacity, and opacity, so that what cannot be seen does not count."""
    colours = pygame.surfarray.array3d(surface).astype(int)
    opacity = pygame.surfarray.array_alpha(surface).astype(int)
    if not surface.get_flags() & pygame.SRCALPHA:
        opacity[:] = 255
    return np.concatenate((colours * opacity[..., None] // 255, opacity[..., None]), axis=-1)


def _beside(drawn: pygame.Surface, wanted: pygame.Surface, folder: Path) -> Path:
    """Save what was drawn, what was wanted and where they differ, next to each other."""
    width, height = drawn.get_size()
    sheet = pygame.Surface((3 * width, height), 0, 32)
    sheet.blits([(drawn, (0, 0)), (wanted, (width, 0))])
    differ = (np.abs(_levels(drawn) - _levels(wanted)).max(axis=-1) > LEVELS) * 0xFFFFFF
    pygame.surfarray.blit_array(sheet.subsurface((2 * width, 0, width, height)), differ)
    path = folder / "drawn-wanted-differ.png"
    pygame.image.save(sheet, path)
    return path
