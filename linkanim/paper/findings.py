"""What a report says of a scene: its facts, its quantities at chosen angles, and which charts it shows."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from math import degrees, tau
from typing import NamedTuple

import numpy as np

from linkanim.digits import rounded
from linkanim.errors import OutOfRange
from linkanim.mechanics.closing.search import sign_changes
from linkanim.mechanics.facts.register import Quantity, input_symbol
from linkanim.mechanics.motion.measures import output_body, output_slider
from linkanim.paper.curves import SAMPLES, Pace, curves_of, extremes
from linkanim.scenes.scene import Scene

_SAMPLES = 180
_BESIDE = tau / SAMPLES
"""How far from an extreme as it is read off a curve its rate changes its sign, in radians at the most."""
_SAME = 1e-9
"""Instants are one that are nearer in phase."""


class Instant(NamedTuple):
    """A phase that the report looks at, and why."""

    phase: float
    words: str


class Finding(NamedTuple):
    """A quantity at one instant: its words and symbol, its unit, and a value for each speed."""

    quantity: Quantity
    unit: str
    values: tuple[str, ...]


def instants_at(scene: Scene, angles: tuple[float, ...]) -> tuple[Instant, ...]:
    """Return the instants at angles of the input (rad); OutOfRange for one that it does not come to."""
    path = scene.mechanism.assembly.path
    if angles:
        scene.linkage.drive.check_angle(scene.name, "leave --angles out")
    for angle in angles:
        if not path.holds(angle):
            low, high = (f"{degrees(limit):.6g} deg" for limit in path.input_range)
            raise OutOfRange(
                f"{scene.name}: --angles {degrees(angle):.6g} deg cannot be reached; "
                f"the {scene.info.input_name} angle goes from {low} to {high}"
            )
    return tuple(Instant(path.phase_of(angle, 0.0), "") for angle in angles)


def usual_instants(scene: Scene) -> tuple[Instant, ...]:
    """Return the start, and where the output is furthest either way, if it turns back at all."""
    found = [Instant(0.0, "start")]
    output = output_slider(scene.linkage) or output_body(scene.linkage)
    if output and (output.slider or output.name not in scene.info.turning_links):
        place, rate = ("travel", "travel_velocity") if output.slider else ("angle", "angular_velocity")
        pace = Pace(abs(scene.linkage.drive.speed), "")
        curve = curves_of(scene, (f"{output.name}.{place}",), (pace,), "phase").curves[0]
        for peak, words in zip(extremes(scene, curve), ("greatest", "least"), strict=False):
            phase = _at_rest(scene, (rate, output.name), float(np.radians(peak.x)))
            found.append(Instant(phase, f"{words} {curve.quantity.words.lower()}"))
    return tuple(_together(found, scene.period))


def _together(found: list[Instant], period: float) -> Iterator[Instant]:
    """Yield instants, those after the first that are at its phase along with it."""
    start, *others = found
    same = [one for one in others if min(one.phase % period, -one.phase % period) < _SAME]
    yield start._replace(words=", ".join(one.words for one in (start, *same)))
    yield from (one for one in others if one not in same)


def _at_rest(scene: Scene, rate: tuple[str, str], near: float) -> float:
    """Return the phase next to an extreme at which what is extreme rests; that of the extreme without one.

    `rate` is that of a part, under a motion's name for it.
    """
    kind, part = rate

    def speed(phases: np.ndarray) -> np.ndarray:
        return np.asarray(getattr(scene.solve(phase=phases), kind)[part])

    found = sign_changes(speed, near + _BESIDE * np.array([-1.0, 1.0]))
    return float(found[0]) if len(found) else near


class Values:
    """Quantities at an instant, and whether they change over the cycle."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self._cycle = scene, scene.cycle(scene.mechanism.count(_SAMPLES))
        # each serves every quantity
        self._motion = cache(lambda phase, speed: scene.solve(phase=phase, speed=speed))

    def of(self, quantity: Quantity, instant: Instant, pace: Pace) -> float:
        """Return the value of one number as people read it, NaN where it has none."""
        return float(quantity.shown(self._motion(instant.phase, pace.speed)))

    def changes(self, quantity: Quantity) -> bool:
        """Whether a quantity has more than one value over the cycle, rounding errors aside."""
        return quantity.changes(self._cycle)


def sheet(values: Values, instant: Instant, paces: tuple[Pace, ...], digits: int) -> dict[str, list[Finding]]:
    """Return every quantity of a scene at one instant, at each speed, by what it is told of.

    A vector is told by its components, which have tokens of their own.
    """
    sections: dict[str, list[Finding]] = {}
    for quantity in values.scene.quantities.values():
        rows = sections.setdefault(_section(quantity), [])
        if len(quantity.columns) == 1:
            found = tuple(rounded(values.of(quantity, instant, pace), digits) for pace in paces)
            rows.append(Finding(quantity, quantity.shown_unit(values.scene.length_unit), found))
    return sections


def place_of(scene: Scene, instant: Instant) -> str:
    """Return where the input is at an instant, and why that is looked at: θ₂ = 0.00° (start)."""
    symbol, angle = input_symbol(scene.linkage), scene.pose(instant.phase, 0).coordinate
    turned = angle % tau if scene.info.full_turn else angle
    place = f"{symbol} = {scene.linkage.drive.coordinate.text(turned, scene.length_unit, 0.01)}"
    return f"{place} ({instant.words})" if instant.words else place


def _section(quantity: Quantity) -> str:
    """Return the heading under which a quantity is told: what its words say it is told of."""
    return quantity.words.partition(":")[0] if ":" in quantity.words else "Whole mechanism"


def charted(values: Values) -> Iterator[str]:
    """Yield the token of each chart: all that changes over the motion of bodies, springs and dampers,
    centres of mass, traced joints and the whole; of the other joints the tables tell.

    A vector is charted by its components, and a velocity and an acceleration by its size, too.
    """
    scene = values.scene
    joints = {joint.name for joint in scene.linkage.joints} - set(scene.trace)
    bodies = {body.name for body in scene.linkage.bodies}
    for token, quantity in scene.quantities.items():
        owner, _, rest = token.partition(".")
        in_tables = owner in joints - bodies or rest.startswith("pole")
        if not in_tables and rest not in ("position", "com_position") and values.changes(quantity):
            yield token


def paces_of(scene: Scene, token: str, paces: tuple[Pace, ...]) -> tuple[Pace, ...]:
    """Return the speeds at which a quantity is charted: one where the speed makes no difference."""
    return paces if scene.quantities[token].order else paces[:1]


def table(scene: Scene, pace: Pace) -> tuple[list[str], np.ndarray]:
    """Return the names and columns of every quantity over one true period: phase, angle, time, then all.

    A row for each degree of phase. Angles in radians, lengths in the scene's unit, time in seconds from the
    start of the drive.
    """
    count = round(degrees(scene.period))
    motion = scene.solve(phase=np.arange(count + 1) * (scene.period / count), speed=pace.speed)
    names = ["phase", scene.linkage.drive.coordinate.name, "time"]
    columns = [motion.phase, motion.coordinate, motion.phase / abs(pace.speed)]
    for token, quantity in scene.quantities.items():
        if len(quantity.columns) == 1:
            names.append(token)
            columns.append(np.asarray(quantity.read(motion), float))
    return names, np.array(columns)
