"""Search the front of answers to a drawn path: deviation, size and transmission angle judged together.

An answer is on the front if no other is as good in all three (Pareto). The front is searched by limits: many
candidates are fitted at once, each within its own longest link and least transmission angle.

Its parts, in reading order:

- The front: which answers are on it, which one comes first, and a few that differ to a reader.
- Search: fits within many pairs of limits, and answers along the front from the exact end to the compact end.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence, Set
from dataclasses import replace
from itertools import pairwise
from typing import Literal, NamedTuple, TypeVar

import numpy as np

from linkanim.synthesis.answers import Figures, Fit, answer_of, cognates_of, turning_cognates
from linkanim.synthesis.atlas import CURVES, Candidates
from linkanim.synthesis.fitting import EXACTLY, PathTask, merit, refined
from linkanim.synthesis.linkages import FOUR_BAR, Indices, Real
from linkanim.synthesis.search import MATCHED, SAME, Pulse, spread, started, unwatched, verified

# The front: which answers are on it, which one comes first, and a few that differ to a reader.

Answer = TypeVar("Answer")
Preference = Literal["balanced", "exact", "compact", "angle"]
PREFERENCES: tuple[Preference, ...] = ("balanced", "exact", "compact", "angle")
_ENDS: tuple[Preference, ...] = ("exact", "compact", "angle")
_DRIVEN = math.radians(29.9)
"""From this transmission angle on, 30 degrees but for rounding, a linkage can be driven."""
_DRIVEN_WITHIN = 2.0
"""The factor of the best deviation within which an answer that can be driven comes first."""
_OWN, _PASSED, _EXACT = 1e-4, 1e-6, 1e-11
"""Deviations, as shares of the curve's size: below the first the curve is a linkage's own, and only answers
that trace it come first; within the second a point is passed exactly; answers below the third are equally
exact."""
_OTHER, _ROUGHLY = Figures(1.25, 1.2, math.inf, math.radians(5)), 1e-4
"""The factors, and the angle, by which figures differ to a reader, and the deviation that reads as zero."""
_SEEN = 3e-3
"""A deviation that cannot be seen: answers below it are equally exact when one is chosen."""
_TRADE = math.log(1.5, 2)
"""The weight of size against deviation: an answer of twice the size has to save a third of the deviation."""
_COMPACT, _NEAR = 2.5, 1.5
"""No answer above this size is chosen if one below it is within this factor of the best deviation."""
_STILL_NEAR = 2.0
"""The factor of the best deviation that is allowed in this choice for a better transmission angle."""
_WELL = math.radians(35)
"""From this transmission angle on a linkage runs well; below, the angle counts as much as the deviation."""
_VISIBLE = 0.1
"""No answer with a shorter crank, as a share of its longest link, is chosen if there is another."""
_FARTHEST, _TIMES = 0.03, 3.0
"""The largest deviation of an answer: this share of the curve's size, or so many times the best one."""
_JAMS = math.radians(5)
"""Below this transmission angle a linkage nearly jams: such an answer is left out if there are others."""
_SLACK = Figures(1.01, 1.01, 1.01, math.radians(0.3))
"""The factors, and the angle, below which figures on the front count as equal."""


def front_of(fits: Iterable[Fit]) -> tuple[Fit, ...]:
    """Return the answers that follow the curve and are on the front, the most exact first."""
    ordered = sorted(fits, key=lambda fit: (cost(fit.figures), *fit.figures))
    best = min((fit.figures.deviation for fit in ordered), default=0.0)
    follow = [fit for fit in ordered if fit.figures.deviation <= max(_TIMES * best, _FARTHEST)]
    sound, exact = [fit for fit in follow if fit.figures.angle >= _JAMS], _reach(best)
    if best <= _OWN and all(fit.figures.deviation > exact for fit in sound):
        sound = [fit for fit in follow if fit in sound or fit.figures.deviation <= exact]
    unbeaten: list[Fit] = []
    for fit in sound or follow:
        if not any(_beats(one.figures, fit.figures) for one in unbeaten):
            unbeaten.append(fit)
    return tuple(sorted(unbeaten, key=lambda fit: (fit.figures.deviation, *fit.figures)))


def _beats(one: Figures, other: Figures) -> bool:
    """Return whether one is as good as another in all figures, small differences ignored."""
    if one.deviation > max(_SLACK.deviation * other.deviation, _EXACT):
        return False
    smaller = one.size <= _SLACK.size * other.size and one.room <= _SLACK.room * other.room
    return smaller and one.angle >= other.angle - _SLACK.angle


def _reach(best: float) -> float:
    """Return the deviation up to which an answer may come first for being driven well."""
    return max(_DRIVEN_WITHIN * best, _EXACT)


