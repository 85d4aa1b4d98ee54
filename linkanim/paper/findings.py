"""What a report says of a scene: its facts, its quantities at chosen angles, and which charts it shows."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import degrees, isfinite, tau
from typing import NamedTuple

import numpy as np

from linkanim.digits import significant, typeset
from linkanim.errors import OutOfRange
from linkanim.mechanics.facts.register import Quantity, input_symbol
from linkanim.mechanics.motion.measures import output_body, output_slider
from linkanim.mechanics.motion.motion import Motion
from linkanim.paper.curves import ChartRequest, Pace, curves_of, extremes
from linkanim.scenes.scene import Scene

_LEVEL = 1e-9
"""Of a quantity's greatest size; what changes less over the cycle has no chart."""


class Instant(NamedTuple):
    """A phase that the report looks at, and why."""

    phase: float
    words: str


class Finding(NamedTuple):
    """A quantity at one instant: its words and symbol, its unit, and a value for each speed."""

    quantity: Quantity
    unit: str
    values: tuple[str, ...]


@dataclass(frozen=True)
class Sheet:
    """All quantities at one instant, by the sort of thing that they are told of."""

    title: str
    sections: tuple[tuple[str, tuple[Finding, ...]], ...]


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
    slider, output = output_slider(scene.linkage), output_body(scene.linkage)
    token = f"{slider.name}.travel" if slider else f"{output.name}.angle" if output else None
    if token is not None and (slider or output is None or output.name not in scene.info.turning_links):
        pace = Pace(abs(scene.linkage.drive.speed), "")
        curve = curves_of(scene, ChartRequest((token,), (pace,), "phase")).curves[0]
        for peak, words in zip(extremes(scene, curve), ("greatest", "least"), strict=False):
            found.append(Instant(np.radians(peak.x), f"{words} {curve.quantity.words.lower()}"))
    return tuple(found)


def sheet(scene: Scene, instant: Instant, paces: tuple[Pace, ...]) -> Sheet:
    """Return every quantity of a scene at one instant, at each speed."""
    motions = [scene.solve(phase=instant.phase, speed=pace.speed) for pace in paces]
    place = f"{input_symbol(scene.linkage)} = {_input_words(scene, float(motions[0].coordinate))}"
    sections: dict[str, list[Finding]] = {}
    for quantity in scene.quantities.values():
        rows = sections.setdefault(_section(quantity), [])
        rows += _rows(scene, quantity, motions)
    found = tuple((title, tuple(rows)) for title, rows in sections.items())
    return Sheet(f"{place} ({instant.words})" if instant.words else place, found)


def _input_words(scene: Scene, angle: float) -> str:
    turned = angle % tau if scene.info.full_turn else angle
    return scene.linkage.drive.coordinate.text(turned, scene.length_unit, 0.01)


def _rows(scene: Scene, quantity: Quantity, motions: list[Motion]) -> Iterator[Finding]:
    """Yield the row of a number; a vector is told by its components, which have tokens of their own."""
    if len(quantity.columns) == 1:
        values = tuple(_digits(float(quantity.shown(motion))) for motion in motions)
        yield Finding(quantity, quantity.shown_unit(scene.length_unit), values)


def _digits(value: float) -> str:
    return typeset(significant(value, 7)) if isfinite(value) else "∞" if value > 0 else "–"


def _section(quantity: Quantity) -> str:
    """Return the heading under which a quantity is told: what its words say it is told of."""
    return quantity.words.partition(":")[0] if ":" in quantity.words else "Whole mechanism"


def charted(scene: Scene) -> Iterator[tuple[str, str]]:
    """Yield (heading, token) of each chart: all that changes over the motion of bodies, springs and dampers,
    centres of mass, traced joints and the whole; of the other joints the tables tell.

    A vector is charted by its components, and a velocity and an acceleration by its size, too.
    """
    cycle = scene.cycle(180)
    joints = {joint.name for joint in scene.linkage.joints} - set(scene.trace)
    bodies = {body.name for body in scene.linkage.bodies}
    for token, quantity in scene.quantities.items():
        owner, _, rest = token.partition(".")
        in_tables = owner in joints - bodies or rest.startswith("pole")
        if not in_tables and rest not in ("position", "com_position") and _changes(quantity, cycle):
            yield _section(quantity), token


def _changes(quantity: Quantity, cycle: Motion) -> bool:
    values = np.asarray(quantity.read(cycle), float)
    known = values[np.isfinite(values)]
    return bool(known.size and np.ptp(known) > max(_LEVEL * np.abs(known).max(), quantity.rounding(cycle)))


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
    names, columns = (
        ["phase", scene.linkage.drive.coordinate.name, "time"],
        [motion.phase, motion.coordinate],
    )
    columns.append(motion.phase / abs(pace.speed))
    for token, quantity in scene.quantities.items():
        if len(quantity.columns) == 1:
            names.append(token)
            columns.append(np.asarray(quantity.read(motion), float))
    return names, np.array(columns)
