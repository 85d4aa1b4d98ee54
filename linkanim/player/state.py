"""Hold the player's state: all that one frame of the window shows, as a frozen value.

Its parts come first: what is looked through, what is edited, a changed length that is followed smoothly,
the sheet, the pencil's sketch; then `State` itself. Last, a scene is proved before it is shown, and a fault
of its solver is told in a sentence.
"""

from __future__ import annotations

import os
import traceback
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from linkanim.build.building import Building, Undoable
from linkanim.build.draft import Draft, Thing
from linkanim.build.meanings import Meaning
from linkanim.errors import BadInput, LinkanimError
from linkanim.frozen import NamedTuple, frozen
from linkanim.mechanics.analysis import Info
from linkanim.mechanics.linkage import Point
from linkanim.mechanics.motion import stopped
from linkanim.picture.layered import Layered
from linkanim.picture.look import Look
from linkanim.picture.overlay import Browsing, Overlay, sifted
from linkanim.picture.quantities import quantity
from linkanim.picture.view import Box, eased
from linkanim.player.action import Action, Mode
from linkanim.player.clock import FRAMES_PER_SECOND, Clock
from linkanim.scenes import load, names
from linkanim.scenes.editing import Dimension, Handle, dimensions, handles, in_unit, passing
from linkanim.scenes.form import Key
from linkanim.scenes.scene import Scene
from linkanim.units import degrees

if TYPE_CHECKING:
    from linkanim.synthesis.answers import PathAnswer
    from linkanim.synthesis.curves import DrawnCurve
    from linkanim.synthesis.guidance import PoseAnswer

# What is looked through in an open overlay: the list of quantities, and the shelf of mechanisms.
#
# Both belong to the window alone, and no tape keeps them: what is chosen there is asked for by an action of
# its own ("plot", "put"), and that a tape does keep.


class ListRow(NamedTuple):
    """A row of a list: its words, the key that does the same, and what it asks for."""

    words: str
    key: str
    action: Action


@frozen
class Entries:
    """Rows under a title, of which a folder may give a hundred thousand, and the letters that sift them."""

    title: str
    entries: tuple[ListRow, ...]
    sieve: str = ""

    @cached_property
    def found(self) -> tuple[ListRow, ...]:
        """Those that have all the sieve's words."""
        return sifted({one: f"{one.words} {one.key}" for one in self.entries}, self.sieve)

    @cached_property
    def rows(self) -> tuple[tuple[str, str], ...]:
        """The same as rows of a list: words, and the key behind them."""
        return tuple((one.words, one.key) for one in self.found)


@frozen
class Listing:
    """The open list: the row that is chosen, and the letters that sift it; of quantities, or of `others`.

    One that `adds` has a quantity charted below what is charted, not in its place.
    """

    chosen: int
    sieve: str = ""
    others: Entries | None = None
    adds: bool = False

    def found(self, scene: Scene) -> tuple[str, ...]:
        """Return the tokens of quantities, or the words of others, that have all the sieve's words."""
        if self.others is None:
            return listed(scene, self.sieve)
        return tuple(one.words for one in self.others.found)

    def asked(self, scene: Scene, row: int) -> Action | None:
        """Return what a row asks for; None where there is none."""
        if self.others is not None:
            return next((one.action for one in self.others.found[row : row + 1]), None)
        charts = "strip" if self.adds else "plot"
        return next((Action(charts, token) for token in self.found(scene)[row : row + 1]), None)

    def sifted(self, sieve: str) -> Listing:
        """Return it with other letters, at its top."""
        return replace(self, chosen=0, sieve=sieve, others=self.others and replace(self.others, sieve=sieve))


def listed(scene: Scene, sieve: str) -> tuple[str, ...]:
    """Return the tokens of the quantities that have all the sieve's words, the telling ones first."""
    found = {token: quantity(scene, token) for token in (*scene.telling, *scene.quantities)}
    return sifted({token: f"{token} {one.words} {one.symbol}" for token, one in found.items()}, sieve)


# Where the editing of dimensions stands: the value being typed, what was refused and why, undo and redo.

_KEPT = 100


