"""Class, range, change points and circuits of linkages by their lengths."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from build import four_bar, six_bar, slider_crank, slotted, with_joints

from linkanim.errors import AssemblyError
from linkanim.mechanics.analysis import Info
from linkanim.mechanics.linkage import RPR, RRR, Body, Crank, Drive, Gear, Linkage, Pin, Polar, Rigid
from linkanim.mechanics.motion import mechanism
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.toml import parse

# Ground, crank, coupler, rocker -> class, whether the crank turns, circuits.
CLASSES = [
    # Grashof: named by the shortest link.
    ((100, 30, 90, 80), "Grashof crank-rocker", True, 2),
    ((30, 60, 70, 80), "Grashof drag-link (double crank)", True, 2),
    ((100, 80, 30, 90), "Grashof double-rocker", False, 2),
    ((100, 80, 90, 30), "Grashof crank-rocker driven at its rocker", False, 2),
    # Not Grashof: named by the longest link.
    ((100, 80, 60, 50), "triple-rocker (outward/outward)", False, 1),
    ((70, 100, 60, 50), "triple-rocker (outward/inward)", False, 1),
    ((70, 60, 50, 100), "triple-rocker (inward/outward)", False, 1),
    ((60, 70, 100, 50), "triple-rocker (inward/inward)", False, 1),
    # Change points: s + l = p + q.
    ((4, 2, 4, 2), "parallelogram", True, 1),
    ((4, 2, 5, 3), "change-point crank-rocker", True, 1),
    ((3, 3, 5, 5), "kite (change point)", True, 1),
    ((5, 3, 3, 5), "kite (change point)", True, 1),
]


@pytest.mark.parametrize(("lengths", "name", "turns", "circuits"), CLASSES)
def test_a_four_bar_is_classed_by_its_lengths(
    lengths: tuple[float, float, float, float], name: str, turns: bool, circuits: int
) -> None:
    info = Info(mechanism(four_bar(lengths)), "mm")
    assert (info.class_name, info.full_turn, info.circuits) == (name, turns, circuits)


@pytest.mark.parametrize("lengths", [(100.0, 80.0, 30.0, 90.0), (100.0, 80.0, 90.0, 30.0)], ids=str)
def test_the_class_is_the_same_from_whichever_end_the_bars_are_written(
    lengths: tuple[float, float, float, float],
) -> None:
    linkage = four_bar(lengths)
    other = RRR("B", ("O4", "A"), lengths[:1:-1], -1)
    turned = replace(linkage, joints=(*linkage.joints[:3], other, *linkage.joints[4:]))
    assert Info(mechanism(turned), "mm").class_name == Info(mechanism(linkage), "mm").class_name


def test_the_crossed_parallelogram_is_the_antiparallelogram() -> None:
    assert Info(mechanism(four_bar((4, 2, 4, 2), side=-1)), "mm").class_name == "antiparallelogram"


# The first report's limits: acos((r1² + r2² - (r3 ± r4)²) / 2 r1 r2).
def test_input_limits_are_the_cosine_rule_s() -> None:
    g, r, a, b = 100.0, 80.0, 30.0, 90.0
    info = Info(mechanism(four_bar((g, r, a, b))), "mm")
    ends = [math.acos((g * g + r * r - (a + s * b) ** 2) / (2 * g * r)) for s in (-1, 1)]
    assert info.input_range == pytest.approx(ends, rel=1e-14)
    assert info.toggles == info.input_range


# Ground, crank, coupler, rocker of a swing about the ground line, and of one above it.
@pytest.mark.parametrize("lengths", [(100, 80, 60, 50), (100, 80, 30, 90)])
@pytest.mark.parametrize("degrees", [180, 130, 0, -40, -180])
def test_the_range_is_the_same_from_whichever_end_the_ground_is_written(
    lengths: tuple[float, float, float, float], degrees: float
) -> None:
    angle = math.radians(degrees)
    back = math.remainder(angle + math.pi, 2 * math.pi)
    plain = four_bar(lengths, ground_angle=back)
    o2, o4 = plain.joints[:2]
    assert isinstance(o2, Pin)
    assert isinstance(o4, Pin)
    turned = (replace(o2, polar=Polar(lengths[0], angle, "O4")), replace(o4, polar=None))
    written = Info(mechanism(replace(plain, joints=(*turned, *plain.joints[2:]))), "mm")
    assert written.input_range == pytest.approx(Info(mechanism(plain), "mm").input_range, abs=1e-12)


def test_change_points_are_told_as_crank_angles() -> None:
    both = Info(mechanism(four_bar((4, 2, 4, 2), ground_angle=0.25)), "mm")
    assert sorted(both.change_points) == pytest.approx([0.25, 0.25 + math.pi])
    assert Info(mechanism(four_bar((4, 2, 5, 3))), "mm").change_points == pytest.approx((0.0,))
    assert Info(mechanism(four_bar((100, 30, 90, 80))), "mm").change_points == ()


def crank_where_rocker_lies(lengths: tuple[float, float, float, float], *, outward: bool) -> float:
    """The crank's angle, above the ground line, at which the rocker lies along it: the cosine rule."""
    g, r, a, b = lengths
    out = g + b if outward else g - b
    return math.acos((r * r + out * out - a * a) / (2 * r * out))


