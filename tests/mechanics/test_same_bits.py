"""A pose is the same bits alone, in any batch, by phase or by angle, and with numpy's vector units off."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys

import numpy as np
import pytest
from bits import KEPT, PHASES, hashes, rows

from linkanim.mechanics.solver.input import Turn
from linkanim.scenes import load, names

MANY = np.random.default_rng(1).uniform(-100.0, 100.0, 20_000)
FAR = 2 * math.pi * np.array([1e3, 1e6 + 0.3, -1e9 - 0.1])

every_scene = pytest.mark.parametrize("scene", names())


def same(found: object, other: object) -> bool:
    """Whether two numbers or arrays are the same bit for bit, the sign of a zero included."""
    return np.asarray(found).tobytes() == np.asarray(other).tobytes()


@every_scene
@pytest.mark.sampled
def test_batches_of_any_size_hold_the_same_bits(scene: str) -> None:
    solved = load(scene)
    whole = dict(rows(solved.solve(phase=MANY)))
    for size, first in ((1, 0), (1, 19_999), (7, 16_380), (1_000, 16_000)):
        part = dict(rows(solved.solve(phase=MANY[first : first + size])))
        for name, values in whole.items():
            assert same(values[first : first + size], part[name]), name


@every_scene
@pytest.mark.sampled
def test_a_pose_alone_holds_the_bits_of_a_batch(scene: str) -> None:
    solved = load(scene)
    far = FAR[np.abs(FAR) * solved.mechanism.assembly.quickest < 2 * math.pi * 2.0**31]
    phases = np.concatenate([MANY[:40], far, [0.0, math.pi / 2, math.pi, 2 * math.pi]])
    whole = dict(rows(solved.solve(phase=phases)))
    for index, phase in enumerate(phases.tolist()):
        for name, value in rows(solved.pose(phase)):
            assert same(value, whole[name][index]), (name, phase)


@every_scene
@pytest.mark.sampled
def test_fewer_derivatives_change_no_bit(scene: str) -> None:
    solved = load(scene)
    whole = dict(rows(solved.solve(phase=PHASES)))
    for derivatives in (0, 1):
        for name, values in rows(solved.solve(phase=PHASES, derivatives=derivatives)):
            assert same(values, whole[name]), name


@every_scene
@pytest.mark.sampled
def test_an_input_that_turns_from_zero_holds_the_same_bits_by_its_angle(scene: str) -> None:
    solved = load(scene)
    path = solved.mechanism.assembly.path
    if not isinstance(path, Turn) or path.start:
        pytest.skip("its input swings, or starts elsewhere")
    by_angle = dict(rows(solved.solve(angle=MANY)))
    for name, values in rows(solved.solve(phase=MANY)):
        assert same(values, by_angle[name]), name


def test_the_bits_are_those_that_were_kept() -> None:
    assert hashes() == json.loads(KEPT.read_text())


@pytest.mark.slow
def test_numpys_vector_units_change_no_bit() -> None:
    found = np.show_config(mode="dicts")["SIMD Extensions"].get("found", [])
    environment = {**os.environ, "NPY_DISABLE_CPU_FEATURES": " ".join(found)}
    run = [sys.executable, "-W", "ignore", str(KEPT.with_name("bits.py"))]
    printed = subprocess.run(run, env=environment, capture_output=True, text=True, check=True).stdout
    assert json.loads(printed) == json.loads(KEPT.read_text())
