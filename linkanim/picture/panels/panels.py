"""What lies over the picture: the help, the edit list, a toast, the marks of pause and recording."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property, partial
from itertools import product
from math import ceil
from typing import Any

import numpy as np
import pygame

from linkanim.picture.layout import Layout
from linkanim.picture.panels.board import Board
from linkanim.picture.panels.chips import chip, hint_bar, put
from linkanim.picture.panels.edit_list import edit_list, edit_rows
from linkanim.picture.panels.game_panel import answer_rows, game_panel
from linkanim.picture.panels.help_sheet import help_sheet
from linkanim.picture.panels.overlay import GamePanel, Overlay, Panel, Quantities
from linkanim.picture.panels.quantity_list import quantity_list, quantity_rows
from linkanim.picture.raster.raster import Colour, Layer, Loop, paint
from linkanim.picture.raster.shapes import box, disc, stroke
from linkanim.picture.text.text import Type
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect

_VEIL = 170
_LITTLE = 0.12
"""A sentence that takes more of the stage's height is shown on nothing that is drawn, or not at all."""
_BACKING = 0.7
"""How little of what lies under a mark shows through its backing."""


@dataclass
class Panels:
    """Draws overlays; the last panel of each kind is kept, so that an open one costs one blit."""

    layout: Layout
    type: Type
    theme: Theme
    _kept: dict[str, tuple[Any, Any]] = field(default_factory=dict)

    @cached_property
    def board(self) -> Board:
        """What the panels are drawn on."""
        return Board(self.layout, self.type, self.theme)

    def draw(self, surface: pygame.Surface, overlay: Overlay) -> None:
        """Draw what an overlay holds: the help over a game or beside the edit list, a toast at the foot."""
        self._marks(surface, overlay)
        if overlay.game:
            drawn = self._game(overlay.game)
            surface.blit(drawn, self._listed(drawn))
        if overlay.help:
            surface.blit(self._keep("veil", None, self._veil), (0, 0))
        left = 0
        if overlay.panel:
            drawn = self._edit_list(overlay.panel)
            surface.blit(drawn, self._listed(drawn))
            left = self.board.margin + drawn.get_width() if self._listed(drawn)[1] <= self.board.margin else 0
        if overlay.quantities:
            drawn = self._quantities(overlay.quantities)
            surface.blit(drawn, self._listed(drawn))
        if overlay.help:
            room = self.layout.size[0] - left
            drawn = self._keep("help", (overlay.help, room), partial(help_sheet, self.board))
            at = (left + (room - drawn.get_width()) // 2, (self.layout.size[1] - drawn.get_height()) // 2)
            surface.blit(drawn, at)
        self._passing(surface, overlay)
        if overlay.toast:
            drawn, at = self._keep("toast", overlay.toast, self._toast)
            surface.blit(drawn, at)

    def row_at(self, overlay: Overlay, x: float, y: float) -> int | None:
        """Return the row of the open list under a pixel, -1 on the list beside them; None off it."""
        if overlay.game:
            drawn, rows = self._game(overlay.game), self._keep("answers", overlay.game, self._answers)
            left, top = self._listed(drawn)
            inside = left <= x < left + drawn.get_width()
            return next((n for n, (high, low) in enumerate(rows) if inside and high <= y - top < low), None)
        if overlay.panel:
            drawn, rows = self._edit_list(overlay.panel), edit_rows(self.board, overlay.panel)
        elif overlay.quantities:
            drawn, rows = self._quantities(overlay.quantities), quantity_rows(self.board, overlay.quantities)
        else:
            return None
        left, top = self._listed(drawn)
        if not Rect(left, top, *drawn.get_size()).holds(x, y):
            return None
        found = rows.at(y - top)
        return -1 if found is None else found

    def _game(self, panel: GamePanel) -> pygame.Surface:
        return self._keep("game", panel, partial(game_panel, self.board))  # type: ignore[no-any-return]

    def _answers(self, panel: GamePanel) -> tuple[tuple[float, float], ...]:
        return answer_rows(self.board, panel)

    def _edit_list(self, panel: Panel) -> pygame.Surface:
        return self._keep("panel", panel, partial(edit_list, self.board))  # type: ignore[no-any-return]

    def _quantities(self, shown: Quantities) -> pygame.Surface:
        return self._keep("quantities", shown, partial(quantity_list, self.board))  # type: ignore[no-any-return]

    def _listed(self, drawn: pygame.Surface) -> tuple[int, int]:
        """Return where a list stands: at the top of its place, or at the window's foot."""
        place, margin = self.layout.lists, self.board.margin
        foot = self.layout.size[1] - margin - drawn.get_height()
        return round(place.x), max(foot, margin) if place.y > margin else margin

    def _passing(self, surface: pygame.Surface, overlay: Overlay) -> None:
        """Draw the chip below the marks, and the hint bar at the bottom, where the HUD is not."""
        room, place = self.layout.stage, self.layout.marks
        if overlay.chip:
            drawn = self._keep("chip", overlay.chip.text, partial(chip, self.board))
            marks = 1.5 * self.layout.text_size * (bool(overlay.recording) + overlay.paused)
            left = place.x if self._marks_lead else place.right - drawn.get_width()
            beside = left, place.y + marks
            free = self._off_words(drawn, [beside, *self._edges(drawn)])
            put(surface, drawn, free or beside, overlay.chip)
        if overlay.watch:
            drawn, at = self._keep("watch", overlay.watch.text, self._sentence)
            if at:
                put(surface, drawn, at, overlay.watch)
        if overlay.hint:
            words = self._keep("hint", overlay.hint.text, partial(hint_bar, self.board))
            at = self.layout.hint or room
            if words:
                leads = at.x + at.width / 2 <= room.x + room.width / 2
                left = at.x if leads else at.right - words.get_width()
                put(surface, words, (left, at.bottom - words.get_height()), overlay.hint)

    def _sentence(self, text: str) -> tuple[pygame.Surface, tuple[float, float] | None]:
        """Return what to watch for on a sheet where nothing is drawn, or off the words; None for nowhere."""
        small, free, stage = self.layout.small_size, self.layout.passing, self.layout.stage
        sheet = self._lines(text, small, (free or stage).width + 1, self.theme.dim)
        if free or sheet.get_height() > _LITTLE * stage.height:
            return sheet, (free.x, free.y) if free else None
        return sheet, self._off_words(sheet, self._edges(sheet))

    @property
    def _marks_lead(self) -> bool:
        """Whether the marks stand at the left of the scene's room."""
        place, stage = self.layout.marks, self.layout.stage
        return place.x - stage.x < stage.right - place.right

    def _off_words(
        self, drawn: pygame.Surface, places: Iterable[tuple[float, float]]
    ) -> tuple[float, float] | None:
        """Return the first of some places at which a sheet lies on no word about the scene; else None."""
        layout, size = self.layout, drawn.get_size()
        busy = (*layout.words, *([layout.legend] if layout.legend else []))
        return next((at for at in places if not any(Rect(*at, *size).meets(one) for one in busy)), None)

    def _edges(self, drawn: pygame.Surface) -> Iterator[tuple[float, float]]:
        """Yield places of a sheet along the foot and the head of the scene's room."""
        room = self.layout.stage.inset(self.board.margin)
        for low, right in product((1, 0), (0.5, 1, 0)):
            yield (
                room.x + right * (room.width - drawn.get_width()),
                room.y + low * (room.height - drawn.get_height()),
            )

    def _keep(self, kind: str, value: Any, make: Any) -> Any:
        if kind not in self._kept or self._kept[kind][0] != value:
            self._kept[kind] = (value, make(value))
        return self._kept[kind][1]

    def _veil(self, _: None) -> pygame.Surface:
        """Return what lets the picture recede behind the help."""
        veil = pygame.Surface(self.layout.size, pygame.SRCALPHA, 32)
        veil.fill((*self.theme.background, _VEIL))
        return veil

    def _marks(self, surface: pygame.Surface, overlay: Overlay) -> None:
        """Draw the marks of recording and pause, words and signs."""
        size, place = self.layout.text_size, self.layout.marks
        leads, top = self._marks_lead, place.y
        marks = [(overlay.recording, self.theme.warning, _dot)]
        marks.append(("paused" if overlay.paused else None, self.theme.ink, _bars))
        marks.append((overlay.path.off if overlay.path else None, self.theme.ink, _wave))
        for words, colour, sign in marks:
            if words:
                sheet = self._keep(f"mark {sign.__name__}", (words, colour), partial(self._mark, sign))
                left = place.x - 0.2 * size if leads else place.right - sheet.get_width() + 0.2 * size
                surface.blit(sheet, (round(left), round(top)))
                top += 1.5 * size

    def _mark(self, sign: Callable[[float], list[Loop]], mark: tuple[str, Colour]) -> pygame.Surface:
        """Return a sign and words on their backing."""
        (words, colour), size = mark, self.layout.text_size
        wide, high = self.type.width(words, size) + 1.6 * size, 1.15 * size
        sheet = pygame.Surface((ceil(wide), ceil(high)), pygame.SRCALPHA, 32)
        back = complex(wide / 2, high / 2) + box(wide, high, 0.4 * size)
        at = complex(0.6 * size, 0.5 * size)
        shapes = [
            Layer(self.theme.background, [back], _BACKING),
            Layer(colour, [at + loop for loop in sign(size)]),
        ]
        paint(sheet, shapes)
        self.type.draw(sheet, words, (1.4 * size, 0), size=size, colour=colour)
        return sheet

    def _toast(self, text: str) -> tuple[pygame.Surface, tuple[float, float]]:
        """Return a toast and its place: where nothing is drawn, else off the words about the scene."""
        small, hint = self.layout.small_size, self.layout.hint
        if hint and self.type.width(text, small) + 2 * small <= hint.width:
            sheet = self._lines(text, small, hint.width)
            return sheet, (hint.x + (hint.width - sheet.get_width()) / 2, hint.bottom - sheet.get_height())
        sheets = [
            self._lines(text, size, share * self.layout.stage.width)
            for size, share in ((self.layout.text_size, 0.9), (small, 0.9), (small, 0.6), (small, 0.4))
        ]
        found = ((sheet, self._off_words(sheet, self._edges(sheet))) for sheet in sheets)
        free = next(((sheet, at) for sheet, at in found if at), None)
        return free or (sheets[0], next(self._edges(sheets[0])))

    def _lines(self, text: str, size: int, room: float, colour: Colour | None = None) -> pygame.Surface:
        """Return words on a sheet, in lines no wider than some room, in ink unless a colour is given."""
        lines = self.type.wrapped(text, size, room - 2 * size)
        wide = max((self.type.width(line, size) for line in lines), default=0)
        sheet = self.board.sheet(wide + 2 * size, (1.25 * len(lines) + 0.75) * size)
        for n, line in enumerate(lines):
            at = (sheet.get_width() / 2, (0.5 + 1.25 * n) * size)
            self.board.write(sheet, line, at, size=size, colour=colour, anchor="centre")
        return sheet


def _dot(size: float) -> list[Loop]:
    return [0.36 * size * disc(1.0)]


def _wave(size: float) -> list[Loop]:
    way = np.linspace(-0.42, 0.42, 16)
    return stroke(size * (way - 0.24j * np.sin(7.5 * way)), 0.16 * size)


def _bars(size: float) -> list[Loop]:
    bar = box(0.22 * size, 0.72 * size)
    return [np.asarray(bar + side * 0.22 * size) for side in (-1, 1)]
