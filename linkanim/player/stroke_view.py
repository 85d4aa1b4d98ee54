"""The view of a stroke and its linkage, in which the stroke stays about as large as it was drawn."""

from __future__ import annotations

from linkanim.picture.view import Box, Rect, View, joined, view_of

_GROWS = 4 / 3
"""The most that the view may show, in sizes of the view in which the stroke was drawn."""
_TINY, _ENLARGED = 0.16, 0.3
"""A stroke that takes less than the first share of its room is enlarged to the second."""


def view_for(drawn: View, stroke: Box, swept: Box, stage: Rect, words: Rect | None = None) -> View:
    """Return the view of a stroke and the box that its linkage sweeps; `drawn` is the stroke's own view.

    The stroke is always visible as a whole, the linkage where the view need not grow by more than a third for
    it. The view is moved as little as possible; where both have room beside the `words`, off these.
    """
    wide, high = stroke.right - stroke.left, stroke.high - stroke.low
    share = max(wide * drawn.scale / max(stage.width, 1.0), high * drawn.scale / max(stage.height, 1.0))
    as_drawn = drawn.scale * (_ENLARGED / share if 0 < share < _TINY else 1.0)
    both = joined(stroke, swept)
    scale = min(as_drawn, max(view_of(both, stage).scale, as_drawn / _GROWS), view_of(stroke, stage).scale)
    (x, y), (right, down) = stroke.middle, drawn.to_pixel(*stroke.middle)
    view = View(scale, right - scale * x, down + scale * y)
    view = _shifted(_shifted(view, both, stage), stroke, stage)
    if words and _taken(view, both).meets(words):
        beside = stage._replace(x=words.right, width=stage.right - words.right)
        view = _shifted(view, both, beside) if _taken(view, both).width <= beside.width else view
    return view


def _taken(view: View, box: Box) -> Rect:
    """Return a box of the scene as a rectangle in pixels."""
    left, top = view.to_pixel(box.left, box.high)
    return Rect(left, top, view.scale * (box.right - box.left), view.scale * (box.high - box.low))


def _shifted(view: View, box: Box, room: Rect) -> View:
    """Return a view moved as little as possible so that a box lies in a room, or about its middle."""
    (left, top), (right, low) = view.to_pixel(box.left, box.high), view.to_pixel(box.right, box.low)
    by_x = _inwards(left, right, room.x, room.right)
    return View(view.scale, view.x + by_x, view.y + _inwards(top, low, room.y, room.bottom))


def _inwards(first: float, last: float, begin: float, end: float) -> float:
    """Return how far an interval has to be moved to lie within another one, or about its middle."""
    if last - first > end - begin:
        return (begin + end - first - last) / 2
    return max(begin - first, 0.0) - max(last - end, 0.0)
