"""`linkanim function`: a function to the linkages that generate it, as scene files and a table."""

from __future__ import annotations

import math
from argparse import Namespace
from collections.abc import Callable
from pathlib import Path

from linkanim import units
from linkanim.atomic_files import checked_target
from linkanim.cli.answers import deliver, motor_of, target_of
from linkanim.cli.options import bounded
from linkanim.errors import BadInput
from linkanim.intake import Intake, named, read_numbers
from linkanim.manifest import Output
from linkanim.synthesis.generation import Generated, function
from linkanim.units import shown, significant

_TABLE_FILE = Intake("a table of x and y", most_bytes=1_000_000, most_values=100_000)
_SUFFIXES = (".csv", ".txt", ".tsv", ".dat")
_CHARTS = (".svg", ".png", ".pdf", ".csv")
_TITLES = ("largest error", "of y's range", "input", "output", "transmission", "class")


def run(options: Namespace) -> None:
    """Find the linkages, write their files, and print the table or JSON; draw the error where asked to."""
    target = target_of(options.output_file, "function.toml", options.count)
    chart = None if options.chart is None else checked_target(options.chart, _CHARTS, [options.given])
    if options.pairs and chart is not None:
        raise BadInput("between pairs nothing is wanted, so there is no error to draw; leave out --chart")
    sliding = options.kind == "slider-crank"
    given: str | list[tuple[float, float]] = options.given
    if options.pairs:
        rows = _table(Path(options.given)) if _names_a_file(options.given) else _pairs(options.given)
        given = [(math.radians(x), y if sliding else math.radians(y)) for x, y in rows]
    elif _names_a_file(options.given):
        given = _table(Path(options.given))
    answers = function(
        given,
        options.first,
        options.last,
        kind=options.kind,
        points=options.points,
        count=options.count,
        level=not options.chebyshev,
        prefer=options.prefer,
        pairs=options.pairs,
        driver=motor_of(options),
        **_scale("input", options.input, units.angle),
        **_scale("output", options.output, _length if sliding else units.angle),
        name=target.stem,
        source=f"linkanim function {options.given}",
    )
    deliver(answers, target, options, _TITLES, _cells, _object)
    if chart is not None:
        _draw(answers[0], chart)


def _names_a_file(text: str) -> bool:
    try:
        return Path(text).suffix.lower() in _SUFFIXES or Path(text).is_file()
    except OSError:  # a text that is too long for a file's name is none
        return False


def _table(path: Path) -> list[tuple[float, float]]:
    where = named(path)
    rows = read_numbers(_TABLE_FILE.read(path, where), where, "x, y").rows
    for line, numbers in rows:
        if len(numbers) != 2:
            raise BadInput(f"{where}: line {line} has {len(numbers)} columns; give x and y")
    return [(numbers[0], numbers[1]) for _, numbers in rows]


def _pairs(text: str) -> list[tuple[float, float]]:
    """Return the numbers of a text such as "40:70, 45:76, 50:83"."""
    try:
        rows = [tuple(map(float, pair.split(":"))) for pair in text.split(",")]
    except ValueError:
        rows = []
    if not rows or any(len(row) != 2 for row in rows):
        raise BadInput(f'{shown(text)} is no list of pairs; write them as in "40:70, 45:76, 50:83"')
    return [(row[0], row[1]) for row in rows]


def _length(text: str) -> float:
    return units.length(text, unit="mm")


def _scale(name: str, text: str | None, read: Callable[[str], float]) -> dict[str, float]:
    """Return the keywords for the range of a scale, and for its start if the text has one."""
    if text is None:
        return {}
    first, sign, last = text.partition(":")
    try:
        values = [bounded(read)(part.strip()) for part in ((first, last) if sign else (first,))]
    except BadInput as error:
        raise BadInput(f"--{name}: {error}") from None
    if not sign:
        return {f"{name}_range": values[0]}
    return {f"{name}_start": values[0], f"{name}_range": values[1] - values[0]}


def _draw(one: Generated, target: Path) -> None:
    from linkanim.cli.letters import tell_of_picture
    from linkanim.paper.construction import ErrorChart
    from linkanim.paper.write import write as write_figure

    chart = ErrorChart(one), Output(target)
    write_figure(*chart)
    tell_of_picture(*chart)


def _span(one: Generated, start: float, over: float, *, turning: bool) -> str:
    ends = [math.degrees(end) if turning else end for end in (start, start + over)]
    return f"{significant(ends[0], 4)}…{significant(ends[1], 4)} {'deg' if turning else one.task.unit}"


def _cells(one: Generated) -> tuple[str, ...]:
    share = f"{significant(100 * one.error / abs(one.task.function.span), 2)} %"
    angle = f"{significant(math.degrees(one.transmission_angle), 3)} deg"
    return (
        *(significant(one.error, 3), share),
        _span(one, one.input_start, one.input_range, turning=True),
        _span(one, one.output_start, one.output_range, turning=one.task.kind.turning),
        *(angle, one.class_name),
    )


def _object(one: Generated) -> dict[str, object]:
    """Return what `--json` prints of an answer."""
    given = one.task.function
    return {
        "error": one.error,
        "defects": [],
        "input_start": one.input_start,
        "input_range": one.input_range,
        "output_body": one.output_body,
        "output_start": one.output_start,
        "output_range": one.output_range,
        "x_from": given.first,
        "x_to": given.last,
        "y_start": given.start,
        "y_range": given.span,
        "points": one.points.tolist(),
        "extremes": one.extremes,
        "chebyshev_error": one.chebyshev,
        "transmission_angle": one.transmission_angle,
        "largest_link": one.size,
        "class": one.class_name,
        "parameters": {"kind": one.task.kind.name, **one.parameters},
        **({"driver": one.driver.plain} if one.driver else {}),
    }
