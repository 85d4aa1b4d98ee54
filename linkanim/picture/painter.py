"""The painter of one scene at one size and look: what stands still once, what moves at every frame."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import zip_longest

import numpy as np
import pygame

from linkanim.mechanics.kinds import Crank
from linkanim.mechanics.motion import Pose
from linkanim.picture.bodies import body_parts, mark_stamp, mass_stamp, pin_stamp
from linkanim.picture.chart import pen_for
from linkanim.picture.dimensions import Symbols, leg_part, pivots, symbols
from linkanim.picture.figure import Figure, figure
from linkanim.picture.fittings import fittings_box
from linkanim.picture.gears import wheel_layers, wheel_parts, wheels_box
from linkanim.picture.ground import ground_layers, ground_line
from linkanim.picture.hud import Hud, hud_for
from linkanim.picture.layout import Gauge, Layout, gauge, layout
from linkanim.picture.legend import legend_for
from linkanim.picture.look import ACCELERATION, VELOCITY, Look
from linkanim.picture.names import Hand, Names, names_of
from linkanim.picture.overlay import Overlay
from linkanim.picture.panels import Panels
from linkanim.picture.parts import Part, Places, Stamp, by_depth, placed
from linkanim.picture.raster import Layer, Stencil, paint, paints, stencil
from linkanim.picture.strip import Strip, strip
from linkanim.picture.struts import Coil, Cushion, coils, cushions
from linkanim.picture.text import Type
from linkanim.picture.theme import Theme, mixed, theme_of
from linkanim.picture.trace import Trace, traces
from linkanim.picture.turning import Turning, turning_of
from linkanim.picture.vectors import Arrows, arrows_of
from linkanim.picture.view import Box, View, fit, joined, moved
from linkanim.scenes.scene import Scene


def swept(figure: Figure) -> Box:
    """Return the rectangle of the scene that a linkage sweeps with its wheels, slotted bars and guides."""
    return fittings_box(figure, wheels_box(figure, figure.box))


_GHOST = 0.78
"""How much of the background is in the other closure's colours."""


@dataclass(frozen=True)
class Cast:
    """All that moves, ready to be placed."""

    wheels: tuple[Part, ...]
    struts: tuple[Coil | Cushion, ...]
    bodies: tuple[Part, ...]
    pinned: tuple[tuple[str, ...], ...]
    """The pins and marks that lie below the first of the bodies, and on each."""
    pin: Stamp
    mass: Stamp
    traces: tuple[Trace, ...]
    marks: Mapping[str, Stamp]
    arrows: tuple[Arrows, ...]
    turning: Turning | None
    legs: tuple[Part, ...]


