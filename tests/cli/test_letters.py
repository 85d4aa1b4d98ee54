"""Letters that a font lacks are named in a sentence with the way out, and their place is seen."""

from __future__ import annotations

import re
import zlib
from base64 import b64decode
from io import BytesIO
from pathlib import Path

import pygame
import pytest
from fontTools.ttLib import TTFont

from linkanim.cli import main
from linkanim.explain.formula import latex_has
from linkanim.letters import LATEX, PDF, lacking, spelt
from linkanim.paper.pdf import pdf
from linkanim.paper.svg import svg
from linkanim.picture import text
from linkanim.picture.items import Caption, Halo
from linkanim.picture.text import JOINS, Fonts, Type, glyphs_of

SCENE = """
title = "四杆机构 with θ, Ж and é"
length_unit = "mm"
[ground]
O = [0, 0]
"乙" = [100, 0]
[joints."甲"]
crank = "O"
length = 30
[joints."丙"]
from = ["甲", "乙"]
length = [90, 80]
[bodies]
"曲柄" = { joints = ["O", "甲"] }
"连杆" = { joints = ["甲", "丙"] }
"摇杆" = { joints = ["乙", "丙"] }
"""
OF_JOINTS = "乙甲丙"
SHOWN = ["--names", "--no-hud"]

# A command, whether the system has no font for Chinese, the letters that are named, and the way out.
INSTALL = "? stands for them: install one that has them"
LOST: dict[str, tuple[list[str], bool, str, str]] = {
    "a figure as PDF": (["draw", "--names", "-o", "a.pdf"], True, OF_JOINTS, INSTALL),
    "a figure as PDF, with a font": (["draw", "--names", "-o", "a.pdf"], False, "", ""),
    "without names": (["draw", "-o", "a.pdf"], True, "", ""),
    "a figure as SVG": (["draw", "--names", "-o", "a.svg"], True, "", ""),
    "a figure as PNG": (["draw", "--names", "-o", "a.png"], True, OF_JOINTS, INSTALL),
    "for LaTeX": (
        ["draw", "--names", "--text", "latex", "-o", "a.pdf"],
        False,
        OF_JOINTS,
        "they are kept: run xelatex or lualatex",
    ),
    "a chart as PDF": (["chart", "--quantity", "丙.velocity", "-o", "a.pdf"], True, "丙", INSTALL),
    "a recording": (
        ["record", "-o", "a.gif", "--size", "320x180", "--seconds", "0.1"],
        True,
        "四杆机构",
        INSTALL,
    ),
    "parts to cut": (["make", "-o", "parts", "--fit", "A4"], True, "四杆机构连摇", INSTALL),
    "parts on a laser": (["make", "-o", "parts", "--way", "laser"], True, "", ""),
    "a picture of parts": (["make", "--preview", "a.pdf"], True, "甲", INSTALL),
    "a solution": (["explain", "-o", "a.tex"], False, "四杆机构" + OF_JOINTS, "they are kept: run xelatex"),
    "a page": (["explain", "-o", "a.html"], True, "", ""),
}