DRAG_LINK, TRIPLE_ROCKER = (30.0, 60.0, 70.0, 80.0), (100.0, 80.0, 60.0, 50.0)
PARALLELOGRAM = (60.0, 40.0, 60.0, 40.0)
CHANGE_POINTS_DOWN_THE_CHAIN = [
    # With B on the far side of O2 the crank's angle counts from there: 180° more.
    (
        "an input that turns",
        six_bar(DRAG_LINK, PARALLELOGRAM),
        (
            crank_where_rocker_lies(DRAG_LINK, outward=True),
            2 * math.pi - crank_where_rocker_lies(DRAG_LINK, outward=False),
        ),
    ),
    (
        "one that swings, there and back",
        six_bar(TRIPLE_ROCKER, PARALLELOGRAM),
        (
            crank_where_rocker_lies(TRIPLE_ROCKER, outward=False),
            2 * math.pi - crank_where_rocker_lies(TRIPLE_ROCKER, outward=False),
        ),
    ),
    # 4 2 5 3 is at its change point where its crank lies along the ground: -3/2 θ + 0.3 = 2πk.
    (
        "a geared crank's loop",
        with_joints(
            four_bar((100, 30, 90, 80)),
            Pin("O7", (200.0, 0.0)),
            Pin("O8", (204.0, 0.0)),
            Crank("D", "O7", 2.0, Gear("A", Fraction(-3, 2), 0.3)),
            RRR("E", ("D", "O8"), (5.0, 3.0)),
        ),
        (0.2, 0.2 + 2 * math.pi / 3, 0.2 + 4 * math.pi / 3),
    ),
    # Half as fast as its input, a crank comes to one angle in every second turn only: a swing misses it.
    *(
        (
            f"half the angle of a swing, {name}",
            with_joints(
                four_bar((5, 4, 3, 3.5)),
                Pin("O7", (200.0, 0.0)),
                Pin("O8", (204.0, 0.0)),
                Crank("D", "O7", 2.0, Gear("A", Fraction(1, 2), offset)),
                RRR("E", ("D", "O8"), (5.0, 3.0)),
            ),
            angles,
        )
        for name, offset, angles in (("reached", -0.15, (0.3,)), ("a turn away", math.pi - 0.15, ()))
    ),
    ("a rocker that never lies along the ground", six_bar((100, 30, 90, 80), PARALLELOGRAM), ()),
    ("a change point within a swing", four_bar((5, 4, 3, 2)), (0.0,)),
]


@pytest.mark.parametrize(
    ("name", "linkage", "angles"),
    CHANGE_POINTS_DOWN_THE_CHAIN,
    ids=[row[0] for row in CHANGE_POINTS_DOWN_THE_CHAIN],
)
def test_change_points_down_the_chain_are_told_as_crank_angles(
    name: str, linkage: Linkage, angles: tuple[float, ...]
) -> None:
    assert Info(mechanism(linkage), "mm").change_points == pytest.approx(angles, abs=1e-12)


