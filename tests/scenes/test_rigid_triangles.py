"""Three bars between three joints are one body: they cannot move against each other."""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np
import pytest

from linkanim.mechanics.linkage import holding
from linkanim.picture.dimensions import symbols
from linkanim.picture.figure import figure
from linkanim.scenes import load
from linkanim.scenes.editing import dimensions, handles, with_dimensions
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

FOUR_BAR: dict[str, Any] = {
    "ground": {"O2": [0, 0], "O4": [100, 0]},
    "joints": {
        "A": {"crank": "O2", "length": 30},
        "B": {"from": ["A", "O4"], "length": [90, 80]},
    },
}


def scene(joints: dict[str, Any], **tables: Any) -> Scene:
    document = {**FOUR_BAR, "joints": FOUR_BAR["joints"] | joints, **tables}
    return scene_from(document, name="my", where="my")


def links(of: Scene) -> int:
    """Return how many rigid bodies there are, the ground among them, and the blocks of sliders."""
    return len(of.linkage.rigid_bodies) + sum(joint.travels for joint in of.linkage.joints)


# scene, its links with the ground, and its class
@pytest.mark.parametrize(
    ("name", "count", "class_name"),
    [
        # T. Jansen's leg: m, j, k, c, f, the ground, and the two triangles bde and ghi.
        ("jansen", 8, "eight-bar: Grashof crank-rocker and 2 further dyads"),
        # Boom, stick and bucket hang together by cylinders that keep their length.
        ("excavator", 2, "crank driven by a cylinder"),
        ("crank-rocker", 4, "Grashof crank-rocker"),
        ("klann", 6, "six-bar: Grashof crank-rocker and a second dyad"),
    ],
)
def test_a_rigid_triangle_is_one_link(name: str, count: int, class_name: str) -> None:
    found = load(name)
    assert (links(found), found.info.class_name) == (count, class_name)


def test_a_rigid_triangle_has_no_transmission_angle() -> None:
    assert load("excavator").info.transmission_angle is None
    legs = load("jansen")
    assert "D.transmission_angle" not in legs.mechanism.linkage.by_name
    rigid = math.acos((55.8**2 + 40.1**2 - 41.5**2) / (2 * 55.8 * 40.1))
    assert all(abs(legs.info.transmission_angle[end] - rigid) > 0.1 for end in (0, 1))  # type: ignore[index]


# Which two joints the bars stand on, how long they are, on which side.
@pytest.mark.parametrize(
    ("ends", "lengths", "side"),
    [
        (["A", "B"], [60, 70], "left"),
        (["B", "A"], [60, 70], "left"),
        (["A", "B"], [60, 70], "right"),
        # flat: the third joint lies in the bar's own line
        (["A", "B"], [40, 50], "left"),
        (["B", "O4"], [30, 60], "right"),
    ],
)
def test_a_body_stated_by_its_three_lengths_is_accepted_as_one(
    ends: list[str], lengths: list[float], side: str
) -> None:
    body = {"plate": {"joints": [*ends, "T"]}}
    found = scene({"T": {"from": ends, "length": lengths, "side": side}}, bodies=body)
    motion = found.cycle(90)
    first, second, third = (motion.position[name] @ [1, 1j] for name in (*ends, "T"))
    assert np.abs(abs(third - first) - lengths[0]).max() <= 1e-12
    assert np.abs(abs(third - second) - lengths[1]).max() <= 1e-12
    left = ((third - first) / (second - first)).imag
    assert (left >= -1e-12).all() if side == "left" else (left <= 1e-12).all()
    assert found.info.class_name == "Grashof crank-rocker"
    reference = scene({"P": {"on": ends, "at": at(ends, lengths, side)}}).cycle(90)
    for kind in ("position", "velocity", "acceleration"):
        mine, theirs = (getattr(of, kind)[name] for of, name in ((motion, "T"), (reference, "P")))
        assert np.abs(mine - theirs).max() <= 1e-12 * np.abs(theirs).max()


def at(ends: list[str], lengths: list[float], side: str) -> list[float]:
    base = {"A": {"B": 90.0}, "B": {"A": 90.0, "O4": 80.0}}[ends[0]][ends[1]]
    a, b = lengths
    along = (base**2 + a**2 - b**2) / (2 * base)
    return [along, math.sqrt(max(a**2 - along**2, 0.0)) * (1 if side == "left" else -1)]


def test_what_stands_on_a_triangle_is_on_its_body() -> None:
    braces = {
        "T": {"from": ["A", "B"], "length": [60, 70]},
        "U": {"from": ["T", "B"], "length": [50, 40]},
    }
    found = scene(braces, bodies={"plate": {"joints": ["A", "U", "T", "B"]}})
    assert holding(found.linkage.rigid_bodies, ("A", "B", "T", "U")) is not None
    assert len(found.linkage.rigid_bodies) == 4


def test_a_triangles_lengths_are_edited_and_dragged_as_before() -> None:
    found = scene({"T": {"from": ["A", "B"], "length": [60, 70]}})
    keys = [item.key for item in dimensions(found) if item.key[1] == "T"]
    assert keys == [("joints", "T", "length", 0), ("joints", "T", "length", 1)]
    assert {handle.key for handle in handles(found, "T")} == set(keys)
    longer = with_dimensions(found, {keys[0]: 65})
    a, t = (complex(*longer.pose(0.3).position[name]) for name in ("A", "T"))
    assert abs(t - a) == pytest.approx(65, rel=1e-14)


def test_three_bars_of_a_triangle_are_drawn_as_one_plate() -> None:
    bodies = figure(load("jansen")).bodies
    plates = sorted(body.joints for body in bodies if len(body.joints) > 2)
    assert plates == [("C", "E", "F"), ("O4", "B", "D")]
    assert len(bodies) == 7  # and no bar of theirs beside them


def test_a_link_of_three_bars_is_named_and_numbered_once() -> None:
    found = figure(load("jansen"))
    assert list(found.links.values()) == ["m", "j", "k", "b-d-e", "c", "f", "g-h-i"]
    measured = sorted(one.value for one in symbols(found).dimensions if not one.angle)
    assert measured[:2] == pytest.approx([15, 36.7])
    assert measured[3:] == pytest.approx([39.3, 39.4, 40.1, 41.5, 49, 50, 55.8, 61.9, 65.7])


def test_each_bar_of_a_triangle_keeps_its_own_angle() -> None:
    motion = load("jansen").solve(phase=1.0)
    place = {name: complex(*motion.position[name]) for name in ("O4", "B", "D")}
    for name, start, end in (("b", "O4", "B"), ("d", "O4", "D"), ("e", "B", "D")):
        assert motion.angle[name] == pytest.approx(cmath.phase(place[end] - place[start]), abs=1e-12)
        assert motion.angular_velocity[name] == motion.angular_velocity["b"]


def test_the_telling_quantities_name_a_body_once() -> None:
    rates = [token for token in load("jansen").telling if token.endswith("angular_velocity")]
    assert not {"d.angular_velocity", "e.angular_velocity"} & set(rates) or "b.angular_velocity" not in rates
