"""The bar of tools: each tool under the pointer where it is drawn, and its name beside it."""

from __future__ import annotations

import pytest
from pictures import pixels

from linkanim.build.tools import TOOLS
from linkanim.picture.board import Board
from linkanim.picture.layout import Layout, layout, tool_cells
from linkanim.picture.raster import offscreen
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.ui.tools import tool_bar, tooltip


def _tooltip(window: Layout, pointed: int) -> Rect:
    """Return what of a window changes where a tool is pointed at."""
    painted = []
    for one in (None, pointed):
        surface = offscreen(window.size)
        surface.fill(LIGHT.background)
        board = Board(window, Type(), LIGHT)
        for sheet, at in [tool_bar(board, 0), *([tooltip(board, (one, False))] if one is not None else [])]:
            surface.blit(sheet, at)
        painted.append(pixels(surface))
    down, across = (painted[0] != painted[1]).any(axis=2).nonzero()
    x, y = float(across.min()), float(down.min())
    return Rect(x, y, across.max() + 1.0 - x, down.max() + 1.0 - y)


@pytest.mark.parametrize("size", [(640, 360), (320, 180), (360, 640), (400, 800)])
@pytest.mark.parametrize("pointed", [0, len(TOOLS) // 2, len(TOOLS) - 1])
def test_the_name_of_a_tool_stands_beside_its_bar_or_above_it_where_the_window_is_upright(
    size: tuple[int, int], pointed: int
) -> None:
    window = layout(size)
    cell = tool_cells(window)[pointed]
    told = _tooltip(window, pointed)
    assert 0 <= told.x < told.right <= size[0]
    assert 0 <= told.y < told.bottom <= size[1]
    if size[0] > size[1]:
        assert cell.right < told.x < cell.right + cell.width
        assert told.y < cell.middle.imag < told.bottom
    else:
        assert cell.y - cell.height < told.bottom < cell.y
        assert told.x < cell.middle.real < told.right
