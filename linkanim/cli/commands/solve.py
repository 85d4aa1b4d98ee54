"""`linkanim solve`: the motion at an angle or a phase, or over a sweep of them.

The results at all solved angles are one tree, which JSON, CSV and the tables read. For people it is printed
as aligned columns, with angles in degrees and seven digits.
"""

from __future__ import annotations

import math
import sys
from argparse import Namespace
from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from contextlib import ExitStack
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache, partial
from itertools import compress, repeat
from pathlib import Path as FilePath
from typing import Any, TextIO

import numpy as np
from numpy.typing import NDArray

from linkanim import units
from linkanim.atomic_files import checked_target, replacing
from linkanim.bounds import MOST_NUMBERS, MOST_NUMBERS_READ
from linkanim.cli.options import EVERY_ANGLE, inputs_of
from linkanim.errors import BadInput, OutOfRange
from linkanim.export import columns, csv_head, csv_rows, json_text, lines, mapped
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Linkage, Pin
from linkanim.mechanics.measures import (
    DAMPER,
    POINT,
    SPRING,
    TRAVELLING,
    TURNING,
    Measure,
    coefficients_of,
    input_place,
)
from linkanim.mechanics.motion import Motion
from linkanim.mechanics.quantities import Path, plain_unit, recorded
from linkanim.scenes import load
from linkanim.scenes.form import TravelSpeed
from linkanim.scenes.scene import Scene
from linkanim.units import significant

# The results at all solved angles, as one tree that JSON, CSV and the tables read.
#
# The tree is that of `solve --json`; its leaves are arrays (N,), a value for each angle. The rows of a sweep
# are solved a block at a time: a long sweep takes no more memory than a short one.

Leaf = NDArray[np.float64]
Tree = dict[str, Any]
BLOCK = 4096
_WHOLE = 2**53
"""Every whole number up to this is exactly a float."""


def input_key(scene: Scene) -> str:
    """Return the key of the input in the tree: its angle, or the travel of a slider that drives."""
    return scene.linkage.drive.coordinate.name


def tree(scene: Scene, motion: Motion) -> Tree:
    """Return every quantity of N poses under its path, in the scene's unit, radians and seconds."""
    result: Tree = {"joints": {}, "bodies": {}, "springs": {}, "dampers": {}}
    for quantity in recorded(scene.linkage):
        _put(result, quantity.path, _leaf(quantity.read(motion), motion))
    return result


def _put(result: Any, path: Path, leaf: Leaf) -> None:
    """Put a leaf at the end of a path, through tables and lists that are made where they are missing."""
    key, *rest = path
    if isinstance(key, int):
        result.append(leaf)
    elif rest:
        _put(result.setdefault(key, [] if isinstance(rest[0], int) else {}), tuple(rest), leaf)
    else:
        result[key] = leaf


def _leaf(value: Any, motion: Motion) -> Leaf:
    """Return a value at every instant (N,), NaN for one that is not known (None)."""
    leaf, shape = np.asarray(np.nan if value is None else value, np.float64), motion.phase.shape
    return leaf if leaf.shape == shape else np.broadcast_to(leaf, shape)


