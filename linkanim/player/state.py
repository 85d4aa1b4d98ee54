"""Hold the player's state: all that one frame of the window shows, as a frozen value.

Its parts come first: the open lists, the editing of dimensions, the glide to a changed length, the sheet, the
pencil's sketch and poses; then `State` itself. Last, a scene is tried before it is shown, and a fault of the
solver becomes a sentence.
"""

from __future__ import annotations

import os
import traceback
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping
from dataclasses import field, replace
from functools import cached_property
from math import dist, fmod
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from linkanim.build.building import Building, Undoable
from linkanim.build.draft import Draft, Thing
from linkanim.build.meanings import Meaning
from linkanim.errors import BadInput, LinkanimError
from linkanim.frozen import frozen
from linkanim.mechanics.analysis import Info
from linkanim.mechanics.groups import group_of
from linkanim.mechanics.linkage import Point
from linkanim.mechanics.motion import stopped
from linkanim.picture.drawn import Addition
from linkanim.picture.look import Look
from linkanim.picture.marks import Spot, Spots
from linkanim.picture.view import Box, eased
from linkanim.player.action import Action, Value
from linkanim.player.clock import FRAMES_PER_SECOND, Clock
from linkanim.player.keys import (
    BACK_BAR,
    GAME_TABLE,
    HOME_BAR,
    LAST_BAR,
    OF_MODES,
    BarEntry,
    ModeKeys,
)
from linkanim.scenes import load, names
from linkanim.scenes.editing import Dimension, Handle, dimensions, handles, in_unit, on_the_way
from linkanim.scenes.form import Key
from linkanim.scenes.scene import Scene
from linkanim.units import degrees
from linkanim.words import said, to_say

if TYPE_CHECKING:
    from linkanim.picture.game_panel import GamePanel
    from linkanim.picture.lists import ListPanel
    from linkanim.synthesis.answers import PathAnswer
    from linkanim.synthesis.curves import DrawnCurve
    from linkanim.synthesis.guidance import PoseAnswer

# The editing of dimensions: the value being typed, the refused value and why, undo and redo.

_KEPT = 100


@frozen
class Editing(Undoable[Scene]):
    """The state of editing; `past` and `future` are the scenes that undo and redo go to.

    `typed` is a value typed in the chosen row and not taken yet, `drafts` those typed in rows left before,
    `refusal` the reason why they were refused; `refused` is the document that a drag led to. With `warned`
    the values are taken if asked once more. `original` is the scene as in its file, once it was changed.
    `saved` is the name of the saved scene, and its file.
    """

    chosen: int = 0
    typed: str = ""
    drafts: tuple[tuple[Key, str], ...] = ()
    refusal: str | None = None
    refused: Mapping[str, Any] | None = None
    warned: bool = False
    original: Scene | None = None
    saved: tuple[str, str] | None = None

    @property
    def changed(self) -> bool:
        """Whether there is something to undo or redo."""
        return bool(self.past or self.future)

    @property
    def begun(self) -> bool:
        """Whether a typed value, in this or another row, waits to be taken."""
        return bool(self.typed or self.drafts)


def chosen(editing: Editing, scene: Scene) -> Dimension | None:
    """Return the dimension of the chosen row; None where the scene has none."""
    items = dimensions(scene)
    return items[editing.chosen % len(items)] if items else None


def still_typed(editing: Editing, before: Scene, after: Scene) -> Editing:
    """Return the editing once a scene has become another: without typed values that this has no row for."""
    if not editing.begun:
        return editing
    rows, row = {item.key for item in dimensions(after)}, chosen(editing, after)
    drafts = tuple(pair for pair in editing.drafts if pair[0] in rows)
    was = chosen(editing, before)
    stays = row is not None and was is not None and row.key == was.key
    return replace(editing, drafts=drafts, typed=editing.typed if stays else "")


def nothing_begun(editing: Editing) -> Editing:
    """Return the editing without the value being typed; where there is none, without all drafts."""
    return cleared(editing) if editing.typed else cleared(editing, drafts=())


def with_undo(editing: Editing, scene: Scene) -> Editing:
    """Return the editing after `scene` was exchanged for another; undo goes back to it."""
    original = editing.original or scene
    return cleared(editing, past=editing.remembering(scene, _KEPT), future=(), original=original)


def loss_of_turning(before: Info, after: Info) -> str | None:
    """Say that the input no longer turns fully, where it did; else None."""
    if after.full_turn or not before.full_turn:
        return None
    low, high = (degrees(limit) for limit in after.input_range)
    words = said("the crank cannot turn fully; it swings {low}…{high}", low=low, high=high)
    return said("{cause}: {effect}", cause=after.why_swinging, effect=words) if after.why_swinging else words


def check_of_turning(before: Info) -> Callable[[Scene], None]:
    """Return a check that refuses a scene whose input no longer turns fully before all of it is solved."""

    def check(scene: Scene) -> None:
        why = stopped(scene.linkage) if before.full_turn else None
        if why and (loss := loss_of_turning(before, Info(why, scene.length_unit))):
            raise BadInput(loss)

    return check


def cleared(editing: Editing, **changes: object) -> Editing:
    """Return the editing with nothing typed and nothing refused, and these changes."""
    return replace(editing, **{"typed": "", "refusal": None, "warned": False, **changes})  # type: ignore[arg-type]


@frozen
class Held:
    """A dragged joint, "" for the chosen value; the scene, the phase and whether it `ran` when grasped."""

    joint: str
    scene: Scene
    phase: float
    ran: bool

    @cached_property
    def following(self) -> tuple[tuple[Handle, str], ...]:
        """The dimensions that follow the joint, with their units."""
        units = {item.key: item.unit for item in dimensions(self.scene)}
        return tuple((handle, units[handle.key]) for handle in handles(self.scene, self.joint))


