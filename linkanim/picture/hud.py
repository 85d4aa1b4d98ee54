"""The head-up display: what scene it is, and the numbers of this instant, in words."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import pygame

from linkanim.mechanics.motion import Pose
from linkanim.picture.raster import Layer, paint
from linkanim.picture.readings import note, rows
from linkanim.picture.shapes import box
from linkanim.picture.text import Type
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import Rect
from linkanim.picture.words import STEP, WordBlock
from linkanim.scenes.scene import Scene

_BACKING = 0.82
"""How little of what lies under the words shows through their backing."""


@dataclass(frozen=True)
class Hud:
    """The words about a scene where they stand: what keeps still is drawn once, values at every frame."""

    scene: Scene
    block: WordBlock
    place: Rect
    type: Type
    theme: Theme

    @cached_property
    def sheets(self) -> tuple[tuple[pygame.Surface, tuple[int, int]], ...]:
        """What stands still and where: title, class and the names of the rows, each line on its own."""
        theme, left, top = self.theme, self.place.x, self.place.y
        labels = [row.label for row in rows(self.scene, self.scene.pose(0.0)) if row.label in self.block.rows]
        lines = [
            (line.text, top + line.y, line.size, theme.ink if line.strong else theme.dim, line.strong)
            for line in self.block.lines
        ]
        lines += [(label, self._top(n), self.block.size, theme.dim, False) for n, label in enumerate(labels)]
        found = []
        for text, y, size, colour, strong in lines:
            whole = pygame.Surface((round(self.place.right) + 1, round(y) + 2 * size), pygame.SRCALPHA, 32)
            self.type.draw(whole, text, (left, y), size=size, colour=colour, strong=strong)
            part = whole.get_bounding_rect()
            found.append((whole.subsurface(part).copy(), part.topleft))
        return tuple(found)

    @cached_property
    def backing(self) -> pygame.Surface:
        """What lets the words be read where something lies under them."""
        room = self.place.inset(-0.5 * self.block.size)
        sheet = pygame.Surface((round(room.width), round(room.height)), pygame.SRCALPHA, 32)
        middle = complex(sheet.get_width() / 2, sheet.get_height() / 2)
        plate = middle + box(sheet.get_width(), sheet.get_height(), 0.5 * self.block.size)
        paint(sheet, [Layer(self.theme.background, [plate], _BACKING)])
        return sheet

    def draw(self, surface: pygame.Surface, pose: Pose, *, noted: bool, backed: bool) -> None:
        """Draw the words about a pose, and where it is to be `noted`, what is special there.

        They are `backed` where something may lie under them.
        """
        if backed:
            inset = 0.5 * self.block.size
            surface.blit(self.backing, (round(self.place.x - inset), round(self.place.y - inset)))
        surface.fblits(self.sheets)
        size, right = self.block.size, self.place.x + self.block.column
        shown = [row for row in rows(self.scene, pose) if row.label in self.block.rows]
        for n, row in enumerate(shown):
            at, ink = (right, self._top(n)), self.theme.ink
            self.type.draw(surface, row.value, at, size=size, colour=ink, anchor="right", strong=True)
        if noted and shown:
            self._note(surface, pose)

    def _note(self, surface: pygame.Surface, pose: Pose) -> None:
        words, eighths = note(self.scene, pose)
        size, colour = self.block.size, mixed(self.theme.background, self.theme.dim, eighths / 8)
        lines = self.type.wrapped(words, size, self.block.column) if eighths else []
        for n, line in enumerate(lines):
            at = (self.place.x, self.place.y + self.block.note + 1.2 * size * n)
            self.type.draw(surface, line, at, size=size, colour=colour)

    def _top(self, row: int) -> float:
        return self.place.y + self.block.first + STEP * self.block.size * row
