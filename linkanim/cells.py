"""Columns of numbers as text, for CSV and JSON alike: every digit that a float has, and no more."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from io import StringIO

import numpy as np
from numpy.typing import ArrayLike

NULL = "null"
"""What stands where a number is not finite."""
_RUN = ("=", "+", "-", "@", "\t", "\r")
"""What a text begins with that a spreadsheet takes for a formula."""


def lines(columns: Sequence[ArrayLike]) -> list[str]:
    """Return the numbers of each row with commas between, each in the fewest digits that read back as it is.

    What is not finite is `null`.
    """
    import orjson

    block = np.stack([np.asarray(column, np.float64) for column in columns], axis=1)
    if not block.size:
        return []
    return orjson.dumps(block, option=orjson.OPT_SERIALIZE_NUMPY).decode()[2:-2].split("],[")


def csv_head(names: Iterable[str]) -> str:
    """Return a table's first line: what its columns are called, each fit for a spreadsheet.

    A name that one would run, such as "=A1", has an apostrophe in front.
    """
    text = StringIO()
    csv.writer(text, lineterminator="\n").writerow(
        f"'{name}" if name.startswith(_RUN) else name for name in names
    )
    return text.getvalue()


def csv_rows(columns: Sequence[ArrayLike]) -> str:
    """Return a table's rows; what is not finite is an empty cell."""
    text = "".join(f"{line}\n" for line in lines(columns))
    return text if all(np.isfinite(column).all() for column in columns) else text.replace(NULL, "")
