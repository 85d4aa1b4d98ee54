"""A chart on a page: what is on it, and that PNG and SVG are one picture."""

from __future__ import annotations

import io
import math
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pygame
import pytest

from linkanim.intake import NumberTable
from linkanim.paper.chart import Page
from linkanim.paper.curves import Pace, comparison, curves_of
from linkanim.paper.svg import svg
from linkanim.picture.items import Caption, Group, Halo
from linkanim.picture.raster import Layer, offscreen
from linkanim.picture.surface import printed
from linkanim.picture.text import Type, typesetting
from linkanim.scenes import load, names

SIZE = (800, 450)
SVG = "{http://www.w3.org/2000/svg}"


def _page(name: str, *tokens: str, speeds: tuple[float, ...] = (5.0,), size: tuple[int, int] = SIZE) -> Page:
    paces = tuple(Pace(speed, f"{speed:g} rad/s") for speed in speeds)
    return Page(curves_of(load(name), tokens, paces), size=size)


def _said(page: Page) -> list[str]:
    return [item.text for item in page.items() if isinstance(item, Caption)]


def test_one_curve_has_titles_and_no_legend() -> None:
    said = _said(_page("crank-rocker", "rocker.angular_velocity"))
    assert said[0] == "Crank-rocker"
    assert "Rocker: angular velocity ω₄ (rad/s)" in said
    assert "crank angle θ₂ (°)" in said
    assert not any(text.startswith("5 rad/s") for text in said)


def test_three_speeds_have_a_legend_in_words() -> None:
    said = _said(_page("press", "5.travel_velocity", speeds=(5.0, 10.0, 20.0)))
    assert {"5 rad/s", "10 rad/s", "20 rad/s"} <= set(said)


def test_extremes_are_told_with_value_and_angle() -> None:
    said = _said(_page("press", "5.travel_velocity", speeds=(10.0,)))
    assert "659 at 34.8°" in said
    assert "−255 at 164.9°" in said
    assert "3.17 at 115.3°" in _said(_page("crank-rocker", "rocker.angular_velocity"))


# tokens, the plots' vertical titles: one unit shares an axis, two have one each, more a strip each
UNITS = [
    (("3.angular_velocity", "6.angular_velocity"), ["ω₃, ω₆ (rad/s)"]),
    (
        ("3.angular_velocity", "return.force"),
        ["ω₃ (rad/s)", "F_{return} (N)"],  # the legend says the words
    ),
    (
        ("3.angular_velocity", "return.force", "transmission_angle"),
        [
            "Link 3: angular velocity ω₃ (rad/s)",
            "Return spring: force F_{return} (N)",
            "Transmission angle μ (°)",
        ],
    ),
]


@pytest.mark.parametrize(("tokens", "titles"), UNITS)
def test_units_have_axes_of_their_own(tokens: tuple[str, ...], titles: list[str]) -> None:
    page = _page("press", *tokens)
    titled = {
        item.text: item.at for item in page.items() if isinstance(item, Caption) and item.text in titles
    }
    assert list(titled) == titles
    heights = {round(y) for _, y in titled.values()}
    assert len(heights) == (1 if len(titles) <= 2 else len(titles))
    assert _said(page).count("crank angle θ₂ (°)") == 1
    assert all(item.at[1] + item.size <= SIZE[1] for item in page.items() if isinstance(item, Caption))


# One line of zero crosses the plot: a curve that crosses it is zero there, whichever axis it is read on.
def test_two_axes_about_zero_have_it_at_one_height() -> None:
    page = _page("press", "5.travel_velocity", "3.angular_velocity")
    zeros = [item.at for item in page.items() if isinstance(item, Caption) and item.text == "0"]
    assert len(zeros) == 2
    (left, height), (right, other) = zeros
    assert height == pytest.approx(other)
    assert left < right


@pytest.mark.parametrize("size", [SIZE, (320, 180), (200, 900), (64, 64)])
@pytest.mark.parametrize("name", ["press", "double-rocker"])
def test_no_two_extremes_are_told_in_one_place_and_all_stays_on_the_page(
    name: str, size: tuple[int, int]
) -> None:
    page = _page(
        name, *(("5.travel_velocity", "5.travel") if name == "press" else ("coupler.angle",)), size=size
    )
    boxes = []
    for item in page.items():
        if isinstance(item, Caption) and " at " in item.text:
            boxes.append(pygame.Rect(item.at, (page.pen.type.width(item.text, item.size), item.size)))
    for n, box in enumerate(boxes):
        assert box.collidelist(boxes[n + 1 :]) < 0
        assert pygame.Rect(0, 0, *size).contains(box)
    assert page.surface().get_size() == size


