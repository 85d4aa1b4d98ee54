"""Run what takes longer than a frame as processes beside the window: searches, parts, recordings.

The search for linkages replies with actions. A taped recording is rendered while the window runs on, and even
after it has closed.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO, NamedTuple, TextIO, cast

from linkanim import child, intake
from linkanim.atomic_files import checked_folder, checked_target, made_folder
from linkanim.errors import BadInput, WorkFailed
from linkanim.manifest import Output
from linkanim.player import tape_file
from linkanim.player.action import Action
from linkanim.player.files import FOLDER, free_stem, from_anywhere, typed_path, where
from linkanim.player.state import PIVOTS, PathSketch, PoseSketch, Sketch
from linkanim.player.tape import Tape
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import content
from linkanim.synthesis.follower import Follow, FollowPoses, Reply, Request, lines_of
from linkanim.synthesis.guidance import USUAL_WEIGHT
from linkanim.units import shown
from linkanim.words import said, said_many, spoken

# The search for linkages for a sketch: a process beside the window, and its replies as actions.


def request_of(sketch: Sketch, *, search: bool, anew: bool = False) -> Request | None:
    """Return the request for a sketch, with `anew` regardless of the shown answer; None without one."""
    if isinstance(sketch, PoseSketch):
        return _request_of_poses(sketch, search=search or anew, anew=anew) if sketch.is_asked else None
    assert isinstance(sketch, PathSketch)
    curve, answer, held = sketch.curve, sketch.answer, dict(sketch.pivots)
    if curve is None:
        return None
    near = None if answer is None or isinstance(answer, Scene) else answer.numbers
    points = [(float(point.real), float(point.imag)) for point in curve.points]
    pivots = [held.get(pivot) for pivot in PIVOTS]
    return Follow(sketch.strokes, points, curve.closed, pivots, near, search)


def _request_of_poses(sketch: PoseSketch, *, search: bool, anew: bool) -> FollowPoses:
    grip, answer = sketch.held, None if anew else sketch.answer
    near = answer.numbers if answer and bool(answer.sliding) == sketch.sliding else None
    moved = (grip.number, *grip.at) if grip and grip.what == "joint" and grip.at else None
    weight = USUAL_WEIGHT * 2 ** (sketch.dial / 2) if sketch.dial else None
    rows = [tuple(pose) for pose in sketch.poses]
    return FollowPoses(sketch.strokes, rows, sketch.sliding, sketch.pins, near, moved, weight, search)


def actions_of(reply: Reply, sketch: Sketch | None) -> Iterator[Action]:
    """Yield the actions of a reply; none where it answers an earlier request."""
    if sketch is None or reply.stroke != sketch.strokes:
        return
    if reply.error:
        yield Action("no_linkage" if isinstance(sketch, PoseSketch) else "note", reply.error)
    elif not reply.whole:
        yield Action("follow", tuple(reply.numbers))
    else:
        yield Action("cards", (float(reply.chosen), *reply.numbers))
        if reply.way:
            yield Action("way", (0.0, *reply.way))


class Following:
    """The search's process, started when something is first drawn; it ends with the window.

    With the word "paths" it prepares for strokes.
    """

    def __init__(self, *words: str) -> None:
        self._process = subprocess.Popen(
            child.module("linkanim.synthesis.follower", *words),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**child.env(), **child.ONE_CORE},
            start_new_session=True,
            text=True,
            encoding="utf-8",
        )
        assert self._process.stdout
        self._lines = lines_of(cast(TextIO, self._process.stdout))

    def ask(self, request: Request) -> None:
        """Send a request; where the process is gone, `is_over` says so."""
        assert self._process.stdin
        with suppress(OSError):
            print(json.dumps(request._asdict()), file=self._process.stdin, flush=True)

    def replies(self) -> Iterator[Reply]:
        """Yield the replies that have come since the last time."""
        while not self._lines.empty() and (reply := self.wait()):
            yield reply

    def wait(self) -> Reply | None:
        """Wait for the next reply and return it; None where the process has ended."""
        line = self._lines.get()
        return Reply(**json.loads(line)) if line else None

    @property
    def is_over(self) -> bool:
        """Whether the process has ended."""
        return self._process.poll() is not None

    def close(self) -> None:
        """End the process."""
        assert self._process.stdin
        self._process.kill()
        with suppress(OSError):
            self._process.stdin.close()
        self._process.wait()


# The layers in which a scene can be made, and its parts: found and written by `linkanim make`.


class Making:
    """`linkanim make` under way for a scene, which it reads from a temporary file.

    With a folder it writes the parts there, with `words` as its options; without, it prints the layers as
    JSON. WorkFailed where it cannot be started.
    """

    def __init__(self, scene: Scene, words: Sequence[str], folder: Path | None = None) -> None:
        self.scene, self._folder = scene, folder
        self._room = tempfile.TemporaryDirectory()
        room = Path(self._room.name)
        (room / f"{scene.name}.toml").write_bytes(content(scene, room))
        asked = ("-o", str(folder)) if folder else ("--json",)
        command = child.module("linkanim", "make", str(room / f"{scene.name}.toml"), *words, *asked)
        self._out, self._log = ((room / name).open("w+b") for name in ("out", "log"))
        try:
            self._process = _start(command, self._log.fileno(), self._out.fileno())
        except OSError as error:
            self.close()
            raise WorkFailed(f"{scene.name}: the layers cannot be looked for: {error.strerror}") from None

    @property
    def done(self) -> bool:
        """Whether the process has ended."""
        return self._process.poll() is not None

    def result(self) -> str:
        """Return the layers as JSON on one line; where it has failed, why there are none.

        Output that is cut off, as on a full disk, counts as a failure.
        """
        with suppress(ValueError):
            if self._process.poll() == 0:
                return json.dumps(json.loads(self._text(self._out)), ensure_ascii=False)
        return json.dumps({"refused": self._reason()}, ensure_ascii=False)

    def words(self) -> str:
        """Say where the parts went and what they are, or why there are none."""
        if self._process.poll() != 0 or self._folder is None:
            return self._reason()
        lines = self._text(self._out).splitlines() or [str(self._folder)]
        return f"{where(Path(lines[0]))}: {lines[-1]}"

    def close(self) -> None:
        """End the process, and discard its output."""
        self._out.close()
        self._log.close()
        self._room.cleanup()

    def _reason(self) -> str:
        lines = self._text(self._log).strip().splitlines() or [said("the search for layers has ended")]
        return lines[-1].removeprefix("linkanim: ")

    def _text(self, log: BinaryIO) -> str:
        log.seek(0)
        return log.read().decode("utf-8", "replace")


# A taped recording, rendered by a process of its own while the window runs on, and even after it has closed.

_TAIL = 400
_COUNT = re.compile(r"(\d+)/(\d+)")


class Rendering:
    """`linkanim record TAPE` under way.

    Its output goes into a file without a name instead of a pipe, which would break when the window closes.
    The window reads that file through its own file object, since the process's has the position for writing.
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
        """Say how far the rendering is, or where the file is, or why there is none."""
        tail = self._tail()
        code = self._process.poll()
        if code is None:
            counts = _COUNT.findall(tail)
            share = f"{100 * int(counts[-1][0]) // max(int(counts[-1][1]), 1)} %" if counts else "…"
            return f"{self.target}: {share}"
        if code == 0:
            return where(self.target)
        reason = (
            tail.strip().splitlines()[-1]
            if tail.strip()
            else said("the process ended with code {code}", code=code)
        )
        return f"{self.target}: {reason.removeprefix('linkanim: ')}"

    def close(self) -> None:
        """Close its output; the process itself goes on."""
        self._log.close()
        _forgotten(self._log.name)

    def _tail(self) -> str:
        size = os.fstat(self._log.fileno()).st_size
        self._log.seek(max(size - _TAIL, 0))
        return self._log.read(_TAIL).decode("utf-8", "replace")


