"""Find linkages that follow a drawn path: `linkanim.path`, with everything that may be asked of them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from linkanim import units
from linkanim.bounds import NUMBERS, can_be_computed
from linkanim.errors import BadInput
from linkanim.intake import meant
from linkanim.synthesis.answers import Fit, checked_again, cognates_of
from linkanim.synthesis.curves import DrawnCurve, drawn
from linkanim.synthesis.drivers import Motor, all_driven, place_of
from linkanim.synthesis.fitting import EXACTLY, PathTask
from linkanim.synthesis.front import (
    PREFERENCES,
    Preference,
    cards,
    differing,
    front_of,
    preferred,
    searched_front,
)
from linkanim.synthesis.linkages import (
    KINDS,
    Box,
    Indices,
    LinkageKind,
    Real,
    Requirements,
    boxes_of,
    holds,
    refuse_count,
)
from linkanim.synthesis.pairs import mirror_of, paired
from linkanim.synthesis.search import (
    SAME,
    Pulse,
    best_fits,
    none_fits,
    rounded_to,
    unwatched,
    with_cognates_marked,
    with_round_lengths,
)
from linkanim.units import shown

LARGEST = 8.0
"""The longest link by default, in curve sizes."""
COUNT = 5
_SEARCHED = 128
"""The largest number of points that are searched with; answers are then checked at all points."""
_MOST_TURNS = 10_000
_MOST_TURNED = _MOST_TURNS * math.tau
"""The largest angle of a timing: there an angle still has twelve digits."""
_STILL = 1e-9
"""The difference of crank angles (rad) by which a timing has to move the crank."""

Pair = Sequence[float]


def path(
    points: ArrayLike,
    closed: bool = True,
    *,
    count: int = COUNT,
    prefer: Preference = "balanced",
    cognates: bool = False,
    rounding: float | None = None,
    driver: Motor = False,
    mirror: str | None = None,
    progress: Callable[[int, int], None] | None = None,
    **options: object,
) -> tuple[Fit, ...]:
    """Return different linkages whose coupler point follows points (n, 2), the best first.

    A closed curve is followed in one turn of the crank, its points in their order; an open one within the
    input's range. They are those of the front of deviation, size and least transmission angle that differ to
    a reader, all within 3 % of the curve's size, or thrice the best deviation. The first is the one to build:
    it can be driven, at 30 degrees at least, where that takes no more than twice the best deviation; the
    others follow from the most exact one on. `prefer` puts the smallest first ("compact"), or those with the
    best transmission angle ("angle"); "exact" asks for the smallest deviations alone.

    `cognates` adds the two Roberts cognates of each four-bar, as far as they keep to the same options; an
    answer that is a cognate of one before it is not listed again.
    `rounding` rounds the lengths to that step one by one, each time fitting the rest again. `driver` gives
    each answer to an open curve whose crank swings a motor that turns fully, or says where that stands, x and
    y. `mirror`, "x=40" or "y=0", adds each answer's mirror image in that line to its scene, geared to its
    crank: both fingers of a gripper. Other options are described below. BadInput for points or limits that
    make no sense, and if no linkage was found that keeps to the limits.
    """
    refuse_count(count)
    if cognates and options.get("kind", "four-bar") != "four-bar":
        raise BadInput(f"a {options['kind']} has no cognates; leave them out, or take a four-bar")
    if prefer not in PREFERENCES:
        raise BadInput(f"prefer={shown(prefer)}: take {', '.join(PREFERENCES[:-1])} or {PREFERENCES[-1]}")
    place, line = place_of(driver), mirror_of(mirror)
    if driver is not False and closed:
        raise BadInput("along a closed curve every crank turns fully, so it needs no driver; leave that out")
    task = task_of(points, closed, **options)  # type: ignore[arg-type]
    if rounding is not None and not (can_be_computed(rounding) and rounding > 0):
        raise BadInput(f"rounding to {rounding!r}: give a length above zero, such as 0.1")
    steps = itertools.count(1)
    pulse = (lambda: progress(next(steps), 0)) if progress else unwatched
    chosen = task.thinned(_SEARCHED)
    few = task.among(chosen)
    fits = best_fits(few, count, pulse)
    most_exact = fits[0]
    if prefer != "exact":
        front = preferred(searched_front(few, fits, pulse), prefer)
        fits = cards(front, front[0], count) if prefer == "balanced" else tuple(differing(front, count))
    if rounding is not None:
        fits = with_round_lengths(fits, rounding, pulse)
        fits = fits if prefer == "exact" else tuple(preferred(fits, prefer))
    fits = _with_cognates(fits, rounding, pulse) if cognates else fits
    best, *others = _at_all_points(task, [most_exact, *fits], chosen, pulse)
    listed = [replace(fit, most_exact=best or fit) for fit in others if fit]
    if not listed:
        raise BadInput(none_fits(task))
    marked = with_cognates_marked(listed)
    return paired(marked if driver is False else all_driven(marked, place, _on_the_way), line)


def _on_the_way(fit: Fit) -> Real | None:
    """Return the crank's angles from point to point; None where it passes its limits on the way."""
    return fit.angles if fit.phases is None else None


