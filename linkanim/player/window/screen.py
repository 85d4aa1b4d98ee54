"""The window's picture: the one that fits the scene, size and look of the moment, and what was shown last."""

from __future__ import annotations

from dataclasses import replace
from math import ceil, hypot, log10
from typing import Literal

import pygame

from linkanim.build.draft import Draft, Thing
from linkanim.build.pointing import under
from linkanim.picture.answer_row import RowPrinter, row_cells
from linkanim.picture.building.tools import ToolPrinter, tool_at
from linkanim.picture.layout import layout
from linkanim.picture.panels.overlay import Overlay
from linkanim.picture.panels.path import grid_step, pencil
from linkanim.picture.picture import Picture
from linkanim.picture.shelf import Grid, ShelfPrinter, grid
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.theme import theme_of
from linkanim.picture.view import Rect
from linkanim.player.state.action import Action
from linkanim.player.state.browsing import Browsing
from linkanim.player.state.sheet import BuildSheet, driven_bar
from linkanim.player.state.sketch import PIVOTS
from linkanim.player.state.state import State
from linkanim.player.state.tools import TOOLS
from linkanim.player.window import display
from linkanim.player.window.approach import Framing
from linkanim.player.window.fade import Fade
from linkanim.player.window.sheet import Hover
from linkanim.player.window.show import shelf_of
from linkanim.scenes.editing.handles import handles

_NEAR = 0.022
"""How near to a thing counts as on it, in the window's height."""
_PULLED = 6.0
"""How near to a line of the grid counts as on it, in units."""
_VISIBLE = 1.0
"""The least of a step of what is drawn, in pixels."""


