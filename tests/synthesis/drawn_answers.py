"""A sheet of the five answers to each of the thirty drawn shapes, to be looked at: would one build the first?

`python tests/synthesis/drawn_answers.py SHEET.png [exact|balanced]` draws each answer in a pose, with its
curve over the drawn one, and prints deviation, size and angle of each as a row of Markdown.
"""

from __future__ import annotations

import math
import sys
from typing import TYPE_CHECKING

import numpy as np
from drawn_shapes import SHAPES, stroke

import linkanim
from linkanim.synthesis.answers import Fit
from linkanim.synthesis.curves import DrawnCurve

if TYPE_CHECKING:
    import pygame

WIDE, HIGH, COUNT = 230, 190, 5


def words_of(fit: Fit) -> str:
    """Return deviation, size and angle as the sheet has them."""
    off, size, _, angle, _ = fit.figures
    return f"{100 * off:.2f} % ×{size:.2f} {math.degrees(angle):.0f}°"


def main(target: str, prefer: str = "balanced") -> None:
    """Draw the answers to all shapes."""
    import pygame

    half = -(-len(SHAPES) // 2)
    sheet = pygame.Surface((2 * COUNT * WIDE, half * HIGH))
    sheet.fill("white")
    pygame.font.init()
    font = pygame.font.Font(None, 18)
    for n, name in enumerate(SHAPES):
        curve = stroke(name)
        points = np.column_stack([curve.points.real, curve.points.imag])
        fits = linkanim.path(points, curve.closed, prefer=prefer)  # type: ignore[arg-type]
        most = fits[0].most_exact
        print("|", " | ".join([name, *map(words_of, [most, *fits] if most else fits)]), "|", flush=True)
        for place, fit in enumerate(fits):
            corner = ((n // half * COUNT + place) * WIDE, n % half * HIGH)
            cell = sheet.subsurface((*corner, WIDE, HIGH))
            cell.blit(font.render(f"{name if not place else ''} {words_of(fit)}", True, "black"), (4, 3))
            _linkage(cell, curve, fit)
    pygame.image.save(sheet, target)


def _linkage(cell: pygame.Surface, curve: DrawnCurve, fit: Fit) -> None:
    import pygame

    scene = fit.scene
    way = scene.cycle(240, derivatives=0).position["P"] @ np.array([1, 1j])
    pose = scene.pose(1.0, 0).position
    at = {joint: complex(*pose[joint]) for joint in ("O2", "A", "B", "O4", "P")}
    seen = np.array([*curve.polyline, *way, *at.values()])
    size = max(np.ptp(seen.real) / 220, np.ptp(seen.imag) / 162)
    corner = complex(seen.real.min(), seen.imag.max())

    def pixels(*places: complex) -> list[tuple[float, float]]:
        return [(5 + one.real, 23 - one.imag) for one in (np.asarray(places) - corner) / size]

    pygame.draw.lines(cell, "grey70", curve.closed, pixels(*curve.polyline), 4)
    pygame.draw.aalines(cell, "purple", True, pixels(*way))
    pygame.draw.polygon(cell, "steelblue", pixels(at["A"], at["B"], at["P"]), 2)
    pygame.draw.lines(cell, "orangered", False, pixels(at["O2"], at["A"]), 3)
    pygame.draw.lines(cell, "seagreen", False, pixels(at["O4"], at["B"]), 3)
    pygame.draw.lines(cell, "grey40", False, pixels(at["O2"], at["O4"]), 1)


if __name__ == "__main__":
    main(*sys.argv[1:])
