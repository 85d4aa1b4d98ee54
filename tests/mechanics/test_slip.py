"""What slides on a moving link: its slip, the two rates of that, and its Coriolis acceleration."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import linkanim
from linkanim.scenes.reading import scene_from

LEVER: dict[str, Any] = {
    "length_unit": "mm",
    "drive": {"joint": "C", "speed": "3 rad/s"},
    "ground": {"A": [0, 0], "B": [0, 50]},
    "joints": {
        "C": {"crank": "B", "length": 20},
        "D": {"slot": {"pivot": "A", "through": "C"}, "length": 120},
    },
    "bodies": {"crank": {"joints": ["B", "C"]}, "lever": {"joints": ["A", "D"]}},
}


def test_a_slotted_lever_has_the_slip_of_its_pin() -> None:
    scene = scene_from(LEVER, name="lever", where="lever.toml")
    motion = scene.solve(angle=math.radians(40))
    names = ("lever.slip", "lever.slip_velocity", "lever.slip_acceleration", "C.coriolis")
    told = {token: float(scene.quantities[token].read(motion)) for token in names}
    assert told["lever.slip"] == pytest.approx(64.69602, abs=5e-6)
    assert told["lever.slip_velocity"] == pytest.approx(35.52202, abs=5e-6)
    assert told["lever.slip_acceleration"] == pytest.approx(-108.9233, abs=5e-5)
    assert told["C.coriolis"] == pytest.approx(53.0994, abs=5e-5)


@pytest.mark.parametrize(
    "name", ["whitworth", "crank-shaper", "scotch-yoke", "oscillating-cylinder", "scissor-lift"]
)
def test_its_rates_are_the_derivatives_of_the_slip(name: str) -> None:
    scene = linkanim.load(name)
    step, phases = 1e-4, np.linspace(0.3, 2.5, 9)

    def told(token: str, at: Any) -> Any:
        return np.asarray(scene.quantities[token].read(scene.solve(phase=at, speed=1.0)))

    slips = [token for token in scene.quantities if token.endswith(".slip")]
    assert slips
    for token in slips:
        for one, rate in ((token, f"{token}_velocity"), (f"{token}_velocity", f"{token}_acceleration")):
            found = (told(one, phases + step) - told(one, phases - step)) / (2 * step)
            size = float(np.abs(told(rate, phases)).max()) or 1.0
            assert np.abs(found - told(rate, phases)).max() < 1e-6 * max(size, 1.0)
