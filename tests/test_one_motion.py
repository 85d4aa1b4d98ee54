"""Two places that show one number agree: picture and commands, at three speeds, both ways.

What is compared is what a reader sees: the words of the HUD, the chart's curve, cursor and reading, and what
`linkanim solve` prints in words and as JSON.
"""

from __future__ import annotations

import csv
import json
import math
import re
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

from linkanim.cli import main
from linkanim.cli.commands.solve import json_rows, leaves, tree
from linkanim.export import csv_head, csv_rows
from linkanim.mechanics.motion import Pose
from linkanim.mechanics.quantities import Quantity, register
from linkanim.picture.chart import ChartPanel, chart_panel, pen_for
from linkanim.picture.figure import Figure, figure
from linkanim.picture.hud import rows
from linkanim.picture.layout import layout, with_side
from linkanim.picture.quantities import series_of
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.player.listing import value_words
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

SPEEDS = (0.3, 2 * math.pi / 3, 11.0)
PHASES = (0.4, 2.9, 5.5)
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
    own = [token for token in scene.quantities if token.startswith("P.") and token.endswith(COMPONENTS)]
    return [*scene.telling, *own]


def _strips(name: str) -> tuple[Figure, dict[str, ChartPanel]]:
    shown = figure(load(name))
    window = with_side(layout((1280, 720)), 1, 0, beside=False)
    pen = pen_for(window, Type(), LIGHT)
    return shown, {token: chart_panel(shown, token, window, pen) for token in _tokens(name)}


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
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


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_hud_says_what_solve_prints_and_where_the_cursor_stands(
    name: str, solved: Callable[..., str]
) -> None:
    shown, strips = _strips(name)
    first = next(iter(strips.values()))
    for speed, phase in MOTIONS:
        printed = json.loads(solved(name, phase, speed, "--json"))
        told = dict(rows(shown.scene, shown.scene.pose(phase, speed=speed)))
        angle = next(_number(value) for label, value in told.items() if label.endswith((" angle", " travel")))
        shown_by_solve = printed["travel"] if "travel" in printed else math.degrees(printed["angle"])
        assert math.remainder(angle - shown_by_solve, 360) == pytest.approx(0, abs=0.051)
        cursor = float(first.at(speed).course.x_of(phase))
        if shown.scene.info.full_turn:
            assert math.remainder(cursor - angle, 360) == pytest.approx(0, abs=0.051)
        else:
            there = shown.scene.pose(float(first.at(speed).course.phase_of(cursor)))
            stands = there.coordinate if "travel" in printed else math.degrees(there.coordinate)
            assert angle == pytest.approx(stands, abs=0.051)
        linkage = shown.scene.linkage
        for kind, items in (("spring", linkage.springs), ("damper", linkage.dampers)):
            for strut in items:
                found, word = printed[f"{kind}s"][strut.name], linkage.strut_word(strut)
                part = "rate" if word == "damper" else "length"
                main_value = found[part]
                assert _number(told[f"{strut.name} {word}, {part}"]) == pytest.approx(main_value, abs=0.051)
                if "force" in found:
                    assert _number(told[f"{kind} force"]) == pytest.approx(found["force"], abs=0.051)


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_words_of_solve_hold_its_json(name: str, solved: Callable[..., str]) -> None:
    links = load(name).info.link_names
    for speed, phase in MOTIONS[::4]:
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
            word = links.get(body, body)
            assert told[word] == pytest.approx([*meant, *known["coefficients"]], rel=1e-6, abs=1e-9)
        for joint, known in printed["joints"].items():
            meant = [*known["position"], *known["velocity"], *known["acceleration"]]
            assert told[joint] == pytest.approx(meant, rel=1e-6, abs=1e-9)


def _tables(words: str) -> dict[str, list[float]]:
    lines = (re.split(r"\s{2,}", line.strip()) for line in words.splitlines()[2:] if line)
    return {name: list(map(float, cells)) for name, *cells in lines if _is_number(cells[-1])}


def _is_number(word: str) -> bool:
    return re.fullmatch(r"-?[\d.]+(?:e[+-]?\d+)?", word) is not None


# Every quantity in every place that shows it, from a start that is not zero: three speeds, both ways.
PLACES = np.array([0.4, 1.7, 4.1])
PACES = (0.7, -0.7, -9.0)


def _started(name: str) -> Scene:
    """Return a scene whose drive starts elsewhere where its input turns fully; a swing has its own ends."""
    scene = load(name)
    if not scene.info.full_turn:
        return scene
    document = {**scene.document, "drive": {**scene.document.get("drive", {}), "start": "33 deg"}}
    return scene_from(document, name=name, where=name)


def _solved(scene: Scene, speed: float) -> tuple[list[Mapping[str, Any]], list[Mapping[str, str]]]:
    """Return what `solve` makes of a sweep: each row's JSON, and its cells of CSV."""
    motion = scene.solve(phase=PLACES, speed=speed)
    known = {"phase": motion.phase, **tree(scene, motion)}
    names, columns = zip(*leaves(known), strict=True)
    table = csv.DictReader((csv_head(names) + csv_rows(columns)).splitlines())
    return [json.loads(row) for row in json_rows(known)], list(table)


