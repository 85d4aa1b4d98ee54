"""A result as a table for the terminal or the README, and as JSON."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict

from linkanim.bench.accuracy import Score
from linkanim.bench.result import Measured, Result
from linkanim.export import columns, json_text, markdown

TITLES = (
    "method",
    "ns a pose",
    "with derivatives",
    "easy: position, velocity, acceleration",
    "hard",
    "wrong closure",
    "NaN",
)
NOTE = (
    "ns a pose: processor time, medians of runs in turn. Errors against 50 digits and more, the worst of all "
    "joints: positions in longest links, rates in longest links or the pose's largest rate, of poses on the "
    "right closure; wrong closure and NaN: of {poses} hard poses."
)


def as_text(result: Result) -> str:
    """Return the machine and the tables in aligned columns."""
    tables = [f"{name}\n{columns([TITLES, *rows])}" for name, rows in _by_mechanism(result)]
    return "\n\n".join([result.machine.line, *tables, _note(result)])


def as_markdown(result: Result) -> str:
    """Return the table, its mechanisms one after the other, and where it was measured, for the README."""
    blank = [""] * (len(TITLES) - 1)
    rows = [line for name, lines in _by_mechanism(result) for line in ([f"**{name}**", *blank], *lines)]
    return f"{markdown([TITLES, *rows])}\n\n{_note(result)} Measured on {result.machine.line}.\n"


def _by_mechanism(result: Result) -> Iterator[tuple[str, list[Sequence[str]]]]:
    """Yield each mechanism's name and its lines."""
    for name in dict.fromkeys(row.mechanism for row in result.rows):
        yield name, [_line(row) for row in result.rows if row.mechanism == name]


def _note(result: Result) -> str:
    poses = {row.mechanism: row.hard.poses for row in result.rows}
    return NOTE.format(poses=", ".join(f"{count:,} ({name})" for name, count in poses.items()))


def _line(row: Measured) -> Sequence[str]:
    times = (_time(row.ns_position), "" if row.ns_derivatives is None else _time(row.ns_derivatives))
    return (
        row.method,
        *times,
        _errors(row.easy),
        _errors(row.hard),
        f"{row.hard.wrong:,}",
        f"{row.hard.nan:,}",
    )


def _time(nanos: float) -> str:
    return f"{nanos:,.1f}" if nanos < 100 else f"{float(f'{nanos:.3g}'):,.0f}"


def _errors(score: Score) -> str:
    """Return the errors of position and, where there are any, of rates; beyond 1 they mean nothing."""
    if math.isnan(score.error):
        return "none right"
    return ", ".join(
        "> 1" if error > 1 else f"{error:.1e}" for error in score.errors if not math.isnan(error)
    )


def as_json(result: Result) -> str:
    """Return one object: machine, rows with every case; null where there is no number."""
    found = {"machine": result.machine._asdict(), "rows": [asdict(row) for row in result.rows]}
    return json_text(found, indent=2)
