"""The GIF writer by itself: each colour to the nearest, and every picture as it was, read by Pillow."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from linkanim.recorder import gif
from linkanim.recorder.changes import Change, Comparing, Words, changes
from linkanim.recorder.gif import Job, Nearest, count_pictures, pieces

Colour = tuple[int, int, int]
WHITE, RED, GREEN, BLACK = (255, 255, 255), (255, 0, 0), (0, 128, 0), (0, 0, 0)
PALETTE = (WHITE, RED, GREEN, BLACK)


def job(width: int, height: int, palette: tuple[Colour, ...] = PALETTE, *, alpha: bool = False) -> Job:
    return Job("", width, height, 4, palette, alpha)


def words(rgb: NDArray[np.int64], opacity: int = 0) -> Words:
    red, green, blue = rgb.astype(np.uint32).transpose(2, 0, 1)
    found: Words = np.uint32(opacity << 24) | red << 16 | green << 8 | blue
    return found


def picture(rows: str, opacity: int = 0) -> Words:
    """Return a picture from letters: w, r, g, k; '.' is not opaque."""
    colours = {"w": WHITE, "r": RED, "g": GREEN, "k": BLACK, ".": BLACK}
    lines = rows.split()
    found = words(np.array([[colours[letter] for letter in line] for line in lines]), opacity)
    return np.where(np.array([[letter == "." for letter in line] for line in lines]), np.uint32(0), found)


def changed(frames: Sequence[Words]) -> Iterator[Change]:
    """Tell frames by what changes, through what is a pipe when a scene is recorded."""
    change = Comparing()
    return changes(io.BytesIO(b"".join(change(frame.tobytes()) for frame in frames)), frames[0].size)


def shown(data: bytes, mode: str = "RGB") -> Iterator[NDArray[np.uint8]]:
    with Image.open(io.BytesIO(data)) as image:
        for frame in range(getattr(image, "n_frames", 1)):
            image.seek(frame)
            yield np.asarray(image.convert(mode))


def rgb_of(frame: Words) -> NDArray[np.uint32]:
    return np.stack([frame >> 16 & 255, frame >> 8 & 255, frame & 255], axis=2)


# why, the pictures
SEQUENCES = [
    ("one", ["wr gk"]),
    ("nothing changes", ["wr gk", "wr gk", "wr gk"]),
    ("all changes", ["wwww rrrr", "rrrr gggg", "kkkk wwww"]),
    ("black at the edges of the first", ["kkk kwk kkk", "kkk krk kkk"]),
    ("a corner", ["www www www", "www www wwr", "rww www wwr"]),
    (
        "unchanged runs go on to the left, to the right, on both sides, on neither",
        ["rwww", "rrrr", "wrrw", "gggg"],
    ),
    ("a run over the ends of rows", ["wwwr rwww", "kwwr rwwk", "krrr rrrk"]),
    ("there and back", ["wwww", "wrrw", "wwww", "wrrw"]),
]


@pytest.mark.parametrize(("why", "rows"), SEQUENCES)
def test_every_picture_is_as_it_was(why: str, rows: list[str]) -> None:
    frames = [picture(row) for row in rows]
    height, width = frames[0].shape
    data = b"".join(pieces(job(width, height), changed(frames)))
    assert [found.tolist() for found in shown(data)] == [rgb_of(frame).tolist() for frame in frames]


@pytest.mark.parametrize("count", [1, 2, 3, 4, 7, 8, 127, 128, 254, 255])
@pytest.mark.parametrize("size", [(1, 1), (5, 3), (200, 150)])
def test_any_number_of_colours_comes_out(count: int, size: tuple[int, int]) -> None:
    rng = np.random.default_rng(count)
    palette = rng.permutation(1 << 12)[:count] * 4095  # spread over all colours, each once
    frames = [palette[rng.integers(0, count, size)].astype(np.uint32) for _ in range(3)]
    colours = tuple((int(c) >> 16 & 255, int(c) >> 8 & 255, int(c) & 255) for c in palette)
    data = b"".join(pieces(job(size[1], size[0], colours), changed(frames)))
    assert all((found == rgb_of(frame)).all() for found, frame in zip(shown(data), frames, strict=True))


def test_pictures_with_moving_boxes_are_as_they_were() -> None:
    rng = np.random.default_rng(7)
    frames = [np.full((60, 300), 0xFFFFFF, np.uint32)]
    for _ in range(60):
        frame = frames[-1].copy()
        top, left, colour = (
            rng.integers(0, 50),
            rng.integers(0, 280),
            rng.choice([0xFFFFFF, 0xFF0000, 0x8000]),
        )
        frame[top : top + rng.integers(1, 12), left : left + rng.integers(1, 250)] = colour
        frames.append(frame)
    data = b"".join(pieces(job(300, 60), changed(frames)))
    assert all((found == rgb_of(frame)).all() for found, frame in zip(shown(data), frames, strict=True))


def test_what_is_not_opaque_shows_through_in_every_picture() -> None:
    frames = [picture(rows, 255) for rows in ("r.. ...", "... ..g", "... ...", "rrr ggg")]
    data = b"".join(pieces(job(3, 2, alpha=True), changed(frames)))
    for found, frame in zip(shown(data, "RGBA"), frames, strict=True):
        opaque = frame >> 24 == 255
        assert ((found[..., 3] == 255) == opaque).all()
        assert (found[opaque][:, :3] == rgb_of(frame)[opaque]).all()


@pytest.mark.parametrize(("opacity", "seen"), [(127, 0), (128, 255)])
def test_what_is_opaque_by_half_is_seen(opacity: int, seen: int) -> None:
    data = b"".join(pieces(job(2, 1, alpha=True), changed([picture("rr", opacity)])))
    assert [found[..., 3].tolist() for found in shown(data, "RGBA")] == [[[seen, seen]]]


def test_a_colour_goes_to_the_nearest_of_the_palette_and_to_the_first_of_equals() -> None:
    rng = np.random.default_rng(3)
    palette = rng.integers(0, 256, (255, 3))
    colours = rng.integers(0, 256, (100, 100, 3))
    far = np.square(colours[:, :, None] - palette[None, None]).sum(axis=3)
    nearest = Nearest(tuple((int(r), int(g), int(b)) for r, g, b in palette))
    assert (nearest(words(colours)) == far.argmin(axis=2) + 1).all()
    assert (nearest(words(colours)) == far.argmin(axis=2) + 1).all()  # known by now
    assert Nearest(((0, 0, 0), (2, 0, 0)))(words(np.array([[[1, 0, 0]]]))).tolist() == [[1]]


def test_opacity_is_no_part_of_a_colour() -> None:
    nearest = Nearest(PALETTE)
    assert nearest(picture("wrgk", 255)).tolist() == nearest(picture("wrgk", 0)).tolist() == [[1, 2, 3, 4]]


def size(*frames: Words, width: int = 100) -> int:
    return len(b"".join(pieces(job(width, len(frames[0])), changed(frames))))


def test_what_stays_costs_next_to_nothing() -> None:
    rng = np.random.default_rng(1)
    noise = rng.choice(np.array([0xFFFFFF, 0xFF0000, 0x8000], np.uint32), (100, 100))
    centre, corners = noise.copy(), noise.copy()
    centre[40:42, 40:42] = 0
    corners[[0, -1], [0, -1]] = 0
    alone = size(noise)
    assert size(noise, noise) - alone < 30
    assert size(noise, centre) - alone < 40
    assert 40 < size(noise, corners) - alone < 300  # all of it once more were over 2000


def test_a_colour_that_carries_on_is_written_and_not_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    rows, columns = np.mgrid[0:100, 0:200]
    frames = [
        np.where(np.abs(columns - 60 - 3 * step - rows * 0.3) < 20, 0xFF0000, 0xFFFFFF).astype(np.uint32)
        for step in range(10)
    ]
    carried = size(*frames, width=200)
    monkeypatch.setattr(gif, "_LONGEST_CARRIED", 0)
    assert carried < 0.8 * size(*frames, width=200)


@pytest.mark.parametrize("comment", [b"", b"x" * 700], ids=["the oldest kind", "with a comment"])
def test_pictures_are_counted_in_any_gif_that_is_whole(tmp_path: Path, comment: bytes) -> None:
    rng = np.random.default_rng(5)
    images = [Image.fromarray(rng.integers(0, 256, (40, 60, 3), np.uint8)) for _ in range(7)]
    path = tmp_path / "any.gif"
    images[0].save(path, save_all=True, append_images=images[1:], comment=comment)
    assert count_pictures(path) == 7
    path.write_bytes(path.read_bytes()[:-1])
    assert count_pictures(path) == 0


@pytest.mark.parametrize(
    "data", [b"", b"GIF89a", b"GIF89a" + bytes(30), b"P6 1 1 255 abc", b"GIF89a;;;;;;;;;;;"]
)
def test_what_is_no_whole_gif_has_no_pictures(tmp_path: Path, data: bytes) -> None:
    (tmp_path / "some.gif").write_bytes(data)
    assert count_pictures(tmp_path / "some.gif") == 0
