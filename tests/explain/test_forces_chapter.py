"""The chapter on forces: every line computes, its results are what solving gives, for every kind of joint."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from newton_euler import EVERY, laden, linkages
from printed import checks_of, of_html, of_latex, of_markdown
from pushed import PUSHED
from random_joints import Make

from linkanim.cli import main
from linkanim.explain.documents import HTML, MARKDOWN, TEX
from linkanim.explain.forces import symbol_of
from linkanim.explain.formula import LATEX, Symbol
from linkanim.explain.solution import PoseRequest, Solution, solution
from linkanim.explain.steps import System, ValueLine
from linkanim.mechanics.linkage import Linkage
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse

DIGITS = 5e-6
LOADED = """
gravity = "9.81 m/s^2"
[four-bar]
ground = 100
crank = 30
coupler = 90
rocker = 80
[bodies]
coupler = { joints = ["A", "B"], com = [45, 10], mass = "2 kg", inertia = "0.01 kg m^2" }
[loads.work]
on = "rocker"
at = [40, 8]
force = { size = "50 N", angle = "-80 deg", turns = true }
torque = "0.4 N m"
"""


def four_bar() -> Scene:
    return scene_from(parse(LOADED, "my.toml"), name="my", where="my.toml")


def scene_of(linkage: Linkage) -> Scene:
    return Scene(name="random", title="Random", source="", length_unit="mm", linkage=linkage)


def forces_of(scene: Scene, phase: float, *, about: str | None = None) -> Solution:
    return solution(PoseRequest(scene, "phase", phase, scene.linkage.drive.speed, forces=True, about=about))


def failing(found: Solution) -> list[str]:
    wrong = []
    for form, read in ((MARKDOWN, of_markdown), (TEX, of_latex), (HTML, of_html)):
        checks = checks_of(read(form.document(found)))
        wrong += [f"{check.formula} = {check.shown}" for check in checks if not check.holds]
    return wrong


def disagreeing(found: Solution) -> list[tuple[str, float, float]]:
    motion, quantities = found.request.motion(), found.request.scene.quantities
    wrong = []
    for result in found.results:
        true, shown = float(quantities[result.token].displayed(motion)), result.value.value
        off = abs(math.remainder(shown - true, 360)) if result.unit == "°" else abs(shown - true)
        if not off <= max(DIGITS * abs(true), result.least):
            wrong.append((result.token, true, shown))
    return wrong


def told(found: Solution) -> set[str]:
    return {result.token for result in found.results if ".force." in result.token or "guide_" in result.token}


@pytest.mark.parametrize("name", ["press", "engine", "andrews", "my"])
@pytest.mark.parametrize("static", [False, True], ids=["in motion", "at rest"])
def test_every_line_gives_the_next_and_each_force_is_what_solving_gives(name: str, static: bool) -> None:
    scene = four_bar() if name == "my" else load(name)
    found = forces_of(scene.without_inertia if static else scene, 0.9)
    assert failing(found) == []
    assert disagreeing(found) == []
    reactions = {token for token in scene.quantities if ".force." in token and token.count(".") == 3}
    nothing = {
        token
        for token in reactions
        if abs(float(scene.quantities[token].read(found.request.motion()))) < 1e-9
    }
    assert reactions - nothing <= told(found) | {token for token in reactions if static}


@pytest.mark.parametrize("make", EVERY)
def test_every_kind_of_joint_is_worked_out(make: Make) -> None:
    for seed, linkage in enumerate(linkages(make, 2, seed=5)):
        found = forces_of(scene_of(replace(laden(linkage, seed), static=seed == 1)), 0.7 + seed)
        if not found.singular:
            assert disagreeing(found) == []
            assert failing(found) == []


def test_all_equations_as_one_system_have_the_solution_of_the_lines() -> None:
    for scene in (four_bar(), load("engine")):
        found = forces_of(scene, 0.9)
        (chapter,) = (chapter for chapter in found.chapters if chapter.title == "Forces")
        (system,) = (item for item in chapter.items if isinstance(item, System) and not item.formulas)
        values = {item.value.symbol: item.value.value for item in chapter.items if hasattr(item, "value")}
        x = np.array([values[symbol] for symbol in system.unknowns])
        rows = np.array([[entry.value for entry in row] for row in system.values])
        assert rows.shape == (len(x), len(x) + 1)
        solved = np.linalg.solve(rows[:, :-1], rows[:, -1])
        assert solved == pytest.approx(x, rel=2e-3, abs=1e-3 * np.abs(x).max())


def test_moments_are_about_the_joint_that_is_asked_for() -> None:
    text = MARKDOWN.document(forces_of(four_bar(), 0.9, about="B"))
    assert "their moments about B" in text
    assert "their moments about O4" not in text


def test_where_forces_grow_without_bound_no_number_is_given() -> None:
    scene = scene_from(parse(PUSHED, "my.toml"), name="my", where="my.toml")
    assert forces_of(scene, math.pi).singular
    assert "## Forces" in MARKDOWN.document(forces_of(scene, 2.5))
    assert "## Forces" not in MARKDOWN.document(forces_of(scene, math.pi))


def test_without_the_option_there_is_no_chapter_and_with_it_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["explain", "engine", "--angle", "40 deg"]) == 0
    assert "## Forces" not in capsys.readouterr().out
    assert main(["explain", "engine", "--angle", "40 deg", "--forces"]) == 0
    assert "## Forces" in capsys.readouterr().out
    for suffix in ("html", "tex", "md"):
        path = tmp_path / f"engine.{suffix}"
        assert main(["explain", "engine", "--angle", "40 deg", "--static", "-o", str(path)]) == 0
        assert "Forces" in path.read_text(encoding="utf-8")


def test_a_page_draws_each_body_free_and_each_symbol_says_its_arrow(tmp_path: Path) -> None:
    path = tmp_path / "engine.html"
    assert main(["explain", "engine", "--angle", "40 deg", "--forces", "-o", str(path)]) == 0
    page = path.read_text(encoding="utf-8")
    drawn = page[page.index("aria-label='Free bodies") :].partition("</svg>")[0]
    for words in ("Crank", "Rod", "Slider"):
        assert f">{words}</text>" in drawn
    arrows = set(re.findall(r'<g data-of="vector:([^"]*)"', drawn))
    assert arrows == {"F_A,2", "F_O2,2", "Q_2", "F_A,3", "F_B,3", "Q_3", "F_B,4", "N_4", "Q_4", "F_gas"}
    assert arrows <= set(re.findall(r"<mrow data-of='vector:([^']*)'", page))
    assert drawn.count('data-of="vector:F_B,4"') == 2  # the arrow and its name


def test_three_forces_on_a_body_close_a_triangle() -> None:
    found = forces_of(load("press").without_inertia, 1.5)
    for body in found.bodies:
        assert body.total().value == pytest.approx(0, abs=1e-3)
        turned = sum(couple.value for _, couple in body.couples) + sum(
            (place.value.conjugate() * force.value).imag for _, place, force in body.forces
        )
        assert turned == pytest.approx(0, abs=0.1)


def test_an_exercise_with_forces_asks_for_them_and_its_key_has_them(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["explain", "engine", "--angle", "40 deg", "--forces", "--exercise"]) == 0
    sheet, _, key = capsys.readouterr().out.partition("Key")
    assert "Draw each link free" in sheet
    found = solution(PoseRequest(load("engine"), "angle", math.radians(40), 2.094, forces=True))
    (torque,) = filter(None, (_effort(item) for one in found.chapters for item in one.items))
    assert "F_{B,3x}" in sheet
    assert torque not in sheet
    assert torque[:5] in key


def _effort(item: object) -> str:
    known = isinstance(item, ValueLine) and item.value.symbol == Symbol("M", "in")
    return item.value.shown if known and isinstance(item, ValueLine) else ""


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["crank-rocker", "--forces"], "states no mass, spring, damper or load"),
        (["engine", "--moments-about", "A"], "--moments-about goes with --forces"),
        (["engine", "--forces", "--moments-about", "Q"], "engine has no such joint; there are O2, A"),
    ],
)
def test_what_has_no_forces_is_refused_in_one_line(
    words: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["explain", *words]) == 2
    said = capsys.readouterr().err
    assert reason in said
    assert said.count("\n") == 1


def test_no_zero_has_a_sign_and_a_body_without_moments_says_so() -> None:
    engine = load("engine")
    found = forces_of(engine, math.radians(60.0) - engine.linkage.drive.start)
    text = MARKDOWN.document(found)
    assert not re.search(r"[-−]0\s*(\\,)?\s*(\\mathrm|\\text|N\b)", text)
    assert "forces across and up, none of which has a moment about B:" in text


@pytest.mark.parametrize("name", ["press", "engine", "my"])
def test_latex_has_the_bodies_free_with_every_force_on_them(name: str) -> None:
    scene = four_bar() if name == "my" else load(name)
    found = forces_of(scene, 1.1)
    text = TEX.document(found)
    drawn = text[text.index("{Forces}") :]
    pictures = drawn.count(r"\begin{tikzpicture}")
    bodies = [body for body in found.bodies if body.forces or body.couples]
    three = [body for body in bodies if len(body.triangle()) == 3]
    assert pictures == drawn.count(r"\end{tikzpicture}") == len(bodies) + len(three)
    assert drawn.count(r"\draw[->,thick,magenta") == sum(
        sum(bool(force.value) for _, _, force in body.forces) for body in bodies
    ) + 3 * len(three)
    for body in bodies:
        for force, _, value in body.forces:
            if value.value:
                assert f"{{${LATEX.symbol(symbol_of(force))}$}};" in drawn
    assert "tikz" not in MARKDOWN.document(found)


def test_latex_sets_small_numbers_in_its_standard_fonts() -> None:
    # a residual of 3.3×10⁻⁶ asked for another engine
    assert "fontspec" not in TEX.document(forces_of(load("press"), 1.1))


def test_the_sheet_says_which_way_unknown_forces_are_taken() -> None:
    text = MARKDOWN.document(forces_of(four_bar(), 1.1))
    assert "is negative, it points the other way" in text
