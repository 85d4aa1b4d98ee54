"""`--alt`: what a picture shows, in a paragraph, in a file beside it."""

from __future__ import annotations

import re
from argparse import Namespace
from collections.abc import Callable

from linkanim.cli.options import inputs_of
from linkanim.manifest import checked_output


def plain(words: str) -> str:
    """Return words that are typeset as plain text, which has no subscripts of words: θ of rod for θ_{rod}."""
    return re.sub(r"_\{([^{}]*)\}", r" of \1", words)


def alternative(options: Namespace) -> Callable[[str], None]:
    """Return a function that writes a text to the file of `--alt` and prints its path, or that does nothing.

    `BadInput` for a file that cannot be written, before any work.
    """
    if options.alt is None:
        return lambda _: None
    ours = getattr(options, "no_clobber", False)
    target = checked_output(options.alt, "", (".txt",), inputs_of(options), ours=ours)

    def written(words: str) -> None:
        with target.replacing() as part:
            part.write_text(f"{plain(words)}\n", encoding="utf-8")
        print(target.path)

    return written
