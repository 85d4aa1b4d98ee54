"""What each slider and slot of the catalogue is there for, against a closed form."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from linkanim.mechanics.quantities import register
from linkanim.scenes import load

EPS = 2.0**-52


def test_the_slotted_bar_swings_through_twice_the_arc_sine_of_crank_to_ground() -> None:
    motion = load("inverted-slider-crank").cycle(7200)
    bar = motion.angle["bar"]
    expected = np.arctan2(motion.position["A"][:, 1], 110 + motion.position["A"][:, 0])
    assert np.max(np.abs(bar - expected)) <= 1e-14
    assert np.ptp(bar) == pytest.approx(2 * math.asin(50 / 110), rel=1e-6)


# slow way to quick way: the crank's angles between the limits are 2π - 2β and 2β
@pytest.mark.parametrize(
    ("name", "cosine"),
    [
        # β where the slotted bar lies along the ram's line: ground to crank
        ("whitworth", 40 / 80),
        # β where the crank stands at a right angle to the lever: crank to ground
        ("crank-shaper", 80 / 180),
        # β where the drag link lies along the ram's line: ground to the side opposite the crank's pin
        ("quick-return-press", 45 / math.hypot(45, 90)),
    ],
)
def test_a_quick_return_has_the_time_ratio_of_its_arc_cosine(name: str, cosine: float) -> None:
    beta = math.acos(cosine)
    assert load(name).info.time_ratio == pytest.approx((math.pi - beta) / beta, rel=1e-9)


def test_the_engine_s_torque_is_that_of_its_inertia_and_its_weight_and_the_gas_s_power() -> None:
    whole = load("engine")
    scene = replace(whole, linkage=replace(whole.linkage, loads=()))
    angles, step, r, rod = np.linspace(0, 6, 40), 1e-4, 0.05, 0.14

    def stored(angle: Any, speed: float) -> Any:
        """The kinetic and potential energy of crank, rod and piston, in closed form."""
        sine, cosine = np.sin(angle), np.cos(angle)
        lean = np.sqrt(rod**2 - (r * cosine) ** 2)
        turning, piston = r * sine / lean * speed, (r * cosine + r**2 * sine * cosine / lean) * speed
        across, up = -0.7 * r * sine * speed, 0.7 * r * cosine * speed + 0.3 * piston
        moving = (0.0022 + 1.5 * 0.012**2) * speed**2 + 0.0018 * turning**2
        moving = moving + 0.6 * (across**2 + up**2) + 0.45 * piston**2
        lifted = -1.5 * 0.012 * sine + 0.6 * (r * sine + 0.3 * lean) + 0.45 * (r * sine + lean)
        return moving / 2 + 9.81 * lifted

    for speed in (2.0, -60.0):
        slope = np.diff([stored(angles + way, speed) for way in (-step, step)], axis=0)[0] / (2 * step)
        found = register(scene.linkage)["input.torque"].read(scene.solve(angle=angles, speed=speed))
        assert found == pytest.approx(slope, rel=1e-6, abs=1e-6 * np.abs(slope).max())
        motion = whole.solve(angle=angles, speed=speed)
        fired = register(whole.linkage)["input.torque"].read(motion) - found
        (gas,) = whole.linkage.loads
        force = np.interp(angles, gas.places, gas.values, period=2 * np.pi)
        assert fired == pytest.approx(
            force * motion.travel_velocity["slider"] * 1e-3 / speed, rel=1e-9, abs=1e-6
        )


def test_the_driven_piston_s_crank_runs_on_through_both_dead_centres() -> None:
    scene = load("driven-piston")
    crank, rod = 50.0, 115.0
    motion = scene.cycle(720)
    travel, angle = motion.travel["piston"], motion.angle["crank"]
    cosine = (travel**2 + crank**2 - rod**2) / (2 * travel * crank)
    assert np.max(np.abs(np.cos(angle) - cosine)) <= 8 * EPS
    assert np.all(np.diff(angle) > 0)
    assert angle[-1] - angle[0] == pytest.approx(2 * math.pi * 719 / 720, abs=0.02)
    # There the slider's way is the square of the crank's, over 2 r (l ± r)/l.
    ends = scene.solve(phase=np.array([0.0, math.pi]), speed=1.0).angular_velocity["crank"]
    assert ends == pytest.approx([math.sqrt(rod / (rod - crank)), math.sqrt(rod / (rod + crank))], rel=1e-13)


def test_the_toggle_press_s_ram_stops_where_its_knee_is_straight() -> None:
    scene = load("toggle-press")
    ram = scene.solve(phase=np.array([0.0, math.pi]), derivatives=1)
    assert ram.position["K"][1] == pytest.approx([0.0, -120.0], abs=1e-12)
    assert ram.travel["ram"][1] == pytest.approx(240.0, rel=1e-15)
    advantage = register(scene.linkage)["mechanical_advantage"]
    presses = advantage.read(scene.solve(phase=np.linspace(0.5, 3.14, 50)))
    assert np.all(np.diff(presses) > 0)
    assert presses[-1] > 100 * presses[0]


def test_the_cylinder_between_the_knee_s_links_spreads_them_as_the_cosine_says() -> None:
    motion = load("knee-cylinder").cycle(720)
    at = {joint: motion.position[joint] @ [1, 1j] for joint in "OKBPQ"}
    cylinder = np.abs(at["Q"] - at["P"])
    assert (np.min(cylinder), np.max(cylinder)) == pytest.approx((150, 320), rel=1e-12)
    # Both links are alike, so the knee is half as high as the ram; K, P, Q and K, O, B are two triangles.
    arm, bar = abs(complex(160, 95)), abs(complex(110, 170))
    lean = math.acos((arm**2 + bar**2 - abs(complex(50, 75)) ** 2) / (2 * arm * bar))
    half = np.arcsin(cylinder / (2 * arm)) + lean
    assert np.max(np.abs(at["B"].imag + 2 * bar * np.sin(half))) <= 1e-12 * 400
    # the ram comes to within 0.3 % of its dead centre, and there it moves slowest
    assert 0.997 < np.max(-at["B"].imag) / (2 * bar) < 1


def test_the_toggle_clamp_presses_down_where_handle_and_link_are_in_line() -> None:
    scene = load("toggle-clamp")
    # Crank, rod and the line from O2 to the upright handle's end form a triangle: twice a turn.
    across, crank, rod = math.hypot(120, 40), 41.0, 167.0
    lean = math.acos((across**2 + crank**2 - rod**2) / (2 * across * crank))
    motion = scene.solve(angle=[math.atan2(40, 120) + lean, math.atan2(40, 120) - lean], speed=1.0)
    assert np.max(np.abs(motion.position["C"] - [0, 130])) <= 1e-9
    assert np.max(np.abs(motion.velocity["T"])) <= 1e-9
    # Past the line the arm has given way by less than a hundredth of its stroke.
    height = scene.cycle(7200).position["T"][:, 1]
    lowest = motion.position["T"][0, 1]
    past = scene.solve(angle=math.atan2(40, 120) + math.pi).position["T"][1] - lowest
    assert 0 < past < 0.01 * np.ptp(height)
    assert np.min(height) == pytest.approx(lowest, abs=1e-4)


def test_the_knuckle_press_stops_to_the_third_order() -> None:
    scene = load("knuckle-press")
    cycle = scene.cycle(720)
    # Upper and lower link are equal, so the ram is twice as far down as the knee.
    assert np.max(np.abs(cycle.position["R"][:, 1] - 2 * cycle.position["B"][:, 1])) <= 1e-12
    bottom = math.atan2(-70, 240)
    pose = scene.solve(angle=bottom, speed=1.0)
    assert pose.position["R"] == pytest.approx([0, -260], abs=1e-9)
    assert abs(pose.travel_velocity["ram"]) <= 1e-9
    assert abs(pose.travel_acceleration["ram"]) <= 1e-9
    lift = scene.solve(angle=bottom + np.array([0.02, 0.04])).position["R"][:, 1] + 260
    assert lift[1] / lift[0] == pytest.approx(16, rel=0.05)


def test_the_isosceles_slider_goes_on_through_its_pivot() -> None:
    scene = load("isosceles-slider")
    motion = scene.cycle(720)
    crank = motion.position["A"][:, 0]
    assert np.max(np.abs(motion.position["B"][:, 0] - 2 * crank)) <= 4 * EPS * 80
    assert scene.info.stroke == pytest.approx(4 * 80, rel=1e-14)


def test_the_yoke_moves_as_the_cosine() -> None:
    scene = load("scotch-yoke")
    angle = np.linspace(-math.pi, math.pi, 721)
    motion = scene.solve(angle=angle)
    assert np.max(np.abs(motion.travel["yoke"] - 80 * np.cos(angle))) <= 2 * EPS * 80
    assert np.max(np.abs(motion.travel["yoke"] - motion.position["A"][:, 0])) == 0.0


def test_the_trammels_end_draws_an_ellipse() -> None:
    motion = load("elliptic-trammel").cycle(720)
    x, y = motion.position["P"].T
    # 160 from the block on the upright line, 60 from the one on the level line.
    assert np.max(np.abs((x / 160) ** 2 + (y / 60) ** 2 - 1)) <= 16 * EPS
    theta = motion.coordinate
    assert np.max(np.abs(x - 160 * np.cos(theta))) <= 4 * EPS * 160
    assert np.max(np.abs(y + 60 * np.sin(theta))) <= 4 * EPS * 160


def test_oldhams_shafts_turn_alike_and_the_middle_of_the_cross_goes_round_twice() -> None:
    motion = load("oldham").cycle(720)
    rate = motion.angular_velocity
    assert rate["driven"] == pytest.approx(rate["driver"], rel=1e-13)
    middle = motion.position["M"] @ [1, 1j] - 15
    assert np.max(np.abs(middle - 15 * np.exp(2j * motion.coordinate))) <= 1e-14 * 50


def test_the_oscillating_cylinders_rod_runs_through_its_trunnion() -> None:
    motion = load("oscillating-cylinder").cycle(7200)
    a, p = motion.position["A"], motion.position["P"] - [-90, 0]
    from_trunnion = a - [-90, 0]
    across = from_trunnion[:, 0] * p[:, 1] - from_trunnion[:, 1] * p[:, 0]
    assert np.max(np.abs(across)) <= 1e-14 * 155**2
    assert np.ptp(motion.angle["rod"]) == pytest.approx(2 * math.asin(60 / 90), rel=1e-6)


# What the slot passes through tells the two apart: a pin that it is driven by, or one that it is held by.
@pytest.mark.parametrize(
    ("name", "words"), [("inverted-slider-crank", "slotted bar"), ("oscillating-cylinder", "cylinder")]
)
def test_an_inverted_slider_crank_is_named_by_what_swings(name: str, words: str) -> None:
    assert load(name).info.class_name == f"inverted slider-crank, swinging {words}"
