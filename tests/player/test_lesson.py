"""A lesson: made by a key at each state, stepped by keys and a remote, taped, recorded, refused in words."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from zipfile import ZipFile

import pygame
import pytest
from playing import CTRL, SHIFT, NoSearch, Player

from linkanim.cli import main
from linkanim.errors import BadInput
from linkanim.play.games import game_of
from linkanim.player import background
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.commands import bar
from linkanim.player.lesson import Lesson, LessonStep, read
from linkanim.player.state import State, begin
from linkanim.player.tape import Taping
from linkanim.player.tape_file import from_document, to_document
from linkanim.scenes import load
from linkanim.scenes.toml import content
from linkanim.ui import screen
from linkanim.ui.window import Window

PLAIN = '[[step]]\nscene = "press"\n'


@pytest.fixture
def player(here: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    del here
    monkeypatch.setattr(background, "Following", NoSearch)
    with screen.opened((640, 360)):
        player = Player(replace(begin(load("press")), games=game_of))
        player.press(pygame.K_SPACE)
        yield player
        player.window.close()


def keep(player: Player, caption: str = "") -> None:
    player.press(pygame.K_F8, SHIFT if caption else 0)
    if caption:
        player.type(caption)
        player.press(pygame.K_RETURN)
    player.tick()


def seen(state: State) -> tuple[object, ...]:
    """Return what is shown, in a lesson or not."""
    look = replace(state.look, caption=False)
    return state.scene.name, round(state.phase, 9), state.clock.paused, round(state.clock.speed, 9), look


def ten_states(player: Player) -> Iterator[tuple[str, State]]:
    """Go through ten states that a lecturer likes, as by hand, and yield a caption and each."""
    player.type("v")
    yield "", player.state
    player.type("na")
    yield "dead centre: the ram stands still, its acceleration does not", player.state
    player.press(pygame.K_SPACE)
    player.press(pygame.K_DOWN)
    yield "", player.state
    player.type("c")
    yield "", player.state
    player.press(pygame.K_k, CTRL)
    player.type("crank-rocker")
    player.press(pygame.K_RETURN)
    yield "a crank-rocker", player.state
    player.press(pygame.K_F7)
    player.press(pygame.K_F7)
    player.press(pygame.K_SPACE)
    yield "", player.state
    player.press(pygame.K_ESCAPE)
    player.type("p")
    yield "its polygons", player.state
    player.type("d")
    player.press(pygame.K_EQUALS, 0, "=")
    yield "", player.state
    player.type("e")
    player.type("90")
    player.press(pygame.K_RETURN)
    player.type("e")
    yield "another ground", player.state
    player.press(pygame.K_k, CTRL)
    player.type("double-rocker")
    player.press(pygame.K_RETURN)
    player.press(pygame.K_RIGHT, SHIFT)
    yield "it swings", player.state


@pytest.mark.slow
def test_a_lesson_of_ten_steps_is_made_stepped_and_read_back(player: Player, here: Path) -> None:
    wanted: list[tuple[str, tuple[object, ...], int]] = []
    for caption, state in ten_states(player):
        keep(player, caption)
        wanted.append((caption, seen(state), state.constructed))
    steps = read(here / "lesson.toml")
    assert len(steps) == 10
    for further, (n, (caption, shown, constructed)) in zip([-9, *[1] * 9], enumerate(wanted), strict=True):
        for _ in range(abs(further)):
            player.press(pygame.K_PAGEDOWN if further > 0 else pygame.K_PAGEUP)
        assert player.state.lesson == (n + 1, 10)
        now = seen(player.state)
        period = player.state.scene.period
        off = math.remainder(float(now[1]) - float(shown[1]), period)  # type: ignore[arg-type]
        frames = 0 if player.state.clock.paused else len(caption) + 5
        moved = abs(player.state.clock.speed) * frames / 60 + 1e-6
        assert abs(off) <= moved
        assert (now[2:], player.state.constructed) == (shown[2:], constructed)
        assert str(now[0]).removeprefix("lesson-") == shown[0]
        assert player.state.look.caption == bool(caption)
        if caption:
            assert player.state.scene.look_at == caption
    assert (here / "lesson-crank-rocker.toml").exists()
    assert [one.name for one in here.glob("*.toml")].count("lesson-crank-rocker.toml") == 1


KEYS = {
    "right": (pygame.K_RIGHT, 1),
    "left": (pygame.K_LEFT, -1),
    "a remote on": (pygame.K_PAGEDOWN, 1),
    "a remote back": (pygame.K_PAGEUP, -1),
}


def opened(player: Player, here: Path, text: str = 3 * PLAIN) -> None:
    (here / "mine.toml").write_text(text)
    player.window = Window(player.state, lesson=Lesson(here / "mine.toml"))
    player.tick()
    player.press(pygame.K_PAGEDOWN)
    player.press(pygame.K_PAGEDOWN)


@pytest.mark.parametrize("key", KEYS)
def test_the_arrows_and_a_remote_step_it(player: Player, here: Path, key: str) -> None:
    opened(player, here)
    assert player.state.lesson == (2, 3)
    code, further = KEYS[key]
    player.press(code)
    assert player.state.lesson == (2 + further, 3)
    player.press(code)
    assert player.state.lesson == (2 + further, 3)  # it has ends


def test_all_other_keys_are_as_without_a_lesson_and_esc_leaves_it(player: Player, here: Path) -> None:
    opened(player, here)
    player.press(pygame.K_SPACE)
    assert player.state.clock.paused
    phase = player.state.phase
    player.press(pygame.K_RIGHT, SHIFT)
    assert player.state.phase == pytest.approx(phase + math.radians(10))
    player.type("t")
    assert not player.state.look.trace
    player.type("o")
    player.type("whitworth")
    player.press(pygame.K_RETURN)
    assert (player.state.scene.name, player.state.lesson) == ("whitworth", (2, 3))
    player.press(pygame.K_PAGEDOWN)
    assert (player.state.scene.name, player.state.lesson) == ("press", (3, 3))
    player.press(pygame.K_ESCAPE)
    assert player.state.lesson is None
    player.press(pygame.K_SPACE)
    player.press(pygame.K_RIGHT)
    assert player.state.clock.paused
    player.press(pygame.K_PAGEUP)
    assert player.state.lesson == (2, 3)


def test_the_bar_has_its_steps(player: Player, here: Path) -> None:
    opened(player, here)
    player.mouse(pygame.MOUSEMOTION, (5, 5), rel=(0, 0), buttons=(0, 0, 0))
    assert {"the step of the lesson before", "the next step of the lesson"} <= {
        one.name for one in bar(player.state)
    }


@pytest.mark.parametrize("action", ["build", "pencil", "poses", "layers", "edit", "list", "shelf", "play"])
def test_it_goes_on_from_wherever_one_is(player: Player, here: Path, action: str) -> None:
    opened(player, here)
    value = "follow scene=press" if action == "play" else None
    player.window.state = carried(player.state, Action(action, value))
    player.tick()
    if action in ("list", "shelf"):
        player.press(pygame.K_ESCAPE)
    player.press(pygame.K_PAGEDOWN)
    state = player.state
    assert (state.scene.name, state.lesson, state.game, state.sketch) == ("press", (3, 3), None, None)
    assert state.mode in ("play", "paused")


def test_what_is_no_step_is_refused_in_a_sentence(player: Player, here: Path) -> None:
    for action, value in (("play", "title"), ("pencil", None), ("build", None)):
        player.window.state = carried(player.state, Action(action, value))
        keep(player)
        assert player.state.toast
        assert "step" in player.state.toast.text
        player.press(pygame.K_ESCAPE)
    assert not (here / "lesson.toml").exists()
    player.press(pygame.K_PAGEDOWN)
    player.tick()
    assert player.state.toast
    assert "F8" in player.state.toast.text


def test_a_file_keeps_what_stands_in_it_and_no_foreign_one_is_written_over(
    player: Player, here: Path
) -> None:
    (here / "lesson.toml").write_text("# not mine\n")
    keep(player)
    assert (here / "lesson.toml").read_text() == "# not mine\n"
    assert len(read(here / "lesson-2.toml")) == 1
    opened(player, here, f"# by hand\n{PLAIN}")
    keep(player, "second")
    text = (here / "mine.toml").read_text()
    assert text.startswith(f"# by hand\n{PLAIN}")
    assert read(here / "mine.toml")[1].scene.look_at == "second"
    (here / "mine.toml").write_text("# changed\n" + text)
    keep(player)
    assert player.state.toast
    assert "changed meanwhile" in player.state.toast.text
    assert (here / "mine.toml").read_text() == "# changed\n" + text


def test_a_step_is_kept_whatever_became_of_the_scenes_of_earlier_ones(player: Player, here: Path) -> None:
    """What was read once is not read again: keeping the hundredth step takes no longer than the first."""
    (here / "own.toml").write_bytes(content(load("whitworth"), here))
    opened(player, here, '[[step]]\nscene = "own.toml"\n')
    (here / "own.toml").unlink()
    keep(player, "second")
    assert (here / "mine.toml").read_text().count("[[step]]") == 2
    player.press(pygame.K_PAGEUP)
    assert player.state.lesson == (1, 2)


def test_a_lesson_that_is_dropped_on_the_window_is_shown(player: Player, here: Path) -> None:
    (here / "other.toml").write_text(2 * PLAIN)
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(here / "other.toml")))
    player.tick()
    assert player.state.lesson == (1, 2)


def test_a_lesson_is_opened_from_the_shelf_and_is_no_scene(player: Player, here: Path) -> None:
    (here / "mine.toml").write_text(2 * PLAIN)
    player.press(pygame.K_o, CTRL)
    player.type("mine")
    player.press(pygame.K_RETURN)
    player.tick()
    assert player.state.lesson == (1, 2)
    with pytest.raises(BadInput, match="is a lesson, not a scene"):
        load("mine.toml")


def test_a_tape_holds_the_steps_that_were_shown(player: Player, here: Path) -> None:
    text = f'{PLAIN}[[step]]\nscene = "whitworth"\nspeed = "7 rpm"\npose = "60 deg"\ncaption = "slow"\n'
    opened(player, here, text)
    taping = Taping(player.state, (640, 360))
    for key in (pygame.K_LEFT, pygame.K_RIGHT):
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=key, mod=0, unicode=""))
        done: list[Action] = []
        monkey = player.window._requested

        def noted(events: list[pygame.event.Event]) -> Iterator[Action]:
            for action in monkey(events):  # noqa: B023 -- used at once
                done.append(action)  # noqa: B023
                yield action

        player.window._requested = noted  # type: ignore[method-assign]
        player.tick()
        player.window._requested = monkey  # type: ignore[method-assign]
        taping.note(player.state.frame, tuple(done))
    stored = json.loads(json.dumps(to_document(taping.tape(player.state.frame + 1))))
    tape = from_document(stored, "lesson.tape.json")
    *_, last = tape.states()
    assert (last.scene.name, last.scene.look_at) == ("whitworth", "slow")
    assert last.clock.speed == pytest.approx(7 * math.pi / 30)
    assert last.look.caption


BAD = {
    "no steps": ("step = []\n", "0 steps"),
    "a word of its own": (f'{PLAIN}pase = "60 deg"\n', "did you mean"),
    "no scene": ('[[step]]\npose = "60 deg"\n', '"scene" is missing'),
    "an unknown scene": ('[[step]]\nscene = "pres"\n', "no scene is called"),
    "a pose beyond": ('[[step]]\nscene = "double-rocker"\npose = "0 deg"\n', "does not come there"),
    "a pose without unit": (f'{PLAIN}pose = "60"\n', "unit"),
    "a speed": (f'{PLAIN}speed = "fast"\n', "drive.speed"),
    "a quantity": (f'{PLAIN}shown = {{ chart = "x.angle" }}\n', "has no quantity"),
    "a look": (f"{PLAIN}shown = {{ nams = 1 }}\n", "did you mean"),
    "a construction": (f'{PLAIN}shown = {{ construction = "synthesis" }}\n', "does not have it"),
    "seconds": (f"{PLAIN}seconds = 0\n", "seconds"),
    "a key beside the steps": (f"steps = 1\n{PLAIN}", "a title and steps"),
}


@pytest.mark.parametrize("case", BAD)
def test_what_is_wrong_in_a_file_is_one_sentence(case: str, here: Path) -> None:
    text, words = BAD[case]
    (here / "bad.toml").write_text(text)
    with pytest.raises(BadInput) as caught:
        read(here / "bad.toml")
    assert str(caught.value).startswith("bad.toml: ") or str(here) in str(caught.value)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_it_is_recorded_as_one_file_and_as_one_a_step(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    first = f"{PLAIN}seconds = 0.2\n"
    second = '[[step]]\nscene = "whitworth"\npose = "60 deg"\nseconds = 0.2\ncaption = "a"\n'
    text = first + second
    (here / "mine.toml").write_text(text)
    small = ["--size", "160x90", "--fps", "10"]
    assert main(["record", "mine.toml", "-o", "all.gif", *small]) == 0
    assert main(["record", "mine.toml", "-o", "one.gif", "--each", *small]) == 0
    assert capsys.readouterr().out.split() == ["all.gif", "one-1.gif", "one-2.gif"]
    assert main(["record", "mine.toml", "-o", "all.gif", "--names"]) == 2
    assert "a lesson keeps its own" in capsys.readouterr().err
    assert main(["record", "press", "-o", "press.gif", "--each"]) == 2
    assert main(["record", "mine.toml", "-o", "all.pptx", *small]) == 0
    with ZipFile("all.pptx") as deck:
        assert (
            sum(re.fullmatch(r"ppt/slides/slide\d+\.xml", name) is not None for name in deck.namelist()) == 2
        )


def test_the_text_of_a_step_reads_back() -> None:
    step = LessonStep(load("press"), 1.25, running=False)
    state = carried(begin(load("crank-rocker")), Action("stage", step.text(2, 5)))
    assert (state.scene.name, state.phase, state.clock.paused, state.lesson) == ("press", 1.25, True, (2, 5))
    for broken in (
        "",
        "{}",
        "[1]",
        '{"step": [1, 1]}',
        step.text(2, 5).replace('"name": "press"', '"name": "../press"'),
    ):
        after = carried(state, Action("stage", broken))
        assert after.toast
        assert after.scene is state.scene
