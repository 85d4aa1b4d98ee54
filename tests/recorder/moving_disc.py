"""A picture that moves and needs no linkage: a disc with a soft edge on a circular path."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from linkanim.recorder.palette import Colour
from linkanim.recorder.plan import Clip, Format, Plan, make_plan

BACKGROUND = (252, 252, 250)
DISC = (213, 94, 0)
TURN = 2.0 * math.pi
TWO_SECONDS = Clip(speed=TURN / 2.0, period=TURN)


@dataclass(frozen=True)
class MovingDisc:
    """Frames of the disc, one turn over the plan; `on_draw` sees each frame's number, in this process."""

    plan: Plan
    size: tuple[int, int] = (64, 48)
    alpha: bool = False
    colours: Sequence[Colour] = field(default=(BACKGROUND, DISC))
    independent: bool = False
    on_draw: Callable[[int], None] = lambda frame: None

    def draw(self, frame: int) -> memoryview:
        self.on_draw(frame)
        return memoryview(self.pixels(frame).tobytes())

    def pixels(self, frame: int) -> NDArray[np.uint8]:
        """Return (height, width, 4): blue, green, red, alpha (0 where alpha means nothing)."""
        width, height = self.size
        phase = self.plan.phase(frame)
        x = width * (0.5 + 0.25 * math.cos(phase))
        y = height * (0.5 - 0.25 * math.sin(phase))
        rows, columns = np.mgrid[0:height, 0:width]
        distance = np.hypot(columns + 0.5 - x, rows + 0.5 - y)
        cover = np.clip(height / 6 + 0.5 - distance, 0.0, 1.0)[..., None]
        red, green, blue = (cover * np.array(DISC) + (1.0 - cover) * np.array(BACKGROUND)).transpose(2, 0, 1)
        opacity = 255 * cover[..., 0] if self.alpha else np.zeros_like(red)
        levels: NDArray[np.float64] = np.rint(np.stack([blue, green, red, opacity], axis=2))
        return levels.astype(np.uint8)

    def rgb(self, frame: int) -> NDArray[np.uint8]:
        """Return (height, width, 3) as decoders give it."""
        bgr: NDArray[np.uint8] = self.pixels(frame)[..., 2::-1]
        return bgr


def disc(
    form: Format, clip: Clip = TWO_SECONDS, *, size: tuple[int, int] = (64, 48), alpha: bool = False
) -> MovingDisc:
    """Return the disc as planned for a format."""
    return MovingDisc(make_plan(clip, form), size, alpha)
