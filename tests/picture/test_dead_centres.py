"""A slider's dead centres: where the ticks stand, and what is written at them."""

from __future__ import annotations

import re
from math import radians

import numpy as np
import pytest
from pictures import standing

from linkanim.picture.dead_centres import DeadCentres
from linkanim.picture.drawing import Drawing
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.scenes import load

SIZE = (960, 540)


def drawing(name: str, named: int = 2, size: tuple[int, int] = SIZE) -> Drawing:
    look = Look(hud=False, names=named, dead_centres=True)
    return Picture(load(name), size, look).drawing


def ticks(name: str) -> DeadCentres:
    found = drawing(name).dead_centres
    assert found is not None
    return found


def words(name: str, named: int = 2) -> list[str]:
    found = drawing(name, named).dead_centres
    return [text for text, *_ in found.words()] if found else []


# by the triangle that crank and rod make in one line: (scene, angles of the crank in degrees)
ANGLES = [
    ("slider-crank", [194.5, 7.2]),  # asin(20/80) past the half turn, and asin(20/160)
    ("scotch-yoke", [180.0, 0.0]),
]


@pytest.mark.parametrize(("name", "angles"), ANGLES)
def test_the_input_s_angle_stands_at_each_dead_centre(name: str, angles: list[float]) -> None:
    assert words(name, 1) == [f"θ₂ = {angle:.1f}°" for angle in angles]


@pytest.mark.parametrize("name", ["slider-crank", "press", "knuckle-press"])
def test_at_those_angles_the_slider_is_as_far_as_it_goes(name: str) -> None:
    scene = load(name)
    (slider,) = (body.name for body in scene.linkage.bodies if body.slider)
    found = [float(re.sub(r".*= |°", "", text).replace("−", "-")) for text in words(name, 1)]
    travel = scene.solve(angle=[radians(angle) for angle in found]).travel[slider]
    whole = scene.cycle(720).travel[slider]
    assert travel == pytest.approx([whole.min(), whole.max()], abs=1e-3 * np.ptp(whole))


def test_a_driven_slider_s_own_travel_stands_there_in_its_unit() -> None:
    scene = load("driven-piston")
    low, high = scene.info.input_range
    assert words("driven-piston", 1) == [f"s = {low:.1f} mm", f"s = {high:.1f} mm"]


def test_with_dimensions_stroke_and_time_ratio_are_those_of_info() -> None:
    info = load("press").info
    assert words("press")[2] == f"stroke {info.stroke:.4g} mm, time ratio {info.time_ratio:.4g}"
    assert len(words("press", 1)) == 2


def test_the_ticks_cross_the_guide_where_the_slider_turns_back() -> None:
    found, scene = ticks("slider-crank"), load("slider-crank")
    lines = np.concatenate([loop for layer in found.layers for loop in layer.loops])
    for phase in scene.info.dead_centres or ():
        at = found.setting.view.pixel(scene.pose(phase).position["B"])
        near = lines[np.abs(lines.real - at.real) < 2]
        assert near.imag.min() < at.imag - found.setting.gauge.bar
        assert near.imag.max() > at.imag + found.setting.gauge.bar


# no slider; one whose guide is carried by a body; names off
@pytest.mark.parametrize(("name", "named"), [("crank-rocker", 2), ("press", 0)])
def test_else_there_are_none(name: str, named: int) -> None:
    assert words(name, named) == []


@pytest.mark.parametrize("name", ["press", "slider-crank", "knuckle-press"])
def test_the_words_stand_off_their_guide_at_their_ticks_in_any_zoom(name: str) -> None:
    found = list[dict[str, complex]]()
    for zoom in (1.5, 3.0):
        picture = Picture(load(name), SIZE, Look(names=2, dead_centres=True, zoom=zoom))
        ticks = picture.drawing.dead_centres
        assert ticks
        feet = {text: foot for text, foot, _ in ticks.words()}
        said = dict(standing(picture, picture.scene.pose(0.4)))
        found.append({text: said[text].middle - foot for text, foot in feet.items() if text in said})
    near, far = found
    assert near
    assert near == pytest.approx(far)


def test_they_are_drawn_where_they_are_asked_for_and_nowhere_else() -> None:
    for named, asked in ((0, False), (1, False), (2, False), (0, True), (2, True)):
        look = Look(hud=False, names=named, dead_centres=asked)
        found = Picture(load("slider-crank"), SIZE, look).drawing.dead_centres
        assert (found is not None) == (asked and named > 0)