@frozen
class Editing(Undoable[Scene]):
    """Where the editing stands; `past` and `future` are the scenes that undo and redo go to.

    `typed` is a value begun in the chosen row and not taken, `drafts` those begun in rows that were passed
    on from, `refusal` the reason why they were not taken; `refused` is the document that was dragged to. With
    `warned` they can be taken all the same, by asking once more. `original` is the scene as its file has it,
    once that was left. `saved` is the name of the scene that was saved, and its file.
    """

    open: bool = False
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
        """Whether there is something to go back to or on to."""
        return bool(self.past or self.future)

    @property
    def begun(self) -> bool:
        """Whether a value, here or in another row, waits to be taken."""
        return bool(self.typed or self.drafts)


def chosen(editing: Editing, scene: Scene) -> Dimension | None:
    """Return the dimension that the list stands at; None where the scene has none."""
    items = dimensions(scene)
    return items[editing.chosen % len(items)] if items else None


def nothing_begun(editing: Editing) -> Editing:
    """Return the editing without the value being typed, or where there is none, without all drafts."""
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
    cause = f"{after.why_swinging}: " if after.why_swinging else ""
    return f"{cause}the crank cannot turn fully; it swings {low}…{high}"


def check_of_turning(before: Info) -> Callable[[Scene], None]:
    """Return a check that refuses a scene whose input no longer turns fully before all of it is solved."""

    def check(scene: Scene) -> None:
        found = stopped(scene.linkage) if before.full_turn else None
        if found and (loss := loss_of_turning(before, Info(found, scene.length_unit))):
            raise BadInput(loss)

    return check


def cleared(editing: Editing, **changes: object) -> Editing:
    """Return the editing with nothing begun and nothing refused, and these changes."""
    return replace(editing, **{"typed": "", "refusal": None, "warned": False, **changes})  # type: ignore[arg-type]


@frozen
class Held:
    """A joint that is being dragged, "" for the chosen value: where it was taken, and whether that ran on."""

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
"""Frames over which a hand's speed is taken, the most of it (rad/s), and a step (rad) that has none."""


@frozen
class Grasp:
    """A joint that a hand leads, and the input with it: whether the motion `ran` and goes on so.

    `trail` holds the last frames and their phases, `forward` the way the phase went last.
    """

    joint: str
    ran: bool
    trail: tuple[tuple[int, float], ...]
    forward: bool

    def led(self, frame: int, phase: float) -> Grasp:
        """Return it with the phase to which the hand has led the input."""
        step = phase - self.trail[-1][1]
        forward = step > 0.0 if step else self.forward
        before = self.trail if abs(step) < _JUMP else ()
        return replace(self, trail=(*before, (frame, phase))[-_TRAIL - 1 :], forward=forward)

    def speed(self, frame: int) -> float:
        """The hand's speed (rad/s of phase) at a frame: 0 where it has stood still."""
        at, last = self.trail[-1]
        earlier = [one for one in self.trail if one[0] <= frame - _TRAIL][-1:] or self.trail[:1]
        since, phase = earlier[0]
        # a button is let go of a frame or two after the mouse has moved last
        rate = (last - phase) * FRAMES_PER_SECOND / max(max(at, frame - 2) - since, 1)
        return min(max(rate, -_FASTEST), _FASTEST)


# A changed length is followed smoothly: the scenes between the old one and the new.

FRAMES = 16
EVERY = 2
"""A scene on the way stands for so many frames: one is worked out in the last of them, and then drawn."""
_TRIED = 90
_FOLLOWED = ("length", "offset", "angle")


@frozen
class Glide:
    """Dimensions that change since frame `since`: (key, from, to), and the scene shown meanwhile.

    `coming` is the one that is worked out for the next frame, if any.
    """

    scene: Scene
    since: int
    changes: tuple[tuple[Key, float, float], ...]
    coming: Scene | None = None


def glide(before: Scene, after: Scene, frame: int) -> Glide | None:
    """Return the glide from one scene to the other; None where no length or angle differs."""
    old = {item.key: item for item in dimensions(before)}
    changes = tuple(
        (item.key, old[item.key].value, item.value)
        for item in dimensions(after)
        if item.kind in _FOLLOWED and item.key in old
        if item.unit == old[item.key].unit and item.value != old[item.key].value
    )
    return Glide(before, frame, changes) if changes else None


