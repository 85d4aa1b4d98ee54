"""Chains whose dyads limit the input, touch change points, or stand on dyads that do."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from build import four_bar, six_bar
from limits import Limits

from linkanim.errors import LinkanimError
from linkanim.mechanics.arithmetic import Slope
from linkanim.mechanics.linkage import RRP, RRR, Crank, Drive, Line, Linkage, Pin
from linkanim.mechanics.motion import Mechanism, mechanism
from linkanim.mechanics.program import Array
from linkanim.mechanics.solver import limits
from linkanim.mechanics.solver.closing import SignedDistance, Touch, walk_at
from linkanim.mechanics.solver.input import InputState, Swing
from linkanim.scenes import load
from linkanim.scenes.editing import with_dimensions
from linkanim.scenes.reading import scene_from

Lengths = tuple[float, float, float, float]
Key = tuple[str | int, ...]


def bends(solved: Mechanism, count: int) -> float:
    """The greatest second difference of any joint over a true period, or a way between kept ends."""
    phases = np.linspace(*(solved.assembly.path.way or (0.0, 2 * np.pi * solved.periods)), count + 1)
    motion = solved.solve(phase=phases, speed=1.0, derivatives=0)
    return max(float(np.abs(np.diff(place, 2, axis=0)).max()) for place in motion.position.values())


def runs_smoothly(solved: Mechanism) -> None:
    motion = solved.solve(phase=np.linspace(0.0, 2 * np.pi * solved.periods, 721), speed=1.0)
    for kind in ("position", "velocity", "acceleration"):
        for joint, values in getattr(motion, kind).items():
            assert np.isfinite(values).all(), (kind, joint)
    assert bends(solved, 40_000) <= bends(solved, 4_000) / 20 + 1e-9


CHAINS = [
    # Limits: the second dyad's own at both ends; at one, where the first one's limit cannot be passed.
    ("stopped by the second loop", (100, 30, 90, 80), (120, 60, 90, 80), 0.0, ("D", "D")),
    ("stopped inside a double-rocker's range", (100, 80, 30, 90), (120, 60, 110, 50), 1.0, ("D", "D")),
    ("turns back at the first loop's limit", (100, 80, 30, 90), (120, 60, 116, 50), 1.0, ("B", "D")),
    # A second loop that closes all along a double-rocker's way out, but not on its way back.
    ("a double-rocker's own limits, all the way", (100, 80, 30, 90), (120, 60, 160, 150), 1.0, ("B", "B")),
]


@pytest.mark.parametrize(("name", "first", "second", "start", "ends"), CHAINS, ids=[row[0] for row in CHAINS])
def test_a_limited_chain_runs_smoothly_between_its_ends(
    name: str, first: Lengths, second: Lengths, start: float, ends: tuple[str, str]
) -> None:
    solved = mechanism(six_bar(first, second, start=start))
    path = solved.assembly.path
    assert isinstance(path, Swing)
    assert path.ends == ends
    runs_smoothly(solved)


def test_a_chain_that_cannot_pass_a_limit_comes_to_it() -> None:
    first, second = (100, 80, 30, 90), (120, 60, 116, 50)
    limit = mechanism(four_bar(first, start=1.0)).assembly.path.input_range[0]
    assert mechanism(six_bar(first, second, start=1.0)).input_range[0] == limit


@pytest.mark.parametrize("start", [0.0, 1.0, 2.0])
def test_beyond_change_points_the_range_of_a_chain_lies_within_a_turn_of_the_start(start: float) -> None:
    # The first loop is a parallelogram: its two change points lie at 0 and at half a turn.
    low, high = mechanism(
        six_bar((4.0, 1.0, 4.0, 1.0), (2.92, 3.23, 4.89, 1.26), start=start)
    ).assembly.path.input_range
    assert high - low == pytest.approx(3.764712765)
    assert start - math.tau < low < high < start + math.tau


# Changes of the catalogue's scenes that once gave NaN, a jump, or the wrong dyad as the limit.
CHANGED: list[tuple[str, list[tuple[Key, float]]]] = [
    ("press", [(("joints", "B", "length", 0), 261.11)]),
    ("press", [(("ground", "O7", "length"), 124.18), (("joints", "D", "gear", "offset"), -173.41)]),
    ("press", [(("ground", "O2", 0), 41.7), (("joints", "C", "length"), 481.42)]),
    ("press", [(("joints", "H", "at", 0), 191.81), (("joints", "B", "length", 0), 268.68)]),
    ("six-bar", [(("six-bar", "lengths", 4), 76.39), (("six-bar", "lengths", 1), 84.38)]),
    ("six-bar", [(("six-bar", "lengths", 0), 37.95), (("drive", "start"), 35.93)]),
]


@pytest.mark.thinned(2)
@pytest.mark.parametrize(("name", "changes"), CHANGED, ids=[f"{row[0]}-{n}" for n, row in enumerate(CHANGED)])
def test_changed_scenes_run_smoothly(name: str, changes: list[tuple[Key, float]]) -> None:
    scene = load(name)
    for key, value in changes:
        scene = with_dimensions(scene, {key: value})
    runs_smoothly(scene.mechanism)
    assert scene.info.lines


def test_the_dyad_that_limits_is_named_not_the_one_that_stands_on_it() -> None:
    # The press's slider hangs on B: where B's bars end, the slider has no margin at all.
    path = with_dimensions(load("press"), {("joints", "B", "length", 0): 261.11}).mechanism.assembly.path
    assert isinstance(path, Swing)
    assert path.ends == ("B", "B")


def two_limits_and_a_change_point() -> Linkage:
    """S1 stops the input at one end, D1 at the other, so it is back after two; S2 passes change points."""
    return Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("G1", (0.1, 0.4)),
            Pin("G2", (1.3, 0.0)),
            Crank("A", "O2", 1.3),
            RRR("D1", ("G1", "A"), (1.6, 2.8)),
            RRP("S1", "A", 0.9, Line("G2"), -1),
            RRP("S2", "D1", 2.0, Line("G2", math.pi), -1),
        ),
        Drive("A", 1.0, -math.pi / 3),
    )


def test_a_swing_that_passes_change_points_on_one_of_its_two_ways_runs_smoothly() -> None:
    solved = mechanism(two_limits_and_a_change_point())
    path = solved.assembly.path
    assert (path.ends, path.periods) == (("S1", "D1"), 2)
    touches = [zero for zero in solved.assembly.chain["S2"].zeros if isinstance(zero, Touch)]
    assert [zero.place.high // (2 * math.pi) for zero in touches] == [0.0, 1.0]
    runs_smoothly(solved)


def test_by_angle_a_swing_gives_what_its_first_way_up_gives_by_phase() -> None:
    solved = mechanism(two_limits_and_a_change_point())
    phases = np.linspace(0.2, math.pi - 0.2, 101)
    by_phase = solved.solve(phase=phases, speed=1.0)
    by_angle = solved.solve(
        angle=by_phase.coordinate, speed=by_phase.coordinate_rate, acceleration=by_phase.coordinate_second
    )
    for kind in ("position", "velocity", "acceleration"):
        for joint, values in getattr(by_phase, kind).items():
            found = getattr(by_angle, kind)[joint]
            assert found == pytest.approx(values, abs=1e-11 * max(1.0, np.abs(values).max())), (kind, joint)


def test_a_change_point_where_the_loop_before_it_turns_is_passed_to_the_last_digit() -> None:
    # A kite in the middle of its swing: the first loop's formula goes over from one limit to the other there.
    bars = {"lengths": [4, 4, 3, 3, 2, 3, 3, 2], "assembly": "crossed"}
    solved = scene_from({"six-bar": bars, "drive": {"start": "-60 deg"}}, name="kite", where="here").mechanism
    zeros = solved.assembly.chain["D"].zeros
    assert len(zeros) == 2
    assert all(zero.near for zero in zeros)
    for zero in zeros:
        assert isinstance(zero, Touch)
        around = solved.solve(phase=zero.place.high + np.linspace(-1e-5, 1e-5, 21), speed=1.0, derivatives=0)
        assert np.abs(np.diff(around.position["D"], 2, axis=0)).max() <= 1e-10


# Which of a double-rocker's limits the dyad that stands on it cannot pass: there the input turns back.
STOPS = [
    ("below", (120, 60, 116, 50), 1.0, 1, ("B", "D"), (0.0, math.tau)),
    ("above", (120, 60, 116, 50), -1.0, -1, ("D", "B"), (-math.pi, math.pi)),
    ("at both ends", (120, 60, 100, 70), 1.0, 1, ("B", "B"), (0.0, math.pi)),
]


@pytest.mark.parametrize(
    ("name", "second", "start", "side", "ends", "way"), STOPS, ids=[row[0] for row in STOPS]
)
def test_a_swing_turns_back_only_at_a_limit_that_cannot_be_passed(
    name: str, second: Lengths, start: float, side: int, ends: tuple[str, str], way: tuple[float, float]
) -> None:
    linkage = six_bar((100, 80, 30, 90), second, start=start)
    joints = (replace(joint, side=side) if joint.name == "B" else joint for joint in linkage.joints)  # type: ignore[call-arg]
    solved = mechanism(replace(linkage, joints=tuple(joints)))
    assert (solved.assembly.path.ends, solved.assembly.path.way) == (ends, way)
    runs_smoothly(solved)
    (first, last), away = way, np.linspace(0.0, 3.0, 13)
    for end in (first, last):
        there, back = (solved.solve(phase=end + side * away, speed=1.0) for side in (1, -1))
        for joint, place in there.position.items():
            assert back.position[joint] == pytest.approx(place, abs=1e-13 * 200)
            assert back.velocity[joint][1:] == pytest.approx(-there.velocity[joint][1:], rel=1e-9, abs=1e-9)


def test_a_slot_whose_ends_lie_in_one_place_for_a_while_is_refused_at_once() -> None:
    """Its margin is rounding there, and has hundreds of extremes."""
    kite = {
        "lengths": [20, 60, 65, 90, 25, 40, 40, 25],
        "ground_angle": "45 deg",
        "link_angle": "-107.47 deg",
    }
    document = {
        "six-bar": {**kite, "assembly": "open", "assembly2": "open"},
        "joints": {"S": {"slot": {"pivot": "D", "through": "O4"}, "length": 200}},
    }
    with Limits(10, 400).held(), pytest.raises(LinkanimError, match="S: it is at its limit"):
        scene_from(document, name="kite", where="kite.toml")


def row_of_dyads(count: int, size: float = 1.0) -> dict[str, object]:
    """Return a row of dyads, each a parallelogram with the one before it but for the first."""
    ground = {f"O{n + 2}": [4 * size * n, 0] for n in range(count + 1)}
    joints: dict[str, object] = {"A": {"crank": "O2", "length": 4 * size}}
    for n in range(1, count + 1):
        before = "A" if n == 1 else f"D{n - 1}"
        length = [4.2 * size if n == 1 else 4 * size, 2.5 * size]
        joints[f"D{n}"] = {"from": [before, f"O{n + 2}"], "length": length, "side": "left"}
    return {"ground": ground, "joints": joints, "drive": {"speed": "-20 rpm", "start": "600 rad"}}


@pytest.mark.long  # half a minute of a busy machine
def test_a_dyad_that_rounding_holds_at_its_limit_is_refused_before_it_is_looked_at_ever_closer() -> None:
    with Limits(60, 800).held(), pytest.raises(LinkanimError, match=r"D\d+: it is at its limit"):
        scene_from(row_of_dyads(20, 1e-9), name="row", where="row")


@pytest.mark.slow
def test_where_dyads_just_fall_into_line_is_settled_of_each_once_and_at_last_of_all(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked, original = list[str](), limits._exact_extremes

    def noted(exact: limits.ExactWalk, name: str, phases: Array) -> Iterator[limits.Extreme]:
        asked.append(name)
        return original(exact, name, phases)

    monkeypatch.setattr(limits, "_exact_extremes", noted)
    assert scene_from(row_of_dyads(4), name="row", where="row").mechanism
    assert Counter(asked).most_common(1)[0][1] <= 3


def geared_slot(ratio: int, further: int | str = "1/3") -> dict[str, object]:
    """Return a slot through a crank on a crank, whose gear makes it pass change point after change point."""
    return {
        "ground": {"O2": [0, 0], "O4": [1e-28, 0]},
        "joints": {
            "A": {"crank": "O2", "length": 30},
            "B0": {"crank": "A", "length": 20, "gear": {"with": "A", "ratio": -1, "offset": "30 deg"}},
            "B1": {"crank": "O4", "length": 1e-6, "gear": {"with": "B0", "ratio": ratio}},
            "B2": {"crank": "B0", "length": 20, "gear": {"with": "B1", "ratio": further, "offset": "90 deg"}},
            "S": {"slot": {"pivot": "A", "through": "B2"}, "length": 40},
        },
    }


@pytest.mark.slow
def test_a_dyad_with_more_change_points_than_are_worked_out_is_refused() -> None:
    refusal = r"joint S: it passes [34]\d\d change points, or .* 100 are the most here; give its gears"
    with Limits(10, 400).held(), pytest.raises(LinkanimError, match=refusal):
        scene_from(geared_slot(-100, 4), name="gears", where="gears")


def test_how_far_each_of_many_change_points_is_takes_a_look_at_each(monkeypatch: pytest.MonkeyPatch) -> None:
    looks, distance = list[Touch](), Touch.distance

    def noted(touch: Touch, state: InputState) -> SignedDistance:
        looks.append(touch)
        return distance(touch, state)

    assembly = scene_from(geared_slot(-5), name="gears", where="gears").mechanism.assembly
    assert len(assembly.chain["S"].zeros) == 8
    monkeypatch.setattr(Touch, "distance", noted)
    walk_at(assembly, 1.0, Slope(1.0))
    assert Counter(map(id, looks)).most_common(1)[0][1] == 1


def test_what_keeps_from_its_limit_behind_a_change_point_has_none() -> None:
    document = {
        "drive": {"start": "180 deg"},
        "six-bar": {
            "lengths": [70, 65, 110, 150, 10, 10, 60, 60],
            "ground_angle": "180 deg",
            "link_angle": "180 deg",
            "assembly": "crossed",
            "assembly2": "crossed",
        },
        "ground": {"G": {"length": 110, "angle": "90 deg"}},
        "joints": {"E": {"slot": {"pivot": "G", "through": "D"}, "length": 40}},
    }
    path = scene_from(document, name="six-bar", where="six-bar.toml").mechanism.assembly.path
    assert isinstance(path, Swing)
    assert path.ends == ("B", "B")


@pytest.mark.thinned(2)
@pytest.mark.parametrize(
    "aside",
    [0.0, 1e-14, *(pytest.param(aside, marks=pytest.mark.long) for aside in (1e-15, 1e-12, 1e-6, 1e-3))],
)
@pytest.mark.slow
def test_a_cell_that_folds_at_both_limits_is_whole_there(aside: float) -> None:
    """Its arms, and both bars on them, lie in one line there, and the ends of the last dyad meet."""
    joints = {
        "D": {"crank": "O2", "length": 40},
        "A": {"from": ["D", "Q"], "length": [105, 60], "side": "right"},
        "B": {"from": ["O", "A"], "length": [200, 100], "side": "left"},
        "C": {"from": ["O", "A"], "length": [200, 100], "side": "right"},
        "P": {"from": ["B", "C"], "length": [100, 100], "side": "left"},
    }
    document = {"ground": {"O": [0, 0], "Q": [60, 0], "O2": [aside, -105]}, "joints": joints}
    solved = scene_from(document, name="cell", where="cell.toml").mechanism
    assert solved.assembly.path.ends == ("B", "B")
    motion = solved.solve(phase=np.linspace(0, 2 * math.pi, 181), speed=1.0)
    assert np.isfinite(np.stack([motion.position["P"], motion.velocity["P"], motion.acceleration["P"]])).all()
    assert motion.position["P"][:, 0] == pytest.approx(250, abs=1e-9 + 10 * aside)
