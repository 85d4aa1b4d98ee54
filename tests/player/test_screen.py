"""A real window on a real X server, driven by xdotool: what a user sees, and what the shell gets back."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from PIL import Image, ImageGrab

import linkanim
from linkanim.atomic_files import kept_as
from linkanim.play.scores import Scores, save

pytestmark = [
    pytest.mark.window,
    pytest.mark.skipif(shutil.which("xdotool") is None, reason="needs xdotool; .ci/run installs it"),
]

PATIENCE = 60.0


def xdotool(*words: str) -> str:
    return subprocess.run(["xdotool", *words], capture_output=True, text=True, check=True).stdout


class Screen:
    """`linkanim play` in a process of its own, with the keyboard's focus."""

    def __init__(self, folder: Path, *words: str) -> None:
        environment = {key: value for key, value in os.environ.items() if key != "SDL_VIDEODRIVER"}
        environment["PYTHONPATH"] = str(Path(linkanim.__file__).parents[1])
        xdotool("mousemove", "10000", "10000")  # the corner of the screen: what it is over tells itself
        self.process = subprocess.Popen(
            [sys.executable, "-m", "linkanim", "play", *words],
            cwd=folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.until(self.is_there, "the window opens")

    def is_there(self) -> bool:
        found = subprocess.run(
            ["xdotool", "getwindowfocus", "getwindowpid"], capture_output=True, text=True, check=False
        )
        return found.stdout.strip() == str(self.process.pid) and len(set(self.picture().tobytes())) > 20

    def until(self, holds: Callable[[], bool], what: str) -> None:
        """Look again and again until it holds; fail, saying what did not come, when patience ends."""
        end = time.monotonic() + PATIENCE
        while not self._now(holds):
            assert self.process.poll() is None, f"{what}: the process ended: {self.process.communicate()}"
            assert time.monotonic() < end, what
            time.sleep(0.03)

    def _now(self, holds: Callable[[], bool]) -> bool:
        """Ask now; between two windows, as full screen comes and goes, there is nothing to ask of."""
        try:
            return holds()
        except (subprocess.CalledProcessError, OSError):
            return False

    def box(self) -> tuple[int, int, int, int]:
        words = dict(
            line.split("=") for line in xdotool("getwindowfocus", "getwindowgeometry", "--shell").split()
        )
        x, y, width, height = (int(words[key]) for key in ("X", "Y", "WIDTH", "HEIGHT"))
        return x, y, x + width, y + height

    def size(self) -> tuple[int, int]:
        left, top, right, bottom = self.box()
        return right - left, bottom - top

    def picture(self) -> Image.Image:
        return ImageGrab.grab(self.box(), xdisplay="")

    def moves(self) -> bool:
        """Return whether the picture is another one a moment later."""
        return self.picture().tobytes() != self.picture().tobytes()

    def still(self) -> Image.Image:
        """Return the picture once it has stood still for a while."""
        pictures: list[Image.Image] = []

        def stands() -> bool:
            pictures.append(self.picture())
            return len({picture.tobytes() for picture in pictures[-8:]}) == 1 and len(pictures) > 8

        self.until(stands, "the picture stands still")
        return pictures[-1]

    def press(self, key: str) -> None:
        xdotool("key", key)

    def changed_by(self, key: str, before: Image.Image) -> Image.Image:
        """Press a key that must change the picture, and return what it becomes."""
        self.press(key)
        self.until(lambda: self.picture().tobytes() != before.tobytes(), f"{key} changes the picture")
        return self.still()

    def ends(self) -> tuple[int, str]:
        """Return the exit code and what was said on stderr."""
        _, message = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, message


@pytest.fixture
def screen(tmp_path: Path) -> Iterator[Screen]:
    """The press, paused at its start, of somebody who was told before how to begin."""
    save(Scores(greeted=True), kept_as("scores.json"))
    screen = Screen(tmp_path, "press")
    try:
        screen.press("space")
        screen.press("r")
        screen.still()
        yield screen
    finally:
        if screen.process.poll() is None:
            screen.process.kill()
            screen.process.communicate()


# Keys that change a paused picture, and those that bring the same pixels back.
TOGGLES = {
    "Right": "Left",
    "shift+Right": "shift+Left",
    "Up": "Down",
    "d": "d",
    "Tab": "shift+Tab",
    "b": "b",
    "shift+b": "shift+b",
    "t": "t",
    "j": "j",
    "v": "v",
    "a": "a",
    "c": "shift+c",
    "k": "k",
    "o": "o",
    "e": "e",
    "plus": "minus",
    "minus": "Home",
    "KP_Add": "0",
    "l": "l",
    "h": "h",
    "F1": "Escape",
    "question": "question",
}


def test_a_toggle_pressed_twice_gives_the_same_pixels_back(screen: Screen) -> None:
    first = screen.still()
    for there, back in TOGGLES.items():
        screen.press(there)
        screen.until(lambda: screen.picture().tobytes() != first.tobytes(), f"{there} changes the picture")
        screen.press(back)
        screen.until(lambda: screen.picture().tobytes() == first.tobytes(), f"{back} undoes {there}")
    screen.press("q")
    assert screen.ends() == (0, "")


def test_numbers_and_tab_show_the_mechanisms(screen: Screen) -> None:
    shown = screen.still()
    seen = set()
    for number in "123456789":
        shown = screen.changed_by(number, shown)
        seen.add(shown.tobytes())
    assert len(seen) == 9
    screen.changed_by("Tab", shown)
    screen.press("q")
    assert screen.ends() == (0, "")


def test_space_plays_and_a_held_arrow_steps_on(screen: Screen) -> None:
    first = screen.still()
    screen.press("space")
    moving = {screen.picture().tobytes() for _ in range(10)}
    assert len(moving) > 5
    screen.press("space")
    screen.press("r")
    screen.until(lambda: screen.picture().tobytes() == first.tobytes(), "r goes back to the start")
    xdotool("keydown", "Right")
    seen: set[bytes] = set()

    def steps_on() -> bool:
        seen.add(screen.picture().tobytes())
        return len(seen) > 5

    screen.until(steps_on, "a held arrow repeats")
    xdotool("keyup", "Right")
    screen.still()
    screen.press("q")
    assert screen.ends() == (0, "")


def test_the_window_is_resized_and_fills_the_screen(screen: Screen) -> None:
    first, size = screen.still(), screen.size()
    xdotool("getwindowfocus", "windowsize", "800", "600")
    screen.until(lambda: screen.size() == (800, 600), "the window is resized")
    small = screen.still()
    assert len(set(small.crop((400, 0, 800, 600)).tobytes())) > 20
    xdotool("getwindowfocus", "windowsize", str(size[0]), str(size[1]))
    screen.until(lambda: screen.picture().tobytes() == first.tobytes(), "the picture is as it was")
    whole = ImageGrab.grab(xdisplay="").size
    screen.press("F11")
    screen.until(lambda: screen.is_there() and screen.box() == (0, 0, *whole), "the screen is filled")
    screen.press("F11")
    screen.until(
        lambda: screen.is_there() and screen.picture().tobytes() == first.tobytes(), "it is a window again"
    )
    screen.press("q")
    assert screen.ends() == (0, "")


def test_files_are_written_beside_and_told_in_a_toast(screen: Screen, tmp_path: Path) -> None:
    first = screen.still()
    for key, name in (
        ("s", "recordings/press-1.png"),
        ("F12", "recordings/press-2.png"),
        ("ctrl+s Return", "press.toml"),
    ):
        for one in key.split():
            screen.press(one)
        screen.until((tmp_path / name).exists, f"{key} writes {name}")
    screen.until(lambda: screen.picture().tobytes() == first.tobytes(), "the toast goes")
    with Image.open(tmp_path / "recordings/press-1.png") as shot:
        assert shot.convert("RGB").tobytes() == first.convert("RGB").tobytes()
    screen.press("q")
    assert screen.ends() == (0, "")


def test_dimensions_are_edited(screen: Screen) -> None:
    closed = screen.still()
    first = screen.changed_by("e", closed)
    chosen = screen.changed_by("Down", first)
    nudged = screen.changed_by("Right", chosen)
    screen.press("ctrl+z")
    screen.until(lambda: screen.picture().tobytes() == chosen.tobytes(), "Ctrl+Z undoes")
    screen.press("ctrl+y")
    screen.until(lambda: screen.picture().tobytes() == nudged.tobytes(), "Ctrl+Y does it again")
    shown = nudged
    for key in ("5", "BackSpace", "6", "period", "2", "space", "c", "m"):
        screen.press(key)
        shown = screen.still()
    taken = screen.changed_by("Return", shown)
    refused = taken
    for key in ("minus", "1", "Return"):
        refused = screen.changed_by(key, refused)
    screen.press("Escape")
    screen.until(lambda: screen.picture().tobytes() == taken.tobytes(), "Esc lets go of the value")
    screen.press("Escape")
    screen.still()
    screen.press("q")
    assert screen.ends() == (0, "")


def test_names_are_shown_then_dimensions_then_neither(screen: Screen) -> None:
    first = screen.still()
    seen = [first]
    for _ in range(2):
        seen.append(screen.changed_by("n", seen[-1]))
    screen.press("n")
    screen.until(lambda: screen.picture().tobytes() == first.tobytes(), "N a third time shows none")
    assert len({picture.tobytes() for picture in seen}) == 3
    screen.press("q")
    assert screen.ends() == (0, "")


def test_a_quantity_is_found_in_the_list_and_charted(screen: Screen) -> None:
    first = screen.still()
    shown = screen.changed_by("k", first)
    for key in ("Down", "Up", "c", "u", "r", "v", "x", "BackSpace"):
        shown = screen.changed_by(key, shown)
    screen.changed_by("Return", shown)
    screen.press("c")
    screen.until(lambda: screen.picture().tobytes() == first.tobytes(), "C puts the chart away")
    screen.changed_by("c", first)
    screen.press("shift+c")
    screen.until(lambda: screen.picture().tobytes() == first.tobytes(), "Shift+C goes back to no chart")
    screen.press("q")
    assert screen.ends() == (0, "")


def test_the_shelf_is_walked_with_arrows_and_with_the_mouse(screen: Screen) -> None:
    first = screen.still()
    shelf = screen.changed_by("o", first)
    for key in ("Right", "Down", "Left", "Up"):
        shelf = screen.changed_by(key, shelf)
    other = screen.changed_by("Right", shelf)
    screen.changed_by("Return", other)
    screen.press("shift+Tab")
    screen.until(lambda: screen.picture().tobytes() == first.tobytes(), "Shift+Tab goes back to the press")
    screen.changed_by("o", first)
    xdotool("getwindowfocus", "mousemove", "--window", "%1", "120", "100", "click", "1")
    screen.until(lambda: screen.picture().tobytes() != first.tobytes(), "a click puts a mechanism on")
    screen.still()
    screen.press("q")
    assert screen.ends() == (0, "")


def test_nonsense_typed_in_the_list_is_refused_there_and_tab_goes_on(screen: Screen) -> None:
    closed = screen.still()
    first = screen.changed_by("e", closed)
    shown = first
    for key in ("a", "b", "c", "Return"):
        shown = screen.changed_by(key, shown)
    screen.press("Escape")
    screen.until(lambda: screen.picture().tobytes() == first.tobytes(), "Esc lets go of the nonsense")
    shown = first
    for key in ("5", "6", "Tab", "6", "2", "Return"):
        shown = screen.changed_by(key, shown)
    screen.press("ctrl+z")
    screen.until(lambda: screen.picture().tobytes() != shown.tobytes(), "both are undone at once")
    screen.still()
    screen.press("Escape")
    screen.until(lambda: screen.picture().tobytes() == closed.tobytes(), "the press is as it was")
    screen.press("q")
    assert screen.ends() == (0, "")


def test_the_mouse_zooms_pans_and_turns_the_crank(screen: Screen) -> None:
    first = screen.still()
    xdotool("getwindowfocus", "mousemove", "--window", "%1", "1000", "400")
    for there, back in (("4", "5"), ("5", "4")):
        xdotool("click", there)
        screen.until(lambda: screen.picture().tobytes() != first.tobytes(), "the wheel zooms")
        xdotool("click", back)
        screen.until(lambda: screen.picture().tobytes() == first.tobytes(), "the wheel zooms back")
    xdotool("mousedown", "1", "mousemove_relative", "60", "30")
    screen.until(lambda: screen.picture().tobytes() != first.tobytes(), "a drag pans")
    xdotool("mouseup", "1")
    screen.press("0")
    screen.until(lambda: screen.picture().tobytes() == first.tobytes(), "0 fits again")
    screen.press("q")
    assert screen.ends() == (0, "")


@pytest.mark.parametrize(("key", "suffix"), [("g", "gif"), ("m", "mp4")])
def test_a_recording_is_finished_after_the_window_is_closed(
    screen: Screen, tmp_path: Path, key: str, suffix: str
) -> None:
    screen.changed_by(key, screen.still())
    screen.press("t")
    screen.press(key)
    screen.until((tmp_path / "recordings/press-1.tape.json").exists, "the tape is kept")
    screen.press("q")
    assert screen.ends() == (0, "")
    end = time.monotonic() + 2 * PATIENCE
    while not (tmp_path / f"recordings/press-1.{suffix}").exists():
        assert time.monotonic() < end, "the recording is finished"
        time.sleep(0.1)


@contextmanager
def serving(monkeypatch: pytest.MonkeyPatch, *screens: str) -> Iterator[subprocess.Popen[bytes]]:
    """Have an X server of its own, with screens beside each other; it is the display meanwhile."""
    read_end, number = os.pipe()
    screen_words = [word for at, size in enumerate(screens) for word in ("-screen", str(at), f"{size}x24")]
    words = ["Xvfb", "-displayfd", str(number), *screen_words, "+xinerama", "-noreset"]
    with subprocess.Popen(words, pass_fds=[number], stderr=subprocess.DEVNULL) as process:
        os.close(number)
        with os.fdopen(read_end) as answer:
            monkeypatch.setenv("DISPLAY", f":{answer.readline().strip()}")
        yield process
        process.kill()


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[subprocess.Popen[bytes]]:
    """An X server of its own, which a test may end."""
    with serving(monkeypatch, "800x600") as process:
        yield process


@pytest.mark.withstands("faults survived")
def test_a_window_is_moved_to_another_screen_and_used_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with serving(monkeypatch, "800x600", "3840x2160"):
        screen = Screen(tmp_path, "kite", "--size", "640x360")
        screen.press("space")
        first = screen.still()
        xdotool("getwindowfocus", "windowmove", "2000", "700")
        screen.until(lambda: screen.box() == (2000, 700, 2640, 1060), "the window is moved")
        screen.until(lambda: screen.picture().tobytes() == first.tobytes(), "the picture is as it was")
        screen.changed_by("Right", first)
        screen.press("q")
        assert screen.ends() == (0, "")


COUNTED = """
import sys
import pygame
from linkanim.cli import main
from linkanim.ui.window import Window
tick, seen = Window.tick, []

def counted(window, frames=1):
    seen.append(tick(window, frames))
    return len(seen) < 5 and seen[-1]

Window.tick = counted
code = main(["play", "kite"])
print(len(seen), code)
"""


@pytest.mark.skipif(shutil.which("weston") is None, reason="needs weston")
def test_a_window_opens_under_wayland_on_a_screen_of_scale_2(tmp_path: Path) -> None:
    tmp_path.chmod(0o700)
    quiet = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "SDL_VIDEODRIVER")}
    environment = {**quiet, "XDG_RUNTIME_DIR": str(tmp_path), "WAYLAND_DISPLAY": "wl"}
    words = ["weston", "--backend=headless-backend.so", "--width=1920", "--height=1080", "--scale=2"]
    with subprocess.Popen(
        [*words, "--socket=wl", "--no-config", "--idle-time=0"], env=environment, stderr=subprocess.DEVNULL
    ) as weston:
        try:
            end = time.monotonic() + PATIENCE
            while not (tmp_path / "wl").exists():
                assert time.monotonic() < end, "weston starts"
                time.sleep(0.03)
            done = subprocess.run(
                [sys.executable, "-c", COUNTED],
                env={**environment, "SDL_VIDEODRIVER": "wayland"},
                capture_output=True,
                text=True,
                timeout=3 * PATIENCE,
                check=False,
            )
        finally:
            weston.kill()
    assert (done.stdout.splitlines()[-1:], done.stderr) == (["5 0"], "")


