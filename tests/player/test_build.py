"""A linkage built in the window: real clicks and keys on a sheet, what is shown of it, and the way back."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import pygame
import pytest
from playing import CTRL, SHIFT, NoSearch, Player

from linkanim.build.dimensions import rows_of
from linkanim.build.draft import UNTITLED, Photo
from linkanim.build.tools import TOOLS
from linkanim.errors import BadInput
from linkanim.picture.build_sheet import draft_gauge
from linkanim.picture.layout import tool_cells
from linkanim.picture.photograph import lack
from linkanim.picture.sheet_rows import SheetRows
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.play.arcade import Arcade
from linkanim.player import background
from linkanim.player.action import Action
from linkanim.player.actions import advance, carried
from linkanim.player.browsing import NEW
from linkanim.player.files import DraftFile
from linkanim.player.keys import Press
from linkanim.player.modes import KEYS_OF
from linkanim.player.naming import Naming
from linkanim.player.on_sheet import SheetDrawing
from linkanim.player.shelving import OpenShelf
from linkanim.player.state import TOAST_FRAMES, BuildSheet, Grip, begin
from linkanim.player.tape import Tape, Taping
from linkanim.player.tape_file import read, write
from linkanim.recorder.tape_frames import record_tape
from linkanim.scenes import load
from linkanim.scenes.editing import dimensions, other_closure
from linkanim.scenes.toml import parse, save
from linkanim.synthesis.answers import PathAnswer
from linkanim.ui import screen
from linkanim.ui.panels import Panels, tools_of
from linkanim.ui.pictures import beside, recorded
from linkanim.ui.tools import ICONS

WINDOW = (640, 360)


class Builder(Player):
    """A window with an open sheet, drawn on in its own unit."""

    @property
    def sheet(self) -> BuildSheet:
        assert self.state.building
        return self.state.building

    def at(self, x: float, y: float) -> tuple[float, float]:
        return self.window.screen.pixel(x, y)

    def click(self, x: float, y: float) -> None:
        self.drag(self.at(x, y))

    def draw(self, *places: tuple[float, float]) -> None:
        self.drag(*(self.at(*place) for place in places))

    def four_bar(self) -> None:
        self.click(0, 0)
        self.click(100, 0)
        self.draw((0, 0), (30, 0))
        self.draw((30, 0), (60, 80))
        self.draw((60, 80), (100, 0))


@pytest.fixture
def builder(here: object) -> Iterator[Builder]:
    with screen.opened(WINDOW):
        player = Builder(begin(load("crank-rocker")))
        player.press(pygame.K_F2)
        yield player
        player.window.close()


def on_sheet(builder: Builder) -> SheetDrawing:
    """Return the sheet as it was drawn last."""
    shown_ = builder.window.screen
    (shown,) = beside(shown_.state, shown_.mouse).drawn
    assert isinstance(shown, SheetDrawing)
    return shown


def captions(builder: Builder) -> list[Rect]:
    """Return where words stand on the window, without those of the list beside the sheet."""
    shown, state = builder.window.screen, builder.state
    picture = shown.last
    groups = picture.groups(picture.scene.pose(state.phase), beside(state, shown.mouse))
    of_sheet = (group for group in groups if group.name != "sheet-rows")
    return [line.around(picture.type) for group in of_sheet for line in group.captions]


@pytest.mark.parametrize("places", [((0, 0),), ((0, 0), (40, 20)), ((0, 0), (0, 40)), ((0, 0), (-40, 0))])
def test_what_was_just_set_down_has_its_letter_and_no_words_on_it(
    builder: Builder, places: tuple[tuple[float, float], ...]
) -> None:
    for place in places:
        builder.click(*place)
        builder.tick()
        found = captions(builder)
        over = [(one, other) for n, one in enumerate(found) for other in found[:n] if one.meets(other)]
        assert not over


def test_an_empty_sheet_says_what_to_do(builder: Builder) -> None:
    assert builder.state.mode == "build"
    shown = on_sheet(builder)
    assert shown.words[0] == builder.sheet.building.made.missing
    assert "ground pin" in shown.words[0]


def test_a_four_bar_is_drawn_in_five_gestures_and_runs_for_a_period(builder: Builder) -> None:
    builder.four_bar()
    scene = builder.sheet.building.made.scene
    assert scene is builder.state.scene
    assert scene
    assert [joint.name for joint in scene.linkage.joints] == ["O2", "O4", "A", "B"]
    assert scene.linkage.crank("A").length == 30
    assert scene.info.class_name == "Grashof crank-rocker"
    assert not builder.state.clock.paused
    builder.tick(200)
    assert (builder.state.clock.paused, builder.state.phase) == (True, 0.0)
    builder.press(pygame.K_SPACE)
    builder.tick(400)
    assert not builder.state.clock.paused


def test_before_it_moves_what_is_drawn_is_shown_with_what_is_missing(builder: Builder) -> None:
    builder.click(0, 0)
    builder.draw((0, 0), (30, 0))
    before = builder.pixels
    builder.draw((30, 0), (60, 80))
    shown = on_sheet(builder)
    assert not shown.moves
    assert [one.kind for one in shown.shapes] == ["bars", "bars", "pins", "joints", "joints"]
    drawing = shown.draft(builder.window.screen.last.drawing.setting)
    assert drawing._crank == ((0.0, 0.0), (30.0, 0.0))
    assert builder.pixels != before


def test_the_hand_shows_its_bar_and_what_it_would_be_joined_to(builder: Builder) -> None:
    builder.click(0, 0)
    builder.click(100, 0)
    builder.mouse(pygame.MOUSEBUTTONDOWN, builder.at(0, 0), button=1)
    builder.mouse(pygame.MOUSEMOTION, builder.at(30, 40), rel=(0, 0), buttons=(1, 0, 0))
    shown = on_sheet(builder)
    assert shown.rubber
    assert shown.rubber.end == pytest.approx((30, 40), abs=1.0)
    assert shown.rubber.words == "50 mm · 53.1°"
    builder.mouse(pygame.MOUSEMOTION, builder.at(99, 1), rel=(0, 0), buttons=(1, 0, 0))
    shown = on_sheet(builder)
    assert shown.snap
    assert shown.snap.at == (100.0, 0.0)


def test_esc_lets_go_of_what_the_hand_draws(builder: Builder) -> None:
    builder.click(0, 0)
    building = builder.sheet.building
    builder.mouse(pygame.MOUSEBUTTONDOWN, builder.at(0, 0), button=1)
    builder.mouse(pygame.MOUSEMOTION, builder.at(50, 20), rel=(0, 0), buttons=(1, 0, 0))
    builder.press(pygame.K_ESCAPE)
    assert builder.sheet.grip is None
    builder.mouse(pygame.MOUSEBUTTONUP, builder.at(50, 20), button=1)
    assert builder.sheet.building.draft == building.draft


def test_undo_to_the_start_gives_an_empty_sheet_and_redo_all_of_it(builder: Builder) -> None:
    builder.four_bar()
    whole = builder.sheet.building.draft
    for _ in range(5):
        builder.press(pygame.K_z, CTRL)
    assert not builder.sheet.building.draft.places
    builder.press(pygame.K_z, CTRL)
    assert builder.state.chip
    assert builder.state.chip.text == "nothing to undo"
    for _ in range(5):
        builder.press(pygame.K_y, CTRL)
    assert builder.sheet.building.draft == whole
    assert builder.sheet.building.made.scene is builder.state.scene


def test_the_sheet_is_left_with_the_linkage_on_and_undo_brings_the_old_one_back(builder: Builder) -> None:
    before = builder.sheet.before
    builder.four_bar()
    built = builder.state.scene
    builder.press(pygame.K_F2)
    assert (builder.state.mode, builder.state.scene) == ("play", built)
    builder.press(pygame.K_z, CTRL)
    assert builder.state.scene is before
    builder.press(pygame.K_F2)
    assert builder.state.scene is built


def test_a_sheet_that_cannot_move_is_left_for_the_scene_before_and_gone_on_with(builder: Builder) -> None:
    builder.click(0, 0)
    builder.press(pygame.K_ESCAPE)  # nothing is chosen any more
    builder.press(pygame.K_ESCAPE)
    assert (builder.state.mode, builder.state.scene.name) == ("play", "crank-rocker")
    builder.press(pygame.K_F2)
    assert list(builder.sheet.building.draft.places) == ["O2"]


def test_all_is_done_by_keys_too(builder: Builder) -> None:
    def go(across: int, up: int) -> None:
        for key, count in ((pygame.K_RIGHT, across), (pygame.K_UP, up)):
            back = {pygame.K_RIGHT: pygame.K_LEFT, pygame.K_UP: pygame.K_DOWN}[key]
            for _ in range(abs(count)):
                builder.press(key if count > 0 else back)

    builder.press(pygame.K_RIGHT)
    x, y = builder.sheet.cursor or (math.nan, math.nan)
    step = builder.window.screen.grid_step
    for across, up in ((0, 0), (6, 0), (-6, 0), (1, 1), (0, 0), (3, 4), (0, 0), (2, -5)):
        go(across, up)
        builder.press(pygame.K_RETURN)
    draft = builder.sheet.building.draft
    assert draft.places["O2"] == pytest.approx((x, y))
    assert draft.places["O4"] == pytest.approx((x + 6 * step, y))
    assert list(draft.of("bars")) == ["O2–A", "A–B", "O4–B"]
    assert builder.sheet.building.made.scene is builder.state.scene


def test_a_place_near_a_line_of_the_grid_is_on_it_but_not_in_tenths(builder: Builder) -> None:
    x, y = builder.at(40, 0)
    builder.drag((x + 2, y + 1))
    assert builder.sheet.building.draft.places["O2"] == (40.0, 0.0)


def test_the_paper_is_shifted_where_nothing_is_drawn(builder: Builder) -> None:
    builder.drag((400, 200), (430, 220), (450, 240))
    assert builder.state.look.pan != (0.0, 0.0)
    assert not builder.sheet.building.draft.places


def test_the_crank_is_turned_by_the_hand(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    builder.drag(builder.at(15, 0), builder.at(0, 15))
    assert builder.state.phase == pytest.approx(math.pi / 2, abs=0.1)


def test_icons_take_tools_and_act(builder: Builder) -> None:
    builder.click(0, 0)
    cells = tool_cells(builder.window.screen.last.layout)
    undo = next(n for n, tool in enumerate(TOOLS) if tool.icon == "undo")
    builder.drag((cells[undo].middle.real, cells[undo].middle.imag))
    assert not builder.sheet.building.draft.places
    builder.mouse(
        pygame.MOUSEMOTION, (cells[0].middle.real, cells[0].middle.imag), rel=(0, 0), buttons=(0, 0, 0)
    )
    assert tools_of(builder.state)
    assert builder.window.screen.mouse.tool == 0


def test_another_mechanism_leaves_the_sheet(builder: Builder) -> None:
    builder.four_bar()
    builder.press(pygame.K_o)
    builder.press(pygame.K_RIGHT)
    builder.press(pygame.K_RETURN)
    assert builder.state.mode == "play"
    assert builder.state.scene.name != "draft"


def test_an_empty_sheet_is_asked_for_twice_where_a_draft_would_be_lost(builder: Builder) -> None:
    builder.click(0, 0)
    builder.press(pygame.K_n, CTRL)
    assert builder.state.toast
    assert "Ctrl+S" in builder.state.toast.text
    assert builder.sheet.building.draft.places
    builder.press(pygame.K_n, CTRL)
    assert not builder.sheet.building.draft.places


def test_a_length_typed_for_the_chosen_bar_waits_in_its_row_while_tab_goes_on(builder: Builder) -> None:
    builder.four_bar()
    builder.press(pygame.K_e, 0, "e")
    builder.type("85")
    builder.press(pygame.K_TAB)
    builder.type("10 rad/s")
    builder.press(pygame.K_RETURN)
    scene = builder.sheet.building.made.scene
    assert scene
    assert scene.linkage.drive.speed == pytest.approx(10.0)
    assert [item.value for item in dimensions(scene) if item.label == "Rocker 4"] == [85]


def test_digits_are_the_number_of_what_is_chosen(builder: Builder) -> None:
    builder.click(0, 0)
    builder.draw((0, 0), (30, 0))
    shown = on_sheet(builder)
    assert shown.number == "length 30 mm"
    builder.type("32.5")
    shown = on_sheet(builder)
    assert shown.number == "length 32.5_"
    builder.press(pygame.K_RETURN)
    assert builder.sheet.building.draft.of("bars")["O2–A"]["length"] == 32.5
    builder.type("0")
    assert builder.sheet.building.typed == ""  # 0 fits the view before something is typed
    builder.type("40mm")
    builder.press(pygame.K_ESCAPE)
    assert builder.sheet.building.draft.of("bars")["O2–A"]["length"] == 32.5


def test_del_says_what_went_with_it(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    builder.click(0, 0)
    builder.press(pygame.K_DELETE)
    shown = on_sheet(builder)
    assert shown.words[0].startswith("Removed joint O2, with ")
    assert not shown.sheet.building.is_refusal
    builder.press(pygame.K_z, CTRL)
    assert builder.sheet.building.made.scene is builder.state.scene


def test_a_double_click_on_a_bar_is_a_point_of_it_drawn_as_plate(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    middle = (50, 53)
    builder.click(*middle)
    builder.click(*middle)
    points = builder.sheet.building.draft.of("points")
    assert [table["on"] for table in points.values()] == [["A", "B"]]


def test_a_tool_draws_what_it_is_called(builder: Builder) -> None:
    builder.press(pygame.K_3, CTRL)
    builder.draw((-60, 40), (60, 40))
    assert len(builder.sheet.building.draft.of("guides")) == 1
    builder.press(pygame.K_1, CTRL)
    builder.click(0, 0)
    builder.draw((0, 0), (20, 0))
    builder.draw((20, 0), (80, 40))
    scene = builder.sheet.building.made.scene
    assert scene
    assert scene.info.class_name == "offset slider-crank"


def test_a_number_takes_a_tool_while_nothing_is_chosen_and_with_ctrl_always(builder: Builder) -> None:
    builder.press(pygame.K_7, text="7")
    assert builder.sheet.tool == "spring"
    builder.press(pygame.K_1, text="1")
    builder.click(0, 0)
    builder.draw((0, 0), (30, 0))
    builder.type("25")
    assert (builder.sheet.tool, builder.sheet.building.typed) == ("bar", "25")
    builder.press(pygame.K_RETURN)
    assert builder.sheet.building.draft.of("bars")["O2–A"]["length"] == 25
    builder.press(pygame.K_7, CTRL)
    assert builder.sheet.tool == "spring"
    builder.press(pygame.K_ESCAPE)
    builder.press(pygame.K_2, text="2")
    assert builder.sheet.tool == "move"


def test_tab_walks_the_tools_both_ways(builder: Builder) -> None:
    walked = []
    for _ in range(10):
        builder.press(pygame.K_TAB)
        walked.append(builder.sheet.tool)
    tools = [one.value for one in TOOLS if one.action == "tool"]
    assert walked == [*tools[1:], "bar"]
    builder.press(pygame.K_TAB, SHIFT)
    assert builder.sheet.tool == "photo"


SCENE_LETTERS = {
    **{"v": "vectors", "a": "vectors", "p": "polygons", "l": "theme", "y": "ink", "i": "centres"},
    **{"t": "trace", "s": "screenshot", "d": "direction", "k": "list", "w": "pencil"},
}


@pytest.mark.parametrize("letter", SCENE_LETTERS)
def test_a_letter_asks_on_the_sheet_for_what_it_does_on_the_scene(letter: str) -> None:
    on_sheet, on_scene = (KEYS_OF[mode].bind_of(Press(letter, letter)) for mode in ("build", "play"))
    assert on_sheet == on_scene
    assert on_sheet
    assert on_sheet.action.name == SCENE_LETTERS[letter]


def test_b_puts_a_linkage_together_the_other_way_and_the_sheet_stays(builder: Builder) -> None:
    builder.press(pygame.K_b, text="b")
    assert builder.state.toast
    assert builder.state.toast.text == builder.sheet.building.made.missing
    builder.four_bar()
    builder.draw((-60, 120), (0, 0))
    drawn = builder.sheet.building.draft
    crossed = other_closure(builder.state.scene).linkage
    builder.press(pygame.K_b, text="b")
    assert builder.state.scene.linkage == crossed
    assert builder.sheet.building.draft.of("bars") == drawn.of("bars")
    builder.press(pygame.K_z, CTRL)
    assert builder.sheet.building.draft.of("sides") == drawn.of("sides")


def test_a_joint_is_moved_live_and_that_is_one_undo(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    before = builder.sheet.building.draft
    builder.press(pygame.K_2, CTRL)
    builder.mouse(pygame.MOUSEBUTTONDOWN, builder.at(60, 80), button=1)
    lengths = []
    for x in (64, 70, 80):
        builder.mouse(pygame.MOUSEMOTION, builder.at(x, 80), rel=(0, 0), buttons=(1, 0, 0))
        lengths.append(builder.state.scene.linkage.joint("B").stated_lengths[0])
    builder.mouse(pygame.MOUSEBUTTONUP, builder.at(80, 80), button=1)
    assert lengths == sorted(set(lengths))
    assert builder.sheet.building.draft.places["B"] == pytest.approx((80, 80), abs=1.0)
    builder.press(pygame.K_z, CTRL)
    assert builder.sheet.building.draft.of("bars") == before.of("bars")


def test_what_is_chosen_goes_round_and_the_drive_and_traces_by_their_keys(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    for _ in range(8):
        builder.press(pygame.K_RIGHT, CTRL)
        if builder.sheet.building.chosen == ("joints", "B"):
            break
    builder.press(pygame.K_t, SHIFT, "T")
    assert builder.state.scene.trace == ("B",)
    builder.press(pygame.K_d, SHIFT, "D")
    assert builder.sheet.building.draft.driven == "B"


def test_a_scene_of_the_catalogue_is_built_on(builder: Builder) -> None:
    builder.press(pygame.K_F2)
    builder.press(pygame.K_F2, SHIFT)
    assert builder.state.scene.linkage == load("crank-rocker").linkage
    assert builder.sheet.building.draft.places.keys() == {"O2", "O4", "A", "B", "P"}


def test_a_draft_is_written_as_a_scene_file_once_it_moves(builder: Builder, here: Path) -> None:
    builder.click(0, 0)
    builder.press(pygame.K_s, CTRL)
    builder.tick()
    assert builder.state.toast
    assert "what can move" in builder.state.toast.text
    assert not list(here.glob("*.toml"))
    builder.press(pygame.K_z, CTRL)
    builder.four_bar()
    builder.press(pygame.K_s, CTRL)
    builder.press(pygame.K_RETURN)
    (path,) = here.glob("*.toml")
    assert load(path).linkage == builder.state.scene.linkage
    assert load(path).title == "Grashof crank-rocker"
    assert builder.sheet.is_written


def test_closing_with_a_draft_in_no_file_asks_once(builder: Builder) -> None:
    builder.click(0, 0)
    assert builder.press(pygame.K_q)
    assert builder.state.toast
    assert "Ctrl+S" in builder.state.toast.text
    pygame.event.post(pygame.event.Event(pygame.QUIT))
    assert not builder.tick()


def test_the_shelf_begins_with_an_empty_sheet(builder: Builder) -> None:
    builder.press(pygame.K_F2)
    builder.press(pygame.K_o)
    browsing = builder.state.of(OpenShelf)
    assert browsing
    assert browsing.matches[0] == NEW
    builder.type("new")
    builder.press(pygame.K_RETURN)
    assert builder.state.mode == "build"
    assert not builder.sheet.building.draft.places


def taped(builder: Builder, *, before: bool) -> Tape:
    """Return the tape of a four-bar built in the window, begun on the sheet or with its first pin there."""
    if not before:
        builder.click(0, 0)
    taping = Taping(builder.state, WINDOW)
    window = builder.window
    window._taping = taping
    if before:
        builder.click(0, 0)
    builder.click(100, 0)
    builder.draw((0, 0), (30, 0))
    builder.draw((30, 0), (60, 80))
    builder.draw((60, 80), (100, 0))
    builder.type("85")
    builder.press(pygame.K_RETURN)
    builder.tick(30)
    return taping.tape(builder.state.frame)


@pytest.mark.parametrize("before", [True, False])
def test_a_taped_session_builds_the_same_again(builder: Builder, here: Path, *, before: bool) -> None:
    made = taped(builder, before=before)
    write(made, here / "four-bar.tape.json")
    *_, last = read(here / "four-bar.tape.json").states()
    assert last.building
    assert last.building.building.draft == builder.sheet.building.draft
    assert last.scene == builder.state.scene
    assert last.phase == pytest.approx(builder.state.phase)


def test_a_building_tape_is_recorded_with_the_hand_and_without_tools(builder: Builder, here: Path) -> None:
    write(taped(builder, before=True), here / "four-bar.tape.json")
    found = record_tape("four-bar.tape.json", "four-bar.gif", size=(160, 90), fps=10)
    assert found.path.exists()
    grip = replace(builder.state.building, grip=Grip((0, 0), (9, 9), 1, 1, builder.sheet.building, True))  # type: ignore[type-var]
    state = replace(builder.state, sheet=grip)
    picture = builder.window.screen.last
    drawn = {group.name for group in picture.groups(picture.scene.pose(state.phase), recorded(state))}
    assert "hand" in drawn
    assert not any(
        one.kind == "tool" for one in Panels().drawn(state, picture.layout, LIGHT, shown="tape")[1]
    )


@pytest.fixture
def photograph(here: Path) -> Path:
    """A picture of four fields of other colours, 200 by 100."""
    picture = pygame.Surface((200, 100))
    fields = (("red", (0, 0)), ("lime", (100, 0)), ("blue", (0, 50)), ("black", (100, 50)))
    for colour, at in fields:
        picture.fill(colour, (*at, 100, 50))
    pygame.image.save(picture, here / "digger.png")
    return here / "digger.png"


def photo_of(builder: Builder) -> Photo:
    found = builder.sheet.building.draft.photo
    assert found
    return found


def seen_at(builder: Builder, x: float, y: float) -> tuple[int, ...]:
    at = builder.at(x, y)
    return tuple(screen.display_surface().get_at((round(at[0]), round(at[1]))))[:3]


def test_a_photograph_that_is_dropped_is_fitted_by_two_known_points(
    builder: Builder, photograph: Path
) -> None:
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(photograph)))
    builder.tick()
    laid = photo_of(builder)
    assert (laid.file, laid.place, laid.width) == ("digger.png", (-100, -40), 300)
    red, green, blue = seen_at(builder, -63, 73)
    assert red > green == pytest.approx(blue, abs=12)
    builder.draw((-100, -40), (0, 0))
    assert photo_of(builder).place == pytest.approx((0, 0), abs=1)
    builder.draw((100, 0), (0, 100))
    fitted = photo_of(builder)
    assert (fitted.turn, fitted.width) == pytest.approx((math.pi / 2, 300), rel=0.02)
    assert fitted.place == pytest.approx((0, 0), abs=1)
    builder.press(pygame.K_z, CTRL)
    assert photo_of(builder).turn == 0


def saved_over(builder: Builder, photograph: Path, here: Path) -> Path:
    """A four-bar built over a photograph, and written."""
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(photograph)))
    builder.tick()
    builder.press(pygame.K_1, CTRL)
    builder.four_bar()
    builder.press(pygame.K_s, CTRL)
    builder.press(pygame.K_RETURN)
    (path,) = here.glob("*.toml")
    return path


def test_a_scene_file_names_its_photograph_and_a_recording_leaves_it_out(
    builder: Builder, photograph: Path, here: Path
) -> None:
    path = saved_over(builder, photograph, here)
    assert parse(path.read_text(), "it")["photo"]["file"] == "digger.png"
    for photo in (False, True):
        shown = recorded(builder.state, photo=photo)
        assert (shown.photo is not None) is photo


def test_a_recording_that_is_to_have_a_photograph_is_refused_without_it(
    builder: Builder, photograph: Path, here: Path
) -> None:
    builder.press(pygame.K_F2)
    taping = Taping(builder.state, WINDOW)
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(photograph)))
    builder.tick(2)
    taping.note(builder.state.frame, (Action("photo", "digger.png"),))
    write(taping.tape(builder.state.frame + 20), here / "a.tape.json")
    made = partial(record_tape, "a.tape.json", "a.gif", size=(320, 180), fps=25)
    made(photo=True)
    with_it = (here / "a.gif").read_bytes()
    photograph.unlink()
    with pytest.raises(BadInput, match=r"^digger\.png: is not there$"):
        made(photo=True)
    assert (here / "a.gif").read_bytes() == with_it
    made()
    assert (here / "a.gif").read_bytes() != with_it


def test_a_distance_on_a_photograph_can_be_typed(builder: Builder, photograph: Path) -> None:
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(photograph)))
    builder.tick(2)
    before = photo_of(builder)
    one, other = (20.0, 20.0), (60.0, 20.0)
    builder.click(*one)
    builder.tick(30)
    builder.click(*other)
    shown = on_sheet(builder)
    assert shown.rubber
    assert shown.rubber.words == "distance 40 mm"
    builder.type("8cm")
    shown = on_sheet(builder)
    assert shown.rubber
    assert shown.rubber.words == "distance 8cm_"
    builder.press(pygame.K_RETURN)
    after = photo_of(builder)
    assert after.width == pytest.approx(2 * before.width)
    assert after.place == pytest.approx([2 * at - 20 for at in before.place])
    assert builder.sheet.span == pytest.approx((100.0, 20.0))
    builder.press(pygame.K_z, CTRL)
    assert photo_of(builder) == before
    assert builder.sheet.span is None


@pytest.mark.parametrize("typed", ["-3", "0"])
def test_a_distance_that_is_none_is_refused(builder: Builder, photograph: Path, typed: str) -> None:
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(photograph)))
    builder.tick(2)
    before = photo_of(builder)
    builder.click(20, 20)
    builder.tick(30)
    builder.click(60, 20)
    builder.window.state = carried(builder.state, Action("digits", typed))
    builder.press(pygame.K_RETURN)
    assert photo_of(builder) == before
    assert builder.sheet.building.is_refusal


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("broken.jpg", "is no picture; a photograph is one of .png, .jpg, .jpeg, .webp, .bmp"),
        ("gone.png", "is not there"),
    ],
)
def test_a_photograph_that_is_gone_or_none_is_a_sentence_and_does_no_harm(
    builder: Builder, here: Path, name: str, reason: str
) -> None:
    builder.tick(30)
    bare = builder.pixels
    (here / "broken.jpg").write_bytes(b"no picture")
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(here / name)))
    builder.tick(2)
    assert builder.state.toast
    assert builder.state.toast.text == f"{name}: {reason}; the sheet goes on without the photograph"
    builder.press(pygame.K_1, CTRL)
    builder.tick(TOAST_FRAMES)
    assert builder.pixels == bare


def test_a_photograph_dropped_while_linkages_are_looked_for_lays_the_pencil_down(
    builder: Builder, photograph: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(background, "Following", NoSearch)
    builder.press(pygame.K_F2)
    before = builder.state.scene
    builder.press(pygame.K_w, text="w")
    builder.drag(*((320 + 90 * math.cos(n / 3), 180 + 60 * math.sin(n / 3)) for n in range(18)))
    assert builder.state.sketch
    found = PathAnswer(0.1, 1.0, 0.3, 1.0, (9.0, 7.0, 30.0, 90.0, 45.0, 30.0, 100.0, 0.0, 80.0))
    builder.window.state = carried(builder.state, Action("follow", found.numbers))
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(photograph)))
    builder.tick(2)
    assert builder.sheet.before is before
    assert not builder.state.sketch
    assert photo_of(builder).file == "digger.png"


def test_a_photograph_can_be_dropped_once_the_current_folder_is_gone(
    builder: Builder, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path_factory.mktemp("gone")
    picture = tmp_path_factory.mktemp("other") / "digger.png"
    pygame.image.save(pygame.Surface((20, 10)), picture)
    monkeypatch.chdir(folder)
    folder.rmdir()
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(picture)))
    builder.tick(2)
    assert photo_of(builder).file == str(picture)
    DraftFile(picture.with_name("draft.json")).keep(builder.sheet)
    builder.press(pygame.K_1, CTRL)
    builder.four_bar()
    builder.press(pygame.K_s, CTRL)
    builder.press(pygame.K_RETURN)
    naming = builder.state.of(Naming)
    assert naming
    assert naming.refusal


@pytest.mark.parametrize("name", ["\udcff.png", "a\u202e.png", "n" * 300 + ".png"])
def test_a_photograph_whose_name_no_file_can_hold_is_refused_and_a_tape_can_be_read(
    builder: Builder, here: Path, name: str
) -> None:
    taping = Taping(builder.state, WINDOW)
    drop = Action("photo", name)
    builder.window.state = advance(builder.state, [drop])
    taping.note(builder.state.frame, (drop,))
    read_back = here / "a.tape.json"
    assert builder.sheet.building.draft.photo is None
    assert builder.state.toast
    assert "rename the picture" in builder.state.toast.text
    write(taping.tape(builder.state.frame), read_back)
    *_, last = read(read_back).states()
    assert last.building
    assert last.building.building.draft.photo is None


def test_what_is_asked_in_the_frame_that_opens_a_sheet_does_no_harm(builder: Builder) -> None:
    builder.press(pygame.K_UP)
    builder.press(pygame.K_F2)
    for key in (pygame.K_F2, pygame.K_UP, pygame.K_RETURN, pygame.K_INSERT):
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=key, mod=0, unicode=""))
    assert builder.tick()
    assert builder.state.mode == "build"


@pytest.fixture
def elsewhere(builder: Builder, photograph: Path, here: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A scene file beside its photograph, in a folder in the current one."""
    path = saved_over(builder, photograph, here)
    (here / "work" / "down").mkdir(parents=True)
    monkeypatch.chdir(here / "work")
    photograph.rename(here / "work" / "down" / "digger.png")
    return path.rename(here / "work" / "down" / "mine.toml")


