"""Frames to a file, by the ffmpeg that imageio-ffmpeg carries.

Frames go through a pipe as they are drawn, so that drawing and encoding overlap and memory does not
grow with their number. A GIF gets one palette for all frames and no dithering, an MP4 is H.264 as
slides play it, its colours tagged bt709 so that they come back as they were.
"""

from __future__ import annotations

import base64
import io
import re
import signal
import subprocess
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from threading import Semaphore, Thread
from typing import IO

import numpy as np
from imageio_ffmpeg import get_ffmpeg_exe
from PIL import Image

from linkanim.errors import RecordingFailed
from linkanim.recorder.palette import Bytes
from linkanim.recorder.plan import MOST_FRAMES, Format

Frame = bytes | bytearray | memoryview
"""A frame's bytes, row by row: blue, green, red, and alpha or one that means nothing."""

_THREADS = 2
"""Fixed, for H.264's bytes depend on it."""

_BT709 = "setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709"
_AHEAD: dict[Format, int] = {"gif": 2, "png": 6}
"""How many frames may be on their way; H.264 looks further ahead, and bounds that itself."""
_PATIENCE = 0.5
"""Seconds after which an encoder that tells of no frame gets one more all the same."""

_TELLING = ("-stats_enc_post", "pipe:1", "-stats_enc_post_fmt", "{n}")
"""A line on stdout for every frame that is encoded."""
_EXACT = ("-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact")
_LAST_WORDS = 8


@dataclass(frozen=True)
class Stream:
    """Raw frames as they come: width and height in pixels, frames a second, whether alpha counts."""

    size: tuple[int, int]
    rate: Fraction
    alpha: bool = False


@contextmanager
def encoding(
    stream: Stream, form: Format, part: Path, palette: Bytes | None = None
) -> Iterator[Callable[[Frame], None]]:
    """Give a function that takes the frames, one after the other, and have them encoded into `part`.

    `part` is a file, for PNG a folder that gets 0001.png, ...; `palette` (n, 3) is for GIF. When the
    block ends the encoder is done; whatever else ends it, the encoder is gone. `RecordingFailed` where
    the encoder cannot be started, stops early or reports an error.
    """
    into = _OUTPUTS[form](stream, palette)
    goal = part / "%04d.png" if form == "png" else part
    command = [*_input(stream), *into, *_EXACT, *_TELLING, f"file:{_escaped(goal, form)}"]
    with _running(command, ahead=_AHEAD.get(form, MOST_FRAMES)) as write:
        yield write


def count_frames(part: Path, form: Format) -> int:
    """Read back how many frames a file (for PNG: a folder) holds; 0 where it cannot be read."""
    if form == "png":
        return sum(1 for _ in part.glob("*.png"))
    asking = [_ffmpeg(), "-v", "error", "-nostdin", "-i", f"file:{part}", "-map", "0:v:0"]
    told = subprocess.run(
        [*asking, "-c", "copy", "-f", "null", "-progress", "-", "-"], capture_output=True, check=False
    )
    counts = [
        line[6:] for line in told.stdout.decode(errors="replace").splitlines() if line.startswith("frame=")
    ]
    return int(counts[-1]) if counts and told.returncode == 0 else 0


