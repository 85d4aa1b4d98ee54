"""Solve many linkages of one form, each at a phase of its own: their lengths are inputs of the program.

Formulas branch on lengths: which links limit the input, which of two bars is longer. So a program is recorded
for one of the linkages, the sample, with the conditions under which others take the same branches; it tells
of each linkage whether it is right for it. Those for which it is not are solved by the next program.

Some linkages are left to be solved by themselves: those within the last digits of a change point, those whose
input a dyad down the chain limits, or comes near to limiting, and those driven by a length.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import field
from functools import partial, reduce
from typing import NamedTuple

import numpy as np

from linkanim.errors import AssemblyError
from linkanim.frozen import frozen
from linkanim.mechanics.angles import FULL_TURN, HALF_TURN, Sum, exact_angle
from linkanim.mechanics.arithmetic import FormGraph, Slope, Value, are_inputs, known, maximum, minimum, sqrt
from linkanim.mechanics.groups import group_of
from linkanim.mechanics.linkage import MOTOR, Linkage
from linkanim.mechanics.measures import DERIVATIVE_OF, LEVER
from linkanim.mechanics.motion import ResultPlaces, laid_out, walked_rows
from linkanim.mechanics.program import Array, Batch, Bools, batch
from linkanim.mechanics.search import around
from linkanim.mechanics.solver.assembly import find_loops, runs_back, side_of, turns_to_return
from linkanim.mechanics.solver.closing import Assembly, Closing, Walk, walked
from linkanim.mechanics.solver.input import InputState, Turn, swing_by_phase
from linkanim.mechanics.solver.loop import Loop, gearings
from linkanim.mechanics.solver.signed_root import Kind, Unlike
from linkanim.mechanics.tolerances import CLEAR, JUST_AFTER

SAMPLES = 128
"""Phases of a turn of the quickest crank at which dyads down the chain are looked at."""
AT_ONCE = 1 << 16
MOST = 32
"""Programs of a form; linkages for which none of them is right are solved by themselves."""


class Program(NamedTuple):
    """What solves the linkages that are like one sample; its last row is not negative for those.

    `places` says where its other rows lie; None where these linkages cannot be put together (`apart`), or
    each is solved by itself. `sines` gives the sines of the angles of dyads down the chain; at none of
    `phases` may one be near zero.
    """

    run: Batch
    places: ResultPlaces | None = None
    apart: bool = False
    sines: Batch | None = None
    phases: Array = np.empty(0)

    def clear(self, lengths: Sequence[Array]) -> Bools:
        """Tell in which linkages (N,) every dyad down the chain stays clear of its limits.

        Of rows that follow each other with the same lengths one is looked at.
        """
        table = np.stack(lengths)
        first = np.append(True, (table[:, 1:] != table[:, :-1]).any(axis=0))
        lengths = [*table[:, first]]
        count, clear = len(lengths[0]), np.ones(len(lengths[0]), dtype=bool)
        last: Array | None = None
        assert self.sines is not None
        for phases in np.array_split(self.phases, max(1, len(self.phases) * count // AT_ONCE)):
            given = [np.tile(one, len(phases)) for one in lengths]
            sines = self.sines(*given, np.repeat(phases, count)).reshape(-1, len(phases), count)
            sines = sines if last is None else np.concatenate([last, sines], axis=1)
            steps, last = np.abs(np.diff(sines, axis=1)), sines[:, -1:]
            clear &= (sines > CLEAR).all(axis=(0, 1)) & (sines[:, 1:] > 2 * steps).all(axis=(0, 1))
        return np.asarray(clear[np.cumsum(first) - 1])


@frozen(eq=False)
class LinkageForm:
    """Linkages that differ in lengths alone: `made` gives the one whose lengths are these values.

    `linkage` is one of them. Without `made` each is solved by itself.
    """

    linkage: Linkage
    made: Callable[[Sequence[Value]], Linkage] | None
    usual: tuple[float, ...]
    """The lengths of `linkage`."""
    programs: dict[int, list[Program]] = field(default_factory=dict, repr=False)

    @property
    def uniform(self) -> bool:
        """Whether its linkages may be solved together."""
        return self.made is not None and has_form(self.linkage)

    def solved(
        self, lengths: Sequence[Array], phases: Array, rates: tuple[float, float], derivatives: int
    ) -> tuple[ResultPlaces | None, Array, Bools]:
        """Return where results lie, the results (rows, N), and which linkages are left to themselves (N,).

        `lengths` are arrays (N,), as is `phases`. What has no pose is NaN. The layout is None where none
        was solved.
        """
        programs = self.programs.setdefault(derivatives, [])
        places: ResultPlaces | None = None
        whole, open_rows = np.empty((0, len(phases))), np.zeros(len(phases), dtype=bool)
        rows, n = np.arange(len(phases)), 0
        while self.uniform and len(rows) and n < MOST:
            given = [one[rows] for one in (*lengths, phases)] if n else [*lengths, phases]
            new = n == len(programs)
            if new:
                programs.append(recorded(self, [float(one[0]) for one in given[:-1]], derivatives))
            program, n = programs[n], n + 1
            with np.errstate(all="ignore"):
                results = program.run(*given, *rates)
                if n == 1 and program.places and not program.sines and results[-1].min() >= 0:
                    return program.places, results, open_rows
                right = results[-1] >= 0
                alone = right & ~program.clear(given[:-1]) if program.sines and right.any() else None
            if program.places is None:
                open_rows[rows[right]] = not program.apart
            else:
                if places is None:
                    places, whole = (
                        program.places,
                        results if n == 1 else np.full((len(results), len(phases)), np.nan),
                    )
                if n > 1:
                    whole[:, rows[right]] = results[:, right]
                if alone is not None:
                    open_rows[rows[alone]] = True
            if right.all():
                break
            if new and not right[0]:  # not even the sample is like itself
                open_rows[rows[0]] = right[0] = True
            rows = rows[~right]
            if n == 1:
                whole[:, rows] = np.nan
        else:
            open_rows[rows] = True
        return places, whole, open_rows


def has_form(linkage: Linkage) -> bool:
    """Tell whether linkages such as this one, with other lengths, may be solved together.

    A motor drives them, they are made of dyads, and a swing goes over to the other closure at both ends.
    """
    drive, near = linkage.drive, linkage.near is linkage
    return near and not drive.retraced and group_of(linkage) is None and drive.actuator == MOTOR


def recorded(form: LinkageForm, sample: Sequence[float], derivatives: int) -> Program:
    """Return the program for linkages that are like the one with these lengths."""
    graph = FormGraph()
    names = [f"l{n}" for n in range(len(sample))]
    lengths = [graph.sampled(*one) for one in zip(names, sample, form.usual, strict=True)]
    x, second = graph.input("x"), graph.input("a", uniform=True)
    inputs = {**dict.fromkeys(names, True), "x": True}
    walk, places, apart = None, None, False
    try:
        assert form.made is not None
        walk = _walked(form, form.made(lengths), x, Slope(graph.input("w", uniform=True), second))
        rows = {
            kind: values
            for kind, values in walked_rows(walk, 1.0)
            if kind != LEVER and DERIVATIVE_OF[kind] <= derivatives
        }
    except AssemblyError:
        apart = True
    except (Unlike, ArithmeticError, ValueError):
        pass
    conditions = list(dict.fromkeys(graph.conditions))
    like = reduce(minimum, conditions) if conditions else 0.0
    rated = {**inputs, "w": False, "a": False}
    if walk is None:
        return Program(batch(rated, [like]), None, apart)
    pins = {pin.name: pin.position for pin in walk.linkage.pins if not are_inputs(*pin.position)}
    places, outputs = laid_out(rows, pins)
    sines = [_sine(closing) for closing in walk.closings.values()]
    turns, quickest = turns_to_return(walk.linkage, walk.assembly.loops), walk.assembly.quickest
    return Program(
        batch(rated, [*outputs, like]),
        places,
        sines=batch(inputs, sines) if sines else None,
        phases=around(turns, math.ceil(SAMPLES * quickest)),
    )


def _sine(closing: Closing) -> Value:
    """Return the sine of a dyad's angle, 0 where it does not close."""
    return sqrt(maximum(closing.u * closing.w * 4.0 / closing.size, 0.0))


