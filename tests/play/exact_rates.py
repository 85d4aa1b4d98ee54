"""Rates to fifty digits beside limits: positions of the exact motion, differenced about a phase.

A scene that comes back as it went is, on the way there, the one that comes back otherwise: that is read.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from exact_motion import DIGITS, ExactMotion
from mpmath import mp, mpf

from linkanim.mechanics.linkage import Body
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

STEP = 2.0**-17
"""Eight places so far apart, none of them at the phase itself, where a closure may just change."""
REACH = (1, 2, 3, 4)
Place = Any


def _weights(order: int) -> list[Any]:
    """Return the weights of half differences, or mean sums, for a derivative at 0, or a value."""
    with mp.workdps(DIGITS):
        powers = [2 * n + order % 2 for n in range(len(REACH))]
        inverse = mp.matrix([[mpf(k) ** power for power in powers] for k in REACH]) ** -1
        return [max(order, 1) * inverse[order // 2, n] for n in range(len(REACH))]


WEIGHTS = {order: _weights(order) for order in (0, 1, 2)}


@dataclass(frozen=True)
class ExactRates:
    """What a scene does at a phase, by time and by its input."""

    scene: Scene
    phase: float

    @cached_property
    def _motion(self) -> ExactMotion:
        return _motion(self.scene)

    @cached_property
    def _back(self) -> bool:
        """Whether it comes back as it went."""
        return self.scene.mechanism.retraced and math.sin(self.phase) < 0

    @cached_property
    def _there(self) -> Any:
        """The phase, or that on the way there."""
        with mp.workdps(DIGITS):
            if not self.scene.mechanism.retraced:
                return mpf(self.phase)
            turned = mpf(self.phase) - 2 * mp.pi * mp.floor(mpf(self.phase) / (2 * mp.pi))
            return 2 * mp.pi - turned if self._back else turned

    @cached_property
    def _around(self) -> dict[int, dict[str, Place]]:
        with mp.workdps(DIGITS):
            return {k: self._motion.at(self._there + k * mpf(STEP)) for n in REACH for k in (n, -n)}

    def by_phase(self, of: Callable[[dict[str, Place]], Any], order: int) -> Any:
        """Return a derivative by the phase of what is read from a pose; by `order` 0 that itself."""
        with mp.workdps(DIGITS):
            found = _derivative({k: of(places) for k, places in self._around.items()}, order)
            return -found if self._back and order == 1 else found

    def of_joint(self, name: str, order: int, speed: float) -> Any:
        """Return a joint's velocity (`order` 1) or acceleration, x + yi."""
        return self.by_phase(lambda at: at[name], order) * mpf(speed) ** order

    def of_body(self, body: Body, order: int) -> Any:
        """Return how a body turns, or slides along its fixed line, by the phase."""
        if body.slider is not None:
            slider, motion = body.slider, self._motion
            return self.by_phase(lambda at: motion.travel(slider, at), order)
        first, second = body.joints[:2]
        with mp.workdps(DIGITS):
            middle = self._around[1][second] - self._around[1][first]
            # from where it is, so that no turn is lost
            return self.by_phase(lambda at: mp.arg((at[second] - at[first]) / middle), order)

    def of_input(self, order: int) -> Any:
        """Return how the input's angle, or travel, changes by the phase."""
        motion = self._motion
        with mp.workdps(DIGITS):
            places = {k: motion.coordinate(self._there + k * mpf(STEP)) for n in REACH for k in (n, -n)}
            found = _derivative(places, order)
            return -found if self._back and order == 1 else found

    def coefficients(self, body: Body) -> tuple[Any, Any]:
        """Return a body's first two derivatives by the input."""
        with mp.workdps(DIGITS):
            (moved, bent), (driven, gained) = (
                [of(order) for order in (1, 2)] for of in (lambda n: self.of_body(body, n), self.of_input)
            )
            return moved / driven, (bent * driven - moved * gained) / driven**3

    def radius(self, name: str) -> tuple[Any, Any]:
        """Return |v|³ and |v × a|, by the phase: their quotient is the radius of curvature."""
        v, a = (self.by_phase(lambda at: at[name], order) for order in (1, 2))
        with mp.workdps(DIGITS):
            return abs(v) ** 3, abs(mp.im(mp.conj(v) * a))

    def pole(self, body: Body) -> Any:
        """Return about which point a body turns at the instant, x + yi."""
        place, moving = (self.by_phase(lambda at: at[body.joints[0]], order) for order in (0, 1))
        with mp.workdps(DIGITS):
            return place + 1j * moving / self.of_body(body, 1)

    def power(self) -> tuple[Any, Any]:
        """Return what the input delivers, in W, and how fast it runs: in rad/s, or in m/s."""
        linkage = self.scene.linkage
        speed, metre = mpf(linkage.drive.speed), mpf(linkage.metre)
        with mp.workdps(DIGITS):
            total = sum((self._taken_by(body) for body in linkage.bodies), mpf(0))
            for spring in linkage.springs:
                if spring.stiffness is not None and spring.free_length is not None:
                    length, rate = self._strut(spring.between)
                    total += mpf(spring.stiffness) * (length - mpf(spring.free_length) * metre) * rate
            for damper in linkage.dampers:
                if damper.coefficient is not None:
                    total += mpf(damper.coefficient) * self._strut(damper.between)[1] ** 2
            if linkage.drive.actuator.along is not None:
                return total, self._strut(linkage.drive.actuator.along)[1]
            return total, self.of_input(1) * speed * (1 if linkage.drive.coordinate.is_angle else metre)

    def _strut(self, ends: tuple[str, str]) -> tuple[Any, Any]:
        """Return how far apart two joints are, in m, and how fast that grows."""

        def length(at: dict[str, Place]) -> Any:
            return abs(at[ends[1]] - at[ends[0]]) * mpf(self.scene.linkage.metre)

        return self.by_phase(length, 0), self.by_phase(length, 1) * mpf(self._motion.speed)

    def _taken_by(self, body: Body) -> Any:
        """Return what a body's weight, mass and inertia take, in W."""
        linkage, taken = self.scene.linkage, mpf(0)
        speed, metre = mpf(linkage.drive.speed), mpf(linkage.metre)
        if body.mass is not None:
            v, a = (
                metre * speed**order * self.by_phase(lambda at: _centre(body, at), order) for order in (1, 2)
            )
            taken += mpf(body.mass) * (mp.re(mp.conj(v) * a) + mpf(linkage.gravity) * mp.im(v))
        if body.inertia is not None:
            taken += mpf(body.inertia) * speed**3 * self.of_body(body, 1) * self.of_body(body, 2)
        return taken


