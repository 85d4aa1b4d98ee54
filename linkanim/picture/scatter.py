"""A picture of labelled points on logarithmic axes, such as speed against error."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from typing import NamedTuple

import pygame

from linkanim.picture.axis import decades
from linkanim.picture.chart import Pen, Plot, axes, pen_for, plot_area, point_layers
from linkanim.picture.items import draw
from linkanim.picture.layout import layout
from linkanim.picture.raster import Colour, paint
from linkanim.picture.text import Type
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect


class Dot(NamedTuple):
    """A labelled point, both values positive; `ours` sets it off from the others."""

    label: str
    x: float
    y: float
    ours: bool = False


class ScatterTitles(NamedTuple):
    """What the picture, its horizontal and its vertical axis are called."""

    title: str
    x: str
    y: str


def scatter(
    points: Sequence[Dot],
    names: ScatterTitles,
    *,
    size: tuple[int, int] = (1280, 720),
    theme: str = "light",
) -> pygame.Surface:
    """Return the picture: log-log, its axes over whole decades, labels beside the points.

    ValueError where there are no points, or one that is not positive and finite.
    """
    if not points or not all(0 < value < inf for point in points for value in (point.x, point.y)):
        raise ValueError("a log-log picture needs points that are positive and finite")
    surface = pygame.Surface(size, 0, 32)
    colours = theme_of(theme)
    surface.fill(colours.background)
    pen = pen_for(layout(size), Type(), colours)
    plot = _plot(points, size, pen)
    draw(surface, axes(plot, pen), pen.type)
    _draw_names(surface, plot, names, pen)
    for ours, colour in ((False, colours.velocity), (True, colours.acceleration)):
        paint(surface, point_layers(plot, [(p.x, p.y) for p in points if p.ours is ours], colour, pen))
    taken = [_dot(plot, point, pen) for point in points]
    for point in sorted(points, key=lambda point: not point.ours):
        taken.append(_label(surface, plot, point, pen, taken))
    return surface


def _plot(points: Sequence[Dot], size: tuple[int, int], pen: Pen) -> Plot:
    """Return the axes over all points and the area they leave."""
    x, y = (decades(min(values), max(values)) for values in zip(*((p.x, p.y) for p in points), strict=True))
    whole = Rect(0, 0, *size).inset(20 * pen.line / 1.8)
    area = Rect(whole.x, whole.y + 1.6 * pen.text, whole.width, whole.height - 3.2 * pen.text)
    return Plot(plot_area(area, y, pen), x, y)


def _draw_names(surface: pygame.Surface, plot: Plot, names: ScatterTitles, pen: Pen) -> None:
    """Draw the title, the vertical axis' name under it, and the horizontal one's below the ticks."""
    area, draw = plot.area, pen.type.draw
    draw(surface, names.title, (area.x, area.y - 3.0 * pen.text), size=pen.text, colour=pen.theme.ink)
    draw(surface, names.y, (area.x, area.y - 1.4 * pen.text), size=pen.small, colour=pen.theme.dim)
    at = (area.right, area.bottom + 1.8 * pen.small)
    draw(surface, names.x, at, size=pen.small, colour=pen.theme.dim, anchor="right")


def _dot(plot: Plot, point: Dot, pen: Pen) -> pygame.Rect:
    place, radius = complex(plot.place(point.x, point.y)), 3.6 * pen.line
    side = round(2 * radius)
    return pygame.Rect(round(place.real - radius), round(place.imag - radius), side, side)


def _label(
    surface: pygame.Surface, plot: Plot, point: Dot, pen: Pen, taken: list[pygame.Rect]
) -> pygame.Rect:
    """Draw a point's name where it meets no point and no other name; return what it takes up."""
    place = complex(plot.place(point.x, point.y))
    wide, high, off = pen.type.width(point.label, pen.small), pen.small, 5.0 * pen.line
    spots = [
        (place.real + off, place.imag - high / 2),
        (place.real - off - wide, place.imag - high / 2),
        *((place.real - wide / 2, place.imag + side) for side in (-off - high, off)),
        *((place.real + off, place.imag + row * high) for row in (0.6, -1.6, 1.7, -2.7)),
    ]
    inside = pygame.Rect(0, 0, *surface.get_size())
    boxes = [pygame.Rect(round(x), round(y), wide, high) for x, y in spots]
    free = [box for box in boxes if inside.contains(box) and box.collidelist(taken) < 0]
    box = (free or boxes)[0]
    colour: Colour = pen.theme.ink if point.ours else pen.theme.dim
    pen.type.draw(surface, point.label, box.topleft, size=pen.small, colour=colour)
    return box
