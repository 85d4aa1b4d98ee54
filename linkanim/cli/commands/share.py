"""`linkanim share`: a scene as one page that moves in any browser, or all of them as a site."""

from __future__ import annotations

import sys
from argparse import Namespace
from pathlib import Path

from linkanim.cli.options import inputs_of
from linkanim.cli.progress import bar
from linkanim.errors import BadInput
from linkanim.manifest import checked_output
from linkanim.scenes import load, names
from linkanim.scenes.editing import in_unit
from linkanim.share.page import Shared, document
from linkanim.share.site import INDEX, write_site

SUFFIXES = (".html", ".htm")


def run(options: Namespace) -> None:
    """Write the page or pages that were asked for, and print the path to open.

    `BadInput`, before anything is written, for an output that cannot be written, a quantity that the scene
    does not have, and a scene, an output or a chart beside `--all`.
    """
    print(_site(options) if options.all else _page(options))


def _page(options: Namespace) -> Path:
    if options.scene is None:
        raise BadInput("name a scene (`linkanim scenes` lists them), or give --all DIR for all of them")
    usual = f"{Path(options.scene).stem}.html"
    target = checked_output(options.output, usual, SUFFIXES, inputs_of(options))
    page = document(_shared(options, options.scene), _tell)
    with target.replacing() as part:
        part.write_text(page, encoding="utf-8")
    return target.path


def _site(options: Namespace) -> Path:
    of_one = {
        "a scene": options.scene,
        "-o": options.output,
        "--chart": options.chart,
        "--static": options.static,
    }
    for word in filter(of_one.get, of_one):
        raise BadInput(f"--all writes every scene into its folder; leave out {word}, which is for one")
    every = names()
    with bar(unit=" scenes") as progress:
        write_site(options.all, every, _shared(options, every[0]), options.unit, progress, _tell)
    return Path(options.all / INDEX)


def _tell(sentence: str) -> None:
    print(sentence, file=sys.stderr)


def _shared(options: Namespace, scene: str) -> Shared:
    shown = in_unit(load(scene), options.unit)
    shown = shown.without_inertia if options.static else shown
    # pages of a site show the names of joints and links, as their readers cannot ask for these
    names = max(options.names, 1) if options.all else options.names
    return Shared(shown, options.speed, options.theme, options.chart, names)
