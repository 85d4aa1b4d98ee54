"""A name stands on or by what it names, on no other link; of crowded places it takes the one that is free."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from pictures import standing

from linkanim.mechanics.motion.motion import Pose
from linkanim.picture.labels.dimensions import numbered
from linkanim.picture.labels.placing import Clutter, Obstacles, Solid, Wish, place
from linkanim.picture.labels.whereabouts import Whereabouts
from linkanim.picture.look import Look
from linkanim.picture.painter import Painter
from linkanim.picture.parts.turning import Turning
from linkanim.picture.raster.shapes import hull
from linkanim.picture.view import Rect
from linkanim.scenes import load

COUNT = 72
FRAME = np.zeros(COUNT, np.complex128), np.ones(COUNT, np.complex128)
NONE = np.zeros((COUNT, 0), np.complex128)


def _off(point: complex, corners: list[complex]) -> float:
    """Return how far a point is from what corners enclose, 0 inside."""
    ends = list(zip(corners, corners[1:] + corners[:1], strict=True))
    turned = [((end - begin).conjugate() * (point - begin)).imag for begin, end in ends]
    if len(corners) > 2 and (min(turned) > 0 or max(turned) < 0):
        return 0.0
    shares = [((point - begin) / (end - begin)).real for begin, end in ends]
    feet = zip(ends, shares, strict=True)
    return min(abs(point - begin - min(max(share, 0), 1) * (end - begin)) for (begin, end), share in feet)


def _links(painter: Painter, pose: Pose) -> Iterator[tuple[str, tuple[str, ...], list[complex]]]:
    """Yield every link, spring and damper: what it is called, its joints, and its corners in pixels."""
    shown, places = painter._figure, painter.drawing.places(pose)
    called = {body.name: number for body, number in numbered(shown).items()}
    for body in shown.bodies:
        corners = hull([places[joint] for joint in body.joints])
        yield called.get(body.name, body.name), body.joints, corners
    for strut in shown.struts:
        yield strut.name, strut.between, [places[joint] for joint in strut.between]


SCENES = ("wiper", "roberts-line", "triple-rocker", "pumpjack", "hoecken", "jansen", "watt-1", "klann")


@pytest.mark.parametrize("name", SCENES)
def test_no_link_s_name_stands_on_another_link(name: str) -> None:
    """Where its middle is, nothing lies that is drawn over its own; off its own, no other link at all."""
    scene = load(name)
    painter = Painter(scene, (1280, 720), Look(names=1))
    bar, bodies = painter.drawing.scenery.gauge.bar, [body.joints for body in painter._figure.bodies]
    words = {body.name: number for body, number in numbered(painter._figure).items()}
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
    painter = Painter(scene, (1280, 720), Look(names=1))
    bar, numbers = painter.drawing.scenery.gauge.bar, numbered(painter._figure)
    sliders = {text: body.slider for body in numbers if body.slider for text in (body.name, numbers[body])}
    seen = 0
    for phase in np.linspace(0, scene.period, 31):
        pose = scene.pose(float(phase))
        for text, box in standing(painter, pose):
            middle = complex(box.x + box.width / 2, box.y + box.height / 2)
            for other, _, corners in _links(painter, pose) if text in sliders else ():
                seen += 1
                assert _off(middle, corners) > bar - 1.0, (text, other, phase)
    assert seen > 20


def _whereabouts(name: str) -> Whereabouts:
    set_ = Painter(load(name), (640, 360), Look(names=1)).drawing.scenery
    return Whereabouts(set_.figure, set_.fitted, set_.gauge, set_.layout)


@pytest.mark.parametrize(
    ("name", "joint", "reach", "rings"),
    # a pin, and a slider's block with the rings of its name
    [("crank-rocker", "B", 1.0, 2), ("slider-crank", "B", 2.7, 2), ("slider-crank", "B", 2.7, 3)],
)
def test_round_a_joint_a_name_stands_off_it_up_and_right_first(
    name: str, joint: str, reach: float, rings: int
) -> None:
    ground, size = _whereabouts(name), (30.0, 12.0)
    wish = ground.around(joint, size, rings) if rings == 2 else ground.by_slider(joint, size)
    away = wish.places - wish.frame[0][:, None]
    best = away[0, wish.price.argmin()]
    assert best.real == pytest.approx(reach * ground.gauge.bar / np.sqrt(2) + 15 / np.sqrt(2), rel=1e-9)
    assert best.real > 0 > best.imag
    for ring, places in enumerate(np.split(away[0], rings)):
        radius = reach * ground.gauge.bar + 0.7 * 12 * ring
        along, up = places[0], places[6]
        assert along == pytest.approx(radius + 15)
        assert up == pytest.approx(-1j * (radius + 6))
        assert np.all((np.abs(places.real) > 15) | (np.abs(places.imag) > 6))
    costs = [part.min() for part in np.split(wish.price, rings)]
    assert costs == pytest.approx([float(n) for n in range(rings)])


def test_what_is_measured_has_its_length_clear_of_it_on_either_side() -> None:
    ground, size = _whereabouts("crank-rocker"), (60.0, 12.0)
    begin, end = (ground.figure.path(name, ground.view)[::10] for name in ("O2", "A"))
    wish = ground.beside("O2", "A", size)
    along = (end - begin) / np.abs(end - begin)
    off = ((wish.places - begin[:, None]) * along.conj()[:, None]).imag
    wide = np.abs(along.imag) * 30 + np.abs(along.real) * 6 + 1.3 * ground.gauge.bar
    assert np.abs(off) == pytest.approx(np.broadcast_to(wide[:, None], off.shape))
    assert (np.sign(off) > 0).sum(axis=1).tolist() == [7] * COUNT


def test_a_link_s_name_stands_on_its_bar_or_within_its_plate() -> None:
    ground, size = _whereabouts("crank-rocker"), (30.0, 12.0)
    bodies = {body.name: body for body in ground.figure.bodies}
    for name, body in bodies.items():
        wish = ground.on(body, size)
        ends = [ground.figure.path(joint, ground.view)[::10] for joint in body.joints]
        for moment in (0, 20, 50):
            corners = hull([complex(path[moment]) for path in ends])
            on_it = wish.places[moment, : None if len(corners) > 2 else 7]
            assert max(_off(complex(place), corners) for place in on_it) < 1e-9, name
    assert len(ground.on(bodies["coupler"], size).price) == 1 + 3 * 6
    assert len(ground.on(bodies["crank"], size).price) == 5 * 7


@pytest.mark.parametrize("name", ["crank-rocker", "double-rocker"])
def test_the_angle_s_symbol_stands_outside_its_arc_at_the_middle_of_it(name: str) -> None:
    """Of an input that turns, where the angle is small, too."""
    ground, size = _whereabouts(name), (20.0, 12.0)
    turning = Painter(load(name), (640, 360), Look(names=1)).drawing.cast.turning
    assert isinstance(turning, Turning)
    wish = ground.by_arc(turning, size)
    pivot, pin = (ground.figure.path(joint, ground.view)[::10] for joint in (turning.pivot, turning.pin))
    angles = [turning.turned(float(angle)) for angle in -np.angle(pin - pivot)]
    middle = [np.pi / 6 if name == "crank-rocker" else angle / 2 for angle in angles]
    best = wish.places[:, wish.price.argmin()] - pivot
    wide, high = turning.arc + 1.2 + 10.0, turning.arc + 1.2 + 6.0
    assert best == pytest.approx(wide * np.cos(middle) - 1j * high * np.sin(middle))


def test_labels_keep_off_pins_and_blocks_and_three_joints_in_line_are_a_bar() -> None:
    ground = _whereabouts("elliptic-trammel")
    gauge, radii = ground.gauge, ground.clutter().radii
    travels = [ground.figure.linkage.joint(name).travels for name in ground.figure.shown]
    wanted = [0.85 * 2.7 * gauge.bar if moves else gauge.pin + gauge.outline for moves in travels]
    assert radii == pytest.approx(wanted)
    rod = next(body for body in ground.figure.bodies if body.name == "rod")
    assert len(rod.joints) > 2
    wish = ground.on(rod, (30.0, 12.0))
    assert len(wish.price) == 5 * 7
    origin, direction = wish.frame
    aside = ((wish.places - origin[:, None]) / direction[:, None]).imag[0]
    assert np.sort(aside) == pytest.approx(-np.sort(aside)[::-1])


def test_names_stay_off_all_sides_of_plates_and_more_so_of_bars() -> None:
    ground = _whereabouts("press")
    sides = [len(body.joints) for body in ground.figure.bodies]
    assert set(sides) == {2, 3}
    weights = [weight for count in sides for weight in ([1.0] if count == 2 else [0.4] * count)]
    assert ground.clutter().bars.weight[: len(weights)].tolist() == weights


def _clutter(solids: tuple[Solid, ...], discs: np.ndarray = NONE) -> Clutter:
    bars = Obstacles(NONE, NONE, np.zeros(0), np.zeros(0))
    return Clutter(discs, np.full(discs.shape[1], 5.0), (), Rect(0, 0, 400, 400), bars, solids)


def _wish(places: list[complex], price: list[float]) -> Wish:
    return Wish((20.0, 10.0), np.tile(np.array(places), (COUNT, 1)), np.array(price), FRAME)


# Labels are 20 x 10 and planned 0.8 larger on each side; the room ends at 0 and 400.
@pytest.mark.parametrize(
    ("edge", "out"), [(10.8 + 90j, -1), (389.2 + 90j, 1), (90 + 5.8j, -1j), (90 + 394.2j, 1j)]
)
def test_a_label_stands_at_an_edge_but_not_over_it(edge: complex, out: complex) -> None:
    middle, near, over = 200 + 200j, edge - 0.1 * out, edge + 0.1 * out
    for wanted, taken in ((near, near), (over, middle)):
        (path,) = place([_wish([wanted, middle], [0.0, 0.5])], _clutter(()))
        assert path.offset == pytest.approx(np.full(COUNT, taken))


@pytest.mark.parametrize(
    ("corners", "taken"),
    [
        # the middle of a plate, far from its sides; of either turn
        ((0j, 200 + 0j, 200 + 200j, 200j), 100 + 300j),
        ((0j, 200j, 200 + 200j, 200 + 0j), 100 + 300j),
        # a bar right through it, and a bar that ends before it
        ((0 + 100j, 200 + 100j), 100 + 300j),
        ((200 + 100j, 300 + 100j), 100 + 100j),
        # a plate beside it
        ((200 + 0j, 300 + 0j, 300 + 200j), 100 + 100j),
    ],
)
def test_a_label_keeps_off_the_solids_that_it_shuns(corners: tuple[complex, ...], taken: complex) -> None:
    solid = Solid(np.tile(np.array(corners), (COUNT, 1)), 8.0)
    wish = _wish([100 + 100j, 100 + 300j], [0.0, 0.5])
    heedful = wish._replace(shunned=np.ones((2, 1), np.bool_))
    (found,) = place([heedful], _clutter((solid,)))
    assert np.all(found.offset == taken)
    assert found.shown.all()
    (careless,) = place([wish], _clutter((solid,)))
    assert np.all(careless.offset == 100 + 100j)


def test_a_label_keeps_still_where_nothing_comes_in_its_way_and_is_gone_where_it_must_be() -> None:
    """A disc sweeps over the only place of one label, and past one of two places of another."""
    disc = np.full((COUNT, 1), 500 + 500j)
    disc[30:33] = 100 + 100j
    clutter = _clutter((), disc)
    only, free = _wish([100 + 100j], [0.0]), _wish([100 + 100j, 100 + 120j], [0.0, 0.1])
    (stuck,) = place([only], clutter)
    assert stuck.at(31 / COUNT)[1] < 0.05
    assert stuck.at(60 / COUNT)[1] == 1.0
    (still,) = place([free], clutter)
    assert np.all(still.offset == still.offset[0])
    assert still.offset[0] == 100 + 120j
    assert still.shown.all()
    first, second = place(
        [only, only],
        replace(clutter, discs=NONE, radii=np.zeros(0)),
    )
    assert first.shown.all()
    assert not second.shown.any()
