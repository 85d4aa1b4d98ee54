"""What commands say of forces: the same numbers in words, JSON, CSV and charts, unbounded alike."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w
from pushed import PUSHED
from random_groups import document

import linkanim
from linkanim.cli import main

WEIGHED = """
gravity = "9.81 m/s^2"
[slider-crank]
crank = 40
rod = 120
[bodies.slider]
slider = "B"
mass = "2 kg"
[loads.work]
on = "slider"
force = ["-300 N", "0 N"]
"""


@pytest.fixture
def said(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Callable[..., str]:
    """Return a function that gives back what a command prints about a scene, given by its text."""

    def run(command: str, scene: str, *words: str) -> str:
        path = tmp_path / "scene.toml"
        path.write_text(scene, encoding="utf-8")
        assert main([command, str(path), *words]) == 0
        return capsys.readouterr().out

    return run


def test_reactions_guides_and_ground_are_in_json(said: Callable[..., str]) -> None:
    pose = json.loads(said("solve", WEIGHED, "--angle", "90 deg", "--json", "--static"))
    lean = math.asin(40 / 120)
    side = 300 * math.tan(lean)
    weight = 2 * 9.81
    assert pose["reactions"]["B"]["rod"] == pytest.approx([-300, side])
    assert pose["reactions"]["B"]["slider"] == pytest.approx([300, -side])
    assert pose["reactions"]["O2"]["ground"] == pytest.approx([-300, side])
    assert pose["guides"] == {"slider": {"force": pytest.approx(weight + side), "moment": 0.0}}
    assert pose["ground"]["force"] == pytest.approx([-300, -weight])
    assert pose["ground"]["moment"] == pytest.approx(-weight * 0.12 * math.cos(lean))
    assert pose["input"]["torque"] == pytest.approx(-300 * 0.04)


def test_at_rest_only_inertia_is_left_out(said: Callable[..., str]) -> None:
    moving, resting, slow = (
        json.loads(said("solve", WEIGHED, "--angle", "50 deg", "--json", *more))
        for more in (("--speed", "30 rad/s"), ("--speed", "30 rad/s", "--static"), ("--speed", "1e-9 rad/s"))
    )
    assert moving["reactions"]["B"]["rod"] != pytest.approx(resting["reactions"]["B"]["rod"], rel=0.1)
    assert resting["reactions"]["B"]["rod"] == pytest.approx(slow["reactions"]["B"]["rod"], rel=1e-12)


def test_what_has_no_forces_says_none_and_has_none_at_rest(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["solve", "crank-rocker", "--angle", "50 deg", "--json"]) == 0
    assert not {"reactions", "guides", "ground"} & json.loads(capsys.readouterr().out).keys()
    assert linkanim.load("crank-rocker").solve(angle=1.0).reaction == {}
    for command in (["solve", "--angle", "50 deg"], ["chart", "--quantity", "rocker.angle"]):
        assert main([command[0], "crank-rocker", *command[1:], "--static"]) == 2
        told = capsys.readouterr().err
        assert "crank-rocker: states no mass, spring, damper or load" in told
        assert told.count("\n") == 1


def test_what_is_unbounded_is_told_alike(said: Callable[..., str], tmp_path: Path) -> None:
    pose = json.loads(said("solve", PUSHED, "--phase", "180 deg", "--json"))
    assert pose["reactions"]["K"]["upper"] == [None, None]
    assert pose["input"]["force"] is None
    assert None not in pose["ground"]["force"]
    words = said("solve", PUSHED, "--phase", "180 deg")
    (row,) = (line.split() for line in words.splitlines() if line.startswith("K on upper"))
    assert row[3:] == ["unbounded", "unbounded"]
    table = said("solve", PUSHED, "--phase", "--sweep", "90:180:90", "--csv", "-")
    *_, first, last = csv.reader(StringIO(table))
    titles = next(csv.reader(StringIO(table)))
    at = titles.index("reactions.K.upper.x")
    assert math.isfinite(float(first[at]))
    assert last[at] == "inf"
    motion = linkanim.load(str(tmp_path / "scene.toml")).solve(phase=[math.pi])
    assert np.isinf(motion.reaction["K"]["upper"]).all()
    chart = said("chart", PUSHED, "--quantity", "upper.K.force", "-o", str(tmp_path / "chart.csv"))
    assert chart.strip().endswith("chart.csv")
    rows = list(csv.reader(StringIO((tmp_path / "chart.csv").read_text(encoding="utf-8"))))
    assert "inf" in {row[-1] for row in rows}


def test_python_has_the_forces_by_joint_and_body() -> None:
    scene = linkanim.load("press")
    motion, pose = scene.solve(angle=[1.0, 2.0]), scene.pose(1.0)
    forces: Any = motion.reaction["B"]
    assert set(forces) == {"3", "4", "6"}
    assert forces["4"].shape == (2, 2)
    assert sum(forces.values()) == pytest.approx(np.zeros((2, 2)), abs=1e-12)
    assert len(pose.reaction["B"]["4"]) == 2


@pytest.mark.parametrize(
    ("token", "title"),
    [
        ("2.O2.force", "Link 2: force in O2"),
        ("ground.O2.force.x", "Ground: x of the force in O2"),
        ("5.guide_force", "Slider C: force of its guide"),
        ("D.tangential_force", "D: tangential force of its teeth"),
        ("ground.moment", "Ground: shaking moment"),
    ],
)
def test_each_force_is_a_quantity_with_words(token: str, title: str) -> None:
    assert linkanim.load("press").quantities[token].words == title


def test_teeth_press_at_the_angle_that_is_stated(said: Callable[..., str]) -> None:
    scene = (
        "[ground]\nO2 = [0, 0]\nO4 = [100, 0]\n[joints.A]\ncrank = 'O2'\nlength = 30\n"
        "[joints.D]\ncrank = 'O4'\nlength = 20\ngear = { with = 'A', ratio = -1%s }\n"
        "[bodies.wheel]\njoints = ['O4', 'D']\n[loads.p]\non = 'wheel'\ntorque = '5 N m'\n"
    )
    for more, angle in (("", 20), (", pressure_angle = '25 deg'", 25), (", pressure_angle = '0 deg'", 0)):
        gears = json.loads(said("solve", scene % more, "--angle", "0 deg", "--json"))["gears"]["D"]
        assert gears["moment"] == pytest.approx(-5.0)
        assert gears["tangential"] == pytest.approx(-100.0)
        assert gears["radial"] == pytest.approx(100.0 * math.tan(math.radians(angle)))


def test_links_that_are_solved_together_have_forces_that_are_not_derived(
    said: Callable[..., str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = document("triad", 3) | {"loads": {"p": {"on": "plate", "torque": "2 N m"}}}
    found = json.loads(said("solve", tomli_w.dumps(scene), "--phase", "60 deg", "--json"))
    assert found["input"]["torque"]
    assert {*found["reactions"]["B"]} == {"AB", "plate"}
    assert main(["draw", str(tmp_path / "scene.toml"), "--vectors", "f", "-o", str(tmp_path / "x.svg")]) == 0
    assert main(["explain", str(tmp_path / "scene.toml"), "--forces", "-o", str(tmp_path / "x.html")]) == 2
    assert "are not derived line by line" in capsys.readouterr().err