def cost(figures: Figures) -> float:
    """Return the logarithm (base e) of one cost for all figures: differences of it are comparable."""
    seen = max(figures.deviation, _SEEN) * _of_angle(figures)
    return math.log(seen) + _TRADE * math.log(max(figures.size, figures.room / 2))


def _of_angle(figures: Figures) -> float:
    """Return the factor by which a poor transmission angle raises the deviation."""
    return max(math.sin(_WELL) / max(math.sin(figures.angle), 1e-6), 1.0)


def is_driven(angle: float) -> bool:
    """Tell whether a linkage of such a least transmission angle (rad) can be driven."""
    return angle >= _DRIVEN


def first_of(front: Sequence[Figures]) -> int:
    """Return the index of the answer that one would build, which comes first.

    It is the knee of the answers that can be driven, with a least transmission angle of 30 degrees, among
    those within twice the best deviation; where there is none the knee of all, or of those that trace a curve
    that is a linkage's own.
    """
    best = min(one.deviation for one in front)
    near = [n for n, one in enumerate(front) if one.deviation <= _reach(best)]
    some = [n for n in near if is_driven(front[n].angle)] or (near if best <= _OWN else [*range(len(front))])
    return some[knee([front[n] for n in some])]


def knee(front: Sequence[Figures]) -> int:
    """Return the index of the answer that is worth its size.

    It does not double the size to save less than a third of the deviation, nor is it larger than 2.5 curve
    sizes if a smaller one is within 1.5 times the best deviation. Its crank is long enough to be seen turn,
    where there is such an answer.
    """
    seen = [n for n, one in enumerate(front) if one.crank >= _VISIBLE]
    if 0 < len(seen) < len(front):
        return seen[knee([front[n] for n in seen])]
    off = [max(one.deviation, _SEEN) for one in front]

    def is_worth_it(n: int) -> bool:
        halves = (m for m, other in enumerate(front) if other.size <= front[n].size / 2)
        return all(off[n] <= off[m] / _NEAR for m in halves)

    worth = [*filter(is_worth_it, range(len(front)))]
    if any(one.size <= _COMPACT and off[n] <= _NEAR * min(off) for n, one in enumerate(front)):
        small = [n for n in worth if front[n].size <= _COMPACT]
        worth = [n for n in small if off[n] <= _STILL_NEAR * min(off)] or small
    return min(worth, key=lambda n: (cost(front[n]), n))


def preferred(fits: Iterable[Fit], prefer: Preference) -> list[Fit]:
    """Return answers sorted by size, by transmission angle, or else by deviation.

    Of balanced ones the one to build comes first.
    """
    keys: dict[Preference, Callable[[Figures], float]] = {
        "compact": lambda figures: max(figures.size, figures.room / 2),
        "angle": lambda figures: -figures.angle,
    }
    key: Callable[[Figures], float] = keys.get(prefer, lambda figures: figures.deviation)
    ordered = sorted(fits, key=lambda fit: (key(fit.figures), cost(fit.figures)))
    return led([fit.figures for fit in ordered], ordered) if prefer == "balanced" and ordered else ordered


def led(figures: Sequence[Figures], answers: Sequence[Answer]) -> list[Answer]:
    """Return answers, of such figures, with the one that comes first in front; the others stay in order."""
    first = first_of(figures)
    return [answers[first], *answers[:first], *answers[first + 1 :]]


def differ(one: Figures, other: Figures) -> bool:
    """Tell whether answers differ to a reader: by a quarter of deviation, a fifth of size, or 5 degrees."""
    off = sorted(max(figures.deviation, _ROUGHLY) for figures in (one, other))
    size = sorted((one.size, other.size))
    larger = off[1] >= _OTHER.deviation * off[0] or size[1] >= _OTHER.size * size[0]
    return larger or abs(one.angle - other.angle) >= _OTHER.angle


def differing(fits: Iterable[Fit], count: int) -> list[Fit]:
    """Return the first `count` answers that differ to a reader, none a cognate of an earlier one."""
    different: list[Fit] = []
    for fit in fits:
        if len(different) < count and _differs(fit, different):
            different.append(fit)
    return different


def _differs(fit: Fit, others: Iterable[Fit]) -> bool:
    return all(differ(fit.figures, one.figures) and fit.apart_from_cognates(one) > SAME for one in others)


def cards(front: Sequence[Fit], shown: Fit, count: int) -> tuple[Fit, ...]:
    """Return at most `count` answers of the front that differ to a reader, the shown one first.

    Then come, the most exact first, the ends of the front and, between these, the answers whose figures
    differ most from the others'.
    """
    ends = [preferred(front, prefer)[0] for prefer in _ENDS] if front else []
    chosen = differing([shown, *ends], count)
    rest = [fit for fit in front if _differs(fit, chosen)]
    while rest and len(chosen) < count:
        far = max(rest, key=lambda fit: min(_away(fit.figures, one.figures) for one in chosen))
        chosen.append(far)
        rest = [fit for fit in rest if _differs(fit, [far])]
    return (shown, *preferred(chosen[1:], "exact"))


