"""Linkages of as many joints as one likes, for tests of how time and memory grow with them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

HEAD = 'title = "{}"\nlength_unit = "mm"\n[drive]\njoint = "A"\nspeed = "20 rpm"\n[ground]\nO = [0, 0]\n{}'
CRANK = '[joints.A]\ncrank = "O"\nlength = 30\n'
DYAD = '[joints.{}]\nfrom = ["{}", "{}"]\nlength = [{}, {}]\nside = "left"\n'


def series(dyads: int) -> str:
    """Return four-bars in series: the rocker of each is the crank of the next."""
    pins = "".join(f"G{i} = [{100 * i}, 0]\n" for i in range(1, dyads + 1))
    names = ["A", *(f"B{i}" for i in range(1, dyads + 1))]
    bars = (
        DYAD.format(names[i], names[i - 1], f"G{i}", 90 if i == 1 else 100, 80) for i in range(1, dyads + 1)
    )
    return HEAD.format("series", pins) + CRANK + "".join(bars)


def ladder(dyads: int) -> str:
    """Return a four-bar whose coupler and rocker carry a strip of triangles."""
    text = HEAD.format("ladder", "G = [100, 0]\n") + CRANK + DYAD.format("B", "A", "G", 90, 80)
    names = ["A", "B", *(f"C{i}" for i in range(dyads - 1))]
    return text + "".join(
        DYAD.format(names[i], names[i - 2], names[i - 1], 60, 60) for i in range(2, len(names))
    )


def tree(dyads: int) -> str:
    """Return four-bars around one crank."""
    angles = [2 * math.pi * i / dyads for i in range(dyads)]
    pins = "".join(f"G{i} = [{100 * math.cos(x)}, {100 * math.sin(x)}]\n" for i, x in enumerate(angles))
    bars = (DYAD.format(f"B{i}", "A", f"G{i}", 90, 80) for i in range(dyads))
    return HEAD.format("tree", pins) + CRANK + "".join(bars)


def scissors(dyads: int) -> str:
    """Return a scissor lift that a slider-crank opens and closes."""
    rod = (
        '[joints.L]\nfrom = "A"\nlength = 50\nline = { through = "O", angle = "0 deg" }\nside = "backward"\n'
    )
    text = HEAD.format("scissors", "G = [60, 0]\n") + CRANK.replace("30", "10") + rod
    left, right = "L", "G"
    for i in range(dyads):
        text += DYAD.format(f"M{i}", left, right, 70, 70)
        text += f'[joints.R{i}]\non = ["{left}", "M{i}"]\nat = [140, 0]\n'
        text += f'[joints.L{i}]\non = ["{right}", "M{i}"]\nat = [140, 0]\n'
        left, right = f"L{i}", f"R{i}"
    return text


def geared(*denominators: int) -> str:
    """Return cranks geared to one by 1/q each, the first of which makes a five-bar with it."""
    pins = "".join(f"P{i} = [{200 + 100 * i}, 0]\n" for i in range(len(denominators)))
    cranks = (
        f'[joints.D{i}]\ncrank = "P{i}"\nlength = 20\ngear = {{ with = "A", ratio = "1/{q}" }}\n'
        for i, q in enumerate(denominators)
    )
    return HEAD.format("geared", pins) + CRANK + "".join(cranks) + DYAD.format("B", "A", "D0", 190, 180)


SHAPES: Mapping[str, Callable[[int], str]] = {
    "series": series,
    "ladder": ladder,
    "tree": tree,
    "scissors": scissors,
}
