"""Items as SVG: filled paths, and text in a face of which the document carries the letters that it uses.

A program that shows it in another face sets each line as wide as ours, so that nothing leaves the picture.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import count, pairwise
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from linkanim.paper.lettering import FAMILY, FURTHER, WEIGHTS, rules, width
from linkanim.picture.items import Caption, Group, Item, clipped
from linkanim.picture.raster import Colour, Layer, Loop
from linkanim.picture.text import SEMIBOLD, runs, typesetting

FACES = f"'{FAMILY}', '{FURTHER}', 'Source Sans 3', 'Helvetica Neue', Arial, sans-serif"
RIMMED = ' stroke-linejoin="round" paint-order="stroke"'
"""How the rims of words are drawn: round, and below their letters."""
_ANCHORS = {"left": "start", "centre": "middle", "right": "end"}
_SUBSCRIPT_RIM = 0.05
"""The width of a subscript's rim at most, as a share of an em: less than what is between two letters."""

Paint = Callable[[Colour], str]


def svg(
    size: tuple[int, int],
    background: Colour | None,
    items: Iterable[Item | Group],
    *,
    title: str,
    words: str = "",
    wide: float | None = None,
    indices: Mapping[str, str] | None = None,
) -> str:
    """Return a picture, `size` in pixels, as an SVG document; None leaves the background open.

    It is `wide` mm wide; without that, its size is in pixels.
    Its title, and the words that say what is seen in it, are read aloud. A group is a `<g>` whose id is its
    name, numbered where a group before has it; it has the `indices` of its name, of the symbols that are of
    it, as `data-i`.
    """
    width, height = size
    body = [f"<title>{escape(title)}</title>", *([f"<desc>{escape(words)}</desc>"] if words else [])]
    if background is not None:
        body.append(f'<rect width="{width}" height="{height}" fill="{hexadecimal(background)}"/>')
    ids: set[str] = set()
    items = [*items]
    if letters := rules(item for item in flat(items) if isinstance(item, Caption)):
        body.append(f"<style>{letters}</style>")
    for item in items:
        if not isinstance(item, Group):
            body += drawn([item])
        elif inside := drawn(flat([item])):
            own = (indices or {}).get(item.name)
            of = f" data-i={quoteattr(own)}" if own else ""
            body += [f"<g id={quoteattr(_unused(item.name, ids))}{of}>", *inside, "</g>"]
    across, down = (f"{width}", f"{height}")
    if wide:
        across, down = f"{wide:g}mm", f"{wide * height / width:.2f}mm"
    head = f'width="{across}" height="{down}" viewBox="0 0 {width} {height}" font-family={quoteattr(FACES)}'
    lines = "\n".join(body)
    return f'<svg xmlns="http://www.w3.org/2000/svg" {head}>\n{lines}\n</svg>\n'


def flat(items: Iterable[Item | Group]) -> Iterator[Item]:
    """Yield the items of groups, clipped as the groups say."""
    for item in items:
        if isinstance(item, Group):
            yield from clipped(item)
            yield from item.named
        else:
            yield item


def hexadecimal(colour: Colour) -> str:
    """Return a colour as #rrggbb."""
    return "#" + "".join(f"{part:02x}" for part in colour)


def drawn(items: Iterable[Item], paint: Paint = hexadecimal, *, fixed: bool = True) -> list[str]:
    """Return the elements of items, colours as `paint` writes them; `fixed` words are as wide in any face."""
    shown = (item for item in items if (item.loops if isinstance(item, Layer) else item.text))
    return [
        _path(item, paint) if isinstance(item, Layer) else _text(item, paint, fixed=fixed) for item in shown
    ]


def _unused(name: str, ids: set[str]) -> str:
    """Return a name as an id that is not in `ids`, and add it to them."""
    word = "_".join(name.split())
    choices = (word if n == 1 else f"{word}-{n}" for n in count(1))
    unused = next(choice for choice in choices if choice not in ids)
    ids.add(unused)
    return unused


def _path(layer: Layer, paint: Paint) -> str:
    opacity = f' fill-opacity="{layer.alpha:.3g}"' if layer.alpha < 1 else ""
    return f'<path fill="{paint(layer.colour)}"{opacity} d="{"".join(map(_closed, layer.loops))}"/>'


