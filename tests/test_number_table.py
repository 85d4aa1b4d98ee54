"""Tables as other programs write them, and what is said of one that cannot be read."""

from __future__ import annotations

import pytest

from linkanim.errors import BadInput
from linkanim.intake import read_numbers

ROWS = [(87.0, 3.3271), (306.0, -0.25)]
# what a spreadsheet, Matlab, a solver or a hand writes
FORMS = {
    "commas": "87,3.3271\n306,-0.25\n",
    "commas and blanks": "87, 3.3271\r\n306, -0.25\r\n",
    "blanks": "  87   3.3271\n 306  -2.5e-1",
    "tabs": "87\t3.3271\n306\t-0.25\n",
    "semicolons": "87;3.3271\n306;-.25\n",
    "semicolons and decimal commas": "87;3,3271\n306;-0,25\n",
    "tabs and decimal commas": "87\t3,3271\n306\t-0,25\n",
    "blanks and decimal commas": "87 3,3271\n306 -2,5e-1\n",
    "a heading": "θ,ω\n87,3.3271\n306,-0.25\n",
    "a heading in quotes, with a comma": '"deg","ω, rad/s"\n87,3.3271\n306,-0.25\n',
    "a heading with commas over decimal commas": "angle, rate\n87 3,3271\n306 -0,25\n",
    "a heading that begins with a number in its second cell": "deg;10 rad/s\n87;3,3271\n306;-0,25\n",
    "two lines of heading, comments, empty lines": "# mine\n\nθ ω\n[°] [1/s]\n87 3.3271 # here\n\n306 -0.25",
    "a true minus and degrees": "87°,3.3271\n306°,−0.25\n",
    "a mark at the end": "87,3.3271,\n306,-0.25,\n",
}


@pytest.mark.parametrize("text", FORMS.values(), ids=FORMS)
def test_a_table_of_any_form_is_read(text: str) -> None:
    found = read_numbers(text, "t.csv", "degrees, value")
    assert [numbers for _, numbers in found.rows] == ROWS


def test_the_line_above_the_numbers_is_its_heading() -> None:
    assert read_numbers("mine\nt (s), v\n0.1, 2\n", "t.csv", "x, y").heading == ("t (s)", "v")
    assert read_numbers("0.1, 2\n", "t.csv", "x, y").heading == ()


REFUSED = {
    "a word": ("1,2\n\n3,four\n", 'line 3, column 2: "four" is not a finite number'),
    "a unit": ("87 deg,1\n", 'line 1, column 1: "87 deg" is not a finite number'),
    "a slip in the first cell": ("O.1,3\n1,2\n", 'line 1, column 1: "O.1" is not a finite number'),
    "nan": ("1,2\n3,nan\n", 'line 2, column 2: "nan" is not a finite number'),
    "too large": ("1,2\n3,1e999\n", 'line 2, column 2: "1e999" is not a finite number'),
    "an empty cell": ("1,2\n,4\n", 'line 2, column 1: "" is not a finite number; give a number, or leave'),
    "thousands": ("1;2\n3;1.234,5\n", 'line 2, column 2: "1.234,5" is not a finite number'),
    "one column": ("1,2\n3\n", 'line 2 has 1 of 2 columns (degrees, value): "3"'),
    "no row": ("deg,value\n", "has no rows; give a table of numbers: degrees, value"),
    "nothing": ("", "has no rows"),
    "a control character": ("a,b\n1,\x1b[31m\n", "line 2 has the control character U+001B"),
    "too many rows": ("1,2\n" * 30_000, "has 30,000 rows; 20,000 are the most"),
}


@pytest.mark.parametrize(("text", "words"), REFUSED.values(), ids=REFUSED)
def test_what_is_no_table_is_refused_by_line_and_column(text: str, words: str) -> None:
    with pytest.raises(BadInput) as error:
        read_numbers(text, "t.csv", "degrees, value")
    assert f"t.csv: {words}" in str(error.value)
    assert "\n" not in str(error.value)
