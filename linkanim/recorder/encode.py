"""Encode frames to a file, by the ffmpeg that imageio-ffmpeg carries.

An encoder is a process: it is fed through a pipe, listened to, and ended when the work is over.
"""

from __future__ import annotations

import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from fractions import Fraction
from pathlib import Path
from threading import Event, Semaphore, Thread
from typing import IO, TYPE_CHECKING, NamedTuple

from imageio_ffmpeg import get_ffmpeg_exe

from linkanim import child
from linkanim.bounds import MOST_FRAMES
from linkanim.errors import RecordingFailed
from linkanim.recorder.plan import Format

if TYPE_CHECKING:
    from linkanim.recorder.palette import Colour

# An encoder as a process: fed through a pipe, listened to, and ended when the work is over.

if sys.platform == "linux":
    import fcntl

Frame = bytes | bytearray | memoryview
"""A frame's bytes, row by row: blue, green, red, and alpha or a byte without meaning."""

_PATIENCE = 0.5
"""Seconds after which an encoder that has reported no frame as done gets one more all the same."""
_STILL = 60.0
"""Seconds after which an encoder that takes nothing and reports nothing is ended."""
_LAST_WORDS = 8
_WIDTH = 1 << 20
_ROOM = 100
"""Room for frames once the encoder is gone: a writer that waits for room goes on, and finds out."""


class _GoneError(Exception):
    """The encoder reads no more; its last lines and its exit code tell why."""


class _Watch:
    """Ends a process that is waited for and gives no sign of progress for `_STILL` seconds."""

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        self._process, self._over = process, Event()
        self._since: float | None = None
        self.ended = False
        self._thread = _listening(self._look)
        self._thread.start()

    @contextmanager
    def waiting(self) -> Iterator[None]:
        """Expect progress during the block."""
        self._since = time.monotonic()
        try:
            yield
        finally:
            self._since = None

    def heard(self) -> None:
        """Note progress: the time without it starts anew."""
        if self._since is not None:
            self._since = time.monotonic()

    def stop(self) -> None:
        """Stop watching."""
        self._over.set()
        self._thread.join()

    def refuse_stillness(self) -> None:
        """Raise `RecordingFailed` where the process was ended because it made no progress."""
        if self.ended:
            raise RecordingFailed(f"the encoder made no progress for {_STILL:g} s and was ended")

    def _look(self) -> None:
        while not self._over.wait(_STILL / 20):
            since = self._since
            if since is not None and time.monotonic() - since > _STILL:
                self.ended = True
                _kill(self._process)
                return


@contextmanager
def running(
    command: Sequence[str], *, ahead: int, settings: Mapping[str, str] | None = None
) -> Iterator[Callable[[Frame], None]]:
    """Run the encoder and give the function that writes to it, not too far ahead of what is encoded.

    The encoder reports each encoded frame by a line on stdout, and gets at most `ahead` frames more than it
    has reported; so its memory does not grow with their number. `settings` are added to its environment. When
    the block ends, the encoder has finished; after an exception it is ended. `RecordingFailed` where it
    cannot be started, stops early, stands still or reports an error.
    """
    room = Semaphore(ahead)
    words: deque[bytes] = deque(maxlen=_LAST_WORDS)
    process = _started(command, settings)
    frames, stdout, stderr = _pipes(process)
    watch = _Watch(process)
    listeners = (_listening(_making_room, stdout, room, watch), _listening(words.extend, stderr))

    def write(frame: Frame) -> None:
        room.acquire(timeout=_PATIENCE)
        try:
            with watch.waiting():
                frames.write(frame)
        except BrokenPipeError as error:
            raise _GoneError from error

    try:
        _widen(frames)
        for listener in listeners:
            listener.start()
        with suppress(_GoneError):
            yield write
        with watch.waiting():
            with suppress(BrokenPipeError):
                frames.close()
            process.wait()
    finally:
        watch.stop()
        _stop(process, listeners)
    watch.refuse_stillness()
    _refuse_failure(process.returncode, words)