def followed(begun: Glide, after: Scene, frame: int) -> Glide | None:
    """Return the glide at `frame`; None when `after` is reached.

    A scene on the way that cannot be assembled all along is left out: the last one stays.
    """
    gone = frame + 1 - begun.since
    if gone > FRAMES:
        return None
    if gone % EVERY == 0 and gone < FRAMES:
        return replace(begun, coming=_on_the_way(begun, after, gone / FRAMES))
    return replace(begun, scene=begun.coming, coming=None) if begun.coming else begun


def _on_the_way(begun: Glide, after: Scene, part: float) -> Scene | None:
    """Return the scene after a part of the way; None where it cannot be assembled all along."""
    try:
        scene = passing(
            after, {key: start + (end - start) * eased(part) for key, start, end in begun.changes}
        )
    except LinkanimError:
        return None
    return scene if closes(scene) else None


def closes(scene: Scene) -> bool:
    """Tell whether all joints have a place at all phases."""
    places = scene.cycle(scene.mechanism.count(_TRIED)).every["position"].values()
    return all(bool(np.isfinite(place).all()) for place in places)


# The sheet on which a linkage is built: what is drawn on it, the tool in hand, and what the hand does.

HOME = Box(-100.0, -40.0, 200.0, 130.0)
"""What an empty sheet shows, in millimetres."""
BLANK = "nothing is drawn yet that has a dimension"
LIVE = ("move", "photo")
"""The tools that change what is built while the hand moves."""


class Grip(NamedTuple):
    """What the hand does from where it went down: how near counts as on it, the step of what it draws.

    `base` is what was built before, `ran` whether the linkage ran then.
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
    """What is built over the scene `before`, which comes back, with its clock and editing, if it cannot move.

    `home` is the part of the plane that is seen unless it is zoomed. `tool` is what is in hand, `grip` what
    the hand does, `clicked` the frame and place of its last click; `cursor` is the place of the keys' own,
    `anchor` the point of a photograph that is put where it belongs, `span` another one whose distance from
    it can be typed. `offers` are what the last drag can
    mean, which ended at `offered`. `rests` is the frame at which a linkage
    that runs by itself has shown one period. `written` is the draft as the scene file `saved` has it;
    `warned` tells that the next asking lets go of what is in none, `closes` that the next one closes the
    window all the same. With the list of dimensions open, what is typed is for the chosen thing's own row
    where that is `rowed`. The `look` is that of before: a sheet has no chart of its own, and its unit.
    While it is not `open` the sheet is kept, to be gone on with.
    """

    before: Scene
    clock: Clock
    editing: Editing
    building: Building = field(default_factory=Building)
    home: Box = HOME
    open: bool = True
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
        """Return the draft with its joints where they are seen: while it moves, at a phase of its scene."""
        drawn = self.building.draft
        if self.building.made.scene is None:
            return drawn
        found = scene.pose(phase, 0).position
        places = {name: (float(found[name][0]), float(found[name][1])) for name in drawn.places}
        return replace(drawn, places=places)

    @property
    def meant(self) -> int | None:
        """Which of the offers is done; None where nothing is offered, or something else was done since."""
        draft = self.building.draft
        return next((n for n, one in enumerate(self.offers) if one.building.draft is draft), None)

    @property
    def lasting(self) -> Building:
        """What is built, without what the hand is moving."""
        return self.grip.base if self.grip and self.tool in LIVE else self.building

    @property
    def is_written(self) -> bool:
        """Whether nothing would be lost if it were closed."""
        return self.building.draft == self.written


def driven_bar(draft: Draft) -> Thing | None:
    """Return the bar of the driven crank; None of what is driven otherwise."""
    bars = draft.bars_at(draft.driven) if draft.driven else ()
    return next((("bars", name) for name, end, _ in bars if end in draft.of("pins")), None)


# What is drawn for linkages to be found for: the pencil's stroke, or poses of a body.

PIVOTS = ("O2", "O4")
"""Of every answer."""
_LARGEST_COGNATE = 2.5
"""Of the stroke's size: larger ones are not shown beside an answer that is smaller."""
DIAL = "dial"
"""What of a sketch is held while its dial is dragged."""


