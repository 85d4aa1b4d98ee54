"""Instant centres of any two bodies, and the centrodes of the coupler."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.mechanics.centres import centrodes, pole
from linkanim.mechanics.linkage import Body
from linkanim.mechanics.measures import coupler_body
from linkanim.mechanics.motion import Motion
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

PHASES = np.linspace(0.1, 6.1, 13)
Path = NDArray[np.complex128]


def body(scene: Scene, name: str | None) -> Body | None:
    return next((one for one in scene.linkage.bodies if one.name == name), None)


def centre(motion: Motion, scene: Scene, one: str, other: str | None = None) -> Path:
    first = body(scene, one)
    assert first is not None
    x, y = (np.asarray(part) for part in pole(motion, first, body(scene, other)))
    found = np.full(len(x), np.inf + 0j)
    found[np.isfinite(x)] = (x + 0j)[np.isfinite(x)] + 1j * y[np.isfinite(x)]
    return found


# where two bodies meet in a pin, the pin is their centre; a block turns on its rod's pin
PINNED = [
    ("crank-rocker", "crank", None, "O2"),
    ("crank-rocker", "crank", "coupler", "A"),
    ("crank-rocker", "rocker", "coupler", "B"),
    ("slider-crank", "rod", "slider", "B"),
    ("press", "3", "6", "B"),
    ("press", "4", "5", "C"),
]


@pytest.mark.parametrize(("name", "one", "other", "joint"), PINNED)
def test_the_centre_of_two_bodies_on_one_pin_is_the_pin(
    name: str, one: str, other: str | None, joint: str
) -> None:
    scene = load(name)
    motion = scene.solve(phase=PHASES)
    found = centre(motion, scene, one, other)
    assert found == pytest.approx(motion.position[joint] @ [1, 1j], rel=1e-9)
    if other:
        assert centre(motion, scene, other, one) == pytest.approx(found, rel=1e-9)


# Aronhold and Kennedy: of any three bodies, the ground among them
@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank", "press", "watt-1"])
def test_the_centres_of_three_bodies_lie_in_one_line(name: str) -> None:
    scene = load(name)
    motion = scene.solve(phase=PHASES)
    names = [None, *(one.name for one in scene.linkage.bodies)]
    for one, two, three in combinations(names, 3):
        assert two is not None
        assert three is not None
        pairs = ((two, one), (three, one), (three, two))
        found = np.array([centre(motion, scene, *pair) for pair in pairs])
        a, b, c = found[:, (abs(found) < 1e5).all(axis=0)]
        across = ((b - a).conjugate() * (c - a)).imag / np.maximum(abs(b - a) * abs(c - a), 1e-6)
        assert np.abs(across).max(initial=0.0) <= 1e-6


def test_what_slides_on_the_ground_has_its_centre_at_infinity() -> None:
    scene = load("slider-crank")
    motion = scene.solve(phase=PHASES)
    assert np.isinf(centre(motion, scene, "slider").real).all()


def rolled(name: str, count: int = 40_000) -> tuple[Path, Path, Path]:
    """Return steps of the fixed curve, of the moving one as it then lies, and the fixed curve's places."""
    scene = load(name)
    coupler = coupler_body(scene.linkage)
    assert coupler is not None
    motion = scene.cycle(count)
    fixed, rolling = centrodes(motion, coupler)
    first, second = (motion.position[joint] @ [1, 1j] for joint in coupler.joints[:2])
    axis = (second - first) / abs(second - first)
    breaks = np.isnan(fixed)
    assert fixed[~breaks] == pytest.approx((first + axis * rolling[~breaks]), rel=1e-9)
    turn = np.sqrt(axis[1:] * axis[:-1])
    turn *= np.sign((turn * axis[1:].conjugate()).real)
    steps = np.flatnonzero(~(breaks[1:] | breaks[:-1]))
    number = np.cumsum(~breaks) - 1
    turned = turn[number[steps]] * (rolling[steps + 1] - rolling[steps])
    return fixed[steps + 1] - fixed[steps], turned, fixed[steps]


@pytest.mark.thinned(2)
@pytest.mark.parametrize("name", ["crank-rocker", "drag-link", "elliptic-trammel", "cardan-gears"])
@pytest.mark.slow
def test_the_moving_centrode_rolls_on_the_fixed_one(name: str) -> None:
    on_ground, on_body, places = rolled(name)
    near = abs(places) < 1e3
    assert near.sum() > 20_000
    # tangent to it and as long, step for step: no slip
    assert np.abs(on_ground - on_body)[near].max() <= 1e-5 * np.abs(on_ground)[near].max()
    assert np.abs(on_ground[near]).sum() == pytest.approx(np.abs(on_body[near]).sum(), rel=1e-7)


@pytest.mark.parametrize("name", ["elliptic-trammel", "cardan-gears"])
def test_cardan_s_circles_are_two_to_one(name: str) -> None:
    scene = load(name)
    coupler = coupler_body(scene.linkage)
    assert coupler is not None
    fixed, rolling = centrodes(scene.cycle(360), coupler)
    radii = []
    for path in (fixed, rolling):
        middle = (path.real.max() + path.real.min()) / 2 + 1j * (path.imag.max() + path.imag.min()) / 2
        radii.append(abs(path - middle))
        assert np.ptp(radii[-1]) <= 1e-3 * radii[-1].max()
    assert radii[0].mean() == pytest.approx(2 * radii[1].mean(), rel=1e-4)


def test_a_centre_that_goes_through_infinity_leaves_a_break() -> None:
    scene = load("crank-rocker")
    coupler = coupler_body(scene.linkage)
    assert coupler is not None
    motion = scene.cycle(720)
    fixed, _ = centrodes(motion, coupler)
    turns = np.sign(motion.angular_velocity["coupler"])
    assert np.isnan(fixed).sum() == (turns[1:] != turns[:-1]).sum() == 2
    whole, _ = centrodes(load("parallelogram").cycle(8), body(load("parallelogram"), "coupler"))  # type: ignore[arg-type]
    assert np.isnan(whole).all()
