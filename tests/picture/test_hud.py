"""The HUD's words."""

from __future__ import annotations

import math

import numpy as np
import pytest
from pictures import inked, place_of

from linkanim.mechanics.forces import input_effort
from linkanim.picture.arrangement import FitRequest, fitted
from linkanim.picture.hud import Hud, Reading, note, rows
from linkanim.picture.items import Group
from linkanim.picture.look import Look
from linkanim.picture.overlay import Overlay
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import printed
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene


def test_the_press_tells_angle_speed_spring_and_damper() -> None:
    scene = load("press")
    pose = scene.pose(math.radians(87))
    told = dict(rows(scene, pose))
    assert list(told) == [
        "crank angle",
        "input speed",
        "return spring, length",
        "spring force",
        "cushion damper, rate",
        "damper force",
        "input torque",
    ]
    assert told["crank angle"] == "87.0°"
    assert told["input speed"] == "20 rpm"
    spring, damper = pose.spring["return"], pose.damper["cushion"]
    assert told["return spring, length"] == f"{spring.length:.1f} mm"
    assert told["spring force"].replace("−", "-") == f"{spring.force:.1f} N"
    assert told["cushion damper, rate"].replace("−", "-") == f"{damper.rate:.1f} mm/s"
    assert told["damper force"].replace("−", "-") == f"{damper.force:.1f} N"
    torque = input_effort(pose)
    assert told["input torque"].replace("−", "-") == f"{torque:.2f} N m"


def _hud(name: str) -> Hud:
    type_ = Type()
    found = fitted(load(name), None, FitRequest((640, 360), False, 0, True), type_).arrangement
    assert found.layout.hud
    assert found.block
    return Hud(load(name), found.block, found.layout.hud, type_, LIGHT)


def test_all_its_words_are_drawn() -> None:
    hud, surface = _hud("press"), offscreen((640, 360))
    pose = hud.scene.pose(1.0)
    surface.fill(LIGHT.background)
    printed(surface, [Group("words", (), [*hud.still(), *hud.values(pose)])], hud.type)
    lines = [*hud.still(), *hud.values(pose)]
    assert len(lines) > 8
    for line in lines:
        assert inked(surface, place_of(line, hud.type), line.colour), line.text


def test_the_class_stands_right_below_the_title() -> None:
    title, said, *_ = _hud("press").still()
    assert (title.strong, said.strong) == (True, False)
    assert 0 <= said.at[1] - title.at[1] - title.size < 0.5 * said.size


# nothing lies on the words, and what they do not need is left to the linkage
@pytest.mark.parametrize("vectors", [0, 2])
@pytest.mark.parametrize("name", ["press", "excavator"])
def test_words_take_the_room_that_they_stand_in(name: str, vectors: int) -> None:
    scene, type_ = load(name), Type()
    found = fitted(scene, None, FitRequest((640, 360), False, vectors, True), type_).arrangement
    layout = found.layout
    assert layout.hud
    assert found.block
    hud = Hud(scene, found.block, layout.hud, type_, LIGHT)
    lines = [*hud.still(), *hud.values(scene.pose(1.0))]
    assert found.block.rows
    for line in lines:
        place = place_of(line, type_)
        assert any(
            one.holds(place.x, place.y) and one.holds(place.right, place.bottom) for one in layout.words
        ), line.text
    *_, last = layout.words
    assert last.bottom == pytest.approx((layout.legend or layout.hud).bottom)


@pytest.mark.parametrize("noted", [False, True])
def test_what_is_special_is_said_where_it_is_asked_for(noted: bool) -> None:
    scene, surface = load("double-rocker"), offscreen((640, 360))
    picture, pose = Picture(scene, (640, 360), Look()), scene.pose(0.0)
    words = [line for group in picture.groups(pose, Overlay(noted=noted)) for line in group.captions]
    assert any(line.text.startswith("near the limit") for line in words) is noted
    printed(surface, [Group("words", (), words)], picture.type)


