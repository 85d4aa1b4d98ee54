"""A still shows the pose at which nothing hides behind anything else, and says which it is."""

from __future__ import annotations

import numpy as np
import pytest

from linkanim.paper.figure import Figured
from linkanim.picture.figure import figure
from linkanim.picture.look import Look
from linkanim.picture.stills import still_phase
from linkanim.scenes import load

# at their starts bars lie in line, or a joint behind another
HIDDEN = ["chebyshev-line", "driven-piston", "inverted-slider-crank", "oscillating-cylinder", "scissor-lift"]


def _nearest(name: str, phase: float) -> float:
    """Return how near two joints of a scene are that do not keep their distance, in parts of its extent."""
    shown = figure(load(name))
    pose = shown.scene.pose(phase, 0)
    found = []
    for n, one in enumerate(shown.in_view):
        for other in shown.in_view[n + 1 :]:
            apart = np.linalg.norm(shown.cycle.position[one] - shown.cycle.position[other], axis=-1)
            if np.ptp(apart) > 1e-6 * shown.extent:
                found.append(float(np.hypot(*np.subtract(pose.position[one], pose.position[other]))))
    return min(found) / shown.extent


@pytest.mark.parametrize("name", [*HIDDEN, "double-rocker", "crank-rocker"])
def test_joints_are_no_nearer_than_at_the_start(name: str) -> None:
    phase = figure(load(name)).clearest
    assert _nearest(name, phase) >= 0.99 * _nearest(name, 0.0)
    assert _nearest(name, phase) > 0.01


@pytest.mark.parametrize("name", HIDDEN)
def test_no_two_bars_lie_in_line_there(name: str) -> None:
    shown = figure(load(name))
    pose = shown.scene.pose(shown.clearest, 0)
    angles = np.array([pose.angle[body.name] for body in shown.bodies if body.name])
    apart = np.abs((np.subtract.outer(angles, angles) + np.pi / 2) % np.pi - np.pi / 2)
    crank = apart[0, 1:]
    assert crank.max() > 0.15


@pytest.mark.slow
def test_a_figure_is_of_that_pose_unless_told_otherwise_and_its_caption_says_where() -> None:
    scene = load("inverted-slider-crank")
    chosen, asked = (Figured(scene, (320, 180), Look(), phase) for phase in (None, 0.5))
    assert chosen.shown_phase == still_phase(scene)
    assert asked.shown_phase == 0.5
    assert chosen.caption == f"θ₂ = {np.degrees(scene.pose(chosen.shown_phase).coordinate):.1f}°"
    assert chosen.document() == Figured(scene, (320, 180), Look(), chosen.shown_phase).document()


@pytest.mark.thinned(2)
@pytest.mark.parametrize(
    "name", ["crank-rocker", "slider-crank", "kite", "crank-rocker-link3", "double-rocker"]
)
def test_it_is_near_sixty_degrees_within_one_turn_with_every_dimension_at_what_it_measures(name: str) -> None:
    scene = load(name)
    still = Figured(scene, (1280, 720), Look(names=2))
    assert 0 <= still.shown_phase < 2 * np.pi
    assert not still.picture.names.listed
    angle = np.degrees(scene.pose(still.shown_phase, 0).coordinate) % 360
    assert abs(angle - 60) <= 30
    shown = float(still.caption.split("=")[1].rstrip("°"))
    assert 0 <= shown < 360
    assert abs(shown - angle) < 0.1
