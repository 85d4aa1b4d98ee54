"""Speed against error as a picture: the easy cycle above, the hard cases below."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from linkanim.bench.accuracy import Score
from linkanim.bench.result import Measured, Result
from linkanim.picture.offscreen import offscreen, png_bytes
from linkanim.picture.scatter import Dot, ScatterTitles, scatter
from linkanim.whole import checked_target, replacing

SIZE = (1280, 640)
LEAST = 1e-17
"""Where an error of nothing is drawn."""
OWN = ("batch", "single", "float32")
ACROSS = "ns a pose, positions"
UP = "worst error in longest links"


class Picture(NamedTuple):
    """One picture: what it shows, its points, and what its axes are called."""

    title: str
    points: list[Dot]
    across: str = ACROSS
    up: str = UP


def draw(result: Result, path: Path) -> Path:
    """Write speed against error, on the easy cycle and on the hard cases; return where it is."""
    return draw_pictures(list(panels(result)), path)


def draw_pictures(pictures: Sequence[Picture], path: Path) -> Path:
    """Write pictures, one below the other, as a PNG; return where it is.

    BadInput where the path cannot be; WorkFailed where the disk refuses.
    """
    target = checked_target(path, (".png",))
    width, height = SIZE
    sheet = offscreen((width, len(pictures) * height))
    for number, (title, points, across, up) in enumerate(pictures):
        sheet.blit(scatter(points, ScatterTitles(title, across, up), size=SIZE), (0, number * height))
    with replacing(target) as part:
        part.write_bytes(png_bytes(sheet))
    return target


def panels(result: Result) -> Iterator[Picture]:
    """Yield the two pictures; beside a name, the share of hard poses on the wrong closure or NaN.

    A million poses at once would lie on top of ten thousand.
    """
    rows = [row for row in result.rows if "many" not in row.key]
    yield Picture("Speed against error on an easy cycle", [_point(row, row.easy) for row in rows])
    right = [row for row in rows if not math.isnan(row.hard.error)]
    title = "On the hard cases (in brackets: poses on the wrong closure, or NaN)"
    yield Picture(title, [_point(row, row.hard) for row in right])


def _point(row: Measured, score: Score) -> Dot:
    lost = 100 * (score.wrong + score.missing) / score.poses
    name = f"{row.name} ({lost:.0f} %)" if lost else row.name
    return Dot(name, row.position_ns, max(score.error, LEAST), row.key in OWN)
