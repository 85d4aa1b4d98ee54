"""Slides: other programs open them, each has its loop, and under a title there is room for it."""

from __future__ import annotations

import shutil
import subprocess
from io import BytesIO
from pathlib import Path
from zipfile import ZipFile

import pytest
from PIL import Image
from pptx import Presentation
from pptx.enum.shapes import MSO_SHAPE_TYPE

from linkanim.cli import main
from linkanim.paper.deck import DeckSlide, below_title, deck

SHAPE = (320, 180)


def gif(colour: tuple[int, int, int], size: tuple[int, int] = SHAPE) -> bytes:
    """Return two frames of a colour, which loop."""
    kept = BytesIO()
    frames = [Image.new("RGB", size, one) for one in (colour, (0, 0, 0))]
    frames[0].save(kept, "GIF", save_all=True, append_images=frames[1:], loop=0, duration=100)
    return kept.getvalue()


RED, BLUE = gif((255, 0, 0)), gif((0, 0, 255), below_title(SHAPE))


@pytest.mark.parametrize("titled", [False, True])
def test_a_slide_has_its_loop_its_title_and_notes(titled: bool) -> None:
    slides = [DeckSlide(RED, SHAPE, "A & <B>", 'first "note"'), DeckSlide(RED, SHAPE, "B", "second")]
    shown = Presentation(BytesIO(deck(slides, SHAPE, titled=titled)))
    assert (shown.slide_width, shown.slide_height) == (12_192_000, 6_858_000)
    assert len(shown.slides) == 2
    for slide, wanted in zip(shown.slides, slides, strict=True):
        (picture,) = [shape for shape in slide.shapes if shape.shape_type == MSO_SHAPE_TYPE.PICTURE]
        assert picture.image.blob == RED
        assert picture.width / picture.height == pytest.approx(16 / 9, rel=1e-4)
        assert slide.notes_slide.notes_text_frame.text == wanted.notes
        if not titled:
            assert slide.shapes.title is None
            assert (picture.left, picture.top, picture.width) == (0, 0, shown.slide_width)
        else:
            assert slide.shapes.title.text == wanted.title
            assert picture.top >= slide.shapes.title.top + slide.shapes.title.height
            assert picture.top + picture.height <= 6_858_000


def test_a_loop_below_a_title_fills_what_is_left() -> None:
    shown = Presentation(BytesIO(deck([DeckSlide(BLUE, below_title(SHAPE), "T", "")], SHAPE, titled=True)))
    title, picture = shown.slides[0].shapes
    assert 0 <= picture.top - title.height < 0.01 * 6_858_000
    assert picture.width > 0.99 * 12_192_000


def test_the_same_slides_have_the_same_bytes() -> None:
    assert deck([DeckSlide(RED, SHAPE, "T", "")], SHAPE) == deck([DeckSlide(RED, SHAPE, "T", "")], SHAPE)


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("soffice") is None, reason="needs LibreOffice")
def test_another_program_draws_the_slides(tmp_path: Path) -> None:
    (tmp_path / "a.pptx").write_bytes(deck([DeckSlide(RED, SHAPE, "T", "said")], SHAPE))
    home = f"-env:UserInstallation=file://{tmp_path}/home"
    words = ["soffice", home, "--headless", "--convert-to", "png", "--outdir", str(tmp_path)]
    subprocess.run([*words, str(tmp_path / "a.pptx")], check=True, capture_output=True)
    with Image.open(tmp_path / "a.png") as picture:
        assert picture.convert("RGB").getpixel((picture.width // 2, picture.height // 2)) == (255, 0, 0)


@pytest.mark.parametrize("titles", [[], ["--titles"]])
def test_scenes_are_recorded_onto_slides(titles: list[str], tmp_path: Path) -> None:
    words = ["record", "kite", "crank-rocker", *titles, "-o", str(tmp_path / "a.pptx"), "--size", "320x180"]
    assert main([*words, "--fps", "5"]) == 0
    with ZipFile(tmp_path / "a.pptx") as file:
        for n in (1, 2):
            with Image.open(BytesIO(file.read(f"ppt/media/image{n}.gif"))) as loop:
                assert loop.info["loop"] == 0
                assert loop.size == (below_title(SHAPE) if titles else SHAPE)
    assert [path.name for path in tmp_path.iterdir()] == ["a.pptx"]


# words, and what is said of them
REFUSED = [
    ("kite crank-rocker -o a.gif", "several scenes are for slides; write them with -o a.pptx"),
    ("kite --titles", "--titles is for slides; write them with -o kite.pptx"),
    ("kite no-such-scene -o a.pptx", "no-such-scene"),
    ("kite -o a.pdf --max-size 1MB", "the pages of a PDF are a scene's motion"),
    ("kite -o a.png --max-size 1MB", "--max-size is for one file"),
    ("kite --max-size 1", '"1" is not the size of a file; write it as 1MB or 800kB'),
    pytest.param(
        "kite --size 160x90 --max-size 0.1kB", "raise it, or record a shorter period", marks=pytest.mark.slow
    ),
]


@pytest.mark.parametrize(("words", "sentence"), REFUSED)
def test_what_slides_and_limits_cannot_be_is_said_and_nothing_is_written(
    words: str,
    sentence: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["record", *words.split()]) == 2
    assert sentence in capsys.readouterr().err
    assert not any(tmp_path.iterdir())


@pytest.mark.slow
def test_a_recording_keeps_to_the_largest_size_that_is_allowed(tmp_path: Path) -> None:
    path = tmp_path / "a.gif"
    assert main(["record", "kite", "-o", str(path), "--size", "320x180", "--max-size", "40kB"]) == 0
    assert path.stat().st_size <= 40_000
    with Image.open(path) as picture:
        assert picture.info["loop"] == 0
        assert picture.size[0] / picture.size[1] == pytest.approx(16 / 9, rel=0.02)
