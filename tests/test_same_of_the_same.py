"""Every output says the same of the same: at limits, at rest, at dead centres, and a hair beside.

What is said is a number to its digits, that it is not bounded, 0, or that there is none. It is held to fifty
digits where those tell it, and to `Quantity.read`, which all outputs ask.
"""

from __future__ import annotations

import csv
import json
import math
import re
from collections.abc import Iterator
from functools import cache
from random import Random
from typing import Any

import numpy as np
import pytest
import read_tables
from exact_rates import ExactRates
from random_scenes import named

from linkanim.cli import main
from linkanim.cli.commands import solve
from linkanim.cli.commands.solve import Tree, json_rows, leaves, tree
from linkanim.cli.commands.solve import rows as rows_of_tree
from linkanim.errors import LinkanimError
from linkanim.explain.solution import PoseRequest, solution
from linkanim.export import csv_head, csv_rows
from linkanim.mechanics.forces import effort_token
from linkanim.mechanics.linkage import Body
from linkanim.mechanics.measures import rounding_of
from linkanim.mechanics.motion import Pose
from linkanim.mechanics.quantities import Quantity, recorded
from linkanim.mechanics.tolerances import STATED
from linkanim.paper.curves import Pace
from linkanim.paper.findings import Instant, Values
from linkanim.picture.chart import chart_panel, pen_for
from linkanim.picture.figure import Figure, figure
from linkanim.picture.hud import measured
from linkanim.picture.hud import rows as hud
from linkanim.picture.layout import layout, with_side
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.play.kinds import KINDS
from linkanim.play.question import Puzzle
from linkanim.player.listing import value_words
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.share.page import rows as share_rows
from linkanim.units import significant, stepped

BESIDE = (0.0, *(way * size for size in (1e-15, 1e-12, 1e-9, 1e-3) for way in (1, -1)))
PERIODS = 2
"""Of longer true periods so many drive periods are looked at."""
RANDOM, SEED = 300, 11
FEW = (
    "crank-rocker",
    "double-rocker",
    "driven-piston",
    "excavator",
    "parallelogram",
    "press",
    "toggle-press",
)


@cache
def scene_of(case: str) -> Scene:
    """Return a scene of the catalogue, or a random one by its number."""
    if not case.isdecimal():
        return load(case)
    return scene_from(named(SEED, int(case)), name=f"random {case}", where="random")


@cache
def good() -> tuple[str, ...]:
    """Return the numbers of random scenes that go together."""
    found: list[str] = []
    for number in range(10 * RANDOM):
        try:
            scene_of(str(number))
        except LinkanimError:
            continue
        found.append(str(number))
        if len(found) == RANDOM:
            break
    return tuple(found)


def phases(scene: Scene) -> Iterator[float]:
    """Yield 0, π, 2π and so on, which are the limits of a swing, dead centres, and what is beside them."""
    turns = min(scene.mechanism.periods, PERIODS)
    centres = [scene.info.dead_centres, scene.info.swing and scene.info.swing.dead_centres]
    places = [
        *(count * math.pi for count in range(2 * turns + 1)),
        *(at for pair in centres for at in pair or ()),
    ]
    for place in dict.fromkeys(places):
        yield from (place + beside for beside in BESIDE)


def is_limit(scene: Scene, phase: float) -> bool:
    """Whether a phase is an end of a swing, as well as floats can state one."""
    away = abs(math.remainder(phase, math.pi))
    return not scene.info.full_turn and away <= STATED * math.hypot(phase, math.pi)


# --- what is said, against fifty digits -------------------------------------------------------------


def wrong(scene: Scene, phase: float) -> Iterator[str]:
    """Yield what a pose says of rates that fifty digits do not."""
    pose, exact = scene.pose(phase), ExactRates(scene, phase)
    for joint in scene.linkage.joints:
        if not joint.fixed:
            yield from _wrong_rates(scene, pose, exact, joint.name)
            yield from _wrong_radius(scene, pose, exact, joint.name)
    for body in scene.linkage.bodies:
        if body.slider is None or scene.linkage.joint(body.slider).slides[0].axis is None:
            yield from _wrong_coefficients(scene, pose, exact, body)
        if body.slider is None:
            yield from _wrong_pole(scene, pose, exact, body)
    yield from _wrong_effort(scene, pose, exact)


