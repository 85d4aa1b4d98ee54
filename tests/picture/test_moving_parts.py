"""Springs, dampers, gears, traces and vectors follow the motion."""

from __future__ import annotations

import math
import tomllib
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from pictures import contrast, pixels

from linkanim.mechanics.linkage import Crank, Damper, Drive, Gear, Linkage, Pin
from linkanim.mechanics.quantities import indexed
from linkanim.picture.bodies import body_parts
from linkanim.picture.figure import DrawContext, Figure, figure
from linkanim.picture.fit import of_linkage
from linkanim.picture.fittings import Coil, Damping, coils, dampings, fittings
from linkanim.picture.gears import WheelPair, pairs, teeth_a_second, wheel_layers, wheel_parts, wheels
from linkanim.picture.layout import gauge
from linkanim.picture.look import Look
from linkanim.picture.motion_marks import LONGEST, Trace, arrow_layers, arrows_of, traces
from linkanim.picture.picture import Picture
from linkanim.picture.raster import Layer, Loop, offscreen
from linkanim.picture.shapes import directions, folded
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.theme import DARK, LIGHT, Theme
from linkanim.picture.view import View
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

VIEW = View(1.0, 0.0, 0.0)
GAUGE = gauge(1.0, 100.0)


@pytest.fixture(scope="module")
def press() -> Figure:
    return figure(load("press"))


def _extent(layers: list[Layer], along: complex) -> tuple[float, float]:
    """Return how far layers reach along a direction."""
    points = np.concatenate([loop for layer in layers for loop in layer.loops])
    ways = (points * np.conj(along)).real
    return float(ways.min()), float(ways.max())


@pytest.mark.parametrize("length", [80.0, 100.0, 160.0])
def test_a_spring_reaches_from_joint_to_joint_at_any_length(press: Figure, length: float) -> None:
    coil = coils(DrawContext(press, VIEW, GAUGE, LIGHT))[0]
    turn = complex(math.cos(0.7), math.sin(0.7))
    layers = coil.layers({"C": 5 + 5j, "G": 5 + 5j + length * turn})
    low, high = _extent(layers, turn)
    wire = 3 * GAUGE.line
    assert low == pytest.approx((np.conj(turn) * (5 + 5j)).real, abs=wire)
    assert high - low == pytest.approx(length, abs=2 * wire)


def test_a_spring_s_pitch_follows_its_length_and_its_coils_stay(press: Figure) -> None:
    coil = coils(DrawContext(press, VIEW, GAUGE, LIGHT))[0]
    pitches, counts, ends = [], [], 2
    for length in (100.0, 150.0):
        core = coil.layers({"C": 0j, "G": complex(length, 0)})[-1]
        middles = np.array([loop.mean().real for loop in core.loops[ends:]])
        pitches.append(float(np.diff(middles).mean()))
        counts.append(len(core.loops) - ends)
    assert counts[0] == counts[1]
    assert pitches[1] - pitches[0] == pytest.approx(50 / counts[0], rel=1e-6)


def test_a_damper_s_piston_slides_inside_its_cylinder(press: Figure) -> None:
    cushion = dampings(DrawContext(press, VIEW, GAUGE, LIGHT))[0]
    one, other = cushion.between
    pistons = []
    for length in np.linspace(cushion.shortest, cushion.longest, 9):
        wall, _, _, piston = cushion.layers({one: 0j, other: complex(length, 0)})
        cylinder, head = _extent([wall], 1 + 0j), _extent([piston], 1 + 0j)
        assert cylinder[0] < head[0] < head[1] < cylinder[1]
        assert cylinder[1] < length
        pistons.append(head[0])
    assert np.all(np.diff(pistons) > 0)


def test_a_cylinder_is_longer_than_a_damper(press: Figure) -> None:
    still = "O2", "O7"
    dampers = Damper("ram", still), Damper("cushion", still, 200.0)
    shown = figure(replace(press.scene, linkage=replace(press.linkage, dampers=dampers)))
    cylinder, damper = dampings(DrawContext(shown, VIEW, GAUGE, LIGHT))
    assert cylinder.length > 2 * damper.length


