"""The table of tests/bench/peers.py once more, by a numpy that leaves AVX-512 alone, as on most laptops."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from linkanim.bench.result import this_machine

PEERS = Path(__file__).parents[1] / "bench" / "peers.py"


def main() -> int:
    """Print the table of a process of its own, and return its exit code."""
    wide = [name for name in this_machine().features if name.startswith("AVX512") or name == "X86_V4"]
    with TemporaryDirectory() as folder:
        command = [sys.executable, str(PEERS), "--into", folder]
        env = {**os.environ, "NPY_DISABLE_CPU_FEATURES": " ".join(wide)}
        return subprocess.run(command, env=env, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
