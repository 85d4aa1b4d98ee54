"""Real key and mouse events posted to the real window under the dummy driver."""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import pygame
import pytest
from playing import CTRL, SHIFT, SIZE, Player, fake_start, the

from linkanim.picture.view import Rect
from linkanim.player import background
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.browsing import grid as shelf_grid
from linkanim.player.clock import STEP
from linkanim.player.listing import Listing
from linkanim.player.naming import Naming
from linkanim.player.shelving import OpenShelf
from linkanim.player.state import CHIP_FRAMES, MOVE_FRAMES, TOAST_FRAMES, State, begin
from linkanim.player.tape_file import read
from linkanim.scenes import load, names
from linkanim.scenes.editing import dimensions
from linkanim.scenes.toml import save
from linkanim.ui import screen as display
from linkanim.ui.panels import toast_of

Key = tuple[int, int, str]


def plain(letter: str) -> Key:
    return ord(letter), 0, letter


def shifted(letter: str) -> Key:
    return ord(letter), SHIFT, letter.upper()


def bare(key: int, mod: int = 0) -> Key:
    return key, mod, ""


SPACE = plain(" ")

# What a key changes in the state, and the key that changes it back; the picture goes with it.
THERE_AND_BACK: dict[str, tuple[Key, Key, Callable[[State], object]]] = {
    "T": (plain("t"), plain("t"), lambda s: s.look.trace),
    "V": (plain("v"), plain("v"), lambda s: s.look.vectors),
    "A": (plain("a"), plain("a"), lambda s: s.look.vectors),
    "C": (plain("c"), shifted("c"), lambda s: s.look.chart),
    "L": (plain("l"), plain("l"), lambda s: s.look.theme),
    "B": (plain("b"), plain("b"), lambda s: s.scene.linkage),
    "Shift+B": (shifted("b"), shifted("b"), lambda s: s.look.ghost),
    "D": (plain("d"), plain("d"), lambda s: s.clock.direction),
    "E": (plain("e"), plain("e"), lambda s: s.edits_dimensions),
    "H": (plain("h"), plain("h"), lambda s: s.help),
    "F1": (bare(pygame.K_F1), bare(pygame.K_F1), lambda s: s.help),
    "?": ((pygame.K_SLASH, SHIFT, "?"), bare(pygame.K_ESCAPE), lambda s: s.help),
    "right, left": (bare(pygame.K_RIGHT), bare(pygame.K_LEFT), lambda s: s.phase),
    "Shift+left, right": (
        bare(pygame.K_LEFT, SHIFT),
        bare(pygame.K_RIGHT, SHIFT),
        lambda s: s.phase,
    ),
    "up, down": (bare(pygame.K_UP), bare(pygame.K_DOWN), lambda s: s.clock.speed),
    "+, -": (plain("+"), plain("-"), lambda s: s.look.zoom),
    "-, 0": (plain("-"), plain("0"), lambda s: s.look.zoom),
    "keypad +, Home": (bare(pygame.K_KP_PLUS), bare(pygame.K_HOME), lambda s: s.look.zoom),
}


ONE_CRANK = """
[ground]
O2 = [0, 0]
[joints.Q]
crank = "O2"
length = 10
"""


@pytest.mark.parametrize(("there", "back", "read"), THERE_AND_BACK.values(), ids=THERE_AND_BACK)
def test_a_key_changes_state_and_picture_and_changes_back(
    player: Player, there: Key, back: Key, read: Callable[[State], object]
) -> None:
    state, pixels = read(player.state), player.pixels
    player.press(*there)
    assert read(player.state) != state
    assert player.pixels != pixels
    player.settle()
    player.press(*back)
    assert read(player.state) == state
    assert player.settle() == pixels


def test_space_plays_and_pauses(player: Player) -> None:
    paused = player.pixels
    player.tick(30)
    assert player.pixels == paused
    player.press(*SPACE)
    player.tick(10)
    running = player.pixels
    player.tick(10)
    assert player.pixels not in (paused, running)


def test_an_arrow_steps_a_degree_and_pauses(player: Player) -> None:
    player.press(*SPACE)
    player.press(*bare(pygame.K_RIGHT))
    assert player.state.clock.paused
    before = player.state.phase
    player.press(*bare(pygame.K_RIGHT))
    assert player.state.phase - before == pytest.approx(STEP)
    player.press(*bare(pygame.K_RIGHT, SHIFT))
    assert player.state.phase - before == pytest.approx(11 * STEP)