def names_of(cards: Sequence[Figures]) -> tuple[str, ...]:
    """Return each answer's name: "balanced" for the one to build, what it is best in, or else ""."""
    names = ["" for _ in cards]
    if cards:
        names[first_of(cards)] = "balanced"
        for name, best in (
            ("best angle", max(range(len(cards)), key=lambda n: cards[n].angle)),
            ("most compact", min(range(len(cards)), key=lambda n: cards[n].size)),
            ("most exact", min(range(len(cards)), key=lambda n: cards[n].deviation)),
        ):
            names[best] = name
    return tuple(names)


def _away(one: Figures, other: Figures) -> float:
    """Return the distance of two answers in their figures."""
    off = math.log(max(one.deviation, _SEEN) / max(other.deviation, _SEEN))
    return math.hypot(off, math.log(one.size / other.size), (one.angle - other.angle) / _WELL)


# Search: fits within many pairs of limits, and answers along the front from the exact end to the compact end.

_SIZES, _ANGLES = np.geomspace(0.5, 8.0, 12), np.radians([5.0, 15.0, 30.0, 42.0])
"""Longest links in curve sizes, and least transmission angles: candidates are fitted within each pair."""
_POOL, _OPEN_POOL = 600, 300
_POOL_CURVES, _OPEN_CURVES = CURVES, CURVES // 4
"""How many of the best of the atlas's first curves candidates start from, for a closed or an open curve."""
_STARTS, _LARGER = 8, 1.3
"""For each pair of limits, the number of starts, and the factor by which they may exceed the size."""
_POINTS, _STEPS, _KEPT = (32, 64), (12, 40), (3, 1)
"""For each of two stages: the points, the steps, and the candidates of each pair that are kept."""
_STEP, _MOST_BETWEEN, _WAY_STEPS = 0.06, 6, 25
"""Answers along the front: the share by which size changes, the most between two, and steps for each."""
_LITTLE = 0.25
"""The power to which the factor of a transmission angle is raised when answers along the front are chosen."""


class _Limited(NamedTuple):
    """Candidates, each with its own limits: longest link (in curve sizes) and least transmission angle."""

    candidates: Candidates
    sizes: Real
    angles: Real

    def take(self, chosen: Indices) -> _Limited:
        return _Limited(self.candidates.take(chosen), self.sizes[chosen], self.angles[chosen])

    def problem(self, task: PathTask, chosen: Indices) -> PathTask:
        """Return the task at chosen points, with each candidate's own limits."""
        own = task.requirements
        largest = np.minimum(self.sizes * task.curve.size, own.largest)[:, None]
        limits = replace(own, largest=largest, least_angle=np.maximum(self.angles, own.least_angle))
        return replace(task, requirements=limits).problem(chosen)


def searched_front(task: PathTask, known: Iterable[Fit] = (), pulse: Pulse = unwatched) -> tuple[Fit, ...]:
    """Return the front of the answers found within many limits, and of known ones.

    The most exact comes first. `pulse` is called meanwhile.
    """
    chosen = task.thinned(MATCHED)
    closed = task.curve.closed
    pool = started(task, chosen, _POOL if closed else _OPEN_POOL, _POOL_CURVES if closed else _OPEN_CURVES)
    now = _starts(task, pool)
    for points, steps, most in zip(_POINTS, _STEPS, _KEPT, strict=True):
        pulse()
        before, chosen = chosen, task.thinned(points)
        now, costs = _fitted(task, now, before, chosen, steps)
        now = now.take(_best_of_each(now, costs, most))
    pulse()
    fits = filter(_passes, verified(task, now.candidates, chosen, pulse))
    return with_cognates(front_of([*known, *fits]), pulse)


def _passes(fit: Fit) -> bool:
    """Return whether an answer passes the points that are to be passed exactly."""
    task = fit.task
    exact = np.flatnonzero(task.weights >= EXACTLY)
    traced = task.kind.points(fit.row[None], np.array([fit.closure_sign]), fit.angles[None, exact])[0]
    return bool((np.abs(traced - task.curve.points[exact]) <= _PASSED * task.curve.size).all())


def with_cognates(front: Sequence[Fit], pulse: Pulse = unwatched) -> tuple[Fit, ...]:
    """Return the front of given answers and their cognates, which are as exact but of another size."""
    if not front or front[0].kind is not FOUR_BAR:
        return tuple(front)
    more: list[Fit] = []
    for fit in front:
        pulse()
        own, likely = fit.figures, filter(None, turning_cognates(answer_of(fit)))
        # along an open curve a cognate's angle may be better than over its whole turn
        if any(one.size < own.size or one.angle > own.angle or not fit.task.curve.closed for one in likely):
            more += cognates_of(fit)
    return front_of([*front, *more])


