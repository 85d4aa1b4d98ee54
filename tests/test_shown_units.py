"""A unit that lengths are shown in: the same linkage and motion, and one factor wherever a length is read."""

from __future__ import annotations

import json
import math
import re
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from shown_lists import values_in

from linkanim.cli import main
from linkanim.errors import SceneError
from linkanim.picture.hud import rows
from linkanim.picture.lists import Panel
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.state import State, begin
from linkanim.scenes import load
from linkanim.scenes.editing import dimensions, in_unit
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import text
from linkanim.units import LENGTH_UNITS, metre

SCENES = ("press", "excavator", "driven-piston", "scotch-yoke", "crank-rocker")
"""Springs, dampers and masses; a driving cylinder, in cm; a slider that drives; a yoke; one that turns."""
PHASE, SPEED = 0.7, 3.0
SHOWN = [
    pytest.param(name, unit, marks=[pytest.mark.long] * (name != "press" and n != turn % 3))
    for turn, name in enumerate(SCENES)
    for n, unit in enumerate(unit for unit in LENGTH_UNITS if unit != load(name).length_unit)
]
"""The press in every unit, each other scene in one of them; all of them in a long run."""


def _factor(scene: Scene, unit: str) -> float:
    return metre(scene.length_unit) / metre(unit)


@pytest.mark.parametrize(("name", "unit"), SHOWN)
def test_every_quantity_is_its_own_times_the_factor(name: str, unit: str) -> None:
    scene, shown = load(name), in_unit(load(name), unit)
    pose, other = scene.pose(PHASE, speed=SPEED), shown.pose(PHASE, speed=SPEED)
    assert shown.length_unit == unit
    assert [*scene.quantities] == [*shown.quantities]
    for token, one in scene.quantities.items():
        above, _, below = one.unit.replace("{0}", "{}").partition("/")
        power = ("{}" in above) - ("{}" in below) * (1 + below.endswith("²"))
        meant = np.asarray(one.read(pose), float) * _factor(scene, unit) ** power
        size = np.abs(meant[np.isfinite(meant)]).max(initial=1e-3)
        found = np.asarray(shown.quantities[token].read(other), float)
        assert found == pytest.approx(meant, rel=1e-9, abs=1e-9 * size, nan_ok=True), token


