"""Links that can only be solved together move as fifty digits say, without a jump, through all limits."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from published import STEPHENSON
from random_groups import FORMS, Bars, document

from linkanim.errors import AssemblyError
from linkanim.mechanics.solver.input import Swing, Turn
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

STEPHENSON_III: dict[str, Any] = {
    **tomllib.loads(STEPHENSON),
    "drive": {"joint": "G", "speed": "1 rad/s"},
}
OTHER_CLOSURES = [
    {"B": (13.704776472907, -6.151156212391), "C": (34.652378084191, 0.344841535062)},
    {"B": (15.535674609931, 12.668463471307), "C": (31.101930568661, -2.781186214925)},
    {"B": (19.160699576318, 4.342616132921), "C": (29.838820713419, 23.499278915916)},
]
"""The other three in which the bars close at the same angle; PMKS_Verification, stephenson_iii_example_2."""
BUTTERFLY: dict[str, Any] = {
    "points": {
        "A": [0, 0],
        "B": [6.17, 0],
        "C": [-0.21, 1.94],
        "D": [1.4, 0.48],
        "E": [2.69, 3.37],
        "F": [5.84, 3.17],
        "G": [5.37, 1.82],
        "H": [3.63, 1.03],
        "I": [4.67, -1.09],
        "J": [4.13, 2.05],
    },
    "links": {
        "ground": ["A", "B"],
        "ACD": ["A", "C", "D"],
        "CE": ["C", "E"],
        "EFG": ["E", "F", "G"],
        "BFJ": ["B", "F", "J"],
        "DHI": ["D", "H", "I"],
        "GH": ["G", "H"],
        "IJ": ["I", "J"],
    },
    "drive": {"joint": "A", "speed": "1 rad/s"},
}
TURNED = {
    "E": (0.5499999150409883, 1.8527167578453108),
    "F": (3.702078979113377, 2.016721556057238),
    "G": (3.390636584972199, 0.6215858511411855),
    "H": (1.5141463571925802, 0.2603595715772618),
    "I": (0.8051974935320692, -1.9920594633082256),
    "J": (3.277974954071667, 0.017062641156144212),
}
"""The double butterfly after a quarter turn of its crank; PMKS-Web's fixture, to forty digits."""


def read(document: Mapping[str, Any]) -> Scene:
    return scene_from({"length_unit": "mm", **document}, name="my", where="my.toml")


def bars_of(scene: Scene, document: Mapping[str, Any]) -> Bars:
    joint = scene.linkage.driven.joint
    crank = {scene.linkage.driven.pivot, joint.name}
    return Bars(document, next(frame for frame in scene.linkage.rigid_bodies[1:] if crank <= frame.keys()))


def test_the_pose_that_is_given_is_the_pose_at_the_start() -> None:
    found = read(STEPHENSON_III).pose(0.0).position
    for name, place in STEPHENSON_III["points"].items():
        assert found[name] == pytest.approx(place, abs=2e-15 * 45)


@pytest.mark.parametrize("places", OTHER_CLOSURES)
def test_each_closure_is_the_one_of_its_points(places: Mapping[str, tuple[float, float]]) -> None:
    points = STEPHENSON_III["points"]
    b, c = (complex(*places[name]) for name in "BC")
    first, second, third = (complex(*points[name]) for name in "BCE")
    e = b + (c - b) * (third - first) / (second - first)
    pose = {**points, "B": [b.real, b.imag], "C": [c.real, c.imag], "E": [e.real, e.imag]}
    scene, own = read({**STEPHENSON_III, "points": pose}), read(STEPHENSON_III)
    start = own.linkage.drive.start
    found, other = (one.solve(angle=start, speed=1.0).position for one in (scene, own))
    for name, place in pose.items():
        assert found[name] == pytest.approx(place, abs=1e-11)
    assert np.hypot(*(found["B"] - other["B"])) > 5


@pytest.mark.slow
def test_a_double_butterfly_turns_fully_as_published() -> None:
    scene = read(BUTTERFLY)
    assert scene.info.full_turn
    pose = scene.pose(math.pi / 2)
    for name, place in TURNED.items():
        assert pose.position[name] == pytest.approx(place, abs=2e-15)
    assert pose.velocity["J"] == pytest.approx((-0.00718444, -1.21772424), abs=5e-9)
    assert pose.acceleration["J"] == pytest.approx((0.51436357, 0.27243029), abs=5e-9)


@pytest.mark.parametrize(
    ("document", "words", "links", "joints"),
    [(STEPHENSON_III, "six-bar linkage", 6, 7), (BUTTERFLY, "eight-bar linkage", 8, 10)],
    ids=["six-bar", "eight-bar"],
)
def test_its_class_is_the_textbooks(document: Mapping[str, Any], words: str, links: int, joints: int) -> None:
    info = read(document).info
    assert (info.class_name, *info.counts) == (words, links, joints, 1)
    together = dict(info.lines)["solved together"].split(", ")
    assert together == [name for name in document["links"] if name not in ("ground", "FG", "ACD")]