class Screen:
    """Paints states into the window; a picture that is there already is not painted again.

    For the mouse it knows where things are in the picture that it painted last, of `state` with `over` on it.
    """

    def __init__(self, state: State) -> None:
        self._framing = Framing(captioned=True)
        self._shown: object = None
        self.state = state
        self._titled: str | None = None
        self._shelf = ShelfPrinter()
        self._fade = Fade()
        self._printer = SurfacePrinter()
        self.over = Overlay()
        self._row, self._tools = RowPrinter(), ToolPrinter()
        self._pointer: object = None

    def show(self, state: State, over: Overlay, *, late: bool = False) -> None:
        """Paint the state into the window and flip, where it differs from what is there.

        Where it is `late`, the linkage follows, and what stands still and the list are as they were.
        """
        surface = display.surface()
        if late and over.panel and self.over.panel:
            over = replace(over, panel=self.over.panel)
        self.state, self.over = state, over
        self._point(state)
        self._name(f"{state.scene.title}{' • edited' * (state.place in state.edited)}")
        picture = self._framing.at(state, surface.get_size(), late=late)
        veiled = self._fade.strength(state, surface)
        shown = (picture, picture.late, state.phase, state.clock.speed, over, veiled)
        if shown != self._shown:
            self._paint(surface, picture, state, over)
            self._fade.draw(surface, veiled, over.shutter)
            pygame.display.flip()
            self._shown = shown

    def _paint(self, surface: pygame.Surface, picture: Picture, state: State, over: Overlay) -> None:
        if over.shelf:
            self._shelf.draw(surface, over.shelf)
        else:
            self._shelf.close()
            self._printer.print(surface, picture, state.phase, state.clock.speed, over)
            self._row.draw(surface, picture.layout, over.row)
            self._tools.draw(surface, picture.layout, picture.theme, over.build.tools if over.build else None)

    def _point(self, state: State) -> None:
        """Let the mouse point with a pencil while that is taken."""
        pointer = (state.look.theme, self.size) if state.mode == "pencil" else None
        if pointer != self._pointer:
            self._pointer = pointer
            drawn = pencil(layout(self.size), theme_of(state.look.theme)) if pointer else None
            display.point_with(drawn)

    def _name(self, title: str) -> None:
        """Let the window bear the scene's title; the system is told only what is new to it."""
        if title != self._titled:
            display.name(title)
            self._titled = title

    def uncovered(self) -> None:
        """Take note that the window has to be painted anew."""
        self._shown = None

    def picture(self, state: State, over: Overlay) -> pygame.Surface:
        """Return the state painted on a surface of its own, as large as the window."""
        surface, self.state = display.surface().copy(), state
        self._paint(surface, self._framing.fitting(state, surface.get_size()), state, over)
        return surface

    @property
    def size(self) -> tuple[int, int]:
        """The window's size."""
        return pygame.display.get_window_size()

    def crank_pin(self) -> tuple[float, float]:
        """Return where the input crank's pin is, in pixels."""
        return self._framing.last.crank_pin_px(self.state.displayed.pose(self.state.phase, 0))

    def handle_at(self, x: float, y: float, reach: float) -> str | None:
        """Return the joint under a pixel that can be dragged, in the list or in a game; None elsewhere."""
        if not (self.state.editing.open or self.over.handles):
            return None
        scene, free = self.state.displayed, self.over.handles
        places = scene.pose(self.state.phase, 0).position.items()
        away = {name: max(map(abs, self._from(place, x, y))) for name, place in places}
        near = sorted((far, name) for name, far in away.items() if far <= reach)
        found = (name for _, name in near if name in free or (not free and handles(scene, name)))
        return next(found, None)

    def _from(self, place: tuple[float, float], x: float, y: float) -> tuple[float, float]:
        px, py = self.pixel(*place)
        return px - x, py - y

    def answer_cells(self) -> tuple[Rect, ...]:
        """Return where the pictures of the answers are, in pixels."""
        count = len(self.state.sketch.answers) if self.state.sketch else 0
        return row_cells(self._framing.last.layout, count)

    def pencil_at(self, x: float, y: float, reach: float) -> Action:
        """Return what the pencil begins at a pixel: it takes an answer, a pin or a point, or it draws."""
        sketch = self.state.sketch
        assert sketch
        place = next((n for n, cell in enumerate(self.answer_cells()) if cell.holds(x, y)), None)
        if place is not None:
            return Action("answer", place)
        pose = self.state.displayed.pose(self.state.phase, 0)
        pivots = [name for name in PIVOTS if name in pose.position] if sketch.follows else []
        for pivot in pivots:
            if max(map(abs, self._from(pose.position[pivot], x, y))) <= reach:
                return Action("take_pivot", pivot)
        points = sketch.curve.points if sketch.curve and not sketch.is_blank else ()
        away = [hypot(*self._from((point.real, point.imag), x, y)) for point in points]
        if away and min(away) <= reach:
            return Action("take_point", away.index(min(away)))
        return Action("pen_down", self.world(x, y))

    def sheet_at(self, x: float, y: float) -> Literal["hand", "crank", "paper"]:
        """Return what the hand does at a pixel of a sheet: it draws, turns the crank, shifts the paper."""
        sheet = self.state.building
        assert sheet
        near, *_ = self._under(x, y)
        if sheet.tool == "photo":
            return "hand"
        if near is None:
            return "paper" if sheet.tool in ("bar", "move") else "hand"
        moves = sheet.building.made.scene is not None and sheet.tool in ("bar", "move")
        return "crank" if moves and near == driven_bar(sheet.building.draft) else "hand"

    def _under(self, x: float, y: float) -> tuple[Thing | None, Draft]:
        """Return what of a draft is under a pixel, and the draft as it is seen."""
        sheet = self.state.building
        assert sheet
        seen = sheet.seen(self.state.scene, self.state.phase)
        return under(seen, *self.world(x, y), self._near), seen

    @property
    def _near(self) -> float:
        """How near counts as on a thing, in the sheet's unit."""
        return _NEAR * self.size[1] / self._framing.last.view.scale

    def tool_at(self, x: float, y: float) -> int | None:
        """Return the number of the tool of the sheet under a pixel; None beside them."""
        return tool_at(self._framing.last.layout, len(TOOLS), x, y)

    def handed(self, x: float, y: float, part: float) -> tuple[float, float, float, float]:
        """Return a place of the sheet, how near counts as on it, and the usual step times a part.

        On paper a place near a line of the grid is on it, but for parts of the step.
        """
        place = self.world(x, y)
        if part == 1.0 and self._under(x, y)[0] is None:
            place = self._gridded(*place)
        return (*place, self._near, part * self.sheet_step)

    def hover(self, x: float, y: float) -> Hover:
        """Return what of the sheet is under a pixel."""
        return Hover(self.world(x, y), self._near, self.tool_at(x, y))

    def aimed(self, sheet: BuildSheet, way: tuple[float, ...]) -> tuple[float, float]:
        """Return where the keys' cursor goes, one line of the grid on; a fine way is one step.

        Without one it begins in the middle of what is seen.
        """
        step = self.sheet_step if len(way) > 2 else self.grid_step
        middle = self.world(self.size[0] / 2, self.size[1] / 2)
        begin = sheet.cursor or middle
        by = way[:2] if sheet.cursor else (0.0, 0.0)
        x, y = (round(at / step + part) * step for at, part in zip(begin, by, strict=True))
        return x, y

    def _gridded(self, x: float, y: float) -> tuple[float, float]:
        """Return a place with each coordinate that is near to a line of the grid on that."""
        view = self._framing.last.view
        step, near = self.grid_step, _PULLED * self._framing.last.layout.unit / view.scale
        lines = (round(at / step) * step for at in (x, y))
        x, y = (line if abs(line - at) <= near else at for at, line in zip((x, y), lines, strict=True))
        return x, y

    @property
    def grid_step(self) -> float:
        """From line to line of the sheet's grid, in its unit."""
        return grid_step(self._framing.last.view, self._framing.last.layout)

    @property
    def sheet_step(self) -> float:
        """The usual step of what is drawn: a power of ten of its unit that can be seen."""
        return 10.0 ** ceil(log10(_VISIBLE / self._framing.last.view.scale))

    def world(self, x: float, y: float) -> tuple[float, float]:
        """Return the point of the scene under a pixel."""
        return self._framing.last.view.to_world(x, y)

    def pixel(self, x: float, y: float) -> tuple[float, float]:
        """Return where a point of the scene is in the window."""
        return self._framing.last.view.to_pixel(x, y)

    def shelf_grid(self, browsing: Browsing) -> Grid:
        """Return where the mechanisms of a shelf stand; it need not be painted yet."""
        return grid(self.size, shelf_of(self.state, browsing))

    def shelf_at(self, x: float, y: float) -> int | None:
        """Return the place on the open shelf under a pixel; None between its pictures."""
        assert self.state.browsing is not None
        return self.shelf_grid(self.state.browsing).at(x, y)

    def row_at(self, x: float, y: float) -> int | None:
        """Return the row of the open list under a pixel, -1 on the list beside them; None off it."""
        return self._printer.row_at(self._framing.last, self.over, x, y) if self.state.listed else None

    def option_at(self, x: float, y: float) -> int | None:
        """Return the answer of a game under a pixel, in its panel or on the picture; None off them."""
        reach = 1.6 * self._framing.last.layout.text_size
        away = {n: hypot(*self._from(spot.at, x, y)) for n, spot in enumerate(self.over.spots)}
        near = min(away, key=lambda n: away[n], default=None)
        if near is not None and away[near] <= reach:
            return near
        row = self.row_at(x, y)
        return None if row is None or row < 0 else row

    def charted(self, x: float, y: float) -> float | None:
        """Return the phase under a pixel of the chart; None beside it."""
        return self._framing.last.chart_phase_at(x, y)
