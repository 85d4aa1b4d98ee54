"""PDF: one page as large as the picture, its paths and words, and what is said without the extra."""

from __future__ import annotations

import re
import zlib
from pathlib import Path

import numpy as np
import pytest

from linkanim.cli import main
from linkanim.errors import BadInput
from linkanim.paper.figure import Figured
from linkanim.paper.pdf import pdf, require_pdf
from linkanim.paper.write import data
from linkanim.picture.items import Caption, Group, Halo
from linkanim.picture.look import Look
from linkanim.picture.raster import Layer
from linkanim.picture.text import Anchor, Type, typesetting
from linkanim.scenes import load

SQUARE = np.array([10, 30, 30 + 20j, 10 + 20j], complex)


def content(document: bytes) -> str:
    """Return what the page draws."""
    streams = re.findall(rb"stream\r?\n(.*?)\r?\nendstream", document, re.DOTALL)
    # a stream that ends in a carriage return has lost it here
    found = [zlib.decompressobj().decompress(stream) for stream in streams if stream[:1] == b"x"]
    return next(text.decode("latin-1") for text in found if re.search(rb" m\b|\bBT\b", text))


def test_a_page_is_as_large_as_the_picture_at_96_dots_an_inch() -> None:
    document = pdf((400, 200), (255, 255, 255), [], title="empty")
    assert document.startswith(b"%PDF-")
    assert re.search(rb"/Title \(empty\)", document)
    assert re.search(rb"/MediaBox \[0 0 300(\.00)? 150(\.00)?\]", document)


def test_a_path_stands_where_it_is_and_has_its_colour() -> None:
    drawn = content(pdf((400, 200), None, [Group("square", [Layer((255, 0, 0), [SQUARE])])], title="square"))
    # pixels are 3/4 pt, y counts from the foot
    assert re.search(r"\b10 0 m\b|\b7\.5 150 m\b", drawn)
    assert re.search(r"\b1 0 0 rg\b", drawn)
    assert " f" in drawn
    corners = [(float(x), float(y)) for x, y in re.findall(r"([\d.]+) ([\d.]+) [ml]\b", drawn)]
    assert len(set(corners)) == len(SQUARE)


def test_words_keep_their_subscripts() -> None:
    line = Caption("v_{BA} = 3", (50, 50), 20, (0, 0, 0), "centre", True, Halo((255, 255, 255), 2.0))
    document = pdf((400, 200), None, [line], title="words")
    assert len(re.findall(r"\bTj\b|\bTJ\b", content(document))) == 3


def test_the_background_covers_the_page_in_its_colour_or_is_left_open() -> None:
    square = Layer((255, 0, 0), [SQUARE])
    drawn = content(pdf((400, 200), (255, 0, 51), [square], title="ground"))
    assert re.search(r"\b1 0 0\.2 rg\n0\.00 150\.00 300\.00 -150\.00 re f\b", drawn)
    assert " re f" not in content(pdf((400, 200), None, [square], title="open"))


@pytest.mark.parametrize("background", [True, False])
def test_a_figure_has_the_background_that_is_asked_for(background: bool) -> None:
    drawn = content(data(Figured(load("kite"), (400, 200), Look(background=background), phase=1.0), ".pdf"))
    assert (" re f" in drawn) == background


def test_words_are_as_large_as_on_the_screen_and_stand_there_in_a_halo_as_wide() -> None:
    line = Caption("v_{BA}", (50, 50), 20, (0, 0, 255), "left", True, Halo((255, 255, 0), 2.0))
    drawn, how = content(pdf((400, 200), None, [line], title="words")), typesetting(20)
    small, large = round(0.75 * how.small, 2), round(0.75 * how.em, 2)
    faces = re.findall(r"/F(\d) ([\d.]+) Tf", drawn)
    # Once for each piece or, by fpdf2 2.8.1, where it changes.
    assert list(dict.fromkeys(faces)) == [("2", f"{em:.2f}") for em in (large, small)]
    letters, lowered = (150 - 0.75 * (50 + how.baseline + lower) for lower in (0, how.lower))
    places = [(float(x), float(y)) for x, y in re.findall(r"BT ([\d.]+) ([\d.]+) Td", drawn)]
    assert [y for _, y in places] == [letters, lowered]
    assert places[0][0] == 37.5
    assert places[1][0] - 37.5 == pytest.approx(0.75 * Type().width("v", 20, strong=True), abs=0.75)
    # along the letters a line of twice the halo's width, in pixels; over it the word in its own colour
    assert len(re.findall(r"\b1 1 0 RG\b", drawn)) == 2
    assert drawn.rindex("1 1 0 RG") < drawn.index("BT")
    assert re.search(
        r"(?m)\b4 w\b|/LW 4\b", pdf((400, 200), None, [line], title="words").decode("latin-1") + drawn
    )
    assert len(re.findall(r"q 0 0 1 rg BT [\d.]+ [\d.]+ Td \(", drawn)) == 2


def test_words_are_held_at_their_anchor() -> None:
    anchors: tuple[Anchor, ...] = ("left", "centre", "right")
    lines = [Caption("crank", (200, 50), 20, (0, 0, 0), anchor) for anchor in anchors]
    drawn = content(pdf((400, 200), None, lines, title="words"))
    left, centre, right = (float(x) for x in re.findall(r"BT ([\d.]+) ", drawn))
    assert left == 150 > centre + 10
    assert right == pytest.approx(2 * centre - left, abs=0.02)


def test_what_is_half_seen_through_is_so_in_print() -> None:
    document = pdf((400, 200), None, [Layer((255, 0, 0), [SQUARE], 0.25)], title="veil")
    assert re.search(rb"/ca 0?\.25\b", document)
    opaque = pdf((400, 200), None, [Layer((255, 0, 0), [SQUARE])], title="wall")
    assert set(re.findall(rb"/ca (\S+)", opaque)) <= {b"1"}


@pytest.mark.slow
def test_the_same_figure_has_the_same_bytes() -> None:
    one, two = (
        data(Figured(load("press"), (640, 360), Look(hud=False, names=2), phase=1.0), ".pdf")
        for _ in range(2)
    )
    assert one == two


@pytest.mark.parametrize(
    "words", [["draw", "kite", "--phase", "1 rad"], ["chart", "kite", "--quantity", "rocker.angle"]]
)
def test_commands_write_it(words: list[str], tmp_path: Path) -> None:
    target = tmp_path / "out.pdf"
    assert main([*words, "-o", str(target)]) == 0
    assert target.read_bytes().startswith(b"%PDF-")


def test_without_the_extra_the_way_out_is_told() -> None:
    with pytest.raises(BadInput, match=r'pip install "linkanim\[pdf\]"'):
        require_pdf(lambda name: None)
    require_pdf()


@pytest.mark.parametrize(
    "words",
    [["draw", "kite", "--phase", "1 rad"], ["chart", "kite", "--quantity", "rocker.angle"]],
    ids=str,
)
def test_only_a_pdf_asks_for_the_extra(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing() -> None:
        raise BadInput("no extra")

    monkeypatch.setattr("linkanim.paper.write.require_pdf", missing)
    ends = [main([*words, "-o", str(tmp_path / name)]) for name in ("x.svg", "x.pdf")]
    assert ends == [0, 2]
    assert [path.name for path in tmp_path.iterdir()] == ["x.svg"]
