"""`linkanim solve`: published values, strict JSON, sweeps, tables, files."""

from __future__ import annotations

import csv
import json
import math
import re
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

import linkanim
from linkanim.cli import main

Solve = Callable[..., str]


@pytest.fixture
def solve(capsys: pytest.CaptureFixture[str]) -> Solve:
    """Return a function that runs `linkanim solve` and gives back what it printed."""

    def run(*words: str) -> str:
        assert main(["solve", *words]) == 0
        printed = capsys.readouterr()
        assert printed.err == ""
        return printed.out

    return run


@pytest.fixture
def solved(solve: Solve) -> Callable[..., Any]:
    """Return a function that runs `linkanim solve --json` and gives back what it read."""

    def refuse(name: str) -> None:
        raise AssertionError(f"{name} is not strict JSON")

    return lambda *words: json.loads(solve(*words, "--json"), parse_constant=refuse)


# Term report on a six-bar punch press, tables 3.1 and 3.2, at 87 degrees and 10 rad/s: (body, key, value,
# half a unit of the last printed digit); the slider's in metres.
PUBLISHED = [
    ("3", "angular_velocity", 3.3271, 5e-5),
    ("4", "angular_velocity", -1.2005, 5e-5),
    ("6", "angular_velocity", -5.4143, 5e-5),
    ("5", "velocity", -132.8, 5e-2),
    ("3", "angular_acceleration", 12.7419, 5e-5),
    ("4", "angular_acceleration", -11.3763, 5e-5),
    ("6", "angular_acceleration", -14.2372, 5e-5),
    ("5", "acceleration", -2770.8, 5e-2),
]


@pytest.mark.parametrize(("body", "key", "value", "half_digit"), PUBLISHED)
def test_the_press_has_its_published_values(
    solved: Callable[..., Any], body: str, key: str, value: float, half_digit: float
) -> None:
    pose = solved("press", "--angle", "87 deg", "--speed", "10 rad/s")
    assert pose["bodies"][body][key] == pytest.approx(value, abs=half_digit, rel=0)


def test_one_pose_is_one_object_of_the_agreed_form(solved: Callable[..., Any]) -> None:
    pose = solved("press", "--angle", "87 deg", "--speed", "10 rad/s")
    head = ["scene", "angle", "coordinate", "phase", "speed", "acceleration", "length_unit"]
    whole = ["input", "transmission_angle", "mechanical_advantage"]
    forces = ["reactions", "guides", "gears", "ground"]
    assert list(pose) == [*head, "joints", "bodies", "springs", "dampers", *whole, *forces]
    assert {key: pose[key] for key in head} == {
        "scene": "press",
        "angle": math.radians(87),
        "coordinate": math.radians(87),
        "phase": pytest.approx(math.radians(87), abs=1e-15),
        "speed": 10.0,
        "acceleration": 0.0,
        "length_unit": "mm",
    }
    assert set(pose["joints"]) == {"O2", "O7", "G", "S", "A", "B", "C", "D", "H"}
    vectors, path = (
        ["position", "velocity", "acceleration"],
        {
            "normal_acceleration",
            "tangential_acceleration",
            "curvature_radius",
        },
    )
    assert set(pose["joints"]["O2"]) == set(vectors)
    assert set(pose["joints"]["B"]) == {*vectors, *path, "transmission_angle"}
    assert [len(pose["joints"]["B"][key]) for key in vectors] == [2, 2, 2]
    turning = {"angle", "angular_velocity", "angular_acceleration", "coefficients", "pole"}
    assert set(pose["bodies"]["3"]) == {*turning, "com"}
    assert set(pose["bodies"]["3"]["com"]) == {*vectors, *path}
    assert set(pose["bodies"]["5"]) == {"travel", "velocity", "acceleration", "coefficients"}
    strut = {"length", "rate", "force", "direction", "direction_rate"}
    assert set(pose["springs"]["return"]) == set(pose["dampers"]["cushion"]) == strut
    assert set(pose["input"]) == {"angular_velocity", "torque"}


