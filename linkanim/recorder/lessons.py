"""Record a lesson: all its steps in one file, or a file for each step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from linkanim.picture.look import Look
from linkanim.player.action import Action
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.lesson import LessonStep
from linkanim.player.state import begin
from linkanim.player.tape import Tape
from linkanim.recorder.recording import Progress, Recording, Target, record
from linkanim.recorder.tape_frames import record_played

_STANDS = 4.0
"""The seconds of a step that stands."""
_LEAST, _MOST = 2.0, 20.0
"""The least and the most seconds of a step that runs for one period."""


def record_lesson(
    steps: Sequence[LessonStep],
    path: Target,
    *,
    size: tuple[int, int] = (1280, 720),
    fps: float = 25.0,
    look: Look = Look(),  # noqa: B008 -- frozen
    progress: Progress | None = None,
) -> Recording:
    """Record all steps one after the other, in the theme and material of a look; errors as `record`."""
    return record_played(_tape(steps, size, look), path, size, fps, progress)


def record_step(
    step: LessonStep,
    path: Target,
    *,
    size: tuple[int, int] = (1280, 720),
    fps: float = 25.0,
    look: Look = Look(),  # noqa: B008 -- frozen
    progress: Progress | None = None,
) -> Recording:
    """Record one step: one that runs as a loop of its true period, unless it states its seconds."""
    if step.running and step.seconds is None and not step.construction:
        shown = replace(step.look, theme=look.theme, material=look.material)
        asked = {"size": size, "fps": fps, "start": step.phase, "look": shown, "progress": progress}
        return record(step.scene, path, **asked)  # type: ignore[arg-type]
    return record_played(_tape([step], size, look), path, size, fps, progress)


def _tape(steps: Sequence[LessonStep], size: tuple[int, int], look: Look) -> Tape:
    """Return the tape on which each step is shown for its time."""
    actions, frame = list[tuple[int, Action]](), 0
    for n, step in enumerate(steps, start=1):
        actions.append((frame, Action("stage", step.text(n, len(steps)))))
        frame += max(round(_seconds(step) * FRAMES_PER_SECOND), 1)
    return Tape(begin(steps[0].scene, look=look), frame, tuple(actions), size)


def _seconds(step: LessonStep) -> float:
    """Return how long a step lasts: as it states, else one true period, or a few seconds where it stands."""
    if step.seconds is not None:
        return step.seconds
    if not step.running:
        return _STANDS
    return min(max(abs(step.scene.period / step.scene.linkage.drive.speed), _LEAST), _MOST)
