"""All closures of the scene in the window: opened by a key, a menu and Find; one is chosen, and undone."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pygame
import pytest
from playing import CTRL, Player, menu_in, the
from published import STEPHENSON

from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.browsing import grid
from linkanim.player.reassembling import OpenClosures
from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.scenes.closures import closures
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse
from linkanim.ui import screen


@pytest.fixture
def player(here: Path) -> Iterator[Player]:
    del here
    with screen.opened((640, 360)):
        player = Player(begin(load("klann")))
        yield player
        player.window.close()


def opened(player: Player) -> OpenClosures:
    player.press(pygame.K_b, CTRL)
    player.tick(3)
    return the(player.state, OpenClosures)


def same(one: Scene, other: Scene) -> bool:
    return one.linkage == other.linkage


@pytest.mark.slow
def test_the_key_shows_each_closure_once_with_its_words(player: Player) -> None:
    scene = player.state.scene
    found = opened(player)
    assert [same(a.scene, b.scene) for a, b in zip(found.closures, closures(scene), strict=True)] == [
        True
    ] * 3
    assert found.texts(0)[1].startswith("1: ")
    assert "turns fully" in found.texts(0)[1]
    for _ in range(8):  # a picture a frame or two
        player.tick()
    before = player.pixels
    player.tick(20)
    assert player.pixels != before


def test_enter_takes_the_chosen_one_and_undo_goes_back(player: Player) -> None:
    scene = player.state.scene
    found = opened(player)
    player.press(pygame.K_RIGHT)
    player.press(pygame.K_RETURN)
    assert player.state.of(OpenClosures) is None
    assert same(player.state.scene, found.closures[1].scene)
    player.press(pygame.K_z, CTRL)
    assert same(player.state.scene, scene)


def test_a_click_takes_one(player: Player) -> None:
    found = opened(player)
    cell = grid((640, 360), found).cells[2]
    player.drag((cell.middle.real, cell.middle.imag))
    assert same(player.state.scene, found.closures[2].scene)


@pytest.mark.parametrize("close", [(pygame.K_ESCAPE, 0), (pygame.K_b, CTRL)], ids=["Esc", "Ctrl+B"])
def test_it_closes_and_changes_nothing(player: Player, close: tuple[int, int]) -> None:
    before = player.state.scene
    opened(player)
    player.press(*close)
    assert player.state.of(OpenClosures) is None
    assert player.state.scene is before


def test_menu_and_find_list_it(player: Player) -> None:
    player.press(pygame.K_F10)
    assert "all closures, to choose one" in [row.words for row in menu_in(player.state).entries]
    player.press(pygame.K_ESCAPE)
    player.press(pygame.K_k, CTRL)
    player.type("all closures")
    player.press(pygame.K_RETURN)
    player.tick(3)
    assert len(the(player.state, OpenClosures).closures) == 3


@pytest.mark.slow
def test_links_that_are_solved_together_have_theirs(player: Player, here: Path) -> None:
    (here / "triad.toml").write_text(STEPHENSON, encoding="utf-8")
    triad = Player(begin(load(here / "triad.toml")))
    found = opened(triad)
    assert len(found.closures) == 4
    triad.press(pygame.K_RIGHT)
    triad.press(pygame.K_RETURN)
    assert same(triad.state.scene, found.closures[1].scene)
    triad.window.close()


def test_too_many_dyads_are_a_sentence(player: Player) -> None:
    rockers = "".join(
        f'[joints.B{n}]\nfrom = ["{a}", "O4"]\nlength = [85, 80]\nside = "left"\n'
        f'[joints.C{n}]\non = ["B{n}", "O4"]\nat = [40, {10 + n}]\n'
        for n, a in enumerate(["A"] * 11)
    )
    ground = "[ground]\nO2 = [0, 0]\nO4 = [100, 0]\n"
    scene = scene_from(
        parse(f'{ground}[joints.A]\ncrank = "O2"\nlength = 50\n{rockers}', "many"), name="many", where="many"
    )
    many = Player(begin(scene))
    many.press(pygame.K_b, CTRL)
    many.tick(3)
    assert many.state.of(OpenClosures) is None
    assert many.state.toast
    assert "11 dyads can be put together in 2,048 ways" in many.state.toast.text
    many.window.close()


def test_a_tape_takes_the_same_closure(player: Player) -> None:
    found = closures(player.state.scene)
    after = advance(player.state, [Action("choose_closure", 1)])
    assert same(after.scene, found[1].scene)
    assert advance(player.state, [Action("choose_closure", 99)]).scene is player.state.scene
