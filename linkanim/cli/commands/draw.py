"""`linkanim draw`: one pose of a scene as a figure."""

from __future__ import annotations

from argparse import Namespace
from math import isnan

from linkanim.cli.commands.solve import out_of_range
from linkanim.cli.picture_options import centres_of, scene_size_target
from linkanim.paper.figure import SUFFIXES, Figured, write
from linkanim.picture.look import Look
from linkanim.scenes.reading.closure import other_closure
from linkanim.scenes.scene import Scene


def run(options: Namespace) -> None:
    """Write the figure that was asked for, and print its path."""
    scene, size, target = scene_size_target(options, SUFFIXES, ".svg")
    if options.ghost:
        other_closure(scene)  # which says why where there is none
    look = Look(
        hud=False,
        theme=options.theme,
        trace=options.trace,
        vectors=options.vectors,
        names=min(options.names, 2),
        ghost=options.ghost,
        polygons=options.polygons,
        centres=centres_of(scene, options),
        background=not options.transparent,
    )
    phase = _phase(scene, options)
    write(Figured(scene, size, look, phase, options.poses or 0), target)
    print(target)


def _phase(scene: Scene, options: Namespace) -> float:
    """Return the phase asked for, 0 where none is; OutOfRange for an angle that is not reached."""
    if options.angle is None:
        return float(options.phase or 0.0)
    phase = float(scene.solve(angle=options.angle, derivatives=0).phase)
    if isnan(phase):
        raise out_of_range(scene, options.angle)
    return phase
