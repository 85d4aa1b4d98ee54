"""`linkanim quick-return`: a stroke or swing and a time ratio to linkages, as scene files and a table."""

from __future__ import annotations

import math
from argparse import Namespace

from linkanim.cli.answers import deliver, target_of
from linkanim.synthesis.quick_returns import QuickReturn, quick_return
from linkanim.units import significant

_TITLES = ("place", "ratio", "output", "transmission", "lengths", "class")
_HANDED_ON = ("ratio", "stroke", "swing", "kind", "crank", "place", "count")
"""Options that have the same name here and as keywords of the function."""


def run(options: Namespace) -> None:
    """Find the linkages, write their files, and print the table or JSON."""
    target = target_of(options.output, "quick-return.toml", options.count)
    answers = quick_return(
        **{name: getattr(options, name) for name in _HANDED_ON},
        name=target.stem,
        source="linkanim quick-return",
    )
    deliver(answers, target, options, _TITLES, _cells, _object)


def _cells(one: QuickReturn) -> tuple[str, ...]:
    sliding = one.kind != "crank-rocker"
    output = one.output if sliding else math.degrees(one.output)
    lengths = ", ".join(f"{name} {significant(value, 4)}" for name, value in one.parameters.items())
    return (
        *(significant(one.place, 3), significant(one.ratio, 5)),
        f"{significant(output, 5)} {'mm' if sliding else 'deg'}",
        f"{significant(math.degrees(one.transmission_angle), 3)} deg",
        *(lengths, one.class_name),
    )


def _object(one: QuickReturn) -> dict[str, object]:
    """Return what `--json` prints of an answer."""
    output = "stroke" if one.kind != "crank-rocker" else "swing"
    return {
        "ratio": one.ratio,
        output: one.output,
        "transmission_angle": one.transmission_angle,
        "place": one.place,
        "best": one.best,
        "largest_link": one.size,
        "class": one.class_name,
        "parameters": {"kind": one.kind, **one.parameters},
    }
