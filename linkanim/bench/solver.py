"""This project's solver as the others are asked: a batch, one pose at a time, a batch of 32-bit floats."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from linkanim.bench.question import Points, Question, joined
from linkanim.mechanics.request import Variant
from linkanim.scenes.scene import Scene


def batch(question: Question) -> Points:
    """Solve all inputs in one call, by angle where that is what is given, else by phase."""
    given = {"angle": question.angles} if question.by_angle else {"phase": question.phases}
    position = question.scene.solve(**given, derivatives=0).position
    return Points(joined(position["B"]), joined(position["P"]))


def single(question: Question) -> Points:
    """Solve one pose per call in plain floats."""
    scene = question.scene
    poses = [scene.pose(phase, 0).position for phase in question.phases.tolist()]
    return Points(*(np.array([complex(*pose[name]) for pose in poses]) for name in ("B", "P")))


def float32(question: Question) -> Points:
    """Solve all inputs in one call, in 32-bit floats throughout."""
    rows = batch_float32(question.scene, question.phases.astype(np.float32))
    return Points(*(rows[row].astype(np.float64) + 1j * rows[row + 1] for row in (2, 4)))


def batch_float32(scene: Scene, phases: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return rows x, y of A, B and P."""
    program, _ = scene.mechanism.programs(Variant(by_phase=True, accelerates=False)).of(("position",))
    rows: NDArray[np.float32] = program(phases, 1.0, dtype=np.float32)
    return rows
