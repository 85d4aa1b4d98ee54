"""The vector loops as a figure: arrows from joint to joint, as SVG and for LaTeX."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from typing import NamedTuple

import numpy as np

from linkanim.explain.loops import LoopArrow
from linkanim.explain.notation import LATEX
from linkanim.explain.solution import Solution
from linkanim.picture.placing import Clutter, LabelPlaces, Solid, place
from linkanim.picture.text.text import Type, runs, subscripted
from linkanim.picture.view import Rect

_WIDE, _HIGH, _MARGIN = 640.0, 420.0, 42.0
_TEXT = 17
_COLOURS = ("0b5fa5", "b3470a", "1f7a3d", "8a2d8f", "6b5d00", "00707a", "a02040", "4a4ab0")
"""Of the loops in their order; an arrow has that of the first loop that it stands in."""


class _Label(NamedTuple):
    """A text by what it names: as plain text with its subscripts in braces, as LaTeX, and its middle."""

    text: str
    tex: str
    at: complex
    colour: str


class LoopDrawing(NamedTuple):
    """The arrows of a solution in a picture's pixels, y down; joints by name, and those that are fixed."""

    size: tuple[float, float]
    arrows: tuple[tuple[LoopArrow, str], ...]
    joints: dict[str, complex]
    fixed: frozenset[str]

    def labels(self) -> Iterator[_Label]:
        """Yield the symbols of the arrows and the names of the joints, each where it lies on nothing."""
        type_ = Type()
        texts = [(*_symbol(arrow), _beside(arrow.begin, arrow.end), colour) for arrow, colour in self.arrows]
        texts += [(subscripted(n), LATEX.name(n), _around(at), "1b1f23") for n, at in self.joints.items()]
        wanted = [
            LabelPlaces((type_.width(text, _TEXT), _TEXT), np.array([places]), np.arange(float(len(places))))
            for text, _, places, _ in texts
        ]
        ends = [np.array([[arrow.begin, arrow.end]]) for arrow, _ in self.arrows]
        dots = [Solid(np.array([[at]]), 5.0) for at in self.joints.values()]
        clutter = Clutter(Rect(0, 0, *self.size), solids=(*(Solid(end, 3.0) for end in ends), *dots))
        for (text, tex, places, colour), placed in zip(texts, place(wanted, clutter), strict=True):
            yield _Label(text, tex, places[placed.which], colour)


def _symbol(arrow: LoopArrow) -> tuple[str, str]:
    symbol = arrow.symbol
    return f"{symbol.letter}_{{{symbol.sub}}}", f"${LATEX.symbol(symbol)}$"


def _beside(begin: complex, end: complex) -> list[complex]:
    """Return places for an arrow's symbol: by its middle on either side, then along it and further off."""
    across = 1j * (end - begin) / (abs(end - begin) or 1.0)
    return [
        begin + share * (end - begin) + side * away * across
        for away in (16.0, 24.0, 34.0)
        for share in (0.5, 0.35, 0.65, 0.2, 0.8)
        for side in (1, -1)
    ]


def _around(at: complex) -> list[complex]:
    """Return places around a joint for its name."""
    turns = (-45, -135, 45, 135, 0, 180, -90, 90)
    return [at + away * np.exp(1j * np.radians(turn)) for away in (17.0, 24.0) for turn in turns]


def sketch(found: Solution) -> LoopDrawing:
    """Return the arrows of all loops, each once, as large as the picture has room."""
    arrows: dict[object, tuple[LoopArrow, str]] = {}
    for n, loop in enumerate(found.loops):
        for arrow in loop.arrows:
            arrows.setdefault(arrow.symbol, (arrow, _COLOURS[n % len(_COLOURS)]))
    ends = [end for arrow, _ in arrows.values() for end in (arrow.begin, arrow.end)]
    x, y = np.real(ends or [0]), np.imag(ends or [0])
    wide, high = max(float(np.ptp(x)), 1e-9), max(float(np.ptp(y)), 1e-9)
    scale = min((_WIDE - 2 * _MARGIN) / wide, (_HIGH - 2 * _MARGIN) / high)
    size = wide * scale + 2 * _MARGIN, high * scale + 2 * _MARGIN

    def pixel(at: complex) -> complex:
        return complex(_MARGIN + scale * (at.real - x.min()), _MARGIN + scale * (y.max() - at.imag))

    near = 1e-4 * max(wide, high)
    touched = {n: at for n, at in found.places.items() if any(abs(at - end) <= near for end in ends)}
    linkage = found.asked.scene.linkage
    return LoopDrawing(
        size,
        tuple((LoopArrow(a.symbol, pixel(a.begin), pixel(a.end)), colour) for a, colour in arrows.values()),
        {name: pixel(at) for name, at in touched.items()},
        frozenset(name for name in touched if linkage.joint(name).fixed),
    )


