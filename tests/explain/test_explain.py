"""The worked solution: every printed line gives the next one, and the last ones are what solving gives."""

from __future__ import annotations

import math
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from printed import checks_of, of_html, of_latex, of_markdown

from linkanim.cli import main
from linkanim.digits import significant
from linkanim.explain.documents import HTML, MARKDOWN, TEX, DocumentForm, document
from linkanim.explain.inputs import PoseRequest
from linkanim.explain.lines import System, ValueLine
from linkanim.explain.solution import Solution, solution
from linkanim.explain.variant import variant
from linkanim.mechanics.facts.effort import effort_token
from linkanim.scenes import load, names
from linkanim.scenes.editing.edit import dimensions

DIGITS = 5.1e-5
"""Four significant digits, and what is in the last place of a float."""


def _request(name: str, degrees: float, speed: float | None = None) -> PoseRequest:
    """Return a pose by angle, or by phase of an input that turns back."""
    scene = load(name)
    by: Literal["angle", "phase"] = "angle" if scene.info.full_turn else "phase"
    return PoseRequest(scene, by, math.radians(degrees), speed or scene.linkage.drive.speed)


def _disagreeing(found: Solution) -> list[tuple[str, float, float]]:
    motion, quantities = found.request.motion(), found.request.scene.quantities
    wrong = []
    for result in found.results:
        true, shown = float(quantities[result.token].shown(motion)), result.value.value
        off = abs(math.remainder(shown - true, 360)) if result.unit == "°" else abs(shown - true)
        if not off <= max(DIGITS * abs(true), result.least):
            wrong.append((result.token, true, shown))
    return wrong


def _failing(found: Solution) -> list[str]:
    """Return the printed lines, of three documents, that do not give the next one."""
    wrong = []
    for form, read in ((MARKDOWN, of_markdown), (TEX, of_latex), (HTML, of_html)):
        checks = list(checks_of(read(document(found, replace(form, figure=lambda _: "")))))
        items = [item for chapter in found.chapters for item in chapter.items]
        formulas = sum(isinstance(item, ValueLine) and item.formula.operation != "leaf" for item in items)
        systems = sum(isinstance(item, System) and item.worked_out for item in items)
        assert len(checks) == formulas + 6 * systems
        wrong += [f"{check.formula} = {check.shown}" for check in checks if not check.holds]
    return wrong


# A four-bar, sliders, slot, yoke, gears, planet, cylinder, driven slider; inputs that turn and that swing.
@pytest.mark.parametrize(
    "name",
    ["crank-rocker", "slider-crank", "inverted-slider-crank", "scotch-yoke", "press", "double-rocker",
     "epicyclic-hypocycloid", "excavator", "driven-piston", "engine"],
)  # fmt: skip
def test_each_printed_line_gives_the_next_and_the_last_are_what_solving_gives(name: str) -> None:
    found = solution(_request(name, 50.0))
    assert not found.singular
    assert _failing(found) == []
    assert _disagreeing(found) == []
    linkage = found.request.scene.linkage
    assert linkage.forceful == (effort_token(linkage) in {result.token for result in found.results})


@pytest.mark.long
@pytest.mark.parametrize("name", names())
def test_all_scenes_at_several_angles(name: str) -> None:
    for degrees in (0.0, 37.0, 111.5, 200.0, 306.0):
        found = solution(_request(name, degrees, speed=-3.0))
        assert _failing(found) == []
        assert _disagreeing(found) == [] or found.singular


def _values(text: str) -> dict[str, float]:
    return {
        sides[0]: float(found[0])
        for sides in of_markdown(text)
        if (found := re.match(r"-?[\d.]+", sides[-1]))
    }


# Term report on a punch press, tables 3.1 and 3.2, at 10 rad/s; lengths in mm. At 306° its α₃ leaves its own
# loop open: this one closes it (the scene's note).
PRESS = {
    87: {
        r"\omega_{3}": "3.3271", r"\omega_{4}": "-1.2005", r"\omega_{6}": "-5.4143",
        r"\alpha_{3}": "12.7419", r"\alpha_{4}": "-11.3763", r"\alpha_{6}": "-14.2372",
        r"\dot{s}_{5}": "-132.8", r"\ddot{s}_{5}": "-2770.8",
    },
    306: {r"\alpha_{3}": "-18.4617"},
}  # fmt: skip


@pytest.mark.parametrize("degrees", PRESS)
def test_the_press_has_the_values_of_the_report(degrees: int, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "press", "--angle", f"{degrees} deg", "--speed", "10 rad/s"]) == 0
    found = _values(capsys.readouterr().out)
    for symbol, value in PRESS[degrees].items():
        half = 0.5 * 10.0 ** -len(value.partition(".")[2])
        assert found[symbol] == pytest.approx(float(value), abs=1.01 * half), symbol


# Rows as they are printed, of what is derived and how it is said.
WRITTEN = [
    r"$\mathbf{R}_{2} + \mathbf{R}_{3} = \mathbf{R}_{1} + \mathbf{R}_{4}$",
    r"$x_{A} = r_{2} \, \cos \theta_{2} = 50 \cdot \cos 60^{\circ} = 25.00000\,\mathrm{mm}$",
    "The loops differentiated in time: the same equations, the input running at its own speed.",
    "Differentiated once more: the same matrix, with ω² and what Coriolis adds on the right sides.",
]


