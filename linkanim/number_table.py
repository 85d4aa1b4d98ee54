"""Tables of numbers as they come: commas, tabs, blanks or semicolons between, with or without a heading."""

from __future__ import annotations

import csv
import math
import re
from typing import NamedTuple

from linkanim.bounds import MOST_ROWS_READ
from linkanim.errors import BadInput
from linkanim.intake import control_in
from linkanim.units import shown

_NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?")
_LONGEST_LINE = 100_000
_WITH_COMMA = re.compile(r"[+-]?\d+(,\d+)?([eE][+-]?\d+)?")


class NumberRow(NamedTuple):
    """The numbers of a line, and which line it is."""

    line: int
    numbers: tuple[float, ...]


class NumberTable(NamedTuple):
    """The cells of a table's heading, none where it has no such line, and its rows."""

    heading: tuple[str, ...]
    rows: tuple[NumberRow, ...]


def read_numbers(text: str, where: str, columns: str) -> NumberTable:
    """Return a text's numbers; `columns` are those that it has to have, in words with commas between.

    Semicolons, tabs, commas or blanks stand between the cells, whichever the table has, the first of them;
    where they do not, a comma in a number is its decimal mark. Lines without a number before the others are a
    heading; empty lines and what follows # are passed over. BadInput naming line, column and the cell.
    """
    lines = _lines(text, where)
    between, comma = _form([line for _, line in lines])
    table = [(number, _cells(line, between)) for number, line in lines]
    start = next((n for n, (_, cells) in enumerate(table) if not _is_heading(cells)), len(table))
    if start == len(table):
        raise BadInput(f"{where}: has no rows; give a table of numbers: {columns}")
    heading = tuple(cell.strip() for cell in table[start - 1][1]) if start else ()
    return NumberTable(heading, tuple(_row(*line, columns, where, comma) for line in table[start:]))


def _lines(text: str, where: str) -> list[tuple[int, str]]:
    """Return the lines that hold anything, numbered."""
    found = []
    for number, line in enumerate(text.splitlines(), start=1):
        if control := control_in(line):
            raise BadInput(f"{where}: line {number} has {control} in it; save it as plain text")
        if len(line) > _LONGEST_LINE:
            raise BadInput(
                f"{where}: line {number} has more than {_LONGEST_LINE:,} characters; give fewer cells"
            )
        bare = line.partition("#")[0].strip(" ")
        if bare.strip(" \t;,"):
            found.append((number, bare))
    if len(found) > MOST_ROWS_READ + 1:
        count = f"{len(found):,} rows; {MOST_ROWS_READ:,} are the most that are read"
        raise BadInput(f"{where}: has {count}: keep every tenth or so")
    return found


def _form(lines: list[str]) -> tuple[str, bool]:
    """Return what stands between the cells, " " for blanks, and whether a comma is the decimal mark."""
    mark = next((mark for mark in ";\t," if any(mark in line for line in lines)), " ")
    if mark != ",":
        return mark, True
    cells = [line.split() for line in lines if _NUMBER.match(_plain(line))]
    decimal = all(len(row) > 1 and all(map(_WITH_COMMA.fullmatch, row)) for row in cells)
    return (" ", True) if cells and decimal else (mark, False)


def _cells(line: str, between: str) -> list[str]:
    return line.split() if between == " " else next(csv.reader([line], delimiter=between))


def _is_heading(cells: list[str]) -> bool:
    """Whether no cell is a number, and the first one does not begin as one, such as 87 deg."""
    return not (_NUMBER.match(_plain(cells[0])) or any(_NUMBER.fullmatch(_plain(cell)) for cell in cells))


def _plain(cell: str) -> str:
    return cell.strip().removesuffix("°").replace("−", "-").replace("\N{NO-BREAK SPACE}", "")


def _row(line: int, cells: list[str], columns: str, where: str, comma: bool) -> NumberRow:
    place, needed = f"{where}: line {line}", columns.count(",") + 1
    while len(cells) > needed and not cells[-1].strip():
        cells = cells[:-1]
    if len(cells) < needed:
        text = shown(" ".join(cells))
        raise BadInput(f"{place} has {len(cells)} of {needed} columns ({columns}): {text}")
    numbers = [_number(cell, comma) for cell in cells]
    for column, (cell, number) in enumerate(zip(cells, numbers, strict=True), start=1):
        if not math.isfinite(number):
            way_out = "; give a number" if cell.strip() else "; give a number, or leave the line out"
            raise BadInput(f"{place}, column {column}: {shown(cell)} is not a finite number{way_out}")
    return NumberRow(line, tuple(numbers))


def _number(cell: str, comma: bool) -> float:
    """Return a cell's number, NaN where it has none."""
    plain = _plain(cell)
    if not _NUMBER.fullmatch(plain) or ("," in plain and not comma):
        return math.nan
    return float(plain.replace(",", "."))
