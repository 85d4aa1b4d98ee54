"""Bodies that say how they are drawn: every look, its place in the picture, its colour."""

from __future__ import annotations

from typing import Any, get_args

import numpy as np
import pytest

from linkanim.errors import SceneError
from linkanim.picture.bodies import SHAPES, WHEELS, body_parts, colours_of, wheel_radius
from linkanim.picture.figure import DrawContext, Figure, figure
from linkanim.picture.fit import of_linkage
from linkanim.picture.fittings import fittings, ground_layers, rail_reach, rails_of
from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Loop
from linkanim.picture.theme import DARK, LIGHT
from linkanim.picture.view import View
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Outline, Scene

GAUGE = Gauge(8.0, 1.0, 1.0, 3.0)
CORNERS = [0j, 100 + 0j, 60 - 40j]
COLOURS = (1, 2, 3), (4, 5, 6)


def four_bar(**body: Any) -> Scene:
    document = {
        "four-bar": {"ground": 100, "crank": 30, "coupler": 90, "rocker": 80},
        "bodies": {"rocker": {"joints": ["O4", "B"], **body}},
    }
    return scene_from(document, name="my", where="my")


def covered(look: str, points: list[complex]) -> tuple[float, float, float, float]:
    """Return left, right, top and bottom of what is drawn."""
    drawn = np.concatenate([loop for layer in SHAPES[look](points, GAUGE, COLOURS) for loop in layer.loops])
    return drawn.real.min(), drawn.real.max(), drawn.imag.min(), drawn.imag.max()


def test_every_look_is_drawn() -> None:
    assert set(SHAPES) == set(get_args(Outline))


@pytest.mark.parametrize("points", [CORNERS, CORNERS[:2]], ids=["three joints", "two"])
@pytest.mark.parametrize("look", [look for look in get_args(Outline) if look not in ("none", *WHEELS)])
def test_a_look_reaches_from_joint_to_joint_and_little_further(look: str, points: list[complex]) -> None:
    left, right, top, bottom = covered(look, points)
    bar = GAUGE.bar
    assert -2 * bar <= left <= 0
    assert max(p.real for p in points) - 0.5 <= right <= 100 + 3 * bar
    assert -40 - 3 * bar <= top <= 0
    assert 0 <= bottom <= 4 * bar


@pytest.mark.parametrize("look", ["bar", "hook"])
def test_a_bar_s_edge_is_an_outline_wide(look: str) -> None:
    gauge = Gauge(8.0, 1.5, 1.0, 3.0)
    edge, fill = (np.concatenate(layer.loops) for layer in SHAPES[look](CORNERS[:2], gauge, COLOURS))
    assert fill.real.min() - edge.real.min() == pytest.approx(1.5, abs=0.05)
    assert fill.imag.min() - edge.imag.min() == pytest.approx(1.5, abs=0.05)


def test_a_wheel_goes_round_its_first_joint_and_its_furthest() -> None:
    radius = wheel_radius(CORNERS, GAUGE)
    assert radius > 100
    assert covered("wheel", CORNERS) == pytest.approx((-radius, radius, -radius, radius), rel=1e-3)


def test_what_is_not_drawn_leaves_nothing_but_its_pins() -> None:
    assert SHAPES["none"](CORNERS, GAUGE, COLOURS) == []
    context = DrawContext(figure(four_bar(look="none")), View(1, 0, 0), GAUGE, LIGHT)
    names = [part.name for part in body_parts(context)]
    assert "rocker" not in names
    assert "coupler" in names


def test_a_wheel_lies_behind_bars_and_within_the_picture() -> None:
    scene = four_bar(look="wheel")
    context = DrawContext(figure(scene), View(1, 0, 0), GAUGE, LIGHT)
    parts = [part.name for part in body_parts(context) if part.name]
    assert parts.index("rocker") < parts.index("crank")
    box = of_linkage(figure(scene), GAUGE).box
    assert box.right >= 100 + 80
    assert box.low <= -79


def test_a_colour_is_the_scene_s_own_in_both_themes() -> None:
    scene = four_bar(colour="#0a1B2c")
    for theme in (LIGHT, DARK):
        assert colours_of(figure(scene), theme)["rocker"] == (10, 27, 44)


def test_looks_change_no_motion() -> None:
    plain, wheeled = four_bar(), four_bar(look="wheel", colour="#ffffff")
    ends = [scene.solve(phase=1.0).position["B"].tolist() for scene in (plain, wheeled)]
    assert ends[0] == ends[1]


@pytest.mark.parametrize(
    ("body", "where", "words"),
    [
        ({"look": "beam"}, "bodies.rocker.look", '"bar" or "plate"'),
        ({"colour": "red"}, "bodies.rocker.colour", "#d55e00"),
        ({"colour": "#12345"}, "bodies.rocker.colour", "#d55e00"),
        ({"colour": 3}, "bodies.rocker.colour", "text"),
        ({"radius": 30}, "bodies.rocker.radius", 'look = "wheel"'),
        ({"look": "bar", "radius": 30}, "bodies.rocker.radius", 'look = "wheel"'),
    ],
)
def test_a_look_that_is_none_is_refused(body: dict[str, Any], where: str, words: str) -> None:
    with pytest.raises(SceneError) as refusal:
        four_bar(**body)
    assert where in str(refusal.value)
    assert words in str(refusal.value)