def _boxes(page: Page) -> list[pygame.Rect]:
    """Where the captions of a page stand."""
    boxes = []
    for item in page.items():
        if isinstance(item, Caption):
            wide = page.pen.type.width(item.text, item.size)
            left = item.at[0] - {"left": 0.0, "centre": wide / 2, "right": wide}[item.anchor]
            boxes.append(pygame.Rect(round(left), round(item.at[1]), wide, item.size))
    return boxes


# One plot, one with an axis at either side, three, each as small as has room for all words.
@pytest.mark.parametrize(
    ("tokens", "size"),
    [
        (("5.travel_velocity",), (320, 180)),
        (UNITS[0][0], (320, 180)),
        (("5.travel_velocity", "5.travel"), (480, 270)),
        (UNITS[2][0], SIZE),
        (UNITS[2][0], (1280, 720)),
    ],
)
def test_no_words_of_a_chart_stand_on_others(tokens: tuple[str, ...], size: tuple[int, int]) -> None:
    boxes = _boxes(_page("press", *tokens, speeds=(5.0, 10.0), size=size))
    for n, box in enumerate(boxes):
        assert box.collidelist(boxes[n + 1 :]) < 0


def _extent(layer: Layer) -> pygame.Rect:
    points = np.concatenate([np.ravel(loop) for loop in layer.loops])
    left, top = points.real.min(), points.imag.min()
    return pygame.Rect(left, top, np.ceil(np.ptp(points.real)), np.ceil(np.ptp(points.imag)))


def test_a_legend_s_words_stand_beside_their_line() -> None:
    items = list(_page("press", "5.travel_velocity", speeds=(5.0, 10.0)).items())
    for before, item in pairwise(items):
        if isinstance(item, Caption) and item.text.endswith("rad/s") and isinstance(before, Layer):
            line = _extent(before)
            assert line.right < item.at[0] < line.right + line.width
            assert item.at[1] <= line.centery <= item.at[1] + item.size


def test_a_legend_s_entries_stand_a_letter_s_height_and_more_apart() -> None:
    page = _page("press", "5.travel_velocity", speeds=(5.0, 10.0, 20.0))
    items = list(page.items())
    places = {item.text: n for n, item in enumerate(items) if isinstance(item, Caption)}
    for before, after in pairwise(("5 rad/s", "10 rad/s", "20 rad/s")):
        words, line = items[places[before]], items[places[after] - 1]
        assert isinstance(words, Caption)
        assert isinstance(line, Layer)
        gap = _extent(line).x - words.at[0] - page.pen.type.width(words.text, words.size)
        assert gap == pytest.approx(1.6 * words.size, abs=1.5)


# a page's edge is that of the window, and as wide on all four sides as its words go
@pytest.mark.parametrize("tokens", [("5.travel_velocity",), ("5.travel_velocity", "3.angular_velocity")])
def test_a_chart_fills_its_page_up_to_an_edge(tokens: tuple[str, ...]) -> None:
    page = _page("press", *tokens, size=(1280, 720))
    title = next(iter(page.items()))
    assert isinstance(title, Caption)
    assert title.at == pytest.approx((20, 20), abs=0.1)
    boxes, small = _boxes(page), page.pen.small
    assert min(box.left for box in boxes) == pytest.approx(20, abs=1)
    assert min(box.left for box in boxes[1:]) == pytest.approx(20, abs=0.2 * small)
    assert 1260 - 1.5 * small <= max(box.right for box in boxes) <= 1260
    assert 700 - 0.5 * small <= max(box.bottom for box in boxes) <= 700


def test_the_greatest_value_is_told_above_its_dot_and_the_least_below() -> None:
    items = list(_page("press", "5.travel_velocity", speeds=(10.0,)).items())
    places = {}
    for n, item in enumerate(items):
        if isinstance(item, Caption) and " at " in item.text:
            dot = items[n - 1]
            assert isinstance(dot, Layer)
            assert item.halo
            places[item.text] = item.at[1] + item.size / 2 - _extent(dot).centery
    assert places["659 at 34.8°"] < 0 < places["−255 at 164.9°"]


