"""Draw speed against error: a column for each linkage, its easy cycle above, its hard cases below."""

from __future__ import annotations

import math
from io import BytesIO
from pathlib import Path
from typing import Any

from linkanim.atomic_files import checked_target
from linkanim.bench.reference import Score
from linkanim.bench.result import Measured, Result
from linkanim.manifest import replacing, single

SIZE = (1600, 960)
LEAST, MOST = 1e-17, 10.0
"""The places on the axis of an error of zero, and of any larger than a link, which is meaningless."""
TABLE = "Table"
"""The name under which the picture's file holds the table that it shows."""
OWN = ("batch", "single")
COLOURS = (
    *("#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f"),
    *("#000000", "#8c564b", "#bcbd22", "#9467bd", "#17becf", "#f0a3c0", "#3b6d11"),
)
"""The first ones of Okabe and Ito, Color Universal Design: told apart by colour-blind readers, too."""
MARKS = ("o", "^", "s")
ORDERS = ("position", "velocity", "acceleration")


def draw(result: Result, path: Path) -> Path:
    """Write speed against error of all mechanisms as a PNG; return where it is.

    BadInput where the path is not possible, or names a file that is not such a picture of ours; WorkFailed
    where the disk refuses.
    """
    target = checked_target(path, (".png",))
    with replacing(single(target), [target.name]) as new:
        (new / target.name).write_bytes(_png(result))
    return target


def _png(result: Result) -> bytes:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    # A million poses at once would lie on top of ten thousand.
    rows = [row for row in result.rows if "many" not in row.key]
    names = list(dict.fromkeys(row.mechanism for row in rows))
    styles = {key: n for n, key in enumerate(dict.fromkeys(row.key for row in rows))}
    figure = Figure(figsize=(SIZE[0] / 100, SIZE[1] / 100), dpi=100, layout="constrained")
    canvas: Any = FigureCanvasAgg(figure)
    panels = figure.subplots(2, len(names), sharex=True, sharey=True, squeeze=False)
    for column, name in enumerate(names):
        panels[1, column].set_xlabel("ns per pose; of rates with derivatives")
        for panel, which in zip(panels[:, column], ("easy", "hard"), strict=True):
            for row in rows:
                if row.mechanism == name:
                    _plot(panel, row, getattr(row, which), styles[row.key])
            _dress(panel, f"{name}, {'an easy cycle' if which == 'easy' else 'hard cases'}")
    figure.supylabel("worst error in longest links")
    _key(figure, rows, styles)
    buffer = BytesIO()
    canvas.print_png(buffer, metadata={TABLE: result.as_markdown()})
    return buffer.getvalue()


def _plot(panel: Any, row: Measured, score: Score, style: int) -> None:
    """Draw the errors of a method, hollow where some of its poses are on the wrong closure or are NaN."""
    lost = score.wrong + score.nan > 0
    colour = COLOURS[style % len(COLOURS)]
    for order, error in enumerate(score.errors):
        nanos = row.ns_derivatives if order else row.ns_position
        if math.isnan(error) or nanos is None:
            continue
        panel.plot(
            nanos,
            max(error, LEAST) if error <= 1 else MOST,
            MARKS[order],
            color=colour,
            markerfacecolor="none" if lost else colour,
            markersize=11 if row.key in OWN else 7,
            markeredgewidth=1.6,
        )


def _dress(panel: Any, title: str) -> None:
    panel.set(xscale="log", yscale="log", ylim=(LEAST / 3, MOST * 3), axisbelow=True)
    panel.set_title(title, fontsize=11)
    panel.grid(visible=True, color="#dddddd")


def _key(figure: Any, rows: list[Measured], styles: dict[str, int]) -> None:
    """Draw the key below: the method of each colour, and the meaning of each mark."""
    from matplotlib.lines import Line2D

    def mark(label: str, color: str = "#444444", **how: Any) -> Line2D:
        return Line2D([], [], **{"color": color, "marker": "o", "linestyle": "", "label": label, **how})

    named = {row.key: row.method for row in rows}
    methods = [mark(named[key], COLOURS[n % len(COLOURS)], markersize=8) for key, n in styles.items()]
    kinds = [mark(order, marker=shape) for shape, order in zip(MARKS, ORDERS, strict=True)]
    hollow = mark("with poses lost", markerfacecolor="none")
    figure.legend(handles=[*methods, *kinds, hollow], loc="outside lower center", ncols=5, frameon=False)
