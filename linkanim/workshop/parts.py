"""A linkage as flat parts: plates with holes and slots, the pins through them, plates that share a layer.

Every rigid body becomes a plate: with two joints a bar with round ends, with more the hull around them. A
slider becomes a tongue in a slot; a pin runs in the slot of a bar that turns. A gear pair becomes two wheels.
The ground is a plate, too, with the fixed pins in it. Lengths are in mm.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations, pairwise
from typing import Literal, NamedTuple

import numpy as np

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Body, Damper, Line, Slide, Spring
from linkanim.picture.layered import Frame
from linkanim.workshop.gears import GearWheel, NotFlat, meshes
from linkanim.workshop.shapes import Outline, hull, moved, rounded
from linkanim.workshop.sweep import GROUND, Cycle, MovingPiece, Nearness, Real, hulls_apart

Role = Literal["ground", "link", "slider", "wheel", "ring", "bridge"]

_STILL = 1e-7
"""A share of the longest link: a point that moves less keeps its place, apart from rounding."""
_MOST_PLATES = 150
_POSTS = 4
_RING_CELLS = 48
_LEAST_BETWEEN = 1.0
"""The most that has to be left between two cuts, in mm: enough where bars are wide."""


@frozen
class Sizes:
    """Widths and distances of all parts, in mm; `scale` is mm for one unit of length of the scene.

    A pin is thinner by `clearance` than the holes that turn on it. Parts of one layer pass at a distance of
    at least `gap`.
    """

    scale: float
    bar: float = 0.0
    hole: float = 0.0
    gap: float = 0.0
    clearance: float = 0.0
    thickness: float = 0.0

    @property
    def wall(self) -> float:
        """The width that is left of a bar on either side of a hole."""
        return (self.bar - self.hole) / 2

    @property
    def tongue(self) -> float:
        """The width of a tongue: wide enough for its pin, and less than that of the bars beside its slot."""
        return (self.bar + self.hole) / 2

    @property
    def between(self) -> float:
        """The least that two cuts leave between them."""
        return min(self.wall / 2, _LEAST_BETWEEN)

    @property
    def pin(self) -> float:
        """A pin's diameter."""
        return self.hole - self.clearance

    @property
    def snug(self) -> float:
        """The diameter of a hole in which a pin is stuck."""
        return self.hole - 0.75 * self.clearance


class Cut(NamedTuple):
    """A slot with round ends, or a round hole: the middles of its ends, half its width, its joint.

    It is the joint that it is for, or that runs in it; "" for a dowel's hole.
    """

    begin: complex
    end: complex
    radius: float
    joint: str

    @classmethod
    def hole(cls, at: complex, diameter: float, joint: str = "") -> Cut:
        """Return a round hole."""
        return cls(at, at, diameter / 2, joint)

    def outline(self, grown: float) -> Outline:
        """Return its edge, moved inwards by `grown` mm."""
        return rounded([self.begin, self.end], self.radius - grown)

    def apart(self, other: Cut) -> float:
        """Return the distance of two cuts, from edge to edge; below 0 where they overlap."""
        ends = (np.array([cut[:2]]) for cut in (self, other))
        return float(hulls_apart(*ends)[0]) - self.radius - other.radius

    @property
    def words(self) -> str:
        """What it is called: the hole A, the slot for B."""
        return f"the {'hole' if self.begin == self.end else 'slot for'} {self.joint}".strip()


class Toothing(NamedTuple):
    """The teeth of a plate: the wheel, its middle and direction in the plate's frame, and its play in mm."""

    wheel: GearWheel
    middle: complex
    direction: complex
    play: float

    def outline(self, grown: float) -> Outline:
        """Return the teeth's edge."""
        return moved(self.wheel.outline(self.play, grown), self.middle, self.direction)


