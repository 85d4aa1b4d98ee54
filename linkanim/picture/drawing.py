"""What a scene looks like in one view: all that is drawn of a pose, in groups by name, back to front."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import zip_longest
from math import isfinite
from typing import TYPE_CHECKING

from linkanim.mechanics.motion.motion import Pose
from linkanim.picture.diagrams.chart import pen_for
from linkanim.picture.figure import Figure
from linkanim.picture.items import Group
from linkanim.picture.labels.dimensions import Symbols, leg_part, pivots, symbols
from linkanim.picture.layout import Gauge, Layout
from linkanim.picture.look import ACCELERATION, VELOCITY, Look
from linkanim.picture.parts.bodies import body_parts, mark_stamp, mass_stamp, pin_stamp
from linkanim.picture.parts.gears import turning_apart, wheel_layers, wheel_parts
from linkanim.picture.parts.ground import ground_layers, ground_line
from linkanim.picture.parts.struts import Coil, Cushion, coils, cushions
from linkanim.picture.parts.trace import Trace, traces
from linkanim.picture.parts.turning import Sliding, Turning, motion_of, turning_of
from linkanim.picture.parts.vectors import Arrows, arrow_layers, arrows_of
from linkanim.picture.raster.parts import Part, Places, Stamp, by_depth, placed
from linkanim.picture.raster.raster import Layer
from linkanim.picture.text.text import Type
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import View

if TYPE_CHECKING:
    from linkanim.picture.diagrams.centres import Centres
    from linkanim.picture.diagrams.polygons import Polygon
    from linkanim.picture.labels.dead_centres import DeadCentres
    from linkanim.picture.labels.names import Names

# What only some looks ask for is imported where they do: the first frame does not wait for it.

_FAINT = 0.78
"""How much of the background is in the colours of what is drawn faintly."""


@dataclass(frozen=True)
class Scenery:
    """What is drawn, where and how thick, in which colours; `size` is the whole picture's, in pixels."""

    figure: Figure
    view: View
    gauge: Gauge
    theme: Theme
    layout: Layout
    look: Look
    fitted: View
    """The view before it was zoomed and panned."""

    @property
    def known(self) -> tuple[Figure, View, Gauge, Theme]:
        """What the parts take their measures from."""
        return self.figure, self.view, self.gauge, self.theme


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
    turning: Turning | Sliding | None
    legs: tuple[Part, ...]
    centres: Centres | None


