"""Bodies: rounded bars and plates, sliding blocks, the pins on top of them, centres of mass."""

from __future__ import annotations

import numpy as np

from linkanim.mechanics.kinds import RPR
from linkanim.mechanics.linkage import Body
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.parts import Part, Stamp, glazed, lined
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.shapes import box, disc, hull, rounded, unit
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import View

BLOCK = (4.6, 3.2)
"""A slider block's length and height in half widths of a bar."""


def body_parts(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> tuple[Part, ...]:
    """Return every body, back to front: blocks, then plates, then bars, each in the scene's order.

    Plates are clear enough to show what lies behind them.
    """
    colours = colours_of(figure, theme)
    placed = {body: _local(body, figure, view) for body in figure.bodies}
    plates = [body for body, points in placed.items() if len(hull(points)) > 2]
    bars = [body for body in placed if body not in plates]
    blocks = _sliders(figure, gauge, theme) + [_collar(slot, gauge, theme) for slot in figure.slots]
    solid = [_body(body, placed[body], gauge, (theme.outline, colours[body.name])) for body in plates + bars]
    slotted = [_slot(slot, figure, view, gauge, theme) for slot in figure.slots]
    return (*_behind(figure, view, gauge, theme), *solid, *slotted, *blocks) if slotted else (*blocks, *solid)


def colours_of(figure: Figure, theme: Theme) -> dict[str, Colour]:
    """Return each body's colour: the driven crank's is the first, one without a name is metal."""
    drive = figure.linkage.drive.joint
    named = [body for body in figure.linkage.bodies if len(body.joints) > 1]
    first = sorted(named, key=lambda body: not _is_crank(body, figure, drive))
    colours = {body.name: theme.bodies[n % len(theme.bodies)] for n, body in enumerate(first)}
    return {"": theme.metal, **colours}


def _is_crank(body: Body, figure: Figure, joint: str) -> bool:
    crank = figure.linkage.joint(joint)
    return joint in body.joints and getattr(crank, "pivot", None) in body.joints


def _local(body: Body, figure: Figure, view: View) -> list[complex]:
    """Return the body's joints in pixels, the first at 0 and the second on the positive real axis."""
    places = [view.scale * figure.start(name).conjugate() for name in body.joints]
    turn = unit(places[1] - places[0])
    return [(place - places[0]) / turn for place in places]


def _body(body: Body, points: list[complex], gauge: Gauge, colours: tuple[Colour, Colour]) -> Part:
    shaped = glazed if len(hull(points)) > 2 else lined
    layers = shaped(points, gauge.bar, gauge.outline, colours)
    return Part(body.joints[0], body.joints[0], body.joints[1], tuple(layers), body.joints)


def _sliders(figure: Figure, gauge: Gauge, theme: Theme) -> list[Part]:
    return [
        _block(slider.name, gauge, theme, complex(np.exp(-1j * slider.line.angle)))
        for slider in figure.sliders
    ]


def _block(joint: str, gauge: Gauge, theme: Theme, turn: complex) -> Part:
    length, height = (side * gauge.bar for side in BLOCK)
    edge = 2 * gauge.outline
    outer, inner = box(length, height, 0.4 * gauge.bar), box(length - edge, height - edge, 0.3 * gauge.bar)
    layers = (Layer(theme.outline, [turn * outer]), Layer(theme.metal, [turn * inner]))
    return Part(joint, joint, joint, layers, (joint,))


def _collar(slot: RPR, gauge: Gauge, theme: Theme) -> Part:
    """Return the block that slides in a slotted bar and turns with it."""
    block = _block(slot.through, gauge, theme, 1 + 0j)
    small = tuple(Layer(layer.colour, [0.62 * loop for loop in layer.loops]) for layer in block.layers)
    return Part(slot.through, slot.pivot, slot.name, small, block.joints)


def _reach(slot: RPR, figure: Figure, view: View) -> tuple[complex, complex]:
    """Return the ends of a slot in pixels, the pivot at 0 and the bar along the real axis."""
    pivot, through = figure.cycle.position[slot.pivot], figure.cycle.position[slot.through]
    far = np.sqrt(np.maximum(np.sum((through - pivot) ** 2, axis=-1) - slot.offset**2, 0))
    side = -1j * slot.offset
    return view.scale * (np.nanmin(far) + side), view.scale * (np.nanmax(far) + side)


def _behind(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> list[Part]:
    """Return what a slotted bar needs beyond its joints to carry its slot."""
    parts = []
    for slot in figure.slots:
        points = [0j, *_reach(slot, figure, view)]
        layers = lined(points, 1.35 * gauge.bar, gauge.outline, (theme.outline, theme.metal))
        parts.append(Part(slot.pivot, slot.pivot, slot.name, tuple(layers), (slot.pivot,)))
    return parts


def _slot(slot: RPR, figure: Figure, view: View, gauge: Gauge, theme: Theme) -> Part:
    hollow = mixed(theme.metal, theme.outline, 0.75)
    layer = Layer(hollow, [rounded(list(_reach(slot, figure, view)), 0.5 * gauge.bar)])
    return Part(slot.pivot, slot.pivot, slot.name, (layer,))


def pin_stamp(gauge: Gauge, theme: Theme) -> Stamp:
    """Return a pin: a ring around an eye."""
    outer, inner = disc(gauge.pin + gauge.outline / 2), disc(gauge.pin - gauge.outline / 2)
    return Stamp((Layer(theme.outline, [outer]), Layer(theme.pin, [inner])))


def mass_stamp(gauge: Gauge, theme: Theme) -> Stamp:
    """Return the sign of a centre of mass: a disc with two of its quarters light."""
    radius = 0.48 * gauge.bar
    quarter = np.concatenate(([0j], radius * np.exp(1j * np.linspace(0, np.pi / 2, 9))))
    outer = Layer(theme.outline, [disc(radius + gauge.outline)])
    return Stamp((outer, Layer(theme.pin, [quarter, -quarter])))


def mark_stamp(colour: Colour, gauge: Gauge, theme: Theme) -> Stamp:
    """Return the mark of a joint that is traced, in its curve's colour."""
    radius = 0.62 * gauge.bar
    return Stamp((Layer(theme.outline, [disc(radius)]), Layer(colour, [disc(radius - gauge.outline)])))
