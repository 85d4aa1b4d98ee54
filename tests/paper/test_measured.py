"""Somebody else's table beside a curve: in which unit its first column is, and how far its values are off."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import ArrayLike

from linkanim.errors import BadInput, OutOfRange
from linkanim.paper.curves import MeasuredCurve, Pace, comparison, curves_of, read_table, table, usual_over
from linkanim.picture.look import Over
from linkanim.scenes import load

PACE = Pace(10.0, "10 rad/s")


def laid(path: Path, scene: str, token: str, over: Over | None) -> MeasuredCurve:
    curves = curves_of(load(scene), (token,), (PACE,), over)
    return comparison(curves, read_table(path, usual_over(curves), curves.curves[0].quantity), "theirs")


def written(path: Path, first: ArrayLike, values: ArrayLike, heading: str = "") -> Path:
    rows = "".join(
        f"{x!r},{y!r}\n" for x, y in np.column_stack([np.asarray(first), np.asarray(values)]).tolist()
    )
    path.write_text(heading + rows)
    return path


# the press at 87° and 10 rad/s, as its report prints what was drawn, and by how many percent that is off
PRINTED = {
    "3.angular_velocity": (3.3272, 0.003),
    "4.angular_velocity": (-1.2006, 0.008),
    "6.angular_velocity": (-5.4142, 0.002),
    "3.angular_acceleration": (12.7438, 0.015),
}


@pytest.mark.parametrize(("token", "printed", "percent"), [(key, *value) for key, value in PRINTED.items()])
def test_the_table_of_both_has_the_difference_in_percent(
    token: str, printed: float, percent: float, tmp_path: Path
) -> None:
    found = laid(written(tmp_path / "t.csv", [87.0], [printed]), "press", token, None)
    titles, row = (line.split() for line in found.table("mm").splitlines())
    assert titles[:3] == ["angle", "deg", token]
    assert titles[-1] == "percent"
    assert float(row[2]) == printed
    assert float(row[1]) + float(row[3]) == pytest.approx(printed, abs=1e-6)
    assert abs(float(row[4])) == pytest.approx(percent, abs=0.004)


@pytest.mark.parametrize("over", ["angle", "time", "phase"])
@pytest.mark.parametrize("scene", ["press", "double-rocker"])
def test_the_first_column_is_what_over_says(over: Over, scene: str, tmp_path: Path) -> None:
    solved = load(scene)
    token = f"{solved.linkage.bodies[1].name}.angle"
    phases = np.linspace(0.2, 2.6, 7)
    motion = solved.solve(phase=phases)
    first = {"angle": np.degrees(motion.coordinate), "phase": np.degrees(phases), "time": phases / 10}[over]
    values = solved.quantities[token].displayed(motion)
    found = laid(written(tmp_path / "t.csv", first, values), scene, token, over)
    assert abs(found.differences).max() < 1e-9
    assert len(found.table("mm").splitlines()) == 8
    x = (
        np.interp(found.places, found.curve.x, found.curve.values)
        if (scene, over) == ("press", over)
        else values
    )
    assert np.allclose(np.mod(x - values + 180, 360), 180, atol=0.01)


def test_a_column_in_another_unit_is_refused_with_the_way_out(tmp_path: Path) -> None:
    press, times = load("press"), np.linspace(0.0, 0.6, 13)
    values = press.quantities["3.angular_velocity"].displayed(press.solve(phase=10 * times, speed=10.0))
    noisy = 1.01 * np.asarray(values) + 0.01
    seconds = written(tmp_path / "t.csv", times, noisy)
    with pytest.raises(BadInput, match="fits as seconds, and is read as degrees; add --over time"):
        laid(seconds, "press", "3.angular_velocity", None)
    assert abs(laid(seconds, "press", "3.angular_velocity", "time").differences).max() < 0.1
    angles = np.degrees(10 * times) + np.degrees(press.linkage.drive.start)
    with pytest.raises(BadInput, match="fits as degrees, and is read as seconds; add --over angle"):
        laid(written(tmp_path / "a.csv", angles, noisy), "press", "3.angular_velocity", "time")
    headed = written(tmp_path / "h.csv", [0.1], [1.0], "Time (s),ω\n")
    with pytest.raises(BadInput, match=r'is headed "Time \(s\)"'):
        laid(headed, "press", "3.angular_velocity", None)


def test_a_table_that_is_far_off_either_way_is_shown(tmp_path: Path) -> None:
    wrong = written(tmp_path / "t.csv", np.arange(0, 360, 30), np.full(12, 50.0), "theta,ω\n")
    assert abs(laid(wrong, "press", "3.angular_velocity", None).differences).max() > 40


def test_angles_out_of_reach_name_their_line(tmp_path: Path) -> None:
    path = written(tmp_path / "t.csv", [60.0, 180.0], [1.0, 2.0], "deg,v\n")
    with pytest.raises(
        OutOfRange, match=r"line 3, column 1: the input of double-rocker does not reach 180 deg"
    ):
        laid(path, "double-rocker", "rocker.angle", "angle")


def test_a_comma_that_may_be_either_mark_is_refused(tmp_path: Path) -> None:
    (tmp_path / "t.csv").write_text("87,3,3271\n")
    with pytest.raises(BadInput, match="line 1 has 3 whole numbers: a comma in it is a decimal mark or"):
        laid(tmp_path / "t.csv", "press", "3.angle", "angle")


# In another order than they are asked for; angles are radians there, rates and lengths as they are shown.
@pytest.mark.parametrize("token", ["rocker.angle", "rocker.angular_velocity", "B.velocity"])
def test_a_table_that_was_written_by_chart_is_what_it_says(token: str, tmp_path: Path) -> None:
    path, tokens = tmp_path / "ours.csv", ("B.velocity", "rocker.angle", "rocker.angular_velocity")
    quantities = curves_of(load("crank-rocker"), tokens, (PACE,), None)
    names, values = table(quantities)
    rows = "\n".join(",".join(map(repr, row)) for row in np.column_stack(values).tolist())
    path.write_text(f"{','.join(names)}\n{rows}\n")
    assert abs(laid(path, "crank-rocker", token, None).differences).max() < 1e-9


def test_of_more_than_two_columns_one_is_headed_by_the_quantity(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    path.write_text("deg,speed,3.angle\n10,1.5,2.5\n")
    assert laid(path, "press", "3.angle", "angle").values == [2.5]
    with pytest.raises(BadInput, match=r"none of its 3 columns is headed 4\.angle; head one so, or give two"):
        laid(path, "press", "4.angle", "angle")
    path.write_text("deg,speed,3.angle\n10,1.5\n")
    with pytest.raises(BadInput, match="line 2 has 2 numbers under 3 names"):
        laid(path, "press", "3.angle", "angle")


def test_a_long_table_is_printed_by_its_ends(tmp_path: Path) -> None:
    x = np.arange(100.0)
    lines = laid(written(tmp_path / "t.csv", x, x), "press", "3.angle", None).table("mm").splitlines()
    assert len(lines) == 32
    assert lines[16].startswith("... 70 more")