def _closed(loop: Loop) -> str:
    """Return a closed loop as path data, to hundredths of a pixel, without points that coincide there."""
    points = np.round(loop, 2)
    points = points[np.r_[True, np.diff(points) != 0]]
    return "M" + "L".join(f"{point.real:g} {point.imag:g}" for point in points.tolist()) + "Z"


def _text(line: Caption, paint: Paint, *, fixed: bool) -> str:
    how = typesetting(line.size)
    weight = f' font-weight="{WEIGHTS[SEMIBOLD]}"' if line.strong else ""
    at = f'x="{line.at[0]:.2f}" y="{line.at[1] + how.baseline:.2f}" font-size="{how.em:.2f}"'
    anchor = f'text-anchor="{_ANCHORS[line.anchor]}" fill="{paint(line.colour)}"'
    of = f" data-of={quoteattr(line.of)}" if line.of else ""
    wide = width(line) if fixed else None
    room = f' textLength="{wide:.2f}" lengthAdjust="spacingAndGlyphs"' if wide else ""
    return f"<text{of} {at} {anchor}{weight}{room}{_rim(line, paint)}>{''.join(_spans(line))}</text>"


def _rim(line: Caption, paint: Paint) -> str:
    if line.halo is None:
        return ""
    rim = f'stroke="{paint(line.halo.colour)}" stroke-width="{2 * line.halo.width:.2f}"'
    return f" {rim}{RIMMED}"


def _lowered(line: Caption) -> str:
    """Return the attributes of a subscript; its rim is thin, or it would cover the letter before it."""
    how = typesetting(line.size)
    size = f' font-size="{how.small:.2f}"'
    if line.halo is None:
        return size
    return f'{size} stroke-width="{2 * min(line.halo.width, _SUBSCRIPT_RIM * how.em):.2f}"'


def _spans(line: Caption) -> Iterator[str]:
    """Yield a line's runs, subscripts smaller and lower."""
    how, lowered = typesetting(line.size), False
    for run in runs(line.text):
        if not run.lowered and not lowered:
            yield escape(run.text)
            continue
        shift = (run.lowered - lowered) * how.lower
        small = _lowered(line) if run.lowered else ""
        yield f'<tspan dy="{shift:.2f}"{small}>{escape(run.text)}</tspan>'
        lowered = run.lowered


# Outlines by steps.

_PATHS, _LOOP = re.compile(r' d="M[^"]*"'), re.compile("M([^MZ]*)Z")
_NEEDLESS = re.compile(r" (?=-)|(?<=\.\d) (?=\.)|(?<=\.\d\d) (?=\.)")
"""The blanks before a minus, and before a point where the number before it has one."""
_UNSEEN = 0.02
"""How far off an outline may be that goes by steps, in pixels."""


def in_steps(markup: str) -> str:
    """Return SVG whose outlines go from point to point by steps: in half the characters, for a page."""
    return _PATHS.sub(lambda path: _LOOP.sub(_stepwise, path[0]), markup)


def _stepwise(loop: re.Match[str]) -> str:
    points = _thinned([complex(*map(float, point.split())) for point in loop[1].split("L")])
    ways = (to - one for one, to in pairwise(points))
    short = " ".join(_number(part) for way in ways for part in (way.real, way.imag))
    short = _NEEDLESS.sub("", short)
    return f"M{points[0].real:g} {points[0].imag:g}" + (f"l{short}Z" if short else "Z")


def _thinned(points: Sequence[complex]) -> list[complex]:
    """Return a line without the points that lie on it but for `_UNSEEN` (Ramer, 1972)."""
    begin, end, inner = points[0], points[-1], points[1:-1]
    if not inner:
        return list(points)
    way = end - begin
    shares = ((point - begin) / way if way else 0j for point in inner)
    feet = (begin + way * min(max(share.real, 0.0), 1.0) for share in shares)
    offs = [abs(point - foot) for point, foot in zip(inner, feet, strict=True)]
    far = 1 + offs.index(max(offs))
    if offs[far - 1] <= _UNSEEN:
        return [begin, end]
    return [*_thinned(points[: far + 1])[:-1], *_thinned(points[far:])]


def _number(step: float) -> str:
    text = f"{round(step, 2) + 0.0:g}"  # -0.0 + 0.0 is 0.0
    return text.replace("0.", ".", 1) if text.startswith(("0.", "-0.")) else text
