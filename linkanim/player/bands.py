"""A mode: the band within which traced points stay when each length is off by a tolerance.

The band is first order, drawn to scale; its words say how far a point and the output may be off, and by which
length chiefly. It belongs to the lengths that it was asked for, and goes when these change.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, ClassVar

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.picture.build_sheet import Head
from linkanim.picture.drawn import Addition
from linkanim.picture.marks import TraceBands
from linkanim.player import rules
from linkanim.player.action import Action
from linkanim.player.keys import BACK_BAR, HOME_BAR, LAST_BAR, MOVING_BAR, BarEntry, KeyRow, ModeKeys, both
from linkanim.player.making import Construction
from linkanim.player.state import (
    Mode,
    Rule,
    State,
    with_toast,
)
from linkanim.scenes.scene import Scene
from linkanim.units import significant
from linkanim.words import name_said, said, said_as

if TYPE_CHECKING:
    from linkanim.scenes.deviation import Off, Tolerance

_USUAL = 1e-3
"""The tolerance at first, as a share of the linkage's extent, or a little less."""
_FINEST, _COARSEST = -9, 1
"""How much finer and coarser it can be: in steps of 1, 2, 5, 10."""
_PLACES = 288
"""The places of a period along a band."""


@lru_cache(maxsize=2)
def _tolerance(scene: Scene) -> Tolerance:
    """Return how far a scene is off at the usual tolerance; BadInput where there is no first order."""
    from linkanim.scenes.deviation import tolerance

    return tolerance(scene, _USUAL * scene.linkage.extent, samples=0)


def _round(level: int) -> float:
    """Return the number of a level: 1, 2, 5, 10, ..."""
    decade, step = divmod(level, 3)
    return float(f"{(1, 2, 5)[step]}e{decade}")


def _usual(tolerance: Tolerance) -> int:
    """Return the level of the greatest round number that is not above the usual tolerance."""
    lowest = 3 * math.floor(math.log10(tolerance.by))
    return max(level for level in range(lowest, lowest + 3) if _round(level) <= tolerance.by)


def _toggle(state: State, _: None) -> State:
    """Show the band, or hide it; a sentence where there is none."""
    if state.of(ToleranceBand):
        return state.without(ToleranceBand)
    try:
        tolerance = _tolerance(state.scene)
    except BadInput as error:
        return with_toast(state, str(error))
    bare = state.unlisted.unhelped.without(Construction)
    return bare if bare.keys.alone else bare.with_mode(ToleranceBand(bare.scene, _usual(tolerance)))


def _by(state: State, steps: int) -> State:
    """Take a coarser tolerance by steps, or a finer one."""
    band = state.of(ToleranceBand)
    if band is None:
        return state
    usual = _usual(_tolerance(band.scene))
    level = min(max(band.level + steps, usual + _FINEST), usual + _COARSEST)
    return state.with_mode(replace(band, level=level))


@frozen
class ToleranceBand(Mode):
    """The band of a scene at a tolerance, whose number is that of a level: 1, 2, 5, 10, ..."""

    scene: Scene
    level: int

    keys = ModeKeys(
        "tolerance",
        {
            "in Shift+E": (
                KeyRow(
                    "↑ ↓", "a coarser tolerance of all lengths, a finer one", both("down", "up", "tolerate")
                ),
                KeyRow("Shift+E, Esc", "hide the band"),
            )
        },
    )
    bar: ClassVar[tuple[BarEntry, ...]] = (
        *(BACK_BAR, HOME_BAR, *MOVING_BAR),
        BarEntry("nearer", Action("tolerate", -1), 4, leads=True),
        *(BarEntry("farther", Action("tolerate", 1), 4), *LAST_BAR),
    )
    actions: ClassVar[Mapping[str, Rule]] = {
        "tolerance": Rule(rules.nothing, _toggle),
        "tolerate": Rule(rules.whole, _by),  # steps of 1, 2, 5, 10
    }
    has_head, leads = True, True

    def agreed(self, before: State, after: State) -> State:
        """Return the state without the band where its lengths are no longer the scene's."""
        del before
        return after if after.scene is self.scene else after.without(ToleranceBand)

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return the band, and the words on it."""
        if state.scene is not self.scene:
            return ()
        tolerance, scene, by = _tolerance(self.scene), self.scene, _round(self.level)
        times, joints = by / tolerance.by, scene.linkage.by_name
        edges = tuple(_edges(scene, off, times) for off in tolerance.quantities if off.name in joints)
        first, *others = (_in_words(scene, off, times) for off in tolerance.quantities)
        most = said("chiefly by {dimension}", dimension=name_said(tolerance.most(tolerance.quantities[0])))
        facts = said_as("list of clauses", "; ").join([most, *others])
        length = f"{significant(by, 3)} {scene.length_unit}"
        sentence = said("each length ± {length}: {effect}", length=length, effect=first)
        return TraceBands(edges), Head(sentence, (facts,))


def _in_words(scene: Scene, off: Off, times: float) -> str:
    """Return how far a quantity may be off, in words."""
    most, unit = times * off.worst, scene.length_unit
    far = f"{significant(math.degrees(most), 3)}°" if off.is_angle else f"{significant(most, 3)} {unit}"
    if off.name in scene.linkage.by_name:
        return said("{joint} up to {distance} off", joint=off.name, distance=far)
    bodies = [body.name for body in scene.linkage.bodies]
    if off.name not in bodies:
        return said("the {quantity} up to {range}", quantity=said(off.name), range=far)
    link = name_said(off.name)
    if off.is_angle:
        return said("the angle of {link} up to {range}", link=link, range=far)
    return said("the travel of {link} up to {range}", link=link, range=far)


@lru_cache(maxsize=16)
def _way(scene: Scene, joint: str) -> tuple[tuple[complex, ...], tuple[complex, ...]]:
    """Return a joint's places over a period, and the directions to the left of its way."""
    import numpy as np

    motion = scene.cycle(_PLACES, derivatives=1)
    place, rate = (np.asarray(part[joint]) @ np.array([1, 1j]) for part in (motion.position, motion.velocity))
    size = np.abs(rate)
    left = np.where(size > 0, 1j * rate / np.where(size > 0, size, 1.0), 0.0)
    return tuple(place.tolist()), tuple(left.tolist())


def _edges(scene: Scene, off: Off, times: float) -> tuple[tuple[complex, complex], ...]:
    """Return the two edges of a band, from place to place."""
    import numpy as np

    places, left = _way(scene, off.name)
    phases = np.linspace(0, scene.period, _PLACES, endpoint=False)
    reach = times * np.interp(phases, off.phases, off.bound, period=scene.period)
    return tuple(
        (at + far * side, at - far * side) for at, side, far in zip(places, left, reach.tolist(), strict=True)
    )
