"""A tape's states as frames, and `record_tape`."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from linkanim.picture.panels.overlay import Overlay
from linkanim.picture.picture import Picture
from linkanim.picture.raster.offscreen import offscreen, pixel_view
from linkanim.picture.surface import SurfacePrinter
from linkanim.player.tape import tape_file
from linkanim.recorder.plan import Clip, make_plan, refuse_size
from linkanim.recorder.recording import Progress, Recording, checked_path, write
from linkanim.recorder.scene_frames import record, theme_colours

if TYPE_CHECKING:
    from linkanim.player.state.state import State
    from linkanim.player.tape.tape import Tape
    from linkanim.recorder.process import Frame


class TapeFrames:
    """Pictures of what a tape does. Drawn in their order each costs one; going back starts anew."""

    def __init__(self, tape: Tape, fps: float, size: tuple[int, int]) -> None:
        self.size = size
        self.alpha = not tape.start.look.background
        self.colours = tuple(colour for theme in _themes(tape) for colour in theme_colours(theme))
        self._tape = tape
        self._fps = fps
        self._surface = offscreen(size, alpha=self.alpha)
        self._picture: Picture | None = None
        self._printer = SurfacePrinter()
        self._ahead: Iterator[tuple[State, float]] = iter(())
        self._next = 0

    def draw(self, frame: int) -> Frame:
        """Return the bytes of a frame, to be let go before the next is drawn in their place."""
        state, phase = self._at(frame)
        picture, speed = self._picture_of(state), state.clock.speed
        self._printer.print(self._surface, picture, phase, speed, Overlay())
        return pixel_view(self._surface)

    def _at(self, frame: int) -> tuple[State, float]:
        if frame < self._next or not self._next:
            self._ahead, self._next = self._tape.pictures(self._fps), 0
        skipped, self._next = frame - self._next, frame + 1
        return next(islice(self._ahead, skipped, None))

    def _picture_of(self, state: State) -> Picture:
        if self._picture is None or not self._picture.fits(state.shown, self.size, state.look):
            self._picture = Picture(state.shown, self.size, state.look, self._picture)
        return self._picture


def _themes(tape: Tape) -> tuple[str, ...]:
    """Return the themes that a tape shows."""
    changes = any(action.name == "theme" for _, action in tape.actions)
    return ("light", "dark") if changes else (tape.start.look.theme,)


def record_tape(
    tape: str | os.PathLike[str],
    path: str | os.PathLike[str],
    *,
    size: tuple[int, int] = (1280, 720),
    fps: float = 25.0,
    progress: Progress | None = None,
) -> Recording:
    """Record what a tape does, at any size; a tape in which nothing is done, as the scene's loop.

    The loop starts at the phase at which the tape does. Errors as `record`, and `BadInput` for a
    file that is not a tape of this version.
    """
    _, form = checked_path(path)
    refuse_size(size)
    played = tape_file.read(Path(tape))
    state = played.start
    if played.is_loop:
        loop = partial(record, speed=state.clock.speed, start=state.phase, look=state.look)
        return loop(state.scene, path, size=size, fps=fps, progress=progress)
    clip = Clip(state.clock.speed, state.scene.period, fps, seconds=max(played.seconds, 1.0 / fps))
    plan = make_plan(clip, form)
    plan = replace(plan, frames=max(1, round(played.seconds * float(plan.rate))))
    return write(TapeFrames(played, float(plan.rate), size), plan, path, progress)