@frozen
class Plate:
    """A flat part in its own frame; `bodies` are those of the scene that it is made of.

    Its outline is the hull of `corners` with a rim of `radius`, or its teeth; a ring's teeth are inside.
    """

    name: str
    role: Role
    frame: Frame
    corners: tuple[complex, ...]
    radius: float
    bodies: tuple[str, ...] = ()
    holes: tuple[Cut, ...] = ()
    slots: tuple[Cut, ...] = ()
    teeth: Toothing | None = None

    def outline(self, grown: float = 0.0) -> Outline:
        """Return its outer edge, moved outwards by `grown` mm."""
        if self.teeth is None or self.teeth.wheel.ring:
            return rounded(self.corners, self.radius + grown)
        return self.teeth.outline(grown)

    def cuts(self, grown: float = 0.0) -> Iterator[Outline]:
        """Yield the edges of its holes, its slots and a ring's teeth, moved inwards by `grown` mm."""
        for one in self.holes + self.slots:
            yield one.outline(grown)
        if self.teeth is not None and self.teeth.wheel.ring:
            yield self.teeth.outline(grown)

    @property
    def piece(self) -> MovingPiece:
        """Its shape that may touch other parts; for a wheel the disc that its teeth reach."""
        if self.teeth is None:
            return MovingPiece(self.frame, (self.corners,), self.radius)
        wheel = self.teeth.wheel
        if not wheel.ring:
            return MovingPiece(self.frame, ((self.teeth.middle,),), wheel.tip)
        # A ring is a polygon of bars, wide enough to cover the arcs.
        half = math.pi / _RING_CELLS
        middle, thick = (wheel.tip + self.radius) / 2, (self.radius - wheel.tip) / 2
        ring = [self.teeth.middle + cmath.rect(middle, 2 * half * n) for n in range(_RING_CELLS + 1)]
        cells = tuple(pairwise(ring))
        return MovingPiece(self.frame, cells, thick + middle * (1 - math.cos(half)))

    @property
    def clearest(self) -> complex:
        """The place on it, between holes or at corners, with most room from its edge and its cuts."""
        cuts = [(one.begin, one.end) for one in self.holes + self.slots]
        ends = dict.fromkeys(end for pair in cuts for end in pair)
        places = [(a + b) / 2 for a, b in combinations(ends, 2)]
        places += [sum(self.corners) / len(self.corners), *self.corners]
        if self.teeth is not None:
            wheel = self.teeth.wheel
            far = (wheel.root + self.radius) / 2 if wheel.ring else 0.55 * wheel.root
            around = [self.teeth.middle + far * 1j**n for n in range(4)]
            places = around if wheel.ring else [*places, *around]
        edge = hull(self.corners)
        sides = [pair for pair in zip(edge, edge[1:] + edge[:1], strict=True) if len(edge) > 2]
        at = np.array(places)
        within = [((at - a) * (b - a).conjugate()).imag / abs(b - a) for a, b in sides]
        room = self.radius + np.min(within, axis=0) if within else np.full(len(at), self.radius)
        for begin, end in cuts:
            cut = np.broadcast_to(np.array([begin, end]), (len(at), 2))
            room = np.minimum(room, hulls_apart(at[:, None], cut))
        return places[int(room.argmax())]


class MadePin(NamedTuple):
    """A pin through `plates` (numbers) that moves with the point `at` of a frame.

    It runs in a slot of the plates that are `sliding`. A dowel, which keeps plates from turning on each
    other, or a post is `stuck` in all of its plates, and has the name of no joint. In layers it reaches from
    the one that is `low` to the one that is `high`; 0 is the ground. A fixed pin is carried from its `side`,
    from the ground below or from a bridge above: it is stuck in that and turns in its other plates.
    `spacers` are the rings that fill layers between its plates: the layer, and the outer diameter.
    """

    name: str
    frame: Frame
    at: complex
    plates: tuple[int, ...]
    sliding: tuple[int, ...] = ()
    stuck: bool = False
    low: int = 0
    high: int = 0
    side: Literal["below", "above"] | None = None
    spacers: tuple[tuple[int, float], ...] = ()

    @property
    def fixed(self) -> bool:
        """Whether it stands in the ground, which is plate 0."""
        return 0 in self.plates and 0 not in self.sliding


Band = tuple[str, tuple[str, str]]
"""A rubber band for a spring or damper: the name of that, and the two joints that it is hung on."""


