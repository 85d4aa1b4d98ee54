"""`linkanim draw`: one pose of a scene as a figure."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace
from math import prod

from linkanim.bounds import MOST_DRAWN, MOST_DRAWN_PIXELS
from linkanim.cli.alternative import alternative, plain
from linkanim.cli.commands.solve import phase_at
from linkanim.cli.letters import tell_of_picture
from linkanim.cli.picture_options import Canvas, look_of, scene_canvas_target
from linkanim.errors import BadInput
from linkanim.manifest import Output
from linkanim.paper.figure import Figured
from linkanim.paper.write import OF_A_FIGURE, Written, write
from linkanim.scenes.scene import Scene


def run(options: Namespace) -> None:
    """Write the figure that was asked for, and print its path; for a pose of our choice, also the input."""
    scene, canvas, target = scene_canvas_target(options, OF_A_FIGURE, ".svg")
    look, told = look_of(scene, options), alternative(options)
    look = replace(look, type_scale=canvas.type_scale, background=look.background and canvas.ground)
    size = canvas.size
    is_raster = target.path.suffix.lower() == ".png"
    _refuse_many(scene, options.poses or 0, size if is_raster else (0, 0))
    phase = options.phase if options.angle is None else phase_at(scene, options.angle)
    if options.construction is not None:
        from linkanim.paper.construction import ConstructionPage

        kind, steps = options.construction
        page = ConstructionPage(
            scene,
            steps,
            kind,
            phase,
            size=size,
            theme=look.theme,
            type_scale=canvas.type_scale,
            ground=canvas.ground,
        )
        _write(page, target, canvas, latex=bool(options.text))
        told(page.title)
        return
    phase = None if phase is None else float(phase)
    lit = look.material == "lit"
    shown = Figured(scene, size, look, phase, options.poses or 0, options.speed, lit=lit)
    _write(shown, target, canvas, latex=bool(options.text))
    told(shown.words)
    if shown.phase is None:
        print(f"{plain(shown.caption)}: the pose that reads best; --angle or --phase for another")


def _write(shown: Written, target: Output, canvas: Canvas, *, latex: bool) -> None:
    """Write a picture, and print the path of each file that is written."""
    write(shown, target, latex=latex, wide=canvas.wide)
    print(target.path)
    if latex:
        from linkanim.paper.latex import labels_of

        print(labels_of(target).path)
    tell_of_picture(shown, target, latex=latex)


def _refuse_many(scene: Scene, poses: int, size: tuple[int, int]) -> None:
    """Refuse more poses than a picture of `size` pixels holds; a vector file has a size of (0, 0)."""
    joints, larger = len(scene.linkage.joints), max(prod(size) / MOST_DRAWN_PIXELS, 1.0)
    most = int(MOST_DRAWN / larger) // joints
    if poses > most:
        place = f" at {size[0]}x{size[1]}" if larger > 1.0 else ""
        raise BadInput(
            f"--poses {poses}: of {scene.name}, which has {joints} joints, a figure holds {most} poses"
            f"{place}; take {most} or fewer"
        )
