"""A linkage as flat parts in layers, at a pose: from above, or lifted off each other and seen aslant.

Plates and pins are in millimetres, each in a frame that it moves with.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.measures import as_complex
from linkanim.mechanics.motion import Pose
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group, Halo, Item, grouped
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.shapes import disc, hull, segments, stroke
from linkanim.picture.text import subscripted
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene
from linkanim.units import metre

_LEAN, _FLAT = 0.42, 0.5
"""For parts seen aslant: how far right, and how far up, a unit towards the back is drawn."""
_THICK, _EDGE = 5.0, 24.0
"""The drawn thickness of a plate, and the margin around all, in pixels of a page."""
_SHADOW = ((2 + 2.5j, 0.16), (3.5 + 4.5j, 0.1))
"""How far a plate's shadow lies from it, in such pixels, and how dark it is: twice, for its soft edge."""
_SHADE = (0, 0, 0)
_THIN = 0.6
"""The least thickness of lines of parts, in pixels of a page."""
_LIFTED = 0.62
"""The share of the height in which layers are lifted."""
_PHASES = 48
"""The number of phases that tell how far parts extend."""
_NUMBERED = 0.5
"""Numbers stand on plates while these are lifted by less than this."""
_CORNERS, _TOWARDS = 16, (0.25, 0.45, 0.65, 0.8)
"""A number that is hidden, or on another, is tried at these shares of the way to so many of its corners."""


class Frame(NamedTuple):
    """How a piece moves: the joint at its origin, and its x axis, which runs along `turn`, joint to joint.

    None stands for the origin and the x axis of the ground.
    """

    origin: str | None = None
    axis: tuple[str, str] | None = None
    turn: complex = 1 + 0j


class LayeredPlate(NamedTuple):
    """A plate: its layer, 0 being the ground, its number and where that stands, its edge and its cuts."""

    frame: Frame
    layer: int
    number: str
    at: complex
    loops: tuple[Loop, ...]
    toothed: bool = False


class LayeredPin(NamedTuple):
    """A pin from its lowest to its highest layer; a dowel has no name."""

    frame: Frame
    at: complex
    low: int
    high: int
    name: str = ""


@frozen(eq=False)
class Layered:
    """Parts of a scene in their layers, `ratio` times as large as the scene."""

    scene: Scene
    ratio: float
    plates: tuple[LayeredPlate, ...]
    pins: tuple[LayeredPin, ...]

    @property
    def layers(self) -> int:
        """How many layers lie on the ground."""
        return max((plate.layer for plate in self.plates), default=0)

    @cached_property
    def reach(self) -> Loop:
        """The corners of a rectangle, in mm, that holds all plates over the whole period."""
        motion = self.scene.cycle(self.scene.mechanism.count(_PHASES), derivatives=0)
        scale = self._scale(self.scene.length_unit)
        reach = []
        for plate in self.plates:
            edge = np.array(hull(plate.loops[0].tolist()))
            origin, axis, turn = plate.frame
            at = np.zeros(len(motion.phase), np.complex128)
            if origin:
                at += scale * as_complex(motion.position[origin])
            ways = np.full(len(motion.phase), turn)
            if axis:
                one, other = (as_complex(motion.position[name]) for name in axis)
                ways *= (other - one) / np.abs(other - one)
            reach.append((at[:, None] + np.multiply.outer(ways, edge)).ravel())
        return np.array(hull(np.concatenate(reach).tolist()))

    def lying(self, frames: Sequence[Frame], pose: Pose, unit: str) -> list[tuple[complex, complex]]:
        """Return where frames lie at a pose in a `unit` of length: origins in mm, and directions."""
        return [self._lying(frame, pose, self._scale(unit)) for frame in frames]

    def _scale(self, unit: str) -> float:
        return 1000 * metre(unit) * self.ratio

    def _lying(self, frame: Frame, pose: Pose, scale: float) -> tuple[complex, complex]:
        origin, axis, turn = frame
        at = complex(*pose.position[origin]) if origin else 0j
        bar = complex(*pose.position[axis[1]]) - complex(*pose.position[axis[0]]) if axis else 1 + 0j
        return scale * at, turn * bar / abs(bar)


_APART = 0.5
"""How far layers are lifted, from 0 to 1, where a pin is named in each of its layers."""


