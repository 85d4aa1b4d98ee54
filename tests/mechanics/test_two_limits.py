"""A dyad's limit that lies close to another one: velocities there, by phase, against sixty digits."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from build import slider_crank, with_joints
from chain_reference import places
from mpmath import mp, mpf

from linkanim.mechanics.linkage import RRR, Linkage, Pin
from linkanim.mechanics.motion import mechanism
from linkanim.mechanics.solver.input import Swing

SMALL = mpf(10) ** -10
RIGHT = 1e-9


def stopped_before_a_limit(gap: float) -> Linkage:
    """A slider-crank that swings, with bars that stop it that far (rad) before its limit."""
    base = slider_crank(50.0, 40.0, 0.0)
    with mp.workdps(50):
        at = places(base, mp.asin(mpf(4) / 5) - mpf(gap))["B"]
        length = float(abs(at - mp.mpc(230, 60)))
    return with_joints(base, Pin("S", (230.0, 60.0)), RRR("K", ("B", "S"), (length / 2, length / 2)))


def _limit(linkage: Linkage, near: Any) -> Any:
    """Where the bars just reach, by Newton's method."""
    knee = linkage.joint("K")
    assert isinstance(knee, RRR)
    base, reach = replace(linkage, joints=linkage.joints[:-1]), sum(map(mpf, knee.lengths))
    return mp.findroot(lambda angle: abs(places(base, angle)["B"] - mp.mpc(230, 60)) - reach, near)


@pytest.mark.parametrize("gap", [1e-2, 1e-5, 1e-8])
def test_a_limit_beside_another_one_has_its_velocity(gap: float) -> None:
    linkage = stopped_before_a_limit(gap)
    solved = mechanism(linkage)
    path = solved.assembly.path
    assert isinstance(path, Swing)
    assert path.ends == ("K", "K")
    with mp.workdps(60):
        high = _limit(linkage, mpf(path.high.high) + mpf(path.high.low))
        assert abs(high - mpf(path.high.high) - mpf(path.high.low)) < 1e-16
        angle = 2 * high * mp.sin(SMALL / 2) ** 2 - high
        forth, back = (places(linkage, angle, {"K": side})["K"] for side in (1, -1))
        velocity = (forth - back) / (2 * SMALL)
    for phase in (0.0, 2 * math.pi):
        found = complex(*solved.pose(phase, 1.0, 0.0, 2).velocity["K"])
        assert abs(found - complex(velocity)) <= RIGHT * abs(complex(velocity))
