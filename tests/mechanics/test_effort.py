"""What the input has to deliver: closed formulas, and energy that is kept or used up over a period."""

from __future__ import annotations

import math
from dataclasses import replace

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.mechanics.forces import input_effort, input_power
from linkanim.mechanics.linkage import Damper, Linkage, Spring
from linkanim.mechanics.quantities import register
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse

PHASES = np.linspace(0.3, 6.1, 17)
ENGINE = """
length_unit = "mm"
[drive]
speed = "3000 rpm"
[slider-crank]
crank = 40
rod = 120
[bodies.slider]
slider = "B"
mass = "600 g"
"""
FLYWHEEL = """
length_unit = "cm"
gravity = "9.81 m/s^2"
[drive]
speed = "60 rpm"
[ground]
O = [0, 0]
[joints.A]
crank = "O"
length = 20
[bodies.wheel]
joints = ["O", "A"]
com = [12, 0]
mass = "3 kg"
inertia = "200 kg cm^2"
"""


def scene_of(text: str) -> Scene:
    return scene_from(parse(text, "my.toml"), name="my", where="my.toml")


def effort(scene: Scene, *, speed: float, acceleration: float = 0.0) -> NDArray[np.float64]:
    motion = scene.solve(phase=PHASES, speed=speed, acceleration=acceleration)
    return np.asarray(input_effort(motion))


@pytest.mark.parametrize("speed", [2.0, -50.0])
def test_a_massive_piston_asks_for_the_torque_of_the_closed_formula(speed: float) -> None:
    r, rod, mass = 0.04, 0.12, 0.6
    s, c = np.sin(PHASES), np.cos(PHASES)
    lean = np.sqrt(rod**2 - (r * s) ** 2)
    slope = -r * s - r**2 * s * c / lean
    bend = -r * c - r**2 * (c**2 - s**2) / lean - (r**2 * s * c) ** 2 / lean**3
    assert effort(scene_of(ENGINE), speed=speed) == pytest.approx(mass * bend * slope * speed**2, rel=1e-12)


# What stands at a dead centre takes nothing, whatever it weighs, and whoever pulls at it.
IDLE = {
    "a mass": ENGINE,
    "a spring": ENGINE.replace('mass = "600 g"', "")
    + '[ground]\nG = [200, 0]\n[springs.s]\nbetween = ["B", "G"]\nstiffness = "9 N/mm"\nfree_length = 90\n',
    "a damper": ENGINE.replace('mass = "600 g"', "")
    + '[ground]\nG = [200, 0]\n[dampers.d]\nbetween = ["B", "G"]\ncoefficient = "90 N s/m"\n',
    "an input that swings": ENGINE.replace("rod = 120", "rod = 30"),
}


@pytest.mark.parametrize("text", IDLE.values(), ids=IDLE)
@pytest.mark.parametrize("angle", [0.0, math.pi, 2 * math.pi])
def test_at_a_dead_centre_the_effort_is_exactly_0(text: str, angle: float) -> None:
    scene = scene_of(text)
    if not scene.info.full_turn:
        angle = 0.0
    motion = scene.solve(angle=np.array([angle]))
    assert np.asarray(input_effort(motion)).tolist() == [0.0]
    assert input_effort(scene.pose(float(motion.phase[0]))) == 0.0


def test_a_flywheel_out_of_balance_is_turned_against_gravity_and_its_inertia() -> None:
    gravity = 3.0 * 9.81 * 0.12 * np.cos(PHASES)
    assert effort(scene_of(FLYWHEEL), speed=4.0) == pytest.approx(gravity, rel=1e-12)
    turning = (0.02 + 3.0 * 0.12**2) * 5.0
    accelerated = effort(scene_of(FLYWHEEL), speed=-4.0, acceleration=5.0)
    assert accelerated == pytest.approx(gravity + turning, rel=1e-12)


def test_from_rest_it_is_what_starts_the_motion() -> None:
    started = effort(scene_of(FLYWHEEL), speed=0.0, acceleration=5.0)
    assert started == pytest.approx(effort(scene_of(FLYWHEEL), speed=4.0, acceleration=5.0), rel=1e-12)
    assert np.isnan(effort(scene_of(FLYWHEEL), speed=0.0)).all()


def test_lengths_in_another_unit_ask_for_the_same() -> None:
    metres = ENGINE.replace('"mm"', '"m"').replace("= 40", "= 0.04").replace("= 120", "= 0.12")
    assert effort(scene_of(metres), speed=7.0) == pytest.approx(
        effort(scene_of(ENGINE), speed=7.0), rel=1e-12
    )


