"""The GIF that ffmpeg makes of frames and our palette: every picture as it was, read by Pillow."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from reading import frames_of

from linkanim.recorder.encode import Stream, count_frames
from linkanim.recorder.palette import Colour

Words = NDArray[np.uint32]
Pixels = NDArray[np.uint8]

WHITE, RED, GREEN, BLACK = (255, 255, 255), (255, 0, 0), (0, 128, 0), (0, 0, 0)
PALETTE = (WHITE, RED, GREEN, BLACK)
LETTERS = {"w": 0xFFFFFF, "r": 0xFF0000, "g": 0x8000, "k": 0}
OPAQUE = np.uint32(0xFF000000)


def encoded(
    folder: Path, frames: Sequence[Words], palette: Sequence[Colour] = PALETTE, *, alpha: bool = False
) -> Path:
    """Write frames (height, width) of 0xaarrggbb as a GIF."""
    path = folder / "frames.gif"
    height, width = frames[0].shape
    stream = Stream("gif", (width, height), Fraction(25), alpha)
    code = stream.coding(palette)
    with stream.encoding(path) as send:
        for frame in frames:
            send(code(frame.astype("<u4").tobytes()))
    return path


def size(folder: Path, *frames: Words) -> int:
    return encoded(folder, frames).stat().st_size


def picture(rows: str) -> Words:
    """Return an opaque picture from letters: w, r, g, k; '.' is transparent."""
    lines = [
        [LETTERS[letter] | 0xFF000000 if letter in LETTERS else 0 for letter in row] for row in rows.split()
    ]
    return np.array(lines, np.uint32)


def rgb_of(frame: Words) -> NDArray[np.uint32]:
    return np.stack([frame >> 16 & 255, frame >> 8 & 255, frame & 255], axis=2)


def same(shown: Sequence[Pixels], frames: Sequence[Words]) -> list[bool]:
    """Tell of each frame whether it is shown with its colours, and its transparent pixels as such."""
    pairs = zip(shown, frames, strict=True)
    return [bool((rgba == _rgba(frame))[_visible(rgba, frame)].all()) for rgba, frame in pairs]


def _rgba(frame: Words) -> Words:
    found: Words = np.dstack([rgb_of(frame), np.where(frame >> 24 >= 128, 255, 0)]).astype(np.uint32)
    return found


def _visible(rgba: Pixels, frame: Words) -> NDArray[np.bool_]:
    """Return which values count: of what is transparent the opacity alone."""
    either = (rgba[..., 3] > 0) | (frame >> 24 >= 128)
    return np.dstack([either, either, either, np.ones_like(either)])


# why, the pictures
SEQUENCES = [
    ("one", ["wr gk"]),
    ("nothing changes", ["wr gk", "wr gk", "wr gk"]),
    ("all changes", ["wwww rrrr", "rrrr gggg", "kkkk wwww"]),
    ("a corner", ["www www www", "www www wwr", "rww www wwr"]),
    ("there and back", ["wwww", "wrrw", "wwww", "wrrw"]),
]


@pytest.mark.parametrize(("why", "rows"), SEQUENCES)
def test_every_picture_is_as_it_was(why: str, rows: list[str], tmp_path: Path) -> None:
    frames = [picture(row) for row in rows]
    assert all(same(frames_of(encoded(tmp_path, frames), "RGBA"), frames))


@pytest.mark.parametrize("fourth", [0, 255], ids=["0", "255"])
def test_where_alpha_does_not_count_the_fourth_byte_means_nothing(fourth: int, tmp_path: Path) -> None:
    frames = [picture(rows) for rows in ("wr gk", "rw kg")]
    sent = [frame & ~OPAQUE | np.uint32(fourth << 24) for frame in frames]
    assert all(same(frames_of(encoded(tmp_path, sent), "RGBA"), frames))


@pytest.mark.parametrize("count", [1, 2, 127, 254, 255])
def test_any_number_of_colours_comes_out(count: int, tmp_path: Path) -> None:
    rng = np.random.default_rng(count)
    palette = rng.permutation(1 << 12)[:count] * 4095  # spread over all colours, each once
    frames = [palette[rng.integers(0, count, (33, 51))].astype(np.uint32) | OPAQUE for _ in range(3)]
    colours = [(int(c) >> 16 & 255, int(c) >> 8 & 255, int(c) & 255) for c in palette]
    assert all(same(frames_of(encoded(tmp_path, frames, colours), "RGBA"), frames))


@pytest.mark.slow
def test_a_colour_goes_to_a_near_one_of_the_palette(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    palette, colours = rng.integers(0, 256, (255, 3)), rng.integers(0, 256, (100, 100, 3))
    red, green, blue = colours.astype(np.uint32).transpose(2, 0, 1)
    given = [(int(r), int(g), int(b)) for r, g, b in palette]
    (shown,) = frames_of(encoded(tmp_path, [red << 16 | green << 8 | blue], given))
    nearest = np.square(colours[:, :, None] - palette[None, None]).sum(axis=3).min(axis=2)
    assert np.square(colours - shown.astype(int)).sum(axis=2).mean() < 2 * nearest.mean()  # near to the eye


# why, the pictures
TRANSPARENT = [
    ("what was there goes", ["r.. ...", "... ..g", "... ...", "rrg gg."]),
    ("the lowest row is the widest", [".r. .r. rrr", "... .r. rr."]),
    ("nothing at all", ["... ...", "... ..."]),
    ("nothing changes", ["r.. ..g", "r.. ..g"]),
]


@pytest.mark.parametrize(("why", "rows"), TRANSPARENT)
def test_what_is_transparent_shows_through_in_every_picture(
    why: str, rows: list[str], tmp_path: Path
) -> None:
    frames = [picture(row) for row in rows]
    assert all(same(frames_of(encoded(tmp_path, frames, alpha=True), "RGBA"), frames))


@pytest.mark.parametrize(("opacity", "seen"), [(127, 0), (128, 255)])
def test_what_is_opaque_by_half_is_seen(opacity: int, seen: int, tmp_path: Path) -> None:
    frame = np.array([[opacity << 24 | 0xFF0000, 0]], np.uint32)
    (shown,) = frames_of(encoded(tmp_path, [frame], alpha=True), "RGBA")
    assert shown[..., 3].tolist() == [[seen, 0]]


def test_what_stays_costs_next_to_nothing(tmp_path: Path) -> None:
    rng = np.random.default_rng(1)
    noise = rng.choice(np.array([0xFFFFFF, 0xFF0000, 0x8000], np.uint32), (100, 100))
    centre, corners = noise.copy(), noise.copy()
    centre[40:42, 40:42] = 0
    corners[[0, -1], [0, -1]] = 0
    alone = size(tmp_path, noise)
    assert size(tmp_path, noise, noise) - alone < 40
    assert size(tmp_path, noise, centre) - alone < 50
    assert 40 < size(tmp_path, noise, corners) - alone < 400  # all of it once more were over 2000


@pytest.mark.parametrize("data", [b"", b"GIF89a", b"GIF89a" + bytes(30), b"P6 1 1 255 abc"])
def test_what_is_no_gif_has_no_frames(tmp_path: Path, data: bytes) -> None:
    (tmp_path / "some.gif").write_bytes(data)
    assert count_frames(tmp_path / "some.gif", "gif") == 0
