"""What a process of its own prints, or why it failed."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping, Sequence

from linkanim.errors import WorkFailed


def printed_by(command: Sequence[str], what: str, *, env: Mapping[str, str] | None = None) -> str:
    """Return what a command prints.

    WorkFailed where it fails: `what` names its work, its last line is the reason.
    """
    done = subprocess.run(command, check=False, env=env, capture_output=True, text=True)
    if done.returncode:
        *_, last = (f"it ended with {done.returncode}", *done.stderr.strip().splitlines())
        raise WorkFailed(f"{what}: {last}")
    return done.stdout