def output_of(command: Sequence[str]) -> bytes:
    """Return what a command prints; nothing where the command fails.

    `RecordingFailed` where it cannot be started or stands still.
    """
    lines = []
    process = _started(command)
    frames, stdout, stderr = _pipes(process)
    watch, listener = _Watch(process), _listening(stderr.read)
    try:
        listener.start()
        frames.close()
        with watch.waiting():
            for line in stdout:
                watch.heard()
                lines.append(line)
            process.wait()
    finally:
        watch.stop()
        _stop(process, [listener])
    watch.refuse_stillness()
    return b"".join(lines) if process.returncode == 0 else b""


def _started(command: Sequence[str], settings: Mapping[str, str] | None = None) -> subprocess.Popen[bytes]:
    """Start the encoder in a session of its own: Ctrl-C reaches only this process, which ends the encoder."""
    pipe = subprocess.PIPE
    try:
        return subprocess.Popen(
            command,
            stdin=pipe,
            stdout=pipe,
            stderr=pipe,
            env={**os.environ, **(settings or {})},
            start_new_session=True,
        )
    except OSError as error:
        why = error.strerror or error
        raise RecordingFailed(f"the encoder {command[0]} cannot be started: {why}") from error


def _pipes(process: subprocess.Popen[bytes]) -> tuple[IO[bytes], IO[bytes], IO[bytes]]:
    """Return the encoder's stdin, stdout and stderr."""
    if process.stdin is None or process.stdout is None or process.stderr is None:
        raise RecordingFailed("the encoder has no pipes")
    return process.stdin, process.stdout, process.stderr


def _widen(pipe: IO[bytes]) -> None:
    """Let a pipe hold more than its 64 kB where possible: a frame of megabytes then takes fewer writes."""
    if sys.platform == "linux":
        with suppress(OSError):
            fcntl.fcntl(pipe.fileno(), fcntl.F_SETPIPE_SZ, _WIDTH)


def _listening(work: Callable[..., object], *given: object) -> Thread:
    """Return a thread that the program does not wait for as it ends.

    Ctrl-C may come after the thread's start and before the code that stops it: the program would never end.
    """
    return Thread(target=work, args=given, daemon=True)


def _making_room(stdout: IO[bytes], room: Semaphore, watch: _Watch) -> None:
    for _ in stdout:
        room.release()
        watch.heard()
    room.release(_ROOM)  # the encoder is gone: a waiting writer finds out


def _refuse_failure(code: int, words: Iterable[bytes]) -> None:
    """Raise `RecordingFailed` with the encoder's last line where its exit code is not 0."""
    if code == 0:
        return
    lines = [line.decode(errors="replace").strip() for line in words]
    reason = "".join(": " + re.sub(r"^\[.*?\] ", "", line) for line in lines[-1:])
    how = f"was stopped by {_signal_name(-code)}" if code < 0 else "gave up"
    raise RecordingFailed(f"the encoder {how}{reason or f' with code {code}' * (code > 0)}")


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End a process and what it has started, which would keep its pipes open."""
    if sys.platform != "win32":
        if process.returncode is None:  # else its id may be another process's by now
            with suppress(OSError):
                os.killpg(process.pid, signal.SIGKILL)
    process.kill()


def _stop(process: subprocess.Popen[bytes], listeners: Iterable[Thread]) -> None:
    """Leave no process and no thread behind, however the work ended."""
    _kill(process)
    process.wait()
    for listener in listeners:
        if listener.is_alive():
            listener.join()
    for pipe in _pipes(process):
        with suppress(OSError):
            pipe.close()


# Frames to a file, by the ffmpeg that imageio-ffmpeg carries.
#
# Frames go through a pipe as they are drawn, so that drawing and encoding overlap and memory does not grow
# with their number. A GIF has one palette, which we choose. Its indices are worked out here, only for pixels
# that changed (ffmpeg's filter took three times as long), and the file holds of each frame what changed. An
# MP4 is H.264 as slide programs play it, its colours tagged bt709 so that they are shown unchanged. Alpha is
# straight in all formats that have it, as the frames' own is.

COLOURS = 256
"""Colours of a GIF: they follow the indices of each frame, four bytes each."""
_THREADS = 2
"""Threads of the encoder: fixed, as H.264's bytes depend on their number."""
_AHEAD: Mapping[Format, int] = {"mp4": 20, "webm": 20, "webp": MOST_FRAMES}
_USUAL = 6
"""How many frames the encoder may have waiting. H.264 and VP9 look some sixteen ahead; WebP's reports none
before the last, and takes each only when it is done with the one before."""
_LARGE, _AHEAD_OF_LARGE = 1920 * 1200, 2
"""Above that many pixels, this many wait and none is looked at ahead: 3840×2160 takes some 30 MB each."""