# the key to the arrows is backed with the words
@pytest.mark.parametrize("vectors", [frozenset(), frozenset("va")])
@pytest.mark.parametrize("zoom", [1.0, 1.5])
def test_words_over_the_scene_are_backed_all_round(zoom: float, vectors: frozenset[str]) -> None:
    scene = load("press")
    picture = Picture(scene, (640, 360), Look(zoom=zoom, vectors=vectors))
    hud, key = picture.layout.hud, picture.layout.legend
    assert hud
    edge = hud.inset(-3.0)
    backings = [group for group in picture.groups(scene.pose(1.0)) if group.name == "backing"]
    assert len(backings) == (zoom > 1)
    for group in backings:
        corners = np.concatenate(list(group.layers[0].loops))
        assert corners.real.min() < edge.x < edge.right < corners.real.max()
        assert corners.imag.min() < edge.y < (key or hud).bottom + 3 < corners.imag.max()


def test_a_cylinder_that_keeps_its_length_is_no_damper() -> None:
    scene = load("excavator")
    told = dict(rows(scene, scene.pose(1.0)))
    assert (told["stick cylinder, length"], told["bucket cylinder, length"]) == ("235.0 cm", "205.0 cm")
    assert told["driving cylinder"] == f"{182.5 - 32.5 * math.cos(1.0):.1f} cm"
    assert not any("damper" in label for label in told)


def test_a_cylinder_is_told_by_its_length() -> None:
    scene = load("excavator")
    told = dict(rows(scene, scene.pose(0.0)))
    assert (told["stick cylinder, length"], told["bucket cylinder, length"]) == ("235.0 cm", "205.0 cm")
    assert told["driving cylinder"] == "150.0 cm"
    assert dict(rows(scene, scene.pose(math.pi)))["driving cylinder"] == "215.0 cm"


def test_a_swinging_input_tells_its_two_limits() -> None:
    scene = load("double-rocker")
    assert Reading("input range", "13.8°…108.4°") in rows(scene, scene.pose(1.0))


def test_a_linkage_that_needs_two_turns_says_so() -> None:
    scene = load("kite")
    assert Reading("true period", "2 turns") in rows(scene, scene.pose(1.0))


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_names_of_the_rows_stay_while_the_values_move(name: str) -> None:
    scene = load(name)
    told = [[row.label for row in rows(scene, scene.pose(phase))] for phase in (0.0, 1.0, math.pi, 5.0)]
    assert all(labels == told[0] for labels in told)


@pytest.mark.parametrize(
    ("angle_deg", "told"),
    [
        (0.0, "0.0°"),
        (60.0, "60.0°"),
        # just below a full turn is not shown as 360.0
        (359.99, "0.0°"),
        (-0.01, "0.0°"),
        # many turns later, and backwards
        (360 * 1000 + 10, "10.0°"),
        (-70, "290.0°"),
    ],
)
def test_the_crank_angle_is_within_one_turn(angle_deg: float, told: str) -> None:
    scene = load("crank-rocker")
    phase = math.radians(angle_deg) - scene.linkage.drive.start
    assert dict(rows(scene, scene.pose(phase)))["crank angle"] == told


SIZES = [(320, 180), (480, 270), (640, 360), (1280, 720), (400, 800)]


# every scene at two sizes, one of them small, all sizes by many scenes
@pytest.mark.thinned(4)
@pytest.mark.parametrize(
    ("name", "size"),
    [(name, size) for k, name in enumerate(names()) for size in (SIZES[k % 2], SIZES[2 + k % 3])],
)
@pytest.mark.sampled
def test_names_and_values_never_touch_at_any_speed(name: str, size: tuple[int, int]) -> None:
    scene, type_ = load(name), Type()
    arrangement = fitted(scene, None, FitRequest(size, True, 2, True), type_).arrangement
    block, key = arrangement.block, arrangement.layout.legend
    assert block is not None
    for speed in (1.0, -10.0):
        for phase in np.linspace(0, scene.period, 12, endpoint=False):
            pose = scene.pose(float(phase), speed=speed * scene.linkage.drive.speed)
            for row in (row for row in rows(scene, pose) if row.label in block.rows):
                words = type_.width(row.label, block.size) + type_.width(row.value, block.size, strong=True)
                assert words <= block.column - 0.5 * block.size
            told = type_.wrapped(note(scene, pose).words, block.size, block.column)
            assert not key or block.note + 1.2 * block.size * len(told) <= block.key


def stated(speed: str, name: str = "press") -> Scene:
    """Return a scene of the catalogue that states its speed otherwise."""
    scene = load(name)
    drive = {**scene.document["drive"], "speed": speed}
    return scene_from({**scene.document, "drive": drive}, name=name, where=name)


