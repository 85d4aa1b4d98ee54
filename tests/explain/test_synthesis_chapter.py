"""The chapter on how a linkage was made: each printed line gives the next, and the last its lengths."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
from made_scenes import FEW, MADE
from printed import checks_of, of_html, of_latex, of_markdown
from tex import needs_tex

import linkanim
from linkanim.cli import main
from linkanim.explain.documents import HTML, MARKDOWN, TEX
from linkanim.explain.solution import PoseRequest, solution
from linkanim.explain.steps import names_of
from linkanim.explain.synthesis import _Chapter, synthesis
from linkanim.explain.variant import variant
from linkanim.picture.figure import figure
from linkanim.scenes.scene import PosesPurpose, TimeRatioPurpose
from linkanim.scenes.toml import text

ANEW = ("guide-2", "guide-4", "guide-5", "guide-slider-3", "swing")
FORMS = {"Markdown": (MARKDOWN, of_markdown), "LaTeX": (TEX, of_latex), "HTML": (HTML, of_html)}


@pytest.mark.parametrize("name", FEW)
def test_every_printed_line_computes_and_leads_to_the_linkage(name: str) -> None:
    scene = MADE[name]()
    found = solution(PoseRequest(scene, "phase", 0.5, 2.0))
    chapter = found.synthesis_chapter
    assert chapter is not None
    assert chapter.title == "Synthesis"
    for form, read in FORMS.values():
        printed = form.document(found)
        checks = list(checks_of(read(printed[printed.index("Synthesis") :])))
        assert len(checks) > 2
        assert [check for check in checks if not check.holds] == []
    draft = _Chapter(scene, names_of(figure(scene)), 9)
    assert len(draft.compared) >= 2
    for value, true in draft.compared:
        assert value.value == pytest.approx(true, rel=5e-6)


def test_a_linkage_with_other_lengths_has_no_such_chapter(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(
        text(MADE["guide-3"]()).replace('crank = "O2"\nlength = ', 'crank = "O2"\nlength = 20.5 # '),
        encoding="utf-8",
    )
    changed = linkanim.load(path)
    assert changed.purpose is not None
    assert synthesis(changed, names_of(figure(changed))) == ()
    assert synthesis(linkanim.load("press"), names_of(figure(linkanim.load("press")))) == ()


@pytest.mark.slow
def test_an_exercise_leaves_the_numbers_open_and_the_page_has_the_construction(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "log.toml").write_text(text(MADE["function-3"]()), encoding="utf-8")
    assert main(["explain", "log.toml", "--phase", "1 rad", "-o", "solution.html"]) == 0
    assert main(["explain", "log.toml", "--phase", "1 rad", "-o", "sheet.html", "--exercise"]) == 0
    page, sheet = ((tmp_path / name).read_text() for name in ("solution.html", "sheet.html"))
    assert "its construction" in page
    crank = f"{MADE['function-3']().linkage.crank('A').length:.4f}"
    exercise, _, key = sheet.partition("<h1>Key")
    asked = exercise[exercise.index("Synthesis: show how") :]
    assert "class='blank'" in asked
    assert crank[:6] in page[page.index("<h2>Synthesis") :]
    assert "its construction" not in exercise
    assert "its construction" in key


@pytest.mark.parametrize(
    "name", ["guide-3", "stroke", *(pytest.param(name, marks=pytest.mark.long) for name in ANEW)]
)
def test_an_exercise_with_a_seed_is_made_for_other_poses_and_ratios(name: str) -> None:
    scene = MADE[name]()
    found = [variant(scene, seed, lambda _: True) for seed in (1, 2, 2)]
    assert found[0].purpose != found[1].purpose == found[2].purpose
    for one in found[:2]:
        assert synthesis(one, names_of(figure(one))) != ()
        assert one.purpose != scene.purpose
        if isinstance(one.purpose, PosesPurpose):
            angles = np.degrees([angle for _, _, angle in one.purpose.poses])
            assert np.abs(angles - angles.round()).max() < 1e-9
            assert one.title == f"{scene.title}, with other poses"
        else:
            assert isinstance(one.purpose, TimeRatioPurpose)
            assert f"{one.purpose.ratio:g}" in one.title


def test_a_function_s_exercise_with_a_seed_has_other_lengths() -> None:
    scene = MADE["function-3"]()
    assert variant(scene, 1, lambda _: True).title == f"{scene.title}, with other lengths"


@pytest.mark.long
@needs_tex
@pytest.mark.parametrize("name", MADE)
def test_the_latex_compiles(name: str, tmp_path: Path) -> None:
    found = solution(PoseRequest(MADE[name](), "phase", 0.5, 2.0))
    (tmp_path / "made.tex").write_text(TEX.document(found), encoding="utf-8")
    done = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "made.tex"],
        cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-2000:]
