"""Fit a picture to a state, and go from one picture to the next.

The view moves smoothly to another one; another picture fades in.
"""

from __future__ import annotations

from dataclasses import replace

import pygame

from linkanim.frozen import frozen
from linkanim.picture.layout import Docked
from linkanim.picture.look import Look
from linkanim.picture.overlay import NOTHING_OVER, Overlay
from linkanim.picture.picture import Picture
from linkanim.picture.view import View, eased
from linkanim.player.state import FADE_FRAMES, SWING_FRAMES, Changeover, State

# The pictures of states: each fits what is shown, and the view moves smoothly from one to the next.
#
# So the eye can follow what makes room for what. Window and recordings share this.

APPROACH_FRAMES = 14


@frozen
class Approach:
    """The view that is being left for another one, and the frame at which the change began.

    `edge` is that of the picture being left: charts come in from there.
    """

    left: View
    since: int
    edge: tuple[float, float] = (0.0, 0.0)
    frames: int = APPROACH_FRAMES

    def over(self, frame: int) -> bool:
        """Return whether the new view is reached."""
        return frame >= self.since + self.frames

    def view(self, goal: View, frame: int) -> View:
        """Return this frame's view, between the old one and `goal`."""
        return between(self.left, goal, self._share(frame))

    def aside(self, edge: tuple[float, float], frame: int) -> tuple[float, float]:
        """Return how far charts are from their slots, whose linkage ends at an `edge`: right, and down."""
        rest = 1.0 - eased(self._share(frame))
        right, down = (max(before - now, 0.0) * rest for before, now in zip(self.edge, edge, strict=True))
        return right, down

    def _share(self, frame: int) -> float:
        """Return the share of the way that is over, in time."""
        return (frame - self.since + 1) / (self.frames + 1)


def between(one: View, other: View, share: float) -> View:
    """Return the view at a share of the way between two, slow at both ends; points move straight."""
    part = eased(share)
    scale, x, y = (
        begin + (end - begin) * part
        for begin, end in ((one.scale, other.scale), (one.x, other.x), (one.y, other.y))
    )
    return View(scale, x, y)


class Framing:
    """Makes the picture of each state that comes, from the last one; a list in a window takes its room.

    Only in a `window` are there tools beside a list.
    """

    def __init__(self, *, window: bool = False) -> None:
        self._window = window
        self._fitting: Picture | None = None
        self._passing: Picture | None = None
        self._approach: Approach | None = None

    @property
    def last(self) -> Picture:
        """The picture that was returned last; there must be one."""
        picture = self._passing or self._fitting
        assert picture is not None
        return picture

    def fitting(self, state: State, size: tuple[int, int]) -> Picture:
        """Return the picture that fits the state; begin to move to it where its view is another one."""
        before, sketch, look = self._fitting, state.sketch, self._look(state)
        held = bool(state.held or (sketch and sketch.held is not None) or state.building or state.home)
        docked, sheet = self._docked(state), state.building.home if state.building else state.home
        stays = before is not None and before.size == size
        home, also = None, _included(state)
        if sketch and before and stays and (sketch.is_blank or held):
            home, also = before.fitted, before.also
        if before and before.fits(state.shown, size, look, docked, held=held, sheet=sheet, also=also):
            return before
        made = Picture(
            state.shown, size, look, before, held=held, docked=docked, sheet=sheet, also=also, home=home
        )
        if before and before.sheet != made.sheet:
            self._approach = None
        elif before and (_has_moved(before, made) or (sketch and stays and before.fitted != made.fitted)):
            left = self._passing or before
            frames = SWING_FRAMES if isinstance(state.glide, Changeover) else APPROACH_FRAMES
            self._approach = Approach(left.view, state.frame, left.edge, frames)
        elif before and not _is_framed_alike(before, made):
            self._approach = None
        self._fitting = made
        return made

    def _docked(self, state: State) -> Docked:
        """Return what has room of its own."""
        has_tools = self._window and state.top is not None and state.top.has_tools
        row = state.sketch is not None and bool(state.sketch.answers)
        head = state.constructed > 0 or any(one.has_head for one in state.modes)
        return Docked(
            2 if has_tools and state.listed else int(state.listed),
            row,
            self._window,
            head and not state.listed,
        )

    def _look(self, state: State) -> Look:
        """Return the look of a state."""
        for mode in state.modes:
            state = replace(state, look=mode.look(state.look))
        drawn = state.constructed
        look = replace(state.look, hud=False) if drawn else state.look
        return replace(look, centres=0) if state.constructed else look

    def at(self, state: State, size: tuple[int, int]) -> Picture:
        """Return the picture for this frame: while the view moves, one on the way to the fitting picture."""
        goal, self._passing = self.fitting(state, size), None
        if self._approach is None or state.reduced_motion or self._approach.over(state.frame):
            self._approach = None
            return goal
        view, aside = (
            self._approach.view(goal.view, state.frame),
            self._approach.aside(goal.edge, state.frame),
        )
        self._passing = goal.on_its_way(view, aside)
        return self._passing