def front_behind(fits: Sequence[Fit], pulse: Pulse = unwatched) -> tuple[Fit, ...]:
    """Return the whole front from which answers of `path` were chosen, the most exact first."""
    task = fits[0].task
    chosen = task.thinned(_SEARCHED)
    checked = _at_all_points(task, searched_front(task.among(chosen), pulse=pulse), chosen, pulse)
    return front_of([*fits, *filter(None, checked)])


def _at_all_points(task: PathTask, fits: Iterable[Fit], chosen: Indices, pulse: Pulse) -> list[Fit | None]:
    """Return answers to the task among chosen points as they are at all points; None for one that is none."""
    if len(chosen) == len(task.curve.points):
        return list(fits)
    checked = list[Fit | None]()
    for fit in fits:
        pulse()
        checked.append(checked_again(task, fit, chosen))
    return checked


def _with_cognates(fits: Sequence[Fit], rounding: float | None, pulse: Pulse) -> tuple[Fit, ...]:
    """Return each answer, followed by its cognates; no linkage is listed twice."""
    listed: list[Fit] = []
    for fit in fits:
        if all(fit.apart(one) > SAME for one in listed):
            listed += [fit, *_cognates(fit, rounding, pulse)]
    return tuple(listed)


def _cognates(fit: Fit, rounding: float | None, pulse: Pulse) -> Iterator[Fit]:
    """Yield an answer's cognates, in round lengths where its own are."""
    for other in cognates_of(fit.exact or fit):
        pulse()
        cognate = other if rounding is None else rounded_to(other, rounding, pulse)
        yield from [cognate] if cognate else []


def task_of(
    points: ArrayLike,
    closed: bool = True,
    *,
    kind: str = "four-bar",
    timing: float | ArrayLike | None = None,
    free_start: bool | None = None,
    box: Sequence[float] | Sequence[Sequence[float]] | None = None,
    largest: float = LARGEST,
    least_angle: float = 0.0,
    pivots: Sequence[Pair | None] = (),
    lengths: Mapping[str, float] | None = None,
    weights: ArrayLike | None = None,
    exactly: Sequence[int] = (),
    unit: str = "mm",
    name: str = "path",
    source: str = "made by linkanim for a drawn path",
) -> PathTask:
    """Return what is asked for, checked.

    `kind` is "four-bar" or "slider-crank". `timing` is the crank's angle at each point, in radians, or one
    step from each point to the next; with `free_start`, the default for a step, all may be shifted by one
    angle. `box` is x, y, width and height for all pivots, or two of these, for O2 and for O4; `largest` is
    the longest link or side of the coupler in curve sizes, `least_angle` the least transmission angle in
    radians. `pivots` are O2 and O4, None for one that is free; `lengths` fixes some of the parameters of the
    kind. `weights` (n,) say how much each point counts, and `exactly` lists the points to pass exactly.
    """
    if kind not in KINDS:
        raise BadInput(f"kind={shown(kind)}: take {' or '.join(KINDS)}")
    units.metre(unit)
    chosen = KINDS[kind]
    curve = drawn(points, closed=closed, timed=timing is not None)
    requirements = Requirements.of(
        curve.size,
        "curve sizes",
        largest=largest,
        least_angle=least_angle,
        boxes=_boxes(box, chosen),
        given=_given(chosen, pivots, lengths or {}),
    )
    _refuse_contradictions(chosen, requirements)
    angles, free = _timing(timing, free_start, len(curve.points))
    return PathTask(
        curve, chosen, requirements, _weights(weights, exactly, curve), angles, free, unit, name, source
    )


