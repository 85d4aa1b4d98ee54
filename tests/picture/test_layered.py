"""Numbers on parts in layers: on what is seen of a part, and off other words."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from linkanim.export import json_text
from linkanim.picture.items import Caption
from linkanim.picture.layered import LayerView, lifted
from linkanim.picture.raster import Layer
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.making import Layering
from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.workshop.request import make

TEXT = 14


@pytest.mark.slow
@pytest.mark.parametrize("name", ["crank-rocker", "press", "jansen", "six-bar", "crank-shaper"])
def test_numbers_stand_on_what_is_seen_of_their_parts_and_off_other_words(name: str) -> None:
    scene = load(name)
    state = advance(begin(scene), [Action("layers")])
    state = advance(state, [Action("layered", json_text(make(scene, fit="A4").as_object()))])
    shown = state.of(Layering)
    parts = shown and shown.parts
    assert parts
    view = LayerView.fitting(parts.reach, parts.layers, 0.0, Rect(20, 20, 900, 500))
    numbered = {plate.number for plate in parts.plates if plate.layer}
    for phase in np.linspace(0.0, scene.period, 12, endpoint=False):
        items = [*lifted(parts, scene.pose(float(phase)), scene.length_unit, view, LIGHT, TEXT)]
        words = [one for one in items if isinstance(one, Caption)]
        numbers = [one for one in words if one.strong]
        assert {one.text for one in numbers} <= numbered
        assert len(numbers) >= len(numbered) - 1, phase
        middles = [complex(one.at[0], one.at[1]) + 0.5j * TEXT for one in numbers]
        assert all(abs(one - other) > TEXT for one, other in combinations(middles, 2)), phase
        names = [complex(one.at[0], one.at[1]) + (0.6 + 0.5j) * TEXT for one in words if not one.strong]
        assert all(abs(one - other) > TEXT for one in middles for other in names), phase
        assert any(isinstance(one, Layer) for one in items)
