"""A result as a table for the terminal or the README, and as JSON."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from typing import Any

from linkanim.bench.accuracy import Score
from linkanim.bench.result import Measured, Result, Target

TITLES = ("method", "ns a pose", "with derivatives", "worst error, easy", "hard", "wrong closure", "NaN")
NOTE = (
    "Four-bar with coupler point. ns a pose: processor time, medians of runs in turn. Errors in longest "
    "links, against 50 digits, of poses on the right closure; wrong closure and NaN: of {poses:,} hard poses."
)

Lines = Sequence[Sequence[str]]


def as_text(result: Result) -> str:
    """Return the machine, the table and the targets in aligned columns."""
    return "\n\n".join(
        [
            result.machine.line,
            columns(lines(result)),
            NOTE.format(poses=result.rows[0].hard.poses),
            columns(target_lines(result.targets)),
        ]
    )


def as_markdown(result: Result) -> str:
    """Return the table and where it was measured, for the README."""
    head, *body = lines(result)
    rule = ["---", *["---:"] * (len(head) - 1)]
    table = "\n".join(f"| {' | '.join(line)} |" for line in (head, rule, *body))
    note = NOTE.format(poses=result.rows[0].hard.poses)
    return f"{table}\n\n{note} Measured on {result.machine.line}.\n"


def lines(result: Result) -> list[Sequence[str]]:
    """Return the titles and a line for each method."""
    return [TITLES, *(_line(row) for row in result.rows)]


def _line(row: Measured) -> Sequence[str]:
    times = (_time(row.position_ns), "" if row.derivatives_ns is None else _time(row.derivatives_ns))
    errors = (_error(row.easy.error), _error(row.hard.error))
    return (row.name, *times, *errors, f"{row.hard.wrong:,}", f"{row.hard.missing:,}")


def target_lines(targets: Sequence[Target]) -> list[Sequence[str]]:
    """Return the titles and a line for each target."""
    rows = [
        (
            target.what,
            f"{target.measured:.3g} {target.unit}",
            f"{'≥' if target.least else '≤'} {target.bound:g} {target.unit}",
            "met" if target.met else "missed",
        )
        for target in targets
    ]
    return [("target", "measured", "bound", ""), *rows]


def columns(rows: Lines) -> str:
    """Return rows in columns, the first to the left, the others to the right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    aligned: Sequence[Callable[[str, int], str]] = (str.ljust, *[str.rjust] * (len(widths) - 1))
    return "\n".join(
        "  ".join(put(cell, width) for put, cell, width in zip(aligned, row, widths, strict=True)).rstrip()
        for row in rows
    )


def _time(nanos: float) -> str:
    return f"{nanos:,.1f}" if nanos < 100 else f"{float(f'{nanos:.3g}'):,.0f}"


def _error(error: float) -> str:
    return "none right" if math.isnan(error) else f"{error:.1e}"


def as_json(result: Result) -> str:
    """Return one object: machine, rows with every case, targets; errors in longest links, null where none."""
    found = {
        "machine": result.machine._asdict(),
        "rows": [_row(row) for row in result.rows],
        "targets": [
            {
                "what": target.what,
                "measured": target.measured,
                "least" if target.least else "most": target.bound,
                "unit": target.unit,
                "met": target.met,
            }
            for target in result.targets
        ],
    }
    return json.dumps(found, indent=2, ensure_ascii=False, allow_nan=False)


def _row(row: Measured) -> dict[str, Any]:
    return {
        "key": row.key,
        "method": row.name,
        "source": row.source,
        "ns_position": row.position_ns,
        "ns_derivatives": row.derivatives_ns,
        "easy": _score(row.easy),
        "hard": _score(row.hard),
        "cases": {name: _score(score) for name, score in row.cases.items()},
    }


def _score(score: Score) -> dict[str, Any]:
    error = None if math.isnan(score.error) else score.error
    return {"poses": score.poses, "error": error, "wrong": score.wrong, "nan": score.missing}