def test_a_held_arrow_waits_and_then_goes_on(player: Player, monkeypatch: pytest.MonkeyPatch) -> None:
    held = {pygame.K_RIGHT: True}
    monkeypatch.setattr(pygame.key, "get_pressed", lambda: held)
    player.press(*bare(pygame.K_RIGHT))
    phases = [player.state.phase for _ in range(36) if player.tick()]
    steps = [n for n, (a, b) in enumerate(pairwise(phases), start=2) if b != a]
    assert steps == [24, 27, 30, 33, 36]
    held[pygame.K_RIGHT] = False
    player.tick(12)
    assert player.state.phase == phases[-1]


def test_a_late_frame_repeats_a_held_key_as_often_as_time_went_by(
    player: Player, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pygame.key, "get_pressed", lambda: {pygame.K_RIGHT: True})
    player.press(*bare(pygame.K_RIGHT))
    before = player.state.phase
    player.tick(33)
    assert player.state.phase - before == pytest.approx(4 * STEP)


def test_a_key_pressed_in_a_late_frame_is_not_held_yet(
    player: Player, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pygame.key, "get_pressed", lambda: {pygame.K_RIGHT: True})
    before = player.state.phase
    pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=pygame.K_RIGHT, mod=0, unicode=""))
    player.tick(50)
    assert player.state.phase - before == pytest.approx(STEP)


def test_a_key_that_is_not_held_on_happens_once(player: Player, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pygame.key, "get_pressed", lambda: {pygame.K_t: True})
    player.press(*plain("t"))
    player.tick(60)
    assert not player.state.look.trace


def test_tab_walks_the_catalogue(player: Player) -> None:
    player.press(*plain("r"))
    first = player.settle()
    player.press(pygame.K_TAB, 0, "\t")
    assert player.state.scene == load(names()[1])
    second = player.settle()
    player.press(pygame.K_TAB, SHIFT, "\t")
    assert (player.state.scene, player.settle()) == (load(names()[0]), first)
    player.press(*SPACE)
    assert second != first


@pytest.mark.parametrize("number", [1, 3, 9])
def test_a_number_on_the_shelf_is_a_scene_of_the_chapter(player: Player, number: int) -> None:
    player.press(*SPACE)
    player.type("o")
    player.press(*plain(str(number)))
    assert player.state.scene == load(names()[number - 1])
    assert player.state.of(OpenShelf) is None


@pytest.mark.long
def test_every_scene_runs_in_the_window(player: Player) -> None:
    player.press(*SPACE)
    for name in names():
        assert player.state.scene.name == name
        before = player.pixels
        player.tick(45)
        assert player.pixels != before, name
        player.press(pygame.K_TAB, 0, "\t")
    assert player.state.scene.name == names()[0]


def test_digits_go_to_an_angle_while_it_stands_and_while_it_runs_and_pause_there(player: Player) -> None:
    player.type("123.5")
    assert player.state.chip is not None
    assert player.state.chip.text == "θ₂ = 123.5_"
    player.press(*bare(pygame.K_BACKSPACE))
    player.press(*bare(pygame.K_BACKSPACE))
    player.press(*bare(pygame.K_RETURN))
    angle = player.state.scene.pose(player.state.phase).coordinate
    assert math.degrees(angle) % 360 == pytest.approx(123.0)
    assert player.state.clock.paused
    assert player.state.place_typed == ""
    player.type("9")
    player.press(*bare(pygame.K_ESCAPE))
    assert (player.state.place_typed, player.state.scene.name) == ("", "crank-rocker")
    player.press(*bare(pygame.K_RETURN))
    assert player.state.scene.pose(player.state.phase).coordinate == angle
    player.press(*SPACE)
    player.type("45")
    paused = [player.state.clock.paused]
    player.press(*bare(pygame.K_RETURN))
    angle = player.state.scene.pose(player.state.phase).coordinate
    assert math.degrees(angle) % 360 == pytest.approx(45.0)
    assert [*paused, player.state.clock.paused] == [False, True]


def test_an_angle_out_of_reach_is_told_with_the_range(player: Player) -> None:
    player.window.state = replace(begin(load("double-rocker")), frame=player.state.frame)
    player.press(*SPACE)
    player.type("200")
    player.press(*bare(pygame.K_RETURN))
    assert player.state.toast is not None
    reach = "13.8°…108.4°, and −108.4°…−13.8° where its start lies there"
    assert player.state.toast.text == f"the input rocker does not reach 200°; it goes {reach}"


def test_the_windows_title_is_the_scenes(player: Player) -> None:
    player.press(*SPACE)
    for key in (bare(pygame.K_TAB), "4", bare(pygame.K_TAB, SHIFT), plain("b"), "9"):
        if isinstance(key, str):
            player.type("o")
            player.type(key)
        else:
            player.press(*key)
        mark = " • edited" if key == plain("b") else ""
        assert pygame.display.get_caption()[0] == f"{player.state.scene.title}{mark} – linkanim"
    assert player.state.scene.name == names()[8]


