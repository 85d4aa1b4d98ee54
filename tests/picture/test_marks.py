"""Marks that only the window shows: the value of a bar, clear of it and on the stage."""

from __future__ import annotations

import pytest

from linkanim.picture.look import Look
from linkanim.picture.marks import DimensionLine, label_beside, measure
from linkanim.picture.picture import Picture
from linkanim.scenes import load

MIDDLE = 320 + 180j
# A bar from its middle to its end: level, upright, steep, and each the other way round.
BARS = [way * sign for way in (60 + 0j, 60j, 40 + 50j, -20 + 70j) for sign in (1, -1)]


@pytest.mark.parametrize("dimensioned", [True, False], ids=["with a line", "alone"])
@pytest.mark.parametrize("half", BARS)
def test_a_value_stands_above_its_bar_and_clear_of_it(half: complex, dimensioned: bool) -> None:
    setting = Picture(load("crank-rocker"), (640, 360), Look()).drawing.setting
    begin, end = MIDDLE - half, MIDDLE + half
    shown = DimensionLine(("A", "B"), 0, 1, "120.5 mm", chosen=False)
    (group,) = (
        measure(setting, begin, end, shown)
        if dimensioned
        else [label_beside(setting, begin, end, "120.5 mm")]
    )
    (caption,) = group.captions
    assert caption.text == "120.5 mm"
    place = caption.around(setting.type)
    corners = [complex(x, y) for x in (place.x, place.right) for y in (place.y, place.bottom)]
    aside = [((corner - MIDDLE) / half).imag * abs(half) for corner in corners]
    assert min(map(abs, aside)) > setting.gauge.bar
    assert min(aside) * max(aside) > 0
    assert place.middle.imag < MIDDLE.imag + 1e-9


@pytest.mark.parametrize("at", [2 + 2j, 638 + 2j, 2 + 358j, 638 + 358j])
def test_a_value_stays_on_the_stage(at: complex) -> None:
    setting = Picture(load("crank-rocker"), (640, 360), Look(hud=False)).drawing.setting
    for half in BARS:
        place = label_beside(setting, at - half, at + half, "120.5 mm").captions[0].around(setting.type)
        assert setting.layout.stage.holds(place.x, place.y)
        assert setting.layout.stage.holds(place.right, place.bottom)


@pytest.mark.parametrize("half", [way * size / abs(way) for way in BARS for size in (8, 14, 25)])
def test_both_arrows_of_a_short_bars_dimension_are_seen(half: complex) -> None:
    setting = Picture(load("crank-rocker"), (640, 360), Look()).drawing.setting
    shown = DimensionLine(("A", "B"), 0, 1, "120.5 mm", chosen=False)
    (group,) = measure(setting, MIDDLE - half, MIDDLE + half, shown)
    line, ground = group.layers[-2:]
    corners = [*ground.loops[0]]
    left, right = (work(one.real for one in corners) for work in (min, max))
    top, bottom = (work(one.imag for one in corners) for work in (min, max))
    arrows = [one for loop in line.loops for one in loop if abs(((one - MIDDLE) / half).real) < 1.0]
    hidden = [one for one in arrows if left < one.real < right and top < one.imag < bottom]
    assert len(hidden) < len(arrows) / 2
    near = [complex(min(max(one.real, left), right), min(max(one.imag, top), bottom)) for one in arrows]
    assert min(abs(one - other) for one, other in zip(arrows, near, strict=True)) < 10.0  # and it is near


@pytest.mark.parametrize("half", [way * 8 / abs(way) for way in BARS])
def test_a_value_alone_stands_close_to_a_short_bar(half: complex) -> None:
    setting = Picture(load("crank-rocker"), (640, 360), Look()).drawing.setting
    place = label_beside(setting, MIDDLE - half, MIDDLE + half, "120.5 mm").captions[0].around(setting.type)
    lined = measure(setting, MIDDLE - half, MIDDLE + half, DimensionLine(("A", "B"), 0, 1, "120.5 mm"))
    beyond = next(iter(lined)).captions[0].around(setting.type)
    assert abs(place.middle - MIDDLE) < abs(beyond.middle - MIDDLE)
