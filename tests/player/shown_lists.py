"""The list that an overlay shows, of the kind that a test is about."""

from __future__ import annotations

from linkanim.picture.game_panel import GamePanel
from linkanim.picture.lists import Panel, Quantities
from linkanim.picture.overlay import Overlay


def values_in(over: Overlay) -> Panel:
    """Return the list of values."""
    assert isinstance(over.listed, Panel)
    return over.listed


def words_in(over: Overlay) -> Quantities:
    """Return the list of quantities or commands."""
    assert isinstance(over.listed, Quantities)
    return over.listed


def game_in(over: Overlay) -> GamePanel:
    """Return what a game shows."""
    assert isinstance(over.listed, GamePanel)
    return over.listed