@pytest.mark.withstands("faults survived")
@pytest.mark.parametrize("full", [False, True], ids=["window", "full screen"])
def test_a_display_server_that_goes_is_a_line_and_the_recording_is_kept(
    server: subprocess.Popen[bytes], tmp_path: Path, full: bool
) -> None:
    screen = Screen(tmp_path, "kite", "--size", "320x180")
    screen.press("space")
    if full:
        screen.changed_by("F11", screen.still())
    before = screen.still()
    screen.press("g")
    screen.until(lambda: screen.picture().tobytes() != before.tobytes(), "the recording is shown")
    server.kill()
    line = "linkanim: the display server is gone; what was being recorded is kept in recordings/\n"
    assert screen.ends() == (1, line)
    assert (tmp_path / "recordings" / "kite-1.tape.json").exists()
    end = time.monotonic() + 3 * PATIENCE
    while not (tmp_path / "recordings" / "kite-1.gif").exists():  # needs no display
        assert time.monotonic() < end
        time.sleep(0.1)


def test_the_last_door_of_the_title_leads_to_a_question_and_a_key_answers(tmp_path: Path) -> None:
    screen, scores = Screen(tmp_path, "--scores", "class.json"), tmp_path / "class.json"
    try:
        screen.until(screen.moves, "a mechanism runs on the title")
        screen.press("Up")  # from Run, the first door, to Play, the last
        screen.press("Return")
        screen.until(scores.is_file, "the door is kept")
        for _ in ("Predict", "all mechanisms"):
            screen.until(screen.moves, "a mechanism runs behind it")
            screen.press("Return")
        question = screen.still()
        screen.press("1")
        screen.until(lambda: screen.picture().tobytes() != question.tobytes(), "the answer is shown")
        assert '"door": "play"' in scores.read_text(encoding="utf-8")
        screen.press("q")
        assert screen.ends() == (0, "")
    finally:
        if screen.process.poll() is None:
            screen.process.kill()
            screen.process.communicate()