def test_letters_in_the_open_list_are_typed_and_refused_there(player: Player) -> None:
    player.press(*plain("e"))
    before = player.state.look, player.state.scene
    player.type("abc")
    assert player.state.editing.typed == "abc"
    player.press(*bare(pygame.K_RETURN))
    assert (player.state.look, player.state.scene) == before
    assert "abc" in str(player.state.editing.refusal)
    player.press(*bare(pygame.K_ESCAPE))
    player.press(*SPACE)
    assert (player.state.editing.typed, player.state.clock.paused) == ("", False)


def test_r_goes_back_to_the_start(player: Player) -> None:
    player.press(*plain("r"))
    start = player.pixels
    player.press(*SPACE)
    player.tick(40)
    player.press(*SPACE)
    player.press(*plain("r"))
    assert (player.state.phase, player.pixels) == (0.0, start)


def test_q_closes_the_window_and_escape_never_does(player: Player) -> None:
    for _ in range(3):
        assert player.press(*bare(pygame.K_ESCAPE))
        assert player.state.toast is not None
        assert player.state.toast.text == "Q quits"
    assert not player.press(*plain("q"))


def test_escape_leaves_full_screen_then_stops_the_recording(
    player: Player, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[list[str]] = []
    monkeypatch.setattr(background, "_start", fake_start(started))
    player.press(*bare(pygame.K_F11))
    player.press(*plain("g"))
    player.press(*plain("h"))
    player.press(*bare(pygame.K_ESCAPE))
    assert (player.state.help, display.is_full()) == (False, True)
    player.press(*bare(pygame.K_ESCAPE))
    assert (display.is_full(), player.state.recording is None) == (False, False)
    player.press(*bare(pygame.K_ESCAPE))
    assert player.state.recording is None
    assert len(started) == 1


def test_q_asks_once_while_something_is_recorded(player: Player, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "_start", fake_start([]))
    player.press(*plain("g"))
    assert player.press(*plain("q"))
    assert player.state.toast is not None
    assert "Q again" in player.state.toast.text
    player.tick(200)
    assert player.press(*plain("q"))
    assert not player.press(*plain("q"))


def test_shift_g_writes_a_page_of_what_runs(player: Player, here: Path) -> None:
    player.press(*plain("c"))
    player.press(*shifted("g"))
    text = (here / "recordings" / "crank-rocker-1.html").read_text(encoding="utf-8")
    assert '"charts":[{' in text
    player.tick(1)
    assert player.state.toast
    assert "crank-rocker-1.html saved" in player.state.toast.text


def test_edits_stay_with_their_scene_and_r_twice_takes_them_back(
    player: Player, monkeypatch: pytest.MonkeyPatch
) -> None:
    captions: list[str] = []
    monkeypatch.setattr(display, "name", captions.append)
    player.press(*plain("e"))
    player.type("60")
    player.press(*bare(pygame.K_RETURN))
    player.press(*bare(pygame.K_ESCAPE))
    edited = player.state.scene
    assert edited != load("crank-rocker")
    player.press(*bare(pygame.K_TAB))
    assert (player.state.editing.past, set(player.state.edited)) == ((), {0})
    player.press(pygame.K_TAB, SHIFT)
    assert player.state.scene == edited
    assert captions[-1] == f"{edited.title} • edited"
    for key, scene in (("r", edited), ("r", load("crank-rocker")), ("r", load("crank-rocker"))):
        player.press(*plain(key))
        assert player.state.scene == scene
    assert captions[-1] == edited.title
    player.press(pygame.K_z, CTRL, "\x1a")
    assert player.state.scene == edited
    player.tick(120)
    player.press(*plain("r"))
    player.tick(120)
    player.press(*plain("r"))
    assert player.state.scene == edited


def test_the_cross_closes_the_window(player: Player) -> None:
    pygame.event.post(pygame.event.Event(pygame.QUIT))
    assert not player.tick()


@pytest.mark.slow
def test_escape_closes_help_first(player: Player) -> None:
    player.press(*plain("h"))
    assert player.press(*bare(pygame.K_ESCAPE))
    assert not player.state.help


def test_an_unbound_key_changes_nothing(player: Player) -> None:
    pixels = player.pixels
    player.press(*plain("z"))
    player.press(pygame.K_TAB, pygame.KMOD_LALT, "")
    assert player.pixels == pixels


@pytest.mark.parametrize("title", ["", "a\x00b", "one\ntwo", "\u200b", "曲柄", "A" * 300])
def test_a_window_opens_on_any_title(here: Path, title: str) -> None:
    with display.opened(SIZE):
        assert Player(begin(replace(load("crank-rocker"), title=title))).tick()
        assert pygame.display.get_caption()[0].endswith("– linkanim")


def test_keys_of_one_frame_are_taken_one_after_the_other(player: Player) -> None:
    for letter in "e7":
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=ord(letter), mod=0, unicode=letter))
    player.tick()
    assert (player.state.edits_dimensions, player.state.editing.typed) == (True, "7")