def test_the_json_is_what_the_library_solves(solved: Callable[..., Any]) -> None:
    pose = solved("press", "--angle", "1.25 rad", "--speed", "-3 rad/s", "--acceleration", "2 rad/s^2")
    motion = linkanim.load("press").solve(angle=[1.25], speed=-3.0, acceleration=2.0)
    assert pose["joints"]["B"]["acceleration"] == motion.acceleration["B"][0].tolist()
    assert pose["bodies"]["3"]["coefficients"] == [float(part[0]) for part in motion.coefficient["3"]]
    assert pose["springs"]["return"]["force"] == motion.spring["return"].force[0]


# a value that begins with a minus sign is not an option, with or without a space or an equals sign
@pytest.mark.parametrize("words", [["--angle", "-30 deg"], ["--angle", "-30deg"], ["--angle=-30 deg"]])
def test_negative_values_are_values(solved: Callable[..., Any], words: list[str]) -> None:
    pose = solved("crank-rocker", *words, "--speed", "-10rpm", "--acceleration", "-.5 rad/s^2")
    assert pose["angle"] == -math.pi / 6
    assert pose["speed"] == pytest.approx(-math.pi / 3, rel=1e-15)
    assert pose["acceleration"] == -0.5


def test_without_a_speed_it_is_the_scenes(solved: Callable[..., Any]) -> None:
    assert (
        solved("crank-rocker", "--angle", "0 deg")["speed"]
        == linkanim.load("crank-rocker").linkage.drive.speed
    )


def nulls(node: object) -> int:
    if isinstance(node, dict):
        return sum(map(nulls, node.values()))
    if isinstance(node, list):
        return sum(map(nulls, node))
    return int(node is None)


def test_at_a_limit_what_is_unbounded_is_null_and_positions_are_not(solved: Callable[..., Any]) -> None:
    pose = solved("double-rocker", "--phase", "0 deg")
    limit = linkanim.load("double-rocker").info.input_range
    assert pose["angle"] == pytest.approx(min(limit, key=lambda angle: abs(angle - pose["angle"])), abs=1e-15)
    assert nulls([joint["position"] for joint in pose["joints"].values()]) == 0
    assert pose["bodies"]["coupler"]["coefficients"] == [None, None]


UNTOLD = """
length_unit = "mm"
ground = { O = [0, 0], Q = [50, 0] }
joints.A = { crank = "O", length = 50 }
joints.E = { from = ["O", "Q"], length = [40, 40], side = "left" }
bodies.crank = { joints = ["O", "A"] }
bodies.prop = { joints = ["O", "E"] }
springs.s = { between = ["A", "Q"] }
"""
"""A link that stands still, and a spring whose ends meet and of which no force is known."""


def test_what_has_no_value_is_left_out_and_what_is_unbounded_is_null(
    solved: Callable[..., Any], solve: Solve, tmp_path: Path
) -> None:
    file = str(tmp_path / "untold.toml")
    Path(file).write_text(UNTOLD, encoding="utf-8")
    first, second = solved(file, "--sweep", "0:30:30")
    assert "pole" not in first["bodies"]["prop"]
    assert first["bodies"]["crank"]["pole"] == [0.0, 0.0]
    assert first["mechanical_advantage"] is None
    assert {*first["springs"]["s"]} == {"length", "rate"}
    assert {*second["springs"]["s"]} == {"length", "rate", "direction", "direction_rate"}
    row, *_ = csv.DictReader(solve(file, "--sweep", "0:30:30", "--csv", "-").splitlines())
    assert row["bodies.prop.pole.x"] == row["springs.s.direction"] == row["springs.s.force"] == ""
    assert row["mechanical_advantage"] == "inf"
    assert "unbounded" in solve(file, "--angle", "0 deg")


def test_an_angle_out_of_reach_is_refused_with_the_range(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "double-rocker", "--angle", "180 deg"]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    low, high = (
        f"{math.degrees(limit):.6g} deg" for limit in linkanim.load("double-rocker").info.input_range
    )
    assert f"from {low} to {high}" in printed.err
    assert "180 deg" in printed.err
    assert printed.err.count("\n") == 1


# first:last:step, the degrees that come out; the last is in where it falls on a step, exactly in decimals
SWEEPS = [
    ("0:360:90", [0.0, 90.0, 180.0, 270.0, 360.0]),
    ("0:100:40", [0.0, 40.0, 80.0]),
    ("0:0.3:0.1", [0.0, 0.1, 0.2, 0.3]),
    ("-30:30:30", [-30.0, 0.0, 30.0]),
    ("90:-90:-90", [90.0, 0.0, -90.0]),
    ("5:5:1", [5.0]),
]


