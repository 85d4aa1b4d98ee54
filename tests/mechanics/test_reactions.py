"""Forces in joints, guides and gears, and on the ground: against others' numbers and in fifty digits."""

from __future__ import annotations

import cmath
import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from build import four_bar, slider_crank
from mpmath import mp
from newton_euler import EVERY, laden, linkages, worst
from random_joints import Make, bar_that_limits_the_input, driven_by_a_slider, slot_that_limits_the_input
from reference import DIGITS
from test_groups import BETWEEN, BUTTERFLY, FIVE, HELD, STEPHENSON_III, TWO_PINS

from linkanim.mechanics.forces import input_effort
from linkanim.mechanics.groups import GroupPoint
from linkanim.mechanics.linkage import (
    RRR,
    Body,
    Crank,
    Damper,
    Drive,
    DrivenSlider,
    Line,
    Linkage,
    Load,
    Pin,
    Rigid,
    Spring,
    Travel,
)
from linkanim.mechanics.measures import line_direction, loaded
from linkanim.mechanics.motion import mechanism
from linkanim.mechanics.reactions import Reactions, guided, meeting, member_of, meshing, reactions
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from

PUBLISHED = json.loads((Path(__file__).parent / "forces.json").read_text(encoding="utf-8"))


def frame(origin: complex, towards: complex, place: complex) -> tuple[float, float]:
    """Along a line and to the left of it."""
    seen = (place - origin) * abs(towards - origin) / (towards - origin)
    return seen.real, seen.imag


def watt(gravity: float) -> Linkage:
    case = PUBLISHED["watt_i"]
    at = {name: complex(*place) for name, place in case["points"].items()}
    apart = {a + b: abs(at[a] - at[b]) for a in at for b in at}

    def side(p: str, q: str, point: str) -> int:
        return 1 if ((at[point] - at[p]) * (at[q] - at[p]).conjugate()).imag > 0 else -1

    def body(name: str, first: str, last: str, *others: str) -> Body:
        own = case["mass"][name]
        com = frame(at[first], at[last], complex(*own["com_in_pose"]))
        return Body(name, (first, last, *others), com, None, own["mass"], own["inertia"])

    middle = sum(at[name] for name in "CFG") / 3
    crank = at["B"] - at["A"]
    return Linkage(
        (
            Pin("A", tuple(case["points"]["A"])),
            Pin("G", tuple(case["points"]["G"])),
            Crank("B", "A", apart["AB"]),
            RRR("C", ("B", "G"), (apart["BC"], apart["CG"]), side("B", "G", "C")),
            Rigid("D", ("B", "C"), frame(at["B"], at["C"], at["D"])),
            Rigid("F", ("G", "C"), frame(at["G"], at["C"], at["F"])),
            RRR("E", ("D", "F"), (apart["DE"], apart["EF"]), side("D", "F", "E")),
        ),
        Drive("B", 1.0, math.atan2(crank.imag, crank.real)),
        (
            body("AB", "A", "B"),
            body("BCD", "B", "C", "D"),
            body("DE", "D", "E"),
            body("EF", "E", "F"),
            body("CFG", "G", "C", "F"),
        ),
        gravity=gravity,
        loads=(Load("l", "CFG", at=frame(at["G"], at["C"], middle), force=(50.0, 25.0)),),
    )


WATT_ON = {"A": "AB", "B": "AB", "C": "BCD", "D": "BCD", "E": "DE", "F": "EF", "G": "CFG"}


@pytest.mark.parametrize("scenario", ["gravity_and_load", "load_alone"])
@pytest.mark.parametrize("row", PUBLISHED["watt_i"]["rows"], ids=lambda row: f"{row['crank_angle']:.4f}")
def test_a_watt_linkage_with_a_load_has_the_published_forces(row: Any, scenario: str) -> None:
    solved = mechanism(watt(9.81 if scenario == "gravity_and_load" else 0.0))
    speed = 10 * math.pi / 30 * row["sense"]
    motion = solved.solve(angle=row["crank_angle"], speed=speed)
    found, given = reactions(motion), row[scenario]
    largest = max(math.hypot(*force) for force in given["joints"].values())
    for joint, force in given["joints"].items():
        assert found.joints[joint][WATT_ON[joint]] == pytest.approx(force, abs=1e-12 * largest), joint
    assert found.effort == pytest.approx(given["torque"], rel=1e-12)
    assert input_effort(motion) == pytest.approx(given["torque"], rel=1e-12)


