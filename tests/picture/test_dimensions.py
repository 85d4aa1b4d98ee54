"""Every dimension measures what it says; whoever sees two arrowheads and a number takes it for a length.

The lines are read from what is drawn, the values from where they stand; neither is asked what it belongs to.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import NamedTuple

import numpy as np
import pytest

from linkanim.mechanics.motion import Pose
from linkanim.picture.dimensions import MeasureLine, symbols
from linkanim.picture.figure import figure
from linkanim.picture.frame_words import lines_of
from linkanim.picture.layout import gauge
from linkanim.picture.look import Look
from linkanim.picture.motion_marks import plain
from linkanim.picture.picture import Picture
from linkanim.picture.stills import still_phase
from linkanim.picture.view import Rect
from linkanim.scenes import load, names

TOUCH = 0.5
"""Pixels: what is nearer touches."""


class Drawn(NamedTuple):
    """A dimension line from arrowhead to arrowhead, the value that belongs to it and its box."""

    text: str
    value: float
    begin: complex
    end: complex
    box: Rect

    @property
    def along(self) -> complex:
        """Its direction."""
        return (self.end - self.begin) / abs(self.end - self.begin)


def drawn(picture: Picture, pose: Pose) -> list[Drawn]:
    """Return the dimension lines of a pose with their arrowheads' tips."""
    parts = picture.names.parts(picture.drawing.setting)
    known = picture.drawing.symbols
    values = {f"dimension:{plain(one.symbol)}": one for one in known.dimensions} if known else {}
    found = []
    for line in lines_of(picture, pose.phase):
        if line.of in parts and not values[line.of].angle:
            (layer,) = parts[line.of].placed(picture.drawing.places(pose))
            tips = [complex(loop[3]) for loop in layer.loops[-2:]]
            found.append(Drawn(line.text, values[line.of].value, tips[0], tips[1], line.box))
    return found


def _to_line(point: complex, one: Drawn) -> float:
    """Return how far a point is from a line's nearest point."""
    away, along = point - one.begin, one.end - one.begin
    share = min(max((away * along.conjugate()).real / abs(along) ** 2, 0.0), 1.0)
    return abs(away - share * along)


def _to_box(box: Rect, one: Drawn) -> float:
    """Return how far a line is from a box; 0 where it meets it."""
    if box.crossed(one.begin, one.end) is not None:
        return 0.0
    corners = [complex(x, y) for x in (box.x, box.right) for y in (box.y, box.bottom)]
    ends = [abs(box.nearest(end) - end) for end in (one.begin, one.end)]
    return min(*(_to_line(corner, one) for corner in corners), *ends)


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
    return max(level) < TOUCH and (places[1] < TOUCH or places[0] > length - TOUCH)


def misread(picture: Picture, pose: Pose) -> Iterator[str]:
    """Yield what a reader would take from the dimension lines of a pose that is not so."""
    lines, high = drawn(picture, pose), picture.layout.small_size
    pins = [picture.drawing.places(pose)[name] for name in picture.figure.pins]
    for one in lines:
        measured = abs(one.end - one.begin) / picture.view.scale
        if abs(measured - one.value) > 1e-6 * one.value + TOUCH / picture.view.scale:
            yield f"{one.text} stands between arrowheads {measured:.4g} apart"
        nearest = min(lines, key=lambda line: _to_box(one.box, line))
        if nearest is not one:
            yield f"{one.text} is nearest to the line of {nearest.text}"
        share = ((one.box.middle - one.begin) * one.along.conjugate()).real / abs(one.end - one.begin)
        if not 0 <= share <= 1:
            yield f"{one.text} stands beyond its arrowheads"
        if min(abs(end - pin) for end in (one.begin, one.end) for pin in pins) < picture.gauge.pin:
            yield f"{one.text} seems to go to a pin beside it"
    for one, other in combinations(lines, 2):
        if {one.begin, one.end} == {other.begin, other.end}:
            yield f"{one.text} and {other.text} are one line"
        elif _apart(one, other) < 0.5 * high and not _chained(one, other):
            yield f"{one.text} and {other.text} are {_apart(one, other):.1f} px apart"


def unsaid(picture: Picture) -> Iterator[str]:
    """Yield the dimensions that are neither on the picture nor listed, and those that are stated twice."""
    known = picture.drawing.symbols
    names_, spans = picture.names, dict[frozenset[complex], str]()
    said = {label.text for label in (*names_.labels, *names_.listed)}
    for one in known.dimensions if known else ():
        if one.written(picture.scene.length_unit) not in said:
            yield f"{one.symbol} is nowhere"
        at, head = (picture.figure.start(name) for name in one.frame)
        way = head - at if one.frame[0] != one.frame[1] else 1
        ends = frozenset(
            complex(np.round(at + place.conjugate() * way, 9)) for place in map(complex, (one.begin, one.end))
        )
        if not one.angle:
            if ends in spans:
                yield f"{spans[ends]} and {one.symbol} are one span"
            spans[ends] = one.symbol


@pytest.mark.parametrize("size", [(1280, 720), pytest.param((640, 360), marks=pytest.mark.long)])
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
@pytest.mark.thinned(3)
def test_no_dimension_is_misread_or_lacks(name: str, size: tuple[int, int]) -> None:
    scene, look, found = load(name), Look(names=2), dict[str, list[str]]()
    phases = [still_phase(scene), 0.4 * scene.period]
    for picture, phase in (*((Picture(scene, size, look, moment=one), one) for one in phases),):
        found[f"still {phase:.2f}"] = [*misread(picture, scene.pose(phase)), *unsaid(picture)]
    moving = Picture(scene, size, look)
    for phase in (0.0, 0.3 * scene.period, 0.7 * scene.period):
        found[f"moving {phase:.2f}"] = [*misread(moving, scene.pose(phase)), *unsaid(moving)]
    assert not any(found.values()), {when: what for when, what in found.items() if what}


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


@pytest.mark.parametrize(
    ("name", "rows"),
    [
        # in line with the body: its length; to the left and right of it alike
        ("wiper", {"r₈ = 280 mm": "O₄–T", "r₉ = 280 mm": "O₆–T₂"}),
        ("hoecken", {"r₅ = 280 mm": "A–P"}),
        ("crank-rocker", {"r₅ = 80 mm": "A along A–B", "r₆ = 70 mm": "P off A–B"}),
        # the offset of a guide; the angle of a plate's third pin; a ground that is not level
        ("slider-crank", {"e = 20 mm": "O₂ to the guide of B"}),
        ("six-bar", {"β₆ = 60°": "B–O₄–C"}),
        ("watt-line", {"θ₁ = −18.43°": "angle of O₂–O₄ to the horizontal"}),
        # from the driven pivot to those that its chain needs first
        ("pantograph", {"r₁ = 80 mm": "O₂–O₄"}),
    ],
)
def test_what_is_measured_is_stated_with_its_ends(name: str, rows: dict[str, str]) -> None:
    scene = load(name)
    known = {one.written(scene.length_unit): one.about for one in symbols(figure(scene)).dimensions}
    assert {text: known.get(text) for text in rows} == rows
