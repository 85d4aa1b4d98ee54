"""Functions to linkages: what is published again, exact at precision points, errors as they are elsewhere."""

from __future__ import annotations

import math
from itertools import combinations
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest

import linkanim
from linkanim.errors import BadInput
from linkanim.manifest import Output
from linkanim.mechanics.measures import transmission_angle
from linkanim.paper.construction import ErrorChart
from linkanim.paper.write import data, write
from linkanim.synthesis.front import differ
from linkanim.synthesis.generation import FUNCTIONS, Generated, expression, table
from linkanim.synthesis.linkages import Real

DEGREE = math.pi / 180


def generated(found: Generated, x: Real) -> Real:
    """Return y at x by circles that meet, from the scene file's numbers alone: none of our formulas."""
    given, document = found.task.function, found.scene.document
    angle = found.input_start + found.input_range * (x - given.first) / (given.last - given.first)
    crank, held = document["joints"]["A"]["length"], document["joints"]["B"]
    ax, ay = crank * np.cos(angle), crank * np.sin(angle)
    if found.output_body == "slider":
        rise = held["line"]["offset"] - ay
        root = np.sqrt(held["length"] ** 2 - rise**2)
        output = ax + (root if held["side"] == "forward" else -root)
    else:
        (gx, gy), (coupler, rocker) = document["ground"]["O4"], held["length"]
        dx, dy = gx - ax, gy - ay
        apart = np.hypot(dx, dy)
        along = (coupler**2 - rocker**2 + apart**2) / (2 * apart)
        left = np.sqrt(coupler**2 - along**2) * (1 if held["side"] == "left" else -1)
        bx, by = ax + (along * dx - left * dy) / apart, ay + (along * dy + left * dx) / apart
        output = np.unwrap(np.arctan2(by - gy, bx - gx))
        output += math.tau * np.round((found.output_start - output[0]) / math.tau)
    return np.asarray(given.start + given.span * (output - found.output_start) / found.output_range)


def verify(found: Generated) -> None:
    """Hold what an answer says of itself against another evaluation, and against the solver."""
    given = found.task.function
    x = np.linspace(given.first, given.last, 20_001)
    off = generated(found, x) - given(x)
    assert found.error == pytest.approx(np.abs(off).max(), rel=1e-6, abs=1e-13 * abs(given.span))
    assert np.abs(generated(found, np.sort(found.points)) - given(np.sort(found.points))).max() < 1e-10 * abs(
        given.span
    )
    for place, error in found.extremes:
        assert found.errors(np.array([place]))[0] == pytest.approx(
            error, rel=1e-6, abs=1e-14 * abs(given.span)
        )
    share = np.linspace(0, 1, 4001)
    motion = found.scene.solve(angle=found.input_start + found.input_range * share, derivatives=0)
    least = float(np.min(transmission_angle(motion, "B")))
    assert found.transmission_angle == pytest.approx(least, abs=1e-5)
    assert found.scene.linkage.bodies[-1].name == found.output_body


CURVES = [
    ("y = log10(x)", 1, 10),
    ("y = sin(x)", 0, math.pi / 2),
    ("y = x^2", 0, 1),
    ("y = 1/x", 1, 2),
    ("y = exp(x)", 0, 1),
    ("y = tan(x)", 0, 0.8),
    ("y = sin(x)", 0, math.pi),
    ("y = x^1.5", 1, 4),
]


# Of y's range the error of the best, with ranges that are free: no published linkage for them is better.
@pytest.mark.parametrize(
    ("text", "first", "last", "percent"),
    [
        (*CURVES[0], 0.03),
        *(
            pytest.param(*curve, percent, marks=pytest.mark.long)
            for curve, percent in zip(CURVES[1:], (0.1, 0.03, 0.01, 0.01, 0.1, 1.5, 0.02), strict=True)
        ),
    ],
)
@pytest.mark.slow
def test_a_function_is_followed(text: str, first: float, last: float, percent: float) -> None:
    found = linkanim.function(text, first, last)
    for one in found:
        verify(one)
    assert [one.error for one in found] == sorted(one.error for one in found)
    assert found[0].error < percent / 100 * abs(found[0].task.function.span)