def test_a_key_is_carried_out_once(player: Player, monkeypatch: pytest.MonkeyPatch) -> None:
    carried_out: list[Action] = []

    def counted(state: State, action: Action) -> State:
        carried_out.append(action)
        return carried(state, action)

    monkeypatch.setattr("linkanim.ui.window.carried", counted)
    player.press(*plain("e"))
    player.press(*bare(pygame.K_RIGHT))
    assert carried_out == [Action("edit"), Action("nudge", 1)]


def test_a_screenshot_is_the_picture_and_tells_its_name(player: Player, here: Path) -> None:
    pixels = player.pixels
    player.press(*plain("s"))
    player.tick()
    written = here / "recordings" / "crank-rocker-1.png"
    assert pygame.image.tobytes(pygame.image.load(written), "RGB") == pixels
    assert player.state.toast is not None
    assert str(written.relative_to(here)) in player.state.toast.text
    player.press(*bare(pygame.K_F12))
    assert sorted(file.name for file in written.parent.iterdir()) == [
        "crank-rocker-1.png",
        "crank-rocker-2.png",
    ]


def test_what_answers_a_key_is_on_no_screenshot(player: Player, here: Path) -> None:
    pixels = player.settle()
    player.type("tt")
    after_the_key = player.pixels
    player.press(*plain("s"))
    player.tick()
    written = pygame.image.load(here / "recordings" / "crank-rocker-1.png")
    assert pygame.image.tobytes(written, "RGB") == pixels != after_the_key


@pytest.mark.slow
def test_shift_s_writes_the_svg_of_what_is_shown(player: Player, here: Path) -> None:
    player.type("vanpi")
    player.window.state = carried(player.state, Action("plot", "rocker.angular_velocity"))
    player.press(pygame.K_s, pygame.KMOD_LSHIFT, "S")
    player.tick()
    written = here / "recordings" / "crank-rocker-1.svg"
    assert player.state.toast is not None
    assert str(written.relative_to(here)) in player.state.toast.text
    groups = {group.get("id") for group in ElementTree.parse(written).iter("{http://www.w3.org/2000/svg}g")}
    assert {"velocity", "acceleration", "names", "chart", "words"} <= groups
    assert {"velocity-polygon", "acceleration-polygon", "body-crank", "joint-A"} <= groups


@pytest.mark.slow
def test_the_svg_shows_the_pose_of_the_window(player: Player, here: Path) -> None:
    player.press(pygame.K_s, pygame.KMOD_LSHIFT, "S")
    tree = ElementTree.parse(here / "recordings" / "crank-rocker-1.svg")
    drawn = dict[str, complex]()
    for joint in ("O2", "A", "B", "O4"):
        mark = tree.find(f".//*[@id='joint-{joint}']/*")
        assert mark is not None
        numbers = [float(number) for number in re.findall(r"[\d.]+", mark.attrib["d"])]
        x, y = ((max(way) + min(way)) / 2 for way in (numbers[::2], numbers[1::2]))
        drawn[joint] = complex(x, -y)
    pose = player.state.scene.pose(player.state.phase, 0).position
    wanted = {joint: complex(*pose[joint]) - complex(*pose["O2"]) for joint in drawn}
    scale = abs(drawn["O4"] - drawn["O2"]) / 100
    for joint, place in drawn.items():
        assert place - drawn["O2"] == pytest.approx(scale * wanted[joint], abs=0.1)


def test_a_toast_is_gone_after_three_seconds(player: Player) -> None:
    pixels = player.pixels
    player.press(*plain("s"))
    player.tick()
    assert player.pixels != pixels
    player.tick(TOAST_FRAMES)
    assert player.pixels == pixels


def test_a_screenshot_that_cannot_be_written_is_told(player: Player, here: Path) -> None:
    (here / "recordings").write_text("in the way")
    player.press(*plain("s"))
    player.tick()
    assert player.state.toast is not None
    assert "recordings" in player.state.toast.text


