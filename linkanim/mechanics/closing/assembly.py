"""A linkage put together, as data: its loops, the input's path, and the sign of each closure on it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from linkanim.mechanics.closing.chain import ChainRoot
from linkanim.mechanics.drive.input_path import InputPath
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.loops.loop import Gearing, Loop, gearings


@dataclass(frozen=True)
class Assembly:
    """A linkage's loops, the path of its input and the sign of every closure.

    `linkage` has its lengths scaled by a power of two where products of four of them could leave
    the range of a float; `unscale` brings results back.
    """

    linkage: Linkage
    loops: Mapping[str, Loop]
    path: InputPath
    signs: Mapping[str, int]
    unscale: float = 1.0
    chain: Mapping[str, ChainRoot] = field(default_factory=dict)
    """The roots of dyads on moving points that vanish on the way."""

    @property
    def change_points(self) -> Iterator[float]:
        """The input's places at which a root changes its sign, of loops and of dyads down the chain."""
        roots: tuple[Loop | ChainRoot, ...] = (*self.loops.values(), *self.chain.values())
        for root in roots:
            yield from root.change_points(self.path)

    @cached_property
    def gears(self) -> Mapping[str, Gearing]:
        """How each crank turns with the input."""
        return gearings(self.linkage)
