"""Results as text: CSV and JSON with every digit of a float, and tables to read."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from io import StringIO
from typing import Any
from unicodedata import east_asian_width

import numpy as np
from numpy.typing import ArrayLike

NULL = "null"
"""What JSON has in the place of a number that is not finite."""
_AT_ONCE = 2_000
"""Numbers that become text at once: orjson ends the program where memory ends while it makes a large text."""
_RUN = ("=", "+", "-", "@", "\t", "\r")
"""The first characters of a text that a spreadsheet takes for a formula."""


def lines(columns: Sequence[ArrayLike]) -> list[str]:
    """Return the numbers of each row with commas between, each in the fewest digits that read back the same.

    What is not finite is `null`.
    """
    import orjson

    block = np.stack([np.asarray(column, np.float64) for column in columns], axis=1)
    rows = max(_AT_ONCE // max(block.shape[1], 1), 1)
    texts = (
        orjson.dumps(block[first : first + rows], option=orjson.OPT_SERIALIZE_NUMPY).decode()
        for first in range(0, len(block) if block.size else 0, rows)
    )
    return [line for text in texts for line in text[2:-2].split("],[")]


def csv_head(names: Iterable[str]) -> str:
    """Return a table's first line: what its columns are called, each fit for a spreadsheet.

    A name that it would run as a formula, such as "=A1", has an apostrophe in front.
    """
    import csv

    text = StringIO()
    csv.writer(text, lineterminator="\n").writerow(
        f"'{name}" if name.startswith(_RUN) else name for name in names
    )
    return text.getvalue()


def csv_rows(columns: Sequence[ArrayLike]) -> str:
    """Return a table's rows: what is unbounded is `inf`, what has no value an empty cell."""
    rows, block = lines(columns), np.array([np.asarray(column, np.float64) for column in columns])
    for n in np.flatnonzero(~np.isfinite(block).all(axis=0)).tolist():
        cells = zip(rows[n].split(","), block[:, n].tolist(), strict=True)
        rows[n] = ",".join(
            cell if cell != NULL else "" if math.isnan(number) else f"{number}" for cell, number in cells
        )
    return "".join(f"{line}\n" for line in rows)


def columns(rows: Sequence[Sequence[str]]) -> str:
    """Return rows in aligned columns, the first set to the left, the others to the right."""
    widths = [max(len(text) + _wide(text) for text in column) for column in zip(*rows, strict=True)]
    sides = "<" + ">" * (len(widths) - 1)
    return "\n".join(
        "  ".join(
            f"{text:{side}{width - _wide(text)}}"
            for text, width, side in zip(row, widths, sides, strict=True)
        ).rstrip()
        for row in rows
    )


def _wide(text: str) -> int:
    """Return how many letters of a text take two columns of a terminal, as Chinese ones do."""
    return sum(east_asian_width(letter) in ("W", "F") for letter in text)


def markdown(rows: Sequence[Sequence[str]]) -> str:
    """Return rows as a table of Markdown, the first its titles; all columns but the first to the right."""
    titles, *others = rows
    rule = ["---", *["---:"] * (len(titles) - 1)]
    return "\n".join(f"| {' | '.join(row)} |" for row in (titles, rule, *others))


def json_text(value: object, *, indent: int | None = None) -> str:
    """Return the value as strict JSON; NaN and infinities, at any depth, are null."""
    import json  # a command that prints text ends sooner without

    return json.dumps(mapped(_finite, value), indent=indent, allow_nan=False, ensure_ascii=False)


def _finite(part: object) -> object:
    """Return a value; None in the place of a float that is not finite."""
    if isinstance(part, float):
        return float(part) if math.isfinite(part) else None
    return part


def mapped(change: Callable[[Any], Any], node: Any) -> Any:
    """Return nested mappings and sequences, as dicts and lists, with `change` applied to each value."""
    if isinstance(node, list | tuple):
        return [mapped(change, part) for part in node]
    if isinstance(node, Mapping):
        return {key: mapped(change, part) for key, part in node.items()}
    return change(node)
