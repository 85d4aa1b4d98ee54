"""Run what takes longer than a frame as processes beside the window: searches, parts, recordings.

The search for linkages along a stroke replies as actions. A taped recording is rendered while the window
runs on, and after it, too.
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
from typing import BinaryIO, TextIO, cast

from linkanim import child, intake
from linkanim.atomic_files import checked_folder, checked_target, made_folder
from linkanim.errors import BadInput, WorkFailed
from linkanim.frozen import NamedTuple
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

# The search for linkages along a stroke: a process beside the window, and what it replies as actions.


def request_of(sketch: Sketch, *, search: bool, anew: bool = False) -> Request | None:
    """Return what is asked for a sketch, `anew` without regard to the answer shown; None where nothing is."""
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
    """Yield what a reply does; nothing where it is to another request."""
    if sketch is None or reply.stroke != sketch.strokes:
        return
    if reply.error:
        yield Action("unmet" if isinstance(sketch, PoseSketch) else "note", reply.error)
    elif not reply.whole:
        yield Action("follow", tuple(reply.numbers))
    else:
        yield Action("cards", (float(reply.chosen), *reply.numbers))
        if reply.way:
            yield Action("way", (0.0, *reply.way))


class Following:
    """The process, from the first time that something is drawn; it ends with the window.

    With the word `paths` it is made ready for strokes.
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
        """Send a request; where the process is gone, that is seen by its replies."""
        assert self._process.stdin
        with suppress(OSError):
            print(json.dumps(request._asdict()), file=self._process.stdin, flush=True)

    def replies(self) -> Iterator[Reply]:
        """Yield what has come since the last time."""
        while not self._lines.empty() and (reply := self.wait()):
            yield reply

    def wait(self) -> Reply | None:
        """Return the next reply once it is there; None where the process has ended."""
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
    """`linkanim make` under way for a scene, which it is given as a file of its own.

    With a folder it writes the parts there, with `words` as its options; without, it says what they are.
    WorkFailed where it cannot be started.
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

    def found(self) -> str:
        """Return what the layers are, as JSON on one line; why there are none where it has failed.

        An answer that is cut off, as on a full disk, is a failure.
        """
        with suppress(ValueError):
            if self._process.poll() == 0:
                return json.dumps(json.loads(self._said(self._out)), ensure_ascii=False)
        return json.dumps({"refused": self._reason()}, ensure_ascii=False)

    def words(self) -> str:
        """Say where the parts went and what they are, or why there are none."""
        if self._process.poll() != 0 or self._folder is None:
            return self._reason()
        lines = self._said(self._out).splitlines() or [str(self._folder)]
        return f"{where(Path(lines[0]))}: {lines[-1]}"

    def close(self) -> None:
        """End it, and forget what it said."""
        self._out.close()
        self._log.close()
        self._room.cleanup()

    def _reason(self) -> str:
        said = self._said(self._log).strip().splitlines() or ["the search for layers has ended"]
        return said[-1].removeprefix("linkanim: ")

    def _said(self, log: BinaryIO) -> str:
        log.seek(0)
        return log.read().decode("utf-8", "replace")


# A taped recording rendered by a process of its own while the window runs on, and after it, too.

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
            return where(self.target)
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
    """A tape that is written, the file it is to be rendered into, and how large, "" for its own shape."""

    tape: Path
    target: Path
    size: str = ""


def kept_at(place: str) -> Kept:
    """Return where a recording, and its tape, goes that is to be written into a file as it is typed.

    BadInput where a file has one of the names that is not ours, or none can be written there.
    """
    target = typed_path(place)
    if reason := intake.unnameable(target.name):
        raise BadInput(f"{shown(target.name)}: {reason}; type another name")
    found = Kept(target.with_name(f"{target.stem}{tape_file.SUFFIX}"), target)
    if checked_folder(target.parent).is_dir():
        for path in (found.target, found.tape):
            _ours(checked_target(path, (path.suffix,))).refuse_foreign()
    return found


def _ours(path: Path) -> Output:
    """Return a file that is written over only where it is still as we wrote it."""
    return Output(path, named=False, way_out="type another name")


class Queue:
    """Recordings rendered one after the other: the rest wait, and are not lost when the window closes."""

    def __init__(self) -> None:
        self._running: Rendering | None = None
        self._waiting: list[Kept] = []

    def add(self, tape: Tape, form: str, size: tuple[int, int] | None = None, place: str = "") -> None:
        """Write a tape and have it rendered in its turn into a place, by itself into recordings/.

        Without a size it is of the window's shape. Errors as `refuse`; WorkFailed where it cannot be written.
        """
        if place:
            self.refuse(place)
        self._waiting.append(keep(tape, form, place)._replace(size="x".join(map(str, size or ()))))
        self._go_on()

    def refuse(self, place: str) -> None:
        """Refuse, as BadInput, a place where a recording cannot be written, or one is on its way to."""
        found, *under_way = (
            from_anywhere(str(one.target)) for one in (kept_at(place), self._running, *self._waiting) if one
        )
        if found in under_way:
            raise BadInput(f"{found} is being written; type another name")

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


def keep(tape: Tape, form: str, place: str = "") -> Kept:
    """Write the tape beside what it is rendered into: a place that was typed, else one that is free."""
    if not place:
        stem = free_stem(FOLDER, tape.start.scene.name, (tape_file.SUFFIX, f".{form}"))
        place = str(FOLDER / f"{stem}.{form}")
    kept = kept_at(place)
    made_folder(kept.target.parent)
    tape_file.write(tape, _ours(kept.tape))
    return kept


def render(kept: Kept) -> Rendering:
    """Start rendering a tape beside; WorkFailed where that cannot be."""
    target = kept.target
    size = ("--size", kept.size) if kept.size else ()
    where_to = ("--no-clobber", "-o", str(target))
    command = child.module("linkanim", "record", str(kept.tape), *size, *where_to, "--progress")
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


def _start(command: list[str], log: int, out: int = subprocess.DEVNULL) -> subprocess.Popen[bytes]:
    """Start a process that neither Ctrl-C in our terminal nor our end takes with it."""
    return subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=out,
        stderr=log,
        env=child.env(),
        start_new_session=True,
    )