class Kept(NamedTuple):
    """A written tape, the file into which it is to be rendered, and the size, "" for the tape's own shape."""

    tape: Path
    target: Path
    size: str = ""

    def rendering(self) -> Rendering:
        """Start rendering the tape in a process; WorkFailed where that is impossible."""
        size = ("--size", self.size) if self.size else ()
        into = ("--no-clobber", "-o", str(self.target), "--progress")
        number, name = tempfile.mkstemp()
        # it stays open as long as the rendering runs
        log = Path(name).open("rb", buffering=0)  # noqa: SIM115
        try:
            process = _start(child.module("linkanim", "record", str(self.tape), *size, *into), number)
        except OSError as error:
            log.close()
            reason = f"the recording process cannot be started: {error.strerror}"
            raise WorkFailed(f"{self.target}: {reason}") from None
        finally:
            os.close(number)
            _forgotten(name)
        return Rendering(self.target, process, log)


def kept_at(place: str) -> Kept:
    """Return the files of a recording and its tape, for a typed place.

    BadInput where a file that this program did not write has one of the names, or none can be written there.
    """
    target = typed_path(place)
    if reason := intake.unnameable(target.name):
        raise BadInput(said("{file}: {reason}; type another name", file=shown(target.name), reason=reason))
    kept = Kept(target.with_name(f"{target.stem}{tape_file.SUFFIX}"), target)
    if checked_folder(target.parent).is_dir():
        for path in (kept.target, kept.tape):
            _ours(checked_target(path, (path.suffix,))).refuse_foreign()
    return kept