_TRAIL, _JUMP, _FASTEST = 6, 1.0, 20.0
"""Frames over which a hand's speed is measured, a step (rad) that is a jump, the greatest speed (rad/s)."""


@frozen
class Grasp:
    """A joint that a hand drags, and the input with it; `ran` says that the motion ran and will run on.

    `trail` holds the last frames and their phases, `forward` the latest direction of the phase.
    """

    joint: str
    ran: bool
    trail: tuple[tuple[int, float], ...]
    forward: bool

    def led(self, frame: int, phase: float) -> Grasp:
        """Return the grasp with the phase to which the hand has led the input."""
        step = phase - self.trail[-1][1]
        forward = step > 0.0 if step else self.forward
        before = self.trail if abs(step) < _JUMP else ()
        return replace(self, trail=(*before, (frame, phase))[-_TRAIL - 1 :], forward=forward)

    def speed(self, frame: int) -> float:
        """Return the hand's speed (rad/s of phase) at a frame: 0 where it has stood still."""
        at, last = self.trail[-1]
        earlier = [one for one in self.trail if one[0] <= frame - _TRAIL][-1:] or self.trail[:1]
        since, phase = earlier[0]
        # a button is released a frame or two after the mouse's last move
        rate = (last - phase) * FRAMES_PER_SECOND / max(max(at, frame - 2) - since, 1)
        return min(max(rate, -_FASTEST), _FASTEST)


# A change on its way: of the view and the lists, to another picture, to a changed length, to a closure.

MOVE_FRAMES, SWING_FRAMES = 16, 36
"""The frames that a change takes, and a swing to the other closure."""
EVERY = 2
"""Frames for which each scene of a glide is shown; the next one is worked out in the last of them."""
_TRIED = 90
_FOLLOWED = ("length", "offset", "angle")


@frozen(kw_only=True)
class Change:
    """A change that is seen on its way from frame `since` on, for so many frames."""

    since: int
    frames: int = MOVE_FRAMES

    def share(self, frame: int) -> float:
        """Return the share of the way that is over at a frame, slow at both ends."""
        return eased((frame + 1 - self.since) / self.frames)

    def is_over(self, frame: int) -> bool:
        """Return whether nothing of it is seen any more at a frame."""
        return frame + 1 - self.since > self.frames


@frozen
class Departure(Change):
    """The state that is left: its view and its lists move on, or its picture fades."""

    left: State
    fades: bool = False


@frozen
class Glide(Change):
    """Dimensions that change: (key, from, to), and the scene shown meanwhile.

    All stands where it does for the scene `placed`, from which this glide, or the one before it, began.
    `coming` is the scene that is worked out for the next frame, if any.
    """

    scene: Scene
    changes: tuple[tuple[Key, float, float], ...]
    placed: Scene
    coming: Scene | None = None


@frozen
class Changeover(Change):
    """The closure that the linkage leaves, to swing over to the scene's own."""

    left: Scene


_IN_PLACE = 1e-9
"""By how much a joint may move and stay in its place, in the scene's unit."""


def glide(before: Scene, after: Scene, frame: int, phase: float, placed: Scene) -> Glide | Changeover | None:
    """Return the glide from one scene to the other; a swing where only the closure differs.

    None where the linkage is another one, or stays in its place at the `phase`. Lengths of links that are
    solved together change at once: each scene on the way would have to be followed all the way round.
    """
    old = {item.key: item for item in dimensions(before)}
    changes = tuple(
        (item.key, old[item.key].value, item.value)
        for item in dimensions(after)
        if item.kind in _FOLLOWED and item.key in old
        if item.unit == old[item.key].unit and item.value != old[item.key].value
    )
    if changes:
        return None if group_of(after.linkage) else Glide(before, changes, placed, since=frame)
    places, others = before.pose(phase, 0).position, after.pose(phase, 0).position
    if places.keys() != others.keys():
        return None
    swings = any(dist(others[name], place) > _IN_PLACE for name, place in places.items())
    return Changeover(before, since=frame, frames=SWING_FRAMES) if swings else None


def followed(begun: Glide | Changeover, after: Scene, frame: int) -> Glide | Changeover | None:
    """Return the glide at `frame`; None when `after` is reached.

    A scene on the way that cannot be assembled over its whole cycle is left out: the last one stays.
    """
    if begun.is_over(frame) or isinstance(begun, Changeover):
        return None if begun.is_over(frame) else begun
    gone = frame + 1 - begun.since
    if gone % EVERY == 0 and gone < begun.frames:
        return replace(begun, coming=_on_the_way(begun, after, gone / begun.frames))
    return replace(begun, scene=begun.coming, coming=None) if begun.coming else begun


def _on_the_way(begun: Glide, after: Scene, part: float) -> Scene | None:
    """Return the scene after a part of the way; None where it cannot be assembled over its whole cycle."""
    try:
        scene = on_the_way(
            after, {key: start + (end - start) * eased(part) for key, start, end in begun.changes}
        )
    except LinkanimError:
        return None
    return scene if closes(scene) else None


def closes(scene: Scene) -> bool:
    """Tell whether all joints have a place at all phases."""
    places = scene.cycle(scene.mechanism.count(_TRIED), derivatives=0).position.values()
    return all(bool(np.isfinite(place).all()) for place in places)


# The sheet on which a linkage is built: what is drawn on it, the tool in hand, and what the hand does.

