"""Draw bodies: rounded bars and plates, the pins on top of them, centres of mass.

`SHAPES` is the one table of bodies that say how they are drawn. The causal chain colours bodies by the step
in which their joints are solved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Body, holding
from linkanim.picture.figure import DrawContext, Figure
from linkanim.picture.fittings import BARREL, PISTON, ROD, SLOT, SLOTTED, Bar, fittings, piston
from linkanim.picture.layout import Gauge
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.shapes import (
    Part,
    Places,
    Stamp,
    directions,
    disc,
    glazed,
    hull,
    lined,
    segments,
    slotted,
    strokes,
    unit,
)
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import View

# How bodies that state a look are drawn: bars, plates, wheels, slotted bars, hooks. `SHAPES` is the one
# table.
#
# Each is drawn about its first joint at 0, its second on the positive real axis, y down.

Colours = tuple[Colour, Colour]
"""Of an edge and of what it encloses."""

_BROAD = 1.5
"""Half the width of a plate of two joints, in half widths of a bar."""
_CLEAR = 1.2
"""How far from the joints a slot ends, in half widths of a bar."""
_HOOK, _BENT = 2.6, 4.2
"""A hook's radius at most, in half widths of a bar, and its bend in radians."""
ROUND = 1.0
"""How far a wheel extends beyond its furthest joint, in half widths of a bar."""
_PAD = (3.6, 2.2)
"""A pad's width between its round ends and how far from its bar's middle it lies, in half widths of a bar."""
_BACK, _TOOTH = 0.2, 2.6
"""How far a bucket's back bends out, in its lengths, and how long its tooth is, in half widths of a bar."""
WHEELS = ("wheel", "railwheel")
"""The looks of bodies that are wheels about their first joint."""
ENDED = ("hook", "pad", "bucket")
"""The looks of bodies that are wider than a bar around their last joint."""
RIM, _GLASS = 0.8, 0.35
"""The width of a wheel's rim in half widths of a bar, and the opacity of its disc."""


