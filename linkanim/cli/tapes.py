"""Tapes recorded one after the other: what a window that closes leaves to be done."""

from __future__ import annotations

import sys

from linkanim.cli import main
from linkanim.cli.exits import DONE, FAILED

_GO_ON = (DONE, FAILED, 2)
"""A tape that cannot be recorded does not keep the others from it; a signal does."""


def record_all(words: list[str]) -> int:
    """Record TAPE TARGET TAPE TARGET ... in turn; return the last exit code."""
    code = DONE
    for tape, target in zip(words[::2], words[1::2], strict=True):
        code = main(["record", tape, "-o", target])
        if code not in _GO_ON:
            break
    return code


if __name__ == "__main__":
    sys.exit(record_all(sys.argv[1:]))
