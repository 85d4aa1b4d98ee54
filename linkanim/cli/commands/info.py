"""`linkanim info`: what kind of linkage a scene is."""

from __future__ import annotations

from argparse import Namespace
from cmath import phase
from collections.abc import Iterator
from math import degrees
from typing import TYPE_CHECKING

from linkanim.atomic_files import checked_target
from linkanim.cli import tolerances
from linkanim.export import json_text
from linkanim.mechanics.balance import Counterweight, balanced, counterweights, flywheel, shaken
from linkanim.scenes import load
from linkanim.scenes.scene import Scene
from linkanim.units import rpm, significant, typeset

if TYPE_CHECKING:
    from linkanim.paper.balance import BalanceChart

_OF_A_SCENE = ("title", "chapter", "source", "look_at", "length_unit")
_OF_ITS_MOTION = (
    *("class", "grashof", "circuits", "turning_links", "links", "full_turn", "input_range", "toggles"),
    *("change_points", "true_period", "period_seconds", "transmission_angle"),
)
_CALLED = {"class": "class_name", "links": "link_names"}
"""The names in the code of keys that have another name in JSON."""


def run(options: Namespace) -> None:
    """Print the scene's class, limits and what follows from them, in words or as one JSON object."""
    scene = load(options.scene)
    tolerance = tolerances.asked(scene, options)
    balance = _balance(scene, options)
    if options.json:
        facts = as_object(scene) | evened(scene, options.fluctuation)
        facts |= {} if tolerance is None else {"tolerance": tolerances.object_of(tolerance)}
        print(json_text(facts, indent=2))
    else:
        print(as_words(scene, options.fluctuation))
        if tolerance is not None:
            print(f"\n{tolerances.table_of(tolerance)}")
    if tolerance is not None and options.chart is not None:
        tolerances.draw(tolerance, options.chart)
    if balance is not None:
        tolerances.draw_page(balance, options.balance)


def _balance(scene: Scene, options: Namespace) -> BalanceChart | None:
    """Return the chart of the balance that is asked for; BadInput where there is none to draw."""
    if options.balance is None:
        return None
    from linkanim.paper.balance import BalanceChart

    options.balance = checked_target(options.balance, tolerances.CHARTS, [options.scene])
    balance = BalanceChart(scene=scene)
    assert balance.both
    return balance


def as_words(scene: Scene, fluctuation: float) -> str:
    """Return a label and a value on each line, the values below each other."""
    lines = [*scene.lines, *_evened_lines(scene, fluctuation)]
    width = max(len(label) for label, _ in lines)
    return "\n".join(f"{label:<{width}}  {value}" for label, value in lines if value)


def evened(scene: Scene, fluctuation: float) -> dict[str, object]:
    """Return what evens out a machine with masses or loads, as `--json` prints it; nothing of others.

    `work_surplus` (J) and the `flywheel_inertia` (kg m²) with which the speed changes by the `fluctuation`;
    the `counterweights` of a four-bar with a heavy coupler, and the greatest `shaking_force` (N) and
    `shaking_moment` (N m) of inertia without them and with them.
    """
    facts: dict[str, object] = {}
    if (work := scene.info.surplus) is not None:
        facts |= {"work_surplus": work, "fluctuation": fluctuation}
        facts["flywheel_inertia"] = flywheel(work, scene.linkage.drive.speed, fluctuation)
    if weights := counterweights(scene.linkage):
        facts["counterweights"] = [
            {"body": one.body, "mass": one.mass, "place": [one.place.real, one.place.imag]} for one in weights
        ]
        forces, moments = zip(*_shaken(scene, weights), strict=True)
        facts |= {"shaking_force": forces, "shaking_moment": moments}
    return facts


def _shaken(scene: Scene, weights: tuple[Counterweight, ...]) -> list[tuple[float, float]]:
    """Return the greatest force and moment of inertia on the ground, without and with counterweights."""
    linkages = (scene.linkage, balanced(scene.linkage, weights))
    return [shaken(one, scene.linkage.drive.speed).greatest for one in linkages]


def _evened_lines(scene: Scene, fluctuation: float) -> Iterator[tuple[str, str]]:
    """Yield the same as labels and values."""
    speed = scene.linkage.drive.speed
    if (work := scene.info.surplus) is not None:
        inertia = significant(flywheel(work, speed, fluctuation), 4)
        yield "surplus of work", f"{significant(work, 6)} J"
        within = f"{significant(100 * fluctuation, 4)} % at {rpm(abs(speed))}"
        yield "flywheel", f"{inertia} kg m² keeps the speed within {within}"
    if weights := counterweights(scene.linkage):
        yield "counterweights", "; ".join(_in_words(scene, one) for one in weights)
        (force, moment), (after, turning) = _shaken(scene, weights)
        yield "shaking force", _from_to(force, after, "N")
        yield "shaking moment", _from_to(moment, turning, "N m")


def _in_words(scene: Scene, one: Counterweight) -> str:
    """Return a counterweight in words."""
    far = f"{significant(abs(one.place), 4)} {scene.length_unit}"
    turned = typeset(significant(degrees(phase(one.place)), 4))
    named = scene.info.link_names[one.body]
    return f"{significant(one.mass, 4)} kg on the {named}, {far} from its pin, {turned}° from its bar"


def _from_to(before: float, after: float, unit: str) -> str:
    told = (significant(one, 4) for one in (before, after))
    return "up to {} {unit} of inertia, with the counterweights {} {unit}".format(*told, unit=unit)


def as_object(scene: Scene) -> dict[str, object]:
    """Return what `--json` prints: angles in radians, time in s, lengths in the scene's unit.

    `links` gives each body's name by its function. `transmission_angle` is the least and the greatest, at
    most π/2; `worst_transmission` gives the joint and the phase at which it is least. A linkage with a slider
    has `stroke` and `time_ratio`, null where they have no meaning; one whose output is a rocker has `swing`
    and `time_ratio`. `link_count` includes the ground; `work_per_period` (J), peak and mean torque (N m; of
    a cylinder force, N) for one with forces or masses, null where the effort is unbounded.
    """
    info = scene.info
    facts: dict[str, object] = {"scene": scene.name}
    facts |= {name: getattr(scene, name) for name in _OF_A_SCENE}
    facts |= {name: getattr(info, _CALLED.get(name, name)) for name in _OF_ITS_MOTION}
    facts |= {"mobility": info.counts.mobility, "link_count": info.counts.links}
    facts["joint_count"] = info.counts.joints
    if not info.full_turn:
        facts["other_ranges"] = info.mechanism.other_ranges
        facts |= {"returns": "same" if info.mechanism.retraced else "other", "same_closure_at": info.kept}
    if info.transmission:
        facts["worst_transmission"] = {"joint": info.transmission.dyad, "phase": info.transmission.phase}
    if any(body.slider for body in scene.linkage.bodies):
        facts |= {"stroke": info.stroke, "time_ratio": info.time_ratio}
    elif info.swing:
        facts |= {"swing": info.swing.stroke, "time_ratio": info.time_ratio}
    if info.demand is not None:
        work, peak, mean = info.demand
        name = info.effort[0]
        facts |= {"work_per_period": work, f"peak_{name}": peak, f"mean_{name}": mean}
    return facts
