"""Names stand still or glide, lie on nothing that matters, and say what the scene says."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from pictures import BARE, labelled, painted, pixels, standing

from linkanim.picture.bodies import WHEELS
from linkanim.picture.dimensions import leg_part, symbols
from linkanim.picture.figure import figure
from linkanim.picture.layout import Gauge
from linkanim.picture.look import Look
from linkanim.picture.motion_marks import Sliding, Turning
from linkanim.picture.picture import Deferral, Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.stills import default_phase
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import Lettering, Type, subscripted
from linkanim.picture.view import Rect, View
from linkanim.scenes import load, names
from linkanim.scenes.editing import with_dimensions
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

SIZES = [(320, 180), (1280, 720), (720, 1280)]


def _gap(one: Rect, other: Rect) -> float:
    """Return how far two rectangles are apart; negative where they overlap."""
    across = max(one.x - other.right, other.x - one.right)
    return max(across, one.y - other.bottom, other.y - one.bottom)


@pytest.mark.thinned(4)
@pytest.mark.parametrize(
    ("name", "size"),
    [(name, SIZES[1]) for name in names()]
    + [(name, size) for name in ("press", "kite") for size in SIZES[::2]],
)
@pytest.mark.sampled
def test_no_name_ever_lies_on_another_or_on_a_pin_or_in_the_hud(name: str, size: tuple[int, int]) -> None:
    scene = load(name)
    painter = Picture(scene, size, Look(names=1, chart="A.velocity" if name == "press" else None))
    gauge, words, reach = painter.drawing.setting.gauge, painter.layout.words, painter.layout.reach
    assert words
    for phase in np.linspace(0, scene.period, 10):
        pose = scene.pose(float(phase))
        labels = list(standing(painter, pose))
        pins = [painter.drawing.places(pose)[pin] for pin in painter.figure.pins]
        for (one, box), (other, second) in combinations(labels, 2):
            assert _gap(box, second) > -1.0, (one, other, phase)
        for text, box in labels:
            assert all(_gap(box, rect) > -1.0 for rect in words), text
            assert 0 <= box.x < box.right <= reach.right, text
            assert 0 <= box.y < box.bottom <= reach.bottom, text
            for pin in pins:
                x, y = min(max(pin.real, box.x), box.right), min(max(pin.imag, box.y), box.bottom)
                assert abs(pin - complex(x, y)) > gauge.pin - 1.0, (text, phase)


# what reaches beyond its joints: a yoke's bar, an arm that bends in a joint and ends in a pad
BEYOND = [("scotch-yoke", "r₂ = 80 mm", "fitting-Y"), ("toggle-clamp", "O₆", "body-arm")]


@pytest.mark.thinned(2)
@pytest.mark.parametrize(("name", "text", "part"), BEYOND)
def test_words_of_a_still_lie_on_nothing_that_reaches_beyond_its_joints(
    name: str, text: str, part: str
) -> None:
    scene = load(name)
    phase = default_phase(scene)
    painter, pose = Picture(scene, (1280, 720), Look(names=2), moment=phase), scene.pose(phase)
    (box,) = (box for said, box in standing(painter, pose) if subscripted(said) == subscripted(text))
    ((layers),) = (group.layers for group in painter.drawing.moving(pose) if group.name == part)
    for loop in (loop for layer in layers for loop in layer.loops):
        sides = zip(loop, np.roll(loop, -1), strict=True)
        assert not any(box.crossed(complex(one), complex(other)) for one, other in sides)


# scene, how the words begin: a length stands by the middle of its rod, also where that is at a rim
RIMS = [("parallel-locomotive", "r₁"), ("engine", ""), ("landing-gear", "")]


@pytest.mark.thinned(3)
@pytest.mark.parametrize(("name", "said"), RIMS)
def test_no_word_of_a_still_lies_on_the_rim_of_a_wheel(name: str, said: str) -> None:
    scene = load(name)
    for phase in (default_phase(scene), 1.0):
        painter, pose = Picture(scene, (1280, 720), Look(names=2), moment=phase), scene.pose(phase)
        places = painter.drawing.places(pose)
        for body in painter.figure.bodies:
            style = scene.style(body.name)
            if style.outline in WHEELS:
                (part,) = (one for one in painter.drawing.parts.bodies if one.name == body.name)
                radius, at = max(np.abs(part.layers[1].loops[0])), places[body.joints[0]]
                for text, box in standing(painter, pose):
                    if not text.startswith(said):
                        continue
                    near = (
                        max(box.x - at.real, at.real - box.right, 0),
                        max(box.y - at.imag, at.imag - box.bottom, 0),
                    )
                    corners = [
                        abs(complex(x, y) - at) for x in (box.x, box.right) for y in (box.y, box.bottom)
                    ]
                    rim = radius - 0.5 * painter.gauge.bar
                    assert not np.hypot(*near) < rim < max(corners), text


@pytest.mark.long
def test_a_plate_too_slender_for_its_name_has_it_outside() -> None:
    scene = load("excavator")
    phase = default_phase(scene)
    painter = Picture(scene, (1280, 720), Look(names=1), moment=phase)
    said = {text for text, _ in standing(painter, scene.pose(phase))}
    assert {"boom", "stick", "bucket"} <= said


@pytest.mark.parametrize("name", ["watt-line", "roberts-line", "rocker-driven", "crank-rocker"])
def test_the_angle_s_arc_runs_as_far_as_the_hud_says(name: str) -> None:
    """Also below the horizontal, where a swing's angle is negative; its symbol stays at the arc."""
    scene = load(name)
    painter = Picture(scene, (1280, 720), Look(names=2))
    turning, swings = painter.drawing.parts.turning, not scene.info.full_turn
    assert isinstance(turning, Turning)
    for phase in np.linspace(0.1, 6.2, 9):
        angle = scene.pose(float(phase)).coordinate
        assert turning.turned(angle + math.tau) == pytest.approx(angle if swings else angle % math.tau)
    for phase in np.linspace(0, math.tau, 9):
        pose = scene.pose(float(phase))
        places = painter.drawing.places(pose)
        for label, middle, shown in labelled(painter).standing(pose, places):
            away = abs(middle - places[turning.pivot])
            assert label.text not in ("θ₂", "θ₄") or not shown or away < turning.arc + 1.5 * label.size[1]


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", ["crank-rocker", "press", "double-rocker", "kite"])
def test_no_name_jumps_from_frame_to_frame(name: str) -> None:
    """It goes along with what it names, and comes and goes in some frames."""
    scene = load(name)
    picture = Picture(scene, (1280, 720), Look(names=2))
    names, steps = labelled(picture), round(300 * scene.period / math.tau)
    poses = [scene.pose(scene.period * step / steps) for step in range(steps + 1)]
    seen = [list(names.standing(pose, picture.drawing.places(pose))) for pose in poses]
    for n, label in enumerate(names.labels):
        assert label.spot
        ends = [
            [picture.drawing.places(pose)[joint] for pose in poses]
            for joint in (label.spot.at, label.spot.head)
        ]
        farthest = np.abs(np.diff(ends)).max() + 0.02 * label.size[0]
        assert np.abs(np.diff([frame[n][1] for frame in seen])).max() < 1.5 * farthest + 1.0, label.text
        assert np.abs(np.diff([frame[n][2] for frame in seen])).max() < 0.2, label.text
        assert seen[0][n][1:] == pytest.approx(seen[-1][n][1:])