class Painter:
    """Paints poses of one scene at one pixel size and look.

    It solves one cycle and draws its static layer when it is made; make a new one when scene, size
    or look changes. `beside` is a scene that must fit into the view too, such as the other closure.
    `before` is a painter that this one takes over from: what it drew of text and panels is kept where
    the size is the same, and nothing else changes. Its HUD stays where scene, size and theme do.
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
    ) -> None:
        self.scene, self.size, self.look = scene, size, look
        self._theme: Theme = theme_of(look.theme)
        self._layout: Layout = layout(size, look)
        self._figure: Figure = figure(scene)
        self._type: Type = before._type if before and before.size == size else Type()
        self.view, self._gauge = self._framed(figure(beside) if beside else self._figure)
        self._strip: Strip | None = self._chart()
        said = before._hud if before else None
        self._hud: Hud | None = hud_for(scene, self._layout, self._type, self._theme, before=said)
        self._panels: Panels = self._laid_over(before)
        self._cast = self._casting()
        self._names = self._named()
        self._legend = legend_for(self._cast.arrows, self._layout, self._type, self._theme)
        self._still = self._drawn_once()
        self._charted: pygame.Surface | None = None

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
        self._wipe(canvas, self._still_at(pose.input_speed))
        paint(canvas, self._moving(pose, ghost if self.look.ghost else None))
        if self._names:
            self._names.draw(canvas.subsurface(self._stage), pose, self._places(pose))
        if self._strip:
            self._strip.draw_reading(canvas, pose)
        if self._hud:
            canvas.blit(self._hud.sheet, self._hud.sheet.get_offset())
            self._hud.draw_values(canvas, pose, noted=overlay.noted)
        if self._legend:
            self._legend.draw_values(canvas, pose.input_speed)
        self._panels.draw(canvas, overlay)
        if canvas is not surface:
            surface.blit(canvas, (0, 0))

    def crank_pin_px(self, pose: Pose) -> tuple[float, float]:
        """Return where the pin that the phase drives lies, in pixels."""
        return self.view.to_pixel(*pose.position[self.scene.linkage.drive.joint])

    def crank_pivot_px(self) -> tuple[float, float]:
        """Return where the driven crank turns, in pixels."""
        crank = self.scene.linkage.joint(self.scene.linkage.drive.joint)
        pivot = self._figure.start(crank.pivot if isinstance(crank, Crank) else crank.name)
        return self.view.to_pixel(pivot.real, pivot.imag)

    def chart_phase_at(self, px: float, py: float) -> float | None:
        """Return the phase under a pixel of the chart, 0 to one true period; None beside the chart."""
        return self._strip.phase_at(px, py) if self._strip else None

    def _framed(self, beside: Figure) -> tuple[View, Gauge]:
        """Return the view of what the linkages sweep, and the thicknesses that go with its scale."""
        box, unit = joined(swept(self._figure), swept(beside)), self._layout.unit
        measure = gauge(unit, self._figure.shortest * fit(box, self._layout.scene).scale)
        room = self._layout.scene.inset(measure.pedestal + 1.5 * measure.bar)
        width, height = self.size
        pan = (self.look.pan[0] * height, self.look.pan[1] * height)
        view = moved(fit(box, room), (width / 2, height / 2), zoom=self.look.zoom, pan=pan)
        return view, measure

    def _laid_over(self, before: Painter | None) -> Panels:
        if before and (before._layout, before._theme) == (self._layout, self._theme):
            return before._panels
        return Panels(self._layout, self._type, self._theme)

    def _chart(self) -> Strip | None:
        if self.look.chart is None:
            return None
        pen = pen_for(self._layout, self._type, self._theme)
        return strip(self._figure, self.look.chart, self._layout, pen)

    def _casting(self) -> Cast:
        known = (self._figure, self.view, self._gauge, self._theme)
        curves = traces(*known) if self.look.trace else ()
        bodies = body_parts(*known)
        marked = [trace.joint for trace in curves if trace.joint not in self._figure.pins]
        return Cast(
            wheels=wheel_parts(*known),
            struts=(*coils(*known), *cushions(*known)),
            bodies=bodies,
            pinned=by_depth(bodies, (*self._figure.pins, *marked)),
            pin=pin_stamp(self._gauge, self._theme),
            mass=mass_stamp(self._gauge, self._theme),
            traces=curves,
            marks={
                trace.joint: mark_stamp(trace.colour, self._gauge, self._theme) for trace in reversed(curves)
            },
            arrows=tuple(
                arrows_of(self._figure, kind, self.size[1], self._gauge, self._theme)
                for kind in (VELOCITY, ACCELERATION)
                if kind in self.look.vectors
            ),
            turning=turning_of(*known) if self.look.names else None,
            legs=tuple(leg_part(legs, self.view, self._gauge, self._theme.dim) for legs in self._symbols.legs)
            if self.look.names > 1
            else (),
        )

    @cached_property
    def _symbols(self) -> Symbols:
        return symbols(self._figure)

    def _named(self) -> Names | None:
        """Return the names of joints and links, and their dimensions, where the look asks for them."""
        if not self.look.names:
            return None
        hand = Hand(self._type, self._layout, self._theme, self._gauge)
        known = self._symbols if self.look.names > 1 else None
        return names_of(self._figure, self.view, hand, self._cast.turning, known)

    @cached_property
    def _stage(self) -> pygame.Rect:
        """Return the window down to the chart."""
        chart = self._layout.chart
        return pygame.Rect(0, 0, self.size[0], int(chart.y) if chart else self.size[1])

    def _drawn_once(self) -> pygame.Surface:
        """Return the layer that stands still but for the chart: background, ground, curves, key."""
        flags = 0 if self.look.background else pygame.SRCALPHA
        still = pygame.Surface(self.size, flags, 32)
        still.fill((*self._theme.background, 255 if self.look.background else 0))
        known = (self._figure, self.view, self._gauge, self._theme)
        scene = [*wheel_layers(*known), *ground_layers(*known)]
        paint(still, list(self._on_stage(scene + ([] if self._moves_behind else self._lines()))))
        if self._legend:
            self._legend.draw(still)
        return still

    def _still_at(self, speed: float) -> pygame.Surface:
        """Return the layer that stands still, with the chart of the motion at this speed on it."""
        if not self._strip:
            return self._still
        if self._charted is None or self._strip.speed != speed:
            self._strip, self._charted = self._strip.at(speed), self._still.copy()
            self._strip.draw(self._charted)
        return self._charted

    def _canvas(self, surface: pygame.Surface) -> pygame.Surface:
        """Return the surface itself where it can be written to directly, else one like the static layer."""
        if surface.get_size() == self.size and paints(surface):
            return surface
        return self._spare

    @cached_property
    def _spare(self) -> pygame.Surface:
        return self._still.copy()

    def _on_stage(self, layers: Iterable[Layer]) -> Iterator[Layer]:
        """Yield the scene's layers, kept to the rows above the chart."""
        end = self._stage.bottom
        return (Layer(layer.colour, layer.loops, layer.alpha, end) for layer in layers)

    def _wipe(self, canvas: pygame.Surface, still: pygame.Surface) -> None:
        if canvas.get_flags() & pygame.SRCALPHA:
            canvas.fill((0, 0, 0, 0))
        canvas.blit(still, (0, 0))

    def _moving(self, pose: Pose, ghost: Pose | None) -> list[Layer | Stencil]:
        """Return all that moves, back to front, the chart's cursor last."""
        behind = [*placed(self._cast.wheels, self._places(pose)), *(self._ghost(ghost) if ghost else ())]
        layers: list[Layer | Stencil] = [*self._on_stage(behind), *self._curves]
        layers += self._on_stage(self._above(pose))
        return layers + (self._strip.cursor(pose) if self._strip else [])

    @property
    def _moves_behind(self) -> bool:
        """Whether something moves behind the curves."""
        return bool(self._cast.wheels) or self.look.ghost

    @cached_property
    def _curves(self) -> list[Stencil]:
        """The curves where something moves behind them; else they are part of what stands still."""
        lines = self._on_stage(self._lines()) if self._moves_behind else ()
        return [stencil(layer, self.size) for layer in lines]

    def _lines(self) -> list[Layer]:
        """Return the ground line and the whole curves."""
        known = (self._figure, self.view, self._gauge, self._theme)
        line = ground_line(pivots(self._figure), *known) if self.look.names else []
        return [*line, *(trace.whole() for trace in self._cast.traces)]

    def _above(self, pose: Pose) -> Iterator[Layer]:
        places, cast = self._places(pose), self._cast
        for trace in cast.traces:
            yield from trace.recent(pose.phase, places[trace.joint], forward=pose.input_speed >= 0)
        for strut in cast.struts:
            yield from strut.layers(places)
        yield from self._pinned(places)
        yield from placed(cast.legs, places)
        if cast.turning:
            yield from self._turning(pose, cast.turning, places)
        yield from cast.mass.at([self.view.place(at) for at in pose.com_position.values()])
        for kind in cast.arrows:
            yield from kind.layers(pose, self.view, self.scene.trace)

    def _turning(self, pose: Pose, turning: Turning, places: Places) -> Iterator[Layer]:
        """Yield the way the input turns, and its angle."""
        if self.look.names > 1:
            yield from turning.angle(places)
        if pose.input_speed:
            rate = abs(self.scene.linkage.drive.speed / pose.input_speed)
            yield from turning.direction(pose, places, rate)

    def _pinned(self, places: Places) -> Iterator[Layer]:
        """Yield the bodies with their pins, each pin at the depth of its own links."""
        for names, part in zip_longest(self._cast.pinned, self._cast.bodies):
            yield from self._cast.pin.at([places[name] for name in names if name in self._figure.pins])
            for name in names:
                if name in self._cast.marks:
                    yield from self._cast.marks[name].at([places[name]])
            if part:
                yield from part.placed(places)

    def _ghost(self, pose: Pose) -> Iterator[Layer]:
        """Yield the other closure's bodies and pins, mostly background."""
        for layer in self._pinned(self._places(pose)):
            yield Layer(mixed(layer.colour, self._theme.background, _GHOST), layer.loops, layer.alpha)

    def _places(self, pose: Pose) -> Places:
        """Return where all joints lie in pixels; one that is nowhere (NaN) lies far outside."""
        return {name: _somewhere(self.view.place(point)) for name, point in pose.position.items()}


def _somewhere(place: complex) -> complex:
    return place if np.isfinite(place.real) and np.isfinite(place.imag) else complex(-1e6, -1e6)
