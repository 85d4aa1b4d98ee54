"""Points of a body, beside its pins: coupler points, third pins of a plate."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from linkanim.mechanics.frames import coincide, holding, share_of
from linkanim.mechanics.joint import Frame, Joint, Need, Point

if TYPE_CHECKING:
    from linkanim.mechanics.walk import Walk


@dataclass(frozen=True, slots=True)
class Rigid(Joint):
    """A point of a body: `at` = (along `on[0]` -> `on[1]`, to the left of it) from `on[0]`."""

    on: tuple[str, str]
    at: Point

    @property
    def needs(self) -> tuple[Need, ...]:
        """The two joints that its body is known by."""
        return Need("on", self.on[0]), Need("on", self.on[1])

    @property
    def body(self) -> tuple[str, ...]:
        """The two joints that its body is known by."""
        return self.on

    @property
    def spans(self) -> tuple[tuple[str, ...], ...]:
        """The plate of the three joints."""
        return ((*self.on, self.name),)

    @property
    def lengths(self) -> tuple[float, ...]:
        """Its place on the body."""
        return self.at

    def scaled(self, factor: float) -> Rigid:
        """Return the point with its place times a factor."""
        return replace(self, at=(self.at[0] * factor, self.at[1] * factor))

    def close(self, walk: Walk) -> None:
        """Carry the point with its body."""
        walk.points[self.name] = walk.attached(self.on, self.at, self.name)

    def placed(self, frames: tuple[Frame, ...]) -> tuple[Frame, ...]:
        """Return the frames with the point on its body; as they are where the two joints show none."""
        n = holding(frames, self.on)
        if n is None or coincide(frames[n], *self.on):
            return frames
        start, end = (frames[n][name] for name in self.on)
        place = start + (end - start) * share_of(frames[n], self.on, self.at)
        return (*frames[:n], {**frames[n], self.name: place}, *frames[n + 1 :])