def _wrong_rates(scene: Scene, pose: Pose, exact: ExactRates, name: str) -> Iterator[str]:
    greatest, speed = _greatest(scene), scene.linkage.drive.speed
    either = scene.mechanism.retraced and is_limit(scene, pose.phase)  # there velocities change their sign
    for order, kind in ((1, "velocity"), (2, "acceleration")):
        true = exact.of_joint(name, order, speed)
        unit = f"{{}}/s{'²' if order == 2 else ''}"
        least = 1e-12 * greatest[order] + 5 * rounding_of(pose, unit, order)
        for axis, part in (("x", true.real), ("y", true.imag)):
            said, right = float(scene.quantities[f"{name}.{kind}.{axis}"].read(pose)), float(part)
            ways = (right, -right) if either and order == 1 else (right,)
            if not any(_near(said, way, least) for way in ways):
                yield f"{name}.{kind}.{axis}: {said!r} is {right!r}"


def _wrong_radius(scene: Scene, pose: Pose, exact: ExactRates, name: str) -> Iterator[str]:
    """Yield a radius of curvature that is wrong: unbounded where a path is straight, or a number."""
    said, (above, below) = float(scene.quantities[f"{name}.curvature_radius"].read(pose)), exact.radius(name)
    least = (1e-6 * scene.linkage.extent) ** 3
    if above <= least:
        return  # at rest, or as good as that
    if below <= 1e-30 * above / scene.linkage.extent:
        if said != math.inf:
            yield f"{name}.curvature_radius: {said!r} of a straight path"
    elif below > 1e-6 * above / scene.linkage.extent and not _near(said, float(above / below), 0.0, 1e-6):
        yield f"{name}.curvature_radius: {said!r} is {float(above / below)!r}"


def _wrong_pole(scene: Scene, pose: Pose, exact: ExactRates, body: Body) -> Iterator[str]:
    """Yield an instant centre that is not where a body turns."""
    turning = abs(exact.of_body(body, 1))
    if turning <= 1e-6:
        return  # beyond all, or as good as that
    true = complex(exact.pole(body))
    said = complex(*np.asarray(scene.quantities[f"{body.name}.pole"].read(pose), float).tolist())
    if not abs(said - true) <= 1e-9 * (abs(true) + scene.linkage.extent) / min(float(turning), 1.0):
        yield f"{body.name}.pole: {said!r} is {true!r}"


def _wrong_effort(scene: Scene, pose: Pose, exact: ExactRates) -> Iterator[str]:
    """Yield an input's effort that is wrong: unbounded at a limit that takes power, or a number."""
    token = effort_token(scene.linkage)
    if token not in scene.quantities:
        return
    said, (power, pace) = float(scene.quantities[token].read(pose)), exact.power()
    speed = abs(scene.linkage.drive.speed)
    usual = scene.info.usual_effort or 1.0
    driven = abs(float(pace)) / speed
    share = abs(float(power)) / speed
    if is_limit(scene, pose.phase):
        if share > 1e-9 * usual and said != math.inf:
            yield f"{token}: {said!r} at a limit that takes power"
        elif share < 1e-14 * usual and not math.isfinite(said):
            yield f"{token}: {said!r} at a limit that takes none"
    elif driven > 1e-6:
        true = float(power / pace)
        if not _near(said, true, 1e-8 * usual / min(driven, 1.0)):
            yield f"{token}: {said!r} is {true!r}"