def andrews() -> tuple[Linkage, float]:
    """The squeezer as the test set has it, and the acceleration of its crank; lengths in metres."""
    case = PUBLISHED["andrews_at_rest"]
    its, state = case["inputs"], case["state"]
    beta, gamma, delta, epsilon = (state[name] for name in ("beta", "gamma", "delta", "epsilon"))
    a, b, o = complex(*its["A"]), complex(*its["B"]), 0j
    r = cmath.rect(its["rr"], beta)
    out = -1j * cmath.exp(1j * gamma)  # from B to E
    e = b + its["ss"] * out
    f, g = a + cmath.rect(its["zt"], delta), a - 1j * cmath.rect(its["u"], epsilon)
    d = b + (its["sc"] + 1j * its["sd"]) * out
    centres = (
        ("K1", ("O", "R"), o + its["ra"] * r / abs(r)),
        ("K2", ("R", "E"), r + its["da"] * (e - r) / abs(e - r)),
        ("K3", ("B", "E"), b + (its["sa"] + 1j * its["sb"]) * out),
        ("K4", ("E", "F"), f + (its["e"] - its["ea"]) * (e - f) / abs(e - f)),
        ("K5", ("A", "F"), a + (its["ta"] + 1j * its["tb"]) * (f - a) / abs(f - a)),
        ("K6", ("E", "G"), g + (its["zf"] - its["fa"]) * (e - g) / abs(e - g)),
        ("K7", ("A", "G"), a + (its["ua"] - 1j * its["ub"]) * (g - a) / abs(g - a)),
    )
    at = {"O": o, "A": a, "B": b, "R": r, "E": e, "F": f, "G": g}
    masses = zip(centres, its["m"], its["I"], strict=True)

    def pin(name: str, place: complex) -> Pin:
        return Pin(name, (place.real, place.imag))

    def side(p: complex, q: complex, point: complex) -> int:
        return 1 if ((point - p) * (q - p).conjugate()).imag > 0 else -1

    linkage = Linkage(
        (
            *(pin(name, at[name]) for name in "OAB"),
            pin("C", complex(*its["C"])),
            Crank("R", "O", its["rr"]),
            RRR("E", ("R", "B"), (its["d"], its["ss"]), side(r, b, e)),
            Rigid("D", ("B", "E"), frame(b, e, d)),
            RRR("F", ("E", "A"), (its["e"], its["zt"]), side(e, a, f)),
            RRR("G", ("E", "A"), (its["zf"], its["u"]), side(e, a, g)),
        ),
        Drive("R", 1.0, beta),
        tuple(
            Body(name, ends, frame(at[ends[0]], at[ends[1]], com), None, mass, inertia)
            for (name, ends, com), mass, inertia in masses
        ),
        (Spring("s", ("C", "D"), its["spring"]["stiffness"], its["spring"]["free_length"]),),
    )
    return linkage, state["beta_second"]


ANDREWS = [("O", "K1"), ("R", "K2"), ("B", "K3")]


def test_the_squeezer_at_rest_has_a_force_on_each_of_the_four_bodies_that_meet_in_one_pin() -> None:
    linkage, acceleration = andrews()
    case = PUBLISHED["andrews_at_rest"]
    motion = mechanism(linkage).solve(angle=case["state"]["beta"], speed=0.0, acceleration=acceleration)
    found = reactions(motion)
    for body, force in case["force_at_E"].items():
        assert found.joints["E"][body[3:]] == pytest.approx(force, abs=1e-8), body
    for (joint, body), words in zip(ANDREWS, case["own"], strict=False):
        assert found.joints[joint][body] == pytest.approx(case["own"][words], abs=1e-8), words
    assert found.ground == pytest.approx(case["own"]["on the ground, spring counted"], abs=1e-8)
    assert found.effort == pytest.approx(case["inputs"]["drive_moment"], rel=1e-9)
    at_e = np.array(list(found.joints["E"].values()))
    assert at_e.sum(axis=0) == pytest.approx([0, 0], abs=1e-12)


