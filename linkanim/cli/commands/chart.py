"""`linkanim chart`: quantities over one true period, as a picture or a table."""

from __future__ import annotations

import sys
from argparse import Namespace

from linkanim.cli.alternative import alternative
from linkanim.cli.letters import tell_of_picture
from linkanim.cli.picture_options import Canvas, scene_canvas_target
from linkanim.errors import BadInput
from linkanim.manifest import Output
from linkanim.paper.chart import Page
from linkanim.paper.curves import Curves, MeasuredCurve, Pace, comparison, curves_of, read_table, usual_over
from linkanim.paper.latex import labels_of
from linkanim.paper.polar import PolarPage
from linkanim.paper.sentences import without_subscripts
from linkanim.paper.write import OF_A_CHART, write
from linkanim.scenes import load
from linkanim.scenes.editing import in_unit
from linkanim.scenes.scene import Scene
from linkanim.units import rpm, stepped

_LIST = "list"
"""The word that, in the place of a quantity, asks for the list of them."""


def run(options: Namespace) -> None:
    """Write the chart that was asked for; print its path, and how far a table beside it differs.

    For the word `list` print all quantities instead.
    """
    if options.quantity.strip() == _LIST:
        print(_listed(in_unit(load(options.scene), options.unit)))
        return
    scene, canvas, target = scene_canvas_target(options, OF_A_CHART, ".png")
    if options.static:
        scene = scene.without_inertia
    if options.polar:
        _polar(scene, canvas, target, options)
        return
    tokens = tuple(part.strip() for part in options.quantity.split(",") if part.strip())
    curves = curves_of(scene, tokens, paces(scene, options), options.over)
    measured = _measured(curves, options)
    page = Page(
        curves,
        measured,
        size=canvas.size,
        theme=options.theme,
        type_scale=canvas.type_scale,
        ground=canvas.ground,
    )
    told = alternative(options)
    write(page, target, latex=bool(options.text), wide=canvas.wide)
    tell_of_picture(page, target, latex=bool(options.text))
    if measured:
        print(_difference(curves, measured), file=sys.stderr)
    print(target.path)
    if options.text:
        print(labels_of(target).path)
    told(f"{page.title}. {page.words}".strip())


def _polar(scene: Scene, canvas: Canvas, target: Output, options: Namespace) -> None:
    """Write a polar diagram, and print its path."""
    for option in ("over", "data", "label"):
        if getattr(options, option) is not None:
            raise BadInput(f"--{option} does not go with --polar, whose axes are x and y; leave it out")
    page = PolarPage(
        scene,
        options.quantity.strip(),
        paces(scene, options),
        size=canvas.size,
        theme=options.theme,
        type_scale=canvas.type_scale,
        ground=canvas.ground,
    )
    _ = page.known
    told = alternative(options)
    write(page, target, latex=bool(options.text), wide=canvas.wide)
    tell_of_picture(page, target, latex=bool(options.text))
    print(target.path)
    if options.text:
        print(labels_of(target).path)
    told(f"{page.title}. {page.words}".strip())


def _listed(scene: Scene) -> str:
    """Return all quantities of a scene, one a line: the token of each, and its title."""
    wide = max(map(len, scene.quantities))
    titles = {
        token: without_subscripts(one.title(scene.length_unit)) for token, one in scene.quantities.items()
    }
    return "\n".join(f"{token:<{wide}}  {title}" for token, title in titles.items())


def paces(scene: Scene, options: Namespace) -> tuple[Pace, ...]:
    """Return the speeds of the options, the scene's own where there are none."""
    speeds = options.speeds or {rpm(scene.linkage.drive.speed): scene.linkage.drive.speed}
    return tuple(Pace(speed, label) for label, speed in speeds.items())


def _measured(curves: Curves, options: Namespace) -> MeasuredCurve | None:
    if options.data is None:
        if options.label is not None:
            raise BadInput("--label names the table of --data; add --data OTHER.csv")
        return None
    table = read_table(options.data, usual_over(curves), curves.curves[0].quantity)
    return comparison(curves, table, options.label or options.data.stem)


def _difference(curves: Curves, measured: MeasuredCurve) -> str:
    """Return the table of both values, and the largest difference in a line."""
    unit, row = measured.curve.quantity.display_unit(curves.scene.length_unit), measured.worst
    step, place = (0.01, "deg") if measured.over != "time" else (1e-4, "s")
    return (
        f"{measured.table(curves.scene.length_unit)}\n\n"
        f"largest difference of {measured.label} from {measured.curve.quantity.token}: "
        f"{measured.differences[row]:.6g} {unit}".rstrip()
        + f" at {stepped(float(measured.inputs[row]), step)} {place}"
    )
