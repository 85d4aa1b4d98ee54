"""Photographs from outside: read at most so large, as the camera held them, and refused in a sentence."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable
from pathlib import Path
from random import Random

import numpy as np
import pygame
import pytest
from numpy.typing import NDArray
from PIL import Image

from linkanim.build.draft import Photo
from linkanim.errors import BadInput
from linkanim.picture.photograph import Photograph, lack, refuse_lacking
from linkanim.picture.view import View

PAPER = (255, 255, 255)
Places = NDArray[np.int64]
Content = bytes | tuple[int, int] | Callable[[], bytes]
"""What stands in a file, the size of a JPEG, or what makes it: of that which is large, when it is wanted."""


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width: int, height: int, rows: bytes = b"\0\0") -> bytes:
    """Return a picture of one bit a pixel that says so in its header; its rows may be others."""
    header = struct.pack(">IIBBBBB", width, height, 1, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        chunk(*one) for one in ((b"IHDR", header), (b"IDAT", zlib.compress(rows)), (b"IEND", b""))
    )


def bmp(width: int, height: int) -> bytes:
    info = struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, 0, 0, 0, 0, 0)
    return b"BM" + struct.pack("<IHHI", 54 + 100, 0, 0, 54) + info + bytes(100)


def webp(width: int, height: int) -> bytes:
    sides = (width - 1).to_bytes(3, "little") + (height - 1).to_bytes(3, "little")
    body = b"WEBPVP8X" + struct.pack("<IB3x", 10, 0) + sides
    return b"RIFF" + struct.pack("<I", len(body)) + body


def jpeg(width: int, height: int) -> bytes:
    """Return a small picture whose header says that it is another size."""
    path = Path("small.jpg")
    Image.new("RGB", (64, 48), "red").save(path)
    data = path.read_bytes()
    at = data.index(b"\xff\xc0") + 5
    return data[:at] + struct.pack(">HH", height, width) + data[at + 4 :]


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def shown(file: str, size: tuple[int, int], width: float) -> Places:
    """Return what is seen of a photograph so wide on a surface, from its lower left corner: x, y, colour."""
    surface = pygame.Surface(size, 0, 32)
    Photograph(Photo(file, (0.0, 0.0), width), View(1.0, 0.0, float(size[1])), PAPER).draw(surface)
    return np.asarray(pygame.surfarray.array3d(surface), np.int64)


# Read whole, each would take gigabytes, or end the program.
TOO_LARGE = {
    "a line of 200,000": ("a.png", png(200_000, 1, b"\0" + bytes(25_000))),
    "a billion pixels in 300 kB": ("a.png", lambda: png(50_000, 50_000, bytes(6_251) * 50_000)),
    "400 million pixels": ("a.png", png(20_000, 20_000)),
    "just above": ("a.png", png(6_401, 6_250)),
    "one row too many": ("a.png", png(1, 16_385)),
    "a bitmap": ("a.bmp", bmp(30_000, 30_000)),
    "a bitmap, upside down": ("a.bmp", bmp(30_000, -30_000)),
    "a wide one": ("a.webp", webp(16_000, 16_000)),
    "as large as its format has": ("a.jpg", (65_500, 65_500)),
    "a panorama": ("a.jpg", (16_385, 100)),
}


@pytest.mark.parametrize(("name", "content"), TOO_LARGE.values(), ids=TOO_LARGE)
def test_a_picture_too_large_is_refused_by_its_header(name: str, content: Content) -> None:
    made = jpeg(*content) if isinstance(content, tuple) else content
    Path(name).write_bytes(made() if callable(made) else made)
    sentence = lack(name)
    assert sentence
    assert sentence.startswith(f"{name}: is ")
    assert "million pixels at the most, and 16,384 along a side; the sheet goes on" in sentence
    most = {"png": 40, "bmp": 40, "webp": 16, "jpg": 65}[name[2:]]
    with pytest.raises(BadInput, match=rf"make it smaller: {most} million pixels"):
        refuse_lacking(name)


def test_a_picture_as_large_as_allowed_is_read(here: Path) -> None:
    Path("a.png").write_bytes(png(16_384, 2, 2 * (b"\0" + b"\xff" * 2_048)))
    assert lack("a.png") is None
    assert (shown("a.png", (9, 1), 16_384)[3, 0] == 255).all()


@pytest.mark.parametrize("turn", range(1, 9))
def test_a_picture_stands_as_the_camera_was_held(turn: int, here: Path) -> None:
    # what the camera saw: red, green above blue, black
    upright = Image.new("RGB", (20, 20))
    for n, colour in enumerate(("#ff0000", "#00ff00", "#0000ff", "#000000")):
        upright.paste(colour, (n % 2 * 10, n // 2 * 10, n % 2 * 10 + 10, n // 2 * 10 + 10))
    as_kept = {
        **{1: None, 2: Image.Transpose.FLIP_LEFT_RIGHT, 3: Image.Transpose.ROTATE_180},
        **{4: Image.Transpose.FLIP_TOP_BOTTOM, 5: Image.Transpose.TRANSPOSE, 6: Image.Transpose.ROTATE_90},
        **{7: Image.Transpose.TRANSVERSE, 8: Image.Transpose.ROTATE_270},
    }[turn]
    kept = upright.transpose(as_kept) if as_kept is not None else upright
    exif = Image.Exif()
    exif[0x0112] = turn
    kept.save(here / "held.png", exif=exif)
    found = shown("held.png", (20, 20), 20)
    corners = [found[x, y] for x, y in ((5, 5), (15, 5), (5, 15), (15, 15))]
    assert [colour.tolist() for colour in np.subtract(corners, np.min(corners)) // 100] == [
        *([1, 0, 0], [0, 1, 0], [0, 0, 1]),
        [0, 0, 0],
    ]


def test_a_note_on_how_it_was_held_that_is_damaged_harms_nothing(here: Path) -> None:
    Image.new("RGB", (30, 20), "red").save(here / "a.jpg", exif=b"Exif\0\0II*\0\xff\xff\xff\xff" + bytes(30))
    assert lack("a.jpg") is None


# However a picture holds its pixels: what is seen at its middle, as it shows through white paper.
GREY = 255 - round(0.45 * (255 - 100))
FORMS = {
    "colours": (Image.new("RGB", (40, 30), (100, 100, 100)), "png", GREY),
    "greys": (Image.new("L", (40, 30), 100), "jpg", GREY),
    "16 bits": (Image.fromarray(np.full((30, 40), 100 * 256 + 200, np.uint16)), "png", GREY),
    "bits": (Image.new("1", (40, 30), 1), "bmp", 255),
    "a palette": (Image.new("RGB", (40, 30), (100, 100, 100)).convert("P"), "png", GREY),
    "four inks": (Image.new("CMYK", (40, 30), (0, 0, 0, 155)), "jpg", GREY),
    "clear": (Image.new("RGBA", (40, 30), (100, 100, 100, 0)), "webp", 255),
    "large, and half clear": (Image.new("RGBA", (5_000, 900), (100, 100, 100, 128)), "png", (255 + GREY) / 2),
}


@pytest.mark.parametrize(("picture", "suffix", "grey"), FORMS.values(), ids=FORMS)
def test_however_a_picture_holds_its_pixels_it_shows(picture: Image.Image, suffix: str, grey: float) -> None:
    picture.save(f"a.{suffix}")
    assert lack(f"a.{suffix}") is None
    found = shown(f"a.{suffix}", (40, 30), 40)
    assert found[20, 26] == pytest.approx([grey] * 3, abs=2)


ODD = {
    "a name that no disk has": ("n" * 300 + ".png", "cannot be read: file name too long"),
    "no name": ("a\0b.png", "cannot be read: "),
    "a folder": ("folder.png", "is no picture; a photograph is one of .png, .jpg"),
    "below a file": ("text.png/a.png", "is not there"),
    "text": ("text.png", "is no picture; a photograph is one of .png, .jpg"),
    "cut off": ("cut.png", "cannot be read to its end; save it again"),
    "rows of another size": ("lies.png", "cannot be read to its end; save it again"),
}


@pytest.mark.parametrize(("name", "reason"), ODD.values(), ids=ODD)
def test_what_is_no_photograph_is_a_sentence(name: str, reason: str, here: Path) -> None:
    (here / "folder.png").mkdir()
    (here / "text.png").write_text("no picture")
    Image.effect_noise((300, 200), 90).save("whole.png")
    (here / "cut.png").write_bytes((here / "whole.png").read_bytes()[:20_000])
    (here / "lies.png").write_bytes(png(4_000, 3_000))
    sentence = lack(name)
    assert sentence
    assert reason in sentence
    assert (shown(name, (8, 8), 8) == 0).all()


def test_a_photograph_that_comes_or_changes_is_seen(here: Path) -> None:
    assert lack("a.png")
    Image.new("RGB", (20, 20), "red").save("a.png")
    assert lack("a.png") is None
    red = shown("a.png", (20, 20), 20)
    Image.new("RGB", (30, 30), "blue").save("a.png")
    assert (shown("a.png", (20, 20), 20) != red).any()
    Path("a.png").unlink()
    assert (shown("a.png", (20, 20), 20) == 0).all()


@pytest.mark.slow
def test_two_hundred_damaged_pictures_are_each_shown_or_refused(here: Path) -> None:
    random = Random(5)
    plain = Image.effect_noise((60, 40), 90).convert("RGB")
    for number in range(200):
        name = f"{number}{random.choice(('.png', '.jpg', '.bmp', '.webp'))}"
        plain.save(name)
        data = bytearray(Path(name).read_bytes())
        for _ in range(random.choice((1, 3, 30))):
            at = random.randrange(min(len(data), random.choice((30, 300, 10**6))))
            data[at] = random.randrange(256)
        data = data[: random.choice((len(data), random.randrange(len(data))))]
        Path(name).write_bytes(data)
        sentence = lack(name)
        shown(name, (30, 20), 30)
        assert sentence is None or sentence.startswith(f"{name}: ")
        assert Path(name).read_bytes() == data
