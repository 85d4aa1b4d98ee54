"""What is measured of `linkanim path`, in small, and its table."""

from __future__ import annotations

import path_answers as paths
import pytest

pytest.importorskip("scipy")


@pytest.mark.long
def test_problems_are_measured_beside_what_is_published_and_searched(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(paths, "SHAPES", {"square": paths.SHAPES["square"]})
    rows = paths.run(0.5, 2)
    curves, eighteen, line, square = rows
    assert curves.here.endswith("%")
    assert float(eighteen.here) <= 9.03e-3
    assert float(line.here) <= 1e-20
    ours, other = (float(text.split()[-2]) for text in (square.here, square.beside))
    assert 0 < ours <= other
    table = paths.as_markdown(rows, "a machine").splitlines()
    assert {row.count("|") for row in table[:6]} == {len(paths.TITLES) + 1}
