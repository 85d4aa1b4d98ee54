"""The layer of each plate, so that no parts collide over the true period: as few layers as possible.

Layer 0 is the ground. Parts that meet at any phase may not share a layer: two plates; a plate and a pin,
which fills the layers from its lowest plate to its highest; two pins. Of each such clash all plates of one
lie below all plates of the other, or above. Of each plate all is kept that is known to lie below it and above
it, with all that follows: where that rules out one way of a clash the other way is taken; where both are left
one is tried, and the other if nothing comes of it. Where no order keeps all apart, a set of clashes is to
blame from which none can be left out without an order becoming possible.

A search is bounded by its work, so that it ends alike on every machine, whether it has found an order or not.
Plates that are made to touch, such as two wheels, lie in one layer: they are one node.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

from linkanim.workshop.parts import Kit
from linkanim.workshop.sweep import Cycle


class NodeSet(NamedTuple):
    """Nodes that a part goes through, and the same as bits."""

    nodes: tuple[int, ...]
    bits: int

    @classmethod
    def of(cls, nodes: Iterable[int]) -> NodeSet:
        """Return nodes as a set."""
        own = tuple(sorted(nodes))
        return cls(own, sum(1 << node for node in own))


Choice = tuple[NodeSet, NodeSet]
"""All nodes of the one lie below all of the other, or all above."""

MOST_WORK = 6_000_000
"""The most nodes of choices that are looked at to find layers, or to say why there are none."""
_MOST_FEWER = 500_000
"""Those that are looked at for fewer layers."""


class Budget:
    """The work that a search may still do; `told` hears from time to time how much of it is done."""

    def __init__(self, most: int, told: Callable[[int, int], None] | None = None) -> None:
        """Begin with none of the `most` done."""
        self.done, self.most, self._clash, self._next = 0, most, told, 0

    def spend(self, work: int) -> None:
        """Do some more; GivenUp where it is too much."""
        self.done += work
        if self.done > self.most:
            raise GivenUp
        if self._clash and self.done >= self._next:
            self._next = self.done + self.most // 200
            self._clash(self.done, self.most)


class GivenUp(Exception):
    """A search took more work than it may."""


class Stack(NamedTuple):
    """The layer of each plate, and the pins, by number, that hang from a bridge above all layers.

    `least` is whether fewer layers are known to be impossible. `room` is the least distance in mm, from edge
    to edge, between a pin and a plate or pin that it does not touch: by (plate or pin, pin), pins numbered
    after all plates.
    """

    layers: tuple[int, ...]
    least: bool
    hanging: tuple[int, ...]
    room: dict[tuple[int, int], float]


class Unstackable(NamedTuple):
    """The clashes to blame, and the fixed pins that a bridge would have to carry; none if no bridge helps.

    A clash is two parts that would meet in one layer, by name, and the phase (rad) at which they would.
    Without clashes the search was given up.
    """

    clashes: tuple[tuple[str, str, float], ...]
    bridged: tuple[str, ...]


def stacked(
    cycle: Cycle, kit: Kit, work: Budget, *, hole: float, gap: float, bridge: bool
) -> Stack | Unstackable:
    """Return the layers of all plates, as few as possible; where there are none, the reason.

    Pins are as wide as their `hole`, and parts of one layer pass at a distance of at least `gap` (mm). With a
    `bridge`, fixed pins may hang from it: as few as suffice.
    """
    near = kit.near(cycle, hole, gap)
    clashes = [pair for pair, how in near.items() if not how.apart]
    try:
        work.spend(len(near))
        hanging, choices, levels = _orders(kit, clashes, work)
    except GivenUp:
        return Unstackable((), ())
    if levels is None or (hanging and not bridge):
        blamed = tuple(_to_blame(kit, clashes, work))
        told = tuple((kit.name(one), kit.name(other), near[one, other].phase) for one, other in blamed)
        return Unstackable(told, tuple(kit.pins[n].name for n in hanging))
    through = kit.nodes(hanging)
    levels, least = _fewest(levels, choices, bridged=bool(hanging))
    levels = _compact(levels, choices, through[len(kit.plates) :], bridged=bool(hanging))
    layers = tuple(levels[through[plate][0]] for plate in range(len(kit.plates)))
    room = {pair: how.distance for pair, how in near.items() if how.apart and pair[1] >= len(kit.plates)}
    return Stack(layers, least, hanging, room)


def can_be_stacked(cycle: Cycle, kit: Kit, work: Budget, *, hole: float, gap: float) -> bool:
    """Return whether an order of layers is found; no pin hangs from a bridge."""
    near = kit.near(cycle, hole, gap)
    clashes = [pair for pair, how in near.items() if not how.apart]
    try:
        work.spend(len(near))
        return _ordered(len(kit.groups), _clashing(kit.nodes(()), clashes), work) is not None
    except GivenUp:
        return False


def _orders(
    kit: Kit, clashes: Sequence[tuple[int, int]], work: Budget
) -> tuple[tuple[int, ...], list[Choice], list[int] | None]:
    """Return the fewest pins that have to hang, the clashes as choices then, and the level of each node.

    There are no levels where no order keeps all apart, whichever pins hang.
    """
    first = len(kit.plates)
    fixed = [number for number, pin in enumerate(kit.pins) if pin.fixed and not pin.stuck]
    for hanging in (some for many in range(len(fixed) + 1) for some in combinations(fixed, many)):
        choices = _clashing(kit.nodes(hanging), clashes)
        levels = _ordered(len(kit.groups) + bool(hanging), choices, work, bridged=bool(hanging))
        if levels is not None:
            return hanging, choices, levels
        if not hanging:
            others = [pair for pair in clashes if not {number - first for number in pair} & {*fixed}]
            if _ordered(len(kit.groups), _clashing(kit.nodes(()), others), work) is None:
                break
    return (), [], None


def _clashing(through: Sequence[Sequence[int]], clashes: Sequence[tuple[int, int]]) -> list[Choice]:
    """Return each clash as a choice."""
    sets = [NodeSet.of(nodes) for nodes in through]
    return [(sets[one], sets[other]) for one, other in clashes]


def _to_blame(kit: Kit, clashes: Sequence[tuple[int, int]], work: Budget) -> list[tuple[int, int]]:
    """Return clashes that cannot all be resolved, though without any one of them the others can.

    Where the work for that is too much there may be some more of them.
    """
    nodes, through = len(kit.groups), kit.nodes(())
    blamed, many = list(clashes), len(clashes)
    try:
        while many > 1:
            many, first = (many + 1) // 2, 0
            while first < len(blamed):
                rest = blamed[:first] + blamed[first + many :]
                if _ordered(nodes, _clashing(through, rest), work) is None:
                    blamed = rest
                else:
                    first += many
    except GivenUp:
        pass
    return blamed


def _fewest(levels: list[int], choices: Sequence[Choice], *, bridged: bool) -> tuple[list[int], bool]:
    """Return the levels of the fewest layers that are found, and whether fewer are impossible."""
    fewest, work = _clique(len(levels), choices, bridged=bridged), Budget(_MOST_FEWER)
    try:
        while max(levels) + 1 > fewest:
            fewer = _ordered(len(levels), choices, work, max(levels), bridged=bridged)
            if fewer is None:
                break
            levels = fewer
    except GivenUp:
        return levels, False
    return levels, True


def _clique(nodes: int, choices: Sequence[Choice], *, bridged: bool) -> int:
    """Return how many nodes are found of which no two can share a layer: a lower bound of the layers."""
    apart = [0] * nodes
    ends = [({0}, range(1, nodes))] + [({nodes - 1}, range(nodes - 1))] * bridged
    pairs = [(one.nodes, other.nodes) for one, other in choices]
    for one, other in [*ends, *pairs]:
        for a in one:
            for b in other:
                apart[a] |= 1 << b
                apart[b] |= 1 << a
    largest = 0
    for first in range(nodes):
        size, candidates = 1, apart[first]
        while candidates:
            best = max(_bits(candidates), key=lambda node: (candidates & apart[node]).bit_count())
            size, candidates = size + 1, candidates & apart[best]
        largest = max(largest, size)
    return largest


class _Below:
    """What is known to lie below what: for each node the nodes above it and those below it, as bits."""

    def __init__(self, up: list[int], down: list[int]) -> None:
        self.up, self.down = up, down

    @classmethod
    def framed(cls, nodes: int, *, bridged: bool) -> _Below:
        """Return that all lie above the ground, and below a bridge, which is the last node."""
        known = cls([0] * nodes, [0] * nodes)
        known.put(NodeSet.of([0]), NodeSet.of(range(1, nodes)))
        if bridged:
            known.put(NodeSet.of(range(nodes - 1)), NodeSet.of([nodes - 1]))
        return known

    def copy(self) -> _Below:
        return _Below([*self.up], [*self.down])

    def put(self, one: NodeSet, other: NodeSet) -> int:
        """Put all of the one below all of the other, and so what lies below it below what lies above.

        Return the nodes of which more is known now, as bits.
        """
        if all(self.up[node] & other.bits == other.bits for node in one.nodes):
            return 0
        lower, upper = one.bits, other.bits
        for node in one.nodes:
            lower |= self.down[node]
        for node in other.nodes:
            upper |= self.up[node]
        for node in _bits(lower):
            self.up[node] |= upper
        for node in _bits(upper):
            self.down[node] |= lower
        return lower | upper

    def levels(self) -> list[int]:
        """Return how many nodes lie below each one above the other, at the most."""
        return _longest(self.down)

    def heights(self) -> list[int]:
        """Return how many nodes lie above each one above the other, at the most."""
        return _longest(self.up)


def _bits(bits: int) -> Iterator[int]:
    while bits:
        last = bits & -bits
        yield last.bit_length() - 1
        bits ^= last


def _longest(beyond: Sequence[int]) -> list[int]:
    """Return for each node the longest chain of nodes beyond it."""
    length, remaining, level = [0] * len(beyond), (1 << len(beyond)) - 1, 0
    while remaining:
        free = [node for node in _bits(remaining) if not beyond[node] & remaining]
        for node in free:
            length[node] = level
            remaining ^= 1 << node
        level += 1
    return length


def _ordered(
    nodes: int, choices: Sequence[Choice], work: Budget, most: int | None = None, *, bridged: bool = False
) -> list[int] | None:
    """Return a level for each node, from 0, with each choice met; None where that is impossible.

    There are at most `most` layers; without that as many as nodes, and nodes that share one can always be put
    in two. GivenUp where it takes too much work.
    """
    layers = most or nodes
    tries = [(_Below.framed(nodes, bridged=bridged), list(choices), (1 << nodes) - 1)]
    while tries:
        known, undecided, changed = tries.pop()
        order = _with_only_ways(known, undecided, layers, work, changed)
        if order is None:
            continue
        if not order:
            return known.levels()
        first = _hardest(known, order) if layers < nodes else 0
        one, other = order[first]
        rest = order[:first] + order[first + 1 :]
        for low, up in ((other, one), (one, other)):
            tried = known.copy()
            tries.append((tried, rest, tried.put(low, up)))
    return None


def _with_only_ways(
    known: _Below, choices: list[Choice], layers: int, work: Budget, changed: int
) -> list[Choice] | None:
    """Add to what is known each way that is the only one of a choice; None where a choice has none left.

    Return the choices with two ways. What is known has `changed` for these nodes, as bits.
    """
    few = layers < len(known.up)
    while changed:
        levels, heights = (known.levels(), known.heights()) if few else ([], [])
        if few and max(levels) >= layers:
            return None
        work.spend(len(choices))
        undecided, now = [], 0
        for choice in choices:
            one, other = choice
            if not (one.bits | other.bits) & changed:
                undecided.append(choice)
                continue
            work.spend(len(one.nodes) + len(other.nodes))
            ways = [
                (low, up)
                for low, up in ((one, other), (other, one))
                if not any(known.down[node] & up.bits for node in low.nodes)
                and not (few and _chain(levels, heights, low, up) > layers)
            ]
            if one.bits & other.bits or not ways:
                return None
            if len(ways) == 2:
                undecided.append(choice)
            else:
                now |= known.put(*ways[0])
        choices, changed = undecided, now
    return choices


def _chain(levels: Sequence[int], heights: Sequence[int], low: NodeSet, up: NodeSet) -> int:
    """Return how many nodes would lie one above the other, at the least, with one set below another."""
    return max(levels[node] for node in low.nodes) + max(heights[node] for node in up.nodes) + 2


def _hardest(known: _Below, choices: Sequence[Choice]) -> int:
    """Return the number of the choice of which one way leaves the least room."""
    levels, heights = known.levels(), known.heights()
    chains = [
        max(_chain(levels, heights, one, other), _chain(levels, heights, other, one))
        for one, other in choices
    ]
    return chains.index(max(chains))


def _compact(
    levels: Sequence[int], choices: Sequence[Choice], pins: Sequence[Sequence[int]], *, bridged: bool
) -> list[int]:
    """Return the levels after moving single nodes as long as that makes pins shorter."""
    best = list(levels)
    of = [
        [choice for choice in choices if (choice[0].bits | choice[1].bits) >> n & 1] for n in range(len(best))
    ]
    through = [[pin for pin in pins if n in pin] for n in range(len(best))]

    def length(node: int) -> int:
        """Return the length of all pins through a node."""
        return sum(max(best[n] for n in pin) - min(best[n] for n in pin) for pin in through[node])

    def holds(node: int) -> bool:
        spans = ([[best[n] for n in part.nodes] for part in choice] for choice in of[node])
        return all(max(one) < min(other) or max(other) < min(one) for one, other in spans)

    better = True
    while better:
        better = False
        for node in range(1, len(best) - bridged):
            for level in range(1, max(best) + 1 - bridged):
                before, most, was = best[node], max(best), length(node)
                best[node] = level
                if max(best) == most and length(node) < was and holds(node):
                    better = True
                else:
                    best[node] = before
    return best
