"""No sample decides alone whether a dyad on moving points closes all along."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest
from near_misses import BESIDE, is_right, near_miss, rows
from whole_rows import whole_rows

from linkanim.errors import AssemblyError
from linkanim.mechanics.linkage import RRP, RRR, Crank, Drive, Line, Linkage, Pin
from linkanim.mechanics.motion import Mechanism, mechanism
from linkanim.mechanics.solver.input import Swing


def knee(second: float, start_deg: float) -> Linkage:
    """A slider-crank with two bars, 60 and that long, from its slider to the line's pin, which it runs over.

    There, near 99.59 degrees, the bars cannot fold up: they are not equally long.
    """
    joints = (
        Pin("O2", (150.0, 0.0)),
        Pin("O", (0.0, 0.0)),
        Crank("A", "O2", 50.0),
        RRP("C", "A", 150.0, Line("O"), -1),
        RRR("K", ("C", "O"), (60.0, second)),
    )
    return Linkage(joints, Drive("A", 1.0, math.radians(start_deg)))


def finite(solved: Mechanism, angle: float) -> bool:
    return bool(np.isfinite(rows(solved, angle)).all())


@pytest.mark.parametrize("start_deg", [30.0, 30.1, 30.25])
@pytest.mark.parametrize("more", [0.05, 0.02, 1e-8])
def test_where_a_knee_is_stopped_does_not_hang_on_where_samples_fall(more: float, start_deg: float) -> None:
    solved = mechanism(knee(60.0 + more, start_deg))
    path = solved.assembly.path
    assert isinstance(path, Swing)
    assert path.ends == ("K", "K")
    # The slider is as far from O as the bars are unlike: the law of cosines at O2.
    base = 150.0 - ((60.0 + more) - 60.0)
    end = math.acos((20_000.0 - base * base) / (100.0 * base))
    assert path.input_range == pytest.approx((-end, end), abs=1e-15)
    assert solved.periods == 1
    assert finite(solved, path.limits[1])


@pytest.mark.parametrize("more", [1e-10, 1e-12])
def test_bars_of_nearly_one_length_whose_ends_nearly_meet_are_refused(more: float) -> None:
    # The two limits, one before the ends would meet and one behind, are 1e-6 rad of phase apart.
    with pytest.raises(AssemblyError, match="joint K: its limit lies too near to another one"):
        mechanism(knee(60.0 + more, 30.0))


def close(number: int) -> None:
    """Check one random linkage, by number: it is limited or closed as it should be, or refused."""
    case = near_miss(random.Random(number))
    try:
        solved = mechanism(case.linkage)
    except AssemblyError:
        return
    assert isinstance(solved.assembly.path, Swing) == (case.gap > 0), number
    assert finite(solved, case.angle), number
    path = solved.assembly.path
    beside = [end + way * BESIDE for end in (case.angle, *path.input_range) for way in (-1, 1)]
    reached = whole_rows(solved, np.concatenate([path.input_range, *beside]))
    assert reached[:2].all(), number
    assert reached.all() == path.full_turn, number
    if number % 10 == 0:
        assert is_right(case, solved), number


def test_a_limit_has_its_digits_where_the_ends_nearly_meet() -> None:
    # Bars of 101 on ends 0.017 apart: what rounds a share of a bar of 50 had moved the limit by 2e-15.
    case = near_miss(random.Random(1400))
    assert is_right(case, mechanism(case.linkage))


@pytest.mark.slow
def test_linkages_that_just_miss_closing_are_limited_and_those_that_just_close_turn() -> None:
    for number in range(12):
        close(number)


def test_next_to_one_of_two_dips_that_are_as_low_rates_are_those_beside_it() -> None:
    # Both lie in a stretch that one fit would do for; within 1e-8 rad of the other its root was 0.
    close(19_905)


def test_a_swing_past_too_many_change_points_is_refused_and_not_cut_a_little() -> None:
    with pytest.raises(AssemblyError, match="102 change points"):
        mechanism(near_miss(random.Random(17_230)).linkage)


@pytest.mark.long
@pytest.mark.parametrize("first", range(0, 20_000, 500))
def test_twenty_thousand_near_misses(first: int) -> None:
    for number in range(first, first + 500):
        close(number)
