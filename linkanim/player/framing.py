"""Fit a picture to a state, and go from one picture to the next.

The view moves smoothly to another one; another picture fades in. A step of a drag that takes too long to be
drawn in one frame is drawn in two.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Generator, Iterator
from dataclasses import replace
from functools import partial
from itertools import islice
from math import inf
from typing import Literal

import pygame
from pygame.event import Event

from linkanim.frozen import frozen
from linkanim.picture.layout import Docked, Layout
from linkanim.picture.look import Look
from linkanim.picture.picture import Arrival, Deferral, Earlier, Picture
from linkanim.picture.view import Box, View, eased
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.state import FADE_FRAMES, Sketch, State
from linkanim.player.stroke_view import view_for

# The pictures of states: each fits what is shown, and the view moves smoothly from one to the next.
#
# So the eye can follow what makes room for what. Window and recordings share this.

APPROACH_FRAMES = 14
_NAMES, _NAMES_ON_THE_WAY = 2, 1
"""The names that are placed in a frame, and in a frame that draws everything anew because its view moves."""

DrawnAhead = Callable[[Picture, State], Iterator[None]]


@frozen
class Approach:
    """The view that is being left for another one, and the frame at which the change began.

    `edge` is that of the picture being left: charts come in from there. Polygons that this picture did not
    have wait (`waits`) until the view is there.
    """

    left: View
    since: int
    edge: tuple[float, float] = (0.0, 0.0)
    waits: bool = False

    def over(self, frame: int) -> bool:
        """Return whether the new view is reached."""
        return frame >= self.since + APPROACH_FRAMES

    def look(
        self,
        look: Look,
        fitted: View,
        goal: View,
        size: tuple[int, int],
        frame: int,
        *,
        about: tuple[float, float] | None = None,
    ) -> Look:
        """Return the look whose zoom and pan show this frame's view, between the old one and `goal`.

        `fitted` is the view that the look zooms and pans, in a window of that size in pixels; it zooms about
        a pixel, without one about the window's middle.
        """
        view, (x, y) = between(self.left, goal, self._share(frame)), about or (size[0] / 2, size[1] / 2)
        zoom = view.scale / fitted.scale
        right, down = view.x - x - (fitted.x - x) * zoom, view.y - y - (fitted.y - y) * zoom
        return replace(look, zoom=zoom, pan=(right / size[1], down / size[1]))

    def arrival(self, frame: int) -> Arrival:
        """Return how charts come in at a frame: with the view."""
        return Arrival(self.edge, 1.0 - eased(self._share(frame)), self.waits)

    def _share(self, frame: int) -> float:
        """Return the share of the way that is over, in time."""
        return (frame - self.since + 1) / (APPROACH_FRAMES + 1)


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

    Where it is `captioned`, as the window is, names come with the sentence on what to watch for, the bar of
    commands has room at the foot, and a frame does not wait until all names are placed. The picture with
    placed names is then drawn `ahead`, in steps, before it is returned.
    """

    def __init__(self, *, captioned: bool = False, ahead: DrawnAhead | None = None) -> None:
        self._captioned, self._ahead = captioned, ahead
        self._fitting: Picture | None = None
        self._coming: Picture | None = None
        self._drawing: Iterator[None] | None = None
        self._passing: Picture | None = None
        self._approach: Approach | None = None
        self._drawn: tuple[int, View] | None = None
        self._frame = 0

    @property
    def last(self) -> Picture:
        """The picture that was returned last; there must be one."""
        picture = self._passing or self._fitting
        assert picture is not None
        return picture

    def fitting(
        self,
        state: State,
        size: tuple[int, int],
        *,
        hurried: bool = False,
        earlier: Earlier | None = None,
    ) -> Picture:
        """Return the picture that fits the state; where its view differs from the last, begin to move to it.

        In a `hurried` frame of a window, names that need new places stay where they were: each further frame
        places some of them. The still part `earlier` is kept, too.
        """
        before, sketch, look = self._fitting, state.sketch, self._look(state)
        hurried = hurried and self._captioned
        held = bool(state.held or (sketch and sketch.held is not None) or state.building or state.home)
        docked = self._docked(state)
        home = state.building.home if state.building else state.home
        fits = before and before.fits(state.shown, size, look, docked, held=held, sheet=home)
        if before and fits and not before.hurried:
            if not earlier:
                before.catch_up()
            return before
        stays = before is not None and before.size == size
        make = partial(
            Picture,
            state.shown,
            size,
            look,
            before,
            docked=docked,
            sheet=home,
        )
        if before and fits and not sketch:
            made = self._coming = self._coming or make(later=Deferral(held, "in steps"))
            most = _NAMES_ON_THE_WAY if self._approach else _NAMES
            if not made.place_names(most if hurried else None) or (hurried and self._draws(made, state)):
                return before
        else:
            stay = hurried and not (sketch and stays)
            make = partial(make, later=Deferral(held, "as before" if stay else "at once", earlier))
            made = make(kept=before.fitted if before and sketch and stays else None)
        self._coming = self._drawing = None
        if before and sketch and stays and not held and not made.look.framed:
            goal = self._of_the_stroke(before, made, sketch)
            made = made if goal == made.fitted else make(kept=goal)
        if before and before.sheet != made.sheet:
            self._approach = None
        elif before and (_has_moved(before, made) or (sketch and stays and before.fitted != made.fitted)):
            left = self._passing or before
            self._approach = Approach(left.view, state.frame, left.edge, not left.has_polygons)
        elif before and not _is_framed_alike(before, made):
            self._approach = None
        self._fitting = made
        return made

    def _draws(self, coming: Picture, state: State) -> bool:
        """Draw one step of the coming picture ahead; return whether there was a step left."""
        if self._drawing is None:
            self._drawing = self._ahead(coming, state) if self._ahead else iter(())
        return any(True for _ in islice(self._drawing, 1))

    def _docked(self, state: State) -> Docked:
        """Return what has room of its own; only a window has tools beside a list and the bar of commands."""
        has_tools = self._captioned and state.editing.open and not (state.listing or state.game)
        row = state.sketch is not None and bool(state.sketch.answers)
        return Docked(2 if has_tools else int(state.listed), row, self._captioned)

    def _of_the_stroke(self, before: Picture, made: Picture, sketch: Sketch) -> View:
        """Return the view of a sketch and the linkage for it; unchanged where there is no linkage yet."""
        if not sketch.is_asked or sketch.is_blank:
            self._drawn = sketch.strokes, before.fitted
            return before.fitted
        if self._drawn is None or self._drawn[0] != sketch.strokes:
            self._drawn = sketch.strokes, before.fitted
        x, y = sketch.points.real, sketch.points.imag
        stroke = Box(float(x.min()), float(y.min()), float(x.max()), float(y.max()))
        room = made.layout.stage.inset(2 * made.layout.margin)
        return view_for(self._drawn[1], stroke, made.fit.subject.figure.box, room, made.layout.hud)

    def preparing(self, state: State) -> Generator[None, None, Layout]:
        """Work out in steps what the picture of a state with the last picture's scene needs.

        Returns the layout of that picture.
        """
        return (yield from self.last.preparing(self._look(state), self._docked(state)))

    def _look(self, state: State) -> Look:
        """Return the look of a state; where `captioned`, names bring the sentence on what to watch for."""
        if state.layers:
            return replace(Look(theme=state.look.theme, hud=False), zoom=state.look.zoom, pan=state.look.pan)
        drawn = state.building or state.posing or state.constructed
        look = replace(state.look, hud=False) if drawn else state.look
        return replace(look, caption=True) if self._captioned and look.names else look

    def at(self, state: State, size: tuple[int, int], *, late: bool = False) -> Picture:
        """Return the picture for this frame: while the view moves, one on the way to the fitting picture.

        A `late` picture has the view and the still part of the last one.
        """
        self._frame = self._frame if late else state.frame
        last = self._passing or self._fitting
        earlier = last.earlier if last and late else None
        goal, self._passing = self.fitting(state, size, hurried=True, earlier=earlier), None
        if self._approach is None or self._approach.over(self._frame):
            self._approach = None
            return goal
        kept = goal.fitted if state.sketch else None
        about = None if kept else goal.about
        look = self._approach.look(self._look(state), goal.fitted, goal.view, size, self._frame, about=about)
        names: Literal["as before", "at once"] = "as before" if goal.hurried else "at once"
        arrival = self._approach.arrival(self._frame)
        self._passing = Picture(
            state.shown,
            size,
            look,
            goal,
            docked=self._docked(state),
            kept=kept,
            sheet=goal.sheet,
            later=Deferral(names=names, earlier=earlier, arrival=arrival),
        )
        return self._passing


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
        if state.faded is None:
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