def test_the_squeezer_of_the_catalogue_has_the_masses_and_the_forces_of_the_test_set() -> None:
    scene, case = load("andrews"), PUBLISHED["andrews_at_rest"]
    known, (_, acceleration) = case["state"]["beta"], andrews()
    found = reactions(scene.solve(angle=known, speed=0.0, acceleration=acceleration))
    for body, force in case["force_at_E"].items():
        assert found.joints["E"][body[3:]] == pytest.approx(force, abs=1e-8), body
    assert found.effort == pytest.approx(case["inputs"]["drive_moment"], rel=1e-9)


def test_one_link_with_a_load_at_its_end_has_the_forces_of_the_closed_formula() -> None:
    case = PUBLISHED["one_link"]
    bar = Body("bar", ("O", "A"), (case["com"], 0.0), None, case["m"], case["I"])
    load = Load("l", "bar", joint="A", force=tuple(case["load_at_end"]))
    linkage = Linkage(
        (Pin("O", (0.0, 0.0)), Crank("A", "O", case["end"])),
        Drive("A", 1.0),
        (bar,),
        gravity=case["g"],
        loads=(load,),
    )
    motion = mechanism(linkage).solve(angle=0.0, speed=case["omega"], acceleration=case["alpha"])
    found = reactions(motion)
    assert found.joints["O"]["bar"] == pytest.approx(case["pin_force"], rel=1e-6)
    assert found.joints["O"]["ground"] == pytest.approx([-part for part in case["pin_force"]], rel=1e-6)
    assert found.effort == pytest.approx(case["input_torque"], rel=1e-6)
    assert found.moment == pytest.approx(-case["input_torque"], rel=1e-6)


def test_a_slider_that_drives_itself_weighs_on_its_guide() -> None:
    case = PUBLISHED["driven_slider"]
    linkage = Linkage(
        (Pin("O", (0.0, 0.0)), DrivenSlider("C", Line("O"))),
        Drive("C", 1.0, actuator=Travel(1.0, 3.0)),
        (Body("block", slider="C", mass=case["m"]),),
        gravity=9.80665,
    )
    motion = mechanism(linkage).solve(phase=math.pi / 2, speed=0.0, acceleration=case["acceleration"])
    found = reactions(motion)
    assert found.effort == pytest.approx(case["drive_force"], rel=1e-12)
    assert found.guides["block"] == (pytest.approx(case["guide_force"], rel=1e-12), 0.0)
    assert found.ground == pytest.approx((-case["drive_force"], -case["guide_force"]), rel=1e-12)


@pytest.mark.parametrize("make", EVERY)
def test_every_kind_of_joint_has_the_forces_of_newton_and_euler_in_fifty_digits(make: Make) -> None:
    with mp.workdps(DIGITS):
        for seed, linkage in enumerate(linkages(make, 2)):
            assert worst(linkage, seed, static=seed == 1) < 1e-13


@pytest.mark.long
@pytest.mark.parametrize("make", EVERY)
def test_forty_linkages_of_every_kind_have_the_forces_of_newton_and_euler(make: Make) -> None:
    with mp.workdps(DIGITS):
        off = [worst(one, n, static=n % 4 == 0) for n, one in enumerate(linkages(make, 40))]
    assert max(off) < 1e-12


@pytest.mark.parametrize("make", [bar_that_limits_the_input, slot_that_limits_the_input, driven_by_a_slider])
@pytest.mark.slow
def test_beside_a_limit_the_forces_are_those_in_fifty_digits(make: Make) -> None:
    beside = (1e-12, -1e-12, 1e-9, -1e-6, 1e-3)
    with mp.workdps(DIGITS):
        for seed, linkage in enumerate(linkages(make, 2)):
            assert worst(linkage, seed, beside, static=seed == 1, beside=True) < 1e-12


def told(found: Reactions) -> dict[tuple[str, str], float]:
    """The size of the force in each joint on each body."""
    joints = found.joints.items()
    return {(joint, body): float(np.hypot(*force)) for joint, one in joints for body, force in one.items()}


def pushed_straight(gravity: float) -> Linkage:
    """A slider that pushes two bars straight, one of them with a mass, at the upper end of its way."""
    joints = (
        Pin("O", (0.0, 0.0)),
        DrivenSlider("C", Line("O")),
        RRR("K", ("C", "O"), (110.0, 120.0), 1),
    )
    upper = Body("upper", ("O", "K"), (60.0, 0.0), None, 1.0)
    drive = Drive("C", 2.0, actuator=Travel(110.0, 230.0))
    return Linkage(joints, drive, (upper,), metre=1e-3, gravity=gravity)