def _at(node: Any, path: tuple[str | int, ...]) -> float:
    """Return a number of JSON: null is unbounded, and what is left out has no value."""
    for key in path:
        if isinstance(key, str) and key not in node:
            return math.nan
        node = node[key]
    return math.inf if node is None else float(node)


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_quantity_is_the_same_in_json_csv_chart_hud_and_api(name: str) -> None:
    scene = _started(name)
    known = register(scene.linkage)
    cycle = scene.solve(phase=0.05 + np.arange(12) * (scene.period / 12))
    extent = max(float(np.abs(places).max()) for places in cycle.position.values())
    for speed in PACES:
        printed, cells = _solved(scene, speed)
        motion, solved = scene.solve(phase=PLACES, speed=speed), scene.solve(phase=cycle.phase, speed=speed)
        poses = [scene.pose(phase, speed=speed) for phase in PLACES.tolist()]
        for quantity in known.values():
            values = np.asarray(quantity.read(motion), float)
            sizes = np.abs(values[np.isfinite(values)])
            near = 1e-9 * (sizes.max(initial=0.0) + extent * 9.0**quantity.order)
            _agree(quantity, values, [quantity.read(pose) for pose in poses], near)
            if quantity.path:
                _agree(quantity, values, [_at(row, quantity.path) for row in printed], 0.0)
                _agree(quantity, values, [_cell(row, quantity.path) for row in cells], 0.0)
            charted = series_of(scene, quantity, solved).values
            meant = np.asarray(quantity.displayed(solved), float).reshape(charted.shape)
            _agree(quantity, meant, charted, 1e3 * near)
        for pose in poses:
            _hud_agrees(scene, pose)


def _cell(row: Mapping[str, str], path: tuple[str | int, ...]) -> float:
    *keys, last = path
    ends = "12" if "coefficients" in path else "xy"
    column = ".".join([*map(str, keys), ends[last] if isinstance(last, int) else last])
    return float(row[column] or math.nan)


def _agree(quantity: Quantity, meant: Any, found: Any, near: float) -> None:
    """Assert that values are the same; what is not bounded, or has no value, is neither in both."""
    one, other = np.asarray(meant, float), np.asarray(found, float)
    bounded = np.isfinite(one)
    assert np.array_equal(np.isnan(one), np.isnan(other)), quantity.token
    assert np.array_equal(bounded, np.isfinite(other)), quantity.token
    apart = one[bounded] - other[bounded]
    if quantity.unit == "rad":
        turn = 360.0 if np.abs(one[bounded]).max(initial=0.0) > 7 * math.pi else math.tau
        apart = np.where(np.abs(apart) > near, apart - turn * np.rint(apart / turn), apart)
    assert np.abs(apart).max(initial=0.0) <= near, quantity.token


def _hud_agrees(scene: Scene, pose: Pose) -> None:
    """Assert that each number of the HUD is that of the quantity it is about."""
    known, shown = register(scene.linkage), dict(rows(scene, pose))
    about = {"driving cylinder": "input.length"}
    about |= {f"input {token.partition('.')[2]}": token for token in ("input.torque", "input.force")}
    for item in scene.linkage.springs + scene.linkage.dampers:
        word = scene.linkage.strut_word(item)
        part = "rate" if word == "damper" else "length"
        about[f"{item.name} {word}, {part}"] = f"{item.name}.{part}"
    for label, token in about.items():
        if label in shown and token in known:
            value = float(known[token].displayed(pose))
            digits = shown[label].partition(".")[2].partition(" ")[0]
            assert _number(shown[label]) == pytest.approx(value, abs=0.51 * 10.0 ** -len(digits)), label


# Many turns on, with quick gears, and just short of a whole one.
@pytest.mark.parametrize(
    "name", ["geared-five-bar-3-2", "press", "crank-rocker-link3", "cardan-gears", "double-rocker"]
)
def test_the_list_of_quantities_has_the_crank_s_angle_that_the_hud_has(name: str) -> None:
    scene = _started(name)
    crank = next(body.name for body in scene.linkage.bodies if scene.linkage.crank_of(body) is not None)
    for phase in (0.0, 0.3, 5.0, 100.2, -7.0, 2 * math.pi - 1e-5, 5741.4 * math.pi / 180, -1e-13, 54362.0079):
        pose = scene.pose(phase)
        told = next(value for label, value in rows(scene, pose) if label.endswith(" angle"))
        listed = value_words(scene, scene.quantities[f"{crank}.angle"], pose)
        # each rounds once: the list to four digits, the HUD to a tenth
        assert abs(math.remainder(_number(listed.partition("=")[2]) - _number(told), 360)) < 0.1001
        if scene.info.full_turn:
            assert 0 <= _number(listed.partition("=")[2]) < 360


def test_the_list_of_quantities_says_what_is_not_bounded_and_what_there_is_none_of() -> None:
    scene = load("double-rocker")
    words = {
        token: value_words(scene, scene.quantities[token], scene.pose(math.pi))
        for token in ("coupler.coefficient", "A.tangential_acceleration", "A.velocity")
    }
    assert list(words.values()) == ["h₃ = ∞ rad/rad", "aᵗ_{A} = 264.8 mm/s²", "v_{A} = 0 mm/s"]
    pins = {"O": [0, 0], "Q": [50, 0]}
    joints = {"A": {"crank": "O", "length": 3}, "E": {"from": ["O", "Q"], "length": [40, 40], "side": "left"}}
    prop = {"ground": pins, "joints": joints, "bodies": {"prop": {"joints": ["O", "E"]}}, "length_unit": "mm"}
    held = scene_from(prop, name="held", where="held")  # it stands still, and so turns about no place
    assert value_words(held, held.quantities["prop.pole.x"], held.pose(1.0)) == "x_{P1prop} = – mm"
