"""The player's state and its only way forward: `advance(state, actions)`, pure.

What must be done outside (a screenshot, full screen, a file to write) is left in `State.effects`,
as data for the window to carry out.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from linkanim.errors import LinkanimError
from linkanim.picture.look import Look
from linkanim.picture.quantities import quantities
from linkanim.player import editing as edit
from linkanim.player.actions import Action
from linkanim.player.assembly import other_closure
from linkanim.player.clock import FRAMES_PER_SECOND, Clock
from linkanim.player.editing import Editing
from linkanim.player.framing import panned, zoomed
from linkanim.player.glide import Glide, followed, glide
from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene

TOAST_FRAMES = 3 * FRAMES_PER_SECOND
ATTRACT_AFTER = 60 * FRAMES_PER_SECOND
ATTRACT_EACH = 15 * FRAMES_PER_SECOND


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


@dataclass(frozen=True)
class State:
    """All that the window shows at one frame; equal states are equal pictures.

    `shelf` holds the mechanisms that Tab walks through, by their catalogue names or as scenes, and
    `place` the one that is on. `touched` is the frame of the last action. `effects` is what the last
    advance asks of the outside: "record" and "render" (with a format), "screenshot", "fullscreen",
    "save", "quit".
    """

    scene: Scene
    clock: Clock
    shelf: tuple[Scene | str, ...] = ()
    place: int = 0
    frame: int = 0
    look: Look = field(default_factory=Look)
    help: bool = False
    editing: Editing = field(default_factory=Editing)
    glide: Glide | None = None
    toast: Toast | None = None
    recording: Take | None = None
    attract: bool = False
    touched: int = 0
    effects: tuple[Action, ...] = ()

    @property
    def shown(self) -> Scene:
        """The scene to draw: `scene`, or one on the way to it while a length is changing."""
        return self.glide.scene if self.glide else self.scene

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
    asked = names()[0] if scene is None else scene
    found = asked if isinstance(asked, Scene) else load(asked)
    shelf: tuple[Scene | str, ...] = names()
    if asked not in shelf and (found.name not in shelf or load(found.name) != found):
        shelf = (found, *shelf)
    place = 0 if shelf[0] is found else shelf.index(found.name)
    return State(found, fresh(found), shelf, place, look=look or Look(), attract=attract)


def fresh(scene: Scene) -> Clock:
    """Return the clock of a scene that starts now."""
    return Clock(scene.linkage.drive.speed)


def advance(state: State, actions: Iterable[Action] = ()) -> State:
    """Return the state one frame on, the actions carried out in their order.

    KeyError for an action that is not in `actions.KNOWN`.
    """
    asked = tuple(actions)
    state = _aged(replace(state, frame=state.frame + 1, effects=()))
    for action in asked:
        state = HANDLERS[action.name](state, action.value)
    if any(action.name != "note" for action in asked):
        return replace(state, touched=state.frame)
    return _attracted(state)


def _aged(state: State) -> State:
    """Let go of a toast whose time is up, and follow a changing length."""
    if state.toast and state.frame >= state.toast.until:
        state = replace(state, toast=None)
    if state.glide:
        state = replace(state, glide=followed(state.glide, state.scene, state.frame))
    return state


def _attracted(state: State) -> State:
    """Walk on through the shelf where nobody has touched the window for a minute."""
    idle = state.frame - state.touched - ATTRACT_AFTER
    busy = state.recording or state.editing.open or state.editing.changed
    if not state.attract or busy or idle < 0 or idle % ATTRACT_EACH:
        return state
    onward = _mechanism(replace(state, help=False), 1)
    return replace(onward, clock=onward.clock.pause(onward.frame, False))


def _told(state: State, text: str) -> State:
    return replace(state, toast=Toast(text, state.frame + TOAST_FRAMES))


def _asking(state: State, name: str, value: str | None = None) -> State:
    return replace(state, effects=(*state.effects, Action(name, value)))


def _pause(state: State, _: None) -> State:
    return replace(state, clock=state.clock.pause(state.frame, not state.clock.paused))


def _step(state: State, degrees: int) -> State:
    return replace(state, clock=state.clock.step(state.frame, degrees))


def _speed(state: State, levels: int) -> State:
    return replace(state, clock=state.clock.faster(state.frame, levels))


def _direction(state: State, _: None) -> State:
    return replace(state, clock=state.clock.turn(state.frame))


def _start(state: State, _: None) -> State:
    return replace(state, clock=state.clock.go(state.frame, 0.0))


def _scrub(state: State, phase: float) -> State:
    return replace(state, clock=state.clock.go(state.frame, phase, paused=True))


def _mechanism(state: State, further: int) -> State:
    if not state.shelf:
        return state
    return _put_on(state, (state.place + further) % len(state.shelf))


def _select(state: State, place: int) -> State:
    """Choose of the catalogue, whatever else stands on the shelf."""
    named = [at for at, entry in enumerate(state.shelf) if isinstance(entry, str)]
    return _put_on(state, named[place]) if place < len(named) else state


def _put_on(state: State, place: int) -> State:
    """Start a mechanism as its file says, paused where the last one was."""
    entry = state.shelf[place]
    scene = load(entry) if isinstance(entry, str) else entry
    clock = fresh(scene).go(state.frame, 0.0, paused=state.clock.paused)
    look = replace(state.look, zoom=1.0, pan=(0.0, 0.0), chart=_kept_chart(state, scene))
    editing = Editing(open=state.editing.open)
    return replace(state, scene=scene, place=place, clock=clock, look=look, editing=editing, glide=None)


def _closure(state: State, _: None) -> State:
    try:
        scene = other_closure(state.scene)
    except LinkanimError as error:
        return _told(state, str(error))
    return _exchanged(replace(state, editing=edit.changed(state.editing, state.scene)), scene)


def _exchanged(state: State, scene: Scene) -> State:
    """Show a changed scene at the phase the old one stands at."""
    clock = state.clock.at_rate(state.frame, scene.linkage.drive.speed)
    look = replace(state.look, chart=_kept_chart(state, scene))
    return replace(state, scene=scene, clock=clock, look=look)


def _charts(scene: Scene) -> tuple[str | None, ...]:
    return (None, *quantities(scene))


def _kept_chart(state: State, scene: Scene) -> str | None:
    chart = state.look.chart
    return chart if chart and chart in _charts(scene) else None


def _chart(state: State, further: int) -> State:
    charts = _charts(state.scene)
    at = charts.index(state.look.chart) if state.look.chart in charts else 0
    return replace(state, look=replace(state.look, chart=charts[(at + further) % len(charts)]))


def _trace(state: State, _: None) -> State:
    return replace(state, look=replace(state.look, trace=not state.look.trace))


def _vectors(state: State, kind: str) -> State:
    return replace(state, look=replace(state.look, vectors=state.look.vectors ^ {kind}))


def _ghost(state: State, _: None) -> State:
    if not state.look.ghost:
        try:
            other_closure(state.scene)
        except LinkanimError as error:
            return _told(state, str(error))
    return replace(state, look=replace(state.look, ghost=not state.look.ghost))


def _theme(state: State, _: None) -> State:
    return replace(state, look=replace(state.look, theme="light" if state.look.theme == "dark" else "dark"))


def _zoom(state: State, about: tuple[float, float, float]) -> State:
    notches, x, y = about
    return replace(state, look=zoomed(state.look, notches, (x, y)))


def _pan(state: State, by: tuple[float, float]) -> State:
    return replace(state, look=panned(state.look, by))


def _fit(state: State, _: None) -> State:
    return replace(state, look=replace(state.look, zoom=1.0, pan=(0.0, 0.0)))


def _help(state: State, _: None) -> State:
    return replace(state, help=not state.help)


def _back(state: State, _: None) -> State:
    """Let go of what lies on top: the help, a value begun, the list; then quit."""
    if state.help:
        return replace(state, help=False)
    if state.editing.typed:
        return replace(state, editing=edit.choose(state.editing, state.scene, 0))
    return _edit(state, None) if state.editing.open else _asking(state, "quit")


def _edit(state: State, _: None) -> State:
    """Open or close the list; what is undone and redone stays."""
    editing = edit.choose(state.editing, state.scene, 0)
    return replace(state, editing=replace(editing, open=not editing.open))


def _listed(work: Callable[[Editing, Scene, Any], Editing]) -> Callable[[State, Any], State]:
    """Make a handler of what changes the list alone."""
    return lambda state, value: replace(state, editing=work(state.editing, state.scene, value))


def _remade(work: Callable[[Editing, Scene, Any], tuple[Editing, Scene]]) -> Callable[[State, Any], State]:
    """Make a handler of what may give another scene; the picture follows it smoothly."""

    def handle(state: State, value: Any) -> State:
        editing, scene = work(state.editing, state.scene, value)
        state = replace(state, editing=editing)
        if scene is state.scene:
            return state
        way = glide(state.shown, scene, state.frame)
        return replace(_exchanged(state, scene), glide=way)

    return handle


def _record(state: State, form: Literal["gif", "mp4"]) -> State:
    """Start a recording, or stop the one that runs, whichever its format is."""
    if state.recording is None:
        return replace(_asking(state, "record", form), recording=Take(form, state.frame))
    return replace(_asking(state, "render", state.recording.format), recording=None)


def _effect(name: str) -> Callable[[State, Any], State]:
    return lambda state, _: _asking(state, name)


HANDLERS: Mapping[str, Callable[[State, Any], State]] = {
    "pause": _pause,
    "step": _step,
    "speed": _speed,
    "direction": _direction,
    "start": _start,
    "scrub": _scrub,
    "mechanism": _mechanism,
    "select": _select,
    "closure": _closure,
    "trace": _trace,
    "vectors": _vectors,
    "ghost": _ghost,
    "chart": _chart,
    "theme": _theme,
    "help": _help,
    "zoom": _zoom,
    "pan": _pan,
    "fit": _fit,
    "record": _record,
    "back": _back,
    "edit": _edit,
    "choose": _listed(edit.choose),
    "type": _listed(lambda editing, _, text: edit.write(editing, text)),
    "erase": _listed(lambda editing, *_: edit.erase(editing)),
    "nudge": _remade(edit.nudge),
    "take": _remade(lambda editing, scene, _: edit.take(editing, scene)),
    "undo": _remade(lambda editing, scene, _: edit.undo(editing, scene)),
    "redo": _remade(lambda editing, scene, _: edit.redo(editing, scene)),
    "note": _told,
    **{name: _effect(name) for name in ("screenshot", "fullscreen", "save", "quit")},
}
"""What each action does; every name of `actions.KNOWN` is here."""
