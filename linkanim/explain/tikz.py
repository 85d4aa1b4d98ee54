"""Figures in TikZ: the vectors of a solution's loops, and its bodies free."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from linkanim.explain.forces import FreeBody, symbol_of
from linkanim.explain.formula import LATEX, plain_latex
from linkanim.explain.solution import Solution

_WIDE, _HIGH = 13.0, 9.0
"""The picture's greatest width and height in centimetres."""
_NEAR = 0.02
"""The distance from a vector's end, in centimetres, below which a joint is that end."""


def tikz(solution: Solution) -> str:
    """Return the vectors of all loops with their names, and their joints with theirs; "" without a loop."""
    return "\n".join(_lines(solution)) if solution.arrows else ""


def _lines(solution: Solution) -> Iterator[str]:
    ends = np.array([*solution.arrows.values()])
    scale = min(_WIDE / max(float(np.ptp(ends.real)), 1e-9), _HIGH / max(float(np.ptp(ends.imag)), 1e-9))
    yield r"\begin{center}\begin{tikzpicture}[>=latex]"
    for symbol, ways in solution.arrows.items():
        begin, end = (_at(scale * place) for place in ways)
        yield rf"\draw[->,thick] {begin} -- node[auto,blue] {{${LATEX.symbol(symbol)}$}} {end};"
    for name, at in solution.places.items():
        if np.abs(ends - at).min() * scale < _NEAR:
            fill = "black" if solution.request.scene.linkage.joint(name).fixed else "white"
            label = f"node[below right] {{{LATEX.name(name)}}}"
            yield rf"\draw[fill={fill}] {_at(scale * at)} circle[radius=2pt] {label};"
    yield r"\end{tikzpicture}\end{center}"


_BODY, _FORCE = 2.4, 1.5
"""The size of the largest free body and the length of the greatest force on each, in centimetres."""
_OFF = 0.3
"""The distance of a name from its joint or its arrow's head, in centimetres."""
_PULL, _COUPLE = "magenta!80!black", "brown"
_BAR = "line width=6pt,line join=round,line cap=round,gray!35"


def free_tikz(solution: Solution) -> str:
    """Return the bodies free, one beside the other, and of three forces their triangle; "" for none."""
    scale = _BODY / max(solution.spread, 1e-12)
    bodies = [picture for body in solution.bodies for picture in _free_body(solution, body, scale)]
    return "\n".join((r"\begin{center}", *bodies, r"\end{center}")) if bodies else ""


def _free_body(solution: Solution, body: FreeBody, scale: float) -> Iterator[str]:
    places = {name: scale * at for name, at in solution.joints_of(body).items()}
    arrows = [(name, scale * foot, scale * foot + _FORCE * way) for name, foot, way in body.pulls()]
    corners, middle = [*places.values()], sum(places.values()) / len(places)
    lines = [*_outline(corners), *_couples(body, middle)]
    for name, at in places.items():
        ways = [end - at for end in corners] + [head - foot for _, foot, head in arrows if foot == at]
        lines += [rf"\draw[fill=white] {_at(at)} circle[radius=2pt];"]
        lines += [_node(at + _OFF * _clear_way(ways), LATEX.name(name), "black")]
    for name, foot, head in arrows:
        lines += [_arrow(foot, head), _node(head + _beyond(head - foot), _name(name), _PULL)]
    title = plain_latex(solution.body_title(body))
    lines.append(rf"\node[above,font=\bfseries] at (current bounding box.north) {{{title}}};")
    yield _picture(lines)
    if sides := body.triangle():
        size = _BODY / max(abs(end - begin) for _, begin, end in sides)
        centre = sum(begin for _, begin, _ in sides) / 3
        lines = [_arrow(size * begin, size * end) for _, begin, end in sides]
        for name, begin, end in sides:
            half, across = (begin + end) / 2, 1j * (end - begin)
            out = across if (across.conjugate() * (half - centre)).real >= 0 else -across
            lines.append(_node(size * half + 1.2 * _beyond(out), _name(name), _PULL))
        yield _picture(lines)


def _outline(corners: list[complex]) -> Iterator[str]:
    """Yield a block, a bar, or a plate with its corners in the order of their joints."""
    path = " -- ".join(map(_at, corners))
    if len(corners) == 1:
        yield rf"\node[draw=gray,fill=gray!20,minimum width=9mm,minimum height=6mm] at {path} {{}};"
    elif len(corners) == 2:
        yield rf"\draw[{_BAR}] {path};"
    else:
        yield rf"\draw[{_BAR},fill] {path} -- cycle;"


def _couples(body: FreeBody, middle: complex) -> Iterator[str]:
    """Yield the couples as bent arrows about the body's middle."""
    for n, (name, value) in enumerate(body.turning()):
        radius, way = 0.45 + 0.2 * n, "->" if value > 0 else "<-"
        begin = middle + radius * np.exp(1j * np.radians(-40))
        bow = f"arc[start angle=-40,end angle=160,radius={radius:g}]"
        yield rf"\draw[{way},thick,{_COUPLE}] {_at(begin)} {bow};"
        beside = middle + (radius + _OFF) * np.exp(1j * np.radians(60 + 50 * n))
        yield _node(beside, _name(name), _COUPLE)


def _arrow(foot: complex, head: complex) -> str:
    return rf"\draw[->,thick,{_PULL}] {_at(foot)} -- {_at(head)};"


def _node(at: complex, words: str, colour: str) -> str:
    return rf"\node[inner sep=0pt,{colour}] at {_at(at)} {{{words}}};"


def _name(name: str) -> str:
    return f"${LATEX.symbol(symbol_of(name))}$"


def _beyond(way: complex) -> complex:
    """Return how far a name stands off in a direction."""
    return 1.2 * _OFF * way / abs(way) if way else 0j


def _clear_way(ways: list[complex]) -> complex:
    """Return the direction that is farthest from those of a joint's bars and arrows."""
    tried = np.exp(1j * np.radians(np.arange(45, 405, 30)))
    taken = np.array([way / abs(way) for way in ways if way] or [-1j])
    nearest = (tried[:, None] * taken.conj()).real.max(axis=1)
    return complex(tried[int(nearest.argmin())])


def _picture(lines: list[str]) -> str:
    how = "[>=latex,baseline=(current bounding box.center)]"
    return "\n".join((rf"\begin{{tikzpicture}}{how}", *lines, r"\end{tikzpicture}\quad"))


def _at(place: complex) -> str:
    return f"({place.real:.2f},{place.imag:.2f})"