@pytest.mark.parametrize("asked", ["motion", "pose"])
def test_at_a_limit_under_load_the_forces_are_unbounded_and_said_to_be(asked: str) -> None:
    solved = mechanism(pushed_straight(9.81))
    motion = solved.pose(math.pi, 2.0, 0.0, 2) if asked == "pose" else solved.solve(phase=math.pi, speed=2.0)
    found = reactions(motion)
    assert found.effort == input_effort(motion) == math.inf
    assert set(told(found).values()) == {math.inf}
    assert found.ground == pytest.approx(
        (0.06293660777506263 / (math.pi / 30 * 20) ** 2 * 4, -9.81), rel=1e-9
    )


def test_at_a_limit_asked_for_by_its_angle_the_forces_are_unbounded_too() -> None:
    linkage = four_bar((90.0, 170.0, 130.0, 80.0))
    loads = (Load("l", "rocker", at=(9.0, 0.0), force=(3.0, 40.0)),)
    for laden_ in (replace(linkage, loads=loads), replace(laden(linkage, 2), static=True)):
        solved = mechanism(laden_)
        motion = solved.solve(angle=np.array([*solved.input_range, 0.5]), speed=1.0)
        sizes = np.array([np.hypot(*force) for force in reactions(motion).joints["B"].values()])
        assert np.isinf(sizes[:, :2]).all()
        assert np.isfinite(sizes[:, 2]).all()
        assert np.isinf(np.asarray(input_effort(motion))[:2]).all()


def test_what_takes_no_power_at_a_limit_has_the_forces_of_both_sides_there() -> None:
    solved = mechanism(pushed_straight(0.0))
    for away in (0.0, 1e-15, -1e-12, 1e-9, -1e-7):
        there, beside = (told(reactions(solved.pose(math.pi + way, 2.0, 0.0, 2))) for way in (away, 1e-5))
        assert there == pytest.approx(beside, rel=1e-7, abs=1e-9)


def test_a_dyad_that_carries_nothing_has_no_forces_at_its_limit() -> None:
    linkage = replace(
        four_bar((90.0, 170.0, 130.0, 80.0)), springs=(Spring("s", ("A", "O4"), 4000.0, 30.0),), metre=1e-3
    )
    solved = mechanism(linkage)
    for phase in (0.0, 1e-15, 1e-12, 1e-5, math.pi, 3.0):
        found = told(reactions(solved.pose(phase, 1.0, 0.0, 2)))
        assert found["B", "coupler"] == found["B", "rocker"] == 0.0
        assert found["A", "crank"] > 1.0


def test_at_a_change_point_of_a_loaded_dyad_only_its_own_forces_are_unbounded() -> None:
    loads = (Load("l", "rocker", at=(10.0, 0.0), force=(5.0, 3.0)),)
    solved = mechanism(replace(four_bar((80.0, 30.0, 80.0, 30.0)), loads=loads, metre=1e-3))
    motion = solved.solve(angle=np.array([0.0, 1e-12, math.pi, 1.0]), speed=1.0)
    found = reactions(motion)
    for joint in ("O2", "A", "B", "O4"):
        sizes = np.array([np.hypot(*force) for force in found.joints[joint].values()])
        assert np.isinf(sizes[:, [0, 2]]).all()
        assert (sizes[:, 1] > 1e9).all()
    assert found.ground[0].tolist() == [5.0] * 4
    assert input_effort(motion)[:2] == pytest.approx([-0.03, -0.03], rel=1e-10)


def balances(linkage: Linkage, motion: Any, found: Reactions) -> dict[str, tuple[Any, Any]]:
    """What all forces and inertia of each body leave over: force and moment about its first joint."""
    left: dict[str, tuple[Any, Any]] = {}
    places = {**motion.position, **{f"com {name}": place for name, place in motion.com_position.items()}}

    def act(body: str, place: Any, force: Any, moment: Any = 0.0) -> None:
        own = linkage.body(body)
        arm = (place - places[own.slider or own.joints[0]]) * linkage.metre
        total, turned = left.get(body, (0.0, 0.0))
        turned = turned + moment + arm[..., 0] * force[1] - arm[..., 1] * force[0]
        left[body] = total + np.array(force), turned

    for joint, bodies in found.joints.items():
        for body, force in bodies.items():
            if body != "ground":
                act(body, places[joint], force)
    for own in linkage.bodies:
        assert own.mass is not None
        name = own.slider or f"com {own.name}"
        bent = motion.acceleration[name] if own.slider else motion.com_acceleration[own.name]
        bent = np.moveaxis(bent, -1, 0) * linkage.metre
        moment = 0.0 if own.inertia is None else -own.inertia * motion.angular_acceleration[own.name]
        act(own.name, places[name], (-own.mass * bent[0], -own.mass * (bent[1] + linkage.gravity)), moment)
    return left