def _included(state: State) -> tuple[complex, ...]:
    """Return places of the scene that the picture includes: what was drawn, what a construction has found."""
    sketch = state.sketch
    if sketch and not sketch.is_blank:
        x, y = sketch.points.real, sketch.points.imag
        return complex(float(x.min()), float(y.min())), complex(float(x.max()), float(y.max()))
    if state.constructed and state.clock.paused:
        from linkanim.picture.constructed import found_by

        return found_by(state.shown, state.constructed, state.phase)
    return state.also


def _has_moved(one: Picture, other: Picture) -> bool:
    """Return whether two pictures of one linkage, of either closure, in one window are fitted differently."""
    return _are_one(one, other) and one.size == other.size and one.fitted != other.fitted


def _is_framed_alike(one: Picture, other: Picture) -> bool:
    """Return whether two pictures show one linkage in one window at the same zoom and pan."""
    looks = ((picture.look.zoom, picture.look.pan, picture.size) for picture in (one, other))
    return _are_one(one, other) and len(set(looks)) == 1


def _are_one(one: Picture, other: Picture) -> bool:
    """Return whether both pictures are of one scene, or of a scene and the one exchanged for it."""
    scenes = (one.scene, other.scene)
    named = one.scene.name == other.scene.name and not any(scene.towards for scene in scenes)
    return one.scene is other.scene or (named and one.scene.length_unit == other.scene.length_unit)


# A list comes in from the window's edge, and goes out there.

_DRAWER_FRAMES = 9


class Drawer:
    """Moves the list of dimensions, of quantities or of a game in and out."""

    def __init__(self) -> None:
        self._last, self._since, self._is_open = NOTHING_OVER, -_DRAWER_FRAMES, False

    def at(self, over: Overlay, state: State) -> Overlay:
        """Return the overlay to draw: a list that opens or shuts is in part beyond the edge."""
        is_open = bool(over.panel or over.quantities or over.game)
        if is_open != self._is_open:
            self._is_open, self._since = is_open, state.frame
        gone = state.frame - self._since + 1
        if is_open:
            self._last = over
        if state.reduced_motion or gone >= _DRAWER_FRAMES:
            return over
        share = eased(gone / _DRAWER_FRAMES)
        if is_open:
            return replace(over, shut=1.0 - share)
        last = self._last
        return replace(over, panel=last.panel, quantities=last.quantities, game=last.game, shut=share)


# From one picture to the next: the old one fades while the new one is already there; the shutter's flash.

_WHITE = 0.7
"""The opacity of a screenshot's white flash at its brightest."""


class Fade:
    """Keeps the picture from before another mechanism or theme appeared, while it fades."""

    def __init__(self) -> None:
        self._old: pygame.Surface | None = None
        self._since: int | None = None

    def strength(self, state: State, surface: pygame.Surface) -> int:
        """Return the opacity (0 to 255) of the old picture; `surface` holds that picture at first."""
        if state.faded is None or state.reduced_motion:
            self._old = self._since = None
            return 0
        if state.faded != self._since:
            self._old, self._since = surface.copy(), state.faded
        if self._old is None or self._old.get_size() != surface.get_size():
            return 0
        return round(255 * (1.0 - eased((state.frame - state.faded + 1) / FADE_FRAMES)))

    def draw(self, surface: pygame.Surface, strength: int, shutter: int) -> None:
        """Draw the old picture over the new one, and the shutter's white, in eighths, over both."""
        if self._old is not None and strength:
            self._old.set_alpha(strength)
            surface.blit(self._old, (0, 0))
        if shutter:
            white = pygame.Surface(surface.get_size())
            white.fill((255, 255, 255))
            white.set_alpha(round(255 * _WHITE * (shutter / 8) ** 2))
            surface.blit(white, (0, 0))