def test_a_photograph_lies_beside_its_scene_file_from_wherever_that_is_opened(
    builder: Builder, elsewhere: Path
) -> None:
    builder.press(pygame.K_F2)
    for path in (str(elsewhere), "down/mine.toml"):
        pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=path))
        builder.tick(2)
        builder.press(pygame.K_F2, SHIFT)
        assert Path(photo_of(builder).file).samefile(elsewhere.with_name("digger.png"))
        assert lack(photo_of(builder).file) is None
        builder.press(pygame.K_F2)


@pytest.mark.parametrize(("folder", "named"), [("..", "down/digger.png"), (".", "digger.png")])
def test_a_scene_file_names_its_photograph_by_the_path_from_there(
    elsewhere: Path, folder: str, named: str
) -> None:
    written = save(load(elsewhere), elsewhere.parent / folder)
    assert parse(written.read_text(), "it")["photo"]["file"] == named
    assert Path(load(written).document["photo"]["file"]).samefile(elsewhere.with_name("digger.png"))


def test_a_kept_draft_has_its_photograph_from_another_folder_too(
    builder: Builder, photograph: Path, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    builder.window.state = carried(builder.state, Action("photo", photograph.name))
    drafts = DraftFile(here / "draft.json")
    drafts.keep(builder.sheet)
    drafts.close()
    (here / "other").mkdir()
    monkeypatch.chdir(here / "other")
    builder.window.state, sentence = drafts.offered(builder.state)
    drafts.close()
    assert sentence
    builder.press(pygame.K_F2)
    assert lack(photo_of(builder).file) is None


def test_a_sheet_is_opened_out_of_the_title_and_is_there_again_after_it(here: Path) -> None:
    keeper = Arcade(here / "scores.json")
    state = replace(begin(), games=keeper.game_of)
    with screen.opened(WINDOW):
        player = Builder(carried(state, Action("play", keeper.completed("title"))))
        player.press(pygame.K_F2)
        player.click(0, 0)
        player.press(pygame.K_F3)
        assert player.state.mode == "game"
        player.press(pygame.K_F2)
        assert list(player.sheet.building.draft.places) == ["O2"]
        player.window.close()


def test_tools_are_as_large_for_their_window_at_every_size(builder: Builder) -> None:
    layout = builder.window.screen.last.layout
    sides = [tool_cells(replace(layout, size=(1280 * n, 720 * n), unit=float(n)))[0].width for n in (1, 2, 3)]
    assert sides == pytest.approx([40.0, 80.0, 120.0])


def test_every_tool_has_its_icon_and_a_key_of_its_own() -> None:
    assert {tool.icon for tool in TOOLS} == set(ICONS)
    assert len({tool.key for tool in TOOLS}) == len(TOOLS)


def test_a_draft_that_was_saved_is_in_a_file_however_it_is_left_and_taken_up(
    builder: Builder, here: Path
) -> None:
    builder.four_bar()
    builder.press(pygame.K_ESCAPE)
    builder.press(pygame.K_ESCAPE)
    assert builder.state.mode != "build"
    builder.press(pygame.K_s, CTRL)
    builder.press(pygame.K_RETURN)
    builder.press(pygame.K_F2)
    assert builder.sheet.is_written
    builder.press(pygame.K_n, CTRL)
    assert not builder.sheet.building.draft.places
    assert [path.name for path in here.glob("*.toml")] == ["grashof-crank-rocker.toml"]


def levered(builder: Builder) -> None:
    """Draw a crank and a lever beside it, and a bar from the crank's pin onto the lever."""
    builder.click(0, 40)
    builder.tick(30)
    builder.click(0, 0)
    builder.draw((0, 40), (20, 40))
    builder.draw((0, 0), (22, 60))
    builder.draw((20, 40), (7, 20))


def listed(builder: Builder, name: str) -> tuple[SheetRows, list[Rect]]:
    """Return a list of the sheet and where its rows are in the window."""
    shown = on_sheet(builder)
    rows: SheetRows | None = getattr(shown, name)
    assert rows
    targets = builder.window.screen.targets(name)
    return rows, [one.place for one in targets if one.value[0] >= 0]


def test_a_press_puts_what_runs_back_where_it_was_drawn_and_picks_the_joint_there(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(20)
    assert not builder.state.clock.paused
    builder.draw((60, 80), (20, 90))
    assert builder.sheet.building.draft.of("bars")["B–C"]["joints"] == ["B", "C"]
    assert builder.sheet.building.draft.places["B"] == pytest.approx((60, 80), abs=0.5)


def test_what_moved_away_is_picked_where_it_is_seen(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(60)
    (x, y), _ = (builder.state.scene.pose(builder.state.phase, 0).position[name] for name in "AB")
    assert abs(complex(x, y) - 30) > 10
    builder.draw((x, y), (x + 20, y + 30))
    assert any(
        "A" in one["joints"] and "C" in one["joints"]
        for one in builder.sheet.building.draft.of("bars").values()
    )


def test_a_tool_that_is_taken_puts_what_runs_back_where_it_was_drawn(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(20)
    builder.press(pygame.K_8, CTRL)
    assert (builder.state.clock.paused, builder.state.phase) == (True, builder.sheet.building.draft.phase)
    builder.draw((60, 80), (90, 90))
    assert builder.sheet.building.draft.of("dampers")["damper"]["between"][0] == "B"


def test_what_a_drag_can_mean_is_offered_and_tab_does_the_next(builder: Builder) -> None:
    levered(builder)
    rows, _ = listed(builder, "offers")
    assert (len(rows.rows), rows.chosen) == (3, 0)
    first = builder.sheet.building.draft
    builder.press(pygame.K_TAB)
    assert "P" in builder.sheet.building.draft.of("points")
    builder.press(pygame.K_TAB)
    builder.press(pygame.K_TAB)
    assert builder.sheet.building.draft is first
    builder.press(pygame.K_z, CTRL)
    assert len(builder.sheet.building.draft.of("bars")) == 2
    assert builder.sheet.meant is None


def test_a_click_takes_another_meaning(builder: Builder) -> None:
    levered(builder)
    _, places = listed(builder, "offers")
    builder.drag((places[2].middle.real, places[2].middle.imag))
    assert "A in O4–B" in builder.sheet.building.draft.of("slots")


def test_all_numbers_of_what_is_chosen_are_listed_and_a_click_chooses_one(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    builder.click(0, 0)
    rows, places = listed(builder, "numbers")
    assert rows.title == "pin O₂"
    known = rows_of(builder.sheet.building.draft, ("joints", "O2"))
    assert [label for label, _ in rows.rows] == [one.label for one in known]
    builder.drag((places[1].middle.real, places[1].middle.imag))
    assert (builder.sheet.building.row, builder.sheet.building.chosen) == (1, ("joints", "O2"))
    builder.type("7")
    assert listed(builder, "numbers")[0].rows[1] == ("y", "7_")


def row_of(builder: Builder, label: str) -> tuple[float, float]:
    """Return where in the window a row of the panel is."""
    rows, places = listed(builder, "numbers")
    middle = places[[name for name, _ in rows.rows].index(label)].middle
    return middle.real, middle.imag


def test_letters_are_typed_in_a_row_of_words_that_was_asked_for_and_tools_before(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    builder.click(45, 40)
    builder.press(pygame.K_2, CTRL)
    assert builder.sheet.tool == "move"
    builder.drag(row_of(builder, "link's name"))
    builder.type("rod")
    assert dict(listed(builder, "numbers")[0].rows)["link's name"] == "rod_"
    builder.press(pygame.K_RETURN)
    assert builder.sheet.tool == "move"
    assert "rod" in [body.name for body in builder.state.scene.linkage.bodies]
    builder.press(pygame.K_1, CTRL)
    assert builder.sheet.tool == "bar"


@pytest.mark.parametrize("runs", [False, True], ids=["stands", "runs"])
def test_a_click_on_the_crank_chooses_it_as_any_other_bar_and_what_is_typed_is_its_own(
    builder: Builder, runs: bool
) -> None:
    builder.four_bar()
    builder.tick(200)
    builder.click(60, 80)
    builder.drag(row_of(builder, "name"))
    if runs:
        builder.press(pygame.K_SPACE)
    builder.click(22, 0)
    assert builder.sheet.building.chosen == ("bars", "O2–A")
    assert builder.state.clock.paused is not runs
    builder.type("10 rad/s")
    builder.press(pygame.K_RETURN)
    assert builder.state.scene.linkage.drive.speed == 10.0
    builder.type("25")
    for _ in range(2):
        builder.press(pygame.K_RETURN)
    assert [joint.name for joint in builder.state.scene.linkage.joints] == ["O2", "O4", "A", "B"]


def test_a_hand_that_turns_the_crank_chooses_nothing(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    builder.click(60, 80)
    before = builder.sheet.building
    builder.drag(*(builder.at(*place) for place in ((22, 0), (21, 2), (15, 16), (0, 22))))
    assert builder.sheet.building.chosen == before.chosen
    assert builder.sheet.building.draft.tables == before.draft.tables
    assert (builder.sheet.grip, builder.state.clock.paused) == (None, True)
    assert builder.state.phase == pytest.approx(math.pi / 2, abs=0.02)


def test_a_value_with_its_unit_is_no_name(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    builder.click(60, 80)
    builder.drag(row_of(builder, "name"))
    builder.type("10 rad/s")
    builder.press(pygame.K_RETURN)
    sheet = builder.sheet.building
    assert (sheet.is_refusal, sheet.chosen) == (True, ("joints", "B"))
    assert "is a value" in sheet.sentence
    builder.type("Q 10")
    builder.press(pygame.K_RETURN)
    assert "Q 10" in builder.sheet.building.draft.places


def test_a_second_click_on_a_row_of_looks_takes_the_next(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    builder.click(45, 40)
    for stated in ("–", "bar", "plate"):
        builder.drag(row_of(builder, "look"))
        assert dict(listed(builder, "numbers")[0].rows)["look"] == stated
    assert "plate" in [body.get("look") for body in builder.state.scene.document["bodies"].values()]
    builder.press(pygame.K_z, CTRL)
    assert dict(listed(builder, "numbers")[0].rows)["look"] == "bar"


def test_what_is_no_length_stands_on_no_dimension_line(builder: Builder) -> None:
    builder.click(0, 0)
    builder.tick(30)
    builder.click(60, -20)
    builder.draw((0, 0), (120, 30))
    shown = on_sheet(builder)
    assert (shown.number, shown.is_length) == ("length 124 mm", True)
    builder.press(pygame.K_9, CTRL)
    builder.draw((60, -20), (72, 18))
    builder.tick(200)
    shown = on_sheet(builder)
    assert shown.number.startswith("from ")
    assert not shown.is_length


def test_after_a_refusal_digits_are_typed_anew(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    builder.click(45, 40)
    builder.type("-9")
    builder.press(pygame.K_RETURN)
    shown = on_sheet(builder)
    assert shown.sheet.building.is_refusal
    builder.type("75")
    assert builder.sheet.building.typed == "75"


def test_a_linkage_that_ran_before_the_sheet_runs_when_it_is_left(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    assert builder.state.clock.paused
    builder.press(pygame.K_F2)
    assert not builder.state.clock.paused


def test_an_empty_sheet_has_no_other_scene_s_title(builder: Builder) -> None:
    assert pygame.display.get_caption()[0].startswith(UNTITLED)
    builder.four_bar()
    assert pygame.display.get_caption()[0].startswith(builder.state.scene.title)


def test_a_cylinder_s_pin_has_one_pedestal(builder: Builder) -> None:
    builder.click(0, 0)
    builder.tick(30)
    builder.click(60, 0)
    builder.draw((0, 0), (60, 60))
    builder.press(pygame.K_9, CTRL)
    builder.draw((60, 0), (60, 60))
    shown = on_sheet(builder)
    assert builder.sheet.building.made.scene
    assert shown
    assert shown.loose(builder.window.screen.last.drawing.setting) is None


def test_the_grid_says_its_size_and_points_of_bodies_are_dots(builder: Builder) -> None:
    builder.four_bar()
    builder.tick(200)
    builder.draw((45, 40), (45, 60))
    shown = on_sheet(builder)
    assert len(shown.dots) == 1
    screen_ = builder.window.screen
    pose, over = builder.state.scene.pose(builder.state.phase), beside(builder.state, screen_.mouse)
    groups = screen_.last.groups(pose, over)
    captions = [one.text for group in groups for one in group.captions]
    assert f"grid {builder.window.screen.grid_step:g} mm" in captions


@pytest.mark.parametrize("size", [(640, 360), (1280, 720)], ids=str)
def test_letters_of_a_draft_are_off_its_bars(builder: Builder, size: tuple[int, int]) -> None:
    pygame.display.set_mode(size, pygame.RESIZABLE)
    builder.tick()
    builder.four_bar()
    for end in ((150, 40), (60, 20), (130, -40)):
        builder.draw((100, 0), end)
    shown, picture = on_sheet(builder), builder.window.screen.last
    assert not shown.moves
    thick = draft_gauge(picture.layout, picture.view, shown.shapes)
    drawing = shown.draft(replace(picture.drawing.setting, gauge=thick))
    size_ = picture.layout.small_size
    for name in drawing.names(size_):
        at = complex(name.at[0], name.at[1] + 0.62 * size_)
        for bar in (one for one in shown.shapes if one.kind == "bars"):
            begin, end_ = (picture.view.pixel(place) for place in bar.places[:2])
            share = ((at - begin) / (end_ - begin)).real
            off = abs(at - begin - min(max(share, 0.0), 1.0) * (end_ - begin))
            assert off > thick.bar + 0.3 * size_, name.text


def test_what_does_not_move_has_no_quantities(builder: Builder) -> None:
    builder.press(pygame.K_k, text="k")
    assert builder.state.mode == "build"
    assert builder.state.toast
    assert builder.state.toast.text == builder.sheet.building.made.missing
