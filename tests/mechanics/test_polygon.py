"""Velocity and acceleration polygons: they close, and say what `solve` says."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import linkanim
from linkanim.mechanics.polygons import Chain, Order, chains, image
from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene

CLOSED = 1e-12
"""Of the polygon's size."""
MOMENTS = np.array([0.1, 0.37, 0.62, 0.93])
"""In shares of the true period: no limits, no change points."""


def polygon(name: str, order: Order, share: float = 0.1, speed: float = 2.0) -> tuple[Chain, ...]:
    scene = load(name)
    return chains(scene.pose(share * scene.period, speed=speed), scene.linkage, order)


def closes(scene: Scene, order: Order) -> None:
    """Follow every chain from image to image, each as `solve` gives it."""
    motion = scene.solve(phase=MOMENTS * scene.period, speed=-3.0)
    found = chains(motion, scene.linkage, order, scene.trace)
    assert found
    assert {*scene.trace} <= {chain.end for chain in found}
    size = max(float(np.abs(side.end).max()) for chain in found for side in chain.sides)
    for chain in found:
        begin = image(motion, chain.start, order) if chain.start else np.zeros(len(MOMENTS))
        for side in chain.sides:
            assert np.abs(side.begin - begin).max() <= CLOSED * size
            begin = side.end
        assert np.abs(begin - image(motion, chain.end, order)).max() <= CLOSED * size, chain


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_chain_ends_in_the_image_that_solve_gives(name: str, order: Order) -> None:
    closes(load(name), order)


@pytest.mark.parametrize("order", [1, 2])
def test_so_does_that_of_a_slot_that_misses_its_pivot(order: Order, tmp_path: Path) -> None:
    whole = Path(linkanim.__file__).parent / "scenes/catalogue/sliders/inverted-slider-crank.toml"
    path = tmp_path / "aside.toml"
    path.write_text(whole.read_text().replace('through = "A" }', 'through = "A", offset = 25 }'))
    assert load(path).linkage != load("inverted-slider-crank").linkage
    closes(load(path), order)


def sides(found: tuple[Chain, ...]) -> dict[str, complex]:
    return {side.symbol: side.end - side.begin for chain in found for side in chain.sides}


# a loop of bars, a slider on the ground, a slot that turns, a slot that only shifts
SYMBOLS = [
    ("crank-rocker", 1, ["v_{A}", "v_{BA}", "v_{B}"]),
    ("crank-rocker", 2, ["a_{A}", "a_{B}", "aⁿ_{A}", "aᵗ_{A}", "aⁿ_{BA}", "aᵗ_{BA}", "aⁿ_{B}", "aᵗ_{B}"]),
    ("slider-crank", 1, ["v_{A}", "v_{BA}", "v_{B}"]),
    ("slider-crank", 2, ["a_{A}", "aⁿ_{A}", "aᵗ_{A}", "aⁿ_{BA}", "aᵗ_{BA}", "a_{B}"]),
    ("inverted-slider-crank", 1, ["v_{A}", "v_{P}", "v_{A′}", "vʳ_{A}"]),
    ("scotch-yoke", 1, ["v_{A}", "v_{Y}", "vʳ_{A}"]),
]


@pytest.mark.parametrize(("name", "order", "expected"), SYMBOLS)
def test_the_vectors_are_named(name: str, order: Order, expected: list[str]) -> None:
    found = [side.symbol for chain in polygon(name, order) for side in chain.sides]
    assert sorted(found) == sorted(expected)


def test_the_point_of_the_coupler_is_the_corner_of_its_velocity_image() -> None:
    scene = load("crank-rocker")
    pose = scene.pose(1.0)
    found = chains(pose, scene.linkage, 1, scene.trace)
    assert {"v_{P}", "v_{PA}"} <= {side.symbol for chain in found for side in chain.sides}
    images = [image(pose, name, 1) for name in "ABP"]
    places = [complex(*pose.position[name]) for name in "ABP"]
    shapes = [(p - a) / (b - a) for a, b, p in (images, places)]
    assert shapes[0] == pytest.approx(shapes[1], rel=1e-12)


def test_coriolis_stands_square_to_the_slot_and_is_twice_the_rates() -> None:
    scene = load("inverted-slider-crank")
    pose = scene.pose(1.0)
    (x0, y0), (x1, y1) = pose.position["O4"], pose.position["P"]
    along = complex(x1 - x0, y1 - y0) / math.hypot(x1 - x0, y1 - y0)
    rate = (along.conjugate() * sides(chains(pose, scene.linkage, 1))["vʳ_{A}"]).real
    slotted = next(body.name for body in scene.linkage.bodies if set(body.joints) == {"O4", "P"})
    across = sides(chains(pose, scene.linkage, 2))["aᶜ_{A}"]
    assert across == pytest.approx(2j * pose.angular_velocity[slotted] * rate * along, rel=1e-12)


def scaled(scene: Scene, speed: float, order: Order) -> list[complex]:
    found = chains(scene.pose(1.0, speed=speed), scene.linkage, order)
    return [side.end for chain in found for side in chain.sides]


def test_polygons_grow_with_the_speed_and_with_its_square() -> None:
    scene = load("press")
    assert scaled(scene, 6.0, 1) == pytest.approx([3 * end for end in scaled(scene, 2.0, 1)], rel=1e-12)
    assert scaled(scene, -6.0, 2) == pytest.approx([9 * end for end in scaled(scene, 2.0, 2)], rel=1e-9)


def test_at_rest_nothing_has_a_length() -> None:
    assert all(end == 0 for order in (1, 2) for end in scaled(load("press"), 0.0, order))


def test_at_a_limit_of_the_input_the_crank_rests_and_the_polygon_still_closes() -> None:
    scene = load("double-rocker")
    pose = scene.pose(0.0)
    found = {chain.end: chain for chain in chains(pose, scene.linkage, 1) if chain.start is None}
    assert abs(found["A"].sides[-1].end) <= CLOSED * abs(found["B"].sides[-1].end)
    (across,) = (chain for chain in chains(pose, scene.linkage, 1) if chain.start == "A")
    assert across.sides[-1].end == pytest.approx(image(pose, "B", 1), rel=1e-12)