class Kit(NamedTuple):
    """All parts of a linkage; plate 0 is the ground. Pins are numbered after all plates.

    Plates of one group lie in one layer; two plates in `paired` are meant to touch, or lie in each other.
    """

    plates: tuple[Plate, ...]
    pins: tuple[MadePin, ...]
    bands: tuple[Band, ...]
    groups: tuple[tuple[int, ...], ...]
    paired: frozenset[tuple[int, int]]

    def pieces(self, hole: float) -> list[MovingPiece]:
        """Return the shapes of all plates, and then of all pins, that may touch other parts."""
        plates = [plate.piece for plate in self.plates]
        return plates + [MovingPiece(pin.frame, ((pin.at,),), hole / 2) for pin in self.pins]

    def near(self, cycle: Cycle, hole: float, gap: float) -> dict[tuple[int, int], Nearness]:
        """Return how near plates and pins come, by pairs that may meet."""
        plates, pins = range(1, len(self.plates)), list(enumerate(self.pins, start=len(self.plates)))
        pairs = [(i, j) for i, j in combinations(plates, 2) if (i, j) not in self.paired]
        pairs += [(i, number) for i in plates for number, pin in pins if i not in pin.plates]
        pairs += [(one, other) for (one, _), (other, _) in combinations(pins, 2)]
        asked = [(i, j, gap) for i, j in pairs]
        return dict(zip(pairs, cycle.nearness(self.pieces(hole), asked), strict=True))

    def nodes(self, hanging: Sequence[int]) -> list[list[int]]:
        """Return each plate's node, then those that each pin goes through: 0 is the ground, a bridge last."""
        node = {plate: number for number, group in enumerate(self.groups) for plate in group}
        nodes = [[node[plate]] for plate in range(len(self.plates))]
        for number, pin in enumerate(self.pins):
            through = {node[plate] for plate in pin.plates}
            nodes.append(sorted(through - {0} | {len(self.groups)} if number in hanging else through))
        return nodes

    def name(self, number: int) -> str:
        """Return what a plate or a pin is called."""
        plates = len(self.plates)
        return (
            self.plates[number].name if number < plates else f"the pin at {self.pins[number - plates].name}"
        )


def kit(cycle: Cycle, sizes: Sizes) -> Kit:
    """Return the parts of a scene; NotFlat where it has no flat parts, BadInput for sizes that do not fit."""
    if cycle.scene.linkage.drive.actuator.along is not None:
        raise NotFlat(
            "a cylinder drives it, which no flat parts are; let a crank or a slider drive it instead"
        )
    return _KitBuilder(cycle, sizes).kit()


def refuse_thin(plates: Iterable[Plate], sizes: Sizes) -> None:
    """Raise BadInput where two cuts of a plate leave too little between them."""
    for plate in plates:
        for one, other in combinations(plate.holes + plate.slots, 2):
            if one.begin != one.end and other.begin != other.end:
                continue  # slots of the ground may cross: a tongue is longer than the other slot is wide
            between = one.apart(other)
            if between < sizes.between:
                gap = f"leave {between:.2g} mm between them" if between > 0 else "run into each other"
                raise BadInput(
                    f"{plate.name}: {one.words} and {other.words}, {2 * one.radius:.3g} and "
                    f"{2 * other.radius:.3g} mm wide, {gap}; make them narrower (--hole, --bar), or "
                    "everything larger (--fit)"
                )


@dataclass
class _PlateDraft:
    """A plate that is being put together: the places of joints in its frame, and what else it needs."""

    name: str
    role: Role
    frame: Frame
    places: dict[str, complex]
    bodies: tuple[str, ...] = ()
    shown: set[str] = field(default_factory=set)
    """The joints that its outline includes even where it has no hole."""
    reach: list[complex] = field(default_factory=list)
    """Other points that its outline includes."""
    slots: list[Cut] = field(default_factory=list)
    guided: set[str] = field(default_factory=set)
    """The joints whose own pins, not tongues, run in its slots."""
    radius: float = 0.0
    teeth: Toothing | None = None

    def has(self, joint: str) -> bool:
        """Return whether a joint's pin runs through it, in a hole or a slot."""
        return joint in self.places or joint in self.guided


