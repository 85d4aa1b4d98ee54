"""The view: one conversion, there and back."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from linkanim.picture.view import Box, Rect, View, moved, view_of

lengths = st.floats(-1e4, 1e4)
scales = st.floats(1e-3, 1e3)


@given(lengths, lengths, scales, lengths, lengths)
def test_a_point_comes_back_from_pixels(x: float, y: float, scale: float, left: float, top: float) -> None:
    view = View(scale, left, top)
    assert view.to_world(*view.to_pixel(x, y)) == pytest.approx((x, y), abs=1e-8 + 1e-10 / scale)


def test_up_in_the_scene_is_up_in_the_window() -> None:
    view = View(2.0, 100.0, 50.0)
    assert view.to_pixel(0, 0) == (100, 50)
    assert view.to_pixel(3, 4) == (106, 42)
    assert view.pixel((3, 4)) == 106 + 42j


def test_zoom_keeps_the_point_it_is_about() -> None:
    view = View(2.0, 100.0, 50.0)
    near = moved(view, (320, 180), zoom=4.0, pan=(0, 0))
    assert near.scale == 8
    assert near.to_world(320, 180) == pytest.approx(view.to_world(320, 180))


def test_pan_shifts_by_pixels_after_the_zoom() -> None:
    view = moved(View(2.0, 100.0, 50.0), (320, 180), zoom=4.0, pan=(7, -5))
    still = moved(View(2.0, 100.0, 50.0), (320, 180), zoom=4.0, pan=(0, 0))
    assert (view.x - still.x, view.y - still.y) == (7, -5)


@pytest.mark.parametrize("size", [(0, 0), (-12, -40), (1, -3), (0.2, 0.4)])
def test_a_room_without_extent_still_gets_a_view_that_comes_back(size: tuple[float, float]) -> None:
    view = view_of(Box(0, 0, 100, 50), Rect(5, 5, *size))
    assert view.scale == 0.01
    assert view.to_world(*view.to_pixel(50, 25)) == pytest.approx((50, 25))
