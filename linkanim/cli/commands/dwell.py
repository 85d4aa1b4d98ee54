"""`linkanim dwell`: a rest and a swing or stroke to six-bars, as scene files and a table."""

from __future__ import annotations

import math
from argparse import Namespace

from linkanim.cli.answers import deliver, target_of
from linkanim.synthesis.dwells import Dwell, dwell
from linkanim.units import significant

_TITLES = ("at rest", "of all", "output", "transmission", "longest link", "class")
_HANDED_ON = ("rest", "stroke", "swing", "count", "least_angle")
"""Options that have the same name here and as keywords of the function."""


def run(options: Namespace) -> None:
    """Find the linkages, write their files, and print the table or JSON."""
    target = target_of(options.output, "dwell.toml", options.count)
    answers = dwell(
        **{name: getattr(options, name) for name in _HANDED_ON}, name=target.stem, source="linkanim dwell"
    )
    deliver(answers, target, options, _TITLES, _cells, _object)


def _cells(one: Dwell) -> tuple[str, ...]:
    turning = one.kind == "rocker"
    rested, whole = ((math.degrees(way) if turning else way) for way in (one.deviation, one.output))
    unit = "deg" if turning else "mm"
    return (
        f"±{significant(rested, 2)} {unit}",
        f"{significant(100 * one.deviation / one.output, 2)} %",
        f"{significant(whole, 5)} {unit}",
        f"{significant(math.degrees(one.transmission_angle), 3)} deg",
        *(significant(one.size, 4), one.class_name),
    )


def _object(one: Dwell) -> dict[str, object]:
    """Return what `--json` prints of an answer."""
    return {
        "rest": one.rest,
        "deviation": one.deviation,
        "swing" if one.kind == "rocker" else "stroke": one.output,
        "transmission_angle": one.transmission_angle,
        "largest_link": one.size,
        "class": one.class_name,
        "parameters": {"kind": one.kind, **one.parameters},
    }
