"""Search for linkages that follow a drawn curve, and rank them.

Its parts, in reading order:

- From a drawn curve to the linkages that follow it: atlas, refinement, check.
- Answers in round lengths: one length after the other is rounded and fixed, and the rest is fitted again.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from linkanim.errors import BadInput
from linkanim.synthesis.answers import Fit, checked, rounded
from linkanim.synthesis.atlas import CURVES, Candidates, atlas, joined, matched, matched_few, matched_in_time
from linkanim.synthesis.curves import DrawnCurve
from linkanim.synthesis.fitting import FEW, PathTask, merit, refined
from linkanim.synthesis.linkages import Complex, Indices, Real

# From a drawn curve to the linkages that follow it: atlas, refinement, check.

Pulse = Callable[[], None]
"""Is called before each step of a search that may take a while."""


def unwatched() -> None:
    """Do nothing at a step."""


_Stage = tuple[int, int, int]
"""How many candidates are refined, over how many points, in how many steps."""
_FEW_STAGES = ((300, FEW, 25), (80, FEW, 60), (12, FEW, 200))
_STAGES = ((80, 32, 12), (24, 64, 40), (8, 200, 150))
_WIDER_STAGES = ((2000, 32, 8), (300, 64, 40), (40, 64, 200))
_FOREIGN_STAGES = ((600, 32, 8), (80, 64, 40), (12, 200, 150))
MATCHED = 128
"""The largest number of a curve's points that are compared with the atlas."""
_REFIT_STEPS = 30
_GLIMPSED, _GLIMPSED_OPEN = CURVES, CURVES // 5
"""The curves of the atlas that are searched first; fewer for an open curve, compared with several shares."""
_GOOD = 1e-3
"""The deviation, as a share of the curve's size, above which an open curve's crank may swing."""
_FOLLOWED, _FOREIGN = 1e-4, 1e-2
"""Deviations, as shares of the curve's size, between which the best answer is likely a false minimum.

There many more candidates are tried. Below, the curve is followed; above, no linkage of this kind follows it,
and a few more candidates help a little.
"""
SAME = 1e-4
"""The distance of joints, as a share of the curve's size, below which two answers are the same."""
ALIKE = 0.05
"""The distance of joints, as a share of the curve's size, up to which two answers look the same."""
_FITTED = 1e-6
"""An error, as a share of the curve's size: below it the transmission angle ranks the answers."""
_EQUAL = 6
"""The decimals to which figures are compared, as those of cognates differ by rounding."""
_CLOSED = 1e-24
"""A merit that counts as zero: candidates below it are equal."""


def best_fits(
    task: PathTask, count: int, pulse: Pulse = unwatched, *, widely: bool = True
) -> tuple[Fit, ...]:
    """Return the `count` best different answers, the best first; BadInput where there is none.

    With `widely`, more candidates are tried where the first do not follow the curve, which takes longer.
    """
    fits = _searched(task, count, pulse, widely=widely)
    if not task.curve.closed and (not fits or fits[0].error > _GOOD * task.curve.size):
        fits = best_of([*fits, *_searched(task.swinging(), count, pulse, widely=widely)], count)
    if not fits:
        raise BadInput(none_fits(task))
    return fits


def none_fits(task: PathTask) -> str:
    """Return the sentence that no linkage keeps to what is asked for."""
    boxes = len(task.requirements.boxes)
    limits = ["the boxes" if boxes > 1 else "the box"] if boxes else []
    limits += [f"the given {name}" for name in task.requirements.given]
    named = ", ".join([*limits, "the longest link"])
    return (
        f"no {task.kind.name} was found that keeps to {named} and the least transmission angle; "
        "give it more room"
    )


def glimpsed(task: PathTask) -> Fit | None:
    """Return the atlas's best curve without refinement: in a tenth of a second, once the atlas is made."""
    chosen = task.thinned(MATCHED)
    start = started(task, chosen, _STAGES[0][0], _GLIMPSED if task.curve.closed else _GLIMPSED_OPEN)
    traced = task.kind.points(start.rows, start.closure, start.angles)
    off = np.abs(traced - task.normal.points[chosen]).max(axis=1)
    return next(verified(task, start.take(np.argsort(off, kind="stable")), chosen), None)


