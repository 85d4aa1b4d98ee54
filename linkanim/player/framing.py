"""What the picture of a state is fitted to, and the states that were left for it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

from linkanim.picture.layout import Docked
from linkanim.picture.look import Look
from linkanim.picture.view import Box
from linkanim.player.state import MOVE_FRAMES, Departure, Glide, Sketch, State
from linkanim.scenes.scene import Scene

# What a state's picture is fitted to. Where that changes, the state that is left is kept for a while.


class Framed(NamedTuple):
    """What the places in a picture depend on, besides its size.

    While a scene changes, all stands where it does for the scene `placed`.
    """

    scene: Scene
    look: Look
    docked: Docked
    placed: Scene | None
    sheet: Box | None
    also: tuple[complex, ...]
    language: str | None = None

    @property
    def of_view(self) -> tuple[object, ...]:
        """What its view before zoom and pan depends on."""
        scene = self.placed or self.scene.goal or self.scene
        look = replace(self.look, theme="light", zoom=1.0, pan=(0.0, 0.0))
        return None if self.sheet else scene, look, self.docked, self.sheet, self.also


def framed(state: State, *, window: bool = True) -> Framed:
    """Return what the picture of a state is fitted to; only in a `window` are there tools beside a list."""
    sketch, sheet = state.sketch, state.building
    kept = _fitted_to(sketch) if sketch else None
    tools = window and state.top is not None and state.top.has_tools and state.listed
    head = state.constructed > 0 or any(one.has_head for one in state.modes)
    row = kept is not None and bool(kept.answers)
    docked = Docked(2 if tools else int(state.listed), row, window, head and not state.listed)
    return Framed(
        state.shown,
        _look(state),
        docked,
        _before_change(state),
        sheet.home if sheet else state.home,
        _included(state, kept),
        state.language,
    )


def _fitted_to(sketch: Sketch) -> Sketch | None:
    """Return the sketch to which the view is fitted: while something is drawn or held, the one before."""
    shown = sketch.earlier if sketch.held is not None else sketch.at_rest
    while shown is not None and shown.at_rest.is_blank:
        shown = shown.earlier
    return shown


def _before_change(state: State) -> Scene | None:
    """Return the scene as it was when it began to change, in a hand or gliding; None where it does not."""
    if isinstance(state.glide, Glide):
        return state.glide.placed
    if state.held:
        return state.held.scene
    if state.sketch and state.sketch.held is not None:
        return state.sketch.base
    sheet = state.building
    return sheet.lasting.made.scene if sheet and sheet.grip else None


def _look(state: State) -> Look:
    """Return the look of a state."""
    look = state.look
    for mode in state.modes:
        look = mode.look(look)
    return replace(look, hud=False, centres=0) if state.constructed else look


def _included(state: State, sketch: Sketch | None) -> tuple[complex, ...]:
    """Return places of the scene that the picture includes: what was drawn, what a construction has found."""
    if sketch:
        x, y = sketch.points.real, sketch.points.imag
        return complex(float(x.min()), float(y.min())), complex(float(x.max()), float(y.max()))
    if state.constructed and state.clock.paused:
        from linkanim.picture.constructed import points_up_to

        return points_up_to(state.shown, state.constructed, state.phase)
    return state.also


def departed(before: State, state: State) -> State:
    """Return the state with what it leaves of the state of the frame before, and of earlier ones.

    Another linkage, zoom or sheet is there at once.
    """
    departures = tuple(one for one in state.departures if not one.is_over(state.frame))
    fades, was, now = state.faded == state.frame, framed(before), framed(state)
    if was == now and not (fades or state.departures):
        return state
    if not _is_seen_as_one(before, state):
        departures = tuple(one for one in departures if one.fades)
    elif was.of_view != now.of_view or before.listed != state.listed:
        glides = state.glide if state.glide and state.glide.since == state.frame else None
        frames = glides.frames if glides else MOVE_FRAMES
        departures = (*departures, Departure(_bare(before), since=state.frame, frames=frames))
    if fades:
        departures = tuple(one for one in departures if not one.fades)
        departures = (*departures, Departure(_bare(before, moves_of(before)), True, since=state.frame))
    departures = () if state.reduced_motion else departures
    return state if departures == state.departures else replace(state, departures=departures)


def _bare(state: State, moves: Iterable[Departure] = ()) -> State:
    """Return a state without those that it leaves itself, but some."""
    return replace(state, departures=tuple(moves), effects=())


def _is_seen_as_one(before: State, state: State) -> bool:
    """Return whether the eye follows one linkage, of either closure, or one sketch, at one zoom and pan."""
    one, other = before.look, state.look
    if (one.zoom, one.pan, before.home) != (other.zoom, other.pan, state.home):
        return False
    if (before.building is None) != (state.building is None) or (state.sketch and not before.sketch):
        return False
    named = before.scene.name == state.scene.name
    same = before.scene is state.scene or (
        named and before.displayed.length_unit == state.displayed.length_unit
    )
    return same or state.sketch is not None


def moves_of(state: State) -> list[Departure]:
    """Return the states from which views and lists move on."""
    return [one for one in state.departures if not one.fades]
