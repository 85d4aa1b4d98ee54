"""What the six-bars and longer chains of the catalogue are there for."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.mechanics.groups import GroupPoint
from linkanim.scenes import load

Array = NDArray[np.float64]
FINE = 7200


def places(name: str, joint: str, steps: int = FINE) -> NDArray[np.complex128]:
    """Return a joint's way over a cycle as x + yi."""
    x, y = load(name).cycle(steps).position[joint].T
    return np.asarray(x + 1j * y)


# Watt's two three-pin links are pinned to each other, Stephenson's are not; what is fixed decides the number.
@pytest.mark.parametrize(
    ("name", "met", "fixed"),
    [
        ("watt-1", True, 2),
        ("watt-2", True, 3),
        ("stephenson-1", False, 2),
        ("stephenson-2", False, 2),
        ("stephenson-3", False, 3),
        ("stephenson-3-link6", False, 3),
    ],
)
def test_a_six_bar_has_its_chain(name: str, met: bool, fixed: int) -> None:
    linkage = load(name).linkage
    ground = {joint.name for joint in linkage.joints if joint.fixed}
    links = [set(body.joints) for body in linkage.bodies] + [ground]
    assert sorted(map(len, links)) == [2, 2, 2, 2, 3, 3]
    assert len(ground) == fixed
    first, second = (link for link in links if len(link) == 3)
    assert bool(first & second) == met
    # Seven pins, each in two links.
    assert sum(len(one & other) for one, other in combinations(links, 2)) == 7


def test_the_far_joint_of_the_first_watt_copies_the_cranks_circle() -> None:
    e, a = places("watt-1", "E"), places("watt-1", "A")
    assert np.max(np.abs(e - 110 - (16 + 12j) / 11 * (a - 110))) <= 1e-14 * 200


def test_the_second_watt_makes_more_than_half_a_turn_of_a_rockers_swing() -> None:
    angle = load("watt-2").cycle(FINE).angle
    ground, crank, coupler, rocker = 120.0, 41.0, 118.0, 64.0
    ends = [
        math.acos((ground**2 + rocker**2 - diagonal**2) / (2 * ground * rocker))
        for diagonal in (coupler + crank, coupler - crank)
    ]
    assert np.ptp(angle["rocker"]) == pytest.approx(ends[0] - ends[1], rel=1e-6)
    assert math.degrees(ends[0] - ends[1]) == pytest.approx(81.1, abs=0.05)
    assert np.ptp(angle["rocker2"]) > math.pi


def test_the_third_stephensons_rocker_swings_twice_a_turn() -> None:
    rate = load("stephenson-3").cycle(720).angular_velocity["rocker2"]
    assert np.count_nonzero(np.sign(rate) != np.sign(np.roll(rate, 1))) == 4


def test_the_first_stephensons_pair_moves_at_both_ends() -> None:
    motion = load("stephenson-1").cycle(720)
    for joint in ("C", "D", "E"):
        assert np.min(np.ptp(motion.position[joint], axis=0)) > 20


def test_no_link_of_the_second_stephenson_beyond_its_crank_is_found_before_another() -> None:
    scene = load("stephenson-2")
    assert scene.info.full_turn
    (group,) = {joint.group for joint in scene.linkage.joints if isinstance(joint, GroupPoint)}
    assert {link.name for link in group.free} == {"coupler", "lever", "bar", "bar2"}
    # At a limit the moments of unit forces along both bars, about A and about O6, would be in one ratio.
    motion = scene.cycle(720)
    at = {joint: motion.position[joint] @ [1, 1j] for joint in ("A", "B", "C", "D", "E", "O6")}

    def moment(about: Array, of: Array, to: Array) -> Array:
        along = (to - of) / np.abs(to - of)
        return np.asarray(((of - about).conj() * along).imag)

    arms = [moment(at[pin], *bar) for bar in ((at["B"], at["D"]), (at["C"], at["E"])) for pin in ("A", "O6")]
    assert np.min(np.abs(arms[0] * arms[3] - arms[1] * arms[2])) > 36**2


