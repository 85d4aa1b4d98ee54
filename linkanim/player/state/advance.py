"""The player's only way forward: `advance(state, actions)`, pure.

A frame is three steps, so that the window can ask what a key means once those before it are done:
the state grows a frame older, each action is carried out, and a window left alone walks on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from linkanim.player.state.action import Action
from linkanim.player.state.actions import ACTIONS
from linkanim.player.state.clock import FRAMES_PER_SECOND
from linkanim.player.state.fault import refused
from linkanim.player.state.glide import followed
from linkanim.player.state.handlers import build
from linkanim.player.state.handlers.games import BESIDE, leave
from linkanim.player.state.handlers.pencil import come, keep, left
from linkanim.player.state.state import (
    ATTRACT_AFTER,
    FADE_FRAMES,
    FLASH_FRAMES,
    SHUTTER_FRAMES,
    Game,
    State,
    with_chip,
)

_WITHOUT_PENCIL = frozenset({"unit", "undo", "redo"})
"""What is not done while a path is drawn: its points are in the unit of then, and edits are the scene's."""
_KEEPS = frozenset({"edit"})
_LEAVES = frozenset({"mechanism", "select", "put", "closure", "reset", "returns"})
"""What keeps the answer that the pencil has, and what goes back to the scene before."""
_OFF_THE_SHEET = _KEEPS | _LEAVES | {"pencil", "own_trace"}
"""What is not done on a sheet, which is left for it."""
Change = Callable[[State], State]
ATTRACT_EACH = 15 * FRAMES_PER_SECOND

_SHEETS = frozenset({"build", "sheet", "draft", "photo"})
"""What opens a sheet, out of a game too."""
_LIVES = {"turned": FLASH_FRAMES, "faded": FADE_FRAMES, "shot": SHUTTER_FRAMES}
"""For how many frames after the one that the state holds something is to be seen."""


def advance(state: State, actions: Iterable[Action] = ()) -> State:
    """Return the state one frame on, the actions carried out in their order.

    KeyError for an action that is not in `actions.ACTIONS`.
    """
    state = aged(state)
    for action in actions:
        state = carried(state, action)
    return settled(state)


def aged(state: State) -> State:
    """Return the state a frame older: what has had its time goes, a changing length is followed."""
    state = replace(state, frame=state.frame + 1, effects=())
    if state.toast and state.frame >= state.toast.until:
        state = replace(state, toast=None)
    if state.chip and state.frame >= state.chip.until:
        state = replace(state, chip=None, place_typed="")
    sinces = ((name, getattr(state, name), life) for name, life in _LIVES.items())
    over = [name for name, since, life in sinces if since is not None and state.frame >= since + life]
    state = replace(state, **dict.fromkeys(over)) if over else state  # type: ignore[arg-type]
    state = build.rested(come(state) if state.sketch else state)
    if state.glide:
        state = _tried(state, Action("glide"), _followed, lambda before: replace(before, glide=None))
    return _tried(state, Action("play"), state.game.aged, leave) if state.game else state


def carried(state: State, action: Action) -> State:
    """Return the state with one action carried out; one that a solver fails at changes nothing."""
    rule = ACTIONS[action.name]
    if action.name != "note":
        state = replace(state, touched=state.frame)
    if state.game and action.name not in BESIDE | _SHEETS:
        return _in_a_game(state, state.game, action)
    if (state.sketch or state.building) and action.name in _WITHOUT_PENCIL:
        return state
    if state.game and action.name in _SHEETS:
        state = leave(state)
        if state.building and action.name == "build":
            return state  # the sheet that was open beneath
    if action.name in _OFF_THE_SHEET:
        state = build.left(state)
    if action.name in _KEEPS | _LEAVES:
        state = keep(state, None) if action.name in _KEEPS else left(state)

    def handled(before: State) -> State:
        after = rule.handle(before, action.value)
        return with_chip(after, rule.answer(before, after)) if rule.answer else after

    return _tried(state, action, handled)


def settled(state: State) -> State:
    """Return the state at the end of a frame: left alone for a minute, it walks on through the shelf.

    In a kiosk it goes back to the title, whatever was begun; what is recorded goes on.
    """
    alone = state.frame - state.touched >= ATTRACT_AFTER and not state.recording
    if state.kiosk and state.games and alone and (state.game is None or state.game.covers):
        return replace(carried(state, Action("play", "title")), touched=state.touched)
    if state.idle is None or state.idle % ATTRACT_EACH:
        return state
    bare = replace(state, help=False, browsing=None, listing=None)
    onward = replace(carried(bare, Action("mechanism", 1)), touched=state.touched)
    return replace(onward, clock=onward.clock.pause(onward.frame, False))


def _in_a_game(state: State, game: Game, action: Action) -> State:
    """Return the state with an action handed to its game; under the help there is nothing but a way back."""
    if state.help:
        return replace(state, help=False) if action.name == "back" else state
    return _tried(state, action, lambda before: game.carried(before, action))


def _followed(state: State) -> State:
    return replace(state, glide=state.glide and followed(state.glide, state.scene, state.frame))


def _tried(state: State, action: Action, work: Change, without: Change = lambda before: before) -> State:
    """Return the state with some work done, or `without` it where a solver fails at that, which is told."""
    try:
        return work(state)
    except Exception as error:
        return refused(without(state), action, error)
