"""Words on a chart's curves: each is tied to its own dot, none lies on another, many curves have names."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np
import pytest

from linkanim.intake import NumberTable
from linkanim.paper.chart import Page, _apart, _by_unit
from linkanim.paper.curves import Curve, Pace, comparison, curves_of, extremes
from linkanim.paper.findings import Values, topics
from linkanim.picture.items import Caption, Item
from linkanim.picture.look import Over
from linkanim.picture.raster import Layer
from linkanim.picture.view import Rect
from linkanim.scenes import load, names

NEAR = 12
"""Words so many pixels from their dot need no line to it."""
SPEEDS = (5.0, 10.0, 20.0)
TOLD = re.compile(r"([−\d.]+)°? at ")


def page_of(name: str, *tokens: str, size: tuple[int, int] = (960, 540), over: Over | None = None) -> Page:
    paces = tuple(Pace(speed, f"{speed:g} rad/s") for speed in SPEEDS)
    return Page(curves_of(load(name), tokens, paces, over), size=size)


def box_of(page: Page, words: Caption) -> Rect:
    wide = page.pen.type.width(words.text, words.size, strong=words.strong)
    left = words.at[0] - wide * {"left": 0.0, "centre": 0.5, "right": 1.0}[words.anchor]
    return Rect(left, words.at[1], wide, words.size)


def gap(box: Rect, point: complex) -> float:
    """Return how far a point is from a rectangle."""
    x, y = point.real, point.imag
    return float(np.hypot(max(box.x - x, x - box.right, 0), max(box.y - y, y - box.bottom, 0)))


def faults(page: Page) -> Iterator[str]:
    """Yield what is wrong with the words of a chart."""
    items = list(page.items())
    captions = [item for item in items if isinstance(item, Caption) and item.text]
    boxes = [box_of(page, words) for words in captions]
    for n, one in enumerate(boxes):
        for m, other in enumerate(boxes[n + 1 :], n + 1):
            across = min(one.right, other.right) - max(one.x, other.x)
            if across > 1 and min(one.bottom, other.bottom) - max(one.y, other.y) > 1.5:
                yield f"{captions[n].text} lies on {captions[m].text}"
    told = [n for n, item in enumerate(items) if isinstance(item, Caption) and TOLD.match(item.text)]
    found = [_tied(page, items, n) for n in told]
    for n, (dot, line) in zip(told, found, strict=True):
        words = captions[captions.index(items[n])]  # type: ignore[arg-type]
        box = box_of(page, words)
        if line is None and gap(box, dot) >= NEAR:
            yield f"{words.text} is {gap(box, dot):.0f} px from its dot"
        if line is not None:
            if gap(box, line[1]) > 3:
                yield f"{words.text} is not where its line ends"
            along = dot + (line[1] - dot) * np.linspace(0, 1, 50)
            others = [
                other for other, _ in found if abs(other - dot) > 4.4 * page.pen.line
            ]  # they do not overlap
            if any(np.abs(along - other).min() < 2 * page.pen.line for other in others):
                yield f"the line of {words.text} leads through another dot"
            if any(gap(other, point) == 0 for other in boxes if other != box for point in along):
                yield f"the line of {words.text} leads through other words"


def _tied(page: Page, items: list[Item], n: int) -> tuple[complex, np.ndarray | None]:
    """Return the dot of words, and the line from it to them if there is one; their value is its curve's."""
    dot, lead, words = items[n - 1], items[n - 3], items[n]
    assert isinstance(dot, Layer)
    assert isinstance(words, Caption)
    match = TOLD.match(words.text)
    assert match
    middle = complex(np.mean(dot.loops[0]))
    mine = [curve for curve in page.curves.curves if page.colour(curve) == dot.colour]
    assert any(_has(page, curve, match[1]) for curve in mine), words.text
    if (
        isinstance(lead, Layer)
        and lead.colour == dot.colour
        and len(lead.loops) == 1
        and len(lead.loops[0]) == 4
    ):
        corners = lead.loops[0]
        ends = np.array([corners[[0, 3]].mean(), corners[[1, 2]].mean()])
        if abs(ends[0] - middle) < 1:
            return middle, ends
    return middle, None


def _has(page: Page, curve: Curve, told: str) -> bool:
    """Whether a number is a curve's greatest or least value, to half of its last digit."""
    number = told.replace("−", "-")
    ends = np.array([peak.value for peak in extremes(page.curves.scene, curve)])
    digits = len(number.partition(".")[2])
    return bool(ends.size and np.abs(ends - float(number)).min() <= 0.501 * 10.0**-digits)


# a crank that turns, an input that swings
@pytest.mark.parametrize("name", ["press", "double-rocker"])
@pytest.mark.slow
def test_words_of_the_most_telling_quantities_are_tied_to_their_dots(name: str) -> None:
    for token in load(name).telling[:4]:
        assert [*faults(page_of(name, token))] == [], token


@pytest.mark.long
@pytest.mark.parametrize("name", names())
def test_words_of_every_quantity_are_tied_to_their_dots(name: str) -> None:
    for token in load(name).quantities:
        assert [*faults(page_of(name, token))] == [], token


@pytest.mark.parametrize(
    ("tokens", "size", "over"),
    [
        (("6.angular_acceleration",), (960, 540), "time"),
        (("6.angular_acceleration",), (480, 270), None),
        (("3.angular_velocity", "4.angular_velocity", "6.angular_velocity"), (960, 540), None),
        (("3.angular_velocity", "5.travel", "6.angular_acceleration"), (1280, 720), None),
    ],
)
def test_words_on_a_crowded_chart_are_tied_to_their_dots(
    tokens: tuple[str, ...], size: tuple[int, int], over: Over | None
) -> None:
    assert [*faults(page_of("press", *tokens, size=size, over=over))] == []