@frozen
class Sketch(ABC):
    """What is drawn over the scene `before`, which comes back with its clock and editing, and its answers.

    All is in the `unit` of length in which scenes were shown then; `strokes` counts what answers were asked
    for. Of the `answers` the `chosen` one is the state's scene. While something is `held` by the hand, `base`
    is the scene when that was taken, and `coming` the one for the next frame. `earlier` was there before the
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
    @abstractmethod
    def is_asked(self) -> bool:
        """Whether there is something that linkages can be found for."""

    @property
    @abstractmethod
    def points(self) -> NDArray[np.complex128]:
        """What is to be kept in sight, as x + yi."""

    @property
    @abstractmethod
    def at_rest(self) -> Self:
        """The same with nothing begun."""

    def picking(self, place: int) -> Self:
        """Return it with another of the answers shown, as was asked for by hand."""
        return replace(self, chosen=place)

    @abstractmethod
    def answer_from(self, numbers: tuple[float, ...]) -> Any:
        """Return the answer that is all of these numbers."""

    @abstractmethod
    def scene_of(self, answer: Any, towards: Scene | None = None) -> Scene:
        """Return an answer as a scene, maybe on the way `towards` another."""


@frozen
class PathSketch(Sketch):
    """What the pencil has drawn.

    `pen` holds the points of the stroke under way, `curve` what the last stroke meant. The first answer may
    be the scene whose own trace was taken; `names` says what each is among them. `way` goes from the exact
    end of the front to the compact one; where the `dial` along it was moved to a share, the scene is the
    answer that was `dialled` there. One that was `picked` by hand stays when more answers come. `pivots` are
    held where they were put. `held` is the number of the curve's point, the pivot, or the `DIAL` that is
    dragged.
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
        """Whether the linkage that is shown was found for the stroke, and its fixed pins can be dragged."""
        return not (self.is_blank or isinstance(self.answer, Scene))

    @cached_property
    def cognates(self) -> tuple[PathAnswer | None, ...]:
        """The cognates of the answer that is shown at rest, else nothing.

        None for one that does not turn fully, or that is far larger than the answer and the stroke.
        """
        answer = self.answer
        if not self.follows or self.held is not None or answer is None or isinstance(answer, Scene):
            return ()
        from linkanim.synthesis.answers import turning_cognates

        most = max(_LARGEST_COGNATE, answer.size)
        return tuple(one if one and one.size <= most else None for one in turning_cognates(answer))

    @property
    def off(self) -> float | None:
        """By how much of the stroke's size, in percent, the answer shown is off; None before the first."""
        return 0.0 if isinstance(self.answer, Scene) else self.answer.off if self.answer else None

    @property
    def is_blank(self) -> bool:
        """Whether no linkage follows yet what is drawn."""
        return bool(self.pen) or not self.answers

    @property
    def is_asked(self) -> bool:
        """Whether there is a stroke."""
        return self.curve is not None

    @property
    def points(self) -> NDArray[np.complex128]:
        """The stroke's points."""
        return np.zeros(0, np.complex128) if self.curve is None else self.curve.points

    @property
    def at_rest(self) -> PathSketch:
        """The same without a stroke under way."""
        return replace(self, pen=())

    @property
    def undialled(self) -> PathSketch:
        """The same with nothing dragged, the dial where the answer that was chosen is."""
        return replace(self, dial=None, dialled=None, held=None, picked=False)

    def picking(self, place: int) -> PathSketch:
        """Return it with another of the answers shown, as was asked for by hand."""
        return replace(self.undialled, chosen=place, picked=True)

    def answer_from(self, numbers: tuple[float, ...]) -> PathAnswer:
        """Return the answer that is all of these numbers."""
        from linkanim.synthesis.answers import answer_from

        return answer_from(numbers)

    def scene_of(self, answer: PathAnswer | Scene, towards: Scene | None = None) -> Scene:
        """Return an answer as a scene, maybe on the way `towards` another."""
        return answer if isinstance(answer, Scene) else answer.scene(self.unit, towards)


