"""`linkanim make`: a scene as parts that can be cut, pinned together, and turn."""

from __future__ import annotations

import sys
from argparse import Namespace

from linkanim.errors import BadInput
from linkanim.export import json_text
from linkanim.scenes import load
from linkanim.workshop.files import SHEET, write
from linkanim.workshop.request import make

_HANDED_ON = ("way", "bar", "hole", "thickness", "clearance", "gap", "kerf", "sheet", "fit", "bridge")
"""Options that are called alike here and there."""


def run(options: Namespace) -> None:
    """Write the parts and print the path of the sheet, or print all numbers.

    BadInput for sizes that make no sense, and for a linkage that cannot be made flat: with `--json` alone the
    object says so.
    """
    if options.output is None and not options.json:
        raise BadInput("name a folder for the parts (-o FOLDER), or take --json")
    made = make(load(options.scene), **{name: getattr(options, name) for name in _HANDED_ON})
    if options.output is not None and made.refused is None:
        write(made, options.output)
    if options.json:
        print(json_text(made.as_object(), indent=2))
    if options.output is None:
        return
    if made.refused is not None:
        raise BadInput(made.refused)
    if not options.json:
        print(options.output / SHEET)
        print(f"{len(made.plates)} parts in {made.layers} layers on the ground, {made.size_words}")
    if not made.fewest:
        print("there may be a way with fewer layers; the search was given up", file=sys.stderr)
