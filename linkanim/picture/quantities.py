"""What a chart can show of a scene: quantities by name, and their values over one true period."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import BadInput
from linkanim.mechanics.linkage import Body, Pin
from linkanim.mechanics.motion import Motion
from linkanim.scenes.scene import Scene

_ROUNDING = 1e-13
"""Of what is as large as the extent, moved at the input's speed."""


class Series(NamedTuple):
    """A quantity over one true period: phases (n,), values (n, k), and what the k columns are called.

    Angles are in degrees here, for the eye; `unit` says so. A value that is not bounded is infinite, and
    one that is nothing but rounding errors is 0.
    """

    phases: NDArray[np.float64]
    values: NDArray[np.float64]
    unit: str
    labels: tuple[str, ...]


class _Quantity(NamedTuple):
    """How to read a quantity from a motion, and its unit; `{}` stands for the unit of length."""

    read: Callable[[Motion], Any]
    unit: str
    labels: tuple[str, ...] = ("",)


def quantities(scene: Scene) -> tuple[str, ...]:
    """Return the names of all quantities that a chart can show of this scene."""
    return tuple(_table(scene))


def series(scene: Scene, name: str, n: int) -> Series:
    """Return a quantity at n phases over one true period, at the scene's own speed.

    BadInput with the list of names where there is no such quantity.
    """
    return series_of(scene, name, scene.cycle(n))


def series_of(scene: Scene, name: str, cycle: Motion) -> Series:
    """Return a quantity of a cycle that is already solved; BadInput as in `series`."""
    table = _table(scene)
    if name not in table:
        raise BadInput(f"chart {name!r}: {scene.name} has no such quantity; it has {', '.join(table)}")
    quantity = table[name]
    values = np.asarray(quantity.read(cycle), float)
    columns = values if values.ndim == 2 else values[:, None]
    columns = np.where(np.abs(columns) <= _rounding(scene, quantity.unit, cycle), 0.0, columns)
    return Series(cycle.phase, columns, quantity.unit.format(scene.length_unit), quantity.labels)


def _rounding(scene: Scene, unit: str, cycle: Motion) -> float:
    """Return how large rounding errors of a quantity may be, from the extent and the input's speed."""
    extent = max(float(np.abs(places).max()) for places in cycle.position.values()) if "{}" in unit else 1.0
    order = 2 if "/s²" in unit else 1 if "/s" in unit else 0
    return _ROUNDING * extent * abs(scene.linkage.drive.speed) ** order


def _table(scene: Scene) -> Mapping[str, _Quantity]:
    linkage = scene.linkage
    table = dict(row for body in linkage.bodies for row in _of_body(body))
    moving = [joint.name for joint in linkage.joints if not isinstance(joint, Pin)]
    table |= dict(row for name in moving for row in _of_point(name, "", ""))
    masses = [body.name for body in linkage.bodies if body.com is not None]
    table |= dict(row for name in masses for row in _of_point(name, "com_", "com_"))
    table |= dict(row for item in linkage.springs for row in _of_strut("spring", item.name, _knows(item)))
    return table | dict(
        row for item in linkage.dampers for row in _of_strut("damper", item.name, _knows(item))
    )


def _knows(item: Any) -> bool:
    """Return whether the force of a spring or damper is known."""
    known = (getattr(item, "coefficient", None), getattr(item, "stiffness", None))
    return known != (None, None) and getattr(item, "free_length", 0) is not None


def _of_body(body: Body) -> Iterator[tuple[str, _Quantity]]:
    name = body.name
    turns = body.slider is None
    if turns and len(body.joints) > 1:
        yield f"{name}.angle", _Quantity(lambda motion: np.degrees(motion.angle[name]), "°")
        yield f"{name}.angular_velocity", _read("angular_velocity", name, "rad/s")
        yield f"{name}.angular_acceleration", _read("angular_acceleration", name, "rad/s²")
    elif not turns:
        yield f"{name}.travel", _read("travel", name, "{}")
        yield f"{name}.travel_velocity", _read("travel_velocity", name, "{}/s")
        yield f"{name}.travel_acceleration", _read("travel_acceleration", name, "{}/s²")
    per = "" if turns else "{}/"
    for order, label in enumerate(("coefficient", "second_coefficient")):
        unit = f"{per}rad{'²' if order else ''}" if per else ("rad/rad²" if order else "rad/rad")
        yield f"{name}.{label}", _coefficient(name, order, unit)


def _coefficient(name: str, order: int, unit: str) -> _Quantity:
    return _Quantity(lambda motion: motion.coefficient[name][order], unit)


def _read(attribute: str, name: str, unit: str) -> _Quantity:
    return _Quantity(lambda motion: getattr(motion, attribute)[name], unit)


def _of_point(name: str, prefix: str, attribute: str) -> Iterator[tuple[str, _Quantity]]:
    """Yield a point's position, in x and y, and how large its velocity and acceleration are."""
    where = f"{attribute}position"
    yield f"{name}.{prefix}position", _Quantity(lambda motion: getattr(motion, where)[name], "{}", ("x", "y"))
    for rate, unit in (("velocity", "{}/s"), ("acceleration", "{}/s²")):
        yield f"{name}.{prefix}{rate}", _size(f"{attribute}{rate}", name, unit)


def _size(attribute: str, name: str, unit: str) -> _Quantity:
    return _Quantity(lambda motion: np.hypot(*np.moveaxis(getattr(motion, attribute)[name], -1, 0)), unit)


def _of_strut(kind: str, name: str, known: bool) -> Iterator[tuple[str, _Quantity]]:
    parts = (("length", "{}"), ("rate", "{}/s"), *((("force", "N"),) if known else ()))
    for part, unit in parts:
        yield f"{name}.{part}", _strut(kind, name, part, unit)


def _strut(kind: str, name: str, part: str, unit: str) -> _Quantity:
    return _Quantity(lambda motion: getattr(getattr(motion, kind)[name], part), unit)
