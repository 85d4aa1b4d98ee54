"""The layer of each plate, so that no parts collide over the true period: as few layers as possible.

Layer 0 is the ground. Parts that meet at any phase may not share a layer: two plates; a plate and a pin,
which fills the layers from its lowest plate to its highest; two pins. Each such clash is a choice between two
alternatives, each a set of pairs (a, b) with a below b: for plates i and j, i below j or j below i; for plate
i and a pin through the plates S, i below all of S or above all of S. A consistent choice is found by
backtracking: pairs narrow the range of layers of each plate, an alternative that leaves a plate no layer is
dropped, and one that is left alone is taken. Where no order keeps all apart, a set of clashes is to blame
from which none can be left out without an order becoming possible.

Plates that are made to touch, such as two wheels, lie in one layer: they are one node.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from linkanim.frozen import NamedTuple
from linkanim.workshop.parts import Kit
from linkanim.workshop.sweep import Cycle, MovingPiece, Nearness

Below = tuple[int, int]
"""The first node lies in a lower layer than the second."""
Choice = tuple[tuple[Below, ...], ...]
"""Alternatives of which one must hold; all pairs of an alternative hold together."""

_MOST_WORK = 250_000
"""The most examinations of a choice before the search for one layer fewer is given up."""


class Clash(NamedTuple):
    """Two parts that would meet in one layer, by name, and the phase (rad) at which they would."""

    one: str
    other: str
    phase: float


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
    """The clashes to blame, and the fixed pins that a bridge would have to carry; none if no bridge helps."""

    clashes: tuple[Clash, ...]
    bridged: tuple[str, ...]


def stacked(cycle: Cycle, kit: Kit, *, hole: float, gap: float, bridge: bool) -> Stack | Unstackable:
    """Return the layers of all plates, as few as possible; where there are none, the reason.

    Pins are as wide as their `hole`, and parts of one layer pass at a distance of at least `gap` (mm). With a
    `bridge`, fixed pins may hang from it: as few as suffice.
    """
    near = _near(cycle, kit, hole, gap)
    clashes = [pair for pair, how in near.items() if not how.apart]
    fixed = [number for number, pin in enumerate(kit.pins) if pin.fixed and not pin.stuck]
    for hanging in (some for many in range(len(fixed) + 1) for some in combinations(fixed, many)):
        through = _nodes(kit, hanging)
        choices = [*_clashing(through, clashes), *_framing(len(kit.groups), bool(hanging))]
        order = _ordered(len(kit.groups) + bool(hanging), choices)
        if order is None:
            continue
        if hanging and not bridge:
            return Unstackable(_to_blame(kit, near, clashes), tuple(kit.pins[n].name for n in hanging))
        levels = _compact(order.layers, choices, through[len(kit.plates) :])
        layers = tuple(levels[through[plate][0]] for plate in range(len(kit.plates)))
        room = {pair: how.distance for pair, how in near.items() if how.apart and pair[1] >= len(kit.plates)}
        return Stack(layers, order.least, hanging, room)
    return Unstackable(_to_blame(kit, near, clashes), ())


def _near(cycle: Cycle, kit: Kit, hole: float, gap: float) -> dict[tuple[int, int], Nearness]:
    """Return how near plates and pins come, by pairs that may meet; pins are numbered after all plates."""
    plates, pins = range(1, len(kit.plates)), list(enumerate(kit.pins, start=len(kit.plates)))
    pairs = [(i, j) for i, j in combinations(plates, 2) if (i, j) not in kit.paired]
    pairs += [(i, number) for i in plates for number, pin in pins if i not in pin.plates]
    pairs += [(one, other) for (one, _), (other, _) in combinations(pins, 2)]
    asked = [(i, j, gap) for i, j in pairs]
    return dict(zip(pairs, cycle.nearness(pieces_of(kit, hole), asked), strict=True))


def pieces_of(kit: Kit, hole: float) -> list[MovingPiece]:
    """Return the shapes of all plates, and then of all pins, that may touch other parts."""
    plates = [plate.piece for plate in kit.plates]
    return plates + [MovingPiece(pin.frame, ((pin.at,),), hole / 2) for pin in kit.pins]


def _nodes(kit: Kit, hanging: Sequence[int]) -> list[list[int]]:
    """Return each plate's node, then the nodes that each pin goes through: 0 is the ground, a bridge last."""
    node = {plate: number for number, group in enumerate(kit.groups) for plate in group}
    nodes = [[node[plate]] for plate in range(len(kit.plates))]
    for number, pin in enumerate(kit.pins):
        through = {node[plate] for plate in pin.plates}
        nodes.append(sorted(through - {0} | {len(kit.groups)} if number in hanging else through))
    return nodes


def _clashing(through: Sequence[Sequence[int]], clashes: Sequence[tuple[int, int]]) -> Iterator[Choice]:
    """Yield each clash as a choice: all of the one below all of the other, or above."""
    for one, other in clashes:
        up = tuple((a, b) for a in through[one] for b in through[other])
        yield up, tuple((b, a) for a, b in up)


def _framing(top: int, bridge: bool) -> Iterator[Choice]:
    """Yield the conditions that all lies above the ground, and below a bridge."""
    for number in range(1, top):
        yield (((0, number),),)
    if bridge:
        yield from (((((number, top),),)) for number in range(top))