@pytest.mark.parametrize("name", ["slider-crank", "excavator", "press"])
def test_words_of_a_small_chart_lie_on_no_curve_and_its_axes_have_four_ticks(name: str) -> None:
    scene = load(name)
    paces, found = (Pace(abs(scene.linkage.drive.speed), ""),), 0
    for charts in topics(Values(scene), paces).values():
        for tokens, _ in charts:
            page = Page(curves_of(scene, tokens, paces), size=(400, 225), brief=True)
            items = list(page.items())
            boxes = [box_of(page, one) for one in items if isinstance(one, Caption) and TOLD.match(one.text)]
            curves = [
                one
                for n, one in enumerate(items)
                if isinstance(one, Layer)
                and one.colour in {page.colour(curve) for curve in page.curves.curves}
                and sum(len(loop) for loop in one.loops) > 100
            ]
            assert curves
            places = np.concatenate([loop for layer in curves for loop in layer.loops])
            for box in boxes:
                assert min(gap(box, complex(place)) for place in places) > 0, tokens
            found += len(boxes)
            for axis in page._axes([[*side] for side in _by_unit(page.curves)], 150.0):
                assert 4 <= len(axis.ticks) <= 9, tokens
    assert found > 4


def test_more_than_six_curves_have_names_at_their_ends() -> None:
    page = page_of(
        "press", "3.angular_velocity", "4.angular_velocity", "6.angular_velocity", size=(1280, 720)
    )
    items = list(page.items())
    called = {page.curves.name(curve): curve for curve in page.curves.curves}
    assert len(called) == 9
    ends = {}
    for n, item in enumerate(items):
        if isinstance(item, Caption) and item.text in called:
            line, curve = items[n - 1], called[item.text]
            assert isinstance(line, Layer)
            assert line.colour == page.colour(curve)
            begin, end = line.loops[0][[0, 3]].mean(), line.loops[0][[1, 2]].mean()
            assert gap(box_of(page, item), end) < 6
            ends[item.text] = begin
    assert ends.keys() == called.keys()
    by_value = sorted(called, key=lambda name: -float(called[name].values[-1]))
    assert [ends[name].imag for name in by_value] == sorted(end.imag for end in ends.values())


def test_six_curves_have_none() -> None:
    page = page_of("press", "3.angular_velocity", "4.angular_velocity")
    words = [item.text for item in page.items() if isinstance(item, Caption)]
    assert not {page.curves.name(curve) for curve in page.curves.curves} & {*words}


@pytest.mark.parametrize(
    ("levels", "placed"),
    [
        ([10.0, 50.0], [10.0, 50.0]),  # far apart: as they are
        ([40.0, 41.0, 42.0], [31.0, 41.0, 51.0]),  # near: about their middle
        ([2.0, 3.0], [0.0, 10.0]),  # not above the top
        ([96.0, 99.0], [90.0, 100.0]),  # nor below the foot
    ],
)
def test_names_stand_apart_as_near_to_their_ends_as_can_be(levels: list[float], placed: list[float]) -> None:
    assert _apart(levels, 10.0, (0.0, 100.0)) == pytest.approx(placed)


# scene, quantity, over, what is said of its peaks: the place on the axis, in the axis' unit
PLACED: list[tuple[str, str, Over | None, set[str]]] = [
    ("kite", "coupler.angle", None, {"0.0° at 0.0°", "360.0° at 720.0°"}),
    ("double-rocker", "rocker.angular_velocity", None, {"1.399 at 1.163 s"}),
    ("slider-crank", "slider.travel", "phase", {"158.7 at 307.2°", "77.5 at 134.5°"}),
]


@pytest.mark.parametrize(("scene", "token", "over", "said"), PLACED)
def test_an_extreme_is_told_where_it_stands_on_the_axis(
    scene: str, token: str, over: Over | None, said: set[str]
) -> None:
    found = load(scene)
    curves = curves_of(found, (token,), (Pace(found.linkage.drive.speed, ""),), over)
    captions = {item.text for item in Page(curves, size=(960, 540)).items() if isinstance(item, Caption)}
    assert said <= captions


@pytest.mark.parametrize("scene", ["slider-crank", "crank-rocker", "press"])
def test_no_word_lies_on_a_measured_point(scene: str) -> None:
    found = load(scene)
    curves = curves_of(found, ("transmission_angle",), (Pace(found.linkage.drive.speed, ""),))
    (curve,) = curves.curves
    rows = tuple(
        (n, (float(x), float(value)))
        for n, (x, value) in enumerate(zip(curve.x[:-1:12], curve.values[:-1:12], strict=True))
    )
    page = Page(curves, size=(960, 540), measured=comparison(curves, NumberTable("t", (), rows), "t"))
    items = list(page.items())
    inner = [item for item in items if isinstance(item, Layer)][-1]
    dots = [complex(loop.mean()) for loop in inner.loops]
    words = [box_of(page, item) for item in items if isinstance(item, Caption) and TOLD.match(item.text)]
    assert len(dots) == len(rows)
    assert len(words) == 2
    assert min(gap(box, dot) for box in words for dot in dots) > 0


def test_what_the_axes_say_the_legend_does_not() -> None:
    alone, two = page_of("press", "3.angular_velocity"), page_of("press", "B.position")
    for page, said in ((alone, {"5 rad/s", "10 rad/s", "20 rad/s"}), (two, {"x, 5 rad/s", "y, 20 rad/s"})):
        captions = [item.text for item in page.items() if isinstance(item, Caption)]
        assert said <= set(captions)
        token = page.curves.curves[0].quantity
        assert sum(token.words in text for text in captions) == 1
