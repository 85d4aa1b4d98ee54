"""A cylinder that drives a crank: its length as asked, all else to many digits, refusals with the way out."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np
import pytest
from chain_reference import places
from mpmath import mp, mpf
from reference import DIGITS, HIGHEST_FIRST, derivatives

from linkanim.errors import AssemblyError, SceneError
from linkanim.mechanics.linkage import (
    RRP,
    RRR,
    Body,
    Crank,
    Cylinder,
    Drive,
    Gear,
    Joint,
    Line,
    Linkage,
    Pin,
    Rigid,
)
from linkanim.mechanics.motion import Mechanism, mechanism
from linkanim.scenes.reading import scene_from
from linkanim.scenes.toml import parse, text

PHASES = np.array([0.0, 0.4, 1.9, math.pi, 4.0, 5.5])


@pytest.fixture(autouse=True)
def many_digits() -> Any:
    with mp.workdps(DIGITS):
        yield


def boom(first: float, last: float, *further: Joint, start: float = 0.0) -> Linkage:
    joints = (
        Pin("O2", (0.0, 0.0)),
        Pin("G", (80.0, -60.0)),
        Crank("A", "O2", 400.0),
        Rigid("H", ("O2", "A"), (200.0, 30.0)),
        *further,
    )
    drive = Drive("A", 1.0, start, Cylinder(("G", "H"), first, last))
    return Linkage(joints, drive, (Body("boom", ("O2", "A")),))


def angle_at(linkage: Linkage, side: int, phase: Any) -> Any:
    """The crank's angle by the law of cosines, the joint on the left of pivot -> pin for side +1."""
    (first, last), at = map(mpf, linkage.drive.actuator.stated_lengths), mp.mpc(*map(mpf, (200, 30)))
    length = (first + last) / 2 - (last - first) / 2 * mp.cos(phase)
    ground, arm = mp.mpc(80, -60), abs(at)
    psi = mp.acos((abs(ground) ** 2 + arm**2 - length**2) / (2 * abs(ground) * arm))
    return mp.arg(ground) + side * psi - mp.arg(at)


def posed(linkage: Linkage, side: int, phase: Any) -> dict[str, Any]:
    return places(linkage, angle_at(linkage, side, phase))


def check(linkage: Linkage, side: int, names: str) -> None:
    solved = mechanism(linkage)
    motion = solved.solve(phase=PHASES, speed=1.0)
    cycle = solved.solve(phase=np.linspace(0, 2 * np.pi, 500), speed=1.0)
    exact = [derivatives(partial(posed, linkage, side), mpf(float(phase))) for phase in PHASES]
    for name in names:
        for order, kind in HIGHEST_FIRST:
            size = float(np.hypot(*getattr(cycle, kind)[name].T).max()) if order else 400.0
            found = getattr(motion, kind)[name]
            errors = [
                float(abs(mp.mpc(*map(float, row)) - pose[order][name])) / size
                for row, pose in zip(found, exact, strict=True)
            ]
            assert max(errors) <= (1e-12 if order else 1e-14), (kind, name)


@pytest.mark.parametrize(("first", "last"), [(200.0, 300.0), (300.0, 200.0), (105.0, 301.0)])
@pytest.mark.parametrize(("start", "side"), [(1.0, 1), (-2.5, -1)])
def test_a_crank_on_a_cylinder_is_right_to_the_last_digits(
    first: float, last: float, start: float, side: int
) -> None:
    check(boom(first, last, start=start), side, "AH")


def test_dyads_and_geared_cranks_follow_it() -> None:
    further = (
        Pin("Q", (420.0, 40.0)),
        RRR("B", ("A", "Q"), (420.0, 330.0), 1),
        RRP("C", "B", 500.0, Line("Q", 0.2), 1),
        Crank("D", "Q", 50.0, Gear("A", Fraction(-1), 0.3)),
        Crank("E", "Q", 50.0, Gear("A", Fraction(5, 2), 0.3)),
        Crank("F", "Q", 50.0, Gear("A", Fraction(2), 0.3)),
    )
    check(boom(200.0, 280.0, *further, start=1.0), 1, "ABCDEF")


def test_the_length_runs_as_it_is_asked() -> None:
    solved = mechanism(boom(200.0, 300.0))
    phases = np.linspace(0, 7, 60)
    place = solved.solve(phase=phases, speed=1.0, derivatives=0).position
    length = np.hypot(*(place["H"] - place["G"]).T)
    assert length == pytest.approx(250 - 50 * np.cos(phases), rel=1e-14)
    assert solved.periods == 1


def test_one_pose_is_one_of_many_and_by_angle_it_is_the_same() -> None:
    solved = mechanism(boom(200.0, 300.0, RRR("B", ("A", "G"), (300.0, 350.0), -1)))
    motion = solved.solve(phase=PHASES, speed=1.0)
    for n, phase in enumerate(PHASES.tolist()):
        pose = solved.pose(phase, 1.0, 0.0, 2)
        assert pose.position["B"] == pytest.approx(tuple(motion.position["B"][n]), rel=1e-15)
        assert pose.coordinate == pytest.approx(motion.coordinate[n], rel=1e-15)
    angles = motion.coordinate[1:3]
    by_angle = solved.solve(angle=angles, speed=1.0)
    assert by_angle.position["B"] == pytest.approx(motion.position["B"][1:3], rel=1e-13)
    assert by_angle.phase == pytest.approx(PHASES[1:3], rel=1e-12)
    beyond = solved.solve(angle=np.array([0.0, float(angles[0]), 3.0]), speed=1.0)
    assert np.isnan(beyond.position["B"][[0, 2]]).all()
    assert np.isnan(beyond.phase[[0, 2]]).all()
    assert np.isfinite(beyond.position["B"][1]).all()


