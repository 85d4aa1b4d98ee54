"""Record drawn frames to a file that loops; `record` does so with a scene's motion."""

from __future__ import annotations

import base64
import os
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import astuple
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, cast

import numpy as np

from linkanim import manifest
from linkanim.atomic_files import checked_target
from linkanim.bounds import MOST_FRAMES
from linkanim.errors import BadInput, RecordingFailed, WorkFailed
from linkanim.frozen import frozen
from linkanim.picture.drawn import Additions
from linkanim.picture.layout import Docked
from linkanim.picture.look import ConstructionKind, Look
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen, pixel_view
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.theme import theme_of
from linkanim.recorder.encode import Frame, Stream, count_frames
from linkanim.recorder.palette import Colour, make_palette
from linkanim.recorder.plan import Clip, Format, Plan, make_plan, refuse_size
from linkanim.recorder.processes import drawing, processes_for

if TYPE_CHECKING:
    from linkanim.recorder.encode import Frame
    from linkanim.recorder.palette import Colour
    from linkanim.scenes.scene import Scene

# Drawn frames to a file that loops.

SUFFIXES = (".gif", ".mp4", ".png", ".webm", ".webp", ".apng", ".mov")
Progress = Callable[[int, int], None]

_SAMPLES = 8


class Frames(Protocol):
    """Pictures that can be drawn in any order, all of one size."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""

    @property
    def alpha(self) -> bool:
        """Whether the fourth byte of a pixel is its opacity; else that byte has no meaning."""

    @property
    def colours(self) -> Sequence[Colour]:
        """The colours that a GIF's palette has to contain exactly."""

    @property
    def independent(self) -> bool:
        """Whether a frame costs the same whichever was drawn before it."""

    def draw(self, frame: int) -> Frame:
        """Return a frame's bytes, which the next call may overwrite."""


@frozen
class Recording:
    """A finished recording: where it is (for PNG: its first frame) and what it holds."""

    path: Path
    plan: Plan
    size: tuple[int, int]
    file_bytes: int

    @property
    def frames(self) -> int:
        """The number of frames."""
        return self.plan.frames

    @property
    def seconds(self) -> float:
        """The length as written."""
        return self.plan.seconds

    @property
    def speed(self) -> float:
        """The dφ/dt as recorded, rad/s, signed."""
        return self.plan.speed

    def _repr_html_(self) -> str | None:
        """Show it in a notebook, the file itself within the page; numbered frames and MOV are not."""
        data = base64.b64encode(self.path.read_bytes()).decode()
        match self.path.suffix.lower():
            case ".gif" | ".webp" | ".apng" as suffix:
                return f'<img src="data:image/{suffix[1:]};base64,{data}" width="{self.size[0]}">'
            case ".mp4" | ".webm" as suffix:
                source = f'src="data:video/{suffix[1:]};base64,{data}" width="{self.size[0]}"'
                return f"<video {source} autoplay loop muted controls></video>"
        return None

    def _repr_png_(self) -> bytes | None:
        """Show the first numbered frame in a notebook."""
        return self.path.read_bytes() if self.path.suffix.lower() == ".png" else None

    @property
    def summary(self) -> str:
        """The recording in a line: file, frames, length, speed as recorded, size."""
        width, height = self.size
        return f"{self.path}: {self.plan.summary}, {width}x{height}, {self.file_bytes / 1e6:.2f} MB"


Target = str | os.PathLike[str] | manifest.Output
"""The file to write; a path counts as a name that its user gave."""


def checked_path(path: Target) -> tuple[manifest.Output, Format]:
    """Return the file and the format its ending stands for; `BadInput` as `atomic_files.checked_target`."""
    target = path if isinstance(path, manifest.Output) else manifest.Output(Path(path))
    checked_target(target.path, SUFFIXES)
    target.refuse_foreign()
    return target, cast(Format, target.path.suffix.lower()[1:])


