"""The loop: who owns the time, what a missing display says, and what it starts with."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import nullcontext
from dataclasses import replace
from itertools import islice
from pathlib import Path

import pygame
import pytest
from playing import fake_start

from linkanim.errors import BadInput, NoDisplay
from linkanim.player import background
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.state import begin
from linkanim.player.tape import Tape, starting
from linkanim.player.tape_file import write
from linkanim.scenes import Scene, load
from linkanim.scenes.toml import save
from linkanim.ui import screen
from linkanim.ui.screen import Connection
from linkanim.ui.window import Window, frames, run


class Time:
    """A clock that stands still but for waiting and for what a test lets pass."""

    def __init__(self) -> None:
        self.now, self.waits = 0.0, 0

    def wait(self, seconds: float) -> None:
        assert seconds >= 0.0
        self.now += seconds
        self.waits += 1


@pytest.fixture
def time() -> Time:
    return Time()


def counted(time: Time) -> Iterator[int]:
    return frames(lambda: time.now, time.wait)


def test_frames_come_sixty_times_a_second(time: Time) -> None:
    assert list(islice(counted(time), 61)) == [1] * 61
    assert time.now == pytest.approx(1.0)


def test_a_late_frame_is_skipped_and_not_slowed(time: Time) -> None:
    ticks = counted(time)
    next(ticks)
    time.now += 0.1
    assert next(ticks) == 6
    assert next(ticks) == 1


def test_the_frames_number_follows_the_clock(time: Time) -> None:
    ticks, shown = counted(time), 0
    for late in [0.0, 0.013, 0.031, 0.0004, 0.2, 0.0] * 50:
        shown += next(ticks)
        time.now += late
    shown += next(ticks)
    assert shown == pytest.approx(1 + time.now * 60, abs=1.0)


# A window that is being moved, a laptop that sleeps, a clock that is set: time goes on where it was.
@pytest.mark.withstands("faults survived")
@pytest.mark.parametrize("leap", [1.5, 10.0, 3600.0, 1e9, -0.1, -10.0, -3600.0, -1e9])
def test_what_a_clock_leaps_by_is_left_out(time: Time, leap: float) -> None:
    ticks = counted(time)
    list(islice(ticks, 100))
    time.now += leap
    before = time.now
    assert list(islice(ticks, 60)) == [1] * 60
    assert time.now - before == pytest.approx(1.0, abs=2 / 60 + 1e-6)
    time.now += 0.1
    assert next(ticks) >= 5


def test_a_clock_that_leaps_while_it_is_waited_for_stops_nothing(time: Time) -> None:
    leaps = iter([0.0, -5.0, 0.0, 700.0, -1e6, 0.0, *[0.0] * 60])

    def wait(seconds: float) -> None:
        assert 0.0 <= seconds < 0.05
        time.now += seconds + next(leaps)

    assert list(islice(frames(lambda: time.now, wait), 30)) == [1] * 30


def test_it_waits_once_a_frame(time: Time) -> None:
    list(islice(counted(time), 11))
    assert time.waits == 10


def test_run_returns_0_when_the_window_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    ticks: list[int] = []

    def tick(window: Window, count: int) -> bool:
        ticks.append(count)
        return len(ticks) < 3

    monkeypatch.setattr(Window, "tick", tick)
    assert run("press") == 0
    assert not pygame.display.get_init()


@pytest.mark.parametrize("error", [None, NoDisplay("it is gone"), KeyboardInterrupt()], ids=repr)
def test_whatever_ends_the_window_a_recording_that_runs_is_finished(
    error: BaseException | None, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[list[str]] = []
    monkeypatch.setattr(background, "_start", fake_start(started))
    real = Window.tick

    def tick(window: Window, count: int) -> bool:
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=pygame.K_g, mod=0, unicode="g"))
        assert real(window, count)
        assert window.state.recording
        if error:
            raise error
        return False

    monkeypatch.setattr(Window, "tick", tick)
    with pytest.raises(type(error)) if error else nullcontext():
        run("kite", size=(320, 180))
    (command,) = started
    assert "kite-1.gif" in {Path(word).name for word in command}


DIALOG = [(pygame.K_g, pygame.KMOD_LSHIFT | pygame.KMOD_LCTRL, "")]
PLACE = [(ord(letter), 0, letter) for letter in "films/kite"]


# What is said of a recording is said where there is one, with the folder that it goes to.
@pytest.mark.parametrize(
    ("typed", "folder"),
    [
        pytest.param([], "", id="nothing is recorded"),
        pytest.param([(pygame.K_g, 0, "g")], "recordings", id="G"),
        pytest.param([*DIALOG, *PLACE, (pygame.K_RETURN, 0, "")], "films", id="by the dialog"),
    ],
)
def test_a_display_server_that_goes_is_told_with_what_is_kept(
    typed: list[tuple[int, int, str]], folder: str, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(background, "_start", fake_start([]))
    real, made = Window.tick, Connection()

    def tick(window: Window, count: int) -> bool:
        made.lost = True
        assert real(window, count)
        for key, mod, text in typed:
            pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=key, mod=mod, unicode=text))
            assert real(window, 1)
        return True

    monkeypatch.setattr(Window, "tick", tick)
    monkeypatch.setattr(screen, "Connection", lambda: made)
    monkeypatch.setattr(made, "close", pygame.display.quit)
    with pytest.raises(NoDisplay) as gone:
        run("kite", size=(320, 180))
    kept = f"; what was being recorded is kept in {folder}/" if folder else ""
    assert str(gone.value) == f"the display server is gone{kept}"
    assert [path.parent.name for path in here.rglob("*.tape.json")] == ([folder] if folder else [])


def test_without_a_display_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("SDL_VIDEODRIVER")
    monkeypatch.setattr(pygame.display, "get_driver", lambda: "offscreen")
    monkeypatch.setattr(Window, "tick", lambda window, count: False)
    monkeypatch.setattr(screen, "_prepare", lambda: os.environ.update(SDL_VIDEODRIVER="dummy"))
    with pytest.raises(NoDisplay, match="no display to open a window on"):
        run("press")
    assert "SDL_VIDEODRIVER" not in os.environ


# As a user meets it: no DISPLAY at all, and one that nobody answers on.
@pytest.mark.parametrize("address", ["", ":987"], ids=["none", "unreachable"])
@pytest.mark.slow
def test_without_a_display_there_is_one_line_and_code_1(address: str) -> None:
    setting = ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER", "XDG_RUNTIME_DIR")
    environment = {key: value for key, value in os.environ.items() if key not in setting}
    done = subprocess.run(
        [sys.executable, "-m", "linkanim", "play", "press"],
        env={**environment, **({"DISPLAY": address} if address else {})},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "no display" in done.stderr


# Past OpenGL there is a way to the screen under X; under Wayland there is none.
@pytest.mark.parametrize(("driver", "setting"), [("x11", "0"), ("wayland", None), ("windows", None)])
def test_only_under_x_a_picture_goes_past_opengl(
    monkeypatch: pytest.MonkeyPatch, driver: str, setting: str | None
) -> None:
    monkeypatch.setitem(os.environ, "SDL_FRAMEBUFFER_ACCELERATION", "gone")
    del os.environ["SDL_FRAMEBUFFER_ACCELERATION"]
    monkeypatch.setattr(pygame.display, "get_driver", lambda: driver)
    monkeypatch.setattr(Connection, "check", lambda connection: None)
    with screen.opened((320, 180)):
        assert os.environ.get("SDL_FRAMEBUFFER_ACCELERATION") == setting


@pytest.mark.parametrize("scene", ["no-such-scene", "missing.toml", "missing.tape.json"])
def test_a_scene_that_is_none_is_refused_before_a_window_opens(scene: str) -> None:
    with pytest.raises(BadInput):
        run(scene)


@pytest.fixture
def tape() -> Tape:
    """Ten frames of the slider-crank, faster from the fourth on."""
    start = starting(advance(begin(load("slider-crank"))))
    return Tape(start, 10, ((4, Action("speed", 3)), (6, Action("help"))))


def test_a_tape_plays_over_and_over(tape: Tape, here: Path) -> None:
    states = list(tape.states())
    with screen.opened((320, 180)):
        window = Window(tape.start, tape)
        for frame in (*range(1, 11), *range(1, 11)):
            window.tick()
            assert window.state == states[frame]


def test_a_key_leaves_the_tape(tape: Tape, here: Path) -> None:
    with screen.opened((320, 180)):
        window = Window(tape.start, tape)
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=pygame.K_t, mod=0, unicode="t"))
        window.tick(8)
        assert not window.state.look.trace
        assert window.state.clock.level == 0


def test_escape_on_a_tape_closes_no_window(tape: Tape, here: Path) -> None:
    closing = replace(tape, actions=((2, Action("back")),))
    with screen.opened((320, 180)):
        window = Window(tape.start, closing)
        assert window.tick(5)


def test_a_tape_is_played_from_its_file(tape: Tape, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tape, here / "mine.tape.json")
    seen: list[object] = []

    def tick(window: Window, count: int) -> bool:
        seen.append(window.state)
        return False

    monkeypatch.setattr(Window, "tick", tick)
    assert run("mine.tape.json") == 0
    assert seen == [tape.start]


def test_a_scene_file_is_loaded_again_in_the_window_it_was_opened_in(
    here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    save(load("kite"), here).rename(here / "my.toml")
    before, real = load("my.toml"), Window.tick
    shown: list[Scene] = []

    def tick(window: Window, count: int) -> bool:
        (here / "my.toml").write_text((here / "my.toml").read_text().replace("crank = ", "crank = 1"))
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=pygame.K_F5, mod=0, unicode=""))
        real(window, count)
        shown.append(window.state.scene)
        return False

    monkeypatch.setattr(Window, "tick", tick)
    assert run("my.toml", size=(320, 180)) == 0
    assert shown == [load("my.toml")] != [before]
