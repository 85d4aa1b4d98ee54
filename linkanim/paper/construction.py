"""The construction of a synthesis as a figure: its marks, and below it what each step does."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import pygame

from linkanim.picture.construction import box_of, construction_items, view_of
from linkanim.picture.diagrams.chart import Pen, pen_for
from linkanim.picture.items import Caption, Group, Item, grouped
from linkanim.picture.layout import layout
from linkanim.picture.look import ThemeName
from linkanim.picture.raster.offscreen import offscreen
from linkanim.picture.raster.raster import Colour
from linkanim.picture.surface import printed
from linkanim.picture.text.text import Type
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene
from linkanim.synthesis.constructions import ConstructionStep, construction

_LINE = 1.35
"""From line to line, in heights of their text."""


@dataclass(frozen=True)
class ConstructionPage:
    """The first steps of a scene's construction, all where `steps` is None, in so many pixels."""

    scene: Scene
    size: tuple[int, int] = (1280, 720)
    theme: ThemeName = "light"
    steps: int | None = None

    @cached_property
    def every(self) -> tuple[ConstructionStep, ...]:
        """All steps; BadInput where the scene was made for nothing that is known."""
        return construction(self.scene)

    @cached_property
    def pen(self) -> Pen:
        """What it is drawn with."""
        return pen_for(layout(self.size), Type(), theme_of(self.theme))

    @property
    def background(self) -> Colour:
        """The colour under everything."""
        return self.pen.theme.background

    @property
    def title(self) -> str:
        """What it shows, in words."""
        return f"{self.scene.title}: its construction"

    def surface(self) -> pygame.Surface:
        """Return the figure drawn."""
        surface = offscreen(self.size)
        surface.fill(self.background)
        printed(surface, self.groups(), self.pen.type)
        return surface

    def groups(self) -> tuple[Group, ...]:
        """Return everything on the page, words over shapes."""
        return (grouped("construction", self.items()),)

    def items(self) -> Iterator[Item]:
        """Yield everything on the page, back to front; each step stands where it stands with all of them."""
        pen = self.pen
        whole = Rect(0, 0, *self.size).inset(1.2 * pen.small)
        shown = self.every[: self.steps]
        lines = [
            line
            for n, step in enumerate(self.every, 1)
            for line in self._wrapped(f"{n}  {step.words}", whole.width)
        ]
        below = len(lines) * _LINE * pen.small
        area = Rect(whole.x, whole.y + 1.6 * pen.text, whole.width, whole.height - 1.6 * pen.text - below)
        marks = [mark for step in self.every for mark in step.marks]
        view = view_of(box_of(marks), area)
        yield from construction_items([mark for step in shown for mark in step.marks], view, area, pen)
        yield Caption(self.scene.title, (whole.x, whole.y), pen.text, pen.theme.ink, strong=True)
        said = [
            line
            for n, step in enumerate(shown, 1)
            for line in self._wrapped(f"{n}  {step.words}", whole.width)
        ]
        for n, line in enumerate(said):
            yield Caption(line, (whole.x, area.bottom + n * _LINE * pen.small), pen.small, pen.theme.ink)

    def _wrapped(self, text: str, width: float) -> list[str]:
        """Return a sentence in lines no wider than the page."""
        lines = [""]
        for word in text.split(" "):
            longer = f"{lines[-1]} {word}" if lines[-1] else word
            if lines[-1] and self.pen.type.width(longer, self.pen.small) > width:
                lines.append(f"    {word}")
            else:
                lines[-1] = longer
        return lines