def test_ctrl_s_asks_once_for_a_name_and_then_writes_the_same_file(player: Player, here: Path) -> None:
    player.press(*plain("e"))
    player.press(*bare(pygame.K_RIGHT))
    player.press(pygame.K_s, CTRL, "\x13")
    assert "Save as crank-rocker_" in str(toast_of(player.state))
    for letter in "mine":
        player.press(*plain(letter))
    player.press(*bare(pygame.K_RETURN))
    player.tick()
    assert player.state.toast
    assert player.state.toast.text == f"{here / 'mine.toml'} saved"
    assert player.state.place not in player.state.edited
    player.press(*bare(pygame.K_RIGHT))
    assert player.state.place in player.state.edited
    player.press(pygame.K_s, CTRL, "\x13")
    assert [path.name for path in here.glob("*.toml")] == ["mine.toml"]
    assert load(here / "mine.toml").linkage == player.state.scene.linkage


def test_ctrl_shift_s_writes_another_file_and_a_name_that_is_taken_is_refused(
    player: Player, here: Path
) -> None:
    (here / "crank-rocker.toml").write_text("not ours")
    for _ in range(2):
        player.press(pygame.K_s, CTRL | SHIFT, "\x13")
        player.press(*bare(pygame.K_RETURN))
    assert {path.name for path in here.glob("*.toml")} == {f"crank-rocker{n}.toml" for n in ("", "-2", "-3")}
    player.press(pygame.K_s, CTRL | SHIFT, "\x13")
    for letter in "crank-rocker":
        player.press(*plain(letter))
    player.press(*bare(pygame.K_RETURN))
    player.tick()
    assert "is there already" in str(toast_of(player.state))
    player.press(*bare(pygame.K_ESCAPE))
    assert player.state.of(Naming) is None
    assert (here / "crank-rocker.toml").read_text() == "not ours"


def test_a_file_that_was_changed_after_it_was_saved_is_not_written_over(player: Player, here: Path) -> None:
    player.press(pygame.K_s, CTRL, "\x13")
    player.press(*bare(pygame.K_RETURN))
    (here / "crank-rocker.toml").write_text("by hand")
    player.press(pygame.K_s, CTRL, "\x13")
    player.tick()
    assert player.state.toast
    assert "was changed" in player.state.toast.text
    assert (here / "crank-rocker.toml").read_text() == "by hand"


def test_a_value_is_typed_with_its_unit(player: Player) -> None:
    player.press(*plain("e"))
    player.press(*bare(pygame.K_DOWN))
    player.type("4.5 cm")
    player.press(*bare(pygame.K_RETURN))
    assert {item.label: item.value for item in dimensions(player.state.scene)}["Crank 2"] == 45.0
    player.tick(20)
    player.press(pygame.K_z, CTRL, "\x1a")
    assert player.state.scene == load("crank-rocker")
    player.press(pygame.K_y, CTRL, "\x19")
    assert player.state.scene != load("crank-rocker")


def test_a_refused_value_is_shown_and_the_linkage_runs_on(player: Player) -> None:
    player.press(*plain("e"))
    player.press(*SPACE)
    player.type("-5")
    player.press(*bare(pygame.K_RETURN))
    assert player.state.editing.refusal is not None
    before = player.pixels
    player.tick(5)
    assert player.pixels != before
    assert player.state.scene == load("crank-rocker")


def test_edits_are_followed_and_undone_to_the_same_pixels(player: Player) -> None:
    pixels = player.pixels
    player.press(*plain("e"))
    player.press(*bare(pygame.K_RIGHT))
    player.press(*plain("e"))
    on_the_way = {player.pixels for _ in range(MOVE_FRAMES - 3) if player.tick()}
    assert len(on_the_way) > 5
    player.tick(20)
    assert player.pixels not in {pixels, *on_the_way}
    player.press(pygame.K_z, CTRL, "\x1a")
    player.tick(20)
    assert player.settle() == pixels


def middle_of(size: tuple[int, int]) -> tuple[float, float]:
    return size[0] / 2, size[1] / 2


def test_the_wheel_zooms_about_the_mouse(player: Player) -> None:
    player.mouse(pygame.MOUSEMOTION, (200, 60), rel=(0, 0), buttons=(0, 0, 0))
    player.tick(400)
    pixels = player.settle()
    before = player.window.screen.world(200, 60)
    player.mouse(pygame.MOUSEWHEEL, (200, 60), x=0, y=2)
    assert player.state.look.zoom == 1.25**2
    assert player.window.screen.world(200, 60) == pytest.approx(before)
    player.mouse(pygame.MOUSEWHEEL, (200, 60), x=0, y=-2)
    player.tick(400)
    assert player.settle() == pixels


