"""The vector loops on paper: their equations hold for what is solved, and their figure has every vector."""

from __future__ import annotations

import math
import re
from xml.etree import ElementTree

import pytest

from linkanim.mechanics.facts.register import indexed, link_labels
from linkanim.paper.loops import Loops
from linkanim.scenes import load, names

PRESS = ["R₂ + R₃ = R₁ + R₇ + R₆", "R₂ + R₃ + R₄ = S₅"]
UNKNOWN = [("θ₃", "θ₆"), ("θ₄", "s₅")]
_TERM = re.compile(r"(\S+) (cos|sin) \(?(\S+?)(?: ([+−]) (\S+?)°)?\)?(?: [+=]|$)")


def test_the_press_s_loops_are_those_of_its_report() -> None:
    equations = list(Loops(load("press"), 1.0).equations())
    assert [one.vectors for one in equations] == PRESS
    assert [one.unknowns for one in equations] == UNKNOWN
    assert equations[0].components[0] == "r₂ cos θ₂ + r₃ cos θ₃ = r₁ cos (−107.5°) + r₇ cos θ₇ + r₆ cos θ₆"


@pytest.mark.parametrize("name", ["press", "crank-rocker", "slider-crank", "jansen", "six-bar"])
def test_the_components_hold_with_the_solved_angles(name: str) -> None:
    scene = load(name)
    loops = Loops(scene, 1.0)
    pose, labels = scene.pose(1.0), link_labels(scene.linkage)
    lengths = {loops.symbol(one, "r"): ((one.end - one.begin) / one.along).real for one in loops.vectors}
    angles = {indexed("θ", labels[body]): angle for body, angle in pose.angle.items()}

    def value(side: str) -> float:
        total = 0.0
        for length, work, angle, sign, lean in _TERM.findall(side):
            turned = angles.get(angle)
            if turned is None:
                turned = math.radians(float(angle.rstrip("°)").replace("−", "-")))
            turned += math.radians(float(lean or 0)) * (-1 if sign == "−" else 1)
            total += lengths[length] * getattr(math, work)(turned)
        return total

    for one in loops.equations():
        for line in one.components:
            left, right = line.split(" = ")
            assert value(left) == pytest.approx(value(right), abs=2e-3 * max(map(abs, lengths.values())))


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_each_unknown_is_found_once_and_the_figure_names_every_vector(name: str) -> None:
    loops = Loops(load(name), 0.7)
    found = [unknown for one in loops.equations() for unknown in one.unknowns]
    assert len(found) == len(set(found))
    if loops.loops:
        assert all(len(one.unknowns) <= 2 for one in loops.equations())
        root = ElementTree.fromstring(loops.document((440, 420)))
        shown = {"".join(text.itertext()) for text in root.iter() if text.tag.endswith("text")}
        assert len(shown) >= len({loops.symbol(one, "R") for one in loops.vectors}) - 2
