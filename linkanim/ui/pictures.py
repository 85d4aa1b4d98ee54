"""Make the pictures of states: one fits a state, or is on its way there; lists move, old pictures fade."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import pygame

from linkanim.picture.drawn import Addition, Additions
from linkanim.picture.hover import HoverArrows
from linkanim.picture.marks import Glow, MeasuredLines
from linkanim.picture.picture import Picture
from linkanim.picture.view import view_on_the_way
from linkanim.player.framing import Framed, framed, moves_of
from linkanim.player.state import SHUTTER_FRAMES, Changeover, State
from linkanim.ui.pointing import NOWHERE, AtMouse

if TYPE_CHECKING:
    from linkanim.build.draft import Photo
    from linkanim.scenes.scene import Scene

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
            picture = Picture(
                scene, size, look, placed=placed, docked=docked, sheet=sheet, also=also, noted=True
            )
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
            scene,
            size,
            look,
            view=view,
            aside=aside,
            placed=placed,
            docked=docked,
            sheet=sheet,
            also=also,
            noted=True,
        )


# What is drawn beside the scene of a state: by its modes, and where the mouse is.


def beside(state: State, mouse: AtMouse = NOWHERE) -> Additions:
    """Return what the window shows beside the scene."""
    held, pointed, marks = state.held or state.grasp, mouse.pointed, list[Addition]()
    lit = held.joint if held else mouse.joint
    if lit and lit in state.shown.linkage.by_name:
        marks.append(Glow(lit))
    if pointed and pointed.thing and pointed.thing.kind == "joint":
        marks += (
            [HoverArrows(pointed.thing.name)] if pointed.thing.name in state.shown.linkage.by_name else []
        )
    return Additions(
        (*_of_modes(state, mouse), *marks),
        state.constructed,
        swing(state),
        pointed.instant if pointed else None,
        grip=state.look.chart is not None and not state.game,
        stands=stands(state),
        photo=_photo(state),
    )


def lasting(state: State) -> Additions:
    """Return what belongs on a screenshot beside the scene: all that does not come and go."""
    drawn = tuple(one for one in _of_modes(state) if not isinstance(one, MeasuredLines))
    return Additions(drawn, state.constructed, stands=stands(state), photo=_photo(state))


def recorded(state: State, *, photo: bool = False) -> Additions:
    """Return what a recording shows beside the scene; a photograph behind a sheet only with `photo`."""
    held = state.held or state.grasp
    marks = (Glow(held.joint),) if held and held.joint in state.displayed.linkage.by_name else ()
    drawn = (*_of_modes(state, recorded=True), *marks)
    return Additions(drawn, state.constructed, swing(state), photo=_photo(state) if photo else None)


def _of_modes(state: State, mouse: AtMouse = NOWHERE, *, recorded: bool = False) -> tuple[Addition, ...]:
    return tuple(one.seen(mouse.over, recorded=recorded) for mode in state.modes for one in mode.drawn(state))


def _photo(state: State) -> Photo | None:
    sheet = state.sheet and state.building
    return sheet.building.draft.photo if sheet else None


def swing(state: State) -> tuple[Scene, float] | None:
    """Return the closure that is left, and how far, while the linkage swings over."""
    turned = state.glide if isinstance(state.glide, Changeover) else None
    return (turned.left, turned.share(state.frame)) if turned else None


def stands(state: State) -> bool:
    """Tell whether a mechanism is paused: not in a hand that drags it, in a game, or on a sheet."""
    in_hand = state.grasp and state.grasp.ran
    return state.clock.paused and not (in_hand or state.game or state.building)


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


def shutter(state: State) -> int:
    """Return how white the picture is for a screenshot's sake, in eighths."""
    return 0 if state.shot is None else max(8 - 8 * (state.frame - state.shot) // SHUTTER_FRAMES, 0)
