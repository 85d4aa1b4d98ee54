"""The pictures of states: each fits what is shown, and another view of it is approached, eased.

The eye can follow what makes room for what. Window and recordings share it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

from linkanim.picture.look import Look
from linkanim.picture.picture import Earlier, Picture
from linkanim.picture.view import Box, Rect, View, eased, joined, view_of
from linkanim.player.state.sketch import Sketch
from linkanim.player.state.state import State

APPROACH_FRAMES = 14
_NAMES = 2
"""So many names are placed in a frame."""


@dataclass(frozen=True)
class Approach:
    """A view that was left at a frame for the one that fits now."""

    left: View
    since: int

    def over(self, frame: int) -> bool:
        """Whether the new view is reached."""
        return frame >= self.since + APPROACH_FRAMES

    def look(self, look: Look, fitted: View, goal: View, size: tuple[int, int], frame: int) -> Look:
        """Return the look whose zoom and pan show the view of this frame, between the left one and `goal`.

        `fitted` is the view that the look zooms and pans, in a window of that size in pixels.
        """
        view = between(self.left, goal, (frame - self.since + 1) / (APPROACH_FRAMES + 1))
        width, height = size
        zoom = view.scale / fitted.scale
        right = view.x - width / 2 - (fitted.x - width / 2) * zoom
        down = view.y - height / 2 - (fitted.y - height / 2) * zoom
        return replace(look, zoom=zoom, pan=(right / height, down / height))


def between(one: View, other: View, share: float) -> View:
    """Return the view so far from one to the other, slow at both ends; every point moves straight."""
    part = eased(share)
    scale, x, y = (
        begin + (end - begin) * part
        for begin, end in ((one.scale, other.scale), (one.x, other.x), (one.y, other.y))
    )
    return View(scale, x, y)


class Framing:
    """The picture of each state that comes, and the last one; a list in a window takes its room.

    Where it is `captioned`, as the window is, names come with the sentence on what to watch for, and a frame
    does not wait for all of them to be placed.
    """

    def __init__(self, *, captioned: bool = False) -> None:
        self._captioned = captioned
        self._fitting: Picture | None = None
        self._coming: Picture | None = None
        self._passing: Picture | None = None
        self._approach: Approach | None = None
        self._frame = 0

    @property
    def last(self) -> Picture:
        """The picture that was given last; there must be one."""
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
        """Return the picture that fits the state; a view other than the last one's, it is approached.

        One that is `hurried` keeps the names of the last, where those have to be placed anew: some of them in
        each frame that comes. What stood still `earlier` is kept, too.
        """
        before, sketch, look = self._fitting, state.sketch, self._look(state)
        hurried = hurried and self._captioned
        held = bool(state.held or (sketch and sketch.held is not None) or state.building or state.home)
        row, listed = sketch is not None and bool(sketch.answers), state.listed
        home = state.building.home if state.building else state.home
        fits = before and before.fits(state.shown, size, look, listed=listed, held=held, row=row, sheet=home)
        if before and fits and not before.hurried:
            if not earlier:
                before.catch_up()
            return before
        stays = before is not None and before.size == size
        make = partial(
            Picture, state.shown, size, look, before, listed=listed, held=held, row=row, sheet=home
        )
        if before and fits and not sketch:
            self._coming = self._coming or make(gradual=True)
            if not self._coming.place_names(_NAMES if hurried else None):
                return before
            made = self._coming
        else:
            make = partial(make, hurried=hurried and not (sketch and stays), earlier=earlier)
            made = make(kept=before.fitted if before and sketch and stays else None)
        self._coming = None
        if sketch and stays and not held and not _is_in_sight(made, sketch):
            made = make(kept=_seen_whole(made, sketch))
        if before and before.sheet != made.sheet:
            self._approach = None
        elif before and (_has_moved(before, made) or (sketch and stays and before.fitted != made.fitted)):
            self._approach = Approach((self._passing or before).view, state.frame)
        elif before and not _is_framed_alike(before, made):
            self._approach = None
        self._fitting = made
        return made

    def _look(self, state: State) -> Look:
        """Return the look of a state; where it is captioned, names come with what to watch for."""
        look = replace(state.look, hud=False) if state.building else state.look
        captioned = (self._captioned and look.names) or state.idle is not None
        return replace(look, caption=True) if captioned else look

    def at(self, state: State, size: tuple[int, int], *, late: bool = False) -> Picture:
        """Return the picture for this frame: one on the way to the fitting one while that is approached.

        A `late` one has the view of the last, and what stands still as it was there.
        """
        self._frame = self._frame if late else state.frame
        last = self._passing or self._fitting
        earlier = last.earlier if last and late else None
        goal, self._passing = self.fitting(state, size, hurried=True, earlier=earlier), None
        if self._approach is None or self._approach.over(self._frame):
            self._approach = None
            return goal
        look = self._approach.look(self._look(state), goal.fitted, goal.view, size, self._frame)
        kept = goal.fitted if state.sketch else None
        self._passing = Picture(
            state.shown,
            size,
            look,
            goal,
            listed=state.listed,
            row=goal.row,
            kept=kept,
            sheet=goal.sheet,
            earlier=earlier,
            hurried=goal.hurried,
        )
        return self._passing


def _is_in_sight(picture: Picture, sketch: Sketch) -> bool:
    """Return whether linkage and stroke lie in their room; where it is zoomed they need not."""
    return picture.look.framed or _holds(picture.layout.stage, picture.view, _box(picture, sketch))


def _seen_whole(picture: Picture, sketch: Sketch) -> View:
    """Return the view that fits a linkage, further away where its stroke would not be seen whole."""
    view, box, stage = picture.fit.arrangement.view, _box(picture, sketch), picture.layout.stage
    return view if _holds(stage, view, box) else view_of(box, stage.inset(2 * picture.layout.margin))


def _holds(stage: Rect, view: View, box: Box) -> bool:
    return stage.holds(*view.to_pixel(box.left, box.high)) and stage.holds(*view.to_pixel(box.right, box.low))


def _box(picture: Picture, sketch: Sketch) -> Box:
    """Return the rectangle of the plane that holds a linkage as it will be, and the stroke."""
    swept = picture.fit.subject.figure.box
    if sketch.curve is None:
        return swept
    x, y = sketch.curve.points.real, sketch.curve.points.imag
    return joined(swept, Box(float(x.min()), float(y.min()), float(x.max()), float(y.max())))


def _has_moved(one: Picture, other: Picture) -> bool:
    """Return whether one linkage, of either closure, in one window is fitted into another place of it."""
    return _are_one(one, other) and one.size == other.size and one.fitted != other.fitted


def _is_framed_alike(one: Picture, other: Picture) -> bool:
    """Return whether one linkage in one window is zoomed and panned alike."""
    looks = ((picture.look.zoom, picture.look.pan, picture.size) for picture in (one, other))
    return _are_one(one, other) and len(set(looks)) == 1


def _are_one(one: Picture, other: Picture) -> bool:
    """Return whether both are of one scene, or of one before and after an exchange that is no glide."""
    scenes = (one.scene, other.scene)
    named = one.scene.name == other.scene.name and not any(scene.towards for scene in scenes)
    return one.scene is other.scene or (named and one.scene.length_unit == other.scene.length_unit)
