"""What holds for every linkage: closure, mirror, rotation, scale, continuity, rates that are slopes."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from build import four_bar, slider_crank
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from linkanim.errors import AssemblyError
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.motion import Mechanism, Motion, mechanism
from linkanim.mechanics.solver.input import Swing

Lengths = tuple[float, float, float, float]
PHASES = np.linspace(0.0, 4 * math.pi, 161)
length = st.floats(10.0, 100.0).map(lambda value: round(value, 3))
phase = st.floats(-30.0, 30.0)
EXAMPLES = settings(max_examples=5)


def ordered(shortest: int) -> Callable[[list[float]], Lengths]:
    """Put the shortest of four lengths at a place: ground, crank, coupler, rocker."""

    def arrange(lengths: list[float]) -> Lengths:
        rest = sorted(lengths)
        first = rest.pop(0)
        rest.insert(shortest, first)
        return rest[0], rest[1], rest[2], rest[3]

    return arrange


def grashof(lengths: list[float]) -> bool:
    s, p, q, longest = sorted(lengths)
    return s + longest < p + q - 1.0


four = st.lists(length, min_size=4, max_size=4)
CLASSES = {
    "drag-link": four.filter(grashof).map(ordered(0)),
    "crank-rocker": four.filter(grashof).map(ordered(1)),
    "double-rocker": four.filter(grashof).map(ordered(2)),
    "rocker-driven": four.filter(grashof).map(ordered(3)),
    "triple-rocker": four.filter(lambda lengths: not grashof(lengths)).map(ordered(1)),
}
every_class = pytest.mark.parametrize("name", CLASSES)


def assembled(linkage: Linkage) -> Mechanism:
    try:
        return mechanism(linkage)
    except AssemblyError:
        assume(False)
        raise


def drawn(data: st.DataObject, name: str) -> tuple[Lengths, Mechanism, Motion]:
    lengths = data.draw(CLASSES[name])
    solved = assembled(four_bar(lengths))
    return lengths, solved, solved.solve(phase=PHASES, speed=1.0)


def distance(motion: Motion, a: str, b: str) -> np.ndarray:
    way = motion.position[a] - motion.position[b]
    return np.hypot(way[:, 0], way[:, 1])


@every_class
@EXAMPLES
@given(st.data())
def test_every_bar_keeps_its_length(name: str, data: st.DataObject) -> None:
    (g, r, a, b), _, motion = drawn(data, name)
    for pins, true in ((("O2", "A"), r), (("A", "B"), a), (("O4", "B"), b)):
        assert np.abs(distance(motion, *pins) - true).max() <= 1e-14 * max(g, r, a, b)


@every_class
@EXAMPLES
@given(st.data())
def test_the_other_closure_is_the_mirror_image(name: str, data: st.DataObject) -> None:
    lengths = data.draw(CLASSES[name])
    this = assembled(four_bar(lengths, start=0.7))
    path = this.assembly.path
    swings = isinstance(path, Swing)
    start = float(path.middle) if isinstance(path, Swing) else 0.7
    other = assembled(four_bar(lengths, side=-1, start=-start))
    motion = this.solve(phase=PHASES, speed=1.0)
    # Mirrored, the crank runs the other way round; a swing starts at its other end.
    mirrored = other.solve(phase=math.pi - PHASES if swings else -PHASES, speed=-1.0)
    flip = np.array([1.0, -1.0])
    fastest = np.abs(motion.acceleration["B"]).max()
    assert np.abs(mirrored.position["B"] * flip - motion.position["B"]).max() <= 1e-12 * max(lengths)
    assert np.abs(mirrored.acceleration["B"] * flip - motion.acceleration["B"]).max() <= 1e-10 * fastest


@every_class
@EXAMPLES
@given(st.data(), st.floats(-3.0, 3.0))
def test_turned_ground_turns_everything(name: str, data: st.DataObject, turn: float) -> None:
    lengths, _, motion = drawn(data, name)
    tilted = assembled(four_bar(lengths, ground_angle=turn, start=turn + float(motion.coordinate[0])))
    moved = tilted.solve(phase=PHASES, speed=1.0)
    rotation = np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    fastest = np.abs(motion.acceleration["B"]).max()
    assert np.abs(motion.position["B"] @ rotation - moved.position["B"]).max() <= 1e-13 * max(lengths)
    assert np.abs(motion.acceleration["B"] @ rotation - moved.acceleration["B"]).max() <= 1e-11 * fastest


@every_class
@EXAMPLES
@given(st.data(), st.integers(-60, 60))
def test_scaled_lengths_scale_the_picture_and_nothing_else(
    name: str, data: st.DataObject, power: int
) -> None:
    lengths, _, motion = drawn(data, name)
    factor = 2.0**power
    g, r, a, b = (value * factor for value in lengths)
    scaled = assembled(four_bar((g, r, a, b))).solve(phase=PHASES, speed=1.0)
    assert np.array_equal(scaled.position["B"], motion.position["B"] * factor)
    assert np.array_equal(scaled.angular_velocity["rocker"], motion.angular_velocity["rocker"])


@every_class
@EXAMPLES
@given(st.data(), phase)
def test_rates_are_the_slopes_of_positions(name: str, data: st.DataObject, at: float) -> None:
    lengths, solved, _ = drawn(data, name)
    step = 1e-3
    near = solved.solve(phase=at + step * np.arange(-3, 4), speed=1.0)
    # Seven-point differences: their own error falls with the sixth power of the step.
    first = np.array([-1, 9, -45, 0, 45, -9, 1]) / (60 * step)
    second = np.array([2, -27, 270, -490, 270, -27, 2]) / (180 * step**2)
    for values, slope, weights in (
        (near.position["P"], near.velocity["P"][3], first),
        (near.position["P"], near.acceleration["P"][3], second),
    ):
        change = np.abs(np.diff(near.acceleration["P"], axis=0)).max() / step
        bound = 1e-6 * max(lengths) + 1e-5 * change + 1e-3 * change**2 * step / max(lengths)
        assert np.abs(weights @ values - slope).max() <= bound


@every_class
@EXAMPLES
@given(st.data())
def test_second_differences_fall_with_the_step(name: str, data: st.DataObject) -> None:
    _, solved, motion = drawn(data, name)
    at = float(PHASES[np.abs(motion.acceleration["B"]).max(axis=1).argmax()])
    bends = []
    for step in (1e-4, 1e-5):
        near = solved.solve(phase=at + step * np.arange(-4, 5), speed=1.0, derivatives=0)
        bends.append(np.abs(np.diff(near.position["B"], 2, axis=0)).max())
    # A flip to the other closure leaves a step of its own size at any step of the phase.
    assert bends[1] <= bends[0] / 10 + 1e-11


@EXAMPLES
@given(length, length, st.floats(-50.0, 50.0), st.sampled_from([-1, 1]), st.floats(-3.0, 3.0))
def test_a_slider_stays_on_its_line_and_its_rod_keeps_its_length(
    crank: float, rod: float, offset: float, side: int, line_angle: float
) -> None:
    solved = assembled(slider_crank(crank, rod, offset, side=side, line_angle=line_angle))
    motion = solved.solve(phase=PHASES, speed=1.0)
    normal = np.array([-math.sin(line_angle), math.cos(line_angle)])
    longest = max(crank, rod, abs(offset))
    assert np.abs(motion.position["B"] @ normal - offset).max() <= 1e-13 * longest
    assert np.abs(distance(motion, "A", "B") - rod).max() <= 1e-13 * longest


@every_class
@EXAMPLES
@given(st.data(), phase, st.floats(-20.0, 20.0), st.floats(-50.0, 50.0))
def test_speed_and_acceleration_enter_as_the_chain_rule_says(
    name: str, data: st.DataObject, at: float, speed: float, second: float
) -> None:
    _, solved, _ = drawn(data, name)
    unit_speed = solved.solve(phase=at, speed=1.0)
    motion = solved.solve(phase=at, speed=speed, acceleration=second)
    expected = unit_speed.acceleration["B"] * speed**2 + unit_speed.velocity["B"] * second
    scale = np.abs(unit_speed.acceleration["B"]).max() * speed**2 + np.abs(
        unit_speed.velocity["B"]
    ).max() * abs(second)
    assert np.abs(motion.velocity["B"] - unit_speed.velocity["B"] * speed).max() <= 1e-12 * (1 + scale)
    assert np.abs(motion.acceleration["B"] - expected).max() <= 1e-12 * (1 + scale)
