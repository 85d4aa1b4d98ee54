"""Make the pictures of states: one fits a state, or is on its way there; lists move, old pictures fade."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pygame

from linkanim.picture.overlay import Overlay
from linkanim.picture.picture import Picture
from linkanim.picture.view import on_the_way, view_on_the_way
from linkanim.player.framing import Framed, framed, moves_of
from linkanim.player.state import State
from linkanim.ui.shown import lasting

_PICTURES = 4
"""The pictures that are kept: of a state, and of those that were left just before."""


class Framing:
    """Makes the pictures of states, which depend on these and the size alone, and keeps the last few."""

    def __init__(self, *, window: bool = False) -> None:
        self._window = window
        self._made: list[tuple[tuple[Framed, tuple[int, int]], Picture]] = []

    def fitting(self, state: State, size: tuple[int, int]) -> Picture:
        """Return the picture that fits the state, as it is when all has come to rest."""
        fit = framed(state, window=self._window)
        known = next((one for one in self._made if one[0] == (fit, size)), None)
        if known is None:
            scene, look, docked, placed, sheet, also, _ = fit
            picture = Picture(scene, size, look, placed=placed, docked=docked, sheet=sheet, also=also)
            known = (fit, size), picture
        others = [one for one in self._made if one is not known]
        self._made = [*others[1 - _PICTURES :], known]
        return known[1]

    def at(self, state: State, size: tuple[int, int]) -> Picture:
        """Return the picture of this frame: while the view moves, one on the way to the fitting picture."""
        goal = self.fitting(state, size)
        moves = moves_of(state)
        if not moves:
            return goal
        pictures = [*(self.fitting(one.left, size) for one in moves), goal]
        rests = [1.0 - one.share(state.frame) for one in moves]
        view = view_on_the_way([one.view for one in pictures], rests)
        steps = zip(pairwise(one.edge for one in pictures), rests, strict=True)
        ways = [(rest * max(x - x1, 0.0), rest * max(y - y1, 0.0)) for ((x, y), (x1, y1)), rest in steps]
        aside = sum(right for right, _ in ways), sum(down for _, down in ways)
        if view == goal.view and aside == (0.0, 0.0):
            return goal
        scene, look, docked, placed, sheet, also, _ = framed(state, window=self._window)
        return Picture(
            scene, size, look, view=view, aside=aside, placed=placed, docked=docked, sheet=sheet, also=also
        )


def drawn_in(over: Overlay, state: State) -> Overlay:
    """Return the overlay to draw: a list that opens or shuts is in part beyond the window's edge."""
    moves = moves_of(state)
    if not moves:
        return over
    listed = [float(one.listed) for one in (*(move.left for move in moves), state)]
    open_ = on_the_way(listed, [1.0 - one.share(state.frame) for one in moves])
    if state.listed or not any(listed):
        return replace(over, shut=1.0 - open_) if state.listed else over
    last = lasting(next(one.left for one in reversed(moves) if one.left.listed))
    return replace(over, listed=last.listed, shut=1.0 - open_)


# From one picture to the next: the old one fades while the new one is already there; the shutter's flash.

_WHITE = 0.7
"""The opacity of a screenshot's white flash at its brightest."""


def fading(state: State) -> tuple[State, int] | None:
    """Return the state whose picture fades, and its opacity, 0 to 255; None where none does."""
    departure = next((one for one in state.departures if one.fades), None)
    return (departure.left, round(255 * (1.0 - departure.share(state.frame)))) if departure else None


def flash(surface: pygame.Surface, eighths: int) -> None:
    """Draw the shutter's white over a picture, in eighths."""
    white = pygame.Surface(surface.get_size())
    white.fill((255, 255, 255))
    white.set_alpha(round(255 * _WHITE * (eighths / 8) ** 2))
    surface.blit(white, (0, 0))
