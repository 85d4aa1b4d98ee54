"""Files of curves: tables as people write them, paths as drawing programs do."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

from linkanim.errors import BadInput
from linkanim.synthesis.curve_files import read_curve

TABLES = {
    "commas": "1,2\n3,4\n5,6\n",
    "titles": "x,y\n1,2\n3,4\n5,6\n",
    "blanks": "  1 2\n3   4\n5 6",
    "tabs": "1\t2\n3\t4\n5\t6\n",
    "semicolons": "1;2\r\n3;4\r\n5;6\r\n",
    "comments and empty lines": "# drawn\n\n1, 2\n3, 4  # here\n\n5, 6\n",
}


@pytest.mark.parametrize("text", TABLES.values(), ids=TABLES)
def test_a_table_is_read(text: str, tmp_path: Path) -> None:
    path = tmp_path / "curve.csv"
    path.write_bytes(text.encode())
    found = read_curve(path)
    assert found.points.tolist() == [1 + 2j, 3 + 4j, 5 + 6j]
    assert found.angles is None


def test_a_third_column_is_the_cranks_angle(tmp_path: Path) -> None:
    path = tmp_path / "curve.csv"
    path.write_text("0 0 0\n1 0 90\n1 1 180\n")
    angles = read_curve(path).angles
    assert angles is not None
    assert angles.tolist() == [0.0, math.pi / 2, math.pi]


# A path's data, and points that are among those along it (the y axis turned up), the last one its end.
PATHS = {
    "lines": ("M 10,20 L 30,20 V 40 h-20 z", [10 - 20j, 30 - 20j, 30 - 40j, 10 - 40j, 10 - 20j]),
    "lines that follow a move": ("m1-2 3,4-1.5.5", [1 + 2j, 4 - 2j, 2.5 - 2.5j]),
    "cubic": ("M0 0C0 10 10 10 10 0", [0j, 5 - 7.5j, 10 + 0j]),
    "smooth cubic": ("M0 0C0 10 10 10 10 0S20-10 20 0", [0j, 5 - 7.5j, 15 + 7.5j, 20 + 0j]),
    "quadratic": ("M0 0Q5 10 10 0T20 0", [0j, 5 - 5j, 15 + 5j, 20 + 0j]),
    "half circles": ("M0 0A5 5 0 0 1 10 0a5 5 0 0010 0", [0j, 5 + 5j, 15 - 5j, 20 + 0j]),
    "radii too short": ("M0 0A1 1 0 0 0 10 0", [0j, 5 - 5j, 10 + 0j]),
    "radii all but zero": ("M0 0A1e-90 1e-90 0 0 0 10 0", [0j, 5 - 5j, 10 + 0j]),
    "ellipse that is a line": ("M0 0A1e-90 5 0 0 0 10 0", [0j, 10 + 0j]),
    "circle that is a line": ("M0 0A1e90 1e90 0 1 0 10 0", [0j, 10 + 0j]),
    "ends all but one": ("M0 0A1 1 0 0 0 1e-90 0L3 3", [0j, 3 - 3j]),
    "large arc": ("M0 0A5 5 0 1 1 5 5", [0j, 5 + 5j, 10 + 0j, 5 - 5j]),
    "a second stroke": ("M0 0L1 0L1 1M9 9L8 8", [0j, 1 + 0j, 1 - 1j]),
}


@pytest.mark.parametrize(("data", "expected"), PATHS.values(), ids=PATHS)
def test_a_path_is_read(data: str, expected: list[complex], tmp_path: Path) -> None:
    path = tmp_path / "curve.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg"><rect/><path d="{data}"/></svg>')
    points = read_curve(path).points
    assert abs(points[-1] - expected[-1]) < 1e-9
    for point in expected:
        assert np.abs(points - point).min() < 1e-9


REFUSED = {
    "line 2 has 4 columns": ("c.csv", "1,2\n3,4,5,6\n5,6\n"),
    'line 2, column 2: "nan"': ("c.csv", "1,2\n3,nan\n5,6\n"),
    "has no rows": ("c.csv", "# nothing\n"),
    "1 of 3 rows have an angle": ("c.csv", "1,2\n3,4,5\n5,6\n"),
    "no such file": ("c.csv", None),
    "is not SVG": ("c.svg", "<svg"),
    "has no path": ("c.svg", "<svg><rect/></svg>"),
    "does not begin with a move": ("c.svg", '<svg><path d="L 1 2"/></svg>'),
    "cannot be read at 'fish'": ("c.svg", '<svg><path d="M 1 2 fish"/></svg>'),
    "L has too few numbers": ("c.svg", '<svg><path d="M 1 2 L 3"/></svg>'),
    "transform cannot be read at 'turn": (
        "c.svg",
        '<svg><path transform="turn(9)" d="M 1 2 h 3"/></svg>',
    ),
    "cannot be read at 'scale": (
        "c.svg",
        '<svg><path transform="scale(1 2 3)" d="M 1 2 h 3"/></svg>',
    ),
    "the path has a number beyond 1e+100": ("c.svg", '<svg><path d="M 1 2 L 3 1e308"/></svg>'),
    "the transform has a number beyond": ("c.svg", '<svg><path transform="scale(1e300)" d="M1 2h3"/></svg>'),
    "more than 100,000 characters": ("c.csv", f"1,2\n{'3' * 400_000},4\n5,6\n"),
    'beyond 1e+100: "1111': ("c.svg", f'<svg><path d="M 1 2 L {"1" * 400_000} 4"/></svg>'),
    "declares entities": ("c.svg", '<!DOCTYPE svg [<!ENTITY a "b">]><svg><path d="M 1 2"/></svg>'),
}


@pytest.mark.parametrize(("words", "name", "text"), [(words, *case) for words, case in REFUSED.items()])
def test_what_is_no_curve_is_refused(words: str, name: str, text: str | None, tmp_path: Path) -> None:
    path = tmp_path / name
    if text is not None:
        path.write_text(text)
    with pytest.raises(BadInput, match=re.escape(words)) as error:
        read_curve(path)
    assert "\n" not in str(error.value)
    assert len(str(error.value)) < 300


# Where the point (3, 4) of a path comes to lie, y up, in each form of a transform; the next is (5, 4).
TRANSFORMS = {
    "translate(10 20)": (13, -24),
    "translate(10)": (13, -4),
    "scale(2)": (6, -8),
    "scale(2, -1)": (6, 4),
    "rotate(90)": (-4, -3),
    "rotate(180 3,0)": (3, 4),
    "skewX(45)": (7, -4),
    "skewY(45)": (3, -7),
    "matrix(1 2 3 4 5 6)": (20, -28),
    "translate(10,20) scale(2)": (16, -28),
    "scale(2), translate(10,20)": (26, -48),
    "translate(1e1 -.5e1)rotate(90)": (6, 2),
}


@pytest.mark.parametrize(("transform", "place"), TRANSFORMS.items(), ids=list(TRANSFORMS))
@pytest.mark.parametrize(
    "svg",
    [
        '<svg><g><path transform="{}" d="M 3 4 h 2"/></g></svg>',
        '<svg viewBox="0 0 9 9"><g transform="{}"><g><path d="M 3 4 h 2"/></g></g></svg>',
        '<svg><g transform="translate(100)"/><g transform="{}"><path d=""/><path d="M 3 4 h 2"/></g></svg>',
        '<svg><defs><path d="M 9 9 h 1"/></defs><path transform="{}" d="M 3 4 h 2"/></svg>',
    ],
    ids=["on the path", "on a group", "beside another group", "beside what is not drawn"],
)
def test_a_transform_is_followed(
    tmp_path: Path, svg: str, transform: str, place: tuple[float, float]
) -> None:
    path = tmp_path / "curve.svg"
    path.write_text(svg.format(transform))
    assert read_curve(path).points[0] == pytest.approx(complex(*place))


def test_groups_within_groups_are_transformed_from_the_outside_in(tmp_path: Path) -> None:
    path = tmp_path / "curve.svg"
    inner = '<g transform="rotate(90)"><path transform="translate(1,0)" d="M 3 4 h 2"/></g>'
    path.write_text(f'<svg><g transform="scale(2)">{inner}</g></svg>')
    assert list(read_curve(path).points) == pytest.approx([-8 - 8j, -8 - 12j])


def test_groups_nested_deeper_than_python_calls_are_read(tmp_path: Path) -> None:
    path = tmp_path / "curve.svg"
    path.write_text(f'<svg>{"<g>" * 3000}<path d="M 3 4 h 2"/>{"</g>" * 3000}</svg>')
    assert list(read_curve(path).points) == [3 - 4j, 5 - 4j]