def test_all_that_acts_on_a_body_is_its_inertia() -> None:
    linkage = replace(laden(four_bar((100.0, 30.0, 90.0, 80.0)), 3), loads=(), springs=(), dampers=())
    solved = mechanism(linkage)
    motion = solved.solve(phase=np.linspace(0, 6, 50), speed=7.0, acceleration=3.0)
    found = reactions(motion)
    largest = max(np.abs(force).max() for bodies in found.joints.values() for force in bodies.values())
    left = balances(linkage, motion, found)
    assert set(left) == {"b1", "b2", "b3"}
    for body, (force, moment) in left.items():
        effort = found.effort if body == "b1" else 0.0
        assert np.abs(force).max() < 1e-12 * largest, body
        assert np.abs(moment + effort).max() < 1e-13 * largest, body


@pytest.mark.parametrize("make", EVERY)
def test_what_meets_is_known_without_a_pose(make: Make) -> None:
    for seed, linkage in enumerate(linkages(make, 8, seed=11)):
        ends = list(linkage.by_name)
        unnamed = replace(linkage, springs=(Spring("s", (ends[0], ends[-1]), 9.0, 1.0),), metre=1e-3)
        scene = laden(linkage, seed) if seed % 2 else unnamed
        found = reactions(mechanism(scene).solve(phase=1.0, speed=1.0))
        known = meeting(scene)
        assert list(known) == list(found.joints)
        for joint, bodies in found.joints.items():
            assert sorted(known[joint]) == sorted(bodies)
        assert guided(scene) == tuple(found.guides) or set(guided(scene)) == set(found.guides)
        toothed = {name for name, teeth in meshing(scene).items() if teeth}
        assert toothed == {name for name, gear in found.gears.items() if gear.tangential is not None}
        assert meshing(scene).keys() == found.gears.keys()


def left_over(scene: Linkage, motion: Any) -> dict[str, tuple[complex, float]]:
    """What forces, loads and inertia of each body leave over, and their moments about the origin (m)."""
    found, metre = reactions(motion), scene.metre
    at = {name: complex(*place) * metre for name, place in motion.position.items()}
    bent = {name: complex(*place) * metre for name, place in motion.acceleration.items()}
    sums: dict[str, list[Any]] = {body.name: [0j, 0.0] for body in scene.bodies}

    def act(body: str | None, place: complex, force: complex, couple: float = 0.0) -> None:
        if body in sums:
            sums[body][0] += force
            sums[body][1] += (place.conjugate() * force).imag + couple

    def body_of(names: Any) -> str | None:
        frames = scene.rigid_bodies
        n = next((n for n, frame in enumerate(frames) if {*names} <= frame.keys()), -1)
        return f"block {names[0]}" if n < 0 else f"b{n}" if n else None

    for joint, bodies in found.joints.items():
        for name, force in bodies.items():
            act(name, at[joint], complex(*force))
    for joint, slide in scene.slides.items():
        direction = complex(*line_direction(motion, slide.line))
        name, guide = f"block {joint}", found.guides[f"block {joint}"]
        act(name, at[joint], 1j * direction * guide.force, guide.moment)
        act(
            body_of(slide.line.body) if slide.line.on else None,
            at[joint],
            -1j * direction * guide.force,
            -guide.moment,
        )
        if joint == scene.drive.joint:
            act(name, at[joint], direction * found.effort)
    if isinstance(scene.driven.joint, Crank) and scene.drive.actuator.along is None:
        act(body_of((scene.driven.pivot, scene.drive.joint)), 0j, 0j, found.effort)
    for one in scene.loads:
        own = scene.body(one.on)
        arm, force = loaded(motion, one)
        base = at[own.slider or own.joints[0]]
        act(one.on, base + complex(*arm) * metre, complex(*force), one.torque)
    struts: list[Spring | Damper] = [*scene.springs, *scene.dampers]
    for strut in struts:
        known = {**motion.spring, **motion.damper}[strut.name]
        first, last = strut.between
        pull = known.force * (at[last] - at[first]) / abs(at[last] - at[first])
        for end, way in ((first, pull), (last, -pull)):
            if end not in found.joints:  # it pulls at one body alone
                act(body_of((end,)), at[end], way)
    for body in scene.bodies:
        assert body.mass is not None
        place = at[body.slider] if body.slider else complex(*motion.com_position[body.name]) * metre
        second = bent[body.slider] if body.slider else complex(*motion.com_acceleration[body.name]) * metre
        turned = (body.inertia or 0.0) * motion.angular_acceleration[body.name] if body.inertia else 0.0
        act(body.name, place, body.mass * (-1j * scene.gravity - second), -turned)
    return {name: (force, moment) for name, (force, moment) in sums.items()}


