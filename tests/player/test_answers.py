"""The window is alive: chips answer keys, pictures fade over, a strip says what there is to press."""

from __future__ import annotations

from dataclasses import replace
from itertools import accumulate
from pathlib import Path

import pygame
import pytest
from playing import SIZE, Player
from shown_lists import lines_in

from linkanim.picture.drawn import Additions
from linkanim.picture.look import Look
from linkanim.picture.marks import DimensionLine, Glow, MeasuredLines
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen, pixel_view
from linkanim.picture.surface import SurfacePrinter
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.state import CHIP_FRAMES, MOVE_FRAMES, SHUTTER_FRAMES, State, begin
from linkanim.scenes import load, names
from linkanim.scenes.editing import closure_name
from linkanim.ui import screen as display
from linkanim.ui.panels import chip_of, hint, recorded_for, watched, words_at_foot
from linkanim.ui.pictures import beside, fading, flash, shutter
from linkanim.ui.window import Window


def after(state: State, *actions: Action | str) -> State:
    for one in actions:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return state


def run(state: State, frames: int) -> State:
    for _ in range(frames):
        state = advance(state)
    return state


def every_other(state: State, first: int, last: int) -> list[State]:
    """Return the state at every second frame from one on to another one."""
    return [*accumulate(range(first, last - 2, 2), lambda one, _: run(one, 2), initial=run(state, first))]


@pytest.fixture
def rocker() -> State:
    return begin(load("crank-rocker"))


# What the window answers to what is asked of it; nothing where the picture itself answers.
ANSWERS: dict[str, tuple[tuple[Action | str, ...], str | None]] = {
    "direction": (("direction",), "reverse"),
    "and back": (("direction", "direction"), "forward"),
    "speed": ((Action("speed", 3),), "40 rpm"),
    "speed backwards": (("direction", Action("speed", 3)), "−40 rpm"),
    "another mechanism": ((Action("mechanism", 2),), f"3 / {len(names())}"),
    "a number": ((Action("select", 4),), f"5 / {len(names())}"),
    "a place of the shelf": ((Action("put", 1),), f"2 / {len(names())}"),
    "the other closure": (("closure",), "crossed"),
    "and the first again": (("closure", "closure"), "open"),
    "no trace": (("trace",), "no trace"),
    "velocity": ((Action("vectors", "v"),), "velocity"),
    "no acceleration": ((Action("vectors", "a"), Action("vectors", "a")), "no acceleration"),
    "polygons": ((Action("polygons"),), "polygons"),
    "no polygons": ((Action("polygons"),) * 2, "no polygons"),
    "centres": ((Action("centres"),), "instant centres"),
    "centrodes": ((Action("centres"),) * 2, "instant centres and centrodes"),
    "no centres": ((Action("centres"),) * 3, "no instant centres"),
    "ghost": (("ghost",), "both closures"),
    "a chart": ((Action("plot", "rocker.angular_velocity"),), "Rocker: angular velocity"),
    "no chart": ((Action("chart", 1), Action("chart", -1)), "no chart"),
    "names": (("names", "names"), "names and dimensions"),
    "theme": (("theme",), "dark"),
    "zoom": ((Action("zoom", (2.0, 0.0, 0.0)),), "156 %"),
    "fit": ((Action("zoom", (2.0, 0.0, 0.0)), "fit"), "100 %"),
    "nothing to undo": (("undo",), "nothing to undo"),
    "pause": (("pause",), None),
    "the start": (("start",), None),
    "a step": ((Action("step", 1),), None),
    "the list": (("edit",), None),
}


@pytest.mark.parametrize(("actions", "words"), ANSWERS.values(), ids=ANSWERS)
def test_a_chip_answers(rocker: State, actions: tuple[Action | str, ...], words: str | None) -> None:
    chip = chip_of(after(rocker, *actions))
    assert chip == words


def test_a_refusal_is_told_and_not_answered() -> None:
    state = after(begin(load("scotch-yoke")), "closure")
    assert (state.chip, state.toast is not None) == (None, True)


def test_a_chip_goes(rocker: State) -> None:
    state = after(rocker, "direction")
    for _ in range(CHIP_FRAMES):
        assert chip_of(state)
        state = advance(state)
    assert chip_of(state) is None


# The name of a closure, where a shorthand, a long form or nothing says it.
CLOSURES = {"crank-rocker": "open", "slider-crank": "forward", "press": "left", "six-bar": "open"}


