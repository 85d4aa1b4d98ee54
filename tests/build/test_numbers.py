"""All numbers of a scene on the sheet that makes it: what each belongs to, and the draft that follows."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hand import gesture

from linkanim.build.building import Building, building_of, redo, undo
from linkanim.build.numbers import chosen_row, renumbered, rows_of_all, thing_at
from linkanim.build.scene_form import made
from linkanim.errors import LinkanimError
from linkanim.mechanics.groups import group_of
from linkanim.scenes import load, names
from linkanim.scenes.editing import Dimension, dimensions, other_closure, with_dimensions
from linkanim.scenes.scene import Scene

# Where links are solved together the sheet lists the numbers that are drawn.
CHAINS = [name for name in names() if group_of(load(name).linkage) is None]
TRIANGLE = (
    *("click 0 0", "click 100 0", "drag 0 0 30 0", "drag 30 0 60 80", "drag 60 80 100 0"),
    *("drag 30 0 30 60", "drag 30 60 60 80", "drag guide -40 -60 40 -60"),
)


def nudged(scene: Scene, item: Dimension) -> Scene | None:
    """Return the scene with a number a little larger; None where it cannot be so."""
    value = f"{item.value * 1.01 + (0.1 if item.value == 0 else 0):g} {item.unit}".rstrip()
    try:
        return with_dimensions(scene, {item.key: value})
    except LinkanimError:
        return None


@pytest.mark.sampled
@pytest.mark.parametrize("name", CHAINS)
def test_a_draft_follows_every_number_of_its_scene_and_undo_goes_back(name: str) -> None:
    building = building_of(load(name))
    scene = building.made.scene
    assert scene
    for item in dimensions(scene):
        after = nudged(scene, item)
        if after is None:
            continue
        found = renumbered(building, after)
        made_of = made(found.draft).scene
        assert made_of
        assert made_of.linkage == after.linkage, item.label
        assert undo(found).draft == building.draft
        assert redo(undo(found)).draft == found.draft


@pytest.mark.sampled
@pytest.mark.parametrize("name", CHAINS)
def test_a_draft_follows_the_other_closure(name: str) -> None:
    building = building_of(load(name))
    assert building.made.scene
    try:
        after = other_closure(building.made.scene)
    except LinkanimError:
        return
    found = made(renumbered(building, after).draft).scene
    assert found
    assert found.linkage == after.linkage


@pytest.mark.parametrize("name", CHAINS)
def test_a_number_belongs_to_what_is_drawn(name: str) -> None:
    building = building_of(load(name))
    scene = building.made.scene
    assert scene
    things = {*building.draft.things()}
    for item in dimensions(scene):
        thing = thing_at(building.draft, scene, item.key)
        unseen = item.key[0] == "loads" or item.key in {("gravity",), ("six-bar", "link_angle")}
        assert thing in things or unseen


def test_what_no_scene_tells_of_a_draft_stays() -> None:
    building = Building()
    for line in TRIANGLE:
        building = gesture(building, line)
    scene = building.made.scene
    assert scene
    item = next(one for one in dimensions(scene) if one.label.startswith("Crank"))
    found = renumbered(building, with_dimensions(scene, {item.key: 25}))
    assert found.made.scene
    assert found.draft.of("guides") == building.draft.of("guides")
    assert found.draft.of("bars").keys() == building.draft.of("bars").keys()
    assert found.draft.of("bars")["O2–A"]["length"] == 25


def test_while_a_hand_goes_on_undo_has_one_step() -> None:
    building = building_of(load("crank-rocker"))
    scene = building.made.scene
    assert scene
    key = ("four-bar", "coupler")
    for n, length in enumerate((86, 87, 88)):
        building = renumbered(building, with_dimensions(scene, {key: length}), grows=n == 0)
    assert len(building.past) == 1
    assert undo(building).draft.of("bars")["A–B"]["length"] == 85


def test_all_numbers_of_a_drawing_are_listed_each_but_once() -> None:
    building = Building()
    for line in ("click 0 0", "drag 0 0 30 0", "drag 30 0 60 80"):
        building = gesture(building, line)
    assert building.made.scene is None
    rows = rows_of_all(building.draft)
    keys = [row.key for *_, row in rows]
    assert len(keys) == len(set(keys))
    assert {("pins", "O2", 0), ("bars", "O2–A", "length"), ("bars", "A–B", "length")} <= {*keys}
    at = chosen_row(building)
    assert at is not None
    assert rows[at][2].key == ("bars", "A–B", "length")
    assert chosen_row(replace(building, chosen=None)) is None
