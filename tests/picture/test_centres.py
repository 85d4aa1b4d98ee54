"""Instant centres and centrodes on the picture."""

from __future__ import annotations

import numpy as np
import pytest

from linkanim.picture.centres import Centres, clipped
from linkanim.picture.drawing import Drawing
from linkanim.picture.figure import figure
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.view import Rect
from linkanim.scenes import load, names


def drawing(name: str, centres: int) -> Drawing:
    look = Look(hud=False, centres=centres)
    return Picture(load(name), (640, 360), look).drawing


def found(name: str, centres: int = 2) -> Centres:
    marks = drawing(name, centres).parts.centres
    assert marks is not None
    return marks


# scene, what is marked at some pose: of few links all pairs, else those to the ground
MARKED = [
    ("crank-rocker", ["P_{12}", "P_{13}", "P_{14}", "P_{23}", "P_{24}", "P_{34}"]),
    ("slider-crank", ["P_{12}", "P_{13}", "P_{14}", "P_{23}", "P_{24}", "P_{34}"]),
    ("press", ["P_{12}", "P_{13}", "P_{14}", "P_{15}", "P_{16}", "P_{17}"]),
]


@pytest.mark.parametrize(("name", "labels"), MARKED)
def test_the_pairs_of_links(name: str, labels: list[str]) -> None:
    assert sorted(pair.label for pair in found(name).pairs) == labels


def test_what_is_a_pin_is_not_marked_and_what_is_out_of_sight_neither() -> None:
    pose, drawn = load("crank-rocker").pose(0.9), drawing("crank-rocker", 1)
    (marked,) = [group for group in drawn.moving(pose) if group.name == "instant-centres"]
    assert {caption.text for caption in marked.captions} <= {"P_{13}", "P_{24}"}
    assert len(marked.captions) == len(marked.layers)


@pytest.mark.parametrize("phase", [0.3, 1.1, 4.0])
def test_the_curves_touch_in_the_coupler_s_centre(phase: float) -> None:
    centres, scene = found("elliptic-trammel"), load("elliptic-trammel")
    places = drawing("elliptic-trammel", 2).places(scene.pose(phase))
    fixed, moving = (np.concatenate(layer.loops) for layer in (centres.fixed(), centres.moving(places)))
    nearest = np.abs(fixed[:, None] - moving[None, :]).min()
    assert nearest < 2 * centres.setting.gauge.line
    # the larger holds the smaller, which is half as large
    assert np.ptp(moving.real) == pytest.approx(np.ptp(fixed.real) / 2, rel=0.02)


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_no_curve_runs_across_the_picture(name: str) -> None:
    centres = found(name)
    places = drawing(name, 2).places(load(name).pose(0.4))
    room = centres.setting.layout.reach
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