HOME = Box(-100.0, -40.0, 200.0, 130.0)
"""The part of the plane that an empty sheet shows, in millimetres."""
BLANK = to_say("nothing is drawn yet that has a dimension")
LIVE = ("move", "photo")
"""The tools that change what is built while the hand moves."""


class Grip(NamedTuple):
    """A gesture from where the hand went down: how near counts as on a thing, the step of what is drawn.

    `base` is the building before the gesture, `ran` whether the linkage ran then.
    """

    begin: Point
    at: Point
    reach: float
    snap: float
    base: Building
    ran: bool

    @property
    def is_click(self) -> bool:
        """Whether the hand has stayed where it went down."""
        (x, y), (u, v) = self.begin, self.at
        return max(abs(x - u), abs(y - v)) <= self.reach / 2


@frozen
class BuildSheet:
    """The sheet over the scene `before`, which returns, with clock and editing, if the draft cannot move.

    `home` is the visible part of the plane at no zoom. `tool` is the tool in hand, `grip` the hand's gesture,
    `clicked` the frame and place of its last click; `cursor` is the place of the keys' cursor. `anchor` is
    the point of a photograph that is put where it belongs, `span` another point of it, whose distance from
    the first can be typed. `offers` are the meanings of the last drag, which ended at `offered`. `rests` is
    the frame at which a linkage that runs by itself has shown one period. `written` is the draft as in the
    scene file `saved`. `warned` says that the next request discards a draft that is in no file, `closes` that
    the next one closes the window nevertheless. With the list of dimensions open, typed text goes to the
    chosen thing's own row where that is `rowed`. `look` is the look before the sheet was opened: a sheet has
    no chart, and a unit of its own. After it was left
    the sheet is kept, so that one can go on with it.
    """

    before: Scene
    clock: Clock
    editing: Editing
    building: Building = field(default_factory=Building)
    home: Box = HOME
    tool: str = "bar"
    grip: Grip | None = None
    clicked: tuple[int, Point] | None = None
    cursor: Point | None = None
    anchor: Point | None = None
    span: Point | None = None
    offers: tuple[Meaning, ...] = ()
    offered: Point = (0.0, 0.0)
    rests: int | None = None
    written: Draft = field(default_factory=Draft)
    saved: str = ""
    warned: bool = False
    closes: bool = False
    rowed: bool = False
    look: Look = field(default_factory=Look)

    def seen(self, scene: Scene, phase: float) -> Draft:
        """Return the draft with its joints as they are shown: while it moves, at a phase of its scene."""
        drawn = self.building.draft
        if self.building.made.scene is None:
            return drawn
        position = scene.pose(phase, 0).position
        places = {name: (float(position[name][0]), float(position[name][1])) for name in drawn.places}
        return replace(drawn, places=places)

    @property
    def meant(self) -> int | None:
        """Which of the offers is carried out; None without offers, or if something else was done since."""
        draft = self.building.draft
        return next((n for n, one in enumerate(self.offers) if one.building.draft is draft), None)

    @property
    def lasting(self) -> Building:
        """The building without the gesture under way."""
        return self.grip.base if self.grip and self.tool in LIVE else self.building

    @property
    def is_written(self) -> bool:
        """Whether nothing would be lost if the sheet were closed."""
        return self.building.draft == self.written


def driven_bar(draft: Draft) -> Thing | None:
    """Return the bar of the driven crank; None where something else is driven."""
    bars = draft.bars_at(draft.driven) if draft.driven else ()
    return next((("bars", name) for name, end, _ in bars if end in draft.of("pins")), None)


# What is open over the picture.


class Rule(NamedTuple):
    """One action: the test that its value must pass, and the state that it makes of another.

    `taped` is False for actions outside the picture, which no tape keeps. `answer` says in a word or two what
    changed, from the states before and after.
    """

    check: Callable[[object], bool]
    handle: Callable[[State, Any], State]
    taped: bool = True
    answer: Callable[[State, State], str | None] | None = None


Resolver = Callable[[Any, Value], Iterable[Action]]
"""What an action asks of a window with these contents, by its value."""


class Dial(NamedTuple):
    """Where a knob stands, from 0 at the left to 1, between two words; the track may have `marks`."""

    value: float
    low: str
    high: str
    marks: tuple[float, ...] = ()
    held: bool = False


@frozen
class AnswerRow:
    """Linkages for a path or for poses, as answers or scenes, words about each, and which one is shown.

    Linkages for poses come with these `poses`. Lengths are in `unit`. The pictures
    rest while `still`. A `dial` stands above.
    """

    entries: tuple[PathAnswer | PoseAnswer | Scene, ...]
    names: tuple[str, ...]
    words: tuple[str, ...]
    chosen: int
    unit: str
    still: bool = False
    dial: Dial | None = None
    poses: tuple[tuple[float, float, float], ...] = ()


