"""Roberts's theorem: every coupler curve of a four-bar is traced by two further four-bars.

With the coupler point P = A + k·(B - A) in complex numbers, the third pivot is O6 = O2 + k·(O4 - O2). One
cognate stands on O2 and O6 with the parallelogram O2 A P A', the other on O6 and O4 with O4 B P B'; each
has a coupler similar to the first one's (Roberts 1875, Chebyshev 1878).
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Places = TypeVar("Places", complex, NDArray[np.complex128])
CognateJoints = tuple[complex, Places, Places, complex]
"""A cognate's crank pivot, crank pin, rocker pin and rocker pivot, as x + yi."""


def cognate_joints(
    pivots: tuple[complex, complex], share: complex, pins: tuple[Places, Places, Places]
) -> tuple[CognateJoints[Places], CognateJoints[Places]]:
    """Return both cognates' joints: first the one whose crank turns as the given one's, then the other.

    `pivots` are O2 and O4, `share` is k, and `pins` are A, B and P at one moment or, as arrays, at many.
    """
    (o2, o4), (a, b, p) = pivots, pins
    o6 = o2 + share * (o4 - o2)
    first = (o6, o6 + (1 - share) * (a - o2), o4 + p - b, o4)
    second = (o2, o2 + p - a, o6 + share * (b - o4), o6)
    return first, second
