"""A made linkage: the parts of a scene and their layers, as a value; or why it cannot be made."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from itertools import count
from typing import Literal

import numpy as np

from linkanim import units
from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.motion import Pose
from linkanim.picture.figure import figure
from linkanim.picture.layered import Frame, Layered, LayeredPin, LayeredPlate
from linkanim.scenes.scene import Scene
from linkanim.words import name_said, said, said_many
from linkanim.workshop.layers import Budget, Stack, Unstackable, can_be_stacked, stacked
from linkanim.workshop.media import Size, Way
from linkanim.workshop.parts import Band, Cut, Kit, MadePin, Plate, Sizes, kit, refuse_thin
from linkanim.workshop.shapes import box, polygon
from linkanim.workshop.sweep import GROUND, Cycle

_CHORD = 0.05
"""How far the sides of a drawn outline may stay within its arcs, in mm."""
_TRUE = 1e-12
"""How far a scale may be off 1 and still be true size."""
SLENDER = 14.0
"""A usual bar's length over its width."""
_MOST_TOLD = 6
"""The most clashes that a refusal lists."""
_THINNER = (0.7, 0.5, 0.25)
"""Shares of the width of bars and holes that are tried where the full width has no layers."""


@frozen
class MadeLinkage:
    """A scene's parts and their layers, or in a sentence why it cannot be made flat: `refused`.

    `layer[n]` is the layer of `plates[n]`; plate 0 is the ground, in layer 0. `fewest` is whether fewer
    layers are known to be impossible. `sheet` is the size of the material, or of the paper.
    """

    scene: Scene
    way: Way
    sizes: Sizes
    kerf: float
    sheet: Size
    plates: tuple[Plate, ...] = ()
    layer: tuple[int, ...] = ()
    pins: tuple[MadePin, ...] = ()
    bands: tuple[Band, ...] = ()
    fewest: bool = True
    refused: str | None = None

    @property
    def layers(self) -> int:
        """The number of layers on the ground."""
        return max(self.layer, default=0)

    @property
    def ratio(self) -> float:
        """The scale at which it is made: 1 is true size."""
        return self.sizes.scale / true_scale(self.scene)

    @property
    def size_words(self) -> str:
        """How large it is made, in words."""
        return (
            said("in true size")
            if abs(self.ratio - 1) < _TRUE
            else said("{number} times as large as the scene", number=f"{self.ratio:g}")
        )

    @property
    def layer_words(self) -> str:
        """The number of layers in words; there is none where all parts slide within the ground."""
        if not self.layers:
            return said("all within the ground")
        return said_many("in 1 layer on the ground", "in {count} layers on the ground", self.layers)

    @cached_property
    def numbers(self) -> tuple[str, ...]:
        """The plates' numbers: 1 for the ground, those of figures for links, free ones from 2 for others."""
        given = {body.name: number for body, number in figure(self.scene).numbers.items()}
        wanted = [next((given[name] for name in plate.bodies if name in given), "") for plate in self.plates]
        wanted[:1] = ["1"]
        numbers: list[str] = []
        others = (str(number) for number in count(2) if str(number) not in wanted)
        for number in wanted:
            numbers.append(number if number and number not in numbers else next(others))
        return tuple(numbers)

    def label(self, number: int) -> str:
        """Return a plate's number and name; the number alone where that is its name."""
        name, own = self.plates[number].name, self.numbers[number]
        return own if name == own else f"{own} {name_said(name)}"

    @cached_property
    def layered(self) -> Layered:
        """The parts as they are drawn."""
        plates = (
            LayeredPlate(
                plate.frame,
                layer,
                number,
                plate.clearest,
                tuple(np.array(polygon(one, _CHORD)) for one in (plate.outline(), *plate.cuts())),
                plate.teeth is not None,
            )
            for plate, layer, number in zip(self.plates, self.layer, self.numbers, strict=True)
        )
        pins = (
            LayeredPin(pin.frame, pin.at, pin.low, pin.high, "" if pin.stuck else pin.name)
            for pin in self.pins
        )
        return Layered(self.scene, self.ratio, tuple(plates), tuple(pins))

    def placed(self, phase: float) -> list[tuple[complex, complex]]:
        """Return the place of each plate's frame at a phase: its origin (mm) and its direction, as x + yi."""
        pose = self.scene.pose(phase, 0)
        return [self._lying(plate.frame, pose) for plate in self.plates]

    def pinned(self, phase: float) -> list[complex]:
        """Return the place of each pin at a phase, as x + yi in mm."""
        pose = self.scene.pose(phase, 0)
        frames = (self._lying(pin.frame, pose) for pin in self.pins)
        return [at + turn * pin.at for pin, (at, turn) in zip(self.pins, frames, strict=True)]

    def _lying(self, frame: Frame, pose: Pose) -> tuple[complex, complex]:
        origin, axis, turn = frame
        at = complex(*pose.position[origin]) if origin else 0j
        bar = complex(*pose.position[axis[1]]) - complex(*pose.position[axis[0]]) if axis else 1 + 0j
        return self.sizes.scale * at, turn * bar / abs(bar)

    def as_object(self) -> dict[str, object]:
        """Return what `linkanim make --json` prints: lengths in mm, each part in its own frame.

        `parts` are the scene's bodies, `fittings` other plates, `pins` the pins at its joints.
        """
        every = [(bool(plate.bodies), self._part(number)) for number, plate in enumerate(self.plates)]
        return {
            "scene": self.scene.name,
            "way": self.way,
            "scale": self.ratio,
            "thickness": self.sizes.thickness,
            "layers": self.layers,
            "least": self.fewest,
            "parts": [part for of_scene, part in every if of_scene],
            "fittings": [part for of_scene, part in every if not of_scene],
            "pins": [self._pin(pin) for pin in self.pins if not pin.stuck],
            "dowels": [self._pin(pin) for pin in self.pins if pin.stuck],
            "bands": [{"name": name, "joints": joints} for name, joints in self.bands],
            "refused": self.refused,
        }

    def _part(self, number: int) -> dict[str, object]:
        plate = self.plates[number]
        inside = [plate.teeth] if plate.teeth and plate.teeth.wheel.ring else []
        return {
            "body": plate.bodies[0] if plate.bodies else plate.name,
            "bodies": plate.bodies,
            "number": self.numbers[number],
            "number_at": _pair(plate.clearest),
            "teeth": plate.teeth.wheel.teeth if plate.teeth else None,
            "layer": self.layer[number],
            **_framed(plate.frame),
            "outline": [_pair(point) for point in polygon(plate.outline())],
            "holes": [[*_pair(hole.begin), 2 * hole.radius] for hole in plate.holes],
            "joints": [hole.joint for hole in plate.holes],
            "slots": [[*_pair(slot.begin), *_pair(slot.end), 2 * slot.radius] for slot in plate.slots],
            "cuts": [[_pair(point) for point in polygon(teeth.outline(0.0))] for teeth in inside],
        }

    def _pin(self, pin: MadePin) -> dict[str, object]:
        return {
            "joint": pin.name,
            "from": pin.low,
            "to": pin.high,
            "diameter": self.sizes.pin,
            "side": pin.side,
            **_framed(pin.frame),
            "at": _pair(pin.at),
            "spacers": [list(spacer) for spacer in pin.spacers],
        }


