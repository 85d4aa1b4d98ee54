"""A tape's states as frames, and `record_tape`."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from linkanim.picture.look import Look, Material, ThemeName
from linkanim.picture.photograph import refuse_lacking
from linkanim.picture.raster import offscreen, pixel_view
from linkanim.picture.surface import SurfacePrinter
from linkanim.play.games import game_of
from linkanim.player import tape_file
from linkanim.recorder.plan import SIDES, Clip, make_plan, refuse_size
from linkanim.recorder.recording import (
    Progress,
    Recording,
    Target,
    checked_path,
    record,
    theme_colours,
    write,
)
from linkanim.ui.panels import Panels
from linkanim.ui.pictures import Framing, recorded
from linkanim.ui.shelf import RowPrinter, answers_of
from linkanim.words import speaking

if TYPE_CHECKING:
    from linkanim.player.state import State
    from linkanim.player.tape import Tape
    from linkanim.recorder.encode import Frame


_LONGER = 1280


class TapeFrames:
    """Pictures of what a tape does: each is drawn from its state alone, to which the tape's actions lead."""

    independent = True

    def __init__(self, tape: Tape, fps: float, size: tuple[int, int], *, photo: bool = False) -> None:
        self.size = size
        self.alpha = not tape.start.look.background
        self.colours = tuple(colour for look in _looks(tape) for colour in theme_colours(look))
        self._tape = tape
        self._fps, self._photo = fps, photo
        self._surface = offscreen(size, alpha=self.alpha)
        self._framing = Framing()
        self._printer, self._panels, self._row = SurfacePrinter(), Panels(), RowPrinter(at_once=True)
        self._ahead: Iterator[tuple[State, float]] = iter(())
        self._next = 0

    def draw(self, frame: int) -> Frame:
        """Return the bytes of a frame, which the next call overwrites."""
        state, phase = self._at(frame)
        with speaking(state.language):
            return self._drawn(state, phase)

    def _drawn(self, state: State, phase: float) -> Frame:
        picture, beside = self._framing.at(state, self.size), recorded(state, photo=self._photo)
        if beside.photo:
            refuse_lacking(beside.photo.file)
        self._printer.print(self._surface, picture, phase, state.clock.speed, beside)
        row, theme = answers_of(state), state.look.theme
        self._row.draw(self._surface, picture.layout, row, state.frame, theme)
        for one in self._panels.drawn(state, picture.layout, picture.theme, shown="tape")[0]:
            self._surface.blit(one.surface, one.at)
        return pixel_view(self._surface)

    def _at(self, frame: int) -> tuple[State, float]:
        if frame < self._next or not self._next:
            self._ahead, self._next = self._tape.pictures(self._fps), 0
        skipped, self._next = frame - self._next, frame + 1
        return next(islice(self._ahead, skipped, None))


def _shape(window: tuple[int, int]) -> tuple[int, int]:
    """Return an even size in the shape of a window, 1280 pixels along its longer side."""
    width, height = (max(2 * round(_LONGER / 2 * side / max(window)), SIDES[0]) for side in window)
    return width, height


def _looks(tape: Tape) -> tuple[Look, ...]:
    """Return the looks that a tape shows, as far as their colours differ."""
    start, names = tape.start.look, {action.name for _, action in tape.actions}
    themes: tuple[ThemeName, ...] = ("light", "dark") if "theme" in names else (start.theme,)
    materials: tuple[Material, ...] = ("lit", "flat") if "material" in names else (start.material,)
    return tuple(replace(start, theme=theme, material=one) for theme in themes for one in materials)


def record_tape(
    tape: str | os.PathLike[str],
    path: Target,
    *,
    size: tuple[int, int] | None = None,
    fps: float = 25.0,
    progress: Progress | None = None,
    photo: bool = False,
) -> Recording:
    """Record what a tape does; a tape without actions gives the scene's loop.

    Without a `size` it has the window's shape, so that all stands where it was seen. With `photo` the
    photograph behind what is built is recorded, too; `BadInput` if it cannot be shown.

    The loop starts at the phase at which the tape does. Errors as `record`, and `BadInput` for a
    file that is not a tape of this version.
    """
    checked_path(path)
    if size:
        refuse_size(size)
    return record_played(tape_file.read(Path(tape), game_of), path, size, fps, progress, photo=photo)


def record_played(
    played: Tape,
    path: Target,
    size: tuple[int, int] | None = None,
    fps: float = 25.0,
    progress: Progress | None = None,
    *,
    photo: bool = False,
) -> Recording:
    """Record what a tape does, as `record_tape`."""
    _, form = checked_path(path)
    size = size or _shape(played.size)
    state = played.start
    if played.is_loop and not state.listed:
        loop = partial(record, speed=state.clock.speed, start=state.phase, look=state.look, noted=True)
        return loop(state.scene, path, size=size, fps=fps, progress=progress)
    clip = Clip(state.clock.speed, state.scene.period, fps, seconds=max(played.seconds, 1.0 / fps))
    plan = make_plan(clip, form)
    plan = replace(plan, frames=max(1, round(played.seconds * float(plan.rate))))
    return write(TapeFrames(played, float(plan.rate), size, photo=photo), plan, path, progress)
