"""The table, the README's table, the JSON and the picture say what the run found."""

from __future__ import annotations

import json
from pathlib import Path

import pygame
import pytest
from made_result import LOST, result, row

from linkanim.bench import drawing, report
from linkanim.bench.accuracy import Score
from linkanim.bench.cases import EASY, HARD
from linkanim.bench.entries import Entry, Timed
from linkanim.bench.question import Points, Question
from linkanim.bench.result import run, targets


def test_the_table_has_a_line_for_each_method_and_target() -> None:
    text = report.as_text(result())
    assert text.startswith("A processor, 2 cores, Python 3.11.7, numpy 2.4.6 with X86_V3")
    assert "batch by name" in text
    lines = {line.split("  ")[0]: line.split() for line in text.splitlines()}
    assert lines["batch by name"][3:] == ["9.3", "22.5", "3.0e-16", "8.5e-16", "0", "0"]
    assert lines["newton 1 by name"][4:] == ["1,600", "3.0e-16", "none", "right", "5,000", "198"]
    assert lines["positions"][-1] == "met"
    assert lines["times faster"][-1] == "missed"


def test_columns_are_aligned() -> None:
    assert report.columns([("a", "bb"), ("ccc", "d")]) == "a    bb\nccc   d"


def test_the_readmes_table_is_markdown_with_its_machine() -> None:
    head, rule, *body = report.as_markdown(result()).splitlines()
    assert head == f"| {' | '.join(report.TITLES)} |"
    assert rule.count("---:") == len(report.TITLES) - 1
    assert body[0] == "| batch by name | 9.3 | 22.5 | 3.0e-16 | 8.5e-16 | 0 | 0 |"
    assert body[-1].endswith("numpy 2.4.6 with X86_V3, one thread.")


def test_the_readme_shows_such_a_table() -> None:
    readme = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    shown = readme.partition("<!-- bench -->\n")[2].partition("<!-- /bench -->")[0].splitlines()
    assert shown[:2] == report.as_markdown(result()).splitlines()[:2]
    assert {line.count("|") for line in shown if line.startswith("|")} == {len(report.TITLES) + 1}
    assert shown[2].startswith("| linkanim, 10,000 at once |")


def test_the_json_is_strict_and_whole() -> None:
    found = json.loads(report.as_json(result()), parse_constant=pytest.fail)
    assert list(found) == ["machine", "rows", "targets"]
    batch, newton = found["rows"]
    assert (batch["ns_position"], batch["ns_derivatives"]) == (9.31, 22.5)
    assert batch["hard"] == {"poses": 5198, "error": 8.5e-16, "wrong": 0, "nan": 0}
    assert newton["ns_derivatives"] is None
    assert newton["cases"]["a hard case"] == {"poses": 5198, "error": None, "wrong": 5000, "nan": 198}
    assert [target["met"] for target in found["targets"]] == [True, False]
    assert ("most" in found["targets"][0], "least" in found["targets"][1]) == (True, True)


def test_targets_compare_with_pylinkage_in_the_same_run() -> None:
    rows = {
        "batch": row("batch", 10.0, 30.0),
        "batch, many": row("batch, many", 20.0, 40.0),
        "single": row("single", 2000.0, 7000.0),
        "pylinkage": row("pylinkage", 150.0, 690.0),
        "pylinkage, many": row("pylinkage, many", 160.0, 720.0),
        "pylinkage step": row("pylinkage step", 5000.0, 14000.0),
    }
    found = {target.what: target for target in targets(rows, 20_000.0)}
    ratio = found["pylinkage's time to ours: positions, 10,000 at once"]
    assert (ratio.measured, ratio.met) == (15.0, True)
    assert found["pylinkage's time to ours: with derivatives, 1,000,000 at once"].measured == 18.0
    assert found["positions, 1,000,000 to 10,000 at once"].measured == 2.0
    assert not found["positions, 1,000,000 to 10,000 at once"].met
    assert not found["with derivatives, one pose a call"].met
    assert found["press with derivatives, one pose a call"].measured == 20.0


def test_each_row_has_its_own_times(monkeypatch: pytest.MonkeyPatch) -> None:
    keys = ("batch", "batch, many", "single", "pylinkage", "pylinkage, many", "pylinkage step")
    nothing = Timed(lambda: None, 1)

    def unasked(question: Question) -> Points:
        raise AssertionError(question)

    rows = tuple(Entry(key, key, "here", unasked, nothing, nothing) for key in keys)
    scored = {unasked: dict.fromkeys((case.name for case in (EASY, *HARD)), Score(1, 0.0, 0, 0))}
    monkeypatch.setattr("linkanim.bench.result.entries", lambda: rows)
    monkeypatch.setattr("linkanim.bench.result._scores", lambda methods: scored)
    monkeypatch.setattr("linkanim.bench.result.press", lambda: nothing)
    timed: dict[tuple[str, int], float] = {
        (key, n): 10.0 * at + n + 1 for at, key in enumerate(keys) for n in (0, 2)
    }

    def nanoseconds(work: dict[tuple[str, int], Timed], **_: object) -> dict[tuple[str, int], float]:
        assert work.keys() == {*timed, ("press", 2)}
        return {**timed, ("press", 2): 39_000.0}

    monkeypatch.setattr("linkanim.bench.result.nanoseconds", nanoseconds)
    found = run()
    assert {(row.key, 0): row.position_ns for row in found.rows} | {
        (row.key, 2): row.derivatives_ns for row in found.rows
    } == timed
    assert [target.measured for target in found.targets if "press" in target.what] == [39.0]


def test_the_picture_is_written_whole(tmp_path: Path) -> None:
    path = drawing.draw(result(), tmp_path / "chart.png")
    assert pygame.image.load(path).get_size() == (1280, 1280)
    assert [file.name for file in tmp_path.iterdir()] == ["chart.png"]


def test_what_has_no_right_pose_is_not_among_the_hard_cases() -> None:
    easy, hard = drawing.panels(result())
    assert [point.label for point in easy.points] == ["batch by name", "newton 1 by name"]
    assert [point.label for point in hard.points] == ["batch by name"]
    assert easy.points[0].ours
    assert LOST.poses == 5198
