"""The key to the arrows."""

from __future__ import annotations

import math

import pytest

from linkanim.picture.figure import figure
from linkanim.picture.layout import gauge, layout
from linkanim.picture.legend import Legend, three_digits
from linkanim.picture.look import Look
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.picture.vectors import arrows_of
from linkanim.picture.view import Rect
from linkanim.scenes import load


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (123.456, "123"),
        (12.3456, "12.3"),
        (0.01234, "0.0123"),
        (123456.0, "123456"),
        (1.5e6, "1.50e+06"),
        (1e-5, "1.00e-05"),
    ],
)
def test_numbers_keep_three_digits(value: float, words: str) -> None:
    assert three_digits(value) == words


def test_the_key_says_what_its_arrow_stands_for_at_any_speed() -> None:
    scene = load("press")
    kind = arrows_of(figure(scene), "v", 720, gauge(1.0, 100.0), LIGHT)
    legend = Legend((kind,), Rect(0, 0, 300, 600), layout((1280, 720), Look()), Type(), LIGHT)
    drive = scene.linkage.drive.speed
    slow, fast = (float(legend.meaning(kind, speed).split()[0]) for speed in (drive, -3 * drive))
    arrow = 2.6 * layout((1280, 720), Look()).small_size
    assert slow == pytest.approx(arrow / kind.scale(drive), rel=5e-3)
    assert fast == pytest.approx(3 * slow, rel=1e-2)
    assert legend.meaning(kind, drive).endswith(" mm/s")
    assert legend.meaning(kind, 0.0) == "–"
    assert math.isfinite(slow)
