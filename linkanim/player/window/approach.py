"""The way from one view of a scene to another: eased, so that the eye can follow what makes room for what."""

from __future__ import annotations

from dataclasses import dataclass, replace

from linkanim.picture.look import Look
from linkanim.picture.view import View, eased

APPROACH_FRAMES = 14


@dataclass(frozen=True)
class Approach:
    """A view that was left at a frame for the one that fits now."""

    left: View
    since: int

    def over(self, frame: int) -> bool:
        """Whether the new view is reached."""
        return frame >= self.since + APPROACH_FRAMES

    def look(self, look: Look, fitted: View, goal: View, size: tuple[int, int], frame: int) -> Look:
        """Return the look whose zoom and pan show the view of this frame, between the left one and `goal`.

        `fitted` is the view that the look zooms and pans, in a window of that size in pixels.
        """
        view = between(self.left, goal, (frame - self.since + 1) / (APPROACH_FRAMES + 1))
        width, height = size
        zoom = view.scale / fitted.scale
        right = view.x - width / 2 - (fitted.x - width / 2) * zoom
        down = view.y - height / 2 - (fitted.y - height / 2) * zoom
        return replace(look, zoom=zoom, pan=(right / height, down / height))


def between(one: View, other: View, share: float) -> View:
    """Return the view so far from one to the other, slow at both ends; every point moves straight."""
    part = eased(share)
    scale, x, y = (
        begin + (end - begin) * part
        for begin, end in ((one.scale, other.scale), (one.x, other.x), (one.y, other.y))
    )
    return View(scale, x, y)
