"""A taped recording rendered by a process of its own while the window runs on, and after it, too."""

from __future__ import annotations

import os
import re
import subprocess
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from linkanim import child
from linkanim.errors import WorkFailed
from linkanim.player import tape_file
from linkanim.player.files import FOLDER, free_stem
from linkanim.player.tape import Tape
from linkanim.whole import made_folder

_TAIL = 400
_COUNT = re.compile(r"(\d+)/(\d+)")


class Rendering:
    """`linkanim record TAPE` under way.

    What it says goes into a file without a name, and not into a pipe, which would break under it
    when the window closes. We read it through an opening of our own: the process's has the place
    it writes at.
    """

    def __init__(self, target: Path, process: subprocess.Popen[bytes], said: BinaryIO) -> None:
        self.target = target
        self._process = process
        self._said = said

    @property
    def done(self) -> bool:
        """Whether the process has ended."""
        return self._process.poll() is not None

    def words(self) -> str:
        """Say how far it is, or where the file went, or why there is none."""
        tail = self._tail()
        code = self._process.poll()
        if code is None:
            counts = _COUNT.findall(tail)
            share = f"{100 * int(counts[-1][0]) // max(int(counts[-1][1]), 1)} %" if counts else "…"
            return f"{self.target}: {share}"
        if code == 0:
            return f"{self.target} is written"
        reason = tail.strip().splitlines()[-1] if tail.strip() else f"the process ended with code {code}"
        return f"{self.target}: {reason.removeprefix('linkanim: ')}"

    def close(self) -> None:
        """Let go of what it says; the process itself goes on."""
        self._said.close()
        _forgotten(self._said.name)

    def _tail(self) -> str:
        size = os.fstat(self._said.fileno()).st_size
        self._said.seek(max(size - _TAIL, 0))
        return self._said.read(_TAIL).decode("utf-8", "replace")


def render(tape: Tape, form: str) -> Rendering:
    """Write the tape into recordings/ and start rendering it beside; WorkFailed where that cannot be."""
    into = made_folder(FOLDER)
    stem = free_stem(into, tape.start.scene.name, (tape_file.SUFFIX, f".{form}"))
    kept, target = into / f"{stem}{tape_file.SUFFIX}", into / f"{stem}.{form}"
    tape_file.write(tape, kept)
    command = child.python("-m", "linkanim", "record", str(kept), "-o", str(target), "--progress")
    number, name = tempfile.mkstemp()
    # it stays open as long as the rendering
    said = Path(name).open("rb", buffering=0)  # noqa: SIM115
    try:
        process = _start(command, number)
    except OSError as error:
        said.close()
        raise WorkFailed(f"{target}: the recording process cannot be started: {error.strerror}") from None
    finally:
        os.close(number)
        _forgotten(name)
    return Rendering(target, process, said)


def _forgotten(name: str) -> None:
    """Have a temporary file lose its name, at once where it may while it is open: not on Windows."""
    with suppress(OSError):
        Path(name).unlink()


def _start(command: list[str], said: int) -> subprocess.Popen[bytes]:
    """Start a process that neither Ctrl-C in our terminal nor our end takes with it."""
    return subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=said,
        env=child.surroundings(),
        start_new_session=True,
    )
