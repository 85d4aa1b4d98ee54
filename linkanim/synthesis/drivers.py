"""Give a linkage whose input swings a motor that turns fully: a crank and a rod, the driver dyad.

A point D of the input's bar stands in D′ and D″ where the swing ends. A motor on the line D′D″ with a crank
of half that length takes it there and back, each way in half a turn; the rod is as long as the motor lies
from the middle of D′D″ (Norton, Design of Machinery, 3.4). With the arm R from the input's pivot to D, the
swing ψ, the crank R sin ψ/2 and the rod q R, the motor stands R √(q² + cos² ψ/2) from that pivot, and the
cosine of the rod's least transmission angle at D is sin ψ/2 √(1 + cos² ψ/2 / q²).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any, NamedTuple, Protocol, TypeVar

import numpy as np

from linkanim.bounds import NUMBERS, can_be_computed
from linkanim.errors import AssemblyError, BadInput, SceneError
from linkanim.mechanics.measures import as_complex
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.synthesis.linkages import Complex, Real
from linkanim.units import shown

Motor = bool | Sequence[float]
"""Whether a driver is wanted, or the x and y of its motor."""

LEAST = math.radians(30)
"""The transmission angle (rad) that every driver keeps; a swing of 120 deg would take an endless rod."""
_WIDEST = math.radians(115)
"""The widest swing (rad), beyond which the rod is longer than three arms."""
_USUAL = math.radians(40)
"""The transmission angle (rad) that it has where that leaves the rod short."""
_ROD = 3.0
"""The shortest rod, in cranks."""
_SAMPLES = 181
_MET = 1e-9
"""The distance, in longest bars, within which the joints are where they are without a driver."""


class Driver(NamedTuple):
    """A crank on a motor, and a rod from its pin C to a point D of the input's bar; lengths in its unit."""

    motor: complex
    crank: float
    rod: float
    arm: float
    """The length from the input's pivot to D."""
    angle: float
    """The angle (rad) of D there, off the bar's own direction."""
    transmission_angle: float
    """The least one, of the rod at D (rad)."""
    swing: tuple[float, float]
    """The input's angles (rad) between which it swings, the first one first."""
    before: Scene
    """The linkage without it."""

    @property
    def plain(self) -> dict[str, object]:
        """What `--json` prints of it."""
        motor = [self.motor.real, self.motor.imag]
        return {"motor": motor} | {name: getattr(self, name) for name in self._fields[1:6]}

    def places(self, angles: Real) -> Complex:
        """Return the places of D at angles of the input."""
        return np.asarray(_input(self.before)[0] + self.arm * np.exp(1j * (angles + self.angle)))

    @property
    def start(self) -> float:
        """The crank's angle (rad) where the swing begins; it turns counterclockwise from there."""
        first, last = self.places(np.array(self.swing))
        return cmath.phase(first - last)

    def phases(self, angles: Real) -> Real:
        """Return the phases of the driven linkage at angles (n,) of the input, in the order of the swing."""
        away = self.places(np.append(self.swing, angles)) - self.motor
        # in the triangle of motor, C and D
        cosine = (self.crank**2 - self.rod**2 + np.abs(away) ** 2) / (2 * self.crank * np.abs(away))
        lean, seen = np.arccos(np.clip(cosine, -1.0, 1.0)), np.angle(away) - self.start
        forth = [np.angle(np.exp(1j * (seen + sign * lean - math.pi / 2))) for sign in (1.0, -1.0)]
        # half a turn takes it there, about a quarter of a turn after the start
        return np.asarray(min(forth, key=lambda turned: np.abs(turned[2:]).max()))[2:] + math.pi / 2

    @property
    def document(self) -> dict[str, Any]:
        """The document of the driven linkage, in which the input's pin hangs on the rod."""
        document = self.before.document
        name, joints = document["drive"]["joint"], dict(document["joints"])
        base, (pivot, bar) = joints.pop(name)["crank"], _input(self.before)
        pin = self.motor + self.crank * cmath.exp(1j * self.start)
        end = complex(self.places(np.array(self.swing))[0])
        side = "left" if ((pivot - pin).conjugate() * (end - pin)).imag > 0 else "right"
        dyad = {"from": ["C", base], "length": [self.rod, self.arm], "side": side}
        if self.arm == bar and not self.angle:
            held, end_of = {name: dyad}, name
        else:
            at, end_of = bar * cmath.exp(-1j * self.angle), "D"
            held = {"D": dyad, name: {"on": [base, "D"], "at": [at.real, at.imag]}}
        bodies = {key: body for key, body in document["bodies"].items() if key != "crank"}
        start = f"{math.degrees(self.start) % 360!r} deg"
        return {
            **document,
            "title": f"{document['title']}, driven by a crank",
            "drive": {"joint": "C", "speed": "20 rpm", "start": start},
            "ground": {**document["ground"], "O6": [self.motor.real, self.motor.imag]},
            "joints": {"C": {"crank": "O6", "length": self.crank}, **held, **joints},
            "bodies": {
                "driver": {"joints": ["O6", "C"]},
                "driver-rod": {"joints": ["C", end_of]},
                "lever": {"joints": [base, *held]},
                **bodies,
            },
        }