def _solved(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(["solve", *words, "--phase", f"{PHASE} rad", "--speed", f"{SPEED} rad/s"]) == 0
    return capsys.readouterr().out


def _numbers(words: str) -> list[float]:
    return [float(found) for found in re.findall(r"-?\d+(?:\.\d+)?", words.replace("−", "-"))]


@pytest.mark.thinned(3)
@pytest.mark.parametrize(("name", "unit"), SHOWN)
def test_hud_chart_arrows_names_table_and_json_agree(
    name: str, unit: str, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = load(name)
    token = next(token for token, one in scene.quantities.items() if token.endswith(".velocity.x"))
    look = Look(unit=unit, chart=token, names=2, vectors=frozenset("v"))
    picture = Picture(scene, (1280, 720), look)
    pose = picture.poses(PHASE, SPEED)[0]
    printed: Any = json.loads(_solved(capsys, name, "--json", "--unit", unit))
    assert printed["length_unit"] == unit
    # the chart's reading, titled with the unit
    joint = token.partition(".")[0]
    assert picture._chart is not None
    (chart,) = picture._chart.at(SPEED).panels
    read = _numbers(chart.reading(chart.values_at(pose))[0])[0]
    span = chart.plot.y.high - chart.plot.y.low
    assert read == pytest.approx(printed["joints"][joint]["velocity"][0], abs=span / 400)
    assert f"({unit}/s)" in chart.quantity.title(picture.scene.length_unit)
    # the table's heading and its numbers
    table = _solved(capsys, name, "--unit", unit)
    row = next(line for line in table.splitlines() if line.startswith(f"{joint} "))
    assert f"vx {unit}/s" in table
    assert _numbers(row.split(maxsplit=1)[1])[:2] == pytest.approx(
        printed["joints"][joint]["position"], rel=1e-6
    )
    # the arrows' key, the dimensions, and every number of the HUD
    arrows = picture.drawing.arrows
    assert [kind.unit for kind in arrows] == [f"{unit}/s"]
    speeds = [math.hypot(*printed["joints"][one]["velocity"]) for one in scene.trace]
    assert arrows[0].most * SPEED / abs(scene.linkage.drive.speed) >= max(speeds, default=0.0) * (1 - 1e-9)
    symbols = picture.drawing.symbols
    assert symbols
    assert all(one.angle or one.written(unit).endswith(f" {unit}") for one in symbols.dimensions)
    for part in ("springs", "dampers"):
        for strut, known in printed[part].items():
            told = [value for label, value in rows(picture.scene, pose) if label.startswith(f"{strut} ")]
            assert told
            assert unit in told[0].split()[-1].split("/")
            near = (known["rate"], known["length"])
            assert any(
                math.isclose(_numbers(told[0])[0], one, abs_tol=picture.scene.length_step) for one in near
            )


@pytest.mark.parametrize("unit", LENGTH_UNITS)
def test_the_file_s_own_unit_and_document_stay(unit: str) -> None:
    scene = load("press")
    before = text(scene)
    shown = in_unit(scene, unit)
    assert (text(scene), scene.length_unit) == (before, "mm")
    assert in_unit(scene, unit) is shown
    for one, other in zip(dimensions(scene), dimensions(shown), strict=True):
        factor = Fraction(metre("mm")) / Fraction(metre(unit)) if one.unit == "mm" else 1
        assert one.key == other.key
        assert other.value == pytest.approx(float(one.value * factor), rel=1e-15)


def test_a_unit_that_is_none_and_a_scene_without_a_file_are_refused() -> None:
    scene = load("crank-rocker")
    with pytest.raises(SceneError, match="length_unit"):
        in_unit(scene, "ft")
    bare = Scene(scene.name, scene.title, "", "mm", scene.linkage)
    with pytest.raises(SceneError, match="stays in mm"):
        in_unit(bare, "cm")


def test_a_length_too_small_for_a_unit_is_refused_with_the_least_in_that_unit() -> None:
    links = {"ground": 4e-12, "crank": 1.2e-12, "coupler": 3.6e-12, "rocker": 3.2e-12}
    scene = scene_from({"four-bar": links}, name="tiny", where="tiny.toml")
    said = r'four-bar\.ground = "4e-12 mm": .*; 1e-12 in is the least; show it in another unit$'
    with pytest.raises(SceneError, match=said):
        in_unit(scene, "in")


def test_a_figure_and_a_chart_take_a_unit(tmp_path: Any, capsys: pytest.CaptureFixture[str]) -> None:
    figure, chart = tmp_path / "figure.svg", tmp_path / "chart.svg"
    assert (
        main(
            [
                "draw",
                "crank-rocker",
                "--angle",
                "60 deg",
                "--names",
                "--names",
                "--unit",
                "cm",
                "-o",
                str(figure),
            ]
        )
        == 0
    )
    words = ["--quantity", "B.velocity", "--unit", "m", "-o", str(chart)]
    assert main(["chart", "crank-rocker", *words]) == 0
    assert "= 5 cm" in figure.read_text()
    assert "(m/s)" in chart.read_text()
    assert main(["draw", "crank-rocker", "--unit", "ft", "-o", str(figure)]) == 2
    assert '"ft"' in capsys.readouterr().err


# In the window: the list, what is typed and nudged there, the file that is saved.


def after(state: State, *actions: Action | str) -> State:
    for one in actions:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return state


@pytest.fixture
def inches() -> State:
    """The crank-rocker's list in inches, standing at its crank (50 mm)."""
    listed = after(begin(load("crank-rocker")), "unit", "unit", "unit", "edit", Action("choose", 1))
    assert listed.look.unit == "in"
    return listed


def _crank(state: State) -> tuple[float, Any]:
    """Return the crank in mm, and as the document has it."""
    return next(item.value for item in dimensions(state.scene) if item.label == "Crank 2"), (
        state.scene.document["four-bar"]["crank"]
    )


def _panel(state: State) -> Panel:
    panel = values_in(state)
    assert panel
    return panel


def test_the_list_is_in_the_unit_that_is_shown(inches: State) -> None:
    assert next(row for row in _panel(inches).rows if row.chosen).value == "1.9685 in"
    assert "mm" not in " ".join(row.value for row in _panel(inches).rows)


def test_a_number_is_taken_in_the_unit_that_is_shown_and_written_with_it(inches: State) -> None:
    state = after(inches, Action("type", "2"), "accept")
    assert _crank(state) == (50.8, "2 in")
    assert state.scene.length_unit == "mm"
    assert _crank(after(inches, Action("type", "40 mm"), "accept")) == (40.0, "40 mm")


def test_a_nudge_is_a_step_of_the_unit_that_is_shown(inches: State) -> None:
    state = after(inches, Action("nudge", 1))
    assert _crank(state)[0] == pytest.approx(50 + 2.54)
    assert _crank(after(state, "undo")) == (50.0, 50)


def test_a_refusal_is_in_the_unit_that_is_shown(inches: State) -> None:
    state = after(inches, Action("type", "40"), "accept")
    assert state.scene is inches.scene
    assert " in" in (state.editing.refusal or "")
    assert "mm" not in (state.editing.refusal or "")


def test_a_dragged_joint_lies_under_the_mouse_in_any_unit(inches: State) -> None:
    held = after(inches, Action("grab", "A"))
    x, y = held.displayed.pose(held.phase, 0).position["A"]
    carried = after(held, Action("carry", (1.2 * x, 1.2 * y, 1.0)))
    assert _crank(carried)[0] == 60.0


def test_a_typed_travel_is_in_the_unit_that_is_shown() -> None:
    scene = load("driven-piston")
    low, high = scene.info.input_range
    state = after(begin(scene), "unit", "pause", Action("type_place", f"{(low + high) / 20:.3f}"), "go")
    assert state.look.unit == "cm"
    assert scene.pose(state.phase, 0).coordinate == pytest.approx((low + high) / 2, abs=0.01)


@pytest.mark.slow
def test_a_worked_solution_a_hand_out_and_a_page_take_a_unit(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    # of any pose: which one reads best is asked elsewhere
    monkeypatch.setattr("linkanim.paper.report.still_phase", lambda _: 1.0)
    own, shown = (
        _ran(capsys, "explain", "crank-rocker", "--angle", "60 deg", *more) for more in ([], ["--unit", "cm"])
    )
    assert r"r_{2} = 50\,\mathrm{mm}" in own
    assert r"r_{2} = 5\,\mathrm{cm}" in shown
    assert r"\mathrm{mm" not in shown
    other = _ran(capsys, "explain", "crank-rocker", "--angle", "60 deg", "--seed", "3", "--unit", "in")
    assert r"\mathrm{in}" in other
    assert r"\mathrm{mm" not in other
    _ran(capsys, "report", "crank-rocker", "-o", str(tmp_path / "report"), "--unit", "m")
    page = (tmp_path / "report" / "report.html").read_text()
    assert "m/s" in page
    assert not re.search(r"\bmm\b", re.sub(r"<style.*?</style>|<[^>]*>", " ", page, flags=re.DOTALL))
    _ran(capsys, "share", "crank-rocker", "-o", str(tmp_path / "page.html"), "--unit", "cm")
    assert '"unit":"cm"' in (tmp_path / "page.html").read_text()


def _ran(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main([*words]) == 0
    return capsys.readouterr().out
