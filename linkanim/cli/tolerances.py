"""What `info --tolerance` prints, and its chart."""

from __future__ import annotations

import math
from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING

from linkanim import units
from linkanim.atomic_files import checked_target
from linkanim.cli.progress import bar
from linkanim.errors import BadInput
from linkanim.export import columns
from linkanim.manifest import Output
from linkanim.scenes.deviation import SAMPLES, Off, Tolerance, tolerance
from linkanim.scenes.scene import Scene
from linkanim.units import significant

if TYPE_CHECKING:
    from linkanim.paper.write import Written

CHARTS = (".svg", ".png", ".pdf", ".csv")


def asked(scene: Scene, options: Namespace) -> Tolerance | None:
    """Return how far a scene may be off by the tolerance that is asked for; None without one.

    BadInput where only its chart is asked for, or where the chart cannot be written.
    """
    if options.tolerance is None and options.chart is not None:
        raise BadInput('--chart draws how far off: say by how much each length is, as --tolerance "0.1 mm"')
    if options.tolerance is None:
        return None
    if options.chart is not None:
        options.chart = checked_target(options.chart, CHARTS, [options.scene])
    by = units.length(options.tolerance, unit=scene.length_unit)
    with bar(unit=" steps") as progress:
        return tolerance(scene, by, progress=progress)


def _in_words(value: float, off: Off, scene: Scene) -> str:
    """Return how far a quantity is off, with its unit."""
    if off.is_angle:
        return f"{significant(math.degrees(value), 3)} deg"
    return f"{significant(value, 3)} {scene.length_unit}"


def _called(off: Off, scene: Scene) -> str:
    """Return a quantity in words: "P", "angle of rocker", "travel of slider"."""
    if not any(body.name == off.name for body in scene.linkage.bodies):
        return off.name
    return f"{'angle' if off.is_angle else 'travel'} of {off.name}"


def table_of(tolerance: Tolerance) -> str:
    """Return how far each quantity may be off, and by how much each length alone, as two tables."""
    scene, several = tolerance.scene, f"of {SAMPLES:,}"
    rows: list[tuple[str, ...]] = [
        ("off at most", "at phase", f"95 % {several}", f"most {several}", "chiefly by")
    ]
    for off in tolerance.quantities:
        phase = "-" if off.worst_phase is None else f"{significant(math.degrees(off.worst_phase), 4)} deg"
        drawn = [
            _in_words(one, off, scene) if math.isfinite(one) else "-" for one in (off.likely, off.greatest)
        ]
        rows.append((_in_words(off.worst, off, scene), phase, *drawn, tolerance.most(off)))
    heads = ["", *(_called(off, scene) for off in tolerance.quantities)]
    each: list[tuple[str, ...]] = [("length alone", *heads[1:])]
    for n, name in enumerate(tolerance.lengths):
        each.append((name, *(_in_words(float(off.by[n]), off, scene) for off in tolerance.quantities)))
    by = f"{significant(tolerance.by, 4)} {scene.length_unit}"
    first = columns([(head, *row) for head, row in zip(heads, rows, strict=True)])
    return f"each of {len(tolerance.lengths)} lengths off by {by} at the most\n{first}\n\n{columns(each)}"


def object_of(tolerance: Tolerance) -> dict[str, object]:
    """Return what `--json` prints of a tolerance: lengths in the scene's unit, angles in radians."""
    return {
        "by": tolerance.by,
        "quantities": [
            {
                "of": off.name,
                "is_angle": off.is_angle,
                "worst": off.worst,
                "worst_phase": off.worst_phase,
                "likely": off.likely,
                "greatest": off.greatest,
                "most_by": tolerance.most(off),
                "alone": dict(zip(tolerance.lengths, off.by.tolist(), strict=True)),
            }
            for off in tolerance.quantities
        ],
    }


def draw(tolerance: Tolerance, target: Path) -> None:
    """Draw how far the first quantity may be off over a period."""
    from linkanim.paper.tolerances import ToleranceChart

    draw_page(ToleranceChart(tolerance), target)


def draw_page(page: Written, target: Path) -> None:
    """Write a page as the file's name says, and tell which of its letters have no font."""
    from linkanim.cli.letters import tell_of_picture
    from linkanim.paper.write import write

    write(page, Output(target))
    tell_of_picture(page, Output(target))
