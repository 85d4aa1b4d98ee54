"""What is shown of a scene, apart from the pose: the choices that outlast a frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

ThemeName = Literal["light", "dark"]

VELOCITY: Literal["v"] = "v"
ACCELERATION: Literal["a"] = "a"


@dataclass(frozen=True)
class Look:
    """What is shown; two pictures of one pose with equal looks and sizes have the same bytes.

    `vectors` holds "v" (velocity) and "a" (acceleration). `chart` names one of
    `quantities(scene)`, None for no chart. With `background` False what is not drawn stays
    transparent. `zoom` multiplies the fitted scale; `pan` shifts the picture right and down, in
    fractions of the window's height. `ghost` draws the other closure faintly, where it is given.
    `names` is 0 for none, 1 for those of joints and links with the ground line and the input's
    direction of turning, 2 for dimensions and the input's angle as well. `polygons` draws those of
    velocity and acceleration beside the linkage. `centres` is 0 for none, 1 for the instant centres, 2 for
    the coupler's centrodes as well.
    """

    theme: ThemeName = "light"
    trace: bool = True
    vectors: frozenset[str] = frozenset()
    chart: str | None = None
    hud: bool = True
    background: bool = True
    zoom: float = 1.0
    pan: tuple[float, float] = (0.0, 0.0)
    ghost: bool = False
    names: int = 0
    polygons: bool = False
    centres: int = 0

    @property
    def framed(self) -> bool:
        """Whether it is zoomed or panned."""
        return self.zoom != 1 or self.pan != (0.0, 0.0)

    @property
    def overrun(self) -> bool:
        """Whether curves or the scene itself may lie where the words stand."""
        return self.framed or self.centres > 1
