"""This project's solver as the others are asked: a batch, or one pose at a time."""

from __future__ import annotations

import numpy as np

from linkanim.bench.chain import Places, Question, joined

Orders = tuple[Places, ...]
"""Positions, then velocities and accelerations where a method gives them."""
QUANTITIES = ("position", "velocity", "acceleration")


def batch(question: Question) -> Orders:
    """Solve all inputs in one call, by angle where that is what is given, else by phase."""
    solve = question.scene.solve
    by_angle = question.by_angle
    motion = solve(angle=question.angles, speed=1.0) if by_angle else solve(phase=question.phases, speed=1.0)
    return tuple(
        {name: joined(getattr(motion, quantity)[name]) for name in question.shown} for quantity in QUANTITIES
    )


def single(question: Question) -> Orders:
    """Solve one pose per call in plain floats; rates where they are asked for by phase, as it gives them."""
    poses = [question.scene.pose(phase, 2) for phase in question.phases.tolist()]
    scale = question.scene.linkage.drive.speed
    return tuple(
        {
            name: np.array([complex(*getattr(pose, quantity)[name]) for pose in poses]) / scale**order
            for name in question.shown
        }
        for order, quantity in enumerate(QUANTITIES[:1] if question.by_angle else QUANTITIES)
    )
