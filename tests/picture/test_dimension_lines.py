"""Dimension lines read as a person reads them: whoever sees two arrowheads and a word takes it for a length.

The lines are read from what is drawn, the words from where they stand; neither is asked what it belongs to.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import NamedTuple

import numpy as np
import pytest
from pictures import labelled

from linkanim.mechanics.motion import Pose
from linkanim.picture.bodies import WHEELS
from linkanim.picture.dimensions import MeasureLine
from linkanim.picture.labels import Label
from linkanim.picture.layout import gauge
from linkanim.picture.look import Look, ThemeName
from linkanim.picture.picture import Picture
from linkanim.picture.raster import Layer
from linkanim.picture.view import Rect
from linkanim.scenes import load, names

SIZES = [(1280, 720), (640, 360), (1920, 1080)]
POSES = 8
TOUCH = 0.5
"""Pixels: what is nearer touches."""
SEEN = 0.05


class Drawn(NamedTuple):
    """A dimension line from arrowhead to arrowhead, the word that belongs to it and the word's box."""

    text: str
    symbol: str
    value: float
    begin: complex
    end: complex
    box: Rect

    @property
    def along(self) -> complex:
        """Its direction."""
        return (self.end - self.begin) / abs(self.end - self.begin)


def _box(picture: Picture, label: Label, middle: complex) -> Rect:
    wide, high = (side - 2 * labelled(picture).halo.width for side in label.size)
    return Rect(middle.real - wide / 2, middle.imag - high / 2, wide, high)


def _words(picture: Picture, pose: Pose) -> list[tuple[Label, Rect]]:
    standing = labelled(picture).standing(pose, picture.drawing.places(pose))
    return [(label, _box(picture, label, middle)) for label, middle, shown in standing if shown > SEEN]


def drawn(picture: Picture, pose: Pose) -> list[Drawn]:
    """Return the dimension lines of a pose with their arrowheads' tips."""
    parts = labelled(picture).parts(picture.figure, picture.view, picture.gauge, (0, 0, 0))
    known = picture.drawing.symbols
    values = {one.symbol: one.value for one in known.dimensions if not one.angle} if known else {}
    found = []
    for label, box in _words(picture, pose):
        if label.drawn and label.symbol in values:
            (layer,) = parts[label.symbol].placed(picture.drawing.places(pose))
            tips = [complex(loop[3]) for loop in layer.loops[-2:]]
            found.append(Drawn(label.text, label.symbol, values[label.symbol], tips[0], tips[1], box))
    return found


def _to_line(point: complex, one: Drawn) -> float:
    """Return how far a point is from a line's nearest point."""
    away, along = point - one.begin, one.end - one.begin
    share = min(max((away * along.conjugate()).real / abs(along) ** 2, 0.0), 1.0)
    return abs(away - share * along)


def _to_box(box: Rect, one: Drawn) -> float:
    """Return how far a line is from a box that it does not meet."""
    corners = [complex(x, y) for x in (box.x, box.right) for y in (box.y, box.bottom)]
    aside = [
        np.hypot(
            max(box.x - end.real, 0, end.real - box.right), max(box.y - end.imag, 0, end.imag - box.bottom)
        )
        for end in (one.begin, one.end)
    ]
    return float(min(*(_to_line(corner, one) for corner in corners), *aside))


def _crossed(one: Drawn, other: Drawn) -> bool:
    def side(line: Drawn, point: complex) -> float:
        return ((point - line.begin) * line.along.conjugate()).imag

    return all(
        side(line, across.begin) * side(line, across.end) < 0 for line, across in ((one, other), (other, one))
    )


def _apart(one: Drawn, other: Drawn) -> float:
    """Return the distance between two lines."""
    if _crossed(one, other):
        return 0.0
    pairs = (one, other), (other, one)
    return min(_to_line(end, line) for line, across in pairs for end in (across.begin, across.end))


def _chained(one: Drawn, other: Drawn) -> bool:
    """Return whether one continues the other: in one line, with one end in common and nothing else."""
    level = [abs(((end - one.begin) * one.along.conjugate()).imag) for end in (other.begin, other.end)]
    places = sorted(((end - one.begin) * one.along.conjugate()).real for end in (other.begin, other.end))
    length = abs(one.end - one.begin)
    beside = places[1] < TOUCH or places[0] > length - TOUCH
    return max(level) < TOUCH and beside


