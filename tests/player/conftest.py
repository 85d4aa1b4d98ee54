"""A real window under the dummy driver."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pygame
import pytest
from playing import SIZE, Player

from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.ui import screen


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder as the current one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def player(here: Path) -> Iterator[Player]:
    """The crank-rocker's window, some frames in and paused, small so that tests are quick."""
    with screen.opened(SIZE):
        player = Player(begin(load("crank-rocker")))
        player.tick(20)
        player.press(pygame.K_SPACE)
        yield player
        player.window.close()
