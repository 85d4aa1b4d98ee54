"""Solve a scene with many lengths in one call: one linkage a row, each at a phase of its own.

A length is called by its key in the scene's file, "joints.B.length.0", or by that without the table's name,
"crank" or "B.length.0"; a bar also by its body, "coupler". The lengths of which a linkage is made follow
linearly from these: by how much is found by reading the file again with other values.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import field
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from linkanim.errors import AssemblyError, BadInput, LinkanimError
from linkanim.frozen import frozen
from linkanim.intake import meant
from linkanim.mechanics.arithmetic import Value
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.many import LinkageForm, has_form
from linkanim.mechanics.measures import DERIVATIVE_OF, NUMBERS, VECTORS, between, direction
from linkanim.mechanics.motion import Pose, ResultPlaces, arrays, laid_out, read_only
from linkanim.mechanics.program import Array, Bools
from linkanim.scenes.editing import Number, dimensions, numbers, with_dimensions, with_values
from linkanim.scenes.files import load
from linkanim.scenes.form import LENGTHS, Key
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene, check_derivatives, given_numbers
from linkanim.units import shown

SMALLEST = 1e-30
"""A smaller length is read by itself, as a file's is: it is none, or refused."""
LINEAR = 1e-12
"""Share of a linkage's extent by which a length may miss the straight line through two others."""
Columns = Mapping[str, Array]


@frozen(eq=False)
class Many:
    """Many linkages of one form, each at a phase: vectors by name are arrays (N, 2), numbers (N,).

    The attributes are those of a motion. What was not asked for is empty, and what has no pose is NaN.
    """

    scene: Scene
    phase: Array
    position: Columns = field(default_factory=dict)
    velocity: Columns = field(default_factory=dict)
    acceleration: Columns = field(default_factory=dict)
    com_position: Columns = field(default_factory=dict)
    com_velocity: Columns = field(default_factory=dict)
    com_acceleration: Columns = field(default_factory=dict)
    angular_velocity: Columns = field(default_factory=dict)
    angular_acceleration: Columns = field(default_factory=dict)
    travel: Columns = field(default_factory=dict)
    travel_velocity: Columns = field(default_factory=dict)
    travel_acceleration: Columns = field(default_factory=dict)

    @property
    def angle(self) -> Columns:
        """Each body's angle, first -> second joint, at most half a turn (rad)."""
        ends = {
            body.name: (body.joints[0], body.joints[1])
            for body in self.scene.linkage.bodies
            if body.slider is None
        }
        return {name: direction(between(self.position, pair)) for name, pair in ends.items()}


def solve_many(
    scene: Scene | str,
    lengths: Mapping[str, ArrayLike],
    phase: ArrayLike = 0.0,
    *,
    speed: float | None = None,
    acceleration: float = 0.0,
    derivatives: int = 0,
) -> Many:
    """Solve many linkages of a scene's form in one call: one a row, each at a phase of its own.

    `lengths` gives some of the scene's lengths, in its unit: for each name, such as "crank", "coupler" or
    "B.length.0", numbers (N,), or one for all; the others, all of them for {}, stay as they are. `phase`
    (rad) is (N,), or one for all. A row is what the scene with these lengths gives at that phase; NaN
    where they cannot be put together. `derivatives` 0, 1 or 2 says how much is worked out, `speed`
    (rad/s) and `acceleration` (rad/s²) how the phase runs; the scene's own speed where none is given. A
    linkage at a change point, or whose input a dyad down the chain limits, takes as long as reading its
    file. BadInput, with all names, for an unknown one, and for anything but numbers.
    """
    scene = load(scene) if isinstance(scene, str) else scene
    check_derivatives(derivatives)
    chosen = [_number(scene, name) for name in lengths]
    given = [given_numbers(name, of, "solve_many") for name, of in (*lengths.items(), ("phase", phase))]
    count = max(one.size for one in given)
    if any(one.ndim > 1 or one.size not in (1, count) for one in given) or not count:
        sizes = ", ".join(f"{name} {one.shape}" for name, one in zip((*lengths, "phase"), given, strict=True))
        raise BadInput(f"solve_many({sizes}): give each N numbers, or one for all")
    *rows, phases = (one if one.shape == (count,) else np.repeat(one.ravel(), count) for one in given)
    scene.check_turns("phase", phases)
    w, a = scene.linkage.drive.speed if speed is None else float(speed), float(acceleration)
    if not chosen:
        motion = scene.solve(phase=phases, speed=w, acceleration=a, derivatives=derivatives)
        return Many(scene, phases, **{kind: getattr(motion, kind) for kind in (*VECTORS, *NUMBERS)})
    places, results_of, unsolved = _together(scene, chosen, rows, phases, (w, a), derivatives)
    pose = partial(Scene.pose, derivatives=derivatives, speed=w, acceleration=a)
    read: dict[tuple[float, ...], Scene | None] = {}
    for n in np.flatnonzero(unsolved):
        own = tuple(float(row[n]) for row in rows)
        if own not in read:
            read[own] = _with(scene, {number.key: value for number, value in zip(chosen, own, strict=True)})
        if (one := read[own]) is None:
            continue
        alone = pose(one, float(phases[n]))
        for kind, there in places.places.items():
            for name in (name for name, place in there.items() if isinstance(place, int)):
                results_of[kind][name][n] = getattr(alone, kind)[name]
    for values in results_of.values():
        read_only(tuple(values.values()))
    return Many(scene, phases, **results_of)