class SetPose(NamedTuple):
    """A pose that was set down: the body's origin, and its angle (rad)."""

    x: float
    y: float
    angle: float


class PoseGrip(NamedTuple):
    """What is dragged of poses, and its number: a frame, its axis, a pin, a joint of the linkage in pose 1.

    `off` is how far it was from the hand when that took it, `at` where a joint is led to.
    """

    what: Literal["pose", "axis", "pin", "joint"]
    number: int
    off: Point = (0.0, 0.0)
    at: Point | None = None


POSED = 16
"""How many numbers a linkage through poses is."""
LARGEST_DIAL = 4
"""The dial's farthest step, to either side of the middle."""


@frozen
class PoseSketch(Sketch):
    """Poses of a body that were set down, and linkages whose coupler passes them.

    `pins` are where fixed pins are to be; linkages end on a slider where they are `sliding`. The `dial` says
    which counts more, a small linkage (below 0) or a large transmission angle. With `curves` what the theory
    has of the poses is drawn. The hand sets pins, not poses, while it is `pinning`. `taken` is what was
    touched last, `cursor` the place of the keys' own hand, `refusal` why there is no linkage.
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
    taken: tuple[str, int] | None = None
    cursor: Point | None = None
    refusal: str = ""

    @property
    def is_asked(self) -> bool:
        """Whether there are poses enough."""
        return len(self.poses) > 1

    @property
    def points(self) -> NDArray[np.complex128]:
        """The poses' origins."""
        return np.array([complex(pose.x, pose.y) for pose in self.poses], np.complex128)

    @property
    def at_rest(self) -> PoseSketch:
        """The same with nothing held."""
        return replace(self, held=None)

    def answer_from(self, numbers: tuple[float, ...]) -> PoseAnswer:
        """Return the answer that is all of these numbers."""
        from linkanim.synthesis.guidance import pose_answer_from

        return pose_answer_from(numbers)

    def scene_of(self, answer: PoseAnswer, towards: Scene | None = None) -> Scene:
        """Return an answer as a scene, maybe on the way `towards` another."""
        return answer.scene(self.unit, self.poses, towards)


# The layers in which the scene that is on can be made.

LIFTED = 20
"""Steps by which layers are lifted off each other, from flat to as far as there is room."""
FAMILY = 100
"""Steps from one end of a family of linkages to the other."""


class Layering(NamedTuple):
    """The layers of a scene: its parts once they are known, or in a sentence why it cannot be made.

    They are `lifted` by so many steps; `text` is what was found out, as a tape keeps it.
    """

    scene: Scene
    parts: Layered | None = None
    refused: str = ""
    lifted: int = 0
    text: str = ""


# The player's state: all that one frame of the window shows, as a frozen value.
#
# What must be done outside (a screenshot, full screen, a file to write) is left in `State.effects`,
# as data for the window to carry out.

TOAST_FRAMES = 3 * FRAMES_PER_SECOND
CHIP_FRAMES = 66
ATTRACT_AFTER = 60 * FRAMES_PER_SECOND
FLASH_FRAMES = FRAMES_PER_SECOND
FADE_FRAMES = 14
SHUTTER_FRAMES = 12
STIR_FRAMES = 3 * FRAMES_PER_SECOND
"""For so long the bar of commands shows after the mouse has moved."""


@frozen
class Toast:
    """A short message; gone at frame `until`."""

    text: str
    until: int


Format = Literal["gif", "mp4"]


@frozen
class Take:
    """A recording that runs since frame `since`, to be written to `target`; "" is a free name."""

    format: Format
    since: int
    target: str = ""


class TakeChoice(NamedTuple):
    """How recordings are made: their format, their size (None: the window's shape), whether of one period."""

    format: Format = "gif"
    size: tuple[int, int] | None = None
    whole: bool = False


