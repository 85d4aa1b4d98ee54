"""The cases are what their names say, along the inputs that the manual counts."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mp, workdps

from linkanim.bench.questions import FOUR_BAR, MECHANISMS, TOGGLE, TURN, Case

CASES = [(mechanism, case) for mechanism in MECHANISMS for case in mechanism.cases]
NAMED = {case.name: case for case in FOUR_BAR.hard}


# Every degree from 90° on, and beside each half turn 1e-2 to 1e-12 before and after.
@pytest.mark.parametrize("name", ["parallelogram", "change point at 0", "through two limits"])
def test_a_sequence_covers_its_turns_and_what_lies_beside_each_half_turn(name: str) -> None:
    case = NAMED[name]
    end = 90 + 360 * case.periods
    near = 10.0 ** np.arange(-12, -1)
    beside = [np.radians(half) + side * near for half in range(180, end, 180) for side in (-1, 1)]
    expected = np.sort(np.concatenate([np.radians(np.arange(90, end)), *beside]))
    assert case.inputs == pytest.approx(expected, rel=0, abs=1e-14)


@pytest.mark.parametrize(("name", "turns"), [("after 1e6 turns", 1e6), ("after 1e9 turns", 1e9)])
def test_after_so_many_turns_comes_one_more(name: str, turns: float) -> None:
    # So near to a float of that size as it can be.
    rest = NAMED[name].inputs - turns * TURN
    assert rest == pytest.approx(FOUR_BAR.easy.inputs, abs=2**-53 * turns * TURN)


def test_a_toggle_is_approached_three_times_a_decade() -> None:
    before = -np.log10(TOGGLE - NAMED["1e-12 rad before a toggle"].inputs)
    assert before == pytest.approx(np.linspace(1, 12, 34), abs=1e-3)


# What the solver makes of them: it goes back and forth, or takes as many turns as the case says.
@pytest.mark.parametrize(("mechanism", "case"), CASES, ids=lambda item: item.name)
def test_a_case_is_the_solvers_own_kind_of_input(mechanism: object, case: Case) -> None:
    reach = case.scene.info.input_range
    assert round(case.scene.period / TURN) == case.periods
    if case.swing is None:
        assert reach[1] - reach[0] == pytest.approx(TURN)
    else:
        with workdps(30):
            assert reach == pytest.approx([float(end) for end in case.swing(mp)], abs=1e-14)
