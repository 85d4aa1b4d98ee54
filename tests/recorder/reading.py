"""What was written, read back by decoders that are not ours: Pillow and ffmpeg."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import numpy as np
from imageio_ffmpeg import get_ffmpeg_exe
from numpy.typing import NDArray
from PIL import Image, ImageSequence

Pixels = NDArray[np.uint8]


def frames_of(path: Path, mode: str = "RGB") -> list[Pixels]:
    """Return the frames of a GIF, WebP or APNG, or the one of a PNG, as a viewer shows them."""
    with Image.open(path) as image:
        return [np.asarray(frame.convert(mode)) for frame in ImageSequence.Iterator(image)]


def durations(path: Path) -> list[int]:
    """Return how long each frame of a GIF, WebP or APNG stands, in ms."""
    with Image.open(path) as image:
        return [frame.info["duration"] for frame in ImageSequence.Iterator(image)]


def loops_for_ever(path: Path) -> bool:
    """Tell whether a GIF, WebP or APNG says that it begins again, without end."""
    with Image.open(path) as image:
        return image.info.get("loop") == 0


def video(path: Path, mode: str = "RGB") -> list[Pixels]:
    """Return the frames of an MP4, WebM, MOV or APNG."""
    width, height = map(int, re.findall(r" ([1-9]\d+)x(\d+)", about(path))[0])
    pixels = {"RGB": "rgb24", "RGBA": "rgba"}[mode]
    raw = ["-f", "rawvideo", "-pix_fmt", pixels, "-fps_mode", "passthrough", "-"]
    # of VP9's alpha only this decoder knows
    decoder = ["-c:v", "libvpx-vp9"] if path.suffix == ".webm" else []
    command = [get_ffmpeg_exe(), "-v", "error", *decoder, "-i", str(path), *raw]
    done = subprocess.run(command, capture_output=True, check=True)
    return [*np.frombuffer(done.stdout, np.uint8).reshape(-1, height, width, len(mode))]


def about(path: Path) -> str:
    """Return what ffmpeg says of a file."""
    done = subprocess.run(
        [get_ffmpeg_exe(), "-hide_banner", "-i", str(path)], capture_output=True, check=False
    )
    return done.stderr.decode()
