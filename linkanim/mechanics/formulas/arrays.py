"""Types of the arrays that hold what is computed."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Floats = NDArray[np.floating[Any]]
"""Results in double precision, or in any other."""
Bools = NDArray[np.bool_]
