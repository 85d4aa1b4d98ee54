"""The ways of making parts, and the sizes of paper; this module loads nothing."""

from __future__ import annotations

from typing import Literal, get_args

Way = Literal["cardboard", "laser", "print"]
WAYS: tuple[Way, ...] = get_args(Way)
Size = tuple[float, float]
"""Width and height, in mm."""
PAGES: dict[str, Size] = {"A4": (210.0, 297.0), "Letter": (215.9, 279.4)}
"""Sizes of paper."""