def started(task: PathTask, chosen: Indices, count: int, among: int = CURVES) -> Candidates:
    """Return the best candidates of the atlas, or of its first curves, at size 1 and at chosen points."""
    known, points = atlas(task.kind).first(among), DrawnCurve(task.normal.points[chosen], task.curve.closed)
    if task.timing is None and len(points.points) <= FEW:
        return joined([matched(known, points, count // 4), matched_few(known, points, count)])
    if task.timing is None:
        return matched(known, points, count)
    timing = task.timing[chosen]
    return matched_in_time(known, points.points, timing, count, free_start=task.free_start)


def _searched(task: PathTask, count: int, pulse: Pulse, *, widely: bool) -> tuple[Fit, ...]:
    few = len(task.curve.points) <= FEW
    fits = _through(task, _FEW_STAGES if few else _STAGES, count, pulse)
    off = fits[0].error / task.curve.size if fits else _FOLLOWED
    if not widely or few or off < _FOLLOWED:
        return fits
    further = _WIDER_STAGES if off <= _FOREIGN else _FOREIGN_STAGES
    return best_of([*fits, *_through(task, further, count, pulse)], count)


def _through(task: PathTask, stages: tuple[_Stage, ...], count: int, pulse: Pulse) -> tuple[Fit, ...]:
    candidates, chosen = _refined_through(task, stages, pulse)
    return best_of(_enough(verified(task, candidates, chosen, pulse), count), count)


def _enough(fits: Iterator[Fit], count: int) -> Iterator[Fit]:
    """Yield answers, the best first, until there are `count` different ones and one more."""
    seen: list[Fit] = []
    for fit in fits:
        yield fit
        seen += [] if any(_same(fit, other) for other in seen) else [fit]
        if len(seen) > count:
            return


def _refined_through(task: PathTask, stages: tuple[_Stage, ...], pulse: Pulse) -> tuple[Candidates, Indices]:
    """Return the best candidates of the last stage, the best first, at size 1, and that stage's points."""
    chosen = task.thinned(MATCHED)
    now = started(task, chosen, stages[0][0])
    cost = np.zeros(len(now.rows))
    for number, (candidates, points, steps) in enumerate(stages):
        pulse()
        now = now.take(_by_merit(cost)[:candidates])
        before, chosen = chosen, task.thinned(points)
        now = spread(task, now, before, chosen)
        problem = task.problem(chosen)
        now, cost = refined(problem, now, steps, guarded=number == len(stages) - 1)
        if number:
            cost = merit(problem, now)
    return now.take(_by_merit(cost)[: int(np.isfinite(cost).sum())]), chosen


def _by_merit(cost: Real) -> Indices:
    """Return the order of candidates by their merit; equal ones stay as they are."""
    return np.argsort(np.round(np.log10(np.maximum(cost, _CLOSED)), _EQUAL), kind="stable")


def refitted(task: PathTask, fit: Fit) -> Fit | None:
    """Return an answer fitted again to a task that may have other points, weights or given values.

    The task has as many points as the answer. None where no answer is found.
    """
    start = Candidates(fit.row[None], np.array([fit.closure_sign]), fit.angles[None], np.array([fit.sense]))
    chosen = task.thinned(_STAGES[-1][1])
    now = task.normalised(start)
    now = spread(task, now, np.arange(len(task.normal.points)), chosen)
    now, _ = refined(task.problem(chosen), now, _REFIT_STEPS)
    return next(verified(task, now, chosen), None)


def spread(task: PathTask, candidates: Candidates, before: Indices, after: Indices) -> Candidates:
    """Return candidates at the points `after`, their crank angles interpolated from the points `before`."""
    turn = 2 * math.pi * candidates.sense[:, None]
    return candidates._replace(angles=task.spread(candidates.angles, turn, before, after))


def verified(task: PathTask, normal: Candidates, chosen: Indices, pulse: Pulse = unwatched) -> Iterator[Fit]:
    """Yield the answers among candidates of size 1 at chosen points, each linkage once."""
    scaled = task.scaled(spread(task, normal, chosen, np.arange(len(task.normal.points))))
    middle = scaled.angles.shape[1] // 2
    joints = task.kind.joints(scaled.rows, scaled.closure, scaled.angles[:, [0, middle]])
    known: list[Complex] = []
    for (row, closure, angles, _), places in zip(zip(*scaled, strict=True), joints, strict=True):
        if any(np.abs(places - other).max() <= SAME * task.curve.size for other in known):
            continue
        pulse()
        if fit := checked(task, rounded(task, row), float(closure), angles):
            known.append(places)
            yield fit


def best_of(fits: Iterable[Fit], count: int) -> tuple[Fit, ...]:
    """Return the best `count` answers that differ by more than rounding."""
    distinct: list[Fit] = []
    for fit in ranked(fits):
        if not any(_same(fit, other) for other in distinct):
            distinct.append(fit)
    return tuple(distinct[:count])


def ranked(fits: Iterable[Fit]) -> list[Fit]:
    """Return answers, the best first: by error, then transmission angle, longest link and place.

    Each of these decides only among answers that differ by no more than rounding in those before it, so that
    the order does not depend on how numbers are aligned in memory.
    """
    return _ranked([(_figures(fit), fit) for fit in fits])


def _figures(fit: Fit) -> tuple[float, ...]:
    size = fit.task.curve.size
    error = math.log10(max(fit.error / size, _FITTED))
    return error, -fit.transmission_angle, fit.size / size, *(fit.row / size)


def _ranked(fits: Sequence[tuple[tuple[float, ...], Fit]], figure: int = 0) -> list[Fit]:
    """Return answers sorted by a figure, and those with an equal one sorted by the next figure."""
    if len(fits) < 2 or figure == len(fits[0][0]):
        return [fit for _, fit in fits]
    ordered = sorted(fits, key=lambda pair: pair[0][figure])
    ends = [n for n in range(1, len(fits)) if ordered[n][0][figure] - ordered[n - 1][0][figure] > 10**-_EQUAL]
    runs = [ordered[first:last] for first, last in pairwise([0, *ends, len(fits)])]
    return [fit for run in runs for fit in _ranked(run, figure + 1)]


def _same(one: Fit, other: Fit) -> bool:
    return one.apart(other) <= SAME


def with_cognates_marked(fits: Sequence[Fit]) -> tuple[Fit, ...]:
    """Return answers, each marked as a cognate where it is one of an earlier answer, before any rounding."""
    exact = [fit.exact or fit for fit in fits]
    return tuple(
        replace(fit, cognate=any(exact[n].apart_from_cognates(one) <= SAME for one in exact[:n]))
        for n, fit in enumerate(fits)
    )


# Answers in round lengths: one length after the other is rounded and fixed, and the rest is fitted again.


def with_round_lengths(fits: tuple[Fit, ...], step: float, pulse: Pulse = unwatched) -> tuple[Fit, ...]:
    """Return answers whose lengths and pivots are multiples of a step, the best first.

    Each has its form before rounding in `exact`. BadInput where no answer that follows the curve is left.
    """
    round_ones = [fit for fit in (rounded_to(fit, step, pulse) for fit in fits) if fit is not None]
    if not round_ones:
        raise BadInput(f"rounded to {step:g} no linkage is left that follows the curve; take a finer step")
    return best_of(round_ones, len(round_ones))


def rounded_to(fit: Fit, step: float, pulse: Pulse = unwatched) -> Fit | None:
    """Return an answer in round lengths; None where no linkage of such lengths is an answer."""
    now: Fit | None = fit
    for name in fit.task.kind.parameters:
        if name == "line_angle" or now is None:
            continue
        pulse()
        held = [_holding(now.task, name, value) for value in _near(now.parameters[name], step)]
        tries = [one for task in held if (one := refitted(task, now))]
        now = min(tries, key=lambda one: one.error, default=None)
    return now and replace(now, task=fit.task, exact=fit)


def _near(value: float, step: float) -> tuple[float, float]:
    """Return the multiples of the step below and above, as decimals."""
    digits = max(0, 12 - math.floor(math.log10(step)))
    low = math.floor(value / step)
    return round(low * step, digits), round((low + 1) * step, digits)


def _holding(task: PathTask, name: str, value: float) -> PathTask:
    given = {**task.requirements.given, name: value}
    return replace(task, requirements=replace(task.requirements, given=given))
