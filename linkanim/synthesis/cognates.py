"""Roberts's theorem: every coupler curve of a four-bar is traced by two further four-bars.

With the coupler point P = A + k·(B - A) in complex numbers, the third pivot is O6 = O2 + k·(O4 - O2). One
cognate stands on O2 and O6 with the parallelogram O2 A P A', the other on O6 and O4 with O4 B P B'; each has
a coupler similar to the first one's (Roberts 1875, Chebyshev 1878).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from linkanim.synthesis.check import checked, checked_by_phase
from linkanim.synthesis.fit import Fit
from linkanim.synthesis.kinds import Complex, Linkage4, Real

_TIMED = 1e-9
"""By how much crank angles (rad) may be off those that are given."""
_Joints = tuple[complex, Complex, Complex, complex]
"""A pivot, the pins of its crank (n,) and of the rocker (n,), and that one's pivot."""


def cognates_of(fit: Fit) -> Iterator[Fit]:
    """Yield a four-bar's two cognates, driven at O6 or O2, as far as they are answers to the same task.

    One may be a double-rocker, whose curve then is that of both its closures; one of which a link would
    vanish, as where the coupler point is a pin, is left out, as is what breaks a limit or the timing.
    """
    point = fit.task.kind.points(fit.row[None], np.array([fit.closure_sign]), fit.angles[None])[0]
    for pivot, crank, rocker, other in _cognates(fit, point):
        first = Linkage4(pivot, crank[0], rocker[0], other, point[0])
        with np.errstate(all="ignore"):
            row = np.array(first.row)
        angles = _timed(fit, np.unwrap(np.angle(crank - pivot)))
        if angles is None or not np.isfinite(row).all():
            continue
        closures = np.where((np.conj(other - crank) * (rocker - crank)).imag >= 0, 1.0, -1.0)
        task = fit.task if fit.task.curve.closed else fit.task.swinging()
        found = checked(task, row, first.closure, angles) or checked_by_phase(task, row, closures, angles)
        yield from [replace(found, cognate=True)] if found else []


def _timed(fit: Fit, angles: Real) -> Real | None:
    """Return crank angles at the points, whole turns nearer to those given; None where they are not."""
    task = fit.task
    if task.timing is None:
        return angles
    late = angles - task.timing
    if task.free_start:
        late = late - late[0]
    turns = np.round(late / (2 * np.pi)) * 2 * np.pi
    return angles - turns if np.abs(late - turns).max() <= _TIMED else None


def _cognates(fit: Fit, point: Complex) -> tuple[_Joints, _Joints]:
    """Return both cognates' joints at the points: whose crank turns as the first one's, and the other."""
    x, y, crank, coupler, along, across, x4, y4, _ = fit.row
    o2, o4 = complex(x, y), complex(x4, y4)
    share = complex(along, across) / coupler
    o6 = o2 + share * (o4 - o2)
    pin_a = o2 + crank * np.exp(1j * fit.angles)
    pin_b = pin_a + (point - pin_a) / share if share else pin_a
    first = o6, o6 + (1 - share) * (pin_a - o2), o4 + point - pin_b, o4
    second = o2, o2 + point - pin_a, o6 + share * (pin_b - o4), o6
    return first, second
