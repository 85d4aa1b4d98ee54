"""`linkanim info` and `linkanim scenes`."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import pytest

import linkanim
from linkanim.cli import main
from linkanim.scenes import chapter_of, chapters
from linkanim.scenes.editing import other_return
from linkanim.scenes.toml import save
from linkanim.units import significant

KEYS = {
    "class",
    "input_range",
    "toggles",
    "change_points",
    "true_period",
    "period_seconds",
    "transmission_angle",
}


@pytest.mark.parametrize("name", linkanim.names())
@pytest.mark.sampled
def test_info_of_every_scene_is_strict_json_with_the_agreed_keys(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["info", name, "--json"]) == 0
    printed = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert set(printed) >= KEYS
    assert printed["scene"] == name
    low, high = printed["input_range"]
    assert low < high
    scene = linkanim.load(name)
    assert printed["true_period"] == round(scene.period / (2 * math.pi))
    assert printed["period_seconds"] == pytest.approx(
        scene.period / abs(scene.linkage.drive.speed), rel=1e-12
    )


def test_json_tells_names_as_they_are_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    save(replace(linkanim.load("kite"), name="Größe"), Path())
    assert main(["info", "Größe.toml", "--json"]) == 0
    assert '"scene": "Größe"' in capsys.readouterr().out


# a slider has a stroke; a four-bar has none, and says nothing of it
@pytest.mark.parametrize(("name", "has"), [("slider-crank", True), ("press", True), ("crank-rocker", False)])
def test_stroke_and_time_ratio_are_told_of_sliders(
    name: str, has: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["info", name, "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert ("stroke" in printed, "swing" in printed) == (has, not has)
    assert "time_ratio" in printed


def test_the_slider_cranks_stroke_and_time_ratio_are_those_of_the_closed_form(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["info", "slider-crank", "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    lengths = linkanim.load("slider-crank").document["slider-crank"]
    crank, rod, offset = lengths["crank"], lengths["rod"], lengths["offset"]
    far, near = rod + crank, rod - crank
    assert printed["stroke"] == pytest.approx(
        math.sqrt(far**2 - offset**2) - math.sqrt(near**2 - offset**2), rel=1e-14
    )
    lag = math.asin(offset / near) - math.asin(offset / far)
    ratio = (math.pi + abs(lag)) / (math.pi - abs(lag))
    assert printed["time_ratio"] == pytest.approx(ratio, rel=1e-14)


def test_what_a_period_asks_of_the_input_is_told_where_there_is_force(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["info", "press", "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    demand_of_press = linkanim.load("press").info.demand
    assert demand_of_press is not None
    assert (printed["work_per_period"], printed["peak_torque"], printed["mean_torque"]) == demand_of_press[:3]
    assert main(["info", "press"]) == 0
    assert f"work per period     {demand_of_press.work:.6g} J" in capsys.readouterr().out.splitlines()
    assert main(["info", "crank-rocker", "--json"]) == 0
    assert "work_per_period" not in json.loads(capsys.readouterr().out)


def test_only_of_an_input_that_swings_it_is_told_how_it_returns(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    same = save(replace(other_return(linkanim.load("double-rocker")), name="same"), tmp_path)
    told = []
    for scene in ("crank-rocker", "double-rocker", str(same)):
        assert main(["info", scene, "--json"]) == 0
        told.append(json.loads(capsys.readouterr().out).get("returns"))
    assert told == [None, "other", "same"]


def test_the_words_are_a_label_and_a_value_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["info", "crank-rocker"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["scene", "crank-rocker:", "Crank-rocker"]
    assert len({len(line) - len(line.split("  ", 1)[1].lstrip()) for line in lines}) == 1


def test_info_says_what_to_look_at(capsys: pytest.CaptureFixture[str]) -> None:
    scene = linkanim.load("hoecken")
    assert main(["info", "hoecken"]) == 0
    assert f"watch for           {scene.look_at}" in capsys.readouterr().out.splitlines()
    assert main(["info", "hoecken", "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert (printed["chapter"], printed["look_at"]) == ("four-bars", scene.look_at)


def listed(capsys: pytest.CaptureFixture[str], *word: str) -> list[str]:
    """Return the lines that `linkanim scenes` prints, chapters' headings among them."""
    assert main(["scenes", *word]) == 0
    return capsys.readouterr().out.splitlines()


def test_scenes_is_a_line_for_each_with_its_name_first(capsys: pytest.CaptureFixture[str]) -> None:
    lines = [line for line in listed(capsys) if not line.startswith("# ")]
    assert tuple(line.split()[0] for line in lines) == linkanim.names()
    assert all(len(line.split()) > 1 for line in lines)


