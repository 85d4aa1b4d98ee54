"""Random good scenes, each made into outputs within limits; also a process of its own, which a fault may end.

    python tests/sweep/oracle.py SEED FIRST STEP COUNT FOLDER [SECONDS]

prints the number of each scene before it is made into anything, and a line for each fault. FOLDER is one
that exists, to work in. SECONDS of processor time are what an output may take: 10 on a quiet machine.
"""

from __future__ import annotations

import os
import subprocess
import sys
import warnings
from collections.abc import Callable, Iterator
from itertools import count, islice
from pathlib import Path
from random import Random
from typing import Any

if __name__ == "__main__":  # pytest finds the helpers in these folders by its own settings
    sys.path[:0] = [str(Path(__file__).parents[1] / folder) for folder in ("sweep", "tally", "player")]
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")  # its greeting would stand among the faults
    os.environ.setdefault("SDL_VIDEODRIVER", "dummy")

from limits import Limits
from outputs import MEGABYTES, OUTPUTS, SECONDS, Case, Output, is_good, written
from playing import fake_start
from random_scenes import scene
from typed_linkages import Document

from linkanim import child
from linkanim.player import background

ALWAYS = ("checked", "solved", "held", "swept")
SHARES = {
    "charted": 6,
    "classified": 4,
    "drawn": 3,
    "painted": 3,
    "printed_rows": 2,
    "explained": 4,
    "shared": 3,
    "asked": 2,
    "latexed": 2,
    "crowded": 1,
    "printed": 1,
    "framed": 1,
    "filmed": 1,
    "recorded": 1,
    "reported": 1,
    "laid": 2,
    "cut": 2,
    "constructed": 3,
    "described": 2,
    "examined": 2,
    "platformed": 2,
    "measured": 2,
    "found_again": 3,
    "taped": 1,
    "played": 1,
}
"""How many of 55 scenes are made into each of the outputs: more into what takes little time."""
ROTATION = tuple(name for name, share in SHARES.items() for _ in range(share))


_PATIENCE = 3 * SECONDS
"""Seconds in a test, whose machine may be slower than ours and is shared: it looks for what does not end."""


start_nothing: Callable[..., Any] = fake_start([])
"""What a window starts here for a process: a recording has ended well, a search for layers has failed."""


def made(seed: int, number: int) -> Document:
    """Return the document of a scene that a fault names."""
    return scene(seed, number)[1]


def good_scenes(seed: int, first: int = 0, step: int = 1) -> Iterator[int]:
    """Yield the numbers of the scenes that the reader takes, or cannot read within the limits."""
    return (number for number in count(first, step) if _is_good(made(seed, number)))


def _is_good(document: Document) -> bool:
    try:
        with Limits(SECONDS, MEGABYTES).held():
            return is_good(document)
    except Exception:
        return True  # to be checked, and found at fault


def output_of(number: int) -> str:
    """Return the one output that a scene is made into beside those that all are."""
    return ROTATION[number % len(ROTATION)]


def faults(
    seed: int, number: int, folder: Path, output: str | None = None, seconds: float = _PATIENCE
) -> list[str]:
    """Return a line for every output that could not be made of a scene, with its seed and number.

    Each scene is checked, solved and swept, and made into the one output that its number chooses, unless
    that is named.
    """
    words, document = scene(seed, number)
    limits = Limits(seconds, MEGABYTES)
    case = written(document, folder / str(number), Random(f"{seed}:{number}"))
    reasons = {name: fault(OUTPUTS[name], case, limits) for name in (*ALWAYS, output or output_of(number))}
    case.clear()
    return [f"made({seed}, {number}), {words}: {name}: {why}" for name, why in reasons.items() if why]


def fault(output: Output, case: Case, limits: Limits) -> str | None:
    """Return why an output cannot be made of a scene within the limits; None where it can."""
    try:
        with limits.held():
            output(case)
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return None


def faults_apart(seed: int, first: int, step: int, most: int, folder: Path) -> list[str]:
    """Return the faults of so many good scenes, made in a process of their own, and how that ended if ill."""
    words = (str(word) for word in (seed, first, step, most, folder, _PATIENCE))
    done = subprocess.run(
        [sys.executable, "-P", __file__, *words],
        env={**child.env(), **child.ONE_CORE},
        capture_output=True,
        text=True,
        check=False,
    )
    lines = done.stdout.splitlines()
    found = [line for line in lines if not line.isdecimal()]
    if done.returncode:
        last = next((line for line in reversed(lines) if line.isdecimal()), first)
        found.append(f"made({seed}, {last}): the process ended with {done.returncode}: {done.stderr[-2000:]}")
    return found


def main(seed: int, first: int, step: int, most: int, folder: Path, seconds: float) -> None:
    """Print the number of each of so many good scenes, and its faults."""
    warnings.simplefilter("error")
    for number in islice(good_scenes(seed, first, step), most):
        print(number, flush=True)
        for line in faults(seed, number, folder, seconds=seconds):
            print(" ".join(line.split()), flush=True)


if __name__ == "__main__":
    background._start = start_nothing
    seed, first, step, most = map(int, sys.argv[1:5])
    main(seed, first, step, most, Path(sys.argv[5]), float(sys.argv[6]) if sys.argv[6:] else SECONDS)
