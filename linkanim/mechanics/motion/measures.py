"""Measures: what can be told of each joint, centre of mass, body and strut.

Motion's attributes, the tables of `solve`, JSON and CSV read from here. Symbols are those of the textbooks
on mechanisms: ω, α, v, a; h and f for first kinematic coefficients.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from linkanim.mechanics.linkage.drive import ANGLE, TRAVEL, Coordinate
from linkanim.mechanics.linkage.linkage import Body, Linkage
from linkanim.mechanics.motion.derived import curvature_radius, normal, tangential


@dataclass(frozen=True, slots=True)
class Measure:
    """What can be told of each part of one sort, such as the angular velocity of a body.

    `name` ends the token, and is Motion's attribute where that holds it; `key` is the name in JSON and
    `heading` in a table of plain letters. In `unit`, `{}` stands for the unit of length. `order` counts
    derivatives in time. `read` takes a Motion or a Pose and the part's name.
    """

    name: str
    key: str
    symbol: str
    words: str
    unit: str
    order: int
    heading: str
    read: Callable[[Any, str], Any]


def _attribute(name: str) -> Callable[[Any, str], Any]:
    return lambda motion, part: getattr(motion, name)[part]


def _coefficient(order: int) -> Callable[[Any, str], Any]:
    return lambda motion, part: motion.coefficient[part][order]


def _solved(name: str, symbol: str, words: str, unit: str, order: int, heading: str = "") -> Measure:
    """Return the measure that Motion holds under its own name."""
    key = name.removeprefix("travel_").removeprefix("com_")
    return Measure(name, key, symbol, words, unit, order, heading or symbol, _attribute(name))


POINT = (
    _solved("position", "r", "position", "{}", 0),
    _solved("velocity", "v", "velocity", "{}/s", 1),
    _solved("acceleration", "a", "acceleration", "{}/s²", 2),
)
CENTRE = (
    _solved("com_position", "r", "position", "{}", 0),
    _solved("com_velocity", "v", "velocity", "{}/s", 1),
    _solved("com_acceleration", "a", "acceleration", "{}/s²", 2),
)
TURNING = (
    _solved("angle", "θ", "angle", "rad", 0, "angle"),
    _solved("angular_velocity", "ω", "angular velocity", "rad/s", 1, "omega"),
    _solved("angular_acceleration", "α", "angular acceleration", "rad/s²", 2, "alpha"),
)
TRAVELLING = (
    _solved("travel", "s", "travel", "{}", 0, "travel"),
    _solved("travel_velocity", "v", "velocity", "{}/s", 1),
    _solved("travel_acceleration", "a", "acceleration", "{}/s²", 2),
)


def _coefficients(symbol: str, letter: str, units: tuple[str, str], by: str) -> tuple[Measure, Measure]:
    """Return first and second derivative by the input; `by` is that in plain letters."""
    first, second = "kinematic coefficient", "second kinematic coefficient"
    headings = f"d{letter}/d{by}", f"d2{letter}/d{by}2"
    return (
        Measure("coefficient", "1", symbol, first, units[0], 0, headings[0], _coefficient(0)),
        Measure("second_coefficient", "2", f"{symbol}′", second, units[1], 0, headings[1], _coefficient(1)),
    )


def _per_input(coordinate: Coordinate) -> Mapping[bool, tuple[Measure, Measure]]:
    """Return the coefficients of what turns, and of what slides, by the input's angle or travel."""
    by, plain = coordinate.unit, "theta" if coordinate.is_angle else coordinate.name
    slid = f"{{}}/{by}" if coordinate.is_angle else "{0}/{0}"
    return {
        True: _coefficients("h", "q", (f"rad/{by}", f"rad/{by}²"), plain),
        False: _coefficients("f", "s", (slid, f"{slid}²"), plain),
    }


_COEFFICIENTS = {coordinate: _per_input(coordinate) for coordinate in (ANGLE, TRAVEL)}


def coefficients_of(linkage: Linkage, *, turning: bool) -> tuple[Measure, Measure]:
    """Return the two kinematic coefficients of bodies that turn, or slide: by the input's angle or travel."""
    return _COEFFICIENTS[linkage.drive.coordinate][turning]


def measures_of(linkage: Linkage, body: Body) -> tuple[tuple[Measure, ...], tuple[Measure, Measure]]:
    """Return the measures of a body that turns or slides, and its two kinematic coefficients."""
    turning = body.slider is None
    return TURNING if turning else TRAVELLING, coefficients_of(linkage, turning=turning)


def _of_kind(kind: str, name: str, symbol: str, words: str, unit: str, order: int) -> Measure:
    """Return a measure of the struts of one kind, "spring" or "damper"."""

    def read(motion: Any, strut: str) -> Any:
        return getattr(getattr(motion, kind)[strut], name)

    return Measure(name, name, symbol, words, unit, order, name, read)


def _strut_measures(kind: str) -> tuple[Measure, Measure, Measure]:
    """Return length, rate and force."""
    return (
        _of_kind(kind, "length", "L", "length", "{}", 0),
        _of_kind(kind, "rate", "v", "rate of length", "{}/s", 1),
        _of_kind(kind, "force", "F", "force", "N", int(kind == "damper")),
    )


def _directions(kind: str) -> tuple[Measure, Measure]:
    """Return direction and its rate."""
    return (
        _of_kind(kind, "direction", "θ", "direction", "rad", 0),
        _of_kind(kind, "direction_rate", "ω", "rate of direction", "rad/s", 1),
    )


SPRING, DAMPER = _strut_measures("spring"), _strut_measures("damper")
DIRECTIONS = {"spring": _directions("spring"), "damper": _directions("damper")}


def _bent(
    prefix: str, name: str, symbol: str, words: str, form: tuple[str, int, Callable[..., Any]]
) -> Measure:
    """Return a measure of a point's path, from its velocity and acceleration."""
    unit, order, work = form

    def read(motion: Any, part: str) -> Any:
        return work(
            getattr(motion, f"{prefix}velocity")[part], getattr(motion, f"{prefix}acceleration")[part]
        )

    return Measure(prefix + name, name, symbol, words, unit, order, name, read)


def _path_measures(prefix: str) -> tuple[Measure, ...]:
    return (
        _bent(prefix, "normal_acceleration", "aⁿ", "normal acceleration", ("{}/s²", 2, normal)),
        _bent(prefix, "tangential_acceleration", "aᵗ", "tangential acceleration", ("{}/s²", 2, tangential)),
        _bent(prefix, "curvature_radius", "ρ", "radius of curvature", ("{}", 0, curvature_radius)),
    )


PATH, CENTRE_PATH = _path_measures(""), _path_measures("com_")

FAMILIES = tuple(
    tuple(measure.name for measure in family) for family in (POINT, CENTRE, TURNING[1:], TRAVELLING)
)
"""What is solved, in the families that are worked out together, derivatives after what they are of."""
VECTORS = tuple(measure.name for measure in (*POINT, *CENTRE))
NUMBERS = tuple(measure.name for measure in (*TURNING[1:], *TRAVELLING))
DERIVATIVE_OF = {measure.name: measure.order for measure in (*POINT, *CENTRE, *TURNING, *TRAVELLING)}