@pytest.mark.parametrize(
    ("name", "driven"),
    [
        # a bar that turns, with and without a name of its own
        ("crank-rocker", "crank"),
        ("press", "crank"),
        # the other end drives
        ("rocker-driven", "rocker"),
        # what swings is no crank, and there is another rocker
        ("double-rocker", "input rocker"),
        ("triple-rocker", "input rocker"),
    ],
)
def test_the_angle_is_that_of_the_driven_bar_by_its_name(name: str, driven: str) -> None:
    scene = load(name)
    assert rows(scene, scene.pose(1.0))[0].label == f"{driven} angle"


@pytest.mark.parametrize(
    ("speed", "told"),
    [
        ("20 rpm", "20 rpm"),
        ("-15 rpm", "−15 rpm"),
        ("2.5 rad/s", "2.5 rad/s"),
        ("120 deg/s", "120 °/s"),
        ("-90 °/s", "−90 °/s"),
    ],
)
def test_the_speed_is_told_in_the_unit_that_the_scene_states(speed: str, told: str) -> None:
    scene = stated(speed)
    assert Reading("input speed", told) in rows(scene, scene.pose(1.0))


def test_the_speed_is_the_pose_s_own() -> None:
    scene = stated("2.5 rad/s")
    assert Reading("input speed", "−5 rad/s") in rows(scene, scene.pose(0.0, speed=-5.0))


@pytest.mark.parametrize("speed", ["15 rpm", "-15 rpm", "90 deg/s"])
def test_a_swing_tells_how_often_it_does_and_its_angular_velocity(speed: str) -> None:
    scene = stated(speed, "double-rocker")
    unit, per_radian = ("°/s", 180 / math.pi) if "deg" in speed else ("rpm", 30 / math.pi)
    for phase in (0.0, 1.0, 4.0):
        pose = scene.pose(phase)
        told = dict(rows(scene, pose))
        assert told["input rate"] == "15 swings/min"
        rate, _, after = told["angular velocity"].partition(" ")
        wanted = scene.solve(phase=[phase]).angular_velocity["crank"][0] * per_radian
        assert after == unit
        assert float(rate.replace("−", "-")) == pytest.approx(wanted, abs=0.051)
        assert len(rate.partition(".")[2]) == 1


@pytest.mark.parametrize(
    ("name", "phase", "told"),
    [
        # at the limits of a swing, from either side, and a turn of phase later
        ("double-rocker", 0.0, "near the limit 13.8°"),
        ("double-rocker", -0.1, "near the limit 13.8°"),
        ("double-rocker", math.pi + 0.1, "near the limit 108.4°"),
        ("double-rocker", 3 * math.pi, "near the limit 108.4°"),
        ("double-rocker", math.pi / 2, None),
        # change points of a turning input
        ("kite", -load("kite").linkage.drive.start, "near the change point 0.0°"),
        ("kite", 1.5 - load("kite").linkage.drive.start, None),
        # nothing special about a crank-rocker
        ("crank-rocker", 0.0, None),
    ],
)
def test_limits_and_change_points_are_told_where_they_are_near(
    name: str, phase: float, told: str | None
) -> None:
    scene = load(name)
    words, eighths = note(scene, scene.pose(phase, speed=0.5))
    assert (words if eighths == 8 else None) == told
    assert eighths in (0, 8)


@pytest.mark.parametrize("speed", [1.0, 0.1, 10.0, -1.0])
@pytest.mark.parametrize("name", ["kite", "antiparallelogram", "double-rocker", "triple-rocker-in-in"])
def test_a_note_comes_and_goes_calmly(name: str, speed: float) -> None:
    """At 60 frames a second it never jumps, not even from one point to the next."""
    scene = load(name)
    rate = speed * scene.linkage.drive.speed
    frames = range(round(60 * scene.period / abs(rate)))
    told = [note(scene, scene.pose(rate * frame / 60, speed=rate)) for frame in frames]
    for one, after in zip(told, told[1:] + told[:1], strict=True):
        assert abs(after.eighths - one.eighths) <= 1
        assert one.words == after.words or one.eighths + after.eighths <= 1
    assert {one.eighths for one in told} == ({0} if abs(speed) > 1 else set(range(9)))


def test_a_paused_note_stands_still_at_the_speed_that_is_set() -> None:
    scene = load("kite")
    assert note(scene, scene.pose(0.3, speed=0.0)).eighths in range(9)