def misread(picture: Picture, pose: Pose) -> Iterator[str]:
    """Yield what a reader would take from the dimension lines of a pose that is not so."""
    lines, line_of_text = drawn(picture, pose), picture.layout.small_size
    for one in lines:
        measured = abs(one.end - one.begin) / picture.view.scale
        if abs(measured - one.value) > 1e-6 * one.value + TOUCH / picture.view.scale:
            yield f"{one.text} stands between arrowheads {measured:.4g} apart"
        nearest = min(lines, key=lambda line: _to_box(one.box, line))
        if nearest is not one:
            yield f"{one.text} is nearest to the line of {nearest.text}"
        middle = one.box.middle
        share = ((middle - one.begin) * one.along.conjugate()).real / abs(one.end - one.begin)
        if not 0 <= share <= 1:
            yield f"{one.text} stands beyond its arrowheads"
        pins = [picture.drawing.places(pose)[name] for name in picture.figure.pins]
        if min(abs(end - pin) for end in (one.begin, one.end) for pin in pins) < picture.gauge.pin:
            yield f"{one.text} seems to go to a pin beside it"
    for one, other in combinations(lines, 2):
        apart = _apart(one, other)
        if {one.begin, one.end} == {other.begin, other.end} or (
            max(abs(one.begin - other.begin), abs(one.end - other.end)) < TOUCH
        ):
            yield f"{one.text} and {other.text} are one line"
        elif apart < 0.5 * line_of_text and not _chained(one, other):
            yield f"{one.text} and {other.text} are {apart:.1f} px apart"


def covered(picture: Picture, pose: Pose) -> Iterator[str]:
    """Yield what dimension lines run under or through: words, more than one link."""
    words = _words(picture, pose)
    groups = {group.name: list(group.layers) for group in picture.drawing.moving(pose)}
    for one in drawn(picture, pose):
        points = one.begin + np.linspace(0, 1, int(abs(one.end - one.begin)) + 2) * (one.end - one.begin)
        for label, box in words:
            inside = (points.real > box.x) & (points.real < box.right)
            if (inside & (points.imag > box.y) & (points.imag < box.bottom)).any():
                yield f"the line of {one.text} runs under {label.text}"
        style = {f"body-{body.name}": picture.scene.style(body.name) for body in picture.figure.bodies}
        links = [name for name, looks in style.items() if name in groups and looks.outline not in WHEELS]
        through = [name for name in links if any(_through(points, loop) for loop in _outlines(groups[name]))]
        if len(through) > 1:
            yield f"the line of {one.text} runs through {', '.join(through)}"


def _outlines(layers: list[Layer]) -> list[np.ndarray]:
    return [loop for layer in layers for loop in layer.loops]


def _through(points: np.ndarray, loop: np.ndarray) -> bool:
    """Return whether some of the points lie inside a closed outline."""
    begin, end = loop[:, None], np.roll(loop, -1)[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        across = begin.real + (points.imag - begin.imag) / (end.imag - begin.imag) * (end.real - begin.real)
    hits = ((begin.imag > points.imag) != (end.imag > points.imag)) & (points.real < across)
    return bool((hits.sum(axis=0) % 2 == 1).any())


def twice(picture: Picture) -> Iterator[str]:
    """Yield the spans that are stated more than once."""
    known = picture.drawing.symbols
    spans = dict[frozenset[complex], str]()
    for one in known.dimensions if known else ():
        at, head = (picture.figure.start(name) for name in one.frame)
        way = head - at if one.frame[0] != one.frame[1] else 1
        ends = frozenset(
            complex(np.round(at + place.conjugate() * way, 9)) for place in map(complex, (one.begin, one.end))
        )
        if not one.angle:
            if ends in spans:
                yield f"{spans[ends]} and {one.symbol} are one span"
            spans[ends] = one.symbol


def faults(name: str, size: tuple[int, int], theme: ThemeName, phase: float) -> list[str]:
    """Return what is wrong with the dimension lines of a still."""
    picture = Picture(load(name), size, Look(names=2, theme=theme), moment=phase)
    pose = picture.scene.pose(phase)
    return [*misread(picture, pose), *covered(picture, pose), *twice(picture)]


# on either side, near and far
@pytest.mark.parametrize("reach", [-30.0, 60.0])
def test_words_keep_off_the_leads_that_are_drawn(reach: float) -> None:
    thick, span = gauge(1.0, 200.0), 200.0
    line = MeasureLine(("A", "B"), 0.2, 0.9 + 0.1j, reach)
    (layer,) = line.part(span, thick, (0, 0, 0)).layers
    _, *leads = line.tracks(np.zeros(1, complex), np.full(1, span, complex), thick)[0]
    for kept_off, loop in zip(leads, layer.loops, strict=False):
        near, far = (loop[0] + loop[3]) / 2, (loop[1] + loop[2]) / 2
        assert near == pytest.approx(kept_off[0], abs=0.1)
        assert far == pytest.approx(kept_off[1], abs=3 * thick.line)


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_no_dimension_line_is_misread(name: str) -> None:
    assert not faults(name, SIZES[0], "light", 0.4 * load(name).period)


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", names())
@pytest.mark.long
def test_none_is_at_any_size_and_pose(name: str, size: tuple[int, int], theme: ThemeName) -> None:
    period = load(name).period
    found = {n: faults(name, size, theme, n * period / POSES) for n in range(POSES)}
    assert not any(found.values()), found
