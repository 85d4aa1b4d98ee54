"""Frames to a file, by the ffmpeg that imageio-ffmpeg carries.

Frames go through a pipe as they are drawn, so that drawing and encoding overlap and memory does not grow
with their number. A GIF has one palette, which we choose; its indices are worked out here, where only what
changed is looked at (ffmpeg's filter took three times as long), and of each frame it holds what changed. An
MP4 is H.264 as slides play it, its colours tagged bt709 so that they come back as they were.
"""

from __future__ import annotations

import math
import os
import re
import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from imageio_ffmpeg import get_ffmpeg_exe

from linkanim import child
from linkanim.errors import RecordingFailed
from linkanim.recorder.palette import Colour, Indexing
from linkanim.recorder.plan import Format
from linkanim.recorder.process import Frame, running, told

_THREADS = 2
"""Fixed, for H.264's bytes depend on it."""
_AHEAD = {"gif": 6, "mp4": 20, "png": 6}
"""How many frames may be on their way; H.264 looks seventeen ahead."""

_BT709 = "setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709"
_TELLING = ("-stats_enc_post", "pipe:1", "-stats_enc_post_fmt", "{n}")
"""A line on stdout for every frame that is encoded."""
_EXACT = ("-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact")


@dataclass(frozen=True)
class Stream:
    """Raw frames as they come: width and height in pixels, frames a second, whether alpha counts."""

    size: tuple[int, int]
    rate: Fraction
    alpha: bool = False


@contextmanager
def encoding(
    stream: Stream, form: Format, part: Path, palette: Callable[[], Sequence[Colour]]
) -> Iterator[Callable[[Frame], None]]:
    """Give a function that takes the frames, one after the other, and have them encoded into `part`.

    `part` is a file, for PNG a folder that gets 0001.png, ...; `palette` gives a GIF's colours, 255 at
    most, and is called for no other. Of a frame nothing is kept. When the block ends the encoder is
    done; whatever else ends it, the encoder is gone. `RecordingFailed` where the encoder cannot be
    started, stops early or reports an error.
    """
    with running(_command(stream, form, part), ahead=_AHEAD[form]) as write:
        if form == "gif":
            indices = Indexing(palette(), math.prod(stream.size), alpha=stream.alpha)
            yield lambda frame: write(indices(frame))
        else:
            yield write


def count_frames(part: Path, form: Format) -> int:
    """Read back how many frames a file (for PNG: a folder) holds; 0 where it cannot be read."""
    if form == "png":
        return sum(1 for _ in part.glob("*.png"))
    # a line for each frame: how many it copied ffmpeg 7 does not say otherwise
    copied = ["-map", "0:v:0", "-c", "copy", "-f", "framecrc", "-"]
    lines = told([ffmpeg(), "-v", "error", "-nostdin", "-i", f"file:{part}", *copied])
    return len(re.findall(rb"^\d", lines, re.MULTILINE))


def ffmpeg() -> str:
    """Return the encoder's path, none in the current folder; `RecordingFailed` where there is none."""
    places, usual = child.path_of_programs(), os.environ.get("PATH", os.defpath)
    os.environ["PATH"] = places  # imageio-ffmpeg runs one from there to see whether it can
    try:
        found = str(get_ffmpeg_exe())
        if not os.path.dirname(found):  # noqa: PTH120 -- a name that is looked for, no path
            found = shutil.which(found, path=places) or ""
    except RuntimeError:  # also where it could not try the one it carries
        for end in (*os.pipe(), *os.pipe()):
            os.close(end)
        found = ""
    finally:
        os.environ["PATH"] = usual
    if not found:
        raise RecordingFailed("imageio-ffmpeg has no ffmpeg here; set IMAGEIO_FFMPEG_EXE to one")
    return found


def ffmpeg_version() -> str:
    """Return the version that the encoder says it has, such as "7.0.2-static"; empty where there is none."""
    try:
        found = re.match(rb"ffmpeg version (\S+)", told([ffmpeg(), "-version"]))
    except (RecordingFailed, OSError):
        return ""
    return found[1].decode(errors="replace") if found else ""


def _command(stream: Stream, form: Format, part: Path) -> list[str]:
    width, height = stream.size
    pixels = "pal8" if form == "gif" else "bgra" if stream.alpha else "bgr0"
    # without a tag the decoder copies indices byte by byte, with it rows have to be whole words
    tag = "-tag:v BIT8" if form == "gif" and width % 4 == 0 else ""
    raw = f"-f rawvideo {tag} -pix_fmt {pixels} -s {width}x{height} -framerate {stream.rate} -i pipe:0"
    match form:
        case "gif":
            into = [*_gif(stream), f"file:{part}"]
        case "mp4":
            into = [*_mp4(stream), f"file:{part}"]
        case "png":
            into = [*_png(stream), _numbered(part)]
    quiet = ["-hide_banner", "-nostdin", "-loglevel", "error", "-y"]
    return [ffmpeg(), *quiet, *raw.split(), *into[:-1], *_EXACT, *_TELLING, into[-1]]


def _gif(stream: Stream) -> list[str]:
    # its crop to what is opaque loses pixels of the lowest row
    whole = ["-gifflags", "-offsetting"] if stream.alpha else []
    return [*whole, "-loop", "0", "-f", "gif"]


def _numbered(folder: Path) -> str:
    """Return the pattern of numbered files in a folder, whose own name is none."""
    return "file:" + str(folder).replace("%", "%%") + "/%04d.png"


def _mp4(stream: Stream) -> list[str]:
    width, height = stream.size
    filters = ["scale=out_range=tv:out_color_matrix=bt709", "format=yuv420p", _BT709]
    if width % 2 or height % 2:
        right, bottom = width % 2, height % 2
        filters = [
            "format=gbrp",
            f"pad={width + right}:{height + bottom}",
            f"fillborders=right={right}:bottom={bottom}:mode=smear",
            *filters,
        ]
    h264 = ["-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-threads", str(_THREADS)]
    return ["-vf", ",".join(filters), *h264, "-movflags", "+faststart", "-f", "mp4"]


def _png(stream: Stream) -> list[str]:
    pixels = "rgba" if stream.alpha else "rgb24"
    return f"-pix_fmt {pixels} -pred mixed -start_number 1 -f image2".split()
