"""The register of quantities: what can be told of a linkage, in which symbol, words and unit.

Motion's attributes, charts, the tables of `solve`, JSON, CSV and refusals all read from here. Symbols are
those of the textbooks on mechanisms (ω, α, v, a; h and f for first kinematic coefficients); subscripts are
Unicode's digits (ω₃) or stand in braces (v_{B}).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from linkanim.errors import BadInput

from .derived import (
    curvature_radius,
    dyads_of,
    input_rate,
    mechanical_advantage,
    normal,
    output_body,
    pole,
    tangential,
    transmission_angle,
    worst_transmission,
)
from .effort import effort_token, input_effort
from .kinds import Pin
from .linkage import Body, Damper, Linkage, Spring

_STANDARD = {
    "crank": "2",
    "coupler": "3",
    "rod": "3",
    "rocker": "4",
    "slider": "4",
    "coupler2": "5",
    "rocker2": "6",
}
"""The numbers that textbooks give the links of the common linkages; the ground is 1."""
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_NEAREST = 3
_ROUNDING = 1e-13
"""Of what is as large as the extent, moved at the input's speed."""


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


_BY_ANGLE = {
    True: _coefficients("h", "q", ("rad/rad", "rad/rad²"), "theta"),
    False: _coefficients("f", "s", ("{}/rad", "{}/rad²"), "theta"),
}
_BY_TRAVEL = {
    True: _coefficients("h", "q", ("rad/{}", "rad/{}²"), "travel"),
    False: _coefficients("f", "s", ("{0}/{0}", "{0}/{0}²"), "travel"),
}


def coefficients_of(linkage: Linkage, *, turning: bool) -> tuple[Measure, Measure]:
    """Return the two kinematic coefficients of bodies that turn, or slide: by the input's angle or travel."""
    return (_BY_TRAVEL if linkage.slides else _BY_ANGLE)[turning]


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


@dataclass(frozen=True, slots=True)
class Quantity:
    """A quantity of one linkage: `rocker.angular_velocity`, ω₄, "Rocker: angular velocity", rad/s.

    `read` takes a Motion (arrays) or a Pose (floats) and gives radians and the scene's unit of length:
    one value an instant, or one in each of `columns`. `unit` and `order` are as in `Measure`.
    """

    token: str
    symbol: str
    words: str
    unit: str
    order: int
    read: Callable[[Any], Any]
    columns: tuple[str, ...] = ("",)

    def shown(self, motion: Any) -> Any:
        """Return the values as people read them: angles in degrees."""
        found = self.read(motion)
        return np.degrees(found) if self.unit == "rad" else found

    def rounding(self, cycle: Any) -> float:
        """Return how large rounding errors may be over a cycle, from its extent and the input's speed."""
        extent = max(float(np.abs(places).max()) for places in cycle.position.values())
        size = extent if "{}" in self.unit else 1.0
        return _ROUNDING * size * abs(float(cycle.input_speed)) ** self.order

    def shown_unit(self, length_unit: str) -> str:
        """Return the unit that goes with `shown`."""
        return "°" if self.unit == "rad" else self.unit.format(length_unit)

    def title(self, length_unit: str) -> str:
        """Return what an axis is titled: "Rocker: angular velocity ω₄ (rad/s)"."""
        unit = self.shown_unit(length_unit)
        return f"{self.words} {self.symbol}" + (f" ({unit})" if unit else "")


def indexed(symbol: str, index: str) -> str:
    """Return a symbol with its subscript: ω₄, v_{B}."""
    lowered = index.isdecimal() and index.isascii()
    return symbol + (index.translate(_SUBSCRIPTS) if lowered else f"_{{{index}}}")


def plain(symbol: str) -> str:
    """Return a symbol for plain text: v_B for v_{B}."""
    return symbol.replace("{", "").replace("}", "")


def plain_unit(unit: str, length_unit: str) -> str:
    """Return a unit in plain letters, angles in degrees: "rad/s^2", "deg"."""
    return "deg" if unit == "rad" else unit.format(length_unit).replace("²", "^2")