class TakeDialog(NamedTuple):
    """The open dialog of a recording: the row that is chosen, and where it is to be written.

    That is what was `typed`, else the one of the `places` that are proposed that has the number `at`. They
    are files without their endings, from the current `folder`. The `refusal` says why it cannot be written.
    """

    row: int = 0
    typed: str = ""
    places: tuple[str, ...] = ()
    at: int = 0
    folder: str = ""
    refusal: str = ""

    @property
    def place(self) -> str:
        """Where it is to be written, without its ending; a folder alone has the name that is proposed."""
        proposed = next(iter(self.places[self.at :]), "")
        if self.typed.endswith(("/", "\\")):
            return self.typed + proposed.replace("\\", "/").rpartition("/")[2]
        return self.typed or proposed


class Naming(NamedTuple):
    """The name of the scene file to be written: as proposed, or as typed, and why that was refused."""

    proposal: str
    typed: str = ""
    refusal: str = ""

    @property
    def name(self) -> str:
        """What Enter takes."""
        return self.typed or self.proposal


class Edited(NamedTuple):
    """The scene of a place of the shelf as it was edited, and where its editing stood."""

    place: int
    scene: Scene
    editing: Editing


class Game(Protocol):
    """A game that is on, or the title: a frozen value that the state hands its actions to.

    Equal games look the same. Where it needs something from outside, such as a seed, it leaves an effect:
    "begin" with the words of another game, "score" with what is to be kept.
    """

    @property
    def words(self) -> str:
        """What begins it again just as it is now: its kind, then its parameters."""

    @property
    def covers(self) -> bool:
        """Whether Esc goes out of it."""

    def entered(self, state: State) -> State:
        """Return the state with what the game begins with; it is the state's game already."""

    def carried(self, state: State, action: Action) -> State:
        """Return the state with an action carried out, or as it is where the game has no use for it."""

    def aged(self, state: State) -> State:
        """Return the state, a frame later already, with what time does to the game."""

    def shown(self, state: State, over: Overlay) -> Overlay:
        """Return the overlay with what the game shows."""


