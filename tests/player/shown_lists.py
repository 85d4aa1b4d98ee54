"""What a state shows, of the kind that a test is about: its open list, what is drawn beside its scene."""

from __future__ import annotations

from typing import TypeVar

from linkanim.picture.drawn import Addition
from linkanim.picture.game_panel import GamePanel
from linkanim.picture.lists import Panel, Quantities
from linkanim.picture.marks import DimensionLine, Glow, MeasuredLines
from linkanim.player.state import State
from linkanim.ui.panels import panel_of
from linkanim.ui.pictures import beside

Kind = TypeVar("Kind", bound=Addition)


def values_in(state: State) -> Panel:
    """Return the list of values."""
    panel = panel_of(state)
    assert isinstance(panel, Panel)
    return panel


def words_in(state: State) -> Quantities:
    """Return the list of quantities or commands."""
    panel = panel_of(state)
    assert isinstance(panel, Quantities)
    return panel


def game_in(state: State) -> GamePanel:
    """Return what a game shows."""
    panel = panel_of(state)
    assert isinstance(panel, GamePanel)
    return panel


def drawn_in(state: State, kind: type[Kind]) -> Kind | None:
    """Return what is drawn of a kind beside the scene."""
    return next((one for one in beside(state).drawn if isinstance(one, kind)), None)


def lines_in(state: State) -> tuple[DimensionLine, ...]:
    """Return the lines of the chosen dimension and of those beside it."""
    found = drawn_in(state, MeasuredLines)
    return found.lines if found else ()


def lit_in(state: State) -> str | None:
    """Return the joint that glows."""
    found = drawn_in(state, Glow)
    return found.joint if found else None
