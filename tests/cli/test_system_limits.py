"""Few open files and little memory: a command that cannot go on ends in one line with the reason."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits as Linux has them")

LIMITED = """
import resource, sys
resource.setrlimit(getattr(resource, sys.argv.pop(1)), (int(sys.argv.pop(1)),) * 2)
from linkanim.__main__ import main
sys.exit(main())
"""
LARGE = ("draw", "press", "--size", "3840x2160", "--phase", "1 rad", "-o")
RECORD = ("record", "kite", "--size", "64x36", "--seconds", "0.1", "-o")


# Enough files for the program but not for an encoder's pipes, or for a list; memory for Python but not for
# numpy, and for numpy but not for the threads of its OpenBLAS, which says itself that it has no memory.
@pytest.mark.thinned(3)
@pytest.mark.parametrize(
    ("limit", "value", "words", "message"),
    [
        pytest.param("RLIMIT_NOFILE", 8, (*RECORD, "a.gif"), "too many open files", id="gif"),
        pytest.param("RLIMIT_NOFILE", 5, (*RECORD, "a.mp4"), "too many open files", id="mp4"),
        pytest.param("RLIMIT_NOFILE", 4, ("report", "kite", "-o", "a"), "too many open files", id="report"),
        pytest.param("RLIMIT_AS", 60_000_000, ("info", "kite"), "not enough memory", id="numpy"),
        pytest.param("RLIMIT_AS", 85_000_000, ("info", "kite"), "memory", id="threads"),
        pytest.param("RLIMIT_AS", 205_000_000, (*LARGE, "a.png"), "not enough memory", id="surface"),
    ],
)
@pytest.mark.slow
def test_what_the_system_limits_is_said_in_one_line(
    limit: str, value: int, words: tuple[str, ...], message: str, tmp_path: Path
) -> None:
    command = [sys.executable, "-P", "-c", LIMITED, limit, str(value), *words]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert message in done.stderr.lower()
    assert (done.returncode, done.stderr.count("\n"), done.stdout) == (1, 1, "")
    assert list(tmp_path.iterdir()) == []