@frozen
class State:
    """All that the window shows at one frame; equal states are equal pictures.

    `shelf` holds the mechanisms that Tab walks through, by their catalogue names or as scenes, and
    `place` the one that is on; `listing` and `browsing` are the open list of quantities and the open shelf,
    `sketch` the pencil's stroke or poses, `sheet` what is built, or was while it is not open.
    `layers` are those in which the scene can be made, while they are shown; `construction` has the scene
    whose synthesis is drawn, and how many of its steps.
    `kept` are the other places whose scenes were edited. `chip` is the
    answer to the last key; `faded` is the frame
    at which another mechanism or theme came on, `shot` that of a screenshot, while there is something to see.
    `place_typed` is the input's angle, or travel, that is being typed while paused, `naming` the name under
    which the scene is to be saved, while that is asked for.
    `game` is the game that is on, over the state `beneath`, and `games` reads one from its words.
    Recordings are made as the `take` says; `taking` is the open dialog in which that is chosen.
    `held` is the joint whose lengths are being dragged, `grasp` the one that leads the input, `pad` whether a
    gamepad is plugged in.
    `home` is what of the scene's plane a game keeps in sight, where that is not the scene as it fits.
    `sounds` says whether the motion is heard, None where nobody has.
    With `from_title` Esc leads from a mechanism back to the title. In a `kiosk` a mechanism that runs and is
    left alone gives way to the title, `by_itself`; the first action then only brings back what was there.
    `stirred` is the frame at which the mouse or a finger moved last, while the bar of commands shows.
    `touched` is the frame of the last action, `arrived` that at
    which the mechanism came on, `turned` that at which an edit made another class of the linkage, while the
    list shows it. `effects` is what the last
    advance asks of the outside: "record" and "render" (with a format), "screenshot", "svg", "share",
    "fullscreen", "folder" (of the file that a toast told of), "name" (a name is to be proposed), "save"
    (the file), "save_new" (a name), "reload", "quit", "pencil" and "poses" (they are on), "search", "anew"
    and "follow" (answers to the sketch, the one that is shown among them, or not, or that alone),
    "layers" (of the scene), "make" (its parts), "begin" (a game, with its words), "score" (with what is to be
    kept of one), "sound" (a cue), and "report" (with the text of a fault's report).
    """

    scene: Scene
    clock: Clock
    shelf: tuple[Scene | str, ...] = ()
    place: int = 0
    frame: int = 0
    look: Look = field(default_factory=Look)
    help: bool = False
    editing: Editing = field(default_factory=Editing)
    held: Held | None = None
    grasp: Grasp | None = None
    kept: tuple[Edited, ...] = ()
    listing: Listing | None = None
    browsing: Browsing | None = None
    sketch: Sketch | None = None
    sheet: BuildSheet | None = None
    layers: Layering | None = None
    construction: tuple[Scene, int] | None = None
    game: Game | None = None
    games: Callable[[str], Game] | None = None
    beneath: State | None = None
    glide: Glide | None = None
    turned: int | None = None
    arrived: int | None = None
    place_typed: str = ""
    naming: Naming | None = None
    toast: Toast | None = None
    chip: Toast | None = None
    faded: int | None = None
    shot: int | None = None
    recording: Take | None = None
    take: TakeChoice = TakeChoice()
    taking: TakeDialog | None = None
    from_title: bool = False
    kiosk: bool = False
    by_itself: bool = False
    pad: bool = False
    sounds: bool | None = None
    home: Box | None = None
    stirred: int | None = None
    touched: int = 0
    effects: tuple[Action, ...] = ()

    @property
    def shown(self) -> Scene:
        """The scene to draw: `scene`, or one on the way to it while a length is changing."""
        return self.glide.scene if self.glide else self.scene

    @property
    def displayed(self) -> Scene:
        """The scene to draw, in the unit in which lengths are shown."""
        return in_unit(self.shown, self.look.unit)

    @property
    def mode(self) -> Mode:
        """What the keys are for."""
        if self.naming:
            return "name"
        if self.taking:
            return "record"
        if self.listing:
            return "list"
        if self.game:
            return "game"
        if self.editing.open:
            return "numbers" if self.building else "edit"
        if self.browsing:
            return "shelf"
        if self.sketch:
            return "poses" if self.posing else "pencil"
        if self.building:
            return "build"
        if self.layers:
            return "layers"
        return "paused" if self.clock.paused else "play"

    @property
    def constructed(self) -> int:
        """How many steps of the construction of the scene that is on are drawn."""
        scene, steps = self.construction or (None, 0)
        return steps if scene is self.scene and not (self.sketch or self.building or self.game) else 0

    @property
    def drawing(self) -> PathSketch | None:
        """What the pencil has drawn."""
        return self.sketch if isinstance(self.sketch, PathSketch) else None

    @property
    def posing(self) -> PoseSketch | None:
        """The poses that were set down, while that is on."""
        return self.sketch if isinstance(self.sketch, PoseSketch) else None

    @property
    def building(self) -> BuildSheet | None:
        """The sheet, while it is open."""
        return self.sheet if self.sheet and self.sheet.open and not self.game else None

    @property
    def edited(self) -> frozenset[int]:
        """The places of the shelf whose scenes are not as their files have them."""
        sheet = self.building
        own = (sheet.before, sheet.editing) if sheet else (self.scene, self.editing)
        found = (*self.kept, Edited(self.place, *own))
        return frozenset(one.place for one in found if one.editing.original not in (None, one.scene))

    @property
    def is_bare(self) -> bool:
        """Whether a mechanism runs, and nothing is open, begun, paused or recorded."""
        return self.mode == "play" and not (self.help or self.recording or self.held or self.grasp)

    @property
    def leads(self) -> bool:
        """Whether a hand on a joint leads the input: while a mechanism is on, and on the title."""
        on_title = self.mode == "game" and self.game is not None and not self.game.covers
        return on_title or self.mode in ("play", "paused", "list", "record")

    @property
    def saved_as(self) -> str | None:
        """The file under which what is on was saved; None where it was not."""
        if self.building:
            return self.building.saved or None
        name, file = self.editing.saved or ("", "")
        return file if name == self.scene.name else None

    @property
    def is_audible(self) -> bool:
        """Whether sounds are on: by U, and of their own accord nowhere but in games."""
        return (self.game is not None and self.game.covers) if self.sounds is None else self.sounds

    @property
    def is_covered(self) -> bool:
        """Whether something is open that Esc closes."""
        if self.game and not (self.help or self.listing or self.taking):
            return self.game.covers
        return self.help or self.mode not in ("play", "paused")

    @property
    def listed(self) -> bool:
        """Whether a list is open, beside which the scene has less room."""
        is_list = self.editing.open or self.listing is not None or self.taking is not None
        return is_list or self.game is not None

    @property
    def typing(self) -> bool:
        """Whether something has been begun in the open list."""
        if self.naming or self.taking:
            return True
        if self.listing:
            return bool(self.listing.sieve)
        sheet = self.building
        if self.editing.open:
            return bool(self.editing.typed or (sheet and sheet.building.typed))
        begun = sheet.building.typed or sheet.building.lettered if sheet else self.place_typed
        browsed = self.browsing.sieve if self.browsing else begun
        return bool(browsed)

    @property
    def valued(self) -> bool:
        """Whether digits typed on the sheet are a value: of what is chosen, or a photograph's distance."""
        sheet = self.building
        return bool(sheet and (sheet.building.chosen or (sheet.tool == "photo" and sheet.span)))

    @property
    def phase(self) -> float:
        """The phase (rad) at this frame."""
        return self.clock.at(self.frame)