_GIVING_BACK = {"MALLOC_MMAP_THRESHOLD_": "1048576", "MALLOC_ARENA_MAX": "1"}
"""With these glibc frees a frame's memory at once; else each of the encoder's threads keeps some."""

_BT709 = "setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709"
_TELLING = ("-stats_enc_post", "pipe:1", "-stats_enc_post_fmt", "{n}")
"""A line on stdout for every frame that is encoded."""
_EXACT = ("-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact")


class Stream(NamedTuple):
    """Raw frames, and the format they become: width and height, frames a second, whether alpha counts."""

    form: Format
    size: tuple[int, int]
    rate: Fraction
    alpha: bool = False

    def coding(self, palette: Sequence[Colour]) -> Callable[[Frame], Frame]:
        """Return the function that turns a frame into the bytes that `encoding` takes; a GIF's are indices.

        `palette` has a GIF's colours, 255 at most. The bytes returned may be overwritten by those of the next
        frame.
        """
        if self.form != "gif":
            return lambda frame: frame
        from linkanim.recorder.palette import Indexing

        return Indexing(palette, math.prod(self.size), alpha=self.alpha)

    @property
    def coded_size(self) -> int:
        """The number of bytes of a coded frame."""
        pixels = math.prod(self.size)
        return pixels + 4 * COLOURS if self.form == "gif" else 4 * pixels

    @contextmanager
    def encoding(self, part: Path) -> Iterator[Callable[[Frame], None]]:
        """Give a function that takes coded frames, one after the other, and have them encoded into `part`.

        `part` is a file, for PNG a folder that gets 0001.png, .... A frame's bytes may be reused once the
        call returns. When the block ends, the encoder has finished; after an exception it is ended.
        `RecordingFailed` where the encoder cannot be started, stops early or reports an error.
        """
        ahead, settings = _AHEAD.get(self.form, _USUAL), None
        if self.is_large and self.form != "webp":
            ahead, settings = _AHEAD_OF_LARGE, _GIVING_BACK
        with running(self._command(part), ahead=ahead, settings=settings) as write:
            yield write

    @property
    def is_large(self) -> bool:
        """Whether few frames are held at once."""
        return math.prod(self.size) > _LARGE

    def _command(self, part: Path) -> list[str]:
        width, height = self.size
        pixels = "pal8" if self.form == "gif" else "bgra" if self.alpha else "bgr0"
        # without a tag the decoder copies indices byte by byte; with it, rows must be multiples of 4 bytes
        tag = "-tag:v BIT8" if self.form == "gif" and width % 4 == 0 else ""
        raw = f"-f rawvideo {tag} -pix_fmt {pixels} -s {width}x{height} -framerate {self.rate} -i pipe:0"
        into = [*_CODERS[self.form](self), _numbered(part) if self.form == "png" else f"file:{part}"]
        quiet = ["-hide_banner", "-nostdin", "-loglevel", "error", "-y"]
        return [ffmpeg(), *quiet, *raw.split(), *into[:-1], *_EXACT, *_TELLING, into[-1]]


def count_frames(part: Path, form: Format) -> int:
    """Read back how many frames a file (for PNG: a folder) holds; 0 where it cannot be read."""
    if form == "png":
        return sum(1 for _ in part.glob("*.png"))
    # a line for each frame, as ffmpeg 7 does not otherwise say how many it copied
    copied = ["-map", "0:v:0", "-c", "copy", "-f", "framecrc", "-"]
    lines = output_of([ffmpeg(), "-v", "error", "-nostdin", "-i", f"file:{part}", *copied])
    return len(re.findall(rb"^\d", lines, re.MULTILINE))


