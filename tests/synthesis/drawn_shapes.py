"""Thirty shapes as hands draw them, and a sheet of their fronts to be looked at.

`python tests/synthesis/drawn_shapes.py SHEET.png` draws each with the answer that is shown first, its curve,
and its front: longest bar to the right, deviation upwards, both in logarithms, steep transmission angles
dark.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from linkanim.synthesis.answers import Fit
from linkanim.synthesis.curves import DrawnCurve, stroke_of
from linkanim.synthesis.follower import COUNT
from linkanim.synthesis.front import front_of, knee, searched_front, with_cognates
from linkanim.synthesis.linkages import Complex
from linkanim.synthesis.path import task_of
from linkanim.synthesis.search import best_fits

if TYPE_CHECKING:
    import pygame

_TREMBLE = 0.012
"""By how much of its size a hand's line strays."""
_TURN, _WAY = np.linspace(0, 2 * math.pi, 140), np.linspace(0, 1, 90)


def _polygon(*corners: complex, closed: bool = True) -> Complex:
    sides = [*corners, corners[0]] if closed else [*corners]
    ways = [np.linspace(one, other, 24, endpoint=False) for one, other in pairwise(sides)]
    return np.concatenate([*ways, sides[-1:]])


def _arc(begin: float, end: float, radius: float = 40.0, count: int = 60) -> Complex:
    return np.asarray(radius * np.exp(1j * np.linspace(begin, end, count)))


_COS, _SIN = np.cos(_TURN), np.sin(_TURN)
_STAR = [
    (100 if n % 2 else 45) * complex(math.cos(n * math.pi / 5), math.sin(n * math.pi / 5)) for n in range(10)
]
_CLOSED: dict[str, Complex] = {
    "eight": 100 * _SIN + 50j * np.sin(2 * _TURN),
    "D": np.append(_arc(-math.pi / 2, math.pi / 2, 60, 80), [20j, -20j, -60j]),
    "foot": np.append(np.linspace(-80, 80, 60), 80 * np.cos(_TURN / 2) + 45j * np.sin(_TURN / 2)),
    "circle": 70 * np.exp(1j * _TURN),
    "ellipse": 100 * _COS + 40j * _SIN,
    "egg": 80 * _COS + (50 + 12 * _COS) * 1j * _SIN,
    "drop": 64 * (_COS + 0.4 * np.cos(2 * _TURN)) + 50j * _SIN * (1 - 0.3 * _COS),
    "bean": 90 * _COS + 1j * (45 * _SIN + 22 * np.cos(2 * _TURN)),
    "kidney": 80j * _COS + (40 * _SIN - 25 * np.cos(2 * _TURN)),
    "triangle": _polygon(0, 100, 40 + 80j),
    "square": _polygon(0, 80, 80 + 80j, 80j),
    "rectangle": _polygon(0, 140, 140 + 50j, 50j),
    "trapezium": _polygon(0, 120, 90 + 50j, 30 + 50j),
    "bow": _polygon(-80 - 40j, 80 + 40j, 80 - 40j, -80 + 40j),
    "crescent": np.append(_arc(-2, 2, 80, 90), _arc(1.7, -1.7, 65, 70) - 20),
    "up and down": _polygon(0, 120j),
    "heart": 5 * (16 * _SIN**3 + 1j * (13 * _COS - 5 * np.cos(2 * _TURN) - 2 * np.cos(3 * _TURN))),
    "star": _polygon(*_STAR),
    "L": _polygon(0, 100, 100 + 25j, 25 + 25j, 25 + 100j, 100j),
    "wing": (100 * _COS + 10 * np.cos(2 * _TURN)) * np.exp(0.4j) + 25j * np.sin(_TURN + 0.5),
    "tilted eight": (100 * _SIN + 35j * np.sin(2 * _TURN)) * np.exp(0.6j),
    "loop in a loop": 60 * np.exp(1j * _TURN) + 45 * np.exp(2j * _TURN),
}
_OPEN: dict[str, Complex] = {
    "arc": _arc(0.4, 2.6, 100),
    "S": 60 * np.sin(2 * math.pi * _WAY) + 140j * _WAY,
    "wave": 200 * _WAY + 25j * np.sin(4 * math.pi * _WAY),
    "hook": np.append(40 + 1j * np.linspace(120, 0, 60), _arc(0, -math.pi)),
    "line": 150 * _WAY * np.exp(0.3j),
    "corner": _polygon(80j, 0, 90, closed=False),
    "U": np.concatenate(
        [-40 + 1j * np.linspace(90, 0, 40), _arc(math.pi, 2 * math.pi), 40 + 90j * _WAY[::2]]
    ),
    "question mark": np.append(_arc(math.pi, -math.pi / 2) + 80j, 40j * _WAY[::-3]),
}
SHAPES = {**_CLOSED, **_OPEN}


