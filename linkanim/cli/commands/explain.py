"""`linkanim explain`: how the numbers of a pose follow from the drawing, line by line."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace
from math import isnan

from linkanim.atomic_files import checked_target, write_text
from linkanim.cli.commands.solve import phase_at
from linkanim.cli.options import inputs_of
from linkanim.errors import BadInput
from linkanim.explain.documents import HTML, MARKDOWN, TEX, document
from linkanim.explain.solution import PoseRequest, Solution, solution
from linkanim.explain.variant import variant
from linkanim.paper.construction import ConstructionPage
from linkanim.paper.svg import svg
from linkanim.paper.vectors import vectors_svg
from linkanim.picture.figure import figure
from linkanim.scenes import load
from linkanim.scenes.editing import in_unit
from linkanim.scenes.scene import Scene

_CONSTRUCTION = (960, 640)
"""The size of the figure of a construction."""
FORMS = {".html": HTML, ".htm": HTML, ".tex": TEX, ".md": MARKDOWN}


def run(options: Namespace) -> None:
    """Write the worked solution that was asked for, and print its path; without one print it as Markdown.

    `BadInput` for an output that cannot be, before anything is worked out; `OutOfRange` for an angle that the
    input does not come to.
    """
    target = (
        None if options.output is None else checked_target(options.output, tuple(FORMS), inputs_of(options))
    )
    found = solution(_request(load(options.scene), options))
    form = MARKDOWN if target is None else FORMS[target.suffix.lower()]
    form = replace(form, figure=_figure, construction=_construction) if form is HTML else form
    text = document(found, form, exercise=options.exercise)
    if target is None:
        print(text, end="")
        return
    write_text(target, text)
    print(target)


def _figure(found: Solution) -> str:
    return f"<figure class='vectors'>{vectors_svg(found)}</figure>" if found.loops else ""


def _construction(found: Solution) -> str:
    page = ConstructionPage(found.request.scene, _CONSTRUCTION)
    drawn = svg(page.size, None, page.groups(), title=page.title)
    return f"<figure class='vectors'>{drawn[drawn.index('<svg') :]}</figure>"


def _request(scene: Scene, options: Namespace) -> PoseRequest:
    """Return the pose that is asked for, of other lengths with a seed.

    Without a pose it is that at which the scene's own joints are farthest apart.
    """
    request = _pose(scene, options)
    if options.seed is None:
        return replace(request, scene=in_unit(scene, options.unit))

    def reached(changed: Scene) -> bool:
        return not isnan(replace(request, scene=changed).motion().phase)

    return replace(request, scene=in_unit(variant(scene, options.seed, reached), options.unit))


def _pose(scene: Scene, options: Namespace) -> PoseRequest:
    speed = scene.linkage.drive.speed if options.speed is None else options.speed
    if options.angle is None:
        phase = figure(scene).clearest if options.phase is None else options.phase
        request = PoseRequest(scene, "phase", float(phase), speed, options.acceleration)
        if options.acceleration and request.swings:
            raise BadInput("--acceleration is the input's own; of an input that swings give --angle with it")
        return request
    phase_at(scene, options.angle)  # which says why where it is not reached
    return PoseRequest(scene, "angle", float(options.angle), speed, options.acceleration)