def heavy(scene: Scene, *, mass: bool = True, gravity: float = 0.0) -> Linkage:
    """Return a scene's linkage without its struts, its bodies with a mass off their axis and an inertia."""
    bodies = tuple(
        replace(
            body, mass=0.3, com=None if body.slider else (12.0, 5.0), inertia=None if body.slider else 4e-5
        )
        for body in scene.linkage.bodies
    )
    bare = replace(scene.linkage, springs=(), dampers=(), gravity=gravity)
    return replace(bare, bodies=bodies) if mass else bare


def sprung(scene: Scene, struts: tuple[Spring | Damper, ...]) -> Linkage:
    """Return a scene's linkage without masses, with these struts."""
    springs = tuple(strut for strut in struts if isinstance(strut, Spring))
    dampers = tuple(strut for strut in struts if isinstance(strut, Damper))
    return replace(heavy(scene, mass=False), springs=springs, dampers=dampers)


def netted(scene: Scene, linkage: Linkage, count: int = 2880) -> tuple[float, float]:
    """Return the work over a true period, and the most that is stored on the way, both in J."""
    made = replace(scene, linkage=linkage)
    power = np.asarray(input_power(made.cycle(count * made.mechanism.periods)))
    seconds = made.info.period_seconds / len(power)
    return float(power.sum()) * seconds, float(np.abs(np.cumsum(power)).max()) * seconds


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_masses_and_gravity_give_back_over_a_period_what_they_took(name: str) -> None:
    scene = load(name)
    free, lifted = (netted(scene, heavy(scene, gravity=gravity)) for gravity in (0.0, 9.81))
    # coupled wheels move as fast at every instant: of what is nothing at all rounding has its share
    peak = max(free[1], lifted[1])
    assert abs(free[0]) <= 1e-12 * peak
    assert abs(lifted[0]) <= 1e-12 * peak


def test_a_spring_whose_ends_both_move_takes_its_force_times_its_rate() -> None:
    scene = load("six-bar")
    scene = replace(scene, linkage=sprung(scene, (Spring("s", ("A", "D"), 300.0, 20.0),)))
    motion = scene.solve(phase=PHASES, speed=4.0)
    power = motion.spring["s"].force * motion.spring["s"].rate * 1e-3
    assert effort(scene, speed=4.0) * 4.0 == pytest.approx(power, rel=1e-12)


SPRING = Spring("s", ("O4", "P"), 300.0, 20.0)
DAMPER = Damper("d", ("O4", "P"), 40.0)


@pytest.mark.parametrize("name", ["crank-rocker", "double-rocker", "kite", "galloway", "triple-rocker"])
def test_a_spring_does_no_work_over_a_period_and_a_damper_what_it_uses_up(name: str) -> None:
    scene = load(name)
    work, peak = netted(scene, sprung(scene, (SPRING,)))
    assert abs(work) <= 1e-12 * peak
    damped = replace(scene, linkage=sprung(scene, (SPRING, DAMPER)))
    work, peak = netted(scene, damped.linkage)
    cycle = damped.cycle(2880 * damped.mechanism.periods)
    used = 40.0 * np.mean(np.square(cycle.damper["d"].rate * 1e-3)) * damped.info.period_seconds
    assert work == pytest.approx(used, abs=1e-12 * peak)
    told = damped.info.demand
    assert told is not None
    assert told.work == pytest.approx(used, rel=1e-12)


def test_at_the_ends_of_a_cylinder_s_stroke_the_force_is_finite_and_steady() -> None:
    scene = load("excavator")
    boom = replace(scene, linkage=heavy(scene, gravity=9.81))
    read = register(boom.linkage)["input.force"].read
    found = read(boom.solve(phase=np.array([-1e-5, 0.0, 1e-5, math.pi - 1e-5, math.pi, math.pi + 1e-5])))
    assert np.isfinite(found).all()
    assert found[[1, 4]] == pytest.approx(found[[0, 3]], rel=1e-8)
    assert found[[1, 4]] == pytest.approx(found[[2, 5]], rel=1e-8)
    assert read(boom.pose(0.0)) == pytest.approx(found[1], rel=1e-13)
    assert "input.torque" not in register(boom.linkage)


def test_a_cylinder_lifts_what_gravity_pulls_at() -> None:
    scene = load("excavator")
    boom = replace(scene, linkage=heavy(scene, gravity=9.81))
    motion = boom.solve(phase=PHASES, speed=1e-3)
    lengths = boom.solve(phase=PHASES[:, None] + np.array([-1e-4, 1e-4]), derivatives=0)
    length = np.hypot(*np.moveaxis(lengths.position["H"] - lengths.position["G"], -1, 0)) * 1e-2
    height = sum(lengths.com_position[body.name][..., 1] for body in boom.linkage.bodies) * 1e-2
    lifted = 0.3 * 9.81 * np.diff(height, axis=1) / np.diff(length, axis=1)
    assert input_effort(motion) == pytest.approx(lifted[:, 0], rel=1e-6)


