"""`linkanim quick-return`: a stroke or swing and a time ratio to linkages, as scene files and a table."""

from __future__ import annotations

import math
from argparse import Namespace
from pathlib import Path

from linkanim.atomic_files import checked_target
from linkanim.export import columns, json_text
from linkanim.synthesis.answers import file_set, write
from linkanim.synthesis.quick_returns import QuickReturn, quick_return
from linkanim.units import significant

_TITLES = ("file", "place", "ratio", "output", "transmission", "lengths", "class")
_HANDED_ON = ("ratio", "stroke", "swing", "kind", "place", "count")
"""Options that are called alike here and there."""


def run(options: Namespace) -> None:
    """Find the linkages, write their files, and print the table or JSON."""
    target = checked_target(options.output or Path("quick-return.toml"), (".toml",))
    file_set(target).refuse_foreign([target.name])
    found = quick_return(
        **{name: getattr(options, name) for name in _HANDED_ON},
        name=target.stem,
        source="linkanim quick-return",
    )
    files = write([one.scene for one in found], target)
    rows = list(zip(found, files, strict=True))
    if options.json:
        print(json_text([_object(one, file) for one, file in rows], indent=2))
    else:
        print(columns([_TITLES, *(_cells(one, file) for one, file in rows)]))


def _cells(one: QuickReturn, file: Path) -> tuple[str, ...]:
    sliding = one.kind == "slider-crank"
    output = one.output if sliding else math.degrees(one.output)
    lengths = ", ".join(f"{name} {significant(value, 4)}" for name, value in one.parameters.items())
    return (
        *(str(file), significant(one.place, 3), significant(one.ratio, 5)),
        f"{significant(output, 5)} {'mm' if sliding else 'deg'}",
        f"{significant(math.degrees(one.transmission_angle), 3)} deg",
        *(lengths, one.class_name),
    )


def _object(one: QuickReturn, file: Path) -> dict[str, object]:
    """Return what `--json` prints of an answer."""
    output = "stroke" if one.kind == "slider-crank" else "swing"
    return {
        "file": str(file),
        "ratio": one.ratio,
        output: one.output,
        "transmission_angle": one.transmission_angle,
        "place": one.place,
        "best": one.best,
        "largest_link": one.size,
        "class": one.class_name,
        "parameters": {"kind": one.kind, **one.parameters},
    }
