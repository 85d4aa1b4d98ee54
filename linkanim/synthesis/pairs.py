"""Add a linkage's mirror image, geared to its crank: both fingers of a gripper, on one motor.

The image's crank meshes with the linkage's own, wheel to wheel, so it turns as far the other way; all else is
mirrored bar by bar.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from linkanim import units
from linkanim.bounds import can_be_computed
from linkanim.errors import AssemblyError, BadInput, SceneError
from linkanim.mechanics.measures import as_complex
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.synthesis.drivers import Drivable
from linkanim.synthesis.linkages import Complex
from linkanim.units import shown

_SIDES = {"left": "right", "right": "left"}
_POSES = 360
_MET = 1e-9
"""The distance, in sizes of the linkage, within which the image is where it should be."""

Answer = TypeVar("Answer", bound=Drivable)


class Mirror:
    """The line x = c or y = c, from a text such as "x=40"; BadInput for any other."""

    def __init__(self, text: str) -> None:
        match = re.fullmatch(r"\s*([xy])\s*=\s*(\S+)\s*", text)
        try:
            self.at = float(match[2]) if match else math.nan
        except ValueError:
            self.at = math.nan
        if match is None or not can_be_computed(self.at):
            raise BadInput(f'mirror={shown(text)}: give a line such as "x=40" or "y=0"')
        self.upright = match[1] == "x"

    def places(self, places: Complex) -> Complex:
        """Return the images of places."""
        return 2 * self.at - places.conj() if self.upright else places.conj() + 2j * self.at

    def point(self, x: float, y: float) -> list[float]:
        """Return the image of a point."""
        return [2 * self.at - x, y] if self.upright else [x, 2 * self.at - y]

    @property
    def turned(self) -> float:
        """The angle (degrees) from which a direction's angle is taken away to give that of its image."""
        return 180.0 if self.upright else 0.0


def mirror_of(text: str | None) -> Mirror | None:
    """Return the line of a text; None where there is none."""
    return None if text is None else Mirror(text)


def paired(answers: Iterable[Answer], mirror: Mirror | None) -> tuple[Answer, ...]:
    """Return answers, each with its mirror image in the same scene, if there is a mirror."""
    if mirror is None:
        return tuple(answers)
    return tuple(replace(answer, scene=with_image(answer.scene, mirror)) for answer in answers)  # type: ignore[type-var]


def with_image(scene: Scene, mirror: Mirror) -> Scene:
    """Return a scene with its mirror image, whose crank is geared to its own.

    BadInput where the crank's pivot lies on the line, and where the input swings to its limits.
    """
    document, crank = scene.document, scene.document["drive"]["joint"]
    pins, traced = document["ground"], document["trace"]["joints"]
    image = {name: f"{name}'" for name in (*pins, *document["joints"])}
    base = document["joints"][crank]["crank"]
    if mirror.point(*pins[base]) == list(pins[base]):
        raise BadInput(f"{scene.name}: its crank turns about a point of the mirror's line; move that line")

    def mirrored(key: str, value: Any) -> Any:
        if key in ("from", "on", "joints") and isinstance(value, list):
            return [image[name] for name in value]
        if key in ("from", "crank", "slider"):
            return image[value]
        if key == "side":
            return _SIDES.get(value, value)
        if key == "at":
            return [value[0], 0.0 - value[1]]
        if key == "line":
            angle = mirror.turned - math.degrees(units.angle(value["angle"]))
            return {
                "through": image[value["through"]],
                "angle": f"{angle!r} deg",
                "offset": 0.0 - value["offset"],
            }
        return value

    joints = {
        image[name]: {key: mirrored(key, value) for key, value in table.items()}
        for name, table in document["joints"].items()
    }
    joints[image[crank]]["gear"] = {"with": crank, "ratio": -1, "offset": f"{mirror.turned:g} deg"}
    bodies = {
        f"{name}'": {key: mirrored(key, value) for key, value in table.items()}
        for name, table in document["bodies"].items()
    }
    pair = {
        **{key: value for key, value in document.items() if key not in ("guide", "function")},
        "title": f"{document['title']}, and its image",
        "ground": pins | {image[name]: mirror.point(*at) for name, at in pins.items()},
        "joints": document["joints"] | joints,
        "bodies": document["bodies"] | bodies,
        "trace": {"joints": [*traced, *(image[name] for name in traced)]},
    }
    try:
        scene_of_pair = scene_from(pair, name=scene.name, where=scene.name)
        places = {
            name: as_complex(at) for name, at in scene_of_pair.cycle(_POSES, derivatives=0).position.items()
        }
    except (AssemblyError, SceneError):
        places = {}
    far = max((float(np.abs(at).max()) for at in places.values()), default=0.0)
    off = [np.abs(mirror.places(places[name]) - places[image[name]]).max() for name in image if places]
    if not places or not max(off) <= _MET * far:
        raise BadInput(
            f"{scene.name}: its input only swings, and gears do not take its image along; ask for a driver"
        )
    return scene_of_pair
