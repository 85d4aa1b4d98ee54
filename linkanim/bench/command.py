"""The `bench` command: its options, and what each of its four ways prints."""

from __future__ import annotations

import argparse
import sys
from argparse import Namespace
from collections.abc import Callable
from pathlib import Path
from typing import Any

from linkanim.errors import BadInput
from linkanim.whole import made_folder

CHART = "speed-vs-error.png"
GROWTH = "cost-as-work-grows.png"

Progress = Callable[[int, int], None]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `bench`; imports nothing that measures."""
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--draw", action="store_true", help="what a frame of the window costs, instead")
    what.add_argument("--record", action="store_true", help="what recordings cost, instead")
    what.add_argument(
        "--scaling",
        action="store_true",
        help="what a pose costs as work grows, instead; its chart goes there, too",
    )
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="one object")
    form.add_argument("--markdown", action="store_true", help="the table of speed and error as in the README")
    parser.add_argument(
        "--into",
        type=Path,
        default=Path("recordings"),
        metavar="FOLDER",
        help=f"where {CHART} goes (default: recordings)",
    )


def run(options: Namespace, progress: Progress | None = None) -> None:
    """Measure what was asked and print it.

    BadInput where the extra is not installed or the folder cannot be one, before anything is measured.
    """
    if options.markdown and (options.draw or options.record or options.scaling):
        raise BadInput(
            "--markdown is the table of speed and error; leave it out with --draw, --record and --scaling"
        )
    if options.draw:
        _drawing(options)
    elif options.record:
        _recordings(options)
    elif options.scaling:
        _scaling(options, progress)
    else:
        _speed_and_error(options, progress)


def _speed_and_error(options: Namespace, progress: Progress | None) -> None:
    from linkanim.bench.extra import require_extra

    require_extra()
    into = made_folder(options.into)
    from linkanim.bench import again, drawing, report, result

    found = result.run(progress)
    without = again.wide(found.machine.features)
    if options.json:
        print(_both_objects(report.as_json(found), without))
    else:
        form, flags = (report.as_markdown, ["--markdown"]) if options.markdown else (report.as_text, [])
        print("\n\n".join([form(found), *([again.printed(without, flags)] if without else [])]))
    print(drawing.draw(found, into / CHART), file=sys.stderr)


def _both_objects(found: str, without: tuple[str, ...]) -> str:
    """Return the object of a run, that of one without AVX-512 in it where there is any to leave alone."""
    import json

    from linkanim.bench import again

    if not without:
        return found
    return _json({**json.loads(found), "without_avx512": json.loads(again.printed(without, ["--json"]))})


def _drawing(options: Namespace) -> None:
    from linkanim.bench import window

    found = window.run()
    print(_json(window.as_object(found)) if options.json else window.as_text(found))


def _recordings(options: Namespace) -> None:
    from linkanim.bench import recording

    found = recording.run()
    print(_json(recording.as_object(found)) if options.json else recording.as_text(found))


def _scaling(options: Namespace, progress: Progress | None) -> None:
    into = made_folder(options.into)
    from linkanim.bench import scaling

    found = scaling.run(progress)
    print(_json(scaling.as_object(found)) if options.json else scaling.as_text(found))
    print(scaling.draw(found, into / GROWTH), file=sys.stderr)


def _json(value: Any) -> str:
    import json

    return json.dumps(value, indent=2, allow_nan=False)
