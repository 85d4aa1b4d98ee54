"""What makes room moves the scene smoothly, never at one go."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pygame
import pytest
from playing import Player

from linkanim.picture.items import Group
from linkanim.picture.layout import Docked
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.view import View, eased, view_on_the_way
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.state import MOVE_FRAMES, SWING_FRAMES, Change, State, begin
from linkanim.player.tape import Tape
from linkanim.recorder.encode import Frame
from linkanim.recorder.tape_frames import TapeFrames
from linkanim.scenes import load
from linkanim.ui import screen as display
from linkanim.ui.pictures import Framing
from linkanim.ui.screen import Screen

A, B = View(2.0, 100.0, 300.0), View(1.0, 260.0, 200.0)


def _pin(player: Player) -> complex:
    """Return where the rocker's pivot is in the window."""
    return complex(*player.window.screen.pixel(100.0, 0.0))


def _settled(player: Player) -> complex:
    """Return the same once the view has come to rest."""
    player.tick(MOVE_FRAMES + 1)
    return _pin(player)


@pytest.mark.parametrize("key", [pygame.K_e, pygame.K_k, pygame.K_c])
def test_the_view_glides_to_where_a_list_or_a_chart_leaves_room(player: Player, key: int) -> None:
    before, way = player.settle(), [_pin(player)]
    player.press(key, text=chr(key))
    way.append(_pin(player))
    for _ in range(MOVE_FRAMES + 2):
        player.tick()
        way.append(_pin(player))
    whole, steps = abs(way[-1] - way[0]), np.abs(np.diff(way))
    assert whole > 3
    assert steps.max() < 0.2 * whole
    assert steps[-1] == 0
    if key != pygame.K_c:
        player.press(pygame.K_ESCAPE)
        assert _pin(player) != way[0]
        assert player.settle() == before


def test_the_view_glides_with_the_other_closure_and_fills_the_window_with_what_is_shown(
    player: Player,
) -> None:
    before, way = player.settle(), [_pin(player)]
    player.press(pygame.K_b, text="b")
    for _ in range(SWING_FRAMES + 2):
        way.append(_pin(player))
        player.tick()
    whole, steps = abs(way[-1] - way[0]), np.abs(np.diff(way))
    assert whole > 50
    assert steps.max() < 0.2 * whole
    assert steps[-1] == 0
    player.press(pygame.K_b, text="b")
    assert player.settle() == before


def test_a_second_change_on_the_way_begins_where_the_first_had_come_to(player: Player) -> None:
    begin_ = _pin(player)
    player.press(pygame.K_e, text="e")
    whole = abs(_settled(player) - begin_)
    player.press(pygame.K_ESCAPE)
    _settled(player)
    player.press(pygame.K_e, text="e")
    player.tick(6)
    there = _pin(player)
    player.press(pygame.K_ESCAPE)
    assert abs(_pin(player) - there) < 0.2 * whole


def test_zoom_and_mouse_act_at_once(player: Player) -> None:
    before = _pin(player)
    player.press(pygame.K_PLUS, text="+")
    once = _pin(player)
    player.tick(3)
    assert before != once == _pin(player)


@pytest.mark.parametrize("key", [pygame.K_PLUS, pygame.K_TAB], ids=["zoom", "another mechanism"])
def test_what_changes_the_view_on_the_way_is_there_at_once(player: Player, key: int) -> None:
    player.press(pygame.K_c, text="c")
    player.tick(3)
    player.press(key, text="+" if key == pygame.K_PLUS else "")
    once = _pin(player)
    player.tick(MOVE_FRAMES)
    assert _pin(player) == once


def test_what_changes_nothing_of_the_view_lets_it_go_on_its_way(player: Player) -> None:
    player.press(pygame.K_c, text="c")
    player.tick(3)
    there = _pin(player)
    player.press(pygame.K_v, text="v")
    assert 0 < abs(_pin(player) - there) < 0.2 * abs(_settled(player) - there)


def gliding(name: str, size: tuple[int, int], *actions: Action) -> Iterator[Picture]:
    """Yield the pictures of a glide, frame by frame, that the last action begins; then the one that fits."""
    framing, state = Framing(window=True), begin(load(name))
    for action in actions:
        state = advance(replace(state, departures=()), [action])
    for _ in range(MOVE_FRAMES + 1):
        yield framing.at(state, size)
        state = advance(state)