def _together(
    scene: Scene,
    chosen: Sequence[Number],
    rows: Sequence[Array],
    phases: Array,
    rates: tuple[float, float],
    derivatives: int,
) -> tuple[ResultPlaces, dict[str, dict[str, Array]], Bools]:
    """Return where results lie, the results by kind and name, and which rows (N,) are left to themselves.

    These are NaN.
    """
    form = _form(scene, tuple(number.key for number in chosen))
    places, results, unsolved = form.solved(rows, phases, rates, derivatives)
    for number, row in zip(chosen, rows, strict=True):
        if number.type.measure == "length" and not row.min() > SMALLEST:
            unsolved |= ~(row > SMALLEST)
    if places is None:
        pose = scene.pose(0.0, derivatives, speed=rates[0], acceleration=rates[1])
        places, rows_of = _layout_of(pose, derivatives)
        results = np.full((rows_of, len(phases)), np.nan)
    results[:, unsolved] = np.nan
    return places, {kind: arrays(places, results, (len(phases),), kind) for kind in places.places}, unsolved


def solved_alike(scene: Scene, lengths: Mapping[str, Array], phases: Array) -> Many:
    """Return the positions of linkages with these lengths (N,), each at its phase.

    NaN for one that cannot be solved together with the scene's own.
    """
    chosen = [_number(scene, name) for name in lengths]
    _, results, _ = _together(scene, chosen, [*lengths.values()], phases, (1.0, 0.0), 0)
    return Many(scene, phases, **results)


def _with(scene: Scene, values: Mapping[Key, float]) -> Scene | None:
    """Return a scene with other lengths; None where it cannot be put together."""
    with suppress(LinkanimError):
        return with_dimensions(scene, values)
    return None


def _layout_of(pose: Pose, derivatives: int) -> tuple[ResultPlaces, int]:
    """Return where the quantities of a pose lie in rows, and how many rows these are."""
    rows = {}
    for kind in (*VECTORS, *NUMBERS):
        if DERIVATIVE_OF[kind] <= derivatives:
            rows[kind] = {n: of if isinstance(of, tuple) else (of,) for n, of in getattr(pose, kind).items()}
    layout, outputs = laid_out(rows, {})
    return layout, len(outputs)


def _number(scene: Scene, name: str) -> Number:
    """Return the number that a name calls; BadInput, with all names, where it calls none."""
    known = named_lengths(scene)
    if name in known:
        return known[name]
    listed = dict.fromkeys(".".join(map(str, number.key[1:])) for number in known.values())
    raise BadInput(
        f"solve_many: {scene.name} has no length {shown(name)}{meant(name, known)};"
        f" it has {', '.join(listed)}"
    )


