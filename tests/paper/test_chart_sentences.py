"""What stands under a chart is so: its numbers are those of a motion solved as finely as it takes."""

from __future__ import annotations

import re
from math import pi
from pathlib import Path

import numpy as np
import pytest

from linkanim.cli import main
from linkanim.mechanics.measures import output_body, output_slider
from linkanim.paper.curves import Pace, curves_of, within_a_turn
from linkanim.paper.sentences import about, closing, without_subscripts
from linkanim.scenes import load

PACE = Pace(10.0, "10 rad/s")


def said(scene: str, *tokens: str) -> str:
    return about(curves_of(load(scene), tokens, (PACE,)))


def numbers(text: str) -> list[float]:
    return [float(found.replace("−", "-")) for found in re.findall(r"[−]?\d+(?:\.\d+)?", text)]


def test_the_ram_falls_slowly() -> None:
    text = said("press", "5.travel")
    assert text == (
        "s₅ rises from −611.0 mm at θ₂ = 316.7° to −543.8 mm at θ₂ = 70.9° and falls again; "
        "the way down is the slow one (245.8° of the input), time ratio 2.15."
    )
    assert f"time ratio {load('press').info.time_ratio:.2f}" in text


UNEVEN = ("wiper", "pumpjack", "stephenson-1", "press", "crank-rocker", "engine", "double-rocker")
"""Outputs whose two ways all but take the same time, and others."""


@pytest.mark.parametrize("name", UNEVEN)
def test_the_time_ratio_of_the_output_is_that_of_the_scene(name: str) -> None:
    scene = load(name)
    output = output_slider(scene.linkage) or output_body(scene.linkage)
    if output is None or scene.info.time_ratio is None:
        return
    text = said(name, f"{output.name}.{'travel' if output.slider else 'angle'}")
    if told := re.search(r"time ratio ([\d.]+)\.$", text):
        digits = len(told[1].partition(".")[2])
        assert float(told[1]) == pytest.approx(scene.info.time_ratio, abs=0.6 * 10**-digits)
    elif "same time" in text:
        assert scene.info.time_ratio == pytest.approx(1.0, abs=1e-9)


# A coefficient, a spring's force and length, where a point is, a transmission angle: none of them has a way.
@pytest.mark.parametrize("name", ["press", "crank-rocker", "slider-crank"])
def test_only_a_link_or_a_slider_that_goes_to_and_fro_has_a_time_ratio(name: str) -> None:
    told = {}
    for token, quantity in load(name).quantities.items():
        if quantity.order == 0 and len(quantity.columns) == 1:
            told[token] = said(name, token)
    with_ratio = {token for token, text in told.items() if "time ratio" in text or "same time" in text}
    assert {token.rpartition(".")[2] for token in with_ratio} <= {"angle", "travel"}
    assert with_ratio
    risen = [text for token, text in told.items() if token not in with_ratio and "falls again" in text]
    assert risen
    assert all(text.endswith("and falls again.") for text in risen)


def test_a_speed_backwards_has_a_true_minus_sign() -> None:
    paces = (Pace(1.0, "1 rad/s"), Pace(-2.0, "-2 rad/s"))
    curves = curves_of(load("crank-rocker"), ("rocker.angular_velocity",), paces)
    assert [curves.words(curve) for curve in curves.curves] == ["1 rad/s", "−2 rad/s"]


def test_of_several_curves_each_has_a_short_sentence() -> None:
    text = said("press", "3.angular_velocity", "4.angular_velocity")
    assert text.startswith(
        "ω₃ goes from −3.724 rad/s at θ₂ = 3.2° to 3.495 rad/s at θ₂ = 104.9°, and changes "
    )
    assert text.count(" goes from ") == 2


def test_what_swings_is_told_over_time_and_changes_its_sign_at_different_times() -> None:
    text = about(curves_of(load("excavator"), ("boom.angular_acceleration",), (Pace(pi / 2, ""),)))
    assert " at t = 0 s, and least, " in text
    first, second = re.findall(r"([\d.]+) s", text.partition("changes its sign at")[2])
    assert float(first) + float(second) == pytest.approx(4.0, abs=0.01)
    assert float(first) < float(second)


def test_what_is_zero_but_for_rounding_is_told_as_nothing() -> None:
    assert "least, 0 mm/s, at θ₂ = 231.3°" in said("six-bar", "P2.velocity")


def test_angles_are_told_within_one_turn_where_they_can_be() -> None:
    curves = within_a_turn(curves_of(load("press"), ("3.angle", "6.angle"), (PACE,)))
    first, second = (curve.values for curve in curves.curves)
    assert 255 < first.min() < first.max() < 298
    assert -11 < second.min() < 0 < second.max() < 55  # is on both sides of the line of 0°
    assert "θ₃ goes from 255.2° at" in about(curves)


