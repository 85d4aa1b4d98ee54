"""The head-up display: what scene it is, and the numbers of this instant, in words."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import pygame

from linkanim.mechanics.motion.motion import Pose
from linkanim.picture.arrangement.words import STEP, WordBlock
from linkanim.picture.items import Caption, draw
from linkanim.picture.panels.readings import Row, note, ranked, rows_of
from linkanim.picture.raster.raster import Layer, paint
from linkanim.picture.raster.shapes import box
from linkanim.picture.text.text import Type
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import Rect
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
        found = []
        for line in self.still():
            size = round(self.place.right) + 1, round(line.at[1]) + 2 * line.size
            whole = pygame.Surface(size, pygame.SRCALPHA, 32)
            draw(whole, [line], self.type)
            part = whole.get_bounding_rect()
            found.append((whole.subsurface(part).copy(), part.topleft))
        return tuple(found)

    def still(self) -> Iterator[Caption]:
        """Yield the words that stand still."""
        for line in self.block.lines:
            at, ink = (self.place.x, self.place.y + line.y), self.theme.ink if line.strong else self.theme.dim
            yield Caption(line.text, at, line.size, ink, strong=line.strong)
        for n, (_, row) in enumerate(ranked(self._rows, self.scene.pose(0.0))):
            yield Caption(row.label, (self.place.x, self._top(n)), self.block.size, self.theme.dim)

    def values(self, pose: Pose) -> list[Caption]:
        """Return the numbers of a pose beside them."""
        size, right = self.block.size, self.place.x + self.block.column
        return [
            Caption(row.value, (right, self._top(n)), size, self.theme.ink, "right", strong=True)
            for n, (_, row) in enumerate(ranked(self._rows, pose))
        ]

    @cached_property
    def _rows(self) -> tuple[Row, ...]:
        """The rows that are shown."""
        return tuple(row for row in rows_of(self.scene) if row.label in self.block.rows)

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
        surface.blits(self.sheets, doreturn=False)
        values = self.values(pose)
        draw(surface, values, self.type)
        if noted and values:
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
