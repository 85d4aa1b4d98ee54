"""Figures and charts for a book's column, a page and a slide: their width, letters and ground."""

from __future__ import annotations

import re
import struct
from pathlib import Path

import pygame
import pytest

from linkanim.cli import main
from linkanim.picture.purpose import PURPOSES

DRAW = ("draw", "crank-rocker", "--phase", "60 deg", "--names", "--names")
CHART = ("chart", "crank-rocker", "--quantity", "rocker.angle,rocker.angular_velocity")
COMMANDS = [DRAW, CHART]
IDS = ["a figure", "a chart"]
MM = 72 / 25.4
"""Points in a millimetre."""


def written(command: tuple[str, ...], purpose: str, target: Path, *more: str) -> bytes:
    assert main([*command, "--for", purpose, *more, "-o", str(target)]) == 0
    return target.read_bytes()


def letters(svg: str, wide: float) -> list[float]:
    """Return the sizes of letters in points on paper, subscripts left out."""
    pixels = float(re.findall(r'viewBox="0 0 (\d+)', svg)[0])
    return [float(em) / pixels * wide * MM for em in re.findall(r'<text [^>]*font-size="([\d.]+)"', svg)]


@pytest.mark.parametrize("command", COMMANDS, ids=IDS)
@pytest.mark.parametrize("purpose", PURPOSES)
def test_an_svg_is_as_wide_and_its_letters_as_large_as_its_purpose_asks(
    command: tuple[str, ...], purpose: str, tmp_path: Path
) -> None:
    asked = PURPOSES[purpose]
    svg = written(command, purpose, tmp_path / "a.svg").decode()
    (wide,) = re.findall(r'<svg [^>]*width="([\d.]+)mm"', svg)
    assert float(wide) == pytest.approx(asked.wide, abs=0.1)
    sizes = letters(svg, asked.wide)
    assert min(sizes) == pytest.approx(asked.points, rel=0.05)
    assert max(sizes) < 1.6 * asked.points
    assert ("<rect" in svg) == asked.ground


@pytest.mark.parametrize("command", COMMANDS, ids=IDS)
def test_a_png_says_how_many_dots_lie_in_an_inch_and_has_no_ground(
    command: tuple[str, ...], tmp_path: Path
) -> None:
    png = written(command, "book", tmp_path / "a.png", "--size", "200x100")
    across, down, metre = struct.unpack(">IIB", png.split(b"pHYs")[1][:9])
    assert (across, metre) == (down, 1)
    picture = pygame.image.load(str(tmp_path / "a.png"))
    assert picture.get_size() == (992, 496)  # the size is the shape
    assert 1000 * 992 / across == pytest.approx(84, abs=0.1)
    assert picture.get_at((0, 0)).a == 0


def test_a_pdf_s_page_is_as_wide_as_the_column(tmp_path: Path) -> None:
    pytest.importorskip("fpdf")
    document = written(DRAW, "book", tmp_path / "a.pdf").decode("latin-1")
    (box,) = re.findall(r"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", document)
    assert [float(side) for side in box] == pytest.approx([84 * MM, 63 * MM], abs=0.1)


# Nothing grey lies behind words on white paper: their rims are white.
def test_on_paper_rims_are_white(tmp_path: Path) -> None:
    svg = written(DRAW, "book", tmp_path / "a.svg").decode()
    assert set(re.findall(r'stroke="(#\w+)"', svg)) == {"#ffffff"}
    assert "#fcfcfa" not in svg
    assert "#fcfcfa" not in written(CHART, "book", tmp_path / "b.svg").decode()


def test_a_construction_is_drawn_for_a_slide_too(tmp_path: Path) -> None:
    command = ("draw", "slider-crank", "--construction", "dead-centres")
    svg = written(command, "slide", tmp_path / "a.svg").decode()
    assert min(letters(svg, PURPOSES["slide"].wide)) > 15
