"""What the exact straight lines and the scaling linkages of the catalogue are there for."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.scenes import load

Array = NDArray[np.float64]


def distance(places: Array) -> Array:
    return np.hypot(places[:, 0], places[:, 1])


# the constant product of the distances from O, and the diameter of the circle through O that A runs on
@pytest.mark.parametrize(
    ("name", "product", "diameter"),
    [
        ("peaucellier", 200.0**2 - 100.0**2, 2 * 60.0),
        ("hart", (200.0**2 - 100.0**2) / 4, -2 * 48.0),
    ],
)
def test_the_inverse_of_a_circle_through_its_centre_is_a_straight_line(
    name: str, product: float, diameter: float
) -> None:
    motion = load(name).cycle(720)
    a, p = motion.position["A"], motion.position["P"]
    assert np.max(np.abs(distance(a) * distance(p) - product)) <= 1e-14 * product * 2
    assert np.max(np.abs(p[:, 0] - product / diameter)) <= 1e-13 * 200
    assert np.ptp(p[:, 1]) > 50
    # O, A and P lie on one line.
    assert np.max(np.abs(a[:, 0] * p[:, 1] - a[:, 1] * p[:, 0])) <= 1e-13 * product


def test_the_pen_draws_what_the_tracer_draws_at_its_scale() -> None:
    motion = load("pantograph").cycle(720)
    tracer, pen = motion.position["T"], motion.position["P"]
    assert np.max(np.abs(pen - 2.5 * tracer)) <= 1e-14 * 300
    assert np.min(np.ptp(tracer, axis=0)) > 20
