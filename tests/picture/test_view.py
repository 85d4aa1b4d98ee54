"""The view: one conversion, there and back."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from linkanim.picture.view import Box, Rect, View, fit, moved

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
    assert view.place((3, 4)) == 106 + 42j


@given(lengths, lengths, st.floats(0.1, 1e4), st.floats(0.1, 1e4))
def test_what_is_fitted_lies_in_its_rectangle_and_touches_it(
    left: float, low: float, width: float, height: float
) -> None:
    into = Rect(30, 40, 600, 300)
    view = fit(Box(left, low, left + width, low + height), into)
    near, far = view.to_pixel(left, low + height), view.to_pixel(left + width, low)
    assert into.x - 1e-6 <= near[0] <= far[0] <= into.right + 1e-6
    assert into.y - 1e-6 <= near[1] <= far[1] <= into.bottom + 1e-6
    assert far[0] - near[0] == pytest.approx(600) or far[1] - near[1] == pytest.approx(300)


@pytest.mark.parametrize(
    ("box", "scale"),
    [
        (Box(0, 0, 10, 0), 60.0),  # a horizontal line fills the width
        (Box(0, 0, 0, 10), 30.0),  # an upright one the height
        (Box(5, 5, 5, 5), 1.0),  # a single point has no scale of its own
    ],
)
def test_a_box_without_extent_is_still_centred(box: Box, scale: float) -> None:
    view = fit(box, Rect(0, 0, 600, 300))
    assert view.scale == pytest.approx(scale)
    assert view.to_pixel((box.left + box.right) / 2, (box.low + box.high) / 2) == pytest.approx((300, 150))


def test_zoom_keeps_the_point_it_is_about() -> None:
    view = View(2.0, 100.0, 50.0)
    near = moved(view, (320, 180), zoom=4.0, pan=(0, 0))
    assert near.scale == 8
    assert near.to_world(320, 180) == pytest.approx(view.to_world(320, 180))


def test_pan_shifts_by_pixels_after_the_zoom() -> None:
    view = moved(View(2.0, 100.0, 50.0), (320, 180), zoom=4.0, pan=(7, -5))
    still = moved(View(2.0, 100.0, 50.0), (320, 180), zoom=4.0, pan=(0, 0))
    assert (view.x - still.x, view.y - still.y) == (7, -5)
