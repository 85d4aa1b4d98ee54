"""What the next key may ask for is prepared while nothing happens, and changes no picture."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pygame
import pytest
from playing import SIZE, Player

from linkanim.picture import surface
from linkanim.picture.text import Lettering
from linkanim.player import screen
from linkanim.player.state import State, begin
from linkanim.scenes import load
from linkanim.scenes.editing import ghost_of, other_closure
from linkanim.scenes.scene import Scene

LONG = 400
"""So many frames in which nothing happens are enough to prepare everything."""
DONE = 5
"""After so many in which there was nothing more to prepare nothing is."""


def fresh(name: str) -> Scene:
    """A scene of which nothing is worked out yet."""
    return replace(load(name))


def quiet(player: Player) -> int:
    """Leave the window alone until nothing is left to prepare, and return for how many frames."""
    more, prepare = list[bool](), screen.Screen.prepare

    def noted(self: screen.Screen, state: State) -> bool:
        more.append(prepare(self, state))
        return more[-1]

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(screen.Screen, "prepare", noted)
        for frame in range(LONG):
            player.tick()
            if len(more) > DONE and not any(more[-DONE:]):
                return frame + 1
    return LONG


@pytest.fixture
def rested(here: object) -> Iterator[Player]:
    """A window that was left alone for a while."""
    del here
    with screen.opened(SIZE):
        player = Player(begin(fresh("crank-rocker")))
        quiet(player)
        yield player
        player.window.close()


@pytest.mark.slow
def test_what_keys_ask_for_is_there_after_a_while(rested: Player) -> None:
    scene, picture = rested.state.scene, rested.window.screen._framing.last
    assert vars(scene)["telling"] == fresh("crank-rocker").telling
    assert "polygon_boxes" in vars(picture.fit.subject.figure)
    kept = scene.elsewhere["other closure"]
    assert kept == other_closure(fresh("crank-rocker"))
    rested.type("b")
    assert rested.state.scene is kept
    assert "other closure" not in scene.elsewhere  # or undo would hold on to a chain of them


@pytest.mark.slow
def test_the_other_closure_is_looked_for_as_a_mechanism_comes_on_and_never_while_it_runs(
    here: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The search cannot be parted: while it runs, it would be seen as a hitch."""
    del here
    sought: list[str] = []

    def seeking(scene: Scene) -> Scene | None:
        sought.append(scene.name)
        return ghost_of(scene)

    monkeypatch.setattr(screen, "ghost_of", seeking)
    with screen.opened(SIZE):
        player = Player(begin(fresh("crank-rocker")))
        player.tick()
        assert sought == ["crank-rocker"]
        quiet(player)
        player.type("b")
        quiet(player)
        assert sought == ["crank-rocker"]
        player.press(pygame.K_TAB)
        assert sought == ["crank-rocker", player.state.scene.name]
        player.window.close()


def test_the_way_back_from_the_other_closure_needs_no_search() -> None:
    scene = fresh("jansen")
    other = other_closure(scene)
    assert other_closure(other) is scene
    assert other_closure(scene) is other
    assert "other closure" not in scene.elsewhere


@pytest.mark.slow
def test_the_list_of_dimensions_is_drawn_in_its_own_layout_before_it_is_asked_for(rested: Player) -> None:
    printer = rested.window.screen._printer
    drawn = [
        sheet
        for panels in printer._expected
        for (make, _), (_, sheet) in panels._kept.items()
        if make.__name__ == "edit_list"
    ]
    rested.type("e")
    assert printer._panels is not None
    kept = {make.__name__: sheet for (make, _), (_, sheet) in printer._panels._kept.items()}
    assert any(kept["edit_list"] is sheet for sheet in drawn)


@pytest.mark.slow
def test_polygons_come_once_room_is_made_for_them_and_then_stay(rested: Player) -> None:
    framing = rested.window.screen._framing
    rested.type("p")
    assert framing.last.waits
    place, edge = framing.last.layout.polygons, framing.last.edge
    assert place
    assert edge[0] == framing.last.size[0]  # nothing stands there: what is on its way out of it is not cut
    for _ in range(40):
        rested.tick()
    assert framing.last.has_polygons
    assert framing.last.edge[0] <= place.x
    for key in "lvc":
        rested.type(key)
        for _ in range(30):
            assert framing.last.has_polygons, key
            rested.tick()


@pytest.mark.slow
@pytest.mark.parametrize("key", "pn")
def test_the_frame_in_which_names_come_finds_their_letters_drawn(
    rested: Player, key: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Else names, polygons and what stands still would all be drawn in that frame, and hold it up."""
    framing, made = rested.window.screen._framing, [False]

    def lettered(*known: Any) -> Lettering:
        made[0] = True
        return Lettering(*known)

    monkeypatch.setattr(surface, "Lettering", lettered)
    rested.type(" ")  # in motion names come at their phases
    rested.type(key)
    for _ in range(60):
        made[0], waits = False, framing.last.hurried
        rested.tick()
        if waits and not framing.last.hurried:
            break
    assert framing.last.names is not None
    assert not framing.last.hurried
    assert not made[0]


@pytest.mark.slow
def test_the_help_is_drawn_before_it_is_asked_for(rested: Player) -> None:
    panels = rested.window.screen._printer._panels
    assert panels is not None
    (drawn,) = [sheet for (make, _), (_, sheet) in panels._kept.items() if make.__name__ == "help_sheet"]
    rested.type("h")
    shown = [sheet for (make, _), (_, sheet) in panels._kept.items() if make.__name__ == "help_sheet"]
    assert shown == [drawn]


@pytest.mark.slow
@pytest.mark.thinned(3)
@pytest.mark.parametrize("key", "bckph")
def test_a_picture_is_the_same_where_nothing_was_prepared(
    here: object, key: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    del here
    found, frames = [], 0
    for prepares in (True, False):
        with screen.opened(SIZE):
            player = Player(begin(fresh("six-bar")))
            if prepares:
                frames = quiet(player)
            else:
                monkeypatch.setattr(screen.Screen, "prepare", lambda *_: None)
                player.tick(frames)
            player.type(key)
            found.append(player.pixels)
            player.window.close()
    assert found[0] == found[1]


def test_a_fault_in_what_is_prepared_is_met_by_the_key_alone(
    here: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    del here

    def broken(*_: object) -> None:
        raise ZeroDivisionError("a hole in the solver")

    with screen.opened(SIZE):
        player = Player(begin(fresh("crank-rocker")))
        monkeypatch.setattr(screen, "ghost_of", broken)
        for _ in range(5):
            player.tick()
        assert not player.window._reported
        player.window.close()


def test_a_moving_mouse_leaves_no_time_to_prepare(here: object) -> None:
    del here
    with screen.opened(SIZE):
        player = Player(begin(fresh("crank-rocker")))
        for step in range(30):
            player.mouse(pygame.MOUSEMOTION, (20 + step, 20), rel=(1, 0), buttons=(0, 0, 0))
        assert "telling" not in vars(player.state.scene)
        player.window.close()


@pytest.mark.slow
def test_of_a_large_linkage_nothing_is_prepared(rested: Player, monkeypatch: pytest.MonkeyPatch) -> None:
    """A single step of it would hold a frame up."""
    window, state = rested.window.screen, replace(rested.state, scene=fresh("six-bar"))
    window.show(state, rested.window.screen.over)
    assert window.prepare(state)
    monkeypatch.setattr(screen, "_MOST_JOINTS", 3)
    assert not window.prepare(state)