def test_a_slot_between_two_geared_cranks_is_named_too() -> None:
    linkage = Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("O7", (100.0, 0.0)),
            Crank("A", "O2", 20.0),
            Crank("D", "O7", 15.0, Gear("A", Fraction(-1))),
            RPR("P", "D", "A", 130.0),
        ),
        Drive("A", 1.0),
    )
    assert Info(mechanism(linkage), "mm").class_name == "inverted slider-crank"


PERIODS = [
    ("one turn", four_bar((100, 30, 90, 80)), 1),
    ("two through a single change point", four_bar((4, 2, 5, 3)), 2),
    ("one through two change points", four_bar((4, 2, 4, 2)), 1),
    ("one there and back", four_bar((100, 80, 30, 90)), 1),
    ("a slot through its own pivot: half the crank's turn", slotted(50, 50, 80), 2),
    ("a slider through both its change points", slider_crank(40, 40, 0), 1),
    ("limits of one dyad down the chain", six_bar((100, 30, 90, 80), (120, 60, 90, 80)), 1),
]


@pytest.mark.parametrize(("name", "linkage", "periods"), PERIODS, ids=[row[0] for row in PERIODS])
def test_the_true_period_is_when_everything_is_back(name: str, linkage: Linkage, periods: int) -> None:
    solved = mechanism(linkage)
    assert solved.periods == periods
    first, last = (solved.pose(0.4 + turns * 2 * math.pi, 1.0, 0.0, 2) for turns in (0, periods))
    for joint, place in first.position.items():
        assert last.position[joint] == pytest.approx(place, abs=1e-12)
        assert last.velocity[joint] == pytest.approx(first.velocity[joint], abs=1e-10)
    for turns in range(1, periods):
        between = solved.pose(0.4 + turns * 2 * math.pi, 1.0, 0.0, 0)
        assert any(
            math.dist(between.position[joint], place) > 1e-3 for joint, place in first.position.items()
        )


def geared(ratio: Fraction) -> Linkage:
    """A geared five-bar: cranks of 55 and 61 on pins 330 apart, bars of 283 and 250."""
    return Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("O7", (330.0, 0.0)),
            Crank("A", "O2", 55.0),
            Crank("D", "O7", 61.0, Gear("A", ratio, 0.3)),
            RRR("B", ("A", "D"), (283.0, 250.0)),
        ),
        Drive("A", 1.0),
    )


@pytest.mark.parametrize("ratio", [Fraction(-1), Fraction(1, 3), Fraction(-2, 5), Fraction(7, 4)], ids=str)
def test_gears_of_ratio_p_over_q_are_back_after_q_turns(ratio: Fraction) -> None:
    solved = mechanism(geared(ratio))
    assert solved.periods == ratio.denominator
    period = 2 * math.pi * ratio.denominator
    here, there = solved.pose(0.7, 1.0, 0.0, 2), solved.pose(0.7 + period, 1.0, 0.0, 2)
    for joint in ("A", "D", "B"):
        assert there.position[joint] == pytest.approx(here.position[joint], abs=1e-11)


IMPOSSIBLE = [
    # One link longer than the others together, each in turn.
    ("ground", four_bar((300, 30, 90, 80))),
    ("crank", four_bar((100, 330, 90, 80))),
    ("coupler", four_bar((100, 30, 290, 80))),
    ("rocker", four_bar((100, 30, 90, 280))),
    ("a rod that cannot reach its line", slider_crank(40, 20, 100)),
    ("a second loop that never closes", six_bar((100, 30, 90, 80), (120, 60, 10, 10))),
    ("a slot farther off than the pin", slotted(100, 40, 50, 200)),
]


@pytest.mark.parametrize(("name", "linkage"), IMPOSSIBLE, ids=[row[0] for row in IMPOSSIBLE])
def test_what_cannot_be_assembled_is_refused_in_words(name: str, linkage: Linkage) -> None:
    with pytest.raises(AssemblyError, match=r"^joint [A-Z]: .*(cannot|more than)"):
        mechanism(linkage)