@pytest.mark.parametrize(
    "name", ["crank-rocker", "double-rocker", "slider-crank", "six-bar", "press", "kite"]
)
def test_every_joint_and_link_is_named_for_most_of_the_cycle(name: str) -> None:
    scene = load(name)
    labels = labelled(Picture(scene, (1280, 720), Look(names=1))).labels
    shown: dict[str, float] = {}
    for label in labels:
        assert label.shown is not None
        shown[label.text] = shown.get(label.text, 0.0) + float(label.shown.mean())
    joints = {joint.replace("2", "₂").replace("4", "₄") for joint in ("O2", "A", "B")}
    assert joints <= shown.keys()
    for body, number in figure(scene).numbers.items():
        assert {figure(scene).links[body], number} & shown.keys(), body.name
    assert np.mean(list(shown.values())) > 0.75


def test_a_crank_that_is_part_of_a_plate_has_the_plates_number() -> None:
    document = {
        "ground": {"O2": [0, 0]},
        "joints": {
            "A": {"crank": "O2", "length": 78},
            "D": {"from": ["O2", "A"], "length": [31.4, 79.5]},
        },
        "bodies": {"arm": {"joints": ["O2", "A"]}},
    }
    assert symbols(figure(scene_from(document, name="my", where="my.toml"))).input == "θ₂"


