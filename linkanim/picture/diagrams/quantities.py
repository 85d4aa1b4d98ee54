"""What a chart shows of a scene: quantities by name, and their values over one true period."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.facts.register import Quantity, look_up
from linkanim.mechanics.motion.motion import Motion
from linkanim.scenes.scene import Scene


class Series(NamedTuple):
    """A quantity over one true period: phases (n,), values (n, k), and what the k columns are called.

    Angles are in degrees here, for the eye; `unit` says so. A value that is not bounded is infinite, and
    one that is nothing but rounding errors is 0.
    """

    phases: NDArray[np.float64]
    values: NDArray[np.float64]
    unit: str
    labels: tuple[str, ...]


def quantity(scene: Scene, token: str) -> Quantity:
    """Return a scene's quantity, of a body by its name in the scene or by what it is called.

    BadInput with the nearest ones and the list where there is none.
    """
    owner, dot, measure = token.partition(".")
    own = {words: name for name, words in scene.info.link_names.items()}
    named = token if token in scene.quantities else f"{own.get(owner, owner)}{dot}{measure}"
    return look_up(scene.quantities, named if named in scene.quantities else token, scene.name)


def broken(series: Series, quantity: Quantity, cycle: Motion) -> Series:
    """Return a series over a cycle with infinite values where it is not bounded between its instants."""
    places = quantity.unbounded_between(cycle)
    if not len(places):
        return series
    index = np.searchsorted(series.phases, places)
    phases, values = np.insert(series.phases, index, places), np.insert(series.values, index, np.inf, axis=0)
    return series._replace(phases=phases, values=values)


def series_of(scene: Scene, quantity: Quantity, cycle: Motion) -> Series:
    """Return a quantity of a cycle that is already solved."""
    values = np.asarray(quantity.shown(cycle), float)
    columns = values if values.ndim == 2 else values[:, None]
    return Series(cycle.phase, columns, quantity.shown_unit(scene.length_unit), quantity.columns)
