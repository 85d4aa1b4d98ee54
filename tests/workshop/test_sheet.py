"""The page that tells how to put it together, and the pictures on it."""

from __future__ import annotations

import re
from itertools import combinations, product
from xml.etree import ElementTree

import numpy as np
import pytest

from linkanim.picture.figure import figure
from linkanim.picture.items import Caption
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.text import Type, subscripted
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.workshop.drawing import Drawn, preview
from linkanim.workshop.request import make
from linkanim.workshop.sheet import Sheet


@pytest.mark.thinned(4)
@pytest.mark.parametrize("name", ["press", "crank-shaper", "drag-link", "cardan-gears"])
def test_every_part_is_listed_and_put_on_once_in_the_order_of_layers(name: str) -> None:
    made = make(load(name), fit="A4", bridge=True)
    text = Sheet(made).document()
    steps = [re.sub(r"<.*?>", "", step) for step in re.findall(r"Step \d+\. .*?(?=</figcaption>)", text)]
    put_on = [re.search(r"Layer (\d+): (\S+)", step) for step in steps[1:]]
    layers = [int(found[1]) for found in put_on if found]
    assert layers == sorted(layer for layer in made.layer if layer)
    numbers = {found[2].rstrip(",;") for found in put_on if found}
    assert numbers == {number for number, layer in zip(made.numbers, made.layer, strict=True) if layer}
    for pin in made.pins:
        written = pin.name if pin.stuck else pin.name[0]
        assert sum(written in step for step in steps) >= 1
    assert text.count("<tr><td>1</td>") >= 1


def test_a_slider_that_nothing_hangs_on_is_laid_into_its_slot() -> None:
    document = {
        "ground": {"O": [0, 0]},
        "joints": {"B": {"line": {"through": "O"}}},
        "drive": {"slider": {"joint": "B", "from": 0, "to": 100}},
    }
    made = make(scene_from(document, name="alone", where="alone.toml"))
    text = Sheet(made).document()
    assert "Lay 1 ground flat; lay 2 slider B into its slot." in text
    assert "all within the ground" in text
    # it has no pin, and nothing to be measured: no table of nothing
    assert "<tbody></tbody>" not in re.sub(r"\s", "", text)
    assert text.count("<table") == 3


def test_the_key_stands_on_a_page_of_its_own_and_the_tasks_do_not_tell_it() -> None:
    text = Sheet(make(load("crank-shaper"))).document()
    tasks, key = text.split("break-before: page", 1)
    stroke = load("crank-shaper").info.stroke
    assert stroke is not None
    assert f"{stroke:.1f} mm" in key
    assert f"{stroke:.1f} mm" not in tasks


def test_numbers_are_those_of_the_scene_s_own_figures() -> None:
    scene = load("press")
    made = make(scene)
    own = {body.name: number for body, number in figure(scene).numbers.items()}
    for number, plate in zip(made.numbers, made.plates, strict=True):
        assert all(own[name] == number for name in plate.bodies)
    assert len(set(make(load("jansen")).numbers)) == len(make(load("jansen")).plates)


@pytest.mark.parametrize("picture", ["plan", "side", "exploded"])
@pytest.mark.parametrize("name", ["jansen", "press", "scotch-yoke", "drag-link"])
def test_pictures_stay_within_their_size_and_show_every_part_and_pin(name: str, picture: str) -> None:
    made = make(load(name), bridge=True)
    size = 640, 420
    items = list(getattr(Drawn(made, 0.5, size), picture)())
    points = np.concatenate([loop for item in items if isinstance(item, Layer) for loop in item.loops])
    assert (points.real.min(), points.imag.min()) >= (0, 0)
    assert points.real.max() <= size[0]
    assert points.imag.max() <= size[1]
    words = {item.text for item in items if isinstance(item, Caption)}
    assert {pin.name[0] for pin in made.pins if not pin.stuck} <= {word[0] for word in words}
    if picture != "exploded":
        shown = {n for n, layer in zip(made.numbers, made.layer, strict=True) if layer}
        assert shown <= words