@pytest.mark.long
@pytest.mark.parametrize("curve", CURVES)
def test_a_slider_follows_a_function(curve: tuple[str, float, float]) -> None:
    for one in linkanim.function(*curve, kind="slider-crank"):
        verify(one)


# Freudenstein's best linkage for log x from 1 to 2, over 60° and 60°, as textbooks quote it: bars of 3.352,
# 0.846 and 3.485 on a ground of 1, and 0.0037° off at the most; the figures that were printed were rounded.
def test_freudenstein_s_logarithm() -> None:
    sixty = 60 * DEGREE
    (found,) = linkanim.function(
        "y = log10(x)", 1, 2, input_range=sixty, output_range=sixty, points=5, count=1
    )
    verify(found)
    lengths = [found.parameters[name] / 100 for name in ("crank", "coupler", "rocker")]
    assert lengths == pytest.approx([3.352, 0.846, 3.485], abs=0.0015)
    assert f"{60 * found.error / math.log10(2):.4f}" == "0.0037"
    # six equal extremes that alternate, one more than there are numbers
    heights = [error for _, error in found.extremes]
    assert len(heights) == 6
    assert np.abs(heights) == pytest.approx([found.error] * 6, rel=1e-6)
    assert (np.sign(heights[1:]) == -np.sign(heights[:-1])).all()
    assert found.chebyshev > 3 * found.error


# Ranges of both scales (deg) and, in degrees of the output, the least largest error that there is near by.
# No printed figure is at hand for these, as one is for log x: a reference is worked out here.
LEAST = [
    ("y = sin(x)", 0, math.pi / 2, 90, 90, "0.19028"),
    ("y = sin(x)", 0, math.pi / 2, 60, 60, "0.08744"),
    ("y = x^2", 0, 1, 90, 90, "0.06699"),
    ("y = x^2", 0, 1, 60, 60, "0.01950"),
    ("y = 1/x", 1, 2, 90, -90, "0.00818"),
    ("y = 1/x", 1, 2, 60, -60, "0.00104"),
]


@pytest.mark.parametrize(("text", "first", "last", "turned", "swung", "least"), LEAST)
def test_the_largest_error_is_the_least_by_kolmogorov_s_criterion(
    text: str, first: float, last: float, turned: float, swung: float, least: str
) -> None:
    ranges = {"input_range": turned * DEGREE, "output_range": swung * DEGREE}
    (found,) = linkanim.function(text, first, last, **ranges, points=5, count=1)
    verify(found)
    assert f"{abs(swung / found.task.function.span) * found.error:.5f}" == least
    heights = np.array([error for _, error in found.extremes])
    level = np.abs(np.abs(heights) / found.error - 1) < 1e-6
    assert level.sum() == 6
    places = np.array([x for x, _ in found.extremes])[level]
    signs = np.sign(heights[level])
    assert (signs[1:] == -signs[:-1]).all()
    # How the output at each extreme changes with crank, coupler, rocker and both starts, to thirty digits, by
    # circles that meet. Of no change does it go down at all six: a mean of the slopes, weighted by numbers
    # of the errors' own signs, is none.
    side = 1 if found.scene.document["joints"]["B"]["side"] == "left" else -1

    def output(share: float, *row: mpmath.mpf) -> mpmath.mpf:
        crank, coupler, rocker, start, other = row
        pin = crank * mpmath.expj(start + share * found.input_range)
        way = 1 - pin
        along = (coupler**2 - rocker**2 + abs(way) ** 2) / (2 * abs(way))
        end = pin + way / abs(way) * (along + 1j * side * mpmath.sqrt(coupler**2 - along**2))
        # against where it is without a change, so that no whole turn lies between
        return mpmath.arg((end - 1) * mpmath.expj(-other - found.output_range * share))

    with mpmath.workdps(30):
        row = [mpmath.mpf(found.parameters[name]) / 100 for name in ("crank", "coupler", "rocker")]
        row += [mpmath.mpf(found.input_start), mpmath.mpf(found.output_start)]
        orders = [tuple(int(n == k) for n in range(5)) for k in range(5)]
        slopes = mpmath.matrix(5, 6)
        for n, x in enumerate(found.task.function.x_share(places)):
            for k, order in enumerate(orders):
                slopes[k, n] = mpmath.diff(lambda *at, x=x: output(x, *at), row, order)
        weights = mpmath.lu_solve(slopes[:, :5], -slopes[:, 5])
    weights = np.array([float(weight) for weight in [*weights, 1]])
    assert (np.sign(weights * signs) == np.sign(weights[0] * signs[0])).all()


