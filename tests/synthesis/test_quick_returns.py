"""Stroke or swing and time ratio to linkages: exact on the solver, the best of their family."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import linkanim
from linkanim.errors import BadInput
from linkanim.mechanics.measures import transmission_angle
from linkanim.synthesis.quick_returns import QuickReturn, families

DEGREE = math.pi / 180


def verify(found: QuickReturn, ratio: float, output: float) -> None:
    info = found.scene.info
    assert info.full_turn
    assert found.ratio == info.time_ratio == pytest.approx(ratio, rel=1e-9)
    assert found.output == pytest.approx(output, rel=1e-9)
    assert info.transmission is not None
    assert found.transmission_angle == pytest.approx(info.transmission.least, abs=1e-9)
    assert 0 <= found.place <= 1


# No quick return, next to none, where a rod of twelve cranks is the best, and others.
RATIOS = (1.0, 1 + 1e-12, 1.0000007, 1.00001, 1.0002, 1.00025, 1.01, 1.05, 1.4, 2.0, 2.5)


@pytest.mark.parametrize("ratio", RATIOS)
def test_slider_cranks_have_stroke_and_ratio(ratio: float) -> None:
    found = linkanim.quick_return(stroke=80, ratio=ratio)
    for one in found:
        verify(one, ratio, 80)
    assert found[0].best
    assert found[0].transmission_angle >= max(one.transmission_angle for one in found)
    if ratio > 1.0000001:
        # the way forward is the slow one
        back, forward = found[0].scene.info.dead_centres or (0, 0)
        assert (forward - back) % math.tau > math.pi


@pytest.mark.parametrize(
    ("swing", "ratio"),
    [
        (30, 1.0),
        (60, 1 + 1e-12),
        (60, 1.00001),
        (60, 1.0002),
        (60, 1.25),
        (60, 1.4),
        (45, 1.25),
        (90, 1.1),
        (120, 1.5),
        (25, 1.6),
        (120, 3),
    ],
)
def test_crank_rockers_have_swing_and_ratio(swing: float, ratio: float) -> None:
    for one in linkanim.quick_return(swing=swing * DEGREE, ratio=ratio, count=3):
        verify(one, ratio, swing * DEGREE)
        assert "crank-rocker" in one.class_name


@pytest.mark.parametrize("options", [{"stroke": 80}, {"swing": 1.0}], ids=["slider-crank", "crank-rocker"])
def test_a_family_goes_over_into_the_one_without_a_quick_return(options: dict[str, Any]) -> None:
    found = [linkanim.quick_return(ratio=ratio, **options) for ratio in RATIOS[:5]]
    for one, other in pairwise(found):
        for member, next_one in zip(one, other, strict=True):
            assert member.transmission_angle == pytest.approx(next_one.transmission_angle, abs=0.2 * DEGREE)


def test_the_best_is_the_best_of_all_crank_rockers_of_that_swing_and_ratio() -> None:
    (best,) = linkanim.quick_return(swing=60 * DEGREE, ratio=1.25, count=1)
    # all crank-rockers with a rocker of 1 and dead centres 60° apart, by the pivot's place alone
    ends = np.exp(1j * (np.array([60, 120]) * DEGREE))
    x, y = np.meshgrid(np.linspace(-3, 3, 601), np.linspace(-3, 3, 601))
    pivot = x + 1j * y
    near, far = (np.abs(end - pivot) for end in ends)
    crank, coupler, ground = np.abs(far - near) / 2, (far + near) / 2, np.abs(pivot)
    turned = np.abs(np.angle((ends[1] - pivot) / (ends[0] - pivot))) / DEGREE
    cosines = [(coupler**2 + 1 - (ground + sign * crank) ** 2) / (2 * coupler) for sign in (-1, 1)]
    least = np.arccos(np.minimum(np.maximum(np.abs(cosines[0]), np.abs(cosines[1])), 1))
    on_circle = np.abs(turned - 20) < 0.5
    assert least[on_circle].max() < best.transmission_angle + 0.02
    assert least[on_circle].max() > best.transmission_angle - 0.02


def test_a_place_in_the_family_is_one_member_of_it() -> None:
    low, high = (linkanim.quick_return(stroke=80, ratio=1.4, place=place) for place in (0.1, 0.9))
    assert len(low) == len(high) == 1
    assert low[0].parameters["rod"] < high[0].parameters["rod"]
    (family, *_) = families("slider-crank", 1.4)
    rods = family.lengths(np.linspace(family.low, family.high, 50))[1]
    assert (np.diff(rods) > 0).all()


def test_a_rocker_s_chord_can_be_given() -> None:
    (one,) = linkanim.quick_return(swing=60 * DEGREE, ratio=1.25, stroke=50, count=1)
    assert one.parameters["rocker"] == pytest.approx(50)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"ratio": 0.5, "stroke": 80}, "1 to 10"),
        ({"ratio": math.nan, "stroke": 80}, "1 to 10"),
        ({"ratio": 1.2, "stroke": -1}, "a length above zero"),
        ({"ratio": 1.2}, "stroke is missing: .* such as 80, or the swing of a crank-rocker"),
        ({"ratio": 1.2, "swing": 1.0, "kind": "slider-crank"}, "stroke is missing: .* such as 80$"),
        ({"ratio": 1.2, "stroke": 80, "swing": 1.0, "kind": "slider-crank"}, "and no swing"),
        ({"ratio": 1.2, "stroke": 80, "kind": "crank-rocker"}, "a crank-rocker has a swing"),
        ({"ratio": 1.2, "swing": 4.0}, "swings by 1 to 179 deg"),
        ({"ratio": 1.2, "swing": 1.0, "kind": "rocker"}, "take slider-crank or crank-rocker"),
        ({"ratio": 1.2, "stroke": 80, "place": 2.0}, "from 0 to 1"),
        ({"ratio": 1.2, "stroke": 80, "count": 0}, "from 1 to 50"),
        ({"ratio": 9.0, "swing": 3.1}, "no crank-rocker swings by"),
        # its dead centres would be on circuits of their own
        ({"ratio": 3.5, "stroke": 80}, "no slider-crank slides with a time ratio of 3.5; take a smaller one"),
    ],
)
def test_what_cannot_be_is_said(options: dict[str, Any], said: str) -> None:
    with pytest.raises(BadInput, match=said):
        linkanim.quick_return(**options)


# A stroke of many cranks: a rocker as long as it takes. Dead centres, and so the time ratio, are the
# crank-rocker's; forward is the slow way while the crank turns counterclockwise.
@pytest.mark.parametrize("ratio", [1.0, 1.2, 1.8])
@pytest.mark.parametrize("asked", [{}, {"swing": 40 * DEGREE, "crank": 3.0}, {"swing": 1.6, "crank": 25.0}])
def test_a_six_bar_has_a_stroke_of_many_cranks(ratio: float, asked: dict[str, Any]) -> None:
    for one in linkanim.quick_return(kind="six-bar", ratio=ratio, stroke=120.0, count=3, **asked):
        assert one.parameters["crank"] == asked.get("crank", 24.0)
        assert one.output == pytest.approx(120.0, rel=1e-12)
        assert one.ratio == pytest.approx(ratio, rel=1e-9)
        assert one.scene.info.full_turn
        motion = one.scene.cycle(4000, derivatives=1)
        assert np.ptp(motion.travel["slider"]) == pytest.approx(120.0, rel=1e-5)
        forward = float((motion.travel_velocity["slider"] > 0).mean())
        assert forward == pytest.approx(ratio / (1 + ratio), abs=1e-3)
        least = min(float(transmission_angle(motion, dyad).min()) for dyad in ("B", "C"))
        assert least == pytest.approx(one.transmission_angle, abs=1e-5)


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ({"kind": "six-bar"}, "the stroke is missing: give that of a six-bar"),
        ({"stroke": 50.0, "crank": 5.0}, "the crank of a slider-crank follows from the others"),
        ({"kind": "six-bar", "stroke": 50.0, "crank": -1.0}, "give a length above zero"),
    ],
)
def test_what_a_six_bar_needs_is_said(asked: dict[str, Any], says: str) -> None:
    with pytest.raises(BadInput, match=says):
        linkanim.quick_return(ratio=1.2, **asked)
