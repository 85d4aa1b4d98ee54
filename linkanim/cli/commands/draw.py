"""`linkanim draw`: one pose of a scene as a figure."""

from __future__ import annotations

from argparse import Namespace
from math import isnan

from linkanim.cli.commands.solve import out_of_range
from linkanim.cli.picture_options import look_of, scene_size_target
from linkanim.paper.figure import Figured
from linkanim.paper.latex import labels_path
from linkanim.paper.write import OF_A_FIGURE, write
from linkanim.scenes.scene import Scene


def run(options: Namespace) -> None:
    """Write the figure that was asked for, and print its path; of a pose of our choice where the input is."""
    scene, size, target = scene_size_target(options, OF_A_FIGURE, ".svg")
    look = look_of(scene, options)
    shown = Figured(scene, size, look, _phase(scene, options), options.poses or 0, options.speed)
    write(shown, target, latex=bool(options.text))
    print(target)
    if options.text:
        print(labels_path(target))
    if shown.phase is None:
        print(f"{shown.caption}: the joints farthest apart; --angle or --phase for another pose")


def _phase(scene: Scene, options: Namespace) -> float | None:
    """Return the phase asked for, None where none is; OutOfRange for an angle that is not reached."""
    if options.angle is None:
        return None if options.phase is None else float(options.phase)
    phase = float(scene.solve(angle=options.angle, derivatives=0).phase)
    if isnan(phase):
        raise out_of_range(scene, options.angle)
    return phase
