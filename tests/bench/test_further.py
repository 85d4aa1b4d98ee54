"""A cycle, many linkages, a triad and forces: right to the last digits, and each worst error once more."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from made_result import result

from linkanim.bench import further
from linkanim.bench.further import FurtherMeasured, FurtherWork
from linkanim.bench.methods import batch
from linkanim.bench.questions import EASY, FOUR_BAR
from linkanim.bench.reference import answer
from linkanim.bench.result import again
from linkanim.cli import main
from linkanim.errors import BadInput

EPS = 2.0**-52
ROWS = further.further()

every_row = pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)


@every_row
def test_further_work_is_right_to_the_last_digits(row: FurtherWork) -> None:
    errors = row.errors(row.tried[::9])
    assert errors.shape == (10,)
    assert errors.max() <= 16 * EPS
    assert errors.max() > 0  # the reference has more digits


@every_row
def test_the_work_that_is_timed_is_done(row: FurtherWork) -> None:
    found = np.asarray(row.timed.work()) if row.name != "forces" else np.array(1.0)
    assert np.isfinite(found).all()
    row.timed.work()


# What is off by 1e-9 of a length is told to be so.
@every_row
def test_an_error_is_seen(row: FurtherWork, monkeypatch: pytest.MonkeyPatch) -> None:
    off = 1 + 1e-9
    points = {**further.TRIAD["points"], "A": [86.71 * off, 50.6]}
    monkeypatch.setattr(further, "TRIAD", {**further.TRIAD, "points": points})
    monkeypatch.setattr(further, "MASSES", {**further.MASSES, "coupler": (0.9 * off, 0.8)})
    monkeypatch.setattr(further, "EASY", (EASY[0] * off, *EASY[1:]))
    moved = lambda question: ({name: at * off for name, at in batch(question)[0].items()},)  # noqa: E731
    monkeypatch.setattr(further, "batch", moved)
    assert 1e-11 < row.errors(row.tried[::30]).max() < 1e-7


@every_row
def test_one_error_alone_is_that_among_others(row: FurtherWork) -> None:
    errors = row.errors(row.tried[:3])
    for numbers, error in zip(row.tried[:3].tolist(), errors, strict=True):
        assert again(row.name, numbers) == f"error {error:.2e}"


def test_a_witness_of_the_table_prints_its_error_again(capsys: pytest.CaptureFixture[str]) -> None:
    (case,) = (one for one in FOUR_BAR.hard if one.name == "through two limits")
    found = answer(replace(case, inputs=case.inputs[::40])).score(batch)
    assert len(found.at) == 3
    for what, error, at in zip(("position", "velocity", "acceleration"), found.errors, found.at, strict=True):
        assert main(["bench", "--again", "four-bar: through two limits", at]) == 0
        assert f"{what} {error:.2e}" in capsys.readouterr().out


def test_the_report_ends_in_the_worst_errors_and_their_commands() -> None:
    made = result()
    case = replace(made.rows[0].cases["a hard case"], at=("0x1p+0", "0x1p+1", "0x1p+2"))
    rows = (replace(made.rows[0], cases={"a hard case": case}), *made.rows[1:])
    more = FurtherMeasured("triad", "poses of a triad", 12.5, 3e-16, ("0x1.8p+0",))
    lines = replace(made, rows=rows, further=(more,)).witnesses()
    assert lines[0] == "position 8.5e-16: linkanim bench --again 'four-bar: a hard case' 0x1p+0"
    assert lines[-1] == "error 3.0e-16: linkanim bench --again triad 0x1.8p+0"
    text = replace(made, rows=rows, further=(more,)).as_text()
    assert re.search(r"poses of a triad +12\.5 +3\.0e-16", text)
    assert text.endswith(lines[-1])


# What is asked for, and part of the sentence that refuses it.
@pytest.mark.parametrize(
    ("name", "numbers", "told"),
    [
        ("no such", [1.0], "'no such': there are 'four-bar: easy cycle'.*'forces'"),
        ("triad", [], "'triad': give phase as"),
        ("many linkages", [1.0], "give crank, coupler, rocker, phase"),
        ("press: easy cycle", [1.0, 2.0], "give input"),
    ],
)
def test_what_there_is_not_is_refused(name: str, numbers: list[float], told: str) -> None:
    with pytest.raises(BadInput, match=told):
        again(name, numbers)


def test_what_is_no_number_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "--again", "triad", "one"]) == 2
    assert "bench --again: one: give hexadecimal floats" in capsys.readouterr().err