def true_scale(scene: Scene) -> float:
    """Return millimetres for one unit of a scene's length, in true size."""
    return 1000 * units.metre(scene.length_unit)


def laid(made: MadeLinkage, work: Budget, *, bridge: bool) -> MadeLinkage:
    """Return `made` with its plates and pins in layers, or with the reason why there are none.

    With a `bridge` fixed pins may hang from a plate above all others. NotFlat and BadInput as `kit`; BadInput
    where holes leave too little between them.
    """
    sizes, cycle = made.sizes, Cycle(made.scene, made.sizes.scale)
    parts = kit(cycle, sizes)
    stack = stacked(cycle, parts, work, hole=sizes.hole, gap=sizes.gap, bridge=bridge)
    if isinstance(stack, Unstackable):
        return replace(made, refused=_why_not(stack, cycle, sizes, work))
    pins = tuple(_pin(parts, stack, number, sizes) for number in range(len(parts.pins)))
    whole = replace(
        made, plates=parts.plates, layer=stack.layers, pins=pins, bands=parts.bands, fewest=stack.least
    )
    if stack.hanging:
        whole = _bridged(cycle, whole)
    refuse_thin(whole.plates, sizes)
    return whole


def _why_not(why: Unstackable, cycle: Cycle, sizes: Sizes, work: Budget) -> str:
    """Return in a sentence which parts would meet, where, and the ways out."""
    if not why.clashes:
        return (
            f"{cycle.scene.name} cannot be made flat: in none of the many orders that were tried do all its "
            f"parts pass each other; make the bars narrower (--bar, now {sizes.bar:g})"
        )
    met = [
        f"{one} would meet {other} (phase {math.degrees(phase):.1f} deg)"
        for one, other, phase in why.clashes[:_MOST_TOLD]
    ]
    more = len(why.clashes) - len(met)
    met += [f"{more} more would meet"] if more else []
    clashes = f"{', '.join(met[:-1])} and {met[-1]}" if met[1:] else met[0]
    order = "whichever of the two lies higher" if len(met) == 1 else "in whatever order they lie"
    thinner = (
        replace(sizes, bar=sizes.bar * share, hole=sizes.hole * share) for share in _shares(cycle, sizes)
    )
    narrow = next((some.bar for some in thinner if _is_stackable(cycle, some, work)), None)
    if narrow is not None:
        ways_out = f"narrower bars can, such as --bar {narrow:.3g}"
    elif why.bridged:
        ways_out = f"a bridge over it can carry {' and '.join(why.bridged)} from above (--bridge)"
    else:
        ways_out = (
            "put a crank outside, on a shaft through the ground, or make a fixed pin a stub shaft so wide "
            "that it carries the other pin, too"
        )
    return f"{cycle.scene.name} cannot be made flat: {clashes}, {order}; {ways_out}"


