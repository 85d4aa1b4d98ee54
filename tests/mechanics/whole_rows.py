"""Rows by angle: wholly finite, or wholly not a number."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.linkage import Pin
from linkanim.mechanics.motion import Mechanism


def whole_rows(solved: Mechanism, angles: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which rows by angle are finite; each is that in all that moves, or in none of it."""
    motion = solved.solve(angle=angles, speed=1.0)
    moving = [joint.name for joint in solved.linkage.joints if not isinstance(joint, Pin)]
    position = np.array([np.isfinite(motion.position[name]).all(axis=-1) for name in moving])
    # At a limit itself rates are infinite.
    rates = [motion.velocity, motion.acceleration]
    defined = np.array([~np.isnan(rate[name]).any(axis=-1) for rate in rates for name in moving])
    found: NDArray[np.bool_] = position[0]
    assert (position == found).all()
    assert (defined == found).all()
    return found
