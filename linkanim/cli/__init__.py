"""The `linkanim` command.

From the ground up; a module imports from those before it only:

    exits              how a command ends: its exit code, and one line on stderr
    options            the arguments of each command, and what their texts mean
    picture_arguments  those of the commands that show pictures, record them or make parts
    picture_options    the options that commands which write pictures share
    alternative        what a picture shows, in a paragraph beside it
    letters            which letters of what was written no font has
    progress           a bar that says how far long work is
    answers            answers of a synthesis, as files and as a table
    tolerances         how far a scene may be off, as tables, an object and a chart
    command_table      every command: what it does, what it takes, which file does its work
    commands           a command a file: what it does once its options are read
"""

from __future__ import annotations

import atexit
import gc
import os
from collections.abc import Sequence

from linkanim.cli.exits import guarded

SPARED = 100_000
"""New objects, less those freed, between two garbage collections: at the start nearly all of them stay."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line `argv` (default: the process's own) and return its exit code.

    0 done; 2 bad input or usage; 1 the work failed; 130 Ctrl-C; 143 SIGTERM; 129 SIGHUP. What went wrong
    is one line on stderr.
    """
    return guarded(lambda: _run(argv))


def _run(argv: Sequence[str] | None) -> None:
    gc.set_threshold(SPARED)
    atexit.register(gc.freeze)  # else Python looks through all objects once more before it ends
    os.umask(os.umask(0o077) & 0o077)  # what we begin we have to be able to finish, and to replace
    # Imported here so that Ctrl-C during start-up is answered like any other.
    from linkanim.cli import command_table as commands

    commands.run(commands.parse(argv))