# Of the textbooks: three points in 1…2 are 1.067, 1.500 and 1.933, in 1…4 1.201, 2.500 and 3.799.
@pytest.mark.parametrize(
    ("first", "last", "points"), [(1, 2, "1.067 1.500 1.933"), (1, 4, "1.201 2.500 3.799")]
)
def test_chebyshev_s_spacing(first: float, last: float, points: str) -> None:
    assert " ".join(f"{x:.3f}" for x in expression("x", first, last).chebyshev(3)) == points


@pytest.mark.parametrize("kind", ["four-bar", "slider-crank"])
@pytest.mark.parametrize("points", [3, 4, 5])
def test_without_levelling_a_linkage_is_exact_at_chebyshev_s_points(kind: str, points: int) -> None:
    wide = 80.0 if kind == "slider-crank" else 60 * DEGREE
    options: dict[str, Any] = {"input_range": 60 * DEGREE, "output_range": wide, "level": False}
    found = linkanim.function("y = log10(x)", 1, 10, kind=kind, points=points, count=1, **options)[0]
    verify(found)
    assert found.chebyshev == found.error
    x = found.task.function.chebyshev(points)
    assert np.abs(generated(found, x) - np.log10(x)).max() < 1e-11
    assert found.output_range == pytest.approx(wide)


def test_starts_that_are_given_are_kept_and_freudenstein_s_equation_holds() -> None:
    scales = {"input_start": 30, "input_range": 90, "output_start": 105, "output_range": 60}
    radians = {name: angle * DEGREE for name, angle in scales.items()}
    (found,) = linkanim.function("y = 1/x", 1, 2, level=False, count=1, **radians)
    verify(found)
    assert [getattr(found, name) for name in radians] == pytest.approx([*radians.values()])
    x = found.task.function.chebyshev(3)
    theta = found.input_start + found.input_range * (x - 1)
    psi = found.output_start + found.output_range * (1 / x - 1) / -0.5
    ground, crank, coupler, rocker = (
        found.parameters[name] for name in ("ground", "crank", "coupler", "rocker")
    )
    k3 = (crank**2 - coupler**2 + rocker**2 + ground**2) / (2 * crank * rocker)
    assert ground / crank * np.cos(psi) - ground / rocker * np.cos(theta) + k3 == pytest.approx(
        np.cos(theta - psi)
    )


# Kind, points, which scale's start is given, and starts for which there are linkages: none of them is half a
# turn off, where its link would point the other way. A slider runs backwards instead.
STARTS: tuple[tuple[str, int, str, tuple[float, ...]], ...] = (
    ("four-bar", 3, "input", (0.5, -0.6, 2.2, 8.0)),
    ("four-bar", 4, "input", (0.5, 5.0, 8.0)),
    ("four-bar", 3, "output", (-1.0, 1.0, 2.5, 4.0)),
    ("four-bar", 4, "output", (-1.0, 2.5, 4.0)),
    ("slider-crank", 3, "input", (0.5, -0.6, 2.2, 3.6)),
    ("slider-crank", 4, "input", (-0.6, 3.6)),
    ("slider-crank", 3, "output", (-80.0, 20.0, 150.0)),
)


@pytest.mark.parametrize(("kind", "points", "scale", "starts"), STARTS)
@pytest.mark.slow
@pytest.mark.thinned(2)
def test_a_start_that_is_given_is_kept(kind: str, points: int, scale: str, starts: tuple[float, ...]) -> None:
    name = f"{scale}_start"
    for start in starts:
        for one in linkanim.function("y = 1/x", 1, 2, kind=kind, points=points, count=2, **{name: start}):
            verify(one)
            assert getattr(one, name) == pytest.approx(start, abs=1e-7)


