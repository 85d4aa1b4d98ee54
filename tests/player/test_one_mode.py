"""Lengths are dragged and typed and parts are added in one mode: the list of dimensions with the tools."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pygame
import pytest
from playing import CTRL, SHIFT, Player
from shown_lists import lines_in, values_in

from linkanim.build.tools import TOOLS
from linkanim.mechanics.groups import group_of
from linkanim.picture.layout import tool_cells
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.state import BuildSheet, State, begin
from linkanim.player.tape import Taping
from linkanim.player.tape_file import read, write
from linkanim.scenes import load, names
from linkanim.scenes.editing import dimensions
from linkanim.ui import screen
from linkanim.ui.pictures import beside

WINDOW = (1280, 720)


class Editor(Player):
    """A window on the crank-rocker, with a hand for its tools and its sheet."""

    @property
    def sheet(self) -> BuildSheet:
        assert self.state.building
        return self.state.building

    def tool(self, icon: str) -> None:
        number = next(n for n, one in enumerate(TOOLS) if one.icon == icon)
        cell = tool_cells(self.window.screen.last.layout)[number].middle
        self.drag((cell.real, cell.imag))

    def draw(self, *places: tuple[float, float]) -> None:
        self.drag(*(self.window.screen.pixel(*place) for place in places))

    def row(self, label: str) -> tuple[float, float]:
        """Return the middle of a row of the list, in pixels."""
        panel = values_in(self.state)
        assert panel
        number = next(n for n, one in enumerate(panel.rows) if one.label == label)
        return next((60.0, y + 3.0) for y in range(720) if self.window.screen.row_at(60, y) == number)

    @property
    def mode(self) -> str:
        return self.state.mode

    def place(self, joint: str) -> tuple[float, float]:
        return self.sheet.seen(self.state.scene, self.state.phase).places[joint]


@pytest.fixture
def editor(here: object) -> Iterator[Editor]:
    with screen.opened(WINDOW):
        found = Editor(begin(load("crank-rocker")))
        found.tick(20)
        found.press(pygame.K_e, text="e")
        yield found
        found.window.close()


def after(state: State, *actions: Action | str) -> State:
    return advance(state, [Action(one) if isinstance(one, str) else one for one in actions])


def of_label(state: State, label: str) -> float:
    return next(item.value for item in dimensions(state.scene) if item.label == label)


def test_a_part_is_added_to_the_lengths_that_were_edited_and_one_undo_takes_back_both(
    editor: Editor,
) -> None:
    first = editor.state.scene
    editor.press(pygame.K_DOWN)
    editor.press(pygame.K_RIGHT)
    editor.tool("spring")
    assert editor.mode == "numbers"
    assert (editor.sheet.tool, of_label(editor.state, "Crank 2")) == ("spring", 51)
    editor.draw(editor.place("B"), (20, -60))
    editor.drag(editor.row("Rocker 4"))
    editor.type("82")
    editor.press(pygame.K_RETURN)
    assert [one.between for one in editor.state.scene.linkage.springs] == [("B", "O6")]
    assert of_label(editor.state, "Rocker 4") == 82
    seen = []
    for _ in range(4):
        editor.press(pygame.K_z, CTRL)
        seen.append((of_label(editor.state, "Crank 2"), len(editor.state.scene.linkage.springs)))
    assert seen == [(51, 1), (51, 0), (50, 0), (50, 0)]
    assert editor.state.scene.linkage == first.linkage
    editor.press(pygame.K_y, CTRL)
    assert of_label(editor.state, "Crank 2") == 51


@pytest.mark.thinned(4)
@pytest.mark.parametrize("paused", [False, True])
@pytest.mark.parametrize("way", ["escape", "f2", "button"])
def test_the_mode_is_left_at_once_and_the_motion_is_as_it_was(
    editor: Editor, way: str, *, paused: bool
) -> None:
    if paused:
        editor.press(pygame.K_SPACE)
    editor.window.state = replace(
        editor.state, look=replace(editor.state.look, unit="cm", chart="rocker.angle")
    )
    editor.tool("spring")
    editor.draw(editor.place("B"), (20, -60))
    assert beside(editor.state).drawn
    if way == "button":
        editor.window.state = after(editor.state, "back")
    else:
        editor.press({"escape": pygame.K_ESCAPE, "f2": pygame.K_F2}[way])
    assert editor.mode == ("paused" if paused else "play")
    assert (editor.state.look.unit, editor.state.look.chart) == ("cm", "rocker.angle")
    assert len(editor.state.scene.linkage.springs) == 1
    editor.press(pygame.K_z, CTRL)
    assert editor.state.scene == load("crank-rocker")


def test_e_on_the_sheet_shows_the_list_and_puts_it_away(editor: Editor) -> None:
    editor.press(pygame.K_ESCAPE)
    editor.press(pygame.K_F2)
    editor.press(pygame.K_e, text="e")
    assert editor.mode == "build"  # nothing is drawn
    assert editor.state.toast
    editor.press(pygame.K_F2)
    editor.press(pygame.K_F2, SHIFT)
    modes = []
    for _ in range(2):
        editor.press(pygame.K_e, text="e")
        modes.append(editor.mode)
    assert modes == ["numbers", "build"]
    panel = values_in(after(editor.state, "numbers"))
    assert panel
    assert [row.label for row in panel.rows][:3] == ["Ground 1", "Crank 2", "Coupler 3"]
    assert panel.facts == ("Grashof crank-rocker", "s + l = 150 < p + q = 165")


def test_f2_leads_from_the_list_to_the_tools_by_keys_alone_and_e_back(editor: Editor) -> None:
    editor.press(pygame.K_DOWN)
    editor.press(pygame.K_RIGHT)
    editor.press(pygame.K_F2)
    assert editor.mode == "build"
    editor.press(pygame.K_7, text="7")
    assert editor.sheet.tool == "spring"
    editor.press(pygame.K_e, text="e")
    assert editor.mode == "numbers"
    editor.press(pygame.K_8, CTRL)
    assert editor.sheet.tool == "damper"
    editor.press(pygame.K_DOWN)
    editor.press(pygame.K_RIGHT)
    assert of_label(editor.state, "Crank 2") == 51
    editor.press(pygame.K_F2)
    assert editor.mode == "play"


def test_a_value_that_cannot_be_is_refused_on_the_sheet_as_it_is_without(editor: Editor) -> None:
    bare = editor.state
    told = []
    for state in (bare, after(bare, "build_on", "numbers")):
        state = after(state, Action("choose", 2 - state.editing.chosen), Action("type", "40"), "accept")
        assert of_label(state, "Coupler 3") == 85
        panel = values_in(state)
        assert panel
        told.append(panel.error)
        again = after(state, "accept")
        assert of_label(again, "Coupler 3") == 40
        assert again.building is None or of_label(after(again, "undo_sheet"), "Coupler 3") == 85
    assert told[0] == told[1]
    assert told[0]
    assert "the crank cannot turn fully" in told[0]


# of what is solved together, the rows are those of the drawing
CHAINS = [name for name in names() if group_of(load(name).linkage) is None]


@pytest.mark.sampled
@pytest.mark.parametrize("name", CHAINS)
def test_nothing_of_a_mechanism_is_lost_on_the_way_to_the_sheet_and_back(name: str) -> None:
    scene = load(name)
    state = after(begin(scene), "edit", "build_on", "numbers")
    item = next(item for item in dimensions(scene) if item.key == ("drive", "speed"))
    at = [one.key for one in dimensions(state.scene)].index(item.key)
    state = after(state, Action("choose", at - state.editing.chosen), Action("nudge", 1), Action("nudge", -1))
    assert state.building
    assert state.building.building.made.scene is state.scene
    left = after(state, "build")
    assert left.sheet
    assert not left.building
    assert (left.scene.linkage, left.scene.trace) == (scene.linkage, scene.trace)


def test_a_joint_and_a_row_are_chosen_together(editor: Editor) -> None:
    editor.tool("bar")
    editor.drag(editor.row("Rocker 4"))
    assert editor.sheet.building.chosen == ("bars", "O4–B")
    (x, y), (u, v) = editor.place("A"), editor.place("B")
    editor.draw(((x + u) / 2, (y + v) / 2))
    assert editor.sheet.building.chosen == ("bars", "A–B")
    assert dimensions(editor.state.scene)[editor.state.editing.chosen].label == "Coupler 3"


def test_a_row_is_dragged_on_the_sheet_as_one_step(editor: Editor) -> None:
    editor.tool("bar")
    x, y = editor.row("Rocker 4")
    editor.drag((x, y), (x + 20, y), (x + 40, y))
    assert of_label(editor.state, "Rocker 4") > 82
    assert editor.sheet.building.draft.of("bars")["O4–B"]["length"] == of_label(editor.state, "Rocker 4")
    editor.press(pygame.K_z, CTRL)
    assert of_label(editor.state, "Rocker 4") == 80


def test_what_has_no_row_in_the_list_is_typed_in_its_own(editor: Editor) -> None:
    editor.tool("spring")
    editor.draw(editor.place("B"), (20, -60))
    assert lines_in(editor.state) == ()
    editor.type("400")
    editor.press(pygame.K_RETURN)
    (spring,) = editor.state.scene.document["springs"].values()
    assert spring["between"] == ["B", "O6"]
    assert editor.sheet.building.draft.of("springs")["spring"]["stiffness"] == "400 N/m"
    editor.press(pygame.K_DOWN)
    editor.type("3")
    panel = values_in(editor.state)
    assert panel
    assert [row.value for row in panel.rows if row.chosen] == ["3_"]


def test_what_does_not_move_yet_has_all_its_numbers_in_the_list(editor: Editor) -> None:
    editor.press(pygame.K_ESCAPE)
    editor.press(pygame.K_F2)
    editor.draw((0, 0))
    editor.draw((0, 0), (30, 0))
    editor.draw((30, 0), (60, 80))
    editor.press(pygame.K_e, text="e")
    assert editor.sheet.building.made.scene is None
    panel = values_in(editor.state)
    assert panel
    labels = [row.label for row in panel.rows]
    editor.drag(editor.row(next(one for one in labels if one.startswith("bar A") and "length" in one)))
    editor.type("70")
    editor.press(pygame.K_RETURN)
    assert editor.sheet.building.draft.of("bars")["A–B"]["length"] == 70
    editor.drag(editor.row(next(one for one in labels if one.startswith("bar A") and "length" in one)))
    editor.press(pygame.K_RIGHT)
    assert editor.sheet.building.draft.of("bars")["A–B"]["length"] == 71
    editor.press(pygame.K_z, CTRL)
    assert editor.sheet.building.draft.of("bars")["A–B"]["length"] == 70


def test_a_tape_of_the_mode_plays_it_again(editor: Editor, here: Path) -> None:
    editor.press(pygame.K_DOWN)
    editor.press(pygame.K_RIGHT)
    editor.tool("spring")
    editor.tick(3)
    taping = Taping(editor.state, WINDOW)
    done = [
        Action("nudge", 2),
        Action("choose", 1),
        Action("type", "90"),
        Action("accept"),
        Action("undo_sheet"),
    ]
    state = editor.state
    for action in done:
        state = after(state, action)
        taping.note(state.frame, (action,))
    write(taping.tape(state.frame), here / "a.tape.json")
    *_, last = read(here / "a.tape.json").states()
    assert (last.mode, last.editing.chosen) == ("numbers", state.editing.chosen)
    assert last.scene.linkage == state.scene.linkage


def test_a_mechanism_that_was_saved_is_written_to_the_same_file_from_the_sheet(
    editor: Editor, here: Path
) -> None:
    editor.press(pygame.K_RIGHT)
    editor.press(pygame.K_s, CTRL)
    editor.press(pygame.K_RETURN)
    (path,) = here.glob("*.toml")
    editor.tool("spring")
    editor.draw(editor.place("B"), (20, -60))
    editor.press(pygame.K_s, CTRL)
    assert [*here.glob("*.toml")] == [path]
    assert len(load(path).linkage.springs) == 1


def test_a_sheet_that_the_linkage_has_come_from_is_gone_on_with(editor: Editor) -> None:
    editor.tool("spring")
    editor.draw(editor.place("B"), (20, -60))
    built = editor.sheet.building
    editor.press(pygame.K_F2)
    editor.press(pygame.K_F2, SHIFT)
    assert editor.sheet.building.draft == built.draft
    editor.press(pygame.K_F2)
    editor.press(pygame.K_e, text="e")
    editor.press(pygame.K_RIGHT)
    editor.tool("damper")
    assert editor.sheet.tool == "damper"  # undo goes back to what is in no file: nothing is lost
    assert of_label(editor.state, "Ground 1") == 101


def test_a_tool_s_key_takes_ctrl_where_digits_are_typed_and_leads_to_the_sheet(editor: Editor) -> None:
    editor.press(pygame.K_2, CTRL)
    assert editor.mode == "edit"  # joints are moved there already
    editor.press(pygame.K_RIGHT)
    editor.tool("undo")
    assert (editor.mode, of_label(editor.state, "Ground 1")) == ("edit", 100)
    editor.press(pygame.K_7, CTRL)
    assert (editor.mode, editor.sheet.tool) == ("numbers", "spring")


def test_a_draft_in_no_file_is_let_go_of_only_by_asking_for_a_tool_twice(editor: Editor) -> None:
    editor.press(pygame.K_ESCAPE)
    editor.press(pygame.K_F2)
    editor.draw((0, 0))
    editor.press(pygame.K_F2)
    editor.press(pygame.K_e, text="e")
    editor.tool("spring")
    assert editor.mode == "edit"
    assert editor.state.toast
    editor.tool("spring")
    assert (editor.mode, editor.sheet.tool) == ("numbers", "spring")


@pytest.mark.parametrize("action", ["closure", "reset", "returns", Action("nudge", 1), Action("pull", 2)])
def test_the_list_of_what_does_not_move_changes_nothing_of_the_mechanism_before(
    editor: Editor, action: Action | str
) -> None:
    state = after(
        editor.state, "edit", "build", Action("hand_down", (0.0, 0.0, 3.0, 1.0)), "hand_up", "numbers"
    )
    assert state.mode == "numbers"
    done = after(state, action)
    assert done.scene is state.scene
    assert not done.effects