def test_a_four_bar_is_built_with_the_mouse_of_a_real_screen(screen: Screen, tmp_path: Path) -> None:
    """Where on the sheet the hand goes down does not matter: whole units come of it, and a crank-rocker."""
    screen.press("F2")
    screen.still()
    left, top, right, bottom = screen.box()

    def go(across: float, down: float) -> None:
        x, y = left + across * (right - left), top + down * (bottom - top)
        xdotool("mousemove", str(round(x)), str(round(y)))

    def drag(*places: tuple[float, float]) -> None:
        before = screen.picture()
        go(*places[0])
        xdotool("mousedown", "1")
        for place in places[1:]:
            go(*place)
        xdotool("mouseup", "1")
        screen.until(lambda: screen.picture().tobytes() != before.tobytes(), f"the hand draws at {places}")

    pivot, pin, end, other = (0.4, 0.7), (0.43, 0.64), (0.6, 0.3), (0.68, 0.7)
    drag(pivot)
    drag(other)
    drag(pivot, pin)
    drag(pin, (0.5, 0.5), end)
    drag(end, (0.65, 0.5), other)
    screen.press("ctrl+s")
    screen.press("Return")
    screen.until(lambda: bool(list(tmp_path.glob("*.toml"))), "Ctrl+S writes what was built")
    (path,) = tmp_path.glob("*.toml")
    assert linkanim.load(path).info.class_name == "Grashof crank-rocker"
    screen.press("q")
    assert screen.ends() == (0, "")
