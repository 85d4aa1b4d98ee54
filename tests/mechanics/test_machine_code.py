"""Machine code gives the bits that numpy gives, or it is not used."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from ctypes import c_double
from struct import unpack_from
from typing import Any

import numpy as np
import pytest
from bits import rows
from hard_cases import DIGITS, KINDS, Make, swinging
from mpmath import mp
from random_groups import document

from linkanim.mechanics import machine_code, program
from linkanim.mechanics.arithmetic import Graph, LookUp, Value, arctan2, maximum, minimum, rint, select, sqrt
from linkanim.mechanics.machine_code import LANES, place
from linkanim.mechanics.motion import Motion
from linkanim.mechanics.program import Array, Batch, batch
from linkanim.scenes import load, names
from linkanim.scenes.many import solve_many
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

NEVER = 10**12
RANDOM = np.random.default_rng(7).uniform(-40 * math.pi, 40 * math.pi, 200)
STEPS = np.arange(-4.0, 5.0) * (math.pi / 2)
PHASES = np.concatenate([RANDOM, STEPS, STEPS + 1e-12, np.nextafter(STEPS, 9.0)])
"""Random ones; quarter turns, where limits and change points are, and what is next to them."""

SCENES = [name for name in names() if name != "excavator"]
"""The angle of an input that a cylinder turns is an arc tangent, which is numpy's own."""

installed = pytest.mark.skipif(machine_code._target() is None, reason="llvmlite is not installed")


Check = Callable[[Callable[[], Motion]], None]


class Runs(list[bool]):
    """Tells of each run of a program on eight poses or more whether it was machine code."""


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> Runs:
    found, run = Runs(), Batch._run_as_machine_code

    def noted(self: Batch, arrays: Any, uniform: Any, results: Array) -> bool:
        done = run(self, arrays, uniform, results)
        if results.shape[1] >= LANES:
            found.append(done)
        return done

    program._passes.cache_clear()
    monkeypatch.setattr(Batch, "_run_as_machine_code", noted)
    return found


@pytest.fixture
def both(monkeypatch: pytest.MonkeyPatch, runs: Runs) -> Check:
    """Return a check that a motion is the same bits by numpy and as machine code."""

    def check(solved: Callable[[], Motion]) -> None:
        runs.clear()
        monkeypatch.setattr(program, "MANY", NEVER)
        plain = dict(rows(solved()))
        assert not any(runs)
        runs.clear()
        monkeypatch.setattr(program, "MANY", 0)
        found = dict(rows(solved()))
        assert runs
        assert all(runs)
        for name, values in plain.items():
            assert same(found[name], values), name

    return check


def same(found: Array, other: Array) -> bool:
    """Whether two arrays are the same bit for bit; one NaN is as good as another."""
    found, other = np.ascontiguousarray(found), np.ascontiguousarray(other)
    bits = found.view(np.int64) == other.view(np.int64)
    return bool((bits | (np.isnan(found) & np.isnan(other))).all())


def by_angle(scene: Scene) -> Array | None:
    """Return angles of the whole range of an input that turns, its ends and what lies beyond them."""
    if not scene.linkage.drive.coordinate.is_angle:
        return None
    low, high = scene.mechanism.input_range
    ends = np.array([low, high, np.nextafter(low, high), np.nextafter(high, low), low - 0.1, high + 0.1])
    return np.concatenate([np.linspace(low, high, 100), ends])


def check_scene(both: Check, scene: Scene) -> None:
    both(lambda: scene.solve(phase=PHASES))
    both(lambda: scene.solve(phase=PHASES, speed=2.0, acceleration=-3.0))
    angles = by_angle(scene)
    if angles is not None:
        both(lambda: scene.solve(angle=angles, speed=np.linspace(1.0, 2.0, len(angles))))


@installed
@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.sampled
def test_every_scene_is_the_same_bits(scene: str, both: Check) -> None:
    solved = load(scene)
    both(lambda: solved.solve(phase=PHASES))


