"""Answers in round lengths: one length after the other is rounded and held, and the rest is fitted again."""

from __future__ import annotations

import math
from dataclasses import replace

from linkanim.errors import BadInput
from linkanim.synthesis.fit import Fit
from linkanim.synthesis.search import best_of, refitted
from linkanim.synthesis.task import PathTask


def with_round_lengths(fits: tuple[Fit, ...], step: float) -> tuple[Fit, ...]:
    """Return answers whose lengths and pivots are multiples of a step, the best first.

    Each knows what it was before (`exact`). BadInput where nothing that follows the curve is left.
    """
    found = [fit for fit in (rounded_to(fit, step) for fit in fits) if fit is not None]
    if not found:
        raise BadInput(f"rounded to {step:g} no linkage is left that follows the curve; take a finer step")
    return best_of(found, len(found))


def rounded_to(fit: Fit, step: float) -> Fit | None:
    """Return an answer in round lengths; None where none is left, as of one that goes through its limits."""
    now: Fit | None = fit
    for name in fit.task.kind.parameters:
        if name == "line_angle" or now is None:
            continue
        held = [_holding(now.task, name, value) for value in _near(now.parameters[name], step)]
        tries = [one for task in held if (one := refitted(task, now))]
        now = min(tries, key=lambda one: one.error, default=None)
    return now and replace(now, task=fit.task, exact=fit, cognate=fit.cognate)


def _near(value: float, step: float) -> tuple[float, float]:
    """Return the multiples of the step below and above, as decimals."""
    digits = max(0, 12 - math.floor(math.log10(step)))
    low = math.floor(value / step)
    return round(low * step, digits), round((low + 1) * step, digits)


def _holding(task: PathTask, name: str, value: float) -> PathTask:
    given = {**task.requirements.given, name: value}
    return replace(task, requirements=replace(task.requirements, given=given))