def test_at_a_limit_the_torque_is_unbounded_and_said_to_be() -> None:
    scene = load("double-rocker")
    swinging = replace(scene, linkage=heavy(scene))
    assert np.isinf(input_effort(swinging.pose(0.0)))
    told = swinging.info.demand
    assert told is not None
    assert (told.peak, told.mean) == (None, None)
    torque = np.abs(input_effort(swinging.cycle(100_000)))
    assert swinging.info.usual_effort == pytest.approx(np.median(torque[np.isfinite(torque)]), rel=1e-2)
    lines = dict(swinging.info.lines)
    assert (lines["work per period"], lines["peak torque"]) == ("0 J", "unbounded")
    assert lines["mean torque"] == "undefined, since the torque is unbounded at a limit"


STRETCHED = """
length_unit = "mm"
{gravity}
[drive]
speed = "20 rpm"
slider = {{ joint = "C", from = {way[0]}, to = {way[1]} }}
[ground]
O = [0, 0]
[joints.C]
line = {{ through = "O", angle = "0 deg" }}
[joints.K]
from = ["C", "O"]
length = [110, 120]
side = "left"
[bodies.upper]
joints = ["O", "K"]
com = [60, 0]
mass = "{mass} kg"
"""


# A slider pushes two bars straight: at the end of its way only, the far one falls while the slider rests.
@pytest.mark.parametrize("way", [(110, 230), (230, 110)], ids=["to the limit", "from the limit"])
@pytest.mark.parametrize("mass", [1e-12, 1.0, 1e12])
def test_what_is_unbounded_at_one_limit_is_told_however_light_or_heavy(
    mass: float, way: tuple[int, int]
) -> None:
    told = scene_of(STRETCHED.format(gravity='gravity = "9.81 m/s^2"', mass=mass, way=way)).info.demand
    assert told is not None
    assert (told.peak, told.mean) == (None, None)
    # Without gravity it comes through as fast as it goes, and takes no power there.
    free = scene_of(STRETCHED.format(gravity="", mass=mass, way=way)).info.demand
    assert free is not None
    assert free.peak == pytest.approx(0.0172281 * mass, rel=1e-5)
    assert free.mean == pytest.approx(0.0153863537641 * mass, rel=1e-9)


def test_the_peak_is_the_greatest_torque_and_the_mean_makes_the_work() -> None:
    scene = load("press")
    told = scene.info.demand
    assert told is not None
    assert told.mean is not None
    assert told.peak is not None
    assert told.work == pytest.approx(told.mean * 2 * math.pi, rel=1e-12)
    torque = np.asarray(input_effort(scene.cycle(100_000)))
    assert told.peak == pytest.approx(torque[np.abs(torque).argmax()], rel=1e-8)
    assert np.abs(torque).max() <= abs(told.peak) * (1 + 1e-12)
    assert scene.info.usual_effort == pytest.approx(np.median(np.abs(torque)), rel=1e-3)


def test_what_has_neither_force_nor_mass_asks_for_nothing() -> None:
    scene = load("crank-rocker")
    assert (scene.info.demand, scene.info.usual_effort) == (None, None)
    assert not any(token.startswith("input.t") for token in register(scene.linkage))


@pytest.mark.parametrize("way", [(110, 230), (230, 110)], ids=["to the limit", "from the limit"])
def test_at_a_limit_that_takes_no_power_the_force_is_that_beside_it(way: tuple[int, int]) -> None:
    scene = scene_of(STRETCHED.format(gravity="", mass=1.0, way=way))
    phases = np.array([0.0, math.pi, 2 * math.pi])
    found, beside = (np.asarray(input_effort(scene.solve(phase=phases + off))) for off in (0.0, 1e-4))
    assert found == pytest.approx(beside, rel=1e-3)
    assert [input_effort(scene.pose(float(phase))) for phase in phases] == pytest.approx(found.tolist())


DAMPED = {
    "drive": {"slider": {"joint": "C", "from": 9, "to": 14.2}},
    "ground": {"O2": [0, 0]},
    "joints": {
        "C": {"line": {"through": "O2", "angle": "0 deg"}},
        "A": {"from": ["C", "O2"], "length": [26, 35], "side": "left"},
    },
    "dampers": {"cushion": {"between": ["O2", "C"], "coefficient": "1e-29 N s/m"}},
}


