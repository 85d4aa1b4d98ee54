"""`linkanim report`: a folder with a page that shows a scene whole, its pictures and its tables."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from linkanim import units
from linkanim.cli.chart import paces
from linkanim.cli.values import listed
from linkanim.errors import BadInput
from linkanim.paper.findings import instants_at, usual_instants
from linkanim.paper.report import Report
from linkanim.scenes import load
from linkanim.whole import replacing_folder


def run(options: Namespace) -> None:
    """Write the report, and print the path of its page.

    `BadInput` where the folder is a file, holds something else, or an angle or speed is none;
    `OutOfRange` for an angle that the input does not come to.
    """
    target: Path = options.output
    _refuse_foreign(target)
    scene = load(options.scene)
    angles = _angles(options.angles)
    instants = usual_instants(scene) if angles is None else instants_at(scene, angles)
    report = Report(scene, instants, paces(scene, options.speeds))
    with replacing_folder(target) as folder:
        for name, text in report.files():
            (folder / name).write_text(text, encoding="utf-8")
    print(target / "report.html")


def _refuse_foreign(target: Path) -> None:
    """Refuse a folder that a report would replace although it holds something else."""
    if target.exists() and not target.is_dir():
        raise BadInput(f"{target} is a file; name a folder for the report")
    if not target.resolve().parent.is_dir():
        raise BadInput(f"{target}: there is no folder {target.parent}; make it first, or choose another")
    if target.is_dir() and any(target.iterdir()) and not (target / "report.html").is_file():
        raise BadInput(f"{target} holds something else than a report; name a folder that is new or empty")


def _angles(text: str | None) -> tuple[float, ...] | None:
    if text is None:
        return None
    found = tuple(listed("--angles", units.angle, part.strip()) for part in text.split(",") if part.strip())
    if not found:
        raise BadInput(f'--angles {text!r}: give angles with their unit, such as "87 deg,306 deg"')
    return found