class _KitBuilder:
    """The parts of a linkage as they are put together."""

    def __init__(self, cycle: Cycle, sizes: Sizes) -> None:
        self.cycle, self.sizes, self.linkage = cycle, sizes, cycle.scene.linkage
        self.small = _STILL * sizes.scale * self.linkage.longest
        self.struts: tuple[Spring | Damper, ...] = (*self.linkage.springs, *self.linkage.dampers)
        self.hung = {name for strut in self.struts for name in strut.between}
        self.drafts: list[_PlateDraft] = []
        self.dowels: list[MadePin] = []
        self.one_layer: list[tuple[int, int]] = []

    def kit(self) -> Kit:
        """Return the parts."""
        ground = {name: self.sizes.scale * place for name, place in self.linkage.rigid_bodies[0].items()}
        self.drafts.append(_PlateDraft("ground", "ground", GROUND, ground))
        self._links()
        self._sliders()
        if len(self.drafts) > _MOST_PLATES:
            raise BadInput(
                f"{self.cycle.scene.name} has {len(self.drafts)} parts, and no more than {_MOST_PLATES} are "
                "laid in layers; make a share of it"
            )
        for pair in meshes(self.linkage, self.sizes.scale, max(self.sizes.bar / 4, 1.0)):
            first, second = map(self._wheel, pair)
            self._pair(first, second)
        pins = (*self._pins(), *self.dowels)
        plates = tuple(self._plate(number, pins) for number in range(len(self.drafts)))
        bands = tuple((self.linkage.strut_words(strut), strut.between) for strut in self.struts)
        groups = _joined(len(plates), self.one_layer)
        return Kit(plates, pins, bands, groups, frozenset(self.one_layer))

    def _links(self) -> None:
        """Add a plate for each rigid body but the ground; an unnamed bar on another plate joins that."""
        bodies = [body for body in self.linkage.bodies if len(body.joints) > 1]
        bare: list[_PlateDraft] = []
        for frame in self.linkage.rigid_bodies[1:]:
            named = [body for body in bodies if set(body.joints) <= frame.keys()]
            (self.drafts if named else bare).append(self._link(frame, named))
        for draft in bare:
            host = next((one for one in self.drafts[1:] if self._rides(draft, one)), None)
            if host is None:
                self.drafts.append(draft)
            else:
                new = [name for name in draft.places if name not in host.places]
                host.places |= {name: complex(self.cycle.seen(name, host.frame)[0]) for name in new}
                host.shown |= draft.shown

    def _link(self, frame: dict[str, complex], named: Sequence[Body]) -> _PlateDraft:
        """Return the plate of a rigid body: its first joint is its origin, x points to its second."""
        first, *others = dict.fromkeys([*(name for body in named for name in body.joints), *frame])
        apart = (name for name in others if abs(frame[name] - frame[first]) * self.sizes.scale > self.small)
        second = next(apart, None)
        if second is None:
            joints = ", ".join((first, *others))
            raise NotFlat(f"the joints {joints} of one body lie so close together that no bar joins them")
        along = frame[second] - frame[first]
        turn = self.sizes.scale * (along / abs(along)).conjugate()
        places = {name: (place - frame[first]) * turn for name, place in frame.items()}
        places[second] = complex(self.sizes.scale * abs(along))
        bodies = tuple(body.name for body in named)
        shown = {joint for body in named for joint in body.joints} or set(frame)
        name = bodies[0] if bodies else f"{first}–{second}"
        return _PlateDraft(name, "link", Frame(first, (first, second)), places, bodies, shown)

    def _rides(self, bare: _PlateDraft, host: _PlateDraft) -> bool:
        """Return whether a bar that no body names keeps its place on another plate at every phase."""
        if not bare.places.keys() & host.places.keys():
            return False
        paths = (self.cycle.seen(name, host.frame) for name in bare.places)
        return all(np.abs(path - path[0]).max() <= self.small for path in paths)

    def _holder(self, names: Iterable[str]) -> int:
        """Return the number of the plate that holds all these joints."""
        wanted = set(names)
        return next(n for n, draft in enumerate(self.drafts) if wanted <= draft.places.keys())

    def _sliders(self) -> None:
        blocks = {body.slider: body.name for body in self.linkage.bodies if body.slider is not None}
        for joint in self.linkage.joints:
            if sum(slide.point == joint.name for slide in joint.slides) > 1:
                name = blocks.get(joint.name, joint.name)
                raise NotFlat(
                    f"{name} slides on two links at once, which no flat part does; "
                    "pin it to one of them instead"
                )
            if len(joint.slides) == 2:
                bar, pin = joint.slides
                self._yoke(bar, pin, blocks.get(joint.name, f"yoke {joint.name}"))
                continue
            for slide in joint.slides:
                guide = self.drafts[self._guide(slide.line)]
                if slide.point in guide.places:
                    continue  # it is held there, and does not slide
                if joint.travels:
                    half, name = 0.75 * self.sizes.tongue, blocks.get(joint.name, f"slider {joint.name}")
                    tongue = self._tongue(joint.name, slide.line, (-half, half), name)
                    tongue.places[joint.name] = 0j
                    tongue.bodies = (name,) if joint.name in blocks else ()
                else:
                    self._slot(slide.point, slide.line, (0.0, 0.0), self.sizes.hole / 2)
                    guide.guided.add(slide.point)

    def _yoke(self, bar: Slide, pin: Slide, name: str) -> None:
        """Add a bar with a slot across its line, on a tongue long enough to pass the pins in its way.

        `bar` is how it slides along its line, `pin` how a pin slides along its slot.
        """
        frame = Frame(bar.point, bar.axis, cmath.rect(1.0, bar.angle))
        yoke = _PlateDraft(name, "link", frame, {bar.point: 0j}, (name,))
        self.drafts.append(yoke)
        number, direction = len(self.drafts) - 1, cmath.rect(1.0, pin.angle - bar.angle)
        least, most = _range((self.cycle.seen(pin.point, frame) * direction.conjugate()).real)
        yoke.slots.append(Cut(direction * least, direction * most, self.sizes.hole / 2, pin.point))
        yoke.guided.add(pin.point)
        ends = self._free_ends(bar.point, bar.line, 2.5 * self.sizes.bar)
        self._tongue(bar.point, bar.line, ends, f"{name} tongue")
        yoke.reach += [direction * least, direction * most, *map(complex, ends)]
        for end in ends:
            self._dowel(frame, complex(end), (number, len(self.drafts) - 1))

    def _guide(self, line: Line) -> int:
        """Return the number of the plate on which a line lies."""
        return self._holder((*line.on, line.through)) if line.on else 0

    def _travel(self, point: str, line: Line) -> tuple[complex, complex, float, float]:
        """Return a line's point and direction in its guide's frame, and a joint's range along it (mm)."""
        draft, direction = self.drafts[self._guide(line)], cmath.rect(1.0, line.angle)
        if line.on:
            axis = draft.places[line.on[1]] - draft.places[line.on[0]]
            direction *= axis / abs(axis)
        base = draft.places[line.through] + 1j * direction * line.offset * self.sizes.scale
        along = ((self.cycle.seen(point, draft.frame) - base) * direction.conjugate()).real
        return base, direction, *_range(along)

    def _slot(self, point: str, line: Line, ends: tuple[float, float], radius: float) -> None:
        """Cut a slot for a part that slides along a line, from `ends[0]` to `ends[1]` of its joint (mm)."""
        base, direction, least, most = self._travel(point, line)
        slot = Cut(base + direction * (least + ends[0]), base + direction * (most + ends[1]), radius, point)
        draft = self.drafts[self._guide(line)]
        draft.slots.append(slot)
        draft.reach += [slot.begin, slot.end]
        draft.radius = max(draft.radius, radius + self.sizes.wall)

    def _tongue(self, point: str, line: Line, ends: tuple[float, float], name: str) -> _PlateDraft:
        """Add a tongue that slides along a line with a joint, and cut its slot into the guide."""
        radius = self.sizes.tongue / 2
        self._slot(point, line, ends, radius + self.sizes.clearance / 2)
        frame = Frame(point, line.on, cmath.rect(1.0, line.angle))
        tongue = _PlateDraft(name, "slider", frame, {}, reach=[complex(end) for end in ends], radius=radius)
        self.drafts.append(tongue)
        self._pair(self._guide(line), len(self.drafts) - 1)
        return tongue

    def _free_ends(self, point: str, line: Line, long: float) -> tuple[float, float]:
        """Return the ends of a tongue along a line, from its joint (mm): it passes no joint of the guide."""
        base, direction, least, most = self._travel(point, line)
        near = (self.sizes.tongue + self.sizes.hole + self.sizes.bar) / 2
        places = self.drafts[self._guide(line)].places.values()
        others = [(place - base) * direction.conjugate() for place in places]
        met = [place.real for place in others if abs(place.imag) < near]

        def free(begin: float) -> bool:
            return not any(least + begin - near < at < most + begin + long + near for at in met)

        beside = [side for at in met for side in (at - least + 1.01 * near, at - most - long - 1.01 * near)]
        tries = sorted((-long / 2, *beside), key=lambda begin: abs(begin + long / 2))
        begin = next(filter(free, tries), -long / 2)
        return begin, begin + long

    def _wheel(self, wheel: GearWheel) -> int:
        """Make a plate a wheel if the wheel covers its joints, else add a wheel beside it, on a dowel."""
        sizes = self.sizes
        play = max(sizes.clearance, 0.1) / 4
        if wheel.arm is None:
            return self._still(Toothing(wheel, self.drafts[0].places[wheel.centre], 1 + 0j, play))
        host = self._holder((wheel.centre, wheel.arm))
        link = self.drafts[host]
        middle = link.places[wheel.centre]
        arm = link.places[wheel.arm] - middle
        room = wheel.root - sizes.wall - sizes.hole / 2
        far = max(abs(link.places[name] - middle) for name in {*self._used(host), wheel.centre})
        if link.teeth is None and not link.slots and far <= room:
            link.teeth = Toothing(wheel, middle, arm / abs(arm), play)
            return host
        least = sizes.hole + 1.01 * sizes.between
        if room < least:
            raise BadInput(
                f"the wheel about {wheel.centre} is {2 * wheel.root:.3g} mm wide within its teeth, too small "
                f"for a pin and a dowel of {sizes.hole:g} mm; make the holes smaller (--hole), or everything "
                "larger (--fit)"
            )
        frame = Frame(wheel.centre, (wheel.centre, wheel.arm))
        toothing = Toothing(wheel, 0j, 1 + 0j, play)
        name = f"{link.name} gear"
        self.drafts.append(_PlateDraft(name, "wheel", frame, {wheel.centre: 0j}, teeth=toothing))
        at = min(max(least, abs(arm) / 2), room)
        self._dowel(frame, complex(at), (host, len(self.drafts) - 1))
        return len(self.drafts) - 1

    def _still(self, toothing: Toothing) -> int:
        """Add a wheel that is fixed to the ground, or a ring on posts; return its number."""
        wheel, sizes, number = toothing.wheel, self.sizes, len(self.drafts)
        if wheel.ring:
            edge = wheel.root + sizes.bar
            middle = toothing.middle
            self.drafts.append(
                _PlateDraft("ring", "ring", GROUND, {}, reach=[middle], radius=edge, teeth=toothing)
            )
            far, posts = edge - sizes.bar / 2, _POSTS
        else:
            sun = _PlateDraft("sun gear", "wheel", GROUND, {wheel.centre: toothing.middle}, teeth=toothing)
            self.drafts.append(sun)
            far, posts = (sizes.hole + wheel.root) / 2, 1
        for n in range(posts):
            self._dowel(GROUND, toothing.middle + cmath.rect(far, math.tau * (n + 0.5) / posts), (0, number))
        return number

    def _pair(self, one: int, other: int) -> None:
        """Put two plates into one layer, where they are meant to touch."""
        self.one_layer.append((min(one, other), max(one, other)))

    def _dowel(self, frame: Frame, at: complex, plates: tuple[int, int]) -> None:
        name = f"dowel {len(self.dowels) + 1}"
        self.dowels.append(MadePin(name, frame, at, plates, stuck=True))

    def _used(self, number: int) -> list[str]:
        """Return the joints of a plate that are in use: by another plate, a band or a pencil."""
        others = [draft for draft in self.drafts if draft is not self.drafts[number]]
        wanted = self.hung | set(self.cycle.scene.trace)
        return [
            name
            for name in self.drafts[number].places
            if name in wanted or any(one.has(name) for one in others)
        ]

    def _pins(self) -> Iterator[MadePin]:
        """Yield a pin for each joint at which plates meet; joints that always coincide share one."""
        paths: dict[str, list[str]] = {}
        for name in (joint.name for joint in self.linkage.joints):
            path = self.cycle.seen(name, GROUND)
            same = (one for one in paths if np.abs(self.cycle.seen(one, GROUND) - path).max() <= self.small)
            paths.setdefault(next(same, name), []).append(name)
        for first, names in paths.items():
            plates = [n for n, draft in enumerate(self.drafts) if any(map(draft.has, names))]
            if len(plates) > 1:
                sliding = tuple(n for n in plates if not self.drafts[n].places.keys() & set(names))
                yield MadePin(first, Frame(first), 0j, tuple(plates), sliding)

    def _plate(self, number: int, pins: Sequence[MadePin]) -> Plate:
        """Return a plate with its holes: for pins, dowels, the eyes of bands, and a pencil."""
        draft, sizes = self.drafts[number], self.sizes
        holes: list[Cut] = []
        for pin in (pin for pin in pins if number in pin.plates and number not in pin.sliding):
            at = complex(self._seen(pin, draft.frame))
            name = next((name for name, place in draft.places.items() if abs(place - at) <= self.small), "")
            stuck = pin.stuck or draft.role == "ground"
            holes.append(Cut.hole(draft.places.get(name, at), sizes.snug if stuck else sizes.hole, name))
        traced = self.cycle.scene.trace if draft.role == "link" else ()
        for name, place in draft.places.items():
            eye = Cut.hole(place, sizes.hole, name)
            room = min((eye.apart(one) for one in (*holes, *draft.slots)), default=math.inf)
            # A pencil's hole is left out where there is no room for it; a band's eye is not.
            if (name in self.hung and room > -sizes.hole) or (name in traced and room >= sizes.between):
                holes.append(eye)
        if draft.teeth is not None and not draft.teeth.wheel.ring:
            corners: Iterable[complex] = (draft.teeth.middle,)
        elif draft.teeth is not None:
            corners = draft.reach
        else:
            shown = (draft.places[name] for name in draft.places if name in draft.shown)
            corners = (*(hole.begin for hole in holes), *shown, *draft.reach)
        least = {"ground": sizes.bar, "slider": 0.0}.get(draft.role, sizes.bar / 2)
        radius = (
            draft.teeth.wheel.tip if draft.teeth and not draft.teeth.wheel.ring else max(draft.radius, least)
        )
        return Plate(
            draft.name,
            draft.role,
            draft.frame,
            tuple(dict.fromkeys(corners)),
            radius,
            draft.bodies,
            tuple(holes),
            tuple(draft.slots),
            draft.teeth,
        )

    def _seen(self, pin: MadePin, frame: Frame) -> complex:
        """Return the place of a pin in a frame in which it does not move."""
        if pin.frame == frame:
            return pin.at
        at = self.cycle.paths(pin.frame, [pin.at])[0, 0]
        origin, unit = self.cycle.paths(frame, [0j, 1 + 0j])[0]
        return complex((at - origin) * (unit - origin).conjugate())


def _range(along: Real) -> tuple[float, float]:
    """Return the range of a closed motion's samples, widened by what the bend between two may add."""
    bend = float(np.abs(np.diff(along, 2, append=along[:2])).max()) / 4
    return float(along.min()) - bend, float(along.max()) + bend


def _joined(count: int, pairs: Iterable[tuple[int, int]]) -> tuple[tuple[int, ...], ...]:
    """Return the sets of numbers that pairs join, in the order of their first members."""
    home = list(range(count))
    for a, b in pairs:
        one, other = sorted((home[a], home[b]))
        home = [one if at == other else at for at in home]
    return tuple(tuple(n for n in range(count) if home[n] == at) for at in dict.fromkeys(home))
