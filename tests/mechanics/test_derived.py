"""What follows from solved motion: paths, poles, transmission and torque, each held to another way to it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.mechanics.linkage import Damper, Linkage, Spring
from linkanim.mechanics.measures import dyads_of
from linkanim.mechanics.motion import mechanism
from linkanim.mechanics.quantities import key_quantities, register
from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene

PHASES = np.linspace(0.3, 6.1, 17)
STEP = 1e-4
OFFSETS = STEP * np.arange(-3, 4)
FIRST = np.array([-1, 9, -45, 0, 45, -9, 1]) / (60 * STEP)


def _read(scene: Scene, token: str, *, speed: float = 2.0, acceleration: float = 0.0) -> NDArray[np.float64]:
    motion = scene.solve(phase=PHASES, speed=speed, acceleration=acceleration)
    return np.asarray(register(scene.linkage)[token].read(motion))


def _slopes(scene: Scene, token: str) -> NDArray[np.float64]:
    """Return a quantity's slopes over the phase, by differences of the seventh order."""
    read = register(scene.linkage)[token].read
    return np.array([FIRST @ read(scene.solve(phase=phase + OFFSETS)) for phase in PHASES])


def test_a_crank_pin_goes_round_a_circle() -> None:
    scene = load("press")
    assert _read(scene, "A.normal_acceleration") == pytest.approx(55 * 2.0**2)
    assert _read(scene, "A.tangential_acceleration", acceleration=3.0) == pytest.approx(55 * 3.0)
    assert _read(scene, "A.tangential_acceleration", speed=-2.0, acceleration=3.0) == pytest.approx(-55 * 3.0)
    assert _read(scene, "A.tangential_acceleration") == pytest.approx(0.0, abs=1e-10)
    assert _read(scene, "A.curvature_radius") == pytest.approx(55.0)
    assert _read(scene, "2.com_curvature_radius") == pytest.approx(20.0)


def test_a_coupler_point_s_accelerations_are_those_along_and_across_its_path() -> None:
    scene = load("crank-rocker")
    along, across = (_read(scene, f"P.{way}_acceleration") for way in ("tangential", "normal"))
    assert np.hypot(along, across) == pytest.approx(_read(scene, "P.acceleration"))
    # at constant speed of the phase dv/dt = dv/dφ·ω, of the speed without its direction
    assert along == pytest.approx(_slopes(scene, "P.velocity") / scene.linkage.drive.speed * 4.0, rel=1e-6)
    assert _read(scene, "P.curvature_radius") == pytest.approx(_read(scene, "P.velocity") ** 2 / across)


def test_a_slider_s_path_is_straight() -> None:
    assert np.isinf(_read(load("slider-crank"), "B.curvature_radius")).all()
    assert (_read(load("slider-crank"), "B.normal_acceleration") == 0).all()


def test_the_coupler_s_pole_is_where_the_lines_of_crank_and_rocker_meet() -> None:
    scene = load("crank-rocker")
    motion = scene.solve(phase=PHASES)
    a, b = (motion.position[name] @ [1, 1j] for name in "AB")
    pole = _read(scene, "coupler.pole") @ [1, 1j]
    assert (pole.conjugate() * a).imag / abs(pole * a) == pytest.approx(0.0, abs=1e-12)
    assert ((pole - 100).conjugate() * (b - 100)).imag / abs((pole - 100) * b) == pytest.approx(
        0.0, abs=1e-12
    )
    assert _read(scene, "coupler.pole.y") == pytest.approx(pole.imag)
    assert _read(scene, "rocker.pole.x") == pytest.approx(100.0)


def test_a_parallelogram_s_coupler_has_its_pole_at_infinity() -> None:
    assert np.isinf(_read(load("parallelogram"), "coupler.pole")).all()


@pytest.mark.parametrize("name", [name for name in names() if dyads_of(load(name).linkage)])
@pytest.mark.sampled
def test_the_chart_of_the_transmission_angle_goes_down_to_what_info_tells(name: str) -> None:
    scene = load(name)
    found = register(scene.linkage)["transmission_angle"].read(scene.cycle(7200))
    worst = scene.info.transmission
    assert worst is not None
    assert worst.least - 1e-9 <= found.min() <= worst.least + 2e-3
    assert found.max() <= worst.greatest + 1e-9 <= math.pi / 2 + 2e-9
    there = scene.pose(worst.phase)
    assert register(scene.linkage)["transmission_angle"].read(there) == pytest.approx(worst.least, abs=1e-7)
    label = dict(scene.info.lines)["transmission angle"]
    assert f"{math.degrees(worst.least):.3g}° at {worst.dyad}" in label


def test_the_press_transmits_worst_at_b() -> None:
    assert dict(load("press").info.lines)["transmission angle"] == "μ ≥ 20.4° at B, θ₂ = 53°"


def test_the_transmission_angle_is_that_of_the_cosine_rule() -> None:
    diagonal = np.abs(load("crank-rocker").solve(phase=PHASES).position["A"] @ [1, 1j] - 100)
    rule = np.arccos(np.abs(85**2 + 80**2 - diagonal**2) / (2 * 85 * 80))
    assert _read(load("crank-rocker"), "transmission_angle") == pytest.approx(rule)


def test_of_several_dyads_the_worst_one_counts() -> None:
    scene = load("press")
    b, c = _read(scene, "B.transmission_angle"), _read(scene, "C.transmission_angle")
    assert max(b.max(), c.max()) <= math.pi / 2
    assert _read(scene, "transmission_angle") == pytest.approx(np.minimum(b, c))


