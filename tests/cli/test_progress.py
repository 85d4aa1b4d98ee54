"""Commands that may take more than three seconds show how far they are, on a terminal and there alone."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import pytest

from linkanim.cli import main, progress

OVAL = "0,0\n40,5\n70,30\n40,45\n5,30\n20,50\n-10,20\n"


class Terminal(io.StringIO):
    """A stream that is a terminal."""

    def isatty(self) -> bool:
        return True


# What a command counts. On stdout a sweep's rows are seen as they come.
COUNTED: dict[str, tuple[list[str], str]] = {
    "path": (["path", "oval.csv", "--count", "1"], "steps"),
    "path --front": (["path", "oval.csv", "--count", "1", "--front", "front.csv"], "steps"),
    "make": (["make", "press", "-o", "parts"], "tried"),
    "solve": (["solve", "press", "--sweep", "0:50:0.01", "--csv", "sweep.csv"], "blocks"),
    "explain": (["explain", "slider-crank", "--exercise", "--versions", "2", "-o", "sheet.md"], "versions"),
    "report": (["report", "slider-crank", "-o", "report"], "parts"),
    "check": (["check", "scene.toml"], "files"),
    "record": (["record", "crank-rocker", "-o", "a.gif", "--size", "64x64", "--seconds", "0.2"], "frames"),
    "quiz": (["quiz", "press", "-n", "1", "-o", "quiz.html"], "questions"),
}
SLOW = {"path", "path --front", "make", "report"}


@pytest.mark.parametrize(
    ("words", "unit"),
    [pytest.param(*row, id=name, marks=[pytest.mark.slow] * (name in SLOW)) for name, row in COUNTED.items()],
)
@pytest.mark.parametrize("seen", [True, False], ids=["after a while", "soon done"])
@pytest.mark.thinned(2)
def test_a_bar_is_drawn_on_a_terminal_after_a_while(
    words: list[str], unit: str, seen: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("oval.csv").write_text(OVAL, encoding="utf-8")
    Path("scene.toml").write_text(
        "[four-bar]\nground = 100\ncrank = 30\ncoupler = 90\nrocker = 80\n", encoding="utf-8"
    )
    monkeypatch.setattr(progress, "_SILENT", 0.0 if seen else 3600.0)
    stderr = Terminal()
    monkeypatch.setattr(sys, "stderr", stderr)
    assert main(words) == 0
    drawn = stderr.getvalue()
    assert (f" {unit} [" in drawn or f" {unit}/s]" in drawn) is seen
    assert "\r" not in drawn.rstrip("\r").rpartition("\r")[2]  # and is gone again


def test_rows_that_are_printed_on_a_terminal_have_no_bar_between_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(progress, "_SILENT", 0.0)
    monkeypatch.setattr(sys, "stdout", Terminal())
    stderr = Terminal()
    monkeypatch.setattr(sys, "stderr", stderr)
    assert main(["solve", "slider-crank", "--sweep", "0:50:0.01", "--csv", "-"]) == 0
    assert stderr.getvalue() == ""
