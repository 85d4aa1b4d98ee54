"""Bodies that say how they are drawn: every look, its place in the picture, its colour."""

from __future__ import annotations

from typing import Any, get_args

import numpy as np
import pytest

from linkanim.errors import SceneError
from linkanim.picture.arrangement.sweep import sweep_of
from linkanim.picture.figure import figure
from linkanim.picture.layout import Gauge
from linkanim.picture.parts.bodies import body_parts, colours_of
from linkanim.picture.parts.body_shapes import SHAPES, wheel_radius
from linkanim.picture.theme import DARK, LIGHT
from linkanim.picture.view import View
from linkanim.scenes import load
from linkanim.scenes.reading.read import scene_from
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
@pytest.mark.parametrize("look", [look for look in get_args(Outline) if look not in ("none", "wheel")])
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
    names = [part.name for part in body_parts(figure(four_bar(look="none")), View(1, 0, 0), GAUGE, LIGHT)]
    assert "rocker" not in names
    assert "coupler" in names


def test_a_wheel_lies_behind_bars_and_within_the_picture() -> None:
    scene = four_bar(look="wheel")
    parts = [part.name for part in body_parts(figure(scene), View(1, 0, 0), GAUGE, LIGHT) if part.name]
    assert parts.index("rocker") < parts.index("crank")
    box = sweep_of(figure(scene)).box
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
    ],
)
def test_a_look_that_is_none_is_refused(body: dict[str, Any], where: str, words: str) -> None:
    with pytest.raises(SceneError) as refusal:
        four_bar(**body)
    assert where in str(refusal.value)
    assert words in str(refusal.value)


def test_the_locomotive_runs_on_wheels() -> None:
    assert [style.outline for _, style in load("parallel-locomotive").styles].count("wheel") == 2