def write(frames: Frames, plan: Plan, path: Target, progress: Progress | None = None) -> Recording:
    """Draw and encode `plan.frames` frames into a file whose ending states the format.

    The file appears when it is whole, or not at all. It then replaces an old one; numbered frames replace
    only frames that we wrote. `progress` is called with (frames done, frames in all). `BadInput` before any
    work for a path or a size that is impossible, for transparency in MP4, and where a frame's name is taken;
    `RecordingFailed` where disk or encoder give up.
    """
    output, form = checked_path(path)
    target = output.path
    refuse_size(frames.size)
    if frames.alpha and form == "mp4":
        raise BadInput(
            f"{target.name}: MP4 has no transparency; record a WebM, WebP, APNG, MOV, GIF or PNG,"
            " or keep the background"
        )
    made = [target]
    if form == "png":  # NAME-0001.png, NAME-0002.png, ...
        numbers = range(1, plan.frames + 1)
        made = [target.with_name(f"{target.stem}-{number:04}{target.suffix}") for number in numbers]
    finished = _numbering(target, made) if form == "png" else output.replacing()
    with _saying_why(target), finished as part:
        _encode(frames, plan, part, form, progress)
        held = count_frames(part, form)
        if held != plan.frames:
            raise RecordingFailed(f"{held} of {plan.frames} frames came out")
    return Recording(made[0], plan, frames.size, sum(file.stat().st_size for file in made))


@contextmanager
def _numbering(target: Path, made: Sequence[Path]) -> Iterator[Path]:
    """Give a new folder for 0001.png, 0002.png, ..., which become NAME-0001.png, ... together at the end.

    Frames that we wrote before are replaced, and those with higher numbers removed.
    """
    numbered = re.escape(target.stem) + r"-\d{4,}" + re.escape(target.suffix)
    files = manifest.FileSet(target.parent, target.name, numbered)
    with manifest.replacing(files, [path.name for path in made]) as new:
        yield new
        for path, named in zip(sorted(new.iterdir(), key=lambda path: int(path.stem)), made, strict=True):
            path.rename(new / named.name)


@contextmanager
def _saying_why(target: Path) -> Iterator[None]:
    """Turn a failure of the block into a `RecordingFailed` that names the target."""
    try:
        yield
    except RecordingFailed as error:
        raise RecordingFailed(f"{target} was not recorded: {error}") from error
    except WorkFailed as error:
        raise RecordingFailed(str(error)) from error


def _encode(frames: Frames, plan: Plan, part: Path, form: Format, progress: Progress | None) -> None:
    stream = Stream(form, frames.size, plan.rate, frames.alpha)
    code = stream.coding(palette_of(frames, plan.frames) if form == "gif" else ())
    size = stream.coded_size
    processes = processes_for(plan.frames, size) if frames.independent else 0
    # started before the encoder: a copy of this process that held its pipe would keep it waiting for more
    with (
        drawing(lambda frame: code(frames.draw(frame)), plan.frames, size, processes) as coded,
        stream.encoding(part) as send,
    ):
        for frame in range(plan.frames):
            send(coded(frame))
            if progress is not None:
                progress(frame + 1, plan.frames)