def svg(found: Solution) -> str:
    """Return the arrows of all loops as SVG; nothing of a linkage without a loop."""
    drawn = sketch(found)
    if not drawn.arrows:
        return ""
    head = f"viewBox='0 0 {drawn.size[0]:.0f} {drawn.size[1]:.0f}' width='{drawn.size[0]:.0f}'"
    parts = [_svg_arrow(arrow, colour) for arrow, colour in drawn.arrows]
    parts += [_svg_joint(at, fixed=name in drawn.fixed) for name, at in drawn.joints.items()]
    parts += [_svg_label(label) for label in drawn.labels()]
    head = f"xmlns='http://www.w3.org/2000/svg' role='img' aria-label='The vectors of the loops' {head}"
    return f"<svg {head}>{''.join(parts)}</svg>"


def _svg_arrow(arrow: LoopArrow, colour: str) -> str:
    way = arrow.end - arrow.begin
    u = way / abs(way) if way else 1.0
    foot = arrow.end - 12 * u
    corners = [arrow.end, foot + 4.5j * u, foot - 4.5j * u]
    points = " ".join(f"{c.real:.1f},{c.imag:.1f}" for c in corners)
    line = f"M{arrow.begin.real:.1f} {arrow.begin.imag:.1f}L{foot.real:.1f} {foot.imag:.1f}"
    drawn = f"<path d='{line}' stroke-width='2.2'/><polygon points='{points}'/>"
    return f"<g fill='#{colour}' stroke='#{colour}'>{drawn}</g>"


def _svg_joint(at: complex, *, fixed: bool) -> str:
    fill = "1b1f23" if fixed else "ffffff"
    where = f"cx='{at.real:.1f}' cy='{at.imag:.1f}'"
    return f"<circle {where} r='4' fill='#{fill}' stroke='#1b1f23' stroke-width='1.4'/>"


def _svg_label(label: _Label) -> str:
    spans, lowered = [], False
    for run in runs(label.text):
        shift = 4 * (run.lowered - lowered)
        size = " font-size='12'" if run.lowered else ""
        spans.append(f"<tspan dy='{shift}'{size}>{escape(run.text)}</tspan>")
        lowered = run.lowered
    at = f"x='{label.at.real:.1f}' y='{label.at.imag + 0.33 * _TEXT:.1f}' text-anchor='middle'"
    return f"<text {at} font-size='{_TEXT}' fill='#{label.colour}'>{''.join(spans)}</text>"


def tikz(found: Solution) -> str:
    """Return the arrows of all loops as a TikZ picture; nothing of a linkage without a loop."""
    drawn = sketch(found)
    if not drawn.arrows:
        return ""
    used = sorted({colour for _, colour in drawn.arrows} | {"1b1f23"})
    parts = [rf"\definecolor{{c{colour}}}{{HTML}}{{{colour.upper()}}}" for colour in used]
    parts.append(r"\begin{center}\begin{tikzpicture}[x=0.021cm,y=-0.021cm,>=latex]")
    parts += [
        rf"\draw[->,thick,c{colour}] {_tikz_at(arrow.begin)} -- {_tikz_at(arrow.end)};"
        for arrow, colour in drawn.arrows
    ]
    for name, at in drawn.joints.items():
        fill = "black" if name in drawn.fixed else "white"
        parts.append(rf"\draw[fill={fill}] {_tikz_at(at)} circle[radius=0.08cm];")
    parts += [rf"\node[c{label.colour}] at {_tikz_at(label.at)} {{{label.tex}}};" for label in drawn.labels()]
    return "\n".join((*parts, r"\end{tikzpicture}\end{center}"))


def _tikz_at(at: complex) -> str:
    return f"({at.real:.1f},{at.imag:.1f})"