class Mode:
    """What is open over the picture, in a module of its own: its keys, bar, actions, mouse and panel.

    Modes are frozen values on the state's stack `modes`; equal ones look the same. Keys, mouse and Esc are
    for the last of them, and so are its `actions`, even over a game. `meanings` say what actions ask that
    depend on what is visible, or outside. One that `is_listed` takes the room of a list; one that
    `gives_way` closes where another opens; where it `leads`, a hand on a joint drags the input; Esc
    closes one that `covers`. One that
    `has_head` has words above the linkage. One may have tools at the
    edge, and a `pointer` of its own. Where one `sees_through`, as the help and the steps of a construction,
    keys and mouse are for what lies below it.
    """

    keys: ClassVar[ModeKeys]
    bar: ClassVar[tuple[BarEntry, ...]]
    actions: ClassVar[Mapping[str, Rule]]
    meanings: ClassVar[Mapping[str, Resolver]] = MappingProxyType({})
    is_listed: ClassVar[bool] = False
    gives_way: ClassVar[bool] = False
    leads: ClassVar[bool] = False
    covers: ClassVar[bool] = True
    has_head: ClassVar[bool] = False
    has_tools: ClassVar[bool] = False
    is_sheet: ClassVar[bool] = False
    edits_dimensions: ClassVar[bool] = False
    pointer: ClassVar[str] = ""
    sees_through: ClassVar[bool] = False
    is_help: ClassVar[bool] = False

    def steps_of(self, scene: Scene) -> int:
        """Return how many steps of a scene's construction it draws."""
        del scene
        return 0

    def typing(self, state: State) -> bool:
        """Return whether something has been begun by typing; in a line or a dialog all print is typed."""
        del state
        return self.keys.alone

    @property
    def is_paper(self) -> bool:
        """Whether what is drawn can be shifted anywhere."""
        return False

    @property
    def is_live(self) -> bool:
        """Whether small pictures of linkages run in it."""
        return False

    @property
    def title(self) -> str:
        """The title of its panel, where there are several; else empty."""
        return ""

    def look(self, look: Look) -> Look:
        """Return the look of the picture under the mode."""
        return look

    def forbids(self, state: State, action: Action) -> str | None:
        """Return why an action is refused, "" for no words; None where it is not."""
        del state, action
        return None

    def agreed(self, before: State, after: State) -> State:
        """Return the state after any action, where the mode follows what has changed."""
        del before
        return after

    def ready_for(self, state: State, action: Action) -> State:
        """Return the state in which an action that is not of the mode is carried out."""
        del action
        return state

    def aged(self, state: State) -> State:
        """Return the state, which is a frame older already, with the effect of time on the mode."""
        return state

    def closed(self, state: State) -> State:
        """Return the state after Esc or the back arrow: without the mode, unless it has to let go first."""
        return state.without(type(self))

    @property
    def draggable(self) -> tuple[str, ...]:
        """The joints that can be dragged, where that is a matter of the mode."""
        return ()

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return what it draws in the picture."""
        del state
        return ()

    def panel(self, state: State) -> ListPanel | GamePanel | None:
        """Return the list that is open."""
        del state
        return None

    def says(self, state: State) -> str | None:
        """Return what is said at the foot as long as it is open."""
        del state
        return None

    def answer_row(self, state: State) -> AnswerRow | None:
        """Return the answers that stand in a row at the foot."""
        del state
        return None

    def tools(self, state: State) -> tuple[int, bool] | None:
        """Return the number of the tool in hand, and whether tools' keys need Ctrl; None without tools."""
        del state
        return None

    @property
    def sign(self) -> str | None:
        """Words among the marks at the foot: how far off a curve is."""
        return None

    def mouse(self, gesture: Any, mouse: Any, screen: Any) -> tuple[Action, ...] | None:
        """Return the actions of a gesture; None where the mouse acts as without the mode."""
        del gesture, mouse, screen
        return None

    def menu(self, mouse: Any, screen: Any) -> tuple[Action, ...] | None:
        """Return the actions of a right click; None where it opens the list of commands as usual."""
        del mouse, screen
        return None


OneMode = TypeVar("OneMode", bound=Mode)


# Sketches for which linkages are found: the pencil's stroke, or poses of a body.

REACH, NEAR_HAND = 0.035, 0.02
"""How near counts as on a handle, and as on a joint or a curve, in heights of the window."""
STILL = 0.006
"""How far the hand may move in a click, in heights of the window."""
PIVOTS = ("O2", "O4")
"""The fixed pins of every answer."""
_MANY = 1e5
"""A phase (rad) up to which turns are counted: a window that runs on for days comes to more."""
_LARGEST_COGNATE = 2.5
"""A cognate larger than this, in sizes of the stroke, is not shown beside a smaller answer."""
DIAL = "dial"
"""The value of a sketch's `held` while its dial is dragged."""


@frozen
class Sketch(Mode, ABC):
    """A sketch over the scene `before`, which comes back with its clock and editing, and its answers.

    All is in the `unit` of length in which scenes were shown then; `strokes` counts the requests for answers.
    The `chosen` one of the `answers` is the state's scene. While something is `held` by the hand, `base` is
    the scene when it was grasped, and `coming` the one for the next frame. `earlier` is the sketch before the
    last change.
    """

    before: Scene
    clock: Clock
    editing: Editing
    unit: str
    strokes: int = 0
    answers: tuple[Any, ...] = ()
    chosen: int = 0
    held: object = None
    base: Scene | None = None
    coming: Scene | None = None
    earlier: Any = None

    @property
    def answer(self) -> Any:
        """The answer that is shown; None before the first has come."""
        return self.answers[self.chosen] if self.answers else None

    @property
    def is_blank(self) -> bool:
        """Whether no linkage is shown yet for what is drawn."""
        return not self.answers

    @property
    def is_live(self) -> bool:
        """Whether its answers run in a row."""
        return not self.is_blank

    @property
    @abstractmethod
    def is_asked(self) -> bool:
        """Whether there is enough for linkages to be found."""

    @property
    @abstractmethod
    def points(self) -> NDArray[np.complex128]:
        """The points that have to stay visible, as x + yi."""

    @property
    @abstractmethod
    def at_rest(self) -> Self:
        """The sketch with nothing begun."""

    def picking(self, number: int) -> Self:
        """Return the sketch with another of the answers shown, as the user asked."""
        return replace(self, chosen=number)

    @abstractmethod
    def answer_from(self, numbers: tuple[float, ...]) -> Any:
        """Return the answer that is all of these numbers."""

    @abstractmethod
    def scene_of(self, answer: Any, goal: Scene | None = None) -> Scene:
        """Return an answer as a scene; with `goal`, one on the way to that scene."""


