"""The bar of commands: when it shows, what its buttons ask for, how they stand, where there is room."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pygame
import pytest
from playing import SIZE, Player, bar_cells_in, menu_in, the

from linkanim.picture.board import Board
from linkanim.picture.layout import Docked, Layout, layout, with_side
from linkanim.picture.text import letters
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.play.games import game_of
from linkanim.player import record_dialog
from linkanim.player.action import Action
from linkanim.player.actions import advance, is_taped
from linkanim.player.commands import Button, bar, bar_eighths, pressed, slid, slides
from linkanim.player.keys import GROUPS
from linkanim.player.lesson import LessonStep
from linkanim.player.listing import Listing
from linkanim.player.modes import KEYS_OF
from linkanim.player.naming import Naming
from linkanim.player.record_dialog import RecordDialog
from linkanim.player.shelving import OpenShelf
from linkanim.player.state import MOUSE_FRAMES, State, begin
from linkanim.scenes import load
from linkanim.scenes.editing import dimensions
from linkanim.ui import screen
from linkanim.ui.command_bar import CommandBar, bar_cells
from linkanim.ui.command_icons import COMMAND_ICONS
from linkanim.ui.pictures import Framing


def after(state: State, *actions: Action | str) -> State:
    for one in actions:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return state


@pytest.fixture
def rocker() -> State:
    return after(begin(load("crank-rocker")), "mouse_moved")


# How each mode of the window is entered.
ENTERED: dict[str, tuple[Action | str, ...]] = {
    "play": (),
    "paused": ("pause",),
    "edit": ("edit",),
    "list": ("list",),
    "ruler": ("ruler",),
    "find": ("find",),
    "lesson": (Action("stage", LessonStep(load("crank-rocker")).text(1, 2)),),
    "shelf": ("shelf",),
    "pencil": ("pencil",),
    "poses": ("poses",),
    "build": ("build",),
    "numbers": ("build_on", "numbers"),
    "layers": ("layers",),
    "closures": ("closures",),
    "tolerance": ("tolerance",),
    "game": (Action("play", "title"),),
}
in_every_mode = pytest.mark.parametrize("mode", ENTERED)


def entered(mode: str) -> State:
    games = replace(begin(load("crank-rocker")), games=game_of)
    state = after(games, *ENTERED[mode], "mouse_moved")
    assert state.keys.name == mode
    return state


def test_the_bar_shows_for_three_seconds_after_the_mouse_has_moved(rocker: State) -> None:
    assert bar(begin(load("crank-rocker"))) == ()
    shown = []
    for _ in range(MOUSE_FRAMES + 5):
        assert bool(bar(rocker)) is (bar_eighths(rocker) > 0)
        shown.append(bar_eighths(rocker))
        rocker = advance(rocker)
    assert MOUSE_FRAMES == 180
    assert shown == sorted(shown, reverse=True)
    assert (shown[0], shown[150], shown[178], shown[180], shown[-1]) == (8, 8, 0, 0, 0)


def test_the_bar_is_on_no_screenshot_and_no_tape(player: Player) -> None:
    player.press(pygame.K_SPACE)
    player.mouse(pygame.MOUSEMOTION, (5, 5), rel=(0, 0), buttons=(0, 0, 0))
    assert bar(player.state)
    unmoved = replace(player.state, last_mouse_move=None)
    shots = [player.window.screen.picture(state) for state in (player.state, unmoved)]
    assert pygame.image.tobytes(shots[0], "RGB") == pygame.image.tobytes(shots[1], "RGB")
    assert not is_taped(Action("mouse_moved"))


def test_the_mouse_that_moves_is_no_key(rocker: State) -> None:
    """What is told to whoever does nothing goes on being told."""
    assert rocker.touched == 0


@in_every_mode
def test_every_button_is_a_command_of_the_table_of_its_mode(mode: str) -> None:
    state = entered(mode)
    found = bar(state)
    assert found
    known = {action for _, _, action in KEYS_OF[mode].commands}
    for number, button in enumerate(found):
        assert button.icon in COMMAND_ICONS or button.share is not None
        assert button.name
        (asked,) = pressed(state, number)
        assert asked in known or asked.value in GROUPS or asked == Action("note", button.lack), button
    names = [button.name for button in found]
    assert len({*names}) == len(names)
    assert "all commands" in names


def test_a_bar_is_told_for_every_mode_of_the_table() -> None:
    assert {*ENTERED, "name", "record", "caption", "ruler"} == {*KEYS_OF}


def rows(state: State) -> list[str]:
    """Return the words of the open list of commands."""
    assert state.of(Listing)
    return [one.words for one in menu_in(state).entries]


# What a button does to the state, by its name in the table.
DONE: dict[str, Callable[[State], object]] = {
    "play / pause": lambda state: state.clock.paused,
    "a step on": lambda state: state.clock.steps == 1,
    "coupler trace": lambda state: not state.look.trace,
    "the shelf": lambda state: state.of(OpenShelf) is not None,
    "the list of quantities": lambda state: state.of(Listing) is not None and not the(state, Listing).others,
    "edit dimensions": lambda state: state.edits_dimensions,
    "build a linkage": lambda state: state.building is not None,
    "draw a path to follow": lambda state: state.sketch is not None,
    "arrows": lambda state: rows(state) == ["velocities", "accelerations", "forces"],
    "all commands": lambda state: len(rows(state)) > 40,
    "the other closure": lambda state: state.scene.linkage != load("crank-rocker").linkage,
    "light / dark": lambda state: state.look.theme == "dark",
    "full screen": lambda state: Action("fullscreen") in state.effects or screen.is_full(),
    "help": lambda state: state.help,
}


@pytest.mark.parametrize("name", DONE)
def test_a_button_does_what_its_key_does(player: Player, name: str) -> None:
    with_room = (1280, 720)
    pygame.display.set_mode(with_room, pygame.RESIZABLE)
    player.press(pygame.K_SPACE)
    click(player, name)
    assert DONE[name](player.state)


def test_a_button_of_the_bar_shows_whether_it_is_on(rocker: State) -> None:
    def lit(state: State) -> set[str]:
        found = bar(after(state, "mouse_moved"))
        assert found
        return {button.icon for button in found if button.on}

    assert lit(rocker) == {"trace"}
    assert lit(after(rocker, "trace", "names", Action("vectors", "v"))) == {"names", "arrows"}
    assert lit(after(rocker, "edit")) == {"trace", "edit"}
    assert "pause" in {button.icon for button in bar(rocker)}
    paused = bar(after(rocker, "pause"))
    assert "play" in {button.icon for button in paused}


def test_what_cannot_be_done_is_greyed_and_says_why(player: Player) -> None:
    player.press(pygame.K_F2)
    pygame.display.set_mode((900, 500), pygame.RESIZABLE)
    click(player, "undo")
    assert player.state.toast
    assert player.state.toast.text == "there is nothing to undo"


def test_the_speed_is_dragged_on_its_slider_and_the_wheel_turns_it(player: Player) -> None:
    pygame.display.set_mode((900, 500), pygame.RESIZABLE)
    x, y, wide = button(player, "speed")
    left, right = (x - wide / 2 + 1, y), (x + wide / 2 - 1, y)
    player.mouse(pygame.MOUSEBUTTONDOWN, left, button=1)
    assert player.state.clock.level == -20
    player.mouse(pygame.MOUSEMOTION, right, rel=(0, 0), buttons=(1, 0, 0))
    assert player.state.clock.level == 10
    player.mouse(pygame.MOUSEMOTION, (x, 20), rel=(0, 0), buttons=(1, 0, 0))
    assert -20 < player.state.clock.level < 10
    player.mouse(pygame.MOUSEBUTTONUP, (x, 20), button=1)
    before = player.state.clock.level
    player.mouse(pygame.MOUSEMOTION, (x, y), rel=(0, 0), buttons=(0, 0, 0))
    pygame.event.post(pygame.event.Event(pygame.MOUSEWHEEL, x=0, y=-2, flipped=False))
    player.tick()
    assert player.state.clock.level == before - 2
    assert player.state.look.zoom == 1.0


def test_a_drag_of_the_speed_ends_where_the_mode_has_another_bar(player: Player) -> None:
    pygame.display.set_mode((900, 500), pygame.RESIZABLE)
    x, y, _ = button(player, "speed")
    player.mouse(pygame.MOUSEBUTTONDOWN, (x, y), button=1)
    level = player.state.clock.level
    player.window.state = advance(player.state, [Action("shelf")])
    player.tick()
    assert player.state.mode == "shelf"  # its bar has few buttons
    player.mouse(pygame.MOUSEMOTION, (x + 40, y), rel=(0, 0), buttons=(1, 0, 0))
    player.mouse(pygame.MOUSEBUTTONUP, (x + 40, y), button=1)
    assert player.state.clock.level == level


def test_a_slider_says_its_end_by_the_state_alone(rocker: State) -> None:
    number = next(n for n, one in enumerate(bar(rocker)) if one.share is not None)
    assert slides(rocker, number)
    assert slid(rocker, number, 1.0) == (Action("level", 10),)
    assert after(rocker, *slid(rocker, number, 0.0)).clock.level == -20


def test_a_click_where_the_bar_has_faded_only_brings_it_back(player: Player) -> None:
    pygame.display.set_mode((900, 500), pygame.RESIZABLE)
    x, y, _ = button(player, "names")
    player.settle()
    player.mouse(pygame.MOUSEBUTTONDOWN, (x, y), button=1)
    player.mouse(pygame.MOUSEBUTTONUP, (x, y), button=1)
    assert (player.state.look.names, player.state.last_mouse_move is not None) == (0, True)
    click(player, "names, then dimensions")
    assert player.state.look.names == 1


def test_a_finger_taps_the_bar_once_it_is_there(player: Player) -> None:
    pygame.display.set_mode((900, 500), pygame.RESIZABLE)
    x, y, _ = button(player, "names")
    player.settle()
    for names in (0, 1):
        for kind in (pygame.FINGERDOWN, pygame.FINGERUP):
            place: dict[str, Any] = {
                "x": x / 900,
                "y": y / 500,
                "finger_id": 3,
                "touch_id": 1,
                "dx": 0.0,
                "dy": 0.0,
            }
            pygame.event.post(pygame.event.Event(kind, **place))
            player.tick()
        assert player.state.look.names == names


SIZES = [(320, 180), (640, 360), (1280, 720), (1920, 1080), (3840, 2160), (400, 900), (90, 60), (2, 700)]


def at_foot(place: Layout, shown: tuple[Button, ...]) -> Rect:
    """Return where the bar at the foot is drawn."""
    _, targets = CommandBar().drawn(Board(place, letters(), LIGHT), (shown, None))
    return next(one.place for one in targets if one.kind == "bar")


@in_every_mode
@pytest.mark.parametrize("size", SIZES, ids=str)
def test_buttons_are_large_enough_for_a_finger_and_where_there_is_no_room_the_rest_is_left_out(
    mode: str, size: tuple[int, int]
) -> None:
    found = bar(entered(mode))
    assert found
    place, cells = layout(size), bar_cells(layout(size), found)
    frame = at_foot(place, found)
    seen = [(cell, button) for cell, button in zip(cells, found, strict=True) if cell]
    assert any(button.icon == "more" for _, button in seen)
    if min(size) >= 180:
        least = max(28, 34 * place.unit) if size[1] > 180 else 20
        assert all(cell.height >= least - 1e-9 for cell, _ in seen)
        assert frame.x >= 0
        assert frame.right <= size[0]
        assert frame.bottom <= size[1] + 1e-9
    if size[0] >= 1280:
        assert [button for _, button in seen] == [one for one in found if not one.on_chart]
    _, targets = CommandBar().drawn(Board(place, letters(), LIGHT), (found, None))
    drawn = {one.value: one.place for one in targets if one.kind == "button"}
    assert [(drawn[n], found[n]) for n in sorted(drawn)] == seen
    for (one, _), (other, _) in pairwise(seen):
        assert one.right < other.x


def test_the_chart_has_buttons_of_its_own_at_its_head(player: Player) -> None:
    pygame.display.set_mode((900, 500), pygame.RESIZABLE)
    player.press(pygame.K_c, 0, "c")
    player.settle()
    first = player.state.look.chart
    x, y, _ = button(player, "chart: the next quantity")
    chart = player.window.screen.last.layout.chart
    assert chart
    assert chart.inset(-20).holds(x, y)
    click(player, "chart: the next quantity")
    assert player.state.look.chart not in (None, first)
    click(player, "the chart's axis")
    assert player.state.look.over == "time"
    click(player, "chart: off")
    assert player.state.look.chart is None


@pytest.mark.parametrize("size", [(640, 360), (1280, 720), (3840, 2160)], ids=str)
@pytest.mark.parametrize("beside", [False, True])
def test_the_buttons_of_a_chart_leave_its_reading_and_its_title(
    rocker: State, size: tuple[int, int], beside: bool
) -> None:
    place = with_side(layout(size, docked=Docked(bar=True)), 2, 0, beside=beside)
    shown = bar(after(rocker, Action("chart", 1), "mouse_moved"))
    assert shown
    assert place.chart
    cells = bar_cells(place, shown)
    seen = [cell for cell, one in zip(cells, shown, strict=True) if cell and one.on_chart]
    assert len(seen) == 4
    if seen[0].y > place.chart.bottom:
        assert place.bar
        assert max(cell.bottom for cell in seen) < place.bar.y
    else:
        assert max(cell.right for cell in seen) < place.chart.right - 5 * place.text_size
        assert min(cell.x for cell in seen) > place.chart.x + 16 * place.text_size


def bar_now(player: Player) -> dict[str, Rect]:
    """Return where the buttons stand that are seen, by their icons."""
    player.mouse(pygame.MOUSEMOTION, (5, 5), rel=(0, 0), buttons=(0, 0, 0))
    cells = bar_cells_in(player.window.screen)
    pairs = zip(bar(player.state), cells, strict=True)
    return {one.icon: cell for one, cell in pairs if cell and not one.on_chart}


@pytest.mark.parametrize("size", [(1280, 720), (640, 360), (720, 1280), (1920, 1080)], ids=str)
@pytest.mark.parametrize("opening", ["list", "edit"])
def test_the_bar_stands_still_while_a_list_opens(player: Player, size: tuple[int, int], opening: str) -> None:
    pygame.display.set_mode(size, pygame.RESIZABLE)
    before = bar_now(player)
    player.window.state = advance(player.state, [Action(opening)])
    after_it = bar_now(player)
    assert after_it.pop("back") == before.pop("home")
    assert after_it == before
    layout = player.window.screen.last.layout
    assert layout.lists.bottom < min(cell.y for cell in after_it.values())


TWICE = [
    *("shelf", "arrows", "chart", "construction", "edit", "build"),
    *("pencil", "record", "more", "help", "pause"),
]


@pytest.mark.parametrize("size", [(900, 500), (1280, 720)], ids=str)
@pytest.mark.parametrize("icon", TWICE)
def test_a_double_click_on_a_button_leaves_all_as_it_was(
    player: Player, icon: str, size: tuple[int, int]
) -> None:
    pygame.display.set_mode(size, pygame.RESIZABLE)
    player.press(pygame.K_SPACE)  # runs
    before, at = player.state, bar_now(player)[icon].middle
    for _ in range(2):
        player.mouse(pygame.MOUSEMOTION, (at.real, at.imag), rel=(0, 0), buttons=(0, 0, 0))
        player.drag((at.real, at.imag))
    now = player.state
    assert now.mode == before.mode
    assert (now.help, now.modes, now.building) == (False, (), None)
    assert (now.clock.level, now.clock.paused, now.look) == (
        before.clock.level,
        before.clock.paused,
        before.look,
    )
    assert now.scene is before.scene
    assert now.toast is None


def test_from_the_list_of_dimensions_one_click_leads_to_the_tools_and_one_back(player: Player) -> None:
    pygame.display.set_mode((1280, 720), pygame.RESIZABLE)
    before = {one.key: one.value for one in dimensions(player.state.scene)}
    click(player, "edit dimensions")
    click(player, "build on with this linkage")
    mode: str = player.state.mode
    assert mode == "build"
    assert player.state.sheet
    assert {"A", "B"} <= {*player.state.sheet.building.draft.places}
    click(player, "edit dimensions")
    mode = player.state.mode
    assert mode == "numbers"
    assert sorted(round(one.value, 6) for one in dimensions(player.state.scene) if one.kind == "length") == (
        sorted(
            round(one, 6)
            for key, one in before.items()
            if key[-1] in ("ground", "crank", "coupler", "rocker")
        )
    )


def test_on_an_empty_sheet_there_is_nothing_to_edit(player: Player) -> None:
    pygame.display.set_mode((1280, 720), pygame.RESIZABLE)
    player.press(pygame.K_F2)
    shown = bar(after(player.state, "mouse_moved"))
    assert shown
    (edit,) = (one for one in shown if one.icon == "edit")
    assert edit.lack


# What a lecture needs, by mouse alone: the buttons and rows that are clicked, three at the most.
GESTURES: dict[str, tuple[tuple[str, ...], Callable[[State], object]]] = {
    "run and pause": (("play / pause",), lambda state: not state.clock.paused),
    "slow down": (("speed",), lambda state: state.clock.level < 0),
    "trace": (("coupler trace",), lambda state: not state.look.trace),
    "velocities": (("arrows", "velocities"), lambda state: "v" in state.look.vectors),
    "chart": (("the list of quantities", "row 3"), lambda state: state.look.chart is not None),
    "edit a length": (("edit dimensions",), lambda state: state.edits_dimensions),
    "the other closure": (("construction", "the other closure"), lambda state: state.place in state.edited),
    "polygons": (("construction", "velocity and acceleration"), lambda state: state.look.polygons),
    "build": (("build a linkage",), lambda state: state.building is not None),
    "save under a name": (("record and save", "save the scene"), lambda state: state.of(Naming) is not None),
    "record": (("record and save", "Record"), lambda state: state.recording is not None),
    "the title": (("all commands", "the title"), lambda state: state.game is not None),
}


@pytest.mark.thinned(3)
@pytest.mark.parametrize("task", GESTURES)
def test_what_a_lecture_needs_is_three_gestures_of_the_mouse_away(here: Path, task: str) -> None:
    del here
    names, done = GESTURES[task]
    with screen.opened((1280, 720)):
        player = Player(replace(begin(load("crank-rocker")), games=game_of))
        player.tick(20)
        player.press(pygame.K_SPACE)
        for name in names:
            listing = player.state.of(Listing)
            if listing or player.state.of(RecordDialog):
                labels = [label for label, *_ in record_dialog.rows(player.state)]
                words = [*listing.matches(player.state.scene)] if listing else labels
                found = (n for n, one in enumerate(words) if one.startswith(name))
                row = int(name[4:]) if name.startswith("row ") else next(found)
                y = next(y for y in range(2, 718) if player.window.screen.row_at(60, y) == row)
                player.mouse(pygame.MOUSEBUTTONDOWN, (60, y), button=1)
                player.mouse(pygame.MOUSEBUTTONUP, (60, y), button=1)
            elif name == "speed":
                x, y_, wide = button(player, name)
                player.drag((x, y_), (x - 0.3 * wide, y_))
            else:
                click(player, name)
        player.tick(2)
        assert len(names) <= 3
        assert done(player.state)
        player.window.state = replace(player.state, recording=None)
        player.window.close()


def test_a_still_window_without_a_mouse_has_no_bar(player: Player) -> None:
    assert SIZE == (320, 180)
    assert bar(player.state) == ()


def button(player: Player, name: str) -> tuple[float, float, float]:
    """Move the mouse to a command on the bar; return its middle and its width."""
    player.mouse(pygame.MOUSEMOTION, (5, 5), rel=(0, 0), buttons=(0, 0, 0))
    screen = player.window.screen
    assert bar(screen.state)
    buttons = bar(screen.state)
    number = next(n for n, one in enumerate(buttons) if one.name.startswith(name))
    cell = bar_cells_in(screen)[number]
    assert cell
    return cell.middle.real, cell.middle.imag, cell.width


def click(player: Player, name: str) -> None:
    x, y, _ = button(player, name)
    player.mouse(pygame.MOUSEMOTION, (x, y), rel=(0, 0), buttons=(0, 0, 0))
    player.mouse(pygame.MOUSEBUTTONDOWN, (x, y), button=1)
    player.mouse(pygame.MOUSEBUTTONUP, (x, y), button=1)


@pytest.fixture
def large(here: object) -> Iterator[Player]:
    del here
    with screen.opened((1280, 720)):
        player = Player(replace(begin(load("crank-rocker")), games=game_of))
        player.tick(20)
        player.press(pygame.K_SPACE)
        player.press(pygame.K_h, 0, "h")
        yield player
        player.window.close()


def on_help(player: Player, keys: str) -> tuple[float, float]:
    """Return a place on a line of the help that is open."""
    places = ((x, y) for y in range(4, 716, 6) for x in range(30, 1270, 40))
    return next(at for at in places if player.window.screen.help_at(*at) == keys)


def test_a_line_of_the_help_does_what_it_says_when_it_is_clicked(large: Player) -> None:
    at = on_help(large, "Space")
    large.mouse(pygame.MOUSEBUTTONDOWN, at, button=1)
    large.mouse(pygame.MOUSEBUTTONUP, at, button=1)
    assert (large.state.help, large.state.clock.paused) == (False, False)


def test_a_line_of_several_commands_lists_them(large: Player) -> None:
    at = on_help(large, "↑ ↓")
    large.mouse(pygame.MOUSEBUTTONDOWN, at, button=1)
    large.mouse(pygame.MOUSEBUTTONUP, at, button=1)
    assert not large.state.help
    assert rows(large.state) == ["slower", "faster"]


@pytest.mark.slow
def test_every_line_of_the_help_is_under_the_mouse(large: Player) -> None:
    wanted = {keys for _, lines in large.state.keys.help_groups for keys, _ in lines}
    found = {large.window.screen.help_at(x, y) for y in range(2, 718, 4) for x in range(20, 1270, 60)}
    assert wanted <= found


def test_a_click_beside_the_help_closes_it_and_one_between_its_lines_does_nothing(large: Player) -> None:
    before = large.state.look
    large.mouse(pygame.MOUSEBUTTONDOWN, (640, 8), button=1)
    large.mouse(pygame.MOUSEBUTTONUP, (640, 8), button=1)
    if large.window.screen.help_at(640, 8) is not None:
        assert large.state.help
    large.mouse(pygame.MOUSEBUTTONDOWN, (2, 360), button=1)
    assert (large.state.help, large.state.look) == (False, before)


def test_a_click_on_a_toast_opens_the_folder_of_what_was_saved(
    player: Player, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    pygame.display.set_mode((1280, 720), pygame.RESIZABLE)
    player.tick()
    for done in ("s", "c"):
        if done == "s":
            player.type("s")
        else:
            player.window.state = advance(player.state, [Action("note", "the tape has been left")])
        player.tick(2)
        assert player.state.toast
        on = [
            (x, y)
            for y in range(4, 720, 8)
            for x in range(8, 1280, 40)
            if player.window.screen.target_at("toast", x, y)
        ]
        player.mouse(pygame.MOUSEBUTTONDOWN, on[0], button=1)
        player.mouse(pygame.MOUSEBUTTONUP, on[0], button=1)
        assert player.state.toast is None
    assert opened == [(here / "recordings").as_uri()]


def test_a_slider_that_goes_while_it_is_dragged_gives_a_share_all_the_same(player: Player) -> None:
    """Another mode's bar has fewer buttons than the one in which the drag began."""
    bar_now(player)
    shown = player.window.screen
    assert bar(shown.state)
    numbers = range(len(bar(shown.state)) + 2)
    assert all(0.0 <= shown.share_at(number, 640.0) <= 1.0 for number in numbers)


