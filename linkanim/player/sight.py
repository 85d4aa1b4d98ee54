"""What is where in the picture that was drawn last, for whoever acts on a place of it."""

from __future__ import annotations

from math import ceil, log10

from linkanim.mechanics.linkage import Point
from linkanim.picture.build_sheet import grid_step
from linkanim.picture.drawn import Over
from linkanim.picture.items import Target
from linkanim.picture.picture import Picture
from linkanim.picture.poses import NEAR
from linkanim.picture.view import Rect
from linkanim.player.browsing import Browsing
from linkanim.player.state import (
    State,
)
from linkanim.scenes.editing import handles

_PULLED = 6.0
"""How near to a line of the grid counts as on it, in units."""
_VISIBLE = 1.0
"""The least step of a drawing on a sheet, in pixels."""


class Sight:
    """What was drawn last: the `state` in a picture, and what can be clicked."""

    last: Picture
    """The picture that was painted last."""

    def __init__(self, state: State) -> None:
        self.state = state
        self._targets: tuple[Target, ...] = ()

    @property
    def size(self) -> tuple[int, int]:
        """The window's size."""
        return self.last.size

    def world(self, x: float, y: float) -> tuple[float, float]:
        """Return the point of the scene under a pixel."""
        return self.last.view.to_world(x, y)

    def pixel(self, x: float, y: float) -> tuple[float, float]:
        """Return where a point of the scene is in the window."""
        return self.last.view.to_pixel(x, y)

    def away(self, place: tuple[float, float], x: float, y: float) -> tuple[float, float]:
        """Return how far a place of the scene is from a pixel, right and down."""
        px, py = self.pixel(*place)
        return px - x, py - y

    def targets(self, kind: str) -> list[Target]:
        """Return the places of a kind that can be clicked, as they were drawn, the topmost last."""
        return [one for one in self._targets if one.kind == kind]

    def target_at(self, kind: str, x: float, y: float) -> Target | None:
        """Return the topmost place of a kind at a pixel; None where there is none."""
        return next((one for one in reversed(self.targets(kind)) if one.place.holds(x, y)), None)

    def number_at(self, kind: str, x: float, y: float) -> int | None:
        """Return the number of the tool, the answer or the row of a kind under a pixel; None elsewhere."""
        target = self.target_at(kind, x, y)
        return target.value if target else None

    def row_at(self, x: float, y: float) -> int | None:
        """Return the row of the open list under a pixel, -1 on the list beside them; None off it."""
        row = self.target_at("row", x, y)
        return row.value if row else -1 if self.target_at("list", x, y) else None

    def on_box(self, x: float) -> bool:
        """Tell whether a pixel is in the column of the open list's boxes, where its rows have boxes."""
        return any(one.kind == "boxes" and x < one.place.right for one in self._targets)

    def scrolled_to(self, x: float, y: float, *, held: bool) -> int | None:
        """Return the row to which the list's scroll bar leads at a pixel; None beside the bar."""
        track = next((one for one in self._targets if one.kind == "track"), None)
        if track is None or not (held or track.place.holds(x, y)):
            return None
        share = min(max((y - track.place.y) / track.place.height, 0.0), 1.0)
        row: int = round(share * (track.value - 1))
        return row

    def dialled(self, x: float) -> float:
        """Return how far along the rail of the dial a pixel's column is, 0 to 1."""
        return next((_share(one.value, x) for one in self.targets("dial")), 0.0)

    def slid(self, x: float) -> int:
        """Return the step of the slider at a pixel's column."""
        rail, steps = next((one.value for one in self.targets("slider")), (Rect(0, 0, 0, 0), 0))
        return round(steps * _share(rail, x))

    @property
    def shelf(self) -> Browsing | None:
        """The shelf, while it is open."""
        return shelf_of(self.state)

    def charted(self, x: float, y: float) -> float | None:
        """Return the phase under a pixel of the chart; None off it."""
        chart = self.target_at("chart", x, y)
        return chart.value.phase_at(x) if chart else None

    def option_at(self, x: float, y: float) -> int | None:
        """Return the answer of a game under a pixel, in its panel or on the picture; None off them."""
        spots = (one for one in self.targets("spot") if one.place.holds(x, y))
        near = min(spots, key=lambda one: abs(one.place.middle - complex(x, y)), default=None)
        if near:
            return int(near.value)
        row = self.row_at(x, y)
        return None if row is None or row < 0 else row

    def handle_at(self, x: float, y: float, reach: float) -> str | None:
        """Return the joint under a pixel that can be dragged; None elsewhere.

        While the list is open, such a joint has dimensions of its own; in a game it is one that the game
        allows; else it is any joint that moves.
        """
        state, free = self.state, self.state.top.draggable if self.state.top else ()
        scene = state.displayed
        leads = state.leads
        if not (state.edits_dimensions or free or leads):
            return None
        places = scene.pose(self.state.phase, 0).position.items()
        away = {name: max(map(abs, self.away(place, x, y))) for name, place in places}
        near = sorted((far, name) for name, far in away.items() if far <= reach)

        def can_be_dragged(name: str) -> bool:
            if free:
                return name in free
            return scene.point_path(name).moves if leads else bool(handles(scene, name))

        return next((name for _, name in near if can_be_dragged(name)), None)

    @property
    def near(self) -> float:
        """How near counts as on a thing, in the sheet's unit."""
        return NEAR * self.size[1] / self.last.view.scale

    def handed(
        self, x: float, y: float, part: float, *, on_grid: bool = False
    ) -> tuple[float, float, float, float]:
        """Return a pixel's place on the sheet, how near counts as on a thing, and `part` of the usual step.

        With `on_grid` a place near a line of the grid is moved onto it, unless `part` asks for a finer step.
        """
        place = self.world(x, y)
        place = self._gridded(*place) if on_grid and part == 1.0 else place
        return (*place, self.near, part * self.sheet_step)

    def on_sheet(self, x: float, y: float) -> Over | None:
        """Return the place of the sheet under a pixel, and how near is on a thing; None on a tool."""
        return None if self.target_at("tool", x, y) else (self.world(x, y), self.near)

    def aimed(self, cursor: Point | None, way: tuple[float, ...]) -> tuple[float, float]:
        """Return where the keys' cursor goes: to the next line of the grid, or one step on a fine way.

        Without a cursor it begins in the middle of the visible part.
        """
        step = self.sheet_step if len(way) > 2 else self.grid_step
        middle = self.world(self.size[0] / 2, self.size[1] / 2)
        begin = cursor or middle
        by = way[:2] if cursor else (0.0, 0.0)
        x, y = (round(at / step + part) * step for at, part in zip(begin, by, strict=True))
        return x, y

    def _gridded(self, x: float, y: float) -> tuple[float, float]:
        """Return a place with each coordinate moved to the grid's line that is near, if one is."""
        view = self.last.view
        step, near = self.grid_step, _PULLED * self.last.layout.unit / view.scale
        lines = (round(at / step) * step for at in (x, y))
        x, y = (line if abs(line - at) <= near else at for at, line in zip((x, y), lines, strict=True))
        return x, y

    @property
    def grid_step(self) -> float:
        """The distance between lines of the sheet's grid, in its unit."""
        return grid_step(self.last.view, self.last.layout)

    @property
    def sheet_step(self) -> float:
        """The usual step of a drawing: the least power of ten of its unit that is visible."""
        return 10.0 ** ceil(log10(_VISIBLE / self.last.view.scale))


def _share(rail: Rect, x: float) -> float:
    """Return how far along a knob's rail a pixel's column is, 0 to 1."""
    return min(max((x - rail.x) / max(rail.width, 1.0), 0.0), 1.0)


def shelf_of(state: State) -> Browsing | None:
    """Return the open shelf; None where none is open."""
    return next((one for one in state.modes if isinstance(one, Browsing)), None)
