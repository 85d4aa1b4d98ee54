"""The tables of a hand-out: links, sliders, joints, centres of mass and struts at chosen instants."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import isinf, isnan
from typing import NamedTuple

from linkanim.digits import rounded
from linkanim.mechanics.facts.effort import effort_token
from linkanim.mechanics.facts.register import Quantity, called
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.motion.measures import TRAVELLING, TURNING, coefficients_of
from linkanim.paper.curves import Pace
from linkanim.paper.findings import Instant, Values, place_of

_MOST_SPEEDS = 4
"""Side by side in a table; of more a further table has the rest."""
_MOST_JOINTS = 10
"""More take the traced ones, then the first; all stand in the table of every quantity."""

_POINT = {"position.x": "x", "position.y": "y", "velocity": "v", "acceleration": "a"}
_CENTRE = {f"com_{name}": symbol for name, symbol in _POINT.items()}
_STRUT = {"length": "L", "direction": "θ", "rate": "v", "force": "F"}


_LINKS = "angle θ, kinematic coefficients h and h′, angular velocity ω and acceleration α"
_SLIDERS = "travel s, kinematic coefficients f and f′, velocity v and acceleration a"
_POINTS = "place x, y, sizes of velocity v and acceleration a"
_STRUTS = "length L, direction θ, rate of length v and force F"


class Family(NamedTuple):
    """What one table is of: its title, what it has, what a row is called, its parts, columns by measure."""

    title: str
    about: str
    head: str
    parts: tuple[tuple[str, str], ...]
    measures: dict[str, str]


class Column(NamedTuple):
    """A column of numbers: its symbol and unit, the measure, and the speed that it is at, None for any."""

    symbol: str
    unit: str
    measure: str
    pace: Pace | None


@dataclass(frozen=True)
class ValueTable:
    """A table: its title, what it has, its columns, and under each instant a row for each part."""

    title: str
    about: str
    head: str
    columns: tuple[Column, ...]
    groups: tuple[tuple[str, tuple[tuple[str, tuple[str, ...]], ...]], ...]
    notes: tuple[str, ...]


def value_tables(
    values: Values, instants: tuple[Instant, ...], paces: tuple[Pace, ...], digits: int
) -> Iterator[ValueTable]:
    """Yield the tables of a scene, to so many significant digits, each with all instants."""
    for family in _families(values):
        for start in range(0, len(paces), _MOST_SPEEDS):
            some = paces[start : start + _MOST_SPEEDS]
            columns = tuple(_columns(values, family, some, first=not start))
            if columns:
                yield _table(values, family, columns, instants, digits)


def _families(values: Values) -> Iterator[Family]:
    linkage, scene = values.scene.linkage, values.scene
    names = scene.info.link_names
    turning = tuple((called(body, names), body.name) for body in linkage.bodies if not body.slider)
    sliding = tuple((called(body, names), body.name) for body in linkage.bodies if body.slider)
    massive = tuple((called(body, names), body.name) for body in linkage.bodies if body.com is not None)
    moving = [joint.name for joint in linkage.joints if not joint.fixed]
    moving.sort(key=lambda name: name not in scene.trace)
    kept = moving[:_MOST_JOINTS]
    in_order = tuple((joint.name, joint.name) for joint in linkage.joints if joint.name in kept)
    struts = tuple((strut.name, strut.name) for strut in linkage.springs + linkage.dampers)
    yield Family("Links", _LINKS, "link", turning, _symbols(linkage, turning=True))
    yield Family("Sliders", _SLIDERS, "slider", sliding, _symbols(linkage, turning=False))
    yield Family("Joints", _POINTS, "joint", in_order, _POINT)
    yield Family("Centres of mass", _POINTS, "link", massive, _CENTRE)
    yield Family("Springs and dampers", _STRUTS, "element", struts, _STRUT)
    whole = {"transmission_angle": "μ", "mechanical_advantage": "MA", effort_token(linkage): "T"}
    symbols = {token: scene.quantities[token].symbol for token in whole if token in scene.quantities}
    about = ", ".join(
        scene.quantities[token].words.partition(": ")[2] or scene.quantities[token].words.lower()
        for token in symbols
    )
    yield Family("The whole mechanism", about, "", (("", ""),) if symbols else (), symbols)


def _symbols(linkage: Linkage, *, turning: bool) -> dict[str, str]:
    """Return the symbols of what bodies that turn, or slide, have, the kinematic coefficients second."""
    place, *rates = TURNING if turning else TRAVELLING
    return {one.name: one.symbol for one in (place, *coefficients_of(linkage, turning=turning), *rates)}


def _quantity(values: Values, part: str, measure: str) -> Quantity | None:
    return values.scene.quantities.get(f"{part}.{measure}" if part else measure)


def _columns(values: Values, family: Family, paces: tuple[Pace, ...], *, first: bool) -> Iterator[Column]:
    """Yield what is the same at every speed, then the rest at each."""
    for measure, symbol in family.measures.items():
        found = [one for _, part in family.parts if (one := _quantity(values, part, measure))]
        if found:
            unit, order = found[0].shown_unit(values.scene.length_unit), max(one.order for one in found)
            if order or first:
                yield from (Column(symbol, unit, measure, pace) for pace in (paces if order else (None,)))


def _table(
    values: Values, family: Family, columns: tuple[Column, ...], instants: tuple[Instant, ...], digits: int
) -> ValueTable:
    unbounded, unknown = [], False
    groups: list[tuple[str, tuple[tuple[str, tuple[str, ...]], ...]]] = []
    for instant in instants:
        found = {
            label: [_value(values, part, column, instant) for column in columns]
            for label, part in family.parts
        }
        if any(isinf(value) for row in found.values() for value in row):
            unbounded.append(place_of(values.scene, instant._replace(words="")))
        unknown |= any(isnan(value) for row in found.values() for value in row)
        rows = tuple((label, tuple(rounded(one, digits) for one in row)) for label, row in found.items())
        groups.append((place_of(values.scene, instant), rows))
    notes = [f"∞: unbounded at {', '.join(unbounded)}."] if unbounded else []
    notes += ["–: has no value there, or is not given."] if unknown else []
    if len(family.parts) > 1:
        return ValueTable(family.title, family.about, family.head, columns, tuple(groups), tuple(notes))
    (title, _), *_ = family.parts
    alone = tuple((place, cells) for place, rows in groups for _, cells in rows)
    return ValueTable(title or family.title, family.about, "at", columns, (("", alone),), tuple(notes))


def _value(values: Values, part: str, column: Column, instant: Instant) -> float:
    quantity = _quantity(values, part, column.measure)
    pace = column.pace or Pace(values.scene.linkage.drive.speed, "")
    return values.of(quantity, instant, pace) if quantity else float("nan")