def test_the_wheel_zooms_about_the_middle_before_the_mouse_was_seen(player: Player) -> None:
    middle = player.window.screen.last.about
    before = player.window.screen.world(*middle)
    player.mouse(pygame.MOUSEWHEEL, (0, 0), x=0, y=2)
    assert player.window.screen.world(*middle) == pytest.approx(before)


@pytest.mark.parametrize("listed", [False, True], ids=["chart", "list and chart"])
@pytest.mark.parametrize("at", [None, 638 + 2j], ids=["over the chart", "in a corner"])
@pytest.mark.parametrize("size", [(1280, 720), (640, 360), (720, 1280)], ids=str)
def test_the_linkage_stays_in_sight_however_it_is_zoomed(
    player: Player, listed: bool, size: tuple[int, int], at: complex | None
) -> None:
    pygame.display.set_mode(size, pygame.RESIZABLE)
    player.press(pygame.K_c, 0, "c")
    if listed:
        player.press(pygame.K_e, 0, "e")
    player.tick(60)
    framing = player.window.screen
    assert framing.last.layout.chart
    at = framing.last.layout.chart.middle if at is None else at
    for notches in (-40, 40):
        for _ in range(2):
            player.mouse(pygame.MOUSEMOTION, (at.real, at.imag), rel=(0, 0), buttons=(0, 0, 0))
            pygame.event.post(pygame.event.Event(pygame.MOUSEWHEEL, x=0, y=notches, flipped=False))
            player.tick()
        last, stage = framing.last, framing.last.layout.stage
        box = last.figure.box
        (left, top), (right, bottom) = (
            last.view.to_pixel(box.left, box.high),
            last.view.to_pixel(box.right, box.low),
        )
        assert max((right - left) / size[0], (bottom - top) / size[1]) >= 0.05
        assert last.view.scale / last.fitted.scale <= 20
        assert stage.meets(Rect(left, top, right - left, bottom - top))
    player.press(pygame.K_HOME)
    assert (player.state.look.zoom, player.state.look.pan) == (1.0, (0.0, 0.0))


def test_zero_is_a_place_as_any_digit_and_fits_the_view(player: Player) -> None:
    player.mouse(pygame.MOUSEWHEEL, (0, 0), x=0, y=3)
    player.press(pygame.K_SPACE)
    assert player.state.look.zoom > 1
    player.type("0")
    assert (player.state.look.zoom, player.state.clock.paused) == (1.0, False)
    player.press(pygame.K_RETURN)
    assert player.state.clock.paused
    assert math.degrees(player.state.scene.pose(player.state.phase, 0).coordinate) % 360 == pytest.approx(0.0)
    player.type("07")
    assert player.state.place_typed == "07"
    player.press(pygame.K_RETURN)
    assert math.degrees(player.state.scene.pose(player.state.phase, 0).coordinate) % 360 == pytest.approx(7.0)
    player.press(pygame.K_0, 0, "0")
    player.tick(CHIP_FRAMES)
    assert (player.state.place_typed, player.state.chip) == ("", None)


def test_a_drag_pans(player: Player) -> None:
    pixels = player.pixels
    before = player.window.screen.world(*middle_of(SIZE))
    player.drag((10, 110), (40, 60), (30, 80))
    assert player.window.screen.world(SIZE[0] / 2 + 20, SIZE[1] / 2 - 30) == pytest.approx(before)
    player.drag((30, 80), (10, 110))
    assert player.settle() == pixels


def test_the_crank_is_dragged_by_its_pin(player: Player) -> None:
    scene = player.state.scene
    screen = player.window.screen
    for target in (0.5, 2.0, -1.0):
        goal = scene.pose(target, 0).position["A"]
        player.drag(screen.crank_pin(), screen.pixel(*goal))
        angle = player.state.phase - target
        assert abs(math.remainder(angle, math.tau)) < 0.1
    assert player.state.clock.paused


@pytest.mark.parametrize("key", ["f1", "s"], ids=["beside help", "on a screenshot first"])
def test_a_scene_without_the_joint_under_the_mouse_takes_the_place_of_one_that_has_it(
    here: Path, player: Player, key: str
) -> None:
    """The light stands round the drive's joint as long as the mouse is over it, and goes with its scene."""
    other = here / "other.toml"
    other.write_text(ONE_CRANK, encoding="utf-8")
    player.mouse(pygame.MOUSEMOTION, player.window.screen.crank_pin(), rel=(0, 0), buttons=(0, 0, 0))
    player.window.state = begin(load(other))
    player.press(pygame.key.key_code(key))
    assert player.state.scene.linkage.drive.joint == "Q"
    assert not list(here.rglob("*fault*"))


