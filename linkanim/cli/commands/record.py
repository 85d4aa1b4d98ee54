"""`linkanim record`: a scene's true period, or a tape, as a file."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import NoReturn

from tqdm import tqdm

from linkanim.cli.command_table import parse
from linkanim.cli.picture_options import centres_of
from linkanim.cli.presets import DEFAULT, PRESETS
from linkanim.errors import BadInput
from linkanim.picture.look import Look
from linkanim.recorder.recording import Progress, Recording
from linkanim.recorder.scene_frames import record
from linkanim.recorder.tape_frames import record_tape
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

_OF_A_SCENE = (
    "speed",
    "periods",
    "seconds",
    "reverse",
    "trace",
    "hud",
    "noted",
    "vectors",
    "names",
    "polygons",
    "instant_centres",
    "centrodes",
    "chart",
    "theme",
    "transparent",
)
"""Options that a tape has its own answer to."""


def run(options: Namespace) -> None:
    """Record what was asked; print the file's path on stdout, and what it holds on stderr."""
    preset = PRESETS.get(options.preset, DEFAULT)
    is_tape = options.scene.lower().endswith(".json")
    target = options.output or Path(f"{_stem(options.scene)}{preset.suffix}")
    frame = {"size": options.size or preset.size, "fps": options.fps or preset.fps}
    with bar(shown=options.progress) as progress:
        work = _of_tape(options) if is_tape else _of_scene(options)
        recording = work(target, **frame, progress=progress)
    print(recording.summary, file=sys.stderr)
    print(recording.path)


def _stem(source: str) -> str:
    """Return the name of a scene, a scene file or a tape without its folder and ending."""
    return Path(source).name.removesuffix(".json").removesuffix(".tape").removesuffix(".toml")


def _of_scene(options: Namespace) -> Callable[..., Recording]:
    scene = load(options.scene)
    return partial(
        record,
        scene,
        speed=options.speed,
        periods=options.periods or 1,
        seconds=options.seconds,
        reverse=options.reverse,
        look=look_of(scene, options),
        noted=options.noted,
    )


def _of_tape(options: Namespace) -> Callable[..., Recording]:
    """Return what records a tape; `BadInput` for an option that the tape has its own answer to."""
    usual = parse(["record", options.scene])
    for name in _OF_A_SCENE:
        if getattr(options, name) != getattr(usual, name):
            option = f"--{'no-' if getattr(options, name) is False else ''}{name.replace('_', '-')}"
            raise BadInput(
                f"{option} is for a scene; a tape keeps its own (--size, --fps and --for are free)"
            )
    return partial(record_tape, options.scene)


def look_of(scene: Scene, options: Namespace) -> Look:
    """Return what the options say is to be shown."""
    return Look(
        theme=options.theme,
        trace=options.trace,
        vectors=options.vectors,
        names=min(options.names, 2),
        polygons=options.polygons,
        centres=centres_of(scene, options),
        chart=options.chart,
        hud=options.hud,
        background=not options.transparent,
    )


@contextmanager
def bar(*, shown: bool = False, unit: str = " frames") -> Iterator[Progress]:
    """Give a function that is told (frames done, frames in all), and draws a bar of it on stderr.

    Nothing is drawn where stderr is no terminal, unless it is to be `shown` all the same.
    """
    # tqdm takes None for "not on a terminal"
    with tqdm(unit=unit, leave=False, disable=False if shown else None, file=sys.stderr) as drawn:
        yield lambda done, total: advance(drawn, done, total)


def advance(drawn: tqdm[NoReturn], done: int, total: int) -> None:
    """Draw a bar at `done` of `total`."""
    drawn.total = total
    drawn.update(done - drawn.n)