@frozen
class PathSketch(Sketch):
    """What the pencil has drawn.

    `pen` holds the points of the stroke under way, `curve` the curve that the last stroke meant. The first
    answer may be the scene whose own trace was taken; `names` has words for each answer. `way` has the
    answers along the front, from the most exact to the most compact; where the `dial` was moved to a share of
    it, the scene is the answer `dialled` there. An answer that the user `picked` stays when more answers
    come. `pivots` keep the places where they were put. `held` is the number of the curve's point, the pivot,
    or the `DIAL` that is dragged.
    """

    answers: tuple[PathAnswer | Scene, ...] = ()
    held: int | str | None = None
    earlier: PathSketch | None = None
    pen: tuple[complex, ...] = ()
    curve: DrawnCurve | None = None
    names: tuple[str, ...] = ()
    way: tuple[PathAnswer, ...] = ()
    dial: float | None = None
    dialled: PathAnswer | None = None
    picked: bool = False
    pivots: tuple[tuple[str, Point], ...] = ()

    @property
    def answer(self) -> PathAnswer | Scene | None:
        """The answer that is shown; None before the first has come."""
        return self.dialled or (self.answers[self.chosen] if self.answers else None)

    @property
    def follows(self) -> bool:
        """Whether the shown linkage was found for the stroke, so that its fixed pins can be dragged."""
        return not (self.is_blank or isinstance(self.answer, Scene))

    @cached_property
    def cognates(self) -> tuple[PathAnswer | None, ...]:
        """The cognates of the answer that is shown at rest, else empty.

        An entry is None for a cognate that does not turn fully, or is far larger than answer and stroke.
        """
        answer = self.answer
        if not self.follows or self.held is not None or answer is None or isinstance(answer, Scene):
            return ()
        from linkanim.synthesis.answers import turning_cognates

        most = max(_LARGEST_COGNATE, answer.size)
        return tuple(one if one and one.size <= most else None for one in turning_cognates(answer))

    @property
    def off(self) -> float | None:
        """The deviation of the shown answer, in percent of the stroke's size; None before the first one."""
        return 0.0 if isinstance(self.answer, Scene) else self.answer.off if self.answer else None

    @property
    def is_blank(self) -> bool:
        """Whether no linkage follows the stroke yet."""
        return bool(self.pen) or not self.answers

    @property
    def is_asked(self) -> bool:
        """Whether there is a stroke."""
        return self.curve is not None

    @cached_property
    def points(self) -> NDArray[np.complex128]:
        """The stroke's points, and those that the joints of the shown cognates pass."""
        stroke = np.zeros(0, np.complex128) if self.curve is None else self.curve.points
        return np.concatenate([stroke, *(one.passed for one in self.cognates if one)])

    @property
    def at_rest(self) -> PathSketch:
        """The sketch without a stroke under way."""
        return replace(self, pen=())

    @property
    def undialled(self) -> PathSketch:
        """The sketch with nothing dragged, and the dial at the chosen answer."""
        return replace(self, dial=None, dialled=None, held=None, picked=False)

    def picking(self, number: int) -> PathSketch:
        """Return the sketch with another of the answers shown, as the user asked."""
        return replace(self.undialled, chosen=number, picked=True)

    def answer_from(self, numbers: tuple[float, ...]) -> PathAnswer:
        """Return the answer that is all of these numbers."""
        from linkanim.synthesis.answers import answer_from

        return answer_from(numbers)

    def scene_of(self, answer: PathAnswer | Scene, goal: Scene | None = None) -> Scene:
        """Return an answer as a scene; with `goal`, one on the way to that scene."""
        return answer if isinstance(answer, Scene) else answer.scene(self.unit, goal)


class SetPose(NamedTuple):
    """A pose that was set down: the body's origin, and its angle (rad)."""

    x: float
    y: float
    angle: float


class PoseGrip(NamedTuple):
    """The thing of poses that is dragged, and its number: a frame, its axis, a pin, or a joint in pose 1.

    `off` is its vector from the hand when it was grasped, `at` where a joint is dragged to.
    """

    what: Literal["pose", "axis", "pin", "joint"]
    number: int
    off: Point = (0.0, 0.0)
    at: Point | None = None


POSED = 16
"""How many numbers describe a linkage through poses."""
LARGEST_DIAL = 4
"""The dial's farthest step, to either side of the middle."""


