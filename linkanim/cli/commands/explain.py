"""`linkanim explain`: how the numbers of a pose follow from the drawing, line by line."""

from __future__ import annotations

from argparse import Namespace
from math import isnan

from linkanim.atomic_files import checked_target, replacing
from linkanim.cli.commands.solve import out_of_range
from linkanim.explain.documents import html, latex, markdown
from linkanim.explain.inputs import Asked
from linkanim.explain.solution import solution
from linkanim.picture.figure import figure
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

WRITERS = {".html": html, ".htm": html, ".tex": latex, ".md": markdown}


def run(options: Namespace) -> None:
    """Write the worked solution that was asked for, and print its path; without one print it as Markdown.

    `BadInput` for an output that cannot be, before anything is worked out; `OutOfRange` for an angle that the
    input does not come to.
    """
    target = None if options.output is None else checked_target(options.output, tuple(WRITERS))
    asked = _asked(load(options.scene), options)
    if target is None:
        print(markdown(solution(asked)), end="")
        return
    text = WRITERS[target.suffix.lower()](solution(asked))
    with replacing(target) as part:
        part.write_text(text, encoding="utf-8")
    print(target)


def _asked(scene: Scene, options: Namespace) -> Asked:
    """Return the pose that is asked for; that at which joints are farthest apart where none is."""
    speed = scene.linkage.drive.speed if options.speed is None else options.speed
    if options.angle is None:
        phase = figure(scene).clearest if options.phase is None else options.phase
        return Asked(scene, "phase", float(phase), speed)
    if isnan(scene.solve(angle=options.angle, derivatives=0).phase):
        raise out_of_range(scene, options.angle)
    return Asked(scene, "angle", float(options.angle), speed)
