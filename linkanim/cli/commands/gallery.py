"""`linkanim gallery`: every scene as a small GIF, and all of them on one sheet."""

from __future__ import annotations

import sys
from argparse import Namespace
from pathlib import Path

from tqdm import tqdm

from linkanim.cli.progress import advance
from linkanim.recorder.gallery import make_gallery
from linkanim.recorder.recording import Progress, Recording
from linkanim.scenes import names


def run(options: Namespace) -> None:
    """Record every built-in scene and draw the sheet; print each file's path.

    `BadInput` before any work where one of their names is taken by a file that is not ours.
    """
    recordings, sheet = _recorded(options.into)
    for recording in recordings:
        print(recording.path)
    print(sheet)


def _recorded(into: Path) -> tuple[tuple[Recording, ...], Path]:
    with tqdm(unit=" frames", leave=False, disable=None, file=sys.stderr) as drawn:

        def watch(name: str) -> Progress:
            drawn.reset()
            drawn.set_description(name)
            return lambda done, total: advance(drawn, done, total)

        return make_gallery(into, names(), watch)