@installed
@pytest.mark.slow
def test_all_scenes_by_angle_and_with_an_accelerated_input_are_the_same_bits(both: Check) -> None:
    for name in SCENES:
        check_scene(both, load(name))


@installed
def test_joints_alone_of_a_linkage_that_a_cylinder_drives_are_the_same_bits(
    monkeypatch: pytest.MonkeyPatch, runs: Runs
) -> None:
    solved, found = load("excavator"), []
    joints = [joint.name for joint in solved.linkage.joints]
    for many in (NEVER, 0):
        monkeypatch.setattr(program, "MANY", many)
        found.append(np.empty((3, len(joints), 2, len(PHASES))))
        solved.solve(phase=PHASES, joints=joints, out=found[-1])
    assert runs[-1]
    assert same(*found)


@installed
@pytest.mark.parametrize("form", ["triad", pytest.param("double butterfly", marks=pytest.mark.slow)])
def test_links_that_are_solved_together_are_the_same_bits(form: str, both: Check) -> None:
    solved = scene_from(document(form, 0), name=form, where=form)
    both(lambda: solved.solve(phase=PHASES))  # by angle an arc tangent gives the phase


@installed
@pytest.mark.parametrize("make", KINDS, ids=lambda make: make.__name__)
def test_hard_cases_are_the_same_bits(make: Make, both: Check) -> None:
    with mp.workdps(DIGITS):
        found = [solved for (_, solved), _ in zip(swinging(make, 0), range(2), strict=False)]
    for solved in found:
        both(lambda: solved.solve(phase=PHASES, speed=1.0))  # noqa: B023
        low, high = solved.input_range
        angles = np.concatenate([np.linspace(low, high, 20), low + (high - low) * 10.0 ** -np.arange(1, 17)])
        both(lambda: solved.solve(angle=angles, speed=1.0))  # noqa: B023


@installed
def test_many_linkages_are_the_same_bits(monkeypatch: pytest.MonkeyPatch, runs: Runs) -> None:
    lengths = {"crank": np.linspace(20.0, 60.0, 50), "coupler": np.linspace(60.0, 150.0, 50)}
    found = []
    for many in (NEVER, 0):
        monkeypatch.setattr(program, "MANY", many)
        solved = solve_many("crank-rocker", lengths, np.linspace(0.0, 6.0, 50), derivatives=2)
        found.append(np.concatenate([solved.position["P"], solved.acceleration["P"]]))
    assert any(runs)
    assert same(*found)


SPECIAL = [0.0, -0.0, math.nan, math.inf, -math.inf, 5e-324, -1e-310, 0.5, 1.5, -2.5, 1e308, 3.0, 2.0**52 + 1]
PAIRS = np.array([(a, b) for a in SPECIAL for b in SPECIAL]).T
TABLE = LookUp([3.0, 1.0, 4.0, 1.5, 9.0])
FORMULAS: dict[str, Callable[[Value, Value], Value]] = {
    "sum": lambda a, b: a + b,
    "difference": lambda a, b: a - b,
    "product, which is not fused with a sum": lambda a, b: a * b + a,
    "quotient": lambda a, b: a / b,
    "sign": lambda a, b: -(a * b),
    "root": lambda a, b: sqrt(a),
    "nearest whole number, of two the even one": lambda a, b: rint(a),
    "lesser": minimum,
    "greater": maximum,
    "choice": lambda a, b: select(a, b, a + 1.0, 7.0),
    "an input as it is": lambda a, b: a,
    "constant": lambda a, b: a * 0.0 + 3.0,
    "look-up, beyond the table too": lambda a, b: TABLE.at(minimum(maximum(rint(a), -9.0), 9.0)),
}


