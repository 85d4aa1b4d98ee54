"""Names and dimensions are anchored once, go along with what they name, and say what the scene says."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from pictures import BARE, pixels, standing

from linkanim.picture.anchors import Anchor
from linkanim.picture.dimensions import symbols
from linkanim.picture.figure import figure
from linkanim.picture.look import Look
from linkanim.picture.motion_marks import Sliding, Turning
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import Lettering, Type
from linkanim.picture.view import Rect
from linkanim.scenes import load
from linkanim.scenes.editing import with_dimensions
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

# what reaches beyond its joints: a yoke's bar, an arm that bends in a joint and ends in a pad
BEYOND = [("scotch-yoke", "r₂ = 80 mm", "fitting-Y"), ("toggle-clamp", "O₆", "body-arm")]


# scene, how the words begin: a length stands by the middle of its rod, also where that is at a rim
RIMS = [("parallel-locomotive", "r₁"), ("engine", ""), ("landing-gear", "")]


@pytest.mark.parametrize("name", ["watt-line", "roberts-line", "rocker-driven", "crank-rocker"])
def test_the_angle_s_arc_runs_as_far_as_the_hud_says(name: str) -> None:
    """Also below the horizontal, where a swing's angle is negative; its symbol stays at the arc."""
    scene = load(name)
    painter = Picture(scene, (1280, 720), Look(names=2))
    turning, swings = painter.drawing.turning, not scene.info.full_turn
    assert isinstance(turning, Turning)
    for phase in np.linspace(0.1, 6.2, 9):
        angle = scene.pose(float(phase)).coordinate
        assert turning.turned(angle + math.tau) == pytest.approx(angle if swings else angle % math.tau)
    for phase in np.linspace(0, math.tau, 9):
        pose = scene.pose(float(phase))
        places = painter.drawing.places(pose)
        for text, box in standing(painter, pose):
            away = abs(box.middle - places[turning.pivot])
            assert text not in ("θ₂", "θ₄") or away < turning.arc + 1.5 * box.height


def test_a_crank_that_is_part_of_a_plate_has_the_plates_number() -> None:
    document = {
        "ground": {"O2": [0, 0]},
        "joints": {
            "A": {"crank": "O2", "length": 78},
            "D": {"from": ["O2", "A"], "length": [31.4, 79.5]},
        },
        "bodies": {"arm": {"joints": ["O2", "A"]}},
    }
    assert symbols(figure(scene_from(document, name="my", where="my.toml"))).input == "θ₂"


def _table(scene: Scene) -> dict[str, float]:
    known = symbols(figure(scene))
    return {one.symbol: one.value for one in known.dimensions} | {known.input: 0.0}


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("crank-rocker", {"r₁": 100, "r₂": 50, "r₃": 85, "r₄": 80, "r₅": 80, "r₆": 70, "θ₂": 0}),
        # as in its file: r5 from O4 to O6, r6 fixed to the rocker
        ("six-bar", {"r₁": 100, "r₂": 45, "r₃": 90, "r₄": 80, "r₅": 140, "r₆": 70, "r₇": 120, "r₈": 90}),
        # links that have numbers keep them; the ground is from pivot to pivot
        ("press", {"r₁": 330, "r₂": 55, "r₃": 283, "r₄": 322, "r₆": 165, "r₇": 61, "θ₁": -107.47, "θ₂": 0}),
        # the driven bar is link 4
        ("rocker-driven", {"r₁": 130, "r₂": 100, "r₃": 140, "r₄": 140, "θ₄": 0}),
    ],
)
def test_the_symbols_are_the_textbook_s(name: str, wanted: dict[str, float]) -> None:
    found = _table(load(name))
    assert {symbol: found[symbol] for symbol in wanted} == pytest.approx(wanted)
    if name == "press":
        assert found.keys() == wanted.keys()


def test_dimensions_and_the_angle_come_with_the_second_level() -> None:
    scene = load("crank-rocker")
    one, two = (
        {label.text for label in (*names.labels, *names.listed) if not label.of.startswith("body:")}
        for names in (Picture(scene, (1280, 720), Look(names=level)).names for level in (1, 2))
    )
    stated = {f"r{'₀₁₂₃₄₅₆'[n]} = {value} mm" for n, value in enumerate((0, 100, 50, 85, 80, 80, 70)) if n}
    assert two - one == stated | {"θ₂"}


