"""Games come over the state and go again; what was there before stands beneath, and comes back."""

from __future__ import annotations

from dataclasses import replace

from linkanim.player.state.editing import Editing
from linkanim.player.state.fault import proved
from linkanim.player.state.handlers.edits import drop
from linkanim.player.state.handlers.pencil import left
from linkanim.player.state.state import State, fresh, with_toast
from linkanim.scenes.scene import Scene

BESIDE = frozenset(
    {
        *("play", "help", "theme", "zoom", "pan", "fit", "fullscreen", "note", "sounds", "pad"),
        *("record", "screenshot", "svg", "quit", "close"),
    }
)
"""Actions that are the window's own while a game is on; all others are handed to the game."""


def play(state: State, words: str) -> State:
    """Begin a game, or the title, by its words; BadInput where they name none."""
    if state.games is None:
        return with_toast(state, "there are no games here; `linkanim` alone has them")
    game = state.games(words)
    if state.beneath is None:
        state = drop(left(state), None)
        state = replace(state, beneath=replace(state, help=False, listing=None, browsing=None))
    bare = replace(
        state, listing=None, browsing=None, glide=None, home=None, place_typed="", chip=None, toast=None
    )
    editing = Editing()
    return game.entered(replace(bare, game=game, editing=editing, help=False, faded=state.frame))


def leave(state: State) -> State:
    """Return the state without its game: what was beneath, standing or running on from where it was."""
    under = state.beneath
    if under is None:
        return state
    look = replace(under.look, theme=state.look.theme)
    clock = under.clock.go(state.frame, under.phase)
    kept = replace(under, frame=state.frame, clock=clock, look=look, touched=state.touched)
    kept = replace(kept, sounds=state.sounds, pad=state.pad, attract=state.attract, kiosk=state.kiosk)
    return replace(kept, recording=state.recording, effects=state.effects, faded=state.frame)


def with_scene(state: State, scene: Scene, phase: float = 0.0, *, paused: bool = False) -> State:
    """Return the state with a game's scene on, standing or running from a phase; errors as `proved`."""
    clock = fresh(proved(scene, phase)).go(state.frame, phase, paused=paused)
    look = replace(state.look, zoom=1.0, pan=(0.0, 0.0), chart=None)
    return replace(
        state, scene=scene, clock=clock, look=look, glide=None, faded=state.frame, arrived=state.frame
    )