def palette_of(frames: Frames, count: int) -> list[Colour]:
    """Return a palette made from a few frames spread over the clip."""
    chosen = sorted({k * count // _SAMPLES for k in range(_SAMPLES)})
    samples = (np.frombuffer(frames.draw(k), np.uint8) for k in chosen)
    palette = make_palette(samples, frames.colours, alpha=frames.alpha).tolist()
    return [(red, green, blue) for red, green, blue in palette]


# A scene's motion as frames, and `record`.


class SceneFrames:
    """Pictures of a scene at the phases of a plan; `noted` adds notes on limits and change points."""

    independent = True

    def __init__(
        self, scene: Scene, plan: Plan, size: tuple[int, int], look: Look, *, noted: bool = False
    ) -> None:
        self.size = size
        self.alpha = not look.background
        self.colours = theme_colours(look)
        self._plan = plan
        self._picture, self._printer = Picture(scene, size, look, noted=noted), SurfacePrinter()
        self._surface = offscreen(size, alpha=self.alpha)

    def draw(self, frame: int) -> Frame:
        """Return the bytes of a frame, which the next call overwrites."""
        phase, speed = self._plan.phase(frame), self._plan.speed
        self._printer.print(self._surface, self._picture, phase, speed)
        return pixel_view(self._surface)


class ConstructionFrames(SceneFrames):
    """Pictures of the steps of a construction, over the pose at which a plan begins."""

    independent = False

    def __init__(
        self, scene: Scene, plan: Plan, size: tuple[int, int], look: Look, kind: ConstructionKind
    ) -> None:
        from linkanim.picture.constructed import places_of, steps_before

        super().__init__(scene, plan, size, look)
        phase = plan.clip.start
        self._before = steps_before(scene, kind)
        places = places_of(scene, kind, phase)
        self._picture = Picture(scene, size, look, moment=phase, also=places, docked=Docked(head=True))
        self._drawn = 0

    def draw(self, frame: int) -> Frame:
        """Return the bytes of a frame; the frames of one step are drawn once."""
        step, speed = self._plan.step(frame), self._plan.clip.speed
        if step != self._drawn:
            beside = Additions(steps=self._before + step)
            self._printer.print(self._surface, self._picture, self._plan.clip.start, speed, beside)
            self._drawn = step
        return pixel_view(self._surface)


def record(
    scene: Scene,
    path: Target,
    *,
    size: tuple[int, int] = (1280, 720),
    fps: float = 25.0,
    speed: float | None = None,
    periods: int = 1,
    seconds: float | None = None,
    reverse: bool = False,
    start: float = 0.0,
    look: Look = Look(),  # noqa: B008 -- frozen
    noted: bool = False,
    construction: ConstructionKind | None = None,
    steps: int | None = None,
    progress: Progress | None = None,
) -> Recording:
    """Record whole periods of a scene's motion to a file, in the format that the path's ending stands for.

    `size` is in pixels. `speed` is dφ/dt in rad/s, the scene's own if it is None. `seconds` sets the length
    instead of `periods` (true periods); the clip need not close then. `start` is the phase of the first
    frame. With `noted` the text notes nearby limits and change points. With a `construction`, its steps are
    recorded instead of motion, over the pose at `start`, a second each; only the first `steps` if that is not
    None. `progress` is called with (frames done, frames in all). The file appears when it is whole, or not at
    all. `BadInput`, before any work, for what cannot be recorded; `RecordingFailed` if the disk or the
    encoder gives up.
    """
    _, form = checked_path(path)
    refuse_size(size)
    rate = scene.linkage.drive.speed if speed is None else speed
    if construction:
        # a construction imports the synthesis, which a motion does not need
        from linkanim.picture.constructed import steps_of

        count = min(len(steps_of(scene, construction, start)), steps or MOST_FRAMES)
        plan = make_plan(Clip(rate, scene.period, fps, start=start, steps=count), form)
        return write(ConstructionFrames(scene, plan, size, look, construction), plan, path, progress)
    plan = make_plan(Clip(rate, scene.period, fps, periods, seconds, reverse, start), form)
    return write(SceneFrames(scene, plan, size, look, noted=noted), plan, path, progress)


def theme_colours(look: Look) -> tuple[Colour, ...]:
    """Return every colour of a look's theme: a GIF has to show flat areas of these exactly."""
    plain: list[Colour] = []
    for value in astuple(theme_of(look.theme, lit=look.material == "lit")):
        if isinstance(value, tuple):
            plain += value if isinstance(value[0], tuple) else [value]
    return tuple(dict.fromkeys(plain))