def _table(scene: Scene) -> dict[str, float]:
    known = symbols(figure(scene))
    return {one.symbol: one.value for one in known.dimensions} | {known.input: 0.0}


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("crank-rocker", {"r₁": 100, "r₂": 50, "r₃": 85, "r₄": 80, "r₅": 80, "r₆": 70, "θ₂": 0}),
        # as in its file: r5 from O4 to O6, r6 fixed to the rocker
        ("six-bar", {"r₁": 100, "r₂": 45, "r₃": 90, "r₄": 80, "r₅": 140, "r₆": 70, "r₇": 120, "r₈": 90}),
        # links that have numbers keep them; the ground is from pivot to pivot
        ("press", {"r₁": 330, "r₂": 55, "r₃": 283, "r₄": 322, "r₆": 165, "r₇": 61, "θ₁": -107.47, "θ₂": 0}),
        # the driven bar is link 4
        ("rocker-driven", {"r₁": 130, "r₂": 100, "r₃": 140, "r₄": 140, "θ₄": 0}),
    ],
)
def test_the_symbols_are_the_textbook_s(name: str, wanted: dict[str, float]) -> None:
    found = _table(load(name))
    assert {symbol: found[symbol] for symbol in wanted} == pytest.approx(wanted)
    if name == "press":
        assert found.keys() == wanted.keys()


def test_dimensions_and_the_angle_come_with_the_second_level() -> None:
    scene = load("crank-rocker")
    one, two = (labelled(Picture(scene, (1280, 720), Look(names=level))).labels for level in (1, 2))
    words = {label.text for label in two} - {label.text for label in one}
    table = labelled(Picture(scene, (1280, 720), Look(names=2))).table
    rows = {label.text for label in table.rows} if table else set()
    stated = {f"r{'₀₁₂₃₄₅₆'[n]} = {value} mm" for n, value in enumerate((0, 100, 50, 85, 80, 80, 70)) if n}
    assert words | rows == stated | {"θ₂"}


def test_a_link_whose_bar_is_short_is_called_by_its_number_and_no_other() -> None:
    scene = load("crank-rocker")
    texts = {label.text for label in labelled(Picture(scene, (320, 180), Look(names=1))).labels}
    assert {"3", "rocker"} <= texts
    assert list(figure(load("press")).numbers.values()) == ["2", "3", "4", "5", "6", "7"]


@pytest.mark.parametrize("name", ["crank-rocker", "double-rocker"])
def test_the_arrow_bends_the_way_the_input_turns_and_turns_over_with_it(name: str) -> None:
    scene = load(name)
    painter = Picture(scene, (1280, 720), replace(BARE, names=1))
    turning, drive = painter.drawing.parts.turning, scene.linkage.drive
    assert isinstance(turning, Turning)
    for phase, speed in ((1.0, drive.speed), (1.0, -drive.speed), (4.0, 3 * drive.speed)):
        pose = scene.pose(phase, speed=speed)
        places = painter.drawing.places(pose)
        line = turning.direction(pose, places, abs(drive.speed / speed))[-1]
        centre, tip = places[turning.pivot], line.loops[-1][0]
        bar = places[turning.pin] - centre
        ahead = -np.angle((tip - centre) / bar)
        assert np.sign(ahead) == np.sign(pose.coordinate_rate)
        assert 0.2 < abs(ahead) < 2.2


