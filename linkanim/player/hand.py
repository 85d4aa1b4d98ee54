"""What a mode asks of the hand on the mouse, and of the window."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, NamedTuple, Protocol

from linkanim.player.action import Action
from linkanim.player.browsing import OwnFile
from linkanim.player.sight import Sight
from linkanim.player.state import State

Drag = Literal[
    "pan",
    "crank",
    "motor",
    "chart",
    "joint",
    "row",
    "pen",
    "lead",
    "dial",
    "hand",
    "paper",
    "slider",
    "bar",
    "speed",
    "scroll",
    "shelf",
    "pace",
]


class Gesture(NamedTuple):
    """What the left button or the wheel did: notches away, and how far the mouse moved, in window heights.

    Steps are `coarser` by a factor with Shift.
    """

    kind: Literal["wheel", "down", "up", "move"]
    notches: int
    by: tuple[float, float]
    coarser: int = 1


class Hand(Protocol):
    """The hand on the mouse: what it drags, where it is and was, in pixels, and how far it has moved.

    Modes keep in `steps`, `turned`, `under`, `draws` and `turns` what they need during a drag.
    """

    drag: Drag | None
    at: tuple[float, float]
    begun: tuple[float, float]
    far: float
    steps: int
    turned: int | None
    under: int | None
    draws: bool
    turns: bool

    def is_at_pin(self, screen: Sight) -> bool:
        """Return whether the mouse is at the crank's pin."""

    def handed(self, name: str, screen: Sight, *, on_grid: bool = False) -> Action:
        """Return the hand's action on the sheet; its step is a tenth with Shift, and none with Alt."""

    def moved(self, screen: Sight) -> tuple[Action, ...]:
        """Return the actions of what is dragged, where the mouse is now."""


class Outside(Protocol):
    """What an action may have to know of the window: what is visible, and the current folder."""

    state: State
    screen: Sight

    def resolved(self, action: Action) -> Iterator[Action]:
        """Yield an action; one that depends on what is visible or in the folder is resolved first."""

    def scene_files(self) -> tuple[OwnFile, ...]:
        """Return the scene files in the current folder."""

    def lesson_step(self, further: int) -> Action:
        """Return the action that shows the lesson's step so many steps further on, or a note."""

    def proposed_targets(self) -> str:
        """Return the current folder and places in it to write to, one a line."""

    def refused_target(self, file: str) -> str:
        """Return why nothing can be recorded into a file; else remember its folder, and return nothing."""
