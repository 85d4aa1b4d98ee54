"""A scene's motion as frames, and `record`."""

from __future__ import annotations

from dataclasses import astuple
from typing import TYPE_CHECKING

from linkanim.picture.look import Look
from linkanim.picture.panels.overlay import Overlay
from linkanim.picture.picture import Picture
from linkanim.picture.raster.offscreen import offscreen, pixel_view
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.theme import theme_of
from linkanim.recorder.plan import Clip, Plan, make_plan, refuse_size
from linkanim.recorder.recording import Progress, Recording, Target, checked_path, write

if TYPE_CHECKING:
    from linkanim.recorder.palette import Colour
    from linkanim.recorder.process import Frame
    from linkanim.scenes.scene import Scene


class SceneFrames:
    """Pictures of a scene at the phases of a plan; `noted` as in the overlay."""

    def __init__(
        self, scene: Scene, plan: Plan, size: tuple[int, int], look: Look, *, noted: bool = False
    ) -> None:
        self.size = size
        self.alpha = not look.background
        self.colours = theme_colours(look.theme)
        self._plan = plan
        self._over = Overlay(noted=noted)
        self._picture, self._printer = Picture(scene, size, look), SurfacePrinter()
        self._surface = offscreen(size, alpha=self.alpha)

    def draw(self, frame: int) -> Frame:
        """Return the bytes of a frame, to be let go before the next is drawn in their place."""
        phase, speed = self._plan.phase(frame), self._plan.speed
        self._printer.print(self._surface, self._picture, phase, speed, self._over)
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
    progress: Progress | None = None,
) -> Recording:
    """Record whole periods of a scene's motion as a GIF, MP4 or numbered PNG, by the path's ending.

    `size` in pixels; `speed` is dφ/dt in rad/s, the scene's own where None; `seconds` sets the length
    instead of `periods` (true periods), and the clip need not close then; `start` is the first frame's
    phase. With `noted` the HUD says where a limit or a change point is near. `progress` is called with
    (frames done, frames in all). The file appears when it is whole, or not at all. `BadInput` for what
    cannot be recorded, before any work; `RecordingFailed` where disk or encoder give up.
    """
    _, form = checked_path(path)
    refuse_size(size)
    rate = scene.linkage.drive.speed if speed is None else speed
    plan = make_plan(Clip(rate, scene.period, fps, periods, seconds, reverse, start), form)
    return write(SceneFrames(scene, plan, size, look, noted=noted), plan, path, progress)


def theme_colours(theme: str) -> tuple[Colour, ...]:
    """Return every colour of a theme, flat areas of which a GIF has to show exactly."""
    plain: list[Colour] = []
    for value in astuple(theme_of(theme)):
        plain += value if isinstance(value[0], tuple) else [value]
    return tuple(dict.fromkeys(plain))