def test_the_arrow_runs_the_way_the_driven_slider_does() -> None:
    scene = load("driven-piston")
    painter = Picture(scene, (1280, 720), replace(BARE, names=2))
    sliding, drive = painter.drawing.parts.turning, scene.linkage.drive
    assert isinstance(sliding, Sliding)
    for phase, speed in ((1.0, drive.speed), (1.0, -drive.speed), (4.0, 3 * drive.speed)):
        pose = scene.pose(phase, speed=speed)
        places = painter.drawing.places(pose)
        line = sliding.direction(pose, places, abs(drive.speed / speed))[-1]
        ahead = line.loops[0].real - places["C"].real
        assert np.sign(ahead).tolist() == [np.sign(pose.coordinate_rate)] * len(ahead)
        assert np.abs(ahead).min() > 2 * sliding.gauge.bar  # off its block
        assert np.ptp(ahead) > 3 * sliding.gauge.bar
    assert not sliding.direction(scene.pose(0.0), painter.drawing.places(scene.pose(0.0)), 1.0)


@pytest.mark.parametrize("line", [0.7, 1.4, 3.0])
def test_a_leg_s_dashes_lead_to_its_point_and_stand_apart(line: float) -> None:
    shown = figure(load("crank-rocker"))
    view, thick = View(4.0, 0.0, 0.0), Gauge(8.0, 1.0, 3.0, line)
    (point,) = symbols(shown).points
    (layer,) = leg_part(point, view, thick, (0, 0, 0)).layers
    along, left = (4.0 * place for place in point.at)
    corners = np.concatenate(layer.loops)
    assert np.abs(corners - complex(along, -left)).min() < 4 * line
    assert np.abs(corners.real).max() < along + 4 * line
    assert np.abs(corners.imag).max() < abs(left) + 4 * line
    drawn = sum(np.ptp(loop.real) + np.ptp(loop.imag) - 0.9 * line for loop in layer.loops)
    assert 0.4 < drawn / (along + abs(left)) < 0.8


@pytest.mark.parametrize("line", [0.7, 1.4, 3.0])
def test_the_angle_is_measured_from_a_line_of_dashes(line: float) -> None:
    scene = load("crank-rocker")
    turning = Picture(scene, (1280, 720), replace(BARE, names=2)).drawing.parts.turning
    assert isinstance(turning, Turning)
    turning = replace(turning, gauge=replace(turning.gauge, line=line))
    _, ink = turning.angle({turning.pivot: 0j, turning.pin: 100j})
    dashes = [loop.real for loop in ink.loops if np.ptp(loop.imag) < line]
    assert dashes
    drawn = sum(map(np.ptp, dashes))
    assert 0.4 < drawn / (1.45 * turning.arc) < 0.8


def test_words_in_a_file_stand_as_high_as_on_the_picture() -> None:
    scene = load("crank-rocker")
    painter = Picture(scene, (1280, 720), Look(names=1))
    pose = scene.pose(1.0)
    found = dict(standing(painter, pose))
    captions = labelled(painter).captions(pose, painter.drawing.places(pose))
    assert len(captions) > 5
    for caption in captions:
        box = found[caption.text]
        assert box.y - 0.5 * caption.size < caption.at[1] < box.y + 0.5 * caption.size


def test_an_input_that_stands_still_has_no_arrow() -> None:
    scene = load("crank-rocker")
    painter = Picture(scene, (640, 360), replace(BARE, names=1))
    SurfacePrinter().paint(offscreen((640, 360)), painter, scene.pose(1.0, speed=0.0))
    turning, still = painter.drawing.parts.turning, scene.pose(1.0, speed=0.0)
    assert turning
    assert turning.direction(still, painter.drawing.places(still), 1.0) == []


