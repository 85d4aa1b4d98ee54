"""The symbols of a worked solution: those of the figure's dimensions and of the scene's links."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from linkanim.explain.expression import Symbol
from linkanim.mechanics.facts.register import link_labels
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.rigid_bodies import holding
from linkanim.picture.figure import Figure
from linkanim.picture.labels.dimensions import symbols

Pair = tuple[str, str]
_PLAIN = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")


@dataclass(frozen=True)
class SymbolNames:
    """What lengths, angles and bodies of a linkage are called.

    `lengths` are the indices of the figure's lengths, by the two joints; `legs` those of a point of a body,
    along its line and beside it, by its name.
    """

    linkage: Linkage
    lengths: Mapping[frozenset[str], str]
    legs: Mapping[str, tuple[str, ...]]

    def length(self, start: str, end: str) -> str:
        """Return the index of the length between two joints."""
        return self.lengths.get(frozenset((start, end)), start + end)

    def angle(self, start: str, end: str) -> str:
        """Return the index of the angle of the way from one joint to another: its body's, or its own."""
        return self._angles.get((start, end), start + end)

    def turning(self, frame: int) -> str:
        """Return the index of the body that a rigid body of the linkage is."""
        return self._bodies[frame]

    def slide(self, joint: str) -> Symbol:
        """Return the symbol of a joint's way along its guide."""
        labels = link_labels(self.linkage)
        block = next((labels[body.name] for body in self.linkage.bodies if body.slider == joint), "")
        return Symbol("s", block if block.isdecimal() else joint)

    @cached_property
    def _angles(self) -> dict[Pair, str]:
        labels = link_labels(self.linkage)
        turning = [body for body in self.linkage.bodies if body.slider is None]
        return {(body.joints[0], body.joints[1]): labels[body.name] for body in reversed(turning)}

    @cached_property
    def _bodies(self) -> dict[int, str]:
        found = {n: "".join(list(frame)[:2]) for n, frame in enumerate(self.linkage.rigid_bodies)}
        for ends, label in self._angles.items():
            frame = holding(self.linkage.rigid_bodies, ends)
            if frame is not None:
                found[frame] = label
        return found


def names_of(figure: Figure) -> SymbolNames:
    """Return the symbols of a figure's linkage."""
    found = [length for length in symbols(figure).dimensions if not length.angle]
    bars = {frozenset(m.frame): m for m in reversed(found) if (m.begin, m.end) == (0, 1)}
    legs = {
        point.name: tuple(
            _index(m.symbol)
            for m in found
            if m.own == {*point.on, point.name} and m.frame == point.on and (m.begin, m.end) != (0, 1)
        )
        for point in symbols(figure).points
    }
    return SymbolNames(
        figure.linkage, {ends: _index(m.symbol) for ends, m in bars.items() if len(ends) == 2}, legs
    )


def _index(symbol: str) -> str:
    return symbol.translate(_PLAIN)[1:]
