"""Scenes as drafts: taken apart into bars, guides and points, they come to equal scenes again."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hand import drawn

import linkanim
from linkanim.build.building import building_of
from linkanim.errors import BadInput
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import text

# what a sheet does not draw, and what it says
UNDRAWN = {
    "oldham": "oldham: M slides on two lines, which a sheet does not draw",
    "knee-cylinder": "is driven by a length between moving links, which a sheet does not draw",
}


@pytest.mark.sampled
@pytest.mark.parametrize("name", [name for name in linkanim.names() if name not in UNDRAWN])
def test_a_scene_s_draft_comes_to_an_equal_scene(name: str) -> None:
    scene, draft = linkanim.load(name), building_of(linkanim.load(name))
    assert draft.made.missing == ""
    assert _named(draft.made.scene, name) == scene


@pytest.mark.parametrize("name", UNDRAWN)
def test_a_scene_that_no_sheet_draws_says_so(name: str) -> None:
    with pytest.raises(BadInput, match=UNDRAWN[name]):
        building_of(linkanim.load(name))


def _named(scene: Scene | None, name: str) -> Scene | None:
    return scene and replace(scene, name=name)


@pytest.mark.parametrize("name", ["crank-rocker", "rocker-driven", "engine", "six-bar"])
def test_a_shorthand_stays_one(name: str) -> None:
    scene = building_of(linkanim.load(name)).made.scene
    assert scene
    assert text(scene).count("[joints") == 0


def test_a_shorthand_stays_one_whose_bar_is_drawn_anew_from_its_other_end() -> None:
    building = building_of(linkanim.load("crank-rocker"))
    (x, y), (to_x, to_y) = building.draft.places["B"], building.draft.places["A"]
    scene = drawn(["choose bars A–B", "delete", f"drag {x} {y} {to_x} {to_y}"], building).made.scene
    assert scene
    assert "[four-bar]" in text(scene)
    assert 'assembly = "open"' in text(scene)


def test_a_shorthand_stays_one_whose_ground_is_turned_away_from_the_origin() -> None:
    building = building_of(linkanim.load("crank-rocker"))
    moves = ("choose joints O2", "move 10 20", "choose joints O4", "move 70 80")
    scene = drawn([*moves], building).made.scene
    assert scene
    assert scene.document["ground"] == {"O2": [10, 20]}
    assert scene.document["four-bar"]["ground"] == pytest.approx(60 * 2**0.5)
    assert scene.document["four-bar"]["ground_angle"] == "45 deg"
