"""`linkanim convert`: a linkage of another program, or a scene, as a scene file of points and links."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace
from pathlib import Path

import numpy as np

from linkanim import intake
from linkanim.atomic_files import checked_target, replacing
from linkanim.errors import SceneError
from linkanim.scenes import load
from linkanim.scenes.foreign import is_link, read_foreign, read_text
from linkanim.scenes.posing import as_points
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import text

_CLOSE = 1e-9
"""Share of the linkage's size by which the points of both forms may differ over a period."""


def run(options: Namespace) -> None:
    """Write the scene file, and print its name and what was left out."""
    target = checked_target(options.output, (".toml",), [options.file])
    scene, left_out = _converted(options.file, target.stem)
    with replacing(target) as part:
        part.write_text(text(scene), encoding="utf-8")
    print(target)
    for one in left_out:
        print(f"left out: {one}")


def _converted(name: str, title: str) -> tuple[Scene, tuple[str, ...]]:
    if is_link(name):
        found = read_text(name, "the link")
        document = found.document(title, "converted from a link")
        return replace(scene_from(document, name=title, where="the link"), document=document), found.left_out
    path = Path(name)
    if path.suffix.lower() != ".toml" and (path.suffix or path.is_file()):
        where = intake.named(path)
        found = read_foreign(path, where)
        document = found.document(path.stem, f"converted from {path.name}")
        made = scene_from(document, name=title, where=where)
        return replace(made, document=document), found.left_out
    scene = load(name)
    made = scene_from(as_points(scene), name=title, where=f"{scene.name} as points")
    _refuse_other(scene, made)
    # the document that was read, not the joints that follow from it
    return replace(made, document=as_points(scene)), ()


def _refuse_other(scene: Scene, made: Scene) -> None:
    """Refuse points and links that move otherwise than the scene."""
    phases = np.linspace(0.0, scene.period, 24)
    one, other = (each.solve(phase=phases, speed=1.0, derivatives=0).position for each in (scene, made))
    size = max(float(np.ptp(place)) for place in one.values())
    both = ((place, other[name]) for name, place in one.items() if name in other)
    off = max((float(np.abs(there - here).max()) for here, there in both), default=size)
    if not off <= _CLOSE * size:
        raise SceneError(
            f"{scene.name}: its points and links alone do not say how it moves; it stays in the form that it"
            " has"
        )
