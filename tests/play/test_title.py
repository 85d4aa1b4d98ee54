"""The title: mechanisms one after the other, and doors that any key or click goes through."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pygame
import pytest
from playing import SIZE, Player

from linkanim.errors import BadInput
from linkanim.play.arcade import Arcade
from linkanim.play.games import GAMES, game_of
from linkanim.play.menus import EACH, Title
from linkanim.player.action import Action
from linkanim.player.actions import advance, carried
from linkanim.player.state import ATTRACT_AFTER, State, begin
from linkanim.player.tape import Tape, resumed, starting
from linkanim.player.tape_file import read, write
from linkanim.scenes import load, names
from linkanim.ui import screen


def titled() -> State:
    """A window's state with the title on."""
    state = replace(begin(load("press")), games=game_of)
    return carried(state, Action("play", "title door=build place=0"))


@pytest.fixture
def player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    monkeypatch.chdir(tmp_path)
    with screen.opened(SIZE):
        player = Player(titled())
        yield player
        player.window.close()


def test_mechanisms_run_behind_it_one_after_the_other() -> None:
    state = titled()
    for n in range(3):
        assert (state.scene.name, state.clock.paused) == (names()[n], False)
        state = left_alone(state, EACH - 1)
        assert state.scene.name == names()[n]
        state = left_alone(state, 1)


# The last door is "build"; any other is chosen first, or by its number.
WAYS_IN = {
    "any letter": (((pygame.K_y, 0, "y"),), "build"),
    "Enter": (((pygame.K_RETURN,),), "build"),
    "Space": (((pygame.K_SPACE, 0, " "),), "build"),
    "a number": (((pygame.K_1, 0, "1"),), "play"),
    "up, then in": (((pygame.K_UP,), (pygame.K_RETURN,)), "play"),
    "O": (((pygame.K_o, 0, "o"),), "shelf"),
}


@pytest.mark.parametrize(("keys", "mode"), WAYS_IN.values(), ids=WAYS_IN)
def test_a_key_goes_in(player: Player, keys: tuple[tuple[Any, ...], ...], mode: str) -> None:
    for key in keys:
        assert player.state.game
        player.press(*key)
    assert player.state.mode == mode
    assert player.state.scene.name == "press"


def test_a_click_on_a_door_goes_in_and_the_mouse_lights_it(player: Player) -> None:
    before = player.pixels
    door = next((x, y) for y in range(SIZE[1]) for x in [40] if player.window.screen.option_at(x, y) == 0)
    player.mouse(pygame.MOUSEMOTION, door, rel=(0, 0), buttons=(0, 0, 0))
    player.tick()
    assert player.pixels != before
    player.mouse(pygame.MOUSEBUTTONDOWN, door, button=1)
    assert player.state.mode == "play"


FRESH = {"Space": (pygame.K_SPACE, " "), "a letter": (pygame.K_y, "y"), "Enter": (pygame.K_RETURN, "\r")}


@pytest.mark.parametrize("after", [0, 2 * EACH], ids=["at once", "when others have run"])
@pytest.mark.parametrize(("key", "text"), FRESH.values(), ids=FRESH)
def test_in_a_fresh_window_any_key_runs_the_press(key: int, text: str, after: int, tmp_path: Path) -> None:
    keeper = Arcade(tmp_path / "scores.json")
    with screen.opened(SIZE):
        state = replace(begin(), games=keeper.game_of, from_title=True)
        player = Player(carried(state, Action("play", keeper.completed("title"))), keeper=keeper)
        assert player.state.scene.name == "press"
        player.window.state = left_alone(player.state, after)
        player.press(key, 0, text)
        assert (player.state.mode, player.state.scene.name, player.state.game) == ("play", "press", None)
        before = player.state.phase
        player.tick(9)
        assert player.state.phase != before
        player.window.close()


def test_run_leads_back_to_what_stood_and_it_runs() -> None:
    state = carried(replace(begin(load("engine")), games=game_of), Action("pause"))
    state = carried(carried(state, Action("play", "title door=play")), Action("option", 0))
    assert (state.scene.name, state.mode) == ("engine", "play")


def test_run_leaves_a_sheet_and_keeps_it() -> None:
    state = carried(replace(begin(load("engine")), games=game_of), Action("build_on"))
    state = carried(carried(state, Action("play", "title")), Action("option", 0))
    assert (state.mode, state.building) == ("play", None)
    assert state.sheet


def test_esc_stays_and_the_theme_goes_along(player: Player) -> None:
    player.press(pygame.K_ESCAPE)
    assert player.state.game
    player.press(pygame.K_l, 0, "l")
    player.press(pygame.K_1)
    assert player.state.look.theme == "dark"
    assert player.state.look.hud


def left_alone(state: State, frames: int) -> State:
    """Let so many frames go by: at once, but for the last ones."""
    last = min(frames, 3)
    state = replace(state, frame=state.frame + frames - last)
    for _ in range(last):
        state = advance(state)
    return state


# In a kiosk: what a visitor has left, and whether the title comes back.
LEFT = {
    "a mechanism": ((), True),
    "the shelf": ((Action("shelf"),), False),
    "an edit": ((Action("edit"), Action("nudge", 1)), False),
    "a question": ((Action("play", "predict seed=1"),), False),
    "a recording": ((Action("record", "gif"),), False),
}


