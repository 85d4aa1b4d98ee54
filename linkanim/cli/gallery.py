"""`linkanim gallery`: every scene as a small GIF, and all of them on one sheet."""

from __future__ import annotations

import sys
from argparse import Namespace

from tqdm import tqdm

from linkanim.cli.record import advance
from linkanim.errors import BadInput, WorkFailed
from linkanim.recorder.gallery import make_gallery
from linkanim.recorder.recording import Progress
from linkanim.scenes import names


def run(options: Namespace) -> None:
    """Record every built-in scene and draw the sheet; print each file's path."""
    if not options.into.parent.is_dir():
        raise BadInput(
            f"--into {options.into}: there is no folder {options.into.parent}; make it, or choose another"
        )
    with tqdm(unit=" frames", leave=False, disable=None, file=sys.stderr) as bar:

        def watch(name: str) -> Progress:
            bar.reset()
            bar.set_description(name)
            return lambda done, total: advance(bar, done, total)

        try:
            made = make_gallery(options.into, names(), watch)
        except OSError as error:
            raise WorkFailed(f"--into {options.into}: {error.strerror or error}") from error
    for recording in made.recordings:
        print(recording.path)
    print(made.sheet)
