"""How far a linkage is off when its lengths are: against fifty digits, and against samples of our own."""

from __future__ import annotations

import math
from itertools import product
from typing import Any

import mpmath
import numpy as np
import pytest

import linkanim
from linkanim.errors import BadInput
from linkanim.scenes.deviation import Off, Tolerance, tolerance
from linkanim.scenes.editing import dimensions
from linkanim.scenes.many import named_lengths, solve_many

BY = 0.1
LENGTHS = ("ground", "crank", "coupler", "rocker", "coupler_point.0", "coupler_point.1")
OWN = (100.0, 40.0, 90.0, 75.0, 45.0, 30.0)
FOUR_BAR = """
title = "Four-bar"
length_unit = "mm"
[four-bar]
ground = 100
crank = 40
coupler = 90
rocker = 75
coupler_point = [45, 30]
"""


@pytest.fixture(scope="module")
def four_bar(tmp_path_factory: pytest.TempPathFactory) -> Tolerance:
    path = tmp_path_factory.mktemp("scenes") / "four-bar.toml"
    path.write_text(FOUR_BAR)
    return tolerance(linkanim.load(path), BY)


def named(found: Tolerance, name: str) -> Off:
    return next(off for off in found.quantities if off.name == name)


def four_bar_at(theta: Any, lengths: tuple[Any, ...]) -> tuple[Any, Any]:
    """Return the coupler point and the rocker's angle by circles that meet, as numbers of mpmath."""
    ground, crank, coupler, rocker, along, across = lengths
    pin = crank * mpmath.expj(theta)
    apart = ground - pin
    size = abs(apart)
    way = (coupler**2 - rocker**2 + size**2) / (2 * size)
    rise = mpmath.sqrt(coupler**2 - way**2)
    end = pin + apart / size * mpmath.mpc(way, rise)
    return pin + mpmath.mpc(along, across) * (end - pin) / coupler, mpmath.arg(end - ground)


def slopes(quantity: int, theta: Any) -> list[Any]:
    """Return the derivatives by each length, in fifty digits."""

    def by(n: int) -> Any:
        def at(value: Any) -> Any:
            return four_bar_at(theta, (*OWN[:n], value, *OWN[n + 1 :]))[quantity]

        step = mpmath.mpf(10) ** -12
        return (at(OWN[n] + step) - at(OWN[n] - step)) / (2 * step)

    return [by(n) for n in range(len(OWN))]


@pytest.mark.parametrize("number", [0, 13, 37, 60])
def test_the_first_order_has_ten_digits(number: int, four_bar: Tolerance) -> None:
    assert four_bar.lengths == LENGTHS
    point, rocker = named(four_bar, "P"), named(four_bar, "rocker")
    theta = four_bar.scene.linkage.drive.start + point.phases[number]
    with mpmath.workdps(50):
        vectors, turned = slopes(0, mpmath.mpf(theta)), slopes(1, mpmath.mpf(theta))
        alone = [float(BY * abs(one)) for one in vectors]
        # of all corners the farthest: each length is too long, or too short
        corners = product((-1, 1), repeat=len(OWN))
        worst = max(abs(sum(s * v for s, v in zip(signs, vectors, strict=True))) for signs in corners)
        whole = float(BY * worst), float(BY * sum(abs(one) for one in turned))
    assert point.alone[:, number] == pytest.approx(alone, rel=1e-10)
    assert point.bound[number] == pytest.approx(whole[0], rel=1e-10)
    assert rocker.bound[number] == pytest.approx(whole[1], rel=1e-10)


