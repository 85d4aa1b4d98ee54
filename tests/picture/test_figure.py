"""What of a linkage is drawn, also where a scene names no bodies."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from linkanim.mechanics.linkage import RPP, RPR, RRP, Crank, Drive, Line, Linkage, Pin
from linkanim.picture.bodies import body_parts, colours_of
from linkanim.picture.figure import DrawContext, figure
from linkanim.picture.fit import of_linkage
from linkanim.picture.layout import gauge
from linkanim.picture.raster import Loop
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import View
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

GAUGE = gauge(1.0, 100.0)
VIEW = View(1.0, 0.0, 0.0)


def _bare(name: str) -> Scene:
    """Return a scene without its bodies."""
    scene = load(name)
    return replace(scene, linkage=replace(scene.linkage, bodies=()))


def test_a_length_that_is_in_no_body_is_a_bar_of_its_own() -> None:
    bodies = figure(_bare("crank-rocker")).bodies
    assert {body.joints for body in bodies} == {("O2", "A"), ("A", "B"), ("O4", "B"), ("A", "B", "P")}
    assert all(body.name == "" for body in bodies)


def test_a_named_body_takes_the_place_of_its_lengths() -> None:
    assert [body.name for body in figure(load("crank-rocker")).bodies] == ["crank", "coupler", "rocker"]


def test_pins_are_where_bars_meet_and_a_coupler_point_is_none() -> None:
    shown = figure(load("crank-rocker"))
    assert set(shown.pins) == {"O2", "A", "B", "O4"}
    assert set(shown.fixed) == {"O2", "O4"}


def test_what_a_spring_or_damper_hangs_on_is_a_pin() -> None:
    shown = figure(load("press"))
    assert {"G", "S", "H", "C"} <= set(shown.pins)


def test_the_driven_crank_has_the_first_colour_wherever_it_is_named() -> None:
    for name, body in (("crank-rocker", "crank"), ("rocker-driven", "rocker"), ("press", "2")):
        assert colours_of(figure(load(name)), LIGHT)[body] == LIGHT.bodies[0]


def inverted(offset: float) -> Scene:
    pins = Pin("O2", (0.0, 0.0)), Pin("O4", (-80.0, 0.0))
    joints = (*pins, Crank("A", "O2", 30.0), RPR("P", "O4", "A", 140.0, offset))
    return Scene("inverted", "Inverted slider-crank", "", "mm", Linkage(joints, Drive("A", 1.0, 0.0)), ("P",))


@pytest.mark.parametrize("offset", [0.0, 12.0])
def test_a_slotted_bar_carries_its_slot_and_a_block_on_the_pin_in_it(offset: float) -> None:
    scene = inverted(offset)
    parts = body_parts(DrawContext(figure(scene), VIEW, GAUGE, LIGHT))
    block = parts[-1]
    assert (block.at, block.tail, block.head) == ("A", "O4", "P")
    bar = next(part for part in parts if part.joints[:2] == ("O4", "P"))
    slot = bar.layers[0].loops[1]
    # from 50 to 110 apart the pin stays inside the slot, whose middle is `offset` to the left
    ends = [(50**2 - offset**2) ** 0.5, (110**2 - offset**2) ** 0.5]
    assert slot.real.min() == pytest.approx(ends[0] - 0.5 * GAUGE.bar, abs=0.1)
    assert slot.real.max() == pytest.approx(ends[1] + 0.5 * GAUGE.bar, abs=0.1)
    assert slot.imag.mean() == pytest.approx(-offset, abs=0.5)
    # an open one: all layers have it as a hole, and the bar is as thick about it as elsewhere
    assert all(_area(layer.loops[0]) * _area(layer.loops[1]) < 0 for layer in bar.layers)
    assert abs(bar.layers[0].loops[0].imag).max() == pytest.approx(offset + 1.35 * GAUGE.bar, abs=0.1)


def _area(loop: Loop) -> float:
    """Return the area a loop encloses; negative where it turns the other way."""
    return float(np.imag(np.conj(loop) * np.roll(loop, -1)).sum() / 2)


@pytest.mark.parametrize("offset", [0.0, 9.0])
def test_a_rod_through_a_swivel_has_its_piston_in_a_cylinder_at_every_moment(offset: float) -> None:
    pins = Pin("O2", (0.0, 0.0)), Pin("O4", (-90.0, 0.0))
    joints = (*pins, Crank("A", "O2", 60.0), RPR("P", "A", "O4", 155.0, offset))
    scene = Scene("engine", "Engine", "", "mm", Linkage(joints, Drive("A", 1.0, 0.0)), ("P",))
    parts = body_parts(DrawContext(figure(scene), VIEW, GAUGE, LIGHT))
    cylinder, rod, block = parts[0], parts[-2], parts[-1]
    assert (cylinder.at, block.at) == ("O4", "O4")
    for phase in np.linspace(0, math.tau, 9):
        places = {name: complex(x, -y) for name, (x, y) in scene.pose(float(phase)).position.items()}
        axis = np.conj(places["P"] - places["A"]) / abs(places["P"] - places["A"])
        wall, piston = (
            np.concatenate(layer.loops) * axis
            for layer in (cylinder.placed(places)[0], rod.placed(places)[-1])
        )
        assert wall.real.min() < piston.real.min() < piston.real.max() < wall.real.max()
        assert wall.imag.min() < piston.imag.min() < piston.imag.max() < wall.imag.max()
        assert np.ptp(piston.imag) > 0.6 * np.ptp(wall.imag)
        # a little wider than a bar, so that a rod is seen in it
        assert 2 * GAUGE.bar < np.ptp(wall.imag) < 3 * GAUGE.bar


def test_a_rod_that_goes_on_beyond_its_swivel_has_no_cylinder() -> None:
    pins = Pin("O2", (0.0, 0.0)), Pin("O4", (-90.0, 0.0))
    rod = RPR("P", "A", "O4", 155.0)
    joints = (*pins, Crank("A", "O2", 60.0), rod, RRP("C", "P", 300.0, Line("O2", 0.0)))
    scene = Scene("pump", "Pump", "", "mm", Linkage(joints, Drive("A", 1.0, 0.0)), ("P",))
    parts = body_parts(DrawContext(figure(scene), VIEW, GAUGE, LIGHT))
    assert [part.at for part in parts].count("O4") == 1


def test_a_pin_that_keeps_its_place_on_a_bar_lies_on_it() -> None:
    trammel = figure(load("elliptic-trammel"))
    rod = next(body for body in trammel.bodies if body.name == "rod")
    assert trammel.riding(rod) == ("X",)
    parts = body_parts(DrawContext(trammel, VIEW, GAUGE, LIGHT))
    (drawn,) = (part for part in parts if part.name == "rod")
    assert "X" in drawn.joints
    assert all(
        not figure(load(name)).riding(body)
        for name in ("press", "jansen")
        for body in figure(load(name)).bodies
    )


def test_a_yoke_has_a_slot_as_long_as_its_pin_needs_and_a_collar_on_it() -> None:
    joints = (Pin("O2", (0.0, 0.0)), Crank("A", "O2", 30.0), RPP("Y", "A", Line("O2", 0.0)))
    scene = Scene("yoke", "Scotch yoke", "", "mm", Linkage(joints, Drive("A", 1.0, 0.0)), ("Y",))
    parts = body_parts(DrawContext(figure(scene), VIEW, GAUGE, LIGHT))
    assert (parts[0].at, parts[-1].at) == ("Y", "A")
    slot = parts[0].layers[-2].loops[1]
    assert slot.imag.max() == pytest.approx(30.0 * VIEW.scale + 0.5 * GAUGE.bar, abs=0.1)
    assert slot.imag.min() == pytest.approx(-30.0 * VIEW.scale - 0.5 * GAUGE.bar, abs=0.1)
    assert abs(slot.real).max() == pytest.approx(0.5 * GAUGE.bar, abs=0.1)
    assert len(figure(scene).in_view) == 3


def test_a_guide_goes_along_with_the_body_that_carries_it_and_is_in_the_picture() -> None:
    base = load("crank-rocker").linkage
    line = Line("O4", math.radians(20), 10.0, ("O4", "B"))
    joints = (*base.joints, RRP("J", "O2", 110.0, line))
    shown = figure(Scene("ram", "Ram", "", "mm", Linkage(joints, base.drive), ("J",)))
    parts = body_parts(DrawContext(shown, VIEW, GAUGE, LIGHT))
    bar, _, slot, block = (part for part in parts if part.tail == "O4")
    assert (bar.at, slot.at, block.at) == ("O4", "O4", "J")
    wide = of_linkage(shown, GAUGE).box
    for phase in (0.0, 1.0, 2.5, 4.0):
        pose = shown.scene.pose(phase)
        places = {name: complex(x, -y) for name, (x, y) in pose.position.items()}
        hole = np.concatenate(slot.placed(places)[0].loops)
        # the slot's sides run half a bar's half width beside the joint that slides in it
        across = np.exp(1j * np.angle(places["B"] - places["O4"]) - 1j * line.angle)
        assert np.imag((hole - places["J"]) / across) == pytest.approx(0.0, abs=0.51 * GAUGE.bar)
        assert wide.left <= hole.real.min() + GAUGE.bar
        assert -wide.high <= hole.imag.min() + GAUGE.bar


def test_the_swept_box_holds_the_coupler_curve() -> None:
    shown = figure(load("crank-rocker"))
    curve = shown.cycle.position["P"]
    assert shown.box.left <= curve[:, 0].min()
    assert shown.box.right >= curve[:, 0].max()
    assert shown.box.low <= curve[:, 1].min()
    assert shown.box.high >= curve[:, 1].max()
