"""Where the values of a block live while its passes run: in result rows, and in buffers beside them.

A pass costs what it fetches and stores. So what is in use at once has to stay in the cache, and a result is
written over one of its arguments wherever one ends there.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

Operation = tuple[int, str, tuple[int | str, ...]]
"""A node as its index, what it does, and with what: other nodes' indices, names of inputs and of numbers.

Linkages of other lengths mostly have the same ones, and with them the same program.
"""


@dataclass(frozen=True)
class Allocation:
    """The variable that holds each node's values, what is left to be copied into rows, how many buffers."""

    held: Mapping[int | str, str]
    copies: tuple[tuple[int, int | str], ...]
    buffers: int


def allocated(operations: Sequence[Operation], outputs: Sequence[int | str]) -> Allocation:
    """Return where the values of nodes live, which stand in the order in which they are worked out.

    Outputs live in their own rows, `o0` on; the others in rows that are not filled yet and in buffers, `b0`
    on. An output that is no node, or one of an earlier row, is to be copied.
    """
    nodes = [index for index, *_ in operations]
    held, copies = _rows(set(nodes), outputs)
    last = {value: at for at, (*_, arguments) in enumerate(operations) for value in arguments}
    inner = [node for node in nodes if node not in held]
    heirs = _heirs(nodes, held, last)
    ending: dict[int, list[int]] = {}
    for node in inner:
        ending.setdefault(last[node], []).append(node)
    free = _Free({held[node]: at for at, node in enumerate(nodes) if node in held})
    for at, node in enumerate(nodes):
        free.places += [held[index] for index in ending.get(at, ())]
        if node in heirs:
            held[node] = free.take(at, last[node], heirs[node])
    return Allocation(held, tuple(copies), free.buffers)


def _rows(
    computed: set[int], outputs: Sequence[int | str]
) -> tuple[dict[int | str, str], list[tuple[int, int | str]]]:
    """Return the row of each node that is an output, and the outputs that have to be copied into theirs."""
    held: dict[int | str, str] = {}
    copies: list[tuple[int, int | str]] = []
    for row, value in enumerate(outputs):
        if value in computed and value not in held:
            held[value] = f"o{row}"
        else:
            copies.append((row, value))
    return held, copies


def _heirs(
    nodes: Sequence[int], held: Mapping[int | str, str], last: Mapping[int | str, int]
) -> dict[int, tuple[int, str]]:
    """Return of each inner value until when its place can be handed on, and the row in which that ends."""
    heirs: dict[int, tuple[int, str]] = {}
    for node in reversed(nodes):
        if node not in held:
            user = nodes[last[node]]
            heirs[node] = heirs.get(user) or (last[node], held[user])
    return heirs


@dataclass
class _Free:
    """The places that are free; `filled` says at which pass each row gets its own values."""

    filled: Mapping[str, int]
    rows: list[tuple[int, str]] = field(init=False)
    """Those never used, with when they are filled: the first one to be filled first."""
    places: list[str] = field(default_factory=list)
    """Those given back, the last one last."""
    buffers: int = 0

    def __post_init__(self) -> None:
        self.rows = sorted((at, row) for row, at in self.filled.items())

    def take(self, at: int, last: int, heir: tuple[int, str]) -> str:
        """Take the row to which a value is handed down, one free that long, or one free while used."""
        until, row = heir
        return self._row(row) or self._until(at, until) or self._until(at, last) or self._new()

    def _row(self, row: str) -> str | None:
        """Take that row, if it is free."""
        at = bisect_left(self.rows, (self.filled[row], row))
        if at < len(self.rows) and self.rows[at][1] == row:
            return self.rows.pop(at)[1]
        if row not in self.places:
            return None
        self.places.remove(row)
        return row

    def _until(self, at: int, until: int) -> str | None:
        """Take the place freed last of those that stay free from one pass to another, if there is any."""
        for n in range(len(self.places) - 1, -1, -1):
            end = self.filled.get(self.places[n], until)
            if end >= until:
                return self.places.pop(n)
            if end < at:
                del self.places[n]
        first = bisect_left(self.rows, (until, ""))
        return self.rows.pop(first)[1] if first < len(self.rows) else None

    def _new(self) -> str:
        self.buffers += 1
        return f"b{self.buffers - 1}"
