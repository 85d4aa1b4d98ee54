"""A mode: all closures of the scene as small running pictures, one of which becomes the scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace
from typing import ClassVar

from linkanim.errors import LinkanimError
from linkanim.frozen import frozen
from linkanim.player import rules
from linkanim.player.action import Action
from linkanim.player.edits import followed
from linkanim.player.keys import KeyRow, ModeKeys, TypedKeys, both, enter, on
from linkanim.player.shelving import OpenShelf
from linkanim.player.state import Rule, State, with_toast, with_undo
from linkanim.scenes.closures import SceneClosure, closures, described
from linkanim.scenes.scene import Scene
from linkanim.words import said


def _toggle(state: State, _: None) -> State:
    """Open the closures of the scene, or close them."""
    if state.of(OpenClosures):
        return state.without(OpenClosures)
    return state.unlisted.with_mode(OpenClosures((), 0, state.frame, scene=state.scene))


def _put_together(state: State, number: int) -> State:
    """Show a closure by its place, and close the others; undo goes back."""
    opened, bare = state.of(OpenClosures), state.without(OpenClosures)
    try:
        known = opened is not None and opened.scene is state.scene and opened.is_ready
        choices = opened.closures if opened and known else closures(state.scene)
        scene = choices[number].scene if 0 <= number < len(choices) else state.scene
        if scene is state.scene:
            return bare
        return followed(replace(bare, editing=with_undo(bare.editing, state.scene)), scene)
    except LinkanimError as error:
        return with_toast(bare, str(error))


@frozen
class OpenClosures(OpenShelf):
    """The open closures of a scene; they are looked for once it has been said so on the screen."""

    scene: Scene = field(kw_only=True)
    closures: tuple[SceneClosure, ...] = ()
    is_ready: bool = False

    keys = ModeKeys(
        "closures",
        {
            "in Ctrl+B": (
                KeyRow(
                    "arrows, mouse",
                    "choose a closure",
                    both("left", "right", "move") + both("up", "down", "row"),
                ),
                KeyRow("PgUp, PgDn, wheel", "scroll", both("pageup", "pagedown", "scroll", 2)),
                KeyRow("Enter, click", "put the linkage together so", enter("put_chosen", "erase_filter")),
                KeyRow("Ctrl+B, Esc", "close", on("ctrl+b", "closures")),
            )
        },
        TypedKeys("filter", frozenset({"space", "h"})),
    )
    actions: ClassVar[Mapping[str, Rule]] = {
        **OpenShelf.actions,
        "closures": Rule(rules.nothing, _toggle, taped=False),
        "choose_closure": Rule(rules.whole, _put_together),  # its place among all closures of the scene
    }
    has_new = False

    @property
    def heading(self) -> str:
        """What stands over the pictures."""
        return said("Closures of {title}", title=said(self.scene.title))

    @property
    def nothing(self) -> str:
        """What is said where no closure is listed."""
        return said("no closure's words contain that") if self.is_ready else said("looking for all closures…")

    def texts(self, place: int) -> tuple[str, str, str]:
        """Return the texts by which a closure is found: its number, what it is in words, its class."""
        number, words, motion, class_name, curve = described(self.closures, place)
        is_first = self.closures[place].curve in (None, place + 1)
        same = "" if is_first else said(", curve {curve}", curve=curve)
        return number, f"{number}: {words}; {motion}{same}", class_name

    def takes(self, number: int) -> tuple[Action, ...]:
        """Return the actions that show what is at a place."""
        return (Action("choose_closure", number),)

    def aged(self, state: State) -> State:
        """Look for the closures, in the second frame."""
        if self.is_ready or state.frame <= self.since + 1:
            return state
        try:
            choices = closures(self.scene)
        except LinkanimError as error:
            return with_toast(state.without(OpenClosures), str(error))
        entries = tuple(one.scene for one in choices)
        return state.with_mode(replace(self, entries=entries, closures=choices, is_ready=True))
