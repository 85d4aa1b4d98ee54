"""An exercise asks what an exam asks, can be solved from its sheet alone, and has a key with the way."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Literal

import pytest
from browser import PROGRAM, pages_of, printed

from linkanim.cli import main
from linkanim.explain.documents import HTML, MARKDOWN, TEX, DocumentForm
from linkanim.explain.exercise import LEVELS, Level, exercise
from linkanim.explain.formula import Formula, Symbol
from linkanim.explain.questions import ExamQuestion, given, questions
from linkanim.explain.solution import PoseRequest, Solution, solution
from linkanim.explain.steps import Equation, Given, System, ValueLine
from linkanim.scenes import load, names
from linkanim.units import rounded


def _solved(name: str, degrees: float = 73.1) -> Solution:
    scene = load(name)
    by: Literal["angle", "phase"] = "angle" if scene.info.full_turn else "phase"
    return solution(PoseRequest(scene, by, math.radians(degrees), scene.linkage.drive.speed))


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_it_asks_five_to_eight_questions_in_the_order_of_the_solution(name: str) -> None:
    found = _solved(name)
    asked = questions(found)
    assert 5 <= len(asked) <= 8
    stated = {item.value.symbol for item in given(found, asked) if isinstance(item, Given)}
    numbers = [value.symbol for one in asked for value, _ in one.answers]
    assert len(numbers) <= 26
    assert not stated & {*numbers}  # nothing is asked that is given
    assert len({*numbers}) == len(numbers)
    kinds = [_order(one) for one in asked if one.answers]
    assert kinds == sorted(kinds)
    for one in asked:
        assert one.marks > 0
        for value, _ in one.answers:
            assert value.symbol is not None
            own = found.solved.get(value.symbol, value.value)
            assert value.value == pytest.approx(own, rel=2e-4, abs=1e-4)


def _order(question: ExamQuestion) -> int:
    """Return 0 for a place, 1 for a velocity, 2 for an acceleration, 3 for the whole motion."""
    symbols = [value.symbol for value, _ in question.answers]
    first = symbols[0]
    assert first is not None
    if first.sub == "swing" or first.letter == "H":
        return 3
    if first.mark in ("˙", "¨"):
        return 1 + (first.mark == "¨")
    return {"ω": 1, "α": 2, "h": 1, "f": 1, "g": 1}.get(first.letter, 0)


def _leaves(formula: Formula) -> set[Symbol]:
    return {leaf.symbol for leaf in formula.leaves if leaf.symbol is not None}


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_it_can_be_solved_from_the_sheet_alone(name: str) -> None:
    found = _solved(name)
    asked = questions(found)
    items = given(found, asked)
    known = {item.value.symbol for item in items if isinstance(item, Given)}
    known |= {item.left.symbol for item in items if isinstance(item, Equation)}
    missing = set()
    for item in (item for one in asked for step in one.way for item in step.items):
        if isinstance(item, ValueLine):
            used = {one for one in _leaves(item.formula) if one.letter not in "abπ" or not one.sub}
            # the length and the direction of a line that the figure dimensions may have other names
            missing |= {one for one in used if one not in known and one.letter != "π"}
            known.add(item.value.symbol)
        elif isinstance(item, System):
            rows = (entry for row in item.formulas for entry in row)
            missing |= {
                one for entry in rows for one in _leaves(entry) if one not in known and one.letter not in "ab"
            }
        elif isinstance(item, Given):
            known.add(item.value.symbol)
    assert missing == set()


@pytest.mark.parametrize("form", [MARKDOWN, TEX, HTML], ids=["Markdown", "LaTeX", "HTML"])
@pytest.mark.parametrize("level", LEVELS)
def test_its_numbers_are_open_with_their_units_and_the_key_has_them(form: DocumentForm, level: Level) -> None:
    found = _solved("slider-crank", 50.0)
    sheet, _, key = exercise([found], form, level).partition(f"Key: {found.title}")
    asked = questions(found)
    answers = [answer for one in asked for answer in one.answers]
    opened = sheet.count(form.how.blank)
    assert opened == len(answers) if level != "formulas" else opened > len(answers)
    assert sheet.count(f"{form.how.blank}{form.how.unit('mm/s')}") >= 4
    assert form.new_page in sheet
    assert ("Hint:" in sheet) == (level == "hints")
    for value, _ in answers:
        assert value.symbol is not None
        own = found.solved.get(value.symbol, value.value)
        assert rounded(abs(own), 4) in key
        assert value.shown.lstrip("-") not in sheet
    # the key has the way, with its numbers
    lines = [item for one in asked for step in one.way for item in step.items if isinstance(item, ValueLine)]
    assert len(lines) > 30
    assert all(form.how.number(line.value.shown, False) in key for line in lines)


def test_a_sheet_tells_once_how_many_digits_a_result_has() -> None:
    text = exercise([_solved("press")], MARKDOWN)
    assert text.count("significant digits") == 1
    assert "The numbers given are exact; give results in four significant digits." in text


def test_gears_are_given_by_their_equation_and_an_input_that_slides_by_its_travel() -> None:
    press = exercise([_solved("press")], MARKDOWN).partition("# Key")[0]
    assert r"\theta_{7} = - \theta_{2} + \delta_{D}" in press
    piston = exercise([_solved("driven-piston")], MARKDOWN).partition("# Key")[0]
    assert r"\dot{s}_{C} = " in piston
    assert "\\varphi" not in piston


def test_versions_have_letters_other_lengths_and_their_keys(capsys: pytest.CaptureFixture[str]) -> None:
    asked = ["explain", "crank-rocker", "--angle", "60 deg", "--exercise", "--versions", "4", "--seed", "3"]
    assert main(asked) == 0
    text = capsys.readouterr().out
    heads = [line for line in text.splitlines() if line.startswith("# ")]
    letters = [line[-1] for line in heads]
    assert letters == [*"ABCD"] * 2
    assert [line.startswith("# Key: ") for line in heads] == [False] * 4 + [True] * 4
    sheets = text.partition("# Key:")[0].split("\n# ")
    assert len({re.search(r"r_\{3\} = ([\d.]+)", sheet)[1] for sheet in sheets if "r_{3} =" in sheet}) == 4  # type: ignore[index]
    assert r"\omega_{2} = 2.094\," in text
    assert main([*asked[:5], "--seed", "4"]) == 0
    alone = capsys.readouterr().out
    assert alone.partition("# Key:")[0].partition("\n")[2].strip() in text


def test_an_input_that_swings_is_given_by_its_angle_and_velocity(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "double-rocker", "--exercise"]) == 0
    sheet = capsys.readouterr().out.partition("# Key")[0]
    assert re.search(r"\\omega_\{2\} = [\d.]+\\,", sheet)
    assert re.search(r"\\theta_\{2\} = \d+\.?\d?\^", sheet)
    assert "The velocity of the input is constant." in sheet


@pytest.mark.slow
def test_figures_of_versions_share_no_id(tmp_path: Path) -> None:
    out = tmp_path / "sheet.html"
    words = ["crank-rocker", "--angle", "60 deg", "--exercise", "--versions", "2"]
    assert main(["explain", *words, "-o", str(out)]) == 0
    text = out.read_text(encoding="utf-8")
    ids = re.findall(r' id=["\']([^"\']*)', text)
    assert len(ids) == len(set(ids))
    # the figure has its dimensions
    assert re.search(r"r<tspan[^>]*>1</tspan>", text)


def test_levels_and_versions_are_of_an_exercise(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "crank-rocker", "--level", "drawing"]) == 2
    assert "add --exercise" in capsys.readouterr().err
    assert main(["explain", "crank-rocker", "--exercise", "--versions", "30"]) == 2
    assert "from 1 to 26" in capsys.readouterr().err


@pytest.mark.window
@pytest.mark.skipif(not PROGRAM, reason="needs Chromium")
@pytest.mark.parametrize("name", ["crank-rocker", "press", "scotch-yoke"])
def test_a_sheet_is_two_pages(name: str, tmp_path: Path) -> None:
    out = tmp_path / "sheet.html"
    assert main(["explain", name, "--exercise", "-o", str(out)]) == 0
    text = out.read_text(encoding="utf-8")
    head, _, key = text.partition("<div class='key'></div>")
    (tmp_path / "alone.html").write_text(f"{head}</main></body></html>", encoding="utf-8")
    assert key
    assert pages_of(printed(tmp_path / "alone.html", tmp_path)) == 2
