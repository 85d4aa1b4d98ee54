"""Where a page puts joints, read from what it holds as its script reads it, against the solver."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
import pytest

from linkanim.picture.figure import DOWN, figure
from linkanim.picture.view import View
from linkanim.scenes import load, names
from linkanim.scenes.editing import ghost_of, other_return
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.share.movers import GRID, tracks

WIDTH = 960.0
FINEST = 0.01 * WIDTH / 3840
"""A hundredth of a pixel of the largest screen, in pixels of the picture."""
MOMENTS = 600


def unpacked(text: str, kind: str) -> Any:
    return np.frombuffer(base64.b64decode(text), kind).astype(float)


def read(held: Any, phases: Any, period: float) -> Any:
    """Return place, velocity and acceleration (3, n, 2) by phase: a quintic's Hermite basis between nodes."""
    nodes, places, rates, (x, y, grain) = held
    node = np.append(unpacked(nodes, "<u2"), GRID + unpacked(nodes, "<u2")[0])
    place = (x, y) + grain * unpacked(places, "<i4").reshape(-1, 2)
    known = np.hstack((place, unpacked(rates, "<f4").reshape(-1, 4)))
    known = np.vstack((known, known[0]))
    here = phases / period % 1.0 * GRID
    n = np.searchsorted(node, here, side="right") - 1
    width = (node[n + 1] - node[n]) * period / GRID
    u = (here - node[n]) / (node[n + 1] - node[n])
    ends = np.stack((known[n], known[n + 1])).reshape(2, -1, 3, 2)
    scaled = ends * np.stack((np.ones_like(width), width, width**2), axis=1)[..., None]
    basis = np.array(
        [
            [[1, 0, 0, -10, 15, -6], [0, 1, 0, -6, 8, -3], [0, 0, 0.5, -1.5, 1.5, -0.5]],
            [[0, 0, 0, 10, -15, 6], [0, 0, 0, -4, 7, -3], [0, 0, 0, 0.5, -1, 0.5]],
        ]
    )
    course = np.einsum("enkx,ekp->npx", scaled, basis)
    found = []
    for order in range(3):
        powers = np.stack([_derivative(power, order, u) for power in range(6)], axis=1)
        found.append(np.einsum("np,npx->nx", powers, course) / width[:, None] ** order)
    return np.stack(found)


def _derivative(power: int, order: int, u: Any) -> Any:
    factor = float(np.prod([power - n for n in range(order)]))
    return factor * u ** (power - order) if power >= order else 0.0 * u


def view_of(scene: Scene) -> View:
    box = figure(scene).box
    scale = WIDTH / max(box.right - box.left, box.high - box.low)
    return View(scale, -scale * box.left, scale * box.high)


@pytest.mark.sampled
@pytest.mark.parametrize("name", names())
def test_no_point_is_a_hundredth_of_a_pixel_off_on_the_largest_screen(name: str) -> None:
    scene = load(name)
    for one in filter(None, (scene, ghost_of(scene))):
        view = view_of(one)
        packed = {name: track.packed for name, track in tracks(one, view).items()}
        phases = np.sort(np.random.default_rng(1).uniform(0, one.period, MOMENTS))
        motion = one.solve(phase=phases, speed=1.0)
        for joint in motion.position:
            held = packed[joint]
            place, velocity, acceleration = read(held, phases, one.period)
            there = motion.position[joint] @ DOWN * view.scale + complex(view.x, view.y)
            assert np.abs(place @ (1, 1j) - there).max() < FINEST, joint
            for found, true in ((velocity, motion.velocity), (acceleration, motion.acceleration)):
                wanted = true[joint] @ DOWN * view.scale
                # in four digits, as it is shown
                size = np.maximum(np.abs(wanted), 1e-2 * np.abs(wanted).max())
                assert (np.abs(found @ (1, 1j) - wanted) <= 1e-4 * size + 1e-3).all(), joint


def test_more_nodes_lie_where_a_joint_turns_sharply() -> None:
    scene = load("jansen")
    foot = tracks(scene, view_of(scene))[scene.trace[0]]
    gaps = np.diff(foot.nodes)
    assert gaps.max() >= 4 * gaps.min()


