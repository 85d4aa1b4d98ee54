"""The title: mechanisms running one after the other, each with its sentence, and three doors."""

from __future__ import annotations

from dataclasses import dataclass, replace

from linkanim.picture.look import Look
from linkanim.picture.panels.overlay import GamePanel, Overlay
from linkanim.play.choosing import Door, begun, choices_of, chosen_by
from linkanim.play.words import GameWords
from linkanim.player.state.action import Action
from linkanim.player.state.clock import FRAMES_PER_SECOND
from linkanim.player.state.handlers.build import build
from linkanim.player.state.handlers.games import leave, with_scene
from linkanim.player.state.handlers.shelf import open_shelf
from linkanim.player.state.state import State, with_effect, with_toast
from linkanim.scenes import load

EACH = 9 * FRAMES_PER_SECOND
_NAME = "linkanim"
_ABOUT = "An arcade of planar linkages"
_HINT = "any key goes in   ↑ ↓ choose   Q quits"


DOORS = (
    Door("explore", "Explore", "the shelf of all mechanisms"),
    Door("build", "Build", "draw a linkage, or with W a path to follow"),
    Door("play", "Play", "predict, match, follow"),
)
_IGNORED = frozenset({"scrub", "point", "move", "carry", "drop", "pull"})
"""What a mouse that moves asks for: it goes in by a click."""


@dataclass(frozen=True)
class Title:
    """The title: the door that any key takes, and the place on the shelf of the mechanism that runs."""

    door: int
    place: int
    covers = False

    @property
    def words(self) -> str:
        """What begins it again."""
        return f"title door={DOORS[self.door].name} place={self.place}"

    def entered(self, state: State) -> State:
        """Return the state with a mechanism running, and nothing on it but its sentence."""
        shown = Look(hud=False, theme=state.look.theme)
        entry = state.shelf[self.place % len(state.shelf)]
        scene = load(entry) if isinstance(entry, str) else entry
        return with_scene(replace(state, look=shown), scene)

    def carried(self, state: State, action: Action) -> State:
        """Go in by a door, or choose one."""
        if action.name == "back":
            return with_toast(state, "Q quits")
        if action.name in _IGNORED or (action.name == "option" and action.value not in range(len(DOORS))):
            return state
        door, taken = chosen_by(action, self.door, len(DOORS)) or (self.door, True)
        return _through(state, door) if taken else replace(state, game=replace(self, door=door))

    def aged(self, state: State) -> State:
        """Go on to the next mechanism when one has run for a while."""
        if state.arrived is None or state.frame - state.arrived < EACH:
            return state
        further = replace(self, place=(self.place + 1) % len(state.shelf))
        return further.entered(replace(state, game=further))

    def shown(self, state: State, over: Overlay) -> Overlay:
        """Return the overlay with the name and the doors."""
        panel = GamePanel(
            _NAME,
            lines=(_ABOUT,),
            choices=choices_of(DOORS),
            subject=state.scene.title,
            lines_after=(state.scene.look_at,),
            hint=_HINT,
            large=True,
            chosen=self.door,
        )
        return replace(over, game=panel)


def _through(state: State, door: int) -> State:
    """Go in by a door, which is the first one the next time."""
    name = DOORS[door].name
    state = with_effect(state, "score", f"door={name}")
    if name == "play":
        return begun(state, "lobby")
    state = leave(state)
    if name == "explore":
        return open_shelf(state, None)
    return state if state.sheet and state.sheet.open else build(state, None)


def read(words: GameWords) -> Title:
    """Return the title that words begin; BadInput where they do not."""
    names = [door.name for door in DOORS]
    door = words.text("door", "explore")
    return Title(names.index(door) if door in names else 0, words.whole("place", 0, 0, 10_000))
