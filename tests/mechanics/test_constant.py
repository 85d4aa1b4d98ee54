"""A constant is a float where floats are computed with, and its number where digits are to be many."""

from __future__ import annotations

from decimal import Decimal, localcontext
from fractions import Fraction

from linkanim.mechanics.arithmetic import Constant, Graph, Value, digits_of, root
from linkanim.mechanics.precise import context
from linkanim.mechanics.program import decimals, scalar

THIRD = Constant(1 / 3, Fraction(1, 3))


def formula(x: Value) -> Value:
    made: Value = (x * (0.1 * THIRD) + root(THIRD + 1.0)) * 0.3 - x / THIRD
    return made


def test_what_is_made_of_constants_is_the_float_that_floats_make_and_stands_for_what_numbers_make() -> None:
    made = (2.0 * THIRD - 0.1) / abs(-THIRD) + 1
    assert float(made) == (2.0 * (1 / 3) - 0.1) / (1 / 3) + 1
    assert made.number == (Fraction(2, 3) - Fraction(0.1)) * 3 + 1
    assert float(root(THIRD)) == (1 / 3) ** 0.5
    with localcontext(context()):
        assert abs(digits_of(root(THIRD)) ** 2 - Decimal(1) / 3) < Decimal(10) ** -49


def test_constants_that_differ_in_their_numbers_alone_are_not_equal() -> None:
    assert THIRD != 1 / 3
    assert Constant(1 / 3) == 1 / 3
    assert hash(Constant(0.5)) == hash(0.5)


def test_a_formula_in_many_digits_keeps_the_numbers_and_one_of_floats_computes_as_without_them() -> None:
    exact, plain = Graph(exact=True), Graph()
    found = decimals(("x",), [formula(exact.input("x"))])
    with localcontext(context()):
        third, x = Decimal(1) / 3, Decimal(2)
        expected = (x * (digits_of(0.1) * third) + (third + 1).sqrt()) * digits_of(0.3) - x / third
        assert abs(found(x)[0] - expected) < Decimal(10) ** -47
    x_node, share = plain.input("x"), 0.1 * (1 / 3)
    same = (x_node * share + (1 / 3 + 1.0) ** 0.5) * 0.3 - x_node / (1 / 3)
    run, other = (scalar(("x",), [value], "{}") for value in (formula(x_node), same))
    assert run(2.0) == other(2.0)