def ffmpeg() -> str:
    """Return the encoder's path, never in the current folder; `RecordingFailed` where there is none."""
    places, usual = child.path_of_programs(), os.environ.get("PATH", os.defpath)
    os.environ["PATH"] = places  # imageio-ffmpeg tries to run one from there
    try:
        program = str(get_ffmpeg_exe())
        if not os.path.dirname(program):  # noqa: PTH120 -- a name that is looked for, no path
            program = shutil.which(program, path=places) or ""
    except RuntimeError:  # also where it could not try the one it carries
        for end in (*os.pipe(), *os.pipe()):
            os.close(end)
        program = ""
    finally:
        os.environ["PATH"] = usual
    if not program:
        raise RecordingFailed("imageio-ffmpeg has no ffmpeg here; set IMAGEIO_FFMPEG_EXE to one")
    return program


def ffmpeg_version() -> str:
    """Return the version that the encoder says it has, such as "7.0.2-static"; empty where there is none."""
    try:
        match = re.match(rb"ffmpeg version (\S+)", output_of([ffmpeg(), "-version"]))
    except (RecordingFailed, OSError):
        return ""
    return match[1].decode(errors="replace") if match else ""


def _gif(stream: Stream) -> list[str]:
    # ffmpeg's cropping to what is opaque loses pixels of the lowest row
    whole = ["-gifflags", "-offsetting"] if stream.alpha else []
    return [*whole, "-loop", "0", "-f", "gif"]


def _numbered(folder: Path) -> str:
    """Return the pattern of numbered files in a folder; the folder's name is kept literal."""
    return "file:" + str(folder).replace("%", "%%") + "/%04d.png"


def _mp4(stream: Stream) -> list[str]:
    width, height = stream.size
    filters = []
    if width % 2 or height % 2:
        right, bottom = width % 2, height % 2
        filters = [
            "format=gbrp",
            f"pad={width + right}:{height + bottom}",
            f"fillborders=right={right}:bottom={bottom}:mode=smear",
        ]
    h264 = ["-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-threads", str(_THREADS)]
    h264 += ["-tune", "zerolatency"] if stream.is_large else []
    return [*_tagged("yuv420p", *filters), *h264, "-movflags", "+faststart", "-f", "mp4"]


def _tagged(pixels: str, *filters: str) -> list[str]:
    """Return the options that turn frames into such pixels of bt709, after other filters."""
    chain = [*filters, "scale=out_range=tv:out_color_matrix=bt709", f"format={pixels}", _BT709]
    return ["-vf", ",".join(chain)]


def _webm(stream: Stream) -> list[str]:
    vp9 = f"-c:v libvpx-vp9 -crf 30 -b:v 0 -deadline good -cpu-used 4 -auto-alt-ref 0 -threads {_THREADS}"
    ahead = 0 if stream.is_large else 16
    pixels = "yuva420p" if stream.alpha else "yuv420p"
    return [*_tagged(pixels), *vp9.split(), "-lag-in-frames", str(ahead), "-f", "webm"]


def _webp(stream: Stream) -> list[str]:
    return ["-c:v", "libwebp_anim", "-pix_fmt", "bgra", "-lossless", "1", "-loop", "0", "-f", "webp"]


def _apng(stream: Stream) -> list[str]:
    pixels = "rgba" if stream.alpha else "rgb24"
    return f"-c:v apng -pix_fmt {pixels} -pred mixed -plays 0 -f apng".split()


def _mov(stream: Stream) -> list[str]:
    pixels, bits = ("yuva444p10le", 16) if stream.alpha else ("yuv444p10le", 0)
    prores = f"-c:v prores_ks -profile:v 4444 -alpha_bits {bits} -vendor apl0 -threads {_THREADS} -f mov"
    return [*_tagged(pixels), *prores.split()]


def _png(stream: Stream) -> list[str]:
    pixels = "rgba" if stream.alpha else "rgb24"
    return f"-pix_fmt {pixels} -pred mixed -start_number 1 -f image2".split()


_CODERS: Mapping[Format, Callable[[Stream], list[str]]] = {
    "gif": _gif,
    "mp4": _mp4,
    "png": _png,
    "webm": _webm,
    "webp": _webp,
    "apng": _apng,
    "mov": _mov,
}
"""The encoder's options for each format."""
