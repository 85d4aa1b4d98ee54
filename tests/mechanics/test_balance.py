"""The work that a flywheel stores, and counterweights that make the shaking force vanish."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from build import four_bar, slider_crank

from linkanim.cli import main
from linkanim.mechanics.balance import balanced, counterweights, flywheel, shaken, surplus
from linkanim.mechanics.linkage import Body, Crank, Drive, Linkage, Pin
from linkanim.mechanics.motion import mechanism
from linkanim.scenes import load

MASSES = (
    Body("crank", ("O2", "A"), (10.0, 2.0), None, 1.0, 1e-3),
    Body("coupler", ("A", "B"), (40.0, 12.0), None, 2.0, 2e-3),
    Body("rocker", ("B", "O4"), (30.0, -4.0), None, 1.5, 2e-3),
)


def heavy(bodies: tuple[Body, ...] = MASSES) -> Linkage:
    return replace(four_bar((100.0, 30.0, 90.0, 80.0)), bodies=bodies, metre=1e-3, gravity=9.81)


def test_a_mass_beside_its_axis_stores_twice_what_lifts_it() -> None:
    wheel = Body("wheel", ("O", "A"), (0.12, 0.0), None, 3.0, 0.01)
    linkage = Linkage((Pin("O", (0.0, 0.0)), Crank("A", "O", 0.2)), Drive("A", 2.0), (wheel,), gravity=9.81)
    solved = mechanism(linkage)
    found = surplus(lambda phases: solved.solve(phase=phases, speed=2.0), solved.phases)
    assert found == pytest.approx(2 * 3.0 * 9.81 * 0.12, rel=1e-9)
    assert flywheel(12.0, 20.0, 0.02) == pytest.approx(1.5)


def test_the_surplus_is_that_of_the_summed_torque() -> None:
    scene = load("engine")
    phases = np.arange(40_000) * (math.tau / 40_000)
    motion = scene.solve(phase=phases, speed=scene.linkage.drive.speed)
    torque = np.asarray(motion.reactions.effort)
    stored = np.cumsum(torque - torque.mean()) * (math.tau / 40_000)
    assert scene.info.surplus == pytest.approx(np.ptp(stored), rel=2e-3)


@pytest.mark.parametrize("way", [("O4", "B"), ("B", "O4")])
def test_with_its_counterweights_a_four_bar_does_not_shake_the_ground(way: tuple[str, str]) -> None:
    linkage = heavy((*MASSES[:2], replace(MASSES[2], joints=way)))
    weights = counterweights(linkage)
    assert weights
    assert {one.body for one in weights} == {"crank", "rocker"}
    (force, moment), (after, turning) = (
        shaken(one, 30.0).greatest for one in (linkage, balanced(linkage, weights))
    )
    assert force > 50.0
    assert after < 1e-10 * force
    assert turning > moment


def test_a_balanced_linkage_needs_no_counterweight() -> None:
    linkage = heavy()
    assert counterweights(balanced(linkage, counterweights(linkage) or ())) == ()


def test_what_is_no_four_bar_or_has_a_coupler_without_mass_has_none() -> None:
    assert counterweights(slider_crank(30.0, 90.0, 5.0)) is None
    assert counterweights(heavy((MASSES[0], replace(MASSES[1], mass=None, com=None), MASSES[2]))) is None
    assert counterweights(load("press").linkage) is None


FOUR_BAR = """
[four-bar]
ground = 100
crank = 30
coupler = 90
rocker = 80
[drive]
speed = "300 rpm"
[bodies]
crank = { joints = ["O2", "A"], com = [10, 2], mass = "1 kg", inertia = "0.001 kg m^2" }
coupler = { joints = ["A", "B"], com = [40, 12], mass = "2 kg", inertia = "0.002 kg m^2" }
"""


def test_info_tells_flywheel_and_counterweights(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "heavy.toml"
    path.write_text(FOUR_BAR, encoding="utf-8")
    assert main(["info", str(path), "--json", "--fluctuation", "0.05"]) == 0
    facts = json.loads(capsys.readouterr().out)
    speed = math.radians(1800)
    assert facts["flywheel_inertia"] == pytest.approx(facts["work_surplus"] / (0.05 * speed**2))
    assert facts["shaking_force"][0] > 10
    assert facts["shaking_force"][1] < 1e-9
    assert len(facts["counterweights"]) == 2
    assert main(["info", str(path)]) == 0
    words = capsys.readouterr().out
    for label in ("surplus of work", "flywheel", "counterweights", "shaking force", "shaking moment"):
        assert label in words
    assert main(["info", "crank-rocker"]) == 0
    assert "flywheel" not in capsys.readouterr().out


def test_the_balance_is_drawn_without_and_with_counterweights(tmp_path: Path, capsys: Any) -> None:
    path, table, drawn = (tmp_path / name for name in ("heavy.toml", "balance.csv", "balance.svg"))
    path.write_text(FOUR_BAR, encoding="utf-8")
    assert main(["info", str(path), "--json", "--balance", str(table)]) == 0
    facts = json.loads(capsys.readouterr().out)
    rows = np.genfromtxt(table, delimiter=",", names=True)
    for n, name in enumerate(("", "_balanced")):
        assert rows[f"force{name}"].max() == pytest.approx(facts["shaking_force"][n], abs=1e-9)
        assert np.abs(rows[f"moment{name}"]).max() == pytest.approx(facts["shaking_moment"][n], abs=1e-9)
    assert main(["info", str(path), "--balance", str(drawn)]) == 0
    text = drawn.read_text(encoding="utf-8")
    assert "0 N with them" in text
    assert "without counterweights" in text


@pytest.mark.parametrize("name", ["press", "crank-rocker"])
def test_what_has_no_counterweights_has_no_picture_of_them(name: str, tmp_path: Path, capsys: Any) -> None:
    assert main(["info", name, "--balance", str(tmp_path / "balance.svg")]) == 2
    assert "no four-bar whose coupler has a mass" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