@pytest.mark.parametrize("name", CLOSURES)
def test_a_closure_has_a_name(name: str) -> None:
    assert closure_name(load(name)) == CLOSURES[name]


def test_a_strip_says_what_to_press_until_a_key_is(rocker: State) -> None:
    strips = [hint(run(rocker, frame)) for frame in (0, 360, 400, 680, 720, 960)]
    assert [strip is not None for strip in strips] == [False, False, True, True, False, False]
    assert strips[2] is not None
    assert "Space pause" in strips[2]
    assert hint(run(after(rocker, "trace"), 100)) is None


@pytest.mark.slow
def test_what_to_watch_for_is_told_first_and_is_gone_before_the_strip(rocker: State) -> None:
    frames = every_other(rocker, 0, 380)
    told = [watched(state) for state in frames]
    assert {one for one in told if one} == {rocker.scene.look_at}
    assert (told[0], told[-1]) == (None, None)
    assert not any(one and hint(state) for one, state in zip(told, frames, strict=True))


# What ends the sentence: whatever is done; another mechanism has its own.
def test_what_is_done_ends_the_sentence_and_another_mechanism_has_its_own(rocker: State) -> None:
    assert watched(run(rocker, 40))
    assert watched(run(after(run(rocker, 40), "direction"), 20)) is None
    on = run(after(run(rocker, 40), Action("mechanism", 1)), 40)
    told = watched(on)
    assert told
    assert told == on.scene.look_at
    assert watched(after(on, Action("record", "gif"))) is None


def test_names_bring_the_sentence_and_keep_it(rocker: State) -> None:
    state = after(run(rocker, 400), "names")
    for one in (state, run(state, 400)):
        told = watched(replace(one, chip=None))
        assert told
        assert told == rocker.scene.look_at
    assert watched(after(state, "names", "names")) is None


def test_a_strip_is_shown_once(rocker: State) -> None:
    shown = [hint(replace(rocker, frame=frame)) is not None for frame in range(100, 12_000, 50)]
    assert any(shown)
    assert not any(shown[20:])


@pytest.mark.parametrize("quiet", ["pause", "help", "list", "shelf", "edit", Action("record", "gif")])
def test_there_is_no_strip_over_anything_else(rocker: State, quiet: str | Action) -> None:
    state = replace(after(rocker, quiet), touched=0)
    assert all(hint(replace(state, frame=frame, chip=None)) is None for frame in range(0, 360, 20))


def test_nothing_that_comes_and_goes_is_on_a_screenshot(rocker: State) -> None:
    state = after(rocker, "direction", "screenshot", Action("note", "told"))
    assert words_at_foot(state)
    assert words_at_foot(state, shown="screenshot") is None


def test_a_screenshots_shutter_flashes_and_goes(rocker: State) -> None:
    state = after(rocker, "screenshot")
    seen = [shutter(run(state, frame)) for frame in range(SHUTTER_FRAMES + 1)]
    assert (seen[0], seen[-1]) == (8, 0)
    assert seen == sorted(seen, reverse=True)
    assert run(state, SHUTTER_FRAMES).shot is None


def test_a_recording_tells_its_seconds(rocker: State) -> None:
    state = run(after(run(rocker, 90), Action("record", "gif")), 120)
    assert recorded_for(state) == "REC GIF 0:02"
    assert recorded_for(replace(state, frame=state.frame + 60 * 60)) == "REC GIF 1:02"


def test_another_mechanism_fades_over(player: Player) -> None:
    crank = player.pixels
    player.press(pygame.K_TAB, 0, "\t")
    first = player.pixels
    seen = {player.pixels for _ in range(MOVE_FRAMES) if player.tick()}
    settled = player.settle()
    assert len(seen) > MOVE_FRAMES // 2
    near = sum(abs(a - b) for a, b in zip(first, crank, strict=True))
    far = sum(abs(a - b) for a, b in zip(first, settled, strict=True))
    assert near < far
    assert player.state.faded is None
    assert settled not in {crank, first}


@pytest.mark.parametrize(("shutter", "share"), [(8, 0.7), (4, 0.175), (0, 0.0)])
def test_a_flash_lets_the_picture_be_seen(shutter: int, share: float) -> None:
    surface = pygame.Surface((4, 4))
    surface.fill((100, 100, 100))
    flash(surface, shutter)
    for corner in ((0, 0), (3, 3)):
        assert surface.get_at(corner)[0] == pytest.approx(100 + share * 155, abs=2)