def test_the_third_stephenson_at_link_6_is_where_it_is_published() -> None:
    pose = load("stephenson-3-link6").pose(0.0)
    for joint, place in {"B": (5, 16), "C": (25, 25), "E": (18, 35), "F": (43, 32)}.items():
        assert pose.position[joint] == pytest.approx(place, rel=1e-14), joint


# Other programs' position of J after a quarter turn, to forty digits.
def test_the_double_butterflys_pin_goes_where_it_is_published() -> None:
    scene = load("double-butterfly")
    places = scene.solve(angle=math.pi / 2 + math.atan2(1.94, -0.21)).position
    assert places["J"] == pytest.approx((3.277974954071667, 0.017062641156144212), rel=1e-14)


# turned to the right by the rack at one end, to the left at the other; straight in the drawn pose
@pytest.mark.parametrize(("travel", "inner", "outer"), [(40, "right", "left"), (140, "left", "right")])
def test_in_a_bend_the_inner_wheel_turns_further(travel: float, inner: str, outer: str) -> None:
    scene = load("steering")
    straight, bent = (scene.solve(travel=at).angle for at in (90, travel))
    turned = {wheel: abs(float(bent[wheel] - straight[wheel])) for wheel in (inner, outer)}
    assert turned[inner] - turned[outer] > math.radians(1.5)
    assert math.degrees(turned[outer]) > 15


def test_the_steering_s_drag_link_is_held_at_three_places() -> None:
    linkage = load("steering").linkage
    links = {body.name: {*body.joints} for body in linkage.bodies}
    holding = [name for name, joints in links.items() if name != "drag" and joints & links["drag"]]
    assert sorted(holding) == ["left", "right", "rod"]
    assert linkage.joint("L").fixed
    assert linkage.joint("R").fixed


def test_the_plotters_curve_is_closed_after_two_turns_of_the_quicker_motor() -> None:
    scene = load("plotter")
    assert scene.mechanism.periods == 2
    first, half, last = scene.solve(phase=[0.0, 2 * math.pi, 4 * math.pi]).position["P"]
    assert last == pytest.approx(first, abs=1e-12)
    assert np.max(np.abs(half - first)) > 10
    rate = scene.cycle(720).angular_velocity
    assert rate["right"] == pytest.approx(rate["left"] / 2, rel=1e-14)


def meet(p: complex, q: complex, a: float, b: float) -> complex:
    """Return where circles about p and q meet, left of p -> q: two triangles with a common height."""
    d = q - p
    along = (abs(d) ** 2 + a * a - b * b) / (2 * abs(d))
    return p + d / abs(d) * (along + 1j * math.sqrt(a * a - along * along))