def solved_together(scene: Scene, names: Sequence[str]) -> bool:
    """Return whether linkages with nearly these values of their lengths are solved many at a time."""
    keys = tuple(named_lengths(scene)[name].key for name in names)
    values, form = {one.key: one.value for one in dimensions(scene)}, _form(scene, keys)
    own = [np.array([float(values[key])]) for key in keys]
    return bool(own) and form.uniform and not form.solved(own, np.zeros(1), (1.0, 0.0), 0)[2].any()


def named_lengths(scene: Scene) -> Mapping[str, Number]:
    """Map what a length may be called to its number in the scene's document; it is cached."""
    kept: dict[str, Any] = vars(scene)
    if "_lengths" not in kept:
        kept["_lengths"] = _named(scene)
    return kept["_lengths"]  # type: ignore[no-any-return]


def _named(scene: Scene) -> dict[str, Number]:
    """Return the names that are one number's only."""
    by_name: dict[str, list[Number]] = {}
    for number in numbers(scene.document):
        if number.type.measure in LENGTHS:
            called = [".".join(map(str, key)) for key in (number.key[1:], number.key)]
            if number.field.drag == "distance":
                ends = set(number.ends(scene))
                called += [body.name for body in scene.linkage.bodies if ends <= set(body.joints)]
            for name in dict.fromkeys(called):
                by_name.setdefault(name, []).append(number)
    return {name: several[0] for name, several in by_name.items() if len(several) == 1}


def _form(scene: Scene, keys: tuple[Key, ...]) -> LinkageForm:
    """Return the form of a scene's linkages with other values of some lengths; it is cached."""
    forms: dict[tuple[Key, ...], LinkageForm] = vars(scene).setdefault("_forms", {})
    if keys not in forms:
        own = {one.key: one.value for one in dimensions(scene)}
        usual = tuple(own[key] for key in keys)
        made = _made(scene, keys, usual) if has_form(scene.linkage) else None
        forms[keys] = LinkageForm(scene.linkage, made, usual)
    return forms[keys]


def _made(
    scene: Scene, keys: tuple[Key, ...], usual: tuple[float, ...]
) -> Callable[[Sequence[Value]], Linkage] | None:
    """Return the linkage of a scene as a function of some of its lengths; None where it is not linear."""
    linkage = scene.linkage
    start, step = np.array(linkage.all_lengths), linkage.extent / 8
    rest = start.copy()
    parts: list[list[tuple[int, float]]] = [[] for _ in start]
    for n, (key, value) in enumerate(zip(keys, usual, strict=True)):
        one = _lengths_with(scene, {key: value + step})
        if one is None:
            return None
        for place in np.flatnonzero(one != start):
            same = start[place] == value and one[place] == value + step
            along = value != 0 and abs(start[place] / value * (value + step) - one[place]) <= LINEAR * step
            slope = 1.0 if same else start[place] / value if along else (one[place] - start[place]) / step
            rest[place] = 0.0 if same or along else rest[place] - slope * value
            parts[place].append((n, float(slope)))
    others = [value + step / (n + 2) for n, value in enumerate(usual)]
    every = _lengths_with(scene, dict(zip(keys, others, strict=True)))
    linear = [
        sum(others[n] * slope for n, slope in part) + fixed for part, fixed in zip(parts, rest, strict=True)
    ]
    if every is None or np.abs(every - linear).max() > LINEAR * linkage.extent:
        return None

    def made(values: Sequence[Value]) -> Linkage:
        lengths = [
            sum((values[n] * slope for n, slope in part), float(fixed))
            for part, fixed in zip(parts, rest, strict=True)
        ]
        return linkage.with_lengths(iter(lengths))

    return made


def _lengths_with(scene: Scene, values: Mapping[Key, float]) -> Array | None:
    """Return the lengths of the linkage with other numbers in its document; None where it cannot be read."""
    met: list[tuple[float, ...]] = []

    def kept(read: Scene) -> None:
        met.append(read.linkage.all_lengths)
        raise AssemblyError("it need not be put together")

    try:
        scene_from(with_values(scene, values), name=scene.name, where=scene.name, check=kept)
    except LinkanimError:
        return np.array(met[0]) if met and len(met[0]) == len(scene.linkage.all_lengths) else None
    return None