class LayerView(NamedTuple):
    """How parts are seen: how far they are lifted and aslant, and where the plane lies in pixels."""

    apart: float
    scale: float
    origin: complex
    lift: float

    @classmethod
    def fitting(cls, points: Loop, layers: int, apart: float, room: Rect) -> LayerView:
        """Return the view in which points of the plane (mm) have room: `apart` from 0, flat, to 1."""
        aslant = _aslant(points, apart)
        left, right = float(aslant.real.min()), float(aslant.real.max())
        low, high = float(aslant.imag.min()), float(aslant.imag.max())
        share = 1 - _LIFTED * apart * (layers > 0)
        scale = min(room.width / max(right - left, 1e-9), share * room.height / max(high - low, 1e-9))
        lift = apart * (room.height - scale * (high - low)) / max(layers, 1)
        x = room.middle.real - scale * (left + right) / 2
        y = room.middle.imag + scale * (low + high) / 2 + lift * layers / 2
        return cls(apart, scale, complex(x, y), lift)

    def seen(self, places: Loop, layer: float) -> Loop:
        """Return where places of a layer (mm) are, in pixels."""
        flat = self.scale * _aslant(places, self.apart)
        return np.asarray(self.origin + np.conj(flat) - 1j * self.lift * layer)

    def moved(self, about: complex, zoom: float, pan: complex) -> LayerView:
        """Return the view zoomed about a pixel, then shifted by `pan` in pixels."""
        origin = about + (self.origin - about) * zoom + pan
        return self._replace(scale=self.scale * zoom, origin=origin, lift=self.lift * zoom)


def room_of(size: tuple[int, int]) -> Rect:
    """Return the room for lifted parts on a page of that size."""
    return Rect(_EDGE, _EDGE, size[0] - 2 * _EDGE, size[1] - 2 * _EDGE - _THICK)


def layer_colour(layer: int, theme: Theme) -> Colour:
    """Return the colour of a layer's plates."""
    return theme.gear if layer == 0 else theme.bodies[(layer - 1) % len(theme.bodies)]


def _aslant(places: Loop, apart: float) -> Loop:
    """Return places in the plane as seen from above, and the more aslant the further layers are `apart`."""
    return np.asarray(
        places.real + apart * _LEAN * places.imag + 1j * (1 - apart * (1 - _FLAT)) * places.imag
    )


def in_layers(setting: DrawSetting, pose: Pose, parts: Layered, apart: float) -> Group:
    """Return parts in their layers, lifted by a share of the stage, in the look's zoom and pan."""
    layout, look = setting.layout, setting.look
    view = LayerView.fitting(parts.reach, parts.layers, apart, layout.stage.inset(2 * layout.margin))
    view = view.moved(layout.stage.middle, look.zoom, complex(*look.pan) * layout.size[1])
    unit, pixel = setting.figure.scene.length_unit, max(layout.unit, _THIN)
    items = lifted(parts, pose, unit, view, setting.theme, layout.small_size, pixel=pixel)
    return grouped("layers", items)


