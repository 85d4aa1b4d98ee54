"""A name stands on or by what it names, on no other link; of crowded places it takes the one that is free."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from pictures import standing

from linkanim.mechanics.motion import Pose
from linkanim.picture import placing
from linkanim.picture.dimensions import symbols
from linkanim.picture.fittings import rail_reach
from linkanim.picture.labels import Surroundings
from linkanim.picture.look import Look
from linkanim.picture.motion_marks import Turning
from linkanim.picture.picture import Picture
from linkanim.picture.placing import (
    MOMENTS,
    Clutter,
    LabelPlaces,
    Placed,
    Solid,
    Solids,
    about,
    crossed,
    holding,
    least_met,
    met,
    overlap,
    place,
    placed_among,
    rect_rows,
    touching,
    widened,
)
from linkanim.picture.shapes import hull
from linkanim.picture.view import Rect
from linkanim.scenes import load


def _off(point: complex, corners: list[complex]) -> float:
    """Return how far a point is from what corners enclose, 0 inside."""
    ends = list(zip(corners, corners[1:] + corners[:1], strict=True))
    turned = [((end - begin).conjugate() * (point - begin)).imag for begin, end in ends]
    if len(corners) > 2 and (min(turned) > 0 or max(turned) < 0):
        return 0.0
    shares = [((point - begin) / (end - begin)).real for begin, end in ends]
    feet = zip(ends, shares, strict=True)
    return min(abs(point - begin - min(max(share, 0), 1) * (end - begin)) for (begin, end), share in feet)


def _links(painter: Picture, pose: Pose) -> Iterator[tuple[str, tuple[str, ...], list[complex]]]:
    """Yield every link, spring and damper: what it is called, its joints, and its corners in pixels."""
    shown, places = painter.figure, painter.drawing.places(pose)
    called = {body.name: number for body, number in shown.numbers.items()}
    for body in shown.bodies:
        corners = hull([places[joint] for joint in body.joints])
        yield called.get(body.name, body.name), body.joints, corners
    for strut in shown.struts:
        yield strut.name, strut.between, [places[joint] for joint in strut.between]


SCENES = ("wiper", "roberts-line", "triple-rocker", "pumpjack", "hoecken", "jansen", "watt-1", "klann")


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", SCENES)
def test_no_link_s_name_stands_on_another_link(name: str) -> None:
    """Where its middle is, nothing lies that is drawn over its own; off its own, no other link at all."""
    scene = load(name)
    painter = Picture(scene, (1280, 720), Look(names=1))
    bar, bodies = painter.drawing.setting.gauge.bar, [body.joints for body in painter.figure.bodies]
    words = {body.name: number for body, number in painter.figure.numbers.items()}
    for phase in np.linspace(0, scene.period, 31):
        pose = scene.pose(float(phase))
        links = list(_links(painter, pose))
        for text, box in standing(painter, pose):
            own = next((one for one in links if words.get(text, text) == one[0]), None)
            if own is None:
                continue
            middle = complex(box.x + box.width / 2, box.y + box.height / 2)
            on_it, wide = _off(middle, own[2]) < bar, len(own[2]) > 2
            for other, joints, corners in links:
                hides = len(corners) == 2 and (wide or bodies.index(joints) > bodies.index(own[1]))
                if joints != own[1] and joints in bodies and (hides or not on_it):
                    assert _off(middle, corners) > bar - 1.0, (text, other, phase)


@pytest.mark.parametrize("name", ["press", "slider-crank", "scotch-yoke", "elliptic-trammel"])
def test_a_slider_s_name_stands_by_its_block_and_on_no_link(name: str) -> None:
    """Also not on the bar that leads to the block, nor on a spring below it."""
    scene = load(name)
    painter = Picture(scene, (1280, 720), Look(names=1))
    bar, numbers = painter.drawing.setting.gauge.bar, painter.figure.numbers
    sliders = {text: body.slider for body in numbers if body.slider for text in (body.name, numbers[body])}
    seen = 0
    for phase in np.linspace(0, scene.period, 31):
        pose = scene.pose(float(phase))
        for text, box in standing(painter, pose):
            middle = complex(box.x + box.width / 2, box.y + box.height / 2)
            for other, _, corners in _links(painter, pose) if text in sliders else ():
                seen += 1
                assert _off(middle, corners) > bar - 1.0, (text, other, phase)
    assert seen > 10


def _surroundings(name: str) -> Surroundings:
    picture = Picture(load(name), (640, 360), Look(names=1))
    return Surroundings(replace(picture.drawing.setting, view=picture.fitted))


def _path(ground: Surroundings, joint: str) -> np.ndarray:
    return ground.setting.figure.path(joint, ground.setting.view)[:: 720 // MOMENTS]


@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank"])
def test_round_a_joint_a_name_stands_off_it_up_and_right_first(name: str) -> None:
    """Off a pin by half a bar's width, off a slider as far beyond its rails."""
    ground, size, joint = _surroundings(name), (30.0, 12.0), "B"
    reach = 1.0 + rail_reach(ground.setting, joint) / ground.setting.gauge.bar
    found = ground.around(joint, size).candidates
    away = found.places - _path(ground, joint)[:, None]
    assert np.ptp(away, axis=0) == pytest.approx(np.zeros(len(found.price)), abs=1e-9)
    best = away[0, found.price.argmin()]
    assert best.real == pytest.approx((reach * ground.setting.gauge.bar + 15) / np.sqrt(2), rel=1e-9)
    assert best.real > 0 > best.imag
    for ring, places in enumerate(np.split(away[0], 3)):
        radius = reach * ground.setting.gauge.bar + 0.7 * 12 * ring
        assert places[0] == pytest.approx(radius + 15)
        assert places[len(places) // 4] == pytest.approx(-1j * (radius + 6))
    costs = [part.min() for part in np.split(found.price, 3)]
    assert costs == pytest.approx([float(n) for n in range(3)])


def test_what_is_measured_has_its_length_clear_of_it_on_either_side() -> None:
    ground = _surroundings("crank-rocker")
    begin, end = (_path(ground, joint) for joint in ("O2", "A"))
    (crank,) = (one for one in symbols(ground.setting.figure).dimensions if one.about == "O₂–A")
    bare, lined = (spots.candidates for spots in ground.dimension(crank, (20.0, 12.0)))
    along = (end - begin) / np.abs(end - begin)
    wide = np.abs(along.imag) * 10 + np.abs(along.real) * 6 + 1.3 * ground.setting.gauge.bar
    off = ((bare.places - begin[:, None]) * along.conj()[:, None]).imag
    assert np.abs(off) == pytest.approx(np.broadcast_to(wide[:, None], off.shape))
    assert (np.sign(off) > 0).sum(axis=1).tolist() == [3] * MOMENTS
    assert bare.drawn is None
    # by a dimension line it stands beyond that, seen from the bar
    assert lined.drawn is not None
    for number, lines in enumerate(lined.lines):
        far = ((lined.places[:, lined.drawn == number] - begin[:, None]) * along.conj()[:, None]).imag
        level = ((lines[:, 0] - begin[:, None]) * along.conj()[:, None]).imag
        assert (np.abs(far) > np.abs(level[:, :1]) + 6).all()
        assert (np.sign(far) == np.sign(level[:, :1])).all()
    (too_wide,) = ground.dimension(crank, (200.0, 12.0))
    assert too_wide.candidates.drawn is not None


def test_a_link_s_name_stands_on_its_bar_or_within_its_plate() -> None:
    ground, size = _surroundings("crank-rocker"), (30.0, 12.0)
    bodies = {body.name: body for body in ground.setting.figure.bodies}
    for name, body in bodies.items():
        places = ground.on(body, size).candidates.places
        ends = [_path(ground, joint) for joint in body.joints]
        for moment in (0, 40, 100):
            corners = hull([complex(path[moment]) for path in ends])
            on_it = places[moment, : None if len(corners) > 2 else 7]
            assert max(_off(complex(place), corners) for place in on_it) < 1e-9, name
    assert len(ground.on(bodies["coupler"], size).candidates.price) == 1 + 3 * 6
    assert len(ground.on(bodies["crank"], size).candidates.price) == 5 * 7


@pytest.mark.parametrize("name", ["crank-rocker", "double-rocker"])
def test_the_angle_s_symbol_stands_outside_its_arc(name: str) -> None:
    ground, size = _surroundings(name), (20.0, 12.0)
    turning = Picture(load(name), (640, 360), Look(names=1)).drawing.parts.turning
    assert isinstance(turning, Turning)
    found = ground.by_arc(turning, size).candidates
    away = np.abs(found.places - _path(ground, turning.pivot)[:, None])
    assert away.min() > turning.arc + 6.0


def test_three_joints_in_line_are_a_bar() -> None:
    ground = _surroundings("elliptic-trammel")
    rod = next(body for body in ground.setting.figure.bodies if body.name == "rod")
    assert len(rod.joints) > 2
    assert len(ground.on(rod, (30.0, 12.0)).candidates.price) == 5 * 7


ROOM = Rect(0, 0, 400, 400)


def _clutter(*solids: Solid) -> Clutter:
    return Clutter(ROOM, solids=solids)


def _label(places: list[complex], price: list[float], moments: int = MOMENTS) -> LabelPlaces:
    return LabelPlaces((20.0, 10.0), np.tile(np.array(places, complex), (moments, 1)), np.array(price))


def _one(label: LabelPlaces, clutter: Clutter) -> Placed:
    (found,) = place([label], clutter)
    return found


# Labels are 20 x 10; the room ends at 0 and 400. On a chart there is one moment.
@pytest.mark.parametrize("moments", [1, MOMENTS])
@pytest.mark.parametrize(("edge", "out"), [(10 + 90j, -1), (390 + 90j, 1), (90 + 5j, -1j), (90 + 395j, 1j)])
def test_a_label_stands_at_an_edge_but_not_over_it(edge: complex, out: complex, moments: int) -> None:
    middle, near, over = 200 + 200j, edge - 0.1 * out, edge + 0.1 * out
    for asked, which in ((near, 0), (over, 1)):
        found = _one(_label([asked, middle], [0.0, 0.5], moments), Clutter(ROOM))
        assert (found.which, found.shown.min()) == (which, 1.0)


@pytest.mark.parametrize(
    ("corners", "which"),
    [
        # the middle of a plate, far from its sides; of either turn
        ((0j, 200 + 0j, 200 + 200j, 200j), 1),
        ((0j, 200j, 200 + 200j, 200 + 0j), 1),
        # a bar right through it, and a bar that ends before it
        ((0 + 100j, 200 + 100j), 1),
        ((200 + 100j, 300 + 100j), 0),
        # a plate beside it
        ((200 + 0j, 300 + 0j, 300 + 200j), 0),
    ],
)
def test_a_label_keeps_off_the_solids_that_it_shuns(corners: tuple[complex, ...], which: int) -> None:
    clutter = _clutter(Solid(np.tile(np.array(corners), (MOMENTS, 1)), 8.0))
    heedful = _label([100 + 100j, 100 + 300j], [0.0, 0.5])
    careless = heedful._replace(own=frozenset([0]))
    found = _one(heedful, clutter)
    assert (found.which, found.shown.min()) == (which, 1.0)
    assert _one(careless, clutter).which == 0
    # beside what it belongs to rather than on it
    assert _one(heedful._replace(beside=frozenset([0])), clutter).which == which


@pytest.mark.thinned(2)
@pytest.mark.parametrize("turn", [1, np.exp(2.2j)])
@pytest.mark.parametrize("corners", [1, 2, 5])
def test_boxes_touch_what_reaches_into_them(corners: int, turn: complex) -> None:
    """As points all over each tell; a bar's ends count as square, so that no touch is missed."""
    shape = 30 * turn * np.exp(2j * np.pi * np.arange(corners) / corners)
    solid = Solid(shape[None], 4.0)
    boxes = np.add.outer(np.linspace(-60, 60, 25), 1j * np.linspace(-60, 60, 25)).ravel()[None]
    found = touching(boxes, (20.0, 10.0), Solids.of([solid]))[0, :, 0]
    inner = np.add.outer(np.linspace(-10, 10, 21), 1j * np.linspace(-5, 5, 11)).ravel()
    for box, touched in zip(boxes[0], found, strict=True):
        near = (
            min(_off(complex(point), list(map(complex, shape))) for point in box + inner[::3])
            if corners > 1
            else np.abs(box + inner - shape[0]).min()
        )
        assert touched or near > 3.0
        assert not touched or near < 4.0 * np.sqrt(2) + 3.0


def test_many_boxes_touch_what_each_alone_touches() -> None:
    """What is known of many at once, and left out where it need not be told, changes nothing."""
    rng = np.random.default_rng(4)
    turns = 2 * np.pi * np.arange(9) / 9
    solids = [
        Solid((complex(*rng.uniform(-60, 60, 2)) + 9 * np.cos(turns) + 40j * np.sin(turns))[None], 3.0)
        for _ in range(20)
    ]
    boxes = (rng.uniform(-90, 90, 60) + 1j * rng.uniform(-90, 90, 60))[None]
    every = touching(boxes, (20.0, 10.0), Solids.of(solids))
    alone = [touching(boxes[:, n : n + 1], (20.0, 10.0), Solids.of(solids))[0, 0] for n in range(60)]
    assert every[0].tolist() == [one.tolist() for one in alone]
    assert 100 < every.sum() < every.size - 100
    but = rng.random(boxes.shape) < 0.5
    told = touching(boxes, (20.0, 10.0), Solids.of(solids), but)
    assert (told == every)[~but].all()


def test_a_label_takes_the_place_where_nothing_comes_and_is_gone_where_it_must_be() -> None:
    """A disc sweeps over the only place of one label, and past one of two places of another."""
    way = np.full((MOMENTS, 1), 500 + 500j)
    way[60:66] = 100 + 100j
    disc = Solid(way, 5.0)
    only, free = _label([100 + 100j], [0.0]), _label([100 + 100j, 100 + 120j], [0.0, 0.1])
    stuck = _one(only, _clutter(disc))
    assert stuck.shown[60:66].tolist() == [0.0] * 6
    assert stuck.shown[110] == 1.0
    assert np.abs(np.diff(stuck.shown)).max() < 0.2
    assert _one(free, _clutter(disc))._replace(shown=np.ones(0)).which == 1
    first, second, other = place([only, only, free], _clutter())
    assert first.shown.all()
    assert not second.shown.any()
    assert (other.which, other.shown.min()) == (1, 1.0)


def test_a_label_that_is_larger_than_its_room_is_held_to_no_solid(monkeypatch: pytest.MonkeyPatch) -> None:
    held = list[int]()

    def noted(places: NDArray[np.complex128], *more: Any) -> NDArray[np.bool_]:
        held.append(places.size)
        return touching(places, *more)

    monkeypatch.setattr(placing, "touching", noted)
    solids = tuple(Solid(np.full((MOMENTS, 1), 20 + 20j), 5.0) for _ in range(9))
    clutter = Clutter(Rect(0, 0, 40, 40), solids=solids)
    places = np.full((MOMENTS, 30), 20 + 20j)
    for size, most in (((60, 10), 0), ((10, 10), MOMENTS * 30 * 9)):
        label = LabelPlaces(size, places, np.zeros(30))
        assert not place([label], clutter)[0].shown.any()
        assert sum(held) <= most
    assert sum(held) > 0


@pytest.mark.parametrize("seed", range(20))
def test_labels_of_one_moment_stand_where_they_would_one_after_the_other(seed: int) -> None:
    """What all of them are held to at once is what each is held to alone: the room, words, lines, others."""
    chance, room, half = np.random.default_rng(seed), Rect(0, 0, 300, 200), 1.5
    ends = chance.uniform(0, 300, (12, 2)) + 1j * chance.uniform(0, 200, (12, 2))
    rects = [Rect(x, y, 40, 15) for x, y in chance.uniform(0, 180, (3, 2)).tolist()]
    labels = []
    for count in chance.integers(1, 12, 30):
        places = chance.uniform(-10, 310, (1, count)) + 1j * chance.uniform(-10, 210, (1, count))
        size = (float(chance.uniform(5, 40)), 12.0)
        labels.append(LabelPlaces(size, places, np.arange(float(count))))
    clutter = Clutter(room, tuple(rects), tuple(Solid(line[None], half) for line in ends))
    expected = [(placed.which, placed.shown[0] == 1.0) for placed in place(labels, clutter)]
    assert placed_among(labels, room, rects, ends[None], half) == expected
    assert {has_room for _, has_room in expected} == {True, False}


@pytest.mark.parametrize("seed", range(10))
def test_labels_of_one_moment_stand_where_they_would_as_long_as_nothing_moves(seed: int) -> None:
    """Of one moment what is in the way of all labels is found at once, of several that of each in turn."""
    chance, room = np.random.default_rng(seed), Rect(0, 0, 300, 200)

    def points(*count: int) -> NDArray[np.complex128]:
        found: NDArray[np.complex128] = chance.uniform(0, 300, count) + 1j * chance.uniform(0, 200, count)
        return found

    solids = [Solid(points(1, 1), 9.0), *(Solid(points(1, 2), 2.0, little=n < 2) for n in range(6))]
    solids += [Solid(np.array([hull((one + 15 * points(1, 5)[0] / 100).tolist())]), 1.0) for one in points(4)]
    clutter = Clutter(
        room, (Rect(20, 20, 60, 15),), tuple(solids), links=frozenset({2, 3, 4}), pins=frozenset({0})
    )
    labels = []
    for n, count in enumerate(chance.integers(1, 12, 20)):
        lines = tuple(points(1, 2, 2) for _ in range(4)) if n % 3 == 0 else ()
        own, beside = (frozenset(chance.integers(0, len(solids), 2).tolist()) for _ in range(2))
        label = LabelPlaces(
            (float(chance.uniform(5, 40)), 12.0), points(1, count), np.arange(count) / 7, own, beside
        )
        labels.append(
            label._replace(lines=lines, drawn=chance.integers(-1, 4, count), gap=5.0 * (n % 2))
            if lines
            else label
        )
    often = [
        one._replace(places=one.places.repeat(16, 0), lines=tuple(line.repeat(16, 0) for line in one.lines))
        for one in labels
    ]
    still, moving = place(labels, clutter), place(often, clutter)
    assert [bool(one.shown.all()) for one in still] == [bool(one.shown.all()) for one in moving]
    assert [one.which for one in still if one.shown.all()] == [one.which for one in moving if one.shown.all()]
    assert len({bool(one.shown.all()) for one in still}) == 2
    clutter.learn(labels)
    alone = [place([label], clutter)[0].shown.all() for label in labels]
    assert [*map(clutter.has_place, labels)] == alone


COARSE = (0.0, 10.0, 20.0, 30.0)
"""Few values, so that edges often lie on each other, and lines on edges, or have no length."""


def _some_rects(chance: np.random.Generator, count: int) -> list[Rect]:
    corners = chance.choice(COARSE, (count, 2)) + chance.choice([0.0, 0.1], (count, 1))
    sizes = chance.choice([10.0, 20.0, 0.0], (count, 2))
    found = [Rect(*row) for row in np.hstack((corners, sizes)).tolist()]
    found[0] = found[0]._replace(x=float("nan"))
    return found


@pytest.mark.parametrize("seed", range(5))
def test_many_rectangles_at_once_meet_and_cross_what_each_does(seed: int) -> None:
    chance = np.random.default_rng(seed)
    rects, others = _some_rects(chance, 40), _some_rects(chance, 30)
    ends = (chance.choice(COARSE, (60, 2)) + 1j * chance.choice([*COARSE, 3.7], (60, 2))).tolist()
    lines = [(one, other) for one, other in ends]
    rows = rect_rows(rects)
    meets = [[one.meets(other) for other in others] for one in rects]
    assert overlap(rows[..., None], rect_rows(others)).tolist() == meets
    assert met(rows, rect_rows(others)).tolist() == [sum(row) for row in meets]
    crossing = [sum(one.crossed(*line) is not None for line in lines) for one in rects]
    assert crossed(rows, lines).tolist() == crossing
    assert 0 < sum(crossing) < len(rects) * len(lines)
    held = [sum(one.holds(begin.real, begin.imag) for begin, _ in lines) for one in rects]
    assert holding(rows, np.array(lines)[:, 0]).tolist() == held
    assert widened(rows, 2.5).T.tolist()[1:] == [[*one.inset(-2.5)] for one in rects[1:]]


@pytest.mark.parametrize("room", [Rect(0, 0, 300, 200), Rect(5, 5, 20, 4)])
def test_rectangles_are_moved_into_a_room_as_each_is_even_if_they_have_none(room: Rect) -> None:
    chance = np.random.default_rng(1)
    middles = np.array(chance.uniform(-40, 340, (6, 9)) * (1 + 1j), np.complex128)
    wide = chance.uniform(5, 40, (6, 1))
    expected = []
    for row, broad in zip(middles.tolist(), wide[:, 0].tolist(), strict=True):
        moved = [room.nearest(at, complex(broad, 12) / 2) for at in row]
        expected.append([[at.real - broad / 2, at.imag - 12 / 2, broad, 12.0] for at in moved])
    assert np.moveaxis(about(middles, wide, 12, room), 0, -1).tolist() == expected


@pytest.mark.parametrize("seed", range(5))
def test_each_name_takes_the_first_place_that_meets_least_and_of_these_crosses_least(seed: int) -> None:
    chance = np.random.default_rng(seed)
    places = [_some_rects(chance, 6) for _ in range(12)]
    busy = _some_rects(chance, 8)
    bars = [(complex(*one), complex(*other)) for one, other in chance.choice(COARSE, (9, 2, 2)).tolist()]
    rects = np.stack([rect_rows(row) for row in places], axis=1)
    expected, taken = [], list(busy)
    for row in places:
        costs = [
            (sum(one.meets(other) for other in taken), sum(one.crossed(*bar) is not None for bar in bars))
            for one in row
        ]
        expected.append(costs.index(min(costs)))
        taken.append(row[expected[-1]])
    assert least_met(rects, met(rects, rect_rows(busy)), crossed(rects, bars)) == expected
    assert len(set(expected)) > 2