@installed
@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize("uniform", [False, True])
def test_each_operation_is_the_same_bits_on_all_sorts_of_numbers(
    formula: str, uniform: bool, monkeypatch: pytest.MonkeyPatch, runs: Runs
) -> None:
    graph = Graph()
    values = FORMULAS[formula](graph.input("a"), graph.input("b", uniform=uniform))
    solve = batch({"a": True, "b": not uniform}, [values])
    for b in [*SPECIAL] if uniform else [PAIRS[1]]:
        monkeypatch.setattr(program, "MANY", NEVER)
        plain = solve(PAIRS[0], b)
        monkeypatch.setattr(program, "MANY", 0)
        assert same(solve(PAIRS[0], b), plain)
        assert runs[-1]


@installed
@pytest.mark.parametrize("count", [LANES, LANES + 1, 2 * LANES - 1, 2 * LANES, 1001])
@pytest.mark.parametrize("step", [1, 3, 0, -1])
def test_any_number_of_poses_lying_anyhow_in_memory(
    count: int, step: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(program, "MANY", 0)
    graph = Graph()
    x = graph.input("x")
    solve = batch({"x": True}, [x, x * x, 2.5])
    given = np.arange(3.0 * count)[::step][:count] if step else np.broadcast_to(np.float64(2.0), count)
    room = np.full((3, count), 7.0)
    assert solve(given, out=room) is room
    assert room.tolist() == [given.tolist(), (given * given).tolist(), [2.5] * count]


@installed
def test_few_poses_are_left_to_numpy_until_there_were_many(
    monkeypatch: pytest.MonkeyPatch, runs: Runs
) -> None:
    monkeypatch.setattr(program, "MANY", 1000)
    graph = Graph()
    solve = batch({"x": True}, [graph.input("x") * 3.0 - 0.123])
    for _ in range(4):
        solve(np.ones(300))
    assert runs == [False, False, False, True]


def off_by_one(words: bytes) -> None:
    count, first = unpack_from("2q", words)
    (c_double * count).from_address(first)[:] = [1.75] * count


@pytest.mark.parametrize("compiled", [lambda *given: None, lambda *given: off_by_one])
def test_without_machine_code_or_where_it_gives_other_bits_numpy_solves(
    compiled: Any, monkeypatch: pytest.MonkeyPatch, runs: Runs
) -> None:
    graph = Graph()
    solve = batch({"x": True}, [graph.input("x") * 3.0 - 0.25])
    monkeypatch.setattr(program, "MANY", 0)
    monkeypatch.setattr(program, "compiled", compiled)
    for _ in range(3):
        assert solve(np.ones(LANES)).tolist() == [[2.75] * LANES]
    assert runs == [False] * 3


@pytest.fixture
def no_target() -> Iterator[None]:
    machine_code._target.cache_clear()
    yield
    machine_code._target.cache_clear()


@pytest.mark.usefixtures("no_target")
def test_where_llvmlite_is_not_installed_numpy_solves(monkeypatch: pytest.MonkeyPatch, runs: Runs) -> None:
    monkeypatch.setattr(program, "MANY", 0)
    monkeypatch.setitem(sys.modules, "llvmlite", None)
    monkeypatch.setitem(sys.modules, "llvmlite.binding", None)
    graph = Graph()
    solve = batch({"x": True}, [graph.input("x") * 3.0 - 0.375])
    assert solve(np.ones(LANES)).tolist() == [[2.625] * LANES]
    assert runs == [False]


@installed
def test_what_has_no_instruction_is_left_to_numpy(monkeypatch: pytest.MonkeyPatch, runs: Runs) -> None:
    monkeypatch.setattr(program, "MANY", 0)
    graph = Graph()
    solve = batch({"x": True}, [arctan2(graph.input("x"), 1.0)])
    assert solve(np.ones(LANES)).tolist() == [np.arctan2(np.ones(LANES), 1.0).tolist()]
    assert runs == [False]


@pytest.mark.parametrize("array", [np.zeros(3), np.zeros((4, 5))[1:, 2:], np.arange(9)[::-1]])
def test_the_place_of_an_array_is_where_numpy_says(array: Array) -> None:
    array.flags.writeable = False
    assert place(array) == array.ctypes.data
