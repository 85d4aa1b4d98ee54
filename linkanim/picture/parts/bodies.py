"""Bodies: rounded bars and plates, the pins on top of them, centres of mass."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.linkage.rigid_bodies import holding
from linkanim.picture.figure import Figure
from linkanim.picture.layout import Gauge
from linkanim.picture.parts.body_shapes import SHAPES, WHEELS
from linkanim.picture.parts.fittings import BARREL, PISTON, ROD, SLOT, SLOTTED, Bar, Bench, fittings
from linkanim.picture.parts.struts import piston
from linkanim.picture.raster.directions import directions
from linkanim.picture.raster.parts import Part, Stamp, glazed, lined, slotted
from linkanim.picture.raster.raster import Colour, Layer
from linkanim.picture.raster.shapes import disc, hull, unit
from linkanim.picture.theme import Theme
from linkanim.picture.view import View


def body_parts(figure: Figure, view: View, gauge: Gauge, theme: Theme) -> tuple[Part, ...]:
    """Return every body with its joints' fittings, back to front: plates, then bars, in the scene's order.

    Plates are clear enough to show what lies behind them: on a locomotive bars that come before its wheels.
    """
    colours = colours_of(figure, theme)
    shown = (body for body in figure.bodies if figure.scene.style(body.name).outline != "none")
    placed = {body: _local(body, figure, view) for body in shown}
    plates = [body for body, points in placed.items() if _is_wide(body, figure, points)]
    bars = [body for body in placed if body not in plates]
    on_rails = [n for n, body in enumerate(placed) if figure.scene.style(body.name).outline == "railwheel"]
    far = [body for body in list(placed)[: max(on_rails, default=0)] if body in bars]
    near = [body for body in bars if body not in far]
    bench = Bench(figure, view, gauge, theme)
    fitted = fittings(bench)
    behind = [part for fitting in fitted for part in fitting.behind]
    before = [part for fitting in fitted for part in fitting.before]
    worked = [fitting.bar for fitting in fitted if fitting.bar]
    solid = [_body(body, placed[body], worked, bench, colours[body.name]) for body in far + plates + near]
    return (*behind, *solid, *before)


def colours_of(figure: Figure, theme: Theme) -> dict[str, Colour]:
    """Return each body's colour: its own, or the theme's; the driven part's is the first of these.

    One without a name is metal.
    """
    drive = figure.linkage.drive.joint
    named = [body for body in figure.linkage.bodies if len(body.joints) > 1]
    crank = {drive, getattr(figure.linkage.joint(drive), "pivot", None)}
    first = sorted(named, key=lambda body: not crank <= {*body.joints})
    count, taken = len(theme.bodies), int(figure.linkage.joint(drive).travels)
    own = {body.name: figure.scene.style(body.name).colour for body in first}
    free = {body.name: theme.bodies[n % count] for n, body in enumerate(first, taken)}
    return {"": theme.metal} | {name: own[name] or colour for name, colour in free.items()}


def _local(body: Body, figure: Figure, view: View) -> list[complex]:
    """Return the body's joints in pixels, the first at 0 and the second on the positive real axis."""
    n = holding(figure.linkage.rigid_bodies, body.joints)
    assert n is not None
    places = [view.scale * figure.linkage.rigid_bodies[n][name].conjugate() for name in body.joints]
    turn = unit(places[1] - places[0])
    return [(place - places[0]) / turn for place in places]


def _is_wide(body: Body, figure: Figure, points: list[complex]) -> bool:
    """Whether a body may hide others, so that it lies behind them: a plate, or a wheel."""
    outline = figure.scene.style(body.name).outline
    return outline in ("plate", "bucket", *WHEELS) or (outline is None and len(hull(points)) > 2)


def _body(body: Body, points: list[complex], worked: list[Bar], bench: Bench, colour: Colour) -> Part:
    bar = next((bar for bar in worked if set(bar.ends) <= set(body.joints)), None)
    plate, gauge = _is_wide(body, bench.figure, points), bench.gauge
    style, colours = bench.figure.scene.style(body.name), (bench.theme.outline, colour)
    layers: list[Layer] = []
    if style.outline is not None and bar is None:
        radius = {"radius": style.radius * bench.view.scale} if style.radius else {}
        layers += SHAPES[style.outline](points, gauge, colours, **radius)
    elif plate or bar is None:
        layers += (glazed if plate else lined)(points, gauge.bar, gauge.outline, colours)
    if bar:
        ends = [points[body.joints.index(name)] for name in bar.ends]
        layers += _worked(bar, ends if plate else [*ends, *points], bench, colours)
    first, second = body.joints[:2]
    pinned = (*body.joints, *bench.figure.riding(body))
    return Part(first, first, second, tuple(layers), pinned, body.name or "-".join(body.joints))


def _worked(bar: Bar, points: list[complex], bench: Bench, colours: tuple[Colour, Colour]) -> list[Layer]:
    """Return a slotted bar, or a rod with an eye where it begins; its two ends are the first points."""
    gauge, (begin, end) = bench.gauge, points[:2]
    along, edge = unit(end - begin), gauge.outline
    if bar.slot:
        near, far = (begin + along * place for place in bar.slot)
        widths = SLOTTED * gauge.bar, SLOT * gauge.bar
        return slotted([*points, near, far], (near, far), widths, edge, colours)
    rod = lined(points, ROD * gauge.bar, edge, colours)
    eye = lined([begin], gauge.bar, edge, colours)
    layers = [Layer(one.colour, [*one.loops, *other.loops]) for one, other in zip(rod, eye, strict=True)]
    if bar.piston:
        head = piston(PISTON * gauge.bar, BARREL * gauge.bar, gauge, bench.theme)
        layers.append(head.placed(end, along))
    return layers


@lru_cache(maxsize=16)
def pin_stamp(gauge: Gauge, theme: Theme) -> Stamp:
    """Return a pin: a ring around an eye."""
    outer, inner = disc(gauge.pin + gauge.outline / 2), disc(gauge.pin - gauge.outline / 2)
    return Stamp((Layer(theme.outline, [outer]), Layer(theme.pin, [inner])))


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
