"""The command of the long run: its table is read as it was written, and its parts are all of it."""

from __future__ import annotations

import subprocess
from types import SimpleNamespace

import long_run
import pytest
from long_run import LongRow, part_of, rows_of, table

ROWS = {
    "b/test_two.py": LongRow("1,200", "3", "2026-11-02", "green"),
    "a/test_one.py": LongRow("7", "61", "2026-11-01", "red"),
}


def test_the_table_is_read_as_it_was_written() -> None:
    assert rows_of(table(ROWS)) == ROWS
    assert table(rows_of(table(ROWS))) == table(ROWS)
    assert rows_of(long_run.TABLE.read_text(encoding="utf-8"))


def test_the_parts_are_all_files_each_once_and_what_was_run_longest_ago_comes_first() -> None:
    files = [*ROWS, "c/test_new.py"]
    assert part_of(files, "1/1", ROWS) == ["c/test_new.py", "a/test_one.py", "b/test_two.py"]
    assert sorted(part_of(files, "1/2", ROWS) + part_of(files, "2/2", ROWS)) == sorted(files)


@pytest.mark.parametrize(("code", "result", "said"), [(0, "green", ""), (1, "red", "one failed")])
def test_a_file_is_red_or_green_and_a_red_one_says_why(
    code: int, result: str, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        subprocess, "run", lambda *_, **__: SimpleNamespace(returncode=code, stdout="one failed")
    )
    row, words = long_run.run("a/test_one.py", 1_234)
    assert (row.tests, row.result, words) == ("1,234", result, said)
