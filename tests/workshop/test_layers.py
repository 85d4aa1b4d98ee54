"""Orders of layers against trying them all: for random clashes, and for the catalogue's scenes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations, product
from typing import Any

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from solids import Solids

from linkanim.scenes import load, names
from linkanim.workshop import layers
from linkanim.workshop.layers import Choice, Unstackable, stacked
from linkanim.workshop.made import MadeLinkage, MadePin
from linkanim.workshop.parts import Kit, kit
from linkanim.workshop.request import make
from linkanim.workshop.sweep import Cycle

NODES = 5
SETS = st.sets(st.integers(0, NODES - 1), min_size=1, max_size=3)


def choice(one: set[int], other: set[int]) -> Choice:
    up = tuple((a, b) for a in sorted(one) for b in sorted(other))
    return up, tuple((b, a) for a, b in up)


def holds(levels: tuple[int, ...], choices: list[Choice]) -> bool:
    return all(any(all(levels[a] < levels[b] for a, b in one) for one in some) for some in choices)


def tried(choices: list[Choice]) -> int | None:
    """Return the least number of layers of all orders that keep the choices."""
    every = (levels for levels in product(range(NODES), repeat=NODES) if holds(levels, choices))
    return min((max(levels) + 1 for levels in every), default=None)


@settings(max_examples=40)
@given(clashes=st.lists(st.tuples(SETS, SETS), max_size=8))
def test_random_clashes_are_ordered_in_as_few_layers_as_can_be(
    clashes: list[tuple[set[int], set[int]]],
) -> None:
    choices = [choice(*clash) for clash in clashes]
    found = layers._ordered(NODES, choices)
    least = tried(choices)
    assert (found is None) == (least is None)
    if found is not None:
        assert holds(found.layers, choices)
        assert found.least
        assert max(found.layers) + 1 == least


def test_a_search_that_takes_too_long_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    # each apart from the next in a ring: three layers, though no three of them are apart from each other
    choices = [choice({n}, {(n + 1) % NODES}) for n in range(NODES)]
    sure = layers._ordered(NODES, choices)
    assert sure is not None
    assert (max(sure.layers), sure.least) == (2, True)
    monkeypatch.setattr(layers, "_MOST_WORK", 0)
    found = layers._ordered(NODES, choices)
    assert found is not None
    assert holds(found.layers, choices)
    assert not found.least


class Tried:
    """A scene's plates and pins in every order of layers, what meets being found by shapely at 720 phases."""

    def __init__(self, made: MadeLinkage, parts: Kit) -> None:
        pins = (MadePin(pin.name, pin.frame, pin.at, 0, 0, None, pin.plates) for pin in parts.pins)
        layer = (0,) * len(parts.plates)
        flat = replace(made, refused=None, plates=parts.plates, layer=layer, pins=tuple(pins))
        described: Any = flat.as_object()
        plates = [flat._part(number) for number in range(len(parts.plates))]
        solids = Solids(made.scene, described, 720)
        self.shapes = [solids.part({**plate, "holes": [], "slots": []}) for plate in plates]
        self.pins = [solids.round_(flat._pin(pin), made.sizes.hole) for pin in flat.pins]
        # polygons stand for arcs: what they are farther apart by
        self.parts, self.gap = parts, made.sizes.gap + 0.01
        home = {plate: group[0] for group in parts.groups for plate in group}
        self.moving = sorted({home[n] for n in range(len(plates))} - {0})
        self.home = home

    def clashes(self) -> Iterator[tuple[set[int], set[int]]]:
        """Yield what may not share a layer: a plate or a pin's plates, and another's."""
        plates = range(1, len(self.shapes))
        for i, j in combinations(plates, 2):
            if (i, j) not in self.parts.paired and self.near(self.shapes[i], self.shapes[j]):
                yield {self.home[i]}, {self.home[j]}
        reach = [{self.home[plate] for plate in pin.plates} for pin in self.parts.pins]
        for i, (number, pin) in product(plates, enumerate(self.parts.pins)):
            if i not in pin.plates and self.near(self.shapes[i], self.pins[number]):
                yield {self.home[i]}, reach[number]
        for one, other in combinations(range(len(self.pins)), 2):
            if self.near(self.pins[one], self.pins[other]):
                yield reach[one], reach[other]

    def near(self, one: Any, other: Any) -> bool:
        return bool(shapely.dwithin(one, other, self.gap).any())

    def least(self) -> int | None:
        """Return the least number of layers on the ground of all orders in which nothing meets."""
        clashes, count = list(self.clashes()), len(self.moving)
        for most in range(1, count + 1):
            for levels in product(range(1, most + 1), repeat=count):
                level = {0: 0, **dict(zip(self.moving, levels, strict=True))}
                if all(apart(level, *clash) for clash in clashes):
                    return most
        return None


def apart(level: dict[int, int], one: set[int], other: set[int]) -> bool:
    """Whether layers keep what goes through these plates apart: each from its lowest to its highest."""
    first, second = ([level[n] for n in some] for some in (one, other))
    return max(first) < min(second) or max(second) < min(first)


FEW = ("crank-rocker", "drag-link", "double-rocker", "crank-shaper", "whitworth", "six-bar")
OTHERS = tuple(name for name in names() if name not in FEW and name != "excavator")


@pytest.mark.slow
@pytest.mark.parametrize("name", [*FEW, *(pytest.param(name, marks=pytest.mark.long) for name in OTHERS)])
def test_no_order_of_up_to_six_bodies_has_fewer_layers(name: str) -> None:
    made = make(load(name))
    cycle = Cycle(made.scene, made.sizes.scale)
    parts = kit(cycle, made.sizes)
    found = stacked(cycle, parts, hole=made.sizes.hole, gap=made.sizes.gap, bridge=False)
    every = Tried(made, parts)
    if len(every.moving) > 6:
        assert not isinstance(found, Unstackable)
        return
    assert every.least() == (None if isinstance(found, Unstackable) else max(found.layers))


def test_the_clashes_to_blame_are_all_needed() -> None:
    made = make(load("stephenson-1"))
    assert made.refused is not None
    cycle = Cycle(made.scene, made.sizes.scale)
    parts = kit(cycle, made.sizes)
    found = stacked(cycle, parts, hole=made.sizes.hole, gap=made.sizes.gap, bridge=True)
    assert isinstance(found, Unstackable)
    assert len(found.clashes) == 4
    assert found.bridged == ()
    assert all(f"{clash.one} would meet {clash.other}" in made.refused for clash in found.clashes)