def parts(picture: Picture, *, scene: bool) -> list[Group]:
    """Return what is drawn of the scene, or of charts and polygons."""
    beside = ("chart", "reading", "velocity-polygon", "acceleration-polygon")
    found = [*picture.groups(picture.scene.pose(1.0))]
    return [group for group in found if (group.within is not None if scene else group.name in beside)]


def extent(groups: list[Group]) -> tuple[complex, complex]:
    """Return the upper left and the lower right corner of shapes."""
    places = np.concatenate([loop for group in groups for layer in group.layers for loop in layer.loops])
    return complex(places.real.min(), places.imag.min()), complex(places.real.max(), places.imag.max())


CHART = Action("chart", 1)
LIST = Docked(listed=2, bar=True)


@pytest.mark.parametrize("size", [(1280, 720), (640, 360), (360, 640)], ids=str)
@pytest.mark.parametrize(
    ("name", "actions"),
    [
        *((name, (CHART,)) for name in ("crank-rocker", "press", "jansen", "excavator", "hart")),
        *((name, (Action("polygons"),)) for name in ("crank-rocker", "press")),
        ("crank-rocker", (CHART, Action("polygons"))),
        ("crank-rocker", (Action("names"), CHART)),
    ],
)
@pytest.mark.thinned(2)
def test_charts_and_polygons_come_in_with_the_view_and_cut_nothing_off(
    name: str, actions: tuple[Action, ...], size: tuple[int, int]
) -> None:
    *way, last = gliding(name, size, *actions)
    assert len(way) == MOVE_FRAMES
    for picture in (*way, last):
        drawn = picture.groups(picture.scene.pose(1.0))
        assert not [group for group in drawn if group.name == "slots" and group.layers]
        right, bottom = picture.edge
        if scene := parts(picture, scene=True):
            _, end = extent(scene)
            assert end.real <= right + 1e-6
            assert end.imag <= bottom + 1e-6
        for group in parts(picture, scene=False):
            begin_, _ = extent([group])
            assert begin_.real >= right or begin_.imag >= bottom
    edges = [complex(*picture.edge) for picture in way]
    assert all(after.real <= before.real and after.imag <= before.imag for before, after in pairwise(edges))
    sides = [side for side in (last.layout.chart, last.layout.polygons) if side]
    assert sides
    assert all(last.edge[0] <= side.x or last.edge[1] <= side.y for side in sides)


def test_a_chart_more_comes_in_from_where_the_charts_began() -> None:
    framing, size, state = Framing(window=True), (1280, 720), advance(begin(load("slider-crank")), [CHART])
    state = replace(state, departures=())
    before = framing.fitting(state, size).layout.chart
    pictures, state = [], advance(state, [Action("strip", state.scene.telling[1])])
    for _ in range(MOVE_FRAMES + 1):
        pictures.append(framing.at(state, size))
        state = advance(state)
    tops, last = [picture.edge[1] for picture in pictures], pictures[-1].layout.chart
    assert before
    assert before.y - 15 < tops[0] <= before.y
    assert tops == sorted(tops, reverse=True)
    assert last
    assert last.y - 15 < tops[-1] <= last.y < 0.9 * before.y


def test_every_point_moves_straight_and_arrives() -> None:
    assert (view_on_the_way([A, B], [1.0]), view_on_the_way([A, B], [0.0])) == (A, B)
    half = view_on_the_way([A, B], [0.5])
    assert half.to_pixel(3.0, 4.0) == pytest.approx(
        np.mean([A.to_pixel(3.0, 4.0), B.to_pixel(3.0, 4.0)], axis=0)
    )


def test_a_view_on_its_second_way_is_between_all_that_it_was_to_go_to() -> None:
    c = View(4.0, 0.0, 0.0)
    begun = view_on_the_way([A, B, c], [0.4, 1.0])
    assert begun == view_on_the_way([A, B], [0.4])  # it begins where the first way had come to
    assert view_on_the_way([A, B, c], [0.0, 0.0]) == c
    for later in (0.8, 0.6, 0.5):
        assert B.scale < view_on_the_way([A, B, c], [0.4, later]).scale < c.scale


