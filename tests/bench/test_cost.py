"""What a recording costs."""

from __future__ import annotations

import math

import pytest

from linkanim.bench.cost import cost
from linkanim.recorder.plan import Format


@pytest.mark.parametrize(("form", "least"), [("gif", 50.0), ("mp4", 35.0)])
def test_the_cost_of_a_recording_is_measured(form: Format, least: float) -> None:
    found = cost("slider-crank", form, frames=8)
    assert (found.form, found.frames) == (form, 8)
    assert least < found.decibels < 100
    assert 0.001 < found.megabytes < 1
    assert found.seconds > 0
    assert found.encode_seconds > 0
    assert all(0.01 < spent < 100 for spent in found.work if not math.isnan(spent))
    assert all(20 < megabytes < 1000 for megabytes in found.memory if not math.isnan(megabytes))
