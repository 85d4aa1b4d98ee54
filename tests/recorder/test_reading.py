"""The decoders that the recorder's tests trust, on files that Pillow and ffmpeg wrote."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from imageio_ffmpeg import get_ffmpeg_exe
from PIL import Image
from reading import durations, frames_of, loops_for_ever, video

LEVELS = (40, 200, 120)


def grey(level: int, size: tuple[int, int] = (8, 6)) -> Image.Image:
    return Image.new("RGB", size, (level, level, level))


@pytest.fixture
def gif(tmp_path: Path) -> Path:
    first, *others = map(grey, LEVELS)
    first.save(tmp_path / "x.gif", save_all=True, append_images=others, duration=[40, 70, 100], loop=0)
    return tmp_path / "x.gif"


def test_every_frame_of_a_gif_is_read_with_its_time(gif: Path) -> None:
    frames = frames_of(gif)
    assert [frame.shape for frame in frames] == [(6, 8, 3)] * 3
    assert [int(frame[0, 0, 0]) for frame in frames] == list(LEVELS)
    assert [frame.shape for frame in frames_of(gif, "RGBA")] == [(6, 8, 4)] * 3
    assert durations(gif) == [40, 70, 100]


def test_a_gif_that_is_shown_once_is_told_from_one_that_loops(gif: Path) -> None:
    assert loops_for_ever(gif)
    grey(9).save(gif, save_all=True, append_images=[grey(99)])
    assert not loops_for_ever(gif)


def test_a_png_is_one_frame(tmp_path: Path) -> None:
    grey(40).save(tmp_path / "x.png")
    (frame,) = frames_of(tmp_path / "x.png")
    assert (frame == 40).all()


def test_every_frame_of_a_video_is_read(tmp_path: Path) -> None:
    for number, level in enumerate(LEVELS):
        grey(level, (64, 48)).save(tmp_path / f"{number}.png")
    pictures = ["-framerate", "25", "-i", str(tmp_path / "%d.png")]
    subprocess.run([get_ffmpeg_exe(), "-v", "error", *pictures, str(tmp_path / "x.mp4")], check=True)
    read = video(tmp_path / "x.mp4")
    assert [frame.shape for frame in read] == [(48, 64, 3)] * 3
    assert [float(frame.mean()) for frame in read] == pytest.approx(LEVELS, abs=2)
