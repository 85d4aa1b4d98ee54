"""What a solved number says at a phase: a number, that it is not bounded, 0, or nothing.

**How to ask.** `scene.quantities[token].read(motion)`, of a Motion or a Pose, and `.shown(motion)` with
angles in degrees. Every output asks them, so that all say the same of the same:

- a finite number: that is its value;
- `0.0`, without a sign: it is nothing, by geometry or to all digits that it could have;
- `math.inf`, without a sign: it is not bounded there, such as a rate by the input at a limit of the input;
- `nan`: there is no such thing there, such as the direction of a strut of no length (None: it is not known).

Motion's own attributes hold what was computed. Three things make a float say what is not so.

**At a limit.** A limit is at a multiple of π in phase, of which no float is one but 0. A phase within its own
last digits of one is that limit (`formulas.circular.stated`): there a vanishing rate is 0.0, and what is over
it infinite. An angle is held to the limit's own digits (`LimitDistances`).

**By rounding.** What vanishes comes out as the rounding errors of what it is made of: so many digits down
from the linkage's extent, moved at the input's speed. What is no larger is 0.

**By geometry.** A point that keeps its distance from a fixed pin runs on a circle, one that slides on a fixed
line runs straight (`Linkage.radii`); a body with a fixed pin turns about it (`Linkage.pivot`); a strut
between two joints of one rigid body keeps its length. That holds at rest, too, where velocities say nothing.
How other paths bend and where other poles are follows there from the rates by the input, which are the same
however fast it runs.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np

from linkanim.mechanics.formulas.circular import STATED

ROUNDING = 1e-13
"""Of what is as large as the linkage's extent, moved at the input's speed."""


def settled(found: Any, rounding: Any) -> Any:
    """Return numbers with 0.0 for what is no larger than rounding errors, and one infinity for both.

    Floats, pairs of them, or arrays with which `rounding` goes together.
    """
    if isinstance(found, tuple):
        return tuple(settled(part, rounding) for part in found)
    if isinstance(found, float) and isinstance(rounding, float):
        size = abs(found)
        return 0.0 if size <= rounding else math.inf if size == math.inf else found
    return np.where(np.abs(found) <= rounding, 0.0, np.where(np.isinf(found), np.inf, found))[()]


def said(motion: Any, found: Any, unit: str, order: int) -> Any:
    """Return solved numbers of a motion, vectors in arrays (..., 2) or pairs, as they are told."""
    rounding = rounding_of(motion, unit, order)
    vectors = np.ndim(found) == np.ndim(rounding) + 1 if isinstance(rounding, np.ndarray) else False
    return settled(found, rounding[..., None] if vectors else rounding)


def rounding_of(motion: Any, unit: str, order: int) -> Any:
    """Return how large rounding errors of a quantity may be, from the linkage's extent and the input's speed.

    An array where the speed is one; 0 of what is neither an angle nor a length, nor a rate of one.
    """
    size = _size(unit, motion.setting.linkage.extent)
    if not order:
        return size
    speed, acceleration = motion.input_speed, motion.input_acceleration
    return size * (abs(speed) if order == 1 else speed * speed + abs(acceleration))


def unbounded(rate: Any, phase: Any) -> Any:
    """Return a rate, infinite where it is NaN at a phase that is known: there it is not bounded."""
    if isinstance(rate, float):
        return math.inf if math.isnan(rate) and not math.isnan(phase) else rate
    return np.where(np.isnan(rate) & ~np.isnan(phase), np.inf, rate)[()]


def stands(motion: Any) -> Any:
    """Tell where the input stands: at an end where it turns back, as well as a phase can say it, or at rest.

    There q' is as small as a phase's last digits beside q".
    """
    phase, rate, second = motion.phase, motion.coordinate_rate, motion.coordinate_second
    return np.abs(rate * motion.input_speed) <= STATED * np.hypot(phase, math.pi) * np.abs(second)


@lru_cache(maxsize=256)
def _size(unit: str, extent: float) -> float:
    """Return the rounding errors of a unit in which `{}` stands for that of length."""
    above, _, below = unit.partition("/")
    if not ("{" in above or above.startswith("rad")):
        return 0.0
    power = ("{" in above) - ("{" in below) * (2 if "²" in below else 1)
    with np.errstate(all="ignore"):  # extents to a power may be beyond all floats
        return float(ROUNDING * np.power(extent, float(power)))