SECOND_LOOPS = [
    # The rocker of the first loop drives the second: named by its own four lengths.
    ((120, 60, 100, 90), "six-bar: Grashof crank-rocker, then Grashof crank-rocker"),
    ((120, 60, 70, 80), "six-bar: Grashof crank-rocker, then triple-rocker (outward/outward)"),
    ((60, 40, 60, 40), "six-bar: Grashof crank-rocker, then parallelogram"),
    ((60, 40, 40, 60), "six-bar: Grashof crank-rocker, then kite (change point)"),
]


@pytest.mark.parametrize(("second", "name"), SECOND_LOOPS)
def test_the_second_loop_of_a_six_bar_is_classed_too(
    second: tuple[float, float, float, float], name: str
) -> None:
    assert Info(mechanism(six_bar((100, 30, 90, 80), second)), "mm").class_name == name


# However the second dyad is written, it is the same four-bar; one on a coupler point is none.
@pytest.mark.parametrize(
    ("ends", "lengths", "side", "rest"),
    [
        (("C", "O6"), (100, 90), 1, ", then Grashof crank-rocker"),
        (("O6", "C"), (90, 100), -1, ", then Grashof crank-rocker"),
        (("P", "O6"), (130, 110), 1, " and a second dyad"),
    ],
)
def test_a_second_dyad_is_classed_by_what_it_hangs_on(
    ends: tuple[str, str], lengths: tuple[float, float], side: int, rest: str
) -> None:
    linkage = six_bar((100, 30, 90, 80), (120, 60, 100, 90))
    *others, _ = linkage.joints
    dyad = RRR("D", ends, lengths, side)
    changed = replace(linkage, joints=(*others, Rigid("P", ("A", "B"), (45, 30)), dyad))
    assert Info(mechanism(changed), "mm").class_name == f"six-bar: Grashof crank-rocker{rest}"


# A row of rockers, each carried along by the one before: four names are read, a page of them is not.
@pytest.mark.parametrize(
    ("dyads", "name"),
    [
        (4, "10-bar: Grashof crank-rocker, then parallelogram, then parallelogram, then parallelogram"),
        (5, "12-bar: Grashof crank-rocker and 4 further dyads"),
    ],
)
def test_of_many_loops_in_a_row_the_first_is_named(dyads: int, name: str) -> None:
    linkage = four_bar((100, 20, 100, 60))
    pins = [Pin(f"Q{n}", (100.0 * n, 0.0)) for n in range(2, dyads + 1)]
    moving = ["B", *(f"B{n}" for n in range(2, dyads + 1))]
    rockers = [
        RRR(end, (begin, pin.name), (100, 60))
        for begin, end, pin in zip(moving, moving[1:], pins, strict=False)
    ]
    chain = replace(linkage, joints=(*linkage.joints, *pins, *rockers))
    assert Info(mechanism(chain), "mm").class_name == name


@pytest.mark.parametrize(("side", "name"), [(1, "then parallelogram"), (-1, "then antiparallelogram")])
def test_a_parallelogram_down_the_chain_is_told_from_the_crossed_one(side: int, name: str) -> None:
    info = Info(mechanism(six_bar((100, 30, 90, 80), PARALLELOGRAM, side=side)), "mm")
    assert info.class_name.endswith(name)


def _with_wheel(ratio: str) -> Linkage:
    """Return a slider-crank beside which an unrelated wheel makes the true period longer."""
    text = f"""
length_unit = "mm"
[slider-crank]
crank = 40
rod = 120
offset = 30
[ground]
Q = [300, 300]
[joints.W]
crank = "Q"
length = 20
gear = {{ with = "A", ratio = "{ratio}", offset = "0 deg" }}
"""
    return scene_from(parse(text, "my.toml"), name="my", where="my.toml").linkage


@pytest.mark.parametrize("ratio", ["1", "1/2", "1/5", "3/7"])
def test_a_time_ratio_does_not_hang_on_a_wheel_that_makes_the_period_longer(ratio: str) -> None:
    info = Info(mechanism(_with_wheel(ratio)), "mm")
    lean = math.asin(30 / 80) - math.asin(30 / 160)  # of the crank between its two dead centres
    assert info.time_ratio == pytest.approx((math.pi + lean) / (math.pi - lean), rel=1e-9)
    assert info.dead_centres is not None
    back, forward = info.dead_centres
    assert 0 < (forward - back) % (2 * math.pi * info.true_period) < 2 * math.pi


