"""Loads in a scene file: what they mean, what they ask of the input, and what is refused."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from linkanim.build.building import building_of
from linkanim.build.scene_form import made
from linkanim.errors import SceneError
from linkanim.mechanics.forces import Demand, input_effort
from linkanim.mechanics.linkage import Load
from linkanim.mechanics.reactions import reactions
from linkanim.scenes.editing import dimensions, with_dimensions
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse, text

FOUR_BAR = "[four-bar]\nground = 100\ncrank = 30\ncoupler = 90\nrocker = 80\n"
SLIDER = "[slider-crank]\ncrank = 40\nrod = 120\n"
PHASES = np.linspace(0.2, 6.2, 25)


def scene_of(words: str) -> Scene:
    return scene_from(parse(words, "my.toml"), name="my", where="my.toml")


def load_of(words: str) -> Load:
    (load,) = scene_of(words).linkage.loads
    return load


def load_on(body: str, *lines: str, of: str = FOUR_BAR) -> str:
    return f'{of}[loads.p]\non = "{body}"\n' + "".join(f"{line}\n" for line in lines)


READ: dict[str, tuple[str, Load]] = {
    "a force in a joint": (
        load_on("rocker", 'at = "B"', 'force = ["50 N", "-0.02 kN"]'),
        Load("p", "rocker", "B", force=(50.0, -20.0)),
    ),
    "a force at a place, and a torque": (
        load_on("coupler", 'at = ["1 cm", 5]', 'force = ["5 N", "0 N"]', 'torque = "50 N mm"'),
        Load("p", "coupler", at=(10.0, 5.0), force=(5.0, 0.0), torque=0.05),
    ),
    "a torque alone": (load_on("crank", 'torque = "-5 N m"'), Load("p", "crank", torque=-5.0)),
    "a size and a direction": (
        load_on("rocker", 'at = "B"', 'force = { size = "50 N", angle = "90 deg" }'),
        Load("p", "rocker", "B", force=(0.0, 50.0)),
    ),
    "one that turns with its body": (
        load_on("rocker", 'at = "B"', 'force = { size = "50 N", angle = "180 deg", turns = true }'),
        Load("p", "rocker", "B", force=(-50.0, 0.0), turns=True),
    ),
    "one against a slider's motion": (
        load_on("slider", 'force = { size = "5 N", against = true, moving = "backward" }', of=SLIDER),
        Load("p", "slider", force=(5.0, 0.0), against=True, way=-1),
    ),
    "sizes over the input's angle": (
        load_on("rocker", 'at = "B"', 'force = { table = [["0 deg", "1 N"], ["90 deg", "2 N"]] }'),
        Load("p", "rocker", "B", force=(1.0, 0.0), places=(0.0, math.pi / 2), values=(1.0, 2.0)),
    ),
    "sizes over the slider's travel": (
        load_on("slider", 'force = { table = [[9, "1 N"], ["2 cm", "4 N"]], over = "travel" }', of=SLIDER),
        Load("p", "slider", force=(1.0, 0.0), places=(9.0, 20.0), values=(1.0, 4.0), over_travel=True),
    ),
}


@pytest.mark.parametrize(("words", "meant"), READ.values(), ids=READ)
def test_a_load_is_read(words: str, meant: Load) -> None:
    assert load_of(words) == meant


@pytest.mark.parametrize(("words", "meant"), READ.values(), ids=READ)
def test_a_load_is_written_and_read_back(words: str, meant: Load) -> None:
    assert load_of(text(scene_of(words))) == meant


REFUSED: dict[str, tuple[str, str, str]] = {
    "no such body": (
        load_on("rockr", 'torque = "5 N m"'),
        "loads.p.on",
        'no body is called "rockr" (did you mean "rocker"?); there are crank, coupler, rocker',
    ),
    "nothing": (load_on("rocker", 'at = "B"'), "loads.p", "does nothing; give it a force"),
    "no body named": (FOUR_BAR + '[loads.p]\ntorque = "5 N m"\n', "loads.p", '"on" is missing'),
    "a joint elsewhere": (
        load_on("rocker", 'at = "A"', 'force = ["5 N", "0 N"]'),
        "loads.p.at",
        "A is no joint of rocker; name one of it (O4, B), or a place",
    ),
    "no such joint": (
        load_on("rocker", 'at = "Q"', 'force = ["5 N", "0 N"]'),
        "loads.p.at",
        "no joint is called",
    ),
    "nowhere": (
        load_on("rocker", 'force = ["5 N", "0 N"]'),
        "loads.p",
        'does not say where; write at = "O4", or a place on rocker',
    ),
    "a bare force": (load_on("rocker", 'at = "B"', "force = [5, 0]"), "loads.p.force[0]", '"5 N"'),
    "one number": (
        load_on("rocker", 'at = "B"', 'force = "5 N"'),
        "loads.p.force",
        'must be a list of 2 forces, such as ["10 N", "20 N"]',
    ),
    "a mass as a force": (
        load_on("rocker", 'at = "B"', 'force = ["5 kg", "0 N"]'),
        "loads.p.force[0]",
        "is not one of its units, N, kN",
    ),
    "a bare torque": (load_on("rocker", "torque = 5"), "loads.p.torque", '"5 N m"'),
    "a direction alone": (
        load_on("rocker", 'at = "B"', 'force = { angle = "0 deg" }'),
        "loads.p.force",
        "needs its size",
    ),
    "size and table": (
        load_on(
            "rocker", 'at = "B"', 'force = { size = "5 N", table = [["0 deg", "1 N"], ["9 deg", "1 N"]] }'
        ),
        "loads.p.force",
        "needs its size",
    ),
    "against of what turns": (
        load_on("rocker", 'at = "B"', 'force = { size = "5 N", against = true }'),
        "loads.p.force.against",
        "is of a slider, but rocker slides along no line; leave it out",
    ),
    "travel of what turns": (
        load_on("rocker", 'at = "B"', 'force = { table = [[0, "1 N"], [9, "1 N"]], over = "travel" }'),
        "loads.p.force.over",
        "is of a slider",
    ),
    "against at an angle": (
        load_on("slider", 'force = { size = "5 N", angle = "9 deg", against = true }', of=SLIDER),
        "loads.p.force.angle",
        "does not go with against",
    ),
    "over without a table": (
        load_on("slider", 'force = { size = "5 N", over = "travel" }', of=SLIDER),
        "loads.p.force.over",
        "goes with a table",
    ),
    "places that fall": (
        load_on("slider", 'force = { table = [["9 deg", "1 N"], ["0 deg", "1 N"]] }', of=SLIDER),
        "loads.p.force.table[1]",
        "let the places rise",
    ),
    "a place twice": (
        load_on("slider", 'force = { table = [["9 deg", "1 N"], ["9 deg", "2 N"]] }', of=SLIDER),
        "loads.p.force.table[1]",
        "let the places rise",
    ),
    "more than a turn": (
        load_on("slider", 'force = { table = [["0 deg", "1 N"], ["360 deg", "2 N"]] }', of=SLIDER),
        "loads.p.force.table",
        "a whole turn or more",
    ),
    "one row": (
        load_on("slider", 'force = { table = [["0 deg", "1 N"]] }', of=SLIDER),
        "loads.p.force.table",
        "must be a list of 2 to 1000 rows",
    ),
    "a row of three": (
        load_on("slider", 'force = { table = [["0 deg", "1 N", 3], ["9 deg", "1 N"]] }', of=SLIDER),
        "loads.p.force.table[0]",
        "must be a place and the force there",
    ),
    "a length for an angle": (
        load_on("slider", 'force = { table = [["0 mm", "1 N"], ["9 mm", "1 N"]] }', of=SLIDER),
        "loads.p.force.table[0][0]",
        "is not an angle",
    ),
    "an unknown key": (load_on("rocker", "forse = 3", 'torque = "5 N m"'), "loads.p.forse", '"force"'),
    "too much": (load_on("rocker", 'torque = "1e31 N m"'), "loads.p.torque", "1e+30 N m is the most"),
}


@pytest.mark.parametrize(("words", "where", "reason"), REFUSED.values(), ids=REFUSED)
def test_a_wrong_load_is_refused_in_one_line(words: str, where: str, reason: str) -> None:
    with pytest.raises(SceneError) as refusal:
        scene_of(words)
    said = str(refusal.value)
    assert said.startswith(f"my.toml: {where}")
    assert reason in said
    assert "\n" not in said


def demand_of(scene: Scene) -> Demand:
    assert scene.info.demand is not None
    return scene.info.demand


def effort(scene: Scene) -> Any:
    return np.asarray(input_effort(scene.solve(phase=PHASES, speed=2.0)))


def test_a_force_against_a_slider_asks_for_its_size_times_how_fast_it_goes() -> None:
    scene = scene_of(load_on("slider", 'force = { size = "5 N", against = true }', of=SLIDER))
    speeds = scene.solve(phase=PHASES, speed=2.0).travel_velocity["slider"]
    assert effort(scene) == pytest.approx(5e-3 * np.abs(speeds) / 2.0, rel=1e-12)
    work = demand_of(scene).work
    assert work == pytest.approx(5.0 * 0.160, rel=1e-4)  # there and back, 80 mm each


def test_a_working_force_acts_on_one_way_alone_and_by_the_travel() -> None:
    rows = 'table = [[80, "0 N"], [100, "40 N"], [120, "0 N"]], over = "travel"'
    scene = scene_of(
        load_on("slider", f'force = {{ {rows}, against = true, moving = "backward" }}', of=SLIDER)
    )
    motion = scene.solve(phase=PHASES, speed=2.0)
    speeds, travel = motion.travel_velocity["slider"], motion.travel["slider"]
    force = np.where(speeds < 0, np.interp(travel, [80, 100, 120], [0, 40, 0]), 0.0)
    assert effort(scene) == pytest.approx(force * np.abs(speeds) * 1e-3 / 2.0, rel=1e-12, abs=1e-12)
    assert (force > 1.0).sum() > 3
    found = reactions(motion)
    assert np.asarray(found.ground[0]) == pytest.approx(force, abs=1e-9)


def test_a_table_over_the_angle_begins_anew_after_a_turn() -> None:
    rows = 'table = [["90 deg", "10 N"], ["270 deg", "30 N"]]'
    scene = scene_of(load_on("slider", f"force = {{ {rows} }}", of=SLIDER))
    motion = scene.solve(phase=np.array([0.0, math.pi / 2, math.pi, 7 * math.pi / 4, 4 * math.pi]), speed=2.0)
    assert np.asarray(reactions(motion).ground[0]) == pytest.approx([20, 10, 20, 25, 20], rel=1e-12)


def test_a_torque_on_the_crank_is_the_input_s_own() -> None:
    assert effort(scene_of(load_on("crank", 'torque = "-5 N m"'))) == pytest.approx(5.0, rel=1e-13)


def test_what_a_load_takes_in_a_period_is_told() -> None:
    scene = scene_of(load_on("crank", 'torque = "-5 N m"'))
    assert demand_of(scene).work == pytest.approx(5.0 * math.tau, rel=1e-12)
    assert demand_of(scene).mean == pytest.approx(5.0, rel=1e-12)
    falling = scene_of(load_on("coupler", "at = [9, 4]", 'force = ["3 N", "-7 N"]'))
    assert demand_of(falling).work == 0.0


def test_sizes_and_directions_of_a_load_are_dimensions_to_edit() -> None:
    words = load_on(
        "rocker", "at = [10, 5]", 'force = { size = "50 N", angle = "90 deg" }', 'torque = "5 N m"'
    )
    scene = scene_of(words)
    named = {one.label: one for one in dimensions(scene) if one.key[0] == "loads"}
    assert set(named) == {
        "Load p, place, along",
        "Load p, place, to the left",
        "Load p, size",
        "Load p, direction",
        "Load p, torque",
    }
    changed = with_dimensions(scene, {named["Load p, size"].key: 80, named["Load p, torque"].key: "1 N cm"})
    (load,) = changed.linkage.loads
    assert load.force == (0.0, 80.0)
    assert load.torque == 0.01
    both = scene_of(load_on("rocker", 'at = "B"', 'force = ["50 N", "-20 N"]'))
    labels = [one.label for one in dimensions(both) if one.key[0] == "loads"]
    assert labels == ["Load p, force to the right", "Load p, force up"]


def test_a_sheet_keeps_the_loads_of_a_scene() -> None:
    scene = scene_of(load_on("rocker", 'at = "B"', 'force = ["50 N", "-20 N"]'))
    found = made(building_of(scene).draft).scene
    assert found is not None
    assert found.linkage.loads == scene.linkage.loads


def test_a_linkage_of_points_and_links_may_have_loads() -> None:
    scene = scene_of(
        "[points]\nA = [0, 0]\nB = [10, 30]\nC = [80, 60]\nD = [100, 0]\n"
        '[links]\nground = ["A", "D"]\ncrank = ["A", "B"]\ncoupler = ["B", "C"]\nrocker = ["C", "D"]\n'
        '[loads.p]\non = "rocker"\nat = "C"\nforce = ["50 N", "0 N"]\n'
    )
    (load,) = scene.linkage.loads
    assert (load.on, load.joint, load.force) == ("rocker", "C", (50.0, 0.0))
    assert scene.linkage.forceful