def _centre(body: Body, at: dict[str, Place]) -> Place:
    """Return where a body's centre of mass is."""
    if body.slider is not None:
        return at[body.slider]
    assert body.com is not None
    first, second = (at[name] for name in body.joints[:2])
    way = second - first
    return first + way / abs(way) * mp.mpc(*body.com)


def _derivative(found: Mapping[int, Any], order: int) -> Any:
    """Return a derivative of what is known at so many steps from a place; by `order` 0 that itself."""
    sign = -1 if order == 1 else 1
    terms = ((found[n] + sign * found[-n]) / 2 for n in REACH)
    return sum(w * term for w, term in zip(WEIGHTS[order], terms, strict=True)) / mpf(STEP) ** order


_KNOWN: dict[int, tuple[Scene, ExactMotion]] = {}


def _motion(scene: Scene) -> ExactMotion:
    """Return the exact motion of a scene, or of the one that comes back otherwise; the last one's again."""
    if id(scene) not in _KNOWN or _KNOWN[id(scene)][0] is not scene:
        _KNOWN.clear()
        _KNOWN[id(scene)] = scene, ExactMotion(_other(scene) if scene.mechanism.retraced else scene)
    return _KNOWN[id(scene)][1]


def _other(scene: Scene) -> Scene:
    drive = {key: value for key, value in scene.document["drive"].items() if key != "returns"}
    return scene_from({**scene.document, "drive": drive}, name=scene.name, where="exact")
