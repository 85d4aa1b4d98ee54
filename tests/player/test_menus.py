"""Lists of commands: all of a mode, groups, those of a joint, a link, the chart; by keys and by mouse."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import pygame
import pytest
from playing import NoSearch, Player, menu_in, the

from linkanim.play.games import game_of
from linkanim.player import background
from linkanim.player.action import Action
from linkanim.player.actions import advance, carried, is_known
from linkanim.player.commands import ListRow, menu_of
from linkanim.player.keys import GROUPS
from linkanim.player.listing import Listing
from linkanim.player.modes import KEYS_OF
from linkanim.player.state import State, begin
from linkanim.scenes import load, names
from linkanim.ui import screen
from linkanim.ui.window import MEANINGS
from linkanim.words import LANGUAGES, spoken


def after(state: State, *actions: Action | str) -> State:
    for one in actions:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return state


# How each mode is entered, with the picture standing still but in the first.
ENTERED: dict[str, Action | None] = {
    "play": Action("pause"),
    "paused": None,
    "edit": Action("edit"),
    "list": Action("list"),
    "pencil": Action("pencil"),
    "build": Action("build"),
    "layers": Action("layers"),
    "game": Action("play", "title"),
}


@pytest.fixture
def player(here: object) -> Iterator[Player]:
    del here
    with screen.opened((640, 360)):
        player = Player(replace(begin(load("crank-rocker")), games=game_of))
        player.tick(20)
        player.press(pygame.K_SPACE)
        yield player
        player.window.close()


def enter(player: Player, mode: str) -> None:
    """Enter a mode without what is started outside for it."""
    action = ENTERED[mode]
    player.window.state = carried(player.state, action) if action else player.state
    player.tick()
    assert player.state.mode == mode


def expected(mode: str) -> list[tuple[str, str, Action]]:
    """Return the commands that the list of a mode has."""
    return [one for one in KEYS_OF[mode].commands if one[-1].name != "menu"]


CONSTRUCTED = [
    ("construction of its dead centres", "F7", Action("construction", "dead-centres")),
    ("construction of its instant centres", "", Action("construction", "centres")),
]
"""The constructions of the crank-rocker, which follow all commands."""


def open_rows(state: State) -> list[ListRow]:
    assert state.of(Listing)
    return [*menu_in(state).matches]


@pytest.mark.thinned(3)
@pytest.mark.parametrize("mode", [mode for mode in ENTERED if mode != "game"])
def test_every_command_of_every_mode_is_listed_by_f10_and_by_a_right_click(player: Player, mode: str) -> None:
    enter(player, mode)
    listed = KEYS_OF["paused"].commands if mode == "list" else []
    wanted = [one for one in listed if one[-1].name != "menu"] or expected(mode)
    if mode in ("play", "paused", "list", "edit"):
        wanted = [*wanted, *CONSTRUCTED]
    wanted += [(name, "", Action("language", one)) for one, name in LANGUAGES.items() if one != spoken()]
    for opening in ("key", "mouse"):
        if opening == "key":
            player.press(pygame.K_F10)
        else:
            player.mouse(pygame.MOUSEBUTTONDOWN, (630, 10), button=3)
            player.mouse(pygame.MOUSEBUTTONUP, (630, 10), button=3)
        assert [(one.words, one.key, one.action) for one in open_rows(player.state)] == wanted
        player.press(pygame.K_ESCAPE)
        assert player.state.mode == ("paused" if mode == "list" else mode)


@pytest.mark.parametrize("mode", [*ENTERED, "shelf", "name"])
def test_every_command_of_a_list_is_one_that_the_window_knows(mode: str) -> None:
    for words, _, action in KEYS_OF[mode].commands:
        assert words
        assert is_known(action) or action.name in MEANINGS, action


def test_a_command_of_the_list_is_done_in_the_mode_that_was_on(player: Player) -> None:
    player.type("e")
    player.press(pygame.K_F10)
    player.type("light / dark")
    player.press(pygame.K_RETURN)
    assert (player.state.mode, player.state.look.theme) == ("edit", "dark")


def test_over_a_game_the_list_is_the_windows_and_what_is_chosen_the_games(player: Player) -> None:
    player.press(pygame.K_F3)
    player.press(pygame.K_F10)
    player.press(pygame.K_DOWN)
    player.press(pygame.K_UP)
    assert player.state.mode == "list"
    player.type("light / dark")
    player.press(pygame.K_RETURN)
    assert (player.state.mode, player.state.look.theme) == ("game", "dark")
    assert player.state.game is not None


GAMES = {
    "title": ["Run", "Build", "Draw a path", "Play"],
    "lobby": ["Predict", "Match", "Follow"],
    "menu": ["All mechanisms", "Four-bars", "Sliders"],
    "predict level=2 chapter=press seed=2": ["it slows down", "it speeds up", "out of it"],
    "follow scene=press": ["wide, slow", "narrower, faster", "narrow, fast"],
}


@pytest.mark.parametrize("words", GAMES)
def test_over_a_game_the_list_begins_with_what_the_game_has_now(player: Player, words: str) -> None:
    player.window.state = after(replace(player.state, games=game_of), Action("play", words))
    player.tick()
    player.mouse(pygame.MOUSEBUTTONDOWN, (310, 10), button=3)
    found = [one.words for one in open_rows(player.state)]
    assert found[: len(GAMES[words])] == GAMES[words]
    assert not any("answer or door" in one for one in found)
    player.press(pygame.K_RETURN)
    assert player.state.of(Listing) is None


@pytest.mark.parametrize("group", GROUPS)
def test_a_group_has_its_commands(group: str) -> None:
    found = menu_of(begin(load("press")), group)
    assert found
    assert {row.action for row in found.entries} == {*GROUPS[group][1]}


# What a joint, a link, a spring or a damper of a scene has, by its words.
THINGS: dict[str, tuple[str, str, str, Callable[[State], bool]]] = {
    "a joint": ("crank-rocker", "joint A", "chart its speed", lambda state: state.look.chart == "A.velocity"),
    "a trace": ("crank-rocker", "joint B", "trace it", lambda state: state.scene.trace == ("P", "B")),
    "a trace less": ("crank-rocker", "joint P", "stop tracing it", lambda state: state.scene.trace == ()),
    "the drive": (
        *("crank-rocker", "joint B", "make it the drive"),
        lambda state: state.scene.linkage.drive.joint == "B",
    ),
    "its length": ("crank-rocker", "joint A", "edit its length", lambda state: state.edits_dimensions),
    "a link": (
        *("crank-rocker", "link coupler", "chart its angular velocity"),
        lambda state: state.look.chart == "coupler.angular_velocity",
    ),
    "a spring": (
        "press",
        "strut return",
        "chart its force",
        lambda state: state.look.chart == "return.force",
    ),
}


@pytest.mark.parametrize("case", THINGS)
def test_a_joint_a_link_and_a_spring_have_commands_of_their_own(case: str) -> None:
    name, thing, words, done = THINGS[case]
    state = after(begin(load(name)), Action("menu", thing))
    row = next(row for row in open_rows(state) if row.words == words)
    found = after(state, "back", row.action)
    assert done(found)
    assert found.toast is None


def test_what_a_joint_is_made_is_undone(here: object) -> None:
    del here
    begun = begin(load("crank-rocker"))
    for action in (Action("trace_joint", "B"), Action("drive_joint", "B")):
        changed = after(begun, action)
        assert changed.scene != begun.scene
        assert after(changed, "undo").scene == begun.scene


def test_all_joints_and_links_are_listed_for_the_keys(player: Player) -> None:
    player.press(pygame.K_F10, pygame.KMOD_LSHIFT)
    words = [row.words for row in open_rows(player.state)]
    scene = player.state.scene
    assert words == [f"joint {one.name}" for one in scene.linkage.joints] + [
        f"link {one.name}" for one in scene.linkage.bodies
    ]
    player.type("joint a")
    player.press(pygame.K_RETURN)
    assert "chart its speed" in [row.words for row in open_rows(player.state)]


@pytest.mark.thinned(4)
@pytest.mark.slow
@pytest.mark.parametrize("name", names())
def test_no_menu_of_a_scene_offers_what_cannot_be_done(name: str) -> None:
    begun = begin(load(name))
    things = menu_of(begun, "things")
    assert things
    for thing in things.entries:
        menu = menu_of(begun, thing.words)
        assert menu
        for row in menu.entries:
            assert after(begun, row.action).toast is None, (thing.words, row.words)


def test_shift_c_puts_the_chart_away(player: Player) -> None:
    player.type("c")
    assert player.state.look.chart
    player.press(pygame.K_c, pygame.KMOD_LSHIFT, "C")
    assert player.state.look.chart is None


def place(player: Player, joint: str) -> tuple[float, float]:
    pose = player.state.displayed.pose(player.state.phase, 0)
    return player.window.screen.pixel(*pose.position[joint])


def opened(player: Player) -> str:
    assert player.state.of(Listing)
    return menu_in(player.state).title


def test_a_right_click_on_a_joint_a_link_and_the_chart_lists_what_these_have(player: Player) -> None:
    player.window.state = carried(player.state, Action("plot", "rocker.angle"))
    player.tick()
    player.settle()
    a, b = place(player, "A"), place(player, "O2")
    chart = player.window.screen.last.layout.chart
    assert chart
    spots = {
        "Joint A": a,
        "Link crank": ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2),
        "Chart": (chart.middle.real, chart.middle.imag),
    }
    for title, at in spots.items():
        player.mouse(pygame.MOUSEBUTTONDOWN, at, button=3)
        assert opened(player) == title
        player.mouse(pygame.MOUSEBUTTONDOWN, at, button=3)
        assert player.state.of(Listing) is None


@pytest.mark.parametrize("by", ["mouse", "finger"])
def test_a_long_press_does_what_a_right_click_does(player: Player, by: str) -> None:
    at = place(player, "A")
    share: dict[str, Any] = {
        "x": at[0] / 640,
        "y": at[1] / 360,
        "finger_id": 3,
        "touch_id": 1,
        "dx": 0,
        "dy": 0,
    }
    if by == "mouse":
        player.mouse(pygame.MOUSEBUTTONDOWN, at, button=1)
    else:
        pygame.event.post(pygame.event.Event(pygame.FINGERDOWN, **share))
        player.tick()
    for _ in range(34):
        player.tick()
    chips = [player.state.chip]
    for _ in range(4):
        player.tick()
    chips.append(player.state.chip)
    assert [chip and chip.text for chip in chips] == [None, "let go: commands"]
    assert player.state.of(Listing) is None
    if by == "mouse":
        player.mouse(pygame.MOUSEBUTTONUP, at, button=1)
    else:
        pygame.event.post(pygame.event.Event(pygame.FINGERUP, **share))
        player.tick()
    assert opened(player) == "Joint A"
    assert (player.state.held, player.state.grasp) == (None, None)


@pytest.mark.parametrize("waits", [0, 60], ids=["at once", "after a while"])
def test_a_hand_that_moves_is_no_long_press(player: Player, waits: int) -> None:
    x, y = place(player, "A")
    before = player.state.phase
    player.mouse(pygame.MOUSEBUTTONDOWN, (x, y), button=1)
    for _ in range(waits):
        player.tick()
    player.mouse(pygame.MOUSEMOTION, (x + 20, y), rel=(0, 0), buttons=(1, 0, 0))
    assert player.state.phase != before
    for _ in range(60):
        player.tick()
    player.mouse(pygame.MOUSEBUTTONUP, (x + 20, y), button=1)
    assert player.state.of(Listing) is None


def test_a_joint_that_is_held_on_and_on_is_only_held(player: Player) -> None:
    at = place(player, "A")
    player.mouse(pygame.MOUSEBUTTONDOWN, at, button=1)
    for _ in range(160):
        player.tick()
    player.mouse(pygame.MOUSEBUTTONUP, at, button=1)
    assert player.state.of(Listing) is None


def test_a_pose_that_is_set_down_slowly_is_a_pose(player: Player, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "Following", NoSearch)
    player.window.state = carried(player.state, Action("poses"))
    player.tick(2)
    for x in (300, 420):
        player.mouse(pygame.MOUSEBUTTONDOWN, (x, 180), button=1)
        for _ in range(60):
            player.tick()
        assert player.state.chip is None or player.state.chip.text != "let go: commands"
        if x == 420:
            player.mouse(pygame.MOUSEMOTION, (x + 60, 160), rel=(0, 0), buttons=(1, 0, 0))
        player.mouse(pygame.MOUSEBUTTONUP, (x, 180), button=1)
        assert player.state.of(Listing) is None
    assert player.state.posing
    assert len(player.state.posing.poses) == 2
    player.mouse(pygame.MOUSEBUTTONDOWN, (300, 180), button=1)
    for _ in range(60):
        player.tick()
    player.mouse(pygame.MOUSEBUTTONUP, (300, 180), button=1)
    assert player.state.of(Listing)
    assert len(player.state.posing.poses) == 2


def test_a_right_click_on_the_sheet_chooses_what_is_there_and_lists_what_is_done_with_it(
    player: Player,
) -> None:
    player.window.state = carried(player.state, Action("build_on"))
    player.settle()
    at = place(player, "A")
    player.mouse(pygame.MOUSEBUTTONDOWN, at, button=3)
    assert opened(player) == "Chosen"
    assert [row.words for row in open_rows(player.state)][2] == "remove what is chosen"
    assert player.state.building
    assert player.state.building.building.chosen == ("joints", "A")


def test_a_long_list_has_a_scroll_bar_that_is_dragged(player: Player) -> None:
    player.press(pygame.K_F10)
    count, window = len(open_rows(player.state)), player.window.screen
    strip = [(x, y) for x in range(639) for y in (180,) if window.scrolled_to(x, y, held=False) is not None]
    x, y = strip[len(strip) // 2]
    player.mouse(pygame.MOUSEBUTTONDOWN, (x, y), button=1)
    assert player.state.of(Listing)
    assert 0.3 * count < the(player.state, Listing).chosen < 0.7 * count
    for to, row in ((359, count - 1), (0, 0)):
        player.mouse(pygame.MOUSEMOTION, (x - 60, to), rel=(0, 0), buttons=(1, 0, 0))
        assert player.state.of(Listing)
        assert the(player.state, Listing).chosen == row
    player.mouse(pygame.MOUSEBUTTONUP, (x, 5), button=1)
    player.mouse(pygame.MOUSEMOTION, (x, 300), rel=(0, 0), buttons=(0, 0, 0))
    assert player.state.of(Listing)
    assert the(player.state, Listing).chosen == 0


def test_a_short_list_has_none(player: Player) -> None:
    player.window.state = carried(player.state, Action("menu", "arrows"))
    player.tick()
    window = player.window.screen
    assert all(
        window.scrolled_to(x, y, held=False) is None for x in range(0, 640, 4) for y in range(0, 360, 20)
    )


@pytest.mark.parametrize("mode", KEYS_OF)
def test_no_two_commands_of_a_mode_have_one_name(mode: str) -> None:
    names_ = [words for words, _, _ in KEYS_OF[mode].commands]
    assert sorted({*names_}) == sorted(names_)


def test_the_button_that_leaves_the_sheet_says_so() -> None:
    named = {action: words for words, _, action in KEYS_OF["build"].commands}
    assert named[Action("build")].startswith("done")
    assert Action("undo_sheet") in named
    assert Action("undo") not in named
