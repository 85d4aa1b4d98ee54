"""One field that finds anything by any of its words, and does it: by keys, by mouse, in every mode."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import pygame
import pytest
from playing import CTRL, NoSearch, Player

from linkanim.play.games import game_of
from linkanim.player import background
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.finding import Finder
from linkanim.player.state import State, begin
from linkanim.scenes import load, names
from linkanim.scenes.editing import dimensions
from linkanim.ui import screen


@pytest.fixture
def player(here: object, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    del here
    monkeypatch.setattr(background, "Following", NoSearch)
    with screen.opened((640, 360)):
        player = Player(replace(begin(load("press")), games=game_of))
        player.press(pygame.K_SPACE)
        yield player
        player.window.close()


def find(player: Player, words: str) -> None:
    """Open the field, type words, and take the first row."""
    player.press(pygame.K_k, CTRL)
    player.type(words)
    player.press(pygame.K_RETURN)


def at_row(state: State, label: str) -> bool:
    row = dimensions(state.scene)[state.editing.chosen]
    return state.edits_dimensions and row.label == label


# Words as a lecturer or a student types them, and what has happened after Enter.
DONE: dict[str, Callable[[State], object]] = {
    "dark": lambda state: state.look.theme == "dark",
    "slower": lambda state: state.clock.level < 0,
    "ram": lambda state: "slider" in (state.toast.text if state.toast else ""),
    "chart ram": lambda state: state.look.chart == "5.travel_velocity",
    "omega4": lambda state: state.look.chart == "4.angular_velocity",
    "torque chart": lambda state: state.look.chart == "input.torque",
    "peak torque": lambda state: state.toast and "N m" in state.toast.text,
    "crank-rocker": lambda state: state.scene.name == "crank-rocker",
    "whitworth": lambda state: state.scene.name == "whitworth",
    "crank 2": lambda state: at_row(state, "Crank 2"),
    "free length": lambda state: at_row(state, "Return spring, free length"),
    "closure": lambda state: state.scene.linkage != load("press").linkage,
    "transmission angle": lambda state: state.phase == pytest.approx(0.92483, abs=1e-4),
    "dead centre 1": lambda state: state.phase == pytest.approx(5.52726, abs=1e-4),
    "help": lambda state: state.help,
    "instant": lambda state: state.look.centres or state.constructed,
    "joint b": lambda state: state.top and state.top.title == "Joint B",
}


@pytest.mark.parametrize("words", DONE)
@pytest.mark.thinned(3)
def test_what_is_found_is_done(player: Player, words: str) -> None:
    find(player, words)
    assert DONE[words](player.state)
    assert player.state.of(Finder) is None


@pytest.mark.parametrize("opening", ["ctrl+k", "/", "all commands"])
def test_it_opens_by_two_keys_and_from_all_commands(player: Player, opening: str) -> None:
    if opening == "ctrl+k":
        player.press(pygame.K_k, CTRL)
    elif opening == "/":
        player.type("/")
    else:
        player.mouse(pygame.MOUSEBUTTONDOWN, (600, 20), button=3)
        player.type("find")
        player.press(pygame.K_RETURN)
    assert player.state.mode == "find"
    player.type("/")  # is typed
    assert player.state.of(Finder)
    player.press(pygame.K_ESCAPE)
    assert player.state.mode == "paused"


def test_every_row_can_be_clicked_and_the_wheel_scrolls(player: Player) -> None:
    player.press(pygame.K_k, CTRL)
    player.type("whitworth")
    shown = player.window.screen
    rows = {shown.row_at(60, y): float(y) for y in range(4, 350, 3)}
    player.mouse(pygame.MOUSEBUTTONDOWN, (60, rows[0]), button=1)
    assert player.state.scene.name == "whitworth"
    player.mouse(pygame.MOUSEBUTTONUP, (60, rows[0]), button=1)
    player.press(pygame.K_k, CTRL)
    pygame.event.post(pygame.event.Event(pygame.MOUSEWHEEL, x=0, y=-3))
    player.tick()
    found = player.state.of(Finder)
    assert found
    assert (found.chosen, player.state.look.zoom) == (3, 1.0)


@pytest.mark.parametrize(
    "action", ["edit", "build", "build_on", "pencil", "poses", "layers", "list", "shelf", "menu"]
)
def test_a_mechanism_is_found_from_every_mode(player: Player, action: str) -> None:
    player.window.state = carried(player.state, Action(action))
    player.tick()
    find(player, "knuckle-press")
    assert player.state.scene.name == "knuckle-press"


def test_over_a_game_it_finds_what_the_game_has(player: Player) -> None:
    player.window.state = carried(player.state, Action("play", "follow scene=press"))
    player.tick()
    player.press(pygame.K_k, CTRL)
    found = player.state.of(Finder)
    assert found
    assert found.others
    words = [row.words for row in found.others.entries]
    assert words[:3] == ["wide, slow", "narrower, faster", "narrow, fast"]
    assert not {"Whitworth's quick return", "edit Crank 2"} & {*words}
    player.type("full screen")
    player.press(pygame.K_RETURN)
    assert screen.is_full()


@pytest.mark.parametrize("name", ["press", "crank-rocker", "scotch-yoke", "driven-piston", "jansen"])
def test_everything_that_a_scene_has_can_be_found(name: str) -> None:
    state = carried(begin(load(name)), Action("find"))
    found = state.of(Finder)
    assert found
    assert found.others
    actions = {row.action for row in found.others.entries}
    assert {Action("put", n) for n in range(len(names()))} <= actions
    assert {Action("plot", token) for token in state.scene.valued} <= actions
    assert {Action("edit_row", n) for n in range(len(dimensions(state.scene)))} <= actions


def test_nothing_found_is_said_and_enter_does_nothing(player: Player) -> None:
    before = player.state.scene
    find(player, "qqq")
    assert player.state.scene is before
