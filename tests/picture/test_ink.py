"""Traces inked by speed: exact speeds, widths and colours by them, dots at equal times, what stands still."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from linkanim.picture.drawing import Drawing
from linkanim.picture.figure import DrawContext, figure
from linkanim.picture.ink import Ink, ink_scale, inks, ramp
from linkanim.picture.layout import gauge
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.theme import DARK, LIGHT, Theme
from linkanim.picture.view import View
from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene

VIEW = View(4.0, 100.0, 400.0)


def context(scene: Scene, theme: Theme = LIGHT) -> DrawContext:
    return DrawContext(figure(scene), VIEW, gauge(1.0, 100.0), theme)


def inked(scene: Scene) -> Ink:
    return inks(context(scene))[0]


def test_the_greatest_speed_is_that_of_the_motion() -> None:
    scene = load("crank-rocker")
    phases = np.linspace(0.0, scene.period, 7201)
    velocity = scene.solve(phase=phases).velocity["P"]
    scale = ink_scale(context(scene))
    assert scale.most == pytest.approx(float(np.hypot(*velocity.T).max()), rel=1e-5)
    assert scale.greatest_words(scene.linkage.drive.speed).startswith("0 … ")
    doubled = scale.greatest_words(-2.0 * scene.linkage.drive.speed).split()[2]
    assert float(doubled) == pytest.approx(2.0 * scale.most, rel=1e-2)
    assert scale.greatest_words(0.0) == scale.interval_words(0.0) == "–"


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_the_colours_are_told_from_the_ground_and_from_each_other(theme: Theme) -> None:
    colours = [np.array(ramp(theme, share)) for share in np.linspace(0.0, 1.0, 5)]
    assert all(np.abs(one - np.array(theme.background)).max() > 90 for one in colours)
    assert np.abs(colours[0] - colours[-1]).max() > 120


def test_dots_are_equal_times_apart() -> None:
    scene = load("crank-shaper")
    ink = inked(scene)
    count = len(ink.dots)
    assert count * ink.scale.gap == pytest.approx(scene.period)
    pixels = [VIEW.pixel(scene.pose(n * ink.scale.gap, 0).position[ink.joint]) for n in range(count)]
    assert np.allclose(ink.dots, pixels)
    words = ink.scale.interval_words(scene.linkage.drive.speed)
    assert float(words.split()[0]) == pytest.approx(
        scene.period / scene.linkage.drive.speed / count, rel=5e-3
    )


def test_a_point_that_stands_still_has_no_ink() -> None:
    still = replace(load("crank-rocker"), trace=("O4",))
    assert [layer for ink in inks(context(still)) for layer in ink.layers] == []
    assert ink_scale(context(still)).greatest_words(1.0) == "–"
    assert Picture(still, (320, 180), Look(ink=True)).drawing.inks


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_trace_is_inked_once_round(name: str) -> None:
    for ink in inks(context(load(name))):
        assert np.isfinite(ink.share).all()
        assert ink.share.max() <= 1.0
        assert math.isfinite(sum(float(np.abs(loop).sum()) for layer in ink.layers for loop in layer.loops))


def test_ink_takes_the_place_of_the_trace() -> None:
    look = Look(ink=True)
    drawing: Drawing = Picture(load("crank-rocker"), (640, 360), look).drawing
    names_ = [group.name for group in drawing.standing()]
    assert "ink-P" in names_
    assert "curve-P" not in names_