def test_a_row_has_the_letters_then_the_numbers_and_each_chapter_says_what_it_does() -> None:
    lines = document(solution(_request("crank-rocker", 60.0)), MARKDOWN).splitlines()
    assert [line for line in lines if line in WRITTEN] == WRITTEN


def test_at_a_limit_it_says_that_no_rates_follow() -> None:
    found = solution(_request("double-rocker", 0.0))
    assert found.singular
    assert "No rates follow" in document(found, MARKDOWN)
    assert np.isfinite([result.value.value for result in found.results]).all()


@pytest.mark.parametrize("form", [MARKDOWN, TEX, HTML], ids=["Markdown", "LaTeX", "HTML"])
def test_an_exercise_leaves_its_numbers_open_and_has_a_key_on_a_page_of_its_own(form: DocumentForm) -> None:
    found = solution(_request("slider-crank", 50.0))
    sheet, _, key = document(found, form, exercise=True).partition(f"Key: {found.title}")
    lines = [item for chapter in found.chapters for item in chapter.items if isinstance(item, ValueLine)]
    assert sheet.count(form.how.blank) == len(lines)
    assert form.new_page in sheet
    for line in lines:
        assert line.formula.operation == "leaf" or line.value.shown.lstrip("-") not in sheet
        assert significant(abs(line.value.value), 5) in key


# a four-bar, what turns back, what depends on equal lengths, a cylinder, gears
@pytest.mark.parametrize("name", ["crank-rocker", "double-rocker", "parallelogram", "excavator", "press"])
def test_a_seed_gives_other_round_lengths_of_the_same_class(name: str) -> None:
    scene = load(name)
    found = [variant(scene, seed, lambda _: True) for seed in (1, 1, 2)]
    lengths = [[item.value for item in dimensions(one) if item.kind == "length"] for one in (scene, *found)]
    assert lengths[1] == lengths[2]
    assert len({tuple(some) for some in lengths}) == 3
    assert {one.info.class_name for one in found} == {scene.info.class_name}
    assert {one.info.full_turn for one in found} == {scene.info.full_turn}


@pytest.mark.long
@pytest.mark.parametrize("name", names())
def test_variants_of_all_scenes_are_worked_out(name: str) -> None:
    request = _request(name, 50.0)
    changed = replace(request, scene=variant(request.scene, 5, lambda _: True))
    assert changed.scene != request.scene
    found = solution(changed)
    assert _failing(found) == []
    assert _disagreeing(found) == []


@pytest.mark.parametrize("suffix", [".html", ".tex", ".md"])
def test_each_form_is_written_whole_under_its_name(
    suffix: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / f"solution{suffix}"
    assert main(["explain", "crank-rocker", "--angle", "60 deg", "-o", str(target)]) == 0
    assert capsys.readouterr().out.strip() == str(target)
    assert list(tmp_path.iterdir()) == [target]
    text = target.read_text(encoding="utf-8")
    assert "Crank-rocker" in text
    drawn = text.count(">R<tspan"), text.count(r"\draw[->")
    assert drawn == {".html": (4, 0), ".tex": (0, 4), ".md": (0, 0)}[suffix]


# what is asked for, and what the refusal names
@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["double-rocker", "--angle", "300 deg"], "from 13.7953 deg to 108.395 deg"),
        (["press", "-o", "solution.pdf"], ".html, .htm, .tex, .md"),
        (["press", "-o", "no-folder/solution.tex"], "there is no folder"),
        (["driven-piston", "--angle", "3 deg"], "take the phase"),
        (["press", "--angle", "3 deg", "--phase", "4 deg"], "not allowed with"),
    ],
)
def test_bad_input_is_refused_in_one_line(
    options: list[str],
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["explain", *options]) == 2
    message = capsys.readouterr().err
    assert words in message
    assert message.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="needs pdflatex")
@pytest.mark.slow
@pytest.mark.parametrize("name", ["press"])
def test_the_latex_compiles(name: str, tmp_path: Path) -> None:
    (tmp_path / "solution.tex").write_text(document(solution(_request(name, 87.0)), TEX), encoding="utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "solution.tex"]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    assert ran.returncode == 0, ran.stdout[-2000:]
    assert (tmp_path / "solution.pdf").stat().st_size > 10_000


def test_a_cylinder_that_drives_is_a_loop_and_where_none_closes_it_says_so() -> None:
    found = solution(_request("excavator", 100.0))
    (loop,) = found.loops
    foot, cylinder, head = (arrow.end - arrow.begin for arrow in loop.arrows)
    assert foot + cylinder == pytest.approx(head)
    places = found.request.scene.pose(math.radians(100.0), 0).position
    assert abs(cylinder) == pytest.approx(math.dist(places["G"], places["H"]))
    text = document(solution(_request("cardan-gears", 50.0)), MARKDOWN)
    assert "There is none to close" in text