def test_a_track_has_no_more_nodes_than_its_curve_asks_for() -> None:
    scene = load("crank-rocker")
    found = {name: len(track.nodes) for name, track in tracks(scene, view_of(scene)).items()}
    assert (found["O2"], found["A"]) == (1, 16)
    assert max(found.values()) < 60


@pytest.mark.parametrize(
    ("name", "point"), [("galloway", "A"), ("knuckle-press", "R"), ("isosceles-slider", "B")]
)
def test_a_point_that_rests_on_the_other_closure_has_one_node(name: str, point: str) -> None:
    """A bar lies on its pivot there, and only turns: what is left of the point's way is rounding."""
    ghost = ghost_of(load(name))
    assert ghost is not None
    track = tracks(ghost, view_of(ghost))[point]
    assert len(track.nodes) == len(track.places) == 1
    assert not track.rates.any()


def test_a_crank_that_turns_as_often_as_there_are_first_places_does_not_rest() -> None:
    scene = scene_from(
        {
            "drive": {"joint": "A", "speed": "20 rpm"},
            "ground": {"O": [0, 0], "G": [40, 0]},
            "joints": {
                "A": {"crank": "O", "length": 10},
                "B": {"crank": "G", "length": 5, "gear": {"with": "A", "ratio": 16}},
            },
        },
        name="geared",
        where="geared",
    )
    assert len(tracks(scene, view_of(scene))["B"].nodes) > 16


# Stephenson III, driven at its first bar: at its upper end it comes back as it went, at its lower it goes on.
KEPT = {
    "drive": {"joint": "B"},
    "ground": {"A": [7, 4], "D": [23, 10], "G": [45, 17]},
    "joints": {
        "B": {"crank": "A", "length": 12},
        "C": {"from": ["B", "D"], "length": [22, 15], "side": "left"},
        "E": {"on": ["B", "C"], "at": [20, 12]},
        "F": {"from": ["E", "G"], "length": [25, 15], "side": "left"},
    },
}


def test_tracks_of_a_way_from_one_kept_end_to_itself_hold_up_to_both() -> None:
    scene = scene_from(KEPT, name="kept", where="kept.toml")
    first, last = scene.mechanism.way or (0.0, 0.0)
    assert (first, last) == (-np.pi, np.pi)
    view = view_of(scene)
    packed = {name: track.packed for name, track in tracks(scene, view).items()}
    beside = np.array([1e-9, 1e-4, 1e-3, 0.1, 1.0, 3.0])
    phases = np.concatenate([first + beside, last - beside])
    motion = scene.solve(phase=phases, speed=1.0)
    for joint in motion.position:
        place, velocity, _ = read(packed[joint], phases - first, scene.period)
        there = motion.position[joint] @ DOWN * view.scale + complex(view.x, view.y)
        assert np.abs(place @ (1, 1j) - there).max() < FINEST, joint
        wanted = motion.velocity[joint] @ DOWN * view.scale
        assert np.abs(velocity @ (1, 1j) - wanted).max() <= 2e-3 * np.abs(wanted).max(initial=1.0), joint


# Where all signs change at once, at the ends of a way that is gone back, no stretch leads across.
@pytest.mark.parametrize("name", ["double-rocker", "triple-rocker", "excavator"])
def test_rates_of_a_way_that_is_gone_back_hold_up_to_its_ends(name: str) -> None:
    scene = other_return(load(name))
    view = view_of(scene)
    packed = {name: track.packed for name, track in tracks(scene, view).items()}
    beside = np.array([1e-9, 1e-6, 1e-4, 7e-4, 1e-2, 0.1])
    phases = np.concatenate([beside, np.pi - beside])
    motion = scene.solve(phase=phases, speed=1.0)
    for joint in motion.position:
        if not scene.linkage.joint(joint).fixed:
            held = packed[joint]
            assert unpacked(held[0], "<u2")[-1] == GRID // 2
            for found, true in zip(
                read(held, phases, scene.period)[1:], (motion.velocity, motion.acceleration), strict=True
            ):
                wanted = true[joint] @ DOWN * view.scale
                assert np.abs(found @ (1, 1j) - wanted).max() <= 2e-3 * np.abs(wanted).max()