def geared(
    ratio: Fraction = Fraction(1, 2),
    apart: tuple[float, float] = (100.0, 30.0),
    offset: float = 0.3,
    speed: float = 1.0,
    long: float = 30.0,
) -> Scene:
    """Return two cranks and nothing else, geared to each other."""
    joints = (
        Pin("O", (0.0, 0.0)),
        Pin("Q", apart),
        Crank("A", "O", long),
        Crank("D", "Q", long, Gear("A", ratio, offset)),
    )
    return Scene("geared", "Geared", "", "mm", Linkage(joints, Drive("A", speed, 0.2)))


def _profile(loop: Loop, centre: complex, direction: float) -> float:
    """Return how far a wheel's rim reaches from its centre in a direction."""
    angles = np.angle((loop - centre) * np.exp(-1j * direction))
    order = np.argsort(angles)
    return float(np.interp(0.0, angles[order], np.abs(loop - centre)[order]))


@pytest.mark.parametrize("ratio", [Fraction(-1), Fraction(-1, 3), Fraction(-5, 2)])
def test_gears_roll_on_each_other_and_their_teeth_mesh_at_every_angle(ratio: Fraction) -> None:
    scene = geared(ratio)
    shown = figure(scene)
    pair = pairs(shown)[0]
    assert pair.driver.radius + pair.driven.radius == pytest.approx(math.hypot(100, 30))
    assert pair.driver.radius / pair.driven.radius == pytest.approx(abs(ratio))
    assert Fraction(pair.driver.teeth, pair.driven.teeth) == abs(ratio)
    view = View(5.0, 0.0, 0.0)
    parts = wheel_parts(DrawContext(shown, view, GAUGE, LIGHT))[::2]
    for phase in np.linspace(0, 7, 40):
        pose = scene.pose(float(phase))
        places = {name: view.pixel(point) for name, point in pose.position.items()}
        rims = [part.placed(places)[0].loops[0] for part in parts]
        contact = float(np.angle(places["Q"] - places["O"]))
        reach = _profile(rims[0], places["O"], contact)
        reach += _profile(rims[1], places["Q"], contact + math.pi)
        # a tooth meets a gap: together they reach as far as the pivots are apart
        assert reach == pytest.approx(abs(places["Q"] - places["O"]), abs=0.35 * 2 * 5 * _module(pair))


@pytest.mark.thinned(2)
@pytest.mark.parametrize("ratio", [Fraction(-1), Fraction(-1, 3), Fraction(-5, 2), Fraction(-9)])
def test_teeth_touch_and_never_cut_into_each_other(ratio: Fraction) -> None:
    scene = geared(ratio)
    shown, view = figure(scene), View(5.0, 0.0, 0.0)
    parts = wheel_parts(DrawContext(shown, view, GAUGE, LIGHT))[::2]
    module = 5 * _module(pairs(shown)[0])
    for phase in np.linspace(0, 1.5, 40):
        pose = scene.pose(float(phase))
        places = {name: view.pixel(point) for name, point in pose.position.items()}
        one, other = (part.placed(places)[0].loops[0] for part in parts)
        gap = min(_gap(one, other), _gap(other, one))
        assert -0.05 * module < gap < 0.25 * module


def _gap(points: Loop, outline: Loop) -> float:
    """Return how far points stay off an outline; negative where one is inside."""
    sides, reach = np.roll(outline, -1) - outline, points[:, None] - outline
    inside = np.abs(np.angle((reach - sides) / reach).sum(axis=1)) > math.pi
    away = np.abs(reach - np.clip((reach / sides).real, 0, 1) * sides).min(axis=1)
    return float(np.min(np.where(inside, -away, away)))


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_two_wheels_are_told_apart_by_tone_and_outline(theme: Theme) -> None:
    parts = wheel_parts(DrawContext(figure(geared(Fraction(-1))), VIEW, GAUGE, theme))
    colours = [layer.colour for part in parts for layer in part.layers]
    tone, edge, hole, other, other_edge, _ = colours
    assert contrast(tone, other) > 1.25
    assert contrast(edge, other_edge) > 1.25
    for fill, line in ((tone, edge), (other, other_edge)):
        assert contrast(fill, line) > 1.8
    assert contrast(tone, hole) > 1.1


