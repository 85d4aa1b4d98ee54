"""The benchmark once more, in a process of its own whose numpy leaves AVX-512 alone, as most laptops must."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from tempfile import TemporaryDirectory

from linkanim.bench.process import printed_by

DISABLE = "NPY_DISABLE_CPU_FEATURES"


def wide(features: Sequence[str]) -> tuple[str, ...]:
    """Return those features of numpy's that are AVX-512, under its older names and its newer ones."""
    return tuple(name for name in features if name.startswith("AVX512") or name == "X86_V4")


def environment(features: Sequence[str]) -> Mapping[str, str]:
    """Return the environment of a process whose numpy leaves these features alone."""
    return {**os.environ, DISABLE: " ".join(features)}


def printed(features: Sequence[str], form: Sequence[str]) -> str:
    """Return what `linkanim bench` prints without these features; WorkFailed where it fails."""
    with TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "linkanim", "bench", *form, "--into", folder]
        what = f"the benchmark without {' '.join(features)}"
        return printed_by(command, what, env=environment(features)).rstrip("\n")
