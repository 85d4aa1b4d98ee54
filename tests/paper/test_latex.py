"""A PDF whose words LaTeX sets: where they stand, what is said of other files, and that it is set at all."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from test_pdf import content

from linkanim.cli import main
from linkanim.paper.figure import Figured
from linkanim.paper.latex import words
from linkanim.picture.items import Caption
from linkanim.picture.look import Look
from linkanim.picture.text import typesetting
from linkanim.scenes import load

PUT = re.compile(
    r"\\put\(([\d.-]+),([\d.-]+)\)\{\\color\[rgb\]\{([\d.,]+)\}\\makebox\[0pt\]\[(\w)\]\{(.*)\}\}%"
)
SIZE = (900, 560)
FIGURE = ("draw", "press", "--angle", "87 deg", "--names", "--names", "--polygons", "--size", "900x560")
CHART = ("chart", "press", "--quantity", "3.angular_velocity", "--size", "900x450")


def test_a_line_stands_where_the_picture_has_it() -> None:
    line = Caption("v_{BA} = 3°", (450, 140), 20, (255, 0, 51), "centre", strong=True)
    (found,) = PUT.findall(words(SIZE, [line, line._replace(text="")], "a.pdf"))
    assert float(found[0]) == pytest.approx(0.5)
    assert float(found[1]) == pytest.approx((560 - 140 - typesetting(20).baseline) / 900, abs=1e-5)
    assert found[2:4] == ("1.000,0.000,0.200", "c")
    assert found[4].endswith(r"\textbf{v\textsubscript{BA} = 3\textdegree{}}")


@pytest.mark.parametrize("command", [FIGURE, CHART], ids=["a figure", "a chart"])
@pytest.mark.slow
def test_all_words_stand_beside_the_picture_and_none_in_it(
    command: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("fpdf")
    target = tmp_path / "figure-1.pdf"
    assert main([*command, "-o", str(target), "--text", "latex"]) == 0
    assert capsys.readouterr().out.splitlines() == [str(target), f"{target}_tex"]
    drawn = content(target.read_bytes())
    assert not re.search(r"\bTj\b|\bTJ\b", drawn)
    text = (tmp_path / "figure-1.pdf_tex").read_text(encoding="utf-8")
    assert r"\includegraphics[width=\unitlength]{figure-1.pdf}" in text
    assert text.count(r"\put") == 1 + len(PUT.findall(text))
    assert len(PUT.findall(text)) > 10
    if command is FIGURE:
        shown = Figured(load("press"), SIZE, Look(names=2, polygons=True, hud=False), 1.5184364492350666)
        captions = [line for group in shown.groups() for line in group.captions if line.text]
        assert len(captions) == len(PUT.findall(text))


@pytest.mark.parametrize(
    ("name", "why"),
    [("figure.svg", "goes with a PDF"), ("50%.pdf", "LaTeX cannot name"), ("a#b.pdf", "LaTeX cannot name")],
)
def test_another_file_is_refused_before_anything_is_written(
    name: str, why: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*FIGURE, "-o", str(tmp_path / name), "--text", "latex"]) == 2
    assert why in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("pdflatex"), reason="needs LaTeX")
def test_latex_sets_it(tmp_path: Path) -> None:
    pytest.importorskip("fpdf")
    assert main([*FIGURE, "-o", str(tmp_path / "figure.pdf"), "--text", "latex"]) == 0
    body = r"\def\svgwidth{80mm}\input{figure.pdf_tex}"
    packages = r"\usepackage{graphicx,xcolor,lmodern}\usepackage[T1]{fontenc}"
    (tmp_path / "page.tex").write_text(
        rf"\documentclass{{article}}{packages}\begin{{document}}{body}\end{{document}}"
    )
    command = ["pdflatex", "-halt-on-error", "-interaction=nonstopmode", "page.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]
    assert b"Overfull" not in done.stdout