@pytest.mark.parametrize("half_turns", range(5))
def test_where_only_what_takes_no_force_moves_on_at_a_limit_the_force_is_0(half_turns: int) -> None:
    scene = scene_from(DAMPED, name="my", where="my.toml")
    for beside in (0.0, 1e-15, -1e-15):
        assert input_effort(scene.pose(half_turns * math.pi + beside)) == 0


SPRUNG = """
length_unit = "mm"
[four-bar]
ground = 90
crank = 170
coupler = 130
rocker = 80
[springs.coil]
between = ["A", "O4"]
stiffness = "4 N/mm"
free_length = 30
"""


def test_what_stands_with_the_input_at_a_limit_takes_what_it_takes_beside() -> None:
    scene = scene_of(SPRUNG)
    for limit in (math.pi, 2 * math.pi):
        beside = input_effort(scene.pose(limit + 1e-4))
        assert [input_effort(scene.pose(limit + off)) for off in (0.0, 1e-15, -1e-15)] == pytest.approx(
            [beside] * 3, rel=1e-6
        )


GEARED = """
length_unit = "mm"
[drive]
joint = "A"
speed = "20 rpm"
[ground]
O = [0, 0]
Q = [300, 0]
G = [0, 150]
[joints.A]
crank = "O"
length = 40
[joints.D]
crank = "Q"
length = 17
gear = {{ with = "A", ratio = "{ratio}", offset = "10 deg" }}
[springs.coil]
between = ["A", "G"]
stiffness = "900 N/m"
free_length = 60
[springs.quick]
between = ["D", "G"]
stiffness = "70 N/m"
free_length = 90
"""


@pytest.mark.parametrize("ratio", ["77", "-38.5", "5/2"])
def test_the_peak_beside_a_quick_gear_is_the_greatest_torque(ratio: str) -> None:
    scene = scene_of(GEARED.format(ratio=ratio))
    asked = scene.info.demand
    assert asked is not None
    assert asked.peak is not None
    torque = np.abs(input_effort(scene.cycle(300_000)))
    assert np.abs(torque).max() <= abs(asked.peak) * (1 + 1e-12)
    assert abs(asked.peak) == pytest.approx(torque.max(), rel=1e-5)


CROSSING = """
length_unit = "mm"
[drive]
joint = "A"
speed = "20 rpm"
[ground]
O = [0, 0]
[joints.A]
crank = "O"
length = 40
[joints.D]
crank = "O"
length = 40
gear = {{ with = "A", ratio = -1, offset = "{offset}" }}
[springs.coil]
between = ["A", "D"]
stiffness = "500 N/m"
free_length = 30
"""


@pytest.mark.parametrize("offset", ["0 deg", "0.1 deg", "77.77 deg"])
def test_a_spring_that_runs_through_no_length_does_no_work(offset: str) -> None:
    scene = scene_of(CROSSING.format(offset=offset))
    asked = scene.info.demand
    assert asked is not None
    assert (asked.work, asked.mean) == (0.0, 0.0)
    assert asked.peak is not None
    assert dict(scene.info.lines)["work per period"] == "0 J"
    damped = scene_of(
        CROSSING.format(offset=offset) + '[dampers.cushion]\nbetween = ["A", "D"]\ncoefficient = "20 N s/m"\n'
    )
    asked, rate = damped.info.demand, 0.08 * damped.linkage.drive.speed
    assert asked is not None
    assert asked.work == pytest.approx(20 * rate**2 / 2 * damped.info.period_seconds, rel=1e-12)


STARTS = {
    "a slow piston": (ENGINE, 0.01 * math.pi / 30, 2.0),
    "a piston that hardly moves": (ENGINE, 1e-9, 2.0),
    "backwards": (ENGINE, -1e-6, 2.0),
    "an input that swings": (ENGINE.replace("rod = 120", "rod = 30"), 1e-6, -2.0),
    "a slider that drives": (STRETCHED.format(gravity="", mass=1.0, way=(120, 200)), 1e-5, 3.0),
}