def _walked(form: LinkageForm, linkage: Linkage, x: Value, pace: Slope) -> Walk:
    """Return a walk over a linkage whose lengths are values, at phase x.

    AssemblyError where linkages with such lengths cannot be put together, Unlike where each is to be solved
    by itself.
    """
    vars(linkage)["rigid_bodies"] = form.linkage.rigid_bodies
    loops = find_loops(linkage, gearings(linkage))
    for loop in loops.values():
        if Kind.CHANGE_POINT in (loop.root.u.kind, loop.root.w.kind):
            raise Unlike
    limiting = [(name, loop) for name, loop in loops.items() if loop.limits]
    if len(limiting) > 1:
        raise Unlike
    turning = Turn(linkage.drive.start, 1)
    signs = {joint.name: joint.named_sign for joint in linkage.joints if joint.named_sign is not None}
    walks = [
        (Assembly(linkage, loops, turning, one, of_inputs=True), moved)
        for moved in ([_swing(linkage, *limiting[0], n) for n in (0, 1)] if limiting else [turning.state])
        for one in (signs, *({**signs, name: -signs[name]} for name in _named(linkage)))
    ]
    assembly, moved = next((one for one in walks if _is_as_named(*one)), walks[0])
    return walked(assembly, moved(x, pace))


def _named(linkage: Linkage) -> list[str]:
    """Return the dyads that are named by another joint's side."""
    return [joint.name for joint in linkage.joints if joint.named_from]