def lifted(
    parts: Layered, pose: Pose, unit: str, view: LayerView, theme: Theme, text: int, *, pixel: float = 1.0
) -> Iterator[Item]:
    """Yield parts at a pose in a unit of length, layer by layer, and the names of their pins.

    Each plate throws a shadow on what is below. Names have the height `text`, in pixels; lines and edges are
    drawn for a page whose pixel has the size `pixel`.
    """
    places = parts.lying([plate.frame for plate in parts.plates], pose, unit)
    flat = [
        [at + turn * loop for loop in plate.loops]
        for plate, (at, turn) in zip(parts.plates, places, strict=True)
    ]
    held = parts.lying([pin.frame for pin in parts.pins], pose, unit)
    pins = [(pin, np.array([at + turn * pin.at])) for pin, (at, turn) in zip(parts.pins, held, strict=True)]
    thick, halo = _THICK * pixel * view.apart, Halo(theme.background, 2.5 * pixel)
    names: list[Caption] = []
    for layer in range(parts.layers + 1):
        lying = [n for n, plate in enumerate(parts.plates) if plate.layer == layer]
        for n in lying if layer else ():
            for far, alpha in _SHADOW:
                edge = view.seen(flat[n][0], layer - 1) + pixel * far
                yield Layer(_SHADE, [edge], alpha)
        for n in lying:
            yield from _plate(
                parts.plates[n], [view.seen(loop, layer) for loop in flat[n]], theme, thick, pixel
            )
        for pin, at in pins:
            if not pin.low <= layer <= pin.high:
                continue
            place = complex(view.seen(at, layer)[0])
            yield Layer(theme.outline, [place + disc(2.6 * pixel)])
            if layer < pin.high and view.lift:
                above = complex(view.seen(at, layer + 1)[0])
                yield Layer(theme.outline, segments(place, above, 1.4 * pixel), 0.75)
            if pin.name and (layer == pin.high or view.apart > _APART):
                beside = place.real + 4 * pixel, place.imag - 1.1 * text
                names.append(Caption(subscripted(pin.name), beside, text, theme.ink, halo=halo))
    if view.apart < _NUMBERED:
        usual = [
            complex(view.seen(np.array([origin + turn * plate.at]), plate.layer)[0])
            for plate, (origin, turn) in zip(parts.plates, places, strict=True)
        ]
        edges = [view.seen(loops[0], plate.layer) for loops, plate in zip(flat, parts.plates, strict=True)]
        words = [complex(one.at[0], one.at[1]) + (0.6 + 0.5j) * text for one in names]
        for n, place in _numbers(parts.plates, edges, usual, words, text):
            top, number = (place.real, place.imag - 0.5 * text), parts.plates[n].number
            names.append(Caption(number, top, text, theme.ink, "centre", strong=True, halo=halo))
    yield from names


def _numbers(
    plates: Sequence[LayeredPlate],
    edges: Sequence[Loop],
    usual: Sequence[complex],
    words: Sequence[complex],
    text: int,
) -> Iterator[tuple[int, complex]]:
    """Yield the plates whose numbers are shown, and where: on visible parts, off words and each other.

    Each number stands at its usual place, or else as near to it as possible. A plate without a visible place
    for its number has none.
    """
    taken, around = [*words], 0.4 * text * np.array([0, 1, -1, 1j, -1j])
    for n in sorted(range(len(plates)), key=lambda n: -plates[n].layer):
        if plates[n].layer == 0:
            continue
        corners = edges[n][:: max(len(edges[n]) // _CORNERS, 1)]
        ways = np.concatenate([[usual[n]], *(usual[n] + share * (corners - usual[n]) for share in _TOWARDS)])
        free = _inside(edges[n], ways)
        free[0] = True
        for edge, plate in zip(edges, plates, strict=True):
            if plate.layer > plates[n].layer:
                free &= ~_inside(edge, np.add.outer(ways, around).ravel()).reshape(-1, 5).any(axis=1)
        for other in taken:
            free &= np.abs(ways - other) > 1.1 * text
        if free.any():
            taken.append(complex(ways[free.argmax()]))
            yield n, taken[-1]


def _inside(edge: Loop, places: Loop) -> NDArray[np.bool_]:
    """Return which places lie within an edge."""
    one, other = edge, np.roll(edge, -1)
    upward = np.where(other.imag == one.imag, 1.0, other.imag - one.imag)  # what is level is crossed nowhere
    across = (places.imag[:, None] - one.imag) / upward
    right = places.real[:, None] < one.real + across * (other.real - one.real)
    crossed = (one.imag > places.imag[:, None]) != (other.imag > places.imag[:, None])
    return np.asarray((crossed & right).sum(axis=1) % 2 == 1)


def _plate(
    plate: LayeredPlate, loops: Sequence[Loop], theme: Theme, thick: float, pixel: float
) -> Iterator[Item]:
    """Yield a plate, and below it the visible edge of a plate that is seen aslant."""
    colour = layer_colour(plate.layer, theme)
    if thick:
        below = loops[0] + 1j * thick
        if not plate.toothed:
            below = np.array(hull(np.concatenate((loops[0], below)).tolist()))
        yield Layer(mixed(colour, theme.outline, 0.45), [below])
    yield Layer(colour, [loops[0], *(loop[::-1] for loop in loops[1:])])
    lines = [line for loop in loops for line in stroke(loop, 0.8 * pixel, closed=True)]
    yield Layer(theme.outline, lines)
