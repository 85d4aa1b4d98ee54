"""Outlines around hulls, divided into polygons, and how far hulls are apart, against shapely."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import MultiPoint, Point, Polygon, box

from linkanim.workshop.shapes import hull, polygon, rounded, upright
from linkanim.workshop.sweep import hulls_apart

PLACES = st.builds(complex, *[st.integers(-40, 40).map(lambda n: n / 4)] * 2)
CORNERS = st.lists(PLACES, min_size=1, max_size=6, unique=True).map(hull)


def points(corners: list[complex]) -> list[tuple[float, float]]:
    return [(corner.real, corner.imag) for corner in corners]


@settings(max_examples=40)
@given(corners=CORNERS, radius=st.sampled_from((0.5, 3.0, 20.0)))
def test_an_outline_lies_at_its_radius_around_the_hull(corners: list[complex], radius: float) -> None:
    outline = Polygon(points(polygon(rounded(corners, radius), 1e-3)))
    expected = MultiPoint(points(corners)).convex_hull.buffer(radius, quad_segs=200)
    assert outline.is_valid
    assert outline.exterior.is_ccw
    assert outline.symmetric_difference(expected).area < 2e-3 * expected.length


@given(one=CORNERS, other=CORNERS)
def test_hulls_are_as_far_apart_as_shapely_says(one: list[complex], other: list[complex]) -> None:
    found = float(hulls_apart(np.array([one]), np.array([other]))[0])
    shapes = (MultiPoint(points(corners)).convex_hull for corners in (one, other))
    assert found == pytest.approx(next(shapes).distance(next(shapes)), abs=1e-9)


# three in one line, but for rounding; a corner that lies on a side
@pytest.mark.parametrize("corners", [[0j, 1 + 1e-16j, 2 + 0j], [0j, 0.1 + 0.1j, 0.2 + 0.2j, 0.3 + 0.3j]])
def test_places_in_one_line_are_a_bar(corners: list[complex]) -> None:
    assert len(hull(corners)) == 2


def test_a_part_lies_upright_in_its_smallest_rectangle() -> None:
    turn = np.exp(1j * math.radians(37))
    lying = [turn * place for place in (0j, 30 + 0j, 30 + 10j, 10j)]
    there = [upright(lying) * place for place in lying]
    assert np.ptp(np.real(there)) == pytest.approx(30)
    assert np.ptp(np.imag(there)) == pytest.approx(10)
    assert abs(upright([5 + 5j])) == 1


def test_a_circle_s_polygon_stays_within_it() -> None:
    inside = Polygon(points(polygon(rounded([3 + 4j], 10.0), 0.005)))
    assert Point(3, 4).buffer(10.000001, quad_segs=2000).contains(inside)
    assert inside.exterior.distance(Point(3, 4)) > 10 - 0.0051
    assert not box(0, 0, 1, 1).intersects(inside.exterior)
