"""The bits of every scene's motion: one hash a scene, and how poses alone and in batches are compared.

`python tests/mechanics/bits.py` prints the hashes; with --write it keeps them beside this file, which is
what a change of the formulas asks for.
"""

from __future__ import annotations

import hashlib
import json
import math
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene

KEPT = Path(__file__).with_name("bits.json")
KINDS = (
    "position",
    "velocity",
    "acceleration",
    "com_position",
    "com_velocity",
    "com_acceleration",
    "angular_velocity",
    "angular_acceleration",
    "travel",
    "travel_velocity",
    "travel_acceleration",
)
PHASES = np.random.default_rng(7).uniform(-2 * math.pi, 40 * math.pi, 500)


def rows(motion: Any) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """Yield every quantity that the formulas give, by its name; of a pose, as it is in a batch of one."""
    for kind in KINDS:
        for name, values in getattr(motion, kind).items():
            yield f"{kind} of {name}", np.asarray(values, dtype=np.float64)
    for name, strut in (*motion.spring.items(), *motion.damper.items()):
        for what in ("length", "rate", "force"):
            values = getattr(strut, what)
            if values is not None:
                yield f"{what} of {name}", np.asarray(values, dtype=np.float64)


def hash_of(scene: Scene) -> str:
    """Return the hash of the scene's motion at 500 phases over twenty turns."""
    found = hashlib.sha256()
    for name, values in rows(scene.solve(phase=PHASES)):
        found.update(name.encode())
        found.update(np.ascontiguousarray(values).astype("<f8").tobytes())
    return found.hexdigest()


def hashes() -> dict[str, str]:
    """Return each scene's hash by its name."""
    return {name: hash_of(load(name)) for name in names()}


if __name__ == "__main__":
    text = json.dumps(hashes(), indent=1) + "\n"
    if "--write" in sys.argv:
        KEPT.write_text(text)
    sys.stdout.write(text)