@pytest.mark.parametrize(("text", "speed", "acceleration"), STARTS.values(), ids=STARTS)
@pytest.mark.thinned(2)
def test_an_input_that_is_slow_and_speeds_up_asks_for_what_starts_it(
    text: str, speed: float, acceleration: float
) -> None:
    scene = scene_of(text)
    phases = np.array([0.3, 0.7, 2.0, 3.0])
    found, started = (
        np.asarray(input_effort(scene.solve(phase=phases, speed=rate, acceleration=acceleration)))
        for rate in (speed, 0.0)
    )
    assert np.isfinite(started).all()
    assert found == pytest.approx(started, rel=1e-5)
    for phase, value in zip(phases.tolist(), found.tolist(), strict=True):
        assert input_effort(scene.pose(phase, speed=speed, acceleration=acceleration)) == value
    if scene.mechanism.linkage.drive.coordinate.is_angle:
        angles = scene.solve(phase=phases).coordinate
        by_angle = [
            np.asarray(input_effort(scene.solve(angle=angles, speed=rate, acceleration=acceleration)))
            for rate in (speed, 0.0)
        ]
        assert by_angle[0] == pytest.approx(by_angle[1], rel=1e-5)


SWUNG = (
    SPRUNG
    + """
[springs.quick]
between = ["D", "G"]
stiffness = "70 N/m"
free_length = 90
[ground]
Q = [300, 0]
G = [0, 150]
[joints.D]
crank = "Q"
length = 17
gear = {{ with = "A", ratio = {ratio}, offset = "10 deg" }}
"""
)


@pytest.mark.parametrize("ratio", [1, 20, 96])
def test_beside_a_limit_that_takes_no_power_the_torque_is_that_of_the_closed_formula(ratio: int) -> None:
    scene = scene_of(SWUNG.format(ratio=ratio))

    def torque(angle: mpmath.mpf) -> mpmath.mpf:
        struts = (
            (4.0, 0.03, mpmath.mpf("0.17"), 1, 0, mpmath.mpf("0.09"), 0),
            (0.07, 0.09, mpmath.mpf("0.017"), ratio, mpmath.pi / 18, mpmath.mpf("-0.3"), mpmath.mpf("0.15")),
        )
        total = mpmath.mpf(0)
        for stiffness, free, arm, turns, offset, x, y in struts:
            at = turns * angle + offset
            u, v = arm * mpmath.cos(at) - x, arm * mpmath.sin(at) - y
            length = mpmath.sqrt(u * u + v * v)
            rate = turns * arm * (mpmath.cos(at) * v - mpmath.sin(at) * u) / length
            total += 1000 * mpmath.mpf(stiffness) * (length - mpmath.mpf(str(free))) * rate
        return total

    low, high = scene.mechanism.input_range
    with mpmath.workdps(50):
        ground, crank, both = mpmath.mpf(90), mpmath.mpf(170), mpmath.mpf(210)
        limit = mpmath.acos((ground**2 + crank**2 - both**2) / (2 * ground * crank))
        assert (low, high) == pytest.approx((-float(limit), float(limit)), rel=1e-15)
        for off in (0.0, 1e-15, 1e-12, 1e-9, 3e-7, 9.9e-7, 1.1e-6, 1e-4, 0.1):
            for end in (0.0, math.pi):
                for phase in (end - off, end + off):
                    true = torque(-limit * mpmath.cos(mpmath.mpf(phase)))
                    assert input_effort(scene.pose(phase)) == pytest.approx(float(true), rel=1e-13), phase


# The two bars come straight: the mass runs on through the limit and takes no power there.
@pytest.mark.parametrize("way", [(110, 230), (230, 110)], ids=["to the limit", "from the limit"])
def test_beside_a_limit_through_which_a_mass_runs_on_the_force_is_that_of_the_closed_formula(
    way: tuple[int, int],
) -> None:
    scene = scene_of(STRETCHED.format(gravity="", mass=1.0, way=way))
    reach, end = mpmath.mpf(way[1] - way[0]) / 2, math.pi if way[1] == 230 else 0.0
    speed = mpmath.mpf(scene.linkage.drive.speed)

    def travel(seconds: mpmath.mpf) -> mpmath.mpf:
        return 170 - reach * mpmath.cos(speed * seconds)

    def turned(seconds: mpmath.mpf) -> mpmath.mpf:
        at, half = travel(seconds), speed * seconds / 2
        root = mpmath.cos(half) if way[1] == 230 else mpmath.sin(half)
        return 2 * mpmath.asin(root * mpmath.sqrt(120 * (at - 10) / (480 * at)))

    with mpmath.workdps(80):
        for off in (1e-9, 5e-7, 9.9e-7, 1.1e-6, 1e-3, 0.1):
            seconds = mpmath.mpf(end + off) / speed
            power = mpmath.mpf("0.06") ** 2 * mpmath.diff(turned, seconds) * mpmath.diff(turned, seconds, 2)
            true = power * 1000 / mpmath.diff(travel, seconds)
            assert input_effort(scene.pose(end + off)) == pytest.approx(float(true), rel=1e-14), off
