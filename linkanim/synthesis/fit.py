"""An answer: a linkage as a scene, and how well it follows the curve, as the solver says."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from linkanim.scenes.scene import Scene
from linkanim.synthesis.kinds import Complex, LinkageKind, Real
from linkanim.synthesis.task import FEW, PathTask


@dataclass(frozen=True, eq=False, kw_only=True)
class CouplerLinkage(ABC):
    """A four-bar or slider-crank that was made for its coupler; lengths in its unit, angles in radians."""

    scene: Scene
    parameters: Mapping[str, float]
    """Pivots x, y, x4, y4, lengths, and the coupler point along A -> B and across, to its left."""
    closure: str
    angles: Real
    """Of the crank, where the coupler is at each point or pose that it was made for, in their order."""
    transmission_angle: float
    """The least; where the input does not turn fully, along the way it was made for."""
    size: float
    """The longest link, or side of the coupler."""

    @property
    @abstractmethod
    def kind(self) -> LinkageKind:
        """What its parameters are."""

    @property
    def class_name(self) -> str:
        """The linkage's class, in words."""
        return self.scene.info.class_name

    @property
    def row(self) -> Real:
        """The parameters as a row of its kind."""
        return np.array([self.parameters[name] for name in self.kind.parameters])

    @property
    def closure_sign(self) -> float:
        """The closure as +1 or -1."""
        return 1.0 if self.closure == self.kind.sides[0] else -1.0

    @property
    def sense(self) -> float:
        """+1 where the drive runs forwards along the way, else -1; a crank's angle then grows."""
        return math.copysign(1.0, self.scene.linkage.drive.speed)


@dataclass(frozen=True, eq=False, kw_only=True)
class Fit(CouplerLinkage):
    """A linkage beside the drawn curve; distances in the curve's unit."""

    rms: float
    """Root mean square of the points' distances to the curve near where the coupler point passes them; with
    prescribed timing, to where it is then."""
    largest: float
    """The largest of those distances."""
    stray: float
    """How far the coupler point goes from the points' polyline at the most."""
    task: PathTask = field(repr=False)
    exact: Fit | None = field(default=None, repr=False)
    """The answer before its lengths were rounded."""
    cognate: bool = False
    """Whether it is a Roberts cognate of an answer before it."""

    @property
    def kind(self) -> LinkageKind:
        """What its parameters are."""
        return self.task.kind

    @cached_property
    def joints(self) -> Complex:
        """Fixed pins, and all joints where the crank is at the first and at the middle point of the curve."""
        angles = self.angles[None, [0, len(self.angles) // 2]]
        joints: Complex = self.task.kind.joints(self.row[None], np.array([self.closure_sign]), angles)[0]
        return joints

    def apart(self, other: Fit) -> float:
        """Return how far two answers' joints are apart, in curve sizes, however their parameters are told."""
        return float(np.abs(self.joints - other.joints).max() / self.task.curve.size)

    @property
    def error(self) -> float:
        """By what answers are ranked: the root mean square, and a way between the points that strays."""
        if len(self.angles) <= FEW:
            return self.rms
        return math.hypot(self.rms, max(0.0, self.stray - self.largest - self.task.curve.longest_step / 2))


def document_of(
    kind: LinkageKind, row: Iterable[float], closure: float, start: tuple[float, float], **stated: str
) -> dict[str, Any]:
    """Return a linkage as a scene's document, its crank starting at an angle, turning a way (±1).

    `stated` is its source, and its title and unit of length if these are not the usual ones.
    """
    angle, sense = start
    return {
        "title": f"{kind.name.capitalize()} along a drawn path",
        "source": "",
        "length_unit": "mm",
        **stated,
        "drive": {
            "joint": "A",
            "speed": "-20 rpm" if sense < 0 else "20 rpm",
            "start": f"{round(math.degrees(angle) % 360, 9)!r} deg",
        },
        **kind.document(parameters_of(kind, row), closure),
        "trace": {"joints": ["P"]},
    }


def parameters_of(kind: LinkageKind, row: Iterable[float]) -> dict[str, float]:
    """Return a row's parameters by name, as plain numbers."""
    return dict(zip(kind.parameters, (float(value) for value in row), strict=True))


def rounded(task: PathTask, row: Real) -> Real:
    """Return a row as it is written, to twelve digits after the curve's first: one input gives one file."""
    found = [
        round(float(value), 13 if name == "line_angle" else task.quantum) + 0.0
        for name, value in zip(task.kind.parameters, row, strict=True)
    ]
    return np.array(found)
