"""`linkanim bench`: speed against error."""

from __future__ import annotations

from argparse import Namespace

from linkanim.bench import command
from linkanim.cli.progress import bar


def run(options: Namespace) -> None:
    """Measure what was asked, and print it."""
    with bar(unit=" rounds") as progress:
        command.run(options, progress)