def test_a_phase_is_found_for_every_angle_of_its_range() -> None:
    path = mechanism(boom(200.0, 300.0)).assembly.path
    for phase in (0.2, 1.5, 3.0):
        angle = float(path.coordinates(np.array([phase]))[0])
        assert path.phase_of(angle, near=phase + 0.1) == pytest.approx(phase, abs=1e-9)
        assert path.phase_of(angle, near=2 * math.pi - phase) == pytest.approx(2 * math.pi - phase, abs=1e-9)
        assert path.holds(angle)
    assert not path.holds(path.input_range[1] + 0.01)


# Lengths that the triangle cannot have, a stroke that a dyad or a loop stops.
@pytest.mark.parametrize(
    ("make", "words"),
    [
        pytest.param(lambda: boom(90.0, 200.0), "it can be 102.237 to 302.237 m long", id="too short"),
        pytest.param(lambda: boom(200.0, 303.0), "it can be 102.237 to 302.237 m long", id="too long"),
        pytest.param(
            lambda: boom(200.0, 300.0, Pin("Q", (700.0, 0.0)), RRR("B", ("A", "Q"), (300.0, 350.0))),
            "turn the crank",
            id="bars that meet over a part of the stroke",
        ),
    ],
)
def test_a_stroke_that_cannot_be_is_refused_with_what_can(make: Any, words: str) -> None:
    with pytest.raises(AssemblyError, match=words):
        mechanism(make())


@pytest.mark.slow
def test_random_booms_close_and_come_back() -> None:
    rng = random.Random(3)
    tried = 0
    while tried < 60:
        g, r = rng.uniform(20, 300), rng.uniform(20, 300)
        low, high = abs(g - r), g + r
        first, last = (low + (high - low) * rng.uniform(0.02, 0.98) for _ in range(2))
        if abs(first - last) < 1e-3:
            continue
        tried += 1
        solved = _simple(g, r, (first, last), rng.uniform(-3, 3))
        place = solved.solve(phase=np.linspace(0, 2 * np.pi, 97), speed=1.0, derivatives=2)
        assert all(np.isfinite(getattr(place, kind)["A"]).all() for kind in ("position", "acceleration"))
        length = np.hypot(*(place.position["A"] - place.position["G"]).T)
        wanted = (first + last) / 2 - (last - first) / 2 * np.cos(place.phase)
        assert length == pytest.approx(wanted, abs=2e-15 * (g + r) ** 2 / min(first, last))


def _simple(g: float, r: float, ends: tuple[float, float], start: float) -> Mechanism:
    joints = (Pin("O2", (0.0, 0.0)), Pin("G", (g, 0.0)), Crank("A", "O2", r))
    return mechanism(Linkage(joints, Drive("A", 1.0, start, Cylinder(("G", "A"), *ends))))


FILE = """
length_unit = "cm"
[drive]
speed = "12 rpm"
cylinder = { between = ["G", "H"], from = 200, to = 300, joint = "A" }
[ground]
O2 = [0, 0]
G = [80, -60]
[joints.A]
crank = "O2"
length = 400
[joints.H]
on = ["O2", "A"]
at = [200, 30]
[joints.P]
from = ["A", "G"]
length = [300, 350]
"""


def test_a_scene_file_says_it_and_is_written_back_to_the_same_motion() -> None:
    scene = scene_from(parse(FILE, "my.toml"), name="my", where="my.toml")
    assert scene.linkage.drive.actuator == Cylinder(("G", "H"), 200.0, 300.0)
    again = scene_from(parse(text(scene), "my.toml"), name="my", where="my.toml")
    assert again.linkage == scene.linkage
    assert scene.info.full_turn is False
    assert scene.period == 2 * math.pi


@pytest.mark.parametrize(
    ("old", "new", "where", "words"),
    [
        pytest.param('["G", "H"]', '["G", "P"]', "between", "turns with A", id="a joint of another body"),
        pytest.param('["G", "H"]', '["A", "H"]', "between", "names no fixed pin", id="no end on the ground"),
        pytest.param('["G", "H"]', '["O2", "H"]', "between", "names no fixed pin", id="on the crank's pivot"),
        pytest.param("to = 300", "to = 200", "cylinder.to", "nothing would move", id="no stroke"),
        pytest.param(
            "to = 300", "to = 200.0000000000001", "cylinder.to", "nothing would move", id="next to no stroke"
        ),
        pytest.param("from = 200", "from = -2", "cylinder.from", "above zero", id="a negative length"),
        pytest.param("from = 200", "form = 200", "cylinder.form", "did you mean", id="a misspelt key"),
        pytest.param('joint = "A"', 'joint = "H"', "joint", "not a crank", id="no crank"),
    ],
)
def test_a_wrong_cylinder_is_refused_where_it_stands(old: str, new: str, where: str, words: str) -> None:
    with pytest.raises(SceneError) as refusal:
        scene_from(parse(FILE.replace(old, new), "my.toml"), name="my", where="my.toml")
    assert where in str(refusal.value)
    assert words in str(refusal.value)
