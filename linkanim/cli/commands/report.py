"""`linkanim report`: a folder with a page that shows a scene whole, its pictures and its tables."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from linkanim import units
from linkanim.cli.commands.chart import paces
from linkanim.cli.values import listed
from linkanim.errors import BadInput
from linkanim.manifest import FileSet, replacing
from linkanim.paper.findings import instants_at, usual_instants
from linkanim.paper.report import Report
from linkanim.scenes import load

_ALWAYS = ("report.html", "figure.svg")
_OURS = r"report\.html|figure\.svg|chart-\d{3,}-[\w.-]+\.svg|quantities-\d+\.csv"


def run(options: Namespace) -> None:
    """Write the report, and print the path of its page.

    What else the folder holds stays, and of an older report there only what we wrote is replaced.
    `BadInput` where the folder is a file, one of our names in it is taken, or an angle or speed is none;
    `OutOfRange` for an angle that the input does not come to.
    """
    target: Path = options.output
    files = FileSet(target, "report", _OURS)
    with replacing(files, _ALWAYS) as folder:
        scene = load(options.scene)
        angles = _angles(options.angles)
        instants = usual_instants(scene) if angles is None else instants_at(scene, angles)
        for name, text in Report(scene, instants, paces(scene, options.speeds)).files():
            (folder / name).write_text(text, encoding="utf-8")
    print(target / "report.html")


def _angles(text: str | None) -> tuple[float, ...] | None:
    if text is None:
        return None
    found = tuple(listed("--angles", units.angle, part.strip()) for part in text.split(",") if part.strip())
    if not found:
        raise BadInput(f'--angles {text!r}: give angles with their unit, such as "87 deg,306 deg"')
    return found