def test_scenes_stand_under_their_chapters(capsys: pytest.CaptureFixture[str]) -> None:
    lines = listed(capsys)
    heads = [line.removeprefix("# ") for line in lines if line.startswith("# ")]
    assert heads == list(chapters())
    assert lines[lines.index("# six-bars and more") + 1].split()[0] == chapters()["six-bars and more"][0]


def test_listing_all_scenes_solves_none(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr("linkanim.cli.commands.scenes.load")
    assert len(listed(capsys)) == len(linkanim.names()) + len(chapters())


# one that only the title, the name, the class or the chapter has
@pytest.mark.parametrize(
    ("word", "name"),
    [
        ("punch", "press"),
        ("in-OUT", "triple-rocker-in-out"),
        ("geared five-bar with", "press"),
        ("on purpose", "kite"),
    ],
)
def test_a_word_chooses_scenes(word: str, name: str, capsys: pytest.CaptureFixture[str]) -> None:
    lines = listed(capsys, word)
    assert name in [line.split()[0] for line in lines]
    assert f"# {chapter_of(name)}" in lines
    assert len(lines) < len(linkanim.names())


def test_a_word_that_no_scene_has_is_answered_with_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["scenes", "slidrs"]) == 2
    assert 'did you mean "sliders"?' in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "words"), [("crank-rocker", "one drive period, 3 s"), ("kite", "2 drive periods, 3 s")]
)
def test_the_true_period_is_told_in_drive_periods(
    name: str, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["info", name]) == 0
    assert words in capsys.readouterr().out


def test_info_counts_links_and_joints_and_tells_the_rockers_swing_and_time_ratio(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["info", "crank-rocker", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["link_count"], told["joint_count"], told["mobility"]) == (4, 4, 1)
    ground, crank, coupler, rocker = 100.0, 50.0, 85.0, 80.0

    def at_ground(reach: float, beside: float) -> float:
        """Return the angle at the ground's end between it and a side of a triangle, by its three sides."""
        return math.acos((ground**2 + beside**2 - reach**2) / (2 * ground * beside))

    far, near = coupler + crank, coupler - crank
    assert told["swing"] == pytest.approx(at_ground(far, rocker) - at_ground(near, rocker), rel=1e-9)
    lag = at_ground(rocker, near) - at_ground(rocker, far)
    assert told["time_ratio"] == pytest.approx((math.pi + lag) / (math.pi - lag), rel=1e-9)


# A geared pair is a mesh between two cranks; a driving cylinder is two links and three joints.
@pytest.mark.parametrize(
    ("name", "counts"),
    [("press", (7, 8, 1)), ("andrews", (8, 10, 1)), ("cardan-gears", (3, 2, 1)), ("excavator", (4, 4, 1))],
)
def test_links_and_joints_are_counted_as_gruebler_does(name: str, counts: tuple[int, int, int]) -> None:
    assert linkanim.load(name).info.counts == counts


@pytest.mark.parametrize("name", ["watt-line", "oscillating-cylinder"])
def test_what_it_tells_has_true_minus_signs(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["info", name]) == 0
    printed = capsys.readouterr().out
    assert not re.search(r"(?<![\w])-\d", printed)
    assert name != "watt-line" or "swings −69.2°…32.33°" in printed


def test_a_tolerance_is_a_table_an_object_and_a_chart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["info", "slider-crank", "--tolerance", "0.1 mm", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["tolerance"]
    assert found["by"] == 0.1
    stroke = found["quantities"][-1]
    assert (stroke["of"], stroke["most_by"], stroke["worst_phase"]) == ("stroke", "crank", None)
    for chart in ("off.svg", "off.csv"):
        assert main(["info", "slider-crank", "--tolerance", "0.01 cm", "--chart", chart]) == 0
        printed = capsys.readouterr().out
        assert "each of 5 lengths off by 0.1 mm at the most" in printed
        assert re.search(rf"^stroke +{significant(stroke['worst'], 3)} mm +- ", printed, re.M)
    head, *rows = (tmp_path / "off.csv").read_text().splitlines()
    assert head == "phase_deg,all,crank,rod,offset,coupler_point.0,coupler_point.1"
    worst = max(float(row.split(",")[1]) for row in rows)
    assert worst == pytest.approx(found["quantities"][0]["worst"], rel=1e-9)
    assert "How far P may be off" in (tmp_path / "off.svg").read_text()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--tolerance", "0"], "give a length above zero"),
        (["--tolerance", "1 rpm"], "rpm"),
        (["--chart", "off.svg"], "say by how much each length is"),
        (["--tolerance", "0.1 mm", "--chart", "off.gif"], "off.gif"),
    ],
)
def test_a_tolerance_that_cannot_be_is_one_sentence(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["info", "slider-crank", *words]) == 2
    printed = capsys.readouterr().err
    assert said in printed
    assert printed.count("\n") == 1