def _wrong_coefficients(scene: Scene, pose: Pose, exact: ExactRates, body: Body) -> Iterator[str]:
    """Yield what is wrong of a body's coefficients: unbounded at a limit that moves it, or a number."""
    moved, driven = exact.of_body(body, 1), exact.of_input(1)
    size, span = 1.0 if body.slider is None else scene.linkage.extent, _span(scene)
    said = [float(scene.quantities[f"{body.name}.{n}coefficient"].read(pose)) for n in ("", "second_")]
    if is_limit(scene, pose.phase) and abs(moved) > 1e-9 * size:
        if said != [math.inf, math.inf]:
            yield f"{body.name}.coefficient: {said!r} at a limit"
        return
    share = min(abs(float(driven)) / span, 1.0)
    for order, (told, true) in enumerate(zip(said, exact.coefficients(body), strict=True), start=1):
        if share**order > 1e-8:
            least = 1e-9 * size / span**order / share ** (2 * order - 1)
            if not _near(told, float(true), least):
                yield f"{body.name}, coefficient {order}: {told!r} is {float(true)!r}"


@cache
def _span(scene: Scene) -> float:
    """Return how far the input goes in a radian of phase, where it goes fastest."""
    if scene.info.full_turn:
        return 1.0
    low, high = scene.mechanism.solve(phase=[0.0, math.pi], speed=1.0, derivatives=0).coordinate
    return float(abs(high - low)) / 2


def _near(said: float, true: float, least: float, share: float = 1e-9) -> bool:
    return abs(said - true) <= share * abs(true) + least


@cache
def _greatest(scene: Scene) -> dict[int, float]:
    """Return the greatest velocity and acceleration of a cycle."""
    cycle = scene.cycle(97)
    kinds = {1: cycle.velocity, 2: cycle.acceleration}
    return {
        order: max((float(np.nanmax(np.abs(values))) for values in kind.values()), default=0.0)
        for order, kind in kinds.items()
    }


# --- what outputs say, against each other -----------------------------------------------------------


def apart(scene: Scene, phase: float, rng: Random, charts: int) -> Iterator[str]:
    """Yield where an output says other than a pose does."""
    pose, motion = scene.pose(phase), scene.solve(phase=[phase])
    found = {"phase": motion.phase, **tree(scene, motion)}
    yield from _in_json_and_csv(scene, pose, found)
    found[scene.linkage.drive.coordinate.name] = motion.coordinate
    yield from _in_words(scene, pose, found)
    for token in rng.sample(list(scene.quantities), min(charts, len(scene.quantities))):
        yield from _on_a_chart(scene, scene.quantities[token], pose)
    yield from _in_the_hud(scene, pose)
    yield from _in_a_report(scene, pose)


def _in_json_and_csv(scene: Scene, pose: Pose, found: Tree) -> Iterator[str]:
    printed = json.loads(next(json_rows(found)))
    columns, values = zip(*leaves(found), strict=True)
    cells = next(csv.DictReader((csv_head(columns) + csv_rows(values)).splitlines()))
    in_cells = dict(zip(columns, cells.values(), strict=True))
    by_path = dict(leaves(printed))
    for name, cell in in_cells.items():
        value, number = by_path.get(name, ""), "" if cell == "" else float(cell)
        if number != (math.inf if value is None else value):
            yield f"{name}: {value} in JSON, {cell!r} in CSV"
    for quantity in recorded(scene.linkage):
        said, value = quantity.read(pose), printed
        for key in quantity.path:
            value = value[key] if isinstance(key, int) and value != "" else value.get(key, "")
        meant = "" if said is None or math.isnan(said) else None if math.isinf(said) else float(said)
        if value != meant:
            yield f"{quantity.token}: a pose says {said!r}, JSON {value!r}"


def _in_words(scene: Scene, pose: Pose, found: Tree) -> Iterator[str]:
    """Yield what the tables of `solve` say otherwise: its joints' numbers, and those of the whole."""
    found = {"speed": pose.input_speed, "acceleration": 0.0, **found}
    words = solve.of_pose(scene, rows_of_tree(found))
    for joint in (joint.name for joint in scene.linkage.joints if not joint.fixed):
        kinds = [scene.quantities[f"{joint}.{kind}.{axis}"] for kind in KIND for axis in "xy"]
        cells = [significant(float(kind.read(pose)), 7) for kind in kinds]
        row = r"\s+".join(map(re.escape, (joint, *cells)))
        if not re.search(f"^{row}$", words, re.MULTILINE):
            yield f"{joint}: {cells} is not what its row has"
    for quantity in recorded(scene.linkage):
        if quantity.path == tuple(quantity.token.split(".")):
            shown = significant(float(quantity.displayed(pose)), 7)
            if not re.search(rf"^{re.escape(quantity.words)} .*\s{re.escape(shown)}$", words, re.MULTILINE):
                yield f"{quantity.token}: {shown} is not in the table"