def _given(
    kind: LinkageKind, pivots: Sequence[Pair | None], lengths: Mapping[str, float]
) -> dict[str, float]:
    """Return the given parameters by name."""
    given: dict[str, float] = {}
    if len(pivots) > len(kind.pins):
        raise BadInput(f"a {kind.name} has {len(kind.pins)} fixed pins; {len(pivots)} are given")
    for start, pivot in zip(kind.pins, pivots, strict=False):
        if pivot is not None:
            given |= {kind.parameters[start]: float(pivot[0]), kind.parameters[start + 1]: float(pivot[1])}
    own = [name for name in kind.parameters if name not in ("x", "y", "x4", "y4")]
    for name, value in lengths.items():
        if name not in own:
            known = f"{', '.join(own)}{meant(name, own)}"
            raise BadInput(f"{shown(name)} is no length of a {kind.name}; take {known}")
        given[name] = float(value)
    for name, value in given.items():
        if not can_be_computed(value) or (name in kind.links and value <= 0):
            raise BadInput(f"{name}={value!r}: give {NUMBERS}, for a link's length above zero")
    return given


def _refuse_contradictions(kind: LinkageKind, limits: Requirements) -> None:
    """Raise BadInput for given values that break a limit whatever the other parameters are."""
    given = limits.given
    for name in kind.links:
        if given.get(name, 0.0) > limits.largest:
            raise BadInput(
                f"the given {name} of {given[name]:g} is longer than the longest link, {limits.largest:g}; "
                "raise that, or give a shorter one"
            )
    for n, start in enumerate(kind.pins if limits.boxes else ()):
        x, y = (given.get(name) for name in kind.parameters[start : start + 2])
        if (
            x is not None
            and y is not None
            and not holds(limits.boxes[min(n, len(limits.boxes) - 1)], complex(x, y))
        ):
            raise BadInput(f"the given pivot at {x:g}, {y:g} lies outside of its box; move one of them")


def _boxes(box: Sequence[float] | Sequence[Sequence[float]] | None, kind: LinkageKind) -> tuple[Box, ...]:
    """Return the box for all pins, or one for each of them."""
    boxes = boxes_of(box)
    if len(boxes) > 1 and len(boxes) != len(kind.pins):
        pins = f"{len(kind.pins)} fixed pin" + "s" * (len(kind.pins) > 1)
        raise BadInput(
            f"{len(boxes)} boxes are given, and a {kind.name} has {pins}; give one box, or one for each pin"
        )
    return boxes


def _timing(timing: float | ArrayLike | None, free: bool | None, count: int) -> tuple[Real | None, bool]:
    """Return the crank's angle at each point, and whether all of them may be shifted by one angle."""
    if timing is None:
        return None, True
    angles = np.asarray(timing, dtype=np.float64)
    if angles.ndim == 0:
        if not np.isfinite(angles) or angles == 0:
            raise BadInput("the step of the timing is zero or not finite; give an angle such as 20 deg")
        angles, free = angles * np.arange(count), free is not False
    if angles.shape != (count,) or not np.isfinite(angles).all():
        raise BadInput(f"timing has {angles.size} angles for {count} points; give each point a finite one")
    if np.abs(angles).max() > _MOST_TURNED:
        raise BadInput(f"the timing goes beyond {_MOST_TURNS:,} turns of the crank; leave whole turns out")
    if np.abs(np.exp(1j * (angles - angles[0])) - 1).max() < _STILL:
        raise BadInput("by this timing the crank is at one angle at all points; give angles that differ")
    return angles, bool(free)


def _weights(weights: ArrayLike | None, exactly: Sequence[int], curve: DrawnCurve) -> Real:
    """Return the points' weights, their mean 1 before the exact ones are raised."""
    count = len(curve.points)
    shares: Real = np.ones(count) if weights is None else np.array(weights, dtype=np.float64)
    if shares.shape != (count,) or not (np.isfinite(shares) & (shares >= 0)).all() or not shares.any():
        raise BadInput(f"weights: give {count} numbers of zero or more, not all zero, one for each point")
    shares /= shares.mean()
    for point in exactly:
        if not 0 <= point < count:
            raise BadInput(f"exactly: there is no point {point}; the points are 0 to {count - 1}")
        shares[point] = EXACTLY
    return shares
