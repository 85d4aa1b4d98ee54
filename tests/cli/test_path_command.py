"""`linkanim path`: scene files that run, the table and the JSON beside them, and how it ends."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import linkanim
from linkanim.cli import main

TURN = np.linspace(0, 2 * np.pi, 24, endpoint=False)
OVAL = "\n".join(f"{30 * np.cos(t) + 4 * np.cos(2 * t)},{12 * np.sin(t)}" for t in TURN)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "oval.csv").write_text(OVAL)
    return tmp_path


@pytest.fixture(scope="module")
def answers() -> list[Any]:
    """What the first search for the oval found."""
    return []


@pytest.fixture
def found_once(answers: list[Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """Have one search serve all tests of what is done with its answers."""
    search = linkanim.path

    def once(*points: Any, count: int, **options: Any) -> Any:
        answers.extend([] if answers else search(*points, count=2, **options))
        return answers[:count]

    monkeypatch.setattr("linkanim.cli.commands.path.path", once)


def printed_json(capsys: pytest.CaptureFixture[str], *words: str) -> list[dict[str, Any]]:
    assert main(["path", *words, "--json"]) == 0
    found: list[dict[str, Any]] = json.loads(capsys.readouterr().out)
    return found


@pytest.mark.slow
def test_each_answer_is_a_scene_that_runs_along_the_curve(
    here: Path, capsys: pytest.CaptureFixture[str], found_once: None
) -> None:
    found = printed_json(capsys, "oval.csv", "-o", "oval.toml", "--count", "2")
    assert [row["file"] for row in found] == ["oval.toml", "oval-2.toml"]
    first, exact = found
    assert first["transmission_angle"] > np.radians(29.9)
    assert exact["rms"] <= first["rms"] <= 2 * exact["rms"]
    points = np.array([[float(cell) for cell in line.split(",")] for line in OVAL.splitlines()])
    assert any(row["front"] for row in found)
    for row in found:
        scene = linkanim.load(here / row["file"])
        way = scene.cycle(7200).position[scene.trace[0]]
        off = np.sqrt(((way[:, None] - points) ** 2).sum(axis=2)).min(axis=0)
        assert row["rms"] == pytest.approx(np.sqrt((off**2).mean()), rel=0.05, abs=0.01)
        assert row["rms_percent"] == pytest.approx(100 * row["rms"] / np.hypot(*np.ptp(points, axis=0)))
        assert row["class"] == scene.info.class_name
        assert row["size"] == pytest.approx(row["largest_link"] / np.hypot(*np.ptp(points, axis=0)))
        assert row["room"] > row["size"]
        assert row["transmission_angle"] == min(scene.info.transmission_angle or ())
        assert scene.source == "linkanim path for oval.csv"


# two answers have four cognates: of those asked for with them none is there, one, all
@pytest.mark.slow
@pytest.mark.parametrize(
    ("kept", "said"), [(0, "4 of 4 cognates do not"), (1, "3 of 4 cognates do not"), (4, "")]
)
def test_cognates_that_do_not_keep_to_what_is_asked_for_are_counted(
    kept: int,
    said: str,
    here: Path,
    capsys: pytest.CaptureFixture[str],
    found_once: None,
    answers: list[Any],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert main(["path", "oval.csv", "--count", "2"]) == 0
    capsys.readouterr()
    found = [replace(fit, most_exact=None) for fit in answers]
    found += [replace(found[0], cognate=True)] * kept
    monkeypatch.setattr("linkanim.cli.commands.path.path", lambda *_, **__: found)
    assert main(["path", "oval.csv", "--cognates"]) == 0
    printed = capsys.readouterr()
    assert len(printed.out.splitlines()) == 3 + kept
    assert printed.err.startswith(said)
    assert bool(printed.err) == bool(said)


@pytest.mark.slow
def test_the_table_has_a_line_for_each_answer_and_a_shorter_one_leaves_no_old_file(
    here: Path, capsys: pytest.CaptureFixture[str], found_once: None
) -> None:
    assert main(["path", "oval.csv", "--count", "2"]) == 0
    titles, *rows = capsys.readouterr().out.splitlines()
    assert titles.split("  ")[0] == "file"
    assert [row.split()[0] for row in rows] == ["oval.toml", "oval-2.toml"]
    # what an older run wrote is replaced, and nothing else
    assert main(["path", "oval.csv", "--count", "1"]) == 0
    assert sorted(path.name for path in here.glob("*.toml")) == ["oval.toml"]
    (here / "oval.toml").write_text("mine")
    capsys.readouterr()
    assert main(["path", "oval.csv", "--count", "1"]) == 2
    assert "was changed after linkanim wrote it" in capsys.readouterr().err
    assert (here / "oval.toml").read_text() == "mine"


# what the most exact answer is: its deviation, angle and size beside the first's; and what it costs
@pytest.mark.slow
@pytest.mark.parametrize(
    ("off", "angle", "size", "said"),
    [
        (0.5, 0.02, 1.0, "needs a transmission angle of 1.1 deg; "),
        (0.5, 1.3, 4.0, "needs links of "),
        (1.0, 0.02, 4.0, ""),
        (0.9, 0.65, 1.0, ""),
    ],
    ids=["a bad angle", "long links", "as exact", "hardly anything"],
)
def test_what_exactness_costs_is_one_sentence(
    off: float,
    angle: float,
    size: float,
    said: str,
    here: Path,
    capsys: pytest.CaptureFixture[str],
    found_once: None,
    answers: list[Any],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert main(["path", "oval.csv", "--count", "2"]) == 0
    capsys.readouterr()
    first = replace(answers[0], transmission_angle=0.65)
    exact = replace(first, rms=off * first.rms, transmission_angle=angle, size=size * first.size)
    found = [replace(first, most_exact=exact)]
    monkeypatch.setattr("linkanim.cli.commands.path.path", lambda *_, **__: found)
    assert main(["path", "oval.csv"]) == 0
    printed = capsys.readouterr().err
    assert (said in printed) if said else not printed


@pytest.mark.slow
def test_a_front_is_written_as_a_table(
    here: Path, capsys: pytest.CaptureFixture[str], found_once: None
) -> None:
    (first, *_) = printed_json(capsys, "oval.csv", "--count", "2", "--front", "front.csv")
    titles, *rows = (here / "front.csv").read_text().splitlines()
    names = titles.split(",")
    assert names[:5] == ["rms_percent", "largest_percent", "size", "room", "transmission_angle_deg"]
    table = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    assert table.shape == (len(rows), len(names))
    assert len(rows) > 2
    assert table[:, 0].min() <= 1.01 * first["rms_percent"]
    assert table[:, 2].min() < first["size"]


@pytest.mark.long
@pytest.mark.slow
def test_what_rounding_costs_is_printed(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["path", "oval.csv", "--round", "1 mm", "--count", "1", "--json"]) == 0
    printed = capsys.readouterr()
    assert "rounding takes the best from " in printed.err
    (row,) = json.loads(printed.out)
    assert all(value == round(value) for value in row["parameters"].values() if isinstance(value, float))
    assert row["rms_before_rounding"] < row["rms"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["none.csv"], "none.csv: no such file"),
        (["oval.csv", "--timing", "column"], "oval.csv: has no third column"),
        (["oval.csv", "--timing", "20"], '--timing: "20" has no unit'),
        (["oval.csv", "--box", "1,2,3"], '"1,2,3" is not X,Y,W,H'),
        (["oval.csv", "--box", "0,0,0,9"], "nothing fits in it"),
        (["oval.csv", "--box", "0,0,9,9", "1,1,1,1", "2,2,2,2"], "3 boxes are given"),
        (["oval.csv", "--round", "-1 mm"], "no length to round to"),
        (["oval.csv", "--prefer", "small"], "--prefer"),
        (["oval.csv", "--front", "front.toml"], "use one of .csv"),
        (["oval.csv", "--front", "oval.csv"], "oval.csv"),
        (["oval.csv", "-o", "oval.gif"], "use one of .toml"),
        (["oval.csv", "-o", "nowhere/oval.toml"], "there is no folder nowhere"),
        (["oval.csv", "--kind", "slider-crank", "--cognates"], "has no cognates"),
        (["oval.csv", "--largest", "0"], "not a number greater than zero"),
    ],
)
def test_bad_input_is_one_line(
    words: list[str], said: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["path", *words]) == 2
    printed = capsys.readouterr()
    assert said in printed.err
    assert printed.err.count("\n") == 1
    assert printed.out == ""
    assert list(here.glob("*.toml")) == []


@pytest.mark.slow
def test_given_pivots_are_those_of_the_answers_the_crank_s_first(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for words, names in ((["-40,-30"], ("x", "y")), (["-40,-30", "55,-40"], ("x", "y", "x4", "y4"))):
        for row in printed_json(capsys, "oval.csv", "--count", "2", "--pivots", *words):
            given = [row["parameters"][name] for name in names]
            assert given == [float(number) for word in words for number in word.split(",")]
    assert main(["path", "oval.csv", "--kind", "slider-crank", "--pivots", "0,0", "1,1"]) == 2
    assert "a slider-crank has 1 fixed pins; 2 are given" in capsys.readouterr().err
