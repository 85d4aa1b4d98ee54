"""A scene's canvas: its other closure behind it, and the view while a length is followed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from pictures import BARE, SMALL, pixels

from linkanim.picture.arrangement.staging import staged, wanted_of
from linkanim.picture.canvas import Canvas
from linkanim.picture.figure import figure
from linkanim.picture.look import Look
from linkanim.picture.painter import Painter
from linkanim.picture.panels.overlay import Overlay
from linkanim.picture.raster.offscreen import offscreen
from linkanim.picture.text.text import Type
from linkanim.picture.theme import theme_of
from linkanim.scenes import load
from linkanim.scenes.editing.closures import ghost_of
from linkanim.scenes.editing.edit import passing
from linkanim.scenes.scene import Scene

HAUNTED = replace(BARE, ghost=True)


def _on_the_way(scene: Scene, crank: float) -> Scene:
    return passing(scene, {("four-bar", "crank"): crank})


# A scene, and one on the way to it, whose ghost has its lengths.
@pytest.mark.parametrize("gone", [False, True])
def test_the_ghost_is_the_other_closure_at_the_same_phase(gone: bool) -> None:
    scene = load("crank-rocker")
    shown = _on_the_way(scene, 45.0) if gone else scene
    other, ours, theirs = ghost_of(shown), offscreen(SMALL), offscreen(SMALL)
    assert other is not None
    pose = Canvas(shown, SMALL, HAUNTED).paint(ours, 1.0, 2.0, Overlay())
    assert pose.input_speed == 2.0
    painter = Painter(shown, SMALL, HAUNTED, beside=ghost_of(scene))
    painter.paint(theirs, shown.pose(1.0, speed=2.0), ghost=other.pose(1.0, 0))
    assert np.array_equal(pixels(ours), pixels(theirs))
    painter.paint(theirs, shown.pose(1.0, speed=2.0))
    assert not np.array_equal(pixels(ours), pixels(theirs))


def test_no_ghost_is_drawn_where_the_look_asks_for_none() -> None:
    scene, ours, theirs = load("crank-rocker"), offscreen(SMALL), offscreen(SMALL)
    Canvas(scene, SMALL, BARE, both=True).paint(ours, 1.0, 2.0, Overlay())
    Painter(scene, SMALL, BARE, beside=ghost_of(scene)).paint(theirs, scene.pose(1.0, speed=2.0))
    assert np.array_equal(pixels(ours), pixels(theirs))


# As a window shows it: with the ghost, zoomed, panned; else the scene has all the room.
@pytest.mark.parametrize(
    ("look", "whole"),
    [
        (BARE, False),
        (HAUNTED, True),
        (replace(BARE, zoom=2.0), True),
        (replace(BARE, pan=(0.1, 0.0)), True),
        (replace(BARE, pan=(0.0, 0.1)), True),
    ],
)
def test_both_closures_are_in_view_where_the_window_would_show_them(look: Look, whole: bool) -> None:
    scene = load("crank-rocker")
    alone, both = (Painter(scene, SMALL, look, beside=beside).view for beside in (None, ghost_of(scene)))
    assert alone != both
    assert Canvas(scene, SMALL, look).painter.view == (both if whole else alone)
    assert Canvas(scene, SMALL, look, both=True).painter.view == both


@pytest.mark.parametrize("crank", [20.0, 45.0])
def test_a_scene_on_the_way_is_as_large_as_the_one_it_becomes_and_in_its_place(crank: float) -> None:
    scene = load("crank-rocker")
    whole, shown = figure(scene), figure(_on_the_way(scene, crank))
    ready = staged(scene, None, wanted_of(SMALL, BARE, listed=False), Type())
    theirs, ours = (ready.scenery(one, theme_of("light"), BARE).view for one in (whole, shown))
    assert theirs == ready.arrangement.view
    assert ours.to_pixel(*shown.box.middle) == pytest.approx(theirs.to_pixel(*whole.box.middle))
    wide = ours.scale * (shown.box.right - shown.box.left) / (whole.box.right - whole.box.left)
    high = ours.scale * (shown.box.high - shown.box.low) / (whole.box.high - whole.box.low)
    assert max(wide, high) == pytest.approx(theirs.scale)


# Instant centres lie where they lie; the centrodes, and a scene zoomed or panned, run under the words.
@pytest.mark.parametrize(
    ("look", "overrun"),
    [
        (Look(), False),
        (Look(centres=1), False),
        (Look(centres=2), True),
        (Look(zoom=0.5), True),
        (Look(pan=(0.0, -0.1)), True),
    ],
)
def test_words_need_a_backing_where_something_may_lie_under_them(look: Look, overrun: bool) -> None:
    assert look.overrun == overrun
