"""What `solve` prints for people: aligned columns, angles in degrees, seven digits."""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Mapping, Sequence

from linkanim.cli.tree import Tree
from linkanim.digits import significant
from linkanim.mechanics.linkage import Pin
from linkanim.scenes.scene import Scene


def of_pose(scene: Scene, found: Iterator[Tree]) -> str:
    """Return one pose: where it is, then a table each for joints, bodies, sliders, springs and dampers."""
    pose = next(found)
    where = (
        f"{scene.name}: {scene.title}\n"
        f"crank angle {_degrees(pose['angle'])} deg, phase {_degrees(pose['phase'])} deg, "
        f"speed {_number(pose['speed'])} rad/s, acceleration {_number(pose['acceleration'])} rad/s^2"
    )
    tables = _tables(scene.length_unit, pose)
    return "\n\n".join([where, *(columns(lines) for lines in tables if len(lines) > 1)])


def _tables(unit: str, pose: Tree) -> Iterator[list[list[str]]]:
    bodies = pose["bodies"].items()
    coms = [(f"com of {name}", body["com"]) for name, body in bodies if "com" in body]
    points = [*pose["joints"].items(), *coms]
    yield [_point_titles(unit), *([name, *_point(point)] for name, point in points)]
    yield [_turning_titles(), *([name, *_turning(body)] for name, body in bodies if "angle" in body)]
    yield [_sliding_titles(unit), *([name, *_sliding(body)] for name, body in bodies if "travel" in body)]
    elements = [*_elements("spring", pose["springs"]), *_elements("damper", pose["dampers"])]
    yield [["element", f"length {unit}", f"rate {unit}/s", "force N"], *elements]


def _point_titles(unit: str) -> list[str]:
    quantities = (("", unit), ("v", f"{unit}/s"), ("a", f"{unit}/s^2"))
    return ["joint", *(f"{letter}{axis} {per}" for letter, per in quantities for axis in "xy")]


def _point(point: Tree) -> list[str]:
    return [_number(value) for key in ("position", "velocity", "acceleration") for value in point[key]]


def _turning_titles() -> list[str]:
    return ["body", "angle deg", "omega rad/s", "alpha rad/s^2", "dq/dtheta", "d2q/dtheta2"]


def _turning(body: Tree) -> list[str]:
    rates = (body["angular_velocity"], body["angular_acceleration"], *body["coefficients"])
    return [_degrees(body["angle"]), *map(_number, rates)]


def _sliding_titles(unit: str) -> list[str]:
    rates = [f"v {unit}/s", f"a {unit}/s^2", f"ds/dtheta {unit}", f"d2s/dtheta2 {unit}"]
    return ["slider", f"travel {unit}", *rates]


def _sliding(body: Tree) -> list[str]:
    values = (body["travel"], body["velocity"], body["acceleration"], *body["coefficients"])
    return [_number(value) for value in values]


def _elements(kind: str, elements: Mapping[str, Tree]) -> Iterator[list[str]]:
    for name, element in elements.items():
        force = element["force"]
        known = "not given" if math.isnan(force) else _number(force)
        yield [f"{kind} {name}", _number(element["length"]), _number(element["rate"]), known]


def of_sweep(scene: Scene, found: Iterator[Tree]) -> str:
    """Return a row for each input: moving joints, bodies' angles in degrees, sliders' travel."""
    fixed = {joint.name for joint in scene.linkage.joints if isinstance(joint, Pin)}
    lines = [list(_sweep_cells(row, fixed, scene.length_unit)) for row in found]
    titles = [title for title, _ in lines[0]]
    return columns([titles, *([cell for _, cell in line] for line in lines)])


def _sweep_cells(row: Tree, fixed: Container[str], unit: str) -> Iterator[tuple[str, str]]:
    """Yield (title, cell) along a row."""
    yield "angle deg", _degrees(row["angle"])
    yield "phase deg", _degrees(row["phase"])
    for name, joint in row["joints"].items():
        if name not in fixed:
            x, y = joint["position"]
            yield f"{name}.x {unit}", _number(x)
            yield f"{name}.y {unit}", _number(y)
    for name, body in row["bodies"].items():
        slides = "travel" in body
        yield (
            (f"{name} {unit}", _number(body["travel"]))
            if slides
            else (f"{name} deg", _degrees(body["angle"]))
        )


def columns(lines: Sequence[Sequence[str]]) -> str:
    """Return the lines with their cells below each other, names to the left and numbers to the right."""
    first, *others = [max(map(len, column)) for column in zip(*lines, strict=True)]
    form = "  ".join([f"{{:<{first}}}", *(f"{{:>{width}}}" for width in others)])
    return "\n".join(form.format(*line) for line in lines)


def _number(value: float) -> str:
    return significant(value, 7)


def _degrees(value: float) -> str:
    return _number(math.degrees(value))
