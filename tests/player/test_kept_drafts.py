"""What is drawn and in no scene file yet outlasts the window: a kill, a damaged file, the next start."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path
from random import Random

import pygame
import pytest
from hand import gestures, taped
from playing import CTRL, SIZE, Player
from test_sessions import SESSIONS, Session

from linkanim.build.draft import Draft
from linkanim.player.state.action import Action
from linkanim.player.state.advance import carried
from linkanim.player.state.sheet import BuildSheet
from linkanim.player.state.state import begin
from linkanim.player.tape.tape import Tape
from linkanim.player.tape.tape_file import write
from linkanim.player.window import display
from linkanim.player.window.drafts import DraftFile
from linkanim.player.window.window import Window
from linkanim.scenes import load

PLAYED = """
import sys
from pathlib import Path
from linkanim.player.tape.tape_file import read
from linkanim.player.window import display
from linkanim.player.window.drafts import DraftFile
from linkanim.player.window.window import Window
tape, step = read(Path(sys.argv[1])), int(sys.argv[3])
with display.opened((160, 90)):
    window = Window(tape.begun, tape, drafts=DraftFile(Path(sys.argv[2])))
    for _ in range(tape.frames // step):
        window.tick(step)
        print(window.state.frame, flush=True)
    sys.stdin.read()
"""
STEP, SECOND = 4, 60
QUICK = "crank-rocker"
"""The session in the middle of which the window is killed in every run."""


def sheet_of(player: Player) -> BuildSheet:
    assert player.state.building
    return player.state.building


def started_again(kept: Path) -> Player:
    """Return a window that finds a kept draft, some frames after its start."""
    player = Player(begin(load("press")))
    player.window = Window(player.state, drafts=DraftFile(kept))
    player.tick()
    return player


def killed(tape: Tape, kept: Path, moment: int) -> int:
    """Play a tape in a window of another process, killed from about a frame on; return its last frame."""
    write(tape, kept.with_suffix(".tape.json"))
    command = [sys.executable, "-c", PLAYED, str(kept.with_suffix(".tape.json")), str(kept), str(STEP)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout
        last = 0
        for line in child.stdout:
            last = int(line)
            if last >= moment and child.poll() is None:
                child.kill()
        assert child.wait() == -signal.SIGKILL
    return last


@pytest.mark.skipif(sys.platform == "win32", reason="kill -9 is of POSIX")
@pytest.mark.parametrize(
    "session",
    [
        pytest.param(one, id=one.scene, marks=[] if one.scene == QUICK else pytest.mark.long)
        for one in SESSIONS
    ],
)
def test_of_a_window_that_is_killed_what_was_drawn_is_offered_but_for_the_last_second(
    session: Session, here: Path
) -> None:
    tape = taped(session.lines, pace=300 // len(gestures(session.lines)))
    drawn = [state.building.building.draft if state.building else Draft() for state in tape.states()]
    last = killed(
        tape, here / "draft.json", Random(session.scene).randrange(2 * SECOND, tape.frames - SECOND)
    )
    assert last < tape.frames - STEP
    with display.opened(SIZE):
        player = started_again(here / "draft.json")
        assert player.state.toast
        assert "F2" in player.state.toast.text
        player.press(pygame.K_F2)
        found = sheet_of(player).building.draft
        assert found.places
        assert found in drawn[last - SECOND : last + STEP + 1]
        player.window.close()


@pytest.mark.parametrize("tool", ["bar", "move"])
def test_what_was_drawn_is_kept_while_the_hand_is_down(here: Path, tool: str) -> None:
    click = ("hand_down", (0.0, 0.0, 3.0, 1.0)), ("hand_up", None)
    dragged = ("tool", tool), ("hand_down", (0.0, 0.0, 3.0, 1.0)), ("hand_to", (40.0, 0.0, 3.0, 1.0))
    with display.opened(SIZE):
        player = started_again(here / "draft.json")
        for name, value in (("sheet", None), *click, *dragged):
            player.window.state = carried(player.state, Action(name, value))
        player.tick(SECOND)
        assert sheet_of(player).grip
        player = started_again(here / "draft.json")
        player.press(pygame.K_F2)
        assert dict(sheet_of(player).building.draft.places) == {"O2": (0.0, 0.0)}
        player.window.close()


def test_a_draft_that_is_offered_stays_until_it_is_let_go_of(here: Path) -> None:
    kept = here / "data" / "draft.json"
    state = begin(load("press"))
    for name, value in (("sheet", None), ("hand_down", (0.0, 0.0, 3.0, 1.0)), ("hand_up", None)):
        state = carried(state, Action(name, value))
    DraftFile(kept).keep(state.sheet)
    with display.opened(SIZE):
        player = started_again(kept)
        player.tick(120)
        assert kept.exists()
        assert player.press(pygame.K_q) is False  # it is not asked about: it is kept as it was
        player.press(pygame.K_F2)
        assert list(sheet_of(player).building.draft.places) == ["O2"]
        for _ in range(2):
            player.press(pygame.K_n, CTRL)
        player.tick(60)
        assert not kept.exists()
        player.window.close()


def test_a_damaged_draft_is_said_and_does_no_harm(here: Path) -> None:
    (here / "draft.json").write_text('{"draft": {"places": 3}}')
    with display.opened(SIZE):
        player = started_again(here / "draft.json")
        player.tick()
        assert player.state.toast
        assert "damaged" in player.state.toast.text
        assert player.state.sheet is None
        player.window.close()
