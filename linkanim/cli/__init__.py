"""The `linkanim` command."""

from __future__ import annotations

from collections.abc import Sequence

from linkanim.cli.exits import guarded


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line `argv` (default: the process's own) and return its exit code.

    0 done; 2 bad input or usage; 1 the work failed; 130 Ctrl-C; 143 SIGTERM; 129 SIGHUP. What went wrong
    is one line on stderr.
    """
    return guarded(lambda: _run(argv))


def _run(argv: Sequence[str] | None) -> None:
    # Imported here so that Ctrl-C during start-up is answered like any other.
    from linkanim.cli import command_table as commands

    commands.run(commands.parse(argv))
