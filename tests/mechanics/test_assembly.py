"""Putting linkages together: every four-bar that can be, under either name, driven at either end."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest
from build import four_bar, rocker_driven, slider_crank, slotted, with_joints

from linkanim.errors import AssemblyError
from linkanim.mechanics.linkage import RPR, RRP, RRR, Crank, Drive, Gear, Line, Linkage, Pin, Polar
from linkanim.mechanics.motion import Mechanism, mechanism
from linkanim.scenes.reading import scene_from

Lengths = tuple[float, float, float, float]
Point = tuple[float, float]


def two_sliders(bar: float) -> Linkage:
    """A slider on a line through O2, and a second one on a line 5 above, a bar away."""
    line = Line("O2", 0.0, 5.0)
    return with_joints(
        slider_crank(3.0, 4.0, 0.0), RRP("S1", "A", 8.0, Line("O2", 0.0)), RRP("S2", "S1", bar, line)
    )


def mirrored_cranks(bars: tuple[float, float]) -> Linkage:
    """Cranks of 1 on pins 6 apart, each the mirror image of the other, and a dyad between their pins."""
    gear = Gear("A", Fraction(-1), math.pi)
    return Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("O5", (6.0, 0.0)),
            Crank("A", "O2", 1.0),
            Crank("C", "O5", 1.0, gear),
            RRR("D", ("A", "C"), bars),
        ),
        Drive("A", 1.0),
    )


RIGID = [
    # Stretched out, the two bars just reach: 24.3 + 22.6 is 87 - 40.1, but not in floats.
    ("decimals", four_bar((87.0, 40.1, 24.3, 22.6))),
    ("integers", four_bar((9.0, 4.0, 3.0, 2.0))),
    ("one bar as long as the three others", four_bar((2.3, 4.1, 9.6, 3.2))),
    ("driven at the rocker", rocker_driven((9.0, 4.0, 3.0, 2.0))),
    ("a rod that just reaches its line", slider_crank(4.1, 2.2, 6.3)),
    ("a rod that just reaches its line, on the other side", slider_crank(4.1, 2.2, -6.3)),
    # The two crank pins are 4 apart or more: 6 - 2 cos θ.
    ("bars that just reach from one crank to a geared one", mirrored_cranks((1.5, 2.5))),
    ("a slot as far off as the pin ever is", slotted(2.2, 4.1, 5.0, 6.3)),
]


@pytest.mark.parametrize(("name", "linkage"), RIGID, ids=[row[0] for row in RIGID])
def test_what_can_be_put_together_in_one_place_only_is_refused(name: str, linkage: Linkage) -> None:
    with pytest.raises(AssemblyError, match=r"one angle of the input only, so nothing could move"):
        mechanism(linkage)


def test_a_factor_that_vanishes_at_the_start_does_not_keep_a_four_bar_from_loading() -> None:
    # Next to the lower limit U has no digits left in floats; only its root has.
    solved = mechanism(four_bar((87.0, 40.1, 24.3 + 1e-12, 22.6)))
    here = solved.pose(1.0, 1.0, 0.0, 2)
    assert math.dist(here.position["A"], here.position["B"]) == pytest.approx(24.3, rel=1e-11)


FLAT = [
    # Bars along the line of the two joints they hang on, however the crank stands.
    (
        "bars along the crank",
        with_joints(four_bar((100.0, 30.0, 90.0, 80.0)), RRR("C", ("O2", "A"), (10.0, 20.0))),
    ),
    ("a bar square to two parallel lines", two_sliders(5.0)),
    # The rod as long as the crank, the slider on the crank's pivot for good.
    (
        "a slot whose pin rests on its pivot",
        with_joints(slider_crank(1.7, 1.7, 0.0, side=-1), RPR("Q", "O2", "B", 2.0)),
    ),
]


@pytest.mark.parametrize(("name", "linkage"), FLAT, ids=[row[0] for row in FLAT])
def test_what_is_at_its_limit_everywhere_is_refused(name: str, linkage: Linkage) -> None:
    with pytest.raises(AssemblyError, match=r"at its limit at every angle of the input"):
        mechanism(linkage)


def test_ends_that_meet_and_part_the_way_they_came_are_refused() -> None:
    # At its highest point the slider just comes to G2, where the dyad's other end is.
    linkage = Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("G2", (0.0, 3.0)),
            Crank("A", "O2", 2.0),
            RRP("S1", "A", 1.0, Line("O2", math.pi / 2)),
            RRR("D1", ("G2", "S1"), (4.0, 4.0), -1),
        ),
        Drive("A", 1.0, 1.5),
    )
    with pytest.raises(AssemblyError, match=r"^joint D1: the two ends of its equal bars meet and part"):
        mechanism(linkage)


def test_a_slider_that_keeps_out_of_reach_of_the_next_line_is_refused() -> None:
    with pytest.raises(AssemblyError, match=r"^joint S2: the bar of 4 m cannot reach its line of travel"):
        mechanism(two_sliders(4.0))


def test_a_slider_may_carry_another_along_a_parallel_line() -> None:
    pose = mechanism(two_sliders(13.0)).pose(1.0, 1.0, 0.0, 2)
    assert pose.position["S2"][0] - pose.position["S1"][0] == pytest.approx(12.0, rel=1e-15)
    assert pose.velocity["S2"] == pytest.approx(pose.velocity["S1"])


LATER_DYADS = [
    # Bars on A that the swing of the rocker alone would pull apart.
    ("a dyad on A", (100.0, 70.0, 90.0, 80.0), RRR("C", ("A", "O6"), (60.0, 220.0)), Pin("O6", (300.0, 0.0))),
    ("a dyad on B", (100.0, 70.0, 90.0, 80.0), RRR("C", ("A", "O6"), (70.0, 60.0)), Pin("O6", (0.0, 120.0))),
]


@pytest.mark.parametrize(("name", "lengths", "dyad", "pin"), LATER_DYADS, ids=[row[0] for row in LATER_DYADS])
def test_a_dyad_that_limits_a_rocker_driven_four_bar_is_found_after_it_is_named(
    name: str, lengths: Lengths, dyad: RRR, pin: Pin
) -> None:
    solved = mechanism(with_joints(rocker_driven(lengths), pin, dyad))
    assert "C" in solved.assembly.path.ends
    for phase in (0.1, 1.0, 3.0, 5.0):
        pose = solved.pose(phase, 1.0, 0.0, 0)
        bars = [math.dist(pose.position["C"], pose.position[end]) for end in dyad.ends]
        assert bars == pytest.approx(dyad.lengths, rel=1e-12)


def left_of(point: Point, start: Point, end: Point) -> float:
    """Positive where the point lies left of the way from start to end."""
    (x, y), (x0, y0), (x1, y1) = point, start, end
    return (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)


def is_closed(solved: Mechanism, lengths: Lengths) -> bool:
    """Tell whether all four bars keep their lengths over the true period."""
    g, r, a, b = lengths
    bars = {("O2", "O4"): g, ("O2", "A"): r, ("A", "B"): a, ("O4", "B"): b}
    phases = 0.05 + 0.1 * np.arange(63 * solved.periods)
    position = solved.solve(phase=phases, speed=1.0, derivatives=0).position
    return all(
        np.abs(np.hypot(*(position[p] - position[q]).T) - length).max() <= 1e-12 * max(lengths)
        for (p, q), length in bars.items()
    )


def may_be_assembled(lengths: Lengths) -> bool:
    return 2 * max(lengths) < sum(lengths)


SIZES = (2.0, 3.0, 4.0)
SMALL = [lengths for lengths in itertools.product(SIZES, SIZES, SIZES, SIZES) if may_be_assembled(lengths)]


@pytest.mark.parametrize("side", [1, -1], ids=["open", "crossed"])
@pytest.mark.parametrize("build", [four_bar, rocker_driven], ids=["crank", "rocker"])
@pytest.mark.slow
def test_every_four_bar_that_can_be_assembled_loads_with_either_name(
    build: Callable[..., Linkage], side: int
) -> None:
    # Grashof, triple rockers, parallelograms, kites and rhombi among them.
    assert len(SMALL) > 60
    for lengths in SMALL[:: 2 if side == 1 else 6]:
        assert is_closed(mechanism(build(lengths, side=side)), lengths), lengths


@pytest.mark.parametrize("lengths", [(4.0, 2.0, 4.0, 2.0), (4.0, 2.0, 5.0, 3.0), (100.0, 70.0, 90.0, 80.0)])
def test_the_two_names_of_a_rocker_driven_four_bar_are_two_motions(lengths: Lengths) -> None:
    first, second = (
        mechanism(rocker_driven(lengths, side=side)).pose(1.0, 1.0, 0.0, 0).position["A"] for side in (1, -1)
    )
    assert math.dist(first, second) > 0.1


def test_the_antiparallelogram_driven_at_its_rocker_is_the_crossed_one() -> None:
    for side, crossed in ((1, False), (-1, True)):
        pose = mechanism(rocker_driven((4.0, 2.0, 4.0, 2.0), side=side)).pose(1.0, 1.0, 0.0, 0).position
        parallel = math.dist(pose["A"], (pose["B"][0] - 4.0, pose["B"][1])) < 1e-12
        assert parallel is not crossed


@pytest.mark.slow
def test_where_b_lies_on_one_side_for_both_the_name_is_that_of_the_pin_a() -> None:
    named_by_a = 0
    for lengths in SMALL[::3]:
        both = [mechanism(rocker_driven(lengths, side=sign)).pose(1e-5, 1.0, 0.0, 0) for sign in (1, -1)]
        b_sides = [left_of(*(pose.position[name] for name in ("B", "A", "O4"))) for pose in both]
        a_sides = [left_of(*(pose.position[name] for name in ("A", "B", "O2"))) for pose in both]
        # A folded rhombus has A on O4 itself: B lies on no side there.
        by_a = b_sides[0] * b_sides[1] > -1e-15
        named_by_a += by_a
        assert a_sides[0] < 0 < a_sides[1] if by_a else b_sides[1] < 0 < b_sides[0], lengths
    assert named_by_a > 15


def test_a_tie_through_a_tilted_line_is_a_change_point() -> None:
    # The line at 45 degrees through [1, 1] passes O2 to 1e-16: the rod is as long as the crank.
    linkage = Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("G", (1.0, 1.0)),
            Crank("A", "O2", 0.2),
            RRP("B", "A", 0.2, Line("G", math.pi / 4)),
        ),
        Drive("A", 1.0),
    )
    solved = mechanism(linkage)
    assert solved.assembly.path.full_turn
    assert solved.assembly.loops["B"].root.u.least == solved.assembly.loops["B"].root.w.least == 0.0


REFUSED = [
    ("a ground that is too long", rocker_driven((300.0, 30.0, 90.0, 80.0))),
    (
        "a dyad out of the reach of A",
        with_joints(
            rocker_driven((100.0, 70.0, 90.0, 80.0)),
            Pin("O6", (300.0, 0.0)),
            RRR("C", ("A", "O6"), (60.0, 120.0)),
        ),
    ),
]


@pytest.mark.parametrize("ground_angle", [0.0, math.pi / 2, 0.7])
def test_two_loops_that_close_in_one_place_only_are_refused(ground_angle: float) -> None:
    # A - O4 is 4 at the most for the first two bars, and 4 at the least for the others.
    bar = four_bar((2.0, 4.0, 2.0, 2.0), ground_angle=ground_angle)
    with pytest.raises(
        AssemblyError, match=r"^joint D: the bars of the linkage leave its input no common range"
    ):
        mechanism(with_joints(bar, RRR("D", ("A", "O4"), (5.0, 9.0))))


@pytest.mark.parametrize("first", [1, -1])
def test_ranges_of_two_loops_are_common_across_the_half_turn(first: int) -> None:
    # Each loop leaves 108.2 degrees open about its own ground line, at 150 and at -150 degrees.
    angles = [first * math.radians(150), -first * math.radians(150)]
    pins = [
        Pin(name, (4 * math.cos(angle), 4 * math.sin(angle)), Polar(4.0, angle, "O2"))
        for name, angle in zip(("O4", "O6"), angles, strict=True)
    ]
    loops = [RRR(name, ("A", pin.name), (2.0, 3.0)) for name, pin in zip("BD", pins, strict=True)]
    joints = (Pin("O2", (0.0, 0.0)), *pins, Crank("A", "O2", 2.0), *loops)
    low, high = mechanism(Linkage(joints, Drive("A", 1.0))).assembly.path.input_range
    reach = math.acos(-5 / 16)
    assert math.cos((low + high) / 2) == pytest.approx(-1.0)
    assert high - low == pytest.approx(2 * (reach - math.radians(30)))


@pytest.mark.parametrize(("name", "linkage"), REFUSED, ids=[row[0] for row in REFUSED])
def test_bars_that_never_meet_are_still_refused(name: str, linkage: Linkage) -> None:
    with pytest.raises(AssemblyError, match="cannot meet at any angle"):
        mechanism(linkage)


def test_a_loop_at_its_limit_at_one_end_of_anothers_range_doubles_the_period() -> None:
    # The first slider's rod sets both ends; the second one's is at its limit at the upper end alone.
    pin = Pin("G", (2.598076211353316, -1.5), Polar(3.0, -math.pi / 6))
    linkage = Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            pin,
            Crank("A", "O2", 5.0),
            RRP("S", "A", 1.0, Line("G", math.pi)),
            RRP("T", "A", 5.0, Line("G", math.pi, -4.0)),
        ),
        Drive("A", -1.0, math.radians(30)),
    )
    solved = mechanism(linkage)
    assert solved.periods == 2
    place = solved.solve(phase=np.array([0.4, 0.4 + 2 * math.pi, 0.4 + 4 * math.pi]), speed=1.0).position["T"]
    assert place[2] == pytest.approx(place[0], abs=1e-13)
    assert np.hypot(*(place[1] - place[0])) > 1.0


def test_a_dyad_in_line_just_where_it_turns_back_is_refused() -> None:
    # The slotted bar's furthest direction is square to the line: the rod, as long as the bar, falls into it.
    linkage = Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("G", (-1.0, -1.0)),
            Crank("A", "O2", 1.0),
            RPR("E", "G", "A", 3.0),
            RRP("S", "E", 3.0, Line("G", 0.0)),
        ),
        Drive("A", 1.0, math.pi),
    )
    with pytest.raises(AssemblyError, match="just where it turns back"):
        mechanism(linkage)


@pytest.mark.parametrize("apart", [2e-16, 4e-16, 1e-15, 3e-15, 1e-14, 1e-13, 1e-11, 1e-8])
@pytest.mark.parametrize(("bars", "pivots"), [(0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (1, -1), (2, 1)])
def test_bars_keep_their_lengths_next_to_a_kite(apart: float, bars: int, pivots: int) -> None:
    """Lengths that differ in their last digit are those of a kite; others limit it, or let it turn."""
    crank, coupler = 4.8, 6.6
    lengths = {"ground": crank * (1 + pivots * apart), "rocker": coupler * (1 + bars * apart)}
    document = {"four-bar": {"crank": crank, "coupler": coupler, **lengths, "assembly": "crossed"}}
    solved = scene_from(document, name="kite", where="kite.toml").mechanism
    phases = np.concatenate([np.linspace(0, 4 * math.pi, 97), [1e-16, 1e-12, math.pi + 1e-12]])
    position = solved.solve(phase=phases, speed=1.0, derivatives=0).position
    for ends, length in ((("A", "B"), coupler), (("O4", "B"), lengths["rocker"])):
        long = np.hypot(*(position[ends[1]] - position[ends[0]]).T)
        assert long == pytest.approx(length, abs=16 * 2.0**-52 * coupler)


@pytest.mark.parametrize("apart", [0.0, 5e-324, 1e-300])
def test_pins_next_to_nothing_apart_are_one_point(apart: float) -> None:
    joints = {
        "A": {"crank": "O2", "length": 20},
        "D": {"from": ["A", "G"], "length": [15, 31], "side": "right"},
    }
    document = {"ground": {"O2": [0, 0], "G": [apart, 0]}, "joints": joints}
    position = scene_from(document, name="arm", where="arm.toml").pose(1.0).position
    assert math.dist(position["D"], position["G"]) == pytest.approx(31, rel=1e-15)