def test_the_locomotive_runs_on_a_rail_its_crank_pins_within_its_wheels() -> None:
    shown, view = figure(load("parallel-locomotive")), View(1.0, 0.0, 0.0)
    wheels = [body for body in shown.bodies if shown.scene.style(body.name).outline == "railwheel"]
    assert [shown.wheel_reach(body) for body in wheels] == [64, 64]
    assert max(abs(shown.start(name)) for name in wheels[0].joints) < 40
    lines = np.concatenate(list(ground_layers(DrawContext(shown, view, GAUGE, LIGHT))[0].loops))
    rail = lines[abs(lines.imag - 64) < 3]
    assert rail.real.min() <= -64
    assert rail.real.max() >= 140 + 64


def test_what_the_locomotive_lists_before_its_wheels_lies_behind_them() -> None:
    parts = body_parts(DrawContext(figure(load("parallel-locomotive")), View(1.0, 0.0, 0.0), GAUGE, LIGHT))
    names = [part.name for part in parts]
    assert names.index("rod2") < names.index("wheel") < names.index("wheel2") < names.index("rod")


def test_a_wheel_is_as_large_as_it_says_and_no_smaller_than_its_joints() -> None:
    for radius, wanted in ((120.0, 120.0), (10.0, 80.0)):
        shown = figure(four_bar(look="wheel", radius=radius))
        (body,) = (body for body in shown.bodies if body.name == "rocker")
        assert shown.wheel_reach(body) == pytest.approx(wanted)
        assert covered_by(shown, "rocker").imag.max() == pytest.approx(wanted, abs=GAUGE.bar + 0.5)


def covered_by(shown: Figure, name: str) -> Loop:
    """Return the points of a body about its first joint."""
    parts = body_parts(DrawContext(shown, View(1.0, 0.0, 0.0), GAUGE, LIGHT))
    (part,) = (part for part in parts if part.name == name)
    return np.concatenate([loop for layer in part.layers for loop in layer.loops])


# A jaw bends down: so does its pad. A bar that bends up has it above, a straight one below.
@pytest.mark.parametrize(
    ("points", "side"),
    [([0j, 60 - 20j, 120 + 0j], 1), ([0j, 60 + 20j, 120 + 0j], -1), ([0j, 100 + 0j], 1)],
)
def test_a_pad_is_on_the_side_to_which_its_bar_bends(points: list[complex], side: int) -> None:
    drawn = np.concatenate([loop for layer in SHAPES["pad"](points, GAUGE, COLOURS) for loop in layer.loops])
    end = points[-1]
    across = ((drawn - end) / ((end - points[-2]) / abs(end - points[-2]))).imag * side
    assert across.max() > 2 * GAUGE.bar
    assert across[np.abs(drawn - end) < 3 * GAUGE.bar].min() > -1.2 * GAUGE.bar


def test_a_bucket_s_back_bends_away_from_its_first_joint_and_ends_in_a_tooth() -> None:
    pivot, link, edge = 0j, -60 + 0j, 30 + 80j
    layers = SHAPES["bucket"]([pivot, link, edge], GAUGE, COLOURS)
    drawn = np.concatenate([loop for layer in layers for loop in layer.loops])
    across = ((drawn - link) / (edge - link)).imag * abs(edge - link)
    assert across.max() > 0.15 * abs(edge - link)
    assert np.abs(layers[0].loops[0] - edge).max() > 2 * GAUGE.bar


def test_the_engine_s_rod_stays_within_its_cylinder_and_the_piston_below_the_head() -> None:
    shown, view, gauge = figure(load("engine")), View(3.0, 0.0, 0.0), Gauge(8.0, 1.0, 4.0, 2.0)
    bench = DrawContext(shown, view, gauge, LIGHT)
    (lines,) = rails_of(bench)
    walls = np.concatenate(lines)
    piston = fittings(bench)[0].behind[0]
    pin, crank = (shown.path(name, view) for name in ("B", "A"))
    aside, opening = rail_reach(bench, "B"), walls.imag.max()
    share = np.clip((opening - pin.imag) / (crank.imag - pin.imag), 0, 1)
    within = np.abs((pin + share * (crank - pin)).real)
    assert within.max() + gauge.bar < aside
    reach = np.concatenate([loop for layer in piston.layers for loop in layer.loops])
    assert np.abs(reach.real).max() < aside
    assert pin.imag.min() + reach.imag.min() > walls.imag.min() + gauge.bar


def test_guides_are_open_where_they_cross() -> None:
    shown, view = figure(load("elliptic-trammel")), View(3.0, 0.0, 0.0)
    bench = DrawContext(shown, view, GAUGE, LIGHT)
    for lines in rails_of(bench):
        long = [loop for loop in lines if np.ptp(loop.real) + np.ptp(loop.imag) > 50]
        assert len(long) == 4
        inside = rail_reach(bench, "X") - GAUGE.line
        assert all(np.abs(loop.real).max() > inside < np.abs(loop.imag).max() for loop in long)
        assert not any(
            loop.real.min() < 0 < loop.real.max() or loop.imag.min() < 0 < loop.imag.max() for loop in long
        )
