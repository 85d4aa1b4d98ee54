"""The player's state: all that one frame of the window shows, as a frozen value.

What must be done outside (a screenshot, full screen, a file to write) is left in `State.effects`,
as data for the window to carry out.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Literal, NamedTuple, Protocol

from linkanim.picture.look import Look
from linkanim.picture.panels.overlay import Overlay
from linkanim.picture.view import Box
from linkanim.player.state.action import Action, Mode
from linkanim.player.state.browsing import Browsing, Listing
from linkanim.player.state.clock import FRAMES_PER_SECOND, Clock
from linkanim.player.state.editing import Editing, Held
from linkanim.player.state.glide import Glide
from linkanim.player.state.sheet import BuildSheet
from linkanim.player.state.sketch import Sketch
from linkanim.scenes import load, names
from linkanim.scenes.editing.shown_unit import in_unit
from linkanim.scenes.scene import Scene

TOAST_FRAMES = 3 * FRAMES_PER_SECOND
CHIP_FRAMES = 66
ATTRACT_AFTER = 60 * FRAMES_PER_SECOND
FLASH_FRAMES = FRAMES_PER_SECOND
FADE_FRAMES = 14
SHUTTER_FRAMES = 12


@dataclass(frozen=True)
class Toast:
    """A short message; gone at frame `until`."""

    text: str
    until: int


@dataclass(frozen=True)
class Take:
    """A recording that runs since frame `since`."""

    format: Literal["gif", "mp4"]
    since: int


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


@dataclass(frozen=True)
class State:
    """All that the window shows at one frame; equal states are equal pictures.

    `shelf` holds the mechanisms that Tab walks through, by their catalogue names or as scenes, and
    `place` the one that is on; `listing` and `browsing` are the open list of quantities and the open shelf,
    `sketch` what the pencil has drawn, `sheet` what is built, or was while it is not open.
    `kept` are the other places whose scenes were edited. `chip` is the
    answer to the last key; `faded` is the frame
    at which another mechanism or theme came on, `shot` that of a screenshot, while there is something to see.
    `place_typed` is the input's angle, or travel, that is being typed while paused.
    `game` is the game that is on, over the state `beneath`, and `games` reads one from its words.
    `held` is the joint that is being dragged, `pad` whether a gamepad is plugged in.
    `home` is what of the scene's plane a game keeps in sight, where that is not the scene as it fits.
    `sounds` says whether the motion is heard, None where nobody has.
    With `attract` it walks on by itself when left alone; in a `kiosk` it then goes back to the title, too.
    `touched` is the frame of the last action, `arrived` that at
    which the mechanism came on, `turned` that at which an edit made another class of the linkage, while the
    list shows it. `effects` is what the last
    advance asks of the outside: "record" and "render" (with a format), "screenshot", "svg", "share",
    "fullscreen", "save", "reload", "quit", "pencil" (it was taken), "search" and "follow" (answers to the
    sketch, or the one that is shown again), "begin" (a game, with its words), "score" (with what is to be
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
    kept: tuple[Edited, ...] = ()
    listing: Listing | None = None
    browsing: Browsing | None = None
    sketch: Sketch | None = None
    sheet: BuildSheet | None = None
    game: Game | None = None
    games: Callable[[str], Game] | None = None
    beneath: State | None = None
    glide: Glide | None = None
    turned: int | None = None
    arrived: int | None = None
    place_typed: str = ""
    toast: Toast | None = None
    chip: Toast | None = None
    faded: int | None = None
    shot: int | None = None
    recording: Take | None = None
    attract: bool = False
    kiosk: bool = False
    pad: bool = False
    sounds: bool | None = None
    home: Box | None = None
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
        if self.game:
            return "game"
        if self.editing.open:
            return "edit"
        if self.listing or self.browsing:
            return "list" if self.listing else "shelf"
        if self.sketch:
            return "pencil"
        if self.building:
            return "build"
        return "paused" if self.clock.paused else "play"

    @property
    def building(self) -> BuildSheet | None:
        """The sheet, while it is open."""
        return self.sheet if self.sheet and self.sheet.open and not self.game else None

    @property
    def edited(self) -> frozenset[int]:
        """The places of the shelf whose scenes are not as their files have them."""
        found = (*self.kept, Edited(self.place, self.scene, self.editing))
        return frozenset(one.place for one in found if one.editing.original not in (None, one.scene))

    @property
    def idle(self) -> int | None:
        """For how many frames it has walked on by itself, left alone; None where it does not."""
        busy = self.recording or self.sketch or self.building or self.editing.open or self.editing.changed
        frames = self.frame - self.touched - ATTRACT_AFTER
        return frames if self.attract and not (busy or self.game) and frames >= 0 else None

    @property
    def is_audible(self) -> bool:
        """Whether sounds are on: by U, and of their own accord nowhere but in games."""
        return (self.game is not None and self.game.covers) if self.sounds is None else self.sounds

    @property
    def is_covered(self) -> bool:
        """Whether something is open that Esc closes."""
        if self.game and not self.help:
            return self.game.covers
        return self.help or self.mode not in ("play", "paused")

    @property
    def listed(self) -> bool:
        """Whether a list is open, beside which the scene has less room."""
        return self.editing.open or self.listing is not None or self.game is not None

    @property
    def typing(self) -> bool:
        """Whether something has been begun in the open list."""
        if self.editing.open:
            return self.editing.typed != ""
        begun = self.building.building.typed if self.building else self.place_typed
        browsed = self.browsing.sieve if self.browsing else begun
        return bool(self.listing.sieve if self.listing else browsed)

    @property
    def phase(self) -> float:
        """The phase (rad) at this frame."""
        return self.clock.at(self.frame)


def begin(
    scene: Scene | str | os.PathLike[str] | None = None, *, look: Look | None = None, attract: bool = False
) -> State:
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
    return State(found, fresh(found), shelf, place, look=look or Look(), attract=attract, arrived=0)


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
