"""The sheet on which a linkage is built: what is drawn on it, the tool in hand, and what the hand does."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple

from linkanim.build.building import Building
from linkanim.build.draft import Draft, Thing
from linkanim.mechanics.linkage.joint import Point
from linkanim.picture.view import Box
from linkanim.player.state.clock import Clock
from linkanim.player.state.editing import Editing
from linkanim.scenes.scene import Scene

HOME = Box(-100.0, -40.0, 200.0, 130.0)
"""What an empty sheet shows, in millimetres."""
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


@dataclass(frozen=True)
class BuildSheet:
    """What is built over the scene `before`, which comes back, with its clock and editing, if it cannot move.

    `home` is the part of the plane that is seen unless it is zoomed. `tool` is what is in hand, `grip` what
    the hand does, `clicked` the frame and place of its last click; `cursor` is the place of the keys' own,
    `anchor` the point of a photograph that is put where it belongs. `rests` is the frame at which a linkage
    that runs by itself has shown one period. `written` is the draft as a scene file has it; `warned` tells
    that the next asking lets go of what is in none, `closes` that the next one closes the window all the
    same. While it is not `open` the sheet is kept, to be gone on with.
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
    rests: int | None = None
    written: Draft = field(default_factory=Draft)
    warned: bool = False
    closes: bool = False

    def seen(self, scene: Scene, phase: float) -> Draft:
        """Return the draft with its joints where they are seen: while it moves, at a phase of its scene."""
        drawn = self.building.draft
        if self.building.made.scene is None:
            return drawn
        found = scene.pose(phase, 0).position
        places = {name: (float(found[name][0]), float(found[name][1])) for name in drawn.places}
        return replace(drawn, places=places)

    @property
    def lasting(self) -> Building:
        """What is built, but for what the hand moves just now."""
        return self.grip.base if self.grip and self.tool in LIVE else self.building

    @property
    def is_written(self) -> bool:
        """Whether nothing would be lost with it."""
        return self.building.draft == self.written


def driven_bar(draft: Draft) -> Thing | None:
    """Return the bar of the driven crank; None of what is driven otherwise."""
    bars = draft.bars_at(draft.driven) if draft.driven else ()
    return next((("bars", name) for name, end, _ in bars if end in draft.of("pins")), None)