@frozen
class PoseSketch(Sketch):
    """Poses of a body that were set down, and linkages whose coupler passes through them.

    `pins` are where fixed pins have to be; with `sliding` linkages end on a slider. The `dial` says which
    counts more, a small linkage (below 0) or a large transmission angle. With `curves` the poses' poles and
    Burmester's curves are drawn. While `pinning` the hand sets pins instead of poses. `selected` is the thing
    touched last, `cursor` the place of the keys' cursor, `refusal` why there is no linkage.
    """

    answers: tuple[PoseAnswer, ...] = ()
    held: PoseGrip | None = None
    earlier: PoseSketch | None = None
    poses: tuple[SetPose, ...] = ()
    pins: tuple[Point, ...] = ()
    sliding: bool = False
    dial: int = 0
    curves: bool = False
    pinning: bool = False
    selected: tuple[str, int] | None = None
    cursor: Point | None = None
    refusal: str = ""

    @property
    def is_asked(self) -> bool:
        """Whether there are enough poses."""
        return len(self.poses) > 1

    @property
    def points(self) -> NDArray[np.complex128]:
        """The poses' origins."""
        return np.array([complex(pose.x, pose.y) for pose in self.poses], np.complex128)

    @property
    def at_rest(self) -> PoseSketch:
        """The sketch with nothing held."""
        return replace(self, held=None)

    def answer_from(self, numbers: tuple[float, ...]) -> PoseAnswer:
        """Return the answer that is all of these numbers."""
        from linkanim.synthesis.guidance import pose_answer_from

        return pose_answer_from(numbers)

    def scene_of(self, answer: PoseAnswer, goal: Scene | None = None) -> Scene:
        """Return an answer as a scene; with `goal`, one on the way to that scene."""
        return answer.scene(self.unit, self.poses, goal)


# The player's state: all that one frame of the window shows, as a frozen value.
#
# What must be done outside (a screenshot, full screen, a file to write) is left in `State.effects`,
# as data for the window to carry out.

TOAST_FRAMES = 3 * FRAMES_PER_SECOND
CHIP_FRAMES = 66
ATTRACT_AFTER = 60 * FRAMES_PER_SECOND
FLASH_FRAMES = FRAMES_PER_SECOND
SHUTTER_FRAMES = 12
MOUSE_FRAMES = 3 * FRAMES_PER_SECOND
"""The frames for which the bar of commands shows after the mouse has moved."""


@frozen
class Toast:
    """A short message; gone at frame `until`."""

    text: str
    until: int


Format = Literal["gif", "mp4"]


@frozen
class RunningRecording:
    """A recording that runs since frame `since`, to be written to `target`; "" for the next free name."""

    format: Format
    since: int
    target: str = ""


class RecordingChoice(NamedTuple):
    """How recordings are made: format, size (None: the window's shape), and whether they are one period."""

    format: Format = "gif"
    size: tuple[int, int] | None = None
    whole: bool = False


class Edited(NamedTuple):
    """An edited scene of a place of the shelf, and the state of its editing."""

    place: int
    scene: Scene
    editing: Editing