def test_the_mechanical_advantage_is_the_input_s_way_over_the_output_s() -> None:
    rocker = np.abs(1 / _slopes(load("crank-rocker"), "rocker.angle"))
    assert _read(load("crank-rocker"), "mechanical_advantage") == pytest.approx(rocker, rel=1e-7)
    slider = np.abs(55 / _slopes(load("press"), "5.travel"))
    assert _read(load("press"), "mechanical_advantage", speed=-3.0) == pytest.approx(slider, rel=1e-7)


def _sprung(linkage: Linkage, *, damped: bool = False) -> Scene:
    """Return the press with its spring alone, or its damper alone."""
    springs: tuple[Spring, ...] = () if damped else linkage.springs
    dampers: tuple[Damper, ...] = linkage.dampers if damped else ()
    return replace(load("press"), linkage=replace(linkage, springs=springs, dampers=dampers))


def test_the_torque_of_a_spring_is_the_slope_of_its_energy() -> None:
    scene = _sprung(load("press").linkage)
    length = register(scene.linkage)["return.length"]

    def energy(phases: NDArray[np.float64]) -> NDArray[np.float64]:
        stretch = (length.read(scene.solve(phase=phases)) - 280) * 1e-3
        return np.asarray(0.5 * 4000 * stretch**2)

    slopes = np.array([FIRST @ energy(phase + OFFSETS) for phase in PHASES])
    for speed in (2.0, -0.7):
        assert _read(scene, "input.torque", speed=speed) == pytest.approx(slopes, rel=1e-6)
    cycle = scene.cycle(720)
    torque = register(scene.linkage)["input.torque"].read(cycle)
    assert abs(torque.sum()) <= 1e-12 * np.abs(torque).sum()


def test_the_torque_of_a_damper_is_what_it_uses_up() -> None:
    scene = _sprung(load("press").linkage, damped=True)
    for speed in (2.0, -2.0):
        rate = _read(scene, "cushion.rate", speed=speed) * 1e-3
        assert _read(scene, "input.torque", speed=speed) * speed == pytest.approx(200 * rate**2)


def test_a_torque_is_told_only_where_a_force_is_known() -> None:
    assert "input.torque" not in register(load("crank-rocker").linkage)
    assert "input.torque" in register(load("press").linkage)


@pytest.mark.parametrize("strut", ["return", "cushion"])
def test_a_strut_s_direction_turns_at_the_rate_it_says(strut: str) -> None:
    scene = load("press")
    ends = {"return": ("C", "G"), "cushion": ("H", "S")}[strut]
    motion = scene.solve(phase=PHASES)
    way = (motion.position[ends[1]] - motion.position[ends[0]]) @ [1, 1j]
    assert np.exp(1j * _read(scene, f"{strut}.direction")) == pytest.approx(way / np.abs(way))
    slopes = _slopes(scene, f"{strut}.direction")
    assert _read(scene, f"{strut}.direction_rate") == pytest.approx(slopes * 2.0, rel=1e-7, abs=1e-10)


def test_a_strut_that_turns_round_counts_its_turns() -> None:
    linkage = load("crank-rocker").linkage
    linkage = replace(linkage, springs=(Spring("round", ("O2", "A")),))
    found = mechanism(linkage).solve(phase=np.linspace(0, 4 * math.pi, 9), speed=1.0).spring["round"]
    assert found.direction[-1] - found.direction[0] == pytest.approx(4 * math.pi)
    assert found.force is None


def test_at_a_limit_what_is_told_is_a_number_or_none_and_raises_nothing() -> None:
    scene = load("double-rocker")
    pose = scene.pose(0.0)
    for quantity in register(scene.linkage).values():
        assert not np.iscomplex(quantity.read(pose)).any()
    assert math.isinf(register(load("crank-rocker").linkage)["mechanical_advantage"].read(_resting()))


def _resting() -> object:
    """Return a crank-rocker whose rocker rests."""
    pose = load("crank-rocker").pose(1.0)
    pose.angular_velocity = {**pose.angular_velocity, "rocker": 0.0}
    return pose


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_six_to_ten_quantities_are_told_first_and_none_stands_still(name: str) -> None:
    scene = load(name)
    first = key_quantities(scene.cycle(96), scene.trace)
    assert 6 <= len(first) <= 10
    assert len(set(first)) == len(first)
    for token in first:
        values = _read(scene, token)
        assert np.ptp(values[np.isfinite(values)]) > 1e-9, token


def test_the_press_tells_ram_forces_and_links_first() -> None:
    first = key_quantities(load("press").cycle(96), ("B", "H"))
    assert first[:4] == ("5.travel_velocity", "5.travel_acceleration", "return.force", "cushion.force")
    assert first[4:6] == ("3.angular_velocity", "6.angular_velocity")


def test_a_bare_linkage_tells_what_it_has() -> None:
    linkage = replace(load("crank-rocker").linkage, bodies=())
    cycle = mechanism(linkage).solve(phase=np.linspace(0, 6, 50), speed=1.0)
    assert len(key_quantities(cycle)) >= 6


def test_a_yoke_has_no_transmission_angle_and_an_advantage() -> None:
    known = register(load("scotch-yoke").linkage)
    assert "transmission_angle" not in known
    advantage = _read(load("scotch-yoke"), "mechanical_advantage")
    angle = load("scotch-yoke").solve(phase=PHASES).coordinate
    assert advantage == pytest.approx(1 / np.abs(np.sin(angle)))


def test_where_input_and_output_rest_the_advantage_is_that_of_their_start() -> None:
    scene = load("toggle-press")
    read = register(scene.linkage)["mechanical_advantage"].read
    resting, soon = scene.pose(0.0), scene.pose(1e-4)
    assert resting.coordinate_rate == 0.0
    assert read(resting) == pytest.approx(read(soon), rel=1e-6)
    assert read(scene.solve(phase=[0.0, 1e-4])) == pytest.approx([read(resting), read(soon)], rel=1e-12)