def test_a_change_begins_at_its_frame_and_is_over_after_its_frames() -> None:
    change = Change(since=10, frames=4)
    assert [change.share(frame) for frame in (9, 11, 13)] == [0.0, eased(0.5), 1.0]
    assert [change.is_over(frame) for frame in (10, 13, 14)] == [False, False, True]


# Equal states are equal pictures: what moves is in the state.

TOUR = (
    CHART,
    Action("names"),
    Action("edit"),
    Action("theme"),
    Action("closure"),
    Action("back"),
    Action("list"),
    Action("zoom", (2.0, 0.0, 0.0)),
    Action("mechanism", 1),
    CHART,
)
"""Actions, five frames apart: each begins while the one before is on its way."""


def toured() -> list[State]:
    """Return the states of a tour, frame by frame."""
    state = begin(load("crank-rocker"))
    states = [state]
    for action in TOUR:
        for n in range(5):
            state = advance(state, [action] if n == 0 else [])
            states.append(state)
    return states


def coloured(frame: Frame) -> bytes:
    """Return a frame's bytes without those that have no meaning: the fourth of each pixel."""
    return np.frombuffer(frame, np.uint8).reshape(-1, 4)[:, :3].tobytes()


@pytest.mark.slow
def test_the_frames_of_a_tape_are_the_same_in_any_order_and_from_a_fresh_painter() -> None:
    actions = [(1 + 5 * n, action) for n, action in enumerate(TOUR)]
    tape = Tape(begin(load("crank-rocker")), 5 * len(TOUR) + 30, tuple(actions))
    count = round(tape.seconds * 25)
    in_order = TapeFrames(tape, 25.0, (320, 180))
    frames = [coloured(in_order.draw(n)) for n in range(count)]
    assert len({*frames}) > count // 2
    shuffled = TapeFrames(tape, 25.0, (320, 180))
    for n in random.Random(1).sample(range(count), count):
        assert coloured(shuffled.draw(n)) == frames[n], n
    for n in (3, 11, 17, 25):
        assert coloured(TapeFrames(tape, 25.0, (320, 180)).draw(n)) == frames[n], n


@pytest.mark.slow
def test_equal_states_are_equal_pictures() -> None:
    with display.opened((320, 180)):
        states = toured()
        whole, seen = Screen(states[0]), list[bytes]()
        for state in states:
            whole.show(state)
            seen.append(pygame.image.tobytes(display.display_surface(), "RGB"))
        for n in range(1, len(states), 4):
            Screen(states[n]).show(states[n])
            assert pygame.image.tobytes(display.display_surface(), "RGB") == seen[n], n


def test_a_blank_sheet_keeps_its_picture_also_with_instant_centres() -> None:
    state = advance(begin(load("crank-rocker")), [Action("centres")])
    framing = Framing(window=True)
    framing.fitting(state, (640, 360))
    blank = advance(state, [Action("poses")])
    assert blank.sketch is not None
    assert blank.sketch.is_blank
    once = framing.fitting(blank, (640, 360))
    assert framing.fitting(blank, (640, 360)) is once


@pytest.mark.slow
def test_while_a_length_changes_all_stands_where_it_did_and_is_placed_anew_once_that_is_over() -> None:
    """However often the key repeats: no frame of it weighs where the names would be best."""
    framing, size = Framing(window=True), (640, 360)
    state = advance(begin(load("crank-rocker"), look=Look(names=2)), [Action("edit")])
    for _ in range(MOVE_FRAMES):
        state = advance(state)
    before = framing.fitting(state, size)
    for _ in range(3):
        state = advance(advance(state, [Action("nudge", 5)]))
        shown = framing.at(state, size)
        assert shown.view == before.view
        assert [one.anchor for one in shown.names.labels] == [one.anchor for one in before.names.labels]
    for _ in range(2 * MOVE_FRAMES + 1):
        state = advance(state)
    assert (state.glide, state.departures) == (None, ())
    assert (
        framing.at(state, size).view
        == Picture(state.scene, size, state.look, docked=LIST).view
        != before.view
    )
