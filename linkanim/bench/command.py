"""The `bench` command: its options, and what it prints."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Callable
from importlib.util import find_spec

from linkanim.atomic_files import made_folder
from linkanim.errors import BadInput

CHART = "speed-vs-error.png"

NEEDED = ("mpmath", "pylinkage", "numba", "scipy", "matplotlib")
"""The packages that only the comparison needs."""
Progress = Callable[[int, int], None]


def run(options: Namespace, progress: Progress | None = None) -> None:
    """Measure speed against error and print it.

    BadInput where the extra is not installed, the folder cannot be one or the chart's name in it is taken,
    before anything is measured.
    """
    if options.path:
        _run_paths(options, progress)
        return
    require_extra()
    from linkanim.bench import drawing, result
    from linkanim.manifest import single

    chart = made_folder(options.into) / CHART
    single(chart).refuse_foreign([CHART])

    found = result.run(progress)
    form = result.as_json if options.json else result.as_markdown if options.markdown else result.as_text
    print(form(found))
    print(drawing.draw(found, chart), file=sys.stderr)


def _run_paths(options: Namespace, progress: Progress | None) -> None:
    """Measure the answers to paths, and print them; BadInput without scipy, whose search is compared."""
    require_extra(needed=("scipy",))
    from linkanim.bench import paths
    from linkanim.bench.result import this_machine

    rows = paths.run(options.seconds, paths.CURVES, progress)
    form = paths.as_json if options.json else paths.as_markdown if options.markdown else paths.as_text
    print(form(rows, this_machine().line))


def require_extra(found: Callable[[str], object] = find_spec, needed: tuple[str, ...] = ()) -> None:
    """Raise BadInput where a package of the extra is not installed, naming what installs it."""
    missing = [name for name in needed or NEEDED if found(name) is None]
    if missing:
        raise BadInput(
            f"bench compares with {', '.join(missing)}, which {'is' if len(missing) == 1 else 'are'} not "
            'installed; install with: pip install "linkanim[bench]"'
        )