def test_the_ground_line_runs_from_pivot_to_pivot() -> None:
    scene, size = load("crank-rocker"), (640, 360)
    view = Picture(scene, size, BARE).view
    with_line, without = (pixels(painted(scene, 1.0, replace(BARE, names=level), size)) for level in (1, 0))
    (x0, y), (x1, _) = view.to_pixel(0, 0), view.to_pixel(100, 0)
    row = slice(round(y) - 1, round(y) + 1)
    between = np.abs(with_line - without).max(axis=-1)[row, round(x0) + 30 : round(x1) - 30]
    assert 0.4 < (between > 20).any(axis=0).mean() < 0.95


@pytest.mark.parametrize("shown", [0.0, 0.25, 1.0])
def test_a_name_that_fades_lies_as_faintly_over_what_is_behind(shown: float) -> None:
    lettering, surface = Lettering("O", Type(), 20, ((0, 0, 0), (0, 0, 0)), 2.0), offscreen((60, 40))
    for strength in (1.0, shown):
        surface.fill((200, 200, 200))
        lettering.draw(surface, 30 + 20j, strength)
    darkest = min(surface.get_at((x, y)).r for x in range(60) for y in range(40))
    assert darkest == pytest.approx(200 * (1 - shown), abs=3)


def test_words_glide_by_quarters_of_a_pixel() -> None:
    lettering = Lettering("O₂", Type(), 20, ((0, 0, 0), (255, 255, 255)), 2.0)
    centres = []
    for step in range(9):
        surface = offscreen((80, 60))
        surface.fill((128, 128, 128))
        lettering.draw(surface, 40.0 + step / 8 + 30j)
        dark = np.clip(128 - pixels(surface)[..., 0], 0, None)
        centres.append((np.indices(dark.shape)[1] * dark).sum() / dark.sum())
    steps = np.diff(centres)
    assert centres[-1] - centres[0] == pytest.approx(1.0, abs=0.02)
    assert steps.max() < 0.3


def _spots(picture: Picture) -> list[object]:
    return [label.spot for label in labelled(picture).labels]


@pytest.mark.parametrize("level", [1, 2])
def test_another_theme_places_no_name_anew_and_shows_the_same_as_if_it_did(level: int) -> None:
    scene, size, look = load("press"), (640, 360), Look(names=level)
    dark, first = replace(look, theme="dark"), Picture(scene, size, look)
    taken, anew = Picture(scene, size, dark, first), Picture(scene, size, dark)
    assert all(one is other for one, other in zip(_spots(first), _spots(taken), strict=True))
    surfaces = [offscreen(size) for _ in "tn"]
    for surface, picture in zip(surfaces, (taken, anew), strict=True):
        SurfacePrinter().paint(surface, picture, scene.pose(1.0))
    assert np.array_equal(pixels(surfaces[0]), pixels(surfaces[1]))


def test_zooming_panning_and_gliding_place_no_name_anew() -> None:
    scene, size, look = load("press"), (640, 360), Look(names=1)
    first = Picture(scene, size, look)
    near = Picture(scene, size, replace(look, zoom=2.0, pan=(0.1, 0.2)), Picture(scene, size, look, first))
    on_its_way = Picture(replace(scene, towards=scene), size, look, first)
    for other in (near, on_its_way):
        assert [label.text for label in labelled(other).labels] == [
            label.text for label in labelled(first).labels
        ]
    assert all(one is other for one, other in zip(_spots(first), _spots(on_its_way), strict=True))


