"""`linkanim report`: a folder with a page on a scene, its pictures and its tables."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from linkanim.bounds import MOST_CHARTED
from linkanim.cli.commands.chart import paces
from linkanim.cli.progress import bar
from linkanim.errors import BadInput
from linkanim.intake import NumberTable
from linkanim.manifest import FileSet, replacing
from linkanim.paper.curves import Pace, read_tables
from linkanim.paper.findings import instants_at, usual_instants
from linkanim.paper.report import Report
from linkanim.scenes import load
from linkanim.scenes.editing import in_unit
from linkanim.scenes.files import path_of, published
from linkanim.scenes.scene import Scene

_ALWAYS = ("report.html", "figure.svg")
_OURS = r"report\.html|figure\.svg|loops\.svg|chart-\d{3,}-[\w.-]+\.svg|quantities-\d+\.csv"


def run(options: Namespace) -> None:
    """Write the report, and print the path of its page.

    Other files in the folder stay; of an older report only what we wrote is replaced. `BadInput` where the
    folder is a file, or one of our names in it is taken; `OutOfRange` for an angle that the input does not
    reach.
    """
    target: Path = options.output
    files = FileSet(target, "report", _OURS)
    with replacing(files, _ALWAYS) as folder:
        scene = in_unit(load(options.scene), options.unit)
        instants = instants_at(scene, options.angles) if options.angles else usual_instants(scene)
        speeds = _paces(scene, options)
        if options.all:
            _refuse_many(scene, len(speeds))
        beside = _measured(options), options.label or _name(options)
        printed = published(options.scene) if path_of(options.scene) is None else ()
        with bar(unit=" parts") as progress:
            polygons = _polygon_pace(options), not options.no_derivation
            report = Report(
                scene, instants, speeds, options.digits, options.all, *beside, printed, *polygons, progress
            )
            for name, text in report.files():
                (folder / name).write_text(text, encoding="utf-8")
    print(target / "report.html")


def _paces(scene: Scene, options: Namespace) -> tuple[Pace, ...]:
    """Return the speeds, with the input's acceleration; BadInput for one of an input that swings."""
    second = options.acceleration
    if second and not scene.info.full_turn:
        raise BadInput(f"--acceleration goes with an input that turns fully; that of {scene.name} swings")
    if second and options.data is not None:
        raise BadInput("--data is compared at a constant speed; leave --acceleration out")
    return tuple(pace._replace(acceleration=second) for pace in paces(scene, options))


def _polygon_pace(options: Namespace) -> Pace | None:
    """Return the speed of polygons and comparisons, where one is named."""
    if options.polygon_speed is None:
        return None
    (words, speed), *more = options.polygon_speed.items()
    if more:
        raise BadInput(
            f"--polygon-speed takes one speed, not {len(more) + 1}; without it all speeds are drawn"
        )
    return Pace(speed, words, options.acceleration)


def _measured(options: Namespace) -> dict[str, NumberTable]:
    """Return the columns of `--data` by their quantities; none without it."""
    if options.data is None:
        if options.label is not None:
            raise BadInput("--label names the table of --data; add --data OTHER.csv")
        return {}
    return read_tables(options.data)


def _name(options: Namespace) -> str:
    return options.data.stem if options.data else ""


def _refuse_many(scene: Scene, speeds: int) -> None:
    """Refuse tables and charts of more quantities than a report holds."""
    count = len(scene.quantities) * speeds
    if count > MOST_CHARTED:
        at = f" at {speeds} speeds" * (speeds > 1)
        raise BadInput(
            f"--all: {scene.name} has {len(scene.quantities):,} quantities{at}, and a report holds "
            f"{MOST_CHARTED:,}; leave it out, or write those that you want with `linkanim chart --quantity`"
        )