# few of wheels that turn fast, or they seem to turn back at 25 frames a second
@pytest.mark.parametrize(
    ("speed", "counts"),
    [
        (1.0, [(24, 24), (12, 36), (16, 32)]),
        (math.tau / 3, [(24, 24), (12, 36), (16, 32)]),
        (5.0, [(10, 10), (10, 30), (10, 20)]),
        (50.0, [(9, 9), (9, 27), (9, 18)]),
    ],
)
def test_wheels_have_as_many_teeth_as_can_be_followed(speed: float, counts: list[tuple[int, int]]) -> None:
    for ratio, wanted in zip((Fraction(-1), Fraction(-1, 3), Fraction(-1, 2)), counts, strict=True):
        shown = figure(geared(ratio, speed=speed))
        assert [(pair.driver.teeth, pair.driven.teeth) for pair in pairs(shown)] == [wanted]
        assert teeth_a_second(shown) < 25 / 3 or min(wanted) == 9


def test_wheels_that_would_dwarf_their_cranks_are_faint_rims_whose_low_teeth_mesh(press: Figure) -> None:
    (pair,) = pairs(press)
    assert (pair.driver.teeth, pair.driver.quiet, pair.belted) == (24, True, False)
    assert wheel_layers(DrawContext(press, VIEW, GAUGE, LIGHT)) == []
    parts = wheel_parts(DrawContext(press, VIEW, GAUGE, LIGHT))
    colours = [part.layers[0].colour for part in parts]
    assert all(contrast(one, LIGHT.background) < contrast(LIGHT.gear, LIGHT.background) for one in colours)
    for phase in np.linspace(0, 1.5, 20):
        places = {name: VIEW.pixel(at) for name, at in press.scene.pose(float(phase)).position.items()}
        one, other = (part.placed(places)[0].loops[0] for part in parts)
        gap = min(_gap(one, other), _gap(other, one)) / VIEW.scale
        assert -0.05 * _module(pair) < gap < 0.25 * _module(pair)


def test_wheels_larger_than_the_linkage_are_pitch_circles_whose_marks_meet() -> None:
    shown = figure(geared(Fraction(-9), long=4.0))
    (pair,) = pairs(shown)
    assert (pair.driver.teeth, pair.driver.pitch, pair.belted) == (0, True, False)
    dashes = [len(layer.loops) for layer in wheel_layers(DrawContext(shown, VIEW, GAUGE, LIGHT))]
    assert min(dashes) > 8
    places = {name: VIEW.pixel(point) for name, point in shown.scene.pose(0.0).position.items()}
    parts = wheel_parts(DrawContext(shown, VIEW, GAUGE, LIGHT))
    tips = [part.placed(places)[0].loops[0][0] for part in parts]
    assert abs(tips[0] - tips[1]) < 1e-6


def _module(pair: WheelPair) -> float:
    return 2 * pair.driver.radius / pair.driver.teeth


@pytest.mark.parametrize("ratio", [Fraction(1), Fraction(1, 2), Fraction(3)])
def test_cranks_that_turn_the_same_way_are_joined_by_a_belt(ratio: Fraction) -> None:
    shown = figure(geared(ratio))
    pair = pairs(shown)[0]
    assert pair.driver.teeth == pair.driven.teeth == 0
    assert pair.driver.radius / pair.driven.radius == pytest.approx(float(ratio))
    assert pair.driver.radius + pair.driven.radius < math.hypot(100, 30)
    discs_and_belt = wheel_layers(DrawContext(shown, View(5.0, 0.0, 0.0), GAUGE, LIGHT))
    assert [len(layer.loops) for layer in discs_and_belt] == [1, 1, 2]


def test_gears_on_one_pivot_have_nothing_to_show() -> None:
    assert pairs(figure(geared(Fraction(-1), apart=(0.0, 0.0)))) == ()


def test_wheels_are_part_of_what_must_be_seen(press: Figure) -> None:
    wide = of_linkage(press, GAUGE).box
    assert wide.left <= -165
    assert wide.high >= 165
    for wheel in wheels(press):
        middle = press.start(wheel.centre)
        assert wide.left <= middle.real - wheel.reach
        assert wide.high >= middle.imag + wheel.reach


@pytest.mark.parametrize("phase", [0.0, 0.001, 1.0, 6.2831, 50.0])
@pytest.mark.parametrize("forward", [True, False])
def test_the_recent_part_ends_at_the_joint_and_lies_on_the_curve(phase: float, forward: bool) -> None:
    scene = load("crank-rocker")
    trace = traces(DrawContext(figure(scene), VIEW, GAUGE, LIGHT))[0]
    place = VIEW.pixel(scene.pose(phase).position["P"])
    layers = trace.recent(phase, place, forward=forward)
    assert layers[-1].colour == trace.colour
    sign = 1 if forward else -1
    past = phase - sign * np.linspace(0, 0.3 * math.tau, 400)
    before = [VIEW.pixel(scene.pose(float(then)).position["P"]) for then in past]
    points = np.concatenate([layer.loops[0] for layer in layers])
    assert np.min(np.abs(layers[-1].loops[0] - place)) < trace.width
    nearest = np.abs(points[:, None] - np.array(before)[None, :]).min(axis=1)
    assert nearest.max() < 1.5 * trace.width