def test_while_the_hand_holds_a_joint_names_keep_their_places_and_lengths_are_told_anew() -> None:
    scene, size, look = load("crank-rocker"), (1280, 720), Look(names=2)
    longer = with_dimensions(scene, {("four-bar", "rocker"): 85.0})
    before = Picture(scene, size, look)
    held, free = (Picture(longer, size, look, before, later=Deferral(held)) for held in (True, False))
    assert all(one is other for one, other in zip(_spots(before), _spots(held), strict=True))
    assert not any(one is other for one, other in zip(_spots(before), _spots(free), strict=False))
    for picture in (held, free):
        names = labelled(picture)
        rows = [label.row for label in names.table.rows] if names.table else ()
        assert any(text.startswith("r₄ = 85 mm") for text in (*(label.text for label in names.labels), *rows))


def test_a_name_keeps_its_place_on_its_link_in_an_enlarged_view() -> None:
    scene, size = load("crank-rocker"), (1280, 720)
    pose = scene.pose(1.0)
    shares = []
    for zoom in (1.5, 2.5):
        painter = Picture(scene, size, Look(names=1, zoom=zoom))
        places = painter.drawing.places(pose)
        found = labelled(painter).standing(pose, places)
        middle = next(middle for label, middle, _ in found if label.text == "crank")
        shares.append((middle - places["O2"]) / (places["A"] - places["O2"]))
    assert shares[0].real == pytest.approx(shares[1].real)
    assert 0 < shares[0].real < 1
    joints = {label.text for label in labelled(painter).labels}
    assert {"O₂", "A", "B", "O₄", "P"} <= joints


@pytest.mark.parametrize("far", [1e6, 1e12, 1e300, math.inf, math.nan])
def test_words_far_beyond_a_picture_are_not_drawn(far: float) -> None:
    lettering, surface = Lettering("O", Type(), 20, ((0, 0, 0), (0, 0, 0)), 2.0), offscreen((60, 40))
    surface.fill((200, 200, 200))
    bare = pixels(surface).tobytes()
    for middle in (complex(far, 20), complex(30, -far), complex(-far, far)):
        lettering.draw(surface, middle)
    assert pixels(surface).tobytes() == bare


def test_words_at_an_edge_are_drawn_as_far_as_they_are_seen() -> None:
    lettering = Lettering("OOO", Type(), 20, ((0, 0, 0), (0, 0, 0)), 2.0)
    wide = lettering.size[0] / 2
    for x in (4 - wide, 56 + wide):
        surface = offscreen((60, 40))
        surface.fill((200, 200, 200))
        bare = pixels(surface).tobytes()
        lettering.draw(surface, complex(x, 20))
        assert pixels(surface).tobytes() != bare


@pytest.mark.thinned(7)
@pytest.mark.parametrize("size", [(640, 360), (1280, 720)])
@pytest.mark.parametrize("level", [1, 2])
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_fixed_pins_bear_their_letters_all_the_time(name: str, level: int, size: tuple[int, int]) -> None:
    scene = load(name)
    picture = Picture(scene, size, Look(names=level, caption=True))
    assert picture.names
    for phase in np.linspace(0.0, scene.period, 72, endpoint=False):
        pose = scene.pose(float(phase))
        places = picture.drawing.places(pose)
        captions = picture.names.captions(pose, places)
        for pin in picture.figure.fixed:
            own = [one for one in captions if one.text == subscripted(pin)]
            assert sum(one.strength for one in own) > 0.5, (pin, phase)
            for one in own:
                middle = complex(one.at[0], one.at[1] + 0.5 * one.size)
                away = {joint: abs(places[joint] - middle) for joint in picture.figure.fixed}
                assert min(away, key=lambda joint: away[joint]) == pin or away[pin] < 4 * one.size


def test_dimensions_in_a_table_give_way_to_centres_that_are_named_alone() -> None:
    scene = load("jansen")
    before = Picture(scene, (320, 180), Look(names=2))
    assert before.fit.request.table[0]
    after = Picture(scene, (320, 180), Look(centres=1), before, later=Deferral(names="as before"))
    assert after.drawing.symbols is None
