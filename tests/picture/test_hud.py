"""The HUD's words."""

from __future__ import annotations

import math
from itertools import groupby, pairwise

import numpy as np
import pytest
from pictures import inked

from linkanim.mechanics.forces import input_effort
from linkanim.picture.hud import Hud, Reading, columns, note, rows, special_places, widest_rows
from linkanim.picture.items import Group
from linkanim.picture.layout import layout
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import printed
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.scenes import load, names
from linkanim.scenes.editing import beyond_title
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
    found = Picture(load(name), (640, 360), Look())._hud
    assert found
    return found


def test_all_its_words_are_drawn() -> None:
    hud, surface = _hud("press"), offscreen((640, 360))
    pose = hud.scene.pose(1.0)
    surface.fill(LIGHT.background)
    lines = [*hud.still.captions, *hud.values(pose)]
    printed(surface, [Group("words", (), lines)], hud.type)
    assert len(lines) > 8
    for line in lines:
        assert inked(surface, line.around(hud.type), line.colour), line.text


def test_the_class_stands_right_below_the_title() -> None:
    title, said, *_ = _hud("press").still.captions
    assert (title.strong, said.strong) == (True, False)
    assert 0 <= said.at[1] - title.at[1] - title.size < 0.5 * said.size


@pytest.mark.parametrize("noted", [False, True])
def test_what_is_special_is_said_where_it_is_asked_for(noted: bool) -> None:
    scene, surface = load("double-rocker"), offscreen((640, 360))
    picture, pose = Picture(scene, (640, 360), Look(), noted=noted), scene.pose(0.0)
    words = [line for group in picture.groups(pose) for line in group.captions]
    assert any(line.text.startswith("near the limit") for line in words) is noted
    printed(surface, [Group("words", (), words)], picture.type)


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
    picture = Picture(scene, size, Look(chart=scene.telling[0], vectors=frozenset("va")))
    block, place = picture.composition.block, picture.layout.hud
    if place is None:
        return
    for speed in (1.0, -10.0):
        for phase in np.linspace(0, scene.period, 12, endpoint=False):
            pose = scene.pose(float(phase), speed=speed * scene.linkage.drive.speed)
            for row in (row for row in rows(scene, pose) if row.label in block.rows):
                words = type_.width(row.label, block.size) + type_.width(row.value, block.size, strong=True)
                assert words <= place.width - 0.5 * block.size
            words_near = note([*special_places(scene)], pose) if block.rows else ""
            told = type_.wrapped(words_near, block.size, place.width) if words_near else ()
            assert block.note + 1.2 * block.size * len(told) <= block.key + 1e-9


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
        ("double-rocker", math.pi / 2, ""),
        # change points of a turning input
        ("kite", -load("kite").linkage.drive.start, "near the change point 0.0°"),
        ("kite", 1.5 - load("kite").linkage.drive.start, ""),
        # nothing special about a crank-rocker
        ("crank-rocker", 0.0, ""),
    ],
)
def test_limits_and_change_points_are_told_where_they_are_near(name: str, phase: float, told: str) -> None:
    scene = load(name)
    assert note([*special_places(scene)], scene.pose(phase, speed=0.5)) == told


@pytest.mark.parametrize(("speed", "seen"), [(1.0, True), (0.1, True), (10.0, False), (-1.0, True)])
@pytest.mark.parametrize("name", ["kite", "antiparallelogram", "double-rocker", "triple-rocker-in-in"])
def test_a_note_stands_long_enough_to_be_read(name: str, speed: float, seen: bool) -> None:
    """Half a second at the least; where notes would follow each other faster, there is none."""
    scene = load(name)
    rate = speed * scene.linkage.drive.speed
    frames = range(round(60 * scene.period / abs(rate)))
    special = [*special_places(scene)]
    told = [note(special, scene.pose(rate * frame / 60, speed=rate)) for frame in frames]
    first = next((n for n, words in enumerate(told) if words != told[-1]), 0)
    runs = [(words, len([*run])) for words, run in groupby(told[first:] + told[:first])]
    assert any(words for words, _ in runs) == seen
    assert all(long >= 30 for words, long in runs if words)


@pytest.mark.parametrize(
    ("title", "class_name", "rest"),
    [
        # the title says it all, in the same words or in others
        ("Grashof double-rocker", "Grashof double-rocker", ""),
        ("Triple-rocker, inward-outward", "triple-rocker (inward/outward)", ""),
        ("Parallelogram", "parallelogram", ""),
        # it says a part
        ("Crank-rocker", "Grashof crank-rocker", "Grashof"),
        ("Kite", "kite (change point)", "change point"),
        ("Drag link", "Grashof drag-link (double crank)", "Grashof (double crank)"),
        ("Six-bar: two in series", "six-bar: crank-rocker, then kite", "crank-rocker, then kite"),
        # "linkage" alone says nothing
        ("Stephenson's six-bar, second kind", "six-bar linkage", ""),
        # nothing, or half a word
        ("My machine", "Grashof crank-rocker", "Grashof crank-rocker"),
        ("A rocker of mine", "Grashof crank-rocker", "Grashof crank-rocker"),
        # what is left would be no phrase
        (
            "Oscillating cylinder",
            "inverted slider-crank, swinging cylinder",
            "inverted slider-crank, swinging cylinder",
        ),
        (
            "Press pushed by a slider",
            "six-bar linkage driven by a slider",
            "six-bar linkage driven by a slider",
        ),
    ],
)
def test_class_and_title_do_not_repeat_each_other(title: str, class_name: str, rest: str) -> None:
    assert beyond_title(title, class_name) == rest


def test_of_too_many_words_those_that_matter_least_go_first() -> None:
    """The rows by their ranks, with the lowest of them the class, then the key, then the title; no list."""
    scene, type_ = load("press"), Type()
    rows = widest_rows((scene,), type_)
    blocks = [*columns((scene,), rows, layout((640, 360)), type_, keys=2, listed=("r₁ = 1 mm",))]
    assert len(blocks[0].rows) == len(rows)
    assert all(later.rows <= one.rows for one, later in pairwise(blocks))
    assert all(later.height <= one.height for one, later in pairwise(blocks))
    kept = [{rank for rank, row in rows if row.label in block.rows} for block in blocks]
    for before, after in pairwise(kept):
        assert not before - after or max(after, default=-1) < min(before - after)
    with_key, titled, listed, nothing = blocks[-4:]
    assert with_key.title == titled.title != ()
    assert with_key.height - with_key.key > titled.height - titled.key > 0
    assert not listed.title
    assert listed.height == pytest.approx(titled.height - titled.key)
    assert (nothing.width, nothing.height) == (0, 0)
