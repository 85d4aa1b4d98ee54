"""The table, the README's table, the JSON and the picture say what the run found."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import pygame
import pytest
from made_result import LOST, result, row

from linkanim.bench import command, drawing, report
from linkanim.bench.accuracy import Score
from linkanim.bench.cases import EASY, HARD
from linkanim.bench.entries import Entry, Timed
from linkanim.bench.question import Points, Question
from linkanim.bench.result import Target, run, targets
from linkanim.picture.scatter import ScatterTitles, scatter


def test_the_table_has_a_line_for_each_method_and_target() -> None:
    text = report.as_text(result())
    assert text.startswith("A processor, 2 cores, Python 3.11.7, numpy 2.4.6 with X86_V3")
    assert "batch by name" in text
    lines = {line.split("  ")[0]: line.split() for line in text.splitlines()}
    assert lines["batch by name"][3:] == ["9.3", "22.5", "3.0e-16", "8.5e-16", "0", "0"]
    assert lines["newton 1 by name"][4:] == ["1,600", "3.0e-16", "none", "right", "5,000", "198"]
    assert lines["positions"][1:] == ["9.31", "ns", "≤", "15", "ns", "met"]
    assert lines["times faster"][2:] == ["9", "×", "≥", "10", "×", "missed"]


# A tenth of a nanosecond below a hundred, three digits from there on.
@pytest.mark.parametrize(
    ("nanos", "told"), [(99.94, "99.9"), (100.0, "100"), (150.4, "150"), (1234.0, "1,230")]
)
def test_times_have_three_digits(nanos: float, told: str) -> None:
    made = replace(result(), rows=(row("batch", nanos),))
    assert report.lines(made)[1][1] == told


def test_columns_are_aligned() -> None:
    assert report.columns([("a", "bb"), ("ccc", "d")]) == "a    bb\nccc   d"


def test_the_readmes_table_is_markdown_with_its_machine() -> None:
    head, rule, *body = report.as_markdown(result()).splitlines()
    assert head == f"| {' | '.join(report.TITLES)} |"
    assert rule.count("---:") == len(report.TITLES) - 1
    assert body[0] == "| batch by name | 9.3 | 22.5 | 3.0e-16 | 8.5e-16 | 0 | 0 |"
    assert body[-1].endswith("numpy 2.4.6 with X86_V3, one thread.")
    assert "of 5,198 hard poses" in body[-1]


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
    assert (found["targets"][0]["most"], found["targets"][1]["least"]) == (15.0, 10.0)
    assert '"unit": "×"' in report.as_json(result())
    assert report.as_json(result()).startswith('{\n  "machine": {\n    "cpu"')


def test_a_figure_that_is_none_is_refused_rather_than_written_as_no_json() -> None:
    made = replace(result(), rows=(row("batch", math.nan),))
    with pytest.raises(ValueError, match="not JSON compliant"):
        report.as_json(made)
    with pytest.raises(ValueError, match="not JSON compliant"):
        command._json({"ns": math.nan})


# On the bound a target is met, past it missed, and without a figure missed, too.
@pytest.mark.parametrize(
    ("measured", "least", "met"),
    [
        (15.0, False, True),
        (15.1, False, False),
        (15.0, True, True),
        (14.9, True, False),
        (math.nan, False, False),
        (math.nan, True, False),
    ],
)
def test_a_target_is_met_up_to_its_bound(measured: float, least: bool, met: bool) -> None:
    assert Target("a figure", measured, 15.0, "ns", least=least).met == met


# What each target tells of the rows below, and its bound.
TARGETS = {
    "positions, 10,000 at once": (10.0, "≤", 15.0, "ns"),
    "with derivatives, 10,000 at once": (32.0, "≤", 35.0, "ns"),
    "positions, 1,000,000 to 10,000 at once": (2.0, "≤", 1.6, "×"),
    "with derivatives, 1,000,000 to 10,000 at once": (1.25, "≤", 1.6, "×"),
    "positions, one pose a call": (2.0, "≤", 2.5, "µs"),
    "with derivatives, one pose a call": (8.0, "≤", 6.0, "µs"),
    "press with derivatives, one pose a call": (20.0, "≤", 40.0, "µs"),
    "pylinkage's time to ours: positions, 10,000 at once": (15.0, "≥", 10.0, "×"),
    "pylinkage's time to ours: with derivatives, 10,000 at once": (21.5, "≥", 20.0, "×"),
    "pylinkage's time to ours: positions, 1,000,000 at once": (8.0, "≥", 10.0, "×"),
    "pylinkage's time to ours: with derivatives, 1,000,000 at once": (18.0, "≥", 12.0, "×"),
    "pylinkage's time to ours: positions, one pose a call": (2.5, "≥", 2.0, "×"),
    "pylinkage's time to ours: with derivatives, one pose a call": (1.75, "≥", 2.0, "×"),
}


def test_each_target_has_its_figure_and_its_bound() -> None:
    rows = {
        "batch": row("batch", 10.0, 32.0),
        "batch, many": row("batch, many", 20.0, 40.0),
        "single": row("single", 2000.0, 8000.0),
        "pylinkage": row("pylinkage", 150.0, 688.0),
        "pylinkage, many": row("pylinkage, many", 160.0, 720.0),
        "pylinkage step": row("pylinkage step", 5000.0, 14000.0),
    }
    found = targets(rows, 20_000.0)
    told = {
        target.what: (target.measured, "≥" if target.least else "≤", target.bound, target.unit)
        for target in found
    }
    assert told == TARGETS


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


def test_the_share_of_lost_poses_stands_beside_the_name() -> None:
    some = Score(5000, 1e-9, 1000, 250)
    _, hard = drawing.panels(replace(result(), rows=(row("circles", 20.0, hard=some), row("batch", 10.0))))
    assert [point.label for point in hard.points] == ["circles by name (25 %)", "batch by name"]


def test_no_error_at_all_has_a_place_on_the_scale() -> None:
    exact = replace(row("batch", 10.0), easy=Score(360, 0.0, 0, 0))
    easy, _ = drawing.panels(replace(result(), rows=(exact,)))
    assert easy.points[0].y == 1e-17


def test_the_pictures_lie_one_below_the_other(tmp_path: Path) -> None:
    pictures = list(drawing.panels(result()))
    both = pygame.image.load(drawing.draw_pictures(pictures, tmp_path / "both.png"))
    for number, picture in enumerate(pictures):
        titles = ScatterTitles(picture.title, picture.across, picture.up)
        alone = scatter(picture.points, titles, size=(1280, 640))
        part = both.subsurface((0, 640 * number, 1280, 640))
        assert pygame.image.tobytes(part, "RGB") == pygame.image.tobytes(alone, "RGB")
