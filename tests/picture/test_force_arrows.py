"""Arrows of forces: as long as the forces that solving gives, at one scale; none where they are unbounded."""

from __future__ import annotations

import math

import numpy as np
import pytest
from pushed import PUSHED

from linkanim.mechanics.quantities import register
from linkanim.picture.figure import Figure, figure
from linkanim.picture.layout import Gauge, layout
from linkanim.picture.look import FORCE, Look
from linkanim.picture.motion_marks import Arrows, arrows_for
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import View
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.toml import parse

LOOK = Look(vectors=frozenset({FORCE}))
GAUGE = Gauge(8.0, 6.0, 2.0, 1.0)
VIEW = View(1.0, 0.0, 0.0)


def arrows_of(shown: Figure, moment: float | None = None) -> Arrows:
    (found,) = arrows_for(shown, LOOK, layout((1280, 720)), GAUGE, LIGHT, moment)
    return found


@pytest.mark.parametrize("name", ["press", "engine", "andrews"])
@pytest.mark.parametrize("speed", [1.0, -7.0, 30.0])
def test_an_arrow_is_as_long_as_the_force_of_its_name(name: str, speed: float) -> None:
    shown = figure(load(name))
    found = arrows_of(shown)
    known = {one.symbol: one for one in register(shown.linkage).values()}
    pose = shown.scene.pose(1.1, speed=speed)
    scale = found.scale(speed)
    seen = {one.symbol: one for one in found.seen(pose, VIEW, shown.moving)}
    assert seen
    for symbol, arrow in seen.items():
        if symbol == "P_{gas}":  # a load, which is given
            continue
        assert abs(arrow.reach) == pytest.approx(scale * abs(known[symbol].read(pose)), rel=1e-9), symbol


def test_the_longest_arrow_of_a_cycle_is_as_long_at_any_speed_or_shorter() -> None:
    shown = figure(load("engine"))
    found = arrows_of(shown)
    for speed in (0.01, shown.linkage.drive.speed, 40.0):
        cycle = shown.scene.solve(phase=shown.cycle.phase, speed=speed)
        longest = max(float(np.hypot(*reach.T).max()) for _, _, reach in found.paths(cycle, shown.moving))
        assert 0.5 * found.longest < longest <= found.longest * (1 + 1e-9)


def test_a_force_that_grows_without_bound_has_no_arrow_there_and_no_other_is_lost() -> None:
    shown = figure(scene_from(parse(PUSHED, "my.toml"), name="my", where="my.toml"))
    found = arrows_of(shown)
    at_the_end = found.seen(shown.scene.pose(math.pi, 2), VIEW, shown.moving)
    assert at_the_end == []
    away = found.seen(shown.scene.pose(1.5, 2), VIEW, shown.moving)
    assert len(away) >= 3
    for _, _, reach in found.paths(shown.cycle, shown.moving):
        assert np.isfinite(reach).all()
        assert np.hypot(*reach.T).max() <= 2.6 * found.longest


def test_what_has_no_forces_has_no_arrows_of_them() -> None:
    shown = figure(load("crank-rocker"))
    assert arrows_for(shown, LOOK, layout((1280, 720)), GAUGE, LIGHT) == ()
