"""Any linkage built in the window by real mouse events: it runs, is saved, opened again and undone."""

from __future__ import annotations

from collections.abc import Iterator
from math import dist
from pathlib import Path

import pygame
import pytest
from playing import CTRL, SHIFT
from shown_lists import values_in
from test_build import WINDOW, Builder

from linkanim.build.tools import TOOLS
from linkanim.mechanics.groups import group_of
from linkanim.picture.layout import tool_cells
from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.ui import screen

Point = tuple[float, float]


class Hand(Builder):
    """A hand that draws from joints by their names, and from the middles of bars."""

    def place(self, name: str) -> Point:
        draft = self.sheet.building.draft
        if name in draft.places:
            return draft.places[name]
        (a, b), (c, d) = (draft.places[end] for end in draft.ends(name))
        return (a + c) / 2, (b + d) / 2

    def bars(self, *drags: tuple[str, str | Point]) -> None:
        """Draw bars from joints, or points from bars, to joints or to places."""
        for start, end in drags:
            self.draw(self.place(start), self.place(end) if isinstance(end, str) else end)

    def tool(self, icon: str) -> Point:
        cells = tool_cells(self.window.screen.last.layout)
        cell = cells[next(n for n, tool in enumerate(TOOLS) if tool.icon == icon)]
        return cell.middle.real, cell.middle.imag

    def drop_motor(self, at: str) -> None:
        """Drag the drive's tool onto a joint or a bar."""
        x, y = self.at(*self.place(at))
        self.drag(self.tool("drive"), (x - 30, y - 20), (x, y))

    def four_bar(self) -> None:
        self.click(0, 0)
        self.click(80, 0)
        self.bars(("O2", (8, 29)), ("A", (60, 50)), ("B", "O4"))

    def stephenson(self) -> None:
        """Draw Stephenson's third six-bar; what drives is the link behind the coupler's point."""
        for pin in ((110, 0), (0, 0), (60, 0)):
            self.click(*pin)
        self.bars(("O2", (105, 60)), ("O4", (-10, 40)), ("B", (50, 70)), ("C", "O6"))
        self.bars(("B–C", (30, 88)), ("P", "A"))


@pytest.fixture
def hand(here: object) -> Iterator[Hand]:
    with screen.opened(WINDOW):
        player = Hand(begin(load("crank-rocker")))
        player.press(pygame.K_F2)
        yield player
        player.window.close()


def holds(hand: Hand) -> bool:
    """Return whether every bar has its length in a few poses of the scene."""
    scene, draft = hand.state.scene, hand.sheet.building.draft
    bars = [(table["joints"], table["length"]) for table in draft.of("bars").values()]
    for n in range(5):
        at = scene.pose(n * scene.period / 5, 0).position
        if any(abs(dist(at[one], at[other]) - length) > 1e-9 for (one, other), length in bars):
            return False
    return True


def test_watts_six_bar_is_two_dyads(hand: Hand) -> None:
    hand.four_bar()
    hand.bars(("A–B", (45, 70)), ("O4–B", (100, 40)), ("P", (95, 85)), ("C", "Q"))
    scene = hand.sheet.building.made.scene
    assert scene is hand.state.scene
    assert scene
    assert dict(scene.lines)["links, joints"] == "6, 7; mobility 1"
    assert group_of(scene.linkage) is None
    assert holds(hand)


@pytest.mark.slow
def test_a_triad_runs_is_undone_saved_and_opened_again(hand: Hand, here: Path) -> None:
    hand.stephenson()
    building = hand.sheet.building
    assert building.made.missing == ""
    scene = hand.state.scene
    assert building.made.scene is scene
    assert group_of(scene.linkage)
    assert holds(hand)
    assert not hand.state.clock.paused
    hand.press(pygame.K_z, CTRL)
    assert hand.sheet.building.made.missing == "Mobility 2: one more bar, a second motor or a gear pair"
    hand.press(pygame.K_y, CTRL)
    again, first = hand.state.scene.pose(1.0, 0).position, scene.pose(1.0, 0).position
    assert all(dist(again[name], first[name]) < 1e-9 for name in first)
    hand.press(pygame.K_s, CTRL)
    hand.type("triad")
    hand.press(pygame.K_RETURN)
    hand.tick(30)
    [file] = here.rglob("triad.toml")
    saved = load(file)
    assert "points" in saved.document
    opened = saved.pose(1.0, 0).position
    assert all(dist(opened[name], first[name]) < 1e-9 for name in first)
    with_file = Hand(begin(saved))
    with_file.press(pygame.K_F2, SHIFT)
    assert with_file.sheet.building.made.scene is with_file.state.scene
    before = with_file.state.scene
    with_file.draw(with_file.place("B–C"), (20, 110))
    after = with_file.state.scene
    assert group_of(after.linkage)
    assert after.linkage != before.linkage
    assert with_file.sheet.building.made.scene is after
    with_file.window.close()


@pytest.mark.slow
def test_a_number_of_a_triad_is_typed_in_the_list_of_dimensions(hand: Hand) -> None:
    hand.stephenson()
    hand.press(pygame.K_e)
    panel = values_in(hand.state)
    assert panel
    rows = ["".join(row.label) if not isinstance(row.label, str) else row.label for row in panel.rows]
    assert len(rows) > 6
    before = hand.state.scene.linkage
    hand.press(pygame.K_DOWN)
    for letter in "61":
        hand.press(ord(letter), 0, letter)
    hand.press(pygame.K_RETURN)
    assert hand.state.scene.linkage != before
    assert holds(hand)


@pytest.mark.slow
def test_a_motor_is_dragged_onto_a_joint_between_moving_links(hand: Hand) -> None:
    hand.four_bar()
    hand.drop_motor("B")
    draft = hand.sheet.building.draft
    assert draft.drive["motor"] == {"pivot": "B", "between": ["A", "O4"]}
    assert group_of(hand.state.scene.linkage)
    assert hand.window.screen.targets("offers")
    hand.press(pygame.K_TAB)
    assert hand.sheet.building.draft.driven == "B"
    hand.press(pygame.K_z, CTRL)
    assert hand.sheet.building.draft.driven == "A"


def test_a_motor_let_go_on_paper_says_where_it_goes(hand: Hand) -> None:
    hand.four_bar()
    before = hand.sheet.building.draft.drive
    hand.drag(hand.tool("drive"), hand.at(30, 120))
    assert hand.sheet.building.sentence == "Let the motor go on a joint, or a bar"
    assert hand.sheet.building.draft.drive == before


def test_a_second_motor_drives_what_is_free_without_it(hand: Hand) -> None:
    hand.click(0, 0)
    hand.click(80, 0)
    hand.bars(("O2", (5, 25)), ("O4", (75, 30)), ("A", (30, 75)), ("C", "B"))
    assert hand.sheet.building.made.missing.startswith("Mobility 2")
    hand.drop_motor("O4–B")
    scene = hand.sheet.building.made.scene
    assert scene
    assert scene.info.class_name == "five-bar with two motors"
    assert holds(hand)
