"""Every dimension measures what it says, or stands in the table; no word lies on what it does not name."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from pictures import labelled

from linkanim.mechanics.motion import Pose
from linkanim.picture.bodies import WHEELS
from linkanim.picture.dimensions import Measurement, symbols
from linkanim.picture.figure import figure
from linkanim.picture.labels import Label
from linkanim.picture.look import Look, ThemeName
from linkanim.picture.picture import Picture
from linkanim.picture.text import subscripted
from linkanim.picture.view import Rect
from linkanim.scenes import load, names

SIZES = [(1280, 720), (320, 180), (1920, 1080)]
POSES = 24
NEAR = 0.5
"""Pixels."""
KNOWN = {("engine", (1920, 1080), "light"): [(4.19, "O₂ on rod")]}
"""Where there is no place: crank, rod and piston are in line there, and the pivot lies behind the rod."""


@cache
def _moving(name: str, size: tuple[int, int], theme: ThemeName) -> Picture:
    return Picture(load(name), size, Look(names=2, theme=theme))


def _still(name: str, size: tuple[int, int], theme: ThemeName, phase: float) -> Picture:
    return Picture(load(name), size, Look(names=2, theme=theme), _moving(name, size, theme), moment=phase)


def _shown(picture: Picture, pose: Pose) -> list[tuple[Label, Rect]]:
    """Return the labels that can be seen, and the boxes of their letters."""
    found, halo = [], labelled(picture).halo.width
    for label, middle, shown in labelled(picture).standing(pose, picture.drawing.places(pose)):
        if shown > 0.05:
            wide, high = (side - 2 * halo for side in label.size)
            found.append((label, Rect(middle.real - wide / 2, middle.imag - high / 2, wide, high)))
    return found


def _points(loops: list[np.ndarray]) -> np.ndarray:
    """Return points along outlines, no more than a pixel apart."""
    found = [np.zeros(0, complex)]
    for loop in loops:
        for begin, end in zip(loop, np.roll(loop, -1), strict=True):
            found.append(begin + (end - begin) * np.linspace(0, 1, int(abs(end - begin)) + 2))
    return np.concatenate(found)


def _in(points: np.ndarray, box: Rect) -> bool:
    x, y = points.real, points.imag
    return bool(((x > box.x) & (x < box.right) & (y > box.y) & (y < box.bottom)).any())


def _own_joints(picture: Picture, label: Label) -> set[str]:
    """Return the joints whose bodies a label belongs to."""
    shown = picture.figure
    known = symbols(shown)
    for one in known.dimensions:
        if label.symbol == one.symbol:
            return set(one.own)
    for name in shown.shown:
        if label.text == subscripted(name):
            return {name}
    assert label.spot
    return {label.spot.at, label.spot.head}


def touched(picture: Picture, pose: Pose) -> Iterator[str]:
    """Yield what is touched by words that must not touch it."""
    boxes, layers = _shown(picture, pose), picture.drawing
    groups = {group.name: list(group.layers) for group in (*layers.standing(), *layers.moving(pose))}
    still = {
        name: _points([loop for layer in groups[name] for loop in layer.loops])
        for name in ("ground", "input")
    }
    # a fixed pin's letter shows at all times: the smallest window may have no free place for it
    forced = {id(label) for label, _ in boxes if label.always and picture.size == SIZES[1]}
    for (one, first), (other, second) in combinations(boxes, 2):
        if first.meets(second) and not forced & {id(one), id(other)}:
            yield f"{one.text} on {other.text}"
    pins = {name: picture.drawing.places(pose)[name] for name in picture.figure.pins}
    drawn = [body for body in picture.figure.bodies if body.name and f"body-{body.name}" in groups]
    bodies = {
        body: _points([loop for layer in groups[f"body-{body.name}"] for loop in layer.loops])
        for body in drawn
        if picture.scene.style(body.name).outline not in WHEELS
    }
    for label, box in boxes:
        for what, points in still.items():
            # a fixed pin's letter shows at all times, on a link or an arc where nothing is free
            if not label.always and _in(points, box):
                yield f"{label.text} on {what}"
        for name, pin in pins.items():
            near = complex(min(max(pin.real, box.x), box.right), min(max(pin.imag, box.y), box.bottom))
            if abs(near - pin) < picture.fit.arrangement.gauge.pin and id(label) not in forced:
                yield f"{label.text} on pin {name}"
        own = _own_joints(picture, label)
        for body, points in bodies.items():
            if not label.always and not (own and own <= set(body.joints)) and _in(points, box):
                yield f"{label.text} on {body.name}"
        if any(box.meets(words) for words in picture.layout.words):
            yield f"{label.text} on the words"
        table = labelled(picture).table
        if table and box.meets(table.rect):
            yield f"{label.text} on the table"


def _ends(picture: Picture, pose: Pose, one: Measurement) -> tuple[complex, complex]:
    """Return the two places between which a length is, from the pose alone."""
    view, (at, head) = picture.view, one.frame
    begin, way = view.place(pose.position[at]), view.scale + 0j
    if head != at:
        way = view.place(pose.position[head]) - begin
    return begin + one.begin * way, begin + one.end * way


def wrong(picture: Picture, pose: Pose) -> Iterator[str]:
    """Yield what is wrong with a dimension: its line's ends, its value, its place; or that it lacks."""
    labels, places, table = _shown(picture, pose), picture.drawing.places(pose), labelled(picture).table
    found = {label.symbol: (label, box) for label, box in labels if label.symbol}
    rows = [label.row for label in table.rows] if table else ()
    parts = labelled(picture).parts(picture.figure, picture.view, picture.fit.arrangement.gauge, (0, 0, 0))
    for one in symbols(picture.figure).dimensions:
        stated = one.written(picture.scene.length_unit)
        if one.value < 0 and not one.symbol.startswith("θ"):
            yield f"{stated} is negative"
        if one.symbol not in found:
            if not any(row.startswith(stated) for row in rows):
                yield f"{stated} is nowhere"
            continue
        label, box = found[one.symbol]
        if label.text != stated:
            yield f"{label.text} for {stated}"
        if one.angle:
            continue
        begin, end = _ends(picture, pose, one)
        along, length = (end - begin) / abs(end - begin), abs(end - begin)
        if abs(length / picture.view.scale - one.value) > 1e-6 * one.value:
            yield f"{stated} measures {length / picture.view.scale}"
        if label.drawn:
            (layer,) = parts[one.symbol].placed(places)
            tips = [complex(loop[3]) for loop in layer.loops[-2:]]
            for tip, place in zip(tips, (begin, end), strict=True):
                if abs(((tip - place) * along.conjugate()).real) > NEAR:
                    yield f"{stated} ends elsewhere"
        else:
            middle = complex(box.x + box.width / 2, box.y + box.height / 2)
            off = abs(((middle - begin) * along.conjugate()).real / length - 0.5)
            # over the ground, which no bar fills, much may pass: its middle third is near enough
            if off >= (0.1 if one.own else 0.2):
                yield f"{stated} is not by the middle of its bar"


