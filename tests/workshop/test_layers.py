"""Orders of layers against trying them all: for random clashes, and for the catalogue's scenes."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations, product
from typing import Any

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from solids import Solids

from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.workshop import layers
from linkanim.workshop.layers import Budget, Choice, NodeSet, Unstackable, stacked
from linkanim.workshop.made import MadeLinkage
from linkanim.workshop.parts import Kit, kit
from linkanim.workshop.request import make
from linkanim.workshop.sweep import Cycle

NODES = 6
"""The ground, which is node 0 and lies below all others, and five more."""
SETS = st.sets(st.integers(0, NODES - 1), min_size=1, max_size=3)


def choice(one: set[int], other: set[int]) -> Choice:
    return NodeSet.of(one), NodeSet.of(other)


def holds(levels: Sequence[int], choices: list[Choice]) -> bool:
    level = dict(enumerate(levels))
    return all(apart(level, {*one.nodes}, {*other.nodes}) for one, other in choices)


def tried(choices: list[Choice]) -> int | None:
    """Return the least number of layers of all orders that keep the choices."""
    every = ((0, *levels) for levels in product(range(1, NODES), repeat=NODES - 1))
    return min((max(levels) + 1 for levels in every if holds(levels, choices)), default=None)


@settings(max_examples=40)
@given(clashes=st.lists(st.tuples(SETS, SETS), max_size=8))
@pytest.mark.slow
def test_random_clashes_are_ordered_in_as_few_layers_as_can_be(
    clashes: list[tuple[set[int], set[int]]],
) -> None:
    choices = [choice(*clash) for clash in clashes]
    found = layers._ordered(NODES, choices, Budget(10_000))
    least = tried(choices)
    assert (found is None) == (least is None)
    if found is not None:
        assert holds(found, choices)
        fewest, sure = layers._fewest(found, choices, bridged=False)
        assert holds(fewest, choices)
        assert sure
        assert max(fewest) + 1 == least


def test_a_search_that_takes_too_long_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    # each apart from the next in a ring: three layers, though no three of them are apart from each other
    choices = [choice({n + 1}, {n % 5 + 2 if n < 4 else 1}) for n in range(5)]
    first = layers._ordered(NODES, choices, Budget(1_000))
    assert first is not None
    levels, sure = layers._fewest(first, choices, bridged=False)
    assert (max(levels), sure) == (3, True)
    monkeypatch.setattr(layers, "_MOST_FEWER", 0)
    found, sure = layers._fewest([0, 1, 2, 3, 4, 5], choices, bridged=False)
    assert holds(found, choices)
    assert not sure


def rockers(count: int) -> Scene:
    """Return a crank with this many rockers all round it, their couplers on one pin."""
    places = {f"G{n}": cmath.rect(100.0, n * math.tau / count) for n in range(count)}
    return scene_from(
        {
            "length_unit": "mm",
            "ground": {"O2": [0, 0], **{name: [at.real, at.imag] for name, at in places.items()}},
            "joints": {
                "A": {"crank": "O2", "length": 20},
                **{f"B{n}": {"from": ["A", f"G{n}"], "length": [90, 60]} for n in range(count)},
            },
        },
        name="rockers",
        where="rockers",
    )


def sliders(count: int) -> Scene:
    """Return a crank with this many sliders in all directions, their rods on one pin."""
    guides = ({"through": "O2", "angle": f"{5.7 * n!r} deg"} for n in range(count))
    slid = {f"S{n}": {"from": "A", "length": 100 + n, "line": line} for n, line in enumerate(guides)}
    joints = {"A": {"crank": "O2", "length": 30}, **slid}
    document = {"length_unit": "mm", "ground": {"O2": [0, 0]}, "joints": joints}
    return scene_from(document, name="sliders", where="sliders")


# So many choices of what lies above what that they are no longer a depth for a recursion; of rockers each has
# its pivot in the way of the next one's bars, and thinner bars or a bridge help.
@pytest.mark.parametrize(
    ("scene", "layered", "said"),
    [
        pytest.param(sliders(23), 24, "", id="23 sliders", marks=pytest.mark.slow),
        pytest.param(rockers(9), 10, "", id="9 rockers"),
        pytest.param(rockers(10), 0, "narrower bars can, such as --bar 1.4", id="10 rockers"),
        pytest.param(
            rockers(12),
            0,
            "a bridge over it can carry G0 from above",
            id="12 rockers",
            marks=pytest.mark.slow,
        ),
        pytest.param(
            rockers(45),
            0,
            "in none of the many orders that were tried",
            id="45 rockers",
            marks=pytest.mark.slow,
        ),
        pytest.param(
            sliders(31),
            0,
            "whichever of the two lies higher; narrower bars can",
            id="31 sliders",
            marks=pytest.mark.long,
        ),
    ],
)
def test_many_parts_on_one_pin_are_laid_or_refused(scene: Scene, layered: int, said: str) -> None:
    seen: list[tuple[int, int]] = []
    made = make(scene, fit="A4", progress=lambda done, most: seen.append((done, most)))
    assert made.layers == layered
    assert bool(made.refused) == bool(said)
    if made.refused:
        assert made.refused.startswith(f"{scene.name} cannot be made flat: ")
        assert said in made.refused
        assert len(made.refused) < 1_000
    assert seen
    assert all(done <= most == layers.MOST_WORK for done, most in seen)
    assert seen == sorted(seen)


def test_a_search_that_is_given_up_is_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("linkanim.workshop.request.MOST_WORK", 5)
    made = make(load("press"))
    assert made.refused is not None
    assert made.refused.startswith("press cannot be made flat: in none of the many orders that were tried ")


def test_a_bridge_lies_above_all_that_moves() -> None:
    for name in ("quick-return-press", "kite", "elliptic-trammel"):
        made = make(load(name), bridge=True)
        assert [plate.name for plate in made.plates][-1] == "bridge"
        assert max(made.layer[:-1]) == made.layer[-1] - 1
        assert sorted({*made.layer}) == [*range(max(made.layer) + 1)]


class Tried:
    """A scene's plates and pins in every order of layers, what meets being found by shapely at 720 phases."""

    def __init__(self, made: MadeLinkage, parts: Kit) -> None:
        layer = (0,) * len(parts.plates)
        flat = replace(made, refused=None, plates=parts.plates, layer=layer, pins=parts.pins)
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
NOT_FLAT = ("excavator", "knee-cylinder", "oldham")
OTHERS = tuple(name for name in names() if name not in FEW and name not in NOT_FLAT)


