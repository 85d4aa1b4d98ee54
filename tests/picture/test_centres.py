"""Instant centres and centrodes on the picture."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest
from few_links import drawn

from linkanim.mechanics.centres import touch
from linkanim.picture.centres import CentrePairs, Centres, clipped, kennedy_line
from linkanim.picture.drawing import Drawing
from linkanim.picture.figure import figure
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.text import subscripted
from linkanim.picture.view import Rect
from linkanim.scenes import load, names
from linkanim.units import three_digits


def drawing(name: str, centres: int) -> Drawing:
    look = Look(hud=False, centres=centres)
    return Picture(load(name), (640, 360), look).drawing


def found(name: str, centres: int = 2) -> Centres:
    marks = drawing(name, centres).centres
    assert marks is not None
    return marks


# scene, all that have names: of few links all pairs, those of a block without a name too, else the ground's
MARKED = [
    ("crank-rocker", ["P_{12}", "P_{13}", "P_{14}", "P_{23}", "P_{24}", "P_{34}"]),
    ("slider-crank", ["P_{12}", "P_{13}", "P_{14}", "P_{23}", "P_{24}", "P_{34}"]),
    ("inverted-slider-crank", ["P_{12}", "P_{13}", "P_{14}", "P_{23}", "P_{24}", "P_{34}"]),
    ("geared-five-bar-2-1", [f"P_{{{a}{b}}}" for a, b in combinations("12345", 2)]),
    ("press", ["P_{12}", "P_{15}", "P_{17}"]),
]


@pytest.mark.parametrize(("name", "labels"), MARKED)
def test_the_pairs_of_links(name: str, labels: list[str]) -> None:
    assert sorted(found(name).known.pairs.values()) == labels


def words_of(picture: Picture, phase: float) -> list[str]:
    pose = picture.scene.pose(phase, 2)
    return [line.text for group in picture.groups(pose) for line in group.captions]


@pytest.mark.thinned(5)
@pytest.mark.parametrize(("name", "labels"), MARKED)
@pytest.mark.parametrize("phase", [0.0, 0.7, 2.1, 4.0])
@pytest.mark.parametrize("names", [0, 1])
def test_each_centre_has_its_name_wherever_it_lies(
    name: str, labels: list[str], phase: float, names: int
) -> None:
    picture = Picture(load(name), (1280, 720), Look(hud=False, centres=1, names=names), moment=phase)
    said = ", ".join(words_of(picture, phase))
    assert {label for label in labels if label not in said} == set()


@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank", "drag-link", "inverted-slider-crank"])
def test_a_still_holds_the_centres_near_its_linkage_and_tells_of_the_others(name: str) -> None:
    scene = load(name)
    for phase in (0.2, 1.0, 2.2, 3.3, 5.0):
        picture = Picture(scene, (1280, 720), Look(hud=False, centres=1), moment=phase)
        box, said = picture.figure.box_of(scene.pose(phase, 2)), words_of(picture, phase)
        window, size = Rect(0, 0, 1280, 720), max(box.right - box.left, box.high - box.low)
        known = CentrePairs(picture.figure)
        for pair, label in known.pairs.items():
            place = known.of(scene.pose(phase, 2))[pair].place
            if place is None:
                assert f"{label}: at ∞" in said
                continue
            held = window.holds(*picture.view.to_pixel(place.real, place.imag))
            assert held or abs(place - complex(*box.middle)) > 0.6 * size
            assert held or any(line.startswith(f"{label}: ") and line.endswith("from O₂") for line in said)


@pytest.mark.parametrize("number", range(20))
def test_a_still_of_any_few_links_names_all_their_centres_and_each_at_its_place(number: int) -> None:
    scene = drawn(number)
    for phase in (0.3, 3.5):
        picture, pose = (
            Picture(scene, (1280, 720), Look(hud=False, centres=1, names=1), moment=phase),
            scene.pose(phase, 2),
        )
        known = CentrePairs(picture.figure)
        assert len(known.pairs) == math.comb(len(picture.figure.by_number), 2)
        lines = [line for group in picture.groups(pose) for line in group.captions]
        boxes = [line.around(picture.type) for line in lines]
        assert not any(one.inset(1).meets(other.inset(1)) for one, other in combinations(boxes, 2))
        for pair, label in known.pairs.items():
            place = known.of(pose)[pair].place
            if place is None:
                assert f"{label}: at ∞" in [line.text for line in lines]
                continue
            x, y = picture.view.to_pixel(place.real, place.imag)
            if not Rect(0, 0, 1280, 720).holds(x, y):  # an arrow leads there, named where it has room
                far = three_digits(abs(place - complex(*pose.position[picture.figure.fixed[0]])))
                assert f"{label}: {far} mm from O₂" in [line.text for line in lines]
                continue
            (box,) = (box for line, box in zip(lines, boxes, strict=True) if label in line.text.split(", "))
            assert Rect(0, 0, 1280, 720).holds(box.x, box.y)
            assert Rect(0, 0, 1280, 720).holds(box.right, box.bottom)
            off = max(box.x - x, x - box.right, 0), max(box.y - y, y - box.bottom, 0)
            assert np.hypot(*off) < 5.5 * picture.layout.small_size, label


def test_a_centre_out_of_sight_is_told_with_its_distance_and_an_arrow_along_the_way() -> None:
    scene, phase = load("crank-rocker"), 0.0
    picture = Picture(scene, (640, 360), Look(hud=False, centres=1, zoom=4.0), moment=None)
    known, pose = CentrePairs(picture.figure), scene.pose(phase, 2)
    place = known.of(pose)["1", "3"].place
    assert place is not None
    (told,) = [line for line in words_of(picture, phase) if line.startswith("P_{13}: ")]
    assert told == f"P_{{13}}: {three_digits(abs(place))} mm from O₂"


def test_kennedy_s_lines_run_through_their_three_centres() -> None:
    scene = load("geared-five-bar-2-1")
    picture = Picture(scene, (640, 360), Look(hud=False, centres=1))
    known, pose = CentrePairs(picture.figure), scene.pose(1.0, 2)
    centres = known.of(pose)
    assert len(known.steps) == 4
    for step in known.steps:
        for third in step.by:
            ends = kennedy_line(step.pair, third, centres, 1e3)
            assert ends is not None
            for pair in (step.pair, (step.pair[0], third), (third, step.pair[1])):
                centre = centres.get(pair) or centres[pair[::-1]]
                assert centre.place is not None
                off = ((centre.place - ends[0]) / (ends[1] - ends[0])).imag
                assert abs(off) < 1e-9


def test_what_is_a_joint_has_no_cross() -> None:
    picture = Picture(load("crank-rocker"), (640, 360), Look(hud=False, centres=1), moment=0.9)
    pose = picture.scene.pose(0.9, 2)
    (marked,) = [group for group in picture.groups(pose) if group.name == "instant-centres"]
    lines, marks = marked.layers
    assert picture.drawing.centres
    free = [seen for seen in picture.drawing.centres.seen(pose) if not seen.jointed]
    assert len(free) == 2
    assert len(marks.loops) == sum(1 if seen.direction else 2 for seen in free)
    assert lines.loops


@pytest.mark.parametrize("phase", [0.3, 1.1, 4.0])
def test_the_curves_touch_in_the_coupler_s_centre(phase: float) -> None:
    centres, scene = found("elliptic-trammel"), load("elliptic-trammel")
    places = drawing("elliptic-trammel", 2).places(scene.pose(phase))
    fixed, moving = (np.concatenate(layer.loops) for layer in (centres.fixed(), centres.moving(places)))
    nearest = np.abs(fixed[:, None] - moving[None, :]).min()
    assert nearest < 2 * centres.setting.gauge.line
    # the larger holds the smaller, which is half as large
    assert np.ptp(moving.real) == pytest.approx(np.ptp(fixed.real) / 2, rel=0.02)


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_no_curve_runs_across_the_picture(name: str) -> None:
    centres = found(name)
    places = drawing(name, 2).places(load(name).pose(0.4))
    room = centres.setting.layout.stage
    for layer in (centres.fixed(), centres.moving(places)):
        for loop in layer.loops:
            assert np.abs(np.diff(loop)).max() < 0.2 * room.width
            edge = 3 * centres.setting.gauge.line
            assert (-edge <= loop.real).all()
            assert (loop.real <= room.right + edge).all()
            assert (loop.imag <= room.bottom + edge).all()


# path, what of it lies in the square from 0 to 10
CLIPPED = [
    ([1, 5, 9], [[1, 5, 9]]),
    ([-5, 5, 15], [[0, 5, 10]]),
    ([5 + 5j, 5 + 15j, 7 + 15j, 7 + 5j], [[5 + 5j, 5 + 10j], [7 + 10j, 7 + 5j]]),
    ([-5, 15], []),
    ([1, np.nan, 9], [[1], [9]]),
]


@pytest.mark.parametrize(("path", "parts"), CLIPPED)
def test_a_path_is_cut_at_the_edge_and_at_breaks(path: list[complex], parts: list[list[complex]]) -> None:
    assert [list(run) for run in clipped(np.array(path, complex), Rect(0, 0, 10, 10))] == parts


def test_without_a_coupler_there_are_no_curves() -> None:
    centres = found("scotch-yoke")
    assert centres.fixed().loops == centres.moving({}).loops == []
    assert figure(load("scotch-yoke")).linkage is not None


# of each scene what its links are called: no two the same
@pytest.mark.parametrize("name", ["excavator", "landing-gear", "parallel-locomotive", "press", "jansen"])
@pytest.mark.parametrize("centres", [0, 1])
def test_no_two_links_are_called_the_same(name: str, centres: int) -> None:
    look = Look(hud=False, names=1, centres=centres)
    picture = Picture(load(name), (1280, 720), look, moment=1.0)
    figure_ = picture.figure
    joints = {subscripted(joint.name) for joint in figure_.linkage.joints}
    links = [label.text for label in picture.names.labels if label.text.partition(",")[0] not in joints]
    known = {*figure_.numbers.values(), *figure_.links.values()}
    said = [text for text in links if text in known]
    assert said
    assert len(said) == len(set(said))


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_centre_is_at_a_joint_or_a_guide_or_has_the_lines_that_lead_there(name: str) -> None:
    shown = figure(load(name))
    known, links = CentrePairs(shown), shown.by_number
    built = {step.pair: step.by for step in known.steps}
    named = {*known.pairs}
    for one, other in named:
        if not touch(shown.linkage, links[one], links[other]):
            assert known.all_shown or len(built[one, other]) == 2
            for third in built.get((one, other), ()):  # the centres on its lines are named
                assert {(one, third), (third, one)} & named
                assert {(third, other), (other, third)} & named


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_paths_of_centres_go_through_where_they_are_in_each_pose(name: str) -> None:
    shown = figure(load(name))
    known, step = CentrePairs(shown), len(shown.cycle.phase) // 7
    paths = known.paths(shown.cycle, step)
    assert set(paths) == {*known.pairs.values()}
    for n, phase in enumerate(shown.cycle.phase[::step]):
        centres = known.of(shown.scene.pose(float(phase), 2))
        for pair, label in known.pairs.items():
            place = centres[pair].place if pair in centres else None
            if place is None:
                assert np.isnan(paths[label][n]) or abs(paths[label][n]) > 1e6 * shown.extent
            else:
                assert paths[label][n] == pytest.approx(place, rel=1e-9, abs=1e-9 * shown.extent)