def _ours(path: Path) -> Output:
    """Return an output that is written over only while it is as this program wrote it."""
    return Output(path, named=False, way_out=said("type another name"))


class Queue:
    """Recordings that are rendered in turn; those that wait are not lost when the window closes."""

    def __init__(self) -> None:
        self._running: Rendering | None = None
        self._waiting: list[Kept] = []

    def add(self, tape: Tape, form: str, size: tuple[int, int] | None = None, place: str = "") -> None:
        """Write a tape and have it rendered in its turn, into `place` or else into recordings/.

        Without a size it has the window's shape. Errors as `refuse`; WorkFailed where it cannot be written.
        """
        if place:
            self.refuse(place)
        self._waiting.append(keep(tape, form, place)._replace(size="x".join(map(str, size or ()))))
        self._go_on()

    def refuse(self, place: str) -> None:
        """Raise BadInput for a place where no recording can be written, or where one is being written."""
        own, *under_way = (
            from_anywhere(str(one.target)) for one in (kept_at(place), self._running, *self._waiting) if one
        )
        if own in under_way:
            raise BadInput(said("{file} is being written; type another name", file=own))

    def news(self) -> tuple[str, ...]:
        """Say how far the present rendering is, and how many wait; when it is done, begin the next."""
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
        waits = said_many("{count} waits", "{count} wait", wait)
        return (f"{words} · {waits}" if wait else words,)

    def close(self) -> None:
        """Leave the waiting recordings to a process that renders them in turn; the present one goes on."""
        if self._running:
            self._running.close()
        if self._waiting:
            rest = [str(path) for kept in self._waiting for path in kept]
            _start(child.module("linkanim.cli.commands.record", *rest), subprocess.DEVNULL)

    def _go_on(self) -> None:
        if self._running is None and self._waiting:
            self._running = self._waiting.pop(0).rendering()


def keep(tape: Tape, form: str, place: str = "") -> Kept:
    """Write the tape beside the file into which it will be rendered: a typed place, else a free one."""
    if not place:
        stem = free_stem(FOLDER, tape.start.scene.name, (tape_file.SUFFIX, f".{form}"))
        place = str(FOLDER / f"{stem}.{form}")
    kept = kept_at(place)
    made_folder(kept.target.parent)
    tape_file.write(tape, _ours(kept.tape))
    return kept


def _forgotten(name: str) -> None:
    """Remove a temporary file's name while it is open, except on Windows, where that is impossible."""
    with suppress(OSError):
        Path(name).unlink()


def _start(command: list[str], log: int, out: int = subprocess.DEVNULL) -> subprocess.Popen[bytes]:
    """Start a process that survives both Ctrl-C in this terminal and the end of this process."""
    return subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=out,
        stderr=log,
        env={**child.env(), "LANGUAGE": spoken()},
        start_new_session=True,
    )