Moved = Callable[[Value, Slope], InputState]
"""The input's state at a phase that runs at a pace."""


def _is_as_named(assembly: Assembly, moved: Moved) -> bool:
    """Tell whether dyads that are named by another joint's side lie as named just after the start."""
    namings = [naming for joint in assembly.linkage.joints if (naming := joint.named_from)]
    points = walked(assembly, moved(JUST_AFTER, Slope(0.0))).points if namings else {}
    return all(side_of(points, *naming) > 0 for naming in namings)


def _swing(linkage: Linkage, name: str, loop: Loop, n: int) -> Moved:
    """Return the path of an input that one loop limits: of two ranges the `n`th best.

    The best one contains a stated start, or else lies left of the ground line.
    """
    root, start = loop.root, linkage.drive.stated_start
    if min(known(root.u.most), known(root.w.most)) <= 0:
        raise AssemblyError
    if root.u.kind is Kind.LIMIT is root.w.kind:
        least, most = root.w.short.constant, root.u.reach.constant
        below = runs_back(linkage, name, loop)
        if start is not None:
            below = _lies_below(loop, start, below)
        sense = -1.0 if below == (n == 0) else 1.0
        low, high = root.reference + Sum(least * sense), root.reference + Sum(most * sense)
        low, high = (high, low) if sense < 0 else (low, high)
        middle, way = root.reference + Sum((least + most) * (0.5 * sense)), (most - least) * 0.5
    else:
        limited = root.u if root.u.kind is Kind.LIMIT else root.w
        middle = root.reference + HALF_TURN if limited is root.w else root.reference
        way = limited.reach.constant
        low, high = middle - limited.reach, middle + limited.reach
    turns = 0 if start is None else round((start - known(middle.constant)) / math.tau)
    on = FULL_TURN.times(float(turns))
    low, high, middle = (angle + on if turns else angle for angle in (low, high, middle))
    return partial(swing_by_phase, low=low, high=high, span=(middle, way))


def _lies_below(loop: Loop, start: float, otherwise: bool) -> bool:
    """Tell which of two ranges contains a start; `otherwise` where none does."""
    root = loop.root
    if are_inputs(root.reference.high):
        raise Unlike
    angle = float(exact_angle(start) - root.reference)
    cosine, sine = math.cos(angle / 2), math.sin(angle / 2)
    if root.u.least + root.spread * (cosine * cosine) < 0 or root.w.least + root.spread * (sine * sine) < 0:
        return otherwise
    return math.sin(angle) < 0
