"""`linkanim path`: a drawn curve to the linkages that follow it, as scene files and a table."""

from __future__ import annotations

import math
import sys
from argparse import Namespace
from collections.abc import Sequence
from itertools import count

from numpy.typing import ArrayLike

from linkanim.atomic_files import checked_target, write_text
from linkanim.cli.answers import deliver, motor_of, target_of
from linkanim.cli.progress import bar
from linkanim.errors import BadInput
from linkanim.export import csv_head, csv_rows
from linkanim.intake import named
from linkanim.synthesis.answers import Fit
from linkanim.synthesis.curve_files import CurveFile, read_curve
from linkanim.synthesis.front import differ, front_of
from linkanim.synthesis.linkages import Real
from linkanim.synthesis.path import front_behind, path
from linkanim.units import significant

_UNIT = "mm"
_POOR = 5.0
"""The deviation, in percent of the curve's size, above which a remark says that the best answer is poor."""
_SAME_ANGLE = 1e-6
_HANDED_ON = ("kind", "count", "pivots", "box", "largest", "least_angle", "prefer", "cognates", "mirror")
"""Options that have the same name here and as keywords of the function."""
_TITLES = (f"rms {_UNIT}", "%", f"largest {_UNIT}", "%", "transmission", "longest link", "class")


def run(options: Namespace) -> None:
    """Find the linkages, write their files, and print the table or JSON; print remarks on stderr."""
    curve = read_curve(options.curve)
    target = target_of(
        options.output, f"{options.curve.stem}.toml", options.count * (3 if options.cognates else 1)
    )
    front = None if options.front is None else checked_target(options.front, (".csv",), [options.curve])
    with bar(unit=" steps") as progress:
        fits = path(
            curve.points,
            not options.open,
            timing=_timing(options.timing, curve, named(options.curve)),
            rounding=options.round,
            driver=motor_of(options),
            **{name: getattr(options, name) for name in _HANDED_ON},
            name=target.stem,
            source=f"linkanim path for {named(options.curve.name)}",
            progress=progress,
        )
    if front is not None:
        steps = count(1)
        with bar(unit=" steps") as progress:
            best_front = front_behind(fits, lambda: progress(next(steps), 0))
        write_text(front, _table(best_front))
    on_front = front_of(fits)
    deliver(fits, target, options, _TITLES, _cells, lambda fit: _object(fit) | {"front": fit in on_front})
    _remark(fits, cognates=options.cognates)


def _timing(timing: float | str | None, curve: CurveFile, where: str) -> float | Real | None:
    if not isinstance(timing, str):
        return timing
    if curve.angles is None:
        raise BadInput(f'{where}: has no third column; give the crank\'s angles in it, or --timing "20 deg"')
    return curve.angles


def _percent(distance: float, fit: Fit) -> float:
    return 100 * distance / fit.task.curve.size


def _cells(fit: Fit) -> tuple[str, ...]:
    distances = (fit.rms, _percent(fit.rms, fit), fit.largest, _percent(fit.largest, fit))
    whole = fit.scene.info.transmission
    along = " along it" if whole and whole.least < fit.transmission_angle - _SAME_ANGLE else ""
    angle = f"{significant(math.degrees(fit.transmission_angle), 3)} deg{along}"
    cells = (significant(distance, 3) for distance in distances)
    return (*cells, angle, significant(fit.size, 4), fit.class_name)


def _object(fit: Fit) -> dict[str, object]:
    """Return what `--json` prints of an answer."""
    document: dict[str, object] = {
        "rms": fit.rms,
        "largest": fit.largest,
        "rms_percent": _percent(fit.rms, fit),
        "largest_percent": _percent(fit.largest, fit),
        "stray": fit.stray,
        "transmission_angle": fit.transmission_angle,
        "largest_link": fit.size,
        "size": fit.figures.size,
        "room": fit.figures.room,
        "class": fit.class_name,
        "full_turn": fit.scene.info.full_turn,
        "cognate": fit.cognate,
        "parameters": {"kind": fit.task.kind.name, **fit.parameters, "closure": fit.closure},
        **({"driver": fit.driver.plain} if fit.driver else {}),
    }
    if fit.exact is not None:
        document["rms_before_rounding"] = fit.exact.rms
    return document


_SHARES = ("rms_percent", "largest_percent", "size", "room")


def _table(front: Sequence[Fit]) -> str:
    """Return a front as CSV: figures as `--json` has them, the angle in degrees, then parameters."""
    rows = [_object(fit) for fit in front]
    shares = {name: [row[name] for row in rows] for name in _SHARES}
    angles = [math.degrees(fit.transmission_angle) for fit in front]
    own = {name: [fit.parameters[name] for fit in front] for name in front[0].kind.parameters}
    named: dict[str, ArrayLike] = {**shares, "transmission_angle_deg": angles, **own}  # type: ignore[dict-item]
    closures = [fit.closure_sign for fit in front]
    return csv_head([*named, "closure"]) + csv_rows([*named.values(), closures])


def _cost(first: Fit, exact: Fit) -> str | None:
    """Return the sentence of what exactness costs in transmission angle, or in size; None where nothing."""
    off, least = (significant(_percent(fit.rms, fit), 2) for fit in (first, exact))
    if first.rms <= exact.rms or off == least or not differ(first.figures, exact.figures):
        return None
    if first.figures.angle - exact.figures.angle >= math.radians(5) or exact.size <= first.size:
        angles = [significant(math.degrees(fit.transmission_angle), 2) for fit in (exact, first)]
        needs, has = f"a transmission angle of {angles[0]} deg", f"{angles[1]} deg"
    else:
        needs, has = (f"links of {significant(fit.figures.size, 2)} sizes" for fit in (exact, first))
    return f"{least} % needs {needs}; {off} % has {has} (--prefer exact lists the most exact)"


def _remark(fits: Sequence[Fit], *, cognates: bool) -> None:
    """Say on stderr if no answer follows well, what exactness and rounding cost, and cognates left out."""
    best = fits[0]
    if _percent(best.rms, best) > _POOR:
        percent = significant(_percent(best.rms, best), 3)
        print(f"nothing follows it better than {percent} % of its size; this is the best", file=sys.stderr)
    if best.most_exact is not None and (cost := _cost(best.exact or best, best.most_exact)):
        print(cost, file=sys.stderr)
    if best.exact is not None:
        before, after = (significant(_percent(fit.rms, fit), 3) for fit in (best.exact, best))
        print(f"rounding takes the best from {before} % to {after} %", file=sys.stderr)
    others = [fit.cognate for fit in fits]
    if cognates and (missing := 2 * others.count(False) - others.count(True)):
        print(
            f"{missing} of {2 * others.count(False)} cognates do not keep to what is asked for",
            file=sys.stderr,
        )