@pytest.mark.thinned(5)
@pytest.mark.parametrize("size", [(1280, 720), (3840, 2160), (720, 1280)], ids=str)
@pytest.mark.parametrize("name", ["crank-rocker", "press", "jansen"])
def test_nothing_that_is_shown_for_long_is_under_the_bar(size: tuple[int, int], name: str) -> None:
    begun = begin(load(name))
    looks: dict[str, tuple[Action | str, ...]] = {
        "bare": (),
        "chart": (Action("plot", begun.scene.telling[0]),),
        "dimensions": ("names", "names"),
        "polygons": ("polygons",),
        "list": ("list",),
        "help": ("help",),
    }
    for look, actions in looks.items():
        state = after(begun, *actions, "mouse_moved")
        picture = Framing(window=True).fitting(state, size)
        place = picture.layout
        frame = at_foot(place, bar(state))
        assert (
            picture.composition.while_dragged(picture.composition.subject).view is picture.composition.view
        ), look
        standing = (place.chart, place.polygons, place.caption)
        assert not any(frame.meets(one) for one in standing if one), look


def test_the_help_ends_above_the_bar() -> None:
    with screen.opened((1280, 720)):
        player = Player(after(begin(load("crank-rocker")), "help", "mouse_moved"))
        shown = player.window.screen
        frame = shown.targets("bar")[0].place
        assert all(shown.help_at(x, frame.y) is None for x in range(0, 1280, 20))
        player.window.close()