def test_the_charts_cursor_is_dragged(player: Player) -> None:
    player.press(*plain("c"))
    player.settle()
    place = next(
        (x, y) for y in range(179, 0, -5) for x in (160,) if player.window.screen.charted(x, y) is not None
    )
    player.mouse(pygame.MOUSEBUTTONDOWN, place, button=1)
    assert player.state.phase == player.window.screen.charted(*place)
    player.drag(place, (place[0] + 40, place[1]))
    assert player.state.phase == player.window.screen.charted(place[0] + 40, place[1])


def test_a_recording_is_taped_and_rendered_beside(
    player: Player, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[list[str]] = []
    monkeypatch.setattr("linkanim.player.background._start", fake_start(started))
    player.press(*plain("g"))
    player.tick(10)
    player.press(*plain("t"))
    player.tick(5)
    player.press(*plain("g"))
    tape = read(here / "recordings" / "crank-rocker-1.tape.json")
    assert [action.name for _, action in tape.actions] == ["trace"]
    assert (tape.actions[0][0], tape.frames) == (11, 17)
    assert started[0][2:6] == ["-m", "linkanim", "record", "recordings/crank-rocker-1.tape.json"]
    player.tick(15)
    assert player.state.toast is not None
    assert "crank-rocker-1.gif saved" in player.state.toast.text
    player.tick(TOAST_FRAMES)
    assert player.state.toast is None


def test_one_period_is_recorded_at_once_in_the_size_that_is_chosen(
    player: Player, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[list[str]] = []
    monkeypatch.setattr("linkanim.player.background._start", fake_start(started))
    player.press(pygame.K_g, CTRL)
    player.tick()
    tape = read(here / "recordings" / "crank-rocker-1.tape.json")
    assert (tape.is_loop, player.state.recording) == (True, None)
    assert "--size" not in started[0]
    player.press(pygame.K_g, CTRL | SHIFT)
    player.press(pygame.K_UP)
    player.press(pygame.K_UP)
    player.press(pygame.K_UP)
    player.press(pygame.K_RIGHT)
    player.press(pygame.K_ESCAPE)
    player.tick(60)
    player.press(pygame.K_m, CTRL)
    player.tick(60)
    assert started[-1][started[-1].index("--size") + 1] == "800x450"
    assert started[-1][-2].endswith("crank-rocker-2.mp4")
    player.press(*plain("g"))
    player.press(pygame.K_g, CTRL)
    assert player.state.toast
    assert "a recording runs" in player.state.toast.text
    assert player.state.recording


def test_closing_the_window_finishes_a_recording(
    player: Player, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[list[str]] = []
    monkeypatch.setattr("linkanim.player.background._start", fake_start(started))
    player.press(*plain("m"))
    player.tick(9)
    assert player.press(*plain("q"))
    assert not player.press(*plain("q"))
    player.window.close()
    assert started[0][-2].endswith("crank-rocker-1.mp4")
    assert json.loads((here / "recordings" / "crank-rocker-1.tape.json").read_text())["frames"] == 11


def test_the_picture_follows_the_windows_size(player: Player) -> None:
    pixels, background = player.pixels, display.display_surface().get_at((0, 0))
    pygame.display.set_mode((400, 300), pygame.RESIZABLE)
    player.tick()
    assert display.display_surface().get_at((399, 299)) == background
    pygame.display.set_mode(SIZE, pygame.RESIZABLE)
    player.tick()
    assert player.pixels == pixels


def test_names_and_dimensions_are_complete_as_soon_as_they_are_asked_for(player: Player) -> None:
    """And stand as in a fresh window, once the view has come to rest; after a change of size at once."""
    for _ in range(2):
        player.press(pygame.K_n, text="n")
        labels = player.window.screen.last.names.labels
        assert labels
        assert player.settle() == Player(player.state).pixels
        assert player.window.screen.last.names.labels == labels
    pygame.display.set_mode((640, 400), pygame.RESIZABLE)
    player.tick()
    assert player.pixels == Player(player.state).pixels
    pygame.display.set_mode(SIZE, pygame.RESIZABLE)


def test_a_picture_that_stands_still_is_painted_once(player: Player, monkeypatch: pytest.MonkeyPatch) -> None:
    flips: list[int] = []
    monkeypatch.setattr(pygame.display, "flip", lambda: flips.append(1))
    player.tick(10)
    assert flips == []
    pygame.event.post(pygame.event.Event(pygame.WINDOWEXPOSED))
    player.tick()
    assert flips == [1]


def test_ctrl_o_opens_the_shelf_at_the_scene_files_here_and_puts_one_on(player: Player, here: Path) -> None:
    player.press(pygame.K_o, CTRL)
    player.tick()
    assert player.state.toast
    assert "no scene file" in player.state.toast.text
    for n, name in enumerate(("press", "hart")):
        save(replace(load(name), name=f"my-{name}"), here)
        os.utime(here / f"my-{name}.toml", (1e9 + n, 1e9 + n))
    player.press(pygame.K_o, CTRL)
    browsing = player.state.of(OpenShelf)
    assert browsing
    assert [one.title for one in browsing.own] == ["my-hart", "my-press"]  # the newest one first
    assert all(one.written.startswith("2001-09-09") for one in browsing.own)
    assert browsing.chosen == len(browsing.entries)
    player.type("my pr")
    assert player.state.of(OpenShelf)
    assert the(player.state, OpenShelf).matches == (browsing.chosen + 1,)
    player.press(pygame.K_RETURN)
    assert player.state.scene.name == "my-press"
    assert not player.state.is_covered
    (here / "my-press.toml").write_text("title = 3")
    player.press(pygame.K_F5)
    player.tick()
    assert player.state.toast
    assert "my-press.toml" in player.state.toast.text


def test_the_shelf_has_the_scene_files_here_in_a_chapter_of_their_own(player: Player, here: Path) -> None:
    save(replace(load("press"), name="my-press"), here)
    (here / "broken.toml").write_text("title = 3")
    player.press(pygame.K_o)
    browsing = player.state.of(OpenShelf)
    assert browsing
    assert browsing.chosen == player.state.place
    player.type("mine")
    shown = player.state.of(OpenShelf)
    assert shown
    player.tick(5)
    grid = shelf_grid(player.window.screen.size, shown)
    assert [words for words, _ in grid.headings] == ["Mine"]
    place = next(n for n in grid.cells if (file := shown.file_at(n)) and file.name == "my-press.toml")
    middle = grid.cells[place].middle
    player.drag((middle.real, middle.imag))
    assert (player.state.of(OpenShelf), player.state.scene.name) == (None, "my-press")
    player.press(pygame.K_o)
    player.type("broken")
    player.tick(3)
    player.press(pygame.K_RETURN)
    player.tick()
    assert player.state.toast
    assert "broken.toml" in player.state.toast.text
    assert player.state.scene.name == "my-press"


def test_a_file_that_is_dropped_is_opened_or_refused_in_a_sentence(player: Player, here: Path) -> None:
    save(load("press"), here)
    (here / "notes.txt").write_text("no scene")
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(here / "press.toml")))
    player.tick()
    assert player.state.scene == load("press")
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(here / "notes.txt")))
    player.tick(2)
    assert player.state.scene == load("press")
    assert player.state.toast
    assert "notes.txt" in player.state.toast.text


