"""`linkanim solve`: the motion at an angle or a phase, or over a sweep of them."""

from __future__ import annotations

import math
import sys
from argparse import Namespace
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

import numpy as np

from linkanim.atomic_files import checked_target, replacing
from linkanim.bounds import MOST_NUMBERS, MOST_NUMBERS_READ
from linkanim.cli import table
from linkanim.cli.options import EVERY_ANGLE, inputs_of
from linkanim.cli.solved import Leaf, RowBlock, Steps, Tree, blocks, input_key, leaves, rows, tree
from linkanim.digits import significant
from linkanim.errors import BadInput, OutOfRange
from linkanim.export import csv_head, csv_rows, json_text, lines, mapped
from linkanim.mechanics.motion.motion import Motion
from linkanim.scenes import load
from linkanim.scenes.editing.shown_unit import in_unit
from linkanim.scenes.scene import Scene

_NUMBER = "\0"
"""Stands for a number in the text that the rows share: no name holds it."""


@dataclass(frozen=True)
class Inputs:
    """Where to solve: `by` is "angle" (of the crank) or "phase"; one value in radians, or a sweep's steps."""

    by: str
    value: float = 0.0
    steps: Steps | None = None


def run(options: Namespace) -> None:
    """Solve what was asked and print it as words, JSON or CSV.

    `BadInput` for options that do not go together; `OutOfRange` for one angle that cannot be reached.
    In a sweep such an angle has a row of nulls.
    """
    inputs = _inputs(options)
    target = (
        None if options.csv in (None, "-") else checked_target(options.csv, (".csv",), inputs_of(options))
    )
    scene = in_unit(load(options.scene), options.unit)
    speed = scene.linkage.drive.speed if options.speed is None else options.speed
    if inputs.steps is not None:
        _refuse_many(scene, inputs.steps.rows, shown=not (options.csv or options.json))
    found = _blocks(scene, inputs, speed, options.acceleration)
    if options.csv:
        _write_csv(target, inputs.by, found)
        return
    head: Tree = {"scene": scene.name, input_key(scene): None, "phase": None}
    head |= {"time": None} if inputs.steps else {}
    head |= {"speed": speed, "acceleration": options.acceleration, "length_unit": scene.length_unit}
    trees = ({**head, **block.found} for block in found)
    if options.json:
        _print_json(trees, inputs.steps is not None)
    else:
        words = table.of_sweep if inputs.steps else table.of_pose
        print(words(scene, (row for block in trees for row in rows(block))))


def _inputs(options: Namespace) -> Inputs:
    angle, phase = options.angle, options.phase
    every = phase is EVERY_ANGLE
    given = [(by, value) for by, value in (("angle", angle), ("phase", phase)) if value is not None]
    if options.sweep is not None:
        if given and not (every and angle is None):
            raise BadInput("--sweep goes with no other angle; write --phase alone to sweep the phase")
        return Inputs("phase" if every else "angle", steps=Steps.of(*options.sweep))
    if options.csv:
        raise BadInput("--csv is for a sweep; add --sweep 0:360:1, or take --json")
    if every:
        raise BadInput('--phase has no value; write it with its unit, such as --phase "87 deg"')
    if len(given) != 1:
        raise BadInput('say where to solve: one of --angle "87 deg", --phase "87 deg" and --sweep 0:360:1')
    return Inputs(*given[0])


def _refuse_many(scene: Scene, rows: int, *, shown: bool) -> None:
    """Refuse a sweep of more numbers than are written, or shown to be read."""
    numbers = rows * sum(1 for _ in leaves(tree(scene, scene.cycle(1))))
    most, way_out = (
        (MOST_NUMBERS_READ, "write them with --csv or --json, or take a longer step")
        if shown
        else (MOST_NUMBERS, "take a longer step, or sweep it in parts")
    )
    if numbers > most:
        raise BadInput(
            f"--sweep: {rows:,} rows of {scene.name} have {numbers:,} numbers, and {most:,} are the most; "
            f"{way_out}"
        )


def _blocks(scene: Scene, inputs: Inputs, speed: float, acceleration: float) -> Iterator[RowBlock]:
    """Yield what was asked for, row by row in blocks; `OutOfRange` where one angle cannot be reached."""

    def solve(values: Leaf) -> Motion:
        return scene.solve(**{inputs.by: values}, speed=speed, acceleration=acceleration)  # type: ignore[arg-type]

    if inputs.steps is not None:
        yield from blocks(scene, inputs.steps, inputs.by, speed, solve)
        return
    motion = solve(np.array([inputs.value]))
    if any(np.isnan(points).any() for points in motion.position.values()):
        raise _out_of_range(scene, inputs.value)
    where = {input_key(scene): motion.coordinate, "phase": motion.phase, inputs.by: np.array([inputs.value])}
    yield RowBlock(np.degrees([inputs.value]), {**where, **tree(scene, motion)})


def phase_at(scene: Scene, angle: float) -> float:
    """Return the phase at an angle (rad) of the input; OutOfRange where it does not come there."""
    phase = float(scene.solve(angle=angle, derivatives=0).phase)
    if math.isnan(phase):
        raise _out_of_range(scene, angle)
    return phase


def _out_of_range(scene: Scene, angle: float) -> OutOfRange:
    low, high = (f"{significant(math.degrees(limit), 6)} deg" for limit in scene.info.input_range)
    return OutOfRange(
        f"{scene.name}: --angle {significant(math.degrees(angle), 6)} deg cannot be reached; "
        f"the {scene.info.input_name} angle goes from {low} to {high} (--phase runs through both limits)"
    )


def _print_json(trees: Iterator[Tree], sweep: bool) -> None:
    """Print one object, or a list of them with a line for each."""
    objects = (text for block in trees for text in _objects(block))
    if not sweep:
        print(next(objects))
        return
    separator = "["
    for text in objects:
        print(separator, text, sep="", end="")
        separator = ",\n "
    print("]")


def _objects(block: Tree) -> Iterator[str]:
    """Yield each row's tree as JSON: the text that all rows share, and their own numbers in it."""
    marked = json_text(mapped(lambda leaf: _NUMBER if isinstance(leaf, np.ndarray) else leaf, block))
    form = marked.replace("%", "%%").replace(json_text(_NUMBER), "%s")
    columns = [leaf for _, leaf in leaves(block) if isinstance(leaf, np.ndarray)]
    return (form % tuple(line.split(",")) for line in lines(columns))


def _write_csv(target: Path | None, by: str, found: Iterator[RowBlock]) -> None:
    """Write the input in degrees and then every quantity; what is not known is an empty cell."""
    with ExitStack() as stack:
        file: TextIO = sys.stdout
        if target is not None:
            part = stack.enter_context(replacing(target))
            file = stack.enter_context(part.open("w", encoding="utf-8", newline=""))
        for number, block in enumerate(found):
            names, columns = zip(*leaves(block.found), strict=True)
            if number == 0:
                file.write(csv_head([f"{by}_deg", *names]))
            file.write(csv_rows([block.degrees, *columns]))
