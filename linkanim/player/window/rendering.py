"""A taped recording rendered by a process of its own while the window runs on, and after it, too."""

from __future__ import annotations

import os
import re
import subprocess
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO, NamedTuple

from linkanim import child
from linkanim.atomic_files import made_folder
from linkanim.errors import WorkFailed
from linkanim.player.tape import tape_file
from linkanim.player.tape.tape import Tape
from linkanim.player.window.files import FOLDER, free_stem

_TAIL = 400
_COUNT = re.compile(r"(\d+)/(\d+)")


class Rendering:
    """`linkanim record TAPE` under way.

    What it says goes into a file without a name, and not into a pipe, which would break under it
    when the window closes. We read it through an opening of our own: the process's has the place
    it writes at.
    """

    def __init__(self, target: Path, process: subprocess.Popen[bytes], log: BinaryIO) -> None:
        self.target = target
        self._process = process
        self._log = log

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
            return f"{self.target} saved"
        reason = tail.strip().splitlines()[-1] if tail.strip() else f"the process ended with code {code}"
        return f"{self.target}: {reason.removeprefix('linkanim: ')}"

    def close(self) -> None:
        """Let go of what it says; the process itself goes on."""
        self._log.close()
        _forgotten(self._log.name)

    def _tail(self) -> str:
        size = os.fstat(self._log.fileno()).st_size
        self._log.seek(max(size - _TAIL, 0))
        return self._log.read(_TAIL).decode("utf-8", "replace")


class Kept(NamedTuple):
    """A tape that is written, and the file it is to be rendered into."""

    tape: Path
    target: Path


class Queue:
    """Recordings rendered one after the other: the rest wait, and are not lost when the window closes."""

    def __init__(self) -> None:
        self._running: Rendering | None = None
        self._waiting: list[Kept] = []

    def add(self, tape: Tape, form: str) -> None:
        """Write a tape into recordings/ and have it rendered in its turn; WorkFailed where that cannot be."""
        self._waiting.append(keep(tape, form))
        self._go_on()

    def news(self) -> tuple[str, ...]:
        """Say how far the one rendered is, and how many wait; go on with the next where it is done."""
        if self._running is None:
            return ()
        words = self._running.words()
        if self._running.done:
            self._running.close()
            self._running = None
            try:
                self._go_on()
            except WorkFailed as error:
                words = f"{words} · {error}"
        wait = len(self._waiting)
        return (f"{words} · {wait} {'wait' if wait > 1 else 'waits'}" if wait else words,)

    def close(self) -> None:
        """Leave the rest to a process that renders one after the other; the one under way goes on."""
        if self._running:
            self._running.close()
        if self._waiting:
            rest = [str(path) for kept in self._waiting for path in kept]
            _start(child.module("linkanim.cli.commands.record", *rest), subprocess.DEVNULL)

    def _go_on(self) -> None:
        if self._running is None and self._waiting:
            self._running = render(self._waiting.pop(0))


def keep(tape: Tape, form: str) -> Kept:
    """Write the tape into recordings/, under a name that is free for it and for what it is rendered into."""
    into = made_folder(FOLDER)
    stem = free_stem(into, tape.start.scene.name, (tape_file.SUFFIX, f".{form}"))
    kept, target = into / f"{stem}{tape_file.SUFFIX}", into / f"{stem}.{form}"
    tape_file.write(tape, kept)
    return Kept(kept, target)


def render(kept: Kept) -> Rendering:
    """Start rendering a tape beside; WorkFailed where that cannot be."""
    target = kept.target
    command = child.module("linkanim", "record", str(kept.tape), "-o", str(target), "--progress")
    number, name = tempfile.mkstemp()
    # it stays open as long as the rendering
    log = Path(name).open("rb", buffering=0)  # noqa: SIM115
    try:
        process = _start(command, number)
    except OSError as error:
        log.close()
        raise WorkFailed(f"{target}: the recording process cannot be started: {error.strerror}") from None
    finally:
        os.close(number)
        _forgotten(name)
    return Rendering(target, process, log)


def _forgotten(name: str) -> None:
    """Have a temporary file lose its name, at once where it may while it is open: not on Windows."""
    with suppress(OSError):
        Path(name).unlink()


def _start(command: list[str], log: int) -> subprocess.Popen[bytes]:
    """Start a process that neither Ctrl-C in our terminal nor our end takes with it."""
    return subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=log,
        env=child.env(),
        start_new_session=True,
    )