def decoded(path: Path, size: tuple[int, int]) -> Iterator[Bytes]:
    """Yield a GIF's or MP4's pictures (height, width, 3) of red, green, blue, as ffmpeg shows them."""
    width, height = size
    raw = ["-fps_mode", "passthrough", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    command = [_ffmpeg(), "-v", "error", "-nostdin", "-i", f"file:{path}", *raw]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        while process.stdout and len(data := process.stdout.read(3 * width * height)) == 3 * width * height:
            yield np.frombuffer(data, np.uint8).reshape(height, width, 3)


def _ffmpeg() -> str:
    try:
        return str(get_ffmpeg_exe())
    except RuntimeError as error:
        raise RecordingFailed("imageio-ffmpeg has no ffmpeg here; set IMAGEIO_FFMPEG_EXE to one") from error


def _input(stream: Stream) -> list[str]:
    width, height = stream.size
    pixels = "bgra" if stream.alpha else "bgr0"
    quiet = ["-hide_banner", "-loglevel", "error", "-y"]
    raw = ["-f", "rawvideo", "-pix_fmt", pixels, "-s", f"{width}x{height}", "-framerate", str(stream.rate)]
    return [_ffmpeg(), *quiet, *raw, "-i", "pipe:0"]


def _gif(stream: Stream, palette: Bytes | None) -> list[str]:
    if palette is None:
        raise ValueError("a GIF needs its palette")
    mapping = "[0:v][1:v]paletteuse=dither=none:diff_mode=rectangle:alpha_threshold=128"
    return ["-i", _palette_uri(palette), "-lavfi", mapping, "-loop", "0", "-f", "gif"]


def _mp4(stream: Stream, palette: Bytes | None) -> list[str]:
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
    h264 = ["-c:v", "libx264", "-preset", "medium", "-crf", "18", "-threads", str(_THREADS)]
    return ["-vf", ",".join(filters), *h264, "-movflags", "+faststart", "-f", "mp4"]


def _png(stream: Stream, palette: Bytes | None) -> list[str]:
    return [
        "-pix_fmt",
        "rgba" if stream.alpha else "rgb24",
        "-pred",
        "mixed",
        "-start_number",
        "1",
        "-f",
        "image2",
    ]


_OUTPUTS: dict[Format, Callable[[Stream, Bytes | None], list[str]]] = {"gif": _gif, "mp4": _mp4, "png": _png}


def _palette_uri(palette: Bytes) -> str:
    """Return the palette as the 16 x 16 picture the encoder asks for, its last colour transparent."""
    colours = np.zeros((256, 4), np.uint8)
    colours[:255, 3] = 255
    colours[:255, :3] = palette[np.minimum(np.arange(255), len(palette) - 1)]
    file = io.BytesIO()
    Image.fromarray(colours.reshape(16, 16, 4)).save(file, "PNG")
    return "data:image/png;base64," + base64.b64encode(file.getvalue()).decode()


def _escaped(goal: Path, form: Format) -> str:
    """Return a path for the encoder; of numbered files only the last part is a pattern."""
    if form != "png":
        return str(goal)
    return str(goal.parent).replace("%", "%%") + f"/{goal.name}"


class _GoneError(Exception):
    """The encoder does not read any more; what it said and its exit code tell why."""


@contextmanager
def _running(command: list[str], *, ahead: int) -> Iterator[Callable[[Frame], None]]:
    """Run the encoder and give the function that writes to it, not too far ahead of what is encoded.

    The encoder would queue dozens of frames; so its memory is the same for few and for many.
    """
    process = _started(command)
    room = Semaphore(ahead)
    words: deque[bytes] = deque(maxlen=_LAST_WORDS)
    frames, told, said = _pipes(process)
    listeners = (Thread(target=_making_room, args=(told, room)), Thread(target=words.extend, args=(said,)))

    def write(frame: Frame) -> None:
        room.acquire(timeout=_PATIENCE)
        try:
            frames.write(frame)
        except BrokenPipeError as error:
            raise _GoneError from error

    try:
        for listener in listeners:
            listener.start()
        with suppress(_GoneError):
            yield write
        with suppress(BrokenPipeError):
            frames.close()
        process.wait()
    finally:
        _stop(process, listeners)
    _refuse_failure(process.returncode, words)


def _started(command: list[str]) -> subprocess.Popen[bytes]:
    """Start the encoder in a session of its own: Ctrl-C in the terminal is for us, and we stop it."""
    pipe = subprocess.PIPE
    try:
        return subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, start_new_session=True)
    except OSError as error:
        reason = error.strerror or error
        raise RecordingFailed(f"the encoder {command[0]} cannot be started: {reason}") from error


def _pipes(process: subprocess.Popen[bytes]) -> tuple[IO[bytes], IO[bytes], IO[bytes]]:
    """Return the encoder's stdin, stdout and stderr."""
    if process.stdin is None or process.stdout is None or process.stderr is None:
        raise RecordingFailed("the encoder has no pipes")
    return process.stdin, process.stdout, process.stderr


def _making_room(told: IO[bytes], room: Semaphore) -> None:
    for _ in told:
        room.release()
    room.release(MOST_FRAMES)  # the encoder is gone: whoever waits is to find out


def _refuse_failure(code: int, words: Iterable[bytes]) -> None:
    """Raise `RecordingFailed` with the encoder's last words where it did not end well."""
    if code == 0:
        return
    how = f"was stopped by {_signal_name(-code)}" if code < 0 else f"gave up with code {code}"
    lines = [line.decode(errors="replace").strip() for line in words]
    said = [re.sub(r"^\[.*?\] ", "", line) for line in lines[-1:]]
    raise RecordingFailed(": ".join([f"the encoder {how}", *said]))


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def _stop(process: subprocess.Popen[bytes], listeners: Iterable[Thread]) -> None:
    """Leave no process and no thread behind, however the work ended."""
    process.kill()
    process.wait()
    for listener in listeners:
        if listener.is_alive():
            listener.join()
    for pipe in _pipes(process):
        with suppress(OSError):
            pipe.close()
