"""The vectors of a solution's loops as a TikZ picture."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkanim.explain.notation import LATEX
from linkanim.explain.solution import Solution

_WIDE, _HIGH = 13.0, 9.0
"""The picture's greatest width and height in centimetres."""
_NEAR = 0.02
"""A joint that is nearer to the end of a vector, in centimetres, is one of its ends."""


def tikz(found: Solution) -> str:
    """Return the vectors of all loops with their names and their joints'; nothing where there are none."""
    return "\n".join(_lines(found)) if found.loops else ""


def _lines(found: Solution) -> Iterator[str]:
    ends = np.array([(one.begin, one.end) for one in found.arrows])
    scale = min(_WIDE / max(float(np.ptp(ends.real)), 1e-9), _HIGH / max(float(np.ptp(ends.imag)), 1e-9))
    yield r"\begin{center}\begin{tikzpicture}[>=latex]"
    for one in found.arrows:
        begin, end, name = _at(scale * one.begin), _at(scale * one.end), LATEX.symbol(one.symbol)
        yield rf"\draw[->,thick] {begin} -- node[auto,blue] {{${name}$}} {end};"
    for name, at in found.places.items():
        if np.abs(ends - at).min() * scale < _NEAR:
            fill = "black" if found.request.scene.linkage.joint(name).fixed else "white"
            label = f"node[below right] {{{LATEX.name(name)}}}"
            yield rf"\draw[fill={fill}] {_at(scale * at)} circle[radius=2pt] {label};"
    yield r"\end{tikzpicture}\end{center}"


def _at(place: complex) -> str:
    return f"({place.real:.2f},{place.imag:.2f})"