def test_starts_with_which_a_link_would_point_the_other_way_are_refused() -> None:
    with pytest.raises(BadInput, match="leave out where a scale begins"):
        linkanim.function(
            "y = 1/x", 1, 2, input_start=30 * DEGREE, input_range=60 * DEGREE, output_start=90 * DEGREE,
            output_range=-90 * DEGREE, level=False,
        )  # fmt: skip


def test_nothing_near_by_has_a_smaller_largest_error() -> None:
    sixty = 60 * DEGREE
    (found,) = linkanim.function("y = log10(x)", 1, 2, input_range=sixty, output_range=sixty, count=1)
    given, kind = found.task.function, found.task.kind
    row = np.array([*(found.parameters[name] / 100 for name in ("crank", "coupler", "rocker"))])
    row = np.concatenate([row, [found.input_start, found.output_start]])
    x = np.linspace(1, 2, 801)
    closure = np.array([1.0 if found.scene.document["joints"]["B"]["side"] == "left" else -1.0])
    random = np.random.default_rng(4)
    way = given.y_share(x) * found.output_range

    def largest(row: Real) -> float:
        outputs, _ = kind.outputs(row[None], closure, given.x_share(x) * found.input_range, way)
        return float(np.abs(outputs[0] - way).max() * given.span / found.output_range)

    assert largest(row) == pytest.approx(found.error, rel=1e-5)
    for size in (1e-6, 1e-5, 1e-4, 1e-3):
        tries = [largest(row + size * random.normal(size=5)) for _ in range(50)]
        assert min(tries) > found.error * (1 - 1e-6)


def test_a_table_is_a_smooth_curve_through_its_rows() -> None:
    rows = [(x, x**3 - x) for x in np.linspace(1, 2, 21)]
    curve = table(rows)
    assert curve(np.array([x for x, _ in rows])) == pytest.approx([y for _, y in rows], abs=1e-14)
    inner = np.linspace(1.2, 1.8, 50)
    assert curve(inner) == pytest.approx(inner**3 - inner, abs=1e-4)
    found = linkanim.function(rows, input_range=1.0, output_range=1.0, count=1)[0]
    verify(found)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("y = 2*x^2 + sin(x)/pi", 2 * 1.5**2 + math.sin(1.5) / math.pi),
        ("-x**-2", -(1.5**-2)),
        ("f(x) = e^x - +3", math.e**1.5 - 3),
        ("y=sqrt(abs(-x))*1e-1", 0.1 * math.sqrt(1.5)),
        *((f"{name}(x/2)", None) for name in FUNCTIONS),
    ],
)
def test_expressions(text: str, value: float | None) -> None:
    found = float(expression(text, 1, 2)(np.array([1.5]))[0])
    if value is None:
        name = text.partition("(")[0]
        value = abs(0.75) if name == "abs" else float(getattr(math, {"ln": "log"}.get(name, name))(0.75))
    assert found == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "first", "last", "said"),
    [
        ("y = log10(x)", 0, 1, r"has no value, or none that can be computed with, at x = 0"),
        ("sqrt(x)", -1, 1, "at x = -1"),
        ("1/x", -1, 1, "at x = 0"),
        ("y = 3", 0, 1, "is constant"),
        ("y = x", 2, 1, "the first below the second"),
        ("y = x", 0, math.inf, "give two numbers"),
        ("y = foo(x)", 0, 1, '"foo" is no function that is known'),
        ("y = lgo(x)", 1, 2, 'did you mean "log"'),
        ("y = t^2", 0, 1, '"t" is not known; the variable is x'),
        ("x = y", 0, 1, "write what y is"),
        ("y = sin(x, 2)", 0, 1, "sin takes one value"),
        ("y = sin", 0, 1, "is not known"),
        ("y = 2x", 0, 1, "is no expression in x"),
        ("y = (x", 0, 1, "is no expression in x"),
        ("y = __import__('os').system('true')", 0, 1, "can stand in an expression"),
        ("y = x.real", 0, 1, "can stand in an expression"),
        ("y = x if x else 1", 0, 1, "can stand in an expression"),
        ("y = [x for x in x]", 0, 1, "can stand in an expression"),
        ("y = 'x'", 0, 1, "can stand in an expression"),
        ("y = True", 0, 1, "can stand in an expression"),
        ("y = " + "(" * 150 + "x" + ")" * 45, 0, 1, "is no expression|characters"),
        ("y = " + "x+" * 200 + "x", 0, 1, "write 200 at the most"),
        ("y = 9^9^9^9^9*x", 0, 1, "none that can be computed with"),
        ("", 0, 1, "is no expression in x"),
    ],
)
def test_what_is_no_function_is_said(text: str, first: float, last: float, said: str) -> None:
    with pytest.raises(BadInput, match=said):
        expression(text, first, last)


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ([(0, 0), (1, 1)], "2 rows; give 4"),
        ([(0, 0), (1, 1), (1, 2), (3, 3)], "x goes from 1 to 1"),
        ([(0, 0), (1, math.nan), (2, 2), (3, 3)], "has no value"),
        ([(0, 2), (1, 2), (2, 2), (3, 2)], "is constant"),
    ],
)
def test_what_is_no_table_is_said(rows: list[tuple[float, float]], said: str) -> None:
    with pytest.raises(BadInput, match=said):
        table(rows)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"kind": "six-bar"}, "take four-bar or slider-crank"),
        ({"points": 2}, "in 3 to 5 points"),
        ({"points": 5, "input_start": 0.5}, "5 precision points leave no choice"),
        ({"input_range": 0.0}, "the input goes over 0 deg"),
        ({"input_range": 7.0}, "the input goes over 401.07 deg"),
        ({"output_range": math.nan}, "the output goes over nan deg"),
        ({"output_start": math.inf}, "begins at inf"),
        ({"count": 0}, "from 1 to 50"),
        ({"unit": "ft"}, "ft"),
    ],
)
def test_what_makes_no_sense_is_said(options: dict[str, Any], said: str) -> None:
    with pytest.raises(BadInput, match=said):
        linkanim.function("y = x^2", 0, 1, **options)


