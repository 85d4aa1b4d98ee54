"""The pictures of the README are what its commands write; the report's first page is what a report holds."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import numpy as np
import pygame
import pytest
from fidelity import psnr
from numpy.typing import NDArray
from PIL import Image

from linkanim.cli import main

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
ALIKE, PRINTED = 30, 24.5
"""In dB: the same picture on another machine, and the same figure as a browser sets its words."""


def levels(path: Path) -> NDArray[np.float64]:
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGB"), float)


def words_of(page: str) -> str:
    """Return a page's words; what is lowered or raised stands in the word that it belongs to."""
    bare = re.sub(r"<style>.*?</style>|</?(tspan|sub|sup)\b[^>]*>", "", page, flags=re.DOTALL)
    return re.sub(r"<[^>]*>", " ", bare)


@pytest.mark.parametrize("line", re.findall(r"linkanim (.* -o recordings/.*\.png)$", README, re.MULTILINE))
def test_a_picture_is_what_its_command_writes(line: str, tmp_path: Path) -> None:
    words = shlex.split(line)
    kept, made = ROOT / words[-1], tmp_path / "made.png"
    assert main([*words[:-1], str(made)]) == 0
    assert levels(kept).shape == levels(made).shape
    assert psnr(levels(kept), levels(made)) > ALIKE, f"make it anew: linkanim {line}"


@pytest.mark.long
@pytest.mark.slow
def test_the_printed_page_is_the_report_s(tmp_path: Path) -> None:
    """Its words were read off the page when it was printed, and are kept in the picture's file."""
    (line,) = re.findall(r"linkanim (report press .*) -o press-report$", README, re.MULTILINE)
    report = tmp_path / "press-report"
    assert main([*shlex.split(line), "-o", str(report)]) == 0
    with Image.open(ROOT / "recordings" / "press-report.png") as page:
        printed, place = page.info["words"].split(), page.info["figure"].split()
        left, top, right, bottom = (round(float(side)) for side in place)
        theirs = np.asarray(page.convert("RGB").crop((left, top, right, bottom)), float)
    written = set(words_of((report / "report.html").read_text(encoding="utf-8")).split())
    assert "67.2126" in printed
    assert [word for word in printed if word not in written] == [], "make it anew: .ci/report-page"
    figure = pygame.image.load(report / "figure.svg")
    drawn = pygame.transform.smoothscale(figure, (right - left, bottom - top))
    mine = pygame.surfarray.array3d(drawn).transpose(1, 0, 2).astype(float)
    assert psnr(mine, theirs) > PRINTED, "make it anew: .ci/report-page"
