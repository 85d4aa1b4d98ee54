"""Numbers as text: what is written reads back bit for bit."""

from __future__ import annotations

import csv
import json
import math
import struct
from io import StringIO

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from linkanim.export import csv_head, csv_rows, lines


def bits(value: float) -> bytes:
    return struct.pack("<d", value)


# whole, large, small, the last before a power, subnormal, both ends of the range, and both zeros
NUMBERS = [1.0, -2.0, 1e15, 1e16, 1e22, 123456789012345680.0, 9007199254740993.0, math.pi, 1 / 3, 1e-7]
EXTREME = [5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 0.0, -0.0]


@pytest.mark.parametrize("value", [*NUMBERS, *EXTREME])
def test_a_number_reads_back_bit_for_bit(value: float) -> None:
    (line,) = lines([np.array([value])])
    assert bits(float(line)) == bits(value)
    assert bits(float(json.loads(line))) == bits(value)
    assert len(line) <= len(repr(value))


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1, max_size=20))
@pytest.mark.slow
def test_all_numbers_of_a_table_read_back_bit_for_bit(values: list[float]) -> None:
    columns = [np.array(values), -np.array(values)]
    rows = list(csv.reader(StringIO(csv_rows(columns))))
    for value, (one, other) in zip(values, rows, strict=True):
        assert (bits(float(one)), bits(float(other))) == (bits(value), bits(-value))


def test_what_is_not_finite_is_null_in_json_and_inf_or_nothing_in_csv() -> None:
    columns = [np.array([1.0, math.nan, math.inf]), np.array([-math.inf, 2.5, math.nan])]
    assert lines(columns) == ["1.0,null", "null,2.5", "null,null"]
    assert csv_rows(columns) == "1.0,-inf\n,2.5\ninf,\n"
    assert csv_rows([np.array([1.0]), np.array([2.0])]) == "1.0,2.0\n"


def test_columns_may_be_views_of_any_layout() -> None:
    pairs = np.arange(6.0).reshape(3, 2)
    assert lines([pairs[:, 1], pairs[::-1, 0], np.broadcast_to(7.0, (3,))]) == [
        "1.0,4.0,7.0",
        "3.0,2.0,7.0",
        "5.0,0.0,7.0",
    ]
    assert lines([np.zeros(0), np.zeros(0)]) == []
    assert csv_rows([np.zeros(0)]) == ""


def test_a_name_with_a_comma_is_quoted() -> None:
    assert csv_head(["angle", "joints.B, left.x"]) == 'angle,"joints.B, left.x"\n'


def test_a_name_that_a_spreadsheet_would_run_has_an_apostrophe_in_front() -> None:
    names = ["=A1.x", "+1", "-1.position.y", "@SUM", "\ttab", "a=b", "angle_deg"]
    assert csv_head(names) == "'=A1.x,'+1,'-1.position.y,'@SUM,'\ttab,a=b,angle_deg\n"