def _fitted(
    task: PathTask, now: _Limited, before: Indices, chosen: Indices, steps: int
) -> tuple[_Limited, Real]:
    """Return candidates fitted at chosen points within their limits, and each one's merit."""
    now = now._replace(candidates=spread(task, now.candidates, before, chosen))
    problem = now.problem(task, chosen)
    candidates, _ = refined(problem, now.candidates, steps)
    return now._replace(candidates=candidates), merit(problem, candidates)


def _starts(task: PathTask, pool: Candidates) -> _Limited:
    """Return for each pair of limits the candidates that are most similar to the curve and small enough.

    Those that keep the least transmission angle come first.
    """
    size = task.kind.link_lengths(pool.rows).max(axis=1)
    which: list[Indices] = []
    limits: list[tuple[float, float]] = []
    for angle in _ANGLES:
        sticks = np.asarray((task.kind.margins(pool.rows, angle) <= 0).any(axis=1))
        for longest in _SIZES:
            fine = np.flatnonzero(size <= _LARGER * longest)
            best = fine[np.argsort(sticks[fine], kind="stable")][:_STARTS]
            which.append(best)
            limits += len(best) * [(float(longest), float(angle))]
    sizes, angles = np.array(limits).reshape(-1, 2).T
    return _Limited(pool.take(np.concatenate(which)), sizes, angles)


def _best_of_each(now: _Limited, costs: Real, count: int) -> Indices:
    """Return the indices of the best `count` candidates of each pair of limits."""
    order = np.lexsort((costs, now.angles, now.sizes))
    order = order[np.isfinite(costs[order])]
    pairs = np.stack([now.sizes[order], now.angles[order]])
    new = np.append(True, (np.diff(pairs, axis=1) != 0).any(axis=0))
    first = np.maximum.accumulate(np.where(new, np.arange(len(order)), 0))
    return order[np.arange(len(order)) - first < count]


def way_along(task: PathTask, front: Sequence[Fit], pulse: Pulse = unwatched) -> tuple[Fit, ...]:
    """Return answers from the exact end of a front to the compact end, each similar to its neighbours.

    Between two neighbours on the front, the best of their sizes, answers are fitted starting from both.
    """
    exact, compact = (preferred(front, prefer)[0] for prefer in ("exact", "compact"))
    ends = _along(front, {exact, compact, front[first_of([fit.figures for fit in front])]})
    ends.sort(key=lambda fit: fit is not exact)
    starts, sizes, angles = list[Fit](), list[float](), list[float]()
    for one, other in pairwise(ends):
        gap = math.log(other.figures.size / one.figures.size)
        between = min(round(abs(gap) / _STEP), _MOST_BETWEEN)
        for n in range(1, between + 1):
            part = n / (between + 1)
            for start in (one, other):
                starts.append(start)
                sizes.append(one.figures.size * math.exp(part * gap))
                angles.append((1 - part) * one.figures.angle + part * other.figures.angle)
    if not starts:
        return tuple(ends)
    pulse()
    limits = _Limited(_candidates_of(task, starts), np.array(sizes), 0.95 * np.array(angles))
    chosen = task.thinned(_POINTS[-1])
    now, costs = _fitted(task, limits, np.arange(len(task.curve.points)), chosen, _WAY_STEPS)
    pulse()
    more = verified(task, now.take(_best_of_each(now, costs, 1)).candidates, chosen)
    return tuple(sorted(_along([*ends, *more], set(ends)), key=lambda fit: fit is not exact))


def _along(fits: Iterable[Fit], ends: Set[Fit]) -> list[Fit]:
    """Return the answers that are the most exact of their size, the largest first, and the `ends`.

    A much better transmission angle makes up for a little deviation.
    """

    def off(fit: Fit) -> float:
        return fit.figures.deviation * math.pow(_of_angle(fit.figures), _LITTLE)

    best, least = list[Fit](), math.inf
    for fit in sorted(fits, key=lambda fit: (fit.figures.size, off(fit))):
        if fit in ends or off(fit) < least:
            best.append(fit)
            least = min(least, off(fit))
    return best[::-1]


def _candidates_of(task: PathTask, fits: Sequence[Fit]) -> Candidates:
    """Return answers as candidates at all points, at size 1."""
    parts = (
        [fit.row for fit in fits],
        [fit.closure_sign for fit in fits],
        [fit.angles for fit in fits],
        [fit.sense for fit in fits],
    )
    return task.normalised(Candidates(*map(np.array, parts)))
