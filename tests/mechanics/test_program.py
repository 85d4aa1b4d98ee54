"""One trace of the formulas gives the same numbers as floats, in blocks, and in place."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from scaling import chain

from linkanim.mechanics.arithmetic import Constant, Expr, Graph, Value, maximum, minimum, rint, select, sqrt
from linkanim.mechanics.motion import Variant, mechanism
from linkanim.mechanics.program import BLOCK, CACHE_LINE, aligned_rows, batch, needed, scalar
from linkanim.scenes import load, names


def formulas(x: Value, w: Value) -> list[Value]:
    square = x * x + 1.0
    return [
        sqrt(square) * w,
        -(x * w) + x,
        (2.0 * x) * (3.0 * w),
        (-x - w) * 0.5,
        select(x, 0.5, rint(x * 3.0), -x),
        maximum(minimum(x, w), 0.25),
        1.0 / square - x / 4.0,
        x,
        w * 1.0,
        0.0 * x + 3.0,
    ]


def noted(*, uniform: bool = True) -> list[Value]:
    graph = Graph()
    return formulas(graph.input("x"), graph.input("w", uniform=uniform))


POINTS = [-1.3, 0.0, 0.3, 0.5, 2.0]


@pytest.mark.parametrize("x", POINTS)
def test_noted_formulas_compute_what_plain_floats_do(x: float) -> None:
    outputs = noted()
    program = scalar(("x", "w"), outputs, "(" + "{}, " * len(outputs) + ")")
    assert program(x, 1.7) == pytest.approx(tuple(formulas(x, 1.7)), rel=1e-15, abs=1e-16)


def test_a_pose_computes_in_plain_floats_and_gives_them_whatever_its_constants_know() -> None:
    found: list[float] = []
    x = Graph().input("x")
    kept = scalar(["x"], [x * Constant(1 / 3, Fraction(1, 3)), Constant(0.1, Fraction(1, 10))], "({}, {})")
    found += kept(2.0)
    for name in names():
        pose = load(name).pose(0.3)
        found += [
            part for places in (pose.position, pose.acceleration) for at in places.values() for part in at
        ]
    assert {type(value) for value in found} == {float}


@pytest.mark.parametrize("count", [1, 5, BLOCK, BLOCK + 1, 2 * BLOCK + 7])
@pytest.mark.parametrize("uniform", [True, False])
def test_arrays_of_any_length_agree_with_single_values(count: int, uniform: bool) -> None:
    x = np.linspace(-1.5, 1.5, count)
    program = batch({"x": True, "w": not uniform}, noted(uniform=uniform))
    rows = program(x, 1.7 if uniform else np.full(count, 1.7))
    for index in {0, count // 2, count - 1}:
        expected = np.array(formulas(float(x[index]), 1.7), dtype=float)
        assert rows[:, index] == pytest.approx(expected, rel=1e-15, abs=1e-16)


@pytest.mark.parametrize("uniform", [True, False])
def test_a_program_gives_the_same_bits_before_it_is_compiled_and_after(uniform: bool) -> None:
    x = np.array(POINTS)
    w = 1.7 if uniform else np.full(len(x), 1.7)
    program = batch({"x": True, "w": not uniform}, noted(uniform=uniform))
    found = [program(x, w).tobytes() for _ in range(4)]
    assert "block" in vars(program.passes)
    assert len(set(found)) == 1


def test_a_pose_is_worked_out_without_compiling_and_many_are_compiled() -> None:
    graph = Graph()
    value: Value = graph.input("x")
    for _ in range(17):  # which no other test compiles
        value = sqrt(value + 3.0)
    program = batch({"x": True}, [value])
    program(np.array([0.3]))
    assert "block" not in vars(program.passes)
    program(np.linspace(0, 1, 20_000))
    assert "block" in vars(program.passes)


def test_an_operation_is_noted_once_however_often_it_is_written() -> None:
    graph = Graph()
    x, y = graph.input("x"), graph.input("y")
    assert x * y + 1.0 is y * x + 1.0
    assert len(needed([(x + y) * (x + y), sqrt(x + y)])) == 5


def test_constants_signs_and_uniform_factors_are_drawn_together() -> None:
    graph = Graph()
    x, w = graph.input("x"), graph.input("w", uniform=True)
    assert x * 0.0 == 0.0 / x == 0.0
    assert x * 1.0 is x
    assert x + 0.0 is x
    negative = -x
    assert -negative is x
    assert (2.0 * x) * 3.0 is 6.0 * x
    assert x - (-w) is x + w
    product = -(w * x)
    assert isinstance(product, Expr)
    assert product.op == "mul"
    scaled = (w * x) * 2.0
    assert isinstance(scaled, Expr)
    assert any(isinstance(argument, Expr) and argument.uniform for argument in scaled.args)


def test_buffers_are_reused_not_one_for_each_operation() -> None:
    graph = Graph()
    value: Value = graph.input("x")
    for _ in range(50):
        value = sqrt(value * value + 1.0)
    program = batch({"x": True}, [value])
    assert program.passes.buffers <= 2
    assert program(np.array([0.0]))[0, 0] == pytest.approx(math.sqrt(50.0))


def test_result_rows_serve_as_scratch_until_they_are_filled() -> None:
    graph = Graph()
    x = graph.input("x")
    roots = [sqrt(x * x + float(n)) for n in range(1, 9)]
    outputs = [roots[n] * roots[(n + 3) % 8] for n in range(8)]
    program = batch({"x": True}, outputs)
    # Eight roots wait at once; as many places as rows are there for them.
    assert program.passes.buffers <= 3
    at = 0.75
    found = program(np.array([at]))[:, 0]
    true = [math.sqrt((at * at + n) * (at * at + (n + 2) % 8 + 1)) for n in range(1, 9)]
    assert found == pytest.approx(np.array(true), rel=1e-15)


@pytest.mark.parametrize("dyads", [2, 30])
def test_a_longer_chain_needs_no_more_buffers(dyads: int) -> None:
    program, _ = mechanism(chain(dyads)).program(Variant(by_phase=True, accelerates=False), 2)
    assert program.passes.buffers <= 6


@pytest.mark.parametrize("count", [1, 7, BLOCK, BLOCK + 3, 3 * BLOCK + 17])
def test_every_row_begins_at_a_cache_line(count: int) -> None:
    for row in aligned_rows(3, count):
        assert row.ctypes.data % CACHE_LINE == 0
        assert row.shape == (count,)