def leaves(node: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """Yield ("joints.B.position.x", leaf), ...: the keys of the path joined by dots.

    The parts of a pair are called x and y, coefficients 1 (the first derivative) and 2.
    """
    if isinstance(node, list):
        ends = "12" if name.endswith("coefficients") else "xy"
        node = dict(zip(ends, node, strict=True))
    if not isinstance(node, Mapping):
        yield name, node
        return
    for key, part in node.items():
        yield from leaves(part, f"{name}.{key}" if name else key)


def rows(node: Tree) -> Iterator[Tree]:
    """Yield the tree of each row, its leaves plain floats; a leaf that is no array is in every row."""
    columns = mapped(lambda leaf: iter(leaf.tolist()) if isinstance(leaf, np.ndarray) else repeat(leaf), node)
    yield from (mapped(next, columns) for _ in node["phase"])


RowBlock = tuple[Leaf, Tree]
"""Neighbouring rows: the inputs in degrees, and the tree of results; leaves are arrays (N,)."""


@frozen
class Steps:
    """The inputs of a sweep, exact: row k is (first + step·k) / scale degrees, in whole numbers."""

    first: int
    step: int
    scale: int
    rows: int

    @staticmethod
    def of(first: Decimal, step: Decimal, rows: int) -> Steps:
        """Return a sweep of decimals, in whole numbers of their smallest common unit."""
        scale = math.lcm(Fraction(first).denominator, Fraction(step).denominator)
        return Steps(int(Fraction(first) * scale), int(Fraction(step) * scale), scale, rows)

    def degrees(self, start: int, stop: int) -> Leaf:
        """Return rows in degrees, each rounded once."""
        return np.array([at / self.scale for at in self._counts(start, stop)])

    def radians(self, start: int, stop: int) -> Leaf:
        """Return rows in radians, as `units.angle` reads them: by the float π, rounded once."""
        counts, last = self._counts(start, stop), self.first + self.step * self.rows
        if max(abs(self.first), abs(last), self.scale) < _WHOLE:
            above, below = (Fraction(math.pi) / (180 * self.scale)).as_integer_ratio()
            return np.array([above * at / below for at in counts])
        return np.array([units.angle(f"{value!r} deg") for value in self.degrees(start, stop).tolist()])

    def _counts(self, start: int, stop: int) -> range:
        return range(self.first + self.step * start, self.first + self.step * stop, self.step)


def blocks(
    scene: Scene, steps: Steps, by: str, speed: float, solve: Callable[[Leaf], Motion]
) -> Iterator[RowBlock]:
    """Yield a sweep's rows; `by` is "angle" or "phase", which runs at `speed` from time 0 in the first row.

    Bodies' angles are continuous from block to block, for which neighbouring blocks share a row.
    """
    start, last = steps.radians(0, 1)[0], None
    for row in range(0, steps.rows, BLOCK):
        shared, stop = int(row > 0), min(row + BLOCK, steps.rows)
        inputs = steps.radians(row - shared, stop)
        motion = solve(inputs)
        time = (inputs - start) / speed if speed else np.full(len(inputs), np.nan)
        place = input_place(motion)
        where = {
            input_key(scene): place,
            "coordinate": place,
            "phase": motion.phase,
            by: inputs,
            "time": time,
        }
        whole = _continued({**where, **tree(scene, motion)}, last)
        last = whole
        yield steps.degrees(row, stop), _without(whole, shared)


def _continued(result: Tree, last: Tree | None) -> Tree:
    """Return rows with angles and directions continuous with the row before, which is their first row."""
    if last is None:
        return result
    for part, name, key in _continued_keys(result):
        known = result[part][name]
        turns = np.rint((last[part][name][key][-1] - known[key][0]) / math.tau)
        known[key] = known[key] + math.tau * np.nan_to_num(turns)
    return result


def _continued_keys(result: Tree) -> Iterator[tuple[str, str, str]]:
    """Yield the places of continuous angles: those of bodies, and the directions of springs and dampers."""
    for part, key in (("bodies", "angle"), ("springs", "direction"), ("dampers", "direction")):
        yield from ((part, name, key) for name, known in result[part].items() if key in known)


def _without(result: Tree, rows: int) -> Tree:
    return mapped(lambda leaf: leaf[rows:], result)  # type: ignore[no-any-return]


# What `solve` prints for people: aligned columns, angles in degrees, seven digits.


def of_pose(scene: Scene, results: Iterator[Tree], *, per: str = "rad") -> str:
    """Return one pose as text: the input, then tables of joints, bodies, sliders, springs and dampers.

    `per` is the unit of what the input's speed is the rate of.
    """
    pose = next(results)
    where = (
        f"{scene.name}: {scene.title}\n"
        f"{_input(scene, pose)}, phase {_degrees(pose['phase'])} deg, "
        f"speed {_number(pose['speed'])} {per}/s, acceleration {_number(pose['acceleration'])} {per}/s^2"
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
        rows = [[called[name], *_cells(measures, _flat(body))] for name, body in bodies if key in body]
        yield [[title, *_titles(measures, unit)], *rows]
    force = slice(3)  # length, rate and force
    struts = (
        (linkage.springs, SPRING[force], pose["springs"]),
        (linkage.dampers, DAMPER[force], pose["dampers"]),
    )
    elements = [
        [linkage.strut_words(item), *_cells(measures, rows[item.name])]
        for items, measures, rows in struts
        for item in items
    ]
    yield [["element", *_titles(SPRING[force], unit)], *elements]
    yield from _forces(pose, called) if linkage.reacting else ()
    yield [["whole", "value"], *_whole(linkage, unit, pose)]


def _forces(pose: Tree, called: Mapping[str, str]) -> Iterator[list[list[str]]]:
    """Yield the tables of the forces in joints, of guides and gears, and on the ground."""
    pulls = [
        [f"{joint} on {called.get(body, body)}", *map(_number, force)]
        for joint, bodies in pose["reactions"].items()
        for body, force in bodies.items()
    ]
    yield [["force", "Fx N", "Fy N"], *pulls]
    guides = [
        [f"guide on {called.get(name, name)}", _number(one["force"]), _number(one["moment"])]
        for name, one in pose.get("guides", {}).items()
    ]
    yield [["guide", "force N", "moment N m"], *guides]
    gears = [
        [
            f"teeth on {name}",
            *(_number(one[key]) if key in one else "-" for key in ("tangential", "radial", "moment")),
        ]
        for name, one in pose.get("gears", {}).items()
    ]
    yield [["gear", "tangential N", "radial N", "moment N m"], *gears]
    ground = pose["ground"]
    yield [["on the ground", "value"]] + [
        [f"{words} {unit}", _number(value)]
        for words, value, unit in (
            ("shaking force x", ground["force"][0], "N"),
            ("shaking force y", ground["force"][1], "N"),
            ("shaking moment", ground["moment"], "N m"),
        )
    ]


def _whole(linkage: Linkage, unit: str, pose: Tree) -> Iterator[list[str]]:
    """Yield the quantities of the whole linkage: words with the unit, and the value."""
    for quantity in recorded(linkage):
        if quantity.path == tuple(quantity.token.split(".")) and quantity.path[0] != "ground":
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


def of_sweep(scene: Scene, results: Iterator[Tree]) -> str:
    """Return a row for each input: moving joints, bodies' angles in degrees, sliders' travel."""
    fixed = {joint.name for joint in scene.linkage.joints if isinstance(joint, Pin)}
    lines = [list(_sweep_cells(row, fixed, scene)) for row in results]
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


# `linkanim solve`: the motion at an angle or a phase, or over a sweep of them.

_NUMBER = "\0"
"""Stands for a number in the text that the rows share: no name contains it."""


@frozen
class Inputs:
    """Where to solve: `by` is "angle" (of the crank), "phase", "travel" or "coordinate".

    There is one value, in radians or as a text, or a sweep's steps.
    """

    by: str
    value: float | str = 0.0
    steps: Steps | None = None

    def of(self, scene: Scene) -> Inputs:
        """Return the inputs with a text read: a travel in the scene's unit, or the crank's angle."""
        if not isinstance(self.value, str):
            return self
        if self.by == "coordinate" and scene.linkage.drive.coordinate.is_angle:
            return Inputs("angle", units.angle(self.value))
        return Inputs("travel", units.length(self.value, unit=scene.length_unit))


def run(options: Namespace) -> None:
    """Solve what was asked and print it as words, JSON or CSV.

    `BadInput` for options that do not go together; `OutOfRange` for one angle that cannot be reached.
    In a sweep such an angle has a row of nulls.
    """
    inputs = _inputs(options)
    target = (
        None if options.csv in (None, "-") else checked_target(options.csv, (".csv",), inputs_of(options))
    )
    scene = load(options.scene)
    if options.unit:
        from linkanim.scenes.editing import in_unit

        scene = in_unit(scene, options.unit)
    if options.static:
        scene = scene.without_inertia
    speed = scene.linkage.drive.speed if options.speed is None else options.speed
    inputs = inputs.of(scene)
    if isinstance(speed, TravelSpeed):
        if inputs.by != "travel":
            raise BadInput(
                "--speed: is a speed along a line, which goes with --travel of a slider that drives"
            )
        speed = speed.metres / units.metre(scene.length_unit)
    if inputs.steps is not None:
        _refuse_many(scene, inputs.steps.rows, shown=not (options.csv or options.json))
    asked = inputs.by == "travel" and options.speed is not None
    results = _blocks(scene, inputs, speed if inputs.by != "travel" or asked else None, options.acceleration)
    if inputs.steps is not None and inputs.steps.rows > BLOCK and not _is_printing(options, target):
        from linkanim.cli.progress import along

        results = along(results, " blocks", -(-inputs.steps.rows // BLOCK))
    if options.csv:
        _write_csv(target, inputs.by, results)
        return
    key = input_key(scene)
    head: Tree = {
        "scene": scene.name,
        key: None,
        **({"coordinate": None} if options.json else {}),
        "phase": None,
    }
    head |= {"time": None} if inputs.steps else {}
    head |= {"speed": speed, "acceleration": options.acceleration, "length_unit": scene.length_unit}
    trees = ({**head, **block} for _, block in results)
    if options.json:
        _print_json(({**one, "coordinate": one[key]} for one in trees), inputs.steps is not None)
    else:
        per = scene.length_unit if asked else "rad"
        words = of_sweep if inputs.steps else partial(of_pose, per=per)
        print(words(scene, (row for block in trees for row in rows(block))))


def _is_printing(options: Namespace, target: FilePath | None) -> bool:
    """Return whether rows are seen on a terminal as they come."""
    return target is None and bool(options.csv or options.json) and sys.stdout.isatty()


def _inputs(options: Namespace) -> Inputs:
    angle, phase = options.angle, options.phase
    every = phase is EVERY_ANGLE
    ways = (
        ("angle", angle),
        ("phase", phase),
        ("travel", options.travel),
        ("coordinate", options.coordinate),
    )
    given = [(by, value) for by, value in ways if value is not None]
    if options.sweep is not None:
        if given and not (every and angle is None):
            raise BadInput("--sweep goes with no other angle; write --phase alone to sweep the phase")
        return Inputs("phase" if every else "angle", steps=Steps.of(*options.sweep))
    if options.csv:
        raise BadInput("--csv is for a sweep; add --sweep 0:360:1, or take --json")
    if every:
        raise BadInput('--phase has no value; write it with its unit, such as --phase "87 deg"')
    if len(given) != 1:
        raise BadInput(
            'say where to solve: one of --angle "87 deg", --phase "87 deg", --travel "28 cm" and'
            " --sweep 0:360:1"
        )
    return Inputs(*given[0])


def _refuse_many(scene: Scene, rows: int, *, shown: bool) -> None:
    """Refuse a sweep of more numbers than can be written, or printed as a table."""
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


def _blocks(scene: Scene, inputs: Inputs, speed: float | None, acceleration: float) -> Iterator[RowBlock]:
    """Yield the rows in blocks; `OutOfRange` for a single angle that cannot be reached."""

    def solve(values: Leaf) -> Motion:
        return scene.solve(**{inputs.by: values}, speed=speed, acceleration=acceleration)  # type: ignore[arg-type]

    if inputs.steps is not None:
        assert speed is not None
        yield from blocks(scene, inputs.steps, inputs.by, speed, solve)
        return
    at = float(inputs.value)
    value = np.array([at])
    motion = solve(value)
    if any(np.isnan(points).any() for points in motion.position.values()):
        raise _out_of_range(scene, at) if inputs.by != "travel" else _out_of_travel(scene, at)
    where = {input_key(scene): input_place(motion), "phase": motion.phase, inputs.by: value}
    yield np.degrees(value), {**where, **tree(scene, motion)}


def phase_at(scene: Scene, angle: float) -> float:
    """Return the phase (rad) at an angle (rad) of the input; OutOfRange where it does not reach that."""
    phase = float(scene.solve(angle=angle, derivatives=0).phase)
    if math.isnan(phase):
        raise _out_of_range(scene, angle)
    return phase


def _out_of_range(scene: Scene, angle: float) -> OutOfRange:
    reach = scene.info.ranges("from {} to {}", _in_degrees)
    through = all(scene.mechanism.stops) and not any(scene.mechanism.keeps)
    way_on = " (--phase runs through both limits)" if through else ""
    return OutOfRange(
        f"{scene.name}: --angle {_in_degrees(angle)} cannot be reached; "
        f"the {scene.info.input_name} angle goes {reach}{way_on}"
    )


def _out_of_travel(scene: Scene, travel: float) -> OutOfRange:
    low, high = (significant(end, 6) for end in scene.info.input_range)
    told, unit = significant(travel, 6), scene.length_unit
    return OutOfRange(
        f"{scene.name}: --travel {told} {unit} cannot be reached; the slider goes from {low} to {high} {unit}"
    )


def _in_degrees(angle: float) -> str:
    return f"{significant(math.degrees(angle), 6)} deg"


def _print_json(trees: Iterator[Tree], sweep: bool) -> None:
    """Print one object, or a list of them with a line for each."""
    objects = (text for block in trees for text in json_rows(block))
    if not sweep:
        print(next(objects))
        return
    separator = "["
    for text in objects:
        print(separator, text, sep="", end="")
        separator = ",\n "
    print("]")


def json_rows(block: Tree) -> Iterator[str]:
    """Yield each row's tree as JSON: a text that many rows share, and their own numbers in it.

    What has no value in a row is left out of it; in a row that cannot be reached every number is null.
    """
    columns = [leaf for _, leaf in leaves(block) if isinstance(leaf, np.ndarray)]
    known = ~np.isnan(np.stack(columns, axis=1)) | np.isnan(block["phase"])[:, None]
    form = lru_cache(maxsize=64)(partial(_form, block))
    for line, told in zip(lines(columns), known, strict=True):
        yield form(told.tobytes()) % tuple(compress(line.split(","), told.tolist()))


def _form(block: Tree, told: bytes) -> str:
    """Return the JSON of rows with %s for each number; `told` says for each leaf whether the rows have it."""
    has = iter(told)

    def marked(node: Any) -> Any:
        if isinstance(node, list):
            parts = [marked(part) for part in node]
            return parts if any(part is not None for part in parts) else None
        if isinstance(node, Mapping):
            return {key: part for key, one in node.items() if (part := marked(one)) is not None}
        return node if not isinstance(node, np.ndarray) else _NUMBER if next(has) else None

    return json_text(marked(block)).replace("%", "%%").replace(json_text(_NUMBER), "%s")


def _write_csv(target: FilePath | None, by: str, results: Iterator[RowBlock]) -> None:
    """Write the input in degrees and then every quantity; what has no value is an empty cell."""
    with ExitStack() as stack:
        file: TextIO = sys.stdout
        if target is not None:
            part = stack.enter_context(replacing(target))
            file = stack.enter_context(part.open("w", encoding="utf-8", newline=""))
        for number, (degrees, result) in enumerate(results):
            names, columns = zip(*leaves(result), strict=True)
            if number == 0:
                file.write(csv_head([f"{by}_deg", *names]))
            file.write(csv_rows([degrees, *columns]))