@pytest.mark.parametrize("make", EVERY)
def test_all_that_acts_on_each_body_of_every_kind_is_its_inertia(make: Make) -> None:
    for seed, linkage in enumerate(linkages(make, 6, seed=23)):
        scene = laden(linkage, seed)
        motion = mechanism(scene).pose(0.4 + seed, 3.0, -2.0, 2)
        sizes = [abs(complex(*force)) for one in reactions(motion).joints.values() for force in one.values()]
        if not np.isfinite(sizes).all():
            continue
        geared = {name for crank in scene.cranks if crank.gear for name in (crank.name, crank.gear.mate)}
        reach = max(abs(complex(*place)) for place in motion.position.values()) * scene.metre
        for body, (force, moment) in left_over(scene, motion).items():
            if geared & {*scene.body(body).joints}:
                continue
            assert abs(force) < 1e-12 * max(sizes), body
            assert abs(moment) < 1e-12 * max(sizes) * max(reach, 1.0), body


SCENES: dict[str, Linkage] = {
    "a four-bar": four_bar((100.0, 30.0, 90.0, 80.0)),
    "a slider-crank": slider_crank(30.0, 90.0, 5.0, line_angle=0.3),
}


@pytest.mark.parametrize("static", [False, True], ids=["in motion", "static"])
@pytest.mark.parametrize("make", EVERY)
def test_the_effort_is_that_of_the_balance_of_power(make: Make, static: bool) -> None:
    for seed, linkage in enumerate(linkages(make, 6, seed=3)):
        scene = replace(laden(linkage, seed), static=static)
        motion = mechanism(scene).solve(phase=np.linspace(0.1, 6.2, 40), speed=4.0, acceleration=2.0)
        found, power = np.asarray(reactions(motion).effort), np.asarray(input_effort(motion))
        assert found == pytest.approx(power, abs=1e-12 * np.abs(power).max())


def test_a_pose_has_the_forces_of_the_motion() -> None:
    scene = laden(four_bar((100.0, 30.0, 90.0, 80.0)), 4)
    solved = mechanism(scene)
    motion = reactions(solved.solve(phase=np.array([0.3, 2.0]), speed=4.0, acceleration=1.0))
    for n, phase in enumerate((0.3, 2.0)):
        pose = reactions(solved.pose(phase, 4.0, 1.0, 2))
        assert pose.effort == pytest.approx(motion.effort[n], rel=1e-13)
        for joint, bodies in pose.joints.items():
            for body, force in bodies.items():
                assert force == pytest.approx([part[n] for part in motion.joints[joint][body]], rel=1e-11)


GROUPS: dict[str, dict[str, Any]] = {
    "a Stephenson linkage": STEPHENSON_III,
    "a double butterfly": BUTTERFLY,
    "a block with two pins": TWO_PINS,
    "a motor between moving links": BETWEEN,
    **{name: {**FIVE, **held_by} for name, held_by in HELD.items()},
}


def group(name: str, seed: int) -> Linkage:
    document = {"length_unit": "mm", **GROUPS[name]}
    return laden(scene_from(document, name="my", where="my.toml").linkage, seed)