SCOTCH_YOKE: dict[str, Any] = {
    "points": {"O": [0, 0], "A": [20, 10], "C": [20, -60], "D": [20, 60]},
    "links": {"ground": ["O"], "crank": ["O", "A"], "yoke": ["C", "D"]},
    "slides": {
        "guide": {"link": "yoke", "on": "ground", "angle": "0 deg"},
        "slot": {"point": "A", "on": "yoke", "angle": "90 deg"},
    },
    "drive": {"joint": "O"},
}
GUIDED: dict[str, Any] = {
    "points": {"O": [0, 0], "Q": [100, 0], "A": [10, 30], "B": [60, 60], "C": [90, 45], "E": [100, 90]},
    "links": {
        "ground": ["O", "Q"],
        "crank": ["O", "A"],
        "rod": ["A", "B"],
        "plate": ["B", "C", "E"],
        "rocker": ["Q", "C"],
    },
    "slides": {"slot": {"point": "E", "on": "ground", "angle": "20 deg"}},
    "drive": {"joint": "O"},
}


@pytest.mark.parametrize(
    ("document", "words", "links", "joints"),
    [
        (SCOTCH_YOKE, "four-bar linkage with slider and slot", 4, 4),
        (GUIDED, "six-bar linkage with slot", 6, 7),
    ],
    ids=["Scotch yoke", "guided coupler"],
)
def test_a_pin_in_a_slot_counts_as_its_block(
    document: Mapping[str, Any], words: str, links: int, joints: int
) -> None:
    info = read(document).info
    assert (info.class_name, *info.counts) == (words, links, joints, 1)


def test_a_chain_has_its_groups_in_order() -> None:
    assert dict(load("jansen").info.lines)["groups"] == "dyads B (RRR), C (RRR), E (RRR)"
    assert dict(load("crank-shaper").info.lines)["groups"] == "dyads P (RPR), R (RRP)"
    assert "groups" not in dict(load("crank-rocker").info.lines)


TWO_PINS: dict[str, Any] = {
    "points": {
        "O": [0, 0],
        "G": [60, 10],
        "Q": [150, 20],
        "A": [15, 26],
        "C": [91, 51],
        "E": [123, 75],
        "F": [213, 69],
    },
    "links": {
        "ground": ["O", "G", "Q"],
        "crank": ["O", "A"],
        "rod": ["A", "C"],
        "block": ["C", "E"],
        "link": ["E", "F"],
        "out": ["Q", "F"],
    },
    "slides": {"guide": {"link": "block", "on": "ground", "angle": "30 deg"}},
    "drive": {"joint": "O"},
}


def test_a_block_with_two_pins_is_one_link_and_moves_as_two_dyads_on_parallel_lines() -> None:
    scene = read(TWO_PINS)
    assert (scene.info.class_name, *scene.info.counts) == ("six-bar linkage with slider", 6, 7, 1)
    points = {name: complex(*place) for name, place in TWO_PINS["points"].items()}
    along = complex(math.cos(math.pi / 6), math.sin(math.pi / 6))
    offsets = {name: ((points[name] - points["G"]) / along).imag for name in "CE"}
    line = {"through": "G", "angle": "30 deg"}
    joints = {
        "A": {"crank": "O", "length": abs(points["A"])},
        "C": {"from": "A", "length": abs(points["C"] - points["A"]), "line": line | {"offset": offsets["C"]}},
        "E": {"from": "C", "length": abs(points["E"] - points["C"]), "line": line | {"offset": offsets["E"]}},
        "F": {
            "from": ["E", "Q"],
            "length": [abs(points["F"] - points["E"]), abs(points["F"] - points["Q"])],
            "side": "left",
        },
    }
    ground = {name: TWO_PINS["points"][name] for name in "OGQ"}
    dyads = scene_from({"ground": ground, "joints": joints}, name="dyads", where="dyads.toml")
    angles = np.linspace(0, 6, 50)
    one, other = (each.solve(angle=angles, speed=2.0, acceleration=1.0) for each in (scene, dyads))
    for name in "CEF":
        assert np.abs(one.position[name] - other.position[name]).max() < 1e-13 * 250
        assert np.abs(one.velocity[name] - other.velocity[name]).max() < 1e-13 * 1000
        assert np.abs(one.acceleration[name] - other.acceleration[name]).max() < 1e-12 * 1000