def _ages(trace: Trace, layers: list[Layer], phase: float) -> list[float]:
    """Return how long ago the joint was in the middle of each layer, in points of the path."""
    here = phase / trace.period * len(trace.path)
    path = np.roll(trace.path, -math.floor(here) - 1)[::-1]
    middles = [layer.loops[0].mean() for layer in layers]
    return [float(np.argmin(np.abs(path - middle))) for middle in middles]


def test_the_recent_part_brightens_towards_the_joint() -> None:
    trace, layers = _recent("crank-rocker", 1.0)
    away = [float(np.abs(np.subtract(layer.colour, trace.back)).sum()) for layer in layers]
    youngest_last = sorted(zip(_ages(trace, layers, 1.0), away, strict=True), reverse=True)
    assert [brightness for _, brightness in youngest_last] == sorted(set(away))
    assert len(set(away)) == len(layers)


@pytest.mark.parametrize("forward", [True, False])
def test_the_recent_part_has_no_gaps(forward: bool) -> None:
    trace, layers = _recent("crank-rocker", 1.0, forward=forward)
    by_shade = [next(layer for layer in layers if layer.colour == shade) for shade in trace.shades]
    for n, (older, younger) in enumerate(pairwise(by_shade)):
        # both edges run on below the one on top, from where that ends
        shared = np.isin(older.loops[0], younger.loops[0])
        assert shared.sum() >= 4, n


def _recent(name: str, phase: float, *, forward: bool = True) -> tuple[Trace, list[Layer]]:
    """Return the first trace of a scene in pixels, and its recent part."""
    scene = load(name)
    shown = figure(scene)
    view = View(100 / (shown.box.right - shown.box.left), 0.0, 0.0)
    trace = traces(DrawContext(shown, view, GAUGE, LIGHT))[0]
    place = view.pixel(scene.pose(phase).position[trace.joint])
    return trace, trace.recent(phase, place, forward=forward)


def _off(points: Loop, loop: Loop) -> float:
    """Return how far the farthest of the points lies from a loop's edges."""
    begin, along = loop, np.roll(loop, -1) - loop
    ways = points[:, None] - begin
    share = np.clip((ways * along.conj()).real / np.maximum(np.abs(along) ** 2, 1e-12), 0, 1)
    return float(np.abs(ways - share * along).min(axis=1).max())