def test_an_extreme_at_the_end_of_a_curve_is_told_beside_its_dot() -> None:
    page = _page("drag-link", "rocker.angle")
    items = list(page.items())
    told = [n for n, item in enumerate(items) if isinstance(item, Caption) and " at " in item.text]
    assert len(told) == 2
    for n in told:
        words, dot = items[n], items[n - 1]
        assert isinstance(words, Caption)
        assert isinstance(dot, Layer)
        right = words.at[0] + page.pen.type.width(words.text, words.size)
        assert right < _extent(dot).left or words.at[0] > _extent(dot).right


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_a_scene_has_its_chart(name: str) -> None:
    page = _page(name, *load(name).telling[:4], size=(320, 180))
    assert len(np.unique(pygame.surfarray.array3d(page.surface()).reshape(-1, 3), axis=0)) > 8


def test_the_svg_is_the_picture_of_the_png() -> None:
    page = _page("press", "5.travel_velocity", "5.travel_acceleration", speeds=(5.0, 20.0))
    shapes = [item for item in page.items() if isinstance(item, Layer)]
    ours = offscreen(SIZE)
    ours.fill(page.pen.theme.background)
    printed(ours, [Group("shapes", shapes)], page.pen.type)
    # drawn by SDL_image's own SVG reader, which knows paths and no text
    theirs = pygame.image.load(io.BytesIO(svg(SIZE, page.background, shapes, title="t").encode()), "t.svg")
    assert theirs.get_size() == SIZE
    one, other = (pygame.surfarray.array3d(picture).astype(float) for picture in (ours, theirs))
    noise = float(((one - other) ** 2).mean())
    assert 10 * math.log10(255**2 / noise) > 30


def test_the_svg_holds_all_that_is_said_as_text() -> None:
    page = _page("press", "return.force", "3.angular_velocity")
    document = ElementTree.fromstring(svg(SIZE, None, page.items(), title="a < b & c"))
    assert document.find(f"{SVG}title").text == "a < b & c"  # type: ignore[union-attr]
    found = ["".join(text.itertext()) for text in document.iter(f"{SVG}text")]
    assert {"Return spring: force Freturn", "Freturn (N)"} <= set(found)
    assert {"Link 3: angular velocity ω3", "ω3 (rad/s)"} <= set(found)
    assert document.find(f"{SVG}rect") is None
    assert document.get("viewBox") == "0 0 800 450"


def test_a_line_goes_on_at_its_height_after_a_subscript() -> None:
    line = Caption("v_{B} and ω₃ (mm)", (10.0, 10.0), 20, (0, 0, 0))
    text = ElementTree.fromstring(svg((100, 40), None, [line], title="t")).find(f"{SVG}text")
    assert text is not None
    shifts = [float(span.get("dy", "0")) for span in text.iter(f"{SVG}tspan")]
    assert len(shifts) == 4
    assert sum(shifts) == 0
    smaller = [span.text for span in text.iter(f"{SVG}tspan") if float(span.get("font-size", "20")) < 20]
    assert smaller == [span.text for span in text.iter(f"{SVG}tspan") if float(span.get("dy", "0")) > 0]


def test_words_in_an_svg_stand_where_they_are_set_in_their_size_and_weight() -> None:
    lines = [
        Caption(words, (30.0, 10.0), 20, (0, 0, 255), strong=words == "strong")
        for words in ("strong", "plain")
    ]
    strong, plain = ElementTree.fromstring(svg((100, 40), None, lines, title="t")).iter(f"{SVG}text")
    how = typesetting(20)
    wanted = {"x": "30.00", "y": f"{10 + how.baseline:.2f}", "font-size": f"{how.em:.2f}", "fill": "#0000ff"}
    assert how.baseline > 0
    fixed = {"textLength": strong.get("textLength"), "lengthAdjust": "spacingAndGlyphs"}
    assert float(str(plain.get("textLength"))) == pytest.approx(Type().width("plain", 20), rel=0.04)
    assert plain.attrib == {**wanted, "text-anchor": "start", **fixed, "textLength": plain.get("textLength")}
    assert strong.attrib == {**wanted, "text-anchor": "start", "font-weight": "600", **fixed}
    rimmed = lines[1]._replace(halo=Halo((255, 255, 0), 1.5))
    (text,) = ElementTree.fromstring(svg((100, 40), None, [rimmed], title="t")).iter(f"{SVG}text")
    rim = {"stroke": "#ffff00", "stroke-width": "3.00", "stroke-linejoin": "round", "paint-order": "stroke"}
    assert text.attrib == {**plain.attrib, **rim}


