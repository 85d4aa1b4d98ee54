"""`linkanim solve`: the motion at an angle or a phase, or over a sweep of them."""

from __future__ import annotations

import csv
import math
import sys
from argparse import Namespace
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

import numpy as np

from linkanim import units
from linkanim.cli import table
from linkanim.cli.commands import EVERY_ANGLE
from linkanim.cli.strict import finite, json_text
from linkanim.cli.tree import BLOCK, Leaf, Tree, leaves, rows, tree
from linkanim.digits import significant
from linkanim.errors import BadInput, OutOfRange
from linkanim.mechanics.motion import Motion
from linkanim.scenes import load
from linkanim.scenes.scene import Scene
from linkanim.whole import checked_target, replacing


@dataclass(frozen=True)
class Asked:
    """Where to solve: `by` is "angle" (of the crank) or "phase"; one value, or those of a sweep."""

    by: str
    degrees: tuple[float, ...]
    radians: tuple[float, ...]
    sweep: bool


def run(options: Namespace) -> None:
    """Solve what was asked and print it as words, JSON or CSV.

    `BadInput` for options that do not go together; `OutOfRange` for one angle that cannot be reached.
    In a sweep such an angle has a row of nulls.
    """
    asked = _asked(options)
    target = _target(options.csv)
    scene = load(options.scene)
    speed = scene.linkage.drive.speed if options.speed is None else options.speed
    motion = _solved(scene, asked, speed, options.acceleration)
    head = {"scene": scene.name, "angle": None, "phase": None, "speed": speed}
    head |= {"acceleration": options.acceleration, "length_unit": scene.length_unit}
    found = _found(scene, motion, asked)
    poses = ({**head, **row} for row in rows(found, len(asked.radians)))
    if options.csv:
        _write_csv(target, asked, found)
    elif options.json:
        _print_json(poses, asked.sweep)
    else:
        words = table.of_sweep if asked.sweep else table.of_pose
        print(words(scene, poses))


def _asked(options: Namespace) -> Asked:
    sweep, angle, phase = options.sweep, options.angle, options.phase
    if sweep is None:
        return _one(angle, phase, options.csv)
    if angle is not None or phase not in (None, EVERY_ANGLE):
        raise BadInput("--sweep goes with no other angle; write --phase alone to sweep the phase")
    degrees = tuple(sweep.degrees())
    radians = tuple(units.angle(f"{value!r} deg") for value in degrees)
    return Asked("phase" if phase is EVERY_ANGLE else "angle", degrees, radians, sweep=True)


def _one(angle: float | None, phase: float | None, csv_name: str | None) -> Asked:
    if csv_name:
        raise BadInput("--csv is for a sweep; add --sweep 0:360:1, or take --json")
    if phase is EVERY_ANGLE:
        raise BadInput('--phase has no value; write it with its unit, such as --phase "87 deg"')
    given = [(by, value) for by, value in (("angle", angle), ("phase", phase)) if value is not None]
    if len(given) != 1:
        raise BadInput('say where to solve: one of --angle "87 deg", --phase "87 deg" and --sweep 0:360:1')
    by, value = given[0]
    return Asked(by, (math.degrees(value),), (value,), sweep=False)


def _solved(scene: Scene, asked: Asked, speed: float, acceleration: float) -> Motion:
    """Solve for all inputs at once; `OutOfRange` where there is one only and it cannot be reached."""
    inputs = np.array(asked.radians)
    if asked.by == "phase":
        return scene.solve(phase=inputs, speed=speed, acceleration=acceleration)
    motion = scene.solve(angle=inputs, speed=speed, acceleration=acceleration)
    if not asked.sweep and any(np.isnan(points).any() for points in motion.position.values()):
        low, high = (f"{significant(math.degrees(limit), 6)} deg" for limit in scene.info.input_range)
        raise OutOfRange(
            f"{scene.name}: --angle {significant(asked.degrees[0], 6)} deg cannot be reached; "
            f"the crank angle goes from {low} to {high} (--phase runs through both limits)"
        )
    return motion


def _found(scene: Scene, motion: Motion, asked: Asked) -> Tree:
    """Return what is known at each input; the input is as it was asked, also where nothing else is."""
    where = {"angle": motion.crank_angle, "phase": motion.phase, asked.by: np.array(asked.radians)}
    return {**where, **tree(scene, motion)}


def _print_json(objects: Iterator[Tree], sweep: bool) -> None:
    """Print one object, or a list of them with a line for each."""
    if not sweep:
        print(json_text(next(objects)))
        return
    separator = "["
    for found in objects:
        print(separator, json_text(found), sep="", end="")
        separator = ",\n "
    print("]")


def _target(name: str | None) -> Path | None:
    """Return the CSV file to write, None for stdout; `BadInput` where it could not be written."""
    return None if name in (None, "-") else checked_target(str(name), (".csv",))


def _write_csv(target: Path | None, asked: Asked, found: Tree) -> None:
    if target is None:
        _csv_rows(sys.stdout, asked, found)
        return
    with replacing(target) as part, part.open("w", encoding="utf-8", newline="") as file:
        _csv_rows(file, asked, found)


def _csv_rows(file: TextIO, asked: Asked, found: Tree) -> None:
    """Write the input in degrees and then every quantity; what is not known is an empty cell."""
    names, columns = zip(*leaves(found), strict=True)
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow([f"{asked.by}_deg", *names])
    for start in range(0, len(asked.degrees), BLOCK):
        part = slice(start, start + BLOCK)
        writer.writerows(zip(asked.degrees[part], *(_cells(column[part]) for column in columns), strict=True))


def _cells(column: Leaf) -> list[object]:
    values = column.tolist()
    return values if np.isfinite(column).all() else [finite(value) for value in values]
