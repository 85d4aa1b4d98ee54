"""Constructions in their steps: of instant centres, and of dead centres."""

from __future__ import annotations

import math
from itertools import combinations
from unicodedata import normalize

import numpy as np
import pytest
from random_scenes import chain

from linkanim.errors import BadInput
from linkanim.picture.centres import CentrePairs
from linkanim.picture.constructed import (
    KINDS,
    all_steps,
    clear_phase,
    kinds_of,
    linkage_marks,
    places_of,
    shown_at,
    steps_before,
    steps_of,
)
from linkanim.picture.drawn import Additions
from linkanim.picture.figure import figure
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.text import subscripted
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.synthesis.constructions import Mark, dead_centres

# scene, what is constructed of it: dead centres only where the crank drives and the output swings or slides
HAS = [
    ("crank-rocker", ["dead-centres", "centres"]),
    ("slider-crank", ["dead-centres", "centres"]),
    ("drag-link", ["centres"]),
    ("rocker-driven", ["centres"]),
    ("inverted-slider-crank", ["centres"]),
    ("geared-five-bar-2-1", ["centres"]),
    ("six-bar", ["dead-centres"]),
    ("press", []),
]


@pytest.mark.parametrize(("name", "kinds"), HAS)
def test_the_constructions_of_a_scene(name: str, kinds: list[str]) -> None:
    scene = load(name)
    assert [*kinds_of(scene)] == kinds
    for kind in KINDS:
        if kind not in kinds:
            with pytest.raises(BadInput, match=f"{name}: "):
                steps_of(scene, kind)
    if not kinds:
        with pytest.raises(BadInput, match="has no construction"):
            all_steps(scene)


def test_a_rod_as_long_as_its_crank_has_no_dead_centres() -> None:
    scene = scene_from({"slider-crank": {"crank": 5, "rod": 5}}, name="alike", where="alike.toml")
    assert [*kinds_of(scene)] == ["centres"]
    with pytest.raises(BadInput, match="its rod longer than its crank"):
        steps_of(scene, "dead-centres")


def test_a_chain_has_no_pose_for_centres_that_are_not_constructed() -> None:
    scene = scene_from(chain(5), name="chain", where="chain.toml")
    with pytest.raises(BadInput, match="chain: has more than five links"):
        clear_phase(scene)


def test_the_pose_for_centres_has_some_that_are_not_infinitely_far_and_so_has_one_at_rest() -> None:
    document: dict[str, object] = {
        "drive": {"start": "87 deg"},
        "ground": {"O2": [0, 0], "G1": [-45, -90]},
        "joints": {
            "A": {"crank": "O2", "length": 140},
            "S1": {
                "from": "A",
                "length": 125,
                "side": "forward",
                "line": {"through": "O2", "angle": "180 deg"},
            },
            "E1": {"length": 65, "slot": {"pivot": "O2", "through": "A"}},
            "S2": {
                "from": "A",
                "length": 95,
                "side": "backward",
                "line": {"through": "G1", "angle": "180 deg", "offset": -10},
            },
        },
    }
    scene = scene_from(document, name="two slides", where="two-slides.toml")
    known = CentrePairs(figure(scene))

    def places(phase: float) -> list[complex]:
        return [one.place for one in known.of(scene.pose(phase, 1)).values() if one.place is not None]

    assert places(0.0) == pytest.approx(places(1e-9)[:2])  # the third one is going off
    assert places(clear_phase(scene))


def named(marks: tuple[Mark, ...]) -> dict[str, complex]:
    return {mark.label: complex(mark.points[0]) for mark in marks if mark.label and len(mark.points) == 1}


@pytest.mark.parametrize(
    "name", ["crank-rocker", "slider-crank", "inverted-slider-crank", "geared-five-bar-2-1"]
)
@pytest.mark.parametrize("phase", [0.3, 2.0, 4.4])
def test_a_centre_is_where_the_lines_of_its_steps_meet(name: str, phase: float) -> None:
    scene = load(name)
    known = CentrePairs(figure(scene))
    first, *steps = steps_of(scene, "centres", phase)
    places = known.of(scene.pose(phase, 1))
    shown = named(first.marks)
    lines: list[np.ndarray] = []
    for one, two, step in zip(steps[::2], steps[1::2], known.steps, strict=True):
        lines = [mark.points for each in (one, two) for mark in each.marks if mark.shape == "dashed"]
        assert len(lines) == 2
        (label,) = named(two.marks)
        assert label in one.words
        place = places[step.pair].place
        assert place is not None
        assert named(two.marks)[label] == place
        for begin, end in lines:
            across = ((place - begin) * (end - begin).conjugate()).imag / abs(end - begin)
            assert abs(across) < 1e-9 * max(abs(end - begin), abs(place))
        shown |= named(two.marks)
    finite = [one for one in places.values() if one.place is not None]
    assert len(shown) == len(finite)