def test_links_are_called_by_their_names_or_where_one_has_no_room_all_by_their_numbers() -> None:
    scene = load("crank-rocker")
    said = []
    for size in ((1280, 720), (320, 180)):
        labels = Picture(scene, size, Look(names=1)).names.labels
        said.append({label.text for label in labels if label.of.startswith("body:")})
    assert said == [{"crank", "coupler", "rocker"}, {"2", "3", "4"}]
    assert list(figure(load("press")).numbers.values()) == ["2", "3", "4", "5", "6", "7"]


@pytest.mark.parametrize("name", ["crank-rocker", "double-rocker"])
def test_the_arrow_bends_the_way_the_input_turns_and_turns_over_with_it(name: str) -> None:
    scene = load(name)
    painter = Picture(scene, (1280, 720), replace(BARE, names=1))
    turning, drive = painter.drawing.turning, scene.linkage.drive
    assert isinstance(turning, Turning)
    for phase, speed in ((1.0, drive.speed), (1.0, -drive.speed), (4.0, 3 * drive.speed)):
        pose = scene.pose(phase, speed=speed)
        places = painter.drawing.places(pose)
        line = turning.direction(pose, places, abs(drive.speed / speed))[-1]
        centre, tip = places[turning.pivot], line.loops[-1][0]
        bar = places[turning.pin] - centre
        ahead = -np.angle((tip - centre) / bar)
        assert np.sign(ahead) == np.sign(pose.coordinate_rate)
        assert 0.2 < abs(ahead) < 2.2


def test_the_arrow_runs_the_way_the_driven_slider_does() -> None:
    scene = load("driven-piston")
    painter = Picture(scene, (1280, 720), replace(BARE, names=2))
    sliding, drive = painter.drawing.turning, scene.linkage.drive
    assert isinstance(sliding, Sliding)
    for phase, speed in ((1.0, drive.speed), (1.0, -drive.speed), (4.0, 3 * drive.speed)):
        pose = scene.pose(phase, speed=speed)
        places = painter.drawing.places(pose)
        line = sliding.direction(pose, places, abs(drive.speed / speed))[-1]
        ahead = line.loops[0].real - places["C"].real
        assert np.sign(ahead).tolist() == [np.sign(pose.coordinate_rate)] * len(ahead)
        assert np.abs(ahead).min() > 2 * sliding.gauge.bar  # off its block
        assert np.ptp(ahead) > 3 * sliding.gauge.bar
    assert not sliding.direction(scene.pose(0.0), painter.drawing.places(scene.pose(0.0)), 1.0)


def test_an_input_that_stands_still_has_no_arrow() -> None:
    scene = load("crank-rocker")
    painter = Picture(scene, (640, 360), replace(BARE, names=1))
    SurfacePrinter().paint(offscreen((640, 360)), painter, scene.pose(1.0, speed=0.0))
    turning, still = painter.drawing.turning, scene.pose(1.0, speed=0.0)
    assert turning
    assert turning.direction(still, painter.drawing.places(still), 1.0) == []


def test_words_glide_by_quarters_of_a_pixel() -> None:
    lettering = Lettering("O₂", Type(), 20, ((0, 0, 0), (255, 255, 255)), 2.0)
    centres = []
    for step in range(9):
        surface = offscreen((80, 60))
        surface.fill((128, 128, 128))
        lettering.draw(surface, 40.0 + step / 8 + 30j)
        dark = np.clip(128 - pixels(surface)[..., 0], 0, None)
        centres.append((np.indices(dark.shape)[1] * dark).sum() / dark.sum())
    steps = np.diff(centres)
    assert centres[-1] - centres[0] == pytest.approx(1.0, abs=0.02)
    assert steps.max() < 0.3


def test_while_the_hand_holds_a_joint_names_keep_their_places_and_lengths_are_told_anew() -> None:
    scene, size, look = load("crank-rocker"), (1280, 720), Look(names=2)
    longer = with_dimensions(scene, {("four-bar", "rocker"): 85.0})
    before = Picture(scene, size, look)
    held, free = (Picture(longer, size, look, placed=placed) for placed in (scene, None))
    anchors = [[label.anchor for label in one.names.labels] for one in (before, held, free)]
    assert anchors[0] == anchors[1] != anchors[2]
    assert held.view == before.view != free.view
    for picture in (held, free):
        texts = [label.text for label in (*picture.names.labels, *picture.names.listed)]
        assert "r₄ = 85 mm" in texts


