"""Zoom and pan: what part of the scene the window frames."""

from __future__ import annotations

import math
from dataclasses import replace

from linkanim.picture.look import Look

_NOTCH = 1.25
_NOTCHES = (-8, 16)
_PLACES = 9


def zoomed(look: Look, notches: float, about: tuple[float, float]) -> Look:
    """Return the look so many notches nearer, the point `about` staying where it is.

    `about` is in window heights from the middle of the picture, right and down. So many notches
    out again give the same look, unless the end of the range was met.
    """
    before = math.log(look.zoom, _NOTCH)
    low, high = _NOTCHES
    zoom = _NOTCH ** min(max(round(before + notches), low), high)
    ratio = zoom / look.zoom
    pan = tuple(point - (point - shift) * ratio for point, shift in zip(about, look.pan, strict=True))
    return replace(look, zoom=zoom, pan=_rounded(pan[0], pan[1]))


def panned(look: Look, by: tuple[float, float]) -> Look:
    """Return the look shifted by so many window heights, right and down."""
    return replace(look, pan=_rounded(look.pan[0] + by[0], look.pan[1] + by[1]))


def _rounded(x: float, y: float) -> tuple[float, float]:
    """Round far below a pixel, so that a way there and back ends on the same picture."""
    return round(x, _PLACES) + 0.0, round(y, _PLACES) + 0.0