# The rocker's swing by the law of cosines at both dead centres, the slider's stroke by Pythagoras.
def test_a_swing_and_a_stroke_have_ten_digits(four_bar: Tolerance) -> None:
    ground, crank, coupler, rocker = (mpmath.mpf(one) for one in OWN[:4])

    def swing(*lengths: Any) -> Any:
        r1, r2, r3, r4 = lengths
        outer, inner = (mpmath.acos((r1**2 + r4**2 - way**2) / (2 * r1 * r4)) for way in (r3 + r2, r3 - r2))
        return outer - inner

    def stroke(r: Any, rod: Any, offset: Any) -> Any:
        return mpmath.sqrt((rod + r) ** 2 - offset**2) - mpmath.sqrt((rod - r) ** 2 - offset**2)

    slider = tolerance("slider-crank", BY)
    own = [slider.scene.document["slider-crank"][name] for name in ("crank", "rod", "offset")]
    with mpmath.workdps(50):
        for found, name, formula, lengths in (
            (four_bar, "swing", swing, (ground, crank, coupler, rocker)),
            (slider, "stroke", stroke, tuple(map(mpmath.mpf, own))),
        ):
            orders = [tuple(int(n == m) for m in range(len(lengths))) for n in range(len(lengths))]
            exact = [abs(mpmath.diff(formula, lengths, order)) for order in orders]
            off = named(found, name)
            assert off.by[: len(exact)] == pytest.approx([float(BY * one) for one in exact], rel=1e-9)
            assert off.worst == pytest.approx(float(BY * sum(exact)), rel=1e-9)
            assert off.worst_phase is None


@pytest.mark.slow
def test_samples_agree_with_ten_thousand_others_in_fifty_digits(four_bar: Tolerance) -> None:
    point = named(four_bar, "P")
    assert point.worst_phase is not None
    theta = four_bar.scene.linkage.drive.start + point.worst_phase
    errors = np.random.default_rng(77).uniform(-BY, BY, (10_000, len(OWN)))
    with mpmath.workdps(50):
        exact = four_bar_at(mpmath.mpf(theta), tuple(map(mpmath.mpf, OWN)))[0]
        off = [
            float(abs(four_bar_at(mpmath.mpf(theta), tuple(np.add(OWN, row).tolist()))[0] - exact))
            for row in errors
        ]
    assert point.likely == pytest.approx(float(np.quantile(off, 0.95)), rel=0.02)
    assert point.greatest == pytest.approx(max(off), rel=0.1)
    # none is farther off than to first order, but for the little that this leaves out
    assert max(*off, point.greatest) <= point.worst * 1.01
    assert point.likely < point.greatest


def test_the_length_that_matters_most_is_named(four_bar: Tolerance) -> None:
    for off in four_bar.quantities:
        assert off.by[four_bar.lengths.index(four_bar.most(off))] == off.by.max()
    assert four_bar.most(named(four_bar, "swing")) == "crank"


@pytest.mark.slow
def test_pins_are_off_from_the_input_s_own_and_masses_are_no_lengths() -> None:
    found = tolerance("press", 0.05, samples=0)
    assert not {"O2.0", "O2.1"} & set(found.lengths)
    assert "O7.length" in found.lengths
    assert not [name for name in found.lengths if "com" in name or "return" in name]
    assert math.isnan(named(found, "stroke").likely)


# scene, quantity, length, number of the phase: with the larger steps other dyads limit the input
@pytest.mark.parametrize(
    ("name", "quantity", "length", "number"), [("klann", "arm", "L.0", 46), ("peaucellier", "P", "Q.1", 22)]
)
def test_a_step_to_linkages_of_another_kind_does_not_count(
    name: str, quantity: str, length: str, number: int
) -> None:
    scene = linkanim.load(name)
    found = tolerance(scene, 1e-3 * scene.linkage.extent, samples=0)
    off = named(found, quantity)
    values = {one.key: float(one.value) for one in dimensions(scene)}
    own, by = values[named_lengths(scene)[length].key], found.by
    motion = solve_many(scene, {length: [own + 1e-4 * by, own - 1e-4 * by]}, off.phases[number])
    places = motion.position[quantity] if quantity in motion.position else motion.angle[quantity][:, None]
    true = np.linalg.norm(places[0] - places[1]) / 2e-4
    assert off.alone[found.lengths.index(length), number] == pytest.approx(true, rel=1e-6)


@pytest.mark.parametrize("name", ["driven-piston", "elliptic-trammel", "toggle-press"])
def test_linkages_that_would_be_read_one_by_one_are_refused(name: str) -> None:
    with pytest.raises(BadInput, match=f"{name}: tolerances are worked out for chains of dyads"):
        tolerance(name, 0.05)


@pytest.mark.parametrize("by", [0.0, -1.0, math.nan, 1e3])
def test_a_tolerance_that_makes_no_sense_is_refused(by: float, four_bar: Tolerance) -> None:
    with pytest.raises(BadInput, match="give a length above zero and of"):
        tolerance(four_bar.scene, by)
