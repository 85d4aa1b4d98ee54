"""Run the long tests, file by file, and keep the table of what was run, when, how long, red or green.

`python tests/tally/long_run.py` runs all files, those that were run longest ago first; `--part 2/4` a quarter
of them; FILE … only these. The table, `tests/long_run.md`, is written after every file: a run may be cut off.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import NamedTuple

TESTS = Path(__file__).parents[1]
TABLE = TESTS / "long_run.md"
HEAD = """# The long run

Written by `python tests/tally/long_run.py`; seconds are of processor time.

| file | tests | s | when | result |
|---|---|---|---|---|
"""
_ROW = re.compile(r"^\| `(.+?)` \| (.*?) \| (.*?) \| (.*?) \| (.*?) \|$", re.MULTILINE)


class LongRow(NamedTuple):
    """A file's long tests: how many, the seconds they took, the day, and whether they were green."""

    tests: str
    seconds: str
    day: str
    result: str


def rows_of(text: str) -> dict[str, LongRow]:
    """Return the rows of a table by their files."""
    return {file: LongRow(*row) for file, *row in _ROW.findall(text)}


def table(rows: Mapping[str, LongRow]) -> str:
    """Return the table of rows, in the order of their files."""
    return HEAD + "".join(f"| `{file}` | {' | '.join(row)} |\n" for file, row in sorted(rows.items()))


def part_of(files: Iterable[str], part: str, known: Mapping[str, LongRow]) -> list[str]:
    """Return part n/m of the files, those that were run longest ago first."""
    number, count = map(int, part.split("/"))
    ordered = sorted(files, key=lambda file: (known[file].day if file in known else "", file))
    return ordered[number - 1 :: count]


def _pytest(*words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pytest", "-n0", "-m", "long", *words]
    return subprocess.run(command, cwd=TESTS.parent, capture_output=True, text=True, check=False)


def collected(files: Iterable[str]) -> Counter[str]:
    """Return how many long tests each file has."""
    found = _pytest("--collect-only", *(f"tests/{file}" for file in files)).stdout
    names = re.findall(r"^tests/(\S+?\.py)::", found, re.MULTILINE)
    return Counter(names)


def run(file: str, count: int) -> tuple[LongRow, str]:
    """Run a file's long tests; return its row, and what they said where they are red."""
    before = os.times()
    done = _pytest("-q", f"tests/{file}")
    after = os.times()
    seconds = after.children_user + after.children_system - before.children_user - before.children_system
    result = "red" if done.returncode else "green"
    row = LongRow(f"{count:,}", f"{seconds:,.0f}", f"{datetime.now(UTC):%Y-%m-%d}", result)
    return row, done.stdout if done.returncode else ""


def main() -> int:
    """Run what the command line asks for; return 1 where something was red."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="*", metavar="FILE", help="as picture/test_hud.py")
    parser.add_argument("--part", default="1/1", metavar="N/M")
    asked = parser.parse_args()
    known = rows_of(TABLE.read_text(encoding="utf-8")) if TABLE.exists() else {}
    counts = collected(asked.files)
    if not asked.files:
        known = {file: row for file, row in known.items() if file in counts}
    for file in part_of(counts, asked.part, known):
        known[file], said = run(file, counts[file])
        TABLE.write_text(table(known), encoding="utf-8")
        print(f"{known[file].result:6}{known[file].seconds:>8} s  {file}\n{said}".rstrip(), flush=True)
    return int(any(known[file].result == "red" for file in counts if file in known))


if __name__ == "__main__":
    raise SystemExit(main())