def test_a_function_that_no_linkage_follows_is_said() -> None:
    with pytest.raises(BadInput, match="was found that follows y = sin"):
        linkanim.function("y = sin(60*x)", 0, 6, input_range=1.0, output_range=3.0)
    with pytest.raises(BadInput, match="say over which x"):
        linkanim.function("y = x^2")


def test_the_chart_has_the_curve_and_its_extremes(tmp_path: Path) -> None:
    sixty = 60 * DEGREE
    (found,) = linkanim.function("y = log10(x)", 1, 2, input_range=sixty, output_range=sixty, count=1)
    chart = ErrorChart(found, size=(640, 360))
    picture = data(chart, ".svg").decode()
    assert picture.count("1.84") >= 6
    assert "Structural error of y = log10(x)" in picture
    write(chart, Output(tmp_path / "error.csv"))
    head, *rows = (tmp_path / "error.csv").read_text().splitlines()
    assert head.split(",") == ["x", "y", "error"]
    errors = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    assert np.abs(errors[:, 2]).max() == pytest.approx(found.error, rel=1e-3)
    assert len(data(chart, ".png")) > 1000


# The square root: the most exact answer's transmission angle is small, or that of the first is not.
@pytest.mark.slow
@pytest.mark.parametrize("words", ["sqrt(x)", "x^2"])
def test_the_first_answer_can_be_driven_and_exact_ones_are_in_order(words: str) -> None:
    built, exact = (
        linkanim.function(words, 1, 4, count=5, prefer=prefer, points=4) for prefer in ("balanced", "exact")
    )
    assert [one.error for one in exact] == sorted(one.error for one in exact)
    assert [one.error for one in built[1:]] == sorted(one.error for one in built[1:])
    near = [one for one in built if one.error <= 2 * min(one.error for one in built)]
    if max(one.transmission_angle for one in near) > math.radians(30):
        assert built[0].transmission_angle > math.radians(29.9)
        assert built[0] in near
    for one, other in combinations(built, 2):
        assert differ(one.figures, other.figures)
    with pytest.raises(BadInput, match='prefer="small": take balanced or exact'):
        linkanim.function(words, 1, 4, prefer="small")


FREUDENSTEIN = [(40, 70), (45, 76), (50, 83)]


