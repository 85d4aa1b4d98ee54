"""What is drawn and in no scene file yet outlasts the window: a kill, a damaged file, the next start."""

from __future__ import annotations

import errno
import json
import math
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import pygame
import pytest
from hand import drawn, gestures, taped
from playing import CTRL, SIZE, Player
from test_sessions import SESSIONS, Session

from linkanim.build.building import Building
from linkanim.build.draft import Draft
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.building import stored_text
from linkanim.player.files import DraftFile
from linkanim.player.state import BuildSheet, begin
from linkanim.player.tape import Tape
from linkanim.player.tape_file import write
from linkanim.scenes import load
from linkanim.ui import screen
from linkanim.ui.panels import toast_of
from linkanim.ui.window import Window

PLAYED = """
import sys
from pathlib import Path
from linkanim.player.tape_file import read
from linkanim.ui import screen
from linkanim.ui.pictures import Framing
from linkanim.player.files import DraftFile
from linkanim.ui.window import Window
tape, step = read(Path(sys.argv[1])), int(sys.argv[3])
with screen.opened((160, 90)):
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


@pytest.mark.slow
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
    seen = [state.building.building.draft if state.building else Draft() for state in tape.states()]
    last = killed(
        tape, here / "draft.json", Random(session.scene).randrange(2 * SECOND, tape.frames - SECOND)
    )
    assert last < tape.frames - STEP
    with screen.opened(SIZE):
        player = started_again(here / "draft.json")
        assert player.state.toast
        assert "F2" in player.state.toast.text
        player.press(pygame.K_F2)
        found = sheet_of(player).building.draft
        assert found.places
        assert found in seen[last - SECOND : last + STEP + 1]
        player.window.close()


@pytest.mark.parametrize("tool", ["bar", "move"])
def test_what_was_drawn_is_kept_while_the_hand_is_down(here: Path, tool: str) -> None:
    click = ("hand_down", (0.0, 0.0, 3.0, 1.0)), ("hand_up", None)
    dragged = ("tool", tool), ("hand_down", (0.0, 0.0, 3.0, 1.0)), ("hand_to", (40.0, 0.0, 3.0, 1.0))
    with screen.opened(SIZE):
        player = started_again(here / "draft.json")
        for name, value in (("sheet", None), *click, *dragged):
            player.window.state = carried(player.state, Action(name, value))
        player.tick(SECOND)
        assert sheet_of(player).grip
        player.window.close()
        player = started_again(here / "draft.json")
        player.press(pygame.K_F2)
        assert dict(sheet_of(player).building.draft.places) == {"O2": (0.0, 0.0)}
        player.window.close()


def test_a_draft_that_is_offered_stays_until_it_is_let_go_of(here: Path) -> None:
    kept = here / "data" / "draft.json"
    state = begin(load("press"))
    for name, value in (("sheet", None), ("hand_down", (0.0, 0.0, 3.0, 1.0)), ("hand_up", None)):
        state = carried(state, Action(name, value))
    drafts = DraftFile(kept)
    drafts.keep(state.sheet)
    drafts.close()
    with screen.opened(SIZE):
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


def drawn_on(player: Player, *places: tuple[float, float]) -> None:
    """Set ground pins on an open sheet, and let it be kept."""
    for at in places:
        for name, value in (("hand_down", (*at, 3.0, 1.0)), ("hand_up", None)):
            player.window.state = carried(player.state, Action(name, value))
    player.tick(SECOND)


def four_bar() -> dict[str, Any]:
    """Return what is kept of a four-bar on a sheet."""
    found: dict[str, Any] = json.loads(stored_text(begin_on(drawn(SESSIONS[0].lines))))
    return found


def begin_on(building: Building) -> BuildSheet:
    sheet = carried(begin(load("press")), Action("sheet")).building
    assert sheet
    return replace(sheet, building=building)


def changed(*keys: str | int, to: Any) -> Callable[[], bytes]:
    """Return what makes a kept draft with another value at some keys."""

    def text() -> bytes:
        document = holder = four_bar()
        for key in keys[:-1]:
            holder = holder[key]  # type: ignore[index]
        holder[keys[-1]] = to  # type: ignore[index]
        return json.dumps(document).encode()

    return text


DAMAGED: dict[str, Callable[[], bytes]] = {
    "nothing": lambda: b"",
    "half of it": lambda: json.dumps(four_bar()).encode()[:200],
    "no text": lambda: b"\xff\xfe\0",
    "another document": lambda: b'{"draft": {"places": 3}}',
    "deep": lambda: b"[" * 100_000,
    "a number of 401 digits": changed("draft", "places", "A", to=[10**400, 0]),
    "a number of 4,401 digits": lambda: json.dumps(four_bar()).encode().replace(b"30", b"3" * 4_401, 1),
    "a place beyond all others": changed("draft", "places", "A", to=[1e100, 0]),
    "no number": changed("draft", "places", "A", to=[math.nan, 0]),
    "an endless one": lambda: json.dumps(four_bar()).encode().replace(b"30", b"1e999", 1),
    "half a character": changed("draft", "rest", "title", to="\ud800"),
    "a colour for the terminal": changed("draft", "rest", "title", to="\x1b[31m"),
    "an edge that is none": changed("home", 0, to=math.nan),
    "no room": changed("home", to=[0, 0, 0, 0]),
    "edges the other way round": changed("home", to=[100, 100, -100, -100]),
    "five edges": changed("home", to=[-1, -1, 1, 1, 2]),
    "too far away": changed("home", to=[-1e300, -1e300, 1e300, 1e300]),
    "an unknown tool": changed("tool", to="hammer"),
    "a tool that is a list": changed("tool", to=["bar"]),
    "a bar of no joint": changed("draft", "tables", "bars", "x", to={"joints": ["A", "Z"], "length": 3}),
    "a photograph of no width": changed("draft", "photo", to=["a.png", [0, 0], 0, 0]),
    "a newer version": changed("linkanim_draft", to=2),
}


@pytest.mark.parametrize("content", DAMAGED.values(), ids=DAMAGED)
def test_a_damaged_draft_is_set_aside_with_a_sentence_and_another_is_kept(
    here: Path, content: Callable[[], bytes]
) -> None:
    kept, text, state = here / "draft.json", content(), begin(load("press"))
    kept.write_bytes(text)
    drafts = DraftFile(kept)
    after, said = drafts.offered(state)
    assert after is state
    assert said
    assert said.startswith(f"{kept}: ")
    assert said.endswith("; it is kept as draft-aside-1.json")
    drafts.keep(begin_on(drawn(["click 0 0"])))
    drafts.close()
    assert (here / "draft-aside-1.json").read_bytes() == text
    again, _ = drafts.offered(state)
    drafts.close()
    assert again.sheet
    assert list(again.sheet.building.draft.places) == ["O2"]


def test_a_window_opens_over_a_damaged_draft_and_says_so(here: Path) -> None:
    (here / "draft.json").write_bytes(DAMAGED["a number of 401 digits"]())
    with screen.opened(SIZE):
        player = started_again(here / "draft.json")
        assert player.state.sheet is None
        assert player.state.toast
        assert player.state.toast.text.endswith("; it is kept as draft-aside-1.json")
        player.window.close()


@pytest.mark.slow
def test_what_windows_draw_at_once_is_in_nobody_s_way_and_is_offered_one_by_one(here: Path) -> None:
    kept = here / "data" / "draft.json"
    with screen.opened(SIZE):
        windows = [started_again(kept) for _ in range(3)]
        assert not kept.parent.exists()
        for count, player in enumerate(windows, 1):
            player.press(pygame.K_F2)
            drawn_on(player, *((10.0 * n, 0.0) for n in range(count)))
        files = ["draft.json", "draft-2.json", "draft-3.json"]
        assert sorted(path.name for path in kept.parent.glob("d*")) == sorted(files)
        for player in windows:  # as if they had been killed: locks go with their run
            player.window._drafts.close()  # type: ignore[union-attr]
        offered = [started_again(kept) for _ in range(4)]
        assert [player.state.toast is not None for player in offered] == [True] * 3 + [False]
        found = [player.state.sheet and len(player.state.sheet.building.draft.places) for player in offered]
        assert found == [1, 2, 3, None]
        offered[1].press(pygame.K_F2)
        for _ in range(2):
            offered[1].press(pygame.K_n, CTRL)
        offered[1].tick(SECOND)
        for player in offered:
            player.window.close()
        assert sorted(path.name for path in kept.parent.iterdir()) == ["draft-3.json", "draft.json"]


@pytest.fixture
def full(monkeypatch: pytest.MonkeyPatch) -> Callable[[bool], None]:
    """What fills the disk, or frees it."""
    synced, is_full = os.fsync, [False]

    def sync(number: int) -> None:
        if is_full[0]:
            raise OSError(errno.ENOSPC, "No space left on device")
        synced(number)

    monkeypatch.setattr(os, "fsync", sync)
    return lambda filled: is_full.__setitem__(0, filled)


def test_a_draft_that_a_full_disk_does_not_take_is_kept_when_there_is_room(
    here: Path, full: Callable[[bool], None]
) -> None:
    kept = here / "draft.json"
    with screen.opened(SIZE):
        player = started_again(kept)
        player.press(pygame.K_F2)
        full(True)
        drawn_on(player, (0.0, 0.0))
        player.tick()
        assert player.state.toast
        assert player.state.toast.text == f"{kept}: cannot be written: no space left on device"
        player.tick(4 * SECOND)
        assert toast_of(player.state) is None  # it is said once
        full(False)
        player.tick(SECOND)
        assert "O2" in kept.read_text()
        full(True)
        drawn_on(player, (50.0, 0.0))
        full(False)
        player.window.close()
        assert "O4" in kept.read_text()


def test_closing_does_not_promise_what_a_full_disk_prevents(here: Path, full: Callable[[bool], None]) -> None:
    with screen.opened(SIZE):
        player = started_again(here / "draft.json")
        player.press(pygame.K_F2)
        full(True)
        drawn_on(player, (0.0, 0.0))
        assert player.press(pygame.K_q)
        assert player.press(pygame.K_q)
        player.tick()
        assert player.state.toast
        assert player.state.toast.text.endswith("no space left on device; once more closes without the draft")
        assert player.press(pygame.K_q) is False
        player.window.close()
        assert not (here / "draft.json").exists()


def test_a_folder_that_takes_no_drafts_is_a_sentence(here: Path) -> None:
    (here / "data").write_text("a file where the folder would be")
    with screen.opened(SIZE):
        player = started_again(here / "data" / "draft.json")
        player.press(pygame.K_F2)
        drawn_on(player, (0.0, 0.0))
        player.tick()
        assert player.state.toast
        assert "cannot be" in player.state.toast.text
        player.window.close()


def test_a_window_that_begins_with_a_photograph_says_that_a_draft_is_kept_and_leaves_it(here: Path) -> None:
    kept = here / "draft.json"
    state = begin(load("press"))
    for name, value in (("sheet", None), ("hand_down", (0.0, 0.0, 3.0, 1.0)), ("hand_up", None)):
        state = carried(state, Action(name, value))
    drafts = DraftFile(kept)
    drafts.keep(state.sheet)
    drafts.close()
    before = kept.read_bytes()
    with screen.opened(SIZE):
        window = Window(begin(load("press")), drafts=DraftFile(kept), offer=False)
        window.open_sheet()
        window.tick()
        assert window.state.building
        assert not window.state.building.building.draft.places
        assert window.state.toast
        assert "`linkanim new` without a photograph takes it up" in window.state.toast.text
        window.tick(2 * SECOND)
        window.close()
        assert kept.read_bytes() == before
        without = Window(begin(load("press")), drafts=DraftFile(here / "none.json"), offer=False)
        without.tick()
        assert without.state.toast is None
        without.close()
