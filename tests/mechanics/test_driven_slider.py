"""A slider that drives: its travel as asked, all else to many digits, through dead centres; refusals."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest
from chain_reference import places
from limits import Limits
from mpmath import mp, mpf
from reference import DIGITS, HIGHEST_FIRST, NUDGE, derivatives

from linkanim.errors import AssemblyError, BadInput, SceneError
from linkanim.mechanics.forces import input_effort
from linkanim.mechanics.linkage import (
    RPR,
    RRP,
    RRR,
    Body,
    Drive,
    DrivenSlider,
    Joint,
    Line,
    Linkage,
    Pin,
    Rigid,
    Travel,
)
from linkanim.mechanics.motion import mechanism
from linkanim.mechanics.quantities import register
from linkanim.scenes import load
from linkanim.scenes.editing import dimensions, with_dimensions
from linkanim.scenes.reading import scene_from
from linkanim.scenes.toml import parse, text

EPS = 2.0**-52
PHASES = np.array([0.0, 0.3, 1.9, math.pi, 4.0, 5.9])
BODIES = (Body("crank", ("O", "A")), Body("rod", ("C", "A")), Body("piston", slider="C"))


@pytest.fixture(autouse=True)
def many_digits() -> Any:
    with mp.workdps(DIGITS):
        yield


def piston(
    ends: tuple[float, float], *further: Joint, bars: tuple[float, float] = (120.0, 40.0), offset: float = 0.0
) -> Linkage:
    joints = (
        Pin("O", (0.0, 0.0)),
        DrivenSlider("C", Line("O", 0.0, offset)),
        RRR("A", ("C", "O"), bars),
        *further,
    )
    return Linkage(joints, Drive("C", 1.0, actuator=Travel(*ends)), BODIES)


def travelled(linkage: Linkage, phase: Any) -> Any:
    first, last = map(mpf, linkage.drive.actuator.stated_lengths)
    return (first + last) / 2 - (last - first) / 2 * mp.cos(phase)


def posed(linkage: Linkage, touched: str, phase: Any) -> dict[str, Any]:
    """Where the joints lie; at each end that is `touched`, "f"irst or "l"ast, A goes on to its other side."""
    side = 1
    for end, way in (("f", mp.sin(phase / 2)), ("l", mp.cos(phase / 2))):
        side *= -1 if end in touched and way < 0 else 1
    return places(linkage, travelled(linkage, phase), {"A": side})


def worst(linkage: Linkage, touched: str = "", turns: int = 1) -> tuple[float, float]:
    """Return the greatest error of positions, in longest bars, and of rates, in their greatest."""
    solved = mechanism(linkage)
    phases = np.concatenate([PHASES + 2 * math.pi * turn for turn in range(turns)])
    motion = solved.solve(phase=phases, speed=1.0)
    cycle = solved.solve(phase=np.linspace(0, 2 * np.pi * turns, 500), speed=1.0)
    exact = [derivatives(partial(posed, linkage, touched), mpf(float(phase)) + NUDGE) for phase in phases]
    size = max(abs(length) for joint in linkage.joints for _, length in joint.bars)
    errors: list[list[float]] = [[], []]
    for name in (joint.name for joint in linkage.joints if not joint.fixed):
        for order, kind in HIGHEST_FIRST:
            greatest = float(np.hypot(*getattr(cycle, kind)[name].T).max()) if order else size
            errors[order > 0] += [
                float(abs(mp.mpc(*map(float, row)) - pose[order][name])) / greatest
                for row, pose in zip(getattr(motion, kind)[name], exact, strict=True)
            ]
    return max(errors[0]), max(errors[1])


# Towards the crank and away from it, beside its pivot, on bars that could pass each other.
@pytest.mark.parametrize(
    ("ends", "offset"), [((90.0, 150.0), 0.0), ((150.0, 90.0), 0.0), ((-140.0, -95.0), 15.0)]
)
def test_a_slider_crank_driven_at_its_slider_is_right_to_the_last_digits(
    ends: tuple[float, float], offset: float
) -> None:
    position, rate = worst(piston(ends, offset=offset))
    assert position <= 16 * EPS
    assert rate <= 1e-14


# The dead centres: both, one, the other; there the crank goes on turning, or comes back after two periods.
@pytest.mark.parametrize(
    ("ends", "touched", "turns"),
    [
        ((80.0, 160.0), "fl", 1),
        ((160.0, 80.0), "fl", 1),
        ((80.0, 150.0), "f", 2),
        ((150.0, 80.0), "l", 2),
        ((90.0, 160.0), "l", 2),
    ],
)
def test_it_runs_on_through_its_dead_centres(ends: tuple[float, float], touched: str, turns: int) -> None:
    linkage = piston(ends)
    assert mechanism(linkage).periods == turns
    position, rate = worst(linkage, touched, turns)
    assert position <= 16 * EPS
    assert rate <= 1e-13


def test_what_follows_it_is_as_exact() -> None:
    further = (
        Rigid("P", ("C", "A"), (50.0, 20.0)),
        Pin("Q", (-60.0, 90.0)),
        RRR("B", ("P", "Q"), (170.0, 90.0), -1),
        RRP("D", "B", 190.0, Line("Q", 1.2, 5.0)),
        RPR("E", "Q", "P", 60.0, 4.0),
    )
    position, rate = worst(piston((95.0, 150.0), *further))
    assert position <= 1e-14
    assert rate <= 1e-12


@pytest.mark.parametrize("bars", [(7.4, 0.9), (1.8, 0.7), (79 / 25.4, 40 / 25.4)])
@pytest.mark.parametrize("away", [1e4, 1e6 / 25.4, 1e6])
def test_far_from_the_origin_it_runs_through_its_dead_centres_as_near_it(
    bars: tuple[float, float], away: float
) -> None:
    ends = bars[0] - bars[1], bars[0] + bars[1]
    near = piston(ends, bars=bars)
    moved = tuple(
        replace(joint, position=(away, 0.0)) if isinstance(joint, Pin) else joint for joint in near.joints
    )
    phases = np.concatenate([np.linspace(0, 4 * np.pi, 41), np.pi + np.array([-1e-3, -1e-9, 1e-9, 1e-3])])
    here, there = (
        mechanism(one).solve(phase=phases, speed=1.0) for one in (near, replace(near, joints=moved))
    )
    assert there.position["A"] - [away, 0] == pytest.approx(here.position["A"], abs=64 * EPS * away)
    assert there.velocity["A"] == pytest.approx(here.velocity["A"], abs=1e-9 * bars[0])
    assert there.acceleration["A"] == pytest.approx(here.acceleration["A"], abs=1e-8 * bars[0])


def test_the_travel_runs_as_it_is_asked_also_of_extreme_lengths() -> None:
    for size in (1.0, 1e-80, 1e80):
        linkage = piston((90 * size, 150 * size), bars=(120 * size, 40 * size))
        phases = np.linspace(0, 7, 60)
        motion = mechanism(linkage).solve(phase=phases, speed=2.0)
        expected = size * (120 - 30 * np.cos(phases))
        assert motion.travel["piston"] == pytest.approx(expected, rel=4 * EPS)
        assert motion.coordinate == pytest.approx(expected, rel=4 * EPS)
        assert motion.coordinate_rate == pytest.approx(60 * size * np.sin(phases), abs=1e-13 * size)
        assert mechanism(linkage).assembly.path.input_range == pytest.approx((90 * size, 150 * size))


def test_one_pose_is_one_of_many() -> None:
    solved = mechanism(piston((80.0, 160.0)))
    motion = solved.solve(phase=PHASES, speed=1.0)
    for n, phase in enumerate(PHASES.tolist()):
        pose = solved.pose(phase, 1.0, 0.0, 2)
        assert pose.position["A"] == tuple(motion.position["A"][n])
        assert pose.acceleration["A"] == tuple(motion.acceleration["A"][n])
        assert pose.coordinate == motion.coordinate[n]


def test_coefficients_are_by_the_travel() -> None:
    scene = load("driven-piston")
    motion = scene.solve(phase=np.array([0.7, 2.0]), speed=3.0)
    first, second = motion.coefficient["piston"]
    assert first == pytest.approx(1.0)
    assert second == pytest.approx(0.0, abs=1e-15)
    assert motion.coefficient["crank"][0] == pytest.approx(
        motion.angular_velocity["crank"] / motion.coordinate_rate
    )
    known = register(scene.linkage)
    assert known["crank.coefficient"].unit == "rad/{}"
    assert known["input.velocity"].read(motion) == pytest.approx(motion.travel_velocity["piston"])
    assert "mechanical_advantage" not in known


def test_the_force_that_drives_a_piston_is_along_its_line() -> None:
    scene = scene_from(parse(FILE + 'mass = "2 kg"\n', "my"), name="my", where="my")
    motion = scene.solve(phase=np.linspace(0.0, 6.0, 9))
    assert input_effort(motion) == pytest.approx(2e-2 * motion.travel_acceleration["piston"], rel=1e-12)


# What stops the slider short, with how far it may go.
@pytest.mark.parametrize(
    ("ends", "words"),
    [
        ((70.0, 150.0), "run from 80 to 150 m only, not from 70 to 150 m"),
        ((90.0, 170.0), "run from 90 to 160 m only"),
        ((70.0, 170.0), "run from 80 to 160 m only"),
        ((170.0, 70.0), "run from 80 to 160 m only, not from 170 to 70 m"),
        ((200.0, 300.0), "cannot meet at any angle"),
    ],
)
def test_a_travel_that_cannot_be_is_refused_with_what_can(ends: tuple[float, float], words: str) -> None:
    with pytest.raises(AssemblyError, match=words):
        mechanism(piston(ends))


AWAY, ABOVE = Pin("P", (100.0, 40.0)), RRR("X", ("A", "P"), (60.0, 50.0))

# At its dead centres the crank has no rate, and neither has what stands on it; before them it does not close.
BESIDE = {
    "a slot that just misses": ((80.0, 160.0), (Pin("P", (0.0, 100.0)), RPR("X", "P", "A", 1.0, 59.99)), ""),
    "a slot on a bar": ((1e-13, 160.0), (RPR("X", "C", "A", 1.0),), "joint A: .* from 80 to 160 m only"),
    "a slot of a pin": ((0.0, 160.0), (Pin("P", (0, 100.0)), RPR("X", "P", "A", 1.0)), "joint A: .* from 80"),
    "a dyad beside it": ((80.0, 160.0), (AWAY, ABOVE), "joint X: .* travel run from"),
    "a dyad on a dyad": ((80.0, 150.0), (AWAY, ABOVE, RRR("Y", ("X", "C"), (70.0, 80.0))), "joint X: .* run"),
}


@pytest.mark.parametrize("name", BESIDE)
def test_what_stands_on_a_crank_at_its_dead_centre_is_looked_at_within_limits(name: str) -> None:
    ends, further, words = BESIDE[name]
    with Limits(2.0, 200).held():
        if not words:
            assert mechanism(piston(ends, *further)).assembly.path.input_range == ends
            return
        with pytest.raises(AssemblyError, match=words):
            mechanism(piston(ends, *further))


FILE = """
length_unit = "cm"
[drive]
speed = "12 rpm"
slider = { joint = "C", from = 90, to = 150 }
[ground]
O = [0, 0]
[joints.C]
line = { through = "O", angle = "0 deg" }
[joints.A]
from = ["C", "O"]
length = [120, 40]
[bodies.piston]
slider = "C"
"""


def test_a_scene_file_says_it_is_edited_and_written_back_to_the_same_motion() -> None:
    scene = scene_from(parse(FILE, "my.toml"), name="my", where="my.toml")
    assert scene.linkage.drive.actuator == Travel(90.0, 150.0)
    again = scene_from(parse(text(scene), "my.toml"), name="my", where="my.toml")
    assert again.linkage == scene.linkage
    assert scene.info.input_range == (90.0, 150.0)
    assert {"Slider, from", "Slider, to"} <= {item.label for item in dimensions(scene)}
    turning = with_dimensions(scene, {("drive", "slider", "from"): 80})
    turning = with_dimensions(turning, {("drive", "slider", "to"): "1.6 m"})
    assert turning.info.toggles == pytest.approx((80.0, 160.0))
    assert turning.info.change_points == ()
    assert dict(turning.info.lines)["input"] == "slides 80…160 cm"
    assert turning.info.class_name == "slider-crank driven at its slider"


def test_it_has_no_angle() -> None:
    with pytest.raises(BadInput, match="has no angle; take the phase"):
        load("driven-piston").solve(angle=1.0)
    with pytest.raises(BadInput, match="no angle"):
        load("driven-piston").mechanism.solve(angle=1.0, speed=1.0)
    for motion in (load("driven-piston").pose(1.0), load("driven-piston").solve(phase=[1.0])):
        with pytest.raises(
            AttributeError, match="a slider drives, which has no crank angle; read coordinate"
        ):
            _ = motion.crank_angle
        with pytest.raises(AttributeError, match="has no 'crank_angel'"):
            _ = motion.crank_angel
    assert load("press").pose(1.0).crank_angle == load("press").pose(1.0).coordinate


@pytest.mark.parametrize(
    ("old", "new", "where", "words"),
    [
        pytest.param('joint = "C"', 'joint = "A"', "slider.joint", "that is C", id="a joint of a dyad"),
        pytest.param("to = 150", "to = 90", "slider.to", "nothing would move", id="no travel"),
        pytest.param(
            "to = 150", "to = 90.0000000000001", "slider.to", "nothing would move", id="next to no travel"
        ),
        pytest.param(", to = 150", "", "drive.slider", '"to" is missing', id="no end"),
        pytest.param("from = 90", "form = 90", "slider.form", "did you mean", id="a misspelt key"),
        pytest.param("speed", 'start = "3 deg"\nspeed', "drive.start", "leave it out", id="a start"),
        pytest.param("slider = {", "slider2 = {", "drive.slider2", "did you mean", id="a misspelt drive"),
        pytest.param(
            'slider = { joint = "C", from = 90, to = 150 }', "", "joints.C", "drive it", id="no drive"
        ),
        pytest.param(
            "[joints.A]", '[joints.D]\ncrank = "O"\nlength = 3\n[joints.A]', "D", "second input", id="a crank"
        ),
        pytest.param(
            "[joints.A]",
            '[joints.D]\nline = { through = "O" }\n[joints.A]',
            "D",
            "second input",
            id="a second slider",
        ),
        pytest.param(
            'angle = "0 deg" }', 'on = ["O", "A"] }', "line.on", "fixed line", id="a line that is carried"
        ),
        pytest.param("[joints.A]", 'side = "forward"\n[joints.A]', "side", "no second closure", id="a side"),
    ],
)
def test_a_wrong_slider_is_refused_where_it_stands(old: str, new: str, where: str, words: str) -> None:
    with pytest.raises(SceneError) as refusal:
        scene_from(parse(FILE.replace(old, new), "my.toml"), name="my", where="my.toml")
    assert where in str(refusal.value)
    assert words in str(refusal.value)


def test_a_rail_that_the_slider_s_own_end_stops_is_refused_without_a_warning() -> None:
    # At 65 the rod and the crank are in one line: an unbounded rate, where the rail's bar changes nothing.
    rail = RRP("R", "C", 92.0, Line("O", on=("O", "A")))
    with pytest.raises(AssemblyError, match=r"93\.9415 m only"):
        mechanism(piston((65.0, 165.0), rail, bars=(115.0, 50.0)))