def _to_blame(
    kit: Kit, near: dict[tuple[int, int], Nearness], clashes: Sequence[tuple[int, int]]
) -> tuple[Clash, ...]:
    """Return clashes that cannot all be resolved, though without any one of them the others can."""
    frame, through, nodes = list(_framing(len(kit.groups), False)), _nodes(kit, ()), len(kit.groups)
    blamed = list(clashes)
    for pair in clashes:
        rest = [one for one in blamed if one != pair]
        if _solved(nodes, [*_clashing(through, rest), *frame], nodes) is None:
            blamed = rest

    def called(number: int) -> str:
        plates = len(kit.plates)
        return kit.plates[number].name if number < plates else f"the pin at {kit.pins[number - plates].name}"

    return tuple(Clash(called(one), called(other), near[one, other].phase) for one, other in blamed)


class _Order(NamedTuple):
    layers: tuple[int, ...]
    least: bool


class _GivenUp(Exception):
    pass


def _ordered(nodes: int, choices: Sequence[Choice]) -> _Order | None:
    """Return a layer for each node, from 0, in the least number of layers; None where there is no order.

    Where there is an order, as many layers as nodes suffice: nodes that share a layer can be put in two,
    since whatever passes through that layer passes both.
    """
    fewest = _clique(nodes, choices)
    # Mostly there is an order in few more layers than that, and ranges of few layers are soon narrowed.
    best = _tried(nodes, choices, min(2 * fewest, nodes)) or _solved(nodes, choices, nodes)
    if best is None:
        return None
    try:
        while max(best) + 1 > fewest and (fewer := _solved(nodes, choices, max(best), _MOST_WORK)):
            best = fewer
    except _GivenUp:
        return _Order(best, least=False)
    return _Order(best, least=True)


def _tried(nodes: int, choices: Sequence[Choice], layers: int) -> tuple[int, ...] | None:
    try:
        return _solved(nodes, choices, layers, _MOST_WORK)
    except _GivenUp:
        return None


def _clique(nodes: int, choices: Sequence[Choice]) -> int:
    """Return the most nodes of which no two can share a layer: a lower bound of the layers."""
    apart = [0] * nodes
    for choice in choices:
        pairs = [{frozenset(pair) for pair in one} for one in choice]
        for a, b in (
            tuple(pair) for pair in frozenset.intersection(*map(frozenset, pairs)) if len(pair) == 2
        ):
            apart[a] |= 1 << b
            apart[b] |= 1 << a

    def largest(left: int) -> int:
        if not left:
            return 0
        first = left.bit_length() - 1
        without = left & ~(1 << first)
        with_it = 1 + largest(left & apart[first])
        return with_it if with_it == left.bit_count() else max(with_it, largest(without))

    return largest((1 << nodes) - 1)


def _solved(
    nodes: int, choices: Sequence[Choice], layers: int, most_work: int | None = None
) -> tuple[int, ...] | None:
    """Return a layer for each node, with one alternative of each choice met; None where that is impossible.

    `_GivenUp` after more than `most_work` examinations of a choice.
    """
    work = 0

    def search(
        low: list[int], high: list[int], pairs: list[Below], left: Sequence[Choice]
    ) -> tuple[int, ...] | None:
        nonlocal work
        while True:
            if not _narrowed(low, high, pairs):
                return None
            undecided, forced = [], False
            for choice in left:
                possible = [one for one in choice if all(a != b and low[a] < high[b] for a, b in one)]
                if not possible:
                    return None
                if len(possible) == 1:
                    pairs, forced = [*pairs, *possible[0]], True
                elif not any(all(high[a] < low[b] for a, b in one) for one in possible):
                    undecided.append(tuple(possible))
            left = undecided
            if not forced:
                break
        if not left:
            return tuple(low)
        work += len(left)
        if most_work is not None and work > most_work:
            raise _GivenUp
        # The choice that leaves the least room comes first.
        first = min(left, key=lambda one: min(high[b] - low[a] for pairs in one for a, b in pairs))
        rest = [one for one in left if one is not first]
        tries = (search([*low], [*high], [*pairs, *one], rest) for one in first)
        return next((layers for layers in tries if layers is not None), None)

    return search([0] * nodes, [layers - 1] * nodes, [], choices)


def _narrowed(low: list[int], high: list[int], pairs: Sequence[Below]) -> bool:
    """Narrow the ranges `low` to `high` by the pairs; return whether each node still has a layer."""
    changed = True
    while changed:
        changed = False
        for below, above in pairs:
            if low[above] <= low[below]:
                low[above], changed = low[below] + 1, True
            if high[below] >= high[above]:
                high[below], changed = high[above] - 1, True
            if low[above] > high[above] or low[below] > high[below]:
                return False
    return True


def _compact(layers: Sequence[int], choices: Sequence[Choice], pins: Sequence[Sequence[int]]) -> list[int]:
    """Return the layers after moving single nodes as long as that makes pins shorter."""
    best = list(layers)

    def length(levels: Sequence[int]) -> int:
        return sum(max(levels[n] for n in pin) - min(levels[n] for n in pin) for pin in pins)

    def holds(levels: Sequence[int]) -> bool:
        return all(any(all(levels[a] < levels[b] for a, b in one) for one in choice) for choice in choices)

    better = True
    while better:
        better = False
        for node in range(1, len(best)):
            for level in range(1, max(best) + 1):
                moved = [*best[:node], level, *best[node + 1 :]]
                if max(moved) == max(best) and length(moved) < length(best) and holds(moved):
                    best, better = moved, True
    return best