@pytest.mark.parametrize("forward", [True, False])
@pytest.mark.parametrize("moment", [100, 431, 719])
def test_the_recent_part_s_end_does_not_jump_where_a_point_of_the_curve_is_passed(
    moment: int, forward: bool
) -> None:
    ends = [
        _recent("crank-rocker", (moment + off) / 720 * math.tau, forward=forward)[1][-1].loops[0]
        for off in (-1e-9, 0.0, 1e-9)
    ]
    # the corners at the joint: the last on the right, the first on the left
    tips = np.array([end[len(end) // 2 - 1 : len(end) // 2 + 1] for end in ends])
    assert np.abs(tips - tips[1]).max() < 1e-5


def test_a_traced_joint_at_rest_has_no_recent_part_to_be_seen() -> None:
    path = np.full(720, 10 + 10j)
    layers = Trace("P", path, math.tau, (255, 0, 0), (99, 0, 0), 3.0).recent(1.0, 10 + 10j, forward=True)
    assert {complex(point) for layer in layers for point in layer.loops[0]} == {10 + 10j}


@pytest.mark.parametrize("kind", ["v", "a"])
def test_vectors_keep_one_scale_over_the_cycle(press: Figure, kind: str) -> None:
    """The longest of the cycle is as long as was meant, and each is as long as its value says."""
    arrows = arrows_of(press, kind, 720, GAUGE, LIGHT)  # type: ignore[arg-type]
    scene = press.scene
    longest = 0.0
    for phase in np.linspace(0, scene.period, 720, endpoint=False):
        pose = scene.pose(float(phase))
        assert arrows.scale(pose.input_speed) == pytest.approx(arrows.longest / arrows.most)
        values = pose.velocity if kind == "v" else pose.acceleration
        masses = pose.com_velocity if kind == "v" else pose.com_acceleration
        sizes = [math.hypot(*values[joint]) for joint in press.moving]
        longest = max(longest, *sizes, *(math.hypot(*value) for value in masses.values()))
    assert longest * arrows.scale(scene.linkage.drive.speed) == pytest.approx(LONGEST * 720)


@pytest.mark.parametrize(("kind", "flips"), [("v", True), ("a", False)])
def test_another_speed_keeps_the_arrows_length_and_only_velocity_turns_with_it(
    press: Figure, kind: str, flips: bool
) -> None:
    arrows = arrows_of(press, kind, 720, GAUGE, LIGHT)  # type: ignore[arg-type]
    scene = press.scene
    drive = scene.linkage.drive.speed
    loops = [
        arrow_layers([arrows], scene.pose(1.0, speed=speed), VIEW, ("B",))[0][1].loops[0]
        for speed in (drive, -4 * drive)
    ]
    foot = VIEW.pixel(scene.pose(1.0).position["B"])
    reaches = [loop[3] - foot for loop in loops]
    assert reaches[1] == pytest.approx(-reaches[0] if flips else reaches[0])


@pytest.mark.thinned(5)
@pytest.mark.parametrize("name", names())
def test_every_moving_joint_has_its_arrow_and_no_other_is_named(name: str) -> None:
    """The slider, too; joints that lie on each other have one arrow. A name may find no room."""
    picture = Picture(load(name), (1280, 720), Look(vectors=frozenset("v")))
    pose, joints = picture.scene.pose(1.0), picture.figure.in_view
    group = next(group for group in picture.groups(pose) if group.name == "velocity")
    scale = picture.drawing.arrows[0].scale(pose.input_speed)
    long = [one for one in joints if scale * math.hypot(*pose.velocity[one]) > picture.layout.small_size]
    assert len(group.layers[-1].loops) >= len({pose.position[one] for one in long})
    named = {words.text for words in group.captions}
    assert named
    assert not any(indexed("v", joint) in named for joint in picture.figure.fixed)


def test_no_motion_has_no_arrows(press: Figure) -> None:
    arrows = arrows_of(press, "v", 720, GAUGE, LIGHT)
    assert arrow_layers([arrows], press.scene.pose(1.0, speed=0.0), VIEW, ("B",)) == [[]]


def test_a_moving_bar_s_pixels_follow_it_without_a_shiver() -> None:
    """Steps of a hundredth of a pixel move the picture's centre by as much, not by whole pixels."""
    scene = load("crank-rocker")
    size = (320, 180)
    painter = Picture(scene, size, Look(hud=False, trace=False))
    surface, centres, truth = offscreen(size), [], []
    colour = np.array(LIGHT.bodies[0], float)
    for step in range(24):
        pose = scene.pose(0.5 + 0.0006 * step)
        SurfacePrinter().paint(surface, painter, pose)
        near = np.clip(1 - np.abs(pixels(surface) - colour).sum(axis=-1) / 60, 0, 1)
        rows, columns = np.indices(near.shape)
        centres.append(complex((columns * near).sum(), (rows * near).sum()) / near.sum())
        truth.append(
            (complex(*painter.crank_pin_px(pose)) + complex(*painter.view.to_pixel(*pose.position["O2"]))) / 2
        )
    drift = np.array(centres) - np.array(truth)
    assert np.sqrt(np.mean(np.abs(drift - drift.mean()) ** 2)) <= 0.1


def test_a_spring_of_no_length_is_still_drawn(press: Figure) -> None:
    context = DrawContext(press, VIEW, GAUGE, LIGHT)
    items: list[Coil | Damping] = [*coils(context), *dampings(context)]
    for item in items:
        layers = item.layers(dict.fromkeys(item.between, 3 + 3j))
        assert all(np.isfinite(loop).all() for layer in layers for loop in layer.loops)


def test_a_spring_s_wire_ends_where_its_joints_are() -> None:
    coil = Coil(("A", "B"), 6.0, 20.0, 5, GAUGE, LIGHT)
    low, high = _extent(coil.layers({"A": 10 + 0j, "B": 110 + 0j}), 1 + 0j)
    assert (low, high) == pytest.approx((10, 110), abs=2 * coil.wire)


def test_a_longer_window_scales_the_gauge() -> None:
    small, large = gauge(0.5, 50.0), gauge(1.0, 100.0)
    assert large == replace(
        small, bar=2 * small.bar, outline=2 * small.outline, pin=2 * small.pin, line=2 * small.line
    )


def planetary(ratio: Fraction, arm: float = 40.0) -> Scene:
    joints = (Pin("O", (0.0, 0.0)), Crank("A", "O", arm), Crank("E", "A", 15.0, Gear("A", ratio)))
    return Scene("planet", "Planet", "", "mm", Linkage(joints, Drive("A", 1.0, 0.3)))


# Rolling without slip on what stands still: r of the planet, R of the ring (+) or sun (-), from the ratio.
@pytest.mark.parametrize(
    ("ratio", "planet", "still", "ring"),
    [
        pytest.param(Fraction(-1), 40.0, 80.0, True, id="Cardan's gears: half the ring"),
        pytest.param(Fraction(-3), 40 / 3, 160 / 3, True, id="a quarter of the ring"),
        pytest.param(Fraction(3), 40 / 3, 80 / 3, False, id="outside a sun twice as large"),
    ],
)
def test_a_planet_rolls_on_a_wheel_that_stands_still(
    ratio: Fraction, planet: float, still: float, ring: bool
) -> None:
    scene, view = planetary(ratio), View(5.0, 0.0, 0.0)
    shown = figure(scene)
    pair = pairs(shown)[0]
    assert pair.driven.radius == pytest.approx(planet)
    assert pair.driver.radius == pytest.approx(still)
    assert (pair.driver.arm, pair.driver.ring) == (None, ring)
    assert Fraction(pair.driver.teeth, pair.driven.teeth) == Fraction(still / planet).limit_denominator(9)
    outline = 0 if not ring else 1
    fixed = wheel_layers(DrawContext(shown, view, GAUGE, LIGHT))[0].loops[outline]
    planet_part, *_ = wheel_parts(DrawContext(shown, view, GAUGE, LIGHT))
    for phase in np.linspace(0, 7, 30):
        places = {name: view.pixel(point) for name, point in scene.pose(float(phase)).position.items()}
        rolling = planet_part.placed(places)[0].loops[0]
        contact = float(np.angle(places["A"] - places["O"]))
        toward = contact if ring else contact + math.pi
        reach = _profile(rolling, places["A"], toward) * (1 if ring else -1) + abs(places["A"] - places["O"])
        # a tooth meets a gap: the two rims lie upon each other where they touch
        assert reach == pytest.approx(_profile(fixed, places["O"], contact), abs=0.35 * 10 * _module(pair))


def test_a_planet_that_keeps_its_arm_s_turning_has_no_wheels_and_a_slower_one_a_belt() -> None:
    assert pairs(figure(planetary(Fraction(1)))) == ()
    pair = pairs(figure(planetary(Fraction(1, 2))))[0]
    assert (pair.driver.teeth, pair.driven.teeth) == (0, 0)
    assert pair.driver.radius / pair.driven.radius == pytest.approx(0.5)
    # The belt's two runs touch both pulleys.
    shown, view = figure(planetary(Fraction(1, 2))), View(5.0, 0.0, 0.0)
    *_, belt = wheel_parts(DrawContext(shown, view, GAUGE, LIGHT))
    far = 5 * abs(shown.start(pair.driven.centre) - shown.start(pair.driver.centre))
    assert len(belt.layers[0].loops) == 2
    for run in belt.layers[0].loops:
        away = [np.abs(run - centre).min() for centre in (0.0, far)]
        radii = [5 * wheel.radius for wheel in (pair.driver, pair.driven)]
        assert away == pytest.approx(radii, abs=GAUGE.line)


def test_a_ring_is_part_of_what_must_be_seen() -> None:
    shown = figure(planetary(Fraction(-1)))
    assert of_linkage(shown, GAUGE).box.right > 80.0


def _carried(offset: float) -> DrawContext:
    """Return how a linkage is drawn whose coupler carries a line, straight along it or aside."""
    text = f"""
        title = "t"
        [four-bar]
        ground = 100
        crank = 30
        coupler = 90
        rocker = 80
        [ground]
        O6 = [60, -40]
        [joints.C]
        from = "O6"
        length = 130
        line = {{ on = ["A", "B"], through = "A", angle = "0 deg", offset = {offset} }}
    """
    shown = figure(scene_from(tomllib.loads(text), name="t", where="t.toml"))
    return DrawContext(shown, View(2.0, 0.0, 0.0), GAUGE, LIGHT)


def _slid(bench: DrawContext) -> tuple[float, float]:
    """Return from where to where the pin goes along the coupler, in pixels."""
    places = bench.figure.cycle.position
    axis, away = places["B"] - places["A"], places["C"] - places["A"]
    along = 2.0 * (away * axis).sum(axis=-1) / np.hypot(*axis.T)
    return along.min(), along.max()


def test_a_carried_slot_that_lies_aside_is_as_long_as_its_pin_goes_and_has_an_arm() -> None:
    bench = _carried(10)
    (fitting,) = (found for found in fittings(bench) if found.before)
    (bar,), (slot, _) = fitting.behind, fitting.before
    near, far = _slid(bench)
    wide, edge = 0.5 * GAUGE.bar, np.concatenate(slot.layers[0].loops)
    assert [edge.real.min(), edge.real.max()] == pytest.approx([near - wide, far + wide])
    assert [edge.imag.min(), edge.imag.max()] == pytest.approx([-20 - wide, -20 + wide])
    assert len(bar.layers) == 4


def test_a_carried_slot_along_a_bar_s_own_axis_is_in_that_bar() -> None:
    bench = _carried(0)
    (fitting,) = (found for found in fittings(bench) if found.before)
    assert not fitting.behind
    assert fitting.bar
    assert fitting.bar.ends == ("A", "B")
    assert fitting.bar.slot == pytest.approx(_slid(bench))


def test_a_block_on_two_bars_has_a_slot_in_each_and_their_pivots_are_seen_in_them() -> None:
    bench = DrawContext(figure(load("oldham")), View(2.0, 0.0, 0.0), GAUGE, LIGHT)
    bars = [found.bar for found in fittings(bench) if found.bar]
    assert [bar.ends for bar in bars] == [("O2", "A"), ("O4", "B")]
    for bar in bars:
        assert bar.slot == pytest.approx((-60, 60), abs=1e-6)
    slotted = [part for part in body_parts(bench) if part.reaches == ("M",)]
    assert [part.joints for part in slotted] == [("O2", "A"), ("O4", "B")]


@pytest.mark.parametrize(
    ("scene", "folds"),
    [
        # the rims of two wheels that mesh, and their holes; two pulleys have as many corners instead of teeth
        (geared(Fraction(-1, 3)), [12, 5, 36, 5]),
        (geared(Fraction(1, 2)), [63, 5, 88, 5]),
        # a planet goes round: it never looks the same again
        (planetary(Fraction(-3)), [1, 1]),
    ],
)
def test_a_wheel_looks_the_same_again_a_tooth_further(scene: Scene, folds: list[int]) -> None:
    parts = wheel_parts(DrawContext(figure(scene), VIEW, GAUGE, LIGHT))
    assert sorted(part.fold for part in parts) == sorted(folds)


@pytest.mark.parametrize("fold", [3, 5, 12])
@pytest.mark.parametrize("angle", [0.0, 0.4, 3.0, -2.9])
def test_a_direction_is_folded_to_the_same_one_a_part_of_a_turn_further(fold: int, angle: float) -> None:
    turn = complex(directions(angle))
    found = folded(turn, fold)
    assert abs(found) == pytest.approx(1.0, abs=1e-15)
    assert abs(math.atan2(found.imag, found.real)) <= math.pi / fold + 1e-6
    # the rounding is a ten-millionth of the radius
    assert abs(found**fold - turn**fold) < fold * 1e-7
    for part in range(fold):
        assert folded(turn * complex(directions(2 * math.pi * part / fold)), fold) == found


# its accelerations at this pose are a tenth of those of its cycle
def test_arrows_of_a_still_are_to_its_own_scale_and_named_off_the_bars() -> None:
    scene, phase = load("jansen"), 0.0
    pose = scene.pose(phase, 2)
    look = Look(hud=False, vectors=frozenset("a"))
    still, moving = (Picture(scene, (1280, 720), look, moment=moment) for moment in (phase, None))
    longest = [
        max(
            abs(seen.reach)
            for seen in picture.drawing.arrows[0].seen(pose, picture.view, picture.figure.moving)
        )
        for picture in (still, moving)
    ]
    assert longest[0] < LONGEST * 720
    assert longest[1] < 0.5 * longest[0]
