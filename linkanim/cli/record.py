"""`linkanim record`: a scene's true period, or a tape, as a file."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from tqdm import tqdm

from linkanim.cli.presets import DEFAULT, PRESETS
from linkanim.picture.look import Look
from linkanim.recorder import record
from linkanim.scenes import load


def run(options: Namespace) -> None:
    """Record what was asked; print the file's path on stdout, and what it holds on stderr."""
    scene = load(options.scene)
    preset = PRESETS.get(options.preset, DEFAULT)
    with bar(shown=options.progress) as progress:
        recording = record(
            scene,
            options.output or Path(f"{scene.name}{preset.suffix}"),
            size=options.size or preset.size,
            fps=options.fps or preset.fps,
            speed=options.speed,
            periods=options.periods or 1,
            seconds=options.seconds,
            reverse=options.reverse,
            look=look_of(options),
            progress=progress,
        )
    print(recording.summary, file=sys.stderr)
    print(recording.path)


def look_of(options: Namespace) -> Look:
    """Return what the options say is to be shown."""
    return Look(
        theme=options.theme,
        trace=options.trace,
        vectors=options.vectors,
        chart=options.chart,
        hud=options.hud,
        background=not options.transparent,
    )


@contextmanager
def bar(*, shown: bool = False) -> Iterator[Callable[[int, int], None]]:
    """Give a function that is told (frames done, frames in all), and draws a bar of it on stderr.

    Nothing is drawn where stderr is no terminal, unless it is to be `shown` all the same.
    """
    # tqdm takes None for "not on a terminal"
    with tqdm(unit=" frames", leave=False, disable=False if shown else None, file=sys.stderr) as drawn:

        def progress(done: int, total: int) -> None:
            drawn.total = total
            drawn.update(done - drawn.n)

        yield progress
