"""What is drawn fills its room, with all that is drawn about it in pixels; the slots share a window."""

from __future__ import annotations

import numpy as np
import pytest
from pictures import window

from linkanim.picture.figure import DrawContext, figure
from linkanim.picture.fit import NOTHING, Extent, around, each, fitted, of_linkage, together
from linkanim.picture.fittings import rails_of
from linkanim.picture.layout import Docked, gauge, layout, with_caption, with_words
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Box, Rect, View
from linkanim.scenes import load

ROOM = Rect(100, 50, 400, 200)

# what is fitted, and the scale: 400 or 200 pixels less the margins, for so many units
FITTED = {
    "nothing": (NOTHING, 1.0),
    "a point has no scale of its own": (around([3 + 4j], 10.0), 1.0),
    "a level line fills the width": (around([0j, 100 + 0j], 10.0), 3.8),
    "an upright one the height": (around([0j, 100j], 10.0), 1.8),
    "sides of their own": (around([0j, 100 + 0j], (30.0, 0.0, 50.0, 0.0)), 3.2),
    "a letter at an end counts only there": (
        around([0j, 100 + 0j], 10.0) | around([50 + 0j], (80.0, 5.0, 80.0, 5.0)),
        3.8,
    ),
    "a letter in the middle that is wider than the line": (
        around([0j, 1 + 0j], 0.0) | around([0.5 + 0j], (100.0, 5.0, 100.0, 5.0)),
        400.0,
    ),
    "places that are unknown": (around([0j, 100 + 0j, complex(np.nan, 0), complex(np.inf, 0)], 10.0), 3.8),
    "offsets in pixels": (
        each(np.array([0j, 100 + 0j]), np.array([-20j, 20 + 0j]), np.array([10 + 10j])),
        (400 - 10 - 30) / 100,
    ),
}


@pytest.mark.parametrize("case", FITTED)
def test_what_is_drawn_fills_its_room_and_is_in_its_middle(case: str) -> None:
    extent, scale = FITTED[case]
    view = fitted(together([extent]), ROOM) if len(extent.boxes) else None
    if view is None:
        return
    assert view.scale == pytest.approx(scale)
    seen = extent.pixels(view)
    assert seen.middle == pytest.approx(ROOM.middle)
    assert seen.width <= ROOM.width + 1e-9
    assert seen.height <= ROOM.height + 1e-9


@pytest.mark.parametrize("seed", range(20))
def test_no_larger_scale_would_do(seed: int) -> None:
    chance = np.random.default_rng(seed)
    corner, size = chance.uniform(-50, 50, (9, 2)), chance.uniform(0, 40, (9, 2))
    extent = Extent(np.hstack([corner, corner + size]), chance.uniform(0, 60, (9, 4)))
    view = fitted(extent, ROOM)
    seen, larger = (extent.pixels(View(factor * view.scale, view.x, view.y)) for factor in (1.0, 1.001))
    assert seen.width <= ROOM.width + 1e-6
    assert seen.height <= ROOM.height + 1e-6
    assert larger.width > ROOM.width or larger.height > ROOM.height


def test_an_extent_is_that_of_all_its_parts() -> None:
    both = together([around([0j, 10 + 5j], 1.0), around([-3 + 8j], 1.0)])
    assert both.box == Box(-3.0, 0.0, 10.0, 8.0)
    assert NOTHING.box == Box(0.0, 0.0, 1.0, 1.0)


def test_a_still_extends_as_far_as_its_pose_and_its_whole_curves() -> None:
    shown, thick = figure(load("crank-rocker")), gauge(1.0, 100.0)
    cycle, pose, bare = (
        of_linkage(shown, thick, moment, traced=traced).box
        for moment, traced in ((None, True), (0.5, True), (0.5, False))
    )
    path = shown.cycle.position["P"]
    assert cycle.high >= pose.high >= path[:, 1].max() - 1e-9
    assert pose.right - pose.left <= cycle.right - cycle.left
    assert pose.low <= path[:, 1].min() + 1e-9 < bare.low


@pytest.mark.parametrize("name", ["slider-crank", "knee-cylinder"])
def test_a_still_holds_the_whole_of_a_guide_on_the_ground(name: str) -> None:
    shown, thick = figure(load(name)), gauge(1.0, 400.0)
    for moment in (0.0, shown.clearest, 1.5, 4.0):
        view = fitted(of_linkage(shown, thick, moment, traced=False), ROOM)
        lines = [loop for guide in rails_of(DrawContext(shown, view, thick, LIGHT)) for loop in guide]
        assert lines
        points = np.concatenate(lines)
        assert ROOM.x <= points.real.min() <= points.real.max() <= ROOM.right
        assert ROOM.y <= points.imag.min() <= points.imag.max() <= ROOM.bottom


# The slots.


@pytest.mark.parametrize("size", [(1280, 720), (640, 360), (720, 1280), (320, 180)])
@pytest.mark.parametrize(
    "docked", [Docked(bar=True), Docked(listed=1), Docked(2, bar=True), Docked(0, True, True)]
)
def test_slots_lie_in_the_window_and_none_on_another(size: tuple[int, int], docked: Docked) -> None:
    for beside in (False, True):
        parts = window(size, 1, 1, beside=beside, docked=docked)
        slots = {
            name: getattr(parts, name) for name in ("stage", "chart", "polygons", "caption", "row", "dial")
        }
        there = {name: slot for name, slot in slots.items() if slot}
        there |= {"list": parts.lists} if docked.listed else {}
        if size == (320, 180):  # a list has the whole height, words at the foot lie over it for a while
            there.pop("caption", None)
        for name, slot in there.items():
            assert -1e-9 <= slot.x < slot.right <= size[0] + 1e-9, name
            assert -1e-9 <= slot.y < slot.bottom <= size[1] + 1e-9, name
            assert not [
                other for other, one in there.items() if other != name and slot.inset(0.5).meets(one)
            ], name


def test_words_take_the_left_or_the_top_of_the_stage_and_their_legend_lies_below_them() -> None:
    parts = layout((1280, 720))
    left, above = (with_words(parts, (200.0, 150.0), 100.0, above=above) for above in (False, True))
    assert left
    assert above
    for one in (left, above):
        assert one.hud == Rect(20, 20, 200, 100)
        assert one.legend == Rect(20, 120, 200, 50)
    assert left.stage == Rect(220, 0, 1060, 720)
    assert above.stage == Rect(0, 170, 1280, 550)
    assert with_words(parts, (1300.0, 150.0), 100.0, above=True) is None


def test_a_caption_takes_the_foot_and_that_of_a_window_stays() -> None:
    parts = layout((1280, 720))
    captioned = with_caption(parts, 2)
    assert captioned.caption
    assert captioned.stage.bottom == captioned.caption.y
    assert captioned.caption.bottom == 720
    in_window = layout((1280, 720), docked=Docked(bar=True))
    assert with_caption(in_window, 2) == in_window
    assert with_caption(parts, 0) == parts


@pytest.mark.parametrize("size", [(320, 180), (1280, 720), (3840, 2160)])
def test_there_are_four_sizes_of_letters_and_each_can_be_read(size: tuple[int, int]) -> None:
    for scale in (1.0, 1.84):
        parts = layout(size, type_scale=scale)
        letters = [parts.title_size, parts.text_size, parts.label_size, parts.small_size]
        assert letters == sorted(letters, reverse=True)
        assert letters[-1] >= 11