def freudenstein(pairs: list[tuple[int, int]]) -> list[mpmath.mpf]:
    """Return crank, coupler and rocker for a ground of 100, from the three equations in fifty digits."""
    with mpmath.workdps(50):
        angles = [(mpmath.radians(one), mpmath.radians(other)) for one, other in pairs]
        rows = [[mpmath.cos(psi), -mpmath.cos(theta), 1] for theta, psi in angles]
        k1, k2, k3 = mpmath.lu_solve(rows, [mpmath.cos(theta - psi) for theta, psi in angles])
        crank, rocker = 1 / k1, 1 / k2
        coupler = mpmath.sqrt(1 + crank**2 + rocker**2 - 2 * crank * rocker * k3)
        return [100 * crank, 100 * coupler, 100 * rocker]


@pytest.mark.parametrize(
    "pairs", [FREUDENSTEIN, [(30, 60), (60, 70), (90, 85)], [(90, 85), (30, 60), (60, 70)]]
)
def test_three_pairs_of_angles_are_freudenstein_s_to_the_digits(pairs: list[tuple[int, int]]) -> None:
    (found,) = linkanim.function(np.radians(pairs), pairs=True)
    exact = freudenstein(pairs)
    lengths = [found.parameters[name] for name in ("crank", "coupler", "rocker")]
    assert lengths == pytest.approx([float(one) for one in exact], rel=1e-12)
    motion = found.scene.solve(angle=np.radians([one for one, _ in pairs]), derivatives=0)
    assert np.degrees(motion.angle["rocker"]) == pytest.approx([other for _, other in pairs], abs=1e-10)
    assert found.error < 1e-10
    assert sorted(found.points) == pytest.approx(sorted(one for one, _ in pairs))


@pytest.mark.parametrize(
    ("kind", "pairs"),
    [
        ("four-bar", [(0, 0), (20, 12), (40, 25), (60, 40)]),
        ("four-bar", [(0, 0), (20, 12), (40, 25), (60, 40), (80, 60)]),
        ("slider-crank", [(30, 100), (60, 85), (90, 65)]),
        ("slider-crank", [(30, 100), (60, 85), (90, 65), (100, 60)]),
    ],
    ids=["four", "five", "three places", "four places"],
)
def test_pairs_are_taken_between_which_nothing_is_wanted(kind: str, pairs: list[tuple[int, int]]) -> None:
    sliding = kind == "slider-crank"
    turned = np.radians([one for one, _ in pairs])
    wanted = np.array([other for _, other in pairs], dtype=float)
    rows = np.column_stack([turned, wanted if sliding else np.radians(wanted)])
    for found in linkanim.function(rows, kind=kind, pairs=True):
        motion = found.scene.solve(angle=found.input_start + turned - turned[0], derivatives=0)
        reached = motion.travel["slider"] if sliding else np.degrees(np.unwrap(motion.angle["rocker"]))
        assert reached - reached[0] == pytest.approx(wanted - wanted[0], abs=1e-9)
        assert len(pairs) > 3 or reached[0] == pytest.approx(wanted[0], abs=1e-9)


@pytest.mark.parametrize(
    ("rows", "options", "said"),
    [
        ([(1, 1), (2, 2)], {}, "2 pairs are given: a linkage takes 3 to 5"),
        ([(1, 1), (1, 2), (2, 2)], {}, "two pairs begin with 57.2958 deg"),
        ([(0, 1), (1e-3, 2), (2e-3, 2)], {}, "turn the crank by 0.114592 deg"),
        ([(0.1, 1), (0.5, 1.2), (0.9, 1.5)], {"points": 3}, "pairs are taken as they are: leave out ranges"),
        ([(math.nan, 1), (0.5, 1.2), (0.9, 1.5)], {}, "3 pairs are given"),
        ("x^2", {}, "give rows of two numbers"),
        (np.radians([(20, 210), (45, 238), (60, 260)]), {}, "add 180 deg to all of the rocker's angles"),
        (np.radians([(0, 0), (15, 12), (30, 20), (50, 40), (60, 60)]), {}, "on one branch"),
    ],
    ids=["two", "one angle twice", "too narrow", "points", "no number", "words", "turned round", "none"],
)
def test_pairs_that_no_linkage_takes_are_refused(rows: Any, options: dict[str, Any], said: str) -> None:
    with pytest.raises(BadInput, match=said):
        linkanim.function(rows, pairs=True, **options)