def test_a_block_that_turns_on_neither_of_two_guides_has_a_centre_across_each() -> None:
    scene = load("oldham")
    first, *steps = (step.words for step in steps_of(scene, "centres", 0.7))
    assert first.endswith("Across a guide the centre of what slides is infinitely far: P₂₄ and P₃₄.")
    assert "it lies on the line through P₁₃ towards P₃₄, too: there it is" in steps[1]
    centres = CentrePairs(figure(scene)).of(scene.pose(0.7, 1))
    along = centres["2", "4"].direction / centres["3", "4"].direction
    assert abs(along.real) < 1e-12 * abs(along)


def test_two_centres_at_infinity_lead_to_a_third_one() -> None:
    scene = load("elliptic-trammel")
    words = [step.words for step in steps_of(scene, "centres", 0.7)]
    assert any("the line is at infinity: P₄₅ is infinitely far" in said for said in words)


@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank", "engine"])
def test_dead_centres_are_where_the_linkage_has_them(name: str) -> None:
    scene = load(name)
    steps, found = steps_of(scene, "dead-centres"), dead_centres(scene)
    assert len(steps) == 6
    marks = named(tuple(mark for step in steps for mark in step.marks))
    end = scene.cycle(7200, derivatives=0).position["B"] @ [1, 1j]
    for place, label in zip(found.ends, ("B′", "B″"), strict=True):
        assert marks[label] == place
        assert np.abs(end - place).min() < 0.02
    # crank and coupler in line
    for pin, place in zip(found.pins, found.ends, strict=True):
        way = (pin - found.crank_pivot).conjugate() * (place - found.crank_pivot)
        assert abs(way.imag) < 1e-9 * abs(way)
    told = [float(said.partition("stands at ")[2][:-2]) for said in (steps[2].words, steps[4].words)]
    if scene.info.dead_centres:
        angles = [math.degrees(scene.pose(phase, 0).coordinate) % 360 for phase in scene.info.dead_centres]
        assert sorted(told) == pytest.approx(sorted(angles), abs=0.06)
    if scene.info.time_ratio:
        assert f"= {scene.info.time_ratio:.4g}." in steps[-1].words or "same time" in steps[-1].words


def test_steps_are_counted_through_all_constructions() -> None:
    scene = load("slider-crank")
    count = len(steps_of(scene, "dead-centres"))
    assert steps_before(scene, "dead-centres") == 0
    assert steps_before(scene, "centres") == count
    with pytest.raises(BadInput, match="has no construction of a synthesis"):
        steps_before(scene, "synthesis")
    kind, steps, total = shown_at(scene, count, 0.4)
    assert (kind, len(steps), total) == ("dead-centres", count, count)
    assert shown_at(scene, count + 2, 0.4)[0] == "centres"
    assert len(shown_at(scene, all_steps(scene), 0.4)[1]) == len(steps_of(scene, "centres"))


def test_the_picture_says_what_is_done_and_holds_the_centres() -> None:
    scene = load("crank-rocker")
    phase = clear_phase(scene)
    also = places_of(scene, "centres", phase)
    picture = Picture(scene, (640, 360), Look(), moment=phase, also=also)
    for place in also:
        x, y = picture.view.to_pixel(place.real, place.imag)
        assert 0 < x < 640
        assert 0 < y < 360
    said = [
        line.text
        for group in picture.groups(scene.pose(phase, 2), Additions(steps=steps_before(scene, "centres") + 3))
        for line in group.captions
    ]
    assert "it lies on the line through P₁₄ and P₃₄, too: there it is" in " ".join(said)
    assert "step 3 of 5" in said
    assert scene.title not in said  # what stands there else would lie below


@pytest.mark.parametrize("letters", [0, 1])
def test_a_joint_has_its_letter_once_beside_a_construction(letters: int) -> None:
    scene = load("crank-rocker")
    picture = Picture(scene, (1280, 720), Look(names=letters))
    over = Additions(steps=len(steps_of(scene, "dead-centres")))
    said = [line.text for group in picture.groups(scene.pose(0.3, 2), over) for line in group.captions]
    for name in ("O₂", "O₄"):
        written = {name, subscripted(normalize("NFKC", name))}
        assert sum(text in written for text in said) == 1
    assert "B″" in said


@pytest.mark.parametrize("size", [(640, 360), (1280, 720)])
def test_words_on_a_construction_leave_the_linkage_where_they_can(size: tuple[int, int]) -> None:
    scene = load("crank-rocker")
    picture, pose = Picture(scene, size, Look()), scene.pose(math.radians(42.0), 2)
    groups = picture.groups(pose, Additions(steps=steps_before(scene, "centres") + 1))
    words = next(group for group in groups if group.name == "build-words")
    assert "".join(line.text for line in words.captions).count("P") == 4
    rects = [line.around(picture.type) for line in words.captions]
    bars = [
        [picture.view.pixel(pose.position[joint]) for joint in body.joints] for body in picture.figure.bodies
    ]
    assert not [
        rect for rect in rects for ends in bars for pair in combinations(ends, 2) if rect.crossed(*pair)
    ]


def test_the_linkage_of_a_figure_has_its_links_numbers() -> None:
    scene = load("inverted-slider-crank")
    assert {mark.label for mark in linkage_marks(scene, 0.3)} == {"", "2", "3", "4"}