def test_the_state_that_is_left_fades(rocker: State) -> None:
    state = after(rocker, "theme")
    left, opacity = fading(state) or (None, 0)
    assert left == rocker
    assert 0 < opacity < 255
    assert (fading(run(state, 1)) or (None, 255))[1] < opacity
    assert fading(run(state, MOVE_FRAMES)) is None


def test_a_fade_goes_on_where_the_window_changes_its_size(player: Player) -> None:
    player.type("l")
    pygame.display.set_mode((400, 300), pygame.RESIZABLE)
    assert player.tick()
    pygame.display.set_mode(SIZE, pygame.RESIZABLE)


def test_a_pin_glows_under_the_mouse(player: Player) -> None:
    plain = player.pixels
    x, y = player.window.screen.crank_pin()
    player.mouse(pygame.MOUSEMOTION, (x, y), rel=(1, 1), buttons=(0, 0, 0))
    assert player.pixels != plain
    player.mouse(pygame.MOUSEMOTION, (1, 1), rel=(1, 1), buttons=(0, 0, 0))
    assert player.settle() == plain


def test_a_mouse_that_moves_before_the_first_picture_is_waited_for(here: Path) -> None:
    with display.opened(SIZE):
        window = Window(begin(load("crank-rocker")))
        pygame.event.post(pygame.event.Event(pygame.MOUSEMOTION, pos=(5, 5), rel=(1, 1), buttons=(0, 0, 0)))
        assert window.tick()


def test_with_the_list_open_what_can_be_dragged_glows(player: Player) -> None:
    player.type("e")
    screen = player.window.screen
    pose = player.state.scene.pose(player.state.phase, 0)
    for joint, glows in (("B", True), ("O2", False)):
        player.mouse(pygame.MOUSEMOTION, screen.pixel(*pose.position[joint]), rel=(1, 1), buttons=(0, 0, 0))
        hovered = player.window._mouse.hovered(screen)
        assert (hovered == joint) == glows


def test_a_charts_cursor_has_a_grip(player: Player) -> None:
    assert not beside(player.state).grip
    assert beside(after(player.state, Action("chart", 1))).grip


def test_the_chosen_bar_is_measured_on_the_picture(rocker: State) -> None:
    state = after(rocker, "edit", Action("choose", 1))
    assert lines_in(state) == (DimensionLine(("O2", "A"), 0, 1, "50 mm"),)
    assert lines_in(after(state, Action("choose", -2))) == ()
    assert lines_in(after(state, "edit")) == ()


def test_a_coupler_points_construction_is_on_the_picture(rocker: State) -> None:
    state = after(rocker, "edit", Action("choose", 5))
    chosen, other = lines_in(state)
    assert (chosen.words, chosen.chosen) == ("to the right 70 mm", True)
    assert (other.words, other.chosen) == ("along 80 mm", False)
    assert chosen.begin == other.end


@pytest.mark.parametrize(("row", "words"), [(2, "to the right 12 cm"), (4, "to the left 80 cm")])
def test_a_point_s_way_off_its_bar_says_to_which_side(row: int, words: str) -> None:
    state = after(begin(load("excavator")), "edit", Action("choose", row))
    assert lines_in(state)[0].words == words


# Everything that only the window shows changes the picture, and nothing of it stays.
MARKS = {
    "a measure": Additions((MeasuredLines((DimensionLine(("O2", "A"), 0, 1, "50 mm"),)),)),
    "a glow": Additions((Glow("B"),)),
    "a grip": Additions(grip=True),
}


@pytest.mark.parametrize("size", [(320, 180), (640, 360)])
@pytest.mark.parametrize("drawn", MARKS.values(), ids=MARKS)
def test_a_mark_is_drawn_and_goes(drawn: Additions, size: tuple[int, int]) -> None:
    scene = load("crank-rocker")
    picture, printer, surface = (
        Picture(scene, size, Look(chart="B.velocity")),
        SurfacePrinter(),
        offscreen(size),
    )
    seen = []
    for one in (Additions(), drawn, Additions()):
        printer.paint(surface, picture, scene.pose(1.0), one)
        seen.append(bytes(pixel_view(surface)))
    plain, marked, bare = seen
    assert marked != bare
    assert plain