def place_of(motor: Motor) -> complex | None:
    """Return where a motor is asked to stand; None where anywhere. BadInput where it is no point."""
    if isinstance(motor, bool):
        return None
    try:
        values = tuple(float(value) for value in motor)
    except (TypeError, ValueError):
        values = ()
    if len(values) != 2 or not can_be_computed(*values):
        raise BadInput(f"driver={shown(str(motor))}: give the motor's x and y, each {NUMBERS}")
    return complex(*values)


class Drivable(Protocol):
    """An answer of a synthesis."""

    @property
    def scene(self) -> Scene:
        """The linkage."""


Answer = TypeVar("Answer", bound=Drivable)


def all_driven(
    answers: Iterable[Answer], place: complex | None, angles_of: Callable[[Answer], Real | None]
) -> tuple[Answer, ...]:
    """Return answers, each with the scene and the `driver` of a motor that turns fully.

    `angles_of` gives an input's angles in the order in which it passes them; an answer without any stays as
    it is, as one whose input turns fully does. One that no driver swings is left out; BadInput where none is
    left.
    """
    with_drivers, refused = list[Answer](), list[BadInput]()
    for answer in answers:
        angles = None if answer.scene.info.full_turn else angles_of(answer)
        if angles is None:
            with_drivers.append(answer)
            continue
        try:
            scene, driver = driven(answer.scene, angles, place)
        except BadInput as error:
            refused.append(error)
        else:
            with_drivers.append(replace(answer, scene=scene, driver=driver))  # type: ignore[type-var]
    if refused and not with_drivers:
        raise refused[0]
    return tuple(with_drivers)


def driven(scene: Scene, angles: Real, place: complex | None) -> tuple[Scene, Driver]:
    """Return a linkage whose crank A–O2 a driver swings from the first of some angles to the last.

    `place` is where the motor stands. Of the two places beyond either end of the swing, the motor is in the
    one that is farther from all joints on their way. BadInput for a swing that is too wide, and if the driven
    linkage would not run as the linkage itself does.
    """
    on_the_way = np.linspace(angles[0], angles[-1], _SAMPLES)
    own = scene.solve(angle=on_the_way, derivatives=0).position
    passed = np.concatenate([np.ravel(as_complex(at)) for at in own.values()])
    drivers = _drivers(scene, float(angles[0]), float(angles[-1]), place)
    for driver in sorted(drivers, key=lambda one: -np.abs(passed - one.motor).min()):
        try:
            scene_driven = scene_from(driver.document, name=scene.name, where=scene.name)
        except (AssemblyError, SceneError):
            continue
        there = scene_driven.solve(phase=driver.phases(on_the_way), derivatives=0).position
        off = max(float(np.abs(as_complex(own[name]) - as_complex(there[name])).max()) for name in own)
        if scene_driven.info.full_turn and off <= _MET * max(np.ptp(passed.real), np.ptp(passed.imag)):
            return scene_driven, driver
    raise BadInput(f"{scene.name}: no driver swings it from its first place to its last")


def _drivers(scene: Scene, first: float, last: float, place: complex | None) -> list[Driver]:
    """Return the drivers whose motors lie beyond either end of the swing."""
    swing = last - first
    if not swing:
        raise BadInput(f"{scene.name}: its input stands still, so there is nothing to drive")
    if abs(swing) > _WIDEST:
        raise BadInput(
            f"{scene.name}: its input swings through {math.degrees(abs(swing)):.4g} deg; a driver "
            f"swings it through {math.degrees(_WIDEST):g} deg at most"
        )
    sine, cosine = math.sin(abs(swing) / 2), math.cos(abs(swing) / 2)
    least = min(_USUAL, (LEAST + (math.pi - abs(swing)) / 2) / 2)
    away = math.hypot(max(_ROD * sine, cosine / math.sqrt((math.cos(least) / sine) ** 2 - 1)), cosine)
    pivot, bar = _input(scene)
    if place == pivot:
        raise BadInput(f"{scene.name}: its input turns about the motor's place; give the motor another one")
    # a motor farther off has a longer rod, not a longer arm
    far = bar * away if place is None else abs(place - pivot)
    arm = min(bar, far / away)
    rod = math.sqrt(far**2 - (arm * cosine) ** 2)
    drivers = list[Driver]()
    for turn in (math.atan2(rod, arm * cosine), -math.atan2(rod, arm * cosine)):
        motor, angle = pivot + far * cmath.exp(1j * (first + swing / 2 + turn)), 0.0
        if place is not None:
            motor = place
            angle = math.remainder(cmath.phase(place - pivot) - turn - swing / 2 - first, math.tau)
        kept = math.acos(sine * far / rod)
        drivers.append(Driver(motor, arm * sine, rod, arm, angle, kept, (first, last), scene))
    return drivers


def _input(scene: Scene) -> tuple[complex, float]:
    """Return the pivot and the length of a linkage's crank."""
    crank = scene.document["joints"][scene.document["drive"]["joint"]]
    return complex(*scene.document["ground"][crank["crank"]]), float(crank["length"])
