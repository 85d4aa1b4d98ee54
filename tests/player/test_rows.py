"""The rows of the open lists answer the mouse: choose, nudge, drag, chart; beside them nothing happens."""

from __future__ import annotations

import json
from collections.abc import Iterator

import pygame
import pytest
from playing import Player, the
from shown_lists import words_in

from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.listing import Listing
from linkanim.player.state import State, begin
from linkanim.player.tape import Tape, starting
from linkanim.player.tape_file import from_document, to_document
from linkanim.scenes import load
from linkanim.scenes.editing import dimensions
from linkanim.ui import screen as display
from linkanim.ui.panels import panel_of

SIZES = [(320, 180), (640, 360), (1280, 720)]


def crank(state: State) -> float:
    return next(item.value for item in dimensions(state.scene) if item.label == "Crank 2")


def row_place(player: Player, row: int) -> tuple[float, float]:
    """Return the middle of a row's stretch of pixels in the window."""
    x = 140.0 * player.window.screen.size[0] / 1280
    found = [y for y in range(player.window.screen.size[1]) if player.window.screen.row_at(x, y) == row]
    assert found, row
    return x, found[len(found) // 2]


def wheel(player: Player, at: tuple[float, float], notches: int) -> None:
    player.mouse(pygame.MOUSEMOTION, at, rel=(0, 0), buttons=(0, 0, 0))
    pygame.event.post(pygame.event.Event(pygame.MOUSEWHEEL, x=0, y=notches, flipped=False))
    player.tick()


@pytest.fixture(params=SIZES, ids=str)
def listed(request: pytest.FixtureRequest) -> Iterator[Player]:
    """The crank-rocker's open list, paused."""
    with display.opened(request.param):
        player = Player(begin(load("crank-rocker")))
        player.press(pygame.K_SPACE)
        player.press(pygame.K_e)
        player.tick(12)
        yield player
        player.window.close()


def test_every_row_that_is_shown_is_found_under_the_mouse_and_only_there(listed: Player) -> None:
    screen, (width, height) = listed.window.screen, listed.window.screen.size
    found = [screen.row_at(0.04 * width, y) for y in range(height)]
    rows = [row for row in found if row is not None and row >= 0]
    assert rows == sorted(rows)
    assert {*rows} == set(range(rows[0], rows[-1] + 1))
    assert screen.row_at(width - 1, 1) is None
    least = min(rows.count(row) for row in rows)
    assert max(rows.count(row) for row in rows) - least <= 1


def test_a_click_chooses_a_row(listed: Player) -> None:
    place = row_place(listed, 1)
    listed.drag(place)
    assert listed.state.editing.chosen == 1
    assert (crank(listed.state), listed.state.editing.past, listed.state.held) == (50.0, (), None)


def test_a_value_begun_in_another_row_waits_there(listed: Player) -> None:
    listed.type("95")
    listed.drag(row_place(listed, 1))
    assert [text for _, text in listed.state.editing.drafts] == ["95"]
    listed.drag(row_place(listed, 1))
    assert [text for _, text in listed.state.editing.drafts] == ["95"]


@pytest.mark.slow
def test_the_wheel_nudges_the_row_under_it_and_zooms_elsewhere(listed: Player) -> None:
    wheel(listed, row_place(listed, 1), 1)
    wheel(listed, row_place(listed, 1), 2)
    assert (listed.state.editing.chosen, crank(listed.state), listed.state.look.zoom) == (1, 53.0, 1.0)
    width, _ = listed.window.screen.size
    wheel(listed, (width - 2, 2), 1)
    assert (crank(listed.state), listed.state.look.zoom) == (53.0, 1.25)


def test_the_wheel_stays_with_its_row_where_the_list_moves_on_below_it() -> None:
    with display.opened((320, 180)):
        player = Player(begin(load("press")))
        player.press(pygame.K_SPACE)
        player.press(pygame.K_e)
        player.tick(12)
        last = max(filter(None, (player.window.screen.row_at(12, y) for y in range(180))))
        wheel(player, row_place(player, last), 1)
        once = player.state.scene
        pygame.event.post(pygame.event.Event(pygame.MOUSEWHEEL, x=0, y=-1, flipped=False))
        player.tick()
        assert player.state.editing.chosen == last
        assert (once == load("press"), player.state.scene == load("press")) == (False, True)
        player.window.close()


def test_a_value_is_dragged_as_one_undo(listed: Player) -> None:
    x, y = row_place(listed, 1)
    step, before = 0.011 * listed.window.screen.size[1], listed.state.scene
    listed.drag((x, y), (x + 2 * step, y), (x + 5 * step, y), (x - 3 * step, y + 40))
    assert crank(listed.state) in (47.0, 46.0, 48.0)  # pixels are whole
    assert (listed.state.editing.past, listed.state.held) == ((before,), None)
    listed.press(pygame.K_z, pygame.KMOD_LCTRL)
    assert crank(listed.state) == 50.0


def test_a_value_that_is_refused_stays_where_it_was_good(listed: Player) -> None:
    x, y = row_place(listed, 1)
    step = 0.011 * listed.window.screen.size[1]
    listed.mouse(pygame.MOUSEBUTTONDOWN, (x, y), button=1)
    listed.mouse(pygame.MOUSEMOTION, (x + 400 * step, y), rel=(0, 0), buttons=(1, 0, 0))
    assert (crank(listed.state), listed.state.editing.refusal is None) == (50.0, False)
    listed.mouse(pygame.MOUSEBUTTONUP, (x + 400 * step, y), button=1)
    assert listed.state.editing.refusal is None


def test_the_row_under_the_mouse_is_marked(listed: Player) -> None:
    bare = listed.settle()
    listed.mouse(pygame.MOUSEMOTION, row_place(listed, 1), rel=(0, 0), buttons=(0, 0, 0))
    marked = listed.settle()
    assert marked != bare
    width, _ = listed.window.screen.size
    listed.mouse(pygame.MOUSEMOTION, (width - 1, 1), rel=(0, 0), buttons=(0, 0, 0))
    assert listed.settle() == bare


def test_a_press_on_the_list_moves_nothing_behind_it(listed: Player) -> None:
    width = listed.window.screen.size[0]
    head = next((0.04 * width, y) for y in range(999) if listed.window.screen.row_at(0.04 * width, y) == -1)
    listed.drag(head, (head[0] + 50, head[1] + 30))
    assert listed.state.look.pan == (0.0, 0.0)


def test_a_quantity_is_charted_with_a_click(listed: Player) -> None:
    listed.press(pygame.K_ESCAPE)
    listed.press(pygame.K_k)
    listed.tick(12)
    panel = words_in(listed.state)
    assert panel
    wheel(listed, row_place(listed, panel.chosen), -2)
    assert listed.state.of(Listing)
    assert the(listed.state, Listing).chosen == panel.chosen + 2
    chosen = the(listed.state, Listing).chosen
    listed.drag(row_place(listed, chosen))
    assert not panel_of(listed.state)
    assert listed.state.look.chart == list(listed.state.scene.telling)[chosen]


def test_boxes_chart_several_quantities_below_each_other_and_the_list_stays(listed: Player) -> None:
    listed.press(pygame.K_ESCAPE)
    listed.press(pygame.K_k)
    telling = listed.state.scene.telling
    for row in (0, 1):
        x, y = row_place(listed, row)
        listed.drag((x * 0.2, y))
    assert listed.state.look.chart == f"{telling[0]},{telling[1]}"
    panel = words_in(listed.state)
    assert panel
    assert panel.boxes[:4] == (True, True, False, False)
    listed.press(pygame.K_RETURN, mod=pygame.KMOD_CTRL)  # the one that is chosen, off again
    assert listed.state.look.chart == telling[1]
    listed.press(pygame.K_ESCAPE)
    assert not listed.state.of(Listing)
    assert listed.state.look.chart == telling[1]


def test_a_tape_keeps_a_dragged_value() -> None:
    state = advance(begin(load("crank-rocker")), [Action("edit"), Action("unit")])
    actions = (
        (1, Action("grab_row", 1)),
        (2, Action("pull", 4)),
        (3, Action("pull", 7)),
        (4, Action("drop")),
    )
    tape = Tape(starting(state), 6, actions)
    *_, last = from_document(json.loads(json.dumps(to_document(tape))), "mine.tape.json").states()
    assert crank(last) == pytest.approx(57.0)  # 0.7 cm
    assert len(last.editing.past) == 1


@pytest.mark.parametrize("row", [-1, 99, 10**9])
def test_a_row_that_is_not_there_is_not_taken(row: int) -> None:
    state = advance(begin(load("crank-rocker")), [Action("edit")])
    assert advance(state, [Action("grab_row", row), Action("pull", 3)]).scene is state.scene