def test_extremes_and_zeros_are_where_a_fine_motion_has_them() -> None:
    scene, text = load("crank-rocker"), said("crank-rocker", "rocker.angular_velocity")
    angles = np.radians(np.arange(0, 360, 0.02))
    values = scene.solve(angle=angles, speed=10.0).angular_velocity["rocker"]
    found = re.findall(r"(−?[\d.]+) rad/s, at θ₂ = ([\d.]+)°", text)
    for (value, place), index in zip(found, (values.argmax(), values.argmin()), strict=True):
        assert float(value.replace("−", "-")) == pytest.approx(values[index], rel=2e-4)
        assert float(place) == pytest.approx(np.degrees(angles[index]), abs=0.06)
    crossing = np.flatnonzero(np.diff(np.sign(values)))
    zeros = re.findall(r"([\d.]+)°", text.partition("sign at")[2])
    assert [float(zero) for zero in zeros] == pytest.approx(np.degrees(angles[crossing]), abs=0.08)


def test_what_is_backwards_in_time_falls_where_it_rose() -> None:
    curves = [curves_of(load("press"), ("5.travel",), (Pace(speed, ""),)) for speed in (10.0, -10.0)]
    forth, back = map(about, curves)
    assert "the way down is the slow one" in forth
    assert "the way up is the slow one" in back


# a level curve, one that is at infinity all along, one unbounded at both limits of a swing, one at two angles
BARE: list[tuple[str, str, str]] = [
    ("drag-link", "crank.angular_velocity", ""),
    ("wiper", "link.pole.x", ""),
    (
        "double-rocker",
        "coupler.second_coefficient",
        "h′₃ goes to infinity at θ₂ = 13.8° and 108.4°.",
    ),
    ("crank-rocker", "coupler.pole.x", "xP13 goes to infinity at θ₂ = 127.8° and 319.2°."),
]


@pytest.mark.parametrize(("scene", "token", "sentence"), BARE)
def test_of_what_is_unbounded_it_is_said_where_and_of_the_level_nothing(
    scene: str, token: str, sentence: str
) -> None:
    assert without_subscripts(said(scene, token)) == sentence


def test_a_report_ends_with_what_the_output_does() -> None:
    first, *others = closing(load("press"), PACE)
    assert first.startswith("Geared five-bar with slider. Input: turns fully.")
    assert first.endswith("True period: one drive period, 0.6283 s.")  # at 10 rad/s, not at its own 20 rpm
    assert len(others) == 3


@pytest.mark.slow
def test_a_measured_table_stands_beside_this_solution(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # of any pose: which one reads best is asked elsewhere
    monkeypatch.setattr("linkanim.paper.report.still_phase", lambda _: 1.0)
    scene, degrees = load("crank-rocker"), np.arange(0, 360, 15.0)
    motion = scene.solve(angle=np.radians(degrees), speed=10.0)
    rates = 1.01 * motion.angular_velocity["rocker"]
    rows = [f"{at:g},{rate!r}" for at, rate in zip(degrees.tolist(), rates.tolist(), strict=True)]
    data = tmp_path / "other.csv"
    data.write_text("\n".join(["angle,rocker.angular_velocity", *rows]))
    out = tmp_path / "report"
    words = [
        "report",
        "crank-rocker",
        "-o",
        str(out),
        "--speeds",
        "10 rad/s",
        "--data",
        str(data),
        "--label",
        "MBS",
    ]
    assert main(words) == 0
    text = (out / "report.html").read_text(encoding="utf-8")
    assert "Comparison: MBS" in text
    table = text[text.index("this solution and MBS") :]
    table = table[: table.index("</table>")]
    percent = re.findall(r"<td>([^<]*)</td></tr>", table)
    assert len(percent) == 19
    assert {abs(float(cell.replace("−", "-"))) for cell in percent} == {1.0}


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("0,1\n90,2\n", "have no names"),
        ("angle,rocker.speed\n0,1\n90,2\n", "rocker.speed"),
        ("angle,rocker.angle,coupler.angle\n0,1.5,2\n90.5,2\n", "give a number under each"),
    ],
)
def test_a_table_that_cannot_be_laid_beside_is_refused(
    table: str,
    said: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("linkanim.paper.report.still_phase", lambda _: 1.0)
    data, out = tmp_path / "other.csv", tmp_path / "report"
    data.write_text(table)
    assert main(["report", "crank-rocker", "-o", str(out), "--data", str(data)]) == 2
    assert said in capsys.readouterr().err
    assert not out.exists()
