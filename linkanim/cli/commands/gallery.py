"""`linkanim gallery`: every scene as a small GIF, all of them on one sheet, and the chart of `bench`."""

from __future__ import annotations

import sys
from argparse import Namespace
from pathlib import Path

from tqdm import tqdm

from linkanim.bench.command import CHART, require_extra
from linkanim.cli.commands.record import advance, bar
from linkanim.errors import BadInput
from linkanim.manifest import single
from linkanim.recorder.gallery import Gallery, make_gallery
from linkanim.recorder.recording import Progress
from linkanim.scenes import names


def run(options: Namespace) -> None:
    """Record every built-in scene, draw the sheet and the chart; print each file's path.

    `BadInput` before any work where one of their names is taken by a file that is not ours.
    Without the packages that `bench` compares with, the chart is left as it is, and that is said on stderr.
    """
    chart = options.into / CHART
    missing = _missing()
    if not missing:
        single(chart).refuse_foreign([CHART])
    made = _recorded(options.into)
    for recording in made.recordings:
        print(recording.path)
    print(made.sheet, flush=True)
    if missing:
        print(f"{chart} is left as it is: {missing}", file=sys.stderr)
    else:
        print(_charted(chart))


def _missing() -> str:
    """Return what is not installed for the chart, in a sentence; nothing where it can be drawn."""
    try:
        require_extra()
    except BadInput as missing:
        return str(missing)
    return ""


def _recorded(into: Path) -> Gallery:
    with tqdm(unit=" frames", leave=False, disable=None, file=sys.stderr) as drawn:

        def watch(name: str) -> Progress:
            drawn.reset()
            drawn.set_description(name)
            return lambda done, total: advance(drawn, done, total)

        return make_gallery(into, names(), watch)


def _charted(path: Path) -> Path:
    """Run the benchmark, for a minute or two, and draw what it found."""
    # What it compares with takes seconds to import, and need not be installed.
    from linkanim.bench import drawing, result

    with bar(unit=" rounds") as progress:
        return drawing.draw(result.run(progress), path)