def test_a_name_keeps_its_place_on_its_link_in_an_enlarged_view() -> None:
    scene, size = load("crank-rocker"), (1280, 720)
    pose = scene.pose(1.0)
    shares = []
    for zoom in (1.5, 2.5):
        painter = Picture(scene, size, Look(names=1, zoom=zoom))
        places = painter.drawing.places(pose)
        middle = next(box.middle for text, box in standing(painter, pose) if text == "crank")
        shares.append((middle - places["O2"]) / (places["A"] - places["O2"]))
    assert shares[0].real == pytest.approx(shares[1].real)
    assert 0 < shares[0].real < 1


@pytest.mark.parametrize("far", [1e6, 1e12, 1e300, math.inf, math.nan])
def test_words_far_beyond_a_picture_are_not_drawn(far: float) -> None:
    lettering, surface = Lettering("O", Type(), 20, ((0, 0, 0), (0, 0, 0)), 2.0), offscreen((60, 40))
    surface.fill((200, 200, 200))
    bare = pixels(surface).tobytes()
    for middle in (complex(far, 20), complex(30, -far), complex(-far, far)):
        lettering.draw(surface, middle)
    assert pixels(surface).tobytes() == bare


def test_words_at_an_edge_are_drawn_as_far_as_they_are_seen() -> None:
    lettering = Lettering("OOO", Type(), 20, ((0, 0, 0), (0, 0, 0)), 2.0)
    wide = lettering.size[0] / 2
    for x in (4 - wide, 56 + wide):
        surface = offscreen((60, 40))
        surface.fill((200, 200, 200))
        bare = pixels(surface).tobytes()
        lettering.draw(surface, complex(x, 20))
        assert pixels(surface).tobytes() != bare


def test_an_anchor_s_base_goes_along_with_its_bar_and_its_way_where_it_turns() -> None:
    places = {"A": 100 + 100j, "B": 100 + 300j}
    still, turning = (Anchor("A", "B", 0.5 + 0j, 1 + 0j, 10.0, turns=turns) for turns in (False, True))
    assert still.foot(places, 9.0) == 100 + 200j
    assert still.middle(places, 9.0, (40.0, 20.0)) == 130 + 200j
    assert turning.middle(places, 9.0, (40.0, 20.0)) == pytest.approx(100 + 220j)
    # in the ground's frame the base is in the scene's unit
    assert Anchor("A", "A", 5 + 0j).foot(places, 9.0) == 145 + 100j


@pytest.mark.parametrize("way", [1, -1j, np.exp(0.3j), np.exp(2j), np.exp(-2.7j)])
@pytest.mark.parametrize("reach", [0.0, 5.0, 40.0])
def test_off_a_disc_there_is_no_gap_and_no_overlap(way: complex, reach: float) -> None:
    middle = Anchor("A", "A", 0j, complex(way), reach).middle({"A": 0j}, 1.0, (40.0, 20.0))
    box = Rect(middle.real - 20, middle.imag - 10, 40.0, 20.0)
    assert abs(box.nearest(0j)) == pytest.approx(reach, abs=1e-9)


@pytest.mark.slow
def test_a_name_without_a_place_has_a_leader_in_a_still_and_is_left_out_or_listed_in_motion() -> None:
    """Dimensions are listed in both, the others are said somewhere."""
    scene, size = load("andrews"), (480, 270)
    still, moving = (Picture(scene, size, Look(names=2), moment=moment).names for moment in (1.0, None))
    assert any(label.leader for label in still.labels)
    assert not any(label.leader for label in moving.labels)
    known = symbols(figure(scene)).dimensions
    for names in (still, moving):
        said = {label.text for label in (*names.labels, *names.listed)}
        assert {one.written(scene.length_unit) for one in known} <= said
        numbers = [int("".join(re.findall("[0-9]", label.of)) or 0) for label in names.listed]
        assert numbers == sorted(numbers)


ONE_POINT = {
    "points": {"O": [0, 0], "A": [20, 30], "G": [100, 0]},
    "links": {"ground": ["O", "G"], "crank": ["O", "A"], "lever": ["G"]},
    "slides": {"pin": {"point": "A", "on": "lever", "angle": "159.44395478 deg"}},
    "drive": {"joint": "O"},
}
"""An inverted slider-crank whose slotted lever is told by its pivot alone."""


def test_the_end_that_a_slot_gets_is_no_joint_with_a_letter() -> None:
    scene = scene_from(ONE_POINT, name="swing", where="swing")
    labels = {one.of for one in Picture(scene, (1280, 720), Look(names=1)).names.labels}
    assert {"joint:O", "joint:A", "joint:G"} == {of for of in labels if of.startswith("joint:")}
    assert any(of.endswith(":lever") for of in labels)
