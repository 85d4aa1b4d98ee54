"""The table, the manual's table, the JSON and the picture say what the run found."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from importlib.resources import files
from math import inf
from pathlib import Path

import pytest
from made_result import result, row

from linkanim.bench import drawing
from linkanim.bench import result as report
from linkanim.bench.methods import Entry, Timed, batch
from linkanim.bench.questions import FOUR_BAR, MECHANISMS, CaseSet
from linkanim.bench.result import run
from linkanim.errors import BadInput
from linkanim.export import columns


def test_the_table_has_a_line_for_each_method_of_each_mechanism() -> None:
    text = result().as_text()
    assert text.startswith("A processor, 2 cores, Python 3.11.7, numpy 2.4.6 with X86_V3")
    four_bar, press = text.index("\nfour-bar\n"), text.index("\npress\n")
    lines = {line.split("  ")[0]: line.split() for line in text[four_bar:press].splitlines()}
    easy = ["3.0e-16,", "4.0e-16,", "5.0e-16"]
    # Beyond the size of a link an error means nothing.
    assert lines["batch by name"][3:] == ["9.3", "22.5", *easy, "8.5e-16,", ">", "1,", ">", "1", "0", "0"]
    assert lines["newton 1 by name"][4:] == ["1,600", *easy, "none", "right", "5,000", "198"]
    assert "batch by name  20.0" in " ".join(text[press:].split()) or "1.0e-12" in text[press:]


# A tenth of a nanosecond below a hundred, three digits from there on.
@pytest.mark.parametrize(
    ("nanos", "written"), [(99.94, "99.9"), (100.0, "100"), (150.4, "150"), (1234.0, "1,230")]
)
def test_times_have_three_digits(nanos: float, written: str) -> None:
    made = replace(result(), rows=(row("batch", nanos),))
    assert f"| batch by name | {written} |" in made.as_markdown()


def test_columns_are_aligned() -> None:
    assert columns([("a", "bb"), ("ccc", "d")]) == "a    bb\nccc   d"


def test_the_manual_s_table_is_markdown_with_its_machine() -> None:
    head, rule, *body = result().as_markdown().splitlines()
    assert head == f"| {' | '.join(report.TITLES)} |"
    assert rule.count("---:") == len(report.TITLES) - 1
    assert body[0].startswith("| **four-bar** |")
    assert body[3].startswith("| **press** |")
    assert {line.count("|") for line in body if line.startswith("|")} == {len(report.TITLES) + 1}
    assert "of 5,198 (four-bar), 5,198 (press) hard poses" in body[-1]
    assert " Measured on 2026-11-28 on A processor, " in body[-1]
    assert body[-1].endswith("numpy 2.4.6 with X86_V3, one thread.")


def test_the_manual_shows_such_a_table_and_counts_the_hard_poses() -> None:
    page = (files("linkanim") / "manual" / "measurements.md").read_text(encoding="utf-8")
    shown = page.partition("<!-- bench -->\n")[2].partition("<!-- /bench -->")[0].splitlines()
    assert shown[:2] == result().as_markdown().splitlines()[:2]
    for mechanism in MECHANISMS:
        assert any(line.startswith(f"| **{mechanism.name}** |") for line in shown)
        assert f"{sum(len(case.inputs) for case in mechanism.hard):,} ({mechanism.name})" in shown[-1]


def test_beside_what_is_measured_stands_what_the_manual_s_table_has_of_other_methods() -> None:
    found = result().with_recorded()
    assert found.rows[: len(result().rows)] == result().rows
    recorded = {(one.mechanism, one.key): one for one in found.rows[len(result().rows) :]}
    assert {mechanism for mechanism, _ in recorded} == {"four-bar", "press"}, "those that are measured"
    assert not [name for _, name in recorded if "linkanim" in name]
    circles, newton = recorded["four-bar", "circle intersection"], recorded["press", "Newton, 1 iteration"]
    page = (files("linkanim") / "manual" / "measurements.md").read_text(encoding="utf-8")
    # as the manual has it, but for the name
    assert replace(result(), rows=(circles,)).as_markdown().splitlines()[3] == next(
        line for line in page.splitlines() if line.startswith("| circle intersection |")
    ).replace("circle intersection", "circle intersection (recorded)")
    assert newton.ns_derivatives is not None
    assert circles.hard.velocity_error == inf
    assert "recorded was measured once" in found.as_text()
    assert "recorded" not in result().as_text()


def test_each_method_of_the_manual_s_table_has_a_colour_of_its_own_in_the_chart() -> None:
    page = (files("linkanim") / "manual" / "measurements.md").read_text(encoding="utf-8")
    shown = page.partition("<!-- bench -->\n")[2].partition("**slider-crank**")[0].splitlines()
    rows = [line for line in shown if re.match(r"\| (?!method)\w", line) and "1,000,000 at once" not in line]
    assert 1 < len(rows) <= len(drawing.COLOURS) == len(set(drawing.COLOURS))


def test_the_json_is_strict_and_whole() -> None:
    found = json.loads(result().as_json(), parse_constant=pytest.fail)
    assert list(found) == ["machine", "rows", "further"]
    batch_row, newton, press = found["rows"]
    assert (batch_row["ns_position"], batch_row["ns_derivatives"]) == (9.31, 22.5)
    assert press["mechanism"] == "press"
    rates = {"velocity_error": None, "acceleration_error": 2.0}
    assert batch_row["hard"] == {"poses": 5198, "error": 8.5e-16, **rates, "wrong": 0, "nan": 0, "at": []}
    assert newton["ns_derivatives"] is None
    assert newton["cases"]["a hard case"]["error"] is None


@pytest.mark.slow
def test_a_run_asks_every_method_of_a_mechanism_every_case_and_times_it() -> None:
    easy = replace(FOUR_BAR.easy, inputs=FOUR_BAR.easy.inputs[:3])
    short = CaseSet("four-bar", easy, (replace(easy, name="as hard"),))
    keys = ("batch", "batch, many", "single", "pylinkage", "pylinkage, many", "pylinkage step")

    def entries(mechanism: CaseSet) -> list[Entry]:
        nothing = Timed(lambda: None, 1)
        return [Entry(mechanism.name, key, key, "here", batch, nothing, nothing) for key in keys]

    found = run(mechanisms=(short,), rows=entries)
    assert [row.key for row in found.rows] == list(keys)
    for measured in found.rows:
        assert list(measured.cases) == ["easy cycle", "as hard"]
        assert (measured.easy.poses, measured.hard.poses) == (3, 3)
        assert measured.easy.error < 1e-15
        assert measured.ns_derivatives is not None


def test_the_picture_is_written_whole(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    from PIL import Image

    path = drawing.draw(result(), tmp_path / "chart.png")
    with Image.open(path) as picture:
        assert picture.size == drawing.SIZE
    assert {file.name for file in tmp_path.iterdir()} == {"chart.png", ".linkanim-chart.png.json"}
    path.write_bytes(b"mine")
    with pytest.raises(BadInput, match="was changed after linkanim wrote it"):
        drawing.draw(result(), path)
    assert path.read_bytes() == b"mine"
