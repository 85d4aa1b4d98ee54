"""Numbers that nobody can compute with are refused in a sentence, and a run has no warning of Python's own.

A warning is an error here, and would be an unexpected one; processes that tests start have them, too.
"""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from linkanim import child
from linkanim.cli import main

POSES = "0,0,0\n40,10,34\n70,-5,80\n100,30,100\n"

# An expression that is 0 but for a peak between the precision points, a table as steep as a float can be, a
# crank that stands, and numbers whose squares or steps are no floats.
CASES: dict[str, tuple[list[str], int, str]] = {
    "a peak": (["function", "exp(-1e6*(x-1.5)^2)", "--from", "1", "--to", "2", "--count", "1"], 0, ""),
    "nothing but a peak": (["function", "x^-1e30", "--from", "1", "--to", "2"], 2, "no four-bar was found"),
    "a steep table": (
        ["function", "steep.csv"],
        2,
        "y of a table has no value, or none that can be computed",
    ),
    "a long range": (["function", "x", "--from=-1e308", "--to=1e308"], 2, "is beyond what can be computed"),
    "a far slide": (
        ["function", "x", "--from=0", "--to=1", "--kind=slider-crank", "--output=-1e300 mm:80 mm"],
        2,
        '--output: "-1e300 mm" is beyond what can be computed; give a number from 1e-30 to 1e+30, or 0',
    ),
    "whole turns": (
        ["path", "curve.csv", "--timing", "360 deg"],
        2,
        "the crank is at one angle at all points",
    ),
    "hardly a turn": (["path", "curve.csv", "--timing", "1e-12 deg"], 2, "the crank is at one angle"),
    "many turns": (["path", "curve.csv", "--open", "--timing", "1e20 deg"], 2, "beyond 10,000 turns"),
    "a fine step": (["path", "curve.csv", "--round", "1e-300 mm"], 2, "beyond what can be computed"),
    "a large box": (["guide", "poses.csv", "--box=0,0,10,1e300"], 2, "beyond what can be computed"),
    "a far box": (["guide", "poses.csv", "--kind=slider-crank", "--box=-1e300,0,1,1"], 2, "beyond what can"),
    "a far pivot": (["guide", "poses.csv", "--pivots=1e150,0"], 2, "beyond what can be computed"),
    "as far as can be": (["guide", "poses.csv", "--pivots=1e30,0"], 2, "is no centre point of these four"),
    "a long stroke": (["quick-return", "--stroke", "1e300", "--ratio", "1.4"], 2, "beyond what can be"),
    "a slow figure": (
        ["draw", "press", "--angle=1 rad", "--speed=1e-320 rad/s", "--vectors=v,a", "-o", "a.svg"],
        2,
        "beyond what can be computed",
    ),
    "a quick start": (
        ["explain", "slider-crank", "--angle=1 rad", "--acceleration=1.7e308 rad/s^2"],
        2,
        "beyond what can be computed",
    ),
    "slow curves": (
        ["chart", "press", "--quantity=5.travel_velocity", "--speeds=1e-320 rad/s", "-o", "a.svg"],
        2,
        "beyond what can be computed",
    ),
}


@pytest.mark.parametrize(("words", "code", "said"), CASES.values(), ids=CASES)
def test_what_cannot_be_computed_with_is_a_sentence(
    words: list[str],
    code: int,
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("steep.csv").write_text("x,y\n1,-1e308\n2,0\n3,5\n4,1e308\n5,1e307\n", encoding="utf-8")
    Path("curve.csv").write_text("0,0\n40,5\n70,30\n40,45\n5,30\n", encoding="utf-8")
    Path("poses.csv").write_text(POSES, encoding="utf-8")
    assert main(words) == code
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == bool(error)


def test_warnings_are_errors_in_processes_of_tests_too() -> None:
    command = child.module("linkanim", "solve", "press", "--angle", "1 rad")
    assert os.environ["PYTHONWARNINGS"].startswith("error")
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    assert done.stderr == ""
