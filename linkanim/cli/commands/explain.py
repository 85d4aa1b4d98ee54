"""`linkanim explain`: how the numbers of a pose follow from the drawing, line by line."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from dataclasses import replace
from math import degrees, isnan, radians, tau

from linkanim.atomic_files import checked_target, write_text
from linkanim.bounds import MOST_VERSIONS
from linkanim.cli.commands.solve import phase_at
from linkanim.cli.letters import tell_of_scene
from linkanim.cli.options import inputs_of
from linkanim.cli.progress import along
from linkanim.errors import BadInput
from linkanim.explain.documents import HTML, MARKDOWN, TEX, page_form
from linkanim.explain.exercise import LEVELS, exercise
from linkanim.explain.solution import PoseRequest, Solution, solution
from linkanim.explain.variant import variant
from linkanim.intake import few
from linkanim.letters import LATEX
from linkanim.paper.construction import ConstructionPage
from linkanim.paper.figure import dimensioned
from linkanim.paper.free_bodies import free_bodies_svg
from linkanim.paper.html import embedded
from linkanim.paper.svg import svg
from linkanim.paper.vectors import vectors_svg
from linkanim.picture.stills import still_phase
from linkanim.scenes import load
from linkanim.scenes.editing import in_unit
from linkanim.scenes.scene import Scene
from linkanim.units import shown as quoted
from linkanim.words import said

_CONSTRUCTION = (960, 640)
"""The size of the figure of a construction, in pixels."""
_MOST_LETTERS = 26
"""The most versions: they are called A to Z."""
_NEAR = 0.05
"""The most that joints move where an angle is rounded to tenths of a degree, in longest bars."""
_PANEL = 200
"""The least width of a free body's panel on a page, in pixels."""
FORMS = {".html": HTML, ".htm": HTML, ".tex": TEX, ".md": MARKDOWN}


def run(options: Namespace) -> None:
    """Write the worked solution that was asked for, and print its path; without one print it as Markdown.

    `BadInput`, before anything is worked out, for an output that cannot be written; `OutOfRange` for an angle
    that the input does not reach.
    """
    target = (
        None if options.output is None else checked_target(options.output, tuple(FORMS), inputs_of(options))
    )
    if not options.exercise and (options.level or options.versions):
        raise BadInput("--level and --versions are of an exercise; add --exercise")
    requests = along(_requests(load(options.scene), options), " versions", options.versions or 1)
    versions = [solution(request) for request in requests]
    form = MARKDOWN if target is None else FORMS[target.suffix.lower()]
    if form is HTML:
        drawn = _dimensioned if options.exercise else _figure
        form = page_form(drawn, _construction, _free, lit=options.forces or options.static)
    text = (
        exercise(versions, form, options.level or LEVELS[0])
        if options.exercise
        else form.document(versions[0])
    )
    if target is None:
        print(text, end="")
        return
    write_text(target, text)
    print(target)
    if target.suffix.lower() == ".tex":
        tell_of_scene(versions[0].request.scene, LATEX)


def _figure(solution: Solution) -> str:
    if not solution.arrows:
        return ""
    drawn = embedded(vectors_svg(solution), said("Vector loops of {title}", title=solution.title))
    return f"<figure class='vectors'>{drawn}</figure>"


def _dimensioned(solution: Solution) -> str:
    figured = dimensioned(solution.request.scene, solution.phase)
    drawn = embedded(figured.document(), said("{title}: dimensions", title=solution.title))
    return f"<figure class='vectors'>{drawn}</figure>"


def _free(solution: Solution) -> str:
    # on a phone it is not so small that it cannot be read, and is moved sideways
    least = f"min-width: {_PANEL * min(len(solution.bodies), 3)}px"
    drawn = embedded(free_bodies_svg(solution), said("Free bodies of {title}", title=solution.title), least)
    return f"<figure class='vectors'>{drawn}</figure>"


