"""What happens around an open window: files that change, disks that are full, sizes that nobody has."""

from __future__ import annotations

import errno
import os
import random
import shutil
from collections.abc import Iterator
from pathlib import Path

import pygame
import pytest
from playing import SIZE, Player, fake_start

from linkanim.player import background
from linkanim.player.files import SceneFile
from linkanim.player.state import State, begin
from linkanim.player.tape_file import read
from linkanim.scenes import load
from linkanim.scenes.toml import save
from linkanim.ui import screen as display

fault = pytest.mark.withstands("faults survived")


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """The commands of the processes that would have been started."""
    commands: list[list[str]] = []
    monkeypatch.setattr(background, "_start", fake_start(commands))
    return commands


def message(player: Player) -> str:
    """Return what the window says."""
    player.tick()
    return player.state.toast.text if player.state.toast else ""


@fault
def test_a_recordings_folder_that_is_removed_meanwhile_is_made_anew(
    player: Player, here: Path, started: list[list[str]]
) -> None:
    player.type("s")
    player.type("g")
    player.tick(10)
    shutil.rmtree(here / "recordings")
    player.type("g")
    assert read(here / "recordings" / "crank-rocker-1.tape.json").frames == 11
    assert len(started) == 1


@fault
def test_a_recording_that_cannot_be_kept_runs_on_until_it_can(
    player: Player, here: Path, started: list[list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(number: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    player.type("g")
    player.tick(10)
    with monkeypatch.context() as disk:
        disk.setattr(os, "fsync", full)
        player.type("g")
    words = "recordings/crank-rocker-1.tape.json: cannot be written: no space left on device"
    assert message(player) == f"{words}; the recording runs on"
    assert list((here / "recordings").iterdir()) == []
    player.type("t")
    player.type("g")
    tape = read(here / "recordings" / "crank-rocker-1.tape.json")
    assert (tape.frames, [action.name for _, action in tape.actions]) == (14, ["trace"])
    assert (player.state.recording, len(started)) == (None, 1)


@fault
@pytest.mark.parametrize("key", ["g", "m"])
def test_whatever_ends_a_window_its_recording_is_kept(
    player: Player, here: Path, started: list[list[str]], key: str
) -> None:
    player.type(key)
    player.tick(5)
    player.window.close()
    assert read(here / "recordings" / "crank-rocker-1.tape.json").frames == 5
    assert started[0][-2].endswith({"g": ".gif", "m": ".mp4"}[key])


def paused(size: tuple[int, int]) -> tuple[Player, bytes]:
    """Return a window that was opened so large and paused in its first frames, and its picture."""
    pygame.display.set_mode(size, pygame.RESIZABLE)
    player = Player(begin(load("crank-rocker")))
    player.press(pygame.K_SPACE)
    return player, player.settle()


def resized(count: int, largest: tuple[int, int]) -> None:
    """Give a window so many sizes, one after the other, each painted; its picture must be of the last one."""
    chance = random.Random(7)
    other, small = paused((240, 200))
    other.window.close()
    player, before = paused(SIZE)
    for _ in range(count):
        size = chance.randint(1, largest[0]), chance.randint(1, largest[1])
        pygame.display.set_mode(size, pygame.RESIZABLE)
        assert player.tick()
        assert display.display_surface().get_size() == size
    for last, picture in (((240, 200), small), (SIZE, before)):
        pygame.display.set_mode(last, pygame.RESIZABLE)
        assert player.settle() == picture
    player.window.close()


@fault
@pytest.mark.slow
def test_a_window_may_have_any_size(here: Path) -> None:
    with display.opened(SIZE):
        resized(25, (400, 400))


@pytest.mark.parametrize("size", [(240, 135), (135, 240), (640, 200)])
def test_a_resized_window_shows_what_a_window_of_that_size_does(here: Path, size: tuple[int, int]) -> None:
    def shown(*sizes: tuple[int, int]) -> bytes:
        with display.opened(sizes[0]):
            player = Player(begin(load("crank-rocker")))
            player.press(pygame.K_SPACE)
            player.settle()
            for other in sizes[1:]:
                pygame.display.set_mode(other, pygame.RESIZABLE)
                player.tick()
            return player.pixels

    assert shown(SIZE, size) == shown(size)


@pytest.mark.long
@pytest.mark.withstands("frames run", 1_000)
def test_a_window_may_have_a_thousand_sizes(here: Path) -> None:
    with display.opened(SIZE):
        resized(1_000, (1_600, 1_200))


@pytest.mark.thinned(2)
@fault
@pytest.mark.parametrize(
    "size",
    [
        (1, 1),
        (2, 700),
        pytest.param((2000, 1), marks=pytest.mark.long),
        pytest.param((33, 400), marks=pytest.mark.long),
    ],
)
@pytest.mark.slow
def test_a_window_too_small_to_show_anything_takes_keys_and_mouse(here: Path, size: tuple[int, int]) -> None:
    with display.opened(SIZE):
        player = Player(begin(load("press")))
        pygame.display.set_mode(size, pygame.RESIZABLE)
        for letter in "ekonhcoo":
            player.type(letter)
            player.drag((0, 0), size)
            player.type(letter)
        assert player.tick(30)


@pytest.mark.long
@fault
def test_a_window_as_large_as_an_8k_screen_is_painted(here: Path) -> None:
    with display.opened((7680, 4320)):
        player = Player(begin(load("crank-rocker")))
        corners = [display.display_surface().get_at(at) for at in ((0, 0), (7679, 4319))]
        assert corners[0] == corners[1]
        assert len(set(pygame.transform.scale(display.display_surface(), (480, 270)).get_view("2").raw)) > 5
        player.window.close()


@fault
def test_a_window_that_is_out_of_sight_runs_on(player: Player) -> None:
    player.press(pygame.K_SPACE)
    pygame.event.post(pygame.event.Event(pygame.WINDOWMINIMIZED))
    pygame.event.post(pygame.event.Event(pygame.WINDOWHIDDEN))
    player.tick(30)
    pygame.event.post(pygame.event.Event(pygame.WINDOWRESTORED))
    pygame.event.post(pygame.event.Event(pygame.WINDOWDISPLAYCHANGED, display_index=1))
    before = player.pixels
    player.tick(20)
    assert player.state.phase == player.state.clock.at(player.state.frame)
    assert player.pixels != before


@pytest.fixture
def opened(here: Path) -> Iterator[Player]:
    """A window on a scene file of one's own, my.toml, in the current folder."""
    save(load("crank-rocker"), here).rename(here / "my.toml")
    with display.opened(SIZE):
        player = Player(begin("my.toml"), SceneFile(Path("my.toml")))
        player.tick(5)
        yield player
        player.window.close()


def written(here: Path, before: str, after: str) -> None:
    """Have the scene file say something else, as an editor does: a new file takes its place."""
    text = (here / "my.toml").read_text(encoding="utf-8")
    assert before in text
    (here / "new").write_text(text.replace(before, after), encoding="utf-8")
    (here / "new").replace(here / "my.toml")


def in_a_second(player: Player) -> str:
    """Return what the window says within the next second."""
    player.tick(60)
    return player.state.toast.text if player.state.toast else ""


@fault
def test_a_scene_file_that_changes_is_offered_and_loaded_at_the_same_phase(
    opened: Player, here: Path
) -> None:
    assert in_a_second(opened) == ""
    written(here, "crank = 50", "crank = 45")
    assert in_a_second(opened) == "my.toml has changed; F5 loads it"
    old, phase = opened.state.scene, opened.state.clock.at(opened.state.frame + 1)
    opened.press(pygame.K_F5)
    assert opened.state.scene == load(here / "my.toml") != old
    assert opened.state.phase == pytest.approx(phase)
    opened.press(pygame.K_TAB)
    opened.press(pygame.K_TAB, pygame.KMOD_LSHIFT)
    assert opened.state.scene == load(here / "my.toml")


@fault
def test_what_a_changed_file_put_on_is_undone(opened: Player, here: Path) -> None:
    before = opened.state.scene
    written(here, "crank = 50", "crank = 45")
    opened.press(pygame.K_F5)
    opened.press(pygame.K_z, pygame.KMOD_LCTRL)
    assert opened.state.scene == before


@fault
def test_a_changed_file_comes_on_in_place_of_another_mechanism(opened: Player, here: Path) -> None:
    opened.press(pygame.K_TAB)
    written(here, "crank = 50", "crank = 45")
    opened.press(pygame.K_F5)
    assert opened.state.scene == load(here / "my.toml")
    assert [entry for entry in opened.state.shelf if not isinstance(entry, str)] == [opened.state.scene]
    assert (opened.state.place, opened.state.editing.changed) == (0, False)


@fault
def test_a_changed_file_comes_on_while_a_linkage_is_built_on_it(opened: Player, here: Path) -> None:
    opened.press(pygame.K_F2, pygame.KMOD_LSHIFT)
    opened.press(pygame.K_TAB)
    written(here, "crank = 50", "crank = 45")
    assert "F5" in in_a_second(opened)
    opened.press(pygame.K_F5)
    opened.tick()
    assert opened.state.scene == load(here / "my.toml")
    assert opened.state.mode == "play"
    opened.press(pygame.K_F2)
    assert opened.state.building
    assert opened.state.building.building.draft.of("bars")["O2–A"]["length"] == 50
    opened.tick()
    opened.press(pygame.K_F2)
    opened.tick()
    assert opened.state.scene.linkage.crank("A").length == 50


@fault
@pytest.mark.parametrize(
    ("before", "after", "why"),
    [
        ("crank = 50", "crank = -50", "my.toml: four-bar.crank"),
        ("crank = 50", "crank = 300", "my.toml: four-bar"),
        ("crank = 50", "crank = =", "my.toml: "),
    ],
)
def test_a_changed_file_with_a_fault_in_it_is_refused_and_the_linkage_runs_on(
    opened: Player, here: Path, before: str, after: str, why: str
) -> None:
    good = opened.state.scene
    written(here, before, after)
    opened.press(pygame.K_F5)
    assert message(opened).startswith(why)
    assert opened.state.scene is good


def test_a_changed_file_at_which_the_solver_fails_is_refused_with_a_report(
    opened: Player, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(*_: object) -> object:
        raise ZeroDivisionError("float division")

    good = opened.state.scene
    written(here, "crank = 50", "crank = 45")
    monkeypatch.setattr("linkanim.ui.window.renewed", failing)
    opened.press(pygame.K_F5)
    assert message(opened).startswith("recordings/my-fault-1.json holds what a report".replace("/", os.sep))
    assert opened.state.scene is good


@fault
def test_a_scene_file_that_is_gone_is_told_and_may_come_back(opened: Player, here: Path) -> None:
    good = opened.state.scene
    (here / "my.toml").rename(here / "aside.toml")
    assert in_a_second(opened).startswith("my.toml is gone; the linkage runs on")
    opened.press(pygame.K_F5)
    assert "no such file" in message(opened)
    assert opened.state.scene is good
    (here / "aside.toml").rename(here / "my.toml")
    assert in_a_second(opened) == "my.toml has changed; F5 loads it"


@fault
def test_a_recording_keeps_to_the_scene_it_began_with(
    opened: Player, here: Path, started: list[list[str]]
) -> None:
    good = opened.state.scene
    opened.type("g")
    written(here, "crank = 50", "crank = 45")
    opened.press(pygame.K_F5)
    assert message(opened).startswith("a recording holds only the scenes that it began with")
    assert opened.state.scene is good


def test_without_a_scene_file_there_is_none_to_load_again(player: Player) -> None:
    player.press(pygame.K_F5)
    assert message(player).startswith("this scene was not loaded from a file")


@pytest.mark.parametrize(
    ("screen", "size"),
    [
        ((800, 600), (720, 405)),
        ((1366, 768), (1229, 691)),
        ((3840, 2160), (1280, 720)),
        ((320, 200), (288, 162)),
    ],
)
def test_a_window_fits_its_screen(
    here: Path, monkeypatch: pytest.MonkeyPatch, screen: tuple[int, int], size: tuple[int, int]
) -> None:
    monkeypatch.setattr(pygame.display, "get_desktop_sizes", lambda: [screen])
    with display.opened():
        player = Player(begin(load("kite")))
        assert display.display_surface().get_size() == size
        assert len(set(player.pixels)) > 20


PRESSED = {10: "t", 30: "d", 50: "+", 70: "e", 90: "5", 110: "\r", 130: "e", 150: "\t", 170: "v", 190: "c"}
"""Keys by the frame they come at."""


def played(step: int) -> tuple[State, bytes]:
    """Return the state and the picture after 240 frames, as many of them late as `step` says."""

    def on(player: Player, frame: int) -> None:
        while player.state.frame < frame:
            player.tick(min(step, frame - player.state.frame))

    with display.opened(SIZE):
        player = Player(begin(load("crank-rocker")))
        for frame, text in PRESSED.items():
            on(player, frame - 1)
            pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=ord(text), mod=0, unicode=text))
        on(player, 240)
        return player.state, player.pixels


@pytest.mark.long
@pytest.mark.slow
def test_state_and_picture_are_the_same_whatever_the_rate_of_frames() -> None:
    state, pixels = played(1)
    assert state.edits_dimensions is False
    assert (state.scene.name, state.look.zoom > 1, bool(state.look.chart)) == ("drag-link", False, True)
    for step in (2, 19):
        assert played(step) == (state, pixels)
