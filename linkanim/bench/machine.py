"""Where figures were measured: without it they mean nothing."""

from __future__ import annotations

import os
import platform
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np


class Machine(NamedTuple):
    """The processor, how many cores of it there are, the versions that count.

    `features` are the vector units beyond the least that this numpy runs on and uses, by its names.
    """

    cpu: str
    cores: int
    python: str
    numpy: str
    features: tuple[str, ...] = ()

    @property
    def line(self) -> str:
        """The same in one line."""
        units = ", ".join(self.features) or "no further vector units"
        versions = f"Python {self.python}, numpy {self.numpy} with {units}"
        return f"{self.cpu}, {self.cores} cores, {versions}, one thread"


def this_machine() -> Machine:
    """Return what this process runs on."""
    return Machine(_cpu(), os.cpu_count() or 1, platform.python_version(), np.__version__, _features())


def _features() -> tuple[str, ...]:
    built: Any = np.show_config(mode="dicts")
    return tuple(built.get("SIMD Extensions", {}).get("found", ()))


def _cpu() -> str:
    """Return the processor's name, as Linux tells it, else as Python does."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(named, "") or platform.processor() or platform.machine()
