"""The key to the arrows."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from pictures import inked

from linkanim.bench.questions import four_bar
from linkanim.picture.figure import figure
from linkanim.picture.hud import Legend, legend_for
from linkanim.picture.layout import gauge, layout
from linkanim.picture.look import ACCELERATION, VELOCITY, Look
from linkanim.picture.motion_marks import arrows_of
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import printed
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.scenes import load


def test_the_key_says_what_its_arrow_stands_for_at_any_speed() -> None:
    scene = load("press")
    kind = arrows_of(figure(scene), "v", 720, gauge(1.0, 100.0), LIGHT)
    legend = Legend((kind,), Rect(0, 0, 300, 600), 17, Type(), LIGHT)
    drive = scene.linkage.drive.speed
    slow, fast = (float(legend.meaning(kind, speed).split()[0]) for speed in (drive, -3 * drive))
    for value, speed in ((slow, drive), (fast, -3 * drive)):
        (arrow,) = legend.group(speed).layers
        assert np.ptp(arrow.loops[0].real) == pytest.approx(value * kind.scale(speed), rel=1e-6)
        assert float(f"{value:.0e}") == value
        assert 1.04 * legend.size - 1e-6 <= np.ptp(arrow.loops[0].real) <= 2.6 * legend.size + 1e-6
    assert legend.meaning(kind, drive).endswith(" mm/s")
    assert legend.meaning(kind, 0.0) == "–"
    assert math.isfinite(slow)


@pytest.mark.parametrize("size", [(400, 800), (480, 270), (640, 360), (1280, 720), (3840, 2160)])
def test_words_and_values_of_the_key_never_touch(size: tuple[int, int]) -> None:
    shown, type_ = figure(load("press")), Type()
    measure = gauge(1.0, 100.0)
    kinds = tuple(arrows_of(shown, kind, size[1], measure, LIGHT) for kind in (VELOCITY, ACCELERATION))
    parts = Picture(load("press"), size, Look(vectors=frozenset("va"))).layout
    legend = legend_for(kinds, parts, type_, LIGHT)
    assert legend is not None
    for kind in kinds:
        words = [kind.words, legend.meaning(kind, kind.drive)]
        wide = sum(type_.width(text, legend.size) for text in words) + 3.2 * legend.size
        assert wide < legend.column.width


@pytest.mark.parametrize("line", [0.8, 1.6, 3.0])
def test_the_key_s_arrows_and_words_are_drawn(line: float) -> None:
    kind = arrows_of(figure(load("press")), "v", 720, replace(gauge(1.0, 100.0), line=line), LIGHT)
    surface, column = offscreen((320, 64)), Rect(10, 10, 300, 40)
    surface.fill(LIGHT.background)
    legend = Legend((kind,), column, 17, Type(), LIGHT)
    printed(surface, [legend.group(1.0)], legend.type)
    shaft, words = (column._replace(x=x, width=20) for x in (10.0, 72.0))
    assert inked(surface, shaft, kind.colour)
    assert inked(surface, words, LIGHT.dim)
    (arrow,) = legend.group(1.0).layers
    near = arrow.loops[0][arrow.loops[0].real < 12]
    assert np.ptp(near.imag) == pytest.approx(1.6 * line, rel=0.1)


def test_there_is_no_key_without_arrows() -> None:
    assert legend_for((), layout((640, 360)), Type(), LIGHT) is None


def test_arrows_are_as_long_however_small_the_unit_s_numbers_are() -> None:
    small, large = (four_bar((size, 0.3 * size, 0.9 * size, 0.8 * size)) for size in (1, 100))
    metres, centimetres = (
        arrows_of(figure(scene), "v", 720, gauge(1.0, 100.0), LIGHT).scale(1.0) for scene in (small, large)
    )
    assert metres == pytest.approx(100 * centimetres)
    assert centimetres > 0