@pytest.mark.parametrize(("words", "bare", "letters", "way_out"), LOST.values(), ids=LOST)
def test_letters_that_are_lacking_are_named_with_the_way_out(
    words: list[str],
    bare: bool,
    letters: str,
    way_out: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    if bare:
        monkeypatch.setattr(text, "_WIDE", ())
    Path("scene.toml").write_text(SCENE, encoding="utf-8")
    assert main([words[0], "scene.toml", *words[1:]]) == 0
    said = [line for line in capsys.readouterr().err.splitlines() if "the letters" in line]
    assert len(said) == bool(letters)
    for line in said:
        named = re.split(r"the letters |;", line)[1]
        assert set(letters) <= set(named)
        assert not set("θéA") & set(named)
        assert ("Ж" in named) == (words[0] == "explain")
        assert f"; {way_out}" in line


# Each as it is set by a font with the ASCII characters alone.
@pytest.mark.parametrize(
    ("char", "is_set"),
    [
        ("a", "a"),
        ("é", "?"),
        ("ﬁ", "fi"),
        ("Ａ", "A"),
        ("\u3000", " "),
        ("\u200b", ""),
        ("\u0301", ""),
        ("曲", "?"),
    ],
)
def test_a_letter_is_set_spelt_or_stood_for(char: str, is_set: str) -> None:
    assert spelt(char, str.isascii) == is_set
    assert lacking(char, str.isascii) == (char if is_set == "?" else "")


def test_a_long_list_of_letters_is_cut_and_an_empty_one_is_no_sentence() -> None:
    assert PDF.sentence("") == ""
    many = "".join(chr(0x4E00 + n) for n in range(40))
    said = LATEX.sentence(many)
    assert said.startswith("LaTeX's standard fonts lack the letters 一, 丁, ")
    assert " and 28 more; they are kept: run xelatex" in said
    assert lacking("aéθ曲", latex_has) == "曲"


def _set_in(document: bytes) -> list[bytes]:
    """Return the words of a PDF as they are set, in the codes of its faces."""
    packed = re.findall(rb"stream\r?\n(.*?)\r?\nendstream", document, re.DOTALL)
    plain = [zlib.decompressobj().decompress(one) for one in packed if one[:1] == b"\x78"]
    return [word for one in plain for word in re.findall(rb"\((.*?)\) Tj", one, re.DOTALL)]


def test_the_words_of_a_pdf_have_a_sign_for_each_letter_that_no_font_has(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(text, "_WIDE", ())
    names = {}
    for called, other in (("with", "甲"), ("without", "?"), ("none", "A")):
        Path("scene.toml").write_text(SCENE.replace("甲", other), encoding="utf-8")
        assert main(["draw", "scene.toml", "--names", "--angle", "60 deg", "-o", f"{called}.pdf"]) == 0
        names[called] = _set_in(Path(f"{called}.pdf").read_bytes())
    assert names["with"] == names["without"] != names["none"]


@pytest.fixture
def of_the_system(monkeypatch: pytest.MonkeyPatch) -> str:
    """A font of pygame's in place of the system's: it has a long s, which the bundled face lacks."""
    path = str(Path(pygame.__file__).with_name(pygame.font.get_default_font()))
    monkeypatch.setattr(pygame.font, "get_fonts", lambda: ["notosans"])
    monkeypatch.setattr(pygame.font, "match_font", lambda name: path)
    return path


@pytest.mark.usefixtures("of_the_system")
def test_a_pdf_and_an_svg_carry_the_letters_of_a_font_of_the_system() -> None:
    line = Caption("Wa\u017f\u017fer", (50, 50), 20, (0, 0, 0), "left", True, Halo((255, 255, 255), 2.0))
    document = pdf((400, 200), None, [line], title="words")
    assert b"FreeSansBold" in document
    assert len(_set_in(document)) == 3
    page = svg((400, 200), None, [line], title="words")
    assert "font-family:'Further Letters';unicode-range:U+17F;" in page
    (part,) = re.findall("U\\+17F;src:url\\(data:font/ttf;base64,([^)]*)", page)
    assert set(TTFont(BytesIO(b64decode(part))).getBestCmap()) == {0x17F}


@pytest.mark.skipif(not Fonts().has("م") or not JOINS, reason="needs a font with Arabic, and pygame-ce")
def test_arabic_is_joined_and_runs_from_right_to_left_and_a_pdf_says_that_it_cannot(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    kind = Type()
    joined, apart = kind.width("ذراع", 40), sum(kind.width(char, 40) for char in "ذراع")
    assert joined < 0.95 * apart
    monkeypatch.chdir(tmp_path)
    Path("scene.toml").write_text(SCENE.replace("甲", "ذراع"), encoding="utf-8")
    assert main(["draw", "scene.toml", "--names", "-o", "a.png"]) == 0
    assert "join" not in capsys.readouterr().err
    assert main(["draw", "scene.toml", "--names", "-o", "a.pdf"]) == 0
    said = "a PDF does not join the letters ذ, ر, ا, ع; ? stands for them: write an SVG or a PNG"
    assert said in capsys.readouterr().err


# what is drawn at once
@pytest.mark.parametrize(
    ("words", "glyphs"),
    [
        ("O4 a", ["O", "4", " ", "a"]),
        ("曲柄", ["曲", "柄"]),
        ("ذراع", ["ذراع"]),
        # words of one script stay in their order, a space at the end is not theirs
        ("مرحبا بك O", ["مرحبا بك", " ", "O"]),
        # two scripts are two stretches
        ("שלום م", ["שלום", " ", "م"]),
    ],
)
def test_letters_that_join_are_drawn_at_once(words: str, glyphs: list[str]) -> None:
    assert glyphs_of(words) == glyphs