@pytest.mark.parametrize(("actions", "back"), LEFT.values(), ids=LEFT)
def test_a_kiosk_goes_back_to_its_title(actions: tuple[Action, ...], back: bool) -> None:
    state = replace(begin(load("press")), games=game_of, kiosk=True)
    state = left_alone(advance(state, actions), ATTRACT_AFTER - 2)
    assert not isinstance(state.game, Title)
    state = left_alone(state, 3)
    assert isinstance(state.game, Title) == back


def test_esc_leaves_full_screen_but_in_a_kiosk(player: Player, monkeypatch: pytest.MonkeyPatch) -> None:
    filled: list[object] = []
    monkeypatch.setattr(screen, "is_full", lambda: True)
    monkeypatch.setattr(screen, "fill", filled.append)
    player.window.state = replace(player.state, kiosk=True)
    player.press(pygame.K_ESCAPE)
    assert not filled
    player.window.state = replace(player.state, kiosk=False)
    player.press(pygame.K_ESCAPE)
    assert len(filled) == 1


def test_what_is_the_window_s_stays_when_a_door_is_gone_through() -> None:
    state = replace(titled(), from_title=True, kiosk=True)
    after = advance(state, [Action("option", 0)])
    assert (after.mode, after.from_title, after.kiosk) == ("play", True, True)


def test_esc_and_f3_lead_back_to_it(player: Player) -> None:
    player.window.state = replace(begin(load("press")), games=game_of)
    player.press(pygame.K_ESCAPE)
    assert player.state.toast
    player.press(pygame.K_F3)
    assert type(player.state.game) is Title
    player.window.state = replace(begin(load("press")), games=game_of, from_title=True)
    assert carried(player.state, Action("back")).effects == (Action("begin", "title"),)


def test_a_recording_begun_on_it_begins_there(tmp_path: Path) -> None:
    state = left_alone(titled(), EACH + 1)
    actions = (*((0, one) for one in resumed(state)), (3, Action("option", 0)))
    tape = Tape(starting(state), 5, actions)
    write(tape, tmp_path / "title.tape.json")
    states = list(read(tmp_path / "title.tape.json", game_of).states())
    assert [type(one.game) for one in states] == [Title] * 3 + [type(None)] * 3
    assert states[0].scene.name == names()[1]
    assert states[-1].scene.name == "press"


@pytest.mark.parametrize("words", ["no-such", "title door", "title place=x", "title place=-1"])
def test_words_that_name_no_game_are_refused_in_a_line(words: str, tmp_path: Path) -> None:
    with pytest.raises(BadInput):
        game_of(words)
    write(Tape(starting(titled()), 1, ((0, Action("play", words)),)), tmp_path / "a.tape.json")
    with pytest.raises(BadInput, match="tape"):
        read(tmp_path / "a.tape.json", game_of)


def test_without_games_there_are_none() -> None:
    state = carried(begin(load("press")), Action("play", "title"))
    assert state.game is None
    assert state.toast


def test_every_game_is_where_the_table_has_it() -> None:
    assert all(game_of(kind).words.startswith(kind) for kind in GAMES)


def test_a_mouse_that_moves_before_the_first_picture_does_no_harm() -> None:
    with screen.opened((320, 180)):
        for kind, more in (
            (pygame.MOUSEMOTION, {"rel": (0, 0), "buttons": (0, 0, 0)}),
            (pygame.MOUSEWHEEL, {"y": 1}),
        ):
            pygame.event.post(pygame.event.Event(kind, pos=(9, 9), **more))
        assert Player(titled()).state.game


def test_the_door_to_building_leads_to_a_sheet_that_was_open_before() -> None:
    state = carried(replace(begin(load("press")), games=game_of), Action("build_on"))
    assert state.sheet
    assert state.building
    state = carried(carried(state, Action("play", "title door=build")), Action("next"))
    assert state.game is None
    assert state.sheet
    assert state.building


def test_the_door_draw_a_path_takes_the_pencil_by_click_and_by_w() -> None:
    for action in (Action("option", 2), Action("pencil")):
        state = carried(titled(), action)
        assert (state.mode, state.game) == ("pencil", None)
        assert "pencil" in [effect.name for effect in state.effects]


def test_o_on_the_title_leads_to_the_shelf_whichever_door_is_chosen() -> None:
    state = carried(carried(titled(), Action("raise", -1)), Action("shelf"))
    assert state.mode == "shelf"


def test_the_mechanism_on_the_title_is_grabbed_and_stays_while_it_is_held() -> None:
    with screen.opened((640, 360)):
        player = Player(titled())
        player.tick(5)
        scene, joint = player.state.scene, player.state.scene.linkage.drive.joint
        x, y = player.window.screen.pixel(*player.state.displayed.pose(player.state.phase, 0).position[joint])
        before = player.state.phase
        player.mouse(pygame.MOUSEBUTTONDOWN, (x, y), button=1)
        player.mouse(pygame.MOUSEMOTION, (x + 30, y + 30), rel=(0, 0), buttons=(1, 0, 0))
        assert player.state.grasp
        assert player.state.phase != before
        player.tick(700)
        assert player.state.scene is scene
        player.mouse(pygame.MOUSEBUTTONUP, (x + 30, y + 30), button=1)
        after = player.state
        assert isinstance(after.game, Title)
        assert (after.grasp, after.clock.paused) == (None, False)