FIVE: dict[str, Any] = {
    "points": {"O": [0, 0], "D": [100, 0], "A": [10, 30], "B": [60, 60], "C": [90, 45], "E": [100, 90]},
    "links": {
        "ground": ["O", "D"],
        "crank": ["O", "A"],
        "AB": ["A", "B"],
        "plate": ["B", "C", "E"],
        "DC": ["D", "C"],
    },
    "drive": {"joint": "O", "speed": "1 rad/s"},
}
BLOCK: dict[str, Any] = {"links": {**FIVE["links"], "block": ["E"]}}
HELD: dict[str, Mapping[str, Any]] = {
    "a block on the ground": {**BLOCK, "slides": {"b": {"link": "block", "on": "ground", "angle": "20 deg"}}},
    "a pin in a slot of the ground": {"slides": {"b": {"point": "E", "on": "ground", "angle": "20 deg"}}},
    "a pin in a slot of the crank": {"slides": {"b": {"point": "E", "on": "crank", "angle": "100 deg"}}},
    "gears between moving links": {"gears": {"g": {"links": ["AB", "DC"], "ratio": "-1/2"}}},
    "a planet's carrier": {"gears": {"g": {"links": ["plate", "DC"], "ratio": 2, "carrier": "AB"}}},
}


@pytest.mark.parametrize("held_by", HELD.values(), ids=HELD)
def test_whatever_holds_the_links_holds_them_all_the_way(held_by: Mapping[str, Any]) -> None:
    scene = read({**FIVE, **held_by})
    motion = scene.solve(phase=np.linspace(0, scene.period, 300), speed=1.0)
    at = {name: place @ [1, 1j] for name, place in motion.position.items()}
    start = {name: complex(*place) for name, place in FIVE["points"].items()}
    for on in FIVE["links"].values():
        for p, q in ((p, q) for p in on for q in on):
            assert np.abs(np.abs(at[p] - at[q]) - abs(start[p] - start[q])).max() < 1e-14 * 300
    turned = {
        name: np.unwrap(np.angle((at[on[1]] - at[on[0]]) / (start[on[1]] - start[on[0]])))
        for name, on in FIVE["links"].items()
    }
    for slide in held_by.get("slides", {}).values():
        along = np.exp(1j * (math.radians(float(slide["angle"].split()[0])) + turned[slide["on"]]))
        aside = ((at["E"] - at["O"]) / along).imag
        assert np.ptp(aside) < 1e-13 * 300
    for gear in held_by.get("gears", {}).values():
        carried, (one, other) = turned.get(gear.get("carrier", "ground")), gear["links"]
        ratio = float(Fraction(gear["ratio"]))
        off = (turned[other] - carried) - ratio * (turned[one] - carried)
        assert np.ptp(np.cos(off)) + np.ptp(np.sin(off)) < 1e-12


BETWEEN: dict[str, Any] = {
    "points": {"O2": [0, 0], "O4": [80, 0], "A": [7.5, 29.05], "B": [64.6, 47.6]},
    "links": {"ground": ["O2", "O4"], "crank": ["O2", "A"], "coupler": ["A", "B"], "rocker": ["O4", "B"]},
    "lengths": {"crank": {"O2-A": 30}, "coupler": {"A-B": 60}, "rocker": {"O4-B": 50}},
    "drive": {"joint": "B", "links": ["coupler", "rocker"], "speed": "1 rad/s"},
}


def test_a_motor_between_two_moving_links_drives_by_the_angle_between_them() -> None:
    scene = read(BETWEEN)
    found = scene.solve(angle=math.pi / 2, speed=1.0)
    assert math.degrees(float(found.angle["crank"])) == pytest.approx(75.52249, abs=5e-6)
    assert found.angular_velocity["rocker"] - found.angular_velocity["coupler"] == pytest.approx(
        1.0, abs=1e-14
    )
    assert found.angular_acceleration["rocker"] == pytest.approx(
        found.angular_acceleration["coupler"], abs=1e-13
    )
    assert scene.info.input_range[0] == pytest.approx(math.acos(0.6), abs=1e-15)


def test_two_closures_that_cross_are_passed_straight_on() -> None:
    # 30 + 80 = 50 + 60: all bars lie in one line where the motor's angle is half a turn
    scene = read(BETWEEN)
    phases = math.pi / 2 + np.linspace(-0.1, 0.1, 401)
    found = scene.solve(phase=phases, speed=1.0)
    for kind in (found.position, found.velocity):
        for name in "AB":
            second = np.abs(np.diff(kind[name], 2, axis=0)).max()
            assert second < 1e-2 * np.abs(np.diff(kind[name], axis=0)).max()
    crossed = scene.solve(angle=math.pi, speed=1.0).position["B"]
    assert crossed == pytest.approx([30, 0], abs=1e-13)


def exact(value: Any) -> Any:
    """Return a sum of two floats with all its digits."""
    return mp.mpf(value.high) + mp.mpf(value.low)


