"""`linkanim info`: what kind of linkage a scene is."""

from __future__ import annotations

from argparse import Namespace

from linkanim.export import json_text
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

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
    if options.json:
        print(json_text(as_object(scene), indent=2))
    else:
        print(as_words(scene))


def as_words(scene: Scene) -> str:
    """Return a label and a value on each line, the values below each other."""
    width = max(len(label) for label, _ in scene.lines)
    return "\n".join(f"{label:<{width}}  {value}" for label, value in scene.lines if value)


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