def link_labels(linkage: Linkage) -> dict[str, str]:
    """Return what each body is called in symbols: its number, by name or by custom; else its name."""
    named = [body.name for body in linkage.bodies]
    taken = {name for name in named if name.isdecimal()}
    labels = {}
    for name in named:
        number = _STANDARD.get(name, name)
        labels[name] = name if name in taken or number in taken else number
        taken.add(labels[name])
    return labels


def register(linkage: Linkage) -> dict[str, Quantity]:
    """Return all quantities of a linkage by their tokens: bodies, joints, centres of mass, struts."""
    return {quantity.token: quantity for quantity in _quantities(linkage)}


def look_up(known: Mapping[str, Quantity], token: str, of: str) -> Quantity:
    """Return the quantity of that token; BadInput with the nearest ones and the list where there is none.

    `of` says whose quantities they are.
    """
    if token in known:
        return known[token]
    from difflib import get_close_matches

    near = get_close_matches(token, list(known), n=_NEAREST)
    meant = f" (did you mean {' or '.join(near)}?)" if near else ""
    raise BadInput(f"quantity {token!r}: {of} has none of this name{meant}; it has {', '.join(known)}")


def _quantities(linkage: Linkage) -> Iterator[Quantity]:
    labels = link_labels(linkage)
    for body in linkage.bodies:
        yield from _of_body(linkage, body, labels[body.name])
    for joint in linkage.joints:
        if not isinstance(joint, Pin):
            for measure in POINT:
                yield from _of_point(measure, joint.name, joint.name, joint.name)
            for measure in PATH:
                yield _bound(measure, joint.name, indexed(measure.symbol, joint.name), joint.name)
    for body in linkage.bodies:
        if body.com is not None:
            label, words = f"G{labels[body.name]}", f"{called(body)}, centre of mass"
            for measure in CENTRE:
                yield from _of_point(measure, body.name, label, words)
            for measure in CENTRE_PATH:
                yield _bound(measure, body.name, indexed(measure.symbol, label), words)
    for spring in linkage.springs:
        yield from _of_strut(spring, linkage.strut_word(spring), shared=spring.name in labels)
    for damper in linkage.dampers:
        yield from _of_strut(damper, linkage.strut_word(damper), shared=damper.name in labels)
    for body in linkage.bodies:
        if body.slider is None and len(body.joints) > 1:
            yield from _of_pole(body, labels[body.name])
    yield from _of_whole(linkage)


def _of_pole(body: Body, label: str) -> Iterator[Quantity]:
    """Yield where a body's instant centre to the ground lies, and each coordinate."""
    token, said, index = f"{body.name}.pole", f"{called(body)}: instant centre to the ground", f"P1{label}"

    def whole(motion: Any) -> Any:
        found = pole(motion, body)
        return found if isinstance(motion.phase, float) else np.stack(found, axis=-1)

    yield Quantity(token, indexed("r", index), said, "{}", 0, whole, ("x", "y"))
    for place, axis in enumerate("xy"):
        symbol = indexed(axis, index)
        yield Quantity(f"{token}.{axis}", symbol, f"{said}, {axis}", "{}", 0, _component(whole, place))


def _of_whole(linkage: Linkage) -> Iterator[Quantity]:
    """Yield what is told of the linkage as a whole: its input, transmission and advantage."""
    if linkage.slides:
        yield Quantity("input.velocity", "v_{in}", "Input: velocity", "{}/s", 1, input_rate)
    else:
        yield Quantity("input.angular_velocity", "ω_{in}", "Input: angular velocity", "rad/s", 1, input_rate)
    if linkage.forceful:
        yield _effort(linkage)
    dyads = dyads_of(linkage)
    if dyads:
        read: Callable[[Any], Any] = partial(worst_transmission, dyads=dyads)
        yield Quantity("transmission_angle", "μ", "Transmission angle", "rad", 0, read)
    for dyad in dyads if len(dyads) > 1 else ():
        read, said = partial(transmission_angle, dyad=dyad), f"{dyad}: transmission angle"
        yield Quantity(f"{dyad}.transmission_angle", indexed("μ", dyad), said, "rad", 0, read)
    output = output_body(linkage)
    if output is not None and (output.slider or not linkage.slides):
        read = mechanical_advantage(linkage)
        yield Quantity("mechanical_advantage", "MA", "Mechanical advantage", "", 0, read)