def _bar(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bar that runs through the joints in their order, bent where they are not in line."""
    return _drawn(np.array(points), gauge, colours)


def _plate(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    return glazed(points, (_BROAD if len(points) == 2 else 1.0) * gauge.bar, gauge.outline, colours)


def _wheel(points: list[complex], gauge: Gauge, colours: Colours, radius: float = 0.0) -> list[Layer]:
    """Return a wheel out to the furthest joint or further; a spoke to the second shows its turning."""
    (edge, fill), radius = colours, max(radius, wheel_radius(points, gauge))
    rim, line = RIM * gauge.bar, gauge.outline
    ring = [disc(radius - line), disc(radius - rim)[::-1]]
    edges = [disc(radius), disc(radius - line)[::-1], disc(radius - rim), disc(radius - rim - line)[::-1]]
    spoke = lined(points[:2], gauge.bar, line, colours)
    return [Layer(fill, [disc(radius - rim)], _GLASS), Layer(fill, ring), Layer(edge, edges), *spoke]


def wheel_radius(points: list[complex], gauge: Gauge) -> float:
    """Return a wheel's radius: it reaches round the furthest of its joints."""
    return max(map(abs, points)) + ROUND * gauge.bar


def _slot(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    begin, end = points[:2]
    along = unit(end - begin) * min(_CLEAR * gauge.bar, abs(end - begin) / 2)
    widths = SLOTTED * gauge.bar, SLOT * gauge.bar
    return slotted(points, (begin + along, end - along), widths, gauge.outline, colours)


def _hook(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bar that bends round to a hook, in whose bowl the last joint would hang."""
    *_, before, end = points
    along, radius = unit(end - before), min(_HOOK * gauge.bar, 0.3 * abs(end - before))
    middle = end - along * radius
    bend = middle - along * radius * np.exp(-1j * np.linspace(0.0, _BENT, 24))
    return _drawn(np.concatenate([points[:-1], bend]), gauge, colours)


def _pad(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bar through the joints with a pad at the last, on the side to which it bends."""
    *_, before, end = points
    along = unit(end - before)
    side = -1 if ((points[0] - end) / along).imag < 0 else 1
    (wide, deep), bar, down = _PAD, gauge.bar, 1j * along * side
    foot, high = end + down * deep * bar, 1.2 * bar
    sole = [foot + along * sign * 0.5 * wide * bar for sign in (-1, 1)]
    stem = lined([end, foot], 0.5 * bar, gauge.outline, colours)
    pad = lined(sole, high / 2, gauge.outline, colours)
    return [*stem, *pad, *_drawn(np.array(points), gauge, colours)]


def _bucket(points: list[complex], gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bucket about the joints: its back bends away from the first one to its edge at the last."""
    if len(points) < 3:
        return _plate(points, gauge, colours)
    first, *_, before, end = points
    along, share = end - before, np.linspace(0.0, 1.0, 12)
    out = 1j * along * (1 if ((first - before) / along).imag < 0 else -1)
    back = before + along * share + out * _BACK * 4 * share * (1 - share)
    tip = unit(along - 4 * _BACK * out) * gauge.bar
    tooth = end + tip * np.array([_TOOTH, -0.5 + 0.9j, -0.5 - 0.9j])
    shell = glazed([*points, *back.tolist()], gauge.bar, gauge.outline, colours)
    return [Layer(colours[0], [tooth]), *shell]


def _drawn(path: np.ndarray, gauge: Gauge, colours: Colours) -> list[Layer]:
    """Return a bar along a path, its edge inside its width."""
    widths = 2 * gauge.bar, max(2 * gauge.bar - 2 * gauge.outline, 0.2)
    return [Layer(*layer) for layer in zip(colours, strokes(path, widths), strict=True)]


SHAPES: Mapping[str, Callable[..., list[Layer]]] = {
    "bar": _bar,
    "plate": _plate,
    "wheel": _wheel,
    "railwheel": _wheel,
    "slot": _slot,
    "hook": _hook,
    "pad": _pad,
    "bucket": _bucket,
    "none": lambda *_: [],
}
"""How a body is drawn, by the `look` that it states."""
BEYOND = ("bucket", "hook", "pad")
"""The looks that extend beyond the body's joints."""


# Bodies: rounded bars and plates, the pins on top of them, centres of mass.


def body_parts(context: DrawContext, places: Places | None = None) -> tuple[Part, ...]:
    """Return every body with its joints' fittings, back to front: plates, then bars, in the scene's order.

    With `places` in pixels a body has the shape that these give it, else its own.

    Plates are translucent enough to show what lies behind them, as on a locomotive with bars behind wheels.
    """
    figure, view, _, theme = context.known
    colours = colours_of(figure, theme)
    shown = (body for body in figure.bodies if figure.scene.style(body.name).outline != "none")
    placed = {body: _local(_rigid(body, figure, view, places)) for body in shown}
    plates = [body for body, points in placed.items() if _is_wide(body, figure, points)]
    bars = [body for body in placed if body not in plates]
    on_rails = [n for n, body in enumerate(placed) if figure.scene.style(body.name).outline == "railwheel"]
    far = [body for body in list(placed)[: max(on_rails, default=0)] if body in bars]
    near = [body for body in bars if body not in far]
    fitted = fittings(context)
    behind = [part for fitting in fitted for part in fitting.behind]
    before = [part for fitting in fitted for part in fitting.before]
    worked = [fitting.bar for fitting in fitted if fitting.bar]
    solid = [_body(body, placed[body], worked, context, colours[body.name]) for body in far + plates + near]
    return (*behind, *solid, *before)


def colours_of(figure: Figure, theme: Theme) -> dict[str, Colour]:
    """Return each body's colour: its own, or the theme's; the driven body has the theme's first.

    A body without a name is metal.
    """
    drive = figure.linkage.drive.joint
    named = [body for body in figure.linkage.bodies if len(body.joints) > 1]
    crank = {drive, figure.linkage.driven.pivot}
    first = sorted(named, key=lambda body: not crank <= {*body.joints})
    count, taken = len(theme.bodies), int(figure.linkage.joint(drive).travels)
    own = {body.name: figure.scene.style(body.name).colour for body in first}
    free = {body.name: theme.bodies[n % count] for n, body in enumerate(first, taken)}
    return {"": theme.metal} | {name: own[name] or colour for name, colour in free.items()}


def _rigid(body: Body, figure: Figure, view: View, places: Places | None) -> list[complex]:
    """Return the body's joints in pixels: at `places`, else somewhere in their own shape."""
    if places is not None:
        return [places[name] for name in body.joints]
    n = holding(figure.linkage.rigid_bodies, body.joints)
    assert n is not None
    return [view.scale * figure.linkage.rigid_bodies[n][name].conjugate() for name in body.joints]


def _local(places: list[complex]) -> list[complex]:
    """Return a body's joints in pixels, the first at 0 and the second on the positive real axis."""
    turn = unit(places[1] - places[0])
    return [(place - places[0]) / turn for place in places]


def _is_wide(body: Body, figure: Figure, points: list[complex]) -> bool:
    """Return whether a body may hide others, so that it lies behind them: a plate, or a wheel."""
    outline = figure.scene.style(body.name).outline
    return outline in ("plate", "bucket", *WHEELS) or (outline is None and len(hull(points)) > 2)


def _body(body: Body, points: list[complex], worked: list[Bar], context: DrawContext, colour: Colour) -> Part:
    bar = next((bar for bar in worked if set(bar.ends) <= set(body.joints)), None)
    plate, gauge = _is_wide(body, context.figure, points), context.gauge
    style, colours = context.figure.scene.style(body.name), (context.theme.outline, colour)
    layers: list[Layer] = []
    if style.outline is not None and bar is None:
        radius = {"radius": style.radius * context.view.scale} if style.radius else {}
        layers += SHAPES[style.outline](points, gauge, colours, **radius)
    elif plate or bar is None:
        layers += (glazed if plate else lined)(points, gauge.bar, gauge.outline, colours)
    if bar:
        ends = [points[body.joints.index(name)] for name in bar.ends]
        layers += _worked(bar, ends if plate else [*ends, *points], context, colours)
    first, second = body.joints[:2]
    pinned = (*body.joints, *context.figure.riding(body))
    part = Part(first, first, second, tuple(layers), pinned, body.name or "-".join(body.joints))
    part = replace(part, reaches=bar.reaches) if bar else part
    return (
        _lit(part, points if len(hull(points)) == 2 and not bar else [], gauge, colour)
        if context.theme.lit
        else part
    )


# The material of bodies: a soft shadow on what is below, a highlight along the upper edge of a bar.

SHADOW, _DARK = 0.18 + 0.42j, 0.15
"""How far a shadow lies off, in half widths of a bar, and how dark it is."""
_SHINE, _HAIR = 0.5, 0.9
"""The share of white in a highlight, and its width in widths of a thin line."""
_BLACK, _WHITE = (0, 0, 0), (255, 255, 255)


def _lit(part: Part, axis: list[complex], gauge: Gauge, colour: Colour) -> Part:
    """Return a part with its shadow, and with highlights beside its axis where it is a bar."""
    if not part.layers:
        return part
    first = part.layers[0]
    # a plate that lets one see through it throws none: that would darken the plate itself
    shadow = (gauge.bar * SHADOW, Layer(_BLACK, first.loops, _DARK)) if first.alpha == 1 else None
    edges = []
    if axis:
        begin, end = min(axis, key=np.real), max(axis, key=np.real)
        aside = gauge.bar - gauge.outline - _HAIR * gauge.line
        for facing in (1j, -1j):
            line = segments(begin + aside * facing, end + aside * facing, _HAIR * gauge.line)
            edges.append((facing, Layer(mixed(colour, _WHITE, _SHINE), line)))
    return replace(part, shadow=shadow, edges=tuple(edges))


def _worked(bar: Bar, points: list[complex], context: DrawContext, colours: Colours) -> list[Layer]:
    """Return a slotted bar, or a rod with an eye where it begins; its two ends are the first points."""
    gauge, (begin, end) = context.gauge, points[:2]
    along, edge = unit(end - begin), gauge.outline
    if bar.slot:
        near, far = (begin + along * place for place in bar.slot)
        widths = SLOTTED * gauge.bar, SLOT * gauge.bar
        return slotted([*points, near, far], (near, far), widths, edge, colours)
    rod = lined(points, ROD * gauge.bar, edge, colours)
    eye = lined([begin], gauge.bar, edge, colours)
    layers = [Layer(one.colour, [*one.loops, *other.loops]) for one, other in zip(rod, eye, strict=True)]
    if bar.piston:
        head = piston(PISTON * gauge.bar, BARREL * gauge.bar, gauge, context.theme)
        layers.append(head.placed(end, along))
    return layers


@lru_cache(maxsize=16)
def pin_stamp(gauge: Gauge, theme: Theme) -> Stamp:
    """Return a pin: a ring around an eye."""
    outer, inner = disc(gauge.pin + gauge.outline / 2), disc(gauge.pin - gauge.outline / 2)
    ring = Layer(theme.outline, [outer])
    if not theme.lit:
        return Stamp((ring, Layer(theme.pin, [inner])))
    turned = -0.18 * gauge.pin * (1 + 1j) + disc(0.55 * (gauge.pin - gauge.outline / 2))
    return Stamp((ring, Layer(mixed(theme.metal, theme.pin, 0.45), [inner]), Layer(theme.pin, [turned])))


@lru_cache(maxsize=16)
def mass_stamp(gauge: Gauge, theme: Theme) -> Stamp:
    """Return the sign of a centre of mass: a disc with two of its quarters light."""
    radius = 0.48 * gauge.bar
    quarter = np.concatenate(([0j], radius * directions(np.linspace(0, np.pi / 2, 9))))
    outer = Layer(theme.outline, [disc(radius + gauge.outline)])
    return Stamp((outer, Layer(theme.pin, [quarter, -quarter])))


@lru_cache(maxsize=16)
def mark_stamp(colour: Colour, gauge: Gauge, theme: Theme) -> Stamp:
    """Return the mark of a joint that is traced, in its curve's colour."""
    radius = 0.62 * gauge.bar
    return Stamp((Layer(theme.outline, [disc(radius)]), Layer(colour, [disc(radius - gauge.outline)])))


# The causal chain in colour: the input's colour fades with each step in which joints are solved.

_FADED = 0.8
"""The share of the background in the colour of the last step."""


@frozen
class CausalChain:
    """Each joint's step in the order of solving, 0 on the ground, and the colours that stand for the steps.

    The colours are one hue that fades towards the background, so that no hues need to be told apart.
    """

    steps: Mapping[str, int]
    theme: Theme

    @property
    def last(self) -> int:
        """The last step."""
        return max(self.steps.values(), default=1)

    @property
    def colours(self) -> tuple[Colour, ...]:
        """The colour of each step, the input's first."""
        return tuple(self._colour(step) for step in range(1, self.last + 1))

    def pins(self, gauge: Gauge) -> dict[str, Stamp]:
        """Return the joints' pins, with eyes in the colour of their step; pins of the ground as usual."""
        eyes = [self.theme.pin, *self.colours]
        stamps = [pin_stamp(gauge, replace(self.theme, pin=eye)) for eye in eyes]
        return {name: stamps[step] for name, step in self.steps.items()}

    def coloured(self, parts: tuple[Part, ...], figure: Figure) -> Iterator[Part]:
        """Yield bodies and fittings in a colour midway between those of the joints by which they move."""
        usual = colours_of(figure, self.theme)
        for part in parts:
            own = {usual.get(part.name, self.theme.metal), self.theme.metal}
            shade = self._between({part.at, part.tail, part.head, *part.joints})
            layers = (
                Layer(shade, loops, alpha) if colour in own else Layer(colour, loops, alpha)
                for colour, loops, alpha in part.layers
            )
            yield replace(part, layers=tuple(layers))

    def _between(self, joints: set[str]) -> Colour:
        """Return the colour half way from the first step of some joints to the last; metal on the ground."""
        steps = [self.steps[name] for name in joints if self.steps[name]]
        return self._colour((min(steps) + max(steps)) / 2) if steps else self.theme.metal

    def _colour(self, step: float) -> Colour:
        share = (step - 1) / max(self.last - 1, 1)
        return mixed(self.theme.bodies[0], self.theme.background, _FADED * share)