def test_a_file_is_opened_before_an_edited_first_mechanism_which_stays_as_it_was(
    player: Player, here: Path
) -> None:
    save(load("press"), here)
    player.press(pygame.K_e)
    player.press(pygame.K_RIGHT)
    edited = player.state.scene
    assert edited != load("crank-rocker")
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(here / "press.toml")))
    player.tick()
    assert (player.state.scene, player.state.place) == (load("press"), 0)
    player.window.state = carried(player.state, Action("mechanism", 1))
    assert (player.state.scene, player.state.place) == (edited, 1)


def test_the_list_of_commands_opens_by_a_right_click_and_does_what_is_chosen(player: Player) -> None:
    player.mouse(pygame.MOUSEBUTTONDOWN, (200, 90), button=3)
    assert player.state.of(Listing)
    player.type("coupler")
    player.press(pygame.K_RETURN)
    after = player.state
    assert after.of(Listing) is None
    assert not after.look.trace
    player.mouse(pygame.MOUSEBUTTONDOWN, (200, 90), button=3)
    assert player.state.of(Listing)
    player.mouse(pygame.MOUSEBUTTONDOWN, (200, 90), button=3)
    assert player.state.of(Listing) is None


@pytest.mark.parametrize("asked", ["F5", "a file that is gone", "a file that is no scene"])
def test_a_message_of_the_window_has_no_marks_of_the_terminal(player: Player, here: Path, asked: str) -> None:
    if asked == "F5":
        player.press(pygame.K_F5)
    else:
        (here / "readme.txt").write_text("no scene")
        file = here / ("gone.toml" if "gone" in asked else "readme.txt")
        pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(file)))
    player.tick(2)
    toast = toast_of(player.state)
    assert toast
    assert "`" not in toast
