"""Where a link rests, paths bend and poles are as beside it: by the rates of the link that moves them."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import mpmath
import numpy as np
import pytest

from linkanim.mechanics.search import sign_changes
from linkanim.picture.centres import CentrePairs
from linkanim.picture.figure import figure
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene


def said(scene: Scene, token: str, phase: float) -> Any:
    """Return what a pose says, which a batch has to say, too."""
    read = scene.quantities[token].read
    found, batch = read(scene.pose(phase)), read(scene.solve(phase=[phase]))
    assert np.array_equal(found, batch[0], equal_nan=True), (token, phase)
    return found


# The foot of the scissors is at s; with h = √(100² - s²/4), M2 is (s/2, 3h), a place on an ellipse, and the
# second stage turns about the place that is across the ways of its two ends: (-s, 2h).
@pytest.mark.parametrize(("phase", "foot"), [(0.0, 175.0), (math.pi, 105.0)])
@pytest.mark.parametrize("beside", [0.0, 1e-12, 1e-9, -1e-7])
def test_a_stage_of_scissors_bends_and_turns_at_a_dead_centre_of_the_foot(
    phase: float, foot: float, beside: float
) -> None:
    scene, along = load("scissor-lift"), foot / 200
    height = 100 * math.sqrt(1 - along**2)
    radius = (100**2 * (1 - along**2) + 300**2 * along**2) ** 1.5 / (100 * 300)
    assert said(scene, "M2.curvature_radius", phase + beside) == pytest.approx(radius, rel=1e-13)
    assert said(scene, "up2.pole", phase + beside) == pytest.approx((-foot, 2 * height), rel=1e-13)
    assert said(scene, "L2.curvature_radius", phase + beside) == math.inf


G1, G4, G6, G8 = [24.0, -44.0], [-22.5, -53.0], [53.0, -79.5], [38.0, 33.0]
SLOTS = {
    "drive": {"joint": "A", "start": "-47.3 deg"},
    "ground": {"G1": G1, "G4": G4, "G6": G6, "G8": G8},
    "joints": {
        "A": {"crank": "G1", "length": 26.75},
        "J3": {"from": ["A", "G4"], "length": [39.75, 53.5], "side": "right"},
        "J5": {"slot": {"pivot": "J3", "through": "G6", "offset": 27.25}, "length": 69},
        "J7": {"slot": {"pivot": "J5", "through": "G8", "offset": -23.75}, "length": 107.25},
    },
    "bodies": {"rocker": {"joints": ["G4", "J3"]}},
}


def _slotted(pivot: Any, through: list[float], offset: float, length: float) -> Any:
    """Return the end of a slotted bar: through = pivot + (s + i offset) u, in many digits."""
    across = mpmath.mpc(*through) - pivot
    u = across / mpmath.mpc(mpmath.sqrt(abs(across) ** 2 - mpmath.mpf(offset) ** 2), offset)
    return pivot + length * u


def _bend(turn: Any) -> Any:
    """Return the radius of curvature of J7's path, the bar G4 - J3 standing at an angle, in many digits."""

    def place(angle: Any) -> Any:
        j3 = mpmath.mpc(*G4) + 53.5 * mpmath.expj(angle)
        return _slotted(_slotted(j3, G6, 27.25, 69), G8, -23.75, 107.25)

    first, second = (mpmath.diff(place, turn, n) for n in (1, 2))
    return abs(first) ** 3 / abs((mpmath.conj(first) * second).imag)


# Two slots behind a rocker: the crank's own rates say less and less of the end of the second one, the nearer
# the rocker is to where crank and rod are in line.
@pytest.mark.parametrize("beside", [0.0, 1e-9, 4e-6, -4e-6, 1e-5, 1e-3, 0.1])
def test_a_path_behind_a_rocker_bends_as_fifty_digits_say(beside: float) -> None:
    scene = scene_from(SLOTS, name="slots", where="slots")
    ends = rests(scene)
    assert len(ends) == 2
    for end in ends:
        x, y = scene.pose(end + beside).position["J3"]
        with mpmath.workdps(50):
            true = _bend(mpmath.arg(mpmath.mpc(x, y) - mpmath.mpc(*G4)))
        assert abs(said(scene, "J7.curvature_radius", end + beside) - true) <= 2e-13 * true


