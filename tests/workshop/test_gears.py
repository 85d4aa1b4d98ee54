"""Wheels that roll on each other: they touch over a whole pitch, never overlap, keep the centre distance."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from solids import Solids

from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.workshop.gears import meshes
from linkanim.workshop.request import make

GEARED = ["press", "geared-five-bar-2-1", "geared-five-bar-3-2", "cardan-gears", "epicyclic-hypocycloid"]
_PHASES = 21


def train(ratio: str, *, planet: bool) -> Scene:
    """Return two cranks geared to each other, or an arm with a planet."""
    document: dict[str, Any] = {
        "title": "train",
        "source": "here",
        "length_unit": "mm",
        "drive": {"speed": "20 rpm", "joint": "A", "start": "10 deg"},
        "ground": {"O": [0, 0], **({} if planet else {"Q": [70, 40]})},
        "joints": {
            "A": {"crank": "O", "length": 60},
            "E": {
                "crank": "A" if planet else "Q",
                "length": 15,
                "gear": {"with": "A", "ratio": ratio, "offset": "25 deg"},
            },
        },
        "bodies": {"arm": {"joints": ["O", "A"]}, "wheel": {"joints": ["A" if planet else "Q", "E"]}},
        "trace": {"joints": ["E"]},
    }
    return scene_from(document, name="train", where="train")


def toothed(scene: Scene, **how: Any) -> tuple[Solids, list[Any], float]:
    """Return the solids of a scene at phases over a pitch, its two wheels, and their play."""
    made = make(scene, **how)
    assert made.refused is None
    wheels = [number for number, plate in enumerate(made.plates) if plate.teeth]
    plates = [made.plates[number] for number in wheels]
    found: Any = made.as_object()
    solids = Solids(scene, found, _PHASES)
    teeth = [plate.teeth.wheel.teeth for plate in plates if plate.teeth]
    pitch = 2 * math.pi / min(teeth)
    solids.cycle = scene.solve(phase=0.3 + pitch * np.arange(_PHASES) / (_PHASES - 1), derivatives=0)
    (play,) = {plate.teeth.play for plate in plates if plate.teeth}
    return solids, [solids.part(made._part(number)) for number in wheels], play


CASES = [
    *(pytest.param(load(name), id=name) for name in GEARED),
    *(pytest.param(train(ratio, planet=False), id=f"pair {ratio}") for ratio in ("-1/3", "-5/2", "-7/5")),
    # a ring, a ring with few teeth more than its planet, a wheel inside
    *(pytest.param(train(ratio, planet=True), id=f"planet {ratio}") for ratio in ("-2", "-1/2", "3", "5/2")),
]


@pytest.mark.thinned(5)
@pytest.mark.parametrize("scene", CASES)
def test_teeth_touch_over_a_pitch_without_overlap(scene: Scene) -> None:
    _, (one, other), play = toothed(scene, bar=12.0, hole=3.0) if scene.name == "train" else toothed(scene)
    assert shapely.area(shapely.intersection(one, other)).max() == 0
    apart = shapely.distance(one, other)
    # each flank is set back by the play; the sides of a flank stay within some hundredths of its curve
    assert apart.max() < 2 * play + 0.03
    assert apart.min() > 2 * play - 0.005


@pytest.mark.parametrize("scene", CASES)
def test_wheels_keep_the_centre_distance(scene: Scene) -> None:
    pose = scene.pose(0.4, 0)
    for first, second in meshes(scene.linkage, 1.0, 2.0):
        apart = math.dist(pose.position[first.centre], pose.position[second.centre])
        radii = first.radius - second.radius if first.ring else first.radius + second.radius
        assert radii == pytest.approx(apart, rel=1e-12)
        crank = scene.linkage.crank(str(second.arm))
        assert crank.gear is not None
        ratio = crank.gear.ratio if first.arm else 1 - crank.gear.ratio
        assert Fraction(first.teeth, second.teeth) == abs(ratio)
        assert min(first.teeth, second.teeth) >= 18


def test_a_kerf_makes_teeth_thicker_by_as_much_as_is_cut_away() -> None:
    made = make(load("press"))
    plate = next(plate for plate in made.plates if plate.teeth)
    assert plate.teeth is not None
    bare, grown = (shapely.Polygon([(p.real, p.imag) for p, _ in plate.outline(k)]) for k in (0.0, 0.1))
    assert grown.contains(bare)
    assert bare.exterior.distance(grown.exterior) > 0.03
    assert grown.buffer(-0.1).difference(bare.buffer(0.01)).area < 0.1


@pytest.mark.slow
@settings(max_examples=8)
@given(one=st.integers(1, 9), other=st.integers(1, 9))
def test_any_small_ratio_has_teeth_that_do_not_overlap(one: int, other: int) -> None:
    _, (first, second), _ = toothed(train(f"-{one}/{other}", planet=False), bar=4.0, hole=0.8)
    assert shapely.area(shapely.intersection(first, second)).max() == 0


REFUSED = [
    ("2", False, "turn the same way, which two wheels do not; take a ratio below 0, such as -2"),
    ("1/2", True, "takes a belt or a third wheel"),
    ("1", True, "takes a belt or a third wheel"),
]


@pytest.mark.parametrize(("ratio", "planet", "said"), REFUSED)
def test_what_two_wheels_cannot_do_is_refused(ratio: str, planet: bool, said: str) -> None:
    refused = make(train(ratio, planet=planet)).refused
    assert refused is not None
    assert said in refused
