"""Timings are taken in turn, repeated where short, and their median told; on a clock of the test's own."""

from __future__ import annotations

import pytest

from linkanim.bench.methods import Timed
from linkanim.bench.result import LEAST_SECONDS, nanoseconds


class Bench:
    """A clock, and work that takes its time on it."""

    def __init__(self) -> None:
        self.now = 0.0
        self.done: list[str] = []

    def work(self, name: str, seconds: list[float], poses: int) -> Timed:
        times = iter(seconds)
        last = seconds[-1]

        def run() -> None:
            self.done.append(name)
            self.now += next(times, last)

        return Timed(run, poses)


def test_the_median_round_is_told_in_ns_a_pose() -> None:
    bench = Bench()
    slow = bench.work("slow", [9.0, 1.0, 1.0, 5.0, 2.0], 1000)
    found = nanoseconds({"slow": slow}, rounds=3, clock=lambda: bench.now)
    assert found == {"slow": pytest.approx(2.0 / 1000 * 1e9)}


def test_all_take_their_turn_in_every_round() -> None:
    bench = Bench()
    work = {name: bench.work(name, [1.0], 1) for name in "ab"}
    nanoseconds(work, rounds=3, clock=lambda: bench.now)
    assert "".join(bench.done) == "aabb" * (1 + 3)


def test_short_work_is_repeated() -> None:
    bench = Bench()
    short = bench.work("short", [LEAST_SECONDS / 8], 10)
    found = nanoseconds({"short": short}, rounds=1, clock=lambda: bench.now)
    # Twice to see how long it takes, once more untimed, then the eight that count.
    assert len(bench.done) == 2 + 1 + 8
    assert found["short"] == pytest.approx(LEAST_SECONDS / 8 / 10 * 1e9)


def test_a_slow_machine_gets_fewer_rounds_but_three() -> None:
    bench, rounds_done = Bench(), []
    slow = bench.work("slow", [1.0], 1)
    nanoseconds(
        {"slow": slow},
        rounds=9,
        budget=0.5,
        clock=lambda: bench.now,
        wall=lambda: bench.now,
        progress=lambda done, total: rounds_done.append((done, total)),
    )
    assert rounds_done == [(1, 9), (2, 9), (3, 9)]


def test_the_budget_counts_from_the_first_round() -> None:
    bench, rounds_done = Bench(), []
    bench.now = 1000.0
    slow = bench.work("slow", [1.0], 1)
    nanoseconds(
        {"slow": slow},
        rounds=6,
        budget=9.5,
        clock=lambda: bench.now,
        wall=lambda: bench.now,
        progress=lambda done, total: rounds_done.append(done),
    )
    # Two seconds a round, the untimed run among them: the fifth still begins within the budget.
    assert rounds_done == [1, 2, 3, 4, 5]


def test_work_too_short_for_the_clock_is_timed_all_the_same() -> None:
    bench = Bench()
    nothing = bench.work("nothing", [0.0], 1)
    assert nanoseconds({"nothing": nothing}, rounds=3, clock=lambda: bench.now) == {"nothing": 0.0}
    assert len(bench.done) == 2 * (1 + 3)
