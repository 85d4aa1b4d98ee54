"""Which charts a hand-out has, in the order in which a report on a mechanism goes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain
from typing import NamedTuple

from linkanim.mechanics.facts.effort import effort_token
from linkanim.mechanics.facts.register import bodies_in_chain
from linkanim.paper.curves import Pace
from linkanim.paper.findings import Values

_MOST_CURVES = 6
"""On one chart."""
_CENTRE = ", centre of mass"


class PlannedChart(NamedTuple):
    """A chart of some quantities, and what it is called."""

    tokens: tuple[str, ...]
    caption: str


def topics(values: Values, paces: tuple[Pace, ...]) -> dict[str, list[PlannedChart]]:
    """Return the charts by topic; nothing of what does not change, no topic without a chart."""
    found = {title: [*charts] for title, charts in _ChartChoice(values, several=len(paces) > 1).topics()}
    return {title: charts for title, charts in found.items() if charts}


@dataclass(frozen=True)
class _ChartChoice:
    values: Values
    several: bool
    """Speeds: each quantity that they change has a chart of its own."""

    def topics(self) -> Iterator[tuple[str, Iterable[PlannedChart]]]:
        """Yield the title and the charts of each."""
        linkage = self.values.scene.linkage
        # a crank that is driven itself turns as the input does
        driven = linkage.drive.actuator.along is None
        cranks = {body.name for body in linkage.bodies if driven and linkage.crank_of(body)}
        turning = [body.name for body in bodies_in_chain(linkage) if body.name not in cranks]
        sliding = [body.name for body in linkage.bodies if body.slider]
        massive = [body.name for body in linkage.bodies if body.com is not None and body.name not in cranks]
        struts = [strut.name for strut in linkage.springs + linkage.dampers]
        traced = [] if self.several and turning else [*self.values.scene.trace]
        links, whole = [*turning, *sliding], self._charts(["transmission_angle"])
        places = self._all(("angle", turning), ("travel", sliding))
        yield "Positions", chain(places, whole, self._all(("coefficient", links)))
        rates = ("angular_{}", turning), ("travel_{}", sliding), ("{}", traced)
        velocities, accelerations = (
            [(form.format(rate), parts) for form, parts in rates] for rate in ("velocity", "acceleration")
        )
        yield "Velocities", self._all(*velocities)
        yield "Accelerations", self._all(("second_coefficient", links), *accelerations)
        yield "Centres of mass", self._all(("com_velocity", massive), ("com_acceleration", massive))
        effort = self._charts([effort_token(linkage)])
        of_struts = self._all(("length", struts), ("rate", struts), ("force", struts))
        yield "Springs, dampers and input" if struts else "Input", [*of_struts, *effort]

    def _all(self, *planned: tuple[str, list[str]]) -> Iterator[PlannedChart]:
        for measure, parts in planned:
            yield from self._charts([f"{part}.{measure}" for part in parts])

    def _charts(self, tokens: list[str]) -> Iterator[PlannedChart]:
        """Yield a chart of what the speed leaves as it is, and one of each that it changes."""
        known = self.values.scene.quantities
        changing = [token for token in tokens if token in known and self.values.changes(known[token])]
        fixed = [token for token in changing if not (self.several and known[token].order)]
        apart = [token for token in changing if token not in fixed]
        for some in (fixed[:_MOST_CURVES], *([token] for token in apart[:_MOST_CURVES])):
            if some:
                yield PlannedChart(tuple(some), self._caption(some))

    def _caption(self, tokens: list[str]) -> str:
        """Return what is charted of which parts: "Angular velocity of link 3, link 4"."""
        known = [self.values.scene.quantities[token].words for token in tokens]
        if ":" not in known[0]:
            return known[0]
        parts = [words.partition(":")[0] for words in known]
        what = dict.fromkeys(words.partition(": ")[2] for words in known)
        first = " and ".join(what)
        if all(part.endswith(_CENTRE) for part in parts):
            first, parts = f"{first} of centres of mass", [part.removesuffix(_CENTRE) for part in parts]
        return f"{first[:1].upper()}{first[1:]}: {', '.join(parts)}"
