"""Rates to fifty digits beside limits: positions of the exact motion, differenced about a phase."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from exact_motion import DIGITS, ExactMotion
from mpmath import mp, mpf

from linkanim.mechanics.linkage import Body
from linkanim.scenes.scene import Scene

STEP = 2.0**-17
"""Eight places so far apart, none of them at the phase itself, where a closure may just change."""
REACH = (1, 2, 3, 4)
Place = Any


def _weights(order: int) -> list[Any]:
    """Return by what the half differences, or the mean sums, of places are taken for a derivative at 0."""
    with mp.workdps(DIGITS):
        powers = [2 * n + order % 2 for n in range(len(REACH))]
        inverse = mp.matrix([[mpf(k) ** power for power in powers] for k in REACH]) ** -1
        return [order * inverse[order // 2, n] for n in range(len(REACH))]


WEIGHTS = {order: _weights(order) for order in (1, 2)}


@dataclass(frozen=True)
class ExactRates:
    """What a scene does at a phase, by time and by its input."""

    scene: Scene
    phase: float

    @cached_property
    def _around(self) -> dict[int, dict[str, Place]]:
        motion = _motion(self.scene)
        with mp.workdps(DIGITS):
            return {k: motion.at(mpf(self.phase) + k * mpf(STEP)) for n in REACH for k in (n, -n)}

    def by_phase(self, of: Callable[[dict[str, Place]], Any], order: int) -> Any:
        """Return a derivative by the phase of what is read from a pose."""
        with mp.workdps(DIGITS):
            return _derivative({k: of(places) for k, places in self._around.items()}, order)

    def of_joint(self, name: str, order: int, speed: float) -> Any:
        """Return a joint's velocity (`order` 1) or acceleration, x + yi."""
        return self.by_phase(lambda at: at[name], order) * mpf(speed) ** order

    def of_body(self, body: Body, order: int) -> Any:
        """Return how a body turns, or slides along its fixed line, by the phase."""
        if body.slider is not None:
            slider, motion = body.slider, _motion(self.scene)
            return self.by_phase(lambda at: motion.travel(slider, at), order)
        first, second = body.joints[:2]
        with mp.workdps(DIGITS):
            middle = self._around[1][second] - self._around[1][first]
            # from where it is, so that no turn is lost
            return self.by_phase(lambda at: mp.arg((at[second] - at[first]) / middle), order)

    def of_input(self, order: int) -> Any:
        """Return how the input's angle, or travel, changes by the phase."""
        motion = _motion(self.scene)
        with mp.workdps(DIGITS):
            places = {k: motion.coordinate(mpf(self.phase) + k * mpf(STEP)) for n in REACH for k in (n, -n)}
            return _derivative(places, order)


def _derivative(found: Mapping[int, Any], order: int) -> Any:
    """Return the first or second derivative of what is known at so many steps from a place."""
    sign = -1 if order == 1 else 1
    terms = ((found[n] + sign * found[-n]) / 2 for n in REACH)
    return sum(w * term for w, term in zip(WEIGHTS[order], terms, strict=True)) / mpf(STEP) ** order


_KNOWN: dict[int, tuple[Scene, ExactMotion]] = {}


def _motion(scene: Scene) -> ExactMotion:
    """Return the exact motion of a scene, the last one's again."""
    if id(scene) not in _KNOWN or _KNOWN[id(scene)][0] is not scene:
        _KNOWN.clear()
        _KNOWN[id(scene)] = scene, ExactMotion(scene)
    return _KNOWN[id(scene)][1]