def _construction(solution: Solution) -> str:
    page = ConstructionPage(solution.request.scene, size=_CONSTRUCTION)
    drawn = svg(page.size, None, page.groups(), title=page.title)
    return f"<figure class='vectors'>{embedded(drawn, page.title)}</figure>"


def _requests(scene: Scene, options: Namespace) -> Iterator[PoseRequest]:
    """Yield the pose that is asked for, or the versions of an exercise; with a seed they have other lengths.

    Where no pose is asked for it is the one that a figure of the scene shows. The numbers that an exercise
    gives are round.
    """
    request = _rounded(_pose(scene, options)) if options.exercise else _pose(scene, options)
    count = 1 if options.versions is None else options.versions
    joints = len(scene.linkage.joints)
    most = max(min(MOST_VERSIONS // joints, _MOST_LETTERS), 1)
    if not 1 <= count <= most:
        of = f"; {scene.name} has {joints} joints" if most < _MOST_LETTERS else ""
        raise BadInput(f"--versions {count}: give a number from 1 to {most}{of}")

    def reached(changed: Scene) -> bool:
        return not isnan(replace(request, scene=changed).motion().phase)

    request = replace(request, forces=options.forces or options.static, about=_about(scene, options))
    first = options.seed if options.seed is not None or count == 1 else 0
    for seed in [None] if first is None else range(first, first + count):
        changed = scene if seed is None else variant(scene, seed, reached)
        shown = in_unit(changed, options.unit)
        yield replace(request, scene=shown.without_inertia if options.static else shown)


def _about(scene: Scene, options: Namespace) -> str | None:
    """Return the joint about which moments are taken; BadInput where there is none, or are no forces."""
    if options.forces or options.static:
        scene.refuse_forceless()
    about: str | None = options.moments_about
    if about is not None and not (options.forces or options.static):
        raise BadInput("--moments-about goes with --forces; add it")
    if about is not None and about not in scene.linkage.by_name:
        raise BadInput(
            f"--moments-about {quoted(about)}: {scene.name} has no such joint; there are "
            f"{few(scene.linkage.by_name)}"
        )
    return about


def _rounded(request: PoseRequest) -> PoseRequest:
    """Return a pose whose speed has four digits, and its angle or phase tenths of a degree.

    Of an input that swings it has an angle and a velocity as they are given of one that turns, if it comes to
    the same closure there.
    """
    value = request.value if request.by == "angle" else radians(round(degrees(request.value), 1))
    rounded = replace(request, value=value, speed=float(f"{request.speed:.4g}"))
    if not (request.swings and request.scene.linkage.drive.actuator.along is None):
        return rounded
    if not request.scene.linkage.drive.coordinate.is_angle:
        return rounded
    was = rounded.motion()
    angle, speed = radians(round(degrees(was.coordinate), 1)), float(f"{was.coordinate_rate:.4g}")
    stated = replace(rounded, by="angle", value=angle, speed=speed)
    far = max(abs(stated.motion().position[name] - at).max() for name, at in was.position.items())
    return stated if far < _NEAR * request.scene.linkage.longest else rounded


def _pose(scene: Scene, options: Namespace) -> PoseRequest:
    speed = scene.linkage.drive.speed if options.speed is None else options.speed
    angle, phase = options.angle, options.phase
    if angle is not None:
        phase_at(scene, angle)  # raises OutOfRange where the input does not reach it
    elif phase is None:
        phase = still_phase(scene)
        # an input that turns has one pose at that angle within its first turn; one that swings has two
        angle = scene.pose(phase, 0).coordinate % tau if scene.info.full_turn else None
    if angle is not None:
        return PoseRequest(scene, "angle", float(angle), speed, options.acceleration)
    request = PoseRequest(scene, "phase", float(phase), speed, options.acceleration)
    if options.acceleration and request.swings:
        raise BadInput("--acceleration is the input's own; of an input that swings give --angle with it")
    return request
