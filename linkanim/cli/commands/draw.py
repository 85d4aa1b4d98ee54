"""`linkanim draw`: one pose of a scene as a figure."""

from __future__ import annotations

from argparse import Namespace
from math import isnan

from linkanim.cli.commands.solve import out_of_range
from linkanim.cli.picture_options import look_of, scene_size_target
from linkanim.paper.figure import SUFFIXES, Figured, write
from linkanim.scenes.scene import Scene


def run(options: Namespace) -> None:
    """Write the figure that was asked for, and print its path."""
    scene, size, target = scene_size_target(options, SUFFIXES, ".svg")
    look = look_of(scene, options)
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
