"""What `solve` prints for people: aligned columns, angles in degrees, seven digits."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Iterator
from typing import Any

from linkanim.cli.solved import Tree
from linkanim.digits import significant
from linkanim.export import columns
from linkanim.mechanics.facts.register import plain_unit, recorded
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.pins import Pin
from linkanim.mechanics.motion.measures import (
    DAMPER,
    POINT,
    SPRING,
    TRAVELLING,
    TURNING,
    Measure,
    coefficients_of,
)
from linkanim.scenes.scene import Scene


def of_pose(scene: Scene, found: Iterator[Tree]) -> str:
    """Return one pose: where it is, then a table each for joints, bodies, sliders, springs and dampers."""
    pose = next(found)
    where = (
        f"{scene.name}: {scene.title}\n"
        f"{_input(scene, pose)}, phase {_degrees(pose['phase'])} deg, "
        f"speed {_number(pose['speed'])} rad/s, acceleration {_number(pose['acceleration'])} rad/s^2"
    )
    tables = _tables(scene, pose)
    return "\n\n".join([where, *(columns(lines) for lines in tables if len(lines) > 1)])


def _input(scene: Scene, row: Tree) -> str:
    coordinate = scene.linkage.drive.coordinate
    if not coordinate.is_angle:
        return f"{coordinate.name} {_number(row[coordinate.name])} {scene.length_unit}"
    return f"{scene.info.input_name} angle {_degrees(row['angle'])} deg"


def _tables(scene: Scene, pose: Tree) -> Iterator[list[list[str]]]:
    linkage, unit, called = scene.linkage, scene.length_unit, scene.info.link_names
    bodies = pose["bodies"].items()
    coms = [(f"com of {called[name]}", body["com"]) for name, body in bodies if "com" in body]
    points = [*pose["joints"].items(), *coms]
    yield [["joint", *_titles(POINT, unit)], *([name, *_cells(POINT, point)] for name, point in points)]
    turning = (*TURNING, *coefficients_of(linkage, turning=True))
    sliding = (*TRAVELLING, *coefficients_of(linkage, turning=False))
    for title, key, measures in (("body", "angle", turning), ("slider", "travel", sliding)):
        found = [[called[name], *_cells(measures, _flat(body))] for name, body in bodies if key in body]
        yield [[title, *_titles(measures, unit)], *found]
    force = slice(3)  # length, rate and force
    struts = (
        (linkage.springs, SPRING[force], pose["springs"]),
        (linkage.dampers, DAMPER[force], pose["dampers"]),
    )
    elements = [
        [linkage.strut_words(item), *_cells(measures, found[item.name])]
        for items, measures, found in struts
        for item in items
    ]
    yield [["element", *_titles(SPRING[force], unit)], *elements]
    yield [["whole", "value"], *_whole(linkage, unit, pose)]


def _whole(linkage: Linkage, unit: str, pose: Tree) -> Iterator[list[str]]:
    """Yield what is known of the linkage as a whole: words with the unit, and the value."""
    for quantity in recorded(linkage):
        if quantity.path == tuple(quantity.token.split(".")):
            value: Any = pose
            for key in quantity.path:
                value = value[key]
            words = f"{quantity.words} {plain_unit(quantity.unit, unit)}".rstrip()
            yield [words, _degrees(value) if quantity.unit == "rad" else _number(value)]


def _titles(measures: Iterable[Measure], unit: str) -> Iterator[str]:
    """Yield a column's title for each number of the measures: a vector of a point has two."""
    for measure in measures:
        per = plain_unit(measure.unit, unit)
        if measure in POINT:
            letter = measure.heading if measure.order else ""
            yield from (f"{letter}{axis} {per}" for axis in "xy")
        else:
            yield f"{measure.heading} {per}"


def _cells(measures: Iterable[Measure], known: Tree) -> Iterator[str]:
    for measure in measures:
        value = known[measure.key]
        if isinstance(value, list):
            yield from map(_number, value)
        elif measure.name == "force" and math.isnan(value):
            yield "not given"
        else:
            yield _degrees(value) if measure.unit == "rad" else _number(value)


def _flat(body: Tree) -> Tree:
    """Return a body's tree with its two coefficients under their own keys."""
    return {**body, **dict(zip("12", body["coefficients"], strict=True))}


def of_sweep(scene: Scene, found: Iterator[Tree]) -> str:
    """Return a row for each input: moving joints, bodies' angles in degrees, sliders' travel."""
    fixed = {joint.name for joint in scene.linkage.joints if isinstance(joint, Pin)}
    lines = [list(_sweep_cells(row, fixed, scene)) for row in found]
    titles = [title for title, _ in lines[0]]
    return columns([titles, *([cell for _, cell in line] for line in lines)])


def _sweep_cells(row: Tree, fixed: Container[str], scene: Scene) -> Iterator[tuple[str, str]]:
    """Yield (title, cell) along a row."""
    unit, called = scene.length_unit, scene.info.link_names
    if "travel" in row:
        yield f"travel {unit}", _number(row["travel"])
    else:
        yield "angle deg", _degrees(row["angle"])
    yield "phase deg", _degrees(row["phase"])
    for name, joint in row["joints"].items():
        if name not in fixed:
            x, y = joint["position"]
            yield f"{name}.x {unit}", _number(x)
            yield f"{name}.y {unit}", _number(y)
    for name, body in row["bodies"].items():
        if "travel" in body:
            yield f"{called[name]} {unit}", _number(body["travel"])
        else:
            yield f"{called[name]} deg", _degrees(body["angle"])


def _number(value: float) -> str:
    return significant(value, 7)


def _degrees(value: float) -> str:
    return _number(math.degrees(value))