@pytest.mark.slow
@pytest.mark.parametrize("name", [*FEW, *(pytest.param(name, marks=pytest.mark.long) for name in OTHERS)])
def test_no_order_of_up_to_seven_bodies_has_fewer_layers(name: str) -> None:
    made = make(load(name))
    cycle = Cycle(made.scene, made.sizes.scale)
    parts = kit(cycle, made.sizes)
    found = stacked(
        cycle, parts, Budget(layers.MOST_WORK), hole=made.sizes.hole, gap=made.sizes.gap, bridge=False
    )
    every = Tried(made, parts)
    if len(every.moving) > 7:
        assert not isinstance(found, Unstackable)
        return
    assert every.least() == (None if isinstance(found, Unstackable) else max(found.layers))


def test_the_clashes_to_blame_are_all_needed() -> None:
    made = make(load("stephenson-1"))
    assert made.refused is not None
    cycle = Cycle(made.scene, made.sizes.scale)
    parts = kit(cycle, made.sizes)
    found = stacked(
        cycle, parts, Budget(layers.MOST_WORK), hole=made.sizes.hole, gap=made.sizes.gap, bridge=True
    )
    assert isinstance(found, Unstackable)
    assert len(found.clashes) == 4
    assert found.bridged == ()
    assert all(f"{one} would meet {other}" in made.refused for one, other, _ in found.clashes)
