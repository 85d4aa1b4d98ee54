"""Where figures were measured: without it they mean nothing."""

from __future__ import annotations

import os
import platform
from pathlib import Path
from typing import NamedTuple

import numpy as np


class Machine(NamedTuple):
    """The processor, how many cores of it there are, and the versions that count."""

    cpu: str
    cores: int
    python: str
    numpy: str

    @property
    def line(self) -> str:
        """The same in one line."""
        return f"{self.cpu}, {self.cores} cores, Python {self.python}, numpy {self.numpy}, one thread"


def this_machine() -> Machine:
    """Return what this process runs on."""
    return Machine(_cpu(), os.cpu_count() or 1, platform.python_version(), np.__version__)


def _cpu() -> str:
    """Return the processor's name, as Linux tells it, else as Python does."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(named, "") or platform.processor() or platform.machine()
