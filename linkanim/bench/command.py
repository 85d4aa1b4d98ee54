"""The `bench` command: its options, and what it prints."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Callable
from importlib.util import find_spec

from linkanim.atomic_files import made_folder
from linkanim.errors import BadInput

CHART = "speed-vs-error.png"

NEEDED = ("mpmath", "matplotlib")
"""The packages that only this command needs."""
Progress = Callable[[int, int], None]


def run(options: Namespace, progress: Progress | None = None) -> None:
    """Measure this solver's speed and error, and print it beside what was recorded of other methods.

    BadInput where the extra is not installed, the folder cannot be one or the chart's name in it is taken,
    before anything is measured.
    """
    if options.again:
        require_extra(needed=("mpmath",))
        from linkanim.bench.result import again

        name, *numbers = options.again
        try:
            print(again(name, [float.fromhex(number) for number in numbers]))
        except (ValueError, OverflowError):
            raise BadInput(f"bench --again: {' '.join(numbers)}: give hexadecimal floats") from None
        return
    require_extra()
    from linkanim.bench import drawing, result
    from linkanim.manifest import single

    chart = made_folder(options.into) / CHART
    single(chart).refuse_foreign([CHART])

    measured = result.run(progress).with_recorded()
    shown = (
        measured.as_json if options.json else measured.as_markdown if options.markdown else measured.as_text
    )
    print(shown())
    print(drawing.draw(measured, chart), file=sys.stderr)


def require_extra(find: Callable[[str], object] = find_spec, needed: tuple[str, ...] = ()) -> None:
    """Raise BadInput where a package of the extra is not installed, naming what installs it."""
    missing = [name for name in needed or NEEDED if find(name) is None]
    if missing:
        raise BadInput(
            f"bench works with {' and '.join(missing)}, which {'is' if len(missing) == 1 else 'are'} not "
            'installed; install with: pip install "linkanim[bench]"'
        )