def _effort(linkage: Linkage) -> Quantity:
    """Return the torque at the input, or the force of what drives in a straight line."""
    damped = any(damper.forceful for damper in linkage.dampers)
    order = 2 if any(body.forceful for body in linkage.bodies) else int(damped)
    token = effort_token(linkage)
    if token == "input.force":
        return Quantity(token, "F_{in}", "Input: force", "N", order, input_effort)
    return Quantity(token, "T_{in}", "Input: torque", "N m", order, input_effort)


def called(body: Body) -> str:
    """Return what a body is called in words: "Rocker", "Link 3", "Slider 5"."""
    if not body.name.isdecimal():
        return body.name[:1].upper() + body.name[1:]
    return f"{'Slider' if body.slider else 'Link'} {body.name}"


def _of_body(linkage: Linkage, body: Body, label: str) -> Iterator[Quantity]:
    own, slopes = measures_of(linkage, body)
    for measure in (*own, *slopes):
        yield _bound(measure, body.name, indexed(measure.symbol, label), called(body))


def _bound(measure: Measure, part: str, symbol: str, words: str) -> Quantity:
    """Return the quantity that a measure is of one part."""
    token, said = f"{part}.{measure.name}", f"{words}: {measure.words}"
    told = (token, symbol, said, measure.unit, measure.order)
    return Quantity(*told, lambda motion: measure.read(motion, part))


def _of_point(measure: Measure, part: str, label: str, words: str) -> Iterator[Quantity]:
    """Yield a vector, a position as its two components and else its magnitude, and each component."""
    token, said = f"{part}.{measure.name}", f"{words}: {measure.words}"

    def vector(motion: Any) -> Any:
        return measure.read(motion, part)

    whole = (indexed(measure.symbol, label), said, measure.unit, measure.order)
    if measure.order:
        yield Quantity(token, *whole, lambda motion: _size(vector(motion)))
    else:
        yield Quantity(token, *whole, vector, ("x", "y"))
    for index, axis in enumerate("xy"):
        symbol = indexed(measure.symbol, f"{label}{axis}") if measure.order else indexed(axis, label)
        yield Quantity(
            f"{token}.{axis}",
            symbol,
            f"{said}, {axis}",
            measure.unit,
            measure.order,
            _component(vector, index),
        )


def _component(vector: Callable[[Any], Any], index: int) -> Callable[[Any], Any]:
    return lambda motion: parts(vector(motion))[index]


def parts(vector: Any) -> tuple[Any, Any]:
    """Return x and y of a pair of floats, or of an array (..., 2)."""
    return vector if isinstance(vector, tuple) else (vector[..., 0], vector[..., 1])


def _size(vector: Any) -> Any:
    x, y = parts(vector)
    return math.hypot(x, y) if isinstance(vector, tuple) else np.hypot(x, y)


def _of_strut(strut: Spring | Damper, word: str, *, shared: bool) -> Iterator[Quantity]:
    """Yield a strut's quantities; in symbols `word` tells it from a body of the same name."""
    kind, measures = ("damper", DAMPER) if isinstance(strut, Damper) else ("spring", SPRING)
    for measure in (*measures, *DIRECTIONS[kind]):
        if measure.name != "force" or strut.forceful:
            symbol = indexed(measure.symbol, f"{word} {strut.name}" if shared else strut.name)
            yield _bound(measure, strut.name, symbol, f"{word.capitalize()} {strut.name}")
