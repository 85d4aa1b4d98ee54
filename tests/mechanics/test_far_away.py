"""A linkage far from (0, 0) is solved as the same one near it: all but its positions has the same bits."""

from __future__ import annotations

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from bits import rows

from linkanim.mechanics.forces import input_effort
from linkanim.mechanics.groups import GroupPoint
from linkanim.mechanics.linkage import Joint, Linkage, Pin
from linkanim.mechanics.motion import mechanism
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

FAR = (500_000.0, 5_400_000.0)
PHASES = np.array([0.0, 1e-5, 0.7, math.pi, 4.0])


def moved(linkage: Linkage, x: float, y: float) -> Linkage:
    """Return a linkage whose places have few digits and are stated by coordinates, one pin at a place."""
    x0, y0 = next(linkage.pins).position

    def placed(at: tuple[float, float]) -> tuple[float, float]:
        across, up = (round(way * 64) / 64 for way in (at[0] - x0, at[1] - y0))
        return x + across, y + up

    def moved_joint(joint: Joint) -> Joint:
        match joint:
            case Pin():
                return replace(joint, position=placed(joint.position), polar=None)
            case GroupPoint():
                links = (replace(one, places=tuple(map(placed, one.places))) for one in joint.group.members)
                return replace(joint, group=replace(joint.group, members=tuple(links)))
        return joint

    return replace(linkage, joints=tuple(map(moved_joint, linkage.joints)))


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_far_away_only_positions_are_others(name: str) -> None:
    linkage = load(name).linkage
    near, far = (mechanism(moved(linkage, *at)) for at in ((0.0, 0.0), FAR))
    assert far.linkage.extent == near.linkage.extent
    there, here = (one.solve(phase=PHASES, speed=1.5, acceleration=0.25) for one in (far, near))
    for (what, found), (_, true) in zip(rows(there), rows(here), strict=True):
        away = np.array(FAR) if "position of" in what else 0.0
        assert (found == true + away).all() or np.isnan(true).any(), what
    for body, angle in here.angle.items():
        assert (there.angle[body] == angle).all(), body
    for body, pair in here.coefficient.items():
        assert np.array_equal(there.coefficient[body], pair, equal_nan=True), body
    if linkage.forceful:
        assert np.array_equal(input_effort(there), input_effort(here), equal_nan=True)
    pose = far.pose(0.7, 1.5, 0.25, 2)
    for joint, place in pose.position.items():
        assert place == tuple(there.position[joint][2])
    assert dict(pickle.loads(pickle.dumps(pose)).position) == dict(pose.position)


def piston(**ground: list[float]) -> Scene:
    bars = {"crank": 0.05, "rod": 0.15}
    document = {"length_unit": "m", "ground": ground, "slider-crank": bars, "drive": {"speed": "10 rad/s"}}
    return scene_from(document, name="far", where="far.toml")


def test_beside_a_dead_centre_far_away_the_slider_moves_and_its_advantage_is_bounded() -> None:
    scene = piston(O2=[500_000, 5_400_000])
    pose = scene.pose(math.radians(0.0005))
    slope, speed = math.sin(math.radians(0.0005)) * 0.05 * 4 / 3, 10.0
    read = scene.quantities
    assert pose.velocity["B"][0] == pytest.approx(-slope * speed, rel=1e-9)
    assert read["B.velocity"].read(pose) == pytest.approx(slope * speed, rel=1e-9)
    assert read["mechanical_advantage"].read(pose) == pytest.approx(0.05 / slope, rel=1e-9)
    assert pose.angle["rod"] == pytest.approx(-math.radians(0.0005) / 3, rel=1e-9)
    assert pose.position["O2"] == (500_000, 5_400_000)


@pytest.mark.parametrize("place", [[0.4, 5_400_000], [-500_000, 0.2], [3.0, 4.0]])
def test_each_coordinate_is_far_or_near_by_itself(place: list[float]) -> None:
    there, here = (piston(O2=at).pose(0.3) for at in (place, [0.0, 0.0]))
    for joint, rate in here.velocity.items():
        assert there.velocity[joint] == pytest.approx(rate, rel=1e-14)
        moved = np.array(here.position[joint]) + place
        assert there.position[joint] == pytest.approx(moved, abs=1e-16 * max(map(abs, place)))