@pytest.mark.parametrize(("sweep", "degrees"), SWEEPS)
def test_a_sweep_goes_to_its_end(solved: Callable[..., Any], sweep: str, degrees: list[float]) -> None:
    found = solved("crank-rocker", "--sweep", sweep)
    assert [math.degrees(pose["angle"]) for pose in found] == pytest.approx(degrees, abs=1e-12)


def test_in_a_sweep_what_is_out_of_reach_is_a_row_of_nulls(solved: Callable[..., Any]) -> None:
    found = solved("double-rocker", "--sweep", "60:180:120")
    reached, beyond = (pose["joints"]["B"]["position"] for pose in found)
    assert nulls(reached) == 0
    assert beyond == [None, None]
    assert found[1]["angle"] == math.pi


def test_a_sweep_of_the_phase_goes_through_the_limits(solved: Callable[..., Any]) -> None:
    found = solved("double-rocker", "--sweep", "0:360:5", "--phase")
    assert [pose["phase"] for pose in found] == pytest.approx([math.radians(5 * k) for k in range(73)])
    points = [joint for pose in found for joint in pose["joints"].values()]
    assert nulls([[joint[key] for key in ("position", "velocity", "acceleration")] for joint in points]) == 0
    assert found[0]["joints"]["B"]["position"] == pytest.approx(
        found[-1]["joints"]["B"]["position"], rel=1e-12
    )


def test_body_angles_do_not_jump_in_a_sweep(solved: Callable[..., Any]) -> None:
    found = solved("drag-link", "--sweep", "0:720:5")
    angles = [pose["bodies"]["rocker"]["angle"] for pose in found]
    steps = [after - before for before, after in pairwise(angles)]
    assert max(map(abs, steps)) < 0.5
    assert angles[-1] - angles[0] == pytest.approx(4 * math.pi, rel=1e-12)


# a sweep that leaves the range, twice: what follows a gap begins anew
LEAVING = ["0:120:10", "-120:480:1", "120:-120:-1"]


@pytest.mark.parametrize("sweep", LEAVING)
def test_a_sweep_that_leaves_the_range_keeps_the_angles_of_what_is_in_it(
    solved: Callable[..., Any], sweep: str
) -> None:
    found = solved("double-rocker", "--sweep", sweep)
    reached = [pose["joints"]["B"]["position"] != [None, None] for pose in found]
    assert True in reached
    assert False in reached
    for pose, there in zip(found, reached, strict=True):
        for name, ends in (("crank", "O2 A"), ("coupler", "A B"), ("rocker", "O4 B")):
            output = pose["bodies"][name]["angle"]
            if not there:
                assert output is None
                continue
            (x0, y0), (x1, y1) = (pose["joints"][joint]["position"] for joint in ends.split())
            assert math.remainder(output - math.atan2(y1 - y0, x1 - x0), math.tau) == pytest.approx(
                0, abs=1e-12
            )
        assert (pose["phase"] is None) != there
        assert pose["angle"] is not None
    for before, after in pairwise(range(len(found))):
        if reached[before] and reached[after]:
            for name in ("crank", "coupler", "rocker"):
                step = found[after]["bodies"][name]["angle"] - found[before]["bodies"][name]["angle"]
                assert abs(step) < 1.2


def test_the_words_and_cells_of_what_is_out_of_reach_have_no_phase(solve: Solve) -> None:
    words = solve("double-rocker", "--sweep", "60:120:60").splitlines()
    _, reached, beyond = (re.split(r"\s{2,}", line.strip()) for line in words)
    assert "-" not in reached
    assert beyond[:2] == ["120", "-"]
    assert set(beyond[1:]) == {"-"}
    cells = solve("double-rocker", "--sweep", "60:120:60", "--csv", "-").splitlines()
    row = dict(zip(cells[0].split(","), cells[2].split(","), strict=True))
    assert row.pop("angle_deg") == "120.0"
    assert float(row.pop("angle")) == math.radians(120)
    assert float(row.pop("time")) == pytest.approx(math.radians(60) / (math.pi / 2))
    assert {name: value for name, value in row.items() if value and ".O" not in name} == {}


