"""Where parts lie on sheets or pages: each turned so that its rectangle is smallest, in rows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from linkanim.workshop.shapes import Outline, box, polygon, upright

MARGIN, FOOT = 10.0, 16.0
"""The margin of a page that is not printed on, and the room for the ruler at its foot, in mm."""


class Laid(NamedTuple):
    """A part on a sheet: the sheet's number, the place of the frame's origin, the frame's direction."""

    sheet: int
    at: complex
    turn: complex


class _Row(NamedTuple):
    """A row on a sheet: its foot, its height, and how far it is filled."""

    sheet: int
    foot: float
    high: float
    filled: float


def nested(outlines: Sequence[Outline], room: tuple[float, float], between: float) -> list[Laid | None]:
    """Return the place of each outline, None for one that no sheet holds, in the order given.

    A sheet's room has its origin at the lower left.

    Each goes into the first row with room for it, else into a new row, on a new sheet where the last has no
    room (first fit by decreasing height). A part that fits only upright is put upright.
    """
    sizes = []
    for outline in outlines:
        points = polygon(outline)
        turn = upright(points)
        turned = ((by, box(by * point for point in points)) for by in (turn, 1j * turn))
        lying = [(by, around) for by, around in turned if _holds(room, around)]
        sizes.append(lying[0] if lying else (None, box(turn * point for point in points)))
    laid: list[Laid | None] = [None] * len(sizes)
    rows: list[_Row] = []
    for part in sorted(range(len(sizes)), key=lambda number: sizes[number][1][2] - sizes[number][1][3]):
        turn_, (left, right, low, top) = sizes[part]
        if turn_ is None:
            continue
        wide, high = right - left, top - low
        fitting = (n for n, row in enumerate(rows) if high <= row.high and row.filled + wide <= room[0])
        at = next(fitting, len(rows))
        if at == len(rows):
            last = rows[-1] if rows else _Row(0, -between, 0.0, 0.0)
            foot = last.foot + last.high + between
            fits = foot + high <= room[1]
            rows.append(_Row(last.sheet, foot, high, 0.0) if fits else _Row(last.sheet + 1, 0.0, high, 0.0))
        row = rows[at]
        laid[part] = Laid(row.sheet, complex(row.filled - left, row.foot - low), turn_)
        rows[at] = row._replace(filled=row.filled + wide + between)
    return laid


def _holds(room: tuple[float, float], around: tuple[float, float, float, float]) -> bool:
    left, right, low, high = around
    return right - left <= room[0] and high - low <= room[1]