class Game(Mode, ABC):
    """A running game, or the title, over the state `beneath`: it answers the state's actions.

    A game that needs something from outside, such as a seed, leaves an effect: "begin" with the words of
    another game, "score" with a result to be kept.
    """

    keys = ModeKeys("game", GAME_TABLE, names={Action("back"): "out of it"}, others=Action("next"))
    bar = (BACK_BAR, HOME_BAR, *LAST_BAR)
    actions: ClassVar[Mapping[str, Rule]] = {}
    is_listed = True

    @property
    @abstractmethod
    def words(self) -> str:
        """The words that begin an equal game: its kind, then its parameters."""

    @abstractmethod
    def entered(self, state: State) -> State:
        """Return the state as the game begins, which is the state's game already."""

    def spots(self, state: State) -> tuple[Spot, ...]:
        """Return the answers that are places on the picture."""
        del state
        return ()

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return the places of its answers, unless something else is open over it."""
        spots = self.spots(state) if state.top is self else ()
        return (Spots(spots),) if spots else ()

    @abstractmethod
    def carried(self, state: State, action: Action) -> State:
        """Return the state with an action carried out; unchanged where the game has no use for it."""

    def closed(self, state: State) -> State:
        """Return the state after Esc or the back arrow, which the game answers."""
        return self.carried(state, Action("back"))

    def mouse(self, gesture: Any, mouse: Any, screen: Any) -> tuple[Action, ...] | None:
        """Return the actions of a click: the answer that is there, else to go on; None on a joint to drag."""
        if gesture.kind != "down" or mouse.drag is not None:
            return None
        option = screen.option_at(*mouse.at)
        at_joint = screen.handle_at(*mouse.at, REACH * screen.size[1]) is not None
        if option is None and (self.draggable or at_joint or mouse.is_at_pin(screen)):
            return None
        return (Action("next") if option is None else Action("option", option),)


@frozen
class State:
    """All that the window shows at one frame; equal states are equal pictures.

    `shelf` holds the mechanisms that Tab goes through, by their catalogue names or as scenes, and `place` is
    that of the present one. `sheet` is the sheet, which may be closed. `kept` has the edited scenes of other
    places.

    `chip` is the answer to the last key. `faded` is the frame at which another mechanism or theme appeared,
    `shot` that of a screenshot, each as long as it can be seen. `departures` are the states that were
    left for this one, as long as their views, lists or pictures are seen. `place_typed` is the input's
    angle, or travel, that is being typed while paused. `modes` are open one on another. `beneath` is the
    state under a running game, and `games` reads a game from its words. Recordings are made as `take` says.
    `held` is the joint whose lengths are being dragged, `grasp` the joint that drags the input. `home` is the
    part of the plane that a game keeps visible, if not the fitted scene, `also` are places that it keeps in
    sight beside that. With `reduced_motion` the picture changes at once, without fades, glides and moving
    views. Words are in its `language`, or in that which is spoken where it is None.

    With `from_title` Esc leads from a mechanism back to the title. In a `kiosk` a mechanism that runs and is
    left alone gives way to the title, `by_itself`; the first action then only brings back what was there.
    `last_mouse_move` is the frame of the last move of the mouse or a finger, while the bar of commands shows.
    `touched` is the frame of the last action, `arrived` that at which the mechanism appeared, `turned` that
    at which an edit changed the class of the linkage, while the list shows it.

    `effects` is what the last advance asks of the outside: "record" and "render" (with a format),
    "screenshot", "svg", "share", "fullscreen", "folder" (of the file named in a toast), "name" (a name is to
    be proposed), "save" (the file), "save_new" (a name), "reload", "quit", "pencil" and "poses" (these
    begin), "search", "anew" and "follow" (answers to the sketch: with the shown one among them, without it,
    or that one alone), "layers" (of the scene), "make" (its parts), "begin" (a game, with its words), "score"
    (with a game's result to be kept), and "report" (with the text of a fault's report).
    """

    scene: Scene
    clock: Clock
    shelf: tuple[Scene | str, ...] = ()
    place: int = 0
    frame: int = 0
    modes: tuple[Mode, ...] = ()
    look: Look = field(default_factory=Look)
    editing: Editing = field(default_factory=Editing)
    held: Held | None = None
    grasp: Grasp | None = None
    kept: tuple[Edited, ...] = ()
    sheet: BuildSheet | None = None
    games: Callable[[str], Game] | None = None
    beneath: State | None = None
    glide: Glide | Changeover | None = None
    turned: int | None = None
    arrived: int | None = None
    place_typed: str = ""
    toast: Toast | None = None
    chip: Toast | None = None
    departures: tuple[Departure, ...] = ()
    faded: int | None = None
    shot: int | None = None
    recording: RunningRecording | None = None
    recording_choice: RecordingChoice = RecordingChoice()
    from_title: bool = False
    kiosk: bool = False
    by_itself: bool = False
    reduced_motion: bool = False
    language: str | None = None
    home: Box | None = None
    also: tuple[complex, ...] = ()
    lesson: tuple[int, int] | None = None
    last_mouse_move: int | None = None
    touched: int = 0
    effects: tuple[Action, ...] = ()

    @property
    def shown(self) -> Scene:
        """The scene to draw: `scene`, or one on the way to it while a length is changing."""
        return self.glide.scene if isinstance(self.glide, Glide) else self.scene

    @property
    def displayed(self) -> Scene:
        """The scene to draw, in the unit in which lengths are shown."""
        return in_unit(self.shown, self.look.unit)

    @property
    def top(self) -> Mode | None:
        """The mode that was opened last, of those that nothing can be seen through."""
        return next((one for one in reversed(self.modes) if not one.sees_through), None)

    @property
    def help(self) -> bool:
        """Whether the help is open."""
        return any(one.is_help for one in self.modes)

    @property
    def unhelped(self) -> State:
        """The state without the help."""
        return replace(self, modes=tuple(one for one in self.modes if not one.is_help))

    def of(self, kind: type[OneMode]) -> OneMode | None:
        """Return the open mode of a kind."""
        return next((one for one in reversed(self.modes) if isinstance(one, kind)), None)

    def with_mode(self, mode: Mode) -> State:
        """Return the state with a mode opened, or in the place of the open one of its kind."""
        kinds = [type(one) for one in self.modes]
        if type(mode) not in kinds:
            return replace(self, modes=(*self.modes, mode))
        at = kinds.index(type(mode))
        return replace(self, modes=(*self.modes[:at], mode, *self.modes[at + 1 :]))

    def without(self, kind: type[Mode]) -> State:
        """Return the state without the modes of a kind."""
        return replace(self, modes=tuple(one for one in self.modes if not isinstance(one, kind)))

    @property
    def unlisted(self) -> State:
        """The state without modes that give way: lists and the shelf."""
        return replace(self, modes=tuple(one for one in self.modes if not one.gives_way))

    @property
    def keys(self) -> ModeKeys:
        """The keys that have a meaning of their own now."""
        if top := self.top:
            return top.keys
        name = "lesson" if self.lesson else self.mode
        return next(one for one in OF_MODES if one.name == name)

    @property
    def mode(self) -> str:
        """What the keys are for, in a word."""
        if top := self.top:
            return top.keys.name
        return "paused" if self.clock.paused else "play"

    @property
    def constructed(self) -> int:
        """How many steps of the present scene's construction are drawn."""
        steps = sum(one.steps_of(self.scene) for one in self.modes)
        return 0 if not steps or self.sketch or self.building or self.game else steps

    @property
    def sketch(self) -> Sketch | None:
        """The pencil's stroke, or the poses that were set down."""
        return self.of(Sketch)  # type: ignore[type-abstract]

    @property
    def drawing(self) -> PathSketch | None:
        """What the pencil has drawn."""
        return self.of(PathSketch)

    @property
    def posing(self) -> PoseSketch | None:
        """The poses that were set down."""
        return self.of(PoseSketch)

    @property
    def game(self) -> Game | None:
        """The running game, or the title."""
        return self.of(Game)  # type: ignore[type-abstract]

    @property
    def building(self) -> BuildSheet | None:
        """The sheet, while it is open."""
        return self.sheet if any(one.is_sheet for one in self.modes) else None

    @property
    def edits_dimensions(self) -> bool:
        """Whether the list of dimensions is open."""
        return any(one.edits_dimensions for one in self.modes)

    @property
    def edited(self) -> frozenset[int]:
        """The places of the shelf whose scenes differ from their files."""
        sheet = self.building
        own = (sheet.before, sheet.editing) if sheet else (self.scene, self.editing)
        edits = (*self.kept, Edited(self.place, *own))
        return frozenset(one.place for one in edits if one.editing.original not in (None, one.scene))

    @property
    def is_bare(self) -> bool:
        """Whether a mechanism runs and nothing is open, begun, paused or recorded."""
        return self.mode == "play" and not (self.help or self.recording or self.held or self.grasp)

    @property
    def leads(self) -> bool:
        """Whether a hand on a joint drags the input: while a mechanism is shown, and on the title."""
        return self.top.leads if self.top else True

    @property
    def saved_as(self) -> str | None:
        """The file under which the present scene or sheet was saved; None where it was not."""
        if self.building:
            return self.building.saved or None
        name, file = self.editing.saved or ("", "")
        return file if name == self.scene.name else None

    @property
    def is_covered(self) -> bool:
        """Whether something is open that Esc closes."""
        return self.help or (self.top.covers if self.top else self.constructed > 0)

    @property
    def listed(self) -> bool:
        """Whether a list is open, beside which the scene has less room."""
        return any(one.is_listed for one in self.modes)

    @property
    def typing(self) -> bool:
        """Whether something has been begun in the open list."""
        return self.top.typing(self) if self.top else bool(self.place_typed)

    @property
    def valued(self) -> bool:
        """Whether typed digits are a value: on a sheet, of the chosen thing or a photograph's distance."""
        sheet = self.building
        return sheet is None or bool(sheet.building.chosen or (sheet.tool == "photo" and sheet.span))

    @property
    def phase(self) -> float:
        """The phase (rad) at this frame."""
        return self.phase_at(self.frame)

    def phase_at(self, frame: float) -> float:
        """Return the phase (rad) at a frame, of very many turns without whole periods."""
        phase = self.clock.at(frame)
        return phase if abs(phase) < _MANY else fmod(phase, self.scene.period)


