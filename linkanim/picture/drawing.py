"""A linkage drawn in one view: all that is drawn of a pose, in groups by name, back to front."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cached_property
from itertools import groupby, zip_longest
from math import isfinite
from typing import TYPE_CHECKING

from linkanim.frozen import frozen
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


@frozen
class Parts:
    """All that moves, ready to be placed."""

    wheels: tuple[Part, ...]
    struts: tuple[Coil | Damping, ...]
    bodies: tuple[Part, ...]
    pinned: tuple[tuple[str, ...], ...]
    """The pins and marks that lie below the first of the bodies, and on each."""
    pins: Mapping[str, Stamp]
    mass: Stamp
    traces: tuple[Trace, ...]
    marks: Mapping[str, Stamp]
    inks: tuple[Ink, ...]
    arrows: tuple[Arrows, ...]
    turning: Turning | Sliding | None
    legs: tuple[Part, ...]
    centres: Centres | None
    chain: CausalChain | None


class Drawing:
    """A scene's linkage at one view and look, at any pose.

    With `apart` each joint has a group of its own; else pins of one depth share a group, which prints faster.
    Arrows have the scale of the cycle, or that of a still's one `moment`.
    """

    def __init__(self, setting: DrawSetting, *, apart: bool = False, moment: float | None = None) -> None:
        self.setting, self._apart, self._moment = setting, apart, moment
        self._placed: tuple[Pose, Places] | None = None

    @cached_property
    def parts(self) -> Parts:
        """All that moves."""
        return _parts(self.setting, self.symbols, self._moment)

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
        for n, part in enumerate(self.parts.wheels):
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
        for ink in self.parts.inks:
            yield Group(f"ink-{ink.joint}", ink.layers, still=True, made_of=ink)
        for trace in self.parts.traces:
            yield Group(f"curve-{trace.joint}", [trace.whole()], still=True, made_of=trace)
        if self._rolling:
            yield Group("fixed-centrode", [self._rolling.fixed()], still=True)
        if self.dead_centres:
            yield Group("dead-centres", self.dead_centres.layers, still=True)

    @property
    def _rolling(self) -> Centres | None:
        """The instant centres, where their centrodes are shown."""
        return self.parts.centres if self.setting.look.centres > 1 else None

    def moving(self, pose: Pose, names: Names, taken: Iterable[Rect] = ()) -> Iterator[Group]:
        """Yield all that moves, back to front; names of arrows and far centres keep off what is `taken`."""
        places, parts = self.places(pose), self.parts
        if self._rolling:
            yield Group("moving-centrode", [self._rolling.moving(places)])
        for trace in parts.traces:
            recent = trace.recent(pose.phase, places[trace.joint], forward=pose.input_speed >= 0)
            yield Group(f"recent-{trace.joint}", recent, made_of=trace)
        for item, strut in zip(self.setting.figure.struts, parts.struts, strict=True):
            yield Group(f"strut-{item.name}", strut.layers(places), made_of=strut)
        yield from self._pinned(places)
        yield Group("dimensions", placed(parts.legs, places), made_of=parts.legs)
        yield Group("input", list(self._turning(pose, places)), made_of=parts.turning)
        masses = [self.setting.view.pixel(at) for at in pose.com_position.values()]
        yield Group("centres-of-mass", parts.mass.at(masses), made_of=parts.mass)
        arrows, busy = (
            arrow_layers(parts.arrows, pose, self.setting.view, self.setting.figure.moving),
            [*taken],
        )
        named = names.arrow_names(parts.arrows, pose, busy, self.setting) if parts.arrows else ()
        for kind, layers, symbols_ in zip(parts.arrows, arrows, named, strict=True):
            yield Group(kind.words, layers, symbols_, made_of=kind)
            busy += [line.around(self.setting.type) for line in symbols_]
        if centres := parts.centres:
            words = names.centre_names(centres, pose, busy)
            yield Group("instant-centres", [*centres.layers(pose)], words, made_of=centres)

    def swinging(self, places: Places) -> Iterator[Group]:
        """Yield the linkage between two closures, its joints at `places`: bodies there have another shape."""
        for item, strut in zip(self.setting.figure.struts, self.parts.struts, strict=True):
            yield Group(f"strut-{item.name}", strut.layers(places))
        yield from self._pinned(places, body_parts(self.setting, places))

    def heads(self, pose: Pose) -> list[complex]:
        """Return where the heads of velocity and acceleration arrows lie in a pose."""
        known = pose, self.setting.view, self.setting.figure.moving
        return [one.foot + one.reach for kind in self.parts.arrows for one in kind.seen(*known)]

    def _turning(self, pose: Pose, places: Places) -> Iterator[Layer]:
        """Yield the arrow of the input's motion, and its angle."""
        turning, drive = self.parts.turning, self.setting.figure.linkage.drive
        if isinstance(turning, Turning) and self.setting.look.names > 1:
            yield from turning.angle(places)
        if turning and pose.input_speed:
            yield from turning.direction(pose, places, abs(drive.speed / pose.input_speed))

    def _pinned(self, places: Places, bodies: tuple[Part, ...] | None = None) -> Iterator[Group]:
        """Yield the bodies with their pins, each pin at the depth of its own links."""
        for names, part in zip_longest(self.parts.pinned, bodies or self.parts.bodies):
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
        for stamp, alike in groupby(pins, self.parts.pins.__getitem__):
            layers += stamp.at([places[name] for name in alike])
        for name in names:
            if name in self.parts.marks:
                layers += self.parts.marks[name].at([places[name]])
        return layers


def _parts(setting: DrawSetting, known: Symbols | None, moment: float | None) -> Parts:
    figure, view, gauge, theme = setting.known
    look = setting.look
    curves = traces(setting) if look.trace or look.ink else ()
    bodies = body_parts(setting)
    chain = _chain(setting) if look.chain else None
    marked = [trace.joint for trace in curves if trace.joint not in figure.pins]
    return Parts(
        wheels=wheel_parts(setting),
        struts=(*coils(setting), *dampings(setting)),
        bodies=tuple(chain.coloured(bodies, figure)) if chain else bodies,
        pinned=by_depth(bodies, (*figure.pins, *marked)),
        pins=chain.pins(gauge) if chain else dict.fromkeys(figure.pins, pin_stamp(gauge, theme)),
        mass=mass_stamp(gauge, theme),
        traces=() if look.ink else curves,
        marks={trace.joint: mark_stamp(trace.colour, gauge, theme) for trace in reversed(curves)},
        inks=_inks(setting) if look.ink else (),
        arrows=arrows_for(figure, look, setting.layout, gauge, theme, moment),
        turning=motion_of(setting) if look.names else None,
        legs=tuple(leg_part(point, view, gauge, theme.dim) for point in known.points) if known else (),
        centres=_centres(setting) if look.centres else None,
        chain=chain,
    )


def _inks(setting: DrawSetting) -> tuple[Ink, ...]:
    from linkanim.picture.ink import inks

    return inks(setting)


def _centres(setting: DrawSetting) -> Centres:
    from linkanim.picture.centres import Centres

    return Centres(setting)


def _chain(setting: DrawSetting) -> CausalChain:
    from linkanim.mechanics.analysis import solving_steps
    from linkanim.picture.bodies import CausalChain

    return CausalChain(solving_steps(setting.figure.linkage), setting.theme)


def _somewhere(place: complex) -> complex:
    return place if isfinite(place.real) and isfinite(place.imag) else complex(-1e6, -1e6)
