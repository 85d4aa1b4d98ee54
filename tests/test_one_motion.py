"""Two places that show one number agree: picture and commands, at five speeds, both ways, for every scene.

What is compared is what a reader sees: the words of the HUD, the chart's curve, cursor and reading, and what
`linkanim solve` prints in words and as JSON.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

from linkanim.cli import main
from linkanim.picture.chart import pen_for
from linkanim.picture.figure import Figure, figure
from linkanim.picture.layout import layout
from linkanim.picture.quantities import quantities, telling
from linkanim.picture.readings import rows
from linkanim.picture.strip import Strip, strip
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.scenes import load, names

SPEEDS = (0.3, 1.0, 2 * math.pi / 3, 4 * math.pi / 3, 11.0)
PHASES = (0.4, 1.7, 2.9, 4.1, 5.5)
MOTIONS = [(speed * way, PHASES[n]) for n, speed in enumerate(SPEEDS) for way in (1, -1)]
COMPONENTS = (".velocity.x", ".acceleration.y", ".position.x")

Solve = Callable[..., Any]


@pytest.fixture
def solved(capsys: pytest.CaptureFixture[str]) -> Callable[..., str]:
    """Return a function that gives back what `linkanim solve` prints at a phase and a speed."""

    def run(name: str, phase: float, speed: float, *words: str) -> str:
        asked = ["solve", name, "--phase", f"{phase!r} rad", "--speed", f"{speed!r} rad/s", *words]
        assert main(asked) == 0
        return capsys.readouterr().out

    return run


def _in_json(pose: Mapping[str, Any], token: str) -> float | None:
    """Return a quantity from what `solve --json` prints, angles in degrees; None where that has it not."""
    part, kind, *axis = [*token.split("."), ""]
    if kind in ("position", "velocity", "acceleration") and part in pose["joints"]:
        whole = kind == "position" and not axis[0]  # a chart shows both components
        return None if whole else _component(pose["joints"][part][kind], axis[0])
    for struts in (pose["springs"], pose["dampers"]):
        if part in struts and kind in struts[part]:
            return float(struts[part][kind])
    body = pose["bodies"].get(part, {})
    if kind == "angle":
        return math.degrees(body[kind])
    found = body.get(kind.removeprefix("travel_"))
    return None if found is None else float(found)


def _component(pair: list[float], axis: str) -> float:
    return pair["xy".index(axis)] if axis else math.hypot(*pair)


def _number(words: str) -> float:
    found = re.search(r"[+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?", words.replace("−", "-"))
    assert found, words
    return float(found[0])


def _tokens(name: str) -> list[str]:
    scene = load(name)
    own = [token for token in quantities(scene) if token.startswith("P.") and token.endswith(COMPONENTS)]
    return [*telling(scene), *own]


def _strips(name: str) -> tuple[Figure, dict[str, Strip]]:
    shown = figure(load(name))
    window = layout((1280, 720), chart=True)
    pen = pen_for(window, Type(), LIGHT)
    return shown, {token: strip(shown, token, window, pen) for token in _tokens(name)}


@pytest.mark.parametrize("name", names())
def test_the_chart_shows_what_solve_prints(name: str, solved: Callable[..., str]) -> None:
    shown, strips = _strips(name)
    compared = 0
    for speed, phase in MOTIONS:
        printed = json.loads(solved(name, phase, speed, "--json"))
        pose = shown.scene.pose(phase, speed=speed)
        for token, drawn in strips.items():
            value, chart = _in_json(printed, token), drawn.at(speed)
            if value is None:
                continue
            assert not math.isnan(value)
            x, curve = chart.curves
            step, place = (chart.plot.y.high - chart.plot.y.low) / 500, float(chart.course.x_of(phase))
            whole = 360.0 if token.endswith("angle") else math.inf
            read = _number(chart.reading(chart.values_at(pose))[0])
            assert math.remainder(read - value, whole) == pytest.approx(0.0, abs=step), token
            on_curve = float(np.interp(place, x, curve[:, 0]))
            assert math.remainder(on_curve - value, whole) == pytest.approx(0.0, abs=step), token
            compared += 1
    assert compared >= 4 * len(MOTIONS)


@pytest.mark.parametrize("name", names())
def test_the_hud_says_what_solve_prints_and_where_the_cursor_stands(
    name: str, solved: Callable[..., str]
) -> None:
    shown, strips = _strips(name)
    first = next(iter(strips.values()))
    for speed, phase in MOTIONS:
        printed = json.loads(solved(name, phase, speed, "--json"))
        told = dict(rows(shown.scene, shown.scene.pose(phase, speed=speed)))
        angle = next(_number(value) for label, value in told.items() if label.endswith((" angle", " travel")))
        shown_by_solve = printed["travel"] if shown.scene.linkage.slides else math.degrees(printed["angle"])
        assert math.remainder(angle - shown_by_solve, 360) == pytest.approx(0, abs=0.051)
        cursor = float(first.at(speed).course.x_of(phase))
        if shown.scene.info.full_turn:
            assert math.remainder(cursor - angle, 360) == pytest.approx(0, abs=0.051)
        else:
            there = shown.scene.pose(float(first.at(speed).course.phase_of(cursor)))
            stands = there.crank_angle if shown.scene.linkage.slides else math.degrees(there.crank_angle)
            assert angle == pytest.approx(stands, abs=0.051)
        linkage = shown.scene.linkage
        for kind, items in (("spring", linkage.springs), ("damper", linkage.dampers)):
            for strut in items:
                found, word = printed[f"{kind}s"][strut.name], linkage.strut_word(strut)
                main_value = found["rate"] if word == "damper" else found["length"]
                assert _number(told[f"{word} {strut.name}"]) == pytest.approx(main_value, abs=0.051)
                if found["force"] is not None:
                    assert _number(told[f"{kind} force"]) == pytest.approx(found["force"], abs=0.051)


@pytest.mark.parametrize("name", names())
def test_the_words_of_solve_hold_its_json(name: str, solved: Callable[..., str]) -> None:
    for speed, phase in MOTIONS[::3]:
        printed = json.loads(solved(name, phase, speed, "--json"))
        told = _tables(solved(name, phase, speed))
        for body, known in printed["bodies"].items():
            if "angle" in known:
                meant = [
                    math.degrees(known["angle"]),
                    known["angular_velocity"],
                    known["angular_acceleration"],
                ]
            else:
                meant = [known["travel"], known["velocity"], known["acceleration"]]
            assert told[body] == pytest.approx([*meant, *known["coefficients"]], rel=1e-6, abs=1e-9)
        for joint, known in printed["joints"].items():
            meant = [*known["position"], *known["velocity"], *known["acceleration"]]
            assert told[joint] == pytest.approx(meant, rel=1e-6, abs=1e-9)


def _tables(words: str) -> dict[str, list[float]]:
    lines = (re.split(r"\s{2,}", line.strip()) for line in words.splitlines()[2:] if line)
    return {name: list(map(float, cells)) for name, *cells in lines if _is_number(cells[-1])}


def _is_number(word: str) -> bool:
    return re.fullmatch(r"-?[\d.]+(?:e[+-]?\d+)?", word) is not None