def _shares(cycle: Cycle, sizes: Sizes) -> Iterator[float]:
    """Yield shares of a bar's width to try: a few, and for wide bars halves down to the usual width."""
    yield from _THINNER
    share, usual = _THINNER[-1], cycle.scene.linkage.longest * sizes.scale / SLENDER
    while sizes.bar * share > usual:
        share /= 2
        yield share


def _is_stackable(cycle: Cycle, sizes: Sizes, work: Budget) -> bool:
    """Return whether layers are found for parts of other sizes."""
    try:
        parts = kit(cycle, sizes)
    except BadInput:
        return False
    return can_be_stacked(cycle, parts, work, hole=sizes.hole, gap=sizes.gap)


def _pin(parts: Kit, stack: Stack, number: int, sizes: Sizes) -> MadePin:
    """Return a pin with its ends, and with a ring in each layer between its plates that has room for one."""
    pin, hangs = parts.pins[number], number in stack.hanging
    plates = tuple(plate for plate in pin.plates if plate or not hangs)
    levels = {stack.layers[plate] for plate in plates} | ({max(stack.layers) + 1} if hangs else set())
    rings = [
        (layer, 2 * reach)
        for layer in range(min(levels), max(levels))
        if layer not in levels
        for reach in [_reach(parts, stack, number, layer, sizes)]
        if reach >= sizes.hole / 2 + sizes.wall / 4
    ]
    side: Literal["below", "above"] | None = "above" if hangs else "below" if pin.fixed else None
    low, high = min(levels), max(levels)
    return pin._replace(plates=plates, low=low, high=high, side=side, spacers=tuple(rings))


def _reach(parts: Kit, stack: Stack, number: int, layer: int, sizes: Sizes) -> float:
    """Return the radius that a ring on a pin can have in a layer: half a bar, or what others leave."""
    first = len(parts.plates)
    own, reach = first + number, sizes.bar / 2
    for (one, other), room in stack.room.items():
        if other == own and one < first and stack.layers[one] == layer:
            reach = min(reach, sizes.hole / 2 + room - sizes.gap)
        elif own in (one, other) and one >= first:
            # The other pin may have a ring there, too.
            reach = min(reach, sizes.hole / 2 + (room - sizes.gap) / 2)
    return reach


def _bridged(cycle: Cycle, made: MadeLinkage) -> MadeLinkage:
    """Return `made` with a bridge for the hanging pins, over all that moves, on two posts beside it."""
    sizes, top, number = made.sizes, made.layers + 1, len(made.plates)
    hanging = {pin.name: complex(cycle.seen(pin.name, GROUND)[0]) for pin in made.pins if pin.side == "above"}
    swept = [
        place + plate.radius * corner
        for plate in made.plates
        for place in cycle.paths(plate.frame, plate.corners).ravel().tolist()
        for corner in (1 + 1j, -1 - 1j)
    ]
    left, right, low, high = box(swept)
    middle, beside = sum(hanging.values()) / len(hanging), sizes.bar + sizes.gap
    if right - left <= high - low:
        posts = (complex(left - beside, middle.imag), complex(right + beside, middle.imag))
    else:
        posts = (complex(middle.real, low - beside), complex(middle.real, high + beside))
    stands = tuple(Cut.hole(place, sizes.snug) for place in posts)
    carried = tuple(Cut.hole(place, sizes.snug, name) for name, place in hanging.items())
    corners = (*hanging.values(), *posts)
    bridge = Plate("bridge", "bridge", GROUND, corners, sizes.bar / 2, holes=carried + stands)
    ground = made.plates[0]
    remaining = tuple(hole for hole in ground.holes if hole.joint not in hanging)
    others = (corner for corner in ground.corners if corner not in hanging.values())
    ground = replace(ground, holes=remaining + stands, corners=tuple(dict.fromkeys((*others, *posts))))
    pins = [pin._replace(plates=(*pin.plates, number)) if pin.name in hanging else pin for pin in made.pins]
    pins += [
        MadePin(f"post {n}", GROUND, place, (0, number), stuck=True, high=top, side="below")
        for n, place in enumerate(posts, start=1)
    ]
    plates, layer = (ground, *made.plates[1:], bridge), (*made.layer, top)
    return replace(made, plates=plates, layer=layer, pins=tuple(pins))


def _pair(point: complex) -> tuple[float, float]:
    return point.real, point.imag


def _framed(frame: Frame) -> dict[str, object]:
    """Return a frame as data: its origin, the joints of its line, and the angle of its x axis from it."""
    turned = math.atan2(frame.turn.imag, frame.turn.real)
    return {"origin": frame.origin, "towards": frame.axis, "turned": turned}