KIND = ("position", "velocity", "acceleration")


def _on_a_chart(scene: Scene, quantity: Quantity, pose: Pose) -> Iterator[str]:
    window = with_side(layout((1280, 720)), 1, 0, beside=False)
    chart = chart_panel(_figure(scene), quantity.token, window, pen_for(window, Type(), LIGHT))
    values, said = chart.values_at(pose), np.atleast_1d(np.asarray(quantity.displayed(pose), float))
    whole = 360.0 if chart.series.unit == "°" else math.inf
    for value, own in zip(values.tolist(), said.tolist(), strict=True):
        far = abs(math.remainder(value - own, whole)) > 1e-9 * abs(own) if math.isfinite(own) else False
        if far or (not math.isfinite(own) and repr(value) != repr(own)):
            yield f"{quantity.token}: {own} is {value} on the chart"
    for word, value in zip(chart.reading(values), values.tolist(), strict=True):
        if ("∞" in word) != math.isinf(value) or ("–" in word) != math.isnan(value):
            yield f"{quantity.token}: {value} reads {word!r} on the chart"
    listed = value_words(scene, quantity, pose)
    if ("∞" in listed) != bool(np.isinf(said).any()):
        yield f"{quantity.token}: {said} is {listed!r} in the list"


@cache
def _figure(scene: Scene) -> Figure:
    return figure(scene)


def _in_the_hud(scene: Scene, pose: Pose) -> Iterator[str]:
    told = dict(hud(scene, pose))
    for one in measured(scene):
        value = one.quantity.displayed(pose)
        wanted = f"{stepped(float(value), one.step)} {one.quantity.display_unit(scene.length_unit)}"
        if told[one.label] != wanted:
            yield f"{one.quantity.token}: {value} is {told[one.label]!r} in the HUD"


def _in_a_report(scene: Scene, pose: Pose) -> Iterator[str]:
    instant, pace = Instant(pose.phase), Pace(scene.linkage.drive.speed, "")
    for quantity in scene.quantities.values():
        if len(quantity.columns) == 1:
            told, own = _values(scene).of(quantity, instant, pace), quantity.displayed(pose)
            if repr(float(told)) != repr(float(own)):
                yield f"{quantity.token}: {own!r} is {told!r} in a report"


@cache
def _values(scene: Scene) -> Values:
    return Values(scene)


def shared_otherwise(scene: Scene, phase: float) -> Iterator[str]:
    """Yield what the shared page's table says otherwise, read as its script does."""
    data: Any = _shared(scene)
    geared = any("gear" in joint for joint in scene.document.get("joints", {}).values())
    for one in measured(scene):
        own = float(one.quantity.displayed(scene.pose(phase)))
        value = read_tables.row(data, one.label, phase)
        least = 1e-6 * (_largest(scene, one.quantity.token) + 1e-2 * one.step)
        if geared:  # a table's steps are those of the input, whose quick gears go farther in one
            least = max(least, one.step / 2)
        near = abs(value - own) <= 1e-6 * abs(own) + least if math.isfinite(own) else value == own
        if not near:
            yield f"{one.label}: {own} is {value} on a page"


@cache
def _largest(scene: Scene, token: str) -> float:
    """Return the greatest size of a quantity at some phases, where it is bounded."""
    values = np.abs(np.asarray(scene.quantities[token].displayed(scene.cycle(97)), float))
    return float(values[np.isfinite(values)].max(initial=0.0))


