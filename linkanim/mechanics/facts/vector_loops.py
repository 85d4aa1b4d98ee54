"""Vector loops: the two ways from the ground to the place where each dyad closes, as vectors end to end.

What both ways share at their beginning is left out. Along a guide runs a vector of unknown length; where the
guide is stated beside a joint, its offset leads from that joint to it (Norton, Design of Machinery).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal, NamedTuple

from linkanim.mechanics.formulas.exact import unit
from linkanim.mechanics.linkage.dyads import RPP, RPR
from linkanim.mechanics.linkage.joint import Joint, Line
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.rigid_bodies import Rigid

Place = Callable[[str], complex]
VectorSort = Literal["ground", "bar", "offset", "slide", "cylinder"]


class LoopVector(NamedTuple):
    """A vector of a loop at one pose, its ends x + yi.

    A bar's leads from the first of its `joints` to the second, as a cylinder's does; offset and slide are of
    the guide that is stated by the first, on which the second slides. `axis` are two joints of the body that
    it turns with, None of the ground. `along` is the direction, of length 1, that its length counts in: a
    slide's may run against it.
    """

    sort: VectorSort
    joints: tuple[str, str]
    axis: tuple[str, str] | None
    begin: complex
    end: complex
    along: complex


Way = tuple[LoopVector, ...]


class ClosedLoop(NamedTuple):
    """Two ways to one place, which the dyad of a joint closes, or the cylinder that turns it."""

    joint: str
    ways: tuple[Way, Way]


def vector_loops(linkage: Linkage, place: Place) -> tuple[ClosedLoop, ...]:
    """Return a loop for the cylinder that drives, if one does, and for each dyad in the order of solving.

    `place` gives joints as x + yi at the pose.
    """
    return tuple(_LoopWays(linkage, place).loops())


def _parted(one: Way, other: Way) -> tuple[Way, Way]:
    """Return two ways without the beginning that they share."""
    shared = next((n for n, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), None)
    shared = min(len(one), len(other)) if shared is None else shared
    return one[shared:], other[shared:]


@dataclass(frozen=True)
class _LoopWays:
    """Ways from the driven pivot, or from where the line of a driven slider begins."""

    linkage: Linkage
    place: Place

    def loops(self) -> Iterator[ClosedLoop]:
        """Yield the loops."""
        ends = self.linkage.drive.actuator.along
        if ends:
            ways = (*self.to(ends[0]), self._vector("cylinder", ends, ends)), self.to(ends[1])
            yield ClosedLoop(self.linkage.drive.joint, _parted(*ways))
        for joint in self.linkage.joints:
            if joint.dyad:
                yield ClosedLoop(joint.name, _parted(*self.closing(joint)))

    def closing(self, joint: Joint) -> tuple[Way, Way]:
        """Return the two ways to the place where a dyad closes."""
        if isinstance(joint, RPR):
            guide = self._slot((joint.pivot, joint.name), 0.0, joint.offset)
            return self.to(joint.through), (*self.to(joint.pivot), *guide(joint.pivot, joint.through))
        if isinstance(joint, RPP):
            slot = self._slot(joint.line.on, joint.line.angle + joint.slot, 0.0)
            return self.to(joint.pin), (*self._on_line(joint.line, joint.name), *slot(joint.name, joint.pin))
        first, *others = ((*self.to(start), self._bar(start, joint.name)) for start, _ in joint.bars)
        line: Line | None = getattr(joint, "line", None)
        return first, self._on_line(line, joint.name) if line else others[0]

    def to(self, name: str) -> Way:
        """Return one way to a joint: along the first bar that it is found by, else along its line."""
        joint = self.linkage.joint(name)
        if joint.fixed:
            origin = self._origin
            return () if name == origin else (self._vector("ground", (origin, name), None),)
        if isinstance(joint, Rigid):
            start = joint.on[0]
            return (*self.to(start), self._vector("bar", (start, name), joint.on))
        if joint.bars:
            (start, _), *_ = joint.bars
            return (*self.to(start), self._bar(start, name))
        return self._on_line(joint.line, name)  # type: ignore[attr-defined]  # all others have one

    @property
    def _origin(self) -> str:
        joint = self.linkage.joint(self.linkage.drive.joint)
        return joint.needs[0]

    def _bar(self, start: str, end: str) -> LoopVector:
        return self._vector("bar", (start, end), (start, end))

    def _vector(self, sort: VectorSort, ends: tuple[str, str], axis: tuple[str, str] | None) -> LoopVector:
        begin, end = map(self.place, ends)
        return LoopVector(sort, ends, axis, begin, end, _direction(begin, end))

    def _on_line(self, line: Line, point: str) -> Way:
        guide = self._slot(line.on, line.angle, line.offset)
        return (*self.to(line.through), *guide(line.through, point))

    def _slot(
        self, axis: tuple[str, str] | None, angle: float, offset: float
    ) -> Callable[[str, str], Iterator[LoopVector]]:
        """Return what leads from a joint to a point of the guide at an angle from an axis."""
        along = complex(*unit(angle))
        if axis:
            along *= _direction(*map(self.place, axis))

        def guided(start: str, point: str) -> Iterator[LoopVector]:
            begin, end = self.place(start), self.place(point)
            foot = begin + 1j * along * offset
            if offset:
                yield LoopVector("offset", (start, point), axis, begin, foot, _direction(begin, foot))
            yield LoopVector("slide", (start, point), axis, foot, end, along)

        return guided


def _direction(begin: complex, end: complex) -> complex:
    return (end - begin) / abs(end - begin) if end != begin else 1.0 + 0j
