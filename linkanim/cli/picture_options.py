"""The options that commands which write pictures share: which scene, how large, which file, what is shown."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path
from typing import NamedTuple

from linkanim.atomic_files import refuse_input
from linkanim.cli.options import inputs_of
from linkanim.errors import BadInput
from linkanim.manifest import Output, checked_output
from linkanim.mechanics.measures import coupler_body
from linkanim.picture.layout import SMALL, layout
from linkanim.picture.look import FORCE, TOGGLES, Look
from linkanim.picture.purpose import PURPOSES, USUAL_SIZE
from linkanim.recorder.plan import refuse_size
from linkanim.scenes import load
from linkanim.scenes.editing import in_unit, other_closure
from linkanim.scenes.scene import Scene


class Canvas(NamedTuple):
    """What a picture is drawn on: its size in pixels, its width in mm on paper, and whether it has a ground.

    Without a width a pixel is 3/4 pt. Words are `type_scale` times as large as usual.
    """

    size: tuple[int, int]
    wide: float | None = None
    type_scale: float = 1.0
    ground: bool = True


def _canvas(options: Namespace) -> Canvas:
    """Return the canvas for the purpose that the options name; a book's where LaTeX sets the words."""
    name = options.purpose or ("book" if options.text else None)
    if name is None:
        return Canvas(options.size or USUAL_SIZE)
    purpose = PURPOSES[name]
    size = purpose.size(options.size)
    scale = purpose.type_scale(SMALL * layout(size).unit)
    if options.text:
        from linkanim.paper.latex import WIDER

        scale *= WIDER
    return Canvas(size, purpose.wide, scale, purpose.ground)


def scene_canvas_target(
    options: Namespace, suffixes: tuple[str, ...], usual: str
) -> tuple[Scene, Canvas, Output]:
    """Return the scene, what it is drawn on, and the file, by default named after the scene.

    `BadInput` for a size that cannot be drawn or a file that cannot be written.
    """
    target = checked_output(
        options.output, f"{Path(options.scene).stem}{usual}", suffixes, inputs_of(options)
    )
    if options.text:
        from linkanim.paper.latex import refuse_latex

        refuse_latex(target)
    canvas = _canvas(options)
    refuse_size(canvas.size, painted=target.path.suffix.lower() == ".png")
    scene = load(options.scene)
    refuse_photograph(scene, target.path)
    return in_unit(scene, getattr(options, "unit", None)), canvas, target


def refuse_photograph(scene: Scene, target: Path) -> None:
    """Raise `BadInput` for an output that is the photograph of a scene."""
    photo = scene.document.get("photo")
    refuse_input(target, [photo["file"]] if photo else ())


def look_of(scene: Scene, options: Namespace) -> Look:
    """Return what the options say is to be shown of a scene.

    `BadInput` for centrodes where every link turns about a fixed pin, or slides, and for a chart over an
    input's angle where the input swings; for forces where there are none; `AssemblyError` for the other
    closure where there is none.
    """
    look = Look(**{name: value for name, value in vars(options).items() if name in TOGGLES})
    if look.centres > 1 and coupler_body(scene.linkage) is None:
        raise BadInput(f"--centrodes: {scene.name} has no coupler; --instant-centres marks what there is")
    if look.over == "angle" and not scene.info.full_turn:
        raise BadInput(
            f"--over angle: the input of {scene.name} swings; a chart beside it runs over time or phase"
        )
    if FORCE in look.vectors:
        scene.refuse_forceless()
    if look.ghost:
        other_closure(scene)  # which says why where there is none
    return look
