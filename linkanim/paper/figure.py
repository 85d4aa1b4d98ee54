"""One pose of a scene as a figure: the window's picture as SVG, PNG or PDF."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cached_property

import pygame

from linkanim.frozen import frozen
from linkanim.mechanics.motion import Pose
from linkanim.paper.pdf import pages, require_pdf
from linkanim.paper.sentences import of_pose
from linkanim.paper.svg import svg
from linkanim.picture.drawn import NOTHING_ADDED, Additions
from linkanim.picture.figure import figure
from linkanim.picture.items import Group
from linkanim.picture.layout import Docked
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.quantities import input_at
from linkanim.picture.raster import Colour, offscreen
from linkanim.picture.stills import still_phase
from linkanim.picture.surface import SurfacePrinter
from linkanim.scenes.scene import Scene


def moving(scene: Scene, size: tuple[int, int], look: Look, phases: Iterable[float], speed: float) -> bytes:
    """Return a scene's poses at phases (rad), at a speed (rad/s), each as a page of a PDF.

    Names and numbers stand as in a recording. `BadInput` where fpdf2 is not installed.
    """
    require_pdf()
    picture = Picture(scene, size, look)
    background = picture.theme.background if look.background else None
    poses = (picture.poses(phase, speed) for phase in phases)
    frames = (picture.groups(pose, faint=faint) for pose, faint in poses)
    return pages(size, background, frames, title=scene.title)


@frozen
class Figured:
    """What a figure shows of a scene: its pose at a phase, and faint `poses` spread over the period.

    Without a `phase` (rad) it is the pose that reads best. Values are for `speed` (rad/s), the scene's own
    where it is None, and the input's `acceleration`. Names stand as is best for this pose alone, or `as_seen`
    in a window. What is drawn `beside` the scene comes on top. Bodies are flat, as in
    print, unless they are `lit`.
    """

    scene: Scene
    size: tuple[int, int]
    look: Look
    phase: float | None = None
    poses: int = 0
    speed: float | None = None
    acceleration: float = 0.0
    as_seen: bool = False
    beside: Additions = NOTHING_ADDED
    lit: bool = False

    @cached_property
    def shown_phase(self) -> float:
        """The phase that it shows."""
        return still_phase(self.scene) if self.phase is None else self.phase

    @property
    def caption(self) -> str:
        """Where the input is, within one turn: θ₂ = 87.0°."""
        return input_at(self.scene, self.scene.pose(self.shown_phase, 0).coordinate)

    @cached_property
    def picture(self) -> Picture:
        """The picture whose pose it shows."""
        moment = None if self.as_seen else self.shown_phase
        docked = Docked(head=self.beside.steps > 0)
        look = replace(self.look, material="lit" if self.lit else "flat")
        return Picture(self.scene, self.size, look, apart=True, moment=moment, docked=docked)

    @cached_property
    def _poses(self) -> tuple[Pose, tuple[Pose, ...]]:
        """The pose drawn in full and the faint ones: the other closure's, then those over the period."""
        pose, faint = self.picture.poses(self.shown_phase, self.speed, self.acceleration)
        phases = (self.shown_phase + self.scene.period * n / self.poses for n in range(self.poses))
        return pose, (*faint, *(self.scene.pose(phase, 0) for phase in phases))

    def groups(self) -> Iterator[Group]:
        """Yield all that is drawn, back to front."""
        pose, faint = self._poses
        return self.picture.groups(pose, self.beside, faint=faint)

    def surface(self) -> pygame.Surface:
        """Return the figure drawn; without a background it is clear where nothing is drawn."""
        surface, (pose, faint) = offscreen(self.size, alpha=not self.look.background), self._poses
        SurfacePrinter().paint(surface, self.picture, pose, self.beside, faint=faint)
        return surface

    def document(self) -> str:
        """Return the figure as SVG."""
        return svg(self.size, self.background, self.groups(), title=self.title)

    @property
    def title(self) -> str:
        """What it shows."""
        return self.scene.title

    @property
    def words(self) -> str:
        """How the links stand."""
        return of_pose(self.scene, self.shown_phase)

    @property
    def background(self) -> Colour | None:
        """The colour under everything; None where it is left open."""
        return self.picture.theme.background if self.look.background else None


DIMENSIONED = Look(names=2, hud=False)
"""How a scene looks in the figure of its dimensions: nothing in it is of another pose."""
_LEVEL, _UPRIGHT = (560, 370), (440, 520)
_HIGH = 1.1
"""The ratio of height to width above which a scene's figure is upright."""


def dimensioned(scene: Scene, phase: float) -> Figured:
    """Return the figure of a scene's dimensions at a phase, of the scene's own shape."""
    box = figure(scene).box
    size = _UPRIGHT if box.high - box.low > _HIGH * (box.right - box.left) else _LEVEL
    return Figured(scene, size, DIMENSIONED, phase)
