"""A PDF whose words LaTeX sets: where they stand, what is said of other files, and that it is set at all."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from test_pdf import content
from tex import needs_tex

from linkanim.cli import main
from linkanim.paper.figure import Figured
from linkanim.paper.latex import WIDER, latex_of, words
from linkanim.picture.items import Caption, Halo
from linkanim.picture.layout import SMALL, layout
from linkanim.picture.look import Look
from linkanim.picture.purpose import PURPOSES
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
    assert found[4] == r"\linkanimsize \textbf{\boldmath $v_{BA}$ = 3\textdegree{}}"


# Symbols are mathematics; words, numbers and units are not.
SET = [
    ("r₃ = 85 mm", r"$r_{3}$ = 85 mm"),
    ("e = 20 mm, O₂ to the guide of B", r"$e$ = 20 mm, $O_{2}$ to the guide of $B$"),
    ("aⁿ_{PA}", r"$a^{n}_{PA}$"),
    ("h″₃", r"$h''_{3}$"),
    ("r_{A′B}", r"$r_{A'B}$"),
    ("θ₂ = −60.0°", r"$\theta_{2}$ = $-$60.0\textdegree{}"),
    ("A", "$A$"),
    ("r₆ = 70 mm, P off A–B", r"$r_{6}$ = 70 mm, $P$ off $A$--$B$"),
    ("A crank turns", "A crank turns"),
    ("s = 65.0 mm", "$s$ = 65.0 mm"),
    ("crank", "crank"),
    ("100 mm/s²", "100 mm/s$^{2}$"),
    ("F_{return} (N)", r"$F_{\mathrm{return}}$ (N)"),
    ("Rocker: angular velocity ω₄ (rad/s)", r"Rocker: angular velocity $\omega_{4}$ (rad/s)"),
    ("1.4 at 1.163 s, 5 N", "1.4 at 1.163 s, 5 N"),
    ("time (s)", "time (s)"),
    ("100% & #", r"100\% \& \#"),
    ("v_{$x$}", r"$v_{\mathrm{\$x\$}}$"),
]


@pytest.mark.parametrize(("text", "latex"), SET)
def test_symbols_are_set_as_mathematics(text: str, latex: str) -> None:
    assert latex_of(text) == latex


def test_names_are_larger_than_dimensions_and_have_a_rim_that_is_not_read() -> None:
    halo = Halo((255, 255, 255), 2.0)
    name = Caption("B", (450, 140), 24, (0, 0, 0), "centre", strong=True, halo=halo)
    small = Caption("r₃ = 85 mm", (450, 240), 20, (0, 0, 0), "centre", strong=True, halo=halo)
    text = words(SIZE, [name, small], "a.pdf", 84.0)
    first, second = PUT.findall(text)
    assert re.fullmatch(r"\\linkanimlarger \\linkanimhalo\{1.000 1.000 1.000\}\{[\d.]+\}\{\$B\$\}", first[4])
    assert re.fullmatch(
        r"\\linkanimsize \\linkanimhalo\{[\d. ]+\}\{[\d.]+\}\{\$r_\{3\}\$ = 85 mm\}", second[4]
    )
    assert r"\setlength{\unitlength}{84.00mm}" in text
    assert "/ActualText <FEFF>" in text


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
        size = PURPOSES["book"].size(SIZE)
        larger = WIDER * PURPOSES["book"].type_scale(SMALL * layout(size).unit)
        look = Look(names=2, polygons=True, hud=False, background=False, type_scale=larger)
        shown = Figured(load("press"), size, look, 1.5184364492350666)
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
@needs_tex
@pytest.mark.skipif(not shutil.which("pdftotext"), reason="needs poppler")
def test_latex_sets_it(tmp_path: Path) -> None:
    pytest.importorskip("fpdf")
    assert main([*FIGURE, "-o", str(tmp_path / "figure.pdf"), "--text", "latex"]) == 0
    body = r"\def\svgwidth{80mm}\input{figure.pdf_tex}"
    packages = r"\usepackage{graphicx,color}"
    (tmp_path / "page.tex").write_text(
        rf"\documentclass{{article}}{packages}\begin{{document}}{body}\end{{document}}"
    )
    command = ["pdflatex", "-halt-on-error", "-interaction=nonstopmode", "page.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]
    assert b"Overfull" not in done.stdout
    read = subprocess.run(["pdftotext", "page.pdf", "-"], cwd=tmp_path, capture_output=True, check=True)
    assert len(re.findall(r"283\s+mm", read.stdout.decode())) == 1


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="needs poppler")
def test_each_word_of_a_pdf_is_copied_once(tmp_path: Path) -> None:
    pytest.importorskip("fpdf")
    target = tmp_path / "figure.pdf"
    command = ["draw", "crank-rocker", "--phase", "60 deg", "--names", "--names", "--for", "book"]
    assert main([*command, "-o", str(target)]) == 0
    read = subprocess.run(["pdftotext", str(target), "-"], capture_output=True, check=True).stdout.decode()
    for said in ("coupler", "r3 = 85 mm", "r6 = 70 mm", "rocker"):
        assert read.count(said) == 1
