"""Rigid bodies: which joints keep their distances, and where they lie in the body's own frame."""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce

from linkanim.mechanics.linkage.joint import Frame, Joint

_ONE_POINT = 1e-12


def frames_of(joints: Iterable[Joint]) -> tuple[Frame, ...]:
    """Return the sets of joints that keep their distances, the ground first; joints in solved order.

    Each maps its joints to their places: x along its first bar, y to the left. Every bar starts a frame
    of its own, in the order of the joints and of each joint's `bars`.
    """
    ground: tuple[Frame, ...] = ({},)
    return reduce(lambda frames, joint: joint.placed(frames), joints, ground)


def holding(frames: Iterable[Frame], names: Iterable[str]) -> int | None:
    """Return which frame has all these joints; None where they are on different bodies."""
    wanted = set(names)
    return next((n for n, frame in enumerate(frames) if wanted <= frame.keys()), None)


def coincide(frame: Frame, first: str, second: str) -> bool:
    """Tell whether two joints of a body are one point, so that no direction runs from one to the other."""
    size = max(abs(frame[first]), abs(frame[second]))
    return abs(frame[first] - frame[second]) <= _ONE_POINT * size


def share_of(frame: Frame, on: tuple[str, str], at: tuple[float, float]) -> complex:
    """Return the point `at` along on[0] -> on[1] and to its left, in lengths of that line."""
    return complex(*at) / abs(frame[on[1]] - frame[on[0]])