def begin(scene: Scene | str | os.PathLike[str] | None = None, *, look: Look | None = None) -> State:
    """Return the state a window opens with: `scene`, loaded where it is a name or path, and the catalogue.

    Without a scene it is the press; a scene outside the catalogue stands before all others. BadInput as
    loading raises it.
    """
    source = "press" if scene is None else scene
    opened = source if isinstance(source, Scene) else load(source)
    shelf: tuple[Scene | str, ...] = names()
    if source not in shelf and (opened.name not in shelf or load(opened.name) != opened):
        shelf = (opened, *shelf)
    place = 0 if shelf[0] is opened else shelf.index(opened.name)
    return State(opened, fresh(opened), shelf, place, look=look or Look(), arrived=0)


def fresh(scene: Scene) -> Clock:
    """Return the clock of a scene that starts now."""
    return Clock(scene.linkage.drive.speed)


def with_toast(state: State, text: str) -> State:
    """Return the state with a toast."""
    return replace(state, toast=Toast(text, state.frame + TOAST_FRAMES))


def with_chip(state: State, text: str | None) -> State:
    """Return the state with a chip that says the text; unchanged without a text."""
    return replace(state, chip=Toast(text, state.frame + CHIP_FRAMES)) if text else state


def with_effect(state: State, name: str, value: str | None = None) -> State:
    """Return the state with a further effect, to be carried out outside."""
    return replace(state, effects=(*state.effects, Action(name, value)))


# Faults of a scene's solver: found before a scene is shown, put into a sentence, kept in a report.
#
# A scene file passes its checks and may still meet a hole in the solver. The window then keeps the last
# good linkage, and writes what is needed to find the hole.

_AT_A_VALUE = ("accept", "nudge")


def proved(scene: Scene, phase: float) -> Scene:
    """Return the scene after working out the facts that a window shows, one cycle and a pose.

    Raises whatever that raises.
    """
    info = scene.info
    _ = info.class_name, info.grashof, info.change_points
    scene.cycle(scene.mechanism.count(_TRIED))
    scene.pose(phase)
    return scene


def refused(state: State, action: Action, error: Exception) -> State:
    """Return the state as it was, with the reason where the value stands, or in a toast.

    An error that linkanim raises on purpose has its own words; for any other error a report is written.
    """
    if isinstance(error, LinkanimError):
        return with_toast(state, str(error))
    sentence = said("the solver failed there ({fault}); the last good linkage runs on", fault=named(error))
    item = chosen(state.editing, state.scene) if action.name in _AT_A_VALUE else None
    context = {"action": list(action), "key": item.key if item else None, "typed": state.editing.typed}
    state = with_effect(state, "report", report(state.scene, error, **context))
    if item is None:
        return with_toast(state, sentence)
    return replace(state, editing=replace(state.editing, refusal=sentence))


def named(error: Exception) -> str:
    """Return an exception's kind and words in one line."""
    return " ".join(f"{type(error).__name__}: {error}".split()).removesuffix(":")


def report(scene: Scene, error: Exception, **context: object) -> str:
    """Return, as JSON, the whole scene, the context, and where the solver failed."""
    import json

    from linkanim import __version__

    content = {
        "linkanim": __version__,
        "scene": scene.name,
        "document": scene.document,
        **context,
        "error": named(error),
        "traceback": traceback.format_exception(error),
    }
    return json.dumps(content, indent=1, ensure_ascii=False, default=str)


def recovered(state: State, good: State, error: Exception) -> State:
    """Return a state that can be painted instead of one that cannot; `good` is the last that was painted.

    A glide is left out; a scene other than the last good one is removed; where the scene itself fails at this
    phase, it stands still at the last good phase.
    """
    if state.glide:
        return replace(state, glide=None, departures=())
    clock = good.clock.go(state.frame, good.phase, paused=state.scene is good.scene or good.clock.paused)
    back = replace(good, frame=state.frame, clock=clock, glide=None, departures=())
    back = replace(back, effects=(), recording=None)
    words = said("the solver failed there ({fault}); the last good linkage is back", fault=named(error))
    return with_toast(back, words)