def test_a_path_in_an_svg_is_its_loop_to_hundredths_of_a_pixel() -> None:
    loop = np.array([1.2345, 1.2349, 8 + 2.5j, 4 + 6.2j])
    document = ElementTree.fromstring(
        svg((10, 10), None, [Layer((255, 0, 0), [loop, loop + 1], 0.5)], title="t")
    )
    (path,) = document.iter(f"{SVG}path")
    assert path.attrib == {
        "fill": "#ff0000",
        "fill-opacity": "0.5",
        "d": "M1.23 0L8 2.5L4 6.2ZM2.23 0L9 2.5L5 6.2Z",
    }


def test_groups_of_one_name_have_ids_of_their_own() -> None:
    square = Layer((0, 0, 0), [np.array([0, 1, 1 + 1j])])
    groups = [Group(name, [square]) for name in ("a b", "a b", "c", "a b")]
    document = ElementTree.fromstring(svg((10, 10), None, groups, title="t"))
    assert [group.get("id") for group in document.iter(f"{SVG}g")] == ["a_b", "a_b-2", "c", "a_b-3"]


def _table(first: np.ndarray, values: np.ndarray) -> NumberTable:
    rows = [(n, (x, y)) for n, (x, y) in enumerate(zip(first.tolist(), values.tolist(), strict=True), 1)]
    return NumberTable("t.csv", (), tuple(rows))


def test_a_table_is_laid_over_the_curve_and_its_largest_difference_found() -> None:
    page = _page("press", "3.angle", speeds=(10.0,))
    scene = page.curves.scene
    angles = np.array([0.0, 87.0, 200.0, 359.0])
    exact = np.degrees(scene.solve(angle=np.radians(angles)).angle["3"])
    errors = np.array([0.0, 0.02, 360.0 - 0.05, 0.01])
    found = comparison(page.curves, _table(angles, exact + errors), "measured")
    assert found.differences == pytest.approx([0.0, 0.02, -0.05, 0.01])
    assert found.worst == 2
    assert [x for x, _ in found.points] == pytest.approx(angles)
    shown = Page(page.curves, size=SIZE, measured=found)
    assert "measured" in _said(shown)
    dot, words = next(pair for pair in pairwise(shown.items()) if getattr(pair[1], "text", "") == "measured")
    assert isinstance(dot, Layer)
    assert isinstance(words, Caption)
    assert _extent(dot).width == _extent(dot).height < 0.7 * words.size
    assert words.at[0] - 3 * words.size < _extent(dot).centerx < words.at[0] - 0.5 * words.size
    assert words.at[1] < _extent(dot).centery < words.at[1] + words.size


def test_a_table_of_rates_is_compared_at_the_charts_speed_also_of_a_swing() -> None:
    page = _page("double-rocker", "rocker.angular_velocity", speeds=(3.0,))
    phases = np.array([0.5, 1.0, 2.0])
    motion = page.curves.scene.solve(phase=phases, speed=3.0)
    table = _table(np.degrees(motion.coordinate), motion.angular_velocity["rocker"])
    assert comparison(page.curves, table, "t").differences == pytest.approx(0.0, abs=1e-9)


def test_curves_that_share_a_plot_differ_by_their_dashes() -> None:
    page = _page("crank-rocker", "rocker.angular_velocity", "coupler.angular_velocity")
    layers = [item for item in page.items() if isinstance(item, Layer)]
    counts = {
        layer.colour: max(len(one.loops) for one in layers if one.colour == layer.colour) for layer in layers
    }
    first, second = (page.colour(curve) for curve in page.curves.curves)
    assert counts[first] <= 2 < counts[second]


def test_a_legend_s_lines_are_dashed_as_their_curves_are() -> None:
    page = _page("crank-rocker", "rocker.angular_velocity", "coupler.angular_velocity")
    items = list(page.items())
    for curve in page.curves.curves:
        (n,) = (n for n, item in enumerate(items) if getattr(item, "text", "") == page.curves.words(curve))
        swatch, drawn = (
            items[n - 1],
            next(item for item in items[n:] if isinstance(item, Layer) and item.colour == page.colour(curve)),
        )
        assert isinstance(swatch, Layer)
        assert swatch.colour == drawn.colour
        assert (len(swatch.loops) > 1) == bool(page.dashes(curve))
        assert _extent(Layer((0, 0, 0), swatch.loops[:1])).width == pytest.approx(
            page.dashes(curve)[0] * 1.2 * page.pen.line if page.dashes(curve) else 2.6 * page.pen.small, abs=4
        )