def rests(scene: Scene) -> list[float]:
    """Return the phases at which a slider on the ground, or a bar about a fixed pin, turns back."""
    linkage, phases = scene.linkage, np.linspace(0.0, scene.period, 721)

    def rate(name: str, slider: bool) -> Any:
        kind = "travel_velocity" if slider else "angular_velocity"
        return lambda near: getattr(scene.solve(phase=near), kind)[name]

    bodies = [body for body in linkage.bodies if body.slider or linkage.pivot(body.joints)]
    found = (sign_changes(rate(body.name, body.slider is not None), phases) for body in bodies)
    return sorted({float(phase) for one in found for phase in one})


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_poles_and_radii_go_on_where_a_link_rests(name: str) -> None:
    scene, step = load(name), 1e-4
    extent = scene.linkage.extent
    tokens = [token for token in scene.quantities if token.endswith(("pole", "curvature_radius"))]
    # a centre of mass on its crank's pin stands still: it has no path, and so no radius
    tokens = [token for token in tokens if not np.isnan(scene.quantities[token].read(scene.cycle(24))).all()]
    for phase in rests(scene):
        for token in tokens:
            # seen as 1/r, in which a straight path, or a pole that is infinitely far, is 0
            near = [_inverse(scene, token, phase + n * step, extent) for n in (-2, -1, 0, 1, 2)]
            assert all(map(math.isfinite, near)), (token, phase)
            smooth = max(abs(one - other) for one, other in pairwise((near[0], near[1], near[3], near[4])))
            assert abs(near[2] - (near[1] + near[3]) / 2) <= 2 * smooth + 1e-9, (token, phase)


def _inverse(scene: Scene, token: str, phase: float, extent: float) -> float:
    size = float(np.hypot(*[*np.atleast_1d(said(scene, token, phase)).tolist(), 0.0][:2]))
    return 1.0 / (size / extent + 1e-3)


def test_where_a_point_is_at_rest_it_is_about_to_move_as_it_is_accelerated() -> None:
    scene, token = load("double-rocker"), "A.tangential_acceleration"
    assert said(scene, token, 0.0) == pytest.approx(264.8002299, rel=1e-9)
    assert said(scene, token, 1e-9) == pytest.approx(264.8002299, rel=1e-6)
    assert said(scene, token, -1e-9) == pytest.approx(-264.8002299, rel=1e-6)
    assert said(scene, "A.normal_acceleration", 0.0) == 0.0


# A wheel of a gear train: a straight line that is gone back on itself, and a path with a cusp.
@pytest.mark.parametrize(
    ("name", "phase", "radius"),
    [("cardan-gears", 0.0, math.inf), ("epicyclic-hypocycloid", math.radians(70), 0.0)],
)
def test_a_path_that_no_link_leads_bends_as_it_does_beside_its_end(
    name: str, phase: float, radius: float
) -> None:
    scene = load(name)
    for end in (phase, math.nextafter(phase, 9.0)):
        assert said(scene, "E.curvature_radius", end) == radius
    beside = said(scene, "E.curvature_radius", phase + 1e-6)
    assert beside == radius or 0 < beside < 1e-3 * scene.linkage.extent


TWO_CRANKS = {
    "length_unit": "mm",
    "drive": {"joint": "A"},
    "ground": {"O": [0, 0], "Q": [100, 0], "T": [-10, 0], "S": [120, 0]},
    "joints": {
        "A": {"crank": "O", "length": 30},
        "D": {"crank": "Q", "length": 30, "gear": {"with": "A", "ratio": -1, "offset": "180 deg"}},
        "B": {"from": "A", "length": 90, "line": {"through": "O", "angle": "90 deg"}, "side": "forward"},
        "C": {"from": "D", "length": 80, "line": {"through": "Q", "angle": "90 deg"}, "side": "forward"},
        "K": {"slot": {"pivot": "B", "through": "C"}, "length": 50},
    },
    "bodies": {"beam": {"joints": ["B", "K"]}},
}
"""Two sliders that come to their dead centres at once, and a beam on both."""


def test_what_two_links_move_that_rest_at_once_has_a_pole_as_it_starts() -> None:
    scene = scene_from(TWO_CRANKS, name="two cranks", where="two cranks")
    for end in (math.pi / 2, 3 * math.pi / 2):
        there = said(scene, "beam.pole", end)
        assert np.isfinite(there).all()
        for beside in (1e-4, -1e-4):
            assert there == pytest.approx(said(scene, "beam.pole", end + beside), rel=1e-3, abs=1e-2)


def test_the_centres_of_a_pose_at_rest_are_those_beside_it() -> None:
    scene = load("scissor-lift")
    known = CentrePairs(figure(scene))
    here, beside = (known.of(scene.pose(phase, 1)) for phase in (0.0, 1e-7))
    assert here.keys() == beside.keys()
    for pair, one in here.items():
        if one.place is not None and abs(one.place) < 1e6:
            other = beside[pair].place
            assert other is not None
            assert other == pytest.approx(one.place, rel=1e-4, abs=1e-3), pair


HELD = {
    "ground": {"O": [0, 0], "Q": [100, 0], "T": [50, 0]},
    "joints": {
        "A": {"crank": "O", "length": 30},
        "B": {"from": ["A", "Q"], "length": [90, 80], "side": "left"},
        "E": {"from": ["Q", "T"], "length": [40, 40], "side": "left"},
    },
    "bodies": {"prop": {"joints": ["E", "T"]}},
}


def test_what_is_shifted_has_its_pole_infinitely_far_and_what_stands_has_none() -> None:
    assert np.isnan(said(scene_from(HELD, name="held", where="held"), "prop.pole", 0.3)).all()
    for phase in (0.0, 0.3, math.pi):
        assert tuple(said(load("parallelogram"), "coupler.pole", phase)) == (math.inf, math.inf)
