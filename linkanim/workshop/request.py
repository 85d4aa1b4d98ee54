"""`linkanim.make`: a request with its sizes and its scale; then the parts, as a value or as files."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from dataclasses import replace
from itertools import combinations
from typing import NamedTuple

import numpy as np

from linkanim.errors import BadInput
from linkanim.scenes.scene import Scene
from linkanim.units import shown
from linkanim.workshop.gears import NotFlat
from linkanim.workshop.layers import MOST_WORK, Budget
from linkanim.workshop.made import SLENDER, MadeLinkage, laid, true_scale
from linkanim.workshop.media import PAGES, WAYS, Size, Way
from linkanim.workshop.nesting import FOOT, MARGIN
from linkanim.workshop.parts import Sizes, kit
from linkanim.workshop.shapes import sides
from linkanim.workshop.sweep import GROUND, Cycle

_SHEETS: dict[str, Size] = {"laser": (600.0, 400.0), "print": (math.inf, math.inf), "cardboard": PAGES["A4"]}
"""The usual sheet for each way of making, in mm; the bed of a printer is unknown."""
_USUAL = {"cardboard": (1.5, 0.0), "laser": (3.0, 0.2), "print": (4.0, 0.4)}
"""The usual thickness and clearance for each way of making, in mm."""
_GAP = 0.5
_HOLED, _WIDEST_HOLE = 0.4, 6.0
"""A usual hole's share of its bar's width, and the widest usual hole, in mm."""
_SMALLEST, _LARGEST = 1e-3, 1e5
"""The range of all lengths that are asked for, in mm."""
_STEPS = 12


def make(
    scene: Scene,
    output: str | os.PathLike[str] | None = None,
    *,
    way: str = "cardboard",
    bar: float | None = None,
    hole: float | None = None,
    thickness: float | None = None,
    clearance: float | None = None,
    gap: float = _GAP,
    kerf: float = 0.0,
    sheet: str | Size | None = None,
    fit: str | None = None,
    bridge: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> MadeLinkage:
    """Return a scene as flat parts with holes, pins and layers; with an `output`, write them into a folder.

    `way` is "cardboard" (a PDF to print), "laser" (SVG and DXF) or "print" (STL). Lengths are in mm: the
    width of a `bar`, a `hole`'s diameter, the material's `thickness`; by how much a hole is wider than its
    pin (`clearance`), the least distance of parts that pass in a layer (`gap`), the width of a cut (`kerf`);
    the width and height of a `sheet`, or a page, "A4" or "Letter". Parts are in true size, or scaled so that
    each `fit`s a page. With a `bridge`, fixed pins may hang from a plate above. If the linkage cannot be made
    flat, `refused` says why; with an `output` that is BadInput. BadInput also for sizes that make no sense,
    and `WorkFailed` if the disk or the folder refuses.
    """
    if way not in WAYS:
        raise BadInput(f"way={shown(way)}: take {', '.join(WAYS)}")
    if fit is not None and fit not in PAGES:
        raise BadInput(f"fit={shown(fit)}: take {' or '.join(PAGES)}")
    asked = _Asked(way, bar, hole, thickness, clearance, gap, kerf)
    asked.check()
    size = _sheet(sheet, fit, asked.way)
    made = MadeLinkage(scene, asked.way, Sizes(true_scale(scene)), kerf, size)
    try:
        scale = _fitting(scene, asked, PAGES[fit]) if fit else true_scale(scene)
        made = laid(
            replace(made, sizes=asked.sizes(scene, scale)), Budget(MOST_WORK, progress), bridge=bridge
        )
    except NotFlat as why:
        made = replace(made, refused=f"{scene.name} cannot be made of flat parts: {why}")
    if output is not None:
        # Imported here, since a request for layers alone needs no pictures.
        from linkanim.workshop.files import write

        write(made, output)
    return made


class _Asked(NamedTuple):
    """The lengths that were asked for, in mm; None for the usual one."""

    way: Way
    bar: float | None
    hole: float | None
    thickness: float | None
    clearance: float | None
    gap: float
    kerf: float

    def check(self) -> None:
        """Raise BadInput for a size that is not a length."""
        for name, value in self._asdict().items():
            least = 0.0 if name in ("clearance", "gap", "kerf") else _SMALLEST
            if isinstance(value, int | float) and not least <= value <= _LARGEST:
                raise BadInput(f"{name}={value:g}: give a length in mm from {least:g} to {_LARGEST:g}")

    def sizes(self, scene: Scene, scale: float) -> Sizes:
        """Return the sizes asked for, and usual ones for the rest: slender bars, holes that lie apart."""
        spans = [
            scale * abs(one - other)
            for frame in scene.linkage.rigid_bodies[1:]
            for one, other in combinations(frame.values(), 2)
            if abs(one - other) > _SMALLEST * scene.linkage.longest
        ]
        longest, shortest = max(spans, default=100.0), min(spans, default=100.0)
        if not _SMALLEST < shortest <= longest < _LARGEST:
            raise BadInput(
                f"{scene.name} has parts of {shortest:.3g} to {longest:.3g} mm, which nobody can make; scale "
                "it to a page (--fit A4)"
            )
        usual = _rounded(min(longest / SLENDER, 0.9 * shortest))
        bar = self.bar or max(usual, (self.hole or 0.0) / _HOLED)
        hole = self.hole or min(_rounded(_HOLED * bar), max(_WIDEST_HOLE, _rounded(bar / 10)))
        if hole >= bar:
            raise BadInput(
                f"a hole of {hole:g} mm is no narrower than its bar of {bar:g} mm; make it narrower "
                "(--hole), or the bar wider (--bar)"
            )
        thickness, loose = _USUAL[self.way]
        clearance = min(loose, hole / 10) if self.clearance is None else self.clearance
        for name, value in (("clearance", clearance), ("kerf", self.kerf)):
            if value >= hole:
                raise BadInput(
                    f"a {name} of {value:g} mm leaves nothing of a hole of {hole:g} mm; make it smaller "
                    f"(--{name})"
                )
        return Sizes(scale, bar, hole, self.gap, clearance, self.thickness or thickness)


def _sheet(sheet: str | Size | None, fit: str | None, way: Way) -> Size:
    """Return the width and height of a sheet, or of a page, in mm."""
    if isinstance(sheet, str):
        if sheet not in PAGES:
            raise BadInput(
                f"sheet={shown(sheet)}: take {' or '.join(PAGES)}, or a size in mm such as 600x400"
            )
        return PAGES[sheet]
    least = 2 * MARGIN + FOOT
    if sheet is not None and not all(least < side <= _LARGEST for side in sheet):
        raise BadInput(
            f"a sheet of {sheet[0]:g} x {sheet[1]:g} mm: give sides above {least:g} mm, such as 600x400"
        )
    return sheet or (PAGES[fit] if fit and way == "cardboard" else _SHEETS[way])


def _rounded(length: float) -> float:
    """Return a length in two digits, not above it."""
    step = 10.0 ** (math.floor(math.log10(length)) - 1)
    return float(f"{math.floor(length / step + 1e-9) * step:.2g}")


def _fitting(scene: Scene, asked: _Asked, page: Size) -> float:
    """Return the largest scale at which each part fits a page, in mm per unit of length."""
    wide, high = page
    room, true = (high - 2 * MARGIN - FOOT, wide - 2 * MARGIN), true_scale(scene)

    def growth(ratio: float) -> float:
        """Return the factor by which the tightest part could grow and still fit."""
        plates = kit(Cycle(scene, ratio * true), asked.sizes(scene, ratio * true)).plates
        sizes = (sides(plate.outline()) for plate in plates)
        return min(most / size for both in sizes for size, most in zip(both, room, strict=True))

    cycle = Cycle(scene, true)
    places = np.concatenate([cycle.seen(joint.name, GROUND) for joint in scene.linkage.joints])
    ratio = room[0] / max(float(np.ptp(places.real)), float(np.ptp(places.imag)))
    # A part's size has a term that scales and one that does not, so that each step comes nearer.
    for _ in range(_STEPS):
        more = growth(ratio)
        ratio *= more
        if asked.bar and ratio * true * scene.linkage.longest < asked.bar:
            raise BadInput(
                f"for {scene.name} to fit the page its bars would be shorter than {asked.bar:g} mm, their "
                "width; make them narrower (--bar)"
            )
        if abs(more - 1) < 0.01:
            break
    ratio = _rounded(ratio)
    while growth(ratio) < 1:
        ratio = _rounded(0.99 * ratio)
    return ratio * true
