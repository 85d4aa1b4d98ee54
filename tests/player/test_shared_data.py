"""Two windows and three more processes on one data folder: of what all of them keep nothing is lost."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pygame
import pytest
from playing import SIZE, Player

from linkanim import atomic_files
from linkanim.play.arcade import Arcade
from linkanim.play.scores import load as scores_of
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.files import DraftFile
from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.ui import screen
from linkanim.ui.window import Window

# Draws a ground pin further right, keeps the draft and a best score, again and again; then ends as if killed.
# It waits for the others for as long as it takes: the machine may be busy.
PROCESS = """
import os, sys
from pathlib import Path
from linkanim import atomic_files
from linkanim.play.arcade import Arcade
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.state import begin
from linkanim.player.files import DraftFile
from linkanim.scenes import load
atomic_files._PATIENCE = 600.0
data, who, count = Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])
arcade, drafts = Arcade(data / "scores.json"), DraftFile(data / "draft.json")
state = carried(begin(load("press")), Action("sheet"))
for n in range(count):
    arcade.keep(f"best=match-{who}-{n}:{n}")
    if n % 4 == 0:
        for name, value in (("hand_down", (10.0 * n, 0.0, 3.0, 1.0)), ("hand_up", None)):
            state = carried(state, Action(name, value))
        drafts.keep(state.sheet)
assert arcade.news() == [], arcade.news()
os._exit(0)
"""


class Sharing(Player):
    """A window on a data folder that others have, too."""

    def __init__(self, data: Path, who: str) -> None:
        self.who, self.arcade = who, Arcade(data / "scores.json")
        state = replace(begin(load("press")), games=self.arcade.game_of)
        self.window = Window(state, keeper=self.arcade, drafts=DraftFile(data / "draft.json"))
        self.tick()

    def change(self, n: int) -> None:
        """Keep a best score, and at every fourth time a draft with one ground pin more."""
        self.arcade.keep(f"best=match-{self.who}-{n}:{n}")
        if n % 4 == 0:
            down, up = ("hand_down", (10.0 * n, 0.0, 3.0, 1.0)), ("hand_up", None)
            for name, value in (down, up) if n else (("sheet", None), down, up):
                self.window.state = carried(self.state, Action(name, value))
            self.tick(60)

    @property
    def pins(self) -> int:
        """How many pins the draft has that is on offer, or drawn; 0 without one."""
        return len(self.state.sheet.building.draft.places) if self.state.sheet else 0


def kept(each: int, here: Path) -> None:
    """Let two windows and three processes keep so many changes each, and look for all of them."""
    data, names = here / "data", ("ann", "bob", "cy", "dee", "eve")
    runs = [subprocess.Popen([sys.executable, "-c", PROCESS, data, who, str(each)]) for who in names[2:]]
    with screen.opened(SIZE):
        windows = [Sharing(data, who) for who in names[:2]]
        for n in range(each):
            for window in windows:
                window.change(n)
        assert [run.wait() for run in runs] == [0, 0, 0]
        assert [window.arcade.news() for window in windows] == [[], []]
        found = scores_of(data / "scores.json")
        assert found.best == {f"match-{who}-{n}": n for who in names for n in range(each)}
        for window in windows:
            window.window.close()
        later = [Sharing(data, "later") for _ in range(6)]
        assert [window.pins for window in later] == [-(-each // 4)] * 5 + [0]
        assert not list(data.glob("*aside*"))
        later[0].press(pygame.K_F2)
        assert later[0].state.mode == "build"
        for window in later:
            window.window.close()


@pytest.fixture(autouse=True)
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """A window waits for the others for as long as it takes, too."""
    monkeypatch.setattr(atomic_files, "_PATIENCE", 600.0)


@pytest.mark.slow
def test_of_sixty_changes_to_one_data_folder_none_is_lost(here: Path) -> None:
    kept(12, here)


@pytest.mark.long
def test_of_a_thousand_changes_none_is(here: Path) -> None:
    kept(200, here)