@cache
def _shared(scene: Scene) -> Any:
    rows = json.loads(json.dumps(list(share_rows(scene, scene.linkage.drive.speed))))
    known = {"period": scene.period, "retraced": scene.mechanism.retraced}
    return {**known, "sides": [{"rows": rows}]}


def explained_otherwise(scene: Scene, phase: float) -> Iterator[str]:
    """Yield what a worked solution comes to that a pose does not say."""
    pose, speed = scene.pose(phase), scene.linkage.drive.speed
    for result in solution(PoseRequest(scene, "phase", phase, speed)).results:
        own = float(scene.quantities[result.token].displayed(pose))
        off = abs(result.value.value - own)
        off = abs(math.remainder(off, 360.0)) if result.unit == "°" else off
        if not off <= 2e-3 * abs(own) + 2 * result.least:
            yield f"{result.token}: {own} is worked out as {result.value.value}"


def asked_of_nothing(scene: Scene, phase: float, rng: Random) -> Iterator[str]:
    """Yield questions about what does not move, or whose right answer has the other sign."""
    pose = scene.pose(phase)
    for kind in ("turning", "heading", "speeding", "fastest", "curves"):
        question = KINDS[kind].make(Puzzle(kind, scene, phase, rng))
        if question is None:
            continue
        right = question.answers[question.right].text
        if kind == "turning":
            rate = scene.quantities[f"{question.subject}.angular_velocity"].read(pose)
            if not rate or (rate > 0) != (right == "counterclockwise"):
                yield f"{kind}: {question.subject} turns at {rate}, answered {right!r}"
        elif kind in ("heading", "speeding") and not scene.quantities[f"{question.subject}.velocity"].read(
            pose
        ):
            yield f"{kind}: {question.subject} rests"
        elif kind == "fastest" and not scene.quantities[f"{right}.velocity"].read(pose):
            yield f"{kind}: {right} rests"


@pytest.mark.parametrize("name", ["roberts-line", "triple-rocker", "triple-rocker-out-in"])
def test_where_the_input_is_is_said_like_the_body_s_angle(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Half-way it is at 0: a cosine of π/2 in floats is none."""
    assert main(["solve", name, "--phase", "90 deg", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    driven = scene_of(name).linkage.driven.body
    assert driven
    assert found["angle"] == found["bodies"][driven.name]["angle"] == 0.0
    assert main(["solve", name, "--sweep", "0:180:90", "--phase", "--csv", "-"]) == 0
    rows = [*csv.DictReader(capsys.readouterr().out.splitlines())]
    assert float(rows[1]["angle"]) == 0.0


def test_the_least_transmission_angle_at_the_start_is_at_the_start() -> None:
    for name in ("crank-rocker", "double-rocker", "triple-rocker-in-in"):
        found = scene_of(name).info.transmission
        assert found
        assert found.phase == 0.0


# --- the tests --------------------------------------------------------------------------------------


@pytest.mark.thinned(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", FEW)
def test_all_outputs_say_what_a_pose_says_beside_what_is_singular(name: str) -> None:
    scene, rng = scene_of(name), Random(name)
    for phase in (0.0, math.pi, math.pi - 1e-12, 2 * math.pi + 1e-9):
        assert [*apart(scene, phase, rng, charts=1), *shared_otherwise(scene, phase)] == [], phase
        assert [*wrong(scene, phase), *asked_of_nothing(scene, phase, rng)] == [], phase


@pytest.mark.long
@pytest.mark.slow
@pytest.mark.parametrize("part", range(20))
def test_all_outputs_of_all_scenes_say_the_same_of_the_same(part: int) -> None:
    faults: list[str] = []
    for case in (*names(), *good())[part::20]:
        scene, rng = scene_of(case), Random(case)
        for number, phase in enumerate(phases(scene)):
            found = [*apart(scene, phase, rng, charts=3)]
            found += [*shared_otherwise(scene, phase), *asked_of_nothing(scene, phase, rng)]
            found += wrong(scene, phase)
            found += explained_otherwise(scene, phase) if number % len(BESIDE) in (0, 3, 7) else ()
            faults += [f"{case} at {phase!r}: {one}" for one in found]
    assert faults == []
