"""What the options' texts mean: sizes, counts, sweeps; each raises `BadInput` in one sentence."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from decimal import Decimal, InvalidOperation

from linkanim import units
from linkanim.bounds import LARGEST_SIDE, MOST_LISTED, MOST_POSES
from linkanim.errors import BadInput
from linkanim.picture.look import TOGGLES
from linkanim.units import shown
from linkanim.workshop.media import PAGES

MOST_ROWS = 1_000_000
_MOST_DIGITS = 15


def sweep(text: str) -> tuple[Decimal, Decimal, int]:
    """Read `a:b:step` in degrees, exact as it is typed: the first, the step, and how many there are.

    b is included where it falls on a step.
    """
    parts = text.split(":")
    if len(parts) != 3:
        raise BadInput(f"{shown(text)} is not FIRST:LAST:STEP in degrees, such as 0:360:1")
    first, last, step = (_decimal(part, text) for part in parts)
    if step == 0 or (last - first) * step < 0:
        raise BadInput(f"the step of {shown(text)} does not lead from {first} to {last}; give one that does")
    if abs(last - first) >= abs(step) * MOST_ROWS:
        raise BadInput(f"{shown(text)} has more than {MOST_ROWS:,} rows; take a longer step")
    return first, step, int((last - first) / step) + 1


def _decimal(part: str, text: str) -> Decimal:
    try:
        value = Decimal(part.strip())
    except InvalidOperation:
        raise BadInput(f"{shown(part)} in {shown(text)} is not a number of degrees") from None
    if not value.is_finite() or abs(value) > Decimal("1e12"):
        raise BadInput(f"{shown(part)} in {shown(text)} is not a number of degrees between -1e12 and 1e12")
    return value


def size(text: str) -> tuple[int, int]:
    """Read `1280x720`: whole numbers of pixels, width first."""
    found = re.fullmatch(r"\s*(\d{1,6})\s*[x×X]\s*(\d{1,6})\s*", text)
    if not found or "0" in (found[1].lstrip("0") or "0", found[2].lstrip("0") or "0"):
        raise BadInput(f"{shown(text)} is not a size; write width x height in pixels, such as 1280x720")
    width, height = int(found[1]), int(found[2])
    if max(width, height) > LARGEST_SIDE:
        raise BadInput(f"{shown(text)} is too large; a side has {LARGEST_SIDE:,} pixels at the most")
    return width, height


def number(text: str) -> float:
    """Read a finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise BadInput(f"{shown(text)} is not a finite number")
    return value


def positive(text: str) -> float:
    """Read a finite number greater than zero."""
    try:
        value = number(text)
    except BadInput:
        value = 0.0
    if value <= 0:
        raise BadInput(f"{shown(text)} is not a number greater than zero")
    return value


def count(text: str) -> int:
    """Read a whole number of at least one."""
    if not re.fullmatch(r"\d{1,6}", text) or int(text) == 0:
        raise BadInput(f"{shown(text)} is not a whole number from 1 to 999999")
    return int(text)


def whole(text: str) -> int:
    """Read a whole number of at most 18 digits."""
    if not re.fullmatch(r"[+-]?[0-9]{1,18}", text):
        raise BadInput(f"{shown(text)} is not a whole number of at most 18 digits")
    return int(text)


def digits(text: str) -> int:
    """Read how many significant digits a number is written with."""
    found = count(text)
    if found > _MOST_DIGITS:
        raise BadInput(f"{shown(text)} digits are too many; a number has {_MOST_DIGITS} at the most")
    return found


def speeds(text: str) -> dict[str, float]:
    """Read angular speeds with commas between (rad/s), by their words; none is zero."""
    found = _several(text, units.angular_speed)
    if not found or not all(found.values()):
        raise BadInput(f'{shown(text)}: give speeds other than zero, such as "5 rad/s,10 rad/s"')
    return found


def angles(text: str) -> tuple[float, ...]:
    """Read angles with commas between, in radians."""
    found = _several(text, units.angle)
    if not found:
        raise BadInput(f'{shown(text)}: give angles with their unit, such as "87 deg,306 deg"')
    return tuple(found.values())


def _several(text: str, read: Callable[[str], float]) -> dict[str, float]:
    parts = [" ".join(part.split()) for part in text.split(",") if part.strip()]
    if len(parts) > MOST_LISTED:
        raise BadInput(f"{len(parts)} values are too many; a list has {MOST_LISTED} at the most")
    return {part: read(part) for part in parts}


def poses(text: str) -> int:
    """Read how many poses a figure has behind its own."""
    found = count(text)
    if found > MOST_POSES:
        raise BadInput(
            f"{shown(text)} is too many; a figure has {MOST_POSES} poses behind its own at the most"
        )
    return found


def box(text: str) -> tuple[float, ...]:
    """Read four numbers with commas between: x, y, width and height."""
    try:
        found = tuple(float(part) for part in text.split(","))
    except ValueError:
        found = ()
    if len(found) != 4 or not all(map(math.isfinite, found)):
        raise BadInput(f"{shown(text)} is not X,Y,W,H: four numbers with commas between, such as 0,0,200,100")
    return found


def pair(text: str) -> tuple[float, float]:
    """Read two numbers with a comma between: x and y."""
    try:
        found = tuple(float(part) for part in text.split(","))
    except ValueError:
        found = ()
    if len(found) != 2 or not all(map(math.isfinite, found)):
        raise BadInput(f"{shown(text.strip())} is not X,Y: two numbers with a comma between, such as 20,-40")
    return found


def length(text: str) -> float:
    """Read a length above zero in mm, which needs no unit."""
    found = units.length(text, unit="mm")
    if found <= 0:
        raise BadInput(f"{shown(text)} is no length above zero; give one such as 80 mm")
    return found


def step(text: str) -> float:
    """Read a length above zero in mm, such as `0.1 mm`."""
    found = units.length(text, unit="mm")
    if found <= 0:
        raise BadInput(f"{shown(text)} is no length to round to; give one above zero, such as 0.1 mm")
    return found


def millimetres(text: str) -> float:
    """Read a length, `12` or `1.2 cm`, in mm."""
    return units.length(text, unit="mm")


def sheet(text: str) -> str | tuple[float, float]:
    """Read the size of a sheet in mm, `600x400`, or the name of a page."""
    if text in PAGES:
        return text
    found = re.fullmatch(r"\s*([\d.]+)\s*[x×X]\s*([\d.]+)\s*(?:mm)?\s*", text)
    if not found:
        pages = ", ".join(PAGES)
        raise BadInput(f"{shown(text)} is no sheet: take {pages}, or a size in mm such as 600x400")
    return positive(found[1]), positive(found[2])


def timing(text: str) -> float | str:
    """Read an angle, or `column`."""
    return "column" if text.strip() == "column" else units.angle(text)


def vectors(text: str) -> frozenset[str]:
    """Read a list such as `v,a`: which of velocity and acceleration are drawn."""
    chosen = frozenset(part.strip() for part in text.split(","))
    if not chosen <= set(TOGGLES["vectors"].steps):
        raise BadInput(f"{shown(text)} is not a list of vectors; take v (velocity), a (acceleration) or v,a")
    return chosen
