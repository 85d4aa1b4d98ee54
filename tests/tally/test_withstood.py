"""The table at the end of a run is the sum of what its tests have said."""

from __future__ import annotations

import pytest
from withstood import table


def test_figures_are_summed_and_of_memory_the_largest_is_shown() -> None:
    said = [
        ("frames run", 1_000),
        ("bad inputs tried", 500),
        ("frames run", 20_000),
        ("memory growth, MB", 1.26),
        ("memory growth, MB", -0.5),
        ("of another plugin", 7),
        ("bad inputs tried", "not a number"),
    ]
    assert list(table(said)) == [
        "| bad inputs tried | 500 |",
        "| frames run | 21,000 |",
        "| memory growth, MB | 1.3 |",
    ]


def test_without_figures_there_is_no_table() -> None:
    assert list(table([])) == []


@pytest.mark.withstands("frames run", 2)
def test_a_test_carries_what_it_says(request: pytest.FixtureRequest) -> None:
    assert ("frames run", 2) in request.node.user_properties
