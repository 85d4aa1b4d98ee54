"""A text file that appears under its name when it is whole, or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from linkanim.errors import BadInput, WorkFailed


def refuse_unwritable(path: Path) -> None:
    """Raise `BadInput` where `path` is a folder or lies in one that is not there."""
    if path.is_dir():
        raise BadInput(f"{path} is a folder; give the name of a file in it")
    if not path.parent.is_dir():
        raise BadInput(f"{path}: there is no folder {path.parent}; make it first, or choose another")


@contextmanager
def written(path: Path) -> Iterator[TextIO]:
    """Give a file to write to; it takes its name when the block ends well, and is gone otherwise.

    `BadInput` as `refuse_unwritable`; `WorkFailed` where the disk or the folder refuses.
    """
    refuse_unwritable(path)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with part.open("w", encoding="utf-8", newline="") as file:
            yield file
        part.replace(path)
    except OSError as error:
        raise WorkFailed(f"{path} was not written: {error.strerror or error}") from error
    finally:
        part.unlink(missing_ok=True)