@pytest.mark.thinned(4)
@pytest.mark.parametrize("static", [False, True], ids=["in motion", "static"])
@pytest.mark.parametrize("name", GROUPS)
def test_the_effort_of_links_that_are_solved_together_is_that_of_power(name: str, static: bool) -> None:
    scene = replace(group(name, 5), static=static)
    motion = mechanism(scene).solve(phase=np.linspace(0.3, 2.9, 12), speed=4.0, acceleration=2.0)
    found, power = np.asarray(reactions(motion).effort), np.asarray(input_effort(motion))
    assert found == pytest.approx(power, abs=1e-12 * np.abs(power).max())


@pytest.mark.thinned(4)
@pytest.mark.parametrize("name", GROUPS)
def test_all_that_acts_on_each_of_the_links_that_are_solved_together_is_its_inertia(name: str) -> None:
    scene = group(name, 7)
    motion = mechanism(scene).solve(phase=np.linspace(0.3, 2.9, 12), speed=4.0, acceleration=2.0)
    found, metre = reactions(motion), scene.metre
    at = {joint: place @ [1, 1j] * metre for joint, place in motion.position.items()}
    sums: dict[str, list[Any]] = {body.name: [0j, 0.0] for body in scene.bodies}
    frames = scene.rigid_bodies
    blocks = {one.slider: one.name for one in scene.bodies if one.slider}

    def act(body: str, place: Any, force: Any, couple: Any = 0.0) -> None:
        if body in sums:
            sums[body][0] = sums[body][0] + force
            sums[body][1] = sums[body][1] + (np.conj(place) * force).imag + couple

    def own(body: Body) -> str:
        """A block with two pins is the link that has them."""
        link = member_of(scene, body)
        return f"b{link}" if isinstance(link, int) else body.name

    for joint, bodies in found.joints.items():
        for name_of, (x, y) in bodies.items():
            act(name_of, at[joint], np.asarray(x) + 1j * np.asarray(y))
    for joint, slide in scene.slides.items():
        u, v = line_direction(motion, slide.line)
        across = 1j * (np.asarray(u) + 1j * np.asarray(v))
        block = own(scene.body(blocks[joint]))
        guide = found.guides[block]
        act(block, at[joint], across * guide.force, guide.moment)
        if slide.line.on:
            carrier = next(n for n, frame in enumerate(frames) if {*slide.line.body} <= frame.keys())
            act(f"b{carrier}", at[joint], -across * guide.force, -guide.moment)
    geared = {
        f"b{n}"
        for point in scene.joints
        if isinstance(point, GroupPoint)
        for gear in point.group.gears
        for link in (*gear.links, gear.carrier)
        for n, frame in enumerate(frames)
        if n and {*point.group.by_name[link].points} <= frame.keys()
    }
    driven = own(scene.body("b1")) if isinstance(scene.driven.joint, Crank) else ""
    for one in scene.loads:
        arm, (x, y) = loaded(motion, one)
        loose = scene.body(one.on)
        base = at[loose.slider or loose.joints[0]]
        place = base + (np.asarray(arm[0]) + 1j * np.asarray(arm[1])) * metre
        act(own(loose), place, np.asarray(x) + 1j * np.asarray(y), one.torque)
    struts: list[Spring | Damper] = [*scene.springs, *scene.dampers]
    for strut in struts:
        known = {**motion.spring, **motion.damper}[strut.name]
        first, last = strut.between
        pull = known.force * (at[last] - at[first]) / abs(at[last] - at[first])
        for end, way in ((first, pull), (last, -pull)):
            if end not in found.joints:
                act(f"b{next(n for n, frame in enumerate(frames) if end in frame)}", at[end], way)
    for body in scene.bodies:
        centre = at[body.slider] if body.slider else motion.com_position[body.name] @ [1, 1j] * metre
        bent = motion.acceleration[body.slider] if body.slider else motion.com_acceleration[body.name]
        turned = (body.inertia or 0.0) * motion.angular_acceleration[body.name] if body.inertia else 0.0
        act(own(body), centre, (body.mass or 0.0) * (-1j * scene.gravity - bent @ [1, 1j] * metre), -turned)
    largest = max(np.abs(force).max() for bodies in found.joints.values() for force in bodies.values())
    reach = max(abs(place).max() for place in at.values())
    for name_of, (force, moment) in sums.items():
        assert np.abs(force).max() < 1e-12 * largest, name_of
        moved = name_of == driven or scene.driven.joint.grouped or name_of in geared
        if not moved:
            assert np.abs(moment).max() < 1e-12 * largest * max(reach, 1.0), name_of
