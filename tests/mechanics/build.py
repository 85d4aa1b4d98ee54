"""Linkages for the tests, made from plain lengths."""

from __future__ import annotations

import math
from dataclasses import replace

from linkanim.mechanics.linkage import (
    RPR,
    RRP,
    RRR,
    Body,
    Crank,
    Drive,
    Joint,
    Line,
    Linkage,
    Pin,
    Point,
    Polar,
    Rigid,
)

BARS = (Body("crank", ("O2", "A")), Body("coupler", ("A", "B")), Body("rocker", ("O4", "B")))


def four_bar(
    lengths: tuple[float, float, float, float],
    *,
    side: int = 1,
    ground_angle: float = 0.0,
    start: float = 0.0,
    coupler_point: Point | None = None,
) -> Linkage:
    """Ground, crank, coupler, rocker."""
    g, r, a, b = lengths
    o4 = (g * math.cos(ground_angle), g * math.sin(ground_angle))
    point = coupler_point or (a / 2, a / 3)
    return Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("O4", o4, Polar(g, ground_angle, "O2")),
            Crank("A", "O2", r),
            RRR("B", ("A", "O4"), (a, b), side),
            Rigid("P", ("A", "B"), point),
        ),
        Drive("A", 1.0, start),
        BARS,
    )


def rocker_driven(
    lengths: tuple[float, float, float, float], *, side: int = 1, start: float = 0.0
) -> Linkage:
    """Ground, crank, coupler, rocker, the rocker being the input; named by the side of B."""
    g, r, a, b = lengths
    return Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("O4", (g, 0.0), Polar(g, 0.0, "O2")),
            Crank("B", "O4", b),
            RRR("A", ("B", "O2"), (a, r), side, side_of=("B", "A", "O4")),
        ),
        Drive("B", 1.0, start),
        BARS,
    )


def with_joints(linkage: Linkage, *joints: Joint) -> Linkage:
    """The linkage with more joints at the end of its chain."""
    return replace(linkage, joints=(*linkage.joints, *joints))


def slider_crank(
    crank: float, rod: float, offset: float, *, side: int = 1, line_angle: float = 0.0, start: float = 0.0
) -> Linkage:
    return Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Crank("A", "O2", crank),
            RRP("B", "A", rod, Line("O2", line_angle, offset), side),
        ),
        Drive("A", 1.0, start),
        (Body("crank", ("O2", "A")), Body("rod", ("A", "B")), Body("slider", slider="B")),
    )


def slotted(
    ground: float, crank: float, length: float, offset: float = 0.0, *, start: float = 0.0
) -> Linkage:
    return Linkage(
        (
            Pin("O2", (0.0, 0.0)),
            Pin("O4", (ground, 0.0), Polar(ground, 0.0, "O2")),
            Crank("A", "O2", crank),
            RPR("P", "O4", "A", length, offset),
        ),
        Drive("A", 1.0, start),
        (Body("crank", ("O2", "A")), Body("slotted", ("O4", "P"))),
    )


def six_bar(
    first: tuple[float, float, float, float],
    second: tuple[float, float, float, float],
    *,
    side: int = 1,
    start: float = 0.0,
) -> Linkage:
    """Two four-bars in series: r1 r2 r3 r4, then r5 r6 r7 r8."""
    bar = four_bar(first, start=start)
    r5, r6, r7, r8 = second
    return Linkage(
        (
            *bar.joints[:4],
            Pin("O6", (first[0] + r5, 0.0)),
            Rigid("C", ("O4", "B"), (r6, 0.0)),
            RRR("D", ("C", "O6"), (r7, r8), side),
        ),
        bar.drive,
        (*BARS, Body("rocker2", ("O6", "D"))),
    )