def _faults(picture: Picture, phase: float) -> Iterator[tuple[float, str]]:
    pose = picture.scene.pose(phase)
    yield from ((round(phase, 2), words) for words in (*wrong(picture, pose), *touched(picture, pose)))


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_dimensions_and_words_are_in_their_places(name: str) -> None:
    period, size = load(name).period, SIZES[0]
    moving, still = _moving(name, size, "light"), _still(name, size, "light", 0.3 * period)
    found = [*_faults(still, 0.3 * period)]
    found += [fault for share in (0.1, 0.55) for fault in _faults(moving, share * period)]
    assert not found


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", names())
@pytest.mark.long
def test_they_are_at_every_size_and_pose(name: str, size: tuple[int, int], theme: ThemeName) -> None:
    """At two dozen poses; in a still of each theme at every second of them."""
    moving, found = _moving(name, size, theme), list[tuple[float, str]]()
    for n in range(POSES):
        phase = n * moving.scene.period / POSES
        found += _faults(moving, phase)
        if n % 2 == (theme == "dark"):
            found += _faults(_still(name, size, theme, phase), phase)
    assert found == KNOWN.get((name, size, theme), [])


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


def test_what_finds_no_place_stands_in_a_table_that_is_given_room() -> None:
    picture = _moving("jansen", (320, 180), "light")
    table, strip = labelled(picture).table, picture.layout.table
    assert table
    assert strip
    assert not strip.meets(picture.layout.stage)
    lines = list(table.captions())
    assert [line.text for line in lines] == [label.row for label in table.rows]
    assert all(strip.holds(line.at[0], line.at[1] + line.size) for line in lines)