def test_csv_holds_the_numbers_of_the_json(
    solve: Solve, solved: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert solve("press", "--sweep", "0:350:10", "--csv", "press.csv") == ""
    with Path("press.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    found = solved("press", "--sweep", "0:350:10")
    assert [float(row["angle_deg"]) for row in rows] == [10.0 * k for k in range(36)]
    for row, pose in zip(rows, found, strict=True):
        assert float(row["joints.B.velocity.y"]) == pose["joints"]["B"]["velocity"][1]
        assert float(row["bodies.5.travel"]) == pose["bodies"]["5"]["travel"]
        assert float(row["bodies.3.coefficients.2"]) == pose["bodies"]["3"]["coefficients"][1]
        assert float(row["dampers.cushion.rate"]) == pose["dampers"]["cushion"]["rate"]
    assert [path.name for path in tmp_path.iterdir()] == ["press.csv"]


def test_names_stand_in_json_as_they_are(solved: Callable[..., Any], tmp_path: Path) -> None:
    path = tmp_path / "a 100%s.toml"
    text = (Path(linkanim.__file__).parent / "scenes/catalogue/four-bars/crank-rocker.toml").read_text()
    path.write_text(text + '\n[bodies]\n"50 % \\"x\\" %d" = { joints = ["A", "B"] }\n', encoding="utf-8")
    (pose,) = solved(str(path), "--sweep", "60:60:1")
    assert pose["scene"] == "a 100%s"
    assert pose["bodies"]['50 % "x" %d']["angle"] == pose["bodies"]["coupler"]["angle"]


def test_csv_goes_to_stdout_and_leaves_unknown_cells_empty(solve: Solve) -> None:
    lines = solve("double-rocker", "--sweep", "60:180:120", "--csv", "-").splitlines()
    head, reached, beyond = (line.split(",") for line in lines)
    place = head.index("joints.B.position.x")
    assert float(reached[place]) > 0
    assert beyond[place] == ""
    assert beyond[0] == "180.0"


# name, what the one line says
@pytest.mark.parametrize(
    ("name", "message"),
    [
        (".", "is a folder"),
        ("missing/a.csv", "there is no folder"),
        ("a.xlsx", ".csv"),
    ],
)
def test_a_csv_that_cannot_be_is_refused_before_any_work(
    name: str,
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["solve", "press", "--sweep", "0:10:1", "--csv", name]) == 2
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_the_words_of_a_pose_name_everything(solve: Solve) -> None:
    words = solve("press", "--angle", "87 deg", "--speed", "10 rad/s")
    assert "crank angle 87 deg" in words
    firsts = [line.split("  ")[0] for line in words.splitlines()]
    for name in ("O2", "A", "B", "com of 3", "2", "7", "5", "return spring", "cushion damper"):
        assert name in firsts
    assert "3.327055" in words


def tables_of(words: str) -> dict[str, dict[str, float]]:
    """Read the tables of a pose back: {"rocker": {"omega rad/s": 1.2, ...}, ...}."""
    found: dict[str, dict[str, float]] = {}
    for block in words.split("\n\n")[1:]:
        head, *lines = (re.split(r"\s{2,}", line.strip()) for line in block.splitlines())
        for name, *cells in lines:
            found[name] = dict(zip(head[1:], map(float, cells), strict=True))
    return found


def test_each_column_of_the_words_holds_what_its_title_says(solve: Solve, solved: Callable[..., Any]) -> None:
    options = ("press", "--angle", "87 deg", "--speed", "10 rad/s", "--acceleration", "3 rad/s^2")
    pose, words = solved(*options), tables_of(solve(*options))
    body, slider, point = pose["bodies"]["3"], pose["bodies"]["5"], pose["joints"]["B"]
    spring, damper, com = pose["springs"]["return"], pose["dampers"]["cushion"], body["com"]
    meant = {
        ("3", "angle deg"): math.degrees(body["angle"]),
        ("3", "omega rad/s"): body["angular_velocity"],
        ("3", "alpha rad/s^2"): body["angular_acceleration"],
        ("3", "dq/dtheta rad/rad"): body["coefficients"][0],
        ("3", "d2q/dtheta2 rad/rad^2"): body["coefficients"][1],
        ("5", "travel mm"): slider["travel"],
        ("5", "v mm/s"): slider["velocity"],
        ("5", "a mm/s^2"): slider["acceleration"],
        ("5", "ds/dtheta mm/rad"): slider["coefficients"][0],
        ("5", "d2s/dtheta2 mm/rad^2"): slider["coefficients"][1],
        ("B", "x mm"): point["position"][0],
        ("B", "vy mm/s"): point["velocity"][1],
        ("B", "ax mm/s^2"): point["acceleration"][0],
        ("com of 3", "y mm"): com["position"][1],
        ("com of 3", "vx mm/s"): com["velocity"][0],
        ("com of 3", "ay mm/s^2"): com["acceleration"][1],
        ("return spring", "length mm"): spring["length"],
        ("return spring", "force N"): spring["force"],
        ("cushion damper", "rate mm/s"): damper["rate"],
        ("cushion damper", "force N"): damper["force"],
    }
    assert {place: words[place[0]][place[1]] for place in meant} == pytest.approx(meant, rel=1e-6)


def test_a_force_that_the_scene_does_not_give_is_said_to_be_so(solve: Solve) -> None:
    elements = solve("excavator", "--phase", "1 rad").split("\n\n")[-2]
    title, stick, bucket = elements.splitlines()
    assert title.split("  ")[-1].strip() == "force N"
    for line, length in ((stick, "235"), (bucket, "205")):
        assert re.split(r"\s{2,}", line)[1::2] == [length, "not given"]


def test_the_words_of_a_limit_say_unbounded(solve: Solve) -> None:
    assert "unbounded" in solve("double-rocker", "--phase", "0 deg")


def test_the_words_of_a_sweep_are_a_line_for_each_angle(solve: Solve) -> None:
    lines = solve("slider-crank", "--sweep", "0:90:45").splitlines()
    assert [line.split()[0] for line in lines] == ["angle", "0", "45", "90"]
    assert "slider mm" in lines[0]


PISTON = """
length_unit = "mm"
[drive]
speed = "20 rpm"
slider = { joint = "C", from = 80, to = 160 }
[ground]
O = [0, 0]
[joints.C]
line = { through = "O", angle = "0 deg" }
[joints.B]
from = ["C", "O"]
length = [120, 40]
side = "left"
[bodies]
crank = { joints = ["O", "B"] }
"""


def test_a_slider_that_drives_is_put_at_a_travel_with_a_speed_along_its_line(
    tmp_path: Path, solved: Callable[..., Any]
) -> None:
    path = tmp_path / "piston.toml"
    path.write_text(PISTON)
    found = solved(str(path), "--travel", "13 cm", "--speed", "-0.2 m/s")
    crank = found["bodies"]["crank"]
    assert found["coordinate"] == found["travel"] == 130
    # by the law of cosines
    assert math.degrees(crank["angle"]) == pytest.approx(-66.78199, abs=5e-6)
    assert crank["angular_velocity"] == pytest.approx(-4.780671, abs=5e-7)
    assert crank["angular_acceleration"] == pytest.approx(3.464530, abs=5e-7)
    assert solved(str(path), "--coordinate", "130 mm", "--speed", "-20 cm/s") == found
    assert solved("press", "--coordinate", "30 deg") == solved("press", "--angle", "30 deg")


TRAVELS = [
    ("beyond its ends", ("my.toml", "--travel", "2 m"), "the slider goes from 80 to 160 mm"),
    ("of a crank", ("press", "--travel", "2 m"), "its input turns, and has no travel"),
    ("a speed of a crank", ("press", "--angle", "3 deg", "--speed", "2 m/s"), "goes with --travel"),
    ("two places", ("my.toml", "--travel", "2 m", "--coordinate", "1 m"), "say where to solve"),
    ("no unit", ("my.toml", "--travel", "9 cm", "--speed", "30"), 'write a speed as "30 mm/s" or "30 cm/s"'),
    ("no such unit", ("my.toml", "--travel", "9 cm", "--speed", "3 ft"), "not one of its units, mm/s, cm/s"),
]


@pytest.mark.parametrize(("words", "reason"), [row[1:] for row in TRAVELS], ids=[row[0] for row in TRAVELS])
def test_a_travel_that_cannot_be_is_one_sentence(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: tuple[str, ...],
    reason: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("my.toml").write_text(PISTON)
    assert main(["solve", *words]) == 2
    said = capsys.readouterr().err
    assert reason in said
    assert said.count("\n") == 1
