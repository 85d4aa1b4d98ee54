"""The painter of one scene at one size and look: what stands still once, what moves at every frame."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

import pygame

from linkanim.mechanics.motion.motion import Pose
from linkanim.picture.arrangement.staging import Staging, staged, wanted_of
from linkanim.picture.backdrop import Backdrop, wipe
from linkanim.picture.diagrams.chart import pen_for
from linkanim.picture.diagrams.strip import Strip, strip
from linkanim.picture.drawing import Drawing
from linkanim.picture.figure import Figure, figure
from linkanim.picture.items import Scribe, flat, worded
from linkanim.picture.layout import Layout
from linkanim.picture.look import Look
from linkanim.picture.panels.hud import Hud
from linkanim.picture.panels.legend import legend_for
from linkanim.picture.panels.marks import draw_measure, glow, grip
from linkanim.picture.panels.overlay import DimensionLine, Overlay
from linkanim.picture.panels.panels import Panels
from linkanim.picture.raster.blend import Mix, mix
from linkanim.picture.raster.raster import Layer, is_clear, keep_memory, paint, paints, pixels_of, stencil
from linkanim.picture.text.text import Type
from linkanim.picture.theme import Theme, theme_of
from linkanim.picture.turned import Turned
from linkanim.picture.view import View
from linkanim.scenes.scene import Scene

if TYPE_CHECKING:
    from linkanim.picture.labels.names import Names


class Painter:
    """Paints poses of one scene at one pixel size and look.

    It solves one cycle and draws its static layer when it is made; make a new one when scene, size
    or look changes. `beside` is a scene that must fit into the view too, such as the other closure.
    `before` is a painter that this one takes over from: what it drew of text and panels is kept where
    the size is the same, and nothing else changes. What was measured of the scene stays as long as it does.
    `listed` leaves room for the edit list, instead of the HUD. A `brief` painter paints a pose or two, as
    one for a scene on its way to another does: it prepares nothing for more.
    Raises BadInput where the look's chart is no quantity of the scene.
    """

    def __init__(
        self,
        scene: Scene,
        size: tuple[int, int],
        look: Look,
        *,
        beside: Scene | None = None,
        before: Painter | None = None,
        listed: bool = False,
        brief: bool = False,
    ) -> None:
        keep_memory()
        self.scene, self.size, self.look = scene, size, look
        self._brief = brief or scene.towards is not None
        self._theme: Theme = theme_of(look.theme)
        self._type: Type = before._type if before and before.size == size else Type()
        wanted, kept = wanted_of(size, look, listed=listed), before._staging if before else None
        self._staging: Staging = staged(scene.towards or scene, beside, wanted, self._type, before=kept)
        self._figure: Figure = figure(scene) if scene.towards else self._staging.subject.figure
        self._layout: Layout = self._staging.arrangement.layout
        self.drawing = Drawing(self._staging.scenery(self._figure, self._theme, look))
        self.view: View = self.drawing.scenery.view
        self._strip: Strip | None = self._chart()
        self._hud: Hud | None = self._worded(before)
        self._panels: Panels = self._laid_over(before)
        last = (before.drawing, before.names) if before else (None, None)
        self.names: Names | None = self.drawing.names(self._type, *last)
        self._legend = legend_for(self.drawing.cast.arrows, self._layout, self._type, self._theme)
        self._still = self._drawn_once()
        self._paced: tuple[float, Backdrop] | None = None
        self._polygons = self.drawing.polygons(self._type)
        self._scribe: Scribe = before._scribe if before and before._type is self._type else Scribe(self._type)

    def paint(
        self,
        surface: pygame.Surface,
        pose: Pose,
        overlay: Overlay = Overlay(),  # noqa: B008 -- frozen
        *,
        ghost: Pose | None = None,
    ) -> None:
        """Draw a pose, with the other closure's pose `ghost` faintly behind it where the look asks.

        Changes the surface only; the same arguments give the same bytes. A surface that is not as
        large as the painter's size is painted from its top left corner.
        """
        canvas = self._canvas(surface)
        self._lay_backdrop(canvas, pose, ghost if self.look.ghost else None)
        moving = list(self.drawing.moving(pose))
        beside = [polygon.group(pose) for polygon in self._polygons]
        on_chart = self._on_chart(pose, grasped=overlay.grip)
        paint(canvas, flat(moving), ends=self._ends, over=(*flat(beside), *on_chart))
        self._scribe.draw(canvas.subsurface(self._layout.reach), worded(moving))
        self._scribe.draw(canvas, worded(beside))
        if self.names:
            self.names.draw(canvas.subsurface(self._layout.reach), pose, self.drawing.places(pose))
        if self._strip:
            self._strip.draw_reading(canvas, pose)
        if self._hud:
            self._hud.draw(canvas, pose, noted=overlay.noted, backed=self.look.overrun)
        self._handled(canvas, pose, overlay)
        self._panels.draw(canvas, overlay)
        if canvas is not surface:
            surface.blit(canvas, (0, 0))

    def _lay_backdrop(self, canvas: pygame.Surface, pose: Pose, ghost: Pose | None) -> None:
        """Bring the canvas to what stands still, with what moves behind it."""
        backdrop, places = self._backdrop_at(pose.input_speed), self.drawing.places(pose)
        faint = self.drawing.faint(ghost) if ghost else ()
        wipe(canvas, backdrop.whole)
        if self._brief:
            standing = self.drawing.standing if self.drawing.moves_behind else ()
            paint(canvas, (*flat(self.drawing.wheels(places)), *faint, *flat(standing)), ends=self._ends)
            return
        if self._turned:
            self._turned.paint(canvas, backdrop, places)
        if self._layered:
            wheels = () if self._turned else flat(self.drawing.wheels(places))
            paint(canvas, (*wheels, *faint), ends=self._ends)
            mix(pixels_of(canvas), self._stencil, clear=is_clear(canvas))

    @cached_property
    def _layered(self) -> bool:
        """Whether what moves behind the lines that stand still is painted anew at every frame."""
        return self.drawing.moves_behind and (self.look.ghost or not self._turned)

    def _handled(self, canvas: pygame.Surface, pose: Pose, overlay: Overlay) -> None:
        """Draw what is there for the hand: the chosen bar, and the joint to be dragged."""
        gauge = self.drawing.scenery.gauge
        if overlay.measured:
            begin, end, words = overlay.measured
            shown = DimensionLine((pose.position[begin], pose.position[end]), words)
            draw_measure(canvas, self._panels.board, self.view, gauge, shown)
        if overlay.glow:
            paint(canvas, glow(self.view, pose, overlay.glow, gauge))

    def _on_chart(self, pose: Pose, *, grasped: bool) -> Iterator[Layer]:
        """Yield the chart's cursor, and its grip where it can be grasped."""
        if self._strip:
            yield from self._strip.cursor(pose)
            if grasped:
                yield from grip(self._strip.foot(pose), self._layout.unit, self._theme)

    def crank_pin_px(self, pose: Pose) -> tuple[float, float]:
        """Return where the pin that the phase drives lies, in pixels."""
        return self.view.to_pixel(*pose.position[self.scene.linkage.drive.joint])

    def chart_phase_at(self, px: float, py: float) -> float | None:
        """Return the phase under a pixel of the chart, 0 to one true period; None beside the chart."""
        return self._strip.phase_at(px, py) if self._strip else None

    def _worded(self, before: Painter | None) -> Hud | None:
        arrangement, place = self._staging.arrangement, self._layout.hud
        if arrangement.block is None or place is None:
            return None
        if before and before._staging is self._staging and before._theme == self._theme:
            return before._hud
        return Hud(self._staging.subject.figure.scene, arrangement.block, place, self._type, self._theme)

    def _laid_over(self, before: Painter | None) -> Panels:
        if before and (before._layout, before._theme) == (self._layout, self._theme):
            return before._panels
        return Panels(self._layout, self._type, self._theme)

    def _chart(self) -> Strip | None:
        if self.look.chart is None:
            return None
        pen = pen_for(self._layout, self._type, self._theme)
        return strip(self._figure, self.look.chart, self._layout, pen)

    def _drawn_once(self) -> pygame.Surface:
        """Return the layer that stands still but for the chart: background, ground, curves, key."""
        flags = 0 if self.look.background else pygame.SRCALPHA
        still = pygame.Surface(self.size, flags, 32)
        still.fill((*self._theme.background, 255 if self.look.background else 0))
        standing = () if self.drawing.moves_behind else self.drawing.standing
        paint(still, flat((self.drawing.discs(), *standing)), ends=self._ends)
        if self._legend:
            self._legend.draw(still)
        return still

    def _backdrop_at(self, speed: float) -> Backdrop:
        """Return what stands still, with what of it goes by the speed: chart and key's values."""
        if self._paced is None or (self._paced[0] != speed and (self._strip or self._legend)):
            self._paced = speed, self._backdrop_for(speed)
        return self._paced[1]

    def _backdrop_for(self, speed: float) -> Backdrop:
        behind = self._still
        if self._strip or self._legend:
            behind = behind.copy()
        if self._strip:
            self._strip = self._strip.at(speed)
            self._strip.draw(behind)
        if self._legend:
            self._legend.draw_values(behind, speed)
        if self._brief or self._layered or not self.drawing.moves_behind:
            return Backdrop(behind, None, behind)
        whole = behind.copy()
        mix(pixels_of(whole), self._stencil, clear=is_clear(whole))
        return Backdrop(behind, self._stencil, whole)

    def _canvas(self, surface: pygame.Surface) -> pygame.Surface:
        """Return the surface itself where it is like the static layer, else one that is."""
        alike = surface.get_size() == self.size and surface.get_masks() == self._still.get_masks()
        return surface if alike and paints(surface) else self._spare

    @cached_property
    def _spare(self) -> pygame.Surface:
        return self._still.copy()

    @cached_property
    def _ends(self) -> tuple[int, int]:
        """The column and the row that keep the scene off the chart."""
        return int(self._layout.reach.right), int(self._layout.reach.bottom)

    @cached_property
    def _turned(self) -> Turned | None:
        """What turns behind it about fixed joints; None where not all of it may be painted in sets."""
        sets = self.drawing.turning_apart
        return Turned(sets, self._ends) if any(sets) else None

    @cached_property
    def _stencil(self) -> Mix:
        """What stands still with something moving behind it."""
        return stencil(flat(self.drawing.standing), self._still, ends=self._ends)
