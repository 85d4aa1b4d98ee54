"""What is under the mouse tells itself, in numbers of the solver; an instant on chart and trace."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pygame
import pytest
from playing import Player, menu_in

from linkanim.picture.figure import figure
from linkanim.picture.hover import HoverArrows
from linkanim.picture.layout import Docked
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.listing import Listing
from linkanim.player.state import State, begin
from linkanim.scenes import load
from linkanim.scenes.scene import Scene
from linkanim.ui import screen
from linkanim.ui.panels import words_at_foot
from linkanim.ui.pictures import beside, lasting
from linkanim.ui.pointing import AtMouse, Pointed, PointedThing, hover_words, thing_at


def number(text: str) -> float:
    return float(text.replace("−", "-"))


def standing(name: str, phase: float = 1.0, look: Look | None = None) -> State:
    return advance(begin(load(name), look=look), [Action("scrub", phase)])


def lines_of(state: State, thing: PointedThing) -> tuple[str, ...]:
    found = hover_words(state, Pointed((0.0, 0.0), thing))
    assert found
    return found


def test_a_joint_tells_its_place_speed_and_acceleration() -> None:
    state = standing("crank-rocker")
    pose = state.scene.pose(1.0, speed=state.clock.speed)
    place, rates = lines_of(state, PointedThing("joint", "P"))
    x, y = place.removeprefix("P (").removesuffix(") mm").split(", ")
    assert (number(x), number(y)) == pytest.approx(pose.position["P"], rel=1e-3)
    words = rates.split()
    assert number(words[2]) == pytest.approx(math.hypot(*pose.velocity["P"]), rel=1e-3)
    assert number(words[6]) == pytest.approx(math.hypot(*pose.acceleration["P"]), rel=1e-3)
    assert (words[3], words[7]) == ("mm/s", "mm/s²")


def test_a_link_tells_its_length_angle_and_angular_speed() -> None:
    state = standing("crank-rocker")
    pose = state.scene.pose(1.0, speed=state.clock.speed)
    rate, span = lines_of(state, PointedThing("link", "rocker"))
    assert rate.startswith("rocker: ω = ")
    assert number(rate.split()[3]) == pytest.approx(pose.angular_velocity["rocker"], rel=1e-3)
    assert number(span.split()[0]) == pytest.approx(
        math.dist(pose.position["B"], pose.position["O4"]), rel=1e-3
    )
    assert number(span.split()[3].rstrip("°")) == pytest.approx(
        math.degrees(pose.angle["rocker"]) % 360, rel=1e-3
    )


# What vanishes, but for rounding: the scene, the phase, the thing and its two lines.
VANISHING = {
    "a link that never turns": (
        ("wiper", 1e-12, PointedThing("link", "link")),
        ("link: ω = 0 rad/s", "260 mm at 0°"),
    ),
    "a crank a hair before a whole turn": (
        ("crank-rocker", math.tau - 1e-15, PointedThing("link", "crank")),
        ("crank: ω = 2.094 rad/s", "50 mm at 0°"),
    ),
    "a fixed pin": (
        ("crank-rocker", 1.0, PointedThing("joint", "O4")),
        ("O4 (100, 0) mm", "v = 0 mm/s   a = 0 mm/s²"),
    ),
}


@pytest.mark.parametrize(("at", "lines"), VANISHING.values(), ids=VANISHING)
def test_what_is_nothing_but_rounding_is_told_as_0(
    at: tuple[str, float, PointedThing], lines: tuple[str, str]
) -> None:
    name, phase, thing = at
    assert lines_of(standing(name, phase), thing) == lines


def test_a_spring_tells_its_length_and_force() -> None:
    state = standing("press")
    spring = state.scene.pose(1.0, speed=state.clock.speed).spring["return"]
    (line,) = lines_of(state, PointedThing("strut", "return"))
    assert number(line.split()[1]) == pytest.approx(spring.length, rel=1e-3)
    assert number(line.split()[3]) == pytest.approx(spring.force, rel=1e-3)


def middle_of(scene: Scene, phase: float, *joints: str) -> tuple[float, float]:
    places = [scene.pose(phase, 0).position[joint] for joint in joints]
    return sum(x for x, _ in places) / len(places), sum(y for _, y in places) / len(places)


# What lies where: the scene, the joints in whose middle the mouse is, and what that is.
WHERE = {
    "a joint before its links": ("crank-rocker", ("B",), PointedThing("joint", "B")),
    "a fixed pin": ("crank-rocker", ("O4",), PointedThing("joint", "O4")),
    "a bar": ("crank-rocker", ("B", "O4"), PointedThing("link", "rocker")),
    "a plate": ("crank-rocker", ("A", "B", "P"), PointedThing("link", "coupler")),
    "a spring": ("press", ("C", "G"), PointedThing("strut", "return")),
}


@pytest.mark.parametrize(("name", "joints", "thing"), WHERE.values(), ids=WHERE)
def test_the_thing_under_the_mouse_is_found(name: str, joints: tuple[str, ...], thing: PointedThing) -> None:
    scene = load(name)
    at = middle_of(scene, 1.0, *joints)
    assert thing_at(figure(scene), scene.pose(1.0, 0), at, 3.0, 3.0) == thing


def test_beside_the_linkage_there_is_nothing() -> None:
    scene = load("crank-rocker")
    assert thing_at(figure(scene), scene.pose(1.0, 0), (-200.0, -200.0), 3.0, 3.0) is None


def test_it_is_in_no_screenshot() -> None:
    state = standing("crank-rocker")
    at_joint = AtMouse(pointed=Pointed((0.0, 0.0), PointedThing("joint", "P")))
    assert any(isinstance(one, HoverArrows) for one in beside(state, at_joint).drawn)
    assert not any(isinstance(one, HoverArrows) for one in lasting(state).drawn)


@pytest.mark.parametrize(("joint", "count"), [("O2", 0), ("A", 2), ("B", 2)])
def test_a_joint_has_its_two_arrows_and_its_words_stand_at_the_foot(joint: str, count: int) -> None:
    state = standing("crank-rocker")
    picture = Picture(state.scene, (640, 360), Look(), docked=Docked(bar=True))
    pose, _ = picture.poses(1.0)
    place = pose.position[joint]
    at_joint = AtMouse(pointed=Pointed(place, PointedThing("joint", joint)))
    groups = picture.groups(pose, beside(state, at_joint))
    (arrows,) = (group for group in groups if group.name == "hover-arrows")
    assert not arrows.captions
    assert len(arrows.layers) == 2 * count  # each on a rim
    for layer in arrows.layers:
        away = np.abs(np.concatenate(layer.loops) - picture.view.pixel(place))
        assert away.min() < 3 * picture.gauge.line
    state = replace(state, chip=None)
    words, _ = words_at_foot(state, at_joint) or ("", "")
    assert words.split("   ·   ") == [*hover_words(state, at_joint.pointed)]


@pytest.fixture
def player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    monkeypatch.chdir(tmp_path)
    with screen.opened((640, 360)):
        player = Player(standing("crank-rocker", look=Look(chart="P.velocity")))
        player.tick(5)
        yield player
        player.window.close()


def move(player: Player, at: tuple[float, float]) -> None:
    player.mouse(pygame.MOUSEMOTION, at, rel=(0, 0), buttons=(0, 0, 0))


def instant_in(shown: screen.Screen) -> float | None:
    """Return the phase at which the mouse points."""
    return beside(shown.state, shown.mouse).instant


def test_the_trace_and_the_chart_point_at_one_instant(player: Player) -> None:
    shown = player.window.screen
    place = player.state.scene.pose(2.5, 0).position["P"]
    move(player, shown.pixel(*place))
    assert instant_in(shown) == pytest.approx(2.5, abs=0.05)
    assert hover_words(shown.state, shown.mouse.pointed)
    assert hover_words(shown.state, shown.mouse.pointed)[0].startswith("crank angle 14")
    area = shown.last._chart.panels[0].plot.area  # type: ignore[union-attr]
    move(player, (area.x + area.width / 4, area.y + area.height / 2))
    assert instant_in(shown) == pytest.approx(math.pi / 2, abs=0.05)


def test_pressed_on_the_trace_its_joint_comes_there(player: Player) -> None:
    shown = player.window.screen
    at = shown.pixel(*player.state.scene.pose(2.5, 0).position["P"])
    player.mouse(pygame.MOUSEBUTTONDOWN, at, button=1)
    assert player.state.phase == pytest.approx(2.5, abs=0.05)
    player.mouse(pygame.MOUSEBUTTONUP, at, button=1)
    assert player.state.clock.paused


def test_a_mouse_that_rests_over_what_runs_reads_nothing_more(player: Player) -> None:
    shown = player.window.screen
    move(player, shown.pixel(*player.state.scene.pose(1.0, 0).position["O4"]))
    assert hover_words(shown.state, shown.mouse.pointed)
    player.tick(400)
    assert hover_words(shown.state, shown.mouse.pointed)  # it stands
    player.press(pygame.K_SPACE)
    player.tick(2)
    assert not hover_words(shown.state, shown.mouse.pointed)


@pytest.fixture
def rows_shown(here: Path) -> Iterator[Player]:
    del here
    with screen.opened((1280, 720)):
        player = Player(standing("press"))
        player.settle()
        yield player
        player.window.close()


def row_of(player: Player, label: str) -> tuple[float, float]:
    places = (one.place for one in player.window.screen.targets("reading") if one.value == label)
    return 40.0, next(places).middle.imag


def click(player: Player, at: tuple[float, float]) -> None:
    player.mouse(pygame.MOUSEMOTION, at, rel=(0, 0), buttons=(0, 0, 0))
    player.drag(at)


def charts(player: Player) -> list[str]:
    return [one for one in [player.state.look.chart] if one]


@pytest.mark.slow
def test_a_row_of_numbers_charts_its_quantity_and_puts_that_away(rows_shown: Player) -> None:
    for label, token in (
        ("spring force", "return.force"),
        ("input torque", "input.torque"),
        ("crank angle", "2.angle"),
    ):
        click(rows_shown, row_of(rows_shown, label))
        assert charts(rows_shown) == [token]
        assert token in rows_shown.state.scene.quantities
        rows_shown.settle()
        click(rows_shown, row_of(rows_shown, label))
        rows_shown.settle()
        assert charts(rows_shown) == []


def test_the_row_of_the_speed_is_dragged_and_the_wheel_turns_it(rows_shown: Player) -> None:
    x, y = row_of(rows_shown, "input speed")
    rows_shown.drag((x, y), (x - 60, y))
    slower = rows_shown.state.clock.level
    assert slower < 0
    rows_shown.mouse(pygame.MOUSEMOTION, (x, y), rel=(0, 0), buttons=(0, 0, 0))
    pygame.event.post(pygame.event.Event(pygame.MOUSEWHEEL, x=0, y=2, flipped=False))
    rows_shown.tick()
    assert (rows_shown.state.clock.level, rows_shown.state.look.zoom) == (slower + 2, 1.0)


def test_the_class_says_why_it_is_that(here: Path) -> None:
    del here
    with screen.opened((1280, 720)):
        player = Player(standing("crank-rocker"))
        player.settle()
        at = row_of(player, "")
        player.mouse(pygame.MOUSEMOTION, at, rel=(0, 0), buttons=(0, 0, 0))
        words = hover_words(player.state, player.window.screen.mouse.pointed)
        assert "s + l = 150 < p + q = 165" in words
        player.drag(at)
        player.tick()
        assert player.state.toast
        assert "s + l = 150" in player.state.toast.text
        player.window.close()


def test_a_right_click_on_a_row_of_numbers_lists_all_commands(rows_shown: Player) -> None:
    rows_shown.mouse(pygame.MOUSEBUTTONDOWN, row_of(rows_shown, "spring force"), button=3)
    assert rows_shown.state.of(Listing)
    assert menu_in(rows_shown.state).title == "Commands"


def test_every_row_of_numbers_is_under_the_mouse_at_its_place(rows_shown: Player) -> None:
    picture = rows_shown.window.screen.last
    assert picture._hud
    assert picture.composition.block.rows
    for label in picture.composition.block.rows:
        _, y = row_of(rows_shown, label)
        caption = next(one for one in picture._hud.still.captions if one.text == label)
        assert abs(caption.at[1] + 0.5 * caption.size - y) <= 0.5 * caption.size


def test_a_click_on_a_polygon_makes_it_large_and_another_shows_both(player: Player) -> None:
    player.press(pygame.K_p)
    shown = player.window.screen
    for order in (1, 2):
        player.settle()
        places = {one.value: one.place.middle for one in shown.targets("polygon")}
        assert sorted(places) == [1, 2]
        player.drag((places[order].real, places[order].imag))
        assert player.state.look.large_polygon == order
        player.settle()
        (alone,) = shown.targets("polygon")
        player.drag((alone.place.middle.real, alone.place.middle.imag))
        assert player.state.look.large_polygon == 0
    player.press(pygame.K_p, pygame.KMOD_LSHIFT)
    assert player.state.look.large_polygon == 1
    player.press(pygame.K_p)  # off
    player.press(pygame.K_p)
    assert (player.state.look.polygons, player.state.look.large_polygon) == (True, 0)