def test_the_stroke_is_that_of_the_slider_that_is_moved_not_of_the_one_that_drives() -> None:
    scene = load("toggle-press")
    travel = scene.cycle(7200).travel["ram"]
    assert scene.info.stroke == pytest.approx(float(np.ptp(travel)), rel=1e-6)
    assert scene.info.stroke == pytest.approx(73.155, abs=1e-3)
    assert load("driven-piston").info.stroke == pytest.approx(100.0, rel=1e-12)


def test_links_of_a_sort_are_counted_in_english() -> None:
    scene = load("crank-rocker")
    count = 33
    bodies = {f"coupler{n}": {"joints": ["A", "B"]} for n in range(2, count + 1)}
    many = scene_from({**scene.document, "bodies": bodies}, name="many", where="many")
    words = [name for name in many.info.link_names.values() if name.endswith("coupler")]
    assert words[:4] == ["coupler", "second coupler", "third coupler", "4th coupler"]
    assert [words[n - 1].split()[0] for n in (11, 12, 13, 21, 22, 23, 31, 33)] == [
        "11th", "12th", "13th", "21st", "22nd", "23rd", "31st", "33rd",
    ]  # fmt: skip


def _beside_a_straight_line(**more: object) -> Info:
    """Return what is told of Peaucellier's linkage, whose P runs along x = 250, with one joint more."""
    document = load("peaucellier").document
    parts = {key: {**document.get(key, {}), **part} for key, part in more.items() if isinstance(part, dict)}
    return scene_from({**document, **parts}, name="more", where="more").info


# By rounding a block moved by 1e-13 mm, and a lever swung 1e-14°, 47 times as long forth as back.
def test_what_stands_still_has_no_stroke_no_swing_and_no_time_ratio() -> None:
    slide = {"pin": "P", "line": {"through": "O2"}, "slot": "90 deg"}
    info = _beside_a_straight_line(joints={"Y": {"slide": slide}}, bodies={"block": {"slider": "Y"}})
    assert (info.stroke, info.time_ratio, info.dead_centres) == (0.0, None, None)
    told = dict(info.lines)
    assert (told["stroke"], "time ratio" in told) == ("0 mm", False)
    lever = {"slot": {"pivot": "F", "through": "P"}, "length": 50}
    ground, bodies = {"F": [250, -600]}, {"lever": {"joints": ["F", "L"]}}
    info = _beside_a_straight_line(joints={"L": lever}, ground=ground, bodies=bodies)
    assert info.output_name == "the lever"
    assert (info.swing, info.time_ratio) == (None, None)
    assert not {"swing", "time ratio"} & {label for label, _ in info.lines}


# What the last digits of exact sums leave of a limit at 0: 7.6e-32° was told.
def test_a_limit_at_nothing_is_at_nothing() -> None:
    linkage = four_bar((10.0, 10.0, 4.0, 6.0), ground_angle=-math.pi / 3)
    info = Info(mechanism(linkage), "mm")
    assert 0.0 in info.input_range
    assert re.match("swings −48.52°…0°, and", dict(info.lines)["input"])
    assert all(end == 0.0 or abs(end) > 1e-3 for end in info.toggles)


# Gears so quick that the usual samples of a period were fewer than their turns.
@pytest.mark.parametrize(("ratio", "turns"), [(96, 15), (1441, 15), (1440, 1), (-480, 1), (720, 7)])
def test_what_quick_gears_turn_turns_fully(ratio: int, turns: int) -> None:
    quick = Crank("K", "A", 20.0, Gear("A", Fraction(ratio, turns)))
    joints = Pin("O2", (0.0, 0.0)), Crank("A", "O2", 50.0), quick, Rigid("W", ("A", "K"), (5.0, 9.0))
    bodies = Body("plate", ("K", "W")), Body("crank", ("O2", "A"))
    found = Info(mechanism(Linkage(joints, Drive("A", 1.0), bodies)), "mm")
    assert found.turning_links == ("plate", "crank")
