"""What a frame of a recording says: each line of text, what it is of, and where it stands."""

from __future__ import annotations

from typing import NamedTuple

from linkanim.picture.items import Caption
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene


class Labelled(NamedTuple):
    """A line of text in a frame: what it is `of`, its box in pixels, and the pixel of what it names.

    `of` is "joint:A", "body:coupler", "vector:v_A", "dimension:r2", "angle:θ2", "dead-centre:1",
    "centre:P_13", or the kind of words: "readout", "legend", "axis", "caption". Words that name no joint have
    the middle of their box as their anchor.
    """

    of: str
    text: str
    box: Rect
    anchor: tuple[float, float]
    opacity: float


def labelled(scene: Scene, phase: float, look: Look, size: tuple[int, int]) -> list[Labelled]:
    """Return all lines of text in the frame of a recording at a phase (rad), `size` in pixels.

    BadInput where the look's chart is no quantity of the scene.
    """
    picture = Picture(scene, size, look)
    return lines_of(picture, phase)


def lines_of(picture: Picture, phase: float) -> list[Labelled]:
    """Return all lines of text that a picture shows at a phase."""
    pose, _ = picture.poses(phase)
    places = picture.drawing.places(pose)
    lines = []
    for group in picture.groups(pose):
        for line in group.named:
            box = _box(line, picture)
            kind, _, name = line.of.partition(":")
            middle = box.middle
            if kind == "joint":
                middle = places[name]
            lines.append(Labelled(line.of, line.text, box, (middle.real, middle.imag), 1.0))
    return lines


def _box(line: Caption, picture: Picture) -> Rect:
    """Return the box of a line's letters."""
    return line.around(picture.type)