@pytest.mark.parametrize("theta", [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
def test_jansens_leg_is_a_chain_of_triangles(theta: float) -> None:
    a, pivot = 15 * complex(math.cos(theta), math.sin(theta)), -38 - 7.8j
    b = meet(pivot, a, 41.5, 50)
    c = meet(a, pivot, 61.9, 39.3)
    d = meet(pivot, b, 40.1, 55.8)
    e = meet(c, d, 36.7, 39.4)
    f = meet(c, e, 49, 65.7)
    x, y = load("jansen").solve(angle=theta).position["F"]
    assert abs(complex(x, y) - f) <= 1e-12


def test_jansens_foot_is_on_the_ground_for_half_a_turn() -> None:
    foot = places("jansen", "F")
    stride, lift = np.ptp(foot.real), np.ptp(foot.imag)
    level = foot.imag <= np.min(foot.imag) + 0.03 * stride
    assert np.mean(level) > 0.5
    assert stride == pytest.approx(67.9, abs=0.05)
    assert lift == pytest.approx(22.5, abs=0.05)


def test_klanns_leg_stands_where_the_patents_table_has_it() -> None:
    table = {"E": (74.1, 75.0), "K": (23.2, 86.6), "H": (86.6, 150.0), "F": (0.0, 0.0)}
    motion = load("klann").solve(angle=math.pi)
    for joint, place in table.items():
        assert motion.position[joint] == pytest.approx(place, abs=0.005), joint


def test_klanns_foot_is_near_the_ground_for_half_a_turn_and_lifts_high() -> None:
    foot = places("klann", "F")
    stride, lift = np.ptp(foot.real), np.ptp(foot.imag)
    assert np.mean(foot.imag <= np.min(foot.imag) + 0.07 * stride) > 0.5
    assert lift > stride / 2


# the turns of the input after which all is back, and the turns of the other wheel in that time
@pytest.mark.parametrize(
    ("name", "turns", "other"), [("geared-five-bar-2-1", 1, 2), ("geared-five-bar-3-2", 2, 3)]
)
def test_geared_cranks_close_their_curve_after_whole_turns_of_both(name: str, turns: int, other: int) -> None:
    scene = load(name)
    assert scene.mechanism.periods == turns
    first, last = scene.solve(phase=[0.0, scene.period]).position["B"]
    assert first == pytest.approx(last, abs=1e-12)
    small = scene.cycle(720).angle["small"]
    assert (small[0] - small[-1]) * 720 / 719 == pytest.approx(2 * math.pi * other, rel=1e-12)
    for part in range(1, turns):
        early = scene.solve(phase=scene.period * part / turns).position["B"]
        assert np.max(np.abs(early - first)) > 10


def test_the_dwell_six_bars_rocker_stands_for_140_degrees_of_the_crank() -> None:
    scene = load("dwell-six-bar")
    stands = scene.solve(angle=np.radians(np.linspace(110, 250, 281))).angle["rocker2"]
    assert math.degrees(np.ptp(stands)) <= 1 / 6
    assert math.degrees(np.ptp(scene.cycle(FINE).angle["rocker2"])) > 40


def test_the_scissor_lift_rises_three_times_what_a_pair_gains_and_stays_level() -> None:
    motion = load("scissor-lift").cycle(720)
    foot = motion.position["F"][:, 0]
    height = 3 * np.sqrt(200.0**2 - foot**2)
    assert np.max(np.abs(motion.position["R3"] - np.stack((foot, height), axis=1))) <= 1e-14 * 600 * 4
    assert np.max(np.abs(motion.position["L3"][:, 0])) <= 1e-12
    assert np.max(np.abs(motion.angle["platform"])) <= 1e-14


def test_the_leg_is_down_where_its_brace_is_in_line() -> None:
    scene = load("landing-gear")
    # H in line with the brace: the crank's pin closes a triangle of crank, rod and O6 to H.
    reach = math.hypot(6, 90)
    lean = math.acos((reach**2 + 35**2 - 124**2) / (2 * reach * 35))
    for angle in (math.atan2(-90, 6) + lean, math.atan2(-90, 6) - lean):
        motion = scene.solve(angle=angle, speed=1.0)
        assert motion.position["K"] == pytest.approx((80, -60), abs=1e-9)
        assert motion.angle["leg"] == pytest.approx(-math.pi / 2, abs=1e-6)
        assert abs(motion.angular_velocity["leg"]) <= 1e-6
    assert math.degrees(np.ptp(scene.cycle(720).angle["leg"])) > 85


def test_the_umbrella_opens_alike_on_both_sides() -> None:
    motion = load("umbrella").cycle(720)
    left, right = motion.position["T"], motion.position["U"]
    assert np.max(np.abs(left + right * [1, -1])) <= 1e-14 * 283
    down = -motion.position["R"][:, 1]
    cosine = (down**2 + 90**2 - 110**2) / (2 * 90 * down)
    assert np.max(np.abs(right[:, 1] + 240 * cosine)) <= 1e-12


def test_coupled_wheels_turn_alike_through_each_others_change_points() -> None:
    motion = load("parallel-locomotive").cycle(720)
    a, b, c, d = (motion.position[joint] for joint in "ABCD")
    assert np.max(np.abs(b - a - [140, 0])) <= 1e-14 * 260
    # A loop down the chain passes its change points to 1e-8 of the longest link, rounded up to twice that.
    assert np.max(np.abs(d - c - [140, 0])) <= 2e-8 * 140
    assert np.max(np.abs(c - np.stack((-a[:, 1], a[:, 0]), axis=1))) <= 1e-14 * 34
    # Whichever rod lies along the line of the wheels, the other's pins are at least 34 / √2 off it.
    assert np.min(np.maximum(np.abs(a[:, 1]), np.abs(c[:, 1]))) >= 34 / math.sqrt(2) - 1e-9


def test_andrewss_squeezer_stands_as_published() -> None:
    scene = load("andrews")
    # The consistent angles of the test set for initial value problems: β, γ, Φ, δ and ε; Ω is -Φ, Θ nought.
    beta, gamma, phi = -0.0617138900142764496, 0.455279819163070380, 0.222668390165885885
    delta, epsilon = 0.487364979543842550, 1.23054744454982119
    position = scene.solve(angle=beta).position
    at = {joint: complex(*place) for joint, place in position.items()}

    def turned(joint: str, base: str) -> complex:
        way = at[joint] - at[base]
        return way / abs(way)

    found = {
        ("E", "R"): -complex(math.cos(beta), math.sin(beta)),
        ("E", "B"): complex(math.sin(gamma), -math.cos(gamma)),
        ("F", "A"): complex(math.cos(delta), math.sin(delta)),
        ("F", "E"): -complex(math.sin(phi + delta), -math.cos(phi + delta)),
        ("G", "A"): complex(math.sin(epsilon), -math.cos(epsilon)),
        ("G", "E"): -complex(math.cos(epsilon - phi), math.sin(epsilon - phi)),
    }
    for (joint, base), direction in found.items():
        assert abs(turned(joint, base) - direction) <= 1e-14, (joint, base)
    assert len(scene.linkage.bodies) == 7


def test_at_grashofs_limit_two_turns_bring_all_back() -> None:
    scene = load("grashof-limit-six-bar")
    lengths = scene.document["six-bar"]["lengths"][:4]
    assert min(lengths) + max(lengths) == sum(lengths) / 2
    assert scene.mechanism.periods == 2
    once, twice = scene.solve(phase=[2 * math.pi, 4 * math.pi]).position["B"]
    first = scene.solve(phase=0.0).position["B"]
    assert np.max(np.abs(once - first)) > 10
    assert twice == pytest.approx(first, abs=1e-12)


def test_cardans_wheel_draws_a_line_with_its_rim_and_an_ellipse_within() -> None:
    motion = load("cardan-gears").cycle(720)
    theta = motion.coordinate
    x, y = motion.position["E"].T
    assert np.max(np.abs(y)) <= 1e-14 * 100
    assert np.max(np.abs(x - 100 * np.cos(theta))) <= 1e-14 * 100
    x, y = motion.position["P"].T
    assert np.max(np.abs((x / 25) ** 2 + (y / 75) ** 2 - 1)) <= 1e-13


def test_the_small_wheels_rim_draws_an_astroid_with_four_cusps() -> None:
    scene = load("epicyclic-hypocycloid")
    theta = np.linspace(-math.pi, math.pi, 721)
    cubes = 100 * np.stack((np.cos(theta) ** 3, np.sin(theta) ** 3), axis=1)
    assert np.max(np.abs(scene.solve(angle=theta).position["E"] - cubes)) <= 1e-14 * 100 * 2
    cusps = scene.solve(angle=np.arange(4) * (math.pi / 2), speed=1.0)
    assert np.max(np.abs(cusps.velocity["E"])) <= 1e-12


def test_the_excavators_arm_swings_as_its_one_cylinder_says() -> None:
    scene = load("excavator")
    motion = scene.cycle(720)
    length = np.hypot(*(motion.position["H"] - motion.position["G"]).T)
    assert length == pytest.approx(182.5 - 32.5 * np.cos(motion.phase), rel=1e-14)
    # The law of cosines on pivot, pin and the cylinder's joint on the boom gives the boom's angle.
    ground, arm, own = math.hypot(60, 40), math.hypot(200, 12), math.atan2(-12, 200)
    lean = np.arccos((ground**2 + arm**2 - length**2) / (2 * ground * arm))
    assert motion.angle["boom"] == pytest.approx(math.atan2(-40, 60) + lean - own, abs=1e-13)
    for strut in ("stick", "bucket"):
        assert np.ptp(motion.damper[strut].length) <= 1e-14 * 460 * 2
    tip = np.hypot(*motion.position["N"].T)
    assert np.ptp(tip) <= 1e-14 * 460 * 4
