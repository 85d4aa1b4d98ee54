"""`linkanim make`: a scene as parts that can be cut, pinned together, and turn."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path

from linkanim.cli.letters import tell, tell_of_picture
from linkanim.cli.options import inputs_of
from linkanim.cli.picture_options import refuse_photograph
from linkanim.cli.progress import bar
from linkanim.errors import BadInput
from linkanim.export import json_text
from linkanim.letters import CUT_OUT
from linkanim.manifest import checked_output
from linkanim.paper.write import OF_A_FIGURE
from linkanim.paper.write import write as write_picture
from linkanim.scenes import load
from linkanim.workshop.drawing import preview
from linkanim.workshop.files import SHEET, write
from linkanim.workshop.request import make

_HANDED_ON = ("way", "bar", "hole", "thickness", "clearance", "gap", "kerf", "sheet", "fit", "bridge")
"""Options that have the same name here and as keywords of the function."""
_IN_THE_WINDOW = Path()
"""The value of `--preview` without a picture's name."""


def run(options: Namespace) -> None:
    """Write the parts, draw their layers, print all numbers, or show the layers in the window.

    BadInput for sizes that make no sense, and for a linkage that cannot be made flat; with `--json` alone the
    printed object says so instead.
    """
    if options.output is None and options.preview is None and not options.json:
        raise BadInput("name a folder for the parts (-o FOLDER), take --preview to see them, or --json")
    if options.preview == _IN_THE_WINDOW:
        if options.output is not None or options.json:
            raise BadInput(
                "--preview without a picture's name opens the window; leave out -o and --json there"
            )
        from linkanim.play.arcade import Arcade
        from linkanim.ui.window import run as play

        play(options.scene, keeper=Arcade(), layers=list(_words(options)))
        return
    picture = options.preview and checked_output(options.preview, "", OF_A_FIGURE, inputs_of(options))
    scene = load(options.scene)
    if picture:
        refuse_photograph(scene, picture.path)
    with bar(unit=" tried") as progress:
        made = make(scene, **{name: getattr(options, name) for name in _HANDED_ON}, progress=progress)
    if made.refused is None:
        if options.output is not None:
            write(made, options.output)
            if made.way == "cardboard":
                labels = (made.label(number) for number in range(len(made.plates)))
                tell(" ".join([scene.title, *labels]), CUT_OUT)
        if picture:
            shown = preview(made)
            write_picture(shown, picture)
            tell_of_picture(shown, picture)
    if options.json:
        print(json_text(made.as_object(), indent=2))
    if options.output is None and picture is None:
        return
    if made.refused is not None:
        raise BadInput(made.refused)
    if not options.json:
        if options.output is not None:
            print(options.output / SHEET)
        if picture:
            print(picture.path)
        print(f"{len(made.plates)} parts {made.layer_words}, {made.size_words}")
    if not made.fewest:
        print("there may be a way with fewer layers; the search was given up", file=sys.stderr)


def _words(options: Namespace) -> Iterator[str]:
    """Yield the options that were given, as words of a command."""
    for name in _HANDED_ON:
        value = getattr(options, name)
        if isinstance(value, bool) or value is None:
            yield from (f"--{name}",) * bool(value)
        else:
            yield f"--{name}"
            yield "x".join(f"{side:g}" for side in value) if isinstance(value, tuple) else str(value)