def begin(scene: Scene | str | os.PathLike[str] | None = None, *, look: Look | None = None) -> State:
    """Return the state a window opens with: `scene`, loaded where it is a name or path, and the catalogue.

    Without a scene it is the catalogue's first; one that is not of the catalogue stands before it.
    BadInput as loading raises it.
    """
    source = names()[0] if scene is None else scene
    found = source if isinstance(source, Scene) else load(source)
    shelf: tuple[Scene | str, ...] = names()
    if source not in shelf and (found.name not in shelf or load(found.name) != found):
        shelf = (found, *shelf)
    place = 0 if shelf[0] is found else shelf.index(found.name)
    return State(found, fresh(found), shelf, place, look=look or Look(), arrived=0)


def fresh(scene: Scene) -> Clock:
    """Return the clock of a scene that starts now."""
    return Clock(scene.linkage.drive.speed)


def with_toast(state: State, text: str) -> State:
    """Return the state with a toast."""
    return replace(state, toast=Toast(text, state.frame + TOAST_FRAMES))


def with_chip(state: State, text: str | None) -> State:
    """Return the state with a chip that says the text; without, as it was."""
    return replace(state, chip=Toast(text, state.frame + CHIP_FRAMES)) if text else state


def with_effect(state: State, name: str, value: str | None = None) -> State:
    """Return the state with one more thing to be done outside."""
    return replace(state, effects=(*state.effects, Action(name, value)))


# Faults of a scene's solver: found before a scene is shown, told in a sentence, kept in a report.
#
# A scene file passes its checks and may still meet a hole in the solver. The window then keeps the last
# good linkage, and writes what is needed to find the hole.

_AT_A_VALUE = ("take", "nudge")


def proved(scene: Scene, phase: float) -> Scene:
    """Return the scene, the facts that a window shows, one cycle and a pose worked out; what that raises."""
    info = scene.info
    _ = info.class_name, info.grashof, info.change_points
    # Read, for a motion works out what is read of it; the picture asks for the same.
    _ = scene.cycle(scene.mechanism.count(_TRIED)).position
    scene.pose(phase)
    return scene


def refused(state: State, action: Action, error: Exception) -> State:
    """Return the state as it was, the reason told where the value stands, or in a toast.

    What linkanim raises on purpose says its reason by itself; of anything else a report is written.
    """
    if isinstance(error, LinkanimError):
        return with_toast(state, str(error))
    sentence = f"the solver failed there ({named(error)}); the last good linkage runs on"
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
    """Return a state that can be painted where one cannot be; `good` is the last that was painted.

    A glide is left out; another scene than the last good one is taken off again; where the scene itself
    fails at this phase, it stands still at the last good one.
    """
    if state.glide:
        return replace(state, glide=None)
    clock = good.clock.go(state.frame, good.phase, paused=state.scene is good.scene or good.clock.paused)
    back = replace(good, frame=state.frame, clock=clock, glide=None, effects=(), recording=None)
    return with_toast(back, f"the solver failed there ({named(error)}); the last good linkage is back")