@pytest.mark.parametrize("name", ["jansen", "press", "scotch-yoke", "drag-link"])
def test_both_halves_of_a_preview_stay_in_theirs(name: str) -> None:
    shown = preview(make(load(name), bridge=True))
    halves = [
        np.concatenate([loop for layer in group.layers for loop in layer.loops]) for group in shown.groups()
    ]
    width, height = shown.size
    for left, points in zip((0, width / 2), halves, strict=True):
        assert left <= points.real.min() <= points.real.max() <= left + width / 2
        assert 0 <= points.imag.min() <= points.imag.max() <= height


def test_the_ground_throws_no_shadow_and_what_lies_on_it_does() -> None:
    made, theme = make(load("crank-rocker")), LIGHT
    plates: list[Colour] = []
    shadows: list[int] = []
    for item in Drawn(made, 0.5, (640, 420)).plan():
        if isinstance(item, Layer) and item.alpha < 0.2:
            shadows.append(len(plates))
        elif isinstance(item, Layer) and item.alpha == 0.9:
            plates.append(item.colour)
    # after the ground, two; before what lies on both of those, one; each twice, for its soft edge
    assert shadows == [1] * 4 + [3] * 2
    assert plates == [theme.gear, theme.bodies[0], theme.bodies[0], theme.bodies[1]]


@pytest.mark.parametrize("picture", ["plan", "side"])
@pytest.mark.parametrize("name", ["press", "crank-shaper", "slider-crank"])
def test_names_of_pins_do_not_lie_over_each_other_or_numbers(name: str, picture: str) -> None:
    made = make(load(name))
    new = range(len(made.plates)) if picture == "plan" else None
    drawn = Drawn(made, figure(made.scene).clearest, (440, 300), new=new)
    type_ = Type()
    names: list[Rect] = []
    numbers: list[Rect] = []
    for item in getattr(drawn, picture)():
        if isinstance(item, Caption) and not item.text.startswith(("layer", "ground")):
            wide = type_.width(item.text, item.size, strong=item.strong)
            left = item.at[0] - {"left": 0.0, "centre": wide / 2}.get(item.anchor, wide)
            (numbers if item.strong else names).append(Rect(left, item.at[1], wide, item.size))
    open_ = len(drawn._open()) if picture == "plan" else 0
    assert len(names) == sum(not pin.stuck for pin in made.pins) + open_
    assert not any(one.meets(other) for one, other in combinations(names, 2))
    assert picture == "side" or not any(one.meets(other) for one, other in product(names, numbers))


def test_layers_that_are_lifted_take_all_the_height_there_is() -> None:
    drawn = Drawn(make(load("jansen")), 0.5, (640, 420))
    for apart in (0.0, 0.5, 1.0):
        loops = [loop for item in drawn.exploded(apart) if isinstance(item, Layer) for loop in item.loops]
        lines = np.concatenate(loops).imag
        assert 240 < np.ptp(lines) < 400
        assert 10 < lines.min() < lines.max() < 410


@pytest.mark.slow
def test_the_page_is_well_formed_but_for_its_head() -> None:
    text = Sheet(make(load("press"), fit="Letter")).document()
    body = text[text.index("<body>") : text.index("</body>") + 7]
    ElementTree.fromstring(body)


@pytest.mark.parametrize("picture", ["plan", "exploded"])
@pytest.mark.parametrize("name", ["crank-rocker", "jansen"])
def test_pictures_letter_holes_without_a_pin_too(name: str, picture: str) -> None:
    made = make(load(name))
    drawn = Drawn(made, 0.5, (820, 500))
    words = [item.text for item in getattr(drawn, picture)() if isinstance(item, Caption)]
    holes = {hole.joint for plate in made.plates for hole in plate.holes if hole.joint}
    assert {subscripted(joint) for joint in holes} <= {*words}
    if picture == "exploded":  # in each layer, the ground too
        below = {pin.name for pin in made.pins if pin.low == 0 and not pin.stuck}
        assert all(words.count(subscripted(joint)) > 1 for joint in below)
