"""`--alt`: what a picture shows, in a paragraph, in a file beside it."""

from __future__ import annotations

import re
from argparse import Namespace
from collections.abc import Callable
from pathlib import Path

from linkanim.atomic_files import checked_target, write_text
from linkanim.cli.options import inputs_of


def plain(words: str) -> str:
    """Return words that are typeset as plain text, which has no subscripts of words: θ of rod for θ_{rod}."""
    return re.sub(r"_\{([^{}]*)\}", r" of \1", words)


def alternative(options: Namespace) -> Callable[[str], None]:
    """Return a function that writes a text to the file of `--alt` and prints its path, or that does nothing.

    `BadInput` for a file that cannot be written, before any work.
    """
    if options.alt is None:
        return lambda _: None
    target: Path = checked_target(options.alt, (".txt",), inputs_of(options))

    def written(words: str) -> None:
        write_text(target, f"{plain(words)}\n")
        print(target)

    return written