def held(form: str, seed: int) -> None:
    """Assert that a random linkage keeps its bars, and moves as fifty digits say, over its whole period."""
    given = document(form, seed)
    try:
        scene = read(given)
    except AssemblyError:  # two closures come nearer to each other than floats tell apart
        return
    mechanism, path = scene.mechanism, scene.mechanism.assembly.path
    swing = path if isinstance(path, Swing) else None
    cycle, bars = scene.cycle(500), bars_of(scene, given)
    size = float(np.ptp(np.concatenate([*cycle.position.values()]), axis=0).max())
    pace = scene.solve(phase=cycle.phase, speed=1.0)
    rates = (np.concatenate([*kind.values()]) for kind in (pace.velocity, pace.acceleration))
    scales = (size, *(float(np.abs(rate).max()) for rate in rates))
    for (p, q), square in zip(bars.pairs, bars.squares, strict=True):
        length = np.hypot(*(cycle.position[p] - cycle.position[q]).T)
        assert np.abs(length - float(mp.sqrt(square))).max() <= 1e-14 * size
    # without a jump: the second differences are those of a smooth motion
    close = scene.cycle(8000)
    for name in bars.free:
        steps = np.hypot(*np.diff(close.position[name], axis=0).T)
        speeds = np.hypot(*close.velocity[name].T) / abs(scene.linkage.drive.speed) * scene.period / 8000
        assert (steps <= 3 * np.maximum(speeds[1:], speeds[:-1]) + 1e-3 * size).all()
    phases = np.random.default_rng(seed).uniform(0, scene.period, 3)
    if not mechanism.full_turn:
        phases = np.append(phases, [1e-4, math.pi - 1e-6])
    found = scene.solve(phase=phases, speed=1.0)
    low, high = mp.mpf(0), mp.mpf(0)
    if swing:
        ends = (swing.low, 0.0), (swing.high, math.pi)
        low, high = (bars.limit(exact(end), scene.pose(phase).position) for end, phase in ends)
        assert max(abs(low - exact(swing.low)), abs(high - exact(swing.high))) <= 1e-30, (form, seed)
    for n, phase in enumerate(phases):
        start = mp.mpf(path.start) if isinstance(path, Turn) else mp.mpf(0)
        angle, rate, second = start + mp.mpf(phase), mp.mpf(1), mp.mpf(0)
        if swing:
            half = (high - low) / 2
            angle = (high + low) / 2 - half * mp.cos(mp.mpf(phase))
            rate, second = half * mp.sin(mp.mpf(phase)), half * mp.cos(mp.mpf(phase))
        near = {name: found.position[name][n] for name in bars.free}
        places, matrix = bars.closed(angle, near)
        first, bent = bars.rates(angle, places, matrix)
        true = (
            places,
            {name: first[name] * rate for name in first},
            {name: bent[name] * rate**2 + first[name] * second for name in first},
        )
        shown = found.position, found.velocity, found.acceleration
        for order, (own, solved) in enumerate(zip(true, shown, strict=True)):
            off = max(float(abs(own[name] - mp.mpc(*map(float, solved[name][n])))) for name in bars.free)
            assert off <= (1e-14, 1e-14, 1e-12)[order] * scales[order], (form, seed, phase, order)


BESIDE_LIMITS = {"of 0.2 degrees' range": 1393, "with two closures near each other": 27}
"""Butterflies whose solutions beside a limit are lost to rounding where a correction is trusted too far."""


@pytest.mark.slow
def test_a_fast_linkage_loses_nothing_of_its_phase() -> None:
    # its velocity changes by 87 times itself in a radian: half a last digit of a piece's middle would show
    with mp.workdps(50):
        held("triad", 1162)


@pytest.mark.slow
@pytest.mark.parametrize("seed", BESIDE_LIMITS.values(), ids=BESIDE_LIMITS)
def test_the_solutions_beside_a_limit_have_all_their_digits(seed: int) -> None:
    assert read(document("double butterfly", seed)).info.input_range
    with mp.workdps(50):
        held("double butterfly", seed)


FEW, SEVERAL, MANY = 5, 100, 1000


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.slow
def test_a_random_linkage_keeps_its_bars_and_moves_as_fifty_digits_say(form: str) -> None:
    with mp.workdps(50):
        held(form, 0)


@pytest.mark.thinned(13)
@pytest.mark.slow
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("first", range(1, SEVERAL, FEW))
def test_random_linkages_keep_their_bars_and_move_as_fifty_digits_say(form: str, first: int) -> None:
    with mp.workdps(50):
        for seed in range(first, first + FEW):
            held(form, seed)


@pytest.mark.long
@pytest.mark.parametrize("form", FORMS)
def test_a_thousand_random_linkages_of_each_form_do(form: str) -> None:
    with mp.workdps(50):
        for seed in range(1000, 1000 + MANY):
            held(form, seed)
