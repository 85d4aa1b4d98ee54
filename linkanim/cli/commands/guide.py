"""`linkanim guide`: poses to the linkages whose coupler passes them, as scene files and a table."""

from __future__ import annotations

import math
import sys
from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from linkanim.cli.answers import deliver, motor_of, target_of
from linkanim.errors import BadInput
from linkanim.intake import named
from linkanim.synthesis.burmester import MOST
from linkanim.synthesis.curve_files import read_curve
from linkanim.synthesis.guidance import GuidedLinkage, guide
from linkanim.synthesis.linkages import MOST_ANSWERS, Real
from linkanim.units import significant

_UNIT = "mm"
_TITLES = ("defects", f"off {_UNIT}", "transmission", f"longest link {_UNIT}", "sizes", "crank", "class")
_HANDED_ON = ("kind", "count", "pivots", "box", "largest", "least_angle", "prefer", "mirror")
"""Options that have the same name here and as keywords of the function."""


def run(options: Namespace) -> None:
    """Find the linkages, write their files, and print the table or JSON; print remarks on stderr."""
    poses = _poses(options.poses)
    target = target_of(options.output, f"{options.poses.stem}.toml", options.count)
    handed: dict[str, Any] = {name: getattr(options, name) for name in _HANDED_ON}
    handed["driver"] = motor_of(options)
    answers = guide(
        poses, **handed, name=target.stem, source=f"linkanim guide for {named(options.poses.name)}"
    )
    deliver(answers, target, options, _TITLES, _cells, _object)
    _remark(answers)
    if len(poses) == MOST and len(answers) < options.count:
        _tell_longer(answers, guide(poses, **{**handed, "count": MOST_ANSWERS, "largest": 1e9}))


def _poses(path: Path) -> Real:
    """Return the rows of a file of poses, angles in radians."""
    table = read_curve(path)
    if table.angles is None:
        raise BadInput(f"{named(path)}: has no third column; give each pose x, y and its angle in degrees")
    return np.column_stack([table.points.real, table.points.imag, table.angles])


def _cells(one: GuidedLinkage) -> tuple[str, ...]:
    angle = f"{significant(math.degrees(one.transmission_angle), 3)} deg"
    sizes = significant(one.size / one.task.poses.size, 3)
    defects = ", ".join(one.defects) or "none"
    return (
        *(defects, significant(one.error, 2), angle),
        *(significant(one.size, 4), sizes, _way(one), one.class_name),
    )


def _way(one: GuidedLinkage) -> str:
    """Return "turns", "driven", or the angles between which the crank swings."""
    if one.driver:
        return "driven"
    if one.scene.info.full_turn:
        return "turns"
    first, last = (significant(math.degrees(angle), 4) for angle in one.scene.info.input_range)
    return f"{first}…{last} deg"


def _object(one: GuidedLinkage) -> dict[str, object]:
    """Return what `--json` prints of an answer."""
    return {
        "error": one.error,
        "defects": one.defects,
        "transmission_angle": one.transmission_angle,
        "largest_link": one.size,
        "size": one.size / one.task.poses.size,
        "class": one.class_name,
        "full_turn": one.scene.info.full_turn,
        "limits": [] if one.scene.info.full_turn else list(one.scene.info.input_range),
        "angles": one.angles.tolist(),
        "phases": one.phases.tolist(),
        "parameters": {"kind": one.task.kind.name, **one.parameters, "closure": one.closure},
        **({"driver": one.driver.plain} if one.driver else {}),
    }


def _tell_longer(answers: Sequence[GuidedLinkage], every: Sequence[GuidedLinkage]) -> None:
    """Say on stderr how many of the few linkages for five poses are left out for links that are too long."""
    if len(every) > len(answers):
        more, longest = len(every) - len(answers), max(one.size / one.task.poses.size for one in every)
        linkages = "linkage has" if more == 1 else "linkages have"
        most = significant(math.ceil(longest), 12)
        print(
            f"{more} more {linkages} links of up to {most} sizes of the poses (--largest {most})",
            file=sys.stderr,
        )


def _remark(answers: Sequence[GuidedLinkage]) -> None:
    """Say on stderr, where every answer has a defect, what the defects mean."""
    if all(one.defects for one in answers):
        print(
            "every answer has a defect: circuit, it would have to be taken apart between poses; branch, it "
            "would have to pass a limit of its crank; order, it passes them in another order",
            file=sys.stderr,
        )