# How a step of a drag is drawn: in one frame, or, where that takes too long, in two.

_ROOM = 0.85 / FRAMES_PER_SECOND
"""The time that a frame may take, in seconds: the rest is left to the machine's other work."""
_ONCE = 0.75
"""The time of a step in one frame, as a share of its time in two: these draw what moves twice."""


class StepSplitter:
    """Draws a step of a drag in two frames where the last step took longer than a frame.

    The first frame draws the moved linkage, the second the still part behind it, and the list; meanwhile mere
    moves of the mouse have to wait.
    """

    def __init__(self, now: Callable[[], float] = time.perf_counter) -> None:
        self._now, self._began = now, 0.0
        self._waiting: list[Event] = []
        self._late = False
        self._part: Literal["first", "rest", "whole", "none"] = "none"
        self._first, self._step = 0.0, inf

    def begin(self, events: list[Event]) -> list[Event]:
        """Begin a frame; return the events for it: of the new ones, and of those that waited."""
        self._began = self._now()
        events, self._waiting = self._waiting + events, []
        if self._late and all(event.type == pygame.MOUSEMOTION for event in events):
            events, self._waiting = [], events
        return events

    def late(self, *, stepped: bool) -> bool:
        """Return whether this frame, in which something was changed or not, is the first of a step's two."""
        was, self._late = self._late, stepped and self._step > _ROOM
        self._part = "first" if self._late else "rest" if was else "whole" if stepped else "none"
        return self._late

    def end(self) -> None:
        """End a frame: measure the time that it took."""
        took = self._now() - self._began
        match self._part:
            case "first":
                self._first = took
            case "rest":
                self._step = _ONCE * (self._first + took)
            case "whole":
                self._step = took
