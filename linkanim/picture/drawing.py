"""A linkage drawn in one view: all that is drawn of a pose, in groups by name, back to front."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cached_property
from itertools import groupby, zip_longest
from math import isfinite
from typing import TYPE_CHECKING

from linkanim.mechanics.motion import Pose
from linkanim.picture.bodies import body_parts, mark_stamp, mass_stamp, pin_stamp
from linkanim.picture.dimensions import Symbols, leg_part, pivots, symbols
from linkanim.picture.figure import DrawSetting
from linkanim.picture.fittings import Coil, Damping, coils, dampings, ground_layers, ground_line
from linkanim.picture.gears import still_parts, wheel_layers, wheel_parts
from linkanim.picture.items import Group
from linkanim.picture.motion_marks import (
    Arrows,
    Sliding,
    Trace,
    Turning,
    arrow_layers,
    arrows_for,
    motion_of,
    traces,
)
from linkanim.picture.raster import Layer
from linkanim.picture.shapes import Part, Places, Stamp, by_depth, placed
from linkanim.picture.theme import mixed
from linkanim.picture.view import Rect

if TYPE_CHECKING:
    from linkanim.picture.bodies import CausalChain
    from linkanim.picture.centres import Centres
    from linkanim.picture.dead_centres import DeadCentres
    from linkanim.picture.ink import Ink
    from linkanim.picture.names import Names

# What only some looks need is imported where it is used: the first frame does not wait for it.

_FAINT = 0.78
"""The share of the background in the colours of what is drawn faintly."""


class Drawing:
    """A scene's linkage at one view and look, at any pose.

    With `apart` each joint has a group of its own; else pins of one depth share a group, which prints faster.
    Arrows have the scale of the cycle, or that of a still's one `moment`.
    """

    def __init__(self, setting: DrawSetting, *, apart: bool = False, moment: float | None = None) -> None:
        self.setting, self._apart, self._moment = setting, apart, moment
        self._placed: tuple[Pose, Places] | None = None

    @cached_property
    def turning_wheels(self) -> tuple[Part, ...]:
        """What turns of gears and belts."""
        return wheel_parts(self.setting)

    @cached_property
    def struts(self) -> tuple[Coil | Damping, ...]:
        """The springs, dampers and cylinders."""
        return (*coils(self.setting), *dampings(self.setting))

    @cached_property
    def bodies(self) -> tuple[Part, ...]:
        """The bars and plates, back to front."""
        bodies = body_parts(self.setting)
        return tuple(self.chain.coloured(bodies, self.setting.figure)) if self.chain else bodies

    @cached_property
    def pinned(self) -> tuple[tuple[str, ...], ...]:
        """The pins and marks that lie below the first of the bodies, and on each."""
        pins = self.setting.figure.pins
        marked = [trace.joint for trace in self._curves if trace.joint not in pins]
        return by_depth(self.bodies, (*pins, *marked))

    @cached_property
    def pins(self) -> Mapping[str, Stamp]:
        """How each pin is drawn."""
        figure, _, gauge, theme = self.setting.known
        return self.chain.pins(gauge) if self.chain else dict.fromkeys(figure.pins, pin_stamp(gauge, theme))

    @cached_property
    def mass(self) -> Stamp:
        """How a centre of mass is drawn."""
        return mass_stamp(self.setting.gauge, self.setting.theme)

    @cached_property
    def _curves(self) -> tuple[Trace, ...]:
        """The curves of traced points, in ink or not."""
        return traces(self.setting) if self.setting.look.trace or self.setting.look.ink else ()

    @property
    def traces(self) -> tuple[Trace, ...]:
        """The curves that are drawn as lines."""
        return () if self.setting.look.ink else self._curves

    @cached_property
    def marks(self) -> Mapping[str, Stamp]:
        """How the point of each curve is drawn."""
        gauge, theme = self.setting.gauge, self.setting.theme
        return {curve.joint: mark_stamp(curve.colour, gauge, theme) for curve in reversed(self._curves)}

    @cached_property
    def inks(self) -> tuple[Ink, ...]:
        """The curves in ink."""
        if not self.setting.look.ink:
            return ()
        from linkanim.picture.ink import inks

        return inks(self.setting)

    @cached_property
    def arrows(self) -> tuple[Arrows, ...]:
        """The velocity and acceleration arrows, and forces."""
        figure, _, gauge, theme = self.setting.known
        return arrows_for(figure, self.setting.look, self.setting.layout, gauge, theme, self._moment)

    @cached_property
    def turning(self) -> Turning | Sliding | None:
        """The mark of the input's motion."""
        return motion_of(self.setting) if self.setting.look.names else None

    @cached_property
    def legs(self) -> tuple[Part, ...]:
        """The dashed legs to points that are stated along a body."""
        _, view, gauge, theme = self.setting.known
        points = self.symbols.points if self.symbols else ()
        return tuple(leg_part(point, view, gauge, theme.dim) for point in points)

    @cached_property
    def centres(self) -> Centres | None:
        """The instant centres, where they are shown."""
        if not self.setting.look.centres:
            return None
        from linkanim.picture.centres import Centres

        return Centres(self.setting)

    @cached_property
    def chain(self) -> CausalChain | None:
        """The colours of the steps in which joints are solved, where they are shown."""
        if not self.setting.look.chain:
            return None
        from linkanim.mechanics.analysis import solving_steps
        from linkanim.picture.bodies import CausalChain

        return CausalChain(solving_steps(self.setting.figure.linkage), self.setting.theme)

    @cached_property
    def symbols(self) -> Symbols | None:
        """The dimensions' symbols, where the look asks for them."""
        return symbols(self.setting.figure) if self.setting.look.names > 1 else None

    @cached_property
    def dead_centres(self) -> DeadCentres | None:
        """The ticks on a slider's guide, where the look names things; None where there are none."""
        if not (self.setting.look.names and self.setting.look.dead_centres):
            return None
        from linkanim.picture.dead_centres import dead_centres_of

        return dead_centres_of(self.setting)

    def places(self, pose: Pose) -> Places:
        """Return where all joints lie in pixels; a joint without a place (NaN) lies far outside.

        The places of the last pose are cached: everything drawn in a frame asks for them.
        """
        if self._placed is None or self._placed[0] is not pose:
            view = self.setting.view
            places = {name: _somewhere(view.pixel(point)) for name, point in pose.position.items()}
            self._placed = pose, places
        return self._placed[1]

    def discs(self) -> Group:
        """Return what stands still behind everything: the wheels without their teeth, and belts."""
        return Group("wheels", wheel_layers(self.setting), still=True, made_of=still_parts(self.setting))

    def wheels(self, places: Places) -> Iterator[Group]:
        """Yield the turning parts of wheels; a wheel that stays in place looks the same after every tooth."""
        for n, part in enumerate(self.turning_wheels):
            key = (n, part.turn(places)) if part.fold > 1 else None
            yield Group(f"wheel-{part.head}", part.placed(places), key=key, made_of=part)

    def faint(self, pose: Pose, without: Collection[str] = ()) -> list[Layer]:
        """Return a pose's bodies and pins in faint colours, `without` the pins of some joints."""
        return [layer for group in self.faint_groups(pose, without) for layer in group.layers]

    def faint_groups(self, pose: Pose, without: Collection[str] = ()) -> Iterator[Group]:
        """Yield each of a pose's bodies and pins in faint colours, `without` the pins of some joints."""
        back, left_out = self.setting.theme.background, {f"joint-{name}" for name in without}
        for group in self._pinned(self.places(pose)):
            if group.name not in left_out:
                pale = (
                    Layer(mixed(layer.colour, back, _FAINT), layer.loops, layer.alpha)
                    for layer in group.layers
                )
                yield Group(group.name, [*pale])

    def standing(self) -> Iterator[Group]:
        """Yield what else stands still: the ground, its line, the whole curves and dead centres."""
        figure, look = self.setting.figure, self.setting.look
        yield Group("ground", ground_layers(self.setting), still=True)
        if look.names:
            yield Group("ground-line", ground_line(pivots(figure), self.setting), still=True)
        for ink in self.inks:
            yield Group(f"ink-{ink.joint}", ink.layers, still=True, made_of=ink)
        for trace in self.traces:
            yield Group(f"curve-{trace.joint}", [trace.whole()], still=True, made_of=trace)
        if self._rolling:
            yield Group("fixed-centrode", [self._rolling.fixed()], still=True)
        if self.dead_centres:
            yield Group("dead-centres", self.dead_centres.layers, still=True)

    @property
    def _rolling(self) -> Centres | None:
        """The instant centres, where their centrodes are shown."""
        return self.centres if self.setting.look.centres > 1 else None

    def moving(self, pose: Pose, names: Names, taken: Iterable[Rect] = ()) -> Iterator[Group]:
        """Yield all that moves, back to front; names of arrows and far centres keep off what is `taken`."""
        places = self.places(pose)
        if self._rolling:
            yield Group("moving-centrode", [self._rolling.moving(places)])
        for trace in self.traces:
            recent = trace.recent(pose.phase, places[trace.joint], forward=pose.input_speed >= 0)
            yield Group(f"recent-{trace.joint}", recent, made_of=trace)
        for item, strut in zip(self.setting.figure.struts, self.struts, strict=True):
            yield Group(f"strut-{item.name}", strut.layers(places), made_of=strut)
        yield from self._pinned(places)
        yield Group("dimensions", placed(self.legs, places), made_of=self.legs)
        yield Group("input", list(self._turning(pose, places)), made_of=self.turning)
        masses = [self.setting.view.pixel(at) for at in pose.com_position.values()]
        yield Group("centres-of-mass", self.mass.at(masses), made_of=self.mass)
        arrows, busy = (
            arrow_layers(self.arrows, pose, self.setting.view, self.setting.figure.moving),
            [*taken],
        )
        named = names.arrow_names(self.arrows, pose, busy, self.setting) if self.arrows else ()
        for kind, layers, symbols_ in zip(self.arrows, arrows, named, strict=True):
            yield Group(kind.words, layers, symbols_, made_of=kind)
            busy += [line.around(self.setting.type) for line in symbols_]
        if centres := self.centres:
            words = names.centre_names(centres, pose, busy)
            yield Group("instant-centres", [*centres.layers(pose)], words, made_of=centres)

    def swinging(self, places: Places) -> Iterator[Group]:
        """Yield the linkage between two closures, its joints at `places`: bodies there have another shape."""
        for item, strut in zip(self.setting.figure.struts, self.struts, strict=True):
            yield Group(f"strut-{item.name}", strut.layers(places))
        yield from self._pinned(places, body_parts(self.setting, places))

    def heads(self, pose: Pose) -> list[complex]:
        """Return where the heads of velocity and acceleration arrows lie in a pose."""
        known = pose, self.setting.view, self.setting.figure.moving
        return [one.foot + one.reach for kind in self.arrows for one in kind.seen(*known)]

    def _turning(self, pose: Pose, places: Places) -> Iterator[Layer]:
        """Yield the arrow of the input's motion, and its angle."""
        turning, drive = self.turning, self.setting.figure.linkage.drive
        if isinstance(turning, Turning) and self.setting.look.names > 1:
            yield from turning.angle(places)
        if turning and pose.input_speed:
            yield from turning.direction(pose, places, abs(drive.speed / pose.input_speed))

    def _pinned(self, places: Places, bodies: tuple[Part, ...] | None = None) -> Iterator[Group]:
        """Yield the bodies with their pins, each pin at the depth of its own links."""
        for names, part in zip_longest(self.pinned, bodies or self.bodies):
            for together in [(name,) for name in names] if self._apart else [names]:
                shapes = self._stamped(together, places)
                yield Group("-".join(("joint", *together)), shapes, made_of=self._pin(together))
            if part:
                yield Group(part.title, part.placed(places), made_of=part)

    def _pin(self, names: tuple[str, ...]) -> Part | None:
        """Return the part that draws a single joint; None for joints that share a group."""
        if not self._apart:
            return None
        (name,) = names
        return Part(name, name, name, tuple(self._stamped(names, {name: 0j})))

    def _stamped(self, names: tuple[str, ...], places: Places) -> list[Layer]:
        pins = [name for name in names if name in self.setting.figure.pins]
        layers = []
        for stamp, alike in groupby(pins, self.pins.__getitem__):
            layers += stamp.at([places[name] for name in alike])
        for name in names:
            if name in self.marks:
                layers += self.marks[name].at([places[name]])
        return layers


def _somewhere(place: complex) -> complex:
    return place if isfinite(place.real) and isfinite(place.imag) else complex(-1e6, -1e6)