class Drawing:
    """A scene's drawing at one view and look, of any pose.

    With `apart` each joint has a group of its own; else pins of one depth share one, which paints faster.
    """

    def __init__(self, scenery: Scenery, *, apart: bool = False) -> None:
        self.scenery, self._apart = scenery, apart
        self.cast = _cast(scenery, self.symbols)
        self._placed: tuple[Pose, Places] | None = None

    @cached_property
    def symbols(self) -> Symbols | None:
        """The dimensions' symbols, where the look asks for them."""
        return symbols(self.scenery.figure) if self.scenery.look.names > 1 else None

    @cached_property
    def dead_centres(self) -> DeadCentres | None:
        """The ticks on a slider's guide, where the look names things."""
        look = self.scenery.look
        if not look.names:
            return None
        from linkanim.picture.labels.dead_centres import DeadCentres

        return DeadCentres(*self.scenery.known, self.scenery.layout, sized=look.names > 1)

    def names(self, type_: Type, before: Drawing | None = None, kept: Names | None = None) -> Names | None:
        """Return the names of joints and links, and their dimensions, where the look asks for them.

        They are placed for the whole scene as it fits the window. Those that were `kept` of a drawing
        `before` stay, where it differs by its zoom and pan alone, or the scene is on its way to another.
        """
        set_ = self.scenery
        if not set_.look.names:
            return None
        if kept and before and self._names_as(before.scenery):
            return kept
        from linkanim.picture.labels.names import Hand, names_of

        words = (*set_.layout.words, *(self.dead_centres.rects(type_) if self.dead_centres else ()))
        hand = Hand(type_, replace(set_.layout, words=words), set_.theme, set_.gauge)
        turning = turning_of(set_.figure, set_.fitted, set_.gauge, set_.theme)
        return names_of(set_.figure, set_.fitted, hand, turning, self.symbols)

    def _names_as(self, other: Scenery) -> bool:
        """Return whether the names on another scenery are this one's."""
        mine, theirs = (
            (set_.layout, set_.theme, set_.look.names, set_.gauge) for set_ in (self.scenery, other)
        )
        scene = self.scenery.figure.scene
        same = scene is other.figure.scene and self.scenery.fitted == other.fitted
        glides = scene.towards is not None and self.scenery.figure.shown == other.figure.shown
        return (mine == theirs and same) or (glides and mine[:3] == theirs[:3])

    def places(self, pose: Pose) -> Places:
        """Return where all joints lie in pixels; one that is nowhere (NaN) lies far outside.

        Those of the last pose are kept: all that is drawn of a frame asks for them.
        """
        if self._placed is None or self._placed[0] is not pose:
            view = self.scenery.view
            places = {name: _somewhere(view.place(point)) for name, point in pose.position.items()}
            self._placed = pose, places
        return self._placed[1]

    def discs(self) -> Group:
        """Return what stands still behind everything: the wheels without their teeth, and belts."""
        return Group("wheels", wheel_layers(*self.scenery.known))

    def wheels(self, places: Places) -> Iterator[Group]:
        """Yield what turns on them."""
        for part in self.cast.wheels:
            yield Group(f"wheel-{part.head}", part.placed(places))

    @cached_property
    def turning_apart(self) -> tuple[tuple[Part, ...], ...]:
        """The wheels in sets each of which may be painted without the others; none where that is not so."""
        return turning_apart(self.scenery.figure, self.cast.wheels)

    @property
    def moves_behind(self) -> bool:
        """Whether something moves behind what else stands still."""
        return bool(self.cast.wheels) or self.scenery.look.ghost

    def faint(self, pose: Pose) -> list[Layer]:
        """Return a pose's bodies and pins, mostly background."""
        back = self.scenery.theme.background
        layers = (layer for group in self._pinned(self.places(pose)) for layer in group.layers)
        return [Layer(mixed(layer.colour, back, _FAINT), layer.loops, layer.alpha) for layer in layers]

    @cached_property
    def standing(self) -> tuple[Group, ...]:
        """What else stands still: the ground, its line and the whole curves."""
        return tuple(self._ground())

    def _ground(self) -> Iterator[Group]:
        figure, look = self.scenery.figure, self.scenery.look
        yield Group("ground", ground_layers(*self.scenery.known))
        if look.names:
            yield Group("ground-line", ground_line(pivots(figure), *self.scenery.known))
        for trace in self.cast.traces:
            yield Group(f"curve-{trace.joint}", [trace.whole()])
        if self._rolling:
            yield Group("fixed-centrode", [self._rolling.fixed()])

    @property
    def _rolling(self) -> Centres | None:
        """The centres, where their curves are wanted."""
        return self.cast.centres if self.scenery.look.centres > 1 else None

    def moving(self, pose: Pose) -> Iterator[Group]:
        """Yield all that moves before it, back to front."""
        places, cast = self.places(pose), self.cast
        if self._rolling:
            yield Group("moving-centrode", [self._rolling.moving(places)])
        for trace in cast.traces:
            recent = trace.recent(pose.phase, places[trace.joint], forward=pose.input_speed >= 0)
            yield Group(f"recent-{trace.joint}", recent)
        if self.dead_centres:
            yield self.dead_centres.group
        for item, strut in zip(self.scenery.figure.struts, cast.struts, strict=True):
            yield Group(f"strut-{item.name}", strut.layers(places))
        yield from self._pinned(places)
        yield Group("dimensions", placed(cast.legs, places))
        yield Group("input", list(self._turning(pose, places)))
        masses = [self.scenery.view.place(at) for at in pose.com_position.values()]
        yield Group("centres-of-mass", cast.mass.at(masses))
        arrows = arrow_layers(cast.arrows, pose, self.scenery.view, self.scenery.figure.scene.trace)
        yield from (Group(kind.words, layers) for kind, layers in zip(cast.arrows, arrows, strict=True))
        if cast.centres:
            yield cast.centres.marks(pose, places)

    def polygons(self, type_: Type) -> tuple[Polygon, ...]:
        """Return the polygons beside the linkage, where the look asks for them."""
        set_, place = self.scenery, self.scenery.layout.polygons
        if not place:
            return ()
        from linkanim.picture.diagrams.polygons import polygons_of

        return polygons_of(set_.figure, place, pen_for(set_.layout, type_, set_.theme))

    def _turning(self, pose: Pose, places: Places) -> Iterator[Layer]:
        """Yield the way the input turns, and its angle."""
        turning, drive = self.cast.turning, self.scenery.figure.linkage.drive
        if turning and self.scenery.look.names > 1:
            yield from turning.angle(places)
        if turning and pose.input_speed:
            yield from turning.direction(pose, places, abs(drive.speed / pose.input_speed))

    def _pinned(self, places: Places) -> Iterator[Group]:
        """Yield the bodies with their pins, each pin at the depth of its own links."""
        for names, part in zip_longest(self.cast.pinned, self.cast.bodies):
            for together in [(name,) for name in names] if self._apart else [names]:
                yield Group("-".join(("joint", *together)), self._stamped(together, places))
            if part:
                yield Group(part.title, part.placed(places))

    def _stamped(self, names: tuple[str, ...], places: Places) -> list[Layer]:
        pins = [places[name] for name in names if name in self.scenery.figure.pins]
        layers = self.cast.pin.at(pins) if pins else []
        for name in names:
            if name in self.cast.marks:
                layers += self.cast.marks[name].at([places[name]])
        return layers


def _cast(scenery: Scenery, known: Symbols | None) -> Cast:
    figure, view, gauge, theme = scenery.known
    look = scenery.look
    curves = traces(*scenery.known) if look.trace else ()
    bodies = body_parts(*scenery.known)
    marked = [trace.joint for trace in curves if trace.joint not in figure.pins]
    height = scenery.layout.size[1]
    kinds = [kind for kind in (VELOCITY, ACCELERATION) if kind in look.vectors]
    return Cast(
        wheels=wheel_parts(*scenery.known),
        struts=(*coils(*scenery.known), *cushions(*scenery.known)),
        bodies=bodies,
        pinned=by_depth(bodies, (*figure.pins, *marked)),
        pin=pin_stamp(gauge, theme),
        mass=mass_stamp(gauge, theme),
        traces=curves,
        marks={trace.joint: mark_stamp(trace.colour, gauge, theme) for trace in reversed(curves)},
        arrows=tuple(arrows_of(figure, kind, height, gauge, theme) for kind in kinds),
        turning=motion_of(*scenery.known) if look.names else None,
        legs=tuple(leg_part(legs, view, gauge, theme.dim) for legs in known.legs) if known else (),
        centres=_centres(scenery) if look.centres else None,
    )


def _centres(scenery: Scenery) -> Centres:
    from linkanim.picture.diagrams.centres import Centres

    return Centres(*scenery.known, scenery.layout, rolling=scenery.look.centres > 1)


def _somewhere(place: complex) -> complex:
    return place if isfinite(place.real) and isfinite(place.imag) else complex(-1e6, -1e6)