def stroke(name: str) -> DrawnCurve:
    """Return a shape as a trembling hand draws it, the same each time."""
    line = np.asarray(SHAPES[name], np.complex128)
    random, size = (
        np.random.default_rng([*SHAPES].index(name)),
        math.hypot(*(np.ptp(line.real), np.ptp(line.imag))),
    )
    turn, tremble = np.linspace(0, 2 * math.pi, len(line)), np.zeros(len(line), np.complex128)
    for wave in (*range(1, 7), *range(-6, 0)):
        tremble += random.normal(size=2) @ [1, 1j] * np.exp(1j * wave * turn) / abs(wave)
    return stroke_of(line + _TREMBLE * size / 3 * tremble)


def front(curve: DrawnCurve) -> tuple[Fit, ...]:
    """Return the front that the window finds for a stroke."""
    task = task_of(curve.points, curve.closed)
    return with_cognates(front_of([*searched_front(task), *best_fits(task, 2 * COUNT, widely=False)]))


def main(target: str) -> None:
    """Draw all shapes with their fronts."""
    import pygame

    wide, high, columns = 320, 250, 6
    sheet = pygame.Surface((columns * wide, high * -(-len(SHAPES) // columns)))
    sheet.fill("white")
    pygame.font.init()
    font = pygame.font.Font(None, 19)
    for n, name in enumerate(SHAPES):
        curve = stroke(name)
        fits = front(curve)
        shown = fits[knee([fit.figures for fit in fits])]
        cell = sheet.subsurface((n % columns * wide, n // columns * high, wide, high))
        off, size, _, angle, _ = shown.figures
        words = f"{name}: {100 * off:.2f} %, x{size:.2f}, {math.degrees(angle):.0f} deg"
        cell.blit(font.render(words, True, "black"), (8, 6))
        _linkage(cell, curve, shown)
        _scatter(cell, fits, shown)
        print(words, flush=True)
    pygame.image.save(sheet, target)


def _linkage(cell: pygame.Surface, curve: DrawnCurve, fit: Fit) -> None:
    import pygame

    way = fit.scene.cycle(240, derivatives=0).position["P"] @ np.array([1, 1j])
    pose = fit.scene.pose(1.0, 0).position
    at = {joint: complex(*pose[joint]) for joint in ("O2", "A", "B", "O4", "P")}
    seen = np.array([*curve.polyline, *way, *at.values()])
    corner, size = complex(seen.real.min(), seen.imag.max()), max(np.ptp(seen.real), np.ptp(seen.imag))

    def pixels(places: Sequence[complex]) -> list[tuple[float, float]]:
        scaled = (np.asarray(places) - corner) * 190 / size
        return [(12 + one.real, 36 - one.imag) for one in scaled]

    pygame.draw.lines(cell, "grey60", fit.task.curve.closed, pixels(list(curve.polyline)), 5)
    pygame.draw.aalines(cell, "purple", True, pixels(list(way)))
    pygame.draw.polygon(cell, "steelblue", pixels([at["A"], at["B"], at["P"]]), 2)
    pygame.draw.lines(cell, "orangered", False, pixels([at["O2"], at["A"]]), 3)
    pygame.draw.lines(cell, "seagreen", False, pixels([at["O4"], at["B"]]), 3)


def _scatter(cell: pygame.Surface, fits: Sequence[Fit], shown: Fit) -> None:
    import pygame

    pygame.draw.rect(cell, "grey80", (215, 36, 95, 190), 1)
    worst = max(fit.figures.deviation for fit in fits)
    for fit in fits:
        right = 222 + 80 * math.log(fit.figures.size / 0.3) / math.log(8 / 0.3)
        down = 46 + 170 * min(math.log(worst / fit.figures.deviation) / math.log(100), 1)
        dark = 200 - round(200 * min(fit.figures.angle / math.radians(60), 1))
        pygame.draw.circle(cell, (dark, dark, dark), (right, down), 4)
        if fit is shown:
            pygame.draw.circle(cell, "orangered", (right, down), 7, 2)


if __name__ == "__main__":
    main(sys.argv[1])
